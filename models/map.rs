// SPDX-License-Identifier: MIT OR Apache-2.0
//! Height maps: 16-bit samples in rows, from a grey PNG or from a formula.
//!
//! ```text
//! sample (i, j) = samples[j * width + i],   i to the right, j down, row 0 on top
//! clamp axis of n samples:   texel = u (n - 1)      u = 0 and u = 1 are the first and the last sample
//! repeat axis of n samples:  texel = u n  (mod n)   u = 1 is the first sample again
//! ```
//!
//! A map lies in the memories of the hardware as a pyramid of node-centred levels: a clamp axis of `n` samples has
//! `n / 2 + 1` on the next level, a repeat axis `n / 2`. [`levels`] lists them, [`bank_words`] adds them up, and
//! [`Limit::check`] tells whether they fit.
//!
//! ```
//! use relief_models::map::{HeightMap, Procedural, Wrap, levels};
//! let ramp = HeightMap::procedural(Procedural::Ramp, 3, 1);
//! assert_eq!(ramp.samples, [0, 32768, 65535]);
//! assert_eq!(levels([8, 5], [Wrap::Repeat, Wrap::Clamp]), [[8, 5], [4, 3], [2, 2]]);
//! ```

use crate::mip_build::{Centring, max_levels, side_above};

mod procedural;
mod read_png;

pub use crate::mip_build::Wrap;
pub use procedural::Procedural;
pub use read_png::{read, read_from, read_values};

/// How large a map may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limit {
    /// Samples along an axis: what the hardware's numbers of a side count.
    pub side: usize,
    /// Words in each of the four banks of the map memory.
    pub bank_words: u64,
}

impl Limit {
    /// That of the width set `large`, the last that scenes run on.
    pub const LARGEST: Limit = Limit { side: 2_047, bank_words: 131_072 };

    /// Whether the memory can hold a map of this size with its lowest `levels`, once or with maxima and minima as `both`
    /// says, and read four texels of it at once.
    ///
    /// # Errors
    /// What the map is or does instead, as the end of a sentence.
    pub fn check(&self, size: [usize; 2], wrap: [Wrap; 2], levels: usize, both: bool) -> Result<(), String> {
        let Limit { side, bank_words: limit } = *self;
        if size.iter().any(|samples| *samples > side) {
            return Err(format!("has a side beyond the limit of {side}; a smaller map is expected"));
        }
        if let Some(axis) = (0..2).find(|axis| wrap[*axis] == Wrap::Repeat && size[*axis] % 2 == 1) {
            let (axis, period) = (["u", "v"][axis], size[axis]);
            let what = format!("repeats in {axis} with a period of {period} samples, which is odd");
            return Err(format!("{what}; an even number, or better a power of two, is expected"));
        }
        let words = bank_words(size, wrap, levels, both);
        if words <= limit {
            return Ok(());
        }
        let what = format!("takes {words} words in each of the four banks of the map memory");
        let with = if both { "with maxima and minima of its levels" } else { "with its levels" };
        Err(format!("{what}, {with}, beyond the limit of {limit}; a smaller map is expected"))
    }
}

/// A map of 16-bit heights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeightMap {
    /// Samples in a row, at least 1.
    pub width: usize,
    /// Rows, at least 1.
    pub height: usize,
    /// `width * height` samples, row by row, the top row first.
    pub samples: Vec<u16>,
}

impl HeightMap {
    /// The sample in column `i` and row `j`.
    pub fn sample(&self, i: usize, j: usize) -> u16 {
        self.samples[j * self.width + i]
    }

    /// The least and the greatest sample; of no sample, 65535 and 0.
    pub fn range(&self) -> [u16; 2] {
        self.samples.iter().fold([u16::MAX, 0], |[low, high], &at| [low.min(at), high.max(at)])
    }

    /// The map with its first column, or row, once more behind the last one of each axis that repeats: a whole period from
    /// rim to rim.
    pub fn unrolled(&self, wrap: [Wrap; 2]) -> HeightMap {
        let [width, height] =
            [self.width + usize::from(wrap[0] == Wrap::Repeat), self.height + usize::from(wrap[1] == Wrap::Repeat)];
        let samples = (0..height).flat_map(|j| (0..width).map(move |i| self.sample(i % self.width, j % self.height)));
        HeightMap { width, height, samples: samples.collect() }
    }

    /// The map with one value, the greatest, all along its first row, and along its last one: poles.
    pub fn with_poles(&self) -> HeightMap {
        let mut map = self.clone();
        for j in [0, self.height - 1] {
            let row = &mut map.samples[j * self.width..(j + 1) * self.width];
            row.fill(row.iter().copied().max().unwrap_or(0));
        }
        map
    }
}

/// Sizes of the levels of a map's pyramid, level 0 first: as many as [`max_levels`].
pub fn levels(size: [usize; 2], wrap: [Wrap; 2]) -> Vec<[usize; 2]> {
    let count = max_levels(size[0], size[1], Centring::Node, wrap);
    let above = |size: &[usize; 2]| Some([0, 1].map(|axis| side_above(size[axis], Centring::Node, wrap[axis])));
    std::iter::successors(Some(size), above).take(count).collect()
}

/// Words of the lowest `most` levels of a map's pyramid in each of four banks, which hold the even and the odd columns of
/// the even and the odd rows; `both` are maxima and minima, which have the map in common.
pub fn bank_words(size: [usize; 2], wrap: [Wrap; 2], most: usize, both: bool) -> u64 {
    let words = |level: &[usize; 2]| {
        let [width, height] = level.map(|side| side.div_ceil(2) as u64);
        width.saturating_mul(height)
    };
    let levels = levels(size, wrap);
    let minima = levels.iter().take(most).skip(1).take_while(|_| both);
    levels.iter().take(most).chain(minima).map(words).fold(0, u64::saturating_add)
}
