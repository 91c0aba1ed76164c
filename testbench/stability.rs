// SPDX-License-Identifier: MIT OR Apache-2.0
//! Maps on which methods are known to fail, and what each method makes of them.
//!
//! Each map is there because of one weakness: a test that looks at the ends and the middle of an edge, a grid whose step is
//! the period of the map, a feature of one sample, sides that no power of two fits, numbers at the ends of their range.

use crate::frame::{self, FrameError, prepare};
use crate::method::{Engine, Goal, Hardware, Method, MethodError, Verdict};
use crate::pipeline::Pipeline;
use crate::remesher::format;
use rayon::prelude::*;
use relief_hdl::widths::WIDTH_SETS;
use relief_models::bake::Tolerance;
use relief_models::failures::FailureScene;
use relief_models::map::{HeightMap, Procedural};
use relief_models::mesh::{InputError, Progress};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// A map with a weakness to look for.
#[derive(Clone, Debug)]
pub struct FailureMap {
    /// Name.
    pub name: &'static str,
    /// What fails on it.
    pub why: &'static str,
    /// The map.
    pub map: HeightMap,
}

/// All of them.
pub fn maps() -> Vec<FailureMap> {
    use Procedural::{Checkerboard, Cubic, Dents, Noise, Paraboloid, Peak, Peaks, Ramp, Waves};
    let formula = |name, kind, [width, height]: [usize; 2], why| {
        let map = HeightMap::procedural(kind, width, height);
        FailureMap { name, why, map }
    };
    let level = |name, value, [width, height]: [usize; 2], why| {
        let samples = vec![value; width * height];
        FailureMap { name, why, map: HeightMap { width, height, samples } }
    };
    let saddle = HeightMap { width: 2, height: 2, samples: vec![0, 65535, 65535, 0] };
    vec![
        formula("paraboloid", Paraboloid, [129, 129], "curved alike everywhere: every triangle fails at once"),
        formula("cubic", Cubic, [129, 129], "ends and middle of long edges see a plane"),
        formula("checkerboard", Checkerboard, [128, 128], "cliffs, nowhere on a vertex of the lattice"),
        formula("waves", Waves, [129, 129], "cosine at the frequency of a base grid of 8 cells, which sees a plane"),
        formula("dents", Dents, [129, 129], "hollows between the vertices of a base grid of 8 cells"),
        formula("peak", Peak, [129, 129], "one sample that no coarse grid sees"),
        formula("ramp", Ramp, [129, 97], "a plane, but for rounding: nothing to do"),
        formula("noise", Noise, [65, 65], "nothing is like its neighbour: all triangles are needed"),
        level("constant", 32768, [65, 33], "no range, no error"),
        FailureMap { name: "2 x 2", why: "the smallest map; a saddle, cut along either diagonal", map: saddle },
        formula("3 x 4097", Noise, [3, 4097], "the longest lattice, nearly all of it beside the map"),
        formula("prime sides", Peaks, [127, 61], "no step divides the sides"),
        level("all minimum", 0, [33, 33], "the least value of the format"),
        level("all maximum", 65535, [33, 33], "the greatest value of the format"),
    ]
}

/// Triangles of a base grid of 8 x 8 cells.
pub const BASE_GRID: u64 = 128;

/// The goals on a map: 2 % of its range as bound (1 unit where there is none), and the triangles of a base grid.
pub fn goals(map: &HeightMap) -> [Goal; 2] {
    let [low, high] = map.range();
    let fiftieths = u32::from(high.saturating_sub(low)).max(50);
    let bound = Tolerance::new(fiftieths, 50).unwrap_or_else(|| unreachable!("at most 65535 / 50"));
    [Goal::Bound(bound), Goal::Triangles(BASE_GRID)]
}

/// What a method made of a map.
#[derive(Clone, Debug)]
pub struct Row {
    /// Name of the map.
    pub map: &'static str,
    /// Name of the method.
    pub method: &'static str,
    /// What was asked for.
    pub goal: Goal,
    /// What came.
    pub result: Result<Figures, String>,
}

/// A mesh in figures; errors in map units.
#[derive(Clone, Copy, Debug)]
pub struct Figures {
    /// Triangles.
    pub triangles: usize,
    /// Largest error at a sample.
    pub max: f64,
    /// Root mean square error.
    pub rms: f64,
    /// What is claimed.
    pub claim: Option<f64>,
    /// Whether the claim holds.
    pub verdict: Verdict,
    /// What the hardware took, where it ran.
    pub hardware: Option<Hardware>,
}

impl Row {
    /// Whether a claim is broken, or a mesh is not whole. A method that refuses a map with a sentence breaks nothing.
    pub fn is_broken(&self) -> bool {
        self.result.as_ref().is_ok_and(|figures| figures.verdict == Verdict::Broken)
    }
}

/// Every method on every map; on all cores, in the order of the maps.
///
/// # Errors
/// The hardware and its golden model disagree.
pub fn rows(methods: &[&dyn Method], engine: Engine, progress: &dyn Progress) -> Result<Vec<Row>, MethodError> {
    let maps = maps();
    let work: Vec<_> = maps
        .iter()
        .flat_map(|map| goals(&map.map).map(|goal| (map, goal)))
        .flat_map(|(map, goal)| methods.iter().map(move |method| (map, goal, *method)))
        .collect();
    progress.phase("tessellating", work.len() as u64);
    let done = AtomicU64::new(0);
    let row = |(map, goal, method): &(&FailureMap, Goal, &dyn Method)| {
        let engine = if method.has_hardware() { engine } else { Engine::Golden };
        let made = method.tessellate(&map.map, *goal, engine, &());
        progress.advance(done.fetch_add(1, Relaxed) + 1);
        let result = match made {
            Err(error) if error.is_mismatch() => return Err(error),
            Err(error) => Err(error.to_string()),
            Ok(made) => {
                let measured = made.measure(&map.map, &())?;
                Ok(Figures {
                    triangles: made.mesh.triangles.len(),
                    max: measured.heights.max,
                    rms: measured.heights.rms.unwrap_or(f64::NAN),
                    claim: made.claim,
                    verdict: measured.verdict,
                    hardware: made.hardware,
                })
            }
        };
        Ok(Row { map: map.name, method: method.name(), goal: *goal, result })
    };
    work.par_iter().map(row).collect()
}

/// Why a failure scene did not go through the hardware.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// No width set has its formats.
    #[error("{0}: no width set has its formats")]
    NoSet(&'static str),
    /// The set does not hold it.
    #[error("{0}: {1}")]
    Refused(&'static str, InputError),
    /// The hardware is at fault.
    #[error("{0}: {1}")]
    Frame(&'static str, FrameError),
}

impl SceneError {
    /// Whether the hardware is wrong, rather than the input.
    pub fn is_mismatch(&self) -> bool {
        matches!(self, Self::Frame(_, error) if error.is_mismatch())
    }
}

/// Cycles of the draw of a failure scene, up to its last strip, on the blocks of the width set that has its formats; each
/// beat is compared with golden.
///
/// # Errors
/// The hardware is at fault, or does not hold the scene.
pub fn cycles(failure: &FailureScene) -> Result<u64, SceneError> {
    let name = failure.name;
    let set = WIDTH_SETS.iter().find(|set| format(set) == failure.format).ok_or(SceneError::NoSet(name))?;
    let prepared = prepare(&failure.scene, set).map_err(|error| SceneError::Refused(name, error))?;
    frame::cycles(&prepared, &mut Pipeline::new(set)).map_err(|error| SceneError::Frame(name, error))
}
