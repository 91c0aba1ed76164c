// SPDX-License-Identifier: MIT OR Apache-2.0
//! One corner of a triangle, clamped to the map.
//!
//! corner = min(m + step dir(towards), rim), in lattice steps: v << 13 | u
//!
//! | port       | format         |   Golden: models::bisector (Node::corners, Lattice::clamp)   Error 0
//! | u, v, step, rim_* | unsigned H | half steps   Example: (4, 4), step 4, towards 7, rims (6, 6): (3, 0)
//! | towards    | unsigned 3     |   Latency 2; holds while `go` is low
//! | corner     | unsigned 26    |

use crate::prelude::*;

/// Corner for lattices of up to 2^K steps, K <= 12, H = K + 2.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorCorner<const H: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub u: Input<U<H>>,
    pub v: Input<U<H>>,
    pub step: Input<U<H>>,
    pub towards: Input<U<3>>,
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub corner: Output<U<26>>,
    s1_u: DataRegister<U<H>>,
    s1_v: DataRegister<U<H>>,
    s2_corner: DataRegister<U<26>>,
    at_u: Wire<U<H>>,
    at_v: Wire<U<H>>,
}

impl<const H: usize> Logic for BisectorCorner<H> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_u, s1_v, s2_corner);
        self.corner.next = self.s2_corner.q.val();
        self.at_u.next = self.s1_u.q.val();
        if self.s1_u.q.val() > self.rim_u.val() {
            self.at_u.next = self.rim_u.val();
        }
        self.at_v.next = self.s1_v.q.val();
        if self.s1_v.q.val() > self.rim_v.val() {
            self.at_v.next = self.rim_v.val();
        }
        if self.go.val() {
            // s1_at: u goes nowhere for 2 and 6, and down for 3, 4 and 5. Corners lie in the lattice, 0 ..= 2^(K + 1).
            self.s1_u.d.next = self.u.val();
            if !self.towards.val().get_bit(1) || self.towards.val().get_bit(0) {
                if self.towards.val().get_bit(2) != self.towards.val().get_bit(1) {
                    self.s1_u.d.next = self.u.val() - self.step.val();
                } else {
                    self.s1_u.d.next = self.u.val() + self.step.val();
                }
            }
            self.s1_v.d.next = self.v.val();
            if self.towards.val().get_bit(1) || self.towards.val().get_bit(0) {
                if self.towards.val().get_bit(2) {
                    self.s1_v.d.next = self.v.val() - self.step.val();
                } else {
                    self.s1_v.d.next = self.v.val() + self.step.val();
                }
            }
            // s2_corner: corners stand on lattice vertices, so no bit is lost.
            self.s2_corner.d.next =
                bit_cast_to::<U<26>>(self.at_u.val() >> 1) | (bit_cast_to::<U<26>>(self.at_v.val() >> 1) << 13);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_corner")
    }
}

latches! { [const H: usize] BisectorCorner<H>: s1_u, s1_v, s2_corner }
