// SPDX-License-Identifier: MIT OR Apache-2.0
//! The heights of a map, and the triangles that its vertices make.
//!
//! | stage      | what it does                                       |   Golden: models::bisector::golden   Error 0
//! | s1_vertex  | the vertex; the memory takes it                    |   Latency 7; never holds
//! | s2_address to s6_height | its height                            |
//! | s7_triangle | left and right of its walker's strip, and the new one |

use super::BisectorPlane;
use crate::prelude::*;

/// Vertices of lattices of up to 2^K steps, C = K + 1, H = K + 2, A = 2 K - 2.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorVertices<const C: usize, const H: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub at_u: Input<U<C>>,
    pub at_v: Input<U<C>>,
    /// The vertex becomes the left one, or the right one, and with it a triangle is sent.
    pub to_left: Input<Bit>,
    pub to_right: Input<Bit>,
    pub sends: Input<Bit>,
    /// There is no vertex, only the end of a draw.
    pub ends: Input<Bit>,
    pub side: Input<Bit>,
    pub begins: Input<Bit>,
    pub walker: Input<U<3>>,
    pub write: Input<Bit>,
    pub write_u: Input<U<C>>,
    pub write_v: Input<U<C>>,
    pub write_data: Input<U<20>>,
    /// A triangle, or the end.
    pub sent: Output<Bit>,
    pub ended: Output<Bit>,
    pub left: Output<Lanes<3, 21>>,
    pub right: Output<Lanes<3, 21>>,
    pub fresh: Output<Lanes<3, 21>>,
    pub of_side: Output<Bit>,
    pub of_begin: Output<Bit>,
    pub of_walker: Output<U<3>>,
    heights: BisectorPlane<C, H, A, 20>,
    /// Left and right vertex of each walker.
    lefts: Ram<Lanes<3, 21>, 3>,
    rights: Ram<Lanes<3, 21>, 3>,
    s1_u: DataRegister<U<C>>,
    s1_v: DataRegister<U<C>>,
    s1_to_left: Register<Bit>,
    s1_to_right: Register<Bit>,
    s1_sends: Register<Bit>,
    s1_end: Register<Bit>,
    s1_side: DataRegister<Bit>,
    s1_begins: DataRegister<Bit>,
    s1_walker: DataRegister<U<3>>,
    s2_u: DataRegister<U<C>>,
    s2_v: DataRegister<U<C>>,
    s2_to_left: Register<Bit>,
    s2_to_right: Register<Bit>,
    s2_sends: Register<Bit>,
    s2_end: Register<Bit>,
    s2_side: DataRegister<Bit>,
    s2_begins: DataRegister<Bit>,
    s2_walker: DataRegister<U<3>>,
    s3_u: DataRegister<U<C>>,
    s3_v: DataRegister<U<C>>,
    s3_to_left: Register<Bit>,
    s3_to_right: Register<Bit>,
    s3_sends: Register<Bit>,
    s3_end: Register<Bit>,
    s3_side: DataRegister<Bit>,
    s3_begins: DataRegister<Bit>,
    s3_walker: DataRegister<U<3>>,
    s4_u: DataRegister<U<C>>,
    s4_v: DataRegister<U<C>>,
    s4_to_left: Register<Bit>,
    s4_to_right: Register<Bit>,
    s4_sends: Register<Bit>,
    s4_end: Register<Bit>,
    s4_side: DataRegister<Bit>,
    s4_begins: DataRegister<Bit>,
    s4_walker: DataRegister<U<3>>,
    s5_u: DataRegister<U<C>>,
    s5_v: DataRegister<U<C>>,
    s5_to_left: Register<Bit>,
    s5_to_right: Register<Bit>,
    s5_sends: Register<Bit>,
    s5_end: Register<Bit>,
    s5_side: DataRegister<Bit>,
    s5_begins: DataRegister<Bit>,
    s5_walker: DataRegister<U<3>>,
    s6_u: DataRegister<U<C>>,
    s6_v: DataRegister<U<C>>,
    s6_to_left: Register<Bit>,
    s6_to_right: Register<Bit>,
    s6_sends: Register<Bit>,
    s6_end: Register<Bit>,
    s6_side: DataRegister<Bit>,
    s6_begins: DataRegister<Bit>,
    s6_walker: DataRegister<U<3>>,
    s7_sent: Register<Bit>,
    s7_end: Register<Bit>,
    s7_fresh: DataRegister<Lanes<3, 21>>,
    s7_side: DataRegister<Bit>,
    s7_begins: DataRegister<Bit>,
    s7_walker: DataRegister<U<3>>,
    lane_u: Wire<Lanes<3, 21>>,
    lane_v: Wire<Lanes<3, 21>>,
    here: Wire<Lanes<3, 21>>,
}

