// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief blocks`, `check`, `sim` and `emit` as a program, and what they write as other tools see it.

use relief_hdl::widths::WIDTH_SETS;
use relief_testbench::binding::{BLOCKS, offers};
use relief_testbench::check::emitted;
use relief_testbench::cosim::{iverilog_accepts, tools, verilator_lint, yosys_synth_ecp5};
use relief_testbench::stimulus::parse_stimulus;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const NAMES: [&str; 25] = [
    "vertex_adder",
    "strip_unit",
    "remesher",
    "mip_build",
    "mip_fetch",
    "sat_build",
    "sat_fetch",
    "sat_fetch_parallel",
    "sat_average",
    "bisector",
    "reciprocal",
    "rsqrt",
    "perspective_correct",
    "filter_level",
    "exact_footprint",
    "facing",
    "displace",
    "power",
    "face_normal",
    "gradient_normal",
    "light",
    "vertex_transform",
    "cull",
    "clip",
    "displacement_pipeline",
];

/// Exit code, stdout and stderr.
fn finish(command: &mut Command) -> (Option<i32>, String, String) {
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn relief(arguments: &[&str]) -> (Option<i32>, String, String) {
    finish(Command::new(env!("CARGO_BIN_EXE_relief")).args(arguments))
}

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

/// Every file below a folder.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            found.extend(files(&entry.path()).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else {
            found.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    found
}

/// Builds and runs the emitted test bench of a block as its head says; no code when it cannot be built.
fn run_bench(folder: &Path, block: &str, options: &[&str]) -> (Option<i32>, String) {
    let bench = format!("relief_{block}_tb.sv");
    let mut build = Command::new("iverilog");
    build.args(["-g2012", "-o", "tb.vvp", "-f", "filelist.f", &bench]).current_dir(folder);
    let (code, stdout, stderr) = finish(&mut build);
    if code != Some(0) {
        return (None, format!("{stdout}{stderr}"));
    }
    // A design that never settles would fill the memory.
    let bounded = "ulimit -v 4000000; exec timeout 60 vvp -n tb.vvp \"$@\"";
    let mut run = Command::new("sh");
    run.args(["-c", bounded, "vvp"]).args(options).current_dir(folder);
    let (code, stdout, stderr) = finish(&mut run);
    (code.or(Some(-1)), format!("{stdout}{stderr}"))
}

