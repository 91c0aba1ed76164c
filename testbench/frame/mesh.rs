// SPDX-License-Identifier: MIT OR Apache-2.0
//! The displaced mesh as Wavefront OBJ, written as its triangles come.

use relief_models::draw::Draw;
use relief_models::step::Vertex;
use std::collections::HashMap;
use std::io::Write;

/// Lanes of a displaced vertex that say where it is; they fit 32 bits each.
type Place = [i32; 3];

/// Writes the mesh of an object.
pub(super) struct Mesh<'a> {
    draw: &'a Draw,
    out: &'a mut dyn Write,
    /// Numbers of the points: equal integers are one vertex.
    known: HashMap<Place, u32>,
    pub(super) vertices: u32,
    /// Groups begun, over all objects.
    groups: u64,
    pub(super) error: Option<std::io::Error>,
}

impl<'a> Mesh<'a> {
    /// Behind so many `vertices` and `groups` of the objects before.
    pub(super) fn new(draw: &'a Draw, out: &'a mut dyn Write, vertices: u32, groups: u64) -> Self {
        Self { draw, out, known: HashMap::new(), vertices, groups, error: None }
    }
    fn put(&mut self, line: std::fmt::Arguments<'_>) {
        if self.error.is_none() {
            self.error = self.out.write_fmt(line).err();
        }
    }
    /// Begins the groups below number `end`: those of culled base triangles stay empty.
    pub(super) fn groups_to(&mut self, end: u64) {
        while self.groups < end {
            let group = self.groups;
            self.put(format_args!("g base_{group}\n"));
            self.groups += 1;
        }
    }
    /// Whether the triangle is in the mesh. With two equal corners it is not: both ways along one edge, it closes nothing
    /// and opens nothing. Poles make such triangles.
    pub(super) fn triangle(&mut self, triangle: &[Vertex; 3]) -> bool {
        let [a, b, c] = [0, 1, 2].map(|k| {
            let vertex = &triangle[k];
            let place = [0, 1, 2].map(|lane| vertex[lane] as i32);
            if let Some(number) = self.known.get(&place) {
                return *number;
            }
            let point = self.draw.world(vertex);
            self.put(format_args!("v {} {} {}\n", point.x, point.y, point.z));
            self.vertices += 1;
            self.known.insert(place, self.vertices);
            self.vertices
        });
        let kept = a != b && b != c && c != a;
        if kept {
            self.put(format_args!("f {a} {b} {c}\n"));
        }
        kept
    }
}
