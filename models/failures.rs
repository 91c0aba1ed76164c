// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes on which displacement is known to fail, what the datapath does there, and what comes of it.
//!
//! Each scene has one weakness: geometry at or behind the eye, base triangles without area, maps far coarser than the
//! picture, normals that cancel out, formats too narrow. What is asked of all of them is the same: nothing hangs, wraps or cracks,
//! and whatever is left out is counted by its reason.

use crate::body::{BaseMesh, BaseMeshVertex};
use crate::closure::{Closure, closure};
use crate::displacement_pipeline::Deviation;
use crate::draw::{Assembled, CameraView, Draw, DrawError};
use crate::mesh::Progress;
use crate::plan::{PlanError, Planner, Widths};
use crate::remesher::{Format, Place, observe};
use crate::rules::{ExtremumRule, FootprintRule, Ruled, Rules};
use crate::scene::{Scene, parse};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use serde::Serialize;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// A scene with a weakness to look for.
#[derive(Clone, Debug)]
pub struct FailureScene {
    /// Name.
    pub name: &'static str,
    /// What fails there, where nothing is done about it.
    pub why: &'static str,
    /// What the datapath does.
    pub does: &'static str,
    /// The scene.
    pub scene: Scene,
    /// The formats that it is drawn with.
    pub format: Format,
}

/// That of the width set `default`.
const DEFAULT: Format =
    Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 14, column_depth: 4096 };
/// That of the width set `small`.
const SMALL: Format = Format { components: 9, vertex_bits: 24, guard_bits: 10, coordinate_bits: 11, column_depth: 512 };

const GRID: &str = "[[object]]\nmesh = { kind = \"grid\", cells = [4, 4], size = [2, 2] }\n";
const SPHERE: &str = "[[object]]\nmesh = { kind = \"sphere\", cells = [16, 8] }\n";
const PEAKS: &str = "map = { kind = \"peaks\", size = [128, 128] }\n";
const NOISE: &str = "map = { kind = \"noise\", size = [128, 65] }\n";

