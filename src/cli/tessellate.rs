// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief tessellate`: a mesh of a height map, or of the maps of a scene on their base meshes.

use std::io::{BufWriter, Write, stderr, stdout};
use std::path::{Path, PathBuf};

use relief_models::bake::{Baked, Tolerance};
use relief_models::bisector::MAX_SIDE;
use relief_models::map::{HeightMap, read_values};
use relief_models::mesh::{Format, TriangleMesh};
use relief_models::vertex_cache::ENTRIES;
use relief_testbench::method::{self, Bisector, Borders, Goal, Growing, METHODS, Measured, Memories, Tessellation};
use relief_testbench::output::OutputFile;

use super::engine::EngineName;
use super::{Meter, Outcome, Result, write_all};

mod scene;

/// Tessellate a height map, a prepared map, or a scene
///
/// A map is a grey PNG; its mesh stands in sample coordinates: x is the column, y the row, z the value of the map, and
/// the bound is in units of the map. A folder that `relief bake` has written is drawn as it is, or with --bound from its
/// errors. In a scene (.toml) each object's map is tessellated and laid over its base mesh; mesh and bound are in world
/// units. Every mesh is measured at every sample, and one that breaks its method's claim is not written. All engines write
/// the same bytes.
#[derive(clap::Args)]
pub struct Arguments {
    /// A map (.png), a scene (.toml), or a folder written by `relief bake`
    input: PathBuf,
    /// How; docs/tessellate.md compares them [default: bisector; of a prepared map, what it was prepared for]
    #[arg(long, value_parser = methods())]
    method: Option<String>,
    /// The largest error: map units (20, 16.8 or 50/3), in a scene world units
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    bound: Option<String>,
    /// As small an error as so many triangles allow
    #[arg(long, value_name = "N", value_parser = super::count, conflicts_with = "bound", allow_negative_numbers = true)]
    triangles: Option<u64>,
    /// The bound grows by so many map units a sample with the distance from the eye; for bisector-interpolated
    #[arg(long, value_name = "SLOPE", requires = "eye", conflicts_with = "triangles", value_parser = slope, allow_negative_numbers = true)]
    slope: Option<f64>,
    /// Column and row of the eye
    #[arg(long, value_name = "U,V", requires = "slope", value_parser = eye, allow_negative_numbers = true)]
    eye: Option<[u32; 2]>,
    /// How long to search for a smaller fitted mesh: quick, default, high, or a number of rounds
    #[arg(long, value_name = "EFFORT", default_value = "default", value_parser = super::bake::effort)]
    effort: u32,
    /// What computes the mesh
    #[arg(long, value_enum, default_value_t = EngineName::Golden)]
    engine: EngineName,
    /// The mesh: .obj, .ply or .glb. The file appears whole or not at all
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

fn methods() -> clap::builder::PossibleValuesParser {
    METHODS.iter().map(|method| clap::builder::PossibleValue::new(method.name()).help(method.summary())).into()
}

fn slope(text: &str) -> std::result::Result<f64, String> {
    let sound = |slope: &f64| (0.0..=65535.0).contains(slope);
    text.parse().ok().filter(sound).ok_or_else(|| "map units a sample, from 0 to 65535, are expected".into())
}

fn eye(text: &str) -> std::result::Result<[u32; 2], String> {
    let number = |text: &str| text.parse().ok().filter(|at: &u32| *at < MAX_SIDE);
    let pair = text.split_once(',').and_then(|(u, v)| Some([number(u)?, number(v)?]));
    pair.ok_or_else(|| format!("a column and a row from 0 to {}, such as 200,150, are expected", MAX_SIDE - 1))
}

/// What a tessellation came to, and what is to be said of it.
struct Made {
    mesh: TriangleMesh,
    text: String,
    broken: bool,
}

type Worked<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Reads, tessellates, measures and writes.
pub fn run(arguments: &Arguments) -> Result {
    let format = Format::of(&arguments.out);
    if format == Format::Text {
        return Err(format!("{}: a mesh goes into .obj, .ply or .glb", arguments.out.display()).into());
    }
    let out = OutputFile::open(&arguments.out)?;
    let meter = Meter::new();
    let made = make(arguments, &meter);
    meter.finish();
    let made = match made {
        Ok(made) => made,
        Err(error) if error.downcast_ref::<method::MethodError>().is_some_and(method::MethodError::is_mismatch) => {
            write_all(stderr(), &format!("mismatch: {error}; nothing was written\n"))?;
            return Ok(Outcome::Mismatch);
        }
        Err(error) => return Err(error),
    };
    write_all(stdout(), &made.text)?;
    if made.broken {
        write_all(stderr(), "mismatch: the mesh is not what its method claims; nothing was written\n")?;
        return Ok(Outcome::Mismatch);
    }
    let mut target = BufWriter::new(out.writer()?);
    let name = arguments.out.display();
    made.mesh.write(format, &mut target).map_err(|error| format!("{name}: {error}"))?;
    target.flush().map_err(|error| format!("{name}: cannot be written: {error}"))?;
    drop(target);
    out.commit()?;
    write_all(stdout(), &line("written to", &arguments.out.display().to_string()))?;
    Ok(Outcome::Agreed)
}

impl Arguments {
    /// The mesh of a map for a goal.
    fn tessellate(&self, map: &HeightMap, borders: Borders, goal: Goal, meter: &Meter) -> Worked<Tessellation> {
        let engine = self.engine.resolve()?;
        // Only this one searches.
        let fitted = Bisector { effort: Some(self.effort) };
        let method = method::find(self.method()).ok_or("no such method")?;
        let method = if method.name() == method::Method::name(&fitted) { &fitted } else { method };
        Ok(method.tessellate_within(map, borders, goal, engine, meter)?)
    }

