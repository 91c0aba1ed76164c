// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief check-mesh` as a program: what it prints where, and its exit codes.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Two base triangles, of which the second is tiled by two triangles.
const SQUARE: &str = "scale 2\nb 0 0 0 0 4 0 0 0 4 0\nb 1 4 0 0 4 4 0 0 4 0\n\
                      t 0 0 0 0 8 0 0 0 8 0\nt 1 8 0 0 8 4 0 0 8 0\nt 1 8 4 0 8 8 0 0 8 0\n";
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }
}

fn check_mesh(file: &Path, options: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_relief")).arg("check-mesh").arg(file).args(options).output().unwrap()
}

/// Exit code, stdout and stderr.
fn outcome(output: Output) -> (Option<i32>, String, String) {
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn check_mesh_exits_with_0_on_a_good_mesh() {
    let folder = Folder::new();
    let summary = "2 base triangles, 3 triangles, 1 shared base edge: OK\n".to_owned();
    let square = folder.write("square.txt", SQUARE);
    assert_eq!(outcome(check_mesh(&square, &[])), (Some(0), summary, String::new()));
    let summary = "4 triangles, 4 vertices, no open edge: OK\n".to_owned();
    let tetrahedron = folder.write("tetrahedron.obj", TETRAHEDRON);
    assert_eq!(outcome(check_mesh(&tetrahedron, &["--closed"])), (Some(0), summary, String::new()));
}

#[test]
fn check_mesh_exits_with_1_on_a_broken_mesh() {
    let folder = Folder::new();
    let broken = folder.write("broken.txt", &SQUARE.replace("t 1 8 0 0 8 4 0 0 8 0\n", ""));
    let (code, stdout, stderr) = outcome(check_mesh(&broken, &[]));
    assert_eq!((code, stderr), (Some(1), String::new()));
    assert!(stdout.contains("FAIL open_edges base 0: (8 0 0)/2 - (0 8 0)/2 is open\n"), "{stdout}");
    assert!(stdout.contains("2 base triangles, 2 triangles, 1 shared base edge: BAD open_edges:2 "), "{stdout}");
    let open = folder.write("open.obj", &TETRAHEDRON.replace("f 3 1 4\n", ""));
    assert_eq!(outcome(check_mesh(&open, &[])).0, Some(0));
    let (code, stdout, _) = outcome(check_mesh(&open, &["--closed"]));
    assert_eq!(code, Some(1));
    assert!(
        stdout.ends_with("3 triangles, 4 vertices, 3 open edges in 1 boundary loop: BAD open_edges:3\n"),
        "{stdout}"
    );
}

#[test]
fn check_mesh_exits_with_2_on_bad_input() {
    let folder = Folder::new();
    let bad = folder.write("bad.txt", &SQUARE.replace("8 8", "8 eight"));
    let expected =
        format!("error: {}:6: field 7 `eight` is not an integer coordinate (over the scale)\n", bad.display());
    assert_eq!(outcome(check_mesh(&bad, &[])), (Some(2), String::new(), expected.clone()));
    // Nothing is half-written.
    assert_eq!(outcome(check_mesh(&bad, &["--json"])), (Some(2), String::new(), expected));
    let (code, stdout, stderr) = outcome(check_mesh(&folder.0.path().join("none.ply"), &[]));
    assert_eq!((code, stdout.as_str()), (Some(2), ""));
    assert!(stderr.contains("none.ply: cannot be opened: "), "{stderr}");
    let square = folder.write("square.txt", SQUARE);
    let (code, _, stderr) = outcome(check_mesh(&square, &["--tolerance", "soon"]));
    assert_eq!(code, Some(2));
    assert!(stderr.contains("`soon` is not a tolerance; a fraction such as 1/64"), "{stderr}");
}

#[test]
fn check_mesh_writes_json() {
    let folder = Folder::new();
    let broken = folder.write("broken.txt", &SQUARE.replace("t 1 8 0 0 8 4 0 0 8 0\n", ""));
    let (code, stdout, stderr) = outcome(check_mesh(&broken, &["--json"]));
    assert_eq!(code, Some(1));
    let report: serde_json::Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(report["ok"], false);
    assert_eq!(report["base_triangles"], 2);
    assert_eq!(report["counts"]["open_edges"], 2);
    assert_eq!(report["counts"]["t_vertices"], 0);
    assert_eq!(report["failures"][0]["kind"], "open_edges");
    assert!(stderr.contains("BAD open_edges:2"), "{stderr}");
}

#[test]
fn check_mesh_takes_a_base_and_tells_the_time() {
    let folder = Folder::new();
    let base = folder.write("base.obj", TETRAHEDRON);
    let (lines, faces) = TETRAHEDRON.split_at(TETRAHEDRON.find('f').unwrap());
    let grouped: String = faces.lines().enumerate().map(|(index, face)| format!("g base_{index}\n{face}\n")).collect();
    let mesh = folder.write("mesh.obj", &format!("{lines}{grouped}"));
    let (code, stdout, stderr) = outcome(check_mesh(&mesh, &["--timings", "--base", base.to_str().unwrap()]));
    assert_eq!((code, stdout.as_str()), (Some(0), "4 base triangles, 4 triangles, 6 shared base edges: OK\n"));
    for phase in ["reading", "identifying vertices", "triangles", "edges", "base triangles", "T-vertices", "all"] {
        assert!(stderr.contains(&format!(" s {phase}\n")), "{stderr}");
    }
}
