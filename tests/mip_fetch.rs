// SPDX-License-Identifier: MIT OR Apache-2.0
//! The fetch from pyramids in hardware: against its golden model, its latency, interval, errors and reset.

use relief_hdl::mip_fetch::MipFetch as Hardware;
use relief_hdl::widths::{self, WIDTH_SETS, WidthSet, small};
use relief_hdl::with_width_set;
use relief_models::mip_build::{Centring, Extremum, Pyramid, Wrap, golden};
use relief_models::mip_fetch::{Command, Filter, Placement, fetch};
use relief_testbench::binding::{Beat, Binding, Random};
use relief_testbench::mip_fetch::{MipFetchBinding, command_beat, load_beats};
use relief_testbench::scoreboard::{Counts, Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;

mod common;

#[test]
fn mip_fetch_matches_golden_under_idle_and_stall() {
    let beats = 20_000;
    for counts in common::matches_golden_everywhere(&MipFetchBinding, beats) {
        // Sizes and loads send nothing; about half of the beats fetch.
        assert!(counts.checked > beats / 4 && counts.checked < beats * 3 / 4, "{counts:?}");
    }
}

#[test]
fn mip_fetch_latency_is_its_constant() {
    for set in WIDTH_SETS {
        let (measured, latency) = with_width_set!(set.name, W => {
            let mut unit = Stepped::new(W::MipFetch::default());
            unit.block_mut().out_ready.next = true;
            unit.block_mut().in_valid.next = true;
            unit.block_mut().in_kind.next = 2.into();
            let mut cycles = 0;
            loop {
                unit.settle();
                if unit.block().out_valid.val() {
                    break (cycles, W::MipFetch::LATENCY);
                }
                unit.edge();
                unit.block_mut().in_valid.next = false;
                cycles += 1;
                assert!(cycles < 100, "no value");
            }
        })
        .unwrap();
        assert_eq!(measured, latency, "{}", set.name);
        assert_eq!(MipFetchBinding.latency(), latency.to_string());
    }
}

/// A procedural map: a bump and a slope.
fn bump(width: usize, height: usize) -> Vec<u16> {
    let sample = |x: usize, y: usize| {
        let (dx, dy) = (x as i64 - width as i64 / 3, y as i64 - height as i64 / 2);
        (60_000 - 3 * (dx * dx + dy * dy)).max(17 * (x + 2 * y) as i64).clamp(0, 65_535) as u16
    };
    (0..height).flat_map(|y| (0..width).map(move |x| sample(x, y))).collect()
}

fn run(set: &WidthSet, beats: Vec<Beat>, pattern: Pattern) -> (Counts, bool, u64) {
    let mut scoreboard = Scoreboard::new(&MipFetchBinding, set, Box::new(beats.into_iter()), pattern);
    let (_, place) = scoreboard.layout().outputs.iter().find(|(port, _)| port.name == "error").unwrap().clone();
    let (mut error, mut fell, mut rose) = (false, false, 0);
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            fell |= error && outputs[place] == 0;
            rose += u64::from(!error && outputs[place] == 1);
            error = outputs[place] == 1;
            Ok(())
        })
        .unwrap_or_else(|mismatch| panic!("{} {pattern:?}: {mismatch}", set.name));
    assert!(!fell, "the error is sticky");
    (counts, error, rose)
}

/// A map of which a pyramid fills most of the memory of the small set, read at 50,000 random points: one a cycle.
#[test]
fn mip_fetch_reads_a_large_map_one_value_a_cycle() {
    let (width, height) = (255, 190);
    let build = |wrap| golden(width, height, &bump(width, height), Centring::Node, wrap, Extremum::Max, 8).unwrap();
    let pyramid: Pyramid = build([Wrap::Clamp; 2]);
    assert!(pyramid.bank_words() <= small::SET.bank_words());
    let mut random = Random::new(4);
    let mut beats = load_beats(&pyramid);
    let fetches = 50_000;
    for _ in 0..fetches {
        let [u, v] = [random.below(256 << 16) as u32, random.below(191 << 16) as u32];
        let filter = if random.chance(80) { Filter::Bilinear } else { Filter::Nearest };
        beats.push(command_beat(&Command::Fetch { level: random.below(8) as usize, u, v, filter, minima: false }));
    }
    let all = beats.len() as u64;
    let (counts, error, _) = run(&small::SET, beats, Pattern::NONE);
    assert_eq!((counts.checked, error), (fetches, false));
    assert_eq!(counts.cycles, all + widths::small::MipFetch::LATENCY as u64);
}

