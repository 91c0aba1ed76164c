// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cuts base triangles at the constant planes: z0 and the guard band.
//!
//! ```text
//! polygon after plane k = vertices with distance_k >= 0, and the points of edges at which it is 0, in order
//! point = a + (b - a) d_a / (d_a - d_b), every lane rounded half up
//! ```
//!
//! The planes are the same for all base triangles, and a cut is a function of its edge alone, so neighbours stay closed (Sutherland &
//! Hodgman 1974; amendment of Gumhold & Huettner 1999, section 2.3). Lanes are those of
//! [`ViewVertex`], distances those of [`distance`].
//!
//! Error: half a unit of each lane for each plane, and for the vertices that it is cut from.
//!
//! Example: ends at z = z0 - 1 and z0 + 3, x = 0 and 100 -> z = z0, x = 25.

use crate::fixed::divide_round_half_up;
use crate::vertex_transform::{Constants, ViewVertex, distance};

/// Constant planes.
pub const PLANES: usize = 5;

/// Vertices of a polygon, at most. An exact one has eight; rounding makes more only where a plane passes within a unit of
/// several vertices, and a seventeenth is left out.
pub const PLACES: usize = 16;

/// What the constant planes leave of a triangle: a convex polygon, or fewer than three vertices.
pub fn golden(constants: &Constants, corners: [ViewVertex; 3]) -> Vec<ViewVertex> {
    (0..PLANES).fold(corners.to_vec(), |polygon, plane| {
        let at: Vec<i64> = polygon.iter().map(|v| distance(constants, plane, v.position)).collect();
        if at.iter().all(|d| *d >= 0) { polygon } else { behind(&polygon, &at) }
    })
}

/// What a plane leaves of a polygon whose vertices have the distances `at` from it.
fn behind(polygon: &[ViewVertex], at: &[i64]) -> Vec<ViewVertex> {
    let mut left = Vec::with_capacity(PLACES);
    for (k, vertex) in polygon.iter().enumerate() {
        let next = (k + 1) % polygon.len();
        if at[k] >= 0 && left.len() < PLACES {
            left.push(*vertex);
        }
        if (at[k] < 0 && at[next] > 0 || at[k] > 0 && at[next] < 0) && left.len() < PLACES {
            left.push(cut(vertex, &polygon[next], at[k], at[next]));
        }
    }
    left
}

/// `floor(a + (b - a) (0 - at_a) / (at_b - at_a) + 1/2)`, in one division.
fn between(a: i64, b: i64, at_a: i64, at_b: i64) -> i64 {
    // Values below 2^47 times distances below 2^62, twice: below 2^111. The quotient lies between a and b.
    let (mut over, mut under) =
        (i128::from(a) * i128::from(at_b) - i128::from(b) * i128::from(at_a), i128::from(at_b) - i128::from(at_a));
    if under < 0 {
        (over, under) = (-over, -under);
    }
    divide_round_half_up(over, under) as i64
}

/// The point of the edge `a b` on a plane from which its ends have the distances `at_a` and `at_b` of opposite signs.
///
/// A function of the edge, whichever way round it comes: the ends are put in the order of their positions first.
pub fn cut(a: &ViewVertex, b: &ViewVertex, at_a: i64, at_b: i64) -> ViewVertex {
    let ((a, at_a), (b, at_b)) = if a.position <= b.position { ((a, at_a), (b, at_b)) } else { ((b, at_b), (a, at_a)) };
    let mix = |a: i64, b: i64| between(a, b, at_a, at_b);
    ViewVertex {
        position: std::array::from_fn(|k| mix(a.position[k], b.position[k])),
        normal: std::array::from_fn(|k| mix(a.normal[k], b.normal[k])),
        texel: std::array::from_fn(|k| mix(a.texel[k], b.texel[k])),
        density: mix(a.density, b.density),
    }
}

/// The exact point of the edge `a b`, in units of the last place.
pub fn exact(a: &ViewVertex, b: &ViewVertex, at_a: i64, at_b: i64) -> [f64; 9] {
    let lanes = |v: &ViewVertex| {
        let [x, y, z] = v.position;
        let [nx, ny, nz] = v.normal;
        [x, y, z, nx, ny, nz, v.texel[0], v.texel[1], v.density].map(|k| k as f64)
    };
    let t = at_a as f64 / (at_a as f64 - at_b as f64);
    let (a, b) = (lanes(a), lanes(b));
    std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t)
}
