// SPDX-License-Identifier: MIT OR Apache-2.0
//! What moves from column to column: the walks along the base edges, the upper edge, and the foot of the interior chains.

use super::Place;
use super::edge::EdgeSetup;

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

/// The upper edge of a sub-triangle, standing on its first vertex not yet consumed.
pub(super) struct Upper<const N: usize> {
    pub(super) walker: Walker<N>,
    /// The edge CB that follows once the walker is through with AC (only where C is above A in an increasing triangle).
    pub(super) then: Option<Walker<N>>,
}

impl<const N: usize> Upper<N> {
    /// Column of the vertex relative to the sub-triangle's first one. Only the end may stand in the last column
    /// (amendment A2), and AC of the poly-line lies in the first.
    #[inline(always)]
    pub(super) fn column(&self, first: i32, columns: i32) -> i32 {
        match self.then {
            Some(_) => 0,
            None if self.walker.at_end() => columns,
            None => (self.walker.column() - first).min(columns - 1),
        }
    }
    /// Goes to the next vertex; C is a vertex of AC, so CB is entered behind it.
    #[inline(always)]
    pub(super) fn advance(&mut self) {
        if self.walker.at_end()
            && let Some(next) = self.then.take()
        {
            self.walker = next;
        }
        self.walker.advance();
    }
}

/// The chain of interior cursors' feet: vertex data at (column, row) of the primary edge's rounded vertex.
pub(super) struct Foot<const N: usize> {
    pub(super) accumulator: [i64; N],
    pub(super) row: i32,
    pub(super) sweep_difference: [i64; N],
    pub(super) side_difference: [i64; N],
}

impl<const N: usize> Foot<N> {
    /// Moves to the next column, to `row`, which is at most one away.
    #[inline(always)]
    pub(super) fn advance(&mut self, row: i32) {
        add(&mut self.accumulator, &self.sweep_difference);
        let delta = i64::from(row - self.row);
        for c in 0..N {
            self.accumulator[c] = self.accumulator[c].wrapping_add(delta.wrapping_mul(self.side_difference[c]));
        }
        self.row = row;
    }
}
