// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the memories of the bisector hold for a map, and the mesh that comes of it.

use super::hardware::draw;
use super::{Engine, MethodError, Tessellation};
use relief_models::bake::{Baked, Flip, Tolerance, unflip};
use relief_models::bisector::{Bound, Counts, Errors, Lattice, SplitMap, Triangle, Vertex, WALKERS, golden};
use relief_models::mesh::{Progress, TriangleMesh};
use rustc_hash::FxHashMap;
use std::time::Instant;

/// What tells where to split.
#[derive(Clone, Debug, PartialEq)]
pub enum Steered {
    /// A bit a lattice vertex.
    Split(SplitMap),
    /// Saturated errors, one a lattice vertex, in units of 2^-`fraction_bits` map units, and the bound of the draw.
    Errors {
        /// Errors.
        errors: Vec<u16>,
        /// Bits of their fraction.
        fraction_bits: u32,
        /// The bound, in their units.
        bound: Bound,
    },
}

/// The memories.
#[derive(Clone, Debug, PartialEq)]
pub struct Memories {
    /// The lattice of the map.
    pub lattice: Lattice,
    /// Where to split.
    pub steered: Steered,
    /// Heights, UQ16.4, one a sample, in the order of the lattice.
    pub heights: Vec<u32>,
    /// Whether the lattice counts columns, and rows, from the other end.
    pub flipped: Flip,
    /// The largest error that is promised, in map units.
    pub claim: f64,
    /// The bound, if it grows.
    pub growing: Option<Growing>,
}

impl Memories {
    /// Those of a prepared map: with its split map, or with its errors where a bound is given.
    ///
    /// # Errors
    /// A sentence: the folder does not hold what is asked for.
    pub fn of_baked(baked: Baked, bound: Option<Growing>) -> Result<Self, MethodError> {
        let unfit = |message: &str| MethodError::Unfit(message.into());
        let Baked { manifest, lattice, map, split, heights, errors, .. } = baked;
        if let Some(bound) = bound {
            let (errors, entry) = errors.zip(manifest.errors).ok_or_else(|| {
                unfit("the folder holds no errors, which a bound of the draw needs; bake it with `--what errors`")
            })?;
            return Self::of_errors(lattice, &map.samples, errors, entry.fraction_bits, bound);
        }
        let ((split, heights), entry) = split.zip(heights).zip(manifest.split).ok_or_else(|| {
            unfit("the folder holds no split map; bake it with `--what split`, or give a bound for its errors")
        })?;
        let bound: Tolerance =
            entry.bound.parse().map_err(|error| MethodError::Unfit(format!("split.bound of bake.json: {error}")))?;
        let claim = bound.value();
        let steered = Steered::Split(split);
        Ok(Self { lattice, steered, heights, flipped: entry.flipped, claim, growing: None })
    }

    /// Those of a map with saturated errors.
    ///
    /// # Errors
    /// The bound grows faster than the block can count, or the eye is not over the map.
    pub fn of_errors(
        lattice: Lattice,
        samples: &[u16],
        errors: Vec<u16>,
        fraction_bits: u32,
        growing: Growing,
    ) -> Result<Self, MethodError> {
        let unit = f64::from(1u32 << fraction_bits);
        let sides = [lattice.width, lattice.height];
        let Growing { slope, eye, .. } = growing;
        if eye[0] >= sides[0] || eye[1] >= sides[1] {
            let what = format!("the eye is at {},{}, beyond the map", eye[0], eye[1]);
            return Err(MethodError::Unfit(format!("{what}; a sample of its {} x {} is expected", sides[0], sides[1])));
        }
        // A half step is half a sample; the slope has 8 bits of fraction.
        let per_sample = 2.0 / (256.0 * unit);
        if slope > 65535.0 * per_sample {
            let most = 65535.0 * per_sample;
            let what = format!("the block counts slopes to {most} map units a sample on this map");
            return Err(MethodError::Unfit(format!("{what}, and {slope} is beyond")));
        }
        // No error of the map is greater.
        let base = (growing.base * unit).floor().min(65535.0) as u16;
        let slope = (slope / per_sample).floor() as u16;
        let bound = Bound { base, slope, eye: eye.map(|at| (2 * at) as u16) };
        // Nothing is farther from the eye than the farthest side.
        let far = (0..2).map(|axis| growing.eye[axis].max((sides[axis] - 1).abs_diff(growing.eye[axis]))).max();
        let most = u64::from(base) + ((u64::from(slope) * 2 * u64::from(far.unwrap_or(0))) >> 8);
        let grows = (growing.slope > 0.0).then_some(growing);
        Ok(Self {
            lattice,
            steered: Steered::Errors { errors, fraction_bits, bound },
            heights: samples.iter().map(|&sample| u32::from(sample) << 4).collect(),
            flipped: [false; 2],
            claim: most as f64 / unit,
            growing: grows,
        })
    }

