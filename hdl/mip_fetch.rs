// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a texel of a pyramid's level, the nearest one or between four, one result a cycle from four parity banks.
//!
//! ```text
//! i = floor(u / 2^L), a = the 12 bits below it; j and b from v likewise; clamped, or one period taken off
//! q = t00 (1-a)(1-b) + t10 a (1-b) + t01 (1-a) b + t11 a b      bank (j & 1) * 2 + (i & 1),
//! nearest: a and b rounded to 0 or 1                            word base[L] + (j >> 1) * pitch[L] + (i >> 1)
//! ```
//!
//! | port       | format      | meaning |   Latency 21, interval 1
//! | in_kind    | 2 bits      | 0 size of a level, 1 load of a sample, 2 fetch   Golden: models::mip_fetch::MipFetch
//! | in_level   | 4 bits      | levels are sized in order; a fetch beyond the last one reads the last one
//! | in_u, in_v | UQ13.16     | texels of level 0 | fetch   Error 1/2 unit of UQ16.8
//! | in_bilinear | Bit        | otherwise the nearest texel | fetch
//! | in_minima  | Bit         | minima of the level, otherwise maxima | fetch, load
//! | in_i, in_j, in_value | unsigned M, M, 16 | column, row and sample | load
//! | in_width, in_height  | unsigned M | samples of the level, at least one | size
//! | in_base, in_pitch    | unsigned A, M | first word in every bank; words a row takes, at least width / 2 | size
//! | in_minima_base | unsigned A | first word of its minima; `in_base` where it has no others | size
//! | in_repeat_u, in_repeat_v | Bit | the map repeats; the side must be even | size
//! | out_value  | UQ16.8      | 0 ..= 65535.0 |
//! | error      | Bit         | sticky: a size that cannot be used (its level and those above are gone), a load outside of
//! its level or of the memory (not stored), a fetch before a size (0), beyond two periods (the last sample) or outside
//! of the memory (texels are 0)
//!
//! Example: between texels 100 and 200, at u = 0.25: 125.0 = 0x7d00. A sample never loaded reads as anything.

mod axis;
mod banks;
mod bilinear;
mod level_table;

pub use axis::MipAxis;
pub use banks::MipBanks;
pub use bilinear::Bilinear;
pub use level_table::LevelTable;

use crate::prelude::*;

