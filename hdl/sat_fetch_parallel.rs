// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sum of a rectangle from two copies of a summed-area table, one result a cycle (Crow 1984).
//!
//! The formula, the beats and the errors are those of [`crate::sat_fetch`]. Four parity banks would not do: the corners
//! of a rectangle of even size have one parity.
//!
//! | port       | format      | meaning |   Latency 17, interval 1
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
//! Example: in the map (1, 2; 3, 4) the rectangle at (1, 0), 2 x 2: cut 6 of 2 texels, slid 10 of 4.

use crate::prelude::*;
use crate::sat_fetch::SatCorners;

/// Fetch from maps with sides of `M` bits, M <= 13, in twice 2^T sums of `B` bits, T <= 27; `X` = M + 2, `R` = 2 M.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct SatFetchParallel<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> {
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
    s11_word_0: DataRegister<U<T>>,
    s11_word_1: DataRegister<U<T>>,
    s11_word_2: DataRegister<U<T>>,
    s11_word_3: DataRegister<U<T>>,
    s11_store: Register<Bit>,
    s11_value: DataRegister<U<B>>,
    s11_sends: Register<Bit>,
    s11_zero: DataRegister<U<4>>,
    s11_area: DataRegister<U<R>>,
    s11_fails: Register<Bit>,
    /// Two corners of each rectangle come from each copy.
    s13_behind: TwoPortRam<U<B>, T>,
    s13_first: TwoPortRam<U<B>, T>,
    s12_sends: Register<Bit>,
    s12_zero: DataRegister<U<4>>,
    s12_area: DataRegister<U<R>>,
    s12_fails: Register<Bit>,
    s13_sends: Register<Bit>,
    s13_zero: DataRegister<U<4>>,
    s13_area: DataRegister<U<R>>,
    s13_fails: Register<Bit>,
    s14_sends: Register<Bit>,
    s14_entry_0: DataRegister<U<B>>,
    s14_entry_1: DataRegister<U<B>>,
    s14_entry_2: DataRegister<U<B>>,
    s14_entry_3: DataRegister<U<B>>,
    s14_area: DataRegister<U<R>>,
    s14_fails: Register<Bit>,
    s15_sends: Register<Bit>,
    s15_lower: DataRegister<U<B>>,
    s15_upper: DataRegister<U<B>>,
    s15_area: DataRegister<U<R>>,
    s15_fails: Register<Bit>,
    s16_sends: Register<Bit>,
    s16_sum: DataRegister<U<B>>,
    s16_area: DataRegister<U<R>>,
    failed: Register<Bit>,
    /// The pipeline moves: no sum waits behind the one that waits at the output.
    moves: Register<Bit>,
    /// The same for the block RAMs. They lie far apart, and synthesis would make one register of two that are equal after
    /// reset, too: this one is low then.
    reads: Register<Bit>,
    sent_valid: Register<Bit>,
    sent_sum: DataRegister<U<B>>,
    sent_area: DataRegister<U<R>>,
    sent_failed: Register<Bit>,
    spare_valid: Register<Bit>,
    spare_sum: DataRegister<U<B>>,
    spare_area: DataRegister<U<R>>,
    spare_failed: DataRegister<Bit>,
    go: Wire<Bit>,
    zero: Wire<U<4>>,
    arrives: Wire<Bit>,
    out_free: Wire<Bit>,
    spare_behind: Wire<Bit>,
    entry_0: Wire<U<B>>,
    entry_1: Wire<U<B>>,
    entry_2: Wire<U<B>>,
    entry_3: Wire<U<B>>,
}

