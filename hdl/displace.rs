// SPDX-License-Identifier: MIT OR Apache-2.0
//! Displaces a vertex along its normal, in projective form.
//!
//! ```text
//! delta = d / z      den = 1 + delta nz      X' = (X + f delta nx) / den      Y' likewise      c' = c / den
//! ```
//!
//! | port        | format        | meaning |   Latency 89, interval 1
//! | in_vertex   | 6 x signed 32 | X, Y, c, nx c, ny c, nz c, as the remesher sends them
//! | in_q        | UQ16.8        | height; above 65535.0 counts as that
//! | in_minimum  | SQ1.30        | displacement of height 0, of 2^exponent z0; magnitude at most 2^30
//! | in_range    | signed 26     | displacement of the full range over 65535, 2^-8 of that unit; magnitude at most 2^24
//! | in_exponent | signed 6      | -30 ..= 15
//! | in_focal    | UQ16.16       | focal length, pixels
//! | out_vertex  | 5 x signed 32 | X', Y' SQ13.8 pixels; c' UQ0.31; flags; q
//!
//! Flags: 1 behind the eye, 2 nearer than z0, 4 beyond 8192 pixels; X', Y' and c' are 0 then. The constants of the draw travel
//! with the vertex, so a result is a function of its beat. Golden: models::displace::golden.
//!
//! | stage              | operation                                    | part |
//! | s1                 | the input                                    | |
//! | s2 .. s18          | displacement d, delta, which saturates       | [`Delta`] |
//! | s2 .. s44          | normal of length 1                           | [`Normalize`] |
//! | s45 .. s51, s52, s53 | den; delta times normal for Y, for X       | [`Along`] |
//! | s52 .. s72         | its reciprocal                               | [`Leading`], [`Newton`] |
//! | s53 .. s86, s54 .. s87 | Y', X'                                   | [`Project`], twice |
//! | s73 .. s85         | c'                                           | [`Nearness`] |
//! | s88                | flags, and what is 0 with one                | |
//!
//! Example: height of no displacement: den = 1.0, X' = X rounded to 1/256 pixel, c' at most 2 units below c.

mod along;
mod delta;
mod nearness;
mod project;

pub use along::Along;
pub use delta::Delta;
pub use nearness::Nearness;
pub use project::Project;

use crate::pipeline::{Delay, Flow, Leading, LongDelay};
use crate::prelude::*;
use crate::reciprocal::Newton;
use crate::rsqrt::Normalize;

