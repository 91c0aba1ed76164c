// SPDX-License-Identifier: MIT OR Apache-2.0
//! Difference vertices of the interior of a base triangle, and the base vertex of its second half.
//!
//! With fb = V[B] - V[A], fc = V[C] - V[A], and s, d the sweep and side coordinates relative to A:
//!     side  = floor((fc s_B - fb s_C) * 2^g / area2 + 1/2)
//!     sweep = floor((fb d_C - fc d_B) * 2^g / area2 + 1/2)
//!     base_b = V[A] * 2^g + 2^(g-1) + d_B * side + s_B * sweep   (the second half of a roof descends from A too)
//! One multiplier serves all components in turn; the divider does all components at once.
//!
//! | stage | registers |
//! | p0, near, p1 | the lane, the same a cycle later, its data |
//! | p2    | the factors: a difference of corners, or a quotient; and a span |
//! | p3    | three products, by 16 bits of the first factor each |
//! | p4, p5 | their sum |
//! | p6    | difference of two products, or sum with the base vertex |
//! | p7    | numerator |
//!
//! | port              | format       | range |   Latency 2 (W + 3) + 2 L + 13, plus L + 13 for a roof
//! | start             | Bit          | one cycle; data stand still until `busy` falls, the scalars from the cycle before, the corners from the second one behind |
//! | corner_*          | L x signed V | whole | Golden: models::remesher (setup)
//! | s_*, d_*          | signed T     |       | Error: |difference - exact| <= 1/2
//! | area2             | signed A     | >= 0; 0 skips the unit: no interior vertex exists |
//! | side, sweep, base_b | L x signed W | stand two cycles behind `busy`; wrap when they do not fit: then no interior vertex exists |

use crate::prelude::*;
use crate::remesher::LaneDivider;

