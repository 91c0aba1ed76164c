// SPDX-License-Identifier: MIT OR Apache-2.0
//! Eight walkers over the tree of triangles, and the errors that tell them where to split.
//!
//! The walkers go round in a loop of eight stages, one in each, so one of them decides in every cycle, and each in every eighth.
//!
//! | stage      | what it does                                     |   Golden: models::bisector::golden   Error 0
//! | s0_node    | the triangle that a walker visits; the memory takes its midpoint | Holds while `go` is low
//! | s1_length  | whether the walker's stack is empty, and whether it can spare its bottom; distances from the eye |
//! | s2_search  | the place on the stack that comes next: the own top, or for a walker without work the bottom of the first walker
//! ahead, in s2, s4 or s6, that can spare it; distances less reach |
//! | s3_excess  | excess; directions of the halves                  |
//! | s4_product | slope times excess                                |
//! | s5_bound   | base and product; the error; the halves' midpoints |
//! | s6_over    | whether the error is over the bound, and whether a half is dead |
//! | s7_decided | split or leaf; the halves, and the triangle from the stack |
//! | s0_node    | the first half, and the second one is pushed; else that from the stack |
//!
//! A stack is a ring of 32 in a memory for all. What is pushed is written on the way from s7 to s0, and read from s4 on. Walkers are born one a cycle, two of them at a root.

use super::{BisectorExcess, BisectorHalf, BisectorPlane};
use crate::prelude::*;

