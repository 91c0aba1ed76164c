// SPDX-License-Identifier: MIT OR Apache-2.0
//! The runners on small hand-written modules: what they answer is what a few lines of Rust say, and a fault shows.

use relief_testbench::cosim::{
    CosimError, Cycles, Design, Dump, Icarus, Port, PowerUp, Response, Severity, Simulator, Verilator, Waiver,
    first_difference, iverilog_accepts, tools, verilator_lint, yosys_synth_ecp5,
};
use std::{
    collections::VecDeque,
    path::PathBuf,
    thread,
    time::{Duration, Instant},
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn fixture(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

fn adder_ports() -> Vec<Port> {
    vec![
        Port::input("clock", 1),
        Port::input("reset", 1),
        Port::input("in_valid", 1),
        Port::output("in_ready", 1),
        Port::input("in_left", 32),
        Port::input("in_right", 32),
        Port::output("out_valid", 1),
        Port::input("out_ready", 1),
        Port::output("out_sum", 33),
    ]
}

fn adder(top: &str) -> Design {
    Design::new(top, vec![fixture(&format!("{top}.sv"))], adder_ports())
}

fn wide() -> Design {
    let ports = vec![Port::input("in_vertex", 598), Port::output("out_vertex", 598), Port::output("out_delayed", 598)];
    Design::new("relief_wide", vec![fixture("relief_wide.sv")], ports)
}

fn ram() -> Design {
    let ports = vec![
        Port::input("in_address", 10),
        Port::input("in_write", 1),
        Port::input("in_word", 16),
        Port::output("out_word", 16),
    ];
    Design::new("relief_ram", vec![fixture("relief_ram.sv")], ports)
}

/// Knuth's generator, so that every run sees the same stimulus.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 ^ self.0 >> 31
    }

    /// Small, large and extreme operands.
    fn operand(&mut self) -> i32 {
        match self.next() >> 61 {
            0 => i32::MIN,
            1 => i32::MAX,
            2 => -1,
            _ => self.next() as i32,
        }
    }
}

/// Stimulus that knows nothing of the answers, and the answers: `in_ready` depends on the inputs of the same cycle.
fn adder_run(cycles: usize) -> Result<(Cycles, Cycles), CosimError> {
    let design = adder("relief_adder");
    let [reset, valid, left, right, ready] =
        ["reset", "in_valid", "in_left", "in_right", "out_ready"].map(|name| design.input(name));
    let (reset, valid, left, right, ready) = (reset?, valid?, left?, right?, ready?);
    let [in_ready, out_valid, out_sum] = ["in_ready", "out_valid", "out_sum"].map(|name| design.output(name));
    let (in_ready, out_valid, out_sum) = (in_ready?, out_valid?, out_sum?);
    let mut numbers = Numbers(1);
    let (mut stimulus, mut expected) = (Cycles::new(design.input_words()), Cycles::new(design.output_words()));
    let (mut full, mut sum) = (false, 0i64);
    for cycle in 0..cycles {
        let (resets, offers, takes) = (cycle < 2, numbers.next() >> 63 == 0, numbers.next() >> 62 != 0);
        let (a, b) = (numbers.operand(), numbers.operand());
        stimulus.push_with(|words| {
            reset.set(words, resets.into());
            valid.set(words, offers.into());
            ready.set(words, takes.into());
            left.set_signed(words, a.into());
            right.set_signed(words, b.into());
        });
        let accepts = !full || takes;
        expected.push_with(|words| {
            in_ready.set(words, accepts.into());
            out_valid.set(words, full.into());
            out_sum.set_signed(words, sum);
        });
        if accepts && offers {
            sum = i64::from(a) + i64::from(b);
        }
        full = !resets && if accepts { offers } else { full };
    }
    Ok((stimulus, expected))
}

fn both_simulators(design: &Design) -> Result<Vec<Box<dyn Simulator>>, CosimError> {
    Ok(vec![Box::new(Verilator::new().build(design)?), Box::new(Icarus::new().build(design)?)])
}

/// The sum counts while it is valid.
fn adder_matters(design: &Design, expected: &Cycles) -> Result<impl Fn(usize, &Port) -> bool, CosimError> {
    let valid = design.output("out_valid")?;
    let valid: Vec<bool> = expected.iter().map(|words| valid.is_high(words)).collect();
    Ok(move |cycle: usize, port: &Port| port.name != "out_sum" || valid[cycle])
}

