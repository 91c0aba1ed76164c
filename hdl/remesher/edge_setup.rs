// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps of the three edge walkers of a base triangle, by one divider used three times.
//!
//! For the edge from its end lo to its end hi, n grid steps long:
//!     D = floor((V[hi] - V[lo]) * 2^g / n + 1/2),   start = V[hi] * 2^g + 2^(g-1) - ((V[hi] - V[lo]) * 2^g - n * D)
//! so that a walk from lo (V[lo] * 2^g + 2^(g-1), step +D) and one from hi (start, step -D) meet the same bits.
//! Edges of n <= 1 have no vertex between their corners and are skipped.
//!
//! | port            | format       | range |   Latency 3 (W + 3) + 4 at most
//! | start           | Bit          | one cycle; AB stands still from the cycle behind it for four, the rest until `busy` falls |
//! | corner_*        | L x signed V | whole | Golden: models::remesher (edge)   Error: |D - exact| <= 1/2
//! | n_*             | signed T     | >= 0  |
//! | step_*, start_* | L x signed W | they stand two cycles behind `busy` |
//!
//! The difference for the next division is taken while the divider is at work, and the start of the walk from hi behind it.

use crate::prelude::*;
use crate::remesher::LaneDivider;

/// Which edge is being divided.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
#[allow(missing_docs)]
pub enum EdgeState {
    Idle,
    First,
    Second,
    Third,
}

/// Edge set-up unit: `X` = W + 2 bits of numerator.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct EdgeSetup<const L: usize, const V: usize, const W: usize, const X: usize, const T: usize> {
    pub clock: Input<ClockReset>,
    pub start: Input<Bit>,
    pub corner_a: Input<Lanes<L, V>>,
    pub corner_b: Input<Lanes<L, V>>,
    pub corner_c: Input<Lanes<L, V>>,
    pub n_ab: Input<S<T>>,
    pub n_ac: Input<S<T>>,
    pub n_bc: Input<S<T>>,
    /// A is the hi end of AB, A the hi end of AC, B the hi end of BC.
    pub a_hi_ab: Input<Bit>,
    pub a_hi_ac: Input<Bit>,
    pub b_hi_bc: Input<Bit>,
    pub busy: Output<Bit>,
    pub step_ab: Output<Lanes<L, W>>,
    pub step_ac: Output<Lanes<L, W>>,
    pub step_bc: Output<Lanes<L, W>>,
    pub start_ab: Output<Lanes<L, W>>,
    pub start_ac: Output<Lanes<L, W>>,
    pub start_bc: Output<Lanes<L, W>>,
    state: Register<EdgeState>,
    /// The divider has been started for the present edge.
    running: Register<Bit>,
    step_ab_reg: DataRegister<Lanes<L, W>>,
    step_ac_reg: DataRegister<Lanes<L, W>>,
    step_bc_reg: DataRegister<Lanes<L, W>>,
    start_ab_reg: DataRegister<Lanes<L, W>>,
    start_ac_reg: DataRegister<Lanes<L, W>>,
    start_bc_reg: DataRegister<Lanes<L, W>>,
    /// The edge whose difference is taken: 0 AB, 1 AC, 2 BC; and that this was so in the cycle before, too.
    ahead: Register<U<2>>,
    fresh: Register<Bit>,
    /// And in the one before: the difference stands.
    settled: Register<Bit>,
    /// A division may begin: the numerator stands soon, and the divider is free.
    due: Register<Bit>,
    /// Its ends: 0 A, 1 B, 2 C.
    lo_from: DataRegister<U<2>>,
    hi_from: DataRegister<U<2>>,
    /// A cycle before: what the lanes share goes to them by way of a register.
    lo_pick: DataRegister<U<2>>,
    hi_pick: DataRegister<U<2>>,
    difference: DataRegister<Lanes<L, X>>,
    numerator: DataRegister<Lanes<L, X>>,
    n_ahead: DataRegister<S<T>>,
    /// The same a cycle later, for the numerators.
    n_numerator: DataRegister<S<T>>,
    /// It has a vertex between its corners: n > 1.
    long_ahead: DataRegister<Bit>,
    hi_ahead: DataRegister<Lanes<L, V>>,
    /// Of the edge in the divider.
    n_now: DataRegister<S<T>>,
    /// The same a cycle later, for the remainders.
    n_rem: DataRegister<S<T>>,
    hi_now: DataRegister<Lanes<L, V>>,
    /// The division began one cycle ago, two cycles ago.
    begun: DataRegister<Bit>,
    takes_hi: DataRegister<Bit>,
    /// The start of this edge is due: 1 AB, 2 AC, 3 BC.
    closing: Register<U<2>>,
    /// The quotients of an edge are kept; its start is.
    keeps_ab: DataRegister<Bit>,
    keeps_ac: DataRegister<Bit>,
    keeps_bc: DataRegister<Bit>,
    starts_ab: DataRegister<Bit>,
    starts_ac: DataRegister<Bit>,
    starts_bc: DataRegister<Bit>,
    rem: DataRegister<Lanes<L, T>>,
    divider: LaneDivider<L, W, T>,
    finished: Register<Bit>,
    lo: Wire<Lanes<L, V>>,
    hi: Wire<Lanes<L, V>>,
    n: Wire<S<T>>,
    far: Wire<Lanes<L, W>>,
    begins: Wire<Bit>,
    skips: Wire<Bit>,
    guard_shift: Constant<U<6>>,
    quotient_bits: Constant<U<6>>,
    guard: Constant<U<6>>,
    half: Constant<Lanes<L, W>>,
}

