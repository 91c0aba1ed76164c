// SPDX-License-Identifier: MIT OR Apache-2.0
//! A product without its lower 16 bits, one bit of a factor a cycle.
//!
//! | port    | format      | meaning |   Latency 33: `done` is high in the cycle in which the product stands first
//! | start   | Bit         | takes the factors, while no product is under way |
//! | factor  | signed 48   | |
//! | by      | unsigned 32 | |
//! | product | signed 64   | floor(factor by / 2^16), until the next start   Error 0 |
//!
//! The sum loses its last bit in every cycle, so it is never longer than a factor and a bit; the bits that go push those of
//! `by` out of their register.

use crate::prelude::*;

/// Sequential multiplier.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct SerialProduct {
    pub clock: Input<ClockReset>,
    pub start: Input<Bit>,
    pub factor: Input<S<48>>,
    pub by: Input<U<32>>,
    pub done: Output<Bit>,
    pub product: Output<WideS<64>>,
    /// 33 and below: bits that are left, and one.
    left: Register<U<6>>,
    kept: DataRegister<S<48>>,
    /// Bits of `by` that are left, below those of the product that are ready.
    bits: DataRegister<U<32>>,
    upper: DataRegister<S<48>>,
    sum: Wire<S<49>>,
    steps: Constant<U<6>>,
}

impl Default for SerialProduct {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            start: Input::default(),
            factor: Input::default(),
            by: Input::default(),
            done: Output::default(),
            product: Output::default(),
            left: Register::default(),
            kept: DataRegister::default(),
            bits: DataRegister::default(),
            upper: DataRegister::default(),
            sum: Wire::default(),
            steps: Constant::new(U::new(Self::LATENCY as i64)),
        }
    }
}

impl SerialProduct {
    /// Cycles from the one in which `start` is high to the one in which `done` is.
    pub const LATENCY: usize = 33;
}

impl Logic for SerialProduct {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left, kept, bits, upper);
        self.done.next = self.left.q.val() == 1;
        self.product.next = (bit_cast_to::<WideS<64>>(self.upper.q.val()) << 16)
            | bit_cast_to::<WideS<64>>(self.bits.q.val().get_bits::<16>(16));
        // |upper| is at most half of |factor| and of itself.
        self.sum.next = bit_cast_to::<S<49>>(self.upper.q.val());
        if self.bits.q.val().get_bit(0) {
            self.sum.next = bit_cast_to::<S<49>>(self.upper.q.val()) + bit_cast_to::<S<49>>(self.kept.q.val());
        }
        if self.start.val() {
            self.left.d.next = self.steps.val();
            self.kept.d.next = self.factor.val();
            self.bits.d.next = self.by.val();
            self.upper.d.next = 0.into();
        } else if self.left.q.val().any() {
            self.left.d.next = self.left.q.val() - 1;
            if !self.done.val() {
                self.upper.d.next = bit_cast_to::<S<48>>(self.sum.val() >> 1);
                self.bits.d.next = (self.bits.q.val() >> 1) | (bit_cast_to::<U<32>>(self.sum.val().get_bit(0)) << 31);
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("serial_product")
    }
}

watched! { [] SerialProduct: start, factor, by;; left, kept, bits, upper }
