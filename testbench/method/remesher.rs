// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sweep-line remesher over a map that lies flat, as `relief run` does it: voxels of so many samples, and heights of
//! the maximum level that fits them (Gumhold and Huettner 1999).

use super::uniform::coarsest;
use super::{Engine, Goal, Hardware, Method, MethodError, Tessellation};
use crate::remesh::{self, GridTriangle, SCALE, remesh};
use relief_models::map::HeightMap;
use relief_models::mesh::{Progress, TriangleMesh};
use relief_models::mip_build::{Centring, Extremum, Pyramid, Wrap, golden, max_levels};
use relief_models::mip_fetch::{Filter, fetch};
use rustc_hash::FxHashMap;
use std::time::Instant;

/// The remesher.
#[derive(Clone, Copy, Debug)]
pub struct Remesher;

/// Sides of the grid: coordinates have 14 bits, and texels of a fetch 13.
const MOST: usize = 8191;

/// The map, its levels, and the grid of voxels that lies over it.
struct Laid<'a> {
    map: &'a HeightMap,
    pyramid: Pyramid,
    /// Voxels along each side.
    cells: [usize; 2],
    level: usize,
}

impl<'a> Laid<'a> {
    fn new(map: &'a HeightMap, step: usize) -> Result<Self, MethodError> {
        let sides = [map.width, map.height];
        if sides.iter().any(|side| !(2..=MOST).contains(side)) {
            let size = format!("the map has {} x {} samples", map.width, map.height);
            return Err(MethodError::Unfit(format!("{size}; the remesher takes 2 x 2 to {MOST} x {MOST}")));
        }
        let cells = sides.map(|side| (side - 1).div_ceil(step));
        // The footprint of a voxel: its number of samples, the level one below what it covers.
        let covered = [0, 1].map(|axis| (sides[axis] - 1) as f64 / cells[axis] as f64);
        let mean = (covered[0] * covered[1]).sqrt();
        let levels = max_levels(map.width, map.height, Centring::Node, [Wrap::Clamp; 2]);
        let thresholds = (0..levels).take_while(|&k| std::f64::consts::SQRT_2 * f64::from(1u32 << k) <= mean).count();
        let level = thresholds.saturating_sub(1).min(levels - 1);
        let pyramid =
            golden(map.width, map.height, &map.samples, Centring::Node, [Wrap::Clamp; 2], Extremum::Max, level + 1)
                .map_err(|error| MethodError::Unfit(format!("the levels of the map: {error}")))?;
        Ok(Self { map, pyramid, cells, level })
    }

    /// Where a vertex of the grid stands in samples, and its height.
    fn vertex(&self, at: [i64; 2]) -> [f64; 3] {
        let sides = [self.map.width, self.map.height];
        let sample = |axis: usize| at[axis] as f64 / SCALE as f64 * (sides[axis] - 1) as f64 / self.cells[axis] as f64;
        let [u, v] = [sample(0), sample(1)];
        let texel = |at: f64| (at * 65536.0).round() as u32;
        let height = fetch(&self.pyramid, self.level, texel(u), texel(v), Filter::Bilinear);
        [u, v, f64::from(height) / 256.0]
    }

    fn mesh(&self, engine: remesh::Engine, progress: &dyn Progress) -> Result<(TriangleMesh, u64), MethodError> {
        let [x, y] = self.cells.map(|cells| cells as i32);
        let [low, right, high, left] = [[0, 0, 0], [x, 0, 0], [x, y, 0], [0, y, 0]];
        let grid = [[low, right, high], [low, high, left]];
        let grid: Vec<_> =
            grid.into_iter().zip(0..).map(|(corners, number)| GridTriangle { number, corners }).collect();
        let (mut mesh, mut numbers) = (TriangleMesh::default(), FxHashMap::default());
        let counts = remesh(engine, &grid, progress, &mut |_, triangle| {
            let corners = triangle.map(|[x, y, _]| {
                *numbers.entry([x, y]).or_insert_with(|| {
                    mesh.positions.push(self.vertex([x, y]));
                    mesh.positions.len() as u32 - 1
                })
            });
            mesh.triangles.push(corners);
            Ok(())
        })?;
        Ok((mesh, counts.cycles))
    }
}

impl Method for Remesher {
    fn name(&self) -> &'static str {
        "remesher"
    }
    fn summary(&self) -> &'static str {
        "the sweep-line remesher with maxima of filter levels, as in a draw; promises nothing"
    }
    fn has_hardware(&self) -> bool {
        true
    }
    fn goals(&self, map: &HeightMap, count: usize) -> Vec<Goal> {
        super::Uniform.goals(map, count)
    }
    fn tessellate(
        &self,
        map: &HeightMap,
        goal: Goal,
        engine: Engine,
        progress: &dyn Progress,
    ) -> Result<Tessellation, MethodError> {
        let begun = Instant::now();
        let step = match goal {
            Goal::Triangles(most) => {
                let triangles = |step: usize| {
                    let cells = |side: usize| (side.max(2) - 1).div_ceil(step) as u64;
                    2 * cells(map.width) * cells(map.height)
                };
                let longest = map.width.max(map.height);
                (1..longest).find(|&step| triangles(step) <= most).ok_or_else(|| {
                    MethodError::Unfit(format!("no grid of {most} triangles covers a map; 2 are the fewest"))
                })?
            }
            Goal::Bound(bound) => {
                let bound = f64::from(bound.over()) / f64::from(bound.under());
                let mesh_of = |step| Ok(Laid::new(map, step)?.mesh(remesh::Engine::Golden, &())?.0);
                coarsest(map, bound, mesh_of)?
            }
        };
        let laid = Laid::new(map, step)?;
        let preparation_seconds = begun.elapsed().as_secs_f64();
        let begun = Instant::now();
        let (mut mesh, _) = laid.mesh(remesh::Engine::Golden, progress)?;
        let golden_seconds = begun.elapsed().as_secs_f64();
        let mut hardware = None;
        if engine != Engine::Golden {
            let engine = if engine == Engine::Rust { remesh::Engine::Rust } else { remesh::Engine::Verilator };
            let (simulated, cycles) = laid.mesh(engine, progress)?;
            if simulated != mesh {
                return Err(MethodError::Differs("the remesher's triangles are not those of its golden model".into()));
            }
            let texels: u64 = laid.pyramid.levels.iter().map(|level| (level.width * level.height) as u64).sum();
            // Four texels a vertex.
            let reads = 4 * simulated.positions.len() as u64;
            hardware = Some(Hardware { cycles, reads, memory_bits: 16 * texels });
            mesh = simulated;
        }
        Ok(Tessellation { mesh, claim: None, hardware, preparation_seconds, golden_seconds })
    }
}
