// SPDX-License-Identifier: MIT OR Apache-2.0
//! Counters of a draw: 32 bits each, which stop at the largest number.
//!
//! | port  | meaning |   Golden: models::displacement_pipeline::Machine, but for the cycles
//! | clear | all counters become 0
//! | index | the counter that is read: 0 .. 20 of what came, 21 which of 8 .. 10 and 15 .. 17 are not 0, 24 .. 30 of cycles; the others are 0
//! | read  | it becomes the value, which stays
//! | value | a cycle later
//! | others | one more of them; with `two_*` two

use crate::prelude::*;

/// One counter.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Counter {
    pub clock: Input<ClockReset>,
    pub clear: Input<Bit>,
    pub adds: Input<Bit>,
    pub count: Output<U<32>>,
    held: Register<U<32>>,
}

impl Logic for Counter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, held);
        self.count.next = self.held.q.val();
        if self.clear.val() {
            self.held.d.next = 0.into();
        } else if self.adds.val() && !self.held.q.val().all() {
            self.held.d.next = self.held.q.val() + 1;
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("counter")
    }
}

latches! { [] Counter: held }

/// A counter of what may come twice in a cycle.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct PairCounter {
    pub clock: Input<ClockReset>,
    pub clear: Input<Bit>,
    pub adds: Input<Bit>,
    /// It adds two.
    pub twice: Input<Bit>,
    pub count: Output<U<32>>,
    held: Register<U<32>>,
    step: Wire<U<32>>,
}

impl Logic for PairCounter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, held);
        self.count.next = self.held.q.val();
        self.step.next = 1.into();
        if self.twice.val() && !self.held.q.val().get_bits::<31>(1).all() {
            self.step.next = 2.into();
        }
        if self.clear.val() {
            self.held.d.next = 0.into();
        } else if self.adds.val() && !self.held.q.val().all() {
            self.held.d.next = self.held.q.val() + self.step.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("pair_counter")
    }
}

latches! { [] PairCounter: held }

/// All counters.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Counters {
    pub clock: Input<ClockReset>,
    pub clear: Input<Bit>,
    pub index: Input<U<7>>,
    pub read: Input<Bit>,
    pub value: Output<U<32>>,
    pub bases: Input<Bit>,
    pub left: Input<Bit>,
    pub right: Input<Bit>,
    pub top: Input<Bit>,
    pub bottom: Input<Bit>,
    pub near_side: Input<Bit>,
    pub far_side: Input<Bit>,
    pub cut: Input<Bit>,
    pub near: Input<Bit>,
    pub lane: Input<Bit>,
    pub grid: Input<Bit>,
    pub pieces: Input<Bit>,
    pub steps: Input<Bit>,
    pub vertices: Input<Bit>,
    pub triangles: Input<Bit>,
    pub two_triangles: Input<Bit>,
    pub invalid: Input<Bit>,
    pub two_invalid: Input<Bit>,
    pub too_near: Input<Bit>,
    pub two_too_near: Input<Bit>,
    pub beyond: Input<Bit>,
    pub two_beyond: Input<Bit>,
    pub off: Input<Bit>,
    pub two_off: Input<Bit>,
    pub sent: Input<Bit>,
    pub skipped: Input<Bit>,
    pub cycles: Input<Bit>,
    pub piece_waits: Input<Bit>,
    pub silent: Input<Bit>,
    pub lacks_room: Input<Bit>,
    pub sends_second: Input<Bit>,
    pub strip_waits: Input<Bit>,
    pub out_waits: Input<Bit>,
    bases_count: Counter,
    left_count: Counter,
    right_count: Counter,
    top_count: Counter,
    bottom_count: Counter,
    near_side_count: Counter,
    far_side_count: Counter,
    cut_count: Counter,
    near_count: Counter,
    lane_count: Counter,
    grid_count: Counter,
    pieces_count: Counter,
    steps_count: Counter,
    vertices_count: Counter,
    triangles_count: PairCounter,
    invalid_count: PairCounter,
    too_near_count: PairCounter,
    beyond_count: PairCounter,
    off_count: PairCounter,
    sent_count: Counter,
    skipped_count: Counter,
    cycles_count: Counter,
    piece_waits_count: Counter,
    silent_count: Counter,
    lacks_room_count: Counter,
    sends_second_count: Counter,
    strip_waits_count: Counter,
    out_waits_count: Counter,
    held: Register<U<32>>,
    lost: Wire<U<32>>,
    chosen: Wire<U<32>>,
}

