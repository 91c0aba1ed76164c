// SPDX-License-Identifier: MIT OR Apache-2.0
//! Filters of a height map: what a sample of a level keeps of the texels round it.
//!
//! | filter | a sample of level L is | stands on |
//! |---|---|---|
//! | `point` | there is only level 0: the map | texel |
//! | `average` | the mean of 2 x 2 samples of the level below, rounded half up | cell |
//! | `median` | what three rounds of weighted medians make of it ([`variational::median`]), integers alone | node |
//! | `variational` | what makes the volume between map and level least ([`variational::descend`]) | node |
//! | `cell-max`, `cell-min` | the extremum of 2 x 2 samples of the level below | cell |
//! | `node-max`, `node-min` | the extremum of 3 x 3 samples of the level below ([`mip_build`]) | node |
//!
//! (Gumhold & Huettner 1999, sections 4.1 to 4.3, equation 12 and figure 19.) Node i stands on texel i 2^L, cell i
//! covers the texels i 2^L .. (i + 1) 2^L. All are read bilinearly, by [`mip_fetch`].
//!
//! Error: that of its rounding, but for the extrema, which copy. Example: of the row 1, 5, 2, 0, the cells of `average`
//! are 3, 1, those of `cell-max` 5, 2, and the nodes of `node-max` 5, 5, 0.

mod average;
pub mod variational;

use crate::filter_level::thresholds;
use crate::map::HeightMap;
use crate::mip_build::{self, Centring, Extremum, Level, MipError, Pyramid, Wrap};
use crate::mip_fetch::{self, FRACTION_BITS};

/// A filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The table above says it.
pub enum Filter {
    Point,
    Average,
    Median,
    Variational,
    CellMax,
    CellMin,
    NodeMax,
    NodeMin,
}

impl Filter {
    /// All of them.
    pub const ALL: [Filter; 8] = [
        Filter::Point,
        Filter::Average,
        Filter::Median,
        Filter::Variational,
        Filter::CellMax,
        Filter::CellMin,
        Filter::NodeMax,
        Filter::NodeMin,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Filter::Point => "point",
            Filter::Average => "average",
            Filter::Median => "median",
            Filter::Variational => "variational",
            Filter::CellMax => "cell-max",
            Filter::CellMin => "cell-min",
            Filter::NodeMax => "node-max",
            Filter::NodeMin => "node-min",
        }
    }

    /// Whether it keeps what lies lowest: for surfaces that are seen from below.
    pub const fn is_lower(self) -> bool {
        matches!(self, Filter::CellMin | Filter::NodeMin)
    }

    const fn centring(self) -> Centring {
        match self {
            Filter::Average | Filter::CellMax | Filter::CellMin => Centring::Cell,
            Filter::Point | Filter::Median | Filter::Variational | Filter::NodeMax | Filter::NodeMin => Centring::Node,
        }
    }

    /// The pyramid of a map, of so many levels, the map included; `Point` has one.
    ///
    /// # Errors
    /// See [`MipError`].
    pub fn pyramid(self, map: &HeightMap, wrap: [Wrap; 2], levels: usize) -> Result<Pyramid, MipError> {
        let HeightMap { width, height, samples } = map;
        let extrema =
            |extremum, levels| mip_build::golden(*width, *height, samples, self.centring(), wrap, extremum, levels);
        let mut pyramid = match self {
            Filter::Point => return extrema(Extremum::Max, 1),
            Filter::CellMin | Filter::NodeMin => return extrema(Extremum::Min, levels),
            // The others have the same levels of the same sizes, or none for the same reasons.
            _ => extrema(Extremum::Max, levels)?,
        };
        for level in 1..levels {
            pyramid.levels[level] = match self {
                Filter::Average => average::above(&pyramid.levels[level - 1], wrap),
                Filter::Median => variational::median(map, wrap, level),
                Filter::Variational => variational::descend(map, wrap, level),
                _ => break,
            };
        }
        Ok(pyramid)
    }

    /// The level for vertices that stand `step` texels apart: the number k of thresholds sqrt(2) 2^i up to the step, and one
    /// less for extrema on nodes, whose samples cover two steps of their level. A step is at most 65535.
    pub const fn level(self, step: u32) -> usize {
        let k = thresholds(step << 16) as usize;
        match self {
            Filter::Point => 0,
            Filter::NodeMax | Filter::NodeMin => k.saturating_sub(1),
            _ => k,
        }
    }

    /// The value at (u, v) texels of level 0, UQ16.8. Coordinates have [`FRACTION_BITS`]; on an axis that repeats they count
    /// modulo the period.
    pub fn at(self, pyramid: &Pyramid, level: usize, place: [u32; 2]) -> u32 {
        let [u, v] = self.on_level(pyramid, level, place);
        mip_fetch::fetch(pyramid, level, u, v, mip_fetch::Filter::Bilinear)
    }

    /// The texels round (u, v) and their weights, as [`mip_fetch::patch`]; the place as in [`at`](Self::at).
    pub fn patch(self, pyramid: &Pyramid, level: usize, place: [u32; 2]) -> ([u16; 4], [u32; 2]) {
        let [u, v] = self.on_level(pyramid, level, place);
        mip_fetch::patch(pyramid, level, u, v)
    }

    /// Where the level is read for (u, v).
    fn on_level(self, pyramid: &Pyramid, level: usize, [u, v]: [u32; 2]) -> [u32; 2] {
        // The middle of cell 0 lies (2^L - 1) / 2 texels beyond texel 0.
        let middle = match self.centring() {
            Centring::Node => 0,
            Centring::Cell => ((1 << level) - 1) << (FRACTION_BITS - 1),
        };
        let sides = [pyramid.levels[0].width, pyramid.levels[0].height];
        [(u, 0), (v, 1)].map(|(coordinate, axis)| match pyramid.wrap[axis] {
            Wrap::Clamp => coordinate.saturating_sub(middle),
            Wrap::Repeat => {
                let period = (sides[axis] as u64) << FRACTION_BITS;
                ((u64::from(coordinate) + period - u64::from(middle) % period) % period) as u32
            }
        })
    }
}

/// A level of so many samples, each made of its place.
fn fill(width: usize, height: usize, mut sample: impl FnMut(usize, usize) -> u16) -> Level {
    let mut samples = Vec::with_capacity(width * height);
    for j in 0..height {
        samples.extend((0..width).map(|i| sample(i, j)));
    }
    Level { width, height, samples }
}
