// SPDX-License-Identifier: MIT OR Apache-2.0
//! Power-up of the emitted Verilog, and the netlist that Yosys makes of it, both in Icarus under the emitted test bench:
//! registers begin unknown, inputs are unknown where they mean nothing, the reset takes one cycle, and no unknown bit may
//! come out. Nothing here knows a latency.

use rayon::prelude::*;
use relief_testbench::binding::BLOCKS;
use relief_testbench::cosim::{program, tools};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The remesher sends a hundred beats for one that it takes, exact_footprint, vertex_transform and clip take 8, 65 and
/// thousands of cycles for one; others have over 60 multipliers, which are gates in a netlist.
fn vectors(block: &str) -> &'static str {
    match block {
        "remesher" => "60",
        "displace" | "exact_footprint" | "face_normal" | "gradient_normal" | "light" | "vertex_transform" => "120",
        "clip" => "30",
        _ => "400",
    }
}

fn names() -> Vec<&'static str> {
    BLOCKS.iter().map(|block| block.name()).collect()
}

/// Emits a block at `small` into a folder of its own.
fn emit(out: &Path, block: &str) -> PathBuf {
    let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
    command.args(["emit", block, "--param", "small", "--vectors", vectors(block), "--out"]).arg(out);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{block}: {}", String::from_utf8_lossy(&output.stderr));
    out.join(block)
}

/// Runs a program in a folder, and tells whether it was content and what it said.
fn run(folder: &Path, arguments: &[&str]) -> (bool, String) {
    let mut command = Command::new(arguments[0]);
    command.args(&arguments[1..]).current_dir(folder);
    let finished = program::run(&mut command, arguments[0], Duration::from_secs(3600)).unwrap();
    (finished.status.success(), finished.stdout + &finished.stderr)
}

/// Plays a test bench on a design, which is Icarus' list of files or one netlist: whether it passed, and what was said.
fn play(folder: &Path, design: &[&str], bench: &str) -> (bool, String) {
    // Runs of one folder may go on at once.
    let image = format!("{}.vvp", design.concat().replace(['-', ' ', '.'], "_") + &bench.replace('.', "_"));
    let build = [&["iverilog", "-g2012", "-o", &image], design, &[bench]].concat();
    let (built, said) = run(folder, &build);
    assert!(built, "{bench}: {said}");
    let (ended, said) = run(folder, &["vvp", "-n", &image]);
    (ended && said.contains("PASS: "), said)
}

const SOURCE: [&str; 2] = ["-f", "filelist.f"];

fn bench(block: &str) -> String {
    format!("relief_{block}_tb.sv")
}

#[test]
fn power_up_leaves_no_unknown_bit_after_one_cycle_of_reset() -> Outcome {
    if !tools::require_all(&["iverilog", "vvp"], "power-up from unknown registers")? {
        return Ok(());
    }
    let out = tempfile::tempdir()?;
    names().into_par_iter().for_each(|block| {
        let folder = emit(out.path(), block);
        let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
        let write = |name: &str, text: String| fs::write(folder.join(name), text).unwrap();
        for module in read("filelist.f").lines() {
            for line in read(module).lines().map(str::trim) {
                let begins = line.starts_with("initial ") && !line.contains("$readmemh");
                let declared = line.starts_with("reg ") && line.split("//").next().unwrap().contains('=');
                assert!(!begins && !declared, "{module}: a register has an initial value: {line}");
            }
        }
        let (passed, said) = play(&folder, &SOURCE, &bench(block));
        assert!(passed, "{block}: {said}");

        // Everything is unknown before the reset: where it never comes, the first cycle shows it.
        let text = read(&bench(block));
        let dead = text.replace("  reg reset = 1;\n", "  reg reset = 0;\n");
        assert_ne!(dead, text);
        write("dead_tb.sv", dead);
        let (passed, said) = play(&folder, &SOURCE, "dead_tb.sv");
        assert!(!passed && said.contains("cycle 0: out_valid is unknown"), "{block}: {said}");

        // An unknown payload is noticed, even in a field that does not count in every beat.
        let top = format!("relief_{block}.sv");
        let source = read(&top);
        let ports = source.lines().map(str::trim).filter(|line| line.starts_with("output "));
        let words = ports.map(|line| line.split("//").next().unwrap().trim().trim_end_matches(','));
        let fields: Vec<&str> = words.filter_map(|line| line.split(' ').next_back()).collect();
        let last = fields.into_iter().rfind(|name| name.starts_with("out_")).unwrap();
        assert_ne!(last, "out_valid");
        let unknown = format!("    initial force {last} = {{$bits({last}){{1'bx}}}};\nendmodule");
        write("unknown.sv", source.replacen("endmodule", &unknown, 1));
        let list = read("filelist.f").replace(&top, "unknown.sv");
        write("unknown.f", list);
        let (passed, said) = play(&folder, &["-f", "unknown.f"], &bench(block));
        assert!(!passed && said.contains("FAIL: "), "{block}, {last} unknown: {said}");
    });
    Ok(())
}