    fn method(&self) -> &str {
        self.method.as_deref().unwrap_or("bisector")
    }

    fn growing(&self, base: Tolerance) -> Option<Growing> {
        let base = base.value();
        self.slope.zip(self.eye).map(|(slope, eye)| Growing { base, slope, eye })
    }
}

fn make(arguments: &Arguments, meter: &Meter) -> Worked<Made> {
    let input = &arguments.input;
    if input.is_dir() {
        return baked(arguments, meter);
    }
    if input.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml")) {
        return scene::make(arguments, meter);
    }
    let (map, bits) = read_values(input, MAX_SIDE)?;
    if bits < 16 {
        let most = (1u32 << bits) - 1;
        let note = format!("note: {} has {bits} bits a sample: z is from 0 to {most}\n", input.display());
        write_all(stderr(), &note)?;
    }
    let goal = match (&arguments.bound, arguments.triangles) {
        (Some(bound), _) => Goal::Bound(bound.parse()?),
        (None, Some(triangles)) => Goal::Triangles(triangles),
        (None, None) => return Err("a goal is expected: --bound E, in map units, or --triangles N".into()),
    };
    let named = |error: Box<dyn std::error::Error>| -> Box<dyn std::error::Error> {
        if error.downcast_ref::<method::MethodError>().is_some_and(method::MethodError::is_mismatch) {
            return error;
        }
        format!("{}: {error}", input.display()).into()
    };
    let tessellation = match goal {
        Goal::Bound(bound) if arguments.slope.is_some() => {
            if arguments.method() != "bisector-interpolated" {
                return Err(
                    "--slope and --eye are for --method bisector-interpolated: fitted heights serve one bound".into()
                );
            }
            let engine = arguments.engine.resolve()?;
            let growing = arguments.growing(bound).ok_or("--slope and --eye belong together")?;
            let begun = std::time::Instant::now();
            let memories = Bisector::growing(&map, growing, meter).map_err(|error| named(error.into()))?;
            memories.tessellate(engine, begun.elapsed().as_secs_f64(), meter).map_err(|error| named(error.into()))?
        }
        _ => arguments.tessellate(&map, Borders::CLAMP, goal, meter).map_err(named)?,
    };
    measured(arguments.method(), &map, tessellation, meter)
}

