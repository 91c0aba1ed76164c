// SPDX-License-Identifier: MIT OR Apache-2.0
//! Normal of a displaced triangle in view space, towards the viewer, without a division.
//!
//! ```text
//! Nx = dc1 dy2 - dc2 dy1    Ny = dx1 dc2 - dx2 dc1    A = dx1 dy2 - dx2 dy1    Nz = A c0 - Nx x0 - Ny y0
//! ```
//!
//! with differences to vertex 0, Nz times the size of a pixel, towards the eye (A > 0 points away), and to length 1.
//!
//! | port       | format        | meaning |   Latency 82, interval 1
//! | in_x, in_y | 3 x SQ13.8    | X', Y' of the three vertices, pixels
//! | in_c       | 3 x signed 32 | c', UQ0.31: at least 0
//! | in_scale, in_shift | unsigned 24, 6 | size of a pixel at distance 1: scale 2^-shift, shift 16 ..= 48
//! | out_normal | 3 x SQ1.16    | (0, 0, -1.0) without area   Golden: models::face_normal::golden
//!
//! The constants of the draw travel with the triangle, so a result is a function of its beat.
//!
//! | stage      | operation                        | part |
//! | s1         | the input                        | |
//! | s2         | differences                      | |
//! | s3 .. s10  | Nx, Ny, A                        | [`Cross`], three times |
//! | s11 .. s33 | Nz                               | [`Depth`] |
//! | s34 .. s48 | towards the eye, and to 16 bits  | [`Shorten`] |
//! | s49 .. s81 | to length 1                      | [`UnitVector`] |
//!
//! Example: c' equal at all three vertices (a plane at one depth): N = (0, 0, -1).

mod cross;
mod depth;
mod moment;

pub use cross::Cross;
pub use depth::Depth;
pub use moment::Moment;

use crate::pipeline::{Delay, Flow, LongDelay};
use crate::prelude::*;
use crate::rsqrt::{Shorten, UnitVector};

/// Face normal.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct FaceNormal {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_x: Input<Lanes<3, 22>>,
    pub in_y: Input<Lanes<3, 22>>,
    pub in_c: Input<Lanes<3, 32>>,
    pub in_scale: Input<U<24>>,
    pub in_shift: Input<U<6>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_normal: Output<Lanes<3, 18>>,
    s1_x: DataRegister<Lanes<3, 22>>,
    s1_y: DataRegister<Lanes<3, 22>>,
    s1_c: DataRegister<Lanes<3, 32>>,
    s1_scale: DataRegister<U<24>>,
    s1_shift: DataRegister<U<6>>,
    s2_x1: DataRegister<S<23>>,
    s2_x2: DataRegister<S<23>>,
    s2_y1: DataRegister<S<23>>,
    s2_y2: DataRegister<S<23>>,
    s2_c1: DataRegister<S<32>>,
    s2_c2: DataRegister<S<32>>,
    s10_nx: Cross,
    s10_ny: Cross,
    s10_area: Cross,
    s10_x: Delay<22, 9>,
    s10_y: Delay<22, 9>,
    s10_c: Delay<32, 9>,
    s21_scale: LongDelay<24, 6, 7, 7>,
    s30_amount: LongDelay<6, 9, 10, 10>,
    s33_depth: Depth,
    s33_nx: LongDelay<54, 7, 8, 8>,
    s33_ny: LongDelay<54, 7, 8, 8>,
    s11_away: DataRegister<Bit>,
    s33_away: LongDelay<1, 7, 7, 8>,
    s48_short: Shorten,
    s81_unit: UnitVector,
    flow: Flow<{ FaceNormal::STAGES }, 54>,
    go: Wire<Bit>,
    x_0: Wire<S<22>>,
    x_1: Wire<S<22>>,
    x_2: Wire<S<22>>,
    y_0: Wire<S<22>>,
    y_1: Wire<S<22>>,
    y_2: Wire<S<22>>,
    c_0: Wire<S<32>>,
    c_1: Wire<S<32>>,
    c_2: Wire<S<32>>,
    unit_x: Wire<S<18>>,
    unit_y: Wire<S<18>>,
    unit_z: Wire<S<18>>,
    out_x: Wire<S<18>>,
    out_y: Wire<S<18>>,
    out_z: Wire<S<18>>,
    out_xs: Wire<Lanes<3, 18>>,
    out_ys: Wire<Lanes<3, 18>>,
}

impl FaceNormal {
    const STAGES: usize = 81;
    /// Cycles from triangle to normal.
    pub const LATENCY: usize = Self::STAGES + 1;
}