/// All of them.
pub fn scenes() -> Vec<FailureScene> {
    let read = |text: &str| parse(text, "scene", Path::new("")).unwrap_or_else(|error| unreachable!("{error}"));
    let of = |name, why, does, text: String| FailureScene { name, why, does, scene: read(&text), format: DEFAULT };
    let view = |camera: &str, cell: f64| format!("[camera]\n{camera}\n[remesh]\ncell_px = {cell}\n");
    let far = "eye = [0, -3, 1.6]\nnear = 0.2\nfar = 40";
    let body = "eye = [0.4, -1.9, 1]\nnear = 0.1\nfar = 20";
    let meshed = |name, why, does, mesh: BaseMesh| {
        let mut made = of(name, why, does, view(far, 4.0) + GRID + PEAKS + "displacement = [0, 0.3]\n");
        made.scene.objects[0].mesh = mesh;
        made
    };
    let mut all = vec![
        of(
            "across z0",
            "projection of what is at or behind the eye",
            "cut by the plane z0 = near / 16, the same for all base triangles; beyond it counted as dropped: near",
            view("eye = [0, -0.6, 0.2]\ntarget = [0, 1, 0]\nnear = 1\nfar = 40", 16.0) + GRID + PEAKS,
        ),
        of(
            "displaced to the eye",
            "den = 1 + d nz / z comes to 0 or below",
            "den <= 2^-8 and c' >= 1 flag the vertex; triangles of flagged vertices are counted and not drawn",
            view("eye = [0, -0.5, 0.55]\ntarget = [0, 0.2, 0]\nnear = 0.5\nfar = 40", 24.0)
                + GRID
                + PEAKS
                + "displacement = [0, 0.8]\n",
        ),
        of(
            "beyond 8192 pixels",
            "X and Y leave their lanes",
            "cut 8190 pixels off the centre, by planes that are the same for all base triangles",
            view("eye = [0, -0.05, 0.06]\ntarget = [0, 1, 0]\nnear = 0.01\nfar = 40", 32.0)
                + "[[object]]\nmesh = { kind = \"grid\", cells = [8, 8], size = [40, 2] }\n"
                + PEAKS
                + "displacement = [0, 0.02]\n",
        ),
        of(
            "edge-on",
            "base triangles without area on the screen; only displacement shows",
            "collinear corners are stitched like any others",
            view("eye = [0, -3, 0]\ntarget = [0, 0, 0]\nnear = 0.2\nfar = 40", 4.0)
                + GRID
                + PEAKS
                + "displacement = [0, 0.4]\n",
        ),
        of(
            "magnified",
            "a thousand voxels a texel",
            "level 0, bilinear, weights of 12 bits; a greater cell_px is what saves work",
            view(far, 2.0) + GRID + "map = { kind = \"peaks\", size = [3, 3] }\ndisplacement = [0, 0.4]\n",
        ),
        of(
            "minified",
            "hundreds of texels a voxel",
            "the last level; it is the map's maximum",
            view("eye = [0, -60, 30]\nnear = 1\nfar = 400", 4.0)
                + GRID
                + "map = { kind = \"noise\", size = [256, 256] }\ndisplacement = [0, 0.4]\n",
        ),
        of(
            "seam and poles",
            "u = 0 and u = 1 are different data along one edge; a pole has as many vertices as columns",
            "coordinates within 2^-6 texel of an end are that end; pole rows have one value in every level",
            view(body, 4.0) + SPHERE + NOISE + "displacement = [-0.05, 0.15]\n",
        ),
        of(
            "coarse voxels",
            "levels jump from vertex to vertex, and voxels are as large as base triangles",
            "level and height are functions of vertex data alone",
            view(body, 40.0) + SPHERE + NOISE + "displacement = [-0.05, 0.15]\n",
        ),
        of(
            "overlapping layers",
            "normals meet inside of the body, and the surface passes through itself",
            "the depth test decides; triangles are lit from either side",
            view(body, 4.0) + SPHERE + NOISE + "displacement = [-0.9, 0]\n",
        ),
        of(
            "16 x 16 pixels",
            "base triangles that lie within one voxel, and pictures that a vertex fills",
            "nothing special",
            view(&format!("{body}\nviewport = [16, 16]"), 1.0) + SPHERE + NOISE,
        ),
        of(
            "4096 x 4096 pixels",
            "the largest picture: coordinates of 13 bits and a sign",
            "nothing special",
            view(&format!("{body}\nviewport = [4096, 4096]"), 32.0) + SPHERE + NOISE,
        ),
        of(
            "ratio 10,000",
            "c has lost 13 bits at the far end",
            "c, u c, v c with 32 bits; seams are warned of beyond 2^24 of texels times ratio",
            view("eye = [0, -0.1, 0.05]\ntarget = [0, 1, 0.04]\nnear = 0.02\nfar = 200", 16.0)
                + "[[object]]\nmesh = { kind = \"grid\", cells = [2, 64], size = [4, 120] }\nat = [0, 60, 0]\n"
                + PEAKS
                + "displacement = [0, 2]\n",
        ),
        meshed(
            "slivers",
            "base triangles a hundredth of a voxel wide",
            "collinear corners are stitched like any others",
            fan(),
        ),
        meshed(
            "coincident corners",
            "base triangles that are edges and points",
            "stitched like any others: they close the edges of their neighbours",
            collapsed(),
        ),
        meshed(
            "opposed normals",
            "n c = 0 half-way along an edge",
            "a normal of length 0 displaces nothing",
            opposed(),
        ),
    ];
    let mut narrow = of(
        "grid too narrow",
        "11 bits of a grid coordinate for what takes 12",
        "base triangles with a corner beyond the grid are counted as dropped: grid",
        view("eye = [0, -3.1, 0.2]\ntarget = [0, 1, 0]\nnear = 0.05\nfar = 40", 1.0)
            + "[[object]]\nmesh = { kind = \"grid\", cells = [2, 16], size = [0.1, 6] }\n"
            + PEAKS,
    );
    narrow.format = SMALL;
    let mut coarse = of(
        "vertices too narrow",
        "24 bits of c over a ratio of 10,000",
        "the error of 24 bits, the same in all triangles round a vertex",
        view("eye = [0, -0.1, 0.05]\ntarget = [0, 1, 0.04]\nnear = 0.02\nfar = 200", 16.0)
            + "[[object]]\nmesh = { kind = \"grid\", cells = [2, 64], size = [4, 120] }\nat = [0, 60, 0]\n"
            + PEAKS
            + "displacement = [0, 2]\n",
    );
    coarse.format = SMALL;
    all.extend([narrow, coarse]);
    all
}

fn vertex(x: f64, y: f64, normal: DVec3) -> BaseMeshVertex {
    BaseMeshVertex { position: DVec3::new(x, y, 0.0), normal, uv: DVec2::new(x / 2.0 + 0.5, 0.5 - y / 2.0) }
}

/// A fan of needles round a corner.
fn fan() -> BaseMesh {
    let needles = 400;
    let at = |k: u32| vertex(-1.0 + 2.0 * f64::from(k) / f64::from(needles), 1.0, DVec3::Z);
    let vertices = std::iter::once(vertex(0.0, -1.0, DVec3::Z)).chain((0..=needles).map(at)).collect();
    BaseMesh { vertices, triangles: (1..=needles).map(|k| [0, k + 1, k]).collect() }
}

