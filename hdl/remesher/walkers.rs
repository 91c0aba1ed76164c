// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertex data of the sweep: five walkers that step by difference vertices, one micro-operation a cycle.
//!
//! primary (AB), base (row of the primary edge rounded to the grid), left and right column, upper edge. A walker from
//! the hi end of its edge starts at V * 2^g - rem and steps by -D, so both users of an edge meet the same bits; corners
//! always leave exactly. Accumulators have W bits and wrap: a sum is right whenever the true vertex fits.
//!
//! | port     | format       |   Latency 1, interval 1
//! | corner_*, step_*, rem_*, side, sweep, base_b | of the record; copied with the operation `LOAD_A` |
//! | op_*     | stream       | see [`Sweep`](crate::remesher::Sweep) |
//! | out_*    | stream       | beats with W-bit vertices, g fraction bits   Golden: models::remesher (sweep)   Error 0

use crate::prelude::*;

/// The walkers: `L` components, `V` bits a corner, `W` an accumulator, `T` a remainder.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Walkers<const L: usize, const V: usize, const W: usize, const T: usize> {
    pub clock: Input<ClockReset>,
    /// The record has been copied.
    pub record_ready: Output<Bit>,
    pub corner_a: Input<Lanes<L, V>>,
    pub corner_b: Input<Lanes<L, V>>,
    pub corner_c: Input<Lanes<L, V>>,
    pub step_ab: Input<Lanes<L, W>>,
    pub step_ac: Input<Lanes<L, W>>,
    pub step_bc: Input<Lanes<L, W>>,
    pub rem_ab: Input<Lanes<L, T>>,
    pub rem_ac: Input<Lanes<L, T>>,
    pub rem_bc: Input<Lanes<L, T>>,
    pub a_hi_ab: Input<Bit>,
    pub a_hi_ac: Input<Bit>,
    pub b_hi_bc: Input<Bit>,
    pub side: Input<Lanes<L, W>>,
    pub sweep: Input<Lanes<L, W>>,
    pub base_b: Input<Lanes<L, W>>,
    pub op_valid: Input<Bit>,
    pub op_ready: Output<Bit>,
    pub op_code: Input<U<3>>,
    pub op_left: Input<U<2>>,
    pub op_right: Input<U<2>>,
    pub op_second: Input<Bit>,
    pub op_on_bc: Input<Bit>,
    pub op_at_end: Input<Bit>,
    pub op_base: Input<S<2>>,
    pub op_column_edge: Input<Bit>,
    pub op_edge: Input<U<2>>,
    pub op_edge_next: Input<U<2>>,
    pub op_advance: Input<Bit>,
    pub op_turn: Input<Bit>,
    pub op_keep: Input<Bit>,
    pub op_swap: Input<Bit>,
    pub op_last: Input<Bit>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_kind: Output<U<2>>,
    pub out_left: Output<U<2>>,
    pub out_right: Output<U<2>>,
    pub out_keep: Output<Bit>,
    pub out_swap: Output<Bit>,
    pub out_last: Output<Bit>,
    pub out_left_vertex: Output<Lanes<L, W>>,
    pub out_right_vertex: Output<Lanes<L, W>>,
    // The record.
    va: DataRegister<Lanes<L, V>>,
    vb: DataRegister<Lanes<L, V>>,
    vc: DataRegister<Lanes<L, V>>,
    d_ab: DataRegister<Lanes<L, W>>,
    d_ac: DataRegister<Lanes<L, W>>,
    d_bc: DataRegister<Lanes<L, W>>,
    r_ab: DataRegister<Lanes<L, T>>,
    r_ac: DataRegister<Lanes<L, T>>,
    r_bc: DataRegister<Lanes<L, T>>,
    hi_ab: DataRegister<Bit>,
    hi_ac: DataRegister<Bit>,
    hi_bc: DataRegister<Bit>,
    d_side: DataRegister<Lanes<L, W>>,
    d_sweep: DataRegister<Lanes<L, W>>,
    origin_b: DataRegister<Lanes<L, W>>,
    // The walkers.
    primary_walker: DataRegister<Lanes<L, W>>,
    base_walker: DataRegister<Lanes<L, W>>,
    left_walker: DataRegister<Lanes<L, W>>,
    right_walker: DataRegister<Lanes<L, W>>,
    edge_walker: DataRegister<Lanes<L, W>>,
    // The beat sent.
    sent_valid: Register<Bit>,
    sent_kind: DataRegister<U<2>>,
    sent_left: DataRegister<U<2>>,
    sent_right: DataRegister<U<2>>,
    sent_keep: DataRegister<Bit>,
    sent_swap: DataRegister<Bit>,
    sent_last: DataRegister<Bit>,
    sent_left_vertex: DataRegister<Lanes<L, W>>,
    sent_right_vertex: DataRegister<Lanes<L, W>>,
    go: Wire<Bit>,
    first_load: Wire<Bit>,
    second_load: Wire<Bit>,
    beat: Wire<Bit>,
    primary_next: Wire<Lanes<L, W>>,
    base_shifted: Wire<Lanes<L, W>>,
    base_next: Wire<Lanes<L, W>>,
    edge_step: Wire<Lanes<L, W>>,
    right_next: Wire<Lanes<L, W>>,
    right_edge: Wire<U<2>>,
    guard: Constant<U<6>>,
}

