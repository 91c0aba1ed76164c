// SPDX-License-Identifier: MIT OR Apache-2.0
//! The constructs that rust-hdl's own printer translates wrongly without a word: here Rust, Icarus and Verilator agree.
//!
//! One output a construct, all in one block so that each simulator is built once; a mismatch names the output.

mod common;

use common::{Bench, Random, Rng, lint, replay};
use relief_hdl::prelude::*;

#[derive(Copy, Clone, PartialEq, Debug, LogicState)]
enum State {
    Idle,
    Run,
    Done,
}

#[derive(LogicBlock, Default)]
struct Miscompiles {
    state: Input<State>,
    a: Input<U<8>>,
    b: Input<U<8>>,
    sa: Input<S<8>>,
    wide: Input<S<16>>,
    vertex: Input<Lanes<2, 8>>,
    widened_sum: Output<U<9>>,
    widened_not: Output<U<16>>,
    and_equals: Output<Bit>,
    sum_equals: Output<Bit>,
    narrowed_less: Output<Bit>,
    lanes_less: Output<Bit>,
    negative: Output<Bit>,
    guarded: Output<U<2>>,
}

impl Logic for Miscompiles {
    #[hdl_gen]
    fn update(&mut self) {
        self.widened_sum.next = bit_cast_to::<U<9>>(self.a.val() + self.b.val());
        self.widened_not.next = bit_cast_to::<U<16>>(!self.a.val());
        self.and_equals.next = self.a.val() & self.b.val() == self.b.val();
        self.sum_equals.next = self.a.val() + 1 == self.b.val();
        self.narrowed_less.next = bit_cast_to::<S<8>>(self.wide.val()) < self.sa.val();
        self.lanes_less.next = self.vertex.val().get_bit(0) < self.vertex.val().get_bit(1);
        self.negative.next = self.sa.val() < 0;
        self.guarded.next = 0.into();
        match self.state.val() {
            State::Idle => {
                // What a guard would say; the guard itself is refused by the scan of the sources.
                if self.a.val() < self.b.val() {
                    self.guarded.next = 1.into();
                }
            }
            State::Run => {
                self.guarded.next = 2.into();
            }
            State::Done => {}
        }
    }
    fn timing(&self) -> Vec<TimingInfo> {
        module_name("miscompiles")
    }
}

/// What the stock printer's text computes, as measured; the last one is the guard dropped.
fn stock(block: &Miscompiles) -> [i64; 8] {
    let (a, b, sa, wide) = (block.a.val().get(), block.b.val().get(), block.sa.val().get(), block.wide.val().get());
    let [x, y] = block.vertex.val().get().map(|v| v & 0xff);
    let guarded = match block.state.val() {
        State::Idle => 1,
        State::Run => 2,
        State::Done => 0,
    };
    [a + b, a ^ 0xffff, a & 1, (a + 1 == b).into(), (wide < sa).into(), (x < y).into(), 0, guarded]
}

/// What the block says.
fn right(block: &Miscompiles) -> [i64; 8] {
    [
        block.widened_sum.val().get(),
        block.widened_not.val().get(),
        block.and_equals.val().into(),
        block.sum_equals.val().into(),
        block.narrowed_less.val().into(),
        block.lanes_less.val().into(),
        block.negative.val().into(),
        block.guarded.val().get(),
    ]
}

#[test]
fn miscompiled_constructs_agree_in_three_simulators() {
    let mut block = Miscompiles::default();
    let mut bench = Bench::new(&block);
    lint("miscompiles_lint", &bench.emission, &[]);
    let (mut rng, mut differs) = (Rng(5), [0; 8]);
    for row in 0..4096 {
        block.state.next = [State::Idle, State::Run, State::Done][rng.below(3)];
        block.a.next = if row % 16 == 0 { U::MAX } else { U::random(&mut rng) };
        block.b.next = if row % 16 == 0 { U::new(0) } else { U::random(&mut rng) };
        block.sa.next = S::random(&mut rng);
        block.wide.next = S::random(&mut rng);
        block.vertex.next = Lanes::random(&mut rng);
        bench.record(&mut block);
        for (k, (stock, right)) in stock(&block).iter().zip(right(&block)).enumerate() {
            differs[k] += usize::from(*stock != right);
        }
    }
    // The vectors must tell the wrong reading from the right one, or the agreement below would mean nothing.
    assert!(differs.iter().all(|&n| n >= 100), "the vectors do not separate the constructs: {differs:?}");
    assert_eq!(replay("miscompiles", &[bench]), 4096);
}