#[test]
fn adder_answers_as_expected_in_both_simulators() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "iverilog"], "the adder in both simulators")? {
        return Ok(());
    }
    let design = adder("relief_adder");
    let (stimulus, expected) = adder_run(2000)?;
    let matters = adder_matters(&design, &expected)?;
    for simulator in both_simulators(&design)? {
        let response = simulator.run(&stimulus)?;
        assert_eq!(response.values.len(), 2000, "{}", simulator.name());
        let difference = first_difference(&design, &expected, &response, &matters);
        assert_eq!(difference, None, "{}", simulator.name());
        // Every run begins at power-up.
        assert_eq!(simulator.run(&stimulus)?, response, "{}", simulator.name());
    }
    Ok(())
}

#[test]
fn adder_fault_is_noticed_in_both_simulators() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "iverilog"], "the faulty adder in both simulators")? {
        return Ok(());
    }
    let design = adder("relief_adder_faulty");
    let (stimulus, expected) = adder_run(2000)?;
    let matters = adder_matters(&design, &expected)?;
    let mut found = Vec::new();
    for simulator in both_simulators(&design)? {
        let difference = first_difference(&design, &expected, &simulator.run(&stimulus)?, &matters);
        found.push(difference.expect("a beat is taken without room"));
    }
    assert_eq!(found[0], found[1]);
    let stall = expected.iter().position(|words| words[0] == 0).expect("the stimulus stalls");
    assert_eq!(found[0].to_string(), format!("in cycle {stall} `in_ready` is 0x1, and 0x0 was expected"));
    Ok(())
}

/// Offers beats and takes them as the outputs of each cycle allow; returns what came out, against what went in.
fn drive(design: &Design, beats: usize) -> Result<(Vec<i64>, Vec<i64>), CosimError> {
    let model = Verilator::new().build(design)?;
    let mut session = model.start_with(PowerUp::Random(7), None)?;
    let mut words = vec![0; design.input_words()];
    let (valid, left, right) = (design.input("in_valid")?, design.input("in_left")?, design.input("in_right")?);
    let (reset, ready) = (design.input("reset")?, design.input("out_ready")?);
    let (in_ready, out_valid, out_sum) =
        (design.output("in_ready")?, design.output("out_valid")?, design.output("out_sum")?);
    reset.set(&mut words, 1);
    session.cycle(&words)?;
    reset.set(&mut words, 0);
    let mut numbers = Numbers(3);
    let (mut sent, mut came) = (Vec::new(), Vec::new());
    let mut waiting: VecDeque<(i32, i32)> = (0..beats).map(|_| (numbers.operand(), numbers.operand())).collect();
    let mut offered = false;
    for _ in 0..20 * beats {
        // A beat that was offered stays offered until it is taken.
        offered = !waiting.is_empty() && (offered || numbers.next() >> 63 == 0);
        valid.set(&mut words, offered.into());
        if let (true, Some((a, b))) = (offered, waiting.front()) {
            left.set_signed(&mut words, (*a).into());
            right.set_signed(&mut words, (*b).into());
        }
        let takes = numbers.next() >> 62 == 0;
        ready.set(&mut words, takes.into());
        let outputs = session.cycle(&words)?;
        if takes && out_valid.is_high(outputs) {
            came.push(out_sum.signed(outputs));
        }
        if offered && in_ready.is_high(outputs) {
            sent.extend(waiting.pop_front().map(|(a, b)| i64::from(a) + i64::from(b)));
            offered = false;
        }
        if sent.len() == beats && came.len() == beats {
            break;
        }
    }
    session.finish()?;
    Ok((sent, came))
}

#[test]
fn adder_driven_cycle_by_cycle_loses_no_beat_and_the_faulty_one_does() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "the adder driven cycle by cycle")? {
        return Ok(());
    }
    let (sent, came) = drive(&adder("relief_adder"), 300)?;
    assert_eq!(sent.len(), 300);
    assert_eq!(sent, came);
    let (sent, came) = drive(&adder("relief_adder_faulty"), 300)?;
    assert_eq!(sent.len(), 300);
    assert!(came.len() < sent.len(), "the faulty adder loses beats");
    Ok(())
}

