// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compares a block with its golden model beat by beat, and the emitted Verilog with the block cycle by cycle.
//!
//! The block runs in rust-hdl under the [`Scoreboard`], so rust-hdl equals the golden model bit for bit. The cycles that
//! it plays, chunk by chunk, are replayed in the other engines: handshake and status ports must be equal in every cycle
//! after the reset, the payload wherever `out_valid` stands. So every engine equals the golden model.
//!
//! | engine    | how                                     | how much                                          |
//! |-----------|-----------------------------------------|---------------------------------------------------|
//! | rust      | the scoreboard drives it                | every vector                                      |
//! | verilator | chunks of [`CHUNK`] cycles              | every vector, from a random power-up              |
//! | icarus    | one batch a leg; it knows unknown bits  | the first legs, at most [`ICARUS_LEG`] vectors each |
//!
//! A *vector* is one accepted beat. A check is cut into *legs*: each has its own idle cycles and backpressure, and a
//! seed with which it is repeated alone. Only the leg of a mismatch is played again to record its waveform, so a check
//! without one costs no waveform.

use crate::{
    binding::{Beat, Binding},
    cosim::{
        CosimError, Cycles, Design, Direction, Icarus, IcarusModel, Port, PowerUp, Session, Simulator, Verilator,
        VerilatorModel, default_cache, first_difference, tools,
    },
    device::{Device, Layout},
    output::OutputFile,
    probe::BlockProbe,
    scoreboard::{Counts, Mismatch, Pattern, Scoreboard, Until},
};
use relief_hdl::{
    ports::PortShape,
    verilog::{self, Emission, EmitError},
    widths::WidthSet,
};
use relief_models::mesh::Progress;
use relief_waves::{Group, TreeError, VcdRecorder, gtkw, gtkw::UnknownSignal, record::RecordError};
use std::{
    cell::RefCell,
    fmt, fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
    str::FromStr,
    time::{Duration, Instant},
};
use tempfile::TempDir;
use thiserror::Error;

/// Percentages of idle and of stall cycles: the matrix through which every block goes.
pub const PATTERNS: [(u8, u8); 4] = [(0, 0), (30, 0), (0, 50), (40, 60)];

/// Cycles that are replayed at once; a few megabytes.
pub const CHUNK: usize = 8192;

/// Vectors of one batch of Icarus, which takes its stimulus whole.
pub const ICARUS_LEG: u64 = 1000;

/// Cycles for which the emitted design is held in reset. The rust-hdl device comes reset.
pub const RESET_CYCLES: usize = 2;

/// Cycles of the waveform before a mismatch, and after it.
const AROUND: (u64, u64) = (64, 8);

/// What runs a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Engine {
    /// The block itself, in rust-hdl.
    Rust,
    /// The emitted Verilog, compiled.
    Verilator,
    /// The emitted Verilog, interpreted; it knows unknown bits.
    Icarus,
}

impl Engine {
    /// Every engine, in the order of reports.
    pub const ALL: [Engine; 3] = [Engine::Rust, Engine::Verilator, Engine::Icarus];

    /// The name, as options take it.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Rust => "rust",
            Engine::Verilator => "verilator",
            Engine::Icarus => "icarus",
        }
    }

    /// The programs that it takes.
    pub fn programs(self) -> &'static [&'static str] {
        match self {
            Engine::Rust => &[],
            Engine::Verilator => &["verilator", "g++"],
            Engine::Icarus => &["iverilog", "vvp"],
        }
    }

    /// The first of its programs that is not installed.
    pub fn missing(self) -> Option<tools::Missing> {
        self.programs().iter().find_map(|program| tools::find(program).err())
    }
}

impl fmt::Display for Engine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Engine {
    type Err = String;
    fn from_str(name: &str) -> Result<Self, String> {
        let known = Engine::ALL.into_iter().find(|engine| engine.name() == name);
        known.ok_or_else(|| format!("there is no engine `{name}`; the engines are rust, verilator, icarus"))
    }
}

