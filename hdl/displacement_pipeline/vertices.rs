// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps with the vertices of the base surface become steps with displaced vertices, one vertex a cycle.
//!
//! ```text
//!        .-> codes --------------------------------------------------------------.
//! step --+            .-> [perspective_correct] -> u, v -.                        +-> step
//!        |            |-> [facing] -> minima ------------|                        |
//!        '-> vertex --+-> [filter_level] -> level -------+-> [mip_fetch] -> q -.  |
//!                     '-> lanes -----------------------------------> [displace] -> vertex
//! ```
//!
//! A vertex goes on its way once there is a place for it at the end of it, so nothing on the way ever stands. One whose strips are off
//! the screen ([`super::Skip`]) does not: its step carries on which side it is, and it leaves as a place far beyond that.
//!
//! | port     | format | meaning |   Interval 1, and 2 where a step sends two vertices; golden: models::displacement_pipeline
//! | in_*     | stream | the step port; vertices of nine lanes of V bits
//! | map_*    | stream | sizes and loads of [`crate::mip_fetch`], while no vertex is on its way
//! | passes   | Bit    | the height is 0, whatever the map says
//! | minima   | Bit    | vertices that face away read minima
//! | limit, across | signed 21, Bit | of the step's piece: skipped is what has |X|, or |Y| across, of more than it, 1/4 pixel
//! | out_*    | stream | the step port; vertices X' | flags << 22 | q << 25, Y' | (q >> 9) << 22, c' | (q >> 21) << 31
//! | idle     | Bit    | nothing is on its way
//! | sends, skips | Bit | a vertex goes, or is skipped
//! | lacks_room, sends_second | Bit | a step waits for room, or for its second vertex

use crate::displace::Displace;
use crate::displacement_pipeline::lane_queue::LaneQueue;
use crate::facing::Facing;
use crate::filter_level::FilterLevel;
use crate::mip_fetch::MipFetch;
use crate::perspective_correct::PerspectiveCorrect;
use crate::prelude::*;