#[test]
fn cli_blocks_lists_every_block() {
    let (code, text, _) = relief(&["blocks"]);
    assert_eq!(code, Some(0));
    assert!(NAMES.iter().all(|name| text.contains(&format!("{name}: "))), "{text}");
    let (code, json, _) = relief(&["blocks", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let names: Vec<_> = json.as_array().unwrap().iter().map(|block| block["name"].as_str().unwrap()).collect();
    assert_eq!((code, names), (Some(0), NAMES.to_vec()));
    assert_eq!(json[0]["width_sets"].as_array().unwrap().len(), WIDTH_SETS.len());
}

#[test]
fn cli_bad_input_exits_with_2_and_says_what_would_be_right() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(folder.path(), "out");
    let stimulus = path(folder.path(), "stimulus.txt");
    let late = path(folder.path(), "late.vcd");
    fs::write(&stimulus, "# nothing\n 1 2 3\n").unwrap();
    let block = "there is no block `adder`; the blocks are vertex_adder, strip_unit, remesher, mip_build, mip_fetch, sat_build, \
         sat_fetch, sat_fetch_parallel, sat_average";
    let set =
        "there is no width set `huge`; --param takes default, large, position, terrain, terrain_large, small, deep";
    for (arguments, sentence) in [
        (vec!["check", "adder"], block),
        (vec!["sim", "adder"], block),
        (vec!["emit", "adder", "--out", &out], block),
        (vec!["check", "--param", "huge"], set),
        (vec!["sim", "remesher", "--param", "huge"], set),
        (vec!["emit", "--out", &out, "--param", "huge"], set),
        (vec!["check", "--engine", "vcs"], "there is no engine `vcs`; the engines are rust, verilator, icarus, all"),
        (vec!["sim", "remesher", "--engine", "all"], "there is no engine `all`"),
        (vec!["check", "--vectors", "0"], "--vectors is 0, and a check of nothing would agree"),
        (vec!["sim", "remesher", "--random", "0"], "the stimulus has no beat"),
        (vec!["sim", "remesher", "--idle", "100"], "a whole number from 0 to 99 is expected"),
        (vec!["check", "--vectors", "-1"], "a whole number from 0 to "),
        (vec!["emit", "--out", &out, "--vectors", "abc"], "a whole number from 1 to 100000 is expected"),
        (vec!["sim", "remesher", "--cycles", "9..9"], "a window is A..B with A below B, such as 100..164"),
        (vec!["sim", "vertex_adder", "--stimulus", "/none"], "/none: cannot be opened: "),
        (vec!["sim", "vertex_adder", "--stimulus", &stimulus], "stimulus.txt:2: the line has 3 numbers, and 18 make"),
        (
            vec!["sim", "vertex_adder", "--random", "5", "--cycles", "900..950", "--vcd", &late],
            "--cycles is 900..950, and the run has only ",
        ),
    ] {
        let (code, stdout, stderr) = relief(&arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {stdout}{stderr}");
        assert!(stderr.contains(sentence), "{arguments:?}: {stderr}");
    }
    // Nothing was written, not even in part.
    assert_eq!(files(folder.path()).into_keys().collect::<Vec<_>>(), ["stimulus.txt"]);
}

#[test]
fn cli_sim_stimulus_file_says_where_it_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(folder.path(), "beats.txt");
    let sim = |text: &str| {
        fs::write(&file, text).unwrap();
        relief(&["sim", "vertex_adder", "--param", "position", "--stimulus", &file])
    };
    let (code, stdout, stderr) = sim("1 2 3 4 5 6 # sum 5 7 9\n\n# nothing\n-35184372088832 0 0 -1 0 0\n");
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    assert!(stdout.contains("\n2 vectors, 2 beats, "), "{stdout}");
    assert!(stdout.ends_with(": agreed with the golden model\n"), "{stdout}");
    for (text, sentence) in [
        ("1 2 3 4 5 6\n1 2 x 4 5 6\n", "beats.txt:2: `x` is no integer of 64 bits"),
        ("1 2 3 4 5\n", "beats.txt:1: the line has 5 numbers, and 6 make a beat"),
        (
            "\n\n35184372088832 0 0 0 0 0\n",
            "beats.txt:3: number 1 is 35184372088832, which does not fit -3518437208883",
        ),
        ("# nothing\n", "the stimulus has no beat"),
    ] {
        let (code, _, stderr) = sim(text);
        assert_eq!(code, Some(2));
        assert!(stderr.contains(sentence), "{stderr}");
    }
}

#[test]
fn cli_sim_draws_and_records_the_window() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (vcd, svg) = (path(folder.path(), "run.vcd"), path(folder.path(), "run.svg"));
    let run = |engine: &str| {
        relief(&[
            "sim",
            "strip_unit",
            "--param",
            "small",
            "--random",
            "200",
            "--seed",
            "7",
            "--idle",
            "20",
            "--stall",
            "30",
            "--engine",
            engine,
            "--vcd",
            &vcd,
            "--svg",
            &svg,
            "--cycles",
            "40..60",
        ])
    };
    let (code, stdout, stderr) = run("rust");
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    assert_eq!(files(folder.path()).into_keys().collect::<Vec<_>>(), ["run.gtkw", "run.svg", "run.vcd"]);
    let waves = relief_waves::read(&vcd)?;
    assert_eq!(waves.cycles(), 40..60);
    assert!(waves.trace("strip_unit.in_valid").is_some_and(|trace| trace.changes() > 1));
    let from_rust = waves.trace("strip_unit.out_valid").cloned();
    let picture = fs::read(&svg)?;
    assert!(picture.starts_with(b"<svg"));
    assert!(fs::read_to_string(path(folder.path(), "run.gtkw"))?.contains("strip_unit.in_valid"));

    if !tools::require_all(&["verilator", "g++"], "the waveform of Verilator")? {
        return Ok(());
    }
    let (code, stdout, stderr) = run("verilator");
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    assert_eq!(files(folder.path()).into_keys().collect::<Vec<_>>(), ["run.gtkw", "run.svg", "run.vcd"]);
    let waves = relief_waves::read(&vcd)?;
    let valid = waves.trace("TOP.out_valid").ok_or("Verilator's waveform has no TOP.out_valid")?;
    let first = waves.cycles().start;
    let from_rust = from_rust.ok_or("no trace")?;
    // Verilator counts from power-up, two cycles of reset earlier.
    let offset = (42 - first) as usize;
    for cycle in 0..18 {
        let high = |value: Option<&relief_waves::Value>| value.is_some_and(relief_waves::Value::is_high);
        assert_eq!(high(valid.at_edge(cycle + offset)), high(from_rust.at_edge(cycle)), "cycle {cycle}");
    }
    // The picture shows the same streams, whoever else was compared.
    assert_eq!(fs::read(&svg)?, picture.to_vec());
    Ok(())
}