/// Why a check could not be made: nothing that speaks for or against the block.
#[derive(Debug, Error)]
pub enum CheckError {
    /// A simulator failed.
    #[error(transparent)]
    Cosim(#[from] CosimError),
    /// The block cannot be emitted.
    #[error("the block `{block}` cannot be emitted: {cause}")]
    Emit {
        /// The block.
        block: String,
        /// Why.
        cause: Box<EmitError>,
    },
    /// The emitted module has other ports than the block.
    #[error("the module `{top}` has the {direction}s {got}, and the block has {expected}")]
    Ports {
        /// The module.
        top: String,
        /// Which of them.
        direction: Direction,
        /// Those of the block, with widths.
        expected: String,
        /// Those of the module.
        got: String,
    },
    /// The waveform cannot be recorded.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The signals of the block have no place in a waveform.
    #[error(transparent)]
    Tree(#[from] TreeError),
    /// The save file would name what is not there.
    #[error(transparent)]
    Signal(#[from] UnknownSignal),
    /// A file cannot be written.
    #[error("{0}")]
    Output(String),
    /// The system refused something.
    #[error("{what} failed: {cause}")]
    Io {
        /// What was tried.
        what: String,
        /// Why it failed.
        cause: io::Error,
    },
}

impl From<String> for CheckError {
    fn from(sentence: String) -> Self {
        CheckError::Output(sentence)
    }
}

fn io_error(what: impl Into<String>) -> impl FnOnce(io::Error) -> CheckError {
    let what = what.into();
    move |cause| CheckError::Io { what, cause }
}

/// What there is to check.
#[derive(Clone)]
pub struct Check<'a> {
    /// The block.
    pub binding: &'a dyn Binding,
    /// Its widths.
    pub set: &'a WidthSet,
    /// What it runs in; rust-hdl drives the others, whether it is named or not.
    pub engines: Vec<Engine>,
    /// Beats accepted, over all legs.
    pub vectors: u64,
    /// Of these, the most that Icarus replays.
    pub icarus_vectors: u64,
    /// Seed of the stimulus, of idle cycles and backpressure, and of the power-up.
    pub seed: u64,
    /// Where the waveform round a mismatch is kept; made when there is one.
    pub waveforms: PathBuf,
    /// A folder with an emitted design to check in the place of a fresh one.
    pub sources: Option<PathBuf>,
}

impl<'a> Check<'a> {
    /// A sample of 2,000 vectors in every engine, with seed 1.
    pub fn new(binding: &'a dyn Binding, set: &'a WidthSet) -> Self {
        Self {
            binding,
            set,
            engines: Engine::ALL.to_vec(),
            vectors: 2000,
            icarus_vectors: 2000,
            seed: 1,
            waveforms: default_cache().with_file_name("relief-mismatches"),
            sources: None,
        }
    }
}

/// How an engine came out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Everything agreed.
    Agreed,
    /// Something did not: see [`Report::failure`].
    Mismatch,
    /// Another engine's mismatch came first.
    Stopped,
}

/// What one engine did.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The engine.
    pub engine: Engine,
    /// Beats accepted.
    pub vectors: u64,
    /// Output beats compared.
    pub beats: u64,
    /// Cycles compared, resets left out.
    pub cycles: u64,
    /// Time spent in the engine; for rust-hdl the golden model's is included.
    pub time: Duration,
    /// How it came out.
    pub verdict: Verdict,
}

/// The first mismatch, and how to see it again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// The block.
    pub block: &'static str,
    /// The width set.
    pub set: &'static str,
    /// The engine that departed: rust-hdl from the golden model, another from rust-hdl.
    pub engine: Engine,
    /// Beat, cycle (counted from the reset), port, expected and got.
    pub mismatch: Mismatch,
    /// Seed of the leg.
    pub seed: u64,
    /// The command line that plays it again.
    pub replay: String,
    /// The waveform of the block in rust-hdl round the mismatch.
    pub waveform: Option<PathBuf>,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { block, set, engine, mismatch, seed, replay, waveform } = self;
        writeln!(f, "MISMATCH {block}, width set {set}, engine {engine}, seed {seed}: {mismatch}")?;
        write!(f, "  replay:   {replay}")?;
        match waveform {
            Some(path) => write!(f, "\n  waveform: {} (the block in rust-hdl)", path.display()),
            None => Ok(()),
        }
    }
}

/// The outcome of a check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The block.
    pub block: &'static str,
    /// The width set.
    pub set: &'static str,
    /// One row an engine; rust-hdl first.
    pub rows: Vec<Row>,
    /// The first mismatch.
    pub failure: Option<Failure>,
}

