// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief silhouette`: what filters do to the horizon of a height map.

use std::fmt::Write as _;
use std::io::{stderr, stdout};
use std::path::{Path, PathBuf};

use relief_models::map;
use relief_models::silhouette::{Horizon, check};
use relief_testbench::output::OutputFolder;
use serde::Serialize;

use super::{Meter, Outcome, Result, write_all};
use crate::chart::picture::pictures;
use crate::chart::silhouettes::{STEPS, Silhouettes, is_drawing, measure};

/// Compare what filters keep of the horizon of a height map
///
/// Vertices stand so many texels apart and take their heights from each filter's level for that step. Seen from two sides,
/// the horizon of their mesh is compared with that of the map, column by column, for every place of the grid. Errors are
/// shares of the map's range; filters of minima are judged by the horizon from below. Draws the horizons for each step.
/// docs/filters.md tells what the filters are.
#[derive(clap::Args)]
pub struct Arguments {
    /// The map: a grey PNG of up to 4097 x 4097 samples
    map: PathBuf,
    /// Texels from vertex to vertex
    #[arg(long, value_name = "N", value_delimiter = ',', default_values_t = STEPS, value_parser = step)]
    steps: Vec<u32>,
    /// The folder of the drawings, SVG and PNG
    #[arg(long, value_name = "DIR", default_value = "out/silhouette")]
    out: PathBuf,
    /// Write the figures as JSON to stdout, and the lines for people to stderr
    #[arg(long)]
    json: bool,
}

/// Samples of a side of a map.
const MOST_SIDE: u32 = 4097;

fn step(text: &str) -> std::result::Result<u32, String> {
    let step = text.parse().ok().filter(|step| (1..=1024).contains(step));
    step.ok_or_else(|| "a number of texels from 1 to 1024 is expected".into())
}

#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    map: String,
    width: usize,
    height: usize,
    range: [u16; 2],
    steps: Vec<Step<'a>>,
}

#[derive(Serialize)]
struct Step<'a> {
    step: u32,
    filters: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    filter: &'static str,
    #[serde(flatten)]
    horizon: &'a Horizon,
}

/// Reads, measures, draws and prints.
pub fn run(arguments: &Arguments) -> Result {
    let Arguments { map: path, steps, out, json } = arguments;
    let (map, _) = map::read_values(path, MOST_SIDE)?;
    let name = path.file_stem().map_or_else(|| path.display().to_string(), |stem| stem.to_string_lossy().into_owned());
    let of_map = |error| format!("{}: {error}", path.display());
    let mut steps = steps.clone();
    steps.sort_unstable();
    steps.dedup();
    steps.iter().try_for_each(|step| check(&map, *step)).map_err(of_map)?;
    let folder = OutputFolder::open(out)?;
    let meter = Meter::new();
    let all = measure(&name, &map, &steps, &meter);
    meter.finish();
    let all = all.map_err(of_map)?;
    for silhouettes in &all {
        for (name, bytes) in pictures(&silhouettes.file(), silhouettes)? {
            std::fs::write(folder.path().join(name), bytes)
                .map_err(|error| format!("{}: cannot be written: {error}", out.display()))?;
        }
    }
    folder.commit(is_drawing)?;
    let (width, height, range) = (map.width, map.height, map.range());
    let head = format!("map         {width} x {height} samples from {} to {}\n", range[0], range[1]);
    let lines = head + &table(&all, out)?;
    if *json {
        let steps = all.iter().map(|at| Step {
            step: at.step,
            filters: at.rows.iter().map(|(filter, horizon)| Row { filter: filter.name(), horizon }).collect(),
        });
        let report =
            Report { version: 1, map: path.display().to_string(), width, height, range, steps: steps.collect() };
        write_all(stderr(), &lines)?;
        write_all(stdout(), &format!("{}\n", serde_json::to_string_pretty(&report)?))?;
    } else {
        write_all(stdout(), &lines)?;
    }
    Ok(Outcome::Agreed)
}

fn table(all: &[Silhouettes], out: &Path) -> std::result::Result<String, std::fmt::Error> {
    let mut text = String::new();
    for silhouettes in all {
        writeln!(text, "step        {} texels", silhouettes.step)?;
        writeln!(text, "  filter       level  rms, %  mean, %  peak loss, %  deepest, %")?;
        for (filter, horizon) in &silhouettes.rows {
            let Horizon { level, rms, mean, peak_loss, deepest } = horizon;
            let name = filter.name();
            writeln!(text, "  {name:12} {level:5} {rms:7.2} {mean:+8.2} {peak_loss:13.2} {deepest:11.2}")?;
        }
    }
    writeln!(text, "written to  {}", out.display())?;
    Ok(text)
}
