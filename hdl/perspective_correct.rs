// SPDX-License-Identifier: MIT OR Apache-2.0
//! Texel coordinates of a vertex: the division by c, and the snap that closes seams.
//!
//! ```text
//! u = (u c) / c, rounded half up to 16 fraction bits; v likewise
//! repeat: u >= period - 2^-6 : u -= period (twice at most)            then |u| <= 2^-6 : u = 0
//! clamp:  |u| <= 2^-6 : u = 0;   u >= size - 1 - 2^-6 : u = size - 1
//! ```
//!
//! | port                | format     | meaning |   Latency 38, interval 1
//! | in_u, in_v          | SQ0.31     | lanes u c and v c, of 2^texel_bits texels; below 0 counts as 0
//! | in_c                | SQ0.31     | lane c; below 1 unit counts as 1 unit
//! | in_width, in_height | unsigned 14 | texels of level 0, 1 ..= 8192
//! | in_repeat_u, in_repeat_v | Bit   | the axis repeats
//! | in_texel_bits_u, in_texel_bits_v | unsigned 4 | 1 ..= 15
//! | out_u, out_v        | UQ13.16    | [0, period) repeating, [0, size - 1] clamped
//!
//! The constants of the draw travel with the vertex, so a result is a function of its beat. Golden:
//! models::perspective_correct::golden. Error before the snap: 1/2 unit and 2^-30.7 of the value.
//!
//! Example: texel_bits = 9, u c = c - 1 unit, c = 0x4000_0000: u = 512 - 2^-21 -> 512.0 -> 0 on a period of 512.

mod texel_axis;

pub use texel_axis::TexelAxis;

use crate::pipeline::{Flow, LongDelay};
use crate::prelude::*;
use crate::reciprocal::Inverse;

/// Perspective correction.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct PerspectiveCorrect {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_u: Input<S<32>>,
    pub in_v: Input<S<32>>,
    pub in_c: Input<S<32>>,
    pub in_width: Input<U<14>>,
    pub in_height: Input<U<14>>,
    pub in_repeat_u: Input<Bit>,
    pub in_repeat_v: Input<Bit>,
    pub in_texel_bits_u: Input<U<4>>,
    pub in_texel_bits_v: Input<U<4>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_u: Output<U<29>>,
    pub out_v: Output<U<29>>,
    /// 1 / c, from s1 to s22.
    inverse: Inverse,
    s1_u: DataRegister<U<31>>,
    s1_v: DataRegister<U<31>>,
    /// Size, repeat << 14, texel bits << 15.
    s1_axis_u: DataRegister<U<19>>,
    s1_axis_v: DataRegister<U<19>>,
    s22_u: LongDelay<50, 7, 7, 7>,
    s22_v: LongDelay<50, 7, 7, 7>,
    axis_u: TexelAxis,
    axis_v: TexelAxis,
    flow: Flow<{ Inverse::LATENCY + TexelAxis::LATENCY }, 58>,
    go: Wire<Bit>,
}

impl PerspectiveCorrect {
    /// Cycles from vertex to coordinates: those of the inverse and of an axis, and the one behind its last.
    pub const LATENCY: usize = Inverse::LATENCY + TexelAxis::LATENCY + 1;
}

impl Logic for PerspectiveCorrect {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, inverse, s22_u, s22_v, axis_u, axis_v, flow);
        dff_setup!(self, clock, s1_u, s1_v, s1_axis_u, s1_axis_v);
        self.go.next = self.flow.go.val();
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.go.val();
        self.inverse.go.next = self.go.val();
        self.inverse.c.next = self.in_c.val();

        // s1: rounding in the remesher may leave -1 for 0.
        if self.go.val() {
            self.s1_u.d.next = bit_cast_to::<U<31>>(self.in_u.val());
            if self.in_u.val() < 0 {
                self.s1_u.d.next = 0.into();
            }
            self.s1_v.d.next = bit_cast_to::<U<31>>(self.in_v.val());
            if self.in_v.val() < 0 {
                self.s1_v.d.next = 0.into();
            }
            self.s1_axis_u.d.next = bit_cast_to::<U<19>>(self.in_width.val())
                | (bit_cast_to::<U<19>>(self.in_repeat_u.val()) << 14)
                | (bit_cast_to::<U<19>>(self.in_texel_bits_u.val()) << 15);
            self.s1_axis_v.d.next = bit_cast_to::<U<19>>(self.in_height.val())
                | (bit_cast_to::<U<19>>(self.in_repeat_v.val()) << 14)
                | (bit_cast_to::<U<19>>(self.in_texel_bits_v.val()) << 15);
        }
        self.s22_u.go.next = self.go.val();
        self.s22_u.value.next =
            (bit_cast_to::<U<50>>(self.s1_axis_u.q.val()) << 31) | bit_cast_to::<U<50>>(self.s1_u.q.val());
        self.s22_v.go.next = self.go.val();
        self.s22_v.value.next =
            (bit_cast_to::<U<50>>(self.s1_axis_v.q.val()) << 31) | bit_cast_to::<U<50>>(self.s1_v.q.val());

        self.axis_u.go.next = self.go.val();
        self.axis_u.lane.next = self.s22_u.delayed.val().get_bits::<31>(0);
        self.axis_u.size.next = self.s22_u.delayed.val().get_bits::<14>(31);
        self.axis_u.repeats.next = self.s22_u.delayed.val().get_bit(45);
        self.axis_u.texel_bits.next = self.s22_u.delayed.val().get_bits::<4>(46);
        self.axis_u.reciprocal.next = self.inverse.reciprocal.val();
        self.axis_u.zeros.next = self.inverse.zeros.val();
        self.axis_v.go.next = self.go.val();
        self.axis_v.lane.next = self.s22_v.delayed.val().get_bits::<31>(0);
        self.axis_v.size.next = self.s22_v.delayed.val().get_bits::<14>(31);
        self.axis_v.repeats.next = self.s22_v.delayed.val().get_bit(45);
        self.axis_v.texel_bits.next = self.s22_v.delayed.val().get_bits::<4>(46);
        self.axis_v.reciprocal.next = self.inverse.reciprocal.val();
        self.axis_v.zeros.next = self.inverse.zeros.val();

        self.flow.value.next = bit_cast_to::<WideU<58>>(self.axis_u.texel.val())
            | (bit_cast_to::<WideU<58>>(self.axis_v.texel.val()) << 29);
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_u.next = self.flow.out_value.val().get_bits::<29>(0);
        self.out_v.next = self.flow.out_value.val().get_bits::<29>(29);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("perspective_correct")
    }
}

ports! {
    [] PerspectiveCorrect {
        inputs: in_valid, in_u, in_v, in_c, in_width, in_height, in_repeat_u, in_repeat_v, in_texel_bits_u, in_texel_bits_v,
            out_ready;
        outputs: in_ready, out_valid, out_u, out_v;
        blocks: inverse, s22_u, s22_v, axis_u, axis_v, flow;
        state: inverse, s1_u, s1_v, s1_axis_u, s1_axis_v, s22_u, s22_v, axis_u, axis_v, flow
    }
}
