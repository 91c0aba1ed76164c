// SPDX-License-Identifier: MIT OR Apache-2.0
//! Filter level of a vertex from the density of texels there: the footprint of its voxel on the map.
//!
//! ```text
//! F = rho z s cell                      texels a grid step; rho texels a world unit, voxels are cubes of size z s cell
//! A = rho = (rho c) / c                 16 fraction bits      = floor(rc r / 2^(bits + 5))
//! B = rho / c = A / c                   16 fraction bits      = floor(A r / 2^bits)
//! F = B S                               16 fraction bits,     S = z0 s cell as 24-bit mantissa and exponent
//! k = number of thresholds sqrt(2) 2^i, i = 0, 1, .., that are <= F;   level = max(0, k - 1), at most the last
//! ```
//!
//! A level's node already covers two texels of the level below, hence k - 1. There is no logarithm: the bit length of F
//! and one comparison of its mantissa with sqrt(2) give k.
//!
//! | port | format | range |
//! |------|--------|-------|
//! | rc, c | SQ0.31 | lanes; rho in 1024 density units |
//! | F    | UQ16.16 | saturates |
//! | level | unsigned | `0..levels` |
//!
//! Gumhold & Huettner 1999, section 3.4, take half a difference vertex for the footprint. A corner lies on several edges
//! with different ones, so its level, and with it its height, would depend on the triangle, and the mesh opens; the
//! density is vertex data ([`exact_footprint`](crate::exact_footprint) is the other, [`rules`](crate::rules) compares). Error of F:
//! 2^-16 (1/A + 1/B + 1/F) relative, and 3 units of the lane over c.
//!
//! Example: rho = 200 texels a unit, z s cell = 0.01 units: F = 2.0, k = 1, level 0. At 3.0: k = 2, level 1.

use serde::{Deserialize, Serialize};

/// ceil(sqrt(2) 2^23): exact for every footprint of up to 24 bits. The floor, 0xb504f3, takes F = 0xb504f3 for larger than
/// its threshold.
const ROOT_OF_TWO: u32 = 0xb5_04f4;

/// Per-draw constants of the level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Constants {
    /// z0 s cell in density units, `scale 2^-shift`: 24 bits with the leading one set, or 0 for a draw at level 0.
    pub scale: u32,
    /// Exponent of `scale`, `0..=63`.
    pub shift: u32,
    /// Levels of the map, at least 1.
    pub levels: u32,
}

/// The footprint F, UQ16.16, saturating.
pub fn footprint(constants: &Constants, lane: i64, inverse: (u32, u32)) -> u32 {
    let (r, bits) = inverse;
    let r = u64::from(r);
    // 31 + 32 bits; at most 1024 units with 16 fraction bits if lane <= c: 26 bits.
    let s1_density = (lane.max(0) as u64 * r) >> (bits + 5);
    // 26 + 32 bits; saturated so that the next product has 48 + 24.
    let s2_over_c = ((u128::from(s1_density) * u128::from(r)) >> bits).min((1 << 48) - 1);
    // Saturates at the largest footprint, which every map's last level covers.
    ((s2_over_c * u128::from(constants.scale)) >> constants.shift).min(u32::MAX.into()) as u32
}

/// Number of thresholds `sqrt(2) 2^i` not above the footprint.
pub const fn thresholds(footprint: u32) -> u32 {
    if footprint < 1 << 16 {
        return 0;
    }
    let bits = 32 - footprint.leading_zeros();
    // 24 leading bits: bits below the mantissa go.
    let mantissa = if bits > 24 { footprint >> (bits - 24) } else { footprint << (24 - bits) };
    bits - 17 + (mantissa >= ROOT_OF_TWO) as u32
}

/// The level of a footprint on a map of so many levels, at least 1.
pub fn level(footprint: u32, levels: u32) -> u32 {
    // thresholds <= 16.
    thresholds(footprint).saturating_sub(1).min(levels - 1)
}

/// The filter level.
pub fn golden(constants: &Constants, lane: i64, inverse: (u32, u32)) -> u32 {
    level(footprint(constants, lane, inverse), constants.levels)
}

/// The exact footprint in texels, unlimited, of lanes in units of the last place; `c` is above 0.
pub fn exact(constants: &Constants, lane: f64, c: f64) -> f64 {
    let density = lane.max(0.0) / c * 1024.0;
    let nearness = c / 2_147_483_648.0;
    density / nearness * f64::from(constants.scale) * (-f64::from(constants.shift)).exp2()
}
