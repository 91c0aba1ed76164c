// SPDX-License-Identifier: MIT OR Apache-2.0
//! Grid, cylinder and sphere: quads in rows of columns, each cut along the same diagonal.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec2, dvec3};

use super::{BaseMesh, BaseMeshVertex};

impl BaseMesh {
    /// A rectangle on z = 0 round the origin, `cells` and `size` along x and y.
    pub fn grid(cells: [u32; 2], size: [f64; 2]) -> BaseMesh {
        lattice(cells, |_, _, uv| {
            let position = dvec3((uv.x - 0.5) * size[0], (0.5 - uv.y) * size[1], 0.0);
            BaseMeshVertex { position, normal: DVec3::Z, uv }
        })
    }

    /// A tube round the z axis, open at both ends; `cells` round it (3 at least) and along it.
    pub fn cylinder(cells: [u32; 2], radius: f64, height: f64) -> BaseMesh {
        lattice(cells, |i, _, uv| {
            let normal = around(i, cells[0]);
            BaseMeshVertex { position: radius * normal + DVec3::Z * ((0.5 - uv.y) * height), normal, uv }
        })
    }

    /// A sphere round the origin; `cells` in longitude (3 at least) and latitude (2 at least).
    pub fn sphere(cells: [u32; 2], radius: f64) -> BaseMesh {
        lattice(cells, |i, j, uv| {
            let normal = if j == 0 {
                DVec3::Z
            } else if j == cells[1] {
                DVec3::NEG_Z
            } else {
                let (sin, cos) = libm::sincos(PI * uv.y);
                sin * around(i, cells[0]) + cos * DVec3::Z
            };
            BaseMeshVertex { position: radius * normal, normal, uv }
        })
    }
}

/// The direction of a column; the last one is the first one, bit for bit.
fn around(column: u32, columns: u32) -> DVec3 {
    let (sin, cos) = libm::sincos(TAU * f64::from(column % columns) / f64::from(columns));
    dvec3(cos, sin, 0.0)
}

/// Vertices in rows from the top (v = 0), and two triangles a quad. The diagonal runs from bottom left to top right, so
/// that the quads at a pole become one triangle with area and one without.
fn lattice([columns, rows]: [u32; 2], vertex: impl Fn(u32, u32, DVec2) -> BaseMeshVertex) -> BaseMesh {
    let mut mesh = BaseMesh::default();
    for j in 0..=rows {
        for i in 0..=columns {
            let uv = dvec2(f64::from(i) / f64::from(columns), f64::from(j) / f64::from(rows));
            mesh.vertices.push(vertex(i, j, uv));
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            let top = j * (columns + 1) + i;
            let bottom = top + columns + 1;
            mesh.triangles.push([bottom, bottom + 1, top + 1]);
            mesh.triangles.push([bottom, top + 1, top]);
        }
    }
    mesh
}
