// SPDX-License-Identifier: MIT OR Apache-2.0
//! Decodes the step port into triangles: four vertex registers and the column memory, one step a cycle.
//!
//! ```text
//! Start: left = LD; right = start = RD; the column memory is emptied      Init: left = start; right = start = RD
//! Fan:   right = left; left = LD or edge
//! Step:  L' = left | LD | oldest of the column memory | edge              R' = right | RD (and store, or edge = RD)
//!        triangles (L, R, L') if L moved, (R, R', L') if R moved
//! ```
//! (Gumhold & Huettner 1999, section 3.4; the column memory is ours: an interior vertex is displaced once, not twice.)
//!
//! | port         | format       | range |   Latency 2, interval 1
//! | in_kind, in_left, in_right | unsigned 2 | the step port's codes (models::step) |
//! | in_swap, in_last, in_*vertex | Bit, L x signed V | | Golden: models::strip_unit::StripUnit   Error 0
//! | out_first, out_second | Bit | triangle (left, right, next_left), triangle (right, next_right, next_left) |
//! | out_swap     | Bit          | read a triangle (a, b, c) as (a, c, b) |
//! | out_*left, out_*right | L x signed V | |
//! | error        | Bit          | sticky: a recall found the column memory empty, or a store found it full |
//!
//! A beat that closes no triangle and is not the last of its base triangle sends nothing. A triangle with two equal
//! vertices is dropped. Vertices are equal when they are the same sending, not when their data are: five flags
//! and the number of vertices in the memory tell, so no vertex carries a number.
//!
//! What a beat does is decided first, from commands and flags (s1_decide), and done a cycle later (s2_move): neither a
//! comparison nor a wide multiplexer waits for the other.

mod column_memory;

pub use column_memory::ColumnMemory;

use crate::prelude::*;

/// Strip unit for vertices of `L` x `V` bits; `K` bits count the column memory.
#[derive(Clone, Debug, LogicBlock)]
pub struct StripUnit<const L: usize, const V: usize, const K: usize> {
    /// Clock and reset.
    pub clock: Input<ClockReset>,
    /// A beat stands at the input.
    pub in_valid: Input<Bit>,
    /// It is taken at this edge.
    pub in_ready: Output<Bit>,
    /// 0 step, 1 start, 2 init, 3 fan.
    pub in_kind: Input<U<2>>,
    /// Left command: 0 ref, 1 set, 2 recall, 3 edge.
    pub in_left: Input<U<2>>,
    /// Right command: 0 ref, 1 set, 2 store, 3 edge.
    pub in_right: Input<U<2>>,
    /// Winding; read in a start.
    pub in_swap: Input<Bit>,
    /// The last beat of its base triangle.
    pub in_last: Input<Bit>,
    /// Vertex for the left side.
    pub in_left_vertex: Input<Lanes<L, V>>,
    /// Vertex for the right side.
    pub in_right_vertex: Input<Lanes<L, V>>,
    /// A beat stands at the output.
    pub out_valid: Output<Bit>,
    /// It is taken at this edge.
    pub out_ready: Input<Bit>,
    /// There is a triangle (left, right, next_left).
    pub out_first: Output<Bit>,
    /// There is a triangle (right, next_right, next_left).
    pub out_second: Output<Bit>,
    /// Read a triangle (a, b, c) as (a, c, b).
    pub out_swap: Output<Bit>,
    /// The last beat of its base triangle.
    pub out_last: Output<Bit>,
    /// Left end of the rung below.
    pub out_left: Output<Lanes<L, V>>,
    /// Right end of the rung below.
    pub out_right: Output<Lanes<L, V>>,
    /// Left end of the rung above.
    pub out_next_left: Output<Lanes<L, V>>,
    /// Right end of the rung above.
    pub out_next_right: Output<Lanes<L, V>>,
    /// Sticky: a recall of nothing, or a store into a full memory.
    pub error: Output<Bit>,
    // s1_decide: what the beat does, from commands and flags alone, and its vertices.
    swap: Register<Bit>,
    /// Which registers hold the same vertex, once the beats so far are carried out. All do after reset.
    left_is_right: Register<Bit>,
    left_is_edge: Register<Bit>,
    right_is_edge: Register<Bit>,
    start_is_edge: Register<Bit>,
    /// The right vertex is the one that went into the column memory last.
    right_stored: Register<Bit>,
    s1_valid: Register<Bit>,
    s1_sends: Register<Bit>,
    s1_fails: Register<Bit>,
    s1_first: DataRegister<Bit>,
    s1_second: DataRegister<Bit>,
    s1_last: DataRegister<Bit>,
    s1_left_moves: Register<Bit>,
    s1_right_moves: Register<Bit>,
    s1_start_moves: Register<Bit>,
    s1_edge_moves: Register<Bit>,
    /// L' is the oldest of the column memory, `start` or `edge`; otherwise the vertex of the beat.
    s1_recalls: Register<Bit>,
    s1_from_start: DataRegister<Bit>,
    s1_from_edge: DataRegister<Bit>,
    /// R' is L.
    s1_fans: DataRegister<Bit>,
    s1_left_vertex: DataRegister<Lanes<L, V>>,
    s1_right_vertex: DataRegister<Lanes<L, V>>,
    // s2_move: the vertices, and with them the triangles. L' and R' of a beat are L and R of the next.
    left: Register<Lanes<L, V>>,
    right: Register<Lanes<L, V>>,
    start: Register<Lanes<L, V>>,
    edge_held: Register<Lanes<L, V>>,
    sent_left: DataRegister<Lanes<L, V>>,
    sent_right: DataRegister<Lanes<L, V>>,
    sent_valid: Register<Bit>,
    sent_first: DataRegister<Bit>,
    sent_second: DataRegister<Bit>,
    sent_swap: DataRegister<Bit>,
    sent_last: DataRegister<Bit>,
    failed: Register<Bit>,
    column: ColumnMemory<L, V, K>,
    is_step: Wire<Bit>,
    recalls: Wire<Bit>,
    stores: Wire<Bit>,
    out_free: Wire<Bit>,
    moves: Wire<Bit>,
    go: Wire<Bit>,
    beat: Wire<Bit>,
    left_moves: Wire<Bit>,
    right_moves: Wire<Bit>,
    next_is_right: Wire<Bit>,
    next_is_left: Wire<Bit>,
    next_left: Wire<Lanes<L, V>>,
    first: Wire<Bit>,
    second: Wire<Bit>,
}

