// SPDX-License-Identifier: MIT OR Apache-2.0
//! A scene through the whole pipeline, to pictures, a mesh and a report.
//!
//! ```text
//! host          scene -> constants, vertex memory, pyramid
//! golden        transform, culling -> base triangles
//! hardware      remesher -> (golden: level, texture coordinate) -> mip_fetch -> (golden: displacement) -> strip_unit
//! golden        face normal, light, rasteriser
//! ```

use crate::pipeline::{self, Pipeline, PipelineError, PipelineRecording};
use crate::remesher::format;
use relief_hdl::widths::WidthSet;
use relief_models::draw::{self, Assembled, CameraView, Draw, DrawError, DrawVertex, MapInfo};
use relief_models::light::Material;
use relief_models::mesh::Progress;
use relief_models::mip_build::{self, Centring, Extremum, MipError, Pyramid, Wrap};
use relief_models::raster::{Corner, Frame};
use relief_models::scene::{Object, Scene};
use relief_models::step::Vertex;
use serde::Serialize;
use std::collections::HashMap;
use std::io::Write;

/// Lanes of a displaced vertex that say where it is.
type Place = [i64; 3];

/// The picture with edges is this many times as large, while it stays within [`EDGES_MOST`].
const EDGES_SCALE: u32 = 2;
const EDGES_MOST: u32 = 2048;

/// Why a scene was not drawn.
#[derive(Debug, thiserror::Error)]
pub enum FrameError {
    /// The scene cannot be put into the formats.
    #[error("object {object}: {cause}")]
    Draw {
        /// Which object, counted from 0.
        object: usize,
        /// Why.
        cause: DrawError,
    },
    /// The map has no pyramid.
    #[error("object {object}: the map `{map}`: {cause}")]
    Map {
        /// Which object, counted from 0.
        object: usize,
        /// Its map.
        map: String,
        /// Why.
        cause: MipError,
    },
    /// The map does not fit the memory.
    #[error(
        "object {object}: the map `{map}` needs {needed} words in each of the four banks, and the limit of the width set \
         is {limit}: a smaller map is expected"
    )]
    Memory {
        /// Which object, counted from 0.
        object: usize,
        /// Its map.
        map: String,
        /// Words that it needs.
        needed: usize,
        /// Words that there are.
        limit: usize,
    },
    /// The mesh cannot be written.
    #[error("the mesh cannot be written: {0}")]
    Output(#[from] std::io::Error),
    /// The hardware is at fault, or cannot be run.
    #[error("object {object}: {cause}")]
    Pipeline {
        /// Which object, counted from 0.
        object: usize,
        /// Why.
        cause: PipelineError,
    },
}

impl FrameError {
    /// Whether the hardware is wrong, rather than the input.
    pub const fn is_mismatch(&self) -> bool {
        matches!(self, Self::Pipeline { cause, .. } if cause.is_mismatch())
    }
}

/// What became of a scene.
pub struct Rendered {
    /// Lit and depth-tested.
    pub frame: Frame,
    /// The same with the edges of the triangles, larger where it fits.
    pub edges: Frame,
    /// The figures.
    pub report: Report,
}

/// The figures of a frame.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// Version of this report's fields.
    pub version: u32,
    /// Blocks that ran as hardware, and beats of each that were compared with golden.
    pub hardware: Vec<Block>,
    /// Stages that ran as golden models.
    pub golden: Vec<&'static str>,
    /// Base triangles of the scene.
    pub base_triangles: u64,
    /// What became of them, by reason.
    pub assembled: draw::Counts,
    /// Beats, vertices, triangles and cycles of the hardware.
    pub pipeline: pipeline::Counts,
    /// Triangles with a vertex at or behind the eye: not drawn.
    pub invalid_triangles: u64,
    /// Triangles of which two corners fell on one point: drawn without a pixel, and not in the mesh.
    pub collapsed_triangles: u64,
    /// Triangles that were drawn.
    pub drawn_triangles: u64,
    /// Pixels that they covered, hidden ones included.
    pub fragments: u64,
    /// Pixels that show surface.
    pub pixels: u64,
    /// Output beats or cycles that differed from what was expected.
    pub mismatches: u64,
}

/// A block that ran as hardware.
#[derive(Clone, Debug, Serialize)]
pub struct Block {
    /// Name.
    pub name: &'static str,
    /// Output beats compared with the golden model.
    pub beats: u64,
    /// Cycles that the emitted module followed in Verilator.
    pub followed_cycles: u64,
}

