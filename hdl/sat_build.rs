// SPDX-License-Identifier: MIT OR Apache-2.0
//! Builds the summed-area table of a map, a texel a cycle (Crow 1984).
//!
//! `SAT[y][x] = (map[y-1][0] + .. + map[y-1][x-1]) + SAT[y-1][x]  mod 2^B`; row 0 and column 0 are zero and never sent
//!
//! | port      | format     | meaning |   Latency 2, interval 1
//! | in_kind   | 1 bit      | 0 size, 1 texel, in raster order   Golden: models::sat_build::SatBuild   Error 0 mod 2^B
//! | in_width, in_height | unsigned M | of the map, at least one; a row fits the line buffer | size
//! | in_value  | UQ16.0     | the texel | texel
//! | out_x, out_y | unsigned M | 1 ..= width, 1 ..= height
//! | out_sum   | B bits     | wraps
//! | out_last  | Bit        | the last one of the map
//! | error     | Bit        | sticky: a size of nothing or of too long rows (forgotten), a size before the map was
//! complete (begins the new map), a texel without a size (dropped)
//!
//! Example: the map (1, 2; 3, 4) gives 1, 3, 4, 10. The row before stands in a block RAM of 2^K sums.

use crate::prelude::*;

/// Builder for sides below 2^M, rows of up to 2^K texels, sums of `B` bits.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct SatBuild<const M: usize, const K: usize, const B: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<1>>,
    pub in_width: Input<U<M>>,
    pub in_height: Input<U<M>>,
    pub in_value: Input<U<16>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_x: Output<U<M>>,
    pub out_y: Output<U<M>>,
    pub out_sum: Output<U<B>>,
    pub out_last: Output<Bit>,
    pub error: Output<Bit>,
    line: Ram<U<B>, K>,
    active: Register<Bit>,
    width: DataRegister<U<M>>,
    height: DataRegister<U<M>>,
    column: DataRegister<U<M>>,
    row: DataRegister<U<M>>,
    s1_valid: Register<Bit>,
    s1_fails: Register<Bit>,
    s1_first_row: DataRegister<Bit>,
    s1_row_sum: DataRegister<U<B>>,
    s1_column: DataRegister<U<M>>,
    s1_row: DataRegister<U<M>>,
    s1_last: DataRegister<Bit>,
    s2_valid: Register<Bit>,
    s2_x: DataRegister<U<M>>,
    s2_y: DataRegister<U<M>>,
    s2_sum: DataRegister<U<B>>,
    s2_last: DataRegister<Bit>,
    failed: Register<Bit>,
    go: Wire<Bit>,
    size: Wire<Bit>,
    texel: Wire<Bit>,
    fit: Wire<U<M>>,
    wide: Wire<U<M>>,
    sound: Wire<Bit>,
    last_column: Wire<Bit>,
    last_row: Wire<Bit>,
    so_far: Wire<U<B>>,
    above: Wire<U<B>>,
    sum: Wire<U<B>>,
}

impl<const M: usize, const K: usize, const B: usize> SatBuild<M, K, B> {
    /// Cycles from a texel to its sum.
    pub const LATENCY: usize = 2;
}

