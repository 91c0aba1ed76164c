// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief remesh` as a program: its engines agree, its meshes are tilings, and it says what is wrong with its input.

use proptest::prelude::*;
use relief_testbench::cosim::tools;
use relief_testbench::remesh::{GridTriangle, parse_grid};
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A pyramid over a square, a sliver, a flat triangle, three equal corners; numbers out of order.
const GRID: &str = "# a pyramid\n\
    b 0  0 0 0  20 0 0  9 11 15\n\
    b 1  20 0 0  20 20 1  9 11 15   # its second side\n\
    \n\
    b 2 20 20 1 0 20 -3 9 11 15\r\n\
    \tb 3 0 20 -3 0 0 0 +9 11 15\n\
    b 9 -8192 8191 0 -8000 8191 1 -8100 8190 3\n\
    b 5 100 0 0 110 10 10 104 4 4\n\
    b 4294967295 7 7 7 7 7 7 7 7 7";

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, text).unwrap();
        path
    }

    /// Names of all files, hidden ones included.
    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

fn remesh(grid: &Path, options: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_relief")).arg("remesh").arg("--grid").arg(grid).args(options).output().unwrap()
}

/// Exit code, stdout and stderr.
fn outcome(output: Output) -> (Option<i32>, String, String) {
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// The mesh on stdout of a run that succeeds without a word.
fn mesh_of(grid: &Path, engine: &str) -> String {
    let (code, mesh, stderr) = outcome(remesh(grid, &["--engine", engine]));
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{engine}");
    mesh
}

/// What check-mesh says of a mesh that it finds good.
fn checked(folder: &Folder, mesh: &str) -> String {
    let path = folder.write("checked.txt", mesh);
    let output = Command::new(env!("CARGO_BIN_EXE_relief")).arg("check-mesh").arg(path).output().unwrap();
    let (code, stdout, stderr) = outcome(output);
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    stdout
}

#[test]
fn remesh_writes_a_mesh_that_check_mesh_accepts() {
    let folder = Folder::new();
    let mesh = mesh_of(&folder.write("grid.txt", GRID), "golden");
    let lines: Vec<_> = mesh.lines().collect();
    assert_eq!(lines[0], "scale 131072");
    assert_eq!(lines[1], "b 0 0 0 0 20 0 0 9 11 15");
    assert_eq!(lines[4], "b 3 0 20 -3 0 0 0 9 11 15");
    assert_eq!(lines[7], "b 4294967295 7 7 7 7 7 7 7 7 7");
    // In the order of the grid, and a corner is exact.
    let order: Vec<_> = lines[8..].iter().map(|line| line.split(' ').nth(1).unwrap()).collect();
    assert!(lines[8..].iter().all(|line| line.starts_with("t ") && line.split(' ').count() == 11));
    let mut distinct = order.clone();
    distinct.dedup();
    assert_eq!(distinct, ["0", "1", "2", "3", "9", "5", "4294967295"]);
    assert_eq!(*lines.last().unwrap(), format!("t 4294967295{}", " 917504".repeat(9)));
    let summary = checked(&folder, &mesh);
    assert!(summary.starts_with(&format!("7 base triangles, {} triangles, ", lines.len() - 8)), "{summary}");
    assert!(summary.ends_with(" 4 shared base edges: OK\n"), "{summary}");
}

#[test]
fn remesh_rust_writes_the_bytes_of_golden() {
    let folder = Folder::new();
    let grid = folder.write("grid.txt", GRID);
    let mesh = mesh_of(&grid, "golden");
    assert_eq!(mesh_of(&grid, "rust"), mesh);
    checked(&folder, &mesh);
}

#[test]
fn remesh_verilator_writes_the_bytes_of_golden() -> Result<(), tools::Missing> {
    if !tools::require_all(&["verilator", "g++"], "remesh_verilator_writes_the_bytes_of_golden")? {
        return Ok(());
    }
    let folder = Folder::new();
    // Several batches of cycles: some 30,000 triangles more.
    let grid = folder.write("grid.txt", format!("{GRID}\nb 77 0 0 0 180 20 31 40 170 90\nb 78 0 0 0 9 9 9 0 9 0\n"));
    let mesh = mesh_of(&grid, "golden");
    assert!(mesh.lines().count() > 25_000, "{} lines", mesh.lines().count());
    assert_eq!(mesh_of(&grid, "verilator"), mesh);
    assert_eq!(mesh_of(&grid, "rust"), mesh);
    checked(&folder, &mesh);
    Ok(())
}

#[test]
fn remesh_tells_the_cost() {
    let folder = Folder::new();
    let grid = folder.write("grid.txt", "b 0 0 0 0 40 0 0 0 40 0\n");
    let (code, mesh, stderr) = outcome(remesh(&grid, &["--stats", "--engine", "rust"]));
    assert_eq!(code, Some(0));
    let triangles = mesh.lines().count() - 2;
    assert_eq!(stderr.lines().next(), Some(format!("1 base triangles, {triangles} triangles").as_str()));
    let figure = |what: &str| -> f64 {
        let line = stderr.lines().find(|line| line.contains(what)).unwrap_or_else(|| panic!("{stderr}"));
        line.split(' ').next().unwrap().parse().unwrap()
    };
    assert!((0.5..0.7).contains(&figure(" vertices sent per triangle (")), "{stderr}");
    assert!((1.0..1.5).contains(&figure(" cycles per two triangles (")), "{stderr}");
    // There is no clock in the golden models, and all the same in the mesh.
    let (code, same, stderr) = outcome(remesh(&grid, &["--stats"]));
    assert_eq!((code, same == mesh, stderr.lines().count()), (Some(0), true, 2), "{stderr}");
}

#[test]
fn remesh_out_appears_whole_or_not_at_all() {
    let folder = Folder::new();
    let grid = folder.write("grid.txt", GRID);
    let mesh = mesh_of(&grid, "golden");
    let out = folder.path("mesh.txt");
    let options = ["--out", out.to_str().unwrap()];
    assert_eq!(outcome(remesh(&grid, &options)), (Some(0), String::new(), String::new()));
    assert_eq!(fs::read_to_string(&out).unwrap(), mesh);
    assert_eq!(folder.names(), ["grid.txt", "mesh.txt"]);
    // A run that fails leaves the mesh before it.
    let bad = folder.write("bad.txt", "b 0 1 2 3\n");
    assert_eq!(remesh(&bad, &options).status.code(), Some(2));
    assert_eq!(fs::read_to_string(&out).unwrap(), mesh);
    assert_eq!(folder.names(), ["bad.txt", "grid.txt", "mesh.txt"]);
    // The next one takes its place.
    let small = folder.write("small.txt", "b 0 0 0 0 1 0 0 0 1 0\n");
    assert_eq!(remesh(&small, &options).status.code(), Some(0));
    assert_eq!(fs::read_to_string(&out).unwrap(), mesh_of(&small, "golden"));
    // What is no file cannot be replaced.
    let (code, _, stderr) = outcome(remesh(&small, &["--out", folder.0.path().to_str().unwrap()]));
    assert_eq!(code, Some(2));
    assert!(stderr.ends_with(": is a folder; a file is expected\n"), "{stderr}");
    let (code, _, stderr) = outcome(remesh(&small, &["--out", folder.path("none/mesh.txt").to_str().unwrap()]));
    assert_eq!(code, Some(2));
    assert!(stderr.contains("none/mesh.txt: cannot be written: "), "{stderr}");
    assert_eq!(outcome(remesh(&small, &["--out", "/dev/null"])), (Some(0), String::new(), String::new()));
    assert!(!Path::new("/dev/null").is_file());
}

/// A reader that goes away early is no error, and ends the work.
#[test]
fn remesh_broken_pipe_is_no_error() {
    let folder = Folder::new();
    let grid = folder.write("grid.txt", "b 0 0 0 0 900 0 7 20 900 11\n");
    for engine in ["golden", "rust"] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_relief"))
            .args(["remesh", "--engine", engine, "--grid"])
            .arg(&grid)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut start = [0; 12];
        child.stdout.take().unwrap().read_exact(&mut start).unwrap();
        assert_eq!(&start, b"scale 131072");
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), b"".as_slice()), "{engine}");
    }
}

