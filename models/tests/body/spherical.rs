// SPDX-License-Identifier: MIT OR Apache-2.0
//! Longitude and colatitude for OBJ bodies: closed, whatever edges and triangles the seam and the axis meet.

use std::fmt::Write;

use glam::{DQuat, DVec3, dvec3};
use proptest::prelude::*;
use relief_models::body::{BaseMesh, UvSource, read_obj_from};

use crate::{area, check_edges, check_vertices};

type Body = (Vec<DVec3>, Vec<Vec<usize>>);

fn octahedron() -> Body {
    let corners = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let faces = (0..4).flat_map(|i| [vec![i, (i + 1) % 4, 4], vec![(i + 1) % 4, i, 5]]).collect();
    (corners.to_vec(), faces)
}

/// In squares, so that the axis meets the middle of a diagonal.
fn cube() -> Body {
    let corners = (0..8).map(|i| {
        let side = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        dvec3(side(0), side(1), side(2))
    });
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    (corners.collect(), faces.map(|face| face.to_vec()).to_vec())
}

fn tetrahedron() -> Body {
    let corners = [dvec3(1.0, 1.0, 1.0), dvec3(1.0, -1.0, -1.0), dvec3(-1.0, 1.0, -1.0), dvec3(-1.0, -1.0, 1.0)];
    (corners.to_vec(), vec![vec![0, 1, 2], vec![0, 2, 3], vec![0, 3, 1], vec![1, 3, 2]])
}

fn file((corners, faces): &Body, place: impl Fn(DVec3) -> DVec3) -> String {
    let mut file = String::new();
    for corner in corners {
        let corner = place(*corner);
        writeln!(file, "v {} {} {}", corner.x, corner.y, corner.z).unwrap();
    }
    for face in faces {
        let corners: String = face.iter().map(|corner| format!(" {}", corner + 1)).collect();
        writeln!(file, "f{corners}").unwrap();
    }
    file
}

fn mesh(file: &str) -> BaseMesh {
    let (mesh, warnings) = read_obj_from(file.as_bytes(), "body.obj", UvSource::Spherical).unwrap();
    assert_eq!(warnings, [] as [&str; 0]);
    mesh
}

/// Closed, of the same area, every triangle in one half, and both poles and the seam there.
fn check(mesh: &BaseMesh, expected_area: f64) {
    check_vertices(mesh);
    assert_eq!(check_edges(mesh), 0);
    assert!(mesh.is_closed());
    assert!((area(mesh) / expected_area - 1.0).abs() < 1e-9, "{} for {expected_area}", area(mesh));
    for triangle in &mesh.triangles {
        let us = triangle.map(|vertex| mesh.vertices[vertex as usize].uv.x);
        assert!(us.iter().all(|u| *u <= 0.5) || us.iter().all(|u| *u >= 0.5), "{us:?}");
    }
    for pole in [0.0, 1.0] {
        let copies: Vec<_> = mesh.vertices.iter().filter(|vertex| vertex.uv.y == pole).collect();
        assert!(copies.len() >= 4, "{} copies of a pole", copies.len());
        assert!(copies.iter().all(|copy| copy.position == copies[0].position && copy.normal == copies[0].normal));
    }
    let turns = [0.0, 1.0].map(|u| mesh.vertices.iter().filter(|vertex| vertex.uv.x == u).count());
    assert!(turns[0] == turns[1] && turns[0] >= 3, "{turns:?} vertices at the seam");
}

#[test]
fn body_spherical_bodies_with_the_axis_anywhere() {
    // The axis through corners, the seam along edges: nothing to cut, but four copies of each pole and four stitches.
    let plain = mesh(&file(&octahedron(), |corner| corner));
    check(&plain, 4.0 * 3f64.sqrt());
    assert_eq!(plain.triangles.len(), 16);
    // The same elsewhere, where the rounded centroid misses the axis and the plane of the seam by some 1e-17.
    for place in [dvec3(0.1, 0.7, 0.3), dvec3(1.1, -0.3, 0.2), dvec3(1e3 / 3.0, 0.1, 1e5 / 7.0)] {
        assert_eq!(mesh(&file(&octahedron(), |corner| corner + place)).triangles.len(), 16);
    }
    // The axis through edges, and through the middles of triangles.
    check(&mesh(&file(&cube(), |corner| corner)), 24.0);
    check(&mesh(&file(&tetrahedron(), |corner| corner)), 8.0 * 3f64.sqrt());
    let turned = DQuat::from_rotation_arc(dvec3(1.0, 1.0, 1.0).normalize(), DVec3::Z);
    check(&mesh(&file(&tetrahedron(), |corner| turned * corner)), 8.0 * 3f64.sqrt());
    check(&mesh(&file(&octahedron(), |corner| turned * corner)), 4.0 * 3f64.sqrt());
    check(&mesh(&file(&cube(), |corner| turned * corner + dvec3(5.0, -7.0, 0.1))), 24.0);
}

#[test]
fn body_spherical_refuses_what_has_no_longitude() {
    let refusal = |file: &str| read_obj_from(file.as_bytes(), "body.obj", UvSource::Spherical).unwrap_err().to_string();
    // Two tetrahedra that share the centroid as a corner.
    let through =
        "v 0 0 0\nv 1 0 1\nv 1 1 1\nv 1 0 2\nv -1 0 -1\nv -1 -1 -1\nv -1 0 -2\nf 1 2 3\nf 1 5 6\nf 2 3 4\nf 5 6 7";
    let expected = "body.obj: goes through its own centroid, which has neither longitude nor latitude: [0, 0, 0]; \
                    spherical `uv` is for bodies round their centroid";
    assert_eq!(refusal(through), expected);
    let point = "v 1 1 1\nv 1 1 1\nv 1 1 1\nvn 0 0 1\nf 1//1 2//1 3//1\n";
    assert!(refusal(point).contains("goes through its own centroid"), "{}", refusal(point));
    // A wall along the axis, and bulk that keeps the centroid off it.
    let wall = "v 0 0 1\nv 0 0 -1\nv 1 0 2\nv -1 0 -2\nf 1 2 3\nf 2 1 4\n";
    assert!(refusal(wall).contains("along the axis through its centroid"), "{}", refusal(wall));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn body_spherical_is_closed_under_any_rotation(
        which in 0usize..3,
        turn in prop::array::uniform4(-1.0f64..1.0).prop_filter("no turn", |turn| turn.iter().any(|t| t.abs() > 0.1)),
        centre in prop::array::uniform3(-3.0f64..3.0),
        stretch in prop::array::uniform3(0.2f64..3.0),
    ) {
        let body = [octahedron(), cube(), tetrahedron()][which].clone();
        let turn = DQuat::from_array(turn).normalize();
        let place = |corner: DVec3| turn * (corner * DVec3::from(stretch)) + DVec3::from(centre);
        let file = file(&body, place);
        let fan = |face: &Vec<usize>| {
            let at = |k: usize| place(body.0[face[k]]);
            (1..face.len() - 1).map(|k| (at(k) - at(0)).cross(at(k + 1) - at(0)).length() / 2.0).sum::<f64>()
        };
        check(&mesh(&file), body.1.iter().map(fan).sum());
    }
}
