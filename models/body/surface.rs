// SPDX-License-Identifier: MIT OR Apache-2.0
//! A base mesh as a function of its place on the map.
//!
//! At a pole, the triangle `(a, b, pole_b)` and the one without area beside it, `(a, pole_b, pole_a)`, share a piece of the
//! map from `ua` to `ub`. All of it goes onto the triangle that has an area, row by row:
//!
//! ```text
//! s = (u - ua) / (ub - ua)    t = (v - vp) / (va + s (vb - va) - vp)    point = pole + t (a + s (b - a) - pole)
//! ```

use glam::{DMat3, DVec2, DVec3, dvec2};
use rustc_hash::FxHashMap;

use super::BaseMesh;

/// A place that is this much outside of a triangle, in its own barycentric coordinates, is on its edge.
const ON_EDGE: f64 = 1e-9;
/// Two places this far apart, against the size of the mesh, are two.
const APART: f64 = 1e-6;
/// Cells of the grid along a side, at most.
const MOST_CELLS: usize = 1024;

/// A point of a base mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Place in the world.
    pub position: DVec3,
    /// Direction of displacement, of length 1.
    pub normal: DVec3,
    /// Whether its base triangle is counterclockwise from outside when v counts downwards; otherwise uv is a mirror image.
    pub upright: bool,
}

/// Why there is no point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPoint {
    /// No base triangle holds the place.
    Uncovered,
    /// Base triangles in different parts of the world do.
    Ambiguous,
}

/// A base mesh whose triangles are sorted by their place on the map.
#[derive(Clone, Debug)]
pub struct Surface<'a> {
    mesh: &'a BaseMesh,
    /// Cells along a side of `[0, 1] x [0, 1]`.
    side: usize,
    cells: Vec<Vec<u32>>,
    apart: f64,
    /// Vertices a, b and pole of the triangles at poles.
    poles: FxHashMap<u32, [u32; 3]>,
}

impl<'a> Surface<'a> {
    /// The surface of a mesh.
    pub fn new(mesh: &'a BaseMesh) -> Self {
        let side = ((mesh.triangles.len() as f64).sqrt() as usize).clamp(1, MOST_CELLS);
        let mut cells = vec![Vec::new(); side * side];
        for (triangle, number) in mesh.triangles.iter().zip(0..) {
            let corners = triangle.map(|corner| mesh.vertices[corner as usize].uv);
            let low = corners.into_iter().fold(DVec2::INFINITY, DVec2::min) - dvec2(ON_EDGE, ON_EDGE);
            let high = corners.into_iter().fold(DVec2::NEG_INFINITY, DVec2::max) + dvec2(ON_EDGE, ON_EDGE);
            let ([x0, y0], [x1, y1]) = (cell(side, low), cell(side, high));
            for y in y0..=y1 {
                cells[y * side + x0..=y * side + x1].iter_mut().for_each(|cell| cell.push(number));
            }
        }
        let reach = |pick: fn(DVec3, DVec3) -> DVec3, from| mesh.vertices.iter().map(|v| v.position).fold(from, pick);
        let size = (reach(DVec3::max, DVec3::NEG_INFINITY) - reach(DVec3::min, DVec3::INFINITY)).max_element();
        Self { mesh, side, cells, apart: APART * size.max(0.0), poles: poles(mesh) }
    }

