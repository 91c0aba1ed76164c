// SPDX-License-Identifier: MIT OR Apache-2.0
//! Logarithm and power of numbers up to one, by two tables of 64 lines.
//!
//! ```text
//! power(x, n) = 2^-(n (-log2 x))            log2(2^e (1 + m)) = e + T[m],  2^-f = E[f],  T and E piecewise linear
//! ```
//!
//! | port | format | range |
//! |------|--------|-------|
//! | x    | UQ1.16 | `[0, 1]`; 0 gives 0 |
//! | n    | UQ8.0  | `1..=255` |
//! | out  | UQ1.16 | `[0, 1]`, 1.0 is representable |
//!
//! Error at most 0.0007 for n up to 128 (`tests/arithmetic.rs`). The tables are made of integers only: the logarithm bit by
//! bit by squaring (Briggs 1624), the powers of two by roots of roots.
//!
//! Example: x = 0.5 (0x8000), n = 4 -> 0.0625 (0x1000).

use crate::rsqrt::root;

/// `log2(1 + i/64)` in 24 fraction bits, rounded; from 0 to 1 exactly, so that the logarithm has no step at powers of two.
pub(crate) const LOG2: [u32; 65] = {
    let mut table = [0; 65];
    let mut i = 0;
    while i < 64 {
        // UQ2.62; each squaring yields a bit of the logarithm, and 26 of them cost 26 of the 62 fraction bits.
        let mut x = (64 + i as u128) << 56;
        let mut bits = 0u32;
        let mut k = 0;
        while k < 26 {
            x = (x * x) >> 62;
            bits <<= 1;
            if x >> 63 != 0 {
                x >>= 1;
                bits |= 1;
            }
            k += 1;
        }
        table[i] = (bits + 2) >> 2;
        i += 1;
    }
    table[64] = 1 << 24;
    table
};

/// `2^-(i/64)` in 24 fraction bits, rounded.
const EXP2: [u32; 65] = {
    // 2^-(1/64) in 60 fraction bits: six roots of one half.
    let mut step = 1u128 << 59;
    let mut k = 0;
    while k < 6 {
        step = root(step << 60);
        k += 1;
    }
    let mut table = [0; 65];
    let mut value = 1u128 << 60;
    let mut i = 0;
    while i < 65 {
        table[i] = ((value + (1 << 35)) >> 36) as u32;
        value = (value * step) >> 60;
        i += 1;
    }
    table
};

/// `log2(m / 2^31)` of a normalised mantissa (leading bit 31 set), UQ1.24: chords, so at most 4.4e-5 below the logarithm.
///
/// Continuous and monotone over the whole of `[1, 2)`, and 1.0 is not reached.
pub fn log2_mantissa(m: u32) -> u32 {
    debug_assert!(m >> 31 == 1);
    let at = (m >> 25) as usize & 63;
    // 25 bits along a line whose rise is below 2^19: 44 bits of product, and the sum stays below 2^24.
    let along = u64::from(m & 0x1ff_ffff);
    LOG2[at] + ((u64::from(LOG2[at + 1] - LOG2[at]) * along) >> 25) as u32
}

/// `x^n` for `x` in UQ1.16, at most 1.0, and `n` in `1..=255`.
pub fn golden(x: u32, n: u32) -> u32 {
    debug_assert!(x <= 1 << 16 && (1..=255).contains(&n));
    if x == 0 {
        return 0;
    }
    let bits = 32 - x.leading_zeros();
    // -log2 x = 17 - bits - log2(mantissa), in UQ5.24; at least 0 because x <= 1.
    let s1_logarithm = ((17 - bits) << 24) - log2_mantissa(x << (32 - bits));
    // 29 + 8 bits.
    let s2_exponent = u64::from(s1_logarithm) * u64::from(n);
    let (whole, fraction) = (s2_exponent >> 24, s2_exponent & 0xff_ffff);
    if whole > 17 {
        return 0;
    }
    let (at, along) = ((fraction >> 18) as usize, fraction & 0x3_ffff);
    // 25 bits less a fall below 2^19.
    let s3_value_uq1_24 = u64::from(EXP2[at]) - ((u64::from(EXP2[at] - EXP2[at + 1]) * along) >> 18);
    // 8 + whole fraction bits go, round half up; at most 2^16.
    let shift = 8 + whole;
    ((s3_value_uq1_24 + (1 << (shift - 1))) >> shift) as u32
}

/// The exact power, in units of the last place of the result.
pub fn exact(x: u32, n: u32) -> f64 {
    (f64::from(x) / 65536.0).powi(n as i32) * 65536.0
}