/// The netlist of an emitted block: generic gates and flip-flops, flattened; memories stay arrays, as they become block RAM.
fn synthesize(folder: &Path, block: &str) -> &'static str {
    let sources = fs::read_to_string(folder.join("filelist.f")).unwrap().replace('\n', " ");
    let script = format!(
        "read_verilog -sv {sources}; synth -flatten -top relief_{block} -run :fine; opt -fast -full; techmap; opt -fast; \
         abc -fast; opt -fast; opt_clean; check -assert; write_verilog -noattr netlist.v"
    );
    let (done, said) = run(folder, &["yosys", "-q", "-p", &script]);
    assert!(done, "{block}: {said}");
    let netlist = fs::read_to_string(folder.join("netlist.v")).unwrap();
    assert_eq!(netlist.matches("\nmodule ").count(), 1, "{block} is not flat");
    // Sums and products are gates by now; what is left with a sign of its own is the address of a memory at most.
    assert!(!netlist.contains(" * ") && !netlist.contains(" + "), "{block} has arithmetic left");
    "netlist.v"
}

/// The netlist with the AND of one line turned into an OR, at a few places spread over it.
fn slips(netlist: &str, wanted: usize) -> Vec<String> {
    let lines: Vec<&str> = netlist.lines().collect();
    let gate = |line: &str| line.trim().starts_with("assign ") && line.contains(" & ");
    let gates: Vec<usize> = (0..lines.len()).filter(|at| gate(lines[*at])).collect();
    let chosen = (0..wanted).map(|k| gates[(2 * k + 1) * gates.len() / (2 * wanted)]);
    chosen
        .map(|at| [&lines[..at], &[&lines[at].replacen(" & ", " | ", 1)], &lines[at + 1..]].concat().join("\n"))
        .collect()
}

fn netlists(blocks: &[&str], faults: usize) -> Outcome {
    if !tools::require_all(&["yosys", "iverilog", "vvp"], "the netlists of the emitted blocks")? {
        return Ok(());
    }
    let out = tempfile::tempdir()?;
    let of_block = |block: &&str| {
        let folder = emit(out.path(), block);
        let netlist = synthesize(&folder, block);
        let (passed, said) = play(&folder, &[netlist], &bench(block));
        assert!(passed, "{block}: {said}");
        if !["vertex_adder", "sat_build", "strip_unit"].contains(block) {
            return (0, 0);
        }
        let text = fs::read_to_string(folder.join(netlist)).unwrap();
        let mut noticed = 0;
        for text in slips(&text, faults) {
            fs::write(folder.join("slip.v"), text).unwrap();
            noticed += usize::from(!play(&folder, &["slip.v"], &bench(block)).0);
        }
        assert!(noticed > 0, "{block}: none of {faults} faults in the netlist was noticed");
        (faults, noticed)
    };
    let sums = blocks.par_iter().map(of_block).reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
    println!("{} of {} faults in netlists noticed", sums.1, sums.0);
    Ok(())
}

/// Blocks whose netlist takes Yosys and Icarus minutes: hundreds of adders, or dozens of multipliers behind wide sums;
/// and the design of all blocks.
const LARGE: [&str; 6] = ["remesher", "displace", "face_normal", "gradient_normal", "light", "displacement_pipeline"];

#[test]
fn power_up_netlists_send_the_same_beats() -> Outcome {
    // Those that take long first.
    let mut blocks = names();
    blocks.retain(|name| !LARGE.contains(name));
    blocks.reverse();
    netlists(&blocks, 4)
}

#[test]
#[ignore = "the large ones take minutes each: cargo test --release --test power_up -- --ignored"]
fn power_up_netlists_of_large_blocks_send_the_same_beats() -> Outcome {
    netlists(&LARGE, 0)
}
