// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sending side of the step port: which command carries a vertex, and the book of the column memory.

use super::edge::Walker;
use crate::step::{Kind, LeftCommand, MAX_COMPONENTS, RightCommand, Step, Vertex};
use serde::{Deserialize, Serialize};

/// Where a vertex lies on its base triangle; equal places are the same vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Place {
    /// Corner `0..3`.
    Corner(u8),
    /// Vertex of the inside of an edge.
    Edge {
        /// Edge: e0 = P0P1, e1 = P1P2, e2 = P2P0.
        edge: u8,
        /// Number from the edge's low end, `1..n`.
        index: u32,
    },
    /// Vertex of the grid of the remeshing plane, strictly between the edges.
    Interior {
        /// Grid coordinate on the (unmirrored) sweep axis, in voxels.
        sweep: i32,
        /// Grid coordinate on the (unmirrored) side axis, in voxels.
        side: i32,
    },
}

/// The ladder's state at a beat, as the sweep sees it, without decoding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rung {
    /// Left vertex before the beat; in a `Start`, `Init` or `Fan` equal to `next_left`.
    pub left: Place,
    /// Right vertex before the beat; in a `Start`, `Init` or `Fan` equal to `next_right`.
    pub right: Place,
    /// Left vertex after the beat.
    pub next_left: Place,
    /// Right vertex after the beat.
    pub next_right: Place,
    /// First vertex of the upper edge not yet consumed, after the beat.
    pub edge: Place,
    /// Its row, in the mirrored plane.
    pub edge_row: i32,
    /// Sub-triangle, 0 or 1 (the half beyond C's column).
    pub sub: u8,
    /// Strip within the sub-triangle, from 0.
    pub strip: u32,
    /// Vertices in the column memory for the left side and for the right one, after the beat.
    pub stored: [usize; 2],
}

impl Rung {
    /// The triangles of `step` in the base triangle's winding order, those with two equal vertices left out.
    pub fn triangles(&self, step: &Step) -> impl Iterator<Item = [Place; 3]> + use<> {
        let moves = step.kind == Kind::Step;
        let first = (moves && step.left != LeftCommand::Ref).then_some([self.left, self.right, self.next_left]);
        let second =
            (moves && step.right != RightCommand::Ref).then_some([self.right, self.next_right, self.next_left]);
        let swap = step.swap;
        [first, second]
            .into_iter()
            .flatten()
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .map(move |[a, b, c]| if swap { [a, c, b] } else { [a, b, c] })
    }
}

/// Receives the beats of a sweep.
pub(super) trait Observer {
    /// Whether the sweep must keep the [`Rung`].
    const WATCHES: bool;
    fn beat(&mut self, step: &Step, rung: &Rung);
}

/// Only the beats.
pub(super) struct Beats<'a>(pub &'a mut dyn FnMut(&Step));

impl Observer for Beats<'_> {
    const WATCHES: bool = false;
    #[inline(always)]
    fn beat(&mut self, step: &Step, _: &Rung) {
        (self.0)(step);
    }
}

/// The beats with their rungs.
pub(super) struct Watched<'a>(pub &'a mut dyn FnMut(&Step, &Rung));

impl Observer for Watched<'_> {
    const WATCHES: bool = true;
    fn beat(&mut self, step: &Step, rung: &Rung) {
        (self.0)(step, rung);
    }
}

/// The output rounding: `wrap(shift_round_half_up(accumulator, g), W0)` in one addition and two shifts.
///
/// The left shift drops what lies above the W0 bits that leave, so the accumulators need no wrapping before it.
#[derive(Clone, Copy)]
struct Rounding {
    half: i64,
    up: u32,
    down: u32,
}

