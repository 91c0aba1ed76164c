// SPDX-License-Identifier: MIT OR Apache-2.0
//! A reset in the middle of a stream, and stalls and silences of thousands of cycles: each block, against its golden model.
//! Nothing here knows a latency. That the tests can fail is shown by faults between
//! them and the block.

use rayon::prelude::*;
use relief_hdl::widths::{WIDTH_SETS, WidthSet};
use relief_testbench::binding::{BLOCKS, Beat, Binding, Expected, Model, Random};
use relief_testbench::device::Stage;
use relief_testbench::scoreboard::PATIENCE;
use std::collections::VecDeque;

/// Cycles of a long stall, and of a long silence of the source.
const LONG: u64 = 4_000;
/// Cycles in which nothing more may come after the last beat.
const DRAIN: u64 = 300;
/// Streams that a reset cuts, for a block and a width set.
const ROUNDS: u64 = 24;

/// What goes wrong on the way to the block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fault {
    /// A reset changes nothing.
    KeepsState,
    /// A beat that has long been refused is gone.
    Loses,
    /// A beat that has long been refused comes twice.
    Repeats,
    /// The first beat after a long silence is taken, and nothing follows from it.
    Swallows,
}

/// A block between a source and a sink, with its golden model beside it.
struct Bench<'a> {
    block: &'a dyn Binding,
    set: &'a WidthSet,
    stage: Stage,
    model: Box<dyn Model>,
    source: Box<dyn Iterator<Item = Beat>>,
    offered: Option<Beat>,
    expected: VecDeque<Expected>,
    held: Option<Vec<u64>>,
    accepted: u64,
    checked: u64,
    /// Cycles since the last handshake.
    silent: u64,
    /// Cycles in which a beat was refused.
    refused: u64,
    fault: Option<Fault>,
    /// Cycles for which the present beat has been refused, and for which none has been offered.
    stall: u64,
    rest: u64,
}

impl<'a> Bench<'a> {
    fn new(block: &'a dyn Binding, set: &'a WidthSet, fault: Option<Fault>, seed: u64) -> Self {
        Self {
            block,
            set,
            stage: Stage::new(block.device(set)),
            model: block.model(set),
            source: block.random(set, seed),
            offered: None,
            expected: VecDeque::new(),
            held: None,
            accepted: 0,
            checked: 0,
            silent: 0,
            refused: 0,
            fault,
            stall: 0,
            rest: 0,
        }
    }

    /// Resets the block under whatever is offered and wanted just now, and begins with another stream.
    fn reset(&mut self, cycles: usize, source: Box<dyn Iterator<Item = Beat>>) -> Result<(), String> {
        if self.fault != Some(Fault::KeepsState) {
            self.stage.device.reset(cycles);
        }
        self.stage.withdraw();
        self.stage.settle();
        if self.stage.outputs[self.stage.layout.out_valid] != 0 {
            return Err("a beat is left over from before the reset".into());
        }
        let Self { block, set, .. } = *self;
        (self.model, self.source) = (block.model(set), source);
        (self.offered, self.held) = (None, None);
        self.expected.clear();
        (self.accepted, self.checked, self.silent) = (0, 0, 0);
        Ok(())
    }

    /// One cycle: the source offers its next beat unless it rests, and the sink takes one or does not.
    fn cycle(&mut self, offers: bool, takes: bool) -> Result<(), String> {
        if self.offered.is_none() && offers {
            self.offered = self.source.next();
            if let Some(beat) = &self.offered {
                self.stage.offer(beat);
            }
        }
        let Stage { inputs, layout, .. } = &mut self.stage;
        inputs[layout.out_ready] = u64::from(takes);
        self.stage.settle();
        let taken = self.stage.accepts();
        self.tamper(takes);
        self.check(takes)?;
        self.silent += 1;
        if taken || takes && self.stage.sends() {
            self.silent = 0;
        }
        if taken && let Some(beat) = self.offered.take() {
            let mut follows = Vec::new();
            self.model.accept(&beat, &mut follows);
            self.expected.extend(follows);
            self.accepted += 1;
            self.stage.withdraw();
        }
        self.stage.device.edge();
        Ok(())
    }

    /// Lets the block see another handshake than the source and the sink, where the fault wants it.
    fn tamper(&mut self, takes: bool) {
        let Stage { device, layout, inputs, outputs } = &mut self.stage;
        let (offered, sends) = (inputs[layout.in_valid] == 1, outputs[layout.out_valid] == 1);
        let mut seen = inputs.clone();
        match self.fault {
            Some(Fault::Loses) if sends && !takes && self.stall == LONG / 2 => seen[layout.out_ready] = 1,
            Some(Fault::Repeats) if sends && takes && self.stall >= LONG / 2 => seen[layout.out_ready] = 0,
            Some(Fault::Swallows) if offered && outputs[layout.in_ready] == 1 && self.rest >= LONG / 2 => {
                seen[layout.in_valid] = 0;
            }
            _ => {}
        }
        if seen != *inputs {
            device.settle(&seen, &mut vec![0; layout.output_words]);
        }
        self.stall = if sends && !takes { self.stall + 1 } else { 0 };
        // A block may look at a beat for some cycles before it takes it.
        self.rest = match (offered, outputs[layout.in_ready] == 1) {
            (true, true) => 0,
            (true, false) => self.rest,
            (false, _) => self.rest + 1,
        };
    }