/// What the unit is doing.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
#[allow(missing_docs)]
pub enum InteriorState {
    Idle,
    /// Numerators of `side`, one product a cycle.
    SideProducts,
    /// Divides for `side`; the numerators of `sweep` are multiplied meanwhile.
    SideQuotient,
    /// Divides for `sweep`; `d_B * side` is multiplied meanwhile.
    SweepQuotient,
    /// Products `s_B * sweep`.
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
    /// Products issued in this round: lane `count >> 1`, first or second product; for the base vertex lane `count`.
    count: Register<U<6>>,
    issuing: Register<Bit>,
    /// They begin in the next cycle.
    goes: Register<Bit>,
    finished: Register<Bit>,
    /// And one and two cycles later: the quotients are kept.
    side_soon: DataRegister<Bit>,
    sweep_soon: DataRegister<Bit>,
    takes_side: DataRegister<Bit>,
    takes_sweep_quotient: DataRegister<Bit>,
    /// `for_base`, `for_sweep` and the first round of the base vertex, a cycle later; and two.
    sums_soon: DataRegister<Bit>,
    takes_soon: DataRegister<Bit>,
    starts_soon: DataRegister<Bit>,
    sums_base: DataRegister<Bit>,
    takes_sweep: DataRegister<Bit>,
    starts_base: DataRegister<Bit>,
    /// The area is not 0; it stands still a cycle before the start.
    has_area: DataRegister<Bit>,
    p0_valid: Register<Bit>,
    p0_second: DataRegister<Bit>,
    p0_lane: DataRegister<U<5>>,
    /// A cycle later, by way of a register.
    near_valid: Register<Bit>,
    near_second: DataRegister<Bit>,
    near_lane: DataRegister<U<5>>,
    p1_valid: Register<Bit>,
    p1_second: DataRegister<Bit>,
    p1_lane: DataRegister<U<5>>,
    p1_a: DataRegister<S<V>>,
    p1_b: DataRegister<S<V>>,
    p1_c: DataRegister<S<V>>,
    p1_quotient: DataRegister<S<W>>,
    p2_valid: Register<Bit>,
    p2_second: DataRegister<Bit>,
    p2_lane: DataRegister<U<5>>,
    p2_factor: DataRegister<S<W>>,
    p2_span: DataRegister<S<T>>,
    /// The same a cycle later, at the multipliers.
    at_valid: Register<Bit>,
    at_second: DataRegister<Bit>,
    at_lane: DataRegister<U<5>>,
    at_factor: DataRegister<S<W>>,
    at_span: DataRegister<S<T>>,
    p3_valid: Register<Bit>,
    p3_second: DataRegister<Bit>,
    p3_lane: DataRegister<U<5>>,
    p4_valid: Register<Bit>,
    p4_second: DataRegister<Bit>,
    p4_lane: DataRegister<U<5>>,
    p4_low: DataRegister<WideS<P>>,
    p4_high: DataRegister<WideS<P>>,
    p4_origin: DataRegister<S<V>>,
    p4_base: DataRegister<S<W>>,
    p5_valid: Register<Bit>,
    p5_second: DataRegister<Bit>,
    p5_lane: DataRegister<U<5>>,
    p5_product: DataRegister<WideS<P>>,
    p5_base: DataRegister<S<W>>,
    p6_valid: Register<Bit>,
    p6_second: DataRegister<Bit>,
    p6_lane: DataRegister<U<5>>,
    p6_first: DataRegister<WideS<P>>,
    p6_difference: DataRegister<WideS<P>>,
    p6_origin: DataRegister<S<W>>,
    p7_lane: DataRegister<U<5>>,
    /// It goes to the base vertex, to the numerators.
    puts_base: Register<Bit>,
    puts_numerator: Register<Bit>,
    p7_numerator: DataRegister<WideS<P>>,
    p7_origin: DataRegister<S<W>>,
    /// The last lane of the round has been written.
    complete: Register<Bit>,
    high: DataRegister<Lanes<L, A>>,
    low: DataRegister<Lanes<L, W>>,
    side_reg: DataRegister<Lanes<L, W>>,
    sweep_reg: DataRegister<Lanes<L, W>>,
    base_reg: DataRegister<Lanes<L, W>>,
    part_0: crate::primitives::Multiplier<17, T, 40>,
    part_1: crate::primitives::Multiplier<17, T, 40>,
    part_2: crate::primitives::Multiplier<17, T, 40>,
    divider: LaneDivider<L, W, A>,
    lane: Wire<U<5>>,
    second: Wire<Bit>,
    for_base: Wire<Bit>,
    for_sweep: Wire<Bit>,
    fb: Wire<S<W>>,
    fc: Wire<S<W>>,
    guard_shift: Constant<U<6>>,
    guard: Constant<U<6>>,
    half: Constant<S<W>>,
    quotient_bits: Constant<U<6>>,
    products: Constant<U<6>>,
    lanes: Constant<U<6>>,
    last_lane: Constant<U<5>>,
}

