// SPDX-License-Identifier: MIT OR Apache-2.0
//! The upper edge of a sub-triangle, two vertices ahead of the sweep: AC from A, CB from C, or BC from B.
//!
//! Vertex j of an edge of n steps lies at row floor(row_0 + j dd / n + 1/2), and at a column likewise. The walk is exact:
//! f starts at 2 dd - n and says by its sign whether the next row is a new one; it grows by 2 dd, and by 2 (dd - n) where
//! it is. Rows and columns never fall: C lies above A, not above B where CB follows AC, and above B where BC is swept from
//! B. Knowing two vertices ahead lets the sweep decide on flags, without an addition in front of the decision.
//!
//! | port            | format   | meaning |   Latency 1, interval 1
//! | n_*, d_*, width_* | signed T | of the record, stand still |   Golden: models::remesher (sweep)   Error 0
//! | derive, prepare | Bit      | one cycle each, in this order: differences, then first values of the walks |
//! | aim             | Bit      | the vertex ahead becomes the first one of the edge |
//! | shift           | Bit      | one vertex on; the next one is one cycle old at least when it is shifted in |
//! | last, source    | -        | of the next vertex; ahead_* of the one behind it; row_ahead, column_ahead: steps from |
//! |                 |          | the next vertex to the one ahead, row_behind, column_behind: from there to the third |

use crate::prelude::*;

/// The walk along the upper edge, on scalars of `T` bits.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct UpperEdge<const T: usize> {
    pub clock: Input<ClockReset>,
    pub n_ac: Input<S<T>>,
    pub n_bc: Input<S<T>>,
    pub width_a: Input<S<T>>,
    pub width_b: Input<S<T>>,
    pub d_c: Input<S<T>>,
    /// |d_C - d_B|.
    pub d_bc: Input<S<T>>,
    pub derive: Input<Bit>,
    pub prepare: Input<Bit>,
    pub aim: Input<Bit>,
    /// The edge aimed at is BC or CB.
    pub aim_bc: Input<Bit>,
    /// The walk begins at C.
    pub aim_c: Input<Bit>,
    /// CB follows AC.
    pub pointed: Input<Bit>,
    pub shift: Input<Bit>,
    pub last: Output<Bit>,
    pub ahead_last: Output<Bit>,
    pub behind_last: Output<Bit>,
    /// The next vertex lies on BC; C does.
    pub on_bc: Output<Bit>,
    /// The vertex ahead is C, with CB behind it.
    pub turns: Output<Bit>,
    /// 0 accumulator, 1 corner C, 2 corner B.
    pub source: Output<U<2>>,
    pub ahead_source: Output<U<2>>,
    pub row_ahead: Output<Bit>,
    pub column_ahead: Output<Bit>,
    pub row_behind: Output<Bit>,
    pub column_behind: Output<Bit>,
    /// First value and differences of the rows' walks, for a column edge.
    pub start_ac: Output<S<T>>,
    pub start_bc: Output<S<T>>,
    pub down_ac: Output<S<T>>,
    pub down_bc: Output<S<T>>,
    // dd - n, and 2 dd - n; -1 on an edge without length, whose rows never step.
    row_down_ac: DataRegister<S<T>>,
    row_down_bc: DataRegister<S<T>>,
    column_down_ac: DataRegister<S<T>>,
    column_down_bc: DataRegister<S<T>>,
    row_start_ac: DataRegister<S<T>>,
    row_start_bc: DataRegister<S<T>>,
    column_start_ac: DataRegister<S<T>>,
    column_start_bc: DataRegister<S<T>>,
    // An edge of one step at most, or of none.
    short_ac: DataRegister<Bit>,
    short_bc: DataRegister<Bit>,
    empty_ac: DataRegister<Bit>,
    empty_bc: DataRegister<Bit>,
    // The next vertex.
    next_last: DataRegister<Bit>,
    next_on_bc: DataRegister<Bit>,
    next_source: DataRegister<U<2>>,
    // The vertex ahead: steps to the end of its edge, and the walks to the third.
    ahead_left: DataRegister<S<T>>,
    /// One step or less is left.
    ahead_near_end: DataRegister<Bit>,
    ahead_on_bc: DataRegister<Bit>,
    ahead_c: DataRegister<Bit>,
    ahead_ends: DataRegister<Bit>,
    ahead_row: DataRegister<Bit>,
    ahead_column: DataRegister<Bit>,
    row_walk: DataRegister<S<T>>,
    column_walk: DataRegister<S<T>>,
    row_step: Wire<S<T>>,
    column_step: Wire<S<T>>,
    row_carries: Wire<Bit>,
    column_carries: Wire<Bit>,
    reaches_c: Wire<Bit>,
    ahead_from: Wire<U<2>>,
    none: Constant<S<T>>,
}

