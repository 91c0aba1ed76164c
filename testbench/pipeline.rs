// SPDX-License-Identifier: MIT OR Apache-2.0
//! A draw through the pipeline: blocks on one clock, with queues between them that take no cycles of their own. Before the
//! draw the pyramid builder, hardware too, makes the levels of the map.
//!
//! ```text
//! map -> [mip_build] -> levels -> [mip_fetch]
//!                                 .-> [perspective_correct] -> u, v -.
//! base triangles -> [remesher] -> step                               +-> [mip_fetch] -> height -.
//!                                 |-> [filter_level] -> level -------+                          |
//!                                 |-> [facing] -> minima ------------'                          |
//!                                 `-> vertex -----------------------> [displace] <--------------'
//!                                 step, at most 256 of them wait ---> [strip_unit] -> triangles
//! ```
//!
//! Only a draw that reads minima where vertices face away has a use for facing.
//!
//! Every beat that leaves a block is compared with the block's golden model as it leaves. The emitted modules can run
//! behind the blocks, compared cycle for cycle.

mod assembly;
mod recording;
mod shading;
mod unit;

pub use recording::PipelineRecording;

use crate::binding::{Beat, Random, find, unpack};
use crate::cosim::Stalls;
use crate::displace;
use crate::facing;
use crate::filter_level;
use crate::mip_build::{size_beat, texel_beat};
use crate::mip_fetch::{command_beat, load_beats};
use crate::perspective_correct;
use crate::remesh::TrianglePorts;
use crate::remesher::{beat_of, step_of, words_of};
use crate::replay::{Replay, ReplayError};
use crate::scoreboard::{Mismatch, PATIENCE};
use relief_hdl::widths::WidthSet;
use relief_models::displace::displaced;
use relief_models::draw::Draw;
use relief_models::light::Light;
use relief_models::mip_build::{BuildSize, Level, Pyramid, side_above};
use relief_models::mip_fetch::{Command, Filter};
use relief_models::remesher::BaseTriangle;
use relief_models::rules::Pyramids;
use relief_models::step::{MAX_COMPONENTS, Step, Vertex};
use relief_models::vertex_transform::lane;
use serde::Serialize;
use shading::Shading;
use std::collections::VecDeque;
use unit::Unit;

/// The blocks that run as hardware, in the order of the pipeline.
pub const BLOCKS: [&str; COUNT] = [
    "mip_build",
    "vertex_transform",
    "cull",
    "clip",
    "remesher",
    "perspective_correct",
    "filter_level",
    "facing",
    "mip_fetch",
    "displace",
    "strip_unit",
    "face_normal",
    "light",
];

/// Steps that wait for their vertices at most: more than the cycles from the remesher to the strip unit.
const DEPTH: usize = 256;

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
    /// Cycles of the draws, up to the last strip.
    pub cycles: u64,
    /// Cycles that assembled base triangles before them. As one design the two overlap.
    pub assembly_cycles: u64,
    /// Cycles behind the last strip until all triangles were lit, one a cycle.
    pub shading_cycles: u64,
    /// Cycles that built the levels of the maps.
    pub build_cycles: u64,
    /// Cycles that filled the map memory.
    pub load_cycles: u64,
    /// Cycles in which a step waited for the vertices before it.
    pub stalled: u64,
    /// Cycles in which the remesher had no step: set-up that the sweep does not hide.
    pub silent: u64,
}

/// A step that has left the remesher, and how many of its vertices are still on their way.
struct Waiting {
    step: Step,
    lacking: usize,
}

/// Vertices on their way, with nine lanes of 32 bits, and what the blocks have made of them, in order.
#[derive(Default)]
struct Queues {
    /// For the block of that number.
    vertices: [VecDeque<Vertex>; COUNT],
    /// From the block of that number.
    done: [VecDeque<Beat>; COUNT],
}

impl Queues {
    /// Takes a vertex of the remesher.
    fn take(&mut self, draw: &Draw, vertex: &Vertex) {
        for unit in [PERSPECTIVE, LEVEL, DISPLACE] {
            self.vertices[unit].push_back(*vertex);
        }
        if draw.rules.reads_both() {
            self.vertices[FACING].push_back(*vertex);
        }
    }

