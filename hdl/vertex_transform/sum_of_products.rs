// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sums of products, shifted, rounded and limited.
//!
//! | stage        | operation | width |   s counts from the step of the schedule; the factors stand in s + 3
//! |--------------|-----------|-------|
//! | s4 .. s11    | a b                                       | 85 bits: 52 + 33, whole |
//! | s12_sum      | the sum so far, or the term, and the product | 85 bits: sums of two products of 79 bits, of three of 63 |
//! | s13 .. s15   | shifted by one bit less than is dropped   | |
//! | s16_value    | the last bit, rounded half up             | signed 54 |
//! | s16_far      | the value has more bits                   | of a slope: 80 bits less 13 |
//! | s17          | whether it fits 52 and 32 bits            | |
//! | s18_result   | limited to +-(2^31 - 1) where asked for   | signed 52 |

use crate::pipeline::{Product3x2, ShiftRight};
use crate::prelude::*;

/// Sums of products.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct SumOfProducts {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<52>>,
    pub b: Input<S<33>>,
    /// What a sum begins with, when its first product stands.
    pub term: Input<S<63>>,
    pub begins: Input<Bit>,
    /// Bits that are dropped, less one; when the last product stands.
    pub amount: Input<U<6>>,
    pub rounds: Input<Bit>,
    pub clamps: Input<Bit>,
    /// The sum is below 0; a cycle behind its last product.
    pub negative: Output<Bit>,
    /// The result does not fit 52 bits, or 32; a cycle before it.
    pub long: Output<Bit>,
    pub wide: Output<Bit>,
    pub result: Output<S<52>>,
    s11_product: Product3x2<52, 33, 85>,
    s12_sum: DataRegister<WideS<85>>,
    s12_amount: DataRegister<U<6>>,
    s15_shifted: ShiftRight<85>,
    s16_value: DataRegister<S<54>>,
    s16_far: DataRegister<Bit>,
    s17_value: DataRegister<S<52>>,
    s17_negative: DataRegister<Bit>,
    s17_long: DataRegister<Bit>,
    s17_wide: DataRegister<Bit>,
    s17_beyond: DataRegister<Bit>,
    s18_result: DataRegister<S<52>>,
    from: Wire<WideS<85>>,
    half: Wire<Bit>,
    upper: Wire<U<14>>,
    beyond_52: Wire<U<3>>,
    beyond_32: Wire<U<23>>,
    long_now: Wire<Bit>,
    wide_now: Wire<Bit>,
    /// +-(2^31 - 1).
    most: Constant<S<52>>,
    least: Constant<S<52>>,
}

impl Default for SumOfProducts {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            a: Input::default(),
            b: Input::default(),
            term: Input::default(),
            begins: Input::default(),
            amount: Input::default(),
            rounds: Input::default(),
            clamps: Input::default(),
            negative: Output::default(),
            long: Output::default(),
            wide: Output::default(),
            result: Output::default(),
            s11_product: Product3x2::default(),
            s12_sum: DataRegister::default(),
            s12_amount: DataRegister::default(),
            s15_shifted: ShiftRight::default(),
            s16_value: DataRegister::default(),
            s16_far: DataRegister::default(),
            s17_value: DataRegister::default(),
            s17_negative: DataRegister::default(),
            s17_long: DataRegister::default(),
            s17_wide: DataRegister::default(),
            s17_beyond: DataRegister::default(),
            s18_result: DataRegister::default(),
            from: Wire::default(),
            half: Wire::default(),
            upper: Wire::default(),
            beyond_52: Wire::default(),
            beyond_32: Wire::default(),
            long_now: Wire::default(),
            wide_now: Wire::default(),
            most: Constant::new(S::new(i32::MAX.into())),
            least: Constant::new(S::new((-i32::MAX).into())),
        }
    }
}

impl SumOfProducts {
    /// Cycles from a sum's last factors to its result.
    pub const LATENCY: usize = Product3x2::<52, 33, 85>::LATENCY + 1 + ShiftRight::<85>::LATENCY + 3;
}

impl Logic for SumOfProducts {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s11_product, s15_shifted);
        dff_setup!(self, clock, s12_sum, s12_amount, s16_value, s16_far);
        dff_setup!(self, clock, s17_value, s17_negative, s17_long, s17_wide, s17_beyond, s18_result);
        self.negative.next = self.s12_sum.q.val().get_bit(84);
        self.long.next = self.s17_long.q.val();
        self.wide.next = self.s17_wide.q.val();
        self.result.next = self.s18_result.q.val();

        self.s11_product.go.next = self.go.val();
        self.s11_product.a.next = self.a.val();
        self.s11_product.b.next = self.b.val();
        self.from.next = self.s12_sum.q.val();
        if self.begins.val() {
            self.from.next = bit_cast_to::<WideS<85>>(self.term.val());
        }
        self.s15_shifted.go.next = self.go.val();
        self.s15_shifted.value.next = self.s12_sum.q.val();
        self.s15_shifted.amount.next = self.s12_amount.q.val();
        self.half.next = self.rounds.val() && self.s15_shifted.shifted.val().get_bit(0);
        self.upper.next = self.s15_shifted.shifted.val().get_bits::<14>(54);
        self.beyond_52.next = self.s16_value.q.val().get_bits::<3>(51);
        self.beyond_32.next = self.s16_value.q.val().get_bits::<23>(31);
        self.long_now.next = self.s16_far.q.val() || (self.beyond_52.val().any() && !self.beyond_52.val().all());
        self.wide_now.next = self.s16_far.q.val() || (self.beyond_32.val().any() && !self.beyond_32.val().all());
        if self.go.val() {
            self.s12_sum.d.next = self.from.val() + self.s11_product.p.val();
            self.s12_amount.d.next = self.amount.val();
            self.s16_value.d.next =
                bit_cast_to::<S<54>>(self.s15_shifted.shifted.val() >> 1) + bit_cast_to::<S<54>>(self.half.val());
            self.s16_far.d.next = self.upper.val().any() && !self.upper.val().all();
            self.s17_value.d.next = bit_cast_to::<S<52>>(self.s16_value.q.val());
            self.s17_negative.d.next = self.s16_value.q.val().get_bit(53);
            self.s17_long.d.next = self.long_now.val();
            self.s17_wide.d.next = self.wide_now.val();
            // -2^31, which fits, is limited, too.
            self.s17_beyond.d.next = self.wide_now.val()
                || (self.s16_value.q.val().get_bit(53) && self.s16_value.q.val().get_bits::<31>(0) == 0);
            self.s18_result.d.next = self.s17_value.q.val();
            if self.clamps.val() && self.s17_beyond.q.val() {
                self.s18_result.d.next = self.most.val();
                if self.s17_negative.q.val() {
                    self.s18_result.d.next = self.least.val();
                }
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sum_of_products")
    }
}

latches! { [] SumOfProducts: s11_product, s12_sum, s12_amount, s15_shifted, s16_value, s16_far, s17_value, s17_negative, s17_long, s17_wide, s17_beyond, s18_result }
