// SPDX-License-Identifier: MIT OR Apache-2.0
//! Remeshes a grid, a list of base triangles with integer corners, through one of three engines: the golden models, the
//! blocks in Rust, or the emitted Verilog.
//!
//! The positions travel as vertex data. The width set is `position`: three components of V = 32 bits and grid
//! coordinates of N = 14 bits, so that a coordinate takes V - N - 1 = 17 fraction bits along and still has a spare bit:
//!
//! ```text
//! vertex data = coordinate * 2^17       -8192..=8191 becomes -2^30..=2^30 - 2^17
//! ```
//!
//! The emitted triangles are integers over that [`SCALE`], as the text format of [`relief_models::mesh`] has them, and
//! their order and every bit are the same from each engine.
//!
//! | engine      | what runs                                                                                     |
//! |-------------|-----------------------------------------------------------------------------------------------|
//! | `Golden`    | `models::remesher`, and `models::strip_unit` behind it                                        |
//! | `Rust`      | the two blocks, stepped side by side ([`Chain`])                                              |
//! | `Verilator` | the emitted modules, on the inputs of the Rust blocks; every output of a cycle is compared     |

mod chain;
mod grid;
mod verilog;

pub use chain::{Chain, Counts, TrianglePorts};
pub use grid::{GridTriangle, parse_grid, read_grid};

use crate::binding::Beat;
use crate::cosim::CosimError;
use crate::remesher::{beat_of, format};
use crate::replay::ReplayError;
use relief_hdl::widths::{WidthSet, position};
use relief_models::mesh::Progress;
use relief_models::remesher::{BaseTriangle, Setup, golden};
use relief_models::step::MAX_COMPONENTS;
use relief_models::strip_unit::StripUnit;
use std::io::{self, Write};

/// The widths that positions travel in.
pub const SET: WidthSet = position::SET;

/// Fraction bits of an emitted coordinate: one bit of the vertex stays spare for the sign of a difference.
const SCALE_BITS: usize = SET.vertex_bits - SET.coordinate_bits - 1;

/// Emitted coordinates are integers over this.
pub const SCALE: i64 = 1 << SCALE_BITS;

/// What remeshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// The golden models.
    Golden,
    /// The hardware, simulated in Rust.
    Rust,
    /// The emitted Verilog in Verilator.
    Verilator,
}

/// A triangle in winding order, its coordinates over [`SCALE`].
pub type Triangle = [[i64; 3]; 3];

/// Takes the number of a base triangle and a triangle of it. An error ends the run.
pub type Sink<'a> = dyn FnMut(u32, &Triangle) -> io::Result<()> + 'a;

