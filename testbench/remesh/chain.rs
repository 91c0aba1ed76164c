// SPDX-License-Identifier: MIT OR Apache-2.0
//! The remesher with the strip unit behind it, stepped together as two neighbours on one clock.

use super::{RemeshError, Triangle};
use crate::binding::{Beat, Binding, unpack};
use crate::device::{Layout, Stage};
use crate::remesher::RemesherBinding;
use crate::scoreboard::PATIENCE;
use crate::strip_unit::StripUnitBinding;
use relief_hdl::widths::WidthSet;
use relief_models::step::{LeftCommand, MAX_COMPONENTS, RightCommand, Vertex};

/// What a run has counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Base triangles.
    pub bases: u64,
    /// Triangles.
    pub triangles: u64,
    /// Beats of the step port.
    pub beats: u64,
    /// Vertices that these beats carried.
    pub sent: u64,
    /// Cycles from the reset to the last triangle; 0 for an engine without a clock.
    pub cycles: u64,
}

impl Counts {
    /// Counts a beat of the step port.
    pub(super) fn step(&mut self, sends_left: bool, sends_right: bool) {
        self.beats += 1;
        self.sent += u64::from(sends_left) + u64::from(sends_right);
    }
    /// Cycles in which no beat of the step port was taken: the set-up that the sweep does not hide.
    pub const fn silent(&self) -> u64 {
        self.cycles.saturating_sub(self.beats)
    }
    /// Cycles for two triangles, which is what a quad takes.
    pub fn cycles_per_two_triangles(&self) -> f64 {
        2.0 * self.cycles as f64 / self.triangles as f64
    }
    /// Vertices sent for a triangle: each is displaced and lit once.
    pub fn sent_per_triangle(&self) -> f64 {
        self.sent as f64 / self.triangles as f64
    }
}

/// Where the triangles lie in the words of the strip unit's outputs.
#[derive(Clone, Debug)]
pub struct TrianglePorts {
    valid: usize,
    first: usize,
    second: usize,
    swap: usize,
    last: usize,
    error: usize,
    /// L, R, L', R'.
    vertices: [usize; 4],
    components: usize,
    vertex_bits: usize,
}

impl TrianglePorts {
    /// The places in the outputs of a strip unit of a width set.
    pub fn of(layout: &Layout, set: &WidthSet) -> Self {
        let find = |name: &str| layout.output(name);
        Self {
            valid: layout.out_valid,
            first: find("out_first"),
            second: find("out_second"),
            swap: find("out_swap"),
            last: find("out_last"),
            error: find("error"),
            vertices: ["out_left", "out_right", "out_next_left", "out_next_right"].map(find),
            components: set.components,
            vertex_bits: set.vertex_bits,
        }
    }
    /// A beat stands at the output. The sink behind it takes every one.
    pub(crate) fn valid(&self, outputs: &[u64]) -> bool {
        outputs[self.valid] == 1
    }
    /// It is the last one of its base triangle.
    pub(crate) fn last(&self, outputs: &[u64]) -> bool {
        outputs[self.last] == 1
    }
    /// The first three components of the triangles of a cycle, in winding order: none to two.
    pub fn triangles(&self, outputs: &[u64]) -> impl Iterator<Item = Triangle> + use<> {
        self.vertices(outputs).map(|triangle| triangle.map(|vertex| [vertex[0], vertex[1], vertex[2]]))
    }
    /// The triangles of a cycle with all components, in winding order: none to two.
    pub fn vertices(&self, outputs: &[u64]) -> impl Iterator<Item = [Vertex; 3]> + use<> {
        let vertex = |k: usize| {
            let mut vertex = [0; MAX_COMPONENTS];
            let lanes = unpack(&outputs[self.vertices[k]..], self.components, self.vertex_bits);
            vertex[..self.components].copy_from_slice(&lanes);
            vertex
        };
        let [left, right, next_left, next_right] = [0, 1, 2, 3].map(vertex);
        let valid = self.valid(outputs);
        let first = (valid && outputs[self.first] == 1).then_some([left, right, next_left]);
        let second = (valid && outputs[self.second] == 1).then_some([right, next_right, next_left]);
        let swap = outputs[self.swap] == 1;
        [first, second].into_iter().flatten().map(move |[a, b, c]| if swap { [a, c, b] } else { [a, b, c] })
    }
}

