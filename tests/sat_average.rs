// SPDX-License-Identifier: MIT OR Apache-2.0
//! The mean of a rectangle in hardware: against its golden model, its latency, interval, errors and reset.

use relief_hdl::widths::{WIDTH_SETS, WidthSet, small};
use relief_hdl::with_width_set;
use relief_models::sat_average::{MOST, golden};
use relief_testbench::binding::{Beat, Binding};
use relief_testbench::sat_average::SatAverageBinding;
use relief_testbench::scoreboard::{Counts, Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;

mod common;

#[test]
fn sat_average_matches_golden_under_idle_and_stall() {
    let beats = 5_000;
    for counts in common::matches_golden_everywhere(&SatAverageBinding, beats) {
        // The last one is still on its way when it is accepted.
        assert!(counts.checked >= beats - 1, "{counts:?}");
    }
}

fn run(set: &WidthSet, beats: &[Beat], pattern: Pattern) -> (Counts, bool, u64) {
    let mut scoreboard = Scoreboard::new(&SatAverageBinding, set, Box::new(beats.iter().cloned()), pattern);
    let (_, place) = scoreboard.layout().outputs.iter().find(|(port, _)| port.name == "error").unwrap().clone();
    let (mut error, mut rose) = (false, 0);
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            assert!(!error || outputs[place] == 1, "the error is sticky");
            rose += u64::from(!error && outputs[place] == 1);
            error = outputs[place] == 1;
            Ok(())
        })
        .unwrap_or_else(|mismatch| panic!("{} {pattern:?}: {mismatch}", set.name));
    (counts, error, rose)
}

#[test]
fn sat_average_latency_and_interval_are_its_constant() {
    for set in WIDTH_SETS {
        let latency = with_width_set!(set.name, W => W::SatAverage::LATENCY as u64).unwrap();
        for count in [1, 2, 30] {
            let beats: Vec<Beat> = (0..count).map(|k| vec![1000 * k, k + 1]).collect();
            let (counts, error, _) = run(set, &beats, Pattern::NONE);
            // A beat may go in with the result of the one before it.
            assert_eq!((counts.checked, counts.cycles, error), (count, 1 + count * latency, false), "{}", set.name);
        }
        assert_eq!(SatAverageBinding.latency(), latency.to_string());
        assert_eq!(SatAverageBinding.interval(), latency.to_string());
    }
}

#[test]
fn sat_average_errors_are_sticky_and_come_with_their_beat() {
    let good = [vec![10, 4], vec![65_535, 1], vec![0, 7]];
    for pattern in [Pattern::NONE, Pattern { idle: 30, stall: 50, seed: 2 }] {
        assert!(!run(&small::SET, &good, pattern).1);
        for fault in [vec![10, 0], vec![65_536, 1], vec![(1 << 32) - 1, 1], vec![(512 << 16) - 1, 512]] {
            let beats = [&good[..], std::slice::from_ref(&fault), &good[..]].concat();
            let (counts, error, rose) = run(&small::SET, &beats, pattern);
            assert_eq!((counts.checked, error, rose), (7, true, 1), "{fault:?} {pattern:?}");
        }
    }
    assert_eq!(golden((512 << 16) - 1, 512), (MOST, true));
}

/// Whenever the reset comes, what was on its way is gone, and so is the error.
#[test]
fn sat_average_reset_in_the_middle_of_a_division() {
    let mut unit = Stepped::new(small::SatAverage::default());
    let mut mean = |before: usize, (sum, area): (i32, i32)| {
        unit.block_mut().out_ready.next = true;
        unit.block_mut().in_valid.next = true;
        // An error and its division, broken off.
        unit.block_mut().in_sum.next = 7.into();
        unit.block_mut().in_area.next = 0.into();
        for _ in 0..before {
            unit.edge();
        }
        unit.reset(1 + before % 2);
        unit.block_mut().in_sum.next = sum.into();
        unit.block_mut().in_area.next = area.into();
        for cycle in 0.. {
            unit.settle();
            if unit.block().out_valid.val() {
                assert_eq!((cycle, unit.block().error.val()), (small::SatAverage::LATENCY, false));
                return unit.block().out_mean.val().get();
            }
            unit.edge();
            assert!(cycle < 100, "no mean");
        }
        unreachable!()
    };
    for before in 0..60 {
        assert_eq!(mean(before, (10, 4)), 0x280, "after {before} cycles");
    }
}
