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
//! `n / 2 + 1` on the next level, a repeat axis `n / 2`. [`levels`] lists them, [`words`] adds them up.
//!
//! ```
//! use relief_models::map::{HeightMap, Procedural, Wrap, levels};
//! let ramp = HeightMap::procedural(Procedural::Ramp, 3, 1);
//! assert_eq!(ramp.samples, [0, 32768, 65535]);
//! assert_eq!(levels([8, 5], [Wrap::Repeat, Wrap::Clamp]), [[8, 5], [4, 3], [2, 2]]);
//! ```

use serde::Deserialize;

mod procedural;
mod read_png;

pub use procedural::Procedural;
pub use read_png::{read, read_from};

/// Words of the pyramid memory in the default width set, over all levels.
pub const MEMORY_WORDS: u64 = 524_288;

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
}

/// What lies beyond the rim of a map, along one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Wrap {
    /// The rim itself.
    #[default]
    Clamp,
    /// The map again. Its period has to be even, or the four banks of the memory cannot be read in one cycle.
    Repeat,
}

impl Wrap {
    /// Samples of the next level of an axis that has `n`.
    fn next(self, n: usize) -> usize {
        match self {
            Wrap::Clamp => n / 2 + 1,
            Wrap::Repeat => n / 2,
        }
    }
}

/// Sizes of the levels of a map's pyramid: down to where no axis shrinks, or where a period would become odd.
pub fn levels(size: [usize; 2], wrap: [Wrap; 2]) -> Vec<[usize; 2]> {
    let mut levels = vec![size];
    let mut now = size;
    loop {
        // A single sample stays one: its neighbours are itself.
        let next = [0, 1].map(|axis| if now[axis] == 1 { 1 } else { wrap[axis].next(now[axis]) });
        let has_odd_period = (0..2).any(|axis| wrap[axis] == Wrap::Repeat && next[axis] % 2 == 1);
        if next == now || has_odd_period {
            return levels;
        }
        levels.push(next);
        now = next;
    }
}

/// Words of all levels of a map's pyramid.
pub fn words(size: [usize; 2], wrap: [Wrap; 2]) -> u64 {
    levels(size, wrap).iter().map(|[width, height]| (*width as u64).saturating_mul(*height as u64)).sum()
}
