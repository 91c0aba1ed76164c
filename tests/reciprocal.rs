// SPDX-License-Identifier: MIT OR Apache-2.0
//! The reciprocal in hardware: against its golden model, at both ends of every line and every step along it, its latency,
//! interval and reset.

use relief_hdl::reciprocal::Reciprocal;
use relief_hdl::widths::small;
use relief_testbench::binding::{Beat, Binding};
use relief_testbench::reciprocal::ReciprocalBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

#[test]
fn reciprocal_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&ReciprocalBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

/// The table has 128 lines of 2,048 steps: between two of them only Newton's step moves.
#[test]
fn reciprocal_matches_golden_at_both_ends_of_every_step() {
    let ends = (1u64 << 18..1 << 19).flat_map(|step| [vec![step << 13], vec![(step << 13) + (1 << 13) - 1]]);
    let mut scoreboard = Scoreboard::new(&ReciprocalBinding, &small::SET, Box::new(ends), Pattern::NONE);
    let counts = scoreboard.run(Until::Exhausted, &mut |_, _, _| Ok(())).unwrap();
    assert_eq!(counts.checked, 2 << 18);
}

#[test]
fn reciprocal_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&ReciprocalBinding, Reciprocal::LATENCY);
}

#[test]
fn reciprocal_reset_drops_what_is_on_its_way() {
    common::reset_empties(&ReciprocalBinding, Reciprocal::LATENCY);
}

#[test]
fn reciprocal_refuses_what_is_not_normalised() {
    let parse = |number| ReciprocalBinding.parse(&small::SET, &[number]);
    assert_eq!(parse(0xC000_0000), Ok(Beat::from([0xC000_0000])));
    assert_eq!(parse(7), Err("number 1 (m) is 7, below 2147483648".to_owned()));
    assert_eq!(parse(1 << 32), Err("number 1 (m) is 4294967296, which does not fit 0..=4294967295".to_owned()));
}
