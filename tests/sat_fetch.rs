// SPDX-License-Identifier: MIT OR Apache-2.0
//! The fetch from summed-area tables in hardware, one copy and four: against the golden model, latency, interval, errors
//! and reset.

use relief_hdl::ports::Ports;
use relief_hdl::sat_fetch::SatFetch as OneCopy;
use relief_hdl::sat_fetch_parallel::SatFetchParallel as FourCopies;
use relief_hdl::widths::{WIDTH_SETS, WidthSet, small};
use relief_hdl::with_width_set;
use relief_models::sat_build::{Table, golden};
use relief_models::sat_fetch::{Border, Command, SatFetch, fetch};
use relief_testbench::binding::{Beat, Binding, Random};
use relief_testbench::sat_fetch::{SatFetchBinding, command_beat, load_commands};
use relief_testbench::sat_fetch_parallel::SatFetchParallelBinding;
use relief_testbench::scoreboard::{Counts, Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;

mod common;

const UNITS: [&dyn Binding; 2] = [&SatFetchBinding, &SatFetchParallelBinding];

fn matches_golden(unit: &dyn Binding) {
    let beats = 20_000;
    for counts in common::matches_golden_everywhere(unit, beats) {
        // Sizes and loads send nothing; about half of the beats fetch.
        assert!(counts.checked > beats / 4 && counts.checked < beats * 3 / 4, "{counts:?}");
    }
}

#[test]
fn sat_fetch_matches_golden_under_idle_and_stall() {
    matches_golden(&SatFetchBinding);
}

#[test]
fn sat_fetch_parallel_matches_golden_under_idle_and_stall() {
    matches_golden(&SatFetchParallelBinding);
}

fn run(unit: &dyn Binding, set: &WidthSet, commands: &[Command], pattern: Pattern) -> (Counts, bool, u64) {
    let beats: Vec<Beat> = commands.iter().map(|command| command_beat(set, command)).collect();
    let mut scoreboard = Scoreboard::new(unit, set, Box::new(beats.into_iter()), pattern);
    let (_, place) = scoreboard.layout().outputs.iter().find(|(port, _)| port.name == "error").unwrap().clone();
    let (mut error, mut rose) = (false, 0);
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            assert!(!error || outputs[place] == 1, "the error is sticky");
            rose += u64::from(!error && outputs[place] == 1);
            error = outputs[place] == 1;
            Ok(())
        })
        .unwrap_or_else(|mismatch| panic!("{} {} {pattern:?}: {mismatch}", unit.name(), set.name));
    (counts, error, rose)
}

/// Cycles from the first beat to the last result: every fetch takes an interval, everything else a cycle.
#[test]
fn sat_fetch_latency_and_interval_are_its_constants() {
    let table = golden(2, 2, &[1, 2, 3, 4], 32);
    for set in WIDTH_SETS {
        let constants = with_width_set!(set.name, W => [
            (W::SatFetch::LATENCY, W::SatFetch::INTERVAL),
            (W::SatFetchParallel::LATENCY, 1),
        ])
        .unwrap();
        for (unit, (latency, interval)) in UNITS.into_iter().zip(constants) {
            for count in [1, 2, 50] {
                let mut commands = load_commands(&table, Border::Clamp);
                let before = commands.len();
                commands.extend((0..count).map(|_| Command::Fetch { corner: (0, 0), size: (2, 2) }));
                let (counts, error, _) = run(unit, set, &commands, Pattern::NONE);
                assert_eq!((counts.checked, error), (count as u64, false));
                let cycles = before + interval * (count - 1) + latency + 1;
                assert_eq!(counts.cycles, cycles as u64, "{} {} {count}", unit.name(), set.name);
            }
            assert_eq!((unit.latency(), unit.interval()), (&*latency.to_string(), &*interval.to_string()));
        }
    }
}

/// A map that fills the memory of the small set, and 10,000 random rectangles of it.
#[test]
fn sat_fetch_reads_a_map_that_fills_the_memory() {
    let set = &small::SET;
    let mut random = Random::new(7);
    let map: Vec<u16> = (0..set.table_words()).map(|_| random.bits() as u16).collect();
    let table = golden(128, 64, &map, set.sum_bits as u32);
    for (unit, border) in UNITS.into_iter().zip([Border::Clamp, Border::Slide]) {
        let mut commands = load_commands(&table, border);
        for _ in 0..10_000 {
            let corner = (random.below(150) as i64 - 11, random.below(75) as i64 - 6);
            commands.push(Command::Fetch { corner, size: (random.below(150), random.below(75)) });
        }
        commands.push(Command::Fetch { corner: (0, 0), size: (128, 64) });
        let (counts, error, _) = run(unit, set, &commands, Pattern::NONE);
        assert_eq!((counts.checked, error), (10_001, false), "{}", unit.name());
    }
}

