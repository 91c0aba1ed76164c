// SPDX-License-Identifier: MIT OR Apache-2.0
//! Base meshes: closed where their bodies are, and both users of an edge have the same bits, at seams and poles too.

#[path = "body/obj_files.rs"]
mod obj_files;
#[path = "body/shapes.rs"]
mod shapes;
#[path = "body/spherical.rs"]
mod spherical;
#[path = "body/surface.rs"]
mod surface;

use std::collections::HashMap;

use glam::DVec3;
use relief_models::body::{BaseMesh, BaseMeshVertex};

/// The ends of an edge as a triangle has them, ascending, and the direction in which it walks.
type Use = ([BaseMeshVertex; 2], i32);

/// Bits of a place; the two zeros are one.
fn bits(place: DVec3) -> [u64; 3] {
    place.to_array().map(|value| (value + 0.0).to_bits())
}

/// Open edges, vertices of the same place being one. Asserts that all users of an edge have the same normals and `v` at
/// its ends, and that for each pair of `u` it is walked along as often there as back: 0 and 1 are the same, and at a
/// pole the triangle without area passes the edge on from one neighbour's `u` to the other's.
fn check_edges(mesh: &BaseMesh) -> usize {
    let mut users: HashMap<[[u64; 3]; 2], Vec<Use>> = HashMap::new();
    for triangle in &mesh.triangles {
        let corners = triangle.map(|vertex| mesh.vertices[vertex as usize]);
        for side in 0..3 {
            let [from, to] = [corners[side], corners[(side + 1) % 3]];
            let places = [from, to].map(|end| bits(end.position));
            match places[0].cmp(&places[1]) {
                std::cmp::Ordering::Less => users.entry(places).or_default().push(([from, to], 1)),
                std::cmp::Ordering::Greater => {
                    users.entry([places[1], places[0]]).or_default().push(([to, from], -1));
                }
                // Between copies of a pole.
                std::cmp::Ordering::Equal => {}
            }
        }
    }
    let mut open = 0;
    for uses in users.values() {
        let mut net: HashMap<[u64; 2], i32> = HashMap::new();
        for (ends, direction) in uses {
            for (a, b) in uses[0].0.iter().zip(ends) {
                assert_eq!((bits(a.normal), a.uv.y.to_bits()), (bits(b.normal), b.uv.y.to_bits()), "{a:?} {b:?}");
            }
            let turns = ends.map(|end| if end.uv.x == 1.0 { 0.0f64 } else { end.uv.x }.to_bits());
            *net.entry(turns).or_default() += direction;
        }
        if uses.len() == 1 {
            open += 1;
        } else {
            assert!(net.values().all(|net| *net == 0), "{uses:?}");
        }
    }
    open
}

/// What every base mesh keeps.
fn check_vertices(mesh: &BaseMesh) {
    for vertex in &mesh.vertices {
        assert!((vertex.normal.length() - 1.0).abs() < 1e-12, "{vertex:?}");
        assert!((0.0..=1.0).contains(&vertex.uv.x) && (0.0..=1.0).contains(&vertex.uv.y), "{vertex:?}");
        assert!(vertex.position.is_finite(), "{vertex:?}");
    }
    assert!(mesh.triangles.iter().flatten().all(|vertex| (*vertex as usize) < mesh.vertices.len()));
}

fn area(mesh: &BaseMesh) -> f64 {
    let corners = mesh.triangles.iter().map(|triangle| triangle.map(|vertex| mesh.vertices[vertex as usize].position));
    corners.map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
}
