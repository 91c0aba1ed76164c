// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief wagging`: how silhouettes tremble while the camera moves.

use std::fmt::Write as _;
use std::io::{stderr, stdout};
use std::path::PathBuf;

use glam::DVec3;
use relief_hdl::widths::WIDTH_SETS;
use relief_models::draw::DrawError;
use relief_models::rules::ExtremumRule;
use relief_models::scene::{self, Entry};
use relief_models::wagging::{Path, Wagging, WaggingError, measure};
use relief_testbench::remesher::format;
use serde::Serialize;

use super::{Meter, Outcome, Result, write_all};

/// Measure how the silhouette of a scene trembles while the camera moves
///
/// The camera moves along a line, and in each frame the horizon of the displaced mesh, column by column, is compared with
/// that of a mesh of half the smallest cell without a filter. Wagging is the RMS of the change of that difference from
/// frame to frame. Each cell is measured with the levels of maxima, or by the rules that `[remesh]` has, and with plain samples of the map. See docs/stability.md.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene (TOML)
    scene: PathBuf,
    /// Frames of the path
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(2..=1000))]
    frames: u32,
    /// World units that eye and target move in a frame, to the right of the picture; 1/200 of their distance without it
    #[arg(long, value_name = "UNITS", allow_negative_numbers = true, value_parser = units)]
    step: Option<f64>,
    /// Sides of a voxel in pixels
    #[arg(long, value_name = "PX", value_delimiter = ',', default_values_t = [1.0, 2.0, 5.0, 10.0, 20.0], value_parser = cell)]
    cells: Vec<f64>,
    /// Write the figures as JSON
    #[arg(long)]
    json: bool,
}

fn units(text: &str) -> std::result::Result<f64, String> {
    let units = text.parse().ok().filter(|units: &f64| units.is_finite() && units.abs() <= 1e9);
    units.ok_or_else(|| "a number of world units within 1e9 is expected".into())
}

fn cell(text: &str) -> std::result::Result<f64, String> {
    let cell = text.parse().ok().filter(|cell| (1.0..=64.0).contains(cell));
    cell.ok_or_else(|| "a number of pixels from 1 to 64 is expected".into())
}

#[derive(Serialize)]
struct Report {
    version: u32,
    scene: String,
    frames: u32,
    step: [f64; 3],
    rows: Vec<Wagging>,
}

/// Measures and prints.
pub fn run(arguments: &Arguments) -> Result {
    let scene = scene::read(&arguments.scene)?;
    let forward = scene.camera.target - scene.camera.eye;
    let right = forward.cross(scene.camera.up).try_normalize().unwrap_or(DVec3::X);
    let step = arguments.step.unwrap_or(forward.length() / 200.0) * right;
    let path = Path { frames: arguments.frames, step };
    let meter = Meter::new();
    let rows = measure(&scene, &path, &arguments.cells, &format(&WIDTH_SETS[0]), &meter);
    meter.finish();
    let rows = rows.map_err(|error| match &error {
        WaggingError::Draw(_, cause @ (DrawError::Focal { .. } | DrawError::Extent { .. })) => {
            scene.source.error(Entry::Camera, format!("on its path: {cause}"))
        }
        WaggingError::Draw(at, cause) => scene.source.error(Entry::Object(*at), cause),
        WaggingError::Much { .. } => scene.source.whole(error.to_string()),
    })?;
    let beyond = rows.iter().map(|row| row.beyond_grid).max().unwrap_or(0);
    if beyond > 0 {
        let warning = format!("base triangles are left out {beyond} times, because the voxel grid does not reach them");
        let warning = scene.source.error(Entry::Remesh, format!("{warning}; greater `--cells` reach farther"));
        write_all(stderr(), &format!("warning: {warning}\n"))?;
    }
    if rows.iter().all(|row| row.columns == 0) {
        let warning = "no column of the picture has a horizon that can be compared; a `target` on an object shows one";
        write_all(stderr(), &format!("warning: {}\n", scene.source.error(Entry::Camera, warning)))?;
    }
    if arguments.json {
        let scene = arguments.scene.display().to_string();
        let report = Report { version: 1, scene, frames: arguments.frames, step: step.to_array(), rows };
        write_all(stdout(), &(serde_json::to_string_pretty(&report)? + "\n"))?;
        return Ok(Outcome::Agreed);
    }
    let mut text = format!(
        "{} frames; pixels\n{:>6} {:8} {:>10} {:>9} {:>9} {:>9} {:>9}\n",
        arguments.frames, "cell", "filter", "triangles", "wagging", "error", "mean", "jump"
    );
    for row in &rows {
        let filter = match scene.remesh.rules.extremum {
            _ if !row.filtered => "none",
            ExtremumRule::Max => "maximum",
            ExtremumRule::Min => "minimum",
            rule => rule.name(),
        };
        let Wagging { cell_px, triangles, wagging, error, mean, jump, .. } = row;
        let _ = writeln!(
            text,
            "{cell_px:>6} {filter:8} {triangles:>10} {wagging:>9.3} {error:>9.3} {mean:>9.3} {jump:>9.2}"
        );
    }
    write_all(stdout(), &text)?;
    Ok(Outcome::Agreed)
}
