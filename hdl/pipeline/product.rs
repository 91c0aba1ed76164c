// SPDX-License-Identifier: MIT OR Apache-2.0
//! Products of factors wider than a DSP block, from digits of 17 bits.
//!
//! A digit below the highest one has 17 bits and no sign, so each product of two digits is one of 18 x 18 signed bits.
//! Products of one weight are added first, and no sum is longer than its upper part has bits.
//!
//! Digits come to a multiplier one cycle later for each place they stand higher: products of one weight leave together, one weight
//! a cycle, as the sums want them, and no register feeds two multipliers that lie apart.
//!
//! | block      | a            | b            |   Error: 0, the product is whole if P >= A + B, modulo 2^P otherwise
//! | Product2x1 | signed to 35 | signed 18    |   Latency 5, interval 1
//! | Product2x2 | signed to 35 | signed to 35 |   Latency 6, interval 1
//! | Product3x1 | signed to 52 | signed 18    |   Latency 6, interval 1
//! | Product3x2 | signed to 52 | signed to 35 |   Latency 8, interval 1

use super::DspProduct;
use crate::prelude::*;

/// Factors of two digits and of one, 17 < A <= 35.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Product2x1<const A: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<A>>,
    pub b: Input<S<18>>,
    pub p: Output<WideS<P>>,
    s1_a_high: DataRegister<S<18>>,
    s1_b: DataRegister<S<18>>,
    s3_0: DspProduct<18, 18, 36>,
    s4_1: DspProduct<18, 18, 36>,
    s4_first: DataRegister<WideS<36>>,
    s5_sum: DataRegister<WideS<P>>,
}

impl<const A: usize, const P: usize> Product2x1<A, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 2;
}

impl<const A: usize, const P: usize> Logic for Product2x1<A, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_0, s4_1);
        dff_setup!(self, clock, s1_a_high, s1_b, s4_first, s5_sum);
        self.p.next = self.s5_sum.q.val();
        self.s3_0.go.next = self.go.val();
        self.s3_0.a.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(0));
        self.s3_0.b.next = self.b.val();
        self.s4_1.go.next = self.go.val();
        self.s4_1.a.next = self.s1_a_high.q.val();
        self.s4_1.b.next = self.s1_b.q.val();
        if self.go.val() {
            self.s1_a_high.d.next = bit_cast_to::<S<18>>(self.a.val() >> 17);
            self.s1_b.d.next = self.b.val();
            self.s4_first.d.next = self.s3_0.p.val();
            self.s5_sum.d.next =
                bit_cast_to::<WideS<P>>(self.s4_first.q.val()) + (bit_cast_to::<WideS<P>>(self.s4_1.p.val()) << 17);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("product_{A}x18_to_{P}"))
    }
}

latches! { [const A: usize, const P: usize] Product2x1<A, P>: s1_a_high, s1_b, s3_0, s4_1, s4_first, s5_sum }

/// Factors of two digits each, 17 < A, B <= 35.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Product2x2<const A: usize, const B: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<A>>,
    pub b: Input<S<B>>,
    pub p: Output<WideS<P>>,
    s1_a_low: DataRegister<S<18>>,
    s1_a_high: DataRegister<S<18>>,
    s2_a_high: DataRegister<S<18>>,
    s1_b_low: DataRegister<S<18>>,
    s1_b_high: DataRegister<S<18>>,
    s2_b_high: DataRegister<S<18>>,
    s3_00: DspProduct<18, 18, 36>,
    s4_01: DspProduct<18, 18, 36>,
    s4_10: DspProduct<18, 18, 36>,
    s5_11: DspProduct<18, 18, 36>,
    s4_first: DataRegister<U<34>>,
    s5_first: DataRegister<U<34>>,
    s5_second: DataRegister<WideS<37>>,
    s6_sum: DataRegister<WideS<P>>,
    a_low: Wire<S<18>>,
    a_high: Wire<S<18>>,
    b_low: Wire<S<18>>,
    b_high: Wire<S<18>>,
    outer: Wire<WideS<P>>,
}