impl<const C: usize, const H: usize, const A: usize> Logic for BisectorVertices<C, H, A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, heights, lefts, rights);
        dff_setup!(self, clock, s1_u, s1_v, s1_to_left, s1_to_right, s1_sends, s1_end, s1_side, s1_begins, s1_walker);
        dff_setup!(self, clock, s2_u, s2_v, s2_to_left, s2_to_right, s2_sends, s2_end, s2_side, s2_begins, s2_walker);
        dff_setup!(self, clock, s3_u, s3_v, s3_to_left, s3_to_right, s3_sends, s3_end, s3_side, s3_begins, s3_walker);
        dff_setup!(self, clock, s4_u, s4_v, s4_to_left, s4_to_right, s4_sends, s4_end, s4_side, s4_begins, s4_walker);
        dff_setup!(self, clock, s5_u, s5_v, s5_to_left, s5_to_right, s5_sends, s5_end, s5_side, s5_begins, s5_walker);
        dff_setup!(self, clock, s6_u, s6_v, s6_to_left, s6_to_right, s6_sends, s6_end, s6_side, s6_begins, s6_walker);
        dff_setup!(self, clock, s7_sent, s7_end, s7_fresh, s7_side, s7_begins, s7_walker);
        self.sent.next = self.s7_sent.q.val();
        self.ended.next = self.s7_end.q.val();
        self.left.next = self.lefts.read_data.val();
        self.right.next = self.rights.read_data.val();
        self.fresh.next = self.s7_fresh.q.val();
        self.of_side.next = self.s7_side.q.val();
        self.of_begin.next = self.s7_begins.q.val();
        self.of_walker.next = self.s7_walker.q.val();
        self.heights.go.next = true;
        self.heights.go_0.next = true;
        self.heights.go_1.next = true;
        self.heights.go_2.next = true;
        self.heights.go_3.next = true;
        self.heights.u.next = self.s1_u.q.val();
        self.heights.v.next = self.s1_v.q.val();
        self.heights.write.next = self.write.val();
        self.heights.write_u.next = self.write_u.val();
        self.heights.write_v.next = self.write_v.val();
        self.heights.write_data.next = self.write_data.val();

        // 13 bits of u and v and 20 of z in signed lanes of 21.
        self.lane_u.next = bit_cast_to::<Lanes<3, 21>>(bit_cast_to::<S<21>>(self.s6_u.q.val()));
        self.lane_v.next = self.lane_u.val().replace_bit(1, bit_cast_to::<S<21>>(self.s6_v.q.val()));
        self.here.next = self.lane_v.val().replace_bit(2, bit_cast_to::<S<21>>(self.heights.word.val()));
        // A vertex is written when those before it are read.
        self.lefts.read_address.next = self.s6_walker.q.val();
        self.lefts.write_enable.next = self.s6_to_left.q.val();
        self.lefts.write_address.next = self.s6_walker.q.val();
        self.lefts.write_data.next = self.here.val();
        self.rights.read_address.next = self.s6_walker.q.val();
        self.rights.write_enable.next = self.s6_to_right.q.val();
        self.rights.write_address.next = self.s6_walker.q.val();
        self.rights.write_data.next = self.here.val();
        self.s1_u.d.next = self.at_u.val();
        self.s1_v.d.next = self.at_v.val();
        self.s1_to_left.d.next = self.to_left.val();
        self.s1_to_right.d.next = self.to_right.val();
        self.s1_sends.d.next = self.sends.val();
        self.s1_end.d.next = self.ends.val();
        self.s1_side.d.next = self.side.val();
        self.s1_begins.d.next = self.begins.val();
        self.s1_walker.d.next = self.walker.val();
        self.s2_u.d.next = self.s1_u.q.val();
        self.s2_v.d.next = self.s1_v.q.val();
        self.s2_to_left.d.next = self.s1_to_left.q.val();
        self.s2_to_right.d.next = self.s1_to_right.q.val();
        self.s2_sends.d.next = self.s1_sends.q.val();
        self.s2_end.d.next = self.s1_end.q.val();
        self.s2_side.d.next = self.s1_side.q.val();
        self.s2_begins.d.next = self.s1_begins.q.val();
        self.s2_walker.d.next = self.s1_walker.q.val();
        self.s3_u.d.next = self.s2_u.q.val();
        self.s3_v.d.next = self.s2_v.q.val();
        self.s3_to_left.d.next = self.s2_to_left.q.val();
        self.s3_to_right.d.next = self.s2_to_right.q.val();
        self.s3_sends.d.next = self.s2_sends.q.val();
        self.s3_end.d.next = self.s2_end.q.val();
        self.s3_side.d.next = self.s2_side.q.val();
        self.s3_begins.d.next = self.s2_begins.q.val();
        self.s3_walker.d.next = self.s2_walker.q.val();
        self.s4_u.d.next = self.s3_u.q.val();
        self.s4_v.d.next = self.s3_v.q.val();
        self.s4_to_left.d.next = self.s3_to_left.q.val();
        self.s4_to_right.d.next = self.s3_to_right.q.val();
        self.s4_sends.d.next = self.s3_sends.q.val();
        self.s4_end.d.next = self.s3_end.q.val();
        self.s4_side.d.next = self.s3_side.q.val();
        self.s4_begins.d.next = self.s3_begins.q.val();
        self.s4_walker.d.next = self.s3_walker.q.val();
        self.s5_u.d.next = self.s4_u.q.val();
        self.s5_v.d.next = self.s4_v.q.val();
        self.s5_to_left.d.next = self.s4_to_left.q.val();
        self.s5_to_right.d.next = self.s4_to_right.q.val();
        self.s5_sends.d.next = self.s4_sends.q.val();
        self.s5_end.d.next = self.s4_end.q.val();
        self.s5_side.d.next = self.s4_side.q.val();
        self.s5_begins.d.next = self.s4_begins.q.val();
        self.s5_walker.d.next = self.s4_walker.q.val();
        self.s6_u.d.next = self.s5_u.q.val();
        self.s6_v.d.next = self.s5_v.q.val();
        self.s6_to_left.d.next = self.s5_to_left.q.val();
        self.s6_to_right.d.next = self.s5_to_right.q.val();
        self.s6_sends.d.next = self.s5_sends.q.val();
        self.s6_end.d.next = self.s5_end.q.val();
        self.s6_side.d.next = self.s5_side.q.val();
        self.s6_begins.d.next = self.s5_begins.q.val();
        self.s6_walker.d.next = self.s5_walker.q.val();
        self.s7_sent.d.next = self.s6_sends.q.val() || self.s6_end.q.val();
        self.s7_end.d.next = self.s6_end.q.val();
        self.s7_fresh.d.next = self.here.val();
        self.s7_side.d.next = self.s6_side.q.val();
        self.s7_begins.d.next = self.s6_begins.q.val();
        self.s7_walker.d.next = self.s6_walker.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_vertices")
    }
}

latches! { [const C: usize, const H: usize, const A: usize] BisectorVertices<C, H, A>: heights, lefts, rights, s1_u, s1_v, s1_to_left, s1_to_right, s1_sends, s1_end, s1_side, s1_begins, s1_walker, s2_u, s2_v, s2_to_left, s2_to_right, s2_sends, s2_end, s2_side, s2_begins, s2_walker, s3_u, s3_v, s3_to_left, s3_to_right, s3_sends, s3_end, s3_side, s3_begins, s3_walker, s4_u, s4_v, s4_to_left, s4_to_right, s4_sends, s4_end, s4_side, s4_begins, s4_walker, s5_u, s5_v, s5_to_left, s5_to_right, s5_sends, s5_end, s5_side, s5_begins, s5_walker, s6_u, s6_v, s6_to_left, s6_to_right, s6_sends, s6_end, s6_side, s6_begins, s6_walker, s7_sent, s7_end, s7_fresh, s7_side, s7_begins, s7_walker }