    /// The next beat for a block, if what it takes is there.
    fn next(&mut self, draw: &Draw, unit: usize) -> Option<Beat> {
        match unit {
            PERSPECTIVE => {
                let vertex = self.vertices[unit].pop_front()?;
                let [u, v] = &draw.axes;
                Some(perspective_correct::beat([lane::U, lane::V, lane::C].map(|lane| vertex[lane]), u, v))
            }
            LEVEL => {
                let vertex = self.vertices[unit].pop_front()?;
                Some(filter_level::beat(vertex[lane::DENSITY], vertex[lane::C], &draw.level))
            }
            FACING => {
                let vertex = self.vertices[unit].pop_front()?;
                let normal = std::array::from_fn(|k| vertex[lane::NORMAL + k]);
                Some(facing::beat(normal, [vertex[lane::X], vertex[lane::Y]], draw.displacement.focal))
            }
            FETCH => {
                self.done[LEVEL].front()?;
                let minima = match draw.rules.reads_both() {
                    true => {
                        self.done[PERSPECTIVE].front()?;
                        self.done[FACING].pop_front()?[0] == 1
                    }
                    false => false,
                };
                let texel = self.done[PERSPECTIVE].pop_front()?;
                let level = self.done[LEVEL].pop_front()?[0] as usize;
                let (u, v) = (texel[0] as u32, texel[1] as u32);
                Some(command_beat(&Command::Fetch { level, u, v, filter: Filter::Bilinear, minima }))
            }
            _ => {
                let q = self.done[FETCH].pop_front()?[0];
                let vertex = self.vertices[unit].pop_front()?;
                Some(displace::beat(std::array::from_fn(|lane| vertex[lane]), q, &draw.displacement))
            }
        }
    }
}

/// The displaced vertex of a beat of `displace`.
fn vertex_of(words: &[u64]) -> Vertex {
    let mut vertex = [0; MAX_COMPONENTS];
    vertex[..displace::SENT].copy_from_slice(&unpack(words, displace::SENT, 32));
    vertex
}

/// The blocks.
pub struct Pipeline {
    set: &'static WidthSet,
    units: [Unit; COUNT],
    ports: TrianglePorts,
    modules: Vec<Replay>,
    counts: Counts,
    /// Which cycles a stream is held up in, and how many of a hundred.
    stalls: (Random, u8),
}

const COUNT: usize = 13;
const BUILD: usize = 0;
const TRANSFORM: usize = 1;
const CULL: usize = 2;
const CLIP: usize = 3;
const REMESHER: usize = 4;
const PERSPECTIVE: usize = 5;
const LEVEL: usize = 6;
const FACING: usize = 7;
const FETCH: usize = 8;
const DISPLACE: usize = 9;
const STRIP: usize = 10;
const FACE: usize = 11;
const LIGHT: usize = 12;
/// The blocks of the draw's clock.
const DRAW: std::ops::RangeFrom<usize> = REMESHER..;

impl Pipeline {
    /// The blocks at a width set, reset.
    pub fn new(set: &'static WidthSet) -> Self {
        let units = BLOCKS.map(|name| Unit::new(find(name).expect("a block of the list"), set));
        let ports = TrianglePorts::of(&units[STRIP].stage.layout, set);
        Self { set, units, ports, modules: Vec::new(), counts: Counts::default(), stalls: (Random::new(0), 0) }
    }

    /// Holds up every stream of the draw at random from now on.
    pub fn stall(&mut self, stalls: Stalls) {
        self.stalls = (Random::new(stalls.seed.into()), stalls.percent);
    }

