// SPDX-License-Identifier: MIT OR Apache-2.0
//! Indexed meshes: what is written comes back, what is malformed is refused, and nothing panics.

use proptest::prelude::*;
use relief_models::mesh::{CheckOptions, Format, InputError, Source, TriangleMesh, check, read_from};

const FORMATS: [Format; 3] = [Format::Obj, Format::Ply, Format::Glb];

fn write(mesh: &TriangleMesh, format: Format) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    mesh.write(format, &mut bytes).map(|()| bytes).map_err(|error| error.to_string())
}

fn read(format: Format, mut bytes: &[u8]) -> Result<TriangleMesh, InputError> {
    TriangleMesh::read_from(Source { name: "mesh", format, size: bytes.len() as u64, bytes: &mut bytes }, &())
}

fn refusal(format: Format, bytes: &[u8]) -> String {
    read(format, bytes).unwrap_err().to_string()
}

fn tetrahedron() -> TriangleMesh {
    TriangleMesh {
        positions: vec![[0.0, 0.0, 0.0625], [1.0, 0.0, 65535.9375], [0.0, 4096.0, 1.0], [0.1f32.into(), 0.0, -3.5]],
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    }
}

/// A GLB of this JSON and binary chunk.
fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((28 + json.len() as u32 + binary.len() as u32).to_le_bytes());
    for (name, chunk) in [(b"JSON", json.as_slice()), (b"BIN\0", binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(name);
        file.extend(chunk);
    }
    file
}

