// SPDX-License-Identifier: MIT OR Apache-2.0
//! The displacement in units of the vertex's distance.
//!
//! | stage             | operation                  | width    |   Latency 17, interval 1; holds while `go` is low
//! | s1 .. s6_product  | q range                    | signed 50 |
//! | s7_displacement   | d = minimum + (q range >> 16) | signed 35: 2^31 and 2^33 |
//! | s8 .. s13_product | d c                        | signed 67 |
//! | s14 .. s16_shift  | >> 33 - exponent           | by 18 ..= 63 |
//! | s17_delta         | SQ15.28                    | saturates at 44 bits |

use crate::pipeline::{Delay, Product2x2, ShiftRight};
use crate::prelude::*;

/// From height to displacement over distance.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Delta {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub q: Input<U<24>>,
    pub c: Input<U<31>>,
    pub minimum: Input<S<32>>,
    pub range: Input<S<26>>,
    pub exponent: Input<S<6>>,
    pub over_z: Output<S<44>>,
    s6_product: Product2x2<25, 26, 51>,
    s6_minimum: Delay<32, 6>,
    s7_displacement: DataRegister<S<35>>,
    s7_c: Delay<31, 7>,
    s13_product: Product2x2<35, 32, 67>,
    s13_amount: Delay<6, 13>,
    s16_shift: ShiftRight<67>,
    s17_delta: DataRegister<S<44>>,
    /// 33 - exponent.
    amount: Wire<U<6>>,
    /// The sign, and all that has to equal it.
    sign: Wire<Bit>,
    upper: Wire<U<23>>,
    most: Constant<S<44>>,
    least: Constant<S<44>>,
}

impl Default for Delta {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            q: Input::default(),
            c: Input::default(),
            minimum: Input::default(),
            range: Input::default(),
            exponent: Input::default(),
            over_z: Output::default(),
            s6_product: Product2x2::default(),
            s6_minimum: Delay::default(),
            s7_displacement: DataRegister::default(),
            s7_c: Delay::default(),
            s13_product: Product2x2::default(),
            s13_amount: Delay::default(),
            s16_shift: ShiftRight::default(),
            s17_delta: DataRegister::default(),
            amount: Wire::default(),
            sign: Wire::default(),
            upper: Wire::default(),
            most: Constant::new(S::MAX),
            least: Constant::new(S::MIN),
        }
    }
}

impl Delta {
    /// Cycles from height to displacement.
    pub const LATENCY: usize = 17;
}

impl Logic for Delta {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s6_product, s6_minimum, s7_c, s13_product, s13_amount, s16_shift);
        dff_setup!(self, clock, s7_displacement, s17_delta);
        self.over_z.next = self.s17_delta.q.val();
        self.s6_product.go.next = self.go.val();
        self.s6_product.a.next = bit_cast_to::<S<25>>(self.q.val());
        self.s6_product.b.next = self.range.val();
        self.s6_minimum.go.next = self.go.val();
        self.s6_minimum.value.next = bit_cast_to::<U<32>>(self.minimum.val());
        self.s7_c.go.next = self.go.val();
        self.s7_c.value.next = self.c.val();
        self.s13_product.go.next = self.go.val();
        self.s13_product.a.next = self.s7_displacement.q.val();
        self.s13_product.b.next = bit_cast_to::<S<32>>(self.s7_c.delayed.val());
        // Modulo 64 either way.
        self.amount.next = bit_cast_to::<U<6>>(-self.exponent.val()) + 33;
        self.s13_amount.go.next = self.go.val();
        self.s13_amount.value.next = self.amount.val();
        self.s16_shift.go.next = self.go.val();
        self.s16_shift.value.next = self.s13_product.p.val();
        self.s16_shift.amount.next = self.s13_amount.delayed.val();
        self.sign.next = self.s16_shift.shifted.val().get_bit(66);
        self.upper.next = self.s16_shift.shifted.val().get_bits::<23>(43);
        if self.go.val() {
            self.s7_displacement.d.next = bit_cast_to::<S<35>>(bit_cast_to::<S<32>>(self.s6_minimum.delayed.val()))
                + bit_cast_to::<S<35>>(self.s6_product.p.val() >> 16);
            self.s17_delta.d.next = bit_cast_to::<S<44>>(self.s16_shift.shifted.val());
            if self.sign.val() && !self.upper.val().all() {
                self.s17_delta.d.next = self.least.val();
            } else if !self.sign.val() && self.upper.val().any() {
                self.s17_delta.d.next = self.most.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("displace_delta")
    }
}

latches! { [] Delta: s6_product, s6_minimum, s7_displacement, s7_c, s13_product, s13_amount, s16_shift, s17_delta }
