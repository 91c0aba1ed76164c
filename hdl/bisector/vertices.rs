// SPDX-License-Identifier: MIT OR Apache-2.0
//! The heights of a map, and the triangles that its vertices make.
//!
//! | stage      | what it does                                       |   Golden: models::bisector::golden   Error 0
//! | s1_address | address of the vertex: (v << K) + v + u            |   Latency 3; holds while `go` is low
//! | s2_read    | its height                                         |
//! | s3_triangle | left, right and new vertex of its walker's strip  |

use crate::prelude::*;

/// Vertices of lattices of up to 2^K steps, C = K + 1, A = 2 K + 1.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorVertices<const C: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub vertex: Input<Bit>,
    /// There is no vertex, only the end of a draw.
    pub ends: Input<Bit>,
    pub at_u: Input<U<C>>,
    pub at_v: Input<U<C>>,
    pub role: Input<U<2>>,
    pub side: Input<Bit>,
    pub begins: Input<Bit>,
    pub walker: Input<Bit>,
    pub write: Input<Bit>,
    pub write_address: Input<U<A>>,
    pub write_data: Input<U<20>>,
    pub busy: Output<Bit>,
    pub triangle: Output<Bit>,
    pub ended: Output<Bit>,
    pub left: Output<Lanes<3, 21>>,
    pub right: Output<Lanes<3, 21>>,
    pub fresh: Output<Lanes<3, 21>>,
    pub of_side: Output<Bit>,
    pub of_walker: Output<Bit>,
    pub of_begin: Output<Bit>,
    heights: Ram<U<20>, A>,
    s1_valid: Register<Bit>,
    s1_end: Register<Bit>,
    s1_u: DataRegister<U<C>>,
    s1_v: DataRegister<U<C>>,
    s1_address: DataRegister<U<A>>,
    s1_role: DataRegister<U<2>>,
    s1_side: DataRegister<Bit>,
    s1_begins: DataRegister<Bit>,
    s1_walker: DataRegister<Bit>,
    s2_valid: Register<Bit>,
    s2_end: Register<Bit>,
    s2_u: DataRegister<U<C>>,
    s2_v: DataRegister<U<C>>,
    s2_role: DataRegister<U<2>>,
    s2_side: DataRegister<Bit>,
    s2_begins: DataRegister<Bit>,
    s2_walker: DataRegister<Bit>,
    s3_valid: Register<Bit>,
    s3_end: Register<Bit>,
    s3_left: DataRegister<Lanes<3, 21>>,
    s3_right: DataRegister<Lanes<3, 21>>,
    s3_fresh: DataRegister<Lanes<3, 21>>,
    s3_side: DataRegister<Bit>,
    s3_begins: DataRegister<Bit>,
    s3_walker: DataRegister<Bit>,
    left_0: DataRegister<Lanes<3, 21>>,
    left_1: DataRegister<Lanes<3, 21>>,
    right_0: DataRegister<Lanes<3, 21>>,
    right_1: DataRegister<Lanes<3, 21>>,
    pitch: Constant<U<4>>,
    row: Wire<U<A>>,
    lane_u: Wire<Lanes<3, 21>>,
    lane_v: Wire<Lanes<3, 21>>,
    here: Wire<Lanes<3, 21>>,
    zero: Wire<S<21>>,
    nothing: Wire<Lanes<3, 21>>,
    new_left: Wire<Bit>,
    new_right: Wire<Bit>,
}

impl<const C: usize, const A: usize> Default for BisectorVertices<C, A> {
    fn default() -> Self {
        let side = (1 << (C - 1)) + 1;
        Self {
            heights: Ram::new(side * side),
            pitch: Constant::new(U::new(C as i64 - 1)),
            clock: Input::default(),
            go: Input::default(),
            vertex: Input::default(),
            ends: Input::default(),
            at_u: Input::default(),
            at_v: Input::default(),
            role: Input::default(),
            side: Input::default(),
            begins: Input::default(),
            walker: Input::default(),
            write: Input::default(),
            write_address: Input::default(),
            write_data: Input::default(),
            busy: Output::default(),
            triangle: Output::default(),
            ended: Output::default(),
            left: Output::default(),
            right: Output::default(),
            fresh: Output::default(),
            of_side: Output::default(),
            of_walker: Output::default(),
            of_begin: Output::default(),
            s1_valid: Register::default(),
            s1_end: Register::default(),
            s1_u: DataRegister::default(),
            s1_v: DataRegister::default(),
            s1_address: DataRegister::default(),
            s1_role: DataRegister::default(),
            s1_side: DataRegister::default(),
            s1_begins: DataRegister::default(),
            s1_walker: DataRegister::default(),
            s2_valid: Register::default(),
            s2_end: Register::default(),
            s2_u: DataRegister::default(),
            s2_v: DataRegister::default(),
            s2_role: DataRegister::default(),
            s2_side: DataRegister::default(),
            s2_begins: DataRegister::default(),
            s2_walker: DataRegister::default(),
            s3_valid: Register::default(),
            s3_end: Register::default(),
            s3_left: DataRegister::default(),
            s3_right: DataRegister::default(),
            s3_fresh: DataRegister::default(),
            s3_side: DataRegister::default(),
            s3_begins: DataRegister::default(),
            s3_walker: DataRegister::default(),
            left_0: DataRegister::default(),
            left_1: DataRegister::default(),
            right_0: DataRegister::default(),
            right_1: DataRegister::default(),
            row: Wire::default(),
            lane_u: Wire::default(),
            lane_v: Wire::default(),
            here: Wire::default(),
            zero: Wire::default(),
            nothing: Wire::default(),
            new_left: Wire::default(),
            new_right: Wire::default(),
        }
    }
}

