// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the fetch from pyramids to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, unsigned_fields};
use crate::device::Device;
use crate::mip_build::{random_sample, random_side, random_wrap, wrap_of};
use crate::stepped::Stepped;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::mip_build::{Centring, Extremum, Wrap, golden, max_levels};
use relief_models::mip_fetch::{COORDINATE_BITS, Command, Filter, MipFetch, Placement};
use relief_models::rules::Pyramids;
use std::collections::VecDeque;

/// The fetch from pyramids.
#[derive(Clone, Copy, Debug)]
pub struct MipFetchBinding;

/// The beat of a command, and the fields that it uses.
fn fields(command: &Command) -> (Beat, &'static [usize]) {
    let mut beat = vec![0; 16];
    match *command {
        Command::Size { level, placement } => {
            let Placement { width, height, base, minima_base, pitch, wrap } = placement;
            beat[1] = level as u64;
            for (field, number) in beat[9..14].iter_mut().zip([width, height, base, minima_base, pitch]) {
                *field = number as u64;
            }
            beat[14] = u64::from(wrap[0] == Wrap::Repeat);
            beat[15] = u64::from(wrap[1] == Wrap::Repeat);
            (beat, &[0, 1, 9, 10, 11, 12, 13, 14, 15])
        }
        Command::Load { level, minima, i, j, value } => {
            (beat[0], beat[1], beat[5], beat[6]) = (1, level as u64, minima.into(), i as u64);
            (beat[7], beat[8]) = (j as u64, value.into());
            (beat, &[0, 1, 5, 6, 7, 8])
        }
        Command::Fetch { level, u, v, filter, minima } => {
            (beat[0], beat[1], beat[2], beat[3]) = (2, level as u64, u64::from(u), u64::from(v));
            (beat[4], beat[5]) = (u64::from(filter == Filter::Bilinear), minima.into());
            (beat, &[0, 1, 2, 3, 4, 5])
        }
    }
}

/// The beat of a command.
pub fn command_beat(command: &Command) -> Beat {
    fields(command).0
}

/// The beats that put levels into the memory.
pub fn load_beats<'a>(pyramids: impl Into<Pyramids<'a>>) -> Vec<Beat> {
    pyramids.into().commands(0).map(|command| command_beat(&command)).collect()
}

/// The command of a beat.
fn command_of(beat: &Beat) -> Command {
    let [kind, level, u, v, bilinear, minima, i, j, value, width, height, base, minima_base, pitch, repeat_u, repeat_v] =
        std::array::from_fn(|at| beat[at] as usize);
    let minima = minima == 1;
    match kind {
        0 => {
            let wrap = [repeat_u, repeat_v].map(|flag| wrap_of(flag as u64));
            Command::Size { level, placement: Placement { width, height, base, minima_base, pitch, wrap } }
        }
        1 => Command::Load { level, minima, i, j, value: value as u16 },
        _ => {
            let filter = if bilinear == 1 { Filter::Bilinear } else { Filter::Nearest };
            Command::Fetch { level, u: u as u32, v: v as u32, filter, minima }
        }
    }
}

struct Golden(MipFetch);

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        if let Some(value) = self.0.accept(&command_of(beat)) {
            expected.push(Expected::whole(vec![u64::from(value), u64::from(self.0.error())]));
        }
    }
}

/// Small pyramids one behind the other, all of each loaded before it is read; from the tenth on, a fault now and then.
struct Requests {
    set: WidthSet,
    random: Random,
    queue: VecDeque<Beat>,
    maps: usize,
}

