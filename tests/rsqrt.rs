// SPDX-License-Identifier: MIT OR Apache-2.0
//! The reciprocal root in hardware: against its golden model, at both ends of every line and every step along it, its
//! latency, interval and reset; and the normalisation of vectors that uses it.

use relief_hdl::rsqrt::{Normalize, Rsqrt};
use relief_hdl::signal::Lanes;
use relief_hdl::widths::small;
use relief_models::rsqrt::normalize;
use relief_testbench::binding::{Beat, Binding, Random};
use relief_testbench::rsqrt::RsqrtBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;
use std::collections::VecDeque;

mod common;

#[test]
fn rsqrt_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&RsqrtBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

/// The table has 64 lines of 2,048 steps in each octave: between two of them only Newton's step moves.
#[test]
fn rsqrt_matches_golden_at_both_ends_of_every_step() {
    let ends = |leading: u64| {
        (1u64 << 17..1 << 18).flat_map(move |step| {
            let (start, size) = (step << (leading - 17), 1 << (leading - 17));
            [vec![start], vec![start + size - 1]]
        })
    };
    let beats = ends(30).chain(ends(31));
    let mut scoreboard = Scoreboard::new(&RsqrtBinding, &small::SET, Box::new(beats), Pattern::NONE);
    let counts = scoreboard.run(Until::Exhausted, &mut |_, _, _| Ok(())).unwrap();
    assert_eq!(counts.checked, 4 << 17);
}

#[test]
fn rsqrt_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&RsqrtBinding, Rsqrt::LATENCY);
}

#[test]
fn rsqrt_reset_drops_what_is_on_its_way() {
    common::reset_empties(&RsqrtBinding, Rsqrt::LATENCY);
}

#[test]
fn rsqrt_refuses_what_is_not_normalised() {
    let parse = |number| RsqrtBinding.parse(&small::SET, &[number]);
    assert_eq!(parse(0x4000_0000), Ok(Beat::from([0x4000_0000])));
    assert_eq!(parse(7), Err("number 1 (x) is 7, below 1073741824".to_owned()));
}

/// Vectors of every length and shape, the zero vector and the minimum among them; the unit stands now and then.
#[test]
fn rsqrt_normalize_matches_golden() {
    let mut random = Random::new(5);
    let mut unit = Stepped::new(Normalize::default());
    let (mut under_way, mut checked) = (VecDeque::new(), 0);
    while checked < 100_000 {
        let bits = 1 + random.below(32) as usize;
        let vector = [0; 3].map(|_| {
            let bits = if random.chance(40) { 1 + random.below(bits as u64) as usize } else { bits };
            if random.chance(5) { 0 } else { random.signed(bits) }
        });
        let goes = !random.chance(20);
        unit.block_mut().go.next = goes;
        unit.block_mut().components.next = Lanes::new(vector);
        unit.settle();
        if goes {
            under_way.push_back(vector);
            if under_way.len() > Normalize::LATENCY {
                let vector = under_way.pop_front().unwrap();
                assert_eq!(*unit.block().unit.val().get(), normalize(vector).map(i64::from), "{vector:?}");
                checked += 1;
            }
        }
        unit.edge();
    }
}