/// A square with a row of vertices twice, joined by triangles without area.
fn collapsed() -> BaseMesh {
    let row = |y: f64| (0..=8).map(move |k| vertex(-1.0 + 0.25 * f64::from(k), y, DVec3::Z));
    let vertices = row(-1.0).chain(row(0.0)).chain(row(0.0)).chain(row(1.0)).collect();
    let strip = |from: u32| {
        (0..8).flat_map(move |k| {
            let [a, b, c, d] = [from + k, from + k + 1, from + k + 10, from + k + 9];
            [[a, b, c], [a, c, d]]
        })
    };
    let points = (0..9).map(|k| [9 + k, 18 + k, 9 + k]);
    BaseMesh { vertices, triangles: strip(0).chain(strip(9)).chain(strip(18)).chain(points).collect() }
}

/// Two rows of triangles whose normals point up at one end, and down at the other.
fn opposed() -> BaseMesh {
    let at = |i: u32, j: u32| {
        let normal = if j == 1 { -DVec3::Z } else { DVec3::Z };
        vertex(-1.0 + 0.5 * f64::from(i), -1.0 + f64::from(j), normal)
    };
    let vertices = (0..3).flat_map(|j| (0..5).map(move |i| at(i, j))).collect();
    let cells = (0..2).flat_map(|j| (0..4).map(move |i| 5 * j + i));
    BaseMesh { vertices, triangles: cells.flat_map(|a| [[a, a + 1, a + 6], [a, a + 6, a + 5]]).collect() }
}

/// What came of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// Its edges with every base triangle kept.
    pub whole: Closure,
    /// Its edges as it is drawn, with those culled that cannot be seen.
    pub drawn: Closure,
    /// Distances of the vertices in the picture from their places in f64.
    pub deviation: Deviation,
}

impl Outcome {
    /// Whether an edge is open for no reason.
    pub const fn is_cracked(&self) -> bool {
        self.whole.cracks + self.drawn.cracks > 0
    }
}

/// Draws a scene with its golden models.
///
/// # Errors
/// It does not fit its formats.
pub fn outcome(failure: &FailureScene) -> Result<Outcome, DrawError> {
    let FailureScene { scene, format, .. } = failure;
    let edges = |cull: bool| -> Result<Closure, DrawError> {
        let mut all = Closure::default();
        for object in &scene.objects {
            let mut draw = scene.draw(object, &scene.view(), format)?;
            draw.cull = cull;
            let pyramids = scene.pyramids(object).unwrap_or_else(|error| unreachable!("{error}"));
            all = all.with(&closure(&draw, format, &pyramids));
        }
        Ok(all)
    };
    let of = |error: PlanError| match error {
        PlanError::Draw(_, error) => error,
        error => unreachable!("{error}"),
    };
    let planner = Planner::new(scene, &()).map_err(of)?;
    let trial = planner.try_widths(&Widths { format: *format, levels: usize::MAX }).map_err(of)?;
    Ok(Outcome { whole: edges(false)?, drawn: edges(true)?, deviation: trial.deviation })
}

/// What [rules](crate::rules) make of a closed body at a size of voxels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RuleRow {
    /// The rules.
    pub rules: Rules,
    /// Side of a voxel, pixels.
    pub cell_px: f64,
    /// Its edges with every base triangle kept.
    pub closure: Closure,
    /// Corners that more than one base triangle has.
    pub corners: u64,
    /// Those of them at which the base triangles read different levels.
    pub disputed: u64,
    /// Sides of triangles from a base edge to the inside.
    pub links: u64,
    /// Those of them whose ends read different levels: what shows as a trench along the base edge.
    pub stepped: u64,
}

impl RuleRow {
    /// Whether an edge is open for no reason although the rules forbid it.
    pub const fn is_broken(&self) -> bool {
        self.rules.keeps_closed() && self.closure.cracks > 0
    }
}

/// The rules that are compared, the default first, and sides of a voxel.
pub const RULES: [Rules; 6] = {
    use ExtremumRule::{Max, Min, Triangle, Vertex};
    use FootprintRule::{Density, Exact, Paper};
    let of = [(Density, Max), (Density, Min), (Density, Vertex), (Exact, Max), (Paper, Max), (Density, Triangle)];
    let mut rules = [Rules::DEFAULT; 6];
    let mut k = 0;
    while k < 6 {
        rules[k] = Rules { footprint: of[k].0, extremum: of[k].1 };
        k += 1;
    }
    rules
};
/// The sizes of voxels at which they are compared, pixels.
pub const RULE_CELLS: [f64; 3] = [1.0, 5.0, 20.0];

