// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a normalised number to its reciprocal.
//!
//! | stage        | operation                             | width    |   Latency 16, interval 1; holds while `go` is low
//! | s1, s2       | the line of m[30:24]                  | start UQ0.20, fall 13 bits |
//! | s3 .. s5_fall | fall h, h = m[23:13]                 | 24 bits |
//! | s6_seed      | start - (fall h >> 11)                | UQ0.20: between the line's ends |
//! | s7 .. s9     | products of digits of m and seed      | 34 bits |
//! | s10_product  | m seed / 2^17, modulo 2^19            | it is within 2^18 of 2^34, which is 0 |
//! | s11_error    | e = floor((2^51 - m seed) / 2^17)     | signed 19: below 2^17.7, SQ0.34 |
//! | s12 .. s14   | products of digits of seed and e      | 34 bits |
//! | s15_step     | floor(seed e / 2^22)                  | signed 18: below 2^15.7 |
//! | s16_sum      | seed 2^12 + step                      | UQ0.32: below the true value |
//!
//! The seed is three bits longer than a digit, and e two: what these multiply is chosen and added, not multiplied.
//! -m seed = ~(m seed) + 1, whose carry reaches the error only if all bits that are dropped are zero.

use super::ReciprocalTable;
use crate::pipeline::{Delay, DspProduct};
use crate::prelude::*;

/// Reciprocal of a register.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Newton {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// UQ1.31; the leading bit is taken for set.
    pub m: Input<U<32>>,
    /// UQ0.32.
    pub reciprocal: Output<U<32>>,
    lines: ReciprocalTable,
    s1_h: DataRegister<U<11>>,
    s2_h: DataRegister<U<11>>,
    s6_m: Delay<31, 6>,
    s5_fall: DspProduct<14, 12, 26>,
    s3_start: DataRegister<U<20>>,
    s4_start: DataRegister<U<20>>,
    s5_start: DataRegister<U<20>>,
    s6_seed: DataRegister<U<20>>,
    s9_low: DspProduct<18, 18, 36>,
    s9_high: DspProduct<16, 18, 34>,
    s7_upper: DataRegister<U<19>>,
    s8_upper: DataRegister<U<19>>,
    s9_upper: DataRegister<U<19>>,
    s11_seed: Delay<20, 5>,
    s10_product: DataRegister<U<19>>,
    s10_exact: DataRegister<Bit>,
    s11_error: DataRegister<S<19>>,
    s14_low: DspProduct<18, 18, 36>,
    s12_high: DataRegister<S<23>>,
    s12_upper: DataRegister<S<23>>,
    s13_upper: DataRegister<S<23>>,
    s14_upper: DataRegister<S<23>>,
    s15_step: DataRegister<S<18>>,
    s15_seed: Delay<20, 4>,
    s16_sum: DataRegister<U<32>>,
    m_high: Wire<U<15>>,
    m_whole: Wire<U<19>>,
    upper_1: Wire<U<19>>,
    upper_2: Wire<U<19>>,
    upper_4: Wire<U<19>>,
    product: Wire<U<19>>,
    negative: Wire<U<19>>,
    seed_low: Wire<S<23>>,
    error: Wire<S<23>>,
    error_high: Wire<S<23>>,
    error_top: Wire<S<23>>,
    step_1: Wire<S<23>>,
    step_2: Wire<S<23>>,
    step_4: Wire<S<23>>,
    step: Wire<S<23>>,
}

impl Newton {
    /// Cycles from number to reciprocal.
    pub const LATENCY: usize = 16;
}

