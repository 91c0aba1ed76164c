// SPDX-License-Identifier: MIT OR Apache-2.0
//! The vertical error of a mesh at every sample of a map.
//!
//! Which triangles hold a sample is decided in integers. Corners stand on a lattice of 2^-16 samples (coarser for a map
//! with more than 8,193 samples a side: 2^29 steps have to reach across it); one between its points goes to the nearest,
//! ties to even, and is counted. Twice an area is at most 2^60 then, and an edge function a difference of two such.
//! A sample on an edge belongs to both sides.
//!
//! ```text
//! w_A = (C - B) x (S - B), w_B, w_C alike       S in ABC  <=>  all three >= 0     (A, B, C in positive order)
//! d   = (w_A z_A + w_B z_B + w_C z_C) / (w_A + w_B + w_C) - sample                in doubles
//! max  = greatest |d| over all samples and all triangles that hold them
//! mean = sum |d| / n,  rms = sqrt(sum d^2 / n)      n covered samples; d of the first triangle that holds a sample
//! volume = sum wt d,  sum wt |d|                    wt = 1, 1/2 on a side of the map, 1/4 in a corner
//! ```
//!
//! The volume is the integral over the map's area by the trapezoid rule, in map units times square samples.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;
use serde::Serialize;

use super::{MeasureError, edges};
use crate::map::HeightMap;
use crate::mesh::{Interner, Progress, TriangleMesh};

/// Steps of the lattice that reach across the map, at most.
const REACH: u64 = 1 << 29;
/// Fraction bits of the lattice, at most.
const FRACTION_BITS: u32 = 16;
/// A vertex that is farther from its lattice point, in samples, is counted.
const OFF_LATTICE: f64 = 1e-9;
/// Bands of rows that are worked on separately.
const BANDS: usize = 64;
/// Edges of a numbered vertex are sorted by a number of 31 bits.
const MOST_VERTICES: usize = 1 << 31;

/// The error of a mesh against a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Heights {
    /// Samples in a row, and rows.
    pub size: [usize; 2],
    /// The least and the greatest sample.
    pub range: [u16; 2],
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Different places of vertices.
    pub vertices: usize,
    /// The greatest error of any triangle at any sample.
    pub max: f64,
    /// Column and row of that sample; none where all errors are 0.
    pub max_at: Option<[usize; 2]>,
    /// The mean error of the covered samples; none if there is none.
    pub mean: Option<f64>,
    /// The root of the mean squared error; none if no sample is covered.
    pub rms: Option<f64>,
    /// The integral of the error, positive where the mesh is above the map.
    pub volume_signed: f64,
    /// The integral of the error's magnitude.
    pub volume_absolute: f64,
    /// The integral of the map.
    pub map_volume: f64,
    /// Samples that no triangle holds.
    pub uncovered: u64,
    /// Samples at which triangles have different heights.
    pub several_heights: u64,
    /// Edges with one user that are not on the rim of the map.
    pub open_edges: u64,
    /// Edges with three users or more.
    pub nonmanifold_edges: u64,
    /// Edges with two users in the same direction.
    pub inconsistent_edges: u64,
    /// Triangles that are turned over, those of the rarer orientation being taken for turned.
    pub folded: u64,
    /// Triangles without area, seen from above.
    pub degenerate: u64,
    /// Vertices that are no point of the lattice.
    pub off_lattice: u64,
}

impl Heights {
    /// Whether the mesh covers the map as a height field: nothing uncovered, open, folded or without area.
    pub fn is_whole(&self) -> bool {
        self.uncovered + self.open_edges + self.nonmanifold_edges + self.folded + self.degenerate == 0
    }

    /// Whether the mesh covers the map with no error above `bound`.
    pub fn holds(&self, bound: f64) -> bool {
        self.is_whole() && self.max <= bound
    }
}

/// A vertex on the lattice.
#[derive(Clone, Copy)]
struct Vertex {
    x: i32,
    y: i32,
    z: f64,
}

/// Measures `mesh`, which stands in sample coordinates, at every sample of `map`.
///
/// # Errors
/// A sentence: the map is no surface, or the mesh is none over this map.
pub fn heights(mesh: &TriangleMesh, map: &HeightMap, progress: &dyn Progress) -> Result<Heights, MeasureError> {
    examine(mesh, map, None, progress).map(|(heights, _)| heights)
}

/// The same, and the least of bound less error over all samples, the bound being one of column and row.
///
/// # Errors
/// As [`heights`].
pub fn heights_under(
    mesh: &TriangleMesh,
    map: &HeightMap,
    bound: BoundAt<'_>,
    progress: &dyn Progress,
) -> Result<(Heights, f64), MeasureError> {
    examine(mesh, map, Some(bound), progress)
}