/// A link leads to what is replaced, a pipe is written as it is, and a refused command leaves no file behind.
#[test]
fn cli_outputs_appear_whole_or_not_at_all() -> Outcome {
    let folder = tempfile::tempdir()?;
    let at = |name: &str| path(folder.path(), name);
    let sim =
        |options: &[&str]| relief(&[&["sim", "vertex_adder", "--param", "small", "--random", "80"], options].concat());
    fs::write(at("target.svg"), "old")?;
    std::os::unix::fs::symlink(at("target.svg"), at("link.svg"))?;
    assert_eq!(sim(&["--svg", &at("link.svg")]).0, Some(0));
    assert!(fs::symlink_metadata(at("link.svg"))?.is_symlink());
    assert!(fs::read(at("target.svg"))?.starts_with(b"<svg"));
    assert!(Command::new("mkfifo").arg(at("pipe")).status()?.success());
    let pipe = at("pipe");
    let reader = std::thread::spawn(move || fs::read(pipe));
    assert_eq!(
        relief(&["check", "vertex_adder", "--vectors", "20", "--engine", "rust", "--junit", &at("pipe")]).0,
        Some(0)
    );
    assert!(reader.join().map_err(|_| "the reader panicked")??.starts_with(b"<?xml"));

    fs::create_dir(at("folder"))?;
    let before: Vec<_> =
        fs::read_dir(folder.path())?.map(|entry| entry.map(|entry| entry.file_name())).collect::<Result<_, _>>()?;
    let wave = at("a.vcd");
    for (options, sentence) in [
        (vec!["--vcd", &at("folder")], "is a folder; a file is expected"),
        (vec!["--vcd", &at("a.gtkw")], "give a name such as wave.vcd"),
        (vec!["--vcd", &wave, "--svg", &wave], "would replace the waveform"),
        (vec!["--vcd", &wave, "--cycles", "900..950"], "the run has only "),
        (vec!["--svg", &at("nowhere/a.svg")], "cannot be written"),
        (vec!["--sources", &at("folder")], "give --engine verilator"),
    ] {
        let (code, _, stderr) = sim(&options);
        assert!(code == Some(2) && stderr.contains(sentence), "{options:?}: {stderr}");
    }
    fs::write(at("folder/vertex_adder"), "a file")?;
    let (code, _, stderr) = relief(&["emit", "--param", "small", "--vectors", "5", "--out", &at("folder")]);
    assert!(code == Some(2) && stderr.contains("is a file; a folder is expected"), "{stderr}");
    assert_eq!(files(Path::new(&at("folder"))).into_keys().collect::<Vec<_>>(), ["vertex_adder"]);
    let after: Vec<_> =
        fs::read_dir(folder.path())?.map(|entry| entry.map(|entry| entry.file_name())).collect::<Result<_, _>>()?;
    assert_eq!(before.len(), after.len(), "{after:?}");
    Ok(())
}