#[test]
fn session_goes_on_where_it_stopped() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "batches and single cycles in turn")? {
        return Ok(());
    }
    let design = adder("relief_adder");
    let (stimulus, _) = adder_run(6000)?;
    let model = Verilator::new().build(&design)?;
    let whole = model.run(&stimulus)?.values;
    let mut session = model.start()?;
    let mut cycle = 0;
    // Sizes on both sides of what is sent without a thread, and single cycles in between.
    for batch in [1, 700, 3, 2500, 2000, 796] {
        let mut part = Cycles::new(stimulus.width());
        (cycle..cycle + batch).for_each(|index| part.push(stimulus.cycle(index)));
        if batch < 10 {
            for inputs in part.iter() {
                assert_eq!(session.cycle(inputs)?, whole.cycle(cycle));
                cycle += 1;
            }
            continue;
        }
        for outputs in session.run(&part)?.iter() {
            assert_eq!(outputs, whole.cycle(cycle));
            cycle += 1;
        }
    }
    assert_eq!((cycle, session.cycles()), (6000, 6000));
    session.finish()?;
    Ok(())
}

#[test]
fn wide_ports_keep_every_bit_and_show_the_inputs_of_the_same_cycle() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "iverilog"], "ports of 598 bits")? {
        return Ok(());
    }
    let design = wide();
    let (vertex, through, delayed) =
        (design.input("in_vertex")?, design.output("out_vertex")?, design.output("out_delayed")?);
    let mut numbers = Numbers(11);
    let mut stimulus = Cycles::new(design.input_words());
    let lane = |numbers: &mut Numbers| match numbers.next() >> 62 {
        0 => -(1 << 45),
        1 => (1 << 45) - 1,
        _ => (numbers.next() as i64) >> 18,
    };
    let vertices: Vec<[i64; 13]> = (0..500).map(|_| std::array::from_fn(|_| lane(&mut numbers))).collect();
    for lanes in &vertices {
        stimulus.push_with(|words| {
            // Bits above the port must not reach the design.
            words[9] = u64::MAX << 22;
            lanes.iter().enumerate().for_each(|(index, &value)| vertex.set_lane(words, 46, index, value));
        });
    }
    for simulator in both_simulators(&design)? {
        let response = simulator.run(&stimulus)?;
        assert_eq!(response.first_unknown(), None);
        for (cycle, words) in response.values.iter().enumerate() {
            let before = cycle.checked_sub(1).map_or([0; 13], |before| vertices[before]);
            for index in 0..13 {
                assert_eq!(through.lane(words, 46, index), vertices[cycle][index], "{}", simulator.name());
                assert_eq!(delayed.lane(words, 46, index), before[index], "{}", simulator.name());
            }
            assert_eq!(through.get(words)[9] >> 22, 0, "{}: spare bits are clear", simulator.name());
        }
    }
    Ok(())
}

#[test]
fn ram_reads_its_file_and_what_was_written() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "iverilog"], "a RAM with contents from a file")? {
        return Ok(());
    }
    let design = ram();
    let (address, write, word) = (design.input("in_address")?, design.input("in_write")?, design.input("in_word")?);
    let out = design.output("out_word")?;
    let mut contents: Vec<u64> = std::fs::read_to_string(fixture("relief_ram.hex"))?
        .lines()
        .map(|line| u64::from_str_radix(line, 16))
        .collect::<Result<_, _>>()?;
    assert_eq!(contents.len(), 1024);
    let mut numbers = Numbers(5);
    let mut stimulus = Cycles::new(design.input_words());
    let mut expected = vec![None];
    for cycle in 0..3000u64 {
        // Every word once, then reads and writes anywhere.
        let at = if cycle < 1024 { cycle } else { numbers.next() >> 54 };
        let (writes, new) = (cycle >= 1024 && numbers.next() >> 63 == 0, numbers.next() >> 48);
        stimulus.push_with(|words| {
            address.set(words, at);
            write.set(words, writes.into());
            word.set(words, new);
        });
        expected.push(Some(contents[at as usize]));
        if writes {
            contents[at as usize] = new;
        }
    }
    for simulator in both_simulators(&design)? {
        let response = simulator.run(&stimulus)?;
        for (words, expected) in response.values.iter().zip(&expected).skip(1) {
            assert_eq!(Some(out.unsigned(words)), *expected, "{}", simulator.name());
        }
        // The register has no reset: Icarus knows that nobody set it, and for one cycle only.
        if let Some(unknown) = &response.unknown {
            assert_eq!(unknown.cycle(0), [0xffff]);
            assert_eq!(response.first_unknown(), Some(0));
            assert!(unknown.iter().skip(1).all(|words| words == [0]));
        }
    }
    // Verilator shows the same dependence by starting from something else.
    let model = Verilator::new().build(&design)?;
    let first = |power_up| -> Result<u64, CosimError> {
        let mut session = model.start_with(power_up, None)?;
        Ok(out.unsigned(session.cycle(stimulus.cycle(0))?))
    };
    assert_eq!((first(PowerUp::Zeros)?, first(PowerUp::Ones)?), (0, 0xffff));
    assert_eq!(first(PowerUp::Random(9))?, first(PowerUp::Random(9))?);
    Ok(())
}

