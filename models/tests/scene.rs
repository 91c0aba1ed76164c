// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scene files: what they say is taken, every bad value is a sentence, and nothing makes the reader panic.

use std::path::Path;

use glam::{DVec3, dvec3};
use proptest::prelude::*;
use relief_models::map::Wrap;
use relief_models::scene::{Scene, parse, read};

const SCENE: &str = r#"
[camera]
eye = [0.0, -3.2, 1.6]
target = [0, 0, 0.1]

[[object]]
mesh = { kind = "grid", cells = [4, 4], size = [2.0, 1.7] }
map = { kind = "ramp", size = [8, 8] }
displacement = [0.0, 0.35]
"#;

fn scene(text: &str) -> Scene {
    parse(text, "scene.toml", Path::new("")).unwrap()
}

fn refusal(text: &str) -> String {
    parse(text, "scene.toml", Path::new("")).unwrap_err().to_string()
}

/// The refusal of the scene with one piece of text replaced.
fn refusal_with(old: &str, new: &str) -> String {
    assert!(SCENE.contains(old), "{old}");
    refusal(&SCENE.replace(old, new))
}

#[test]
fn scene_has_sensible_defaults() {
    let scene =
        scene("[camera]\neye = [0, 0, 2]\nup = [0, 1, 0]\n[[object]]\nmesh.kind = \"sphere\"\nmap.kind = \"cosine\"\n");
    assert_eq!(scene.warnings, [] as [&str; 0]);
    let camera = scene.camera;
    assert_eq!((camera.target, camera.fov_y_deg, camera.viewport), (DVec3::ZERO, 45.0, [640, 480]));
    assert_eq!((camera.near, camera.far), (0.2, 40.0));
    assert_eq!((scene.remesh.cell_px, scene.remesh.cull), (2.0, true));
    assert_eq!(scene.lights.len(), 1);
    assert!(scene.lights[0].direction.is_normalized());
    let object = &scene.objects[0];
    assert_eq!((object.wrap, object.poles, object.displacement), ([Wrap::Repeat, Wrap::Clamp], true, [0.0, 0.1]));
    assert_eq!((object.map.width, object.map.height, object.map_name.as_str()), (256, 256, "cosine"));
    assert_eq!(object.mesh.triangles.len(), 256);
}

#[test]
fn scene_takes_every_field() {
    let scene = scene(
        r#"
        [camera]
        eye = [0.0, -3.2, 1.6]
        target = [0.0, 0.0, 0.1]
        up = [0.0, 0.1, 1.0]
        fov_y_deg = 60
        near = 0.5
        far = 50.0
        viewport = [320, 4096]
        [remesh]
        cell_px = 4
        cull = false
        [[object]]
        mesh = { kind = "cylinder", cells = [5, 3], radius = 0.25, height = 2 }
        map = { kind = "checkerboard", size = [16, 9] }
        displacement = [-0.1, 0.2]
        wrap = ["repeat", "clamp"]
        at = [1, 2, 3]
        colour = [1, 0.5, 0]
        [[object]]
        mesh = { kind = "grid", cells = [1, 2], size = [3, 4] }
        map = { kind = "peaks", size = [1, 1] }
        [[light]]
        direction = [0, 0, 3]
        [[light]]
        direction = [1, 0, 0]
        "#,
    );
    let camera = scene.camera;
    assert_eq!(
        (camera.eye, camera.target, camera.up),
        (dvec3(0.0, -3.2, 1.6), dvec3(0.0, 0.0, 0.1), dvec3(0.0, 0.1, 1.0))
    );
    assert_eq!((camera.fov_y_deg, camera.near, camera.far, camera.viewport), (60.0, 0.5, 50.0, [320, 4096]));
    assert_eq!((scene.remesh.cell_px, scene.remesh.cull), (4.0, false));
    let tube = &scene.objects[0];
    assert_eq!((tube.displacement, tube.wrap, tube.poles), ([-0.1, 0.2], [Wrap::Repeat, Wrap::Clamp], false));
    assert_eq!(tube.mesh.triangles.len(), 30);
    assert_eq!((tube.mesh.vertices[0].position, tube.colour), (dvec3(1.25, 2.0, 4.0), Some([1.0, 0.5, 0.0])));
    assert_eq!(scene.objects[1].wrap, [Wrap::Clamp; 2]);
    assert_eq!(scene.objects[1].map.samples.len(), 1);
    assert_eq!([scene.lights[0].direction, scene.lights[1].direction], [DVec3::Z, DVec3::X]);
}

