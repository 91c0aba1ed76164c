// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tessellates a height map by bisection: eight walkers, a triangle every second cycle.
//!
//! A triangle with midpoint m is split where `error[m] > base + ((slope * excess) >> 8)` (models::bisector)
//!
//! | port       | format      | meaning |   About two cycles a triangle, 32 before the first
//! | in_kind    | 2 bits      | 0 size, 1 sample, 2 draw   Golden: models::bisector::golden   Error 0
//! | in_width, in_height | unsigned C | 2 ..= 2^K + 1 | size
//! | in_levels  | unsigned 4  | lattice of N = 2^levels >= the larger side - 1; at most K | size
//! | in_mirrored | Bit        | roots on the other diagonal | size
//! | in_error   | unsigned E  | of a lattice vertex, (N + 1)^2 of them row by row | sample
//! | in_z       | UQ16.4      | its height, kept for those in the map | sample
//! | in_base, in_slope | unsigned E, UQ8.8 | bound at the eye, and its growth a half step | draw
//! | in_eye_u, in_eye_v | unsigned H | the eye, in half steps | draw
//! | out_left, out_right, out_new | 3 x signed 21 | u, v, z; the triangle (left, right, new) turns from u to v
//! | out_side   | Bit         | new takes the place of left (0) or of right (1) in its strip
//! | out_start  | Bit         | first of a strip
//! | out_walker | unsigned 3  | the walker; each makes strips of its own
//! | out_end    | Bit         | the draw is over; the beat has no triangle
//! | out_cycles | unsigned 32 | of the draw, but those in which the output stalled; 0 without `out_end`
//! | error      | Bit         | sticky: a size that cannot be (there is no map), a sample without a size or after the last
//! one (dropped), a draw before the last sample (ends without a triangle)
//!
//! Errors have to be saturated, or closed bits under a bound of 0: otherwise the mesh has T-vertices. It ends in any case.
//! Beats are taken when nothing is under way. Example: `size` 2 x 2, levels 0, four samples, `draw`: two triangles, an end.

mod corner;
mod excess;
mod half;
mod intake;
mod outlet;
mod plane;
mod queue;
mod strips;
mod vertices;
mod walk;

pub use corner::BisectorCorner;
pub use excess::BisectorExcess;
pub use half::BisectorHalf;
pub use intake::BisectorIntake;
pub use outlet::BisectorOutlet;
pub use plane::BisectorPlane;
pub use queue::BisectorQueue;
pub use strips::BisectorStrips;
pub use vertices::BisectorVertices;
pub use walk::BisectorWalk;

use crate::prelude::*;

/// Bisector for maps of sides up to 2^K + 1, K <= 12: C = K + 1, H = K + 2, A = 2 K - 2, errors of `E` <= 16 bits.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Bisector<const C: usize, const H: usize, const A: usize, const E: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_width: Input<U<C>>,
    pub in_height: Input<U<C>>,
    pub in_levels: Input<U<4>>,
    pub in_mirrored: Input<Bit>,
    pub in_error: Input<U<E>>,
    pub in_z: Input<U<20>>,
    pub in_base: Input<U<E>>,
    pub in_slope: Input<U<16>>,
    pub in_eye_u: Input<U<H>>,
    pub in_eye_v: Input<U<H>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_left: Output<Lanes<3, 21>>,
    pub out_right: Output<Lanes<3, 21>>,
    pub out_new: Output<Lanes<3, 21>>,
    pub out_side: Output<Bit>,
    pub out_start: Output<Bit>,
    pub out_walker: Output<U<3>>,
    pub out_end: Output<Bit>,
    pub out_cycles: Output<U<32>>,
    pub error: Output<Bit>,
    intake: BisectorIntake<C, H, E>,
    walk: BisectorWalk<C, H, A, E>,
    queue: BisectorQueue<H>,
    strips: BisectorStrips<C, H>,
    vertices: BisectorVertices<C, H, A>,
    outlet: BisectorOutlet,
    /// From a draw to its end.
    drawing: Register<Bit>,
    base: DataRegister<U<E>>,
    slope: DataRegister<U<16>>,
    eye_u: DataRegister<U<H>>,
    eye_v: DataRegister<U<H>>,
    /// The walkers are under way, or something behind them; or a draw has no map.
    running: Register<Bit>,
    blank: Register<Bit>,
    /// Nothing is left behind the walkers.
    drained: Register<Bit>,
    counting: Register<Bit>,
    cycles: DataRegister<U<32>>,
    /// What is before the vertices moves in this cycle, or stands: what leaves finds room. A register, as everything waits for it.
    moves: Register<Bit>,
    /// The walkers move, too: their queue has room, or had when everything moved last. These are for their memories, which lie
    /// all over the part; they differ where it does not count, or synthesis would make one of them.
    walks_0: Register<Bit>,
    walks_1: Register<Bit>,
    walks_2: Register<Bit>,
    walks_3: Register<Bit>,
    /// They do not; for everything else of theirs.
    rests: Register<Bit>,
    had_room: Register<Bit>,
    beat: Wire<Bit>,
    go: Wire<Bit>,
    ends: Wire<Bit>,
    room: Wire<Bit>,
    walks_on: Wire<Bit>,
}