/// Displacement.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Displace {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_vertex: Input<Lanes<6, 32>>,
    pub in_q: Input<U<24>>,
    pub in_minimum: Input<S<32>>,
    pub in_range: Input<S<26>>,
    pub in_exponent: Input<S<6>>,
    pub in_focal: Input<U<32>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_vertex: Output<Lanes<5, 32>>,
    s1_x: DataRegister<U<32>>,
    s1_y: DataRegister<U<32>>,
    s1_c: DataRegister<U<31>>,
    s1_normal: DataRegister<Lanes<3, 32>>,
    s1_q: DataRegister<U<24>>,
    s1_minimum: DataRegister<S<32>>,
    s1_range: DataRegister<S<26>>,
    s1_exponent: DataRegister<S<6>>,
    s1_focal: DataRegister<U<32>>,
    delta: Delta,
    s44_delta: LongDelay<44, 6, 10, 10>,
    normalize: Normalize,
    along: Along,
    leading: Leading,
    newton: Newton,
    s72_zeros: Delay<6, { Newton::LATENCY }>,
    s51_focal: LongDelay<32, 16, 17, 17>,
    s52_focal: DataRegister<U<32>>,
    s53_focal: DataRegister<U<32>>,
    s73_reciprocal: DataRegister<U<32>>,
    s74_reciprocal: DataRegister<U<32>>,
    s73_zeros: DataRegister<U<6>>,
    s74_zeros: DataRegister<U<6>>,
    s18_x: Delay<32, 17>,
    s18_y: Delay<32, 17>,
    s61_x: LongDelay<32, 14, 14, 15>,
    s60_y: LongDelay<32, 14, 14, 14>,
    project_x: Project,
    project_y: Project,
    s31_c: LongDelay<31, 10, 10, 10>,
    s72_c: LongDelay<31, 13, 14, 14>,
    nearness: Nearness,
    s52_behind: DataRegister<Bit>,
    s87_behind: LongDelay<1, 9, 13, 13>,
    s40_q: LongDelay<24, 13, 13, 13>,
    s87_q: LongDelay<24, 15, 16, 16>,
    s86_near: DataRegister<Bit>,
    s87_near: DataRegister<Bit>,
    s86_c: DataRegister<U<31>>,
    s87_c: DataRegister<U<31>>,
    s87_y: DataRegister<S<22>>,
    s87_beyond_y: DataRegister<Bit>,
    s88_vertex: DataRegister<WideU<75>>,
    s88_flags: DataRegister<U<3>>,
    s88_q: DataRegister<U<24>>,
    flow: Flow<{ Displace::STAGES }, 102>,
    go: Wire<Bit>,
    lane_x: Wire<S<32>>,
    lane_y: Wire<S<32>>,
    lane_c: Wire<S<32>>,
    normal_x: Wire<S<32>>,
    normal_y: Wire<S<32>>,
    normal_z: Wire<S<32>>,
    normal_1: Wire<Lanes<3, 32>>,
    normal_2: Wire<Lanes<3, 32>>,
    normal: Wire<Lanes<3, 32>>,
    positive: Wire<U<31>>,
    behind: Wire<Bit>,
    beyond: Wire<Bit>,
    out_x: Wire<S<22>>,
    out_y: Wire<S<22>>,
    out_c: Wire<S<32>>,
    out_flags: Wire<S<32>>,
    out_q: Wire<S<32>>,
    vertex_1: Wire<Lanes<5, 32>>,
    vertex_2: Wire<Lanes<5, 32>>,
    vertex_3: Wire<Lanes<5, 32>>,
    vertex_4: Wire<Lanes<5, 32>>,
    most_q: Constant<U<24>>,
}

impl Default for Displace {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_vertex: Input::default(),
            in_q: Input::default(),
            in_minimum: Input::default(),
            in_range: Input::default(),
            in_exponent: Input::default(),
            in_focal: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_vertex: Output::default(),
            s1_x: DataRegister::default(),
            s1_y: DataRegister::default(),
            s1_c: DataRegister::default(),
            s1_normal: DataRegister::default(),
            s1_q: DataRegister::default(),
            s1_minimum: DataRegister::default(),
            s1_range: DataRegister::default(),
            s1_exponent: DataRegister::default(),
            s1_focal: DataRegister::default(),
            delta: Delta::default(),
            s44_delta: LongDelay::default(),
            normalize: Normalize::default(),
            along: Along::default(),
            leading: Leading::default(),
            newton: Newton::default(),
            s72_zeros: Delay::default(),
            s51_focal: LongDelay::default(),
            s52_focal: DataRegister::default(),
            s53_focal: DataRegister::default(),
            s73_reciprocal: DataRegister::default(),
            s74_reciprocal: DataRegister::default(),
            s73_zeros: DataRegister::default(),
            s74_zeros: DataRegister::default(),
            s18_x: Delay::default(),
            s18_y: Delay::default(),
            s61_x: LongDelay::default(),
            s60_y: LongDelay::default(),
            project_x: Project::default(),
            project_y: Project::default(),
            s31_c: LongDelay::default(),
            s72_c: LongDelay::default(),
            nearness: Nearness::default(),
            s52_behind: DataRegister::default(),
            s87_behind: LongDelay::default(),
            s40_q: LongDelay::default(),
            s87_q: LongDelay::default(),
            s86_near: DataRegister::default(),
            s87_near: DataRegister::default(),
            s86_c: DataRegister::default(),
            s87_c: DataRegister::default(),
            s87_y: DataRegister::default(),
            s87_beyond_y: DataRegister::default(),
            s88_vertex: DataRegister::default(),
            s88_flags: DataRegister::default(),
            s88_q: DataRegister::default(),
            flow: Flow::default(),
            go: Wire::default(),
            lane_x: Wire::default(),
            lane_y: Wire::default(),
            lane_c: Wire::default(),
            normal_x: Wire::default(),
            normal_y: Wire::default(),
            normal_z: Wire::default(),
            normal_1: Wire::default(),
            normal_2: Wire::default(),
            normal: Wire::default(),
            positive: Wire::default(),
            behind: Wire::default(),
            beyond: Wire::default(),
            out_x: Wire::default(),
            out_y: Wire::default(),
            out_c: Wire::default(),
            out_flags: Wire::default(),
            out_q: Wire::default(),
            vertex_1: Wire::default(),
            vertex_2: Wire::default(),
            vertex_3: Wire::default(),
            vertex_4: Wire::default(),
            most_q: Constant::new(U::new(65535 << 8)),
        }
    }
}

