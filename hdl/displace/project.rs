// SPDX-License-Identifier: MIT OR Apache-2.0
//! One coordinate of the displaced vertex in pixels.
//!
//! | stage             | operation                       | width    |   Latency 34, interval 1; holds while `go` is low
//! | s1 .. s8_product  | along f                         | signed 78 |
//! | s9_moved          | 4 X + (along f >> 24)           | signed 55, 20 fraction bits |
//! | s10_moved          | what is beyond 2^51 is 2^51     | signed 52: divided by at most 2^17, that is still beyond the screen |
//! | s11 .. s21         | it waits for the reciprocal     | |
//! | s22 .. s29_product | moved times reciprocal         | signed 84 |
//! | s30 .. s32_shift  | >> 62 - zeros                   | by 35 ..= 59: signed 49 |
//! | s33_pixel         | one more bit, rounded half up   | |
//! | s34_pixel         | SQ13.8, or beyond               | signed 22 |
//!
//! `displacement` and `focal` come at the beginning, `position` eight cycles and `reciprocal` and `zeros` twenty-one cycles later.

use crate::pipeline::{Delay, Product3x2, ShiftRight};
use crate::prelude::*;

/// Projection of one coordinate.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Project {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// SQ16.28.
    pub displacement: Input<S<46>>,
    /// UQ16.16.
    pub focal: Input<U<32>>,
    /// The bits of a lane, SQ13.18 pixels.
    pub position: Input<U<32>>,
    pub reciprocal: Input<U<32>>,
    pub zeros: Input<U<6>>,
    pub pixel: Output<S<22>>,
    pub beyond: Output<Bit>,
    s8_product: Product3x2<46, 33, 79>,
    s9_moved: DataRegister<S<55>>,
    s10_moved: DataRegister<S<52>>,
    s21_moved: Delay<52, 11>,
    s29_product: Product3x2<52, 33, 85>,
    s29_amount: Delay<6, 8>,
    s32_shift: ShiftRight<85>,
    s33_pixel: DataRegister<S<50>>,
    s34_pixel: DataRegister<S<22>>,
    s34_beyond: DataRegister<Bit>,
    upper: Wire<U<4>>,
    rounded: Wire<S<50>>,
    above: Wire<U<29>>,
    most: Constant<S<52>>,
    least: Constant<S<52>>,
}

impl Default for Project {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            displacement: Input::default(),
            focal: Input::default(),
            position: Input::default(),
            reciprocal: Input::default(),
            zeros: Input::default(),
            pixel: Output::default(),
            beyond: Output::default(),
            s8_product: Product3x2::default(),
            s9_moved: DataRegister::default(),
            s10_moved: DataRegister::default(),
            s21_moved: Delay::default(),
            s29_product: Product3x2::default(),
            s29_amount: Delay::default(),
            s32_shift: ShiftRight::default(),
            s33_pixel: DataRegister::default(),
            s34_pixel: DataRegister::default(),
            s34_beyond: DataRegister::default(),
            upper: Wire::default(),
            rounded: Wire::default(),
            above: Wire::default(),
            most: Constant::new(S::MAX),
            least: Constant::new(S::MIN),
        }
    }
}

impl Project {
    /// Cycles from displacement to pixel.
    pub const LATENCY: usize = 34;
}

impl Logic for Project {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s8_product, s21_moved, s29_product, s29_amount, s32_shift);
        dff_setup!(self, clock, s9_moved, s10_moved, s33_pixel, s34_pixel, s34_beyond);
        self.pixel.next = self.s34_pixel.q.val();
        self.beyond.next = self.s34_beyond.q.val();
        self.s8_product.go.next = self.go.val();
        self.s8_product.a.next = self.displacement.val();
        self.s8_product.b.next = bit_cast_to::<S<33>>(self.focal.val());
        self.s21_moved.go.next = self.go.val();
        self.s21_moved.value.next = bit_cast_to::<U<52>>(self.s10_moved.q.val());
        self.s29_product.go.next = self.go.val();
        self.s29_product.a.next = bit_cast_to::<S<52>>(self.s21_moved.delayed.val());
        self.s29_product.b.next = bit_cast_to::<S<33>>(self.reciprocal.val());
        self.s29_amount.go.next = self.go.val();
        self.s29_amount.value.next = !self.zeros.val() - 1;
        self.s32_shift.go.next = self.go.val();
        self.s32_shift.value.next = self.s29_product.p.val();
        self.s32_shift.amount.next = self.s29_amount.delayed.val();

        // Sign and the bits that have to equal it.
        self.upper.next = self.s9_moved.q.val().get_bits::<4>(51);
        self.rounded.next = (bit_cast_to::<S<50>>(self.s32_shift.shifted.val()) + 1) >> 1;
        self.above.next = self.s33_pixel.q.val().get_bits::<29>(21);
        if self.go.val() {
            self.s9_moved.d.next = (bit_cast_to::<S<55>>(bit_cast_to::<S<32>>(self.position.val())) << 2)
                + bit_cast_to::<S<55>>(self.s8_product.p.val() >> 24);
            self.s10_moved.d.next = bit_cast_to::<S<52>>(self.s9_moved.q.val());
            if self.upper.val().get_bit(3) && !self.upper.val().all() {
                self.s10_moved.d.next = self.least.val();
            } else if !self.upper.val().get_bit(3) && self.upper.val().any() {
                self.s10_moved.d.next = self.most.val();
            }
            self.s33_pixel.d.next = self.rounded.val();
            self.s34_pixel.d.next = bit_cast_to::<S<22>>(self.s33_pixel.q.val());
            self.s34_beyond.d.next = self.above.val().any() && !self.above.val().all();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("displace_project")
    }
}

latches! { [] Project: s8_product, s9_moved, s10_moved, s21_moved, s29_product, s29_amount, s32_shift, s33_pixel, s34_pixel, s34_beyond }
