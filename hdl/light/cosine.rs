// SPDX-License-Identifier: MIT OR Apache-2.0
//! The cosine of two unit vectors, cut at 0 and 1.0.
//!
//! | port   | format     | meaning |   Latency 5, interval 1; holds while `go` is low
//! | a, b   | 3 x SQ1.16 | |
//! | cosine | UQ1.16     | at most 1.0 |

use crate::pipeline::DspProduct;
use crate::prelude::*;

/// Cosine.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Cosine {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<Lanes<3, 18>>,
    pub b: Input<Lanes<3, 18>>,
    pub cosine: Output<U<17>>,
    s3_x: DspProduct<18, 18, 36>,
    s3_y: DspProduct<18, 18, 36>,
    s3_z: DspProduct<18, 18, 36>,
    s4_dot: DataRegister<S<38>>,
    s5_cosine: DataRegister<U<17>>,
    dot: Wire<S<22>>,
    one: Constant<S<22>>,
}

impl Default for Cosine {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            a: Input::default(),
            b: Input::default(),
            cosine: Output::default(),
            s3_x: DspProduct::default(),
            s3_y: DspProduct::default(),
            s3_z: DspProduct::default(),
            s4_dot: DataRegister::default(),
            s5_cosine: DataRegister::default(),
            dot: Wire::default(),
            one: Constant::new(S::new(1 << 16)),
        }
    }
}

impl Cosine {
    /// Cycles from vectors to cosine.
    pub const LATENCY: usize = DspProduct::<18, 18, 36>::LATENCY + 2;
}

impl Logic for Cosine {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s3_x, s3_y, s3_z);
        dff_setup!(self, clock, s4_dot, s5_cosine);
        self.cosine.next = self.s5_cosine.q.val();
        self.s3_x.go.next = self.go.val();
        self.s3_x.a.next = self.a.val().get_bit(0);
        self.s3_x.b.next = self.b.val().get_bit(0);
        self.s3_y.go.next = self.go.val();
        self.s3_y.a.next = self.a.val().get_bit(1);
        self.s3_y.b.next = self.b.val().get_bit(1);
        self.s3_z.go.next = self.go.val();
        self.s3_z.a.next = self.a.val().get_bit(2);
        self.s3_z.b.next = self.b.val().get_bit(2);
        self.dot.next = bit_cast_to::<S<22>>(self.s4_dot.q.val() >> 16);
        if self.go.val() {
            self.s4_dot.d.next = bit_cast_to::<S<38>>(self.s3_x.p.val())
                + bit_cast_to::<S<38>>(self.s3_y.p.val())
                + bit_cast_to::<S<38>>(self.s3_z.p.val());
            self.s5_cosine.d.next = bit_cast_to::<U<17>>(self.dot.val());
            if self.dot.val() < 0 {
                self.s5_cosine.d.next = 0.into();
            } else if self.dot.val() > self.one.val() {
                self.s5_cosine.d.next = bit_cast_to::<U<17>>(self.one.val());
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("cosine")
    }
}

latches! { [] Cosine: s3_x, s3_y, s3_z, s4_dot, s5_cosine }
