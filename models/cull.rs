// SPDX-License-Identifier: MIT OR Apache-2.0
//! Culls base triangles whose displaced surface cannot be seen.
//!
//! ```text
//! outcode bit k = (a_k . position + D_k < 0)        a_k: inward normal of a side of the view volume, D: reach
//! culled <=> the outcodes of the three corners have a bit in common
//! ```
//!
//! The volume of sight is extended by the object's largest displacement D, once for all its base triangles. Every point of
//! a base triangle is a mean of its corners, and displacement moves it by at most D: if all three corners are more than D
//! outside one side, no displaced point is inside it. Nothing is cut: a cut that depends on the triangle opens the mesh
//! (amendment of Gumhold & Huettner 1999, section 2.3, whose extended volume is one per triangle).
//!
//! | port     | format | range |
//! |----------|--------|-------|
//! | position | 3 x signed 47 | view space, [`ViewVertex`](crate::vertex_transform::ViewVertex) |
//! | outcode  | 6 bits | left, right, top, bottom, near, far |
//!
//! Conservative: the constants are rounded outwards, so culling never removes anything visible; error on the other side:
//! a triangle near a corner of the volume may stay although nothing of it is seen.
//!
//! [`verdict`] is what the block says of a base triangle: whether it is culled, has to be cut first, or goes on.
//!
//! Example: all corners 1 m left of the left side, D = 0.5 m -> culled by `Left`; D = 1.5 m -> kept.

use crate::vertex_transform::{OutOfRange, Transformed};
use serde::{Deserialize, Serialize};

/// Which side of the extended volume a base triangle is beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u8)]
pub enum Reason {
    /// Left of the viewport.
    Left = 0,
    /// Right of the viewport.
    Right = 1,
    /// Above the viewport.
    Top = 2,
    /// Below the viewport.
    Bottom = 3,
    /// Nearer than z0 with all displacement.
    Near = 4,
    /// Farther than the far plane.
    Far = 5,
}

impl Reason {
    /// All reasons, in the order of the outcode's bits.
    pub const ALL: [Reason; 6] = [Reason::Left, Reason::Right, Reason::Top, Reason::Bottom, Reason::Near, Reason::Far];
}

/// Sides of the extended volume: outside where `normal . position + reach < 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Constants {
    /// Inward normals (x, y, z), SQ1.14, unit length to 2^-14.
    pub normal: [[i32; 3]; 6],
    /// Reach in view units times 2^14, rounded up.
    pub reach: [i64; 6],
}

/// The sides that `position` is beyond, one bit each.
pub fn outcode(constants: &Constants, position: [i64; 3]) -> u8 {
    (0..6).fold(0, |code, k| {
        // 47 + 15 bits of product, of which at most two are not zero; the reach is below 2^61.
        let side: i128 = (0..3).map(|i| i128::from(constants.normal[k][i]) * i128::from(position[i])).sum();
        code | u8::from(side + i128::from(constants.reach[k]) < 0) << k
    })
}

/// The first side that all three corners are beyond.
pub fn golden(outcodes: [u8; 3]) -> Option<Reason> {
    let common = outcodes[0] & outcodes[1] & outcodes[2];
    Reason::ALL.into_iter().find(|&reason| common >> reason as u8 & 1 != 0)
}

/// What the transform tells of a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// Sides of the volume of sight that it is beyond.
    pub outcode: u8,
    /// Constant planes that it is behind.
    pub outside: u8,
    /// Why it has no projection, if it lies before all of them.
    pub failure: Option<OutOfRange>,
}

impl From<&Transformed> for Corner {
    fn from(vertex: &Transformed) -> Self {
        let failure = vertex.projected.and_then(Result::err);
        Self { outcode: vertex.outcode, outside: vertex.outside, failure }
    }
}

/// What becomes of a base triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It goes on as it is.
    Kept,
    /// It is invisible, with all its displacement.
    Culled(Reason),
    /// Constant planes cut it; nothing may be left.
    Cut,
    /// A corner has no place in the formats.
    Dropped(OutOfRange),
}

/// The verdict on a base triangle. Culling comes first, and what is cut is judged again by its pieces.
pub fn verdict(corners: [Corner; 3], culls: bool) -> Verdict {
    if culls && let Some(reason) = golden(corners.map(|corner| corner.outcode)) {
        return Verdict::Culled(reason);
    }
    if corners.iter().any(|corner| corner.outside != 0) {
        return Verdict::Cut;
    }
    corners.iter().find_map(|corner| corner.failure).map_or(Verdict::Kept, Verdict::Dropped)
}
