// SPDX-License-Identifier: MIT OR Apache-2.0
//! How well a filter keeps the horizon of a height map (Gumhold & Huettner 1999, figure 19).
//!
//! A grid of vertices, `step` texels apart, takes its heights from the filter's level for that step, and its cells are cut
//! along the diagonal from their first corner. Seen from the side, along v and along u, the map and the mesh have a
//! horizon each: the greatest height in every column of texels, and for filters that keep what lies lowest, the least.
//! Both are compared column by column, for all `step` places that the grid can have.
//!
//! ```text
//! error(x) = mesh(x) - map(x)      turned over for the lower horizon, so that what is lost is negative
//! ```
//!
//! All figures are shares of the range of the map, in percent (of 1 where it has none).

use crate::filters::Filter;
use crate::map::HeightMap;
use crate::mip_build::{MipError, Pyramid, Wrap};
use crate::mip_fetch::FRACTION_BITS;
use serde::Serialize;
use thiserror::Error;

/// What a filter does to the horizon at a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Horizon {
    /// The level that is read.
    pub level: usize,
    /// The root of the mean squared error.
    pub rms: f64,
    /// The mean error: above 0, the mesh is too high.
    pub mean: f64,
    /// By how much the highest point of the mesh lies below that of the map, in the mean over the places of the grid.
    pub peak_loss: f64,
    /// By how much the mesh lies below the map where that is most; below 0, it is above it everywhere.
    pub deepest: f64,
}

/// The horizons of map and mesh over the columns of texels that both cover, but the last.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The first column.
    pub first: usize,
    /// Heights of the map, map units.
    pub map: Vec<f64>,
    /// Heights of the mesh.
    pub mesh: Vec<f64>,
}

/// Why there is nothing to measure.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SilhouetteError {
    /// The grid has no cell at some place.
    #[error("the map has {width} x {height} samples, and a grid of {step} texels needs at least {} on each side", 2 * step)]
    Small {
        /// Samples in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Texels from vertex to vertex.
        step: u32,
    },
    /// Vertices on one another.
    #[error("a grid of 0 texels has no cells; at least 1 is expected")]
    NoStep,
    /// There are no levels.
    #[error(transparent)]
    Levels(#[from] MipError),
}

/// Whether a map has room for a grid of `step` texels at every place.
///
/// # Errors
/// It has not, or there is no step.
pub fn check(map: &HeightMap, step: u32) -> Result<(), SilhouetteError> {
    let HeightMap { width, height, .. } = *map;
    match step {
        0 => Err(SilhouetteError::NoStep),
        _ if width.min(height) < 2 * step as usize => Err(SilhouetteError::Small { width, height, step }),
        _ => Ok(()),
    }
}

/// A filter at a step, ready to be looked at.
#[derive(Clone, Debug)]
pub struct View<'a> {
    map: &'a HeightMap,
    filter: Filter,
    pyramid: &'a Pyramid,
    level: usize,
    step: usize,
}

impl<'a> View<'a> {
    /// A view of a map through a filter's pyramid, which has the level for `step` texels, or the last that there is is
    /// taken.
    ///
    /// # Errors
    /// See [`SilhouetteError`].
    pub fn new(map: &'a HeightMap, filter: Filter, pyramid: &'a Pyramid, step: u32) -> Result<Self, SilhouetteError> {
        check(map, step)?;
        let level = filter.level(step).min(pyramid.levels.len() - 1);
        Ok(Self { map, filter, pyramid, level, step: step as usize })
    }

    /// The horizons, seen along v (`axis` 0, columns are u) or along u, with the first vertex of the grid on texel
    /// `place` of both axes, `place < step`.
    pub fn profile(&self, axis: usize, place: usize) -> Profile {
        let sides = [self.map.width, self.map.height];
        let [width, height] = [sides[axis], sides[1 - axis]];
        let turn = |x: usize, y: usize| if axis == 0 { [x, y] } else { [y, x] };
        // What counts is the greatest height, or the least.
        let sign = if self.filter.is_lower() { -1.0 } else { 1.0 };
        let vertices = |side: usize| (side - 1 - place) / self.step + 1;
        let [columns, rows] = [vertices(width), vertices(height)];
        let vertex = |i: usize, j: usize| {
            let at = turn(place + i * self.step, place + j * self.step).map(|texel| (texel as u32) << FRACTION_BITS);
            sign * f64::from(self.filter.at(self.pyramid, self.level, at)) / 256.0
        };
        let chain = |i: usize| (0..rows).map(|j| vertex(i, j)).collect::<Vec<f64>>();
        let last_row = place + (rows - 1) * self.step;
        let (mut map, mut mesh) = (Vec::new(), Vec::new());
        let mut left = chain(0);
        for i in 1..columns {
            let right = chain(i);
            for part in 0..self.step {
                let share = part as f64 / self.step as f64;
                let along = |a: f64, b: f64| a + share * (b - a);
                let across = left.iter().zip(&right).chain(left.iter().zip(&right[1..]));
                mesh.push(across.map(|(a, b)| along(*a, *b)).fold(f64::NEG_INFINITY, f64::max));
                let x = place + (i - 1) * self.step + part;
                let texel = |y: usize| {
                    let [u, v] = turn(x, y);
                    sign * f64::from(self.map.sample(u, v))
                };
                map.push((place..=last_row).map(texel).fold(f64::NEG_INFINITY, f64::max));
            }
            left = right;
        }
        let turned = |heights: Vec<f64>| heights.into_iter().map(|height| sign * height).collect();
        Profile { first: place, map: turned(map), mesh: turned(mesh) }
    }

    /// What the filter does to the horizon, over both directions and all places of the grid.
    pub fn horizon(&self) -> Horizon {
        let sign = if self.filter.is_lower() { -1.0 } else { 1.0 };
        let [low, high] = self.map.range();
        let percent = 100.0 / f64::from(high.saturating_sub(low).max(1));
        let (mut count, mut sum, mut squares, mut deepest) = (0.0, 0.0, 0.0, f64::NEG_INFINITY);
        let mut peaks = 0.0;
        for (axis, place) in (0..2).flat_map(|axis| (0..self.step).map(move |place| (axis, place))) {
            let profile = self.profile(axis, place);
            let highest =
                |heights: &[f64]| heights.iter().map(|height| sign * height).fold(f64::NEG_INFINITY, f64::max);
            peaks += highest(&profile.map) - highest(&profile.mesh);
            for (mesh, map) in profile.mesh.iter().zip(&profile.map) {
                let error = sign * (mesh - map);
                (count, sum, squares, deepest) =
                    (count + 1.0, sum + error, squares + error * error, deepest.max(-error));
            }
        }
        Horizon {
            level: self.level,
            rms: percent * f64::sqrt(squares / count),
            mean: percent * sum / count,
            peak_loss: percent * peaks / (2 * self.step) as f64,
            // No error is 0, not -0.
            deepest: percent * deepest + 0.0,
        }
    }
}

/// The levels that a map needs for grids of up to `step` texels, the map included, as far as it has them.
pub fn levels(map: &HeightMap, wrap: [Wrap; 2], step: u32) -> usize {
    let most = Filter::Average.level(step) + 1;
    most.min(crate::map::levels([map.width, map.height], wrap).len()).max(1)
}
