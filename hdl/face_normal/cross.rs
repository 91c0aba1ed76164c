// SPDX-License-Identifier: MIT OR Apache-2.0
//! Twice the area of a triangle in a plane, from its sides (a1, b1) and (a2, b2): two products in six multipliers.
//!
//! `area = a1 b2 - a2 b1`
//!
//! | port   | format    | meaning |   Latency 8, interval 1, error 0; holds while `go` is low
//! | a1, a2 | signed 32 | |
//! | b1, b2 | signed 23 | |
//! | area   | signed 54 | whole: the area is at most that of the box round the triangle, if a1 - a2 and b1 - b2 fit, too |
//!
//! With digits of 16 bits, a = h 2^16 + l, a product is
//!
//! ```text
//! h h' 2^32 + ((h + l)(h' + l') - h h' - l l') 2^16 + l l'        (Karatsuba & Ofman 1962)
//! ```
//!
//! so three multipliers do for two digits each. The difference of the two products is taken of each kind first.
//!
//! | stage    | operation                           | width |
//! | s1       | digits, and their sums              | signed 18 |
//! | s2 .. s4 | three products, twice               | signed 36 |
//! | s5       | difference of each kind             | |
//! | s6, s7   | less high and low; high beside low  | |
//! | s8_area  | their sum                           | signed 54 |

use crate::pipeline::DspProduct;
use crate::prelude::*;

/// Cross product in a plane.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Cross {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a1: Input<S<32>>,
    pub b1: Input<S<23>>,
    pub a2: Input<S<32>>,
    pub b2: Input<S<23>>,
    pub area: Output<S<54>>,
    s1_a1_low: DataRegister<S<18>>,
    s1_a1_high: DataRegister<S<18>>,
    s1_a1_sum: DataRegister<S<18>>,
    s1_a2_low: DataRegister<S<18>>,
    s1_a2_high: DataRegister<S<18>>,
    s1_a2_sum: DataRegister<S<18>>,
    s1_b1_low: DataRegister<S<18>>,
    s1_b1_high: DataRegister<S<18>>,
    s1_b1_sum: DataRegister<S<18>>,
    s1_b2_low: DataRegister<S<18>>,
    s1_b2_high: DataRegister<S<18>>,
    s1_b2_sum: DataRegister<S<18>>,
    s4_first_low: DspProduct<18, 18, 36>,
    s4_first_high: DspProduct<18, 18, 36>,
    s4_first_sum: DspProduct<18, 18, 36>,
    s4_second_low: DspProduct<18, 18, 36>,
    s4_second_high: DspProduct<18, 18, 36>,
    s4_second_sum: DspProduct<18, 18, 36>,
    s5_low: DataRegister<S<36>>,
    s5_high: DataRegister<S<36>>,
    s5_sum: DataRegister<S<38>>,
    s6_low: DataRegister<S<36>>,
    s6_high: DataRegister<S<36>>,
    s6_middle: DataRegister<S<38>>,
    s7_outer: DataRegister<S<54>>,
    s7_middle: DataRegister<S<38>>,
    s8_area: DataRegister<S<54>>,
    a1_low: Wire<S<18>>,
    a1_high: Wire<S<18>>,
    a2_low: Wire<S<18>>,
    a2_high: Wire<S<18>>,
    b1_low: Wire<S<18>>,
    b1_high: Wire<S<18>>,
    b2_low: Wire<S<18>>,
    b2_high: Wire<S<18>>,
}

impl Cross {
    /// Cycles from sides to area.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 5;
}