impl Requests {
    fn push(&mut self, command: &Command) {
        // What a beat does not use is anything.
        let (mut beat, counts) = fields(command);
        let bits = bits(&self.set);
        for (at, field) in beat.iter_mut().enumerate().filter(|(at, _)| !counts.contains(at)) {
            *field = self.random.bits() & ((1 << bits[at].1) - 1);
        }
        self.queue.push_back(beat);
    }
    /// A coordinate below two periods, or anything on a clamp axis; borders and nodes more often than not.
    fn coordinate(&mut self, side: usize, wrap: Wrap) -> u32 {
        let random = &mut self.random;
        let one = 1u64 << 16;
        let end = if wrap == Wrap::Repeat { 2 * side as u64 * one } else { 1 << COORDINATE_BITS };
        let near = side as u64 * one;
        let coordinate = match random.below(8) {
            0 => 0,
            1 => end - 1,
            2 => random.below(end),
            3 => near - random.below(3).min(near),
            4 => near + random.below(3 * one),
            5 => random.below(2 * side as u64) * one,
            6 => (random.below(2 * side as u64) * one + one / 2 + 1).saturating_sub(random.below(3)),
            _ => random.below(near),
        };
        coordinate.min(end - 1) as u32
    }
    fn fetch(&mut self, (width, height): (usize, usize), wrap: [Wrap; 2]) {
        let (u, v) = (self.coordinate(width, wrap[0]), self.coordinate(height, wrap[1]));
        let far = self.random.chance(10);
        let level = self.random.below(if far { 16 } else { 4 }) as usize;
        let filter = if self.random.chance(75) { Filter::Bilinear } else { Filter::Nearest };
        let minima = self.random.chance(50);
        self.push(&Command::Fetch { level, u, v, filter, minima });
    }
    fn fault(&mut self) {
        let wrap = [Wrap::Repeat, Wrap::Clamp];
        let placement = Placement { width: 4, height: 4, base: 0, minima_base: 0, pitch: 2, wrap };
        let size = |level, placement| Command::Size { level, placement };
        let load = |i, j, value| Command::Load { level: 0, minima: false, i, j, value };
        let read = |u, v| Command::Fetch { level: 0, u, v, filter: Filter::Bilinear, minima: false };
        let bilinear = |u| read(u, 1 << 15);
        let all = |width, height| (0..width).flat_map(move |i| (0..height).map(move |j| (i, j)));
        let mut commands = vec![size(0, placement)];
        commands.extend(all(4, 4).map(|(i, j)| load(i, j, 9)));
        match self.random.below(10) {
            0 => commands.push(size(0, Placement { width: 0, ..placement })),
            1 => commands.push(size(0, Placement { height: 0, ..placement })),
            2 => commands.push(size(0, Placement { width: 3, ..placement })),
            3 => commands.push(size(0, Placement { height: 3, wrap: [Wrap::Repeat; 2], ..placement })),
            4 => commands.push(size(0, Placement { pitch: 1, ..placement })),
            5 => commands.push(size(2, placement)),
            6 => commands.push(load(4, 0, 1)),
            7 => commands.push(Command::Load { level: 1, minima: true, i: 0, j: 0, value: 1 }),
            8 => commands.push(bilinear((1 << COORDINATE_BITS) - 1)),
            _ => {
                // The lower half lies beyond the memory, that of the maxima or of the minima.
                let minima = self.random.chance(50);
                let end = self.set.bank_words() - 2;
                let (base, minima_base) = if minima { (0, end) } else { (end, end) };
                commands.push(size(0, Placement { base, minima_base, ..placement }));
                commands.extend(all(4, 4).map(|(i, j)| load(i, j, 7)));
                commands.extend(all(4, 4).map(|(i, j)| Command::Load { level: 0, minima, i, j, value: 8 }));
                commands.push(Command::Fetch { level: 0, u: 1 << 16, v: 3 << 15, filter: Filter::Bilinear, minima });
            }
        }
        commands.push(bilinear(1 << 15));
        for command in &commands {
            self.push(command);
        }
    }
    fn fill(&mut self) {
        self.maps += 1;
        if self.maps > 10 && self.random.chance(10) {
            self.fault();
        }
        let random = &mut self.random;
        let mut side = || match self.maps {
            // Tiny ones first, so that a short run fetches, too.
            0..=2 => 1 + random.below(2) as usize,
            _ => random_side(random),
        };
        let (width, height) = (side(), side());
        let wrap = random_wrap(random, width, height);
        let map: Vec<u16> = (0..width * height).map(|_| random_sample(random)).collect();
        let levels = 1 + random.below(max_levels(width, height, Centring::Node, wrap) as u64) as usize;
        let pyramid = |extremum| {
            let pyramid = golden(width, height, &map, Centring::Node, wrap, extremum, levels);
            pyramid.expect("borders and levels fit the size")
        };
        let both = [pyramid(Extremum::Max), pyramid(Extremum::Min)];
        let mut pyramids = Pyramids::from(&both);
        if random.chance(40) {
            pyramids.minima = None;
        }
        // Anywhere in the memory, its last word included.
        let room = self.set.bank_words() - pyramids.bank_words();
        let offset = [0, room, random.below(room as u64 + 1) as usize][random.below(3) as usize];
        let commands: Vec<Command> = pyramids.commands(offset).collect();
        for command in &commands {
            self.push(command);
        }
        for _ in 0..commands.len() + 10 {
            self.fetch((width, height), wrap);
        }
    }
}

impl Iterator for Requests {
    type Item = Beat;
    fn next(&mut self) -> Option<Beat> {
        while self.queue.is_empty() {
            self.fill();
        }
        self.queue.pop_front()
    }
}

/// The input fields and their bits.
fn bits(set: &WidthSet) -> [(&'static str, usize); 16] {
    let (m, a) = (set.side_width(), set.texel_bits - 2);
    [
        ("kind", 2),
        ("level", 4),
        ("u", 29),
        ("v", 29),
        ("bilinear", 1),
        ("minima", 1),
        ("i", m),
        ("j", m),
        ("value", 16),
        ("width", m),
        ("height", m),
        ("base", a),
        ("minima_base", a),
        ("pitch", m),
        ("repeat_u", 1),
        ("repeat_v", 1),
    ]
}

impl Binding for MipFetchBinding {
    fn name(&self) -> &'static str {
        "mip_fetch"
    }
    fn summary(&self) -> &'static str {
        "reads a texel of a level, nearest or bilinear, from four banks"
    }
    fn latency(&self) -> &'static str {
        "21"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "1/2 unit of UQ16.8 at points with 12 fraction bits"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::MipFetch::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden(MipFetch::new(set.bank_words())))
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(Requests { set: *set, random: Random::new(seed), queue: VecDeque::new(), maps: 0 })
    }
    fn stimulus_format(&self) -> &'static str {
        "kind (0 size, 1 load, 2 fetch), level, u, v, bilinear, minima, i, j, value, width, height, base, minima_base, pitch, \
         repeat_u and repeat_v, all of them in every line"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let beat = unsigned_fields(numbers, &bits(set))?;
        if beat[0] == 3 { Err("number 1 (kind) is 3, which does not fit 0..=2".into()) } else { Ok(beat) }
    }
}
