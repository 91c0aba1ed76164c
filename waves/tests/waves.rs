// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is recorded is what is read, trimmed, drawn and listed.

use relief_waves::{
    Drawing, Format, Group, Item, Label, Scope, Signal, SignalTree, TreeError, Value, VcdRecorder, Waves, draw,
    draw::DrawError, gtkw, read, trim, trim::TrimError,
};
use std::{collections::HashSet, fs, fs::File, ops::Range, path::Path};

const LANES: usize = 13;
const LANE_BITS: usize = 46;
const STATES: [&str; 3] = ["Idle", "Sweep", "Drain"];

fn tree() -> SignalTree {
    let sweep = Scope::new("sweep")
        .with(Signal::signed("row_left", 16))
        .with(Signal::names("state", STATES))
        .with(Signal::lanes("vertex", LANES, LANE_BITS));
    let root = Scope::new("remesher")
        .with(Signal::unsigned("in_valid", 1))
        .with(Signal::unsigned("in_ready", 1))
        .with(sweep)
        .with(Signal::unsigned("in_vertex", 598));
    SignalTree::new(root).expect("the names are sound")
}

/// A small generator with a full period (Knuth's constants), so that the tests need no seed from outside.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 ^ self.0 >> 29
    }
}

/// Values that stand still as often as they change, with the extremes among them.
fn samples(tree: &SignalTree, cycles: usize) -> Vec<Vec<u64>> {
    let mut numbers = Numbers(7);
    let mut sample = vec![0; tree.words()];
    (0..cycles)
        .map(|_| {
            for place in tree.places() {
                let words = &mut sample[place.word..place.word + place.signal.words()];
                match numbers.next() >> 60 {
                    0..8 => continue,
                    8 => words.fill(0),
                    9 => words.fill(u64::MAX),
                    _ => words.iter_mut().for_each(|word| *word = numbers.next()),
                }
                if place.path.ends_with("state") {
                    words[0] %= STATES.len() as u64;
                }
                let spare = words.len() * 64 - place.signal.bits;
                if let Some(last) = words.last_mut() {
                    *last &= u64::MAX >> spare;
                }
            }
            sample.clone()
        })
        .collect()
}

fn record(path: &Path, samples: &[Vec<u64>], window: Range<u64>) -> Option<Range<u64>> {
    let mut recorder = VcdRecorder::new(File::create(path).expect("a file"), tree(), window);
    for (cycle, sample) in samples.iter().enumerate() {
        if recorder.wants(cycle as u64) {
            recorder.sample(cycle as u64, sample).expect("a sample");
        }
    }
    recorder.finish().expect("a whole file")
}

fn bits(words: &[u64], from: usize, count: usize) -> String {
    (from..from + count).rev().map(|bit| if words[bit / 64] >> (bit % 64) & 1 == 1 { '1' } else { '0' }).collect()
}

/// Every signal in every cycle, lanes one by one; returns how many values were compared.
fn assert_same(waves: &Waves, samples: &[Vec<u64>], cycles: Range<u64>) -> usize {
    let tree = tree();
    let mut compared = 0;
    assert_eq!(waves.cycles(), cycles);
    for cycle in cycles {
        let sample = &samples[cycle as usize];
        for place in tree.places() {
            let words = &sample[place.word..place.word + place.signal.words()];
            let mut expect = |name: &str, text: String| {
                let value = waves.value(name, cycle).unwrap_or_else(|| panic!("{name} in cycle {cycle}"));
                assert_eq!(value.to_string(), text, "{name} in cycle {cycle}");
                compared += 1;
            };
            match place.path.as_str() {
                "remesher.sweep.state" => expect(&place.path, STATES[words[0] as usize].into()),
                "remesher.sweep.vertex" => (0..LANES).for_each(|lane| {
                    expect(&format!("{}[{lane}]", place.path), bits(words, lane * LANE_BITS, LANE_BITS));
                }),
                path => expect(path, bits(words, 0, place.signal.bits)),
            }
        }
    }
    compared
}

