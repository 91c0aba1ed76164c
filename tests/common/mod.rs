// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the tests of the blocks share: the matrix of idle cycles, backpressure and width sets.

use rayon::prelude::*;
use relief_hdl::widths::WIDTH_SETS;
use relief_testbench::binding::{Binding, offered_sets};
use relief_testbench::device::Stage;
use relief_testbench::scoreboard::{Counts, Pattern, Scoreboard, Until};

/// Compares `beats` random input beats of `block` with its golden model, bit for bit, at every width set that has it, with and
/// without idle cycles and backpressure. Asserts that all of them were accepted, and gives the counts of each run.
pub fn matches_golden_everywhere(block: &dyn Binding, beats: u64) -> Vec<Counts> {
    let patterns = [(0, 0), (0, 50), (30, 0), (30, 50)];
    let sets = offered_sets(block);
    let runs: Vec<_> = sets.iter().flat_map(|set| patterns.map(|pattern| (*set, pattern))).collect();
    // The design of all blocks is offered at three.
    assert!(sets.len() >= 3, "{} is offered at {} sets", block.name(), sets.len());
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

/// A block that sends one beat for each that it takes: the first result stands `latency` cycles behind its beat, and
/// beats follow each other without a gap.
#[allow(dead_code)]
pub fn is_a_straight_pipeline(block: &dyn Binding, latency: usize) {
    let (set, latency) = (&WIDTH_SETS[0], latency as u64);
    assert_eq!((block.latency(), block.interval()), (latency.to_string().as_str(), "1"));
    for beats in [1, 2, 1000] {
        let mut scoreboard = Scoreboard::new(block, set, block.random(set, 1), Pattern::NONE);
        let counts = scoreboard.run(Until::Accepted(beats), &mut |_, _, _| Ok(())).unwrap();
        assert_eq!((counts.checked, counts.cycles), (beats, beats + latency), "{}", block.name());
    }
}

/// Whenever a reset comes to such a block, what was on its way is gone, and what comes next is right and in time.
#[allow(dead_code)]
pub fn reset_empties(block: &dyn Binding, latency: usize) {
    let set = &WIDTH_SETS[0];
    for before in 0..latency + 4 {
        let mut stage = Stage::new(block.device(set));
        let (mut beats, mut model) = (block.random(set, 3), block.model(set));
        // The sink takes nothing from the middle on, so that the reset meets a second result that waits.
        for cycle in 0..before {
            stage.inputs[stage.layout.out_ready] = u64::from(cycle % 2 == 0);
            stage.offer(&beats.next().unwrap());
            stage.settle();
            stage.device.edge();
        }
        stage.device.reset(1 + before % 2);
        stage.inputs[stage.layout.out_ready] = 1;
        let beat = beats.next().unwrap();
        stage.offer(&beat);
        for cycle in 0..=latency {
            stage.settle();
            assert_eq!(stage.sends(), cycle == latency, "{}: {before} cycles, then {cycle}", block.name());
            stage.device.edge();
            stage.withdraw();
        }
        let mut expected = Vec::new();
        model.accept(&beat, &mut expected);
        assert_eq!(stage.sent(), expected[0].words, "{} after {before} cycles", block.name());
    }
}