    /// The point at a place of `[0, 1] x [0, 1]`. Normals are interpolated and normalised.
    ///
    /// # Errors
    /// No base triangle, or more than one that do not meet there, has the place.
    pub fn at(&self, uv: DVec2) -> Result<SurfacePoint, NoPoint> {
        let [x, y] = cell(self.side, uv);
        let mut found: Option<(f64, SurfacePoint)> = None;
        for number in &self.cells[y * self.side + x] {
            let corners = self.mesh.triangles[*number as usize].map(|corner| self.mesh.vertices[corner as usize]);
            let Some((weights, upright)) = barycentric(corners.map(|corner| corner.uv), uv) else { continue };
            let inside = weights.min_element();
            if inside < -ON_EDGE {
                continue;
            }
            let (corners, weights) = self.poles.get(number).map_or((corners, weights), |cone| {
                let corners = cone.map(|corner| self.mesh.vertices[corner as usize]);
                (corners, row_by_row(corners.map(|corner| corner.uv), uv))
            });
            let position = DMat3::from_cols_array_2d(&corners.map(|corner| corner.position.to_array())) * weights;
            let normal = DMat3::from_cols_array_2d(&corners.map(|corner| corner.normal.to_array())) * weights;
            // Opposite normals have no mean; any corner's will do.
            let normal = normal.try_normalize().unwrap_or(corners[0].normal);
            if found.is_some_and(|(_, other)| other.position.distance(position) > self.apart) {
                return Err(NoPoint::Ambiguous);
            }
            if found.is_none_or(|(best, _)| inside > best) {
                found = Some((inside, SurfacePoint { position, normal, upright }));
            }
        }
        found.map(|(_, point)| point).ok_or(NoPoint::Uncovered)
    }
}

/// The triangles at poles, those without area and those beside them.
fn poles(mesh: &BaseMesh) -> FxHashMap<u32, [u32; 3]> {
    let position = |corner: u32| mesh.vertices[corner as usize].position;
    let u = |corner: u32| mesh.vertices[corner as usize].uv.x;
    // The two copies of a pole and the corner across.
    let stitch = |triangle: &[u32; 3]| {
        let turns = [0, 1, 2].map(|k| [0, 1, 2].map(|at| triangle[(at + k) % 3]));
        turns
            .into_iter()
            .find(|[a, p, q]| position(*p) == position(*q) && position(*p) != position(*a) && u(*p) != u(*q))
    };
    let stitches: Vec<_> =
        mesh.triangles.iter().zip(0..).filter_map(|(t, number)| Some((stitch(t)?, number))).collect();
    let by_edge: FxHashMap<[u32; 2], u32> =
        stitches.iter().flat_map(|([a, p, q], number)| [([*a, *p], *number), ([*a, *q], *number)]).collect();
    let mut poles = FxHashMap::default();
    for (triangle, number) in mesh.triangles.iter().zip(0..).filter(|(triangle, _)| stitch(triangle).is_none()) {
        for [a, b, pole] in
            [[0, 1, 2], [1, 0, 2], [1, 2, 0], [2, 1, 0], [2, 0, 1], [0, 2, 1]].map(|at| at.map(|at| triangle[at]))
        {
            // The stitch is on the other side of a, so the pole has the longitude of b.
            if let Some(stitch) = by_edge.get(&[a, pole]).filter(|_| u(b) == u(pole)) {
                poles.extend([(number, [a, b, pole]), (*stitch, [a, b, pole])]);
            }
        }
    }
    poles
}

/// Weights of a, b and the pole.
fn row_by_row([a, b, pole]: [DVec2; 3], at: DVec2) -> DVec3 {
    let s = (at.x - a.x) / (b.x - a.x);
    let t = (at.y - pole.y) / (a.y + s * (b.y - a.y) - pole.y);
    DVec3::new(t * (1.0 - s), t * s, 1.0 - t)
}

fn cell(side: usize, uv: DVec2) -> [usize; 2] {
    uv.to_array().map(|at| ((at * side as f64) as usize).min(side - 1))
}

/// Barycentric coordinates, and whether the triangle is counterclockwise with v downwards; none without area.
fn barycentric([a, b, c]: [DVec2; 3], at: DVec2) -> Option<(DVec3, bool)> {
    let area = (b - a).perp_dot(c - a);
    let weights = DVec3::new((c - b).perp_dot(at - b), (a - c).perp_dot(at - c), (b - a).perp_dot(at - a)) / area;
    weights.is_finite().then_some((weights, area < 0.0))
}
