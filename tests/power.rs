// SPDX-License-Identifier: MIT OR Apache-2.0
//! The power in hardware: against its golden model, for every number, its latency, interval and reset.

use relief_hdl::power::Power;
use relief_hdl::widths::small;
use relief_testbench::binding::Binding;
use relief_testbench::power::PowerBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

#[test]
fn power_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&PowerBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

/// Every number, with exponents of every size.
#[test]
fn power_matches_golden_for_every_number() {
    let beats = [1, 2, 7, 24, 128, 255].into_iter().flat_map(|n| (0..=1 << 16).map(move |x| vec![x, n]));
    let mut scoreboard = Scoreboard::new(&PowerBinding, &small::SET, Box::new(beats), Pattern::NONE);
    let counts = scoreboard.run(Until::Exhausted, &mut |_, _, _| Ok(())).unwrap();
    assert_eq!(counts.checked, 6 * 65_537);
}

#[test]
fn power_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&PowerBinding, Power::LATENCY);
}

#[test]
fn power_reset_drops_what_is_on_its_way() {
    common::reset_empties(&PowerBinding, Power::LATENCY);
}

#[test]
fn power_refuses_what_is_above_one() {
    let parse = |numbers: &[i64]| PowerBinding.parse(&small::SET, numbers);
    assert_eq!(parse(&[65536, 255]), Ok(vec![65536, 255]));
    assert_eq!(parse(&[65537, 1]), Err("number 1 is 65537, not in 0..=65536".to_owned()));
    assert_eq!(parse(&[0, 0]), Err("number 2 is 0, not in 1..=255".to_owned()));
}
