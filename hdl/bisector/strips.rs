// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves to vertices: the corners of a leaf, and which of them its strip does not have yet.
//!
//! | stage      | what it does                                          |   Golden: models::bisector::golden   Error 0
//! | s0_leaf    | the leaf that stands at the queue's end               |   Latency 6; holds while `go` is low
//! | s1_step    | its step, and where its corners are                   |
//! | s2_sum, s3_corners | a, b, c in lattice steps, clamped to the map  |
//! | s4_entered | the edge that it is entered by, and the one that its walker's last leaf left |
//! | s5_follows | whether they are the same: if not, a strip begins     |
//! | s6_vertex  | the new vertex, and before it left and right where a strip begins: three cycles |
//!
//! The edge that a leaf leaves is written on the way from s5 to s6. So a leaf waits at s0 while one of its walker is at s1 or s2.

use super::BisectorCorner;
use crate::prelude::*;

/// Strips for lattices of up to 2^K steps, C = K + 1, H = K + 2.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorStrips<const C: usize, const H: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// Forgets the strip of a walker, if `go`.
    pub clear: Input<Bit>,
    pub clear_walker: Input<U<3>>,
    pub leaf: Input<Bit>,
    pub u: Input<U<H>>,
    pub v: Input<U<H>>,
    /// Level, direction << 4, entered over the hypotenuse << 7, left over it << 8.
    pub shape: Input<U<9>>,
    pub walker: Input<U<3>>,
    /// The leaf is taken, if there is one.
    pub take: Output<Bit>,
    /// Last column and row of the map, in half steps.
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub busy: Output<Bit>,
    pub vertex: Output<Bit>,
    pub vertex_u: Output<U<C>>,
    pub vertex_v: Output<U<C>>,
    /// The vertex becomes the left one, or the right one of its walker.
    pub to_left: Output<Bit>,
    pub to_right: Output<Bit>,
    /// The vertex is a triangle's new one.
    pub sends: Output<Bit>,
    /// The new vertex takes the place of the right one.
    pub side: Output<Bit>,
    pub begins: Output<Bit>,
    pub of_walker: Output<U<3>>,
    s1_valid: Register<Bit>,
    s1_u: DataRegister<U<H>>,
    s1_v: DataRegister<U<H>>,
    s1_step: DataRegister<U<H>>,
    s1_to_a: DataRegister<U<3>>,
    s1_to_b: DataRegister<U<3>>,
    s1_to_c: DataRegister<U<3>>,
    s1_reversed: DataRegister<Bit>,
    s1_enters: DataRegister<Bit>,
    s1_leaves: DataRegister<Bit>,
    s1_walker: DataRegister<U<3>>,
    corner_a: BisectorCorner<H>,
    corner_b: BisectorCorner<H>,
    corner_c: BisectorCorner<H>,
    s2_valid: Register<Bit>,
    s2_reversed: DataRegister<Bit>,
    s2_enters: DataRegister<Bit>,
    s2_leaves: DataRegister<Bit>,
    s2_walker: DataRegister<U<3>>,
    s3_valid: Register<Bit>,
    s3_reversed: DataRegister<Bit>,
    s3_enters: DataRegister<Bit>,
    s3_leaves: DataRegister<Bit>,
    s3_walker: DataRegister<U<3>>,
    s4_valid: Register<Bit>,
    s4_a: DataRegister<U<26>>,
    s4_b: DataRegister<U<26>>,
    s4_c: DataRegister<U<26>>,
    s4_left: DataRegister<U<26>>,
    s4_right: DataRegister<U<26>>,
    s4_reversed: DataRegister<Bit>,
    s4_enters: DataRegister<Bit>,
    s4_leaves: DataRegister<Bit>,
    s4_walker: DataRegister<U<3>>,
    /// The last edges of the walkers; the left vertex has a bit above it that there is one.
    rung_left: Ram<U<27>, 3>,
    rung_right: Ram<U<26>, 3>,
    s5_valid: Register<Bit>,
    s5_a: DataRegister<U<26>>,
    s5_b: DataRegister<U<26>>,
    s5_c: DataRegister<U<26>>,
    s5_reversed: DataRegister<Bit>,
    s5_long: DataRegister<Bit>,
    s5_to_right: DataRegister<Bit>,
    s5_starts: DataRegister<Bit>,
    s5_walker: DataRegister<U<3>>,
    s6_valid: Register<Bit>,
    /// The left vertex is shown, or the right one.
    s6_shows_left: Register<Bit>,
    s6_shows_right: Register<Bit>,
    s6_left: DataRegister<U<26>>,
    s6_right: DataRegister<U<26>>,
    s6_fresh: DataRegister<U<26>>,
    s6_to_right: DataRegister<Bit>,
    s6_starts: DataRegister<Bit>,
    s6_walker: DataRegister<U<3>>,
    moves: Wire<Bit>,
    waits: Wire<Bit>,
    direction: Wire<U<3>>,
    one: Wire<U<H>>,
    leg_left: Wire<U<26>>,
    leg_right: Wire<U<26>>,
    follows: Wire<Bit>,
    long: Wire<Bit>,
    left: Wire<U<26>>,
    right: Wire<U<26>>,
    fresh: Wire<U<26>>,
    next_left: Wire<U<27>>,
    next_right: Wire<U<26>>,
    writes: Wire<Bit>,
    shown: Wire<U<26>>,
}

