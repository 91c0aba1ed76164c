// SPDX-License-Identifier: MIT OR Apache-2.0
//! The filter level in hardware: against its golden model, its thresholds, levels, latency, interval and reset.

use relief_hdl::filter_level::FilterLevel;
use relief_hdl::widths::small;
use relief_models::filter_level::{Constants, footprint};
use relief_models::perspective_correct::inverse;
use relief_testbench::binding::Binding;
use relief_testbench::filter_level::FilterLevelBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

#[test]
fn filter_level_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&FilterLevelBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn filter_level_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&FilterLevelBinding, FilterLevel::LATENCY);
}

#[test]
fn filter_level_reset_drops_what_is_on_its_way() {
    common::reset_empties(&FilterLevelBinding, FilterLevel::LATENCY);
}

/// Thresholds, reached by the footprint to the unit and missed by one: there the level rises, and nowhere else.
#[test]
fn filter_level_rises_where_a_threshold_is_reached() {
    let (lane, c) = (1 << 30, 1 << 30);
    let threshold = |k: u32| ((1u64 << (33 + 2 * k)).isqrt() + 1) as u32;
    let mut beats = Vec::new();
    for k in 1..8 {
        // B is 2^27, all but some units: a unit of the scale is one of the footprint at most.
        let of = |scale| footprint(&Constants { scale, shift: 34 - k, levels: 16 }, lane, inverse(c));
        let all: Vec<u32> = (1 << 23..1 << 24).collect();
        let scale = all[all.partition_point(|scale| of(*scale) < threshold(k))];
        assert_eq!((of(scale - 1), of(scale)), (threshold(k) - 1, threshold(k)));
        beats.extend([scale - 1, scale].map(|scale| vec![lane as u64, c as u64, scale.into(), (34 - k).into(), 16]));
    }
    let mut scoreboard = Scoreboard::new(&FilterLevelBinding, &small::SET, Box::new(beats.into_iter()), Pattern::NONE);
    let places = ["out_valid", "out_level"].map(|name| scoreboard.layout().output(name));
    let mut levels = Vec::new();
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            levels.extend((outputs[places[0]] == 1).then(|| outputs[places[1]]));
            Ok(())
        })
        .unwrap();
    assert_eq!(levels, (1..8).flat_map(|k| [k - 1, k]).collect::<Vec<_>>());
}

/// All levels come, and the last one is kept to.
#[test]
fn filter_level_reaches_every_level() {
    let beats = FilterLevelBinding.random(&small::SET, 8).take(20_000);
    let mut scoreboard = Scoreboard::new(&FilterLevelBinding, &small::SET, Box::new(beats), Pattern::NONE);
    let places = ["out_valid", "out_level", "out_footprint"].map(|name| scoreboard.layout().output(name));
    let (mut levels, mut saturated) = ([0; 16], 0);
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            let [valid, level, footprint] = places.map(|place| outputs[place]);
            if valid == 1 {
                levels[level as usize] += 1;
                saturated += u64::from(footprint == u64::from(u32::MAX));
            }
            Ok(())
        })
        .unwrap();
    assert!(levels.iter().all(|count| *count > 20) && saturated > 100, "{levels:?}, {saturated} saturated");
}

#[test]
fn filter_level_refuses_what_no_draw_has() {
    let parse = |numbers: &[i64]| FilterLevelBinding.parse(&small::SET, numbers);
    assert_eq!(parse(&[-1, 7, 1 << 23, 63, 10]), Ok(vec![0xffff_ffff, 7, 1 << 23, 63, 10]));
    assert_eq!(parse(&[0, 1, 1 << 24, 0, 1]), Err("number 3 is 16777216, not in 0..=16777215".to_owned()));
    assert_eq!(parse(&[0, 1, 0, 0, 0]), Err("number 5 is 0, not in 1..=31".to_owned()));
}
