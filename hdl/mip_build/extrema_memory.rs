// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nodes in a block RAM: under construction, a maximum and a minimum each, one more value taken in a cycle; once they are
//! complete, read one after the other.
//!
//! | port          | format     |   Interval 1
//! | op, fresh     | Bit        | takes `max` and `min` into the node at `address`, or makes them the node
//! | busy          | Bit        | the first read would overtake an op   Golden: models::mip_build   Error 0
//! | rewind        | Bit        | the next node to be read is node 0
//! | read          | Bit        | reads the next node; not together with `op`, nor while `busy` or in the cycle behind
//! | word, word_valid | 32 bits, Bit | four cycles later: maximum * 2^16 + minimum
//!
//! The block RAMs lie far apart, so nothing holds them, and what goes to all of them comes from registers.
//!
//! | stage      | what becomes of an op
//! | s1_address | the node is addressed; are the ops in s5 and s6 of the same one?
//! | s2_read    | the block RAM answers; are the ops in s3 to s5?
//! | s3_word    | its word comes, from whichever block RAM
//! | s4_choose  | or what the ops two to five before have made of the node, the last one first
//! | s5_compare | the extrema are compared with that, or with what the op before has made of it
//! | s6_write   | the node is written, by the register within the RAM; s7_written keeps it for another cycle

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
    pub busy: Output<Bit>,
    pub rewind: Input<Bit>,
    pub read: Input<Bit>,
    pub word: Output<U<32>>,
    pub word_valid: Output<Bit>,
    ram: RegisteredRam<U<32>, A, true>,
    /// The node to be read, and the reads that are addressed, answered, in the register of the RAM, and here.
    read_at: DataRegister<U<A>>,
    s1_read: Register<Bit>,
    s2_read: Register<Bit>,
    s3_read: Register<Bit>,
    s4_read: Register<Bit>,
    s1_op: Register<Bit>,
    s1_fresh: DataRegister<Bit>,
    s1_address: DataRegister<U<A>>,
    s1_max: DataRegister<U<16>>,
    s1_min: DataRegister<U<16>>,
    s2_op: Register<Bit>,
    s2_fresh: DataRegister<Bit>,
    s2_address: DataRegister<U<A>>,
    s2_max: DataRegister<U<16>>,
    s2_min: DataRegister<U<16>>,
    /// The fourth op before is of the same node, or the fifth.
    s2_fourth: DataRegister<Bit>,
    s2_fifth: DataRegister<Bit>,
    s3_op: Register<Bit>,
    s3_fresh: DataRegister<Bit>,
    s3_address: DataRegister<U<A>>,
    s3_max: DataRegister<U<16>>,
    s3_min: DataRegister<U<16>>,
    /// The op before is of the same node; the one before that; the third; or the fourth or fifth, whose word is kept.
    s3_follows: DataRegister<Bit>,
    s3_second: DataRegister<Bit>,
    s3_third: DataRegister<Bit>,
    s3_repeats: DataRegister<Bit>,
    s3_kept: DataRegister<U<32>>,
    s4_op: Register<Bit>,
    s4_fresh: DataRegister<Bit>,
    s4_address: DataRegister<U<A>>,
    s4_max: DataRegister<U<16>>,
    s4_min: DataRegister<U<16>>,
    s4_follows: DataRegister<Bit>,
    s4_second: DataRegister<Bit>,
    s4_repeats: DataRegister<Bit>,
    s4_kept: DataRegister<U<32>>,
    s4_word: DataRegister<U<32>>,
    s5_op: Register<Bit>,
    s5_fresh: DataRegister<Bit>,
    s5_address: DataRegister<U<A>>,
    s5_max: DataRegister<U<16>>,
    s5_min: DataRegister<U<16>>,
    s5_follows: DataRegister<Bit>,
    s5_word: DataRegister<U<32>>,
    s6_op: Register<Bit>,
    s6_address: DataRegister<U<A>>,
    s6_word: DataRegister<U<32>>,
    s7_word: DataRegister<U<32>>,
    word_behind: Wire<U<32>>,
    new_word: Wire<U<32>>,
    old: Wire<U<32>>,
    old_max: Wire<U<16>>,
    old_min: Wire<U<16>>,
    new_max: Wire<U<16>>,
    new_min: Wire<U<16>>,
}

