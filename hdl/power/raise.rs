// SPDX-License-Identifier: MIT OR Apache-2.0
//! A register to a power.
//!
//! | stage               | operation                              | width |   Latency 27, interval 1; holds while `go` is low
//! | s1 .. s5            | leading zeros of x, and its mantissa   | 17 bits |
//! | s6, s7              | the line of its logarithm              | start UQ0.24, rise 19 bits |
//! | s8_below            | zeros - start                          | UQ5.24: at least 0 because x is at most 1 |
//! | s8 .. s10, s11_rise | rise along the line                    | 10 bits of x are left: 29 bits, of which 10 go |
//! | s12_logarithm       | -log2 x = zeros - start - rise         | UQ5.24 |
//! | s13 .. s17          | times n                                | 37 bits |
//! | s18, s19            | the line of the fraction's power       | start UQ1.24, fall 18 bits |
//! | s20 .. s22, s23_fall | fall along the line                   | 36 bits, of which 18 go |
//! | s24_value           | start - fall                           | UQ1.24 |
//! | s25, s26            | shifted by the whole part and 7        | 18 bits |
//! | s27_power           | rounded half up                        | UQ1.16 |
//!
//! The two bits of the rise above a digit, and the one of fall and place, choose what is added, and are not multiplied.

use super::{ExpTable, LogTable};
use crate::pipeline::{Delay, DspProduct, Leading, Product2x1};
use crate::prelude::*;

/// Power of a register.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Raise {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// UQ1.16, at most 1.0.
    pub base: Input<U<17>>,
    /// At least 1.
    pub exponent: Input<U<8>>,
    /// UQ1.16.
    pub power: Output<U<17>>,
    leading: Leading,
    log_lines: LogTable,
    s6_along: DataRegister<U<10>>,
    s7_along: DataRegister<U<10>>,
    s6_zeros: DataRegister<U<6>>,
    s7_zeros: DataRegister<U<6>>,
    s10_low: DspProduct<18, 11, 29>,
    s8_upper: DataRegister<U<12>>,
    s9_upper: DataRegister<U<12>>,
    s10_upper: DataRegister<U<12>>,
    s8_below: DataRegister<U<29>>,
    s9_below: DataRegister<U<29>>,
    s10_below: DataRegister<U<29>>,
    s11_below: DataRegister<U<29>>,
    s11_rise: DataRegister<U<19>>,
    s12_logarithm: DataRegister<U<29>>,
    s12_exponent: Delay<8, 12>,
    s17_product: Product2x1<30, 38>,
    exp_lines: ExpTable,
    s18_along: DataRegister<U<18>>,
    s19_along: DataRegister<U<18>>,
    s22_low: DspProduct<18, 18, 36>,
    s20_upper: DataRegister<U<19>>,
    s21_upper: DataRegister<U<19>>,
    s22_upper: DataRegister<U<19>>,
    s23_start: Delay<25, 4>,
    s23_fall: DataRegister<U<18>>,
    s24_value: DataRegister<U<25>>,
    s17_zero: Delay<1, 12>,
    /// Bits of the whole part, and nothing is left.
    s18_whole: DataRegister<U<6>>,
    s24_whole: Delay<6, 6>,
    s25_value: DataRegister<U<18>>,
    s25_whole: DataRegister<U<6>>,
    s26_value: DataRegister<U<18>>,
    s26_nothing: DataRegister<Bit>,
    s27_power: DataRegister<U<17>>,
    rise_1: Wire<U<12>>,
    rise_2: Wire<U<12>>,
    nothing: Wire<Bit>,
    fall_1: Wire<U<19>>,
    along_1: Wire<U<19>>,
    fall: Wire<U<20>>,
    coarse: Wire<U<6>>,
    fine: Wire<U<6>>,
}

impl Raise {
    /// Cycles from number to power.
    pub const LATENCY: usize = 27;
}

