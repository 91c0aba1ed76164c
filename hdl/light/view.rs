// SPDX-License-Identifier: MIT OR Apache-2.0
//! The direction from a point on the screen to the eye.
//!
//! `view = (-X' pixel, -Y' pixel, -1)` to length 1
//!
//! | port          | format         | meaning |   Latency 57, interval 1; holds while `go` is low
//! | x0, y0        | SQ13.8         | pixels   Golden: models::light::view
//! | scale, shift  | unsigned 24, 6 | size of a pixel at distance 1: scale 2^-shift, shift 16 ..= 48
//! | view          | 3 x SQ1.16     | |
//!
//! | stage            | operation                                  | width |
//! | s1 .. s6         | x0 and y0 times scale                       | signed 46: below 2^45 |
//! | s7 .. s9_slope   | shifted left by 8 and right by shift - 16: 1.0 is 2^32 | signed 54 |
//! | s10 .. s24       | negated, with z = 2^32, to 16 bits         | |
//! | s25 .. s57       | to length 1                                | SQ1.16 |

use crate::pipeline::{Delay, Product2x2, ShiftRight};
use crate::prelude::*;
use crate::rsqrt::{Shorten, UnitVector};

/// Direction to the eye.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct View {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub x0: Input<S<22>>,
    pub y0: Input<S<22>>,
    pub scale: Input<U<24>>,
    pub shift: Input<U<6>>,
    pub view: Output<Lanes<3, 18>>,
    s6_x: Product2x2<22, 25, 46>,
    s6_y: Product2x2<22, 25, 46>,
    s6_amount: Delay<6, 6>,
    s9_x: ShiftRight<54>,
    s9_y: ShiftRight<54>,
    s24_short: Shorten,
    s57_unit: UnitVector,
    b: Wire<S<25>>,
    negated: Constant<Bit>,
    /// Shorten has 16 bits more below.
    one: Constant<WideS<92>>,
}

impl Default for View {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            x0: Input::default(),
            y0: Input::default(),
            scale: Input::default(),
            shift: Input::default(),
            view: Output::default(),
            s6_x: Product2x2::default(),
            s6_y: Product2x2::default(),
            s6_amount: Delay::default(),
            s9_x: ShiftRight::default(),
            s9_y: ShiftRight::default(),
            s24_short: Shorten::default(),
            s57_unit: UnitVector::default(),
            b: Wire::default(),
            negated: Constant::new(true),
            one: Constant::new(WideS::new(1 << 48)),
        }
    }
}

impl View {
    /// Cycles from position to direction.
    pub const LATENCY: usize = 57;
}

impl Logic for View {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s6_x, s6_y, s6_amount, s9_x, s9_y, s24_short, s57_unit);
        self.view.next = self.s57_unit.unit.val();
        self.b.next = bit_cast_to::<S<25>>(self.scale.val());
        self.s6_x.go.next = self.go.val();
        self.s6_x.a.next = self.x0.val();
        self.s6_x.b.next = self.b.val();
        self.s6_y.go.next = self.go.val();
        self.s6_y.a.next = self.y0.val();
        self.s6_y.b.next = self.b.val();
        self.s6_amount.go.next = self.go.val();
        self.s6_amount.value.next = self.shift.val() - 16;
        self.s9_x.go.next = self.go.val();
        self.s9_x.value.next = bit_cast_to::<WideS<54>>(self.s6_x.p.val()) << 8;
        self.s9_x.amount.next = self.s6_amount.delayed.val();
        self.s9_y.go.next = self.go.val();
        self.s9_y.value.next = bit_cast_to::<WideS<54>>(self.s6_y.p.val()) << 8;
        self.s9_y.amount.next = self.s6_amount.delayed.val();
        self.s24_short.go.next = self.go.val();
        self.s24_short.along_x.next = bit_cast_to::<S<54>>(self.s9_x.shifted.val());
        self.s24_short.along_y.next = bit_cast_to::<S<54>>(self.s9_y.shifted.val());
        self.s24_short.along_z.next = self.one.val();
        self.s24_short.flip.next = self.negated.val();
        self.s57_unit.go.next = self.go.val();
        self.s57_unit.components.next = self.s24_short.shortened.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("view")
    }
}

latches! { [] View: s6_x, s6_y, s6_amount, s9_x, s9_y, s24_short, s57_unit }
