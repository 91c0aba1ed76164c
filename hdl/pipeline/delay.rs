// SPDX-License-Identifier: MIT OR Apache-2.0
//! Delay lines: small memories that are written round and round, with a register behind each.
//!
//! Sixteen words are what a distributed RAM holds; block RAM is left to others.
//!
//! | block           | latency   | of         |   Interval 1; golden: none, they change nothing
//! | Delay           | N         | unsigned W |
//! | LongDelay       | A + B + C | unsigned W |
//! | FarDelay        | 8 A + B   | unsigned W |
//! | VectorDelay     | N         | 3 x signed W |
//! | LongVectorDelay | A + B + C | 3 x signed W |
//!
//! `delayed` is `value` so many cycles of `go` ago; unknown for the first ones.

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

/// Nine delays in a row.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct FarDelay<const W: usize, const A: usize, const B: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub value: Input<U<W>>,
    pub delayed: Output<U<W>>,
    first: LongDelay<W, A, A, A>,
    second: LongDelay<W, A, A, A>,
    third: LongDelay<W, A, A, B>,
}

impl<const W: usize, const A: usize, const B: usize> Logic for FarDelay<W, A, B> {
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
        module_name(format!("delay_{W}_by_8_times_{A}_{B}"))
    }
}

latches! { [const W: usize, const A: usize, const B: usize] FarDelay<W, A, B>: first, second, third }

/// Delay of a vector.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct VectorDelay<const W: usize, const N: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub value: Input<Lanes<3, W>>,
    pub delayed: Output<Lanes<3, W>>,
    lane_0: Delay<W, N>,
    lane_1: Delay<W, N>,
    lane_2: Delay<W, N>,
    in_0: Wire<S<W>>,
    in_1: Wire<S<W>>,
    in_2: Wire<S<W>>,
    out_0: Wire<S<W>>,
    out_1: Wire<S<W>>,
    out_2: Wire<S<W>>,
    one: Wire<Lanes<3, W>>,
    two: Wire<Lanes<3, W>>,
}

impl<const W: usize, const N: usize> Logic for VectorDelay<W, N> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, lane_0, lane_1, lane_2);
        self.in_0.next = self.value.val().get_bit(0);
        self.in_1.next = self.value.val().get_bit(1);
        self.in_2.next = self.value.val().get_bit(2);
        self.lane_0.go.next = self.go.val();
        self.lane_0.value.next = bit_cast_to::<U<W>>(self.in_0.val());
        self.lane_1.go.next = self.go.val();
        self.lane_1.value.next = bit_cast_to::<U<W>>(self.in_1.val());
        self.lane_2.go.next = self.go.val();
        self.lane_2.value.next = bit_cast_to::<U<W>>(self.in_2.val());
        self.out_0.next = bit_cast_to::<S<W>>(self.lane_0.delayed.val());
        self.out_1.next = bit_cast_to::<S<W>>(self.lane_1.delayed.val());
        self.out_2.next = bit_cast_to::<S<W>>(self.lane_2.delayed.val());
        self.one.next = bit_cast_to::<Lanes<3, W>>(self.out_0.val());
        self.two.next = self.one.val().replace_bit(1, self.out_1.val());
        self.delayed.next = self.two.val().replace_bit(2, self.out_2.val());
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("delay_3x{W}_by_{N}"))
    }
}

latches! { [const W: usize, const N: usize] VectorDelay<W, N>: lane_0, lane_1, lane_2 }

/// Three delays of a vector in a row.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct LongVectorDelay<const W: usize, const A: usize, const B: usize, const C: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub value: Input<Lanes<3, W>>,
    pub delayed: Output<Lanes<3, W>>,
    first: VectorDelay<W, A>,
    second: VectorDelay<W, B>,
    third: VectorDelay<W, C>,
}

impl<const W: usize, const A: usize, const B: usize, const C: usize> Logic for LongVectorDelay<W, A, B, C> {
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
        module_name(format!("delay_3x{W}_by_{A}_{B}_{C}"))
    }
}

latches! { [const W: usize, const A: usize, const B: usize, const C: usize] LongVectorDelay<W, A, B, C>: first, second, third }
