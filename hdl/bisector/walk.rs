// SPDX-License-Identifier: MIT OR Apache-2.0
//! Two walkers over the tree of triangles, and the errors that tell them where to split.
//!
//! While one walker decides, the other's error is read: each decides every second cycle.
//!
//! | stage     | what it does                                      |   Golden: models::bisector::golden   Error 0
//! | a_decide  | split: into the first half, the second is pushed; else a leaf leaves, and the top is popped; a walker
//! without work takes the bottom of the other's stack |
//! | b_read    | error and bound of the triangle visited, and its halves | Latency 2 a visit; holds while `go` is low
//!
//! The top of a stack stands in registers, the rest in a ring of 32; popping and stealing read the ring in the cycle of
//! the decision, so its word is there for the next one.

use super::{BisectorExcess, BisectorHalf};
use crate::prelude::*;

/// Walkers for lattices of up to 2^K steps, K <= 12, H = K + 2, A = 2 K + 1, errors of `E` <= 16 bits.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorWalk<const H: usize, const A: usize, const E: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// Both walkers begin at their roots, whatever they were at; wins over `go`.
    pub start: Input<Bit>,
    pub levels: Input<U<4>>,
    pub mirrored: Input<Bit>,
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub base: Input<U<E>>,
    pub slope: Input<U<16>>,
    pub eye_u: Input<U<H>>,
    pub eye_v: Input<U<H>>,
    pub write: Input<Bit>,
    pub write_address: Input<U<A>>,
    pub write_data: Input<U<E>>,
    pub leaf: Output<Bit>,
    pub leaf_u: Output<U<H>>,
    pub leaf_v: Output<U<H>>,
    pub leaf_level: Output<U<4>>,
    pub leaf_direction: Output<U<3>>,
    /// It is entered, and left, over the hypotenuse.
    pub leaf_enters_long: Output<Bit>,
    pub leaf_leaves_long: Output<Bit>,
    pub leaf_walker: Output<Bit>,
    /// Neither walker has anything left.
    pub idle: Output<Bit>,
    errors: Ram<U<E>, A>,
    product: Multiplier<17, 16, 33>,
    stack_u: Ram<U<H>, 6>,
    stack_v: Ram<U<H>, 6>,
    stack_address: Ram<U<A>, 6>,
    stack_excess: Ram<U<H>, 6>,
    stack_shape: Ram<U<9>, 6>,
    first: BisectorHalf<H, A>,
    second: BisectorHalf<H, A>,
    first_excess: BisectorExcess<H>,
    second_excess: BisectorExcess<H>,
    /// The walker at a_decide.
    turn: Register<Bit>,
    // Shapes are: level, direction << 4, enters over the hypotenuse << 7, leaves over it << 8.
    a_active: Register<Bit>,
    a_length: Register<U<6>>,
    a_bottom: DataRegister<U<5>>,
    a_u: DataRegister<U<H>>,
    a_v: DataRegister<U<H>>,
    a_shape: DataRegister<U<9>>,
    a_error: DataRegister<U<E>>,
    a_first_u: DataRegister<U<H>>,
    a_first_v: DataRegister<U<H>>,
    a_first_shape: DataRegister<U<9>>,
    a_first_address: DataRegister<U<A>>,
    a_first_dead: DataRegister<Bit>,
    a_second_u: DataRegister<U<H>>,
    a_second_v: DataRegister<U<H>>,
    a_second_shape: DataRegister<U<9>>,
    a_second_address: DataRegister<U<A>>,
    a_second_dead: DataRegister<Bit>,
    a_top_u: DataRegister<U<H>>,
    a_top_v: DataRegister<U<H>>,
    a_top_shape: DataRegister<U<9>>,
    a_top_address: DataRegister<U<A>>,
    a_top_excess: DataRegister<U<H>>,
    b_active: Register<Bit>,
    b_length: Register<U<6>>,
    b_bottom: DataRegister<U<5>>,
    b_u: DataRegister<U<H>>,
    b_v: DataRegister<U<H>>,
    b_shape: DataRegister<U<9>>,
    b_excess: DataRegister<U<H>>,
    /// The ring's word becomes the top.
    b_refills: DataRegister<Bit>,
    b_top_u: DataRegister<U<H>>,
    b_top_v: DataRegister<U<H>>,
    b_top_shape: DataRegister<U<9>>,
    b_top_address: DataRegister<U<A>>,
    b_top_excess: DataRegister<U<H>>,
    pitch: Constant<U<4>>,
    bound: Wire<U<26>>,
    splits: Wire<Bit>,
    pushes: Wire<Bit>,
    into_first: Wire<Bit>,
    into_second: Wire<Bit>,
    pops: Wire<Bit>,
    steals: Wire<Bit>,
    holds_some: Wire<Bit>,
    one_stolen: Wire<U<6>>,
    next_address: Wire<U<A>>,
    above: Wire<U<5>>,
    ring_read: Wire<U<6>>,
    ring_write: Wire<U<6>>,
    own: Wire<U<6>>,
    other: Wire<U<6>>,
    level: Wire<U<4>>,
    direction: Wire<U<3>>,
    near_turn: Wire<U<3>>,
    far_turn: Wire<U<3>>,
    first_shape: Wire<U<9>>,
    second_shape: Wire<U<9>>,
    root: Wire<U<H>>,
    middle: Wire<U<A>>,
    root_shape: Wire<U<9>>,
    across_shape: Wire<U<9>>,
}

