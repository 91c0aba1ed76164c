// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tessellates a height map by bisection: two walkers, a triangle every second cycle.
//!
//! A triangle with midpoint m is split where `error[m] > base + ((slope * excess) >> 8)` (models::bisector)
//!
//! | port       | format      | meaning |   About two cycles a triangle, 11 before the first
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
//! | out_start, out_walker | Bit | first of a strip; the walker, each makes strips of its own
//! | out_end    | Bit         | the draw is over; the beat has no triangle
//! | out_cycles | unsigned 32 | of the draw, but those in which the output stalled; with `out_end`
//! | error      | Bit         | sticky: a size that cannot be (there is no map), a sample without a size or after the last
//! one (dropped), a draw before the last sample (ends without a triangle)
//!
//! Errors have to be saturated, or closed bits under a bound of 0: otherwise the mesh has T-vertices. It ends in any case.
//! Beats are taken when nothing is under way. Example: `size` 2 x 2, levels 0, four samples, `draw`: two triangles, an end.

mod corner;
mod excess;
mod half;
mod strips;
mod vertices;
mod walk;

pub use corner::BisectorCorner;
pub use excess::BisectorExcess;
pub use half::BisectorHalf;
pub use strips::BisectorStrips;
pub use vertices::BisectorVertices;
pub use walk::BisectorWalk;

use crate::prelude::*;

/// Bisector for maps of sides up to 2^K + 1, K <= 12: C = K + 1, H = K + 2, A = 2 K + 1, errors of `E` <= 16 bits.
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
    pub out_walker: Output<Bit>,
    pub out_end: Output<Bit>,
    pub out_cycles: Output<U<32>>,
    pub error: Output<Bit>,
    walk: BisectorWalk<H, A, E>,
    strips: BisectorStrips<C, H>,
    vertices: BisectorVertices<C, A>,
    // The map: its last column and row, in half steps, and those of the lattice, in steps.
    sized: Register<Bit>,
    complete: Register<Bit>,
    rim_u: DataRegister<U<H>>,
    rim_v: DataRegister<U<H>>,
    levels: DataRegister<U<4>>,
    mirrored: DataRegister<Bit>,
    last: DataRegister<U<C>>,
    /// The next sample, its address and that of its row.
    cursor_u: DataRegister<U<C>>,
    cursor_v: DataRegister<U<C>>,
    cursor_address: DataRegister<U<A>>,
    row_address: DataRegister<U<A>>,
    base: DataRegister<U<E>>,
    slope: DataRegister<U<16>>,
    eye_u: DataRegister<U<H>>,
    eye_v: DataRegister<U<H>>,
    starting: Register<Bit>,
    drawing: Register<Bit>,
    cycles: DataRegister<U<32>>,
    failed: Register<Bit>,
    pitch: Constant<U<A>>,
    most: Constant<U<4>>,
    go: Wire<Bit>,
    beat: Wire<Bit>,
    wide: Wire<U<H>>,
    tall: Wire<U<H>>,
    one: Wire<U<C>>,
    side: Wire<U<C>>,
    sound: Wire<Bit>,
    stores: Wire<Bit>,
    in_map: Wire<Bit>,
    ends: Wire<Bit>,
}

impl<const C: usize, const H: usize, const A: usize, const E: usize> Default for Bisector<C, H, A, E> {
    fn default() -> Self {
        Self {
            pitch: Constant::new(U::new((1 << (C - 1)) + 1)),
            most: Constant::new(U::new(C as i64 - 1)),
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
            walk: BisectorWalk::default(),
            strips: BisectorStrips::default(),
            vertices: BisectorVertices::default(),
            sized: Register::default(),
            complete: Register::default(),
            rim_u: DataRegister::default(),
            rim_v: DataRegister::default(),
            levels: DataRegister::default(),
            mirrored: DataRegister::default(),
            last: DataRegister::default(),
            cursor_u: DataRegister::default(),
            cursor_v: DataRegister::default(),
            cursor_address: DataRegister::default(),
            row_address: DataRegister::default(),
            base: DataRegister::default(),
            slope: DataRegister::default(),
            eye_u: DataRegister::default(),
            eye_v: DataRegister::default(),
            starting: Register::default(),
            drawing: Register::default(),
            cycles: DataRegister::default(),
            failed: Register::default(),
            go: Wire::default(),
            beat: Wire::default(),
            wide: Wire::default(),
            tall: Wire::default(),
            one: Wire::default(),
            side: Wire::default(),
            sound: Wire::default(),
            stores: Wire::default(),
            in_map: Wire::default(),
            ends: Wire::default(),
        }
    }
}

