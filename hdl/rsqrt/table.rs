// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lines of the reciprocal root: where each begins and how far it falls.
//!
//! | port  | format     | meaning |   Latency 2, interval 1: the table, and a register in front of the multiplier
//! | index | unsigned 7 | x from 1 + i / 64 on for i < 64, and from 2 + (i - 64) / 32 on above |
//! | start | UQ0.18     | half of the line's sag below 1 / sqrt(x) at its beginning |
//! | fall  | UQ0.18     | below 2^11 units |

use crate::prelude::*;

/// Table of lines.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct RootTable {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub index: Input<U<7>>,
    pub start: Output<U<18>>,
    pub fall: Output<U<11>>,
    /// Start above fall.
    lines: Rom<U<29>, 7>,
    line: DataRegister<U<29>>,
}

/// Where line `index` begins and what it falls by, 18 fraction bits, from 36 fraction bits of 1 / sqrt(x).
fn line(index: u128) -> U<29> {
    let octave = index / 64;
    let place = 64 + index % 64;
    // x = halves 2^octave / 128: 2^36 / sqrt(x) = sqrt(2^79 / (halves 2^octave)).
    let at = |halves: u128| (((1u128 << 79) >> octave) / halves).isqrt() as u64;
    let (start, middle, end) = (at(2 * place), at(2 * place + 1), at(2 * place + 2));
    let sag = u64::midpoint(start, end) - middle;
    let round = |value: u64| (value + (1 << 17)) >> 18;
    // Even where it begins at 1.0, half the sag takes a start below 2^18 after rounding.
    U::new((round(start - sag / 2) << 11 | round(start - end)) as i64)
}

impl Default for RootTable {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            index: Input::default(),
            start: Output::default(),
            fall: Output::default(),
            lines: Rom::new("relief_root_lines", (0..128).map(line).collect()),
            line: DataRegister::default(),
        }
    }
}

impl RootTable {
    /// Cycles from index to line.
    pub const LATENCY: usize = 2;
}

impl Logic for RootTable {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, lines);
        dff_setup!(self, clock, line);
        self.start.next = self.line.q.val().get_bits::<18>(11);
        self.fall.next = self.line.q.val().get_bits::<11>(0);
        self.lines.enable.next = self.go.val();
        self.lines.read_address.next = self.index.val();
        if self.go.val() {
            self.line.d.next = self.lines.read_data.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("root_table")
    }
}

latches! { [] RootTable: lines, line }
