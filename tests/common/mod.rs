// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the tests of the blocks share: the matrix of idle cycles, backpressure and width sets.

use rayon::prelude::*;
use relief_hdl::widths::WIDTH_SETS;
use relief_testbench::binding::Binding;
use relief_testbench::scoreboard::{Counts, Pattern, Scoreboard, Until};

/// Compares `beats` random input beats of `block` with its golden model, bit for bit, at every width set, with and
/// without idle cycles and backpressure. Asserts that all of them were accepted, and gives the counts of each run.
pub fn matches_golden_everywhere(block: &dyn Binding, beats: u64) -> Vec<Counts> {
    let patterns = [(0, 0), (0, 50), (30, 0), (30, 50)];
    let runs: Vec<_> = WIDTH_SETS.iter().flat_map(|set| patterns.map(|pattern| (set, pattern))).collect();
    assert_eq!(runs.len(), 4 * WIDTH_SETS.len());
    let run = |(at, (set, (idle, stall)))| {
        let seed = 1000 + at as u64;
        let pattern = Pattern { idle, stall, seed };
        let mut scoreboard = Scoreboard::new(block, set, block.random(set, seed), pattern);
        let counts = scoreboard
            .run(Until::Accepted(beats), &mut |_, _, _| Ok(()))
            .unwrap_or_else(|mismatch| panic!("{} at {}, {pattern:?}: {mismatch}", block.name(), set.name));
        assert_eq!(counts.accepted, beats, "{} at {}, {pattern:?}", block.name(), set.name);
        assert!(counts.checked > 0, "{} at {}, {pattern:?} sent nothing", block.name(), set.name);
        counts
    };
    runs.into_par_iter().enumerate().map(run).collect()
}
