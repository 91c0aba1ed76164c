// SPDX-License-Identifier: MIT OR Apache-2.0
//! One axis of a rectangle, cut or slid at the border.
//!
//! | port          | format    |   Latency 5, 1 for `outside`; holds while `go` is low
//! | corner, size  | signed 18 | size >= 0   Example: corner -1, size 3, side 5: 0 .. 2 cut, 0 .. 3 slid
//! | side, slide   | signed 18, Bit | side >= 0   Golden: models::sat_fetch::span   Error 0
//! | load          | Bit       | the corner is an entry of the table instead, 1 ..= side
//! | blank         | Bit       | there is no map: both are 0
//! | first, behind | signed 14 | 0 ..= side: the entries to be subtracted and added
//! | outside       | Bit       | a load of no entry
//!
//! | stage     | what it does                                                              |
//! | s2_sums   | the end of the rectangle, and what the side leaves free                   |
//! | s3_kept   | the size that is kept, the farthest corner, and whether the end is beyond |
//! | s4_cut    | the end cut, and whether the corner is beyond                             |
//! | s5_moved  | the corner moved inside                                                   |
//! | s6_ends   | both ends                                                                 |

use crate::prelude::*;

/// Axis of a rectangle.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct SatSpan {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub corner: Input<S<18>>,
    pub size: Input<S<18>>,
    pub side: Input<S<18>>,
    pub slide: Input<Bit>,
    pub load: Input<Bit>,
    pub blank: Input<Bit>,
    pub first: Output<S<14>>,
    pub behind: Output<S<14>>,
    pub outside: Output<Bit>,
    s2_corner: DataRegister<S<18>>,
    s2_size: DataRegister<S<18>>,
    s2_side: DataRegister<S<18>>,
    s2_sum: DataRegister<S<18>>,
    s2_spare: DataRegister<S<18>>,
    s2_slide: DataRegister<Bit>,
    s2_load: DataRegister<Bit>,
    s2_blank: DataRegister<Bit>,
    s2_low: DataRegister<Bit>,
    s2_high: DataRegister<Bit>,
    s3_corner: DataRegister<S<18>>,
    s3_side: DataRegister<S<18>>,
    s3_sum: DataRegister<S<18>>,
    s3_kept: DataRegister<S<18>>,
    s3_most: DataRegister<S<18>>,
    s3_beyond: DataRegister<Bit>,
    s3_slide: DataRegister<Bit>,
    s3_load: DataRegister<Bit>,
    s3_blank: DataRegister<Bit>,
    s4_corner: DataRegister<S<18>>,
    s4_most: DataRegister<S<18>>,
    s4_beyond: DataRegister<Bit>,
    s4_kept: DataRegister<S<18>>,
    s4_reached: DataRegister<S<18>>,
    s4_slide: DataRegister<Bit>,
    s4_blank: DataRegister<Bit>,
    s5_moved: DataRegister<S<18>>,
    s5_kept: DataRegister<S<18>>,
    s5_reached: DataRegister<S<18>>,
    s5_slide: DataRegister<Bit>,
    s5_blank: DataRegister<Bit>,
    s6_first: DataRegister<S<14>>,
    s6_behind: DataRegister<S<14>>,
    spare: Wire<U<18>>,
    ending: Wire<U<18>>,
    at: Wire<U<18>>,
    kept: Wire<S<18>>,
    most: Wire<S<18>>,
    cut: Wire<S<18>>,
    moved: Wire<S<18>>,
    reached: Wire<S<18>>,
}

