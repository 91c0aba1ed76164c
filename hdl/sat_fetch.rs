// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sum of a rectangle from four entries of a summed-area table in one memory, four cycles a result (Crow 1984).
//!
//! ```text
//! sum = SAT[y+b][x+a] - SAT[y+b][x] - SAT[y][x+a] + SAT[y][x]  mod 2^B     clamp: cut at the border
//! word(x, y) = (y - 1) * width + x - 1                                     slide: moved inside
//! ```
//!
//! | port       | format      | meaning |   Latency 18, interval 4, 1 for loads and sizes
//! | in_kind    | 2 bits      | 0 size of a map, 1 load of an entry, 2 or 3 fetch   Golden: models::sat_fetch::SatFetch
//! | in_width, in_height | unsigned M | of the map, at least one | size   Error 0
//! | in_slide   | Bit         | rectangles slide into the map; otherwise they are cut | size
//! | in_x, in_y | signed M + 2 | corner of the rectangle, or column and row of the entry, 1 ..= side | fetch, load
//! | in_a, in_b | unsigned M  | columns and rows of the rectangle | fetch
//! | in_sum     | B bits      | the entry | load
//! | out_sum    | B bits      | exact unless the area is an error
//! | out_area   | unsigned 2 M | texels really summed
//! | error      | Bit         | sticky: a size of nothing (forgotten), a load of no entry or beyond the memory (not
//! stored), a fetch before a size (0), of entries beyond the memory (they count 0), or of area * 65535 >= 2^B
//!
//! Example: in the map (1, 2; 3, 4) the rectangle at (1, 0), 2 x 2: cut 6 of 2 texels, slid 10 of 4. An entry never
//! loaded reads as anything.

mod corners;
mod span;

pub use corners::SatCorners;
pub use span::SatSpan;

use crate::prelude::*;

/// Fetch from maps with sides of `M` bits, M <= 13, in 2^T sums of `B` bits, T <= 27; `X` = M + 2, `R` = 2 M.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct SatFetch<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_x: Input<S<X>>,
    pub in_y: Input<S<X>>,
    pub in_a: Input<U<M>>,
    pub in_b: Input<U<M>>,
    pub in_sum: Input<U<B>>,
    pub in_width: Input<U<M>>,
    pub in_height: Input<U<M>>,
    pub in_slide: Input<Bit>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_sum: Output<U<B>>,
    pub out_area: Output<U<R>>,
    pub error: Output<Bit>,
    corners: SatCorners<M, X, R, T, B>,
    /// Entry of the rectangle that is read.
    phase: Register<U<2>>,
    s11_sends: Register<Bit>,
    s11_load: Register<Bit>,
    s11_fails: Register<Bit>,
    s11_phase: DataRegister<U<2>>,
    s11_zero: DataRegister<Bit>,
    s11_word: DataRegister<U<T>>,
    s11_value: DataRegister<U<B>>,
    s11_area: DataRegister<U<R>>,
    s12_table: Ram<U<B>, T>,
    s12_sends: Register<Bit>,
    s12_fails: Register<Bit>,
    s12_phase: DataRegister<U<2>>,
    s12_zero: DataRegister<Bit>,
    s12_area: DataRegister<U<R>>,
    s13_sends: Register<Bit>,
    s13_fails: Register<Bit>,
    s13_phase: DataRegister<U<2>>,
    s13_zero: DataRegister<Bit>,
    s13_read: DataRegister<U<B>>,
    s13_area: DataRegister<U<R>>,
    s14_sends: Register<Bit>,
    s14_fails: Register<Bit>,
    s14_phase: DataRegister<U<2>>,
    s14_entry: DataRegister<U<B>>,
    s14_area: DataRegister<U<R>>,
    s15_sends: Register<Bit>,
    s15_sum: DataRegister<U<B>>,
    s15_area: DataRegister<U<R>>,
    failed: Register<Bit>,
    moves: Wire<Bit>,
    go: Wire<Bit>,
    word: Wire<U<T>>,
    zero: Wire<Bit>,
    entry: Wire<U<B>>,
}

impl<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> SatFetch<M, X, R, T, B> {
    /// Cycles from a fetch to its sum.
    pub const LATENCY: usize = 18;
    /// Cycles between two fetches.
    pub const INTERVAL: usize = 4;
}