/// A part of a check that can be repeated alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leg {
    /// Idle cycles, backpressure and the seed, which is also that of the beats.
    pub pattern: Pattern,
    /// Beats accepted.
    pub vectors: u64,
    /// Whether Icarus replays it.
    pub icarus: bool,
}

/// Cuts vectors into legs: those for Icarus first, each pattern getting its share of both kinds.
pub fn legs(vectors: u64, icarus_vectors: u64, seed: u64) -> Vec<Leg> {
    let mut legs = Vec::new();
    let with = vectors.min(icarus_vectors);
    for (all, most, icarus) in [(with, ICARUS_LEG, true), (vectors - with, u64::MAX, false)] {
        for (k, (idle, stall)) in PATTERNS.into_iter().enumerate() {
            let share = PATTERNS.len() as u64;
            let mut left = all / share + u64::from((k as u64) < all % share);
            while left > 0 {
                let vectors = left.min(most);
                // Readable, and another one for each leg of up to a thousand.
                let seed = seed.wrapping_mul(1000).wrapping_add(legs.len() as u64);
                legs.push(Leg { pattern: Pattern { idle, stall, seed }, vectors, icarus });
                left -= vectors;
            }
        }
    }
    legs
}

/// An emitted block, with its ports as the simulators take them.
#[derive(Debug)]
pub struct Emitted {
    /// The design.
    pub design: Design,
    /// Keeps the sources until the simulators are done.
    _folder: Option<TempDir>,
}

/// The Verilog of a block.
pub fn emission(binding: &dyn Binding, set: &WidthSet) -> Result<Emission, CheckError> {
    let device = binding.device(set);
    verilog::emit(device.block())
        .map_err(|cause| CheckError::Emit { block: binding.name().into(), cause: Box::new(cause) })
}

/// Emits a block into a folder of its own, or takes what `sources` holds; the ports must be those of the block.
pub fn emitted(binding: &dyn Binding, set: &WidthSet, sources: Option<&Path>) -> Result<Emitted, CheckError> {
    let emission = emission(binding, set)?;
    let folder = match sources {
        Some(_) => None,
        None => Some(tempfile::tempdir().map_err(io_error("making a temporary folder"))?),
    };
    if let Some(folder) = &folder {
        let fail = |cause| CheckError::Emit { block: binding.name().into(), cause: Box::new(cause) };
        emission.write(folder.path()).map_err(fail)?;
    }
    if let Some(sources) = sources {
        expect_widths(&emission, &sources.join(format!("{}.sv", emission.top)))?;
    }
    let ports = emission.top_module().ports.iter().map(|port| match port.direction {
        verilog::Direction::Input => Port::input(&port.name, port.bits),
        verilog::Direction::Output => Port::output(&port.name, port.bits),
    });
    let path = sources.or(folder.as_ref().map(TempDir::path)).unwrap_or(Path::new(""));
    let design = Design::from_folder(path, &emission.top, ports.collect())?;
    let device = binding.device(set);
    // Words travel by position, so an order of its own would compare the wrong ports.
    let reset = PortShape { name: "reset", bits: 1 };
    let inputs: Vec<PortShape> = [reset].into_iter().chain(device.inputs()).collect();
    expect_ports(&design, Direction::Input, &inputs)?;
    expect_ports(&design, Direction::Output, &device.outputs())?;
    Ok(Emitted { design, _folder: folder })
}

/// Refuses a design of other port widths, such as one of another width set. A port that is declared in a form of its own
/// is left to the simulators.
fn expect_widths(emission: &Emission, file: &Path) -> Result<(), CheckError> {
    let text = fs::read_to_string(file).map_err(io_error(format!("reading `{}`", file.display())))?;
    let declared = |name: &str| {
        text.lines().find_map(|line| {
            let code = line.split("//").next()?.trim().trim_end_matches(',');
            let rest = code.strip_prefix("input ").or(code.strip_prefix("output "))?;
            let range = rest.strip_suffix(name).filter(|rest| rest.ends_with([' ', ']']))?.trim();
            let range = range.trim_start_matches("wire").trim_start_matches("reg").trim_start_matches("logic").trim();
            match range.strip_prefix('[') {
                None => range.is_empty().then_some(1),
                Some(range) => Some(range.split(':').next()?.parse::<usize>().ok()? + 1),
            }
        })
    };
    for port in &emission.top_module().ports {
        if let Some(bits) = declared(&port.name)
            && bits != port.bits
        {
            let (top, name) = (&emission.top, &port.name);
            return Err(CheckError::Output(format!(
                "{}: the port `{name}` of `{top}` has {bits} bits, and {} are expected: name the width set of these \
                 sources with --param",
                file.display(),
                port.bits
            )));
        }
    }
    Ok(())
}

