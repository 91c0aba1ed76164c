// SPDX-License-Identifier: MIT OR Apache-2.0
//! Base edges: their vertices are a function of the two ends only (amendment A5), so that neighbours agree bit for bit.

use super::{BaseTriangle, Format, Place};
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
    /// `D = floor((V[high] - V[low]) * 2^g / n + 1/2)`, W bits a component. It fits: |V[high]-V[low]| < 2^W0.
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

/// The position of a walk on one axis, rounded half up, by an exact rational difference analyser.
///
/// `value + fraction / modulus` is the position plus 1/2. |step| <= modulus, so one correction a step is enough.
#[derive(Clone, Copy, Debug)]
struct Position {
    value: i32,
    fraction: i32,
    step: i32,
    modulus: i32,
}

impl Position {
    fn new(from: i32, to: i32, segments: i32) -> Self {
        let n = segments.max(1);
        Self { value: from, fraction: n, step: 2 * (to - from), modulus: 2 * n }
    }
    #[inline(always)]
    fn advance(&mut self) {
        self.fraction += self.step;
        if self.fraction >= self.modulus {
            self.fraction -= self.modulus;
            self.value += 1;
        } else if self.fraction < 0 {
            self.fraction += self.modulus;
            self.value -= 1;
        }
    }
}

/// A walk along a base edge, vertex by vertex: vertex data in the accumulator, column and row in the remeshing plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walker<const N: usize> {
    accumulator: [i64; N],
    difference: [i64; N],
    /// Vertices passed, `0..=length`.
    passed: i32,
    /// Steps from end to end: `n`, but 1 for an edge whose ends are one grid point.
    length: i32,
    column: Position,
    row: Position,
    from: usize,
    to: usize,
    edge: usize,
    from_low: bool,
}

impl<const N: usize> Walker<N> {
    /// A walk from corner `from` at (column, row) `at` to corner `to` at `target`, standing on `from`.
    pub(super) fn new(edges: &[EdgeSetup; 3], from: usize, to: usize, at: [i32; 2], target: [i32; 2]) -> Self {
        let edge = if (from + 1) % 3 == to { from } else { to };
        let e = &edges[edge];
        let from_low = from == e.low;
        let start = if from_low { &e.low_start } else { &e.high_start };
        let n = e.segments as i32;
        Self {
            accumulator: std::array::from_fn(|c| start[c]),
            difference: std::array::from_fn(
                |c| if from_low { e.difference[c] } else { e.difference[c].wrapping_neg() },
            ),
            passed: 0,
            length: n.max(1),
            column: Position::new(at[0], target[0], n),
            row: Position::new(at[1], target[1], n),
            from,
            to,
            edge,
            from_low,
        }
    }
    /// Goes to the next vertex.
    #[inline(always)]
    pub(super) fn advance(&mut self) {
        self.passed += 1;
        add(&mut self.accumulator, &self.difference);
        self.column.advance();
        self.row.advance();
    }
    /// Whether the walk stands on its last vertex.
    pub(super) const fn at_end(&self) -> bool {
        self.passed == self.length
    }
    pub(super) const fn column(&self) -> i32 {
        self.column.value
    }
    pub(super) const fn row(&self) -> i32 {
        self.row.value
    }
    /// The corner it stands on, which is sent exactly, whatever the accumulator holds.
    #[inline(always)]
    pub(super) const fn corner(&self) -> Option<usize> {
        if self.passed == 0 {
            Some(self.from)
        } else if self.passed == self.length {
            Some(self.to)
        } else {
            None
        }
    }
    pub(super) const fn accumulator(&self) -> &[i64; N] {
        &self.accumulator
    }
    pub(super) const fn place(&self) -> Place {
        match self.corner() {
            Some(corner) => Place::Corner(corner as u8),
            None => {
                let index = if self.from_low { self.passed } else { self.length - self.passed };
                Place::Edge { edge: self.edge as u8, index: index as u32 }
            }
        }
    }
}

/// `sum[c] += term[c]` modulo 2^64. The width W <= 64 is restored where a vertex leaves: low bits never see high ones.
#[inline(always)]
pub(super) fn add<const N: usize>(sum: &mut [i64; N], term: &[i64; N]) {
    for c in 0..N {
        sum[c] = sum[c].wrapping_add(term[c]);
    }
}
