// SPDX-License-Identifier: MIT OR Apache-2.0
//! The strip unit in hardware: against its golden model, its latency, its reset, and what it does when it is misused.

use relief_hdl::signal::Lanes;
use relief_hdl::strip_unit::StripUnit as Hardware;
use relief_hdl::widths::{WIDTH_SETS, WidthSet, position, small};
use relief_hdl::with_width_set;
use relief_models::step::{Kind, LeftCommand, MAX_COMPONENTS, RightCommand, Step, Vertex};
use relief_models::strip_unit::StripUnit as Golden;
use relief_testbench::binding::{Binding, Random};
use relief_testbench::remesher::{format, random_base, words_of};
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;
use relief_testbench::strip_unit::StripUnitBinding;

mod common;

#[test]
fn strip_unit_matches_golden_under_idle_and_stall() {
    let beats = 20_000;
    for counts in common::matches_golden_everywhere(&StripUnitBinding, beats) {
        // Most beats close a triangle.
        assert!(counts.checked > beats / 2 && counts.checked <= beats, "{counts:?}");
    }
}

/// A vertex of which every component is `value`.
fn vertex(components: usize, value: i64) -> Vertex {
    let mut vertex = [0; MAX_COMPONENTS];
    vertex[..components].fill(value);
    vertex
}

/// A step whose vertices are `value` and `value + 1`.
fn step(set: &WidthSet, kind: Kind, left: LeftCommand, right: RightCommand, value: i64) -> Step {
    let [left_vertex, right_vertex] = [value, value + 1].map(|value| vertex(set.components, value));
    Step { kind, left, right, swap: false, last: false, left_vertex, right_vertex }
}

#[test]
fn strip_unit_latency_is_its_constant() {
    for set in WIDTH_SETS {
        let (measured, latency) = with_width_set!(set.name, W => {
            let mut unit = Stepped::new(W::StripUnit::new(set.column_depth));
            unit.block_mut().out_ready.next = true;
            // Both vertices, and then a second left one, which closes a triangle.
            unit.block_mut().in_valid.next = true;
            unit.block_mut().in_kind.next = (Kind::Start as i32).into();
            unit.block_mut().in_left.next = (LeftCommand::Set as i32).into();
            unit.block_mut().in_right.next = (RightCommand::Set as i32).into();
            unit.settle();
            unit.edge();
            unit.block_mut().in_kind.next = (Kind::Step as i32).into();
            unit.block_mut().in_right.next = (RightCommand::Ref as i32).into();
            let mut cycles = 0;
            loop {
                unit.settle();
                if unit.block().out_valid.val() {
                    break (cycles, W::StripUnit::LATENCY);
                }
                unit.edge();
                unit.block_mut().in_valid.next = false;
                cycles += 1;
                assert!(cycles < 10, "no triangle");
            }
        })
        .unwrap();
        assert_eq!(measured, latency, "{}", set.name);
        assert_eq!(StripUnitBinding.latency(), latency.to_string());
    }
}

/// Compares the unit with its golden model on `steps`, and gives the number of output beats and the last `error`.
fn error_after(set: &WidthSet, steps: &[Step], pattern: Pattern) -> (u64, bool) {
    let source = Box::new(steps.iter().map(|step| words_of(set, step)));
    let mut scoreboard = Scoreboard::new(&StripUnitBinding, set, source, pattern);
    let (_, place) = scoreboard.layout().outputs.iter().find(|(port, _)| port.name == "error").unwrap().clone();
    let mut error = false;
    let mut fell = false;
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            fell |= error && outputs[place] == 0;
            error = outputs[place] == 1;
            Ok(())
        })
        .unwrap_or_else(|mismatch| panic!("{} {pattern:?}: {mismatch}", set.name));
    assert_eq!(counts.accepted, steps.len() as u64);
    assert!(!fell, "the error is sticky");
    (counts.checked, error)
}

const PATTERNS: [Pattern; 3] =
    [Pattern::NONE, Pattern { idle: 30, stall: 0, seed: 1 }, Pattern { idle: 30, stall: 50, seed: 2 }];

