// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps of the strip unit become lit triangles, one a cycle; what is left out, [`Sift`] says.
//!
//! ```text
//! strips -> [sift] -> triangle -+-> [face_normal] -> normal -+-> [light] -> colour -+-> out
//!                               +-> position, heights -------'                      |
//!                               '-> X', Y', c', q ----------------------------------'
//! ```
//!
//! A triangle goes on its way once there is a place for it at the end of it, so nothing on the way ever stands.
//!
//! | port  | format | meaning |   Interval 1 a lit triangle, or a step of none; golden: models::displacement_pipeline::Machine
//! | in_*  | stream | of the strip unit; vertices as `vertices` packs them |
//! | skips, half_* | Bit, UQ16.8 | leaves out what lies beyond one side of the viewport |
//! | out_* | stream | X', Y' SQ13.8; c' UQ0.31; q UQ16.8; colour, red lowest   Error 0 |
//! | idle  | Bit    | no triangle is here |
//! | comes, invalid, near, range, off | Bit | triangles that came, and why some were left out; `two_*`: two of them |

use crate::displacement_pipeline::lane_queue::LaneQueue;
use crate::displacement_pipeline::sift::Sift;
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
    pub two_come: Output<Bit>,
    pub invalid: Output<Bit>,
    pub two_invalid: Output<Bit>,
    pub near: Output<Bit>,
    pub two_near: Output<Bit>,
    pub range: Output<Bit>,
    pub two_range: Output<Bit>,
    pub off: Output<Bit>,
    pub two_off: Output<Bit>,
    /// Triangles that are on their way, and whether there is room for one more.
    count: Register<U<9>>,
    room: Register<Bit>,
    sift: Gated<Sift>,
    face_normal: Gated<FaceNormal>,
    facing: Gated<LaneQueue<5, 25, 8>>,
    light: Gated<Light>,
    colours: Gated<LaneQueue<1, 24, 8>>,
    lit_x: Gated<LaneQueue<3, 22, 8>>,
    lit_y: Gated<LaneQueue<3, 22, 8>>,
    lit_c: Gated<LaneQueue<3, 32, 8>>,
    lit_height: Gated<LaneQueue<3, 25, 8>>,
    takes: Wire<Bit>,
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
            two_come: Output::default(),
            invalid: Output::default(),
            two_invalid: Output::default(),
            near: Output::default(),
            two_near: Output::default(),
            range: Output::default(),
            two_range: Output::default(),
            off: Output::default(),
            two_off: Output::default(),
            count: Register::default(),
            room: Register::default(),
            sift: Gated::default(),
            face_normal: Gated::default(),
            facing: Gated::default(),
            light: Gated::default(),
            colours: Gated::default(),
            lit_x: Gated::default(),
            lit_y: Gated::default(),
            lit_c: Gated::default(),
            lit_height: Gated::default(),
            takes: Wire::default(),
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
        clock!(self, clock, sift, face_normal, facing, light, colours, lit_x, lit_y, lit_c, lit_height);
        dff_setup!(self, clock, count, room);

        self.sift.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.sift.in_ready.val();
        self.sift.in_first.next = self.in_first.val();
        self.sift.in_second.next = self.in_second.val();
        self.sift.in_swap.next = self.in_swap.val();
        self.sift.in_left.next = self.in_left.val();
        self.sift.in_right.next = self.in_right.val();
        self.sift.in_next_left.next = self.in_next_left.val();
        self.sift.in_next_right.next = self.in_next_right.val();
        self.sift.skips.next = self.skips.val();
        self.sift.half_width.next = self.half_width.val();
        self.sift.half_height.next = self.half_height.val();
        self.sift.room.next = self.room.q.val();
        self.comes.next = self.sift.comes.val();
        self.two_come.next = self.sift.two_come.val();
        self.invalid.next = self.sift.invalid.val();
        self.two_invalid.next = self.sift.two_invalid.val();
        self.near.next = self.sift.near.val();
        self.two_near.next = self.sift.two_near.val();
        self.range.next = self.sift.range.val();
        self.two_range.next = self.sift.two_range.val();
        self.off.next = self.sift.off.val();
        self.two_off.next = self.sift.two_off.val();

        self.face_normal.in_valid.next = self.sift.out_valid.val();
        self.face_normal.in_x.next = self.sift.out_x.val();
        self.face_normal.in_y.next = self.sift.out_y.val();
        self.face_normal.in_c.next = self.sift.out_c.val();
        self.face_normal.in_scale.next = self.pixel.val().get_bits::<24>(0);
        self.face_normal.in_shift.next = self.pixel.val().get_bits::<6>(24);
        self.face_normal.out_ready.next = true;
        self.facing.push.next = self.sift.out_valid.val();
        self.p_1.next = bit_cast_to::<Lanes<5, 25>>(bit_cast_to::<S<25>>(self.sift.out_x.val().get_bit(0)));
        self.p_2.next = self.p_1.val().replace_bit(1, bit_cast_to::<S<25>>(self.sift.out_y.val().get_bit(0)));
        self.p_3.next = self.p_2.val().replace_bit(2, self.sift.out_height.val().get_bit(0));
        self.p_4.next = self.p_3.val().replace_bit(3, self.sift.out_height.val().get_bit(1));
        self.facing.data.next = self.p_4.val().replace_bit(4, self.sift.out_height.val().get_bit(2));
        self.facing.take.next = self.face_normal.out_valid.val();
        self.lit_x.push.next = self.sift.out_valid.val();
        self.lit_x.data.next = self.sift.out_x.val();
        self.lit_y.push.next = self.sift.out_valid.val();
        self.lit_y.data.next = self.sift.out_y.val();
        self.lit_c.push.next = self.sift.out_valid.val();
        self.lit_c.data.next = self.sift.out_c.val();
        self.lit_height.push.next = self.sift.out_valid.val();
        self.lit_height.data.next = self.sift.out_height.val();

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

        // Those that are lit.
        if self.sift.out_valid.val() && !self.takes.val() {
            self.count.d.next = self.count.q.val() + 1;
        } else if !self.sift.out_valid.val() && self.takes.val() {
            self.count.d.next = self.count.q.val() - 1;
        }
        self.room.d.next = self.count.q.val() < self.most.val();
        self.idle.next = !self.count.q.val().any() && self.sift.idle.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("shading")
    }
}

watched! { [] Shading: in_valid, in_first, in_second, in_swap, in_left, in_right, in_next_left, in_next_right, skips, half_width, half_height, pixel, ramp_0, ramp_1, ramp_2, ramp_3, ramp_4, ambient, shine, direction, colour, out_ready; sift, face_normal, facing, light, colours, lit_x, lit_y, lit_c, lit_height; count, room, sift, face_normal, facing, light, colours, lit_x, lit_y, lit_c, lit_height }
