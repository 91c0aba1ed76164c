// SPDX-License-Identifier: MIT OR Apache-2.0
//! Base meshes as functions of the place on the map.

use glam::{DVec2, DVec3, dvec2};
use relief_models::body::{BaseMesh, BaseMeshVertex, NoPoint, Surface};

#[test]
fn surface_goes_through_the_vertices() {
    for mesh in [BaseMesh::grid([3, 5], [2.0, 1.0]), BaseMesh::cylinder([7, 2], 0.5, 1.0)] {
        let surface = Surface::new(&mesh);
        for BaseMeshVertex { position, normal, uv } in &mesh.vertices {
            let found = surface.at(*uv).unwrap();
            assert!(found.position.distance(*position) < 1e-12 && found.normal.distance(*normal) < 1e-9, "{uv}");
        }
        // Halfway along a side.
        let middle = surface.at(dvec2(0.0, 0.5)).unwrap();
        assert!(middle.upright && (middle.normal.length() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn surface_has_area_up_to_the_poles() {
    let mesh = BaseMesh::sphere([12, 6], 0.5);
    let surface = Surface::new(&mesh);
    let n = 96;
    let at = |i: usize, j: usize| surface.at(dvec2(i as f64, j as f64) / n as f64).unwrap().position;
    for i in 0..=n {
        assert_eq!([at(i, 0), at(i, n)], [at(0, 0), at(0, n)], "poles are points");
        assert!(at(i, 0).distance(DVec3::Z / 2.0) < 1e-12);
    }
    let mut area = 0.0;
    for j in 0..n {
        assert!(at(0, j).distance(at(n, j)) < 1e-12, "the seam is closed");
        for i in 0..n {
            let half = |a: DVec3, b: DVec3, c: DVec3| {
                let normal = (b - a).cross(c - a);
                // No fold: the outside is outside.
                assert!(normal.dot(a + b + c) > -1e-12, "{i} {j}");
                normal.length() / 2.0
            };
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            let halves = [half(a, b, c), half(a, c, d)];
            assert!(halves.iter().filter(|half| **half > 1e-9).count() >= if j == 0 || j == n - 1 { 1 } else { 2 });
            area += halves[0] + halves[1];
        }
    }
    let triangles = mesh.triangles.iter().map(|corners| {
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize].position);
        (b - a).cross(c - a).length() / 2.0
    });
    assert!((area - triangles.sum::<f64>()).abs() < 1e-9);
}

#[test]
fn surface_says_where_there_is_none() {
    let vertex = |x: f64, y: f64, u: f64, v: f64| BaseMeshVertex {
        position: DVec3::new(x, y, 0.0),
        normal: DVec3::Z,
        uv: dvec2(u, v),
    };
    // Two triangles apart that use the same half of the map.
    let vertices = vec![
        vertex(0.0, 0.0, 0.0, 0.0),
        vertex(0.0, 1.0, 0.0, 1.0),
        vertex(1.0, 1.0, 1.0, 1.0),
        vertex(5.0, 0.0, 0.0, 0.0),
        vertex(5.0, 1.0, 0.0, 1.0),
        vertex(6.0, 1.0, 1.0, 1.0),
    ];
    let mesh = BaseMesh { vertices, triangles: vec![[0, 1, 2]] };
    let at = |mesh: &BaseMesh, uv: DVec2| Surface::new(mesh).at(uv);
    assert_eq!(at(&mesh, dvec2(0.9, 0.1)), Err(NoPoint::Uncovered));
    assert!(at(&mesh, dvec2(0.25, 0.75)).is_ok_and(|point| point.position == DVec3::new(0.25, 0.75, 0.0)));
    let twice = BaseMesh { triangles: vec![[0, 1, 2], [3, 4, 5]], ..mesh };
    assert_eq!(at(&twice, dvec2(0.25, 0.75)), Err(NoPoint::Ambiguous));
    assert_eq!(at(&BaseMesh::default(), dvec2(0.5, 0.5)), Err(NoPoint::Uncovered));
}
