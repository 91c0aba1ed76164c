// SPDX-License-Identifier: MIT OR Apache-2.0
//! A component of the normal, tilted by both slopes.
//!
//! `tilted = 2^4 normal - (slope_u along_u >> 13) - (slope_v along_v >> 13)`, 35 fraction bits
//!
//! | stage            | operation                    | width |   Latency 8, interval 1; holds while `go` is low
//! | s1 .. s6_product | slope times gradient, twice  | 31 + 31 bits and sign |
//! | s7_along         | >> 13, their sum             | 50 bits and sign |
//! | s8_tilted        | 2^4 normal - that            | 51 bits and sign |
//!
//! `normal` comes seven cycles later than the others.

use crate::pipeline::Product2x2;
use crate::prelude::*;

/// A component.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Tilt {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// SQ14.17.
    pub slope_u: Input<S<32>>,
    pub slope_v: Input<S<32>>,
    /// Of the gradients, SQ0.31.
    pub along_u: Input<S<32>>,
    pub along_v: Input<S<32>>,
    /// SQ0.31.
    pub normal: Input<S<32>>,
    pub tilted: Output<S<52>>,
    s6_u: Product2x2<32, 32, 64>,
    s6_v: Product2x2<32, 32, 64>,
    s7_along: DataRegister<S<52>>,
    s8_tilted: DataRegister<S<52>>,
}

impl Tilt {
    /// Cycles from slopes to component.
    pub const LATENCY: usize = Product2x2::<32, 32, 64>::LATENCY + 2;
}

impl Logic for Tilt {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s6_u, s6_v);
        dff_setup!(self, clock, s7_along, s8_tilted);
        self.tilted.next = self.s8_tilted.q.val();
        self.s6_u.go.next = self.go.val();
        self.s6_u.a.next = self.slope_u.val();
        self.s6_u.b.next = self.along_u.val();
        self.s6_v.go.next = self.go.val();
        self.s6_v.a.next = self.slope_v.val();
        self.s6_v.b.next = self.along_v.val();
        if self.go.val() {
            self.s7_along.d.next =
                bit_cast_to::<S<52>>(self.s6_u.p.val() >> 13) + bit_cast_to::<S<52>>(self.s6_v.p.val() >> 13);
            self.s8_tilted.d.next = (bit_cast_to::<S<52>>(self.normal.val()) << 4) - self.s7_along.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("gradient_tilt")
    }
}

latches! { [] Tilt: s6_u, s6_v, s7_along, s8_tilted }
