// SPDX-License-Identifier: MIT OR Apache-2.0
//! The readers: formats agree with each other, numbers are exact, mistakes are told with their place, nothing panics.

use proptest::prelude::*;
use relief_models::mesh::{CheckOptions, FailureKind, Format, Place, check, read};

use crate::tilings::{SQUARE, TETRAHEDRON, Tiling, failures, tiling};
use crate::writers::{Ply, base_obj, obj, parse, ply, report, text};

#[test]
fn mesh_formats_agree() {
    let mut tiling = Tiling::regular(8, &TETRAHEDRON, 4);
    for broken in [false, true] {
        if broken {
            tiling.split_side(7, 1);
        }
        let expected = report(Format::Text, text(&tiling).as_bytes(), None).unwrap();
        assert_eq!(expected.ok, !broken);
        let base = base_obj(&tiling);
        let from_obj = report(Format::Obj, obj(&tiling).as_bytes(), Some((Format::Obj, base.as_bytes()))).unwrap();
        assert_eq!((from_obj.ok, from_obj.counts), (expected.ok, expected.counts.clone()));
        for encoding in [Ply::Ascii, Ply::Little, Ply::Big] {
            let file = ply(&tiling, encoding);
            let from_ply = report(Format::Ply, &file, Some((Format::Obj, base.as_bytes()))).unwrap();
            assert_eq!((from_ply.ok, &from_ply.counts), (expected.ok, &expected.counts), "{encoding:?}");
            assert_eq!(from_ply.shared_base_edges, 6);
            // Without its base the mesh is judged by itself.
            let alone = report(Format::Ply, &file, None).unwrap();
            assert_eq!((alone.ok, alone.boundary_edges), (!broken, if broken { 3 } else { 0 }));
        }
    }
}

#[test]
fn mesh_text_takes_decimals_in_base_lines() {
    let file = "scale 8\n\n# corners in decimals\nb 5 0 0 0  0.5 0 0  0 2.125e0 -0.0\nt 5 0 0 0 4 0 0 0 17 0 # one\n";
    let found = report(Format::Text, file.as_bytes(), None).unwrap();
    assert!(found.ok, "{found}");
    // 0.1 is no multiple of 1/8: a lattice ten times as fine (and no finer) holds both.
    let file = "t 0 0 0 0 4 0 0 0 17 0\nb 0 0 0 0  0.1 0 0  0 2.125 0\nscale 8\n";
    let found = report(Format::Text, file.as_bytes(), None).unwrap();
    let broken = found.failures.iter().find(|failure| failure.kind == FailureKind::BrokenLoops).unwrap();
    assert_eq!(broken.vertices, ["(0.1 0 0)"], "{found}");
    // A third of a decimal does not exist, but two thirds over three do.
    let file = "scale 3\nb 0 0 0 0  2 0 0  0 2 0\nt 0 0 0 0 6 0 0 0 6 0\n";
    assert!(report(Format::Text, file.as_bytes(), None).unwrap().ok);
}

#[test]
fn mesh_numbers_are_exact() {
    // Two decimals that round to one double are two vertices; the same decimal written twice is one.
    let same = b"v 0 0 0\nv 1 0 0\nv 0.1 1 0\nv 1.0e-1 1.000 -0\nv 2 2 0\nf 1 2 3\nf 2 5 4\n";
    assert_eq!(report(Format::Obj, same, None).unwrap().boundary_edges, 4);
    let other =
        b"v 0 0 0\nv 1 0 0\nv 0.1 1 0\nv 0.10000000000000000 1.0000000000000001 -0\nv 2 2 0\nf 1 2 3\nf 2 5 4\n";
    assert_eq!(report(Format::Obj, other, None).unwrap().boundary_edges, 6);
}