/// Displacement of steps, for lanes of `V` bits and a map memory of `M` and `A` (see [`MipFetch`]).
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Vertices<const V: usize, const M: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_left: Input<U<2>>,
    pub in_right: Input<U<2>>,
    pub in_swap: Input<Bit>,
    pub in_last: Input<Bit>,
    pub in_left_vertex: Input<Lanes<9, V>>,
    pub in_right_vertex: Input<Lanes<9, V>>,
    pub map_valid: Input<Bit>,
    pub map_ready: Output<Bit>,
    pub map_loads: Input<Bit>,
    pub map_minima: Input<Bit>,
    pub map_level: Input<U<4>>,
    pub map_i: Input<U<M>>,
    pub map_j: Input<U<M>>,
    pub map_value: Input<U<16>>,
    pub map_base: Input<U<A>>,
    pub map_minima_base: Input<U<A>>,
    pub map_pitch: Input<U<M>>,
    pub map_repeat_u: Input<Bit>,
    pub map_repeat_v: Input<Bit>,
    pub passes: Input<Bit>,
    pub minima: Input<Bit>,
    pub limit: Input<S<21>>,
    pub across: Input<Bit>,
    pub axis_u: Input<U<19>>,
    pub axis_v: Input<U<19>>,
    pub level: Input<U<35>>,
    pub minimum: Input<S<32>>,
    pub range: Input<S<26>>,
    pub exponent: Input<S<6>>,
    pub focal: Input<U<32>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_kind: Output<U<2>>,
    pub out_left: Output<U<2>>,
    pub out_right: Output<U<2>>,
    pub out_swap: Output<Bit>,
    pub out_last: Output<Bit>,
    pub out_left_vertex: Output<Lanes<3, 34>>,
    pub out_right_vertex: Output<Lanes<3, 34>>,
    pub idle: Output<Bit>,
    pub sends: Output<Bit>,
    pub skips: Output<Bit>,
    pub lacks_room: Output<Bit>,
    pub sends_second: Output<Bit>,
    pub error: Output<Bit>,
    /// Vertices and steps on their way, and whether there is room for one more.
    vertices: Register<U<9>>,
    steps: Register<U<9>>,
    room: Register<Bit>,
    /// The left vertex of the step at the input has gone.
    second: Register<Bit>,
    s1_valid: Register<Bit>,
    s1_vertex: DataRegister<Lanes<9, V>>,
    s1_limit: DataRegister<S<21>>,
    s1_across: DataRegister<Bit>,
    /// The step has been accepted; it sends both, or the left one alone.
    s1_step: Register<Bit>,
    s1_code: DataRegister<S<13>>,
    s1_both: DataRegister<Bit>,
    s1_left: DataRegister<Bit>,
    /// The left vertex of a step that sends both was skipped, and on which side.
    left_skips: DataRegister<Bit>,
    left_minus: DataRegister<Bit>,
    codes: Gated<LaneQueue<1, 13, 8>>,
    perspective_correct: Gated<PerspectiveCorrect>,
    filter_level: Gated<FilterLevel>,
    facing: Gated<Facing>,
    aways: Gated<LaneQueue<1, 2, 6>>,
    texels: Gated<LaneQueue<2, 29, 6>>,
    mip_fetch: Gated<MipFetch<M, A>>,
    lanes: Gated<LaneQueue<6, V, 8>>,
    displace: Gated<Displace>,
    displaced: Gated<LaneQueue<3, 34, 8>>,
    /// The left vertex of the step at the output, once the right one is awaited.
    left: DataRegister<Lanes<3, 34>>,
    has_left: Register<Bit>,
    sends_left: Wire<Bit>,
    sends_right: Wire<Bit>,
    both: Wire<Bit>,
    issues: Wire<Bit>,
    accepts: Wire<Bit>,
    code: Wire<S<13>>,
    at: Wire<S<32>>,
    quarter: Wire<S<21>>,
    minus: Wire<Bit>,
    skipped: Wire<Bit>,
    enters: Wire<Bit>,
    code_left: Wire<Bit>,
    code_left_minus: Wire<Bit>,
    code_right: Wire<Bit>,
    whole: Wire<Lanes<9, 32>>,
    whole_6: Wire<Lanes<6, 32>>,
    lane_x: Wire<S<V>>,
    lanes_1: Wire<Lanes<6, V>>,
    lanes_2: Wire<Lanes<6, V>>,
    lanes_3: Wire<Lanes<6, V>>,
    lanes_4: Wire<Lanes<6, V>>,
    lanes_5: Wire<Lanes<6, V>>,
    axis_texels: Wire<Lanes<2, 29>>,
    texel_u: Wire<S<29>>,
    texel_v: Wire<S<29>>,
    level_now: Wire<U<4>>,
    normal_x: Wire<S<32>>,
    normal_1: Wire<Lanes<3, 32>>,
    normal_2: Wire<Lanes<3, 32>>,
    away: Wire<S<2>>,
    away_now: Wire<S<2>>,
    moved_x: Wire<S<32>>,
    moved_y: Wire<S<32>>,
    moved_c: Wire<S<32>>,
    moved_flags: Wire<S<32>>,
    moved_q: Wire<S<32>>,
    q: Wire<U<24>>,
    word_0: Wire<U<34>>,
    word_1: Wire<U<34>>,
    word_2: Wire<U<34>>,
    words_1: Wire<Lanes<3, 34>>,
    words_2: Wire<Lanes<3, 34>>,
    words: Wire<Lanes<3, 34>>,
    head_code: Wire<U<13>>,
    /// The step has a displaced vertex on that side.
    head_left: Wire<Bit>,
    head_right: Wire<Bit>,
    left_far: Wire<Lanes<3, 34>>,
    right_far: Wire<Lanes<3, 34>>,
    complete: Wire<Bit>,
    takes_left: Wire<Bit>,
    leaves: Wire<Bit>,
    takes: Wire<Bit>,
    gone: Constant<U<6>>,
    most: Constant<U<9>>,
    plus_x: Constant<Lanes<3, 34>>,
    minus_x: Constant<Lanes<3, 34>>,
    plus_y: Constant<Lanes<3, 34>>,
    minus_y: Constant<Lanes<3, 34>>,
}

impl<const V: usize, const M: usize, const A: usize> Vertices<V, M, A> {
    /// Vertices, and steps, on their way, and two more at most: more than the cycles of the way, less than the places of the queues.
    const PLACES: usize = 250;
    /// X' of a vertex that is skipped, and -X' in 22 bits.
    const FAR: i64 = (1 << 21) - 1;
    const FAR_MINUS: i64 = (1 << 22) - Self::FAR;
}