impl Displace {
    const STAGES: usize = 88;
    /// Cycles from vertex to displaced vertex.
    pub const LATENCY: usize = Self::STAGES + 1;
}

impl Logic for Displace {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self, clock, delta, s44_delta, normalize, along, leading, newton, s72_zeros, s51_focal, s18_x, s18_y,
            s61_x, s60_y
        );
        clock!(self, clock, project_x, project_y, s31_c, s72_c, nearness, s87_behind, s40_q, s87_q, flow);
        dff_setup!(self, clock, s1_x, s1_y, s1_c, s1_normal, s1_q, s1_minimum, s1_range, s1_exponent, s1_focal);
        dff_setup!(self, clock, s52_behind, s52_focal, s53_focal, s73_reciprocal, s74_reciprocal, s73_zeros, s74_zeros);
        dff_setup!(self, clock, s86_near, s87_near, s86_c, s87_c, s87_y, s87_beyond_y, s88_vertex, s88_flags, s88_q);
        self.go.next = self.flow.go.val();
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.go.val();

        // s1
        self.lane_x.next = self.in_vertex.val().get_bit(0);
        self.lane_y.next = self.in_vertex.val().get_bit(1);
        self.lane_c.next = self.in_vertex.val().get_bit(2);
        self.normal_x.next = self.in_vertex.val().get_bit(3);
        self.normal_y.next = self.in_vertex.val().get_bit(4);
        self.normal_z.next = self.in_vertex.val().get_bit(5);
        self.normal_1.next = bit_cast_to::<Lanes<3, 32>>(self.normal_x.val());
        self.normal_2.next = self.normal_1.val().replace_bit(1, self.normal_y.val());
        self.normal.next = self.normal_2.val().replace_bit(2, self.normal_z.val());
        self.positive.next = bit_cast_to::<U<31>>(self.lane_c.val());
        if self.lane_c.val() < 1 {
            self.positive.next = 1.into();
        }
        if self.go.val() {
            self.s1_x.d.next = bit_cast_to::<U<32>>(self.lane_x.val());
            self.s1_y.d.next = bit_cast_to::<U<32>>(self.lane_y.val());
            self.s1_c.d.next = self.positive.val();
            self.s1_normal.d.next = self.normal.val();
            self.s1_q.d.next = self.in_q.val();
            if self.in_q.val() > self.most_q.val() {
                self.s1_q.d.next = self.most_q.val();
            }
            self.s1_minimum.d.next = self.in_minimum.val();
            self.s1_range.d.next = self.in_range.val();
            self.s1_exponent.d.next = self.in_exponent.val();
            self.s1_focal.d.next = self.in_focal.val();
        }

        // s2 to s51
        self.delta.go.next = self.go.val();
        self.delta.q.next = self.s1_q.q.val();
        self.delta.c.next = self.s1_c.q.val();
        self.delta.minimum.next = self.s1_minimum.q.val();
        self.delta.range.next = self.s1_range.q.val();
        self.delta.exponent.next = self.s1_exponent.q.val();
        self.s44_delta.go.next = self.go.val();
        self.s44_delta.value.next = bit_cast_to::<U<44>>(self.delta.over_z.val());
        self.normalize.go.next = self.go.val();
        self.normalize.components.next = self.s1_normal.q.val();
        self.along.go.next = self.go.val();
        self.along.delta.next = bit_cast_to::<S<44>>(self.s44_delta.delayed.val());
        self.along.normal.next = self.normalize.unit.val();

        // s52 to s72: what stands behind the eye has a reciprocal, too, of which nothing comes.
        self.leading.go.next = self.go.val();
        self.leading.value.next = bit_cast_to::<U<48>>(self.along.den.val());
        self.newton.go.next = self.go.val();
        self.newton.m.next = self.leading.mantissa.val();
        self.s72_zeros.go.next = self.go.val();
        self.s72_zeros.value.next = self.leading.zeros.val();
        // 2^-8
        self.behind.next = self.along.den.val() <= 0x10_0000;
        self.s87_behind.go.next = self.go.val();
        self.s87_behind.value.next = bit_cast_to::<U<1>>(self.s52_behind.q.val());

        // s52 to s87: Y a cycle behind c, and X behind Y, so that no register feeds multipliers that lie apart.
        self.s51_focal.go.next = self.go.val();
        self.s51_focal.value.next = self.s1_focal.q.val();
        self.s61_x.go.next = self.go.val();
        self.s61_x.value.next = self.s18_x.delayed.val();
        self.s18_x.go.next = self.go.val();
        self.s18_x.value.next = self.s1_x.q.val();
        self.s60_y.go.next = self.go.val();
        self.s60_y.value.next = self.s18_y.delayed.val();
        self.s18_y.go.next = self.go.val();
        self.s18_y.value.next = self.s1_y.q.val();
        self.s72_c.go.next = self.go.val();
        self.s72_c.value.next = self.s31_c.delayed.val();
        self.s31_c.go.next = self.go.val();
        self.s31_c.value.next = self.s1_c.q.val();
        self.project_x.go.next = self.go.val();
        self.project_x.displacement.next = self.along.along_x.val();
        self.project_x.focal.next = self.s53_focal.q.val();
        self.project_x.position.next = self.s61_x.delayed.val();
        self.project_x.reciprocal.next = self.s74_reciprocal.q.val();
        self.project_x.zeros.next = self.s74_zeros.q.val();
        self.project_y.go.next = self.go.val();
        self.project_y.displacement.next = self.along.along_y.val();
        self.project_y.focal.next = self.s52_focal.q.val();
        self.project_y.position.next = self.s60_y.delayed.val();
        self.project_y.reciprocal.next = self.s73_reciprocal.q.val();
        self.project_y.zeros.next = self.s73_zeros.q.val();
        self.nearness.go.next = self.go.val();
        self.nearness.c.next = self.s72_c.delayed.val();
        self.nearness.reciprocal.next = self.newton.reciprocal.val();
        self.nearness.zeros.next = self.s72_zeros.delayed.val();
        self.s40_q.go.next = self.go.val();
        self.s40_q.value.next = self.s1_q.q.val();
        self.s87_q.go.next = self.go.val();
        self.s87_q.value.next = self.s40_q.delayed.val();

        // s88: c is there at s85, Y at s86, X at s87.
        self.beyond.next = self.project_x.beyond.val() || self.s87_beyond_y.q.val();
        if self.go.val() {
            self.s52_behind.d.next = self.behind.val();
            self.s52_focal.d.next = self.s51_focal.delayed.val();
            self.s53_focal.d.next = self.s52_focal.q.val();
            self.s73_reciprocal.d.next = self.newton.reciprocal.val();
            self.s74_reciprocal.d.next = self.s73_reciprocal.q.val();
            self.s73_zeros.d.next = self.s72_zeros.delayed.val();
            self.s74_zeros.d.next = self.s73_zeros.q.val();
            self.s86_near.d.next = self.nearness.near.val();
            self.s87_near.d.next = self.s86_near.q.val();
            self.s86_c.d.next = self.nearness.moved.val();
            self.s87_c.d.next = self.s86_c.q.val();
            self.s87_y.d.next = self.project_y.pixel.val();
            self.s87_beyond_y.d.next = self.project_y.beyond.val();
            self.s88_q.d.next = self.s87_q.delayed.val();
            self.s88_vertex.d.next = 0.into();
            if self.s87_behind.delayed.val().any() {
                self.s88_flags.d.next = 1.into();
            } else if self.s87_near.q.val() {
                self.s88_flags.d.next = 2.into();
            } else if self.beyond.val() {
                self.s88_flags.d.next = 4.into();
            } else {
                self.s88_flags.d.next = 0.into();
                self.s88_vertex.d.next = bit_cast_to::<WideU<75>>(bit_cast_to::<U<22>>(self.project_x.pixel.val()))
                    | (bit_cast_to::<WideU<75>>(bit_cast_to::<U<22>>(self.s87_y.q.val())) << 22)
                    | (bit_cast_to::<WideU<75>>(self.s87_c.q.val()) << 44);
            }
        }

        self.flow.value.next = bit_cast_to::<WideU<102>>(self.s88_vertex.q.val())
            | (bit_cast_to::<WideU<102>>(self.s88_flags.q.val()) << 75)
            | (bit_cast_to::<WideU<102>>(self.s88_q.q.val()) << 78);
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_x.next = bit_cast_to::<S<22>>(self.flow.out_value.val().get_bits::<22>(0));
        self.out_y.next = bit_cast_to::<S<22>>(self.flow.out_value.val().get_bits::<22>(22));
        self.out_c.next = bit_cast_to::<S<32>>(self.flow.out_value.val().get_bits::<31>(44));
        self.out_flags.next = bit_cast_to::<S<32>>(self.flow.out_value.val().get_bits::<3>(75));
        self.out_q.next = bit_cast_to::<S<32>>(self.flow.out_value.val().get_bits::<24>(78));
        self.vertex_1.next = bit_cast_to::<Lanes<5, 32>>(self.out_x.val());
        self.vertex_2.next = self.vertex_1.val().replace_bit(1, bit_cast_to::<S<32>>(self.out_y.val()));
        self.vertex_3.next = self.vertex_2.val().replace_bit(2, self.out_c.val());
        self.vertex_4.next = self.vertex_3.val().replace_bit(3, self.out_flags.val());
        self.out_vertex.next = self.vertex_4.val().replace_bit(4, self.out_q.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("displace")
    }
}

ports! {
    [] Displace {
        inputs: in_valid, in_vertex, in_q, in_minimum, in_range, in_exponent, in_focal, out_ready;
        outputs: in_ready, out_valid, out_vertex;
        blocks: delta, s44_delta, normalize, along, leading, newton, s72_zeros, s51_focal, s18_x, s18_y, s61_x, s60_y, project_x, project_y, s31_c, s72_c, nearness, s87_behind, s40_q, s87_q, flow;
        state: s52_focal, s53_focal, s73_reciprocal, s74_reciprocal, s73_zeros, s74_zeros, s86_near, s87_near, s86_c, s87_c, s87_y, s87_beyond_y, s1_x, s1_y, s1_c, s1_normal, s1_q, s1_minimum, s1_range, s1_exponent, s1_focal, delta, s44_delta, normalize, along, leading, newton, s72_zeros, s51_focal, s18_x, s18_y, s61_x, s60_y, project_x, project_y, s31_c, s72_c, nearness, s52_behind, s87_behind, s40_q, s87_q, s88_vertex, s88_flags, s88_q, flow
    }
}
