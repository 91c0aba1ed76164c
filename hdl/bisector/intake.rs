// SPDX-License-Identifier: MIT OR Apache-2.0
//! Takes the beats: keeps the size, counts the samples, and tells of draws.
//!
//! | stage    | what it does                                      |   Golden: models::bisector::Bisector   Error 0
//! | s1_beat  | takes a beat                                      |   Interval 1
//! | s2_sides | the map's last column and row, and the lattice's  |
//! | s3_sound | whether the sides fit                             |
//! | s4_store | a size is kept, or a sample gets its place, or a draw begins |
//!
//! Sticky: a size that cannot be, a sample without a size or after the last one, a draw before the last sample.

use crate::prelude::*;

/// Intake for lattices of up to 2^K steps, C = K + 1, H = K + 2, errors of `E` bits.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorIntake<const C: usize, const H: usize, const E: usize> {
    pub clock: Input<ClockReset>,
    pub beat: Input<Bit>,
    pub kind: Input<U<2>>,
    pub width: Input<U<C>>,
    pub height: Input<U<C>>,
    pub in_levels: Input<U<4>>,
    pub in_mirrored: Input<Bit>,
    pub error: Input<U<E>>,
    pub z: Input<U<20>>,
    /// A draw of a whole map begins, or one that has none.
    pub draws: Output<Bit>,
    pub blank: Output<Bit>,
    /// The map's last column and row, in half steps, and the side of the lattice, in steps.
    pub rim_u: Output<U<H>>,
    pub rim_v: Output<U<H>>,
    pub levels: Output<U<4>>,
    pub side: Output<U<C>>,
    pub mirrored: Output<Bit>,
    /// A sample; its height counts where the vertex is in the map.
    pub write: Output<Bit>,
    pub write_z: Output<Bit>,
    pub write_u: Output<U<C>>,
    pub write_v: Output<U<C>>,
    pub write_error: Output<U<E>>,
    pub write_height: Output<U<20>>,
    pub failed: Output<Bit>,
    s1_sizes: Register<Bit>,
    s1_samples: Register<Bit>,
    s1_draws: Register<Bit>,
    s1_width: DataRegister<U<C>>,
    s1_height: DataRegister<U<C>>,
    s1_levels: DataRegister<U<4>>,
    s1_mirrored: DataRegister<Bit>,
    s1_error: DataRegister<U<E>>,
    s1_z: DataRegister<U<20>>,
    s2_sizes: Register<Bit>,
    s2_samples: Register<Bit>,
    s2_draws: Register<Bit>,
    s2_wide: DataRegister<U<C>>,
    s2_tall: DataRegister<U<C>>,
    s2_side: DataRegister<U<C>>,
    s2_sound: DataRegister<Bit>,
    s2_levels: DataRegister<U<4>>,
    s2_mirrored: DataRegister<Bit>,
    s2_error: DataRegister<U<E>>,
    s2_z: DataRegister<U<20>>,
    s3_sizes: Register<Bit>,
    s3_samples: Register<Bit>,
    s3_draws: Register<Bit>,
    s3_wide: DataRegister<U<C>>,
    s3_tall: DataRegister<U<C>>,
    s3_side: DataRegister<U<C>>,
    s3_sound: DataRegister<Bit>,
    s3_levels: DataRegister<U<4>>,
    s3_mirrored: DataRegister<Bit>,
    s3_error: DataRegister<U<E>>,
    s3_z: DataRegister<U<20>>,
    sized: Register<Bit>,
    complete: Register<Bit>,
    wide: DataRegister<U<C>>,
    tall: DataRegister<U<C>>,
    last: DataRegister<U<C>>,
    map_levels: DataRegister<U<4>>,
    map_mirrored: DataRegister<Bit>,
    /// The next sample.
    cursor_u: DataRegister<U<C>>,
    cursor_v: DataRegister<U<C>>,
    s4_draws: Register<Bit>,
    s4_blank: Register<Bit>,
    s4_write: Register<Bit>,
    s4_u: DataRegister<U<C>>,
    s4_v: DataRegister<U<C>>,
    s4_inside_u: DataRegister<Bit>,
    s4_inside_v: DataRegister<Bit>,
    s4_error: DataRegister<U<E>>,
    s4_z: DataRegister<U<20>>,
    has_failed: Register<Bit>,
    most: Constant<U<4>>,
    one: Wire<U<C>>,
    stores: Wire<Bit>,
    row_ends: Wire<Bit>,
}

