// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a texel of a pyramid's level, the nearest one or between four.
//!
//! ```text
//! i = floor(u / 2^L), a = the 12 bits below it; j and b from v likewise     (u, v in texels of level 0)
//! bilinear: q = floor((t00 (4096 - a)(4096 - b) + t10 a (4096 - b) + t01 (4096 - a) b + t11 a b) / 2^16 + 1/2)
//! nearest:  q = 256 t, t the texel next to (u, v): the right one for a >= 2048, the lower one for b >= 2048
//! clamp axis: i and i + 1 are clamped to the last sample
//! repeat axis: one period is taken off if need be; at two periods and beyond it is an error, and the last sample
//! ```
//!
//! | field  | format  | range |
//! |--------|---------|-------|
//! | u, v   | UQ13.16 | whole; below two periods on a repeat axis |
//! | level  | 4 bits  | whole; beyond the last level it is the last level |
//! | result | UQ16.8  | 0 ..= 65535.0 |
//!
//! Example: between texels 100 and 200, a quarter of the way (u = 0.25): 125.0 = 0x7d00.
//!
//! Error: 1/2 unit of the result (round half up) at points with 12 fraction bits at their level. Other points are read
//! at the next such point below, less than 2^-12 texels of the level away. The result is monotone in every texel, and
//! on a node it is the texel.
//!
//! The memory has four banks, so that all four texels come in one cycle: texel (i, j) of level L stands in bank
//! `(j & 1) * 2 + (i & 1)`, word `base[L] + (j >> 1) * pitch[L] + (i >> 1)`. A level of minima may stand beside one of maxima, the
//! same size in another place; each fetch says which it reads.

use crate::fixed::shift_round_half_up;
use crate::mip_build::{Level, MAX_LEVELS, Pyramid, Wrap};
use crate::rules::Pyramids;

/// Fraction bits of a coordinate.
pub const FRACTION_BITS: u32 = 16;
/// Bits of a coordinate.
pub const COORDINATE_BITS: u32 = 29;
/// Bits of a weight.
pub const WEIGHT_BITS: u32 = 12;

/// How a value is made of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The nearest texel.
    Nearest,
    /// Linear in both directions between four texels.
    Bilinear,
}

/// A value, and whether a coordinate lay beyond two periods of a repeat axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fetched {
    /// UQ16.8.
    pub value: u32,
    /// The value is that of the last sample instead.
    pub error: bool,
}

/// Where a level stands in the memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placement {
    /// Samples in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// First word in every bank.
    pub base: usize,
    /// First word of its minima in every bank; `base` where the level has no others.
    pub minima_base: usize,
    /// Words from a row to the second next one, half a row.
    pub pitch: usize,
    /// The borders of the axes u and v.
    pub wrap: [Wrap; 2],
}

impl Placement {
    /// Bank and word of the sample in column `i` of row `j`.
    pub fn place(&self, i: usize, j: usize) -> (usize, usize) {
        ((j & 1) * 2 + (i & 1), self.base + (j >> 1) * self.pitch + (i >> 1))
    }
    /// The same level with its minima in place of its maxima.
    pub const fn of_minima(self) -> Self {
        Self { base: self.minima_base, ..self }
    }
    /// Whether it has minima of its own.
    pub const fn has_minima(&self) -> bool {
        self.minima_base != self.base
    }
    /// Words that the level takes in every bank.
    pub fn words(&self) -> usize {
        self.pitch * self.height.div_ceil(2)
    }
    /// The level can be read without conflicts: it has samples, its rows do not overlap, and its periods are even.
    pub fn is_sound(&self) -> bool {
        let odd = |side: usize, wrap| wrap == Wrap::Repeat && side % 2 == 1;
        self.width > 0
            && self.height > 0
            && self.pitch >= self.width.div_ceil(2)
            && !odd(self.width, self.wrap[0])
            && !odd(self.height, self.wrap[1])
    }
}

impl Pyramid {
    /// Where the levels stand in the memory, one behind the other.
    pub fn layout(&self) -> Vec<Placement> {
        let mut base = 0;
        let place = |level: &Level| {
            let (width, height) = (level.width, level.height);
            let pitch = width.div_ceil(2);
            let placement = Placement { width, height, base, minima_base: base, pitch, wrap: self.wrap };
            base += placement.words();
            placement
        };
        self.levels.iter().map(place).collect()
    }
    /// Words that the pyramid takes in every bank.
    pub fn bank_words(&self) -> usize {
        self.layout().iter().map(Placement::words).sum()
    }
}

