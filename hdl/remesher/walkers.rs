// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertex data of the sweep: five walkers that step by difference vertices, one micro-operation a cycle, in six stages
//! that never stall (the queue behind has room for all of them).
//!
//! primary (AB), base (row of the primary edge rounded to the grid), left and right column, upper edge. A walker from the
//! lo end of its edge starts at V * 2^g + 2^(g-1), one from the hi end at that less the division's remainder, so both users
//! of an edge meet the same bits; the half makes out = floor(acc / 2^g) round to nearest. Corners are sent exactly.
//! Accumulators have W bits and wrap: a sum is right whenever the true vertex fits.
//!
//! | stage | registers |
//! | s0    | controls decoded from the micro-operation |
//! | s1    | the same on their way to the lanes; the record is copied behind a `LOAD` here |
//! | s2    | where a walker starts (one bus for all), and the base walker's step: sweep, or sweep + side, or sweep - side |
//! | s3    | what each walker adds: a step, its complement (and one more), or its start |
//! | s4    | the accumulators: one addition each |
//! | sent  | the vertices of the beat |
//!
//! | port     | format       |   Latency 6, interval 1
//! | corner_*, step_*, start_*, side, sweep, base_b | of the record, standing still until the cycle behind `record_ready` |
//! | op_*     | -            | see [`Sweep`](crate::remesher::Sweep): 4 micro-operations between two beats and a `LOAD` |
//! | out_*    | -            | beats   Golden: models::remesher (sweep)   Error 1/2 unit of the vertex format, by the rounding
//!
//! Example, g = 13: a start of 2 * 2^13 + 2^12 leaves as 2; a step of 2^12 on makes it 3.

use crate::prelude::*;

