// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief measure` as a program: what it prints where, and its exit codes.

use std::path::{Path, PathBuf};
use std::process::Command;

use relief_models::map::HeightMap;
use relief_models::mesh::{Format, TriangleMesh};
use relief_models::uniform;

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn mesh(&self, name: &str, mesh: &TriangleMesh) -> PathBuf {
        let path = self.path(name);
        let mut bytes = Vec::new();
        mesh.write(Format::of(&path), &mut bytes).unwrap();
        std::fs::write(&path, bytes).unwrap();
        path
    }

    fn map(&self, name: &str, map: &HeightMap) -> PathBuf {
        let path = self.path(name);
        let (width, height) = (map.width as u32, map.height as u32);
        let picture = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(width, height, map.samples.clone());
        picture.unwrap().save(&path).unwrap();
        path
    }
}

/// Heights i^2: a chord of two columns is 1 above its middle.
fn parabola() -> HeightMap {
    HeightMap { width: 9, height: 5, samples: (0..45).map(|at| (at % 9) * (at % 9)).collect() }
}

/// Exit code, stdout and stderr.
fn measure(mesh: &Path, against: &Path, options: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
    let output = command.arg("measure").arg(mesh).arg("--against").arg(against).args(options).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn measure_prints_the_errors_of_a_grid() {
    let folder = Folder::new();
    let map = folder.map("map.png", &parabola());
    let grid = uniform::with_step(&parabola(), 2).unwrap();
    let expected = "\
map                     9 x 5 samples, 0 to 64
mesh                    16 triangles, 15 vertices
max error               1.0000 at column 1, row 0 (1.562 % of the range)
mean error              0.4444 (0.6944 %)
rms error               0.6667 (1.0417 %)
volume between          16.0, signed 16.0, of 688.0
samples                 0 uncovered, 0 with several heights
edges                   0 open inside the map, 0 of more than two triangles, 0 walked twice alike
triangles               0 folded, 0 without area
vertices                0 off the lattice
";
    for name in ["grid.obj", "grid.ply", "grid.glb"] {
        let grid = folder.mesh(name, &grid);
        assert_eq!(measure(&grid, &map, &[]), (Some(0), expected.into(), String::new()), "{name}");
        let (code, stdout, _) = measure(&grid, &map, &["--bound", "1"]);
        assert_eq!((code, stdout), (Some(0), format!("{expected}bound                   1 holds\n")));
        let (code, stdout, _) = measure(&grid, &map, &["--bound", "0.9999"]);
        assert_eq!((code, stdout), (Some(1), format!("{expected}bound                   0.9999 is BROKEN\n")));
        let (code, stdout, stderr) = measure(&grid, &map, &["--json", "--samples", "1000", "--seed", "5"]);
        let report: serde_json::Value = serde_json::from_str(&stdout).unwrap();
        assert_eq!((code, report["heights"]["max_at"][0].as_u64()), (Some(0), Some(1)));
        assert_eq!((report["version"].as_u64(), report["surface"]["seed"].as_u64()), (Some(1), Some(5)));
        let distance = report["surface"]["both"]["max"].as_f64().unwrap();
        assert!(distance > 0.0 && distance < 1.0 && stderr.starts_with(expected), "{stderr}");
    }
    let mut holed = grid.clone();
    holed.triangles.remove(3);
    // Nothing is above the bound, but not everything is covered.
    let (code, stdout, _) = measure(&folder.mesh("holed.ply", &holed), &map, &["--bound", "5"]);
    assert!(code == Some(1) && stdout.contains("bound                   5 is BROKEN"), "{stdout}");
}

#[test]
fn measure_prints_the_distance_of_meshes() {
    let folder = Folder::new();
    let fine = folder.mesh("fine.ply", &uniform::with_step(&parabola(), 1).unwrap());
    let coarse = folder.mesh("coarse.obj", &uniform::with_step(&parabola(), 4).unwrap());
    let (code, stdout, stderr) = measure(&coarse, &fine, &["--samples", "4000", "--seed", "9"]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""));
    let words: Vec<Vec<&str>> = stdout.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(words[0], "surface distance from the mesh to the mesh both".split(' ').collect::<Vec<_>>());
    assert_eq!(
        (words[1].as_slice(), words[3].as_slice()),
        (&["triangles", "4", "64"][..], &["points", "4000", "4000", "8000"][..])
    );
    assert_eq!(words.last().unwrap().as_slice(), ["seed", "9"]);
    let max: f64 = words[5][3].parse().unwrap();
    assert!(max > 0.1 && max < 4.0, "{stdout}");
    assert_eq!(measure(&coarse, &fine, &["--samples", "4000", "--seed", "9"]).1, stdout);
    assert_eq!(measure(&coarse, &fine, &["--samples-per-area", "10", "--bound", "4"]).0, Some(0));
    assert_eq!(measure(&coarse, &fine, &["--samples", "100", "--bound", "0.01"]).0, Some(1));
}

