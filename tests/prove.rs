// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief prove` as a program: the promises of streams hold in the emitted Verilog, and each proof can fail.

use relief::prove::Property;
use relief::prove::contract::CONTRACTS;
use relief::prove::solve::Solver;
use relief_testbench::binding::BLOCKS;
use relief_testbench::cosim::tools;
use std::process::Command;

fn prove(arguments: &[&str]) -> (Option<i32>, String, String) {
    let program = env!("CARGO_BIN_EXE_relief");
    let project = env!("CARGO_MANIFEST_DIR");
    let output = Command::new(program).arg("prove").args(arguments).current_dir(project).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn can_prove() -> bool {
    tools::require_all(&["yosys", "z3"], "proofs").unwrap()
}

/// Whether the solver is one that does wide payloads in seconds; Debian's 4.8 takes hours.
fn is_quick() -> bool {
    let version = Solver::find().unwrap().version;
    let number = version.split_whitespace().find_map(|word| {
        let (major, minor) = word.split_once('.')?;
        Some((major.parse::<u32>().ok()?, minor.split('.').next()?.parse::<u32>().ok()?))
    });
    let quick = number.is_some_and(|number| number >= (4, 13));
    if !quick {
        println!(
            "SKIPPED blocks with wide payloads: {version} is too slow; docs/prove.md tells how to get a newer one"
        );
    }
    quick
}

#[test]
fn prove_streams_keep_their_promises() {
    if !can_prove() {
        return;
    }
    // The remesher takes Yosys minutes, and the formula of sat_average the solver one.
    let all = [
        "vertex_adder",
        "sat_build",
        "strip_unit",
        "mip_build",
        "mip_fetch",
        "sat_fetch",
        "sat_fetch_parallel",
        "bisector",
    ];
    let blocks = if is_quick() { &all[..] } else { &all[..1] };
    let (code, stdout, stderr) = prove(blocks);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let verdict = |block: &str, property: Property| {
        let line = stdout.lines().find(|line| {
            let mut words = line.split_whitespace();
            (words.next(), words.next()) == (Some(block), Some(property.name()))
        });
        line.unwrap_or_else(|| panic!("{block} {property:?}: {stdout}")).split_whitespace().nth(2).unwrap()
    };
    for &block in blocks {
        assert_eq!(verdict(block, Property::Free), "proved", "{block}");
        assert_eq!(verdict(block, Property::Reached), "proved", "{block}");
        // The induction closes for all but one.
        assert_eq!(verdict(block, Property::Held), if block == "mip_build" { "bounded" } else { "proved" }, "{block}");
        let exchange = CONTRACTS.iter().find(|contract| contract.block == block).unwrap().exchange;
        assert_eq!(verdict(block, Property::Counted), if exchange.is_some() { "bounded" } else { "-" }, "{block}");
        let answers = exchange.is_some_and(|exchange| exchange.silence.is_some());
        assert_eq!(verdict(block, Property::Answered), if answers { "bounded" } else { "-" }, "{block}");
    }
    assert_eq!(verdict("vertex_adder", Property::Equal), "proved");
}

#[test]
fn prove_notices_every_fault() {
    if !can_prove() {
        return;
    }
    for property in Property::ALL {
        let (code, stdout, stderr) =
            prove(&["vertex_adder", "--property", property.name(), "--fault", property.name()]);
        assert_eq!(code, Some(1), "{property:?}: {stdout}{stderr}");
        assert!(stdout.contains("FAILED") && stderr.contains("properties that do not hold: 1\n"), "{stdout}{stderr}");
        // Without the fault it holds.
        let (code, stdout, _) = prove(&["vertex_adder", "--property", property.name()]);
        assert!(code == Some(0) && stdout.contains("vertex_adder       "), "{stdout}");
    }
    // The other kinds of contract: memories that may answer anything, answers that are some beats only.
    let others = [
        ("mip_fetch", "held"),
        ("mip_fetch", "free"),
        ("mip_fetch", "counted"),
        ("mip_fetch", "answered"),
        ("sat_fetch", "counted"),
        ("sat_fetch", "answered"),
        ("sat_fetch_parallel", "answered"),
        ("strip_unit", "held"),
        ("strip_unit", "reached"),
        ("bisector", "held"),
        ("bisector", "counted"),
    ];
    let quick = is_quick();
    for (block, property) in others.into_iter().filter(|_| quick) {
        let (code, stdout, stderr) = prove(&[block, "--property", property, "--fault", property]);
        assert!(code == Some(1) && stdout.contains("FAILED"), "{block} {property}: {stdout}{stderr}");
    }
    // A fault of one property leaves the proofs of others alone where it can.
    let (code, stdout, _) = prove(&["vertex_adder", "--property", "held", "--fault", "equal"]);
    assert_eq!(code, Some(0), "{stdout}");
}

#[test]
fn prove_has_a_contract_for_every_block() {
    let mut blocks: Vec<&str> = BLOCKS.iter().map(|block| block.name()).collect();
    let mut contracts: Vec<&str> = CONTRACTS.iter().map(|contract| contract.block).collect();
    blocks.sort_unstable();
    contracts.sort_unstable();
    assert_eq!(blocks, contracts);
    let (code, stdout, stderr) = prove(&["vertex_adder", "--property", "fast"]);
    assert_eq!((code, stdout.as_str()), (Some(2), ""));
    assert!(
        stderr.contains("there is no property `fast`; held, free, counted, answered, equal, reached are"),
        "{stderr}"
    );
}