/// Fetch from levels with sides below 2^M, M <= 13, in four banks of 2^A texels, A <= 27.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct MipFetch<const M: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_level: Input<U<4>>,
    pub in_u: Input<U<29>>,
    pub in_v: Input<U<29>>,
    pub in_bilinear: Input<Bit>,
    pub in_minima: Input<Bit>,
    pub in_i: Input<U<M>>,
    pub in_j: Input<U<M>>,
    pub in_value: Input<U<16>>,
    pub in_width: Input<U<M>>,
    pub in_height: Input<U<M>>,
    pub in_base: Input<U<A>>,
    pub in_minima_base: Input<U<A>>,
    pub in_pitch: Input<U<M>>,
    pub in_repeat_u: Input<Bit>,
    pub in_repeat_v: Input<Bit>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_value: Output<U<24>>,
    pub error: Output<Bit>,
    /// Levels that have a size.
    count: Register<U<4>>,
    levels: LevelTable<M, A>,
    axis_u: MipAxis<M>,
    axis_v: MipAxis<M>,
    banks: MipBanks<M, A>,
    bilinear: Bilinear,
    // s1_input: the beat; a sample to be loaded stands where the coordinates do.
    s1_sizes: Register<Bit>,
    s1_loads: Register<Bit>,
    s1_fetches: Register<Bit>,
    s1_level: DataRegister<U<4>>,
    s1_u: DataRegister<U<29>>,
    s1_v: DataRegister<U<29>>,
    s1_nearest: DataRegister<Bit>,
    s1_minima: DataRegister<Bit>,
    s1_value: DataRegister<U<16>>,
    s1_width: DataRegister<U<M>>,
    s1_height: DataRegister<U<M>>,
    s1_base: DataRegister<U<A>>,
    s1_minima_base: DataRegister<U<A>>,
    s1_pitch: DataRegister<U<M>>,
    s1_repeat_u: DataRegister<Bit>,
    s1_repeat_v: DataRegister<Bit>,
    /// The size can be used.
    s1_sound: DataRegister<Bit>,
    // s2_level: the level that is read, and what is refused.
    s2_sends: Register<Bit>,
    s2_load: Register<Bit>,
    s2_fails: Register<Bit>,
    s2_level: DataRegister<U<4>>,
    s2_shift: DataRegister<U<4>>,
    s2_u: DataRegister<U<29>>,
    s2_v: DataRegister<U<29>>,
    s2_nearest: DataRegister<Bit>,
    s2_minima: DataRegister<Bit>,
    s2_value: DataRegister<U<16>>,
    s2_blank: DataRegister<Bit>,
    // s3_shift: coordinates at their level, and the level's record.
    s3_u: DataRegister<U<29>>,
    s3_v: DataRegister<U<29>>,
    s3_nearest: DataRegister<Bit>,
    s3_minima: DataRegister<Bit>,
    s3_value: DataRegister<U<16>>,
    s3_blank: DataRegister<Bit>,
    // s4_compare to s6_sort: the axes. What the banks want travels along.
    s4_base: DataRegister<U<A>>,
    s4_pitch: DataRegister<U<M>>,
    s4_value: DataRegister<U<16>>,
    s4_blank: DataRegister<Bit>,
    s5_base: DataRegister<U<A>>,
    s5_pitch: DataRegister<U<M>>,
    s5_value: DataRegister<U<16>>,
    s5_blank: DataRegister<Bit>,
    s6_base: DataRegister<U<A>>,
    s6_pitch: DataRegister<U<M>>,
    s6_value: DataRegister<U<16>>,
    s6_blank: DataRegister<Bit>,
    // s7_product to s13_texel: the banks. Weights a and b travel along.
    s7_weights: DataRegister<Lanes<2, 14>>,
    s8_weights: DataRegister<Lanes<2, 14>>,
    s9_weights: DataRegister<Lanes<2, 14>>,
    s10_weights: DataRegister<Lanes<2, 14>>,
    s11_weights: DataRegister<Lanes<2, 14>>,
    s12_weights: DataRegister<Lanes<2, 14>>,
    s13_weights: DataRegister<Lanes<2, 14>>,
    /// Loads at s3 to s8, from the lowest bit.
    loading: Register<U<6>>,
    /// Fetches at s3 to s20.
    sending: Register<U<18>>,
    /// Errors at s3 to s19.
    failing: Register<U<17>>,
    failed: Register<Bit>,
    /// The pipeline moves in this cycle: what leaves it finds room. A register, as everything waits for it.
    moves: Register<Bit>,
    // s21: the value that is sent, and the next one where it waits, each with the errors up to it.
    sent_valid: Register<Bit>,
    sent_value: DataRegister<U<24>>,
    sent_failed: Register<Bit>,
    spare_valid: Register<Bit>,
    spare_value: DataRegister<U<24>>,
    spare_failed: DataRegister<Bit>,
    go: Wire<Bit>,
    arrives: Wire<Bit>,
    out_free: Wire<Bit>,
    spare_behind: Wire<Bit>,
    known: Wire<Bit>,
    in_order: Wire<Bit>,
    level: Wire<U<4>>,
    outside: Wire<Bit>,
    beyond: Wire<Bit>,
    failing_behind: Wire<U<17>>,
    weights_u: Wire<Lanes<2, 14>>,
    s6_weights: Wire<Lanes<2, 14>>,
}

