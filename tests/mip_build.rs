// SPDX-License-Identifier: MIT OR Apache-2.0
//! The pyramid builder in hardware: against its golden model, its latency, speed, errors and reset.

use relief_hdl::mip_build::MipBuild as Hardware;
use relief_hdl::widths::{WIDTH_SETS, WidthSet, small};
use relief_hdl::with_width_set;
use relief_models::map;
use relief_models::mip_build::{BuildSize, Centring, Extremum, Wrap, golden, max_levels};
use relief_testbench::binding::{Beat, Binding, Random};
use relief_testbench::mip_build::{MipBuildBinding, size_beat, texel_beat};
use relief_testbench::scoreboard::{Counts, Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;

mod common;

#[test]
fn mip_build_matches_golden_under_idle_and_stall() {
    let beats = 20_000;
    for counts in common::matches_golden_everywhere(&MipBuildBinding, beats) {
        assert!(counts.checked > beats / 8, "{counts:?}");
    }
}

/// A map and its size as beats.
fn beats(size: &BuildSize, mut texel: impl FnMut() -> u16) -> Vec<Beat> {
    let texels = (0..size.width * size.height).map(|_| texel_beat(texel()));
    std::iter::once(size_beat(size)).chain(texels.collect::<Vec<_>>()).collect()
}

fn clamped(width: usize, height: usize, levels: usize) -> BuildSize {
    BuildSize { width, height, wrap: [Wrap::Clamp; 2], centring: Centring::Node, levels, poles: false }
}

/// Counts, the last error, and the cycles in which the last texel was taken and the first node came.
fn run(set: &WidthSet, beats: Vec<Beat>, pattern: Pattern) -> (Counts, bool, [u64; 2]) {
    let mut scoreboard = Scoreboard::new(&MipBuildBinding, set, Box::new(beats.into_iter()), pattern);
    let layout = scoreboard.layout().clone();
    let (_, place) = layout.outputs.iter().find(|(port, _)| port.name == "error").unwrap().clone();
    let (mut error, mut fell, mut cycle, mut taken, mut first) = (false, false, 0, 0, None);
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, inputs, outputs| {
            fell |= error && outputs[place] == 0;
            error = outputs[place] == 1;
            if inputs[layout.in_valid] == 1 && outputs[layout.in_ready] == 1 {
                taken = cycle;
            }
            if outputs[layout.out_valid] == 1 && first.is_none() {
                first = Some(cycle);
            }
            cycle += 1;
            Ok(())
        })
        .unwrap_or_else(|mismatch| panic!("{} {pattern:?}: {mismatch}", set.name));
    assert!(!fell, "the error is sticky");
    (counts, error, [taken, first.unwrap_or(0)])
}

#[test]
fn mip_build_latency_is_its_constant() {
    for set in WIDTH_SETS {
        let latency = with_width_set!(set.name, W => W::MipBuild::LATENCY as u64).unwrap();
        // Behind an even row there is one node more, and an odd row goes into two rows of nodes; where the row is odd in
        // length, the node before the last one is a texel before, and still goes into its second row.
        for (width, height, more) in [(1, 1, 0), (5, 7, 0), (4, 3, 1), (3, 4, 2), (6, 2, 3)] {
            let (_, error, [taken, first]) = run(set, beats(&clamped(width, height, 3), || 5), Pattern::NONE);
            assert_eq!((first - taken, error), (latency + more, false), "{} {width} x {height}", set.name);
        }
        assert_eq!(MipBuildBinding.latency(), latency.to_string());
    }
}

/// With poles the first thing to come is the first sample of the map's first row.
#[test]
fn mip_build_sends_the_pole_rows_of_the_map_first() {
    for (width, height, levels) in [(5, 7, 3), (4, 1, 1), (1, 1, 2), (6, 2, 1)] {
        let size = BuildSize { poles: true, ..clamped(width, height, levels) };
        let mut value = 0;
        let texel = || {
            value += 1;
            value
        };
        let (counts, error, [taken, first]) = run(&small::SET, beats(&size, texel), Pattern::NONE);
        assert_eq!((first - taken, error), (3, false), "{width} x {height}");
        let wrap = [Wrap::Clamp; 2];
        let above: usize = map::levels([width, height], wrap)[1..].iter().take(levels - 1).map(|[w, h]| w * h).sum();
        // A level beyond the last useful one is a copy of it.
        let more = levels.saturating_sub(map::levels([width, height], wrap).len());
        assert_eq!(counts.checked as usize, width * height.min(2) + above + more, "{width} x {height}");
    }
}

/// All sizes up to 9 x 9, both centrings, all borders that fit, with and without poles, one behind the other in one run.
#[test]
fn mip_build_builds_every_small_map() {
    let mut random = Random::new(3);
    let (mut all, mut nodes) = (Vec::new(), 0);
    for (width, height) in (1..=9).flat_map(|w| (1..=9).map(move |h| (w, h))) {
        for centring in [Centring::Node, Centring::Cell] {
            let axis =
                |side: usize| if side.is_multiple_of(2) { vec![Wrap::Clamp, Wrap::Repeat] } else { vec![Wrap::Clamp] };
            for wrap in axis(width).into_iter().flat_map(|u| axis(height).into_iter().map(move |v| [u, v])) {
                let levels = max_levels(width, height, centring, wrap);
                let zeros = vec![0; width * height];
                let pyramid = golden(width, height, &zeros, centring, wrap, Extremum::Max, levels).unwrap();
                let above = pyramid.levels[1..].iter().map(|level| level.samples.len() as u64).sum::<u64>();
                for poles in [false, true].into_iter().filter(|poles| !poles || wrap[1] == Wrap::Clamp) {
                    let size = BuildSize { width, height, wrap, centring, levels, poles };
                    all.extend(beats(&size, || random.bits() as u16));
                    nodes += above + if poles { (width * height.min(2)) as u64 } else { 0 };
                }
            }
        }
    }
    for pattern in [Pattern::NONE, Pattern { idle: 30, stall: 50, seed: 1 }] {
        let (counts, error, _) = run(&small::SET, all.clone(), pattern);
        assert_eq!((counts.checked, error), (nodes, false));
        assert!(nodes > 7_000, "{nodes}");
    }
}

