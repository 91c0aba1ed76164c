// SPDX-License-Identifier: MIT OR Apache-2.0
//! A design compiled by Verilator, driven through a pipe.
//!
//! A generated C++ main reads the input words of a cycle and answers with the output words. It works through whatever
//! the pipe holds before it answers, so the same program serves a batch at full speed and a driver that wants the
//! outputs of each cycle before it chooses the next inputs.
//!
//! Building: Verilator writes the C++, and one call of the compiler makes one object of it. Verilator's own make file
//! would compile its run-time library anew for each design, five times the work of the design itself; here the library
//! is compiled once. The finished program is kept under a fingerprint of all that went into it. Several processes may
//! build at once: a lock lets the second one wait for the first, and a program appears under its name only whole.
//!
//! Not part of the fingerprint: files that a source reads by `` `include `` or `$readmemh`. The latter are read when
//! the program starts, so they need not be; the former are not supported.

use super::{
    CosimError, Cycles, Design, Direction, Response, Simulator, default_cache, design::mask, io_error, program, tools,
};
use std::{
    fs::{self, File},
    io::{self, Read, Write},
    ops::Range,
    path::{Path, PathBuf},
    process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio},
    thread,
    time::Duration,
};

const HARNESS: &str = include_str!("harness.cpp");
/// What stands before the main function of every driver.
const COMMON: &str = include_str!("common.cpp");

/// Flags of the compiler: those of Verilator's make file, of which the warnings concern Verilator's authors.
const COMPILER_FLAGS: [&str; 8] = [
    "-std=gnu++17",
    // Verilator multiplies signed words and lets them overflow, which C++ leaves undefined.
    "-fwrapv",
    "-faligned-new",
    "-fcf-protection=none",
    "-w",
    "-DVM_COVERAGE=0",
    "-DVM_SC=0",
    "-DVM_TRACE_FST=0",
];

/// Of what runs every cycle. With -O2 the compiler takes seven times as long for a large design, which runs no faster.
const EVERY_CYCLE: &str = "-O1";

/// Bytes that fit a pipe whose size could not be raised, with room to spare: so much can be written without reading.
const SAFE_BATCH: usize = 32 << 10;

/// Bytes moved at once in a batch.
const CHUNK: usize = 256 << 10;

/// What registers hold before anything is clocked into them, unless the source says so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PowerUp {
    /// All zeros, as in an FPGA.
    #[default]
    Zeros,
    /// All ones.
    Ones,
    /// Anything, chosen by this seed: what depends on it shows.
    Random(u32),
}

/// A waveform to write while the design runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dump {
    /// The VCD file.
    pub path: PathBuf,
    /// The cycles, counted from power-up.
    pub window: Range<u64>,
}

/// How designs are built.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verilator {
    cache: PathBuf,
    traced: bool,
    limit: Duration,
}

impl Default for Verilator {
    fn default() -> Self {
        Self { cache: default_cache(), traced: false, limit: Duration::from_secs(600) }
    }
}

impl Verilator {
    /// Keeps what it builds in the [default folder](default_cache).
    pub fn new() -> Self {
        Self::default()
    }

    /// Keeps what it builds in this folder.
    pub fn cache(mut self, folder: impl Into<PathBuf>) -> Self {
        self.cache = folder.into();
        self
    }

    /// Builds a simulator that can write waveforms. It is slower, and kept beside the one that cannot.
    pub fn traced(mut self) -> Self {
        self.traced = true;
        self
    }

    /// How long each program that builds may take; ten minutes unless told.
    pub fn limit(mut self, limit: Duration) -> Self {
        self.limit = limit;
        self
    }

    /// Builds the design, or finds it built.
    pub fn build(&self, design: &Design) -> Result<VerilatorModel, CosimError> {
        let (executable, was_cached) = self.built(design, HARNESS)?;
        Ok(VerilatorModel { design: design.clone(), executable, traced: self.traced, was_cached })
    }

    /// The program of a design and a C++ main for its ports, and whether it had been built before.
    pub(super) fn built(&self, design: &Design, main: &str) -> Result<(PathBuf, bool), CosimError> {
        design.check()?;
        let verilator = tools::find("verilator")?.version;
        let compiler = tools::find("g++")?.version;
        let harness = harness(design, main);
        let mut key = Fingerprint::default();
        for text in [&verilator, &compiler, &harness, &design.top] {
            key.add(text.as_bytes());
        }
        key.add(COMPILER_FLAGS.join(" ").as_bytes());
        key.add(EVERY_CYCLE.as_bytes());
        key.add(self.generator_flags(design).join(" ").as_bytes());
        let sources = design.absolute_sources()?;
        for source in &sources {
            // The name counts, as messages of the design carry it.
            key.add(source.file_name().unwrap_or_default().as_encoded_bytes());
            key.add(&fs::read(source).map_err(io_error(format!("reading `{}`", source.display())))?);
        }
        let executable = self.cache.join(format!("{}-{}", design.top, key.text()));
        let was_cached = executable.is_file();
        if !was_cached {
            self.once(&executable, |folder| {
                self.compile(design, &sources, &harness, &format!("{verilator}\n{compiler}"), folder)
            })?;
        }
        Ok((executable, was_cached))
    }