impl<const M: usize, const A: usize> Default for MipFetch<M, A> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_level: Input::default(),
            in_u: Input::default(),
            in_v: Input::default(),
            in_bilinear: Input::default(),
            in_minima: Input::default(),
            in_i: Input::default(),
            in_j: Input::default(),
            in_value: Input::default(),
            in_width: Input::default(),
            in_height: Input::default(),
            in_base: Input::default(),
            in_minima_base: Input::default(),
            in_pitch: Input::default(),
            in_repeat_u: Input::default(),
            in_repeat_v: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_value: Output::default(),
            error: Output::default(),
            count: Register::default(),
            levels: LevelTable::default(),
            axis_u: MipAxis::default(),
            axis_v: MipAxis::default(),
            banks: MipBanks::default(),
            bilinear: Bilinear::default(),
            s1_sizes: Register::default(),
            s1_loads: Register::default(),
            s1_fetches: Register::default(),
            s1_level: DataRegister::default(),
            s1_u: DataRegister::default(),
            s1_v: DataRegister::default(),
            s1_nearest: DataRegister::default(),
            s1_minima: DataRegister::default(),
            s1_value: DataRegister::default(),
            s1_width: DataRegister::default(),
            s1_height: DataRegister::default(),
            s1_base: DataRegister::default(),
            s1_minima_base: DataRegister::default(),
            s1_pitch: DataRegister::default(),
            s1_repeat_u: DataRegister::default(),
            s1_repeat_v: DataRegister::default(),
            s1_sound: DataRegister::default(),
            s2_sends: Register::default(),
            s2_load: Register::default(),
            s2_fails: Register::default(),
            s2_level: DataRegister::default(),
            s2_shift: DataRegister::default(),
            s2_u: DataRegister::default(),
            s2_v: DataRegister::default(),
            s2_nearest: DataRegister::default(),
            s2_minima: DataRegister::default(),
            s2_value: DataRegister::default(),
            s2_blank: DataRegister::default(),
            s3_u: DataRegister::default(),
            s3_v: DataRegister::default(),
            s3_nearest: DataRegister::default(),
            s3_minima: DataRegister::default(),
            s3_value: DataRegister::default(),
            s3_blank: DataRegister::default(),
            s4_base: DataRegister::default(),
            s4_pitch: DataRegister::default(),
            s4_value: DataRegister::default(),
            s4_blank: DataRegister::default(),
            s5_base: DataRegister::default(),
            s5_pitch: DataRegister::default(),
            s5_value: DataRegister::default(),
            s5_blank: DataRegister::default(),
            s6_base: DataRegister::default(),
            s6_pitch: DataRegister::default(),
            s6_value: DataRegister::default(),
            s6_blank: DataRegister::default(),
            s7_weights: DataRegister::default(),
            s8_weights: DataRegister::default(),
            s9_weights: DataRegister::default(),
            s10_weights: DataRegister::default(),
            s11_weights: DataRegister::default(),
            s12_weights: DataRegister::default(),
            s13_weights: DataRegister::default(),
            loading: Register::default(),
            sending: Register::default(),
            failing: Register::default(),
            failed: Register::default(),
            moves: Register::new(true),
            sent_valid: Register::default(),
            sent_value: DataRegister::default(),
            sent_failed: Register::default(),
            spare_valid: Register::default(),
            spare_value: DataRegister::default(),
            spare_failed: DataRegister::default(),
            go: Wire::default(),
            arrives: Wire::default(),
            out_free: Wire::default(),
            spare_behind: Wire::default(),
            known: Wire::default(),
            in_order: Wire::default(),
            level: Wire::default(),
            outside: Wire::default(),
            beyond: Wire::default(),
            failing_behind: Wire::default(),
            weights_u: Wire::default(),
            s6_weights: Wire::default(),
        }
    }
}

impl<const M: usize, const A: usize> MipFetch<M, A> {
    /// Cycles from a fetch to its value.
    pub const LATENCY: usize = 21;
}

