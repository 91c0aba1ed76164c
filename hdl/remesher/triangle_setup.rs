// SPDX-License-Identifier: MIT OR Apache-2.0
//! Roles of a base triangle: primary edge, remeshing plane, sweep direction, case and winding.
//!
//! The primary edge is the longest edge (ties: lowest index): along its main direction it holds the third corner between
//! its ends, or the edge to the corner outside were longer. A and B are its ends, C the side corner. The sweep
//! coordinate s runs along it, the side coordinate d is the other axis of larger projected area. d is mirrored so that C
//! lies above AB, and s where C lies below A (decreasing), after which A and B change places and the triangle is an
//! increasing one. All coordinates leave relative to A. (Gumhold & Huettner 1999, section 3.1, amended.)
//!
//! | port          | format        | range |   Latency 19, then the slower of edge_setup and interior_setup
//! | in_*          | stream        | corners 3 x signed N, vertex data L x signed V |
//! | record_*      | stream        | stands still from `record_valid` to `record_ready` |
//! | s_*, d_*, n_* | signed T      | relative to A, mirrored | Golden: models::remesher (setup)   Error 0

use crate::prelude::*;
use crate::remesher::EdgeMeasure;

/// Step of the set-up.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
#[allow(missing_docs)]
pub enum SetupState {
    Idle,
    /// Takes the base triangle that waits: a cycle for the wires to the vertex data.
    Take,
    /// Lengths and main directions of the edges, and which is longer than which, in five cycles.
    Measure,
    /// Which edge is the longest?
    Choose,
    /// Rotates it to AB.
    Rotate,
    /// Takes the ends along the sweep direction.
    Ends,
    /// Does s grow from A to B?
    Orient,
    /// Swaps A and B where it does not.
    Exchange,
    /// Four products of the two candidate areas.
    Areas,
    /// Sizes of the areas.
    Sizes,
    /// Which is larger?
    Compare,
    /// Takes it, mirrors d.
    Plane,
    /// Roof, increasing or decreasing.
    Case,
    /// Starts interior_setup.
    Interior,
    /// Waits for the divisions, then for the sweep.
    Wait,
}

