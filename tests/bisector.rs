// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bisector in hardware: against its golden model, its latency, its rate, errors, reset, and the strip unit behind it.

use relief_hdl::bisector::Bisector as Hardware;
use relief_hdl::widths::{WIDTH_SETS, WidthSet, deep, position, small};
use relief_hdl::with_width_set;
use relief_models::bisector::{Bound, Command, Lattice, SplitMap, Vertex, WALKERS, golden};
use relief_models::step::{Kind, LeftCommand, MAX_COMPONENTS, RightCommand, Step};
use relief_testbench::binding::{Beat, Binding, Random};
use relief_testbench::bisector::{BisectorBinding, command_beat, corners_of, load_beats};
use relief_testbench::device::Stage;
use relief_testbench::remesher::words_of;
use relief_testbench::scoreboard::{Counts, Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;
use relief_testbench::strip_unit::StripUnitBinding;

mod common;

/// Words of an output beat.
const SIDE: usize = 3;
const START: usize = 4;
const WALKER: usize = 5;
const END: usize = 6;
const CYCLES: usize = 7;

#[test]
fn bisector_matches_golden_under_idle_and_stall() {
    for counts in common::matches_golden_everywhere(&BisectorBinding, 20_000) {
        // Most beats are samples; a map of random errors has about as many triangles.
        assert!(counts.checked > 1_000, "{counts:?}");
    }
}

/// A split map of `seeds` random vertices and all that these need.
fn random_split(lattice: &Lattice, seeds: usize) -> SplitMap {
    let (mut split, mut random) = (SplitMap::new(lattice), Random::new(9));
    for _ in 0..seeds {
        let vertex = [0; 2].map(|_| random.below(u64::from(lattice.side()) + 1) as u32);
        split.insert(lattice, vertex);
    }
    split
}

/// Loads a map, and draws it once.
fn map_beats<'a>(lattice: &'a Lattice, split: &'a SplitMap) -> Box<dyn Iterator<Item = Beat> + 'a> {
    let height = |at: usize| (at as u32).wrapping_mul(2_654_435_761) >> 12;
    let load = load_beats(lattice, |at| u16::from(split.get(at)), height);
    Box::new(load.chain([command_beat(&Command::Draw(Bound::constant(0)))]))
}

fn run(set: &WidthSet, beats: Box<dyn Iterator<Item = Beat> + '_>, pattern: Pattern) -> (Counts, Vec<Vec<u64>>) {
    let mut scoreboard = Scoreboard::new(&BisectorBinding, set, beats, pattern);
    let layout = scoreboard.layout().clone();
    let mut taken = Vec::new();
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, inputs, outputs| {
            if outputs[layout.out_valid] == 1 && inputs[layout.out_ready] == 1 {
                taken.push(
                    layout.out_fields().flat_map(|(port, at)| &outputs[*at..at + port.words()]).copied().collect(),
                );
            }
            Ok(())
        })
        .unwrap_or_else(|mismatch| panic!("{} {pattern:?}: {mismatch}", set.name));
    (counts, taken)
}

#[test]
fn bisector_latency_is_its_constant() {
    for set in WIDTH_SETS {
        let lattice = Lattice::of(2, 2, false).unwrap();
        let split = SplitMap::new(&lattice);
        let mut stage = Stage::new(BisectorBinding.device(set));
        let mut cycles = 0;
        for beat in map_beats(&lattice, &split) {
            stage.offer(&beat);
            stage.settle();
            assert!(stage.accepts(), "beats of a load are taken one a cycle");
            stage.device.edge();
            stage.withdraw();
        }
        loop {
            cycles += 1;
            stage.settle();
            if stage.outputs[stage.layout.out_valid] == 1 {
                break;
            }
            assert!(cycles < 100, "no triangle");
            stage.device.edge();
        }
        let latency = with_width_set!(set.name, W => W::Bisector::LATENCY).unwrap();
        assert_eq!(cycles, latency, "{}", set.name);
        assert_eq!(BisectorBinding.latency(), latency.to_string());
    }
}