/// Walkers for lattices of up to 2^K steps, K <= 12, C = K + 1, H = K + 2, A = 2 K - 2, errors of `E` <= 16 bits.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorWalk<const C: usize, const H: usize, const A: usize, const E: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// The same, for the memories; they may move while nothing is under way.
    pub go_0: Input<Bit>,
    pub go_1: Input<Bit>,
    pub go_2: Input<Bit>,
    pub go_3: Input<Bit>,
    /// All walkers begin anew, if `go`; they have to be idle.
    pub start: Input<Bit>,
    pub levels: Input<U<4>>,
    /// 2^levels.
    pub side: Input<U<C>>,
    pub mirrored: Input<Bit>,
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub base: Input<U<E>>,
    pub slope: Input<U<16>>,
    pub eye_u: Input<U<H>>,
    pub eye_v: Input<U<H>>,
    pub write: Input<Bit>,
    pub write_u: Input<U<C>>,
    pub write_v: Input<U<C>>,
    pub write_data: Input<U<E>>,
    pub leaf: Output<Bit>,
    pub leaf_u: Output<U<H>>,
    pub leaf_v: Output<U<H>>,
    /// Level, direction << 4, entered over the hypotenuse << 7, left over it << 8.
    pub leaf_shape: Output<U<9>>,
    pub leaf_walker: Output<U<3>>,
    /// A walker is born, if `go`.
    pub births: Output<Bit>,
    pub born_walker: Output<U<3>>,
    /// No walker has anything left.
    pub idle: Output<Bit>,
    errors: BisectorPlane<C, H, A, E>,
    beyond: BisectorExcess<H>,
    product: Multiplier<17, 16, 33>,
    first: BisectorHalf<H>,
    second: BisectorHalf<H>,
    stack_u: RegisteredRam<U<H>, 8>,
    stack_v: RegisteredRam<U<H>, 8>,
    stack_shape: RegisteredRam<U<9>, 8>,
    walking: Register<Bit>,
    birthing: Register<Bit>,
    born: Register<U<3>>,
    /// Walkers in succession that were without work, up to eight.
    quiet: Register<U<4>>,
    done: Register<Bit>,
    s0_active: Register<Bit>,
    s0_walker: DataRegister<U<3>>,
    s0_root: DataRegister<Bit>,
    s0_u: DataRegister<U<H>>,
    s0_v: DataRegister<U<H>>,
    s0_shape: DataRegister<U<9>>,
    /// A stack is from bottom to before top.
    s0_top: Register<U<5>>,
    s0_bottom: Register<U<5>>,
    s1_active: Register<Bit>,
    s1_walker: DataRegister<U<3>>,
    s1_root: DataRegister<Bit>,
    s1_u: DataRegister<U<H>>,
    s1_v: DataRegister<U<H>>,
    s1_shape: DataRegister<U<9>>,
    s1_top: DataRegister<U<5>>,
    s1_bottom: DataRegister<U<5>>,
    s1_next: DataRegister<U<5>>,
    s1_holds: DataRegister<Bit>,
    s1_wants: DataRegister<Bit>,
    s1_spare: DataRegister<Bit>,
    s1_step: DataRegister<U<H>>,
    s2_active: Register<Bit>,
    s2_walker: DataRegister<U<3>>,
    s2_root: DataRegister<Bit>,
    s2_u: DataRegister<U<H>>,
    s2_v: DataRegister<U<H>>,
    s2_shape: DataRegister<U<9>>,
    s2_top: DataRegister<U<5>>,
    s2_bottom: DataRegister<U<5>>,
    s2_spare: DataRegister<Bit>,
    /// Something comes from a stack, the own one or another.
    s2_has: DataRegister<Bit>,
    s2_holds: DataRegister<Bit>,
    s2_place: DataRegister<U<8>>,
    s3_active: Register<Bit>,
    s3_walker: DataRegister<U<3>>,
    s3_u: DataRegister<U<H>>,
    s3_v: DataRegister<U<H>>,
    s3_shape: DataRegister<U<9>>,
    s3_top: DataRegister<U<5>>,
    s3_bottom: DataRegister<U<5>>,
    s3_spare: DataRegister<Bit>,
    s3_has: DataRegister<Bit>,
    s3_holds: DataRegister<Bit>,
    s3_place: DataRegister<U<8>>,
    /// Level and directions of the halves.
    s3_level: DataRegister<U<4>>,
    s3_first_to: DataRegister<U<3>>,
    s3_second_to: DataRegister<U<3>>,
    s4_active: Register<Bit>,
    s4_walker: DataRegister<U<3>>,
    s4_u: DataRegister<U<H>>,
    s4_v: DataRegister<U<H>>,
    s4_shape: DataRegister<U<9>>,
    s4_top: DataRegister<U<5>>,
    s4_bottom: DataRegister<U<5>>,
    s4_spare: DataRegister<Bit>,
    s4_has: DataRegister<Bit>,
    s4_holds: DataRegister<Bit>,
    s4_place: DataRegister<U<8>>,
    s4_level: DataRegister<U<4>>,
    s4_step: DataRegister<U<H>>,
    s4_first_to: DataRegister<U<3>>,
    s4_second_to: DataRegister<U<3>>,
    s5_active: Register<Bit>,
    s5_splits: Register<Bit>,
    s5_walker: DataRegister<U<3>>,
    s5_u: DataRegister<U<H>>,
    s5_v: DataRegister<U<H>>,
    s5_shape: DataRegister<U<9>>,
    s5_top: DataRegister<U<5>>,
    s5_bottom: DataRegister<U<5>>,
    s5_spare: DataRegister<Bit>,
    s5_has: DataRegister<Bit>,
    s5_holds: DataRegister<Bit>,
    s5_level: DataRegister<U<4>>,
    s5_bound: DataRegister<U<23>>,
    s6_active: Register<Bit>,
    s6_splits: Register<Bit>,
    s6_walker: DataRegister<U<3>>,
    s6_u: DataRegister<U<H>>,
    s6_v: DataRegister<U<H>>,
    s6_shape: DataRegister<U<9>>,
    s6_top: DataRegister<U<5>>,
    s6_bottom: DataRegister<U<5>>,
    s6_spare: DataRegister<Bit>,
    s6_has: DataRegister<Bit>,
    s6_holds: DataRegister<Bit>,
    s6_level: DataRegister<U<4>>,
    s6_over: DataRegister<Bit>,
    s7_leaf: Register<Bit>,
    s7_active: Register<Bit>,
    s7_into_first: DataRegister<Bit>,
    s7_into_second: DataRegister<Bit>,
    s7_pushes: DataRegister<Bit>,
    s7_pops: DataRegister<Bit>,
    s7_walker: DataRegister<U<3>>,
    s7_u: DataRegister<U<H>>,
    s7_v: DataRegister<U<H>>,
    s7_shape: DataRegister<U<9>>,
    s7_level: DataRegister<U<4>>,
    s7_next_u: DataRegister<U<H>>,
    s7_next_v: DataRegister<U<H>>,
    s7_next_shape: DataRegister<U<9>>,
    s7_top: DataRegister<U<5>>,
    s7_above: DataRegister<U<5>>,
    s7_below: DataRegister<U<5>>,
    s7_bottom: DataRegister<U<5>>,
    length: Wire<U<5>>,
    all_but_one: Wire<U<5>>,
    one: Wire<U<H>>,
    robs_2: Wire<Bit>,
    robs_4: Wire<Bit>,
    robs_6: Wire<Bit>,
    direction: Wire<U<3>>,
    near_to: Wire<U<3>>,
    far_to: Wire<U<3>>,
    even: Wire<Bit>,
    under: Wire<S<24>>,
    splits: Wire<Bit>,
    goes_down: Wire<Bit>,
    first_shape: Wire<U<9>>,
    second_shape: Wire<U<9>>,
    root_shape: Wire<U<9>>,
}

