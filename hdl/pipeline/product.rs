// SPDX-License-Identifier: MIT OR Apache-2.0
//! Products of factors wider than a DSP block, from digits of 17 bits.
//!
//! A digit below the highest one has 17 bits and no sign, so each product of two digits is one of 18 x 18 signed bits.
//! Products of one weight are added first, and no sum is longer than its upper part has bits.
//!
//! | block      | a            | b            |   Error: 0, the product is whole if P >= A + B, modulo 2^P otherwise
//! | Product2x2 | signed to 35 | signed to 35 |   Latency 5, interval 1
//! | Product3x1 | signed to 52 | signed 18    |   Latency 5, interval 1
//! | Product3x2 | signed to 52 | signed to 35 |   Latency 6, interval 1

use super::DspProduct;
use crate::prelude::*;

/// Factors of two digits each, 17 < A, B <= 35.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Product2x2<const A: usize, const B: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<A>>,
    pub b: Input<S<B>>,
    pub p: Output<WideS<P>>,
    s3_00: DspProduct<18, 18, 36>,
    s3_01: DspProduct<18, 18, 36>,
    s3_10: DspProduct<18, 18, 36>,
    s3_11: DspProduct<18, 18, 36>,
    s4_outer: DataRegister<WideS<P>>,
    s4_middle: DataRegister<WideS<37>>,
    s5_sum: DataRegister<WideS<P>>,
    a_low: Wire<S<18>>,
    a_high: Wire<S<18>>,
    b_low: Wire<S<18>>,
    b_high: Wire<S<18>>,
}

impl<const A: usize, const B: usize, const P: usize> Product2x2<A, B, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 2;
}

impl<const A: usize, const B: usize, const P: usize> Logic for Product2x2<A, B, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_00, s3_01, s3_10, s3_11);
        dff_setup!(self, clock, s4_outer, s4_middle, s5_sum);
        self.p.next = self.s5_sum.q.val();
        self.a_low.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(0));
        self.a_high.next = bit_cast_to::<S<18>>(self.a.val() >> 17);
        self.b_low.next = bit_cast_to::<S<18>>(self.b.val().get_bits::<17>(0));
        self.b_high.next = bit_cast_to::<S<18>>(self.b.val() >> 17);
        self.s3_00.go.next = self.go.val();
        self.s3_00.a.next = self.a_low.val();
        self.s3_00.b.next = self.b_low.val();
        self.s3_01.go.next = self.go.val();
        self.s3_01.a.next = self.a_low.val();
        self.s3_01.b.next = self.b_high.val();
        self.s3_10.go.next = self.go.val();
        self.s3_10.a.next = self.a_high.val();
        self.s3_10.b.next = self.b_low.val();
        self.s3_11.go.next = self.go.val();
        self.s3_11.a.next = self.a_high.val();
        self.s3_11.b.next = self.b_high.val();
        if self.go.val() {
            // The lowest product has 34 bits and no sign: the highest one stands right above it.
            self.s4_outer.d.next = (bit_cast_to::<WideS<P>>(self.s3_11.p.val()) << 34)
                | bit_cast_to::<WideS<P>>(self.s3_00.p.val().get_bits::<34>(0));
            self.s4_middle.d.next =
                bit_cast_to::<WideS<37>>(self.s3_01.p.val()) + bit_cast_to::<WideS<37>>(self.s3_10.p.val());
            self.s5_sum.d.next = self.s4_outer.q.val() + (bit_cast_to::<WideS<P>>(self.s4_middle.q.val()) << 17);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("product_{A}x{B}_to_{P}"))
    }
}

latches! { [const A: usize, const B: usize, const P: usize] Product2x2<A, B, P>: s3_00, s3_01, s3_10, s3_11, s4_outer, s4_middle, s5_sum }

/// Factors of three digits and of one, 34 < A <= 52.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Product3x1<const A: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<A>>,
    pub b: Input<S<18>>,
    pub p: Output<WideS<P>>,
    s3_0: DspProduct<18, 18, 36>,
    s3_1: DspProduct<18, 18, 36>,
    s3_2: DspProduct<18, 18, 36>,
    s4_outer: DataRegister<WideS<P>>,
    s4_middle: DataRegister<WideS<36>>,
    s5_sum: DataRegister<WideS<P>>,
}

impl<const A: usize, const P: usize> Product3x1<A, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 2;
}

impl<const A: usize, const P: usize> Logic for Product3x1<A, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_0, s3_1, s3_2);
        dff_setup!(self, clock, s4_outer, s4_middle, s5_sum);
        self.p.next = self.s5_sum.q.val();
        self.s3_0.go.next = self.go.val();
        self.s3_0.a.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(0));
        self.s3_0.b.next = self.b.val();
        self.s3_1.go.next = self.go.val();
        self.s3_1.a.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(17));
        self.s3_1.b.next = self.b.val();
        self.s3_2.go.next = self.go.val();
        self.s3_2.a.next = bit_cast_to::<S<18>>(self.a.val() >> 34);
        self.s3_2.b.next = self.b.val();
        if self.go.val() {
            // The lowest product has a sign, which reaches into the highest one: below 2^35 either way, so no more than 19
            // bits of a sum.
            self.s4_outer.d.next =
                (bit_cast_to::<WideS<P>>(self.s3_2.p.val()) << 34) + bit_cast_to::<WideS<P>>(self.s3_0.p.val());
            self.s4_middle.d.next = self.s3_1.p.val();
            self.s5_sum.d.next = self.s4_outer.q.val() + (bit_cast_to::<WideS<P>>(self.s4_middle.q.val()) << 17);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("product_{A}x18_to_{P}"))
    }
}

