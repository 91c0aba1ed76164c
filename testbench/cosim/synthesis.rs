// SPDX-License-Identifier: MIT OR Apache-2.0
//! Maps a design to the cells of a Lattice ECP5 with Yosys and counts them.

use super::{CosimError, Design, io_error, program, tools};
use serde::Deserialize;
use std::{
    collections::{BTreeMap, HashMap},
    fmt, fs,
    process::Command,
    time::Duration,
};

/// A large block takes minutes.
const LIMIT: Duration = Duration::from_secs(1800);

/// What a design needs of an ECP5, before placement.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CellReport {
    /// Look-up tables of four inputs (`LUT4`), without those that carry chains and distributed RAM take.
    pub luts: usize,
    /// Carry cells (`CCU2C`), each in the place of two look-up tables.
    pub carries: usize,
    /// Flip-flops (`TRELLIS_FF`).
    pub flip_flops: usize,
    /// Block RAMs of 18 Kbit (`DP16KD`).
    pub block_rams: usize,
    /// Multipliers of 18 x 18 bits (`MULT18X18D`).
    pub multipliers: usize,
    /// Distributed RAMs of 16 x 4 bits (`TRELLIS_DPR16X4`).
    pub distributed_rams: usize,
    /// Signals that Yosys had to make a latch for; an ECP5 builds each of look-up tables.
    pub latches: Vec<String>,
    /// Every kind of cell with its count.
    pub cells: BTreeMap<String, usize>,
}

impl fmt::Display for CellReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { luts, carries, flip_flops, block_rams, multipliers, distributed_rams, latches, .. } = self;
        let latches = latches.len();
        write!(
            f,
            "{luts} LUT4, {carries} CCU2C, {flip_flops} TRELLIS_FF, {block_rams} DP16KD, {multipliers} MULT18X18D, \
             {distributed_rams} TRELLIS_DPR16X4, {latches} latches"
        )
    }
}

#[derive(Deserialize)]
struct Netlist {
    modules: HashMap<String, Module>,
}

#[derive(Deserialize)]
struct Module {
    #[serde(default)]
    cells: HashMap<String, Cell>,
}

#[derive(Deserialize)]
struct Cell {
    #[serde(rename = "type")]
    kind: String,
}

/// Synthesizes the design, flattened, and counts its cells.
pub fn yosys_synth_ecp5(design: &Design) -> Result<CellReport, CosimError> {
    design.check()?;
    tools::find("yosys")?;
    let folder = tempfile::tempdir().map_err(io_error("making a temporary folder"))?;
    let (script, json) = (folder.path().join("synth.ys"), folder.path().join("netlist.json"));
    let sources = design.absolute_sources()?;
    let sources: Vec<String> = sources.iter().map(|source| format!("\"{}\"", source.display())).collect();
    // A script rather than options, so that a blank in a path does no harm.
    let text = format!(
        "read_verilog -sv {}\nsynth_ecp5 -nowidelut -top {} -json \"{}\"\n",
        sources.join(" "),
        design.top,
        json.display()
    );
    fs::write(&script, text).map_err(io_error("writing the script for Yosys"))?;
    let what = format!("synthesizing `{}` with Yosys", design.top);
    let mut synthesize = Command::new("yosys");
    synthesize.args(["-Q", "-T", "-s"]).arg(&script).current_dir(design.folder()?);
    let finished = program::run(&mut synthesize, &what, LIMIT)?;
    if !finished.status.success() {
        // Its log says everything first and the reason last.
        let reason = format!("{}\n{}", finished.stderr, finished.stdout);
        let reason = reason.lines().skip_while(|line| !line.contains("ERROR")).collect::<Vec<_>>().join("\n");
        let (status, excerpt) = (program::describe(finished.status), program::excerpt(&reason));
        return Err(CosimError::Failed { what, status, excerpt });
    }
    let netlist = fs::read(&json).map_err(io_error("reading the netlist"))?;
    let cells = count_cells(&netlist, &design.top).map_err(|reason| CosimError::Answer { what, reason })?;
    let count = |kind: &str| cells.get(kind).copied().unwrap_or(0);
    Ok(CellReport {
        luts: count("LUT4"),
        carries: count("CCU2C"),
        flip_flops: count("TRELLIS_FF"),
        block_rams: count("DP16KD"),
        multipliers: count("MULT18X18D"),
        distributed_rams: count("TRELLIS_DPR16X4"),
        latches: finished.stdout.lines().filter_map(latch).collect(),
        cells,
    })
}

/// Every kind of cell of the module `top` in a netlist that Yosys wrote as JSON, with its count.
///
/// # Errors
/// Half a sentence: it is no such netlist.
pub fn count_cells(netlist: &[u8], top: &str) -> Result<BTreeMap<String, usize>, String> {
    let mut netlist: Netlist = serde_json::from_slice(netlist).map_err(|cause| cause.to_string())?;
    let top = netlist.modules.remove(top).ok_or_else(|| format!("its netlist has no module `{top}`"))?;
    let mut cells = BTreeMap::new();
    for cell in top.cells.into_values() {
        *cells.entry(cell.kind).or_insert(0) += 1;
    }
    Ok(cells)
}

/// "Latch inferred for signal `\top.\name' from process ...": the cell itself is gone once it is mapped.
fn latch(line: &str) -> Option<String> {
    let (_, rest) = line.split_once("Latch inferred for signal `")?;
    rest.split_once('\'').map(|(signal, _)| signal.replace('\\', ""))
}
