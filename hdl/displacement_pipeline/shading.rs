// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles of the strip unit become lit triangles, one a cycle; those without a place, and those off the screen, are left
//! out.
//!
//! ```text
//! strips -> triangle -> places -+-> [face_normal] -> normal -+-> [light] -> colour -+-> out
//!                               +-> position, heights -------'                      |
//!                               '-> X', Y', c', q ----------------------------------'
//! ```
//!
//! A triangle goes on its way once there is a place for it at the end of it, so nothing on the way ever stands.
//!
//! | port  | format | meaning |   Interval 1 a triangle; golden: models::displacement_pipeline::Machine
//! | in_*  | stream | of the strip unit; vertices as `vertices` packs them |
//! | skips, half_* | Bit, UQ16.8 | leaves out what lies beyond one side of the viewport |
//! | out_* | stream | X', Y' SQ13.8; c' UQ0.31; q UQ16.8; colour, red lowest   Error 0 |
//! | idle  | Bit    | no triangle is here |
//! | comes, invalid, near, range, off | Bit | a triangle has come, and why one was left out |

use crate::displacement_pipeline::lane_queue::LaneQueue;
use crate::face_normal::FaceNormal;
use crate::light::Light;
use crate::prelude::*;

/// Shading.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Shading {
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
    pub pixel: Input<U<30>>,
    pub ramp_0: Input<Lanes<3, 18>>,
    pub ramp_1: Input<Lanes<3, 18>>,
    pub ramp_2: Input<Lanes<3, 18>>,
    pub ramp_3: Input<Lanes<3, 18>>,
    pub ramp_4: Input<Lanes<3, 18>>,
    pub ambient: Input<Lanes<3, 18>>,
    pub shine: Input<U<25>>,
    pub direction: Input<Lanes<3, 18>>,
    pub colour: Input<Lanes<3, 20>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_x: Output<Lanes<3, 22>>,
    pub out_y: Output<Lanes<3, 22>>,
    pub out_c: Output<Lanes<3, 32>>,
    pub out_height: Output<Lanes<3, 25>>,
    pub out_colour: Output<U<24>>,
    pub idle: Output<Bit>,
    pub comes: Output<Bit>,
    pub invalid: Output<Bit>,
    pub near: Output<Bit>,
    pub range: Output<Bit>,
    pub off: Output<Bit>,
    /// Triangles that are on their way, and whether there is room for one more.
    count: Register<U<9>>,
    room: Register<Bit>,
    /// The first triangle of the beat at the input has gone.
    second: Register<Bit>,
    s1_valid: Register<Bit>,
    s1_a: DataRegister<Lanes<3, 34>>,
    s1_b: DataRegister<Lanes<3, 34>>,
    s1_c: DataRegister<Lanes<3, 34>>,
    s2_valid: Register<Bit>,
    s2_x: DataRegister<Lanes<3, 22>>,
    s2_y: DataRegister<Lanes<3, 22>>,
    s2_c: DataRegister<Lanes<3, 32>>,
    s2_height: DataRegister<Lanes<3, 25>>,
    s2_flags: DataRegister<U<3>>,
    s2_off: DataRegister<Bit>,
    s3_valid: Register<Bit>,
    s3_x: DataRegister<Lanes<3, 22>>,
    s3_y: DataRegister<Lanes<3, 22>>,
    s3_c: DataRegister<Lanes<3, 32>>,
    s3_height: DataRegister<Lanes<3, 25>>,
    s3_invalid: Register<Bit>,
    s3_near: Register<Bit>,
    s3_range: Register<Bit>,
    s3_off: Register<Bit>,
    face_normal: Gated<FaceNormal>,
    facing: Gated<LaneQueue<5, 25, 8>>,
    light: Gated<Light>,
    colours: Gated<LaneQueue<1, 24, 8>>,
    lit_x: Gated<LaneQueue<3, 22, 8>>,
    lit_y: Gated<LaneQueue<3, 22, 8>>,
    lit_c: Gated<LaneQueue<3, 32, 8>>,
    lit_height: Gated<LaneQueue<3, 25, 8>>,
    both: Wire<Bit>,
    accepts: Wire<Bit>,
    issues: Wire<Bit>,
    takes: Wire<Bit>,
    drops: Wire<Bit>,
    b: Wire<Lanes<3, 34>>,
    c: Wire<Lanes<3, 34>>,
    a_0: Wire<U<34>>,
    a_1: Wire<U<34>>,
    a_2: Wire<U<34>>,
    a_x: Wire<S<22>>,
    a_y: Wire<S<22>>,
    a_q: Wire<U<24>>,
    b_0: Wire<U<34>>,
    b_1: Wire<U<34>>,
    b_2: Wire<U<34>>,
    b_x: Wire<S<22>>,
    b_y: Wire<S<22>>,
    b_q: Wire<U<24>>,
    c_0: Wire<U<34>>,
    c_1: Wire<U<34>>,
    c_2: Wire<U<34>>,
    c_x: Wire<S<22>>,
    c_y: Wire<S<22>>,
    c_q: Wire<U<24>>,
    xs_1: Wire<Lanes<3, 22>>,
    xs_2: Wire<Lanes<3, 22>>,
    ys_1: Wire<Lanes<3, 22>>,
    ys_2: Wire<Lanes<3, 22>>,
    cs_1: Wire<Lanes<3, 32>>,
    cs_2: Wire<Lanes<3, 32>>,
    hs_1: Wire<Lanes<3, 25>>,
    hs_2: Wire<Lanes<3, 25>>,
    right_of: Wire<S<26>>,
    below_of: Wire<S<26>>,
    left_of: Wire<S<26>>,
    above_of: Wire<S<26>>,
    off_x: Wire<Bit>,
    off_y: Wire<Bit>,
    p_1: Wire<Lanes<5, 25>>,
    p_2: Wire<Lanes<5, 25>>,
    p_3: Wire<Lanes<5, 25>>,
    p_4: Wire<Lanes<5, 25>>,
    position_x: Wire<S<22>>,
    position_1: Wire<Lanes<2, 22>>,
    height_a: Wire<S<25>>,
    height_1: Wire<Lanes<3, 25>>,
    height_2: Wire<Lanes<3, 25>>,
    most: Constant<U<9>>,
}

