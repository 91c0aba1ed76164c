// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief tessellate` as a program: meshes that keep what is claimed, the same from every engine, closed on bodies.

use image::{ImageBuffer, Luma};
use relief_models::map::{HeightMap, Procedural};
use relief_models::measure::{Heights, heights, heights_under};
use relief_models::mesh::TriangleMesh;
use relief_testbench::cosim::tools;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn relief(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_relief")).args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }
    fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }
    fn map(&self, name: &str, map: &HeightMap) -> String {
        let picture = ImageBuffer::<Luma<u16>, _>::from_raw(map.width as u32, map.height as u32, map.samples.clone());
        picture.unwrap().save(self.path(name)).unwrap();
        self.path(name)
    }
    fn names(&self) -> Vec<String> {
        let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
        let mut names: Vec<String> = fs::read_dir(self.0.path()).unwrap().map(name).collect();
        names.sort();
        names
    }
}

/// Prime sides, and values of a terrain.
fn hills() -> HeightMap {
    HeightMap::procedural(Procedural::Peaks, 61, 43)
}

fn measured(path: &str, map: &HeightMap) -> Heights {
    heights(&TriangleMesh::read(Path::new(path), &()).unwrap(), map, &()).unwrap()
}

/// The number behind a name in what the program prints.
fn figure(stdout: &str, name: &str) -> f64 {
    let line = stdout.lines().find_map(|line| line.strip_prefix(name)).unwrap_or_else(|| panic!("{name}: {stdout}"));
    line.split_whitespace().next().unwrap().parse().unwrap()
}

#[test]
fn tessellate_keeps_what_it_claims_in_every_format() {
    let folder = Folder::new();
    let map = folder.map("map.png", &hills());
    for (method, claims) in
        [("bisector", true), ("bisector-interpolated", true), ("uniform", false), ("remesher", false)]
    {
        for name in ["mesh.obj", "mesh.ply", "mesh.glb"] {
            let out = folder.path(name);
            let (code, stdout, stderr) =
                relief(&["tessellate", &map, "--method", method, "--bound", "900.5", "--out", &out]);
            assert_eq!((code, stderr.as_str()), (Some(0), ""), "{method}: {stdout}");
            let found = measured(&out, &hills());
            assert!(found.holds(900.5), "{method}: {found:?}");
            assert_eq!(stdout.contains("claimed error           900.5 holds"), claims, "{stdout}");
            assert_eq!(figure(&stdout, "triangles"), found.triangles as f64);
            assert!((figure(&stdout, "max error") - found.max).abs() < 0.01, "{stdout}");
        }
        // As many triangles as are allowed, and not one more.
        let out = folder.path("few.obj");
        let (code, stdout, _) = relief(&["tessellate", &map, "--method", method, "--triangles", "200", "--out", &out]);
        let found = measured(&out, &hills());
        assert!(code == Some(0) && found.is_whole() && (100..=200).contains(&found.triangles), "{method}: {stdout}");
        if claims {
            assert!(found.max <= figure(&stdout, "claimed error"), "{stdout}");
        }
    }
}

#[test]
fn tessellate_writes_the_same_bytes_with_every_engine() {
    let folder = Folder::new();
    let map = folder.map("map.png", &hills());
    let verilator = tools::require_all(&["verilator", "g++", "make"], "meshes from Verilog").unwrap();
    let engines = if verilator { &["golden", "rust", "verilator"][..] } else { &["golden", "rust"] };
    let growing = ["--slope", "20", "--eye", "11,30"];
    for (method, options) in
        [("bisector", &[][..]), ("bisector-interpolated", &[]), ("bisector-interpolated", &growing), ("remesher", &[])]
    {
        let mut meshes = Vec::new();
        for engine in engines {
            let out = folder.path("mesh.ply");
            let given = ["tessellate", &map, "--method", method, "--bound", "700", "--engine", engine, "--out", &out];
            let (code, stdout, stderr) = relief(&[&given, options].concat());
            assert_eq!(code, Some(0), "{stdout}{stderr}");
            if *engine != "golden" {
                let cycles = figure(&stdout, "cycles") / figure(&stdout, "triangles");
                assert!(method == "remesher" || (1.9..2.3).contains(&cycles), "{stdout}");
            }
            meshes.push(fs::read(&out).unwrap());
        }
        assert!(meshes.iter().all(|mesh| *mesh == meshes[0]), "{method} {options:?}");
    }
}

