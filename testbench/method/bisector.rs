// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bisection under a bound, with fitted heights or with those of the map.

use super::hardware::draw;
use super::{Engine, Goal, Method, MethodError, Tessellation};
use relief_models::bake::{Ground, Tolerance, fitted, unfitted};
use relief_models::bisector::{Lattice, SplitMap, Vertex, golden};
use relief_models::map::HeightMap;
use relief_models::mesh::{Progress, TriangleMesh};
use rustc_hash::FxHashMap;
use std::time::Instant;

/// Rounds of search of the default effort.
pub const DEFAULT_EFFORT: u32 = 8;

/// Bisection.
#[derive(Clone, Copy, Debug)]
pub struct Bisector {
    /// Rounds of search for a smaller mesh; none for heights of the map.
    pub effort: Option<u32>,
}

/// What the memories hold for a map.
struct Prepared {
    lattice: Lattice,
    split: SplitMap,
    heights: Vec<u32>,
}

impl Prepared {
    fn triangles(&self) -> u64 {
        golden(&self.lattice, &self.split, &mut |_| ()).triangles
    }
}

fn lattice_of(map: &HeightMap) -> Result<Lattice, MethodError> {
    let lattice = Lattice::of(map.width as u32, map.height as u32, false);
    lattice.ok_or_else(|| {
        let size = format!("the map has {} x {} samples", map.width, map.height);
        MethodError::Unfit(format!("{size}; the bisector takes 2 x 2 to 4097 x 4097"))
    })
}

impl Bisector {
    fn prepare(self, map: &HeightMap, bound: Tolerance, progress: &dyn Progress) -> Result<Prepared, MethodError> {
        let lattice = lattice_of(map)?;
        let ground = Ground { lattice, samples: &map.samples };
        let (split, heights) = match self.effort {
            Some(effort) => {
                let fit = fitted(&ground, bound, effort, progress);
                (fit.split, fit.heights)
            }
            None => {
                let heights = map.samples.iter().map(|&sample| u32::from(sample) << 4).collect();
                (unfitted(&ground, bound), heights)
            }
        };
        Ok(Prepared { lattice, split, heights })
    }

    /// The smallest bound, down to a tenth of a map unit, whose mesh has at most so many triangles.
    fn fewest(self, map: &HeightMap, most: u64, progress: &dyn Progress) -> Result<(Tolerance, Prepared), MethodError> {
        let tenths = |tenths: u32| Tolerance::new(tenths, 10).unwrap_or_else(largest);
        let (mut low, mut high) = (0, 655_350);
        // The map's own heights tell where to look: with fitted ones a mesh has fewer, and never more.
        let plain = Bisector { effort: None };
        while low < high {
            let middle = low + (high - low) / 2;
            if plain.prepare(map, tenths(middle), &())?.triangles() <= most { high = middle } else { low = middle + 1 }
        }
        let mut best = (tenths(high), self.prepare(map, tenths(high), progress)?);
        if best.1.triangles() > most {
            return Err(MethodError::Unfit(format!(
                "no mesh of {most} triangles covers the map; {} are the fewest",
                best.1.triangles()
            )));
        }
        if self.effort.is_some() {
            let (mut low, mut high) = (high / 4, high);
            for _ in 0..6 {
                let middle = low + (high - low) / 2;
                let prepared = self.prepare(map, tenths(middle), progress)?;
                if prepared.triangles() <= most {
                    (high, best) = (middle, (tenths(middle), prepared));
                } else {
                    low = middle + 1;
                }
            }
        }
        Ok(best)
    }
}

fn largest() -> Tolerance {
    Tolerance::new(65535, 1).unwrap_or_else(|| unreachable!("65535 is a bound"))
}

/// Collects triangles, with each vertex once.
#[derive(Default)]
struct Builder {
    mesh: TriangleMesh,
    numbers: FxHashMap<[u32; 2], u32>,
}

impl Builder {
    fn triangle(&mut self, corners: [Vertex; 3]) {
        let triangle = corners.map(|[u, v, z]| {
            *self.numbers.entry([u, v]).or_insert_with(|| {
                self.mesh.positions.push([f64::from(u), f64::from(v), f64::from(z) / 16.0]);
                self.mesh.positions.len() as u32 - 1
            })
        });
        self.mesh.triangles.push(triangle);
    }
}

fn tessellate(
    prepared: &Prepared,
    bound: Option<Tolerance>,
    engine: Engine,
    preparation_seconds: f64,
    progress: &dyn Progress,
) -> Result<Tessellation, MethodError> {
    let Prepared { lattice, split, heights } = prepared;
    // The triangles alone: what a mesh needs besides is no part of the model.
    let begun = Instant::now();
    let mut sum = 0;
    golden(lattice, split, &mut |triangle| sum ^= triangle.corners[2][0]);
    let golden_seconds = begun.elapsed().as_secs_f64();
    std::hint::black_box(sum);
    let mut builder = Builder::default();
    let hardware = match engine {
        Engine::Golden => {
            let height = |[u, v]: [u32; 2]| heights[v as usize * lattice.width as usize + u as usize];
            golden(lattice, split, &mut |triangle| {
                builder.triangle(triangle.corners.map(|at| [at[0], at[1], height(at)]));
            });
            None
        }
        _ => Some(draw(lattice, split, heights, engine, progress, &mut |corners| builder.triangle(corners))?),
    };
    let claim = bound.map(|bound| f64::from(bound.over()) / f64::from(bound.under()));
    Ok(Tessellation { mesh: builder.mesh, claim, hardware, preparation_seconds, golden_seconds })
}

impl Method for Bisector {
    fn name(&self) -> &'static str {
        if self.effort.is_some() { "bisector" } else { "bisector-interpolated" }
    }
    fn summary(&self) -> &'static str {
        if self.effort.is_some() {
            "bisection with a one-bit split map and fitted heights; keeps its bound at every sample"
        } else {
            "the same with the heights of the map"
        }
    }
    fn has_hardware(&self) -> bool {
        true
    }
    fn goals(&self, map: &HeightMap, count: usize) -> Vec<Goal> {
        let (low, high) = map.samples.iter().fold((u16::MAX, 0), |(low, high), &at| (at.min(low), at.max(high)));
        // A quarter of the range, and halves of it.
        let range = u32::from(high.saturating_sub(low)) * 10;
        let tenths = (0..count as u32).map(|halvings| (range / 4) >> halvings).filter(|&tenths| tenths > 0);
        tenths.filter_map(|tenths| Tolerance::new(tenths, 10)).map(Goal::Bound).collect()
    }
    fn tessellate(
        &self,
        map: &HeightMap,
        goal: Goal,
        engine: Engine,
        progress: &dyn Progress,
    ) -> Result<Tessellation, MethodError> {
        let begun = Instant::now();
        let (bound, prepared) = match goal {
            Goal::Bound(bound) => (bound, self.prepare(map, bound, progress)?),
            Goal::Triangles(most) => self.fewest(map, most, progress)?,
        };
        tessellate(&prepared, Some(bound), engine, begun.elapsed().as_secs_f64(), progress)
    }
}
