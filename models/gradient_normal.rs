// SPDX-License-Identifier: MIT OR Apache-2.0
//! Normal of a displaced surface at a vertex, from the slopes of the patch between four texels.
//!
//! Where the base is flat, p + d n has the normal (Blinn 1978, "Simulation of wrinkled surfaces"; Gumhold & Huettner 1999, section 2.1,
//! leave it to a unit for bump mapping, which this is one of)
//!
//! ```text
//! N ~ n - d_u grad u - d_v grad v
//! d_u = k ((1 - b)(t10 - t00) + b (t11 - t01)) / 2^L      d_v = k ((1 - a)(t01 - t00) + a (t11 - t10)) / 2^L
//! ```
//!
//! with the texels, weights and level of [`mip_fetch`](crate::mip_fetch), and k, what one unit of a texel displaces. grad u and
//! grad v are tangents, texels a world unit; they come like the normal as lanes times c, which are linear on the screen, and the
//! common factor c, being positive, is gone with the length: nothing is divided.
//!
//! The lanes of the gradients have a unit of their own, the same for both: 1.0 is so many texels a world unit that the longer
//! gradient of the draw is between 1/2 and 1. `scale 2^-shift` is k times that unit, so slopes are slopes.
//!
//! | step | operation | format |
//! |------|-----------|--------|
//! | differences | 2^12 (t10 - t00) + b twist; twist = t00 - t10 - t01 + t11 | SQ16.12, exact |
//! | slope | difference scale >> (shift + L - 5) | SQ14.17, saturates |
//! | T    | 2^4 n c - (slope_u grad u c >> 13) - (slope_v grad v c >> 13) | 35 fraction bits, 51 bits and sign |
//! | N    | [`normalize`] of T | SQ1.16; (0, 0, -1.0) of zero |
//!
//! Slopes of 16384 and more saturate: a map of the largest size, 8192 texels, has none where its relief is no higher than it is
//! wide. The result points to the side of n, not to the eye, as there is no position; where the vertex is seen from outside they are
//! one.
//!
//! Error: 5.6e-5 rad, of which 3.3e-5 rad are the normalisation, 1.6e-5 the floors of both slopes, 2^-17 each, and 7e-6 those of T,
//! if n c has 16 significant bits, the gradients are no longer than n, and no slope saturates. That the lanes themselves are
//! rounded is not in it.
//!
//! Example: four equal texels: N is n. t = 0, 1, 0, 1, k of one texel a unit, grad u = (1, 0, 0), n = (0, 0, -1): slope 1,
//! N = (-1, 0, -1) / sqrt(2).

use crate::mip_fetch::WEIGHT_BITS;
use crate::rsqrt::normalize;
use serde::{Deserialize, Serialize};

/// Fraction bits of a slope.
const SLOPE_BITS: u32 = 17;

/// Per-draw constants: `scale 2^-shift` is the displacement of one unit of a texel, times the unit of the gradients.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Constants {
    /// Mantissa, 17 bits with the leading one set, and a sign; 0 for a draw without displacement.
    pub scale: i32,
    /// Exponent, `16..=48`.
    pub shift: u32,
}

impl Constants {
    /// The constants nearest to a displacement of `steepness`, off by 2^-17 of it; what is less than 2^-32 has fewer bits.
    /// `None` from 2 on: every slope would be vertical.
    pub fn new(steepness: f64) -> Option<Self> {
        if steepness.is_nan() || steepness.abs() >= 2.0 - 1e-5 {
            return None;
        }
        let exponent = steepness.abs().max(f64::MIN_POSITIVE).log2().floor();
        let shift = (16.0 - exponent).min(48.0) as i32;
        let scale = (steepness * f64::from(shift).exp2()).round() as i32;
        // Rounding may reach the next power of two.
        let (scale, shift) = if scale.abs() == 1 << 17 { (scale / 2, shift - 1) } else { (scale, shift) };
        Some(Self { scale, shift: shift as u32 })
    }

    /// What they stand for.
    pub fn steepness(&self) -> f64 {
        f64::from(self.scale) * (-f64::from(self.shift)).exp2()
    }
}

/// What a beat holds but the constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    /// The four texels t00, t10, t01, t11.
    pub texels: [u16; 4],
    /// The weights a and b of the second column and row, UQ0.12.
    pub weights: [u32; 2],
    /// Level of the texels, `0..=15`.
    pub level: u32,
    /// n c, SQ0.31.
    pub normal: [i64; 3],
    /// grad u c and grad v c, SQ0.31.
    pub gradients: [[i64; 3]; 2],
}

/// The differences along u and v over a texel of the level, SQ16.12.
pub fn differences(texels: [u16; 4], weights: [u32; 2]) -> [i64; 2] {
    let [t00, t10, t01, t11] = texels.map(i64::from);
    // 17 bits and sign.
    let twist = t00 - t10 - t01 + t11;
    // Between the two differences, so 28 bits and sign as they are.
    [
        ((t10 - t00) << WEIGHT_BITS) + i64::from(weights[1]) * twist,
        ((t01 - t00) << WEIGHT_BITS) + i64::from(weights[0]) * twist,
    ]
}

/// The unit normal.
pub fn golden(constants: &Constants, patch: &Patch) -> [i32; 3] {
    let slopes_sq14_17 = differences(patch.texels, patch.weights).map(|difference| {
        // 28 + 17 bits of product and sign, of which at least 11 go: 35 bits.
        let slope =
            (difference * i64::from(constants.scale)) >> (constants.shift + patch.level + WEIGHT_BITS - SLOPE_BITS);
        slope.clamp(-(1 << 31), (1 << 31) - 1)
    });
    let tilted = [0, 1, 2].map(|k| {
        // 31 + 31 bits and sign; two halves of 50 bits.
        let along = [0, 1].map(|axis| (slopes_sq14_17[axis] * patch.gradients[axis][k]) >> (SLOPE_BITS - 4));
        (patch.normal[k] << 4) - (along[0] + along[1])
    });
    let unit = normalize(tilted);
    if unit == [0; 3] { [0, 0, -1 << 16] } else { unit }
}

/// The exact normal; `None` if it has no direction.
pub fn exact(constants: &Constants, patch: &Patch) -> Option<[f64; 3]> {
    let [t00, t10, t01, t11] = patch.texels.map(f64::from);
    let [a, b] = patch.weights.map(|weight| f64::from(weight) / 4096.0);
    let k = constants.steepness() * (-f64::from(patch.level)).exp2();
    let slope_u = k * ((1.0 - b) * (t10 - t00) + b * (t11 - t01));
    let slope_v = k * ((1.0 - a) * (t01 - t00) + a * (t11 - t10));
    let vector = |lanes: [i64; 3]| glam::DVec3::from_array(lanes.map(|lane| lane as f64));
    let [u, v] = patch.gradients.map(vector);
    (vector(patch.normal) - slope_u * u - slope_v * v).try_normalize().map(|n| n.to_array())
}
