// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sequential divider for many lanes: as [`Divider`](crate::primitives::Divider), with its controls two cycles ahead.
//!
//! quotient = floor(x / y) mod 2^Q,  remainder = x - quotient * y,  0 <= remainder < y,  for y > 0
//!
//! Hundreds of bits wait for each control, over a large part of the device. So a control is decided first and goes through two
//! registers then, of which the second one is the lanes' own: synthesis makes copies of it, and a wire takes a cycle.
//!
//! | port        | format        | range                                      |   Interval Q + 3
//! | start       | Bit           | taken when `busy` is low                   |   Error 0
//! | high, low   | L x signed R, Q | x = high * 2^Q + low, low read as unsigned; they stand two cycles after `start`, |
//! | divisor     | signed R      | 0 < y, 2y < 2^(R-1); and this one cycle after it |
//! | done        | Bit           | Q + 1 cycles after `start`; a division may start two cycles later |
//! | quotient    | L x signed Q  | valid in the third and the fourth cycle behind `done`, and on until the next start |
//! | remainder   | L x signed R  | the same                                   |
//!
//! Example, Q = 4: x = -7, y = 2: high = -1, low = 9 -> quotient -4, remainder 1.

use crate::prelude::*;

/// Divider of `L` numerators, quotients of `Q` bits, remainders of `R` bits.
#[derive(Clone, Debug, LogicBlock)]
pub struct LaneDivider<const L: usize, const Q: usize, const R: usize> {
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
    /// The division ends in two cycles.
    pub done: Output<Bit>,
    /// Floor quotients.
    pub quotient: Output<Lanes<L, Q>>,
    /// Remainders.
    pub remainder: Output<Lanes<L, R>>,
    count: Register<U<8>>,
    /// The count is not 0, or 1.
    working: Register<Bit>,
    last: Register<Bit>,
    /// The same and the start, on the way to the lanes.
    begun: DataRegister<Bit>,
    working_late: DataRegister<Bit>,
    last_late: DataRegister<Bit>,
    near_y: DataRegister<S<R>>,
    near_minus: DataRegister<S<R>>,
    /// The lanes take their numerators; they load or step; they step for the last time.
    loads: DataRegister<Bit>,
    moves: DataRegister<Bit>,
    ends: DataRegister<Bit>,
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

impl<const L: usize, const Q: usize, const R: usize> Default for LaneDivider<L, Q, R> {
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
            begun: DataRegister::default(),
            working_late: DataRegister::default(),
            last_late: DataRegister::default(),
            near_y: DataRegister::default(),
            near_minus: DataRegister::default(),
            loads: DataRegister::default(),
            moves: DataRegister::default(),
            ends: DataRegister::default(),
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

impl<const L: usize, const Q: usize, const R: usize> Logic for LaneDivider<L, Q, R> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, count, working, last, begun, working_late, last_late, near_y, near_minus);
        dff_setup!(self, clock, loads, moves, ends, partial, bits, y, minus_y);
        self.busy.next = self.working.q.val();
        self.done.next = self.last.q.val();
        self.quotient.next = self.bits.q.val();
        self.remainder.next = self.partial.q.val();

        self.begun.d.next = self.start.val() && !self.working.q.val();
        self.last.d.next = self.count.q.val() == 2;
        if self.working.q.val() {
            self.count.d.next = self.count.q.val() - 1;
            self.working.d.next = !self.last.q.val();
        } else if self.start.val() {
            self.working.d.next = true;
            self.count.d.next = self.steps.val();
        }
        self.working_late.d.next = self.working.q.val();
        self.last_late.d.next = self.last.q.val();
        self.near_y.enable.next = self.begun.q.val();
        self.near_y.d.next = self.divisor.val();
        self.near_minus.enable.next = self.begun.q.val();
        self.near_minus.d.next = -self.divisor.val();
        self.loads.d.next = self.begun.q.val();
        self.moves.d.next = self.begun.q.val() || self.working_late.q.val();
        self.ends.d.next = self.last_late.q.val();
        self.y.d.next = self.near_y.q.val();
        self.minus_y.d.next = self.near_minus.q.val();

        // All ones in the lanes whose partial remainder is negative.
        self.sign.next = self.partial.q.val() >> self.r_sign.val();
        self.doubled.next = (self.partial.q.val() << 1)
            | (bit_cast_to::<Lanes<L, R>>(self.bits.q.val() >> self.q_sign.val()) & self.one_r.val());
        self.addend.next = (bit_cast_to::<Lanes<L, R>>(self.y.q.val()) & self.sign.val())
            | (bit_cast_to::<Lanes<L, R>>(self.minus_y.q.val()) & !self.sign.val());
        // One addition a cycle: 2 r + bit -+ y, and at last y once more where the remainder is negative.
        self.from.next = self.doubled.val();
        if self.ends.q.val() {
            self.from.next = self.partial.q.val();
            self.addend.next = bit_cast_to::<Lanes<L, R>>(self.y.q.val()) & self.sign.val();
        }
        self.partial.enable.next = self.moves.q.val();
        self.partial.d.next = self.from.val() + self.addend.val();
        // Digits +1 / -1 to two's complement: the bits of the signs, twice that and one; and one less where the
        // remainder is made good, which clears that one. So the last step shifts in a sign, too.
        self.bits.enable.next = self.moves.q.val();
        self.bits.d.next = (self.bits.q.val() << 1) | (bit_cast_to::<Lanes<L, Q>>(!self.sign.val()) & self.one_q.val());
        if self.loads.q.val() {
            self.partial.d.next = self.high.val();
            self.bits.d.next = self.low.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("lane_divider_{L}x{Q}_by_{R}"))
    }
}

latches! { [const L: usize, const Q: usize, const R: usize] LaneDivider<L, Q, R>: count, working, last, begun, working_late, last_late, near_y, near_minus, loads, moves, ends, partial, bits, y, minus_y }
