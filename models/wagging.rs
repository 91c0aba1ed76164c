// SPDX-License-Identifier: MIT OR Apache-2.0
//! Wagging: how the silhouette of a displaced mesh trembles while the camera moves.
//!
//! ```text
//! horizon(column) = least Y' of the displaced triangles at the column's centre         pixels
//! e_f(column)     = horizon of frame f - that of the same frame at a reference cell, unfiltered
//! wagging         = RMS over frames and columns of e_(f+1) - e_f          error = RMS of e
//! ```
//!
//! A silhouette that is off by the same amount in every frame does not show; one that jumps does, wherever voxels and
//! filter levels change from frame to frame (Gumhold & Huettner 1999, section 3.4, on filters and silhouettes).

use crate::displace::displaced;
use crate::displacement_pipeline::golden;
use crate::draw::{Assembled, CameraView, Draw, DrawError, DropReason};
use crate::mesh::Progress;
use crate::plan::MOST_TRIANGLES;
use crate::remesher::{BaseTriangle, Format};
use crate::rules::Rules;
use crate::scene::Scene;
use crate::step::Vertex;
use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// A camera that moves along a line, eye and target together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Frames, at least 2.
    pub frames: u32,
    /// World units a frame.
    pub step: DVec3,
}

/// What a cell and a filter make of a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Wagging {
    /// Side of a voxel, pixels.
    pub cell_px: f64,
    /// Whether levels are read, those of maxima unless the scene has other [rules](crate::rules); the map itself otherwise.
    pub filtered: bool,
    /// Triangles of all frames.
    pub triangles: u64,
    /// Columns of all frames that have a horizon to compare.
    pub columns: u64,
    /// Base triangles of all frames that the voxel grid does not reach; the reference's among them.
    pub beyond_grid: u64,
    /// RMS of the change of the silhouette's error from frame to frame, pixels.
    pub wagging: f64,
    /// RMS of the error, pixels.
    pub error: f64,
    /// Mean of the error, pixels; above the reference it is below 0.
    pub mean: f64,
    /// The greatest change, pixels.
    pub jump: f64,
}

/// The horizon of a frame, by column; infinite where there is none. With its triangles, and the base triangles left out.
type Horizon = (Vec<f64>, u64, u64);

/// Why a path was not measured.
#[derive(Debug, thiserror::Error)]
pub enum WaggingError {
    /// An object, counted from 0, does not fit the formats in some frame.
    #[error("object {0}: {1}")]
    Draw(usize, #[source] DrawError),
    /// More triangles than a frame should have.
    #[error(
        "about {triangles} triangles would come of a frame with cells of {cell_px} px, beyond the limit of {MOST_TRIANGLES}; \
         greater `--cells` are expected"
    )]
    Much {
        /// About so many.
        triangles: u64,
        /// At this cell; the reference has half of the smallest.
        cell_px: f64,
    },
}

/// The cell of the reference, as a share of the smallest one that is compared.
const REFERENCE: f64 = 0.5;

/// Measures each cell with and without filter.
///
/// # Errors
/// A frame does not fit the formats, or is too much.
pub fn measure(
    scene: &Scene,
    path: &Path,
    cells: &[f64],
    format: &Format,
    progress: &dyn Progress,
) -> Result<Vec<Wagging>, WaggingError> {
    let finest = cells.iter().copied().fold(f64::INFINITY, f64::min) * REFERENCE;
    let kinds: Vec<(f64, bool)> =
        std::iter::once((finest, false)).chain(cells.iter().flat_map(|cell| [(*cell, false), (*cell, true)])).collect();
    let frames: Vec<(usize, u32)> =
        (0..kinds.len()).flat_map(|kind| (0..path.frames).map(move |k| (kind, k))).collect();
    progress.phase("drawing", frames.len() as u64);
    let done = AtomicU64::new(0);
    let draw = |(kind, frame): &(usize, u32)| {
        let (cell_px, filtered) = kinds[*kind];
        let way = f64::from(*frame) * path.step;
        let view = scene.view();
        let view = CameraView { eye: view.eye + way, target: view.target + way, cell_px, ..view };
        let made = horizon(scene, &view, filtered, format);
        progress.advance(done.fetch_add(1, Relaxed) + 1);
        made
    };
    let horizons = frames.par_iter().map(draw).collect::<Result<Vec<Horizon>, _>>()?;
    let of = |kind: usize| &horizons[kind * path.frames as usize..(kind + 1) * path.frames as usize];
    Ok((1..kinds.len()).map(|kind| compare(kinds[kind], of(kind), of(0))).collect())
}