impl<const A: usize> Logic for ExtremaMemory<A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, ram);
        dff_setup!(self, clock, read_at, s1_read, s2_read, s3_read, s4_read, s1_op, s1_fresh, s1_address, s1_max);
        dff_setup!(self, clock, s1_min, s2_op, s2_fresh, s2_address, s2_max, s2_min, s3_op, s3_fresh, s3_address);
        dff_setup!(self, clock, s3_max, s3_min, s3_follows, s3_second, s3_third, s3_repeats, s3_kept, s4_op, s4_fresh);
        dff_setup!(self, clock, s4_address, s4_max, s4_min, s4_follows, s4_second, s4_repeats, s4_kept, s4_word);
        dff_setup!(self, clock, s5_op, s5_fresh, s5_address, s5_max, s5_min, s5_follows, s5_word, s6_op, s6_address);
        dff_setup!(self, clock, s6_word, s7_word, s2_fourth, s2_fifth);
        // An op in s5 is written before the first read gets there.
        self.busy.next = self.s1_op.q.val() || self.s2_op.q.val() || self.s3_op.q.val() || self.s4_op.q.val();
        self.ram.enable.next = true;
        self.ram.output_enable.next = true;
        self.word.next = self.s4_word.q.val();
        self.word_valid.next = self.s4_read.q.val();
        self.s1_read.d.next = self.read.val();
        self.s2_read.d.next = self.s1_read.q.val();
        self.s3_read.d.next = self.s2_read.q.val();
        self.s4_read.d.next = self.s3_read.q.val();
        if self.read.val() {
            self.read_at.d.next = self.read_at.q.val() + 1;
        }
        if self.rewind.val() {
            self.read_at.d.next = 0.into();
        }

        // s1_address, s2_read
        self.s1_op.d.next = self.op.val();
        self.s1_fresh.d.next = self.fresh.val();
        self.s1_address.d.next = self.address.val();
        if self.read.val() {
            self.s1_address.d.next = self.read_at.q.val();
        }
        self.ram.read_address.next = self.s1_address.q.val();
        self.s1_max.d.next = self.max.val();
        self.s1_min.d.next = self.min.val();
        self.s2_op.d.next = self.s1_op.q.val();
        self.s2_fresh.d.next = self.s1_fresh.q.val();
        self.s2_address.d.next = self.s1_address.q.val();
        self.s2_max.d.next = self.s1_max.q.val();
        self.s2_min.d.next = self.s1_min.q.val();
        self.s2_fourth.d.next = self.s5_op.q.val() && self.s5_address.q.val() == self.s1_address.q.val();
        self.s2_fifth.d.next = self.s6_op.q.val() && self.s6_address.q.val() == self.s1_address.q.val();
        // s3_word
        self.s3_op.d.next = self.s2_op.q.val();
        self.s3_fresh.d.next = self.s2_fresh.q.val();
        self.s3_address.d.next = self.s2_address.q.val();
        self.s3_max.d.next = self.s2_max.q.val();
        self.s3_min.d.next = self.s2_min.q.val();
        self.s3_follows.d.next = self.s3_op.q.val() && self.s3_address.q.val() == self.s2_address.q.val();
        self.s3_second.d.next = self.s4_op.q.val() && self.s4_address.q.val() == self.s2_address.q.val();
        self.s3_third.d.next = self.s5_op.q.val() && self.s5_address.q.val() == self.s2_address.q.val();
        self.s3_repeats.d.next = self.s2_fourth.q.val() || self.s2_fifth.q.val();
        self.s3_kept.d.next = self.s7_word.q.val();
        if self.s2_fourth.q.val() {
            self.s3_kept.d.next = self.s6_word.q.val();
        }
        // s4_choose
        self.s4_op.d.next = self.s3_op.q.val();
        self.s4_fresh.d.next = self.s3_fresh.q.val();
        self.s4_address.d.next = self.s3_address.q.val();
        self.s4_max.d.next = self.s3_max.q.val();
        self.s4_min.d.next = self.s3_min.q.val();
        self.s4_follows.d.next = self.s3_follows.q.val();
        self.s4_second.d.next = self.s3_second.q.val();
        self.s4_repeats.d.next = self.s3_third.q.val() || self.s3_repeats.q.val();
        self.s4_kept.d.next = self.s3_kept.q.val();
        if self.s3_third.q.val() {
            self.s4_kept.d.next = self.s6_word.q.val();
        }
        self.s4_word.d.next = self.ram.read_data.val();
        self.word_behind.next = self.s4_word.q.val();
        if self.s4_second.q.val() {
            self.word_behind.next = self.s6_word.q.val();
        } else if self.s4_repeats.q.val() {
            self.word_behind.next = self.s4_kept.q.val();
        }
        // s5_compare
        self.s5_op.d.next = self.s4_op.q.val();
        self.s5_fresh.d.next = self.s4_fresh.q.val();
        self.s5_address.d.next = self.s4_address.q.val();
        self.s5_max.d.next = self.s4_max.q.val();
        self.s5_min.d.next = self.s4_min.q.val();
        self.s5_follows.d.next = self.s4_follows.q.val();
        self.s5_word.d.next = self.word_behind.val();
        self.old.next = self.s5_word.q.val();
        if self.s5_follows.q.val() {
            self.old.next = self.s6_word.q.val();
        }
        self.old_max.next = self.old.val().get_bits::<16>(16);
        self.old_min.next = self.old.val().get_bits::<16>(0);
        self.new_max.next = self.s5_max.q.val();
        self.new_min.next = self.s5_min.q.val();
        if !self.s5_fresh.q.val() {
            if self.old_max.val() > self.s5_max.q.val() {
                self.new_max.next = self.old_max.val();
            }
            if self.old_min.val() < self.s5_min.q.val() {
                self.new_min.next = self.old_min.val();
            }
        }
        // s6_write, s7_written
        self.s6_op.d.next = self.s5_op.q.val();
        self.s6_address.d.next = self.s5_address.q.val();
        self.new_word.next =
            (bit_cast_to::<U<32>>(self.new_max.val()) << 16) | bit_cast_to::<U<32>>(self.new_min.val());
        self.s6_word.d.next = self.new_word.val();
        self.ram.write_enable.next = self.s5_op.q.val();
        self.ram.write_address.next = self.s5_address.q.val();
        self.ram.write_data.next = self.new_word.val();
        self.s7_word.d.next = self.s6_word.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("extrema_memory_{A}"))
    }
}

latches! { [const A: usize] ExtremaMemory<A>: ram, read_at, s1_read, s2_read, s3_read, s4_read, s1_op, s1_fresh, s1_address, s1_max, s1_min, s2_op, s2_fresh, s2_address, s2_max, s2_min, s3_op, s3_fresh, s3_address, s3_max, s3_min, s3_follows, s3_second, s3_third, s3_repeats, s3_kept, s4_op, s4_fresh, s4_address, s4_max, s4_min, s4_follows, s4_second, s4_repeats, s4_kept, s4_word, s5_op, s5_fresh, s5_address, s5_max, s5_min, s5_follows, s5_word, s6_op, s6_address, s6_word, s7_word, s2_fourth, s2_fifth }