fn expect_ports(design: &Design, direction: Direction, shapes: &[PortShape]) -> Result<(), CheckError> {
    let list = |ports: &mut dyn Iterator<Item = (&str, usize)>| {
        ports.map(|(name, bits)| format!("{name}:{bits}")).collect::<Vec<_>>().join(", ")
    };
    let expected = list(&mut shapes.iter().map(|port| (port.name, port.bits)));
    let got = list(&mut design.ports_of(direction).map(|port| (port.name.as_str(), port.bits)));
    if expected == got {
        return Ok(());
    }
    Err(CheckError::Ports { top: design.top.clone(), direction, expected, got })
}

/// One run of a block in rust-hdl against its golden model.
pub struct Play<'a> {
    /// The block.
    pub binding: &'a dyn Binding,
    /// Its widths.
    pub set: &'a WidthSet,
    /// Idle cycles and backpressure.
    pub pattern: Pattern,
    /// The beats.
    pub source: Box<dyn Iterator<Item = Beat> + 'a>,
    /// When it ends.
    pub until: Until,
}

impl<'a> Play<'a> {
    /// A run on random beats; the pattern's seed is also theirs.
    pub fn random(binding: &'a dyn Binding, set: &'a WidthSet, pattern: Pattern, vectors: u64) -> Self {
        let source = binding.random(set, pattern.seed);
        Self { binding, set, pattern, source, until: Until::Accepted(vectors) }
    }
}

/// Who follows a run in rust-hdl, cycle by cycle.
#[derive(Default)]
pub struct Followers<'a> {
    /// A compiled design that has just been started.
    pub verilator: Option<Session>,
    /// An interpreted design.
    pub icarus: Option<&'a IcarusModel>,
}

/// What a run did, and how it ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Played {
    /// Counts of the block in rust-hdl.
    pub counts: Counts,
    /// Cycles replayed and compared by Verilator and by Icarus.
    pub replayed: [u64; 2],
    /// Time spent in all, and of it in Verilator and in Icarus.
    pub time: [Duration; 3],
    /// The first mismatch and the engine that has it.
    pub mismatch: Option<(Engine, Mismatch)>,
}

/// Sees the device and the words of its inputs and outputs in every cycle.
pub type Watch<'a> = dyn FnMut(&dyn Device, &[u64], &[u64]) -> Result<(), CheckError> + 'a;

/// Plays a block in rust-hdl against its golden model and replays the cycles in the followers.
///
/// # Errors
/// When something fails that is not the block. A mismatch is no error: see [`Played::mismatch`].
pub fn play(
    play: Play<'_>,
    followers: Followers<'_>,
    progress: &mut dyn FnMut(u64),
    watch: &mut Watch<'_>,
) -> Result<Played, CheckError> {
    let begun = Instant::now();
    let mut scoreboard = Scoreboard::new(play.binding, play.set, play.source, play.pattern);
    let layout = scoreboard.layout().clone();
    let replay = RefCell::new(Replay::new(&layout, followers));
    // What ends the run but is no mismatch of the block in rust-hdl.
    let mut stop: Option<Result<(Engine, Mismatch), CheckError>> = None;
    let outcome = scoreboard.run(play.until, &mut |device, inputs, outputs| {
        let mut replay = replay.borrow_mut();
        let result = watch(device, inputs, outputs).and_then(|()| replay.cycle(inputs, outputs));
        if replay.cycles.is_multiple_of(CHUNK as u64) {
            progress(replay.accepted);
        }
        match result {
            Ok(None) => Ok(()),
            Ok(Some((engine, mismatch))) => {
                stop = Some(Ok((engine, mismatch.clone())));
                Err(mismatch)
            }
            Err(error) => {
                stop = Some(Err(error));
                let (port, expected, got) = (String::new(), String::new(), String::new());
                Err(Mismatch { beat: 0, cycle: 0, port, expected, got })
            }
        }
    });
    let mut replay = replay.into_inner();
    let mismatch = match (stop, outcome) {
        (Some(stop), _) => Some(stop?),
        (None, Err(mismatch)) => Some((Engine::Rust, mismatch)),
        (None, Ok(_)) => replay.finish()?,
    };
    let counts = Counts { accepted: replay.accepted, checked: replay.checked, cycles: replay.cycles };
    let [verilator, icarus] = replay.time;
    Ok(Played { counts, replayed: replay.replayed, time: [begun.elapsed(), verilator, icarus], mismatch })
}

