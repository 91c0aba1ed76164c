// SPDX-License-Identifier: MIT OR Apache-2.0
//! The displacement along each axis, and what everything is divided by.
//!
//! | stage            | operation              | width    |   Latency 7, interval 1; holds while `go` is low
//! | s1 .. s6_product | delta n                | signed 62 |
//! | s7               | >> 16; den = 1.0 + along z | SQ16.28: below 2^44, den below 2^45 |

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
    s6_x: Product3x1<44, 62>,
    s6_y: Product3x1<44, 62>,
    s6_z: Product3x1<44, 62>,
    s7_x: DataRegister<S<46>>,
    s7_y: DataRegister<S<46>>,
    s7_den: DataRegister<S<47>>,
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
            s6_x: Product3x1::default(),
            s6_y: Product3x1::default(),
            s6_z: Product3x1::default(),
            s7_x: DataRegister::default(),
            s7_y: DataRegister::default(),
            s7_den: DataRegister::default(),
            one: Constant::new(S::new(1 << 28)),
        }
    }
}

impl Along {
    /// Cycles from displacement and normal to their products.
    pub const LATENCY: usize = Product3x1::<44, 62>::LATENCY + 1;
}

impl Logic for Along {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s6_x, s6_y, s6_z);
        dff_setup!(self, clock, s7_x, s7_y, s7_den);
        self.along_x.next = self.s7_x.q.val();
        self.along_y.next = self.s7_y.q.val();
        self.den.next = self.s7_den.q.val();
        self.s6_x.go.next = self.go.val();
        self.s6_x.a.next = self.delta.val();
        self.s6_x.b.next = self.normal.val().get_bit(0);
        self.s6_y.go.next = self.go.val();
        self.s6_y.a.next = self.delta.val();
        self.s6_y.b.next = self.normal.val().get_bit(1);
        self.s6_z.go.next = self.go.val();
        self.s6_z.a.next = self.delta.val();
        self.s6_z.b.next = self.normal.val().get_bit(2);
        if self.go.val() {
            self.s7_x.d.next = bit_cast_to::<S<46>>(self.s6_x.p.val() >> 16);
            self.s7_y.d.next = bit_cast_to::<S<46>>(self.s6_y.p.val() >> 16);
            self.s7_den.d.next = bit_cast_to::<S<47>>(self.s6_z.p.val() >> 16) + self.one.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("displace_along")
    }
}

latches! { [] Along: s6_x, s6_y, s6_z, s7_x, s7_y, s7_den }
