// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief sim`: one block, one stimulus, one engine; counts, verdict, waveforms.

use std::io::{Write, stdout};
use std::ops::Range;
use std::path::PathBuf;

use relief_hdl::verilog::PortInfo;
use relief_hdl::widths::WidthSet;
use relief_models::mesh::Progress;
use relief_testbench::binding::{Binding, expect_offered};
use relief_testbench::check::{Engine, Followers, Play, Recording, Simulators, emission, emitted, play};
use relief_testbench::cosim::{Design, Dump, PowerUp};
use relief_testbench::device::Layout;
use relief_testbench::output::OutputFile;
use relief_testbench::scoreboard::{Pattern, Until};
use relief_testbench::stimulus::{parse_stimulus, read_bounded};
use relief_waves::{Drawing, Group, Item, Label, Scope, Signal, SignalTree, VcdRecorder, draw, gtkw, read};

use super::{Meter, Outcome, Result, count, select, write_all};

/// Play one block on random beats or on those of a file, and compare it with its golden model
///
/// A stimulus file holds one beat a line: integers with blanks between them; `#` begins a comment. `relief blocks` says
/// what the integers are. rust-hdl always runs; with another engine, that engine is compared with it in every cycle.
#[derive(clap::Args)]
pub struct Arguments {
    /// The block
    block: String,
    /// Play N random beats; 1000 unless there is a stimulus file
    #[arg(long, value_name = "N", conflicts_with = "stimulus", value_parser = count, allow_negative_numbers = true)]
    random: Option<u64>,
    /// Seed of random beats, idle cycles and backpressure
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = count, allow_negative_numbers = true)]
    seed: u64,
    /// Play the beats of this file
    #[arg(long, value_name = "FILE")]
    stimulus: Option<PathBuf>,
    /// rust, verilator or icarus
    #[arg(long, value_name = "ENGINE", default_value = "rust")]
    engine: Engine,
    /// Width set
    #[arg(long, value_name = "NAME")]
    param: Option<String>,
    /// Cycles in which no beat is offered, in percent
    #[arg(long, value_name = "P", default_value_t = 0, value_parser = percent, allow_negative_numbers = true)]
    idle: u8,
    /// Cycles in which no beat is taken, in percent
    #[arg(long, value_name = "P", default_value_t = 0, value_parser = percent, allow_negative_numbers = true)]
    stall: u8,
    /// Write a waveform, and beside it a save file for GTKWave
    #[arg(long, value_name = "FILE")]
    vcd: Option<PathBuf>,
    /// Draw the input and the output stream
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Cycles of the waveform and the drawing, counted from the reset; B is left out
    #[arg(long, value_name = "A..B", default_value = "0..64", value_parser = window)]
    cycles: Range<u64>,
    /// Play the emitted design of this folder in the place of a fresh one
    #[arg(long, value_name = "DIR")]
    sources: Option<PathBuf>,
}

/// Icarus takes its stimulus whole, so this bounds the memory.
const ICARUS_MOST: u64 = 100_000;

/// More cycles make no picture.
const DRAWN_MOST: u64 = 500;

fn percent(text: &str) -> std::result::Result<u8, String> {
    text.parse().ok().filter(|percent| *percent < 100).ok_or_else(|| "a whole number from 0 to 99 is expected".into())
}

fn window(text: &str) -> std::result::Result<Range<u64>, String> {
    let parse = || {
        let (start, end) = text.split_once("..")?;
        Some(start.parse::<u64>().ok()?..end.parse::<u64>().ok()?)
    };
    match parse() {
        Some(window) if window.start < window.end => Ok(window),
        _ => Err("a window is A..B with A below B, such as 100..164".into()),
    }
}

