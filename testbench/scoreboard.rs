// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drives a block beat by beat and compares every output beat with the golden model, under idle cycles and
//! backpressure. The cycles it plays can be replayed in other simulators ([`crate::check`]).

use crate::binding::{Beat, Binding, Expected, Random};
use crate::device::{Device, Layout};
use relief_hdl::widths::WidthSet;
use std::collections::VecDeque;

/// Cycles without any handshake after which a block hangs. The longest silence of a sound block is a division.
pub const PATIENCE: u64 = 20_000;

/// How often the source idles and the sink stalls, in percent, and the seed of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// Percentage of cycles in which no beat is offered.
    pub idle: u8,
    /// Percentage of cycles in which no beat is taken.
    pub stall: u8,
    /// Seed of the pattern.
    pub seed: u64,
}

impl Pattern {
    /// Full speed.
    pub const NONE: Self = Self { idle: 0, stall: 0, seed: 0 };
}

/// The first beat that is not as expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mismatch {
    /// Output beat, counted from 0.
    pub beat: u64,
    /// Cycle, counted from the reset.
    pub cycle: u64,
    /// Port.
    pub port: String,
    /// What was expected, in hexadecimal or words.
    pub expected: String,
    /// What came.
    pub got: String,
}

impl std::fmt::Display for Mismatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { beat, cycle, port, expected, got } = self;
        write!(f, "beat {beat}, cycle {cycle}, port {port}: expected {expected}, got {got}")
    }
}

/// Counts of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cycles since the reset.
    pub cycles: u64,
    /// Input beats accepted.
    pub accepted: u64,
    /// Output beats taken and compared.
    pub checked: u64,
}

/// Sees every cycle: its inputs and its outputs. `Err` ends the run.
pub type Observer<'a> = dyn FnMut(&dyn Device, &[u64], &[u64]) -> Result<(), Mismatch> + 'a;

/// A run of one block against its golden model.
pub struct Scoreboard<'a> {
    device: Box<dyn Device>,
    layout: Layout,
    model: Box<dyn crate::binding::Model>,
    source: Box<dyn Iterator<Item = Beat> + 'a>,
    pattern: Pattern,
    random: Random,
    inputs: Vec<u64>,
    outputs: Vec<u64>,
    /// The beat offered, with the outputs that the golden model makes of it.
    offered: Option<Beat>,
    expected: VecDeque<Expected>,
    scratch: Vec<Expected>,
    held: Option<Vec<u64>>,
    counts: Counts,
    silent: u64,
}

/// What ends a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Until {
    /// This many beats have been accepted and everything that follows from them has been checked.
    Accepted(u64),
    /// The source has run out, and everything that follows has been checked.
    Exhausted,
}

impl<'a> Scoreboard<'a> {
    /// A run of `binding` at `set` on the beats of `source`.
    pub fn new(
        binding: &dyn Binding,
        set: &WidthSet,
        source: Box<dyn Iterator<Item = Beat> + 'a>,
        pattern: Pattern,
    ) -> Self {
        let device = binding.device(set);
        let layout = Layout::of(device.as_ref());
        Self {
            inputs: vec![0; layout.input_words],
            outputs: vec![0; layout.output_words],
            device,
            layout,
            model: binding.model(set),
            source,
            pattern,
            random: Random::new(pattern.seed ^ 0x5eed),
            offered: None,
            expected: VecDeque::new(),
            scratch: Vec::new(),
            held: None,
            counts: Counts::default(),
            silent: 0,
        }
    }

    /// The device.
    pub fn device(&self) -> &dyn Device {
        self.device.as_ref()
    }
    /// The places of its ports.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }
    /// Counts so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Plays cycles until `until`, checking every beat; `observer` sees every cycle.
    ///
    /// # Errors
    /// The first mismatch: a wrong payload, a beat too many, a payload that moved while stalled, a missing beat.
    pub fn run(&mut self, until: Until, observer: &mut Observer<'_>) -> Result<Counts, Mismatch> {
        while !self.finished(until) {
            self.cycle(until, observer)?;
        }
        Ok(self.counts)
    }

    fn wants_more(&self, until: Until) -> bool {
        match until {
            Until::Accepted(beats) => self.counts.accepted < beats,
            Until::Exhausted => true,
        }
    }