/// A bound at a column and a row.
pub type BoundAt<'a> = &'a (dyn Fn([usize; 2]) -> f64 + Sync);

fn examine(
    mesh: &TriangleMesh,
    map: &HeightMap,
    bound: Option<BoundAt<'_>>,
    progress: &dyn Progress,
) -> Result<(Heights, f64), MeasureError> {
    let (vertices, bits, off_lattice) = on_lattice(mesh, map)?;
    progress.phase("edges", 3 * mesh.triangles.len() as u64);
    // A mesh that gives each triangle vertices of its own is judged by its places.
    let mut places = Interner::new();
    let mut number = Vec::with_capacity(vertices.len());
    for vertex in &vertices {
        // 0 and -0 are one height.
        let key = (vertex.x, vertex.y, (vertex.z + 0.0).to_bits());
        number.push(places.intern(key).unwrap_or(u32::MAX));
    }
    let triangles: Vec<[u32; 3]> =
        mesh.triangles.par_iter().map(|corners| corners.map(|corner| number[corner as usize])).collect();
    drop(number);
    let rim = [map.width, map.height].map(|side| ((side - 1) as i32) << bits);
    let edges = edges::examine(&triangles, |from, to| {
        let (from, to) = (&places.keys[from as usize], &places.keys[to as usize]);
        (from.0 == to.0 && (from.0 == 0 || from.0 == rim[0])) || (from.1 == to.1 && (from.1 == 0 || from.1 == rim[1]))
    });
    drop(triangles);
    let grid = Grid { map, vertices: &vertices, triangles: &mesh.triangles, bits, bound };
    let mut orientation = [0u64; 3];
    for triangle in &mesh.triangles {
        orientation[(grid.corners(*triangle).1.signum() + 1) as usize] += 1;
    }
    let rows = map.height.div_ceil(BANDS);
    let bins = grid.bins(rows);
    let highest = vertices.iter().fold(0.0, |most: f64, vertex| most.max(vertex.z.abs()));
    let tolerance = 1e-9 * (1.0 + highest);
    progress.phase("heights", bins.len() as u64);
    let done = AtomicU64::new(0);
    let tally = |(band, bin): (usize, &Vec<u32>)| {
        let tally = grid.tally(band * rows, rows, bin, tolerance);
        progress.advance(done.fetch_add(1, Ordering::Relaxed) + 1);
        tally
    };
    let tallies: Vec<Tally> = bins.par_iter().enumerate().map(tally).collect();
    let mut total = Tally::default();
    tallies.iter().for_each(|tally| total.join(tally));
    let sums = Sums::new(map, tallies.iter().flat_map(|tally| tally.errors.iter().copied()));
    let found = Heights {
        size: [map.width, map.height],
        range: map.range(),
        triangles: mesh.triangles.len(),
        vertices: places.keys.len(),
        max: total.max,
        max_at: total.max_at.map(|(_, at)| at),
        mean: sums.mean(sums.magnitude),
        rms: sums.mean(sums.squares).map(f64::sqrt),
        volume_signed: sums.volume_signed,
        volume_absolute: sums.volume_absolute,
        map_volume: sums.map_volume,
        uncovered: sums.uncovered,
        several_heights: total.several,
        open_edges: edges.open,
        nonmanifold_edges: edges.nonmanifold,
        inconsistent_edges: edges.inconsistent,
        folded: orientation[0].min(orientation[2]),
        degenerate: orientation[1],
        off_lattice,
    };
    Ok((found, total.slack))
}

