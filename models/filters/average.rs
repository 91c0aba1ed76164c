// SPDX-License-Identifier: MIT OR Apache-2.0
//! Means of 2 x 2 samples.

use super::fill;
use crate::mip_build::{Centring, Level, Wrap, side_above};

/// The level above: the mean of the four samples of a cell, rounded half up. The last one of an odd side counts twice.
pub(super) fn above(below: &Level, wrap: [Wrap; 2]) -> Level {
    let [width, height] =
        [(below.width, wrap[0]), (below.height, wrap[1])].map(|(side, wrap)| side_above(side, Centring::Cell, wrap));
    fill(width, height, |i, j| {
        let [columns, rows] =
            [(i, below.width), (j, below.height)].map(|(at, side)| [2 * at, (2 * at + 1).min(side - 1)]);
        let sum: u32 = rows.iter().flat_map(|&y| columns.iter().map(move |&x| u32::from(below.at(x, y)))).sum();
        ((sum + 2) >> 2) as u16
    })
}