#[test]
fn cli_emit_leaves_no_module_of_another_width_set() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = path(folder.path(), "out");
    for set in ["position", "small"] {
        assert_eq!(relief(&["emit", "remesher", "--param", set, "--vectors", "5", "--out", &out]).0, Some(0));
    }
    let modules: Vec<_> = files(Path::new(&out)).into_keys().filter(|name| name.ends_with(".sv")).collect();
    let list = fs::read_to_string(path(folder.path(), "out/remesher/filelist.f"))?;
    // The test bench is in no list.
    assert_eq!(modules.len(), list.lines().count() + 1, "{modules:?}");
    Ok(())
}

#[test]
fn cli_check_refuses_sources_of_another_width_set() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = path(folder.path(), "out");
    assert_eq!(relief(&["emit", "vertex_adder", "--param", "position", "--vectors", "5", "--out", &out]).0, Some(0));
    let sources = path(folder.path(), "out/vertex_adder");
    if !tools::require_all(&["iverilog", "vvp"], "sources of another width set")? {
        return Ok(());
    }
    let check = |options: &[&str]| {
        relief(&[&["check", "vertex_adder", "--vectors", "50", "--sources", &sources], options].concat())
    };
    let (code, _, stderr) = check(&["--engine", "icarus", "--param", "small"]);
    assert!(code == Some(2) && stderr.contains("has 138 bits, and 315 are expected"), "{stderr}");
    let (code, _, stderr) = check(&["--engine", "rust", "--param", "position"]);
    assert!(code == Some(2) && stderr.contains("give --engine verilator"), "{stderr}");
    assert_eq!(check(&["--engine", "icarus", "--param", "position"]).0, Some(0));
    Ok(())
}

/// Any bytes are beats or a sentence with a line.
#[test]
fn cli_stimulus_reader_takes_arbitrary_bytes() {
    use proptest::prelude::*;
    let number =
        prop_oneof![Just("0".into()), Just("-1".into()), any::<i64>().prop_map(|n| n.to_string()), "[ -~]{0,6}"];
    let text = prop::collection::vec(prop::collection::vec(number, 0..20).prop_map(|words| words.join(" ")), 0..6)
        .prop_map(|lines| lines.join("\n").into_bytes());
    let bytes = prop_oneof![prop::collection::vec(any::<u8>(), 0..200), text];
    let config = ProptestConfig { cases: 2_000, failure_persistence: None, ..ProptestConfig::default() };
    proptest!(config, |(bytes in bytes, block in 0..BLOCKS.len(), set in 0..WIDTH_SETS.len())| {
        if let Err(error) = parse_stimulus(BLOCKS[block], &WIDTH_SETS[set], "beats", &bytes) {
            prop_assert!(error.to_string().starts_with("beats:") && error.to_string().contains("a beat of "), "{}", error);
        }
    });
}

#[test]
fn cli_check_leaves_out_what_is_not_installed_but_not_in_ci() {
    let check = |ci: Option<&str>, engine: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
        command.args(["check", "vertex_adder", "--vectors", "100", "--engine", engine]).env("PATH", "/nowhere");
        match ci {
            Some(value) => command.env("CI", value),
            None => command.env_remove("CI"),
        };
        finish(&mut command)
    };
    let (code, stdout, stderr) = check(None, "all");
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    assert!(stderr.contains("SKIPPED verilator: install the Debian package verilator\n"), "{stderr}");
    assert!(stderr.contains("SKIPPED icarus: install the Debian package iverilog\n"), "{stderr}");
    assert_eq!(stdout.lines().filter(|line| line.ends_with("  SKIPPED")).count(), 2);
    for (ci, engine) in [(Some("true"), "all"), (None, "icarus")] {
        let (code, _, stderr) = check(ci, engine);
        assert_eq!(code, Some(2));
        assert!(stderr.contains("is missing: install the Debian package "), "{stderr}");
    }
}

