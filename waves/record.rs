// SPDX-License-Identifier: MIT OR Apache-2.0
//! Records samples as a VCD file: a window of cycles, or the cycles round a trigger.
//!
//! Only changes are written, only inside the window. A signal of lanes becomes one wire a lane (`vertex[3]`), an
//! enumeration a string variable, and the clock is drawn as `clock` in the root scope.
//!
//! ```
//! use relief_waves::{Scope, Signal, SignalTree, VcdRecorder};
//!
//! let tree = SignalTree::new(Scope::new("adder").with(Signal::signed("sum", 8)))?;
//! let mut file = Vec::new();
//! let mut recorder = VcdRecorder::new(&mut file, tree, 2..4);
//! for cycle in 0..10 {
//!     if recorder.wants(cycle) {
//!         recorder.sample(cycle, &[cycle])?;
//!     }
//! }
//! assert_eq!(recorder.finish()?, Some(2..4));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::tree::{CLOCK, Item, Kind, Scope, SignalTree};
use std::{
    collections::VecDeque,
    io::{self, BufWriter, Write},
    ops::Range,
};
use thiserror::Error;
use vcd::{IdCode, ReferenceIndex, SimulationCommand, TimescaleUnit, Value, VarType, Writer};

/// Nanoseconds a cycle, in the file.
pub const PERIOD: u64 = 10;

/// Why recording stopped.
#[derive(Debug, Error)]
pub enum RecordError {
    /// The file cannot be written.
    #[error("the waveform cannot be written: {0}")]
    Io(#[from] io::Error),
    /// The sample belongs to another tree.
    #[error("a sample of {got} words came for a tree of {expected}")]
    Words {
        /// What the tree takes.
        expected: usize,
        /// What came.
        got: usize,
    },
    /// Time went back, or a cycle of the window was left out.
    #[error("cycle {got} came where cycle {expected} was due")]
    Cycle {
        /// The cycle after the last one.
        expected: u64,
        /// What came.
        got: u64,
    },
}

/// One wire of the file: a whole signal or one lane.
struct Wire {
    id: IdCode,
    bit: usize,
    bits: usize,
}

/// One signal, with its words and its wires.
struct Tap {
    words: Range<usize>,
    wires: Vec<Wire>,
    /// The names, when it is written as a string.
    names: Option<Vec<String>>,
}

/// What is kept.
enum Keep {
    Window(Range<u64>),
    /// The last `before` cycles up to the trigger, then `after` more.
    Around {
        before: usize,
        after: u64,
        ring: VecDeque<(u64, Vec<u64>)>,
        end: Option<u64>,
    },
}

/// Writes samples to a VCD file.
pub struct VcdRecorder<W: Write> {
    out: Writer<BufWriter<W>>,
    tree: SignalTree,
    keep: Keep,
    /// Set with the header.
    clock: Option<IdCode>,
    taps: Vec<Tap>,
    previous: Vec<u64>,
    written: Option<Range<u64>>,
    last: Option<u64>,
}

impl<W: Write> VcdRecorder<W> {
    /// Records the cycles of `window`.
    pub fn new(writer: W, tree: SignalTree, window: Range<u64>) -> Self {
        Self::with(writer, tree, Keep::Window(window))
    }

    /// Records `before` cycles up to and including the one of the [trigger](Self::trigger), and `after` more.
    /// Without a trigger nothing is written.
    pub fn around(writer: W, tree: SignalTree, before: usize, after: u64) -> Self {
        let before = before.max(1);
        Self::with(writer, tree, Keep::Around { before, after, ring: VecDeque::with_capacity(before), end: None })
    }

    fn with(writer: W, tree: SignalTree, keep: Keep) -> Self {
        Self {
            out: Writer::new(BufWriter::new(writer)),
            tree,
            keep,
            clock: None,
            taps: Vec::new(),
            previous: Vec::new(),
            written: None,
            last: None,
        }
    }

    /// The signals.
    pub fn tree(&self) -> &SignalTree {
        &self.tree
    }

    /// Whether the sample of this cycle would be kept: ask before a sample is put together.
    pub fn wants(&self, cycle: u64) -> bool {
        match &self.keep {
            Keep::Window(window) => window.contains(&cycle),
            Keep::Around { end, .. } => end.is_none_or(|end| cycle < end),
        }
    }

    /// Whether no later cycle will be kept.
    pub fn is_done(&self) -> bool {
        let next = self.last.map_or(0, |last| last + 1);
        match &self.keep {
            Keep::Window(window) => next >= window.end,
            Keep::Around { end, .. } => end.is_some_and(|end| next >= end),
        }
    }

    /// Takes the values that the rising edge at the end of `cycle` samples. Cycles come in order and without a gap;
    /// those outside the window may be left out.
    pub fn sample(&mut self, cycle: u64, values: &[u64]) -> Result<(), RecordError> {
        if values.len() != self.tree.words() {
            return Err(RecordError::Words { expected: self.tree.words(), got: values.len() });
        }
        if !self.wants(cycle) {
            return Ok(());
        }
        if let Some(expected) = self.last.map(|last| last + 1)
            && cycle != expected
        {
            return Err(RecordError::Cycle { expected, got: cycle });
        }
        self.last = Some(cycle);
        if let Keep::Around { before, ring, end: None, .. } = &mut self.keep {
            // The oldest sample's memory is used again: the ring costs a copy, and no allocation.
            let mut memory = if ring.len() == *before { ring.pop_front().map(|old| old.1) } else { None }
                .unwrap_or_else(|| Vec::with_capacity(values.len()));
            memory.clear();
            memory.extend_from_slice(values);
            ring.push_back((cycle, memory));
            return Ok(());
        }
        self.write(cycle, values)
    }