#[test]
fn strip_unit_recall_of_nothing_is_an_error() {
    use {Kind::*, LeftCommand as L, RightCommand as R};
    for set in WIDTH_SETS {
        let good = [
            step(set, Start, L::Set, R::Set, 10),
            step(set, Step, L::Set, R::Store, 20),
            step(set, Step, L::Recall, R::Set, 30),
            step(set, Step, L::Set, R::Set, 40),
        ];
        // The second recall finds nothing; the unit works on, and the error stays.
        let mut bad = good.to_vec();
        bad.push(step(set, Step, L::Recall, R::Set, 50));
        bad.push(step(set, Step, L::Recall, R::Ref, 60));
        bad.extend(good);
        for pattern in PATTERNS {
            let (checked, error) = error_after(set, &good, pattern);
            assert!(!error && checked > 0);
            let (more, error) = error_after(set, &bad, pattern);
            assert!(error && more > checked, "{} {pattern:?}", set.name);
        }
        // The memory of the base triangle before is not that of this one.
        let stale = [good[0], good[1], good[0], step(set, Step, L::Recall, R::Set, 70), good[3]];
        assert!(error_after(set, &stale, Pattern::NONE).1);
    }
}

#[test]
fn strip_unit_store_into_a_full_memory_is_an_error() {
    use {Kind::*, LeftCommand as L, RightCommand as R};
    let tiny = WidthSet { column_depth: 3, ..position::SET };
    for set in [tiny, small::SET] {
        let depth = set.column_depth as i64;
        let mut steps = vec![step(&set, Start, L::Set, R::Set, 10)];
        steps.extend((0..depth).map(|k| step(&set, Step, L::Ref, R::Store, 20 + 2 * k)));
        let recalls: Vec<_> = (0..depth).map(|k| step(&set, Step, L::Recall, R::Set, 3000 + 2 * k)).collect();
        let good = [steps.clone(), recalls.clone()].concat();
        // One more than it holds is lost; those before it come out.
        steps.push(step(&set, Step, L::Ref, R::Store, 2000));
        let bad = [steps, recalls].concat();
        for pattern in PATTERNS {
            assert!(!error_after(&set, &good, pattern).1);
            assert!(error_after(&set, &bad, pattern).1, "{} {pattern:?}", set.name);
        }
    }
}

/// Long and short columns, recalls right behind the stores that they recall, both at once, and a memory run full: the unit
/// never waits by itself.
#[test]
fn strip_unit_takes_a_step_a_cycle() {
    use {Kind::*, LeftCommand as L, RightCommand as R};
    let set = &small::SET;
    let mut random = Random::new(8);
    let mut steps = Vec::new();
    for depth in [1, 2, 3, 13, 14, 15, 16, 17, 18, 30, 512] {
        steps.push(step(set, Start, L::Set, R::Set, 10));
        steps.push(step(set, Step, L::Ref, R::Edge, 12));
        steps.extend((0..depth).map(|k| step(set, Step, L::Ref, R::Store, 20 + 2 * k)));
        // As many again, each behind the recall that makes room, or with it.
        let mut stored = depth;
        for k in 0..2 * depth {
            let both = stored < 512 && random.chance(50);
            steps.push(step(set, Step, L::Recall, if both { R::Store } else { R::Set }, 5000 + 2 * k));
            if !both {
                steps.push(step(set, Step, L::Ref, R::Store, 9000 + 2 * k));
            }
            stored = depth;
        }
        steps.extend((0..depth).map(|k| step(set, Step, L::Recall, R::Ref, 20_000 + 2 * k)));
    }
    let beats = steps.len() as u64;
    let source = Box::new(steps.iter().map(|step| words_of(set, step)));
    let mut scoreboard = Scoreboard::new(&StripUnitBinding, set, source, Pattern::NONE);
    let counts =
        scoreboard.run(Until::Exhausted, &mut |_, _, _| Ok(())).unwrap_or_else(|mismatch| panic!("{mismatch}"));
    assert_eq!(counts.accepted, beats);
    assert!(counts.checked > beats / 3, "{counts:?}");
    assert!(counts.cycles <= beats + small::StripUnit::LATENCY as u64, "{counts:?}, {beats} steps");
}

/// Four-bit counters and two places.
type Tiny = Hardware<3, 32, 4>;

/// Output beat: first, second, swap and last, and the four vertices.
type OutputBeat = ([bool; 4], [Lanes<3, 32>; 4]);

