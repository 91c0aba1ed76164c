// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices of strips off the screen, which are not displaced.
//!
//! A piece is swept from column to column along its longest axis, and each of its triangles stands between two neighbouring
//! columns. Where that axis is x or y and a vertex is so far beyond a side that displacement brings back neither its column
//! nor the next ones, all triangles with that vertex are off the screen, and its height is nobody's concern.
//!
//! ```text
//! X' = (X + d n_x f c) / (1 + d n_z c), |n| <= 1:    |X| > half + reach c  =>  |X'| > half on the same side, or X' has no place
//! reach = max |d| / z0 (f + half)        pixels at c = 1
//! skipped <=> |X| > half + reach c + margin,  c the greatest of the piece
//! margin = 1 + 2 (1/2 + 1/2) cells: to the next column; and corners are rounded to the grid, and vertices of edges once more
//! ```
//!
//! | value | format | |
//! |-------|--------|---|
//! | reach, margin | UQ15.2 | pixels, rounded up; a reach that does not fit makes the margin all ones: nothing is skipped |
//! | limit | UQ18.2 | half + reach c + margin + 3/4, of c with 16 bits, rounded up |
//! | X, Y of a vertex | SQ13.2 | lanes, rounded down |
//!
//! Error: none, whatever is skipped is off the screen. Example: half 320, c 1/2, reach 40, margin 6: the limit is 346.75, and a
//! vertex at X = -400 is skipped; it goes on at X' = -8191.996.

use super::numbers::View;
use crate::draw::Draw;
use crate::remesher::BaseTriangle;
use crate::step::{MAX_COMPONENTS, Vertex};
use crate::vertex_transform::lane;

/// Bits of a reach and of a margin.
pub const BITS: u32 = 17;
/// The greatest X' of a displaced vertex.
const FAR: i64 = (1 << 21) - 1;

/// What a draw says of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach {
    /// How far displacement moves a vertex at c = 1 at most, 1/4 pixel.
    pub reach: i64,
    /// How far a vertex is from the columns next to it, 1/4 pixel.
    pub margin: i64,
}

impl Reach {
    /// Nothing is skipped: a limit beyond every lane.
    pub const NONE: Self = Self { reach: (1 << BITS) - 1, margin: (1 << BITS) - 1 };

    /// That of a draw for a viewport of two halves, 1/256 pixel.
    pub fn new(draw: &Draw, half: [i64; 2]) -> Self {
        let displacement = &draw.displacement;
        let heights = [displacement.minimum, displacement.minimum + (displacement.range << 8)];
        let most = heights.map(i64::abs).into_iter().max().unwrap_or(0) as f64;
        let ratio = libm::ldexp(most, displacement.exponent - 30);
        let farthest = half[0].max(half[1]) as f64 / 256.0 + f64::from(displacement.focal) / 65_536.0;
        // A normal is a unit vector but for its rounding.
        let reach = libm::ceil(4.0 * ratio * farthest * (1.0 + 1.0 / 1024.0)) + 1.0;
        let cell = 16_777_216.0 / f64::from(draw.transform.inverse_cell.max(1));
        let margin = libm::ceil(12.0 * cell);
        if reach.max(margin) > Self::NONE.reach as f64 {
            return Self::NONE;
        }
        Self { reach: reach as i64, margin: margin as i64 }
    }
}

/// Which vertices of a piece are skipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Skip {
    /// 0 x, 1 y.
    axis: usize,
    /// 1/4 pixel.
    limit: i64,
}

impl Skip {
    /// Of a piece; none if it has no longest axis across the screen.
    pub fn of(draw: &Draw, view: &View, piece: &BaseTriangle) -> Option<Self> {
        let span = |axis: usize| {
            let at = piece.corners.map(|corner| corner[axis]);
            i64::from(at[0].max(at[1]).max(at[2])) - i64::from(at[0].min(at[1]).min(at[2]))
        };
        let spans = [0, 1, 2].map(span);
        let axis = (0..2).find(|&axis| spans[axis] > spans[1 - axis] && spans[axis] > spans[2])?;
        let c = piece.data.iter().map(|vertex| draw.lanes.widen(vertex)[lane::C]).fold(0, i64::max);
        let near = (((c >> 15) + 1) * view.reach.reach) >> 16;
        (view.skips && !view.passes)
            .then_some(Self { axis, limit: (view.half[axis] >> 6) + near + view.reach.margin + 3 })
    }

    /// What goes on instead of a vertex that is skipped: a place beyond the same side.
    pub fn displaced(&self, draw: &Draw, vertex: &Vertex) -> Option<Vertex> {
        let at = draw.lanes.widen(vertex)[self.axis] >> 16;
        let side = match at {
            at if at > self.limit => FAR,
            at if at < -self.limit => -FAR,
            _ => return None,
        };
        let mut out = [0; MAX_COMPONENTS];
        out[self.axis] = side;
        Some(out)
    }
}