#[test]
fn tessellate_draws_prepared_maps() {
    let folder = Folder::new();
    let (map, baked) = (folder.map("map.png", &hills()), folder.path("baked"));
    let what = ["--what", "split,errors", "--bound", "700", "--effort", "3", "--out", &baked];
    assert_eq!(relief(&[&["bake", &map][..], &what].concat()).0, Some(0));
    let mesh = |input: &str, options: &[&str]| {
        let out = folder.path("mesh.ply");
        let (code, stdout, stderr) = relief(&[&["tessellate", input, "--out", &out][..], options].concat());
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
        (fs::read(&out).unwrap(), measured(&out, &hills()), stdout)
    };
    // Its split map, flipped or not, is the mesh of the map.
    let (whole, found, _) = mesh(&baked, &[]);
    assert!(found.holds(700.0), "{found:?}");
    assert_eq!(whole, mesh(&map, &["--bound", "700", "--effort", "3"]).0);
    // Its errors serve every bound, and one bound nests in the other.
    let interpolated = ["--method", "bisector-interpolated"];
    let triangles = ["300", "700", "2500"].map(|bound| {
        let (_, found, stdout) = mesh(&baked, &[&["--bound", bound][..], &interpolated].concat());
        assert!(found.holds(bound.parse().unwrap()), "{stdout}");
        found.triangles
    });
    assert!(triangles[0] > triangles[1] && triangles[1] > triangles[2], "{triangles:?}");
    // A bound that grows is kept at every sample, and is worth something.
    let growing = ["--bound", "300", "--slope", "100", "--eye", "10,20"];
    let (_, found, stdout) = mesh(&baked, &[&growing[..], &interpolated].concat());
    let written = TriangleMesh::read(Path::new(&folder.path("mesh.ply")), &()).unwrap();
    let under = |[i, j]: [usize; 2]| 300.0 + 100.0 * i.abs_diff(10).max(j.abs_diff(20)) as f64;
    let (_, slack) = heights_under(&written, &hills(), &under, &()).unwrap();
    assert!(stdout.contains("claimed error           up to "), "{stdout}");
    assert!(found.is_whole() && slack >= 0.0 && found.max > 300.0, "{slack} {stdout}");
    assert!((figure(stdout.split("slack of").nth(1).unwrap(), " ") - slack).abs() < 0.01, "{slack} {stdout}");
    assert!(found.triangles < triangles[0] / 2, "{stdout}");
    let near = {
        let mesh = TriangleMesh::read(Path::new(&folder.path("mesh.ply")), &()).unwrap();
        let within = |reach: f64| {
            let near = |at: &[f64; 3]| (at[0] - 10.0).abs().max((at[1] - 20.0).abs()) <= reach;
            mesh.positions.iter().filter(|at| near(at)).count() as f64 / (2.0 * reach + 1.0).powi(2)
        };
        [within(6.0), within(20.0)]
    };
    assert!(near[0] > 1.2 * near[1], "vertices a sample: {near:?}");
    assert_eq!(mesh(&map, &[&growing[..], &interpolated].concat()).0, fs::read(folder.path("mesh.ply")).unwrap());
}

fn scene(folder: &Folder, name: &str, objects: &str) -> PathBuf {
    let camera = "[camera]\neye = [0.0, -3.0, 1.5]\ntarget = [0.0, 0.0, 0.0]\nup = [0.0, 0.0, 1.0]\nfov_y_deg = 45.0\n\
                  near = 0.5\nfar = 50.0\nviewport = [64, 48]\n[[light]]\ndirection = [0.0, 0.0, 1.0]\n";
    let path = PathBuf::from(folder.path(name));
    fs::write(&path, format!("{camera}{objects}")).unwrap();
    path
}

