// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact numbers: an integer that never overflows, and a number as a file gives it.
//!
//! [`Int`] is an `i128` until a sum or product does not fit, and a `BigInt` from then on. Every predicate of the checker
//! is written once, in `Int`, and is exact for every input; the allocation is paid only where the range asks for it.
//! Expansions of doubles (`robust`) would not do: a decimal such as 0.1 is no finite sum of doubles.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;

/// An integer of any size, without allocation up to 128 bits.
#[derive(Clone, Debug)]
pub(super) enum Int {
    Small(i128),
    Big(BigInt),
}

impl Int {
    pub(super) const ZERO: Int = Int::Small(0);

    fn big(&self) -> BigInt {
        match self {
            Int::Small(value) => BigInt::from(*value),
            Int::Big(value) => value.clone(),
        }
    }

    pub(super) fn sign(&self) -> Ordering {
        match self {
            Int::Small(value) => value.cmp(&0),
            Int::Big(value) => value.cmp(&BigInt::ZERO),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    /// The value to a relative error of 2^-53, if it is small enough to have one cheaply.
    pub(super) fn approximate(&self) -> Option<f64> {
        match self {
            Int::Small(value) => Some(*value as f64),
            Int::Big(_) => None,
        }
    }

    /// `base` to the power of `exponent`.
    pub(super) fn power(base: u32, exponent: u32) -> Int {
        match i128::from(base).checked_pow(exponent) {
            Some(value) => Int::Small(value),
            None => Int::Big(BigInt::from(base).pow(exponent)),
        }
    }
}

impl From<i64> for Int {
    fn from(value: i64) -> Int {
        Int::Small(value.into())
    }
}

impl From<u64> for Int {
    fn from(value: u64) -> Int {
        Int::Small(value.into())
    }
}

/// One operator: checked in 128 bits, repeated in `BigInt` where that overflows.
macro_rules! operator {
    ($trait:ident, $method:ident, $checked:ident) => {
        impl $trait for &Int {
            type Output = Int;
            #[inline]
            fn $method(self, other: &Int) -> Int {
                if let (Int::Small(a), Int::Small(b)) = (self, other)
                    && let Some(value) = a.$checked(*b)
                {
                    return Int::Small(value);
                }
                Int::Big($trait::$method(self.big(), other.big()))
            }
        }
    };
}
operator!(Add, add, checked_add);
operator!(Sub, sub, checked_sub);
operator!(Mul, mul, checked_mul);

impl PartialEq for Int {
    fn eq(&self, other: &Int) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Int {}
impl PartialOrd for Int {
    fn partial_cmp(&self, other: &Int) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Int {
    fn cmp(&self, other: &Int) -> Ordering {
        match (self, other) {
            (Int::Small(a), Int::Small(b)) => a.cmp(b),
            _ => self.big().cmp(&other.big()),
        }
    }
}

/// A vector of exact integers.
pub(super) type Vector = [Int; 3];

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    let component = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [component(1, 2), component(2, 0), component(0, 1)]
}

pub(super) fn dot(a: &Vector, b: &Vector) -> Int {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

pub(super) fn sum(a: &Vector, b: &Vector) -> Vector {
    [&a[0] + &b[0], &a[1] + &b[1], &a[2] + &b[2]]
}

pub(super) fn is_zero(a: &Vector) -> bool {
    a.iter().all(Int::is_zero)
}

fn approximate(a: &Vector) -> Option<[f64; 3]> {
    Some([a[0].approximate()?, a[1].approximate()?, a[2].approximate()?])
}

/// The sign of `a . b`: in doubles where their error bound decides it, in exact integers where it does not.
pub(super) fn sign_of_dot(a: &Vector, b: &Vector) -> Ordering {
    if let (Some(x), Some(y)) = (approximate(a), approximate(b)) {
        let terms = [x[0] * y[0], x[1] * y[1], x[2] * y[2]];
        // Two conversions, one product and two sums: below 6 * 2^-53 of the sum of magnitudes. 2^-48 leaves a margin.
        let bound = (terms[0].abs() + terms[1].abs() + terms[2].abs()) * f64::powi(2.0, -48);
        let value = terms[0] + terms[1] + terms[2];
        // 2^-48 of a finite sum is finite: 6 * 127 bits stay below 2^1023.
        if value.abs() > bound {
            return value.total_cmp(&0.0);
        }
    }
    dot(a, b).sign()
}

/// A distance in lattice steps, as a fraction.
#[derive(Clone, Debug)]
pub(super) struct Distance {
    pub(super) numerator: Int,
    pub(super) denominator: Int,
}

impl Distance {
    /// Whether `|height| <= self * |along|`, where `height` and `along` are given by their squares, or by the vectors:
    /// `square` is asked only where doubles leave it open.
    pub(super) fn covers(&self, height: &Vector, along: &Vector) -> bool {
        if is_zero(height) {
            return true;
        }
        if let (Some(h), Some(l), Some(p), Some(q)) =
            (approximate(height), approximate(along), self.numerator.approximate(), self.denominator.approximate())
        {
            let left = q * f64::hypot(f64::hypot(h[0], h[1]), h[2]);
            let right = p * f64::hypot(f64::hypot(l[0], l[1]), l[2]);
            // Every term is positive, so the relative error is a few 2^-53; one in 2^40 is left to the integers.
            let margin = f64::powi(2.0, -40) * (left + right);
            if left.is_finite() && right.is_finite() && (left - right).abs() > margin {
                return left < right;
            }
        }
        let left = &(&self.denominator * &self.denominator) * &dot(height, height);
        let right = &(&self.numerator * &self.numerator) * &dot(along, along);
        left <= right
    }
}

/// The base of the power that a number of a file is scaled by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Radix {
    /// Binary floating point: `mantissa * 2^exponent`.
    Two = 2,
    /// Decimal text: `mantissa * 10^exponent`.
    Ten = 10,
}

/// A number exactly as the file gives it: `mantissa * radix^exponent`, with no factor of the radix in the mantissa and
/// zero as (0, 0), so that equal numbers are equal bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub(super) struct Scaled {
    pub(super) mantissa: i64,
    pub(super) exponent: i16,
}

/// Decimal exponents reach as far as those of a double.
const DECIMAL_EXPONENTS: std::ops::RangeInclusive<i64> = -340..=300;
/// Those that a double holds exactly.
const POWERS_OF_TEN: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];
/// Significant digits that surely fit into the mantissa.
const DIGITS: u32 = 18;

impl Scaled {
    /// An integer of either radix; powers of the radix are taken out.
    pub(super) fn from_integer(value: i64, radix: Radix) -> Scaled {
        match radix {
            _ if value == 0 => Scaled::default(),
            Radix::Two => Scaled { mantissa: value >> value.trailing_zeros(), exponent: value.trailing_zeros() as i16 },
            Radix::Ten => {
                let (mut mantissa, mut exponent) = (value, 0);
                while mantissa % 10 == 0 {
                    mantissa /= 10;
                    exponent += 1;
                }
                Scaled { mantissa, exponent }
            }
        }
    }