#[test]
fn cli_check_compares_every_block_in_every_engine() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "iverilog"], "the check in every engine")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let junit = path(folder.path(), "junit.xml");
    let (code, stdout, stderr) =
        relief(&["check", "--vectors", "200", "--param", "small", "--seed", "3", "--junit", &junit]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let mut rows = Vec::new();
    for line in stdout.lines().skip(1) {
        let words: Vec<&str> = line.split_whitespace().collect();
        assert_eq!((words[1], words[3], words[6]), ("small", "200", "agreed"), "{line}");
        // The design of all blocks has no draw yet, see below.
        let sends = words[0] == "displacement_pipeline" || words[4].parse::<u64>()? > 30;
        assert!(sends && words[5].parse::<u64>()? > 200, "{line}");
        rows.push((words[0], words[2], words[5]));
    }
    for (block, rows) in NAMES.iter().zip(rows.chunks(3)) {
        assert_eq!(rows.iter().map(|row| row.1).collect::<Vec<_>>(), ["rust", "verilator", "icarus"]);
        // Every engine has seen the very same cycles.
        assert!(rows.iter().all(|row| row.0 == *block && row.2 == rows[0].2), "{rows:?}");
    }
    assert_eq!(rows.len(), 3 * NAMES.len());
    let junit = fs::read_to_string(&junit)?;
    let cases = junit.matches("<testcase ").count();
    assert_eq!((cases, junit.matches("<failure").count()), (3 * NAMES.len(), 0), "{junit}");

    let design = ["check", "displacement_pipeline", "--vectors", "600", "--param", "small", "--seed", "3"];
    let (code, stdout, stderr) = relief(&design);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let beats = |line: &str| line.split_whitespace().nth(4)?.parse::<u64>().ok();
    assert!(stdout.lines().skip(1).filter_map(beats).filter(|beats| *beats > 30).count() == 3, "{stdout}");
    Ok(())
}

#[test]
fn cli_check_mismatch_carries_what_repeats_it() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "iverilog"], "the check of a faulty design")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let out = path(folder.path(), "out");
    assert_eq!(relief(&["emit", "vertex_adder", "--param", "position", "--out", &out]).0, Some(0));
    let sources = path(folder.path(), "out/vertex_adder");
    let module = path(folder.path(), "out/vertex_adder/relief_vertex_adder.sv");
    let text = fs::read_to_string(&module)?;
    assert!(text.contains(" + "), "{text}");
    fs::write(&module, text.replacen(" + ", " - ", 1))?;
    let junit = path(folder.path(), "junit.xml");
    for engine in ["verilator", "icarus"] {
        let (code, stdout, stderr) = relief(&[
            "check",
            "vertex_adder",
            "--param",
            "position",
            "--engine",
            engine,
            "--sources",
            &sources,
            "--junit",
            &junit,
        ]);
        assert_eq!((code, stderr.as_str()), (Some(1), ""), "{stdout}");
        let said = format!("MISMATCH vertex_adder, width set position, engine {engine}, seed 1000: beat ");
        assert!(stdout.contains(&said) && stdout.contains("port out_"), "{stdout}");
        assert!(fs::read_to_string(&junit)?.contains("<failure"));
        let waveform = stdout.lines().find_map(|line| line.trim().strip_prefix("waveform: ")).ok_or("no waveform")?;
        let waveform = waveform.split(" (").next().ok_or("no waveform")?;
        assert!(relief_waves::read(waveform)?.trace("vertex_adder.in_valid").is_some());
        let replay =
            stdout.lines().find_map(|line| line.trim().strip_prefix("replay:   relief ")).ok_or("no replay")?;
        let (code, again, _) = relief(&replay.split(' ').collect::<Vec<_>>());
        let place = |text: &str| text.split_once("beat ").map(|(_, place)| place.lines().next().map(str::to_owned));
        assert_eq!((code, place(&again)), (Some(1), place(&stdout)), "{again}");
    }
    Ok(())
}

#[test]
fn cli_emit_writes_the_same_bytes_each_time() {
    let folder = tempfile::tempdir().unwrap();
    let emit = |name: &str| {
        let out = path(folder.path(), name);
        let (code, stdout, stderr) = relief(&["emit", "--param", "small", "--vectors", "40", "--out", &out]);
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
        files(Path::new(&out))
    };
    let first = emit("first");
    assert_eq!(first, emit("second"));
    // Once more over the same folder: nothing is added, and nothing is left over.
    assert_eq!(first, emit("first"));
    for block in NAMES {
        for name in ["filelist.f", "in.hex", "out.hex", &format!("relief_{block}.sv"), &format!("relief_{block}_tb.sv")]
        {
            assert!(first.contains_key(&format!("{block}/{name}")), "{block}/{name}");
        }
        assert_eq!(first[&format!("{block}/in.hex")].iter().filter(|&&byte| byte == b'\n').count(), 40);
    }
    assert!(first.keys().all(|name| !name.contains("/.")), "{:?}", first.keys());
}