/// The walkers: `L` components, `V` bits a corner, `W` an accumulator, `X` = W + 2 a sum with a carry in front.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Walkers<const L: usize, const V: usize, const W: usize, const X: usize> {
    pub clock: Input<ClockReset>,
    pub corner_a: Input<Lanes<L, V>>,
    pub corner_b: Input<Lanes<L, V>>,
    pub corner_c: Input<Lanes<L, V>>,
    pub step_ab: Input<Lanes<L, W>>,
    pub step_ac: Input<Lanes<L, W>>,
    pub step_bc: Input<Lanes<L, W>>,
    pub start_ab: Input<Lanes<L, W>>,
    pub start_ac: Input<Lanes<L, W>>,
    pub start_bc: Input<Lanes<L, W>>,
    pub a_hi_ab: Input<Bit>,
    pub a_hi_ac: Input<Bit>,
    pub b_hi_bc: Input<Bit>,
    pub side: Input<Lanes<L, W>>,
    pub sweep: Input<Lanes<L, W>>,
    pub base_b: Input<Lanes<L, W>>,
    pub op_valid: Input<Bit>,
    pub op_code: Input<U<3>>,
    pub op_left: Input<U<2>>,
    pub op_right: Input<U<2>>,
    pub op_second: Input<Bit>,
    pub op_on_bc: Input<Bit>,
    pub op_at_end: Input<Bit>,
    pub op_climbs: Input<Bit>,
    pub op_falls: Input<Bit>,
    pub op_column_edge: Input<Bit>,
    pub op_edge: Input<U<2>>,
    pub op_right_edge: Input<U<2>>,
    pub op_advance: Input<Bit>,
    pub op_turn: Input<Bit>,
    pub op_keep: Input<Bit>,
    pub op_swap: Input<Bit>,
    pub op_last: Input<Bit>,
    /// The record is copied in the next cycle.
    pub record_ready: Output<Bit>,
    pub out_valid: Output<Bit>,
    pub out_kind: Output<U<2>>,
    pub out_left: Output<U<2>>,
    pub out_right: Output<U<2>>,
    pub out_keep: Output<Bit>,
    pub out_swap: Output<Bit>,
    pub out_last: Output<Bit>,
    /// Two cycles behind the other outputs, which go through the commands and to the queue meanwhile.
    pub out_left_vertex: Output<Lanes<L, V>>,
    pub out_right_vertex: Output<Lanes<L, V>>,
    // The record.
    va: DataRegister<Lanes<L, V>>,
    vb: DataRegister<Lanes<L, V>>,
    vc: DataRegister<Lanes<L, V>>,
    d_ab: DataRegister<Lanes<L, W>>,
    d_ac: DataRegister<Lanes<L, W>>,
    d_bc: DataRegister<Lanes<L, W>>,
    from_ab: DataRegister<Lanes<L, W>>,
    from_ac: DataRegister<Lanes<L, W>>,
    from_bc: DataRegister<Lanes<L, W>>,
    d_side: DataRegister<Lanes<L, W>>,
    d_sweep: DataRegister<Lanes<L, W>>,
    origin_b: DataRegister<Lanes<L, W>>,
    hi_ab: DataRegister<Bit>,
    hi_ac: DataRegister<Bit>,
    hi_bc: DataRegister<Bit>,
    // Decoded.
    s0_load: DataRegister<Bit>,
    s0_bus: DataRegister<U<3>>,
    s0_to_primary: DataRegister<Bit>,
    s0_to_edge: DataRegister<Bit>,
    s0_to_right: DataRegister<Bit>,
    s0_rung: DataRegister<Bit>,
    s0_primary_minus: DataRegister<Bit>,
    s0_edge_moves: DataRegister<Bit>,
    s0_edge_minus: DataRegister<Bit>,
    s0_edge_bc: DataRegister<Bit>,
    s0_left_moves: DataRegister<Bit>,
    s0_from_base: DataRegister<Bit>,
    s0_base_takes: DataRegister<Bit>,
    s0_right_side: DataRegister<Bit>,
    s0_right_edge: DataRegister<Bit>,
    s0_right_ac: DataRegister<Bit>,
    s0_right_minus: DataRegister<Bit>,
    s0_climbs: DataRegister<Bit>,
    s0_side_minus: DataRegister<Bit>,
    s0_left_from: DataRegister<U<3>>,
    s0_right_from: DataRegister<U<3>>,
    s0_valid: Register<Bit>,
    s0_kind: DataRegister<U<2>>,
    s0_left: DataRegister<U<2>>,
    s0_right: DataRegister<U<2>>,
    s0_keep: DataRegister<Bit>,
    s0_swap: DataRegister<Bit>,
    s0_last: DataRegister<Bit>,
    // The same, on the way to the lanes.
    s1_load: DataRegister<Bit>,
    s1_bus_a: DataRegister<Bit>,
    s1_bus_b: DataRegister<Bit>,
    s1_bus_c: DataRegister<Bit>,
    s1_bus_ab: DataRegister<Bit>,
    s1_bus_ac: DataRegister<Bit>,
    s1_bus_bc: DataRegister<Bit>,
    s1_bus_origin: DataRegister<Bit>,
    s1_to_primary: DataRegister<Bit>,
    s1_to_edge: DataRegister<Bit>,
    s1_to_right: DataRegister<Bit>,
    s1_rung: DataRegister<Bit>,
    s1_primary_minus: DataRegister<Bit>,
    s1_primary_moves: DataRegister<Bit>,
    s1_edge_ac: DataRegister<Bit>,
    s1_edge_minus: DataRegister<Bit>,
    s1_edge_bc: DataRegister<Bit>,
    s1_left_moves: DataRegister<Bit>,
    s1_from_base: DataRegister<Bit>,
    s1_base_takes: DataRegister<Bit>,
    s1_right_side: DataRegister<Bit>,
    s1_right_across: DataRegister<Bit>,
    s1_right_ac: DataRegister<Bit>,
    s1_right_bc: DataRegister<Bit>,
    s1_right_minus: DataRegister<Bit>,
    s1_climbs: DataRegister<Bit>,
    s1_side_minus: DataRegister<Bit>,
    s1_left_from: DataRegister<U<3>>,
    s1_right_from: DataRegister<U<3>>,
    s1_valid: Register<Bit>,
    s1_kind: DataRegister<U<2>>,
    s1_left: DataRegister<U<2>>,
    s1_right: DataRegister<U<2>>,
    s1_keep: DataRegister<Bit>,
    s1_swap: DataRegister<Bit>,
    s1_last: DataRegister<Bit>,
    // The start bus and the step of the base walker.
    s2_start: DataRegister<Lanes<L, W>>,
    s2_across: DataRegister<Lanes<L, W>>,
    s2_to_primary: DataRegister<Bit>,
    s2_to_edge: DataRegister<Bit>,
    s2_to_right: DataRegister<Bit>,
    s2_rung: DataRegister<Bit>,
    s2_primary_minus: DataRegister<Bit>,
    s2_primary_moves: DataRegister<Bit>,
    s2_edge_ac: DataRegister<Bit>,
    s2_edge_minus: DataRegister<Bit>,
    s2_edge_bc: DataRegister<Bit>,
    s2_left_moves: DataRegister<Bit>,
    s2_from_base: DataRegister<Bit>,
    s2_base_takes: DataRegister<Bit>,
    s2_right_side: DataRegister<Bit>,
    s2_right_across: DataRegister<Bit>,
    s2_right_ac: DataRegister<Bit>,
    s2_right_bc: DataRegister<Bit>,
    s2_right_minus: DataRegister<Bit>,
    s2_left_from: DataRegister<U<3>>,
    s2_right_from: DataRegister<U<3>>,
    s2_valid: Register<Bit>,
    s2_kind: DataRegister<U<2>>,
    s2_left: DataRegister<U<2>>,
    s2_right: DataRegister<U<2>>,
    s2_keep: DataRegister<Bit>,
    s2_swap: DataRegister<Bit>,
    s2_last: DataRegister<Bit>,
    // What each walker adds.
    s3_primary_step: DataRegister<Lanes<L, W>>,
    s3_edge_step: DataRegister<Lanes<L, W>>,
    s3_left_step: DataRegister<Lanes<L, W>>,
    s3_right_step: DataRegister<Lanes<L, W>>,
    s3_primary_minus: DataRegister<Bit>,
    s3_edge_minus: DataRegister<Bit>,
    s3_right_minus: DataRegister<Bit>,
    s3_rung: DataRegister<Bit>,
    s3_to_primary: DataRegister<Bit>,
    s3_to_edge: DataRegister<Bit>,
    s3_to_right: DataRegister<Bit>,
    s3_from_base: DataRegister<Bit>,
    s3_base_takes: DataRegister<Bit>,
    s3_left_from_a: DataRegister<Bit>,
    s3_left_from_b: DataRegister<Bit>,
    s3_left_from_c: DataRegister<Bit>,
    s3_left_from_walker: DataRegister<Bit>,
    s3_left_from_edge: DataRegister<Bit>,
    s3_left_sent: DataRegister<Bit>,
    s3_right_from_a: DataRegister<Bit>,
    s3_right_from_b: DataRegister<Bit>,
    s3_right_from_c: DataRegister<Bit>,
    s3_right_from_walker: DataRegister<Bit>,
    s3_right_from_edge: DataRegister<Bit>,
    s3_right_from_primary: DataRegister<Bit>,
    s3_right_sent: DataRegister<Bit>,
    s3_valid: Register<Bit>,
    s3_kind: DataRegister<U<2>>,
    s3_left: DataRegister<U<2>>,
    s3_right: DataRegister<U<2>>,
    s3_keep: DataRegister<Bit>,
    s3_swap: DataRegister<Bit>,
    s3_last: DataRegister<Bit>,
    // The walkers.
    primary_walker: DataRegister<Lanes<L, W>>,
    base_walker: DataRegister<Lanes<L, W>>,
    left_walker: DataRegister<Lanes<L, W>>,
    right_walker: DataRegister<Lanes<L, W>>,
    edge_walker: DataRegister<Lanes<L, W>>,
    edge_before: DataRegister<Lanes<L, V>>,
    s4_base_takes: DataRegister<Bit>,
    s4_left_from_a: DataRegister<Bit>,
    s4_left_from_b: DataRegister<Bit>,
    s4_left_from_c: DataRegister<Bit>,
    s4_left_from_walker: DataRegister<Bit>,
    s4_left_from_edge: DataRegister<Bit>,
    s4_left_sent: DataRegister<Bit>,
    s4_right_from_a: DataRegister<Bit>,
    s4_right_from_b: DataRegister<Bit>,
    s4_right_from_c: DataRegister<Bit>,
    s4_right_from_walker: DataRegister<Bit>,
    s4_right_from_edge: DataRegister<Bit>,
    s4_right_from_primary: DataRegister<Bit>,
    s4_right_sent: DataRegister<Bit>,
    // The vertices sent.
    sent_left_vertex: DataRegister<Lanes<L, V>>,
    sent_right_vertex: DataRegister<Lanes<L, V>>,
    beat: Wire<Bit>,
    rung: Wire<Bit>,
    start: Wire<Lanes<L, W>>,
    on_a: Wire<Lanes<L, W>>,
    on_b: Wire<Lanes<L, W>>,
    on_c: Wire<Lanes<L, W>>,
    on_ab: Wire<Lanes<L, W>>,
    on_ac: Wire<Lanes<L, W>>,
    on_bc: Wire<Lanes<L, W>>,
    on_origin: Wire<Lanes<L, W>>,
    left_on_a: Wire<Lanes<L, V>>,
    left_on_b: Wire<Lanes<L, V>>,
    left_on_c: Wire<Lanes<L, V>>,
    left_on_walker: Wire<Lanes<L, V>>,
    left_on_edge: Wire<Lanes<L, V>>,
    right_on_a: Wire<Lanes<L, V>>,
    right_on_b: Wire<Lanes<L, V>>,
    right_on_c: Wire<Lanes<L, V>>,
    right_on_walker: Wire<Lanes<L, V>>,
    right_on_edge: Wire<Lanes<L, V>>,
    right_on_primary: Wire<Lanes<L, V>>,
    side_step: Wire<Lanes<L, W>>,
    side_carry: Wire<Lanes<L, X>>,
    primary_from: Wire<Lanes<L, W>>,
    primary_carry: Wire<Lanes<L, X>>,
    edge_from: Wire<Lanes<L, W>>,
    edge_carry: Wire<Lanes<L, X>>,
    left_from: Wire<Lanes<L, W>>,
    right_from: Wire<Lanes<L, W>>,
    right_free: Wire<Bit>,
    on_to_primary: Wire<Lanes<L, W>>,
    on_primary_moves: Wire<Lanes<L, W>>,
    on_primary_minus: Wire<Lanes<L, W>>,
    on_to_edge: Wire<Lanes<L, W>>,
    on_edge_ac: Wire<Lanes<L, W>>,
    on_edge_bc: Wire<Lanes<L, W>>,
    on_edge_minus: Wire<Lanes<L, W>>,
    on_left_moves: Wire<Lanes<L, W>>,
    on_to_right: Wire<Lanes<L, W>>,
    on_right_side: Wire<Lanes<L, W>>,
    on_right_across: Wire<Lanes<L, W>>,
    on_right_ac: Wire<Lanes<L, W>>,
    on_right_bc: Wire<Lanes<L, W>>,
    on_right_minus: Wire<Lanes<L, W>>,
    right_carry: Wire<Lanes<L, X>>,
    guard: Constant<U<6>>,
    half: Constant<Lanes<L, W>>,
    one: Constant<Lanes<L, X>>,
    zero: Constant<Lanes<L, X>>,
    none: Constant<Lanes<L, W>>,
    all: Constant<Lanes<L, W>>,
    no_bit: Constant<Lanes<L, V>>,
    every_bit: Constant<Lanes<L, V>>,
}