impl<const M: usize, const K: usize, const B: usize> Logic for SatBuild<M, K, B> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, line);
        dff_setup!(self, clock, active, width, height, column, row, s1_valid, s1_fails, s1_first_row, s1_row_sum);
        dff_setup!(self, clock, s1_column, s1_row, s1_last, s2_valid, s2_x, s2_y, s2_sum, s2_last, failed);
        self.go.next = !self.s2_valid.q.val() || self.out_ready.val();
        self.in_ready.next = self.go.val();
        self.out_valid.next = self.s2_valid.q.val();
        self.out_x.next = self.s2_x.q.val();
        self.out_y.next = self.s2_y.q.val();
        self.out_sum.next = self.s2_sum.q.val();
        self.out_last.next = self.s2_last.q.val();
        self.error.next = self.failed.q.val();

        // s1_row_sum: the texels of the row so far, while the sum above is read.
        self.size.next = self.go.val() && self.in_valid.val() && self.in_kind.val() == 0;
        self.texel.next = self.go.val() && self.in_valid.val() && self.in_kind.val() == 1;
        // A row fits the line buffer if its last column is an address.
        self.wide.next = self.in_width.val() - 1;
        self.fit.next = bit_cast_to::<U<M>>(bit_cast_to::<U<K>>(self.wide.val()));
        self.sound.next = self.in_width.val() != 0 && self.in_height.val() != 0 && self.fit.val() == self.wide.val();
        self.last_column.next = self.column.q.val() + 1 == self.width.q.val();
        self.last_row.next = self.row.q.val() + 1 == self.height.q.val();
        self.so_far.next = self.s1_row_sum.q.val();
        if self.column.q.val() == 0 {
            self.so_far.next = 0.into();
        }
        self.line.enable.next = self.texel.val();
        self.line.read_address.next = bit_cast_to::<U<K>>(self.column.q.val());
        if self.size.val() {
            self.active.d.next = self.sound.val();
            self.width.d.next = self.in_width.val();
            self.height.d.next = self.in_height.val();
            self.column.d.next = 0.into();
            self.row.d.next = 0.into();
        }
        if self.texel.val() && self.active.q.val() {
            self.s1_row_sum.d.next = self.so_far.val() + bit_cast_to::<U<B>>(self.in_value.val());
            self.s1_first_row.d.next = self.row.q.val() == 0;
            self.s1_column.d.next = self.column.q.val();
            self.s1_row.d.next = self.row.q.val();
            self.s1_last.d.next = self.last_column.val() && self.last_row.val();
            self.column.d.next = self.column.q.val() + 1;
            if self.last_column.val() {
                self.column.d.next = 0.into();
                self.row.d.next = self.row.q.val() + 1;
                if self.last_row.val() {
                    self.active.d.next = false;
                }
            }
        }

        // s2_sum: and the sum above. A row of one texel reads it in the very cycle in which it is written.
        self.above.next = self.line.read_data.val();
        if self.width.q.val() == 1 {
            self.above.next = self.s2_sum.q.val();
        }
        if self.s1_first_row.q.val() {
            self.above.next = 0.into();
        }
        self.sum.next = self.s1_row_sum.q.val() + self.above.val();
        self.line.write_enable.next = self.go.val() && self.s1_valid.q.val();
        self.line.write_address.next = bit_cast_to::<U<K>>(self.s1_column.q.val());
        self.line.write_data.next = self.sum.val();
        if self.go.val() {
            self.s1_valid.d.next = self.texel.val() && self.active.q.val();
            self.s1_fails.d.next = (self.texel.val() && !self.active.q.val())
                || (self.size.val() && (self.active.q.val() || !self.sound.val()));
            self.s2_valid.d.next = self.s1_valid.q.val();
            if self.s1_fails.q.val() {
                self.failed.d.next = true;
            }
        }
        if self.go.val() && self.s1_valid.q.val() {
            self.s2_x.d.next = self.s1_column.q.val() + 1;
            self.s2_y.d.next = self.s1_row.q.val() + 1;
            self.s2_sum.d.next = self.sum.val();
            self.s2_last.d.next = self.s1_last.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sat_build")
    }
}

ports! {
    [const M: usize, const K: usize, const B: usize] SatBuild<M, K, B> {
        inputs: in_valid, in_kind, in_width, in_height, in_value, out_ready;
        outputs: in_ready, out_valid, out_x, out_y, out_sum, out_last, error;
        blocks:;
        state: line, active, width, height, column, row, s1_valid, s1_fails, s1_first_row, s1_row_sum, s1_column, s1_row, s1_last, s2_valid, s2_x, s2_y, s2_sum, s2_last, failed
    }
}
