// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief prove`: what emitted blocks promise, for all inputs.

use std::io::{stderr, stdout};
use std::path::Path;
use std::time::Instant;

use relief::prove::Property;
use relief::prove::contract::{CONTRACTS, Contract, find};
use relief::prove::solve::{Proof, Solver, Verdict};

use super::{Outcome, Result, select, write_all};

/// Prove that the emitted Verilog of blocks keeps what its streams promise
///
/// held: valid and payload stand while they are not taken. free: they do not follow out_ready within a cycle. counted: no
/// answer without a request, and as many under way as stand in the stages. answered: an answer comes in time. equal: the
/// payload is what an independent formula says. room: no queue or memory overflows. reached: a beat that had to wait is
/// taken, and states are reached. Parts of blocks are proved alone where that says more. See docs/prove.md.
#[derive(clap::Args)]
pub struct Arguments {
    /// The blocks and parts; all of them when none is named
    #[arg(value_name = "BLOCK")]
    blocks: Vec<String>,
    /// Width set
    #[arg(long, value_name = "NAME", default_value = "small")]
    param: String,
    /// Only this property; may be given several times
    #[arg(long, value_name = "NAME")]
    property: Vec<Property>,
    /// Break this property between block and proof, to see that the proof notices
    #[arg(long, value_name = "NAME")]
    fault: Option<Property>,
}

/// Where waveforms of counterexamples go.
const TRACES: &str = "target/relief-proofs";

/// Proves and reports.
pub fn run(arguments: &Arguments) -> Result {
    let contracts = contracts(&arguments.blocks)?;
    let set = select::width_set(Some(&arguments.param))?;
    let solver = Solver::find()?;
    let properties = if arguments.property.is_empty() { Property::ALL.to_vec() } else { arguments.property.clone() };
    write_all(stdout(), &format!("{:18} {:9} {:9} {:>8}\n", "block", "property", "verdict", "seconds"))?;
    let mut failed = 0;
    for contract in contracts {
        let name = contract.name;
        let begun = Instant::now();
        let proof = Proof::new(&solver, contract, set, arguments.fault, &properties)?;
        let line = |property: &str, verdict: &str, seconds: f64, what: &str| {
            format!("{name:18} {property:9} {verdict:9} {seconds:>8.1}  {what}\n")
        };
        write_all(stdout(), &line("-", "read", begun.elapsed().as_secs_f64(), &what(contract)))?;
        for property in &properties {
            let begun = Instant::now();
            let waveform = Path::new(TRACES).join(format!("{name}.{}.vcd", property.name()));
            let verdict = proof.prove(*property, &waveform)?;
            let (word, what) = match &verdict {
                Verdict::Proved(how) => ("proved", how.clone()),
                Verdict::Bounded(how) => ("bounded", how.clone()),
                Verdict::Nothing(why) => ("-", (*why).to_owned()),
                Verdict::Failed(assertion, None) => ("FAILED", assertion.clone()),
                Verdict::Failed(assertion, Some(waveform)) => {
                    ("FAILED", format!("{assertion}; waveform: {}", waveform.display()))
                }
            };
            failed += usize::from(word == "FAILED");
            write_all(stdout(), &line(property.name(), word, begun.elapsed().as_secs_f64(), &what))?;
        }
    }
    if failed > 0 {
        write_all(stderr(), &format!("mismatch: properties that do not hold: {failed}\n"))?;
        return Ok(Outcome::Mismatch);
    }
    Ok(Outcome::Agreed)
}

/// What was read.
fn what(contract: &Contract) -> String {
    match contract.part {
        Some(part) => format!("a part of {}: {}", part.of, part.widths),
        None => "transition relation written".into(),
    }
}

/// The contracts of these names, each once, in the order given; all of them when there is no name.
fn contracts(names: &[String]) -> std::result::Result<Vec<&'static Contract>, String> {
    let known = || CONTRACTS.iter().map(|contract| contract.name).collect::<Vec<_>>().join(", ");
    let mut contracts: Vec<&'static Contract> = vec![];
    for name in names {
        let contract =
            find(name).ok_or_else(|| format!("there is no block or part `{name}` to prove; {} are", known()))?;
        if contracts.iter().all(|other| other.name != contract.name) {
            contracts.push(contract);
        }
    }
    Ok(if names.is_empty() { CONTRACTS.iter().collect() } else { contracts })
}