impl<const L: usize, const V: usize, const K: usize> StripUnit<L, V, K> {
    /// Cycles from a beat to its triangles.
    pub const LATENCY: usize = 2;
    /// A strip unit whose column memory holds `depth` vertices, `1 <= depth < 2^K`.
    pub fn new(depth: usize) -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_left: Input::default(),
            in_right: Input::default(),
            in_swap: Input::default(),
            in_last: Input::default(),
            in_left_vertex: Input::default(),
            in_right_vertex: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_first: Output::default(),
            out_second: Output::default(),
            out_swap: Output::default(),
            out_last: Output::default(),
            out_left: Output::default(),
            out_right: Output::default(),
            out_next_left: Output::default(),
            out_next_right: Output::default(),
            error: Output::default(),
            swap: Register::default(),
            left_is_right: Register::new(true),
            left_is_edge: Register::new(true),
            right_is_edge: Register::new(true),
            start_is_edge: Register::new(true),
            right_stored: Register::default(),
            s1_valid: Register::default(),
            s1_sends: Register::default(),
            s1_fails: Register::default(),
            s1_first: DataRegister::default(),
            s1_second: DataRegister::default(),
            s1_last: DataRegister::default(),
            s1_left_moves: Register::default(),
            s1_right_moves: Register::default(),
            s1_start_moves: Register::default(),
            s1_edge_moves: Register::default(),
            s1_recalls: Register::default(),
            s1_from_start: DataRegister::default(),
            s1_from_edge: DataRegister::default(),
            s1_fans: DataRegister::default(),
            s1_left_vertex: DataRegister::default(),
            s1_right_vertex: DataRegister::default(),
            left: Register::default(),
            right: Register::default(),
            start: Register::default(),
            edge_held: Register::default(),
            sent_left: DataRegister::default(),
            sent_right: DataRegister::default(),
            sent_valid: Register::default(),
            sent_first: DataRegister::default(),
            sent_second: DataRegister::default(),
            sent_swap: DataRegister::default(),
            sent_last: DataRegister::default(),
            failed: Register::default(),
            column: ColumnMemory::new(depth),
            is_step: Wire::default(),
            recalls: Wire::default(),
            stores: Wire::default(),
            out_free: Wire::default(),
            moves: Wire::default(),
            go: Wire::default(),
            beat: Wire::default(),
            left_moves: Wire::default(),
            right_moves: Wire::default(),
            next_is_right: Wire::default(),
            next_is_left: Wire::default(),
            next_left: Wire::default(),
            first: Wire::default(),
            second: Wire::default(),
        }
    }
}

