// SPDX-License-Identifier: MIT OR Apache-2.0
//! Commands of the step port: set, recall, store or edge for every vertex moved, and the output rounding.
//!
//! out = floor(acc / 2^g + 1/2)   (mod 2^V)
//!
//! A left interior vertex is recalled when the column memory of the strip unit holds it, and an upper-edge vertex is
//! taken from the edge register when the strip before ended on it: each vertex is sent, and so displaced, once.
//! The column memory is a queue, so two counters and a flag mirror it: a column is stored up to its first vertex that
//! finds the memory full.
//!
//! | port  | format       |   Latency 1, interval 1
//! | in_*  | stream       | of the walkers: W-bit vertices with g fraction bits |
//! | out_* | stream       | the step port   Golden: models::remesher   Error: 1/2 unit of the vertex format
//!
//! Example, g = 13: acc = 0x3000 -> 2, acc = 0x0fff -> 0, acc = -0x1000 -> 0.

use crate::prelude::*;

/// The commands stage for a column memory of 2^K vertices at most.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Commands<const L: usize, const V: usize, const W: usize, const K: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_left: Input<U<2>>,
    pub in_right: Input<U<2>>,
    pub in_keep: Input<Bit>,
    pub in_swap: Input<Bit>,
    pub in_last: Input<Bit>,
    pub in_left_vertex: Input<Lanes<L, W>>,
    pub in_right_vertex: Input<Lanes<L, W>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_kind: Output<U<2>>,
    pub out_left: Output<U<2>>,
    pub out_right: Output<U<2>>,
    pub out_swap: Output<Bit>,
    pub out_last: Output<Bit>,
    pub out_left_vertex: Output<Lanes<L, V>>,
    pub out_right_vertex: Output<Lanes<L, V>>,
    /// Stored vertices of the left and of the right column.
    left_stored: Register<U<K>>,
    right_stored: Register<U<K>>,
    /// The right column is stored without a gap so far.
    open: Register<Bit>,
    /// The edge register of the strip unit holds the next upper-edge vertex.
    edge_held: Register<Bit>,
    sent_valid: Register<Bit>,
    sent_kind: DataRegister<U<2>>,
    sent_left: DataRegister<U<2>>,
    sent_right: DataRegister<U<2>>,
    sent_swap: DataRegister<Bit>,
    sent_last: DataRegister<Bit>,
    sent_left_vertex: DataRegister<Lanes<L, V>>,
    sent_right_vertex: DataRegister<Lanes<L, V>>,
    go: Wire<Bit>,
    room: Wire<Bit>,
    recalls: Wire<Bit>,
    stores: Wire<Bit>,
    half: Constant<Lanes<L, W>>,
    guard: Constant<U<6>>,
    depth: Constant<U<K>>,
}

impl<const L: usize, const V: usize, const W: usize, const K: usize> Commands<L, V, W, K> {
    /// A stage that mirrors a column memory of `depth` vertices, `depth < 2^K`.
    pub fn new(depth: usize) -> Self {
        assert!(depth < 1 << K, "a column memory of {depth} vertices needs counters of more than {K} bits");
        let guard = W - V - 1;
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_left: Input::default(),
            in_right: Input::default(),
            in_keep: Input::default(),
            in_swap: Input::default(),
            in_last: Input::default(),
            in_left_vertex: Input::default(),
            in_right_vertex: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_kind: Output::default(),
            out_left: Output::default(),
            out_right: Output::default(),
            out_swap: Output::default(),
            out_last: Output::default(),
            out_left_vertex: Output::default(),
            out_right_vertex: Output::default(),
            left_stored: Register::default(),
            right_stored: Register::default(),
            open: Register::default(),
            edge_held: Register::default(),
            sent_valid: Register::default(),
            sent_kind: DataRegister::default(),
            sent_left: DataRegister::default(),
            sent_right: DataRegister::default(),
            sent_swap: DataRegister::default(),
            sent_last: DataRegister::default(),
            sent_left_vertex: DataRegister::default(),
            sent_right_vertex: DataRegister::default(),
            go: Wire::default(),
            room: Wire::default(),
            recalls: Wire::default(),
            stores: Wire::default(),
            half: Constant::new(Lanes::new([if guard == 0 { 0 } else { 1 << (guard - 1) }; L])),
            guard: Constant::new(U::new(guard as i64)),
            depth: Constant::new(U::new(depth as i64)),
        }
    }
}

