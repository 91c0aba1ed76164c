// SPDX-License-Identifier: MIT OR Apache-2.0
//! One coordinate: lane times reciprocal, rounded, and snapped to the ends of its axis.
//!
//! | stage            | operation                             | width    |   Latency 18, interval 1; holds while `go` is low
//! | s1 .. s6_product | lane reciprocal                       | 63 bits |
//! | s7 .. s9_shift   | all of its shift but one              | by 62 - zeros - texel_bits, 0 ..= 44 |
//! | s10_low           | 32 bits, and whether there are more   | more is beyond any size |
//! | s11_texel        | one more bit, rounded half up         | at most 2^31, signed 34 |
//! | s12, s13_texel   | a period off where it repeats: is it beyond, then which | from -2^10 on |
//! | s14, s15_texel   | once more                             | |
//! | s16, s17_texel   | what is still at the end or beyond it | below the period, or size - 1 |
//! | s18_texel        | what is near 0 is 0                   | UQ13.16: a size is at most 2^13 texels |
//!
//! A texel is taken off or clamped from `bound` on: size - 2^-6 where the axis repeats, size - 1 - 2^-6 where it does not.
//! Three periods are below 2^31, so it does not matter what a quotient beyond 32 bits becomes.
//!
//! Golden: models::perspective_correct::golden

use crate::pipeline::{Delay, Product2x2, ShiftRight};
use crate::prelude::*;

/// One axis.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct TexelAxis {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub lane: Input<U<31>>,
    /// Of c 2^(zeros - 16).
    pub reciprocal: Input<U<32>>,
    pub zeros: Input<U<6>>,
    pub size: Input<U<14>>,
    pub repeats: Input<Bit>,
    pub texel_bits: Input<U<4>>,
    pub texel: Output<U<29>>,
    product: Product2x2<32, 33, 64>,
    s6_amount: Delay<6, 6>,
    shift: ShiftRight<64>,
    s10_low: DataRegister<U<32>>,
    s10_beyond: DataRegister<Bit>,
    /// Size, repeat << 14.
    s10_axis: Delay<15, 10>,
    s11_texel: DataRegister<S<34>>,
    s11_size: DataRegister<S<34>>,
    s11_bound: DataRegister<S<34>>,
    s11_repeat: DataRegister<Bit>,
    s12_texel: DataRegister<S<34>>,
    s12_less: DataRegister<S<34>>,
    s12_over: DataRegister<Bit>,
    s12_size: DataRegister<S<34>>,
    s12_bound: DataRegister<S<34>>,
    s12_repeat: DataRegister<Bit>,
    s13_texel: DataRegister<S<34>>,
    s13_size: DataRegister<S<34>>,
    s13_bound: DataRegister<S<34>>,
    s13_repeat: DataRegister<Bit>,
    s14_texel: DataRegister<S<34>>,
    s14_less: DataRegister<S<34>>,
    s14_over: DataRegister<Bit>,
    s14_bound: DataRegister<S<34>>,
    s14_repeat: DataRegister<Bit>,
    s15_texel: DataRegister<S<34>>,
    s15_bound: DataRegister<S<34>>,
    s15_repeat: DataRegister<Bit>,
    s16_texel: DataRegister<S<34>>,
    s16_end: DataRegister<S<34>>,
    s16_over: DataRegister<Bit>,
    s17_texel: DataRegister<S<34>>,
    s17_near: DataRegister<Bit>,
    s17_end_near: DataRegister<Bit>,
    s17_over: DataRegister<Bit>,
    s18_texel: DataRegister<U<29>>,
    doubled: Wire<U<33>>,
    size_16: Wire<S<34>>,
    snap: Constant<S<34>>,
    whole: Constant<S<34>>,
    most: Constant<S<34>>,
}

