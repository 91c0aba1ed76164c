// SPDX-License-Identifier: MIT OR Apache-2.0
//! The mean of a rectangle from its sum and its area.
//!
//! `mean = floor(256 sum / area + 1/2)`: UQ16.8, round half up
//!
//! Example: sum 10 of 4 texels: 2.5 = 0x280. Error: 1/2 unit. No texel, or a sum that no `area` texels of 16 bits have:
//! an error; the mean is 0, or the largest UQ16.8.

use crate::fixed::divide_round_half_up;

/// Largest UQ16.8.
pub const MOST: u32 = (1 << 24) - 1;

/// The mean, and whether it is an error.
pub fn golden(sum: u64, area: u64) -> (u32, bool) {
    if area == 0 {
        return (0, true);
    }
    let mean = divide_round_half_up(256 * i128::from(sum), i128::from(area));
    match u32::try_from(mean) {
        Ok(mean) if mean <= MOST => (mean, false),
        _ => (MOST, true),
    }
}
