// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves out the triangles of a strip that have no place, and those off the screen, and sends the others one after the other.
//!
//! ```text
//! left out <=> a vertex has a flag, or all three are beyond the same side of the viewport
//! ```
//!
//! A beat is judged as a whole, so one of which nothing is left takes one cycle, as one triangle does: a strip off the screen passes
//! as fast as the walkers step.
//!
//! | stage | registers |
//! | s1    | the beat, and the sides that each of its vertices is beyond |
//! | s2    | the same, with what is left of it |
//! | s3    | a triangle |
//!
//! | port  | format | meaning |   Latency 3, interval max(1, triangles left) a beat; golden: models::displacement_pipeline::Machine
//! | in_*  | stream | of the strip unit; vertices X' | flags << 22 | q << 25, Y' | (q >> 9) << 22, c' | (q >> 21) << 31
//! | skips, half_* | Bit, UQ16.8 | leaves out what lies beyond one side of the viewport
//! | room  | Bit    | a triangle may go
//! | out_* | -      | X', Y' SQ13.8; c' UQ0.31; q UQ16.8, in winding order   Error 0
//! | idle  | Bit    | nothing is here
//! | comes, invalid, near, range, off | Bit | triangles that came, and why some were left out; `two_*`: two of them

use crate::prelude::*;

/// The sides that a vertex is beyond: bits left, right, top, bottom.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Beyond {
    pub vertex: Input<Lanes<3, 34>>,
    pub half_width: Input<U<24>>,
    pub half_height: Input<U<24>>,
    pub sides: Output<U<4>>,
    at_x: Wire<S<26>>,
    at_y: Wire<S<26>>,
    word_x: Wire<U<34>>,
    word_y: Wire<U<34>>,
    limit_x: Wire<S<26>>,
    limit_y: Wire<S<26>>,
    low: Wire<U<4>>,
}

impl Logic for Beyond {
    #[hdl_gen]
    fn update(&mut self) {
        self.word_x.next = bit_cast_to::<U<34>>(self.vertex.val().get_bit(0));
        self.word_y.next = bit_cast_to::<U<34>>(self.vertex.val().get_bit(1));
        self.at_x.next = bit_cast_to::<S<26>>(bit_cast_to::<S<22>>(self.word_x.val().get_bits::<22>(0)));
        self.at_y.next = bit_cast_to::<S<26>>(bit_cast_to::<S<22>>(self.word_y.val().get_bits::<22>(0)));
        self.limit_x.next = bit_cast_to::<S<26>>(self.half_width.val());
        self.limit_y.next = bit_cast_to::<S<26>>(self.half_height.val());
        self.low.next = 0.into();
        if self.at_x.val() > self.limit_x.val() {
            self.low.next = 2.into();
        } else if self.at_x.val() < -self.limit_x.val() {
            self.low.next = 1.into();
        }
        self.sides.next = self.low.val();
        if self.at_y.val() > self.limit_y.val() {
            self.sides.next = self.low.val() | 8;
        } else if self.at_y.val() < -self.limit_y.val() {
            self.sides.next = self.low.val() | 4;
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("beyond")
    }
}

/// The fields of a packed vertex.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Unpack {
    pub vertex: Input<Lanes<3, 34>>,
    pub pixel_x: Output<S<22>>,
    pub pixel_y: Output<S<22>>,
    pub c: Output<S<32>>,
    pub height: Output<S<25>>,
    word_0: Wire<U<34>>,
    word_1: Wire<U<34>>,
    word_2: Wire<U<34>>,
    q: Wire<U<24>>,
}