impl Shading {
    /// Triangles on their way at most: more than the cycles of the way, less than the places of the queues.
    const PLACES: usize = 250;
}

impl Default for Shading {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_first: Input::default(),
            in_second: Input::default(),
            in_swap: Input::default(),
            in_left: Input::default(),
            in_right: Input::default(),
            in_next_left: Input::default(),
            in_next_right: Input::default(),
            skips: Input::default(),
            half_width: Input::default(),
            half_height: Input::default(),
            pixel: Input::default(),
            ramp_0: Input::default(),
            ramp_1: Input::default(),
            ramp_2: Input::default(),
            ramp_3: Input::default(),
            ramp_4: Input::default(),
            ambient: Input::default(),
            shine: Input::default(),
            direction: Input::default(),
            colour: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_x: Output::default(),
            out_y: Output::default(),
            out_c: Output::default(),
            out_height: Output::default(),
            out_colour: Output::default(),
            idle: Output::default(),
            comes: Output::default(),
            invalid: Output::default(),
            near: Output::default(),
            range: Output::default(),
            off: Output::default(),
            count: Register::default(),
            room: Register::default(),
            second: Register::default(),
            s1_valid: Register::default(),
            s1_a: DataRegister::default(),
            s1_b: DataRegister::default(),
            s1_c: DataRegister::default(),
            s2_valid: Register::default(),
            s2_x: DataRegister::default(),
            s2_y: DataRegister::default(),
            s2_c: DataRegister::default(),
            s2_height: DataRegister::default(),
            s2_flags: DataRegister::default(),
            s2_off: DataRegister::default(),
            s3_valid: Register::default(),
            s3_x: DataRegister::default(),
            s3_y: DataRegister::default(),
            s3_c: DataRegister::default(),
            s3_height: DataRegister::default(),
            s3_invalid: Register::default(),
            s3_near: Register::default(),
            s3_range: Register::default(),
            s3_off: Register::default(),
            face_normal: Gated::default(),
            facing: Gated::default(),
            light: Gated::default(),
            colours: Gated::default(),
            lit_x: Gated::default(),
            lit_y: Gated::default(),
            lit_c: Gated::default(),
            lit_height: Gated::default(),
            both: Wire::default(),
            accepts: Wire::default(),
            issues: Wire::default(),
            takes: Wire::default(),
            drops: Wire::default(),
            b: Wire::default(),
            c: Wire::default(),
            a_0: Wire::default(),
            a_1: Wire::default(),
            a_2: Wire::default(),
            a_x: Wire::default(),
            a_y: Wire::default(),
            a_q: Wire::default(),
            b_0: Wire::default(),
            b_1: Wire::default(),
            b_2: Wire::default(),
            b_x: Wire::default(),
            b_y: Wire::default(),
            b_q: Wire::default(),
            c_0: Wire::default(),
            c_1: Wire::default(),
            c_2: Wire::default(),
            c_x: Wire::default(),
            c_y: Wire::default(),
            c_q: Wire::default(),
            xs_1: Wire::default(),
            xs_2: Wire::default(),
            ys_1: Wire::default(),
            ys_2: Wire::default(),
            cs_1: Wire::default(),
            cs_2: Wire::default(),
            hs_1: Wire::default(),
            hs_2: Wire::default(),
            right_of: Wire::default(),
            below_of: Wire::default(),
            left_of: Wire::default(),
            above_of: Wire::default(),
            off_x: Wire::default(),
            off_y: Wire::default(),
            p_1: Wire::default(),
            p_2: Wire::default(),
            p_3: Wire::default(),
            p_4: Wire::default(),
            position_x: Wire::default(),
            position_1: Wire::default(),
            height_a: Wire::default(),
            height_1: Wire::default(),
            height_2: Wire::default(),
            most: Constant::new(U::new(Self::PLACES as i64)),
        }
    }
}