/// 4/3 cycles a texel, and a few for each row and level.
#[test]
fn mip_build_takes_a_texel_a_cycle() {
    let mut random = Random::new(6);
    for (width, height, most) in [(255, 201, 1.36), (200, 200, 1.37), (16, 16, 2.05)] {
        let beats = beats(&clamped(width, height, 8), || random.bits() as u16);
        let (counts, error, [taken, _]) = run(&small::SET, beats, Pattern::NONE);
        let texels = (width * height) as f64;
        let (map, all) = (taken as f64 / texels, counts.cycles as f64 / texels);
        println!("{width} x {height}: {map:.4} cycles a texel until the last texel, {all:.4} until the last node");
        assert!(!error && all < most && map < 1.02 + 2.0 / width as f64, "{width} x {height}: {map} {all}");
    }
}

#[test]
fn mip_build_errors_are_sticky_and_the_next_map_is_right() {
    let good = beats(&clamped(5, 4, 3), || 77);
    let side = 1 << small::SET.side_bits;
    let odd = |width, height, wrap, levels| size_beat(&BuildSize { width, height, wrap, ..clamped(1, 1, levels) });
    let (clamp, repeat) = (Wrap::Clamp, Wrap::Repeat);
    let faults = [
        size_beat(&clamped(0, 4, 3)),
        size_beat(&clamped(4, 0, 3)),
        size_beat(&clamped(4, 4, 0)),
        size_beat(&clamped(side, side, 2)),
        odd(5, 4, [repeat, clamp], 1),
        odd(4, 12, [clamp, repeat], 3),
        odd(2, 2, [repeat, repeat], 2),
        size_beat(&BuildSize { poles: true, wrap: [clamp, repeat], ..clamped(4, 4, 2) }),
        texel_beat(5),
        // A map that is not finished.
        size_beat(&clamped(3, 3, 2)),
    ];
    for pattern in [Pattern::NONE, Pattern { idle: 30, stall: 50, seed: 2 }] {
        let (counts, error, _) = run(&small::SET, good.clone(), pattern);
        assert!(!error);
        for fault in &faults {
            let beats = [&good[..], std::slice::from_ref(fault), &good[..]].concat();
            let (more, error, _) = run(&small::SET, beats, pattern);
            assert!(error && more.checked == 2 * counts.checked, "{fault:?} {pattern:?}");
        }
    }
    // The largest map that fits: as many nodes as the memory has words.
    let full = clamped(255, 254, 2);
    assert_eq!(128 * 128, small::SET.bank_words());
    let (counts, error, _) = run(&small::SET, beats(&full, || 1), Pattern::NONE);
    assert_eq!((counts.checked, error), (128 * 128, false));
}

/// Whenever the reset comes, the map is forgotten, and so is what waits.
#[test]
fn mip_build_reset_in_the_middle_of_a_stream() {
    type Tiny = Hardware<5, 6, 5>;
    let map: Vec<u16> = (0..30).map(|k| (k * 7919 % 1000) as u16).collect();
    let build = |extremum| golden(6, 5, &map, Centring::Node, [Wrap::Clamp; 2], extremum, 3).unwrap();
    let (most, least) = (build(Extremum::Max), build(Extremum::Min));
    let samples = |pyramid: &relief_models::mip_build::Pyramid| -> Vec<i64> {
        pyramid.levels[1..].iter().flat_map(|level| level.samples.iter().map(|&s| i64::from(s))).collect()
    };
    let want: Vec<_> = samples(&most).into_iter().zip(samples(&least)).collect();
    let mut texels = map.iter();
    let all = beats(&clamped(6, 5, 3), || *texels.next().unwrap());
    let cycle = |unit: &mut Stepped<Tiny>, beat: Option<&Beat>, ready: bool| {
        let block = unit.block_mut();
        block.out_ready.next = ready;
        block.in_valid.next = beat.is_some();
        if let Some(beat) = beat {
            block.in_kind.next = (beat[0] as i32).into();
            block.in_width.next = (beat[1] as i32).into();
            block.in_height.next = (beat[2] as i32).into();
            block.in_levels.next = (beat[7] as i32).into();
            block.in_value.next = (beat[8] as i32).into();
        }
        unit.settle();
        let taken = beat.is_some() && unit.block().in_ready.val();
        let block = unit.block();
        let node = (ready && block.out_valid.val()).then(|| (block.out_max.val().get(), block.out_min.val().get()));
        unit.edge();
        (taken, node)
    };
    let mut unit = Stepped::new(Tiny::default());
    for cycles in 0..80 {
        let mut sent = 0;
        for k in 0..cycles {
            sent += usize::from(cycle(&mut unit, all.get(sent), (k + cycles) % 3 != 0).0);
        }
        unit.reset(1 + cycles % 2);
        assert!(!unit.block().error.val());
        let (mut sent, mut nodes) = (0, Vec::new());
        for _ in 0..120 {
            let (taken, node) = cycle(&mut unit, all.get(sent), true);
            sent += usize::from(taken);
            nodes.extend(node);
        }
        assert_eq!(nodes, want, "after {cycles} cycles");
        assert!(!unit.block().error.val());
    }
}