impl Logic for Unpack {
    #[hdl_gen]
    fn update(&mut self) {
        self.word_0.next = bit_cast_to::<U<34>>(self.vertex.val().get_bit(0));
        self.word_1.next = bit_cast_to::<U<34>>(self.vertex.val().get_bit(1));
        self.word_2.next = bit_cast_to::<U<34>>(self.vertex.val().get_bit(2));
        self.pixel_x.next = bit_cast_to::<S<22>>(self.word_0.val().get_bits::<22>(0));
        self.pixel_y.next = bit_cast_to::<S<22>>(self.word_1.val().get_bits::<22>(0));
        self.c.next = bit_cast_to::<S<32>>(self.word_2.val().get_bits::<31>(0));
        self.q.next = bit_cast_to::<U<24>>(self.word_0.val().get_bits::<9>(25))
            | (bit_cast_to::<U<24>>(self.word_1.val().get_bits::<12>(22)) << 9)
            | (bit_cast_to::<U<24>>(self.word_2.val().get_bits::<3>(31)) << 21);
        self.height.next = bit_cast_to::<S<25>>(self.q.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("unpack")
    }
}

/// The sieve.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Sift {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_first: Input<Bit>,
    pub in_second: Input<Bit>,
    pub in_swap: Input<Bit>,
    pub in_left: Input<Lanes<3, 34>>,
    pub in_right: Input<Lanes<3, 34>>,
    pub in_next_left: Input<Lanes<3, 34>>,
    pub in_next_right: Input<Lanes<3, 34>>,
    pub skips: Input<Bit>,
    pub half_width: Input<U<24>>,
    pub half_height: Input<U<24>>,
    pub room: Input<Bit>,
    pub out_valid: Output<Bit>,
    pub out_x: Output<Lanes<3, 22>>,
    pub out_y: Output<Lanes<3, 22>>,
    pub out_c: Output<Lanes<3, 32>>,
    pub out_height: Output<Lanes<3, 25>>,
    pub idle: Output<Bit>,
    pub comes: Output<Bit>,
    pub two_come: Output<Bit>,
    pub invalid: Output<Bit>,
    pub two_invalid: Output<Bit>,
    pub near: Output<Bit>,
    pub two_near: Output<Bit>,
    pub range: Output<Bit>,
    pub two_range: Output<Bit>,
    pub off: Output<Bit>,
    pub two_off: Output<Bit>,
    s1_valid: Register<Bit>,
    s1_first: DataRegister<Bit>,
    s1_second: DataRegister<Bit>,
    s1_swap: DataRegister<Bit>,
    s1_left: DataRegister<Lanes<3, 34>>,
    s1_right: DataRegister<Lanes<3, 34>>,
    s1_next_left: DataRegister<Lanes<3, 34>>,
    s1_next_right: DataRegister<Lanes<3, 34>>,
    s1_left_beyond: DataRegister<U<4>>,
    s1_right_beyond: DataRegister<U<4>>,
    s1_next_left_beyond: DataRegister<U<4>>,
    s1_next_right_beyond: DataRegister<U<4>>,
    /// The first triangle is left, the second one; the first one has gone.
    s2_first: Register<Bit>,
    s2_second: Register<Bit>,
    s2_gone: Register<Bit>,
    s2_swap: DataRegister<Bit>,
    s2_left: DataRegister<Lanes<3, 34>>,
    s2_right: DataRegister<Lanes<3, 34>>,
    s2_next_left: DataRegister<Lanes<3, 34>>,
    s2_next_right: DataRegister<Lanes<3, 34>>,
    s2_comes: Register<Bit>,
    s2_two_come: Register<Bit>,
    s2_invalid: Register<Bit>,
    s2_two_invalid: Register<Bit>,
    s2_near: Register<Bit>,
    s2_two_near: Register<Bit>,
    s2_range: Register<Bit>,
    s2_two_range: Register<Bit>,
    s2_off: Register<Bit>,
    s2_two_off: Register<Bit>,
    s3_valid: Register<Bit>,
    s3_x: DataRegister<Lanes<3, 22>>,
    s3_y: DataRegister<Lanes<3, 22>>,
    s3_c: DataRegister<Lanes<3, 32>>,
    s3_height: DataRegister<Lanes<3, 25>>,
    left_sides: Beyond,
    right_sides: Beyond,
    next_left_sides: Beyond,
    next_right_sides: Beyond,
    corner_a: Unpack,
    corner_b: Unpack,
    corner_c: Unpack,
    left_flags: Wire<U<3>>,
    right_flags: Wire<U<3>>,
    next_left_flags: Wire<U<3>>,
    next_right_flags: Wire<U<3>>,
    first_flags: Wire<U<3>>,
    second_flags: Wire<U<3>>,
    first_off: Wire<Bit>,
    second_off: Wire<Bit>,
    first_invalid: Wire<Bit>,
    second_invalid: Wire<Bit>,
    first_near: Wire<Bit>,
    second_near: Wire<Bit>,
    first_range: Wire<Bit>,
    second_range: Wire<Bit>,
    moves: Wire<Bit>,
    enters: Wire<Bit>,
    judged: Wire<Bit>,
    both: Wire<Bit>,
    issues: Wire<Bit>,
    takes_first: Wire<Bit>,
    b: Wire<Lanes<3, 34>>,
    c: Wire<Lanes<3, 34>>,
    xs_1: Wire<Lanes<3, 22>>,
    xs_2: Wire<Lanes<3, 22>>,
    ys_1: Wire<Lanes<3, 22>>,
    ys_2: Wire<Lanes<3, 22>>,
    cs_1: Wire<Lanes<3, 32>>,
    cs_2: Wire<Lanes<3, 32>>,
    hs_1: Wire<Lanes<3, 25>>,
    hs_2: Wire<Lanes<3, 25>>,
}

