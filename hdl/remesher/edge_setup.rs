// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps of the three edge walkers of a base triangle, by one divider used three times.
//!
//! For the edge from its end lo to its end hi, n grid steps long:
//!     D = floor((V[hi] - V[lo]) * 2^g / n + 1/2),   rem = (V[hi] - V[lo]) * 2^g - n * D
//! so that a walk from lo (V[lo] * 2^g, step +D) and one from hi (V[hi] * 2^g - rem, step -D) meet the same bits.
//! Edges of n <= 1 have no vertex between their corners and are skipped.
//!
//! | port            | format       | range |   Latency 3 (W + 4) at most
//! | start           | Bit          | one cycle; corners, lengths and directions stand still until `done` |
//! | corner_*        | L x signed V | whole | Golden: models::remesher (edge)   Error: |D - exact| <= 1/2
//! | n_*             | signed T     | >= 0  |
//! | step_*, rem_*   | L x signed W, T | |
//!
//! After `start` the first edge (AB) is read at once; AC and BC are read later, when the roles of A and B are final.

use crate::prelude::*;
use crate::primitives::Divider;

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
    pub rem_ab: Output<Lanes<L, T>>,
    pub rem_ac: Output<Lanes<L, T>>,
    pub rem_bc: Output<Lanes<L, T>>,
    state: Register<EdgeState>,
    /// The divider has been started for the present edge.
    running: Register<Bit>,
    step_ab_reg: DataRegister<Lanes<L, W>>,
    step_ac_reg: DataRegister<Lanes<L, W>>,
    step_bc_reg: DataRegister<Lanes<L, W>>,
    rem_ab_reg: DataRegister<Lanes<L, T>>,
    rem_ac_reg: DataRegister<Lanes<L, T>>,
    rem_bc_reg: DataRegister<Lanes<L, T>>,
    divider: Divider<L, W, T>,
    finished: Register<Bit>,
    lo: Wire<Lanes<L, V>>,
    hi: Wire<Lanes<L, V>>,
    n: Wire<S<T>>,
    remainder: Wire<Lanes<L, T>>,
    numerator: Wire<Lanes<L, X>>,
    guard_shift: Constant<U<6>>,
    quotient_bits: Constant<U<6>>,
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
            rem_ab: Output::default(),
            rem_ac: Output::default(),
            rem_bc: Output::default(),
            state: Register::default(),
            running: Register::default(),
            step_ab_reg: DataRegister::default(),
            step_ac_reg: DataRegister::default(),
            step_bc_reg: DataRegister::default(),
            rem_ab_reg: DataRegister::default(),
            rem_ac_reg: DataRegister::default(),
            rem_bc_reg: DataRegister::default(),
            divider: Divider::default(),
            finished: Register::default(),
            lo: Wire::default(),
            hi: Wire::default(),
            n: Wire::default(),
            remainder: Wire::default(),
            numerator: Wire::default(),
            guard_shift: Constant::new(U::new((W - V) as i64)),
            quotient_bits: Constant::new(U::new(W as i64)),
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
        dff_setup!(self, clock, state, running, finished);
        dff_setup!(self, clock, step_ab_reg, step_ac_reg, step_bc_reg, rem_ab_reg, rem_ac_reg, rem_bc_reg);
        clock!(self, clock, divider);
        self.busy.next = self.state.q.val() != EdgeState::Idle;
        self.step_ab.next = self.step_ab_reg.q.val();
        self.step_ac.next = self.step_ac_reg.q.val();
        self.step_bc.next = self.step_bc_reg.q.val();
        self.rem_ab.next = self.rem_ab_reg.q.val();
        self.rem_ac.next = self.rem_ac_reg.q.val();
        self.rem_bc.next = self.rem_bc_reg.q.val();

        // The present edge, from its canonical end.
        self.n.next = self.n_ab.val();
        self.lo.next = self.corner_a.val();
        self.hi.next = self.corner_b.val();
        if self.state.q.val() == EdgeState::First {
            if self.a_hi_ab.val() {
                self.lo.next = self.corner_b.val();
                self.hi.next = self.corner_a.val();
            }
        } else if self.state.q.val() == EdgeState::Second {
            self.n.next = self.n_ac.val();
            self.hi.next = self.corner_c.val();
            if self.a_hi_ac.val() {
                self.lo.next = self.corner_c.val();
                self.hi.next = self.corner_a.val();
            }
        } else {
            self.n.next = self.n_bc.val();
            self.lo.next = self.corner_b.val();
            self.hi.next = self.corner_c.val();
            if self.b_hi_bc.val() {
                self.lo.next = self.corner_c.val();
                self.hi.next = self.corner_b.val();
            }
        }
        // floor(a / n + 1/2) = floor((2a + n) / 2n); 2a + n needs V + 1 + g + 1 + 1 = W + 2 bits.
        self.numerator.next = ((bit_cast_to::<Lanes<L, X>>(self.hi.val()) - bit_cast_to::<Lanes<L, X>>(self.lo.val()))
            << self.guard_shift.val())
            + bit_cast_to::<Lanes<L, X>>(self.n.val());
        self.divider.high.next = bit_cast_to::<Lanes<L, T>>(self.numerator.val() >> self.quotient_bits.val());
        self.divider.low.next = bit_cast_to::<Lanes<L, W>>(self.numerator.val());
        self.divider.divisor.next = self.n.val() << 1;
        // (2a + n) - 2n D = 2 (a - n D) + n, so the remainder of a is half of what n leaves.
        self.remainder.next = (self.divider.remainder.val() - bit_cast_to::<Lanes<L, T>>(self.n.val())) >> 1;

        self.divider.start.next = false;
        self.finished.d.next = self.divider.done.val();
        if self.state.q.val() == EdgeState::Idle {
            self.running.d.next = false;
            if self.start.val() {
                self.state.d.next = EdgeState::First;
            }
        } else {
            if !self.running.q.val() && self.n.val() > 1 {
                self.divider.start.next = true;
                self.running.d.next = true;
            }
            if self.finished.q.val() || (!self.running.q.val() && self.n.val() <= 1) {
                self.running.d.next = false;
                if self.state.q.val() == EdgeState::First {
                    self.state.d.next = EdgeState::Second;
                    self.step_ab_reg.d.next = self.divider.quotient.val();
                    self.rem_ab_reg.d.next = self.remainder.val();
                } else if self.state.q.val() == EdgeState::Second {
                    self.state.d.next = EdgeState::Third;
                    self.step_ac_reg.d.next = self.divider.quotient.val();
                    self.rem_ac_reg.d.next = self.remainder.val();
                } else {
                    self.state.d.next = EdgeState::Idle;
                    self.step_bc_reg.d.next = self.divider.quotient.val();
                    self.rem_bc_reg.d.next = self.remainder.val();
                }
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("edge_setup")
    }
}

watched! { [const L: usize, const V: usize, const W: usize, const X: usize, const T: usize] EdgeSetup<L, V, W, X, T>: start, corner_a, corner_b, corner_c, n_ab, n_ac, n_bc, a_hi_ab, a_hi_ac, b_hi_bc; divider; state, running, step_ab_reg, step_ac_reg, step_bc_reg, rem_ab_reg, rem_ac_reg, rem_bc_reg, divider, finished }
