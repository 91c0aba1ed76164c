// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lights a triangle: ambient, diffuse and Blinn-Phong (Blinn 1977), and a colour that follows the height.
//!
//! ```text
//! colour = albedo ambient + light (albedo max(0, N.L) + specular max(0, N.H)^shininess)      H = (L + V) / |L + V|
//! ```
//!
//! | port         | format        | meaning |   Latency 146, interval 1
//! | in_normal    | 3 x SQ1.16    | N, towards the eye
//! | in_position  | 2 x SQ13.8    | X', Y' of a vertex, from which V leads to the eye
//! | in_heights   | 3 x signed 25 | UQ16.8 of the three vertices; below 0 counts as 0, above 65535.0 as that
//! | in_scale, in_shift | unsigned 24, 6 | size of a pixel at distance 1: scale 2^-shift, shift 16 ..= 48
//! | in_ramp_0 .. in_ramp_4, in_ambient | 3 x signed 18 | red, green, blue of the heights 0, 1/4, .., 1, and of the sky: UQ1.16, 0 ..= 1.0
//! | in_specular, in_shininess | UQ1.16, unsigned 8 | at most 1.0; at least 1
//! | in_direction | 3 x SQ1.16    | L, towards the light
//! | in_colour    | 3 x signed 20 | of the light: UQ2.16, 0 ..= 4.0
//! | out_colour   | unsigned 24   | red lowest, 8 bits each   Golden: models::light::shade with one light
//!
//! The constants of the draw travel with the triangle, so a result is a function of its beat; a ramp only to its albedo.
//!
//! | stage         | operation                                     | part |
//! | s1            | the input                                     | |
//! | s2 .. s58     | V                                             | [`View`] |
//! | s59, s60 .. s102 | L + V, H                                   | [`Normalize`] |
//! | s2 .. s6      | N.L; without it N is zero from s7 on          | [`Cosine`] |
//! | s103 .. s107  | N.H                                           | [`Cosine`] |
//! | s108 .. s134  | to the power of the shininess                 | [`Raise`] |
//! | s135 .. s137  | times specular                                | |
//! | s2 .. s8      | mean height                                   | [`Height`] |
//! | s9 .. s145    | the colour                                    | [`Channel`], three times |
//!
//! A flow counts up to 127 stages; the first 45 are counted before it.
//!
//! Example: a white light along N, albedo 0.5, nothing else: 128 in each channel.

mod channel;
mod cosine;
mod height;
mod view;

pub use channel::Channel;
pub use cosine::Cosine;
pub use height::Height;
pub use view::View;

use crate::pipeline::{DspProduct, FarDelay, Flow, LongVectorDelay, VectorDelay};
use crate::power::Raise;
use crate::prelude::*;
use crate::rsqrt::Normalize;

