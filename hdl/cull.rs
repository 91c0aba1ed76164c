// SPDX-License-Identifier: MIT OR Apache-2.0
//! What becomes of a base triangle: it is culled, has to be cut, is dropped, or goes on.
//!
//! ```text
//! culled <=> the outcodes have a bit in common        cut <=> any corner is behind a constant plane
//! dropped <=> a corner has no place in the formats    in this order
//! ```
//!
//! | port         | format     | meaning |   Latency 3, interval 1
//! | in_outcode_* | unsigned 6 | sides of the volume of sight that the corner is beyond
//! | in_outside_* | unsigned 5 | constant planes that it is behind
//! | in_status_*  | unsigned 2 | of the vertex transform: 1 beyond the lanes, 2 beyond the grid
//! | in_culls     | Bit        | the draw culls; it travels with the triangle
//! | out_verdict  | unsigned 2 | 0 kept, 1 culled, 2 cut, 3 dropped   Golden: models::cull::verdict   Error 0
//! | out_reason   | unsigned 3 | the first common side; the first status of the corners; otherwise 0
//!
//! A status of 3, behind z0, comes with bit 0 of outside, so it is cut. Whether anything is left of a triangle that is cut, the
//! cutter finds out.
//!
//! | stage | operation |
//! |-------|-----------|
//! | s1    | sides in common, any plane, the first status |
//! | s2    | verdict and reason |
//! | s3    | what is sent, and one more that waits |
//!
//! Example: outcodes 0b110, 0b011, 0b010 -> culled by side 1, right; without `in_culls` kept.

use crate::pipeline::Flow;
use crate::prelude::*;

/// Culling.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Cull {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_outcode_0: Input<U<6>>,
    pub in_outcode_1: Input<U<6>>,
    pub in_outcode_2: Input<U<6>>,
    pub in_outside_0: Input<U<5>>,
    pub in_outside_1: Input<U<5>>,
    pub in_outside_2: Input<U<5>>,
    pub in_status_0: Input<U<2>>,
    pub in_status_1: Input<U<2>>,
    pub in_status_2: Input<U<2>>,
    pub in_culls: Input<Bit>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_verdict: Output<U<2>>,
    pub out_reason: Output<U<3>>,
    s1_common: DataRegister<U<6>>,
    s1_cut: DataRegister<Bit>,
    s1_status: DataRegister<U<2>>,
    s2_verdict: DataRegister<U<2>>,
    s2_reason: DataRegister<U<3>>,
    flow: Flow<{ Cull::STAGES }, 5>,
    common: Wire<U<6>>,
    any: Wire<U<5>>,
    side: Wire<U<3>>,
}

impl Cull {
    const STAGES: usize = 2;
    /// Cycles from corners to verdict.
    pub const LATENCY: usize = Self::STAGES + 1;
}

impl Logic for Cull {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, flow);
        dff_setup!(self, clock, s1_common, s1_cut, s1_status, s2_verdict, s2_reason);
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.flow.go.val();
        self.common.next = self.in_outcode_0.val() & self.in_outcode_1.val() & self.in_outcode_2.val();
        self.any.next = self.in_outside_0.val() | self.in_outside_1.val() | self.in_outside_2.val();
        self.side.next = 5.into();
        if self.s1_common.q.val().get_bit(0) {
            self.side.next = 0.into();
        } else if self.s1_common.q.val().get_bit(1) {
            self.side.next = 1.into();
        } else if self.s1_common.q.val().get_bit(2) {
            self.side.next = 2.into();
        } else if self.s1_common.q.val().get_bit(3) {
            self.side.next = 3.into();
        } else if self.s1_common.q.val().get_bit(4) {
            self.side.next = 4.into();
        }
        if self.flow.go.val() {
            self.s1_common.d.next = self.common.val();
            if !self.in_culls.val() {
                self.s1_common.d.next = 0.into();
            }
            self.s1_cut.d.next = self.any.val().any();
            self.s1_status.d.next = self.in_status_2.val();
            if self.in_status_0.val().any() {
                self.s1_status.d.next = self.in_status_0.val();
            } else if self.in_status_1.val().any() {
                self.s1_status.d.next = self.in_status_1.val();
            }
            self.s2_verdict.d.next = 0.into();
            self.s2_reason.d.next = 0.into();
            if self.s1_common.q.val().any() {
                self.s2_verdict.d.next = 1.into();
                self.s2_reason.d.next = self.side.val();
            } else if self.s1_cut.q.val() {
                self.s2_verdict.d.next = 2.into();
            } else if self.s1_status.q.val().any() {
                self.s2_verdict.d.next = 3.into();
                self.s2_reason.d.next = bit_cast_to::<U<3>>(self.s1_status.q.val());
            }
        }
        self.flow.value.next =
            bit_cast_to::<WideU<5>>(self.s2_verdict.q.val()) | (bit_cast_to::<WideU<5>>(self.s2_reason.q.val()) << 2);
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_verdict.next = self.flow.out_value.val().get_bits::<2>(0);
        self.out_reason.next = self.flow.out_value.val().get_bits::<3>(2);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("cull")
    }
}

ports! {
    [] Cull {
        inputs: in_valid, in_outcode_0, in_outcode_1, in_outcode_2, in_outside_0, in_outside_1, in_outside_2, in_status_0, in_status_1, in_status_2, in_culls, out_ready;
        outputs: in_ready, out_valid, out_verdict, out_reason;
        blocks: flow;
        state: s1_common, s1_cut, s1_status, s2_verdict, s2_reason, flow
    }
}
