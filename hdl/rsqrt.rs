// SPDX-License-Identifier: MIT OR Apache-2.0
//! The reciprocal square root of a normalised number: a table of 128 straight lines and one step of Newton's.
//!
//! `out = 2^32 / sqrt(x) (1 - error), |error| < 2^-29.68`
//!
//! | port     | format | range |   Latency 25, interval 1
//! | in_x     | UQ2.30 | [1, 4): one of the two leading bits is set   Golden: models::rsqrt::golden
//! | out_root | UQ0.32 | [1/2, 1); 1.0 is not reached
//!
//! Example: 0x8000_0000 (2.0) -> 0xB504_F33x (0.70710678). [`Normalize`] takes a vector to length 1 with it.

mod inverse_root;
mod normalize;
mod shorten;
mod table;
mod unit_vector;

pub use inverse_root::InverseRoot;
pub use normalize::Normalize;
pub use shorten::Shorten;
pub use table::RootTable;
pub use unit_vector::UnitVector;

use crate::pipeline::Flow;
use crate::prelude::*;

/// Reciprocal square root.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Rsqrt {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_x: Input<U<32>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_root: Output<U<32>>,
    s1_x: DataRegister<U<32>>,
    inverse: InverseRoot,
    flow: Flow<{ 1 + InverseRoot::LATENCY }, 32>,
}

impl Rsqrt {
    /// Cycles from number to root: one for the input, those of the root, and the one behind its last.
    pub const LATENCY: usize = 1 + InverseRoot::LATENCY + 1;
}

impl Logic for Rsqrt {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, inverse, flow);
        dff_setup!(self, clock, s1_x);
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.flow.go.val();
        if self.flow.go.val() {
            self.s1_x.d.next = self.in_x.val();
        }
        self.inverse.go.next = self.flow.go.val();
        self.inverse.number.next = self.s1_x.q.val();
        self.flow.value.next = bit_cast_to::<WideU<32>>(self.inverse.root.val());
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_root.next = bit_cast_to::<U<32>>(self.flow.out_value.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("rsqrt")
    }
}

ports! {
    [] Rsqrt {
        inputs: in_valid, in_x, out_ready;
        outputs: in_ready, out_valid, out_root;
        blocks: inverse, flow;
        state: s1_x, inverse, flow
    }
}