impl<const H: usize, const A: usize, const E: usize> Default for BisectorWalk<H, A, E> {
    fn default() -> Self {
        let side = (1 << (H - 2)) + 1;
        Self {
            errors: Ram::new(side * side),
            pitch: Constant::new(U::new(H as i64 - 2)),
            clock: Input::default(),
            go: Input::default(),
            start: Input::default(),
            levels: Input::default(),
            mirrored: Input::default(),
            rim_u: Input::default(),
            rim_v: Input::default(),
            base: Input::default(),
            slope: Input::default(),
            eye_u: Input::default(),
            eye_v: Input::default(),
            write: Input::default(),
            write_address: Input::default(),
            write_data: Input::default(),
            leaf: Output::default(),
            leaf_u: Output::default(),
            leaf_v: Output::default(),
            leaf_level: Output::default(),
            leaf_direction: Output::default(),
            leaf_enters_long: Output::default(),
            leaf_leaves_long: Output::default(),
            leaf_walker: Output::default(),
            idle: Output::default(),
            product: Multiplier::default(),
            stack_u: Ram::default(),
            stack_v: Ram::default(),
            stack_address: Ram::default(),
            stack_excess: Ram::default(),
            stack_shape: Ram::default(),
            first: BisectorHalf::default(),
            second: BisectorHalf::default(),
            first_excess: BisectorExcess::default(),
            second_excess: BisectorExcess::default(),
            turn: Register::default(),
            a_active: Register::default(),
            a_length: Register::default(),
            a_bottom: DataRegister::default(),
            a_u: DataRegister::default(),
            a_v: DataRegister::default(),
            a_shape: DataRegister::default(),
            a_error: DataRegister::default(),
            a_first_u: DataRegister::default(),
            a_first_v: DataRegister::default(),
            a_first_shape: DataRegister::default(),
            a_first_address: DataRegister::default(),
            a_first_dead: DataRegister::default(),
            a_second_u: DataRegister::default(),
            a_second_v: DataRegister::default(),
            a_second_shape: DataRegister::default(),
            a_second_address: DataRegister::default(),
            a_second_dead: DataRegister::default(),
            a_top_u: DataRegister::default(),
            a_top_v: DataRegister::default(),
            a_top_shape: DataRegister::default(),
            a_top_address: DataRegister::default(),
            a_top_excess: DataRegister::default(),
            b_active: Register::default(),
            b_length: Register::default(),
            b_bottom: DataRegister::default(),
            b_u: DataRegister::default(),
            b_v: DataRegister::default(),
            b_shape: DataRegister::default(),
            b_excess: DataRegister::default(),
            b_refills: DataRegister::default(),
            b_top_u: DataRegister::default(),
            b_top_v: DataRegister::default(),
            b_top_shape: DataRegister::default(),
            b_top_address: DataRegister::default(),
            b_top_excess: DataRegister::default(),
            bound: Wire::default(),
            splits: Wire::default(),
            pushes: Wire::default(),
            into_first: Wire::default(),
            into_second: Wire::default(),
            pops: Wire::default(),
            steals: Wire::default(),
            holds_some: Wire::default(),
            one_stolen: Wire::default(),
            next_address: Wire::default(),
            above: Wire::default(),
            ring_read: Wire::default(),
            ring_write: Wire::default(),
            own: Wire::default(),
            other: Wire::default(),
            level: Wire::default(),
            direction: Wire::default(),
            near_turn: Wire::default(),
            far_turn: Wire::default(),
            first_shape: Wire::default(),
            second_shape: Wire::default(),
            root: Wire::default(),
            middle: Wire::default(),
            root_shape: Wire::default(),
            across_shape: Wire::default(),
        }
    }
}