impl Logic for Sift {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_valid, s1_first, s1_second, s1_swap, s1_left, s1_right, s1_next_left, s1_next_right);
        dff_setup!(self, clock, s1_left_beyond, s1_right_beyond, s1_next_left_beyond, s1_next_right_beyond);
        dff_setup!(self, clock, s2_first, s2_second, s2_gone, s2_swap, s2_left, s2_right, s2_next_left, s2_next_right);
        dff_setup!(self, clock, s2_comes, s2_two_come, s2_invalid, s2_two_invalid, s2_near, s2_two_near);
        dff_setup!(self, clock, s2_range, s2_two_range, s2_off, s2_two_off);
        dff_setup!(self, clock, s3_valid, s3_x, s3_y, s3_c, s3_height);

        // A beat of which two triangles are left moves on with the second one, one of which nothing is left at once.
        self.both.next = self.s2_first.q.val() && self.s2_second.q.val() && !self.s2_gone.q.val();
        self.issues.next = self.room.val() && (self.s2_first.q.val() || self.s2_second.q.val());
        self.moves.next = (self.room.val() && !self.both.val()) || (!self.s2_first.q.val() && !self.s2_second.q.val());
        self.enters.next = self.moves.val() || !self.s1_valid.q.val();
        self.in_ready.next = self.enters.val();
        self.judged.next = self.moves.val() && self.s1_valid.q.val();

        // s1
        self.left_sides.vertex.next = self.in_left.val();
        self.left_sides.half_width.next = self.half_width.val();
        self.left_sides.half_height.next = self.half_height.val();
        self.right_sides.vertex.next = self.in_right.val();
        self.right_sides.half_width.next = self.half_width.val();
        self.right_sides.half_height.next = self.half_height.val();
        self.next_left_sides.vertex.next = self.in_next_left.val();
        self.next_left_sides.half_width.next = self.half_width.val();
        self.next_left_sides.half_height.next = self.half_height.val();
        self.next_right_sides.vertex.next = self.in_next_right.val();
        self.next_right_sides.half_width.next = self.half_width.val();
        self.next_right_sides.half_height.next = self.half_height.val();
        if self.enters.val() {
            self.s1_valid.d.next = self.in_valid.val();
        }
        self.s1_first.enable.next = self.enters.val();
        self.s1_first.d.next = self.in_first.val();
        self.s1_second.enable.next = self.enters.val();
        self.s1_second.d.next = self.in_second.val();
        self.s1_swap.enable.next = self.enters.val();
        self.s1_swap.d.next = self.in_swap.val();
        self.s1_left.enable.next = self.enters.val();
        self.s1_left.d.next = self.in_left.val();
        self.s1_right.enable.next = self.enters.val();
        self.s1_right.d.next = self.in_right.val();
        self.s1_next_left.enable.next = self.enters.val();
        self.s1_next_left.d.next = self.in_next_left.val();
        self.s1_next_right.enable.next = self.enters.val();
        self.s1_next_right.d.next = self.in_next_right.val();
        self.s1_left_beyond.enable.next = self.enters.val();
        self.s1_left_beyond.d.next = self.left_sides.sides.val();
        self.s1_right_beyond.enable.next = self.enters.val();
        self.s1_right_beyond.d.next = self.right_sides.sides.val();
        self.s1_next_left_beyond.enable.next = self.enters.val();
        self.s1_next_left_beyond.d.next = self.next_left_sides.sides.val();
        self.s1_next_right_beyond.enable.next = self.enters.val();
        self.s1_next_right_beyond.d.next = self.next_right_sides.sides.val();

        // s2: (left, right, next left), (right, next right, next left)
        self.left_flags.next = bit_cast_to::<U<34>>(self.s1_left.q.val().get_bit(0)).get_bits::<3>(22);
        self.right_flags.next = bit_cast_to::<U<34>>(self.s1_right.q.val().get_bit(0)).get_bits::<3>(22);
        self.next_left_flags.next = bit_cast_to::<U<34>>(self.s1_next_left.q.val().get_bit(0)).get_bits::<3>(22);
        self.next_right_flags.next = bit_cast_to::<U<34>>(self.s1_next_right.q.val().get_bit(0)).get_bits::<3>(22);
        self.first_flags.next = self.left_flags.val() | self.right_flags.val() | self.next_left_flags.val();
        self.second_flags.next = self.right_flags.val() | self.next_right_flags.val() | self.next_left_flags.val();
        self.first_off.next = self.skips.val()
            && (self.s1_left_beyond.q.val() & self.s1_right_beyond.q.val() & self.s1_next_left_beyond.q.val()).any();
        self.second_off.next = self.skips.val()
            && (self.s1_right_beyond.q.val() & self.s1_next_right_beyond.q.val() & self.s1_next_left_beyond.q.val())
                .any();
        if self.moves.val() {
            self.s2_first.d.next = self.s1_valid.q.val()
                && self.s1_first.q.val()
                && !self.first_flags.val().any()
                && !self.first_off.val();
            self.s2_second.d.next = self.s1_valid.q.val()
                && self.s1_second.q.val()
                && !self.second_flags.val().any()
                && !self.second_off.val();
        }
        self.s2_swap.enable.next = self.moves.val();
        self.s2_swap.d.next = self.s1_swap.q.val();
        self.s2_left.enable.next = self.moves.val();
        self.s2_left.d.next = self.s1_left.q.val();
        self.s2_right.enable.next = self.moves.val();
        self.s2_right.d.next = self.s1_right.q.val();
        self.s2_next_left.enable.next = self.moves.val();
        self.s2_next_left.d.next = self.s1_next_left.q.val();
        self.s2_next_right.enable.next = self.moves.val();
        self.s2_next_right.d.next = self.s1_next_right.q.val();

        // What is counted: the lowest flag says why.
        self.first_invalid.next = self.s1_first.q.val() && self.first_flags.val().get_bit(0);
        self.second_invalid.next = self.s1_second.q.val() && self.second_flags.val().get_bit(0);
        self.first_near.next =
            self.s1_first.q.val() && self.first_flags.val().get_bit(1) && !self.first_flags.val().get_bit(0);
        self.second_near.next =
            self.s1_second.q.val() && self.second_flags.val().get_bit(1) && !self.second_flags.val().get_bit(0);
        self.first_range.next = self.s1_first.q.val() && self.first_flags.val() == 4;
        self.second_range.next = self.s1_second.q.val() && self.second_flags.val() == 4;
        self.s2_comes.d.next = self.judged.val() && (self.s1_first.q.val() || self.s1_second.q.val());
        self.s2_two_come.d.next = self.s1_first.q.val() && self.s1_second.q.val();
        self.s2_invalid.d.next = self.judged.val() && (self.first_invalid.val() || self.second_invalid.val());
        self.s2_two_invalid.d.next = self.first_invalid.val() && self.second_invalid.val();
        self.s2_near.d.next = self.judged.val() && (self.first_near.val() || self.second_near.val());
        self.s2_two_near.d.next = self.first_near.val() && self.second_near.val();
        self.s2_range.d.next = self.judged.val() && (self.first_range.val() || self.second_range.val());
        self.s2_two_range.d.next = self.first_range.val() && self.second_range.val();
        self.s2_off.d.next = self.judged.val()
            && ((self.s1_first.q.val() && self.first_off.val() && !self.first_flags.val().any())
                || (self.s1_second.q.val() && self.second_off.val() && !self.second_flags.val().any()));
        self.s2_two_off.d.next = self.s1_first.q.val()
            && self.first_off.val()
            && !self.first_flags.val().any()
            && self.s1_second.q.val()
            && self.second_off.val()
            && !self.second_flags.val().any();
        self.comes.next = self.s2_comes.q.val();
        self.two_come.next = self.s2_two_come.q.val();
        self.invalid.next = self.s2_invalid.q.val();
        self.two_invalid.next = self.s2_two_invalid.q.val();
        self.near.next = self.s2_near.q.val();
        self.two_near.next = self.s2_two_near.q.val();
        self.range.next = self.s2_range.q.val();
        self.two_range.next = self.s2_two_range.q.val();
        self.off.next = self.s2_off.q.val();
        self.two_off.next = self.s2_two_off.q.val();

        // s3: one of them.
        self.takes_first.next = self.s2_first.q.val() && !self.s2_gone.q.val();
        if self.room.val() {
            self.s2_gone.d.next = self.both.val();
        }
        self.b.next = self.s2_next_right.q.val();
        self.corner_a.vertex.next = self.s2_right.q.val();
        if self.takes_first.val() {
            self.b.next = self.s2_right.q.val();
            self.corner_a.vertex.next = self.s2_left.q.val();
        }
        self.c.next = self.s2_next_left.q.val();
        self.corner_b.vertex.next = self.b.val();
        self.corner_c.vertex.next = self.c.val();
        if self.s2_swap.q.val() {
            self.corner_b.vertex.next = self.c.val();
            self.corner_c.vertex.next = self.b.val();
        }
        self.s3_valid.d.next = self.issues.val();
        self.xs_1.next = bit_cast_to::<Lanes<3, 22>>(self.corner_a.pixel_x.val());
        self.xs_2.next = self.xs_1.val().replace_bit(1, self.corner_b.pixel_x.val());
        self.s3_x.d.next = self.xs_2.val().replace_bit(2, self.corner_c.pixel_x.val());
        self.ys_1.next = bit_cast_to::<Lanes<3, 22>>(self.corner_a.pixel_y.val());
        self.ys_2.next = self.ys_1.val().replace_bit(1, self.corner_b.pixel_y.val());
        self.s3_y.d.next = self.ys_2.val().replace_bit(2, self.corner_c.pixel_y.val());
        self.cs_1.next = bit_cast_to::<Lanes<3, 32>>(self.corner_a.c.val());
        self.cs_2.next = self.cs_1.val().replace_bit(1, self.corner_b.c.val());
        self.s3_c.d.next = self.cs_2.val().replace_bit(2, self.corner_c.c.val());
        self.hs_1.next = bit_cast_to::<Lanes<3, 25>>(self.corner_a.height.val());
        self.hs_2.next = self.hs_1.val().replace_bit(1, self.corner_b.height.val());
        self.s3_height.d.next = self.hs_2.val().replace_bit(2, self.corner_c.height.val());
        self.out_valid.next = self.s3_valid.q.val();
        self.out_x.next = self.s3_x.q.val();
        self.out_y.next = self.s3_y.q.val();
        self.out_c.next = self.s3_c.q.val();
        self.out_height.next = self.s3_height.q.val();
        // What is counted goes with the cycle behind `judged`.
        self.idle.next = !self.in_valid.val()
            && !self.s1_valid.q.val()
            && !self.s2_comes.q.val()
            && !self.s2_first.q.val()
            && !self.s2_second.q.val()
            && !self.s3_valid.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sift")
    }
}

watched! { [] Sift: in_valid, in_first, in_second, in_swap, in_left, in_right, in_next_left, in_next_right, skips, half_width, half_height, room; left_sides, right_sides, next_left_sides, next_right_sides, corner_a, corner_b, corner_c; s1_valid, s1_first, s1_second, s1_swap, s1_left, s1_right, s1_next_left, s1_next_right, s1_left_beyond, s1_right_beyond, s1_next_left_beyond, s1_next_right_beyond, s2_first, s2_second, s2_gone, s2_swap, s2_left, s2_right, s2_next_left, s2_next_right, s2_comes, s2_two_come, s2_invalid, s2_two_invalid, s2_near, s2_two_near, s2_range, s2_two_range, s2_off, s2_two_off, s3_valid, s3_x, s3_y, s3_c, s3_height }
