// SPDX-License-Identifier: MIT OR Apache-2.0
//! One block at one width set, on one part or several.

use std::fs;
use std::path::Path;

use rayon::prelude::*;
use relief_hdl::verilog::Emission;
use relief_hdl::widths::WidthSet;
use relief_testbench::binding::Binding;
use relief_testbench::check::emission;
use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use super::copies;
use super::harness;
use super::nextpnr::{self, Routed, round};
use super::path::CriticalPath;
use super::programs::{self, Program};
use super::target::Target;
use super::yosys::{self, Counts};

/// What was found out: a line of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The block.
    pub block: String,
    /// The width set.
    pub set: String,
    /// The part, as `--target` names it.
    pub target: String,
    /// Look-up tables, those of carries and distributed RAM among them.
    pub lut: usize,
    /// Flip-flops.
    pub ff: usize,
    /// Block RAMs.
    pub bram: usize,
    /// Multipliers.
    pub dsp: usize,
    /// The highest clock: the median of the seeds, MHz.
    pub fmax_mhz: Option<f64>,
    /// The highest clock of each seed, the lowest first, MHz.
    pub seeds_mhz: Vec<f64>,
    /// Millions of beats a second at that clock.
    pub mbeats_per_s: Option<f64>,
    /// What limits it, at the seed of the median.
    pub critical_path: Option<CriticalPath>,
    /// Why there is none: `does not fit: 512 of 208 DP16KD`, or what nextpnr said.
    pub no_clock: Option<String>,
    /// The programs with their versions.
    pub tools: Vec<String>,
}

/// The programs for a part.
#[derive(Clone, Debug)]
pub struct Tools {
    yosys: Program,
    nextpnr: Option<Program>,
}

impl Tools {
    /// Looks for what `target` needs.
    ///
    /// # Errors
    /// A sentence: what is missing and how to install it, or why the part cannot be routed.
    pub fn find(target: &Target, route: bool) -> Result<Tools, String> {
        let nextpnr = match (route, target.route) {
            (false, _) => None,
            (true, Ok(route)) => Some(programs::nextpnr(route.program)?),
            (true, Err(reason)) => return Err(format!("--pnr cannot be had for {}: {reason}", target.name)),
        };
        Ok(Tools { yosys: programs::yosys(target.new_yosys)?, nextpnr })
    }
}

/// An emitted block and its harness in a folder of their own.
pub struct Bench<'b> {
    block: &'b dyn Binding,
    set: &'b WidthSet,
    emission: Emission,
    folder: TempDir,
}

impl<'b> Bench<'b> {
    /// Emits.
    ///
    /// # Errors
    /// A sentence: the block cannot be emitted, or the folder not be written.
    pub fn new(block: &'b dyn Binding, set: &'b WidthSet) -> Result<Self, String> {
        let emission = emission(block, set).map_err(|error| error.to_string())?;
        let folder = tempfile::tempdir().map_err(|error| format!("a temporary folder cannot be made: {error}"))?;
        emission.write(folder.path()).map_err(|error| error.to_string())?;
        let top = emission.top_module();
        let path = folder.path().join(format!("{}.sv", harness::name(top)));
        fs::write(&path, harness::text(top)?).map_err(|error| format!("the harness cannot be written: {error}"))?;
        Ok(Self { block, set, emission, folder })
    }

    /// Where the files are.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The files of the block, children first.
    pub fn sources(&self) -> Vec<String> {
        self.emission.modules.iter().map(|module| format!("{}.sv", module.name)).collect()
    }

    /// The module of the block.
    pub fn top(&self) -> &str {
        &self.emission.top
    }

    /// Synthesizes for a part, and places and routes with so many seeds where the tools have a nextpnr.
    ///
    /// # Errors
    /// A sentence: synthesis failed. That a block does not fit is no error, but what the row says.
    pub fn measure(&self, target: &Target, tools: &Tools, seeds: u64) -> Result<Row, String> {
        let (folder, sources) = (self.folder(), self.sources());
        let copied = copies::wanted(self.block.name(), target);
        let counts = yosys::map(&tools.yosys, folder, &sources, self.top(), target, copied)?;
        let mut row = self.row(target, tools, counts);
        let (Some(nextpnr), Ok(route), None) = (&tools.nextpnr, &target.route, &row.no_clock) else {
            return Ok(row);
        };
        let harness = harness::name(self.emission.top_module());
        yosys::link(&tools.yosys, folder, &sources, (self.top(), &harness), target, copied)?;
        let options = if copied { copies::PLACER } else { &[] };
        let runs: Result<Vec<Routed>, String> =
            (1..=seeds).into_par_iter().map(|seed| nextpnr::run(nextpnr, folder, route, options, seed)).collect();
        match runs {
            Ok(runs) => row.set_clock(runs, cycles(self.block.interval())),
            Err(reason) => row.no_clock = Some(reason),
        }
        Ok(row)
    }

    fn row(&self, target: &Target, tools: &Tools, counts: Counts) -> Row {
        let Counts([lut, ff, bram, dsp]) = counts;
        let programs = [Some(&tools.yosys), tools.nextpnr.as_ref()].into_iter().flatten();
        Row {
            block: self.block.name().into(),
            set: self.set.name.into(),
            target: target.name.into(),
            lut,
            ff,
            bram,
            dsp,
            fmax_mhz: None,
            seeds_mhz: vec![],
            mbeats_per_s: None,
            critical_path: None,
            no_clock: counts.excess(target).map(|excess| format!("does not fit: {excess}")),
            tools: programs.map(|program| program.version.clone()).collect(),
        }
    }
}

impl Row {
    /// The median of the seeds, the lower one of two, with its path.
    fn set_clock(&mut self, mut runs: Vec<Routed>, cycles: Option<u32>) {
        runs.sort_by(|a, b| a.fmax_mhz.total_cmp(&b.fmax_mhz));
        self.seeds_mhz = runs.iter().map(|run| round(run.fmax_mhz, 10.0)).collect();
        let middle = runs.len().saturating_sub(1) / 2;
        if let Some(run) = runs.into_iter().nth(middle) {
            self.fmax_mhz = Some(round(run.fmax_mhz, 10.0));
            self.mbeats_per_s = cycles.map(|cycles| round(run.fmax_mhz / f64::from(cycles), 10.0));
            self.critical_path = Some(run.path);
        }
    }
}

/// Cycles between two beats, as the interval of a block begins: `27`, `2 a triangle`, `one step a cycle; ...`.
pub fn cycles(interval: &str) -> Option<u32> {
    let word = interval.split([' ', ',', ';']).next()?;
    if word == "one" { Some(1) } else { word.parse().ok().filter(|cycles| *cycles > 0) }
}
