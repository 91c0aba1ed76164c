// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sweep over a base triangle: which vertex moves next, on rows and columns alone.
//!
//! One micro-operation a cycle for the [`Walkers`](crate::remesher::Walkers), which hold the vertex data: decisions
//! never wait for additions. A sub-triangle is `width` strips; a strip is its first rung and then the side walk, in
//! which the left vertex climbs the left column and the upper edge, and the right vertex the right column.
//!
//! row_j = floor(row_0 + j dd / n + 1/2) of an edge vertex j by an exact rational walk: error e starts at n, grows by
//! 2 dd a step, and carries into the row when it leaves 0 .. 2n - 1. The column likewise.
//!
//! | port     | format      | meaning |   Latency 1, interval 1
//! | record_* | signed T    | of triangle_setup, relative to A; taken with the micro-operation `load`
//! | op_*     | stream      | see [`OpCode`]   Golden: models::remesher (sweep)   Error 0
//!
//! Ends for every record: each beat consumes an upper-edge vertex, a row of the left or one of the right column.

use crate::prelude::*;

/// Kinds of micro-operation (3 bits): the four beats of the step port, and two loads that send nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpCode;

impl OpCode {
    /// A rung of the side walk.
    pub const STEP: i64 = 0;
    /// First rung at a corner.
    pub const START: i64 = 1;
    /// First rung of a following strip.
    pub const INIT: i64 = 2;
    /// The last strip becomes a fan.
    pub const FAN: i64 = 3;
    /// Takes the record; walkers start at A.
    pub const LOAD_A: i64 = 4;
    /// Walkers start at B (second half of a roof).
    pub const LOAD_B: i64 = 5;
}

/// State of the sweep.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
#[allow(missing_docs)]
pub enum SweepState {
    Idle,
    LoadA,
    LoadB,
    /// First rung of a strip.
    Rung,
    /// Side walk.
    Walk,
    Fan,
    /// The only triangle of a base triangle on one grid point.
    Point,
}

