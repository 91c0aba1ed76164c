// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves to vertices: the corners of a leaf, and which of them its strip does not have yet.
//!
//! | stage      | what it does                                          |   Golden: models::bisector::golden   Error 0
//! | s1_leaf    | takes a leaf                                          |
//! | s2_corners | a, b, c in lattice steps, clamped to the map          |   Latency 2; holds while `go` is low
//! | s3_vertex  | the new vertex, and before it left and right where a strip begins: three cycles, `waits` the first two |
//!
//! A leaf begins a strip unless the edge it is entered by is the one that the walker's last leaf left.

use super::BisectorCorner;
use crate::prelude::*;

/// Strips for lattices of up to 2^K steps, C = K + 1, H = K + 2.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorStrips<const C: usize, const H: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// Forgets the strips of both walkers.
    pub clear: Input<Bit>,
    pub leaf: Input<Bit>,
    pub u: Input<U<H>>,
    pub v: Input<U<H>>,
    pub level: Input<U<4>>,
    pub direction: Input<U<3>>,
    pub enters_long: Input<Bit>,
    pub leaves_long: Input<Bit>,
    pub walker: Input<Bit>,
    /// Last column and row of the map, in half steps.
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    /// No leaf may come.
    pub waits: Output<Bit>,
    pub busy: Output<Bit>,
    pub vertex: Output<Bit>,
    pub vertex_u: Output<U<C>>,
    pub vertex_v: Output<U<C>>,
    /// 0 left, 1 right, 2 new.
    pub role: Output<U<2>>,
    /// The new vertex takes the place of the right one.
    pub side: Output<Bit>,
    pub begins: Output<Bit>,
    pub of_walker: Output<Bit>,
    s1_valid: Register<Bit>,
    s1_u: DataRegister<U<H>>,
    s1_v: DataRegister<U<H>>,
    s1_level: DataRegister<U<4>>,
    s1_direction: DataRegister<U<3>>,
    s1_enters: DataRegister<Bit>,
    s1_leaves: DataRegister<Bit>,
    s1_walker: DataRegister<Bit>,
    s2_valid: Register<Bit>,
    s2_phase: Register<U<2>>,
    s2_a: DataRegister<U<26>>,
    s2_b: DataRegister<U<26>>,
    s2_c: DataRegister<U<26>>,
    s2_reversed: DataRegister<Bit>,
    s2_enters: DataRegister<Bit>,
    s2_leaves: DataRegister<Bit>,
    s2_walker: DataRegister<Bit>,
    /// The last edges: left << 26 | right, of walker 0 and walker 1, and whether there is one.
    rung_0: DataRegister<U<52>>,
    rung_1: DataRegister<U<52>>,
    has_0: Register<Bit>,
    has_1: Register<Bit>,
    corner_a: BisectorCorner<H>,
    corner_b: BisectorCorner<H>,
    corner_c: BisectorCorner<H>,
    leg_left: Wire<U<26>>,
    leg_right: Wire<U<26>>,
    leg_new: Wire<U<26>>,
    entered: Wire<U<52>>,
    rung: Wire<U<52>>,
    has: Wire<Bit>,
    follows: Wire<Bit>,
    starts: Wire<Bit>,
    long: Wire<Bit>,
    left: Wire<U<26>>,
    right: Wire<U<26>>,
    fresh: Wire<U<26>>,
    to_right: Wire<Bit>,
    shown: Wire<U<26>>,
    shown_role: Wire<U<2>>,
    last_phase: Wire<Bit>,
    takes: Wire<Bit>,
    next_rung: Wire<U<52>>,
}