    /// Whether a stream moves in this cycle.
    fn opens(&mut self) -> bool {
        let (random, percent) = &mut self.stalls;
        *percent == 0 || !random.chance(*percent)
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
    pub fn compared(&self) -> [u64; COUNT] {
        self.units.each_ref().map(|unit| unit.compared)
    }
    /// Cycles of each block that its module has followed.
    pub fn followed(&self) -> Vec<u64> {
        self.modules.iter().map(Replay::followed).collect()
    }

    /// Builds the levels of a map, of maxima and of minima: the map itself, its pole rows as the builder sends them, and what
    /// stands above.
    ///
    /// # Errors
    /// The block is at fault.
    pub fn build(&mut self, size: &BuildSize, samples: &[u16]) -> Result<[Pyramid; 2], PipelineError> {
        let BuildSize { width, height, wrap, centring, levels, poles } = *size;
        let mut pyramid = Pyramid { levels: Vec::new(), centring, wrap };
        let (mut w, mut h) = (width, height);
        for _ in 0..levels {
            pyramid.levels.push(Level { width: w, height: h, samples: vec![0; w * h] });
            (w, h) = (side_above(w, centring, wrap[0]), side_above(h, centring, wrap[1]));
        }
        pyramid.levels[0].samples.copy_from_slice(samples);
        let mut minima = pyramid.clone();
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
                for (pyramid, word) in [(&mut pyramid, 3), (&mut minima, 4)] {
                    let level = &mut pyramid.levels[level];
                    level.samples[j * level.width + i] = words[word] as u16;
                }
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
        Ok([pyramid, minima])
    }

    /// Fills the map memory.
    ///
    /// # Errors
    /// A block is at fault.
    pub fn load(&mut self, pyramids: Pyramids<'_>) -> Result<(), PipelineError> {
        let mut silent = 0;
        for beat in load_beats(pyramids) {
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
    /// its triangles in winding order, each vertex with all its displaced lanes, and their colours. Triangles without a
    /// place are black. Light is hardware if there is one; several are golden.
    ///
    /// # Errors
    /// A block is at fault, or the recording fails.
    pub fn draw(
        &mut self,
        draw: &Draw,
        lights: &[Light],
        bases: &[BaseTriangle],
        recording: &mut Option<PipelineRecording>,
        sink: &mut dyn FnMut(usize, [Vertex; 3], [u8; 3]),
    ) -> Result<(), PipelineError> {
        let (components, bits) = (self.set.components, self.set.vertex_bits as u32);
        let mut offered = 0;
        let mut done = 0;
        let mut waiting: VecDeque<Waiting> = VecDeque::new();
        // Steps that have left the queue, and whose vertex comes next: number of step, right.
        let (mut gone, mut owners) = (0, VecDeque::new());
        let mut queues = Queues::default();
        let mut shading = Shading::new(draw, lights);
        let mut silent = 0;
        while done < bases.len() || !shading.is_empty() {
            if !self.units[REMESHER].offers()
                && self.opens()
                && let Some(base) = bases.get(offered)
            {
                self.units[REMESHER].offer(&beat_of(self.set, base));
                offered += 1;
            }
            for unit in [PERSPECTIVE, LEVEL, FACING, FETCH, DISPLACE] {
                if !self.units[unit].offers()
                    && self.opens()
                    && let Some(beat) = queues.next(draw, unit)
                {
                    self.units[unit].offer(&beat);
                }
            }
            if !self.units[STRIP].offers()
                && self.opens()
                && let Some(step) = waiting.pop_front_if(|front| front.lacking == 0)
            {
                self.units[STRIP].offer(&words_of(self.set, &step.step));
                gone += 1;
            }
            shading.offer(&mut self.units);
            for unit in DRAW.start..COUNT {
                let opens = self.opens();
                self.units[unit].take(opens);
            }
            let room = waiting.len() < DEPTH && self.opens();
            self.units[REMESHER].take(room);
            self.units[DRAW].iter_mut().for_each(Unit::settle);
            if let Some(recording) = recording {
                recording.sample(&self.units[DRAW], self.counts.cycles + self.counts.shading_cycles)?;
            }
            let outputs = &self.units[REMESHER].stage;
            let has_step = outputs.outputs[outputs.layout.out_valid] == 1;
            if done < bases.len() {
                self.counts.cycles += 1;
                self.counts.stalled += u64::from(has_step && !room);
                self.counts.silent += u64::from(!has_step);
            } else {
                self.counts.shading_cycles += 1;
            }
            self.counts.bases += u64::from(self.units[REMESHER].stage.accepts());

            let moves = self.units[DRAW].iter().any(|unit| unit.stage.accepts() || unit.stage.sends());
            silent = if moves { 0 } else { silent + 1 };
            if silent > PATIENCE {
                return Err(PipelineError::Hangs(self.counts.cycles));
            }
            let mut sent: [Option<Beat>; COUNT] = Default::default();
            for (unit, sent) in self.units.iter_mut().zip(&mut sent).skip(REMESHER) {
                unit.finish(sent)?;
            }
            for unit in [PERSPECTIVE, LEVEL, FACING, FETCH] {
                if let Some(words) = sent[unit].take() {
                    queues.done[unit].push_back(words);
                }
            }
            if let Some(words) = &sent[DISPLACE] {
                let (number, right): (u64, bool) = owners.pop_front().ok_or(PipelineError::Sticky(BLOCKS[DISPLACE]))?;
                let step = &mut waiting[(number - gone) as usize];
                let vertex = if right { &mut step.step.right_vertex } else { &mut step.step.left_vertex };
                *vertex = displaced::pack(&vertex_of(words), components, bits);
                step.lacking -= 1;
            }
            if let Some(words) = &sent[REMESHER] {
                let step = step_of(self.set, words);
                let number = gone + waiting.len() as u64;
                let vertices =
                    [(step.sends_left(), false, &step.left_vertex), (step.sends_right(), true, &step.right_vertex)];
                let mut lacking = 0;
                for (_, right, vertex) in vertices.into_iter().filter(|(sends, ..)| *sends) {
                    queues.take(draw, &draw.lanes.widen(vertex));
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
                    shading.take(done, triangle.map(|vertex| displaced::unpack(&vertex, components, bits)));
                }
                done += usize::from(self.ports.last(outputs));
            }
            shading.answer(sent[FACE].take(), sent[LIGHT].take(), sink);
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
