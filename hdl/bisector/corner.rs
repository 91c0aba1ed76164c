// SPDX-License-Identifier: MIT OR Apache-2.0
//! One corner of a triangle, clamped to the map. Combinational.
//!
//! corner = min(m + 2^level dir(towards), rim), in lattice steps: v << 13 | u
//!
//! | port       | format         |   Golden: models::bisector (Node::corners, Lattice::clamp)   Error 0
//! | u, v, rim_* | unsigned H    | half steps   Example: (4, 4), level 2, towards 7, rims (6, 6): (3, 0)
//! | level, towards | unsigned 4, 3 |
//! | corner     | unsigned 26    |

use crate::prelude::*;

/// Corner for lattices of up to 2^K steps, K <= 12, H = K + 2.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorCorner<const H: usize> {
    pub u: Input<U<H>>,
    pub v: Input<U<H>>,
    pub level: Input<U<4>>,
    pub towards: Input<U<3>>,
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub corner: Output<U<26>>,
    one: Wire<U<H>>,
    step: Wire<U<H>>,
    to_u: Wire<U<H>>,
    to_v: Wire<U<H>>,
    at_u: Wire<U<H>>,
    at_v: Wire<U<H>>,
}

impl<const H: usize> Logic for BisectorCorner<H> {
    #[hdl_gen]
    fn update(&mut self) {
        // Corners lie in the lattice, 0 ..= 2^(K + 1).
        self.one.next = 1.into();
        self.step.next = self.one.val() << self.level.val();
        self.to_u.next = self.u.val();
        if self.towards.val() == 7 || self.towards.val() <= 1 {
            self.to_u.next = self.u.val() + self.step.val();
        } else if self.towards.val() >= 3 && self.towards.val() <= 5 {
            self.to_u.next = self.u.val() - self.step.val();
        }
        self.to_v.next = self.v.val();
        if self.towards.val() >= 1 && self.towards.val() <= 3 {
            self.to_v.next = self.v.val() + self.step.val();
        } else if self.towards.val() >= 5 {
            self.to_v.next = self.v.val() - self.step.val();
        }
        self.at_u.next = self.to_u.val();
        if self.to_u.val() > self.rim_u.val() {
            self.at_u.next = self.rim_u.val();
        }
        self.at_v.next = self.to_v.val();
        if self.to_v.val() > self.rim_v.val() {
            self.at_v.next = self.rim_v.val();
        }
        // Corners stand on lattice vertices: no bit is lost.
        self.corner.next =
            bit_cast_to::<U<26>>(self.at_u.val() >> 1) | (bit_cast_to::<U<26>>(self.at_v.val() >> 1) << 13);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_corner")
    }
}

latches! { [const H: usize] BisectorCorner<H>: }