impl Logic for Shading {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, face_normal, facing, light, colours, lit_x, lit_y, lit_c, lit_height);
        dff_setup!(self, clock, count, room, second, s1_valid, s1_a, s1_b, s1_c, s2_valid, s2_x, s2_y, s2_c, s2_height);
        dff_setup!(self, clock, s2_flags, s2_off, s3_valid, s3_x, s3_y, s3_c, s3_height);
        dff_setup!(self, clock, s3_invalid, s3_near, s3_range, s3_off);

        // A beat of two triangles is taken with the second one.
        self.both.next = self.in_first.val() && self.in_second.val() && !self.second.q.val();
        self.accepts.next = self.in_valid.val() && self.room.q.val() && !self.both.val();
        self.in_ready.next = self.room.q.val() && !self.both.val();
        self.issues.next = self.in_valid.val() && self.room.q.val() && (self.in_first.val() || self.in_second.val());
        self.comes.next = self.issues.val();
        if self.in_valid.val() && self.room.q.val() {
            self.second.d.next = self.both.val();
        }
        // (left, right, next left), (right, next right, next left)
        self.b.next = self.in_next_right.val();
        self.s1_a.d.next = self.in_right.val();
        if self.in_first.val() && !self.second.q.val() {
            self.b.next = self.in_right.val();
            self.s1_a.d.next = self.in_left.val();
        }
        self.c.next = self.in_next_left.val();
        self.s1_b.d.next = self.b.val();
        self.s1_c.d.next = self.c.val();
        if self.in_swap.val() {
            self.s1_b.d.next = self.c.val();
            self.s1_c.d.next = self.b.val();
        }
        self.s1_valid.d.next = self.issues.val();

        self.a_0.next = bit_cast_to::<U<34>>(self.s1_a.q.val().get_bit(0));
        self.a_1.next = bit_cast_to::<U<34>>(self.s1_a.q.val().get_bit(1));
        self.a_2.next = bit_cast_to::<U<34>>(self.s1_a.q.val().get_bit(2));
        self.a_x.next = bit_cast_to::<S<22>>(self.a_0.val().get_bits::<22>(0));
        self.a_y.next = bit_cast_to::<S<22>>(self.a_1.val().get_bits::<22>(0));
        self.a_q.next = bit_cast_to::<U<24>>(self.a_0.val().get_bits::<9>(25))
            | (bit_cast_to::<U<24>>(self.a_1.val().get_bits::<12>(22)) << 9)
            | (bit_cast_to::<U<24>>(self.a_2.val().get_bits::<3>(31)) << 21);
        self.b_0.next = bit_cast_to::<U<34>>(self.s1_b.q.val().get_bit(0));
        self.b_1.next = bit_cast_to::<U<34>>(self.s1_b.q.val().get_bit(1));
        self.b_2.next = bit_cast_to::<U<34>>(self.s1_b.q.val().get_bit(2));
        self.b_x.next = bit_cast_to::<S<22>>(self.b_0.val().get_bits::<22>(0));
        self.b_y.next = bit_cast_to::<S<22>>(self.b_1.val().get_bits::<22>(0));
        self.b_q.next = bit_cast_to::<U<24>>(self.b_0.val().get_bits::<9>(25))
            | (bit_cast_to::<U<24>>(self.b_1.val().get_bits::<12>(22)) << 9)
            | (bit_cast_to::<U<24>>(self.b_2.val().get_bits::<3>(31)) << 21);
        self.c_0.next = bit_cast_to::<U<34>>(self.s1_c.q.val().get_bit(0));
        self.c_1.next = bit_cast_to::<U<34>>(self.s1_c.q.val().get_bit(1));
        self.c_2.next = bit_cast_to::<U<34>>(self.s1_c.q.val().get_bit(2));
        self.c_x.next = bit_cast_to::<S<22>>(self.c_0.val().get_bits::<22>(0));
        self.c_y.next = bit_cast_to::<S<22>>(self.c_1.val().get_bits::<22>(0));
        self.c_q.next = bit_cast_to::<U<24>>(self.c_0.val().get_bits::<9>(25))
            | (bit_cast_to::<U<24>>(self.c_1.val().get_bits::<12>(22)) << 9)
            | (bit_cast_to::<U<24>>(self.c_2.val().get_bits::<3>(31)) << 21);
        self.xs_1.next = bit_cast_to::<Lanes<3, 22>>(self.a_x.val());
        self.xs_2.next = self.xs_1.val().replace_bit(1, self.b_x.val());
        self.s2_x.d.next = self.xs_2.val().replace_bit(2, self.c_x.val());
        self.ys_1.next = bit_cast_to::<Lanes<3, 22>>(self.a_y.val());
        self.ys_2.next = self.ys_1.val().replace_bit(1, self.b_y.val());
        self.s2_y.d.next = self.ys_2.val().replace_bit(2, self.c_y.val());
        self.cs_1.next = bit_cast_to::<Lanes<3, 32>>(bit_cast_to::<S<32>>(self.a_2.val().get_bits::<31>(0)));
        self.cs_2.next = self.cs_1.val().replace_bit(1, bit_cast_to::<S<32>>(self.b_2.val().get_bits::<31>(0)));
        self.s2_c.d.next = self.cs_2.val().replace_bit(2, bit_cast_to::<S<32>>(self.c_2.val().get_bits::<31>(0)));
        self.hs_1.next = bit_cast_to::<Lanes<3, 25>>(bit_cast_to::<S<25>>(self.a_q.val()));
        self.hs_2.next = self.hs_1.val().replace_bit(1, bit_cast_to::<S<25>>(self.b_q.val()));
        self.s2_height.d.next = self.hs_2.val().replace_bit(2, bit_cast_to::<S<25>>(self.c_q.val()));
        self.s2_valid.d.next = self.s1_valid.q.val();
        self.s2_flags.d.next =
            self.a_0.val().get_bits::<3>(22) | self.b_0.val().get_bits::<3>(22) | self.c_0.val().get_bits::<3>(22);

        // Beyond one side with all three corners.
        self.right_of.next = bit_cast_to::<S<26>>(self.half_width.val());
        self.left_of.next = -bit_cast_to::<S<26>>(self.half_width.val());
        self.below_of.next = bit_cast_to::<S<26>>(self.half_height.val());
        self.above_of.next = -bit_cast_to::<S<26>>(self.half_height.val());
        self.off_x.next = (bit_cast_to::<S<26>>(self.a_x.val()) > self.right_of.val()
            && bit_cast_to::<S<26>>(self.b_x.val()) > self.right_of.val()
            && bit_cast_to::<S<26>>(self.c_x.val()) > self.right_of.val())
            || (bit_cast_to::<S<26>>(self.a_x.val()) < self.left_of.val()
                && bit_cast_to::<S<26>>(self.b_x.val()) < self.left_of.val()
                && bit_cast_to::<S<26>>(self.c_x.val()) < self.left_of.val());
        self.off_y.next = (bit_cast_to::<S<26>>(self.a_y.val()) > self.below_of.val()
            && bit_cast_to::<S<26>>(self.b_y.val()) > self.below_of.val()
            && bit_cast_to::<S<26>>(self.c_y.val()) > self.below_of.val())
            || (bit_cast_to::<S<26>>(self.a_y.val()) < self.above_of.val()
                && bit_cast_to::<S<26>>(self.b_y.val()) < self.above_of.val()
                && bit_cast_to::<S<26>>(self.c_y.val()) < self.above_of.val());
        self.s2_off.d.next = self.skips.val() && (self.off_x.val() || self.off_y.val());

        self.drops.next = self.s2_flags.q.val().any() || self.s2_off.q.val();
        self.s3_valid.d.next = self.s2_valid.q.val() && !self.drops.val();
        self.s3_x.d.next = self.s2_x.q.val();
        self.s3_y.d.next = self.s2_y.q.val();
        self.s3_c.d.next = self.s2_c.q.val();
        self.s3_height.d.next = self.s2_height.q.val();
        self.s3_invalid.d.next = self.s2_valid.q.val() && self.s2_flags.q.val().get_bit(0);
        self.s3_near.d.next =
            self.s2_valid.q.val() && self.s2_flags.q.val().get_bit(1) && !self.s2_flags.q.val().get_bit(0);
        self.s3_range.d.next = self.s2_valid.q.val() && self.s2_flags.q.val() == 4;
        self.s3_off.d.next = self.s2_valid.q.val() && self.s2_off.q.val() && !self.s2_flags.q.val().any();
        self.invalid.next = self.s3_invalid.q.val();
        self.near.next = self.s3_near.q.val();
        self.range.next = self.s3_range.q.val();
        self.off.next = self.s3_off.q.val();

        self.face_normal.in_valid.next = self.s3_valid.q.val();
        self.face_normal.in_x.next = self.s3_x.q.val();
        self.face_normal.in_y.next = self.s3_y.q.val();
        self.face_normal.in_c.next = self.s3_c.q.val();
        self.face_normal.in_scale.next = self.pixel.val().get_bits::<24>(0);
        self.face_normal.in_shift.next = self.pixel.val().get_bits::<6>(24);
        self.face_normal.out_ready.next = true;
        self.facing.push.next = self.s3_valid.q.val();
        self.p_1.next = bit_cast_to::<Lanes<5, 25>>(bit_cast_to::<S<25>>(self.s3_x.q.val().get_bit(0)));
        self.p_2.next = self.p_1.val().replace_bit(1, bit_cast_to::<S<25>>(self.s3_y.q.val().get_bit(0)));
        self.p_3.next = self.p_2.val().replace_bit(2, self.s3_height.q.val().get_bit(0));
        self.p_4.next = self.p_3.val().replace_bit(3, self.s3_height.q.val().get_bit(1));
        self.facing.data.next = self.p_4.val().replace_bit(4, self.s3_height.q.val().get_bit(2));
        self.facing.take.next = self.face_normal.out_valid.val();
        self.lit_x.push.next = self.s3_valid.q.val();
        self.lit_x.data.next = self.s3_x.q.val();
        self.lit_y.push.next = self.s3_valid.q.val();
        self.lit_y.data.next = self.s3_y.q.val();
        self.lit_c.push.next = self.s3_valid.q.val();
        self.lit_c.data.next = self.s3_c.q.val();
        self.lit_height.push.next = self.s3_valid.q.val();
        self.lit_height.data.next = self.s3_height.q.val();

        self.light.in_valid.next = self.face_normal.out_valid.val();
        self.light.in_normal.next = self.face_normal.out_normal.val();
        self.position_x.next = bit_cast_to::<S<22>>(self.facing.head.val().get_bit(0));
        self.position_1.next = bit_cast_to::<Lanes<2, 22>>(self.position_x.val());
        self.light.in_position.next =
            self.position_1.val().replace_bit(1, bit_cast_to::<S<22>>(self.facing.head.val().get_bit(1)));
        self.height_a.next = self.facing.head.val().get_bit(2);
        self.height_1.next = bit_cast_to::<Lanes<3, 25>>(self.height_a.val());
        self.height_2.next = self.height_1.val().replace_bit(1, self.facing.head.val().get_bit(3));
        self.light.in_heights.next = self.height_2.val().replace_bit(2, self.facing.head.val().get_bit(4));
        self.light.in_scale.next = self.pixel.val().get_bits::<24>(0);
        self.light.in_shift.next = self.pixel.val().get_bits::<6>(24);
        self.light.in_ramp_0.next = self.ramp_0.val();
        self.light.in_ramp_1.next = self.ramp_1.val();
        self.light.in_ramp_2.next = self.ramp_2.val();
        self.light.in_ramp_3.next = self.ramp_3.val();
        self.light.in_ramp_4.next = self.ramp_4.val();
        self.light.in_ambient.next = self.ambient.val();
        self.light.in_specular.next = self.shine.val().get_bits::<17>(0);
        self.light.in_shininess.next = self.shine.val().get_bits::<8>(17);
        self.light.in_direction.next = self.direction.val();
        self.light.in_colour.next = self.colour.val();
        self.light.out_ready.next = true;
        self.colours.push.next = self.light.out_valid.val();
        self.colours.data.next = bit_cast_to::<Lanes<1, 24>>(bit_cast_to::<S<24>>(self.light.out_colour.val()));

        self.out_valid.next = self.colours.valid.val();
        self.out_x.next = self.lit_x.head.val();
        self.out_y.next = self.lit_y.head.val();
        self.out_c.next = self.lit_c.head.val();
        self.out_height.next = self.lit_height.head.val();
        self.out_colour.next = bit_cast_to::<U<24>>(self.colours.head.val().get_bit(0));
        self.takes.next = self.colours.valid.val() && self.out_ready.val();
        self.colours.take.next = self.takes.val();
        self.lit_x.take.next = self.takes.val();
        self.lit_y.take.next = self.takes.val();
        self.lit_c.take.next = self.takes.val();
        self.lit_height.take.next = self.takes.val();

        // Those in the first two stages, and those that are lit.
        if self.s3_valid.q.val() && !self.takes.val() {
            self.count.d.next = self.count.q.val() + 1;
        } else if !self.s3_valid.q.val() && self.takes.val() {
            self.count.d.next = self.count.q.val() - 1;
        }
        self.room.d.next = self.count.q.val() < self.most.val();
        self.idle.next = !self.count.q.val().any()
            && !self.s1_valid.q.val()
            && !self.s2_valid.q.val()
            && !self.s3_valid.q.val()
            && !self.in_valid.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("shading")
    }
}

watched! { [] Shading: in_valid, in_first, in_second, in_swap, in_left, in_right, in_next_left, in_next_right, skips, half_width, half_height, pixel, ramp_0, ramp_1, ramp_2, ramp_3, ramp_4, ambient, shine, direction, colour, out_ready; face_normal, facing, light, colours, lit_x, lit_y, lit_c, lit_height; count, room, second, s1_valid, s1_a, s1_b, s1_c, s2_valid, s2_x, s2_y, s2_c, s2_height, s2_flags, s2_off, s3_valid, s3_x, s3_y, s3_c, s3_height, s3_invalid, s3_near, s3_range, s3_off, face_normal, facing, light, colours, lit_x, lit_y, lit_c, lit_height }