#[test]
fn bisector_takes_two_cycles_a_triangle() {
    // Whole columns of the last lattice are dead.
    let maps = [(257, 257, 4_000), (200, 257, 9_000), (251, 131, 3_000), (256, 256, 60_000), (3, 257, 60_000)];
    println!("| map, splits at random | triangles | cycles a triangle |\n|---|---:|---:|");
    for (width, height, seeds) in maps {
        let lattice = Lattice::of(width, height, false).unwrap();
        let split = random_split(&lattice, seeds);
        let counts = golden(&lattice, &split, &mut |_| {});
        let (checked, beats) = run(&small::SET, map_beats(&lattice, &split), Pattern::NONE);
        assert_eq!(checked.checked, counts.triangles + 1);
        let [end] = &beats[beats.len() - 1..] else { panic!("no beat") };
        assert_eq!(end[END], 1);
        let cycles = end[CYCLES];
        // A turn a cycle, filling and draining. The vertices that strips begin with wait in a queue, and it does not fill.
        let turns = counts.turns;
        assert!((turns..turns + 32).contains(&cycles), "{width} x {height}: {cycles} cycles, {counts:?}");
        let rate = cycles as f64 / counts.triangles as f64;
        println!("| {width} x {height} | {} | {rate:.3} |", counts.triangles);
        let most = if width == 3 { 3.0 } else { 2.04 };
        assert!(rate <= most, "{width} x {height}: {rate} cycles a triangle");
        // Stalled cycles do not count.
        let (_, stalled) = run(&small::SET, map_beats(&lattice, &split), Pattern { idle: 0, stall: 60, seed: 5 });
        let (end, before) = stalled.split_last().unwrap();
        assert_eq!((before.len(), end[CYCLES]), (beats.len() - 1, cycles));
    }
}

/// All that there is to do lies below one of the roots, in a corner: the other walkers have to take it from each other.
#[test]
fn bisector_keeps_its_pace_on_lopsided_maps() {
    let lattice = Lattice::of(257, 257, false).unwrap();
    let (mut split, mut random) = (SplitMap::new(&lattice), Random::new(4));
    for _ in 0..3_000 {
        let u = random.below(60) as u32;
        split.insert(&lattice, [u, u + 1 + random.below(40) as u32]);
    }
    let counts = golden(&lattice, &split, &mut |_| {});
    let (_, beats) = run(&small::SET, map_beats(&lattice, &split), Pattern::NONE);
    let mut shares = [0; WALKERS];
    beats.iter().filter(|beat| beat[END] == 0).for_each(|beat| shares[beat[WALKER] as usize] += 1);
    let fair = counts.triangles / WALKERS as u64;
    assert!(counts.triangles > 2_000 && counts.thefts >= 6, "{counts:?}");
    assert!(shares.iter().all(|&share| share > fair / 2), "{shares:?}");
    let rate = beats[beats.len() - 1][CYCLES] as f64 / counts.triangles as f64;
    assert!(rate <= 2.0 + 0.1, "{rate} cycles a triangle, {counts:?}");
}

#[test]
fn bisector_errors_are_sticky_and_come_with_their_beat() {
    let set = &small::SET;
    let size = |width, height, levels| Command::Size { width, height, levels, mirrored: false };
    let (sample, draw) = (Command::Sample { error: 1, z: 77 }, Command::Draw(Bound::constant(0)));
    let good = [size(2, 3, 1), sample, sample, sample, sample, sample, sample, sample, sample, sample, draw];
    let faults = [
        size(1, 2, 1),
        size(2, 0, 1),
        size(4, 2, 1),
        size(2, 4, 1),
        size(2, 2, 9),
        size(258, 2, 8),
        sample,
        // A draw before the map is whole.
        size(2, 2, 0),
    ];
    for pattern in [Pattern::NONE, Pattern { idle: 30, stall: 50, seed: 2 }] {
        let errors = |commands: &[Command]| {
            let beats: Vec<Beat> = commands.iter().map(command_beat).collect();
            let (counts, beats) = run(set, Box::new(beats.into_iter()), pattern);
            (counts.checked, beats.iter().map(|beat| beat[8]).collect::<Vec<_>>())
        };
        let (checked, all) = errors(&good);
        assert_eq!((checked, all), (5, vec![0; 5]));
        for fault in faults {
            let (_, all) = errors(&[&good[..], &[fault, draw], &good[..]].concat());
            assert_eq!(all[..5], [0; 5], "{fault:?}");
            // Only a sample too many leaves the map as it was.
            assert_eq!(all.len(), if fault == sample { 15 } else { 11 }, "{fault:?}");
            assert!(all[5..].iter().all(|&error| error == 1), "{fault:?}");
        }
    }
}