    /// Marks the last sample as the one to be seen: keeps what led up to it. Later triggers change nothing, so that
    /// the window stands round the *first* wrong beat.
    pub fn trigger(&mut self) -> Result<(), RecordError> {
        let Keep::Around { after, ring, end: end @ None, .. } = &mut self.keep else { return Ok(()) };
        let Some(last) = self.last else { return Ok(()) };
        *end = Some(last + 1 + *after);
        for (cycle, values) in std::mem::take(ring) {
            self.write(cycle, &values)?;
        }
        Ok(())
    }

    /// Closes the file and returns the cycles it holds.
    pub fn finish(mut self) -> Result<Option<Range<u64>>, RecordError> {
        if let (Some(clock), Some(written)) = (self.clock, &self.written) {
            // The edge that samples the last cycle.
            self.out.timestamp(PERIOD * written.end)?;
            self.out.change_scalar(clock, true)?;
        }
        self.out.flush()?;
        Ok(self.written)
    }

    fn write(&mut self, cycle: u64, values: &[u64]) -> Result<(), RecordError> {
        let (clock, first) = match self.clock {
            Some(clock) => (clock, false),
            None => (self.header()?, true),
        };
        self.out.timestamp(PERIOD * cycle)?;
        if first {
            self.out.begin(SimulationCommand::Dumpvars)?;
        }
        self.out.change_scalar(clock, true)?;
        for tap in &self.taps {
            let (new, old) = (&values[tap.words.clone()], &self.previous[tap.words.clone()]);
            if !first && new == old {
                continue;
            }
            if let Some(names) = &tap.names {
                let name = usize::try_from(new[0]).ok().and_then(|index| names.get(index));
                // An index without a name is an error of the design: show it rather than hide it.
                let text = name.map_or_else(|| format!("?{}", new[0]), String::clone);
                self.out.change_string(tap.wires[0].id, &text)?;
                continue;
            }
            for wire in &tap.wires {
                if !first && (0..wire.bits).all(|bit| bit_at(new, wire.bit + bit) == bit_at(old, wire.bit + bit)) {
                    continue;
                }
                if wire.bits == 1 {
                    self.out.change_scalar(wire.id, bit_at(new, wire.bit))?;
                    continue;
                }
                // A reader fills up with zeros on the left, so leading zeros are left out.
                let top = (1..wire.bits).rev().find(|&bit| bit_at(new, wire.bit + bit)).unwrap_or(0);
                let bits = (0..=top).rev().map(|bit| Value::from(bit_at(new, wire.bit + bit)));
                self.out.change_vector(wire.id, bits)?;
            }
        }
        if first {
            self.out.end()?;
        }
        self.out.timestamp(PERIOD * cycle + PERIOD / 2)?;
        self.out.change_scalar(clock, false)?;
        self.previous.copy_from_slice(values);
        self.written = Some(self.written.as_ref().map_or(cycle, |written| written.start)..cycle + 1);
        Ok(())
    }

    fn header(&mut self) -> Result<IdCode, RecordError> {
        self.out.version("relief-waves")?;
        self.out.timescale(1, TimescaleUnit::NS)?;
        self.out.add_module(&self.tree.root().name)?;
        let clock = self.out.add_wire(1, CLOCK)?;
        self.clock = Some(clock);
        let mut word = 0;
        declare(&mut self.out, self.tree.root(), &mut word, &mut self.taps)?;
        self.out.upscope()?;
        self.out.enddefinitions()?;
        self.previous = vec![0; word];
        Ok(clock)
    }
}

fn declare<W: Write>(out: &mut Writer<W>, scope: &Scope, word: &mut usize, taps: &mut Vec<Tap>) -> io::Result<()> {
    for item in &scope.items {
        match item {
            Item::Scope(inner) => {
                out.add_module(&inner.name)?;
                declare(out, inner, word, taps)?;
                out.upscope()?;
            }
            Item::Signal(signal) => {
                let (mut wires, mut bit) = (Vec::new(), 0);
                for (name, bits) in signal.wires() {
                    let id = match &signal.kind {
                        Kind::Enum(_) => out.add_var(VarType::String, 1, &name, None)?,
                        // An element of one bit gets a number of its own, or readers take it for a bit of a vector.
                        _ if bits == 1 && name.ends_with(']') => {
                            out.add_var(VarType::Wire, 1, &name, Some(ReferenceIndex::BitSelect(0)))?
                        }
                        _ if bits == 1 => out.add_wire(1, &name)?,
                        _ => {
                            let index = ReferenceIndex::Range(bits as i32 - 1, 0);
                            out.add_var(VarType::Wire, bits as u32, &name, Some(index))?
                        }
                    };
                    wires.push(Wire { id, bit, bits });
                    bit += bits;
                }
                let names = if let Kind::Enum(names) = &signal.kind { Some(names.clone()) } else { None };
                taps.push(Tap { words: *word..*word + signal.words(), wires, names });
                *word += signal.words();
            }
        }
    }
    Ok(())
}

fn bit_at(words: &[u64], bit: usize) -> bool {
    words[bit / 64] >> (bit % 64) & 1 == 1
}