    /// The exact value of a double (radix two), or `None` if it is not finite.
    pub(super) fn from_double(value: f64) -> Option<Scaled> {
        if !value.is_finite() {
            return None;
        }
        let bits = value.to_bits();
        let (field, fraction) = ((bits >> 52 & 0x7FF) as i16, (bits & ((1 << 52) - 1)) as i64);
        // A subnormal has exponent field 0, stands at the scale of field 1, and has no hidden bit.
        let magnitude = if field == 0 { fraction } else { fraction | 1 << 52 };
        let mut scaled = Scaled::from_integer(magnitude, Radix::Two);
        if magnitude != 0 {
            scaled.exponent += field.max(1) - 1075;
        }
        if value.is_sign_negative() {
            scaled.mantissa = -scaled.mantissa;
        }
        Some(scaled)
    }

    /// The exact value of a decimal such as `-12.50e-3` (radix ten), or the reason why there is none, as the end of a
    /// sentence that begins with the field.
    pub(super) fn from_decimal(text: &[u8]) -> Result<Scaled, &'static str> {
        const MALFORMED: &str = "is not a decimal number";
        let (negative, digits) = match text {
            [b'-', rest @ ..] => (true, rest),
            [b'+', rest @ ..] => (false, rest),
            rest => (false, rest),
        };
        // Zeros are held back until a digit follows them, so that the mantissa never ends in one.
        let (mut mantissa, mut significant, mut held_back) = (0i64, 0u32, 0i64);
        let (mut exponent, mut any, mut in_fraction, mut index) = (0i64, false, false, 0);
        while let Some(&byte) = digits.get(index) {
            match byte {
                b'0'..=b'9' => {
                    any = true;
                    exponent -= i64::from(in_fraction);
                    if byte == b'0' {
                        held_back += i64::from(mantissa != 0);
                    } else {
                        let added = if mantissa == 0 { 1 } else { held_back + 1 };
                        significant = significant.saturating_add(u32::try_from(added).unwrap_or(u32::MAX));
                        if significant > DIGITS {
                            return Err("has more than 18 significant digits");
                        }
                        // At most 18 digits in all, so neither the power nor the product can overflow.
                        mantissa = mantissa * 10i64.pow(added as u32) + i64::from(byte - b'0');
                        held_back = 0;
                    }
                }
                b'.' if !in_fraction => in_fraction = true,
                _ => break,
            }
            index += 1;
        }
        if !any {
            return Err(MALFORMED);
        }
        match &digits[index..] {
            [] => {}
            [b'e' | b'E', power @ ..] => {
                let power = std::str::from_utf8(power).map_err(|_| MALFORMED)?;
                // `parse` takes a sign; a power with more digits than an i32 is beyond every double.
                exponent += i64::from(power.parse::<i32>().map_err(|_| MALFORMED)?);
            }
            _ => return Err(MALFORMED),
        }
        if mantissa == 0 {
            return Ok(Scaled::default());
        }
        exponent += held_back;
        if !DECIMAL_EXPONENTS.contains(&exponent) || exponent + i64::from(significant) > 300 {
            return Err("is beyond the range of a double");
        }
        Ok(Scaled { mantissa: if negative { -mantissa } else { mantissa }, exponent: exponent as i16 })
    }

