// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lines along the edges of triangles: pixels get darker the nearer they are to an edge.

use super::{Corner, SUBPIXEL_BITS, orient};

/// Colour of the lines.
const INK: [f64; 3] = [16.0, 20.0, 34.0];
/// Half the width of a line in pixels; either of two neighbours draws one half.
const HALF_WIDTH: f64 = 0.3;
/// Darkness of a line on a large triangle.
const STRONGEST: f64 = 0.75;
/// Radius of the inscribed circle, in pixels, from which on a triangle is large.
const LARGE: f64 = 2.0;

/// What a triangle needs to draw its edges.
pub(super) struct Ink {
    /// Pixels for a unit of each edge function.
    distances: [f64; 3],
    strength: f64,
}

impl Ink {
    /// `None` without area.
    pub(super) fn of(corners: [Corner; 3]) -> Option<Ink> {
        let ([a, b, c], area) = orient(corners)?;
        let lengths = [(b, c), (c, a), (a, b)].map(|(from, to)| {
            let (dx, dy) = (f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y));
            (dx * dx + dy * dy).sqrt()
        });
        let unit = f64::from(1 << SUBPIXEL_BITS);
        let radius = area as f64 / lengths.iter().sum::<f64>() / unit;
        let strength = STRONGEST * (radius / LARGE).min(1.0);
        Some(Ink { distances: lengths.map(|length| 1.0 / (length * unit)), strength })
    }

    /// A colour where the edge functions have these values.
    pub(super) fn over(&self, colour: [u8; 3], edges: [i64; 3]) -> [u8; 3] {
        let distance = (0..3).map(|side| edges[side] as f64 * self.distances[side]).fold(f64::INFINITY, f64::min);
        let part = self.strength * (HALF_WIDTH + 0.5 - distance).clamp(0.0, 1.0);
        [0, 1, 2].map(|k| (f64::from(colour[k]) * (1.0 - part) + INK[k] * part + 0.5) as u8)
    }
}