/// The cycles that have been played and not yet compared.
struct Replay<'a> {
    layout: &'a Layout,
    followers: Followers<'a>,
    stimulus: Cycles,
    expected: Cycles,
    /// Of the first cycle held: its number from power-up, and the output beats before it.
    first: u64,
    beats: u64,
    frame: Vec<u64>,
    cycles: u64,
    accepted: u64,
    checked: u64,
    replayed: [u64; 2],
    time: [Duration; 2],
}

impl<'a> Replay<'a> {
    fn new(layout: &'a Layout, followers: Followers<'a>) -> Self {
        let width = layout.input_words + 1;
        let mut stimulus = Cycles::zeros(width, 0);
        for _ in 0..RESET_CYCLES {
            stimulus.push_with(|words| words[0] = 1);
        }
        Self {
            layout,
            followers,
            stimulus,
            expected: Cycles::zeros(layout.output_words, RESET_CYCLES),
            first: 0,
            beats: 0,
            frame: vec![0; width],
            cycles: 0,
            accepted: 0,
            checked: 0,
            replayed: [0; 2],
            time: [Duration::ZERO; 2],
        }
    }

    fn cycle(&mut self, inputs: &[u64], outputs: &[u64]) -> Result<Option<(Engine, Mismatch)>, CheckError> {
        let layout = self.layout;
        self.cycles += 1;
        self.accepted += inputs[layout.in_valid] & outputs[layout.in_ready];
        self.checked += outputs[layout.out_valid] & inputs[layout.out_ready];
        if self.followers.verilator.is_none() && self.followers.icarus.is_none() {
            return Ok(None);
        }
        self.frame[1..].copy_from_slice(inputs);
        self.stimulus.push(&self.frame);
        self.expected.push(outputs);
        // Icarus takes everything at the end.
        if self.followers.icarus.is_none() && self.stimulus.len() >= CHUNK { self.compare() } else { Ok(None) }
    }

    /// Compares what is left, and ends the followers.
    fn finish(&mut self) -> Result<Option<(Engine, Mismatch)>, CheckError> {
        let mismatch = self.compare()?;
        if let Some(session) = self.followers.verilator.take() {
            session.finish()?;
        }
        Ok(mismatch)
    }

    fn compare(&mut self) -> Result<Option<(Engine, Mismatch)>, CheckError> {
        let cycles = (self.stimulus.len() as u64).saturating_sub(if self.first == 0 { RESET_CYCLES as u64 } else { 0 });
        if let Some(session) = &mut self.followers.verilator {
            let begun = Instant::now();
            let values = session.run(&self.stimulus)?;
            let response = crate::cosim::Response { values, unknown: None };
            let design = session.design().clone();
            self.time[0] += begun.elapsed();
            self.replayed[0] += cycles;
            if let Some(mismatch) = self.difference(&design, &response) {
                return Ok(Some((Engine::Verilator, mismatch)));
            }
        }
        if let Some(model) = self.followers.icarus {
            let begun = Instant::now();
            let response = model.run(&self.stimulus)?;
            self.time[1] += begun.elapsed();
            self.replayed[1] += cycles;
            if let Some(mismatch) = self.difference(model.design(), &response) {
                return Ok(Some((Engine::Icarus, mismatch)));
            }
        }
        self.first += self.stimulus.len() as u64;
        self.beats = self.checked;
        let (inputs, outputs) = (self.stimulus.width(), self.expected.width());
        (self.stimulus, self.expected) = (Cycles::new(inputs), Cycles::new(outputs));
        Ok(None)
    }

