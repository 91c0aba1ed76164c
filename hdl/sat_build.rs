// SPDX-License-Identifier: MIT OR Apache-2.0
//! Builds the summed-area table of a map, a texel a cycle (Crow 1984).
//!
//! `SAT[y][x] = (map[y-1][0] + .. + map[y-1][x-1]) + SAT[y-1][x]  mod 2^B`; row 0 and column 0 are zero and never sent
//!
//! | port      | format     | meaning |   Latency 3, interval 1
//! | in_kind   | 1 bit      | 0 size, 1 texel, in raster order   Golden: models::sat_build::SatBuild   Error 0 mod 2^B
//! | in_width, in_height | unsigned M | of the map, at least one; a row fits the line buffer | size
//! | in_value  | UQ16.0     | the texel | texel
//! | out_x, out_y | unsigned M | 1 ..= width, 1 ..= height
//! | out_sum   | B bits     | wraps
//! | out_last  | Bit        | the last one of the map
//! | error     | Bit        | sticky: a size of nothing or of too long rows (forgotten), a size before the map was
//! complete (begins the new map), a texel without a size (dropped)
//!
//! Example: the map (1, 2; 3, 4) gives 1, 3, 4, 10. The row before stands in a block RAM of 2^K sums,
//! with a register behind it; of rows so short that a sum is needed before it stands there, it comes from the stages.

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
    // The last column and row, those behind the present ones, and whether these are the last.
    end_x: DataRegister<U<M>>,
    end_y: DataRegister<U<M>>,
    column: DataRegister<U<M>>,
    row: DataRegister<U<M>>,
    next_column: DataRegister<U<M>>,
    next_row: DataRegister<U<M>>,
    last_column: DataRegister<Bit>,
    last_row: DataRegister<Bit>,
    s1_valid: Register<Bit>,
    s1_fails: Register<Bit>,
    s1_row_sum: DataRegister<U<B>>,
    s1_column: DataRegister<U<M>>,
    s1_row: DataRegister<U<M>>,
    s1_last: DataRegister<Bit>,
    s1_first_row: DataRegister<Bit>,
    // The sum above is that of the last texel, of the one before it, or of the one before that.
    s1_first: DataRegister<Bit>,
    s1_second: DataRegister<Bit>,
    s1_third: DataRegister<Bit>,
    s2_valid: Register<Bit>,
    s2_fails: Register<Bit>,
    s2_row_sum: DataRegister<U<B>>,
    s2_column: DataRegister<U<M>>,
    s2_row: DataRegister<U<M>>,
    s2_last: DataRegister<Bit>,
    s2_above: DataRegister<U<B>>,
    s2_forward: DataRegister<U<B>>,
    s2_recent: DataRegister<U<B>>,
    s2_forwards: DataRegister<Bit>,
    s2_first: DataRegister<Bit>,
    s3_valid: Register<Bit>,
    s3_column: DataRegister<U<M>>,
    s3_x: DataRegister<U<M>>,
    s3_y: DataRegister<U<M>>,
    s3_sum: DataRegister<U<B>>,
    s3_last: DataRegister<Bit>,
    failed: Register<Bit>,
    go: Wire<Bit>,
    size: Wire<Bit>,
    texel: Wire<Bit>,
    fit: Wire<U<M>>,
    wide: Wire<U<M>>,
    tall: Wire<U<M>>,
    sound: Wire<Bit>,
    so_far: Wire<U<B>>,
    address: Wire<U<K>>,
    written: Wire<U<K>>,
    meets: Wire<Bit>,
    forward: Wire<U<B>>,
    above: Wire<U<B>>,
    sum: Wire<U<B>>,
}

impl<const M: usize, const K: usize, const B: usize> SatBuild<M, K, B> {
    /// Cycles from a texel to its sum.
    pub const LATENCY: usize = 3;
}

