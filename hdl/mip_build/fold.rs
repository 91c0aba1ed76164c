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
    // s1_texel: the texel, and what it does.
    s1_valid: Register<Bit>,
    s1_max: DataRegister<U<16>>,
    s1_min: DataRegister<U<16>>,
    s1_half: DataRegister<U<A>>,
    s1_odd_column: DataRegister<Bit>,
    s1_last_column: DataRegister<Bit>,
    s1_odd_row: DataRegister<Bit>,
    s1_first_row: DataRegister<Bit>,
    s1_last_row: DataRegister<Bit>,
    /// It belongs to the node of the texel before it, too; it finishes a node.
    s1_joins: DataRegister<Bit>,
    s1_emits: DataRegister<Bit>,
    // s2_node
    /// The texels of the row that belong to the next node.
    open_max: DataRegister<U<16>>,
    open_min: DataRegister<U<16>>,
    /// First word of the row of nodes that the row of texels belongs to.
    row: Register<U<A>>,
    // A finished node, and behind the last one of an even row the tail: the node that the last texel belongs to, too.
    pending: Register<Bit>,
    step: Register<U<2>>,
    /// The pending node, or its tail, takes another cycle behind this one.
    blocked: Register<Bit>,
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
    goes: Wire<Bit>,
    take: Wire<Bit>,
    joined_max: Wire<U<16>>,
    joined_min: Wire<U<16>>,
    row_behind: Wire<U<A>>,
    pending_behind: Wire<Bit>,
    step_behind: Wire<U<2>>,
    far_behind: Wire<Bit>,
    tail_behind: Wire<Bit>,
    ends_behind: Wire<Bit>,
    op_row: Wire<U<A>>,
    op_column: Wire<U<A>>,
}

impl<const M: usize, const A: usize> Logic for MipFold<M, A> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, open_max, open_min, row, pending, step, node_max, node_min, tail_max, tail_min);
        dff_setup!(self, clock, node_column, tail_column, near_row, far_row, near_fresh, far_fresh, tail_turns);
        dff_setup!(self, clock, has_far, has_tail, blocked, s1_valid, s1_max, s1_min, s1_half, s1_odd_column);
        dff_setup!(self, clock, s1_last_column, s1_odd_row, s1_first_row, s1_last_row, s1_joins, s1_emits);
        // s1_texel
        self.goes.next = !(self.s1_emits.q.val() && self.blocked.q.val());
        self.take.next = self.s1_valid.q.val() && self.goes.val();
        self.ready.next = !self.s1_valid.q.val() || self.goes.val();
        self.idle.next = !self.s1_valid.q.val() && !self.pending.q.val();
        self.odd_column.next = self.column.val().get_bit(0);
        if !self.s1_valid.q.val() || self.goes.val() {
            self.s1_valid.d.next = self.valid.val();
            self.s1_max.d.next = self.max.val();
            self.s1_min.d.next = self.min.val();
            self.s1_half.d.next = bit_cast_to::<U<A>>(self.column.val() >> 1);
            self.s1_odd_column.d.next = self.odd_column.val();
            self.s1_last_column.d.next = self.last_column.val();
            self.s1_odd_row.d.next = self.odd_row.val();
            self.s1_first_row.d.next = self.first_row.val();
            self.s1_last_row.d.next = self.last_row.val();
            self.s1_joins.d.next = !self.first_column.val() && (self.odd_column.val() || !self.cells.val());
            self.s1_emits.d.next = self.odd_column.val() || self.last_column.val();
        }

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

        // s2_node
        self.joined_max.next = self.s1_max.q.val();
        self.joined_min.next = self.s1_min.q.val();
        if self.s1_joins.q.val() {
            if self.open_max.q.val() > self.s1_max.q.val() {
                self.joined_max.next = self.open_max.q.val();
            }
            if self.open_min.q.val() < self.s1_min.q.val() {
                self.joined_min.next = self.open_min.q.val();
            }
        }
        self.row_behind.next = self.row.q.val() + bit_cast_to::<U<A>>(self.width_above.val());

        // Steps: 0 node, 1 node in the far row, 2 tail, 3 tail in the far row.
        self.pending_behind.next = self.blocked.q.val();
        self.step_behind.next = 0.into();
        if self.blocked.q.val() {
            self.step_behind.next = self.step.q.val() + 1;
            if self.step.q.val() == 0 && !self.has_far.q.val() {
                self.step_behind.next = 2.into();
            }
        }
        self.far_behind.next = self.has_far.q.val();
        self.tail_behind.next = self.has_tail.q.val();
        if self.take.val() {
            self.open_max.d.next = self.joined_max.val();
            self.open_min.d.next = self.joined_min.val();
            if self.s1_odd_column.q.val() && !self.cells.val() {
                self.open_max.d.next = self.s1_max.q.val();
                self.open_min.d.next = self.s1_min.q.val();
            }
            if self.s1_emits.q.val() {
                self.pending_behind.next = true;
                self.step_behind.next = 0.into();
                self.far_behind.next = self.s1_odd_row.q.val() && !self.cells.val();
                self.tail_behind.next = self.s1_last_column.q.val() && self.s1_odd_column.q.val() && !self.cells.val();
                self.node_max.d.next = self.joined_max.val();
                self.node_min.d.next = self.joined_min.val();
                self.tail_max.d.next = self.s1_max.q.val();
                self.tail_min.d.next = self.s1_min.q.val();
                self.node_column.d.next = self.s1_half.q.val();
                self.tail_column.d.next = self.s1_half.q.val() + 1;
                if self.repeat_u.val() {
                    self.tail_column.d.next = 0.into();
                }
                self.tail_turns.d.next = self.repeat_u.val();
                self.near_row.d.next = self.row.q.val();
                self.near_fresh.d.next = self.s1_first_row.q.val() || (self.cells.val() && !self.s1_odd_row.q.val());
                self.far_row.d.next = self.row_behind.val();
                self.far_fresh.d.next = true;
                if self.s1_last_row.q.val() && self.repeat_v.val() {
                    self.far_row.d.next = 0.into();
                    self.far_fresh.d.next = false;
                }
            }
            if self.s1_last_column.q.val() && self.s1_odd_row.q.val() {
                self.row.d.next = self.row_behind.val();
            }
        }
        self.ends_behind.next = (self.step_behind.val() == 0 && !self.far_behind.val() && !self.tail_behind.val())
            || (self.step_behind.val() == 1 && !self.tail_behind.val())
            || (self.step_behind.val() == 2 && !self.far_behind.val())
            || self.step_behind.val() == 3;
        self.pending.d.next = self.pending_behind.val();
        self.step.d.next = self.step_behind.val();
        self.has_far.d.next = self.far_behind.val();
        self.has_tail.d.next = self.tail_behind.val();
        self.blocked.d.next = self.pending_behind.val() && !self.ends_behind.val();
        if self.clear.val() {
            self.row.d.next = 0.into();
            self.s1_valid.d.next = false;
            self.pending.d.next = false;
            self.step.d.next = 0.into();
            self.blocked.d.next = false;
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_fold")
    }
}

latches! { [const M: usize, const A: usize] MipFold<M, A>: s1_valid, s1_max, s1_min, s1_half, s1_odd_column, s1_last_column, s1_odd_row, s1_first_row, s1_last_row, s1_joins, s1_emits, open_max, open_min, row, pending, step, blocked, node_max, node_min, tail_max, tail_min, node_column, tail_column, near_row, far_row, near_fresh, far_fresh, tail_turns, has_far, has_tail }
