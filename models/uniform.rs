// SPDX-License-Identifier: MIT OR Apache-2.0
//! Regular grids over a height map: the mesh that knows nothing of the map, and so the baseline of every other.
//!
//! The vertices stand on samples and have their heights; the first and the last row and column are always among them, so
//! the whole map is covered. A cell becomes two triangles, cut from its first sample to its last:
//!
//! ```text
//! (i0, j0) ---- (i1, j0)      (i0, j0) (i1, j0) (i1, j1)
//!     |      \      |
//! (i0, j1) ---- (i1, j1)      (i0, j0) (i1, j1) (i0, j1)
//! ```
//!
//! ```
//! use relief_models::map::{HeightMap, Procedural};
//! use relief_models::uniform;
//! let ramp = HeightMap::procedural(Procedural::Ramp, 9, 5);
//! // Columns 0, 3, 6, 8 and rows 0, 3, 4.
//! assert_eq!(uniform::with_step(&ramp, 3)?.triangles.len(), 2 * 3 * 2);
//! assert_eq!(uniform::with_triangles(&ramp, 17)?.triangles.len(), 2 * 4 * 2);
//! # Ok::<(), uniform::GridError>(())
//! ```

use crate::map::HeightMap;
use crate::mesh::TriangleMesh;

/// Why there is no such grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GridError {
    /// The map has no cell.
    #[error("a map of {width} x {height} samples has no cell; 2 x 2 samples are the least")]
    Map {
        /// Samples in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// No step.
    #[error("a grid with a step of 0 samples has no end; 1 is the least")]
    Step,
    /// Too few triangles.
    #[error("a grid of {0} triangles covers no map; 2 are the least")]
    Triangles(usize),
    /// More vertices than can be numbered.
    #[error("a grid of {0} vertices is too large; 2^32 - 1 are the limit")]
    Vertices(usize),
}

/// The grid of every `step`-th row and column, and of the last ones.
///
/// # Errors
/// A sentence: the step is 0, the map has no cell or too many.
pub fn with_step(map: &HeightMap, step: usize) -> Result<TriangleMesh, GridError> {
    if step == 0 {
        return Err(GridError::Step);
    }
    let along = |side: usize| {
        let last = side.saturating_sub(1);
        (0..last).step_by(step).chain([last]).collect::<Vec<_>>()
    };
    grid(map, &along(map.width), &along(map.height))
}

/// The grid of at most `triangles` triangles that comes nearest to their number, with cells as square as that allows:
/// of `m` columns of cells, column `k` begins at sample `k (width - 1) / m`, rounded.
///
/// # Errors
/// A sentence: fewer than two triangles, or the map has no cell or too many.
pub fn with_triangles(map: &HeightMap, triangles: usize) -> Result<TriangleMesh, GridError> {
    if triangles < 2 {
        return Err(GridError::Triangles(triangles));
    }
    let most = [map.width, map.height].map(|side| side.saturating_sub(1).max(1));
    let [columns, rows] = cells(triangles / 2, most);
    let along = |last: usize, count: usize| {
        (0..=count).map(move |at| ((2 * at as u128 * last as u128 + count as u128) / (2 * count as u128)) as usize)
    };
    let [width, height] = [map.width, map.height].map(|side| side.saturating_sub(1));
    grid(map, &along(width, columns).collect::<Vec<_>>(), &along(height, rows).collect::<Vec<_>>())
}

/// Columns and rows of at most `count` cells, none more than `most`. The longer side is tried from the number on that
/// makes cells square; whichever number within an eighth of it leaves the fewest cells over is taken.
pub fn cells(count: usize, most: [usize; 2]) -> [usize; 2] {
    if count >= most[0].saturating_mul(most[1]) {
        return most;
    }
    let (long, short) = if most[0] >= most[1] { (0, 1) } else { (1, 0) };
    let square = (count as f64 * most[long] as f64 / most[short] as f64).sqrt().round() as usize;
    let reach = square / 8;
    let candidates = square.saturating_sub(reach).max(1)..=square.saturating_add(reach).max(1);
    let fitting = candidates.map(|along| {
        let along = along.min(most[long]).min(count).max(1);
        (along, (count / along).clamp(1, most[short]))
    });
    let best = fitting.max_by_key(|(along, across)| (along * across, std::cmp::Reverse(along.abs_diff(square))));
    let (along, across) = best.unwrap_or((1, 1));
    if long == 0 { [along, across] } else { [across, along] }
}

/// The grid of these columns and rows, ascending, from the first to the last of the map.
fn grid(map: &HeightMap, columns: &[usize], rows: &[usize]) -> Result<TriangleMesh, GridError> {
    let HeightMap { width, height, .. } = *map;
    if width < 2 || height < 2 {
        return Err(GridError::Map { width, height });
    }
    let vertices = columns.len().saturating_mul(rows.len());
    if vertices >= u32::MAX as usize {
        return Err(GridError::Vertices(vertices));
    }
    let mut mesh = TriangleMesh::default();
    mesh.positions.reserve_exact(vertices);
    for j in rows {
        mesh.positions.extend(columns.iter().map(|i| [*i as f64, *j as f64, f64::from(map.sample(*i, *j))]));
    }
    mesh.triangles.reserve_exact(2 * (columns.len() - 1) * (rows.len() - 1));
    for j in 0..rows.len() - 1 {
        for i in 0..columns.len() - 1 {
            let number = |[i, j]: [usize; 2]| (j * columns.len() + i) as u32;
            mesh.triangles.extend(halves([i, i + 1], [j, j + 1]).map(|corners| corners.map(number)));
        }
    }
    Ok(mesh)
}

/// The two triangles of a cell, as columns and rows.
pub(crate) fn halves([i0, i1]: [usize; 2], [j0, j1]: [usize; 2]) -> [[[usize; 2]; 3]; 2] {
    [[[i0, j0], [i1, j0], [i1, j1]], [[i0, j0], [i1, j1], [i0, j1]]]
}
