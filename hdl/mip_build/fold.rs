// SPDX-License-Identifier: MIT OR Apache-2.0
//! Folds the texels of a level, row by row, into the nodes above them.
//!
//! Texel x belongs to nodes floor(x / 2) and floor((x + 1) / 2) of its row, and row y to rows floor(y / 2) and
//! floor((y + 1) / 2) of nodes: that is the 3 x 3 neighbourhood, clamped by itself; modulo the number of nodes it
//! repeats. A cell takes the first of the two only. So a node is finished every other texel along the row, and goes into
//! one node of the memory above or into two.
//!
//! | port     | format      |   Interval 1; behind an odd row 1 cycle more, 2 if the row has an even number of texels
//! | valid, ready | stream  | of texels, each a maximum and a minimum, with the place in the map as flags
//! | clear    | Bit         | begins a level   Golden: models::mip_build   Error 0
//! | op_*     |             | one operation of the memory above; never refused | idle: nothing is pending

use crate::prelude::*;

/// Fold into a memory of 2^A nodes; sides below 2^M.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct MipFold<const M: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub clear: Input<Bit>,
    pub valid: Input<Bit>,
    pub ready: Output<Bit>,
    pub max: Input<U<16>>,
    pub min: Input<U<16>>,
    pub column: Input<U<M>>,
    pub first_column: Input<Bit>,
    pub last_column: Input<Bit>,
    pub odd_row: Input<Bit>,
    pub first_row: Input<Bit>,
    pub last_row: Input<Bit>,
    pub cells: Input<Bit>,
    pub repeat_u: Input<Bit>,
    pub repeat_v: Input<Bit>,
    /// Nodes in a row above.
    pub width_above: Input<U<M>>,
    pub idle: Output<Bit>,
    pub op: Output<Bit>,
    pub op_fresh: Output<Bit>,
    pub op_address: Output<U<A>>,
    pub op_max: Output<U<16>>,
    pub op_min: Output<U<16>>,
    /// The texels of the row that belong to the next node.
    open_max: DataRegister<U<16>>,
    open_min: DataRegister<U<16>>,
    /// First word of the row of nodes that the row of texels belongs to.
    row: Register<U<A>>,
    // A finished node, and behind the last one of an even row the tail: the node that the last texel belongs to, too.
    pending: Register<Bit>,
    step: Register<U<2>>,
    node_max: DataRegister<U<16>>,
    node_min: DataRegister<U<16>>,
    tail_max: DataRegister<U<16>>,
    tail_min: DataRegister<U<16>>,
    node_column: DataRegister<U<A>>,
    tail_column: DataRegister<U<A>>,
    near_row: DataRegister<U<A>>,
    far_row: DataRegister<U<A>>,
    near_fresh: DataRegister<Bit>,
    far_fresh: DataRegister<Bit>,
    tail_turns: DataRegister<Bit>,
    has_far: DataRegister<Bit>,
    has_tail: DataRegister<Bit>,
    odd_column: Wire<Bit>,
    emits: Wire<Bit>,
    ends: Wire<Bit>,
    goes: Wire<Bit>,
    take: Wire<Bit>,
    joined_max: Wire<U<16>>,
    joined_min: Wire<U<16>>,
    half: Wire<U<A>>,
    row_behind: Wire<U<A>>,
    op_row: Wire<U<A>>,
    op_column: Wire<U<A>>,
}

