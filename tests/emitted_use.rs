// SPDX-License-Identifier: MIT OR Apache-2.0
//! Emitted blocks in the hands of others: FuseSoC, cocotb, and the port names of AXI4-Stream.

use relief_testbench::binding::BLOCKS;
use relief_testbench::cosim::{program, tools};
use std::env;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const INSTALL: &str =
    "python3 -m venv .tools/test && .tools/test/bin/pip install --only-binary :all: -r requirements-test.txt";

fn project() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A program of requirements-test.txt; none where the test shall pass by. Where CI is set, a missing one is a fault.
fn python_tool(name: &str) -> Option<PathBuf> {
    let place = project().join(".tools/test/bin").join(name);
    if place.is_file() {
        return Some(place);
    }
    let is_ci = env::var("CI").is_ok_and(|value| !matches!(value.as_str(), "" | "0" | "false"));
    assert!(!is_ci, "{} is missing: run {INSTALL}", place.display());
    // Not `eprintln!`: the test harness would keep it to itself, as the test passes.
    let _ = std::io::stderr().write_all(format!("SKIPPED {name}: run {INSTALL}\n").as_bytes());
    None
}

/// Runs a program in a folder: whether it was content, and what it said.
fn run(folder: &Path, command: &mut Command) -> (bool, String) {
    let tools = project().join(".tools/test/bin");
    let path = env::join_paths([tools].into_iter().chain(env::split_paths(&env::var_os("PATH").unwrap_or_default())));
    command.current_dir(folder).env("PATH", path.unwrap()).env("RELIEF", env!("CARGO_BIN_EXE_relief"));
    command.env("PYTHONDONTWRITEBYTECODE", "1");
    let finished = program::run(command, "a program", Duration::from_secs(600)).unwrap();
    (finished.status.success(), finished.stdout + &finished.stderr)
}

/// Emits a block, or all but the design of them all.
fn emit(out: &Path, block: Option<&str>, options: &[&str]) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
    let vectors = vectors(block.unwrap_or_default()).to_string();
    command.args(["emit", "--param", "small", "--vectors", &vectors, "--out"]).arg(out).args(options);
    match block {
        Some(block) => command.arg(block),
        None => command.args(BLOCKS.iter().map(|block| block.name()).filter(|block| *block != DESIGN)),
    };
    let (done, said) = run(project(), &mut command);
    assert!(done, "{said}");
}

/// The design of all blocks, which sends nothing before a draw has its constants and its map.
const DESIGN: &str = "displacement_pipeline";

fn vectors(block: &str) -> usize {
    if block == DESIGN { 400 } else { 40 }
}

/// Puts another text in the place of the first one of its kind.
fn change(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).unwrap();
    assert!(text.contains(from), "{}: no `{from}`", file.display());
    fs::write(file, text.replacen(from, to, 1)).unwrap();
}

#[test]
fn emitted_use_axi_stream_names_pass_the_bench_and_the_lint() -> Outcome {
    if !tools::require_all(&["verilator", "iverilog", "vvp"], "the wrappers for AXI4-Stream")? {
        return Ok(());
    }
    let out = tempfile::tempdir()?;
    emit(out.path(), None, &["--axi-stream"]);
    emit(out.path(), Some(DESIGN), &["--axi-stream"]);
    for block in BLOCKS.iter().map(|block| block.name()) {
        let folder = out.path().join(block);
        let (top, bench) = (format!("relief_{block}_axis"), format!("relief_{block}_tb.sv"));
        let mut lint = Command::new("verilator");
        let (clean, said) =
            run(&folder, lint.args(["--lint-only", "-Wall", "--top-module", &top, "-f", "filelist_axis.f"]));
        assert!(clean && said.trim().is_empty(), "{block}: {said}");
        let play = || {
            let mut build = Command::new("iverilog");
            build.args(["-g2012", "-DRELIEF_AXIS", "-o", "tb.vvp", "-f", "filelist_axis.f", &bench]);
            let (built, said) = run(&folder, &mut build);
            assert!(built && said.trim().is_empty(), "{block}: {said}");
            run(&folder, Command::new("vvp").args(["-n", "tb.vvp"]))
        };
        let (passed, said) = play();
        let all = vectors(block);
        assert!(passed && said.contains(&format!("PASS: {all} of {all} beats in, ")), "{block}: {said}");
        // A field in another place is noticed.
        let wrapper = folder.join(format!("{top}.sv"));
        change(&wrapper, "assign m_axis_tdata = {", "assign m_axis_tdata = ~{");
        let (passed, said) = play();
        assert!(!passed && said.contains("FAIL: "), "{block}: {said}");
    }
    // What was not asked for is not left over.
    emit(out.path(), Some("vertex_adder"), &[]);
    assert!(!out.path().join("vertex_adder/relief_vertex_adder_axis.sv").exists());
    assert!(!out.path().join("vertex_adder/filelist_axis.f").exists());
    Ok(())
}

