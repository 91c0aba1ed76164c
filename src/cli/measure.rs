// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief measure`: how far is a mesh from a height map, or from another mesh?

use std::fmt::Write;
use std::io::{stderr, stdout};
use std::path::{Path, PathBuf};

use relief_models::map::{self, HeightMap};
use relief_models::measure::{self, Amount, Heights, OneWay, Sampling, Side, Surface};
use relief_models::mesh::{Progress, TriangleMesh};
use serde::Serialize;

use super::{Meter, Outcome, Result, write_all};

/// Measure how far a mesh is from a height map or another mesh
///
/// Against a map (.png, grey) the mesh has to stand in sample coordinates: x is the column, y the row, z the value of the
/// map. The vertical error is measured at every sample, and the cover is checked. With --samples or --samples-per-area
/// the distance of the two surfaces is measured too, in the same coordinates.
///
/// Against a mesh (.obj, .ply, .glb) the distance of the two surfaces is measured both ways, from points strewn over each
/// of them uniformly by area. The maximum takes the vertices in as well.
#[derive(clap::Args)]
pub struct Arguments {
    /// The mesh: .obj, .ply or .glb
    mesh: PathBuf,
    /// What it is measured against: a map (.png) or a mesh (.obj, .ply or .glb)
    #[arg(long, value_name = "FILE")]
    against: PathBuf,
    /// Points on each surface; 1000000 against a mesh
    #[arg(long, value_name = "N", value_parser = super::count, conflicts_with = "samples_per_area")]
    samples: Option<u64>,
    /// Points on a unit of area
    #[arg(long, value_name = "DENSITY", value_parser = amount)]
    samples_per_area: Option<f64>,
    /// Seed of the points
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = super::count)]
    seed: u64,
    /// Fail if an error at a sample is above this, or the map is not covered; against a mesh, if a distance is above it
    #[arg(long, value_name = "ERROR", value_parser = amount)]
    bound: Option<f64>,
    /// Write the figures as JSON to stdout, and the lines for people to stderr
    #[arg(long)]
    json: bool,
}

/// Points on each surface where nothing else is said.
const SAMPLES: u64 = 1_000_000;
/// Samples of a side of a map.
const MOST_SIDE: u32 = 16_384;

/// What is written as JSON.
#[derive(Serialize)]
struct Report {
    version: u32,
    mesh: String,
    against: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    heights: Option<Heights>,
    #[serde(skip_serializing_if = "Option::is_none")]
    surface: Option<Surface>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bound: Option<Bound>,
}

#[derive(Serialize)]
struct Bound {
    bound: f64,
    holds: bool,
}

/// Reads, measures and reports.
pub fn run(arguments: &Arguments) -> Result {
    let meter = Meter::new();
    let measured = measure(arguments, &meter);
    // The bar goes before anything is said.
    meter.finish();
    let (report, notes) = measured?;
    write_all(stderr(), &notes)?;
    let lines = describe(&report)?;
    if arguments.json {
        write_all(stderr(), &lines)?;
        write_all(stdout(), &format!("{}\n", serde_json::to_string_pretty(&report)?))?;
    } else {
        write_all(stdout(), &lines)?;
    }
    let broken = report.bound.is_some_and(|bound| !bound.holds);
    Ok(if broken { Outcome::Mismatch } else { Outcome::Agreed })
}

/// What was measured, and what is to be said about the files.
fn measure(arguments: &Arguments, meter: &Meter) -> std::result::Result<(Report, String), Box<dyn std::error::Error>> {
    let Arguments { mesh: path, against, samples, samples_per_area, seed, .. } = arguments;
    // The map's mistakes are told before a large mesh is read.
    let map = is_map(against).then(|| map::read_values(against, MOST_SIDE)).transpose()?;
    let mesh = TriangleMesh::read(path, meter)?;
    let amount = match (samples, samples_per_area) {
        (Some(samples), _) => Some(Amount::Samples(*samples)),
        (None, Some(density)) => Some(Amount::PerArea(*density)),
        (None, None) => None,
    };
    let surface = |other: Side<'_>, amount: Amount| {
        measure::surface(Side::Mesh(&mesh), other, Sampling { amount, seed: *seed }, meter as &dyn Progress)
    };
    let name = path.display();
    let place = |error| format!("{name} against {}: {error}", against.display());
    let (heights, surface, notes) = match map {
        Some((map, bits)) => {
            let heights = measure::heights(&mesh, &map, meter).map_err(place)?;
            let distances = amount.map(|amount| surface(Side::Map(&map), amount)).transpose().map_err(place)?;
            (Some(heights), distances, notes(arguments, &mesh, &map, bits))
        }
        None => {
            let other = TriangleMesh::read(against, meter)?;
            let amount = amount.unwrap_or(Amount::Samples(SAMPLES));
            (None, Some(surface(Side::Mesh(&other), amount).map_err(place)?), String::new())
        }
    };
    let holds = |bound: f64| match (&heights, &surface) {
        (Some(heights), _) => heights.holds(bound),
        (None, surface) => surface.as_ref().is_some_and(|surface| surface.both.max <= bound),
    };
    let bound = arguments.bound.map(|bound| Bound { bound, holds: holds(bound) });
    let (mesh, against) = (name.to_string(), against.display().to_string());
    Ok((Report { version: 1, mesh, against, heights, surface, bound }, notes))
}