#[test]
fn unknown_bits_are_said_to_be_unknown() {
    let design = Design::new("top", vec![], vec![Port::output("out_a", 9), Port::output("out_b", 4)]);
    let words = |pairs: &[[u64; 2]]| {
        let mut cycles = Cycles::new(2);
        pairs.iter().for_each(|pair| cycles.push(pair));
        cycles
    };
    let expected = words(&[[0x1a5, 3], [0x1a5, 3]]);
    let got = Response { values: words(&[[0x1a5, 3], [0x105, 3]]), unknown: Some(words(&[[0, 0], [0x020, 0]])) };
    let difference = first_difference(&design, &expected, &got, |_, _| true).expect("a difference");
    assert_eq!(difference.to_string(), "in cycle 1 `out_a` is 0x1x5, and 0x1a5 was expected");
    assert_eq!(first_difference(&design, &expected, &got, |_, port| port.name == "out_b"), None);
    let short = Response { values: words(&[[0x1a5, 3]]), unknown: None };
    let difference = first_difference(&design, &expected, &short, |_, _| true).expect("a difference");
    assert_eq!((difference.cycle, difference.got.as_str()), (1, "the end"));
}

#[test]
fn builds_are_kept_and_several_at_once_make_one() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "building several times at once")? {
        return Ok(());
    }
    let cache = tempfile::tempdir()?;
    let (stimulus, expected) = adder_run(50)?;
    let design = adder("relief_adder");
    let build = || Verilator::new().cache(cache.path()).build(&design);
    let models = thread::scope(|scope| {
        let builders: Vec<_> = (0..3).map(|_| scope.spawn(build)).collect();
        builders.into_iter().map(|builder| builder.join().expect("no panic")).collect::<Result<Vec<_>, _>>()
    })?;
    let matters = adder_matters(&design, &expected)?;
    for model in &models {
        assert_eq!(model.executable(), models[0].executable());
        assert_eq!(first_difference(&design, &expected, &model.run(&stimulus)?, &matters), None);
    }
    assert!(build()?.was_cached());
    let programs = std::fs::read_dir(cache.path())?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.starts_with("relief_adder-") && !name.ends_with(".lock"));
    assert_eq!(programs.count(), 1);
    // Another text is another program, even under the same name.
    let other = tempfile::tempdir()?;
    let text = std::fs::read_to_string(fixture("relief_adder.sv"))?.replace("+ {in_right", "- {in_right");
    std::fs::write(other.path().join("relief_adder.sv"), text)?;
    let design = Design::new("relief_adder", vec![other.path().join("relief_adder.sv")], adder_ports());
    let model = Verilator::new().cache(cache.path()).build(&design)?;
    assert!(!model.was_cached());
    assert!(first_difference(&design, &expected, &model.run(&stimulus)?, &matters).is_some());
    Ok(())
}

#[test]
fn dump_holds_exactly_the_window() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "a waveform out of Verilator")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let design = adder("relief_adder");
    let (stimulus, _) = adder_run(400)?;
    let model = Verilator::new().traced().build(&design)?;
    let dump = Dump { path: folder.path().join("adder.vcd"), window: 120..170 };
    let mut session = model.start_with(PowerUp::Zeros, Some(&dump))?;
    let response = session.run(&stimulus)?;
    session.finish()?;
    let waves = relief_waves::read(&dump.path)?;
    assert_eq!(waves.cycles(), dump.window);
    let (ready, valid, sum) = (design.output("in_ready")?, design.output("out_valid")?, design.output("out_sum")?);
    let left = design.input("in_left")?;
    let read = |name: &str, cycle| {
        waves.value(name, cycle).and_then(relief_waves::Value::unsigned).unwrap_or_else(|| panic!("{name} at {cycle}"))
    };
    for cycle in dump.window.clone() {
        let (inputs, outputs) = (stimulus.cycle(cycle as usize), response.cycle(cycle as usize));
        for (name, value) in [
            ("TOP.in_ready", ready.unsigned(outputs)),
            ("TOP.out_valid", valid.unsigned(outputs)),
            ("TOP.out_sum", sum.unsigned(outputs)),
            ("TOP.in_left", left.unsigned(inputs)),
        ] {
            assert_eq!(read(name, cycle), value.into(), "{name} in cycle {cycle}");
        }
    }
    let untraced = Verilator::new().build(&design)?.start_with(PowerUp::Zeros, Some(&dump));
    assert!(matches!(untraced, Err(CosimError::Design { .. })));
    Ok(())
}

