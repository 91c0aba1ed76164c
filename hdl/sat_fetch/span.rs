// SPDX-License-Identifier: MIT OR Apache-2.0
//! One axis of a rectangle, cut or slid at the border. Combinational.
//!
//! | port          | format    |   Golden: models::sat_fetch::span   Error 0
//! | corner, size  | signed 18 | size >= 0   Example: corner -1, size 3, side 5: 0 .. 2 cut, 0 .. 3 slid
//! | side, slide   | signed 18, Bit | side >= 0
//! | load          | Bit       | the corner is an entry of the table instead, 1 ..= side
//! | first, behind | signed 14 | 0 ..= side: the entries to be subtracted and added
//! | outside       | Bit       | a load of no entry

use crate::prelude::*;

/// Axis of a rectangle.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct SatSpan {
    pub corner: Input<S<18>>,
    pub size: Input<S<18>>,
    pub side: Input<S<18>>,
    pub slide: Input<Bit>,
    pub load: Input<Bit>,
    pub first: Output<S<14>>,
    pub behind: Output<S<14>>,
    pub outside: Output<Bit>,
    kept: Wire<S<18>>,
    most: Wire<S<18>>,
    moved: Wire<S<18>>,
    sum: Wire<S<18>>,
    reached: Wire<S<18>>,
}

impl Logic for SatSpan {
    #[hdl_gen]
    fn update(&mut self) {
        self.kept.next = self.size.val();
        if self.size.val() > self.side.val() {
            self.kept.next = self.side.val();
        }
        self.most.next = self.side.val();
        if self.slide.val() {
            self.most.next = self.side.val() - self.kept.val();
        }
        self.moved.next = self.corner.val();
        if self.corner.val() < 0 {
            self.moved.next = 0.into();
        } else if self.corner.val() > self.most.val() {
            self.moved.next = self.most.val();
        }
        // Corners have 15 bits and sizes 13 at most.
        self.sum.next = self.corner.val() + self.size.val();
        self.reached.next = self.sum.val();
        if self.slide.val() {
            self.reached.next = self.moved.val() + self.kept.val();
        } else if self.sum.val() < 0 {
            self.reached.next = 0.into();
        } else if self.sum.val() > self.side.val() {
            self.reached.next = self.side.val();
        }
        self.outside.next = self.load.val() && (self.corner.val() < 1 || self.corner.val() > self.side.val());
        self.first.next = bit_cast_to::<S<14>>(self.moved.val());
        self.behind.next = bit_cast_to::<S<14>>(self.reached.val());
        if self.load.val() {
            self.behind.next = bit_cast_to::<S<14>>(self.corner.val());
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sat_span")
    }
}