#[test]
fn recorder_round_trip_keeps_every_value() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("whole.vcd");
    let samples = samples(&tree(), 200);
    assert_eq!(record(&path, &samples, 0..u64::MAX), Some(0..200));
    let waves = read(&path).expect("a readable file");
    assert_eq!(waves.clock(), "remesher.clock");
    assert_eq!(assert_same(&waves, &samples, 0..200), 200 * (5 + LANES));
    assert_eq!(waves.traces().count(), 5 + LANES);
}

#[test]
fn recorder_writes_signed_lanes_and_minimum_values() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("minimum.vcd");
    let tree = SignalTree::new(Scope::new("top").with(Signal::lanes("pair", 2, 46)).with(Signal::signed("one", 64)));
    let mut recorder = VcdRecorder::new(File::create(&path).expect("a file"), tree.expect("sound names"), 0..u64::MAX);
    // Lane 0 is the minimum, lane 1 minus one.
    let pair = (u128::from(u64::MAX >> 18) << 46) | 1 << 45;
    recorder.sample(0, &[pair as u64, (pair >> 64) as u64, 1 << 63]).expect("a sample");
    recorder.finish().expect("a whole file");
    let waves = read(&path).expect("a readable file");
    let signed = |name| waves.value(name, 0).and_then(Value::signed);
    assert_eq!(signed("pair[0]"), Some(-(1 << 45)));
    assert_eq!(signed("pair[1]"), Some(-1));
    assert_eq!(signed("one"), Some(i64::MIN.into()));
}

#[test]
fn recorder_keeps_elements_of_one_bit_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bits.vcd");
    let scope = (0..4).fold(Scope::new("top"), |scope, k| scope.with(Signal::unsigned(format!("full[{k}]"), 1)));
    let scope = scope.with(Scope::new("row[1]").with(Signal::unsigned("full", 1)).with(Signal::lanes("sign", 3, 1)));
    let tree = SignalTree::new(scope).expect("sound names");
    let mut recorder = VcdRecorder::new(File::create(&path).expect("a file"), tree, 0..2);
    recorder.sample(0, &[0, 1, 0, 1, 1, 0b101]).expect("a sample");
    recorder.sample(1, &[1, 1, 0, 0, 0, 0b010]).expect("a sample");
    recorder.finish().expect("a whole file");
    let cut = folder.path().join("cut.vcd");
    trim(&path, &cut, 0..2).expect("a cut");
    for file in [path, cut] {
        let waves = read(file).expect("a readable file");
        let high = |name: &str, cycle| waves.value(name, cycle).expect(name).is_high();
        assert_eq!([0, 1, 2, 3].map(|k| high(&format!("top.full[{k}]"), 0)), [false, true, false, true]);
        assert_eq!([0, 1, 2, 3].map(|k| high(&format!("top.full[{k}]"), 1)), [true, true, false, false]);
        assert_eq!([high("top.row[1].full", 0), high("top.row[1].full", 1)], [true, false]);
        assert_eq!([0, 1, 2].map(|k| high(&format!("top.row[1].sign[{k}]"), 0)), [true, false, true]);
        assert_eq!(waves.traces().count(), 8);
    }
}

#[test]
fn recorder_window_is_exact() {
    let folder = tempfile::tempdir().expect("a folder");
    let samples = samples(&tree(), 60);
    for window in [0..1, 17..18, 17..40, 59..60, 0..60] {
        let path = folder.path().join(format!("{}.vcd", window.start));
        assert_eq!(record(&path, &samples, window.clone()), Some(window.clone()));
        let waves = read(&path).expect("a readable file");
        let values = (window.end - window.start) as usize * (5 + LANES);
        assert_eq!(assert_same(&waves, &samples, window), values);
    }
    let path = folder.path().join("never.vcd");
    assert_eq!(record(&path, &samples, 100..200), None);
    assert_eq!(fs::metadata(path).expect("the file").len(), 0);
}

