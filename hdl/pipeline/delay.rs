// SPDX-License-Identifier: MIT OR Apache-2.0
//! Delay lines: small memories that are written round and round, with a register behind each.
//!
//! Sixteen words are what a distributed RAM holds; block RAM is left to others.
//!
//! | port    | format     | meaning |   Latency N, and A + B + C; interval 1
//! | value   | unsigned W | |   Golden: none, it changes nothing
//! | delayed | unsigned W | `value` N cycles of `go` ago; unknown for the first N |

use crate::prelude::*;

/// Delay of values of `W` bits by `N` cycles, 4 <= N <= 17.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Delay<const W: usize, const N: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub value: Input<U<W>>,
    pub delayed: Output<U<W>>,
    /// N - 1 words, of which the last one written is the youngest.
    memory: Ram<U<W>, 4>,
    write_at: Register<U<4>>,
    /// One ahead: the oldest word, which is overwritten next.
    read_at: Register<U<4>>,
    late: DataRegister<U<W>>,
    last: Constant<U<4>>,
}

impl<const W: usize, const N: usize> Default for Delay<W, N> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            value: Input::default(),
            delayed: Output::default(),
            memory: Ram::new(N - 1),
            write_at: Register::default(),
            read_at: Register::new(U::new(1)),
            late: DataRegister::default(),
            last: Constant::new(U::new(N as i64 - 2)),
        }
    }
}

impl<const W: usize, const N: usize> Logic for Delay<W, N> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, memory);
        dff_setup!(self, clock, write_at, read_at, late);
        self.delayed.next = self.late.q.val();
        self.memory.enable.next = self.go.val();
        self.memory.write_enable.next = self.go.val();
        self.memory.write_address.next = self.write_at.q.val();
        self.memory.write_data.next = self.value.val();
        self.memory.read_address.next = self.read_at.q.val();
        if self.go.val() {
            self.write_at.d.next = self.read_at.q.val();
            self.read_at.d.next = self.read_at.q.val() + 1;
            if self.read_at.q.val() == self.last.val() {
                self.read_at.d.next = 0.into();
            }
            self.late.d.next = self.memory.read_data.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("delay_{W}_by_{N}"))
    }
}

latches! { [const W: usize, const N: usize] Delay<W, N>: memory, write_at, read_at, late }

/// Three delays in a row.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct LongDelay<const W: usize, const A: usize, const B: usize, const C: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub value: Input<U<W>>,
    pub delayed: Output<U<W>>,
    first: Delay<W, A>,
    second: Delay<W, B>,
    third: Delay<W, C>,
}

impl<const W: usize, const A: usize, const B: usize, const C: usize> Logic for LongDelay<W, A, B, C> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, first, second, third);
        self.first.go.next = self.go.val();
        self.first.value.next = self.value.val();
        self.second.go.next = self.go.val();
        self.second.value.next = self.first.delayed.val();
        self.third.go.next = self.go.val();
        self.third.value.next = self.second.delayed.val();
        self.delayed.next = self.third.delayed.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("delay_{W}_by_{A}_{B}_{C}"))
    }
}

latches! { [const W: usize, const A: usize, const B: usize, const C: usize] LongDelay<W, A, B, C>: first, second, third }
