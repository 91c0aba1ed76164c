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
//! A vertex goes on its way once there is a place for it at the end of it, so nothing on the way ever stands.
//!
//! | port     | format | meaning |   Interval 1, and 2 where a step sends two vertices; golden: models::displacement_pipeline
//! | in_*     | stream | the step port; vertices of nine lanes of V bits
//! | map_*    | stream | sizes and loads of [`crate::mip_fetch`], while no vertex is on its way
//! | passes   | Bit    | the height is 0, whatever the map says
//! | minima   | Bit    | vertices that face away read minima
//! | out_*    | stream | the step port; vertices X' | flags << 22 | q << 25, Y' | (q >> 9) << 22, c' | (q >> 21) << 31
//! | idle     | Bit    | nothing is on its way
//! | sends, lacks_room, sends_second | Bit | a vertex goes; a step waits for room, or for its second vertex

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
    codes: Gated<LaneQueue<1, 8, 8>>,
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
    code: Wire<S<8>>,
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
    head_code: Wire<U<8>>,
    head_left: Wire<Bit>,
    head_right: Wire<Bit>,
    complete: Wire<Bit>,
    takes_left: Wire<Bit>,
    leaves: Wire<Bit>,
    takes: Wire<Bit>,
    gone: Constant<U<6>>,
    most: Constant<U<9>>,
}

impl<const V: usize, const M: usize, const A: usize> Vertices<V, M, A> {
    /// Vertices, and steps, on their way at most: more than the cycles of the way, less than the places of the queues.
    const PLACES: usize = 250;
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
            lacks_room: Output::default(),
            sends_second: Output::default(),
            error: Output::default(),
            vertices: Register::default(),
            steps: Register::default(),
            room: Register::default(),
            second: Register::default(),
            s1_valid: Register::default(),
            s1_vertex: DataRegister::default(),
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
            complete: Wire::default(),
            takes_left: Wire::default(),
            leaves: Wire::default(),
            takes: Wire::default(),
            gone: Constant::new(U::new(32 - V as i64)),
            most: Constant::new(U::new(Self::PLACES as i64)),
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

        // A step sends its vertices one after the other, and is taken with the last.
        self.sends_left.next = self.in_left.val() == 1;
        self.sends_right.next = self.in_right.val().any();
        self.both.next = self.sends_left.val() && self.sends_right.val() && !self.second.q.val();
        self.in_ready.next = self.room.q.val() && !self.both.val();
        self.accepts.next = self.in_valid.val() && self.room.q.val() && !self.both.val();
        self.issues.next =
            self.in_valid.val() && self.room.q.val() && (self.sends_left.val() || self.sends_right.val());
        self.sends.next = self.issues.val();
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
        self.codes.push.next = self.accepts.val();
        self.code.next = (bit_cast_to::<S<8>>(self.in_kind.val()) << 6)
            | (bit_cast_to::<S<8>>(self.in_left.val()) << 4)
            | (bit_cast_to::<S<8>>(self.in_right.val()) << 2)
            | (bit_cast_to::<S<8>>(self.in_swap.val()) << 1)
            | bit_cast_to::<S<8>>(self.in_last.val());
        self.codes.data.next = bit_cast_to::<Lanes<1, 8>>(self.code.val());

        // Its lanes go four ways; `room` stands for all that is ahead.
        self.whole.next = bit_cast_to::<Lanes<9, 32>>(self.s1_vertex.q.val()) << self.gone.val();
        self.lanes.push.next = self.s1_valid.q.val();
        self.lane_x.next = self.s1_vertex.q.val().get_bit(0);
        self.lanes_1.next = bit_cast_to::<Lanes<6, V>>(self.lane_x.val());
        self.lanes_2.next = self.lanes_1.val().replace_bit(1, self.s1_vertex.q.val().get_bit(1));
        self.lanes_3.next = self.lanes_2.val().replace_bit(2, self.s1_vertex.q.val().get_bit(2));
        self.lanes_4.next = self.lanes_3.val().replace_bit(3, self.s1_vertex.q.val().get_bit(3));
        self.lanes_5.next = self.lanes_4.val().replace_bit(4, self.s1_vertex.q.val().get_bit(4));
        self.lanes.data.next = self.lanes_5.val().replace_bit(5, self.s1_vertex.q.val().get_bit(5));
        self.perspective_correct.in_valid.next = self.s1_valid.q.val();
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
        self.filter_level.in_valid.next = self.s1_valid.q.val();
        self.filter_level.in_density.next = self.whole.val().get_bit(8);
        self.filter_level.in_c.next = self.whole.val().get_bit(2);
        self.filter_level.in_scale.next = self.level.val().get_bits::<24>(0);
        self.filter_level.in_shift.next = self.level.val().get_bits::<6>(24);
        self.filter_level.in_levels.next = self.level.val().get_bits::<5>(30);
        self.filter_level.out_ready.next = self.mip_fetch.in_ready.val();
        self.facing.in_valid.next = self.s1_valid.q.val();
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
        self.head_code.next = bit_cast_to::<U<8>>(self.codes.head.val().get_bit(0));
        self.head_left.next = self.head_code.val().get_bits::<2>(4) == 1;
        self.head_right.next = self.head_code.val().get_bits::<2>(2).any();
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

        if self.issues.val() && !self.takes.val() {
            self.vertices.d.next = self.vertices.q.val() + 1;
        } else if !self.issues.val() && self.takes.val() {
            self.vertices.d.next = self.vertices.q.val() - 1;
        }
        if self.accepts.val() && !self.leaves.val() {
            self.steps.d.next = self.steps.q.val() + 1;
        } else if !self.accepts.val() && self.leaves.val() {
            self.steps.d.next = self.steps.q.val() - 1;
        }
        self.room.d.next = self.vertices.q.val() < self.most.val() && self.steps.q.val() < self.most.val();
        self.idle.next = !self.vertices.q.val().any() && !self.steps.q.val().any();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("vertices")
    }
}

watched! { [const V: usize, const M: usize, const A: usize] Vertices<V, M, A>: in_valid, in_kind, in_left, in_right, in_swap, in_last, in_left_vertex, in_right_vertex, map_valid, map_loads, map_minima, map_level, map_i, map_j, map_value, map_base, map_minima_base, map_pitch, map_repeat_u, map_repeat_v, passes, minima, axis_u, axis_v, level, minimum, range, exponent, focal, out_ready; codes, perspective_correct, filter_level, facing, aways, texels, mip_fetch, lanes, displace, displaced; vertices, steps, room, second, s1_valid, s1_vertex, codes, perspective_correct, filter_level, facing, aways, texels, mip_fetch, lanes, displace, displaced, left, has_left }