fn is_map(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
}

/// What people should know of the files though it is no mistake.
fn notes(arguments: &Arguments, mesh: &TriangleMesh, map: &HeightMap, bits: u8) -> String {
    let mut text = String::new();
    if bits < 16 {
        let most = (1u32 << bits) - 1;
        text += &format!("note: {} has {bits} bits a sample: z is from 0 to {most}\n", arguments.against.display());
    }
    let bounds = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
    };
    let [low, high] = bounds(&mut mesh.triangles.iter().flatten().map(|vertex| mesh.positions[*vertex as usize][2]));
    let [least, most] = bounds(&mut map.samples.iter().map(|sample| f64::from(*sample)));
    if high < least || low > most {
        let what = "z has to be in values of the map";
        text += &format!("note: z runs from {low} to {high}, and the map from {least} to {most}; {what}\n");
    }
    text
}

fn describe(report: &Report) -> std::result::Result<String, std::fmt::Error> {
    let mut text = String::new();
    if let Some(heights) = &report.heights {
        describe_heights(&mut text, heights)?;
    }
    if let Some(surface) = &report.surface {
        describe_surface(&mut text, surface)?;
    }
    if let Some(Bound { bound, holds }) = report.bound {
        writeln!(text, "{:<24}{bound} {}", "bound", if holds { "holds" } else { "is BROKEN" })?;
    }
    Ok(text)
}

fn describe_heights(text: &mut String, heights: &Heights) -> std::fmt::Result {
    let [least, most] = heights.range.map(f64::from);
    // A map of one height has no range; its errors are shares of one step.
    let share = |error: f64| 100.0 * error / (most - least).max(1.0);
    let mut line = |name: &str, value: String| writeln!(text, "{name:<24}{value}");
    line("map", format!("{} x {} samples, {least} to {most}", heights.size[0], heights.size[1]))?;
    line("mesh", format!("{} triangles, {} vertices", heights.triangles, heights.vertices))?;
    let at = heights.max_at.map_or(String::new(), |[i, j]| format!(" at column {i}, row {j}"));
    line("max error", format!("{:.4}{at} ({:.3} % of the range)", heights.max, share(heights.max)))?;
    if let (Some(mean), Some(rms)) = (heights.mean, heights.rms) {
        line("mean error", format!("{mean:.4} ({:.4} %)", share(mean)))?;
        line("rms error", format!("{rms:.4} ({:.4} %)", share(rms)))?;
    }
    let Heights { volume_signed, volume_absolute, map_volume, .. } = heights;
    line("volume between", format!("{volume_absolute:.1}, signed {volume_signed:.1}, of {map_volume:.1}"))?;
    line("samples", format!("{} uncovered, {} with several heights", heights.uncovered, heights.several_heights))?;
    let Heights { open_edges, nonmanifold_edges, inconsistent_edges, .. } = heights;
    let edges = format!("{nonmanifold_edges} of more than two triangles, {inconsistent_edges} walked twice alike");
    line("edges", format!("{open_edges} open inside the map, {edges}"))?;
    line("triangles", format!("{} folded, {} without area", heights.folded, heights.degenerate))?;
    line("vertices", format!("{} off the lattice", heights.off_lattice))
}

fn describe_surface(text: &mut String, surface: &Surface) -> std::fmt::Result {
    let Surface { seed, forward, backward, both } = surface;
    writeln!(text, "{:<24}{:>16}{:>16}{:>16}", "surface distance", "from the mesh", "to the mesh", "both")?;
    let mut row = |name: &str, value: &dyn Fn(&OneWay) -> String, both: String| {
        writeln!(text, "{}", format!("{name:<24}{:>16}{:>16}{both:>16}", value(forward), value(backward)).trim_end())
    };
    row("triangles", &|side| side.triangles.to_string(), String::new())?;
    row("area", &|side| figure(side.area), figure(forward.area + backward.area))?;
    row("points", &|side| side.samples.to_string(), (forward.samples + backward.samples).to_string())?;
    row("points a unit of area", &|side| figure(side.density), String::new())?;
    row("max", &|side| figure(side.max), figure(both.max))?;
    row("mean", &|side| figure(side.mean), figure(both.mean))?;
    row("rms", &|side| figure(side.rms), figure(both.rms))?;
    writeln!(text, "{:<24}{seed}", "seed")
}

/// Seven significant digits.
fn figure(value: f64) -> String {
    if value == 0.0 || (1e-3..1e9).contains(&value) {
        let digits = if value == 0.0 { 6 } else { (6 - value.log10().floor() as i32).clamp(0, 9) as usize };
        format!("{value:.digits$}")
    } else {
        format!("{value:.6e}")
    }
}

/// A finite number of an option that is not negative.
fn amount(text: &str) -> std::result::Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
    number.ok_or_else(|| "a finite number from 0 on is expected".to_owned())
}
