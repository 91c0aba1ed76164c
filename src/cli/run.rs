// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief run`: a scene through the pipeline, to pictures, a mesh, a waveform, Verilog and a report.

use std::fmt::Write as _;
use std::io::{stderr, stdout};
use std::path::{Path, PathBuf};
use std::time::Instant;

use relief_hdl::widths::WidthSet;
use relief_models::mesh::Progress;
use relief_models::scene;
use relief_testbench::binding::find;
use relief_testbench::check::{self, emission};
use relief_testbench::cosim::Stalls;
use relief_testbench::frame::{
    CulledReport, DesignError, DesignReport, DrawReport, NoPlaceReport, Prepared, Report, expect_drawable, prepare,
    render, render_by_design, width_set,
};
use relief_testbench::output::{MadeFolder, OutputFile, OutputFolder};
use relief_testbench::pipeline::{BLOCKS, Pipeline, PipelineRecording};

use super::{Meter, Outcome, Result, select, write_all};

/// Take a scene with a height map through the displacement pipeline
///
/// Base triangles go through transform, culling, remesher, level choice, height fetch, displacement, strip unit, light and
/// rasteriser. All but the rasteriser, and light if there are several, run as hardware, every beat compared with golden;
/// the report says which stages are golden. docs/scene.md tells what a scene file holds.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene (TOML)
    scene: PathBuf,
    /// The folder for frame.png, mesh.png, mesh.obj, pipeline.vcd, pipeline.gtkw, report.json and rtl/
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// The width set: that of the smallest map memory that holds the maps, unless one is named
    #[arg(long, value_name = "NAME")]
    param: Option<String>,
    /// The levels that a map has at most, its samples included
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=15))]
    levels: Option<u8>,
    /// What the hardware runs in
    #[arg(long, value_enum, default_value_t = Engine::Rust)]
    engine: Engine,
    /// Cycles of a hundred, at random and at most 90, in which the streams of the draw are held up; what leaves stays the same
    #[arg(long, value_name = "PERCENT", default_value_t = 0, value_parser = clap::value_parser!(u8).range(..=90))]
    stalls: u8,
    /// Which of all patterns of stalls
    #[arg(long, default_value_t = 1)]
    seed: u32,
}