impl<const L: usize, const V: usize, const W: usize, const X: usize> Default for Walkers<L, V, W, X> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            corner_a: Input::default(),
            corner_b: Input::default(),
            corner_c: Input::default(),
            step_ab: Input::default(),
            step_ac: Input::default(),
            step_bc: Input::default(),
            start_ab: Input::default(),
            start_ac: Input::default(),
            start_bc: Input::default(),
            a_hi_ab: Input::default(),
            a_hi_ac: Input::default(),
            b_hi_bc: Input::default(),
            side: Input::default(),
            sweep: Input::default(),
            base_b: Input::default(),
            op_valid: Input::default(),
            op_code: Input::default(),
            op_left: Input::default(),
            op_right: Input::default(),
            op_second: Input::default(),
            op_on_bc: Input::default(),
            op_at_end: Input::default(),
            op_climbs: Input::default(),
            op_falls: Input::default(),
            op_column_edge: Input::default(),
            op_edge: Input::default(),
            op_right_edge: Input::default(),
            op_advance: Input::default(),
            op_turn: Input::default(),
            op_keep: Input::default(),
            op_swap: Input::default(),
            op_last: Input::default(),
            record_ready: Output::default(),
            out_valid: Output::default(),
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
            from_ab: DataRegister::default(),
            from_ac: DataRegister::default(),
            from_bc: DataRegister::default(),
            d_side: DataRegister::default(),
            d_sweep: DataRegister::default(),
            origin_b: DataRegister::default(),
            hi_ab: DataRegister::default(),
            hi_ac: DataRegister::default(),
            hi_bc: DataRegister::default(),
            s0_load: DataRegister::default(),
            s0_bus: DataRegister::default(),
            s0_to_primary: DataRegister::default(),
            s0_to_edge: DataRegister::default(),
            s0_to_right: DataRegister::default(),
            s0_rung: DataRegister::default(),
            s0_primary_minus: DataRegister::default(),
            s0_edge_moves: DataRegister::default(),
            s0_edge_minus: DataRegister::default(),
            s0_edge_bc: DataRegister::default(),
            s0_left_moves: DataRegister::default(),
            s0_from_base: DataRegister::default(),
            s0_base_takes: DataRegister::default(),
            s0_right_side: DataRegister::default(),
            s0_right_edge: DataRegister::default(),
            s0_right_ac: DataRegister::default(),
            s0_right_minus: DataRegister::default(),
            s0_climbs: DataRegister::default(),
            s0_side_minus: DataRegister::default(),
            s0_left_from: DataRegister::default(),
            s0_right_from: DataRegister::default(),
            s0_valid: Register::default(),
            s0_kind: DataRegister::default(),
            s0_left: DataRegister::default(),
            s0_right: DataRegister::default(),
            s0_keep: DataRegister::default(),
            s0_swap: DataRegister::default(),
            s0_last: DataRegister::default(),
            s1_load: DataRegister::default(),
            s1_bus_a: DataRegister::default(),
            s1_bus_b: DataRegister::default(),
            s1_bus_c: DataRegister::default(),
            s1_bus_ab: DataRegister::default(),
            s1_bus_ac: DataRegister::default(),
            s1_bus_bc: DataRegister::default(),
            s1_bus_origin: DataRegister::default(),
            s1_to_primary: DataRegister::default(),
            s1_to_edge: DataRegister::default(),
            s1_to_right: DataRegister::default(),
            s1_rung: DataRegister::default(),
            s1_primary_minus: DataRegister::default(),
            s1_primary_moves: DataRegister::default(),
            s1_edge_ac: DataRegister::default(),
            s1_edge_minus: DataRegister::default(),
            s1_edge_bc: DataRegister::default(),
            s1_left_moves: DataRegister::default(),
            s1_from_base: DataRegister::default(),
            s1_base_takes: DataRegister::default(),
            s1_right_side: DataRegister::default(),
            s1_right_across: DataRegister::default(),
            s1_right_ac: DataRegister::default(),
            s1_right_bc: DataRegister::default(),
            s1_right_minus: DataRegister::default(),
            s1_climbs: DataRegister::default(),
            s1_side_minus: DataRegister::default(),
            s1_left_from: DataRegister::default(),
            s1_right_from: DataRegister::default(),
            s1_valid: Register::default(),
            s1_kind: DataRegister::default(),
            s1_left: DataRegister::default(),
            s1_right: DataRegister::default(),
            s1_keep: DataRegister::default(),
            s1_swap: DataRegister::default(),
            s1_last: DataRegister::default(),
            s2_start: DataRegister::default(),
            s2_across: DataRegister::default(),
            s2_to_primary: DataRegister::default(),
            s2_to_edge: DataRegister::default(),
            s2_to_right: DataRegister::default(),
            s2_rung: DataRegister::default(),
            s2_primary_minus: DataRegister::default(),
            s2_primary_moves: DataRegister::default(),
            s2_edge_ac: DataRegister::default(),
            s2_edge_minus: DataRegister::default(),
            s2_edge_bc: DataRegister::default(),
            s2_left_moves: DataRegister::default(),
            s2_from_base: DataRegister::default(),
            s2_base_takes: DataRegister::default(),
            s2_right_side: DataRegister::default(),
            s2_right_across: DataRegister::default(),
            s2_right_ac: DataRegister::default(),
            s2_right_bc: DataRegister::default(),
            s2_right_minus: DataRegister::default(),
            s2_left_from: DataRegister::default(),
            s2_right_from: DataRegister::default(),
            s2_valid: Register::default(),
            s2_kind: DataRegister::default(),
            s2_left: DataRegister::default(),
            s2_right: DataRegister::default(),
            s2_keep: DataRegister::default(),
            s2_swap: DataRegister::default(),
            s2_last: DataRegister::default(),
            s3_primary_step: DataRegister::default(),
            s3_edge_step: DataRegister::default(),
            s3_left_step: DataRegister::default(),
            s3_right_step: DataRegister::default(),
            s3_primary_minus: DataRegister::default(),
            s3_edge_minus: DataRegister::default(),
            s3_right_minus: DataRegister::default(),
            s3_rung: DataRegister::default(),
            s3_to_primary: DataRegister::default(),
            s3_to_edge: DataRegister::default(),
            s3_to_right: DataRegister::default(),
            s3_from_base: DataRegister::default(),
            s3_base_takes: DataRegister::default(),
            s3_left_from_a: DataRegister::default(),
            s3_left_from_b: DataRegister::default(),
            s3_left_from_c: DataRegister::default(),
            s3_left_from_walker: DataRegister::default(),
            s3_left_from_edge: DataRegister::default(),
            s3_left_sent: DataRegister::default(),
            s3_right_from_a: DataRegister::default(),
            s3_right_from_b: DataRegister::default(),
            s3_right_from_c: DataRegister::default(),
            s3_right_from_walker: DataRegister::default(),
            s3_right_from_edge: DataRegister::default(),
            s3_right_from_primary: DataRegister::default(),
            s3_right_sent: DataRegister::default(),
            s3_valid: Register::default(),
            s3_kind: DataRegister::default(),
            s3_left: DataRegister::default(),
            s3_right: DataRegister::default(),
            s3_keep: DataRegister::default(),
            s3_swap: DataRegister::default(),
            s3_last: DataRegister::default(),
            primary_walker: DataRegister::default(),
            base_walker: DataRegister::default(),
            left_walker: DataRegister::default(),
            right_walker: DataRegister::default(),
            edge_walker: DataRegister::default(),
            edge_before: DataRegister::default(),
            s4_base_takes: DataRegister::default(),
            s4_left_from_a: DataRegister::default(),
            s4_left_from_b: DataRegister::default(),
            s4_left_from_c: DataRegister::default(),
            s4_left_from_walker: DataRegister::default(),
            s4_left_from_edge: DataRegister::default(),
            s4_left_sent: DataRegister::default(),
            s4_right_from_a: DataRegister::default(),
            s4_right_from_b: DataRegister::default(),
            s4_right_from_c: DataRegister::default(),
            s4_right_from_walker: DataRegister::default(),
            s4_right_from_edge: DataRegister::default(),
            s4_right_from_primary: DataRegister::default(),
            s4_right_sent: DataRegister::default(),
            sent_left_vertex: DataRegister::default(),
            sent_right_vertex: DataRegister::default(),
            beat: Wire::default(),
            rung: Wire::default(),
            start: Wire::default(),
            on_a: Wire::default(),
            on_b: Wire::default(),
            on_c: Wire::default(),
            on_ab: Wire::default(),
            on_ac: Wire::default(),
            on_bc: Wire::default(),
            on_origin: Wire::default(),
            left_on_a: Wire::default(),
            left_on_b: Wire::default(),
            left_on_c: Wire::default(),
            left_on_walker: Wire::default(),
            left_on_edge: Wire::default(),
            right_on_a: Wire::default(),
            right_on_b: Wire::default(),
            right_on_c: Wire::default(),
            right_on_walker: Wire::default(),
            right_on_edge: Wire::default(),
            right_on_primary: Wire::default(),
            side_step: Wire::default(),
            side_carry: Wire::default(),
            primary_from: Wire::default(),
            primary_carry: Wire::default(),
            edge_from: Wire::default(),
            edge_carry: Wire::default(),
            left_from: Wire::default(),
            right_from: Wire::default(),
            right_free: Wire::default(),
            on_to_primary: Wire::default(),
            on_primary_moves: Wire::default(),
            on_primary_minus: Wire::default(),
            on_to_edge: Wire::default(),
            on_edge_ac: Wire::default(),
            on_edge_bc: Wire::default(),
            on_edge_minus: Wire::default(),
            on_left_moves: Wire::default(),
            on_to_right: Wire::default(),
            on_right_side: Wire::default(),
            on_right_across: Wire::default(),
            on_right_ac: Wire::default(),
            on_right_bc: Wire::default(),
            on_right_minus: Wire::default(),
            right_carry: Wire::default(),
            guard: Constant::new(U::new((W - V - 1) as i64)),
            half: Constant::new(Lanes::new([if W == V + 1 { 0 } else { 1 << (W - V - 2) }; L])),
            one: Constant::new(Lanes::new([1; L])),
            zero: Constant::new(Lanes::new([0; L])),
            none: Constant::new(Lanes::new([0; L])),
            all: Constant::new(Lanes::new([-1; L])),
            no_bit: Constant::new(Lanes::new([0; L])),
            every_bit: Constant::new(Lanes::new([-1; L])),
        }
    }
}

