// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lines of logarithm and power of two, from series of integers with 60 fraction bits.
//!
//! | table | index | start | slope |
//! | [`LogTable`] | x from 1 + i / 64 on | log2(x), UQ0.24 | its rise, below 2^19 units |
//! | [`ExpTable`] | f from i / 64 on     | 2^-f, UQ1.24    | its fall, below 2^18 units |
//!
//! Chords: a line ends where the next one begins.

use crate::pipeline::LineTable;

/// Lines of the logarithm.
pub type LogTable = LineTable<6, 24, 19>;
/// Lines of the power of two.
pub type ExpTable = LineTable<6, 25, 18>;

const ONE: u128 = 1 << 60;

/// The inverse hyperbolic tangent of n / d <= 1/3: the sum of (n / d)^k / k over odd k.
fn artanh(n: u128, d: u128) -> u128 {
    let (mut power, mut sum) = (n * ONE / d, 0);
    for k in (1..).step_by(2).take_while(|k| *k < 64) {
        sum += power / k;
        power = power * (n * n) / (d * d);
    }
    sum
}

/// log2(1 + i / 64), of 24 fraction bits: ln(x) = 2 artanh((x - 1) / (x + 1)).
fn logarithm(i: u64) -> u64 {
    let units = (artanh(i.into(), 128 + u128::from(i)) << 25) / artanh(1, 3);
    units.div_ceil(2) as u64
}

/// 2^-(i / 64), of 24 fraction bits: the series of the exponential function at -i ln(2) / 64.
fn power(i: u64) -> u64 {
    let x = artanh(1, 3) * u128::from(i) / 32;
    let (mut term, mut sum) = (ONE, [0, 0]);
    for k in 0..24 {
        sum[k % 2] += term;
        term = term * x / (ONE * (k as u128 + 1));
    }
    ((sum[0] - sum[1] + (1 << 35)) >> 36) as u64
}

impl Default for LogTable {
    fn default() -> Self {
        Self::new("relief_logarithm", |i| (logarithm(i), logarithm(i + 1) - logarithm(i)))
    }
}

impl Default for ExpTable {
    fn default() -> Self {
        Self::new("relief_exponential", |i| (power(i), power(i) - power(i + 1)))
    }
}
