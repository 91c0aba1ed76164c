// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a VCD or FST file as what each rising clock edge samples.
//!
//! A value counts for a cycle when it stands *before* the edge that ends the cycle: what changes in the same instant
//! as the edge belongs to the next one, as for a flip-flop.

use std::{
    collections::BTreeMap,
    fmt,
    fs::File,
    ops::Range,
    path::{Path, PathBuf},
};
use thiserror::Error;
use wellen::{Hierarchy, SignalValueRef, WellenError, simple::Waveform};

/// Why a waveform cannot be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// Not there, or neither VCD nor FST.
    #[error("`{path}` cannot be read as a waveform: {}", words(.cause))]
    File {
        /// The file.
        path: PathBuf,
        /// The words of the reader or of the system.
        cause: WellenError,
    },
    /// There is no clock to sample with.
    #[error("`{path}` has no one-bit signal `{clock}` to sample with")]
    NoClock {
        /// The file.
        path: PathBuf,
        /// The name looked for.
        clock: String,
    },
}

/// The reader says "io error" and keeps the reason to itself.
fn words(cause: &WellenError) -> String {
    match cause {
        WellenError::Io(cause) => cause.to_string(),
        other => other.to_string(),
    }
}

/// A value of a signal.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A vector of bits.
    Bits {
        /// The width.
        bits: usize,
        /// The bits, least significant word first; zero where unknown.
        words: Vec<u64>,
        /// Ones where a bit is x, z or another state that is neither 0 nor 1; empty when all bits are known.
        unknown: Vec<u64>,
    },
    /// A string, such as the name of a state.
    Text(String),
    /// A real number.
    Real(f64),
}

impl Value {
    /// Whether every bit is 0 or 1.
    pub fn is_known(&self) -> bool {
        !matches!(self, Value::Bits { unknown, .. } if !unknown.is_empty())
    }

    /// The value as an unsigned number, when it is known and fits.
    pub fn unsigned(&self) -> Option<u128> {
        match self {
            Value::Bits { words, unknown, .. } if unknown.is_empty() && words.iter().skip(2).all(|&word| word == 0) => {
                Some(words.iter().take(2).rev().fold(0, |value, &word| value << 64 | u128::from(word)))
            }
            _ => None,
        }
    }

    /// The value in two's complement, when it is known and at most 128 bits wide.
    pub fn signed(&self) -> Option<i128> {
        match self {
            Value::Bits { bits, .. } if (1..=128).contains(bits) => {
                let spare = 128 - *bits as u32;
                self.unsigned().map(|value| (value << spare) as i128 >> spare)
            }
            _ => None,
        }
    }

    /// Whether it is a single bit that is 1.
    pub fn is_high(&self) -> bool {
        matches!(self, Value::Bits { bits: 1, .. }) && self.unsigned() == Some(1)
    }

    pub(crate) fn from_wellen(value: SignalValueRef<'_>) -> Self {
        match value {
            SignalValueRef::Event => Value::Text("event".into()),
            SignalValueRef::String(text) => Value::Text(text.into()),
            SignalValueRef::Real(real) => Value::Real(real),
            SignalValueRef::BitVec(vector) => {
                let bits = vector.width() as usize;
                let (mut words, mut unknown) = (vec![0u64; bits.div_ceil(64)], vec![0u64; bits.div_ceil(64)]);
                for (index, bit) in vector.iter_lsb_to_msb().enumerate() {
                    match bit.as_ascii() {
                        '0' => (),
                        '1' => words[index / 64] |= 1 << (index % 64),
                        _ => unknown[index / 64] |= 1 << (index % 64),
                    }
                }
                if unknown.iter().all(|&word| word == 0) {
                    unknown.clear();
                }
                Value::Bits { bits, words, unknown }
            }
        }
    }
}

