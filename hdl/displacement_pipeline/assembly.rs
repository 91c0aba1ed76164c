// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertex memory and base triangles: records become transformed vertices, and triangles of them become pieces for the
//! remesher, which are kept, culled, dropped, or cut into a fan.
//!
//! ```text
//! constants, records -> [vertex_transform] -> vertex memory -> corners -> [cull] -+- kept ------------------> piece
//!                            ^                                                    +- cut -> [clip] -> fan --> pieces
//!                            '----------------- vertices of the polygon ----------------------'
//! ```
//!
//! | port      | format        | meaning |   Golden: models::draw::Draw::assemble   Error 0
//! | in_kind   | unsigned 2    | 0 a constant of the transform, 1 a record for `place`, 2 a triangle of `corner_0..2`
//! | place     | unsigned 9    | where the record's vertex goes
//! | piece_*   | stream        | grid corners and lanes
//! | idle      | Bit           | no triangle is here
//! | culled, reason; cut; near, lane, grid | Bit, unsigned 3; Bits | what became of a triangle, for a cycle
//!
//! One base triangle is worked on at a time, which is shorter than what the remesher takes for one. It waits until every record
//! before it is transformed; one that is cut waits for the cutter, and for the transform of each vertex of what is left.

use super::narrow::Narrow;
use crate::clip::Clip;
use crate::cull::Cull;
use crate::displacement_pipeline::lane_queue::LaneQueue;
use crate::prelude::*;
use crate::vertex_transform::VertexTransform;

/// States.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
#[allow(missing_docs)]
pub enum AssemblyState {
    Idle,
    /// The three corners are read, two cycles each.
    ReadA,
    ReadB,
    ReadC,
    TakeB,
    TakeC,
    /// The corners are at the culling,
    Judge,
    /// which answers.
    Verdict,
    /// A piece is offered.
    Offer,
    /// The corners go to the cutter.
    Cut,
    /// It answers, and a vertex goes to the transform,
    Polygon,
    /// which answers.
    Project,
    /// Whether all vertices have a place.
    Fan,
}

/// Assembly, for lanes of `V` bits and coordinates of `N`.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Assembly<const V: usize, const N: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_index: Input<U<6>>,
    pub in_value: Input<S<63>>,
    pub in_data: Input<Lanes<9, 48>>,
    pub in_place: Input<U<9>>,
    pub in_corner_0: Input<U<9>>,
    pub in_corner_1: Input<U<9>>,
    pub in_corner_2: Input<U<9>>,
    pub culls: Input<Bit>,
    pub z0: Input<S<47>>,
    pub focal: Input<U<32>>,
    pub piece_valid: Output<Bit>,
    pub piece_ready: Input<Bit>,
    pub piece_p0: Output<Lanes<3, N>>,
    pub piece_p1: Output<Lanes<3, N>>,
    pub piece_p2: Output<Lanes<3, N>>,
    pub piece_v0: Output<Lanes<9, V>>,
    pub piece_v1: Output<Lanes<9, V>>,
    pub piece_v2: Output<Lanes<9, V>>,
    pub idle: Output<Bit>,
    pub culled: Output<Bit>,
    pub reason: Output<U<3>>,
    pub cut: Output<Bit>,
    pub near: Output<Bit>,
    pub lane: Output<Bit>,
    pub grid: Output<Bit>,
    state: Register<AssemblyState>,
    transform: Gated<VertexTransform>,
    narrower: Narrow<V>,
    places: Gated<LaneQueue<1, 10, 2>>,
    cull: Gated<Cull>,
    clip: Gated<Clip>,
    /// The first constant has come: the transform sends vertices.
    begun: Register<Bit>,
    /// Records in the transform.
    records: Register<U<3>>,
    // The vertex memory: 512 places, and sixteen for a polygon.
    lanes: RegisteredRam<Lanes<9, V>, 10>,
    corners: RegisteredRam<Lanes<3, N>, 10>,
    views: RegisteredRam<Lanes<9, 48>, 10>,
    flags: RegisteredRam<U<13>, 10>,
    place_0: Register<U<10>>,
    place_1: Register<U<10>>,
    place_2: Register<U<10>>,
    p0: DataRegister<Lanes<3, N>>,
    p1: DataRegister<Lanes<3, N>>,
    p2: DataRegister<Lanes<3, N>>,
    v0: DataRegister<Lanes<9, V>>,
    v1: DataRegister<Lanes<9, V>>,
    v2: DataRegister<Lanes<9, V>>,
    view_0: DataRegister<Lanes<9, 48>>,
    view_1: DataRegister<Lanes<9, 48>>,
    view_2: DataRegister<Lanes<9, 48>>,
    flags_0: DataRegister<U<13>>,
    flags_1: DataRegister<U<13>>,
    flags_2: DataRegister<U<13>>,
    /// Corner that goes to the cutter.
    corner: Register<U<2>>,
    /// Vertices of the polygon so far.
    vertices: Register<U<5>>,
    last: Register<Bit>,
    fan: Register<Bit>,
    /// The first status of the polygon's vertices that is not 0.
    status: Register<U<2>>,
    is_idle: Wire<Bit>,
    takes_polygon: Wire<Bit>,
    projects: Wire<Bit>,
    record: Wire<Bit>,
    arrives: Wire<Bit>,
    address: Wire<U<10>>,
    polygon_place: Wire<U<10>>,
    record_place: Wire<U<10>>,
    flags_in: Wire<U<13>>,
    verdict: Wire<U<2>>,
    verdict_here: Wire<Bit>,
    polygon_ends: Wire<U<10>>,
    first_place: Constant<U<10>>,
}