/// Plays and reports.
pub fn run(arguments: &Arguments) -> Result {
    let block = select::block(&arguments.block)?;
    let set = select::width_set(arguments.param.as_deref())?;
    expect_offered(block, set)?;
    let (engine, window) = (arguments.engine, &arguments.cycles);
    if let Some(missing) = engine.missing() {
        return Err(missing.into());
    }
    if engine == Engine::Icarus && arguments.vcd.is_some() {
        return Err("Icarus writes no waveform here: give --engine rust or --engine verilator with --vcd".into());
    }
    if engine == Engine::Rust && arguments.sources.is_some() {
        return Err(
            "--sources is read by Verilator and Icarus alone: give --engine verilator or --engine icarus".into()
        );
    }
    if let (Some(vcd), Some(svg)) = (&arguments.vcd, &arguments.svg)
        && (vcd == svg || vcd.with_extension("gtkw") == *svg)
    {
        return Err(
            format!("--svg {} would replace the waveform or its save file: give another name", svg.display()).into()
        );
    }
    if arguments.vcd.as_ref().is_some_and(|path| path.extension().is_some_and(|extension| extension == "gtkw")) {
        return Err(
            "--vcd names the save file of GTKWave, which goes beside the waveform: give a name such as wave.vcd".into(),
        );
    }
    if arguments.svg.is_some() && window.end - window.start > DRAWN_MOST {
        return Err(format!(
            "--cycles holds {} cycles, and a drawing at most {DRAWN_MOST}: give a smaller window with --svg",
            window.end - window.start
        )
        .into());
    }
    let pattern = Pattern { idle: arguments.idle, stall: arguments.stall, seed: arguments.seed };
    let (run, vectors, what) = match &arguments.stimulus {
        Some(path) => {
            let bytes = read_bounded(path, "a stimulus file")?;
            let beats = parse_stimulus(block, set, &path.display().to_string(), &bytes)?;
            let vectors = beats.len() as u64;
            let source = Box::new(beats.into_iter());
            let run = Play { binding: block, set, pattern, source, until: Until::Exhausted };
            (run, vectors, format!("{}", path.display()))
        }
        None => {
            let vectors = arguments.random.unwrap_or(1000);
            (Play::random(block, set, pattern, vectors), vectors, format!("random, seed {}", arguments.seed))
        }
    };
    if vectors == 0 {
        return Err("the stimulus has no beat, and a check of nothing would agree: give 1 or more".into());
    }
    if engine == Engine::Icarus && vectors > ICARUS_MOST {
        return Err(format!("{vectors} vectors are too many for Icarus: give at most {ICARUS_MOST}").into());
    }

    let traced = engine == Engine::Verilator && arguments.vcd.is_some();
    let emitted = match engine {
        Engine::Rust => None,
        _ => Some(emitted(block, set, arguments.sources.as_deref())?),
    };
    let meter = Meter::new();
    if emitted.is_some() {
        meter.phase("building", 0);
    }
    let simulators = match &emitted {
        Some(emitted) => Simulators::build(&emitted.design, &[engine], traced)?,
        None => Simulators { verilator: None, icarus: None },
    };
    // Verilator counts from power-up, and is in reset for the first cycles.
    let reset = relief_testbench::check::RESET_CYCLES as u64;
    let dumped = traced.then(|| tempfile::Builder::new().suffix(".vcd").tempfile()).transpose()?;
    let dump = dumped.as_ref().map(|file| Dump {
        path: file.path().into(),
        window: window.start.saturating_add(reset)..window.end.saturating_add(reset),
    });
    // Every output is opened before the work.
    let open = |path: PathBuf| OutputFile::open(&path);
    let mut wave = match arguments.vcd.as_ref().filter(|_| traced) {
        Some(path) => Some((open(path.clone())?, open(path.with_extension("gtkw"))?)),
        None => None,
    };
    let mut picture = arguments.svg.clone().map(open).transpose()?;
    let followers = Followers {
        verilator: match &simulators.verilator {
            Some(model) => Some(model.start_with(PowerUp::Random(arguments.seed as u32), dump.as_ref())?),
            None => None,
        },
        icarus: simulators.icarus.as_ref(),
    };
    let mut recording = match &arguments.vcd {
        Some(path) if !traced => Some(Recording::new(block, set, path, window.clone())?),
        _ => None,
    };
    let mut streams = arguments.svg.as_ref().map(|_| Streams::new(block, set, window.clone())).transpose()?;

    meter.phase(block.name(), vectors);
    let played = play(run, followers, &mut |done| meter.advance(done), &mut |device, inputs, outputs| {
        if let Some(recording) = &mut recording {
            recording.sample(device)?;
        }
        match &mut streams {
            Some(streams) => Ok(streams.sample(device.cycle(), inputs, outputs)?),
            None => Ok(()),
        }
    });
    meter.finish();
    let played = played?;

    let counts = played.counts;
    let (name, idle, stall) = (block.name(), pattern.idle, pattern.stall);
    let mut text = format!(
        "{name}, width set {}, engine {engine}, {what}, idle {idle} %, stall {stall} %\n{} vectors, {} beats, {} cycles: ",
        set.name, counts.accepted, counts.checked, counts.cycles
    );
    text += &match &played.mismatch {
        None => "agreed with the golden model\n".to_string(),
        Some((engine, mismatch)) => format!("MISMATCH in {engine}: {mismatch}\n"),
    };
    write_all(stdout(), &text)?;

    let short = || {
        let Range { start, end } = window;
        format!("--cycles is {start}..{end}, and the run has only {} cycles: give a window within them", counts.cycles)
    };
    if let (Some(path), Some(dump), Some(emitted), Some((mut wave, mut save))) =
        (&arguments.vcd, &dump, &emitted, wave.take())
    {
        if window.start >= counts.cycles {
            return Err(short().into());
        }
        std::io::copy(&mut std::fs::File::open(&dump.path)?, &mut wave)?;
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let tree = outer_ports(&emitted.design)?;
        save.write_all(gtkw(&tree, &Group::of_scopes(&tree), &file)?.as_bytes())?;
        wave.commit()?;
        save.commit()?;
    }
    if let Some(recording) = recording
        && recording.finish()?.is_none()
    {
        return Err(short().into());
    }
    if let (Some(mut picture), Some(streams)) = (picture.take(), streams) {
        let title = format!("{name}, {}, idle {idle} %, stall {stall} %", set.name);
        let drawn = streams.finish(&title)?.ok_or_else(short)?;
        picture.write_all(drawn.as_bytes())?;
        picture.commit()?;
    }
    Ok(if played.mismatch.is_none() { Outcome::Agreed } else { Outcome::Mismatch })
}

