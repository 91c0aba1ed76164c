// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sending side of the step port: which command carries a vertex, and the book of the column memory.

use super::place::{Observer, Place, Rung};
use super::walk::Walker;
use crate::step::{Kind, LeftCommand, MAX_COMPONENTS, RightCommand, Step, Vertex};

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

    /// Notes the upper edge's first vertex not yet consumed.
    #[inline(always)]
    pub(super) fn watch(&mut self, edge: &Walker<N>) {
        if O::WATCHES {
            (self.rung.edge, self.rung.edge_row) = (edge.place(), edge.row());
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
