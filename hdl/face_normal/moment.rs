// SPDX-License-Identifier: MIT OR Apache-2.0
//! A component of the normal times a coordinate: 54 bits by 22, in six multipliers.
//!
//! | port | format    | meaning |   Latency 9, interval 1, error 0; holds while `go` is low
//! | a    | signed 54 | three digits of 17 bits, and three bits above them, which choose what is added |
//! | b    | signed 22 | |
//! | p    | signed 76 | |

use crate::pipeline::{Delay, Product3x2};
use crate::prelude::*;

/// Product of 54 by 22 bits.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Moment {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<54>>,
    pub b: Input<S<22>>,
    pub p: Output<WideS<76>>,
    s8_low: Product3x2<52, 22, 74>,
    s1_lower: DataRegister<S<25>>,
    s1_top: DataRegister<S<25>>,
    s2_upper: DataRegister<S<25>>,
    s8_upper: Delay<25, 6>,
    s9_sum: DataRegister<WideS<76>>,
    b_1: Wire<S<25>>,
    b_2: Wire<S<25>>,
    b_4: Wire<S<25>>,
    upper: Wire<S<25>>,
}

impl Moment {
    /// Cycles from factors to product.
    pub const LATENCY: usize = Product3x2::<52, 22, 74>::LATENCY + 1;
}

impl Logic for Moment {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s8_low, s8_upper);
        dff_setup!(self, clock, s1_lower, s1_top, s2_upper, s9_sum);
        self.p.next = self.s9_sum.q.val();
        self.s8_low.go.next = self.go.val();
        self.s8_low.a.next = bit_cast_to::<S<52>>(self.a.val().get_bits::<51>(0));
        self.s8_low.b.next = self.b.val();
        self.b_1.next = 0.into();
        if self.a.val().get_bit(51) {
            self.b_1.next = bit_cast_to::<S<25>>(self.b.val());
        }
        self.b_2.next = 0.into();
        if self.a.val().get_bit(52) {
            self.b_2.next = bit_cast_to::<S<25>>(self.b.val()) << 1;
        }
        self.b_4.next = 0.into();
        if self.a.val().get_bit(53) {
            self.b_4.next = bit_cast_to::<S<25>>(self.b.val()) << 2;
        }
        self.s8_upper.go.next = self.go.val();
        self.s8_upper.value.next = bit_cast_to::<U<25>>(self.s2_upper.q.val());
        self.upper.next = bit_cast_to::<S<25>>(self.s8_upper.delayed.val());
        if self.go.val() {
            self.s1_lower.d.next = self.b_1.val() + self.b_2.val();
            self.s1_top.d.next = self.b_4.val();
            self.s2_upper.d.next = self.s1_lower.q.val() - self.s1_top.q.val();
            self.s9_sum.d.next =
                bit_cast_to::<WideS<76>>(self.s8_low.p.val()) + (bit_cast_to::<WideS<76>>(self.upper.val()) << 51);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("moment")
    }
}

latches! { [] Moment: s8_low, s8_upper, s1_lower, s1_top, s2_upper, s9_sum }
