// SPDX-License-Identifier: MIT OR Apache-2.0
//! The level of a footprint: how many thresholds sqrt(2) 2^i it reaches, less one, and at most the last.
//!
//! | stage     | operation                               | width |   Latency 8, interval 1; holds while `go` is low
//! | s1 .. s5  | leading zeros and mantissa of F         | |
//! | s6, s7_level | k - 1 of length and mantissa         | 0 ..= 15 |   Golden: models::filter_level::level
//! | s8_level  | at most the last                        | unsigned 5 |
//!
//! `footprint` comes at the beginning, `last` seven cycles later.

use crate::pipeline::Leading;
use crate::prelude::*;

/// Level of a register.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Level {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// UQ16.16.
    pub footprint: Input<U<32>>,
    /// Levels of the map, less one.
    pub last: Input<U<5>>,
    pub level: Output<U<5>>,
    s5_leading: Leading,
    s6_small: DataRegister<Bit>,
    s6_reaches: DataRegister<Bit>,
    s6_octave: DataRegister<U<5>>,
    s7_level: DataRegister<U<5>>,
    s8_level: DataRegister<U<5>>,
    /// ceil(sqrt(2) 2^23).
    root_of_two: Constant<U<24>>,
}

impl Default for Level {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            footprint: Input::default(),
            last: Input::default(),
            level: Output::default(),
            s5_leading: Leading::default(),
            s6_small: DataRegister::default(),
            s6_reaches: DataRegister::default(),
            s6_octave: DataRegister::default(),
            s7_level: DataRegister::default(),
            s8_level: DataRegister::default(),
            root_of_two: Constant::new(U::new((1i64 << 47).isqrt() + 1)),
        }
    }
}

impl Level {
    /// Cycles from footprint to level.
    pub const LATENCY: usize = Leading::LATENCY + 3;
}

impl Logic for Level {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s5_leading);
        dff_setup!(self, clock, s6_small, s6_reaches, s6_octave, s7_level, s8_level);
        self.level.next = self.s8_level.q.val();
        // Of a footprint of 17 to 32 bits, 31 - zeros counts 0 to 15.
        self.s5_leading.go.next = self.go.val();
        self.s5_leading.value.next = bit_cast_to::<U<48>>(self.footprint.val());
        if self.go.val() {
            self.s6_small.d.next = self.s5_leading.zeros.val().get_bit(5);
            self.s6_octave.d.next = !bit_cast_to::<U<5>>(self.s5_leading.zeros.val());
            self.s6_reaches.d.next = self.s5_leading.mantissa.val().get_bits::<24>(8) >= self.root_of_two.val();
            self.s7_level.d.next = self.s6_octave.q.val();
            if self.s6_small.q.val() {
                self.s7_level.d.next = 0.into();
            } else if !self.s6_reaches.q.val() && self.s6_octave.q.val().any() {
                self.s7_level.d.next = self.s6_octave.q.val() - 1;
            }
            self.s8_level.d.next = self.s7_level.q.val();
            if self.s7_level.q.val() > self.last.val() {
                self.s8_level.d.next = self.last.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("level_of_footprint")
    }
}

latches! { [] Level: s5_leading, s6_small, s6_reaches, s6_octave, s7_level, s8_level }
