// SPDX-License-Identifier: MIT OR Apache-2.0
//! The builder of summed-area tables in hardware: against its golden model, its latency, interval, errors and reset.

use relief_hdl::sat_build::SatBuild as Hardware;
use relief_hdl::widths::{WIDTH_SETS, WidthSet, small};
use relief_hdl::with_width_set;
use relief_models::sat_build::golden;
use relief_testbench::binding::{Beat, Binding};
use relief_testbench::sat_build::{SatBuildBinding, size_beat, texel_beat};
use relief_testbench::scoreboard::{Counts, Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;

mod common;

#[test]
fn sat_build_matches_golden_under_idle_and_stall() {
    let beats = 20_000;
    for counts in common::matches_golden_everywhere(&SatBuildBinding, beats) {
        assert!(counts.checked > beats * 9 / 10, "{counts:?}");
    }
}

fn run(set: &WidthSet, beats: Vec<Beat>, pattern: Pattern) -> (Counts, bool) {
    let mut scoreboard = Scoreboard::new(&SatBuildBinding, set, Box::new(beats.into_iter()), pattern);
    let (_, place) = scoreboard.layout().outputs.iter().find(|(port, _)| port.name == "error").unwrap().clone();
    let (mut error, mut fell) = (false, false);
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            fell |= error && outputs[place] == 0;
            error = outputs[place] == 1;
            Ok(())
        })
        .unwrap_or_else(|mismatch| panic!("{} {pattern:?}: {mismatch}", set.name));
    assert!(!fell, "the error is sticky");
    (counts, error)
}

/// A map of the brightest texels: the sums wrap as early as they can.
fn bright(width: usize, height: usize) -> Vec<Beat> {
    std::iter::once(size_beat(width, height)).chain((0..width * height).map(|_| texel_beat(u16::MAX))).collect()
}

#[test]
fn sat_build_takes_a_texel_a_cycle_and_latency_is_its_constant() {
    for set in WIDTH_SETS {
        let latency = with_width_set!(set.name, W => W::SatBuild::LATENCY as u64).unwrap();
        let (counts, error) = run(set, bright(1 << set.side_bits, 3), Pattern::NONE);
        let texels = 3 << set.side_bits;
        assert_eq!((counts.checked, error), (texels, false), "{}", set.name);
        // The size, the texels, and the way of the last sum.
        assert_eq!(counts.cycles, 1 + texels + latency, "{}", set.name);
        assert_eq!(SatBuildBinding.latency(), latency.to_string());
    }
}

#[test]
fn sat_build_errors_are_sticky_and_the_next_map_is_right() {
    let faults = [
        size_beat(0, 3),
        size_beat(3, 0),
        size_beat((1 << small::SET.side_bits) + 1, 1),
        texel_beat(5),
        size_beat(3, 3),
    ];
    let good = bright(3, 4);
    for pattern in [Pattern::NONE, Pattern { idle: 30, stall: 50, seed: 2 }] {
        assert!(!run(&small::SET, good.clone(), pattern).1);
        for fault in &faults {
            let (counts, error) =
                run(&small::SET, [&good[..], std::slice::from_ref(fault), &good[..]].concat(), pattern);
            assert_eq!((counts.checked, error), (24, true), "{fault:?} {pattern:?}");
        }
    }
}

/// Narrow sums wrap a hundred times over a map, and whenever the reset comes, the next map is right.
#[test]
fn sat_build_reset_in_the_middle_of_a_stream() {
    type Tiny = Hardware<4, 3, 17>;
    let map: Vec<u16> = (0..40).map(|k| 65_535 - 7 * k).collect();
    for (width, height) in [(8, 5), (1, 15), (2, 9), (5, 3)] {
        let map = &map[..width * height];
        let table = golden(width, height, map, 17);
        let cells = (1..=height).flat_map(|y| (1..=width).map(move |x| (x, y)));
        let want: Vec<_> = cells.map(|(x, y)| table.at(x, y) as i64).collect();
        let beats: Vec<Beat> =
            std::iter::once(size_beat(width, height)).chain(map.iter().map(|&texel| texel_beat(texel))).collect();
        let cycle = |unit: &mut Stepped<Tiny>, beat: Option<&Beat>, ready: bool| {
            let block = unit.block_mut();
            block.out_ready.next = ready;
            block.in_valid.next = beat.is_some();
            if let Some(beat) = beat {
                block.in_kind.next = (beat[0] as i32).into();
                block.in_width.next = (beat[1] as i32).into();
                block.in_height.next = (beat[2] as i32).into();
                block.in_value.next = (beat[3] as i32).into();
            }
            unit.settle();
            let taken = beat.is_some() && unit.block().in_ready.val();
            let sum = (ready && unit.block().out_valid.val()).then(|| unit.block().out_sum.val().get());
            unit.edge();
            (taken, sum)
        };
        let mut unit = Stepped::new(Tiny::default());
        for cycles in 0..50 {
            let mut sent = 0;
            for k in 0..cycles {
                sent += usize::from(cycle(&mut unit, beats.get(sent), (k + cycles) % 3 != 0).0);
            }
            unit.reset(1 + cycles % 2);
            let (mut sent, mut sums) = (0, Vec::new());
            for k in 0..2 * beats.len() + 10 {
                let (taken, sum) = cycle(&mut unit, beats.get(sent), cycles % 2 == 0 || k % 3 != 1);
                sent += usize::from(taken);
                sums.extend(sum);
            }
            assert_eq!(sums, want, "{width} x {height} after {cycles} cycles");
            assert!(!unit.block().error.val());
        }
    }
}