#[test]
fn mesh_numbers_of_any_range_are_exact() {
    // Rounding noise beside large numbers needs more bits than an i64 lattice has.
    for noise in ["0", "1e-17", "-3.5e-200", "6.123233995736766e-17"] {
        let file = format!(
            "v {noise} 0 0\nv 1000 {noise} 0\nv 0 1000 0\nv 0.5 0.25 {noise}\nv 3 3 777.77\n\
             f 1 3 2\nf 1 2 5\nf 2 3 5\nf 3 1 5\n"
        );
        let found = report(Format::Obj, file.as_bytes(), None).unwrap();
        assert!(found.ok && found.boundary_edges == 0, "{noise}: {found}");
        // Half way between vertices that differ by the noise only.
        let file =
            format!("v 0 0 {noise}\nv 4 0 {noise}\nv 2 0 {noise}\nv 1 3 0\nv 1 -2 0\nf 1 2 4\nf 1 5 3\nf 3 5 2\n");
        let found = report(Format::Obj, file.as_bytes(), None).unwrap();
        assert_eq!(failures(&found), [("t_vertices", 1)], "{noise}: {found}");
        // The smallest step off the edge is off the edge.
        if noise != "0" {
            let file = format!("v 0 0 0\nv 4 0 0\nv 2 0 {noise}\nv 1 3 0\nv 1 -2 0\nf 1 2 4\nf 1 5 3\nf 3 5 2\n");
            assert_eq!(failures(&report(Format::Obj, file.as_bytes(), None).unwrap()), []);
        }
    }
}

#[test]
fn mesh_without_base_triangles_is_judged_by_itself() {
    let square = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";
    let judge = |faces: &str| report(Format::Obj, format!("{square}{faces}").as_bytes(), None).unwrap();
    let quad = judge("f 1 2 3 4\n");
    assert_eq!(quad.to_string(), "2 triangles, 4 vertices, 4 open edges in 1 boundary loop: OK\n");
    assert_eq!(failures(&judge("f 1 2 3\nf 4 3 1\n")), [("misoriented_edges", 1)]);
    assert_eq!(failures(&judge("f 1 2 3\nf 1 3 4\nf 1 3 2\n")), [("nonmanifold_edges", 1), ("duplicate_triangles", 1)]);
    assert_eq!(failures(&judge("f 1 2 3\nf 1 1 3\n")), [("degenerate_triangles", 1)]);
    // Two triangles that touch in a point have two loops round them, or one that crosses itself.
    assert_eq!(judge("v 5 5 5\nv 6 5 6\nf 1 2 3\nf 3 5 6\n").boundary_edges, 6);
    let closed = CheckOptions { closed: true, ..CheckOptions::default() };
    let mesh = parse(Format::Obj, format!("{square}f 1 2 3 4\n").as_bytes(), None).unwrap();
    assert_eq!(mesh.triangles(), 2);
    assert_eq!(mesh.base_triangles(), None);
    assert_eq!(check(&mesh, &closed, &()).count(FailureKind::OpenEdges), 4);
}

#[test]
fn mesh_base_of_one_face_needs_no_groups() {
    let mesh = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.5 0.5 0\nf 1 2 4\nf 1 4 3\n";
    let base = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    assert!(report(Format::Obj, mesh, Some((Format::Obj, base))).unwrap().ok);
}

/// A file, its format, and what is said of it.
type Case<'a> = (Format, &'a [u8], &'a str);

