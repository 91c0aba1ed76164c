// SPDX-License-Identifier: MIT OR Apache-2.0
//! 1 / c^2, as 17 bits and an exponent.
//!
//! `1 / c^2 = square 2^(k - 16 - 2 length)`, where c has `length` bits; k is 1 if the square has 34 bits, and otherwise 0
//!
//! | port     | format      | meaning |   Latency 26, interval 1; holds while `go` is low
//! | c        | signed 32   | below 1 counts as 1
//! | square   | unsigned 17 | the leading one is set
//! | exponent | signed 8    | 65 - 2 zeros - k, where zeros = 48 - length: -30 ..= 31
//!
//! | stage      | operation                            | width |
//! | s1 .. s22  | reciprocal of c                      | UQ0.32 |
//! | s23 .. s25 | square of its upper 17 bits          | 34 bits |
//! | s26        | 17 bits of it; 65 - 2 zeros - k      | |

use crate::pipeline::DspProduct;
use crate::prelude::*;
use crate::reciprocal::Inverse;

/// Inverse square of a register.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct InverseSquare {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub c: Input<S<32>>,
    pub square: Output<U<17>>,
    pub exponent: Output<S<8>>,
    s22_inverse: Inverse,
    s25_square: DspProduct<18, 18, 36>,
    s23_exponent: DataRegister<S<8>>,
    s24_exponent: DataRegister<S<8>>,
    s25_exponent: DataRegister<S<8>>,
    s26_square: DataRegister<U<17>>,
    s26_exponent: DataRegister<S<8>>,
    root: Wire<S<18>>,
    /// The square has 34 bits, not 33: k.
    whole: Wire<Bit>,
    most: Constant<S<8>>,
}

impl Default for InverseSquare {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            c: Input::default(),
            square: Output::default(),
            exponent: Output::default(),
            s22_inverse: Inverse::default(),
            s25_square: DspProduct::default(),
            s23_exponent: DataRegister::default(),
            s24_exponent: DataRegister::default(),
            s25_exponent: DataRegister::default(),
            s26_square: DataRegister::default(),
            s26_exponent: DataRegister::default(),
            root: Wire::default(),
            whole: Wire::default(),
            most: Constant::new(S::new(65)),
        }
    }
}

impl InverseSquare {
    /// Cycles from lane to square.
    pub const LATENCY: usize = Inverse::LATENCY + DspProduct::<18, 18, 36>::LATENCY + 1;
}

impl Logic for InverseSquare {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s22_inverse, s25_square);
        dff_setup!(self, clock, s23_exponent, s24_exponent, s25_exponent, s26_square, s26_exponent);
        self.square.next = self.s26_square.q.val();
        self.exponent.next = self.s26_exponent.q.val();
        self.s22_inverse.go.next = self.go.val();
        self.s22_inverse.c.next = self.c.val();
        self.root.next = bit_cast_to::<S<18>>(self.s22_inverse.reciprocal.val().get_bits::<17>(15));
        self.s25_square.go.next = self.go.val();
        self.s25_square.a.next = self.root.val();
        self.s25_square.b.next = self.root.val();
        self.whole.next = self.s25_square.p.val().get_bit(33);
        if self.go.val() {
            self.s23_exponent.d.next = self.most.val() - (bit_cast_to::<S<8>>(self.s22_inverse.zeros.val()) << 1);
            self.s24_exponent.d.next = self.s23_exponent.q.val();
            self.s25_exponent.d.next = self.s24_exponent.q.val();
            self.s26_exponent.d.next = self.s25_exponent.q.val() - bit_cast_to::<S<8>>(self.whole.val());
            self.s26_square.d.next = self.s25_square.p.val().get_bits::<17>(16);
            if self.whole.val() {
                self.s26_square.d.next = self.s25_square.p.val().get_bits::<17>(17);
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("inverse_square")
    }
}

latches! { [] InverseSquare: s22_inverse, s25_square, s23_exponent, s24_exponent, s25_exponent, s26_square, s26_exponent }
