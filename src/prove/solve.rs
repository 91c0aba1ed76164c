// SPDX-License-Identifier: MIT OR Apache-2.0
//! Runs Yosys once a block, and the solver once a property.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use relief_hdl::widths::WidthSet;
use relief_testbench::binding::Binding;
use relief_testbench::check::emission;
use relief_testbench::cosim::{program, tools};

use super::Property;
use super::contract::{Contract, find};
use super::wrapper::{TOP, wrapper};
use crate::synth::programs::folders;

/// Proofs that take longer than this are given up.
const LIMIT: Duration = Duration::from_secs(1800);
/// Steps of an induction: the longest window of an assertion is two cycles.
const INDUCTION: u32 = 3;

/// How a property fared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds in every state that can be reached.
    Proved(String),
    /// It holds in so many cycles from reset; why not always.
    Bounded(String),
    /// It does not hold. The assertion, and a waveform if there is one.
    Failed(String, Option<PathBuf>),
    /// The block makes no such promise; why.
    Nothing(&'static str),
}

/// The programs.
#[derive(Clone, Debug)]
pub struct Solver {
    path: std::ffi::OsString,
    /// What z3 says of its version.
    pub version: String,
}

impl Solver {
    /// Looks for yosys, yosys-smtbmc and z3, on the PATH and in the project's folder of tools.
    ///
    /// # Errors
    /// A sentence that says what to install.
    pub fn find() -> Result<Solver, String> {
        tools::find("yosys").map_err(|missing| missing.to_string())?;
        let given = env::var_os("PATH").unwrap_or_default();
        // The version that is pinned comes first.
        let path = env::join_paths(folders().into_iter().chain(env::split_paths(&given)))
            .map_err(|error| format!("PATH: {error}"))?;
        let mut solver = Solver { path, version: String::new() };
        let ask = |name: &str| {
            let found = program::run(solver.command(name).arg("--version"), name, Duration::from_secs(60)).ok();
            found.filter(|answer| answer.status.success()).map(|answer| answer.stdout.trim().to_owned())
        };
        let version = ask("z3").ok_or_else(|| {
            let install = "python3 -m venv .tools/eda && .tools/eda/bin/pip install z3-solver==5.4.1.0";
            format!("the program `z3` is missing: install the Debian package z3, or run {install}")
        })?;
        solver.version = version;
        Ok(solver)
    }

    fn command(&self, name: &str) -> Command {
        let found = env::split_paths(&self.path).map(|folder| folder.join(name)).find(|file| file.is_file());
        let mut command = Command::new(found.unwrap_or_else(|| name.into()));
        command.env("PATH", &self.path);
        command
    }
}

/// A block whose transition relation has been written.
pub struct Proof<'a> {
    solver: &'a Solver,
    contract: &'static Contract,
    folder: tempfile::TempDir,
    /// Whether there is a path from `out_ready` to the output.
    follows: Vec<String>,
}