/// The vertices on the lattice, its fraction bits, and how many vertices had to move.
fn on_lattice(mesh: &TriangleMesh, map: &HeightMap) -> Result<(Vec<Vertex>, u32, u64), MeasureError> {
    let side = map.width.max(map.height);
    if map.width < 2 || map.height < 2 || side as u64 > REACH {
        let size = format!("{} x {}", map.width, map.height);
        return Err(MeasureError::new(format!(
            "a map of {size} samples is no surface; 2 x 2 to 2^29 a side are expected"
        )));
    }
    if mesh.triangles.is_empty() {
        return Err(MeasureError::new("the mesh has no triangle; there is nothing to measure"));
    }
    if mesh.positions.len() >= MOST_VERTICES {
        return Err(MeasureError::new("the mesh has 2^31 vertices or more, which is not supported"));
    }
    if let Some(wrong) = mesh.triangles.iter().flatten().find(|at| **at as usize >= mesh.positions.len()) {
        let count = mesh.positions.len();
        return Err(MeasureError::new(format!("the mesh names vertex {wrong}, but has {count}, counted from 0")));
    }
    let bits = (REACH / (side as u64 - 1)).ilog2().min(FRACTION_BITS);
    let scale = f64::from(1u32 << bits);
    let last = [map.width, map.height].map(|side| (side - 1) as f64 * scale);
    let mut moved = 0;
    let mut vertices = Vec::with_capacity(mesh.positions.len());
    for (index, [x, y, z]) in mesh.positions.iter().enumerate() {
        let place = [x * scale, y * scale];
        let snapped = place.map(f64::round_ties_even);
        let inside = snapped.iter().zip(last).all(|(value, last)| (0.0..=last).contains(value));
        if !inside || !z.is_finite() {
            let (columns, rows) = (map.width - 1, map.height - 1);
            let (what, expected) = if inside {
                ("no height", "a finite number is".to_owned())
            } else {
                ("outside the map", format!("x, the column, from 0 to {columns} and y, the row, from 0 to {rows} are"))
            };
            let message = format!("vertex {index} (counted from 0) at ({x}, {y}, {z}) has {what}; {expected} expected");
            return Err(MeasureError::new(message.replace("has outside", "is outside")));
        }
        moved += u64::from((0..2).any(|axis| (snapped[axis] - place[axis]).abs() > OFF_LATTICE * scale));
        // Within the map, so at most 2^29.
        vertices.push(Vertex { x: snapped[0] as i32, y: snapped[1] as i32, z: *z });
    }
    Ok((vertices, bits, moved))
}

struct Grid<'a> {
    map: &'a HeightMap,
    vertices: &'a [Vertex],
    triangles: &'a [[u32; 3]],
    bits: u32,
    bound: Option<BoundAt<'a>>,
}

impl Grid<'_> {
    /// The corners of a triangle and twice its signed area.
    fn corners(&self, triangle: [u32; 3]) -> ([Vertex; 3], i64) {
        let corners = triangle.map(|vertex| self.vertices[vertex as usize]);
        let [a, b, c] = corners.map(|corner| (i64::from(corner.x), i64::from(corner.y)));
        (corners, (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0))
    }

    /// The rows that a triangle may hold samples of, the last one inclusive.
    fn rows(&self, triangle: [u32; 3]) -> [usize; 2] {
        let y = triangle.map(|vertex| self.vertices[vertex as usize].y);
        let (low, high) = (y[0].min(y[1]).min(y[2]), y[0].max(y[1]).max(y[2]));
        // Corners are within the map, so neither is negative.
        [((i64::from(low) + (1 << self.bits) - 1) >> self.bits) as usize, (high >> self.bits) as usize]
    }

    /// The triangles of each band of `rows` rows, in the order of the mesh.
    fn bins(&self, rows: usize) -> Vec<Vec<u32>> {
        let mut bins = vec![Vec::new(); self.map.height.div_ceil(rows)];
        for (index, triangle) in self.triangles.iter().enumerate() {
            let [first, last] = self.rows(*triangle);
            // Empty if the triangle lies between two rows.
            if first <= last {
                for bin in &mut bins[first / rows..=last / rows] {
                    bin.push(index as u32);
                }
            }
        }
        bins
    }

    /// The errors in `rows` rows from `top` on. Heights that differ by more than `tolerance` are different.
    fn tally(&self, top: usize, rows: usize, bin: &[u32], tolerance: f64) -> Tally {
        let width = self.map.width;
        let end = (top + rows).min(self.map.height);
        // Of each sample the first error, and the least and the greatest.
        let mut errors = vec![[f64::NAN; 3]; (end - top) * width];
        let mut tally = Tally::default();
        for index in bin {
            let triangle = self.triangles[*index as usize];
            let [first, last] = self.rows(triangle);
            let Some(span) = Span::new(self.corners(triangle), self.bits) else { continue };
            for row in first.max(top)..=last.min(end - 1) {
                let samples = &self.map.samples[row * width..][..width];
                let errors = &mut errors[(row - top) * width..][..width];
                span.each(row, width, |column, height| {
                    let error = height - f64::from(samples[column]);
                    if error.abs() > tally.max || (error.abs() == tally.max && tally.is_later(*index)) {
                        tally.max = error.abs();
                        tally.max_at = Some((*index, [column, row]));
                    }
                    if let Some(bound) = self.bound {
                        tally.slack = tally.slack.min(bound([column, row]) - error.abs());
                    }
                    let known = &mut errors[column];
                    if known[0].is_nan() {
                        *known = [error; 3];
                    } else {
                        *known = [known[0], known[1].min(error), known[2].max(error)];
                    }
                });
            }
        }
        let different = |[_, low, high]: &&[f64; 3]| high - low > tolerance;
        tally.several = errors.iter().filter(different).count() as u64;
        tally.errors = errors.into_iter().map(|[error, ..]| error).collect();
        tally
    }
}

