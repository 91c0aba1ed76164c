// SPDX-License-Identifier: MIT OR Apache-2.0
//! An emitted design: its sources, its ports, and the words in which the ports travel.

use super::{CosimError, io_error};
use std::{
    collections::HashSet,
    fmt, fs,
    path::{Path, PathBuf},
};

/// The way of a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Into the design.
    Input,
    /// Out of the design.
    Output,
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Direction::Input => "input",
            Direction::Output => "output",
        })
    }
}

/// A port of the top module: a plain packed vector.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Port {
    /// The name in the source.
    pub name: String,
    /// The width.
    pub bits: usize,
    /// The way.
    pub direction: Direction,
}

impl Port {
    /// A port into the design.
    pub fn input(name: impl Into<String>, bits: usize) -> Self {
        Self { name: name.into(), bits, direction: Direction::Input }
    }

    /// A port out of the design.
    pub fn output(name: impl Into<String>, bits: usize) -> Self {
        Self { name: name.into(), bits, direction: Direction::Output }
    }

    /// How many words of a cycle it takes.
    pub fn words(&self) -> usize {
        self.bits.div_ceil(64)
    }
}

/// What there is to build.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Design {
    /// The top module.
    pub top: String,
    /// The source files. All tools run in the folder of the first one, where `$readmemh` then looks.
    pub sources: Vec<PathBuf>,
    /// Every port but the clock.
    pub ports: Vec<Port>,
    /// The clock port; none for a design without state.
    pub clock: Option<String>,
}

impl Design {
    /// A design whose clock is called `clock`. A port of that name among `ports` is taken as the clock.
    pub fn new(top: impl Into<String>, sources: Vec<PathBuf>, ports: Vec<Port>) -> Self {
        let clock = "clock".to_string();
        let ports = ports.into_iter().filter(|port| port.name != clock).collect();
        Self { top: top.into(), sources, ports, clock: Some(clock) }
    }

    /// The design without a clock: its outputs follow its inputs.
    pub fn combinational(mut self) -> Self {
        self.clock = None;
        self
    }

    /// The design that was emitted into a folder: its files are those that `filelist.f` names, one a line.
    pub fn from_folder(folder: impl AsRef<Path>, top: impl Into<String>, ports: Vec<Port>) -> Result<Self, CosimError> {
        let folder = folder.as_ref();
        let list = folder.join("filelist.f");
        let text = fs::read_to_string(&list).map_err(io_error(format!("reading `{}`", list.display())))?;
        let files = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with(['#', '/', '+']));
        Ok(Self::new(top, files.map(|file| folder.join(file)).collect(), ports))
    }

    /// The ports of one direction, in their order.
    pub fn ports_of(&self, direction: Direction) -> impl Iterator<Item = &Port> {
        self.ports.iter().filter(move |port| port.direction == direction)
    }

    /// Words of the inputs of a cycle; at least one.
    pub fn input_words(&self) -> usize {
        self.ports_of(Direction::Input).map(Port::words).sum::<usize>().max(1)
    }

    /// Words of the outputs of a cycle; at least one.
    pub fn output_words(&self) -> usize {
        self.ports_of(Direction::Output).map(Port::words).sum::<usize>().max(1)
    }

    /// Where an input lies.
    pub fn input(&self, name: &str) -> Result<Slot, CosimError> {
        self.slot(Direction::Input, name)
    }

    /// Where an output lies.
    pub fn output(&self, name: &str) -> Result<Slot, CosimError> {
        self.slot(Direction::Output, name)
    }

    fn slot(&self, direction: Direction, name: &str) -> Result<Slot, CosimError> {
        self.slots(direction)
            .find(|(port, _)| port.name == name)
            .map(|(_, slot)| slot)
            .ok_or_else(|| CosimError::Port { top: self.top.clone(), direction, port: name.to_string() })
    }

    /// The ports of one direction, each with its place.
    pub fn slots(&self, direction: Direction) -> impl Iterator<Item = (&Port, Slot)> {
        self.ports_of(direction).scan(0, |next, port| {
            let word = *next;
            *next += port.words();
            Some((port, Slot { word, bits: port.bits }))
        })
    }

    /// Where the tools run.
    pub(crate) fn folder(&self) -> Result<PathBuf, CosimError> {
        let folder = self.sources.first().and_then(|source| source.parent()).unwrap_or(Path::new(""));
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        folder.canonicalize().map_err(io_error(format!("looking for the folder `{}`", folder.display())))
    }

    /// The sources as the tools get them, since they run in another folder.
    pub(crate) fn absolute_sources(&self) -> Result<Vec<PathBuf>, CosimError> {
        let absolute = |source: &PathBuf| {
            source.canonicalize().map_err(io_error(format!("looking for the source `{}`", source.display())))
        };
        self.sources.iter().map(absolute).collect()
    }

    /// Refuses what would only fail later, in the words of a tool.
    pub(crate) fn check(&self) -> Result<(), CosimError> {
        let refuse = |reason: String| Err(CosimError::Design { top: self.top.clone(), reason });
        if self.sources.is_empty() {
            return refuse("it has no sources".into());
        }
        let is_name = |name: &str| {
            name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
                && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        };
        let mut seen = HashSet::new();
        let names = self.ports.iter().map(|port| &port.name).chain(&self.clock).chain([&self.top]);
        for name in names {
            if !is_name(name) {
                return refuse(format!("`{name}` is no plain identifier"));
            }
            if *name != self.top && !seen.insert(name) {
                return refuse(format!("the port `{name}` stands twice"));
            }
        }
        match self.ports.iter().find(|port| port.bits == 0) {
            Some(port) => refuse(format!("the port `{}` has no bits", port.name)),
            None => Ok(()),
        }
    }

    /// Refuses a stimulus for other ports.
    pub(crate) fn check_width(&self, got: usize) -> Result<(), CosimError> {
        let expected = self.input_words();
        if got == expected { Ok(()) } else { Err(CosimError::Width { top: self.top.clone(), expected, got }) }
    }
}