/// Assembles beats.
pub(super) struct Port<'a, const N: usize, O: Observer> {
    observer: &'a mut O,
    beat: Step,
    /// Public to the sweep, which fills in what only it knows.
    pub(super) rung: Rung,
    corners: [[i64; N]; 3],
    rounding: Rounding,
    depth: usize,
    /// Interior vertices in the column memory that the left side will recall.
    left_stored: usize,
    /// Those that the right side has stored in this strip.
    right_stored: usize,
    /// No vertex of this strip's right side has been refused yet: what is recalled is a prefix of the column.
    open: bool,
    /// The edge register holds the upper edge's first vertex not yet consumed (the last right vertex of a strip).
    edge_held: bool,
}

impl<'a, const N: usize, O: Observer> Port<'a, N, O> {
    pub(super) fn new(format: &super::Format, data: &[Vertex; 3], observer: &'a mut O) -> Self {
        let (w0, g) = (format.vertex_bits, format.guard_bits);
        let zero = [0; MAX_COMPONENTS];
        let nowhere = Place::Corner(0);
        Self {
            observer,
            beat: Step {
                kind: Kind::Start,
                left: LeftCommand::Ref,
                right: RightCommand::Ref,
                swap: false,
                last: false,
                left_vertex: zero,
                right_vertex: zero,
            },
            rung: Rung {
                left: nowhere,
                right: nowhere,
                next_left: nowhere,
                next_right: nowhere,
                edge: nowhere,
                edge_row: 0,
                sub: 0,
                strip: 0,
                stored: [0; 2],
            },
            corners: data.map(|v| std::array::from_fn(|c| v[c])),
            rounding: Rounding { half: if g == 0 { 0 } else { 1 << (g - 1) }, up: 64 - w0 - g, down: 64 - w0 },
            depth: format.column_depth,
            left_stored: 0,
            right_stored: 0,
            open: true,
            edge_held: false,
        }
    }

    /// The rung that opens a sub-triangle at a corner.
    pub(super) fn start(&mut self, swap: bool, left: &Walker<N>, right: &Walker<N>) {
        (self.left_stored, self.right_stored, self.open, self.edge_held) = (0, 0, true, false);
        self.beat.swap = swap;
        self.set_left(left);
        self.set_right(RightCommand::Set, right);
        self.close(Kind::Start, false);
    }

    /// The rung that opens a further strip: its left end is the start register.
    pub(super) fn init(&mut self, left: Place, right: &Walker<N>) {
        (self.left_stored, self.right_stored, self.open) = (self.right_stored, 0, true);
        self.set_right(RightCommand::Set, right);
        if O::WATCHES {
            self.rung.next_left = left;
        }
        self.close(Kind::Init, false);
    }

    /// Pins the left vertex as the right one of a fan that runs along the upper edge from `edge`.
    pub(super) fn fan(&mut self, edge: &Walker<N>) {
        if O::WATCHES {
            self.rung.next_right = self.rung.left;
        }
        self.left_edge(edge);
        self.close(Kind::Fan, false);
    }

    /// Moves left to the upper edge's first vertex, which the sweep then consumes.
    #[inline(always)]
    pub(super) fn left_edge(&mut self, edge: &Walker<N>) {
        if std::mem::take(&mut self.edge_held) {
            self.beat.left = LeftCommand::Edge;
            if O::WATCHES {
                self.rung.next_left = edge.place();
            }
        } else {
            self.set_left(edge);
        }
    }

    /// Moves left to an interior vertex.
    #[inline(always)]
    pub(super) fn left_interior(&mut self, accumulator: &[i64; N], place: Place) {
        if self.left_stored > 0 {
            self.left_stored -= 1;
            self.beat.left = LeftCommand::Recall;
        } else {
            self.beat.left = LeftCommand::Set;
            round(self.rounding, &mut self.beat.left_vertex, accumulator);
        }
        if O::WATCHES {
            self.rung.next_left = place;
        }
    }

    /// Moves right to an interior vertex. `before` is what the left side had stored before this beat, and `again` tells
    /// that a strip follows whose left side will use the vertex.
    #[inline(always)]
    pub(super) fn right_interior(&mut self, accumulator: &[i64; N], place: Place, before: usize, again: bool) {
        if again && self.open && before + self.right_stored < self.depth {
            self.right_stored += 1;
            self.beat.right = RightCommand::Store;
        } else {
            self.open = false;
            self.beat.right = RightCommand::Set;
        }
        round(self.rounding, &mut self.beat.right_vertex, accumulator);
        if O::WATCHES {
            self.rung.next_right = place;
        }
    }

