// SPDX-License-Identifier: MIT OR Apache-2.0
//! Length and main direction of an edge.
//!
//! length = max |to[k] - from[k]|, direction = the axis k of that maximum, ties x > y > z
//!
//! | port            | format       |   Latency 3; s1 differences, s2 sizes, s3 comparisons
//! | from, to        | 3 x signed T, standing still for three cycles |   Golden: models::remesher (setup)   Error 0
//! Example: (0,0,0) -> (2,-3,3): length 3, direction 1

use crate::prelude::*;

/// Measures one edge.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct EdgeMeasure<const T: usize> {
    pub clock: Input<ClockReset>,
    pub from: Input<Lanes<3, T>>,
    pub to: Input<Lanes<3, T>>,
    pub length: Output<S<T>>,
    pub direction: Output<U<2>>,
    s1_difference: DataRegister<Lanes<3, T>>,
    s2_size: DataRegister<Lanes<3, T>>,
    sign: Wire<Lanes<3, T>>,
    /// x >= y, x >= z, y >= z.
    s3_xy: DataRegister<Bit>,
    s3_xz: DataRegister<Bit>,
    s3_yz: DataRegister<Bit>,
    x: Wire<S<T>>,
    y: Wire<S<T>>,
    z: Wire<S<T>>,
}

impl<const T: usize> Logic for EdgeMeasure<T> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_difference, s2_size, s3_xy, s3_xz, s3_yz);
        self.s1_difference.d.next = self.to.val() - self.from.val();
        // |x| = (x ^ sign) - sign with sign all ones for a negative x. A shift by 32 leaves the sign of T <= 32 bits.
        self.sign.next = self.s1_difference.q.val() >> 32;
        self.s2_size.d.next = (self.s1_difference.q.val() ^ self.sign.val()) - self.sign.val();
        self.x.next = self.s2_size.q.val().get_bit(0);
        self.y.next = self.s2_size.q.val().get_bit(1);
        self.z.next = self.s2_size.q.val().get_bit(2);
        self.s3_xy.d.next = self.x.val() >= self.y.val();
        self.s3_xz.d.next = self.x.val() >= self.z.val();
        self.s3_yz.d.next = self.y.val() >= self.z.val();
        if self.s3_xy.q.val() && self.s3_xz.q.val() {
            self.length.next = self.x.val();
            self.direction.next = 0.into();
        } else if self.s3_yz.q.val() {
            self.length.next = self.y.val();
            self.direction.next = 1.into();
        } else {
            self.length.next = self.z.val();
            self.direction.next = 2.into();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("edge_measure")
    }
}

watched! { [const T: usize] EdgeMeasure<T>: from, to;; s1_difference, s2_size, s3_xy, s3_xz, s3_yz }