    fn difference(&self, design: &Design, response: &crate::cosim::Response) -> Option<Mismatch> {
        let out_valid = self.layout.out_valid;
        let difference = first_difference(design, &self.expected, response, |cycle, port| {
            let after_reset = self.first + cycle as u64 >= RESET_CYCLES as u64;
            let payload = port.name.starts_with("out_") && port.name != "out_valid";
            after_reset && (!payload || self.expected.cycle(cycle)[out_valid] == 1)
        })?;
        // Beats taken before that cycle.
        let taken = |cycle: usize| {
            self.expected.cycle(cycle)[out_valid] & self.stimulus.cycle(cycle)[1 + self.layout.out_ready]
        };
        let last = difference.cycle.min(self.expected.len());
        Some(Mismatch {
            beat: self.beats + (0..last).map(taken).sum::<u64>(),
            cycle: (self.first + difference.cycle as u64).saturating_sub(RESET_CYCLES as u64),
            port: difference.port,
            expected: difference.expected,
            got: difference.got,
        })
    }
}

/// The built simulators of a block, for as many runs as there are legs.
#[derive(Debug)]
pub struct Simulators {
    /// The compiled design.
    pub verilator: Option<VerilatorModel>,
    /// The interpreted design.
    pub icarus: Option<IcarusModel>,
}

impl Simulators {
    /// Builds those of `engines`.
    pub fn build(design: &Design, engines: &[Engine], traced: bool) -> Result<Self, CheckError> {
        let verilator = if traced { Verilator::new().traced() } else { Verilator::new() };
        Ok(Self {
            verilator: engines.contains(&Engine::Verilator).then(|| verilator.build(design)).transpose()?,
            icarus: engines.contains(&Engine::Icarus).then(|| Icarus::new().build(design)).transpose()?,
        })
    }
}

/// Runs a block in every engine asked for and compares.
///
/// # Errors
/// When something fails that is not the block. A mismatch is no error: see [`Report::failure`].
pub fn check(check: &Check<'_>, progress: &dyn Progress) -> Result<Report, CheckError> {
    let Check { binding, set, engines, .. } = check;
    let followed = engines.iter().any(|engine| *engine != Engine::Rust);
    let emitted = followed.then(|| emitted(*binding, set, check.sources.as_deref())).transpose()?;
    let simulators = match &emitted {
        Some(emitted) => {
            progress.phase("building", 0);
            Simulators::build(&emitted.design, engines, false)?
        }
        None => Simulators { verilator: None, icarus: None },
    };
    progress.phase(binding.name(), check.vectors);
    let row = |engine| Row { engine, vectors: 0, beats: 0, cycles: 0, time: Duration::ZERO, verdict: Verdict::Agreed };
    let mut rows: Vec<Row> =
        Engine::ALL.into_iter().filter(|engine| *engine == Engine::Rust || engines.contains(engine)).map(row).collect();
    let (mut done, mut failure) = (0, None);
    let icarus_vectors = if simulators.icarus.is_some() { check.icarus_vectors } else { 0 };
    for leg in legs(check.vectors, icarus_vectors, check.seed) {
        let followers = Followers {
            // What depends on the power-up shows.
            verilator: match &simulators.verilator {
                Some(model) => Some(model.start_with(PowerUp::Random(leg.pattern.seed as u32), None)?),
                None => None,
            },
            icarus: simulators.icarus.as_ref().filter(|_| leg.icarus),
        };
        let run = Play::random(*binding, set, leg.pattern, leg.vectors);
        let mut report = |accepted| progress.advance(done + accepted);
        let played = play(run, followers, &mut report, &mut |_, _, _| Ok(()))?;
        done += leg.vectors;
        let [all, verilator, icarus] = played.time;
        for row in &mut rows {
            let (cycles, time) = match row.engine {
                Engine::Rust => (played.counts.cycles, all.saturating_sub(verilator + icarus)),
                Engine::Verilator => (played.replayed[0], verilator),
                Engine::Icarus => (played.replayed[1], icarus),
            };
            row.cycles += cycles;
            row.time += time;
            // An engine that another one's mismatch stopped has replayed nothing.
            if cycles > 0 {
                row.vectors += played.counts.accepted;
                row.beats += played.counts.checked;
            }
        }
        let Some((engine, mismatch)) = played.mismatch else { continue };
        for row in &mut rows {
            row.verdict = if row.engine == engine { Verdict::Mismatch } else { Verdict::Stopped };
        }
        failure = Some(explain(check, &leg, engine, mismatch, played.counts.accepted)?);
        break;
    }
    Ok(Report { block: binding.name(), set: set.name, rows, failure })
}

