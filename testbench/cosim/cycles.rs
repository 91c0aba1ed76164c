// SPDX-License-Identifier: MIT OR Apache-2.0
//! The words of many cycles, what a simulator answered, and where two runs differ.

use super::design::{Design, Direction, Port};
use std::fmt;

/// The words of many cycles, each of the same width.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cycles {
    width: usize,
    words: Vec<u64>,
}

impl Cycles {
    /// No cycles yet, of `width` words each.
    ///
    /// # Panics
    /// When `width` is 0.
    pub fn new(width: usize) -> Self {
        assert!(width > 0, "a cycle takes at least one word");
        Self { width, words: Vec::new() }
    }

    /// `count` cycles of zeros.
    pub fn zeros(width: usize, count: usize) -> Self {
        let mut cycles = Self::new(width);
        cycles.words.resize(width * count, 0);
        cycles
    }

    pub(crate) fn from_words(width: usize, words: Vec<u64>) -> Self {
        debug_assert_eq!(words.len() % width, 0);
        Self { width, words }
    }

    /// Words a cycle.
    pub fn width(&self) -> usize {
        self.width
    }

    /// How many cycles there are.
    pub fn len(&self) -> usize {
        self.words.len() / self.width
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Appends a cycle.
    ///
    /// # Panics
    /// When it has another width.
    pub fn push(&mut self, cycle: &[u64]) {
        assert_eq!(cycle.len(), self.width, "a cycle of another width");
        self.words.extend_from_slice(cycle);
    }

    /// Appends a cycle of zeros and lets `fill` set its ports.
    pub fn push_with(&mut self, fill: impl FnOnce(&mut [u64])) {
        let from = self.words.len();
        self.words.resize(from + self.width, 0);
        fill(&mut self.words[from..]);
    }

    /// The words of a cycle.
    ///
    /// # Panics
    /// When there is no such cycle.
    pub fn cycle(&self, index: usize) -> &[u64] {
        &self.words[index * self.width..][..self.width]
    }

    /// Every cycle, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u64]> {
        self.words.chunks_exact(self.width)
    }

    /// The words of all cycles, one after the other.
    pub fn words(&self) -> &[u64] {
        &self.words
    }
}

/// What a simulator answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Response {
    /// The outputs of every cycle; zero where a bit is unknown.
    pub values: Cycles,
    /// Ones where an output is x or z; nothing from a simulator that does not know such bits.
    pub unknown: Option<Cycles>,
}

impl Response {
    /// The first cycle with an unknown bit.
    pub fn first_unknown(&self) -> Option<usize> {
        self.unknown.as_ref()?.iter().position(|cycle| cycle.iter().any(|&word| word != 0))
    }
}

/// Where a response departs from what was expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The cycle.
    pub cycle: usize,
    /// The output.
    pub port: String,
    /// What was expected, in hexadecimal.
    pub expected: String,
    /// What came, in hexadecimal; a digit with an unknown bit is `x`.
    pub got: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cycle, port, expected, got } = self;
        write!(f, "in cycle {cycle} `{port}` is {got}, and {expected} was expected")
    }
}

/// The first output that is not as expected, in the first such cycle. Only ports and cycles for which `matters` says so
/// are compared: the payload of a stream matters while it is valid. An unknown bit is never as expected.
///
/// A response that is shorter or longer than what is expected differs in the first cycle that only one of them has.
pub fn first_difference(
    design: &Design,
    expected: &Cycles,
    got: &Response,
    matters: impl Fn(usize, &Port) -> bool,
) -> Option<Difference> {
    let ports: Vec<_> = design.slots(Direction::Output).collect();
    let both = expected.len().min(got.values.len());
    for cycle in 0..both {
        let (want, values) = (expected.cycle(cycle), got.values.cycle(cycle));
        let unknown = got.unknown.as_ref().map(|unknown| unknown.cycle(cycle));
        if want == values && unknown.is_none_or(|unknown| unknown.iter().all(|&word| word == 0)) {
            continue;
        }
        for (port, slot) in &ports {
            let (want, values, unknown) = (slot.get(want), slot.get(values), unknown.map(|words| slot.get(words)));
            let known = unknown.is_none_or(|unknown| unknown.iter().all(|&word| word == 0));
            if (want != values || !known) && matters(cycle, port) {
                return Some(Difference {
                    cycle,
                    port: port.name.clone(),
                    expected: hex(port.bits, want, None),
                    got: hex(port.bits, values, unknown),
                });
            }
        }
    }
    (expected.len() != got.values.len()).then(|| {
        let side = |has: usize| if has > both { "another cycle" } else { "the end" };
        Difference {
            cycle: both,
            port: design.top.clone(),
            expected: side(expected.len()).into(),
            got: side(got.values.len()).into(),
        }
    })
}

fn hex(bits: usize, words: &[u64], unknown: Option<&[u64]>) -> String {
    let digit = |words: &[u64], digit: usize| words[digit / 16] >> (digit % 16 * 4) & 15;
    let digits = (0..bits.div_ceil(4)).rev().map(|index| match unknown {
        Some(unknown) if digit(unknown, index) != 0 => 'x',
        _ => char::from_digit(digit(words, index) as u32, 16).unwrap_or('?'),
    });
    "0x".chars().chain(digits).collect()
}
