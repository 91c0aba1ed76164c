// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lines of the logarithm: where each begins, and minus what it rises by.
//!
//! | port  | format     | meaning |   Latency 1, interval 1; holds while `go` is low
//! | index | unsigned 6 | the line of x in [1 + index / 64, 1 + (index + 1) / 64) |
//! | start | UQ0.24     | log2(1 + index / 64), rounded |
//! | fall  | signed 20  | start less the next one's, above -2^19 units |

use crate::prelude::*;

/// Table of lines.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct LogTable {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub index: Input<U<6>>,
    pub start: Output<U<24>>,
    pub fall: Output<S<20>>,
    /// Start above fall.
    lines: Rom<U<44>, 6>,
}

/// `log2(1 + index / 64)` in 24 fraction bits, rounded: as many square roots of two as go into it, largest first.
fn start(index: u64) -> u64 {
    const ONE: u128 = 1 << 62;
    // What is left is x / product of the roots taken, floor; 30 divisions leave more than 50 bits.
    let (mut left, mut root, mut bits) = (ONE + (u128::from(index) << 56), ONE * 2, 0);
    for _ in 0..31 {
        bits <<= 1;
        if left >= root {
            (left, bits) = ((left << 62) / root, bits + 1);
        }
        root = (root << 62).isqrt();
    }
    // One bit before the point, 30 behind it.
    (bits + (1 << 5)) >> 6
}

fn line(index: u64) -> U<44> {
    let fall = start(index) as i64 - start(index + 1) as i64;
    U::new((start(index) << 20) as i64 | (fall & 0xf_ffff))
}

impl Default for LogTable {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            index: Input::default(),
            start: Output::default(),
            fall: Output::default(),
            lines: Rom::new("relief_log_lines", (0..64).map(line).collect()),
        }
    }
}

impl LogTable {
    /// Cycles from index to line.
    pub const LATENCY: usize = 1;
}

impl Logic for LogTable {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, lines);
        self.lines.enable.next = self.go.val();
        self.lines.read_address.next = self.index.val();
        self.start.next = self.lines.read_data.val().get_bits::<24>(20);
        self.fall.next = bit_cast_to::<S<20>>(self.lines.read_data.val().get_bits::<20>(0));
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("log_table")
    }
}

latches! { [] LogTable: lines }