/// The ports as Verilator's waveform names them.
fn outer_ports(design: &Design) -> std::result::Result<SignalTree, relief_waves::TreeError> {
    let ports = design.ports.iter().map(|port| Item::Signal(Signal::unsigned(&port.name, port.bits)));
    SignalTree::new(Scope { name: "TOP".into(), items: ports.collect() })
}

/// Records the ports alone, to be drawn.
struct Streams {
    recorder: VcdRecorder<std::fs::File>,
    file: tempfile::NamedTempFile,
    block: &'static str,
    ports: Vec<PortInfo>,
    inputs: usize,
    words: Vec<u64>,
    last: Option<u64>,
    window: Range<u64>,
}

impl Streams {
    fn new(
        block: &'static dyn Binding,
        set: &WidthSet,
        window: Range<u64>,
    ) -> std::result::Result<Self, Box<dyn std::error::Error>> {
        let layout = Layout::of(block.device(set).as_ref());
        let emission = emission(block, set)?;
        let mut ports = Vec::new();
        for (shape, _) in layout.inputs.iter().chain(&layout.outputs) {
            // A lane count and a sign are known to the emission alone.
            let known = emission.top_module().ports.iter().find(|port| port.name == shape.name);
            ports.push(known.cloned().ok_or_else(|| format!("the emitted module has no port `{}`", shape.name))?);
        }
        let signals = ports.iter().map(|port| {
            let PortInfo { name, bits, signed, lanes, .. } = port;
            Item::Signal(match (lanes, signed) {
                (0, false) => Signal::unsigned(name, *bits),
                (0, true) => Signal::signed(name, *bits),
                (lanes, _) => Signal::lanes(name, *lanes, bits / lanes),
            })
        });
        let tree = SignalTree::new(Scope { name: block.name().into(), items: signals.collect() })?;
        let file = tempfile::Builder::new().suffix(".vcd").tempfile()?;
        let words = vec![0; layout.input_words + layout.output_words];
        let recorder = VcdRecorder::new(file.reopen()?, tree, window.clone());
        let inputs = layout.input_words;
        Ok(Self { recorder, file, block: block.name(), ports, inputs, words, last: None, window })
    }

    fn sample(
        &mut self,
        cycle: u64,
        inputs: &[u64],
        outputs: &[u64],
    ) -> std::result::Result<(), relief_waves::record::RecordError> {
        self.last = Some(cycle);
        if !self.recorder.wants(cycle) {
            return Ok(());
        }
        self.words[..self.inputs].copy_from_slice(inputs);
        self.words[self.inputs..].copy_from_slice(outputs);
        self.recorder.sample(cycle, &self.words)
    }

    /// The picture, or nothing when the run ended before the window.
    fn finish(self, title: &str) -> std::result::Result<Option<String>, Box<dyn std::error::Error>> {
        let Self { recorder, file, block, ports, window, .. } = self;
        let Some(held) = recorder.finish()? else { return Ok(None) };
        let held = held.start..held.end.min(window.end);
        let mut drawing = Drawing::new(title, held);
        // Full names, as the output `error` might also end another name.
        let full = |name: &str| format!("{block}.{name}");
        for side in ["in", "out"] {
            drawing = drawing.stream(&full(side), []);
            for port in &ports {
                let is_handshake = ["valid", "ready"].iter().any(|wire| port.name == format!("{side}_{wire}"));
                let of_side = match side {
                    "in" => port.name.starts_with("in_"),
                    _ => !port.name.starts_with("in_"),
                };
                if is_handshake || !of_side || port.name == "out_ready" {
                    continue;
                }
                let stream = Some(drawing.streams.len() - 1);
                // Of a vertex the first component tells it from its neighbours.
                let shown = if port.lanes <= 3 { port.lanes } else { 1 };
                let rows = (0..shown).map(|lane| (full(&format!("{}[{lane}]", port.name)), Label::Signed));
                let single = (port.lanes == 0).then(|| (full(&port.name), Label::Decimal));
                for (signal, label) in rows.chain(single) {
                    drawing.rows.push(match port.bits {
                        1 => relief_waves::Row::Bit { signal, stream },
                        _ => relief_waves::Row::Bus { signal, label, stream },
                    });
                }
            }
        }
        Ok(Some(draw(&read(file.path())?, &drawing)?))
    }
}
