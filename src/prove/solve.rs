// SPDX-License-Identifier: MIT OR Apache-2.0
//! Runs Yosys once a block, and the solver once a property.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use relief_hdl::verilog::{Direction, Emission};
use relief_hdl::widths::WidthSet;
use relief_testbench::binding::{BLOCKS, Binding, expect_offered};
use relief_testbench::check::emission;
use relief_testbench::cosim::{program, tools};

use super::Property;
use super::contract::{Claim, Contract, Fault};
use super::wrapper::{TOP, wrapper};
use crate::synth::programs::folders;

/// Proofs that take longer than this are given up.
const LIMIT: Duration = Duration::from_secs(1800);
/// Steps of an induction: the longest window of an assertion is two cycles.
const INDUCTION: u32 = 3;
/// Why a proof has a bound.
const WHY: &str = "an induction begins in states that cannot be";

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
            let install = "python3 -m venv .tools/test && .tools/test/bin/pip install z3-solver==5.4.1.0";
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
    /// Whether there is a fault to be noticed.
    faulty: bool,
    /// Whether there is a path from `out_ready` to the output.
    follows: Vec<String>,
}

impl<'a> Proof<'a> {
    /// Emits a block or a part, and has Yosys write its transition relation, one for each of `properties`, which are what may be
    /// proved of it then.
    ///
    /// # Errors
    /// A sentence: a block cannot be emitted, or Yosys refuses.
    pub fn new(
        solver: &'a Solver,
        contract: &'static Contract,
        set: &WidthSet,
        fault: Option<Property>,
        properties: &[Property],
    ) -> Result<Proof<'a>, String> {
        let name = contract.name;
        let mut emission = match contract.part {
            Some(part) => (part.emit)().map_err(|error| error.to_string())?,
            None => {
                let block = block(name)?;
                expect_offered(block, set)?;
                emission(block, set).map_err(|error| error.to_string())?
            }
        };
        for change in contract.faults.iter().filter(|change| Some(change.property) == fault) {
            change.apply(&mut emission).map_err(|reason| format!("the fault of {name}: {reason}"))?;
        }
        let folder = tempfile::tempdir().map_err(|error| format!("no temporary folder: {error}"))?;
        emission.write(folder.path()).map_err(|error| error.to_string())?;
        let text =
            wrapper(&emission, set, contract, fault).map_err(|reason| format!("the contract of {name}: {reason}"))?;
        fs::write(folder.path().join("proof.sv"), text).map_err(|error| format!("the wrapper of {name}: {error}"))?;
        let sources: Vec<String> = emission.modules.iter().map(|module| format!("{}.sv", module.name)).collect();
        let outputs: Vec<String> = (emission.top_module().ports.iter())
            .filter(|port| port.direction == Direction::Output && port.name != "in_ready")
            .map(|port| format!("w:{}", port.name))
            .collect();
        let script = script(contract, &sources, &outputs, properties);
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
        Ok(Proof { solver, contract, folder, faulty: fault.is_some(), follows })
    }

    /// Proves a property, or says what stands against it. A waveform of a counterexample goes to `waveform`.
    ///
    /// # Errors
    /// A sentence: the solver cannot run, or takes too long.
    pub fn prove(&self, property: Property, waveform: &Path) -> Result<Verdict, String> {
        let Contract { claims, part, reach, name, .. } = self.contract;
        if let Some(claim) = claims.iter().find(|claim| claim.property == property) {
            return self.claim(claim, waveform);
        }
        if let Some((_, why)) = self.contract.open.iter().find(|(open, _)| *open == property) {
            return Ok(Verdict::Nothing(why));
        }
        match property {
            Property::Held if part.is_none() => {
                let base = self.solve(property, Some(INDUCTION), false, waveform)?;
                if let Verdict::Failed(..) = base {
                    return Ok(base);
                }
                if self.solve(property, Some(INDUCTION), true, waveform)? == passed() {
                    return Ok(Verdict::Proved(format!("induction over {INDUCTION} cycles")));
                }
                if self.faulty {
                    let what = format!("the induction over {INDUCTION} cycles does not close any more");
                    return Ok(Verdict::Failed(what, None));
                }
                if *reach == 0 {
                    let what = "induction does not close, and the first beat comes later than a solver sees";
                    return Err(format!("`held` of {name}: {what}"));
                }
                // Further from reset, then.
                let cycles = (*reach).max(INDUCTION);
                let found = self.solve(property, Some(cycles), false, waveform)?;
                Ok(if found == passed() {
                    Verdict::Bounded(format!("{cycles} cycles from reset; {WHY}"))
                } else {
                    found
                })
            }
            Property::Free if part.is_none() => Ok(if self.follows.is_empty() {
                Verdict::Proved("no path in the netlist".into())
            } else {
                Verdict::Failed(format!("a path to {}", self.follows.join(", ")), None)
            }),
            Property::Held | Property::Free => Ok(Verdict::Nothing("a part has no stream")),
            Property::Counted => Ok(Verdict::Nothing("it has no requests and answers")),
            Property::Answered => Ok(Verdict::Nothing("the data say how long it takes; the tests bound it")),
            Property::Equal => Ok(Verdict::Nothing("the golden model says it; the tests compare")),
            Property::Room => Ok(Verdict::Nothing("nothing in it can overflow")),
            Property::Reached if *reach == 0 => Ok(Verdict::Nothing(
                "its first beat comes after a set-up longer than a solver sees; its parts are covered",
            )),
            Property::Reached => Ok(match self.solve(property, None, false, waveform)? {
                Verdict::Failed(what, _) => Verdict::Failed(format!("not reached within {reach} cycles: {what}"), None),
                _ => Verdict::Proved(format!("within {reach} cycles from reset")),
            }),
        }
    }

    /// What the text of the contract asserts: first from reset, then by induction where that closes.
    fn claim(&self, claim: &Claim, waveform: &Path) -> Result<Verdict, String> {
        let Claim { property, cycles, induction, range } = *claim;
        let of = if range.is_empty() { String::new() } else { format!("{range}; ") };
        let from_reset = self.solve(property, Some(cycles), false, waveform)?;
        if from_reset != passed() {
            return Ok(from_reset);
        }
        match induction {
            Some(steps) if self.solve(property, Some(steps), true, waveform)? == passed() => {
                Ok(Verdict::Proved(format!("{of}induction over {steps} cycles")))
            }
            // A fault may show later than that from reset; then it is the induction that notices it.
            Some(steps) if self.faulty => {
                Ok(Verdict::Failed(format!("the induction over {steps} cycles does not close any more"), None))
            }
            _ => Ok(Verdict::Bounded(format!("{of}{cycles} cycles from reset; {WHY}"))),
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
        let what = format!("proving `{}` of {}", property.name(), self.contract.name);
        let finished = program::run(&mut command, &what, LIMIT).map_err(|error| error.to_string())?;
        let text = format!("{}\n{}", finished.stdout, finished.stderr);
        if text.contains("Status: PASSED") {
            return Ok(passed());
        }
        if !text.contains("Status: FAILED") {
            let reason = text.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it says nothing");
            return Err(format!("{what}: yosys-smtbmc ends without a verdict: {}", reason.trim()));
        }
        let last = |line: &str| line.rsplit(": ").next().unwrap_or(line).trim().to_owned();
        let unreached = text.lines().filter_map(|line| line.split_once("Unreached cover statement at "));
        let unreached: Vec<String> = unreached.map(|(_, rest)| last(rest.trim_end_matches('.'))).collect();
        let assertion = text.lines().find_map(|line| line.split_once("Assert failed in ").map(|(_, rest)| last(rest)));
        let assertion = assertion.unwrap_or_else(|| unreached.join(", "));
        // An induction's trace begins in a state that may never be.
        let trace = self.folder.path().join("trace.vcd");
        let kept = !induction && trace.is_file() && {
            let made = waveform.parent().is_none_or(|folder| fs::create_dir_all(folder).is_ok());
            made && fs::copy(&trace, waveform).is_ok()
        };
        Ok(Verdict::Failed(assertion, kept.then(|| waveform.to_owned())))
    }
}

