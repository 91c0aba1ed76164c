// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reciprocal of a normalised number: a table of straight lines and one Newton step.
//!
//! ```text
//! out = 2^63 / m (1 - error)          0 <= error < 5.6e-10        m = 2^31 x, x in [1, 2);  out = 2^32 / x
//!
//! i = m[30:24]   h = m[23:13]         128 lines, 11 bits along each
//! r0 = C0[i] - (C1[i] h >> 11)        20 fraction bits, error <= 2^-16.3: C0 is half the line's sag below the curve
//! e  = (2^51 - m r0) >> 17            34 fraction bits, the error of r0, signed
//! out = r0 2^12 + (r0 e >> 22)        32 fraction bits: Newton's step r0 (2 - x r0)
//! ```
//!
//! | port | format | range |
//! |------|--------|-------|
//! | m    | UQ1.31 | `[1, 2)`: the leading bit is set, as a leading-zero count and a shift leave it |
//! | out  | UQ0.32 | `[1/2, 1)`; 1.0 is not representable and not reached: m = 1.0 gives 2^32 - 1 |
//!
//! The result never exceeds the true value and never rises with m. Source: Newton's iteration 1669 on Taylor's lines;
//! the bound is proved by the test over both ends of every line and measured in between, see `tests/arithmetic.rs`.
//!
//! Example: m = 0xC000_0000 (1.5) -> 0xAAAA_AAAA (0.66666666651) to within 2 units.

/// Lines, a power of two.
const LINES: usize = 128;

/// Start (20 fraction bits) and fall (20 fraction bits) of each line: 20 + 13 bits of table.
const TABLE: [(u32, u32); LINES] = {
    let mut table = [(0, 0); LINES];
    let mut i = 0;
    while i < LINES {
        // 2^36 / x at both ends and in the middle, floor; x = (128 + i) / 128. All below 2^37.
        let start = (1u64 << 43) / (128 + i as u64);
        let end = (1u64 << 43) / (129 + i as u64);
        let middle = (1u64 << 44) / (257 + 2 * i as u64);
        let sag = ((start + end) / 2 - middle) / 2;
        // 36 - 16 = 20 fraction bits; start - sag < 2^36 even at i = 0, so C0 fits 20 bits, and C1 <= 2^20 / 129.
        table[i] = (((start - sag + (1 << 15)) >> 16) as u32, ((start - end + (1 << 15)) >> 16) as u32);
        i += 1;
    }
    table
};

/// The reciprocal of `m`, whose leading bit must be set.
pub fn golden(m: u32) -> u32 {
    debug_assert!(m >> 31 == 1, "the reciprocal takes a normalised number, not {m:#x}");
    let (start, fall) = TABLE[(m >> 24) as usize & (LINES - 1)];
    let h = m >> 13 & 0x7ff;
    // 13 + 11 bits: no carry is lost.
    let s1_seed_uq0_20 = start - ((fall * h) >> 11);
    // m r0 < 2^32 2^20, and it differs from 2^51 by less than 2^35: 51 bits and a sign.
    let s2_error_sq0_34 = ((1i64 << 51) - i64::from(m) * i64::from(s1_seed_uq0_20)) >> 17;
    // |e| <= 2^18: 20 + 19 bits of product.
    let s3_step = (i64::from(s1_seed_uq0_20) * s2_error_sq0_34) >> 22;
    // Below the true value, which is at most 2^32, and never at it: fits 32 bits.
    ((i64::from(s1_seed_uq0_20) << 12) + s3_step) as u32
}

/// The exact reciprocal `2^63 / m`, in units of the last place of the result.
pub fn exact(m: u32) -> f64 {
    9_223_372_036_854_775_808.0 / f64::from(m)
}

/// A positive number as mantissa and bit length: `value = m 2^(bits - 32)` with bits of value below the 32 of m dropped.
///
/// The leading-zero count and barrel shifter in front of [`golden`]. `value` must be positive.
pub const fn normalise(value: i64) -> (u32, u32) {
    debug_assert!(value > 0);
    let bits = 64 - value.leading_zeros();
    // The leading bit lands on bit 31 either way, so the 32 low bits hold it all.
    (if bits <= 32 { (value as u64) << (32 - bits) } else { (value as u64) >> (bits - 32) } as u32, bits)
}
