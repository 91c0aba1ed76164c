// SPDX-License-Identifier: MIT OR Apache-2.0
//! The whole datapath as one design: commands in, lit triangles out.
//!
//! ```text
//! in -+- constants -------------------------------------------> all
//!     +- records, triangles -> assembly -+-> remesher -+-> vertices -> strip_unit -> shading -> out
//!     +- map --------------------------- +-> skip -----+-> vertices
//!     '- reports -> counters -> out      '-> passer ---'
//! ```
//! (Gumhold & Huettner 1999, figure 3.)
//!
//! | port     | format | meaning |   Golden: models::displacement_pipeline::Machine   Error: that of its parts
//! | in_kind  | unsigned 3 | 0 constant, 1 record, 2 size of a level, 3 load of a sample, 4 triangle, 5 report |
//! | in_index, in_value | unsigned 7, signed 63 | constant (0 ..= 43 of the transform, 64 ..= 81 of [`Constants`]), its value; counter; place |
//! | in_data  | 9 x signed 48 | record; or level, width, height, base, pitch, two repeats; or level, i, j, sample; or places of three corners |
//! | out_*    | stream | three vertices in winding order and their colour; or, with out_report, a counter |
//! | error    | Bit    | sticky, of height fetch and strip unit |
//!
//! A beat that is not a triangle waits until the triangles before it have left. Constant 0 comes first after a reset, and
//! clears the counters. A triangle without displacement passes by the remesher.

mod assembly;
mod constants;
mod counters;
mod lane_queue;
mod narrow;
mod passer;
mod shading;
mod sift;
mod skip;
mod vertices;

pub use assembly::{Assembly, AssemblyState};
pub use constants::Constants;
pub use counters::{Counter, Counters, PairCounter};
pub use lane_queue::LaneQueue;
pub use narrow::{Narrow, NarrowLane};
pub use passer::Passer;
pub use shading::Shading;
pub use sift::{Beyond, Sift, Unpack};
pub use skip::{Extent, Skip};
pub use vertices::Vertices;

use crate::prelude::*;
use crate::remesher::Remesher;
use crate::strip_unit::StripUnit;

/// The pipeline, for nine lanes of `V` bits: `W` to `K` as in [`Remesher`], `M` and `B` as in
/// [`MipFetch`](crate::mip_fetch::MipFetch).
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct DisplacementPipeline<
    const V: usize,
    const W: usize,
    const X: usize,
    const N: usize,
    const T: usize,
    const A: usize,
    const P: usize,
    const K: usize,
    const M: usize,
    const B: usize,