#[test]
fn recorder_refuses_gaps_and_foreign_samples() {
    let mut recorder = VcdRecorder::new(Vec::new(), tree(), 0..10);
    let sample = vec![0; tree().words()];
    assert!(recorder.sample(0, &sample[1..]).is_err());
    recorder.sample(3, &sample).expect("the first cycle is free");
    assert!(recorder.sample(3, &sample).is_err());
    assert!(recorder.sample(5, &sample).is_err());
    recorder.sample(4, &sample).expect("the next cycle");
}

#[test]
fn recorder_ring_keeps_what_stands_round_the_first_trigger() {
    let folder = tempfile::tempdir().expect("a folder");
    let samples = samples(&tree(), 100);
    for (trigger, expected) in [(50, 43..55), (3, 0..8), (98, 91..100)] {
        let path = folder.path().join(format!("{trigger}.vcd"));
        let mut recorder = VcdRecorder::around(File::create(&path).expect("a file"), tree(), 8, 4);
        for (cycle, sample) in (0..).zip(&samples) {
            if recorder.wants(cycle) {
                recorder.sample(cycle, sample).expect("a sample");
            }
            // The second mismatch must not move the window.
            if cycle == trigger || cycle == trigger + 2 {
                recorder.trigger().expect("the ring is written");
            }
        }
        assert_eq!(recorder.is_done(), trigger != 98);
        assert_eq!(recorder.finish().expect("a whole file"), Some(expected.clone()));
        assert_same(&read(&path).expect("a readable file"), &samples, expected);
    }
    let mut silent = VcdRecorder::around(Vec::new(), tree(), 8, 4);
    (0..20).for_each(|cycle| silent.sample(cycle, &samples[0]).expect("a sample"));
    assert_eq!(silent.finish().expect("nothing to write"), None);
}

#[test]
fn trim_keeps_exactly_the_window() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = folder.path().join("whole.vcd");
    let cut = folder.path().join("cut.vcd");
    let samples = samples(&tree(), 80);
    record(&whole, &samples, 10..80);
    for (window, expected) in [(20..30, 20..30), (0..11, 10..11), (79..900, 79..80), (33..34, 33..34)] {
        assert_eq!(trim(&whole, &cut, window).expect("a cut"), expected);
        assert_same(&read(&cut).expect("a readable cut"), &samples, expected);
    }
    assert!(matches!(trim(&whole, &cut, 0..10), Err(TrimError::Empty { held, .. }) if held == (10..80)));
    // A cut of a cut is still numbered as in the simulation.
    assert_eq!(trim(&whole, &cut, 20..40).expect("a cut"), 20..40);
    let twice = folder.path().join("twice.vcd");
    assert_eq!(trim(&cut, &twice, 25..26).expect("a second cut"), 25..26);
    assert_same(&read(&twice).expect("a readable cut"), &samples, 25..26);
}

#[test]
fn read_reports_unknown_bits_and_what_is_missing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("x.vcd");
    let dump = "$timescale 1ns $end $scope module top $end $var wire 1 ! clock $end $var wire 4 # bus [3:0] $end \
                $upscope $end $enddefinitions $end\n#0\n0!\nb1x0z #\n#5\n1!\n#10\n0!\nb101 #\n#15\n1!\nb111 #\n";
    fs::write(&path, dump).expect("a file");
    let waves = read(&path).expect("a readable file");
    assert_eq!(waves.cycles(), 0..2);
    let first = waves.value("bus", 0).expect("a value");
    assert_eq!((first.to_string().as_str(), first.is_known(), first.unsigned()), ("1x0x", false, None));
    // What changes in the instant of the edge is not yet sampled.
    assert_eq!(waves.value("top.bus", 1).and_then(Value::unsigned), Some(5));
    assert_eq!(waves.value("bus", 2), None);
    assert!(relief_waves::read_with_clock(&path, "strobe").is_err());
    let missing = read(folder.path().join("none.vcd")).expect_err("no such file").to_string();
    assert!(
        missing.ends_with("none.vcd` cannot be read as a waveform: No such file or directory (os error 2)"),
        "{missing}"
    );
    fs::write(&path, "not a waveform").expect("a file");
    assert!(read(&path).is_err());
}

