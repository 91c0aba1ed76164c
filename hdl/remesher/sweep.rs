// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sweep over a base triangle: which vertex moves next, on rows and columns alone.
//!
//! One micro-operation a cycle for the [`Walkers`](crate::remesher::Walkers), which hold the vertex data. A sub-triangle
//! is a number of strips; a strip is its first rung and then the side walk, in which the left vertex climbs the left
//! column and the upper edge, and the right vertex the right column.
//!
//! A decision never waits for an addition: it is made of flags that the cycle before has left. Rows are kept as
//! differences to the next vertex of the upper edge, which steps by at most one row and one column a vertex:
//!
//! rise = edge - primary edge, height = edge - left, gap = edge - right
//! left - right only counts as -1, 0, 1 or more; columns from the left column to the edge as 0, 1, 2.
//!
//! | port     | format      | meaning |   Latency 1, interval 1
//! | record_* | signed T    | of triangle_setup, relative to A; copied in `Idle`
//! | room     | Bit         | the queue behind has room; nothing moves without it
//! | op_*     | -           | see [`OpCode`]   Golden: models::remesher (sweep)   Error 0
//!
//! Ends for every record: each beat consumes an upper-edge vertex, a row of the left or one of the right column.

use crate::prelude::*;
use crate::remesher::UpperEdge;

/// Kinds of micro-operation (3 bits): the four beats of the step port, and four that send nothing.
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
    /// Takes the record.
    pub const LOAD: i64 = 4;
    /// The base walker starts: at A, or at the base vertex of B.
    pub const BASE: i64 = 5;
    /// The walker of the primary edge starts, at A or B.
    pub const PRIMARY: i64 = 6;
    /// The walker of the upper edge starts, at A or B.
    pub const EDGE: i64 = 7;
}

/// State of the sweep.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
#[allow(missing_docs)]
pub enum SweepState {
    Idle,
    /// Differences of the record.
    Derive,
    LoadA,
    LoadB,
    Base,
    Primary,
    Edge,
    /// First rung of a strip.
    Rung,
    /// Side walk.
    Walk,
    Fan,
    /// The only triangle of a base triangle on one grid point.
    Point,
}

