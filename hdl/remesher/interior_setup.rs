// SPDX-License-Identifier: MIT OR Apache-2.0
//! Difference vertices of the interior of a base triangle, and the base vertex of its second half.
//!
//! With fb = V[B] - V[A], fc = V[C] - V[A], and s, d the sweep and side coordinates relative to A:
//!     side  = floor((fc s_B - fb s_C) * 2^g / area2 + 1/2)
//!     sweep = floor((fb d_C - fc d_B) * 2^g / area2 + 1/2)
//!     base_b = V[A] * 2^g + s_B * sweep + d_B * side        (the second half of a roof descends from A too)
//! One multiplier serves all components in turn; the divider does all components at once.
//!
//! | port              | format       | range |   Latency about 2 (W + 5) + 4 L + 4, plus 2 L + 2 for a roof
//! | start             | Bit          | one cycle; corners and coordinates stand still until `busy` falls |
//! | corner_*          | L x signed V | whole | Golden: models::remesher (setup)
//! | s_*, d_*          | signed T     |       | Error: |difference - exact| <= 1/2
//! | area2             | signed A     | >= 0; 0 skips the unit: no interior vertex exists |
//! | side, sweep, base_b | L x signed W | wrap when they do not fit: then no interior vertex exists |

use crate::prelude::*;
use crate::primitives::Divider;

/// What the unit is doing.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
#[allow(missing_docs)]
pub enum InteriorState {
    Idle,
    /// Numerators of `side`, one product a cycle.
    SideProducts,
    /// Divides for `side`; the numerators of `sweep` are multiplied meanwhile.
    SideQuotient,
    SweepQuotient,
    /// Products of `base_b`.
    BaseProducts,
}

/// Interior set-up unit. `A` bits of area and remainder, `P` = W + T bits of product.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct InteriorSetup<const L: usize, const V: usize, const W: usize, const T: usize, const A: usize, const P: usize>
{
    pub clock: Input<ClockReset>,
    pub start: Input<Bit>,
    pub corner_a: Input<Lanes<L, V>>,
    pub corner_b: Input<Lanes<L, V>>,
    pub corner_c: Input<Lanes<L, V>>,
    pub s_b: Input<S<T>>,
    pub s_c: Input<S<T>>,
    pub d_b: Input<S<T>>,
    pub d_c: Input<S<T>>,
    pub area2: Input<S<A>>,
    /// `base_b` is wanted.
    pub roof: Input<Bit>,
    pub busy: Output<Bit>,
    pub side: Output<Lanes<L, W>>,
    pub sweep: Output<Lanes<L, W>>,
    pub base_b: Output<Lanes<L, W>>,
    state: Register<InteriorState>,
    /// Products issued in this round: lane `count >> 1`, first or second product.
    count: Register<U<6>>,
    issuing: Register<Bit>,
    /// The product of the cycle before arrives now.
    arriving: Register<Bit>,
    arriving_second: DataRegister<Bit>,
    arriving_lane: DataRegister<U<5>>,
    finished: Register<Bit>,
    first_product: DataRegister<WideS<P>>,
    high: DataRegister<Lanes<L, A>>,
    low: DataRegister<Lanes<L, W>>,
    side_reg: DataRegister<Lanes<L, W>>,
    sweep_reg: DataRegister<Lanes<L, W>>,
    base_reg: DataRegister<Lanes<L, W>>,
    multiplier: crate::primitives::Multiplier<W, T, P>,
    divider: Divider<L, W, A>,
    lane: Wire<U<5>>,
    second: Wire<Bit>,
    for_sweep: Wire<Bit>,
    fb: Wire<S<W>>,
    fc: Wire<S<W>>,
    numerator: Wire<WideS<P>>,
    origin: Wire<WideS<P>>,
    guard_shift: Constant<U<6>>,
    guard: Constant<U<6>>,
    quotient_bits: Constant<U<6>>,
    products: Constant<U<6>>,
}