/// The closed body on which they are compared: a sphere with seam and poles under noise of some texels a pixel.
pub fn rule_body() -> (Scene, Format) {
    let text = "[camera]\neye = [0.8, -3.8, 2]\nnear = 0.1\nfar = 20\n".to_owned()
        + SPHERE
        + "map = { kind = \"noise\", size = [512, 257] }\ndisplacement = [-0.05, 0.15]\n";
    (parse(&text, "scene", Path::new("")).unwrap_or_else(|error| unreachable!("{error}")), DEFAULT)
}

/// All rules on [`rule_body`], on all cores, by cell.
///
/// # Errors
/// It does not fit its formats.
pub fn rule_rows(progress: &dyn Progress) -> Result<Vec<RuleRow>, DrawError> {
    let (scene, format) = rule_body();
    let object = &scene.objects[0];
    let pyramids = scene.pyramids(object).unwrap_or_else(|error| unreachable!("{error}"));
    let work: Vec<(f64, Rules)> = RULE_CELLS.iter().flat_map(|cell| RULES.map(|rules| (*cell, rules))).collect();
    progress.phase("comparing rules", work.len() as u64);
    let done = AtomicU64::new(0);
    let row = |&(cell_px, rules): &(f64, Rules)| {
        let mut draw = scene.draw(object, &CameraView { cell_px, ..scene.view() }, &format)?;
        (draw.cull, draw.rules) = (false, rules);
        let closure = closure(&draw, &format, &pyramids);
        let ((corners, disputed), (links, stepped)) = (disputed(&draw, &format), stepped(&draw, &format));
        progress.advance(done.fetch_add(1, Relaxed) + 1);
        Ok(RuleRow { rules, cell_px, closure, corners, disputed, links, stepped })
    };
    work.par_iter().map(row).collect()
}

/// How many corners several base triangles have, and how many of those they read at different levels, or one at maxima and
/// one at minima. Copies of a corner at one place are one corner.
fn disputed(draw: &Draw, format: &Format) -> (u64, u64) {
    let mut read: FxHashMap<[i32; 3], Vec<(u32, bool)>> = FxHashMap::default();
    for index in 0..draw.triangles.len() {
        let Assembled::Kept(base) = draw.assemble(index) else { continue };
        let ruled = Ruled::new(draw, format, &base);
        for (k, vertex) in draw.triangles[index].iter().enumerate() {
            let level = ruled.request(&base.data[k], Place::Corner(k as u8)).level;
            let at = draw.records[*vertex as usize].position;
            read.entry(at).or_default().push((level, ruled.reads_minima(&base.data[k])));
        }
    }
    let shared = || read.values().filter(|read| read.len() > 1);
    let differ = |read: &&Vec<(u32, bool)>| read.iter().any(|one| *one != read[0]);
    (shared().count() as u64, shared().filter(differ).count() as u64)
}

/// How many sides of triangles lead from a base edge to the inside, and over how many of those the level changes.
fn stepped(draw: &Draw, format: &Format) -> (u64, u64) {
    let (mut links, mut stepped) = (0, 0);
    for index in 0..draw.triangles.len() {
        for piece in draw.assemble(index).pieces() {
            let ruled = Ruled::new(draw, format, piece);
            let mut levels: FxHashMap<Place, u32> = FxHashMap::default();
            observe(format, piece, &mut |step, rung| {
                if step.sends_left() {
                    levels.insert(rung.next_left, ruled.request(&step.left_vertex, rung.next_left).level);
                }
                if step.sends_right() {
                    levels.insert(rung.next_right, ruled.request(&step.right_vertex, rung.next_right).level);
                }
                for places in rung.triangles(step) {
                    for k in 0..3 {
                        let (a, b) = (places[k], places[(k + 1) % 3]);
                        // Either way round; the triangle on the other side of it counts it again.
                        if let (Place::Edge { .. }, Place::Interior { .. })
                        | (Place::Interior { .. }, Place::Edge { .. }) = (a, b)
                        {
                            links += 1;
                            stepped += u64::from(levels[&a] != levels[&b]);
                        }
                    }
                }
            });
        }
    }
    (links, stepped)
}

/// All scenes, on all cores, in their order.
///
/// # Errors
/// One does not fit its formats.
pub fn outcomes(progress: &dyn Progress) -> Result<Vec<(FailureScene, Outcome)>, DrawError> {
    let scenes = scenes();
    progress.phase("drawing", scenes.len() as u64);
    let done = AtomicU64::new(0);
    let draw = |failure: FailureScene| {
        let outcome = outcome(&failure)?;
        progress.advance(done.fetch_add(1, Relaxed) + 1);
        Ok((failure, outcome))
    };
    scenes.into_par_iter().map(draw).collect()
}