/// The mismatch with its command line and its waveform.
fn explain(
    check: &Check<'_>,
    leg: &Leg,
    engine: Engine,
    mismatch: Mismatch,
    accepted: u64,
) -> Result<Failure, CheckError> {
    let (block, set, Pattern { idle, stall, seed }) = (check.binding.name(), check.set.name, leg.pattern);
    // One beat more than were accepted is offered; later ones have no influence.
    let vectors = leg.vectors.min(accepted + 1);
    let window = mismatch.cycle.saturating_sub(AROUND.0)..mismatch.cycle + AROUND.1;
    let mut replay =
        format!("relief sim {block} --random {vectors} --seed {seed} --idle {idle} --stall {stall} --param {set}");
    if engine != Engine::Rust {
        replay += &format!(" --engine {engine}");
    }
    if let Some(sources) = &check.sources {
        replay += &format!(" --sources {}", sources.display());
    }
    let folder = check.waveforms.display();
    fs::create_dir_all(&check.waveforms).map_err(io_error(format!("making the folder `{folder}`")))?;
    let path = check.waveforms.join(format!("{block}-{set}-{engine}-seed{seed}.vcd"));
    let mut recording = Recording::new(check.binding, check.set, &path, window)?;
    let run = Play::random(check.binding, check.set, leg.pattern, vectors);
    play(run, Followers::default(), &mut |_| (), &mut |device, _, _| recording.sample(device))?;
    let waveform = recording.finish()?.is_some().then_some(path);
    Ok(Failure { block, set, engine, mismatch, seed, replay, waveform })
}

/// Records what is in a block, with a save file for GTKWave beside it. Both appear whole or not at all.
pub struct Recording {
    recorder: VcdRecorder<fs::File>,
    probe: BlockProbe,
    path: PathBuf,
    wave: OutputFile,
    save: OutputFile,
}

impl Recording {
    /// Records the cycles of `window`, counted from the reset, in the file `path`.
    pub fn new(
        binding: &dyn Binding,
        set: &WidthSet,
        path: &Path,
        window: std::ops::Range<u64>,
    ) -> Result<Self, CheckError> {
        let device = binding.device(set);
        let probe = BlockProbe::new(binding.name(), device.block())?;
        let (wave, save) = (OutputFile::open(path)?, OutputFile::open(&path.with_extension("gtkw"))?);
        let file = wave.writer().map_err(io_error(format!("writing `{}`", path.display())))?;
        let recorder = VcdRecorder::new(file, probe.tree().clone(), window);
        Ok(Self { recorder, probe, path: path.into(), wave, save })
    }

    /// Takes the block's signals, where its cycle is in the window.
    pub fn sample(&mut self, device: &dyn Device) -> Result<(), CheckError> {
        let cycle = device.cycle();
        if self.recorder.wants(cycle) {
            self.recorder.sample(cycle, self.probe.sample(device.block()))?;
        }
        Ok(())
    }

    /// Closes the files and tells which cycles they hold; without a cycle there are no files.
    pub fn finish(self) -> Result<Option<std::ops::Range<u64>>, CheckError> {
        let Self { recorder, probe, path, wave, mut save } = self;
        let Some(held) = recorder.finish()? else { return Ok(None) };
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let text = gtkw(probe.tree(), &Group::of_scopes(probe.tree()), &name)?;
        save.write_all(text.as_bytes()).map_err(io_error(format!("writing beside `{}`", path.display())))?;
        wave.commit()?;
        save.commit()?;
        Ok(Some(held))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn check_legs_hold_every_vector_and_no_seed_twice() {
        for (vectors, icarus) in [(0, 0), (1, 0), (3, 1), (2000, 2000), (2001, 7), (100_000, 10_000), (5, 100)] {
            let legs = legs(vectors, icarus, 7);
            let sum = |icarus| legs.iter().filter(|leg| leg.icarus == icarus).map(|leg| leg.vectors).sum::<u64>();
            assert_eq!((sum(true), sum(false)), (vectors.min(icarus), vectors - vectors.min(icarus)));
            assert!(legs.iter().all(|leg| leg.vectors > 0 && (!leg.icarus || leg.vectors <= ICARUS_LEG)));
            let seeds: std::collections::BTreeSet<_> = legs.iter().map(|leg| leg.pattern.seed).collect();
            assert_eq!(seeds.len(), legs.len());
        }
        let patterns: Vec<_> = legs(2000, 2000, 7).iter().map(|leg| (leg.pattern.idle, leg.pattern.stall)).collect();
        assert_eq!(patterns, PATTERNS);
    }
}
