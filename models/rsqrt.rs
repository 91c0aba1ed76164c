// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reciprocal square root of a normalised number, and the normalisation of vectors that uses it.
//!
//! ```text
//! out = 2^32 / sqrt(x)                x in [1, 4); 64 lines over [1, 2) and 64 over [2, 4), 11 bits along each
//! y0  = C0[i] - (C1[i] h >> 11)       18 fraction bits
//! e   = (1 - x y0^2)                  34 fraction bits, signed
//! out = y0 2^14 + (y0 e >> 21)        32 fraction bits: Newton's step y0 (3 - x y0^2) / 2
//! ```
//!
//! | port | format | range |
//! |------|--------|-------|
//! | x    | UQ2.30 | `[1, 4)` |
//! | out  | UQ0.32 | `[1/2, 1)`; 1.0 is not representable and not reached |
//!
//! Relative error at most 1.16e-9 = 2^-29.68, see `tests/arithmetic.rs`. Example: x = 0x8000_0000 (2.0) -> 0xB504_F33x (0.70710678).

/// Start (18 fraction bits) and fall (18 fraction bits) of each line: 18 + 11 bits of table.
const TABLE: [(u32, u32); 128] = {
    let mut table = [(0, 0); 128];
    let mut i = 0;
    while i < 128 {
        // x = n / 64 or n / 32 with n = 64 + i; 2^36 / sqrt(x) = sqrt(2^72 / x), floor.
        let (n, scale) = ((64 + i % 64) as u128, if i < 64 { 78 } else { 77 });
        let start = root((1 << scale) / n) as u64;
        let end = root((1 << scale) / (n + 1)) as u64;
        let middle = root((1 << (scale + 1)) / (2 * n + 1)) as u64;
        let sag = ((start + end) / 2 - middle) / 2;
        // 36 - 18 = 18 fraction bits; start - sag < 2^36, and a line falls by less than 2^36 / 128.
        table[i] = (((start - sag + (1 << 17)) >> 18) as u32, ((start - end + (1 << 17)) >> 18) as u32);
        i += 1;
    }
    table
};

/// `floor(sqrt(value))`, bit by bit.
pub(crate) const fn root(value: u128) -> u128 {
    let mut result = 0;
    let mut bit = 63;
    loop {
        let candidate: u128 = result | 1 << bit;
        if candidate * candidate <= value {
            result = candidate;
        }
        if bit == 0 {
            return result;
        }
        bit -= 1;
    }
}

/// `2^32 / sqrt(x / 2^30)` for `x >= 2^30`.
pub fn golden(x: u32) -> u32 {
    debug_assert!(x >> 30 != 0, "the reciprocal root takes a number in [1, 4), not {x:#x}");
    let upper = x >> 31;
    let at = x >> (24 + upper) & 63 | upper << 6;
    let h = x >> (13 + upper) & 0x7ff;
    let (start, fall) = TABLE[at as usize];
    // 11 + 11 bits.
    let s1_seed_uq0_18 = i64::from(start - ((fall * h) >> 11));
    // 32 + 36 bits of product, of which x y0^2 is about 1: the difference is below 2^-14, so 34 fraction bits need 21.
    let s2_square_uq0_36 = s1_seed_uq0_18 * s1_seed_uq0_18;
    let s3_error_sq0_34 = (((1i128 << 66) - i128::from(x) * i128::from(s2_square_uq0_36)) >> 32) as i64;
    // 18 + 21 bits; 18 + 34 - 32 = 20 and one for the half.
    let s4_step = (s1_seed_uq0_18 * s3_error_sq0_34) >> 21;
    // 1.0 is not reached (see the tests), so 32 bits hold it.
    ((s1_seed_uq0_18 << 14) + s4_step) as u32
}

/// The exact value, in units of the last place of the result.
pub fn exact(x: u32) -> f64 {
    4_294_967_296.0 / (f64::from(x) / 1_073_741_824.0).sqrt()
}

/// The unit vector of `vector` as SQ1.16 (1.0 is representable), or zero for the zero vector.
///
/// Takes the 16 leading bits of the largest component and as many of the others (rounded half up), so a common positive
/// factor, as the `c` of perspective, needs no division. Angle error at most 3.3e-5 rad (half a unit of 2^-15 going in, of
/// 2^-16 coming out, over two components), length error 1.3e-5, if the
/// largest component has 16 significant bits or more.
pub fn normalize(vector: [i64; 3]) -> [i32; 3] {
    let bits = vector.iter().map(|v| 64 - v.unsigned_abs().leading_zeros()).max().unwrap_or(0);
    unit(vector.map(|v| if bits > 16 { crate::fixed::shift_round_half_up(v, bits - 16) } else { v << (16 - bits) }))
}

/// [`normalize`] of a vector of up to 126 bits.
pub fn normalize_wide(vector: [i128; 3]) -> [i32; 3] {
    let bits = vector.iter().map(|v| 128 - v.unsigned_abs().leading_zeros()).max().unwrap_or(0);
    // 17 bits and sign are left before the last one is rounded away.
    if bits > 62 {
        unit(vector.map(|v| ((v >> (bits - 17)) + 1) as i64 >> 1))
    } else {
        normalize(vector.map(|v| v as i64))
    }
}

/// The unit vector of one whose longest component has a magnitude of 2^15 to 2^16 (rounding up reaches it), or of zero.
pub fn unit(leading: [i64; 3]) -> [i32; 3] {
    // The squares sum to at most 3 2^32, 34 bits.
    let square: i64 = leading.iter().map(|v| v * v).sum();
    if square == 0 {
        return [0; 3];
    }
    // At least (2^15)^2, so an even shift leaves [2^30, 2^32).
    let wide = u32::from(square >> 32 != 0);
    let inverse = i64::from(golden((square >> (2 * wide)) as u32));
    // 17 + 32 bits of product; the quotient is at most 1.0 and a rounding.
    leading.map(|v| crate::fixed::shift_round_half_up(v * inverse, 31 + wide) as i32)
}
