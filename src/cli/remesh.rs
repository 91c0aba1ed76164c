// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief remesh`: a grid of base triangles into one-voxel triangles.

use std::io::{self, stderr};
use std::path::PathBuf;

use relief_testbench::remesh::{self, Counts, RemeshError};

use super::output::Output;
use super::{Meter, Outcome, Result, write_all};

/// Remesh base triangles with integer corners into one-voxel triangles
///
/// Reads lines `b I x y z x y z x y z`: the corners of base triangle I in winding order, integers from -8192 to 8191;
/// `#` starts a comment. Writes the text format of check-mesh: `scale`, the `b` lines, and a line
/// `t I x y z x y z x y z` for every triangle, integers over the scale, in the order in which the hardware sends them.
/// All engines write the same bytes.
#[derive(clap::Args)]
pub struct Arguments {
    /// The base triangles
    #[arg(long, value_name = "FILE")]
    grid: PathBuf,
    /// What computes the triangles
    #[arg(long, value_enum, default_value_t = Engine::Golden)]
    engine: Engine,
    /// The mesh; stdout without it. The file appears whole or not at all
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Tell on stderr what it took: cycles, cycles for two triangles, vertices sent for a triangle
    #[arg(long)]
    stats: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Engine {
    /// The golden models
    Golden,
    /// The remesher and the strip unit, simulated in Rust
    Rust,
    /// Their Verilog in Verilator, compared with Rust cycle by cycle
    Verilator,
}

impl From<Engine> for remesh::Engine {
    fn from(engine: Engine) -> remesh::Engine {
        match engine {
            Engine::Golden => remesh::Engine::Golden,
            Engine::Rust => remesh::Engine::Rust,
            Engine::Verilator => remesh::Engine::Verilator,
        }
    }
}

/// Reads, remeshes and writes.
pub fn run(arguments: &Arguments) -> Result {
    let grid = remesh::read_grid(&arguments.grid)?;
    let mut output = Output::open(arguments.out.as_deref())?;
    let meter = Meter::new();
    let written = remesh::write_mesh(arguments.engine.into(), &grid, &meter, &mut output);
    // The bar goes before anything is said.
    meter.finish();
    let counts = match written {
        Ok(counts) => counts,
        // The reader has what it wanted.
        Err(RemeshError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => return Ok(Outcome::Agreed),
        Err(error) if error.is_mismatch() => {
            write_all(stderr(), &format!("mismatch: {error}\n"))?;
            return Ok(Outcome::Mismatch);
        }
        Err(error) => return Err(error.into()),
    };
    output.commit().map_err(RemeshError::Output)?;
    if arguments.stats {
        write_all(stderr(), &stats(&counts))?;
    }
    Ok(Outcome::Agreed)
}

fn stats(counts: &Counts) -> String {
    let Counts { bases, triangles, sent, cycles, .. } = counts;
    let mut text = format!("{bases} base triangles, {triangles} triangles\n");
    text += &format!("{:.4} vertices sent per triangle ({sent})\n", counts.sent_per_triangle());
    if *cycles > 0 {
        text += &format!("{:.4} cycles per two triangles ({cycles})\n", counts.cycles_per_two_triangles());
    }
    text
}