/// Triangle set-up: `N` bits of coordinate, `T` = N + 3 bits of scalar, `A` = 2 N + 3 bits of area.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct TriangleSetup<const L: usize, const V: usize, const N: usize, const T: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_p0: Input<Lanes<3, N>>,
    pub in_p1: Input<Lanes<3, N>>,
    pub in_p2: Input<Lanes<3, N>>,
    pub in_v0: Input<Lanes<L, V>>,
    pub in_v1: Input<Lanes<L, V>>,
    pub in_v2: Input<Lanes<L, V>>,
    /// One cycle each: the units may begin.
    pub edge_start: Output<Bit>,
    pub interior_start: Output<Bit>,
    /// One of the two is at work.
    pub units_busy: Input<Bit>,
    pub record_valid: Output<Bit>,
    pub record_ready: Input<Bit>,
    pub corner_a: Output<Lanes<L, V>>,
    pub corner_b: Output<Lanes<L, V>>,
    pub corner_c: Output<Lanes<L, V>>,
    pub n_ab: Output<S<T>>,
    pub n_ac: Output<S<T>>,
    pub n_bc: Output<S<T>>,
    pub a_hi_ab: Output<Bit>,
    pub a_hi_ac: Output<Bit>,
    pub b_hi_bc: Output<Bit>,
    pub s_b: Output<S<T>>,
    pub s_c: Output<S<T>>,
    pub d_b: Output<S<T>>,
    pub d_c: Output<S<T>>,
    pub area2: Output<S<A>>,
    pub roof: Output<Bit>,
    /// All corners fall on one grid point.
    pub point: Output<Bit>,
    /// (A, B, C) is an odd permutation of the corners.
    pub swap: Output<Bit>,
    state: Register<SetupState>,
    round: Register<U<3>>,
    /// The units were at work in the cycle before, or begin.
    were_busy: Register<Bit>,
    // Corners and the edges ab, bc, ca between them: length, main direction.
    pa: DataRegister<Lanes<3, T>>,
    pb: DataRegister<Lanes<3, T>>,
    pc: DataRegister<Lanes<3, T>>,
    va: DataRegister<Lanes<L, V>>,
    vb: DataRegister<Lanes<L, V>>,
    vc: DataRegister<Lanes<L, V>>,
    /// The vertex data follow their corners two cycles later, all lanes by registers of their own: they take what is offered
    /// while nothing is shut, and change places; or stand.
    turns_bc: Register<Bit>,
    turns_ca: Register<Bit>,
    v_shut: Register<Bit>,
    /// The same a cycle before.
    shut: Register<Bit>,
    rests: Register<Bit>,
    c_rests: Register<Bit>,
    v_turns_bc: DataRegister<Bit>,
    v_turns_ca: DataRegister<Bit>,
    v_rests: Register<Bit>,
    vc_rests: Register<Bit>,
    len_ab: DataRegister<S<T>>,
    len_bc: DataRegister<S<T>>,
    len_ca: DataRegister<S<T>>,
    dir_ab: DataRegister<U<2>>,
    dir_bc: DataRegister<U<2>>,
    dir_ca: DataRegister<U<2>>,
    /// AB is as long as BC; AB as CA; BC as CA.
    ab_bc: DataRegister<Bit>,
    ab_ca: DataRegister<Bit>,
    bc_ca: DataRegister<Bit>,
    odd: DataRegister<Bit>,
    decreasing: DataRegister<Bit>,
    is_roof: DataRegister<Bit>,
    sb: DataRegister<S<T>>,
    sc: DataRegister<S<T>>,
    db: DataRegister<S<T>>,
    dc: DataRegister<S<T>>,
    area: DataRegister<S<A>>,
    // The second candidate for the side axis.
    db_other: DataRegister<S<T>>,
    dc_other: DataRegister<S<T>>,
    product: DataRegister<S<A>>,
    factor_a: DataRegister<S<T>>,
    factor_b: DataRegister<S<T>>,
    area_other: DataRegister<S<A>>,
    /// The longest edge is BC; or CA.
    longest_bc: DataRegister<Bit>,
    longest_ca: DataRegister<Bit>,
    /// A and B change places in the next cycle.
    backwards: DataRegister<Bit>,
    negative: DataRegister<Bit>,
    negative_other: DataRegister<Bit>,
    takes_other: DataRegister<Bit>,
    hi_ac: DataRegister<Bit>,
    hi_bc: DataRegister<Bit>,
    /// Ends of the edges along their main directions.
    a_along_ab: DataRegister<S<T>>,
    b_along_ab: DataRegister<S<T>>,
    a_along_ca: DataRegister<S<T>>,
    c_along_ca: DataRegister<S<T>>,
    b_along_bc: DataRegister<S<T>>,
    c_along_bc: DataRegister<S<T>>,
    multiplier: crate::primitives::Multiplier<T, T, A>,
    edge_ab: Gated<EdgeMeasure<T>>,
    edge_bc: Gated<EdgeMeasure<T>>,
    edge_ca: Gated<EdgeMeasure<T>>,
    exchange: Wire<Bit>,
    /// The next cycle is `Idle`, or `Idle` goes on.
    opens: Wire<Bit>,
    turns: Wire<Bit>,
    axis: Wire<U<2>>,
    side_axis: Wire<U<2>>,
    other_axis: Wire<U<2>>,
}

