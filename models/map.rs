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

use crate::mip_build::{Centring, max_levels, side_above};

mod procedural;
mod read_png;

pub use crate::mip_build::Wrap;
pub use procedural::Procedural;
pub use read_png::{read, read_from, read_values};

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

/// Sizes of the levels of a map's pyramid, level 0 first: as many as [`max_levels`].
pub fn levels(size: [usize; 2], wrap: [Wrap; 2]) -> Vec<[usize; 2]> {
    let count = max_levels(size[0], size[1], Centring::Node, wrap);
    let above = |size: &[usize; 2]| Some([0, 1].map(|axis| side_above(size[axis], Centring::Node, wrap[axis])));
    std::iter::successors(Some(size), above).take(count).collect()
}

/// Words of all levels of a map's pyramid.
pub fn words(size: [usize; 2], wrap: [Wrap; 2]) -> u64 {
    levels(size, wrap).iter().map(|[width, height]| (*width as u64).saturating_mul(*height as u64)).sum()
}
