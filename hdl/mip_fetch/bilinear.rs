// SPDX-License-Identifier: MIT OR Apache-2.0
//! The value between four texels.
//!
//! q = floor((t00 (1-a)(1-b) + t10 a (1-b) + t01 (1-a) b + t11 a b) * 2^8 + 1/2): round half up, once
//!
//! | stage         | operation                          | width    |   Latency 7, interval 1; holds while `go` is low
//! | s1_difference | t10 - t00, t11 - t01               | signed 17: texels have 16 bits |
//! | s2_product    | a times each                       | signed 31 |
//! | s3_rows       | t00 * 2^12 + product + 8, and the other row | 8 ..= 65535 * 2^12 + 8: signed 30 |
//! | s4_difference | lower row - upper row              | signed 30 |
//! | s5_products   | b times its upper 13 bits, and times its lower 17 | signed 27, signed 32 |
//! | s6_product    | their sum                          | signed 44 |
//! | s7_value      | upper row * 2^12 + product, to 8 fraction bits | 0 ..= 65535 * 2^8: 24, never saturates |
//!
//! The 8 in both rows is half a unit of the result, 2^15, in the last sum, and no matter in the difference.
//!
//! Golden: models::mip_fetch (blend)   Error 1/2 unit of UQ16.8   Example: 100, 200, 100, 200, a = 1024: 0x7d00

use crate::prelude::*;

/// Bilinear interpolation; weights UQ1.12.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Bilinear {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub t00: Input<S<17>>,
    pub t10: Input<S<17>>,
    pub t01: Input<S<17>>,
    pub t11: Input<S<17>>,
    /// Weight of the second column.
    pub a: Input<S<14>>,
    /// Weight of the second row.
    pub b: Input<S<14>>,
    pub value: Output<U<24>>,
    s1_upper: DataRegister<S<17>>,
    s1_lower: DataRegister<S<17>>,
    s1_upper_first: DataRegister<S<17>>,
    s1_lower_first: DataRegister<S<17>>,
    s1_a: DataRegister<S<14>>,
    s1_b: DataRegister<S<14>>,
    s2_upper: Multiplier<17, 14, 31>,
    s2_lower: Multiplier<17, 14, 31>,
    s2_upper_first: DataRegister<S<17>>,
    s2_lower_first: DataRegister<S<17>>,
    s2_b: DataRegister<S<14>>,
    s3_upper: DataRegister<S<30>>,
    s3_lower: DataRegister<S<30>>,
    s3_b: DataRegister<S<14>>,
    s4_difference: DataRegister<S<30>>,
    s4_upper: DataRegister<S<30>>,
    s4_b: DataRegister<S<14>>,
    s5_high: Multiplier<13, 14, 27>,
    s5_low: Multiplier<18, 14, 32>,
    s5_upper: DataRegister<S<30>>,
    s6_product: DataRegister<S<44>>,
    s6_upper: DataRegister<S<30>>,
    s7_value: DataRegister<U<24>>,
    sum: Wire<S<44>>,
}

impl Logic for Bilinear {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s2_upper, s2_lower, s5_high, s5_low);
        dff_setup!(self, clock, s1_upper, s1_lower, s1_upper_first, s1_lower_first, s1_a, s1_b);
        dff_setup!(self, clock, s2_upper_first, s2_lower_first, s2_b, s3_upper, s3_lower, s3_b);
        dff_setup!(self, clock, s4_difference, s4_upper, s4_b, s5_upper, s6_product, s6_upper, s7_value);
        self.value.next = self.s7_value.q.val();
        self.s2_upper.enable.next = self.go.val();
        self.s2_lower.enable.next = self.go.val();
        self.s5_high.enable.next = self.go.val();
        self.s5_low.enable.next = self.go.val();
        self.s2_upper.a.next = self.s1_upper.q.val();
        self.s2_upper.b.next = self.s1_a.q.val();
        self.s2_lower.a.next = self.s1_lower.q.val();
        self.s2_lower.b.next = self.s1_a.q.val();
        self.s5_high.a.next = bit_cast_to::<S<13>>(self.s4_difference.q.val() >> 17);
        self.s5_high.b.next = self.s4_b.q.val();
        self.s5_low.a.next = bit_cast_to::<S<18>>(self.s4_difference.q.val().get_bits::<17>(0));
        self.s5_low.b.next = self.s4_b.q.val();
        // At most 65535 * 2^24 + 2^15.
        self.sum.next = (bit_cast_to::<S<44>>(self.s6_upper.q.val()) << 12) + self.s6_product.q.val();
        if self.go.val() {
            self.s1_upper.d.next = self.t10.val() - self.t00.val();
            self.s1_lower.d.next = self.t11.val() - self.t01.val();
            self.s1_upper_first.d.next = self.t00.val();
            self.s1_lower_first.d.next = self.t01.val();
            self.s1_a.d.next = self.a.val();
            self.s1_b.d.next = self.b.val();
            self.s2_upper_first.d.next = self.s1_upper_first.q.val();
            self.s2_lower_first.d.next = self.s1_lower_first.q.val();
            self.s2_b.d.next = self.s1_b.q.val();
            self.s3_upper.d.next = ((bit_cast_to::<S<30>>(self.s2_upper_first.q.val()) << 12) | 8)
                + bit_cast_to::<S<30>>(self.s2_upper.p.val());
            self.s3_lower.d.next = ((bit_cast_to::<S<30>>(self.s2_lower_first.q.val()) << 12) | 8)
                + bit_cast_to::<S<30>>(self.s2_lower.p.val());
            self.s3_b.d.next = self.s2_b.q.val();
            self.s4_difference.d.next = self.s3_lower.q.val() - self.s3_upper.q.val();
            self.s4_upper.d.next = self.s3_upper.q.val();
            self.s4_b.d.next = self.s3_b.q.val();
            self.s5_upper.d.next = self.s4_upper.q.val();
            self.s6_product.d.next =
                (bit_cast_to::<S<44>>(self.s5_high.p.val()) << 17) + bit_cast_to::<S<44>>(self.s5_low.p.val());
            self.s6_upper.d.next = self.s5_upper.q.val();
            self.s7_value.d.next = self.sum.val().get_bits::<24>(16);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bilinear")
    }
}

latches! { [] Bilinear: s1_upper, s1_lower, s1_upper_first, s1_lower_first, s1_a, s1_b, s2_upper, s2_lower, s2_upper_first, s2_lower_first, s2_b, s3_upper, s3_lower, s3_b, s4_difference, s4_upper, s4_b, s5_high, s5_low, s5_upper, s6_product, s6_upper, s7_value }