impl<const L: usize, const V: usize, const W: usize, const X: usize> Logic for Walkers<L, V, W, X> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s2_primary_moves);
        dff_setup!(self, clock, s2_right_bc);
        dff_setup!(self, clock, s1_primary_moves);
        dff_setup!(self, clock, s1_right_bc);
        dff_setup!(
            self,
            clock,
            s4_left_from_a,
            s4_left_from_b,
            s4_left_from_c,
            s4_left_from_walker,
            s4_left_from_edge,
            s4_left_sent,
            s4_right_from_a,
            s4_right_from_b
        );
        dff_setup!(
            self,
            clock,
            s4_right_from_c,
            s4_right_from_walker,
            s4_right_from_edge,
            s4_right_from_primary,
            s4_right_sent
        );
        dff_setup!(
            self,
            clock,
            s3_left_from_a,
            s3_left_from_b,
            s3_left_from_c,
            s3_left_from_walker,
            s3_left_from_edge,
            s3_left_sent,
            s3_right_from_a,
            s3_right_from_b
        );
        dff_setup!(
            self,
            clock,
            s3_right_from_c,
            s3_right_from_walker,
            s3_right_from_edge,
            s3_right_from_primary,
            s3_right_sent
        );
        dff_setup!(self, clock, s1_bus_a, s1_bus_b, s1_bus_c, s1_bus_ab, s1_bus_ac, s1_bus_bc, s1_bus_origin);
        dff_setup!(
            self,
            clock,
            s0_load,
            s0_bus,
            s0_to_primary,
            s0_to_edge,
            s0_to_right,
            s0_rung,
            s0_primary_minus,
            s0_edge_moves
        );
        dff_setup!(
            self,
            clock,
            s0_edge_minus,
            s0_edge_bc,
            s0_left_moves,
            s0_from_base,
            s0_base_takes,
            s0_right_side,
            s0_right_edge,
            s0_right_ac
        );
        dff_setup!(
            self,
            clock,
            s0_right_minus,
            s0_climbs,
            s0_side_minus,
            s0_left_from,
            s0_right_from,
            s0_valid,
            s0_kind,
            s0_left
        );
        dff_setup!(self, clock, s0_right, s0_keep, s0_swap, s0_last);
        dff_setup!(self, clock, va, vb, vc, d_ab, d_ac, d_bc, from_ab, from_ac);
        dff_setup!(self, clock, from_bc, d_side, d_sweep, origin_b, hi_ab, hi_ac, hi_bc, s1_load);
        dff_setup!(
            self,
            clock,
            s1_to_primary,
            s1_to_edge,
            s1_to_right,
            s1_rung,
            s1_primary_minus,
            s1_edge_ac,
            s1_edge_minus
        );
        dff_setup!(
            self,
            clock,
            s1_edge_bc,
            s1_left_moves,
            s1_from_base,
            s1_base_takes,
            s1_right_side,
            s1_right_across,
            s1_right_ac,
            s1_right_minus
        );
        dff_setup!(self, clock, s1_climbs, s1_side_minus, s1_left_from, s1_right_from, s1_valid, s1_kind, s1_left);
        dff_setup!(self, clock, s1_right, s1_keep, s1_swap, s1_last, s2_start, s2_across, s2_to_primary, s2_to_edge);
        dff_setup!(
            self,
            clock,
            s2_to_right,
            s2_rung,
            s2_primary_minus,
            s2_edge_ac,
            s2_edge_minus,
            s2_edge_bc,
            s2_left_moves,
            s2_from_base
        );
        dff_setup!(
            self,
            clock,
            s2_base_takes,
            s2_right_side,
            s2_right_across,
            s2_right_ac,
            s2_right_minus,
            s2_left_from,
            s2_right_from
        );
        dff_setup!(self, clock, s2_valid, s2_kind, s2_left, s2_right, s2_keep, s2_swap, s2_last, s3_primary_step);
        dff_setup!(
            self,
            clock,
            s3_edge_step,
            s3_left_step,
            s3_right_step,
            s3_primary_minus,
            s3_edge_minus,
            s3_right_minus,
            s3_rung,
            s3_to_primary
        );
        dff_setup!(self, clock, s3_to_edge, s3_to_right, s3_from_base, s3_base_takes, s3_valid, s3_kind);
        dff_setup!(self, clock, s3_left, s3_right, s3_keep, s3_swap, s3_last, primary_walker, base_walker, left_walker);
        dff_setup!(self, clock, right_walker, edge_walker, edge_before, s4_base_takes);
        dff_setup!(self, clock, sent_left_vertex, sent_right_vertex);
        self.out_valid.next = self.s3_valid.q.val();
        self.out_kind.next = self.s3_kind.q.val();
        self.out_left.next = self.s3_left.q.val();
        self.out_right.next = self.s3_right.q.val();
        self.out_keep.next = self.s3_keep.q.val();
        self.out_swap.next = self.s3_swap.q.val();
        self.out_last.next = self.s3_last.q.val();
        self.out_left_vertex.next = self.sent_left_vertex.q.val();
        self.out_right_vertex.next = self.sent_right_vertex.q.val();
        self.record_ready.next = self.s0_load.q.val();

        // The record. Directions are needed a stage earlier than the rest.
        self.hi_ab.enable.next = self.op_valid.val() && self.op_code.val() == 4;
        self.hi_ab.d.next = self.a_hi_ab.val();
        self.hi_ac.enable.next = self.op_valid.val() && self.op_code.val() == 4;
        self.hi_ac.d.next = self.a_hi_ac.val();
        self.hi_bc.enable.next = self.op_valid.val() && self.op_code.val() == 4;
        self.hi_bc.d.next = self.b_hi_bc.val();
        self.va.enable.next = self.s1_load.q.val();
        self.va.d.next = self.corner_a.val();
        self.vb.enable.next = self.s1_load.q.val();
        self.vb.d.next = self.corner_b.val();
        self.vc.enable.next = self.s1_load.q.val();
        self.vc.d.next = self.corner_c.val();
        self.d_ab.enable.next = self.s1_load.q.val();
        self.d_ab.d.next = self.step_ab.val();
        self.d_ac.enable.next = self.s1_load.q.val();
        self.d_ac.d.next = self.step_ac.val();
        self.d_bc.enable.next = self.s1_load.q.val();
        self.d_bc.d.next = self.step_bc.val();
        self.from_ab.enable.next = self.s1_load.q.val();
        self.from_ab.d.next = self.start_ab.val();
        self.from_ac.enable.next = self.s1_load.q.val();
        self.from_ac.d.next = self.start_ac.val();
        self.from_bc.enable.next = self.s1_load.q.val();
        self.from_bc.d.next = self.start_bc.val();
        self.d_side.enable.next = self.s1_load.q.val();
        self.d_side.d.next = self.side.val();
        self.d_sweep.enable.next = self.s1_load.q.val();
        self.d_sweep.d.next = self.sweep.val();
        self.origin_b.enable.next = self.s1_load.q.val();
        self.origin_b.d.next = self.base_b.val();

        // s0: what the micro-operation asks of each walker.
        self.beat.next = self.op_valid.val() && self.op_code.val() < 4;
        self.rung.next = self.beat.val() && (self.op_code.val() == 1 || self.op_code.val() == 2);
        self.s0_load.d.next = self.op_valid.val() && self.op_code.val() == 4;
        self.s0_rung.d.next = self.rung.val();
        self.s0_primary_minus.d.next = self.hi_ab.q.val() != self.op_second.val();
        self.s0_climbs.d.next = self.op_climbs.val();
        self.s0_side_minus.d.next = self.op_falls.val();
        self.s0_to_primary.d.next = self.op_valid.val() && self.op_code.val() == 6;
        self.s0_to_edge.d.next =
            (self.op_valid.val() && self.op_code.val() == 7) || (self.beat.val() && self.op_turn.val());
        self.s0_to_right.d.next =
            (self.op_valid.val() && self.op_code.val() == 5) || (self.rung.val() && self.op_column_edge.val());
        self.s0_from_base.d.next = self.rung.val() && !self.op_column_edge.val();
        // The base walker follows the right one.
        self.s0_base_takes.d.next = (self.op_valid.val() && self.op_code.val() == 5) || self.rung.val();
        self.s0_edge_moves.d.next = self.beat.val() && self.op_advance.val() && !self.op_turn.val();
        self.s0_edge_bc.d.next = self.op_on_bc.val();
        self.s0_edge_minus.d.next = self.hi_ac.q.val();
        if self.op_on_bc.val() {
            // From C where the sub-triangle starts at A.
            self.s0_edge_minus.d.next = self.hi_bc.q.val() == self.op_second.val();
        }
        self.s0_left_moves.d.next = self.beat.val() && !self.rung.val() && self.op_left.val() == 1;
        self.s0_right_side.d.next = self.beat.val() && !self.rung.val() && self.op_right.val() == 1;
        self.s0_right_edge.d.next = self.beat.val() && !self.rung.val() && self.op_right.val() == 2;
        self.s0_right_ac.d.next = self.op_second.val();
        self.s0_right_minus.d.next = self.hi_bc.q.val();
        if self.op_second.val() {
            self.s0_right_minus.d.next = self.hi_ac.q.val();
        }
        if self.rung.val() {
            self.s0_right_minus.d.next = self.op_second.val();
        }
        // The bus: 0 A, 1 B, 2 C, 3 hi end of AB, 4 of AC, 5 of BC, 6 base vertex of B. A corner stands for a lo end.
        if self.op_code.val() == 5 {
            self.s0_bus.d.next = 0.into();
            if self.op_second.val() {
                self.s0_bus.d.next = 6.into();
            }
        } else if self.op_code.val() == 6 {
            if self.hi_ab.q.val() != self.op_second.val() {
                self.s0_bus.d.next = 3.into();
            } else {
                self.s0_bus.d.next = 0.into();
                if self.op_second.val() {
                    self.s0_bus.d.next = 1.into();
                }
            }
        } else if self.op_code.val() == 7 {
            if self.op_second.val() {
                self.s0_bus.d.next = 1.into();
                if self.hi_bc.q.val() {
                    self.s0_bus.d.next = 5.into();
                }
            } else {
                self.s0_bus.d.next = 0.into();
                if self.hi_ac.q.val() {
                    self.s0_bus.d.next = 4.into();
                }
            }
        } else if self.op_turn.val() {
            self.s0_bus.d.next = 2.into();
            if !self.hi_bc.q.val() {
                self.s0_bus.d.next = 5.into();
            }
        } else if self.op_second.val() {
            self.s0_bus.d.next = 0.into();
            if self.hi_ac.q.val() {
                self.s0_bus.d.next = 4.into();
            }
        } else {
            self.s0_bus.d.next = 1.into();
            if self.hi_bc.q.val() {
                self.s0_bus.d.next = 5.into();
            }
        }
        // Sources of the vertices sent: 0 A, 1 B, 2 C, 3 column walker, 4 edge walker, 5 primary walker; 6 stays: what a
        // walker holds that nobody asked for may never have been set.
        if !self.beat.val() {
            self.s0_left_from.d.next = 6.into();
            self.s0_right_from.d.next = 6.into();
        } else if self.rung.val() {
            self.s0_left_from.d.next = 0.into();
            self.s0_right_from.d.next = 5.into();
            if self.op_second.val() {
                self.s0_left_from.d.next = 1.into();
                if self.op_at_end.val() {
                    self.s0_right_from.d.next = 0.into();
                }
            } else if self.op_at_end.val() {
                self.s0_right_from.d.next = 1.into();
            }
        } else {
            if self.op_left.val() == 0 {
                self.s0_left_from.d.next = 6.into();
            } else if self.op_left.val() == 1 {
                self.s0_left_from.d.next = 3.into();
            } else if self.op_edge.val() == 0 {
                self.s0_left_from.d.next = 4.into();
            } else if self.op_edge.val() == 1 {
                self.s0_left_from.d.next = 2.into();
            } else {
                self.s0_left_from.d.next = 1.into();
            }
            if self.op_right.val() == 0 {
                self.s0_right_from.d.next = 6.into();
            } else if self.op_right.val() != 3 {
                self.s0_right_from.d.next = 3.into();
            } else if self.op_right_edge.val() == 0 {
                self.s0_right_from.d.next = 4.into();
            } else if self.op_right_edge.val() == 1 {
                self.s0_right_from.d.next = 2.into();
            } else {
                self.s0_right_from.d.next = 1.into();
            }
        }
        self.s0_valid.d.next = self.beat.val();
        self.s0_kind.d.next = bit_cast_to::<U<2>>(self.op_code.val());
        self.s0_left.d.next = self.op_left.val();
        self.s0_right.d.next = self.op_right.val();
        self.s0_keep.d.next = self.op_keep.val();
        self.s0_swap.d.next = self.op_swap.val();
        self.s0_last.d.next = self.op_last.val();

        // s1: the same, on the way to the lanes.
        self.s1_load.d.next = self.s0_load.q.val();
        self.s1_to_primary.d.next = self.s0_to_primary.q.val();
        self.s1_to_edge.d.next = self.s0_to_edge.q.val();
        self.s1_to_right.d.next = self.s0_to_right.q.val();
        self.s1_rung.d.next = self.s0_rung.q.val();
        self.s1_primary_minus.d.next =
            self.s0_rung.q.val() && !self.s0_to_primary.q.val() && self.s0_primary_minus.q.val();
        self.s1_primary_moves.d.next = self.s0_rung.q.val() && !self.s0_to_primary.q.val();
        self.s1_edge_ac.d.next = self.s0_edge_moves.q.val() && !self.s0_to_edge.q.val() && !self.s0_edge_bc.q.val();
        self.s1_edge_minus.d.next =
            self.s0_edge_moves.q.val() && !self.s0_to_edge.q.val() && self.s0_edge_minus.q.val();
        self.s1_edge_bc.d.next = self.s0_edge_moves.q.val() && !self.s0_to_edge.q.val() && self.s0_edge_bc.q.val();
        self.s1_left_moves.d.next = self.s0_left_moves.q.val();
        self.s1_from_base.d.next = self.s0_from_base.q.val();
        self.s1_base_takes.d.next = self.s0_base_takes.q.val();
        self.s1_right_side.d.next = self.s0_right_side.q.val() && !self.s0_to_right.q.val();
        self.right_free.next = !self.s0_to_right.q.val() && !self.s0_right_side.q.val();
        self.s1_right_across.d.next = self.right_free.val() && self.s0_from_base.q.val();
        self.s1_right_ac.d.next = self.right_free.val()
            && !self.s0_from_base.q.val()
            && self.s0_right_edge.q.val()
            && self.s0_right_ac.q.val();
        self.s1_right_bc.d.next = self.right_free.val()
            && !self.s0_from_base.q.val()
            && self.s0_right_edge.q.val()
            && !self.s0_right_ac.q.val();
        self.s1_right_minus.d.next = self.right_free.val()
            && (self.s0_from_base.q.val() || self.s0_right_edge.q.val())
            && self.s0_right_minus.q.val();
        self.s1_climbs.d.next = self.s0_climbs.q.val();
        self.s1_side_minus.d.next = self.s0_side_minus.q.val();
        self.s1_left_from.d.next = self.s0_left_from.q.val();
        self.s1_right_from.d.next = self.s0_right_from.q.val();
        self.s1_valid.d.next = self.s0_valid.q.val();
        self.s1_kind.d.next = self.s0_kind.q.val();
        self.s1_left.d.next = self.s0_left.q.val();
        self.s1_right.d.next = self.s0_right.q.val();
        self.s1_keep.d.next = self.s0_keep.q.val();
        self.s1_swap.d.next = self.s0_swap.q.val();
        self.s1_last.d.next = self.s0_last.q.val();
        self.s1_bus_a.d.next = self.s0_bus.q.val() == 0;
        self.s1_bus_b.d.next = self.s0_bus.q.val() == 1;
        self.s1_bus_c.d.next = self.s0_bus.q.val() == 2;
        self.s1_bus_ab.d.next = self.s0_bus.q.val() == 3;
        self.s1_bus_ac.d.next = self.s0_bus.q.val() == 4;
        self.s1_bus_bc.d.next = self.s0_bus.q.val() == 5;
        self.s1_bus_origin.d.next = self.s0_bus.q.val() == 6;

        // s2: the bus, and the base walker's step.
        self.on_a.next = self.none.val();
        if self.s1_bus_a.q.val() {
            self.on_a.next = self.all.val();
        }
        self.on_b.next = self.none.val();
        if self.s1_bus_b.q.val() {
            self.on_b.next = self.all.val();
        }
        self.on_c.next = self.none.val();
        if self.s1_bus_c.q.val() {
            self.on_c.next = self.all.val();
        }
        self.on_ab.next = self.none.val();
        if self.s1_bus_ab.q.val() {
            self.on_ab.next = self.all.val();
        }
        self.on_ac.next = self.none.val();
        if self.s1_bus_ac.q.val() {
            self.on_ac.next = self.all.val();
        }
        self.on_bc.next = self.none.val();
        if self.s1_bus_bc.q.val() {
            self.on_bc.next = self.all.val();
        }
        self.on_origin.next = self.none.val();
        if self.s1_bus_origin.q.val() {
            self.on_origin.next = self.all.val();
        }
        self.start.next = (self.on_a.val()
            & ((bit_cast_to::<Lanes<L, W>>(self.va.q.val()) << self.guard.val()) | self.half.val()))
            | (self.on_b.val() & ((bit_cast_to::<Lanes<L, W>>(self.vb.q.val()) << self.guard.val()) | self.half.val()))
            | (self.on_c.val() & ((bit_cast_to::<Lanes<L, W>>(self.vc.q.val()) << self.guard.val()) | self.half.val()))
            | (self.on_ab.val() & self.from_ab.q.val())
            | (self.on_ac.val() & self.from_ac.q.val())
            | (self.on_bc.val() & self.from_bc.q.val())
            | (self.on_origin.val() & self.origin_b.q.val());
        self.s2_start.d.next = self.start.val();
        // a - b is a + !b + 1: the one comes in as the carry out of a bit below.
        self.side_step.next = self.none.val();
        self.side_carry.next = self.zero.val();
        if self.s1_climbs.q.val() {
            self.side_step.next = self.d_side.q.val();
            if self.s1_side_minus.q.val() {
                self.side_step.next = !self.d_side.q.val();
                self.side_carry.next = self.one.val();
            }
        }
        self.s2_across.d.next = bit_cast_to::<Lanes<L, W>>(
            (((bit_cast_to::<Lanes<L, X>>(self.d_sweep.q.val()) << 1) | self.one.val())
                + ((bit_cast_to::<Lanes<L, X>>(self.side_step.val()) << 1) | self.side_carry.val()))
                >> 1,
        );
        self.s2_to_primary.d.next = self.s1_to_primary.q.val();
        self.s2_to_edge.d.next = self.s1_to_edge.q.val();
        self.s2_to_right.d.next = self.s1_to_right.q.val();
        self.s2_rung.d.next = self.s1_rung.q.val();
        self.s2_primary_minus.d.next = self.s1_primary_minus.q.val();
        self.s2_edge_ac.d.next = self.s1_edge_ac.q.val();
        self.s2_edge_minus.d.next = self.s1_edge_minus.q.val();
        self.s2_edge_bc.d.next = self.s1_edge_bc.q.val();
        self.s2_left_moves.d.next = self.s1_left_moves.q.val();
        self.s2_from_base.d.next = self.s1_from_base.q.val();
        self.s2_base_takes.d.next = self.s1_base_takes.q.val();
        self.s2_right_side.d.next = self.s1_right_side.q.val();
        self.s2_right_across.d.next = self.s1_right_across.q.val();
        self.s2_right_ac.d.next = self.s1_right_ac.q.val();
        self.s2_right_bc.d.next = self.s1_right_bc.q.val();
        self.s2_primary_moves.d.next = self.s1_primary_moves.q.val();
        self.s2_right_minus.d.next = self.s1_right_minus.q.val();
        self.s2_left_from.d.next = self.s1_left_from.q.val();
        self.s2_right_from.d.next = self.s1_right_from.q.val();
        self.s2_valid.d.next = self.s1_valid.q.val();
        self.s2_kind.d.next = self.s1_kind.q.val();
        self.s2_left.d.next = self.s1_left.q.val();
        self.s2_right.d.next = self.s1_right.q.val();
        self.s2_keep.d.next = self.s1_keep.q.val();
        self.s2_swap.d.next = self.s1_swap.q.val();
        self.s2_last.d.next = self.s1_last.q.val();

        // s3: what each walker adds: one of these, or its complement.
        self.on_to_primary.next = self.none.val();
        if self.s2_to_primary.q.val() {
            self.on_to_primary.next = self.all.val();
        }
        self.on_primary_moves.next = self.none.val();
        if self.s2_primary_moves.q.val() {
            self.on_primary_moves.next = self.all.val();
        }
        self.on_primary_minus.next = self.none.val();
        if self.s2_primary_minus.q.val() {
            self.on_primary_minus.next = self.all.val();
        }
        self.on_to_edge.next = self.none.val();
        if self.s2_to_edge.q.val() {
            self.on_to_edge.next = self.all.val();
        }
        self.on_edge_ac.next = self.none.val();
        if self.s2_edge_ac.q.val() {
            self.on_edge_ac.next = self.all.val();
        }
        self.on_edge_bc.next = self.none.val();
        if self.s2_edge_bc.q.val() {
            self.on_edge_bc.next = self.all.val();
        }
        self.on_edge_minus.next = self.none.val();
        if self.s2_edge_minus.q.val() {
            self.on_edge_minus.next = self.all.val();
        }
        self.on_left_moves.next = self.none.val();
        if self.s2_left_moves.q.val() {
            self.on_left_moves.next = self.all.val();
        }
        self.on_to_right.next = self.none.val();
        if self.s2_to_right.q.val() {
            self.on_to_right.next = self.all.val();
        }
        self.on_right_side.next = self.none.val();
        if self.s2_right_side.q.val() {
            self.on_right_side.next = self.all.val();
        }
        self.on_right_across.next = self.none.val();
        if self.s2_right_across.q.val() {
            self.on_right_across.next = self.all.val();
        }
        self.on_right_ac.next = self.none.val();
        if self.s2_right_ac.q.val() {
            self.on_right_ac.next = self.all.val();
        }
        self.on_right_bc.next = self.none.val();
        if self.s2_right_bc.q.val() {
            self.on_right_bc.next = self.all.val();
        }
        self.on_right_minus.next = self.none.val();
        if self.s2_right_minus.q.val() {
            self.on_right_minus.next = self.all.val();
        }
        self.s3_primary_step.d.next = (self.on_to_primary.val() & self.s2_start.q.val())
            | (self.on_primary_moves.val() & (self.d_ab.q.val() ^ self.on_primary_minus.val()));
        self.s3_primary_minus.d.next = self.s2_primary_minus.q.val();
        self.s3_edge_step.d.next = ((self.on_to_edge.val() & self.s2_start.q.val())
            | (self.on_edge_ac.val() & self.d_ac.q.val())
            | (self.on_edge_bc.val() & self.d_bc.q.val()))
            ^ self.on_edge_minus.val();
        self.s3_edge_minus.d.next = self.s2_edge_minus.q.val();
        self.s3_left_step.d.next = self.on_left_moves.val() & self.d_side.q.val();
        self.s3_right_step.d.next = ((self.on_to_right.val() & self.s2_start.q.val())
            | (self.on_right_side.val() & self.d_side.q.val()))
            | (((self.on_right_across.val() & self.s2_across.q.val())
                | (self.on_right_ac.val() & self.d_ac.q.val())
                | (self.on_right_bc.val() & self.d_bc.q.val()))
                ^ self.on_right_minus.val());
        self.s3_right_minus.d.next = self.s2_right_minus.q.val();
        self.s3_rung.d.next = self.s2_rung.q.val();
        self.s3_to_primary.d.next = self.s2_to_primary.q.val();
        self.s3_to_edge.d.next = self.s2_to_edge.q.val();
        self.s3_to_right.d.next = self.s2_to_right.q.val();
        self.s3_from_base.d.next = self.s2_from_base.q.val();
        self.s3_base_takes.d.next = self.s2_base_takes.q.val();
        self.s3_left_from_a.d.next = self.s2_left_from.q.val() == 0;
        self.s3_left_from_b.d.next = self.s2_left_from.q.val() == 1;
        self.s3_left_from_c.d.next = self.s2_left_from.q.val() == 2;
        self.s3_left_from_walker.d.next = self.s2_left_from.q.val() == 3;
        self.s3_left_from_edge.d.next = self.s2_left_from.q.val() == 4;
        self.s3_left_sent.d.next = self.s2_left_from.q.val() != 6;
        self.s3_right_from_a.d.next = self.s2_right_from.q.val() == 0;
        self.s3_right_from_b.d.next = self.s2_right_from.q.val() == 1;
        self.s3_right_from_c.d.next = self.s2_right_from.q.val() == 2;
        self.s3_right_from_walker.d.next = self.s2_right_from.q.val() == 3;
        self.s3_right_from_edge.d.next = self.s2_right_from.q.val() == 4;
        self.s3_right_from_primary.d.next = self.s2_right_from.q.val() == 5;
        self.s3_right_sent.d.next = self.s2_right_from.q.val() != 6;
        self.s3_valid.d.next = self.s2_valid.q.val();
        self.s3_kind.d.next = self.s2_kind.q.val();
        self.s3_left.d.next = self.s2_left.q.val();
        self.s3_right.d.next = self.s2_right.q.val();
        self.s3_keep.d.next = self.s2_keep.q.val();
        self.s3_swap.d.next = self.s2_swap.q.val();
        self.s3_last.d.next = self.s2_last.q.val();

        // s4: the walkers.
        self.primary_carry.next = self.zero.val();
        if self.s3_primary_minus.q.val() {
            self.primary_carry.next = self.one.val();
        }
        self.primary_from.next = self.primary_walker.q.val();
        if self.s3_to_primary.q.val() {
            self.primary_from.next = self.none.val();
        }
        self.primary_walker.d.next = bit_cast_to::<Lanes<L, W>>(
            (((bit_cast_to::<Lanes<L, X>>(self.primary_from.val()) << 1) | self.one.val())
                + ((bit_cast_to::<Lanes<L, X>>(self.s3_primary_step.q.val()) << 1) | self.primary_carry.val()))
                >> 1,
        );
        self.edge_carry.next = self.zero.val();
        if self.s3_edge_minus.q.val() {
            self.edge_carry.next = self.one.val();
        }
        self.edge_from.next = self.edge_walker.q.val();
        if self.s3_to_edge.q.val() {
            self.edge_from.next = self.none.val();
        }
        self.edge_walker.d.next = bit_cast_to::<Lanes<L, W>>(
            (((bit_cast_to::<Lanes<L, X>>(self.edge_from.val()) << 1) | self.one.val())
                + ((bit_cast_to::<Lanes<L, X>>(self.s3_edge_step.q.val()) << 1) | self.edge_carry.val()))
                >> 1,
        );
        self.edge_before.d.next = bit_cast_to::<Lanes<L, V>>(self.edge_walker.q.val() >> self.guard.val());
        self.left_from.next = self.left_walker.q.val();
        if self.s3_rung.q.val() {
            self.left_from.next = self.base_walker.q.val();
        }
        self.left_walker.d.next = self.left_from.val() + self.s3_left_step.q.val();
        self.right_carry.next = self.zero.val();
        if self.s3_right_minus.q.val() {
            self.right_carry.next = self.one.val();
        }
        self.right_from.next = self.right_walker.q.val();
        if self.s3_to_right.q.val() {
            self.right_from.next = self.none.val();
        } else if self.s3_from_base.q.val() {
            self.right_from.next = self.base_walker.q.val();
        }
        self.right_walker.d.next = bit_cast_to::<Lanes<L, W>>(
            (((bit_cast_to::<Lanes<L, X>>(self.right_from.val()) << 1) | self.one.val())
                + ((bit_cast_to::<Lanes<L, X>>(self.s3_right_step.q.val()) << 1) | self.right_carry.val()))
                >> 1,
        );
        // The base walker takes the right one's first vertex, a cycle behind it.
        self.base_walker.enable.next = self.s4_base_takes.q.val();
        self.base_walker.d.next = self.right_walker.q.val();
        self.s4_base_takes.d.next = self.s3_base_takes.q.val();
        self.s4_left_from_a.d.next = self.s3_left_from_a.q.val();
        self.s4_left_from_b.d.next = self.s3_left_from_b.q.val();
        self.s4_left_from_c.d.next = self.s3_left_from_c.q.val();
        self.s4_left_from_walker.d.next = self.s3_left_from_walker.q.val();
        self.s4_left_from_edge.d.next = self.s3_left_from_edge.q.val();
        self.s4_left_sent.d.next = self.s3_left_sent.q.val();
        self.s4_right_from_a.d.next = self.s3_right_from_a.q.val();
        self.s4_right_from_b.d.next = self.s3_right_from_b.q.val();
        self.s4_right_from_c.d.next = self.s3_right_from_c.q.val();
        self.s4_right_from_walker.d.next = self.s3_right_from_walker.q.val();
        self.s4_right_from_edge.d.next = self.s3_right_from_edge.q.val();
        self.s4_right_from_primary.d.next = self.s3_right_from_primary.q.val();
        self.s4_right_sent.d.next = self.s3_right_sent.q.val();

        // The vertices sent.
        self.left_on_a.next = self.no_bit.val();
        if self.s4_left_from_a.q.val() {
            self.left_on_a.next = self.every_bit.val();
        }
        self.left_on_b.next = self.no_bit.val();
        if self.s4_left_from_b.q.val() {
            self.left_on_b.next = self.every_bit.val();
        }
        self.left_on_c.next = self.no_bit.val();
        if self.s4_left_from_c.q.val() {
            self.left_on_c.next = self.every_bit.val();
        }
        self.left_on_walker.next = self.no_bit.val();
        if self.s4_left_from_walker.q.val() {
            self.left_on_walker.next = self.every_bit.val();
        }
        self.left_on_edge.next = self.no_bit.val();
        if self.s4_left_from_edge.q.val() {
            self.left_on_edge.next = self.every_bit.val();
        }
        self.right_on_a.next = self.no_bit.val();
        if self.s4_right_from_a.q.val() {
            self.right_on_a.next = self.every_bit.val();
        }
        self.right_on_b.next = self.no_bit.val();
        if self.s4_right_from_b.q.val() {
            self.right_on_b.next = self.every_bit.val();
        }
        self.right_on_c.next = self.no_bit.val();
        if self.s4_right_from_c.q.val() {
            self.right_on_c.next = self.every_bit.val();
        }
        self.right_on_walker.next = self.no_bit.val();
        if self.s4_right_from_walker.q.val() {
            self.right_on_walker.next = self.every_bit.val();
        }
        self.right_on_edge.next = self.no_bit.val();
        if self.s4_right_from_edge.q.val() {
            self.right_on_edge.next = self.every_bit.val();
        }
        self.right_on_primary.next = self.no_bit.val();
        if self.s4_right_from_primary.q.val() {
            self.right_on_primary.next = self.every_bit.val();
        }
        self.sent_left_vertex.enable.next = self.s4_left_sent.q.val();
        self.sent_left_vertex.d.next = (self.left_on_a.val() & self.va.q.val())
            | (self.left_on_b.val() & self.vb.q.val())
            | (self.left_on_c.val() & self.vc.q.val())
            | (self.left_on_walker.val() & bit_cast_to::<Lanes<L, V>>(self.left_walker.q.val() >> self.guard.val()))
            | (self.left_on_edge.val() & self.edge_before.q.val());
        self.sent_right_vertex.enable.next = self.s4_right_sent.q.val();
        self.sent_right_vertex.d.next = (self.right_on_a.val() & self.va.q.val())
            | (self.right_on_b.val() & self.vb.q.val())
            | (self.right_on_c.val() & self.vc.q.val())
            | (self.right_on_walker.val() & bit_cast_to::<Lanes<L, V>>(self.right_walker.q.val() >> self.guard.val()))
            | (self.right_on_edge.val() & bit_cast_to::<Lanes<L, V>>(self.edge_walker.q.val() >> self.guard.val()))
            | (self.right_on_primary.val()
                & bit_cast_to::<Lanes<L, V>>(self.primary_walker.q.val() >> self.guard.val()));
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("walkers")
    }
}