impl Default for TexelAxis {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            lane: Input::default(),
            reciprocal: Input::default(),
            zeros: Input::default(),
            size: Input::default(),
            repeats: Input::default(),
            texel_bits: Input::default(),
            texel: Output::default(),
            product: Product2x2::default(),
            s6_amount: Delay::default(),
            shift: ShiftRight::default(),
            s10_low: DataRegister::default(),
            s10_beyond: DataRegister::default(),
            s10_axis: Delay::default(),
            s11_texel: DataRegister::default(),
            s11_size: DataRegister::default(),
            s11_bound: DataRegister::default(),
            s11_repeat: DataRegister::default(),
            s12_texel: DataRegister::default(),
            s12_less: DataRegister::default(),
            s12_over: DataRegister::default(),
            s12_size: DataRegister::default(),
            s12_bound: DataRegister::default(),
            s12_repeat: DataRegister::default(),
            s13_texel: DataRegister::default(),
            s13_size: DataRegister::default(),
            s13_bound: DataRegister::default(),
            s13_repeat: DataRegister::default(),
            s14_texel: DataRegister::default(),
            s14_less: DataRegister::default(),
            s14_over: DataRegister::default(),
            s14_bound: DataRegister::default(),
            s14_repeat: DataRegister::default(),
            s15_texel: DataRegister::default(),
            s15_bound: DataRegister::default(),
            s15_repeat: DataRegister::default(),
            s16_texel: DataRegister::default(),
            s16_end: DataRegister::default(),
            s16_over: DataRegister::default(),
            s17_texel: DataRegister::default(),
            s17_near: DataRegister::default(),
            s17_end_near: DataRegister::default(),
            s17_over: DataRegister::default(),
            s18_texel: DataRegister::default(),
            doubled: Wire::default(),
            size_16: Wire::default(),
            snap: Constant::new(S::new(1 << 10)),
            whole: Constant::new(S::new(1 << 16)),
            most: Constant::new(S::new((1 << 31) - 1)),
        }
    }
}

impl TexelAxis {
    /// Cycles from lane and reciprocal to coordinate.
    pub const LATENCY: usize = Product2x2::<32, 33, 64>::LATENCY + ShiftRight::<64>::LATENCY + 9;
}