latches! { [const A: usize, const P: usize] Product3x1<A, P>: s3_0, s3_1, s3_2, s4_outer, s4_middle, s5_sum }

/// Factors of three digits and of two, 34 < A <= 52 and 17 < B <= 35.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Product3x2<const A: usize, const B: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<A>>,
    pub b: Input<S<B>>,
    pub p: Output<WideS<P>>,
    s3_00: DspProduct<18, 18, 36>,
    s3_01: DspProduct<18, 18, 36>,
    s3_10: DspProduct<18, 18, 36>,
    s3_11: DspProduct<18, 18, 36>,
    s3_20: DspProduct<18, 18, 36>,
    s3_21: DspProduct<18, 18, 36>,
    s4_first: DataRegister<U<34>>,
    s4_second: DataRegister<WideS<37>>,
    s4_third: DataRegister<WideS<37>>,
    s4_fourth: DataRegister<WideS<36>>,
    s5_lower: DataRegister<WideS<P>>,
    s5_upper: DataRegister<WideS<P>>,
    s6_sum: DataRegister<WideS<P>>,
    a_low: Wire<S<18>>,
    a_middle: Wire<S<18>>,
    a_high: Wire<S<18>>,
    b_low: Wire<S<18>>,
    b_high: Wire<S<18>>,
}

impl<const A: usize, const B: usize, const P: usize> Product3x2<A, B, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 3;
}

impl<const A: usize, const B: usize, const P: usize> Logic for Product3x2<A, B, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_00, s3_01, s3_10, s3_11, s3_20, s3_21);
        dff_setup!(self, clock, s4_first, s4_second, s4_third, s4_fourth, s5_lower, s5_upper, s6_sum);
        self.p.next = self.s6_sum.q.val();
        self.a_low.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(0));
        self.a_middle.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(17));
        self.a_high.next = bit_cast_to::<S<18>>(self.a.val() >> 34);
        self.b_low.next = bit_cast_to::<S<18>>(self.b.val().get_bits::<17>(0));
        self.b_high.next = bit_cast_to::<S<18>>(self.b.val() >> 17);
        self.s3_00.go.next = self.go.val();
        self.s3_00.a.next = self.a_low.val();
        self.s3_00.b.next = self.b_low.val();
        self.s3_01.go.next = self.go.val();
        self.s3_01.a.next = self.a_low.val();
        self.s3_01.b.next = self.b_high.val();
        self.s3_10.go.next = self.go.val();
        self.s3_10.a.next = self.a_middle.val();
        self.s3_10.b.next = self.b_low.val();
        self.s3_11.go.next = self.go.val();
        self.s3_11.a.next = self.a_middle.val();
        self.s3_11.b.next = self.b_high.val();
        self.s3_20.go.next = self.go.val();
        self.s3_20.a.next = self.a_high.val();
        self.s3_20.b.next = self.b_low.val();
        self.s3_21.go.next = self.go.val();
        self.s3_21.a.next = self.a_high.val();
        self.s3_21.b.next = self.b_high.val();
        if self.go.val() {
            self.s4_first.d.next = self.s3_00.p.val().get_bits::<34>(0);
            self.s4_second.d.next =
                bit_cast_to::<WideS<37>>(self.s3_01.p.val()) + bit_cast_to::<WideS<37>>(self.s3_10.p.val());
            self.s4_third.d.next =
                bit_cast_to::<WideS<37>>(self.s3_11.p.val()) + bit_cast_to::<WideS<37>>(self.s3_20.p.val());
            self.s4_fourth.d.next = self.s3_21.p.val();
            self.s5_lower.d.next = bit_cast_to::<WideS<P>>(self.s4_first.q.val())
                + (bit_cast_to::<WideS<P>>(self.s4_second.q.val()) << 17);
            self.s5_upper.d.next = bit_cast_to::<WideS<P>>(self.s4_third.q.val())
                + (bit_cast_to::<WideS<P>>(self.s4_fourth.q.val()) << 17);
            self.s6_sum.d.next = self.s5_lower.q.val() + (self.s5_upper.q.val() << 34);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("product_{A}x{B}_to_{P}"))
    }
}

latches! { [const A: usize, const B: usize, const P: usize] Product3x2<A, B, P>: s3_00, s3_01, s3_10, s3_11, s3_20, s3_21, s4_first, s4_second, s4_third, s4_fourth, s5_lower, s5_upper, s6_sum }