impl Logic for Newton {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, lines, s6_m, s5_fall, s9_low, s9_high, s11_seed, s14_low, s15_seed);
        dff_setup!(self, clock, s1_h, s2_h, s3_start, s4_start, s5_start, s6_seed, s7_upper);
        dff_setup!(self, clock, s8_upper, s9_upper, s10_product, s10_exact, s11_error);
        dff_setup!(self, clock, s12_high, s12_upper, s13_upper, s14_upper, s15_step, s16_sum);
        self.reciprocal.next = self.s16_sum.q.val();

        self.lines.go.next = self.go.val();
        self.lines.index.next = self.m.val().get_bits::<7>(24);
        self.s6_m.go.next = self.go.val();
        self.s6_m.value.next = self.m.val().get_bits::<31>(0);
        self.s5_fall.go.next = self.go.val();
        self.s5_fall.a.next = bit_cast_to::<S<14>>(self.lines.slope.val());
        self.s5_fall.b.next = bit_cast_to::<S<12>>(self.s2_h.q.val());

        self.s11_seed.go.next = self.go.val();
        self.s11_seed.value.next = self.s6_seed.q.val();
        self.s15_seed.go.next = self.go.val();
        self.s15_seed.value.next = self.s11_seed.delayed.val();

        // s7 to s9: the upper digit of m with its leading bit; the three upper bits of the seed choose what is added.
        self.m_high.next = bit_cast_to::<U<15>>(self.s6_m.delayed.val() >> 17) | 0x4000;
        self.m_whole.next = bit_cast_to::<U<19>>(self.s6_m.delayed.val());
        self.s9_low.go.next = self.go.val();
        self.s9_low.a.next = bit_cast_to::<S<18>>(self.s6_m.delayed.val().get_bits::<17>(0));
        self.s9_low.b.next = bit_cast_to::<S<18>>(self.s6_seed.q.val().get_bits::<17>(0));
        self.s9_high.go.next = self.go.val();
        self.s9_high.a.next = bit_cast_to::<S<16>>(self.m_high.val());
        self.s9_high.b.next = bit_cast_to::<S<18>>(self.s6_seed.q.val().get_bits::<17>(0));
        self.upper_1.next = 0.into();
        if self.s6_seed.q.val().get_bit(17) {
            self.upper_1.next = self.m_whole.val();
        }
        self.upper_2.next = 0.into();
        if self.s6_seed.q.val().get_bit(18) {
            self.upper_2.next = self.m_whole.val() << 1;
        }
        self.upper_4.next = 0.into();
        if self.s6_seed.q.val().get_bit(19) {
            self.upper_4.next = self.m_whole.val() << 2;
        }

        // s10, s11
        self.product.next = bit_cast_to::<U<19>>(self.s9_low.p.val() >> 17)
            + bit_cast_to::<U<19>>(self.s9_high.p.val())
            + self.s9_upper.q.val();
        self.negative.next = !self.s10_product.q.val() + bit_cast_to::<U<19>>(self.s10_exact.q.val());

        // s12 to s14: the two upper bits of e count -2 and 1, the three of the seed 1, 2 and 4.
        self.seed_low.next = bit_cast_to::<S<23>>(self.s11_seed.delayed.val().get_bits::<17>(0));
        self.error.next = bit_cast_to::<S<23>>(self.s11_error.q.val());
        self.s14_low.go.next = self.go.val();
        self.s14_low.a.next = bit_cast_to::<S<18>>(self.s11_seed.delayed.val().get_bits::<17>(0));
        self.s14_low.b.next = bit_cast_to::<S<18>>(self.s11_error.q.val().get_bits::<17>(0));
        self.error_high.next = 0.into();
        if self.s11_error.q.val().get_bit(17) {
            self.error_high.next = self.seed_low.val();
        }
        self.error_top.next = 0.into();
        if self.s11_error.q.val().get_bit(18) {
            self.error_top.next = self.seed_low.val() << 1;
        }
        self.step_1.next = 0.into();
        if self.s11_seed.delayed.val().get_bit(17) {
            self.step_1.next = self.error.val();
        }
        self.step_2.next = 0.into();
        if self.s11_seed.delayed.val().get_bit(18) {
            self.step_2.next = self.error.val() << 1;
        }
        self.step_4.next = 0.into();
        if self.s11_seed.delayed.val().get_bit(19) {
            self.step_4.next = self.error.val() << 2;
        }

        // s15: the product without its lower 17 bits.
        self.step.next = bit_cast_to::<S<23>>(self.s14_low.p.val() >> 17) + self.s14_upper.q.val();

        if self.go.val() {
            self.s1_h.d.next = self.m.val().get_bits::<11>(13);
            self.s2_h.d.next = self.s1_h.q.val();
            self.s3_start.d.next = self.lines.start.val();
            self.s4_start.d.next = self.s3_start.q.val();
            self.s5_start.d.next = self.s4_start.q.val();
            self.s6_seed.d.next = self.s5_start.q.val() - bit_cast_to::<U<20>>(self.s5_fall.p.val() >> 11);
            self.s7_upper.d.next = self.upper_1.val() + self.upper_2.val() + self.upper_4.val();
            self.s8_upper.d.next = self.s7_upper.q.val();
            self.s9_upper.d.next = self.s8_upper.q.val();
            self.s10_product.d.next = self.product.val();
            self.s10_exact.d.next = self.s9_low.p.val().get_bits::<17>(0) == 0;
            self.s11_error.d.next = bit_cast_to::<S<19>>(self.negative.val());
            self.s12_high.d.next = self.error_high.val() - self.error_top.val();
            self.s12_upper.d.next = self.step_1.val() + self.step_2.val() + self.step_4.val();
            self.s13_upper.d.next = self.s12_high.q.val() + self.s12_upper.q.val();
            self.s14_upper.d.next = self.s13_upper.q.val();
            self.s15_step.d.next = bit_cast_to::<S<18>>(self.step.val() >> 5);
            self.s16_sum.d.next =
                (bit_cast_to::<U<32>>(self.s15_seed.delayed.val()) << 12) + bit_cast_to::<U<32>>(self.s15_step.q.val());
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("newton")
    }
}

latches! { [] Newton: lines, s6_m, s5_fall, s3_start, s4_start, s5_start, s9_low, s9_high, s11_seed, s14_low, s15_seed, s1_h, s2_h, s6_seed, s7_upper, s8_upper, s9_upper, s10_product, s10_exact, s11_error, s12_high, s12_upper, s13_upper, s14_upper, s15_step, s16_sum }
