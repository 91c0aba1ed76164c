// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact reference: vertex data by linear interpolation of the corners, in f64, and positions in exact integers.
//!
//! With 32-bit data an f64 result is off by less than 2^-19 of a unit of the last place.

use super::{BaseTriangle, Place, Setup};
use crate::step::MAX_COMPONENTS;
use glam::DVec3;

/// Barycentric coordinates of `place` with respect to P0, P1, P2, as integers over their own sum, which is positive:
/// 1 for a corner, `n` for an edge vertex, twice the plane's area for an interior vertex.
pub fn barycentric(base: &BaseTriangle, setup: &Setup, place: Place) -> [i64; 3] {
    let mut weights = [0; 3];
    match place {
        Place::Corner(corner) => weights[usize::from(corner)] = 1,
        Place::Edge { edge, index } => {
            let e = &setup.edges[usize::from(edge)];
            weights[e.high] = i64::from(index);
            weights[e.low] = i64::from(e.segments) - i64::from(index);
        }
        Place::Interior { sweep, side } => {
            let corner = |k: usize, axis: usize| i64::from(base.corners[k % 3][axis]);
            let from = |k: usize| [corner(k, setup.sweep) - i64::from(sweep), corner(k, setup.side) - i64::from(side)];
            weights = std::array::from_fn(|k| {
                let ([x, y], [u, v]) = (from(k + 1), from(k + 2));
                x * v - y * u
            });
            if weights.iter().sum::<i64>() < 0 {
                weights = weights.map(|w| -w);
            }
        }
    }
    weights
}

/// Vertex data of `place`, unrounded, in units of the last place of the corners' data.
pub fn vertex(base: &BaseTriangle, setup: &Setup, place: Place) -> [f64; MAX_COMPONENTS] {
    let weights = barycentric(base, setup, place);
    let sum = weights.iter().sum::<i64>() as f64;
    let weights = DVec3::from_array(weights.map(|w| w as f64 / sum));
    std::array::from_fn(|c| weights.dot(DVec3::from_array([0, 1, 2].map(|k| base.data[k][c] as f64))))
}

/// Error bound of `place`, in units of the last place of the vertex data: the rounding of the differences, once an
/// addition, and half a unit of output rounding; none for a corner.
pub fn bound(setup: &Setup, guard_bits: u32, place: Place) -> f64 {
    let additions = match place {
        Place::Corner(_) => return 0.0,
        Place::Edge { edge, .. } => i64::from(setup.edges[usize::from(edge)].segments),
        Place::Interior { sweep, side } => {
            let at = [(sweep, setup.mirror_sweep), (side, setup.mirror_side)];
            let at = at.map(|(x, mirrored)| if mirrored { -i64::from(x) } else { i64::from(x) });
            (at[0] - i64::from(setup.plane[0][0])).abs() + (at[1] - i64::from(setup.plane[0][1])).abs()
        }
    };
    0.5 + additions as f64 * (-f64::from(guard_bits) - 1.0).exp2()
}
