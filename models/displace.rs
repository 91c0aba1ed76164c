// SPDX-License-Identifier: MIT OR Apache-2.0
//! Displaces a vertex along its normal, in projective form.
//!
//! With delta = d/z, the displacement in units of the vertex's distance, p + d n has (Gumhold & Huettner 1999, section 2.2,
//! without its division to the world and back):
//!
//! ```text
//! den = 1 + delta nz        X' = (X + f delta nx) / den        Y' = (Y + f delta ny) / den        c' = c / den
//! ```
//!
//! | step | operation | format |
//! |------|-----------|--------|
//! | d    | minimum + (q range >> 16)               | SQ1.30 of 2^exponent z0 |
//! | dl   | d c >> (33 - exponent)                  | SQ15.28, saturates |
//! | n    | [`normalize`] of lanes nx c .. nz c     | SQ1.16 |
//! | den  | 2^28 + (dl nz >> 16)                    | SQ16.28; at most 2^-8: invalid |
//! | rd   | reciprocal of den normalised            | UQ0.32 |
//! | xs   | 4 X + ((dl nx >> 16) f >> 24)           | 20 fraction bits, pixels |
//! | X'   | floor(xs rd / 2^(bd + 15) + 1/2)        | SQ13.8, pixels from the viewport's centre |
//! | c'   | c rd >> (bd + 3)                        | UQ0.31, in a signed lane of 32 bits |
//!
//! The output vertex, which the strip unit carries: lanes 0 and 1 are X' and Y', lane 2 is c', lane 3 holds the
//! [`flag`]s, lane 4 the height q (UQ16.8) for tinting; the others are 0. A vertex with a flag has no position (lanes 0
//! to 2 are 0), and the triangles that use it are dropped, not clipped. Narrower strip units carry the same bits packed
//! ([`displaced::pack`]).
//!
//! The result is a function of vertex data, height and per-draw constants, never of the triangle: that keeps the mesh
//! closed. Error against f64: 0.016 pixels at 640 x 480 (`tests/displacement.rs`; rounding to 1/256 pixel is 0.002).
//!
//! Example: height of no displacement: den = 1.0, X' = X rounded to 1/256 pixel, c' at most 2 units below c.

use crate::reciprocal;
use crate::rsqrt::normalize;
use crate::step::{MAX_COMPONENTS, Vertex};
use crate::vertex_transform::lane;
use serde::{Deserialize, Serialize};

/// Flags of lane 3 of a displaced vertex.
pub mod flag {
    /// den <= 2^-8: the vertex lies behind the eye, or all but.
    pub const INVALID: i64 = 1;
    /// c' of 1.0 or more: nearer than z0.
    pub const NEAR: i64 = 2;
    /// |X'| or |Y'| of 8192 pixels or more.
    pub const RANGE: i64 = 4;
}

/// Lanes of a displaced vertex.
pub mod displaced {
    /// X', SQ13.8.
    pub const X: usize = 0;
    /// Y', SQ13.8.
    pub const Y: usize = 1;
    /// c', UQ0.31.
    pub const C: usize = 2;
    /// Flags; 0 for a vertex that can be drawn.
    pub const FLAGS: usize = 3;
    /// Height q, UQ16.8.
    pub const HEIGHT: usize = 4;

    use crate::fixed::wrap;
    use crate::step::{MAX_COMPONENTS, Vertex};

    /// Bits of the five lanes.
    const WIDTHS: [u32; 5] = [22, 22, 31, 3, 24];
    /// Bits of them all: what a strip unit has to carry.
    pub const BITS: u32 = 102;

    /// A displaced vertex in a strip unit of so many components of so many bits each: as it is where each lane fits a
    /// component, otherwise one lane's bits behind the other's, from the lowest of component 0 on. `components * bits` is
    /// at least [`BITS`].
    pub fn pack(vertex: &Vertex, components: usize, bits: u32) -> Vertex {
        if bits >= 32 && components >= WIDTHS.len() {
            return *vertex;
        }
        let (mut all, mut at) = (0u128, 0);
        for (lane, width) in vertex.iter().zip(WIDTHS) {
            all |= ((*lane as u128) & ((1 << width) - 1)) << at;
            at += width;
        }
        let mut out = [0; MAX_COMPONENTS];
        for (k, component) in out.iter_mut().enumerate().take(components) {
            // Beyond the last bit there are zeros.
            let word = all.checked_shr(k as u32 * bits).unwrap_or(0);
            *component = wrap(word as i64, bits);
        }
        out
    }

    /// The displaced vertex that [`pack`] has made this of.
    pub fn unpack(packed: &Vertex, components: usize, bits: u32) -> Vertex {
        if bits >= 32 && components >= WIDTHS.len() {
            return *packed;
        }
        let mut all = 0u128;
        for (k, component) in packed.iter().enumerate().take(components) {
            let word = (*component as u128) & ((1 << bits) - 1);
            all |= word.checked_shl(k as u32 * bits).unwrap_or(0);
        }
        let mut out = [0; MAX_COMPONENTS];
        for (k, width) in WIDTHS.into_iter().enumerate() {
            let word = (all & ((1 << width) - 1)) as i64;
            // X' and Y' are signed.
            out[k] = if k < 2 { wrap(word, width) } else { word };
            all >>= width;
        }
        out
    }

    #[cfg(test)]
    mod tests {
        use super::*;
        use proptest::prelude::*;