#[test]
fn mesh_mistakes_are_told_with_their_place() {
    use Format::{Obj, Ply, Text};
    let cases: &[Case<'_>] = &[
        (Text, b"", "mesh: holds no base triangle; lines `b I x y z x y z x y z` are expected"),
        (Text, b"scale 0\n", "mesh:1: scale 0 is out of range; an integer from 1 to 2^61 is expected"),
        (Text, b"scale 2\nscale 3\n", "mesh:2: scale 3 contradicts scale 2 of line 1; one scale is expected"),
        (Text, b"scale 1/2\n", "mesh:1: field 2 `1/2` is not an integer"),
        (Text, b"\nt 0 1 2 3 4 5.5 6 7 8 9\n", "mesh:2: field 7 `5.5` is not an integer coordinate (over the scale)"),
        (Text, b"t 0 1 2 3", "mesh:1: field 6 is missing; an integer coordinate (over the scale) is expected"),
        (Text, b"t 0 1 2 3 4 5 6 7 8 9 10\n", "mesh:1: field 12 `10` is one too many; the line should end here"),
        (
            Text,
            b"t -1 1 2 3 4 5 6 7 8 9\n",
            "mesh:1: field 2 `-1` is not the number of a base triangle (0 to 4294967295)",
        ),
        (
            Text,
            b"t 0 0 0 0 1 0 0 0 0 9000000000000000000\n",
            "mesh:1: coordinate 9000000000000000000 is out of range; its magnitude has to be less than 2^61",
        ),
        (
            Text,
            b"t 7 1 2 3 4 5 6 7 8 9\n",
            "mesh:1: base triangle 7 has no corners; a line `b 7 x y z x y z x y z` is missing",
        ),
        (
            Text,
            b"b 0 0 0 0 1 0 0 0 1 0\nb 0 0 0 0 1 0 0 0 1 0\n",
            "mesh:2: base triangle 0 is given a second time; each `b` line needs its own number",
        ),
        (
            Text,
            b"b 0 0 0 0 1 0 0 0 1 inf\n",
            "mesh:1: field 11 `inf` is not a decimal number; a coordinate is expected",
        ),
        (
            Text,
            b"b 0 0 0 0 1 0 0 0 1 1e-30\n",
            "mesh:1: a coordinate does not fit below 2^61 steps of 1/(scale * 1), the lattice of all coordinates; smaller coordinates or fewer decimals in `b` lines are needed",
        ),
        (
            Text,
            b"# no\n\x00\xff\n",
            "mesh:2: a line cannot begin with `\\0\u{fffd}`; `scale`, `b`, `t` or `#` is expected",
        ),
        (Obj, b"v 0 0 0\n", "mesh: holds no face; there is nothing to check"),
        (Obj, b"v 0 0\n", "mesh:1: field 4 is missing; a coordinate is expected"),
        (Obj, b"v 0 0 nan\n", "mesh:1: field 4 `nan` is not a decimal number; a coordinate is expected"),
        (Obj, b"v 0 0 1e999\n", "mesh:1: field 4 `1e999` is beyond the range of a double; a coordinate is expected"),
        (
            Obj,
            b"v 0 0 1234567890.1234567890123\n",
            "mesh:1: field 4 `1234567890.1234567890123` has more than 18 significant digits; a coordinate is expected",
        ),
        (
            Obj,
            b"v 0 0 0\nf 1 1 2\n",
            "mesh:2: field 4 `2` names no vertex; 1 have been defined, counted from 1 (or -1 backwards)",
        ),
        (
            Obj,
            b"v 0 0 0\nf -2 1 1\n",
            "mesh:2: field 2 `-2` names no vertex; 1 have been defined, counted from 1 (or -1 backwards)",
        ),
        (Obj, b"v 0 0 0\nf 1 x/2 1\n", "mesh:2: field 3 `x/2` is not a vertex number, with or without /texture/normal"),
        (Obj, b"v 0 0 0\nf 1 1\n", "mesh:2: a face of 2 corners is no polygon; at least 3 are expected"),
        (Obj, b"g base_x\n", "mesh:1: group `base_x` does not end in the number of a base triangle"),
        (Obj, b"v 0 \\\n0 0\n", "mesh:1: continues on the next line (`\\`), which is not supported; join the lines"),
        (Obj, b"PK\x03\x04\n", "mesh:1: `PK\\u{3}\\u{4}` is no OBJ statement; `v`, `f`, `g` or the like is expected"),
        (Ply, b"", "mesh: the file ends within the header; a line `end_header` is expected"),
        (Ply, b"solid\n", "mesh:1: `solid` is not `ply`, the first line of every PLY file"),
        (Ply, b"ply\nformat ascii 1.0\nend_header\n", "mesh:3: the header has to have one `element vertex`"),
        (
            Ply,
            b"ply\nelement vertex 1\nproperty quad x\n",
            "mesh:3: field 2 `quad` is no PLY type; `float`, `int`, `uchar` or the like is expected",
        ),
        (
            Ply,
            b"ply\nproperty float x\n",
            "mesh:2: a property before the first element; `element vertex N` is expected",
        ),
        (
            Ply,
            b"ply\nformat ebcdic 1.0\n",
            "mesh:2: field 2 `ebcdic` is not ascii, binary_little_endian or binary_big_endian",
        ),
    ];
    for (format, bytes, expected) in cases {
        let error = parse(*format, bytes, None).unwrap_err();
        let told = error.to_string().replacen("mesh:0:", "mesh:", 1);
        assert_eq!(told, *expected);
    }
}

