// SPDX-License-Identifier: MIT OR Apache-2.0
//! A multiplier with a register of its own on each side, so that its product may be far from what needs it: wires to and
//! from a DSP block take as long as the block.
//!
//! | port | format     |   Latency 3, interval 1, error 0; holds while `go` is low
//! | a    | signed A   |
//! | b    | signed B   |
//! | p    | signed wide P, whole if P >= A + B |

use crate::prelude::*;

/// Multiplier of `A` by `B` bits, A, B <= 18.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct DspProduct<const A: usize, const B: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<A>>,
    pub b: Input<S<B>>,
    pub p: Output<WideS<P>>,
    s1_a: DataRegister<S<A>>,
    s1_b: DataRegister<S<B>>,
    s2_product: Multiplier<A, B, P>,
    s3_product: DataRegister<WideS<P>>,
}

impl<const A: usize, const B: usize, const P: usize> DspProduct<A, B, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = 3;
}

impl<const A: usize, const B: usize, const P: usize> Logic for DspProduct<A, B, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s2_product);
        dff_setup!(self, clock, s1_a, s1_b, s3_product);
        self.p.next = self.s3_product.q.val();
        self.s2_product.enable.next = self.go.val();
        self.s2_product.a.next = self.s1_a.q.val();
        self.s2_product.b.next = self.s1_b.q.val();
        if self.go.val() {
            self.s1_a.d.next = self.a.val();
            self.s1_b.d.next = self.b.val();
            self.s3_product.d.next = self.s2_product.p.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("dsp_product_{A}x{B}_to_{P}"))
    }
}

latches! { [const A: usize, const B: usize, const P: usize] DspProduct<A, B, P>: s1_a, s1_b, s2_product, s3_product }