> {
    pub clock: Input<ClockReset>,
    /// A beat stands at the input.
    pub in_valid: Input<Bit>,
    /// It is taken at this edge.
    pub in_ready: Output<Bit>,
    /// 0 constant, 1 record, 2 size, 3 load, 4 triangle, 5 report.
    pub in_kind: Input<U<3>>,
    /// Constant, or counter.
    pub in_index: Input<U<7>>,
    /// Of a constant; place of a record.
    pub in_value: Input<S<63>>,
    /// Record; size; load; places of the corners.
    pub in_data: Input<Lanes<9, 48>>,
    /// A beat stands at the output.
    pub out_valid: Output<Bit>,
    /// It is taken at this edge.
    pub out_ready: Input<Bit>,
    /// A counter, not a triangle.
    pub out_report: Output<Bit>,
    /// The counter; 0 with a triangle.
    pub out_value: Output<U<32>>,
    /// X' of the three vertices, SQ13.8 pixels from the middle.
    pub out_x: Output<Lanes<3, 22>>,
    /// Y' likewise.
    pub out_y: Output<Lanes<3, 22>>,
    /// c', UQ0.31.
    pub out_c: Output<Lanes<3, 32>>,
    /// Heights, UQ16.8.
    pub out_height: Output<Lanes<3, 25>>,
    /// Red lowest, 8 bits each.
    pub out_colour: Output<U<24>>,
    /// Sticky: of the height fetch or the strip unit, as of the beat at the output.
    pub error: Output<Bit>,
    constants: Gated<Constants>,
    assembly: Gated<Assembly<V, N>>,
    remesher: Gated<Remesher<9, V, W, X, N, T, A, P, K>>,
    passer: Passer<V>,
    skip: Gated<Skip<V, N>>,
    vertices: Gated<Vertices<V, M, B>>,
    strip_unit: Gated<StripUnit<3, 34, K>>,
    shading: Gated<Shading>,
    counters: Gated<Counters>,
    // What stands at the output.
    sent: Register<Bit>,
    sent_error: Register<Bit>,
    sent_report: DataRegister<Bit>,
    sent_value: DataRegister<U<32>>,
    sent_x: DataRegister<Lanes<3, 22>>,
    sent_y: DataRegister<Lanes<3, 22>>,
    sent_c: DataRegister<Lanes<3, 32>>,
    sent_height: DataRegister<Lanes<3, 25>>,
    sent_colour: DataRegister<U<24>>,
    /// Pieces between assembly and shading.
    pieces: Register<U<8>>,
    /// The counter is read, and is there.
    reads: Register<Bit>,
    reports: Register<Bit>,
    clears: Register<Bit>,
    /// Constant 0 has come; triangles before it are nothing.
    begun: Register<Bit>,
    report_index: Register<U<7>>,
    /// Everything had left a cycle before.
    rested: Register<Bit>,
    idle: Wire<Bit>,
    resting: Wire<Bit>,
    is_constant: Wire<Bit>,
    is_record: Wire<Bit>,
    is_map: Wire<Bit>,
    is_triangle: Wire<Bit>,
    is_report: Wire<Bit>,
    ours: Wire<Bit>,
    out_free: Wire<Bit>,
    piece_goes: Wire<Bit>,
    ends: Wire<Bit>,
    step_goes: Wire<Bit>,
    lane_0: Wire<S<48>>,
    lane_1: Wire<S<48>>,
    lane_2: Wire<S<48>>,
    lane_3: Wire<S<48>>,
    lane_4: Wire<S<48>>,
    lane_5: Wire<S<48>>,
    lane_6: Wire<S<48>>,
    lane_7: Wire<S<48>>,
    culled: Wire<U<3>>,
    no_limit: Constant<S<21>>,
    no_x: Constant<Lanes<3, 22>>,
    no_c: Constant<Lanes<3, 32>>,
    no_height: Constant<Lanes<3, 25>>,
}

impl<
    const V: usize,
    const W: usize,
    const X: usize,
    const N: usize,
    const T: usize,
    const A: usize,
    const P: usize,
    const K: usize,
    const M: usize,
    const B: usize,
> DisplacementPipeline<V, W, X, N, T, A, P, K, M, B>
{
    /// A pipeline whose column memory holds `depth` vertices.
    pub fn new(depth: usize) -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_index: Input::default(),
            in_value: Input::default(),
            in_data: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_report: Output::default(),
            out_value: Output::default(),
            out_x: Output::default(),
            out_y: Output::default(),
            out_c: Output::default(),
            out_height: Output::default(),
            out_colour: Output::default(),
            error: Output::default(),
            constants: Gated::default(),
            assembly: Gated::default(),
            remesher: Gated::new(Remesher::new(depth)),
            passer: Passer::default(),
            skip: Gated::default(),
            vertices: Gated::default(),
            strip_unit: Gated::new(StripUnit::new(depth)),
            shading: Gated::default(),
            counters: Gated::default(),
            sent: Register::default(),
            sent_error: Register::default(),
            sent_report: DataRegister::default(),
            sent_value: DataRegister::default(),
            sent_x: DataRegister::default(),
            sent_y: DataRegister::default(),
            sent_c: DataRegister::default(),
            sent_height: DataRegister::default(),
            sent_colour: DataRegister::default(),
            pieces: Register::default(),
            reads: Register::default(),
            reports: Register::default(),
            clears: Register::default(),
            begun: Register::default(),
            report_index: Register::default(),
            rested: Register::default(),
            idle: Wire::default(),
            resting: Wire::default(),
            is_constant: Wire::default(),
            is_record: Wire::default(),
            is_map: Wire::default(),
            is_triangle: Wire::default(),
            is_report: Wire::default(),
            ours: Wire::default(),
            out_free: Wire::default(),
            piece_goes: Wire::default(),
            ends: Wire::default(),
            step_goes: Wire::default(),
            lane_0: Wire::default(),
            lane_1: Wire::default(),
            lane_2: Wire::default(),
            lane_3: Wire::default(),
            lane_4: Wire::default(),
            lane_5: Wire::default(),
            lane_6: Wire::default(),
            lane_7: Wire::default(),
            culled: Wire::default(),
            no_limit: Constant::new(S::new((1 << 20) - 1)),
            no_x: Constant::new(Lanes::default()),
            no_c: Constant::new(Lanes::default()),
            no_height: Constant::new(Lanes::default()),
        }
    }
}

