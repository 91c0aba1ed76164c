// SPDX-License-Identifier: MIT OR Apache-2.0
//! How far off the screen a vertex of a piece is not displaced: the axis that the piece is swept along, and the limit there.
//!
//! ```text
//! axis = x or y, whichever is longer than both other axes of the piece; without one nothing is skipped
//! limit = half + (c reach) + margin + 3/4      c: the greatest of the corners, 16 bits, rounded up; 1/4 pixel
//! ```
//!
//! | stage | registers |
//! | s1    | of two corners, what is greater and less on each axis; the greater c |
//! | s2    | of all three |
//! | s3    | the extents |
//! | s4    | their comparisons; the product |
//! | s5    | the limit |
//!
//! | port   | format | meaning |   Latency 7; golden: models::displacement_pipeline::Skip
//! | goes   | Bit    | a piece goes to the remesher; 32 may be there
//! | p*, c* | 3 x signed N, signed V | its corners
//! | on     | Bit    | vertices are skipped
//! | half_*, reach, margin | UQ16.8, UQ15.2 | of the draw
//! | take   | Bit    | the last step of the oldest piece goes
//! | valid  | Bit    | limit and across are those of the oldest piece
//! | limit, across | signed 21, Bit | 1/4 pixel; across: the axis is y   Error 0

use crate::displacement_pipeline::lane_queue::LaneQueue;
use crate::prelude::*;

/// The extent of three numbers.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Extent<const N: usize> {
    pub clock: Input<ClockReset>,
    pub a: Input<S<N>>,
    pub b: Input<S<N>>,
    pub c: Input<S<N>>,
    pub span: Output<S<20>>,
    s1_high: DataRegister<S<N>>,
    s1_low: DataRegister<S<N>>,
    s1_c: DataRegister<S<N>>,
    s2_high: DataRegister<S<N>>,
    s2_low: DataRegister<S<N>>,
    s3_span: DataRegister<S<20>>,
}

impl<const N: usize> Logic for Extent<N> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_high, s1_low, s1_c, s2_high, s2_low, s3_span);
        self.s1_high.d.next = self.b.val();
        self.s1_low.d.next = self.a.val();
        if self.a.val() > self.b.val() {
            self.s1_high.d.next = self.a.val();
            self.s1_low.d.next = self.b.val();
        }
        self.s1_c.d.next = self.c.val();
        self.s2_high.d.next = self.s1_high.q.val();
        if self.s1_c.q.val() > self.s1_high.q.val() {
            self.s2_high.d.next = self.s1_c.q.val();
        }
        self.s2_low.d.next = self.s1_low.q.val();
        if self.s1_c.q.val() < self.s1_low.q.val() {
            self.s2_low.d.next = self.s1_c.q.val();
        }
        self.s3_span.d.next = bit_cast_to::<S<20>>(self.s2_high.q.val()) - bit_cast_to::<S<20>>(self.s2_low.q.val());
        self.span.next = self.s3_span.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("extent_{N}"))
    }
}

watched! { [const N: usize] Extent<N>: a, b, c;; s1_high, s1_low, s1_c, s2_high, s2_low, s3_span }

/// The limits of the pieces on their way, for lanes of `V` bits and coordinates of `N`.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Skip<const V: usize, const N: usize> {
    pub clock: Input<ClockReset>,
    pub goes: Input<Bit>,
    pub p0: Input<Lanes<3, N>>,
    pub p1: Input<Lanes<3, N>>,
    pub p2: Input<Lanes<3, N>>,
    pub c0: Input<S<V>>,
    pub c1: Input<S<V>>,
    pub c2: Input<S<V>>,
    pub on: Input<Bit>,
    pub half_width: Input<U<24>>,
    pub half_height: Input<U<24>>,
    pub reach: Input<U<17>>,
    pub margin: Input<U<17>>,
    pub take: Input<Bit>,
    pub valid: Output<Bit>,
    pub limit: Output<S<21>>,
    pub across: Output<Bit>,
    along_x: Extent<N>,
    along_y: Extent<N>,
    along_z: Extent<N>,
    s1_valid: Register<Bit>,
    s1_c: DataRegister<S<V>>,
    s1_c2: DataRegister<S<V>>,
    s2_valid: Register<Bit>,
    s2_c: DataRegister<S<18>>,
    s3_valid: Register<Bit>,
    product: Multiplier<18, 18, 36>,
    s4_valid: Register<Bit>,
    s4_x: DataRegister<Bit>,
    s4_y: DataRegister<Bit>,
    s4_near: DataRegister<S<21>>,
    s5_valid: Register<Bit>,
    s5_limit: DataRegister<S<21>>,
    s5_y: DataRegister<Bit>,
    limits: Gated<LaneQueue<1, 22, 5>>,
    span_x: Wire<S<20>>,
    span_y: Wire<S<20>>,
    span_z: Wire<S<20>>,
    whole: Wire<S<32>>,
    half: Wire<U<24>>,
    word: Wire<S<22>>,
    head: Wire<S<22>>,
    gone: Constant<U<6>>,
    most: Constant<S<21>>,
}