impl fmt::Display for Value {
    /// Bits as a binary number with `x` for the unknown, texts and reals as they are.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Text(text) => f.write_str(text),
            Value::Real(real) => write!(f, "{real}"),
            Value::Bits { bits, words, unknown } => (0..*bits).rev().try_for_each(|bit| {
                let at = |words: &[u64]| words.get(bit / 64).is_some_and(|word| word >> (bit % 64) & 1 == 1);
                f.write_str(if at(unknown) {
                    "x"
                } else if at(words) {
                    "1"
                } else {
                    "0"
                })
            }),
        }
    }
}

/// One signal over the cycles of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Dotted name from the root.
    pub name: String,
    /// The width, where it is a vector of bits.
    pub bits: Option<usize>,
    /// The first edge that sees a value, and the value, in rising order.
    changes: Vec<(usize, Value)>,
}

impl Trace {
    /// What the edge with this number, counted from 0, samples.
    pub fn at_edge(&self, edge: usize) -> Option<&Value> {
        let after = self.changes.partition_point(|(from, _)| *from <= edge);
        after.checked_sub(1).map(|index| &self.changes[index].1)
    }

    /// How many different values the edges saw, one after the other.
    pub fn changes(&self) -> usize {
        self.changes.len()
    }
}

/// A waveform as its rising clock edges saw it.
#[derive(Clone, Debug, PartialEq)]
pub struct Waves {
    clock: String,
    edges: Vec<u64>,
    first_cycle: u64,
    traces: BTreeMap<String, Trace>,
}

impl Waves {
    /// The full name of the clock.
    pub fn clock(&self) -> &str {
        &self.clock
    }

    /// The cycles of the file. The number of a cycle is the one that it had in the simulation wherever the clock is
    /// regular, since the time of its edge tells it.
    pub fn cycles(&self) -> Range<u64> {
        self.first_cycle..self.first_cycle + self.edges.len() as u64
    }

    /// The times of the rising edges, in units of the file.
    pub fn edges(&self) -> &[u64] {
        &self.edges
    }

    /// Every signal but the clock, by name.
    pub fn traces(&self) -> impl Iterator<Item = &Trace> {
        self.traces.values()
    }

    /// The signal of this name, or the only one whose name ends so at a dot: `sweep.row_left`.
    pub fn trace(&self, name: &str) -> Option<&Trace> {
        self.traces.get(name).or_else(|| {
            let suffix = format!(".{name}");
            let mut matching = self.traces.values().filter(|trace| trace.name.ends_with(&suffix));
            let first = matching.next();
            if matching.next().is_none() { first } else { None }
        })
    }

    /// The value of a signal in a cycle.
    pub fn value(&self, name: &str, cycle: u64) -> Option<&Value> {
        if !self.cycles().contains(&cycle) {
            return None;
        }
        self.trace(name)?.at_edge((cycle - self.first_cycle) as usize)
    }
}

/// Reads a file whose clock is called `clock`.
pub fn read(path: impl AsRef<Path>) -> Result<Waves, ReadError> {
    read_with_clock(path, "clock")
}

/// Reads a file with a clock of this name or full name. Of several the outermost counts.
pub fn read_with_clock(path: impl AsRef<Path>, clock: &str) -> Result<Waves, ReadError> {
    let loaded = Loaded::open(path.as_ref(), clock)?;
    let edge_indices = loaded.rising_edges();
    let times = loaded.waveform.time_table();
    let edges: Vec<u64> = edge_indices.iter().map(|&index| times[index as usize]).collect();
    let mut traces = BTreeMap::new();
    for (name, signal) in &loaded.signals {
        let Some(signal) = loaded.waveform.get_signal(*signal) else { continue };
        if *name == loaded.clock {
            continue;
        }
        let mut changes: Vec<(usize, Value)> = Vec::new();
        for (index, value) in signal.iter_changes() {
            let edge = edge_indices.partition_point(|&edge| edge <= index);
            if edge == edge_indices.len() {
                break;
            }
            let value = Value::from_wellen(value);
            // Of several changes between two edges the last is seen.
            if changes.last().is_some_and(|(from, _)| *from == edge) {
                changes.pop();
            }
            if changes.last().is_none_or(|(_, old)| *old != value) {
                changes.push((edge, value));
            }
        }
        let bits = changes.iter().find_map(|(_, value)| match value {
            Value::Bits { bits, .. } => Some(*bits),
            _ => None,
        });
        traces.insert(name.clone(), Trace { name: name.clone(), bits, changes });
    }
    let first_cycle = loaded.first_cycle(&edges);
    Ok(Waves { clock: loaded.clock, edges, first_cycle, traces })
}

