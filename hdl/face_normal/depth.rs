// SPDX-License-Identifier: MIT OR Apache-2.0
//! The third component of the normal, in the units of the other two.
//!
//! `depth = (A c0 - Nx x0 - Ny y0) scale 2^-(shift - 8)`
//!
//! | port        | format    | meaning |   Latency 23, interval 1, error 0 but for the floor; holds while `go` is low
//! | nx, ny      | signed 54 | |
//! | area        | signed 54, of 45 bits | |
//! | x0, y0, c0  | signed 22, 22, 32 | vertex 0 |
//! | scale       | unsigned 24 | 11 cycles later |
//! | amount      | unsigned 6  | shift - 16, 0 ..= 32; 20 cycles later |
//! | depth       | signed 92 | |
//!
//! | stage              | operation                       | width |
//! | s1 .. s9           | the three products              | signed 76 |
//! | s10, s11_determinant | their sum                     | at most 4 2^21 2^21 2^31: signed 76 |
//! | s12 .. s19, s20_scaled | times scale, from a lower and an upper part | signed 100 |
//! | s21 .. s23_depth   | shifted, by 8 first             | signed 92 |

use super::Moment;
use crate::pipeline::{Product2x2, Product3x2, ShiftRight};
use crate::prelude::*;

/// Third component.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Depth {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub nx: Input<S<54>>,
    pub ny: Input<S<54>>,
    pub area: Input<S<54>>,
    pub x0: Input<S<22>>,
    pub y0: Input<S<22>>,
    pub c0: Input<S<32>>,
    pub scale: Input<U<24>>,
    pub amount: Input<U<6>>,
    pub depth: Output<WideS<92>>,
    s9_x: Moment,
    s9_y: Moment,
    s8_c: Product3x2<45, 32, 76>,
    s9_c: DataRegister<WideS<76>>,
    s10_less_x: DataRegister<WideS<76>>,
    s10_y: DataRegister<WideS<76>>,
    s11_determinant: DataRegister<WideS<76>>,
    s19_low: Product3x2<52, 25, 77>,
    s12_upper: DataRegister<S<25>>,
    s13_upper: DataRegister<S<25>>,
    s12_scale: DataRegister<S<25>>,
    s13_scale: DataRegister<S<25>>,
    s19_high: Product2x2<25, 25, 49>,
    s20_scaled: DataRegister<WideS<100>>,
    s23_shift: ShiftRight<92>,
    late_scale: Wire<S<25>>,
}

impl Depth {
    /// Cycles from components to depth.
    pub const LATENCY: usize = 23;
}

impl Logic for Depth {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s9_x, s9_y, s8_c, s19_low, s19_high, s23_shift);
        dff_setup!(
            self,
            clock,
            s9_c,
            s10_less_x,
            s10_y,
            s11_determinant,
            s12_upper,
            s13_upper,
            s12_scale,
            s13_scale,
            s20_scaled
        );
        self.depth.next = self.s23_shift.shifted.val();

        // s1 to s9
        self.s9_x.go.next = self.go.val();
        self.s9_x.a.next = self.nx.val();
        self.s9_x.b.next = self.x0.val();
        self.s9_y.go.next = self.go.val();
        self.s9_y.a.next = self.ny.val();
        self.s9_y.b.next = self.y0.val();
        self.s8_c.go.next = self.go.val();
        self.s8_c.a.next = bit_cast_to::<S<45>>(self.area.val());
        self.s8_c.b.next = self.c0.val();

        // s12 to s20: three digits; the other two two cycles later, as their product takes two cycles less.
        self.late_scale.next = bit_cast_to::<S<25>>(self.scale.val());
        self.s19_low.go.next = self.go.val();
        self.s19_low.a.next = bit_cast_to::<S<52>>(bit_cast_to::<WideU<51>>(self.s11_determinant.q.val()));
        self.s19_low.b.next = self.late_scale.val();
        self.s19_high.go.next = self.go.val();
        self.s19_high.a.next = self.s13_upper.q.val();
        self.s19_high.b.next = self.s13_scale.q.val();

        // s21 to s23
        self.s23_shift.go.next = self.go.val();
        self.s23_shift.value.next = bit_cast_to::<WideS<92>>(self.s20_scaled.q.val() >> 8);
        self.s23_shift.amount.next = self.amount.val();

        if self.go.val() {
            self.s9_c.d.next = self.s8_c.p.val();
            self.s10_less_x.d.next = self.s9_c.q.val() - self.s9_x.p.val();
            self.s10_y.d.next = self.s9_y.p.val();
            self.s11_determinant.d.next = self.s10_less_x.q.val() - self.s10_y.q.val();
            self.s12_upper.d.next = bit_cast_to::<S<25>>(self.s11_determinant.q.val() >> 51);
            self.s13_upper.d.next = self.s12_upper.q.val();
            self.s12_scale.d.next = self.late_scale.val();
            self.s13_scale.d.next = self.s12_scale.q.val();
            self.s20_scaled.d.next = bit_cast_to::<WideS<100>>(self.s19_low.p.val())
                + (bit_cast_to::<WideS<100>>(self.s19_high.p.val()) << 51);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("depth")
    }
}

latches! { [] Depth: s9_x, s9_y, s8_c, s19_low, s19_high, s23_shift, s9_c, s10_less_x, s10_y, s11_determinant, s12_upper, s13_upper, s12_scale, s13_scale, s20_scaled }