#[test]
fn scene_refuses_unknown_fields_by_name() {
    let cases = [
        ("[camera]", "[camera]\nzoom = 2", "scene.toml:3: unknown field `zoom`, expected one of `eye`, `target`, "),
        ("[[object]]", "[film]\n[[object]]", "scene.toml:6: unknown field `film`, expected one of `camera`, "),
        ("displacement", "displacment", "scene.toml:9: unknown field `displacment`, expected one of `mesh`, "),
        ("size = [2.0", "sizes = [2.0", "scene.toml:7: unknown field `sizes`, expected one of `kind`, `cells`, "),
        ("\"grid\"", "\"gird\"", "scene.toml:7: unknown variant `gird`, expected one of `grid`, `cylinder`, `sphere`"),
        ("\"ramp\"", "\"lamp\"", "scene.toml:8: unknown variant `lamp`, expected one of `half_donut`, `peaks`, "),
        ("-3.2", "\"a\"", "scene.toml:3: [camera] `eye` is the string \"a\"; a number is expected"),
        (
            "[4, 4]",
            "[4, 4.5]",
            "scene.toml:7: [[object]] 1: `mesh.cells` is the floating point `4.5`; an integer is expected",
        ),
        ("1.6]", "1.6, 7]", "scene.toml:3: [camera] `eye` has 4 values; 3 are expected"),
        ("[0, 0, 0.1]", "[0]", "scene.toml:4: [camera] `target` has 1 value; 3 are expected"),
        ("[0.0, -3.2, 1.6]", "[0.0, -3.2]", "scene.toml:3: [camera] `eye` has 2 values; 3 are expected"),
        ("[4, 4]", "[4, 4, 4, 4]", "scene.toml:7: [[object]] 1: `mesh.cells` has 4 values; 2 are expected"),
        ("0.35]", "0.35, 1]", "scene.toml:9: [[object]] 1: `displacement` has 3 values; 2 are expected"),
        (
            "[0.0, 0.35]",
            "true",
            "scene.toml:9: [[object]] 1: `displacement` is the boolean `true`; an array of 2 values",
        ),
        ("[[object]]", "[object]", "scene.toml:6: `object` is a table; [[object]], in double brackets, is expected"),
        ("[camera]", "[[camera]]", "scene.toml:2: `camera` is a list; [camera], in single brackets, is expected"),
        ("[[object]]", "remesh = 3\n[[object]]", "scene.toml:6: unknown field `remesh`, expected one of"),
        ("[[object]]", "[remesh]\ncull = 1\n[[object]]", "scene.toml:7: [remesh] `cull` is the integer `1`; a boolean"),
        (
            "1.7]",
            "99999999999999999999999]",
            "scene.toml:7: [[object]] 1: `mesh.size` is the integer `99999999999999999999999`; a",
        ),
        (
            "[[object]]",
            "[[light]]\ndirection = [1, 2, 3, 4]\n[[object]]",
            "scene.toml:7: [[light]] 1: `direction` has 4 values",
        ),
        ("eye =", "target =", "scene.toml:4: `target` is there twice; once is expected"),
        ("eye = [0.0, -3.2, 1.6]\n", "", "scene.toml:2: missing field `eye`"),
        ("1.6]", "1.6", "scene.toml:4: "),
    ];
    for (old, new, expected) in cases {
        let refusal = refusal_with(old, new);
        assert!(refusal.starts_with(expected), "{refusal}");
    }
    assert_eq!(refusal(""), "scene.toml:1: missing field `camera`");
}