impl<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> Logic for SatFetch<M, X, R, T, B> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, corners, s12_table);
        dff_setup!(self, clock, phase, s11_sends, s11_load, s11_fails, s11_phase, s11_zero, s11_word, s11_value);
        dff_setup!(self, clock, s11_area, s12_sends, s12_fails, s12_phase, s12_zero, s12_area, s13_sends, s13_fails);
        dff_setup!(self, clock, s13_phase, s13_zero, s13_read, s13_area, s14_sends, s14_fails, s14_phase, s14_entry);
        dff_setup!(self, clock, s14_area, s15_sends, s15_sum, s15_area, failed);

        // The table's side stands while the result is not taken, and the corners until their fourth entry is read.
        self.moves.next = !self.s15_sends.q.val() || self.out_ready.val();
        self.go.next = self.moves.val() && (!self.corners.fetch.val() || self.phase.q.val() == 3);
        self.in_ready.next = self.go.val();
        self.out_valid.next = self.s15_sends.q.val();
        self.out_sum.next = self.s15_sum.q.val();
        self.out_area.next = self.s15_area.q.val();
        self.error.next = self.failed.q.val();

        // s1_beat to s10_inside
        self.corners.go.next = self.go.val();
        self.corners.valid.next = self.in_valid.val();
        self.corners.kind.next = self.in_kind.val();
        self.corners.width.next = self.in_width.val();
        self.corners.height.next = self.in_height.val();
        self.corners.slide.next = self.in_slide.val();
        self.corners.corner_x.next = self.in_x.val();
        self.corners.corner_y.next = self.in_y.val();
        self.corners.columns.next = self.in_a.val();
        self.corners.rows.next = self.in_b.val();
        self.corners.value.next = self.in_sum.val();

        // s11_word: one of the four.
        if self.moves.val() && self.corners.fetch.val() {
            self.phase.d.next = self.phase.q.val() + 1;
        }
        self.word.next = self.corners.word_0.val();
        self.zero.next = self.corners.zero.val().get_bit(0);
        if self.phase.q.val() == 1 {
            self.word.next = self.corners.word_1.val();
            self.zero.next = self.corners.zero.val().get_bit(1);
        }
        if self.phase.q.val() == 2 {
            self.word.next = self.corners.word_2.val();
            self.zero.next = self.corners.zero.val().get_bit(2);
        }
        if self.phase.q.val() == 3 {
            self.word.next = self.corners.word_3.val();
            self.zero.next = self.corners.zero.val().get_bit(3);
        }
        if self.moves.val() {
            self.s11_sends.d.next = self.corners.fetch.val();
            self.s11_load.d.next = self.corners.load.val();
            self.s11_fails.d.next = self.go.val() && self.corners.fails.val();
            self.s11_phase.d.next = self.phase.q.val();
            self.s11_zero.d.next = self.zero.val();
            self.s11_word.d.next = self.word.val();
            self.s11_value.d.next = self.corners.load_value.val();
            self.s11_area.d.next = self.corners.area.val();
        }

        // s12_table
        // Not read while it is written, so that synthesis sees that the ports never meet.
        self.s12_table.enable.next = self.moves.val() && !self.s11_load.q.val();
        self.s12_table.read_address.next = self.s11_word.q.val();
        self.s12_table.write_enable.next = self.moves.val() && self.s11_load.q.val();
        self.s12_table.write_address.next = self.s11_word.q.val();
        self.s12_table.write_data.next = self.s11_value.q.val();
        if self.moves.val() {
            self.s12_sends.d.next = self.s11_sends.q.val();
            self.s12_fails.d.next = self.s11_fails.q.val();
            self.s12_phase.d.next = self.s11_phase.q.val();
            self.s12_zero.d.next = self.s11_zero.q.val();
            self.s12_area.d.next = self.s11_area.q.val();
        }

        // s13_read: block RAM sends late in its cycle, and from far away.
        if self.moves.val() {
            self.s13_sends.d.next = self.s12_sends.q.val();
            self.s13_fails.d.next = self.s12_fails.q.val();
            self.s13_phase.d.next = self.s12_phase.q.val();
            self.s13_zero.d.next = self.s12_zero.q.val();
            self.s13_read.d.next = self.s12_table.read_data.val();
            self.s13_area.d.next = self.s12_area.q.val();
        }

        // s14_entry
        self.entry.next = self.s13_read.q.val();
        if self.s13_zero.q.val() {
            self.entry.next = 0.into();
        }
        if self.moves.val() {
            self.s14_sends.d.next = self.s13_sends.q.val();
            self.s14_fails.d.next = self.s13_fails.q.val();
            self.s14_phase.d.next = self.s13_phase.q.val();
            self.s14_entry.d.next = self.entry.val();
            self.s14_area.d.next = self.s13_area.q.val();
        }

        // s15_sum: wraps at 2^B by intent.
        if self.moves.val() {
            self.s15_sends.d.next = self.s14_sends.q.val() && self.s14_phase.q.val() == 3;
            if self.s14_fails.q.val() {
                self.failed.d.next = true;
            }
        }
        if self.moves.val() && self.s14_sends.q.val() {
            self.s15_area.d.next = self.s14_area.q.val();
            if self.s14_phase.q.val() == 0 {
                self.s15_sum.d.next = self.s14_entry.q.val();
            } else if self.s14_phase.q.val() == 3 {
                self.s15_sum.d.next = self.s15_sum.q.val() + self.s14_entry.q.val();
            } else {
                self.s15_sum.d.next = self.s15_sum.q.val() - self.s14_entry.q.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sat_fetch")
    }
}

ports! {
    [const M: usize, const X: usize, const R: usize, const T: usize, const B: usize] SatFetch<M, X, R, T, B> {
        inputs: in_valid, in_kind, in_x, in_y, in_a, in_b, in_sum, in_width, in_height, in_slide, out_ready;
        outputs: in_ready, out_valid, out_sum, out_area, error;
        blocks: corners;
        state: corners, phase, s11_sends, s11_load, s11_fails, s11_phase, s11_zero, s11_word, s11_value, s11_area, s12_table, s12_sends, s12_fails, s12_phase, s12_zero, s12_area, s13_sends, s13_fails, s13_phase, s13_zero, s13_read, s13_area, s14_sends, s14_fails, s14_phase, s14_entry, s14_area, s15_sends, s15_sum, s15_area, failed
    }
}
