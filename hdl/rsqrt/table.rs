// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lines of the reciprocal root: where each begins and how far it falls.
//!
//! | port  | format     | meaning |
//! | index | unsigned 7 | x from 1 + i / 64 on for i < 64, and from 2 + (i - 64) / 32 on above |
//! | start | UQ0.18     | half of the line's sag below 1 / sqrt(x) at its beginning |
//! | slope | UQ0.18     | below 2^11 units |

use crate::pipeline::LineTable;

/// Table of lines.
pub type RootTable = LineTable<7, 18, 11>;

/// Where line `index` begins and what it falls by, 18 fraction bits, from 36 fraction bits of 1 / sqrt(x).
fn line(index: u64) -> (u64, u64) {
    let (octave, place) = (index / 64, u128::from(64 + index % 64));
    // x = halves 2^octave / 128: 2^36 / sqrt(x) = sqrt(2^79 / (halves 2^octave)).
    let at = |halves: u128| (((1u128 << 79) >> octave) / halves).isqrt() as u64;
    let (start, middle, end) = (at(2 * place), at(2 * place + 1), at(2 * place + 2));
    let sag = u64::midpoint(start, end) - middle;
    let round = |value: u64| (value + (1 << 17)) >> 18;
    // Even where it begins at 1.0, half the sag takes a start below 2^18 after rounding.
    (round(start - sag / 2), round(start - end))
}

impl Default for RootTable {
    fn default() -> Self {
        Self::new("relief_root", line)
    }
}