    /// Makes a file that does not exist yet, in a folder that vanishes; `make` returns where in it the file lies.
    /// Whoever comes while somebody is at it waits, and then finds it made.
    fn once(&self, wanted: &Path, make: impl FnOnce(&Path) -> Result<PathBuf, CosimError>) -> Result<(), CosimError> {
        let cache = self.cache.display();
        fs::create_dir_all(&self.cache).map_err(io_error(format!("making the folder `{cache}`")))?;
        let lock_path = wanted.with_extension("lock");
        let lock = File::create(&lock_path).map_err(io_error(format!("making `{}`", lock_path.display())))?;
        lock.lock().map_err(io_error(format!("locking `{}`", lock_path.display())))?;
        if wanted.is_file() {
            return Ok(());
        }
        let folder = tempfile::Builder::new()
            .prefix("building-")
            .tempdir_in(&self.cache)
            .map_err(io_error(format!("making a folder in `{cache}`")))?;
        let made = make(folder.path())?;
        fs::rename(made, wanted).map_err(io_error(format!("naming `{}`", wanted.display())))
    }

    fn generator_flags(&self, design: &Design) -> Vec<String> {
        let mut flags: Vec<String> = ["--cc", "-O3", "--assert", "--no-timing", "-Wno-fatal", "--prefix", "Vdut"]
            // So that power-up is chosen when the program starts.
            .into_iter()
            .chain(["--x-initial", "unique", "--x-assign", "unique", "--top-module", &design.top])
            .map(String::from)
            .collect();
        if self.traced {
            flags.push("--trace".into());
        }
        flags
    }

    fn compile(
        &self,
        design: &Design,
        sources: &[PathBuf],
        harness: &str,
        versions: &str,
        folder: &Path,
    ) -> Result<PathBuf, CosimError> {
        let top = &design.top;
        let what = format!("translating `{top}` with Verilator");
        let mut generate = Command::new("verilator");
        generate.args(self.generator_flags(design)).arg("--Mdir").arg(folder).args(sources);
        generate.current_dir(design.folder()?);
        program::run(&mut generate, &what, self.limit)?.expect_success(&what)?;

        // Two objects, of what runs every cycle and of what runs once: each file of its own would read the same headers
        // again.
        let list = folder.join("Vdut_classes.mk");
        let list = fs::read_to_string(&list).map_err(io_error(format!("reading `{}`", list.display())))?;
        let include = self.include_folder()?;
        let what = format!("compiling the simulator of `{top}`");
        for (object, kind, level) in [("fast", "FAST", EVERY_CYCLE), ("slow", "SLOW", "-O0")] {
            let classes = [format!("VM_CLASSES_{kind}"), format!("VM_SUPPORT_{kind}")];
            let classes = classes.iter().flat_map(|name| make_variable(&list, name));
            let mut all: String = classes.map(|class| format!("#include \"{class}.cpp\"\n")).collect();
            if kind == "FAST" {
                all += harness;
            }
            write(&folder.join(format!("{object}.cpp")), &all)?;
            let mut compile = self.compiler(&include);
            compile.args([level, "-c", &format!("{object}.cpp"), "-o", &format!("{object}.o")]).current_dir(folder);
            program::run(&mut compile, &what, self.limit)?.expect_success(&what)?;
        }

        let mut link = Command::new("g++");
        link.args(["-o", "simulator", "fast.o", "slow.o"]).current_dir(folder);
        for class in ["VM_GLOBAL_FAST", "VM_GLOBAL_SLOW"].iter().flat_map(|name| make_variable(&list, name)) {
            link.arg(self.runtime(&class, versions, &include)?);
        }
        link.args(["-pthread", "-latomic"]);
        let what = format!("linking the simulator of `{top}`");
        program::run(&mut link, &what, self.limit)?.expect_success(&what)?;
        Ok(folder.join("simulator"))
    }

