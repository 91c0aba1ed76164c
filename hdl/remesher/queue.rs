// SPDX-License-Identifier: MIT OR Apache-2.0
//! Queue in front of the step port: a stall of the reader never reaches the walkers, only the sweep, and that in time.
//!
//! `room` falls while seven beats or more wait, and the sweep stops. Up to nine more are under way by then: a
//! micro-operation is eight cycles in sweep, walkers, commands and on its way to the memories, and `room` is one old. Sixteen
//! places hold them all.
//!
//! | port  | format   |   Latency 3, interval 1
//! | in_*  | -        | beats; vertices one cycle behind the other fields |
//! | room  | Bit      | a register: the sweep may go on |
//! | out_* | stream   | the step port   Error 0

use crate::prelude::*;

/// The queue, for `L` components of `V` bits.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct StepQueue<const L: usize, const V: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_left: Input<U<2>>,
    pub in_right: Input<U<2>>,
    pub in_swap: Input<Bit>,
    pub in_last: Input<Bit>,
    pub in_left_vertex: Input<Lanes<L, V>>,
    pub in_right_vertex: Input<Lanes<L, V>>,
    pub room: Output<Bit>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_kind: Output<U<2>>,
    pub out_left: Output<U<2>>,
    pub out_right: Output<U<2>>,
    pub out_swap: Output<Bit>,
    pub out_last: Output<Bit>,
    pub out_left_vertex: Output<Lanes<L, V>>,
    pub out_right_vertex: Output<Lanes<L, V>>,
    /// Beats that wait in the memories.
    waiting: Register<U<5>>,
    /// There is one.
    any: Register<Bit>,
    write_place: Register<U<4>>,
    read_place: Register<U<4>>,
    /// The memories' output registers hold a beat.
    held: Register<Bit>,
    has_room: Register<Bit>,
    /// The beat on its way to the memories, beside its vertices, and its place.
    write_valid: Register<Bit>,
    write_codes: DataRegister<U<8>>,
    next_place: Register<U<4>>,
    codes: Ram<U<8>, 4>,
    left_vertices: Ram<Lanes<L, V>, 4>,
    right_vertices: Ram<Lanes<L, V>, 4>,
    takes: Wire<Bit>,
}

impl<const L: usize, const V: usize> StepQueue<L, V> {
    /// Places.
    pub const DEPTH: usize = 16;
}

impl<const L: usize, const V: usize> Default for StepQueue<L, V> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_kind: Input::default(),
            in_left: Input::default(),
            in_right: Input::default(),
            in_swap: Input::default(),
            in_last: Input::default(),
            in_left_vertex: Input::default(),
            in_right_vertex: Input::default(),
            room: Output::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_kind: Output::default(),
            out_left: Output::default(),
            out_right: Output::default(),
            out_swap: Output::default(),
            out_last: Output::default(),
            out_left_vertex: Output::default(),
            out_right_vertex: Output::default(),
            waiting: Register::default(),
            any: Register::default(),
            write_place: Register::default(),
            read_place: Register::default(),
            held: Register::default(),
            has_room: Register::default(),
            write_valid: Register::default(),
            write_codes: DataRegister::default(),
            next_place: Register::default(),
            codes: Ram::new(Self::DEPTH),
            left_vertices: Ram::new(Self::DEPTH),
            right_vertices: Ram::new(Self::DEPTH),
            takes: Wire::default(),
        }
    }
}

impl<const L: usize, const V: usize> Logic for StepQueue<L, V> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, any);
        dff_setup!(self, clock, write_valid, write_codes, next_place);
        dff_setup!(self, clock, waiting, write_place, read_place, held, has_room);
        clock!(self, clock, codes, left_vertices, right_vertices);
        self.room.next = self.has_room.q.val();
        self.has_room.d.next = self.waiting.q.val() < 7;
        // The place of the next beat goes the same way: the wire to the memories takes a cycle.
        self.write_place.d.next = self.next_place.q.val();
        self.write_valid.d.next = self.in_valid.val();
        self.write_codes.d.next = (bit_cast_to::<U<8>>(self.in_kind.val()) << 6)
            | (bit_cast_to::<U<8>>(self.in_left.val()) << 4)
            | (bit_cast_to::<U<8>>(self.in_right.val()) << 2)
            | (bit_cast_to::<U<8>>(self.in_swap.val()) << 1)
            | bit_cast_to::<U<8>>(self.in_last.val());
        if self.in_valid.val() {
            self.next_place.d.next = self.next_place.q.val() + 1;
        }
        self.codes.write_enable.next = self.write_valid.q.val();
        self.codes.write_address.next = self.write_place.q.val();
        self.codes.write_data.next = self.write_codes.q.val();
        self.left_vertices.write_enable.next = self.write_valid.q.val();
        self.left_vertices.write_address.next = self.write_place.q.val();
        self.left_vertices.write_data.next = self.in_left_vertex.val();
        self.right_vertices.write_enable.next = self.write_valid.q.val();
        self.right_vertices.write_address.next = self.write_place.q.val();
        self.right_vertices.write_data.next = self.in_right_vertex.val();

        self.takes.next = self.any.q.val() && (!self.held.q.val() || self.out_ready.val());
        self.codes.enable.next = self.takes.val();
        self.codes.read_address.next = self.read_place.q.val();
        self.left_vertices.enable.next = self.takes.val();
        self.left_vertices.read_address.next = self.read_place.q.val();
        self.right_vertices.enable.next = self.takes.val();
        self.right_vertices.read_address.next = self.read_place.q.val();
        if self.takes.val() {
            self.read_place.d.next = self.read_place.q.val() + 1;
            self.held.d.next = true;
        } else if self.out_ready.val() {
            self.held.d.next = false;
        }
        if self.write_valid.q.val() && !self.takes.val() {
            self.waiting.d.next = self.waiting.q.val() + 1;
        } else if !self.write_valid.q.val() && self.takes.val() {
            self.waiting.d.next = self.waiting.q.val() - 1;
        }
        self.any.d.next = self.write_valid.q.val()
            || (self.waiting.q.val() >> 1) != 0
            || (self.waiting.q.val().get_bit(0) && !self.takes.val());
        self.out_valid.next = self.held.q.val();
        self.out_kind.next = self.codes.read_data.val().get_bits::<2>(6);
        self.out_left.next = self.codes.read_data.val().get_bits::<2>(4);
        self.out_right.next = self.codes.read_data.val().get_bits::<2>(2);
        self.out_swap.next = self.codes.read_data.val().get_bit(1);
        self.out_last.next = self.codes.read_data.val().get_bit(0);
        self.out_left_vertex.next = self.left_vertices.read_data.val();
        self.out_right_vertex.next = self.right_vertices.read_data.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("step_queue")
    }
}

watched! { [const L: usize, const V: usize] StepQueue<L, V>: in_valid, in_kind, in_left, in_right, in_swap, in_last, in_left_vertex, in_right_vertex, out_ready; codes, left_vertices, right_vertices; waiting, write_place, read_place, held, has_room, codes, left_vertices, right_vertices, write_valid, write_codes, next_place, any }
