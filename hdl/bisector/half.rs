// SPDX-License-Identifier: MIT OR Apache-2.0
//! One half of a triangle: where it is, and whether it has an area in the map.
//!
//! m' = m - step dir(to)
//!
//! | port       | format         |   Golden: models::bisector (Node::halves, Lattice::is_dead)   Error 0
//! | u, v       | unsigned H     | midpoint in half steps; the half's is in the lattice, too
//! | step       | unsigned H     | 2^level of the half   Example: (4, 4), step 4, to 4: (8, 4)
//! | to         | unsigned 3     | direction of the half
//! | rim_u, rim_v | unsigned H   | last column and row of the map, in half steps
//! | dead       | Bit            | two cycles later: the half has no area in the map
//! | half_u, half_v, half_to |   | three cycles later: the half; holds while `go` is low

use crate::prelude::*;

/// Half for lattices of up to 2^K steps, H = K + 2.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorHalf<const H: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub u: Input<U<H>>,
    pub v: Input<U<H>>,
    pub step: Input<U<H>>,
    pub to: Input<U<3>>,
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub dead: Output<Bit>,
    pub half_u: Output<U<H>>,
    pub half_v: Output<U<H>>,
    pub half_to: Output<U<3>>,
    s1_u: DataRegister<U<H>>,
    s1_v: DataRegister<U<H>>,
    s1_to: DataRegister<U<3>>,
    /// Midpoints from here on are dead.
    s1_least_u: DataRegister<U<H>>,
    s1_least_v: DataRegister<U<H>>,
    s2_u: DataRegister<U<H>>,
    s2_v: DataRegister<U<H>>,
    s2_to: DataRegister<U<3>>,
    s2_dead_u: DataRegister<Bit>,
    s2_dead_v: DataRegister<Bit>,
    s3_u: DataRegister<U<H>>,
    s3_v: DataRegister<U<H>>,
    s3_to: DataRegister<U<3>>,
}

impl<const H: usize> Logic for BisectorHalf<H> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_u, s1_v, s1_to, s1_least_u, s1_least_v, s2_u, s2_v, s2_to, s2_dead_u);
        dff_setup!(self, clock, s2_dead_v, s3_u, s3_v, s3_to);
        self.dead.next = self.s2_dead_u.q.val() || self.s2_dead_v.q.val();
        self.half_u.next = self.s3_u.q.val();
        self.half_v.next = self.s3_v.q.val();
        self.half_to.next = self.s3_to.q.val();
        if self.go.val() {
            // s1_at: against the half's direction, whose u is 0 for 2 and 6 and below 0 for 3, 4 and 5. The midpoint stays in
            // the lattice, 0 ..= 2^(K + 1).
            self.s1_u.d.next = self.u.val();
            if !self.to.val().get_bit(1) || self.to.val().get_bit(0) {
                if self.to.val().get_bit(2) != self.to.val().get_bit(1) {
                    self.s1_u.d.next = self.u.val() + self.step.val();
                } else {
                    self.s1_u.d.next = self.u.val() - self.step.val();
                }
            }
            self.s1_v.d.next = self.v.val();
            if self.to.val().get_bit(1) || self.to.val().get_bit(0) {
                if self.to.val().get_bit(2) {
                    self.s1_v.d.next = self.v.val() + self.step.val();
                } else {
                    self.s1_v.d.next = self.v.val() - self.step.val();
                }
            }
            self.s1_to.d.next = self.to.val();
            // The lowest corner is a step below the midpoint, but on an axis that the triangle lies at one side of. Rim and step
            // are at most 2^(K + 1) and 2^K, so their sum fits H = K + 2 bits.
            self.s1_least_u.d.next = self.rim_u.val() + self.step.val();
            if self.to.val() == 0 {
                self.s1_least_u.d.next = self.rim_u.val();
            }
            self.s1_least_v.d.next = self.rim_v.val() + self.step.val();
            if self.to.val() == 2 {
                self.s1_least_v.d.next = self.rim_v.val();
            }
            // s2_dead
            self.s2_dead_u.d.next = self.s1_u.q.val() >= self.s1_least_u.q.val();
            self.s2_dead_v.d.next = self.s1_v.q.val() >= self.s1_least_v.q.val();
            self.s2_u.d.next = self.s1_u.q.val();
            self.s2_v.d.next = self.s1_v.q.val();
            self.s2_to.d.next = self.s1_to.q.val();
            self.s3_u.d.next = self.s2_u.q.val();
            self.s3_v.d.next = self.s2_v.q.val();
            self.s3_to.d.next = self.s2_to.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_half")
    }
}

latches! { [const H: usize] BisectorHalf<H>: s1_u, s1_v, s1_to, s1_least_u, s1_least_v, s2_u, s2_v, s2_to, s2_dead_u, s2_dead_v, s3_u, s3_v, s3_to }
