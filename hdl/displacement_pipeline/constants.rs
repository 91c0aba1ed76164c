// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constants of a draw, but those of the vertex transform: registers that are written one at a time.
//!
//! | index  | value | format |   Golden: models::displacement_pipeline::Machine
//! | 9, 35  | focal length, z0, which the transform has, too | UQ16.16, unsigned 47 |
//! | 64, 65 | axes u, v: size, repeat << 14, texel bits << 15 | unsigned 19 |
//! | 66     | filter level: scale, shift << 24, levels << 30 | unsigned 35 |
//! | 67, 68, 69 | displacement: minimum, range, exponent | signed 32, 26, 6 |
//! | 70     | pixel: scale, shift << 24 | unsigned 30 |
//! | 71 .. 75, 76 | ramp, ambient: red, green << 18, blue << 36 | UQ1.16 each |
//! | 77     | specular, shininess << 17 | unsigned 25 |
//! | 78, 79 | light: direction, colour | 3 x SQ1.16, 3 x UQ2.16 |
//! | 80     | culls, skips << 1, passes << 2, minima << 3; halves of the viewport << 8, << 32 | Bits; 2 x UQ16.8 |
//! | 81     | reach, margin << 17; all ones after a reset, held inverted | 2 x UQ15.2 |

use crate::prelude::*;

/// The registers.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Constants {
    pub clock: Input<ClockReset>,
    pub write: Input<Bit>,
    pub index: Input<U<7>>,
    pub value: Input<S<63>>,
    pub focal: Output<U<32>>,
    pub z0: Output<S<47>>,
    pub axis_u: Output<U<19>>,
    pub axis_v: Output<U<19>>,
    pub level: Output<U<35>>,
    pub minimum: Output<S<32>>,
    pub range: Output<S<26>>,
    pub exponent: Output<S<6>>,
    pub pixel: Output<U<30>>,
    pub ramp_0: Output<Lanes<3, 18>>,
    pub ramp_1: Output<Lanes<3, 18>>,
    pub ramp_2: Output<Lanes<3, 18>>,
    pub ramp_3: Output<Lanes<3, 18>>,
    pub ramp_4: Output<Lanes<3, 18>>,
    pub ambient: Output<Lanes<3, 18>>,
    pub shine: Output<U<25>>,
    pub direction: Output<Lanes<3, 18>>,
    pub colour: Output<Lanes<3, 20>>,
    pub culls: Output<Bit>,
    pub skips: Output<Bit>,
    pub passes: Output<Bit>,
    pub minima: Output<Bit>,
    pub half_width: Output<U<24>>,
    pub half_height: Output<U<24>>,
    pub reach: Output<U<17>>,
    pub margin: Output<U<17>>,
    focal_held: Register<U<32>>,
    z0_held: Register<S<47>>,
    axis_u_held: Register<U<19>>,
    axis_v_held: Register<U<19>>,
    level_held: Register<U<35>>,
    minimum_held: Register<S<32>>,
    range_held: Register<S<26>>,
    exponent_held: Register<S<6>>,
    pixel_held: Register<U<30>>,
    ramp_0_held: Register<Lanes<3, 18>>,
    ramp_1_held: Register<Lanes<3, 18>>,
    ramp_2_held: Register<Lanes<3, 18>>,
    ramp_3_held: Register<Lanes<3, 18>>,
    ramp_4_held: Register<Lanes<3, 18>>,
    ambient_held: Register<Lanes<3, 18>>,
    shine_held: Register<U<25>>,
    direction_held: Register<Lanes<3, 18>>,
    colour_held: Register<Lanes<3, 20>>,
    draw_held: Register<U<56>>,
    reach_held: Register<U<34>>,
    reaches: Wire<U<34>>,
    bits: Wire<U<63>>,
    three: Wire<Lanes<3, 18>>,
    three_1: Wire<Lanes<3, 18>>,
    three_2: Wire<Lanes<3, 18>>,
    wide_1: Wire<Lanes<3, 20>>,
    wide_2: Wire<Lanes<3, 20>>,
    wide: Wire<Lanes<3, 20>>,
}