#[test]
fn scene_refuses_bad_cameras() {
    let finite = "a finite number from -1e9 to 1e9 is expected";
    let cases = [
        ("-3.2", "nan", format!("`eye` is NaN; {finite}")),
        ("-3.2", "-inf", format!("`eye` is -inf; {finite}")),
        ("0.1]", "1e300]", format!("`target` is 1e300; {finite}")),
        (
            "[0, 0, 0.1]",
            "[0, -3.2, 1.6]",
            "`eye` and `target` are both [0, -3.2, 1.6]; two places are expected, to look from one to the other".into(),
        ),
        (
            "target =",
            "up = [0, 6.4, -3]\ntarget =",
            "`up` [0, 6.4, -3] is along the view from `eye` to `target`; a direction aside of it is expected".into(),
        ),
        (
            "target =",
            "up = [0, 0, 0]\ntarget =",
            "`up` is [0, 0, 0]; a direction, of any length but 0, is expected".into(),
        ),
        ("target =", "near = 0\ntarget =", "`near` is 0; a number greater than 0 (1e-9 at least) is expected".into()),
        ("target =", "near = -1\ntarget =", "`near` is -1; a number greater than 0 (1e-9 at least) is expected".into()),
        ("target =", "near = inf\ntarget =", format!("`near` is inf; {finite}")),
        (
            "target =",
            "near = 2\nfar = 2\ntarget =",
            "`far` is 2 and `near` 2; a far plane behind the near one is expected".into(),
        ),
        ("target =", "near = 1\nfar = nan\ntarget =", format!("`far` is NaN; {finite}")),
    ];
    for (old, new, expected) in cases {
        assert_eq!(refusal_with(old, new), format!("scene.toml:2: [camera] {expected}"));
    }
    for angle in ["0", "180", "-45", "200"] {
        let expected = "an angle between 0 and 180 degrees (0.001 to 179.999) is expected";
        let refusal = refusal_with("target =", &format!("fov_y_deg = {angle}\ntarget ="));
        assert_eq!(refusal, format!("scene.toml:2: [camera] `fov_y_deg` is {angle}; {expected}"));
    }
    for (viewport, which, value) in
        [("[0, 480]", "first", 0), ("[640, 4097]", "second", 4097), ("[-1, 1]", "first", -1)]
    {
        let expected = "a number from 1 to 4096 is expected (4096 is the limit of the vertex format)";
        let refusal = refusal_with("target =", &format!("viewport = {viewport}\ntarget ="));
        let what = format!("the {which} number of `viewport` is {value}");
        assert_eq!(refusal, format!("scene.toml:2: [camera] {what}; {expected}"));
    }
    let far = scene(&SCENE.replace("target =", "near = 0.001\nfar = 20\ntarget ="));
    assert_eq!(far.warnings.len(), 1);
    assert!(
        far.warnings[0].starts_with("scene.toml:2: [camera] `far` is 20000 times `near`; beyond 10000 times"),
        "{:?}",
        far.warnings
    );
}

#[test]
fn scene_refuses_bad_settings_and_lights() {
    let cell = |value: &str| refusal(&format!("{SCENE}\n[remesh]\ncell_px = {value}"));
    assert_eq!(cell("0"), "scene.toml:11: [remesh] `cell_px` is 0; a number from 1 to 64 is expected");
    assert_eq!(cell("nan"), "scene.toml:11: [remesh] `cell_px` is NaN; a finite number from -1e9 to 1e9 is expected");
    let light = refusal(&format!("{SCENE}\n[[light]]\ndirection = [0, 0, 1]\n[[light]]\ndirection = [0, 0, 0]"));
    assert_eq!(
        light,
        "scene.toml:13: [[light]] 2: `direction` is [0, 0, 0]; a direction, of any length but 0, is expected"
    );
    let many = "[[light]]\ndirection = [0, 0, 1]\n".repeat(65);
    assert_eq!(refusal(&format!("{SCENE}\n{many}")), "scene.toml: has 65 [[light]] entries, beyond the limit of 64");
    let none = "scene.toml: has no [[object]]; at least one, with `mesh` and `map`, is expected";
    assert_eq!(refusal("[camera]\neye = [1, 0, 0]"), none);
}