/// One cycle of the tiny unit with `step` at the input: whether it was taken, and the output beat.
fn cycle(unit: &mut Stepped<Tiny>, step: Option<&Step>, ready: bool) -> (bool, Option<OutputBeat>) {
    let block = unit.block_mut();
    block.out_ready.next = ready;
    block.in_valid.next = step.is_some();
    if let Some(step) = step {
        let lanes = |vertex: &Vertex| Lanes::new([vertex[0], vertex[1], vertex[2]]);
        block.in_kind.next = (step.kind as i32).into();
        block.in_left.next = (step.left as i32).into();
        block.in_right.next = (step.right as i32).into();
        block.in_swap.next = step.swap;
        block.in_last.next = step.last;
        block.in_left_vertex.next = lanes(&step.left_vertex);
        block.in_right_vertex.next = lanes(&step.right_vertex);
    }
    unit.settle();
    let block = unit.block();
    let taken = step.is_some() && block.in_ready.val();
    let output = (ready && block.out_valid.val()).then(|| {
        let flags = [&block.out_first, &block.out_second, &block.out_swap, &block.out_last].map(|flag| flag.val());
        let vertices = [&block.out_left, &block.out_right, &block.out_next_left, &block.out_next_right];
        (flags, vertices.map(|vertex| vertex.val()))
    });
    unit.edge();
    (taken, output)
}

/// Sends `steps` to the tiny unit and compares every output beat with the golden model of the same depth.
fn tiny_matches(unit: &mut Stepped<Tiny>, steps: &[Step], stall: u8, seed: u64) -> usize {
    let mut golden = Golden::new(2);
    let expected: Vec<_> = steps
        .iter()
        .map(|step| golden.accept(step))
        .filter(|out| out.first_valid || out.second_valid || out.last)
        .map(|out| {
            let vertices = [out.left, out.right, out.next_left, out.next_right].map(|v| Lanes::new([v[0], v[1], v[2]]));
            ([out.first_valid, out.second_valid, out.swap, out.last], vertices)
        })
        .collect();
    assert!(!golden.error());
    let mut random = Random::new(seed);
    let (mut sent, mut got, mut quiet) = (0, 0, 0);
    while quiet < 20 {
        let (taken, output) = cycle(unit, steps.get(sent), !random.chance(stall));
        sent += usize::from(taken);
        quiet = if taken || output.is_some() || got < expected.len() { 0 } else { quiet + 1 };
        if let Some(output) = output {
            assert_eq!(Some(&output), expected.get(got), "beat {got}, stall {stall}, seed {seed}");
            got += 1;
        }
    }
    assert_eq!((sent, got), (steps.len(), expected.len()), "seed {seed}");
    assert!(!unit.block().error.val());
    got
}

#[test]
fn strip_unit_column_memory_of_two_works() {
    let set = WidthSet { column_depth: 2, ..position::SET };
    for seed in 1..=20 {
        let mut random = Random::new(seed);
        let mut steps = Vec::new();
        for _ in 0..20 {
            let base = random_base(&set, &mut random);
            relief_models::remesher::golden(&format(&set), &base, &mut |step| steps.push(*step));
        }
        assert!(steps.iter().any(|step| step.left == LeftCommand::Recall), "seed {seed} recalls nothing");
        assert!(tiny_matches(&mut Stepped::new(Tiny::new(2)), &steps, (seed % 2) as u8 * 50, seed) > 0);
    }
}

/// Whenever the reset comes, what waits at the output and in the column memory is gone, and so is the error.
#[test]
fn strip_unit_reset_in_the_middle_of_a_stream() {
    let set = WidthSet { column_depth: 2, ..position::SET };
    let mut random = Random::new(99);
    let mut streams = [(); 2].map(|()| {
        let mut steps = Vec::new();
        while steps.len() < 60 {
            let base = random_base(&set, &mut random);
            relief_models::remesher::golden(&format(&set), &base, &mut |step| steps.push(*step));
        }
        steps
    });
    streams[0].truncate(60);
    let mut unit = Stepped::new(Tiny::new(2));
    for cycles in 0..60 {
        let mut sent = 0;
        for _ in 0..cycles {
            sent += usize::from(cycle(&mut unit, streams[0].get(sent), random.chance(60)).0);
        }
        let recall = step(&set, Kind::Step, LeftCommand::Recall, RightCommand::Set, 5);
        for _ in 0..4 * (cycles % 2) {
            cycle(&mut unit, Some(&recall), true);
        }
        unit.block_mut().in_valid.next = cycles % 3 == 0;
        unit.reset(1 + cycles % 2);
        assert!(tiny_matches(&mut unit, &streams[1], 0, 0) > 0, "after {cycles} cycles");
    }
}