impl Logic for Constants {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, focal_held, z0_held, axis_u_held, axis_v_held, level_held, minimum_held, range_held);
        dff_setup!(self, clock, exponent_held, pixel_held, ramp_0_held, ramp_1_held, ramp_2_held, ramp_3_held);
        dff_setup!(self, clock, ramp_4_held, ambient_held, shine_held, direction_held, colour_held, draw_held);
        dff_setup!(self, clock, reach_held);
        self.focal.next = self.focal_held.q.val();
        self.z0.next = self.z0_held.q.val();
        self.axis_u.next = self.axis_u_held.q.val();
        self.axis_v.next = self.axis_v_held.q.val();
        self.level.next = self.level_held.q.val();
        self.minimum.next = self.minimum_held.q.val();
        self.range.next = self.range_held.q.val();
        self.exponent.next = self.exponent_held.q.val();
        self.pixel.next = self.pixel_held.q.val();
        self.ramp_0.next = self.ramp_0_held.q.val();
        self.ramp_1.next = self.ramp_1_held.q.val();
        self.ramp_2.next = self.ramp_2_held.q.val();
        self.ramp_3.next = self.ramp_3_held.q.val();
        self.ramp_4.next = self.ramp_4_held.q.val();
        self.ambient.next = self.ambient_held.q.val();
        self.shine.next = self.shine_held.q.val();
        self.direction.next = self.direction_held.q.val();
        self.colour.next = self.colour_held.q.val();
        self.culls.next = self.draw_held.q.val().get_bit(0);
        self.skips.next = self.draw_held.q.val().get_bit(1);
        self.passes.next = self.draw_held.q.val().get_bit(2);
        self.minima.next = self.draw_held.q.val().get_bit(3);
        self.half_width.next = self.draw_held.q.val().get_bits::<24>(8);
        self.half_height.next = self.draw_held.q.val().get_bits::<24>(32);
        self.reaches.next = !self.reach_held.q.val();
        self.reach.next = self.reaches.val().get_bits::<17>(0);
        self.margin.next = self.reaches.val().get_bits::<17>(17);

        self.bits.next = bit_cast_to::<U<63>>(self.value.val());
        self.three_1.next = bit_cast_to::<Lanes<3, 18>>(bit_cast_to::<S<18>>(self.bits.val().get_bits::<18>(0)));
        self.three_2.next = self.three_1.val().replace_bit(1, bit_cast_to::<S<18>>(self.bits.val().get_bits::<18>(18)));
        self.three.next = self.three_2.val().replace_bit(2, bit_cast_to::<S<18>>(self.bits.val().get_bits::<18>(36)));
        self.wide_1.next = bit_cast_to::<Lanes<3, 20>>(bit_cast_to::<S<20>>(self.bits.val().get_bits::<20>(0)));
        self.wide_2.next = self.wide_1.val().replace_bit(1, bit_cast_to::<S<20>>(self.bits.val().get_bits::<20>(20)));
        self.wide.next = self.wide_2.val().replace_bit(2, bit_cast_to::<S<20>>(self.bits.val().get_bits::<20>(40)));
        if self.write.val() {
            if self.index.val() == 9 {
                self.focal_held.d.next = bit_cast_to::<U<32>>(self.value.val());
            } else if self.index.val() == 35 {
                self.z0_held.d.next = bit_cast_to::<S<47>>(self.value.val());
            } else if self.index.val() == 64 {
                self.axis_u_held.d.next = bit_cast_to::<U<19>>(self.value.val());
            } else if self.index.val() == 65 {
                self.axis_v_held.d.next = bit_cast_to::<U<19>>(self.value.val());
            } else if self.index.val() == 66 {
                self.level_held.d.next = bit_cast_to::<U<35>>(self.value.val());
            } else if self.index.val() == 67 {
                self.minimum_held.d.next = bit_cast_to::<S<32>>(self.value.val());
            } else if self.index.val() == 68 {
                self.range_held.d.next = bit_cast_to::<S<26>>(self.value.val());
            } else if self.index.val() == 69 {
                self.exponent_held.d.next = bit_cast_to::<S<6>>(self.value.val());
            } else if self.index.val() == 70 {
                self.pixel_held.d.next = bit_cast_to::<U<30>>(self.value.val());
            } else if self.index.val() == 71 {
                self.ramp_0_held.d.next = self.three.val();
            } else if self.index.val() == 72 {
                self.ramp_1_held.d.next = self.three.val();
            } else if self.index.val() == 73 {
                self.ramp_2_held.d.next = self.three.val();
            } else if self.index.val() == 74 {
                self.ramp_3_held.d.next = self.three.val();
            } else if self.index.val() == 75 {
                self.ramp_4_held.d.next = self.three.val();
            } else if self.index.val() == 76 {
                self.ambient_held.d.next = self.three.val();
            } else if self.index.val() == 77 {
                self.shine_held.d.next = bit_cast_to::<U<25>>(self.value.val());
            } else if self.index.val() == 78 {
                self.direction_held.d.next = self.three.val();
            } else if self.index.val() == 79 {
                self.colour_held.d.next = self.wide.val();
            } else if self.index.val() == 80 {
                self.draw_held.d.next = bit_cast_to::<U<56>>(self.value.val());
            } else if self.index.val() == 81 {
                self.reach_held.d.next = !bit_cast_to::<U<34>>(self.value.val());
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("constants")
    }
}

watched! { [] Constants: write, index, value; ; focal_held, z0_held, axis_u_held, axis_v_held, level_held, minimum_held, range_held, exponent_held, pixel_held, ramp_0_held, ramp_1_held, ramp_2_held, ramp_3_held, ramp_4_held, ambient_held, shine_held, direction_held, colour_held, draw_held, reach_held }
