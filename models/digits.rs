// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers in messages, short enough to read.

/// A number in at most seven digits, with an exponent where it would take many zeros.
pub fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    if value == 0.0 || (1e-4..1e7).contains(&value.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// The next number from `value` upwards that has three digits: for a bound that a person types.
pub fn rounded_up(value: f64) -> f64 {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if rounded >= value {
        return rounded;
    }
    // One more in the third digit.
    let exponent = format!("{value:e}").split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    format!("{:.2e}", rounded + libm::pow(10.0, f64::from(exponent - 2))).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::{rounded_up, short};

    #[test]
    fn digits_are_few_and_bounds_hold() {
        assert_eq!(
            [0.0, 1.0, -0.1, 1.0 / 3.0, 1e300, 2.5e-9, f64::INFINITY].map(short),
            ["0", "1", "-0.1", "0.3333333", "1e300", "2.5e-9", "inf"]
        );
        assert_eq!(short(f64::NAN), "NaN");
        assert_eq!([1.0, 1.0001, 0.001234, 999.5, 0.3].map(rounded_up), [1.0, 1.01, 0.00124, 1000.0, 0.3]);
    }
}