impl<const H: usize, const A: usize, const E: usize> Logic for BisectorWalk<H, A, E> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, errors, product, stack_u, stack_v, stack_address, stack_excess, stack_shape);
        dff_setup!(self, clock, turn, a_active, a_length, a_bottom, a_u, a_v, a_shape, a_error);
        dff_setup!(self, clock, a_first_u, a_first_v, a_first_shape, a_first_address, a_first_dead);
        dff_setup!(self, clock, a_second_u, a_second_v, a_second_shape, a_second_address, a_second_dead);
        dff_setup!(self, clock, a_top_u, a_top_v, a_top_shape, a_top_address, a_top_excess);
        dff_setup!(self, clock, b_active, b_length, b_bottom, b_u, b_v, b_shape, b_excess, b_refills);
        dff_setup!(self, clock, b_top_u, b_top_v, b_top_shape, b_top_address, b_top_excess);

        // a_decide. The bound has 23 bits at most: 16 of the base, 16 + 14 - 8 of the product.
        self.bound.next = bit_cast_to::<U<26>>(self.base.val()) + bit_cast_to::<U<26>>(self.product.p.val() >> 8);
        self.splits.next = self.a_active.q.val()
            && self.a_shape.q.val().get_bits::<4>(0) != 0
            && bit_cast_to::<U<26>>(self.a_error.q.val()) > self.bound.val();
        self.into_first.next = self.splits.val() && !self.a_first_dead.q.val();
        self.into_second.next = self.splits.val() && self.a_first_dead.q.val() && !self.a_second_dead.q.val();
        self.pushes.next = self.into_first.val() && !self.a_second_dead.q.val();
        self.holds_some.next = self.a_length.q.val() != 0;
        self.pops.next = !self.into_first.val() && !self.into_second.val() && self.holds_some.val();
        self.steals.next =
            !self.into_first.val() && !self.into_second.val() && !self.holds_some.val() && self.b_length.q.val() > 1;
        self.leaf.next = self.a_active.q.val() && !self.splits.val();
        self.leaf_u.next = self.a_u.q.val();
        self.leaf_v.next = self.a_v.q.val();
        self.leaf_level.next = self.a_shape.q.val().get_bits::<4>(0);
        self.leaf_direction.next = self.a_shape.q.val().get_bits::<3>(4);
        self.leaf_enters_long.next = self.a_shape.q.val().get_bit(7);
        self.leaf_leaves_long.next = self.a_shape.q.val().get_bit(8);
        self.leaf_walker.next = self.turn.q.val();
        self.idle.next = !self.a_active.q.val()
            && !self.b_active.q.val()
            && self.a_length.q.val() == 0
            && self.b_length.q.val() == 0;

        self.first_excess.u.next = self.a_first_u.q.val();
        self.first_excess.v.next = self.a_first_v.q.val();
        self.first_excess.level.next = self.a_first_shape.q.val().get_bits::<4>(0);
        self.first_excess.diagonal.next = self.a_first_shape.q.val().get_bit(4);
        self.first_excess.rim_u.next = self.rim_u.val();
        self.first_excess.rim_v.next = self.rim_v.val();
        self.first_excess.eye_u.next = self.eye_u.val();
        self.first_excess.eye_v.next = self.eye_v.val();
        self.second_excess.u.next = self.a_second_u.q.val();
        self.second_excess.v.next = self.a_second_v.q.val();
        self.second_excess.level.next = self.a_second_shape.q.val().get_bits::<4>(0);
        self.second_excess.diagonal.next = self.a_second_shape.q.val().get_bit(4);
        self.second_excess.rim_u.next = self.rim_u.val();
        self.second_excess.rim_v.next = self.rim_v.val();
        self.second_excess.eye_u.next = self.eye_u.val();
        self.second_excess.eye_v.next = self.eye_v.val();

        // Rings of the two walkers: bit 5 of the address.
        self.own.next = bit_cast_to::<U<6>>(self.turn.q.val()) << 5;
        self.other.next = bit_cast_to::<U<6>>(!self.turn.q.val()) << 5;
        // The top would be word bottom + length - 1; the one under it is read.
        self.above.next = self.a_bottom.q.val() + bit_cast_to::<U<5>>(self.a_length.q.val());
        self.ring_read.next = self.own.val() | bit_cast_to::<U<6>>(self.above.val() - 2);
        if self.steals.val() {
            self.ring_read.next = self.other.val() | bit_cast_to::<U<6>>(self.b_bottom.q.val());
        }
        self.ring_write.next = self.own.val() | bit_cast_to::<U<6>>(self.above.val() - 1);
        self.stack_u.enable.next = self.go.val();
        self.stack_u.read_address.next = self.ring_read.val();
        self.stack_u.write_enable.next = self.go.val() && self.pushes.val();
        self.stack_u.write_address.next = self.ring_write.val();
        self.stack_u.write_data.next = self.a_top_u.q.val();
        self.stack_v.enable.next = self.go.val();
        self.stack_v.read_address.next = self.ring_read.val();
        self.stack_v.write_enable.next = self.go.val() && self.pushes.val();
        self.stack_v.write_address.next = self.ring_write.val();
        self.stack_v.write_data.next = self.a_top_v.q.val();
        self.stack_address.enable.next = self.go.val();
        self.stack_address.read_address.next = self.ring_read.val();
        self.stack_address.write_enable.next = self.go.val() && self.pushes.val();
        self.stack_address.write_address.next = self.ring_write.val();
        self.stack_address.write_data.next = self.a_top_address.q.val();
        self.stack_excess.enable.next = self.go.val();
        self.stack_excess.read_address.next = self.ring_read.val();
        self.stack_excess.write_enable.next = self.go.val() && self.pushes.val();
        self.stack_excess.write_address.next = self.ring_write.val();
        self.stack_excess.write_data.next = self.a_top_excess.q.val();
        self.stack_shape.enable.next = self.go.val();
        self.stack_shape.read_address.next = self.ring_read.val();
        self.stack_shape.write_enable.next = self.go.val() && self.pushes.val();
        self.stack_shape.write_address.next = self.ring_write.val();
        self.stack_shape.write_data.next = self.a_top_shape.q.val();
        self.next_address.next = self.a_top_address.q.val();
        if self.into_first.val() {
            self.next_address.next = self.a_first_address.q.val();
        } else if self.into_second.val() {
            self.next_address.next = self.a_second_address.q.val();
        }
        self.errors.enable.next = self.go.val();
        self.errors.read_address.next = self.next_address.val();
        self.errors.write_enable.next = self.write.val();
        self.errors.write_address.next = self.write_address.val();
        self.errors.write_data.next = self.write_data.val();

        // b_read. Excess has at most 14 bits.
        self.product.enable.next = self.go.val();
        self.product.a.next = bit_cast_to::<S<17>>(self.slope.val());
        self.product.b.next = bit_cast_to::<S<16>>(self.b_excess.q.val());
        self.level.next = self.b_shape.q.val().get_bits::<4>(0);
        self.direction.next = self.b_shape.q.val().get_bits::<3>(4);
        // Every second generation is walked from b to a.
        self.near_turn.next = 5.into();
        self.far_turn.next = 3.into();
        if !self.direction.val().get_bit(0) {
            self.near_turn.next = 3.into();
            self.far_turn.next = 5.into();
        }
        self.first.u.next = self.b_u.q.val();
        self.first.v.next = self.b_v.q.val();
        self.first.level.next = self.level.val();
        self.first.direction.next = self.direction.val();
        self.first.turn.next = self.near_turn.val();
        self.first.rim_u.next = self.rim_u.val();
        self.first.rim_v.next = self.rim_v.val();
        self.second.u.next = self.b_u.q.val();
        self.second.v.next = self.b_v.q.val();
        self.second.level.next = self.level.val();
        self.second.direction.next = self.direction.val();
        self.second.turn.next = self.far_turn.val();
        self.second.rim_u.next = self.rim_u.val();
        self.second.rim_v.next = self.rim_v.val();
        self.first_shape.next = bit_cast_to::<U<9>>(self.first.half_level.val())
            | (bit_cast_to::<U<9>>(self.first.half_direction.val()) << 4)
            | (bit_cast_to::<U<9>>(!self.b_shape.q.val().get_bit(7)) << 7);
        self.second_shape.next = bit_cast_to::<U<9>>(self.second.half_level.val())
            | (bit_cast_to::<U<9>>(self.second.half_direction.val()) << 4)
            | (bit_cast_to::<U<9>>(!self.b_shape.q.val().get_bit(8)) << 8);
        self.one_stolen.next = bit_cast_to::<U<6>>(self.steals.val());

        if self.go.val() {
            self.turn.d.next = !self.turn.q.val();
            // From a to b.
            self.b_active.d.next = self.into_first.val() || self.into_second.val() || self.pops.val();
            self.b_u.d.next = self.a_top_u.q.val();
            self.b_v.d.next = self.a_top_v.q.val();
            self.b_shape.d.next = self.a_top_shape.q.val();
            self.b_excess.d.next = self.a_top_excess.q.val();
            if self.into_first.val() {
                self.b_u.d.next = self.a_first_u.q.val();
                self.b_v.d.next = self.a_first_v.q.val();
                self.b_shape.d.next = self.a_first_shape.q.val();
                self.b_excess.d.next = self.first_excess.excess.val();
            } else if self.into_second.val() {
                self.b_u.d.next = self.a_second_u.q.val();
                self.b_v.d.next = self.a_second_v.q.val();
                self.b_shape.d.next = self.a_second_shape.q.val();
                self.b_excess.d.next = self.second_excess.excess.val();
            }
            self.b_bottom.d.next = self.a_bottom.q.val();
            self.b_length.d.next = self.a_length.q.val();
            self.b_refills.d.next = self.pops.val() || self.steals.val();
            if self.pops.val() {
                self.b_length.d.next = self.a_length.q.val() - 1;
            } else if self.pushes.val() {
                self.b_length.d.next = self.a_length.q.val() + 1;
            } else if self.steals.val() {
                self.b_length.d.next = 1.into();
            }
            self.b_top_u.d.next = self.a_top_u.q.val();
            self.b_top_v.d.next = self.a_top_v.q.val();
            self.b_top_shape.d.next = self.a_top_shape.q.val();
            self.b_top_address.d.next = self.a_top_address.q.val();
            self.b_top_excess.d.next = self.a_top_excess.q.val();
            if self.pushes.val() {
                self.b_top_u.d.next = self.a_second_u.q.val();
                self.b_top_v.d.next = self.a_second_v.q.val();
                self.b_top_shape.d.next = self.a_second_shape.q.val();
                self.b_top_address.d.next = self.a_second_address.q.val();
                self.b_top_excess.d.next = self.second_excess.excess.val();
            }
            // From b to a.
            self.a_active.d.next = self.b_active.q.val();
            self.a_length.d.next = self.b_length.q.val() - self.one_stolen.val();
            self.a_bottom.d.next = self.b_bottom.q.val() + bit_cast_to::<U<5>>(self.one_stolen.val());
            self.a_u.d.next = self.b_u.q.val();
            self.a_v.d.next = self.b_v.q.val();
            self.a_shape.d.next = self.b_shape.q.val();
            self.a_error.d.next = self.errors.read_data.val();
            self.a_first_u.d.next = self.first.half_u.val();
            self.a_first_v.d.next = self.first.half_v.val();
            self.a_first_shape.d.next = self.first_shape.val();
            self.a_first_address.d.next = self.first.address.val();
            self.a_first_dead.d.next = self.first.dead.val();
            self.a_second_u.d.next = self.second.half_u.val();
            self.a_second_v.d.next = self.second.half_v.val();
            self.a_second_shape.d.next = self.second_shape.val();
            self.a_second_address.d.next = self.second.address.val();
            self.a_second_dead.d.next = self.second.dead.val();
            self.a_top_u.d.next = self.b_top_u.q.val();
            self.a_top_v.d.next = self.b_top_v.q.val();
            self.a_top_shape.d.next = self.b_top_shape.q.val();
            self.a_top_address.d.next = self.b_top_address.q.val();
            self.a_top_excess.d.next = self.b_top_excess.q.val();
            if self.b_refills.q.val() {
                self.a_top_u.d.next = self.stack_u.read_data.val();
                self.a_top_v.d.next = self.stack_v.read_data.val();
                self.a_top_shape.d.next = self.stack_shape.read_data.val();
                self.a_top_address.d.next = self.stack_address.read_data.val();
                self.a_top_excess.d.next = self.stack_excess.read_data.val();
            }
        }

        // A root has no excess, by definition. Its midpoint is the lattice's.
        self.root.next = 1.into();
        self.middle.next = bit_cast_to::<U<A>>((self.root.val() << self.levels.val()) >> 1);
        self.root_shape.next = bit_cast_to::<U<9>>(self.levels.val()) | 0x70;
        self.across_shape.next = bit_cast_to::<U<9>>(self.levels.val()) | 0x30;
        if self.mirrored.val() {
            self.root_shape.next = bit_cast_to::<U<9>>(self.levels.val()) | 0x10;
            self.across_shape.next = bit_cast_to::<U<9>>(self.levels.val()) | 0x50;
        }
        if self.start.val() {
            self.turn.d.next = false;
            self.a_active.d.next = false;
            self.a_length.d.next = 1.into();
            self.a_bottom.d.next = 0.into();
            self.a_top_u.d.next = self.root.val() << self.levels.val();
            self.a_top_v.d.next = self.root.val() << self.levels.val();
            self.a_top_shape.d.next = self.root_shape.val();
            self.a_top_address.d.next = (self.middle.val() << self.pitch.val()) + self.middle.val() + self.middle.val();
            self.a_top_excess.d.next = 0.into();
            self.b_active.d.next = false;
            self.b_length.d.next = 1.into();
            self.b_bottom.d.next = 0.into();
            self.b_refills.d.next = false;
            self.b_top_u.d.next = self.root.val() << self.levels.val();
            self.b_top_v.d.next = self.root.val() << self.levels.val();
            self.b_top_shape.d.next = self.across_shape.val();
            self.b_top_address.d.next = (self.middle.val() << self.pitch.val()) + self.middle.val() + self.middle.val();
            self.b_top_excess.d.next = 0.into();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_walk")
    }
}

latches! { [const H: usize, const A: usize, const E: usize] BisectorWalk<H, A, E>: errors, product, stack_u, stack_v, stack_address, stack_excess, stack_shape, turn, a_active, a_length, a_bottom, a_u, a_v, a_shape, a_error, a_first_u, a_first_v, a_first_shape, a_first_address, a_first_dead, a_second_u, a_second_v, a_second_shape, a_second_address, a_second_dead, a_top_u, a_top_v, a_top_shape, a_top_address, a_top_excess, b_active, b_length, b_bottom, b_u, b_v, b_shape, b_excess, b_refills, b_top_u, b_top_v, b_top_shape, b_top_address, b_top_excess }