watched! { [const L: usize, const V: usize, const W: usize, const X: usize] Walkers<L, V, W, X>: corner_a, corner_b, corner_c, step_ab, step_ac, step_bc, start_ab, start_ac, start_bc, a_hi_ab, a_hi_ac, b_hi_bc, side, sweep, base_b, op_valid, op_code, op_left, op_right, op_second, op_on_bc, op_at_end, op_climbs, op_falls, op_column_edge, op_edge, op_right_edge, op_advance, op_turn, op_keep, op_swap, op_last;; va, vb, vc, d_ab, d_ac, d_bc, from_ab, from_ac, from_bc, d_side, d_sweep, origin_b, hi_ab, hi_ac, hi_bc, s1_load, s1_to_primary, s1_to_edge, s1_to_right, s1_rung, s1_primary_minus, s1_edge_ac, s1_edge_minus, s1_edge_bc, s1_left_moves, s1_from_base, s1_base_takes, s1_right_side, s1_right_across, s1_right_ac, s1_right_minus, s1_climbs, s1_side_minus, s1_left_from, s1_right_from, s1_valid, s1_kind, s1_left, s1_right, s1_keep, s1_swap, s1_last, s2_start, s2_across, s2_to_primary, s2_to_edge, s2_to_right, s2_rung, s2_primary_minus, s2_edge_ac, s2_edge_minus, s2_edge_bc, s2_left_moves, s2_from_base, s2_base_takes, s2_right_side, s2_right_across, s2_right_ac, s2_right_minus, s2_left_from, s2_right_from, s2_valid, s2_kind, s2_left, s2_right, s2_keep, s2_swap, s2_last, s3_primary_step, s3_edge_step, s3_left_step, s3_right_step, s3_primary_minus, s3_edge_minus, s3_right_minus, s3_rung, s3_to_primary, s3_to_edge, s3_to_right, s3_from_base, s3_base_takes, s3_valid, s3_kind, s3_left, s3_right, s3_keep, s3_swap, s3_last, primary_walker, base_walker, left_walker, right_walker, edge_walker, edge_before, s4_base_takes, sent_left_vertex, sent_right_vertex, s0_load, s0_bus, s0_to_primary, s0_to_edge, s0_to_right, s0_rung, s0_primary_minus, s0_edge_moves, s0_edge_minus, s0_edge_bc, s0_left_moves, s0_from_base, s0_base_takes, s0_right_side, s0_right_edge, s0_right_ac, s0_right_minus, s0_climbs, s0_side_minus, s0_left_from, s0_right_from, s0_valid, s0_kind, s0_left, s0_right, s0_keep, s0_swap, s0_last, s1_bus_a, s1_bus_b, s1_bus_c, s1_bus_ab, s1_bus_ac, s1_bus_bc, s1_bus_origin, s3_left_from_a, s3_left_from_b, s3_left_from_c, s3_left_from_walker, s3_left_from_edge, s3_left_sent, s3_right_from_a, s3_right_from_b, s3_right_from_c, s3_right_from_walker, s3_right_from_edge, s3_right_from_primary, s3_right_sent, s4_left_from_a, s4_left_from_b, s4_left_from_c, s4_left_from_walker, s4_left_from_edge, s4_left_sent, s4_right_from_a, s4_right_from_b, s4_right_from_c, s4_right_from_walker, s4_right_from_edge, s4_right_from_primary, s4_right_sent, s1_right_bc, s1_primary_moves, s2_right_bc, s2_primary_moves }