#[test]
fn read_and_trim_take_fst_as_well() {
    use fst_writer::{FstFileType, FstInfo, FstScopeType, FstSignalType, FstVarDirection, FstVarType};
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("count.fst");
    let info = FstInfo {
        start_time: 0,
        timescale_exponent: -9,
        version: String::new(),
        date: String::new(),
        file_type: FstFileType::Verilog,
    };
    let mut header = fst_writer::open_fst(&path, &info).expect("a file");
    header.scope("top", "", FstScopeType::Module).expect("a scope");
    let mut var = |name, bits| {
        let bits = FstSignalType::bit_vec(bits);
        header.var(name, bits, FstVarType::Wire, FstVarDirection::Implicit, None).expect("a variable")
    };
    let (clock, count) = (var("clock", 1), var("count", 8));
    header.up_scope().expect("the end of the scope");
    let mut body = header.finish().expect("a header");
    for cycle in 0..20u64 {
        body.time_change(10 * cycle + 5).expect("a time");
        body.signal_change(clock, b"0").expect("a value");
        body.signal_change(count, format!("{:08b}", cycle * 3).as_bytes()).expect("a value");
        body.time_change(10 * cycle + 10).expect("a time");
        body.signal_change(clock, b"1").expect("a value");
    }
    body.finish().expect("a whole file");
    let cut = folder.path().join("cut.vcd");
    assert_eq!(trim(&path, &cut, 7..12).expect("a cut"), 7..12);
    for (file, cycles) in [(path, 0..20), (cut, 7..12)] {
        let waves = read(file).expect("a readable file");
        assert_eq!(waves.cycles(), cycles);
        for cycle in cycles {
            assert_eq!(waves.value("count", cycle).and_then(Value::unsigned), Some(u128::from(cycle * 3)));
        }
    }
}

#[test]
fn tree_refuses_names_that_a_file_cannot_hold() {
    let flag = |name: &str| Signal::unsigned(name, 1);
    let tree = |scope: Scope| SignalTree::new(scope);
    assert_eq!(tree(Scope::new("a").with(flag("b c"))), Err(TreeError::Name("b c".into())));
    assert_eq!(tree(Scope::new("")), Err(TreeError::Name(String::new())));
    assert_eq!(tree(Scope::new("a").with(flag("b")).with(flag("b"))), Err(TreeError::Twice("a.b".into())));
    assert_eq!(tree(Scope::new("a").with(flag("clock"))), Err(TreeError::Clock("a.clock".into())));
    let lanes = Scope::new("a").with(Signal::lanes("v", 2, 4)).with(Signal::unsigned("v[1]", 4));
    assert_eq!(tree(lanes), Err(TreeError::Twice("a.v[1]".into())));
    assert_eq!(tree(Scope::new("a").with(Signal::unsigned("w", 0))), Err(TreeError::Width("a.w".into(), 0)));
}

#[test]
fn gtkw_names_only_wires_of_the_dump() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("dump.vcd");
    record(&path, &samples(&tree(), 3), 0..3);
    let dump = fs::read_to_string(&path).expect("the dump");
    let mut declared = HashSet::new();
    let mut scope: Vec<&str> = Vec::new();
    for line in dump.lines() {
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["$scope", _, name, "$end"] => scope.push(name),
            ["$upscope", "$end"] => drop(scope.pop()),
            ["$var", _, _, _, name, "$end"] => drop(declared.insert(format!("{}.{name}", scope.join(".")))),
            ["$var", _, _, _, name, range, "$end"] => {
                declared.insert(format!("{}.{name}{range}", scope.join(".")));
            }
            _ => (),
        }
    }
    let tree = tree();
    let text = gtkw(&tree, &Group::of_scopes(&tree), "dump.vcd").expect("known signals");
    let named: Vec<&str> = text.lines().filter(|line| !line.starts_with(['@', '-', '['])).collect();
    assert_eq!(named.len(), declared.len(), "every wire stands once");
    for name in named {
        assert!(declared.contains(name), "`{name}` is not in the dump");
    }
    assert!(text.contains("@420\nremesher.sweep.row_left[15:0]\n"), "{text}");
    assert!(text.contains("@820\nremesher.sweep.state\n"));
    assert!(text.contains("@28\nremesher.in_valid\n"));
    let hex = Group::new("left").with_format("remesher.sweep.row_left", Format::Hex);
    assert!(gtkw(&tree, &[hex], "dump.vcd").expect("known").contains("@22\nremesher.sweep.row_left[15:0]\n"));
    let unknown = gtkw(&tree, &[Group::new("g").with("remesher.none")], "dump.vcd");
    assert_eq!(
        unknown.expect_err("no such signal").to_string(),
        "the group `g` names the signal `remesher.none`, which the design does not have"
    );
}