impl<const A: usize, const B: usize, const P: usize> Product2x2<A, B, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 3;
}

impl<const A: usize, const B: usize, const P: usize> Logic for Product2x2<A, B, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_00, s4_01, s4_10, s5_11);
        dff_setup!(self, clock, s1_a_low, s1_a_high, s2_a_high, s1_b_low, s1_b_high, s2_b_high);
        dff_setup!(self, clock, s4_first, s5_first, s5_second, s6_sum);
        self.p.next = self.s6_sum.q.val();
        self.a_low.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(0));
        self.a_high.next = bit_cast_to::<S<18>>(self.a.val() >> 17);
        self.b_low.next = bit_cast_to::<S<18>>(self.b.val().get_bits::<17>(0));
        self.b_high.next = bit_cast_to::<S<18>>(self.b.val() >> 17);
        self.s3_00.go.next = self.go.val();
        self.s3_00.a.next = self.a_low.val();
        self.s3_00.b.next = self.b_low.val();
        self.s4_01.go.next = self.go.val();
        self.s4_01.a.next = self.s1_a_low.q.val();
        self.s4_01.b.next = self.s1_b_high.q.val();
        self.s4_10.go.next = self.go.val();
        self.s4_10.a.next = self.s1_a_high.q.val();
        self.s4_10.b.next = self.s1_b_low.q.val();
        self.s5_11.go.next = self.go.val();
        self.s5_11.a.next = self.s2_a_high.q.val();
        self.s5_11.b.next = self.s2_b_high.q.val();
        // The lowest product has 34 bits and no sign: the highest one stands right above it.
        self.outer.next =
            (bit_cast_to::<WideS<P>>(self.s5_11.p.val()) << 34) | bit_cast_to::<WideS<P>>(self.s5_first.q.val());
        if self.go.val() {
            self.s1_a_low.d.next = self.a_low.val();
            self.s1_a_high.d.next = self.a_high.val();
            self.s2_a_high.d.next = self.s1_a_high.q.val();
            self.s1_b_low.d.next = self.b_low.val();
            self.s1_b_high.d.next = self.b_high.val();
            self.s2_b_high.d.next = self.s1_b_high.q.val();
            self.s4_first.d.next = self.s3_00.p.val().get_bits::<34>(0);
            self.s5_first.d.next = self.s4_first.q.val();
            self.s5_second.d.next =
                bit_cast_to::<WideS<37>>(self.s4_01.p.val()) + bit_cast_to::<WideS<37>>(self.s4_10.p.val());
            self.s6_sum.d.next = self.outer.val() + (bit_cast_to::<WideS<P>>(self.s5_second.q.val()) << 17);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("product_{A}x{B}_to_{P}"))
    }
}

latches! { [const A: usize, const B: usize, const P: usize] Product2x2<A, B, P>: s1_a_low, s1_a_high, s2_a_high, s1_b_low, s1_b_high, s2_b_high, s3_00, s4_01, s4_10, s5_11, s4_first, s5_first, s5_second, s6_sum }

/// Factors of three digits and of one, 34 < A <= 52.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Product3x1<const A: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<A>>,
    pub b: Input<S<18>>,
    pub p: Output<WideS<P>>,
    s1_a_middle: DataRegister<S<18>>,
    s1_a_high: DataRegister<S<18>>,
    s2_a_high: DataRegister<S<18>>,
    s1_b: DataRegister<S<18>>,
    s2_b: DataRegister<S<18>>,
    s3_0: DspProduct<18, 18, 36>,
    s4_1: DspProduct<18, 18, 36>,
    s5_2: DspProduct<18, 18, 36>,
    s4_first: DataRegister<WideS<36>>,
    s5_lower: DataRegister<WideS<P>>,
    s6_sum: DataRegister<WideS<P>>,
}

impl<const A: usize, const P: usize> Product3x1<A, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 3;
}