impl<'a> Pyramids<'a> {
    /// Where the levels stand: those of the maxima one behind the other, then those of the minima but the map, which is one
    /// for both.
    pub fn layout(&self) -> Vec<Placement> {
        let mut layout = self.maxima.layout();
        let mut base = self.maxima.bank_words();
        // Both have the same sizes.
        for placement in layout.iter_mut().skip(1).take_while(|_| self.minima.is_some()) {
            placement.minima_base = base;
            base += placement.words();
        }
        layout
    }
    /// Words that they take in every bank.
    pub fn bank_words(&self) -> usize {
        let ends = self.layout().into_iter().flat_map(|of| [of, of.of_minima()]).map(|of| of.base + of.words());
        ends.max().unwrap_or(0)
    }
    /// The commands that put them into a memory from word `offset` of the banks on: sizes, then samples.
    pub fn commands(self, offset: usize) -> impl Iterator<Item = Command> + 'a {
        let sizes = self.layout().into_iter().enumerate().map(move |(level, placement)| {
            let Placement { base, minima_base, .. } = placement;
            let placement = Placement { base: base + offset, minima_base: minima_base + offset, ..placement };
            Command::Size { level, placement }
        });
        let of = |pyramid: Option<&'a Pyramid>, minima: bool| {
            let levels = pyramid.map_or(&[][..], |pyramid| &pyramid.levels).iter().enumerate();
            levels.skip(usize::from(minima)).flat_map(move |(level, samples)| {
                let all = (0..samples.height).flat_map(|j| (0..samples.width).map(move |i| (i, j)));
                all.map(move |(i, j)| Command::Load { level, minima, i, j, value: samples.at(i, j) })
            })
        };
        sizes.chain(of(Some(self.maxima), false)).chain(of(self.minima, true))
    }
}

/// Two neighbours on an axis, the weight of the second one in 4096ths, and whether the coordinate was out of range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Taps {
    first: usize,
    second: usize,
    weight: i64,
    error: bool,
}

fn taps(coordinate: u32, level: usize, side: usize, wrap: Wrap, filter: Filter) -> Taps {
    let shifted = (u64::from(coordinate) & ((1 << COORDINATE_BITS) - 1)) >> level;
    let index = (shifted >> FRACTION_BITS) as usize;
    let fraction = ((shifted >> (FRACTION_BITS - WEIGHT_BITS)) & ((1 << WEIGHT_BITS) - 1)) as i64;
    let last = side - 1;
    let (first, second, error) = match wrap {
        Wrap::Clamp => (index.min(last), (index + 1).min(last), false),
        Wrap::Repeat if index < 2 * side => (index % side, (index + 1) % side, false),
        Wrap::Repeat => (last, last, true),
    };
    let weight = match filter {
        Filter::Bilinear => fraction,
        Filter::Nearest => (fraction >> (WEIGHT_BITS - 1)) << WEIGHT_BITS,
    };
    Taps { first, second, weight, error }
}

/// The value between four texels, weights in 4096ths: UQ16.8, rounded half up, once.
fn blend(texels: [u16; 4], a: i64, b: i64) -> u32 {
    let [t00, t10, t01, t11] = texels.map(i64::from);
    let one = 1 << WEIGHT_BITS;
    let sum = t00 * (one - a) * (one - b) + t10 * a * (one - b) + t01 * (one - a) * b + t11 * a * b;
    shift_round_half_up(sum, 2 * WEIGHT_BITS - 8) as u32
}

/// The value at (u, v) of a level, UQ16.8.
pub fn fetch(pyramid: &Pyramid, level: usize, u: u32, v: u32, filter: Filter) -> u32 {
    fetch_checked(pyramid, level, u, v, filter).value
}

/// The four texels t00, t10, t01, t11 round (u, v) of a level, and their taps.
fn gather(pyramid: &Pyramid, level: usize, u: u32, v: u32, filter: Filter) -> ([u16; 4], [Taps; 2]) {
    let level = level.min(pyramid.levels.len() - 1);
    let samples = &pyramid.levels[level];
    let x = taps(u, level, samples.width, pyramid.wrap[0], filter);
    let y = taps(v, level, samples.height, pyramid.wrap[1], filter);
    let texel = |i, j| samples.at(i, j);
    let texels =
        [texel(x.first, y.first), texel(x.second, y.first), texel(x.first, y.second), texel(x.second, y.second)];
    (texels, [x, y])
}

/// The value at (u, v) of a level, and whether it is an error.
pub fn fetch_checked(pyramid: &Pyramid, level: usize, u: u32, v: u32, filter: Filter) -> Fetched {
    let (texels, [x, y]) = gather(pyramid, level, u, v, filter);
    Fetched { value: blend(texels, x.weight, y.weight), error: x.error || y.error }
}

/// What lies round (u, v) of a level: the texels t00, t10, t01, t11, and the weights of the second column and row, UQ0.12.
pub fn patch(pyramid: &Pyramid, level: usize, u: u32, v: u32) -> ([u16; 4], [u32; 2]) {
    let (texels, taps) = gather(pyramid, level, u, v, Filter::Bilinear);
    (texels, taps.map(|taps| taps.weight as u32))
}

