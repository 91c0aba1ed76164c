// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief check-mesh`: is a mesh watertight, and a tiling of its base triangles?

use std::io::{stderr, stdout};
use std::path::PathBuf;

use relief_models::mesh::{self, CheckOptions, Tolerance};

use super::{Meter, Outcome, Result, write_all};

/// Check that a mesh is watertight and tiles its base triangles
///
/// Reads the text format of `scale`, `b` and `t` lines, Wavefront OBJ (.obj), PLY (.ply) and binary glTF (.glb). Vertices are
/// identified by exact coordinates. A mesh without base triangles may be open unless --closed is given: its open edges are counted.
#[derive(clap::Args)]
pub struct Arguments {
    /// The mesh: .obj, .ply, .glb, and text for every other extension
    file: PathBuf,
    /// Base triangles of an OBJ or PLY mesh, whose faces say in groups `base_<I>` or a property `base` whose they are
    #[arg(long, value_name = "FILE")]
    base: Option<PathBuf>,
    /// Take every open edge for a failure
    #[arg(long)]
    closed: bool,
    /// How far a vertex may be from its base edge or plane, and an area from its own, in parts
    #[arg(long, value_name = "LENGTH", default_value = "1/64")]
    tolerance: Tolerance,
    /// Write the report as JSON to stdout, and the lines for people to stderr
    #[arg(long)]
    json: bool,
    /// Tell on stderr how long each phase took
    #[arg(long)]
    timings: bool,
}

/// Reads, checks and reports.
pub fn run(arguments: &Arguments) -> Result {
    let meter = Meter::new();
    let options = CheckOptions { tolerance: arguments.tolerance, closed: arguments.closed };
    let report =
        mesh::read(&arguments.file, arguments.base.as_deref(), &meter).map(|mesh| mesh::check(&mesh, &options, &meter));
    // The bar goes before anything is said.
    let timings = meter.finish();
    let report = report?;
    if arguments.timings {
        write_all(stderr(), &timings)?;
    }
    if arguments.json {
        write_all(stderr(), &report.to_string())?;
        write_all(stdout(), &format!("{}\n", serde_json::to_string_pretty(&report)?))?;
    } else {
        write_all(stdout(), &report.to_string())?;
    }
    Ok(if report.ok { Outcome::Agreed } else { Outcome::Mismatch })
}