#[test]
fn sat_fetch_errors_are_sticky_and_come_with_their_beat() {
    let set = &small::SET;
    let (border, most) = (Border::Clamp, (1u64 << set.side_width()) - 1);
    let mut good = load_commands(&golden(3, 2, &[9, 8, 7, 65_535, 5, 4], 32), border);
    good.extend([(0, 0), (-4, 1), (2, 1)].map(|corner| Command::Fetch { corner, size: (2, 5) }));
    let fetch = Command::Fetch { corner: (0, 0), size: (1, 1) };
    let size = |width, height| Command::Size { width, height, border };
    let load = |x, y| Command::Load { x, y, sum: 1 };
    let faults = [
        vec![size(0, 3)],
        vec![size(3, 0), load(1, 1), fetch],
        vec![load(0, 1)],
        vec![load(1, 0)],
        vec![load(4, 1)],
        vec![load(1, 3)],
        vec![load(-1, 1)],
        // Word 2^13, and a rectangle whose lower entries lie there.
        vec![size(128, 65), load(1, 65)],
        vec![size(128, 65), load(1, 1), Command::Fetch { corner: (0, 1), size: (1, 64) }],
        vec![size(most, most), Command::Fetch { corner: (500, 500), size: (3, 3) }],
    ];
    for unit in UNITS {
        for pattern in [Pattern::NONE, Pattern { idle: 30, stall: 50, seed: 2 }] {
            assert!(!run(unit, set, &good, pattern).1);
            for fault in &faults {
                // Between good fetches: the one before must not show it, those behind do.
                let (counts, error, rose) = run(unit, set, &[&good[..], fault, &good[..]].concat(), pattern);
                assert!(error && rose == 1 && counts.checked >= 6, "{} {fault:?} {pattern:?}", unit.name());
            }
            // Before any size.
            assert!(run(unit, set, &[load(1, 1), size(1, 1), load(1, 1), fetch], pattern).1);
            assert!(run(unit, set, &[fetch], pattern).1);
        }
    }
}

/// Words of the inputs and outputs of a tiny unit: sides to 31, 2^8 sums of 20 bits, which 17 texels may wrap.
const TINY: WidthSet = WidthSet { side_bits: 4, table_bits: 8, sum_bits: 20, ..small::SET };

/// A cycle: whether the beat was taken, and what came out.
fn cycle<U: Ports>(unit: &mut Stepped<U>, beat: Option<&Beat>, ready: bool) -> (bool, Option<(u64, u64, bool)>) {
    // in_valid, the fields, out_ready; every one is a word.
    let mut words = vec![u64::from(beat.is_some())];
    words.extend(beat.map_or(vec![0; 9], Clone::clone));
    words.push(u64::from(ready));
    unit.block_mut().write_inputs(&words);
    unit.settle();
    // in_ready, out_valid, out_sum, out_area, error
    let mut outputs = [0; 5];
    unit.block().read_outputs(&mut outputs);
    let [in_ready, valid, sum, area, error] = outputs;
    unit.edge();
    (beat.is_some() && in_ready == 1, (ready && valid == 1).then_some((sum, area, error == 1)))
}

fn stream<U: Ports>(unit: &mut Stepped<U>, beats: &[Beat], uneven: bool) -> Vec<(u64, u64, bool)> {
    let (mut sent, mut results) = (0, Vec::new());
    for k in 0..8 * beats.len() + 20 {
        let (taken, result) = cycle(unit, beats.get(sent), !uneven || k % 3 != 1);
        sent += usize::from(taken);
        results.extend(result);
    }
    assert_eq!(sent, beats.len());
    results
}

/// Areas whose sums may wrap are errors, and no smaller ones; whatever wraps is right modulo 2^B.
fn large_areas<U: Ports>(new: impl Fn() -> U) {
    let map: Vec<u16> = (0..15 * 16).map(|k| 65_535 - (k % 7)).collect();
    let table = golden(15, 16, &map, 20);
    for (a, b) in (0..=15u64).flat_map(|a| (0..=16u64).map(move |b| (a, b))) {
        let mut unit = Stepped::new(new());
        let mut golden = SatFetch::new(TINY.table_words(), 20);
        let mut commands = load_commands(&table, Border::Slide);
        commands.push(Command::Fetch { corner: (3, 5), size: (a, b) });
        let want = commands.iter().filter_map(|command| golden.accept(command)).last().unwrap();
        assert_eq!(want.error, a * b > 16);
        let beats: Vec<Beat> = commands.iter().map(|command| command_beat(&TINY, command)).collect();
        assert_eq!(stream(&mut unit, &beats, false), [(want.sum, want.area, want.error)], "{a} x {b}");
    }
}

#[test]
fn sat_fetch_says_when_a_sum_may_have_wrapped() {
    large_areas(OneCopy::<5, 7, 10, 8, 20>::default);
    large_areas(FourCopies::<5, 7, 10, 8, 20>::default);
}

/// Whenever the reset comes, what was on its way is gone, and so are the size and the error.
fn resets<U: Ports>(new: impl Fn() -> U) {
    let table: Table = golden(3, 2, &[1, 20, 300, 4000, 50_000, 6], 20);
    let rectangles = [((0, 0), (3, 2)), ((1, 1), (5, 5)), ((-1, 0), (2, 2)), ((2, 1), (1, 1))];
    for border in [Border::Clamp, Border::Slide] {
        let mut commands = load_commands(&table, border);
        commands.extend(rectangles.map(|(corner, size)| Command::Fetch { corner, size }));
        let beats: Vec<Beat> = commands.iter().map(|command| command_beat(&TINY, command)).collect();
        let want = rectangles.map(|(corner, size)| {
            let found = fetch(&table, border, corner, size);
            (found.sum, found.area, false)
        });
        let mut unit = Stepped::new(new());
        for cycles in 0..50 {
            let mut sent = 0;
            for k in 0..cycles {
                sent += usize::from(cycle(&mut unit, beats.get(sent), (k + cycles) % 3 != 0).0);
            }
            unit.reset(1 + cycles % 2);
            if cycles % 2 == 0 {
                // A fetch after the reset finds no size.
                assert_eq!(stream(&mut unit, &beats[7..8], false), [(0, 0, true)], "after {cycles} cycles");
                unit.reset(1);
            }
            assert_eq!(stream(&mut unit, &beats, cycles % 3 == 0), want, "{border:?} after {cycles} cycles");
        }
    }
}

#[test]
fn sat_fetch_reset_in_the_middle_of_a_stream() {
    resets(OneCopy::<5, 7, 10, 8, 20>::default);
    resets(FourCopies::<5, 7, 10, 8, 20>::default);
}