/// An ascii or binary PLY header of `vertices` vertices and `faces` faces.
fn header(encoding: &str, vertices: u64, faces: u64) -> Vec<u8> {
    format!(
        "ply\nformat {encoding} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {faces}\nproperty list char int vertex_index\nend_header\n"
    )
    .into_bytes()
}

#[test]
fn mesh_ply_mistakes_are_told_with_their_place() {
    let ascii = |body: &str| [header("ascii", 2, 1), body.into()].concat();
    let told = |file: Vec<u8>| parse(Format::Ply, &file, None).unwrap_err().to_string();
    assert_eq!(told(ascii("0 0 0\n")), "mesh:10: the file ends before vertex 1 of 2");
    assert_eq!(told(ascii("0 0 0\n0 0\n")), "mesh:11: field 3 is missing; a coordinate is expected");
    assert_eq!(told(ascii("0 0 0\n0 0 0 1\n")), "mesh:11: field 4 `1` is one too many; the line should end here");
    assert_eq!(
        told(ascii("0 0 0\n\n0 0 0\n3 0 1 2\n")),
        "mesh:13: face 0 (counted from 0) names vertex 2, but there are 2, counted from 0"
    );
    assert_eq!(
        told(ascii("0 0 0\n0 0 0\n2 0 1\n")),
        "mesh:12: face 0 (counted from 0) has 2 corners; at least 3 are expected"
    );
    assert_eq!(
        told(ascii("0 0 0\n0 0 0\n-3 0 1 1\n")),
        "mesh:12: property vertex_index: a list of -3 entries is impossible"
    );
    let start = header("binary_little_endian", 1, 1).len();
    let binary = |body: &[u8]| [header("binary_little_endian", 1, 1), body.to_vec()].concat();
    let vertex = [0f32, 1.0, f32::NAN].map(f32::to_le_bytes).concat();
    assert_eq!(
        told(binary(&vertex)),
        format!("mesh: byte {}: vertex 0 (counted from 0), property z: NaN is not a finite number", start + 12)
    );
    assert_eq!(
        told(binary(&[0; 14])),
        format!("mesh: byte {}: face 0 (counted from 0) has 0 corners; at least 3 are expected", start + 12)
    );
    assert_eq!(
        told(binary(&[[0; 12].as_slice(), &[3, 0, 0, 0, 0, 9]].concat())),
        format!("mesh: byte {}: the file ends here, in the middle of its elements; it is cut off", start + 17)
    );
    // A header may promise anything; memory is taken for what comes.
    assert!(told([header("binary_big_endian", u64::MAX >> 1, 7), vec![0; 40]].concat()).contains("cut off"));
}

#[test]
fn mesh_base_mistakes_are_told_with_their_place() {
    let base: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1.1 0\nf 1 2 3\nf 3 2 1\n";
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let told = |faces: &str| {
        let mesh = format!("{vertices}{faces}");
        parse(Format::Obj, mesh.as_bytes(), Some((Format::Obj, base))).unwrap_err().to_string()
    };
    let ungrouped = "this face is in no group `base_<I>` and has no property `base`, and base has 2 faces; \
                     each face has to say whose it is";
    assert_eq!(told("f 1 2 3\n"), format!("mesh:4: {ungrouped}"));
    assert_eq!(told("g base_0\nf 1 2 3\ng lid\n\nf 1 2 3\n"), format!("mesh:8: {ungrouped}"));
    assert_eq!(told("g base_2\nf 1 2 3\n"), "mesh:4: group base_2 names no face of base, which has 2, from 0 on");
    let mesh = ply(&Tiling::plain(1, &SQUARE), Ply::Little);
    assert_eq!(
        parse(Format::Ply, &mesh, Some((Format::Obj, base))).unwrap_err().to_string(),
        "base: coordinate 1.1 of vertex 2 (counted from 0) has no short binary value, and mesh holds binary floats; \
         give both files in the same kind of numbers"
    );
    let text: &[u8] = b"b 0 0 0 0 1 0 0 0 1 0\n";
    let error = parse(Format::Text, text, Some((Format::Obj, base))).unwrap_err();
    assert_eq!(error.to_string(), "mesh: carries its own base triangles (`b` lines); leave base away");
    let error = parse(Format::Obj, vertices.as_bytes(), Some((Format::Text, text))).unwrap_err();
    assert_eq!(
        error.to_string(),
        "base: holds base triangles for an OBJ, PLY or GLB mesh, and has to be .obj, .ply or .glb too"
    );
}

