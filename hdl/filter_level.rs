// SPDX-License-Identifier: MIT OR Apache-2.0
//! Filter level of a vertex: the footprint of its voxel on the map, and how many thresholds it reaches.
//!
//! ```text
//! F = (rho c) / c / c 2^-shift scale        k = number of thresholds sqrt(2) 2^i that are <= F
//! level = max(0, k - 1), at most the last
//! ```
//!
//! | port          | format     | meaning |   Latency 65, interval 1
//! | in_density    | SQ0.31     | lane rho c, of 1024 density units; below 0 counts as 0
//! | in_c          | SQ0.31     | lane c; below 1 unit counts as 1 unit
//! | in_scale, in_shift | unsigned 24, 6 | z0 s cell in density units: scale 2^-shift
//! | in_levels     | unsigned 5 | levels of the map, at least 1
//! | out_level     | unsigned 4 | below `levels`   Golden: models::filter_level::golden
//! | out_footprint | UQ16.16    | F, saturates   Golden: models::filter_level::footprint
//!
//! The constants of the draw travel with the vertex, so a result is a function of its beat.
//!
//! | stage           | operation                               | width |
//! | s1 .. s22       | lanes to at least 0 and 1; reciprocal of c | UQ0.32 |
//! | s23 .. s31      | rho c times reciprocal, shifted by 53 - zeros | 57 bits |
//! | s32_density     | A = rho                                 | saturates at 38 bits: c is below 2^20 then, and A / c has 49 |
//! | s33 .. s43      | A times reciprocal, shifted by 48 - zeros | 70 bits |
//! | s44_over_c      | B = rho / c                             | saturates at 48 bits |
//! | s45 .. s55      | B scale, shifted by `shift`             | 72 bits |
//! | s56_footprint   | F                                       | saturates at 32 bits |
//! | s57 .. s64_level | k - 1, at most the last, [`Level`]     | 0 ..= 15 |
//!
//! Example: rho = 200, z s cell = 0.01: F = 2.0, k = 1, level 0; at F = 3.0, k = 2 and level 1.

mod level;

pub use level::Level;

use crate::pipeline::{Delay, Flow, LongDelay, Product2x2, Product3x2, ShiftRight};
use crate::prelude::*;
use crate::reciprocal::Inverse;

/// Filter level.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct FilterLevel {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_density: Input<S<32>>,
    pub in_c: Input<S<32>>,
    pub in_scale: Input<U<24>>,
    pub in_shift: Input<U<6>>,
    pub in_levels: Input<U<5>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_level: Output<U<4>>,
    pub out_footprint: Output<U<32>>,
    /// 1 / c, from s1 to s22.
    inverse: Inverse,
    s1_lane: DataRegister<U<31>>,
    s1_scale: DataRegister<U<24>>,
    s1_shift: DataRegister<U<6>>,
    s1_last: DataRegister<U<5>>,
    s22_lane: LongDelay<31, 7, 7, 7>,
    s28_density: Product2x2<32, 33, 64>,
    s28_amount: Delay<6, 6>,
    s31_density: ShiftRight<64>,
    s32_density: DataRegister<U<38>>,
    s32_reciprocal: Delay<32, 10>,
    s40_over_c: Product3x2<39, 33, 72>,
    s40_amount: LongDelay<6, 6, 6, 6>,
    s43_over_c: ShiftRight<72>,
    s44_over_c: DataRegister<U<48>>,
    s44_scale: LongDelay<24, 13, 15, 15>,
    s52_footprint: Product3x2<49, 25, 74>,
    s52_shift: LongDelay<6, 17, 17, 17>,
    s55_footprint: ShiftRight<74>,
    s56_footprint: DataRegister<U<32>>,
    s18_last: Delay<5, 17>,
    s63_last: LongDelay<5, 15, 15, 15>,
    s64_level: Level,
    s64_footprint: Delay<32, 8>,
    flow: Flow<{ FilterLevel::STAGES }, 36>,
    go: Wire<Bit>,
    most_density: Constant<U<38>>,
    most_over_c: Constant<U<48>>,
    most_footprint: Constant<U<32>>,
}

impl Default for FilterLevel {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_density: Input::default(),
            in_c: Input::default(),
            in_scale: Input::default(),
            in_shift: Input::default(),
            in_levels: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_level: Output::default(),
            out_footprint: Output::default(),
            inverse: Inverse::default(),
            s1_lane: DataRegister::default(),
            s1_scale: DataRegister::default(),
            s1_shift: DataRegister::default(),
            s1_last: DataRegister::default(),
            s22_lane: LongDelay::default(),
            s28_density: Product2x2::default(),
            s28_amount: Delay::default(),
            s31_density: ShiftRight::default(),
            s32_density: DataRegister::default(),
            s32_reciprocal: Delay::default(),
            s40_over_c: Product3x2::default(),
            s40_amount: LongDelay::default(),
            s43_over_c: ShiftRight::default(),
            s44_over_c: DataRegister::default(),
            s44_scale: LongDelay::default(),
            s52_footprint: Product3x2::default(),
            s52_shift: LongDelay::default(),
            s55_footprint: ShiftRight::default(),
            s56_footprint: DataRegister::default(),
            s18_last: Delay::default(),
            s63_last: LongDelay::default(),
            s64_level: Level::default(),
            s64_footprint: Delay::default(),
            flow: Flow::default(),
            go: Wire::default(),
            most_density: Constant::new(U::MAX),
            most_over_c: Constant::new(U::MAX),
            most_footprint: Constant::new(U::MAX),
        }
    }
}

impl FilterLevel {
    const STAGES: usize = 64;
    /// Cycles from vertex to level.
    pub const LATENCY: usize = Self::STAGES + 1;
}

