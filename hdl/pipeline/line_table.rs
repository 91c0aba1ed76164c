// SPDX-License-Identifier: MIT OR Apache-2.0
//! A function as straight lines: where each begins, and how far it rises or falls.
//!
//! | port  | format      | meaning |   Latency 2, interval 1: the table, and a register in front of the multiplier
//! | index | unsigned I  | the line |
//! | start | unsigned B  | its beginning |
//! | slope | unsigned R  | how far it goes until its end; which way is the reader's business |
//!
//! Widths tell tables apart: each function has an alias with its own, and a `Default` that fills it. Two of the same widths
//! do not compile.

use crate::prelude::*;

/// Table of 2^I lines.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct LineTable<const I: usize, const B: usize, const R: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub index: Input<U<I>>,
    pub start: Output<U<B>>,
    pub slope: Output<U<R>>,
    starts: Rom<U<B>, I>,
    slopes: Rom<U<R>, I>,
    s2_start: DataRegister<U<B>>,
    s2_slope: DataRegister<U<R>>,
}

impl<const I: usize, const B: usize, const R: usize> LineTable<I, B, R> {
    /// Cycles from index to line.
    pub const LATENCY: usize = 2;

    /// The table with start and slope of each line as `line` has them; its contents are emitted as `<name>_starts.hex` and
    /// `<name>_slopes.hex`.
    pub(crate) fn new(name: &str, line: impl Fn(u64) -> (u64, u64)) -> Self {
        let (starts, slopes): (Vec<u64>, Vec<u64>) = (0..1 << I).map(line).unzip();
        assert!(
            starts.iter().all(|start| start >> B == 0) && slopes.iter().all(|slope| slope >> R == 0),
            "{name}: too long"
        );
        Self {
            clock: Input::default(),
            go: Input::default(),
            index: Input::default(),
            start: Output::default(),
            slope: Output::default(),
            starts: Rom::new(&format!("{name}_starts"), starts.into_iter().map(|start| U::new(start as i64)).collect()),
            slopes: Rom::new(&format!("{name}_slopes"), slopes.into_iter().map(|slope| U::new(slope as i64)).collect()),
            s2_start: DataRegister::default(),
            s2_slope: DataRegister::default(),
        }
    }
}

impl<const I: usize, const B: usize, const R: usize> Logic for LineTable<I, B, R> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, starts, slopes);
        dff_setup!(self, clock, s2_start, s2_slope);
        self.start.next = self.s2_start.q.val();
        self.slope.next = self.s2_slope.q.val();
        self.starts.enable.next = self.go.val();
        self.starts.read_address.next = self.index.val();
        self.slopes.enable.next = self.go.val();
        self.slopes.read_address.next = self.index.val();
        if self.go.val() {
            self.s2_start.d.next = self.starts.read_data.val();
            self.s2_slope.d.next = self.slopes.read_data.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("lines_{I}_{B}_{R}"))
    }
}

latches! { [const I: usize, const B: usize, const R: usize] LineTable<I, B, R>: starts, slopes, s2_start, s2_slope }