#[test]
fn design_reads_its_folder_and_refuses_nonsense() -> Outcome {
    let design = Design::from_folder(fixture(""), "relief_adder", adder_ports())?;
    assert_eq!(design.sources, [fixture("relief_adder.sv")]);
    assert_eq!(design.clock.as_deref(), Some("clock"));
    assert!(design.ports.iter().all(|port| port.name != "clock"));
    let words = design.input_words() + design.output_words();
    assert_eq!(words, 5 + 3);
    assert_eq!(
        design.input("in_middle").unwrap_err().to_string(),
        "the design `relief_adder` has no input `in_middle`"
    );
    let twice = Design::new("top", design.sources.clone(), vec![Port::input("a", 1), Port::output("a", 1)]);
    let error = Icarus::new().build(&twice).unwrap_err().to_string();
    assert_eq!(error, "the design `top` cannot be built: the port `a` stands twice");
    assert!(Design::from_folder(fixture("none"), "top", vec![]).is_err());
    Ok(())
}

#[test]
fn failures_are_told_in_the_words_of_the_tool() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "iverilog"], "designs that do not build")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let source = folder.path().join("relief_broken.sv");
    let design = Design::new("relief_broken", vec![source.clone()], vec![Port::input("in_a", 1)]);
    std::fs::write(&source, "module relief_broken (input wire clock, input wire in_a);\n  assign = 1;\nendmodule\n")?;
    let verilator = Verilator::new().cache(folder.path()).build(&design).unwrap_err().to_string();
    assert!(verilator.starts_with("translating `relief_broken` with Verilator failed with code 1"), "{verilator}");
    assert!(verilator.contains("relief_broken.sv:2:"), "{verilator}");
    let icarus = Icarus::new().build(&design).unwrap_err().to_string();
    assert!(icarus.contains("building `relief_broken` with Icarus failed"), "{icarus}");
    assert!(icarus.contains("syntax error"), "{icarus}");
    assert!(iverilog_accepts(&design).is_err());
    let lint = verilator_lint(&design, &[])?;
    assert!(lint.iter().any(|message| message.severity == Severity::Error && message.line == 2), "{lint:?}");

    // A design that ends by itself, in both simulators.
    let text = "module relief_broken (input wire clock, input wire in_a);\n  always @(posedge clock) if (in_a) begin\n    \
                $display(\"enough\");\n    $finish;\n  end\nendmodule\n";
    std::fs::write(&source, text)?;
    let mut stimulus = Cycles::zeros(1, 5);
    stimulus.push(&[1]);
    (0..20_000).for_each(|_| stimulus.push(&[0]));
    let simulators: [Box<dyn Simulator>; 2] =
        [Box::new(Verilator::new().cache(folder.path()).build(&design)?), Box::new(Icarus::new().build(&design)?)];
    for simulator in simulators {
        let error = simulator.run(&stimulus).unwrap_err();
        assert!(matches!(error, CosimError::Ended { cycles: 6, .. }), "{}: {error}", simulator.name());
        assert!(error.to_string().contains("enough"), "{}: {error}", simulator.name());
    }
    let wrong = Icarus::new().build(&design)?.run(&Cycles::zeros(2, 1)).unwrap_err();
    assert_eq!(wrong.to_string(), "the design `relief_broken` takes 1 words a cycle, and the stimulus has 2");
    Ok(())
}

#[test]
fn commands_that_do_not_end_are_stopped() -> Outcome {
    if !tools::require_all(&["iverilog"], "a simulation without end")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let source = folder.path().join("relief_endless.sv");
    let text = "module relief_endless (input wire clock, input wire in_a);\n  always @(posedge clock) while (1);\n\
                endmodule\n";
    std::fs::write(&source, text)?;
    let design = Design::new("relief_endless", vec![source], vec![Port::input("in_a", 1)]);
    let model = Icarus::new().limit(Duration::from_secs(1)).build(&design)?;
    let start = Instant::now();
    let error = model.run(&Cycles::zeros(1, 5)).unwrap_err();
    assert!(matches!(error, CosimError::Timeout { .. }), "{error}");
    assert!(start.elapsed() < Duration::from_secs(20));
    Ok(())
}