impl Logic for Counters {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self,
            clock,
            bases_count,
            left_count,
            right_count,
            top_count,
            bottom_count,
            near_side_count,
            far_side_count
        );
        clock!(self, clock, cut_count, near_count, lane_count, grid_count, pieces_count, steps_count, vertices_count);
        clock!(
            self,
            clock,
            triangles_count,
            invalid_count,
            too_near_count,
            beyond_count,
            off_count,
            sent_count,
            cycles_count
        );
        clock!(
            self,
            clock,
            piece_waits_count,
            silent_count,
            lacks_room_count,
            sends_second_count,
            strip_waits_count,
            out_waits_count,
            skipped_count
        );
        dff_setup!(self, clock, held);
        self.value.next = self.held.q.val();
        self.bases_count.clear.next = self.clear.val();
        self.bases_count.adds.next = self.bases.val();
        self.left_count.clear.next = self.clear.val();
        self.left_count.adds.next = self.left.val();
        self.right_count.clear.next = self.clear.val();
        self.right_count.adds.next = self.right.val();
        self.top_count.clear.next = self.clear.val();
        self.top_count.adds.next = self.top.val();
        self.bottom_count.clear.next = self.clear.val();
        self.bottom_count.adds.next = self.bottom.val();
        self.near_side_count.clear.next = self.clear.val();
        self.near_side_count.adds.next = self.near_side.val();
        self.far_side_count.clear.next = self.clear.val();
        self.far_side_count.adds.next = self.far_side.val();
        self.cut_count.clear.next = self.clear.val();
        self.cut_count.adds.next = self.cut.val();
        self.near_count.clear.next = self.clear.val();
        self.near_count.adds.next = self.near.val();
        self.lane_count.clear.next = self.clear.val();
        self.lane_count.adds.next = self.lane.val();
        self.grid_count.clear.next = self.clear.val();
        self.grid_count.adds.next = self.grid.val();
        self.pieces_count.clear.next = self.clear.val();
        self.pieces_count.adds.next = self.pieces.val();
        self.steps_count.clear.next = self.clear.val();
        self.steps_count.adds.next = self.steps.val();
        self.vertices_count.clear.next = self.clear.val();
        self.vertices_count.adds.next = self.vertices.val();
        self.triangles_count.clear.next = self.clear.val();
        self.triangles_count.adds.next = self.triangles.val();
        self.triangles_count.twice.next = self.two_triangles.val();
        self.invalid_count.clear.next = self.clear.val();
        self.invalid_count.adds.next = self.invalid.val();
        self.invalid_count.twice.next = self.two_invalid.val();
        self.too_near_count.clear.next = self.clear.val();
        self.too_near_count.adds.next = self.too_near.val();
        self.too_near_count.twice.next = self.two_too_near.val();
        self.beyond_count.clear.next = self.clear.val();
        self.beyond_count.adds.next = self.beyond.val();
        self.beyond_count.twice.next = self.two_beyond.val();
        self.off_count.clear.next = self.clear.val();
        self.off_count.adds.next = self.off.val();
        self.off_count.twice.next = self.two_off.val();
        self.sent_count.clear.next = self.clear.val();
        self.sent_count.adds.next = self.sent.val();
        self.skipped_count.clear.next = self.clear.val();
        self.skipped_count.adds.next = self.skipped.val();
        self.cycles_count.clear.next = self.clear.val();
        self.cycles_count.adds.next = self.cycles.val();
        self.piece_waits_count.clear.next = self.clear.val();
        self.piece_waits_count.adds.next = self.piece_waits.val();
        self.silent_count.clear.next = self.clear.val();
        self.silent_count.adds.next = self.silent.val();
        self.lacks_room_count.clear.next = self.clear.val();
        self.lacks_room_count.adds.next = self.lacks_room.val();
        self.sends_second_count.clear.next = self.clear.val();
        self.sends_second_count.adds.next = self.sends_second.val();
        self.strip_waits_count.clear.next = self.clear.val();
        self.strip_waits_count.adds.next = self.strip_waits.val();
        self.out_waits_count.clear.next = self.clear.val();
        self.out_waits_count.adds.next = self.out_waits.val();
        // A bit for each reason to drop a base triangle or a triangle: it stays until the next draw.
        self.lost.next = bit_cast_to::<U<32>>(self.near_count.count.val().any())
            | (bit_cast_to::<U<32>>(self.lane_count.count.val().any()) << 1)
            | (bit_cast_to::<U<32>>(self.grid_count.count.val().any()) << 2)
            | (bit_cast_to::<U<32>>(self.invalid_count.count.val().any()) << 3)
            | (bit_cast_to::<U<32>>(self.too_near_count.count.val().any()) << 4)
            | (bit_cast_to::<U<32>>(self.beyond_count.count.val().any()) << 5);
        self.chosen.next = 0.into();
        if self.index.val() == 0 {
            self.chosen.next = self.bases_count.count.val();
        } else if self.index.val() == 1 {
            self.chosen.next = self.left_count.count.val();
        } else if self.index.val() == 2 {
            self.chosen.next = self.right_count.count.val();
        } else if self.index.val() == 3 {
            self.chosen.next = self.top_count.count.val();
        } else if self.index.val() == 4 {
            self.chosen.next = self.bottom_count.count.val();
        } else if self.index.val() == 5 {
            self.chosen.next = self.near_side_count.count.val();
        } else if self.index.val() == 6 {
            self.chosen.next = self.far_side_count.count.val();
        } else if self.index.val() == 7 {
            self.chosen.next = self.cut_count.count.val();
        } else if self.index.val() == 8 {
            self.chosen.next = self.near_count.count.val();
        } else if self.index.val() == 9 {
            self.chosen.next = self.lane_count.count.val();
        } else if self.index.val() == 10 {
            self.chosen.next = self.grid_count.count.val();
        } else if self.index.val() == 11 {
            self.chosen.next = self.pieces_count.count.val();
        } else if self.index.val() == 12 {
            self.chosen.next = self.steps_count.count.val();
        } else if self.index.val() == 13 {
            self.chosen.next = self.vertices_count.count.val();
        } else if self.index.val() == 14 {
            self.chosen.next = self.triangles_count.count.val();
        } else if self.index.val() == 15 {
            self.chosen.next = self.invalid_count.count.val();
        } else if self.index.val() == 16 {
            self.chosen.next = self.too_near_count.count.val();
        } else if self.index.val() == 17 {
            self.chosen.next = self.beyond_count.count.val();
        } else if self.index.val() == 18 {
            self.chosen.next = self.off_count.count.val();
        } else if self.index.val() == 19 {
            self.chosen.next = self.sent_count.count.val();
        } else if self.index.val() == 20 {
            self.chosen.next = self.skipped_count.count.val();
        } else if self.index.val() == 21 {
            self.chosen.next = self.lost.val();
        } else if self.index.val() == 24 {
            self.chosen.next = self.cycles_count.count.val();
        } else if self.index.val() == 25 {
            self.chosen.next = self.piece_waits_count.count.val();
        } else if self.index.val() == 26 {
            self.chosen.next = self.silent_count.count.val();
        } else if self.index.val() == 27 {
            self.chosen.next = self.lacks_room_count.count.val();
        } else if self.index.val() == 28 {
            self.chosen.next = self.sends_second_count.count.val();
        } else if self.index.val() == 29 {
            self.chosen.next = self.strip_waits_count.count.val();
        } else if self.index.val() == 30 {
            self.chosen.next = self.out_waits_count.count.val();
        }
        if self.read.val() {
            self.held.d.next = self.chosen.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("counters")
    }
}

watched! { [] Counters: clear, index, read, bases, left, right, top, bottom, near_side, far_side, cut, near, lane, grid, pieces, steps, vertices, triangles, two_triangles, invalid, two_invalid, too_near, two_too_near, beyond, two_beyond, off, two_off, sent, skipped, cycles, piece_waits, silent, lacks_room, sends_second, strip_waits, out_waits; bases_count, left_count, right_count, top_count, bottom_count, near_side_count, far_side_count, cut_count, near_count, lane_count, grid_count, pieces_count, steps_count, vertices_count, triangles_count, invalid_count, too_near_count, beyond_count, off_count, sent_count, skipped_count, cycles_count, piece_waits_count, silent_count, lacks_room_count, sends_second_count, strip_waits_count, out_waits_count; bases_count, left_count, right_count, top_count, bottom_count, near_side_count, far_side_count, cut_count, near_count, lane_count, grid_count, pieces_count, steps_count, vertices_count, triangles_count, invalid_count, too_near_count, beyond_count, off_count, sent_count, skipped_count, cycles_count, piece_waits_count, silent_count, lacks_room_count, sends_second_count, strip_waits_count, out_waits_count, held }