/// Stages of the pipeline that are golden models so far, in order.
const GOLDEN: &[&str] =
    &["vertex_transform", "cull", "perspective_correct", "filter_level", "displace", "face_normal", "light", "raster"];

/// The pyramid of an object's map: maxima on nodes, poles of one height.
///
/// # Errors
/// The map has none, or it does not fit the memory.
pub fn pyramid_of(at: usize, object: &Object, set: &WidthSet) -> Result<Pyramid, FrameError> {
    let map = || object.map_name.clone();
    let wrap = object.wrap;
    let (width, height, samples) = (object.map.width, object.map.height, &object.map.samples);
    let levels = mip_build::max_levels(width, height, Centring::Node, wrap);
    let build = if object.poles { mip_build::golden_with_poles } else { mip_build::golden };
    let pyramid = build(width, height, samples, Centring::Node, wrap, Extremum::Max, levels)
        .map_err(|cause| FrameError::Map { object: at, map: map(), cause })?;
    let (needed, limit) = (pyramid.bank_words(), set.bank_words());
    match needed > limit {
        true => Err(FrameError::Memory { object: at, map: map(), needed, limit }),
        false => Ok(pyramid),
    }
}

/// The draw of an object: constants and vertex memory.
///
/// # Errors
/// It does not fit the formats.
pub fn draw_of(at: usize, scene: &Scene, object: &Object, levels: usize, set: &WidthSet) -> Result<Draw, FrameError> {
    let camera = CameraView {
        eye: scene.camera.eye,
        target: scene.camera.target,
        up: scene.camera.up,
        fov_y: scene.camera.fov_y_deg.to_radians(),
        near: scene.camera.near,
        far: scene.camera.far,
        viewport: scene.camera.viewport,
        cell_px: scene.remesh.cell_px,
    };
    let vertices: Vec<DrawVertex> = object
        .mesh
        .vertices
        .iter()
        .map(|vertex| DrawVertex { position: vertex.position, normal: vertex.normal, uv: vertex.uv })
        .collect();
    let repeat = object.wrap.map(|wrap| wrap == Wrap::Repeat);
    let map = MapInfo { width: object.map.width, height: object.map.height, repeat, levels };
    let draw = Draw::new(&camera, &vertices, &object.mesh.triangles, &map, object.displacement, &format(set));
    let mut draw = draw.map_err(|cause| FrameError::Draw { object: at, cause })?;
    draw.cull = scene.remesh.cull;
    if let Some(colour) = object.colour {
        draw.material = Material::plain(colour);
    }
    Ok(draw)
}

/// Writes the displaced mesh of an object as Wavefront OBJ, as its triangles come.
struct Mesh<'a> {
    draw: &'a Draw,
    out: &'a mut dyn Write,
    /// Numbers of the points: equal integers are one vertex.
    known: HashMap<Place, u64>,
    vertices: u64,
    /// Groups begun, over all objects.
    groups: u64,
    error: Option<std::io::Error>,
}

impl Mesh<'_> {
    fn put(&mut self, line: std::fmt::Arguments<'_>) {
        if self.error.is_none() {
            self.error = self.out.write_fmt(line).err();
        }
    }
    /// Begins the groups below number `end`: those of culled base triangles stay empty.
    fn groups_to(&mut self, end: u64) {
        while self.groups < end {
            let group = self.groups;
            self.put(format_args!("g base_{group}\n"));
            self.groups += 1;
        }
    }
    /// Whether the triangle is in the mesh. With two equal corners it is not: both ways along one edge, it closes nothing
    /// and opens nothing. Poles make such triangles.
    fn triangle(&mut self, triangle: &[Vertex; 3]) -> bool {
        let [a, b, c] = [0, 1, 2].map(|k| {
            let vertex = &triangle[k];
            let place = [vertex[0], vertex[1], vertex[2]];
            if let Some(number) = self.known.get(&place) {
                return *number;
            }
            let point = self.draw.world(vertex);
            self.put(format_args!("v {} {} {}\n", point.x, point.y, point.z));
            self.vertices += 1;
            self.known.insert(place, self.vertices);
            self.vertices
        });
        let kept = a != b && b != c && c != a;
        if kept {
            self.put(format_args!("f {a} {b} {c}\n"));
        }
        kept
    }
}