impl<const C: usize, const A: usize> Logic for BisectorVertices<C, A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, heights);
        dff_setup!(self, clock, s1_valid, s1_end, s1_u, s1_v, s1_address, s1_role, s1_side, s1_begins, s1_walker);
        dff_setup!(self, clock, s2_valid, s2_end, s2_u, s2_v, s2_role, s2_side, s2_begins, s2_walker);
        dff_setup!(self, clock, s3_valid, s3_end, s3_left, s3_right, s3_fresh, s3_side, s3_begins, s3_walker);
        dff_setup!(self, clock, left_0, left_1, right_0, right_1);
        self.busy.next = self.s1_valid.q.val()
            || self.s1_end.q.val()
            || self.s2_valid.q.val()
            || self.s2_end.q.val()
            || self.s3_valid.q.val();
        self.triangle.next = self.s3_valid.q.val();
        self.ended.next = self.s3_end.q.val();
        self.left.next = self.s3_left.q.val();
        self.right.next = self.s3_right.q.val();
        self.fresh.next = self.s3_fresh.q.val();
        self.of_side.next = self.s3_side.q.val();
        self.of_walker.next = self.s3_walker.q.val();
        self.of_begin.next = self.s3_begins.q.val();

        // s1_address: the last one is (2^K + 1)^2 - 1 < 2^A.
        self.row.next = bit_cast_to::<U<A>>(self.at_v.val());
        self.heights.enable.next = self.go.val();
        self.heights.read_address.next = self.s1_address.q.val();
        self.heights.write_enable.next = self.write.val();
        self.heights.write_address.next = self.write_address.val();
        self.heights.write_data.next = self.write_data.val();

        // s3_triangle: 13 bits of u and v and 20 of z in signed lanes of 21.
        self.lane_u.next = bit_cast_to::<Lanes<3, 21>>(bit_cast_to::<S<21>>(self.s2_u.q.val()));
        self.lane_v.next = self.lane_u.val().replace_bit(1, bit_cast_to::<S<21>>(self.s2_v.q.val()));
        self.here.next = self.lane_v.val().replace_bit(2, bit_cast_to::<S<21>>(self.heights.read_data.val()));
        self.zero.next = 0.into();
        self.nothing.next = bit_cast_to::<Lanes<3, 21>>(self.zero.val());
        self.new_left.next = self.s2_valid.q.val()
            && (self.s2_role.q.val() == 0 || (self.s2_role.q.val() == 2 && !self.s2_side.q.val()));
        self.new_right.next =
            self.s2_valid.q.val() && (self.s2_role.q.val() == 1 || (self.s2_role.q.val() == 2 && self.s2_side.q.val()));
        if self.go.val() {
            self.s1_valid.d.next = self.vertex.val();
            self.s1_end.d.next = self.ends.val();
            self.s1_u.d.next = self.at_u.val();
            self.s1_v.d.next = self.at_v.val();
            self.s1_address.d.next =
                (self.row.val() << self.pitch.val()) + self.row.val() + bit_cast_to::<U<A>>(self.at_u.val());
            self.s1_role.d.next = self.role.val();
            self.s1_side.d.next = self.side.val();
            self.s1_begins.d.next = self.begins.val();
            self.s1_walker.d.next = self.walker.val();
            self.s2_valid.d.next = self.s1_valid.q.val();
            self.s2_end.d.next = self.s1_end.q.val();
            self.s2_u.d.next = self.s1_u.q.val();
            self.s2_v.d.next = self.s1_v.q.val();
            self.s2_role.d.next = self.s1_role.q.val();
            self.s2_side.d.next = self.s1_side.q.val();
            self.s2_begins.d.next = self.s1_begins.q.val();
            self.s2_walker.d.next = self.s1_walker.q.val();
            self.s3_valid.d.next = (self.s2_valid.q.val() && self.s2_role.q.val() == 2) || self.s2_end.q.val();
            self.s3_end.d.next = self.s2_end.q.val();
            self.s3_left.d.next = self.left_0.q.val();
            self.s3_right.d.next = self.right_0.q.val();
            if self.s2_walker.q.val() {
                self.s3_left.d.next = self.left_1.q.val();
                self.s3_right.d.next = self.right_1.q.val();
            }
            self.s3_fresh.d.next = self.here.val();
            self.s3_side.d.next = self.s2_side.q.val();
            self.s3_begins.d.next = self.s2_begins.q.val();
            self.s3_walker.d.next = self.s2_walker.q.val();
            // The end of a draw carries nothing, rather than what the registers happen to hold.
            if self.s2_end.q.val() {
                self.s3_left.d.next = self.nothing.val();
                self.s3_right.d.next = self.nothing.val();
                self.s3_fresh.d.next = self.nothing.val();
                self.s3_side.d.next = false;
                self.s3_begins.d.next = false;
                self.s3_walker.d.next = false;
            }
            if self.new_left.val() && !self.s2_walker.q.val() {
                self.left_0.d.next = self.here.val();
            }
            if self.new_left.val() && self.s2_walker.q.val() {
                self.left_1.d.next = self.here.val();
            }
            if self.new_right.val() && !self.s2_walker.q.val() {
                self.right_0.d.next = self.here.val();
            }
            if self.new_right.val() && self.s2_walker.q.val() {
                self.right_1.d.next = self.here.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_vertices")
    }
}

latches! { [const C: usize, const A: usize] BisectorVertices<C, A>: heights, s1_valid, s1_end, s1_u, s1_v, s1_address, s1_role, s1_side, s1_begins, s1_walker, s2_valid, s2_end, s2_u, s2_v, s2_role, s2_side, s2_begins, s2_walker, s3_valid, s3_end, s3_left, s3_right, s3_fresh, s3_side, s3_begins, s3_walker, left_0, left_1, right_0, right_1 }