/// The sweep, on scalars of `T` bits.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Sweep<const T: usize> {
    pub clock: Input<ClockReset>,
    pub record_valid: Input<Bit>,
    pub record_n_ab: Input<S<T>>,
    pub record_n_ac: Input<S<T>>,
    pub record_n_bc: Input<S<T>>,
    pub record_s_b: Input<S<T>>,
    pub record_s_c: Input<S<T>>,
    pub record_d_b: Input<S<T>>,
    pub record_d_c: Input<S<T>>,
    pub record_roof: Input<Bit>,
    pub record_point: Input<Bit>,
    pub record_swap: Input<Bit>,
    pub op_valid: Output<Bit>,
    pub op_ready: Input<Bit>,
    pub op_code: Output<U<3>>,
    /// Left vertex: 0 stays, 1 interior, 2 upper edge.
    pub op_left: Output<U<2>>,
    /// Right vertex: 0 stays, 1 interior, 2 column edge, 3 upper edge.
    pub op_right: Output<U<2>>,
    /// The sub-triangle starts at B.
    pub op_second: Output<Bit>,
    /// The upper edge walked is BC.
    pub op_on_bc: Output<Bit>,
    /// The first rung's right end is the far corner of the primary edge.
    pub op_at_end: Output<Bit>,
    /// Change of the base row towards the next column: -1, 0, 1.
    pub op_base: Output<S<2>>,
    /// The right column is an edge of the base triangle.
    pub op_column_edge: Output<Bit>,
    /// Source of the upper-edge vertex: 0 accumulator, 1 corner C, 2 corner B.
    pub op_edge: Output<U<2>>,
    /// The same for the vertex behind it.
    pub op_edge_next: Output<U<2>>,
    /// The upper edge advances by one vertex.
    pub op_advance: Output<Bit>,
    /// The upper edge goes on at C along CB.
    pub op_turn: Output<Bit>,
    /// Another strip follows before the next start: interior right vertices come again.
    pub op_keep: Output<Bit>,
    pub op_swap: Output<Bit>,
    pub op_last: Output<Bit>,
    state: Register<SweepState>,
    // The record, kept for the whole base triangle.
    n_ab: DataRegister<S<T>>,
    n_ac: DataRegister<S<T>>,
    n_bc: DataRegister<S<T>>,
    /// Columns from A to C, and from C to B.
    width_a: DataRegister<S<T>>,
    width_b: DataRegister<S<T>>,
    d_b: DataRegister<S<T>>,
    d_c: DataRegister<S<T>>,
    roof: DataRegister<Bit>,
    point: DataRegister<Bit>,
    swap: DataRegister<Bit>,
    // Sub-triangle.
    second: DataRegister<Bit>,
    /// The sub-triangle ends in the corner B, along CB.
    pointed: DataRegister<Bit>,
    on_bc: DataRegister<Bit>,
    corner_start: DataRegister<Bit>,
    column: DataRegister<S<T>>,
    width: DataRegister<S<T>>,
    /// Vertices of the primary edge passed.
    passed: DataRegister<S<T>>,
    row_primary: DataRegister<S<T>>,
    error_primary: DataRegister<S<T>>,
    row_base: DataRegister<S<T>>,
    // Upper edge: index, row, column and errors of the next vertex.
    edge_index: DataRegister<S<T>>,
    edge_row: DataRegister<S<T>>,
    edge_row_error: DataRegister<S<T>>,
    edge_column: DataRegister<S<T>>,
    edge_column_error: DataRegister<S<T>>,
    // Strip.
    row_left: DataRegister<S<T>>,
    row_right: DataRegister<S<T>>,
    on_edge: DataRegister<Bit>,
    column_edge: DataRegister<Bit>,
    column_index: DataRegister<S<T>>,
    right_error: DataRegister<S<T>>,
    // The micro-operation sent.
    out_valid: Register<Bit>,
    out_code: DataRegister<U<3>>,
    out_left: DataRegister<U<2>>,
    out_right: DataRegister<U<2>>,
    out_second: DataRegister<Bit>,
    out_on_bc: DataRegister<Bit>,
    out_at_end: DataRegister<Bit>,
    out_base: DataRegister<S<2>>,
    out_column_edge: DataRegister<Bit>,
    out_edge: DataRegister<U<2>>,
    out_edge_next: DataRegister<U<2>>,
    out_advance: DataRegister<Bit>,
    out_turn: DataRegister<Bit>,
    out_keep: DataRegister<Bit>,
    out_swap: DataRegister<Bit>,
    out_last: DataRegister<Bit>,
    go: Wire<Bit>,
    primary_slope: Wire<S<T>>,
    primary_sum: Wire<S<T>>,
    row_primary_next: Wire<S<T>>,
    error_primary_next: Wire<S<T>>,
    edge_length: Wire<S<T>>,
    edge_slope: Wire<S<T>>,
    edge_run: Wire<S<T>>,
    row_sum: Wire<S<T>>,
    column_sum: Wire<S<T>>,
    index_behind: Wire<S<T>>,
    index_next: Wire<S<T>>,
    row_next: Wire<S<T>>,
    row_error_next: Wire<S<T>>,
    column_next: Wire<S<T>>,
    column_error_next: Wire<S<T>>,
    turns: Wire<Bit>,
    last_column: Wire<Bit>,
    edge_is_last: Wire<Bit>,
    next_is_last: Wire<Bit>,
    edge_source: Wire<U<2>>,
    next_source: Wire<U<2>>,
    /// The left chain is complete: the next upper-edge vertex lies beyond the left column.
    complete: Wire<Bit>,
    complete_next: Wire<Bit>,
    column_length: Wire<S<T>>,
    right_slope: Wire<S<T>>,
    right_sum: Wire<S<T>>,
    at_column_end: Wire<Bit>,
    right_free: Wire<Bit>,
    right_free_next: Wire<Bit>,
    takes: Wire<Bit>,
    left: Wire<U<2>>,
    /// The code of a right move inside the column.
    free_move: Wire<U<2>>,
    right: Wire<U<2>>,
    advance: Wire<Bit>,
    strip_ends: Wire<Bit>,
    sub_ends: Wire<Bit>,
    triangle_ends: Wire<Bit>,
    pointed_strip: Wire<Bit>,
}