impl<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> Default
    for SatFetchParallel<M, X, R, T, B>
{
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_x: Input::default(),
            in_y: Input::default(),
            in_a: Input::default(),
            in_b: Input::default(),
            in_sum: Input::default(),
            in_width: Input::default(),
            in_height: Input::default(),
            in_slide: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_sum: Output::default(),
            out_area: Output::default(),
            error: Output::default(),
            corners: SatCorners::default(),
            s11_word_0: DataRegister::default(),
            s11_word_1: DataRegister::default(),
            s11_word_2: DataRegister::default(),
            s11_word_3: DataRegister::default(),
            s11_store: Register::default(),
            s11_value: DataRegister::default(),
            s11_sends: Register::default(),
            s11_zero: DataRegister::default(),
            s11_area: DataRegister::default(),
            s11_fails: Register::default(),
            s13_behind: TwoPortRam::default(),
            s13_first: TwoPortRam::default(),
            s12_sends: Register::default(),
            s12_zero: DataRegister::default(),
            s12_area: DataRegister::default(),
            s12_fails: Register::default(),
            s13_sends: Register::default(),
            s13_zero: DataRegister::default(),
            s13_area: DataRegister::default(),
            s13_fails: Register::default(),
            s14_sends: Register::default(),
            s14_entry_0: DataRegister::default(),
            s14_entry_1: DataRegister::default(),
            s14_entry_2: DataRegister::default(),
            s14_entry_3: DataRegister::default(),
            s14_area: DataRegister::default(),
            s14_fails: Register::default(),
            s15_sends: Register::default(),
            s15_lower: DataRegister::default(),
            s15_upper: DataRegister::default(),
            s15_area: DataRegister::default(),
            s15_fails: Register::default(),
            s16_sends: Register::default(),
            s16_sum: DataRegister::default(),
            s16_area: DataRegister::default(),
            failed: Register::default(),
            moves: Register::new(true),
            reads: Register::default(),
            sent_valid: Register::default(),
            sent_sum: DataRegister::default(),
            sent_area: DataRegister::default(),
            sent_failed: Register::default(),
            spare_valid: Register::default(),
            spare_sum: DataRegister::default(),
            spare_area: DataRegister::default(),
            spare_failed: DataRegister::default(),
            go: Wire::default(),
            zero: Wire::default(),
            arrives: Wire::default(),
            out_free: Wire::default(),
            spare_behind: Wire::default(),
            entry_0: Wire::default(),
            entry_1: Wire::default(),
            entry_2: Wire::default(),
            entry_3: Wire::default(),
        }
    }
}

impl<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> SatFetchParallel<M, X, R, T, B> {
    /// Cycles from a fetch to its sum.
    pub const LATENCY: usize = 17;
}

