// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sequential divider: L signed numerators by one divisor, floor quotients and remainders, one bit a cycle.
//!
//! quotient = floor(x / y) mod 2^Q,  remainder = x - quotient * y,  0 <= remainder < y,  for y > 0
//!
//! | port        | format        | range                                      |   Latency Q + 2, interval Q + 3
//! | start       | Bit           | taken when `busy` is low                   |   Error 0
//! | high, low   | L x signed R, Q | x = high * 2^Q + low, low read as unsigned |   Example, Q = 4: x = -7, y = 2: high = -1,
//! | divisor     | signed R      | 0 < y, 2y < 2^(R-1)                        |   low = 9 -> quotient -4, remainder 1
//! | quotient    | L x signed Q  | valid from the cycle after `done` rose, until the next start |
//! | remainder   | L x signed R  | the same                                   |
//!
//! Non-restoring: the partial remainder r stays in [-y, y) while -y * 2^Q <= x < y * 2^Q, so 2r + bit fits R bits. For
//! a numerator beyond that the outputs mean nothing, but the divider ends after the same number of cycles.

use crate::prelude::*;

/// Divider of `L` numerators, quotients of `Q` bits, remainders of `R` bits.
#[derive(Clone, Debug, LogicBlock)]
pub struct Divider<const L: usize, const Q: usize, const R: usize> {
    /// Clock and reset.
    pub clock: Input<ClockReset>,
    /// Begins a division.
    pub start: Input<Bit>,
    /// Upper part of the numerators.
    pub high: Input<Lanes<L, R>>,
    /// Lower Q bits of the numerators.
    pub low: Input<Lanes<L, Q>>,
    /// The divisor, common to all lanes.
    pub divisor: Input<S<R>>,
    /// A division is under way.
    pub busy: Output<Bit>,
    /// High for the last cycle of a division; the results stand from the next cycle on.
    pub done: Output<Bit>,
    /// Floor quotients.
    pub quotient: Output<Lanes<L, Q>>,
    /// Remainders.
    pub remainder: Output<Lanes<L, R>>,
    count: Register<U<8>>,
    /// The count is not 0, or 1.
    working: Register<Bit>,
    last: Register<Bit>,
    partial: DataRegister<Lanes<L, R>>,
    bits: DataRegister<Lanes<L, Q>>,
    y: DataRegister<S<R>>,
    /// -y, so that a step is a choice and one addition.
    minus_y: DataRegister<S<R>>,
    sign: Wire<Lanes<L, R>>,
    doubled: Wire<Lanes<L, R>>,
    addend: Wire<Lanes<L, R>>,
    from: Wire<Lanes<L, R>>,
    one_r: Constant<Lanes<L, R>>,
    one_q: Constant<Lanes<L, Q>>,
    r_sign: Constant<U<8>>,
    q_sign: Constant<U<8>>,
    steps: Constant<U<8>>,
}

impl<const L: usize, const Q: usize, const R: usize> Default for Divider<L, Q, R> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            start: Input::default(),
            high: Input::default(),
            low: Input::default(),
            divisor: Input::default(),
            busy: Output::default(),
            done: Output::default(),
            quotient: Output::default(),
            remainder: Output::default(),
            count: Register::default(),
            working: Register::default(),
            last: Register::default(),
            partial: DataRegister::default(),
            bits: DataRegister::default(),
            y: DataRegister::default(),
            minus_y: DataRegister::default(),
            sign: Wire::default(),
            doubled: Wire::default(),
            addend: Wire::default(),
            from: Wire::default(),
            one_r: Constant::new(Lanes::new([1; L])),
            one_q: Constant::new(Lanes::new([1; L])),
            r_sign: Constant::new(U::new(R as i64 - 1)),
            q_sign: Constant::new(U::new(Q as i64 - 1)),
            steps: Constant::new(U::new(Q as i64 + 1)),
        }
    }
}

impl<const L: usize, const Q: usize, const R: usize> Divider<L, Q, R> {
    /// Cycles from the one in which `start` is taken to the one in which `done` is high.
    pub const LATENCY: usize = Q + 1;
}

impl<const L: usize, const Q: usize, const R: usize> Logic for Divider<L, Q, R> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, count, working, last, partial, bits, y, minus_y);
        self.busy.next = self.working.q.val();
        self.done.next = self.last.q.val();
        self.quotient.next = self.bits.q.val();
        self.remainder.next = self.partial.q.val();
        // All ones in the lanes whose partial remainder is negative.
        self.sign.next = self.partial.q.val() >> self.r_sign.val();
        self.doubled.next = (self.partial.q.val() << 1)
            | (bit_cast_to::<Lanes<L, R>>(self.bits.q.val() >> self.q_sign.val()) & self.one_r.val());
        self.addend.next = (bit_cast_to::<Lanes<L, R>>(self.y.q.val()) & self.sign.val())
            | (bit_cast_to::<Lanes<L, R>>(self.minus_y.q.val()) & !self.sign.val());
        // One addition a cycle: 2 r + bit -+ y, and at last y once more where the remainder is negative.
        self.from.next = self.doubled.val();
        if self.last.q.val() {
            self.from.next = self.partial.q.val();
            self.addend.next = bit_cast_to::<Lanes<L, R>>(self.y.q.val()) & self.sign.val();
        }
        self.last.d.next = self.count.q.val() == 2;
        if !self.working.q.val() {
            if self.start.val() {
                self.working.d.next = true;
                self.partial.d.next = self.high.val();
                self.bits.d.next = self.low.val();
                self.y.d.next = self.divisor.val();
                self.minus_y.d.next = -self.divisor.val();
                self.count.d.next = self.steps.val();
            }
        } else {
            self.count.d.next = self.count.q.val() - 1;
            self.working.d.next = !self.last.q.val();
            self.partial.d.next = self.from.val() + self.addend.val();
            // Digits +1 / -1 to two's complement: the bits of the signs, twice that and one; and one less where the
            // remainder is made good, which clears that one. So the last step shifts in a sign, too.
            self.bits.d.next =
                (self.bits.q.val() << 1) | (bit_cast_to::<Lanes<L, Q>>(!self.sign.val()) & self.one_q.val());
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("divider_{L}x{Q}_by_{R}"))
    }
}

latches! { [const L: usize, const Q: usize, const R: usize] Divider<L, Q, R>: count, working, last, partial, bits, y, minus_y }
