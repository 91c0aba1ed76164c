// SPDX-License-Identifier: MIT OR Apache-2.0
//! Queue of what waits for a result that is on its way: one word in and one word out a cycle.
//!
//! | port  | format   |   Latency 2, interval 1; golden: none, it changes nothing
//! | push  | Bit      | takes `data`; who pushes counts the words, 2^A at most
//! | data  | L x signed W |
//! | valid | Bit      | `head` is the oldest word
//! | take  | Bit      | and goes; only with `valid`

use crate::prelude::*;

/// Queue of up to 2^A words of `L` x `W` bits.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct LaneQueue<const L: usize, const W: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub push: Input<Bit>,
    pub data: Input<Lanes<L, W>>,
    pub valid: Output<Bit>,
    pub head: Output<Lanes<L, W>>,
    pub take: Input<Bit>,
    memory: Ram<Lanes<L, W>, A>,
    write_place: Register<U<A>>,
    read_place: Register<U<A>>,
    /// The memory's output register holds the oldest word, and no place of the memory does.
    held: Register<Bit>,
    reads: Wire<Bit>,
}

impl<const L: usize, const W: usize, const A: usize> Default for LaneQueue<L, W, A> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            push: Input::default(),
            data: Input::default(),
            valid: Output::default(),
            head: Output::default(),
            take: Input::default(),
            memory: Ram::default(),
            write_place: Register::default(),
            read_place: Register::default(),
            held: Register::default(),
            reads: Wire::default(),
        }
    }
}

impl<const L: usize, const W: usize, const A: usize> Logic for LaneQueue<L, W, A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, memory);
        dff_setup!(self, clock, write_place, read_place, held);
        self.valid.next = self.held.q.val();
        self.head.next = self.memory.read_data.val();
        self.memory.write_enable.next = self.push.val();
        self.memory.write_address.next = self.write_place.q.val();
        self.memory.write_data.next = self.data.val();
        if self.push.val() {
            self.write_place.d.next = self.write_place.q.val() + 1;
        }
        self.reads.next =
            self.write_place.q.val() != self.read_place.q.val() && (!self.held.q.val() || self.take.val());
        self.memory.enable.next = self.reads.val();
        self.memory.read_address.next = self.read_place.q.val();
        if self.reads.val() {
            self.read_place.d.next = self.read_place.q.val() + 1;
            self.held.d.next = true;
        } else if self.take.val() {
            self.held.d.next = false;
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("lane_queue_{L}x{W}_by_{A}"))
    }
}

watched! { [const L: usize, const W: usize, const A: usize] LaneQueue<L, W, A>: push, data, take; memory; memory, write_place, read_place, held }