    /// The same number in the other radix, if its mantissa fits there.
    pub(super) fn convert(self, from: Radix, to: Radix) -> Option<Scaled> {
        let exponent = u32::from(self.exponent.unsigned_abs());
        let five = || 5i64.checked_pow(exponent);
        let scaled = |mantissa, radix| Scaled::from_integer(mantissa, radix);
        let shifted = |number: Scaled, by: i16| Scaled { exponent: number.exponent + by, ..number };
        Some(match (from, to) {
            _ if self.mantissa == 0 || from == to => self,
            // m 10^e = (m 5^e) 2^e; for e < 0 only if 5^-e divides m.
            (Radix::Ten, _) if self.exponent >= 0 => {
                shifted(scaled(self.mantissa.checked_mul(five()?)?, to), self.exponent)
            }
            (Radix::Ten, _) if self.mantissa % five()? == 0 => {
                shifted(scaled(self.mantissa / five()?, to), self.exponent)
            }
            (Radix::Ten, _) => return None,
            // m 2^e is an integer for e >= 0; for e < 0 it is (m 5^-e) 10^e.
            (Radix::Two, _) if self.exponent >= 0 => {
                scaled(self.mantissa.checked_mul(1i64.checked_shl(exponent).filter(|power| *power > 0)?)?, to)
            }
            (Radix::Two, _) => shifted(scaled(self.mantissa.checked_mul(five()?)?, to), self.exponent),
        })
    }

    /// The nearest double.
    pub(super) fn approximate(self, radix: Radix) -> f64 {
        match radix {
            // In two steps: 2^-1074 is a double, 2^-1100 times a large mantissa may be one too.
            Radix::Two => {
                let half = i32::from(self.exponent) / 2;
                self.mantissa as f64 * f64::powi(2.0, half) * f64::powi(2.0, i32::from(self.exponent) - half)
            }
            // Integers to 2^53 and powers of ten to 10^22 are doubles, so one operation rounds, and rightly.
            Radix::Ten if self.mantissa.unsigned_abs() <= 1 << 53 && self.exponent.unsigned_abs() <= 22 => {
                let power = POWERS_OF_TEN[usize::from(self.exponent.unsigned_abs())];
                if self.exponent < 0 { self.mantissa as f64 / power } else { self.mantissa as f64 * power }
            }
            Radix::Ten => format!("{}e{}", self.mantissa, self.exponent).parse().unwrap_or(0.0),
        }
    }

