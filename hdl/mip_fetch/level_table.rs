// SPDX-License-Identifier: MIT OR Apache-2.0
//! Size, place and borders of every level.
//!
//! | port    | format   |   Latency 1, interval 1; the record holds while `go` is low
//! | write, write_level | Bit, unsigned 4 | stores the fields of a level, with `go` only
//! | level   | unsigned 4 | the level to be read   Golden: models::mip_fetch (Placement)   Error 0
//! | in_*    | the fields of `size`
//! | *       | the fields of the level addressed in the cycle before

use crate::prelude::*;

/// Records of 16 levels: sides of `M` bits, bank words of `A` bits.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct LevelTable<const M: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub write: Input<Bit>,
    pub write_level: Input<U<4>>,
    pub level: Input<U<4>>,
    pub in_width: Input<U<M>>,
    pub in_height: Input<U<M>>,
    pub in_base: Input<U<A>>,
    pub in_minima_base: Input<U<A>>,
    pub in_pitch: Input<U<M>>,
    pub in_repeat_u: Input<Bit>,
    pub in_repeat_v: Input<Bit>,
    pub width: Output<U<M>>,
    pub height: Output<U<M>>,
    pub base: Output<U<A>>,
    pub minima_base: Output<U<A>>,
    pub pitch: Output<U<M>>,
    pub repeat_u: Output<Bit>,
    pub repeat_v: Output<Bit>,
    widths: Ram<U<M>, 4>,
    heights: Ram<U<M>, 4>,
    bases: Ram<U<A>, 4>,
    minima_bases: Ram<U<A>, 4>,
    pitches: Ram<U<M>, 4>,
    repeats: Ram<U<2>, 4>,
    both: Wire<U<2>>,
}

impl<const M: usize, const A: usize> Logic for LevelTable<M, A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, widths, heights, bases, minima_bases, pitches, repeats);
        self.widths.enable.next = self.go.val();
        self.heights.enable.next = self.go.val();
        self.bases.enable.next = self.go.val();
        self.minima_bases.enable.next = self.go.val();
        self.pitches.enable.next = self.go.val();
        self.repeats.enable.next = self.go.val();
        self.widths.write_enable.next = self.write.val();
        self.heights.write_enable.next = self.write.val();
        self.bases.write_enable.next = self.write.val();
        self.minima_bases.write_enable.next = self.write.val();
        self.pitches.write_enable.next = self.write.val();
        self.repeats.write_enable.next = self.write.val();
        self.widths.write_address.next = self.write_level.val();
        self.heights.write_address.next = self.write_level.val();
        self.bases.write_address.next = self.write_level.val();
        self.minima_bases.write_address.next = self.write_level.val();
        self.pitches.write_address.next = self.write_level.val();
        self.repeats.write_address.next = self.write_level.val();
        self.widths.read_address.next = self.level.val();
        self.heights.read_address.next = self.level.val();
        self.bases.read_address.next = self.level.val();
        self.minima_bases.read_address.next = self.level.val();
        self.pitches.read_address.next = self.level.val();
        self.repeats.read_address.next = self.level.val();
        self.widths.write_data.next = self.in_width.val();
        self.heights.write_data.next = self.in_height.val();
        self.bases.write_data.next = self.in_base.val();
        self.minima_bases.write_data.next = self.in_minima_base.val();
        self.pitches.write_data.next = self.in_pitch.val();
        self.repeats.write_data.next =
            bit_cast_to::<U<2>>(self.in_repeat_u.val()) | (bit_cast_to::<U<2>>(self.in_repeat_v.val()) << 1);
        self.width.next = self.widths.read_data.val();
        self.height.next = self.heights.read_data.val();
        self.base.next = self.bases.read_data.val();
        self.minima_base.next = self.minima_bases.read_data.val();
        self.pitch.next = self.pitches.read_data.val();
        self.both.next = self.repeats.read_data.val();
        self.repeat_u.next = self.both.val().get_bit(0);
        self.repeat_v.next = self.both.val().get_bit(1);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("level_table")
    }
}

latches! { [const M: usize, const A: usize] LevelTable<M, A>: widths, heights, bases, minima_bases, pitches, repeats }