    /// Moves right to a vertex of the base edge that stands in for the last column.
    pub(super) fn right_column(&mut self, walker: &Walker<N>) {
        self.set_right(RightCommand::Set, walker);
    }

    /// Moves right to the upper edge's first vertex, which stays unconsumed.
    pub(super) fn right_edge(&mut self, edge: &Walker<N>) {
        self.set_right(RightCommand::Edge, edge);
        self.edge_held = true;
    }

    /// Vertices that the left side can still recall.
    #[inline(always)]
    pub(super) const fn left_stored(&self) -> usize {
        self.left_stored
    }

    /// Sends the rung that the moves since the last beat have assembled.
    #[inline(always)]
    pub(super) fn step(&mut self, last: bool) {
        self.close(Kind::Step, last);
    }

    /// The single triangle of a base triangle whose corners are one grid point.
    pub(super) fn point(&mut self) {
        let corner = |corner: usize| Place::Corner(corner as u8);
        (self.beat.left, self.beat.right) = (LeftCommand::Set, RightCommand::Set);
        self.beat.left_vertex[..N].copy_from_slice(&self.corners[0]);
        self.beat.right_vertex[..N].copy_from_slice(&self.corners[1]);
        (self.rung.next_left, self.rung.next_right) = (corner(0), corner(1));
        self.close(Kind::Start, false);
        self.beat.left = LeftCommand::Set;
        self.beat.left_vertex[..N].copy_from_slice(&self.corners[2]);
        self.rung.next_left = corner(2);
        self.close(Kind::Step, true);
    }

    fn set_left(&mut self, walker: &Walker<N>) {
        self.beat.left = LeftCommand::Set;
        vertex(&self.corners, self.rounding, &mut self.beat.left_vertex, walker);
        if O::WATCHES {
            self.rung.next_left = walker.place();
        }
    }

    fn set_right(&mut self, command: RightCommand, walker: &Walker<N>) {
        self.beat.right = command;
        vertex(&self.corners, self.rounding, &mut self.beat.right_vertex, walker);
        if O::WATCHES {
            self.rung.next_right = walker.place();
        }
    }

    #[inline(always)]
    fn close(&mut self, kind: Kind, last: bool) {
        (self.beat.kind, self.beat.last) = (kind, last);
        if O::WATCHES {
            if kind != Kind::Step {
                (self.rung.left, self.rung.right) = (self.rung.next_left, self.rung.next_right);
            }
            self.rung.stored = [self.left_stored, self.right_stored];
        }
        self.observer.beat(&self.beat, &self.rung);
        if O::WATCHES {
            (self.rung.left, self.rung.right) = (self.rung.next_left, self.rung.next_right);
        }
        // Vertices that are not sent read as zero.
        if self.beat.sends_left() {
            self.beat.left_vertex[..N].fill(0);
        }
        if self.beat.sends_right() {
            self.beat.right_vertex[..N].fill(0);
        }
        (self.beat.left, self.beat.right) = (LeftCommand::Ref, RightCommand::Ref);
    }
}

#[inline(always)]
fn round<const N: usize>(rounding: Rounding, target: &mut Vertex, accumulator: &[i64; N]) {
    for c in 0..N {
        target[c] = (accumulator[c].wrapping_add(rounding.half) << rounding.up) >> rounding.down;
    }
}

/// The vertex that a walk stands on.
#[inline(always)]
fn vertex<const N: usize>(corners: &[[i64; N]; 3], rounding: Rounding, target: &mut Vertex, walker: &Walker<N>) {
    match walker.corner() {
        Some(corner) => target[..N].copy_from_slice(&corners[corner]),
        None => round(rounding, target, walker.accumulator()),
    }
}