impl Logic for SatSpan {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s2_corner, s2_size, s2_side, s2_sum, s2_spare, s2_slide, s2_load, s2_blank, s2_low);
        dff_setup!(self, clock, s2_high, s3_corner, s3_side, s3_sum, s3_kept, s3_most, s3_beyond, s3_slide, s3_load);
        dff_setup!(self, clock, s3_blank, s4_corner, s4_most, s4_beyond, s4_kept, s4_reached, s4_slide, s4_blank);
        dff_setup!(self, clock, s5_moved, s5_kept, s5_reached, s5_slide, s5_blank, s6_first, s6_behind);

        // s2_sums: corners have 15 bits and sizes 13 at most.
        if self.go.val() {
            self.s2_corner.d.next = self.corner.val();
            self.s2_size.d.next = self.size.val();
            self.s2_side.d.next = self.side.val();
            self.s2_sum.d.next = self.corner.val() + self.size.val();
            self.s2_spare.d.next = self.side.val() - self.size.val();
            self.s2_slide.d.next = self.slide.val();
            self.s2_load.d.next = self.load.val();
            self.s2_blank.d.next = self.blank.val();
            self.s2_low.d.next = self.corner.val() < 1;
            self.s2_high.d.next = self.corner.val() > self.side.val();
        }
        self.outside.next = self.s2_load.q.val() && (self.s2_low.q.val() || self.s2_high.q.val());

        // s3_kept: a size beyond the side is the side. Bit 17 is the sign.
        self.spare.next = bit_cast_to::<U<18>>(self.s2_spare.q.val());
        self.kept.next = self.s2_size.q.val();
        self.most.next = self.s2_spare.q.val();
        if self.spare.val().get_bit(17) {
            self.kept.next = self.s2_side.q.val();
            self.most.next = 0.into();
        }
        if !self.s2_slide.q.val() {
            self.most.next = self.s2_side.q.val();
        }
        if self.go.val() {
            self.s3_corner.d.next = self.s2_corner.q.val();
            self.s3_side.d.next = self.s2_side.q.val();
            self.s3_sum.d.next = self.s2_sum.q.val();
            self.s3_kept.d.next = self.kept.val();
            self.s3_most.d.next = self.most.val();
            self.s3_beyond.d.next = self.s2_sum.q.val() > self.s2_side.q.val();
            self.s3_slide.d.next = self.s2_slide.q.val() && !self.s2_load.q.val();
            self.s3_load.d.next = self.s2_load.q.val();
            self.s3_blank.d.next = self.s2_blank.q.val();
        }

        // s4_cut: a load is what it is.
        self.ending.next = bit_cast_to::<U<18>>(self.s3_sum.q.val());
        self.cut.next = self.s3_sum.q.val();
        if self.s3_beyond.q.val() {
            self.cut.next = self.s3_side.q.val();
        }
        if self.ending.val().get_bit(17) {
            self.cut.next = 0.into();
        }
        if self.s3_load.q.val() {
            self.cut.next = self.s3_corner.q.val();
        }
        if self.go.val() {
            self.s4_corner.d.next = self.s3_corner.q.val();
            self.s4_most.d.next = self.s3_most.q.val();
            self.s4_beyond.d.next = self.s3_corner.q.val() > self.s3_most.q.val();
            self.s4_kept.d.next = self.s3_kept.q.val();
            self.s4_reached.d.next = self.cut.val();
            self.s4_slide.d.next = self.s3_slide.q.val();
            self.s4_blank.d.next = self.s3_blank.q.val();
        }

        // s5_moved
        self.at.next = bit_cast_to::<U<18>>(self.s4_corner.q.val());
        self.moved.next = self.s4_corner.q.val();
        if self.s4_beyond.q.val() {
            self.moved.next = self.s4_most.q.val();
        }
        if self.at.val().get_bit(17) {
            self.moved.next = 0.into();
        }
        if self.go.val() {
            self.s5_moved.d.next = self.moved.val();
            self.s5_kept.d.next = self.s4_kept.q.val();
            self.s5_reached.d.next = self.s4_reached.q.val();
            self.s5_slide.d.next = self.s4_slide.q.val();
            self.s5_blank.d.next = self.s4_blank.q.val();
        }

        // s6_ends: at most the side.
        self.reached.next = self.s5_reached.q.val();
        if self.s5_slide.q.val() {
            self.reached.next = self.s5_moved.q.val() + self.s5_kept.q.val();
        }
        if self.go.val() {
            self.s6_first.d.next = bit_cast_to::<S<14>>(self.s5_moved.q.val());
            self.s6_behind.d.next = bit_cast_to::<S<14>>(self.reached.val());
            if self.s5_blank.q.val() {
                self.s6_first.d.next = 0.into();
                self.s6_behind.d.next = 0.into();
            }
        }
        self.first.next = self.s6_first.q.val();
        self.behind.next = self.s6_behind.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sat_span")
    }
}

latches! { [] SatSpan: s2_corner, s2_size, s2_side, s2_sum, s2_spare, s2_slide, s2_load, s2_blank, s2_low, s2_high, s3_corner, s3_side, s3_sum, s3_kept, s3_most, s3_beyond, s3_slide, s3_load, s3_blank, s4_corner, s4_most, s4_beyond, s4_kept, s4_reached, s4_slide, s4_blank, s5_moved, s5_kept, s5_reached, s5_slide, s5_blank, s6_first, s6_behind }