impl<const T: usize> Default for UpperEdge<T> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            n_ac: Input::default(),
            n_bc: Input::default(),
            width_a: Input::default(),
            width_b: Input::default(),
            d_c: Input::default(),
            d_bc: Input::default(),
            derive: Input::default(),
            prepare: Input::default(),
            aim: Input::default(),
            aim_bc: Input::default(),
            aim_c: Input::default(),
            pointed: Input::default(),
            shift: Input::default(),
            last: Output::default(),
            ahead_last: Output::default(),
            behind_last: Output::default(),
            on_bc: Output::default(),
            turns: Output::default(),
            source: Output::default(),
            ahead_source: Output::default(),
            row_ahead: Output::default(),
            column_ahead: Output::default(),
            row_behind: Output::default(),
            column_behind: Output::default(),
            start_ac: Output::default(),
            start_bc: Output::default(),
            down_ac: Output::default(),
            down_bc: Output::default(),
            row_down_ac: DataRegister::default(),
            row_down_bc: DataRegister::default(),
            column_down_ac: DataRegister::default(),
            column_down_bc: DataRegister::default(),
            row_start_ac: DataRegister::default(),
            row_start_bc: DataRegister::default(),
            column_start_ac: DataRegister::default(),
            column_start_bc: DataRegister::default(),
            short_ac: DataRegister::default(),
            short_bc: DataRegister::default(),
            empty_ac: DataRegister::default(),
            empty_bc: DataRegister::default(),
            next_last: DataRegister::default(),
            next_on_bc: DataRegister::default(),
            next_source: DataRegister::default(),
            ahead_left: DataRegister::default(),
            ahead_near_end: DataRegister::default(),
            ahead_on_bc: DataRegister::default(),
            ahead_c: DataRegister::default(),
            ahead_ends: DataRegister::default(),
            ahead_row: DataRegister::default(),
            ahead_column: DataRegister::default(),
            row_walk: DataRegister::default(),
            column_walk: DataRegister::default(),
            row_step: Wire::default(),
            column_step: Wire::default(),
            row_carries: Wire::default(),
            column_carries: Wire::default(),
            reaches_c: Wire::default(),
            ahead_from: Wire::default(),
            none: Constant::new(S::new(-1)),
        }
    }
}

