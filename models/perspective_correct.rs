// SPDX-License-Identifier: MIT OR Apache-2.0
//! Texel coordinates of a vertex: the division by c, and the snap that closes seams.
//!
//! ```text
//! u = (u c) / c = floor(uc r / 2^(bits + 15 - texel_bits) + 1/2)      r = reciprocal of c normalised, bits = length of c
//! repeat: u >= period - 2^-6 : u -= period (twice at most)            then |u| <= 2^-6 : u = 0
//! clamp:  |u| <= 2^-6 : u = 0;   u >= size - 1 - 2^-6 : u = size - 1
//! ```
//!
//! | port | format | range |
//! |------|--------|-------|
//! | uc, c | SQ0.31 | lanes of the [vertex transform](crate::vertex_transform); c >= 1 unit |
//! | u    | UQ13.16 | texels of level 0: `[0, period)` on a repeating axis, `[0, size - 1]` on a clamped one |
//!
//! **The snap.** The two sides of a wrap seam carry u = 0 and u = period for the same vertices. u = 0 stays exactly 0
//! through the remesher, but the other side comes out as period +- error: another texel, another height, and an open
//! edge. The same holds for the pole row `v = size - 1`. Error of u before the snap, in texels:
//!
//! ```text
//! |du| <= 1/2^17 + 2^texel_bits (1.5 2^-31 (z/z0) + 6e-10)
//! ```
//!
//! half a unit each from the corner's rounding, from the remesher's output of uc, and from that of c. The snap of 2^-6
//! texel absorbs it while `2^texel_bits z/z0 <= 2^24.2`: z = 20,000 z0 on maps of up to 1,024 texels; the host says when a
//! draw goes beyond (`Draw::seams_are_exact`).
//!
//! Example: texel_bits = 9, uc = 0x3FFF_FFFF, c = 0x4000_0000: u = 512 - 2^-21 -> 512.0 -> 0 on a period of 512.

use crate::reciprocal;
use serde::{Deserialize, Serialize};

/// Half-width of the snap, 2^-6 texel in 16 fraction bits.
pub const SNAP: i64 = 1 << 10;

/// One axis of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Axis {
    /// Texels, `1..=8192`; the period of a repeating axis.
    pub size: u32,
    /// The axis repeats.
    pub repeat: bool,
    /// The lane counts in units of `2^texel_bits` texels, `1..=15`.
    pub texel_bits: u32,
}

/// The reciprocal of lane `c` with the bit length of `c`: `1 / (c 2^-31) = r 2^-bits`.
///
/// A lane below 1 cannot leave the transform; here it counts as 1, so that nothing is undefined.
pub fn inverse(c: i64) -> (u32, u32) {
    let (mantissa, bits) = reciprocal::normalise(c.max(1));
    (reciprocal::golden(mantissa), bits)
}

/// The quotient before the snap, texels with 16 fraction bits.
pub fn divide(lane: i64, inverse: (u32, u32), texel_bits: u32) -> i64 {
    let (r, bits) = inverse;
    // Rounding in the remesher may leave -1 for 0.
    let lane = lane.max(0) as u64;
    // 31 + 32 bits of product and the half below 2^45: 64 bits unsigned hold it. The quotient is below 2^14 texels if
    // lane <= c, and below 2^48 in any case.
    let shift = bits + 15 - texel_bits;
    ((lane * u64::from(r) + (1 << (shift - 1))) >> shift) as i64
}

/// The texel coordinate of one axis.
pub fn golden(lane: i64, inverse: (u32, u32), axis: &Axis) -> u32 {
    snap(divide(lane, inverse, axis.texel_bits), axis)
}

/// The snap, the period, and the clamp.
pub fn snap(texel: i64, axis: &Axis) -> u32 {
    let size = i64::from(axis.size) << 16;
    let mut u = texel;
    if axis.repeat {
        // uv below 2 reaches u below 2 periods, whose upper end snaps to a third one.
        for _ in 0..2 {
            if u >= size - SNAP {
                u -= size;
            }
        }
        // At most 2 periods come in, so this clamp only guards against lanes that no draw makes.
        u = u.min(size - SNAP - 1);
    } else {
        let last = size - (1 << 16);
        if u >= last - SNAP {
            u = last;
        }
    }
    // -SNAP <= u < 2^13 texels: 29 bits.
    if u <= SNAP { 0 } else { u as u32 }
}

/// The exact quotient in texels, without snap.
pub fn exact(lane: i64, c: i64, axis: &Axis) -> f64 {
    lane as f64 / c as f64 * f64::from(1 << axis.texel_bits)
}