    fn compiler(&self, include: &Path) -> Command {
        let mut compiler = Command::new("g++");
        let traced = u8::from(self.traced);
        compiler.args(COMPILER_FLAGS).args([format!("-DVM_TRACE={traced}"), format!("-DVM_TRACE_VCD={traced}")]);
        compiler.arg("-I.").arg("-I").arg(include).arg("-I").arg(include.join("vltstd"));
        compiler
    }

    /// An object of Verilator's run-time library, compiled once for all designs.
    fn runtime(&self, class: &str, versions: &str, include: &Path) -> Result<PathBuf, CosimError> {
        let source = include.join(format!("{class}.cpp"));
        let mut key = Fingerprint::default();
        key.add(versions.as_bytes());
        key.add(COMPILER_FLAGS.join(" ").as_bytes());
        key.add(&[u8::from(self.traced)]);
        key.add(source.as_os_str().as_encoded_bytes());
        let object = self.cache.join(format!("{class}-{}.o", key.text()));
        if !object.is_file() {
            self.once(&object, |folder| {
                let what = format!("compiling Verilator's `{class}`");
                let mut compile = self.compiler(include);
                compile.arg("-O2").arg("-c").arg(&source).args(["-o", "runtime.o"]).current_dir(folder);
                program::run(&mut compile, &what, self.limit)?.expect_success(&what)?;
                Ok(folder.join("runtime.o"))
            })?;
        }
        Ok(object)
    }

    fn include_folder(&self) -> Result<PathBuf, CosimError> {
        let what = "asking Verilator for its folder";
        let mut ask = Command::new("verilator");
        let answer = program::run(ask.args(["--getenv", "VERILATOR_ROOT"]), what, self.limit)?.expect_success(what)?;
        let include = Path::new(answer.stdout.trim()).join("include");
        if include.join("verilated.h").is_file() {
            return Ok(include);
        }
        let reason = format!("there is no verilated.h in `{}`", include.display());
        Err(CosimError::Answer { what: what.to_string(), reason })
    }
}

/// The words of a variable of a make file: `NAME += \`, then one word a line.
fn make_variable(text: &str, name: &str) -> Vec<String> {
    let mut lines = text.lines().skip_while(|line| line.split_whitespace().next() != Some(name));
    lines.next();
    lines
        .map_while(|line| line.trim().strip_suffix('\\'))
        .map(|word| word.trim().to_string())
        .filter(|word| !word.is_empty())
        .collect()
}

/// A C++ main for the ports of a design.
fn harness(design: &Design, main: &str) -> String {
    let (mut set, mut get) = (String::new(), String::new());
    for (port, slot) in design.slots(Direction::Input) {
        let (name, word) = (mangled(&port.name), slot.word);
        let top_bits = mask((port.bits - 1) % 32 + 1);
        set += &match port.bits {
            // Verilator wants the spare bits of an input clear.
            bits @ ..=64 => format!("  dut.{name} = in[{word}] & {:#x}ULL;\n", mask(bits)),
            bits => format!(
                "  memcpy(&dut.{name}[0], in + {word}, {});\n  dut.{name}[{}] &= {top_bits:#x}U;\n",
                bits.div_ceil(32) * 4,
                bits.div_ceil(32) - 1,
            ),
        };
    }
    for (port, slot) in design.slots(Direction::Output) {
        let (name, word) = (mangled(&port.name), slot.word);
        get += &match port.bits {
            ..=64 => format!("  out[{word}] = dut.{name};\n"),
            bits => format!(
                "  out[{}] = 0;\n  memcpy(out + {word}, &dut.{name}[0], {});\n",
                word + port.words() - 1,
                bits.div_ceil(32) * 4,
            ),
        };
    }
    let clock =
        |level: u8| design.clock.as_ref().map_or(String::new(), |name| format!("dut.{} = {level};", mangled(name)));
    let text = format!("{COMMON}{main}");
    text.replace("@IN@", &design.input_words().to_string())
        .replace("@OUT@", &design.output_words().to_string())
        .replace("@SET@", &set)
        .replace("@GET@", &get)
        .replace("@CLOCK_LOW@", &clock(0))
        .replace("@CLOCK_HIGH@", &clock(1))
}

/// The name that Verilator gives a port: two underscores in a row are its own mark.
fn mangled(name: &str) -> String {
    name.replace("__", "___05F")
}

fn write(path: &Path, text: &str) -> Result<(), CosimError> {
    fs::write(path, text).map_err(io_error(format!("writing `{}`", path.display())))
}

