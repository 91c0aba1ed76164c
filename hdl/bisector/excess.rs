// SPDX-License-Identifier: MIT OR Apache-2.0
//! How far a triangle and all below it stay from the eye, at least. Combinational.
//!
//! excess = max(0, max(|u - eye_u|, |v - eye_v|) - R), u and v clamped to the map, R = 2^(level + 1), or 3 2^level when
//! the hypotenuse is a diagonal
//!
//! | port       | format     |   Golden: models::bisector (Bound::at)   Error 0
//! | u, v, rim_*, eye_* | unsigned H | half steps   Example: (0, 0), level 1, diagonal, the eye at (20, 4): 14
//! | level      | unsigned 4 |
//! | diagonal   | Bit        | the hypotenuse is one
//! | excess     | unsigned H | half steps

use crate::prelude::*;

/// Excess for lattices of up to 2^(H - 2) steps.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorExcess<const H: usize> {
    pub u: Input<U<H>>,
    pub v: Input<U<H>>,
    pub level: Input<U<4>>,
    pub diagonal: Input<Bit>,
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub eye_u: Input<U<H>>,
    pub eye_v: Input<U<H>>,
    pub excess: Output<U<H>>,
    at_u: Wire<U<H>>,
    at_v: Wire<U<H>>,
    far_u: Wire<U<H>>,
    far_v: Wire<U<H>>,
    far: Wire<U<H>>,
    one: Wire<U<H>>,
    step: Wire<U<H>>,
    reach: Wire<U<H>>,
}

impl<const H: usize> Logic for BisectorExcess<H> {
    #[hdl_gen]
    fn update(&mut self) {
        self.at_u.next = self.u.val();
        if self.u.val() > self.rim_u.val() {
            self.at_u.next = self.rim_u.val();
        }
        self.at_v.next = self.v.val();
        if self.v.val() > self.rim_v.val() {
            self.at_v.next = self.rim_v.val();
        }
        self.far_u.next = self.at_u.val() - self.eye_u.val();
        if self.at_u.val() < self.eye_u.val() {
            self.far_u.next = self.eye_u.val() - self.at_u.val();
        }
        self.far_v.next = self.at_v.val() - self.eye_v.val();
        if self.at_v.val() < self.eye_v.val() {
            self.far_v.next = self.eye_v.val() - self.at_v.val();
        }
        self.far.next = self.far_u.val();
        if self.far_v.val() > self.far_u.val() {
            self.far.next = self.far_v.val();
        }
        // At most 3 2^K, below 2^H.
        self.one.next = 1.into();
        self.step.next = self.one.val() << self.level.val();
        self.reach.next = self.step.val() << 1;
        if self.diagonal.val() {
            self.reach.next = (self.step.val() << 1) + self.step.val();
        }
        self.excess.next = 0.into();
        if self.far.val() > self.reach.val() {
            self.excess.next = self.far.val() - self.reach.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_excess")
    }
}

latches! { [const H: usize] BisectorExcess<H>: }
