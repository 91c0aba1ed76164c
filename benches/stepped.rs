// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cycles a second of the stepped blocks, without waveforms: `cargo bench --bench stepped`.
//!
//! The remesher sweeps random 64-pixel base triangles with nine components, back to back and without stalls.

use divan::counter::ItemsCount;
use relief_hdl::signal::Lanes;
use relief_hdl::widths::{WIDTH_SETS, default};
use relief_testbench::binding::{Random, find};
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;

fn main() {
    divan::main();
}

/// Cycles of one sample.
const CYCLES: usize = 50_000;

#[divan::bench(sample_count = 20)]
fn remesher(bencher: divan::Bencher) {
    let mut random = Random::new(1);
    let mut bench = Stepped::new(default::Remesher::new(default::SET.column_depth));
    bench.block_mut().out_ready.next = true;
    bench.block_mut().in_valid.next = true;
    let mut corner = move || Lanes::new([0; 3].map(|_: i64| random.below(65) as i64));
    let mut steps = 0u64;
    bencher.counter(ItemsCount::new(CYCLES)).bench_local(|| {
        for _ in 0..CYCLES {
            bench.settle();
            if bench.block().in_ready.val() {
                // Taken at the edge behind: the next one stands from the cycle after.
                bench.edge();
                let block = bench.block_mut();
                (block.in_p0.next, block.in_p1.next, block.in_p2.next) = (corner(), corner(), corner());
                block.in_v0.next = Lanes::new([1 << 20; 9]);
                block.in_v1.next = Lanes::new([-(1 << 28); 9]);
                block.in_v2.next = Lanes::new([7; 9]);
            } else {
                steps += u64::from(bench.block().out_valid.val());
                bench.edge();
            }
        }
    });
    assert!(steps > 0, "the remesher has sent no step");
}

/// With the scoreboard: random beats, golden model and comparison included.
#[divan::bench(args = ["vertex_adder", "strip_unit", "remesher"], sample_count = 10)]
fn scoreboard(bencher: divan::Bencher, block: &str) {
    let binding = find(block).expect("a block of the list");
    let set = &WIDTH_SETS[0];
    let beats = if block == "remesher" { 100 } else { 10_000 };
    let run = || {
        let mut board = Scoreboard::new(binding, set, binding.random(set, 1), Pattern::NONE);
        board.run(Until::Accepted(beats), &mut |_, _, _| Ok(())).expect("hardware agrees with golden")
    };
    let cycles = run().cycles as usize;
    bencher.counter(ItemsCount::new(cycles)).bench_local(run);
}