/// A triangle with indices of one byte, whose node stands under another; `edit` replaces one text by another.
fn triangle(edit: [&str; 2]) -> Vec<u8> {
    let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[1]}],
        "nodes":[{"mesh":0,"translation":[10,0,0]},{"children":[0],"scale":[2,2,2]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
        {"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],
        "buffers":[{"byteLength":40}]}"#;
    assert!(edit[0].is_empty() || json.contains(edit[0]), "{}", edit[0]);
    let mut binary: Vec<u8> =
        [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|v| v.to_le_bytes()).collect();
    binary.extend([0, 1, 2, 0]);
    glb(&if edit[0].is_empty() { json.into() } else { json.replacen(edit[0], edit[1], 1) }, &binary)
}

#[test]
fn triangle_mesh_comes_back_from_every_format() {
    for format in FORMATS {
        let bytes = write(&tetrahedron(), format).unwrap();
        assert_eq!(read(format, &bytes).unwrap(), tetrahedron(), "{format:?}");
        let mut bytes = bytes.as_slice();
        let source = Source { name: "mesh", format, size: 0, bytes: &mut bytes };
        let report = check(&read_from(source, None, &()).unwrap(), &CheckOptions::default(), &());
        assert_eq!((report.ok, report.boundary_edges), (true, 0), "{format:?}: {report}");
    }
}

#[test]
fn triangle_mesh_glb_places_meshes_by_their_nodes() {
    let mesh = read(Format::Glb, &triangle(["", ""])).unwrap();
    // First the inner node's translation, then the outer one's scale.
    assert_eq!(mesh.positions, [[20.0, 0.0, 0.0], [22.0, 0.0, 0.0], [20.0, 2.0, 0.0]]);
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    let two = triangle([r#""nodes":[1]"#, r#""nodes":[1,2]"#]);
    assert!(refusal(Format::Glb, &two).contains("is no whole glTF 2.0 file"));
    let json = [r#""scale":[2,2,2]}"#, r#""scale":[2,2,2]},{"mesh":0}"#];
    assert_eq!(read(Format::Glb, &triangle(json)).unwrap().triangles.len(), 1, "a node of no scene");
    let plain = triangle([r#","indices":1"#, ""]);
    assert_eq!(read(Format::Glb, &plain).unwrap().triangles, [[0, 1, 2]]);
    let lines = triangle([r#""mode":4"#, r#""mode":1"#]);
    assert_eq!(refusal(Format::Glb, &lines), "mesh: holds no face; a mesh of triangles is expected");
}

#[test]
fn triangle_mesh_glb_refuses_what_it_cannot_take() {
    for (edit, sentence) in [
        ([r#""mode":4"#, r#""mode":5"#], "mesh 0, primitive 0: is a strip or a fan"),
        ([r#""children":[0]"#, r#""children":[1]"#], "node 1 stands at two places"),
        ([r#""children":[0]"#, r#""children":[0,0]"#], "node 0 stands at two places"),
        ([r#""scenes":[{"nodes":[1]}]"#, r#""scenes":[]"#], "is no whole glTF 2.0 file"),
        ([r#""scene":0,"scenes":[{"nodes":[1]}],"#, ""], "holds no scene"),
        ([r#""componentType":5126"#, r#""componentType":5123"#], "positions that are not three floats"),
        ([r#""componentType":5121"#, r#""componentType":5126"#], "indices that are no whole numbers"),
        ([r#""componentType":5121"#, r#""componentType":5125"#], "reaches beyond the binary chunk"),
        ([r#""count":3,"type":"VEC3""#, r#""count":4,"type":"VEC3""#], "reaches beyond the binary chunk"),
        ([r#""count":3,"type":"VEC3""#, r#""count":2,"type":"VEC3""#], "names vertex 2, but there are 2"),
        ([r#""count":3,"type":"VEC3""#, r#""count":99999999999,"type":"VEC3""#], "repeats its meshes"),
        ([r#""count":3,"type":"SCALAR""#, r#""count":2,"type":"SCALAR""#], "a multiple of three"),
        ([r#""byteLength":36}"#, r#""byteLength":99999}"#], "reaches beyond the binary chunk"),
        ([r#""buffers":[{"#, r#""buffers":[{"uri":"a.bin","#], "data in another file"),
        ([r#""scale":[2,2,2]"#, r#""scale":[1e39,2,2]"#], ""),
        ([r#""translation":[10,0,0]"#, r#""translation":[3e38,0,0],"scale":[3e38,3e38,3e38]"#], ""),
        ([r#"{"asset""#, r#"{"asset":1,"asset""#], "is no whole glTF 2.0 file"),
    ] {
        // What a number beyond a float becomes is the crate's affair, but there is no panic.
        match read(Format::Glb, &triangle(edit)) {
            Err(error) => assert!(error.to_string().contains(sentence), "{edit:?}: {error}"),
            Ok(_) => assert!(sentence.is_empty(), "{edit:?}"),
        }
    }
    assert!(refusal(Format::Glb, b"").starts_with("mesh: is no binary glTF file"));
    assert!(
        refusal(Format::Glb, b"glTF\x02\0\0\0\x04\0\0\0").starts_with("mesh: says that it has 4 bytes, and has 12")
    );
    let whole = triangle(["", ""]);
    for end in 0..whole.len() {
        assert!(read(Format::Glb, &whole[..end]).is_err(), "{end}");
    }
}

#[test]
fn triangle_mesh_is_refused_before_a_byte_is_written() {
    let refused = |edit: &dyn Fn(&mut TriangleMesh), format| {
        let mut mesh = tetrahedron();
        edit(&mut mesh);
        let mut bytes = Vec::new();
        let error = mesh.write(format, &mut bytes).unwrap_err().to_string();
        assert!(bytes.is_empty());
        error
    };
    for format in FORMATS {
        assert!(refused(&|mesh| mesh.triangles.clear(), format).starts_with("the mesh has no triangle"));
        assert!(refused(&|mesh| mesh.triangles[1][2] = 4, format).starts_with("the mesh names vertex 4, but has 4"));
        for value in [f64::NAN, f64::INFINITY, -1e290] {
            let error = refused(&|mesh| mesh.positions[2][1] = value, format);
            assert!(error.starts_with("the mesh has vertex 2 (counted from 0) at [0.0, "), "{error}");
        }
    }
    assert!(
        refused(&|mesh| mesh.positions[2][1] = 1e39, Format::Glb)
            .ends_with("numbers to 3.4028234663852886e38 are expected")
    );
    assert!(refused(&|_| {}, Format::Text).ends_with("has to go into .obj, .ply or .glb"));
    assert!(refusal(Format::Text, b"scale 1\n").contains("is neither .obj, .ply nor .glb"));
    assert!(refusal(Format::Obj, b"v 0 0 0\n").contains("holds no face"));
    assert!(refusal(Format::Obj, b"v 0 0 nan\n").contains("`nan` is not a decimal number"));
}

/// Any coordinate that OBJ and PLY keep.
fn coordinate() -> impl Strategy<Value = f64> {
    let any = any::<f64>().prop_filter("within the range", |value| value.abs() < 1e280);
    prop_oneof![any, (0i64..1 << 32).prop_map(|value| value as f64 / 16.0), -1e6..1e6]
}

fn meshes() -> impl Strategy<Value = TriangleMesh> {
    proptest::collection::vec(proptest::array::uniform3(coordinate()), 1..20).prop_flat_map(|positions| {
        let corner = 0..positions.len() as u32;
        proptest::collection::vec(proptest::array::uniform3(corner), 1..20)
            .prop_map(move |triangles| TriangleMesh { positions: positions.clone(), triangles })
    })
}

proptest! {
    #[test]
    fn triangle_mesh_keeps_every_bit_in_obj_and_ply(mesh in meshes()) {
        for format in [Format::Obj, Format::Ply] {
            prop_assert_eq!(&read(format, &write(&mesh, format).unwrap()).unwrap(), &mesh);
        }
    }

    #[test]
    fn triangle_mesh_keeps_floats_in_glb(mut mesh in meshes()) {
        for value in mesh.positions.iter_mut().flatten() {
            *value = f64::from(*value as f32).clamp(-3e38, 3e38);
            *value = f64::from(*value as f32);
        }
        prop_assert_eq!(&read(Format::Glb, &write(&mesh, Format::Glb).unwrap()).unwrap(), &mesh);
    }

    #[test]
    fn triangle_mesh_readers_survive_broken_files(
        mesh in meshes(),
        which in 0usize..3,
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in any::<prop::sample::Index>(),
        is_cut: bool,
    ) {
        let mesh = TriangleMesh {
            positions: mesh.positions.iter().map(|position| position.map(|value| value.clamp(-1e30, 1e30))).collect(),
            ..mesh
        };
        let mut bytes = if which == 2 { triangle(["", ""]) } else { write(&mesh, FORMATS[which]).unwrap() };
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if is_cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok(mesh) = read(FORMATS[which], &bytes) {
            prop_assert!(mesh.triangles.iter().flatten().all(|at| (*at as usize) < mesh.positions.len()));
            prop_assert!(mesh.positions.iter().flatten().all(|value| value.is_finite()));
        }
    }
}