impl<const M: usize, const K: usize, const B: usize> Logic for SatBuild<M, K, B> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, line);
        dff_setup!(self, clock, active, end_x, end_y, column, row, next_column, next_row, last_column, last_row);
        dff_setup!(self, clock, s1_valid, s1_fails, s1_row_sum, s1_column, s1_row, s1_last, s1_first_row, s1_first);
        dff_setup!(self, clock, s1_second, s1_third, s2_valid, s2_fails, s2_row_sum, s2_column, s2_row, s2_last);
        dff_setup!(self, clock, s2_above, s2_forward, s2_recent, s2_forwards, s2_first, s3_valid, s3_column, s3_x);
        dff_setup!(self, clock, s3_y, s3_sum, s3_last, failed);
        self.go.next = !self.s3_valid.q.val() || self.out_ready.val();
        self.in_ready.next = self.go.val();
        self.out_valid.next = self.s3_valid.q.val();
        self.out_x.next = self.s3_x.q.val();
        self.out_y.next = self.s3_y.q.val();
        self.out_sum.next = self.s3_sum.q.val();
        self.out_last.next = self.s3_last.q.val();
        self.error.next = self.failed.q.val();

        // s1_row_sum: the texels of the row so far, while the sum above is read.
        self.size.next = self.go.val() && self.in_valid.val() && self.in_kind.val() == 0;
        self.texel.next = self.go.val() && self.in_valid.val() && self.in_kind.val() == 1;
        // A row fits the line buffer if its last column is an address.
        self.wide.next = self.in_width.val() - 1;
        self.tall.next = self.in_height.val() - 1;
        self.fit.next = bit_cast_to::<U<M>>(bit_cast_to::<U<K>>(self.wide.val()));
        self.sound.next = self.in_width.val() != 0 && self.in_height.val() != 0 && self.fit.val() == self.wide.val();
        self.so_far.next = self.s1_row_sum.q.val();
        if self.column.q.val() == 0 {
            self.so_far.next = 0.into();
        }
        // A sum that is written now would be read as it was: it is not read at all, so that synthesis sees that the ports
        // never meet, and puts nothing behind the RAM.
        self.address.next = bit_cast_to::<U<K>>(self.column.q.val());
        self.written.next = bit_cast_to::<U<K>>(self.s3_column.q.val());
        self.meets.next = self.s3_valid.q.val() && self.written.val() == self.address.val();
        self.line.enable.next = self.texel.val() && !self.meets.val();
        self.line.read_address.next = self.address.val();
        if self.size.val() {
            self.active.d.next = self.sound.val();
            self.end_x.d.next = self.wide.val();
            self.end_y.d.next = self.tall.val();
            self.column.d.next = 0.into();
            self.row.d.next = 0.into();
            self.next_column.d.next = 1.into();
            self.next_row.d.next = 1.into();
            self.last_column.d.next = self.in_width.val() == 1;
            self.last_row.d.next = self.in_height.val() == 1;
        }
        if self.texel.val() && self.active.q.val() {
            self.s1_row_sum.d.next = self.so_far.val() + bit_cast_to::<U<B>>(self.in_value.val());
            self.s1_column.d.next = self.column.q.val();
            self.s1_row.d.next = self.row.q.val();
            self.s1_last.d.next = self.last_column.q.val() && self.last_row.q.val();
            self.s1_first_row.d.next = self.row.q.val() == 0;
            self.s1_first.d.next = self.s1_valid.q.val() && self.s1_column.q.val() == self.column.q.val();
            self.s1_second.d.next = self.s2_valid.q.val() && self.s2_column.q.val() == self.column.q.val();
            self.s1_third.d.next = self.meets.val();
            self.column.d.next = self.next_column.q.val();
            self.next_column.d.next = self.next_column.q.val() + 1;
            self.last_column.d.next = self.next_column.q.val() == self.end_x.q.val();
            if self.last_column.q.val() {
                self.column.d.next = 0.into();
                self.next_column.d.next = 1.into();
                self.last_column.d.next = self.end_x.q.val() == 0;
                self.row.d.next = self.next_row.q.val();
                self.next_row.d.next = self.next_row.q.val() + 1;
                self.last_row.d.next = self.next_row.q.val() == self.end_y.q.val();
                if self.last_row.q.val() {
                    self.active.d.next = false;
                }
            }
        }

        // s2_above: the sum above, as the line buffer has it, and as the stages have it: 0 in the first row, the sum that
        // is written now, or the one that was written before it.
        self.forward.next = self.s3_sum.q.val();
        if !self.s1_second.q.val() {
            self.forward.next = self.s2_recent.q.val();
        }
        if self.s1_first_row.q.val() {
            self.forward.next = 0.into();
        }
        if self.go.val() {
            self.s1_valid.d.next = self.texel.val() && self.active.q.val();
            self.s1_fails.d.next = (self.texel.val() && !self.active.q.val())
                || (self.size.val() && (self.active.q.val() || !self.sound.val()));
            self.s2_valid.d.next = self.s1_valid.q.val();
            self.s2_fails.d.next = self.s1_fails.q.val();
            self.s2_row_sum.d.next = self.s1_row_sum.q.val();
            self.s2_column.d.next = self.s1_column.q.val();
            self.s2_row.d.next = self.s1_row.q.val();
            self.s2_last.d.next = self.s1_last.q.val();
            self.s2_above.d.next = self.line.read_data.val();
            self.s2_forward.d.next = self.forward.val();
            self.s2_recent.d.next = self.s3_sum.q.val();
            self.s2_first.d.next = self.s1_first.q.val() && !self.s1_first_row.q.val();
            self.s2_forwards.d.next = self.s1_second.q.val() || self.s1_third.q.val() || self.s1_first_row.q.val();
        }

        // s3_sum: both, and a cycle later into the line buffer.
        self.above.next = self.s2_above.q.val();
        if self.s2_forwards.q.val() {
            self.above.next = self.s2_forward.q.val();
        }
        if self.s2_first.q.val() {
            self.above.next = self.s3_sum.q.val();
        }
        self.sum.next = self.s2_row_sum.q.val() + self.above.val();
        self.line.write_enable.next = self.go.val() && self.s3_valid.q.val();
        self.line.write_address.next = self.written.val();
        self.line.write_data.next = self.s3_sum.q.val();
        if self.go.val() {
            self.s3_valid.d.next = self.s2_valid.q.val();
            if self.s2_fails.q.val() {
                self.failed.d.next = true;
            }
        }
        if self.go.val() && self.s2_valid.q.val() {
            self.s3_column.d.next = self.s2_column.q.val();
            self.s3_x.d.next = self.s2_column.q.val() + 1;
            self.s3_y.d.next = self.s2_row.q.val() + 1;
            self.s3_sum.d.next = self.sum.val();
            self.s3_last.d.next = self.s2_last.q.val();
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
        state: line, active, end_x, end_y, column, row, next_column, next_row, last_column, last_row, s1_valid, s1_fails, s1_row_sum, s1_column, s1_row, s1_last, s1_first_row, s1_first, s1_second, s1_third, s2_valid, s2_fails, s2_row_sum, s2_column, s2_row, s2_last, s2_above, s2_forward, s2_recent, s2_forwards, s2_first, s3_valid, s3_column, s3_x, s3_y, s3_sum, s3_last, failed
    }
}
