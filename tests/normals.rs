// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief normals` as a program: figures, scale, bad input.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;

type Outcome = Result<(), Box<dyn Error>>;

fn normals(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
    let output = command.arg("normals").args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn jacksboro() -> String {
    format!("{}/scenes/maps/jacksboro.png", env!("CARGO_MANIFEST_DIR"))
}

/// The table of docs/blocks/gradient_normal.md, to the digit.
#[test]
fn normals_prints_the_table_of_the_documents() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scale = ["--size", "29.9,31.9", "--displacement", "0.236,1.076"];
    let (code, stdout, stderr) = normals(folder.path(), &[&[&*jacksboro()], &scale[..]].concat());
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/blocks/gradient_normal.md"))?;
    let rows: Vec<&str> = stdout.lines().skip(3).collect();
    assert_eq!(rows.len(), 5, "{stdout}");
    for row in rows {
        let cells: Vec<&str> = row.split_whitespace().collect();
        assert!(page.contains(&format!("| {} |", cells.join(" | "))), "{row}");
    }
    Ok(())
}

#[test]
fn normals_writes_json_for_any_steps() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (code, stdout, stderr) = normals(folder.path(), &[&jacksboro(), "--steps", "33,3", "--json"]);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stderr.contains("403 x 344 samples over 402 x 343, displaced 0 to 10.05"), "{stderr}");
    let report: serde_json::Value = serde_json::from_str(&stdout)?;
    assert_eq!((&report["version"], &report["width"], &report["size"][1]), (&1.into(), &403.into(), &343.0.into()));
    let rows = |at: usize| report["steps"][at]["shadings"].as_array().cloned().unwrap_or_default();
    assert_eq!([rows(0).len(), rows(1).len()], [4, 4]);
    assert_eq!((&report["steps"][0]["step"], &report["steps"][1]["step"]), (&3.into(), &33.into()));
    assert!(rows(0).iter().all(|row| row["rms"].as_f64() > Some(1.0) && row["most"].as_f64() > row["rms"].as_f64()));
    assert_eq!(rows(1).iter().map(|row| &row["level"]).collect::<Vec<_>>(), [0, 4, 5, 4]);
    Ok(())
}

/// No displacement, no slope; a map of 8 bits has its warning.
#[test]
fn normals_takes_flat_land_and_few_bits() -> Outcome {
    let folder = tempfile::tempdir()?;
    image::GrayImage::from_fn(30, 40, |x, y| image::Luma([(x * y % 251) as u8])).save(folder.path().join("map.png"))?;
    let flat = ["map.png", "--steps", "1,5", "--displacement", "-1,-1"];
    let (code, stdout, stderr) = normals(folder.path(), &flat);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stderr.starts_with("warning: map.png: has 8 bits a sample") && stderr.lines().count() == 1, "{stderr}");
    assert_eq!(stdout.matches(" 0.00").count(), 8, "{stdout}");
    Ok(())
}

#[test]
fn normals_refuses_bad_input() -> Outcome {
    let folder = tempfile::tempdir()?;
    image::GrayImage::from_pixel(30, 100, image::Luma([9])).save(folder.path().join("small.png"))?;
    fs::write(folder.path().join("text.png"), "no picture")?;
    let lengths = "two lengths from 1e-9 to 1e9 are expected, such as 29.9,31.9";
    let heights = "two finite numbers are expected, such as 0.236,1.076";
    for (arguments, sentence) in [
        (&["none.png"][..], "none.png: cannot be opened"),
        (&["text.png"], "text.png: is no PNG"),
        (
            &["small.png"],
            "small.png: the map has 30 x 100 samples, and a grid of 16 texels needs at least 51 on each side",
        ),
        (&["small.png", "--steps", "0"], "a number of texels from 1 to 1024 is expected"),
        (&["small.png", "--size", "5"], lengths),
        (&["small.png", "--size", "5,0"], lengths),
        (&["small.png", "--size", "5,-1"], lengths),
        (&["small.png", "--displacement", "1"], heights),
        (&["small.png", "--displacement", "-1,inf"], heights),
        (
            &["small.png", "--steps", "1", "--displacement", "-1e6,1e6"],
            "small.png: a range of heights of 2000000 over texels of 1 is too steep; at most 62258.2 is expected",
        ),
    ] {
        let (code, stdout, stderr) = normals(folder.path(), arguments);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(stderr.contains(sentence), "{arguments:?}: {stderr}");
    }
    Ok(())
}
