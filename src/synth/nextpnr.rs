// SPDX-License-Identifier: MIT OR Apache-2.0
//! Places and routes a netlist, and reads the report.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use relief_testbench::cosim::program;
use serde::Deserialize;

use super::path::{CriticalPath, signal};
use super::programs::Program;
use super::target::Route;
use super::yosys::NETLIST;

/// A full part takes many minutes.
const LIMIT: Duration = Duration::from_secs(7200);

/// The clock that placement strives for, MHz: above what most blocks reach, or it would stop at less.
const STRIVE_MHZ: &str = "125";

/// What one seed gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Routed {
    /// The highest clock, MHz.
    pub fmax_mhz: f64,
    /// What limits it.
    pub path: CriticalPath,
}

#[derive(Deserialize)]
struct Report {
    fmax: BTreeMap<String, Clock>,
    critical_paths: Vec<Path_>,
}

#[derive(Deserialize)]
struct Clock {
    achieved: f64,
}

#[derive(Deserialize)]
struct Path_ {
    from: String,
    to: String,
    path: Vec<Step>,
}

#[derive(Deserialize)]
struct Step {
    delay: f64,
    #[serde(rename = "type")]
    kind: String,
    net: Option<String>,
    to: Pin,
}

#[derive(Deserialize)]
struct Pin {
    cell: String,
}

/// Reads a report.
///
/// # Errors
/// Half a sentence: it is no report, or has no path between registers.
pub fn parse(report: &[u8]) -> Result<Routed, String> {
    let report: Report = serde_json::from_slice(report).map_err(|error| error.to_string())?;
    let slowest = report.fmax.values().map(|clock| clock.achieved).min_by(f64::total_cmp);
    let inner = report.critical_paths.into_iter().find(|path| {
        // The pins of the harness are no part of the block.
        path.from == path.to && !path.from.contains("async")
    });
    let (Some(fmax_mhz), Some(path)) = (slowest, inner) else {
        return Err("it has no path from register to register".into());
    };
    Ok(Routed { fmax_mhz, path: describe(&path.path) })
}

fn describe(steps: &[Step]) -> CriticalPath {
    let sum = |wires: bool| -> f64 {
        let times = steps.iter().filter(|step| (step.kind == "routing") == wires).map(|step| step.delay);
        round(times.sum::<f64>(), 100.0)
    };
    let mut names: Vec<String> = Vec::new();
    for net in steps.iter().filter_map(|step| step.net.as_deref()).filter_map(signal) {
        if names.last() != Some(&net) {
            names.push(net);
        }
    }
    let unknown = || "(unnamed)".to_owned();
    let from = if names.is_empty() { unknown() } else { names.remove(0) };
    let to = steps.last().and_then(|step| signal(&step.to.cell)).unwrap_or_else(unknown);
    // A register often has the name of what it takes.
    names.retain(|name| *name != from && *name != to);
    let mut seen = Vec::new();
    names.retain(|name| {
        !seen.contains(name) && {
            seen.push(name.clone());
            true
        }
    });
    // Within a carry chain no time is spent in wires.
    let entered = |pair: &&[Step]| pair[0].kind == "routing" && pair[0].delay > 0.0 && pair[1].kind == "logic";
    let cells = steps.windows(2).filter(entered).count();
    CriticalPath { from, to, through: names, logic_ns: sum(false), wires_ns: sum(true), cells }
}

/// Rounds to 1/`parts`.
pub(crate) fn round(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}

/// Places and routes the netlist of a folder, with options beside those of the part.
///
/// # Errors
/// A sentence: mostly that it found no place for everything.
pub fn run(nextpnr: &Program, folder: &Path, route: &Route, options: &[&str], seed: u64) -> Result<Routed, String> {
    let report = format!("report_{seed}.json");
    if let Some(pins) = route.pins {
        fs::write(folder.join("pins.cst"), pins).map_err(|error| format!("the file of pins: {error}"))?;
    }
    let (what, seed) = (format!("{}, seed {seed}", route.program), seed.to_string());
    let mut command = Command::new(&nextpnr.path);
    command.args(route.arguments).args(options).args(["--json", NETLIST, "--report", &report, "--seed", &seed]);
    command.args(["--freq", STRIVE_MHZ, "--timing-allow-fail", "-q"]).current_dir(folder);
    let finished = program::run(&mut command, &what, LIMIT).map_err(|error| error.to_string())?;
    if !finished.status.success() {
        let text = format!("{}\n{}", finished.stderr, finished.stdout);
        let reason = text.lines().find_map(|line| line.split_once("ERROR: ")).map_or("no reason given", |(_, why)| why);
        return Err(format!("{what}: {}", reason.trim()));
    }
    let bytes = fs::read(folder.join(&report)).map_err(|error| format!("{what}: its report: {error}"))?;
    parse(&bytes).map_err(|reason| format!("{what}: its report is not understood: {reason}"))
}