impl<const C: usize, const H: usize, const A: usize, const E: usize> Logic for BisectorWalk<C, H, A, E> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, errors, beyond, product, first, second, stack_u, stack_v, stack_shape);
        dff_setup!(self, clock, walking, birthing, born, quiet, done, s0_active, s0_walker, s0_root, s0_u);
        dff_setup!(self, clock, s0_v, s0_shape, s0_top, s0_bottom, s1_active, s1_walker, s1_root, s1_u, s1_v);
        dff_setup!(self, clock, s1_shape, s1_top, s1_bottom, s1_next, s1_holds, s1_wants, s1_spare, s1_step, s2_active);
        dff_setup!(self, clock, s2_walker, s2_root, s2_u, s2_v, s2_shape, s2_top, s2_bottom, s2_spare, s2_has);
        dff_setup!(self, clock, s2_holds, s2_place, s3_active, s3_walker, s3_u, s3_v, s3_shape, s3_top, s3_bottom);
        dff_setup!(
            self,
            clock,
            s3_spare,
            s3_has,
            s3_holds,
            s3_place,
            s3_level,
            s3_first_to,
            s3_second_to,
            s4_active,
            s4_walker
        );
        dff_setup!(self, clock, s4_u, s4_v, s4_shape, s4_top, s4_bottom, s4_spare, s4_has, s4_holds, s4_place);
        dff_setup!(
            self,
            clock,
            s4_level,
            s4_step,
            s4_first_to,
            s4_second_to,
            s5_active,
            s5_splits,
            s5_walker,
            s5_u,
            s5_v
        );
        dff_setup!(self, clock, s5_shape, s5_top, s5_bottom, s5_spare, s5_has, s5_holds, s5_level, s5_bound, s6_active);
        dff_setup!(self, clock, s6_splits, s6_walker, s6_u, s6_v, s6_shape, s6_top, s6_bottom, s6_spare, s6_has);
        dff_setup!(
            self,
            clock,
            s6_holds,
            s6_level,
            s6_over,
            s7_leaf,
            s7_active,
            s7_into_first,
            s7_into_second,
            s7_pushes,
            s7_pops
        );
        dff_setup!(self, clock, s7_walker, s7_u, s7_v, s7_shape, s7_level, s7_next_u, s7_next_v, s7_next_shape, s7_top);
        dff_setup!(self, clock, s7_above, s7_below, s7_bottom);
        self.leaf.next = self.s7_leaf.q.val();
        self.leaf_u.next = self.s7_u.q.val();
        self.leaf_v.next = self.s7_v.q.val();
        self.leaf_shape.next = self.s7_shape.q.val();
        self.leaf_walker.next = self.s7_walker.q.val();
        self.births.next = self.birthing.q.val();
        self.born_walker.next = self.born.q.val();
        self.idle.next = self.done.q.val();

        // s0_node to s5_bound: the memory, and distances.
        self.errors.go.next = self.go.val();
        self.errors.go_0.next = self.go_0.val();
        self.errors.go_1.next = self.go_1.val();
        self.errors.go_2.next = self.go_2.val();
        self.errors.go_3.next = self.go_3.val();
        self.errors.u.next = bit_cast_to::<U<C>>(self.s0_u.q.val() >> 1);
        self.errors.v.next = bit_cast_to::<U<C>>(self.s0_v.q.val() >> 1);
        self.errors.write.next = self.write.val();
        self.errors.write_u.next = self.write_u.val();
        self.errors.write_v.next = self.write_v.val();
        self.errors.write_data.next = self.write_data.val();
        self.beyond.go.next = self.go.val();
        self.beyond.u.next = self.s0_u.q.val();
        self.beyond.v.next = self.s0_v.q.val();
        self.beyond.step.next = self.s1_step.q.val();
        self.beyond.diagonal.next = self.s1_shape.q.val().get_bit(4);
        self.beyond.root.next = self.s2_root.q.val();
        self.beyond.rim_u.next = self.rim_u.val();
        self.beyond.rim_v.next = self.rim_v.val();
        self.beyond.eye_u.next = self.eye_u.val();
        self.beyond.eye_v.next = self.eye_v.val();
        // Excess has at most 14 bits.
        self.product.enable.next = self.go.val();
        self.product.a.next = bit_cast_to::<S<17>>(self.slope.val());
        self.product.b.next = bit_cast_to::<S<16>>(self.beyond.excess.val());

        // s1_length
        self.one.next = 1.into();
        self.length.next = self.s0_top.q.val() - self.s0_bottom.q.val();
        self.all_but_one.next = self.length.val() >> 1;

        // s2_search: whom a walker without work robs.
        self.robs_2.next = self.s1_wants.q.val() && self.s2_spare.q.val();
        self.robs_4.next = self.s1_wants.q.val() && !self.s2_spare.q.val() && self.s4_spare.q.val();
        self.robs_6.next =
            self.s1_wants.q.val() && !self.s2_spare.q.val() && !self.s4_spare.q.val() && self.s6_spare.q.val();

        // s3_excess: the halves' directions. Every second generation is walked from b to a.
        self.even.next = !self.s2_shape.q.val().get_bit(4);
        self.direction.next = self.s2_shape.q.val().get_bits::<3>(4);
        self.near_to.next = self.direction.val() + 5;
        self.far_to.next = self.direction.val() + 3;
        if self.even.val() {
            self.near_to.next = self.direction.val() + 3;
            self.far_to.next = self.direction.val() + 5;
        }

        // s5_bound to s7_decided: the halves.
        self.first.go.next = self.go.val();
        self.first.u.next = self.s4_u.q.val();
        self.first.v.next = self.s4_v.q.val();
        self.first.step.next = self.s4_step.q.val();
        self.first.to.next = self.s4_first_to.q.val();
        self.first.rim_u.next = self.rim_u.val();
        self.first.rim_v.next = self.rim_v.val();
        self.second.go.next = self.go.val();
        self.second.u.next = self.s4_u.q.val();
        self.second.v.next = self.s4_v.q.val();
        self.second.step.next = self.s4_step.q.val();
        self.second.to.next = self.s4_second_to.q.val();
        self.second.rim_u.next = self.rim_u.val();
        self.second.rim_v.next = self.rim_v.val();

        // s6_over: below zero where the error is over the bound, which has 23 bits.
        self.under.next = bit_cast_to::<S<24>>(self.s5_bound.q.val()) - bit_cast_to::<S<24>>(self.errors.word.val());
        // s7_decided
        self.splits.next = self.s6_splits.q.val() && self.s6_over.q.val();
        self.goes_down.next = self.splits.val() && !(self.first.dead.val() && self.second.dead.val());
        self.first_shape.next = bit_cast_to::<U<9>>(self.s7_level.q.val())
            | (bit_cast_to::<U<9>>(self.first.half_to.val()) << 4)
            | (bit_cast_to::<U<9>>(!self.s7_shape.q.val().get_bit(7)) << 7);
        self.second_shape.next = bit_cast_to::<U<9>>(self.s7_level.q.val())
            | (bit_cast_to::<U<9>>(self.second.half_to.val()) << 4)
            | (bit_cast_to::<U<9>>(!self.s7_shape.q.val().get_bit(8)) << 8);

        // The rings: a walker's place is walker << 5 | number.
        self.stack_u.enable.next = self.go_3.val();
        self.stack_u.output_enable.next = self.go_3.val();
        self.stack_u.read_address.next = self.s4_place.q.val();
        self.stack_u.write_enable.next = self.go.val() && self.s7_pushes.q.val();
        self.stack_u.write_address.next =
            (bit_cast_to::<U<8>>(self.s7_walker.q.val()) << 5) | bit_cast_to::<U<8>>(self.s7_top.q.val());
        self.stack_u.write_data.next = self.second.half_u.val();
        self.stack_v.enable.next = self.go_3.val();
        self.stack_v.output_enable.next = self.go_3.val();
        self.stack_v.read_address.next = self.s4_place.q.val();
        self.stack_v.write_enable.next = self.go.val() && self.s7_pushes.q.val();
        self.stack_v.write_address.next =
            (bit_cast_to::<U<8>>(self.s7_walker.q.val()) << 5) | bit_cast_to::<U<8>>(self.s7_top.q.val());
        self.stack_v.write_data.next = self.second.half_v.val();
        self.stack_shape.enable.next = self.go_3.val();
        self.stack_shape.output_enable.next = self.go_3.val();
        self.stack_shape.read_address.next = self.s4_place.q.val();
        self.stack_shape.write_enable.next = self.go.val() && self.s7_pushes.q.val();
        self.stack_shape.write_address.next =
            (bit_cast_to::<U<8>>(self.s7_walker.q.val()) << 5) | bit_cast_to::<U<8>>(self.s7_top.q.val());
        self.stack_shape.write_data.next = self.second_shape.val();

        // A root has no excess, by definition. Its midpoint is the lattice's.
        self.root_shape.next = bit_cast_to::<U<9>>(self.levels.val()) | 0x70;
        if self.mirrored.val() {
            self.root_shape.next = bit_cast_to::<U<9>>(self.levels.val()) | 0x10;
        }
        if self.go.val() {
            // s0_node
            self.s0_active.d.next = self.s7_active.q.val();
            self.s0_walker.d.next = self.s7_walker.q.val();
            self.s0_root.d.next = false;
            self.s0_u.d.next = self.s7_next_u.q.val();
            self.s0_v.d.next = self.s7_next_v.q.val();
            self.s0_shape.d.next = self.s7_next_shape.q.val();
            if self.s7_into_first.q.val() {
                self.s0_u.d.next = self.first.half_u.val();
                self.s0_v.d.next = self.first.half_v.val();
                self.s0_shape.d.next = self.first_shape.val();
            } else if self.s7_into_second.q.val() {
                self.s0_u.d.next = self.second.half_u.val();
                self.s0_v.d.next = self.second.half_v.val();
                self.s0_shape.d.next = self.second_shape.val();
            }
            self.s0_top.d.next = self.s7_top.q.val();
            if self.s7_pushes.q.val() {
                self.s0_top.d.next = self.s7_above.q.val();
            } else if self.s7_pops.q.val() {
                self.s0_top.d.next = self.s7_below.q.val();
            }
            self.s0_bottom.d.next = self.s7_bottom.q.val();
            if self.birthing.q.val() {
                self.s0_walker.d.next = self.born.q.val();
                self.s0_root.d.next = true;
                self.s0_u.d.next = bit_cast_to::<U<H>>(self.side.val());
                self.s0_v.d.next = bit_cast_to::<U<H>>(self.side.val());
                self.s0_shape.d.next = self.root_shape.val() ^ (bit_cast_to::<U<9>>(self.born.q.val().get_bit(0)) << 6);
                self.born.d.next = self.born.q.val() + 1;
                self.birthing.d.next =
                    !(self.born.q.val().get_bit(2) && self.born.q.val().get_bit(1) && self.born.q.val().get_bit(0));
            }
            if !self.walking.q.val() || self.birthing.q.val() {
                self.s0_active.d.next =
                    self.birthing.q.val() && !self.born.q.val().get_bit(1) && !self.born.q.val().get_bit(2);
                self.s0_top.d.next = 0.into();
                self.s0_bottom.d.next = 0.into();
            }

            // s1_length
            self.s1_active.d.next = self.s0_active.q.val();
            self.s1_walker.d.next = self.s0_walker.q.val();
            self.s1_root.d.next = self.s0_root.q.val();
            self.s1_u.d.next = self.s0_u.q.val();
            self.s1_v.d.next = self.s0_v.q.val();
            self.s1_shape.d.next = self.s0_shape.q.val();
            self.s1_top.d.next = self.s0_top.q.val();
            self.s1_bottom.d.next = self.s0_bottom.q.val();
            self.s1_next.d.next = self.s0_top.q.val() - 1;
            self.s1_holds.d.next = self.length.val() != 0;
            self.s1_wants.d.next = !self.s0_active.q.val() && self.length.val() == 0;
            self.s1_spare.d.next = self.all_but_one.val() != 0;
            self.s1_step.d.next = self.one.val() << self.s0_shape.q.val().get_bits::<4>(0);

            // s2_search
            self.s2_active.d.next = self.s1_active.q.val();
            self.s2_walker.d.next = self.s1_walker.q.val();
            self.s2_root.d.next = self.s1_root.q.val();
            self.s2_u.d.next = self.s1_u.q.val();
            self.s2_v.d.next = self.s1_v.q.val();
            self.s2_shape.d.next = self.s1_shape.q.val();
            self.s2_top.d.next = self.s1_top.q.val();
            self.s2_bottom.d.next = self.s1_bottom.q.val();
            self.s2_spare.d.next = self.s1_spare.q.val();
            self.s2_holds.d.next = self.s1_holds.q.val();
            self.s2_has.d.next = self.s1_holds.q.val() || self.robs_2.val() || self.robs_4.val() || self.robs_6.val();
            self.s2_place.d.next =
                (bit_cast_to::<U<8>>(self.s1_walker.q.val()) << 5) | bit_cast_to::<U<8>>(self.s1_next.q.val());
            if self.robs_2.val() {
                self.s2_place.d.next =
                    (bit_cast_to::<U<8>>(self.s2_walker.q.val()) << 5) | bit_cast_to::<U<8>>(self.s2_bottom.q.val());
            } else if self.robs_4.val() {
                self.s2_place.d.next =
                    (bit_cast_to::<U<8>>(self.s4_walker.q.val()) << 5) | bit_cast_to::<U<8>>(self.s4_bottom.q.val());
            } else if self.robs_6.val() {
                self.s2_place.d.next =
                    (bit_cast_to::<U<8>>(self.s6_walker.q.val()) << 5) | bit_cast_to::<U<8>>(self.s6_bottom.q.val());
            }

            // s3_excess
            self.s3_active.d.next = self.s2_active.q.val();
            self.s3_walker.d.next = self.s2_walker.q.val();
            self.s3_u.d.next = self.s2_u.q.val();
            self.s3_v.d.next = self.s2_v.q.val();
            self.s3_shape.d.next = self.s2_shape.q.val();
            self.s3_top.d.next = self.s2_top.q.val();
            self.s3_spare.d.next = self.s2_spare.q.val() && !self.robs_2.val();
            self.s3_has.d.next = self.s2_has.q.val();
            self.s3_holds.d.next = self.s2_holds.q.val();
            self.s3_bottom.d.next = self.s2_bottom.q.val() + bit_cast_to::<U<5>>(self.robs_2.val());
            self.s3_place.d.next = self.s2_place.q.val();
            self.s3_level.d.next = self.s2_shape.q.val().get_bits::<4>(0);
            if self.even.val() {
                self.s3_level.d.next = self.s2_shape.q.val().get_bits::<4>(0) - 1;
            }
            self.s3_first_to.d.next = self.near_to.val();
            self.s3_second_to.d.next = self.far_to.val();

            // s4_product
            self.s4_active.d.next = self.s3_active.q.val();
            self.s4_walker.d.next = self.s3_walker.q.val();
            self.s4_u.d.next = self.s3_u.q.val();
            self.s4_v.d.next = self.s3_v.q.val();
            self.s4_shape.d.next = self.s3_shape.q.val();
            self.s4_top.d.next = self.s3_top.q.val();
            self.s4_spare.d.next = self.s3_spare.q.val();
            self.s4_has.d.next = self.s3_has.q.val();
            self.s4_holds.d.next = self.s3_holds.q.val();
            self.s4_bottom.d.next = self.s3_bottom.q.val();
            self.s4_place.d.next = self.s3_place.q.val();
            self.s4_level.d.next = self.s3_level.q.val();
            self.s4_step.d.next = self.one.val() << self.s3_level.q.val();
            self.s4_first_to.d.next = self.s3_first_to.q.val();
            self.s4_second_to.d.next = self.s3_second_to.q.val();

            // s5_bound: 16 bits of the base, 16 + 14 - 8 of the product.
            self.s5_active.d.next = self.s4_active.q.val();
            self.s5_splits.d.next = self.s4_active.q.val() && self.s4_shape.q.val().get_bits::<4>(0) != 0;
            self.s5_walker.d.next = self.s4_walker.q.val();
            self.s5_u.d.next = self.s4_u.q.val();
            self.s5_v.d.next = self.s4_v.q.val();
            self.s5_shape.d.next = self.s4_shape.q.val();
            self.s5_top.d.next = self.s4_top.q.val();
            self.s5_spare.d.next = self.s4_spare.q.val() && !self.robs_4.val();
            self.s5_has.d.next = self.s4_has.q.val();
            self.s5_holds.d.next = self.s4_holds.q.val();
            self.s5_bottom.d.next = self.s4_bottom.q.val() + bit_cast_to::<U<5>>(self.robs_4.val());
            self.s5_level.d.next = self.s4_level.q.val();
            self.s5_bound.d.next =
                bit_cast_to::<U<23>>(self.base.val()) + bit_cast_to::<U<23>>(self.product.p.val() >> 8);

            // s6_over
            self.s6_active.d.next = self.s5_active.q.val();
            self.s6_splits.d.next = self.s5_splits.q.val();
            self.s6_walker.d.next = self.s5_walker.q.val();
            self.s6_u.d.next = self.s5_u.q.val();
            self.s6_v.d.next = self.s5_v.q.val();
            self.s6_shape.d.next = self.s5_shape.q.val();
            self.s6_top.d.next = self.s5_top.q.val();
            self.s6_spare.d.next = self.s5_spare.q.val();
            self.s6_has.d.next = self.s5_has.q.val();
            self.s6_holds.d.next = self.s5_holds.q.val();
            self.s6_bottom.d.next = self.s5_bottom.q.val();
            self.s6_level.d.next = self.s5_level.q.val();
            self.s6_over.d.next = self.under.val().get_bit(23);

            // s7_decided
            self.s7_leaf.d.next = self.s6_active.q.val() && !self.splits.val();
            self.s7_active.d.next = self.s6_has.q.val() || self.goes_down.val();
            self.s7_into_first.d.next = self.splits.val() && !self.first.dead.val();
            self.s7_into_second.d.next = self.splits.val() && self.first.dead.val() && !self.second.dead.val();
            self.s7_pushes.d.next = self.splits.val() && !self.first.dead.val() && !self.second.dead.val();
            self.s7_pops.d.next = self.s6_holds.q.val() && !self.goes_down.val();
            self.s7_walker.d.next = self.s6_walker.q.val();
            self.s7_u.d.next = self.s6_u.q.val();
            self.s7_v.d.next = self.s6_v.q.val();
            self.s7_shape.d.next = self.s6_shape.q.val();
            self.s7_level.d.next = self.s6_level.q.val();
            self.s7_next_u.d.next = self.stack_u.read_data.val();
            self.s7_next_v.d.next = self.stack_v.read_data.val();
            self.s7_next_shape.d.next = self.stack_shape.read_data.val();
            self.s7_top.d.next = self.s6_top.q.val();
            self.s7_above.d.next = self.s6_top.q.val() + 1;
            self.s7_below.d.next = self.s6_top.q.val() - 1;
            self.s7_bottom.d.next = self.s6_bottom.q.val() + bit_cast_to::<U<5>>(self.robs_6.val());

            // A walker that has nothing gets something at s2_search only: eight of them in succession are all.
            if self.s2_active.q.val() || self.s2_has.q.val() {
                self.quiet.d.next = 0.into();
            } else if !self.quiet.q.val().get_bit(3) {
                self.quiet.d.next = self.quiet.q.val() + 1;
            }
            if self.walking.q.val() && self.quiet.q.val().get_bit(3) {
                self.walking.d.next = false;
                self.done.d.next = true;
            }
            if self.start.val() {
                self.walking.d.next = true;
                self.birthing.d.next = true;
                self.born.d.next = 0.into();
                self.quiet.d.next = 0.into();
                self.done.d.next = false;
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_walk")
    }
}