#[test]
fn scene_refuses_bad_objects() {
    let cases = [
        (
            "[0.0, 0.35]",
            "[0.35, 0.0]",
            "`displacement` [0.35, 0] has its greater value first; [0, 0.35] or an inverted map is expected",
        ),
        ("[0.0, 0.35]", "[0.0, inf]", "`displacement` is inf; a finite number from -1e9 to 1e9 is expected"),
        (
            "[4, 4]",
            "[4, 0]",
            "the second number of `cells` is 0; a number from 1 to 512 is expected (512 is the limit of a body's cells \
             along an axis)",
        ),
        ("[2.0, 1.7]", "[2.0, -1.7]", "`size` is -1.7; a number greater than 0 (1e-9 at least) is expected"),
        ("size = [2.0, 1.7]", "radius = 2", "`radius` is no field of the mesh grid; it has cells, size"),
        ("kind = \"grid\", ", "", "`mesh` has either a `kind` (\"grid\", \"cylinder\", \"sphere\") or a `file`"),
        (
            "kind = \"ramp\", ",
            "",
            "`map` has either a `file` (a grey PNG) or a `kind` (\"half_donut\", \"peaks\", \"paraboloid\", \
             \"checkerboard\", \"cosine\", \"ramp\", \"cubic\", \"dents\", \"peak\", \"noise\", \"waves\")",
        ),
        (
            "[8, 8]",
            "[8, 0]",
            "the second number of `size` is 0; a number from 1 to 2047 is expected (2047 is the limit of a map's side)",
        ),
        (
            "[8, 8]",
            "[8, 2048]",
            "the second number of `size` is 2048; a number from 1 to 2047 is expected (2047 is the limit of a map's side)",
        ),
        (
            "[8, 8]",
            "[626, 626]",
            "the map ramp of 626 x 626 samples takes 131075 words in each of the four banks of the map memory, with its \
             levels, beyond the limit of 131072; a smaller map is expected",
        ),
        (
            "[8, 8] }",
            "[8, 7] }\nwrap = [\"repeat\", \"repeat\"]",
            "the map ramp of 8 x 7 samples repeats in v with a period of 7 samples, which is odd; an even number, or better a power of \
             two, is expected",
        ),
        (
            "mesh = { kind = \"grid\", cells = [4, 4], size = [2.0, 1.7] }",
            "mesh.kind = \"sphere\"\nwrap = [\"clamp\", \"clamp\"]",
            "`wrap` in u does not fit a sphere, which meets itself in u; \"repeat\" is expected",
        ),
        (
            "mesh = { kind = \"grid\", cells = [4, 4], size = [2.0, 1.7] }",
            "mesh.kind = \"sphere\"\nwrap = [\"repeat\", \"repeat\"]",
            "`wrap` in v does not fit a sphere, which has poles at the ends of v; \"clamp\" is expected",
        ),
        (
            "mesh = { kind = \"grid\", cells = [4, 4], size = [2.0, 1.7] }",
            "mesh = { kind = \"sphere\", radius = 3.3 }",
            "the camera's `eye` [0, -3.2, 1.6] is inside, as far as the displacement reaches; a place outside is expected",
        ),
        (
            "mesh = { kind = \"grid\", cells = [4, 4], size = [2.0, 1.7] }",
            "mesh = { kind = \"cylinder\", radius = 3.2, height = 9 }",
            "the camera's `eye` [0, -3.2, 1.6] is inside, as far as the displacement reaches; a place outside is expected",
        ),
        ("displacement", "colour = [0, 2, 0]\ndisplacement", "`colour` is 2; a number from 0 to 1 is expected"),
        ("displacement", "at = [0, nan, 0]\ndisplacement", "`at` is NaN; a finite number from -1e9 to 1e9 is expected"),
    ];
    for (old, new, expected) in cases {
        assert_eq!(refusal_with(old, new), format!("scene.toml:6: [[object]] 1: {expected}"));
    }
}

