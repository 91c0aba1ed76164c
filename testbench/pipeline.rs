// SPDX-License-Identifier: MIT OR Apache-2.0
//! A draw through the pipeline: remesher, height fetch and strip unit are hardware on one clock; what stands between them
//! is golden and takes no cycles of its own. Before the draw the pyramid builder, hardware too, makes the levels of the map.
//!
//! ```text
//! map -> [mip_build] -> levels -> [mip_fetch]
//! base triangles -> [remesher] -> step -> request -> [mip_fetch] -> displace -> step -> [strip_unit] -> triangles
//!                                  `------------------ at most 32 steps wait -------------------'
//! ```
//!
//! Every beat that leaves a block is compared with the block's golden model as it leaves. The emitted modules can run
//! behind the blocks, compared cycle for cycle.

mod recording;
mod unit;

pub use recording::PipelineRecording;

use crate::binding::{Beat, find};
use crate::mip_build::{size_beat, texel_beat};
use crate::mip_fetch::{command_beat, load_beats};
use crate::remesh::TrianglePorts;
use crate::remesher::{beat_of, step_of, words_of};
use crate::replay::{Replay, ReplayError};
use crate::scoreboard::{Mismatch, PATIENCE};
use relief_hdl::widths::WidthSet;
use relief_models::draw::Draw;
use relief_models::mip_build::{BuildSize, Level, Pyramid, side_above};
use relief_models::mip_fetch::{Command, Filter};
use relief_models::remesher::BaseTriangle;
use relief_models::step::{Step, Vertex};
use serde::Serialize;
use std::collections::VecDeque;
use unit::Unit;

/// The blocks that run as hardware, in the order of the pipeline.
pub const BLOCKS: [&str; 4] = ["mip_build", "remesher", "mip_fetch", "strip_unit"];

/// Steps that wait for their heights at most.
const DEPTH: usize = 32;

/// Why a draw did not go through.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// A block departs from its golden model.
    #[error("{block} differs from its golden model: {mismatch}")]
    Mismatch {
        /// The block.
        block: &'static str,
        /// Where.
        mismatch: Mismatch,
    },
    /// A module departs from its block, or cannot be run.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// Nothing moves.
    #[error("the pipeline hangs: no handshake for {PATIENCE} cycles up to cycle {0}")]
    Hangs(u64),
    /// A sticky error of a block is up.
    #[error("{0} has raised its sticky error")]
    Sticky(&'static str),
    /// Recording failed.
    #[error(transparent)]
    Record(#[from] relief_waves::record::RecordError),
}

impl PipelineError {
    /// Whether the hardware is wrong, rather than the surroundings.
    pub const fn is_mismatch(&self) -> bool {
        match self {
            Self::Replay(error) => matches!(error, ReplayError::Differs { .. }),
            Self::Record(_) => false,
            _ => true,
        }
    }
}

/// What the draws so far have counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Base triangles that went into the remesher.
    pub bases: u64,
    /// Beats of the step port.
    pub steps: u64,
    /// Vertices sent, each displaced once.
    pub vertices: u64,
    /// Triangles.
    pub triangles: u64,
    /// Cycles of the draws.
    pub cycles: u64,
    /// Cycles that built the levels of the maps.
    pub build_cycles: u64,
    /// Cycles that filled the map memory.
    pub load_cycles: u64,
    /// Cycles in which a step waited for the vertices before it.
    pub stalled: u64,
    /// Cycles in which the remesher had no step: set-up that the sweep does not hide.
    pub silent: u64,
}

/// A step that has left the remesher, and how many of its vertices still lack their height.
struct Waiting {
    step: Step,
    lacking: usize,
}

/// The blocks.
pub struct Pipeline {
    set: &'static WidthSet,
    units: [Unit; 4],
    ports: TrianglePorts,
    modules: Vec<Replay>,
    counts: Counts,
}

const BUILD: usize = 0;
const REMESHER: usize = 1;
const FETCH: usize = 2;
const STRIP: usize = 3;
/// The blocks of the draw's clock.
const DRAW: std::ops::RangeFrom<usize> = REMESHER..;

impl Pipeline {
    /// The blocks at a width set, reset.
    pub fn new(set: &'static WidthSet) -> Self {
        let units = BLOCKS.map(|name| Unit::new(find(name).expect("a block of the list"), set));
        let ports = TrianglePorts::of(&units[STRIP].stage.layout, set);
        Self { set, units, ports, modules: Vec::new(), counts: Counts::default() }
    }