impl<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> Logic
    for SatFetchParallel<M, X, R, T, B>
{
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, corners, s13_behind, s13_first);
        dff_setup!(self, clock, s11_store, s11_value);
        dff_setup!(
            self, clock, s11_word_0, s11_word_1, s11_word_2, s11_word_3, s11_sends, s11_zero, s11_area, s11_fails
        );
        dff_setup!(self, clock, s12_sends, s12_zero, s12_area, s12_fails, s13_sends, s13_zero, s13_area, s13_fails);
        dff_setup!(self, clock, s14_sends, s14_entry_0, s14_entry_1, s14_entry_2, s14_entry_3, s14_area, s14_fails);
        dff_setup!(self, clock, s15_sends, s15_lower, s15_upper, s15_area, s15_fails, s16_sends, s16_sum, s16_area);
        dff_setup!(
            self,
            clock,
            failed,
            moves,
            reads,
            sent_valid,
            sent_sum,
            sent_area,
            sent_failed,
            spare_valid,
            spare_sum
        );
        dff_setup!(self, clock, spare_area, spare_failed);

        // The whole pipeline moves, or stands. A register says so: it has to reach every block RAM.
        self.go.next = self.moves.q.val();
        self.in_ready.next = self.go.val();
        self.out_valid.next = self.sent_valid.q.val();
        self.out_sum.next = self.sent_sum.q.val();
        self.out_area.next = self.sent_area.q.val();
        self.error.next = self.sent_failed.q.val();

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

        // s12_table: two words each, or a load into both.
        self.s13_behind.enable.next = self.reads.q.val();
        self.s13_behind.output_enable.next = self.reads.q.val();
        self.s13_behind.write_enable.next = self.s11_store.q.val();
        self.s13_behind.address.next = self.s11_word_0.q.val();
        self.s13_behind.write_data.next = self.s11_value.q.val();
        self.s13_behind.second_address.next = self.s11_word_1.q.val();
        self.s13_first.enable.next = self.reads.q.val();
        self.s13_first.output_enable.next = self.reads.q.val();
        self.s13_first.write_enable.next = self.s11_store.q.val();
        self.s13_first.address.next = self.s11_word_2.q.val();
        self.s13_first.write_data.next = self.s11_value.q.val();
        self.s13_first.second_address.next = self.s11_word_3.q.val();

        // s11_word. What is read beside a store means nothing.
        self.zero.next = self.corners.zero.val();
        if self.corners.load.val() {
            self.zero.next = 15.into();
        }
        // s13_table: its own registers.
        if self.go.val() {
            self.s11_store.d.next = self.corners.load.val();
            self.s11_value.d.next = self.corners.load_value.val();
            self.s11_word_0.d.next = self.corners.word_0.val();
            self.s11_word_1.d.next = self.corners.word_1.val();
            self.s11_word_2.d.next = self.corners.word_2.val();
            if self.corners.load.val() {
                self.s11_word_2.d.next = self.corners.word_0.val();
            }
            self.s11_word_3.d.next = self.corners.word_3.val();
            self.s11_sends.d.next = self.corners.fetch.val();
            self.s11_zero.d.next = self.zero.val();
            self.s11_area.d.next = self.corners.area.val();
            self.s11_fails.d.next = self.corners.fails.val();
            self.s12_sends.d.next = self.s11_sends.q.val();
            self.s12_zero.d.next = self.s11_zero.q.val();
            self.s12_area.d.next = self.s11_area.q.val();
            self.s12_fails.d.next = self.s11_fails.q.val();
            self.s13_sends.d.next = self.s12_sends.q.val();
            self.s13_zero.d.next = self.s12_zero.q.val();
            self.s13_area.d.next = self.s12_area.q.val();
            self.s13_fails.d.next = self.s12_fails.q.val();
        }

        // s14_entries, and their sum, which wraps at 2^B by intent: s15_lower and s15_upper, s16_sum.
        self.entry_0.next = self.s13_behind.read_data.val();
        if self.s13_zero.q.val().get_bit(0) {
            self.entry_0.next = 0.into();
        }
        self.entry_1.next = self.s13_behind.second_data.val();
        if self.s13_zero.q.val().get_bit(1) {
            self.entry_1.next = 0.into();
        }
        self.entry_2.next = self.s13_first.read_data.val();
        if self.s13_zero.q.val().get_bit(2) {
            self.entry_2.next = 0.into();
        }
        self.entry_3.next = self.s13_first.second_data.val();
        if self.s13_zero.q.val().get_bit(3) {
            self.entry_3.next = 0.into();
        }
        if self.go.val() {
            self.s14_sends.d.next = self.s13_sends.q.val();
            self.s14_entry_0.d.next = self.entry_0.val();
            self.s14_entry_1.d.next = self.entry_1.val();
            self.s14_entry_2.d.next = self.entry_2.val();
            self.s14_entry_3.d.next = self.entry_3.val();
            self.s14_area.d.next = self.s13_area.q.val();
            self.s14_fails.d.next = self.s13_fails.q.val();
            self.s15_sends.d.next = self.s14_sends.q.val();
            self.s15_lower.d.next = self.s14_entry_0.q.val() - self.s14_entry_1.q.val();
            self.s15_upper.d.next = self.s14_entry_2.q.val() - self.s14_entry_3.q.val();
            self.s15_area.d.next = self.s14_area.q.val();
            self.s15_fails.d.next = self.s14_fails.q.val();
            self.s16_sends.d.next = self.s15_sends.q.val();
            self.s16_sum.d.next = self.s15_lower.q.val() - self.s15_upper.q.val();
            self.s16_area.d.next = self.s15_area.q.val();
            if self.s15_fails.q.val() {
                self.failed.d.next = true;
            }
        }

        // s17: at most one more sum arrives while the first one waits.
        // While the pipeline stands, the spare place is taken, and what stands in s16 does not matter.
        self.arrives.next = self.s16_sends.q.val();
        self.out_free.next = !self.sent_valid.q.val() || self.out_ready.val();
        self.spare_behind.next = !self.out_free.val() && (self.spare_valid.q.val() || self.arrives.val());
        self.spare_valid.d.next = self.spare_behind.val();
        self.moves.d.next = !self.spare_behind.val();
        self.reads.d.next = !self.spare_behind.val();
        if self.out_free.val() {
            self.sent_valid.d.next = self.spare_valid.q.val() || self.arrives.val();
            self.sent_sum.d.next = self.s16_sum.q.val();
            self.sent_area.d.next = self.s16_area.q.val();
            self.sent_failed.d.next = self.failed.q.val();
            if self.spare_valid.q.val() {
                self.sent_sum.d.next = self.spare_sum.q.val();
                self.sent_area.d.next = self.spare_area.q.val();
                self.sent_failed.d.next = self.spare_failed.q.val();
            }
        }
        if self.go.val() {
            self.spare_sum.d.next = self.s16_sum.q.val();
            self.spare_area.d.next = self.s16_area.q.val();
            self.spare_failed.d.next = self.failed.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sat_fetch_parallel")
    }
}

ports! {
    [const M: usize, const X: usize, const R: usize, const T: usize, const B: usize] SatFetchParallel<M, X, R, T, B> {
        inputs: in_valid, in_kind, in_x, in_y, in_a, in_b, in_sum, in_width, in_height, in_slide, out_ready;
        outputs: in_ready, out_valid, out_sum, out_area, error;
        blocks: corners;
        state: corners, s11_store, s11_value, s11_word_0, s11_word_1, s11_word_2, s11_word_3, s11_sends, s11_zero, s11_area, s11_fails, s13_behind, s13_first, s12_sends, s12_zero, s12_area, s12_fails, s13_sends, s13_zero, s13_area, s13_fails, s14_sends, s14_entry_0, s14_entry_1, s14_entry_2, s14_entry_3, s14_area, s14_fails, s15_sends, s15_lower, s15_upper, s15_area, s15_fails, s16_sends, s16_sum, s16_area, failed, moves, reads, sent_valid, sent_sum, sent_area, sent_failed, spare_valid, spare_sum, spare_area, spare_failed
    }
}
