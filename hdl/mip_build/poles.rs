// SPDX-License-Identifier: MIT OR Apache-2.0
//! The extrema of the rows that are poles: at every level row 0, and the rows from `last >> level` on, `last` being the
//! last row of the map.
//!
//! A pole row goes into pole rows of the level above only, and an extremum does not change if some of its values become
//! their own extremum. So the levels are folded as if there were no poles, and only what is sent is replaced: by the
//! extremum of all texels that the pole rows cover, taken while the level below streams by.
//!
//! | port     | format     |   Latency 2   Interval 1   Golden: models::mip_build::golden_with_poles   Error 0
//! | size     | Bit        | begins a map of `height` rows
//! | advance  | Bit        | begins the next level
//! | take     | Bit        | a texel of this level, with its place
//! | max, min | UQ16.0     | the texel
//! | busy     | Bit        | the last texel is not yet taken in; never so with `advance`
//! | pole_max, pole_min | UQ16.0 | what the pole of this row is; of the map itself, once it has been taken
//! | in_pole  | Bit        | this row is one of a pole
//! | map_last | unsigned M | the first row of the lower pole, on the map its last row

use crate::prelude::*;

/// Extrema of the poles, for sides below 2^M.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct MipPoles<const M: usize> {
    pub clock: Input<ClockReset>,
    pub size: Input<Bit>,
    pub height: Input<U<M>>,
    pub advance: Input<Bit>,
    pub take: Input<Bit>,
    pub on_map: Input<Bit>,
    pub cells: Input<Bit>,
    pub row: Input<U<M>>,
    /// The row is of the upper pole, or of the lower one.
    pub in_upper: Input<Bit>,
    pub in_lower: Input<Bit>,
    pub max: Input<U<16>>,
    pub min: Input<U<16>>,
    pub in_pole: Output<Bit>,
    pub pole_max: Output<U<16>>,
    pub pole_min: Output<U<16>>,
    pub map_last: Output<U<M>>,
    pub busy: Output<Bit>,
    // s1_texel: the texel, and the poles that it belongs to.
    s1_take: Register<Bit>,
    s1_max: DataRegister<U<16>>,
    s1_min: DataRegister<U<16>>,
    s1_upper: DataRegister<Bit>,
    s1_lower: DataRegister<Bit>,
    s1_next_upper: DataRegister<Bit>,
    s1_next_lower: DataRegister<Bit>,
    /// First row of the lower pole.
    lower_row: DataRegister<U<M>>,
    // The poles of this level, and of the next one as far as it is known.
    upper_max: DataRegister<U<16>>,
    upper_min: DataRegister<U<16>>,
    lower_max: DataRegister<U<16>>,
    lower_min: DataRegister<U<16>>,
    next_upper_max: DataRegister<U<16>>,
    next_upper_min: DataRegister<U<16>>,
    next_lower_max: DataRegister<U<16>>,
    next_lower_min: DataRegister<U<16>>,
    row_above: Wire<U<M>>,
    lower_above: Wire<U<M>>,
}

impl<const M: usize> Logic for MipPoles<M> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, lower_row, upper_max, upper_min, lower_max, lower_min);
        dff_setup!(self, clock, next_upper_max, next_upper_min, next_lower_max, next_lower_min);
        dff_setup!(self, clock, s1_take, s1_max, s1_min, s1_upper, s1_lower, s1_next_upper, s1_next_lower);
        self.busy.next = self.s1_take.q.val();
        self.map_last.next = self.lower_row.q.val();
        // Where both poles are one row, it is the lower one's, which covers the upper one.
        self.in_pole.next = self.in_lower.val() || self.in_upper.val();
        self.pole_max.next = self.upper_max.q.val();
        self.pole_min.next = self.upper_min.q.val();
        if self.in_lower.val() {
            self.pole_max.next = self.lower_max.q.val();
            self.pole_min.next = self.lower_min.q.val();
        }
        // The last row of nodes, or the row of cells, above this row: below 2^(M-1) + 1.
        self.row_above.next = self.row.val() >> 1;
        if !self.cells.val() {
            self.row_above.next = (self.row.val() + 1) >> 1;
        }
        self.lower_above.next = self.lower_row.q.val() >> 1;
        self.s1_take.d.next = self.take.val();
        self.s1_max.d.next = self.max.val();
        self.s1_min.d.next = self.min.val();
        self.s1_upper.d.next = self.on_map.val() && self.in_upper.val();
        self.s1_lower.d.next = self.on_map.val() && self.in_lower.val();
        self.s1_next_upper.d.next = self.row.val() < 2;
        self.s1_next_lower.d.next = self.row_above.val() >= self.lower_above.val();
        if self.s1_take.q.val() {
            if self.s1_next_upper.q.val() {
                if self.s1_max.q.val() > self.next_upper_max.q.val() {
                    self.next_upper_max.d.next = self.s1_max.q.val();
                }
                if self.s1_min.q.val() < self.next_upper_min.q.val() {
                    self.next_upper_min.d.next = self.s1_min.q.val();
                }
            }
            if self.s1_next_lower.q.val() {
                if self.s1_max.q.val() > self.next_lower_max.q.val() {
                    self.next_lower_max.d.next = self.s1_max.q.val();
                }
                if self.s1_min.q.val() < self.next_lower_min.q.val() {
                    self.next_lower_min.d.next = self.s1_min.q.val();
                }
            }
            if self.s1_upper.q.val() {
                if self.s1_max.q.val() > self.upper_max.q.val() {
                    self.upper_max.d.next = self.s1_max.q.val();
                }
                if self.s1_min.q.val() < self.upper_min.q.val() {
                    self.upper_min.d.next = self.s1_min.q.val();
                }
            }
            if self.s1_lower.q.val() {
                if self.s1_max.q.val() > self.lower_max.q.val() {
                    self.lower_max.d.next = self.s1_max.q.val();
                }
                if self.s1_min.q.val() < self.lower_min.q.val() {
                    self.lower_min.d.next = self.s1_min.q.val();
                }
            }
        }
        if self.advance.val() {
            self.lower_row.d.next = self.lower_above.val();
            self.upper_max.d.next = self.next_upper_max.q.val();
            self.upper_min.d.next = self.next_upper_min.q.val();
            self.lower_max.d.next = self.next_lower_max.q.val();
            self.lower_min.d.next = self.next_lower_min.q.val();
        }
        if self.size.val() {
            self.lower_row.d.next = self.height.val() - 1;
            self.upper_max.d.next = 0.into();
            self.upper_min.d.next = 65_535.into();
            self.lower_max.d.next = 0.into();
            self.lower_min.d.next = 65_535.into();
        }
        if self.size.val() || self.advance.val() {
            self.next_upper_max.d.next = 0.into();
            self.next_upper_min.d.next = 65_535.into();
            self.next_lower_max.d.next = 0.into();
            self.next_lower_min.d.next = 65_535.into();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_poles")
    }
}

latches! { [const M: usize] MipPoles<M>: s1_take, s1_max, s1_min, s1_upper, s1_lower, s1_next_upper, s1_next_lower, lower_row, upper_max, upper_min, lower_max, lower_min, next_upper_max, next_upper_min, next_lower_max, next_lower_min }