impl Arguments {
    const fn stalls(&self) -> Stalls {
        Stalls { percent: self.stalls, seed: self.seed }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Engine {
    /// The blocks in Rust
    Rust,
    /// In Rust, and their Verilog in Verilator behind them, compared cycle by cycle
    Verilator,
    /// The datapath as one design, its Verilog in Verilator alone, compared beat by beat; writes frame.png and report.json
    Design,
    /// Verilator where it is installed, otherwise Rust
    Auto,
}

/// Cycles of the waveform.
const WAVEFORM: u64 = 400;

/// Reads, draws and writes.
pub fn run(arguments: &Arguments) -> Result {
    let begun = Instant::now();
    let mut scene = scene::read(&arguments.scene)?;
    scene.remesh.levels = arguments.levels.map_or(usize::MAX, usize::from);
    let set = match &arguments.param {
        Some(name) => select::width_set(Some(name))?,
        None => width_set(&scene),
    };
    if arguments.engine == Engine::Design {
        expect_drawable(&scene, set).map_err(|error| format!("{}: {error}", arguments.scene.display()))?;
    }
    let prepared = prepare(&scene, set)?;
    let mut warnings: Vec<String> = scene.warnings.iter().chain(&prepared.warnings).cloned().collect();
    for warning in &warnings {
        write_all(stderr(), &format!("warning: {warning}\n"))?;
    }
    let engine = match arguments.engine {
        Engine::Auto if check::Engine::Verilator.missing().is_none() => Engine::Verilator,
        Engine::Auto => Engine::Rust,
        engine => engine,
    };
    if let (Engine::Verilator | Engine::Design, Some(missing)) = (engine, check::Engine::Verilator.missing()) {
        return Err(missing.into());
    }
    if engine == Engine::Design {
        return design(arguments, &prepared, set, warnings, begun);
    }
    // Every output is opened before the work. Folders that turn out to be made for nothing go last.
    let out = &arguments.out;
    let _made = MadeFolder::open(&out.join("rtl"))?;
    let open = |name: &str| OutputFile::open(&out.join(name));
    let files = [open("frame.png")?, open("mesh.png")?, open("report.json")?];
    let mesh = open("mesh.obj")?;
    let mut obj = std::io::BufWriter::new(mesh.writer()?);
    let rtl = BLOCKS.map(|name| OutputFolder::open(&out.join("rtl").join(name)));
    let rtl = rtl.into_iter().collect::<std::result::Result<Vec<_>, _>>()?;

    let meter = Meter::new();
    let mut pipeline = Pipeline::new(set);
    pipeline.stall(arguments.stalls());
    let folder = tempfile::tempdir()?;
    if engine == Engine::Verilator {
        meter.phase("building", 0);
        pipeline.follow(folder.path())?;
    }
    let recording = PipelineRecording::new(&pipeline, &out.join("pipeline.vcd"), 0..WAVEFORM)?;
    let rendered = render(&prepared, &mut pipeline, Some(recording), &mut obj, &meter);
    meter.finish();
    let (mut rendered, recording) = match rendered {
        Ok(rendered) => rendered,
        Err(error) if error.is_mismatch() => {
            write_all(stderr(), &format!("mismatch: {error}; nothing was written\n"))?;
            return Ok(Outcome::Mismatch);
        }
        Err(error) => return Err(error.into()),
    };
    for warning in surprises(&rendered.report, scene.remesh.cull) {
        let warning = format!("{}: {warning}", arguments.scene.display());
        write_all(stderr(), &format!("warning: {warning}\n"))?;
        warnings.push(warning);
    }

    let stale = |name: &str| name.starts_with("relief_");
    for (name, folder) in BLOCKS.into_iter().zip(rtl) {
        let block = find(name).ok_or("a block of the pipeline is not in the list")?;
        emission(block, set)?.write(folder.path())?;
        folder.commit(stale)?;
    }
    if let Some(recording) = recording {
        recording.finish()?;
    }
    rendered.report.scene = arguments.scene.display().to_string();
    rendered.report.engine = if engine == Engine::Verilator { "verilator" } else { "rust" };
    rendered.report.width_set = set.name;
    (rendered.report.stalls, rendered.report.seed) = (arguments.stalls, arguments.seed);
    rendered.report.warnings = warnings;
    rendered.report.seconds = begun.elapsed().as_secs_f64();
    let json = serde_json::to_string_pretty(&rendered.report)? + "\n";
    std::io::Write::flush(&mut obj)?;
    mesh.commit()?;
    let contents = [rendered.frame.png()?, rendered.edges.png()?, json.into_bytes()];
    for (mut file, content) in files.into_iter().zip(contents) {
        std::io::Write::write_all(&mut file, &content)?;
        file.commit()?;
    }
    write_all(stdout(), &table(&rendered.report, begun.elapsed().as_secs_f64(), out))?;
    Ok(Outcome::Agreed)
}

/// The scene through the emitted design.
fn design(
    arguments: &Arguments,
    prepared: &Prepared<'_>,
    set: &'static WidthSet,
    warnings: Vec<String>,
    begun: Instant,
) -> Result {
    let out = &arguments.out;
    let _made = MadeFolder::open(out)?;
    let files = [OutputFile::open(&out.join("frame.png"))?, OutputFile::open(&out.join("report.json"))?];
    let meter = Meter::new();
    let rendered = render_by_design(prepared, set, arguments.stalls(), &meter);
    meter.finish();
    let (frame, mut report) = match rendered {
        Ok(rendered) => rendered,
        Err(error) if error.is_mismatch() => {
            write_all(stderr(), &format!("mismatch: {error}; nothing was written\n"))?;
            return Ok(Outcome::Mismatch);
        }
        Err(DesignError::Refused(what)) => return Err(format!("{}: {what}", arguments.scene.display()).into()),
        Err(error) => return Err(error.into()),
    };
    report.scene = arguments.scene.display().to_string();
    report.warnings = warnings;
    report.seconds = begun.elapsed().as_secs_f64();
    let json = serde_json::to_string_pretty(&report)? + "\n";
    for (mut file, content) in files.into_iter().zip([frame.png()?, json.into_bytes()]) {
        std::io::Write::write_all(&mut file, &content)?;
        file.commit()?;
    }
    write_all(stdout(), &design_table(&report, begun.elapsed().as_secs_f64(), out))?;
    Ok(Outcome::Agreed)
}

fn design_table(report: &DesignReport, seconds: f64, out: &Path) -> String {
    let mut text = String::new();
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "{name:26} {value}");
    };
    let sum = |count: fn(&DrawReport) -> u32| report.objects.iter().map(|object| u64::from(count(object))).sum::<u64>();
    let culled = sum(|object| {
        let CulledReport { left, right, top, bottom, near, far } = object.culled;
        left + right + top + bottom + near + far
    });
    let dropped = sum(|object| object.dropped.near + object.dropped.lane + object.dropped.grid);
    let (bases, cut) = (sum(|object| object.base_triangles), sum(|object| object.cut));
    row("base triangles", format!("{bases} ({culled} culled, {cut} cut, {dropped} dropped)"));
    let no_place = report.objects.iter().fold(NoPlaceReport::default(), |all, object| all.and(object.no_place));
    let off = sum(|object| object.off_screen);
    row("triangles", format!("{} ({off} off the screen, {no_place} left out)", report.triangles));
    let skipped = sum(|object| object.skipped);
    row("vertices displaced", format!("{} ({skipped} far off the screen left out)", sum(|object| object.vertices)));
    row("cycles", format!("{} for {} commands", report.cycles, report.commands));
    let busy = sum(|object| object.times.busy);
    let two = if report.triangles == 0 { 0.0 } else { 2.0 * busy as f64 / report.triangles as f64 };
    row("  of them drawing", format!("{busy} ({two:.3} for two triangles)"));
    for (name, count) in [
        ("  piece for remesher", sum(|object| object.times.piece_waits)),
        ("  no step", sum(|object| object.times.no_step)),
        ("  step for room", sum(|object| object.times.step_waits)),
        ("  step for second vertex", sum(|object| object.times.second_vertex_waits)),
        ("  strip unit", sum(|object| object.times.strip_waits)),
        ("  receiver", sum(|object| object.times.receiver_waits)),
    ] {
        row(name, format!("{count} waited"));
    }
    row("pixels", format!("{} ({} fragments)", report.pixels, report.fragments));
    row("width set", report.width_set.to_owned());
    if report.stalls > 0 {
        row("stalls", format!("{} % of the cycles of each stream", report.stalls));
    }
    row("hardware", format!("displacement_pipeline in Verilator, {} beats equal golden", report.beats));
    row("golden models", "levels of the maps, raster".to_owned());
    row("mismatches", report.mismatches.to_string());
    row("time", format!("{seconds:.1} s ({:.1} s simulating)", report.simulation_seconds));
    row("written to", out.display().to_string());
    text
}