/// A file with all its signals in memory.
pub(crate) struct Loaded {
    pub(crate) waveform: Waveform,
    /// Dotted name and signal, in the order of the file.
    pub(crate) signals: Vec<(String, wellen::SignalRef)>,
    pub(crate) clock: String,
    pub(crate) clock_signal: wellen::SignalRef,
}

impl Loaded {
    pub(crate) fn open(path: &Path, clock: &str) -> Result<Self, ReadError> {
        let file = |cause| ReadError::File { path: path.to_path_buf(), cause };
        // The reader panics where the file is not there, so it is opened beforehand.
        File::open(path).map_err(|cause| file(WellenError::Io(cause)))?;
        let mut waveform = wellen::simple::read(path).map_err(file)?;
        let hierarchy = waveform.hierarchy();
        let mut signals = Vec::new();
        let mut clocks = Vec::new();
        for var in hierarchy.all_vars() {
            let var = &hierarchy[var];
            let name = full_name(var, hierarchy);
            if var.is_1bit(hierarchy) && (name == clock || name.ends_with(&format!(".{clock}"))) {
                clocks.push((name.matches('.').count(), name.clone(), var.signal_ref()));
            }
            signals.push((name, var.signal_ref()));
        }
        clocks.sort_by_key(|(depth, ..)| *depth);
        let Some((_, clock, clock_signal)) = clocks.into_iter().next() else {
            return Err(ReadError::NoClock { path: path.to_path_buf(), clock: clock.to_string() });
        };
        let all: Vec<_> = signals.iter().map(|(_, signal)| *signal).collect();
        waveform.load_signals(&all);
        Ok(Self { waveform, signals, clock, clock_signal })
    }

    /// Indices into the table of times. The first value of the clock is no edge.
    pub(crate) fn rising_edges(&self) -> Vec<u32> {
        let (mut edges, mut low) = (Vec::new(), false);
        if let Some(signal) = self.waveform.get_signal(self.clock_signal) {
            for (index, value) in signal.iter_changes() {
                let value = Value::from_wellen(value);
                if value.is_high() && low {
                    edges.push(index);
                }
                low = value.unsigned() == Some(0);
            }
        }
        edges
    }

    /// The cycle which the first edge ends, for a clock that started at time 0 and is low for half of the period.
    pub(crate) fn first_cycle(&self, edges: &[u64]) -> u64 {
        let Some((&first, signal)) = edges.first().zip(self.waveform.get_signal(self.clock_signal)) else { return 0 };
        let times = self.waveform.time_table();
        let fall =
            signal.iter_changes().map(|(index, _)| times[index as usize]).take_while(|&time| time < first).last();
        let period = match edges.get(1) {
            Some(second) => second - first,
            None => 2 * (first - fall.unwrap_or(0)),
        };
        let regular = edges.windows(2).all(|pair| pair[1] - pair[0] == period);
        if regular && period > 0 { first.div_ceil(period).saturating_sub(1) } else { 0 }
    }
}

/// The dotted name as it was written: an element of an array is a scope of its own to the reader.
pub(crate) fn full_name(var: &wellen::Var, hierarchy: &Hierarchy) -> String {
    var.full_name(hierarchy).replace(".[", "[")
}
