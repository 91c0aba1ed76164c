// SPDX-License-Identifier: MIT OR Apache-2.0
//! OBJ files: what they say is taken, what is wrong is told with its line, and nothing makes the reader panic.

use glam::{DVec3, dvec2};
use proptest::prelude::*;
use relief_models::body::{UvSource, read_obj, read_obj_from};

use crate::check_vertices;

const SQUARE: &str = "# a square\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1 0\nvt 0 1\n\
                      vn 0 0 2\ng base_0\ns off\nf 1/1/1 2/2/1 -2/-2/-1 4/4/1 # a quad\n";

fn refusal(file: &str) -> String {
    read_obj_from(file.as_bytes(), "base.obj", UvSource::File).unwrap_err().to_string()
}

#[test]
fn body_obj_fields_are_taken() {
    let (square, warnings) = read_obj_from(SQUARE.as_bytes(), "base.obj", UvSource::File).unwrap();
    check_vertices(&square);
    assert_eq!(warnings, [] as [&str; 0]);
    assert_eq!(square.triangles, [[0, 1, 2], [0, 2, 3]]);
    // The file counts v from the bottom, we from the top.
    assert_eq!(square.vertices[0].uv, dvec2(0.0, 1.0));
    assert_eq!(square.vertices[2].uv, dvec2(1.0, 0.0));
    assert!(square.vertices.iter().all(|vertex| vertex.normal == DVec3::Z));
}

#[test]
fn body_obj_normals_are_computed_by_area() {
    // A roof: its ridge gets the sum, and both copies of a ridge vertex the same bits.
    let roof = "v 0 -1 0\nv 1 -1 0\nv 0 0 1\nv 1 0 1\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt .5 .5\nf 1/1 2/1 4/1 3/1\nf 3/2 4/2 6/2 5/2\n";
    let (roof, _) = read_obj_from(roof.as_bytes(), "base.obj", UvSource::File).unwrap();
    let ridge: Vec<_> = roof.vertices.iter().filter(|vertex| vertex.position.z == 1.0).collect();
    assert_eq!(ridge.len(), 4);
    assert!(ridge.iter().all(|vertex| vertex.normal.dot(DVec3::Z) > 0.9 && vertex.position.x < 2.0));
    for vertex in &ridge {
        let other = ridge.iter().find(|other| other.position == vertex.position && other.uv != vertex.uv).unwrap();
        assert_eq!(other.normal, vertex.normal);
    }
    let some = SQUARE.replace("4/4/1", "4/4");
    let (_, warnings) = read_obj_from(some.as_bytes(), "base.obj", UvSource::File).unwrap();
    assert_eq!(warnings, ["some corners have no normal (`vn`), so all normals are computed from the surface"]);
    let creased = SQUARE.replace("f 1/1/1", "vn 0 1 1\nf 1/1/2 2/2/1 3/3/1\nf 1/1/1");
    let (_, warnings) = read_obj_from(creased.as_bytes(), "base.obj", UvSource::File).unwrap();
    let expected = "2 places have more than one normal (`vn`), and the displaced surface tears there; \
                    without `vn` they get one each";
    assert_eq!(warnings, [expected]);
}

#[test]
fn body_obj_mistakes_are_told_with_their_line() {
    let line = |number: usize, what: &str| format!("base.obj:{number}: {what}");
    assert_eq!(
        refusal("v 0 0 0\nf 1 2 3\n"),
        line(2, "field 3 `2` names no vertex; 1 have been defined, counted from 1 (or -1 backwards)")
    );
    assert_eq!(
        refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2 3\n"),
        line(4, "field 2 `1/1` names no texture vertex; 0 have been defined, counted from 1 (or -1 backwards)")
    );
    assert_eq!(refusal("v 0 0\n"), line(1, "field 4 is missing; a coordinate is expected"));
    assert_eq!(refusal("v 0 zero 0\n"), line(1, "field 3 `zero` is no number; a coordinate is expected"));
    for value in ["nan", "inf", "-inf", "1e10", "1e999"] {
        let expected = format!("field 3 `{value}` is not a finite number up to 1e9; a coordinate is expected");
        assert_eq!(refusal(&format!("\nv 0 {value} 0\n")), line(2, &expected));
    }
    let zero = "is a normal without length; one that points outward is expected";
    assert_eq!(refusal("vn 0 0 0\n"), line(1, zero));
    assert_eq!(refusal("v 0 0 0\nf 1 1\n"), line(2, "a face of 2 corners is no polygon; at least 3 are expected"));
    let statement = "`\\u{7f}ELF` is no OBJ statement; `v`, `vt`, `vn`, `f` or the like is expected";
    assert_eq!(refusal("\x7fELF"), line(1, statement));
    assert_eq!(refusal(""), "base.obj: has no face (`f`); a base mesh needs one at least");
    let without = "base.obj: has a face without texture vertices (`vt`), so nothing says where the map lies; \
                   `uv = \"spherical\"` in the scene asks for longitude and latitude";
    assert_eq!(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), without);
    let doubled = refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf 1/1 3/1 2/1\n");
    assert!(doubled.starts_with("base.obj: [0, 0, 0] has no normal: "), "{doubled}");
}

