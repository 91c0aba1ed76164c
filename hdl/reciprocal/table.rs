// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lines of the reciprocal: where each begins and how far it falls.
//!
//! | port  | format     | meaning |   Latency 2, interval 1: the table, and a register in front of the multiplier
//! | index | unsigned 7 | the line of x in [1 + index / 128, 1 + (index + 1) / 128) |
//! | start | UQ0.20     | half of the line's sag below 1 / x at its beginning |
//! | fall  | UQ0.20     | below 2^13 units |

use crate::prelude::*;

/// Table of lines.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct ReciprocalTable {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub index: Input<U<7>>,
    pub start: Output<U<20>>,
    pub fall: Output<U<13>>,
    /// Start above fall.
    lines: Rom<U<33>, 7>,
    line: DataRegister<U<33>>,
}

/// Where line `index` begins and what it falls by, 20 fraction bits, from 36 fraction bits of 1 / x.
fn line(index: u64) -> U<33> {
    let reciprocal = |x: u64, scale: u32| (1u64 << (43 + scale)) / x;
    let (start, end) = (reciprocal(128 + index, 0), reciprocal(129 + index, 0));
    let middle = reciprocal(2 * (128 + index) + 1, 1);
    let sag = u64::midpoint(start, end) - middle;
    let round = |value: u64| (value + (1 << 15)) >> 16;
    // Even where it begins at 1.0, half the sag takes a start below 2^20 after rounding.
    U::new((round(start - sag / 2) << 13 | round(start - end)) as i64)
}

impl Default for ReciprocalTable {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            index: Input::default(),
            start: Output::default(),
            fall: Output::default(),
            lines: Rom::new("relief_reciprocal_lines", (0..128).map(line).collect()),
            line: DataRegister::default(),
        }
    }
}

impl ReciprocalTable {
    /// Cycles from index to line.
    pub const LATENCY: usize = 2;
}

impl Logic for ReciprocalTable {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, lines);
        dff_setup!(self, clock, line);
        self.start.next = self.line.q.val().get_bits::<20>(13);
        self.fall.next = self.line.q.val().get_bits::<13>(0);
        self.lines.enable.next = self.go.val();
        self.lines.read_address.next = self.index.val();
        if self.go.val() {
            self.line.d.next = self.lines.read_data.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("reciprocal_table")
    }
}

latches! { [] ReciprocalTable: lines, line }
