// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random kernels, written by `build.rs`: Rust, Icarus and Verilator agree on every output.

#![allow(unused_parens, clippy::all)] // Generated code.

mod common;

use common::{Bench, Dut, Random, Rng, lint, replay};
use relief_hdl::prelude::*;

#[derive(Copy, Clone, PartialEq, Debug, LogicState)]
enum FuzzState {
    A,
    B,
    C,
}

impl Random for FuzzState {
    fn random(rng: &mut Rng) -> Self {
        [FuzzState::A, FuzzState::B, FuzzState::C][rng.below(3)]
    }
}

include!(concat!(env!("OUT_DIR"), "/fuzz_kernels.rs"));

const ROWS: usize = 1000;

#[test]
fn fuzz_kernels_agree_in_three_simulators() {
    println!("seed {SEED}; another one: RELIEF_FUZZ_SEED=<number>");
    let mut rng = Rng(SEED);
    let mut benches = vec![];
    for mut kernel in kernels() {
        let mut bench = Bench::new(&*kernel);
        // Random kernels compare a signal with itself; everything else must be as clean as a block's text.
        lint("fuzz_lint", &bench.emission, &["-Wno-CMPCONST", "-Wno-UNSIGNED"]);
        for _ in 0..ROWS {
            kernel.randomize(&mut rng);
            bench.record(&mut *kernel);
        }
        benches.push(bench);
    }
    let rows = replay("fuzz", &benches);
    assert_eq!(rows, ROWS * kernels().len());
}