        proptest! {
            #[test]
            fn displaced_vertices_come_back(
                x in -1i64 << 21..1 << 21, y in -1i64 << 21..1 << 21, c in 0i64..1 << 31, flags in 0i64..8, q in 0i64..1 << 24,
                components in 1usize..=16, bits in 1u32..=40,
            ) {
                prop_assume!(components as u32 * bits >= BITS);
                let mut vertex = [0; MAX_COMPONENTS];
                vertex[..5].copy_from_slice(&[x, y, c, flags, q]);
                let packed = pack(&vertex, components, bits);
                prop_assert!(packed.iter().all(|lane| wrap(*lane, bits.max(32)) == *lane));
                prop_assert!(bits >= 32 || packed.iter().all(|lane| wrap(*lane, bits) == *lane));
                prop_assert!(packed[components..].iter().all(|lane| *lane == 0));
                prop_assert_eq!(unpack(&packed, components, bits), vertex);
            }
        }
    }
}

/// Per-draw constants of the displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Constants {
    /// Displacement for height 0, in units of 2^(exponent - 30) z0; magnitude at most 2^30.
    pub minimum: i64,
    /// Displacement of the full range of heights over 65535, times 2^8, in the same units; magnitude at most 2^24.
    pub range: i64,
    /// ceil(log2(largest |displacement| / z0)), `-30..=15`.
    pub exponent: i32,
    /// Focal length in pixels, UQ16.16.
    pub focal: u32,
}

/// Displaces `vertex` (lanes X, Y, c, n c) by height `q`, UQ16.8.
pub fn golden(constants: &Constants, vertex: &Vertex, q: u32) -> Vertex {
    let mut out: Vertex = [0; MAX_COMPONENTS];
    // At most 65535.0: 24 bits.
    let q = i64::from(q.min(65535 << 8));
    out[displaced::HEIGHT] = q;
    // 24 + 25 bits and sign.
    let s1_displacement = constants.minimum + ((q * constants.range) >> 16);
    let c = vertex[lane::C].max(1);
    // 33 + 31 bits and sign; 33 - exponent is 18..=63.
    let s2_delta = (i128::from(s1_displacement) * i128::from(c)) >> (33 - constants.exponent);
    let s2_delta_sq15_28 = s2_delta.clamp(-(1 << 43), (1 << 43) - 1) as i64;
    let n = normalize([0, 1, 2].map(|k| vertex[lane::NORMAL + k])).map(i64::from);
    // 44 + 17 bits and sign.
    let s3_along_sq16_28 = n.map(|n| (s2_delta_sq15_28 * n) >> 16);
    let s4_den = (1 << 28) + s3_along_sq16_28[2];
    if s4_den <= 1 << 20 {
        out[displaced::FLAGS] = flag::INVALID;
        return out;
    }
    // den < 2^45.
    let (s5_mantissa, bits) = reciprocal::normalise(s4_den);
    let s6_inverse = i128::from(reciprocal::golden(s5_mantissa));
    let project = |x: i64, along: i64| {
        // 45 + 32 bits of product; the sum has 34 or 53 bits.
        let s5_moved = i128::from(x << 2) + ((i128::from(along) * i128::from(constants.focal)) >> 24);
        // 54 + 32 bits of product.
        (s5_moved * s6_inverse + (1 << (bits + 14))) >> (bits + 15)
    };
    let [x, y] = [project(vertex[lane::X], s3_along_sq16_28[0]), project(vertex[lane::Y], s3_along_sq16_28[1])];
    // 31 + 32 bits of product.
    let s7_c = (i128::from(c) * s6_inverse) >> (bits + 3);
    let fits = |x: i128| (-(1 << 21)..1 << 21).contains(&x);
    match () {
        () if s7_c >= 1 << 31 => out[displaced::FLAGS] = flag::NEAR,
        () if !fits(x) || !fits(y) => out[displaced::FLAGS] = flag::RANGE,
        // Within 22 and 31 bits; c' = 0 is a vertex too far for the format, and counts as farthest.
        () => out[..3].copy_from_slice(&[x as i64, y as i64, (s7_c as i64).max(1)]),
    }
    out
}

/// Exact position of the displaced vertex with the given lanes, in units of their last place, for a height `q` of 0 to 65535:
/// X', Y' in pixels and c', or `None` behind the eye.
pub fn exact(constants: &Constants, lanes: &[f64; MAX_COMPONENTS], q: f64) -> Option<[f64; 3]> {
    let unit = f64::from(constants.exponent - 30).exp2();
    let d = (constants.minimum as f64 + q * constants.range as f64 / 256.0) * unit;
    let [x, y, c] = [0, 1, 2].map(|k| lanes[k]);
    let (x, y, c) = (x / 262_144.0, y / 262_144.0, c / 2_147_483_648.0);
    let n = [0, 1, 2].map(|k| lanes[lane::NORMAL + k]);
    let length = n.iter().map(|n| n * n).sum::<f64>().sqrt();
    let n = n.map(|n| if length > 0.0 { n / length } else { 0.0 });
    let (delta, focal) = (d * c, f64::from(constants.focal) / 65536.0);
    let den = 1.0 + delta * n[2];
    (den > 0.0).then(|| [(x + focal * delta * n[0]) / den, (y + focal * delta * n[1]) / den, c / den])
}
