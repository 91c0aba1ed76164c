// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nodes under construction in a block RAM: a maximum and a minimum each, one more value taken in a cycle.
//!
//! | port          | format     |   Latency 1 of a read, interval 1
//! | op, fresh     | Bit        | takes `max` and `min` into the node at `address`, or makes them the node
//! | read          | Bit        | reads the node at `read_address`; not together with `op`
//! | read_word     | 32 bits    | maximum * 2^16 + minimum; holds until the next read or op
//! | busy          | Bit        | the last op is not yet written   Golden: models::mip_build   Error 0
//!
//! The word read for an op is one write old; where that write went to the same node, its word is taken instead.

use crate::prelude::*;

/// Memory of 2^A nodes.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct ExtremaMemory<const A: usize> {
    pub clock: Input<ClockReset>,
    pub op: Input<Bit>,
    pub fresh: Input<Bit>,
    pub address: Input<U<A>>,
    pub max: Input<U<16>>,
    pub min: Input<U<16>>,
    pub read: Input<Bit>,
    pub read_address: Input<U<A>>,
    pub read_word: Output<U<32>>,
    pub busy: Output<Bit>,
    ram: Ram<U<32>, A>,
    s1_op: Register<Bit>,
    s1_fresh: DataRegister<Bit>,
    s1_address: DataRegister<U<A>>,
    s1_max: DataRegister<U<16>>,
    s1_min: DataRegister<U<16>>,
    s2_op: Register<Bit>,
    s2_address: DataRegister<U<A>>,
    s2_word: DataRegister<U<32>>,
    old: Wire<U<32>>,
    old_max: Wire<U<16>>,
    old_min: Wire<U<16>>,
    new_max: Wire<U<16>>,
    new_min: Wire<U<16>>,
    word: Wire<U<32>>,
}

impl<const A: usize> Logic for ExtremaMemory<A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, ram);
        dff_setup!(self, clock, s1_op, s1_fresh, s1_address, s1_max, s1_min, s2_op, s2_address, s2_word);
        self.read_word.next = self.ram.read_data.val();
        self.busy.next = self.s1_op.q.val();
        // s1_read
        self.ram.enable.next = self.op.val() || self.read.val();
        self.ram.read_address.next = self.read_address.val();
        if self.op.val() {
            self.ram.read_address.next = self.address.val();
        }
        self.s1_op.d.next = self.op.val();
        if self.op.val() {
            self.s1_fresh.d.next = self.fresh.val();
            self.s1_address.d.next = self.address.val();
            self.s1_max.d.next = self.max.val();
            self.s1_min.d.next = self.min.val();
        }
        // s2_write
        self.old.next = self.ram.read_data.val();
        if self.s2_op.q.val() && self.s2_address.q.val() == self.s1_address.q.val() {
            self.old.next = self.s2_word.q.val();
        }
        self.old_max.next = self.old.val().get_bits::<16>(16);
        self.old_min.next = self.old.val().get_bits::<16>(0);
        self.new_max.next = self.s1_max.q.val();
        self.new_min.next = self.s1_min.q.val();
        if !self.s1_fresh.q.val() {
            if self.old_max.val() > self.s1_max.q.val() {
                self.new_max.next = self.old_max.val();
            }
            if self.old_min.val() < self.s1_min.q.val() {
                self.new_min.next = self.old_min.val();
            }
        }
        self.word.next = (bit_cast_to::<U<32>>(self.new_max.val()) << 16) | bit_cast_to::<U<32>>(self.new_min.val());
        self.ram.write_enable.next = self.s1_op.q.val();
        self.ram.write_address.next = self.s1_address.q.val();
        self.ram.write_data.next = self.word.val();
        self.s2_op.d.next = self.s1_op.q.val();
        if self.s1_op.q.val() {
            self.s2_address.d.next = self.s1_address.q.val();
            self.s2_word.d.next = self.word.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("extrema_memory_{A}"))
    }
}

latches! { [const A: usize] ExtremaMemory<A>: ram, s1_op, s1_fresh, s1_address, s1_max, s1_min, s2_op, s2_address, s2_word }
