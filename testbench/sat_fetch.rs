// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the fetch from summed-area tables to its golden model, which serves the version with two copies, too.

use crate::binding::{Beat, Binding, Expected, Model, Random, unsigned_fields};
use crate::device::Device;
use crate::mip_build::{random_sample, random_side};
use crate::stepped::Stepped;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::sat_build::{Table, golden};
use relief_models::sat_fetch::{Border, Command, SatFetch, span};
use std::collections::VecDeque;

/// The fetch from summed-area tables.
#[derive(Clone, Copy, Debug)]
pub struct SatFetchBinding;

/// Bits of a corner.
const fn corner_bits(set: &WidthSet) -> usize {
    set.side_width() + 2
}

/// The beat of a command, and the fields that it uses.
fn fields(set: &WidthSet, command: &Command) -> (Beat, &'static [usize]) {
    let signed = |number: i64| number as u64 & ((1 << corner_bits(set)) - 1);
    match *command {
        Command::Size { width, height, border } => {
            (vec![0, 0, 0, 0, 0, 0, width, height, u64::from(border == Border::Slide)], &[0, 6, 7, 8])
        }
        Command::Load { x, y, sum } => (vec![1, signed(x), signed(y), 0, 0, sum, 0, 0, 0], &[0, 1, 2, 5]),
        Command::Fetch { corner: (x, y), size: (a, b) } => {
            (vec![2, signed(x), signed(y), a, b, 0, 0, 0, 0], &[0, 1, 2, 3, 4])
        }
    }
}

/// The beat of a command.
pub fn command_beat(set: &WidthSet, command: &Command) -> Beat {
    fields(set, command).0
}

/// The commands that put a table into the memory.
pub fn load_commands(table: &Table, border: Border) -> Vec<Command> {
    let (width, height) = (table.width, table.height);
    let cells = (1..=height).flat_map(|y| (1..=width).map(move |x| (x, y)));
    let loads = cells.map(|(x, y)| Command::Load { x: x as i64, y: y as i64, sum: table.at(x, y) });
    std::iter::once(Command::Size { width: width as u64, height: height as u64, border }).chain(loads).collect()
}

/// The command of a beat.
fn command_of(set: &WidthSet, beat: &Beat) -> Command {
    let shift = 64 - corner_bits(set);
    let signed = |word: u64| (word << shift) as i64 >> shift;
    let (x, y) = (signed(beat[1]), signed(beat[2]));
    match beat[0] {
        0 => {
            let border = if beat[8] == 1 { Border::Slide } else { Border::Clamp };
            Command::Size { width: beat[6], height: beat[7], border }
        }
        1 => Command::Load { x, y, sum: beat[5] },
        _ => Command::Fetch { corner: (x, y), size: (beat[3], beat[4]) },
    }
}

struct Golden {
    set: WidthSet,
    unit: SatFetch,
}

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        if let Some(found) = self.unit.accept(&command_of(&self.set, beat)) {
            expected.push(Expected::whole(vec![found.sum, found.area, u64::from(self.unit.error())]));
        }
    }
}

/// Small tables one behind the other, all of each loaded before it is read, and rectangles of large ones; from the tenth
/// on, a fault now and then.
struct Requests {
    set: WidthSet,
    random: Random,
    queue: VecDeque<Beat>,
    maps: usize,
}

