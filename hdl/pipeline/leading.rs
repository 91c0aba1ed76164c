// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leading zeros of a number, and the number without them.
//!
//! | port     | format      | meaning |   Latency 5, interval 1
//! | value    | unsigned 48 | above 0; 0 gives 63 and nothing useful |   Golden: models::reciprocal::normalise
//! | mantissa | unsigned 32 | the 32 bits from the leading one on; lower ones are dropped |   Error 0
//! | zeros    | unsigned 6  | leading zeros of the 48 bits: the length of `value` is 48 - zeros |
//!
//! | stage | operation |
//! |-------|-----------|
//! | s1    | which thirds are zero |
//! | s2    | shifted by 0, 16 or 32 |
//! | s3, s4 | by 8, by 4: a decision that 48 multiplexers hang on takes a cycle |
//! | s5    | by 2 and by 1 |
//!
//! Example: 5 -> mantissa 0xA000_0000, zeros 45.

use crate::prelude::*;

/// Normaliser.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Leading {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub value: Input<U<48>>,
    pub mantissa: Output<U<32>>,
    pub zeros: Output<U<6>>,
    s1_value: DataRegister<U<48>>,
    /// The third is not zero.
    s1_upper: DataRegister<Bit>,
    s1_centre: DataRegister<Bit>,
    s1_lower: DataRegister<Bit>,
    s2_value: DataRegister<U<48>>,
    s2_zeros: DataRegister<U<6>>,
    s3_value: DataRegister<U<48>>,
    s3_zeros: DataRegister<U<6>>,
    s4_value: DataRegister<U<48>>,
    s4_zeros: DataRegister<U<6>>,
    s5_value: DataRegister<U<48>>,
    s5_zeros: DataRegister<U<6>>,
    by_8: Wire<Bit>,
    by_4: Wire<Bit>,
    by_2: Wire<Bit>,
    by_1: Wire<Bit>,
    after_8: Wire<U<48>>,
    after_4: Wire<U<48>>,
    after_2: Wire<U<48>>,
    after_1: Wire<U<48>>,
}

impl Leading {
    /// Cycles from value to mantissa.
    pub const LATENCY: usize = 5;
}

impl Logic for Leading {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_value, s1_upper, s1_centre, s1_lower, s2_value, s2_zeros, s3_value, s3_zeros);
        dff_setup!(self, clock, s4_value, s4_zeros, s5_value, s5_zeros);
        self.mantissa.next = self.s5_value.q.val().get_bits::<32>(16);
        self.zeros.next = self.s5_zeros.q.val();
        self.by_8.next = self.s2_value.q.val().get_bits::<8>(40) == 0;
        self.after_8.next = self.s2_value.q.val();
        if self.by_8.val() {
            self.after_8.next = self.s2_value.q.val() << 8;
        }
        self.by_4.next = self.s3_value.q.val().get_bits::<4>(44) == 0;
        self.after_4.next = self.s3_value.q.val();
        if self.by_4.val() {
            self.after_4.next = self.s3_value.q.val() << 4;
        }
        self.by_2.next = self.s4_value.q.val().get_bits::<2>(46) == 0;
        self.after_2.next = self.s4_value.q.val();
        if self.by_2.val() {
            self.after_2.next = self.s4_value.q.val() << 2;
        }
        self.by_1.next = !self.after_2.val().get_bit(47);
        self.after_1.next = self.after_2.val();
        if self.by_1.val() {
            self.after_1.next = self.after_2.val() << 1;
        }
        if self.go.val() {
            self.s1_value.d.next = self.value.val();
            self.s1_upper.d.next = self.value.val().get_bits::<16>(32).any();
            self.s1_centre.d.next = self.value.val().get_bits::<16>(16).any();
            self.s1_lower.d.next = self.value.val().get_bits::<16>(0).any();
            if self.s1_upper.q.val() {
                self.s2_value.d.next = self.s1_value.q.val();
                self.s2_zeros.d.next = 0.into();
            } else if self.s1_centre.q.val() {
                self.s2_value.d.next = self.s1_value.q.val() << 16;
                self.s2_zeros.d.next = 16.into();
            } else {
                self.s2_value.d.next = self.s1_value.q.val() << 32;
                self.s2_zeros.d.next = 32.into();
                if !self.s1_lower.q.val() {
                    self.s2_zeros.d.next = 48.into();
                }
            }
            self.s3_value.d.next = self.after_8.val();
            self.s3_zeros.d.next = self.s2_zeros.q.val() | (bit_cast_to::<U<6>>(self.by_8.val()) << 3);
            self.s4_value.d.next = self.after_4.val();
            self.s4_zeros.d.next = self.s3_zeros.q.val() | (bit_cast_to::<U<6>>(self.by_4.val()) << 2);
            self.s5_value.d.next = self.after_1.val();
            self.s5_zeros.d.next = self.s4_zeros.q.val()
                | (bit_cast_to::<U<6>>(self.by_2.val()) << 1)
                | bit_cast_to::<U<6>>(self.by_1.val());
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("leading")
    }
}

latches! { [] Leading: s1_value, s1_upper, s1_centre, s1_lower, s2_value, s2_zeros, s3_value, s3_zeros, s4_value, s4_zeros, s5_value, s5_zeros }