impl<const V: usize, const N: usize> Assembly<V, N> {
    /// Vertices that the memory holds.
    pub const PLACES: usize = 512;
    /// Vertices of a polygon.
    const POLYGON: usize = 16;
}

impl<const V: usize, const N: usize> Default for Assembly<V, N> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_index: Input::default(),
            in_value: Input::default(),
            in_data: Input::default(),
            in_place: Input::default(),
            in_corner_0: Input::default(),
            in_corner_1: Input::default(),
            in_corner_2: Input::default(),
            culls: Input::default(),
            z0: Input::default(),
            focal: Input::default(),
            piece_valid: Output::default(),
            piece_ready: Input::default(),
            piece_p0: Output::default(),
            piece_p1: Output::default(),
            piece_p2: Output::default(),
            piece_v0: Output::default(),
            piece_v1: Output::default(),
            piece_v2: Output::default(),
            idle: Output::default(),
            culled: Output::default(),
            reason: Output::default(),
            cut: Output::default(),
            near: Output::default(),
            lane: Output::default(),
            grid: Output::default(),
            state: Register::new(AssemblyState::Idle),
            transform: Gated::default(),
            narrower: Narrow::default(),
            places: Gated::default(),
            cull: Gated::default(),
            clip: Gated::default(),
            begun: Register::default(),
            records: Register::default(),
            lanes: RegisteredRam::new(Self::PLACES + Self::POLYGON),
            corners: RegisteredRam::new(Self::PLACES + Self::POLYGON),
            views: RegisteredRam::new(Self::PLACES + Self::POLYGON),
            flags: RegisteredRam::new(Self::PLACES + Self::POLYGON),
            place_0: Register::default(),
            place_1: Register::default(),
            place_2: Register::default(),
            p0: DataRegister::default(),
            p1: DataRegister::default(),
            p2: DataRegister::default(),
            v0: DataRegister::default(),
            v1: DataRegister::default(),
            v2: DataRegister::default(),
            view_0: DataRegister::default(),
            view_1: DataRegister::default(),
            view_2: DataRegister::default(),
            flags_0: DataRegister::default(),
            flags_1: DataRegister::default(),
            flags_2: DataRegister::default(),
            corner: Register::default(),
            vertices: Register::default(),
            last: Register::default(),
            fan: Register::default(),
            status: Register::default(),
            is_idle: Wire::default(),
            takes_polygon: Wire::default(),
            projects: Wire::default(),
            record: Wire::default(),
            arrives: Wire::default(),
            address: Wire::default(),
            polygon_place: Wire::default(),
            record_place: Wire::default(),
            flags_in: Wire::default(),
            verdict: Wire::default(),
            verdict_here: Wire::default(),
            polygon_ends: Wire::default(),
            first_place: Constant::new(U::new(Self::PLACES as i64)),
        }
    }
}

