// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the bisector to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unsigned_fields};
use crate::device::Device;
use crate::stepped::Stepped;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::bisector::{Bisector, Bound, Command, Lattice, Output, Side, SplitMap, Vertex};
use std::collections::VecDeque;

/// The bisector.
#[derive(Clone, Copy, Debug)]
pub struct BisectorBinding;

/// Bits of a component of a vertex: u, v and z.
const LANE: usize = 21;

/// The beat of a command, and the fields that it uses.
fn fields(command: &Command) -> (Beat, &'static [usize]) {
    let mut beat = vec![0; 11];
    match *command {
        Command::Size { width, height, levels, mirrored } => {
            (beat[1], beat[2], beat[3], beat[4]) = (width.into(), height.into(), levels.into(), mirrored.into());
            (beat, &[0, 1, 2, 3, 4])
        }
        Command::Sample { error, z } => {
            (beat[0], beat[5], beat[6]) = (1, error.into(), z.into());
            (beat, &[0, 5, 6])
        }
        Command::Draw(Bound { base, slope, eye }) => {
            (beat[0], beat[7], beat[8], beat[9], beat[10]) =
                (2, base.into(), slope.into(), eye[0].into(), eye[1].into());
            (beat, &[0, 7, 8, 9, 10])
        }
    }
}

/// The beat of a command.
pub fn command_beat(command: &Command) -> Beat {
    fields(command).0
}

/// The command of a beat.
fn command_of(beat: &Beat) -> Command {
    match beat[0] {
        0 => Command::Size {
            width: beat[1] as u32,
            height: beat[2] as u32,
            levels: beat[3] as u32,
            mirrored: beat[4] == 1,
        },
        1 => Command::Sample { error: beat[5] as u16, z: beat[6] as u32 },
        _ => {
            Command::Draw(Bound { base: beat[7] as u16, slope: beat[8] as u16, eye: [beat[9] as u16, beat[10] as u16] })
        }
    }
}

/// The beats that put a map into the memories: `errors` for every lattice vertex, `heights` for every sample of the map,
/// both row by row.
pub fn load_beats<'a>(
    lattice: &'a Lattice,
    errors: impl Fn(usize) -> u16 + 'a,
    heights: impl Fn(usize) -> u32 + 'a,
) -> impl Iterator<Item = Beat> + 'a {
    let Lattice { width, height, levels, mirrored } = *lattice;
    let vertices = (0..=lattice.side()).flat_map(|v| (0..=lattice.side()).map(move |u| [u, v]));
    let samples = vertices.map(move |vertex| {
        let [u, v] = lattice.clamp(vertex);
        let error = errors(lattice.index(vertex));
        Command::Sample { error, z: heights(v as usize * width as usize + u as usize) }
    });
    [Command::Size { width, height, levels, mirrored }].into_iter().chain(samples).map(|command| command_beat(&command))
}

struct Golden(Bisector);

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let first = expected.len();
        self.0.accept(&command_of(beat), &mut |output| {
            expected.push(match output {
                Output::Triangle(triangle, corners) => {
                    let corners = corners.map(|corner| pack(&corner.map(i64::from), LANE)[0]);
                    let side = u64::from(triangle.side == Side::Right);
                    let flags = [side, u64::from(triangle.start), u64::from(triangle.walker), 0];
                    let words = corners.into_iter().chain(flags).collect();
                    Expected { words, mask: vec![u64::MAX; 7] }
                }
                Output::End => Expected { words: vec![0, 0, 0, 0, 0, 0, 1], mask: vec![u64::MAX; 7] },
            });
        });
        // The model has no clock, so the cycles are anything.
        for beat in &mut expected[first..] {
            beat.words.extend([0, u64::from(self.0.error())]);
            beat.mask.extend([0, u64::MAX]);
        }
    }
}

/// Maps one behind the other, all of each loaded before it is drawn, some of them twice; from the tenth on, a fault now
/// and then.
struct Maps {
    set: WidthSet,
    random: Random,
    queue: VecDeque<Beat>,
    maps: usize,
}