/// What only the work could tell.
fn surprises(report: &Report, cull: bool) -> Vec<String> {
    let mut surprises = Vec::new();
    if report.pixels == 0 && report.assembled.kept > 0 {
        surprises.push("no pixel shows anything of it".to_owned());
    }
    let NoPlaceReport { invalid, near, range } = report.no_place;
    let lost = invalid + near;
    if !cull && lost > 0 {
        let what = format!("{lost} triangles reach to the eye or behind it, so the mesh is open there");
        surprises.push(format!("{what}; an `eye` farther away, or less `displacement`, keeps them"));
    }
    if range > 0 {
        let what = format!(
            "{range} triangles reach beyond 8192 pixels, more than X' and Y' of any width set hold, and are left out"
        );
        surprises.push(format!("{what}; an `eye` farther away, or a smaller `viewport`, keeps them"));
    }
    surprises
}

fn table(report: &Report, seconds: f64, out: &Path) -> String {
    let counts = &report.pipeline;
    let assembled = &report.assembled;
    let (culled, cut, dropped) = (assembled.culled.total(), assembled.cut, assembled.dropped.total());
    let mut text = String::new();
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "{name:26} {value}");
    };
    row("base triangles", format!("{} ({culled} culled, {cut} cut, {dropped} dropped)", report.base_triangles));
    row("triangles", format!("{} ({}, {} collapsed)", counts.triangles, report.no_place, report.collapsed_triangles));
    row("vertices displaced", format!("{} ({:.3} a triangle)", counts.vertices, report.vertices_per_triangle));
    let two = report.cycles_per_two_triangles;
    row("cycles", format!("{} ({two:.3} for two triangles)", counts.cycles));
    row("  of them waiting", format!("{} for vertices, {} for set-up", counts.stalled, counts.silent));
    row("cycles to assemble", format!("{} before them", counts.assembly_cycles));
    row("cycles to light", format!("{} behind them, one triangle a cycle", counts.shading_cycles));
    row("cycles to build levels", counts.build_cycles.to_string());
    row("cycles to load them", counts.load_cycles.to_string());
    row("pixels", format!("{} ({} fragments)", report.pixels, report.fragments));
    row("width set", report.width_set.to_owned());
    if report.stalls > 0 {
        row("stalls", format!("{} % of the cycles of each stream", report.stalls));
    }
    for block in &report.hardware {
        let behind = match block.followed_cycles {
            0 => String::new(),
            cycles => format!(", {cycles} cycles in Verilator"),
        };
        row(&format!("hardware: {}", block.name), format!("{} beats equal golden{behind}", block.beats));
    }
    row("golden models", report.golden.join(", "));
    row("mismatches", report.mismatches.to_string());
    row("time", format!("{seconds:.1} s"));
    row("written to", out.display().to_string());
    text
}