impl Logic for FaceNormal {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self, clock, s10_nx, s10_ny, s10_area, s10_x, s10_y, s10_c, s21_scale, s30_amount, s33_depth, s33_nx,
            s33_ny, s33_away, s48_short, s81_unit, flow
        );
        dff_setup!(
            self, clock, s1_x, s1_y, s1_c, s1_scale, s1_shift, s2_x1, s2_x2, s2_y1, s2_y2, s2_c1, s2_c2, s11_away
        );
        self.go.next = self.flow.go.val();
        self.flow.in_valid.next = self.in_valid.val();
        self.in_ready.next = self.go.val();

        // s2
        self.x_0.next = self.s1_x.q.val().get_bit(0);
        self.x_1.next = self.s1_x.q.val().get_bit(1);
        self.x_2.next = self.s1_x.q.val().get_bit(2);
        self.y_0.next = self.s1_y.q.val().get_bit(0);
        self.y_1.next = self.s1_y.q.val().get_bit(1);
        self.y_2.next = self.s1_y.q.val().get_bit(2);
        self.c_0.next = self.s1_c.q.val().get_bit(0);
        self.c_1.next = self.s1_c.q.val().get_bit(1);
        self.c_2.next = self.s1_c.q.val().get_bit(2);

        // s3 to s10
        self.s10_nx.go.next = self.go.val();
        self.s10_nx.a1.next = self.s2_c1.q.val();
        self.s10_nx.b1.next = self.s2_y1.q.val();
        self.s10_nx.a2.next = self.s2_c2.q.val();
        self.s10_nx.b2.next = self.s2_y2.q.val();
        self.s10_ny.go.next = self.go.val();
        self.s10_ny.a1.next = self.s2_c2.q.val();
        self.s10_ny.b1.next = self.s2_x2.q.val();
        self.s10_ny.a2.next = self.s2_c1.q.val();
        self.s10_ny.b2.next = self.s2_x1.q.val();
        self.s10_area.go.next = self.go.val();
        self.s10_area.a1.next = bit_cast_to::<S<32>>(self.s2_x1.q.val());
        self.s10_area.b1.next = self.s2_y1.q.val();
        self.s10_area.a2.next = bit_cast_to::<S<32>>(self.s2_x2.q.val());
        self.s10_area.b2.next = self.s2_y2.q.val();
        self.s10_x.go.next = self.go.val();
        self.s10_x.value.next = bit_cast_to::<U<22>>(self.x_0.val());
        self.s10_y.go.next = self.go.val();
        self.s10_y.value.next = bit_cast_to::<U<22>>(self.y_0.val());
        self.s10_c.go.next = self.go.val();
        self.s10_c.value.next = bit_cast_to::<U<32>>(self.c_0.val());

        // s11 to s33
        self.s21_scale.go.next = self.go.val();
        self.s21_scale.value.next = self.s1_scale.q.val();
        self.s30_amount.go.next = self.go.val();
        self.s30_amount.value.next = self.s1_shift.q.val() - 16;
        self.s33_depth.go.next = self.go.val();
        self.s33_depth.nx.next = self.s10_nx.area.val();
        self.s33_depth.ny.next = self.s10_ny.area.val();
        self.s33_depth.area.next = self.s10_area.area.val();
        self.s33_depth.x0.next = bit_cast_to::<S<22>>(self.s10_x.delayed.val());
        self.s33_depth.y0.next = bit_cast_to::<S<22>>(self.s10_y.delayed.val());
        self.s33_depth.c0.next = bit_cast_to::<S<32>>(self.s10_c.delayed.val());
        self.s33_depth.scale.next = self.s21_scale.delayed.val();
        self.s33_depth.amount.next = self.s30_amount.delayed.val();
        self.s33_nx.go.next = self.go.val();
        self.s33_nx.value.next = bit_cast_to::<U<54>>(self.s10_nx.area.val());
        self.s33_ny.go.next = self.go.val();
        self.s33_ny.value.next = bit_cast_to::<U<54>>(self.s10_ny.area.val());
        self.s33_away.go.next = self.go.val();
        self.s33_away.value.next = bit_cast_to::<U<1>>(self.s11_away.q.val());

        // s34 to s81
        self.s48_short.go.next = self.go.val();
        self.s48_short.along_x.next = bit_cast_to::<S<54>>(self.s33_nx.delayed.val());
        self.s48_short.along_y.next = bit_cast_to::<S<54>>(self.s33_ny.delayed.val());
        self.s48_short.along_z.next = self.s33_depth.depth.val();
        self.s48_short.flip.next = self.s33_away.delayed.val().any();
        self.s81_unit.go.next = self.go.val();
        self.s81_unit.components.next = self.s48_short.shortened.val();

        if self.go.val() {
            self.s1_x.d.next = self.in_x.val();
            self.s1_y.d.next = self.in_y.val();
            self.s1_c.d.next = self.in_c.val();
            self.s1_scale.d.next = self.in_scale.val();
            self.s1_shift.d.next = self.in_shift.val();
            self.s2_x1.d.next = bit_cast_to::<S<23>>(self.x_1.val()) - bit_cast_to::<S<23>>(self.x_0.val());
            self.s2_x2.d.next = bit_cast_to::<S<23>>(self.x_2.val()) - bit_cast_to::<S<23>>(self.x_0.val());
            self.s2_y1.d.next = bit_cast_to::<S<23>>(self.y_1.val()) - bit_cast_to::<S<23>>(self.y_0.val());
            self.s2_y2.d.next = bit_cast_to::<S<23>>(self.y_2.val()) - bit_cast_to::<S<23>>(self.y_0.val());
            self.s2_c1.d.next = self.c_1.val() - self.c_0.val();
            self.s2_c2.d.next = self.c_2.val() - self.c_0.val();
            self.s11_away.d.next = self.s10_area.area.val() > 0;
        }

        self.unit_x.next = self.s81_unit.unit.val().get_bit(0);
        self.unit_y.next = self.s81_unit.unit.val().get_bit(1);
        self.unit_z.next = self.s81_unit.unit.val().get_bit(2);
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
        module_name("face_normal")
    }
}

ports! {
    [] FaceNormal {
        inputs: in_valid, in_x, in_y, in_c, in_scale, in_shift, out_ready;
        outputs: in_ready, out_valid, out_normal;
        blocks: s10_nx, s10_ny, s10_area, s10_x, s10_y, s10_c, s21_scale, s30_amount, s33_depth, s33_nx, s33_ny, s33_away, s48_short, s81_unit, flow;
        state: s10_nx, s10_ny, s10_area, s10_x, s10_y, s10_c, s21_scale, s30_amount, s33_depth, s33_nx, s33_ny, s33_away, s48_short, s81_unit, flow, s1_x, s1_y, s1_c, s1_scale, s1_shift, s2_x1, s2_x2, s2_y1, s2_y2, s2_c1, s2_c2, s11_away
    }
}