impl<const L: usize, const V: usize, const W: usize, const T: usize, const A: usize, const P: usize> Default
    for InteriorSetup<L, V, W, T, A, P>
{
    fn default() -> Self {
        assert!(
            P == W + T && W <= 49,
            "a product of W by T bits has W + T bits, and the first factor three parts of 16"
        );
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
            goes: Register::default(),
            finished: Register::default(),
            side_soon: DataRegister::default(),
            sweep_soon: DataRegister::default(),
            takes_side: DataRegister::default(),
            takes_sweep_quotient: DataRegister::default(),
            sums_soon: DataRegister::default(),
            takes_soon: DataRegister::default(),
            starts_soon: DataRegister::default(),
            sums_base: DataRegister::default(),
            takes_sweep: DataRegister::default(),
            starts_base: DataRegister::default(),
            has_area: DataRegister::default(),
            p0_valid: Register::default(),
            p0_second: DataRegister::default(),
            p0_lane: DataRegister::default(),
            near_valid: Register::default(),
            near_second: DataRegister::default(),
            near_lane: DataRegister::default(),
            p1_valid: Register::default(),
            p1_second: DataRegister::default(),
            p1_lane: DataRegister::default(),
            p1_a: DataRegister::default(),
            p1_b: DataRegister::default(),
            p1_c: DataRegister::default(),
            p1_quotient: DataRegister::default(),
            p2_valid: Register::default(),
            p2_second: DataRegister::default(),
            p2_lane: DataRegister::default(),
            p2_factor: DataRegister::default(),
            p2_span: DataRegister::default(),
            at_valid: Register::default(),
            at_second: DataRegister::default(),
            at_lane: DataRegister::default(),
            at_factor: DataRegister::default(),
            at_span: DataRegister::default(),
            p3_valid: Register::default(),
            p3_second: DataRegister::default(),
            p3_lane: DataRegister::default(),
            p4_valid: Register::default(),
            p4_second: DataRegister::default(),
            p4_lane: DataRegister::default(),
            p4_low: DataRegister::default(),
            p4_high: DataRegister::default(),
            p4_origin: DataRegister::default(),
            p4_base: DataRegister::default(),
            p5_valid: Register::default(),
            p5_second: DataRegister::default(),
            p5_lane: DataRegister::default(),
            p5_product: DataRegister::default(),
            p5_base: DataRegister::default(),
            p6_valid: Register::default(),
            p6_second: DataRegister::default(),
            p6_lane: DataRegister::default(),
            p6_first: DataRegister::default(),
            p6_difference: DataRegister::default(),
            p6_origin: DataRegister::default(),
            p7_lane: DataRegister::default(),
            puts_base: Register::default(),
            puts_numerator: Register::default(),
            p7_numerator: DataRegister::default(),
            p7_origin: DataRegister::default(),
            complete: Register::default(),
            high: DataRegister::default(),
            low: DataRegister::default(),
            side_reg: DataRegister::default(),
            sweep_reg: DataRegister::default(),
            base_reg: DataRegister::default(),
            part_0: crate::primitives::Multiplier::default(),
            part_1: crate::primitives::Multiplier::default(),
            part_2: crate::primitives::Multiplier::default(),
            divider: LaneDivider::default(),
            lane: Wire::default(),
            second: Wire::default(),
            for_base: Wire::default(),
            for_sweep: Wire::default(),
            fb: Wire::default(),
            fc: Wire::default(),
            guard_shift: Constant::new(U::new((W - V) as i64)),
            guard: Constant::new(U::new((W - V - 1) as i64)),
            half: Constant::new(S::new(if W == V + 1 { 0 } else { 1 << (W - V - 2) })),
            quotient_bits: Constant::new(U::new(W as i64)),
            products: Constant::new(U::new(2 * L as i64 - 1)),
            lanes: Constant::new(U::new(L as i64 - 1)),
            last_lane: Constant::new(U::new(L as i64 - 1)),
        }
    }
}