/// Light.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Light {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_normal: Input<Lanes<3, 18>>,
    pub in_position: Input<Lanes<2, 22>>,
    pub in_heights: Input<Lanes<3, 25>>,
    pub in_scale: Input<U<24>>,
    pub in_shift: Input<U<6>>,
    pub in_ramp_0: Input<Lanes<3, 18>>,
    pub in_ramp_1: Input<Lanes<3, 18>>,
    pub in_ramp_2: Input<Lanes<3, 18>>,
    pub in_ramp_3: Input<Lanes<3, 18>>,
    pub in_ramp_4: Input<Lanes<3, 18>>,
    pub in_ambient: Input<Lanes<3, 18>>,
    pub in_specular: Input<U<17>>,
    pub in_shininess: Input<U<8>>,
    pub in_direction: Input<Lanes<3, 18>>,
    pub in_colour: Input<Lanes<3, 20>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_colour: Output<U<24>>,
    s1_x: DataRegister<S<22>>,
    s1_y: DataRegister<S<22>>,
    s1_normal: DataRegister<Lanes<3, 18>>,
    s1_heights: DataRegister<Lanes<3, 25>>,
    s1_ambient: DataRegister<Lanes<3, 18>>,
    s1_direction: DataRegister<Lanes<3, 18>>,
    s1_colour: DataRegister<Lanes<3, 20>>,
    s1_scale: DataRegister<U<24>>,
    s1_shift: DataRegister<U<6>>,
    s1_specular: DataRegister<U<17>>,
    s1_shininess: DataRegister<U<8>>,
    s1_ramp_0: DataRegister<Lanes<3, 18>>,
    s1_ramp_1: DataRegister<Lanes<3, 18>>,
    s1_ramp_2: DataRegister<Lanes<3, 18>>,
    s1_ramp_3: DataRegister<Lanes<3, 18>>,
    s1_ramp_4: DataRegister<Lanes<3, 18>>,
    s58_view: View,
    s52_direction: LongVectorDelay<18, 17, 17, 17>,
    s58_direction: VectorDelay<18, 6>,
    s59_half: DataRegister<Lanes<3, 32>>,
    s102_half: Normalize,
    s6_diffuse: Cosine,
    s6_normal: VectorDelay<18, 5>,
    s7_normal: DataRegister<Lanes<3, 18>>,
    s54_normal: LongVectorDelay<18, 15, 16, 16>,
    s102_normal: LongVectorDelay<18, 16, 16, 16>,
    s107_cosine: Cosine,
    s107_shininess: FarDelay<8, 12, 10>,
    s134_shine: Raise,
    s134_specular: FarDelay<17, 15, 13>,
    s137_highlight: DspProduct<18, 18, 36>,
    s134_diffuse: FarDelay<17, 14, 16>,
    s8_height: Height,
    s145_red: Channel,
    s145_green: Channel,
    s145_blue: Channel,
    /// Stages that hold a beat, before those of the flow.
    before: Register<WideU<45>>,
    flow: Flow<{ Light::STAGES - 45 }, 24>,
    go: Wire<Bit>,
    highlight: Wire<U<34>>,
    red_ramp_0: Wire<S<18>>,
    red_ramp_1: Wire<S<18>>,
    red_ramp_2: Wire<S<18>>,
    red_ramp_3: Wire<S<18>>,
    red_ramp_4: Wire<S<18>>,
    red_ambient: Wire<S<18>>,
    green_ramp_0: Wire<S<18>>,
    green_ramp_1: Wire<S<18>>,
    green_ramp_2: Wire<S<18>>,
    green_ramp_3: Wire<S<18>>,
    green_ramp_4: Wire<S<18>>,
    green_ambient: Wire<S<18>>,
    blue_ramp_0: Wire<S<18>>,
    blue_ramp_1: Wire<S<18>>,
    blue_ramp_2: Wire<S<18>>,
    blue_ramp_3: Wire<S<18>>,
    blue_ramp_4: Wire<S<18>>,
    blue_ambient: Wire<S<18>>,
    red_light: Wire<S<20>>,
    green_light: Wire<S<20>>,
    blue_light: Wire<S<20>>,
    none: Constant<Lanes<3, 18>>,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_normal: Input::default(),
            in_position: Input::default(),
            in_heights: Input::default(),
            in_scale: Input::default(),
            in_shift: Input::default(),
            in_ramp_0: Input::default(),
            in_ramp_1: Input::default(),
            in_ramp_2: Input::default(),
            in_ramp_3: Input::default(),
            in_ramp_4: Input::default(),
            in_ambient: Input::default(),
            in_specular: Input::default(),
            in_shininess: Input::default(),
            in_direction: Input::default(),
            in_colour: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_colour: Output::default(),
            s1_x: DataRegister::default(),
            s1_y: DataRegister::default(),
            s1_normal: DataRegister::default(),
            s1_heights: DataRegister::default(),
            s1_ambient: DataRegister::default(),
            s1_direction: DataRegister::default(),
            s1_colour: DataRegister::default(),
            s1_scale: DataRegister::default(),
            s1_shift: DataRegister::default(),
            s1_specular: DataRegister::default(),
            s1_shininess: DataRegister::default(),
            s1_ramp_0: DataRegister::default(),
            s1_ramp_1: DataRegister::default(),
            s1_ramp_2: DataRegister::default(),
            s1_ramp_3: DataRegister::default(),
            s1_ramp_4: DataRegister::default(),
            s58_view: View::default(),
            s52_direction: LongVectorDelay::default(),
            s58_direction: VectorDelay::default(),
            s59_half: DataRegister::default(),
            s102_half: Normalize::default(),
            s6_diffuse: Cosine::default(),
            s6_normal: VectorDelay::default(),
            s7_normal: DataRegister::default(),
            s54_normal: LongVectorDelay::default(),
            s102_normal: LongVectorDelay::default(),
            s107_cosine: Cosine::default(),
            s107_shininess: FarDelay::default(),
            s134_shine: Raise::default(),
            s134_specular: FarDelay::default(),
            s137_highlight: DspProduct::default(),
            s134_diffuse: FarDelay::default(),
            s8_height: Height::default(),
            s145_red: Channel::default(),
            s145_green: Channel::default(),
            s145_blue: Channel::default(),
            before: Register::default(),
            flow: Flow::default(),
            go: Wire::default(),
            highlight: Wire::default(),
            red_ramp_0: Wire::default(),
            red_ramp_1: Wire::default(),
            red_ramp_2: Wire::default(),
            red_ramp_3: Wire::default(),
            red_ramp_4: Wire::default(),
            red_ambient: Wire::default(),
            green_ramp_0: Wire::default(),
            green_ramp_1: Wire::default(),
            green_ramp_2: Wire::default(),
            green_ramp_3: Wire::default(),
            green_ramp_4: Wire::default(),
            green_ambient: Wire::default(),
            blue_ramp_0: Wire::default(),
            blue_ramp_1: Wire::default(),
            blue_ramp_2: Wire::default(),
            blue_ramp_3: Wire::default(),
            blue_ramp_4: Wire::default(),
            blue_ambient: Wire::default(),
            red_light: Wire::default(),
            green_light: Wire::default(),
            blue_light: Wire::default(),
            none: Constant::new(Lanes::default()),
        }
    }
}