#[test]
fn scene_reads_its_files_beside_itself() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    let path = folder.path().join("scene.toml");
    let refused = || read(&path).unwrap_err().to_string();
    assert!(refused().contains("scene.toml: cannot be opened: "), "{}", refused());
    assert!(read(folder.path()).unwrap_err().message.starts_with("is a folder"));
    write("scene.toml", b"\xFF");
    assert!(refused().ends_with("scene.toml: is no text (UTF-8); a scene file (TOML) is expected"), "{}", refused());
    let text = "[camera]\neye = [3, 0, 0]\n[[object]]\nmesh = { file = \"a.obj\" }\nmap = { file = \"maps/a.png\" }\n";
    write("scene.toml", text.as_bytes());
    assert!(refused().contains("a.obj: cannot be opened: "), "{}", refused());
    write("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt -0.5 -0.5\nvt 0.5 -0.5\nvt 0.5 0.5\nf 1/1 2/2 3/3\n");
    assert!(
        refused().contains("its u goes from -0.5 to 0.5, but the map ends at 0 and 1 where it clamps"),
        "{}",
        refused()
    );
    write("scene.toml", text.replace("map =", "wrap = [\"repeat\", \"repeat\"]\nmap =").as_bytes());
    assert!(refused().contains("a.png: cannot be opened: "), "{}", refused());
    std::fs::create_dir(folder.path().join("maps")).unwrap();
    image::GrayImage::from_vec(2, 2, vec![0, 9, 10, 255]).unwrap().save(folder.path().join("maps/a.png")).unwrap();
    let scene = read(&path).unwrap();
    assert_eq!(scene.warnings.len(), 1);
    assert!(scene.warnings[0].contains("a.png: has 8 bits a sample"), "{:?}", scene.warnings);
    let object = &scene.objects[0];
    assert_eq!((object.map.samples[1], object.map_name.as_str(), object.poles), (9 * 257, "maps/a.png", false));
    // Shifted by whole periods to begin in the first one.
    assert_eq!(object.mesh.vertices.iter().map(|vertex| vertex.uv.x).collect::<Vec<_>>(), [0.5, 1.5, 1.5]);
    assert_eq!(object.mesh.vertices.iter().map(|vertex| vertex.uv.y).collect::<Vec<_>>(), [1.5, 1.5, 0.5]);
}

#[test]
fn scene_of_the_repository_are_read() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes"));
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let scene = read(&path).unwrap();
            assert_eq!(scene.warnings, [] as [&str; 0], "{}", path.display());
            count += 1;
        }
    }
    assert_eq!(count, 8);
}

#[test]
fn scene_page_shows_a_scene() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let page = std::fs::read_to_string(root.join("docs/scene.md")).unwrap();
    let example = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let scene = parse(example, "docs/scene.md", &root.join("scenes")).unwrap();
    assert_eq!((scene.objects.len(), scene.warnings.len()), (2, 0));
    assert_eq!(scene.objects[1].wrap, [Wrap::Repeat, Wrap::Clamp]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn scene_reader_survives_any_text(text in any::<String>()) {
        prop_assert!(refusal(&text).len() > 20);
    }

    #[test]
    fn scene_reader_survives_damaged_files(
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0u8..128, 0u8..4), 1..5),
    ) {
        let mut bytes = SCENE.as_bytes().to_vec();
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
        if let Err(error) = parse(&String::from_utf8(bytes).unwrap(), "scene.toml", Path::new("/nowhere")) {
            prop_assert!(error.message.len() > 10, "{}", error);
        }
    }

    #[test]
    fn scene_numbers_of_any_kind_are_taken_or_refused(
        which in any::<prop::sample::Index>(),
        value in prop::sample::select(vec![
            "nan", "-nan", "inf", "-inf", "0", "-0.0", "1e-320", "1e308", "-1e308", "9223372036854775807", "1", "0.5", "180",
            "1e-9", "1e9", "true", "\"x\"", "[]", "{}", "512", "-9223372036854775808",
        ]),
    ) {
        let numbers: Vec<(usize, &str)> = SCENE.match_indices(|c: char| c.is_ascii_digit()).collect();
        let (at, _) = numbers[which.index(numbers.len())];
        let text = format!("{}{value}{}", &SCENE[..at], &SCENE[at + 1..]);
        match parse(&text, "scene.toml", Path::new("")) {
            Ok(scene) => {
                let object = &scene.objects[0];
                prop_assert!(scene.camera.near < scene.camera.far && scene.camera.far.is_finite());
                prop_assert!(object.mesh.vertices.iter().all(|vertex| vertex.position.is_finite()));
                prop_assert!(object.displacement.iter().all(|value| value.is_finite()));
            }
            Err(error) => prop_assert!(error.message.len() > 10, "{}", error),
        }
    }
}
