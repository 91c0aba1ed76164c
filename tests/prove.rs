// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief prove` as a program: the promises hold in the emitted Verilog, and each proof can fail.

use relief::prove::Property;
use relief::prove::contract::{CONTRACTS, Contract};
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
    // Continuous integration leaves nothing out.
    assert!(quick || std::env::var_os("CI").is_none(), "{version} is too slow; tests/run installs a newer one");
    if !quick {
        println!("SKIPPED blocks with wide payloads: {version} is too slow; tests/run installs a newer one");
    }
    quick
}

/// What is left to `relief prove`, which takes minutes for each (docs/prove.md).
const LONG: [&str; 6] = ["mip_build", "sat_average", "bisector", "face_normal", "gradient_normal", "light"];

/// The solver takes a minute for this one alone.
fn is_long(contract: &Contract, property: Property) -> bool {
    contract.name == "remesher" && property == Property::Held
}

/// The contracts that the solver is quick with.
fn contracts() -> Vec<&'static Contract> {
    let quick = is_quick();
    CONTRACTS
        .iter()
        .filter(|contract| if quick { !LONG.contains(&contract.name) } else { contract.name == "vertex_adder" })
        .collect()
}

/// Properties with a claim, and those that each block has.
fn properties(contract: &Contract) -> Vec<Property> {
    let claimed = |property| contract.claims.iter().any(|claim| claim.property == property);
    let always = |property| match property {
        Property::Held | Property::Free => contract.part.is_none(),
        Property::Reached => contract.reach > 0,
        _ => false,
    };
    let all = Property::ALL.into_iter().filter(|property| claimed(*property) || always(*property));
    all.filter(|property| !is_long(contract, *property)).collect()
}

#[test]
fn prove_all_that_is_claimed() {
    if !can_prove() {
        return;
    }
    for contract in contracts() {
        let properties = properties(contract);
        let options: Vec<&str> = properties.iter().flat_map(|property| ["--property", property.name()]).collect();
        let (code, stdout, stderr) = prove(&[&[contract.name], &options[..]].concat());
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
        for property in properties {
            let line = stdout.lines().find(|line| line.split_whitespace().nth(1) == Some(property.name()));
            let verdict = line.and_then(|line| line.split_whitespace().nth(2));
            let claim = contract.claims.iter().find(|claim| claim.property == property);
            let bounded = claim.is_some_and(|claim| claim.induction.is_none());
            let expected = if bounded { "bounded" } else { "proved" };
            assert_eq!(verdict, Some(expected), "{} {property:?}: {stdout}", contract.name);
        }
    }
}

#[test]
fn prove_notices_every_fault() {
    if !can_prove() {
        return;
    }
    for contract in contracts() {
        for property in properties(contract) {
            let own = contract.faults.iter().any(|fault| fault.property == property);
            // A part has no stream that a fault could be put into; its covers are reached by the very paths of its claims.
            if contract.part.is_some() && !own {
                assert!(property == Property::Reached, "{} has no fault for {property:?}", contract.name);
                continue;
            }
            let name = property.name();
            let (code, stdout, stderr) = prove(&[contract.name, "--property", name, "--fault", name]);
            assert_eq!(code, Some(1), "{} {property:?}: {stdout}{stderr}", contract.name);
            assert!(stdout.contains("FAILED") && stderr.contains("do not hold: 1\n"), "{stdout}{stderr}");
        }
    }
    // A fault of one property leaves the proofs of others alone where it can.
    let (code, stdout, _) = prove(&["vertex_adder", "--property", "held", "--fault", "equal"]);
    assert_eq!(code, Some(0), "{stdout}");
}

#[test]
fn prove_has_a_contract_for_every_block() {
    let mut blocks: Vec<&str> = BLOCKS.iter().map(|block| block.name()).collect();
    let own = CONTRACTS.iter().filter(|contract| contract.part.is_none());
    let mut contracts: Vec<&str> = own.map(|contract| contract.name).collect();
    blocks.sort_unstable();
    contracts.sort_unstable();
    assert_eq!(blocks, contracts);
    let (code, stdout, stderr) = prove(&["vertex_adder", "--property", "fast"]);
    assert_eq!((code, stdout.as_str()), (Some(2), ""));
    assert!(
        stderr.contains("there is no property `fast`; held, free, counted, answered, equal, room, reached are"),
        "{stderr}"
    );
    let (code, stdout, stderr) = prove(&["strip"]);
    assert_eq!((code, stdout.as_str()), (Some(2), ""));
    assert!(stderr.contains("there is no block or part `strip` to prove; vertex_adder, remesher,"), "{stderr}");
}