impl<const T: usize> Logic for Sweep<T> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, n_ab, n_ac, n_bc, width_a, width_b, d_b, d_c, roof);
        dff_setup!(self, clock, point, swap, second, pointed, on_bc, corner_start, column, width, passed);
        dff_setup!(
            self,
            clock,
            row_primary,
            error_primary,
            row_base,
            edge_index,
            edge_row,
            edge_row_error,
            edge_column,
            edge_column_error,
            row_left
        );
        dff_setup!(
            self,
            clock,
            row_right,
            on_edge,
            column_edge,
            column_index,
            right_error,
            out_valid,
            out_code,
            out_left,
            out_right,
            out_second
        );
        dff_setup!(
            self,
            clock,
            out_on_bc,
            out_at_end,
            out_base,
            out_column_edge,
            out_edge,
            out_edge_next,
            out_advance,
            out_turn,
            out_keep
        );
        dff_setup!(self, clock, out_swap, out_last);
        self.op_valid.next = self.out_valid.q.val();
        self.op_code.next = self.out_code.q.val();
        self.op_left.next = self.out_left.q.val();
        self.op_right.next = self.out_right.q.val();
        self.op_second.next = self.out_second.q.val();
        self.op_on_bc.next = self.out_on_bc.q.val();
        self.op_at_end.next = self.out_at_end.q.val();
        self.op_base.next = self.out_base.q.val();
        self.op_column_edge.next = self.out_column_edge.q.val();
        self.op_edge.next = self.out_edge.q.val();
        self.op_edge_next.next = self.out_edge_next.q.val();
        self.op_advance.next = self.out_advance.q.val();
        self.op_turn.next = self.out_turn.q.val();
        self.op_keep.next = self.out_keep.q.val();
        self.op_swap.next = self.out_swap.q.val();
        self.op_last.next = self.out_last.q.val();
        self.go.next = !self.out_valid.q.val() || self.op_ready.val();

        // The primary edge's next vertex.
        self.primary_slope.next = self.d_b.q.val();
        if self.second.q.val() {
            self.primary_slope.next = -self.d_b.q.val();
        }
        self.primary_sum.next = self.error_primary.q.val() + (self.primary_slope.val() << 1);
        self.row_primary_next.next = self.row_primary.q.val();
        self.error_primary_next.next = self.primary_sum.val();
        if self.primary_sum.val() < 0 {
            self.row_primary_next.next = self.row_primary.q.val() - 1;
            self.error_primary_next.next = self.primary_sum.val() + (self.n_ab.q.val() << 1);
        } else if self.primary_sum.val() >= (self.n_ab.q.val() << 1) {
            self.row_primary_next.next = self.row_primary.q.val() + 1;
            self.error_primary_next.next = self.primary_sum.val() - (self.n_ab.q.val() << 1);
        }

        // The upper edge: AC from A, CB from C, or BC from B; its vertex behind the next one.
        self.edge_length.next = self.n_ac.q.val();
        self.edge_slope.next = self.d_c.q.val();
        self.edge_run.next = self.width_a.q.val();
        if self.on_bc.q.val() {
            self.edge_length.next = self.n_bc.q.val();
            self.edge_run.next = self.width_b.q.val();
            self.edge_slope.next = self.d_b.q.val() - self.d_c.q.val();
            if self.second.q.val() {
                self.edge_slope.next = self.d_c.q.val() - self.d_b.q.val();
            }
        }
        self.index_behind.next = self.edge_index.q.val() + 1;
        self.index_next.next = self.index_behind.val();
        // It never falls: C lies above A, not above B where CB follows AC, and above B where BC is swept from B.
        self.row_sum.next = self.edge_row_error.q.val() + (self.edge_slope.val() << 1);
        self.row_next.next = self.edge_row.q.val();
        self.row_error_next.next = self.row_sum.val();
        if self.row_sum.val() >= (self.edge_length.val() << 1) {
            self.row_next.next = self.edge_row.q.val() + 1;
            self.row_error_next.next = self.row_sum.val() - (self.edge_length.val() << 1);
        }
        self.column_sum.next = self.edge_column_error.q.val() + (self.edge_run.val() << 1);
        self.column_next.next = self.edge_column.q.val();
        self.column_error_next.next = self.column_sum.val();
        if self.column_sum.val() >= (self.edge_length.val() << 1) {
            self.column_next.next = self.edge_column.q.val() + 1;
            self.column_error_next.next = self.column_sum.val() - (self.edge_length.val() << 1);
        }
        // C on the way from AC to CB is vertex 0 of CB.
        self.turns.next = self.pointed.q.val() && !self.on_bc.q.val() && self.index_behind.val() >= self.n_ac.q.val();
        if self.turns.val() {
            self.index_next.next = 0.into();
            self.row_next.next = self.d_c.q.val();
            self.row_error_next.next = self.n_bc.q.val();
            self.column_next.next = 0.into();
            self.column_error_next.next = self.n_bc.q.val();
        }
        self.last_column.next = self.column.q.val() + 1 == self.width.q.val();
        self.edge_is_last.next = self.edge_index.q.val() >= self.edge_length.val();
        self.next_is_last.next = !self.turns.val() && self.index_next.val() >= self.edge_length.val();
        self.edge_source.next = 0.into();
        if self.pointed.q.val() {
            if self.on_bc.q.val() && self.edge_index.q.val() == 0 {
                self.edge_source.next = 1.into();
            } else if self.edge_is_last.val() {
                self.edge_source.next = 2.into();
            }
        } else if self.edge_is_last.val() {
            self.edge_source.next = 1.into();
        }
        self.next_source.next = 0.into();
        if self.turns.val() {
            self.next_source.next = 1.into();
        } else if self.next_is_last.val() {
            self.next_source.next = 1.into();
            if self.pointed.q.val() {
                self.next_source.next = 2.into();
            }
        }
        // In the last column only the end vertex counts as beyond: a steep edge is not dragged from it.
        self.complete.next =
            self.edge_is_last.val() || (!self.last_column.val() && self.edge_column.q.val() > self.column.q.val());
        self.complete_next.next =
            self.next_is_last.val() || (!self.last_column.val() && self.column_next.val() > self.column.q.val());

        // May the right vertex go on inside its column? Otherwise only to the upper edge, once the left is complete.
        self.column_length.next = self.n_bc.q.val();
        if self.second.q.val() {
            self.column_length.next = self.n_ac.q.val();
        }
        // Its row, from B or from A, which never falls either.
        self.right_slope.next = self.d_c.q.val() - self.d_b.q.val();
        if self.second.q.val() {
            self.right_slope.next = self.d_c.q.val();
        }
        self.right_sum.next = self.right_error.q.val() + (self.right_slope.val() << 1);
        self.at_column_end.next = self.column_index.q.val() >= self.column_length.val();
        if self.column_edge.q.val() {
            self.right_free.next = !self.at_column_end.val();
            self.right_free_next.next = !self.at_column_end.val();
        } else {
            self.right_free.next = self.row_right.q.val() + 1 < self.edge_row.q.val();
            self.right_free_next.next = self.row_right.q.val() + 1 < self.row_next.val();
        }
        self.takes.next = self.on_edge.q.val() || self.row_left.q.val() + 1 >= self.edge_row.q.val();
        self.pointed_strip.next = self.pointed.q.val() && self.last_column.val();

        // The move of the side walk.
        self.free_move.next = 1.into();
        if self.column_edge.q.val() {
            self.free_move.next = 2.into();
        }
        self.left.next = 0.into();
        self.right.next = 0.into();
        self.advance.next = false;
        self.strip_ends.next = false;
        if self.state.q.val() == SweepState::Walk {
            if self.pointed_strip.val() {
                // The right end is B already: the left climbs alone, then fans along CB.
                if self.on_bc.q.val() && !self.takes.val() {
                    self.left.next = 1.into();
                } else {
                    self.left.next = 2.into();
                    self.advance.next = true;
                }
            } else if self.complete.val() {
                if self.right_free.val() {
                    self.right.next = self.free_move.val();
                } else {
                    self.right.next = 3.into();
                    self.strip_ends.next = true;
                }
            } else if self.row_left.q.val() > self.row_right.q.val() && self.right_free.val() {
                self.right.next = self.free_move.val();
            } else if self.takes.val() {
                self.left.next = 2.into();
                self.advance.next = true;
                if self.row_left.q.val() == self.row_right.q.val() {
                    if self.right_free_next.val() {
                        self.right.next = self.free_move.val();
                    } else if self.complete_next.val() {
                        self.right.next = 3.into();
                        self.strip_ends.next = true;
                    }
                }
            } else {
                self.left.next = 1.into();
                if self.row_left.q.val() == self.row_right.q.val() && self.right_free.val() {
                    self.right.next = self.free_move.val();
                }
            }
        } else if self.state.q.val() == SweepState::Fan {
            self.left.next = 2.into();
            self.advance.next = true;
        } else if self.state.q.val() == SweepState::Rung {
            self.advance.next = self.corner_start.q.val();
        }
        self.sub_ends.next = self.strip_ends.val() && self.last_column.val();
        self.triangle_ends.next = self.state.q.val() == SweepState::Point
            || (self.state.q.val() == SweepState::Fan && self.edge_is_last.val())
            || (self.sub_ends.val() && (self.width_b.q.val() == 0 || (self.roof.q.val() && self.second.q.val())));

        // The micro-operation.
        if self.go.val() {
            self.out_valid.d.next = self.state.q.val() != SweepState::Idle;
            self.out_left.d.next = self.left.val();
            self.out_right.d.next = self.right.val();
            self.out_second.d.next = self.second.q.val();
            self.out_on_bc.d.next = self.on_bc.q.val();
            self.out_at_end.d.next = self.passed.q.val() + 1 >= self.n_ab.q.val();
            self.out_base.d.next = bit_cast_to::<S<2>>(self.row_primary_next.val() - self.row_base.q.val());
            self.out_column_edge.d.next = self.column_edge.q.val();
            self.out_edge.d.next = self.edge_source.val();
            self.out_edge_next.d.next = self.next_source.val();
            self.out_advance.d.next = self.advance.val();
            self.out_turn.d.next = (self.advance.val() && self.turns.val())
                || (self.sub_ends.val() && !self.triangle_ends.val() && !self.roof.q.val());
            self.out_keep.d.next = !self.last_column.val() || (!self.roof.q.val() && !self.pointed.q.val());
            self.out_swap.d.next = self.swap.q.val() != self.second.q.val();
            self.out_last.d.next = self.triangle_ends.val();
            if self.advance.val() {
                self.edge_index.d.next = self.index_next.val();
                self.edge_row.d.next = self.row_next.val();
                self.edge_row_error.d.next = self.row_error_next.val();
                self.edge_column.d.next = self.column_next.val();
                self.edge_column_error.d.next = self.column_error_next.val();
                if self.turns.val() {
                    self.on_bc.d.next = true;
                }
            }
            match self.state.q.val() {
                SweepState::Idle => {}
                SweepState::LoadA => {
                    self.out_code.d.next = 4.into();
                    self.state.d.next = SweepState::Rung;
                    if self.roof.q.val() && self.width_a.q.val() == 0 {
                        self.state.d.next = SweepState::LoadB;
                    }
                    self.second.d.next = false;
                    self.on_bc.d.next = false;
                    self.pointed.d.next = !self.roof.q.val() && self.width_a.q.val() == 0;
                    self.width.d.next = self.width_a.q.val();
                    if self.width_a.q.val() == 0 {
                        self.width.d.next = self.width_b.q.val();
                    }
                    self.corner_start.d.next = true;
                    self.column.d.next = 0.into();
                    self.passed.d.next = 0.into();
                    self.row_primary.d.next = 0.into();
                    self.error_primary.d.next = self.n_ab.q.val();
                    self.row_base.d.next = 0.into();
                    self.edge_index.d.next = 0.into();
                    self.edge_row.d.next = 0.into();
                    self.edge_row_error.d.next = self.n_ac.q.val();
                    self.edge_column.d.next = 0.into();
                    self.edge_column_error.d.next = self.n_ac.q.val();
                }
                SweepState::LoadB => {
                    self.out_code.d.next = 5.into();
                    self.state.d.next = SweepState::Rung;
                    self.second.d.next = true;
                    self.on_bc.d.next = true;
                    self.pointed.d.next = false;
                    self.width.d.next = self.width_b.q.val();
                    self.corner_start.d.next = true;
                    self.column.d.next = 0.into();
                    self.passed.d.next = 0.into();
                    self.row_primary.d.next = self.d_b.q.val();
                    self.error_primary.d.next = self.n_ab.q.val();
                    self.row_base.d.next = self.d_b.q.val();
                    self.edge_index.d.next = 0.into();
                    self.edge_row.d.next = self.d_b.q.val();
                    self.edge_row_error.d.next = self.n_bc.q.val();
                    self.edge_column.d.next = 0.into();
                    self.edge_column_error.d.next = self.n_bc.q.val();
                }
                SweepState::Rung => {
                    self.out_code.d.next = 2.into();
                    if self.corner_start.q.val() {
                        self.out_code.d.next = 1.into();
                    }
                    self.corner_start.d.next = false;
                    self.state.d.next = SweepState::Walk;
                    if self.point.q.val() {
                        self.state.d.next = SweepState::Point;
                    }
                    self.on_edge.d.next = self.corner_start.q.val();
                    self.passed.d.next = self.passed.q.val() + 1;
                    self.row_left.d.next = self.row_primary.q.val();
                    self.row_right.d.next = self.row_primary_next.val();
                    self.row_primary.d.next = self.row_primary_next.val();
                    self.error_primary.d.next = self.error_primary_next.val();
                    self.row_base.d.next = self.row_primary_next.val();
                    self.column_index.d.next = 1.into();
                    self.right_error.d.next = self.column_length.val();
                    // The last column is an edge of the base triangle where no other half adjoins it.
                    self.column_edge.d.next = self.last_column.val()
                        && !self.pointed.q.val()
                        && ((self.second.q.val() && self.width_a.q.val() == 0)
                            || (!self.second.q.val() && self.width_b.q.val() == 0));
                    self.out_column_edge.d.next = self.last_column.val()
                        && !self.pointed.q.val()
                        && ((self.second.q.val() && self.width_a.q.val() == 0)
                            || (!self.second.q.val() && self.width_b.q.val() == 0));
                }
                SweepState::Walk => {
                    self.out_code.d.next = 0.into();
                    if self.left.val() == 1 {
                        self.row_left.d.next = self.row_left.q.val() + 1;
                    } else if self.left.val() == 2 {
                        self.row_left.d.next = self.edge_row.q.val();
                        self.on_edge.d.next = true;
                        if self.pointed_strip.val() && self.on_bc.q.val() {
                            self.out_code.d.next = 3.into();
                            self.state.d.next = SweepState::Fan;
                        }
                    }
                    if self.right.val() == 1 {
                        self.row_right.d.next = self.row_right.q.val() + 1;
                    } else if self.right.val() == 2 {
                        self.column_index.d.next = self.column_index.q.val() + 1;
                        self.right_error.d.next = self.right_sum.val();
                        if self.right_sum.val() >= (self.column_length.val() << 1) {
                            self.row_right.d.next = self.row_right.q.val() + 1;
                            self.right_error.d.next = self.right_sum.val() - (self.column_length.val() << 1);
                        }
                    }
                    if self.strip_ends.val() {
                        self.state.d.next = SweepState::Rung;
                        self.column.d.next = self.column.q.val() + 1;
                    }
                    if self.sub_ends.val() {
                        self.column.d.next = 0.into();
                        if self.roof.q.val() {
                            self.state.d.next = SweepState::LoadB;
                        } else {
                            // The second half goes on at C, which is not consumed yet.
                            self.pointed.d.next = true;
                            self.on_bc.d.next = true;
                            self.width.d.next = self.width_b.q.val();
                            self.edge_index.d.next = 0.into();
                            self.edge_row.d.next = self.d_c.q.val();
                            self.edge_row_error.d.next = self.n_bc.q.val();
                            self.edge_column.d.next = 0.into();
                            self.edge_column_error.d.next = self.n_bc.q.val();
                        }
                    }
                }
                SweepState::Fan => {
                    self.out_code.d.next = 0.into();
                }
                SweepState::Point => {
                    self.out_code.d.next = 0.into();
                    self.out_left.d.next = 2.into();
                    self.out_edge.d.next = 1.into();
                }
            }
            if self.triangle_ends.val() {
                self.state.d.next = SweepState::Idle;
            }
            if (self.state.q.val() == SweepState::Idle || self.triangle_ends.val()) && self.record_valid.val() {
                self.state.d.next = SweepState::LoadA;
                self.n_ab.d.next = self.record_n_ab.val();
                self.n_ac.d.next = self.record_n_ac.val();
                self.n_bc.d.next = self.record_n_bc.val();
                self.width_a.d.next = self.record_s_c.val();
                self.width_b.d.next = self.record_s_b.val() - self.record_s_c.val();
                self.d_b.d.next = self.record_d_b.val();
                self.d_c.d.next = self.record_d_c.val();
                self.roof.d.next = self.record_roof.val();
                self.point.d.next = self.record_point.val();
                self.swap.d.next = self.record_swap.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sweep")
    }
}

watched! { [const T: usize] Sweep<T>: record_valid, record_n_ab, record_n_ac, record_n_bc, record_s_b, record_s_c, record_d_b, record_d_c, record_roof, record_point, record_swap, op_ready;; state, n_ab, n_ac, n_bc, width_a, width_b, d_b, d_c, roof, point, swap, second, pointed, on_bc, corner_start, column, width, passed, row_primary, error_primary, row_base, edge_index, edge_row, edge_row_error, edge_column, edge_column_error, row_left, row_right, on_edge, column_edge, column_index, right_error, out_valid, out_code, out_left, out_right, out_second, out_on_bc, out_at_end, out_base, out_column_edge, out_edge, out_edge_next, out_advance, out_turn, out_keep, out_swap, out_last }
