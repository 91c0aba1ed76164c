// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sweep-line remesher over a map that lies flat, as `relief run` does it: voxels of so many samples, and heights of
//! the maximum level that fits them (Gumhold and Huettner 1999).

use super::uniform::coarsest;
use super::{Borders, Engine, Goal, Hardware, Method, MethodError, Tessellation};
use crate::remesh::{self, Counts, GridTriangle, SCALE, remesh};
use relief_models::map::{HeightMap, Wrap};
use relief_models::mesh::{Progress, TriangleMesh};
use relief_models::mip_build::{Centring, Extremum, Pyramid, golden, golden_with_poles, max_levels};
use relief_models::mip_fetch::{Filter, fetch};
use relief_models::uniform::cells;
use rustc_hash::FxHashMap;
use std::time::Instant;

/// The remesher.
#[derive(Clone, Copy, Debug)]
pub struct Remesher;

/// Sides of the grid: coordinates have 14 bits, and texels of a fetch 13.
const MOST: usize = 8191;

/// The map, its levels, and the grid of voxels that lies over it.
struct Laid {
    pyramid: Pyramid,
    /// Samples from rim to rim.
    extent: [usize; 2],
    /// Voxels along each side.
    cells: [usize; 2],
    level: usize,
}

/// Samples from rim to rim.
fn extent(map: &HeightMap, borders: Borders) -> Result<[usize; 2], MethodError> {
    let sides = [map.width, map.height];
    if sides.iter().any(|side| !(2..=MOST).contains(side)) {
        let size = format!("the map has {} x {} samples", map.width, map.height);
        return Err(MethodError::Unfit(format!("{size}; the remesher takes 2 x 2 to {MOST} x {MOST}")));
    }
    Ok([0, 1].map(|axis| sides[axis] - usize::from(borders.wrap[axis] == Wrap::Clamp)))
}

impl Laid {
    fn new(map: &HeightMap, borders: Borders, cells: [usize; 2]) -> Result<Self, MethodError> {
        let extent = extent(map, borders)?;
        // The footprint of a voxel: its number of samples, the level one below what it covers.
        let covered = [0, 1].map(|axis| extent[axis] as f64 / cells[axis] as f64);
        let mean = (covered[0] * covered[1]).sqrt();
        let levels = max_levels(map.width, map.height, Centring::Node, borders.wrap);
        let thresholds = (0..levels).take_while(|&k| std::f64::consts::SQRT_2 * f64::from(1u32 << k) <= mean).count();
        let level = thresholds.saturating_sub(1).min(levels - 1);
        let build = if borders.poles { golden_with_poles } else { golden };
        let (width, height, samples) = (map.width, map.height, &map.samples);
        let pyramid = build(width, height, samples, Centring::Node, borders.wrap, Extremum::Max, level + 1)
            .map_err(|error| MethodError::Unfit(format!("the levels of the map: {error}")))?;
        Ok(Self { pyramid, extent, cells, level })
    }

    /// Where a vertex of the grid stands in samples, and its height.
    fn vertex(&self, at: [i64; 2]) -> [f64; 3] {
        let sample = |axis: usize| at[axis] as f64 / SCALE as f64 * self.extent[axis] as f64 / self.cells[axis] as f64;
        let [u, v] = [sample(0), sample(1)];
        let texel = |at: f64| (at * 65536.0).round() as u32;
        let height = fetch(&self.pyramid, self.level, texel(u), texel(v), Filter::Bilinear);
        [u, v, f64::from(height) / 256.0]
    }

    fn mesh(&self, engine: remesh::Engine, progress: &dyn Progress) -> Result<(TriangleMesh, Counts), MethodError> {
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
        Ok((mesh, counts))
    }
}

/// The most voxels whose mesh has at most so many triangles: two a voxel, and some more where base edges cut them.
fn fewer(
    extent: [usize; 2],
    most: u64,
    triangles: impl Fn([usize; 2]) -> Result<u64, MethodError>,
) -> Result<[usize; 2], MethodError> {
    let mut count = usize::try_from(most / 2).unwrap_or(usize::MAX).min(extent[0] * extent[1]);
    while count > 0 {
        let found = triangles(cells(count, extent))?;
        if found <= most {
            return Ok(cells(count, extent));
        }
        // By what is too much, and by one at least.
        count = (count - 1).min((count as u128 * u128::from(most) / u128::from(found)) as usize);
    }
    Err(MethodError::Unfit(format!("no grid of {most} triangles covers a map; 2 are the fewest")))
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
    fn tessellate_within(
        &self,
        map: &HeightMap,
        borders: Borders,
        goal: Goal,
        engine: Engine,
        progress: &dyn Progress,
    ) -> Result<Tessellation, MethodError> {
        let begun = Instant::now();
        let extent = extent(map, borders)?;
        let mesh_of = |cells| Ok(Laid::new(map, borders, cells)?.mesh(remesh::Engine::Golden, &())?.0);
        let cells = match goal {
            Goal::Triangles(most) => fewer(extent, most, |cells| Ok(mesh_of(cells)?.triangles.len() as u64))?,
            Goal::Bound(bound) => {
                let bound = bound.value();
                let cells = |step: usize| extent.map(|samples| samples.div_ceil(step));
                cells(coarsest(&map.unrolled(borders.wrap), bound, |step| mesh_of(cells(step)))?)
            }
        };
        let laid = Laid::new(map, borders, cells)?;
        let preparation_seconds = begun.elapsed().as_secs_f64();
        let begun = Instant::now();
        let (mut mesh, _) = laid.mesh(remesh::Engine::Golden, progress)?;
        let golden_seconds = begun.elapsed().as_secs_f64();
        let mut hardware = None;
        if engine != Engine::Golden {
            let engine = if engine == Engine::Rust { remesh::Engine::Rust } else { remesh::Engine::Verilator };
            let (simulated, counts) = laid.mesh(engine, progress)?;
            if simulated != mesh {
                return Err(MethodError::Differs("the remesher's triangles are not those of its golden model".into()));
            }
            let texels: u64 = laid.pyramid.levels.iter().map(|level| (level.width * level.height) as u64).sum();
            // Four texels for each vertex that was sent.
            let (cycles, reads) = (counts.cycles, 4 * counts.sent);
            hardware = Some(Hardware { cycles, reads, memory_bits: 16 * texels });
            mesh = simulated;
        }
        Ok(Tessellation { mesh, claim: None, growing: None, hardware, preparation_seconds, golden_seconds })
    }
}
