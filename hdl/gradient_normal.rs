// SPDX-License-Identifier: MIT OR Apache-2.0
//! Normal of a displaced surface at a vertex, from the slopes of the patch between four texels, without a division.
//!
//! ```text
//! N ~ n - d_u grad u - d_v grad v
//! d_u = k ((1 - b)(t10 - t00) + b (t11 - t01)) / 2^level      d_v = k ((1 - a)(t01 - t00) + a (t11 - t10)) / 2^level
//! ```
//!
//! | port       | format        | meaning |   Latency 73, interval 1
//! | in_t00, in_t10, in_t01, in_t11 | unsigned 16 | the texels |
//! | in_a, in_b | UQ0.12        | weights of the second column and row |
//! | in_level   | unsigned 4    | level of the texels |
//! | in_normal, in_gradient_u, in_gradient_v | 3 x SQ0.31 | n c, grad u c, grad v c: c > 0 changes nothing but rounding |
//! | in_scale, in_shift | signed 18, unsigned 6 | k times the unit of the gradients: scale 2^-shift, shift 16 ..= 48 |
//! | out_normal | 3 x SQ1.16    | (0, 0, -1.0) without direction   Golden: models::gradient_normal::golden
//!
//! The constants of the draw travel with the vertex, so a result is a function of its beat.
//!
//! | stage      | operation                          | part |
//! | s1         | the input                          | |
//! | s2, s3     | differences, and their difference  | |
//! | s4 .. s16  | slopes, which saturate at 16384    | [`Slope`], twice |
//! | s17 .. s24 | n - slopes times gradients         | [`Tilt`], three times |
//! | s25 .. s39 | to 16 bits                         | [`Shorten`] |
//! | s40 .. s72 | to length 1                        | [`UnitVector`] |
//!
//! Example: four equal texels: N = n.

mod slope;
mod tilt;

pub use slope::Slope;
pub use tilt::Tilt;

use crate::pipeline::{Delay, Flow, VectorDelay};
use crate::prelude::*;
use crate::rsqrt::{Shorten, UnitVector};

/// Gradient normal.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct GradientNormal {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_t00: Input<U<16>>,
    pub in_t10: Input<U<16>>,
    pub in_t01: Input<U<16>>,
    pub in_t11: Input<U<16>>,
    pub in_a: Input<U<12>>,
    pub in_b: Input<U<12>>,
    pub in_level: Input<U<4>>,
    pub in_normal: Input<Lanes<3, 32>>,
    pub in_gradient_u: Input<Lanes<3, 32>>,
    pub in_gradient_v: Input<Lanes<3, 32>>,
    pub in_scale: Input<S<18>>,
    pub in_shift: Input<U<6>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_normal: Output<Lanes<3, 18>>,
    s1_t00: DataRegister<S<17>>,
    s1_t10: DataRegister<S<17>>,
    s1_t01: DataRegister<S<17>>,
    s1_t11: DataRegister<S<17>>,
    s1_a: DataRegister<U<12>>,
    s1_b: DataRegister<U<12>>,
    s1_level: DataRegister<U<4>>,
    s1_normal: DataRegister<Lanes<3, 32>>,
    s1_gradient_u: DataRegister<Lanes<3, 32>>,
    s1_gradient_v: DataRegister<Lanes<3, 32>>,
    s1_scale: DataRegister<S<18>>,
    s1_shift: DataRegister<U<6>>,
    /// t10 - t00, t11 - t01, and t01 - t00.
    s2_upper: DataRegister<S<17>>,
    s2_lower: DataRegister<S<17>>,
    s2_left: DataRegister<S<17>>,
    s2_a: DataRegister<U<12>>,
    s2_b: DataRegister<U<12>>,
    s2_level: DataRegister<U<4>>,
    s2_shift: DataRegister<U<6>>,
    s3_upper: DataRegister<S<17>>,
    s3_left: DataRegister<S<17>>,
    s3_twist: DataRegister<S<18>>,
    s3_a: DataRegister<U<12>>,
    s3_b: DataRegister<U<12>>,
    s3_amount: DataRegister<U<6>>,
    s7_scale: Delay<18, 6>,
    s12_amount: Delay<6, 9>,
    s16_u: Slope,
    s16_v: Slope,
    s16_gradient_u: VectorDelay<32, 15>,
    s16_gradient_v: VectorDelay<32, 15>,
    s12_normal: VectorDelay<32, 11>,
    s23_normal: VectorDelay<32, 11>,
    s24_x: Tilt,
    s24_y: Tilt,
    s24_z: Tilt,
    s39_short: Shorten,
    s72_unit: UnitVector,
    flow: Flow<{ GradientNormal::STAGES }, 54>,
    go: Wire<Bit>,
    unit_x: Wire<S<18>>,
    unit_y: Wire<S<18>>,
    unit_z: Wire<S<18>>,
    out_x: Wire<S<18>>,
    out_y: Wire<S<18>>,
    out_z: Wire<S<18>>,
    out_xs: Wire<Lanes<3, 18>>,
    out_ys: Wire<Lanes<3, 18>>,
}