impl<const A: usize, const P: usize> Logic for Product3x1<A, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_0, s4_1, s5_2);
        dff_setup!(self, clock, s1_a_middle, s1_a_high, s2_a_high, s1_b, s2_b, s4_first, s5_lower, s6_sum);
        self.p.next = self.s6_sum.q.val();
        self.s3_0.go.next = self.go.val();
        self.s3_0.a.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(0));
        self.s3_0.b.next = self.b.val();
        self.s4_1.go.next = self.go.val();
        self.s4_1.a.next = self.s1_a_middle.q.val();
        self.s4_1.b.next = self.s1_b.q.val();
        self.s5_2.go.next = self.go.val();
        self.s5_2.a.next = self.s2_a_high.q.val();
        self.s5_2.b.next = self.s2_b.q.val();
        if self.go.val() {
            self.s1_a_middle.d.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(17));
            self.s1_a_high.d.next = bit_cast_to::<S<18>>(self.a.val() >> 34);
            self.s2_a_high.d.next = self.s1_a_high.q.val();
            self.s1_b.d.next = self.b.val();
            self.s2_b.d.next = self.s1_b.q.val();
            self.s4_first.d.next = self.s3_0.p.val();
            self.s5_lower.d.next =
                bit_cast_to::<WideS<P>>(self.s4_first.q.val()) + (bit_cast_to::<WideS<P>>(self.s4_1.p.val()) << 17);
            self.s6_sum.d.next = self.s5_lower.q.val() + (bit_cast_to::<WideS<P>>(self.s5_2.p.val()) << 34);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("product_{A}x18_to_{P}"))
    }
}

latches! { [const A: usize, const P: usize] Product3x1<A, P>: s1_a_middle, s1_a_high, s2_a_high, s1_b, s2_b, s3_0, s4_1, s5_2, s4_first, s5_lower, s6_sum }

/// Factors of three digits and of two, 34 < A <= 52 and 17 < B <= 35.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Product3x2<const A: usize, const B: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<A>>,
    pub b: Input<S<B>>,
    pub p: Output<WideS<P>>,
    s1_a_low: DataRegister<S<18>>,
    s1_a_middle: DataRegister<S<18>>,
    s2_a_middle: DataRegister<S<18>>,
    s1_a_high: DataRegister<S<18>>,
    s2_a_high: DataRegister<S<18>>,
    s3_a_high: DataRegister<S<18>>,
    s1_b_low: DataRegister<S<18>>,
    s2_b_low: DataRegister<S<18>>,
    s1_b_high: DataRegister<S<18>>,
    s2_b_high: DataRegister<S<18>>,
    s3_b_high: DataRegister<S<18>>,
    s3_00: DspProduct<18, 18, 36>,
    s4_01: DspProduct<18, 18, 36>,
    s4_10: DspProduct<18, 18, 36>,
    s5_11: DspProduct<18, 18, 36>,
    s5_20: DspProduct<18, 18, 36>,
    s6_21: DspProduct<18, 18, 36>,
    s4_first: DataRegister<U<34>>,
    s5_first: DataRegister<U<34>>,
    s5_second: DataRegister<WideS<37>>,
    s6_third: DataRegister<WideS<37>>,
    s6_lower: DataRegister<WideS<P>>,
    s7_lower: DataRegister<WideS<P>>,
    s7_upper: DataRegister<WideS<P>>,
    s8_sum: DataRegister<WideS<P>>,
    a_low: Wire<S<18>>,
    a_middle: Wire<S<18>>,
    a_high: Wire<S<18>>,
    b_low: Wire<S<18>>,
    b_high: Wire<S<18>>,
}

impl<const A: usize, const B: usize, const P: usize> Product3x2<A, B, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 5;
}

