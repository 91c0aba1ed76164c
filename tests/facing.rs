// SPDX-License-Identifier: MIT OR Apache-2.0
//! Facing in hardware: against its golden model, where the sign hangs on a unit, its latency, interval and reset.

use relief_hdl::facing::Facing;
use relief_hdl::widths::small;
use relief_testbench::binding::Binding;
use relief_testbench::facing::FacingBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

#[test]
fn facing_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&FacingBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn facing_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&FacingBinding, Facing::LATENCY);
}

#[test]
fn facing_reset_drops_what_is_on_its_way() {
    common::reset_empties(&FacingBinding, Facing::LATENCY);
}

/// Both answers come, and the largest factors of either sign; S = 0 is away, S = -1 is not.
#[test]
fn facing_decides_at_zero_and_at_the_ends() {
    let (most, least) = (i64::from(i32::MAX), i64::from(i32::MIN));
    let lines = [
        ([0, 0, 0, 0, 0, 0], 1),
        ([0, 0, -1, 0, 0, 4096], 0),
        ([0, 0, -1, 0, 0, 4095], 1),
        ([least, least, least, least, least, u32::MAX.into()], 0),
        ([least, least, least, least, least, 0], 1),
        ([most, most, least, least, least, u32::MAX.into()], 0),
        ([least, least, most, least, least, u32::MAX.into()], 1),
        // 5 (-3) + 2 (-1) + f, f from 16 on.
        ([5, 2, 1, -3 << 14, -1 << 14, 16 << 12], 0),
        ([5, 2, 1, -3 << 14, -1 << 14, 17 << 12], 1),
    ];
    let beats: Vec<_> = lines.iter().map(|(line, _)| FacingBinding.parse(&small::SET, line).unwrap()).collect();
    let mut scoreboard = Scoreboard::new(&FacingBinding, &small::SET, Box::new(beats.into_iter()), Pattern::NONE);
    let [valid, away] = ["out_valid", "out_away"].map(|name| scoreboard.layout().output(name));
    let mut answers = Vec::new();
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            answers.extend((outputs[valid] == 1).then_some(outputs[away]));
            Ok(())
        })
        .unwrap();
    assert_eq!(answers, lines.map(|(_, away)| away));
}