impl<const C: usize, const H: usize> Logic for BisectorStrips<C, H> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, corner_a, corner_b, corner_c, rung_left, rung_right);
        dff_setup!(self, clock, s1_valid, s1_u, s1_v, s1_step, s1_to_a, s1_to_b, s1_to_c, s1_reversed, s1_enters);
        dff_setup!(
            self,
            clock,
            s1_leaves,
            s1_walker,
            s2_valid,
            s2_reversed,
            s2_enters,
            s2_leaves,
            s2_walker,
            s3_valid,
            s3_reversed
        );
        dff_setup!(self, clock, s3_enters, s3_leaves, s3_walker, s4_valid, s4_a, s4_b, s4_c, s4_left, s4_right);
        dff_setup!(self, clock, s4_reversed, s4_enters, s4_leaves, s4_walker, s5_valid, s5_a, s5_b, s5_c, s5_reversed);
        dff_setup!(
            self,
            clock,
            s5_long,
            s5_to_right,
            s5_starts,
            s5_walker,
            s6_valid,
            s6_shows_left,
            s6_shows_right,
            s6_left,
            s6_right
        );
        dff_setup!(self, clock, s6_fresh, s6_to_right, s6_starts, s6_walker);
        self.moves.next = self.go.val() && !self.s6_shows_left.q.val() && !self.s6_shows_right.q.val();

        // s0_leaf
        self.waits.next = (self.s1_valid.q.val() && self.s1_walker.q.val() == self.walker.val())
            || (self.s2_valid.q.val() && self.s2_walker.q.val() == self.walker.val());
        self.take.next = self.moves.val() && !(self.leaf.val() && self.waits.val());
        self.direction.next = self.shape.val().get_bits::<3>(4);
        self.one.next = 1.into();
        if self.moves.val() {
            self.s1_valid.d.next = self.leaf.val() && !self.waits.val();
            self.s1_u.d.next = self.u.val();
            self.s1_v.d.next = self.v.val();
            self.s1_step.d.next = self.one.val() << self.shape.val().get_bits::<4>(0);
            self.s1_to_a.d.next = self.direction.val() + 2;
            self.s1_to_b.d.next = self.direction.val() + 6;
            self.s1_to_c.d.next = self.direction.val();
            self.s1_reversed.d.next = !self.shape.val().get_bit(4);
            self.s1_enters.d.next = self.shape.val().get_bit(7);
            self.s1_leaves.d.next = self.shape.val().get_bit(8);
            self.s1_walker.d.next = self.walker.val();
        }

        // s2_sum, s3_corners
        self.corner_a.go.next = self.moves.val();
        self.corner_a.u.next = self.s1_u.q.val();
        self.corner_a.v.next = self.s1_v.q.val();
        self.corner_a.step.next = self.s1_step.q.val();
        self.corner_a.towards.next = self.s1_to_a.q.val();
        self.corner_a.rim_u.next = self.rim_u.val();
        self.corner_a.rim_v.next = self.rim_v.val();
        self.corner_b.go.next = self.moves.val();
        self.corner_b.u.next = self.s1_u.q.val();
        self.corner_b.v.next = self.s1_v.q.val();
        self.corner_b.step.next = self.s1_step.q.val();
        self.corner_b.towards.next = self.s1_to_b.q.val();
        self.corner_b.rim_u.next = self.rim_u.val();
        self.corner_b.rim_v.next = self.rim_v.val();
        self.corner_c.go.next = self.moves.val();
        self.corner_c.u.next = self.s1_u.q.val();
        self.corner_c.v.next = self.s1_v.q.val();
        self.corner_c.step.next = self.s1_step.q.val();
        self.corner_c.towards.next = self.s1_to_c.q.val();
        self.corner_c.rim_u.next = self.rim_u.val();
        self.corner_c.rim_v.next = self.rim_v.val();

        // s4_entered: over the leg, (c, a, b) from a to b and (b, c, a) from b to a; over the hypotenuse (a, b, c).
        self.leg_left.next = self.corner_c.corner.val();
        self.leg_right.next = self.corner_a.corner.val();
        if self.s3_reversed.q.val() {
            self.leg_left.next = self.corner_b.corner.val();
            self.leg_right.next = self.corner_c.corner.val();
        }
        if self.moves.val() {
            self.s2_valid.d.next = self.s1_valid.q.val();
            self.s2_reversed.d.next = self.s1_reversed.q.val();
            self.s2_enters.d.next = self.s1_enters.q.val();
            self.s2_leaves.d.next = self.s1_leaves.q.val();
            self.s2_walker.d.next = self.s1_walker.q.val();
            self.s3_valid.d.next = self.s2_valid.q.val();
            self.s3_reversed.d.next = self.s2_reversed.q.val();
            self.s3_enters.d.next = self.s2_enters.q.val();
            self.s3_leaves.d.next = self.s2_leaves.q.val();
            self.s3_walker.d.next = self.s2_walker.q.val();
            self.s4_valid.d.next = self.s3_valid.q.val();
            self.s4_a.d.next = self.corner_a.corner.val();
            self.s4_b.d.next = self.corner_b.corner.val();
            self.s4_c.d.next = self.corner_c.corner.val();
            self.s4_left.d.next = self.leg_left.val();
            self.s4_right.d.next = self.leg_right.val();
            if self.s3_enters.q.val() {
                self.s4_left.d.next = self.corner_a.corner.val();
                self.s4_right.d.next = self.corner_b.corner.val();
            }
            self.s4_reversed.d.next = self.s3_reversed.q.val();
            self.s4_enters.d.next = self.s3_enters.q.val();
            self.s4_leaves.d.next = self.s3_leaves.q.val();
            self.s4_walker.d.next = self.s3_walker.q.val();
        }

        // s5_follows
        self.follows.next = self.rung_left.read_data.val().get_bit(26)
            && self.rung_left.read_data.val().get_bits::<26>(0) == self.s4_left.q.val()
            && self.rung_right.read_data.val() == self.s4_right.q.val();
        self.long.next = self.s4_enters.q.val() && self.follows.val();
        if self.moves.val() {
            self.s5_valid.d.next = self.s4_valid.q.val();
            self.s5_a.d.next = self.s4_a.q.val();
            self.s5_b.d.next = self.s4_b.q.val();
            self.s5_c.d.next = self.s4_c.q.val();
            self.s5_reversed.d.next = self.s4_reversed.q.val();
            self.s5_long.d.next = self.long.val();
            self.s5_to_right.d.next = (self.long.val() || self.s4_leaves.q.val()) == self.s4_reversed.q.val();
            self.s5_starts.d.next = !self.follows.val();
            self.s5_walker.d.next = self.s4_walker.q.val();
        }

        // s6_vertex
        self.left.next = self.s5_c.q.val();
        self.right.next = self.s5_a.q.val();
        self.fresh.next = self.s5_b.q.val();
        if self.s5_long.q.val() {
            self.left.next = self.s5_a.q.val();
            self.right.next = self.s5_b.q.val();
            self.fresh.next = self.s5_c.q.val();
        } else if self.s5_reversed.q.val() {
            self.left.next = self.s5_b.q.val();
            self.right.next = self.s5_c.q.val();
            self.fresh.next = self.s5_a.q.val();
        }
        self.next_left.next = bit_cast_to::<U<27>>(self.fresh.val()) | 0x400_0000;
        self.next_right.next = self.right.val();
        if self.s5_to_right.q.val() {
            self.next_left.next = bit_cast_to::<U<27>>(self.left.val()) | 0x400_0000;
            self.next_right.next = self.fresh.val();
        }
        self.rung_left.enable.next = self.moves.val();
        self.rung_left.read_address.next = self.s3_walker.q.val();
        self.rung_right.enable.next = self.moves.val();
        self.rung_right.read_address.next = self.s3_walker.q.val();
        self.writes.next = self.moves.val() && self.s5_valid.q.val();
        self.rung_left.write_enable.next = self.writes.val();
        self.rung_left.write_address.next = self.s5_walker.q.val();
        self.rung_left.write_data.next = self.next_left.val();
        self.rung_right.write_enable.next = self.writes.val();
        self.rung_right.write_address.next = self.s5_walker.q.val();
        self.rung_right.write_data.next = self.next_right.val();
        if self.clear.val() {
            self.rung_left.write_enable.next = self.go.val();
            self.rung_left.write_address.next = self.clear_walker.val();
            self.rung_left.write_data.next = 0.into();
        }
        if self.moves.val() {
            self.s6_valid.d.next = self.s5_valid.q.val();
            self.s6_shows_left.d.next = self.s5_valid.q.val() && self.s5_starts.q.val();
            self.s6_left.d.next = self.left.val();
            self.s6_right.d.next = self.right.val();
            self.s6_fresh.d.next = self.fresh.val();
            self.s6_to_right.d.next = self.s5_to_right.q.val();
            self.s6_starts.d.next = self.s5_starts.q.val();
            self.s6_walker.d.next = self.s5_walker.q.val();
        } else if self.go.val() {
            self.s6_shows_left.d.next = false;
            self.s6_shows_right.d.next = self.s6_shows_left.q.val();
        }
        self.shown.next = self.s6_fresh.q.val();
        if self.s6_shows_left.q.val() {
            self.shown.next = self.s6_left.q.val();
        } else if self.s6_shows_right.q.val() {
            self.shown.next = self.s6_right.q.val();
        }
        self.busy.next = self.leaf.val()
            || self.s1_valid.q.val()
            || self.s2_valid.q.val()
            || self.s3_valid.q.val()
            || self.s4_valid.q.val()
            || self.s5_valid.q.val()
            || self.s6_valid.q.val();
        self.vertex.next = self.s6_valid.q.val();
        self.vertex_u.next = bit_cast_to::<U<C>>(self.shown.val().get_bits::<13>(0));
        self.vertex_v.next = bit_cast_to::<U<C>>(self.shown.val().get_bits::<13>(13));
        self.sends.next = self.s6_valid.q.val() && !self.s6_shows_left.q.val() && !self.s6_shows_right.q.val();
        self.to_left.next = self.s6_valid.q.val()
            && (self.s6_shows_left.q.val() || (!self.s6_shows_right.q.val() && !self.s6_to_right.q.val()));
        self.to_right.next = self.s6_valid.q.val()
            && (self.s6_shows_right.q.val() || (!self.s6_shows_left.q.val() && self.s6_to_right.q.val()));
        self.side.next = self.s6_to_right.q.val();
        self.begins.next = self.s6_starts.q.val();
        self.of_walker.next = self.s6_walker.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_strips")
    }
}

latches! { [const C: usize, const H: usize] BisectorStrips<C, H>: corner_a, corner_b, corner_c, rung_left, rung_right, s1_valid, s1_u, s1_v, s1_step, s1_to_a, s1_to_b, s1_to_c, s1_reversed, s1_enters, s1_leaves, s1_walker, s2_valid, s2_reversed, s2_enters, s2_leaves, s2_walker, s3_valid, s3_reversed, s3_enters, s3_leaves, s3_walker, s4_valid, s4_a, s4_b, s4_c, s4_left, s4_right, s4_reversed, s4_enters, s4_leaves, s4_walker, s5_valid, s5_a, s5_b, s5_c, s5_reversed, s5_long, s5_to_right, s5_starts, s5_walker, s6_valid, s6_shows_left, s6_shows_right, s6_left, s6_right, s6_fresh, s6_to_right, s6_starts, s6_walker }