/// The block of a name.
fn block(name: &str) -> Result<&'static dyn Binding, String> {
    BLOCKS.iter().copied().find(|block| block.name() == name).ok_or_else(|| format!("there is no block `{name}`"))
}

impl Fault {
    /// Changes the text of a module.
    fn apply(&self, emission: &mut Emission) -> Result<(), String> {
        let (from, to) = self.change;
        let name = format!("relief_{}", self.module);
        let module = emission.modules.iter_mut().find(|module| module.name == name);
        let module = module.filter(|module| module.source.contains(from));
        let module = module.ok_or_else(|| format!("there is no `{from}` in the module {name}"))?;
        module.source = module.source.replace(from, to);
        Ok(())
    }
}

fn passed() -> Verdict {
    Verdict::Proved(String::new())
}

/// One reading and flattening, and a file a property.
fn script(contract: &Contract, sources: &[String], outputs: &[String], properties: &[Property]) -> String {
    let loose: String =
        contract.loose.iter().map(|name| format!("cutpoint relief_{}/{name}\n", contract.name)).collect();
    // What is cut off is not looked at any further.
    let rest = if loose.is_empty() { String::new() } else { format!("{loose}hierarchy -top {TOP}\n") };
    let mut text = format!(
        "read_verilog -sv {}\nread_verilog -sv -formal proof.sv\nhierarchy -check -top {TOP}\n{rest}proc\nflatten\n",
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
    if properties == [Property::Free] {
        return text;
    }
    text +=
        "memory_dff\nmemory_collect\nmemory_nordff\nopt_clean\nasync2sync\ndffunmap\nopt_clean\ndesign -save base\n";
    for property in properties.iter().copied() {
        let name = property.name();
        let claimed = contract.claims.iter().any(|claim| claim.property == property);
        // Assumptions are of one property, or hold always.
        let kept = match property {
            Property::Reached => "delete t:$assert\ndelete t:$assume c:always* %d\n".to_owned(),
            _ if claimed || (property == Property::Held && contract.part.is_none()) => {
                // A label may name several.
                let named = format!("c:{name}_* c:*_{name}_* %u");
                format!("delete t:$assert {named} %d\ndelete t:$cover\ndelete t:$assume {named} %d c:always* %d\n")
            }
            _ => continue,
        };
        let cut = if contract.cut.contains(&property) { "cutpoint t:$mul t:$mem t:$mem_v2\n" } else { "" };
        text += &format!("{kept}{cut}opt_clean\nwrite_smt2 -wires {name}.smt2\ndesign -load base\n");
    }
    text
}