impl<const L: usize, const V: usize, const W: usize, const T: usize> Default for Walkers<L, V, W, T> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            record_ready: Output::default(),
            corner_a: Input::default(),
            corner_b: Input::default(),
            corner_c: Input::default(),
            step_ab: Input::default(),
            step_ac: Input::default(),
            step_bc: Input::default(),
            rem_ab: Input::default(),
            rem_ac: Input::default(),
            rem_bc: Input::default(),
            a_hi_ab: Input::default(),
            a_hi_ac: Input::default(),
            b_hi_bc: Input::default(),
            side: Input::default(),
            sweep: Input::default(),
            base_b: Input::default(),
            op_valid: Input::default(),
            op_ready: Output::default(),
            op_code: Input::default(),
            op_left: Input::default(),
            op_right: Input::default(),
            op_second: Input::default(),
            op_on_bc: Input::default(),
            op_at_end: Input::default(),
            op_base: Input::default(),
            op_column_edge: Input::default(),
            op_edge: Input::default(),
            op_edge_next: Input::default(),
            op_advance: Input::default(),
            op_turn: Input::default(),
            op_keep: Input::default(),
            op_swap: Input::default(),
            op_last: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_kind: Output::default(),
            out_left: Output::default(),
            out_right: Output::default(),
            out_keep: Output::default(),
            out_swap: Output::default(),
            out_last: Output::default(),
            out_left_vertex: Output::default(),
            out_right_vertex: Output::default(),
            va: DataRegister::default(),
            vb: DataRegister::default(),
            vc: DataRegister::default(),
            d_ab: DataRegister::default(),
            d_ac: DataRegister::default(),
            d_bc: DataRegister::default(),
            r_ab: DataRegister::default(),
            r_ac: DataRegister::default(),
            r_bc: DataRegister::default(),
            hi_ab: DataRegister::default(),
            hi_ac: DataRegister::default(),
            hi_bc: DataRegister::default(),
            d_side: DataRegister::default(),
            d_sweep: DataRegister::default(),
            origin_b: DataRegister::default(),
            primary_walker: DataRegister::default(),
            base_walker: DataRegister::default(),
            left_walker: DataRegister::default(),
            right_walker: DataRegister::default(),
            edge_walker: DataRegister::default(),
            sent_valid: Register::default(),
            sent_kind: DataRegister::default(),
            sent_left: DataRegister::default(),
            sent_right: DataRegister::default(),
            sent_keep: DataRegister::default(),
            sent_swap: DataRegister::default(),
            sent_last: DataRegister::default(),
            sent_left_vertex: DataRegister::default(),
            sent_right_vertex: DataRegister::default(),
            go: Wire::default(),
            first_load: Wire::default(),
            second_load: Wire::default(),
            beat: Wire::default(),
            primary_next: Wire::default(),
            base_shifted: Wire::default(),
            base_next: Wire::default(),
            edge_step: Wire::default(),
            right_next: Wire::default(),
            right_edge: Wire::default(),
            guard: Constant::new(U::new((W - V - 1) as i64)),
        }
    }
}