impl<const M: usize, const A: usize> Logic for MipFetch<M, A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, levels, axis_u, axis_v, banks, bilinear);
        dff_setup!(self, clock, count, s1_sizes, s1_loads, s1_fetches, s1_level, s1_u, s1_v, s1_nearest);
        dff_setup!(self, clock, s1_value, s1_width, s1_height, s1_base, s1_pitch, s1_repeat_u, s1_repeat_v, s1_sound);
        dff_setup!(self, clock, s2_sends, s2_load, s2_fails, s2_level, s2_shift, s2_u, s2_v, s2_nearest);
        dff_setup!(self, clock, s2_value, s2_blank, s3_u, s3_v, s3_nearest, s3_value, s3_blank, s4_base);
        dff_setup!(self, clock, s4_pitch, s4_value, s4_blank, s5_base, s5_pitch, s5_value, s5_blank, s6_base);
        dff_setup!(
            self,
            clock,
            s6_pitch,
            s6_value,
            s6_blank,
            s7_weights,
            s8_weights,
            s9_weights,
            s10_weights,
            s11_weights
        );
        dff_setup!(
            self,
            clock,
            loading,
            sending,
            failing,
            failed,
            s12_weights,
            s13_weights,
            moves,
            sent_valid,
            sent_value
        );
        dff_setup!(self, clock, sent_failed, spare_valid, spare_value, spare_failed);
        dff_setup!(self, clock, s1_minima, s1_minima_base, s2_minima, s3_minima);

        // The whole pipeline moves, or stands.
        self.go.next = self.moves.q.val();
        self.in_ready.next = self.go.val();
        self.out_valid.next = self.sent_valid.q.val();
        self.out_value.next = self.sent_value.q.val();
        self.error.next = self.sent_failed.q.val();
        self.levels.go.next = self.go.val();
        self.axis_u.go.next = self.go.val();
        self.axis_v.go.next = self.go.val();
        self.banks.go.next = self.go.val();
        self.bilinear.go.next = self.go.val();

        // s1_input
        if self.go.val() {
            self.s1_sizes.d.next = self.in_valid.val() && self.in_kind.val() == 0;
            self.s1_loads.d.next = self.in_valid.val() && self.in_kind.val() == 1;
            self.s1_fetches.d.next = self.in_valid.val() && self.in_kind.val() >= 2;
            self.s1_level.d.next = self.in_level.val();
            self.s1_u.d.next = self.in_u.val();
            self.s1_v.d.next = self.in_v.val();
            if self.in_kind.val() == 1 {
                self.s1_u.d.next = bit_cast_to::<U<29>>(self.in_i.val()) << 16;
                self.s1_v.d.next = bit_cast_to::<U<29>>(self.in_j.val()) << 16;
            }
            self.s1_nearest.d.next = !self.in_bilinear.val();
            self.s1_minima.d.next = self.in_minima.val();
            self.s1_value.d.next = self.in_value.val();
            self.s1_width.d.next = self.in_width.val();
            self.s1_height.d.next = self.in_height.val();
            self.s1_base.d.next = self.in_base.val();
            self.s1_minima_base.d.next = self.in_minima_base.val();
            self.s1_pitch.d.next = self.in_pitch.val();
            self.s1_repeat_u.d.next = self.in_repeat_u.val();
            self.s1_repeat_v.d.next = self.in_repeat_v.val();
            // 14 bits: a pitch has 13 at most.
            self.s1_sound.d.next = self.in_width.val() != 0
                && self.in_height.val() != 0
                && (bit_cast_to::<U<14>>(self.in_pitch.val()) << 1) >= bit_cast_to::<U<14>>(self.in_width.val())
                && !(self.in_repeat_u.val() && self.in_width.val().get_bit(0))
                && !(self.in_repeat_v.val() && self.in_height.val().get_bit(0));
        }

        // s2_level
        self.known.next = self.s1_level.q.val() < self.count.q.val();
        self.level.next = self.s1_level.q.val();
        if self.s1_fetches.q.val() && !self.known.val() {
            self.level.next = self.count.q.val() - 1;
        }
        self.in_order.next = self.s1_level.q.val() <= self.count.q.val() && self.s1_level.q.val() != 15;
        self.levels.write.next = self.go.val() && self.s1_sizes.q.val() && self.in_order.val() && self.s1_sound.q.val();
        self.levels.write_level.next = self.s1_level.q.val();
        self.levels.in_width.next = self.s1_width.q.val();
        self.levels.in_height.next = self.s1_height.q.val();
        self.levels.in_base.next = self.s1_base.q.val();
        self.levels.in_minima_base.next = self.s1_minima_base.q.val();
        self.levels.in_pitch.next = self.s1_pitch.q.val();
        self.levels.in_repeat_u.next = self.s1_repeat_u.q.val();
        self.levels.in_repeat_v.next = self.s1_repeat_v.q.val();
        self.levels.level.next = self.s2_level.q.val();
        if self.go.val() {
            if self.s1_sizes.q.val() && self.in_order.val() {
                self.count.d.next = self.s1_level.q.val();
                if self.s1_sound.q.val() {
                    self.count.d.next = self.s1_level.q.val() + 1;
                }
            }
            self.s2_sends.d.next = self.s1_fetches.q.val();
            self.s2_load.d.next = self.s1_loads.q.val() && self.known.val();
            self.s2_fails.d.next = (self.s1_sizes.q.val() && !(self.in_order.val() && self.s1_sound.q.val()))
                || (self.s1_loads.q.val() && !self.known.val())
                || (self.s1_fetches.q.val() && self.count.q.val() == 0);
            self.s2_blank.d.next = self.count.q.val() == 0;
            self.s2_level.d.next = self.level.val();
            self.s2_shift.d.next = self.level.val();
            if self.s1_loads.q.val() {
                self.s2_shift.d.next = 0.into();
            }
            self.s2_u.d.next = self.s1_u.q.val();
            self.s2_v.d.next = self.s1_v.q.val();
            self.s2_nearest.d.next = self.s1_nearest.q.val();
            self.s2_minima.d.next = self.s1_minima.q.val();
            self.s2_value.d.next = self.s1_value.q.val();
            // s3_shift
            self.s3_u.d.next = self.s2_u.q.val() >> self.s2_shift.q.val();
            self.s3_v.d.next = self.s2_v.q.val() >> self.s2_shift.q.val();
            self.s3_nearest.d.next = self.s2_nearest.q.val();
            self.s3_minima.d.next = self.s2_minima.q.val();
            self.s3_value.d.next = self.s2_value.q.val();
            self.s3_blank.d.next = self.s2_blank.q.val();
        }

        // s4_compare to s6_sort: the axes.
        self.axis_u.at.next = self.s3_u.q.val();
        self.axis_u.load.next = self.loading.q.val().get_bit(0);
        self.axis_u.nearest.next = self.s3_nearest.q.val();
        self.axis_u.side.next = self.levels.width.val();
        self.axis_u.repeats.next = self.levels.repeat_u.val();
        self.axis_v.at.next = self.s3_v.q.val();
        self.axis_v.load.next = self.loading.q.val().get_bit(0);
        self.axis_v.nearest.next = self.s3_nearest.q.val();
        self.axis_v.side.next = self.levels.height.val();
        self.axis_v.repeats.next = self.levels.repeat_v.val();
        self.outside.next = (self.sending.q.val().get_bit(3) || self.loading.q.val().get_bit(3))
            && (self.axis_u.outside.val() || self.axis_v.outside.val());
        self.weights_u.next = bit_cast_to::<Lanes<2, 14>>(self.axis_u.weight.val());
        self.s6_weights.next = self.weights_u.val().replace_bit(1, self.axis_v.weight.val());

        // s7_product to s13_texel: the banks.
        self.banks.base.next = self.s6_base.q.val();
        self.banks.pitch.next = self.s6_pitch.q.val();
        self.banks.even_column.next = self.axis_u.even.val();
        self.banks.odd_column.next = self.axis_u.odd.val();
        self.banks.even_row.next = self.axis_v.even.val();
        self.banks.odd_row.next = self.axis_v.odd.val();
        self.banks.flags.next = bit_cast_to::<U<4>>(self.axis_u.first_odd.val())
            | (bit_cast_to::<U<4>>(self.axis_v.first_odd.val()) << 1)
            | (bit_cast_to::<U<4>>(self.axis_u.same.val()) << 2)
            | (bit_cast_to::<U<4>>(self.axis_v.same.val()) << 3);
        self.banks.blank.next = self.s6_blank.q.val();
        self.banks.write.next = self.loading.q.val().get_bit(3) && !self.outside.val();
        self.banks.write_data.next = self.s6_value.q.val();
        self.beyond.next =
            (self.sending.q.val().get_bit(5) || self.loading.q.val().get_bit(5)) && self.banks.beyond.val();

        // s14_difference to s20_value: the interpolation.
        self.bilinear.t00.next = self.banks.t00.val();
        self.bilinear.t10.next = self.banks.t10.val();
        self.bilinear.t01.next = self.banks.t01.val();
        self.bilinear.t11.next = self.banks.t11.val();
        self.bilinear.a.next = self.s13_weights.q.val().get_bit(0);
        self.bilinear.b.next = self.s13_weights.q.val().get_bit(1);

        // An axis finds out at s6 what fails, a bank at s8.
        self.failing_behind.next = (self.failing.q.val() << 1)
            | bit_cast_to::<U<17>>(self.s2_fails.q.val())
            | (bit_cast_to::<U<17>>(self.outside.val()) << 4)
            | (bit_cast_to::<U<17>>(self.beyond.val()) << 6);
        if self.go.val() {
            self.loading.d.next = (self.loading.q.val() << 1) | bit_cast_to::<U<6>>(self.s2_load.q.val());
            self.sending.d.next = (self.sending.q.val() << 1) | bit_cast_to::<U<18>>(self.s2_sends.q.val());
            self.failing.d.next = self.failing_behind.val();
            if self.failing.q.val().get_bit(16) {
                self.failed.d.next = true;
            }
            self.s4_base.d.next = self.levels.base.val();
            if self.s3_minima.q.val() {
                self.s4_base.d.next = self.levels.minima_base.val();
            }
            self.s5_base.d.next = self.s4_base.q.val();
            self.s6_base.d.next = self.s5_base.q.val();
            self.s4_pitch.d.next = self.levels.pitch.val();
            self.s5_pitch.d.next = self.s4_pitch.q.val();
            self.s6_pitch.d.next = self.s5_pitch.q.val();
            self.s4_value.d.next = self.s3_value.q.val();
            self.s5_value.d.next = self.s4_value.q.val();
            self.s6_value.d.next = self.s5_value.q.val();
            self.s4_blank.d.next = self.s3_blank.q.val();
            self.s5_blank.d.next = self.s4_blank.q.val();
            self.s6_blank.d.next = self.s5_blank.q.val();
            self.s7_weights.d.next = self.s6_weights.val();
            self.s8_weights.d.next = self.s7_weights.q.val();
            self.s9_weights.d.next = self.s8_weights.q.val();
            self.s10_weights.d.next = self.s9_weights.q.val();
            self.s11_weights.d.next = self.s10_weights.q.val();
            self.s12_weights.d.next = self.s11_weights.q.val();
            self.s13_weights.d.next = self.s12_weights.q.val();
        }

        // s21: at most one more value arrives while the first one waits.
        self.arrives.next = self.go.val() && self.sending.q.val().get_bit(17);
        self.out_free.next = !self.sent_valid.q.val() || self.out_ready.val();
        self.spare_behind.next = !self.out_free.val() && (self.spare_valid.q.val() || self.arrives.val());
        self.spare_valid.d.next = self.spare_behind.val();
        self.moves.d.next = !self.spare_behind.val();
        if self.out_free.val() {
            self.sent_valid.d.next = self.spare_valid.q.val() || self.arrives.val();
            self.sent_value.d.next = self.bilinear.value.val();
            self.sent_failed.d.next = self.failed.q.val();
            if self.spare_valid.q.val() {
                self.sent_value.d.next = self.spare_value.q.val();
                self.sent_failed.d.next = self.spare_failed.q.val();
            }
        }
        if self.go.val() {
            self.spare_value.d.next = self.bilinear.value.val();
            self.spare_failed.d.next = self.failed.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_fetch")
    }
}