/// The sweep, on scalars of `T` bits.
#[derive(Clone, Debug, LogicBlock)]
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
    pub room: Input<Bit>,
    pub op_valid: Output<Bit>,
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
    /// The base row changes towards the next column.
    pub op_climbs: Output<Bit>,
    /// Rows of the primary edge fall from A to B.
    pub op_falls: Output<Bit>,
    /// The right column is an edge of the base triangle.
    pub op_column_edge: Output<Bit>,
    /// Source of the upper-edge vertex: 0 accumulator, 1 corner C, 2 corner B.
    pub op_edge: Output<U<2>>,
    /// The same for the right vertex, which may be the one behind it.
    pub op_right_edge: Output<U<2>>,
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
    /// |d_C - d_B|.
    d_bc: DataRegister<S<T>>,
    roof: DataRegister<Bit>,
    point: DataRegister<Bit>,
    swap: DataRegister<Bit>,
    falls: DataRegister<Bit>,
    // Sub-triangle.
    second: DataRegister<Bit>,
    /// The sub-triangle ends in the corner B, along CB.
    pointed: DataRegister<Bit>,
    on_bc: DataRegister<Bit>,
    corner_start: DataRegister<Bit>,
    /// No other half adjoins the last column.
    open_side: DataRegister<Bit>,
    /// The open side has a vertex between its corners.
    long_side: DataRegister<Bit>,
    /// It has two.
    longer_side: DataRegister<Bit>,
    /// Nothing follows the last column.
    final_half: DataRegister<Bit>,
    /// Columns left, this one included.
    columns: DataRegister<S<T>>,
    last_column: DataRegister<Bit>,
    /// The strip that ends in B.
    pointed_strip: DataRegister<Bit>,
    // The primary edge: its walk as in the upper edge, and the vertices left.
    slope: DataRegister<S<T>>,
    slope_down: DataRegister<S<T>>,
    primary_walk: DataRegister<S<T>>,
    primary_left: DataRegister<S<T>>,
    // Rows and columns of the next upper-edge vertex against others.
    rise: DataRegister<S<T>>,
    height: DataRegister<S<T>>,
    gap: DataRegister<S<T>>,
    /// The gap is 4 or more.
    gap_far: DataRegister<Bit>,
    /// The left vertex stands a row or more above the right one, two or more, or as high.
    above: DataRegister<Bit>,
    far_above: DataRegister<Bit>,
    level: DataRegister<Bit>,
    /// The next upper-edge vertex lies beyond the left column, and beyond the right one.
    across: DataRegister<Bit>,
    far_across: DataRegister<Bit>,
    // The right column where it is an edge.
    column_edge: DataRegister<Bit>,
    right_left: DataRegister<S<T>>,
    /// The right vertex may go on along its edge behind the next move, too.
    right_more: DataRegister<Bit>,
    right_walk: DataRegister<S<T>>,
    // Flags of the next decision.
    /// The left vertex may go to the upper edge: it is there, or one row below.
    takes: DataRegister<Bit>,
    /// The left chain is complete: the next upper-edge vertex lies beyond the left column.
    complete: DataRegister<Bit>,
    complete_next: DataRegister<Bit>,
    /// The right vertex may go on inside its column; and once the edge has advanced.
    free: DataRegister<Bit>,
    free_next: DataRegister<Bit>,
    // The micro-operation sent.
    out_valid: Register<Bit>,
    out_code: DataRegister<U<3>>,
    out_left: DataRegister<U<2>>,
    out_right: DataRegister<U<2>>,
    out_second: DataRegister<Bit>,
    out_on_bc: DataRegister<Bit>,
    out_at_end: DataRegister<Bit>,
    out_climbs: DataRegister<Bit>,
    out_falls: DataRegister<Bit>,
    out_column_edge: DataRegister<Bit>,
    out_edge: DataRegister<U<2>>,
    out_right_edge: DataRegister<U<2>>,
    out_advance: DataRegister<Bit>,
    out_turn: DataRegister<Bit>,
    out_keep: DataRegister<Bit>,
    out_swap: DataRegister<Bit>,
    out_last: DataRegister<Bit>,
    upper: Gated<UpperEdge<T>>,
    primary_carries: Wire<Bit>,
    primary_step: Wire<S<T>>,
    right_carries: Wire<Bit>,
    right_step: Wire<S<T>>,
    right_length: Wire<S<T>>,
    right_start: Wire<S<T>>,
    /// The right vertex rises by a row with a free move.
    rises: Wire<Bit>,
    left: Wire<U<2>>,
    right: Wire<U<2>>,
    /// The right vertex moves inside its column.
    moves: Wire<Bit>,
    advance: Wire<Bit>,
    strip_ends: Wire<Bit>,
    sub_ends: Wire<Bit>,
    triangle_ends: Wire<Bit>,
    /// The upper edge rises by a row; the right vertex does.
    edge_up: Wire<Bit>,
    right_up: Wire<Bit>,
    negative: Wire<Bit>,
    from_five: Wire<Bit>,
    rise_low: Wire<U<2>>,
    rise_far: Wire<Bit>,
    rise_three: Wire<Bit>,
    low_0: Wire<Bit>,
    low_1: Wire<Bit>,
    // `gap` is at least -1, 0, 1, 2, 3.
    from_minus: Wire<Bit>,
    from_zero: Wire<Bit>,
    from_one: Wire<Bit>,
    from_two: Wire<Bit>,
    from_three: Wire<Bit>,
    primary_up: Wire<Bit>,
    primary_down: Wire<Bit>,
    /// `gap` changes by -1, 1, 2; none of them: it stays.
    less: Wire<Bit>,
    more: Wire<Bit>,
    two_more: Wire<Bit>,
    // Behind each move, with or without a step of the rows.
    gap_from: Wire<S<T>>,
    gap_change: Wire<S<T>>,
    rise_from: Wire<S<T>>,
    rise_change: Wire<S<T>>,
    far_none: Wire<Bit>,
    far_left: Wire<Bit>,
    far_right: Wire<Bit>,
    far_both: Wire<Bit>,
    far_rung: Wire<Bit>,
    rise_left_far: Wire<Bit>,
    leaves_up: Wire<Bit>,
    // Free and free once the edge has advanced, behind each of four moves: none, left, right, both.
    free_none: Wire<Bit>,
    free_left: Wire<Bit>,
    free_right: Wire<Bit>,
    free_both: Wire<Bit>,
    next_none: Wire<Bit>,
    next_left: Wire<Bit>,
    next_right: Wire<Bit>,
    next_both: Wire<Bit>,
    free_rung: Wire<Bit>,
    next_rung: Wire<Bit>,
    near_edge: Wire<Bit>,
    takes_base: Wire<Bit>,
    above_base: Wire<Bit>,
    far_above_base: Wire<Bit>,
    level_base: Wire<Bit>,
    in_rung: Wire<Bit>,
    zero: Constant<S<T>>,
    one: Constant<S<T>>,
    two: Constant<S<T>>,
}