impl<const L: usize, const V: usize, const W: usize, const T: usize> Logic for Walkers<L, V, W, T> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self, clock, va, vb, vc, d_ab, d_ac, d_bc, r_ab, r_ac, r_bc, hi_ab, hi_ac, hi_bc, d_side, d_sweep, origin_b
        );
        dff_setup!(
            self,
            clock,
            primary_walker,
            base_walker,
            left_walker,
            right_walker,
            edge_walker,
            sent_valid,
            sent_kind,
            sent_left,
            sent_right
        );
        dff_setup!(self, clock, sent_keep, sent_swap, sent_last, sent_left_vertex, sent_right_vertex);
        self.out_valid.next = self.sent_valid.q.val();
        self.out_kind.next = self.sent_kind.q.val();
        self.out_left.next = self.sent_left.q.val();
        self.out_right.next = self.sent_right.q.val();
        self.out_keep.next = self.sent_keep.q.val();
        self.out_swap.next = self.sent_swap.q.val();
        self.out_last.next = self.sent_last.q.val();
        self.out_left_vertex.next = self.sent_left_vertex.q.val();
        self.out_right_vertex.next = self.sent_right_vertex.q.val();
        self.go.next = !self.sent_valid.q.val() || self.out_ready.val();
        self.op_ready.next = self.go.val();
        self.first_load.next = self.go.val() && self.op_valid.val() && self.op_code.val() == 4;
        self.second_load.next = self.go.val() && self.op_valid.val() && self.op_code.val() == 5;
        self.beat.next = self.go.val() && self.op_valid.val() && self.op_code.val() < 4;
        self.record_ready.next = self.first_load.val();
        self.va.enable.next = self.first_load.val();
        self.va.d.next = self.corner_a.val();
        self.vb.enable.next = self.first_load.val();
        self.vb.d.next = self.corner_b.val();
        self.vc.enable.next = self.first_load.val();
        self.vc.d.next = self.corner_c.val();
        self.d_ab.enable.next = self.first_load.val();
        self.d_ab.d.next = self.step_ab.val();
        self.d_ac.enable.next = self.first_load.val();
        self.d_ac.d.next = self.step_ac.val();
        self.d_bc.enable.next = self.first_load.val();
        self.d_bc.d.next = self.step_bc.val();
        self.r_ab.enable.next = self.first_load.val();
        self.r_ab.d.next = self.rem_ab.val();
        self.r_ac.enable.next = self.first_load.val();
        self.r_ac.d.next = self.rem_ac.val();
        self.r_bc.enable.next = self.first_load.val();
        self.r_bc.d.next = self.rem_bc.val();
        self.hi_ab.enable.next = self.first_load.val();
        self.hi_ab.d.next = self.a_hi_ab.val();
        self.hi_ac.enable.next = self.first_load.val();
        self.hi_ac.d.next = self.a_hi_ac.val();
        self.hi_bc.enable.next = self.first_load.val();
        self.hi_bc.d.next = self.b_hi_bc.val();
        self.d_side.enable.next = self.first_load.val();
        self.d_side.d.next = self.side.val();
        self.d_sweep.enable.next = self.first_load.val();
        self.d_sweep.d.next = self.sweep.val();
        self.origin_b.enable.next = self.first_load.val();
        self.origin_b.d.next = self.base_b.val();

        if self.go.val() {
            self.sent_valid.d.next = self.beat.val();
        }
        self.primary_next.next = self.primary_walker.q.val();
        self.base_shifted.next = self.base_walker.q.val();
        self.base_next.next = self.base_walker.q.val();
        self.edge_step.next = self.edge_walker.q.val();
        self.right_next.next = self.right_walker.q.val();
        self.right_edge.next = 0.into();
        // Corners have g fraction bits; a walker starts at V * 2^g, less the remainder at the hi end.
        if self.first_load.val() {
            self.base_walker.d.next = bit_cast_to::<Lanes<L, W>>(self.corner_a.val()) << self.guard.val();
            self.primary_walker.d.next = bit_cast_to::<Lanes<L, W>>(self.corner_a.val()) << self.guard.val();
            self.edge_walker.d.next = bit_cast_to::<Lanes<L, W>>(self.corner_a.val()) << self.guard.val();
            if self.a_hi_ab.val() {
                self.primary_walker.d.next = (bit_cast_to::<Lanes<L, W>>(self.corner_a.val()) << self.guard.val())
                    - bit_cast_to::<Lanes<L, W>>(self.rem_ab.val());
            }
            if self.a_hi_ac.val() {
                self.edge_walker.d.next = (bit_cast_to::<Lanes<L, W>>(self.corner_a.val()) << self.guard.val())
                    - bit_cast_to::<Lanes<L, W>>(self.rem_ac.val());
            }
        } else if self.second_load.val() {
            self.base_walker.d.next = self.origin_b.q.val();
            self.primary_walker.d.next = bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val();
            self.edge_walker.d.next = bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val();
            if !self.hi_ab.q.val() {
                self.primary_walker.d.next = (bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val())
                    - bit_cast_to::<Lanes<L, W>>(self.r_ab.q.val());
            }
            if self.hi_bc.q.val() {
                self.edge_walker.d.next = (bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val())
                    - bit_cast_to::<Lanes<L, W>>(self.r_bc.q.val());
            }
        } else if self.beat.val() {
            self.sent_kind.d.next = bit_cast_to::<U<2>>(self.op_code.val());
            self.sent_left.d.next = self.op_left.val();
            self.sent_right.d.next = self.op_right.val();
            self.sent_keep.d.next = self.op_keep.val();
            self.sent_swap.d.next = self.op_swap.val();
            self.sent_last.d.next = self.op_last.val();
            // Upper edge: along AC from A, along BC from B, or along BC from C, which is its hi end where B is not.
            if self.op_turn.val() {
                self.edge_walker.d.next = bit_cast_to::<Lanes<L, W>>(self.vc.q.val()) << self.guard.val();
                if !self.hi_bc.q.val() {
                    self.edge_walker.d.next = (bit_cast_to::<Lanes<L, W>>(self.vc.q.val()) << self.guard.val())
                        - bit_cast_to::<Lanes<L, W>>(self.r_bc.q.val());
                }
            } else if self.op_advance.val() {
                if self.op_on_bc.val() {
                    self.edge_step.next = self.edge_walker.q.val() + self.d_bc.q.val();
                    if self.hi_bc.q.val() == self.op_second.val() {
                        self.edge_step.next = self.edge_walker.q.val() - self.d_bc.q.val();
                    }
                } else {
                    self.edge_step.next = self.edge_walker.q.val() + self.d_ac.q.val();
                    if self.hi_ac.q.val() {
                        self.edge_step.next = self.edge_walker.q.val() - self.d_ac.q.val();
                    }
                }
                self.edge_walker.d.next = self.edge_step.val();
            }
            if self.op_code.val() == 1 || self.op_code.val() == 2 {
                // First rung: the primary and base walkers go on by one column.
                self.primary_next.next = self.primary_walker.q.val() + self.d_ab.q.val();
                if self.hi_ab.q.val() != self.op_second.val() {
                    self.primary_next.next = self.primary_walker.q.val() - self.d_ab.q.val();
                }
                if self.op_base.val() == 0 {
                    self.base_shifted.next = self.base_walker.q.val();
                } else if self.op_base.val() < 0 {
                    self.base_shifted.next = self.base_walker.q.val() - self.d_side.q.val();
                } else {
                    self.base_shifted.next = self.base_walker.q.val() + self.d_side.q.val();
                }
                self.base_next.next = self.base_shifted.val() + self.d_sweep.q.val();
                if self.op_second.val() {
                    self.base_next.next = self.base_shifted.val() - self.d_sweep.q.val();
                }
                self.primary_walker.d.next = self.primary_next.val();
                self.base_walker.d.next = self.base_next.val();
                self.left_walker.d.next = self.base_walker.q.val();
                self.right_walker.d.next = self.base_next.val();
                if self.op_column_edge.val() {
                    if self.op_second.val() {
                        self.right_walker.d.next = bit_cast_to::<Lanes<L, W>>(self.va.q.val()) << self.guard.val();
                        if self.hi_ac.q.val() {
                            self.right_walker.d.next = (bit_cast_to::<Lanes<L, W>>(self.va.q.val())
                                << self.guard.val())
                                - bit_cast_to::<Lanes<L, W>>(self.r_ac.q.val());
                        }
                    } else {
                        self.right_walker.d.next = bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val();
                        if self.hi_bc.q.val() {
                            self.right_walker.d.next = (bit_cast_to::<Lanes<L, W>>(self.vb.q.val())
                                << self.guard.val())
                                - bit_cast_to::<Lanes<L, W>>(self.r_bc.q.val());
                        }
                    }
                }
                self.sent_right_vertex.d.next = self.primary_next.val();
                if self.op_second.val() {
                    self.sent_left_vertex.d.next = bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val();
                    if self.op_at_end.val() {
                        self.sent_right_vertex.d.next = bit_cast_to::<Lanes<L, W>>(self.va.q.val()) << self.guard.val();
                    }
                } else {
                    self.sent_left_vertex.d.next = bit_cast_to::<Lanes<L, W>>(self.va.q.val()) << self.guard.val();
                    if self.op_at_end.val() {
                        self.sent_right_vertex.d.next = bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val();
                    }
                }
            } else {
                if self.op_left.val() == 1 {
                    self.sent_left_vertex.d.next = self.left_walker.q.val() + self.d_side.q.val();
                    self.left_walker.d.next = self.left_walker.q.val() + self.d_side.q.val();
                } else if self.op_edge.val() == 0 {
                    self.sent_left_vertex.d.next = self.edge_walker.q.val();
                } else if self.op_edge.val() == 1 {
                    self.sent_left_vertex.d.next = bit_cast_to::<Lanes<L, W>>(self.vc.q.val()) << self.guard.val();
                } else {
                    self.sent_left_vertex.d.next = bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val();
                }
                if self.op_right.val() == 1 {
                    self.right_next.next = self.right_walker.q.val() + self.d_side.q.val();
                    self.right_walker.d.next = self.right_next.val();
                    self.sent_right_vertex.d.next = self.right_next.val();
                } else if self.op_right.val() == 2 {
                    if self.op_second.val() {
                        self.right_next.next = self.right_walker.q.val() + self.d_ac.q.val();
                        if self.hi_ac.q.val() {
                            self.right_next.next = self.right_walker.q.val() - self.d_ac.q.val();
                        }
                    } else {
                        self.right_next.next = self.right_walker.q.val() + self.d_bc.q.val();
                        if self.hi_bc.q.val() {
                            self.right_next.next = self.right_walker.q.val() - self.d_bc.q.val();
                        }
                    }
                    self.right_walker.d.next = self.right_next.val();
                    self.sent_right_vertex.d.next = self.right_next.val();
                } else if self.op_right.val() == 3 {
                    // The next upper-edge vertex: the one behind it, if the left has just taken the first.
                    self.right_edge.next = self.op_edge.val();
                    if self.op_advance.val() {
                        self.right_edge.next = self.op_edge_next.val();
                    }
                    if self.right_edge.val() == 0 {
                        self.sent_right_vertex.d.next = self.edge_step.val();
                    } else if self.right_edge.val() == 1 {
                        self.sent_right_vertex.d.next = bit_cast_to::<Lanes<L, W>>(self.vc.q.val()) << self.guard.val();
                    } else {
                        self.sent_right_vertex.d.next = bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val();
                    }
                }
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("walkers")
    }
}

watched! { [const L: usize, const V: usize, const W: usize, const T: usize] Walkers<L, V, W, T>: corner_a, corner_b, corner_c, step_ab, step_ac, step_bc, rem_ab, rem_ac, rem_bc, a_hi_ab, a_hi_ac, b_hi_bc, side, sweep, base_b, op_valid, op_code, op_left, op_right, op_second, op_on_bc, op_at_end, op_base, op_column_edge, op_edge, op_edge_next, op_advance, op_turn, op_keep, op_swap, op_last, out_ready;; va, vb, vc, d_ab, d_ac, d_bc, r_ab, r_ac, r_bc, hi_ab, hi_ac, hi_bc, d_side, d_sweep, origin_b, primary_walker, base_walker, left_walker, right_walker, edge_walker, sent_valid, sent_kind, sent_left, sent_right, sent_keep, sent_swap, sent_last, sent_left_vertex, sent_right_vertex }