impl<
    const V: usize,
    const W: usize,
    const X: usize,
    const N: usize,
    const T: usize,
    const A: usize,
    const P: usize,
    const K: usize,
    const M: usize,
    const B: usize,
> Logic for DisplacementPipeline<V, W, X, N, T, A, P, K, M, B>
{
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, constants, assembly, remesher, passer, skip, vertices, strip_unit, shading, counters);
        dff_setup!(
            self,
            clock,
            sent,
            sent_error,
            sent_report,
            sent_value,
            sent_x,
            sent_y,
            sent_c,
            sent_height,
            sent_colour
        );
        dff_setup!(self, clock, pieces, reads, reports, clears, begun, report_index, rested);

        // Commands
        self.is_constant.next = self.in_kind.val() == 0;
        self.is_record.next = self.in_kind.val() == 1;
        self.is_map.next = self.in_kind.val() == 2 || self.in_kind.val() == 3;
        self.is_triangle.next = self.in_kind.val() == 4 && self.begun.q.val();
        self.is_report.next = self.in_kind.val() == 5;
        self.idle.next = self.assembly.idle.val()
            && !self.pieces.q.val().any()
            && self.vertices.idle.val()
            && self.shading.idle.val()
            && !self.reads.q.val()
            && !self.reports.q.val();
        self.rested.d.next = self.idle.val();
        self.resting.next = self.rested.q.val();
        // Those of the transform go on to the assembly, which has the say.
        self.ours.next = self.is_constant.val() && self.in_index.val().get_bit(6);
        self.assembly.in_valid.next = self.in_valid.val()
            && (self.is_triangle.val()
                || (self.idle.val() && (self.is_record.val() || (self.is_constant.val() && !self.ours.val()))));
        self.in_ready.next = self.idle.val();
        if self.is_triangle.val() {
            self.in_ready.next = self.assembly.in_ready.val();
        } else if self.is_map.val() {
            self.in_ready.next = self.idle.val() && self.vertices.map_ready.val();
        } else if self.is_record.val() || (self.is_constant.val() && !self.ours.val()) {
            self.in_ready.next = self.idle.val() && self.assembly.in_ready.val();
        } else if self.is_report.val() {
            // The last cycle of the last triangle is counted by then.
            self.in_ready.next = self.idle.val() && self.resting.val();
        }
        self.constants.write.next = self.in_valid.val() && self.in_ready.val() && self.is_constant.val();
        self.constants.index.next = self.in_index.val();
        self.constants.value.next = self.in_value.val();
        self.clears.d.next =
            self.in_valid.val() && self.in_ready.val() && self.is_constant.val() && !self.in_index.val().any();

        if self.clears.q.val() {
            self.begun.d.next = true;
        }
        self.lane_0.next = self.in_data.val().get_bit(0);
        self.lane_1.next = self.in_data.val().get_bit(1);
        self.lane_2.next = self.in_data.val().get_bit(2);
        self.lane_3.next = self.in_data.val().get_bit(3);
        self.lane_4.next = self.in_data.val().get_bit(4);
        self.lane_5.next = self.in_data.val().get_bit(5);
        self.lane_6.next = self.in_data.val().get_bit(6);
        self.lane_7.next = self.in_data.val().get_bit(7);

        // Assembly
        self.assembly.in_kind.next = bit_cast_to::<U<2>>(self.in_kind.val());
        if self.is_triangle.val() {
            self.assembly.in_kind.next = 2.into();
        }
        self.assembly.in_index.next = bit_cast_to::<U<6>>(self.in_index.val());
        self.assembly.in_value.next = self.in_value.val();
        self.assembly.in_data.next = self.in_data.val();
        self.assembly.in_place.next = bit_cast_to::<U<9>>(self.in_value.val());
        self.assembly.in_corner_0.next = bit_cast_to::<U<9>>(self.lane_0.val());
        self.assembly.in_corner_1.next = bit_cast_to::<U<9>>(self.lane_1.val());
        self.assembly.in_corner_2.next = bit_cast_to::<U<9>>(self.lane_2.val());
        self.assembly.culls.next = self.constants.culls.val();
        self.assembly.z0.next = self.constants.z0.val();
        self.assembly.focal.next = self.constants.focal.val();
        self.assembly.piece_ready.next = self.remesher.in_ready.val();
        if self.constants.passes.val() {
            self.assembly.piece_ready.next = self.passer.piece_ready.val();
        }
        self.piece_goes.next = self.assembly.piece_valid.val() && self.assembly.piece_ready.val();

        // Steps
        self.remesher.in_valid.next = self.assembly.piece_valid.val() && !self.constants.passes.val();
        self.remesher.in_p0.next = self.assembly.piece_p0.val();
        self.remesher.in_p1.next = self.assembly.piece_p1.val();
        self.remesher.in_p2.next = self.assembly.piece_p2.val();
        self.remesher.in_v0.next = self.assembly.piece_v0.val();
        self.remesher.in_v1.next = self.assembly.piece_v1.val();
        self.remesher.in_v2.next = self.assembly.piece_v2.val();
        self.passer.piece_valid.next = self.assembly.piece_valid.val() && self.constants.passes.val();
        self.passer.piece_v0.next = self.assembly.piece_v0.val();
        self.passer.piece_v1.next = self.assembly.piece_v1.val();
        self.passer.piece_v2.next = self.assembly.piece_v2.val();
        // The limit of its piece is there long before a step.
        self.vertices.in_valid.next = self.remesher.out_valid.val() && self.skip.valid.val();
        self.vertices.in_kind.next = self.remesher.out_kind.val();
        self.vertices.in_left.next = self.remesher.out_left.val();
        self.vertices.in_right.next = self.remesher.out_right.val();
        self.vertices.in_swap.next = self.remesher.out_swap.val();
        self.vertices.in_last.next = self.remesher.out_last.val();
        self.vertices.in_left_vertex.next = self.remesher.out_left_vertex.val();
        self.vertices.in_right_vertex.next = self.remesher.out_right_vertex.val();
        if self.constants.passes.val() {
            self.vertices.in_valid.next = self.passer.out_valid.val();
            self.vertices.in_kind.next = self.passer.out_kind.val();
            self.vertices.in_left.next = self.passer.out_left.val();
            self.vertices.in_right.next = self.passer.out_right.val();
            self.vertices.in_swap.next = false;
            self.vertices.in_last.next = self.passer.out_last.val();
            self.vertices.in_left_vertex.next = self.passer.out_left_vertex.val();
            self.vertices.in_right_vertex.next = self.passer.out_right_vertex.val();
        }
        self.remesher.out_ready.next =
            self.vertices.in_ready.val() && self.skip.valid.val() && !self.constants.passes.val();
        self.passer.out_ready.next = self.vertices.in_ready.val() && self.constants.passes.val();
        self.step_goes.next = self.vertices.in_valid.val() && self.vertices.in_ready.val();

        // Those of strips off the screen
        self.skip.goes.next = self.piece_goes.val() && !self.constants.passes.val();
        self.skip.p0.next = self.assembly.piece_p0.val();
        self.skip.p1.next = self.assembly.piece_p1.val();
        self.skip.p2.next = self.assembly.piece_p2.val();
        self.skip.c0.next = self.assembly.piece_v0.val().get_bit(2);
        self.skip.c1.next = self.assembly.piece_v1.val().get_bit(2);
        self.skip.c2.next = self.assembly.piece_v2.val().get_bit(2);
        self.skip.on.next = self.constants.skips.val();
        self.skip.half_width.next = self.constants.half_width.val();
        self.skip.half_height.next = self.constants.half_height.val();
        self.skip.reach.next = self.constants.reach.val();
        self.skip.margin.next = self.constants.margin.val();
        self.skip.take.next = self.step_goes.val() && self.vertices.in_last.val() && !self.constants.passes.val();
        self.vertices.limit.next = self.skip.limit.val();
        self.vertices.across.next = self.skip.across.val();
        if self.constants.passes.val() {
            self.vertices.limit.next = self.no_limit.val();
            self.vertices.across.next = false;
        }

        // Vertices
        self.vertices.map_valid.next = self.in_valid.val() && self.idle.val() && self.is_map.val();
        self.vertices.map_loads.next = self.in_kind.val().get_bit(0);
        self.vertices.map_level.next = bit_cast_to::<U<4>>(self.lane_0.val());
        self.vertices.map_i.next = bit_cast_to::<U<M>>(self.lane_1.val());
        self.vertices.map_j.next = bit_cast_to::<U<M>>(self.lane_2.val());
        self.vertices.map_value.next = bit_cast_to::<U<16>>(self.lane_3.val());
        self.vertices.map_base.next = bit_cast_to::<U<B>>(self.lane_3.val());
        self.vertices.map_minima_base.next = bit_cast_to::<U<B>>(self.lane_7.val());
        self.vertices.map_minima.next = self.lane_4.val().any();
        self.vertices.map_pitch.next = bit_cast_to::<U<M>>(self.lane_4.val());
        self.vertices.map_repeat_u.next = self.lane_5.val().any();
        self.vertices.map_repeat_v.next = self.lane_6.val().any();
        self.vertices.passes.next = self.constants.passes.val();
        self.vertices.minima.next = self.constants.minima.val();
        self.vertices.axis_u.next = self.constants.axis_u.val();
        self.vertices.axis_v.next = self.constants.axis_v.val();
        self.vertices.level.next = self.constants.level.val();
        self.vertices.minimum.next = self.constants.minimum.val();
        self.vertices.range.next = self.constants.range.val();
        self.vertices.exponent.next = self.constants.exponent.val();
        self.vertices.focal.next = self.constants.focal.val();
        self.vertices.out_ready.next = self.strip_unit.in_ready.val();

        // Strips
        self.strip_unit.in_valid.next = self.vertices.out_valid.val();
        self.strip_unit.in_kind.next = self.vertices.out_kind.val();
        self.strip_unit.in_left.next = self.vertices.out_left.val();
        self.strip_unit.in_right.next = self.vertices.out_right.val();
        self.strip_unit.in_swap.next = self.vertices.out_swap.val();
        self.strip_unit.in_last.next = self.vertices.out_last.val();
        self.strip_unit.in_left_vertex.next = self.vertices.out_left_vertex.val();
        self.strip_unit.in_right_vertex.next = self.vertices.out_right_vertex.val();
        self.strip_unit.out_ready.next = self.shading.in_ready.val();

        // Triangles
        self.shading.in_valid.next = self.strip_unit.out_valid.val();
        self.shading.in_first.next = self.strip_unit.out_first.val();
        self.shading.in_second.next = self.strip_unit.out_second.val();
        self.shading.in_swap.next = self.strip_unit.out_swap.val();
        self.shading.in_left.next = self.strip_unit.out_left.val();
        self.shading.in_right.next = self.strip_unit.out_right.val();
        self.shading.in_next_left.next = self.strip_unit.out_next_left.val();
        self.shading.in_next_right.next = self.strip_unit.out_next_right.val();
        self.shading.skips.next = self.constants.skips.val();
        self.shading.half_width.next = self.constants.half_width.val();
        self.shading.half_height.next = self.constants.half_height.val();
        self.shading.pixel.next = self.constants.pixel.val();
        self.shading.ramp_0.next = self.constants.ramp_0.val();
        self.shading.ramp_1.next = self.constants.ramp_1.val();
        self.shading.ramp_2.next = self.constants.ramp_2.val();
        self.shading.ramp_3.next = self.constants.ramp_3.val();
        self.shading.ramp_4.next = self.constants.ramp_4.val();
        self.shading.ambient.next = self.constants.ambient.val();
        self.shading.shine.next = self.constants.shine.val();
        self.shading.direction.next = self.constants.direction.val();
        self.shading.colour.next = self.constants.colour.val();
        self.out_free.next = !self.sent.q.val() || self.out_ready.val();
        self.shading.out_ready.next = self.out_free.val() && !self.reports.q.val();

        // What leaves: a report is alone.
        self.reads.d.next = self.in_valid.val() && self.in_ready.val() && self.is_report.val();
        if self.is_report.val() && self.in_ready.val() {
            self.report_index.d.next = self.in_index.val();
        }
        if self.reads.q.val() {
            self.reports.d.next = true;
        } else if self.out_free.val() {
            self.reports.d.next = false;
        }
        if self.out_free.val() {
            self.sent.d.next = self.shading.out_valid.val() || self.reports.q.val();
            self.sent_error.d.next =
                self.sent_error.q.val() || self.vertices.error.val() || self.strip_unit.error.val();
            self.sent_report.d.next = self.reports.q.val();
            self.sent_value.d.next = 0.into();
            self.sent_x.d.next = self.shading.out_x.val();
            self.sent_y.d.next = self.shading.out_y.val();
            self.sent_c.d.next = self.shading.out_c.val();
            self.sent_height.d.next = self.shading.out_height.val();
            self.sent_colour.d.next = self.shading.out_colour.val();
            if self.reports.q.val() {
                self.sent_value.d.next = self.counters.value.val();
                self.sent_x.d.next = self.no_x.val();
                self.sent_y.d.next = self.no_x.val();
                self.sent_c.d.next = self.no_c.val();
                self.sent_height.d.next = self.no_height.val();
                self.sent_colour.d.next = 0.into();
            }
        }
        self.out_valid.next = self.sent.q.val();
        self.out_report.next = self.sent_report.q.val();
        self.out_value.next = self.sent_value.q.val();
        self.out_x.next = self.sent_x.q.val();
        self.out_y.next = self.sent_y.q.val();
        self.out_c.next = self.sent_c.q.val();
        self.out_height.next = self.sent_height.q.val();
        self.out_colour.next = self.sent_colour.q.val();
        self.error.next = self.sent_error.q.val();

        // Pieces on their way
        self.ends.next =
            self.strip_unit.out_valid.val() && self.shading.in_ready.val() && self.strip_unit.out_last.val();
        if self.piece_goes.val() && !self.ends.val() {
            self.pieces.d.next = self.pieces.q.val() + 1;
        } else if !self.piece_goes.val() && self.ends.val() {
            self.pieces.d.next = self.pieces.q.val() - 1;
        }

        // Counters
        self.counters.clear.next = self.clears.q.val();
        self.counters.index.next = self.report_index.q.val();
        self.counters.read.next = self.reads.q.val();
        self.culled.next = self.assembly.reason.val();
        self.counters.bases.next = self.in_valid.val() && self.in_ready.val() && self.is_triangle.val();
        self.counters.left.next = self.assembly.culled.val() && self.culled.val() == 0;
        self.counters.right.next = self.assembly.culled.val() && self.culled.val() == 1;
        self.counters.top.next = self.assembly.culled.val() && self.culled.val() == 2;
        self.counters.bottom.next = self.assembly.culled.val() && self.culled.val() == 3;
        self.counters.near_side.next = self.assembly.culled.val() && self.culled.val() == 4;
        self.counters.far_side.next = self.assembly.culled.val() && self.culled.val() == 5;
        self.counters.cut.next = self.assembly.cut.val();
        self.counters.near.next = self.assembly.near.val();
        self.counters.lane.next = self.assembly.lane.val();
        self.counters.grid.next = self.assembly.grid.val();
        self.counters.pieces.next = self.piece_goes.val();
        self.counters.steps.next = self.step_goes.val();
        self.counters.vertices.next = self.vertices.sends.val();
        self.counters.skipped.next = self.vertices.skips.val();
        self.counters.triangles.next = self.shading.comes.val();
        self.counters.two_triangles.next = self.shading.two_come.val();
        self.counters.invalid.next = self.shading.invalid.val();
        self.counters.two_invalid.next = self.shading.two_invalid.val();
        self.counters.too_near.next = self.shading.near.val();
        self.counters.two_too_near.next = self.shading.two_near.val();
        self.counters.beyond.next = self.shading.range.val();
        self.counters.two_beyond.next = self.shading.two_range.val();
        self.counters.off.next = self.shading.off.val();
        self.counters.two_off.next = self.shading.two_off.val();
        self.counters.sent.next = self.shading.out_valid.val() && self.shading.out_ready.val();
        self.counters.cycles.next = !self.idle.val();
        self.counters.piece_waits.next = self.assembly.piece_valid.val() && !self.assembly.piece_ready.val();
        self.counters.silent.next = self.pieces.q.val().any() && !self.vertices.in_valid.val();
        self.counters.lacks_room.next = self.vertices.lacks_room.val();
        self.counters.sends_second.next = self.vertices.sends_second.val();
        self.counters.strip_waits.next = self.strip_unit.out_valid.val() && !self.shading.in_ready.val();
        self.counters.out_waits.next = self.sent.q.val() && !self.out_ready.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("displacement_pipeline")
    }
}

ports! {
    [const V: usize, const W: usize, const X: usize, const N: usize, const T: usize, const A: usize, const P: usize, const K: usize, const M: usize, const B: usize] DisplacementPipeline<V, W, X, N, T, A, P, K, M, B> {
        inputs: in_valid, in_kind, in_index, in_value, in_data, out_ready;
        outputs: in_ready, out_valid, out_report, out_value, out_x, out_y, out_c, out_height, out_colour, error;
        blocks: constants, assembly, remesher, passer, skip, vertices, strip_unit, shading, counters;
        state: constants, assembly, remesher, passer, skip, vertices, strip_unit, shading, counters, sent, sent_error, sent_report, sent_value, sent_x, sent_y, sent_c, sent_height, sent_colour, pieces, reads, reports, clears, begun, report_index, rested
    }
}
