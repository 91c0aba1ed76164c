// SPDX-License-Identifier: MIT OR Apache-2.0
//! The signals of a design: names, widths, how to read them, and where each lies in a sample.
//!
//! A sample is one flat `&[u64]`. Every signal takes `bits.div_ceil(64)` words in the order of the tree, the least
//! significant word first. A signal of lanes is packed without gaps, lane 0 in the least significant bits; an
//! enumeration is the index of its name.
//!
//! Example: a flag, a vertex of 13 lanes x 46 bits and a state make 1 + 10 + 1 words.

use std::collections::HashSet;
use thiserror::Error;

/// How the bits of a signal are meant to be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A flag or an unsigned number.
    Unsigned,
    /// A number in two's complement.
    Signed,
    /// One of these names; the value is the index.
    Enum(Vec<String>),
    /// Signed numbers side by side, lane 0 in the least significant bits.
    Lanes {
        /// How many.
        lanes: usize,
        /// The width of one.
        bits: usize,
    },
}

/// One signal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// The name within its scope.
    pub name: String,
    /// The width; for an enumeration, what holds the index.
    pub bits: usize,
    /// How to read it.
    pub kind: Kind,
}

impl Signal {
    /// A flag or an unsigned number.
    pub fn unsigned(name: impl Into<String>, bits: usize) -> Self {
        Self { name: name.into(), bits, kind: Kind::Unsigned }
    }

    /// A number in two's complement.
    pub fn signed(name: impl Into<String>, bits: usize) -> Self {
        Self { name: name.into(), bits, kind: Kind::Signed }
    }

    /// `lanes` signed numbers of `bits` bits each.
    pub fn lanes(name: impl Into<String>, lanes: usize, bits: usize) -> Self {
        Self { name: name.into(), bits: lanes * bits, kind: Kind::Lanes { lanes, bits } }
    }

    /// An enumeration with these names.
    pub fn names<S: Into<String>>(name: impl Into<String>, names: impl IntoIterator<Item = S>) -> Self {
        let names: Vec<String> = names.into_iter().map(Into::into).collect();
        let bits = (usize::BITS - names.len().saturating_sub(1).leading_zeros()).max(1) as usize;
        Self { name: name.into(), bits, kind: Kind::Enum(names) }
    }

    /// How many words of a sample it takes.
    pub fn words(&self) -> usize {
        self.bits.div_ceil(64)
    }

    /// The wires it is written as: a name and a width for each lane, or itself.
    pub(crate) fn wires(&self) -> Vec<(String, usize)> {
        match &self.kind {
            Kind::Lanes { lanes, bits } => (0..*lanes).map(|lane| (format!("{}[{lane}]", self.name), *bits)).collect(),
            _ => vec![(self.name.clone(), self.bits)],
        }
    }
}

/// What a scope holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Item {
    /// A signal of this scope.
    Signal(Signal),
    /// A scope within this scope.
    Scope(Scope),
}

impl From<Signal> for Item {
    fn from(signal: Signal) -> Self {
        Item::Signal(signal)
    }
}

impl From<Scope> for Item {
    fn from(scope: Scope) -> Self {
        Item::Scope(scope)
    }
}

/// A level of the hierarchy, with its signals and inner scopes in the order in which a sample holds them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Scope {
    /// The name within the outer scope.
    pub name: String,
    /// Signals and scopes, in order.
    pub items: Vec<Item>,
}

impl Scope {
    /// An empty scope.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), items: Vec::new() }
    }

    /// The scope with one more signal or scope at its end.
    pub fn with(mut self, item: impl Into<Item>) -> Self {
        self.items.push(item.into());
        self
    }
}

/// Where a signal lies in a sample.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place<'tree> {
    /// Dotted name from the root: `remesher.sweep.row_left`.
    pub path: String,
    /// The signal.
    pub signal: &'tree Signal,
    /// Its first word in the sample.
    pub word: usize,
}

/// A hierarchy of signals whose names are fit for a waveform file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SignalTree {
    root: Scope,
    words: usize,
}