/// The two blocks on one clock. Every triangle is taken in the cycle in which it stands at the output.
pub struct Chain {
    remesher: Stage,
    strip: Stage,
    /// The step port: word of the remesher's output, word of the strip unit's input, words.
    wires: Vec<(usize, usize, usize)>,
    /// Kind, left and right command of the step port among the remesher's outputs.
    commands: [usize; 3],
    ports: TrianglePorts,
}

impl Chain {
    /// Both blocks at a width set, reset.
    pub fn new(set: &WidthSet) -> Self {
        let remesher = Stage::new(RemesherBinding.device(set));
        let mut strip = Stage::new(StripUnitBinding.device(set));
        strip.inputs[strip.layout.out_ready] = 1;
        let wires = remesher.layout.out_fields().zip(strip.layout.in_fields());
        let wires = wires.map(|((port, from), (_, to))| (*from, *to, port.words())).collect();
        Self {
            commands: ["out_kind", "out_left", "out_right"].map(|name| remesher.layout.output(name)),
            ports: TrianglePorts::of(&strip.layout, set),
            remesher,
            strip,
            wires,
        }
    }

    /// Where the triangles lie in [`Chain::strip_outputs`].
    pub fn decoder(&self) -> TrianglePorts {
        self.ports.clone()
    }
    /// The two blocks, the remesher first.
    pub(super) fn stages(&self) -> [&Stage; 2] {
        [&self.remesher, &self.strip]
    }
    /// Outputs of the strip unit in the present cycle.
    pub fn strip_outputs(&self) -> &[u64] {
        &self.strip.outputs
    }

    /// Kind, left and right command of the beat that the strip unit takes in the present cycle, if there is one.
    pub fn step(&self) -> Option<[u64; 3]> {
        self.remesher.sends().then(|| self.commands.map(|at| self.remesher.outputs[at]))
    }

    /// Whether the remesher takes a base triangle in the present cycle.
    pub fn accepts(&self) -> bool {
        self.remesher.accepts()
    }

    /// Lets both blocks settle.
    fn settle(&mut self) {
        // The step port does not depend on its `ready`, so the remesher settles anew only where that has changed.
        self.remesher.settle();
        let (remesher, strip) = (&self.remesher, &mut self.strip);
        strip.inputs[strip.layout.in_valid] = remesher.outputs[remesher.layout.out_valid];
        for &(from, to, words) in &self.wires {
            strip.inputs[to..to + words].copy_from_slice(&remesher.outputs[from..from + words]);
        }
        strip.settle();
        let ready = strip.outputs[strip.layout.in_ready];
        let at = self.remesher.layout.out_ready;
        if self.remesher.inputs[at] != ready {
            self.remesher.inputs[at] = ready;
            self.remesher.settle();
        }
    }

    /// Sends the input beats of `bases` back to back until the last triangle is out. `observer` sees every cycle once
    /// it has settled.
    ///
    /// # Errors
    /// What the observer says, or that a block is at fault.
    pub fn run(
        &mut self,
        bases: impl Iterator<Item = Beat>,
        observer: &mut dyn FnMut(&Self) -> Result<(), RemeshError>,
    ) -> Result<Counts, RemeshError> {
        let mut bases = bases.peekable();
        let mut counts = Counts::default();
        let (mut accepted, mut silent, mut offered) = (0, 0, false);
        while counts.bases < accepted || bases.peek().is_some() {
            match bases.peek() {
                Some(beat) if !offered => {
                    self.remesher.offer(beat);
                    offered = true;
                }
                None => self.remesher.withdraw(),
                Some(_) => {}
            }
            self.settle();
            observer(self)?;
            counts.cycles += 1;
            silent += 1;
            if self.remesher.accepts() {
                (accepted, offered, silent) = (accepted + 1, false, 0);
                bases.next();
            }
            if let Some([_, left, right]) = self.step() {
                counts.step(left == LeftCommand::Set as u64, right != RightCommand::Ref as u64);
                silent = 0;
            }
            let outputs = &self.strip.outputs;
            if self.ports.valid(outputs) {
                counts.triangles += outputs[self.ports.first] + outputs[self.ports.second];
                counts.bases += outputs[self.ports.last];
            }
            if outputs[self.ports.error] == 1 {
                return Err(RemeshError::ColumnMemory { cycle: counts.cycles });
            }
            if silent > PATIENCE {
                return Err(RemeshError::Hangs { cycle: counts.cycles, patience: PATIENCE });
            }
            self.remesher.device.edge();
            self.strip.device.edge();
        }
        Ok(counts)
    }
}