impl<const L: usize, const V: usize, const N: usize, const T: usize, const A: usize> Logic
    for TriangleSetup<L, V, N, T, A>
{
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, rests, c_rests);
        dff_setup!(self, clock, were_busy);
        dff_setup!(self, clock, shut);
        dff_setup!(self, clock, turns_bc, turns_ca, v_shut, v_turns_bc, v_turns_ca, v_rests, vc_rests);
        dff_setup!(
            self, clock, state, round, pa, pb, pc, va, vb, vc, len_ab, len_bc, len_ca, dir_ab, dir_bc, dir_ca, ab_bc,
            ab_ca, bc_ca
        );
        dff_setup!(self, clock, odd, decreasing, is_roof);
        dff_setup!(self, clock, sb, sc, db, dc, area, db_other, dc_other, product, factor_a, factor_b, area_other);
        dff_setup!(
            self,
            clock,
            longest_bc,
            longest_ca,
            backwards,
            negative,
            negative_other,
            takes_other,
            hi_ac,
            hi_bc,
            a_along_ab,
            b_along_ab,
            a_along_ca,
            c_along_ca,
            b_along_bc,
            c_along_bc
        );
        clock!(self, clock, multiplier, edge_ab, edge_bc, edge_ca);
        self.in_ready.next = self.state.q.val() == SetupState::Take;
        self.edge_start.next = self.state.q.val() == SetupState::Areas && self.round.q.val() == 1;
        self.interior_start.next = self.state.q.val() == SetupState::Interior;
        self.were_busy.d.next = self.units_busy.val() || self.state.q.val() == SetupState::Interior;
        self.record_valid.next = self.state.q.val() == SetupState::Wait && !self.were_busy.q.val();
        self.corner_a.next = self.va.q.val();
        self.corner_b.next = self.vb.q.val();
        self.corner_c.next = self.vc.q.val();
        self.n_ab.next = self.len_ab.q.val();
        self.n_ac.next = self.len_ca.q.val();
        self.n_bc.next = self.len_bc.q.val();
        self.a_hi_ab.next = self.decreasing.q.val();
        self.a_hi_ac.next = self.hi_ac.q.val();
        self.hi_ac.d.next = self.a_along_ca.q.val() > self.c_along_ca.q.val();
        self.b_hi_bc.next = self.hi_bc.q.val();
        self.hi_bc.d.next = self.b_along_bc.q.val() > self.c_along_bc.q.val();
        self.a_along_ab.d.next = self.pa.q.val().get_bit(self.dir_ab.q.val().index());
        self.b_along_ab.d.next = self.pb.q.val().get_bit(self.dir_ab.q.val().index());
        self.a_along_ca.d.next = self.pa.q.val().get_bit(self.dir_ca.q.val().index());
        self.c_along_ca.d.next = self.pc.q.val().get_bit(self.dir_ca.q.val().index());
        self.b_along_bc.d.next = self.pb.q.val().get_bit(self.dir_bc.q.val().index());
        self.c_along_bc.d.next = self.pc.q.val().get_bit(self.dir_bc.q.val().index());
        self.s_b.next = self.sb.q.val();
        self.s_c.next = self.sc.q.val();
        self.d_b.next = self.db.q.val();
        self.d_c.next = self.dc.q.val();
        self.area2.next = self.area.q.val();
        self.roof.next = self.is_roof.q.val();
        self.point.next = self.len_ab.q.val() == 0;
        self.swap.next = self.odd.q.val();

        self.edge_ab.from.next = self.pa.q.val();
        self.edge_ab.to.next = self.pb.q.val();
        self.edge_bc.from.next = self.pb.q.val();
        self.edge_bc.to.next = self.pc.q.val();
        self.edge_ca.from.next = self.pc.q.val();
        self.edge_ca.to.next = self.pa.q.val();
        self.axis.next = self.dir_ab.q.val();
        // The other two axes, the lower one first: it wins ties.
        if self.axis.val() == 0 {
            self.side_axis.next = 1.into();
            self.other_axis.next = 2.into();
        } else if self.axis.val() == 1 {
            self.side_axis.next = 0.into();
            self.other_axis.next = 2.into();
        } else {
            self.side_axis.next = 0.into();
            self.other_axis.next = 1.into();
        }
        // Products s_B d_C, d_B s_C of the first candidate, then of the other.
        self.factor_a.d.next = self.sb.q.val();
        self.factor_b.d.next = self.dc.q.val();
        if self.round.q.val() == 2 {
            self.factor_a.d.next = self.db.q.val();
            self.factor_b.d.next = self.sc.q.val();
        } else if self.round.q.val() == 3 {
            self.factor_b.d.next = self.dc_other.q.val();
        } else if self.round.q.val() == 4 {
            self.factor_a.d.next = self.db_other.q.val();
            self.factor_b.d.next = self.sc.q.val();
        }
        self.multiplier.a.next = self.factor_a.q.val();
        self.multiplier.b.next = self.factor_b.q.val();

        self.ab_bc.d.next = self.len_ab.q.val() >= self.len_bc.q.val();
        self.ab_ca.d.next = self.len_ab.q.val() >= self.len_ca.q.val();
        self.bc_ca.d.next = self.len_bc.q.val() >= self.len_ca.q.val();
        self.exchange.next = false;
        self.turns_bc.d.next = false;
        self.turns_ca.d.next = false;
        self.opens.next = (self.state.q.val() == SetupState::Idle && !self.in_valid.val())
            || (self.state.q.val() == SetupState::Wait && !self.were_busy.q.val() && self.record_ready.val());
        self.shut.d.next = !self.opens.val();
        self.v_shut.d.next = self.shut.q.val();
        self.v_turns_bc.d.next = self.turns_bc.q.val();
        self.v_turns_ca.d.next = self.turns_ca.q.val();
        self.turns.next =
            self.state.q.val() == SetupState::Rotate && (self.longest_bc.q.val() || self.longest_ca.q.val());
        self.c_rests.d.next = !(self.opens.val() || self.turns.val());
        self.v_rests.d.next = self.rests.q.val();
        self.vc_rests.d.next = self.c_rests.q.val();
        self.va.enable.next = !self.v_rests.q.val();
        self.vb.enable.next = !self.v_rests.q.val();
        self.vc.enable.next = !self.vc_rests.q.val();
        self.va.d.next = self.vb.q.val();
        self.vb.d.next = self.va.q.val();
        self.vc.d.next = self.vb.q.val();
        if !self.v_shut.q.val() {
            self.va.d.next = self.in_v0.val();
            self.vb.d.next = self.in_v1.val();
            self.vc.d.next = self.in_v2.val();
        } else if self.v_turns_bc.q.val() {
            self.vb.d.next = self.vc.q.val();
            self.vc.d.next = self.va.q.val();
        } else if self.v_turns_ca.q.val() {
            self.va.d.next = self.vc.q.val();
        }
        match self.state.q.val() {
            SetupState::Idle => {
                if self.in_valid.val() {
                    self.state.d.next = SetupState::Take;
                }
            }
            SetupState::Take => {
                self.pa.d.next = bit_cast_to::<Lanes<3, T>>(self.in_p0.val());
                self.pb.d.next = bit_cast_to::<Lanes<3, T>>(self.in_p1.val());
                self.pc.d.next = bit_cast_to::<Lanes<3, T>>(self.in_p2.val());
                // A source that takes its beat back begins again.
                self.state.d.next = SetupState::Idle;
                if self.in_valid.val() {
                    self.state.d.next = SetupState::Measure;
                }
                self.round.d.next = 0.into();
            }
            SetupState::Measure => {
                self.round.d.next = self.round.q.val() + 1;
                self.len_ab.d.next = self.edge_ab.length.val();
                self.len_bc.d.next = self.edge_bc.length.val();
                self.len_ca.d.next = self.edge_ca.length.val();
                self.dir_ab.d.next = self.edge_ab.direction.val();
                self.dir_bc.d.next = self.edge_bc.direction.val();
                self.dir_ca.d.next = self.edge_ca.direction.val();
                if self.round.q.val() == 4 {
                    self.state.d.next = SetupState::Choose;
                }
            }
            SetupState::Choose => {
                self.odd.d.next = false;
                self.decreasing.d.next = false;
                self.is_roof.d.next = false;
                self.state.d.next = SetupState::Rotate;
                self.longest_bc.d.next = false;
                self.longest_ca.d.next = false;
                if self.ab_bc.q.val() && self.ab_ca.q.val() {
                    // AB is P0 P1.
                } else if self.bc_ca.q.val() {
                    self.longest_bc.d.next = true;
                } else {
                    self.longest_ca.d.next = true;
                }
            }
            SetupState::Rotate => {
                self.state.d.next = SetupState::Ends;
                if self.longest_bc.q.val() {
                    self.pa.d.next = self.pb.q.val();
                    self.pb.d.next = self.pc.q.val();
                    self.pc.d.next = self.pa.q.val();
                    self.turns_bc.d.next = true;
                    self.len_ab.d.next = self.len_bc.q.val();
                    self.len_bc.d.next = self.len_ca.q.val();
                    self.len_ca.d.next = self.len_ab.q.val();
                    self.dir_ab.d.next = self.dir_bc.q.val();
                    self.dir_bc.d.next = self.dir_ca.q.val();
                    self.dir_ca.d.next = self.dir_ab.q.val();
                } else if self.longest_ca.q.val() {
                    self.pa.d.next = self.pc.q.val();
                    self.pb.d.next = self.pa.q.val();
                    self.pc.d.next = self.pb.q.val();
                    self.turns_ca.d.next = true;
                    self.len_ab.d.next = self.len_ca.q.val();
                    self.len_bc.d.next = self.len_ab.q.val();
                    self.len_ca.d.next = self.len_bc.q.val();
                    self.dir_ab.d.next = self.dir_ca.q.val();
                    self.dir_bc.d.next = self.dir_ab.q.val();
                    self.dir_ca.d.next = self.dir_bc.q.val();
                }
            }
            SetupState::Ends => {
                self.state.d.next = SetupState::Orient;
            }
            SetupState::Orient => {
                if self.len_ab.q.val() == 0 {
                    // Nothing to divide: one triangle of the three corners as they came.
                    self.state.d.next = SetupState::Wait;
                } else {
                    self.state.d.next = SetupState::Exchange;
                }
                self.backwards.d.next = self.a_along_ab.q.val() > self.b_along_ab.q.val();
            }
            SetupState::Exchange => {
                self.exchange.next = self.backwards.q.val();
                self.round.d.next = 0.into();
                self.state.d.next = SetupState::Areas;
            }
            SetupState::Areas => {
                self.round.d.next = self.round.q.val() + 1;
                // The spans stand from round 1 on; the corners do not move in between.
                self.sb.d.next =
                    self.pb.q.val().get_bit(self.axis.val().index()) - self.pa.q.val().get_bit(self.axis.val().index());
                self.sc.d.next =
                    self.pc.q.val().get_bit(self.axis.val().index()) - self.pa.q.val().get_bit(self.axis.val().index());
                self.db.d.next = self.pb.q.val().get_bit(self.side_axis.val().index())
                    - self.pa.q.val().get_bit(self.side_axis.val().index());
                self.dc.d.next = self.pc.q.val().get_bit(self.side_axis.val().index())
                    - self.pa.q.val().get_bit(self.side_axis.val().index());
                self.db_other.d.next = self.pb.q.val().get_bit(self.other_axis.val().index())
                    - self.pa.q.val().get_bit(self.other_axis.val().index());
                self.dc_other.d.next = self.pc.q.val().get_bit(self.other_axis.val().index())
                    - self.pa.q.val().get_bit(self.other_axis.val().index());
                if self.round.q.val() == 3 || self.round.q.val() == 5 {
                    self.product.d.next = bit_cast_to::<S<A>>(self.multiplier.p.val());
                } else if self.round.q.val() == 4 {
                    self.area.d.next = self.product.q.val() - bit_cast_to::<S<A>>(self.multiplier.p.val());
                } else if self.round.q.val() == 6 {
                    self.area_other.d.next = self.product.q.val() - bit_cast_to::<S<A>>(self.multiplier.p.val());
                    self.state.d.next = SetupState::Sizes;
                }
            }
            SetupState::Sizes => {
                self.state.d.next = SetupState::Compare;
                self.negative.d.next = self.area.q.val() < 0;
                self.negative_other.d.next = self.area_other.q.val() < 0;
                if self.area.q.val() < 0 {
                    self.area.d.next = -self.area.q.val();
                }
                if self.area_other.q.val() < 0 {
                    self.area_other.d.next = -self.area_other.q.val();
                }
            }
            SetupState::Compare => {
                self.state.d.next = SetupState::Plane;
                self.takes_other.d.next = self.area_other.q.val() > self.area.q.val();
            }
            SetupState::Plane => {
                self.state.d.next = SetupState::Case;
                if self.takes_other.q.val() {
                    self.area.d.next = self.area_other.q.val();
                    self.db.d.next = self.db_other.q.val();
                    self.dc.d.next = self.dc_other.q.val();
                    if self.negative_other.q.val() {
                        self.db.d.next = -self.db_other.q.val();
                        self.dc.d.next = -self.dc_other.q.val();
                    }
                } else if self.negative.q.val() {
                    self.db.d.next = -self.db.q.val();
                    self.dc.d.next = -self.dc.q.val();
                }
            }
            SetupState::Case => {
                self.state.d.next = SetupState::Interior;
                if self.dc.q.val() < 0 {
                    // Decreasing: mirror s, exchange A and B, and measure from the new A.
                    self.exchange.next = true;
                    self.decreasing.d.next = true;
                    self.sc.d.next = self.sb.q.val() - self.sc.q.val();
                    self.db.d.next = -self.db.q.val();
                    self.dc.d.next = self.dc.q.val() - self.db.q.val();
                } else {
                    self.is_roof.d.next = self.db.q.val() < self.dc.q.val();
                }
            }
            SetupState::Interior => {
                self.state.d.next = SetupState::Wait;
            }
            SetupState::Wait => {
                if !self.were_busy.q.val() && self.record_ready.val() {
                    self.state.d.next = SetupState::Idle;
                }
            }
        }
        self.rests.d.next = !(self.opens.val() || self.turns.val() || self.exchange.val());
        if self.exchange.val() {
            self.pa.d.next = self.pb.q.val();
            self.pb.d.next = self.pa.q.val();
            self.len_bc.d.next = self.len_ca.q.val();
            self.len_ca.d.next = self.len_bc.q.val();
            self.dir_bc.d.next = self.dir_ca.q.val();
            self.dir_ca.d.next = self.dir_bc.q.val();
            self.odd.d.next = !self.odd.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("triangle_setup")
    }
}

watched! { [const L: usize, const V: usize, const N: usize, const T: usize, const A: usize] TriangleSetup<L, V, N, T, A>: in_valid, in_p0, in_p1, in_p2, in_v0, in_v1, in_v2, units_busy, record_ready; multiplier, edge_ab, edge_bc, edge_ca; state, round, pa, pb, pc, va, vb, vc, len_ab, len_bc, len_ca, dir_ab, dir_bc, dir_ca, ab_bc, ab_ca, bc_ca, odd, decreasing, is_roof, sb, sc, db, dc, area, db_other, dc_other, product, factor_a, factor_b, area_other, longest_bc, longest_ca, backwards, negative, negative_other, takes_other, hi_ac, hi_bc, a_along_ab, b_along_ab, a_along_ca, c_along_ca, b_along_bc, c_along_bc, multiplier, edge_ab, edge_bc, edge_ca, turns_bc, turns_ca, v_shut, v_turns_bc, v_turns_ca, v_rests, vc_rests, shut, were_busy, rests, c_rests }