impl Logic for FilterLevel {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, inverse, s22_lane, s28_density, s28_amount, s31_density, s32_reciprocal, s40_over_c);
        clock!(self, clock, s40_amount, s43_over_c, s44_scale, s52_footprint, s52_shift, s55_footprint, s18_last);
        clock!(self, clock, s63_last, s64_level, s64_footprint, flow);
        dff_setup!(self, clock, s1_lane, s1_scale, s1_shift, s1_last, s32_density, s44_over_c, s56_footprint);
        self.go.next = self.flow.go.val();
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.go.val();
        self.inverse.go.next = self.go.val();
        self.inverse.c.next = self.in_c.val();
        self.s22_lane.go.next = self.go.val();
        self.s22_lane.value.next = self.s1_lane.q.val();

        // A
        self.s28_density.go.next = self.go.val();
        self.s28_density.a.next = bit_cast_to::<S<32>>(self.s22_lane.delayed.val());
        self.s28_density.b.next = bit_cast_to::<S<33>>(self.inverse.reciprocal.val());
        self.s28_amount.go.next = self.go.val();
        self.s28_amount.value.next = !self.inverse.zeros.val() - 10;
        self.s31_density.go.next = self.go.val();
        self.s31_density.value.next = self.s28_density.p.val();
        self.s31_density.amount.next = self.s28_amount.delayed.val();
        self.s32_reciprocal.go.next = self.go.val();
        self.s32_reciprocal.value.next = self.inverse.reciprocal.val();

        // B
        self.s40_over_c.go.next = self.go.val();
        self.s40_over_c.a.next = bit_cast_to::<S<39>>(self.s32_density.q.val());
        self.s40_over_c.b.next = bit_cast_to::<S<33>>(self.s32_reciprocal.delayed.val());
        self.s40_amount.go.next = self.go.val();
        self.s40_amount.value.next = !self.inverse.zeros.val() - 15;
        self.s43_over_c.go.next = self.go.val();
        self.s43_over_c.value.next = self.s40_over_c.p.val();
        self.s43_over_c.amount.next = self.s40_amount.delayed.val();
        self.s44_scale.go.next = self.go.val();
        self.s44_scale.value.next = self.s1_scale.q.val();

        // F
        self.s52_footprint.go.next = self.go.val();
        self.s52_footprint.a.next = bit_cast_to::<S<49>>(self.s44_over_c.q.val());
        self.s52_footprint.b.next = bit_cast_to::<S<25>>(self.s44_scale.delayed.val());
        self.s52_shift.go.next = self.go.val();
        self.s52_shift.value.next = self.s1_shift.q.val();
        self.s55_footprint.go.next = self.go.val();
        self.s55_footprint.value.next = self.s52_footprint.p.val();
        self.s55_footprint.amount.next = self.s52_shift.delayed.val();

        // The level
        self.s64_level.go.next = self.go.val();
        self.s64_level.footprint.next = self.s56_footprint.q.val();
        self.s64_level.last.next = self.s63_last.delayed.val();
        self.s63_last.go.next = self.go.val();
        self.s63_last.value.next = self.s18_last.delayed.val();
        self.s18_last.go.next = self.go.val();
        self.s18_last.value.next = self.s1_last.q.val();
        self.s64_footprint.go.next = self.go.val();
        self.s64_footprint.value.next = self.s56_footprint.q.val();

        if self.go.val() {
            self.s1_lane.d.next = bit_cast_to::<U<31>>(self.in_density.val());
            if self.in_density.val() < 0 {
                self.s1_lane.d.next = 0.into();
            }
            self.s1_scale.d.next = self.in_scale.val();
            self.s1_shift.d.next = self.in_shift.val();
            self.s1_last.d.next = self.in_levels.val() - 1;
            self.s32_density.d.next = self.s31_density.shifted.val().get_bits::<38>(0);
            if self.s31_density.shifted.val().get_bits::<26>(38).any() {
                self.s32_density.d.next = self.most_density.val();
            }
            self.s44_over_c.d.next = self.s43_over_c.shifted.val().get_bits::<48>(0);
            if self.s43_over_c.shifted.val().get_bits::<24>(48).any() {
                self.s44_over_c.d.next = self.most_over_c.val();
            }
            self.s56_footprint.d.next = self.s55_footprint.shifted.val().get_bits::<32>(0);
            if self.s55_footprint.shifted.val().get_bits::<42>(32).any() {
                self.s56_footprint.d.next = self.most_footprint.val();
            }
        }

        self.flow.value.next = bit_cast_to::<WideU<36>>(self.s64_level.level.val())
            | (bit_cast_to::<WideU<36>>(self.s64_footprint.delayed.val()) << 4);
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_level.next = self.flow.out_value.val().get_bits::<4>(0);
        self.out_footprint.next = self.flow.out_value.val().get_bits::<32>(4);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("filter_level")
    }
}

ports! {
    [] FilterLevel {
        inputs: in_valid, in_density, in_c, in_scale, in_shift, in_levels, out_ready;
        outputs: in_ready, out_valid, out_level, out_footprint;
        blocks: inverse, s22_lane, s28_density, s28_amount, s31_density, s32_reciprocal, s40_over_c, s40_amount, s43_over_c, s44_scale, s52_footprint, s52_shift, s55_footprint, s18_last, s63_last, s64_level, s64_footprint, flow;
        state: inverse, s1_lane, s1_scale, s1_shift, s1_last, s22_lane, s28_density, s28_amount, s31_density, s32_density, s32_reciprocal, s40_over_c, s40_amount, s43_over_c, s44_over_c, s44_scale, s52_footprint, s52_shift, s55_footprint, s56_footprint, s18_last, s63_last, s64_level, s64_footprint, flow
    }
}
