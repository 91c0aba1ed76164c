// SPDX-License-Identifier: MIT OR Apache-2.0
//! How far a triangle and all below it stay from the eye, at least.
//!
//! excess = max(0, max(|u - eye_u|, |v - eye_v|) - R), u and v clamped to the map, R = 2^(level + 1), or 3 2^level when
//! the hypotenuse is a diagonal; 0 for a root
//!
//! | port       | format     |   Golden: models::bisector (Bound::at)   Error 0   Latency 3; holds while `go` is low
//! | u, v       | unsigned H | half steps   Example: (0, 0), step 2, diagonal, the eye at (20, 4): 14
//! | rim_*, eye_* | unsigned H | half steps; they stand for two cycles before
//! | step       | unsigned H | 2^level, a cycle after u and v, as is diagonal: the hypotenuse is one
//! | root       | Bit        | two cycles after u and v
//! | excess     | unsigned H | half steps

use crate::prelude::*;

/// Excess for lattices of up to 2^(H - 2) steps.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorExcess<const H: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub u: Input<U<H>>,
    pub v: Input<U<H>>,
    pub step: Input<U<H>>,
    pub diagonal: Input<Bit>,
    pub root: Input<Bit>,
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub eye_u: Input<U<H>>,
    pub eye_v: Input<U<H>>,
    pub excess: Output<U<H>>,
    // What is beyond the rim stands on it.
    rim_far_u: DataRegister<U<H>>,
    rim_far_v: DataRegister<U<H>>,
    s1_far_u: DataRegister<U<H>>,
    s1_far_v: DataRegister<U<H>>,
    /// Distances less reach, and whether that is below zero.
    s2_over_u: DataRegister<U<H>>,
    s2_over_v: DataRegister<U<H>>,
    s2_within_u: DataRegister<Bit>,
    s2_within_v: DataRegister<Bit>,
    s2_farther_v: DataRegister<Bit>,
    s3_excess: DataRegister<U<H>>,
    reach: Wire<U<H>>,
    over_u: Wire<S<16>>,
    over_v: Wire<S<16>>,
}

impl<const H: usize> Logic for BisectorExcess<H> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            rim_far_u,
            rim_far_v,
            s1_far_u,
            s1_far_v,
            s2_over_u,
            s2_over_v,
            s2_within_u,
            s2_within_v,
            s2_farther_v
        );
        dff_setup!(self, clock, s3_excess);
        self.excess.next = self.s3_excess.q.val();
        // A reach is at most 3 2^K, below 2^H; a step is one bit.
        self.reach.next = self.step.val() << 1;
        if self.diagonal.val() {
            self.reach.next = (self.step.val() << 1) | self.step.val();
        }
        self.over_u.next = bit_cast_to::<S<16>>(self.s1_far_u.q.val()) - bit_cast_to::<S<16>>(self.reach.val());
        self.over_v.next = bit_cast_to::<S<16>>(self.s1_far_v.q.val()) - bit_cast_to::<S<16>>(self.reach.val());
        self.rim_far_u.d.next = self.rim_u.val() - self.eye_u.val();
        if self.rim_u.val() < self.eye_u.val() {
            self.rim_far_u.d.next = self.eye_u.val() - self.rim_u.val();
        }
        self.rim_far_v.d.next = self.rim_v.val() - self.eye_v.val();
        if self.rim_v.val() < self.eye_v.val() {
            self.rim_far_v.d.next = self.eye_v.val() - self.rim_v.val();
        }
        if self.go.val() {
            // s1_far
            self.s1_far_u.d.next = self.u.val() - self.eye_u.val();
            if self.u.val() > self.rim_u.val() {
                self.s1_far_u.d.next = self.rim_far_u.q.val();
            } else if self.u.val() < self.eye_u.val() {
                self.s1_far_u.d.next = self.eye_u.val() - self.u.val();
            }
            self.s1_far_v.d.next = self.v.val() - self.eye_v.val();
            if self.v.val() > self.rim_v.val() {
                self.s1_far_v.d.next = self.rim_far_v.q.val();
            } else if self.v.val() < self.eye_v.val() {
                self.s1_far_v.d.next = self.eye_v.val() - self.v.val();
            }
            // s2_over
            self.s2_over_u.d.next = bit_cast_to::<U<H>>(self.over_u.val());
            self.s2_over_v.d.next = bit_cast_to::<U<H>>(self.over_v.val());
            self.s2_within_u.d.next = self.over_u.val().get_bit(15);
            self.s2_within_v.d.next = self.over_v.val().get_bit(15);
            self.s2_farther_v.d.next = self.s1_far_v.q.val() > self.s1_far_u.q.val();
            // s3_excess: a choice and no more, for a multiplier stands behind it.
            self.s3_excess.d.next = 0.into();
            if !self.root.val() {
                if self.s2_farther_v.q.val() {
                    if !self.s2_within_v.q.val() {
                        self.s3_excess.d.next = self.s2_over_v.q.val();
                    }
                } else if !self.s2_within_u.q.val() {
                    self.s3_excess.d.next = self.s2_over_u.q.val();
                }
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_excess")
    }
}

latches! { [const H: usize] BisectorExcess<H>: rim_far_u, rim_far_v, s1_far_u, s1_far_v, s2_over_u, s2_over_v, s2_within_u, s2_within_v, s2_farther_v, s3_excess }