#[test]
fn cli_emitted_bench_passes_without_rust() -> Outcome {
    if !tools::require_all(&["iverilog", "vvp"], "the emitted test benches")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let out = path(folder.path(), "out");
    for block in NAMES {
        // A draw through all blocks is constants, a map and vertices before its first triangle.
        let vectors = if block == "displacement_pipeline" { "600" } else { "120" };
        assert_eq!(relief(&["emit", block, "--param", "small", "--vectors", vectors, "--out", &out]).0, Some(0));
        let folder = Path::new(&out).join(block);
        let beats = fs::read_to_string(folder.join("out.hex"))?.lines().count();
        assert!(beats > 10);
        for options in [&[][..], &["+idle=0", "+stall=0"], &["+idle=60", "+stall=60", "+seed=9"]] {
            let (code, said) = run_bench(&folder, block, options);
            let pass = format!("PASS: {vectors} of {vectors} beats in, {beats} of {beats} beats out, ");
            assert!(code == Some(0) && said.contains(&pass), "{block} {options:?}: {said}");
        }
        // One golden bit turned round is noticed.
        let golden = fs::read_to_string(folder.join("out.hex"))?;
        let (head, last) = golden.trim_end().rsplit_once('\n').ok_or("one line")?;
        let (mask, value) = last.split_once('_').ok_or("no mask")?;
        let at = mask.find(|digit| digit != '0').ok_or("no bit counts")?;
        let counts = u8::from_str_radix(&mask[at..=at], 16)?;
        // Its lowest bit.
        let turned = u8::from_str_radix(&value[at..=at], 16)? ^ (counts & counts.wrapping_neg());
        let value = format!("{}{turned:x}{}", &value[..at], &value[at + 1..]);
        fs::write(folder.join("out.hex"), format!("{head}\n{mask}_{value}\n"))?;
        let (code, said) = run_bench(&folder, block, &[]);
        assert!(code != Some(0) && said.contains("FAIL: "), "{block}: {said}");
    }
    Ok(())
}

#[test]
fn cli_emitted_bench_passes_in_verilator() -> Outcome {
    if !tools::require_all(&["verilator", "g++", "make"], "the emitted test bench in Verilator")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let out = path(folder.path(), "out");
    assert_eq!(relief(&["emit", "strip_unit", "--param", "small", "--vectors", "80", "--out", &out]).0, Some(0));
    let folder = Path::new(&out).join("strip_unit");
    let text = fs::read_to_string(folder.join("relief_strip_unit_tb.sv"))?;
    let line =
        text.lines().find_map(|line| line.strip_prefix("//   $ verilator ")).ok_or("the head names no command")?;
    let (build, run) = line.split_once(" && ").ok_or("the head names no program")?;
    let (code, stdout, stderr) = finish(Command::new("verilator").args(build.split(' ')).current_dir(&folder));
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    let (code, stdout, stderr) = finish(Command::new(folder.join(run)).current_dir(&folder));
    assert!(code == Some(0) && stdout.contains("PASS: 80 of 80 beats in, "), "{stdout}{stderr}");
    Ok(())
}

/// What a slip of the pen would make of an operator or a constant.
const SLIPS: [(&str, &str); 12] = [
    (" + ", " - "),
    (" - ", " + "),
    (" & ", " | "),
    (" | ", " & "),
    (" && ", " || "),
    (" || ", " && "),
    (" == ", " != "),
    (" != ", " == "),
    (" < ", " >= "),
    (" >>> ", " >> "),
    ("1'd1;", "1'd0;"),
    ("1'd0;", "1'd1;"),
];