/// Why a hierarchy cannot be recorded.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum TreeError {
    /// Empty, or with a blank or a dot in it.
    #[error("the name `{0}` cannot stand in a waveform file: it is empty or has a blank or a dot in it")]
    Name(String),
    /// Two items of one scope share a name.
    #[error("`{0}` stands twice in the hierarchy")]
    Twice(String),
    /// The recorder draws the clock itself.
    #[error("`{0}` clashes with the clock, which the recorder draws itself")]
    Clock(String),
    /// The width does not fit the kind.
    #[error("`{0}` has {1} bits, which does not fit what it is said to hold")]
    Width(String, usize),
}

/// The name under which the clock is recorded, in the root scope.
pub const CLOCK: &str = "clock";

impl SignalTree {
    /// Checks the hierarchy and lays out its sample.
    pub fn new(root: Scope) -> Result<Self, TreeError> {
        if let Some(item) = root.items.iter().find(|item| name_of(item) == CLOCK) {
            return Err(TreeError::Clock(format!("{}.{}", root.name, name_of(item))));
        }
        let words = check(&root, "")?;
        Ok(Self { root, words })
    }

    /// The outermost scope.
    pub fn root(&self) -> &Scope {
        &self.root
    }

    /// The words of one sample.
    pub fn words(&self) -> usize {
        self.words
    }

    /// Every signal with its place, in the order of the sample.
    pub fn places(&self) -> Vec<Place<'_>> {
        let (mut places, mut word) = (Vec::new(), 0);
        collect(&self.root, &self.root.name, &mut word, &mut places);
        places
    }

    /// The signal with this dotted name.
    pub fn find(&self, path: &str) -> Option<Place<'_>> {
        self.places().into_iter().find(|place| place.path == path)
    }
}

fn name_of(item: &Item) -> &str {
    match item {
        Item::Signal(signal) => &signal.name,
        Item::Scope(scope) => &scope.name,
    }
}

fn check(scope: &Scope, outer: &str) -> Result<usize, TreeError> {
    check_name(&scope.name)?;
    let path = if outer.is_empty() { scope.name.clone() } else { format!("{outer}.{}", scope.name) };
    let (mut seen, mut words) = (HashSet::new(), 0);
    for item in &scope.items {
        match item {
            Item::Scope(inner) => words += check(inner, &path)?,
            Item::Signal(signal) => {
                check_name(&signal.name)?;
                let fits = match &signal.kind {
                    Kind::Unsigned | Kind::Signed => signal.bits > 0,
                    Kind::Enum(names) => !names.is_empty() && (1..=64).contains(&signal.bits),
                    Kind::Lanes { lanes, bits } => signal.bits > 0 && signal.bits == lanes * bits,
                };
                if !fits {
                    return Err(TreeError::Width(format!("{path}.{}", signal.name), signal.bits));
                }
                words += signal.words();
            }
        }
        // Lanes are written as `name[0]`, `name[1]`...: a neighbour of that very name would be a second wire of it.
        let written = match item {
            Item::Signal(signal) => signal.wires().into_iter().map(|(name, _)| name).collect(),
            Item::Scope(inner) => vec![inner.name.clone()],
        };
        for name in written {
            if let Some(twice) = seen.replace(name) {
                return Err(TreeError::Twice(format!("{path}.{twice}")));
            }
        }
    }
    Ok(words)
}

fn check_name(name: &str) -> Result<(), TreeError> {
    if name.is_empty() || name.contains(|c: char| c.is_whitespace() || c == '.') {
        return Err(TreeError::Name(name.to_string()));
    }
    Ok(())
}

fn collect<'tree>(scope: &'tree Scope, path: &str, word: &mut usize, places: &mut Vec<Place<'tree>>) {
    for item in &scope.items {
        let path = format!("{path}.{}", name_of(item));
        match item {
            Item::Scope(inner) => collect(inner, &path, word, places),
            Item::Signal(signal) => {
                places.push(Place { path, signal, word: *word });
                *word += signal.words();
            }
        }
    }
}
