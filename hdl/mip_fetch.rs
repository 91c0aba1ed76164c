// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a texel of a pyramid's level, the nearest one or between four, one result a cycle from four parity banks.
//!
//! ```text
//! i = floor(u / 2^L), a = the 12 bits below it; j and b from v likewise; clamped, or one period taken off
//! q = t00 (1-a)(1-b) + t10 a (1-b) + t01 (1-a) b + t11 a b      bank (j & 1) * 2 + (i & 1),
//! nearest: a and b rounded to 0 or 1                            word base[L] + (j >> 1) * pitch[L] + (i >> 1)
//! ```
//!
//! | port       | format      | meaning |   Latency 12, interval 1
//! | in_kind    | 2 bits      | 0 size of a level, 1 load of a sample, 2 fetch   Golden: models::mip_fetch::MipFetch
//! | in_level   | 4 bits      | levels are sized in order; a fetch beyond the last one reads the last one
//! | in_u, in_v | UQ13.16     | texels of level 0 | fetch   Error 1/2 unit of UQ16.8
//! | in_bilinear | Bit        | otherwise the nearest texel | fetch
//! | in_i, in_j, in_value | unsigned M, M, 16 | column, row and sample | load
//! | in_width, in_height  | unsigned M | samples of the level, at least one | size
//! | in_base, in_pitch    | unsigned A, M | first word in every bank; words a row takes, at least width / 2 | size
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
#[derive(Clone, Debug, Default, LogicBlock)]
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
    pub in_i: Input<U<M>>,
    pub in_j: Input<U<M>>,
    pub in_value: Input<U<16>>,
    pub in_width: Input<U<M>>,
    pub in_height: Input<U<M>>,
    pub in_base: Input<U<A>>,
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
    // s1: coordinates at their level, and the level's record.
    s1_u: DataRegister<U<29>>,
    s1_v: DataRegister<U<29>>,
    s1_i: DataRegister<U<M>>,
    s1_j: DataRegister<U<M>>,
    s1_load: Register<Bit>,
    s1_nearest: DataRegister<Bit>,
    s1_value: DataRegister<U<16>>,
    s1_blank: DataRegister<Bit>,
    // s2: the axes, and what the banks want of the record.
    s2_base: DataRegister<U<A>>,
    s2_pitch: DataRegister<U<M>>,
    s2_load: Register<Bit>,
    s2_value: DataRegister<U<16>>,
    s2_blank: DataRegister<Bit>,
    // s3 to s6: the banks. Weights a and b travel along.
    s3_weights: DataRegister<Lanes<2, 14>>,
    s4_weights: DataRegister<Lanes<2, 14>>,
    s5_weights: DataRegister<Lanes<2, 14>>,
    s6_weights: DataRegister<Lanes<2, 14>>,
    // A fetch, and an error, at each stage. A load counts where the memory's end matters.
    s1_sends: Register<Bit>,
    s2_sends: Register<Bit>,
    s3_sends: Register<Bit>,
    s4_sends: Register<Bit>,
    s5_sends: Register<Bit>,
    s6_sends: Register<Bit>,
    s7_sends: Register<Bit>,
    s8_sends: Register<Bit>,
    s9_sends: Register<Bit>,
    s10_sends: Register<Bit>,
    s11_sends: Register<Bit>,
    s12_sends: Register<Bit>,
    s1_fails: Register<Bit>,
    s2_fails: Register<Bit>,
    s3_fails: Register<Bit>,
    s4_fails: Register<Bit>,
    s5_fails: Register<Bit>,
    s6_fails: Register<Bit>,
    s7_fails: Register<Bit>,
    s8_fails: Register<Bit>,
    s9_fails: Register<Bit>,
    s10_fails: Register<Bit>,
    s11_fails: Register<Bit>,
    s3_load: Register<Bit>,
    s4_load: Register<Bit>,
    failed: Register<Bit>,
    go: Wire<Bit>,
    beat: Wire<Bit>,
    fetches: Wire<Bit>,
    loads: Wire<Bit>,
    sizes: Wire<Bit>,
    known: Wire<Bit>,
    sound: Wire<Bit>,
    in_order: Wire<Bit>,
    level: Wire<U<4>>,
    half_width: Wire<U<M>>,
    outside: Wire<Bit>,
    weights_u: Wire<Lanes<2, 14>>,
    s2_weights: Wire<Lanes<2, 14>>,
}

impl<const M: usize, const A: usize> MipFetch<M, A> {
    /// Cycles from a fetch to its value.
    pub const LATENCY: usize = 12;
}