/// Sources with one slip each, at places spread over the source.
fn mutants(source: &str, wanted: usize) -> Vec<(usize, String)> {
    let lines: Vec<&str> = source.lines().collect();
    let mut places = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let code = line.split("//").next().unwrap_or("");
        if code.contains("initial") || code.contains("localparam") || code.contains("for (") {
            continue;
        }
        for (right, wrong) in SLIPS {
            for (at, _) in code.match_indices(right) {
                places.push((number, format!("{}{wrong}{}", &line[..at], &line[at + right.len()..])));
            }
        }
    }
    let step = (places.len() as f64 / wanted as f64).max(1.0);
    let chosen = (0..places.len().min(wanted)).map(|k| &places[(k as f64 * step) as usize]);
    let make = |(number, line): &(usize, String)| {
        let mut lines = lines.clone();
        lines[*number] = line;
        (number + 1, lines.join("\n") + "\n")
    };
    chosen.map(make).collect()
}

#[test]
fn cli_emitted_bench_notices_faults() -> Outcome {
    if !tools::require_all(&["iverilog", "vvp"], "faults in the emitted modules")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let out = path(folder.path(), "out");
    let (mut made, mut noticed, mut missed) = (0, 0, Vec::new());
    let runs = [
        ("vertex_adder", "20"),
        ("strip_unit", "3000"),
        ("remesher", "120"),
        ("mip_build", "2000"),
        ("mip_fetch", "2000"),
        ("sat_build", "1000"),
        ("sat_fetch", "2000"),
        ("sat_fetch_parallel", "2000"),
        ("sat_average", "500"),
        ("reciprocal", "1000"),
        ("rsqrt", "1000"),
        ("perspective_correct", "1000"),
        ("filter_level", "1000"),
        ("exact_footprint", "1000"),
        ("facing", "1000"),
        ("displace", "400"),
        ("power", "1000"),
        ("face_normal", "400"),
        ("gradient_normal", "400"),
        ("light", "400"),
        ("cull", "500"),
    ];
    for (block, vectors) in runs {
        assert_eq!(relief(&["emit", block, "--param", "position", "--vectors", vectors, "--out", &out]).0, Some(0));
        let folder = Path::new(&out).join(block);
        for module in fs::read_to_string(folder.join("filelist.f"))?.lines() {
            let file = folder.join(module);
            let source = fs::read_to_string(&file)?;
            let (mut of_module, mut tried) = (0, 0);
            for (line, mutant) in mutants(&source, 3) {
                fs::write(&file, mutant)?;
                let (code, said) = run_bench(&folder, block, &[]);
                // What Icarus refuses is no fault of the design.
                let Some(code) = code else { continue };
                tried += 1;
                match code == 0 && said.contains("PASS: ") {
                    true => missed.push(format!("{module}:{line}")),
                    false => of_module += 1,
                }
            }
            fs::write(&file, source)?;
            assert!(tried == 0 || of_module > 0, "{module}: none of {tried} faults was noticed");
            (made, noticed) = (made + tried, noticed + of_module);
        }
    }
    println!("{noticed} of {made} faults noticed; not noticed: {}", missed.join(", "));
    assert!(made >= 30 && noticed * 10 >= made * 8, "{noticed} of {made}; not noticed: {}", missed.join(", "));
    Ok(())
}

#[test]
fn cli_emitted_blocks_are_clean_at_every_width_set() -> Outcome {
    if !tools::require_all(&["verilator", "iverilog"], "lint of the emitted blocks")? {
        return Ok(());
    }
    let mut linted = 0;
    for (block, set) in offers() {
        let emitted = emitted(block, set, None)?;
        let verilator = verilator_lint(&emitted.design, &[])?;
        let icarus = iverilog_accepts(&emitted.design)?;
        assert!(verilator.is_empty() && icarus.is_empty(), "{} {}: {verilator:?} {icarus:?}", block.name(), set.name);
        linted += 1;
    }
    // Every block at the sets with nine components.
    assert!(linted >= BLOCKS.len() * WIDTH_SETS.iter().filter(|set| set.components == 9).count());
    assert_eq!(linted, offers().count());
    Ok(())
}

/// Blocks that take Yosys a minute or more each: hundreds of adders, or dozens of multipliers between sums.
const LARGE: [&str; 5] = ["remesher", "displace", "face_normal", "gradient_normal", "light"];

