// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief plan` as a program: the planned widths in a declared set, that set's hardware, and what is refused. And
//! `relief wagging`.

use std::fs;
use std::path::Path;
use std::process::Command;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn relief(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_relief")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

const PLATE: &str = "[camera]\neye = [0, -2.6, 1.7]\nnear = 0.3\nfar = 20\nviewport = [320, 240]\n[remesh]\ncell_px = 4\n\
                     [[object]]\nmesh = { kind = \"grid\", cells = [6, 6], size = [2, 2] }\nmap = { kind = \"dents\", size = \
                     [129, 129] }\ndisplacement = [0, 0.1]\n";

/// A plan, the smallest set that has it, the set's hardware over the whole scene, and the run that the plan names.
#[test]
fn plan_is_proved_on_the_hardware_of_its_width_set() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("plate.toml");
    fs::write(&path, PLATE)?;
    let path = path.to_str().ok_or("no path")?;
    let (code, stdout, stderr) = relief(&["plan", path, "--error", "0.1", "--hardware", "--json"]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let report: serde_json::Value = serde_json::from_str(&stdout)?;
    let error = |trial: &serde_json::Value| trial["deviation"]["max"].as_f64().ok_or("no number");
    let (planned, at_set) = (error(&report["plan"]["planned"])?, error(&report["width_set"]["trial"])?);
    assert!(at_set <= planned && planned <= 0.1, "{report}");
    assert_eq!(report["plan"]["widths"]["format"]["components"], 5);
    assert_eq!(report["width_set"]["name"], "terrain");
    let beats = report["width_set"]["beats"].as_u64().ok_or("no beats")?;
    assert!(beats > 20_000, "{report}");
    // What is saved is less than what there is, in look-up tables by components, in block RAM by the column memory.
    let saves = |choice: usize, what: &str| report["saves"][choice][what].as_f64().ok_or("no number");
    assert!(saves(0, "lut")? > 5_000.0 && saves(4, "bram")? > 50.0, "{report}");
    for what in ["lut", "ff"] {
        let part = |of: &str| report["width_set"][of][what].as_f64().ok_or("no number");
        assert!(part("cost")? < part("otherwise_cost")?, "{report}");
    }
    let (code, stdout, _) = relief(&["plan", path]);
    assert_eq!(code, Some(0));
    let command = stdout.lines().find_map(|line| line.strip_prefix("to run it")).ok_or("no command")?.trim().to_owned();
    let out = folder.path().join("out");
    let mut words: Vec<&str> = command.split_whitespace().skip(1).collect();
    words.extend(["--out", out.to_str().ok_or("no path")?]);
    let (code, stdout, stderr) = relief(&words);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    assert!(stdout.lines().any(|line| line.split_whitespace().eq(["width", "set", "terrain"])), "{stdout}");
    assert!(stdout.lines().any(|line| line.split_whitespace().eq(["mismatches", "0"])), "{stdout}");
    Ok(())
}

/// Whatever the width set, the picture is that of its widths: `default` and `terrain` differ by less than shows.
#[test]
fn run_draws_the_same_picture_with_the_lanes_that_vary() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("plate.toml");
    fs::write(&path, PLATE)?;
    let picture = |set: &str| -> Result<_, Box<dyn std::error::Error>> {
        let out = folder.path().join(set);
        let arguments = ["run", path.to_str().ok_or("no path")?, "--param", set, "--out"];
        let (code, stdout, stderr) = relief(&[&arguments[..], &[out.to_str().ok_or("no path")?]].concat());
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
        Ok(image::open(out.join("frame.png"))?.to_rgb8())
    };
    let (whole, fewer, narrow) = (picture("default")?, picture("terrain")?, picture("small")?);
    for other in [&fewer, &narrow] {
        let pairs = whole.pixels().zip(other.pixels());
        let far = pairs.filter(|(a, b)| (0..3).any(|k| a[k].abs_diff(b[k]) > 40)).count();
        // A vertex that is rounded another way moves an edge by a pixel now and then.
        assert!(far * 100 < whole.pixels().len(), "{far} of {} pixels", whole.pixels().len());
    }
    assert!(whole != narrow);
    Ok(())
}

