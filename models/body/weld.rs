// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices with the same bits become one.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::{BaseMesh, BaseMeshVertex};

/// The bits of a place; the two zeros are one.
pub(super) fn key(place: DVec3) -> [u64; 3] {
    place.to_array().map(|value| (value + 0.0).to_bits())
}

/// Builds a mesh from triangles of whole vertices.
#[derive(Default)]
pub(super) struct Welder {
    pub(super) mesh: BaseMesh,
    known: FxHashMap<[u64; 8], u32>,
}

impl Welder {
    pub(super) fn triangle(&mut self, corners: [BaseMeshVertex; 3]) {
        let triangle = corners.map(|corner| {
            let ([px, py, pz], [nx, ny, nz]) = (key(corner.position), key(corner.normal));
            let bits = [px, py, pz, nx, ny, nz, corner.uv.x.to_bits(), corner.uv.y.to_bits()];
            *self.known.entry(bits).or_insert_with(|| {
                self.mesh.vertices.push(corner);
                self.mesh.vertices.len() as u32 - 1
            })
        });
        self.mesh.triangles.push(triangle);
    }
}
