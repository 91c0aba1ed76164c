// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief normals`: which normals of a displaced map are nearest to those of the land.

use std::fmt::Write as _;
use std::io::{stderr, stdout};
use std::path::PathBuf;

use relief_models::map::{self, HeightMap};
use relief_models::mesh::Progress;
use relief_models::mip_build::Wrap;
use relief_models::normals::{Angles, Land, NormalsError, Shading};
use relief_models::silhouette::levels;
use serde::Serialize;

use super::{Meter, Outcome, Result, write_all};

/// Compare the normals of faces and of gradients with those of the land they stand for
///
/// Vertices stand so many texels apart over a flat base and take their heights from the level for that step. What is shaded
/// covers a square of that many texels; the mean normal of the map there is what its normal should be. Prints the root of
/// the mean squared angle between both, in degrees, for the blocks face_normal and gradient_normal on several filters.
/// docs/blocks/gradient_normal.md tells what to make of it.
#[derive(clap::Args)]
pub struct Arguments {
    /// The map: a grey PNG of up to 4097 x 4097 samples
    map: PathBuf,
    /// Texels from vertex to vertex
    #[arg(long, value_name = "N", value_delimiter = ',', default_values_t = [1, 2, 4, 8, 16], value_parser = step)]
    steps: Vec<u32>,
    /// The map's extent along u and v; a texel is 1 if it is left out
    #[arg(long, value_name = "U,V", value_parser = size, allow_hyphen_values = true)]
    size: Option<[f64; 2]>,
    /// Displacements of the least and the greatest height, 0 and 65535; 0 and a 40th of the longer side if they are left out
    #[arg(long, value_name = "LOW,HIGH", value_parser = displacement, allow_hyphen_values = true)]
    displacement: Option<[f64; 2]>,
    /// Write the figures as JSON to stdout, and the lines for people to stderr
    #[arg(long)]
    json: bool,
}

/// Samples of a side of a map.
const MOST_SIDE: usize = 4097;

fn step(text: &str) -> std::result::Result<u32, String> {
    let step = text.parse().ok().filter(|step| (1..=1024).contains(step));
    step.ok_or_else(|| "a number of texels from 1 to 1024 is expected".into())
}

fn pair(text: &str) -> Option<[f64; 2]> {
    let (first, second) = text.split_once(',')?;
    let numbers = [first.trim().parse().ok()?, second.trim().parse().ok()?];
    numbers.iter().all(|number: &f64| number.is_finite()).then_some(numbers)
}

fn size(text: &str) -> std::result::Result<[f64; 2], String> {
    let sound = |size: &[f64; 2]| size.iter().all(|side| (1e-9..=1e9).contains(side));
    pair(text).filter(sound).ok_or_else(|| "two lengths from 1e-9 to 1e9 are expected, such as 29.9,31.9".into())
}

fn displacement(text: &str) -> std::result::Result<[f64; 2], String> {
    pair(text).ok_or_else(|| "two finite numbers are expected, such as 0.236,1.076".into())
}

#[derive(Serialize)]
struct Report {
    version: u32,
    map: String,
    width: usize,
    height: usize,
    size: [f64; 2],
    displacement: [f64; 2],
    steps: Vec<Step>,
}

#[derive(Serialize)]
struct Step {
    step: u32,
    shadings: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    shading: &'static str,
    #[serde(flatten)]
    angles: Angles,
}

/// Reads, measures and prints.
pub fn run(arguments: &Arguments) -> Result {
    let Arguments { map: path, steps, json, .. } = arguments;
    let check = |size: [usize; 2]| {
        let sound = size.iter().all(|side| (2..=MOST_SIDE).contains(side));
        if sound { Ok(()) } else { Err(format!("has to have 2 x 2 to {MOST_SIDE} x {MOST_SIDE}")) }
    };
    let (map, warning) = map::read(path, &check)?;
    let of_map = |error| format!("{}: {error}", path.display());
    let mut steps = steps.clone();
    steps.sort_unstable();
    steps.dedup();
    steps.iter().try_for_each(|step| Land::check(&map, *step)).map_err(of_map)?;
    let size = arguments.size.unwrap_or([map.width, map.height].map(|side| (side - 1) as f64));
    let displacement = arguments.displacement.unwrap_or([0.0, size[0].max(size[1]) / 40.0]);
    let land = Land::new(&map, size, displacement[1] - displacement[0]).map_err(of_map)?;
    if let Some(warning) = warning {
        write_all(stderr(), &format!("warning: {}: {warning}\n", path.display()))?;
    }
    let meter = Meter::new();
    let steps = measure(&map, &land, &steps, &meter);
    meter.finish();
    let steps = steps.map_err(of_map)?;
    let HeightMap { width, height, .. } = map;
    let report = Report { version: 1, map: path.display().to_string(), width, height, size, displacement, steps };
    let lines = table(&report)?;
    if *json {
        write_all(stderr(), &lines)?;
        write_all(stdout(), &format!("{}\n", serde_json::to_string_pretty(&report)?))?;
    } else {
        write_all(stdout(), &lines)?;
    }
    Ok(Outcome::Agreed)
}

fn measure(
    map: &HeightMap,
    land: &Land<'_>,
    steps: &[u32],
    meter: &Meter,
) -> std::result::Result<Vec<Step>, NormalsError> {
    let wrap = [Wrap::Clamp; 2];
    let most = levels(map, wrap, steps.last().copied().unwrap_or(1));
    let mut all: Vec<Step> = steps.iter().map(|step| Step { step: *step, shadings: Vec::new() }).collect();
    meter.phase("measuring", (Shading::ALL.len() * steps.len()) as u64);
    for (done, shading) in Shading::ALL.into_iter().enumerate() {
        let pyramid = shading.filter().pyramid(map, wrap, most)?;
        for (at, step) in all.iter_mut().enumerate() {
            let angles = land.angles(shading, &pyramid, step.step)?;
            step.shadings.push(Row { shading: shading.name(), angles });
            meter.advance((done * steps.len() + at + 1) as u64);
        }
    }
    Ok(all)
}

fn table(report: &Report) -> std::result::Result<String, std::fmt::Error> {
    let Report { width, height, size, displacement: [low, high], .. } = report;
    let mut text = String::new();
    writeln!(text, "map         {width} x {height} samples over {} x {}, displaced {low} to {high}", size[0], size[1])?;
    write!(text, "rms angle, degrees\n  step")?;
    Shading::ALL.iter().try_for_each(|shading| write!(text, "  {:>16}", shading.name()))?;
    writeln!(text)?;
    for Step { step, shadings } in &report.steps {
        write!(text, "  {step:4}")?;
        shadings.iter().try_for_each(|row| write!(text, "  {:16.2}", row.angles.rms))?;
        writeln!(text)?;
    }
    Ok(text)
}