impl Logic for Cross {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s4_first_low, s4_first_high, s4_first_sum, s4_second_low, s4_second_high, s4_second_sum);
        dff_setup!(
            self, clock, s1_a1_low, s1_a1_high, s1_a1_sum, s1_a2_low, s1_a2_high, s1_a2_sum, s1_b1_low, s1_b1_high,
            s1_b1_sum, s1_b2_low, s1_b2_high, s1_b2_sum, s5_low, s5_high, s5_sum, s6_low, s6_high, s6_middle, s7_outer,
            s7_middle, s8_area
        );
        self.area.next = self.s8_area.q.val();
        self.a1_low.next = bit_cast_to::<S<18>>(self.a1.val().get_bits::<16>(0));
        self.a1_high.next = bit_cast_to::<S<18>>(self.a1.val() >> 16);
        self.a2_low.next = bit_cast_to::<S<18>>(self.a2.val().get_bits::<16>(0));
        self.a2_high.next = bit_cast_to::<S<18>>(self.a2.val() >> 16);
        self.b1_low.next = bit_cast_to::<S<18>>(self.b1.val().get_bits::<16>(0));
        self.b1_high.next = bit_cast_to::<S<18>>(self.b1.val() >> 16);
        self.b2_low.next = bit_cast_to::<S<18>>(self.b2.val().get_bits::<16>(0));
        self.b2_high.next = bit_cast_to::<S<18>>(self.b2.val() >> 16);
        self.s4_first_low.go.next = self.go.val();
        self.s4_first_low.a.next = self.s1_a1_low.q.val();
        self.s4_first_low.b.next = self.s1_b2_low.q.val();
        self.s4_first_high.go.next = self.go.val();
        self.s4_first_high.a.next = self.s1_a1_high.q.val();
        self.s4_first_high.b.next = self.s1_b2_high.q.val();
        self.s4_first_sum.go.next = self.go.val();
        self.s4_first_sum.a.next = self.s1_a1_sum.q.val();
        self.s4_first_sum.b.next = self.s1_b2_sum.q.val();
        self.s4_second_low.go.next = self.go.val();
        self.s4_second_low.a.next = self.s1_a2_low.q.val();
        self.s4_second_low.b.next = self.s1_b1_low.q.val();
        self.s4_second_high.go.next = self.go.val();
        self.s4_second_high.a.next = self.s1_a2_high.q.val();
        self.s4_second_high.b.next = self.s1_b1_high.q.val();
        self.s4_second_sum.go.next = self.go.val();
        self.s4_second_sum.a.next = self.s1_a2_sum.q.val();
        self.s4_second_sum.b.next = self.s1_b1_sum.q.val();
        if self.go.val() {
            self.s1_a1_low.d.next = self.a1_low.val();
            self.s1_a1_high.d.next = self.a1_high.val();
            self.s1_a1_sum.d.next = self.a1_low.val() + self.a1_high.val();
            self.s1_a2_low.d.next = self.a2_low.val();
            self.s1_a2_high.d.next = self.a2_high.val();
            self.s1_a2_sum.d.next = self.a2_low.val() + self.a2_high.val();
            self.s1_b1_low.d.next = self.b1_low.val();
            self.s1_b1_high.d.next = self.b1_high.val();
            self.s1_b1_sum.d.next = self.b1_low.val() + self.b1_high.val();
            self.s1_b2_low.d.next = self.b2_low.val();
            self.s1_b2_high.d.next = self.b2_high.val();
            self.s1_b2_sum.d.next = self.b2_low.val() + self.b2_high.val();
            self.s5_low.d.next =
                bit_cast_to::<S<36>>(self.s4_first_low.p.val()) - bit_cast_to::<S<36>>(self.s4_second_low.p.val());
            self.s5_high.d.next =
                bit_cast_to::<S<36>>(self.s4_first_high.p.val()) - bit_cast_to::<S<36>>(self.s4_second_high.p.val());
            self.s5_sum.d.next =
                bit_cast_to::<S<38>>(self.s4_first_sum.p.val()) - bit_cast_to::<S<38>>(self.s4_second_sum.p.val());
            self.s6_low.d.next = self.s5_low.q.val();
            self.s6_high.d.next = self.s5_high.q.val();
            self.s6_middle.d.next = self.s5_sum.q.val() - bit_cast_to::<S<38>>(self.s5_low.q.val());
            self.s7_outer.d.next =
                (bit_cast_to::<S<54>>(self.s6_high.q.val()) << 32) + bit_cast_to::<S<54>>(self.s6_low.q.val());
            self.s7_middle.d.next = self.s6_middle.q.val() - bit_cast_to::<S<38>>(self.s6_high.q.val());
            self.s8_area.d.next = self.s7_outer.q.val() + (bit_cast_to::<S<54>>(self.s7_middle.q.val()) << 16);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("cross")
    }
}

latches! { [] Cross: s4_first_low, s4_first_high, s4_first_sum, s4_second_low, s4_second_high, s4_second_sum, s1_a1_low, s1_a1_high, s1_a1_sum, s1_a2_low, s1_a2_high, s1_a2_sum, s1_b1_low, s1_b1_high, s1_b1_sum, s1_b2_low, s1_b2_high, s1_b2_sum, s5_low, s5_high, s5_sum, s6_low, s6_high, s6_middle, s7_outer, s7_middle, s8_area }