#[test]
fn remesh_bad_input_is_told_by_line() {
    let coordinate = "an integer grid coordinate from -8192 to 8191";
    let base = "the number of a base triangle from 0 to 4294967295";
    let good = "b 0 0 0 0 1 0 0 0 1 0\n";
    let cases = [
        ("b 1 8192 0 0 1 0 0 0 1 0", format!("field 3 `8192` is not {coordinate}")),
        ("b 1 0 0 0 1 0 0 0 1 -8193", format!("field 11 `-8193` is not {coordinate}")),
        ("b 1 0 0 0 1 0.5 0 0 1 0", format!("field 7 `0.5` is not {coordinate}")),
        ("b 1 0 0 0 1 99999999999999999999 0 0 1 0", format!("field 7 `99999999999999999999` is not {coordinate}")),
        ("b 1 0 0 0 one 0 0 0 1 0", format!("field 6 `one` is not {coordinate}")),
        ("b 1 0 0 0 1 0 0 0 1", format!("field 11 is missing; {coordinate} is expected")),
        ("b 1 0 0 0 # 1 0 0 0 1 0", format!("field 6 is missing; {coordinate} is expected")),
        ("b", format!("field 2 is missing; {base} is expected")),
        ("b -1 0 0 0 1 0 0 0 1 0", format!("field 2 `-1` is not {base}")),
        ("b 4294967296 0 0 0 1 0 0 0 1 0", format!("field 2 `4294967296` is not {base}")),
        ("b 1 0 0 0 1 0 0 0 1 0 7", "field 12 `7` is one too many; the line should end after nine coordinates".into()),
        ("b 0 0 0 0 2 0 0 0 2 0", "base triangle 0 is that of line 1 already; a number of its own is expected".into()),
        ("t 0 0 0 0 1 0 0 0 1 0", "a line cannot begin with `t`; `b` or `#` is expected".into()),
        ("\u{1b}[2J", "a line cannot begin with `\\u{1b}[2J`; `b` or `#` is expected".into()),
    ];
    let folder = Folder::new();
    for (line, sentence) in cases {
        let bad = folder.write("bad.txt", format!("{good}\n# the next one is wrong\n{line}\n{good}"));
        let expected = format!("error: {}:4: {sentence}\n", bad.display());
        assert_eq!(outcome(remesh(&bad, &[])), (Some(2), String::new(), expected), "{line}");
    }
    let empty = folder.write("empty.txt", "# nothing\n\n");
    let expected =
        format!("error: {}: holds no base triangle; lines `b I x y z x y z x y z` are expected\n", empty.display());
    assert_eq!(outcome(remesh(&empty, &[])), (Some(2), String::new(), expected));
    let (code, stdout, stderr) = outcome(remesh(&folder.path("none.txt"), &[]));
    assert_eq!((code, stdout.as_str()), (Some(2), ""));
    assert!(stderr.contains("none.txt: cannot be opened: "), "{stderr}");
    let expected = format!("error: {}: is a folder; a grid file is expected\n", folder.0.path().display());
    assert_eq!(outcome(remesh(folder.0.path(), &[])), (Some(2), String::new(), expected));
    let (code, _, stderr) = outcome(remesh(&empty, &["--engine", "icarus"]));
    assert_eq!(code, Some(2));
    assert!(stderr.contains("[possible values: golden, rust, verilator]"), "{stderr}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever the bytes are, the reader takes them or says a sentence.
    #[test]
    fn remesh_reader_takes_arbitrary_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let _ = parse_grid("grid", &bytes).map_err(|error| error.to_string());
    }

    /// The same near the format: its own letters in any order.
    #[test]
    fn remesh_reader_takes_what_looks_like_a_grid(text in "(b|t|#| |\n|-|\\+|[0-9]|é|\r|\t|\\.|b [0-9]{1,12}( -?[0-9]{1,5}){9}\n){0,60}") {
        match parse_grid("grid", text.as_bytes()) {
            Ok(grid) => prop_assert!(!grid.is_empty()),
            Err(error) => prop_assert!(error.to_string().starts_with("grid:"), "{error}"),
        }
    }

    /// What is written in the format is read as it was meant.
    #[test]
    fn remesh_reader_reads_what_was_written(
        bases in prop::collection::btree_map(any::<u32>(), prop::array::uniform3(prop::array::uniform3(-8192..=8191)), 1..20),
        space in "[ \t]{1,3}",
        comment in "( #[^\n]{0,10})?",
        end in "\n|\r\n|\n\n",
    ) {
        let mut text = String::new();
        for (number, corners) in &bases {
            let fields: Vec<_> = corners.as_flattened().iter().map(|value: &i32| value.to_string()).collect();
            text += &format!("b{space}{number}{space}{}{comment}{end}", fields.join(&space));
        }
        let expected: Vec<_> = bases.into_iter().map(|(number, corners)| GridTriangle { number, corners }).collect();
        prop_assert_eq!(parse_grid("grid", text.as_bytes()), Ok(expected));
    }
}
