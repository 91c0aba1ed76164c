// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tessellates a height map by bisection of right isosceles triangles.
//!
//! ```text
//! visit(T):  T has a lattice midpoint m, and error[m] > bound(m):  visit its half at the entry, then the other one
//!            otherwise:                                            emit T
//! bound(m) = base + ((slope * max(0, D(m) - R)) >> 8)      D(m) = max(|u - eye_u|, |v - eye_v|) in half steps
//!                                                          R = 2^(level + 1), 3 2^level when the hypotenuse is a diagonal;
//!                                                          the roots' bound is the base
//! ```
//!
//! The error of a split map is one bit, 1 or 0, under a bound of 0. Saturated errors (at least those of the midpoints of
//! both halves of both triangles round m) serve every bound: R is no less than the way from m to any midpoint below it, so
//! bound(m) never exceeds theirs, and whoever splits below m has split at m: no T-vertex, and nested meshes (Lindstrom and
//! Pascucci 2001, in the maximum norm). Leaf errors are at most base + slope / 256 times the distance from the eye.
//!
//! Halves are walked along the Sierpinski curve: each leaf shares an edge with the one before it, so a leaf costs one new
//! vertex (Pajarola 1998). [`WALKERS`] walkers take turns, two of them begin at the roots; one that has nothing left takes
//! the bottom of another one's stack. Dead triangles ([`Lattice::is_dead`]) are left out, and where that tears a strip a
//! new one starts.
//!
//! | port     | format                  | range |
//! |----------|-------------------------|-------|
//! | error    | unsigned E, [`Errors`]  | whole |
//! | height   | UQ16.4                  | whole |
//! | bound    | UQE.0, slope UQ8.8 a half step, eye in half steps | whole |
//! | triangle | [`Triangle`]            | one a beat |
//!
//! Error: 0; the block copies heights. Example: a map of 2 x 2 is two triangles, (0,0)(1,1)(1,0) and (1,1)(0,0)(0,1).

mod lattice;
mod steering;
mod unit;
mod walkers;

pub use lattice::{Lattice, MAX_SIDE, Node};
pub use steering::{Bound, Errors, SplitMap, Steering};
pub use unit::{Bisector, Command, Output, Vertex};
pub use walkers::{Counts, STACK, Side, Triangle, WALKERS, golden};

use glam::DVec2;

/// Exact reference: the triangles of a map as the definition has them, by recursion over points of the plane.
///
/// `splits` tells it of a lattice point and its triangle's corners a, b and c. Corners are clamped and triangles without
/// area are left out. No stack, no directions, no order: a set to compare with.
pub fn exact(lattice: &Lattice, splits: &dyn Fn(DVec2, [DVec2; 3]) -> bool) -> Vec<[DVec2; 3]> {
    let side = f64::from(lattice.side());
    let [low, high, u, v] = [[0.0, 0.0], [side, side], [side, 0.0], [0.0, side]].map(DVec2::from);
    let roots = if lattice.mirrored { [[v, u, high], [u, v, low]] } else { [[low, high, v], [high, low, u]] };
    let rim = DVec2::new(f64::from(lattice.width - 1), f64::from(lattice.height - 1));
    let (mut triangles, mut waiting) = (Vec::new(), roots.to_vec());
    while let Some([a, b, c]) = waiting.pop() {
        let m = (a + b) / 2.0;
        if m == m.round() && splits(m, [a, b, c]) {
            waiting.extend([[c, a, m], [b, c, m]]);
        } else {
            let corners = [a, b, c].map(|corner| corner.min(rim));
            if (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) != 0.0 {
                triangles.push(corners);
            }
        }
    }
    triangles
}