    /// Emits the blocks, builds them in Verilator, and lets them follow from now on.
    ///
    /// # Errors
    /// That they cannot be built.
    pub fn follow(&mut self, folder: &std::path::Path) -> Result<(), PipelineError> {
        self.modules = Replay::build(&self.units.each_ref().map(|unit| &unit.stage), folder)?;
        Ok(())
    }

    /// Counts so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }
    /// Beats of each block that were compared with its golden model.
    pub fn compared(&self) -> [u64; 4] {
        self.units.each_ref().map(|unit| unit.compared)
    }
    /// Cycles of each block that its module has followed.
    pub fn followed(&self) -> Vec<u64> {
        self.modules.iter().map(Replay::followed).collect()
    }

    /// Builds the levels of a map, of maxima: the map itself, its pole rows as the builder sends them, and what stands
    /// above.
    ///
    /// # Errors
    /// The block is at fault.
    pub fn build(&mut self, size: &BuildSize, samples: &[u16]) -> Result<Pyramid, PipelineError> {
        let BuildSize { width, height, wrap, centring, levels, poles } = *size;
        let mut pyramid = Pyramid { levels: Vec::new(), centring, wrap };
        let (mut w, mut h) = (width, height);
        for _ in 0..levels {
            pyramid.levels.push(Level { width: w, height: h, samples: vec![0; w * h] });
            (w, h) = (side_above(w, centring, wrap[0]), side_above(h, centring, wrap[1]));
        }
        pyramid.levels[0].samples.copy_from_slice(samples);
        let pole_samples = if poles { width * height.min(2) } else { 0 };
        let mut awaited = pole_samples + pyramid.levels[1..].iter().map(|level| level.samples.len()).sum::<usize>();
        let mut beats = std::iter::once(size_beat(size)).chain(samples.iter().map(|sample| texel_beat(*sample)));
        let mut silent = 0;
        loop {
            let unit = &mut self.units[BUILD];
            if !unit.offers() {
                match beats.next() {
                    Some(beat) => unit.offer(&beat),
                    None if awaited == 0 => break,
                    None => {}
                }
            }
            unit.settle();
            let moves = unit.stage.accepts() || unit.stage.sends();
            let mut sent = None;
            unit.finish(&mut sent)?;
            if let Some(words) = sent {
                let [level, i, j] = [0, 1, 2].map(|at| words[at] as usize);
                let level = &mut pyramid.levels[level];
                level.samples[j * level.width + i] = words[3] as u16;
                // A node too many would have been a mismatch.
                awaited -= 1;
            }
            self.note(BUILD)?;
            self.units[BUILD].edge();
            self.counts.build_cycles += 1;
            silent = if moves { 0 } else { silent + 1 };
            if silent > PATIENCE {
                return Err(PipelineError::Hangs(self.counts.build_cycles));
            }
        }
        self.units[BUILD].no_error()?;
        Ok(pyramid)
    }

    /// Fills the map memory.
    ///
    /// # Errors
    /// A block is at fault.
    pub fn load(&mut self, pyramid: &Pyramid) -> Result<(), PipelineError> {
        let mut silent = 0;
        for beat in load_beats(pyramid) {
            self.units[FETCH].offer(&beat);
            loop {
                self.units[FETCH].settle();
                let taken = self.units[FETCH].stage.accepts();
                self.units[FETCH].finish(&mut None)?;
                self.note(FETCH)?;
                self.units[FETCH].edge();
                self.counts.load_cycles += 1;
                silent = if taken { 0 } else { silent + 1 };
                if taken {
                    break;
                }
                if silent > PATIENCE {
                    return Err(PipelineError::Hangs(self.counts.load_cycles));
                }
            }
        }
        Ok(())
    }

