// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a normalised number to its reciprocal root.
//!
//! | stage           | operation                                | width    |   Latency 23, interval 1; holds while `go` is low
//! | s1_index, s1_h  | line and place along it: seven bits, eleven bits behind the leading one or two |
//! | s2, s3          | the line                                 | start UQ0.18, fall 11 bits |
//! | s4 .. s6_fall   | fall h                                   | 22 bits |
//! | s7_seed         | y = start - (fall h >> 11)               | UQ0.18: between the line's ends |
//! | s8 .. s11_square | y^2, whose bit above a digit is added   | UQ0.36 |
//! | s12 .. s14      | products of digits of x and y^2          | 34 bits |
//! | s15 .. s17_product | x y^2 / 2^32, modulo 2^21             | it is within 2^20 of 2^34, which is 0 |
//! | s18_error       | e = floor((2^66 - x y^2) / 2^32)         | signed 21, SQ0.34 |
//! | s19 .. s21      | products of digits of y and e            | 34 bits |
//! | s22_step        | floor(y e / 2^21)                        | signed 18 |
//! | s23_sum         | y 2^14 + step                            | UQ0.32: 1.0 is not reached |
//!
//! -x y^2 = ~(x y^2) + 1, whose carry reaches the error only if all bits that are dropped are zero.

use super::RootTable;
use crate::pipeline::{Delay, DspProduct};
use crate::prelude::*;

/// Reciprocal root of a register.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct InverseRoot {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// UQ2.30, at least 1.
    pub number: Input<U<32>>,
    /// UQ0.32.
    pub root: Output<U<32>>,
    lines: RootTable,
    s1_index: DataRegister<U<7>>,
    s1_h: DataRegister<U<11>>,
    s2_h: DataRegister<U<11>>,
    s3_h: DataRegister<U<11>>,
    s11_x: Delay<32, 11>,
    s6_fall: DspProduct<12, 12, 24>,
    s4_start: DataRegister<U<18>>,
    s5_start: DataRegister<U<18>>,
    s6_start: DataRegister<U<18>>,
    s7_seed: DataRegister<U<18>>,
    s18_seed: Delay<18, 11>,
    s10_low: DspProduct<18, 18, 36>,
    s8_cross: DataRegister<U<18>>,
    s9_cross: DataRegister<U<18>>,
    s10_cross: DataRegister<U<18>>,
    s11_square: DataRegister<U<36>>,
    s14_00: DspProduct<18, 18, 36>,
    s14_01: DspProduct<18, 18, 36>,
    s14_10: DspProduct<18, 18, 36>,
    s14_11: DspProduct<18, 18, 36>,
    s12_upper: DataRegister<U<19>>,
    s13_upper: DataRegister<U<19>>,
    s14_upper: DataRegister<U<19>>,
    s15_low: DataRegister<U<34>>,
    s15_middle: DataRegister<U<36>>,
    s15_upper: DataRegister<U<19>>,
    s16_middle: DataRegister<U<36>>,
    s16_upper: DataRegister<U<19>>,
    s16_exact: DataRegister<Bit>,
    s17_product: DataRegister<U<21>>,
    s17_exact: DataRegister<Bit>,
    s18_error: DataRegister<S<21>>,
    s21_low: DspProduct<18, 18, 36>,
    s21_high: DspProduct<18, 4, 22>,
    s19_upper: DataRegister<S<23>>,
    s20_upper: DataRegister<S<23>>,
    s21_upper: DataRegister<S<23>>,
    s22_step: DataRegister<S<19>>,
    s22_seed: Delay<18, 4>,
    s23_sum: DataRegister<U<32>>,
    seed_low: Wire<U<17>>,
    above: Wire<U<18>>,
    square: Wire<U<36>>,
    x_low: Wire<S<18>>,
    x_high: Wire<S<18>>,
    square_low: Wire<S<18>>,
    square_high: Wire<S<18>>,
    x_whole: Wire<U<19>>,
    upper_1: Wire<U<19>>,
    upper_2: Wire<U<19>>,
    high: Wire<U<19>>,
    product: Wire<U<21>>,
    late_low: Wire<S<18>>,
    upper: Wire<S<23>>,
    step: Wire<S<23>>,
}

impl InverseRoot {
    /// Cycles from number to root.
    pub const LATENCY: usize = 23;
}