impl GradientNormal {
    const STAGES: usize = 72;
    /// Cycles from vertex to normal.
    pub const LATENCY: usize = Self::STAGES + 1;
}

impl Logic for GradientNormal {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self,
            clock,
            s7_scale,
            s12_amount,
            s16_u,
            s16_v,
            s16_gradient_u,
            s16_gradient_v,
            s12_normal,
            s23_normal,
            s24_x,
            s24_y,
            s24_z,
            s39_short,
            s72_unit,
            flow
        );
        dff_setup!(self, clock, s1_t00, s1_t10, s1_t01, s1_t11, s1_a, s1_b, s1_level, s1_normal, s1_gradient_u);
        dff_setup!(self, clock, s1_gradient_v, s1_scale, s1_shift, s2_upper, s2_lower, s2_left, s2_a, s2_b, s2_level);
        dff_setup!(self, clock, s2_shift, s3_upper, s3_left, s3_twist, s3_a, s3_b, s3_amount);
        self.go.next = self.flow.go.val();
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.go.val();

        // s4 to s16
        self.s7_scale.go.next = self.go.val();
        self.s7_scale.value.next = bit_cast_to::<U<18>>(self.s1_scale.q.val());
        self.s12_amount.go.next = self.go.val();
        self.s12_amount.value.next = self.s3_amount.q.val();
        self.s16_u.go.next = self.go.val();
        self.s16_u.difference.next = self.s3_upper.q.val();
        self.s16_u.twist.next = self.s3_twist.q.val();
        self.s16_u.weight.next = self.s3_b.q.val();
        self.s16_u.scale.next = bit_cast_to::<S<18>>(self.s7_scale.delayed.val());
        self.s16_u.amount.next = self.s12_amount.delayed.val();
        self.s16_v.go.next = self.go.val();
        self.s16_v.difference.next = self.s3_left.q.val();
        self.s16_v.twist.next = self.s3_twist.q.val();
        self.s16_v.weight.next = self.s3_a.q.val();
        self.s16_v.scale.next = bit_cast_to::<S<18>>(self.s7_scale.delayed.val());
        self.s16_v.amount.next = self.s12_amount.delayed.val();

        // s17 to s24
        self.s16_gradient_u.go.next = self.go.val();
        self.s16_gradient_u.value.next = self.s1_gradient_u.q.val();
        self.s16_gradient_v.go.next = self.go.val();
        self.s16_gradient_v.value.next = self.s1_gradient_v.q.val();
        self.s12_normal.go.next = self.go.val();
        self.s12_normal.value.next = self.s1_normal.q.val();
        self.s23_normal.go.next = self.go.val();
        self.s23_normal.value.next = self.s12_normal.delayed.val();
        self.s24_x.go.next = self.go.val();
        self.s24_x.slope_u.next = self.s16_u.slope.val();
        self.s24_x.slope_v.next = self.s16_v.slope.val();
        self.s24_x.along_u.next = self.s16_gradient_u.delayed.val().get_bit(0);
        self.s24_x.along_v.next = self.s16_gradient_v.delayed.val().get_bit(0);
        self.s24_x.normal.next = self.s23_normal.delayed.val().get_bit(0);
        self.s24_y.go.next = self.go.val();
        self.s24_y.slope_u.next = self.s16_u.slope.val();
        self.s24_y.slope_v.next = self.s16_v.slope.val();
        self.s24_y.along_u.next = self.s16_gradient_u.delayed.val().get_bit(1);
        self.s24_y.along_v.next = self.s16_gradient_v.delayed.val().get_bit(1);
        self.s24_y.normal.next = self.s23_normal.delayed.val().get_bit(1);
        self.s24_z.go.next = self.go.val();
        self.s24_z.slope_u.next = self.s16_u.slope.val();
        self.s24_z.slope_v.next = self.s16_v.slope.val();
        self.s24_z.along_u.next = self.s16_gradient_u.delayed.val().get_bit(2);
        self.s24_z.along_v.next = self.s16_gradient_v.delayed.val().get_bit(2);
        self.s24_z.normal.next = self.s23_normal.delayed.val().get_bit(2);

        // s25 to s72: x and y count 2^16 times as much there, and n is on the side that it is on.
        self.s39_short.go.next = self.go.val();
        self.s39_short.along_x.next = bit_cast_to::<S<54>>(self.s24_x.tilted.val());
        self.s39_short.along_y.next = bit_cast_to::<S<54>>(self.s24_y.tilted.val());
        self.s39_short.along_z.next = bit_cast_to::<WideS<92>>(self.s24_z.tilted.val()) << 16;
        self.s39_short.flip.next = false;
        self.s72_unit.go.next = self.go.val();
        self.s72_unit.components.next = self.s39_short.shortened.val();

        if self.go.val() {
            self.s1_t00.d.next = bit_cast_to::<S<17>>(self.in_t00.val());
            self.s1_t10.d.next = bit_cast_to::<S<17>>(self.in_t10.val());
            self.s1_t01.d.next = bit_cast_to::<S<17>>(self.in_t01.val());
            self.s1_t11.d.next = bit_cast_to::<S<17>>(self.in_t11.val());
            self.s1_a.d.next = self.in_a.val();
            self.s1_b.d.next = self.in_b.val();
            self.s1_level.d.next = self.in_level.val();
            self.s1_normal.d.next = self.in_normal.val();
            self.s1_gradient_u.d.next = self.in_gradient_u.val();
            self.s1_gradient_v.d.next = self.in_gradient_v.val();
            self.s1_scale.d.next = self.in_scale.val();
            self.s1_shift.d.next = self.in_shift.val();
            self.s2_upper.d.next = self.s1_t10.q.val() - self.s1_t00.q.val();
            self.s2_lower.d.next = self.s1_t11.q.val() - self.s1_t01.q.val();
            self.s2_left.d.next = self.s1_t01.q.val() - self.s1_t00.q.val();
            self.s2_a.d.next = self.s1_a.q.val();
            self.s2_b.d.next = self.s1_b.q.val();
            self.s2_level.d.next = self.s1_level.q.val();
            self.s2_shift.d.next = self.s1_shift.q.val() - 16;
            self.s3_upper.d.next = self.s2_upper.q.val();
            self.s3_left.d.next = self.s2_left.q.val();
            self.s3_twist.d.next =
                bit_cast_to::<S<18>>(self.s2_lower.q.val()) - bit_cast_to::<S<18>>(self.s2_upper.q.val());
            self.s3_a.d.next = self.s2_a.q.val();
            self.s3_b.d.next = self.s2_b.q.val();
            self.s3_amount.d.next = self.s2_shift.q.val() + bit_cast_to::<U<6>>(self.s2_level.q.val());
        }

        self.unit_x.next = self.s72_unit.unit.val().get_bit(0);
        self.unit_y.next = self.s72_unit.unit.val().get_bit(1);
        self.unit_z.next = self.s72_unit.unit.val().get_bit(2);
        self.flow.value.next = bit_cast_to::<WideU<54>>(bit_cast_to::<U<18>>(self.unit_x.val()))
            | (bit_cast_to::<WideU<54>>(bit_cast_to::<U<18>>(self.unit_y.val())) << 18)
            | (bit_cast_to::<WideU<54>>(bit_cast_to::<U<18>>(self.unit_z.val())) << 36);
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_x.next = bit_cast_to::<S<18>>(self.flow.out_value.val().get_bits::<18>(0));
        self.out_y.next = bit_cast_to::<S<18>>(self.flow.out_value.val().get_bits::<18>(18));
        self.out_z.next = bit_cast_to::<S<18>>(self.flow.out_value.val().get_bits::<18>(36));
        self.out_xs.next = bit_cast_to::<Lanes<3, 18>>(self.out_x.val());
        self.out_ys.next = self.out_xs.val().replace_bit(1, self.out_y.val());
        self.out_normal.next = self.out_ys.val().replace_bit(2, self.out_z.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("gradient_normal")
    }
}

ports! {
    [] GradientNormal {
        inputs: in_valid, in_t00, in_t10, in_t01, in_t11, in_a, in_b, in_level, in_normal, in_gradient_u, in_gradient_v, in_scale, in_shift, out_ready;
        outputs: in_ready, out_valid, out_normal;
        blocks: s7_scale, s12_amount, s16_u, s16_v, s16_gradient_u, s16_gradient_v, s12_normal, s23_normal, s24_x, s24_y, s24_z, s39_short, s72_unit, flow;
        state: s1_t00, s1_t10, s1_t01, s1_t11, s1_a, s1_b, s1_level, s1_normal, s1_gradient_u, s1_gradient_v, s1_scale, s1_shift, s2_upper, s2_lower, s2_left, s2_a, s2_b, s2_level, s2_shift, s3_upper, s3_left, s3_twist, s3_a, s3_b, s3_amount, s7_scale, s12_amount, s16_u, s16_v, s16_gradient_u, s16_gradient_v, s12_normal, s23_normal, s24_x, s24_y, s24_z, s39_short, s72_unit, flow
    }
}