impl<const T: usize> Default for Sweep<T> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            record_valid: Input::default(),
            record_n_ab: Input::default(),
            record_n_ac: Input::default(),
            record_n_bc: Input::default(),
            record_s_b: Input::default(),
            record_s_c: Input::default(),
            record_d_b: Input::default(),
            record_d_c: Input::default(),
            record_roof: Input::default(),
            record_point: Input::default(),
            record_swap: Input::default(),
            room: Input::default(),
            op_valid: Output::default(),
            op_code: Output::default(),
            op_left: Output::default(),
            op_right: Output::default(),
            op_second: Output::default(),
            op_on_bc: Output::default(),
            op_at_end: Output::default(),
            op_climbs: Output::default(),
            op_falls: Output::default(),
            op_column_edge: Output::default(),
            op_edge: Output::default(),
            op_right_edge: Output::default(),
            op_advance: Output::default(),
            op_turn: Output::default(),
            op_keep: Output::default(),
            op_swap: Output::default(),
            op_last: Output::default(),
            state: Register::default(),
            n_ab: DataRegister::default(),
            n_ac: DataRegister::default(),
            n_bc: DataRegister::default(),
            width_a: DataRegister::default(),
            width_b: DataRegister::default(),
            d_b: DataRegister::default(),
            d_c: DataRegister::default(),
            d_bc: DataRegister::default(),
            roof: DataRegister::default(),
            point: DataRegister::default(),
            swap: DataRegister::default(),
            falls: DataRegister::default(),
            second: DataRegister::default(),
            pointed: DataRegister::default(),
            on_bc: DataRegister::default(),
            corner_start: DataRegister::default(),
            open_side: DataRegister::default(),
            long_side: DataRegister::default(),
            longer_side: DataRegister::default(),
            final_half: DataRegister::default(),
            columns: DataRegister::default(),
            last_column: DataRegister::default(),
            pointed_strip: DataRegister::default(),
            slope: DataRegister::default(),
            slope_down: DataRegister::default(),
            primary_walk: DataRegister::default(),
            primary_left: DataRegister::default(),
            rise: DataRegister::default(),
            height: DataRegister::default(),
            gap: DataRegister::default(),
            gap_far: DataRegister::default(),
            above: DataRegister::default(),
            far_above: DataRegister::default(),
            level: DataRegister::default(),
            across: DataRegister::default(),
            far_across: DataRegister::default(),
            column_edge: DataRegister::default(),
            right_left: DataRegister::default(),
            right_more: DataRegister::default(),
            right_walk: DataRegister::default(),
            takes: DataRegister::default(),
            complete: DataRegister::default(),
            complete_next: DataRegister::default(),
            free: DataRegister::default(),
            free_next: DataRegister::default(),
            out_valid: Register::default(),
            out_code: DataRegister::default(),
            out_left: DataRegister::default(),
            out_right: DataRegister::default(),
            out_second: DataRegister::default(),
            out_on_bc: DataRegister::default(),
            out_at_end: DataRegister::default(),
            out_climbs: DataRegister::default(),
            out_falls: DataRegister::default(),
            out_column_edge: DataRegister::default(),
            out_edge: DataRegister::default(),
            out_right_edge: DataRegister::default(),
            out_advance: DataRegister::default(),
            out_turn: DataRegister::default(),
            out_keep: DataRegister::default(),
            out_swap: DataRegister::default(),
            out_last: DataRegister::default(),
            upper: Gated::default(),
            primary_carries: Wire::default(),
            primary_step: Wire::default(),
            right_carries: Wire::default(),
            right_step: Wire::default(),
            right_length: Wire::default(),
            right_start: Wire::default(),
            rises: Wire::default(),
            left: Wire::default(),
            right: Wire::default(),
            moves: Wire::default(),
            advance: Wire::default(),
            strip_ends: Wire::default(),
            sub_ends: Wire::default(),
            triangle_ends: Wire::default(),
            edge_up: Wire::default(),
            right_up: Wire::default(),
            negative: Wire::default(),
            from_five: Wire::default(),
            rise_low: Wire::default(),
            rise_far: Wire::default(),
            rise_three: Wire::default(),
            low_0: Wire::default(),
            low_1: Wire::default(),
            from_minus: Wire::default(),
            from_zero: Wire::default(),
            from_one: Wire::default(),
            from_two: Wire::default(),
            from_three: Wire::default(),
            primary_up: Wire::default(),
            primary_down: Wire::default(),
            less: Wire::default(),
            more: Wire::default(),
            two_more: Wire::default(),
            gap_from: Wire::default(),
            gap_change: Wire::default(),
            rise_from: Wire::default(),
            rise_change: Wire::default(),
            far_none: Wire::default(),
            far_left: Wire::default(),
            far_right: Wire::default(),
            far_both: Wire::default(),
            far_rung: Wire::default(),
            rise_left_far: Wire::default(),
            leaves_up: Wire::default(),
            free_none: Wire::default(),
            free_left: Wire::default(),
            free_right: Wire::default(),
            free_both: Wire::default(),
            next_none: Wire::default(),
            next_left: Wire::default(),
            next_right: Wire::default(),
            next_both: Wire::default(),
            free_rung: Wire::default(),
            next_rung: Wire::default(),
            near_edge: Wire::default(),
            takes_base: Wire::default(),
            above_base: Wire::default(),
            far_above_base: Wire::default(),
            level_base: Wire::default(),
            in_rung: Wire::default(),
            zero: Constant::new(S::new(0)),
            one: Constant::new(S::new(1)),
            two: Constant::new(S::new(2)),
        }
    }
}

