// SPDX-License-Identifier: MIT OR Apache-2.0
//! The reciprocal of a lane: it is normalised first.
//!
//! `1 / c = reciprocal 2^-32 2^(zeros - 16)`
//!
//! | port       | format     | meaning |   Latency 22, interval 1; holds while `go` is low
//! | c          | signed 32  | below 1 counts as 1 |   Golden: models::perspective_correct::inverse
//! | reciprocal | UQ0.32     | of c 2^(zeros - 16) |
//! | zeros      | unsigned 6 | 17 ..= 47: the length of c is 48 - zeros |

use super::Newton;
use crate::pipeline::{Delay, Leading};
use crate::prelude::*;

/// Reciprocal of a register of any positive value.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Inverse {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub c: Input<S<32>>,
    pub reciprocal: Output<U<32>>,
    pub zeros: Output<U<6>>,
    s1_c: DataRegister<U<48>>,
    leading: Leading,
    newton: Newton,
    s22_zeros: Delay<6, { Newton::LATENCY }>,
    positive: Wire<U<48>>,
}

impl Inverse {
    /// Cycles from lane to reciprocal.
    pub const LATENCY: usize = 1 + Leading::LATENCY + Newton::LATENCY;
}

impl Logic for Inverse {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, leading, newton, s22_zeros);
        dff_setup!(self, clock, s1_c);
        self.positive.next = bit_cast_to::<U<48>>(self.c.val());
        if self.c.val() < 1 {
            self.positive.next = 1.into();
        }
        if self.go.val() {
            self.s1_c.d.next = self.positive.val();
        }
        self.leading.go.next = self.go.val();
        self.leading.value.next = self.s1_c.q.val();
        self.newton.go.next = self.go.val();
        self.newton.m.next = self.leading.mantissa.val();
        self.s22_zeros.go.next = self.go.val();
        self.s22_zeros.value.next = self.leading.zeros.val();
        self.reciprocal.next = self.newton.reciprocal.val();
        self.zeros.next = self.s22_zeros.delayed.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("inverse")
    }
}

latches! { [] Inverse: s1_c, leading, newton, s22_zeros }
