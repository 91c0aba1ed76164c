// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a vertex faces away from the eye, by its own normal.
//!
//! ```text
//! S = nx c (X >> 14) + ny c (Y >> 14) + nz c (f >> 12)        away <=> S >= 0
//! ```
//!
//! | port         | format      | meaning |   Latency 12, interval 1
//! | in_normal    | 3 x SQ0.31  | lanes nx c, ny c, nz c
//! | in_x, in_y   | SQ0.31      | lanes X, Y
//! | in_focal     | UQ16.16     | focal length in pixels; it travels with the vertex
//! | out_away     | Bit         | S >= 0   Golden: models::facing::golden   Error 0
//!
//! | stage           | operation                                      | width |
//! | s1              | the input                                      | |
//! | s2 .. s6, s7_z  | products                                       | 50, 50, 53 bits |
//! | s7_low, s8_high | sum of the first two, upper half a cycle later | 27 and 25 bits |
//! | s9_low, s10_high | the third one added, likewise                 | 27 and 28 bits |
//! | s11_away        | sign                                           | |
//! | s12             | what is sent, and one more that waits          | |
//!
//! Example: X = Y = 0 and nz < 0, a normal towards the eye -> 0.

use crate::pipeline::{Flow, Product2x1, Product2x2};
use crate::prelude::*;

/// Facing.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Facing {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_normal: Input<Lanes<3, 32>>,
    pub in_x: Input<S<32>>,
    pub in_y: Input<S<32>>,
    pub in_focal: Input<U<32>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_away: Output<Bit>,
    s1_normal: DataRegister<Lanes<3, 32>>,
    s1_x: DataRegister<S<18>>,
    s1_y: DataRegister<S<18>>,
    s1_focal: DataRegister<S<21>>,
    along_x: Product2x1<32, 50>,
    along_y: Product2x1<32, 50>,
    along_z: Product2x2<32, 21, 53>,
    /// The lower 27 bits and their carry.
    s7_low: DataRegister<U<28>>,
    s7_high_x: DataRegister<S<25>>,
    s7_high_y: DataRegister<S<25>>,
    s8_low: DataRegister<U<27>>,
    s8_high: DataRegister<S<25>>,
    s8_z: DataRegister<WideS<53>>,
    s9_low: DataRegister<U<28>>,
    s9_high: DataRegister<S<28>>,
    s9_high_z: DataRegister<S<28>>,
    s10_high: DataRegister<S<28>>,
    s11_away: DataRegister<Bit>,
    flow: Flow<{ Facing::STAGES }, 1>,
    normal_x: Wire<S<32>>,
    normal_y: Wire<S<32>>,
    normal_z: Wire<S<32>>,
}

impl Facing {
    const STAGES: usize = 5 + Product2x2::<32, 21, 53>::LATENCY;
    /// Cycles from vertex to answer.
    pub const LATENCY: usize = Self::STAGES + 1;
}

impl Logic for Facing {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, along_x, along_y, along_z, flow);
        dff_setup!(self, clock, s1_normal, s1_x, s1_y, s1_focal, s7_low, s7_high_x, s7_high_y, s8_low, s8_high, s8_z);
        dff_setup!(self, clock, s9_low, s9_high, s9_high_z, s10_high, s11_away);
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.flow.go.val();
        self.normal_x.next = self.s1_normal.q.val().get_bit(0);
        self.normal_y.next = self.s1_normal.q.val().get_bit(1);
        self.normal_z.next = self.s1_normal.q.val().get_bit(2);
        self.along_x.go.next = self.flow.go.val();
        self.along_x.a.next = self.normal_x.val();
        self.along_x.b.next = self.s1_x.q.val();
        self.along_y.go.next = self.flow.go.val();
        self.along_y.a.next = self.normal_y.val();
        self.along_y.b.next = self.s1_y.q.val();
        self.along_z.go.next = self.flow.go.val();
        self.along_z.a.next = self.normal_z.val();
        self.along_z.b.next = self.s1_focal.q.val();
        if self.flow.go.val() {
            self.s1_normal.d.next = self.in_normal.val();
            self.s1_x.d.next = bit_cast_to::<S<18>>(self.in_x.val() >> 14);
            self.s1_y.d.next = bit_cast_to::<S<18>>(self.in_y.val() >> 14);
            self.s1_focal.d.next = bit_cast_to::<S<21>>(self.in_focal.val().get_bits::<20>(12));
            self.s7_low.d.next = bit_cast_to::<U<28>>(self.along_x.p.val().get_bits::<27>(0))
                + bit_cast_to::<U<28>>(self.along_y.p.val().get_bits::<27>(0));
            self.s7_high_x.d.next = bit_cast_to::<S<25>>(self.along_x.p.val() >> 27);
            self.s7_high_y.d.next = bit_cast_to::<S<25>>(self.along_y.p.val() >> 27);
            self.s8_low.d.next = self.s7_low.q.val().get_bits::<27>(0);
            self.s8_high.d.next = self.s7_high_x.q.val()
                + self.s7_high_y.q.val()
                + bit_cast_to::<S<25>>(self.s7_low.q.val().get_bits::<1>(27));
            self.s8_z.d.next = self.along_z.p.val();
            self.s9_low.d.next =
                bit_cast_to::<U<28>>(self.s8_low.q.val()) + bit_cast_to::<U<28>>(self.s8_z.q.val().get_bits::<27>(0));
            self.s9_high.d.next = bit_cast_to::<S<28>>(self.s8_high.q.val());
            self.s9_high_z.d.next = bit_cast_to::<S<28>>(self.s8_z.q.val() >> 27);
            self.s10_high.d.next = self.s9_high.q.val()
                + self.s9_high_z.q.val()
                + bit_cast_to::<S<28>>(self.s9_low.q.val().get_bits::<1>(27));
            self.s11_away.d.next = !self.s10_high.q.val().get_bit(27);
        }
        self.flow.value.next = bit_cast_to::<WideU<1>>(self.s11_away.q.val());
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_away.next = self.flow.out_value.val().get_bit(0);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("facing")
    }
}

ports! {
    [] Facing {
        inputs: in_valid, in_normal, in_x, in_y, in_focal, out_ready;
        outputs: in_ready, out_valid, out_away;
        blocks: along_x, along_y, along_z, flow;
        state: s1_normal, s1_x, s1_y, s1_focal, along_x, along_y, along_z, s7_low, s7_high_x, s7_high_y, s8_low, s8_high, s8_z, s9_low, s9_high, s9_high_z, s10_high, s11_away, flow
    }
}