/// Why a grid was not remeshed.
#[derive(Debug, thiserror::Error)]
pub enum RemeshError {
    /// The sink takes no more.
    #[error("the mesh cannot be written: {0}")]
    Output(#[from] io::Error),
    /// The emitted modules cannot be run, or do not follow.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// No folder for the emitted modules.
    #[error(transparent)]
    Cosim(#[from] CosimError),
    /// A block is at fault: it does not answer.
    #[error("the hardware hangs: no handshake for {patience} cycles up to cycle {cycle}")]
    Hangs {
        /// The cycle, counted from the reset.
        cycle: u64,
        /// How long nothing happened.
        patience: u64,
    },
    /// A block is at fault: the strip unit's `error` rises.
    #[error("the strip unit reports a misuse of its column memory in cycle {cycle}")]
    ColumnMemory {
        /// The cycle, counted from the reset.
        cycle: u64,
    },
}

impl RemeshError {
    /// Whether the hardware is wrong, rather than the input or the surroundings.
    pub const fn is_mismatch(&self) -> bool {
        matches!(self, Self::Hangs { .. } | Self::ColumnMemory { .. } | Self::Replay(ReplayError::Differs { .. }))
    }
}

/// The base triangle of a grid triangle: its corners, and as vertex data their positions over [`SCALE`].
pub fn base_of(triangle: &GridTriangle) -> BaseTriangle {
    let data = triangle.corners.map(|corner| {
        let mut vertex = [0; MAX_COMPONENTS];
        // 14 bits and 17 more: 31 of the 32.
        vertex.iter_mut().zip(corner).for_each(|(to, coordinate)| *to = i64::from(coordinate) << SCALE_BITS);
        vertex
    });
    BaseTriangle { corners: triangle.corners, data }
}

/// The input beat of a grid triangle.
fn input_of(triangle: &GridTriangle) -> Beat {
    beat_of(&SET, &base_of(triangle))
}

/// Sends the triangles of all base triangles of `grid` to `sink`, in order.
///
/// # Errors
/// What the sink says, or why the engine cannot run or is at fault.
pub fn remesh(
    engine: Engine,
    grid: &[GridTriangle],
    progress: &dyn Progress,
    sink: &mut Sink<'_>,
) -> Result<Counts, RemeshError> {
    let mut meter = Metered { sink, progress, done: 0, within: 0, weight: 0 };
    let total = |progress: &dyn Progress| progress.phase("remeshing", grid.iter().map(weight).sum());
    match engine {
        Engine::Golden => {
            total(progress);
            run_golden(grid, &mut meter)
        }
        Engine::Rust => {
            total(progress);
            run_rust(grid, &mut meter)
        }
        Engine::Verilator => {
            progress.phase("building", 0);
            let mut replay = verilog::Followed::build()?;
            total(progress);
            replay.run(grid, &mut meter)
        }
    }
}

/// Writes `grid` and its triangles in the text format of [`relief_models::mesh`]: `scale`, `b` lines and `t` lines.
///
/// # Errors
/// As [`remesh`].
pub fn write_mesh(
    engine: Engine,
    grid: &[GridTriangle],
    progress: &dyn Progress,
    out: &mut dyn Write,
) -> Result<Counts, RemeshError> {
    writeln!(out, "scale {SCALE}")?;
    let mut line = Vec::with_capacity(128);
    let mut write = |kind: &str, base: u32, corners: &Triangle| -> io::Result<()> {
        line.clear();
        write!(line, "{kind} {base}")?;
        for [x, y, z] in corners {
            write!(line, " {x} {y} {z}")?;
        }
        line.push(b'\n');
        out.write_all(&line)
    };
    for triangle in grid {
        write("b", triangle.number, &triangle.corners.map(|corner| corner.map(i64::from)))?;
    }
    let counts = remesh(engine, grid, progress, &mut |base, triangle| write("t", base, triangle))?;
    out.flush()?;
    Ok(counts)
}

/// About how many triangles a base triangle makes, by its area and its edges; at least one.
fn weight(triangle: &GridTriangle) -> u64 {
    let setup = Setup::new(&format(&SET), &base_of(triangle));
    setup.double_area.unsigned_abs() + setup.edges.iter().map(|edge| u64::from(edge.segments)).sum::<u64>() + 1
}

/// The sink, with the progress counted beside it.
struct Metered<'a, 'b> {
    sink: &'a mut Sink<'b>,
    progress: &'a dyn Progress,
    /// Weights of the base triangles that are done.
    done: u64,
    /// Triangles of the present one, and its weight.
    within: u64,
    weight: u64,
}

impl Metered<'_, '_> {
    fn begin(&mut self, triangle: &GridTriangle) {
        self.weight = weight(triangle);
        self.within = 0;
    }
    fn triangle(&mut self, base: u32, triangle: &Triangle) -> io::Result<()> {
        (self.sink)(base, triangle)?;
        self.within += 1;
        if self.within.is_multiple_of(4096) {
            self.progress.advance(self.done + self.within.min(self.weight));
        }
        Ok(())
    }
    fn end(&mut self) {
        self.done += self.weight;
        self.progress.advance(self.done);
    }
}

fn run_golden(grid: &[GridTriangle], sink: &mut Metered<'_, '_>) -> Result<Counts, RemeshError> {
    let format = format(&SET);
    let mut unit = StripUnit::new(SET.column_depth);
    let mut counts = Counts::default();
    for triangle in grid {
        sink.begin(triangle);
        // The golden model sweeps to its end whatever the sink says; what comes after an error is dropped.
        let mut outcome = Ok(());
        golden(&format, &base_of(triangle), &mut |step| {
            if outcome.is_err() {
                return;
            }
            counts.step(step.sends_left(), step.sends_right());
            for vertices in unit.accept(step).triangles() {
                counts.triangles += 1;
                let [a, b, c] = vertices.map(|vertex| [vertex[0], vertex[1], vertex[2]]);
                outcome = outcome.as_ref().map_or_else(|_| Ok(()), |()| sink.triangle(triangle.number, &[a, b, c]));
            }
        });
        outcome?;
        counts.bases += 1;
        sink.end();
    }
    Ok(counts)
}

fn run_rust(grid: &[GridTriangle], sink: &mut Metered<'_, '_>) -> Result<Counts, RemeshError> {
    let mut chain = Chain::new(&SET);
    let mut decoder = Decoder::new(grid, chain.decoder());
    chain.run(grid.iter().map(input_of), &mut |chain| decoder.accept(chain.strip_outputs(), sink))
}

/// Turns the strip unit's outputs, cycle by cycle, into triangles of their base triangles.
struct Decoder<'a> {
    grid: std::slice::Iter<'a, GridTriangle>,
    present: Option<&'a GridTriangle>,
    ports: chain::TrianglePorts,
}

impl<'a> Decoder<'a> {
    fn new(grid: &'a [GridTriangle], ports: chain::TrianglePorts) -> Self {
        Self { grid: grid.iter(), present: None, ports }
    }

    fn accept(&mut self, outputs: &[u64], sink: &mut Metered<'_, '_>) -> Result<(), RemeshError> {
        if !self.ports.valid(outputs) {
            return Ok(());
        }
        if self.present.is_none() {
            self.present = self.grid.next();
            self.present.into_iter().for_each(|triangle| sink.begin(triangle));
        }
        // More base triangles than were sent: the blocks are compared elsewhere, and the run ends with the last one.
        let Some(base) = self.present else { return Ok(()) };
        for triangle in self.ports.triangles(outputs) {
            sink.triangle(base.number, &triangle)?;
        }
        if self.ports.last(outputs) {
            self.present = None;
            sink.end();
        }
        Ok(())
    }
}