/// Takes a scene through the pipeline. `obj` gets the displaced mesh as Wavefront OBJ: a group `base_<I>` for each base
/// triangle, counted over all objects.
///
/// # Errors
/// The scene does not fit, the hardware is at fault, or `obj` takes no more.
pub fn render(
    scene: &Scene,
    set: &'static WidthSet,
    pipeline: &mut Pipeline,
    mut recording: Option<PipelineRecording>,
    obj: &mut dyn Write,
    progress: &dyn Progress,
) -> Result<(Rendered, Option<PipelineRecording>), FrameError> {
    // Everything is refused before anything is drawn.
    progress.phase("preparing", 0);
    let mut draws = Vec::new();
    for (at, object) in scene.objects.iter().enumerate() {
        let pyramid = pyramid_of(at, object, set)?;
        draws.push((draw_of(at, scene, object, pyramid.levels.len(), set)?, pyramid));
    }
    let [width, height] = scene.camera.viewport;
    let scale = if width.max(height) * EDGES_SCALE <= EDGES_MOST { EDGES_SCALE } else { 1 };
    let mut out = Rendered {
        frame: Frame::new(width, height),
        edges: Frame::new(width * scale, height * scale),
        report: Report { version: 1, golden: GOLDEN.to_vec(), ..Report::default() },
    };
    let total = draws.iter().map(|(draw, _)| draw.triangles.len() as u64).sum();
    progress.phase("drawing", total);
    writeln!(obj, "# displaced mesh, written by relief run")?;
    let mut vertices = 0;
    for (at, (draw, pyramid)) in draws.iter().enumerate() {
        let fail = |cause| FrameError::Pipeline { object: at, cause };
        pipeline.load(pyramid).map_err(fail)?;
        let lights: Vec<_> = scene.lights.iter().filter_map(|light| draw.light(light.direction)).collect();
        // A batch keeps the remesher fed; its base triangles are told apart by their number.
        let (mut bases, mut owners) = (Vec::new(), Vec::new());
        for index in 0..draw.triangles.len() {
            let assembled = draw.assemble(index);
            out.report.assembled.count(&assembled);
            if let Assembled::Kept(pieces) = assembled {
                owners.extend(std::iter::repeat_n(index, pieces.len()));
                bases.extend(pieces);
            }
        }
        let first = out.report.base_triangles;
        let mut mesh = Mesh { draw, out: &mut *obj, known: HashMap::new(), vertices, groups: first, error: None };
        let (report, frame, edges) = (&mut out.report, &mut out.frame, &mut out.edges);
        pipeline
            .draw(draw, &bases, &mut recording, &mut |base, triangle| {
                let number = first + owners[base] as u64;
                progress.advance(number);
                mesh.groups_to(number + 1);
                if !Draw::is_drawable(&triangle) {
                    report.invalid_triangles += 1;
                    return;
                }
                let colour = draw.shade(triangle, &lights);
                let corners = triangle.map(corner);
                report.drawn_triangles += 1;
                report.fragments += frame.triangle(corners, colour);
                edges.triangle_with_edges(corners.map(|corner| corner.scaled(scale as i32)), colour);
                report.collapsed_triangles += u64::from(!mesh.triangle(&triangle));
            })
            .map_err(fail)?;
        report.base_triangles += draw.triangles.len() as u64;
        mesh.groups_to(report.base_triangles);
        vertices = mesh.vertices;
        mesh.error.map_or(Ok(()), Err)?;
    }
    out.report.pipeline = pipeline.counts();
    out.report.pixels = out.frame.depth.iter().filter(|depth| **depth > 0).count() as u64;
    let followed = pipeline.followed();
    out.report.hardware = pipeline::BLOCKS
        .into_iter()
        .zip(pipeline.compared())
        .enumerate()
        .map(|(k, (name, beats))| Block { name, beats, followed_cycles: followed.get(k).copied().unwrap_or(0) })
        .collect();
    Ok((out, recording))
}

/// A displaced vertex for the rasteriser: c' has 31 fraction bits, and 1.0 becomes the largest depth.
fn corner(vertex: Vertex) -> Corner {
    let [x, y, c]: Place = [vertex[0], vertex[1], vertex[2]];
    Corner { x: x as i32, y: y as i32, depth: (2 * c).clamp(0, u32::MAX.into()) as u32 }
}