impl<const C: usize, const H: usize> Logic for BisectorStrips<C, H> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_valid, s1_u, s1_v, s1_level, s1_direction, s1_enters, s1_leaves, s1_walker);
        dff_setup!(self, clock, s2_valid, s2_phase, s2_a, s2_b, s2_c, s2_reversed, s2_enters, s2_leaves);
        dff_setup!(self, clock, s2_walker, rung_0, rung_1, has_0, has_1);

        // s3_vertex: over the leg, (c, a, b) from a to b and (b, c, a) from b to a; over the hypotenuse (a, b, c).
        self.leg_left.next = self.s2_c.q.val();
        self.leg_right.next = self.s2_a.q.val();
        self.leg_new.next = self.s2_b.q.val();
        if self.s2_reversed.q.val() {
            self.leg_left.next = self.s2_b.q.val();
            self.leg_right.next = self.s2_c.q.val();
            self.leg_new.next = self.s2_a.q.val();
        }
        self.entered.next =
            (bit_cast_to::<U<52>>(self.leg_left.val()) << 26) | bit_cast_to::<U<52>>(self.leg_right.val());
        if self.s2_enters.q.val() {
            self.entered.next =
                (bit_cast_to::<U<52>>(self.s2_a.q.val()) << 26) | bit_cast_to::<U<52>>(self.s2_b.q.val());
        }
        self.rung.next = self.rung_0.q.val();
        self.has.next = self.has_0.q.val();
        if self.s2_walker.q.val() {
            self.rung.next = self.rung_1.q.val();
            self.has.next = self.has_1.q.val();
        }
        self.follows.next = self.has.val() && self.rung.val() == self.entered.val();
        // What the first of three cycles found holds in the other two.
        self.starts.next = !self.follows.val() || self.s2_phase.q.val() != 0;
        self.long.next = self.s2_enters.q.val() && !self.starts.val();
        self.left.next = self.leg_left.val();
        self.right.next = self.leg_right.val();
        self.fresh.next = self.leg_new.val();
        if self.long.val() {
            self.left.next = self.s2_a.q.val();
            self.right.next = self.s2_b.q.val();
            self.fresh.next = self.s2_c.q.val();
        }
        self.to_right.next = (self.long.val() || self.s2_leaves.q.val()) == self.s2_reversed.q.val();
        self.last_phase.next = !self.starts.val() || self.s2_phase.q.val() == 2;
        self.shown.next = self.fresh.val();
        self.shown_role.next = 2.into();
        if !self.last_phase.val() {
            self.shown_role.next = self.s2_phase.q.val();
            self.shown.next = self.left.val();
            if self.s2_phase.q.val() == 1 {
                self.shown.next = self.right.val();
            }
        }
        self.waits.next = self.s2_valid.q.val() && !self.last_phase.val();
        self.busy.next = self.s1_valid.q.val() || self.s2_valid.q.val();
        self.vertex.next = self.s2_valid.q.val();
        self.vertex_u.next = bit_cast_to::<U<C>>(self.shown.val().get_bits::<13>(0));
        self.vertex_v.next = bit_cast_to::<U<C>>(self.shown.val().get_bits::<13>(13));
        self.role.next = self.shown_role.val();
        self.side.next = self.to_right.val();
        self.begins.next = self.starts.val();
        self.of_walker.next = self.s2_walker.q.val();
        // The rung changes with the new vertex, and not before: the comparison needs the old one for one cycle only.
        self.next_rung.next = (bit_cast_to::<U<52>>(self.fresh.val()) << 26) | bit_cast_to::<U<52>>(self.right.val());
        if self.to_right.val() {
            self.next_rung.next =
                (bit_cast_to::<U<52>>(self.left.val()) << 26) | bit_cast_to::<U<52>>(self.fresh.val());
        }
        if self.go.val() && self.s2_valid.q.val() {
            if self.last_phase.val() {
                self.s2_phase.d.next = 0.into();
                if self.s2_walker.q.val() {
                    self.rung_1.d.next = self.next_rung.val();
                    self.has_1.d.next = true;
                } else {
                    self.rung_0.d.next = self.next_rung.val();
                    self.has_0.d.next = true;
                }
            } else {
                self.s2_phase.d.next = self.s2_phase.q.val() + 1;
            }
        }
        if self.clear.val() {
            self.has_0.d.next = false;
            self.has_1.d.next = false;
        }

        // s2_corners
        self.corner_a.u.next = self.s1_u.q.val();
        self.corner_a.v.next = self.s1_v.q.val();
        self.corner_a.level.next = self.s1_level.q.val();
        self.corner_a.towards.next = self.s1_direction.q.val() + 2;
        self.corner_a.rim_u.next = self.rim_u.val();
        self.corner_a.rim_v.next = self.rim_v.val();
        self.corner_b.u.next = self.s1_u.q.val();
        self.corner_b.v.next = self.s1_v.q.val();
        self.corner_b.level.next = self.s1_level.q.val();
        self.corner_b.towards.next = self.s1_direction.q.val() + 6;
        self.corner_b.rim_u.next = self.rim_u.val();
        self.corner_b.rim_v.next = self.rim_v.val();
        self.corner_c.u.next = self.s1_u.q.val();
        self.corner_c.v.next = self.s1_v.q.val();
        self.corner_c.level.next = self.s1_level.q.val();
        self.corner_c.towards.next = self.s1_direction.q.val();
        self.corner_c.rim_u.next = self.rim_u.val();
        self.corner_c.rim_v.next = self.rim_v.val();
        self.takes.next = self.go.val() && !self.waits.val();
        if self.takes.val() {
            self.s1_valid.d.next = self.leaf.val();
            self.s1_u.d.next = self.u.val();
            self.s1_v.d.next = self.v.val();
            self.s1_level.d.next = self.level.val();
            self.s1_direction.d.next = self.direction.val();
            self.s1_enters.d.next = self.enters_long.val();
            self.s1_leaves.d.next = self.leaves_long.val();
            self.s1_walker.d.next = self.walker.val();
            self.s2_valid.d.next = self.s1_valid.q.val();
            self.s2_a.d.next = self.corner_a.corner.val();
            self.s2_b.d.next = self.corner_b.corner.val();
            self.s2_c.d.next = self.corner_c.corner.val();
            self.s2_reversed.d.next = !self.s1_direction.q.val().get_bit(0);
            self.s2_enters.d.next = self.s1_enters.q.val();
            self.s2_leaves.d.next = self.s1_leaves.q.val();
            self.s2_walker.d.next = self.s1_walker.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_strips")
    }
}

latches! { [const C: usize, const H: usize] BisectorStrips<C, H>: s1_valid, s1_u, s1_v, s1_level, s1_direction, s1_enters, s1_leaves, s1_walker, s2_valid, s2_phase, s2_a, s2_b, s2_c, s2_reversed, s2_enters, s2_leaves, s2_walker, rung_0, rung_1, has_0, has_1 }