    /// Sends base triangles back to back. `sink` gets the number of the base triangle, counted from 0 in this call, and
    /// its triangles in winding order, each vertex with all its displaced lanes.
    ///
    /// # Errors
    /// A block is at fault, or the recording fails.
    pub fn draw(
        &mut self,
        draw: &Draw,
        bases: &[BaseTriangle],
        recording: &mut Option<PipelineRecording>,
        sink: &mut dyn FnMut(usize, [Vertex; 3]),
    ) -> Result<(), PipelineError> {
        let mut offered = 0;
        let mut done = 0;
        let mut waiting: VecDeque<Waiting> = VecDeque::new();
        // Steps that have left the queue, requests not yet taken, and whose heights come next: number of step, right.
        let (mut gone, mut requests, mut owners) = (0, VecDeque::new(), VecDeque::new());
        let mut silent = 0;
        while done < bases.len() {
            if !self.units[REMESHER].offers()
                && let Some(base) = bases.get(offered)
            {
                self.units[REMESHER].offer(&beat_of(self.set, base));
                offered += 1;
            }
            if !self.units[FETCH].offers()
                && let Some(request) = requests.pop_front()
            {
                self.units[FETCH].offer(&request);
            }
            if !self.units[STRIP].offers()
                && let Some(step) = waiting.pop_front_if(|front| front.lacking == 0)
            {
                self.units[STRIP].offer(&words_of(self.set, &step.step));
                gone += 1;
            }
            let room = waiting.len() < DEPTH;
            self.units[REMESHER].take(room);
            self.units[DRAW].iter_mut().for_each(Unit::settle);
            if let Some(recording) = recording {
                recording.sample(&self.units[DRAW], self.counts.cycles)?;
            }
            self.counts.cycles += 1;
            let outputs = &self.units[REMESHER].stage;
            let has_step = outputs.outputs[outputs.layout.out_valid] == 1;
            self.counts.stalled += u64::from(has_step && !room);
            self.counts.silent += u64::from(!has_step);
            self.counts.bases += u64::from(self.units[REMESHER].stage.accepts());

            let moves = self.units[DRAW].iter().any(|unit| unit.stage.accepts() || unit.stage.sends());
            silent = if moves { 0 } else { silent + 1 };
            if silent > PATIENCE {
                return Err(PipelineError::Hangs(self.counts.cycles));
            }
            let mut sent: [Option<Beat>; 4] = Default::default();
            for (unit, sent) in self.units.iter_mut().zip(&mut sent).skip(REMESHER) {
                unit.finish(sent)?;
            }
            if let Some(words) = &sent[FETCH] {
                let (number, right): (u64, bool) = owners.pop_front().ok_or(PipelineError::Sticky(BLOCKS[FETCH]))?;
                let step = &mut waiting[(number - gone) as usize];
                let vertex = if right { &mut step.step.right_vertex } else { &mut step.step.left_vertex };
                *vertex = draw.displace(vertex, words[0] as u32);
                step.lacking -= 1;
            }
            if let Some(words) = &sent[REMESHER] {
                let step = step_of(self.set, words);
                let number = gone + waiting.len() as u64;
                let vertices =
                    [(step.sends_left(), false, &step.left_vertex), (step.sends_right(), true, &step.right_vertex)];
                let mut lacking = 0;
                for (_, right, vertex) in vertices.into_iter().filter(|(sends, ..)| *sends) {
                    let request = draw.request(vertex);
                    let (level, u, v) = (request.level as usize, request.u, request.v);
                    requests.push_back(command_beat(&Command::Fetch { level, u, v, filter: Filter::Bilinear }));
                    owners.push_back((number, right));
                    lacking += 1;
                }
                self.counts.steps += 1;
                self.counts.vertices += lacking as u64;
                waiting.push_back(Waiting { step, lacking });
            }
            if sent[STRIP].is_some() {
                let outputs = &self.units[STRIP].stage.outputs;
                for triangle in self.ports.vertices(outputs) {
                    self.counts.triangles += 1;
                    sink(done, triangle);
                }
                done += usize::from(self.ports.last(outputs));
            }
            for unit in REMESHER..self.units.len() {
                self.note(unit)?;
                self.units[unit].edge();
            }
        }
        for unit in &self.units {
            unit.no_error()?;
        }
        for module in &mut self.modules {
            module.run()?;
        }
        Ok(())
    }

    /// Notes the present cycle of a unit for the module that follows it.
    fn note(&mut self, unit: usize) -> Result<(), PipelineError> {
        if let Some(module) = self.modules.get_mut(unit) {
            module.note(&self.units[unit].stage);
            if module.is_full() {
                module.run()?;
            }
        }
        Ok(())
    }
}
