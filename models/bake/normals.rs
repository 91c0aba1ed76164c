// SPDX-License-Identifier: MIT OR Apache-2.0
//! Normals of a map, from central differences with clamped coordinates.
//!
//! ```text
//! n = (z(x-1, y) - z(x+1, y),  z(x, y-1) - z(x, y+1),  2 s) / length      s map units between two samples
//! ```
//!
//! Three components SQ1.14, rounded half up; 1.0 = 16384 is representable. Example: on a plane that climbs 1 a column, with
//! s = 1, n = (-1, 0, 1) / sqrt 2 = (-11585, 0, 11585) / 16384. The first and the last column and row see half the slope.
//!
//! Error: 1/2 of the last bit, and less than 2^-38 from the arithmetic in f64, which gives the same bits everywhere.

use rayon::prelude::*;

use crate::map::HeightMap;

/// The normals of a map whose samples are `spacing` map units apart.
pub fn normals(map: &HeightMap, spacing: f64) -> Vec<[i16; 3]> {
    let last = [map.width - 1, map.height - 1];
    let difference = |a: u16, b: u16| f64::from(a) - f64::from(b);
    let normal = |index: usize| {
        let [x, y] = [index % map.width, index / map.width];
        let dx = difference(map.sample(x.saturating_sub(1), y), map.sample((x + 1).min(last[0]), y));
        let dy = difference(map.sample(x, y.saturating_sub(1)), map.sample(x, (y + 1).min(last[1])));
        let up = 2.0 * spacing;
        let length = (dx * dx + dy * dy + up * up).sqrt();
        [dx, dy, up].map(|component| (component / length * 16384.0 + 0.5).floor() as i16)
    };
    (0..map.samples.len()).into_par_iter().map(normal).collect()
}