#[test]
fn mip_fetch_errors_are_sticky_and_come_with_their_beat() {
    let wrap = [Wrap::Repeat, Wrap::Clamp];
    let sound = Placement { width: 4, height: 4, base: 0, minima_base: 0, pitch: 2, wrap };
    let size = |level, placement| Command::Size { level, placement };
    let load = |level, i, j| Command::Load { level, minima: false, i, j, value: 1 };
    let at = |u, v| Command::Fetch { level: 0, u, v, filter: Filter::Bilinear, minima: false };
    let set = &small::SET;
    let mut good = vec![size(0, sound)];
    good.extend((0..16).map(|k| load(0, k % 4, k / 4)));
    good.extend([at(0, 0), at((8 << 16) - 1, 5 << 16)]);
    let faults = [
        size(0, Placement { width: 0, ..sound }),
        size(1, Placement { height: 0, ..sound }),
        size(0, Placement { width: 3, ..sound }),
        size(0, Placement { height: 3, wrap: [Wrap::Clamp, Wrap::Repeat], ..sound }),
        size(0, Placement { pitch: 1, ..sound }),
        size(0, Placement { width: 5, wrap: [Wrap::Clamp; 2], ..sound }),
        size(2, sound),
        size(15, sound),
        load(0, 4, 0),
        load(0, 0, 4),
        load(1, 0, 0),
        at(8 << 16, 0),
    ];
    let patterns = [Pattern::NONE, Pattern { idle: 30, stall: 50, seed: 2 }];
    for pattern in patterns {
        let beats = |commands: &[Command]| commands.iter().map(command_beat).collect::<Vec<_>>();
        let (counts, error, _) = run(set, beats(&good), pattern);
        assert_eq!((counts.checked, error), (2, false));
        for fault in &faults {
            // The fault between good fetches: the one before must not show it, those behind do. A size first again,
            // as a refused one leaves nothing to read.
            let commands = [&good[..], &[*fault], &good[..]].concat();
            let (counts, error, rose) = run(set, beats(&commands), pattern);
            assert!(error && rose == 1 && counts.checked >= 4, "{fault:?} {pattern:?}");
        }
        // A fetch of nothing, and one of a memory that ends in the middle of the level.
        assert!(run(set, beats(&[at(0, 0), at(1 << 29, 5)]), pattern).1);
        let base = set.bank_words() - 2;
        let end = Placement { base, minima_base: base, ..sound };
        let mut over = vec![size(0, end)];
        over.extend((0..8).map(|k| load(0, k % 4, k / 4)));
        over.push(at(1 << 16, 1 << 14));
        let (_, error, _) = run(set, beats(&over), pattern);
        assert!(!error);
        over.push(at(1 << 16, 3 << 15));
        assert!(run(set, beats(&over), pattern).1);
    }
}

/// Whenever the reset comes, what was on its way is gone, and so are the sizes and the error.
#[test]
fn mip_fetch_reset_in_the_middle_of_a_stream() {
    type Tiny = Hardware<5, 4>;
    let map: Vec<u16> = (0..20).map(|k| 3000 * k + 7).collect();
    let pyramid = golden(5, 4, &map, Centring::Node, [Wrap::Clamp; 2], Extremum::Max, 2).unwrap();
    assert!(pyramid.bank_words() <= 16);
    let mut beats = load_beats(&pyramid);
    let points = [(0, 0, 0), (0, 1 << 15, 9 << 14), (1, 77_777, 5_555), (1, 5 << 16, 4 << 16)];
    beats.extend(
        points.map(|(level, u, v)| {
            command_beat(&Command::Fetch { level, u, v, filter: Filter::Bilinear, minima: false })
        }),
    );
    let cycle = |unit: &mut Stepped<Tiny>, beat: Option<&Beat>, ready: bool| {
        let block = unit.block_mut();
        block.out_ready.next = ready;
        block.in_valid.next = beat.is_some();
        if let Some(beat) = beat {
            let word = |at: usize| beat[at] as i32;
            block.in_kind.next = word(0).into();
            block.in_level.next = word(1).into();
            block.in_u.next = word(2).into();
            block.in_v.next = word(3).into();
            block.in_bilinear.next = word(4) == 1;
            block.in_minima.next = word(5) == 1;
            block.in_i.next = word(6).into();
            block.in_j.next = word(7).into();
            block.in_value.next = word(8).into();
            block.in_width.next = word(9).into();
            block.in_height.next = word(10).into();
            block.in_base.next = word(11).into();
            block.in_minima_base.next = word(12).into();
            block.in_pitch.next = word(13).into();
        }
        unit.settle();
        let taken = beat.is_some() && unit.block().in_ready.val();
        let value = (ready && unit.block().out_valid.val()).then(|| unit.block().out_value.val().get() as u32);
        unit.edge();
        (taken, value)
    };
    let mut unit = Stepped::new(Tiny::default());
    for cycles in 0..beats.len() + 15 {
        let mut sent = 0;
        for k in 0..cycles {
            sent += usize::from(cycle(&mut unit, beats.get(sent), (k + cycles) % 3 != 0).0);
        }
        // An error, too: a fetch after the reset finds no size.
        unit.reset(1 + cycles % 2);
        let nothing = command_beat(&Command::Fetch { level: 0, u: 0, v: 0, filter: Filter::Nearest, minima: false });
        if cycles % 2 == 0 {
            cycle(&mut unit, Some(&nothing), true);
            let values: Vec<_> = (0..Tiny::LATENCY + 3).filter_map(|_| cycle(&mut unit, None, true).1).collect();
            assert_eq!(values, [0], "after {cycles} cycles");
            assert!(unit.block().error.val());
            unit.reset(1);
        }
        let (mut sent, mut values) = (0, Vec::new());
        for _ in 0..beats.len() + Tiny::LATENCY + 3 {
            let (taken, value) = cycle(&mut unit, beats.get(sent), true);
            sent += usize::from(taken);
            values.extend(value);
        }
        let want = points.map(|(level, u, v)| fetch(&pyramid, level, u, v, Filter::Bilinear));
        assert_eq!(values, want, "after {cycles} cycles");
        assert!(!unit.block().error.val());
    }
}