impl<const C: usize, const H: usize, const A: usize, const E: usize> Default for Bisector<C, H, A, E> {
    fn default() -> Self {
        Self {
            drained: Register::new(true),
            moves: Register::new(true),
            walks_1: Register::new(true),
            walks_3: Register::new(true),
            had_room: Register::new(true),
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_width: Input::default(),
            in_height: Input::default(),
            in_levels: Input::default(),
            in_mirrored: Input::default(),
            in_error: Input::default(),
            in_z: Input::default(),
            in_base: Input::default(),
            in_slope: Input::default(),
            in_eye_u: Input::default(),
            in_eye_v: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_left: Output::default(),
            out_right: Output::default(),
            out_new: Output::default(),
            out_side: Output::default(),
            out_start: Output::default(),
            out_walker: Output::default(),
            out_end: Output::default(),
            out_cycles: Output::default(),
            error: Output::default(),
            intake: BisectorIntake::default(),
            walk: BisectorWalk::default(),
            queue: BisectorQueue::default(),
            strips: BisectorStrips::default(),
            vertices: BisectorVertices::default(),
            outlet: BisectorOutlet::default(),
            drawing: Register::default(),
            base: DataRegister::default(),
            slope: DataRegister::default(),
            eye_u: DataRegister::default(),
            eye_v: DataRegister::default(),
            running: Register::default(),
            blank: Register::default(),
            counting: Register::default(),
            cycles: DataRegister::default(),
            walks_0: Register::default(),
            walks_2: Register::default(),
            rests: Register::default(),
            beat: Wire::default(),
            go: Wire::default(),
            ends: Wire::default(),
            room: Wire::default(),
            walks_on: Wire::default(),
        }
    }
}

impl<const C: usize, const H: usize, const A: usize, const E: usize> Bisector<C, H, A, E> {
    /// Cycles from a draw to its first triangle.
    pub const LATENCY: usize = 32;
}

