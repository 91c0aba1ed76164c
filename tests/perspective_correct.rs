// SPDX-License-Identifier: MIT OR Apache-2.0
//! Perspective correction in hardware: against its golden model, its seams, latency, interval and reset.

use relief_hdl::perspective_correct::PerspectiveCorrect;
use relief_hdl::widths::small;
use relief_testbench::binding::Binding;
use relief_testbench::perspective_correct::PerspectiveCorrectBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

#[test]
fn perspective_correct_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&PerspectiveCorrectBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn perspective_correct_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&PerspectiveCorrectBinding, PerspectiveCorrect::LATENCY);
}

#[test]
fn perspective_correct_reset_drops_what_is_on_its_way() {
    common::reset_empties(&PerspectiveCorrectBinding, PerspectiveCorrect::LATENCY);
}

/// The copies of a seam ask for the same texel: u = 0 on one side, u = period on the other, whatever c is.
#[test]
fn perspective_correct_closes_seams() {
    // texel_bits 9, a period of 512 texels and a clamped axis of 257.
    let beat = |u: u64, v: u64, c: u64| vec![u, v, c, 512, 257, 1, 0, 9, 9];
    let nearness = (0..20_000u64).map(|k| (1 << 31) - 1 - k * 100_000);
    let pairs: Vec<_> = nearness.flat_map(|c| [beat(0, 0, c), beat(c, c / 2, c), beat(c - 1, 0, c)]).collect();
    let mut scoreboard =
        Scoreboard::new(&PerspectiveCorrectBinding, &small::SET, Box::new(pairs.into_iter()), Pattern::NONE);
    let places = ["out_valid", "out_u", "out_v"].map(|name| scoreboard.layout().output(name));
    let mut texels = Vec::new();
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            let [valid, u, v] = places.map(|place| outputs[place]);
            if valid == 1 {
                texels.push((u, v));
            }
            Ok(())
        })
        .unwrap();
    assert_eq!(counts.checked, 60_000);
    assert!(texels.iter().all(|(u, _)| *u == 0), "a seam is open");
    assert!(texels.iter().enumerate().all(|(k, (_, v))| (*v == 256 << 16) == (k % 3 == 1)), "a pole is open");
}

#[test]
fn perspective_correct_refuses_what_no_draw_has() {
    let parse = |numbers: &[i64]| PerspectiveCorrectBinding.parse(&small::SET, numbers);
    assert_eq!(parse(&[-1, 5, 7, 512, 257, 1, 0, 9, 9]), Ok(vec![0xffff_ffff, 5, 7, 512, 257, 1, 0, 9, 9]));
    assert_eq!(parse(&[0, 0, 1, 0, 1, 0, 0, 1, 1]), Err("number 4 is 0, not in 1..=8192".to_owned()));
    assert_eq!(parse(&[0, 0, 1, 1, 1, 0, 0, 1, 16]), Err("number 9 is 16, not in 1..=15".to_owned()));
    assert_eq!(parse(&[0]), Err("the line has 1 numbers, and 9 make a beat".to_owned()));
}
