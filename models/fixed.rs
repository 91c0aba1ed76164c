// SPDX-License-Identifier: MIT OR Apache-2.0
//! Two's complement arithmetic at a width chosen at run time, and the rounding modes, each written once.

/// Reduces `value` to `bits` bits of two's complement, sign-extended back to 64 bits. `1 <= bits <= 64`.
#[inline(always)]
pub const fn wrap(value: i64, bits: u32) -> i64 {
    let shift = 64 - bits;
    (value << shift) >> shift
}

/// `floor(numerator / denominator + 1/2)` for `denominator > 0`: round half up, towards plus infinity.
#[inline(always)]
pub const fn divide_round_half_up(numerator: i128, denominator: i128) -> i128 {
    (2 * numerator + denominator).div_euclid(2 * denominator)
}

/// `floor(value / 2^shift + 1/2)`: drops `shift` fraction bits, round half up.
#[inline(always)]
pub const fn shift_round_half_up(value: i64, shift: u32) -> i64 {
    if shift == 0 { value } else { (value.wrapping_add(1 << (shift - 1))) >> shift }
}