#[test]
fn mesh_files_are_read_by_extension() {
    let folder = tempfile::tempdir().unwrap();
    let tiling = Tiling::regular(4, &TETRAHEDRON, 2);
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let base = write("base.OBJ", base_obj(&tiling).as_bytes());
    let ok = |path: &std::path::Path, base: Option<&std::path::Path>| {
        check(&read(path, base, &()).unwrap(), &CheckOptions::default(), &()).ok
    };
    assert!(ok(&write("mesh.txt", text(&tiling).as_bytes()), None));
    assert!(ok(&write("mesh.obj", obj(&tiling).as_bytes()), Some(&base)));
    assert!(ok(&write("mesh.ply", &ply(&tiling, Ply::Big)), Some(&base)));
    let error = read(&folder.path().join("none.obj"), None, &()).unwrap_err();
    assert!(error.message.starts_with("cannot be opened: "), "{error}");
    assert_eq!(error.place, Place::File);
    let error = read(folder.path(), None, &()).unwrap_err();
    assert_eq!(error.message, "is a folder; a mesh file is expected");
}

/// Some bytes of a good file replaced, doubled or taken out.
fn damage(mut bytes: Vec<u8>, changes: &[(prop::sample::Index, u8, u8)]) -> Vec<u8> {
    for (index, how, byte) in changes {
        if bytes.is_empty() {
            break;
        }
        let place = index.index(bytes.len());
        match how % 4 {
            0 => bytes[place] = *byte,
            1 => bytes.insert(place, *byte),
            2 => drop(bytes.remove(place)),
            _ => bytes.truncate(place),
        }
    }
    bytes
}

/// Reads and checks bytes as every format; only that it comes back is asked.
fn survive(bytes: &[u8]) {
    let base: &[u8] = b"v 0 0 0\nv 16777216 0 0\nv 0 1 0\nf 1 2 3\n";
    for format in [Format::Text, Format::Obj, Format::Ply] {
        let _ = report(format, bytes, None);
    }
    for format in [Format::Obj, Format::Ply] {
        let _ = report(format, bytes, Some((Format::Obj, base)));
        let _ = report(Format::Obj, b"v 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\n", Some((format, bytes)));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn mesh_readers_survive_any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        survive(&bytes);
        survive(&[&header("binary_big_endian", 2, 9)[..], &bytes].concat());
    }

    #[test]
    fn mesh_readers_survive_words_of_the_formats(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "t", "b", "scale", "v", "f", "g", "o", "base_0", "\n", "\n", "0", "1", "-1", "2", "3", "0.5", "1e300",
                "1e-300", "2305843009213693951", "-2305843009213693951", "9223372036854775807", "1e18", "#",
                "b 0 0 0 0 1 0 0 0 1 0\n", "t 0 0 0 0 1 0 0 0 1 0\n", "v 0 0 1e300\n", "v 1e-300 1 0\n", "f 1 2 3\n",
                "f -1 -2 -3\n", "ply\n", "format ascii 1.0\n", "element vertex 3\n", "element face 1\n",
                "property list char int vertex_indices\n", "property double x\nproperty int y\nproperty char z\n",
                "end_header\n",
            ]),
            0..60,
        ),
    ) {
        survive(words.join(" ").as_bytes());
    }

    #[test]
    fn mesh_readers_survive_damaged_files(
        tiling in tiling(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), any::<u8>()), 1..6),
    ) {
        survive(&damage(text(&tiling).into_bytes(), &changes));
        survive(&damage(obj(&tiling).into_bytes(), &changes));
        for encoding in [Ply::Ascii, Ply::Little, Ply::Big] {
            survive(&damage(ply(&tiling, encoding), &changes));
        }
    }

    #[test]
    fn mesh_text_and_builder_agree(tiling in tiling()) {
        let from_text = report(Format::Text, text(&tiling).as_bytes(), None).unwrap();
        prop_assert_eq!(from_text.ok, true);
        prop_assert_eq!(from_text, tiling.check());
    }
}