impl<const L: usize, const V: usize, const W: usize, const T: usize, const A: usize, const P: usize> Default
    for InteriorSetup<L, V, W, T, A, P>
{
    fn default() -> Self {
        assert!(P == W + T, "a product of W by T bits has W + T bits");
        Self {
            clock: Input::default(),
            start: Input::default(),
            corner_a: Input::default(),
            corner_b: Input::default(),
            corner_c: Input::default(),
            s_b: Input::default(),
            s_c: Input::default(),
            d_b: Input::default(),
            d_c: Input::default(),
            area2: Input::default(),
            roof: Input::default(),
            busy: Output::default(),
            side: Output::default(),
            sweep: Output::default(),
            base_b: Output::default(),
            state: Register::default(),
            count: Register::default(),
            issuing: Register::default(),
            arriving: Register::default(),
            arriving_second: DataRegister::default(),
            arriving_lane: DataRegister::default(),
            finished: Register::default(),
            first_product: DataRegister::default(),
            high: DataRegister::default(),
            low: DataRegister::default(),
            side_reg: DataRegister::default(),
            sweep_reg: DataRegister::default(),
            base_reg: DataRegister::default(),
            multiplier: crate::primitives::Multiplier::default(),
            divider: Divider::default(),
            lane: Wire::default(),
            second: Wire::default(),
            for_sweep: Wire::default(),
            fb: Wire::default(),
            fc: Wire::default(),
            numerator: Wire::default(),
            origin: Wire::default(),
            guard_shift: Constant::new(U::new((W - V) as i64)),
            guard: Constant::new(U::new((W - V - 1) as i64)),
            quotient_bits: Constant::new(U::new(W as i64)),
            products: Constant::new(U::new(2 * L as i64 - 1)),
        }
    }
}

