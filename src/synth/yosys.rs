// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drives Yosys: the cells of a block alone, and the netlist of its harness with these very cells inside.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use relief_testbench::cosim::{count_cells, program};

use super::copies;
use super::pack::output_registers;
use super::programs::Program;
use super::target::{Resource, Target};

/// The remesher takes minutes, and longer where the machine has other things to do.
const LIMIT: Duration = Duration::from_secs(7200);

/// The netlist of the block in the words of Yosys, between the two runs.
const BLOCK: &str = "block.il";
/// Its counts come from the same netlist as JSON.
const COUNTED: &str = "block.json";
/// The netlist that nextpnr takes.
pub const NETLIST: &str = "netlist.json";

/// The four counts of a netlist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts(pub [usize; 4]);

impl Counts {
    /// Sums what the kinds of cells take of a part.
    pub fn of(cells: &BTreeMap<String, usize>, target: &Target) -> Counts {
        let mut counts = Counts::default();
        for (kind, number) in cells {
            if let Some((resource, each)) = target.cell(kind) {
                counts.0[resource as usize] += number * each;
            }
        }
        counts
    }

    /// What the part has too little of, block RAM first: `512 of 208 DP16KD`.
    pub fn excess(&self, target: &Target) -> Option<String> {
        let holds = target.holds?;
        let names = ["LUT", "FF", target.units[0], target.units[1]];
        let order = [Resource::BlockRam, Resource::Dsp, Resource::Lut, Resource::FlipFlop].map(|kind| kind as usize);
        let over = order.into_iter().filter(|kind| self.0[*kind] > holds[*kind]);
        let over: Vec<String> =
            over.map(|kind| format!("{} of {} {}", self.0[kind], holds[kind], names[kind])).collect();
        (!over.is_empty()).then(|| over.join(", "))
    }
}

/// Maps the module `top` of a folder to the cells of a part, flattened, and counts them.
///
/// # Errors
/// A sentence, and what Yosys said.
pub fn map(
    yosys: &Program,
    folder: &Path,
    sources: &[String],
    top: &str,
    target: &Target,
    copied: bool,
) -> Result<Counts, String> {
    let Target { pass, inner, .. } = target;
    let sources = sources.join(" ");
    // Only the block: the library of cells would be defined twice where this is read again.
    let script = format!(
        "read_verilog -sv {sources}; {pass} {inner} -top {top}; write_json {COUNTED}; select {top}; write_rtlil -selected {BLOCK}"
    );
    run(yosys, folder, &script, &format!("synthesizing `{top}` for {} with Yosys", target.name))?;
    pack(folder, COUNTED, top, copied.then_some(""))?;
    let netlist = fs::read(folder.join(COUNTED)).map_err(|error| format!("the netlist of `{top}`: {error}"))?;
    let cells = count_cells(&netlist, top).map_err(|reason| format!("the netlist of `{top}`: {reason}"))?;
    Ok(Counts::of(&cells, target))
}

/// Puts the mapped block into its harness: [`NETLIST`] is what it leaves. The block is not mapped again, so what is placed
/// is what was counted, and nothing of it moves into the harness.
///
/// # Errors
/// A sentence, and what Yosys said.
pub fn link(
    yosys: &Program,
    folder: &Path,
    sources: &[String],
    (top, harness): (&str, &str),
    target: &Target,
    copied: bool,
) -> Result<(), String> {
    let (pass, sources) = (target.pass, sources.join(" "));
    let script = format!(
        "read_verilog -sv {harness}.sv; read_verilog -sv -lib {sources}; {pass} -top {harness}; delete ={top}; \
         read_rtlil {BLOCK}; hierarchy -top {harness}; flatten; clean; write_json {NETLIST}"
    );
    run(yosys, folder, &script, &format!("synthesizing `{harness}` for {} with Yosys", target.name))?;
    // The same registers as in the block alone: neither they nor what they read are of the harness.
    pack(folder, NETLIST, harness, copied.then_some("block."))
}

/// Packs the registers of the netlist `file`, and makes copies among the cells whose name begins with `copied`.
fn pack(folder: &Path, file: &str, top: &str, copied: Option<&str>) -> Result<(), String> {
    let path = folder.join(file);
    let fail = |reason: String| format!("the netlist of `{top}`: {reason}");
    let bytes = fs::read(&path).map_err(|error| fail(error.to_string()))?;
    let mut netlist = serde_json::from_slice(&bytes).map_err(|error| fail(error.to_string()))?;
    let packed = output_registers(&mut netlist, top).map_err(fail)?;
    let copies = match copied {
        Some(inside) => copies::of_what_many_read(&mut netlist, top, inside).map_err(fail)?,
        None => 0,
    };
    if packed + copies > 0 {
        fs::write(&path, netlist.to_string()).map_err(|error| fail(error.to_string()))?;
    }
    Ok(())
}

/// Names in a script are relative: the tools of PyPI see other folders than ours behind some absolute ones.
fn run(yosys: &Program, folder: &Path, script: &str, what: &str) -> Result<(), String> {
    let mut command = Command::new(&yosys.path);
    command.args(["-Q", "-T", "-p", script]).current_dir(folder);
    let finished = program::run(&mut command, what, LIMIT).map_err(|error| error.to_string())?;
    if finished.status.success() {
        return Ok(());
    }
    let text = format!("{}\n{}", finished.stderr, finished.stdout);
    let reason = text.lines().find(|line| line.contains("ERROR")).unwrap_or("it gave no reason");
    Err(format!("{what} failed: {}", reason.trim()))
}
