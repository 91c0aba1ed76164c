// SPDX-License-Identifier: MIT OR Apache-2.0
//! A scene through the whole pipeline, to pictures, a mesh and a report.
//!
//! ```text
//! host          scene -> constants, vertex memory
//! hardware      mip_build -> levels of the map
//! hardware      vertex_transform -> cull, clip -> base triangles
//! hardware      remesher -> perspective_correct, filter_level -> mip_fetch -> displace -> strip_unit
//! hardware      face_normal -> light -> (golden: rasteriser)
//! ```

mod design;
mod mesh;
mod prepare;

pub use design::{
    CulledReport, DesignError, DesignReport, DrawReport, DroppedReport, LINKS, NoPlaceReport, TimesReport, commands_of,
    expect_drawable, render_by_design,
};
pub use prepare::{MOST_TRIANGLES, Prepared, prepare, width_set};

use crate::pipeline::{self, Pipeline, PipelineError, PipelineRecording};
use mesh::Mesh;
use prepare::PreparedObject;
use relief_models::draw::{self, Draw};
use relief_models::light::Light;
use relief_models::mesh::{InputError, Progress};
use relief_models::raster::{Corner, Frame};
use relief_models::scene::{Entry, Scene};
use relief_models::step::Vertex;
use serde::Serialize;
use std::io::Write;

/// The picture with edges is this many times as large, while it stays within [`EDGES_MOST`].
const EDGES_SCALE: u32 = 2;
const EDGES_MOST: u32 = 2048;