/// A triangle in positive order, to be walked along rows.
struct Span {
    /// Edge functions opposite to each corner: at sample (0, 0), and the step of a row and of a column.
    edges: [[i64; 3]; 3],
    area: i64,
    heights: [f64; 3],
}

impl Span {
    /// `None` for a triangle without area.
    fn new((mut corners, mut area): ([Vertex; 3], i64), bits: u32) -> Option<Span> {
        if area < 0 {
            corners.swap(1, 2);
            area = -area;
        }
        let point = |at: usize| (i64::from(corners[at % 3].x), i64::from(corners[at % 3].y));
        let edges = [0, 1, 2].map(|at| {
            let (from, to) = (point(at + 1), point(at + 2));
            let (x, y) = (to.0 - from.0, to.1 - from.1);
            [y * from.0 - x * from.1, x << bits, -y << bits]
        });
        (area > 0).then(|| Span { edges, area, heights: corners.map(|corner| corner.z) })
    }

    /// Tells the columns of a row that the triangle holds, and its height there.
    fn each(&self, row: usize, width: usize, mut tell: impl FnMut(usize, f64)) {
        let (mut low, mut high) = (0, width as i64 - 1);
        let mut start = [0; 3];
        for (start, [constant, down, right]) in start.iter_mut().zip(self.edges) {
            *start = constant + down * row as i64;
            // start + right * column >= 0
            match right.signum() {
                1 => low = low.max(-start.div_euclid(right)),
                -1 => high = high.min(start.div_euclid(-right)),
                _ if *start < 0 => return,
                _ => {}
            }
        }
        let [a, b, c] = self.heights;
        for column in low..=high {
            let (wa, wb) = (start[0] + self.edges[0][2] * column, start[1] + self.edges[1][2] * column);
            let wc = self.area - wa - wb;
            tell(column as usize, (wa as f64 * a + wb as f64 * b + wc as f64 * c) / self.area as f64);
        }
    }
}

/// What is found in some rows.
struct Tally {
    max: f64,
    /// The least of bound less error.
    slack: f64,
    /// The first triangle with the greatest error, and its first sample.
    max_at: Option<(u32, [usize; 2])>,
    several: u64,
    /// Of each sample the error of the first triangle that holds it; NaN if none does.
    errors: Vec<f64>,
}

impl Default for Tally {
    fn default() -> Self {
        Self { max: 0.0, slack: f64::INFINITY, max_at: None, several: 0, errors: Vec::new() }
    }
}

impl Tally {
    /// Whether the greatest error is of a triangle behind `triangle`.
    fn is_later(&self, triangle: u32) -> bool {
        self.max_at.is_some_and(|(known, _)| known > triangle)
    }

    /// Takes in what is found in the rows below, but for the errors.
    fn join(&mut self, below: &Tally) {
        let as_great = below.max == self.max && below.max_at.is_some_and(|(triangle, _)| self.is_later(triangle));
        if below.max > self.max || as_great {
            (self.max, self.max_at) = (below.max, below.max_at);
        }
        self.slack = self.slack.min(below.slack);
        self.several += below.several;
    }
}

/// Sums over all samples, row by row: their rounding does not depend on the bands.
#[derive(Default)]
struct Sums {
    covered: u64,
    uncovered: u64,
    magnitude: f64,
    squares: f64,
    volume_signed: f64,
    volume_absolute: f64,
    map_volume: f64,
}

impl Sums {
    fn new(map: &HeightMap, errors: impl Iterator<Item = f64>) -> Sums {
        let mut sums = Sums::default();
        let half = |at: usize, side: usize| if at == 0 || at == side - 1 { 0.5 } else { 1.0 };
        for (index, (error, sample)) in errors.zip(&map.samples).enumerate() {
            let weight = half(index % map.width, map.width) * half(index / map.width, map.height);
            sums.map_volume += weight * f64::from(*sample);
            if error.is_nan() {
                sums.uncovered += 1;
                continue;
            }
            sums.covered += 1;
            sums.magnitude += error.abs();
            sums.squares += error * error;
            sums.volume_signed += weight * error;
            sums.volume_absolute += weight * error.abs();
        }
        sums
    }

    /// The mean of a sum over the covered samples.
    fn mean(&self, sum: f64) -> Option<f64> {
        (self.covered > 0).then(|| sum / self.covered as f64)
    }
}