impl Requests {
    fn push(&mut self, command: &Command) {
        // What a beat does not use is anything, and 3 is a fetch as well as 2.
        let (mut beat, counts) = fields(&self.set, command);
        let bits = bits(&self.set);
        for (at, field) in beat.iter_mut().enumerate().filter(|(at, _)| !counts.contains(at)) {
            *field = self.random.bits() & ((1 << bits[at].1) - 1);
        }
        if beat[0] == 2 && self.random.chance(20) {
            beat[0] = 3;
        }
        self.queue.push_back(beat);
    }
    fn border(&mut self) -> Border {
        if self.random.chance(50) { Border::Slide } else { Border::Clamp }
    }
    /// A corner and a size on an axis: within, across a border, and beyond.
    fn axis(&mut self, side: u64) -> (i64, u64) {
        let corner_bits = corner_bits(&self.set);
        let most = (1u64 << self.set.side_width()) - 1;
        let random = &mut self.random;
        let corner = match random.below(8) {
            0 => 0,
            1 => side as i64 - 1,
            2 => random.signed(corner_bits),
            3 => -(random.below(side + 2) as i64),
            4 => side as i64 + random.below(3) as i64,
            _ => random.below(side) as i64,
        };
        let size = match random.below(8) {
            0 => 1,
            1 => side,
            2 => random.below(most + 1),
            3 => most,
            4 => 0,
            _ => 1 + random.below(side),
        };
        (corner, size)
    }
    fn rectangle(&mut self, width: u64, height: u64) -> Command {
        let ((x, a), (y, b)) = (self.axis(width), self.axis(height));
        Command::Fetch { corner: (x, y), size: (a, b) }
    }
    /// A rectangle of a large map, of which only the four entries are loaded.
    fn large(&mut self, width: u64, height: u64) {
        let border = self.border();
        self.push(&Command::Size { width, height, border });
        for _ in 0..3 {
            let fetch = self.rectangle(width, height);
            let Command::Fetch { corner: (x, y), size: (a, b) } = fetch else { continue };
            let ((x0, x1), (y0, y1)) = (span(x, a, width, border), span(y, b, height, border));
            for (x, y) in [(x0, y0), (x1, y0), (x0, y1), (x1, y1)] {
                // What lies beyond the memory is not loaded, and yet asked for.
                if x > 0 && y > 0 && (y - 1) * width + x <= self.set.table_words() as u64 {
                    let sum = self.random.bits() & ((1 << self.set.sum_bits) - 1);
                    self.push(&Command::Load { x: x as i64, y: y as i64, sum });
                }
            }
            self.push(&fetch);
        }
    }
    fn fault(&mut self) {
        let border = self.border();
        let most = (1u64 << self.set.side_width()) - 1;
        let far = self.random.signed(corner_bits(&self.set));
        let size = |width, height| Command::Size { width, height, border };
        let load = |x, y| Command::Load { x, y, sum: 5 };
        let fetch = Command::Fetch { corner: (0, 0), size: (1, 1) };
        match self.random.below(8) {
            0 => [size(0, 3), fetch].iter().for_each(|command| self.push(command)),
            1 => [size(3, 0), load(1, 1), fetch].iter().for_each(|command| self.push(command)),
            2 => [size(2, 1), load(1, 1), load(3, 1), fetch].iter().for_each(|command| self.push(command)),
            3 => [size(2, 1), load(1, 1), load(1, 2), fetch].iter().for_each(|command| self.push(command)),
            4 => [size(1, 1), load(1, 1), load(0, 1), load(1, 0), fetch].iter().for_each(|command| self.push(command)),
            5 => [size(1, 1), load(1, 1), load(far.min(0), 1), fetch].iter().for_each(|command| self.push(command)),
            6 => {
                // The last entry lies beyond the memory, and its word modulo the memory is another one's.
                let words = self.set.table_words() as u64;
                let (x, y) = (words % most, words / most);
                [size(most, most), load(1, 1), load(x as i64 + 1, y as i64 + 1), load(most as i64, most as i64), fetch]
                    .iter()
                    .for_each(|command| self.push(command));
            }
            _ => self.large(most, most),
        }
    }
    fn fill(&mut self) {
        self.maps += 1;
        if self.maps > 10 && self.random.chance(10) {
            self.fault();
        }
        if self.maps > 3 && self.random.chance(30) {
            let table_bits = self.set.table_bits;
            match self.random.below(3) {
                // All of the memory, its last word included.
                0 => self.large(1 << table_bits.div_ceil(2), 1 << (table_bits / 2)),
                1 => {
                    let most = (1u64 << self.set.side_width()) - 1;
                    self.large(most, (self.set.table_words() as u64 / most).max(1));
                }
                _ => {
                    let width = 1 + self.random.below(1 << self.set.side_bits);
                    let height = (self.set.table_words() as u64 / width).min(1 << self.set.side_bits);
                    self.large(width, height);
                }
            }
        }
        let random = &mut self.random;
        let mut side = || match self.maps {
            // Tiny ones first, so that a short run fetches, too.
            0..=2 => 1 + random.below(2) as usize,
            _ => random_side(random),
        };
        let (width, height) = (side(), side());
        let map: Vec<u16> = (0..width * height).map(|_| random_sample(random)).collect();
        let table = golden(width, height, &map, self.set.sum_bits as u32);
        let border = self.border();
        let commands = load_commands(&table, border);
        for command in &commands {
            self.push(command);
        }
        for _ in 0..commands.len() + 10 {
            let fetch = self.rectangle(width as u64, height as u64);
            self.push(&fetch);
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
fn bits(set: &WidthSet) -> [(&'static str, usize); 9] {
    let (m, x) = (set.side_width(), corner_bits(set));
    [
        ("kind", 2),
        ("x", x),
        ("y", x),
        ("a", m),
        ("b", m),
        ("sum", set.sum_bits),
        ("width", m),
        ("height", m),
        ("slide", 1),
    ]
}

/// The golden model at a width set.
pub(crate) fn model(set: &WidthSet) -> Box<dyn Model> {
    Box::new(Golden { set: *set, unit: SatFetch::new(set.table_words(), set.sum_bits as u32) })
}

/// Random beats.
pub(crate) fn random(set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
    Box::new(Requests { set: *set, random: Random::new(seed), queue: VecDeque::new(), maps: 0 })
}

/// What a line of stimulus holds.
pub(crate) const STIMULUS_FORMAT: &str = "kind (0 size, 1 load, 2 fetch), x and y (corner, or entry), a and b (size of the rectangle), sum, width, height \
     and slide, all of them in every line";

/// The beat of a line.
pub(crate) fn parse(set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
    let mut numbers = numbers.to_vec();
    let half = 1i64 << (corner_bits(set) - 1);
    for (at, number) in numbers.iter_mut().enumerate().skip(1).take(2) {
        if !(-half..half).contains(number) {
            let name = ["x", "y"][at - 1];
            let most = half - 1;
            return Err(format!("number {} ({name}) is {number}, which does not fit -{half}..={most}", at + 1));
        }
        *number &= 2 * half - 1;
    }
    unsigned_fields(&numbers, &bits(set))
}

impl Binding for SatFetchBinding {
    fn name(&self) -> &'static str {
        "sat_fetch"
    }
    fn summary(&self) -> &'static str {
        "the sum of a rectangle from one copy of a summed-area table"
    }
    fn latency(&self) -> &'static str {
        "18"
    }
    fn interval(&self) -> &'static str {
        "4"
    }
    fn error(&self) -> &'static str {
        "0"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::SatFetch::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        model(set)
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        random(set, seed)
    }
    fn stimulus_format(&self) -> &'static str {
        STIMULUS_FORMAT
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        parse(set, numbers)
    }
}