#[test]
fn tessellate_keeps_closed_bodies_closed() {
    let folder = Folder::new();
    let bodies = [
        ("sphere", "{ kind = \"sphere\", cells = [12, 6], radius = 0.5 }", "no open edge"),
        ("cylinder", "{ kind = \"cylinder\", cells = [12, 2], radius = 0.5, height = 1.0 }", "in 2 boundary loops"),
    ];
    // Noise has another value in every sample of a pole's row, and no two columns alike.
    for (body, mesh, rim) in bodies {
        for kind in ["cosine", "noise"] {
            let object = format!(
                "[[object]]\nmesh = {mesh}\nmap = {{ kind = \"{kind}\", size = [32, 17] }}\ndisplacement = [0.0, 0.1]\n\
                 wrap = [\"repeat\", \"clamp\"]\n"
            );
            let scene = scene(&folder, "body.toml", &object);
            for method in ["bisector-interpolated", "uniform", "remesher"] {
                let (scene, out) = (scene.to_str().unwrap(), folder.path("body.obj"));
                let (code, stdout, stderr) =
                    relief(&["tessellate", scene, "--method", method, "--triangles", "600", "--out", &out]);
                assert_eq!((code, stderr.as_str()), (Some(0), ""), "{body} {kind} {method}: {stdout}");
                let (code, stdout, _) = relief(&["check-mesh", &out]);
                assert!(code == Some(0) && stdout.contains(rim), "{body} {kind} {method}: {stdout}");
            }
            let out = folder.path("none.obj");
            let (code, _, stderr) = relief(&["tessellate", scene.to_str().unwrap(), "--bound", "0.01", "--out", &out]);
            assert!(code == Some(2) && stderr.contains("bisector-interpolated keeps the seam closed"), "{stderr}");
        }
    }
}

