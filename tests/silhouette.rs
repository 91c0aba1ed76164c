// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief silhouette` as a program: figures, drawings, bad input.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;

type Outcome = Result<(), Box<dyn Error>>;

fn silhouette(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
    let output = command.arg("silhouette").args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn jacksboro() -> String {
    format!("{}/scenes/maps/jacksboro.png", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn silhouette_prints_and_draws() -> Outcome {
    let folder = tempfile::tempdir()?;
    fs::create_dir(folder.path().join("pictures"))?;
    fs::write(folder.path().join("pictures/silhouette-7.svg"), "old")?;
    fs::write(folder.path().join("pictures/mine.svg"), "kept")?;
    let (code, stdout, stderr) = silhouette(folder.path(), &[&jacksboro(), "--out", "pictures"]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let mut rows = stdout.lines().filter(|line| line.starts_with("  node-max"));
    let rms = rows.by_ref().map(|row| row.split_whitespace().nth(2).unwrap().parse::<f64>().unwrap());
    assert!(rms.zip([1.5, 2.5, 4.4]).all(|(rms, most)| 0.5 < rms && rms <= most), "{stdout}");
    assert_eq!(stdout.lines().count(), 2 + 3 * 10, "{stdout}");
    let folder_of = fs::read_dir(folder.path().join("pictures"))?;
    let mut names: Vec<_> = folder_of.map(|at| at.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    let steps =
        ["10", "20", "5"].into_iter().flat_map(|step| ["png", "svg"].map(|end| format!("silhouette-{step}.{end}")));
    assert_eq!(names, ["mine.svg".to_owned()].into_iter().chain(steps).collect::<Vec<_>>());
    for step in [5, 10, 20] {
        let picture = image::open(folder.path().join(format!("pictures/silhouette-{step}.png")))?.to_rgb8();
        let is = |colour: [u8; 3]| picture.pixels().filter(|pixel| pixel.0 == colour).count();
        // The map, and lines of two filters.
        assert!(is([214, 210, 200]) > 100_000 && is([0, 114, 178]) > 500 && is([213, 94, 0]) > 500, "{step}");
        let svg = fs::read_to_string(folder.path().join(format!("pictures/silhouette-{step}.svg")))?;
        assert!(svg.contains("jacksboro: horizon of a grid of") && svg.contains("node-max"), "{step}");
    }
    Ok(())
}

#[test]
fn silhouette_writes_json_for_any_steps() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (code, stdout, stderr) = silhouette(folder.path(), &[&jacksboro(), "--steps", "1,33", "--json"]);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stderr.contains("step        33 texels"), "{stderr}");
    let report: serde_json::Value = serde_json::from_str(&stdout)?;
    assert_eq!((&report["version"], &report["width"]), (&1.into(), &403.into()));
    let filters = |at: usize| report["steps"][at]["filters"].as_array().cloned().unwrap_or_default();
    assert_eq!((filters(0).len(), filters(1).len()), (8, 8));
    // A grid of every texel is the map.
    assert!(filters(0).iter().all(|row| row["rms"] == 0.0 && row["level"] == 0));
    assert!(filters(1).iter().all(|row| row["rms"].as_f64() > Some(1.0)));
    assert!(folder.path().join("out/silhouette/silhouette-33.png").is_file());
    Ok(())
}

#[test]
fn silhouette_refuses_bad_input() -> Outcome {
    let folder = tempfile::tempdir()?;
    image::GrayImage::from_pixel(30, 100, image::Luma([9])).save(folder.path().join("small.png"))?;
    fs::write(folder.path().join("text.png"), "no picture")?;
    for (arguments, sentence) in [
        (&["none.png"][..], "none.png: cannot be opened"),
        (&["text.png"], "text.png: is no PNG"),
        (
            &["small.png"],
            "small.png: the map has 30 x 100 samples, and a grid of 20 texels needs at least 40 on each side",
        ),
        (&["small.png", "--steps", "0"], "a number of texels from 1 to 1024 is expected"),
        (&["small.png", "--steps", "5,x"], "a number of texels from 1 to 1024 is expected"),
        (&["small.png", "--steps", "5", "--out", "text.png"], "text.png: is a file; a folder is expected"),
    ] {
        let (code, stdout, stderr) = silhouette(folder.path(), arguments);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(stderr.contains(sentence), "{arguments:?}: {stderr}");
        assert!(!folder.path().join("out").exists(), "{arguments:?}");
    }
    // A map of one height has no range: one unit stands for it.
    let (code, stdout, _) = silhouette(folder.path(), &["small.png", "--steps", "5"]);
    assert_eq!(code, Some(0));
    assert!(stdout.lines().filter(|line| line.contains("node-max")).all(|line| line.contains(" 0.00 ")), "{stdout}");
    Ok(())
}