#[test]
fn draw_is_well_formed_with_one_path_a_signal() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("dump.vcd");
    let samples = samples(&tree(), 40);
    record(&path, &samples, 0..40);
    let waves = read(&path).expect("a readable dump");
    for window in [0..1, 3..9, 0..40] {
        let drawing = Drawing::new("a <title> & \"more\"", window.clone())
            .heading("input")
            .stream("in", [("vertex", Label::Hex)])
            .heading("inside")
            .bus("row_left", Label::Signed)
            .bus("state", Label::Plain)
            .bus("vertex[12]", Label::Fixed(19));
        let svg = draw(&waves, &drawing).expect("a picture");
        assert_eq!(svg, draw(&waves, &drawing).expect("a picture"), "the same text each time");
        let document = roxmltree::Document::parse(&svg).expect("well-formed XML");
        let elements = |name: &'static str| document.descendants().filter(move |node| node.has_tag_name(name));
        // The clock, in_valid, in_ready, in_vertex and the three inside.
        assert_eq!(elements("path").count(), 7);
        let names: Vec<_> = elements("text").filter(|node| node.attribute("class") == Some("name")).collect();
        assert_eq!(names.len(), 7);
        let valid = |cycle: u64| samples[cycle as usize][0] == 1;
        let ready = |cycle: u64| samples[cycle as usize][1] == 1;
        let tinted = |class| elements("rect").filter(|node| node.attribute("class") == Some(class)).count();
        // A beat tints the three rows of its stream.
        assert_eq!(tinted("beat"), 3 * window.clone().filter(|&cycle| valid(cycle) && ready(cycle)).count());
        assert_eq!(tinted("stall"), 3 * window.clone().filter(|&cycle| valid(cycle) && !ready(cycle)).count());
        assert_eq!(tinted("unknown"), 0);
        let size = |name| document.root_element().attribute(name).and_then(|text| text.parse::<f64>().ok());
        let (width, height) = size("width").zip(size("height")).expect("a size");
        for node in document.descendants().filter(|node| node.is_element()) {
            for (name, most) in [("x", width), ("y", height), ("x1", width), ("x2", width), ("y1", height)] {
                let at = node.attribute(name).map(|text| text.parse::<f64>().expect("a number"));
                assert!(at.is_none_or(|at| (0.0..=most).contains(&at)), "{name} of {node:?} lies outside");
            }
        }
    }
}

#[test]
fn draw_refuses_what_is_not_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("dump.vcd");
    record(&path, &samples(&tree(), 10), 2..10);
    let waves = read(&path).expect("a readable dump");
    let error = |drawing: Drawing| draw(&waves, &drawing).expect_err("nothing to draw");
    assert_eq!(error(Drawing::new("", 0..5)), DrawError::Window { asked: 0..5, held: 2..10 });
    assert_eq!(error(Drawing::new("", 2..5).bit("none")), DrawError::Signal("none".into()));
}

#[test]
fn tree_finds_places_in_the_order_of_the_sample() {
    let tree = tree();
    let starts: Vec<usize> = tree.places().iter().map(|place| place.word).collect();
    assert_eq!(starts, [0, 1, 2, 3, 4, 14]);
    assert_eq!(tree.words(), 24);
    assert_eq!(tree.find("remesher.in_vertex").map(|place| place.word), Some(14));
    assert!(matches!(&tree.root().items[2], Item::Scope(scope) if scope.name == "sweep"));
}