/// FNV-1a with 128 bits: the same in every process and in every version, which the standard library's hashes need not
/// be, and long enough that two designs do not meet by chance.
struct Fingerprint(u128);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Fingerprint {
    fn add(&mut self, bytes: &[u8]) {
        // The length sets neighbours apart: "a" and "bc" are not "ab" and "c".
        for &byte in (bytes.len() as u64).to_le_bytes().iter().chain(bytes) {
            self.0 = (self.0 ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b);
        }
    }

    fn text(&self) -> String {
        format!("{:032x}", self.0)
    }
}

/// A design that Verilator has compiled. It may be started many times, also at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilatorModel {
    design: Design,
    executable: PathBuf,
    traced: bool,
    was_cached: bool,
}

impl VerilatorModel {
    /// Whether the design had been built before.
    pub fn was_cached(&self) -> bool {
        self.was_cached
    }

    /// The compiled program.
    pub fn executable(&self) -> &Path {
        &self.executable
    }

    /// Starts the design with zeros in all registers and memories that the source leaves open.
    pub fn start(&self) -> Result<Session, CosimError> {
        self.start_with(PowerUp::Zeros, None)
    }

    /// Starts the design, and writes a waveform if wanted; that takes a model that was built
    /// [traced](Verilator::traced).
    pub fn start_with(&self, power_up: PowerUp, dump: Option<&Dump>) -> Result<Session, CosimError> {
        let design = &self.design;
        let mut command = Command::new(&self.executable);
        // A minute without an answer is no simulation of a block any more.
        command.args(["--limit", "60"]).current_dir(design.folder()?);
        match power_up {
            PowerUp::Zeros => command.arg("+verilator+rand+reset+0"),
            PowerUp::Ones => command.arg("+verilator+rand+reset+1"),
            // Verilator takes a seed of 0 for none, and at most 31 bits.
            PowerUp::Random(seed) => {
                command.args(["+verilator+rand+reset+2".into(), format!("+verilator+seed+{}", seed % 0x7fff_ffff + 1)])
            }
        };
        if let Some(Dump { path, window }) = dump {
            if !self.traced {
                let reason = "a waveform is wanted, and it was not built traced".into();
                return Err(CosimError::Design { top: design.top.clone(), reason });
            }
            // The program runs in another folder.
            let path = std::path::absolute(path).map_err(io_error(format!("looking for `{}`", path.display())))?;
            File::create(&path).map_err(io_error(format!("making `{}`", path.display())))?;
            command.arg("--vcd").arg(path).args([window.start.to_string(), window.end.to_string()]);
        }
        let what = format!("starting the simulator of `{}`", design.top);
        let messages = tempfile::tempfile().map_err(io_error("making a temporary file"))?;
        let copy = messages.try_clone().map_err(io_error("sharing a temporary file"))?;
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(copy);
        let mut child = command.spawn().map_err(io_error(what))?;
        let (stdin, stdout) = (child.stdin.take(), child.stdout.take());
        let Some(stdout) = stdout else {
            return Err(CosimError::Answer { what: design.top.clone(), reason: "it has no output".into() });
        };
        Ok(Session {
            top: design.top.clone(),
            design: design.clone(),
            outputs: vec![0; design.output_words()],
            bytes: Vec::new(),
            cycles: 0,
            messages,
            stdin,
            stdout,
            child,
        })
    }
}

impl Simulator for VerilatorModel {
    fn name(&self) -> &'static str {
        "verilator"
    }

    fn design(&self) -> &Design {
        &self.design
    }

    fn run(&self, stimulus: &Cycles) -> Result<Response, CosimError> {
        let mut session = self.start()?;
        let values = session.run(stimulus)?;
        session.finish()?;
        Ok(Response { values, unknown: None })
    }
}

/// A design that runs. Its state lasts from one call to the next.
#[derive(Debug)]
pub struct Session {
    top: String,
    design: Design,
    outputs: Vec<u64>,
    bytes: Vec<u8>,
    cycles: u64,
    messages: File,
    stdin: Option<ChildStdin>,
    stdout: ChildStdout,
    child: Child,
}

impl Session {
    /// The design.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// Cycles since power-up.
    pub fn cycles(&self) -> u64 {
        self.cycles
    }