#[test]
fn body_obj_files_that_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let missing = read_obj(&folder.path().join("none.obj"), UvSource::File).unwrap_err();
    assert!(missing.message.starts_with("cannot be opened: "), "{missing}");
    let error = read_obj(folder.path(), UvSource::File).unwrap_err();
    assert_eq!(error.message, "is a folder; an OBJ file is expected");
    let path = folder.path().join("base.obj");
    std::fs::write(&path, SQUARE).unwrap();
    assert_eq!(read_obj(&path, UvSource::File).unwrap().0.triangles.len(), 2);
}

/// Reads bytes both ways. A mesh is in order, and an error has something to say.
fn survive(bytes: &[u8]) {
    for uv in [UvSource::File, UvSource::Spherical] {
        match read_obj_from(bytes, "base.obj", uv) {
            Ok((mesh, _)) => {
                assert!(mesh.triangles.iter().flatten().all(|vertex| (*vertex as usize) < mesh.vertices.len()));
                for vertex in &mesh.vertices {
                    assert!(vertex.position.is_finite() && vertex.normal.is_normalized() && vertex.uv.is_finite());
                }
            }
            Err(error) => assert!(error.message.len() > 20, "{error}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn body_obj_reader_survives_any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        survive(&bytes);
    }

    #[test]
    fn body_obj_reader_survives_words_of_the_format(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "v", "vt", "vn", "f", "g", "\n", "\n", "0", "1", "-1", "2", "3", "0.5", "1e300", "1e-300", "nan", "1/1",
                "1//1", "2/1/1", "/", "//", "1/2/3/4", "99999999999999999999", "-9223372036854775808", "#", "\\",
                "v 0 0 0\n", "v 1 0 0\n", "v 0 1 0\n", "v 0 0 1\n", "v 1e-200 0 0\n", "vt 0 0\n", "vn 0 0 1\n",
                "f 1 2 3\n", "f -1 -2 -3\n", "f -1/-1 -2/-1 -3/-1 -4/-1\n", "f -1//-1 -2//-1 -3//-1\n",
            ]),
            0..60,
        ),
    ) {
        survive(words.join(" ").as_bytes());
    }

    #[test]
    fn body_obj_reader_survives_damaged_files(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0u8..4), 1..6),
    ) {
        let mut bytes = SQUARE.as_bytes().to_vec();
        for (index, byte, how) in changes {
            let place = index.index(bytes.len().max(1));
            match how {
                _ if bytes.is_empty() => {}
                0 => bytes[place] = byte,
                1 => bytes.insert(place, byte),
                2 => drop(bytes.remove(place)),
                _ => bytes.truncate(place),
            }
        }
        survive(&bytes);
    }

    #[test]
    fn body_obj_small_integer_meshes_are_wrapped_or_refused(
        corners in prop::collection::vec(prop::array::uniform3(-2i8..3), 4..9),
        faces in prop::collection::vec(prop::array::uniform3(0usize..9), 1..12),
    ) {
        let mut file = String::from("vn 0 0 1\n");
        for [x, y, z] in &corners {
            file += &format!("v {x} {y} {z}\n");
        }
        for face in faces {
            let [a, b, c] = face.map(|corner| corner % corners.len() + 1);
            file += &format!("f {a}//1 {b}//1 {c}//1\n");
        }
        survive(file.as_bytes());
    }
}