impl<const C: usize, const H: usize, const E: usize> Default for BisectorIntake<C, H, E> {
    fn default() -> Self {
        Self {
            most: Constant::new(U::new(C as i64 - 1)),
            clock: Input::default(),
            beat: Input::default(),
            kind: Input::default(),
            width: Input::default(),
            height: Input::default(),
            in_levels: Input::default(),
            in_mirrored: Input::default(),
            error: Input::default(),
            z: Input::default(),
            draws: Output::default(),
            blank: Output::default(),
            rim_u: Output::default(),
            rim_v: Output::default(),
            levels: Output::default(),
            side: Output::default(),
            mirrored: Output::default(),
            write: Output::default(),
            write_z: Output::default(),
            write_u: Output::default(),
            write_v: Output::default(),
            write_error: Output::default(),
            write_height: Output::default(),
            failed: Output::default(),
            s1_sizes: Register::default(),
            s1_samples: Register::default(),
            s1_draws: Register::default(),
            s1_width: DataRegister::default(),
            s1_height: DataRegister::default(),
            s1_levels: DataRegister::default(),
            s1_mirrored: DataRegister::default(),
            s1_error: DataRegister::default(),
            s1_z: DataRegister::default(),
            s2_sizes: Register::default(),
            s2_samples: Register::default(),
            s2_draws: Register::default(),
            s2_wide: DataRegister::default(),
            s2_tall: DataRegister::default(),
            s2_side: DataRegister::default(),
            s2_sound: DataRegister::default(),
            s2_levels: DataRegister::default(),
            s2_mirrored: DataRegister::default(),
            s2_error: DataRegister::default(),
            s2_z: DataRegister::default(),
            s3_sizes: Register::default(),
            s3_samples: Register::default(),
            s3_draws: Register::default(),
            s3_wide: DataRegister::default(),
            s3_tall: DataRegister::default(),
            s3_side: DataRegister::default(),
            s3_sound: DataRegister::default(),
            s3_levels: DataRegister::default(),
            s3_mirrored: DataRegister::default(),
            s3_error: DataRegister::default(),
            s3_z: DataRegister::default(),
            sized: Register::default(),
            complete: Register::default(),
            wide: DataRegister::default(),
            tall: DataRegister::default(),
            last: DataRegister::default(),
            map_levels: DataRegister::default(),
            map_mirrored: DataRegister::default(),
            cursor_u: DataRegister::default(),
            cursor_v: DataRegister::default(),
            s4_draws: Register::default(),
            s4_blank: Register::default(),
            s4_write: Register::default(),
            s4_u: DataRegister::default(),
            s4_v: DataRegister::default(),
            s4_inside_u: DataRegister::default(),
            s4_inside_v: DataRegister::default(),
            s4_error: DataRegister::default(),
            s4_z: DataRegister::default(),
            has_failed: Register::default(),
            one: Wire::default(),
            stores: Wire::default(),
            row_ends: Wire::default(),
        }
    }
}