impl<'a> Proof<'a> {
    /// Emits a block and has Yosys write its transition relation, one for each property.
    ///
    /// # Errors
    /// A sentence: the block has no contract, or Yosys refuses.
    pub fn new(
        solver: &'a Solver,
        block: &dyn Binding,
        set: &WidthSet,
        fault: Option<Property>,
    ) -> Result<Proof<'a>, String> {
        let name = block.name();
        let contract =
            find(name).ok_or_else(|| format!("{name} has no contract; src/prove/contract.rs is the place"))?;
        let emission = emission(block, set).map_err(|error| error.to_string())?;
        let folder = tempfile::tempdir().map_err(|error| format!("no temporary folder: {error}"))?;
        emission.write(folder.path()).map_err(|error| error.to_string())?;
        let text = wrapper(&emission, contract, fault);
        fs::write(folder.path().join("proof.sv"), text).map_err(|error| format!("the wrapper of {name}: {error}"))?;
        let sources: Vec<String> = emission.modules.iter().map(|module| format!("{}.sv", module.name)).collect();
        let outputs: Vec<String> = (emission.top_module().ports.iter())
            .filter(|port| port.direction == relief_hdl::verilog::Direction::Output && port.name != "in_ready")
            .map(|port| format!("w:{}", port.name))
            .collect();
        let script = script(contract, &sources, &outputs);
        fs::write(folder.path().join("proof.ys"), script).map_err(|error| format!("the script of {name}: {error}"))?;
        let mut yosys = solver.command("yosys");
        yosys.args(["-Q", "-T", "-q", "proof.ys"]).current_dir(folder.path());
        let what = format!("writing the transition relation of {name} with Yosys");
        let finished = program::run(&mut yosys, &what, LIMIT).map_err(|error| error.to_string())?;
        if !finished.status.success() {
            let text = format!("{}\n{}", finished.stderr, finished.stdout);
            let reason = text.lines().find(|line| line.contains("ERROR")).unwrap_or("it gave no reason").trim();
            return Err(format!("{what} failed: {reason}"));
        }
        let path = fs::read_to_string(folder.path().join("path.txt"))
            .map_err(|error| format!("{what}: what follows out_ready was not written: {error}"))?;
        let follows = path.lines().map(|line| line.trim_start_matches(&format!("{TOP}/")).to_owned()).collect();
        Ok(Proof { solver, contract, folder, follows })
    }

    /// Proves a property, or says what stands against it. A waveform of a counterexample goes to `waveform`.
    ///
    /// # Errors
    /// A sentence: the solver cannot run, or takes too long.
    pub fn prove(&self, property: Property, waveform: &Path) -> Result<Verdict, String> {
        let Contract { exchange, formula, reach, .. } = self.contract;
        match property {
            Property::Held => {
                let base = self.solve(property, Some(INDUCTION), false, waveform)?;
                if let Verdict::Failed(..) = base {
                    return Ok(base);
                }
                if self.solve(property, Some(INDUCTION), true, waveform)? == passed() {
                    return Ok(Verdict::Proved(format!("induction over {INDUCTION} cycles")));
                }
                if *reach == 0 {
                    let what = "induction does not close, and the first beat comes later than a solver sees";
                    return Err(format!("`held` of {}: {what}", self.contract.block));
                }
                // Further from reset, then.
                let cycles = (*reach).max(INDUCTION);
                let found = self.solve(property, Some(cycles), false, waveform)?;
                let why = "an induction begins in states that cannot be";
                Ok(if found == passed() {
                    Verdict::Bounded(format!("{cycles} cycles from reset; {why}"))
                } else {
                    found
                })
            }
            Property::Free if self.follows.is_empty() => Ok(Verdict::Proved("no path in the netlist".into())),
            Property::Free => Ok(Verdict::Failed(format!("a path to {}", self.follows.join(", ")), None)),
            Property::Counted | Property::Answered => {
                let Some(exchange) = exchange else {
                    return Ok(Verdict::Nothing("a beat has no fixed number of answers; the tests count them"));
                };
                if property == Property::Answered && exchange.silence.is_none() {
                    return Ok(Verdict::Nothing("the map says how long it takes; the tests bound it"));
                }
                let verdict = self.solve(property, Some(exchange.cycles), false, waveform)?;
                let why = "an induction begins in states that cannot be";
                Ok(if verdict == passed() {
                    Verdict::Bounded(format!("{} cycles from reset; {why}", exchange.cycles))
                } else {
                    verdict
                })
            }
            Property::Equal => {
                let Some(formula) = formula else {
                    return Ok(Verdict::Nothing("the golden model says it; the tests compare"));
                };
                let steps = formula.cycles.unwrap_or(INDUCTION);
                let verdict = self.solve(property, Some(steps), false, waveform)?;
                if verdict != passed() {
                    return Ok(verdict);
                }
                if formula.cycles.is_some() {
                    return Ok(Verdict::Bounded(format!("{}, {steps} cycles from reset", formula.range)));
                }
                match self.solve(property, Some(INDUCTION), true, waveform)? {
                    Verdict::Failed(..) => Ok(Verdict::Bounded(format!("{steps} cycles; induction does not close"))),
                    _ => Ok(Verdict::Proved(format!("{}, induction over {INDUCTION} cycles", formula.range))),
                }
            }
            Property::Reached if *reach == 0 => {
                Ok(Verdict::Nothing("its first beat comes after a set-up longer than a solver sees; the tests see it"))
            }
            Property::Reached => Ok(match self.solve(property, None, false, waveform)? {
                Verdict::Failed(..) => {
                    Verdict::Failed(format!("no beat that waited is taken within {reach} cycles"), None)
                }
                _ => Verdict::Proved(format!("within {reach} cycles from reset")),
            }),
        }
    }

    /// One run of the solver: an induction, a search from reset over `steps` cycles, or for a cover.
    fn solve(
        &self,
        property: Property,
        steps: Option<u32>,
        induction: bool,
        waveform: &Path,
    ) -> Result<Verdict, String> {
        let mut command = self.solver.command("yosys-smtbmc");
        command.args(["-s", "z3", "-t", &steps.unwrap_or(self.contract.reach).to_string()]);
        if induction {
            command.arg("-i");
        }
        if steps.is_none() {
            command.arg("-c");
        }
        command.args(["--dump-vcd", "trace.vcd", &format!("{}.smt2", property.name())]).current_dir(self.folder.path());
        let what = format!("proving `{}` of {}", property.name(), self.contract.block);
        let finished = program::run(&mut command, &what, LIMIT).map_err(|error| error.to_string())?;
        let text = format!("{}\n{}", finished.stdout, finished.stderr);
        if text.contains("Status: PASSED") {
            return Ok(passed());
        }
        if !text.contains("Status: FAILED") {
            let reason = text.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it says nothing");
            return Err(format!("{what}: yosys-smtbmc ends without a verdict: {}", reason.trim()));
        }
        let assertion = text.lines().find_map(|line| line.split_once("Assert failed in ").map(|(_, rest)| rest.trim()));
        let assertion = assertion.map_or(property.name(), |rest| rest.split(": ").nth(1).unwrap_or(rest)).to_owned();
        // An induction's trace begins in a state that may never be.
        let trace = self.folder.path().join("trace.vcd");
        let kept = !induction && trace.is_file() && {
            let made = waveform.parent().is_none_or(|folder| fs::create_dir_all(folder).is_ok());
            made && fs::copy(&trace, waveform).is_ok()
        };
        Ok(Verdict::Failed(assertion, kept.then(|| waveform.to_owned())))
    }
}