impl<const A: usize, const B: usize, const P: usize> Logic for Product3x2<A, B, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_00, s4_01, s4_10, s5_11, s5_20, s6_21);
        dff_setup!(
            self,
            clock,
            s1_a_low,
            s1_a_middle,
            s2_a_middle,
            s1_a_high,
            s2_a_high,
            s3_a_high,
            s1_b_low,
            s2_b_low
        );
        dff_setup!(self, clock, s1_b_high, s2_b_high, s3_b_high, s4_first, s5_first, s5_second, s6_third, s6_lower);
        dff_setup!(self, clock, s7_lower, s7_upper, s8_sum);
        self.p.next = self.s8_sum.q.val();
        self.a_low.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(0));
        self.a_middle.next = bit_cast_to::<S<18>>(self.a.val().get_bits::<17>(17));
        self.a_high.next = bit_cast_to::<S<18>>(self.a.val() >> 34);
        self.b_low.next = bit_cast_to::<S<18>>(self.b.val().get_bits::<17>(0));
        self.b_high.next = bit_cast_to::<S<18>>(self.b.val() >> 17);
        self.s3_00.go.next = self.go.val();
        self.s3_00.a.next = self.a_low.val();
        self.s3_00.b.next = self.b_low.val();
        self.s4_01.go.next = self.go.val();
        self.s4_01.a.next = self.s1_a_low.q.val();
        self.s4_01.b.next = self.s1_b_high.q.val();
        self.s4_10.go.next = self.go.val();
        self.s4_10.a.next = self.s1_a_middle.q.val();
        self.s4_10.b.next = self.s1_b_low.q.val();
        self.s5_11.go.next = self.go.val();
        self.s5_11.a.next = self.s2_a_middle.q.val();
        self.s5_11.b.next = self.s2_b_high.q.val();
        self.s5_20.go.next = self.go.val();
        self.s5_20.a.next = self.s2_a_high.q.val();
        self.s5_20.b.next = self.s2_b_low.q.val();
        self.s6_21.go.next = self.go.val();
        self.s6_21.a.next = self.s3_a_high.q.val();
        self.s6_21.b.next = self.s3_b_high.q.val();
        if self.go.val() {
            self.s1_a_low.d.next = self.a_low.val();
            self.s1_a_middle.d.next = self.a_middle.val();
            self.s2_a_middle.d.next = self.s1_a_middle.q.val();
            self.s1_a_high.d.next = self.a_high.val();
            self.s2_a_high.d.next = self.s1_a_high.q.val();
            self.s3_a_high.d.next = self.s2_a_high.q.val();
            self.s1_b_low.d.next = self.b_low.val();
            self.s2_b_low.d.next = self.s1_b_low.q.val();
            self.s1_b_high.d.next = self.b_high.val();
            self.s2_b_high.d.next = self.s1_b_high.q.val();
            self.s3_b_high.d.next = self.s2_b_high.q.val();
            self.s4_first.d.next = self.s3_00.p.val().get_bits::<34>(0);
            self.s5_first.d.next = self.s4_first.q.val();
            self.s5_second.d.next =
                bit_cast_to::<WideS<37>>(self.s4_01.p.val()) + bit_cast_to::<WideS<37>>(self.s4_10.p.val());
            self.s6_third.d.next =
                bit_cast_to::<WideS<37>>(self.s5_11.p.val()) + bit_cast_to::<WideS<37>>(self.s5_20.p.val());
            self.s6_lower.d.next = bit_cast_to::<WideS<P>>(self.s5_first.q.val())
                + (bit_cast_to::<WideS<P>>(self.s5_second.q.val()) << 17);
            self.s7_lower.d.next = self.s6_lower.q.val();
            self.s7_upper.d.next =
                bit_cast_to::<WideS<P>>(self.s6_third.q.val()) + (bit_cast_to::<WideS<P>>(self.s6_21.p.val()) << 17);
            self.s8_sum.d.next = self.s7_lower.q.val() + (self.s7_upper.q.val() << 34);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("product_{A}x{B}_to_{P}"))
    }
}

latches! { [const A: usize, const B: usize, const P: usize] Product3x2<A, B, P>: s1_a_low, s1_a_middle, s2_a_middle, s1_a_high, s2_a_high, s3_a_high, s1_b_low, s2_b_low, s1_b_high, s2_b_high, s3_b_high, s3_00, s4_01, s4_10, s5_11, s5_20, s6_21, s4_first, s5_first, s5_second, s6_third, s6_lower, s7_lower, s7_upper, s8_sum }
