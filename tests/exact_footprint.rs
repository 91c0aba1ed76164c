// SPDX-License-Identifier: MIT OR Apache-2.0
//! The exact footprint in hardware: against its golden model, its latency, interval and reset, every level, and where it is
//! known.

use relief_hdl::widths::{WIDTH_SETS, WidthSet, default, small};
use relief_testbench::binding::{Beat, Binding};
use relief_testbench::exact_footprint::{ExactFootprintBinding, Step};
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

const LATENCY: usize = default::ExactFootprint::LATENCY;
const INTERVAL: usize = default::ExactFootprint::INTERVAL;

/// Levels and footprints of beats.
fn found(set: &WidthSet, beats: impl Iterator<Item = Beat> + 'static) -> Vec<(u64, u64)> {
    let mut scoreboard = Scoreboard::new(&ExactFootprintBinding, set, Box::new(beats), Pattern::NONE);
    let places = ["out_valid", "out_level", "out_footprint"].map(|name| scoreboard.layout().output(name));
    let mut found = Vec::new();
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            let [valid, level, footprint] = places.map(|place| outputs[place]);
            found.extend((valid == 1).then_some((level, footprint)));
            Ok(())
        })
        .unwrap();
    found
}

#[test]
fn exact_footprint_matches_golden_under_idle_and_stall() {
    let beats = 2_500;
    for counts in common::matches_golden_everywhere(&ExactFootprintBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

/// Without a stall the first level comes after the latency, and each of the others an interval behind the one before.
#[test]
fn exact_footprint_latency_and_interval_are_its_constants() {
    let (block, set) = (&ExactFootprintBinding, &WIDTH_SETS[0]);
    assert_eq!((block.latency(), block.interval()), (LATENCY.to_string().as_str(), INTERVAL.to_string().as_str()));
    for beats in [1, 2, 300] {
        let mut scoreboard = Scoreboard::new(block, set, block.random(set, 1), Pattern::NONE);
        let counts = scoreboard.run(Until::Accepted(beats), &mut |_, _, _| Ok(())).unwrap();
        let cycles = LATENCY as u64 + (beats - 1) * INTERVAL as u64 + 1;
        assert_eq!((counts.checked, counts.cycles), (beats, cycles));
    }
}

#[test]
fn exact_footprint_reset_drops_what_is_on_its_way() {
    common::reset_empties(&ExactFootprintBinding, LATENCY);
}

/// All levels come, the last one is kept to, and footprints are saturated, 0, and all between.
#[test]
fn exact_footprint_reaches_every_level() {
    for set in [&default::SET, &small::SET] {
        let found = found(set, ExactFootprintBinding.random(set, 8).take(10_000));
        let count = |test: &dyn Fn(u64, u64) -> bool| found.iter().filter(|(l, f)| test(*l, *f)).count();
        let levels: Vec<usize> = (0..16).map(|level| count(&|l, _| l == level)).collect();
        assert!(levels.iter().all(|count| *count > 10), "{}: {levels:?}", set.name);
        let ends = [count(&|_, f| f == 0), count(&|_, f| f == u64::from(u32::MAX))];
        assert!(ends.iter().all(|count| *count > 10), "{}: {ends:?}", set.name);
        // From an eighth of a texel on.
        let lengths: Vec<usize> = (13..32).map(|bits| count(&|_, f| f >> (bits - 1) == 1)).collect();
        assert!(lengths.iter().all(|count| *count > 10), "{}: {lengths:?}", set.name);
    }
}

/// The larger axis counts, both differences do, and what stands still has no footprint; everywhere less by a unit or two.
#[test]
fn exact_footprint_of_what_is_known() {
    for set in [&default::SET, &small::SET] {
        let (half, texels) = (1i64 << (set.vertex_bits - 2), 1i64 << (set.vertex_bits + set.guard_bits - 2 - 11));
        let with = |sweep, side| Step {
            lanes: [half / 2, half / 4, half],
            differences: [sweep, side],
            texel_bits: [11, 10],
            levels: 9,
        };
        // c = 1/2, u = 1/2, v = 1/4: a texel of u a step, and a half of one of v.
        let still = [0; 3];
        let steps = [
            (with(still, still), 0, 0),
            (with([2 * texels, 0, 0], still), 0, 2),
            (with(still, [0, 6 * texels, 0]), 1, 3),
            (with([4 * texels, 0, 0], [-4 * texels, 0, 0]), 2, 8),
            (with([64 * texels, 0, 0], [8 * texels, 256 * texels, 0]), 6, 128),
            // c alone moves u by a half of it; with half as much of u, it stands still.
            (with([0, 0, 8 * texels], still), 1, 4),
            (with([4 * texels, 2 * texels, 8 * texels], still), 0, 0),
            (Step { levels: 2, ..with([0, 0, 8192 * texels / 16], still) }, 1, 256),
        ];
        let found = found(set, steps.map(|(step, ..)| step.beat(set)).into_iter());
        for ((step, level, footprint), got) in steps.iter().zip(&found) {
            let below = footprint << 16;
            assert_eq!(got.0, *level, "{}: {step:?} {got:x?}", set.name);
            assert!(got.1 <= below && got.1 + (below >> 14) + 2 > below, "{}: {step:?} {got:x?}", set.name);
        }
        assert_eq!(found.len(), steps.len());
    }
}

#[test]
fn exact_footprint_refuses_what_no_draw_has() {
    let set = &small::SET;
    let parse = |numbers: &[i64]| ExactFootprintBinding.parse(set, numbers);
    let good = [1, -2, 3, 4, -5, 6, -7, 8, -9, 10, 11, 12];
    let step = Step { lanes: [1, -2, 3], differences: [[4, -5, 6], [-7, 8, -9]], texel_bits: [10, 11], levels: 12 };
    assert_eq!(parse(&good), Ok(step.beat(set)));
    assert_eq!(parse(&good[..11]), Err("the line has 11 numbers, and 12 make a beat".to_owned()));
    let with = |at: usize, number: i64| {
        let mut numbers = good;
        numbers[at] = number;
        parse(&numbers).unwrap_err()
    };
    assert_eq!(with(2, 1 << 23), "number 3 is 8388608, not in -8388608..=8388607");
    assert_eq!(with(8, 1 << 34), "number 9 is 17179869184, not in -17179869184..=17179869183");
    assert_eq!(with(9, 0), "number 10 is 0, not in 1..=15");
    assert_eq!(with(11, 0), "number 12 is 0, not in 1..=31");
}