fn passed() -> Verdict {
    Verdict::Proved(String::new())
}

/// One reading and flattening, and a file a property.
fn script(contract: &Contract, sources: &[String], outputs: &[String]) -> String {
    let mut text = format!(
        "read_verilog -sv {}\nread_verilog -sv -formal proof.sv\nhierarchy -check -top {TOP}\nproc\nflatten\n",
        sources.join(" ")
    );
    // All that the outputs follow within a cycle, and `out_ready` among it. Before anything is simplified: wires would lose
    // their names.
    let all =
        outputs.iter().enumerate().map(|(at, output)| if at == 0 { output.clone() } else { format!("{output} %u") });
    text += &format!(
        "select -write path.txt {} %ci*:-$dff,$memwr,$memwr_v2,$mem,$mem_v2 w:out_ready %i\n",
        all.collect::<Vec<_>>().join(" ")
    );
    text +=
        "memory_dff\nmemory_collect\nmemory_nordff\nopt_clean\nasync2sync\ndffunmap\nopt_clean\ndesign -save base\n";
    let cuts = contract.exchange.is_some_and(|exchange| exchange.cut);
    for property in Property::ALL {
        let name = property.name();
        let kept = match property {
            Property::Free => continue,
            Property::Counted | Property::Answered if contract.exchange.is_none() => continue,
            Property::Equal if contract.formula.is_none() => continue,
            Property::Reached => "delete t:$assert t:$assume\n".to_owned(),
            Property::Equal => format!("delete t:$assert c:{name}* %d\ndelete t:$cover\n"),
            _ => format!("delete t:$assert c:{name}* %d\ndelete t:$cover t:$assume\n"),
        };
        let cut = if cuts && matches!(property, Property::Counted | Property::Answered) {
            "cutpoint t:$mul t:$mem t:$mem_v2\n"
        } else {
            ""
        };
        text += &format!("{kept}{cut}opt_clean\nwrite_smt2 -wires {name}.smt2\ndesign -load base\n");
    }
    text
}
