// SPDX-License-Identifier: MIT OR Apache-2.0
//! Culling in hardware: against its golden model, all its verdicts, latency, interval and reset.

use relief_hdl::cull::Cull;
use relief_hdl::widths::small;
use relief_testbench::binding::Binding;
use relief_testbench::cull::CullBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use std::collections::BTreeMap;

mod common;

#[test]
fn cull_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&CullBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn cull_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&CullBinding, Cull::LATENCY);
}

#[test]
fn cull_reset_drops_what_is_on_its_way() {
    common::reset_empties(&CullBinding, Cull::LATENCY);
}

/// Verdicts and reasons of triangles, one after another.
fn verdicts(beats: Vec<Vec<u64>>) -> Vec<[u64; 2]> {
    let mut scoreboard = Scoreboard::new(&CullBinding, &small::SET, Box::new(beats.into_iter()), Pattern::NONE);
    let places = ["out_valid", "out_verdict", "out_reason"].map(|name| scoreboard.layout().output(name));
    let mut all = Vec::new();
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            let [valid, verdict, reason] = places.map(|place| outputs[place]);
            all.extend((valid == 1).then_some([verdict, reason]));
            Ok(())
        })
        .unwrap();
    all
}

/// Every verdict comes with every reason, and nothing else does.
#[test]
fn cull_gives_every_verdict() {
    let mut counts = BTreeMap::new();
    for verdict in verdicts(CullBinding.random(&small::SET, 8).take(20_000).collect()) {
        *counts.entry(verdict).or_insert(0) += 1;
    }
    let culled = (0..6).map(|side| [1, side]);
    let expected: Vec<_> = [[0, 0]].into_iter().chain(culled).chain([[2, 0], [3, 1], [3, 2]]).collect();
    assert_eq!(counts.keys().copied().collect::<Vec<_>>(), expected);
    assert!(counts.values().all(|count| *count > 500), "{counts:?}");
}

/// Each side alone, each plane at each corner, and the order of the decisions.
#[test]
fn cull_decides_in_its_order() {
    let mut beats = Vec::new();
    let mut expected = Vec::new();
    for side in 0..6 {
        let code = 1 << side;
        beats.push(vec![code, code, code, 1, 2, 0, 3, 1, 0, 1]);
        expected.push([1, side]);
        beats.push(vec![code, code, 0, 0, 0, 0, 0, 0, 0, 1]);
        expected.push([0, 0]);
        // A draw that does not cull.
        beats.push(vec![code, code, code, 0, 0, 0, 0, 0, 0, 0]);
        expected.push([0, 0]);
    }
    for corner in 0..3 {
        for plane in 1..5 {
            let mut beat = vec![0, 0, 0, 0, 0, 0, 1, 2, 1, 1];
            beat[3 + corner] = 1 << plane;
            beats.push(beat);
            expected.push([2, 0]);
        }
        for status in 1..3 {
            let mut beat = vec![0, 0, 0, 0, 0, 0, 3 - status, 3 - status, 3 - status, 1];
            beat[6..6 + corner].fill(0);
            beat[6 + corner] = status;
            beats.push(beat);
            expected.push([3, status]);
        }
    }
    assert_eq!(verdicts(beats), expected);
}

#[test]
fn cull_refuses_what_no_corner_has() {
    let parse = |numbers: &[i64]| CullBinding.parse(&small::SET, numbers);
    assert_eq!(parse(&[63, 0, 0, 31, 0, 0, 3, 2, 1, 1]), Ok(vec![63, 0, 0, 31, 0, 0, 3, 2, 1, 1]));
    let refused = "number 1 (outcode) is 64, which does not fit 0..=63".to_owned();
    assert_eq!(parse(&[64, 0, 0, 0, 0, 0, 0, 0, 0, 1]), Err(refused));
    let refused = "corner 1 is behind z0 by its status or by bit 0 of its outside, but not by both".to_owned();
    assert_eq!(parse(&[0, 0, 0, 0, 2, 0, 0, 3, 0, 1]), Err(refused));
}
