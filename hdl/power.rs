// SPDX-License-Identifier: MIT OR Apache-2.0
//! A number up to one to a power: twice a table of 64 straight lines, for the logarithm and for what comes back from it.
//!
//! `out = 2^-(n (-log2 x))`, within 0.0007 of x^n for n up to 128
//!
//! | port      | format | range |   Latency 29, interval 1
//! | in_x      | UQ1.16 | [0, 1]; 0 gives 0   Golden: models::power::golden
//! | in_n      | unsigned 8 | at least 1
//! | out_power | UQ1.16 | [0, 1]; 1.0 is representable
//!
//! Example: 0x8000 (0.5), n = 4 -> 0x1000 (0.0625).

mod raise;
mod tables;

pub use raise::Raise;
pub use tables::{ExpTable, LogTable};

use crate::pipeline::Flow;
use crate::prelude::*;

/// Power.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Power {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_x: Input<U<17>>,
    pub in_n: Input<U<8>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_power: Output<U<17>>,
    s1_x: DataRegister<U<17>>,
    s1_n: DataRegister<U<8>>,
    raise: Raise,
    flow: Flow<{ 1 + Raise::LATENCY }, 17>,
}

impl Power {
    /// Cycles from number to power: one for the input, those of the part, and the one behind its last.
    pub const LATENCY: usize = 1 + Raise::LATENCY + 1;
}

impl Logic for Power {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, raise, flow);
        dff_setup!(self, clock, s1_x, s1_n);
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.flow.go.val();
        if self.flow.go.val() {
            self.s1_x.d.next = self.in_x.val();
            self.s1_n.d.next = self.in_n.val();
        }
        self.raise.go.next = self.flow.go.val();
        self.raise.base.next = self.s1_x.q.val();
        self.raise.exponent.next = self.s1_n.q.val();
        self.flow.value.next = bit_cast_to::<WideU<17>>(self.raise.power.val());
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_power.next = bit_cast_to::<U<17>>(self.flow.out_value.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("power")
    }
}

ports! {
    [] Power {
        inputs: in_valid, in_x, in_n, out_ready;
        outputs: in_ready, out_valid, out_power;
        blocks: raise, flow;
        state: s1_x, s1_n, raise, flow
    }
}