impl<const L: usize, const V: usize, const W: usize, const K: usize> Logic for Commands<L, V, W, K> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left_stored, right_stored, open, edge_held, sent_valid, sent_kind, sent_left);
        dff_setup!(self, clock, sent_right, sent_swap, sent_last, sent_left_vertex, sent_right_vertex);
        self.out_valid.next = self.sent_valid.q.val();
        self.out_kind.next = self.sent_kind.q.val();
        self.out_left.next = self.sent_left.q.val();
        self.out_right.next = self.sent_right.q.val();
        self.out_swap.next = self.sent_swap.q.val();
        self.out_last.next = self.sent_last.q.val();
        self.out_left_vertex.next = self.sent_left_vertex.q.val();
        self.out_right_vertex.next = self.sent_right_vertex.q.val();
        self.go.next = !self.sent_valid.q.val() || self.out_ready.val();
        self.in_ready.next = self.go.val();

        self.room.next = self.open.q.val() && self.left_stored.q.val() + self.right_stored.q.val() < self.depth.val();
        self.recalls.next = self.in_kind.val() == 0 && self.in_left.val() == 1 && self.left_stored.q.val() != 0;
        self.stores.next = self.in_kind.val() == 0 && self.in_right.val() == 1 && self.in_keep.val() && self.room.val();
        if self.go.val() {
            self.sent_valid.d.next = self.in_valid.val();
        }
        if self.go.val() && self.in_valid.val() {
            self.sent_kind.d.next = self.in_kind.val();
            self.sent_swap.d.next = self.in_swap.val();
            self.sent_last.d.next = self.in_last.val();
            self.sent_left_vertex.d.next =
                bit_cast_to::<Lanes<L, V>>((self.in_left_vertex.val() + self.half.val()) >> self.guard.val());
            self.sent_right_vertex.d.next =
                bit_cast_to::<Lanes<L, V>>((self.in_right_vertex.val() + self.half.val()) >> self.guard.val());
            // Left: 0 ref, 1 set, 2 recall, 3 edge. Right: 0 ref, 1 set, 2 store, 3 edge.
            self.sent_left.d.next = 0.into();
            self.sent_right.d.next = 0.into();
            if self.in_kind.val() == 1 {
                self.sent_left.d.next = 1.into();
                self.sent_right.d.next = 1.into();
                self.left_stored.d.next = 0.into();
                self.right_stored.d.next = 0.into();
                self.open.d.next = true;
                self.edge_held.d.next = false;
            } else if self.in_kind.val() == 2 {
                self.sent_right.d.next = 1.into();
                self.left_stored.d.next = self.right_stored.q.val();
                self.right_stored.d.next = 0.into();
                self.open.d.next = true;
            } else {
                if self.in_left.val() == 2 {
                    self.sent_left.d.next = 1.into();
                    if self.edge_held.q.val() {
                        self.sent_left.d.next = 3.into();
                    }
                    self.edge_held.d.next = false;
                } else if self.recalls.val() {
                    self.sent_left.d.next = 2.into();
                    self.left_stored.d.next = self.left_stored.q.val() - 1;
                } else if self.in_left.val() == 1 {
                    self.sent_left.d.next = 1.into();
                }
                if self.in_right.val() == 3 {
                    self.sent_right.d.next = 3.into();
                    self.edge_held.d.next = true;
                } else if self.stores.val() {
                    self.sent_right.d.next = 2.into();
                    self.right_stored.d.next = self.right_stored.q.val() + 1;
                } else if self.in_right.val() != 0 {
                    self.sent_right.d.next = 1.into();
                    if self.in_right.val() == 1 {
                        self.open.d.next = false;
                    }
                }
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("commands")
    }
}

watched! { [const L: usize, const V: usize, const W: usize, const K: usize] Commands<L, V, W, K>: in_valid, in_kind, in_left, in_right, in_keep, in_swap, in_last, in_left_vertex, in_right_vertex, out_ready;; left_stored, right_stored, open, edge_held, sent_valid, sent_kind, sent_left, sent_right, sent_swap, sent_last, sent_left_vertex, sent_right_vertex }
