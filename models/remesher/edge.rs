// SPDX-License-Identifier: MIT OR Apache-2.0
//! Base edges: their vertices are a function of the two ends only (amendment A5), so that neighbours agree bit for bit.

use super::{BaseTriangle, Format};
use crate::fixed::{divide_round_half_up, wrap};
use crate::step::{MAX_COMPONENTS, Vertex};
use serde::{Deserialize, Serialize};

/// What the setup unit computes of a base edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct EdgeSetup {
    /// Main axis, `0..3`: the one with the largest extent, ties x before y before z.
    pub axis: usize,
    /// Extent along the main axis in voxels, `n`. With 0 the edge is one segment and the differences are unused (zero).
    pub segments: u32,
    /// Corner with the smaller coordinate on the main axis; vertices are numbered from it. The first corner if `n` = 0.
    pub low: usize,
    /// The other corner.
    pub high: usize,
    /// `D = floor((V[high] - V[low]) * 2^g / n + 1/2)`, W bits a component. It fits: `|V[high] - V[low]| < 2^W0`.
    pub difference: Vertex,
    /// `(V[high] - V[low]) * 2^g - n * D`, the divider's remainder, in `-n/2..=n/2`.
    pub remainder: Vertex,
    /// First accumulator of a walk from `low`: `V[low] * 2^g`.
    pub low_start: Vertex,
    /// First accumulator of a walk from `high`: `V[high] * 2^g - remainder`, so that both walks meet in the same bits.
    pub high_start: Vertex,
}

impl EdgeSetup {
    /// The edge from corner `edge` to the next one of the winding order: e0 = P0P1, e1 = P1P2, e2 = P2P0.
    pub(super) fn new(format: &Format, base: &BaseTriangle, edge: usize) -> Self {
        let (from, to) = (edge, (edge + 1) % 3);
        let span = |axis: usize| i64::from(base.corners[to][axis]) - i64::from(base.corners[from][axis]);
        // `max_by_key` would take the last of equals.
        let axis = (1..3).fold(0, |best, k| if span(k).abs() > span(best).abs() { k } else { best });
        let n = span(axis).abs();
        let (low, high) = if span(axis) >= 0 { (from, to) } else { (to, from) };
        let zero = [0; MAX_COMPONENTS];
        let (mut difference, mut remainder, mut low_start, mut high_start) = (zero, zero, zero, zero);
        let (g, w) = (format.guard_bits, format.accumulator_bits());
        for c in 0..format.components {
            let total = (i128::from(base.data[high][c]) - i128::from(base.data[low][c])) << g;
            if n > 0 {
                let d = divide(total, n);
                difference[c] = wrap(d as i64, w);
                remainder[c] = (total - i128::from(n) * d) as i64;
            }
            low_start[c] = wrap(base.data[low][c] << g, w);
            high_start[c] = wrap((base.data[high][c] << g).wrapping_sub(remainder[c]), w);
        }
        Self { axis, segments: n as u32, low, high, difference, remainder, low_start, high_start }
    }
}

/// [`divide_round_half_up`], in 64 bits where they are enough: a 128-bit division costs several times as much.
pub(super) fn divide(numerator: i128, denominator: i64) -> i128 {
    let (twice, half) = (2 * numerator + i128::from(denominator), 2 * denominator);
    match i64::try_from(twice) {
        Ok(twice) => twice.div_euclid(half).into(),
        Err(_) => divide_round_half_up(numerator, denominator.into()),
    }
}