    /// Runs one cycle and returns its outputs. Each call waits for the other process, some 7 us; a batch takes
    /// a tenth of a microsecond a cycle.
    pub fn cycle(&mut self, inputs: &[u64]) -> Result<&[u64], CosimError> {
        self.design.check_width(inputs.len())?;
        self.bytes.clear();
        self.bytes.extend(inputs.iter().flat_map(|word| word.to_le_bytes()));
        let sent = self.stdin.as_mut().map_or(Ok(()), |stdin| stdin.write_all(&self.bytes));
        self.bytes.resize(self.outputs.len() * 8, 0);
        if sent.and_then(|()| self.stdout.read_exact(&mut self.bytes)).is_err() {
            return Err(self.ended());
        }
        for (word, bytes) in self.outputs.iter_mut().zip(self.bytes.chunks_exact(8)) {
            *word = word_of(bytes);
        }
        self.cycles += 1;
        Ok(&self.outputs)
    }

    /// Runs many cycles whose inputs are known, and returns the outputs of each.
    pub fn run(&mut self, stimulus: &Cycles) -> Result<Cycles, CosimError> {
        self.design.check_width(stimulus.width())?;
        let width = self.outputs.len();
        let wanted = stimulus.len() * width;
        let mut words = Vec::with_capacity(wanted);
        let Some(stdin) = &mut self.stdin else { return Err(self.ended()) };
        let stdout = &mut self.stdout;
        let result = if stimulus.words().len().max(wanted) * 8 <= SAFE_BATCH {
            send(stdin, stimulus.words()).and_then(|()| receive(stdout, wanted, &mut words))
        } else {
            // Both pipes would be full one day, and both processes wait: so one thread writes while this one reads.
            thread::scope(|scope| {
                let sender = scope.spawn(|| send(stdin, stimulus.words()));
                let received = receive(stdout, wanted, &mut words);
                let sent = sender.join().unwrap_or_else(|_| Err(io::Error::other("the sender gave up")));
                received.and(sent)
            })
        };
        self.cycles += (words.len() / width) as u64;
        match result {
            Ok(()) => Ok(Cycles::from_words(width, words)),
            Err(_) => Err(self.ended()),
        }
    }

    /// Lets the design end, with `final` blocks and a whole waveform, and says whether it did so in peace.
    pub fn finish(mut self) -> Result<(), CosimError> {
        let status = self.close().map_err(io_error(format!("waiting for the simulator of `{}`", self.top)))?;
        if status.success() { Ok(()) } else { Err(self.ended()) }
    }

    /// Without input the program ends by itself, once what it still has to say is taken off it.
    fn close(&mut self) -> io::Result<ExitStatus> {
        self.stdin = None;
        io::copy(&mut self.stdout, &mut io::sink())?;
        self.child.wait()
    }

    /// Why there is no answer any more.
    fn ended(&mut self) -> CosimError {
        let status = match self.close() {
            // SIGALRM, which the harness sets itself.
            Ok(status) if program::describe(status) == "signal 14" => "no answer for a minute".into(),
            Ok(status) => program::describe(status),
            Err(cause) => cause.to_string(),
        };
        let excerpt = program::excerpt(&program::content(&mut self.messages));
        CosimError::Ended { top: self.top.clone(), cycles: self.cycles, status, excerpt }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let _ = self.close();
    }
}

pub(super) fn send(stdin: &mut ChildStdin, words: &[u64]) -> io::Result<()> {
    let mut bytes = Vec::with_capacity(words.len().min(CHUNK / 8) * 8);
    for chunk in words.chunks(CHUNK / 8) {
        bytes.clear();
        bytes.extend(chunk.iter().flat_map(|word| word.to_le_bytes()));
        stdin.write_all(&bytes)?;
    }
    Ok(())
}

fn receive(stdout: &mut ChildStdout, wanted: usize, words: &mut Vec<u64>) -> io::Result<()> {
    // A read may end within a word; the rest of it comes with the next.
    let mut bytes = vec![0; CHUNK.min(wanted * 8)];
    let mut have = 0;
    while words.len() < wanted {
        let room = bytes.len().min((wanted - words.len()) * 8);
        let got = stdout.read(&mut bytes[have..room])?;
        if got == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        have += got;
        let whole = have / 8 * 8;
        words.extend(bytes[..whole].chunks_exact(8).map(word_of));
        bytes.copy_within(whole..have, 0);
        have -= whole;
    }
    Ok(())
}

/// All words until the other side ends.
pub(super) fn receive_all(from: &mut dyn Read) -> io::Result<Vec<u64>> {
    let (mut words, mut bytes, mut have) = (Vec::new(), vec![0; CHUNK], 0);
    loop {
        let got = from.read(&mut bytes[have..])?;
        if got == 0 {
            return Ok(words);
        }
        have += got;
        let whole = have / 8 * 8;
        words.extend(bytes[..whole].chunks_exact(8).map(word_of));
        bytes.copy_within(whole..have, 0);
        have -= whole;
    }
}

fn word_of(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte))
}
