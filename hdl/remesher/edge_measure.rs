// SPDX-License-Identifier: MIT OR Apache-2.0
//! Length and main direction of an edge. Combinational.
//!
//! length = max |to[k] - from[k]|, direction = the axis k of that maximum, ties x > y > z
//!
//! | port            | format       |   Golden: models::remesher (setup)   Error 0
//! | from, to        | 3 x signed T |   Example: (0,0,0) -> (2,-3,3): length 3, direction 1

use crate::prelude::*;

/// Measures one edge.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct EdgeMeasure<const T: usize> {
    pub from: Input<Lanes<3, T>>,
    pub to: Input<Lanes<3, T>>,
    pub length: Output<S<T>>,
    pub direction: Output<U<2>>,
    difference: Wire<Lanes<3, T>>,
    sign: Wire<Lanes<3, T>>,
    size: Wire<Lanes<3, T>>,
    x: Wire<S<T>>,
    y: Wire<S<T>>,
    z: Wire<S<T>>,
}

impl<const T: usize> Logic for EdgeMeasure<T> {
    #[hdl_gen]
    fn update(&mut self) {
        self.difference.next = self.to.val() - self.from.val();
        // |x| = (x ^ sign) - sign with sign all ones for a negative x. A shift by 32 leaves the sign of T <= 32 bits.
        self.sign.next = self.difference.val() >> 32;
        self.size.next = (self.difference.val() ^ self.sign.val()) - self.sign.val();
        self.x.next = self.size.val().get_bit(0);
        self.y.next = self.size.val().get_bit(1);
        self.z.next = self.size.val().get_bit(2);
        if self.x.val() >= self.y.val() && self.x.val() >= self.z.val() {
            self.length.next = self.x.val();
            self.direction.next = 0.into();
        } else if self.y.val() >= self.z.val() {
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
