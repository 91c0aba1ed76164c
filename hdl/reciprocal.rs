// SPDX-License-Identifier: MIT OR Apache-2.0
//! The reciprocal of a normalised number: a table of 128 straight lines and one step of Newton's.
//!
//! `out = 2^63 / m (1 - error), 0 <= error < 5.6e-10`, that is 2^32 / x for m = 2^31 x
//!
//! | port           | format | range |   Latency 18, interval 1
//! | in_m           | UQ1.31 | [1, 2): the leading bit stands for itself and is not looked at
//! | out_reciprocal | UQ0.32 | [1/2, 1); 1.0 is not reached   Golden: models::reciprocal::golden
//!
//! Example: 0xC000_0000 (1.5) -> 0xAAAA_AAAA (2/3) to within 2 units.

mod inverse;
mod newton;
mod table;

pub use inverse::Inverse;
pub use newton::Newton;
pub use table::ReciprocalTable;

use crate::pipeline::Flow;
use crate::prelude::*;

/// Reciprocal.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Reciprocal {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_m: Input<U<32>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_reciprocal: Output<U<32>>,
    s1_m: DataRegister<U<32>>,
    newton: Newton,
    flow: Flow<{ 1 + Newton::LATENCY }, 32>,
}

impl Reciprocal {
    /// Cycles from number to reciprocal: one for the input, those of the step, and the one behind its last.
    pub const LATENCY: usize = 1 + Newton::LATENCY + 1;
}

impl Logic for Reciprocal {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, newton, flow);
        dff_setup!(self, clock, s1_m);
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.flow.go.val();
        if self.flow.go.val() {
            self.s1_m.d.next = self.in_m.val();
        }
        self.newton.go.next = self.flow.go.val();
        self.newton.m.next = self.s1_m.q.val();
        self.flow.value.next = bit_cast_to::<WideU<32>>(self.newton.reciprocal.val());
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_reciprocal.next = bit_cast_to::<U<32>>(self.flow.out_value.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("reciprocal")
    }
}

ports! {
    [] Reciprocal {
        inputs: in_valid, in_m, out_ready;
        outputs: in_ready, out_valid, out_reciprocal;
        blocks: newton, flow;
        state: s1_m, newton, flow
    }
}
