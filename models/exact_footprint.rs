// SPDX-License-Identifier: MIT OR Apache-2.0
//! The footprint of a vertex from the difference vertices of its sweep (Gumhold & Huettner 1999, section 3.4), in
//! differential form; an option beside the [density](crate::filter_level), and as exact as a level needs.
//!
//! ```text
//! u = (u c) / c;  a step adds D to the lanes:  du(D) = (D_u - u D_c) / c = (D_u c - (u c) D_c) / c^2
//! inside of the base triangle:  F = max over u, v of |du(D_sweep)| + |du(D_side)|
//! on an edge:                   F = max over u, v of |du(D_edge)|
//! N = |D_u c - (u c) D_c|       exact;   m 2^n   = N to 17 bits, down
//! 1 / c^2                                s 2^k   = (r / 2^15)^2 to 17 bits, down, the root too
//! |du| = N / c^2                16 fraction bits of a texel = floor(m s / 2^(2 bits + 16 + g - texel_bits - n - k))
//! ```
//!
//! No division beyond the reciprocal of c that the texel coordinates take. The numerator is exact in integers, so the two
//! sides of a wrap seam, whose u differ by a period, have one footprint but for the rounding of D and of the lanes; its
//! terms may cancel, so it is shortened behind the difference, not before. F does not change if lanes and D are all shifted.
//!
//! | value | format | range |
//! |-------|--------|-------|
//! | lanes | SQ0.31 | c >= 1 unit |
//! | D     | lanes with g more bits behind the point | whole |
//! | F     | UQ16.16 | saturates |
//!
//! Error: never above the exact value, below it by less than 2^-14 of it (8.81e-5 octaves) and 2^-16 texels a step, which are up to
//! 3.1e-5 octaves more at the first threshold: four times 17 bits are rounded down, by less than 2^-16 each (N, twice the root, the
//! square), and |du| once.
//!
//! Example: c = 1/2, u c = 64 units of 2^texel_bits texels over 2^31, D_u = 2^20 of them and D_c = 0, texel_bits = 9:
//! du = 2^20 / 2^30 512 = 1/2 texel a step, of which 0x7fff units of 2^-16 remain.

use crate::perspective_correct::Axis;
use crate::step::{MAX_COMPONENTS, Vertex};
use crate::vertex_transform::lane;

/// Bits of a mantissa: a factor without sign of a multiplier of 18 bits.
const MANTISSA: i32 = 17;

/// The leading bits of a number, and how many have gone below them, which is less than none for short ones.
fn leading(value: u128) -> (u64, i32) {
    let below = 128 - value.leading_zeros() as i32 - MANTISSA;
    let mantissa = if below > 0 { value >> below } else { value << -below };
    (mantissa as u64, below)
}

/// The footprint F, UQ16.16, saturating: `vertex` has all lanes of 32 bits, `differences` the same lanes with `guard_bits`
/// more, and `inverse` is that of the vertex's c.
pub fn golden(
    vertex: &Vertex,
    differences: &[Vertex],
    guard_bits: u32,
    axes: &[Axis; 2],
    (r, bits): (u32, u32),
) -> u32 {
    let root = u128::from(r >> 15);
    let (square, square_below) = leading(root * root);
    let c = i128::from(vertex[lane::C].max(1));
    let along = |k: usize| {
        let texel_lane = i128::from(vertex[lane::U + k]);
        let texels = |d: &Vertex| {
            // 31 + 31 + g bits each and one for the difference: 77 of the default format, 80 with g = 16.
            let cross = (i128::from(d[lane::U + k]) * c - texel_lane * i128::from(d[lane::C])).unsigned_abs();
            let (mantissa, below) = leading(cross);
            let shift = (2 * bits + 16 + guard_bits) as i32 - axes[k].texel_bits as i32 - below - square_below;
            // 34 bits. Unless it is 0, it has 33 at least: where the shift would be to the left, it saturates as it is.
            let product = mantissa * square;
            (product >> shift.clamp(0, 63)).min(u32::MAX.into()) as u32
        };
        differences.iter().map(texels).fold(0, u32::saturating_add)
    };
    along(0).max(along(1))
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