impl Maps {
    fn push(&mut self, command: &Command) {
        // What a beat does not use is anything.
        let (mut beat, counts) = fields(command);
        for (at, (_, bits)) in bits(&self.set).into_iter().enumerate().filter(|(at, _)| !counts.contains(at)) {
            beat[at] = self.random.bits() & ((1 << bits) - 1);
        }
        self.queue.push_back(beat);
    }
    fn side(&mut self) -> u32 {
        let random = &mut self.random;
        match random.below(8) {
            0 => 2,
            1..4 => 2 + random.below(4) as u32,
            4 => 17,
            _ => 2 + random.below(24) as u32,
        }
    }
    fn size(&mut self, lattice: &Lattice) {
        let Lattice { width, height, levels, mirrored } = *lattice;
        self.push(&Command::Size { width, height, levels, mirrored });
    }
    fn fault(&mut self) {
        let most = self.set.lattice_bits as u32;
        let size = |width, height, levels| Command::Size { width, height, levels, mirrored: false };
        let sample = Command::Sample { error: 1, z: 5 };
        let commands = match self.random.below(8) {
            0 => vec![size(0, 3, 2)],
            1 => vec![size(3, 1, 2)],
            2 => vec![size(4, 3, 1), sample],
            3 => vec![size(3, 7, 2)],
            4 => vec![size(5, 5, most + 1)],
            5 => vec![size(2, 2, 0), sample, sample, sample],
            6 => vec![size(2, 2, 0), sample, sample, sample, sample, sample],
            _ => vec![size((1 << most) + 2, 2, most)],
        };
        commands.iter().for_each(|command| self.push(command));
        self.push(&Command::Draw(Bound::constant(0)));
    }
    /// Errors of a lattice: closed bits, or anything at all: the walk ends, whatever they are.
    fn errors(&mut self, lattice: &Lattice) -> Vec<u16> {
        let most = (1u64 << self.set.error_bits) - 1;
        if self.maps <= 2 {
            return vec![most as u16; lattice.vertices()];
        }
        if self.random.chance(30) {
            return (0..lattice.vertices()).map(|_| self.random.below(most + 1) as u16).collect();
        }
        let mut split = SplitMap::new(lattice);
        let share = self.random.below(100) as u8;
        for vertex in (0..=lattice.side()).flat_map(|v| (0..=lattice.side()).map(move |u| [u, v])) {
            if self.random.chance(share) {
                split.insert(lattice, vertex);
            }
        }
        (0..lattice.vertices()).map(|at| u16::from(split.get(at))).collect()
    }
    fn fill(&mut self) {
        self.maps += 1;
        if self.maps > 10 && self.random.chance(20) {
            self.fault();
        }
        // Tiny ones first, split to the end, so that a short run draws, too.
        let (width, height) = if self.maps <= 2 { (2 + self.maps as u32 % 2, 2) } else { (self.side(), self.side()) };
        let mirrored = self.random.chance(30);
        let lattice = Lattice::of(width, height, mirrored).expect("sides from 2 to 26");
        // A larger lattice than need be, now and then.
        let levels = lattice.levels + u32::from(lattice.levels < 5 && self.random.chance(10));
        let lattice = Lattice { levels, ..lattice };
        self.size(&lattice);
        for error in self.errors(&lattice) {
            let z = self.random.bits() as u32 & 0xf_ffff;
            self.push(&Command::Sample { error, z });
        }
        for _ in 0..1 + self.random.below(2) {
            let random = &mut self.random;
            let most = 1u64 << self.set.error_bits;
            let base = if random.chance(50) { 0 } else { random.below(most) as u16 };
            let slope = if random.chance(50) { 0 } else { random.bits() as u16 >> random.below(16) };
            let eye = [0, 1].map(|_| (random.below(4 << lattice.levels)) as u16);
            self.push(&Command::Draw(Bound { base, slope, eye }));
        }
    }
}

impl Iterator for Maps {
    type Item = Beat;
    fn next(&mut self) -> Option<Beat> {
        while self.queue.is_empty() {
            self.fill();
        }
        self.queue.pop_front()
    }
}

/// The input fields and their bits.
fn bits(set: &WidthSet) -> [(&'static str, usize); 11] {
    let (side, half, error) = (set.lattice_bits + 1, set.lattice_bits + 2, set.error_bits);
    [
        ("kind", 2),
        ("width", side),
        ("height", side),
        ("levels", 4),
        ("mirrored", 1),
        ("error", error),
        ("z", 20),
        ("base", error),
        ("slope", 16),
        ("eye_u", half),
        ("eye_v", half),
    ]
}

/// The corners of a triangle in the words of an output beat.
pub fn corners_of(words: &[u64]) -> [Vertex; 3] {
    [0, 1, 2].map(|corner| {
        let lane = |k: usize| (words[corner] >> (k * LANE)) as u32 & ((1 << LANE) - 1);
        [lane(0), lane(1), lane(2)]
    })
}

impl Binding for BisectorBinding {
    fn name(&self) -> &'static str {
        "bisector"
    }
    fn summary(&self) -> &'static str {
        "tessellates a height map by bisection, under a bound"
    }
    fn latency(&self) -> &'static str {
        "32"
    }
    fn interval(&self) -> &'static str {
        "2 a triangle"
    }
    fn error(&self) -> &'static str {
        "0 (copies heights); the mesh keeps the bound of its map"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::Bisector::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden(Bisector::new(set.lattice_bits as u32)))
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(Maps { set: *set, random: Random::new(seed), queue: VecDeque::new(), maps: 0 })
    }
    fn stimulus_format(&self) -> &'static str {
        "kind (0 size, 1 sample, 2 draw), width, height, levels, mirrored, error, z, base, slope, eye_u and eye_v, all of \
         them in every line"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let beat = unsigned_fields(numbers, &bits(set))?;
        if beat[0] == 3 { Err("number 1 (kind) is 3, which does not fit 0..=2".into()) } else { Ok(beat) }
    }
}