    fn check(&mut self, takes: bool) -> Result<(), String> {
        let at = format!("beat {}", self.checked);
        if self.stage.outputs[self.stage.layout.out_valid] != 1 {
            return if self.held.is_some() { Err(format!("{at} was refused and is gone")) } else { Ok(()) };
        }
        let got = self.stage.sent();
        let Some(Expected { words, mask }) = self.expected.front() else {
            return Err(format!("{at} is one too many: {got:x?}"));
        };
        if words.iter().zip(&got).zip(mask).any(|((word, got), mask)| (word ^ got) & mask != 0) {
            return Err(format!("{at}: expected {words:x?}, got {got:x?}"));
        }
        if self.held.as_ref().is_some_and(|held| *held != got) {
            return Err(format!("{at} was refused and is another one now"));
        }
        if takes {
            self.expected.pop_front();
            self.held = None;
            self.checked += 1;
        } else {
            self.refused += 1;
            self.held = Some(got);
        }
        Ok(())
    }

    /// Cycles with rests of the source and of the sink.
    fn play(&mut self, cycles: u64, (idle, stall): (u8, u8), random: &mut Random) -> Result<(), String> {
        (0..cycles).try_for_each(|_| {
            let offers = !random.chance(idle);
            self.cycle(offers, !random.chance(stall))
        })
    }

    /// Plays until so many beats have been accepted and so many have come, takes all that follows, and waits for what must
    /// not come.
    fn finish(&mut self, accepted: u64, checked: u64) -> Result<(), String> {
        let mut goes_on = true;
        while goes_on || self.offered.is_some() || !self.expected.is_empty() {
            self.cycle(goes_on, true)?;
            goes_on &= self.accepted < accepted || self.checked < checked;
            if self.silent > PATIENCE {
                return Err(format!("{} beats are missing", self.expected.len()));
            }
        }
        (0..DRAIN).try_for_each(|_| self.cycle(false, true))
    }
}

const PATTERNS: [(u8, u8); 4] = [(0, 0), (30, 0), (0, 60), (40, 50)];

/// Streams that a reset cuts at a random cycle, each compared from its beginning; the last one is played to its end. Half of
/// them begin in the middle: the block must not remember the map or the vertices of the stream before.
fn reset_run(block: &dyn Binding, set: &WidthSet, fault: Option<Fault>) -> Result<[u64; 2], String> {
    let mut random = Random::new(77);
    let mut bench = Bench::new(block, set, fault, 0);
    let mut under_way = 0;
    for round in 1..=ROUNDS {
        bench.play(random.below(1500), PATTERNS[round as usize % PATTERNS.len()], &mut random)?;
        under_way += u64::from(!bench.expected.is_empty());
        let skipped = if round % 2 == 0 { random.below(60) } else { 0 };
        let source = block.random(set, round).skip(skipped as usize);
        bench.reset(1 + random.below(3) as usize, Box::new(source)).map_err(|why| format!("round {round}: {why}"))?;
    }
    bench.finish(400, 100)?;
    Ok([under_way, bench.checked])
}

/// Long stalls, long silences, and both at once, between cycles of traffic.
fn stall_run(block: &dyn Binding, set: &WidthSet, fault: Option<Fault>) -> Result<[u64; 2], String> {
    let mut random = Random::new(78);
    let mut bench = Bench::new(block, set, fault, 5);
    for round in 0..3 {
        for (offers, takes) in [(true, false), (false, true), (false, false)] {
            let cycles = 50 + random.below(400);
            bench.play(cycles, PATTERNS[(round + 1) % PATTERNS.len()], &mut random)?;
            (0..LONG).try_for_each(|_| bench.cycle(offers, takes))?;
        }
    }
    let accepted = bench.accepted + 100;
    bench.finish(accepted, 0)?;
    Ok([bench.refused, bench.checked])
}

/// Runs each block at two width sets.
fn everywhere(run: impl Fn(&dyn Binding, &WidthSet) + Sync) {
    let sets: Vec<&WidthSet> = WIDTH_SETS.iter().filter(|set| ["position", "small"].contains(&set.name)).collect();
    let all = BLOCKS.iter().flat_map(|block| sets.iter().map(move |set| (*block, *set)));
    let runs: Vec<_> = all.filter(|(block, set)| block.offered(set)).collect();
    assert!(runs.len() > BLOCKS.len() && sets.len() == 2);
    runs.into_par_iter().for_each(|(block, set)| run(block, set));
}

#[test]
fn reset_in_the_middle_of_a_stream_leaves_nothing_behind() {
    everywhere(|block, set| {
        let name = block.name();
        let [under_way, checked] =
            reset_run(block, set, None).unwrap_or_else(|why| panic!("{name} {}: {why}", set.name));
        // Otherwise there was nothing to forget.
        assert!(under_way >= 2 && checked >= 100, "{name} {}: {under_way} cut, {checked} beats", set.name);
        let fault = reset_run(block, set, Some(Fault::KeepsState));
        assert!(fault.is_err(), "{name} {}: a reset that does nothing was not noticed", set.name);
    });
}

#[test]
fn stalls_and_silences_of_thousands_of_cycles_lose_nothing() {
    everywhere(|block, set| {
        let name = block.name();
        let [refused, checked] = stall_run(block, set, None).unwrap_or_else(|why| panic!("{name} {}: {why}", set.name));
        // In each of three stalls at least, a beat stood nearly all the time.
        assert!(refused > 3 * (LONG - 1_000) && checked > 20, "{name} {}: {refused}, {checked} beats", set.name);
        for fault in [Fault::Loses, Fault::Repeats, Fault::Swallows] {
            let run = stall_run(block, set, Some(fault));
            assert!(run.is_err(), "{name} {}: {fault:?} was not noticed", set.name);
        }
    });
}