#[test]
fn plan_and_run_refuse_with_a_sentence() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("scene.toml");
    let file = path.to_str().ok_or("no path")?;
    fs::write(&path, PLATE)?;
    let refused = |arguments: &[&str], sentence: &str| {
        let (code, stdout, stderr) = relief(arguments);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{stderr}");
        assert!(stderr.contains(sentence), "{stderr}");
    };
    refused(&["plan", file, "--error", "0.001"], "px with the widest formats");
    refused(&["plan", file, "--error", "-1"], "a number of pixels from 0.001 to 64 is expected");
    refused(&["plan", "nowhere.toml"], "nowhere.toml: cannot be opened");
    refused(&["run", file, "--param", "narrow"], "there is no width set `narrow`");
    refused(&["run", file, "--levels", "0"], "0 is not in 1..=15");
    let few = "width set position: the remesher format has vertices of 3 components of 32 bits, and this draw takes 5";
    refused(&["run", file, "--param", "position"], few);
    refused(
        &["run", file, "--param", "position"],
        "the width sets default, large, terrain, terrain_large, small, deep have it",
    );
    // Rules that only golden has, by name and line.
    for (rule, expected) in
        [("footprint = \"paper\"", "\"density\" is expected"), ("extremum = \"triangle\"", "\"vertex\" is expected")]
    {
        fs::write(&path, PLATE.replace("cell_px = 4", &format!("cell_px = 4\n{rule}")))?;
        let (field, value) = rule.split_once(" = ").ok_or("no value")?;
        let sentence = format!("scene.toml:6: [remesh] `{field}` is {value}, which no draw of the hardware has");
        refused(&["plan", file], &sentence);
        refused(&["run", file], &sentence);
        refused(&["run", file, "--engine", "design"], expected);
    }
    // A sphere's normals vary, so five components are too few.
    let sphere = PLATE.replace("kind = \"grid\", cells = [6, 6], size = [2, 2]", "kind = \"sphere\"");
    fs::write(&path, sphere.replace("[129, 129]", "[128, 129]"))?;
    let sphere = "[[object]] 1: width set terrain: the remesher format has vertices of 5 components of 28 bits, and this draw \
                  takes 9";
    refused(&["run", file, "--param", "terrain"], sphere);
    // A grid coordinate too narrow is a warning that says what width would do.
    let long = PLATE.replace("size = [2, 2]", "size = [0.01, 5]").replace("cell_px = 4", "cell_px = 1");
    let long = long.replace("[320, 240]", "[640, 480]");
    fs::write(&path, long.replace("near = 0.3", "near = 0.05").replace("[0, -2.6, 1.7]", "[0, -2.6, 0.1]"))?;
    let out = folder.path().join("out");
    let (code, stdout, stderr) = relief(&["run", file, "--param", "small", "--out", out.to_str().ok_or("no path")?]);
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    let warned = "because the voxel grid of 11 bits does not reach them; a greater `cell_px` is what reaches farther, or 12 \
                  bits of a grid coordinate: the width sets";
    assert!(stderr.contains(warned) && stderr.contains("terrain"), "{stderr}");
    Ok(())
}

#[test]
fn wagging_prints_a_row_for_each_cell_and_filter() -> Outcome {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/jacksboro_far.toml");
    let scene = scene.to_str().ok_or("no path")?;
    let (code, stdout, stderr) = relief(&["wagging", scene, "--frames", "3", "--cells", "4,16", "--json"]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let report: serde_json::Value = serde_json::from_str(&stdout)?;
    let rows = report["rows"].as_array().ok_or("no rows")?;
    assert_eq!(rows.len(), 4);
    assert!(rows.iter().all(|row| row["wagging"].as_f64().is_some_and(|wagging| wagging > 0.0)), "{report}");
    assert_eq!(relief(&["wagging", scene, "--cells", "0.5"]).0, Some(2));
    Ok(())
}