    fn finished(&mut self, until: Until) -> bool {
        if self.offered.is_none() && self.wants_more(until) {
            self.offered = self.source.next();
        }
        (self.offered.is_none() || !self.wants_more(until)) && self.expected.is_empty()
    }

    /// One cycle: offers, settles, checks, clocks.
    fn cycle(&mut self, until: Until, observer: &mut Observer<'_>) -> Result<(), Mismatch> {
        let offers = self.wants_more(until);
        let was_valid = self.inputs[self.layout.in_valid] == 1;
        // A beat once offered stays until it is taken.
        if let Some(beat) = &self.offered
            && offers
            && !was_valid
            && !self.random.chance(self.pattern.idle)
        {
            self.inputs[self.layout.in_valid] = 1;
            let mut at = 0;
            for (port, place) in
                self.layout.inputs.iter().filter(|(p, _)| p.name != "in_valid" && p.name != "out_ready")
            {
                self.inputs[*place..place + port.words()].copy_from_slice(&beat[at..at + port.words()]);
                at += port.words();
            }
        }
        self.inputs[self.layout.out_ready] = u64::from(!self.random.chance(self.pattern.stall));
        self.device.settle(&self.inputs, &mut self.outputs);
        observer(self.device.as_ref(), &self.inputs, &self.outputs)?;
        self.counts.cycles += 1;
        self.silent += 1;

        let taken_in = self.inputs[self.layout.in_valid] == 1 && self.outputs[self.layout.in_ready] == 1;
        self.check_output()?;
        if taken_in {
            self.silent = 0;
            self.counts.accepted += 1;
            self.inputs[self.layout.in_valid] = 0;
            if let Some(beat) = self.offered.take() {
                self.model.accept(&beat, &mut self.scratch);
                self.expected.extend(self.scratch.drain(..));
            }
        }
        self.device.edge();
        if self.silent > PATIENCE {
            let expected = format!("{} more beats", self.expected.len());
            let got = format!("no handshake for {PATIENCE} cycles");
            return Err(self.mismatch("out_valid", expected, got));
        }
        Ok(())
    }

    /// Compares the output beat, if there is one, with the next expected one.
    fn check_output(&mut self) -> Result<(), Mismatch> {
        if self.outputs[self.layout.out_valid] != 1 {
            return match self.held.take() {
                Some(_) => Err(self.mismatch("out_valid", "1, as the beat was not taken".into(), "0".into())),
                None => Ok(()),
            };
        }
        let Some(expected) = self.expected.front() else {
            return Err(self.mismatch("out_valid", "no beat".into(), "a beat too many".into()));
        };
        let mut at = 0;
        for (port, place) in self.layout.out_fields() {
            let words = port.words();
            let (want, mask) = (&expected.words[at..at + words], &expected.mask[at..at + words]);
            let got = &self.outputs[*place..place + words];
            if want.iter().zip(got).zip(mask).any(|((w, g), m)| (w ^ g) & m != 0) {
                let (name, want, got) = (port.name, hexadecimal(want), hexadecimal(got));
                return Err(self.mismatch(name, want, got));
            }
            at += words;
        }
        if let Some(held) = &self.held
            && self.layout.out_fields().any(|(p, at)| held[*at..at + p.words()] != self.outputs[*at..at + p.words()])
        {
            return Err(self.mismatch("out_*", "the payload of the stalled beat".into(), "another payload".into()));
        }
        if self.inputs[self.layout.out_ready] == 1 {
            self.silent = 0;
            self.held = None;
            self.expected.pop_front();
            self.counts.checked += 1;
        } else {
            self.silent = 0;
            self.held = Some(self.outputs.clone());
        }
        Ok(())
    }

    fn mismatch(&self, port: &str, expected: String, got: String) -> Mismatch {
        let cycle = self.device.cycle();
        Mismatch { beat: self.counts.checked, cycle, port: port.into(), expected, got }
    }
}

/// Words in hexadecimal, most significant first, without leading zeros.
pub fn hexadecimal(words: &[u64]) -> String {
    let digits: String = words.iter().rev().map(|word| format!("{word:016x}")).collect();
    let trimmed = digits.trim_start_matches('0');
    format!("0x{}", if trimmed.is_empty() { "0" } else { trimmed })
}