impl<const C: usize, const H: usize, const A: usize, const E: usize> Bisector<C, H, A, E> {
    /// Cycles from a draw to its first triangle.
    pub const LATENCY: usize = 11;
}

impl<const C: usize, const H: usize, const A: usize, const E: usize> Logic for Bisector<C, H, A, E> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, walk, strips, vertices);
        dff_setup!(self, clock, sized, complete, rim_u, rim_v, levels, mirrored, last, cursor_u, cursor_v);
        dff_setup!(self, clock, cursor_address, row_address, base, slope, eye_u, eye_v, starting, drawing, cycles);
        dff_setup!(self, clock, failed);
        // Everything moves, or stands.
        self.go.next = !self.vertices.triangle.val() || self.out_ready.val();
        self.in_ready.next = !self.drawing.q.val() && !self.vertices.busy.val();
        self.beat.next = self.in_valid.val() && !self.drawing.q.val() && !self.vertices.busy.val();
        self.out_valid.next = self.vertices.triangle.val();
        self.out_left.next = self.vertices.left.val();
        self.out_right.next = self.vertices.right.val();
        self.out_new.next = self.vertices.fresh.val();
        self.out_side.next = self.vertices.of_side.val();
        self.out_start.next = self.vertices.of_begin.val();
        self.out_walker.next = self.vertices.of_walker.val();
        self.out_end.next = self.vertices.ended.val();
        self.out_cycles.next = self.cycles.q.val();
        self.error.next = self.failed.q.val();

        // A size: both sides fit the lattice, and the lattice the memories.
        self.wide.next = bit_cast_to::<U<H>>(self.in_width.val()) - 1;
        self.tall.next = bit_cast_to::<U<H>>(self.in_height.val()) - 1;
        self.one.next = 1.into();
        self.side.next = self.one.val() << self.in_levels.val();
        self.sound.next = self.in_width.val() >= 2
            && self.in_height.val() >= 2
            && self.in_levels.val() <= self.most.val()
            && self.wide.val() <= bit_cast_to::<U<H>>(self.side.val())
            && self.tall.val() <= bit_cast_to::<U<H>>(self.side.val());
        if self.beat.val() && self.in_kind.val() == 0 {
            self.sized.d.next = self.sound.val();
            self.complete.d.next = false;
            self.rim_u.d.next = self.wide.val() << 1;
            self.rim_v.d.next = self.tall.val() << 1;
            self.levels.d.next = self.in_levels.val();
            self.mirrored.d.next = self.in_mirrored.val();
            self.last.d.next = self.side.val();
            self.cursor_u.d.next = 0.into();
            self.cursor_v.d.next = 0.into();
            self.cursor_address.d.next = 0.into();
            self.row_address.d.next = 0.into();
            if !self.sound.val() {
                self.failed.d.next = true;
            }
        }

        // A sample.
        self.stores.next = self.beat.val() && self.in_kind.val() == 1 && self.sized.q.val() && !self.complete.q.val();
        self.in_map.next = (bit_cast_to::<U<H>>(self.cursor_u.q.val()) << 1) <= self.rim_u.q.val()
            && (bit_cast_to::<U<H>>(self.cursor_v.q.val()) << 1) <= self.rim_v.q.val();
        self.walk.write.next = self.stores.val();
        self.walk.write_address.next = self.cursor_address.q.val();
        self.walk.write_data.next = self.in_error.val();
        self.vertices.write.next = self.stores.val() && self.in_map.val();
        self.vertices.write_address.next = self.cursor_address.q.val();
        self.vertices.write_data.next = self.in_z.val();
        if self.stores.val() {
            self.cursor_u.d.next = self.cursor_u.q.val() + 1;
            self.cursor_address.d.next = self.cursor_address.q.val() + 1;
            if self.cursor_u.q.val() == self.last.q.val() {
                self.cursor_u.d.next = 0.into();
                self.cursor_v.d.next = self.cursor_v.q.val() + 1;
                self.cursor_address.d.next = self.row_address.q.val() + self.pitch.val();
                self.row_address.d.next = self.row_address.q.val() + self.pitch.val();
                if self.cursor_v.q.val() == self.last.q.val() {
                    self.complete.d.next = true;
                }
            }
        }
        if self.beat.val() && self.in_kind.val() == 1 && !self.stores.val() {
            self.failed.d.next = true;
        }

        // A draw. The walkers start a cycle later, when the bound stands; without a map they do not, and it ends at once.
        self.starting.d.next = self.beat.val() && self.in_kind.val() >= 2 && self.complete.q.val();
        if self.beat.val() && self.in_kind.val() >= 2 {
            self.base.d.next = self.in_base.val();
            self.slope.d.next = self.in_slope.val();
            self.eye_u.d.next = self.in_eye_u.val();
            self.eye_v.d.next = self.in_eye_v.val();
            self.drawing.d.next = true;
            if !self.complete.q.val() {
                self.failed.d.next = true;
            }
        }
        if self.beat.val() {
            self.cycles.d.next = 0.into();
        } else if self.drawing.q.val() && self.go.val() {
            self.cycles.d.next = self.cycles.q.val() + 1;
        }
        self.ends.next = self.drawing.q.val()
            && !self.starting.q.val()
            && self.go.val()
            && self.walk.idle.val()
            && !self.strips.busy.val();
        if self.ends.val() {
            self.drawing.d.next = false;
        }

        self.walk.start.next = self.starting.q.val();
        self.walk.go.next = self.go.val() && !self.strips.waits.val();
        self.walk.levels.next = self.levels.q.val();
        self.walk.mirrored.next = self.mirrored.q.val();
        self.walk.rim_u.next = self.rim_u.q.val();
        self.walk.rim_v.next = self.rim_v.q.val();
        self.walk.base.next = self.base.q.val();
        self.walk.slope.next = self.slope.q.val();
        self.walk.eye_u.next = self.eye_u.q.val();
        self.walk.eye_v.next = self.eye_v.q.val();
        self.strips.go.next = self.go.val();
        self.strips.clear.next = self.starting.q.val();
        self.strips.leaf.next = self.walk.leaf.val();
        self.strips.u.next = self.walk.leaf_u.val();
        self.strips.v.next = self.walk.leaf_v.val();
        self.strips.level.next = self.walk.leaf_level.val();
        self.strips.direction.next = self.walk.leaf_direction.val();
        self.strips.enters_long.next = self.walk.leaf_enters_long.val();
        self.strips.leaves_long.next = self.walk.leaf_leaves_long.val();
        self.strips.walker.next = self.walk.leaf_walker.val();
        self.strips.rim_u.next = self.rim_u.q.val();
        self.strips.rim_v.next = self.rim_v.q.val();
        self.vertices.go.next = self.go.val();
        self.vertices.vertex.next = self.strips.vertex.val();
        self.vertices.ends.next = self.ends.val();
        self.vertices.at_u.next = self.strips.vertex_u.val();
        self.vertices.at_v.next = self.strips.vertex_v.val();
        self.vertices.role.next = self.strips.role.val();
        self.vertices.side.next = self.strips.side.val();
        self.vertices.begins.next = self.strips.begins.val();
        self.vertices.walker.next = self.strips.of_walker.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector")
    }
}

ports! {
    [const C: usize, const H: usize, const A: usize, const E: usize] Bisector<C, H, A, E> {
        inputs: in_valid, in_kind, in_width, in_height, in_levels, in_mirrored, in_error, in_z, in_base, in_slope, in_eye_u,
            in_eye_v, out_ready;
        outputs: in_ready, out_valid, out_left, out_right, out_new, out_side, out_start, out_walker, out_end, out_cycles,
            error;
        blocks: walk, strips, vertices;
        state: walk, strips, vertices, sized, complete, rim_u, rim_v, levels, mirrored, last, cursor_u, cursor_v, cursor_address, row_address, base, slope, eye_u, eye_v, starting, drawing, cycles, failed
    }
}