impl<const V: usize, const M: usize, const A: usize> Default for Vertices<V, M, A> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_left: Input::default(),
            in_right: Input::default(),
            in_swap: Input::default(),
            in_last: Input::default(),
            in_left_vertex: Input::default(),
            in_right_vertex: Input::default(),
            map_valid: Input::default(),
            map_ready: Output::default(),
            map_loads: Input::default(),
            map_minima: Input::default(),
            map_level: Input::default(),
            map_i: Input::default(),
            map_j: Input::default(),
            map_value: Input::default(),
            map_base: Input::default(),
            map_minima_base: Input::default(),
            map_pitch: Input::default(),
            map_repeat_u: Input::default(),
            map_repeat_v: Input::default(),
            passes: Input::default(),
            minima: Input::default(),
            limit: Input::default(),
            across: Input::default(),
            axis_u: Input::default(),
            axis_v: Input::default(),
            level: Input::default(),
            minimum: Input::default(),
            range: Input::default(),
            exponent: Input::default(),
            focal: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_kind: Output::default(),
            out_left: Output::default(),
            out_right: Output::default(),
            out_swap: Output::default(),
            out_last: Output::default(),
            out_left_vertex: Output::default(),
            out_right_vertex: Output::default(),
            idle: Output::default(),
            sends: Output::default(),
            skips: Output::default(),
            lacks_room: Output::default(),
            sends_second: Output::default(),
            error: Output::default(),
            vertices: Register::default(),
            steps: Register::default(),
            room: Register::default(),
            second: Register::default(),
            s1_valid: Register::default(),
            s1_vertex: DataRegister::default(),
            s1_limit: DataRegister::default(),
            s1_across: DataRegister::default(),
            s1_step: Register::default(),
            s1_code: DataRegister::default(),
            s1_both: DataRegister::default(),
            s1_left: DataRegister::default(),
            left_skips: DataRegister::default(),
            left_minus: DataRegister::default(),
            codes: Gated::default(),
            perspective_correct: Gated::default(),
            filter_level: Gated::default(),
            facing: Gated::default(),
            aways: Gated::default(),
            texels: Gated::default(),
            mip_fetch: Gated::default(),
            lanes: Gated::default(),
            displace: Gated::default(),
            displaced: Gated::default(),
            left: DataRegister::default(),
            has_left: Register::default(),
            sends_left: Wire::default(),
            sends_right: Wire::default(),
            both: Wire::default(),
            issues: Wire::default(),
            accepts: Wire::default(),
            code: Wire::default(),
            at: Wire::default(),
            quarter: Wire::default(),
            minus: Wire::default(),
            skipped: Wire::default(),
            enters: Wire::default(),
            code_left: Wire::default(),
            code_left_minus: Wire::default(),
            code_right: Wire::default(),
            whole: Wire::default(),
            whole_6: Wire::default(),
            lane_x: Wire::default(),
            lanes_1: Wire::default(),
            lanes_2: Wire::default(),
            lanes_3: Wire::default(),
            lanes_4: Wire::default(),
            lanes_5: Wire::default(),
            axis_texels: Wire::default(),
            texel_u: Wire::default(),
            texel_v: Wire::default(),
            level_now: Wire::default(),
            normal_x: Wire::default(),
            normal_1: Wire::default(),
            normal_2: Wire::default(),
            away: Wire::default(),
            away_now: Wire::default(),
            moved_x: Wire::default(),
            moved_y: Wire::default(),
            moved_c: Wire::default(),
            moved_flags: Wire::default(),
            moved_q: Wire::default(),
            q: Wire::default(),
            word_0: Wire::default(),
            word_1: Wire::default(),
            word_2: Wire::default(),
            words_1: Wire::default(),
            words_2: Wire::default(),
            words: Wire::default(),
            head_code: Wire::default(),
            head_left: Wire::default(),
            head_right: Wire::default(),
            left_far: Wire::default(),
            right_far: Wire::default(),
            complete: Wire::default(),
            takes_left: Wire::default(),
            leaves: Wire::default(),
            takes: Wire::default(),
            gone: Constant::new(U::new(32 - V as i64)),
            most: Constant::new(U::new(Self::PLACES as i64)),
            plus_x: Constant::new(Lanes::new([Self::FAR, 0, 0])),
            minus_x: Constant::new(Lanes::new([Self::FAR_MINUS, 0, 0])),
            plus_y: Constant::new(Lanes::new([0, Self::FAR, 0])),
            minus_y: Constant::new(Lanes::new([0, Self::FAR_MINUS, 0])),
        }
    }
}