impl Light {
    const STAGES: usize = 145;
    /// Cycles from triangle to colour.
    pub const LATENCY: usize = Self::STAGES + 1;
}

impl Logic for Light {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self,
            clock,
            s58_view,
            s52_direction,
            s58_direction,
            s102_half,
            s6_diffuse,
            s6_normal,
            s54_normal,
            s102_normal,
            s107_cosine,
            s107_shininess,
            s134_shine,
            s134_specular,
            s137_highlight,
            s134_diffuse,
            s8_height,
            s145_red,
            s145_green,
            s145_blue,
            flow
        );
        dff_setup!(
            self,
            clock,
            s1_x,
            s1_y,
            s1_normal,
            s1_heights,
            s1_ambient,
            s1_direction,
            s1_colour,
            s1_scale,
            s1_shift,
            s1_specular,
            s1_shininess,
            s1_ramp_0,
            s1_ramp_1,
            s1_ramp_2,
            s1_ramp_3,
            s1_ramp_4,
            s59_half,
            s7_normal,
            before
        );
        self.go.next = self.flow.go.val();
        self.in_ready.next = self.go.val();
        self.flow.in_valid.next = self.before.q.val().get_bit(44);

        // s2 to s102
        self.s58_view.go.next = self.go.val();
        self.s58_view.x0.next = self.s1_x.q.val();
        self.s58_view.y0.next = self.s1_y.q.val();
        self.s58_view.scale.next = self.s1_scale.q.val();
        self.s58_view.shift.next = self.s1_shift.q.val();
        self.s52_direction.go.next = self.go.val();
        self.s52_direction.value.next = self.s1_direction.q.val();
        self.s58_direction.go.next = self.go.val();
        self.s58_direction.value.next = self.s52_direction.delayed.val();
        self.s102_half.go.next = self.go.val();
        self.s102_half.components.next = self.s59_half.q.val();

        // s2 to s107: without diffuse light there is no highlight, and the normal is none.
        self.s6_diffuse.go.next = self.go.val();
        self.s6_diffuse.a.next = self.s1_normal.q.val();
        self.s6_diffuse.b.next = self.s1_direction.q.val();
        self.s6_normal.go.next = self.go.val();
        self.s6_normal.value.next = self.s1_normal.q.val();
        self.s54_normal.go.next = self.go.val();
        self.s54_normal.value.next = self.s7_normal.q.val();
        self.s102_normal.go.next = self.go.val();
        self.s102_normal.value.next = self.s54_normal.delayed.val();
        self.s107_cosine.go.next = self.go.val();
        self.s107_cosine.a.next = self.s102_normal.delayed.val();
        self.s107_cosine.b.next = self.s102_half.unit.val();

        // s108 to s137
        self.s107_shininess.go.next = self.go.val();
        self.s107_shininess.value.next = self.s1_shininess.q.val();
        self.s134_shine.go.next = self.go.val();
        self.s134_shine.base.next = self.s107_cosine.cosine.val();
        self.s134_shine.exponent.next = self.s107_shininess.delayed.val();
        self.s134_specular.go.next = self.go.val();
        self.s134_specular.value.next = self.s1_specular.q.val();
        self.s137_highlight.go.next = self.go.val();
        self.s137_highlight.a.next = bit_cast_to::<S<18>>(self.s134_shine.power.val());
        self.s137_highlight.b.next = bit_cast_to::<S<18>>(self.s134_specular.delayed.val());
        self.s134_diffuse.go.next = self.go.val();
        self.s134_diffuse.value.next = self.s6_diffuse.cosine.val();
        self.highlight.next = bit_cast_to::<U<34>>(self.s137_highlight.p.val());

        // the colours
        self.s8_height.go.next = self.go.val();
        self.s8_height.heights.next = self.s1_heights.q.val();
        self.red_ramp_0.next = self.s1_ramp_0.q.val().get_bit(0);
        self.red_ramp_1.next = self.s1_ramp_1.q.val().get_bit(0);
        self.red_ramp_2.next = self.s1_ramp_2.q.val().get_bit(0);
        self.red_ramp_3.next = self.s1_ramp_3.q.val().get_bit(0);
        self.red_ramp_4.next = self.s1_ramp_4.q.val().get_bit(0);
        self.red_ambient.next = self.s1_ambient.q.val().get_bit(0);
        self.red_light.next = self.s1_colour.q.val().get_bit(0);
        self.s145_red.go.next = self.go.val();
        self.s145_red.ramp_0.next = bit_cast_to::<U<17>>(self.red_ramp_0.val());
        self.s145_red.ramp_1.next = bit_cast_to::<U<17>>(self.red_ramp_1.val());
        self.s145_red.ramp_2.next = bit_cast_to::<U<17>>(self.red_ramp_2.val());
        self.s145_red.ramp_3.next = bit_cast_to::<U<17>>(self.red_ramp_3.val());
        self.s145_red.ramp_4.next = bit_cast_to::<U<17>>(self.red_ramp_4.val());
        self.s145_red.ambient.next = bit_cast_to::<U<17>>(self.red_ambient.val());
        self.s145_red.light.next = bit_cast_to::<U<19>>(self.red_light.val());
        self.s145_red.at.next = self.s8_height.at.val();
        self.s145_red.along.next = self.s8_height.along.val();
        self.s145_red.diffuse.next = self.s134_diffuse.delayed.val();
        self.s145_red.highlight.next = self.highlight.val();
        self.green_ramp_0.next = self.s1_ramp_0.q.val().get_bit(1);
        self.green_ramp_1.next = self.s1_ramp_1.q.val().get_bit(1);
        self.green_ramp_2.next = self.s1_ramp_2.q.val().get_bit(1);
        self.green_ramp_3.next = self.s1_ramp_3.q.val().get_bit(1);
        self.green_ramp_4.next = self.s1_ramp_4.q.val().get_bit(1);
        self.green_ambient.next = self.s1_ambient.q.val().get_bit(1);
        self.green_light.next = self.s1_colour.q.val().get_bit(1);
        self.s145_green.go.next = self.go.val();
        self.s145_green.ramp_0.next = bit_cast_to::<U<17>>(self.green_ramp_0.val());
        self.s145_green.ramp_1.next = bit_cast_to::<U<17>>(self.green_ramp_1.val());
        self.s145_green.ramp_2.next = bit_cast_to::<U<17>>(self.green_ramp_2.val());
        self.s145_green.ramp_3.next = bit_cast_to::<U<17>>(self.green_ramp_3.val());
        self.s145_green.ramp_4.next = bit_cast_to::<U<17>>(self.green_ramp_4.val());
        self.s145_green.ambient.next = bit_cast_to::<U<17>>(self.green_ambient.val());
        self.s145_green.light.next = bit_cast_to::<U<19>>(self.green_light.val());
        self.s145_green.at.next = self.s8_height.at.val();
        self.s145_green.along.next = self.s8_height.along.val();
        self.s145_green.diffuse.next = self.s134_diffuse.delayed.val();
        self.s145_green.highlight.next = self.highlight.val();
        self.blue_ramp_0.next = self.s1_ramp_0.q.val().get_bit(2);
        self.blue_ramp_1.next = self.s1_ramp_1.q.val().get_bit(2);
        self.blue_ramp_2.next = self.s1_ramp_2.q.val().get_bit(2);
        self.blue_ramp_3.next = self.s1_ramp_3.q.val().get_bit(2);
        self.blue_ramp_4.next = self.s1_ramp_4.q.val().get_bit(2);
        self.blue_ambient.next = self.s1_ambient.q.val().get_bit(2);
        self.blue_light.next = self.s1_colour.q.val().get_bit(2);
        self.s145_blue.go.next = self.go.val();
        self.s145_blue.ramp_0.next = bit_cast_to::<U<17>>(self.blue_ramp_0.val());
        self.s145_blue.ramp_1.next = bit_cast_to::<U<17>>(self.blue_ramp_1.val());
        self.s145_blue.ramp_2.next = bit_cast_to::<U<17>>(self.blue_ramp_2.val());
        self.s145_blue.ramp_3.next = bit_cast_to::<U<17>>(self.blue_ramp_3.val());
        self.s145_blue.ramp_4.next = bit_cast_to::<U<17>>(self.blue_ramp_4.val());
        self.s145_blue.ambient.next = bit_cast_to::<U<17>>(self.blue_ambient.val());
        self.s145_blue.light.next = bit_cast_to::<U<19>>(self.blue_light.val());
        self.s145_blue.at.next = self.s8_height.at.val();
        self.s145_blue.along.next = self.s8_height.along.val();
        self.s145_blue.diffuse.next = self.s134_diffuse.delayed.val();
        self.s145_blue.highlight.next = self.highlight.val();

        if self.go.val() {
            self.before.d.next = (self.before.q.val() << 1) | bit_cast_to::<WideU<45>>(self.in_valid.val());
            self.s1_x.d.next = self.in_position.val().get_bit(0);
            self.s1_y.d.next = self.in_position.val().get_bit(1);
            self.s1_normal.d.next = self.in_normal.val();
            self.s1_heights.d.next = self.in_heights.val();
            self.s1_ambient.d.next = self.in_ambient.val();
            self.s1_direction.d.next = self.in_direction.val();
            self.s1_colour.d.next = self.in_colour.val();
            self.s1_ramp_0.d.next = self.in_ramp_0.val();
            self.s1_ramp_1.d.next = self.in_ramp_1.val();
            self.s1_ramp_2.d.next = self.in_ramp_2.val();
            self.s1_ramp_3.d.next = self.in_ramp_3.val();
            self.s1_ramp_4.d.next = self.in_ramp_4.val();
            self.s1_scale.d.next = self.in_scale.val();
            self.s1_shift.d.next = self.in_shift.val();
            self.s1_specular.d.next = self.in_specular.val();
            self.s1_shininess.d.next = self.in_shininess.val();
            self.s7_normal.d.next = self.s6_normal.delayed.val();
            if self.s6_diffuse.cosine.val() == 0 {
                self.s7_normal.d.next = self.none.val();
            }
            self.s59_half.d.next = bit_cast_to::<Lanes<3, 32>>(self.s58_view.view.val())
                + bit_cast_to::<Lanes<3, 32>>(self.s58_direction.delayed.val());
        }

        self.flow.value.next = bit_cast_to::<WideU<24>>(self.s145_red.colour.val())
            | (bit_cast_to::<WideU<24>>(self.s145_green.colour.val()) << 8)
            | (bit_cast_to::<WideU<24>>(self.s145_blue.colour.val()) << 16);
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_colour.next = bit_cast_to::<U<24>>(self.flow.out_value.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("light")
    }
}

ports! {
    [] Light {
        inputs: in_valid, in_normal, in_position, in_heights, in_scale, in_shift, in_ramp_0, in_ramp_1, in_ramp_2, in_ramp_3, in_ramp_4, in_ambient, in_specular, in_shininess, in_direction, in_colour, out_ready;
        outputs: in_ready, out_valid, out_colour;
        blocks: s58_view, s52_direction, s58_direction, s102_half, s6_diffuse, s6_normal, s54_normal, s102_normal, s107_cosine, s107_shininess, s134_shine, s134_specular, s137_highlight, s134_diffuse, s8_height, s145_red, s145_green, s145_blue, flow;
        state: s58_view, s52_direction, s58_direction, s102_half, s6_diffuse, s6_normal, s54_normal, s102_normal, s107_cosine, s107_shininess, s134_shine, s134_specular, s137_highlight, s134_diffuse, s8_height, s145_red, s145_green, s145_blue, flow, s1_x, s1_y, s1_normal, s1_heights, s1_ambient, s1_direction, s1_colour, s1_scale, s1_shift, s1_specular, s1_shininess, s1_ramp_0, s1_ramp_1, s1_ramp_2, s1_ramp_3, s1_ramp_4, s59_half, s7_normal, before
    }
}
