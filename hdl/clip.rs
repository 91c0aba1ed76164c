// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cuts a base triangle at the constant planes, one bit after another: few are cut, and cells count more than cycles.
//!
//! ```text
//! polygon after plane k = vertices with distance_k >= 0, and the points of edges at which it is 0, in order
//! point = a + (b - a) d_a / (d_a - d_b), every lane rounded half up       planes: z0, and the guard band
//! ```
//!
//! | port      | format        | meaning |   Golden: models::clip::golden   Error 0
//! | in_view   | 9 x signed 48 | vertex in view space, of the vertex transform; three beats make a triangle
//! | in_z0, in_focal | signed 47, unsigned 32 | constants of the draw, z0 in view units, focal length UQ16.16; those of the third beat count
//! | out_view  | 9 x signed 48 | vertex of the polygon that is left, for a fan; 0 if nothing is
//! | out_kept  | Bit           | three vertices or more are left
//! | out_last  | Bit           | the last vertex of its polygon; a polygon of nothing is one beat
//!
//! A plane takes 70 cycles a vertex for the distances, and only if one is below 0 another 27 for a vertex that stays and 1,389
//! for one that is made. What no plane cuts begins to leave after 1,118 cycles, a vertex every 29.
//!
//! Which end of an edge comes first makes no difference: the point is an exact quotient that is rounded once.
//!
//! An exact polygon has eight vertices at most. Rounding can make more where a plane passes within a unit of several vertices;
//! there are sixteen places, and what would be a seventeenth is left out.
//!
//! Example: ends at z = z0 - 1 and z0 + 3, x = 0 and 100 -> z = z0, x = 25.

mod between;
mod serial_product;

pub use between::{Between, MixState};
pub use serial_product::SerialProduct;

use crate::prelude::*;

/// States; `src/prove/contract/clip.sv` knows some by their numbers.
#[derive(Copy, Clone, PartialEq, Eq, Debug, LogicState)]
#[allow(missing_docs)]
pub enum ClipState {
    /// A vertex goes into the memory, a lane a cycle,
    Load,
    /// and is taken.
    Taken,
    /// z of a vertex is read, two cycles long,
    Measure,
    Fetch,
    /// and multiplied;
    Depth,
    /// then its x or y, or z0,
    Across,
    /// and their sum or difference is the distance,
    Sum,
    /// which is kept with its sign.
    Note,
    /// Whether the plane cuts.
    Decide,
    /// Whether a vertex stays.
    Keep,
    /// It is copied, lane by lane.
    CopyRead,
    CopyFetch,
    CopyWrite,
    /// Whether the edge behind it is cut.
    Cross,
    /// The distances of its ends: their sizes,
    Near,
    Far,
    /// and the sum of both.
    Span,
    /// The point, lane by lane.
    ReadA,
    ReadB,
    From,
    Start,
    Mix,
    /// The next vertex.
    Advance,
    /// The next plane.
    Plane,
    /// A vertex is sent, lane by lane.
    Send,
    SendRead,
    SendFetch,
    SendKeep,
    Wait,
}

/// Clipping.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Clip {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_view: Input<Lanes<9, 48>>,
    pub in_z0: Input<S<47>>,
    pub in_focal: Input<U<32>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_view: Output<Lanes<9, 48>>,
    pub out_kept: Output<Bit>,
    pub out_last: Output<Bit>,
    state: Register<ClipState>,
    taking: Register<Bit>,
    /// Bank, vertex, lane. The polygon is in one bank, what is left of it goes into the other.
    memory: RegisteredRam<S<48>, 9>,
    distances: Ram<WideS<64>, 4>,
    bank: Register<Bit>,
    plane: Register<U<3>>,
    vertices: Register<U<5>>,
    next_vertices: Register<U<5>>,
    vertex: Register<U<5>>,
    lane: Register<U<4>>,
    z0: DataRegister<S<47>>,
    focal: DataRegister<U<32>>,
    depth: DataRegister<WideS<64>>,
    distance: DataRegister<WideS<64>>,
    /// Vertices with a distance below, and above 0.
    below: Register<U<16>>,
    above: Register<U<16>>,
    near_size: DataRegister<WideU<64>>,
    far_size: DataRegister<WideU<64>>,
    span: DataRegister<WideU<65>>,
    from: DataRegister<S<48>>,
    multiplier: SerialProduct,
    between: Between,
    sent: Register<Bit>,
    view: DataRegister<Lanes<9, 48>>,
    kept: DataRegister<Bit>,
    last: DataRegister<Bit>,
    is_last: Wire<Bit>,
    following: Wire<U<5>>,
    /// A seventeenth vertex is left out.
    room: Wire<Bit>,
    here: Wire<U<4>>,
    there: Wire<U<4>>,
    at: Wire<U<4>>,
    at_lane: Wire<U<4>>,
    other: Wire<Bit>,
    lane_01: Wire<S<48>>,
    lane_3: Wire<S<33>>,
    lane_23: Wire<S<48>>,
    lane_03: Wire<S<48>>,
    lane_45: Wire<S<33>>,
    lane_67: Wire<S<33>>,
    lane_47: Wire<S<33>>,
    lane_8: Wire<S<33>>,
    lane_in: Wire<S<48>>,
    size: Wire<WideS<65>>,
    last_lane: Wire<Bit>,
    crosses: Wire<Bit>,
    is_near: Wire<Bit>,
    axis: Wire<U<4>>,
    one: Constant<U<32>>,
    guard: Constant<U<32>>,
    no_view: Constant<Lanes<9, 48>>,
}