/// Why a scene was not drawn.
#[derive(Debug, thiserror::Error)]
pub enum FrameError {
    /// The mesh cannot be written.
    #[error("the mesh cannot be written: {0}")]
    Output(#[from] std::io::Error),
    /// The hardware is at fault, or cannot be run.
    #[error("{0}")]
    Pipeline(InputError, #[source] Box<PipelineError>),
}

impl FrameError {
    /// Whether the hardware is wrong, rather than the input.
    pub fn is_mismatch(&self) -> bool {
        matches!(self, Self::Pipeline(_, cause) if cause.is_mismatch())
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
    /// The scene's file.
    pub scene: String,
    /// What the hardware ran in: `rust`, or `verilator` behind it.
    pub engine: &'static str,
    /// Its width set: the smallest whose memory holds every map of the scene.
    pub width_set: &'static str,
    /// Cycles of a hundred in which each stream of a draw was held up.
    pub stalls: u8,
    /// Which of all patterns of them.
    pub seed: u32,
    /// Seconds from the reading of the scene to this report.
    pub seconds: f64,
    /// What was printed as warnings.
    pub warnings: Vec<String>,
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
    /// Cycles of the draws for two triangles.
    pub cycles_per_two_triangles: f64,
    /// Vertices displaced for each triangle.
    pub vertices_per_triangle: f64,
    /// Triangles with a vertex without a place: not drawn.
    pub no_place: NoPlaceReport,
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

/// Stages of the pipeline that are golden models, in order.
const GOLDEN: &[&str] = &["raster"];

/// The cycles of the draws of a scene, up to their last strips; light is compared, too, but nothing is drawn.
///
/// # Errors
/// The hardware is at fault.
pub fn cycles(prepared: &Prepared<'_>, pipeline: &mut Pipeline) -> Result<u64, FrameError> {
    for (at, PreparedObject { object, size, draw }) in prepared.objects.iter().enumerate() {
        let fail = |cause: PipelineError| {
            let source = &prepared.scene.source;
            FrameError::Pipeline(source.error(Entry::Object(at), cause.to_string()), Box::new(cause))
        };
        let pyramids = pipeline.build(size, &object.map.samples).map_err(fail)?;
        pipeline.load(draw.rules.reads((&pyramids).into())).map_err(fail)?;
        let assembled = pipeline.assemble(draw).map_err(fail)?;
        let bases: Vec<_> = assembled.iter().flat_map(|assembled| assembled.pieces().to_vec()).collect();
        let lights = lights_of(prepared.scene, draw);
        pipeline.draw(draw, &lights, &bases, &mut None, &mut |_, _, _| {}).map_err(fail)?;
    }
    Ok(pipeline.counts().cycles)
}

/// Takes a scene through the pipeline. `obj` gets the displaced mesh as Wavefront OBJ: a group `base_<I>` for each base
/// triangle, counted over all objects.
///
/// # Errors
/// The hardware is at fault, or `obj` takes no more.
pub fn render(
    prepared: &Prepared<'_>,
    pipeline: &mut Pipeline,
    mut recording: Option<PipelineRecording>,
    obj: &mut dyn Write,
    progress: &dyn Progress,
) -> Result<(Rendered, Option<PipelineRecording>), FrameError> {
    let scene = prepared.scene;
    let [width, height] = scene.camera.viewport;
    let scale = if width.max(height) * EDGES_SCALE <= EDGES_MOST { EDGES_SCALE } else { 1 };
    let mut out = Rendered {
        frame: Frame::new(width, height),
        edges: Frame::new(width * scale, height * scale),
        report: Report { version: 5, golden: GOLDEN.to_vec(), ..Report::default() },
    };
    if scene.lights.len() != 1 {
        // The block has one light.
        out.report.golden.splice(0..0, ["face_normal", "light"]);
    }
    let total = prepared.objects.iter().map(|object| object.draw.triangles.len() as u64).sum();
    progress.phase("drawing", total);
    writeln!(obj, "# displaced mesh, written by relief run")?;
    let mut vertices = 0;
    for (at, PreparedObject { object, size, draw }) in prepared.objects.iter().enumerate() {
        let fail = |cause: PipelineError| {
            FrameError::Pipeline(scene.source.error(Entry::Object(at), cause.to_string()), Box::new(cause))
        };
        let pyramids = pipeline.build(size, &object.map.samples).map_err(fail)?;
        pipeline.load(draw.rules.reads((&pyramids).into())).map_err(fail)?;
        let lights = lights_of(scene, draw);
        // A batch keeps the remesher fed; its base triangles are told apart by their number.
        let (mut bases, mut owners) = (Vec::new(), Vec::new());
        for (index, assembled) in pipeline.assemble(draw).map_err(fail)?.into_iter().enumerate() {
            out.report.assembled.count(&assembled);
            owners.extend(assembled.pieces().iter().map(|_| index));
            bases.extend_from_slice(assembled.pieces());
        }
        let first = out.report.base_triangles;
        let mut mesh = Mesh::new(draw, &mut *obj, vertices, first);
        let (report, frame, edges) = (&mut out.report, &mut out.frame, &mut out.edges);
        pipeline
            .draw(draw, &lights, &bases, &mut recording, &mut |base, triangle, colour| {
                let number = first + owners[base] as u64;
                progress.advance(number);
                mesh.groups_to(number + 1);
                if !Draw::is_drawable(&triangle) {
                    report.no_place.count(&triangle);
                    return;
                }
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
    let counts = pipeline.counts();
    let part = |a: u64, b: u64| if b == 0 { 0.0 } else { a as f64 / b as f64 };
    out.report.pipeline = counts;
    out.report.cycles_per_two_triangles = 2.0 * part(counts.cycles, counts.triangles);
    out.report.vertices_per_triangle = part(counts.vertices, counts.triangles);
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

/// The lights of a scene, as a draw sees them.
fn lights_of(scene: &Scene, draw: &Draw) -> Vec<Light> {
    scene.lights.iter().filter_map(|light| draw.light(light.direction)).collect()
}

/// A displaced vertex for the rasteriser: c' has 31 fraction bits, and 1.0 becomes the largest depth.
fn corner(vertex: Vertex) -> Corner {
    let [x, y, c] = [vertex[0], vertex[1], vertex[2]];
    Corner { x: x as i32, y: y as i32, depth: (2 * c).clamp(0, u32::MAX.into()) as u32 }
}
