// SPDX-License-Identifier: MIT OR Apache-2.0
//! The footprint of a vertex from the difference vertices of its sweep (Gumhold & Huettner 1999, section 3.4), in
//! differential form; golden only, the hardware takes the [density](crate::filter_level).
//!
//! ```text
//! u = (u c) / c;  a step adds D to the lanes:  du(D) = (D_u - u D_c) / c = (D_u c - (u c) D_c) / c^2
//! inside of the base triangle:  F = max over u, v of |du(D_sweep)| + |du(D_side)|
//! on an edge:                   F = max over u, v of |du(D_edge)|
//! A = |D_u c - (u c) D_c| / c   16 fraction bits of the lane   = floor(|..| r / 2^(bits + 15 + g))
//! |du| = A / c                  16 fraction bits of a texel    = floor(A r / 2^(bits + 31 - texel_bits))
//! ```
//!
//! No division beyond the reciprocal of c that the texel coordinates take. The numerator is exact in integers, so the two
//! sides of a wrap seam, whose u differ by a period, have one footprint but for the rounding of D and of the lanes.
//!
//! | value | format | range |
//! |-------|--------|-------|
//! | lanes | SQ0.31 | c >= 1 unit |
//! | D     | lanes with g more bits behind the point | whole |
//! | F     | UQ16.16 | saturates |
//!
//! Example: c = 1/2, u c = 64 units of 2^texel_bits texels over 2^31, D_u = 2^20 of them and D_c = 0, texel_bits = 9:
//! du = 2^20 / 2^30 512 = 1/2 texel a step.

use crate::perspective_correct::Axis;
use crate::step::{MAX_COMPONENTS, Vertex};
use crate::vertex_transform::lane;

/// The footprint F, UQ16.16, saturating: `vertex` has all lanes of 32 bits, `differences` the same lanes with `guard_bits`
/// more, and `inverse` is that of the vertex's c.
pub fn golden(
    vertex: &Vertex,
    differences: &[Vertex],
    guard_bits: u32,
    axes: &[Axis; 2],
    (r, bits): (u32, u32),
) -> u32 {
    let r = u128::from(r);
    let c = i128::from(vertex[lane::C].max(1));
    let along = |k: usize| {
        let texel_lane = i128::from(vertex[lane::U + k]);
        let texels = |d: &Vertex| {
            // 33 + g + 31 bits and one for the difference: 78 of the default format, and 110 with the reciprocal.
            let s1_cross = (i128::from(d[lane::U + k]) * c - texel_lane * i128::from(d[lane::C])).unsigned_abs();
            let s2_over_c = ((s1_cross * r) >> (bits + 15 + guard_bits)).min(1 << 64);
            // 65 + 32 bits.
            (s2_over_c * r) >> (bits + 31 - axes[k].texel_bits)
        };
        differences.iter().map(texels).sum::<u128>()
    };
    along(0).max(along(1)).min(u32::MAX.into()) as u32
}

/// The exact footprint in texels, unlimited, of lanes and differences in units of the last place of the lanes.
pub fn exact(vertex: &[f64; MAX_COMPONENTS], differences: &[[f64; MAX_COMPONENTS]], axes: &[Axis; 2]) -> f64 {
    let c = vertex[lane::C];
    let along = |k: usize| {
        let unit = f64::from(1u32 << axes[k].texel_bits);
        let texels =
            |d: &[f64; MAX_COMPONENTS]| (d[lane::U + k] - vertex[lane::U + k] / c * d[lane::C]).abs() / c * unit;
        differences.iter().map(texels).sum::<f64>()
    };
    along(0).max(along(1))
}