#[test]
fn lint_finds_the_latch_and_honours_waivers() -> Outcome {
    if !tools::require_all(&["verilator", "iverilog"], "the linters")? {
        return Ok(());
    }
    for design in [adder("relief_adder"), wide(), ram()] {
        assert_eq!(verilator_lint(&design, &[])?, [], "{}", design.top);
        assert_eq!(iverilog_accepts(&design)?, [], "{}", design.top);
    }
    let messages = verilator_lint(&latch(), &[])?;
    let found: Vec<_> = messages.iter().map(|message| (message.rule.as_str(), message.line)).collect();
    assert!(found.contains(&("LATCH", 11)), "{messages:?}");
    assert!(found.iter().any(|(rule, line)| rule.starts_with("WIDTH") && *line == 15), "{messages:?}");
    assert!(messages.iter().all(|message| message.file == "relief_latch.sv"));
    let because = "to see that it is waived";
    let waived = verilator_lint(&latch(), &[Waiver { rule: "LATCH", file: None, because }])?;
    assert!(waived.len() < messages.len() && waived.iter().all(|message| message.rule != "LATCH"));
    let elsewhere = Waiver { rule: "LATCH", file: Some("relief_adder.sv"), because };
    assert_eq!(verilator_lint(&latch(), &[elsewhere])?, messages);
    Ok(())
}

fn latch() -> Design {
    let ports = vec![
        Port::input("in_enable", 1),
        Port::input("in_word", 8),
        Port::output("out_word", 8),
        Port::output("out_sum", 8),
    ];
    Design::new("relief_latch", vec![fixture("relief_latch.sv")], ports)
}

#[test]
fn synthesis_counts_cells_and_finds_latches() -> Outcome {
    if !tools::require_all(&["yosys"], "synthesis")? {
        return Ok(());
    }
    let adder = yosys_synth_ecp5(&adder("relief_adder"))?;
    assert_eq!((adder.flip_flops, adder.block_rams, adder.multipliers), (34, 0, 0), "{adder}");
    assert!(adder.luts > 0 && adder.carries >= 16, "{adder}");
    assert!(adder.latches.is_empty());
    // 16 Kbit fit one block.
    let ram = yosys_synth_ecp5(&ram())?;
    assert_eq!((ram.block_rams, ram.distributed_rams), (1, 0), "{ram}");
    let latch = yosys_synth_ecp5(&latch())?;
    assert_eq!(latch.latches, ["relief_latch.out_word"], "{latch}");
    let missing = Design::new("relief_none", vec![fixture("relief_adder.sv")], vec![]);
    let error = yosys_synth_ecp5(&missing).unwrap_err().to_string();
    assert!(error.contains("ERROR"), "{error}");
    Ok(())
}

#[test]
fn batches_run_at_speed() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "the speed of a batch")? {
        return Ok(());
    }
    // How fast is printed and not asserted: a busy machine is no fault of the code.
    for (design, cycles) in [(adder("relief_adder"), 400_000), (wide(), 40_000)] {
        let model = Verilator::new().build(&design)?;
        let mut numbers = Numbers(2);
        let mut stimulus = Cycles::new(design.input_words());
        (0..cycles).for_each(|_| stimulus.push_with(|words| words.fill_with(|| numbers.next())));
        let start = Instant::now();
        let response = model.run(&stimulus)?;
        let seconds = start.elapsed().as_secs_f64();
        assert_eq!(response.values.len(), cycles);
        let megabytes = (cycles * (design.input_words() + design.output_words()) * 8) as f64 / 1e6;
        let (rate, flow) = (cycles as f64 / seconds / 1e6, megabytes / seconds);
        println!("{}: {rate:.2} M cycles/s, {flow:.0} MB/s both ways", design.top);
        let mut session = model.start()?;
        let start = Instant::now();
        for index in 0..2000 {
            session.cycle(stimulus.cycle(index))?;
        }
        println!("{}: {:.0} k cycles/s one by one", design.top, 2.0 / start.elapsed().as_secs_f64());
    }
    Ok(())
}
