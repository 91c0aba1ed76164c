// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks of single values; each error is a sentence about the field that it names.

use glam::DVec3;

use crate::digits::short;

/// World units beyond which squares and products lose their use.
const FAR_AWAY: f64 = 1e9;
/// Lengths below which two vertices could fall together.
const TINY: f64 = 1e-9;

/// Three numbers in few digits.
pub(super) fn short_vector(value: DVec3) -> String {
    format!("[{}]", value.to_array().map(short).join(", "))
}

/// A number that is neither NaN nor infinite nor far away.
pub(super) fn finite(field: &str, value: f64) -> Result<f64, String> {
    if value.abs() <= FAR_AWAY {
        return Ok(value);
    }
    Err(format!("`{field}` is {}; a finite number from -1e9 to 1e9 is expected", short(value)))
}

/// A finite number of some size.
pub(super) fn positive(field: &str, value: f64) -> Result<f64, String> {
    if finite(field, value)? >= TINY {
        return Ok(value);
    }
    Err(format!("`{field}` is {}; a number greater than 0 (1e-9 at least) is expected", short(value)))
}

/// Three finite numbers.
pub(super) fn vector(field: &str, value: [f64; 3]) -> Result<DVec3, String> {
    for part in value {
        finite(field, part)?;
    }
    Ok(DVec3::from(value))
}

/// A finite vector, normalised.
pub(super) fn direction(field: &str, value: [f64; 3]) -> Result<DVec3, String> {
    let unit = vector(field, value)?.try_normalize();
    unit.ok_or_else(|| format!("`{field}` is [0, 0, 0]; a direction, of any length but 0, is expected"))
}

/// A number within inclusive bounds.
pub(super) fn within(field: &str, value: f64, low: f64, high: f64) -> Result<f64, String> {
    if finite(field, value)? >= low && value <= high {
        return Ok(value);
    }
    Err(format!("`{field}` is {}; a number from {low} to {high} is expected", short(value)))
}

/// Two integers within inclusive bounds; `high` is the limit `whose`.
pub(super) fn counts(field: &str, value: [i64; 2], low: [u32; 2], high: u32, whose: &str) -> Result<[u32; 2], String> {
    let mut counts = [0; 2];
    for axis in 0..2 {
        counts[axis] =
            u32::try_from(value[axis]).ok().filter(|count| (low[axis]..=high).contains(count)).ok_or_else(|| {
                let range = format!("{} to {high} is expected ({high} is {whose})", low[axis]);
                let which = ["first", "second"][axis];
                format!("the {which} number of `{field}` is {}; a number from {range}", value[axis])
            })?;
    }
    Ok(counts)
}
