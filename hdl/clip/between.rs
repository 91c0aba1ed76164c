// SPDX-License-Identifier: MIT OR Apache-2.0
//! A value between two, multiplied and divided in one go, three cycles a bit.
//!
//! `value = floor(a + (b - a) p / q + 1/2)`
//!
//! | port  | format           | meaning |   Latency 150   Golden: models::clip, `between`   Error 0
//! | start | Bit              | takes a and b |
//! | a, b  | signed 48        | a stands until `done` |
//! | p, q  | unsigned 64, 65  | stand until `done`; p < q |
//! | done  | Bit              | the value stands, until the next start |
//!
//! The bits of |b - a| come one after another, the highest first: rest = 2 rest + bit p, and q is taken from it, at most twice,
//! for rest < q and p < q make less than 3 q; both differences are made in one cycle, and one is chosen in the next. So no number is
//! longer than q and two bits, although the product has 112.
//!
//! With b < a the value is a less the quotient, and a half is rounded down: it is up for the value.

use crate::prelude::*;

/// States.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
pub enum MixState {
    /// Waits for a start.
    Idle,
    /// The difference becomes a size.
    Size,
    /// The next bit.
    Multiply,
    /// q is taken once, and twice.
    Take,
    /// One of them is the rest.
    Choose,
    /// The rest is doubled,
    Double,
    /// and compared with q.
    Compare,
    /// The quotient is rounded,
    Round,
    /// and added.
    Add,
    /// The value stands.
    Done,
}

/// Sequential interpolation.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Between {
    pub clock: Input<ClockReset>,
    pub start: Input<Bit>,
    pub a: Input<S<48>>,
    pub b: Input<S<48>>,
    pub p: Input<WideU<64>>,
    pub q: Input<WideU<65>>,
    pub done: Output<Bit>,
    pub value: Output<S<48>>,
    state: Register<MixState>,
    left: DataRegister<U<6>>,
    difference: DataRegister<S<49>>,
    falls: DataRegister<Bit>,
    size: DataRegister<U<48>>,
    /// Below q; between bits below 3 q, so 67 bits and a sign.
    rest: DataRegister<WideS<68>>,
    /// Less q, and twice that.
    once: DataRegister<WideS<68>>,
    twice: DataRegister<WideS<68>>,
    quotient: DataRegister<U<48>>,
    sum: DataRegister<S<48>>,
    taken: Wire<U<2>>,
    doubled: Wire<WideS<68>>,
    last: Constant<U<6>>,
}

impl Default for Between {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            start: Input::default(),
            a: Input::default(),
            b: Input::default(),
            p: Input::default(),
            q: Input::default(),
            done: Output::default(),
            value: Output::default(),
            state: Register::new(MixState::Idle),
            left: DataRegister::default(),
            difference: DataRegister::default(),
            falls: DataRegister::default(),
            size: DataRegister::default(),
            rest: DataRegister::default(),
            once: DataRegister::default(),
            twice: DataRegister::default(),
            quotient: DataRegister::default(),
            sum: DataRegister::default(),
            taken: Wire::default(),
            doubled: Wire::default(),
            last: Constant::new(U::new(47)),
        }
    }
}

impl Between {
    /// Cycles from the one in which `start` is high to the one in which `done` is.
    pub const LATENCY: usize = 2 + 3 * 48 + 4;
}

impl Logic for Between {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, left, difference, falls, size, rest, once, twice, quotient, sum);
        self.done.next = self.state.q.val() == MixState::Done;
        self.value.next = self.sum.q.val();
        self.once.d.next = self.rest.q.val() - bit_cast_to::<WideS<68>>(self.q.val());
        self.twice.d.next = self.rest.q.val() - (bit_cast_to::<WideS<68>>(self.q.val()) << 1);
        self.taken.next = 2.into();
        if self.once.q.val().get_bit(67) {
            self.taken.next = 0.into();
        } else if self.twice.q.val().get_bit(67) {
            self.taken.next = 1.into();
        }
        self.doubled.next = self.rest.q.val() << 1;
        match self.state.q.val() {
            MixState::Idle => {
                if self.start.val() {
                    self.difference.d.next = bit_cast_to::<S<49>>(self.b.val()) - bit_cast_to::<S<49>>(self.a.val());
                    self.state.d.next = MixState::Size;
                }
            }
            MixState::Size => {
                self.falls.d.next = self.difference.q.val().get_bit(48);
                self.size.d.next = bit_cast_to::<U<48>>(self.difference.q.val());
                if self.difference.q.val().get_bit(48) {
                    self.size.d.next = bit_cast_to::<U<48>>(-self.difference.q.val());
                }
                self.rest.d.next = 0.into();
                self.quotient.d.next = 0.into();
                self.left.d.next = self.last.val();
                self.state.d.next = MixState::Multiply;
            }
            MixState::Multiply => {
                self.rest.d.next = self.doubled.val();
                if self.size.q.val().get_bit(47) {
                    self.rest.d.next = self.doubled.val() + bit_cast_to::<WideS<68>>(self.p.val());
                }
                self.size.d.next = self.size.q.val() << 1;
                self.state.d.next = MixState::Take;
            }
            MixState::Take => {
                self.state.d.next = MixState::Choose;
            }
            MixState::Choose => {
                self.quotient.d.next = (self.quotient.q.val() << 1) + bit_cast_to::<U<48>>(self.taken.val());
                if self.taken.val().get_bit(1) {
                    self.rest.d.next = self.twice.q.val();
                } else if self.taken.val().get_bit(0) {
                    self.rest.d.next = self.once.q.val();
                }
                self.left.d.next = self.left.q.val() - 1;
                self.state.d.next = MixState::Multiply;
                if self.left.q.val() == 0 {
                    self.state.d.next = MixState::Double;
                }
            }
            MixState::Double => {
                self.rest.d.next = self.doubled.val();
                self.state.d.next = MixState::Compare;
            }
            MixState::Compare => {
                self.state.d.next = MixState::Round;
            }
            MixState::Round => {
                if !self.once.q.val().get_bit(67) && (!self.falls.q.val() || self.once.q.val().any()) {
                    self.quotient.d.next = self.quotient.q.val() + 1;
                }
                self.state.d.next = MixState::Add;
            }
            MixState::Add => {
                self.sum.d.next = self.a.val() + bit_cast_to::<S<48>>(self.quotient.q.val());
                if self.falls.q.val() {
                    self.sum.d.next = self.a.val() - bit_cast_to::<S<48>>(self.quotient.q.val());
                }
                self.state.d.next = MixState::Done;
            }
            MixState::Done => {
                self.state.d.next = MixState::Idle;
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("between")
    }
}

watched! { [] Between: start, a, b, p, q;; state, left, difference, falls, size, rest, once, twice, quotient, sum }
