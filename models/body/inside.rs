// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a base mesh is closed, and whether a point is inside it.

use std::f64::consts::TAU;

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::BaseMesh;
use super::weld::key;

impl BaseMesh {
    /// Whether every edge is walked along in both directions equally often, vertices of the same place being one.
    pub fn is_closed(&self) -> bool {
        let mut net: FxHashMap<[[u64; 3]; 2], i64> = FxHashMap::default();
        for triangle in &self.triangles {
            let places = triangle.map(|vertex| key(self.vertices[vertex as usize].position));
            for side in 0..3 {
                let (from, to) = (places[side], places[(side + 1) % 3]);
                match from.cmp(&to) {
                    std::cmp::Ordering::Less => *net.entry([from, to]).or_default() += 1,
                    std::cmp::Ordering::Greater => *net.entry([to, from]).or_default() -= 1,
                    std::cmp::Ordering::Equal => {}
                }
            }
        }
        !self.triangles.is_empty() && net.values().all(|net| *net == 0)
    }

    /// How often the mesh goes round `point`, each vertex having moved by `distance` along its normal: 1 inside a closed
    /// body that is oriented outward, 0 outside, between them if it is open.
    pub fn winding_number(&self, point: DVec3, distance: f64) -> f64 {
        let solid_angles = self.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|index| {
                let vertex = &self.vertices[index as usize];
                vertex.position + distance * vertex.normal - point
            });
            let (x, y, z) = (a.length(), b.length(), c.length());
            // Van Oosterom and Strackee 1983: half the solid angle of a triangle.
            2.0 * libm::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
        });
        solid_angles.sum::<f64>() / (2.0 * TAU)
    }
}
