// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lets a triangle without displacement pass: two steps that make it as it is, instead of the remesher's.
//!
//! ```text
//! Start: left = P0, right = P1      Step: left = P2, the last one -> triangle (P0, P1, P2)
//! ```
//!
//! | port    | format        |   Latency 0, interval 2; golden: models::displacement_pipeline::Machine   Error 0
//! | piece_* | stream        | lanes of a piece; it stands until its second step is taken
//! | out_*   | stream        | the step port

use crate::prelude::*;

/// The passer, for lanes of `V` bits.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Passer<const V: usize> {
    pub clock: Input<ClockReset>,
    pub piece_valid: Input<Bit>,
    pub piece_ready: Output<Bit>,
    pub piece_v0: Input<Lanes<9, V>>,
    pub piece_v1: Input<Lanes<9, V>>,
    pub piece_v2: Input<Lanes<9, V>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_kind: Output<U<2>>,
    pub out_left: Output<U<2>>,
    pub out_right: Output<U<2>>,
    pub out_last: Output<Bit>,
    pub out_left_vertex: Output<Lanes<9, V>>,
    pub out_right_vertex: Output<Lanes<9, V>>,
    second: Register<Bit>,
}

impl<const V: usize> Logic for Passer<V> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, second);
        self.out_valid.next = self.piece_valid.val();
        self.piece_ready.next = self.second.q.val() && self.out_ready.val();
        // 1 is a start, or the vertex that is sent.
        self.out_kind.next = 1.into();
        self.out_left.next = 1.into();
        self.out_right.next = 1.into();
        self.out_last.next = self.second.q.val();
        self.out_left_vertex.next = self.piece_v0.val();
        self.out_right_vertex.next = self.piece_v1.val();
        if self.second.q.val() {
            self.out_kind.next = 0.into();
            self.out_right.next = 0.into();
            self.out_left_vertex.next = self.piece_v2.val();
        }
        if self.piece_valid.val() && self.out_ready.val() {
            self.second.d.next = !self.second.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("passer")
    }
}

watched! { [const V: usize] Passer<V>: piece_valid, piece_v0, piece_v1, piece_v2, out_ready; ; second }
