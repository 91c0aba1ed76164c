// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief bake` as a program: the folder that it leaves, what it refuses, and its exit codes.

use image::{GrayImage, ImageBuffer, Luma};
use relief_models::bake::Baked;
use relief_models::bisector::golden;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Exit code, stdout and stderr.
fn bake(map: &Path, options: &[&str], out: &Path) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
    let output = command.arg("bake").arg(map).args(options).arg("--out").arg(out).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// A hilly map of 16 bits with a void of 2 x 3 samples.
fn hills(folder: &Path, width: u32, height: u32) -> PathBuf {
    let path = folder.join("hills.png");
    let sample = |x: u32, y: u32| {
        let void = (5..7).contains(&x) && (4..7).contains(&y);
        Luma([if void { 65535u16 } else { ((x * x * 7 + y * y * 11 + x * y) % 5000) as u16 }])
    };
    ImageBuffer::from_fn(width, height, sample).save(&path).unwrap();
    path
}

#[test]
fn bake_writes_a_folder_that_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let (map, out) = (hills(folder.path(), 40, 31), folder.path().join("out"));
    let options = ["--what", "split,errors,mips,sat,normals", "--bound", "250.5", "--void", "65535", "--effort", "2"];
    let (code, stdout, stderr) = bake(&map, &options, &out);
    assert_eq!(code, Some(0), "{stderr}");
    let note = format!("note: {}: 6 samples are void (65535), filled from their rim in 1 rounds\n", map.display());
    assert_eq!(stderr, note);
    let baked = Baked::read(&out).unwrap();
    let entry = baked.manifest.split.as_ref().unwrap();
    assert_eq!((entry.bound.as_str(), entry.fitted, entry.effort), ("501/2", true, Some(2)));
    assert!(stdout.contains(&format!("triangles      {} (fitted heights, 2 rounds of search)\n", entry.triangles)));
    assert_eq!(golden(&baked.lattice, baked.split.as_ref().unwrap(), &mut |_| ()).triangles, entry.triangles);
    assert!(entry.maximum_decimal <= 250.5 && entry.maximum_decimal > 100.0);
    assert_eq!((baked.manifest.map.name.as_str(), baked.manifest.map.filled), ("hills.png", 6));
    assert!(baked.map.samples.iter().all(|&sample| sample < 5000));
    // Another run replaces it: what is not asked for again goes, what is not ours stays.
    fs::write(out.join("notes.txt"), "mine").unwrap();
    let options = ["--what", "split", "--bound", "250.5", "--unfitted", "--void", "65535"];
    assert_eq!(bake(&map, &options, &out).0, Some(0));
    assert_eq!(names(&out), ["bake.json", "map.png", "notes.txt", "split.png"]);
    let unfitted = Baked::read(&out).unwrap().manifest.split.unwrap();
    assert!(!unfitted.fitted && unfitted.triangles > entry.triangles, "{unfitted:?}");
}

#[test]
fn bake_takes_maps_of_8_bits_with_their_own_values() {
    let folder = tempfile::tempdir().unwrap();
    let (map, out) = (folder.path().join("eight.png"), folder.path().join("out"));
    GrayImage::from_fn(9, 5, |x, y| Luma([(x + 10 * y) as u8])).save(&map).unwrap();
    let (code, _, stderr) = bake(&map, &["--what", "errors"], &out);
    let warning = format!(
        "warning: {}: has 8 bits a sample, so heights are 0 to 255 in steps; 16-bit grey is smooth\n",
        map.display()
    );
    assert_eq!((code, stderr), (Some(0), warning));
    assert_eq!(Baked::read(&out).unwrap().map.samples[..11], [0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11]);
}

#[test]
fn bake_refuses_bad_input_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (map, out) = (hills(folder.path(), 40, 31), folder.path().join("out"));
    let small = folder.path().join("small.png");
    ImageBuffer::from_pixel(1, 7, Luma([5u16])).save(&small).unwrap();
    let large = folder.path().join("large.png");
    ImageBuffer::from_pixel(4098, 2, Luma([5u16])).save(&large).unwrap();
    let colour = folder.path().join("colour.png");
    image::RgbImage::new(4, 4).save(&colour).unwrap();
    let void = folder.path().join("void.png");
    ImageBuffer::from_pixel(4, 4, Luma([5u16])).save(&void).unwrap();
    let text = folder.path().join("text.png");
    fs::write(&text, "no picture").unwrap();
    let before = names(folder.path());
    let cases: [(&Path, &[&str], &str); 12] = [
        (&map, &["--what", "split"], "`--what split` needs a bound; for example --bound 16.8"),
        (&map, &["--what", "errors", "--bound", "3"], "`--bound` is for `--what split`"),
        (&map, &["--what", "split", "--bound", "-3"], "`-3` is no bound; a number of map units from 0 to 65535"),
        (&map, &["--what", "split", "--bound", "3", "--effort", "some"], "quick (1 round), default (8), high (48)"),
        (&map, &["--what", "splat"], "[possible values: split, errors, mips, sat, normals]"),
        (&map, &["--what", "normals", "--spacing", "0"], "a length from 0.000001 to 1000000000 is expected"),
        (&small, &["--what", "sat"], "is a map of 1 x 7 samples; 2 x 2 to 4097 x 4097 is expected"),
        (&large, &["--what", "sat"], "is a map of 4098 x 2 samples; 2 x 2 to 4097 x 4097 is expected"),
        (&colour, &["--what", "sat"], "is a colour picture; a height map is 16-bit grey without alpha"),
        (&text, &["--what", "sat"], "is no PNG"),
        (&void, &["--what", "sat", "--void", "5"], "has no sample but voids, 5; at least one height is expected"),
        (Path::new("none.png"), &["--what", "sat"], "none.png: cannot be opened"),
    ];
    for (map, options, sentence) in cases {
        let (code, stdout, stderr) = bake(map, options, &out);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{options:?}: {stderr}");
        assert!(stderr.contains(sentence), "{options:?}: {stderr}");
        assert_eq!(names(folder.path()), before, "{options:?}");
    }
    let (code, _, stderr) = bake(&map, &["--what", "sat"], &map);
    assert_eq!(code, Some(2));
    assert!(stderr.contains("hills.png: is a file; a folder is expected"), "{stderr}");
}
