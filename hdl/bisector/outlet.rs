// SPDX-License-Identifier: MIT OR Apache-2.0
//! Beats on their way out: sixteen of them wait here.
//!
//! What comes cannot be made to wait at once, so `room` falls early.
//!
//! | port   | meaning |   Golden: none, it changes nothing   Latency 2
//! | put    | takes a beat |
//! | room   | there is room; up to twelve more may come from when it falls |
//! | out_*  | the beats, under the rules of a stream; the end of a draw carries nothing |

use crate::prelude::*;

/// Outlet of triangles.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorOutlet {
    pub clock: Input<ClockReset>,
    pub put: Input<Bit>,
    pub ends: Input<Bit>,
    pub left: Input<Lanes<3, 21>>,
    pub right: Input<Lanes<3, 21>>,
    pub fresh: Input<Lanes<3, 21>>,
    pub side: Input<Bit>,
    pub begins: Input<Bit>,
    pub walker: Input<U<3>>,
    pub room: Output<Bit>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_left: Output<Lanes<3, 21>>,
    pub out_right: Output<Lanes<3, 21>>,
    pub out_new: Output<Lanes<3, 21>>,
    pub out_side: Output<Bit>,
    pub out_start: Output<Bit>,
    pub out_walker: Output<U<3>>,
    pub out_end: Output<Bit>,
    lefts: Ram<Lanes<3, 21>, 4>,
    rights: Ram<Lanes<3, 21>, 4>,
    news: Ram<Lanes<3, 21>, 4>,
    /// End, side << 1, start << 2, walker << 3.
    flags: Ram<U<6>, 4>,
    // Places in the memories, and a bit to tell sixteen beats from none.
    tail: Register<U<5>>,
    head: Register<U<5>>,
    held: Register<U<5>>,
    standing: Register<Bit>,
    some: Wire<Bit>,
    free: Wire<Bit>,
    takes: Wire<Bit>,
    tail_at: Wire<U<4>>,
    head_at: Wire<U<4>>,
    zero: Wire<S<21>>,
    nothing: Wire<Lanes<3, 21>>,
    left_in: Wire<Lanes<3, 21>>,
    right_in: Wire<Lanes<3, 21>>,
    new_in: Wire<Lanes<3, 21>>,
    flags_in: Wire<U<6>>,
}

impl Logic for BisectorOutlet {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, lefts, rights, news, flags);
        dff_setup!(self, clock, tail, head, held, standing);
        self.room.next =
            !self.held.q.val().get_bit(2) && !self.held.q.val().get_bit(3) && !self.held.q.val().get_bit(4);
        self.out_valid.next = self.standing.q.val();
        self.out_left.next = self.lefts.read_data.val();
        self.out_right.next = self.rights.read_data.val();
        self.out_new.next = self.news.read_data.val();
        self.out_end.next = self.flags.read_data.val().get_bit(0);
        self.out_side.next = self.flags.read_data.val().get_bit(1);
        self.out_start.next = self.flags.read_data.val().get_bit(2);
        self.out_walker.next = self.flags.read_data.val().get_bits::<3>(3);
        self.zero.next = 0.into();
        self.nothing.next = bit_cast_to::<Lanes<3, 21>>(self.zero.val());
        self.left_in.next = self.left.val();
        self.right_in.next = self.right.val();
        self.new_in.next = self.fresh.val();
        self.flags_in.next = (bit_cast_to::<U<6>>(self.side.val()) << 1)
            | (bit_cast_to::<U<6>>(self.begins.val()) << 2)
            | (bit_cast_to::<U<6>>(self.walker.val()) << 3);
        if self.ends.val() {
            self.left_in.next = self.nothing.val();
            self.right_in.next = self.nothing.val();
            self.new_in.next = self.nothing.val();
            self.flags_in.next = 1.into();
        }
        self.some.next = self.tail.q.val() != self.head.q.val();
        self.free.next = !self.standing.q.val() || self.out_ready.val();
        self.takes.next = self.free.val() && self.some.val();
        self.tail_at.next = self.tail.q.val().get_bits::<4>(0);
        self.head_at.next = self.head.q.val().get_bits::<4>(0);
        self.lefts.enable.next = self.takes.val();
        self.lefts.read_address.next = self.head_at.val();
        self.lefts.write_enable.next = self.put.val();
        self.lefts.write_address.next = self.tail_at.val();
        self.lefts.write_data.next = self.left_in.val();
        self.rights.enable.next = self.takes.val();
        self.rights.read_address.next = self.head_at.val();
        self.rights.write_enable.next = self.put.val();
        self.rights.write_address.next = self.tail_at.val();
        self.rights.write_data.next = self.right_in.val();
        self.news.enable.next = self.takes.val();
        self.news.read_address.next = self.head_at.val();
        self.news.write_enable.next = self.put.val();
        self.news.write_address.next = self.tail_at.val();
        self.news.write_data.next = self.new_in.val();
        self.flags.enable.next = self.takes.val();
        self.flags.read_address.next = self.head_at.val();
        self.flags.write_enable.next = self.put.val();
        self.flags.write_address.next = self.tail_at.val();
        self.flags.write_data.next = self.flags_in.val();
        if self.put.val() {
            self.tail.d.next = self.tail.q.val() + 1;
        }
        if self.free.val() {
            self.standing.d.next = self.some.val();
        }
        if self.takes.val() {
            self.head.d.next = self.head.q.val() + 1;
        }
        self.held.d.next = self.tail.q.val() - self.head.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_outlet")
    }
}

latches! { [] BisectorOutlet: lefts, rights, news, flags, tail, head, held, standing }
