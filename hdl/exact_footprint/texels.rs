// SPDX-License-Identifier: MIT OR Apache-2.0
//! The texels of a step: numerator times inverse square.
//!
//! `texels = mantissa square 2^-(size + exponent)`, UQ16.16, saturates
//!
//! | stage            | operation                    | width |   Latency 7, interval 1; holds while `go` is low
//! | s1 .. s3_product | mantissa square              | 34 bits |
//! | s2_shift         | size + exponent              | signed 8 |
//! | s3_amount        | below 0 as 0, above 63 as 63 | unsigned 6 |
//! | s4 .. s6_texels  | >> amount                    | |
//! | s7_texels        | UQ16.16                      | saturates at 32 bits |
//!
//! `mantissa` and `square` come at the beginning, `size` and `exponent` a cycle later. A product has 33 bits at least, or is 0:
//! what were to be shifted to the left saturates as it is, and what is shifted by 34 or more is 0.

use crate::pipeline::{DspProduct, ShiftRight};
use crate::prelude::*;

/// Texels of a step.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Texels {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub mantissa: Input<U<17>>,
    pub square: Input<U<17>>,
    pub size: Input<S<8>>,
    pub exponent: Input<S<8>>,
    pub texels: Output<U<32>>,
    s3_product: DspProduct<18, 18, 36>,
    s2_shift: DataRegister<S<8>>,
    s3_amount: DataRegister<U<6>>,
    s6_texels: ShiftRight<36>,
    s7_texels: DataRegister<U<32>>,
    most_amount: Constant<U<6>>,
    most_texels: Constant<U<32>>,
}

impl Default for Texels {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            mantissa: Input::default(),
            square: Input::default(),
            size: Input::default(),
            exponent: Input::default(),
            texels: Output::default(),
            s3_product: DspProduct::default(),
            s2_shift: DataRegister::default(),
            s3_amount: DataRegister::default(),
            s6_texels: ShiftRight::default(),
            s7_texels: DataRegister::default(),
            most_amount: Constant::new(U::MAX),
            most_texels: Constant::new(U::MAX),
        }
    }
}

impl Texels {
    /// Cycles from mantissas to texels.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + ShiftRight::<36>::LATENCY + 1;
}

impl Logic for Texels {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_product, s6_texels);
        dff_setup!(self, clock, s2_shift, s3_amount, s7_texels);
        self.texels.next = self.s7_texels.q.val();
        self.s3_product.go.next = self.go.val();
        self.s3_product.a.next = bit_cast_to::<S<18>>(self.mantissa.val());
        self.s3_product.b.next = bit_cast_to::<S<18>>(self.square.val());
        self.s6_texels.go.next = self.go.val();
        self.s6_texels.value.next = self.s3_product.p.val();
        self.s6_texels.amount.next = self.s3_amount.q.val();
        if self.go.val() {
            self.s2_shift.d.next = self.size.val() + self.exponent.val();
            self.s3_amount.d.next = bit_cast_to::<U<6>>(self.s2_shift.q.val());
            if self.s2_shift.q.val() < 0 {
                self.s3_amount.d.next = 0.into();
            } else if self.s2_shift.q.val().get_bit(6) {
                self.s3_amount.d.next = self.most_amount.val();
            }
            self.s7_texels.d.next = self.s6_texels.shifted.val().get_bits::<32>(0);
            if self.s6_texels.shifted.val().get_bits::<4>(32).any() {
                self.s7_texels.d.next = self.most_texels.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("footprint_texels")
    }
}

latches! { [] Texels: s3_product, s2_shift, s3_amount, s6_texels, s7_texels }
