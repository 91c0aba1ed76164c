// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writes a GTKWave save file: which signals to show, in which groups, and how to read each.

use crate::tree::{CLOCK, Kind, Place, SignalTree};
use std::fmt::Write;
use thiserror::Error;

/// How GTKWave shows a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Hexadecimal.
    Hex,
    /// Unsigned decimal.
    Decimal,
    /// Decimal in two's complement.
    Signed,
    /// Binary, and single flags as a line.
    Binary,
    /// The string as it is.
    Text,
}

impl Format {
    /// What suits the kind of a signal.
    pub fn suiting(kind: &Kind, bits: usize) -> Self {
        match kind {
            Kind::Enum(_) => Format::Text,
            Kind::Signed | Kind::Lanes { .. } => Format::Signed,
            Kind::Unsigned if bits == 1 => Format::Binary,
            Kind::Unsigned => Format::Hex,
        }
    }

    /// GTKWave's trace flags: the radix and "right-justified" (0x20).
    fn flags(self) -> u32 {
        match self {
            Format::Hex => 0x22,
            Format::Decimal => 0x24,
            Format::Binary => 0x28,
            Format::Signed => 0x420,
            Format::Text => 0x820,
        }
    }
}

/// A group of signals that folds away under one name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The name shown.
    pub name: String,
    /// Dotted names, each with a format or with none for [what suits it](Format::suiting).
    pub signals: Vec<(String, Option<Format>)>,
}

impl Group {
    /// An empty group.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), signals: Vec::new() }
    }

    /// The group with one more signal, in the format that suits it.
    pub fn with(mut self, path: impl Into<String>) -> Self {
        self.signals.push((path.into(), None));
        self
    }

    /// The group with one more signal in this format.
    pub fn with_format(mut self, path: impl Into<String>, format: Format) -> Self {
        self.signals.push((path.into(), Some(format)));
        self
    }

    /// One group for each scope, with every signal of it.
    pub fn of_scopes(tree: &SignalTree) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for place in tree.places() {
            let scope = place.path.rsplit_once('.').map_or("", |(scope, _)| scope);
            match groups.iter_mut().find(|group| group.name == scope) {
                Some(group) => group.signals.push((place.path, None)),
                None => groups.push(Group::new(scope).with(place.path.clone())),
            }
        }
        groups
    }
}

/// The save file would name what is not there.
#[derive(Debug, Error, PartialEq, Eq)]
#[error("the group `{group}` names the signal `{signal}`, which the design does not have")]
pub struct UnknownSignal {
    /// The group.
    pub group: String,
    /// The name.
    pub signal: String,
}

/// The text of a save file that opens `dump` (a path as GTKWave will see it). A signal of lanes stands as one line a
/// lane.
pub fn gtkw(tree: &SignalTree, groups: &[Group], dump: &str) -> Result<String, UnknownSignal> {
    let places = tree.places();
    let mut text = format!("[*] written by relief-waves\n[dumpfile] \"{dump}\"\n[timestart] 0\n");
    let _ = writeln!(text, "@28\n{}.{CLOCK}", tree.root().name);
    for group in groups {
        // 0x200 is a line of text, 0x800000 opens a group and 0x1000000 closes it.
        let _ = writeln!(text, "@800200\n-{}", group.name);
        for (path, format) in &group.signals {
            let place = places
                .iter()
                .find(|place| place.path == *path)
                .ok_or_else(|| UnknownSignal { group: group.name.clone(), signal: path.clone() })?;
            let format = format.unwrap_or_else(|| Format::suiting(&place.signal.kind, place.signal.bits));
            let _ = writeln!(text, "@{:x}", format.flags());
            for line in wires(place) {
                let _ = writeln!(text, "{line}");
            }
        }
        let _ = writeln!(text, "@1000200\n-{}", group.name);
    }
    Ok(text)
}

/// The names as GTKWave forms them from the dump: with the range, where there is one.
fn wires(place: &Place<'_>) -> Vec<String> {
    let scope = place.path.rsplit_once('.').map_or("", |(scope, _)| scope);
    let is_text = matches!(place.signal.kind, Kind::Enum(_));
    let wire = |(name, bits): (String, usize)| match bits {
        _ if is_text => format!("{scope}.{name}"),
        1 if name.ends_with(']') => format!("{scope}.{name}[0]"),
        bits @ 2.. => format!("{scope}.{name}[{}:0]", bits - 1),
        _ => format!("{scope}.{name}"),
    };
    place.signal.wires().into_iter().map(wire).collect()
}
