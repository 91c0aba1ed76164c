// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bisection under a bound, with fitted heights or with those of the map.

use super::memories::{Growing, Memories, Steered};
use super::{Borders, Engine, Goal, Method, MethodError, Tessellation};
use relief_models::bake::{Ground, Tolerance, fitted_from_best_corner, saturated, unfitted_with_seams};
use relief_models::bisector::Lattice;
use relief_models::map::{HeightMap, Wrap};
use relief_models::mesh::Progress;
use std::time::Instant;

/// Rounds of search of the default effort.
pub const DEFAULT_EFFORT: u32 = 8;

/// Bisection.
#[derive(Clone, Copy, Debug)]
pub struct Bisector {
    /// Rounds of search for a smaller mesh; none for heights of the map.
    pub effort: Option<u32>,
}

fn lattice_of(map: &HeightMap) -> Result<Lattice, MethodError> {
    let lattice = Lattice::of(map.width as u32, map.height as u32, false);
    lattice.ok_or_else(|| {
        let size = format!("the map has {} x {} samples", map.width, map.height);
        MethodError::Unfit(format!("{size}; the bisector takes 2 x 2 to 4097 x 4097"))
    })
}

impl Bisector {
    /// `map` is unrolled.
    fn prepare(
        self,
        map: &HeightMap,
        seams: [bool; 2],
        bound: Tolerance,
        progress: &dyn Progress,
    ) -> Result<Memories, MethodError> {
        let lattice = lattice_of(map)?;
        let ground = Ground { lattice, samples: &map.samples };
        let (flipped, split, heights) = match self.effort {
            Some(effort) => {
                let (flipped, fit) = fitted_from_best_corner(map, &ground, bound, effort, progress);
                (flipped, fit.split, fit.heights)
            }
            None => {
                let heights = map.samples.iter().map(|&sample| u32::from(sample) << 4).collect();
                ([false; 2], unfitted_with_seams(&ground, bound, seams), heights)
            }
        };
        let claim = bound.value();
        let steered = Steered::Split(split);
        Ok(Memories { lattice, steered, heights, flipped, claim, growing: None })
    }

    /// The memories for a bound of the draw that grows with the distance from an eye, with the heights of the map.
    ///
    /// # Errors
    /// The map is too small or too large, or see [`Memories::of_errors`].
    pub fn growing(map: &HeightMap, growing: Growing, progress: &dyn Progress) -> Result<Memories, MethodError> {
        let lattice = lattice_of(map)?;
        let found = saturated(&Ground { lattice, samples: &map.samples }, progress);
        Memories::of_errors(lattice, &map.samples, found.errors, found.fraction_bits, growing)
    }

    /// The smallest bound, down to a tenth of a map unit, whose mesh has at most so many triangles.
    fn fewest(
        self,
        map: &HeightMap,
        seams: [bool; 2],
        most: u64,
        progress: &dyn Progress,
    ) -> Result<Memories, MethodError> {
        let tenths = |tenths: u32| Tolerance::new(tenths, 10).unwrap_or_else(largest);
        let (mut low, mut high) = (0, 655_350);
        // The map's own heights tell where to look: with fitted ones a mesh has fewer, and never more.
        let plain = Bisector { effort: None };
        while low < high {
            let middle = low + (high - low) / 2;
            if plain.prepare(map, seams, tenths(middle), &())?.triangles() <= most {
                high = middle
            } else {
                low = middle + 1
            }
        }
        let mut best = self.prepare(map, seams, tenths(high), progress)?;
        if best.triangles() > most {
            let fewest = best.triangles();
            return Err(MethodError::Unfit(format!(
                "no mesh of {most} triangles covers the map; {fewest} are the fewest"
            )));
        }
        if self.effort.is_some() {
            let (mut low, mut high) = (high / 4, high);
            for _ in 0..6 {
                let middle = low + (high - low) / 2;
                let prepared = self.prepare(map, seams, tenths(middle), progress)?;
                if prepared.triangles() <= most {
                    (high, best) = (middle, prepared);
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
        let [low, high] = map.range();
        // A quarter of the range, and halves of it.
        let range = u32::from(high.saturating_sub(low)) * 10;
        let tenths = (0..count as u32).map(|halvings| (range / 4) >> halvings).filter(|&tenths| tenths > 0);
        tenths.filter_map(|tenths| Tolerance::new(tenths, 10)).map(Goal::Bound).collect()
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
        let seams = borders.wrap.map(|wrap| wrap == Wrap::Repeat);
        if self.effort.is_some() && seams.contains(&true) {
            let what = "the map repeats, and heights are fitted to maps that clamp";
            return Err(MethodError::Unfit(format!("{what}; bisector-interpolated keeps the seam closed")));
        }
        let map = &map.unrolled(borders.wrap);
        let memories = match goal {
            Goal::Bound(bound) => self.prepare(map, seams, bound, progress)?,
            Goal::Triangles(most) => self.fewest(map, seams, most, progress)?,
        };
        memories.tessellate(engine, begun.elapsed().as_secs_f64(), progress)
    }
}
