// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lanes of a transformed vertex, narrowed to what the remesher carries.
//!
//! | port   | format        |   Latency 0; golden: models::lanes::Lanes::narrow
//! | whole  | 9 x signed 32 |
//! | narrow | 9 x signed V  | floor(lane 2^(V - 32) + 1/2), at most the largest; lane 2, c, at least 1
//!
//! Example, V = 24: X = 0x0012_3456 -> 0x1234.

use crate::prelude::*;

/// One lane.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct NarrowLane<const V: usize> {
    pub whole: Input<S<32>>,
    pub narrow: Output<S<V>>,
    rounded: Wire<S<33>>,
    half: Constant<S<33>>,
    gone: Constant<U<6>>,
    most: Constant<S<33>>,
}

impl<const V: usize> Default for NarrowLane<V> {
    fn default() -> Self {
        Self {
            whole: Input::default(),
            narrow: Output::default(),
            rounded: Wire::default(),
            half: Constant::new(S::new((1i64 << (32 - V)) >> 1)),
            gone: Constant::new(U::new(32 - V as i64)),
            most: Constant::new(S::new((1i64 << (V - 1)) - 1)),
        }
    }
}

impl<const V: usize> Logic for NarrowLane<V> {
    #[hdl_gen]
    fn update(&mut self) {
        self.rounded.next = (bit_cast_to::<S<33>>(self.whole.val()) + self.half.val()) >> self.gone.val();
        self.narrow.next = bit_cast_to::<S<V>>(self.rounded.val());
        if self.rounded.val() > self.most.val() {
            self.narrow.next = bit_cast_to::<S<V>>(self.most.val());
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("narrow_lane_{V}"))
    }
}

/// Nine lanes.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Narrow<const V: usize> {
    pub whole: Input<Lanes<9, 32>>,
    pub narrow: Output<Lanes<9, V>>,
    lane_x: NarrowLane<V>,
    lane_y: NarrowLane<V>,
    lane_c: NarrowLane<V>,
    lane_nx: NarrowLane<V>,
    lane_ny: NarrowLane<V>,
    lane_nz: NarrowLane<V>,
    lane_u: NarrowLane<V>,
    lane_v: NarrowLane<V>,
    lane_density: NarrowLane<V>,
    positive: Wire<S<V>>,
    lanes_1: Wire<Lanes<9, V>>,
    lanes_2: Wire<Lanes<9, V>>,
    lanes_3: Wire<Lanes<9, V>>,
    lanes_4: Wire<Lanes<9, V>>,
    lanes_5: Wire<Lanes<9, V>>,
    lanes_6: Wire<Lanes<9, V>>,
    lanes_7: Wire<Lanes<9, V>>,
    lanes_8: Wire<Lanes<9, V>>,
}

impl<const V: usize> Logic for Narrow<V> {
    #[hdl_gen]
    fn update(&mut self) {
        self.lane_x.whole.next = self.whole.val().get_bit(0);
        self.lane_y.whole.next = self.whole.val().get_bit(1);
        self.lane_c.whole.next = self.whole.val().get_bit(2);
        self.lane_nx.whole.next = self.whole.val().get_bit(3);
        self.lane_ny.whole.next = self.whole.val().get_bit(4);
        self.lane_nz.whole.next = self.whole.val().get_bit(5);
        self.lane_u.whole.next = self.whole.val().get_bit(6);
        self.lane_v.whole.next = self.whole.val().get_bit(7);
        self.lane_density.whole.next = self.whole.val().get_bit(8);
        self.positive.next = self.lane_c.narrow.val();
        if self.lane_c.narrow.val() < 1 {
            self.positive.next = 1.into();
        }
        self.lanes_1.next = bit_cast_to::<Lanes<9, V>>(self.lane_x.narrow.val());
        self.lanes_2.next = self.lanes_1.val().replace_bit(1, self.lane_y.narrow.val());
        self.lanes_3.next = self.lanes_2.val().replace_bit(2, self.positive.val());
        self.lanes_4.next = self.lanes_3.val().replace_bit(3, self.lane_nx.narrow.val());
        self.lanes_5.next = self.lanes_4.val().replace_bit(4, self.lane_ny.narrow.val());
        self.lanes_6.next = self.lanes_5.val().replace_bit(5, self.lane_nz.narrow.val());
        self.lanes_7.next = self.lanes_6.val().replace_bit(6, self.lane_u.narrow.val());
        self.lanes_8.next = self.lanes_7.val().replace_bit(7, self.lane_v.narrow.val());
        self.narrow.next = self.lanes_8.val().replace_bit(8, self.lane_density.narrow.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("narrow_{V}"))
    }
}
