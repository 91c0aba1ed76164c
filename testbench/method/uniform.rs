// SPDX-License-Identifier: MIT OR Apache-2.0
//! The regular grid, which knows nothing of the map: the baseline.

use super::{Borders, Engine, Goal, Method, MethodError, Tessellation};
use relief_models::map::HeightMap;
use relief_models::measure::heights;
use relief_models::mesh::{Progress, TriangleMesh};
use relief_models::uniform::{with_step, with_triangles};
use std::time::Instant;

/// The regular grid.
#[derive(Clone, Copy, Debug)]
pub struct Uniform;

/// The coarsest step, in powers of two down from the longer side, whose grid keeps a bound: found by measuring, so the
/// grid keeps it, and promises nothing. `map` is unrolled.
pub(super) fn coarsest(
    map: &HeightMap,
    bound: f64,
    mesh_of: impl Fn(usize) -> Result<TriangleMesh, MethodError>,
) -> Result<usize, MethodError> {
    let longest = map.width.max(map.height).max(2) - 1;
    let mut step = longest.next_power_of_two();
    loop {
        let error = heights(&mesh_of(step)?, map, &())?.max;
        if error <= bound {
            return Ok(step);
        }
        if step == 1 {
            let what = format!("with a vertex a sample the error is {error:.4}");
            return Err(MethodError::Unfit(format!("{what}; a bound of that or more is expected")));
        }
        step /= 2;
    }
}

impl Method for Uniform {
    fn name(&self) -> &'static str {
        "uniform"
    }
    fn summary(&self) -> &'static str {
        "a regular grid of samples; promises nothing"
    }
    fn has_hardware(&self) -> bool {
        false
    }
    fn goals(&self, map: &HeightMap, count: usize) -> Vec<Goal> {
        let most = 2 * (map.width.max(2) - 1) as u64 * (map.height.max(2) - 1) as u64;
        (0..count as u32).rev().map(|halvings| Goal::Triangles((most >> halvings).max(2))).collect()
    }
    fn tessellate_within(
        &self,
        map: &HeightMap,
        borders: Borders,
        goal: Goal,
        engine: Engine,
        _: &dyn Progress,
    ) -> Result<Tessellation, MethodError> {
        if engine != Engine::Golden {
            return Err(MethodError::Unfit("the uniform grid has no hardware; its engine is golden".into()));
        }
        let map = &map.unrolled(borders.wrap);
        let begun = Instant::now();
        let step = match goal {
            Goal::Triangles(_) => None,
            Goal::Bound(bound) => Some(coarsest(map, bound.value(), |step| Ok(with_step(map, step)?))?),
        };
        let preparation_seconds = begun.elapsed().as_secs_f64();
        let begun = Instant::now();
        let mesh = match (goal, step) {
            (Goal::Triangles(most), None) => {
                with_triangles(map, usize::try_from(most).unwrap_or(usize::MAX).min(1 << 32))?
            }
            (_, step) => with_step(map, step.unwrap_or(1))?,
        };
        let golden_seconds = begun.elapsed().as_secs_f64();
        Ok(Tessellation { mesh, claim: None, growing: None, hardware: None, preparation_seconds, golden_seconds })
    }
}