/// The place of a port in the words of a cycle.
///
/// ```
/// use relief_testbench::cosim::{Design, Port};
///
/// let design = Design::new("relief_pair", vec![], vec![Port::input("in_flag", 1), Port::input("in_pair", 92)]);
/// let pair = design.input("in_pair")?;
/// let mut words = vec![0; design.input_words()];
/// pair.set_lane(&mut words, 46, 1, -1);
/// assert_eq!((pair.lane(&words, 46, 0), pair.lane(&words, 46, 1)), (0, -1));
/// # Ok::<(), relief_testbench::cosim::CosimError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// The first word.
    pub word: usize,
    /// The width of the port.
    pub bits: usize,
}

impl Slot {
    /// The words of the port.
    pub fn get<'w>(&self, words: &'w [u64]) -> &'w [u64] {
        &words[self.word..self.word + self.bits.div_ceil(64)]
    }

    /// Sets the words of the port.
    ///
    /// # Panics
    /// When there are more or fewer of them than the port takes.
    pub fn set_words(&self, words: &mut [u64], value: &[u64]) {
        words[self.word..self.word + self.bits.div_ceil(64)].copy_from_slice(value);
    }

    /// The lowest 64 bits of the port as an unsigned number.
    pub fn unsigned(&self, words: &[u64]) -> u64 {
        words[self.word]
    }

    /// Sets a port of up to 64 bits; the bits above its width are cut off.
    pub fn set(&self, words: &mut [u64], value: u64) {
        words[self.word] = value & mask(self.bits);
    }

    /// The port, up to 64 bits wide, in two's complement.
    pub fn signed(&self, words: &[u64]) -> i64 {
        self.lane(words, self.bits.min(64), 0)
    }

    /// Sets a port of up to 64 bits in two's complement.
    pub fn set_signed(&self, words: &mut [u64], value: i64) {
        self.set(words, value as u64);
    }

    /// Whether the lowest bit is set: the value of a flag.
    pub fn is_high(&self, words: &[u64]) -> bool {
        words[self.word] & 1 == 1
    }

    /// One signed lane, of up to 64 bits, of a packed port; lane 0 is the lowest.
    pub fn lane(&self, words: &[u64], lane_bits: usize, lane: usize) -> i64 {
        let (word, bit) = self.lane_place(lane_bits, lane);
        let low = words[word] >> bit;
        // A lane may reach into the next word; a shift by 64 would be none.
        let high = if bit + lane_bits > 64 { words[word + 1] << (64 - bit) } else { 0 };
        let spare = 64 - lane_bits;
        ((low | high) << spare) as i64 >> spare
    }

    /// Sets one signed lane; the bits above its width are cut off.
    pub fn set_lane(&self, words: &mut [u64], lane_bits: usize, lane: usize, value: i64) {
        let (word, bit) = self.lane_place(lane_bits, lane);
        let (value, mask) = (value as u64 & mask(lane_bits), mask(lane_bits));
        words[word] = words[word] & !(mask << bit) | value << bit;
        if bit + lane_bits > 64 {
            words[word + 1] = words[word + 1] & !(mask >> (64 - bit)) | value >> (64 - bit);
        }
    }

    fn lane_place(&self, lane_bits: usize, lane: usize) -> (usize, usize) {
        let from = lane * lane_bits;
        assert!((1..=64).contains(&lane_bits), "a lane has 1 to 64 bits, not {lane_bits}");
        assert!(from + lane_bits <= self.bits, "lane {lane} of {lane_bits} bits is outside a port of {}", self.bits);
        (self.word + from / 64, from % 64)
    }
}

/// Ones in the lowest `bits` bits.
pub(crate) fn mask(bits: usize) -> u64 {
    if bits >= 64 { u64::MAX } else { (1 << bits) - 1 }
}