fn horizon(scene: &Scene, view: &CameraView, filtered: bool, format: &Format) -> Result<Horizon, WaggingError> {
    let mut top = vec![f64::INFINITY; view.viewport[0] as usize];
    let (mut triangles, mut beyond, mut expected) = (0, 0, 0);
    for (at, object) in scene.objects.iter().enumerate() {
        let mut draw = scene.draw(object, view, format).map_err(|error| WaggingError::Draw(at, error))?;
        if !filtered {
            (draw.level.levels, draw.rules) = (1, Rules::DEFAULT);
        }
        let pyramids = scene.pyramids(object).unwrap_or_else(|error| unreachable!("{error}"));
        let assembled: Vec<Assembled> = (0..draw.triangles.len()).map(|index| draw.assemble(index)).collect();
        expected += assembled.iter().flat_map(Assembled::pieces).map(BaseTriangle::estimate).sum::<u64>();
        if expected > MOST_TRIANGLES {
            return Err(WaggingError::Much { triangles: expected, cell_px: view.cell_px });
        }
        for assembled in &assembled {
            let dropped = |reason: &DropReason| *reason != DropReason::Near;
            beyond += u64::from(matches!(assembled, Assembled::Dropped(reason) if dropped(reason)));
            for piece in assembled.pieces() {
                golden(&draw, format, &pyramids, piece, &mut |triangle| {
                    if Draw::is_drawable(&triangle) {
                        triangles += 1;
                        raise(&mut top, &triangle);
                    }
                });
            }
        }
    }
    Ok((top, triangles, beyond))
}

/// Takes the edges of a triangle into a horizon.
fn raise(top: &mut [f64], triangle: &[Vertex; 3]) {
    let half = top.len() as f64 / 2.0;
    let point = |v: &Vertex| [v[displaced::X] as f64 / 256.0 + half, v[displaced::Y] as f64 / 256.0];
    for k in 0..3 {
        let (mut a, mut b) = (point(&triangle[k]), point(&triangle[(k + 1) % 3]));
        if a[0] > b[0] {
            (a, b) = (b, a);
        }
        // Columns whose centres, at 1/2, lie on the edge.
        let first = (a[0] - 0.5).ceil().max(0.0);
        let last = (b[0] - 0.5).floor().min(top.len() as f64 - 1.0);
        let mut column = first;
        while column <= last {
            let along = if b[0] > a[0] { (column + 0.5 - a[0]) / (b[0] - a[0]) } else { 0.0 };
            let y = a[1] + along * (b[1] - a[1]);
            let at = &mut top[column as usize];
            *at = at.min(y);
            column += 1.0;
        }
    }
}

fn compare((cell_px, filtered): (f64, bool), frames: &[Horizon], reference: &[Horizon]) -> Wagging {
    let error = |frame: usize, column: usize| {
        let (got, want) = (frames[frame].0[column], reference[frame].0[column]);
        (got.is_finite() && want.is_finite()).then_some(got - want)
    };
    let (mut squares, mut sum, mut count) = (0.0, 0.0, 0u64);
    let (mut changes, mut jump, mut pairs) = (0.0, 0.0f64, 0u64);
    for frame in 0..frames.len() {
        for column in 0..frames[frame].0.len() {
            let Some(now) = error(frame, column) else { continue };
            (squares, sum, count) = (squares + now * now, sum + now, count + 1);
            if frame + 1 < frames.len()
                && let Some(next) = error(frame + 1, column)
            {
                let change = next - now;
                (changes, jump, pairs) = (changes + change * change, jump.max(change.abs()), pairs + 1);
            }
        }
    }
    let mean = |sum: f64, count: u64| if count == 0 { 0.0 } else { sum / count as f64 };
    Wagging {
        cell_px,
        filtered,
        triangles: frames.iter().map(|(_, triangles, _)| triangles).sum(),
        columns: count,
        beyond_grid: frames.iter().chain(reference).map(|(.., beyond)| beyond).sum(),
        wagging: mean(changes, pairs).sqrt(),
        error: mean(squares, count).sqrt(),
        mean: mean(sum, count),
        jump,
    }
}
