// SPDX-License-Identifier: MIT OR Apache-2.0
//! Base meshes: the coarse triangles that a height map displaces, in `f64`, before they become vertex memory.
//!
//! Triangles are counterclockwise seen from the side that the normals point to. `u` and `v` cover one period of the map
//! from 0 to 1, `v = 0` being its top row. Where a body meets itself in `u`, its vertices are there twice, with `u = 0`
//! and `u = 1`, and the rest of them is equal bit for bit:
//!
//! ```text
//! grid       x = (u - 1/2) sx    y = (1/2 - v) sy    z = 0                      normal +z
//! cylinder   x = r cos 2 pi u    y = r sin 2 pi u    z = (1/2 - v) h            normal outward, no caps
//! sphere     longitude 2 pi u from +x over +y, colatitude pi v from +z          one copy of a pole for each column
//! OBJ        as the file says, or longitude and colatitude round its centroid ([`UvSource::Spherical`])
//! ```
//!
//! A pole has no longitude of its own. It is there once for each neighbour, with the neighbour's `u`: beside the triangle
//! `(a, b, pole_b)` stands the triangle without area `(a, pole_b, pole_a)`, which stitches the copies together.
//!
//! ```
//! use relief_models::body::BaseMesh;
//! let sphere = BaseMesh::sphere([16, 8], 0.5);
//! assert_eq!((sphere.vertices.len(), sphere.triangles.len()), (17 * 9, 2 * 16 * 8));
//! assert!(sphere.is_closed());
//! ```

use glam::{DVec2, DVec3};

mod corners;
mod inside;
mod normals;
mod obj;
mod shapes;
mod spherical;
mod surface;
mod weld;

pub use obj::{UvSource, read_obj, read_obj_from};
pub use surface::{NoPoint, Surface, SurfacePoint};

/// A vertex of a base mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseMeshVertex {
    /// Place in the world.
    pub position: DVec3,
    /// Direction of displacement, of length 1.
    pub normal: DVec3,
    /// Place on the map: `[0, 1]` is one period, `v = 0` the top row.
    pub uv: DVec2,
}

/// Triangles to be displaced.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BaseMesh {
    /// The vertices, each of which has one displacement.
    pub vertices: Vec<BaseMeshVertex>,
    /// Three vertices each, counterclockwise from outside; some without area at poles.
    pub triangles: Vec<[u32; 3]>,
}