impl<const C: usize, const H: usize, const A: usize, const E: usize> Logic for Bisector<C, H, A, E> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, intake, walk, queue, strips, vertices, outlet);
        dff_setup!(self, clock, drawing, base, slope, eye_u, eye_v, running, blank, drained, counting);
        dff_setup!(self, clock, cycles, moves, walks_0, walks_1, walks_2, walks_3, rests, had_room);
        self.go.next = self.moves.q.val();
        self.in_ready.next = !self.drawing.q.val();
        self.out_valid.next = self.outlet.out_valid.val();
        self.out_left.next = self.outlet.out_left.val();
        self.out_right.next = self.outlet.out_right.val();
        self.out_new.next = self.outlet.out_new.val();
        self.out_side.next = self.outlet.out_side.val();
        self.out_start.next = self.outlet.out_start.val();
        self.out_walker.next = self.outlet.out_walker.val();
        self.out_end.next = self.outlet.out_end.val();
        // What the counter counts meanwhile is no payload.
        self.out_cycles.next = 0.into();
        if self.outlet.out_end.val() {
            self.out_cycles.next = self.cycles.q.val();
        }
        self.error.next = self.intake.failed.val();

        // Beats are taken one a cycle, but while a draw is under way: then everything behind the intake rests.
        self.beat.next = self.in_valid.val() && !self.drawing.q.val();
        self.intake.beat.next = self.beat.val();
        self.intake.kind.next = self.in_kind.val();
        self.intake.width.next = self.in_width.val();
        self.intake.height.next = self.in_height.val();
        self.intake.in_levels.next = self.in_levels.val();
        self.intake.in_mirrored.next = self.in_mirrored.val();
        self.intake.error.next = self.in_error.val();
        self.intake.z.next = self.in_z.val();
        if self.beat.val() && self.in_kind.val().get_bit(1) {
            self.base.d.next = self.in_base.val();
            self.slope.d.next = self.in_slope.val();
            self.eye_u.d.next = self.in_eye_u.val();
            self.eye_v.d.next = self.in_eye_v.val();
        }

        // Walkers, queue, strips and vertices.
        self.walk.go.next = !self.rests.q.val();
        self.walk.go_0.next = self.walks_0.q.val();
        self.walk.go_1.next = self.walks_1.q.val();
        self.walk.go_2.next = self.walks_2.q.val();
        self.walk.go_3.next = self.walks_3.q.val();
        self.walk.start.next = self.intake.draws.val();
        self.walk.levels.next = self.intake.levels.val();
        self.walk.side.next = self.intake.side.val();
        self.walk.mirrored.next = self.intake.mirrored.val();
        self.walk.rim_u.next = self.intake.rim_u.val();
        self.walk.rim_v.next = self.intake.rim_v.val();
        self.walk.base.next = self.base.q.val();
        self.walk.slope.next = self.slope.q.val();
        self.walk.eye_u.next = self.eye_u.q.val();
        self.walk.eye_v.next = self.eye_v.q.val();
        self.walk.write.next = self.intake.write.val();
        self.walk.write_u.next = self.intake.write_u.val();
        self.walk.write_v.next = self.intake.write_v.val();
        self.walk.write_data.next = self.intake.write_error.val();
        self.queue.go.next = self.go.val();
        self.queue.put.next = !self.rests.q.val() && self.walk.leaf.val();
        self.queue.put_u.next = self.walk.leaf_u.val();
        self.queue.put_v.next = self.walk.leaf_v.val();
        self.queue.put_shape.next = self.walk.leaf_shape.val();
        self.queue.put_walker.next = self.walk.leaf_walker.val();
        self.queue.take.next = self.strips.take.val();
        self.strips.go.next = self.go.val();
        self.strips.clear.next = self.walk.births.val();
        self.strips.clear_walker.next = self.walk.born_walker.val();
        self.strips.leaf.next = self.queue.valid.val();
        self.strips.u.next = self.queue.u.val();
        self.strips.v.next = self.queue.v.val();
        self.strips.shape.next = self.queue.shape.val();
        self.strips.walker.next = self.queue.walker.val();
        self.strips.rim_u.next = self.intake.rim_u.val();
        self.strips.rim_v.next = self.intake.rim_v.val();
        self.ends.next = (self.running.q.val() && self.walk.idle.val() && self.drained.q.val()) || self.blank.q.val();
        self.vertices.at_u.next = self.strips.vertex_u.val();
        self.vertices.at_v.next = self.strips.vertex_v.val();
        self.vertices.to_left.next = self.go.val() && self.strips.to_left.val();
        self.vertices.to_right.next = self.go.val() && self.strips.to_right.val();
        self.vertices.sends.next = self.go.val() && self.strips.sends.val();
        self.vertices.ends.next = self.go.val() && self.ends.val();
        self.vertices.side.next = self.strips.side.val();
        self.vertices.begins.next = self.strips.begins.val();
        self.vertices.walker.next = self.strips.of_walker.val();
        self.vertices.write.next = self.intake.write_z.val();
        self.vertices.write_u.next = self.intake.write_u.val();
        self.vertices.write_v.next = self.intake.write_v.val();
        self.vertices.write_data.next = self.intake.write_height.val();
        if self.go.val() {
            self.drained.d.next = self.queue.empty.val() && !self.strips.busy.val();
            if self.counting.q.val() {
                self.cycles.d.next = self.cycles.q.val() + 1;
            }
            if self.ends.val() {
                self.running.d.next = false;
                self.blank.d.next = false;
                self.counting.d.next = false;
            }
        }
        if self.intake.draws.val() {
            self.running.d.next = true;
        }
        if self.intake.blank.val() {
            self.blank.d.next = true;
        }
        if self.beat.val() && self.in_kind.val().get_bit(1) {
            self.drawing.d.next = true;
            self.counting.d.next = true;
            self.cycles.d.next = 0.into();
        }

        // What the walkers do depends on nothing that stands.
        self.room.next = self.had_room.q.val();
        if self.go.val() {
            self.room.next = self.queue.room.val();
        }
        self.had_room.d.next = self.room.val();
        self.walks_on.next = self.outlet.room.val() && self.room.val();
        self.moves.d.next = self.outlet.room.val();
        self.walks_0.d.next = self.walks_on.val();
        self.walks_1.d.next = self.walks_on.val();
        self.walks_2.d.next = self.walks_on.val() || !self.drawing.q.val();
        self.walks_3.d.next = self.walks_on.val() || !self.drawing.q.val();
        self.rests.d.next = !self.walks_on.val();
        self.outlet.put.next = self.vertices.sent.val();
        self.outlet.ends.next = self.vertices.ended.val();
        self.outlet.left.next = self.vertices.left.val();
        self.outlet.right.next = self.vertices.right.val();
        self.outlet.fresh.next = self.vertices.fresh.val();
        self.outlet.side.next = self.vertices.of_side.val();
        self.outlet.begins.next = self.vertices.of_begin.val();
        self.outlet.walker.next = self.vertices.of_walker.val();
        self.outlet.out_ready.next = self.out_ready.val();
        if self.outlet.out_valid.val() && self.outlet.out_end.val() && self.out_ready.val() {
            self.drawing.d.next = false;
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector")
    }
}

ports! {
    [const C: usize, const H: usize, const A: usize, const E: usize] Bisector<C, H, A, E> {
        inputs: in_valid, in_kind, in_width, in_height, in_levels, in_mirrored, in_error, in_z, in_base, in_slope, in_eye_u, in_eye_v, out_ready;
        outputs: in_ready, out_valid, out_left, out_right, out_new, out_side, out_start, out_walker, out_end, out_cycles, error;
        blocks: intake, walk, queue, strips, vertices, outlet;
        state: intake, walk, queue, strips, vertices, outlet, drawing, base, slope, eye_u, eye_v, running, blank, drained, counting, cycles, moves, walks_0, walks_1, walks_2, walks_3, rests, had_room
    }
}