/// Exact reference: the value at (u, v) texels of level 0, clamped, with real weights.
pub fn exact(pyramid: &Pyramid, level: usize, u: f64, v: f64) -> f64 {
    let samples = &pyramid.levels[level];
    let scale = f64::from(1u32 << level);
    let axis = |coordinate: f64, side: usize, wrap: Wrap| {
        let at = coordinate / scale;
        let index = |offset: f64| match wrap {
            Wrap::Clamp => (at.floor() + offset).min(side as f64 - 1.0) as usize,
            Wrap::Repeat => (at.floor() + offset) as usize % side,
        };
        (index(0.0), index(1.0), at - at.floor())
    };
    let (i0, i1, a) = axis(u, samples.width, pyramid.wrap[0]);
    let (j0, j1, b) = axis(v, samples.height, pyramid.wrap[1]);
    let texel = |i, j| f64::from(samples.at(i, j));
    let upper = texel(i0, j0) * (1.0 - a) + texel(i1, j0) * a;
    let lower = texel(i0, j1) * (1.0 - a) + texel(i1, j1) * a;
    upper * (1.0 - b) + lower * b
}

/// What a beat of the memory says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Where a level stands; levels come in order, and the sizes of the levels above are forgotten.
    Size {
        /// The level.
        level: usize,
        /// Its place.
        placement: Placement,
    },
    /// A sample.
    Load {
        /// The level.
        level: usize,
        /// Whether it is one of the minima.
        minima: bool,
        /// Column.
        i: usize,
        /// Row.
        j: usize,
        /// The sample.
        value: u16,
    },
    /// A request.
    Fetch {
        /// The level.
        level: usize,
        /// UQ13.16.
        u: u32,
        /// UQ13.16.
        v: u32,
        /// The filter.
        filter: Filter,
        /// Whether minima are read.
        minima: bool,
    },
}

/// Where the maxima or the minima of a level stand, and which of its two planes that is.
const fn of(placement: Placement, minima: bool) -> (Placement, usize) {
    if minima { (placement.of_minima(), placement.has_minima() as usize) } else { (placement, 0) }
}

/// Golden model of the memory: levels, the samples loaded, and the sticky error.
///
/// A sample that was not loaded since the size of its level reads as zero here and as anything in hardware.
#[derive(Clone, Debug)]
pub struct MipFetch {
    /// Maxima and minima; the latter where the level has its own.
    levels: Vec<(Placement, [Level; 2])>,
    bank_words: usize,
    error: bool,
}

impl MipFetch {
    /// An empty memory of four banks of `bank_words` words.
    pub const fn new(bank_words: usize) -> Self {
        Self { levels: Vec::new(), bank_words, error: false }
    }

    /// Sticky: a size that cannot be used, a load outside of its level or of the memory, a fetch before a size, beyond
    /// two periods, or outside of the memory.
    pub const fn error(&self) -> bool {
        self.error
    }

    /// Takes one beat; a fetch gives its value.
    pub fn accept(&mut self, command: &Command) -> Option<u32> {
        match *command {
            Command::Size { level, placement } => {
                if level > self.levels.len() || level >= MAX_LEVELS {
                    self.error = true;
                    return None;
                }
                self.levels.truncate(level);
                if placement.is_sound() {
                    let Placement { width, height, .. } = placement;
                    let empty = || Level { width, height, samples: vec![0; width * height] };
                    self.levels.push((placement, [empty(), empty()]));
                } else {
                    self.error = true;
                }
                None
            }
            Command::Load { level, minima, i, j, value } => {
                let bank_words = self.bank_words;
                match self.levels.get_mut(level) {
                    Some((placement, planes))
                        if i < placement.width
                            && j < placement.height
                            && of(*placement, minima).0.place(i, j).1 < bank_words =>
                    {
                        planes[of(*placement, minima).1].samples[j * placement.width + i] = value;
                    }
                    _ => self.error = true,
                }
                None
            }
            Command::Fetch { level, u, v, filter, minima } => Some(self.fetch(level, u, v, filter, minima)),
        }
    }

    fn fetch(&mut self, level: usize, u: u32, v: u32, filter: Filter, minima: bool) -> u32 {
        let Some(last) = self.levels.len().checked_sub(1) else {
            self.error = true;
            return 0;
        };
        let level = level.min(last);
        let (placement, planes) = &self.levels[level];
        let (placement, plane) = of(*placement, minima);
        let samples = &planes[plane];
        let x = taps(u, level, samples.width, placement.wrap[0], filter);
        let y = taps(v, level, samples.height, placement.wrap[1], filter);
        // A word beyond the memory reads as zero.
        let mut beyond = false;
        let mut texel = |i, j| {
            let inside = placement.place(i, j).1 < self.bank_words;
            beyond |= !inside;
            if inside { samples.at(i, j) } else { 0 }
        };
        let texels =
            [texel(x.first, y.first), texel(x.second, y.first), texel(x.first, y.second), texel(x.second, y.second)];
        self.error |= x.error || y.error || beyond;
        blend(texels, x.weight, y.weight)
    }
}
