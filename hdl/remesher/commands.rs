// SPDX-License-Identifier: MIT OR Apache-2.0
//! Commands of the step port: set, recall, store or edge for every vertex moved.
//!
//! A left interior vertex is recalled when the column memory of the strip unit holds it, and an upper-edge vertex is
//! taken from the edge register when the strip before ended on it: each vertex is sent, and so displaced, once.
//! The column memory is a queue, so two counters and a flag mirror it: a column is stored up to its first vertex that
//! finds the memory full.
//!
//! | port  | format       |   Latency 1, interval 1; never stalls
//! | in_*  | -            | of the walkers |
//! | out_* | -            | commands of the step port   Golden: models::remesher   Error 0
//!
//! Example: an interior left vertex that is sent (1) becomes a recall (2) while vertices of its column are stored.

use crate::prelude::*;

/// The commands stage for a column memory of 2^K vertices at most.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Commands<const K: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_left: Input<U<2>>,
    pub in_right: Input<U<2>>,
    pub in_keep: Input<Bit>,
    pub in_swap: Input<Bit>,
    pub in_last: Input<Bit>,
    pub out_valid: Output<Bit>,
    pub out_kind: Output<U<2>>,
    pub out_left: Output<U<2>>,
    pub out_right: Output<U<2>>,
    pub out_swap: Output<Bit>,
    pub out_last: Output<Bit>,
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
    room: Wire<Bit>,
    recalls: Wire<Bit>,
    stores: Wire<Bit>,
    depth: Constant<U<K>>,
}

impl<const K: usize> Commands<K> {
    /// A stage that mirrors a column memory of `depth` vertices, `depth < 2^K`.
    pub fn new(depth: usize) -> Self {
        assert!(depth < 1 << K, "a column memory of {depth} vertices needs counters of more than {K} bits");
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_kind: Input::default(),
            in_left: Input::default(),
            in_right: Input::default(),
            in_keep: Input::default(),
            in_swap: Input::default(),
            in_last: Input::default(),
            out_valid: Output::default(),
            out_kind: Output::default(),
            out_left: Output::default(),
            out_right: Output::default(),
            out_swap: Output::default(),
            out_last: Output::default(),
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
            room: Wire::default(),
            recalls: Wire::default(),
            stores: Wire::default(),
            depth: Constant::new(U::new(depth as i64)),
        }
    }
}

impl<const K: usize> Logic for Commands<K> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left_stored, right_stored, open, edge_held, sent_valid, sent_kind, sent_left);
        dff_setup!(self, clock, sent_right, sent_swap, sent_last);
        self.out_valid.next = self.sent_valid.q.val();
        self.out_kind.next = self.sent_kind.q.val();
        self.out_left.next = self.sent_left.q.val();
        self.out_right.next = self.sent_right.q.val();
        self.out_swap.next = self.sent_swap.q.val();
        self.out_last.next = self.sent_last.q.val();

        self.room.next = self.open.q.val() && self.left_stored.q.val() + self.right_stored.q.val() < self.depth.val();
        self.recalls.next = self.in_kind.val() == 0 && self.in_left.val() == 1 && self.left_stored.q.val() != 0;
        self.stores.next = self.in_kind.val() == 0 && self.in_right.val() == 1 && self.in_keep.val() && self.room.val();
        self.sent_valid.d.next = self.in_valid.val();
        if self.in_valid.val() {
            self.sent_kind.d.next = self.in_kind.val();
            self.sent_swap.d.next = self.in_swap.val();
            self.sent_last.d.next = self.in_last.val();
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

watched! { [const K: usize] Commands<K>: in_valid, in_kind, in_left, in_right, in_keep, in_swap, in_last;; left_stored, right_stored, open, edge_held, sent_valid, sent_kind, sent_left, sent_right, sent_swap, sent_last }