impl<const V: usize, const M: usize, const A: usize> Logic for Vertices<V, M, A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self,
            clock,
            codes,
            perspective_correct,
            filter_level,
            facing,
            aways,
            texels,
            mip_fetch,
            lanes,
            displace
        );
        clock!(self, clock, displaced);
        dff_setup!(self, clock, vertices, steps, room, second, s1_valid, s1_vertex, left, has_left);
        dff_setup!(self, clock, s1_limit, s1_across, s1_step, s1_code, s1_both, s1_left, left_skips, left_minus);

        // A step sends its vertices one after the other, and is taken with the last.
        self.sends_left.next = self.in_left.val() == 1;
        self.sends_right.next = self.in_right.val().any();
        self.both.next = self.sends_left.val() && self.sends_right.val() && !self.second.q.val();
        self.in_ready.next = self.room.q.val() && !self.both.val();
        self.accepts.next = self.in_valid.val() && self.room.q.val() && !self.both.val();
        self.issues.next =
            self.in_valid.val() && self.room.q.val() && (self.sends_left.val() || self.sends_right.val());
        self.lacks_room.next = self.in_valid.val() && !self.room.q.val();
        self.sends_second.next = self.in_valid.val() && self.room.q.val() && self.both.val();
        if self.in_valid.val() && self.room.q.val() {
            self.second.d.next = self.both.val();
        }
        self.s1_valid.d.next = self.issues.val();
        self.s1_vertex.d.next = self.in_right_vertex.val();
        if self.sends_left.val() && !self.second.q.val() {
            self.s1_vertex.d.next = self.in_left_vertex.val();
        }
        self.s1_limit.d.next = self.limit.val();
        self.s1_across.d.next = self.across.val();
        self.s1_step.d.next = self.accepts.val();
        self.s1_code.d.next = (bit_cast_to::<S<13>>(self.in_kind.val()) << 6)
            | (bit_cast_to::<S<13>>(self.in_left.val()) << 4)
            | (bit_cast_to::<S<13>>(self.in_right.val()) << 2)
            | (bit_cast_to::<S<13>>(self.in_swap.val()) << 1)
            | bit_cast_to::<S<13>>(self.in_last.val());
        self.s1_both.d.next = self.sends_left.val() && self.sends_right.val();
        self.s1_left.d.next = self.sends_left.val() && !self.sends_right.val();

        // Far off the screen it goes no further, and the step says so: bit 8 across, 9 and 10 the left one skipped and on the negative
        // side, 11 and 12 the right one.
        self.whole.next = bit_cast_to::<Lanes<9, 32>>(self.s1_vertex.q.val()) << self.gone.val();
        self.at.next = self.whole.val().get_bit(0);
        if self.s1_across.q.val() {
            self.at.next = self.whole.val().get_bit(1);
        }
        self.quarter.next = bit_cast_to::<S<21>>(self.at.val() >> 16);
        self.minus.next = self.quarter.val() < 0;
        self.skipped.next = self.s1_valid.q.val()
            && (self.quarter.val() > self.s1_limit.q.val() || self.quarter.val() < -self.s1_limit.q.val());
        self.enters.next = self.s1_valid.q.val() && !self.skipped.val();
        self.sends.next = self.enters.val();
        self.skips.next = self.skipped.val();
        self.left_skips.enable.next = self.s1_valid.q.val();
        self.left_skips.d.next = self.skipped.val();
        self.left_minus.enable.next = self.s1_valid.q.val();
        self.left_minus.d.next = self.minus.val();
        self.code_left.next = self.s1_left.q.val() && self.skipped.val();
        self.code_left_minus.next = self.minus.val();
        self.code_right.next = !self.s1_left.q.val() && self.skipped.val();
        if self.s1_both.q.val() {
            self.code_left.next = self.left_skips.q.val();
            self.code_left_minus.next = self.left_minus.q.val();
        }
        self.codes.push.next = self.s1_step.q.val();
        self.code.next = self.s1_code.q.val()
            | (bit_cast_to::<S<13>>(self.s1_across.q.val()) << 8)
            | (bit_cast_to::<S<13>>(self.code_left.val()) << 9)
            | (bit_cast_to::<S<13>>(self.code_left_minus.val()) << 10)
            | (bit_cast_to::<S<13>>(self.code_right.val()) << 11)
            | (bit_cast_to::<S<13>>(self.minus.val()) << 12);
        self.codes.data.next = bit_cast_to::<Lanes<1, 13>>(self.code.val());

        // Its lanes go four ways; `room` stands for all that is ahead.
        self.lanes.push.next = self.enters.val();
        self.lane_x.next = self.s1_vertex.q.val().get_bit(0);
        self.lanes_1.next = bit_cast_to::<Lanes<6, V>>(self.lane_x.val());
        self.lanes_2.next = self.lanes_1.val().replace_bit(1, self.s1_vertex.q.val().get_bit(1));
        self.lanes_3.next = self.lanes_2.val().replace_bit(2, self.s1_vertex.q.val().get_bit(2));
        self.lanes_4.next = self.lanes_3.val().replace_bit(3, self.s1_vertex.q.val().get_bit(3));
        self.lanes_5.next = self.lanes_4.val().replace_bit(4, self.s1_vertex.q.val().get_bit(4));
        self.lanes.data.next = self.lanes_5.val().replace_bit(5, self.s1_vertex.q.val().get_bit(5));
        self.perspective_correct.in_valid.next = self.enters.val();
        self.perspective_correct.in_u.next = self.whole.val().get_bit(6);
        self.perspective_correct.in_v.next = self.whole.val().get_bit(7);
        self.perspective_correct.in_c.next = self.whole.val().get_bit(2);
        self.perspective_correct.in_width.next = self.axis_u.val().get_bits::<14>(0);
        self.perspective_correct.in_height.next = self.axis_v.val().get_bits::<14>(0);
        self.perspective_correct.in_repeat_u.next = self.axis_u.val().get_bit(14);
        self.perspective_correct.in_repeat_v.next = self.axis_v.val().get_bit(14);
        self.perspective_correct.in_texel_bits_u.next = self.axis_u.val().get_bits::<4>(15);
        self.perspective_correct.in_texel_bits_v.next = self.axis_v.val().get_bits::<4>(15);
        self.perspective_correct.out_ready.next = true;
        self.filter_level.in_valid.next = self.enters.val();
        self.filter_level.in_density.next = self.whole.val().get_bit(8);
        self.filter_level.in_c.next = self.whole.val().get_bit(2);
        self.filter_level.in_scale.next = self.level.val().get_bits::<24>(0);
        self.filter_level.in_shift.next = self.level.val().get_bits::<6>(24);
        self.filter_level.in_levels.next = self.level.val().get_bits::<5>(30);
        self.filter_level.out_ready.next = self.mip_fetch.in_ready.val();
        self.facing.in_valid.next = self.enters.val();
        self.normal_x.next = self.whole.val().get_bit(3);
        self.normal_1.next = bit_cast_to::<Lanes<3, 32>>(self.normal_x.val());
        self.normal_2.next = self.normal_1.val().replace_bit(1, self.whole.val().get_bit(4));
        self.facing.in_normal.next = self.normal_2.val().replace_bit(2, self.whole.val().get_bit(5));
        self.facing.in_x.next = self.whole.val().get_bit(0);
        self.facing.in_y.next = self.whole.val().get_bit(1);
        self.facing.in_focal.next = self.focal.val();
        self.facing.out_ready.next = true;
        self.aways.push.next = self.facing.out_valid.val();
        self.away.next = bit_cast_to::<S<2>>(self.facing.out_away.val());
        self.aways.data.next = bit_cast_to::<Lanes<1, 2>>(self.away.val());
        self.aways.take.next = self.filter_level.out_valid.val() && self.mip_fetch.in_ready.val();
        self.away_now.next = self.aways.head.val().get_bit(0);
        self.texels.push.next = self.perspective_correct.out_valid.val();
        self.axis_texels.next = bit_cast_to::<Lanes<2, 29>>(bit_cast_to::<S<29>>(self.perspective_correct.out_u.val()));
        self.texels.data.next =
            self.axis_texels.val().replace_bit(1, bit_cast_to::<S<29>>(self.perspective_correct.out_v.val()));
        self.texels.take.next = self.filter_level.out_valid.val() && self.mip_fetch.in_ready.val();
        self.texel_u.next = self.texels.head.val().get_bit(0);
        self.texel_v.next = self.texels.head.val().get_bit(1);
        self.level_now.next = self.filter_level.out_level.val();

        self.mip_fetch.in_valid.next = self.filter_level.out_valid.val() || self.map_valid.val();
        self.mip_fetch.in_kind.next = 2.into();
        self.mip_fetch.in_level.next = self.level_now.val();
        self.mip_fetch.in_minima.next = self.minima.val() && self.away_now.val().get_bit(0);
        if !self.filter_level.out_valid.val() {
            self.mip_fetch.in_kind.next = bit_cast_to::<U<2>>(self.map_loads.val());
            self.mip_fetch.in_level.next = self.map_level.val();
            self.mip_fetch.in_minima.next = self.map_minima.val();
        }
        self.mip_fetch.in_u.next = bit_cast_to::<U<29>>(self.texel_u.val());
        self.mip_fetch.in_v.next = bit_cast_to::<U<29>>(self.texel_v.val());
        self.mip_fetch.in_bilinear.next = true;
        self.mip_fetch.in_i.next = self.map_i.val();
        self.mip_fetch.in_j.next = self.map_j.val();
        self.mip_fetch.in_value.next = self.map_value.val();
        self.mip_fetch.in_width.next = self.map_i.val();
        self.mip_fetch.in_height.next = self.map_j.val();
        self.mip_fetch.in_base.next = self.map_base.val();
        self.mip_fetch.in_minima_base.next = self.map_minima_base.val();
        self.mip_fetch.in_pitch.next = self.map_pitch.val();
        self.mip_fetch.in_repeat_u.next = self.map_repeat_u.val();
        self.mip_fetch.in_repeat_v.next = self.map_repeat_v.val();
        self.mip_fetch.out_ready.next = self.displace.in_ready.val();
        self.map_ready.next = self.mip_fetch.in_ready.val() && !self.filter_level.out_valid.val();
        self.error.next = self.mip_fetch.error.val();

        self.displace.in_valid.next = self.mip_fetch.out_valid.val();
        self.whole_6.next = bit_cast_to::<Lanes<6, 32>>(self.lanes.head.val()) << self.gone.val();
        self.displace.in_vertex.next = self.whole_6.val();
        self.displace.in_q.next = self.mip_fetch.out_value.val();
        if self.passes.val() {
            self.displace.in_q.next = 0.into();
        }
        self.displace.in_minimum.next = self.minimum.val();
        self.displace.in_range.next = self.range.val();
        self.displace.in_exponent.next = self.exponent.val();
        self.displace.in_focal.next = self.focal.val();
        self.displace.out_ready.next = true;
        self.lanes.take.next = self.mip_fetch.out_valid.val() && self.displace.in_ready.val();

        self.moved_x.next = self.displace.out_vertex.val().get_bit(0);
        self.moved_y.next = self.displace.out_vertex.val().get_bit(1);
        self.moved_c.next = self.displace.out_vertex.val().get_bit(2);
        self.moved_flags.next = self.displace.out_vertex.val().get_bit(3);
        self.moved_q.next = self.displace.out_vertex.val().get_bit(4);
        self.q.next = bit_cast_to::<U<24>>(self.moved_q.val());
        self.word_0.next = bit_cast_to::<U<34>>(bit_cast_to::<U<22>>(self.moved_x.val()))
            | (bit_cast_to::<U<34>>(bit_cast_to::<U<3>>(self.moved_flags.val())) << 22)
            | (bit_cast_to::<U<34>>(self.q.val().get_bits::<9>(0)) << 25);
        self.word_1.next = bit_cast_to::<U<34>>(bit_cast_to::<U<22>>(self.moved_y.val()))
            | (bit_cast_to::<U<34>>(self.q.val().get_bits::<12>(9)) << 22);
        self.word_2.next = bit_cast_to::<U<34>>(bit_cast_to::<U<31>>(self.moved_c.val()))
            | (bit_cast_to::<U<34>>(self.q.val().get_bits::<3>(21)) << 31);
        self.words_1.next = bit_cast_to::<Lanes<3, 34>>(bit_cast_to::<S<34>>(self.word_0.val()));
        self.words_2.next = self.words_1.val().replace_bit(1, bit_cast_to::<S<34>>(self.word_1.val()));
        self.words.next = self.words_2.val().replace_bit(2, bit_cast_to::<S<34>>(self.word_2.val()));
        self.displaced.push.next = self.displace.out_valid.val();
        self.displaced.data.next = self.words.val();

        // A step leaves with its vertices; the left one of two waits for the right one.
        self.head_code.next = bit_cast_to::<U<13>>(self.codes.head.val().get_bit(0));
        self.head_left.next = self.head_code.val().get_bits::<2>(4) == 1 && !self.head_code.val().get_bit(9);
        self.head_right.next = self.head_code.val().get_bits::<2>(2).any() && !self.head_code.val().get_bit(11);
        self.takes_left.next = self.codes.valid.val()
            && self.head_left.val()
            && self.head_right.val()
            && !self.has_left.q.val()
            && self.displaced.valid.val();
        self.complete.next = self.codes.valid.val();
        if self.head_left.val() && self.head_right.val() {
            self.complete.next = self.codes.valid.val() && self.has_left.q.val() && self.displaced.valid.val();
        } else if self.head_left.val() || self.head_right.val() {
            self.complete.next = self.codes.valid.val() && self.displaced.valid.val();
        }
        self.leaves.next = self.complete.val() && self.out_ready.val();
        self.codes.take.next = self.leaves.val();
        self.takes.next =
            self.takes_left.val() || (self.leaves.val() && (self.head_left.val() || self.head_right.val()));
        self.displaced.take.next = self.takes.val();
        if self.takes_left.val() {
            self.left.d.next = self.displaced.head.val();
            self.has_left.d.next = true;
        } else if self.leaves.val() {
            self.has_left.d.next = false;
        }
        self.out_valid.next = self.complete.val();
        self.out_kind.next = self.head_code.val().get_bits::<2>(6);
        self.out_left.next = self.head_code.val().get_bits::<2>(4);
        self.out_right.next = self.head_code.val().get_bits::<2>(2);
        self.out_swap.next = self.head_code.val().get_bit(1);
        self.out_last.next = self.head_code.val().get_bit(0);
        self.out_left_vertex.next = self.displaced.head.val();
        if self.has_left.q.val() {
            self.out_left_vertex.next = self.left.q.val();
        }
        self.out_right_vertex.next = self.displaced.head.val();
        self.left_far.next = self.plus_x.val();
        self.right_far.next = self.plus_x.val();
        if self.head_code.val().get_bit(8) {
            self.left_far.next = self.plus_y.val();
            self.right_far.next = self.plus_y.val();
            if self.head_code.val().get_bit(10) {
                self.left_far.next = self.minus_y.val();
            }
            if self.head_code.val().get_bit(12) {
                self.right_far.next = self.minus_y.val();
            }
        } else {
            if self.head_code.val().get_bit(10) {
                self.left_far.next = self.minus_x.val();
            }
            if self.head_code.val().get_bit(12) {
                self.right_far.next = self.minus_x.val();
            }
        }
        if self.head_code.val().get_bit(9) {
            self.out_left_vertex.next = self.left_far.val();
        }
        if self.head_code.val().get_bit(11) {
            self.out_right_vertex.next = self.right_far.val();
        }

        if self.enters.val() && !self.takes.val() {
            self.vertices.d.next = self.vertices.q.val() + 1;
        } else if !self.enters.val() && self.takes.val() {
            self.vertices.d.next = self.vertices.q.val() - 1;
        }
        if self.accepts.val() && !self.leaves.val() {
            self.steps.d.next = self.steps.q.val() + 1;
        } else if !self.accepts.val() && self.leaves.val() {
            self.steps.d.next = self.steps.q.val() - 1;
        }
        self.room.d.next = self.vertices.q.val() < self.most.val() && self.steps.q.val() < self.most.val();
        self.idle.next = !self.vertices.q.val().any() && !self.steps.q.val().any() && !self.s1_valid.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("vertices")
    }
}

watched! { [const V: usize, const M: usize, const A: usize] Vertices<V, M, A>: in_valid, in_kind, in_left, in_right, in_swap, in_last, in_left_vertex, in_right_vertex, map_valid, map_loads, map_minima, map_level, map_i, map_j, map_value, map_base, map_minima_base, map_pitch, map_repeat_u, map_repeat_v, passes, minima, limit, across, axis_u, axis_v, level, minimum, range, exponent, focal, out_ready; codes, perspective_correct, filter_level, facing, aways, texels, mip_fetch, lanes, displace, displaced; vertices, steps, room, second, s1_valid, s1_vertex, codes, perspective_correct, filter_level, facing, aways, texels, mip_fetch, lanes, displace, displaced, left, has_left, s1_limit, s1_across, s1_step, s1_code, s1_both, s1_left, left_skips, left_minus }