    /// The number in full, as a decimal.
    pub(super) fn display(self, radix: Radix) -> String {
        match radix {
            Radix::Two => format!("{}", self.approximate(radix)),
            Radix::Ten => {
                let digits = self.mantissa.unsigned_abs().to_string();
                let sign = if self.mantissa < 0 { "-" } else { "" };
                let exponent = i32::from(self.exponent);
                if !(-30..=30).contains(&exponent) {
                    format!("{sign}{digits}e{exponent}")
                } else if exponent >= 0 {
                    format!("{sign}{digits}{}", "0".repeat(exponent as usize))
                } else {
                    let fraction = exponent.unsigned_abs() as usize;
                    let padded = format!("{digits:0>width$}", width = fraction + 1);
                    let (whole, part) = padded.split_at(padded.len() - fraction);
                    format!("{sign}{whole}.{part}")
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn decimal(text: &str) -> Result<(i64, i16), &'static str> {
        Scaled::from_decimal(text.as_bytes()).map(|number| (number.mantissa, number.exponent))
    }

    #[test]
    fn exact_decimals_are_normalised() {
        for (text, expected) in [
            ("0", (0, 0)),
            ("-0.000", (0, 0)),
            ("1", (1, 0)),
            ("1000", (1, 3)),
            ("+1.50", (15, -1)),
            ("-.5", (-5, -1)),
            ("5.", (5, 0)),
            ("100.001", (100_001, -3)),
            ("0.000120", (12, -5)),
            ("12.5e-3", (125, -4)),
            ("1E+2", (1, 2)),
            ("123456789012345678000", (123_456_789_012_345_678, 3)),
        ] {
            assert_eq!(decimal(text), Ok(expected), "{text}");
        }
        for text in ["", "-", ".", "e5", "1e", "1e+", "1.2.3", "0x10", "nan", "inf", "1_000", "--1", "1e999", "1e-999"]
        {
            assert!(decimal(text).is_err(), "{text}");
        }
        assert!(decimal("1234567890123456789").is_err());
        assert!(decimal("0.1000000000000000000000000000001").is_err());
    }

    proptest! {
        #[test]
        fn exact_doubles_come_back(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            match Scaled::from_double(value) {
                None => prop_assert!(!value.is_finite()),
                Some(number) => {
                    prop_assert_eq!(number.approximate(Radix::Two), value);
                    prop_assert!(number.mantissa == 0 || number.mantissa % 2 != 0);
                }
            }
        }

        #[test]
        fn exact_conversion_keeps_the_value(mantissa in -1_000_000i64..1_000_000, exponent in -8i16..9) {
            let ten = Scaled::from_integer(mantissa, Radix::Ten);
            let ten = Scaled { exponent: if mantissa == 0 { 0 } else { ten.exponent + exponent }, ..ten };
            if let Some(two) = ten.convert(Radix::Ten, Radix::Two) {
                prop_assert_eq!(two.approximate(Radix::Two), ten.approximate(Radix::Ten));
                prop_assert_eq!(two.convert(Radix::Two, Radix::Ten), Some(ten));
            }
        }

        #[test]
        fn exact_integers_agree_with_wide_ones(a in any::<i128>(), b in any::<i128>(), c in any::<i64>()) {
            let (x, y, z) = (Int::Small(a), Int::Small(b), Int::from(c));
            let (p, q, r) = (BigInt::from(a), BigInt::from(b), BigInt::from(c));
            let value = &(&(&x * &y) + &z) - &(&y * &z);
            prop_assert_eq!(value.big(), &p * &q + &r - &q * &r);
            prop_assert_eq!(value.sign(), (&p * &q + &r - &q * &r).cmp(&BigInt::ZERO));
            let (u, v) = ([x.clone(), y.clone(), z.clone()], [y, z, x]);
            prop_assert_eq!(sign_of_dot(&u, &v), dot(&u, &v).sign());
        }
    }
}