impl Logic for InverseRoot {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self, clock, lines, s11_x, s18_seed, s22_seed, s6_fall, s6_start, s10_low, s14_00, s14_01, s14_10, s14_11
        );
        clock!(self, clock, s21_low, s21_high);
        dff_setup!(self, clock, s1_index, s1_h, s2_h, s3_h, s4_start, s5_start, s6_start, s7_seed, s8_cross, s9_cross);
        dff_setup!(self, clock, s10_cross, s11_square, s12_upper);
        dff_setup!(self, clock, s13_upper, s14_upper, s15_low, s15_middle, s15_upper, s16_middle, s16_upper, s16_exact);
        dff_setup!(self, clock, s17_product, s17_exact, s18_error, s19_upper, s20_upper, s21_upper, s22_step, s23_sum);
        self.root.next = self.s23_sum.q.val();

        self.lines.go.next = self.go.val();
        self.lines.index.next = self.s1_index.q.val();
        self.s11_x.go.next = self.go.val();
        self.s11_x.value.next = self.number.val();
        self.s6_fall.go.next = self.go.val();
        self.s6_fall.a.next = bit_cast_to::<S<12>>(self.lines.slope.val());
        self.s6_fall.b.next = bit_cast_to::<S<12>>(self.s3_h.q.val());
        self.s22_seed.go.next = self.go.val();
        self.s22_seed.value.next = self.s18_seed.delayed.val();
        self.s18_seed.go.next = self.go.val();
        self.s18_seed.value.next = self.s7_seed.q.val();

        // s8 to s11: y = top 2^17 + low; y^2 = low^2 + top (low 2^18 + 2^34).
        self.seed_low.next = self.s7_seed.q.val().get_bits::<17>(0);
        self.s10_low.go.next = self.go.val();
        self.s10_low.a.next = bit_cast_to::<S<18>>(self.seed_low.val());
        self.s10_low.b.next = bit_cast_to::<S<18>>(self.seed_low.val());
        self.above.next = 0.into();
        if self.s7_seed.q.val().get_bit(17) {
            // 2^34 is 2^16 of these units, and low below 2^17.
            self.above.next = bit_cast_to::<U<18>>(self.seed_low.val()) + 0x1_0000;
        }
        self.square.next =
            bit_cast_to::<U<36>>(self.s10_low.p.val()) + (bit_cast_to::<U<36>>(self.s10_cross.q.val()) << 18);

        // s12 to s14: the two bits above the digits of y^2 choose what is added.
        self.x_low.next = bit_cast_to::<S<18>>(self.s11_x.delayed.val().get_bits::<17>(0));
        self.x_high.next = bit_cast_to::<S<18>>(self.s11_x.delayed.val().get_bits::<15>(17));
        self.square_low.next = bit_cast_to::<S<18>>(self.s11_square.q.val().get_bits::<17>(0));
        self.square_high.next = bit_cast_to::<S<18>>(self.s11_square.q.val().get_bits::<17>(17));
        self.s14_00.go.next = self.go.val();
        self.s14_00.a.next = self.x_low.val();
        self.s14_00.b.next = self.square_low.val();
        self.s14_01.go.next = self.go.val();
        self.s14_01.a.next = self.x_low.val();
        self.s14_01.b.next = self.square_high.val();
        self.s14_10.go.next = self.go.val();
        self.s14_10.a.next = self.x_high.val();
        self.s14_10.b.next = self.square_low.val();
        self.s14_11.go.next = self.go.val();
        self.s14_11.a.next = self.x_high.val();
        self.s14_11.b.next = self.square_high.val();
        self.x_whole.next = bit_cast_to::<U<19>>(self.s11_x.delayed.val());
        self.upper_1.next = 0.into();
        if self.s11_square.q.val().get_bit(34) {
            self.upper_1.next = self.x_whole.val();
        }
        self.upper_2.next = 0.into();
        if self.s11_square.q.val().get_bit(35) {
            self.upper_2.next = self.x_whole.val() << 1;
        }

        // s17: nineteen bits from 2^34 on, and two below them.
        self.high.next = bit_cast_to::<U<19>>(self.s16_middle.q.val() >> 17) + self.s16_upper.q.val();
        self.product.next = (bit_cast_to::<U<21>>(self.high.val()) << 2)
            | bit_cast_to::<U<21>>(self.s16_middle.q.val().get_bits::<2>(15));

        // s19 to s21: e has four bits above a digit.
        self.late_low.next = bit_cast_to::<S<18>>(self.s18_seed.delayed.val().get_bits::<17>(0));
        self.s21_low.go.next = self.go.val();
        self.s21_low.a.next = self.late_low.val();
        self.s21_low.b.next = bit_cast_to::<S<18>>(self.s18_error.q.val().get_bits::<17>(0));
        self.s21_high.go.next = self.go.val();
        self.s21_high.a.next = self.late_low.val();
        self.s21_high.b.next = bit_cast_to::<S<4>>(self.s18_error.q.val() >> 17);
        self.upper.next = 0.into();
        if self.s18_seed.delayed.val().get_bit(17) {
            self.upper.next = bit_cast_to::<S<23>>(self.s18_error.q.val());
        }

        // s22: the product without its lower 17 bits.
        self.step.next = bit_cast_to::<S<23>>(self.s21_low.p.val() >> 17)
            + bit_cast_to::<S<23>>(self.s21_high.p.val())
            + self.s21_upper.q.val();

        if self.go.val() {
            if self.number.val().get_bit(31) {
                self.s1_index.d.next = bit_cast_to::<U<7>>(self.number.val().get_bits::<6>(25)) | 0x40;
                self.s1_h.d.next = self.number.val().get_bits::<11>(14);
            } else {
                self.s1_index.d.next = bit_cast_to::<U<7>>(self.number.val().get_bits::<6>(24));
                self.s1_h.d.next = self.number.val().get_bits::<11>(13);
            }
            self.s2_h.d.next = self.s1_h.q.val();
            self.s3_h.d.next = self.s2_h.q.val();
            self.s4_start.d.next = self.lines.start.val();
            self.s5_start.d.next = self.s4_start.q.val();
            self.s6_start.d.next = self.s5_start.q.val();
            self.s7_seed.d.next = self.s6_start.q.val() - bit_cast_to::<U<18>>(self.s6_fall.p.val() >> 11);
            self.s8_cross.d.next = self.above.val();
            self.s9_cross.d.next = self.s8_cross.q.val();
            self.s10_cross.d.next = self.s9_cross.q.val();
            self.s11_square.d.next = self.square.val();
            self.s12_upper.d.next = self.upper_1.val() + self.upper_2.val();
            self.s13_upper.d.next = self.s12_upper.q.val();
            self.s14_upper.d.next = self.s13_upper.q.val();
            self.s15_low.d.next = bit_cast_to::<U<34>>(self.s14_00.p.val());
            self.s15_middle.d.next =
                bit_cast_to::<U<36>>(self.s14_01.p.val()) + bit_cast_to::<U<36>>(self.s14_10.p.val());
            self.s15_upper.d.next = bit_cast_to::<U<19>>(self.s14_11.p.val()) + self.s14_upper.q.val();
            self.s16_middle.d.next =
                bit_cast_to::<U<36>>(self.s15_low.q.val().get_bits::<17>(17)) + self.s15_middle.q.val();
            self.s16_upper.d.next = self.s15_upper.q.val();
            self.s16_exact.d.next = self.s15_low.q.val().get_bits::<17>(0) == 0;
            self.s17_product.d.next = self.product.val();
            self.s17_exact.d.next = self.s16_exact.q.val() && self.s16_middle.q.val().get_bits::<15>(0) == 0;
            self.s18_error.d.next =
                bit_cast_to::<S<21>>(!self.s17_product.q.val()) + bit_cast_to::<S<21>>(self.s17_exact.q.val());
            self.s19_upper.d.next = self.upper.val();
            self.s20_upper.d.next = self.s19_upper.q.val();
            self.s21_upper.d.next = self.s20_upper.q.val();
            self.s22_step.d.next = bit_cast_to::<S<19>>(self.step.val() >> 4);
            self.s23_sum.d.next =
                (bit_cast_to::<U<32>>(self.s22_seed.delayed.val()) << 14) + bit_cast_to::<U<32>>(self.s22_step.q.val());
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("inverse_root")
    }
}

latches! { [] InverseRoot: lines, s11_x, s18_seed, s22_seed, s6_fall, s4_start, s5_start, s6_start, s10_low, s14_00, s14_01, s14_10, s14_11, s21_low, s21_high, s1_index, s1_h, s2_h, s3_h, s7_seed, s8_cross, s9_cross, s10_cross, s11_square, s12_upper, s13_upper, s14_upper, s15_low, s15_middle, s15_upper, s16_middle, s16_upper, s16_exact, s17_product, s17_exact, s18_error, s19_upper, s20_upper, s21_upper, s22_step, s23_sum }
