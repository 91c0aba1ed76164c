// SPDX-License-Identifier: MIT OR Apache-2.0
//! Setup of a base triangle: roles of the corners, remeshing plane, case, and the difference vertices.

use super::edge::{EdgeSetup, divide};
use super::{BaseTriangle, Format};
use crate::fixed::wrap;
use crate::step::{MAX_COMPONENTS, Vertex};
use serde::{Deserialize, Serialize};

/// Where the side corner C lies over the primary edge AB (Gumhold & Huettner 1999, figure 13).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Case {
    /// All three corners are one grid point: one triangle.
    Point,
    /// C is above A and above B: two sub-triangles, one swept from A and one from B, meet in C's column.
    Roof,
    /// A, C, B rise in this order: one sweep from A to the point B, with the upper edge A-C-B.
    Increasing,
    /// As `Increasing` once the sweep direction is mirrored and A and B are swapped, which the setup has done.
    Decreasing,
}

/// What the setup unit hands to the sweep.
///
/// Roles are A, B (ends of the primary edge) and C (side corner). The plane has the axes `sweep` and `side`, mirrored as
/// told; in it A is left of B, and C is not below AB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Setup {
    /// Base edges e0 = P0P1, e1 = P1P2, e2 = P2P0.
    pub edges: [EdgeSetup; 3],
    /// Index of the primary edge: of those whose main axis holds the third corner between the ends, the longest one.
    pub primary: usize,
    /// Corners in the roles A, B, C.
    pub roles: [usize; 3],
    /// Axis of the sweep direction, `0..3`.
    pub sweep: usize,
    /// Axis of the side direction, `0..3`: of the other two the one with the larger projected area, ties the lower one.
    pub side: usize,
    /// The sweep axis is mirrored (only in `Case::Decreasing`).
    pub mirror_sweep: bool,
    /// The side axis is mirrored.
    pub mirror_side: bool,
    /// (column, row) of A, B, C in the mirrored plane, in voxels.
    pub plane: [[i32; 2]; 3],
    /// Twice the area of the triangle in the mirrored plane, in voxels squared, >= 0; 0 for collinear corners.
    pub double_area: i64,
    /// Which sub-triangles there are.
    pub case: Case,
    /// Columns from A to C and from C to B, `K1` and `K2`.
    pub columns: [u32; 2],
    /// Whether the first sub-triangle winds the other way round; the second one of a roof toggles it (amendment A7).
    pub swap: bool,
    /// `Dside`, vertex data per voxel along the (mirrored) side axis, W bits; zero for collinear corners. Without an
    /// interior grid vertex the quotient may exceed W bits and wraps, and nothing reads it.
    pub side_difference: Vertex,
    /// `Dsweep`, vertex data per voxel along the (mirrored) sweep axis, as `side_difference`.
    pub sweep_difference: Vertex,
}

impl Setup {
    /// Computes the setup of `base`, which `format` must accept ([`BaseTriangle::validate`]).
    pub fn new(format: &Format, base: &BaseTriangle) -> Self {
        debug_assert_eq!(base.validate(format), Ok(()), "Setup::new takes a base triangle that fits its format");
        let edges: [EdgeSetup; 3] = std::array::from_fn(|e| EdgeSetup::new(format, base, e));
        let p = |corner: usize, axis: usize| base.corners[corner][axis];
        // Theorem 1: unless all corners coincide, some edge spans the third corner along its own main axis.
        let is_primary = |e: usize| {
            let (a, b, c) = (e, (e + 1) % 3, (e + 2) % 3);
            let axis = edges[e].axis;
            let (low, high) = (p(a, axis).min(p(b, axis)), p(a, axis).max(p(b, axis)));
            edges[e].segments > 0 && (low..=high).contains(&p(c, axis))
        };
        let primary = (0..3)
            .filter(|&e| is_primary(e))
            .reduce(|best, e| if edges[e].segments > edges[best].segments { e } else { best });
        let mut setup = Self {
            edges,
            primary: primary.unwrap_or(0),
            roles: [0, 1, 2],
            sweep: 0,
            side: 1,
            mirror_sweep: false,
            mirror_side: false,
            plane: [[0; 2]; 3],
            double_area: 0,
            case: Case::Point,
            columns: [0; 2],
            swap: false,
            side_difference: [0; MAX_COMPONENTS],
            sweep_difference: [0; MAX_COMPONENTS],
        };
        if primary.is_some() {
            setup.orient(base);
            if setup.double_area > 0 {
                setup.differences(format, base);
            }
        }
        setup
    }

    /// Roles, plane, case and winding.
    fn orient(&mut self, base: &BaseTriangle) {
        let p = |corner: usize, axis: usize| base.corners[corner][axis];
        let s = self.edges[self.primary].axis;
        let (mut a, mut b, c) = (self.primary, (self.primary + 1) % 3, (self.primary + 2) % 3);
        if p(a, s) > p(b, s) {
            (a, b) = (b, a);
        }
        let area = |d: usize| cross([[p(a, s), p(a, d)], [p(b, s), p(b, d)], [p(c, s), p(c, d)]]);
        let [first, second] = [[1, 2], [0, 2], [0, 1]][s];
        let d = if area(second).abs() > area(first).abs() { second } else { first };
        let mirror_side = area(d) < 0;
        let row = |corner: usize| if mirror_side { -p(corner, d) } else { p(corner, d) };
        let decreasing = row(c) < row(a);
        self.case = match () {
            () if decreasing => Case::Decreasing,
            () if row(b) >= row(c) => Case::Increasing,
            () => Case::Roof,
        };
        if decreasing {
            (a, b) = (b, a);
        }
        let column = |corner: usize| if decreasing { -p(corner, s) } else { p(corner, s) };
        self.roles = [a, b, c];
        (self.sweep, self.side) = (s, d);
        (self.mirror_sweep, self.mirror_side) = (decreasing, mirror_side);
        self.plane = self.roles.map(|corner| [column(corner), row(corner)]);
        self.double_area = cross(self.plane);
        self.columns = [self.plane[2][0].abs_diff(self.plane[0][0]), self.plane[1][0].abs_diff(self.plane[2][0])];
        self.swap = b != (a + 1) % 3;
    }

    /// The difference vertices of the plane: the gradient of the vertex data, by Cramer's rule.
    fn differences(&mut self, format: &Format, base: &BaseTriangle) {
        let [a, b, c] = self.roles;
        let w = format.accumulator_bits();
        let span = |role: usize, axis: usize| i128::from(self.plane[role][axis]) - i128::from(self.plane[0][axis]);
        let ([b_column, b_row], [c_column, c_row]) = ([span(1, 0), span(1, 1)], [span(2, 0), span(2, 1)]);
        for k in 0..format.components {
            let difference =
                |to: usize| (i128::from(base.data[to][k]) - i128::from(base.data[a][k])) << format.guard_bits;
            let (fb, fc) = (difference(b), difference(c));
            self.side_difference[k] = wrap(divide(fc * b_column - fb * c_column, self.double_area) as i64, w);
            self.sweep_difference[k] = wrap(divide(fb * c_row - fc * b_row, self.double_area) as i64, w);
        }
    }
}

/// Twice the signed area of the triangle (a, b, c) in the plane.
fn cross([a, b, c]: [[i32; 2]; 3]) -> i64 {
    let span = |to: [i32; 2], axis: usize| i64::from(to[axis]) - i64::from(a[axis]);
    span(b, 0) * span(c, 1) - span(b, 1) * span(c, 0)
}
