// SPDX-License-Identifier: MIT OR Apache-2.0
//! c' = z0 / z' of the displaced vertex, larger is nearer.
//!
//! | stage            | operation              | width    |   Latency 13, interval 1; holds while `go` is low
//! | s1 .. s6_product | c times reciprocal     | 63 bits |
//! | s7 .. s9_shift   | >> 51 - zeros          | by 24 ..= 48: 39 bits |
//! | s10_nearness      | at least 1, or too near | UQ0.31 |
//! | s11 .. s13         | it waits for the pixels | |

use crate::pipeline::{Delay, Product2x2, ShiftRight};
use crate::prelude::*;

/// Nearness over den.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Nearness {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub c: Input<U<31>>,
    pub reciprocal: Input<U<32>>,
    pub zeros: Input<U<6>>,
    pub moved: Output<U<31>>,
    /// 1.0 or more.
    pub near: Output<Bit>,
    s6_product: Product2x2<32, 33, 64>,
    s6_amount: Delay<6, 6>,
    s9_shift: ShiftRight<64>,
    s10_nearness: DataRegister<U<31>>,
    s10_near: DataRegister<Bit>,
    s11_nearness: DataRegister<U<31>>,
    s11_near: DataRegister<Bit>,
    s12_nearness: DataRegister<U<31>>,
    s12_near: DataRegister<Bit>,
    s13_nearness: DataRegister<U<31>>,
    s13_near: DataRegister<Bit>,
}

impl Nearness {
    /// Cycles from c to c'.
    pub const LATENCY: usize = 13;
}

impl Logic for Nearness {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s6_product, s6_amount, s9_shift);
        dff_setup!(
            self,
            clock,
            s10_nearness,
            s10_near,
            s11_nearness,
            s11_near,
            s12_nearness,
            s12_near,
            s13_nearness,
            s13_near
        );
        self.moved.next = self.s13_nearness.q.val();
        self.near.next = self.s13_near.q.val();
        self.s6_product.go.next = self.go.val();
        self.s6_product.a.next = bit_cast_to::<S<32>>(self.c.val());
        self.s6_product.b.next = bit_cast_to::<S<33>>(self.reciprocal.val());
        self.s6_amount.go.next = self.go.val();
        self.s6_amount.value.next = !self.zeros.val() - 12;
        self.s9_shift.go.next = self.go.val();
        self.s9_shift.value.next = self.s6_product.p.val();
        self.s9_shift.amount.next = self.s6_amount.delayed.val();
        if self.go.val() {
            self.s10_nearness.d.next = self.s9_shift.shifted.val().get_bits::<31>(0);
            if self.s9_shift.shifted.val().get_bits::<31>(0) == 0 {
                self.s10_nearness.d.next = 1.into();
            }
            self.s10_near.d.next = self.s9_shift.shifted.val().get_bits::<33>(31).any();
            self.s11_nearness.d.next = self.s10_nearness.q.val();
            self.s11_near.d.next = self.s10_near.q.val();
            self.s12_nearness.d.next = self.s11_nearness.q.val();
            self.s12_near.d.next = self.s11_near.q.val();
            self.s13_nearness.d.next = self.s12_nearness.q.val();
            self.s13_near.d.next = self.s12_near.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("displace_nearness")
    }
}

latches! { [] Nearness: s6_product, s6_amount, s9_shift, s10_nearness, s10_near, s11_nearness, s11_near, s12_nearness, s12_near, s13_nearness, s13_near }
