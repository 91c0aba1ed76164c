// SPDX-License-Identifier: MIT OR Apache-2.0
//! The mean of three heights as a place on the ramp of colours.
//!
//! `place = (h0 + h1 + h2) 0xAAAB >> 25`, a third of the sum: 16 bits of 65536.0
//!
//! | port    | format        | meaning |   Latency 7, interval 1; holds while `go` is low
//! | heights | 3 x signed 25 | UQ16.8; below 0 counts as 0, above 65535.0 as that |
//! | at      | unsigned 2    | the colour below |
//! | along   | UQ0.14        | how far to the next one |
//!
//! | stage    | operation | width |
//! | s1       | cut       | 24 bits |
//! | s2_sum   | sum       | 26 bits |
//! | s3 .. s7 | a third   | 42 bits, of which the upper 16 stay: 2^16 is not reached |

use crate::pipeline::Product2x1;
use crate::prelude::*;

/// Place on the ramp.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Height {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub heights: Input<Lanes<3, 25>>,
    pub at: Output<U<2>>,
    pub along: Output<U<14>>,
    s1_0: DataRegister<U<26>>,
    s1_1: DataRegister<U<26>>,
    s1_2: DataRegister<U<26>>,
    s2_sum: DataRegister<U<26>>,
    s7_place: Product2x1<27, 43>,
    height_0: Wire<S<25>>,
    height_1: Wire<S<25>>,
    height_2: Wire<S<25>>,
    most: Constant<S<25>>,
    third: Constant<S<18>>,
}

impl Default for Height {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            heights: Input::default(),
            at: Output::default(),
            along: Output::default(),
            s1_0: DataRegister::default(),
            s1_1: DataRegister::default(),
            s1_2: DataRegister::default(),
            s2_sum: DataRegister::default(),
            s7_place: Product2x1::default(),
            height_0: Wire::default(),
            height_1: Wire::default(),
            height_2: Wire::default(),
            most: Constant::new(S::new(65535 << 8)),
            third: Constant::new(S::new(0xaaab)),
        }
    }
}

impl Height {
    /// Cycles from heights to place.
    pub const LATENCY: usize = 7;
}

impl Logic for Height {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s7_place);
        dff_setup!(self, clock, s1_0, s1_1, s1_2, s2_sum);
        self.at.next = self.s7_place.p.val().get_bits::<2>(39);
        self.along.next = self.s7_place.p.val().get_bits::<14>(25);
        self.height_0.next = self.heights.val().get_bit(0);
        self.height_1.next = self.heights.val().get_bit(1);
        self.height_2.next = self.heights.val().get_bit(2);
        self.s7_place.go.next = self.go.val();
        self.s7_place.a.next = bit_cast_to::<S<27>>(self.s2_sum.q.val());
        self.s7_place.b.next = self.third.val();
        if self.go.val() {
            self.s1_0.d.next = bit_cast_to::<U<26>>(self.height_0.val());
            if self.height_0.val() < 0 {
                self.s1_0.d.next = 0.into();
            } else if self.height_0.val() > self.most.val() {
                self.s1_0.d.next = bit_cast_to::<U<26>>(self.most.val());
            }
            self.s1_1.d.next = bit_cast_to::<U<26>>(self.height_1.val());
            if self.height_1.val() < 0 {
                self.s1_1.d.next = 0.into();
            } else if self.height_1.val() > self.most.val() {
                self.s1_1.d.next = bit_cast_to::<U<26>>(self.most.val());
            }
            self.s1_2.d.next = bit_cast_to::<U<26>>(self.height_2.val());
            if self.height_2.val() < 0 {
                self.s1_2.d.next = 0.into();
            } else if self.height_2.val() > self.most.val() {
                self.s1_2.d.next = bit_cast_to::<U<26>>(self.most.val());
            }
            self.s2_sum.d.next = self.s1_0.q.val() + self.s1_1.q.val() + self.s1_2.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("height")
    }
}

latches! { [] Height: s7_place, s1_0, s1_1, s1_2, s2_sum }