impl Logic for Raise {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, leading, log_lines, s10_low, s12_exponent, s17_product, exp_lines, s22_low);
        clock!(self, clock, s23_start, s17_zero, s24_whole);
        dff_setup!(self, clock, s6_along, s7_along, s6_zeros, s7_zeros, s8_upper, s9_upper, s10_upper);
        dff_setup!(self, clock, s8_below, s9_below, s10_below, s11_below, s11_rise, s12_logarithm);
        dff_setup!(self, clock, s18_along, s19_along, s20_upper, s21_upper, s22_upper, s23_fall, s24_value);
        dff_setup!(self, clock, s18_whole, s25_value, s25_whole, s26_value, s26_nothing, s27_power);
        self.power.next = self.s27_power.q.val();

        // s1 to s7: 17 of the 48 bits, the upper ones.
        self.leading.go.next = self.go.val();
        self.leading.value.next = bit_cast_to::<U<48>>(self.base.val()) << 31;
        self.log_lines.go.next = self.go.val();
        self.log_lines.index.next = self.leading.mantissa.val().get_bits::<6>(25);
        self.s17_zero.go.next = self.go.val();
        self.s17_zero.value.next = self.leading.zeros.val().get_bits::<1>(5);

        // s8 to s10
        self.s10_low.go.next = self.go.val();
        self.s10_low.a.next = bit_cast_to::<S<18>>(self.log_lines.slope.val().get_bits::<17>(0));
        self.s10_low.b.next = bit_cast_to::<S<11>>(self.s7_along.q.val());
        self.rise_1.next = 0.into();
        if self.log_lines.slope.val().get_bit(17) {
            self.rise_1.next = bit_cast_to::<U<12>>(self.s7_along.q.val());
        }
        self.rise_2.next = 0.into();
        if self.log_lines.slope.val().get_bit(18) {
            self.rise_2.next = bit_cast_to::<U<12>>(self.s7_along.q.val()) << 1;
        }

        // s13 to s19
        self.s12_exponent.go.next = self.go.val();
        self.s12_exponent.value.next = self.exponent.val();
        self.s17_product.go.next = self.go.val();
        self.s17_product.a.next = bit_cast_to::<S<30>>(self.s12_logarithm.q.val());
        self.s17_product.b.next = bit_cast_to::<S<18>>(self.s12_exponent.delayed.val());
        self.exp_lines.go.next = self.go.val();
        self.exp_lines.index.next = self.s17_product.p.val().get_bits::<6>(18);
        self.nothing.next = self.s17_product.p.val().get_bits::<8>(29).any() || self.s17_zero.delayed.val().any();
        self.s24_whole.go.next = self.go.val();
        self.s24_whole.value.next = self.s18_whole.q.val();

        // s20 to s23
        self.s22_low.go.next = self.go.val();
        self.s22_low.a.next = bit_cast_to::<S<18>>(self.exp_lines.slope.val().get_bits::<17>(0));
        self.s22_low.b.next = bit_cast_to::<S<18>>(self.s19_along.q.val().get_bits::<17>(0));
        self.fall_1.next = 0.into();
        if self.s19_along.q.val().get_bit(17) {
            self.fall_1.next = bit_cast_to::<U<19>>(self.exp_lines.slope.val().get_bits::<17>(0));
        }
        self.along_1.next = 0.into();
        if self.exp_lines.slope.val().get_bit(17) {
            self.along_1.next = bit_cast_to::<U<19>>(self.s19_along.q.val());
        }
        self.s23_start.go.next = self.go.val();
        self.s23_start.value.next = self.exp_lines.start.val();
        self.fall.next =
            bit_cast_to::<U<20>>(self.s22_low.p.val() >> 17) + bit_cast_to::<U<20>>(self.s22_upper.q.val());

        // s25, s26: whole parts above 17 leave nothing of 18 bits.
        self.coarse.next = self.s24_whole.delayed.val() & 0x1c;
        self.fine.next = self.s25_whole.q.val() & 0x03;

        if self.go.val() {
            self.s6_along.d.next = self.leading.mantissa.val().get_bits::<10>(15);
            self.s7_along.d.next = self.s6_along.q.val();
            self.s6_zeros.d.next = self.leading.zeros.val();
            self.s7_zeros.d.next = self.s6_zeros.q.val();
            self.s8_upper.d.next = self.rise_1.val() + self.rise_2.val();
            self.s9_upper.d.next = self.s8_upper.q.val();
            self.s10_upper.d.next = self.s9_upper.q.val();
            self.s8_below.d.next =
                (bit_cast_to::<U<29>>(self.s7_zeros.q.val()) << 24) - bit_cast_to::<U<29>>(self.log_lines.start.val());
            self.s9_below.d.next = self.s8_below.q.val();
            self.s10_below.d.next = self.s9_below.q.val();
            self.s11_below.d.next = self.s10_below.q.val();
            self.s11_rise.d.next =
                bit_cast_to::<U<19>>(self.s10_low.p.val() >> 10) + (bit_cast_to::<U<19>>(self.s10_upper.q.val()) << 7);
            self.s12_logarithm.d.next = self.s11_below.q.val() - bit_cast_to::<U<29>>(self.s11_rise.q.val());
            self.s18_along.d.next = self.s17_product.p.val().get_bits::<18>(0);
            self.s19_along.d.next = self.s18_along.q.val();
            self.s18_whole.d.next = bit_cast_to::<U<6>>(self.s17_product.p.val().get_bits::<5>(24))
                | (bit_cast_to::<U<6>>(self.nothing.val()) << 5);
            self.s20_upper.d.next = self.fall_1.val() + self.along_1.val();
            self.s21_upper.d.next = self.s20_upper.q.val();
            self.s22_upper.d.next = self.s21_upper.q.val();
            self.s23_fall.d.next = bit_cast_to::<U<18>>(self.fall.val() >> 1);
            self.s24_value.d.next = self.s23_start.delayed.val() - bit_cast_to::<U<25>>(self.s23_fall.q.val());
            self.s25_value.d.next = self.s24_value.q.val().get_bits::<18>(7) >> self.coarse.val();
            self.s25_whole.d.next = self.s24_whole.delayed.val();
            self.s26_value.d.next = self.s25_value.q.val() >> self.fine.val();
            self.s26_nothing.d.next = self.s25_whole.q.val().get_bit(5);
            self.s27_power.d.next = bit_cast_to::<U<17>>((self.s26_value.q.val() + 1) >> 1);
            if self.s26_nothing.q.val() {
                self.s27_power.d.next = 0.into();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("raise")
    }
}

latches! { [] Raise: leading, log_lines, s6_along, s7_along, s6_zeros, s7_zeros, s10_low, s8_upper, s9_upper, s10_upper, s8_below, s9_below, s10_below, s11_below, s11_rise, s12_logarithm, s12_exponent, s17_product, exp_lines, s18_along, s19_along, s22_low, s20_upper, s21_upper, s22_upper, s23_start, s23_fall, s24_value, s17_zero, s18_whole, s24_whole, s25_value, s25_whole, s26_value, s26_nothing, s27_power }