impl Logic for TexelAxis {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, product, s6_amount, shift, s10_axis);
        dff_setup!(self, clock, s10_low, s10_beyond, s11_texel, s11_size, s11_bound, s11_repeat);
        dff_setup!(self, clock, s12_texel, s12_less, s12_over, s12_size, s12_bound, s12_repeat);
        dff_setup!(self, clock, s13_texel, s13_size, s13_bound, s13_repeat);
        dff_setup!(self, clock, s14_texel, s14_less, s14_over, s14_bound, s14_repeat, s15_texel, s15_bound, s15_repeat);
        dff_setup!(self, clock, s16_texel, s16_end, s16_over, s17_texel, s17_near, s17_end_near, s17_over, s18_texel);
        self.texel.next = self.s18_texel.q.val();

        self.product.go.next = self.go.val();
        self.product.a.next = bit_cast_to::<S<32>>(self.lane.val());
        self.product.b.next = bit_cast_to::<S<33>>(self.reciprocal.val());
        self.s6_amount.go.next = self.go.val();
        self.s6_amount.value.next = !self.zeros.val() - bit_cast_to::<U<6>>(self.texel_bits.val()) - 1;
        self.shift.go.next = self.go.val();
        self.shift.value.next = self.product.p.val();
        self.shift.amount.next = self.s6_amount.delayed.val();
        self.s10_axis.go.next = self.go.val();
        self.s10_axis.value.next =
            bit_cast_to::<U<15>>(self.size.val()) | (bit_cast_to::<U<15>>(self.repeats.val()) << 14);

        // s11
        self.doubled.next = bit_cast_to::<U<33>>(self.s10_low.q.val()) + 1;
        self.size_16.next = bit_cast_to::<S<34>>(self.s10_axis.delayed.val().get_bits::<14>(0)) << 16;

        if self.go.val() {
            self.s10_low.d.next = self.shift.shifted.val().get_bits::<32>(0);
            self.s10_beyond.d.next = self.shift.shifted.val().get_bits::<31>(32).any();
            self.s11_texel.d.next = bit_cast_to::<S<34>>(self.doubled.val() >> 1);
            if self.s10_beyond.q.val() {
                self.s11_texel.d.next = self.most.val();
            }
            self.s11_size.d.next = self.size_16.val();
            self.s11_repeat.d.next = self.s10_axis.delayed.val().get_bit(14);
            self.s11_bound.d.next = self.size_16.val() - self.whole.val() - self.snap.val();
            if self.s10_axis.delayed.val().get_bit(14) {
                self.s11_bound.d.next = self.size_16.val() - self.snap.val();
            }
            self.s12_texel.d.next = self.s11_texel.q.val();
            self.s12_less.d.next = self.s11_texel.q.val() - self.s11_size.q.val();
            self.s12_over.d.next = self.s11_repeat.q.val() && self.s11_texel.q.val() >= self.s11_bound.q.val();
            self.s12_size.d.next = self.s11_size.q.val();
            self.s12_bound.d.next = self.s11_bound.q.val();
            self.s12_repeat.d.next = self.s11_repeat.q.val();
            self.s13_texel.d.next = self.s12_texel.q.val();
            if self.s12_over.q.val() {
                self.s13_texel.d.next = self.s12_less.q.val();
            }
            self.s13_size.d.next = self.s12_size.q.val();
            self.s13_bound.d.next = self.s12_bound.q.val();
            self.s13_repeat.d.next = self.s12_repeat.q.val();
            self.s14_texel.d.next = self.s13_texel.q.val();
            self.s14_less.d.next = self.s13_texel.q.val() - self.s13_size.q.val();
            self.s14_over.d.next = self.s13_repeat.q.val() && self.s13_texel.q.val() >= self.s13_bound.q.val();
            self.s14_bound.d.next = self.s13_bound.q.val();
            self.s14_repeat.d.next = self.s13_repeat.q.val();
            self.s15_texel.d.next = self.s14_texel.q.val();
            if self.s14_over.q.val() {
                self.s15_texel.d.next = self.s14_less.q.val();
            }
            self.s15_bound.d.next = self.s14_bound.q.val();
            self.s15_repeat.d.next = self.s14_repeat.q.val();
            self.s16_texel.d.next = self.s15_texel.q.val();
            self.s16_over.d.next = self.s15_texel.q.val() >= self.s15_bound.q.val();
            self.s16_end.d.next = self.s15_bound.q.val() + self.snap.val();
            if self.s15_repeat.q.val() {
                self.s16_end.d.next = self.s15_bound.q.val() - 1;
            }
            self.s17_texel.d.next = self.s16_texel.q.val();
            if self.s16_over.q.val() {
                self.s17_texel.d.next = self.s16_end.q.val();
            }
            // At most 2^-6, of bits rather than by a comparison, which would be a subtraction.
            self.s17_over.d.next = self.s16_over.q.val();
            self.s17_near.d.next = self.s16_texel.q.val().get_bit(33)
                || !(self.s16_texel.q.val().get_bits::<22>(11).any()
                    || (self.s16_texel.q.val().get_bit(10) && self.s16_texel.q.val().get_bits::<10>(0).any()));
            self.s17_end_near.d.next = self.s16_end.q.val().get_bit(33)
                || !(self.s16_end.q.val().get_bits::<22>(11).any()
                    || (self.s16_end.q.val().get_bit(10) && self.s16_end.q.val().get_bits::<10>(0).any()));
            self.s18_texel.d.next = bit_cast_to::<U<29>>(self.s17_texel.q.val());
            if (self.s17_near.q.val() && !self.s17_over.q.val()) || (self.s17_end_near.q.val() && self.s17_over.q.val())
            {
                self.s18_texel.d.next = 0.into();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("texel_axis")
    }
}

latches! { [] TexelAxis: product, s6_amount, shift, s10_low, s10_beyond, s10_axis, s11_texel, s11_size, s11_bound, s11_repeat, s12_texel, s12_less, s12_over, s12_size, s12_bound, s12_repeat, s13_texel, s13_size, s13_bound, s13_repeat, s14_texel, s14_less, s14_over, s14_bound, s14_repeat, s15_texel, s15_bound, s15_repeat, s16_texel, s16_end, s16_over, s17_texel, s17_near, s17_end_near, s17_over, s18_texel }