latches! { [const C: usize, const H: usize, const A: usize, const E: usize] BisectorWalk<C, H, A, E>: errors, beyond, product, first, second, stack_u, stack_v, stack_shape, walking, birthing, born, quiet, done, s0_active, s0_walker, s0_root, s0_u, s0_v, s0_shape, s0_top, s0_bottom, s1_active, s1_walker, s1_root, s1_u, s1_v, s1_shape, s1_top, s1_bottom, s1_next, s1_holds, s1_wants, s1_spare, s1_step, s2_active, s2_walker, s2_root, s2_u, s2_v, s2_shape, s2_top, s2_bottom, s2_spare, s2_has, s2_holds, s2_place, s3_active, s3_walker, s3_u, s3_v, s3_shape, s3_top, s3_bottom, s3_spare, s3_has, s3_holds, s3_place, s3_level, s3_first_to, s3_second_to, s4_active, s4_walker, s4_u, s4_v, s4_shape, s4_top, s4_bottom, s4_spare, s4_has, s4_holds, s4_place, s4_level, s4_step, s4_first_to, s4_second_to, s5_active, s5_splits, s5_walker, s5_u, s5_v, s5_shape, s5_top, s5_bottom, s5_spare, s5_has, s5_holds, s5_level, s5_bound, s6_active, s6_splits, s6_walker, s6_u, s6_v, s6_shape, s6_top, s6_bottom, s6_spare, s6_has, s6_holds, s6_level, s6_over, s7_leaf, s7_active, s7_into_first, s7_into_second, s7_pushes, s7_pops, s7_walker, s7_u, s7_v, s7_shape, s7_level, s7_next_u, s7_next_v, s7_next_shape, s7_top, s7_above, s7_below, s7_bottom }