impl<const T: usize> Logic for Sweep<T> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, n_ab, n_ac, n_bc, width_a, width_b, d_b, d_c);
        dff_setup!(self, clock, d_bc, roof, point, swap, falls, second, pointed, on_bc);
        dff_setup!(
            self,
            clock,
            corner_start,
            open_side,
            long_side,
            longer_side,
            final_half,
            columns,
            last_column,
            pointed_strip,
            slope,
            slope_down,
            primary_walk
        );
        dff_setup!(self, clock, primary_left, rise, height, gap, gap_far, above, far_above, level, across);
        dff_setup!(
            self,
            clock,
            far_across,
            column_edge,
            right_left,
            right_more,
            right_walk,
            takes,
            complete,
            complete_next,
            free
        );
        dff_setup!(self, clock, free_next, out_valid, out_code, out_left, out_right, out_second, out_on_bc, out_at_end);
        dff_setup!(
            self,
            clock,
            out_climbs,
            out_falls,
            out_column_edge,
            out_edge,
            out_right_edge,
            out_advance,
            out_turn,
            out_keep
        );
        dff_setup!(self, clock, out_swap, out_last);
        clock!(self, clock, upper);
        self.op_valid.next = self.out_valid.q.val();
        self.op_code.next = self.out_code.q.val();
        self.op_left.next = self.out_left.q.val();
        self.op_right.next = self.out_right.q.val();
        self.op_second.next = self.out_second.q.val();
        self.op_on_bc.next = self.out_on_bc.q.val();
        self.op_at_end.next = self.out_at_end.q.val();
        self.op_climbs.next = self.out_climbs.q.val();
        self.op_falls.next = self.out_falls.q.val();
        self.op_column_edge.next = self.out_column_edge.q.val();
        self.op_edge.next = self.out_edge.q.val();
        self.op_right_edge.next = self.out_right_edge.q.val();
        self.op_advance.next = self.out_advance.q.val();
        self.op_turn.next = self.out_turn.q.val();
        self.op_keep.next = self.out_keep.q.val();
        self.op_swap.next = self.out_swap.q.val();
        self.op_last.next = self.out_last.q.val();

        // The primary edge: its next row.
        self.primary_carries.next = (self.primary_walk.q.val() < 0) == (self.slope.q.val() < 0);
        self.primary_step.next = self.slope.q.val();
        if self.primary_carries.val() {
            self.primary_step.next = self.slope_down.q.val();
        }
        // The right column where it is an edge: AC from A, or BC from B, which never fall either.
        self.right_carries.next = self.right_walk.q.val() >= 0;
        if self.second.q.val() {
            self.right_length.next = self.n_ac.q.val();
            self.right_start.next = self.upper.start_ac.val();
            self.right_step.next = self.d_c.q.val();
            if self.right_carries.val() {
                self.right_step.next = self.upper.down_ac.val();
            }
        } else {
            self.right_length.next = self.n_bc.q.val();
            self.right_start.next = self.upper.start_bc.val();
            self.right_step.next = self.d_bc.q.val();
            if self.right_carries.val() {
                self.right_step.next = self.upper.down_bc.val();
            }
        }
        self.rises.next = !self.column_edge.q.val() || self.right_carries.val();

        // The move of the side walk.
        self.left.next = 0.into();
        self.right.next = 0.into();
        self.moves.next = false;
        self.advance.next = false;
        self.strip_ends.next = false;
        if self.state.q.val() == SweepState::Walk {
            if self.pointed_strip.q.val() {
                // The right end is B already: the left climbs alone, then fans along CB.
                if self.upper.on_bc.val() && !self.takes.q.val() {
                    self.left.next = 1.into();
                } else {
                    self.left.next = 2.into();
                    self.advance.next = true;
                }
            } else if self.complete.q.val() {
                self.moves.next = self.free.q.val();
                self.strip_ends.next = !self.free.q.val();
            } else if self.above.q.val() && self.free.q.val() {
                self.moves.next = true;
            } else if self.takes.q.val() {
                self.left.next = 2.into();
                self.advance.next = true;
                if self.level.q.val() {
                    self.moves.next = self.free_next.q.val();
                    self.strip_ends.next = !self.free_next.q.val() && self.complete_next.q.val();
                }
            } else {
                self.left.next = 1.into();
                self.moves.next = self.level.q.val() && self.free.q.val();
            }
        } else if self.state.q.val() == SweepState::Fan {
            self.left.next = 2.into();
            self.advance.next = true;
        } else if self.state.q.val() == SweepState::Rung {
            self.advance.next = self.corner_start.q.val();
        }
        if self.moves.val() {
            self.right.next = 1.into();
            if self.column_edge.q.val() {
                self.right.next = 2.into();
            }
        } else if self.strip_ends.val() {
            self.right.next = 3.into();
        }
        self.sub_ends.next = self.strip_ends.val() && self.last_column.q.val();
        self.triangle_ends.next = self.state.q.val() == SweepState::Point
            || (self.state.q.val() == SweepState::Fan && self.upper.last.val())
            || (self.sub_ends.val() && self.final_half.q.val());

        // How far the upper edge is from the right vertex behind this move. Sums with a term that small are choices.
        self.edge_up.next = self.advance.val() && self.upper.row_ahead.val();
        self.right_up.next = self.moves.val() && self.rises.val();
        self.primary_up.next = self.primary_carries.val() && self.slope.q.val() >= 0;
        self.primary_down.next = self.primary_carries.val() && self.slope.q.val() < 0;
        // In a first rung the right vertex starts on the primary edge's next row, and the edge has left its corner.
        self.leaves_up.next = self.corner_start.q.val() && self.upper.row_ahead.val();
        self.less.next = self.primary_up.val() && !self.leaves_up.val();
        self.more.next = self.leaves_up.val() != self.primary_down.val() && !self.primary_up.val();
        self.two_more.next = self.leaves_up.val() && self.primary_down.val();
        self.negative.next = self.gap.q.val() < 0;
        self.low_0.next = self.gap.q.val().get_bit(0);
        self.low_1.next = self.gap.q.val().get_bit(1);
        self.from_five.next =
            self.gap_far.q.val() && ((self.gap.q.val() >> 3) != 0 || self.low_1.val() || self.low_0.val());
        self.rise_far.next = self.rise.q.val() >= 0 && (self.rise.q.val() >> 2) != 0;
        self.rise_low.next = self.rise.q.val().get_bits::<2>(0);
        self.rise_three.next = self.rise_far.val() || (self.rise.q.val() >= 0 && self.rise_low.val() == 3);
        self.from_minus.next = !self.negative.val() || self.gap.q.val() == -1;
        self.from_zero.next = !self.negative.val();
        self.from_one.next = !self.negative.val() && (self.gap_far.q.val() || self.low_1.val() || self.low_0.val());
        self.from_two.next = !self.negative.val() && (self.gap_far.q.val() || self.low_1.val());
        self.from_three.next = !self.negative.val() && (self.gap_far.q.val() || (self.low_1.val() && self.low_0.val()));
        if self.two_more.val() {
            self.far_rung.next = self.from_two.val();
        } else if self.more.val() {
            self.far_rung.next = self.from_three.val();
        } else if self.less.val() {
            self.far_rung.next = self.from_five.val();
        } else {
            self.far_rung.next = self.gap_far.q.val();
        }
        self.gap_from.next = self.gap.q.val();
        if self.strip_ends.val() || self.state.q.val() == SweepState::Edge {
            self.gap_from.next = self.rise.q.val();
        }
        self.rise_from.next = self.rise.q.val();
        if self.state.q.val() == SweepState::Base {
            self.rise_from.next = self.zero.val();
        }
        if self.state.q.val() == SweepState::Rung {
            if self.two_more.val() {
                self.rise_change.next = self.two.val();
            } else if self.more.val() {
                self.rise_change.next = self.one.val();
            } else if self.less.val() {
                self.rise_change.next = -self.one.val();
            } else {
                self.rise_change.next = self.zero.val();
            }
            self.gap_change.next = self.rise_change.val();
        } else {
            self.rise_change.next = self.zero.val();
            self.gap_change.next = self.zero.val();
            if self.edge_up.val() {
                self.rise_change.next = self.one.val();
                if !self.right_up.val() {
                    self.gap_change.next = self.one.val();
                }
            } else if self.right_up.val() {
                self.gap_change.next = -self.one.val();
            }
        }

        // The flags behind each move are ready before the move is known.
        self.in_rung.next = self.state.q.val() == SweepState::Rung;
        if self.two_more.val() {
            self.free_rung.next = self.from_zero.val();
        } else if self.more.val() {
            self.free_rung.next = self.from_one.val();
        } else if self.less.val() {
            self.free_rung.next = self.from_three.val();
        } else {
            self.free_rung.next = self.from_two.val();
        }
        self.next_rung.next = self.free_rung.val();
        if (self.corner_start.q.val() && self.upper.row_behind.val())
            || (!self.corner_start.q.val() && self.upper.row_ahead.val())
        {
            if self.two_more.val() {
                self.next_rung.next = self.from_minus.val();
            } else if self.more.val() {
                self.next_rung.next = self.from_zero.val();
            } else if self.less.val() {
                self.next_rung.next = self.from_two.val();
            } else {
                self.next_rung.next = self.from_one.val();
            }
        }
        self.far_none.next = self.gap_far.q.val();
        self.far_left.next = self.gap_far.q.val();
        self.far_right.next = self.gap_far.q.val();
        self.far_both.next = self.gap_far.q.val();
        self.rise_left_far.next = self.rise_far.val();
        if self.upper.row_ahead.val() {
            self.rise_left_far.next = self.rise_three.val();
        }
        if self.in_rung.val() {
            self.far_none.next = self.far_rung.val();
            self.far_left.next = self.far_rung.val();
        } else {
            if self.upper.row_ahead.val() {
                self.far_left.next = self.from_three.val();
                if !self.rises.val() {
                    self.far_both.next = self.from_three.val();
                }
            } else if self.rises.val() {
                self.far_both.next = self.from_five.val();
            }
            if self.rises.val() {
                self.far_right.next = self.from_five.val();
            }
        }
        self.free_none.next = self.from_two.val();
        self.next_none.next = self.from_two.val();
        self.free_left.next = self.from_two.val();
        self.next_left.next = self.from_two.val();
        self.free_right.next = self.from_two.val();
        self.next_right.next = self.from_two.val();
        self.free_both.next = self.from_two.val();
        self.next_both.next = self.from_two.val();
        if self.in_rung.val() {
            // A first rung moves neither or the left one, and has counted that already.
            self.free_none.next = self.free_rung.val();
            self.next_none.next = self.next_rung.val();
            self.free_left.next = self.free_rung.val();
            self.next_left.next = self.next_rung.val();
            if self.last_column.q.val() && self.open_side.q.val() {
                self.free_none.next = self.long_side.q.val();
                self.next_none.next = self.long_side.q.val();
                self.free_left.next = self.long_side.q.val();
                self.next_left.next = self.long_side.q.val();
            }
        } else if self.column_edge.q.val() {
            self.free_none.next = self.free.q.val();
            self.next_none.next = self.free.q.val();
            self.free_left.next = self.free.q.val();
            self.next_left.next = self.free.q.val();
            self.free_right.next = self.right_more.q.val();
            self.next_right.next = self.right_more.q.val();
            self.free_both.next = self.right_more.q.val();
            self.next_both.next = self.right_more.q.val();
        } else {
            // The right vertex rises by one.
            self.free_right.next = self.from_three.val();
            self.next_right.next = self.from_three.val();
            self.free_both.next = self.from_three.val();
            self.next_both.next = self.from_three.val();
            if self.upper.row_ahead.val() {
                self.next_none.next = self.from_one.val();
                self.free_left.next = self.from_one.val();
                self.next_left.next = self.from_one.val();
                self.next_right.next = self.from_two.val();
                self.free_both.next = self.from_two.val();
                self.next_both.next = self.from_two.val();
                if self.upper.row_behind.val() {
                    self.next_left.next = self.from_zero.val();
                    self.next_both.next = self.from_one.val();
                }
            } else if self.upper.row_behind.val() {
                self.next_left.next = self.from_one.val();
                self.next_both.next = self.from_two.val();
            }
        }
        // Height at most 2, of bits rather than by a comparison, which would be a subtraction.
        self.near_edge.next = self.height.q.val() < 0
            || ((self.height.q.val() >> 2) == 0 && !(self.height.q.val().get_bit(1) && self.height.q.val().get_bit(0)));
        self.takes_base.next = self.takes.q.val();
        self.above_base.next = self.above.q.val();
        self.far_above_base.next = self.far_above.q.val();
        self.level_base.next = self.level.q.val();
        if self.in_rung.val() {
            self.takes_base.next = self.corner_start.q.val() || !self.from_two.val();
            self.above_base.next = self.primary_down.val();
            self.far_above_base.next = false;
            self.level_base.next = !self.primary_carries.val();
        }

        self.upper.n_ac.next = self.n_ac.q.val();
        self.upper.n_bc.next = self.n_bc.q.val();
        self.upper.width_a.next = self.width_a.q.val();
        self.upper.width_b.next = self.width_b.q.val();
        self.upper.d_c.next = self.d_c.q.val();
        self.upper.d_bc.next = self.d_bc.q.val();
        self.upper.pointed.next = self.pointed.q.val();
        self.upper.derive.next = self.room.val() && self.state.q.val() == SweepState::LoadA;
        self.upper.prepare.next = self.room.val() && self.state.q.val() == SweepState::Base;
        self.upper.aim.next = self.room.val() && self.state.q.val() == SweepState::Primary;
        self.upper.aim_bc.next = self.on_bc.q.val();
        self.upper.aim_c.next = !self.corner_start.q.val();
        self.upper.shift.next = self.room.val() && (self.advance.val() || self.state.q.val() == SweepState::Edge);

        self.out_valid.d.next = false;
        if self.room.val() {
            // The micro-operation.
            self.out_left.d.next = self.left.val();
            self.out_right.d.next = self.right.val();
            self.out_second.d.next = self.second.q.val();
            self.out_on_bc.d.next = self.upper.on_bc.val();
            self.out_at_end.d.next = self.primary_left.q.val() <= 1;
            self.out_climbs.d.next = self.primary_carries.val();
            self.out_falls.d.next = self.falls.q.val();
            self.out_edge.d.next = self.upper.source.val();
            self.out_right_edge.d.next = self.upper.source.val();
            if self.advance.val() {
                self.out_right_edge.d.next = self.upper.ahead_source.val();
            }
            self.out_advance.d.next = self.advance.val();
            self.out_turn.d.next = (self.advance.val() && self.upper.turns.val())
                || (self.sub_ends.val() && !self.final_half.q.val() && !self.roof.q.val());
            self.out_keep.d.next = !self.last_column.q.val() || (!self.roof.q.val() && !self.pointed.q.val());
            self.out_swap.d.next = self.swap.q.val() != self.second.q.val();
            self.out_last.d.next = self.triangle_ends.val();
            self.out_column_edge.d.next = self.last_column.q.val() && self.open_side.q.val();

            // Flags of the next decision.
            if self.advance.val() {
                self.complete.d.next = self.upper.ahead_last.val()
                    || (!self.last_column.q.val() && (self.across.q.val() || self.upper.column_ahead.val()));
                self.complete_next.d.next = self.upper.behind_last.val()
                    || (!self.last_column.q.val()
                        && (self.across.q.val() || self.upper.column_ahead.val() || self.upper.column_behind.val()));
            } else {
                self.complete.d.next = self.upper.last.val() || (!self.last_column.q.val() && self.across.q.val());
                self.complete_next.d.next = self.upper.ahead_last.val()
                    || (!self.last_column.q.val() && (self.across.q.val() || self.upper.column_ahead.val()));
            }
            if self.advance.val() && self.upper.column_ahead.val() {
                if !self.strip_ends.val() {
                    self.across.d.next = true;
                    self.far_across.d.next = self.across.q.val();
                }
            } else if self.strip_ends.val() {
                self.across.d.next = self.far_across.q.val();
                self.far_across.d.next = false;
            }
            self.gap.d.next = self.gap_from.val() + self.gap_change.val();
            self.rise.d.next = self.rise_from.val() + self.rise_change.val();
            if self.strip_ends.val() {
                self.gap_far.d.next = self.rise_far.val();
                if self.advance.val() {
                    self.gap_far.d.next = self.rise_left_far.val();
                }
            } else if self.advance.val() && self.moves.val() {
                self.gap_far.d.next = self.far_both.val();
            } else if self.advance.val() {
                self.gap_far.d.next = self.far_left.val();
            } else if self.moves.val() {
                self.gap_far.d.next = self.far_right.val();
            } else {
                self.gap_far.d.next = self.far_none.val();
            }
            if self.state.q.val() == SweepState::Edge {
                self.gap_far.d.next = self.rise_far.val();
            }
            if self.advance.val() && self.moves.val() {
                self.free.d.next = self.free_both.val();
                self.free_next.d.next = self.next_both.val();
            } else if self.advance.val() {
                self.free.d.next = self.free_left.val();
                self.free_next.d.next = self.next_left.val();
            } else if self.moves.val() {
                self.free.d.next = self.free_right.val();
                self.free_next.d.next = self.next_right.val();
            } else {
                self.free.d.next = self.free_none.val();
                self.free_next.d.next = self.next_none.val();
            }
            self.takes.d.next = self.takes_base.val()
                || self.left.val().get_bit(1)
                || (self.left.val().get_bit(0) && self.near_edge.val());
            if self.left.val().get_bit(1) {
                // The left vertex is where the edge was.
                if self.right_up.val() {
                    self.above.d.next = self.from_two.val();
                    self.far_above.d.next = self.from_three.val();
                    self.level.d.next = self.from_one.val() && !self.from_two.val();
                } else {
                    self.above.d.next = self.from_one.val();
                    self.far_above.d.next = self.from_two.val();
                    self.level.d.next = self.from_zero.val() && !self.from_one.val();
                }
            } else if self.left.val().get_bit(0) && !self.right_up.val() {
                self.above.d.next = self.above.q.val() || self.level.q.val();
                self.far_above.d.next = self.above.q.val();
                self.level.d.next = !self.above.q.val() && !self.level.q.val();
            } else if !self.left.val().get_bit(0) && self.right_up.val() {
                self.above.d.next = self.far_above.q.val();
                self.far_above.d.next = false;
                self.level.d.next = self.above.q.val() && !self.far_above.q.val();
            } else {
                self.above.d.next = self.above_base.val();
                self.far_above.d.next = self.far_above_base.val();
                self.level.d.next = self.level_base.val();
            }
            match self.state.q.val() {
                SweepState::Idle => {
                    if self.record_valid.val() {
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
                        self.state.d.next = SweepState::Derive;
                    }
                }
                SweepState::Derive => {
                    self.d_bc.d.next = self.d_b.q.val() - self.d_c.q.val();
                    if self.roof.q.val() {
                        self.d_bc.d.next = self.d_c.q.val() - self.d_b.q.val();
                    }
                    self.slope.d.next = self.d_b.q.val();
                    self.falls.d.next = self.d_b.q.val() < 0;
                    self.second.d.next = false;
                    self.on_bc.d.next = false;
                    self.corner_start.d.next = true;
                    self.pointed.d.next = !self.roof.q.val() && self.width_a.q.val() == 0;
                    self.columns.d.next = self.width_a.q.val();
                    if self.width_a.q.val() == 0 {
                        self.columns.d.next = self.width_b.q.val();
                    }
                    self.state.d.next = SweepState::LoadA;
                }
                SweepState::LoadA => {
                    self.out_valid.d.next = true;
                    self.out_code.d.next = 4.into();
                    self.state.d.next = SweepState::Base;
                    if self.roof.q.val() && self.width_a.q.val() == 0 {
                        self.state.d.next = SweepState::LoadB;
                    }
                }
                SweepState::LoadB => {
                    self.slope.d.next = -self.d_b.q.val();
                    self.second.d.next = true;
                    self.on_bc.d.next = true;
                    self.corner_start.d.next = true;
                    self.columns.d.next = self.width_b.q.val();
                    self.state.d.next = SweepState::Base;
                }
                SweepState::Base => {
                    self.out_valid.d.next = true;
                    self.out_code.d.next = 5.into();
                    self.slope_down.d.next = self.slope.q.val() - self.n_ab.q.val();
                    if self.slope.q.val() < 0 {
                        self.slope_down.d.next = self.slope.q.val() + self.n_ab.q.val();
                    }
                    self.primary_left.d.next = self.n_ab.q.val();
                    self.state.d.next = SweepState::Primary;
                }
                SweepState::Primary => {
                    self.out_valid.d.next = self.corner_start.q.val();
                    self.out_code.d.next = 6.into();
                    if self.corner_start.q.val() {
                        self.primary_walk.d.next = self.slope.q.val() + self.slope_down.q.val();
                    }
                    self.across.d.next = false;
                    self.far_across.d.next = false;
                    self.last_column.d.next = self.columns.q.val() == 1;
                    self.pointed_strip.d.next = self.pointed.q.val() && self.columns.q.val() == 1;
                    self.long_side.d.next = self.right_length.val() > 1;
                    self.longer_side.d.next = self.right_length.val() > 2;
                    if self.second.q.val() {
                        self.open_side.d.next = self.width_a.q.val() == 0;
                    } else {
                        self.open_side.d.next = !self.pointed.q.val() && self.width_b.q.val() == 0;
                    }
                    self.final_half.d.next = self.width_b.q.val() == 0 || (self.roof.q.val() && self.second.q.val());
                    self.state.d.next = SweepState::Edge;
                }
                SweepState::Edge => {
                    self.out_valid.d.next = self.corner_start.q.val();
                    self.out_code.d.next = 7.into();
                    self.state.d.next = SweepState::Rung;
                }
                SweepState::Rung => {
                    self.out_valid.d.next = true;
                    self.out_code.d.next = 2.into();
                    if self.corner_start.q.val() {
                        self.out_code.d.next = 1.into();
                    }
                    self.corner_start.d.next = false;
                    self.state.d.next = SweepState::Walk;
                    if self.point.q.val() {
                        self.state.d.next = SweepState::Point;
                    }
                    self.primary_left.d.next = self.primary_left.q.val() - 1;
                    self.primary_walk.d.next = self.primary_walk.q.val() + (self.primary_step.val() << 1);
                    self.height.d.next = self.rise.q.val();
                    // The last column is an edge of the base triangle where no other half adjoins it.
                    self.column_edge.d.next = self.last_column.q.val() && self.open_side.q.val();
                    self.right_left.d.next = self.right_length.val();
                    self.right_more.d.next = self.longer_side.q.val();
                    self.right_walk.d.next = self.right_start.val();
                }
                SweepState::Walk => {
                    self.out_valid.d.next = true;
                    self.out_code.d.next = 0.into();
                    if self.left.val() == 1 {
                        self.height.d.next = self.height.q.val() - 1;
                    } else if self.left.val() == 2 && self.pointed_strip.q.val() && self.upper.on_bc.val() {
                        self.out_code.d.next = 3.into();
                        self.state.d.next = SweepState::Fan;
                    }
                    if self.moves.val() {
                        self.right_left.d.next = self.right_left.q.val() - 1;
                        self.right_more.d.next = self.right_left.q.val() >= 0 && (self.right_left.q.val() >> 2) != 0;
                        self.right_walk.d.next = self.right_walk.q.val() + (self.right_step.val() << 1);
                    }
                    if self.strip_ends.val() {
                        self.columns.d.next = self.columns.q.val() - 1;
                        self.last_column.d.next = self.columns.q.val() == 2;
                        self.pointed_strip.d.next = self.pointed.q.val() && self.columns.q.val() == 2;
                        self.state.d.next = SweepState::Rung;
                    }
                    if self.sub_ends.val() {
                        if self.roof.q.val() {
                            self.state.d.next = SweepState::LoadB;
                        } else {
                            // The second half goes on at C, which is not consumed yet.
                            self.pointed.d.next = true;
                            self.on_bc.d.next = true;
                            self.columns.d.next = self.width_b.q.val();
                            self.state.d.next = SweepState::Primary;
                        }
                    }
                }
                SweepState::Fan => {
                    self.out_valid.d.next = true;
                    self.out_code.d.next = 0.into();
                }
                SweepState::Point => {
                    self.out_valid.d.next = true;
                    self.out_code.d.next = 0.into();
                    self.out_left.d.next = 2.into();
                    self.out_edge.d.next = 1.into();
                }
            }
            if self.triangle_ends.val() {
                self.state.d.next = SweepState::Idle;
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sweep")
    }
}

watched! { [const T: usize] Sweep<T>: record_valid, record_n_ab, record_n_ac, record_n_bc, record_s_b, record_s_c, record_d_b, record_d_c, record_roof, record_point, record_swap, room; upper; state, n_ab, n_ac, n_bc, width_a, width_b, d_b, d_c, d_bc, roof, point, swap, falls, second, pointed, on_bc, corner_start, open_side, long_side, longer_side, final_half, columns, last_column, pointed_strip, slope, slope_down, primary_walk, primary_left, rise, height, gap, gap_far, above, far_above, level, across, far_across, column_edge, right_left, right_more, right_walk, takes, complete, complete_next, free, free_next, out_valid, out_code, out_left, out_right, out_second, out_on_bc, out_at_end, out_climbs, out_falls, out_column_edge, out_edge, out_right_edge, out_advance, out_turn, out_keep, out_swap, out_last, upper }