impl<const L: usize, const V: usize, const W: usize, const X: usize, const T: usize> EdgeSetup<L, V, W, X, T> {
    /// A unit for `W - V - 1` guard bits.
    pub fn new() -> Self {
        assert!(X == W + 2, "the numerator of the edge division has W + 2 bits");
        Self {
            clock: Input::default(),
            start: Input::default(),
            corner_a: Input::default(),
            corner_b: Input::default(),
            corner_c: Input::default(),
            n_ab: Input::default(),
            n_ac: Input::default(),
            n_bc: Input::default(),
            a_hi_ab: Input::default(),
            a_hi_ac: Input::default(),
            b_hi_bc: Input::default(),
            busy: Output::default(),
            step_ab: Output::default(),
            step_ac: Output::default(),
            step_bc: Output::default(),
            start_ab: Output::default(),
            start_ac: Output::default(),
            start_bc: Output::default(),
            state: Register::default(),
            running: Register::default(),
            step_ab_reg: DataRegister::default(),
            step_ac_reg: DataRegister::default(),
            step_bc_reg: DataRegister::default(),
            start_ab_reg: DataRegister::default(),
            start_ac_reg: DataRegister::default(),
            start_bc_reg: DataRegister::default(),
            ahead: Register::default(),
            fresh: Register::default(),
            settled: Register::default(),
            due: Register::default(),
            lo_from: DataRegister::default(),
            hi_from: DataRegister::default(),
            lo_pick: DataRegister::default(),
            hi_pick: DataRegister::default(),
            difference: DataRegister::default(),
            numerator: DataRegister::default(),
            n_ahead: DataRegister::default(),
            n_numerator: DataRegister::default(),
            long_ahead: DataRegister::default(),
            hi_ahead: DataRegister::default(),
            n_now: DataRegister::default(),
            n_rem: DataRegister::default(),
            hi_now: DataRegister::default(),
            begun: DataRegister::default(),
            takes_hi: DataRegister::default(),
            closing: Register::default(),
            keeps_ab: DataRegister::default(),
            keeps_ac: DataRegister::default(),
            keeps_bc: DataRegister::default(),
            starts_ab: DataRegister::default(),
            starts_ac: DataRegister::default(),
            starts_bc: DataRegister::default(),
            rem: DataRegister::default(),
            divider: LaneDivider::default(),
            finished: Register::default(),
            lo: Wire::default(),
            hi: Wire::default(),
            n: Wire::default(),
            far: Wire::default(),
            begins: Wire::default(),
            skips: Wire::default(),
            guard_shift: Constant::new(U::new((W - V) as i64)),
            quotient_bits: Constant::new(U::new(W as i64)),
            guard: Constant::new(U::new((W - V - 1) as i64)),
            half: Constant::new(Lanes::new([if W == V + 1 { 0 } else { 1 << (W - V - 2) }; L])),
        }
    }
}