impl Default for Clip {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_view: Input::default(),
            in_z0: Input::default(),
            in_focal: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_view: Output::default(),
            out_kept: Output::default(),
            out_last: Output::default(),
            state: Register::new(ClipState::Load),
            taking: Register::default(),
            memory: RegisteredRam::default(),
            distances: Ram::default(),
            bank: Register::default(),
            plane: Register::default(),
            vertices: Register::default(),
            next_vertices: Register::default(),
            vertex: Register::default(),
            lane: Register::default(),
            z0: DataRegister::default(),
            focal: DataRegister::default(),
            depth: DataRegister::default(),
            distance: DataRegister::default(),
            below: Register::default(),
            above: Register::default(),
            near_size: DataRegister::default(),
            far_size: DataRegister::default(),
            span: DataRegister::default(),
            from: DataRegister::default(),
            multiplier: SerialProduct::default(),
            between: Between::default(),
            sent: Register::default(),
            view: DataRegister::default(),
            kept: DataRegister::default(),
            last: DataRegister::default(),
            is_last: Wire::default(),
            following: Wire::default(),
            room: Wire::default(),
            here: Wire::default(),
            there: Wire::default(),
            at: Wire::default(),
            at_lane: Wire::default(),
            other: Wire::default(),
            lane_01: Wire::default(),
            lane_3: Wire::default(),
            lane_23: Wire::default(),
            lane_03: Wire::default(),
            lane_45: Wire::default(),
            lane_67: Wire::default(),
            lane_47: Wire::default(),
            lane_8: Wire::default(),
            lane_in: Wire::default(),
            size: Wire::default(),
            last_lane: Wire::default(),
            crosses: Wire::default(),
            is_near: Wire::default(),
            axis: Wire::default(),
            // 2^16 and 8190 2^16: the product loses 16 bits.
            one: Constant::new(U::new(1 << 16)),
            guard: Constant::new(U::new(8190 << 16)),
            no_view: Constant::new(Lanes::default()),
        }
    }
}

impl Clip {
    /// Cycles from the first vertex of a triangle that no plane cuts to what is sent first: ten a vertex for the memory, the
    /// distances of three vertices and a decision for each plane, and one vertex out of the memory.
    pub const LATENCY: usize = 3 * 10 + 5 * (3 * (2 * SerialProduct::LATENCY + 4) + 2) + 28;
    /// Cycles between two vertices that are sent.
    pub const INTERVAL: usize = 29;
}

