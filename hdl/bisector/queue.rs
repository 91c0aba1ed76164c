// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that wait for their vertices: sixteen of them.
//!
//! A leaf takes a cycle there, and three where a strip begins; leaves come in every second cycle on the average.
//!
//! | port   | meaning |   Golden: none, it changes nothing   Latency 2; holds while `go` is low
//! | put    | takes a leaf, if `go` |
//! | take   | the leaf that stands there is taken, and the next one stands a cycle later, if `go` |
//! | valid  | a leaf stands there |
//! | room   | there is room; up to six more may come after it falls |
//! | empty  | there are no leaves but the one that stands there |

use crate::prelude::*;

/// Queue for lattices of up to 2^(H - 2) steps.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorQueue<const H: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub put: Input<Bit>,
    pub put_u: Input<U<H>>,
    pub put_v: Input<U<H>>,
    pub put_shape: Input<U<9>>,
    pub put_walker: Input<U<3>>,
    pub take: Input<Bit>,
    pub valid: Output<Bit>,
    pub u: Output<U<H>>,
    pub v: Output<U<H>>,
    pub shape: Output<U<9>>,
    pub walker: Output<U<3>>,
    pub room: Output<Bit>,
    pub empty: Output<Bit>,
    queue_u: Ram<U<H>, 4>,
    queue_v: Ram<U<H>, 4>,
    queue_shape: Ram<U<9>, 4>,
    queue_walker: Ram<U<3>, 4>,
    // Places in the memories, and a bit to tell sixteen leaves from none.
    tail: Register<U<5>>,
    head: Register<U<5>>,
    standing: Register<Bit>,
    held: Register<U<5>>,
    has_room: Register<Bit>,
    some: Wire<Bit>,
    reads: Wire<Bit>,
    writes: Wire<Bit>,
    tail_at: Wire<U<4>>,
    head_at: Wire<U<4>>,
}

impl<const H: usize> Default for BisectorQueue<H> {
    fn default() -> Self {
        Self {
            has_room: Register::new(true),
            clock: Input::default(),
            go: Input::default(),
            put: Input::default(),
            put_u: Input::default(),
            put_v: Input::default(),
            put_shape: Input::default(),
            put_walker: Input::default(),
            take: Input::default(),
            valid: Output::default(),
            u: Output::default(),
            v: Output::default(),
            shape: Output::default(),
            walker: Output::default(),
            room: Output::default(),
            empty: Output::default(),
            queue_u: Ram::default(),
            queue_v: Ram::default(),
            queue_shape: Ram::default(),
            queue_walker: Ram::default(),
            tail: Register::default(),
            head: Register::default(),
            standing: Register::default(),
            held: Register::default(),
            some: Wire::default(),
            reads: Wire::default(),
            writes: Wire::default(),
            tail_at: Wire::default(),
            head_at: Wire::default(),
        }
    }
}

impl<const H: usize> Logic for BisectorQueue<H> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, queue_u, queue_v, queue_shape, queue_walker);
        dff_setup!(self, clock, tail, head, standing, held, has_room);
        self.some.next = self.tail.q.val() != self.head.q.val();
        self.reads.next = self.go.val() && self.take.val();
        self.writes.next = self.go.val() && self.put.val();
        self.valid.next = self.standing.q.val();
        self.u.next = self.queue_u.read_data.val();
        self.v.next = self.queue_v.read_data.val();
        self.shape.next = self.queue_shape.read_data.val();
        self.walker.next = self.queue_walker.read_data.val();
        self.room.next = self.has_room.q.val();
        self.empty.next = !self.some.val();
        self.tail_at.next = self.tail.q.val().get_bits::<4>(0);
        self.head_at.next = self.head.q.val().get_bits::<4>(0);
        self.queue_u.enable.next = self.reads.val();
        self.queue_u.read_address.next = self.head_at.val();
        self.queue_u.write_enable.next = self.writes.val();
        self.queue_u.write_address.next = self.tail_at.val();
        self.queue_u.write_data.next = self.put_u.val();
        self.queue_v.enable.next = self.reads.val();
        self.queue_v.read_address.next = self.head_at.val();
        self.queue_v.write_enable.next = self.writes.val();
        self.queue_v.write_address.next = self.tail_at.val();
        self.queue_v.write_data.next = self.put_v.val();
        self.queue_shape.enable.next = self.reads.val();
        self.queue_shape.read_address.next = self.head_at.val();
        self.queue_shape.write_enable.next = self.writes.val();
        self.queue_shape.write_address.next = self.tail_at.val();
        self.queue_shape.write_data.next = self.put_shape.val();
        self.queue_walker.enable.next = self.reads.val();
        self.queue_walker.read_address.next = self.head_at.val();
        self.queue_walker.write_enable.next = self.writes.val();
        self.queue_walker.write_address.next = self.tail_at.val();
        self.queue_walker.write_data.next = self.put_walker.val();
        if self.writes.val() {
            self.tail.d.next = self.tail.q.val() + 1;
        }
        if self.reads.val() {
            self.standing.d.next = self.some.val();
            if self.some.val() {
                self.head.d.next = self.head.q.val() + 1;
            }
        }
        if self.go.val() {
            self.held.d.next = self.tail.q.val() - self.head.q.val();
            self.has_room.d.next = !self.held.q.val().get_bit(3) && !self.held.q.val().get_bit(4);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_queue")
    }
}

latches! { [const H: usize] BisectorQueue<H>: queue_u, queue_v, queue_shape, queue_walker, tail, head, standing, held, has_room }
