// SPDX-License-Identifier: MIT OR Apache-2.0
//! A slope of the patch, along one axis.
//!
//! `slope = (2^12 difference + weight twist) scale >> (11 + amount)`, SQ14.17, saturates
//!
//! | stage            | operation                       | width |   Latency 13, interval 1; holds while `go` is low
//! | s1 .. s3_product | weight twist                    | signed 31 |
//! | s4_sum           | 2^12 difference + that          | between two differences times 2^12: signed 29 |
//! | s5 .. s9_product | times scale                     | signed 47 |
//! | s10 .. s12_shift | >> 11, >> amount                | signed 36 |
//! | s13_slope        | SQ14.17                         | saturates at 32 bits |
//!
//! `difference`, `twist` and `weight` come at the beginning, `scale` four cycles and `amount` nine cycles later.

use crate::pipeline::{DspProduct, Product2x1, ShiftRight};
use crate::prelude::*;

/// Slope along an axis.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Slope {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// Of the first row or column.
    pub difference: Input<S<17>>,
    /// By how much the other one's is greater.
    pub twist: Input<S<18>>,
    /// UQ0.12.
    pub weight: Input<U<12>>,
    pub scale: Input<S<18>>,
    /// shift - 16 + level.
    pub amount: Input<U<6>>,
    pub slope: Output<S<32>>,
    s3_product: DspProduct<18, 13, 31>,
    s1_difference: DataRegister<S<17>>,
    s2_difference: DataRegister<S<17>>,
    s3_difference: DataRegister<S<17>>,
    s4_sum: DataRegister<S<29>>,
    s9_product: Product2x1<29, 47>,
    s12_shift: ShiftRight<36>,
    s13_slope: DataRegister<S<32>>,
    /// Sign and the bits that have to equal it.
    upper: Wire<U<5>>,
    most: Constant<S<32>>,
    least: Constant<S<32>>,
}

impl Default for Slope {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            difference: Input::default(),
            twist: Input::default(),
            weight: Input::default(),
            scale: Input::default(),
            amount: Input::default(),
            slope: Output::default(),
            s3_product: DspProduct::default(),
            s1_difference: DataRegister::default(),
            s2_difference: DataRegister::default(),
            s3_difference: DataRegister::default(),
            s4_sum: DataRegister::default(),
            s9_product: Product2x1::default(),
            s12_shift: ShiftRight::default(),
            s13_slope: DataRegister::default(),
            upper: Wire::default(),
            most: Constant::new(S::MAX),
            least: Constant::new(S::MIN),
        }
    }
}

impl Slope {
    /// Cycles from difference to slope.
    pub const LATENCY: usize = 13;
}

impl Logic for Slope {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_product, s9_product, s12_shift);
        dff_setup!(self, clock, s1_difference, s2_difference, s3_difference, s4_sum, s13_slope);
        self.slope.next = self.s13_slope.q.val();
        self.s3_product.go.next = self.go.val();
        self.s3_product.a.next = self.twist.val();
        self.s3_product.b.next = bit_cast_to::<S<13>>(self.weight.val());
        self.s9_product.go.next = self.go.val();
        self.s9_product.a.next = self.s4_sum.q.val();
        self.s9_product.b.next = self.scale.val();
        self.s12_shift.go.next = self.go.val();
        self.s12_shift.value.next = bit_cast_to::<WideS<36>>(self.s9_product.p.val() >> 11);
        self.s12_shift.amount.next = self.amount.val();
        self.upper.next = bit_cast_to::<U<5>>(self.s12_shift.shifted.val() >> 31);
        if self.go.val() {
            self.s1_difference.d.next = self.difference.val();
            self.s2_difference.d.next = self.s1_difference.q.val();
            self.s3_difference.d.next = self.s2_difference.q.val();
            self.s4_sum.d.next = (bit_cast_to::<S<29>>(self.s3_difference.q.val()) << 12)
                + bit_cast_to::<S<29>>(self.s3_product.p.val());
            self.s13_slope.d.next = bit_cast_to::<S<32>>(self.s12_shift.shifted.val());
            if self.upper.val().get_bit(4) && !self.upper.val().all() {
                self.s13_slope.d.next = self.least.val();
            } else if !self.upper.val().get_bit(4) && self.upper.val().any() {
                self.s13_slope.d.next = self.most.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("gradient_slope")
    }
}

latches! { [] Slope: s3_product, s1_difference, s2_difference, s3_difference, s9_product, s12_shift, s4_sum, s13_slope }