impl<const M: usize, const A: usize> Logic for MipFold<M, A> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, open_max, open_min, row, pending, step, node_max, node_min, tail_max, tail_min);
        dff_setup!(self, clock, node_column, tail_column, near_row, far_row, near_fresh, far_fresh, tail_turns);
        dff_setup!(self, clock, has_far, has_tail);
        self.odd_column.next = self.column.val().get_bit(0);
        self.emits.next = self.odd_column.val() || self.last_column.val();
        // Steps: 0 node, 1 node in the far row, 2 tail, 3 tail in the far row.
        self.ends.next = (self.step.q.val() == 0 && !self.has_far.q.val() && !self.has_tail.q.val())
            || (self.step.q.val() == 1 && !self.has_tail.q.val())
            || (self.step.q.val() == 2 && !self.has_far.q.val())
            || self.step.q.val() == 3;
        self.goes.next = !self.pending.q.val() || self.ends.val() || !self.emits.val();
        self.ready.next = self.goes.val();
        self.take.next = self.valid.val() && self.goes.val();
        self.idle.next = !self.pending.q.val();

        self.op.next = self.pending.q.val();
        self.op_max.next = self.node_max.q.val();
        self.op_min.next = self.node_min.q.val();
        self.op_column.next = self.node_column.q.val();
        self.op_row.next = self.near_row.q.val();
        self.op_fresh.next = self.near_fresh.q.val();
        if self.step.q.val().get_bit(0) {
            self.op_row.next = self.far_row.q.val();
            self.op_fresh.next = self.far_fresh.q.val();
        }
        if self.step.q.val().get_bit(1) {
            self.op_max.next = self.tail_max.q.val();
            self.op_min.next = self.tail_min.q.val();
            self.op_column.next = self.tail_column.q.val();
            // The first node of the row stands already.
            self.op_fresh.next = !self.tail_turns.q.val() && self.near_fresh.q.val();
            if self.step.q.val().get_bit(0) {
                self.op_fresh.next = !self.tail_turns.q.val() && self.far_fresh.q.val();
            }
        }
        self.op_address.next = self.op_row.val() + self.op_column.val();

        self.joined_max.next = self.max.val();
        self.joined_min.next = self.min.val();
        if !self.first_column.val() && (self.odd_column.val() || !self.cells.val()) {
            if self.open_max.q.val() > self.max.val() {
                self.joined_max.next = self.open_max.q.val();
            }
            if self.open_min.q.val() < self.min.val() {
                self.joined_min.next = self.open_min.q.val();
            }
        }
        self.half.next = bit_cast_to::<U<A>>(self.column.val() >> 1);
        self.row_behind.next = self.row.q.val() + bit_cast_to::<U<A>>(self.width_above.val());

        if self.pending.q.val() {
            self.step.d.next = self.step.q.val() + 1;
            if self.step.q.val() == 0 && !self.has_far.q.val() {
                self.step.d.next = 2.into();
            }
        }
        if self.pending.q.val() && self.ends.val() {
            self.pending.d.next = false;
            self.step.d.next = 0.into();
        }
        if self.take.val() {
            self.open_max.d.next = self.joined_max.val();
            self.open_min.d.next = self.joined_min.val();
            if self.odd_column.val() && !self.cells.val() {
                self.open_max.d.next = self.max.val();
                self.open_min.d.next = self.min.val();
            }
            if self.emits.val() {
                self.pending.d.next = true;
                self.step.d.next = 0.into();
                self.node_max.d.next = self.joined_max.val();
                self.node_min.d.next = self.joined_min.val();
                self.tail_max.d.next = self.max.val();
                self.tail_min.d.next = self.min.val();
                self.node_column.d.next = self.half.val();
                self.tail_column.d.next = self.half.val() + 1;
                if self.repeat_u.val() {
                    self.tail_column.d.next = 0.into();
                }
                self.tail_turns.d.next = self.repeat_u.val();
                self.near_row.d.next = self.row.q.val();
                self.near_fresh.d.next = self.first_row.val() || (self.cells.val() && !self.odd_row.val());
                self.far_row.d.next = self.row_behind.val();
                self.far_fresh.d.next = true;
                if self.last_row.val() && self.repeat_v.val() {
                    self.far_row.d.next = 0.into();
                    self.far_fresh.d.next = false;
                }
                self.has_far.d.next = self.odd_row.val() && !self.cells.val();
                self.has_tail.d.next = self.last_column.val() && self.odd_column.val() && !self.cells.val();
            }
            if self.last_column.val() && self.odd_row.val() {
                self.row.d.next = self.row_behind.val();
            }
        }
        if self.clear.val() {
            self.row.d.next = 0.into();
            self.pending.d.next = false;
            self.step.d.next = 0.into();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_fold")
    }
}

latches! { [const M: usize, const A: usize] MipFold<M, A>: open_max, open_min, row, pending, step, node_max, node_min, tail_max, tail_min, node_column, tail_column, near_row, far_row, near_fresh, far_fresh, tail_turns, has_far, has_tail }
