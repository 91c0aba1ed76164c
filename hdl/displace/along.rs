// SPDX-License-Identifier: MIT OR Apache-2.0
//! The displacement along each axis, and what everything is divided by.
//!
//! | stage            | operation              | width    |   Interval 1; holds while `go` is low
//! | s1 .. s6_product | delta n                | signed 62 |
//! | s7               | >> 16; den = 1.0 + along z | SQ16.28: below 2^44, den below 2^45 |
//!
//! Latency 7 for z; y comes a cycle later, and x two, so that their multipliers, which lie apart, share no register. Whatever is
//! behind keeps that.

use crate::pipeline::Product3x1;
use crate::prelude::*;

/// Products with a normal of length 1.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Along {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// SQ15.28.
    pub delta: Input<S<44>>,
    /// SQ1.16.
    pub normal: Input<Lanes<3, 18>>,
    pub along_x: Output<S<46>>,
    pub along_y: Output<S<46>>,
    pub den: Output<S<47>>,
    s6_den: Product3x1<44, 62>,
    s7_den: DataRegister<S<47>>,
    s1_delta: DataRegister<S<44>>,
    s1_y: DataRegister<S<18>>,
    s7_y: Product3x1<44, 62>,
    s8_y: DataRegister<S<46>>,
    s2_delta: DataRegister<S<44>>,
    s1_x: DataRegister<S<18>>,
    s2_x: DataRegister<S<18>>,
    s8_x: Product3x1<44, 62>,
    s9_x: DataRegister<S<46>>,
    one: Constant<S<47>>,
}

impl Default for Along {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            delta: Input::default(),
            normal: Input::default(),
            along_x: Output::default(),
            along_y: Output::default(),
            den: Output::default(),
            s6_den: Product3x1::default(),
            s7_den: DataRegister::default(),
            s1_delta: DataRegister::default(),
            s1_y: DataRegister::default(),
            s7_y: Product3x1::default(),
            s8_y: DataRegister::default(),
            s2_delta: DataRegister::default(),
            s1_x: DataRegister::default(),
            s2_x: DataRegister::default(),
            s8_x: Product3x1::default(),
            s9_x: DataRegister::default(),
            one: Constant::new(S::new(1 << 28)),
        }
    }
}

impl Along {
    /// Cycles from displacement and normal to `den`.
    pub const LATENCY: usize = Product3x1::<44, 62>::LATENCY + 1;
}

impl Logic for Along {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s6_den, s7_y, s8_x);
        dff_setup!(self, clock, s7_den, s1_delta, s1_y, s8_y, s2_delta, s1_x, s2_x, s9_x);
        self.along_x.next = self.s9_x.q.val();
        self.along_y.next = self.s8_y.q.val();
        self.den.next = self.s7_den.q.val();
        self.s6_den.go.next = self.go.val();
        self.s6_den.a.next = self.delta.val();
        self.s6_den.b.next = self.normal.val().get_bit(2);
        self.s7_y.go.next = self.go.val();
        self.s7_y.a.next = self.s1_delta.q.val();
        self.s7_y.b.next = self.s1_y.q.val();
        self.s8_x.go.next = self.go.val();
        self.s8_x.a.next = self.s2_delta.q.val();
        self.s8_x.b.next = self.s2_x.q.val();
        if self.go.val() {
            self.s1_delta.d.next = self.delta.val();
            self.s1_y.d.next = self.normal.val().get_bit(1);
            self.s1_x.d.next = self.normal.val().get_bit(0);
            self.s2_delta.d.next = self.s1_delta.q.val();
            self.s2_x.d.next = self.s1_x.q.val();
            self.s7_den.d.next = bit_cast_to::<S<47>>(self.s6_den.p.val() >> 16) + self.one.val();
            self.s8_y.d.next = bit_cast_to::<S<46>>(self.s7_y.p.val() >> 16);
            self.s9_x.d.next = bit_cast_to::<S<46>>(self.s8_x.p.val() >> 16);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("displace_along")
    }
}

latches! { [] Along: s6_den, s7_den, s1_delta, s1_y, s7_y, s8_y, s2_delta, s1_x, s2_x, s8_x, s9_x }