impl<const L: usize, const V: usize, const K: usize> Logic for StripUnit<L, V, K> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            swap,
            left_is_right,
            left_is_edge,
            right_is_edge,
            start_is_edge,
            right_stored,
            s1_valid
        );
        dff_setup!(self, clock, s1_sends, s1_fails, s1_first, s1_second, s1_last, s1_left_moves, s1_right_moves);
        dff_setup!(self, clock, s1_start_moves, s1_edge_moves, s1_recalls, s1_from_start, s1_from_edge, s1_fans);
        dff_setup!(self, clock, s1_left_vertex, s1_right_vertex, left, right, start, edge_held, sent_left, sent_right);
        dff_setup!(self, clock, sent_valid, sent_first, sent_second, sent_swap, sent_last, failed);
        clock!(self, clock, column);
        self.out_valid.next = self.sent_valid.q.val();
        self.out_first.next = self.sent_first.q.val();
        self.out_second.next = self.sent_second.q.val();
        self.out_swap.next = self.sent_swap.q.val();
        self.out_last.next = self.sent_last.q.val();
        self.out_left.next = self.sent_left.q.val();
        self.out_right.next = self.sent_right.q.val();
        self.out_next_left.next = self.left.q.val();
        self.out_next_right.next = self.right.q.val();
        self.error.next = self.failed.q.val();

        // A beat moves on when the one before has left, and the vertex that it recalls has come.
        self.out_free.next = !self.sent_valid.q.val() || self.out_ready.val();
        self.moves.next = self.out_free.val() && (!self.s1_recalls.q.val() || self.column.head_valid.val());
        self.go.next = !self.s1_valid.q.val() || self.moves.val();
        self.in_ready.next = self.go.val();
        self.beat.next = self.go.val() && self.in_valid.val();

        // s1_decide. Kinds: 0 step, 1 start, 2 init, 3 fan. Left: 0 ref, 1 set, 2 recall, 3 edge. Right: 2 store, 3 edge.
        self.is_step.next = self.in_kind.val() == 0;
        self.recalls.next = self.is_step.val() && self.in_left.val() == 2 && !self.column.empty.val();
        self.stores.next = self.is_step.val() && self.in_right.val() == 2 && !self.column.full.val();
        self.column.clear.next = self.beat.val() && self.in_kind.val() == 1;
        self.column.push.next = self.beat.val() && self.stores.val();
        self.column.push_data.next = self.in_right_vertex.val();
        self.column.pop.next = self.beat.val() && self.recalls.val();

        self.left_moves.next =
            self.is_step.val() && (self.in_left.val() == 1 || self.in_left.val() == 3 || self.recalls.val());
        self.right_moves.next = self.is_step.val() && self.in_right.val() != 0;
        // Is L' the vertex R, or L?
        self.next_is_right.next = false;
        self.next_is_left.next = false;
        if !self.left_moves.val() {
            self.next_is_right.next = self.left_is_right.q.val();
            self.next_is_left.next = true;
        } else if self.in_left.val() == 3 {
            self.next_is_right.next = self.right_is_edge.q.val();
            self.next_is_left.next = self.left_is_edge.q.val();
        } else if self.recalls.val() {
            // What was stored last is the oldest one only if it is the only one.
            self.next_is_right.next = self.right_stored.q.val() && self.column.single.val();
        }
        self.first.next = self.left_moves.val()
            && !self.left_is_right.q.val()
            && !self.next_is_right.val()
            && !self.next_is_left.val();
        self.second.next = self.right_moves.val() && !self.next_is_right.val();

        if self.go.val() {
            self.s1_valid.d.next = self.in_valid.val();
            self.s1_sends.d.next = self.in_valid.val() && (self.first.val() || self.second.val() || self.in_last.val());
            self.s1_fails.d.next = self.in_valid.val()
                && self.is_step.val()
                && ((self.in_left.val() == 2 && !self.recalls.val())
                    || (self.in_right.val() == 2 && !self.stores.val()));
            self.s1_first.d.next = self.first.val();
            self.s1_second.d.next = self.second.val();
            self.s1_last.d.next = self.in_last.val();
            self.s1_left_moves.d.next = self.in_valid.val() && (!self.is_step.val() || self.left_moves.val());
            self.s1_right_moves.d.next = self.in_valid.val() && (!self.is_step.val() || self.right_moves.val());
            self.s1_start_moves.d.next = self.in_valid.val() && (self.in_kind.val() == 1 || self.in_kind.val() == 2);
            self.s1_edge_moves.d.next = self.in_valid.val() && self.is_step.val() && self.in_right.val() == 3;
            self.s1_recalls.d.next = self.in_valid.val() && self.recalls.val();
            self.s1_from_start.d.next = self.in_kind.val() == 2;
            self.s1_from_edge.d.next = (self.is_step.val() || self.in_kind.val() == 3) && self.in_left.val() == 3;
            self.s1_fans.d.next = self.in_kind.val() == 3;
            self.s1_left_vertex.d.next = self.in_left_vertex.val();
            self.s1_right_vertex.d.next = self.in_right_vertex.val();
        }
        if self.beat.val() {
            self.right_stored.d.next = self.stores.val();
            self.left_is_right.d.next = false;
            self.left_is_edge.d.next = false;
            self.right_is_edge.d.next = false;
            if self.is_step.val() {
                self.left_is_edge.d.next =
                    self.in_left.val() == 3 || (!self.left_moves.val() && self.left_is_edge.q.val());
                if self.in_right.val() == 0 {
                    self.left_is_right.d.next = self.next_is_right.val();
                    self.right_is_edge.d.next = self.right_is_edge.q.val();
                    self.right_stored.d.next = self.right_stored.q.val();
                } else if self.in_right.val() == 3 {
                    self.left_is_edge.d.next = false;
                    self.right_is_edge.d.next = true;
                    self.start_is_edge.d.next = false;
                }
            } else if self.in_kind.val() == 3 {
                self.left_is_edge.d.next = self.in_left.val() == 3;
                self.right_is_edge.d.next = self.left_is_edge.q.val();
                self.left_is_right.d.next = self.in_left.val() == 3 && self.left_is_edge.q.val();
            } else {
                self.start_is_edge.d.next = false;
                if self.in_kind.val() == 1 {
                    self.swap.d.next = self.in_swap.val();
                } else {
                    self.left_is_edge.d.next = self.start_is_edge.q.val();
                }
            }
        }

        // s2_move
        self.next_left.next = self.s1_left_vertex.q.val();
        if self.s1_recalls.q.val() {
            self.next_left.next = self.column.head.val();
        } else if self.s1_from_edge.q.val() {
            self.next_left.next = self.edge_held.q.val();
        } else if self.s1_from_start.q.val() {
            self.next_left.next = self.start.q.val();
        }
        self.column.take.next = self.out_free.val() && self.s1_recalls.q.val();
        if self.moves.val() {
            self.sent_valid.d.next = self.s1_sends.q.val();
            self.sent_first.d.next = self.s1_first.q.val();
            self.sent_second.d.next = self.s1_second.q.val();
            self.sent_swap.d.next = self.swap.q.val();
            self.sent_last.d.next = self.s1_last.q.val();
            self.sent_left.d.next = self.left.q.val();
            self.sent_right.d.next = self.right.q.val();
            if self.s1_fails.q.val() {
                self.failed.d.next = true;
            }
        } else if self.out_ready.val() {
            self.sent_valid.d.next = false;
        }
        if self.moves.val() && self.s1_left_moves.q.val() {
            self.left.d.next = self.next_left.val();
        }
        if self.moves.val() && self.s1_right_moves.q.val() {
            self.right.d.next = self.s1_right_vertex.q.val();
            if self.s1_fans.q.val() {
                self.right.d.next = self.left.q.val();
            }
        }
        if self.moves.val() && self.s1_start_moves.q.val() {
            self.start.d.next = self.s1_right_vertex.q.val();
        }
        if self.moves.val() && self.s1_edge_moves.q.val() {
            self.edge_held.d.next = self.s1_right_vertex.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("strip_unit")
    }
}

ports! {
    [const L: usize, const V: usize, const K: usize] StripUnit<L, V, K> {
        inputs: in_valid, in_kind, in_left, in_right, in_swap, in_last, in_left_vertex, in_right_vertex, out_ready;
        outputs: in_ready, out_valid, out_first, out_second, out_swap, out_last, out_left, out_right, out_next_left,
            out_next_right, error;
        blocks: column;
        state: swap, left_is_right, left_is_edge, right_is_edge, start_is_edge, right_stored, s1_valid, s1_sends, s1_fails, s1_first, s1_second, s1_last, s1_left_moves, s1_right_moves, s1_start_moves, s1_edge_moves, s1_recalls, s1_from_start, s1_from_edge, s1_fans, s1_left_vertex, s1_right_vertex, left, right, start, edge_held, sent_left, sent_right, sent_valid, sent_first, sent_second, sent_swap, sent_last, failed, column
    }
}