ports! {
    [const M: usize, const A: usize] MipFetch<M, A> {
        inputs: in_valid, in_kind, in_level, in_u, in_v, in_bilinear, in_minima, in_i, in_j, in_value, in_width, in_height, in_base,
            in_minima_base, in_pitch, in_repeat_u, in_repeat_v, out_ready;
        outputs: in_ready, out_valid, out_value, error;
        blocks: levels, axis_u, axis_v, banks, bilinear;
        state: count, levels, axis_u, axis_v, banks, bilinear, s1_sizes, s1_loads, s1_fetches, s1_level, s1_u, s1_v, s1_nearest, s1_minima, s1_minima_base, s1_value, s1_width, s1_height, s1_base, s1_pitch, s1_repeat_u, s1_repeat_v, s1_sound, s2_sends, s2_load, s2_fails, s2_level, s2_shift, s2_u, s2_v, s2_nearest, s2_minima, s2_value, s2_blank, s3_u, s3_v, s3_nearest, s3_minima, s3_value, s3_blank, s4_base, s4_pitch, s4_value, s4_blank, s5_base, s5_pitch, s5_value, s5_blank, s6_base, s6_pitch, s6_value, s6_blank, s7_weights, s8_weights, s9_weights, s10_weights, s11_weights, loading, sending, failing, failed, s12_weights, s13_weights, moves, sent_valid, sent_value, sent_failed, spare_valid, spare_value, spare_failed
    }
}