impl<const L: usize, const V: usize, const W: usize, const X: usize, const T: usize> Default
    for EdgeSetup<L, V, W, X, T>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<const L: usize, const V: usize, const W: usize, const X: usize, const T: usize> Logic
    for EdgeSetup<L, V, W, X, T>
{
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, due);
        dff_setup!(self, clock, keeps_ab, keeps_ac, keeps_bc, starts_ab, starts_ac, starts_bc);
        dff_setup!(self, clock, begun, takes_hi);
        dff_setup!(self, clock, n_rem);
        dff_setup!(self, clock, n_numerator);
        dff_setup!(self, clock, lo_pick, hi_pick);
        dff_setup!(self, clock, state, running, finished, ahead, fresh, settled, lo_from, hi_from, closing);
        dff_setup!(self, clock, step_ab_reg, step_ac_reg, step_bc_reg, start_ab_reg, start_ac_reg, start_bc_reg);
        dff_setup!(self, clock, difference, numerator, n_ahead, long_ahead, hi_ahead, n_now, hi_now, rem);
        clock!(self, clock, divider);
        self.busy.next = self.state.q.val() != EdgeState::Idle || self.closing.q.val() != 0;
        self.step_ab.next = self.step_ab_reg.q.val();
        self.step_ac.next = self.step_ac_reg.q.val();
        self.step_bc.next = self.step_bc_reg.q.val();
        self.start_ab.next = self.start_ab_reg.q.val();
        self.start_ac.next = self.start_ac_reg.q.val();
        self.start_bc.next = self.start_bc_reg.q.val();

        // The edge ahead, from its canonical end: which corners, then their data.
        if self.ahead.q.val() == 0 {
            self.n.next = self.n_ab.val();
            self.lo_pick.d.next = 0.into();
            self.hi_pick.d.next = 1.into();
            if self.a_hi_ab.val() {
                self.lo_pick.d.next = 1.into();
                self.hi_pick.d.next = 0.into();
            }
        } else if self.ahead.q.val() == 1 {
            self.n.next = self.n_ac.val();
            self.lo_pick.d.next = 0.into();
            self.hi_pick.d.next = 2.into();
            if self.a_hi_ac.val() {
                self.lo_pick.d.next = 2.into();
                self.hi_pick.d.next = 0.into();
            }
        } else {
            self.n.next = self.n_bc.val();
            self.lo_pick.d.next = 1.into();
            self.hi_pick.d.next = 2.into();
            if self.b_hi_bc.val() {
                self.lo_pick.d.next = 2.into();
                self.hi_pick.d.next = 1.into();
            }
        }
        self.lo_from.d.next = self.lo_pick.q.val();
        self.hi_from.d.next = self.hi_pick.q.val();
        if self.lo_from.q.val().get_bit(1) {
            self.lo.next = self.corner_c.val();
        } else if self.lo_from.q.val().get_bit(0) {
            self.lo.next = self.corner_b.val();
        } else {
            self.lo.next = self.corner_a.val();
        }
        if self.hi_from.q.val().get_bit(1) {
            self.hi.next = self.corner_c.val();
        } else if self.hi_from.q.val().get_bit(0) {
            self.hi.next = self.corner_b.val();
        } else {
            self.hi.next = self.corner_a.val();
        }
        self.difference.d.next = bit_cast_to::<Lanes<L, X>>(self.hi.val()) - bit_cast_to::<Lanes<L, X>>(self.lo.val());
        self.n_ahead.d.next = self.n.val();
        self.n_numerator.d.next = self.n_ahead.q.val();
        self.n_rem.d.next = self.n_now.q.val();
        self.long_ahead.d.next = (self.n.val() >> 1) != 0;
        self.hi_ahead.d.next = self.hi.val();

        // floor(a / n + 1/2) = floor((2a + n) / 2n); 2a + n needs V + 1 + g + 1 + 1 = W + 2 bits.
        self.numerator.d.next =
            (self.difference.q.val() << self.guard_shift.val()) + bit_cast_to::<Lanes<L, X>>(self.n_numerator.q.val());
        self.divider.high.next = bit_cast_to::<Lanes<L, T>>(self.numerator.q.val() >> self.quotient_bits.val());
        self.divider.low.next = bit_cast_to::<Lanes<L, W>>(self.numerator.q.val());
        self.divider.divisor.next = self.n_ahead.q.val() << 1;
        // (2a + n) - 2n D = 2 (a - n D) + n, so the remainder of a is half of what n leaves.
        self.rem.d.next = (self.divider.remainder.val() - bit_cast_to::<Lanes<L, T>>(self.n_rem.q.val())) >> 1;
        self.far.next = ((bit_cast_to::<Lanes<L, W>>(self.hi_now.q.val()) << self.guard.val()) | self.half.val())
            - bit_cast_to::<Lanes<L, W>>(self.rem.q.val());
        self.keeps_ab.d.next = self.closing.q.val() == 1;
        self.keeps_ac.d.next = self.closing.q.val() == 2;
        self.keeps_bc.d.next = self.closing.q.val() == 3;
        self.starts_ab.d.next = self.keeps_ab.q.val();
        self.starts_ac.d.next = self.keeps_ac.q.val();
        self.starts_bc.d.next = self.keeps_bc.q.val();
        self.step_ab_reg.enable.next = self.keeps_ab.q.val();
        self.step_ab_reg.d.next = self.divider.quotient.val();
        self.step_ac_reg.enable.next = self.keeps_ac.q.val();
        self.step_ac_reg.d.next = self.divider.quotient.val();
        self.step_bc_reg.enable.next = self.keeps_bc.q.val();
        self.step_bc_reg.d.next = self.divider.quotient.val();
        self.start_ab_reg.enable.next = self.starts_ab.q.val();
        self.start_ab_reg.d.next = self.far.val();
        self.start_ac_reg.enable.next = self.starts_ac.q.val();
        self.start_ac_reg.d.next = self.far.val();
        self.start_bc_reg.enable.next = self.starts_bc.q.val();
        self.start_bc_reg.d.next = self.far.val();

        // Three edges are taken up in turn; then `ahead` is 3.
        self.due.d.next = self.state.q.val() != EdgeState::Idle
            && self.ahead.q.val() != 3
            && !self.running.q.val()
            && self.settled.q.val()
            && !self.due.q.val();
        self.begins.next = self.due.q.val() && self.long_ahead.q.val();
        self.skips.next = self.due.q.val() && !self.long_ahead.q.val();
        self.divider.start.next = self.begins.val();
        self.begun.d.next = self.begins.val();
        self.takes_hi.d.next = self.begun.q.val();
        self.hi_now.enable.next = self.takes_hi.q.val();
        self.hi_now.d.next = self.hi_ahead.q.val();
        self.finished.d.next = self.divider.done.val();
        self.fresh.d.next = true;
        self.settled.d.next = self.fresh.q.val();
        self.closing.d.next = 0.into();
        if self.begins.val() || self.skips.val() {
            self.ahead.d.next = self.ahead.q.val() + 1;
            self.fresh.d.next = false;
            self.settled.d.next = false;
        }
        if self.begins.val() {
            self.running.d.next = true;
            self.n_now.d.next = self.n_ahead.q.val();
        }
        if self.divider.done.val() {
            self.running.d.next = false;
        }
        if self.state.q.val() == EdgeState::Idle {
            self.ahead.d.next = 0.into();
            if self.start.val() {
                self.state.d.next = EdgeState::First;
            }
        } else if self.state.q.val() == EdgeState::First {
            if self.finished.q.val() || self.skips.val() {
                self.state.d.next = EdgeState::Second;
            }
            if self.finished.q.val() {
                self.closing.d.next = 1.into();
            }
        } else if self.state.q.val() == EdgeState::Second {
            if self.finished.q.val() || self.skips.val() {
                self.state.d.next = EdgeState::Third;
            }
            if self.finished.q.val() {
                self.closing.d.next = 2.into();
            }
        } else {
            if self.finished.q.val() || self.skips.val() {
                self.state.d.next = EdgeState::Idle;
            }
            if self.finished.q.val() {
                self.closing.d.next = 3.into();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("edge_setup")
    }
}

watched! { [const L: usize, const V: usize, const W: usize, const X: usize, const T: usize] EdgeSetup<L, V, W, X, T>: start, corner_a, corner_b, corner_c, n_ab, n_ac, n_bc, a_hi_ab, a_hi_ac, b_hi_bc; divider; state, running, step_ab_reg, step_ac_reg, step_bc_reg, start_ab_reg, start_ac_reg, start_bc_reg, ahead, fresh, settled, lo_from, hi_from, difference, numerator, n_ahead, long_ahead, hi_ahead, n_now, hi_now, closing, rem, divider, finished, lo_pick, hi_pick, n_numerator, n_rem, begun, takes_hi, keeps_ab, keeps_ac, keeps_bc, starts_ab, starts_ac, starts_bc, due }
