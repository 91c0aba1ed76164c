// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ways from a height map to a mesh, one [`Method`] each. A new one implements the trait in a file below `method/` and
//! joins [`METHODS`]: `tessellate`, `chart` and `stability` then know it.

mod bisector;
mod hardware;
mod measured;
mod memories;
mod remesher;
mod uniform;

pub use bisector::{Bisector, DEFAULT_EFFORT};
pub use measured::{Measured, Verdict, verdict};
pub use memories::{Growing, Memories, Steered};
pub use remesher::Remesher;
pub use uniform::Uniform;

use crate::replay::ReplayError;
use relief_models::bake::Tolerance;
use relief_models::map::{HeightMap, Wrap};
use relief_models::measure::MeasureError;
use relief_models::mesh::{Progress, TriangleMesh};
use relief_models::uniform::GridError;

/// What computes the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// The golden models.
    Golden,
    /// The hardware, simulated in Rust, each beat compared with golden.
    Rust,
    /// The emitted Verilog in Verilator, on the inputs of the hardware in Rust, compared with it cycle for cycle.
    Verilator,
}

/// What is beyond the rims of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Borders {
    /// In u and in v. The rims of an axis that repeats meet: their vertices stand at the same places, in equal heights.
    pub wrap: [Wrap; 2],
    /// Whether the first and the last row are a point each. The map has one value along them.
    pub poles: bool,
}

impl Borders {
    /// A map that ends at its rims.
    pub const CLAMP: Self = Self { wrap: [Wrap::Clamp; 2], poles: false };
}

/// What a mesh is to keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// Errors of at most so many map units.
    Bound(Tolerance),
    /// At most so many triangles.
    Triangles(u64),
}

/// What the hardware takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hardware {
    /// Cycles, by the block's own counter, from the first beat of the draw to the last triangle; the map is loaded before.
    pub cycles: u64,
    /// Words read from its map memories, by its algorithm: not counted in the block.
    pub reads: u64,
    /// Bits that the map takes in them.
    pub memory_bits: u64,
}

/// A mesh of a map, in sample coordinates: x = column, y = row, z = map value.
#[derive(Clone, Debug, PartialEq)]
pub struct Tessellation {
    /// The mesh.
    pub mesh: TriangleMesh,
    /// The largest error that the method promises, in map units; none for a method that promises nothing.
    pub claim: Option<f64>,
    /// What it promises sample by sample, where that grows with the distance from an eye; then `claim` is the most of it.
    pub growing: Option<Growing>,
    /// What the hardware took; none when none ran.
    pub hardware: Option<Hardware>,
    /// Seconds of preparation on the host: the map becomes what the memories hold.
    pub preparation_seconds: f64,
    /// Seconds of the golden model, from what the memories hold to triangles.
    pub golden_seconds: f64,
}

/// Why there is no mesh.
#[derive(Debug, thiserror::Error)]
pub enum MethodError {
    /// The map, or the goal, is none that the method can serve.
    #[error("{0}")]
    Unfit(String),
    /// No such grid.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A mesh cannot be measured.
    #[error(transparent)]
    Measure(#[from] MeasureError),
    /// The emitted modules cannot be run, or do not follow.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// The remesher's run failed.
    #[error(transparent)]
    Remesh(#[from] crate::remesh::RemeshError),
    /// The emitted modules cannot be built.
    #[error(transparent)]
    Cosim(#[from] crate::cosim::CosimError),
    /// The hardware and the golden model disagree, or the hardware hangs.
    #[error("{0}")]
    Differs(String),
}

impl MethodError {
    /// Whether the hardware is wrong, rather than the input or the surroundings.
    pub const fn is_mismatch(&self) -> bool {
        match self {
            Self::Differs(_) | Self::Replay(ReplayError::Differs { .. }) => true,
            Self::Remesh(error) => error.is_mismatch(),
            _ => false,
        }
    }
}

/// A way from a height map to a mesh.
pub trait Method: Sync {
    /// Name, as `--method` takes it.
    fn name(&self) -> &'static str;
    /// One line.
    fn summary(&self) -> &'static str;
    /// Whether a block of ours does it; otherwise there is the golden engine alone.
    fn has_hardware(&self) -> bool;
    /// Goals that show what the method can do on a map, from coarse to fine, `count` of them at the most.
    fn goals(&self, map: &HeightMap, count: usize) -> Vec<Goal>;
    /// The mesh of a map. Where it repeats, the mesh reaches to one sample beyond the last: see [`HeightMap::unrolled`].
    ///
    /// # Errors
    /// A sentence: map, borders or goal cannot be served, an engine cannot run; or hardware and golden model disagree.
    fn tessellate_within(
        &self,
        map: &HeightMap,
        borders: Borders,
        goal: Goal,
        engine: Engine,
        progress: &dyn Progress,
    ) -> Result<Tessellation, MethodError>;
    /// The mesh of a map that ends at its rims.
    ///
    /// # Errors
    /// As [`Method::tessellate_within`].
    fn tessellate(
        &self,
        map: &HeightMap,
        goal: Goal,
        engine: Engine,
        progress: &dyn Progress,
    ) -> Result<Tessellation, MethodError> {
        self.tessellate_within(map, Borders::CLAMP, goal, engine, progress)
    }
}

/// Every method.
pub const METHODS: &[&dyn Method] =
    &[&Bisector { effort: Some(DEFAULT_EFFORT) }, &Bisector { effort: None }, &Uniform, &Remesher];

/// The method of a name.
pub fn find(name: &str) -> Option<&'static dyn Method> {
    METHODS.iter().copied().find(|method| method.name() == name)
}