#[test]
fn tessellate_lays_maps_over_base_meshes() {
    let folder = Folder::new();
    let object = |size: &str| {
        format!(
            "[[object]]\nmesh = {{ kind = \"grid\", cells = [3, 2], size = [2.0, 1.0] }}\n\
             map = {{ kind = \"peaks\", size = {size} }}\ndisplacement = [0.25, 0.75]\n"
        )
    };
    let scene = scene(&folder, "two.toml", &format!("{}{}", object("[33, 17]"), object("[9, 9]")));
    let out = folder.path("two.ply");
    let scene = scene.to_str().unwrap();
    let (code, stdout, _) = relief(&["tessellate", scene, "--bound", "0.01", "--effort", "2", "--out", &out]);
    assert_eq!(code, Some(0), "{stdout}");
    let mesh = TriangleMesh::read(Path::new(&out), &()).unwrap();
    // Each stands where its base mesh does, counterclockwise from above, and on a flat base is as far off as its heights.
    assert!(mesh.positions.iter().all(|[x, y, z]| x.abs() <= 1.0 && y.abs() <= 0.5 && (0.25..=0.76).contains(z)));
    let area = |[a, b, c]: [[f64; 3]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let areas: Vec<f64> = mesh.triangles.iter().map(|corners| area(mesh.corners(*corners)) / 2.0).collect();
    assert!(areas.iter().all(|area| *area > 0.0) && (areas.iter().sum::<f64>() - 4.0).abs() < 1e-9);
    assert_eq!(stdout.matches("claimed error           0.01 holds").count(), 2, "{stdout}");
    // Put back into sample coordinates, each keeps the bound: a map unit is half a world unit over 65535.
    let counts: Vec<usize> = ["triangles", "vertices"]
        .iter()
        .flat_map(|name| stdout.lines().find_map(|line| line.strip_prefix(name)))
        .map(|rest| rest.trim().parse().unwrap())
        .collect();
    let [width, height] = [33, 17];
    let back = |[x, y, z]: &[f64; 3]| {
        let place = [(x / 2.0 + 0.5) * (width - 1) as f64, (0.5 - y) * (height - 1) as f64];
        [place[0].round(), place[1].round(), (z - 0.25) * 2.0 * 65535.0]
    };
    let first = TriangleMesh {
        positions: mesh.positions[..counts[1]].iter().map(back).collect(),
        triangles: mesh.triangles[..counts[0]].to_vec(),
    };
    let found = heights(&first, &HeightMap::procedural(Procedural::Peaks, width, height), &()).unwrap();
    assert!(found.holds(0.01 * 2.0 * 65535.0 + 1e-6), "{found:?}");
    assert_eq!(stdout.matches("distance to all samples max 0.0").count(), 2, "{stdout}");
    // The triangles of all objects together.
    let (code, stdout, _) = relief(&["tessellate", scene, "--triangles", "150", "--effort", "1", "--out", &out]);
    let triangles = TriangleMesh::read(Path::new(&out), &()).unwrap().triangles.len();
    assert!(code == Some(0) && (80..=150).contains(&triangles), "{triangles}: {stdout}");
}

#[test]
fn tessellate_refuses_bad_input_and_leaves_nothing() {
    let folder = Folder::new();
    let map = folder.map("map.png", &hills());
    let half = "[[object]]\nmesh = { file = \"half.obj\" }\nmap = { kind = \"ramp\", size = [9, 9] }\ndisplacement = [0.0, 0.1]\n";
    fs::write(folder.path("half.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n").unwrap();
    let half = scene(&folder, "half.toml", half);
    let (half, text) = (half.to_str().unwrap(), folder.path("text.png"));
    fs::write(&text, "no picture").unwrap();
    let baked = folder.path("baked");
    assert_eq!(relief(&["bake", &map, "--what", "mips", "--out", &baked]).0, Some(0));
    let before = folder.names();
    let out = folder.path("out.obj");
    for (input, options, expected) in [
        (map.as_str(), &[][..], "a goal is expected: --bound E, in map units, or --triangles N"),
        (&map, &["--bound", "minus"], "is no bound; a number of map units from 0 to 65535"),
        (&map, &["--bound", "-3"], "is no bound; a number of map units from 0 to 65535"),
        (&map, &["--bound", "5", "--triangles", "7"], "cannot be used with"),
        (&map, &["--triangles", "1"], "no mesh of 1 triangles covers the map; 2 are the fewest"),
        (&map, &["--triangles", "1", "--method", "uniform"], "2 are the least"),
        (&map, &["--triangles", "1", "--method", "remesher"], "2 are the fewest"),
        (
            &map,
            &["--method", "delaunay", "--bound", "5"],
            "[possible values: bisector, bisector-interpolated, uniform, remesher]",
        ),
        (&map, &["--method", "uniform", "--bound", "5", "--engine", "rust"], "the uniform grid has no hardware"),
        (&map, &["--method", "remesher", "--bound", "0"], "with a vertex a sample the error is"),
        (
            &map,
            &["--bound", "5", "--slope", "1", "--eye", "4,4"],
            "--slope and --eye are for --method bisector-interpolated",
        ),
        (&map, &["--bound", "5", "--slope", "1"], "--eye"),
        (&map, &["--bound", "5", "--slope", "1", "--eye", "4"], "a column and a row from 0 to 4096"),
        (&text, &["--bound", "5"], "is no PNG"),
        (&baked, &[], "the folder holds no split map"),
        (&baked, &["--bound", "5"], "the folder holds no errors"),
        (
            &baked,
            &["--method", "uniform", "--bound", "5"],
            "is a map prepared for bisector-interpolated, and uniform is",
        ),
        (&map, &["--triangles", "90", "--slope", "1", "--eye", "4,4"], "cannot be used with"),
        (
            &map,
            &["--method", "bisector-interpolated", "--bound", "5", "--slope", "9", "--eye", "61,4"],
            "the eye is at 61,4, beyond the map; a sample of its 61 x 43 is expected",
        ),
        (
            &map,
            &["--method", "bisector-interpolated", "--bound", "5", "--slope", "9000", "--eye", "4,4"],
            "map units a sample on this map, and 9000 is beyond",
        ),
        (half, &["--bound", "0.01"], "object 1 has no base triangle at u = 1"),
        (half, &["--bound", "none"], "world units from 0 on are expected"),
        (half, &[], "a goal is expected: --bound E, in world units, or --triangles N"),
    ] {
        let (code, stdout, stderr) = relief(&[&["tessellate", input, "--out", &out][..], options].concat());
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{options:?}: {stderr}");
        assert!(stderr.contains(expected), "{options:?}: {stderr}");
    }
    let (code, _, stderr) = relief(&["tessellate", &map, "--bound", "5", "--out", &folder.path("out.stl")]);
    assert!(code == Some(2) && stderr.contains("a mesh goes into .obj, .ply or .glb"), "{stderr}");
    assert_eq!(folder.names(), before);
}
