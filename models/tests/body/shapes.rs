// SPDX-License-Identifier: MIT OR Apache-2.0
//! Grid, cylinder and sphere.

use std::f64::consts::PI;

use glam::{DVec3, dvec2, dvec3};
use relief_models::body::BaseMesh;

use crate::{area, bits, check_edges, check_vertices};

#[test]
fn body_grid_lies_under_its_map() {
    let grid = BaseMesh::grid([4, 2], [2.0, 1.5]);
    check_vertices(&grid);
    assert_eq!((grid.vertices.len(), grid.triangles.len()), (15, 16));
    assert_eq!(check_edges(&grid), 2 * (4 + 2));
    assert!(!grid.is_closed());
    // Row 0 of the map at +y, column 0 at -x.
    assert_eq!((grid.vertices[0].position, grid.vertices[0].uv), (dvec3(-1.0, 0.75, 0.0), dvec2(0.0, 0.0)));
    assert_eq!((grid.vertices[14].position, grid.vertices[14].uv), (dvec3(1.0, -0.75, 0.0), dvec2(1.0, 1.0)));
    for triangle in &grid.triangles {
        let [a, b, c] = triangle.map(|vertex| grid.vertices[vertex as usize].position);
        assert_eq!((b - a).cross(c - a).normalize(), DVec3::Z);
    }
    assert_eq!(area(&grid), 3.0);
}

#[test]
fn body_cylinder_meets_itself_at_the_seam() {
    for columns in [3, 4, 7, 16] {
        let tube = BaseMesh::cylinder([columns, 2], 0.5, 1.0);
        check_vertices(&tube);
        // Open at both ends only.
        assert_eq!(check_edges(&tube), 2 * columns as usize);
        for row in 0..3 {
            let first = row * (columns as usize + 1);
            let (left, right) = (tube.vertices[first], tube.vertices[first + columns as usize]);
            assert_eq!((bits(left.position), bits(left.normal)), (bits(right.position), bits(right.normal)));
            assert_eq!((left.uv.x, right.uv.x, left.uv.y), (0.0, 1.0, right.uv.y));
        }
        for triangle in &tube.triangles {
            let corners = triangle.map(|vertex| tube.vertices[vertex as usize]);
            let [a, b, c] = corners.map(|corner| corner.position);
            assert!((b - a).cross(c - a).dot(corners.iter().map(|corner| corner.normal).sum()) > 0.0);
        }
    }
}

#[test]
fn body_sphere_is_closed() {
    for cells in [[3, 2], [4, 3], [5, 5], [16, 8]] {
        let sphere = BaseMesh::sphere(cells, 0.5);
        check_vertices(&sphere);
        assert_eq!(check_edges(&sphere), 0);
        assert!(sphere.is_closed());
        let columns = cells[0] as usize;
        for i in 0..=columns {
            let (north, south) = (sphere.vertices[i], sphere.vertices[sphere.vertices.len() - 1 - i]);
            assert_eq!(bits(north.position), bits(dvec3(0.0, 0.0, 0.5)));
            assert_eq!(bits(south.position), bits(dvec3(0.0, 0.0, -0.5)));
            assert_eq!([north.uv.y, south.uv.y], [0.0, 1.0]);
        }
        let flat = sphere.triangles.iter().filter(|triangle| {
            let places = triangle.map(|vertex| bits(sphere.vertices[vertex as usize].position));
            places[0] == places[1] || places[1] == places[2] || places[2] == places[0]
        });
        assert_eq!(flat.count(), 2 * columns);
        assert_eq!(sphere.winding_number(DVec3::ZERO, 0.0).round(), 1.0);
        assert!(sphere.winding_number(dvec3(0.6, 0.0, 0.0), 0.0).abs() < 1e-9);
    }
    let sphere = BaseMesh::sphere([64, 32], 0.5);
    assert!((area(&sphere) - PI).abs() < 0.01);
    assert!((sphere.winding_number(dvec3(0.6, 0.0, 0.0), 0.2) - 1.0).abs() < 1e-9);
}