impl Logic for Clip {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, memory, distances, multiplier, between);
        dff_setup!(self, clock, state, taking, bank, plane, vertices, next_vertices, vertex, lane, z0, focal, depth);
        dff_setup!(self, clock, distance, below, above, near_size, far_size, span, from, sent, view, kept, last);
        self.in_ready.next = self.taking.q.val();
        self.out_valid.next = self.sent.q.val();
        self.out_view.next = self.view.q.val();
        self.out_kept.next = self.kept.q.val();
        self.out_last.next = self.last.q.val();

        self.following.next = self.vertex.q.val() + 1;
        self.room.next = !self.next_vertices.q.val().get_bit(4);
        self.is_last.next = self.following.val() == self.vertices.q.val();
        self.here.next = bit_cast_to::<U<4>>(self.vertex.q.val());
        self.there.next = bit_cast_to::<U<4>>(self.following.val());
        if self.is_last.val() {
            self.there.next = 0.into();
        }
        self.last_lane.next = self.lane.q.val() == 8;
        self.other.next = !self.bank.q.val();
        self.is_near.next = self.plane.q.val() == 0;
        // x of planes 1 and 2, y of 3 and 4.
        self.axis.next = 0.into();
        if self.plane.q.val() > 2 {
            self.axis.next = 1.into();
        }
        self.crosses.next = (self.below.q.val().get_bit(self.here.val().index())
            && self.above.q.val().get_bit(self.there.val().index()))
            || (self.above.q.val().get_bit(self.here.val().index())
                && self.below.q.val().get_bit(self.there.val().index()));

        // Three lanes of 48 bits and six of 33.
        self.lane_3.next = bit_cast_to::<S<33>>(self.in_view.val().get_bit(3));
        self.lane_8.next = bit_cast_to::<S<33>>(self.in_view.val().get_bit(8));
        self.lane_01.next = self.in_view.val().get_bit(0);
        self.lane_23.next = self.in_view.val().get_bit(2);
        self.lane_45.next = bit_cast_to::<S<33>>(self.in_view.val().get_bit(4));
        self.lane_67.next = bit_cast_to::<S<33>>(self.in_view.val().get_bit(6));
        if self.lane.q.val().get_bit(0) {
            self.lane_01.next = self.in_view.val().get_bit(1);
            self.lane_23.next = bit_cast_to::<S<48>>(self.lane_3.val());
            self.lane_45.next = bit_cast_to::<S<33>>(self.in_view.val().get_bit(5));
            self.lane_67.next = bit_cast_to::<S<33>>(self.in_view.val().get_bit(7));
        }
        self.lane_03.next = self.lane_01.val();
        self.lane_47.next = self.lane_45.val();
        if self.lane.q.val().get_bit(1) {
            self.lane_03.next = self.lane_23.val();
            self.lane_47.next = self.lane_67.val();
        }
        self.lane_in.next = self.lane_03.val();
        if self.lane.q.val().get_bit(3) {
            self.lane_in.next = bit_cast_to::<S<48>>(self.lane_8.val());
        } else if self.lane.q.val().get_bit(2) {
            self.lane_in.next = bit_cast_to::<S<48>>(self.lane_47.val());
        }

        // Memories: read where the state says, and written from the beat, from the polygon or with a point.
        self.at.next = self.here.val();
        self.at_lane.next = self.lane.q.val();
        if self.state.q.val() == ClipState::Measure {
            self.at_lane.next = 2.into();
        } else if self.state.q.val() == ClipState::Fetch
            || self.state.q.val() == ClipState::Depth
            || self.state.q.val() == ClipState::Across
        {
            self.at_lane.next = self.axis.val();
        } else if self.state.q.val() == ClipState::ReadB {
            self.at.next = self.there.val();
        }
        self.memory.read_address.next = (bit_cast_to::<U<9>>(self.bank.q.val()) << 8)
            | (bit_cast_to::<U<9>>(self.at.val()) << 4)
            | bit_cast_to::<U<9>>(self.at_lane.val());
        self.memory.output_enable.next = true;
        self.memory.write_enable.next = false;
        self.memory.write_address.next = (bit_cast_to::<U<9>>(self.other.val()) << 8)
            | (bit_cast_to::<U<9>>(bit_cast_to::<U<4>>(self.next_vertices.q.val())) << 4)
            | bit_cast_to::<U<9>>(self.lane.q.val());
        self.memory.write_data.next = self.memory.read_data.val();
        if self.state.q.val() == ClipState::Mix {
            self.memory.write_data.next = self.between.value.val();
        } else if self.state.q.val() == ClipState::Load {
            self.memory.write_data.next = self.lane_in.val();
        }
        self.distances.read_address.next = self.here.val();
        if self.state.q.val() == ClipState::Near {
            self.distances.read_address.next = self.there.val();
        }
        self.distances.write_enable.next = self.state.q.val() == ClipState::Note;
        self.distances.write_address.next = self.here.val();
        self.distances.write_data.next = self.distance.q.val();
        self.size.next = bit_cast_to::<WideS<65>>(self.distances.read_data.val());
        if self.distances.read_data.val().get_bit(63) {
            self.size.next = -bit_cast_to::<WideS<65>>(self.distances.read_data.val());
        }

        self.multiplier.start.next = false;
        self.multiplier.factor.next = self.memory.read_data.val();
        self.multiplier.by.next = self.guard.val();
        if self.is_near.val() {
            self.multiplier.by.next = self.one.val();
        } else if self.state.q.val() == ClipState::Across {
            self.multiplier.by.next = self.focal.q.val();
        }
        if self.is_near.val() && self.state.q.val() == ClipState::Across {
            self.multiplier.factor.next = bit_cast_to::<S<48>>(self.z0.q.val());
        }
        self.between.start.next = self.state.q.val() == ClipState::Start;
        self.between.a.next = self.from.q.val();
        self.between.b.next = self.memory.read_data.val();
        self.between.p.next = self.near_size.q.val();
        self.between.q.next = self.span.q.val();

        self.taking.d.next = false;
        match self.state.q.val() {
            ClipState::Load => {
                self.memory.write_enable.next = self.in_valid.val();
                if self.in_valid.val() {
                    self.lane.d.next = self.lane.q.val() + 1;
                    if self.last_lane.val() {
                        self.lane.d.next = 0.into();
                        self.taking.d.next = true;
                        self.state.d.next = ClipState::Taken;
                    }
                }
            }
            ClipState::Taken => {
                // A source that takes its beat back begins again.
                self.state.d.next = ClipState::Load;
                self.z0.d.next = self.in_z0.val();
                self.focal.d.next = self.in_focal.val();
                if self.in_valid.val() {
                    self.next_vertices.d.next = self.next_vertices.q.val() + 1;
                    if self.next_vertices.q.val() == 2 {
                        self.vertices.d.next = 3.into();
                        self.bank.d.next = self.other.val();
                        self.state.d.next = ClipState::Measure;
                    }
                }
            }
            ClipState::Measure => {
                self.state.d.next = ClipState::Fetch;
            }
            ClipState::Fetch => {
                self.state.d.next = ClipState::Depth;
            }
            ClipState::Depth => {
                self.multiplier.start.next = true;
                self.state.d.next = ClipState::Across;
            }
            ClipState::Across => {
                if self.multiplier.done.val() {
                    self.depth.d.next = self.multiplier.product.val();
                    self.multiplier.start.next = true;
                    self.state.d.next = ClipState::Sum;
                }
            }
            ClipState::Sum => {
                if self.multiplier.done.val() {
                    self.distance.d.next = self.depth.q.val() - self.multiplier.product.val();
                    if self.plane.q.val().get_bit(0) {
                        self.distance.d.next = self.depth.q.val() + self.multiplier.product.val();
                    }
                    self.state.d.next = ClipState::Note;
                }
            }
            ClipState::Note => {
                self.below.d.next =
                    self.below.q.val().replace_bit(self.here.val().index(), self.distance.q.val().get_bit(63));
                self.above.d.next = self.above.q.val().replace_bit(
                    self.here.val().index(),
                    !self.distance.q.val().get_bit(63) && self.distance.q.val().any(),
                );
                self.vertex.d.next = self.following.val();
                self.state.d.next = ClipState::Measure;
                if self.is_last.val() {
                    self.vertex.d.next = 0.into();
                    self.state.d.next = ClipState::Decide;
                }
            }
            ClipState::Decide => {
                self.next_vertices.d.next = 0.into();
                self.state.d.next = ClipState::Plane;
                if self.below.q.val().any() {
                    self.state.d.next = ClipState::Keep;
                }
            }
            ClipState::Keep => {
                self.lane.d.next = 0.into();
                self.state.d.next = ClipState::CopyRead;
                if self.below.q.val().get_bit(self.here.val().index()) {
                    self.state.d.next = ClipState::Cross;
                }
            }
            ClipState::CopyRead => {
                self.state.d.next = ClipState::CopyFetch;
            }
            ClipState::CopyFetch => {
                self.state.d.next = ClipState::CopyWrite;
            }
            ClipState::CopyWrite => {
                self.memory.write_enable.next = self.room.val();
                self.lane.d.next = self.lane.q.val() + 1;
                self.state.d.next = ClipState::CopyRead;
                if self.last_lane.val() {
                    if self.room.val() {
                        self.next_vertices.d.next = self.next_vertices.q.val() + 1;
                    }
                    self.state.d.next = ClipState::Cross;
                }
            }
            ClipState::Cross => {
                self.lane.d.next = 0.into();
                self.state.d.next = ClipState::Advance;
                if self.crosses.val() {
                    self.state.d.next = ClipState::Near;
                }
            }
            ClipState::Near => {
                self.near_size.d.next = bit_cast_to::<WideU<64>>(self.size.val());
                self.state.d.next = ClipState::Far;
            }
            ClipState::Far => {
                self.far_size.d.next = bit_cast_to::<WideU<64>>(self.size.val());
                self.state.d.next = ClipState::Span;
            }
            ClipState::Span => {
                self.span.d.next =
                    bit_cast_to::<WideU<65>>(self.near_size.q.val()) + bit_cast_to::<WideU<65>>(self.far_size.q.val());
                self.state.d.next = ClipState::ReadA;
            }
            ClipState::ReadA => {
                self.state.d.next = ClipState::ReadB;
            }
            ClipState::ReadB => {
                self.state.d.next = ClipState::From;
            }
            ClipState::From => {
                self.from.d.next = self.memory.read_data.val();
                self.state.d.next = ClipState::Start;
            }
            ClipState::Start => {
                self.state.d.next = ClipState::Mix;
            }
            ClipState::Mix => {
                if self.between.done.val() {
                    self.memory.write_enable.next = self.room.val();
                    self.lane.d.next = self.lane.q.val() + 1;
                    self.state.d.next = ClipState::ReadA;
                    if self.last_lane.val() {
                        if self.room.val() {
                            self.next_vertices.d.next = self.next_vertices.q.val() + 1;
                        }
                        self.state.d.next = ClipState::Advance;
                    }
                }
            }
            ClipState::Advance => {
                self.vertex.d.next = self.following.val();
                self.state.d.next = ClipState::Keep;
                if self.is_last.val() {
                    self.vertex.d.next = 0.into();
                    self.bank.d.next = self.other.val();
                    self.vertices.d.next = self.next_vertices.q.val();
                    self.state.d.next = ClipState::Plane;
                }
            }
            ClipState::Plane => {
                self.below.d.next = 0.into();
                self.above.d.next = 0.into();
                self.next_vertices.d.next = 0.into();
                self.plane.d.next = self.plane.q.val() + 1;
                self.state.d.next = ClipState::Measure;
                if self.plane.q.val() == 4 || !self.vertices.q.val().any() {
                    self.plane.d.next = 0.into();
                    self.state.d.next = ClipState::Send;
                }
            }
            ClipState::Send => {
                self.lane.d.next = 0.into();
                self.kept.d.next = true;
                self.last.d.next = self.is_last.val();
                self.state.d.next = ClipState::SendRead;
                if self.vertices.q.val() < 3 {
                    self.kept.d.next = false;
                    self.last.d.next = true;
                    self.view.d.next = self.no_view.val();
                    self.sent.d.next = true;
                    self.state.d.next = ClipState::Wait;
                }
            }
            ClipState::SendRead => {
                self.state.d.next = ClipState::SendFetch;
            }
            ClipState::SendFetch => {
                self.state.d.next = ClipState::SendKeep;
            }
            ClipState::SendKeep => {
                self.lane.d.next = self.lane.q.val() + 1;
                self.state.d.next = ClipState::SendRead;
                if self.lane.q.val() == 0 {
                    self.view.d.next = self.view.q.val().replace_bit(0, self.memory.read_data.val());
                } else if self.lane.q.val() == 1 {
                    self.view.d.next = self.view.q.val().replace_bit(1, self.memory.read_data.val());
                } else if self.lane.q.val() == 2 {
                    self.view.d.next = self.view.q.val().replace_bit(2, self.memory.read_data.val());
                } else if self.lane.q.val() == 3 {
                    self.view.d.next = self.view.q.val().replace_bit(3, self.memory.read_data.val());
                } else if self.lane.q.val() == 4 {
                    self.view.d.next = self.view.q.val().replace_bit(4, self.memory.read_data.val());
                } else if self.lane.q.val() == 5 {
                    self.view.d.next = self.view.q.val().replace_bit(5, self.memory.read_data.val());
                } else if self.lane.q.val() == 6 {
                    self.view.d.next = self.view.q.val().replace_bit(6, self.memory.read_data.val());
                } else if self.lane.q.val() == 7 {
                    self.view.d.next = self.view.q.val().replace_bit(7, self.memory.read_data.val());
                } else {
                    self.view.d.next = self.view.q.val().replace_bit(8, self.memory.read_data.val());
                    self.sent.d.next = true;
                    self.state.d.next = ClipState::Wait;
                }
            }
            ClipState::Wait => {
                if self.out_ready.val() {
                    self.sent.d.next = false;
                    self.vertex.d.next = self.following.val();
                    self.state.d.next = ClipState::Send;
                    if self.last.q.val() {
                        self.vertex.d.next = 0.into();
                        self.lane.d.next = 0.into();
                        self.state.d.next = ClipState::Load;
                    }
                }
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("clip")
    }
}

ports! {
    [] Clip {
        inputs: in_valid, in_view, in_z0, in_focal, out_ready;
        outputs: in_ready, out_valid, out_view, out_kept, out_last;
        blocks: multiplier, between;
        state: state, taking, memory, distances, bank, plane, vertices, next_vertices, vertex, lane, z0, focal, depth, distance, below, above, near_size, far_size, span, from, multiplier, between, sent, view, kept, last
    }
}