#[test]
fn cli_emitted_blocks_synthesize_to_what_they_should() -> Outcome {
    // The design of all blocks takes as long as they do together, which are counted here: `relief synth` does it.
    synthesize(|name| !LARGE.contains(&name) && name != "displacement_pipeline")
}

#[test]
#[ignore = "a minute each: cargo test --release --test cli -- --ignored"]
fn cli_large_emitted_blocks_synthesize_to_what_they_should() -> Outcome {
    synthesize(|name| LARGE.contains(&name))
}

/// Counts the cells of the blocks that are `wanted`, and compares them with those that the documents state.
fn synthesize(wanted: impl Fn(&str) -> bool) -> Outcome {
    if !tools::require_all(&["yosys"], "synthesis of the emitted blocks")? {
        return Ok(());
    }
    let set = WIDTH_SETS.iter().find(|set| set.name == "small").ok_or("no width set")?;
    // What the documents state.
    let figures = relief::synth::figures::Figures::read(Path::new(env!("CARGO_MANIFEST_DIR")))?;
    for block in BLOCKS.iter().filter(|block| wanted(block.name())) {
        let name = block.name();
        let rows = figures.rows.iter().filter(|row| row.set == set.name && row.target == "ecp5-85k");
        let stated = rows.into_iter().find(|row| row.block == name).ok_or(name)?;
        let report = yosys_synth_ecp5(&emitted(*block, set, None)?.design)?;
        println!("{name}: {report}");
        assert_eq!(report.latches, Vec::<String>::new(), "{name}");
        // Queues of eight or sixteen places, the sizes of sixteen levels, what eight walkers left, and delay lines of up to
        // sixteen words are all that is too small for block RAM.
        let distributed = match name {
            "strip_unit" => 54,
            "remesher" => 110,
            "mip_build" => 8,
            "mip_fetch" => 20,
            "bisector" => 110,
            "reciprocal" => 23,
            "rsqrt" => 23,
            "perspective_correct" => 115,
            "filter_level" => 105,
            "exact_footprint" => 60,
            "displace" => 350,
            "power" => 15,
            "face_normal" => 280,
            "gradient_normal" => 240,
            "light" => 1050,
            "vertex_transform" => 70,
            "clip" => 16,
            _ => 0,
        };
        assert!(report.distributed_rams <= distributed, "{name}: its memories belong into block RAM: {report}");
        // Versions of Yosys differ a little in what they find.
        let most = |stated: usize| stated + stated / 10;
        let luts = report.luts + 2 * report.carries + 4 * report.distributed_rams;
        assert!(luts > 0 && luts <= most(stated.lut), "{name}: {report}");
        // What stands behind a block RAM or a multiplier is counted in it there.
        let inside = 36 * (stated.bram + stated.dsp);
        assert!(report.flip_flops > 0 && report.flip_flops <= most(stated.ff) + inside, "{name}: {report}");
        assert_eq!([report.block_rams, report.multipliers], [stated.bram, stated.dsp], "{name}: {report}");
    }
    Ok(())
}

#[test]
fn cli_emitted_remesher_has_neither_latch_nor_loop() -> Outcome {
    if !tools::require_all(&["yosys"], "processes of the emitted remesher")? {
        return Ok(());
    }
    let set = WIDTH_SETS.iter().find(|set| set.name == "position").ok_or("no width set")?;
    let block = relief_testbench::binding::find("remesher").ok_or("no block")?;
    let emitted = emitted(block, set, None)?;
    let sources: Vec<String> = emitted.design.sources.iter().map(|file| format!("\"{}\"", file.display())).collect();
    let folder = emitted.design.sources[0].parent().ok_or("no folder")?.to_owned();
    // Mapping its dividers and multipliers takes minutes, so this stops before.
    let script = format!(
        "read_verilog -sv {}; hierarchy -check -top {}; proc; opt -fast; check -assert; select -assert-none t:$dlatch",
        sources.join(" "),
        emitted.design.top
    );
    let (code, stdout, stderr) = finish(Command::new("yosys").args(["-q", "-p", &script]).current_dir(folder));
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    assert!(!format!("{stdout}{stderr}").contains("Latch inferred"), "{stdout}{stderr}");
    Ok(())
}