    /// The bits of an error.
    pub(super) fn error_bits(&self) -> usize {
        match &self.steered {
            Steered::Split(_) => 1,
            Steered::Errors { .. } => 16,
        }
    }
    /// The error of a lattice vertex.
    pub(super) fn error(&self, index: usize) -> u16 {
        match &self.steered {
            Steered::Split(split) => split.get(index).into(),
            Steered::Errors { errors, .. } => errors[index],
        }
    }
    /// The bound of the draw.
    pub(super) fn bound(&self) -> Bound {
        match self.steered {
            Steered::Split(_) => Bound::constant(0),
            Steered::Errors { bound, .. } => bound,
        }
    }
    /// A corner with its height.
    pub(super) fn vertex(&self, at: [u32; 2]) -> Vertex {
        [at[0], at[1], self.heights[at[1] as usize * self.lattice.width as usize + at[0] as usize]]
    }
    /// The golden model's triangles.
    pub(super) fn golden(&self, sink: &mut impl FnMut(&Triangle)) -> Counts {
        match &self.steered {
            Steered::Split(split) => golden(&self.lattice, split, sink),
            Steered::Errors { errors, bound, .. } => golden(&self.lattice, &Errors { errors, bound: *bound }, sink),
        }
    }
    /// The number of triangles.
    pub fn triangles(&self) -> u64 {
        self.golden(&mut |_| ()).triangles
    }

    /// The mesh, in sample coordinates of the map.
    ///
    /// # Errors
    /// No width set holds the map, the engine cannot run, or hardware and golden model disagree.
    pub fn tessellate(
        &self,
        engine: Engine,
        preparation_seconds: f64,
        progress: &dyn Progress,
    ) -> Result<Tessellation, MethodError> {
        // The triangles alone: what a mesh needs besides is no part of the model.
        let begun = Instant::now();
        let mut sum = 0;
        self.golden(&mut |triangle| sum ^= triangle.corners[2][0]);
        let golden_seconds = begun.elapsed().as_secs_f64();
        std::hint::black_box(sum);
        let mut builder = Builder::new(self);
        let hardware = match engine {
            Engine::Golden => {
                self.golden(&mut |triangle| {
                    builder.triangle(triangle.walker.into(), triangle.corners.map(|at| self.vertex(at)));
                });
                None
            }
            _ => Some(draw(self, engine, progress, &mut |walker, corners| builder.triangle(walker, corners))?),
        };
        let (mesh, claim, growing) = (builder.finish(), Some(self.claim), self.growing);
        Ok(Tessellation { mesh, claim, growing, hardware, preparation_seconds, golden_seconds })
    }
}

/// A bound of a draw that grows with the distance from an eye, in the maximum norm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growing {
    /// The bound at the eye, in map units.
    pub base: f64,
    /// Growth, in map units a sample.
    pub slope: f64,
    /// Column and row of the eye.
    pub eye: [u32; 2],
}

impl Growing {
    /// The bound at a sample.
    pub fn at(&self, sample: [usize; 2]) -> f64 {
        let away = [0, 1].map(|axis| sample[axis].abs_diff(self.eye[axis] as usize));
        self.base + self.slope * away[0].max(away[1]) as f64
    }
}

/// Collects triangles, with each vertex once, walker by walker: strips of different ones share no cache.
struct Builder {
    mesh: TriangleMesh,
    strips: [Vec<[u32; 3]>; WALKERS],
    numbers: FxHashMap<[u32; 2], u32>,
    size: [usize; 2],
    flipped: Flip,
}

impl Builder {
    fn new(memories: &Memories) -> Self {
        let Lattice { width, height, .. } = memories.lattice;
        let size = [width as usize, height as usize];
        Self {
            mesh: TriangleMesh::default(),
            strips: Default::default(),
            numbers: FxHashMap::default(),
            size,
            flipped: memories.flipped,
        }
    }
    fn triangle(&mut self, walker: usize, corners: [Vertex; 3]) {
        let mut triangle = corners.map(|[u, v, z]| {
            *self.numbers.entry([u, v]).or_insert_with(|| {
                let [x, y] = unflip([u, v], self.size, self.flipped);
                self.mesh.positions.push([f64::from(x), f64::from(y), f64::from(z) / 16.0]);
                self.mesh.positions.len() as u32 - 1
            })
        });
        // One flip alone turns triangles over.
        if self.flipped[0] != self.flipped[1] {
            triangle.swap(0, 1);
        }
        self.strips[walker].push(triangle);
    }
    fn finish(mut self) -> TriangleMesh {
        self.mesh.triangles = self.strips.concat();
        self.mesh
    }
}