impl<const L: usize, const V: usize, const W: usize, const T: usize, const A: usize, const P: usize> Logic
    for InteriorSetup<L, V, W, T, A, P>
{
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, goes);
        dff_setup!(self, clock, puts_base, puts_numerator);
        dff_setup!(self, clock, at_valid, at_second, at_lane, at_factor, at_span);
        dff_setup!(self, clock, sums_soon, takes_soon, starts_soon);
        dff_setup!(self, clock, p7_lane, p7_numerator, p7_origin);
        dff_setup!(self, clock, near_valid, near_second, near_lane);
        dff_setup!(self, clock, side_soon, sweep_soon, takes_side, takes_sweep_quotient);
        dff_setup!(
            self,
            clock,
            state,
            count,
            issuing,
            finished,
            sums_base,
            takes_sweep,
            starts_base,
            has_area,
            p0_valid,
            p0_second,
            p0_lane,
            p1_valid,
            p1_second,
            p1_lane,
            p1_a
        );
        dff_setup!(self, clock, p1_b, p1_c, p1_quotient, p2_valid, p2_second, p2_lane, p2_factor, p2_span, p3_valid);
        dff_setup!(
            self, clock, p3_second, p3_lane, p4_valid, p4_second, p4_lane, p4_low, p4_high, p4_origin, p4_base,
            p5_valid, p5_second
        );
        dff_setup!(
            self,
            clock,
            p5_lane,
            p5_product,
            p5_base,
            p6_valid,
            p6_second,
            p6_lane,
            p6_first,
            p6_difference,
            p6_origin
        );
        dff_setup!(self, clock, complete, high, low, side_reg, sweep_reg, base_reg);
        clock!(self, clock, part_0, part_1, part_2, divider);
        self.busy.next = self.state.q.val() != InteriorState::Idle;
        self.side.next = self.side_reg.q.val();
        self.sweep.next = self.sweep_reg.q.val();
        self.base_b.next = self.base_reg.q.val();
        self.for_sweep.next = self.state.q.val() == InteriorState::SideQuotient;
        self.for_base.next =
            self.state.q.val() == InteriorState::SweepQuotient || self.state.q.val() == InteriorState::BaseProducts;

        self.sums_soon.d.next = self.for_base.val();
        self.takes_soon.d.next = self.for_sweep.val();
        self.starts_soon.d.next = self.state.q.val() == InteriorState::SweepQuotient;
        self.sums_base.d.next = self.sums_soon.q.val();
        self.takes_sweep.d.next = self.takes_soon.q.val();
        self.starts_base.d.next = self.starts_soon.q.val();

        // p0: which lane.
        if self.for_base.val() {
            self.lane.next = self.count.q.val().get_bits::<5>(0);
            self.second.next = false;
        } else {
            self.lane.next = self.count.q.val().get_bits::<5>(1);
            self.second.next = self.count.q.val().get_bit(0);
        }
        self.p0_valid.d.next = self.issuing.q.val();
        self.p0_second.d.next = self.second.val();
        self.p0_lane.d.next = self.lane.val();

        self.near_valid.d.next = self.p0_valid.q.val();
        self.near_second.d.next = self.p0_second.q.val();
        self.near_lane.d.next = self.p0_lane.q.val();

        // p1: its data.
        self.p1_valid.d.next = self.near_valid.q.val();
        self.p1_second.d.next = self.near_second.q.val();
        self.p1_lane.d.next = self.near_lane.q.val();
        self.p1_a.d.next = self.corner_a.val().get_bit(self.near_lane.q.val().index());
        self.p1_b.d.next = self.corner_b.val().get_bit(self.near_lane.q.val().index());
        self.p1_c.d.next = self.corner_c.val().get_bit(self.near_lane.q.val().index());
        if self.starts_base.q.val() {
            self.p1_quotient.d.next = self.side_reg.q.val().get_bit(self.near_lane.q.val().index());
        } else {
            self.p1_quotient.d.next = self.sweep_reg.q.val().get_bit(self.near_lane.q.val().index());
        }
        self.goes.d.next = false;
        if self.goes.q.val() {
            self.issuing.d.next = true;
        }
        if self.issuing.q.val() {
            self.count.d.next = self.count.q.val() + 1;
            if (self.for_base.val() && self.count.q.val() == self.lanes.val())
                || (!self.for_base.val() && self.count.q.val() == self.products.val())
            {
                self.issuing.d.next = false;
                self.count.d.next = 0.into();
            }
        }

        // p2: the factors.
        self.fb.next = bit_cast_to::<S<W>>(self.p1_b.q.val()) - bit_cast_to::<S<W>>(self.p1_a.q.val());
        self.fc.next = bit_cast_to::<S<W>>(self.p1_c.q.val()) - bit_cast_to::<S<W>>(self.p1_a.q.val());
        self.p2_valid.d.next = self.p1_valid.q.val();
        self.p2_second.d.next = self.p1_second.q.val();
        self.p2_lane.d.next = self.p1_lane.q.val();
        if self.sums_base.q.val() {
            self.p2_factor.d.next = self.p1_quotient.q.val();
            self.p2_span.d.next = self.s_b.val();
            if self.starts_base.q.val() {
                self.p2_span.d.next = self.d_b.val();
            }
        } else if self.takes_sweep.q.val() {
            self.p2_factor.d.next = self.fb.val();
            self.p2_span.d.next = self.d_c.val();
            if self.p1_second.q.val() {
                self.p2_factor.d.next = self.fc.val();
                self.p2_span.d.next = self.d_b.val();
            }
        } else {
            self.p2_factor.d.next = self.fc.val();
            self.p2_span.d.next = self.s_b.val();
            if self.p1_second.q.val() {
                self.p2_factor.d.next = self.fb.val();
                self.p2_span.d.next = self.s_c.val();
            }
        }

        self.at_valid.d.next = self.p2_valid.q.val();
        self.at_second.d.next = self.p2_second.q.val();
        self.at_lane.d.next = self.p2_lane.q.val();
        self.at_factor.d.next = self.p2_factor.q.val();
        self.at_span.d.next = self.p2_span.q.val();

        // p3: sixteen bits at a time, the lower ones without a sign.
        self.part_0.a.next = bit_cast_to::<S<17>>(self.at_factor.q.val().get_bits::<16>(0));
        self.part_1.a.next = bit_cast_to::<S<17>>(self.at_factor.q.val().get_bits::<16>(16));
        self.part_2.a.next = bit_cast_to::<S<17>>(self.at_factor.q.val() >> 32);
        self.part_0.b.next = self.at_span.q.val();
        self.part_1.b.next = self.at_span.q.val();
        self.part_2.b.next = self.at_span.q.val();
        self.p3_valid.d.next = self.at_valid.q.val();
        self.p3_second.d.next = self.at_second.q.val();
        self.p3_lane.d.next = self.at_lane.q.val();

        // p4 and p5: their sum; P bits hold every product of W by T bits.
        self.p4_low.d.next =
            bit_cast_to::<WideS<P>>(self.part_0.p.val()) + (bit_cast_to::<WideS<P>>(self.part_1.p.val()) << 16);
        self.p4_high.d.next = bit_cast_to::<WideS<P>>(self.part_2.p.val()) << 32;
        self.p4_valid.d.next = self.p3_valid.q.val();
        self.p4_second.d.next = self.p3_second.q.val();
        self.p4_lane.d.next = self.p3_lane.q.val();
        self.p5_product.d.next = self.p4_low.q.val() + self.p4_high.q.val();
        self.p5_valid.d.next = self.p4_valid.q.val();
        self.p5_second.d.next = self.p4_second.q.val();
        self.p5_lane.d.next = self.p4_lane.q.val();
        self.p4_origin.d.next = self.corner_a.val().get_bit(self.p3_lane.q.val().index());
        self.p4_base.d.next = self.base_reg.q.val().get_bit(self.p3_lane.q.val().index());
        self.p5_base.d.next = self.p4_base.q.val();
        if self.starts_base.q.val() {
            self.p5_base.d.next = (bit_cast_to::<S<W>>(self.p4_origin.q.val()) << self.guard.val()) | self.half.val();
        }

        // p6: only the lower W bits of the base vertex are kept: the sum wraps, and is right whenever the vertex fits.
        if self.p5_valid.q.val() && !self.p5_second.q.val() {
            self.p6_first.d.next = self.p5_product.q.val();
        }
        self.p6_difference.d.next = self.p6_first.q.val() - self.p5_product.q.val();
        self.p6_origin.d.next = self.p5_base.q.val() + bit_cast_to::<S<W>>(self.p5_product.q.val());
        self.p6_valid.d.next = self.p5_valid.q.val();
        self.p6_second.d.next = self.p5_second.q.val();
        self.p6_lane.d.next = self.p5_lane.q.val();

        // p7: 2a + area2 of the division by 2 area2: V + 1 + N bits of product, one more for the difference, g + 1 of shift.
        self.p7_numerator.d.next =
            (self.p6_difference.q.val() << self.guard_shift.val()) + bit_cast_to::<WideS<P>>(self.area2.val());
        self.p7_origin.d.next = self.p6_origin.q.val();
        self.p7_lane.d.next = self.p6_lane.q.val();

        // To its lane.
        self.puts_base.d.next = self.p6_valid.q.val() && self.sums_base.q.val();
        self.puts_numerator.d.next = self.p6_valid.q.val() && self.p6_second.q.val() && !self.sums_base.q.val();
        if self.puts_base.q.val() {
            self.base_reg.d.next =
                self.base_reg.q.val().replace_bit(self.p7_lane.q.val().index(), self.p7_origin.q.val());
        }
        if self.puts_numerator.q.val() {
            self.high.d.next = self.high.q.val().replace_bit(
                self.p7_lane.q.val().index(),
                bit_cast_to::<S<A>>(self.p7_numerator.q.val() >> self.quotient_bits.val()),
            );
            self.low.d.next = self
                .low
                .q
                .val()
                .replace_bit(self.p7_lane.q.val().index(), bit_cast_to::<S<W>>(self.p7_numerator.q.val()));
        }
        self.complete.d.next =
            (self.puts_base.q.val() || self.puts_numerator.q.val()) && self.p7_lane.q.val() == self.last_lane.val();

        self.divider.high.next = self.high.q.val();
        self.divider.low.next = self.low.q.val();
        self.divider.divisor.next = self.area2.val() << 1;
        self.divider.start.next = false;
        self.finished.d.next = self.divider.done.val();
        self.side_soon.d.next = false;
        self.sweep_soon.d.next = false;
        self.takes_side.d.next = self.side_soon.q.val();
        self.takes_sweep_quotient.d.next = self.sweep_soon.q.val();
        self.side_reg.enable.next = self.takes_side.q.val();
        self.side_reg.d.next = self.divider.quotient.val();
        self.sweep_reg.enable.next = self.takes_sweep_quotient.q.val();
        self.sweep_reg.d.next = self.divider.quotient.val();
        self.has_area.d.next = self.area2.val() != 0;
        if self.state.q.val() == InteriorState::Idle {
            self.count.d.next = 0.into();
            if self.start.val() && self.has_area.q.val() {
                self.state.d.next = InteriorState::SideProducts;
                self.goes.d.next = true;
            }
        } else if self.state.q.val() == InteriorState::SideProducts {
            if self.complete.q.val() {
                self.divider.start.next = true;
                self.state.d.next = InteriorState::SideQuotient;
                self.goes.d.next = true;
                self.count.d.next = 0.into();
            }
        } else if self.state.q.val() == InteriorState::SideQuotient {
            if self.finished.q.val() {
                self.side_soon.d.next = true;
                // 2 L + 8 cycles of products are over before the W + 2 of the division: the numerators are there.
                self.divider.start.next = true;
                self.state.d.next = InteriorState::SweepQuotient;
                self.goes.d.next = self.roof.val();
                self.count.d.next = 0.into();
            }
        } else if self.state.q.val() == InteriorState::SweepQuotient {
            if self.finished.q.val() {
                self.sweep_soon.d.next = true;
                self.state.d.next = InteriorState::Idle;
                if self.roof.val() {
                    self.state.d.next = InteriorState::BaseProducts;
                    self.goes.d.next = true;
                    self.count.d.next = 0.into();
                }
            }
        } else {
            if self.complete.q.val() {
                self.state.d.next = InteriorState::Idle;
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("interior_setup")
    }
}

watched! { [const L: usize, const V: usize, const W: usize, const T: usize, const A: usize, const P: usize] InteriorSetup<L, V, W, T, A, P>: start, corner_a, corner_b, corner_c, s_b, s_c, d_b, d_c, area2, roof; part_0, part_1, part_2, divider; state, count, issuing, finished, sums_base, takes_sweep, starts_base, has_area, p0_valid, p0_second, p0_lane, p1_valid, p1_second, p1_lane, p1_a, p1_b, p1_c, p1_quotient, p2_valid, p2_second, p2_lane, p2_factor, p2_span, p3_valid, p3_second, p3_lane, p4_valid, p4_second, p4_lane, p4_low, p4_high, p4_origin, p4_base, p5_valid, p5_second, p5_lane, p5_product, p5_base, p6_valid, p6_second, p6_lane, p6_first, p6_difference, p6_origin, complete, high, low, side_reg, sweep_reg, base_reg, part_0, part_1, part_2, divider, side_soon, sweep_soon, takes_side, takes_sweep_quotient, near_valid, near_second, near_lane, p7_lane, p7_numerator, p7_origin, sums_soon, takes_soon, starts_soon, at_valid, at_second, at_lane, at_factor, at_span, puts_base, puts_numerator, goes }
