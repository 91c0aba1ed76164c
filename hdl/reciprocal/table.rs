// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lines of the reciprocal: where each begins and how far it falls.
//!
//! | port  | format     | meaning |
//! | index | unsigned 7 | the line of x in [1 + index / 128, 1 + (index + 1) / 128) |
//! | start | UQ0.20     | half of the line's sag below 1 / x at its beginning |
//! | slope | UQ0.20     | below 2^13 units |

use crate::pipeline::LineTable;

/// Table of lines.
pub type ReciprocalTable = LineTable<7, 20, 13>;

/// Where line `index` begins and what it falls by, 20 fraction bits, from 36 fraction bits of 1 / x.
fn line(index: u64) -> (u64, u64) {
    let reciprocal = |x: u64, scale: u32| (1u64 << (43 + scale)) / x;
    let (start, end) = (reciprocal(128 + index, 0), reciprocal(129 + index, 0));
    let middle = reciprocal(2 * (128 + index) + 1, 1);
    let sag = u64::midpoint(start, end) - middle;
    let round = |value: u64| (value + (1 << 15)) >> 16;
    // Even where it begins at 1.0, half the sag takes a start below 2^20 after rounding.
    (round(start - sag / 2), round(start - end))
}

impl Default for ReciprocalTable {
    fn default() -> Self {
        Self::new("relief_reciprocal", line)
    }
}