/// The mesh of a folder that has been prepared.
fn baked(arguments: &Arguments, meter: &Meter) -> Worked<Made> {
    if arguments.triangles.is_some() {
        return Err(
            "--triangles is for maps and scenes; a prepared map takes --bound, or nothing for its split map".into()
        );
    }
    let bound = arguments.bound.as_ref().map(|bound| bound.parse::<Tolerance>()).transpose()?;
    let engine = arguments.engine.resolve()?;
    let baked = Baked::read(&arguments.input)?;
    let map = baked.map.clone();
    // Fitted heights are those of a split map; its errors are of the map's own.
    let fitted = bound.is_none() && baked.manifest.split.as_ref().is_some_and(|split| split.fitted);
    let method = if fitted { "bisector" } else { "bisector-interpolated" };
    if let Some(wanted) = arguments.method.as_deref().filter(|wanted| *wanted != method) {
        let what = format!("{}: is a map prepared for {method}, and {wanted} is asked for", arguments.input.display());
        return Err(format!("{what}; the map itself serves every method").into());
    }
    if arguments.slope.is_some() && bound.is_none() {
        return Err("--slope and --eye belong to a --bound".into());
    }
    let growing = bound.map(|bound| {
        let base = bound.value();
        arguments.growing(bound).unwrap_or(Growing { base, slope: 0.0, eye: [0; 2] })
    });
    let memories =
        Memories::of_baked(baked, growing).map_err(|error| format!("{}: {error}", arguments.input.display()))?;
    let tessellation = memories.tessellate(engine, 0.0, meter)?;
    measured(method, &map, tessellation, meter)
}

fn measured(method: &str, map: &HeightMap, made: Tessellation, meter: &Meter) -> Worked<Made> {
    let measured = made.measure(map, meter)?;
    let mut text = line("map", &format!("{} x {} samples", map.width, map.height));
    text += &line("method", method);
    text += &table(&made, &measured, 1.0);
    Ok(Made { mesh: made.mesh, text, broken: measured.verdict == method::Verdict::Broken })
}

fn line(name: &str, value: &str) -> String {
    format!("{name:<24}{value}\n")
}

/// What one mesh came to; a map unit is `unit` of the units that are printed.
fn table(made: &Tessellation, measured: &Measured, unit: f64) -> String {
    let Measured { heights, verdict, cache_misses } = measured;
    let triangles = made.mesh.triangles.len() as f64;
    let mut text = line("triangles", &made.mesh.triangles.len().to_string());
    text += &line("vertices", &made.mesh.positions.len().to_string());
    text += &line(
        "claimed error",
        &match (made.claim, verdict) {
            (None, _) => "none".into(),
            (Some(claim), method::Verdict::Holds { slack }) => {
                // A bound that grows is claimed sample by sample; this is the most of it.
                let most = if made.growing.is_some() { "up to " } else { "" };
                format!("{most}{} holds, with a slack of {}", figure(claim * unit), figure(slack * unit))
            }
            (Some(claim), _) => format!("{} is BROKEN", figure(claim * unit)),
        },
    );
    text += &line("max error", &figure(heights.max * unit));
    text += &line("rms error", &figure(heights.rms.unwrap_or(f64::NAN) * unit));
    if let Some(hardware) = &made.hardware {
        let each = |count: u64| format!("{count} ({:.3} a triangle)", count as f64 / triangles);
        text += &line("cycles", &each(hardware.cycles));
        text += &line("memory reads", &each(hardware.reads));
        text += &line("memory bits", &hardware.memory_bits.to_string());
    }
    let misses =
        format!("{:.3} a triangle, of {ENTRIES} entries, first in, first out", *cache_misses as f64 / triangles);
    text += &line("vertex cache misses", &misses);
    text += &line("preparation", &format!("{:.3} s", made.preparation_seconds));
    let rate = triangles / made.golden_seconds.max(1e-9) / 1e6;
    text + &line("golden model", &format!("{:.6} s ({rate:.1} million triangles a second)", made.golden_seconds))
}

/// Six significant digits.
fn figure(value: f64) -> String {
    let digits = if value == 0.0 { 1 } else { (5 - value.abs().log10().floor() as i32).clamp(0, 9) as usize };
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// How messages call a file.
fn name_of(path: &Path) -> String {
    path.display().to_string()
}