/// Whenever the reset comes, what was on its way is gone, and so is the map.
#[test]
fn bisector_reset_in_the_middle_of_a_draw() {
    let lattice = Lattice::of(5, 4, false).unwrap();
    let split = random_split(&lattice, 12);
    let beats: Vec<Beat> = map_beats(&lattice, &split).collect();
    let device = || Box::new(Stepped::new(Hardware::<4, 5, 4, 1>::default()));
    let play = |stage: &mut Stage, cycles: usize| {
        let (mut sent, mut taken) = (0, Vec::new());
        for cycle in 0..cycles {
            match beats.get(sent) {
                Some(beat) => stage.offer(beat),
                None => stage.withdraw(),
            }
            stage.inputs[stage.layout.out_ready] = u64::from(cycle % 3 != 0);
            stage.settle();
            sent += usize::from(stage.accepts());
            if stage.sends() {
                taken.push(corners_of(&stage.sent()));
            }
            stage.device.edge();
        }
        taken
    };
    let whole = play(&mut Stage::new(device()), 400);
    assert!(whole.len() > 10);
    for cycles in 0..200 {
        let mut stage = Stage::new(device());
        play(&mut stage, cycles);
        stage.device.reset(1 + cycles % 2);
        // A draw finds no map.
        stage.offer(&beats[beats.len() - 1]);
        stage.inputs[stage.layout.out_ready] = 1;
        let mut ends = Vec::new();
        for _ in 0..40 {
            stage.settle();
            let accepts = stage.accepts();
            if stage.sends() {
                ends.push(stage.sent()[END]);
            }
            stage.device.edge();
            if accepts {
                stage.withdraw();
            }
        }
        assert_eq!(ends, [1], "after {cycles} cycles");
        assert_eq!(play(&mut stage, 400), whole, "after {cycles} cycles");
    }
}

/// The beats of the step port that make a walker's strips.
fn steps_of(beat: &[u64], corners: [Vertex; 3]) -> Vec<Step> {
    let [left, right, new] = corners.map(|corner| {
        let mut vertex = [0; MAX_COMPONENTS];
        vertex.iter_mut().zip(corner).for_each(|(to, from)| *to = i64::from(from));
        vertex
    });
    let step = |kind, left_command, right_command, left_vertex, right_vertex| Step {
        kind,
        left: left_command,
        right: right_command,
        swap: false,
        last: false,
        left_vertex,
        right_vertex,
    };
    let start = step(Kind::Start, LeftCommand::Set, RightCommand::Set, left, right);
    let next = match beat[SIDE] {
        0 => step(Kind::Step, LeftCommand::Set, RightCommand::Ref, new, [0; MAX_COMPONENTS]),
        _ => step(Kind::Step, LeftCommand::Ref, RightCommand::Set, [0; MAX_COMPONENTS], new),
    };
    if beat[START] == 1 { vec![start, next] } else { vec![next] }
}

/// A vertex a triangle goes to the strip units, one for each walker, and the same triangles come out.
#[test]
fn bisector_feeds_the_strip_unit() {
    let lattice = Lattice::of(100, 70, false).unwrap();
    let split = random_split(&lattice, 900);
    let (_, beats) = run(&small::SET, map_beats(&lattice, &split), Pattern::NONE);
    let mut units = [0; WALKERS].map(|_| Stage::new(StripUnitBinding.device(&position::SET)));
    let ports = relief_testbench::remesh::TrianglePorts::of(&units[0].layout, &position::SET);
    let (mut sent, mut triangles) = (0, 0);
    for beat in beats.iter().filter(|beat| beat[END] == 0) {
        let unit = &mut units[beat[WALKER] as usize];
        unit.inputs[unit.layout.out_ready] = 1;
        let corners = corners_of(beat);
        let mut decoded = Vec::new();
        for step in steps_of(beat, corners) {
            sent += usize::from(step.sends_left()) + usize::from(step.sends_right());
            unit.offer(&words_of(&position::SET, &step));
            unit.settle();
            assert!(unit.accepts());
            unit.device.edge();
            unit.withdraw();
            for _ in 0..position::StripUnit::LATENCY {
                unit.settle();
                decoded.extend(ports.triangles(&unit.outputs));
                unit.device.edge();
            }
        }
        let mut triangle = corners.map(|corner| corner.map(i64::from));
        let [mut got] = decoded[..] else { panic!("{} triangles of one beat", decoded.len()) };
        // Which corner comes first does not matter, the winding does.
        let first = |corners: &mut [[i64; 3]; 3]| {
            let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or_default();
            corners.rotate_left(least);
        };
        first(&mut triangle);
        first(&mut got);
        assert_eq!(got, triangle);
        triangles += 1;
    }
    assert!(triangles > 2_000 && sent < triangles + triangles / 10, "{sent} vertices for {triangles} triangles");
}

/// The largest map.
#[test]
fn bisector_draws_maps_of_4097_samples_a_side() {
    let lattice = Lattice::of(4097, 4097, false).unwrap();
    let split = random_split(&lattice, 300);
    let (counts, beats) = run(&deep::SET, map_beats(&lattice, &split), Pattern::NONE);
    assert_eq!(counts.accepted, 4097 * 4097 + 2);
    assert!(beats.len() > 5_000 && beats.iter().all(|beat| beat[8] == 0), "{}", beats.len());
}