impl<const L: usize, const V: usize, const W: usize, const T: usize, const A: usize, const P: usize> Logic
    for InteriorSetup<L, V, W, T, A, P>
{
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, count, issuing, arriving, arriving_second, arriving_lane, finished);
        dff_setup!(self, clock, first_product, high, low, side_reg, sweep_reg, base_reg);
        clock!(self, clock, multiplier, divider);
        self.busy.next = self.state.q.val() != InteriorState::Idle;
        self.side.next = self.side_reg.q.val();
        self.sweep.next = self.sweep_reg.q.val();
        self.base_b.next = self.base_reg.q.val();

        // Operands of the product issued in this cycle.
        self.lane.next = self.count.q.val().get_bits::<5>(1);
        self.second.next = self.count.q.val().get_bit(0);
        self.for_sweep.next = self.state.q.val() == InteriorState::SideQuotient;
        self.fb.next = bit_cast_to::<S<W>>(self.corner_b.val().get_bit(self.lane.val().index()))
            - bit_cast_to::<S<W>>(self.corner_a.val().get_bit(self.lane.val().index()));
        self.fc.next = bit_cast_to::<S<W>>(self.corner_c.val().get_bit(self.lane.val().index()))
            - bit_cast_to::<S<W>>(self.corner_a.val().get_bit(self.lane.val().index()));
        if self.state.q.val() == InteriorState::BaseProducts {
            if self.second.val() {
                self.multiplier.a.next = self.side_reg.q.val().get_bit(self.lane.val().index());
                self.multiplier.b.next = self.d_b.val();
            } else {
                self.multiplier.a.next = self.sweep_reg.q.val().get_bit(self.lane.val().index());
                self.multiplier.b.next = self.s_b.val();
            }
        } else if self.for_sweep.val() {
            if self.second.val() {
                self.multiplier.a.next = self.fc.val();
                self.multiplier.b.next = self.d_b.val();
            } else {
                self.multiplier.a.next = self.fb.val();
                self.multiplier.b.next = self.d_c.val();
            }
        } else {
            if self.second.val() {
                self.multiplier.a.next = self.fb.val();
                self.multiplier.b.next = self.s_c.val();
            } else {
                self.multiplier.a.next = self.fc.val();
                self.multiplier.b.next = self.s_b.val();
            }
        }
        self.arriving.d.next = self.issuing.q.val();
        self.arriving_second.d.next = self.second.val();
        self.arriving_lane.d.next = self.lane.val();
        if self.issuing.q.val() {
            self.count.d.next = self.count.q.val() + 1;
            if self.count.q.val() == self.products.val() {
                self.issuing.d.next = false;
                self.count.d.next = 0.into();
            }
        }

        // 2a + area2 of the division by 2 area2: V + 1 + N bits of product, one more for the difference, g + 1 of shift.
        self.numerator.next = ((self.first_product.q.val() - self.multiplier.p.val()) << self.guard_shift.val())
            + bit_cast_to::<WideS<P>>(self.area2.val());
        // Only the lower W bits are kept: the sum wraps, and is right whenever the true vertex fits.
        self.origin.next = (bit_cast_to::<WideS<P>>(self.corner_a.val().get_bit(self.arriving_lane.q.val().index()))
            << self.guard.val())
            + self.first_product.q.val()
            + self.multiplier.p.val();
        if self.arriving.q.val() {
            if !self.arriving_second.q.val() {
                self.first_product.d.next = self.multiplier.p.val();
            } else if self.state.q.val() == InteriorState::BaseProducts {
                self.base_reg.d.next = self
                    .base_reg
                    .q
                    .val()
                    .replace_bit(self.arriving_lane.q.val().index(), bit_cast_to::<S<W>>(self.origin.val()));
            } else {
                self.high.d.next = self.high.q.val().replace_bit(
                    self.arriving_lane.q.val().index(),
                    bit_cast_to::<S<A>>(self.numerator.val() >> self.quotient_bits.val()),
                );
                self.low.d.next = self
                    .low
                    .q
                    .val()
                    .replace_bit(self.arriving_lane.q.val().index(), bit_cast_to::<S<W>>(self.numerator.val()));
            }
        }

        self.divider.high.next = self.high.q.val();
        self.divider.low.next = self.low.q.val();
        self.divider.divisor.next = self.area2.val() << 1;
        self.divider.start.next = false;
        self.finished.d.next = self.divider.done.val();
        if self.state.q.val() == InteriorState::Idle {
            if self.start.val() && self.area2.val() > 0 {
                self.state.d.next = InteriorState::SideProducts;
                self.issuing.d.next = true;
                self.count.d.next = 0.into();
            }
        } else if self.state.q.val() == InteriorState::SideProducts {
            if !self.issuing.q.val() && !self.arriving.q.val() {
                self.divider.start.next = true;
                self.state.d.next = InteriorState::SideQuotient;
                self.issuing.d.next = true;
                self.count.d.next = 0.into();
            }
        } else if self.state.q.val() == InteriorState::SideQuotient {
            if self.finished.q.val() {
                self.side_reg.d.next = self.divider.quotient.val();
                // 2 L products take less than the W + 2 cycles of the division: the numerators are there.
                self.divider.start.next = true;
                self.state.d.next = InteriorState::SweepQuotient;
            }
        } else if self.state.q.val() == InteriorState::SweepQuotient {
            if self.finished.q.val() {
                self.sweep_reg.d.next = self.divider.quotient.val();
                if self.roof.val() {
                    self.state.d.next = InteriorState::BaseProducts;
                    self.issuing.d.next = true;
                    self.count.d.next = 0.into();
                } else {
                    self.state.d.next = InteriorState::Idle;
                }
            }
        } else {
            if !self.issuing.q.val() && !self.arriving.q.val() {
                self.state.d.next = InteriorState::Idle;
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("interior_setup")
    }
}

watched! { [const L: usize, const V: usize, const W: usize, const T: usize, const A: usize, const P: usize] InteriorSetup<L, V, W, T, A, P>: start, corner_a, corner_b, corner_c, s_b, s_c, d_b, d_c, area2, roof; multiplier, divider; state, count, issuing, arriving, arriving_second, arriving_lane, finished, first_product, high, low, side_reg, sweep_reg, base_reg, multiplier, divider }