impl<const V: usize, const N: usize> Default for Skip<V, N> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            goes: Input::default(),
            p0: Input::default(),
            p1: Input::default(),
            p2: Input::default(),
            c0: Input::default(),
            c1: Input::default(),
            c2: Input::default(),
            on: Input::default(),
            half_width: Input::default(),
            half_height: Input::default(),
            reach: Input::default(),
            margin: Input::default(),
            take: Input::default(),
            valid: Output::default(),
            limit: Output::default(),
            across: Output::default(),
            along_x: Extent::default(),
            along_y: Extent::default(),
            along_z: Extent::default(),
            s1_valid: Register::default(),
            s1_c: DataRegister::default(),
            s1_c2: DataRegister::default(),
            s2_valid: Register::default(),
            s2_c: DataRegister::default(),
            s3_valid: Register::default(),
            product: Multiplier::default(),
            s4_valid: Register::default(),
            s4_x: DataRegister::default(),
            s4_y: DataRegister::default(),
            s4_near: DataRegister::default(),
            s5_valid: Register::default(),
            s5_limit: DataRegister::default(),
            s5_y: DataRegister::default(),
            limits: Gated::default(),
            span_x: Wire::default(),
            span_y: Wire::default(),
            span_z: Wire::default(),
            whole: Wire::default(),
            half: Wire::default(),
            word: Wire::default(),
            head: Wire::default(),
            gone: Constant::new(U::new(32 - V as i64)),
            most: Constant::new(S::new((1 << 20) - 1)),
        }
    }
}

impl<const V: usize, const N: usize> Logic for Skip<V, N> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, along_x, along_y, along_z, product, limits);
        dff_setup!(self, clock, s1_valid, s1_c, s1_c2, s2_valid, s2_c, s3_valid, s4_valid, s4_x, s4_y, s4_near);
        dff_setup!(self, clock, s5_valid, s5_limit, s5_y);
        self.along_x.a.next = self.p0.val().get_bit(0);
        self.along_x.b.next = self.p1.val().get_bit(0);
        self.along_x.c.next = self.p2.val().get_bit(0);
        self.along_y.a.next = self.p0.val().get_bit(1);
        self.along_y.b.next = self.p1.val().get_bit(1);
        self.along_y.c.next = self.p2.val().get_bit(1);
        self.along_z.a.next = self.p0.val().get_bit(2);
        self.along_z.b.next = self.p1.val().get_bit(2);
        self.along_z.c.next = self.p2.val().get_bit(2);
        self.span_x.next = self.along_x.span.val();
        self.span_y.next = self.along_y.span.val();
        self.span_z.next = self.along_z.span.val();

        self.s1_valid.d.next = self.goes.val();
        self.s1_c.d.next = self.c0.val();
        if self.c1.val() > self.c0.val() {
            self.s1_c.d.next = self.c1.val();
        }
        self.s1_c2.d.next = self.c2.val();
        self.s2_valid.d.next = self.s1_valid.q.val();
        self.whole.next = bit_cast_to::<S<32>>(self.s1_c.q.val()) << self.gone.val();
        if self.s1_c2.q.val() > self.s1_c.q.val() {
            self.whole.next = bit_cast_to::<S<32>>(self.s1_c2.q.val()) << self.gone.val();
        }
        self.s2_c.d.next = 1.into();
        if self.whole.val() >= 0 {
            self.s2_c.d.next = bit_cast_to::<S<18>>(self.whole.val() >> 15) + 1;
        }
        self.s3_valid.d.next = self.s2_valid.q.val();
        self.product.a.next = self.s2_c.q.val();
        self.product.b.next = bit_cast_to::<S<18>>(self.reach.val());

        self.s4_valid.d.next = self.s3_valid.q.val();
        self.s4_x.d.next = self.span_x.val() > self.span_y.val() && self.span_x.val() > self.span_z.val();
        self.s4_y.d.next = self.span_y.val() > self.span_x.val() && self.span_y.val() > self.span_z.val();
        self.s4_near.d.next =
            bit_cast_to::<S<21>>(self.product.p.val() >> 16) + bit_cast_to::<S<21>>(self.margin.val()) + 3;

        self.s5_valid.d.next = self.s4_valid.q.val();
        self.half.next = self.half_width.val();
        if self.s4_y.q.val() {
            self.half.next = self.half_height.val();
        }
        self.s5_y.d.next = self.s4_y.q.val();
        self.s5_limit.d.next = self.most.val();
        if self.on.val() && (self.s4_x.q.val() || self.s4_y.q.val()) {
            self.s5_limit.d.next = self.s4_near.q.val() + bit_cast_to::<S<21>>(self.half.val() >> 6);
        }

        self.limits.push.next = self.s5_valid.q.val();
        self.word.next = (bit_cast_to::<S<22>>(self.s5_limit.q.val()) << 1) | bit_cast_to::<S<22>>(self.s5_y.q.val());
        self.limits.data.next = bit_cast_to::<Lanes<1, 22>>(self.word.val());
        self.limits.take.next = self.take.val() && self.limits.valid.val();
        self.valid.next = self.limits.valid.val();
        self.head.next = self.limits.head.val().get_bit(0);
        self.limit.next = bit_cast_to::<S<21>>(self.head.val() >> 1);
        self.across.next = self.head.val().get_bit(0);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("skip")
    }
}

watched! { [const V: usize, const N: usize] Skip<V, N>: goes, p0, p1, p2, c0, c1, c2, on, half_width, half_height, reach, margin, take; along_x, along_y, along_z, product, limits; along_x, along_y, along_z, s1_valid, s1_c, s1_c2, s2_valid, s2_c, s3_valid, product, s4_valid, s4_x, s4_y, s4_near, s5_valid, s5_limit, s5_y, limits }