impl<const M: usize, const A: usize> Logic for MipFetch<M, A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, levels, axis_u, axis_v, banks, bilinear);
        dff_setup!(self, clock, count, s1_u, s1_v, s1_i, s1_j, s1_load, s1_nearest, s1_value, s1_blank);
        dff_setup!(self, clock, s2_base, s2_pitch, s2_load, s2_value, s2_blank);
        dff_setup!(self, clock, s3_weights, s4_weights, s5_weights, s6_weights, s3_load, s4_load, failed);
        dff_setup!(self, clock, s1_sends, s2_sends, s3_sends, s4_sends, s5_sends, s6_sends);
        dff_setup!(self, clock, s7_sends, s8_sends, s9_sends, s10_sends, s11_sends, s12_sends);
        dff_setup!(self, clock, s1_fails, s2_fails, s3_fails, s4_fails, s5_fails, s6_fails);
        dff_setup!(self, clock, s7_fails, s8_fails, s9_fails, s10_fails, s11_fails);

        // The whole pipeline moves, or stands.
        self.go.next = !self.s12_sends.q.val() || self.out_ready.val();
        self.in_ready.next = self.go.val();
        self.out_valid.next = self.s12_sends.q.val();
        self.out_value.next = self.bilinear.value.val();
        self.error.next = self.failed.q.val();
        self.levels.go.next = self.go.val();
        self.axis_u.go.next = self.go.val();
        self.axis_v.go.next = self.go.val();
        self.banks.go.next = self.go.val();
        self.bilinear.go.next = self.go.val();

        // s1_level
        self.beat.next = self.go.val() && self.in_valid.val();
        self.sizes.next = self.beat.val() && self.in_kind.val() == 0;
        self.loads.next = self.beat.val() && self.in_kind.val() == 1;
        self.fetches.next = self.beat.val() && self.in_kind.val() >= 2;
        self.known.next = self.in_level.val() < self.count.q.val();
        self.level.next = self.in_level.val();
        if self.fetches.val() && !self.known.val() {
            self.level.next = self.count.q.val() - 1;
        }
        self.half_width.next = (self.in_width.val() >> 1) + bit_cast_to::<U<M>>(self.in_width.val().get_bit(0));
        self.sound.next = self.in_width.val() != 0
            && self.in_height.val() != 0
            && self.in_pitch.val() >= self.half_width.val()
            && !(self.in_repeat_u.val() && self.in_width.val().get_bit(0))
            && !(self.in_repeat_v.val() && self.in_height.val().get_bit(0));
        self.in_order.next = self.in_level.val() <= self.count.q.val() && self.in_level.val() != 15;
        self.levels.write.next = self.sizes.val() && self.in_order.val() && self.sound.val();
        self.levels.level.next = self.level.val();
        self.levels.in_width.next = self.in_width.val();
        self.levels.in_height.next = self.in_height.val();
        self.levels.in_base.next = self.in_base.val();
        self.levels.in_pitch.next = self.in_pitch.val();
        self.levels.in_repeat_u.next = self.in_repeat_u.val();
        self.levels.in_repeat_v.next = self.in_repeat_v.val();
        if self.sizes.val() && self.in_order.val() {
            self.count.d.next = self.in_level.val();
            if self.sound.val() {
                self.count.d.next = self.in_level.val() + 1;
            }
        }
        if self.go.val() {
            self.s1_sends.d.next = self.fetches.val();
            self.s1_load.d.next = self.loads.val() && self.known.val();
            self.s1_fails.d.next = (self.sizes.val() && !(self.in_order.val() && self.sound.val()))
                || (self.loads.val() && !self.known.val())
                || (self.fetches.val() && self.count.q.val() == 0);
            self.s1_blank.d.next = self.count.q.val() == 0;
            self.s1_u.d.next = self.in_u.val() >> self.level.val();
            self.s1_v.d.next = self.in_v.val() >> self.level.val();
            self.s1_i.d.next = self.in_i.val();
            self.s1_j.d.next = self.in_j.val();
            self.s1_nearest.d.next = !self.in_bilinear.val();
            self.s1_value.d.next = self.in_value.val();
        }

        // s2_axes
        self.axis_u.at.next = self.s1_u.q.val();
        self.axis_u.load.next = self.s1_load.q.val();
        self.axis_u.load_at.next = self.s1_i.q.val();
        self.axis_u.nearest.next = self.s1_nearest.q.val();
        self.axis_u.side.next = self.levels.width.val();
        self.axis_u.repeats.next = self.levels.repeat_u.val();
        self.axis_v.at.next = self.s1_v.q.val();
        self.axis_v.load.next = self.s1_load.q.val();
        self.axis_v.load_at.next = self.s1_j.q.val();
        self.axis_v.nearest.next = self.s1_nearest.q.val();
        self.axis_v.side.next = self.levels.height.val();
        self.axis_v.repeats.next = self.levels.repeat_v.val();
        self.outside.next =
            (self.s2_sends.q.val() || self.s2_load.q.val()) && (self.axis_u.outside.val() || self.axis_v.outside.val());
        self.weights_u.next = bit_cast_to::<Lanes<2, 14>>(self.axis_u.weight.val());
        self.s2_weights.next = self.weights_u.val().replace_bit(1, self.axis_v.weight.val());

        // s3_product to s6_texel: the banks.
        self.banks.base.next = self.s2_base.q.val();
        self.banks.pitch.next = self.s2_pitch.q.val();
        self.banks.even_column.next = self.axis_u.even.val();
        self.banks.odd_column.next = self.axis_u.odd.val();
        self.banks.even_row.next = self.axis_v.even.val();
        self.banks.odd_row.next = self.axis_v.odd.val();
        self.banks.flags.next = bit_cast_to::<U<4>>(self.axis_u.first_odd.val())
            | (bit_cast_to::<U<4>>(self.axis_v.first_odd.val()) << 1)
            | (bit_cast_to::<U<4>>(self.axis_u.same.val()) << 2)
            | (bit_cast_to::<U<4>>(self.axis_v.same.val()) << 3);
        self.banks.blank.next = self.s2_blank.q.val();
        self.banks.write.next = self.s2_load.q.val() && !self.outside.val();
        self.banks.write_data.next = self.s2_value.q.val();

        // s7_difference to s12_value: the interpolation.
        self.bilinear.t00.next = self.banks.t00.val();
        self.bilinear.t10.next = self.banks.t10.val();
        self.bilinear.t01.next = self.banks.t01.val();
        self.bilinear.t11.next = self.banks.t11.val();
        self.bilinear.a.next = self.s6_weights.q.val().get_bit(0);
        self.bilinear.b.next = self.s6_weights.q.val().get_bit(1);

        if self.go.val() {
            self.s2_base.d.next = self.levels.base.val();
            self.s2_pitch.d.next = self.levels.pitch.val();
            self.s2_load.d.next = self.s1_load.q.val();
            self.s2_value.d.next = self.s1_value.q.val();
            self.s2_blank.d.next = self.s1_blank.q.val();
            self.s3_load.d.next = self.s2_load.q.val();
            self.s4_load.d.next = self.s3_load.q.val();
            self.s3_weights.d.next = self.s2_weights.val();
            self.s4_weights.d.next = self.s3_weights.q.val();
            self.s5_weights.d.next = self.s4_weights.q.val();
            self.s6_weights.d.next = self.s5_weights.q.val();
            self.s2_sends.d.next = self.s1_sends.q.val();
            self.s3_sends.d.next = self.s2_sends.q.val();
            self.s4_sends.d.next = self.s3_sends.q.val();
            self.s5_sends.d.next = self.s4_sends.q.val();
            self.s6_sends.d.next = self.s5_sends.q.val();
            self.s7_sends.d.next = self.s6_sends.q.val();
            self.s8_sends.d.next = self.s7_sends.q.val();
            self.s9_sends.d.next = self.s8_sends.q.val();
            self.s10_sends.d.next = self.s9_sends.q.val();
            self.s11_sends.d.next = self.s10_sends.q.val();
            self.s12_sends.d.next = self.s11_sends.q.val();
            self.s2_fails.d.next = self.s1_fails.q.val();
            self.s3_fails.d.next = self.s2_fails.q.val() || self.outside.val();
            self.s4_fails.d.next = self.s3_fails.q.val();
            self.s5_fails.d.next =
                self.s4_fails.q.val() || ((self.s4_sends.q.val() || self.s4_load.q.val()) && self.banks.beyond.val());
            self.s6_fails.d.next = self.s5_fails.q.val();
            self.s7_fails.d.next = self.s6_fails.q.val();
            self.s8_fails.d.next = self.s7_fails.q.val();
            self.s9_fails.d.next = self.s8_fails.q.val();
            self.s10_fails.d.next = self.s9_fails.q.val();
            self.s11_fails.d.next = self.s10_fails.q.val();
            if self.s11_fails.q.val() {
                self.failed.d.next = true;
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_fetch")
    }
}

ports! {
    [const M: usize, const A: usize] MipFetch<M, A> {
        inputs: in_valid, in_kind, in_level, in_u, in_v, in_bilinear, in_i, in_j, in_value, in_width, in_height, in_base,
            in_pitch, in_repeat_u, in_repeat_v, out_ready;
        outputs: in_ready, out_valid, out_value, error;
        blocks: levels, axis_u, axis_v, banks, bilinear;
        state: count, levels, axis_u, axis_v, banks, bilinear, s1_u, s1_v, s1_i, s1_j, s1_load, s1_nearest, s1_value, s1_blank, s2_base, s2_pitch, s2_load, s2_value, s2_blank, s3_weights, s4_weights, s5_weights, s6_weights, s1_sends, s2_sends, s3_sends, s4_sends, s5_sends, s6_sends, s7_sends, s8_sends, s9_sends, s10_sends, s11_sends, s12_sends, s1_fails, s2_fails, s3_fails, s4_fails, s5_fails, s6_fails, s7_fails, s8_fails, s9_fails, s10_fails, s11_fails, s3_load, s4_load, failed
    }
}