#[test]
fn measure_notes_other_units() {
    let folder = Folder::new();
    let mut low = uniform::with_step(&parabola(), 1).unwrap();
    low.positions.iter_mut().for_each(|position| position[2] = -1.0 - position[2]);
    let (low, map) = (folder.mesh("low.obj", &low), folder.map("map.png", &parabola()));
    let (code, _, stderr) = measure(&low, &map, &[]);
    let expected = "note: z runs from -65 to -1, and the map from 0 to 64; z has to be in values of the map\n";
    assert_eq!((code, stderr.as_str()), (Some(0), expected));
    // Eight bits a sample are from 0 to 255.
    let eight = folder.path("eight.png");
    let samples = parabola().samples.iter().map(|sample| *sample as u8).collect::<Vec<_>>();
    image::GrayImage::from_raw(9, 5, samples).unwrap().save(&eight).unwrap();
    let grid = folder.mesh("grid.ply", &uniform::with_step(&parabola(), 1).unwrap());
    let (code, stdout, stderr) = measure(&grid, &eight, &["--bound", "0"]);
    assert!(code == Some(0) && stdout.contains("max error               0.0000 "), "{stdout}");
    assert_eq!(stderr, format!("note: {} has 8 bits a sample: z is from 0 to 255\n", eight.display()));
}

#[test]
fn measure_exits_with_2_on_bad_input() {
    let folder = Folder::new();
    let map = folder.map("map.png", &parabola());
    let small = folder.map("small.png", &HeightMap { width: 8, ..parabola() }.cropped());
    let grid = folder.mesh("grid.obj", &uniform::with_step(&parabola(), 2).unwrap());
    let empty = folder.path("empty.obj");
    std::fs::write(&empty, "v 0 0 0\n").unwrap();
    let text = folder.path("mesh.txt");
    std::fs::write(&text, "scale 1\n").unwrap();
    let none = folder.path("none.png");
    let refused = |mesh: &Path, against: &Path, options: &[&str], sentence: &str| {
        let (code, stdout, stderr) = measure(mesh, against, options);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{stderr}");
        assert!(stderr.contains(sentence), "{stderr}");
    };
    refused(
        &grid,
        &small,
        &[],
        "is outside the map; x, the column, from 0 to 7 and y, the row, from 0 to 4 are expected",
    );
    refused(&empty, &map, &[], "empty.obj: holds no face");
    refused(&text, &map, &[], "mesh.txt: is neither .obj, .ply nor .glb");
    refused(&grid, &none, &[], "none.png: cannot be opened");
    refused(&grid, &text, &[], "mesh.txt: is neither .obj, .ply nor .glb");
    refused(&grid, &map, &["--samples", "0"], "0 points on a surface of area");
    refused(&grid, &map, &["--samples", "1", "--samples-per-area", "1"], "cannot be used with");
    refused(&grid, &map, &["--bound", "nan"], "a finite number from 0 on is expected");
    refused(&grid, &map, &["--samples-per-area=-1"], "a finite number from 0 on is expected");
}

/// As many samples as the size says.
trait Cropped {
    fn cropped(self) -> Self;
}

impl Cropped for HeightMap {
    fn cropped(mut self) -> HeightMap {
        self.samples.truncate(self.width * self.height);
        self
    }
}