#[test]
fn emitted_use_fusesoc_takes_every_block() -> Outcome {
    let Some(fusesoc) = python_tool("fusesoc") else { return Ok(()) };
    if !tools::require_all(&["verilator", "make", "iverilog", "vvp"], "FuseSoC")? {
        return Ok(());
    }
    let out = tempfile::tempdir()?;
    emit(out.path(), None, &[]);
    emit(out.path(), Some(DESIGN), &[]);
    let start = |root: &Path, build: &str, target: &str, core: &str| {
        let mut command = Command::new(&fusesoc);
        command.args(["--cores-root"]).arg(root).args(["run", "--build-root", build, "--target", target, core]);
        run(out.path(), &mut command)
    };
    for block in BLOCKS.iter().map(|block| block.name()) {
        let core = format!("relief:blocks:{block}");
        let (clean, said) = start(out.path(), &format!("build/{block}"), "lint", &core);
        assert!(clean && !said.contains("%Warning") && !said.contains("WARNING"), "{block}: {said}");
    }
    // The simulation finds its vectors, and its verdict is that of FuseSoC.
    for block in ["mip_fetch", "sat_average"] {
        let core = format!("relief:blocks:{block}");
        let (passed, said) = start(out.path(), "build/sim", "sim", &core);
        assert!(passed && said.contains("PASS: 40 of 40 beats in, "), "{said}");
    }
    change(&out.path().join("sat_average/relief_sat_average.sv"), " + ", " - ");
    let (passed, said) = start(out.path(), "build/sim", "sim", "relief:blocks:sat_average");
    assert!(!passed && said.contains("FAIL: "), "{said}");
    // A warning fails the lint.
    let truncated = "    wire [2:0] short = 3'd9;\nendmodule";
    change(&out.path().join("sat_build/relief_sat_build.sv"), "endmodule", truncated);
    let (clean, said) = start(out.path(), "build/warned", "lint", "relief:blocks:sat_build");
    assert!(!clean && said.contains("%Warning"), "{said}");
    Ok(())
}

/// The generator of `relief.core`, from a design of somebody else.
#[test]
fn emitted_use_fusesoc_generates_a_block() -> Outcome {
    let Some(fusesoc) = python_tool("fusesoc") else { return Ok(()) };
    if !tools::require_all(&["verilator", "make"], "FuseSoC's generator")? {
        return Ok(());
    }
    let design = tempfile::tempdir()?;
    // The core of the project without its build folders, which FuseSoC would search.
    let relief = design.path().join("relief");
    fs::create_dir_all(relief.join("fusesoc"))?;
    for file in ["relief.core", "fusesoc/emit.py"] {
        fs::copy(project().join(file), relief.join(file))?;
    }
    let mean = |parameters: &str| {
        format!(
            "CAPI=2:\nname: ours:design:mean:1.0.0\nfilesets:\n  rtl:\n    depend: [\"relief:hardware:generator\"]\n    \
             files: [mean.sv]\n    file_type: systemVerilogSource\ngenerate:\n  sat_average:\n    generator: relief\n    \
             parameters: {{{parameters}}}\ntargets:\n  default: {{filesets: [rtl]}}\n  lint:\n    filesets: [rtl]\n    \
             generate: [sat_average]\n    toplevel: mean\n    flow: lint\n    \
             flow_options: {{tool: verilator, verilator_options: [-Wall]}}\n"
        )
    };
    fs::write(
        design.path().join("mean.sv"),
        "module mean (input wire clock, input wire reset, input wire in_valid, output wire in_ready,\n  input wire [31:0] \
         in_sum, input wire [17:0] in_area, output wire out_valid, input wire out_ready,\n  output wire [23:0] out_mean, \
         output wire error);\n  relief_sat_average mean_of_sums (.*);\nendmodule\n",
    )?;
    let core = design.path().join("mean.core");
    let start = |core: &str| {
        let mut command = Command::new(&fusesoc);
        run(design.path(), command.args(["--cores-root", ".", "run", "--target", "lint", core]))
    };
    fs::write(&core, mean("block: sat_average, param: small"))?;
    let (clean, said) = start("ours:design:mean");
    assert!(clean && !said.contains("%Warning"), "{said}");
    let (clean, said) = start("relief:hardware:generator");
    assert!(clean && !said.contains("%Warning"), "{said}");
    for (parameters, sentence) in [
        ("block: sat_mean", "there is no block `sat_mean`"),
        ("param: small", "the parameter `block` is missing"),
        ("block: sat_average, width: 3", "unknown parameters width"),
    ] {
        fs::write(&core, mean(parameters))?;
        let (clean, said) = start("ours:design:mean");
        assert!(!clean && said.contains(sentence), "{said}");
    }
    Ok(())
}

#[test]
fn emitted_use_cocotb_passes_and_notices_a_fault() -> Outcome {
    let Some(python) = python_tool("python") else { return Ok(()) };
    if !tools::require_all(&["iverilog", "vvp"], "cocotb")? {
        return Ok(());
    }
    let out = tempfile::tempdir()?;
    emit(out.path(), Some("vertex_adder"), &[]);
    let folder = out.path().join("vertex_adder");
    let start = || run(out.path(), Command::new(&python).arg(project().join("examples/cocotb/run.py")).arg(&folder));
    let (passed, said) = start();
    assert!(passed && said.contains("1 of 1 tests passed"), "{said}");
    change(&folder.join("relief_vertex_adder.sv"), " + ", " - ");
    let (passed, said) = start();
    assert!(!passed && said.contains("0 of 1 tests passed"), "{said}");
    Ok(())
}