impl<const C: usize, const H: usize, const E: usize> Logic for BisectorIntake<C, H, E> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            s1_sizes,
            s1_samples,
            s1_draws,
            s1_width,
            s1_height,
            s1_levels,
            s1_mirrored,
            s1_error,
            s1_z
        );
        dff_setup!(
            self,
            clock,
            s2_sizes,
            s2_samples,
            s2_draws,
            s2_wide,
            s2_tall,
            s2_side,
            s2_sound,
            s2_levels,
            s2_mirrored
        );
        dff_setup!(self, clock, s2_error, s2_z, s3_sizes, s3_samples, s3_draws, s3_wide, s3_tall, s3_side, s3_sound);
        dff_setup!(self, clock, s3_levels, s3_mirrored, s3_error, s3_z, sized, complete, wide, tall, last);
        dff_setup!(self, clock, map_levels, map_mirrored, cursor_u, cursor_v, s4_draws, s4_blank, s4_write, s4_u, s4_v);
        dff_setup!(self, clock, s4_inside_u, s4_inside_v, s4_error, s4_z, has_failed);
        self.draws.next = self.s4_draws.q.val();
        self.blank.next = self.s4_blank.q.val();
        self.rim_u.next = bit_cast_to::<U<H>>(self.wide.q.val()) << 1;
        self.rim_v.next = bit_cast_to::<U<H>>(self.tall.q.val()) << 1;
        self.levels.next = self.map_levels.q.val();
        self.side.next = self.last.q.val();
        self.mirrored.next = self.map_mirrored.q.val();
        self.write.next = self.s4_write.q.val();
        self.write_z.next = self.s4_write.q.val() && self.s4_inside_u.q.val() && self.s4_inside_v.q.val();
        self.write_u.next = self.s4_u.q.val();
        self.write_v.next = self.s4_v.q.val();
        self.write_error.next = self.s4_error.q.val();
        self.write_height.next = self.s4_z.q.val();
        self.failed.next = self.has_failed.q.val();

        // s1_beat
        self.s1_sizes.d.next = self.beat.val() && self.kind.val() == 0;
        self.s1_samples.d.next = self.beat.val() && self.kind.val() == 1;
        self.s1_draws.d.next = self.beat.val() && self.kind.val().get_bit(1);
        self.s1_width.d.next = self.width.val();
        self.s1_height.d.next = self.height.val();
        self.s1_levels.d.next = self.in_levels.val();
        self.s1_mirrored.d.next = self.in_mirrored.val();
        self.s1_error.d.next = self.error.val();
        self.s1_z.d.next = self.z.val();

        // s2_sides
        self.one.next = 1.into();
        self.s2_sizes.d.next = self.s1_sizes.q.val();
        self.s2_samples.d.next = self.s1_samples.q.val();
        self.s2_draws.d.next = self.s1_draws.q.val();
        self.s2_wide.d.next = self.s1_width.q.val() - 1;
        self.s2_tall.d.next = self.s1_height.q.val() - 1;
        self.s2_side.d.next = self.one.val() << self.s1_levels.q.val();
        self.s2_sound.d.next = (self.s1_width.q.val() >> 1) != 0
            && (self.s1_height.q.val() >> 1) != 0
            && self.s1_levels.q.val() <= self.most.val();
        self.s2_levels.d.next = self.s1_levels.q.val();
        self.s2_mirrored.d.next = self.s1_mirrored.q.val();
        self.s2_error.d.next = self.s1_error.q.val();
        self.s2_z.d.next = self.s1_z.q.val();

        // s3_sound: both sides fit the lattice, and the lattice the memories.
        self.s3_sizes.d.next = self.s2_sizes.q.val();
        self.s3_samples.d.next = self.s2_samples.q.val();
        self.s3_draws.d.next = self.s2_draws.q.val();
        self.s3_wide.d.next = self.s2_wide.q.val();
        self.s3_tall.d.next = self.s2_tall.q.val();
        self.s3_side.d.next = self.s2_side.q.val();
        self.s3_sound.d.next = self.s2_sound.q.val()
            && self.s2_wide.q.val() <= self.s2_side.q.val()
            && self.s2_tall.q.val() <= self.s2_side.q.val();
        self.s3_levels.d.next = self.s2_levels.q.val();
        self.s3_mirrored.d.next = self.s2_mirrored.q.val();
        self.s3_error.d.next = self.s2_error.q.val();
        self.s3_z.d.next = self.s2_z.q.val();

        // s4_store
        if self.s3_sizes.q.val() {
            self.sized.d.next = self.s3_sound.q.val();
            self.complete.d.next = false;
            self.wide.d.next = self.s3_wide.q.val();
            self.tall.d.next = self.s3_tall.q.val();
            self.last.d.next = self.s3_side.q.val();
            self.map_levels.d.next = self.s3_levels.q.val();
            self.map_mirrored.d.next = self.s3_mirrored.q.val();
            self.cursor_u.d.next = 0.into();
            self.cursor_v.d.next = 0.into();
        }
        self.stores.next = self.s3_samples.q.val() && self.sized.q.val() && !self.complete.q.val();
        self.row_ends.next = self.cursor_u.q.val() == self.last.q.val();
        if self.stores.val() {
            self.cursor_u.d.next = self.cursor_u.q.val() + 1;
            if self.row_ends.val() {
                self.cursor_u.d.next = 0.into();
                self.cursor_v.d.next = self.cursor_v.q.val() + 1;
                if self.cursor_v.q.val() == self.last.q.val() {
                    self.complete.d.next = true;
                }
            }
        }
        self.s4_write.d.next = self.stores.val();
        self.s4_u.d.next = self.cursor_u.q.val();
        self.s4_v.d.next = self.cursor_v.q.val();
        self.s4_inside_u.d.next = self.cursor_u.q.val() <= self.wide.q.val();
        self.s4_inside_v.d.next = self.cursor_v.q.val() <= self.tall.q.val();
        self.s4_error.d.next = self.s3_error.q.val();
        self.s4_z.d.next = self.s3_z.q.val();
        self.s4_draws.d.next = self.s3_draws.q.val() && self.complete.q.val();
        self.s4_blank.d.next = self.s3_draws.q.val() && !self.complete.q.val();
        if (self.s3_sizes.q.val() && !self.s3_sound.q.val())
            || (self.s3_samples.q.val() && !self.stores.val())
            || (self.s3_draws.q.val() && !self.complete.q.val())
        {
            self.has_failed.d.next = true;
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_intake")
    }
}

latches! { [const C: usize, const H: usize, const E: usize] BisectorIntake<C, H, E>: s1_sizes, s1_samples, s1_draws, s1_width, s1_height, s1_levels, s1_mirrored, s1_error, s1_z, s2_sizes, s2_samples, s2_draws, s2_wide, s2_tall, s2_side, s2_sound, s2_levels, s2_mirrored, s2_error, s2_z, s3_sizes, s3_samples, s3_draws, s3_wide, s3_tall, s3_side, s3_sound, s3_levels, s3_mirrored, s3_error, s3_z, sized, complete, wide, tall, last, map_levels, map_mirrored, cursor_u, cursor_v, s4_draws, s4_blank, s4_write, s4_u, s4_v, s4_inside_u, s4_inside_v, s4_error, s4_z, has_failed }