impl<const V: usize, const N: usize> Logic for Assembly<V, N> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, transform, places, cull, clip, lanes, corners, views, flags);
        dff_setup!(self, clock, state, begun, records, place_0, place_1, place_2, p0, p1, p2, v0, v1, v2);
        dff_setup!(self, clock, view_0, view_1, view_2, flags_0, flags_1, flags_2, corner, vertices, last, fan, status);
        self.is_idle.next = self.state.q.val() == AssemblyState::Idle;
        self.idle.next = self.is_idle.val();

        // The transform takes constants and records while nothing is here, and vertices of polygons otherwise.
        self.takes_polygon.next = self.state.q.val() == AssemblyState::Polygon && self.clip.out_kept.val();
        self.projects.next = self.state.q.val() == AssemblyState::Project;
        self.transform.in_index.next = self.in_index.val();
        self.transform.in_value.next = self.in_value.val();
        self.transform.in_kind.next = self.in_kind.val();
        self.transform.in_data.next = self.in_data.val();
        self.transform.in_valid.next = self.in_valid.val() && self.is_idle.val() && !self.in_kind.val().get_bit(1);
        self.in_ready.next = self.is_idle.val() && self.transform.in_ready.val();
        if self.in_kind.val().get_bit(1) {
            self.in_ready.next = self.is_idle.val() && !self.records.q.val().any();
        }
        if !self.is_idle.val() {
            self.transform.in_kind.next = 2.into();
            self.transform.in_data.next = self.clip.out_view.val();
            self.transform.in_valid.next = self.takes_polygon.val() && self.clip.out_valid.val();
        }
        self.transform.out_ready.next = true;
        self.record.next = self.in_valid.val()
            && self.is_idle.val()
            && self.transform.in_ready.val()
            && self.in_kind.val() == 1
            && self.begun.q.val();
        if self.in_valid.val() && self.in_ready.val() && !self.in_kind.val().any() && !self.in_index.val().any() {
            self.begun.d.next = true;
        }
        self.places.push.next = self.record.val();
        self.places.data.next = bit_cast_to::<Lanes<1, 10>>(bit_cast_to::<S<10>>(self.in_place.val()));
        self.arrives.next = self.transform.out_valid.val() && self.is_idle.val();
        self.places.take.next = self.arrives.val();
        if self.record.val() && !self.arrives.val() {
            self.records.d.next = self.records.q.val() + 1;
        } else if !self.record.val() && self.arrives.val() {
            self.records.d.next = self.records.q.val() - 1;
        }

        // The memory is written with what the transform sends, and read at a corner.
        self.narrower.whole.next = self.transform.out_data.val();
        self.record_place.next = bit_cast_to::<U<10>>(self.places.head.val().get_bit(0));
        self.polygon_place.next = bit_cast_to::<U<10>>(self.vertices.q.val()) + self.first_place.val();
        self.flags_in.next = (bit_cast_to::<U<13>>(self.transform.out_outcode.val()) << 7)
            | (bit_cast_to::<U<13>>(self.transform.out_outside.val()) << 2)
            | bit_cast_to::<U<13>>(self.transform.out_status.val());
        self.address.next = self.place_0.q.val();
        if self.state.q.val() == AssemblyState::ReadB {
            self.address.next = self.place_1.q.val();
        } else if self.state.q.val() == AssemblyState::ReadC {
            self.address.next = self.place_2.q.val();
        }
        self.lanes.enable.next = true;
        self.lanes.output_enable.next = true;
        self.corners.enable.next = true;
        self.corners.output_enable.next = true;
        self.views.enable.next = true;
        self.views.output_enable.next = true;
        self.flags.enable.next = true;
        self.flags.output_enable.next = true;
        self.lanes.read_address.next = self.address.val();
        self.corners.read_address.next = self.address.val();
        self.views.read_address.next = self.address.val();
        self.flags.read_address.next = self.address.val();
        self.lanes.write_address.next = self.record_place.val();
        self.corners.write_address.next = self.record_place.val();
        self.views.write_address.next = self.record_place.val();
        self.flags.write_address.next = self.record_place.val();
        if self.projects.val() {
            self.lanes.write_address.next = self.polygon_place.val();
            self.corners.write_address.next = self.polygon_place.val();
            self.views.write_address.next = self.polygon_place.val();
            self.flags.write_address.next = self.polygon_place.val();
        }
        self.lanes.write_enable.next = self.transform.out_valid.val();
        self.corners.write_enable.next = self.transform.out_valid.val();
        self.views.write_enable.next = self.transform.out_valid.val();
        self.flags.write_enable.next = self.transform.out_valid.val();
        self.lanes.write_data.next = self.narrower.narrow.val();
        self.corners.write_data.next = bit_cast_to::<Lanes<3, N>>(self.transform.out_corner.val());
        self.views.write_data.next = self.transform.out_view.val();
        self.flags.write_data.next = self.flags_in.val();

        self.cull.in_outcode_0.next = self.flags_0.q.val().get_bits::<6>(7);
        self.cull.in_outcode_1.next = self.flags_1.q.val().get_bits::<6>(7);
        self.cull.in_outcode_2.next = self.flags_2.q.val().get_bits::<6>(7);
        self.cull.in_outside_0.next = self.flags_0.q.val().get_bits::<5>(2);
        self.cull.in_outside_1.next = self.flags_1.q.val().get_bits::<5>(2);
        self.cull.in_outside_2.next = self.flags_2.q.val().get_bits::<5>(2);
        self.cull.in_status_0.next = self.flags_0.q.val().get_bits::<2>(0);
        self.cull.in_status_1.next = self.flags_1.q.val().get_bits::<2>(0);
        self.cull.in_status_2.next = self.flags_2.q.val().get_bits::<2>(0);
        self.cull.in_culls.next = self.culls.val();
        self.cull.in_valid.next = self.state.q.val() == AssemblyState::Judge;
        self.cull.out_ready.next = self.state.q.val() == AssemblyState::Verdict;
        self.verdict.next = self.cull.out_verdict.val();
        self.verdict_here.next = self.state.q.val() == AssemblyState::Verdict && self.cull.out_valid.val();
        self.reason.next = self.cull.out_reason.val();

        self.clip.in_valid.next = self.state.q.val() == AssemblyState::Cut;
        self.clip.in_view.next = self.view_0.q.val();
        if self.corner.q.val() == 1 {
            self.clip.in_view.next = self.view_1.q.val();
        } else if self.corner.q.val() == 2 {
            self.clip.in_view.next = self.view_2.q.val();
        }
        self.clip.in_z0.next = self.z0.val();
        self.clip.in_focal.next = self.focal.val();
        self.clip.out_ready.next = false;
        if self.state.q.val() == AssemblyState::Polygon {
            self.clip.out_ready.next = !self.clip.out_kept.val() || self.transform.in_ready.val();
        }

        self.piece_valid.next = self.state.q.val() == AssemblyState::Offer;
        self.piece_p0.next = self.p0.q.val();
        self.piece_p1.next = self.p1.q.val();
        self.piece_p2.next = self.p2.q.val();
        self.piece_v0.next = self.v0.q.val();
        self.piece_v1.next = self.v1.q.val();
        self.piece_v2.next = self.v2.q.val();
        self.polygon_ends.next = self.polygon_place.val() - 1;

        self.culled.next = self.verdict_here.val() && self.verdict.val() == 1;
        self.cut.next = false;
        self.near.next = false;
        self.lane.next = self.verdict_here.val() && self.verdict.val() == 3 && self.cull.out_reason.val() == 1;
        self.grid.next = self.verdict_here.val() && self.verdict.val() == 3 && self.cull.out_reason.val() != 1;
        match self.state.q.val() {
            AssemblyState::Idle => {
                self.place_0.d.next = bit_cast_to::<U<10>>(self.in_corner_0.val());
                self.place_1.d.next = bit_cast_to::<U<10>>(self.in_corner_1.val());
                self.place_2.d.next = bit_cast_to::<U<10>>(self.in_corner_2.val());
                self.fan.d.next = false;
                self.corner.d.next = 0.into();
                self.vertices.d.next = 0.into();
                self.status.d.next = 0.into();
                if self.in_valid.val() && self.in_kind.val().get_bit(1) && !self.records.q.val().any() {
                    self.state.d.next = AssemblyState::ReadA;
                }
            }
            AssemblyState::ReadA => {
                self.state.d.next = AssemblyState::ReadB;
            }
            AssemblyState::ReadB => {
                self.state.d.next = AssemblyState::ReadC;
            }
            AssemblyState::ReadC => {
                self.p0.d.next = self.corners.read_data.val();
                self.v0.d.next = self.lanes.read_data.val();
                self.view_0.d.next = self.views.read_data.val();
                self.flags_0.d.next = self.flags.read_data.val();
                self.state.d.next = AssemblyState::TakeB;
            }
            AssemblyState::TakeB => {
                self.p1.d.next = self.corners.read_data.val();
                self.v1.d.next = self.lanes.read_data.val();
                self.view_1.d.next = self.views.read_data.val();
                self.flags_1.d.next = self.flags.read_data.val();
                self.state.d.next = AssemblyState::TakeC;
            }
            AssemblyState::TakeC => {
                self.p2.d.next = self.corners.read_data.val();
                self.v2.d.next = self.lanes.read_data.val();
                self.view_2.d.next = self.views.read_data.val();
                self.flags_2.d.next = self.flags.read_data.val();
                self.state.d.next = AssemblyState::Judge;
                if self.fan.q.val() {
                    self.state.d.next = AssemblyState::Offer;
                }
            }
            AssemblyState::Judge => {
                if self.cull.in_ready.val() {
                    self.state.d.next = AssemblyState::Verdict;
                }
            }
            AssemblyState::Verdict => {
                if self.cull.out_valid.val() {
                    self.state.d.next = AssemblyState::Idle;
                    if self.verdict.val() == 0 {
                        self.state.d.next = AssemblyState::Offer;
                    } else if self.verdict.val() == 2 {
                        self.state.d.next = AssemblyState::Cut;
                    }
                }
            }
            AssemblyState::Cut => {
                if self.clip.in_ready.val() {
                    self.corner.d.next = self.corner.q.val() + 1;
                    if self.corner.q.val() == 2 {
                        self.state.d.next = AssemblyState::Polygon;
                    }
                }
            }
            AssemblyState::Polygon => {
                self.last.d.next = self.clip.out_last.val();
                if self.clip.out_valid.val() {
                    if !self.clip.out_kept.val() {
                        self.near.next = true;
                        self.state.d.next = AssemblyState::Idle;
                    } else if self.transform.in_ready.val() {
                        self.state.d.next = AssemblyState::Project;
                    }
                }
            }
            AssemblyState::Project => {
                if self.transform.out_valid.val() {
                    self.vertices.d.next = self.vertices.q.val() + 1;
                    if !self.status.q.val().any() {
                        self.status.d.next = self.transform.out_status.val();
                    }
                    self.state.d.next = AssemblyState::Polygon;
                    if self.last.q.val() {
                        self.state.d.next = AssemblyState::Fan;
                    }
                }
            }
            AssemblyState::Fan => {
                self.place_0.d.next = self.first_place.val();
                self.place_1.d.next = self.first_place.val() + 1;
                self.place_2.d.next = self.first_place.val() + 2;
                self.fan.d.next = true;
                self.state.d.next = AssemblyState::Idle;
                if self.status.q.val() == 1 {
                    self.lane.next = true;
                } else if self.status.q.val().any() {
                    self.grid.next = true;
                } else {
                    self.cut.next = true;
                    self.state.d.next = AssemblyState::ReadA;
                }
            }
            AssemblyState::Offer => {
                if self.piece_ready.val() {
                    self.state.d.next = AssemblyState::Idle;
                    if self.fan.q.val() && self.place_2.q.val() != self.polygon_ends.val() {
                        self.place_1.d.next = self.place_1.q.val() + 1;
                        self.place_2.d.next = self.place_2.q.val() + 1;
                        self.state.d.next = AssemblyState::ReadA;
                    }
                }
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("assembly")
    }
}

watched! { [const V: usize, const N: usize] Assembly<V, N>: in_valid, in_kind, in_index, in_value, in_data, in_place, in_corner_0, in_corner_1, in_corner_2, culls, z0, focal, piece_ready; transform, narrower, places, cull, clip; state, transform, places, cull, clip, begun, records, lanes, corners, views, flags, place_0, place_1, place_2, p0, p1, p2, v0, v1, v2, view_0, view_1, view_2, flags_0, flags_1, flags_2, corner, vertices, last, fan, status }