impl<const T: usize> Logic for UpperEdge<T> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, row_down_ac, row_down_bc, column_down_ac, column_down_bc);
        dff_setup!(
            self,
            clock,
            row_start_ac,
            row_start_bc,
            column_start_ac,
            column_start_bc,
            short_ac,
            short_bc,
            empty_ac,
            empty_bc
        );
        dff_setup!(
            self,
            clock,
            next_last,
            next_on_bc,
            next_source,
            ahead_left,
            ahead_near_end,
            ahead_on_bc,
            ahead_c,
            ahead_ends
        );
        dff_setup!(self, clock, ahead_row, ahead_column, row_walk, column_walk);
        self.start_ac.next = self.row_start_ac.q.val();
        self.start_bc.next = self.row_start_bc.q.val();
        self.down_ac.next = self.row_down_ac.q.val();
        self.down_bc.next = self.row_down_bc.q.val();

        self.row_down_ac.enable.next = self.derive.val();
        self.row_down_ac.d.next = self.d_c.val() - self.n_ac.val();
        self.row_down_bc.enable.next = self.derive.val();
        self.row_down_bc.d.next = self.d_bc.val() - self.n_bc.val();
        self.column_down_ac.enable.next = self.derive.val();
        self.column_down_ac.d.next = self.width_a.val() - self.n_ac.val();
        self.column_down_bc.enable.next = self.derive.val();
        self.column_down_bc.d.next = self.width_b.val() - self.n_bc.val();
        self.short_ac.enable.next = self.derive.val();
        self.short_ac.d.next = self.n_ac.val() <= 1;
        self.empty_ac.enable.next = self.derive.val();
        self.empty_ac.d.next = self.n_ac.val() == 0;
        self.short_bc.enable.next = self.derive.val();
        self.short_bc.d.next = self.n_bc.val() <= 1;
        self.empty_bc.enable.next = self.derive.val();
        self.empty_bc.d.next = self.n_bc.val() == 0;
        self.row_start_ac.enable.next = self.prepare.val();
        self.row_start_ac.d.next = self.d_c.val() + self.row_down_ac.q.val();
        self.column_start_ac.enable.next = self.prepare.val();
        self.column_start_ac.d.next = self.width_a.val() + self.column_down_ac.q.val();
        if self.empty_ac.q.val() {
            self.row_start_ac.d.next = self.none.val();
            self.column_start_ac.d.next = self.none.val();
        }
        self.row_start_bc.enable.next = self.prepare.val();
        self.row_start_bc.d.next = self.d_bc.val() + self.row_down_bc.q.val();
        self.column_start_bc.enable.next = self.prepare.val();
        self.column_start_bc.d.next = self.width_b.val() + self.column_down_bc.q.val();
        if self.empty_bc.q.val() {
            self.row_start_bc.d.next = self.none.val();
            self.column_start_bc.d.next = self.none.val();
        }

        // From the vertex ahead to the third: C on the way from AC to CB is vertex 0 of CB.
        self.row_carries.next = self.row_walk.q.val() >= 0;
        self.column_carries.next = self.column_walk.q.val() >= 0;
        self.reaches_c.next = self.ahead_near_end.q.val() && self.pointed.val() && !self.ahead_on_bc.q.val();
        if self.ahead_on_bc.q.val() {
            self.row_step.next = self.d_bc.val();
            self.column_step.next = self.width_b.val();
            if self.row_carries.val() {
                self.row_step.next = self.row_down_bc.q.val();
            }
            if self.column_carries.val() {
                self.column_step.next = self.column_down_bc.q.val();
            }
        } else {
            self.row_step.next = self.d_c.val();
            self.column_step.next = self.width_a.val();
            if self.row_carries.val() {
                self.row_step.next = self.row_down_ac.q.val();
            }
            if self.column_carries.val() {
                self.column_step.next = self.column_down_ac.q.val();
            }
        }
        self.ahead_from.next = 0.into();
        if self.ahead_c.q.val() {
            self.ahead_from.next = 1.into();
        } else if self.ahead_ends.q.val() {
            self.ahead_from.next = 1.into();
            if self.pointed.val() {
                self.ahead_from.next = 2.into();
            }
        }

        self.last.next = self.next_last.q.val();
        self.on_bc.next = self.next_on_bc.q.val();
        self.source.next = self.next_source.q.val();
        self.ahead_last.next = self.ahead_ends.q.val();
        self.turns.next = self.ahead_c.q.val();
        self.ahead_source.next = self.ahead_from.val();
        self.row_ahead.next = self.ahead_row.q.val();
        self.column_ahead.next = self.ahead_column.q.val();
        self.behind_last.next = self.ahead_near_end.q.val() && !self.reaches_c.val();
        self.row_behind.next = self.row_carries.val();
        self.column_behind.next = self.column_carries.val();

        if self.aim.val() {
            self.ahead_on_bc.d.next = self.aim_bc.val();
            self.ahead_c.d.next = self.aim_c.val();
            self.ahead_row.d.next = false;
            self.ahead_column.d.next = false;
            if self.aim_bc.val() {
                self.ahead_left.d.next = self.n_bc.val();
                self.ahead_near_end.d.next = self.short_bc.q.val();
                self.ahead_ends.d.next = self.empty_bc.q.val();
                self.row_walk.d.next = self.row_start_bc.q.val();
                self.column_walk.d.next = self.column_start_bc.q.val();
            } else {
                self.ahead_left.d.next = self.n_ac.val();
                self.ahead_near_end.d.next = self.short_ac.q.val();
                self.ahead_ends.d.next = self.empty_ac.q.val();
                self.row_walk.d.next = self.row_start_ac.q.val();
                self.column_walk.d.next = self.column_start_ac.q.val();
            }
        } else if self.shift.val() {
            self.next_last.d.next = self.ahead_ends.q.val();
            self.next_on_bc.d.next = self.ahead_on_bc.q.val();
            self.next_source.d.next = self.ahead_from.val();
            self.ahead_row.d.next = self.row_carries.val();
            self.ahead_column.d.next = self.column_carries.val();
            self.ahead_c.d.next = self.reaches_c.val();
            self.ahead_ends.d.next = self.ahead_near_end.q.val() && !self.reaches_c.val();
            if self.reaches_c.val() {
                self.ahead_on_bc.d.next = true;
                self.ahead_left.d.next = self.n_bc.val();
                self.ahead_near_end.d.next = self.short_bc.q.val();
                self.row_walk.d.next = self.row_start_bc.q.val();
                self.column_walk.d.next = self.column_start_bc.q.val();
            } else {
                self.ahead_left.d.next = self.ahead_left.q.val() - 1;
                // At most 2 now. Of bits rather than by a comparison, which would be a subtraction.
                self.ahead_near_end.d.next = self.ahead_left.q.val() < 0
                    || ((self.ahead_left.q.val() >> 2) == 0
                        && !(self.ahead_left.q.val().get_bit(1) && self.ahead_left.q.val().get_bit(0)));
                self.row_walk.d.next = self.row_walk.q.val() + (self.row_step.val() << 1);
                self.column_walk.d.next = self.column_walk.q.val() + (self.column_step.val() << 1);
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("upper_edge")
    }
}

watched! { [const T: usize] UpperEdge<T>: n_ac, n_bc, width_a, width_b, d_c, d_bc, derive, prepare, aim, aim_bc, aim_c, pointed, shift;; row_down_ac, row_down_bc, column_down_ac, column_down_bc, row_start_ac, row_start_bc, column_start_ac, column_start_bc, short_ac, short_bc, empty_ac, empty_bc, next_last, next_on_bc, next_source, ahead_left, ahead_near_end, ahead_on_bc, ahead_c, ahead_ends, ahead_row, ahead_column, row_walk, column_walk }
