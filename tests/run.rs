// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief run` as a program: what it writes, closed bodies, bad scenes, and the Verilog behind it.

use relief_hdl::widths::large;
use relief_models::mesh::{self, CheckOptions};
use relief_models::mip_build;
use relief_models::mip_fetch::{Command, Filter};
use relief_testbench::cosim::tools;
use relief_testbench::mip_fetch::MipFetchBinding;
use relief_testbench::pipeline::BLOCKS;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Exit code, stdout and stderr.
fn run(scene: &Path, options: &[&str]) -> (Option<i32>, String, String) {
    let output =
        process::Command::new(env!("CARGO_BIN_EXE_relief")).arg("run").arg(scene).args(options).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn scene(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)).unwrap()
}

/// Edges of the mesh that are not used as often in one direction as in the other.
fn open_edges(obj: &str) -> usize {
    let mut uses: HashMap<[u32; 2], i64> = HashMap::new();
    for line in obj.lines().filter_map(|line| line.strip_prefix("f ")) {
        let corners: Vec<u32> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            *uses.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
        }
    }
    uses.values().filter(|uses| **uses != 0).count()
}

#[test]
fn run_writes_pictures_mesh_waveform_verilog_and_report() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("small.toml");
    let maps = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/maps/jacksboro.png");
    let text = scene("jacksboro.toml").replace("maps/jacksboro.png", maps.to_str().ok_or("no path")?);
    fs::write(&path, text.replace("cell_px = 2.0", "cell_px = 8.0").replace("[640, 480]", "[160, 120]"))?;
    let out = folder.path().join("out");
    let (code, stdout, stderr) = run(&path, &["--out", out.to_str().ok_or("no path")?]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let mut names: Vec<_> =
        fs::read_dir(&out)?.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    let expected = ["frame.png", "mesh.obj", "mesh.png", "pipeline.gtkw", "pipeline.vcd", "report.json", "rtl"];
    assert_eq!(names, expected);
    let picture = image::open(out.join("frame.png"))?;
    assert_eq!((picture.width(), picture.height()), (160, 120));
    let report: serde_json::Value = serde_json::from_str(&fs::read_to_string(out.join("report.json"))?)?;
    assert_eq!(report["mismatches"], 0);
    assert_eq!(report["width_set"], "large");
    assert_eq!((&report["scene"], &report["engine"]), (&path.to_str().into(), &"rust".into()));
    assert_eq!(report["assembled"]["culled"]["left"], 0, "{report}");
    assert_eq!(report["warnings"].as_array().map(Vec::len), Some(0), "{report}");
    let number = |value: &serde_json::Value| value.as_f64().ok_or("no number");
    let (counts, two) = (&report["pipeline"], number(&report["cycles_per_two_triangles"])?);
    assert!((two - 2.0 * number(&counts["cycles"])? / number(&counts["triangles"])?).abs() < 1e-9, "{report}");
    let each = number(&report["vertices_per_triangle"])?;
    assert!((each - number(&counts["vertices"])? / number(&counts["triangles"])?).abs() < 1e-9, "{report}");
    assert!(number(&report["seconds"])? > 0.0);
    let blocks: Vec<_> = report["hardware"].as_array().ok_or("no blocks")?.iter().map(|block| &block["name"]).collect();
    assert_eq!(blocks, BLOCKS);
    assert_eq!(report["golden"], serde_json::json!(["raster"]));
    assert!(stdout.contains(&format!("cycles                     {} ({two:.3} for two", counts["cycles"])), "{stdout}");
    // Every node of the levels above the map came from hardware: 403 x 344 samples have 46,986.
    assert_eq!(report["hardware"][0]["beats"], 46_986);
    assert!(report["pipeline"]["triangles"].as_u64().is_some_and(|triangles| triangles > 300), "{report}");
    assert!(report["pixels"].as_u64().is_some_and(|pixels| pixels > 3_000), "{report}");
    for block in report["hardware"].as_array().ok_or("no blocks")? {
        // 81 base vertices, 128 base triangles, and more of everything else.
        let least = match block["name"].as_str() {
            Some("vertex_transform") => 81,
            Some("cull") => 128,
            _ => 300,
        };
        let beats = block["beats"].as_u64();
        // Nothing is cut, and all vertices read maxima.
        let idle = ["clip", "facing"].iter().any(|name| block["name"] == *name) && beats == Some(0);
        assert!(beats.is_some_and(|beats| beats >= least) || idle, "{block}");
    }
    // A group for each base triangle, and one rim.
    let obj = fs::read_to_string(out.join("mesh.obj"))?;
    let groups: Vec<&str> = obj.lines().filter_map(|line| line.strip_prefix("g base_")).collect();
    assert_eq!(groups, (0..128).map(|k| k.to_string()).collect::<Vec<_>>());
    let mesh = mesh::read(&out.join("mesh.obj"), None, &())?;
    let checked = mesh::check(&mesh, &CheckOptions::default(), &());
    assert!(checked.to_string().contains("in 1 boundary loop: OK"), "{checked}");
    let waves = relief_waves::read(out.join("pipeline.vcd"))?;
    for signal in ["relief.remesher.out_valid", "relief.mip_fetch.in_valid", "relief.strip_unit.out_valid"] {
        assert!(waves.trace(signal).is_some_and(|trace| trace.changes() > 1), "{signal}");
    }
    for block in BLOCKS {
        assert!(out.join("rtl").join(block).join(format!("relief_{block}.sv")).is_file());
    }
    Ok(())
}

/// A sphere with seam and poles, nothing culled: every edge is used as often one way as the other.
#[test]
fn run_keeps_a_closed_body_closed() -> Outcome {
    let folder = tempfile::tempdir()?;
    // A map of 60 rows puts its last row between the nodes of most levels.
    for (cell, map) in [(3, "[256, 129]"), (9, "[256, 129]"), (27, "[256, 129]"), (9, "[96, 60]")] {
        let path = folder.path().join("sphere.toml");
        let text = scene("sphere.toml");
        assert!(text.contains("[256, 129]") && text.contains("cell_px = 2.0"));
        let text = text.replace("cell_px = 2.0", &format!("cell_px = {cell}.0\ncull = false"));
        fs::write(&path, text.replace("[256, 129]", map))?;
        let out = folder.path().join("out");
        let (code, stdout, stderr) = run(&path, &["--out", out.to_str().ok_or("no path")?]);
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
        let obj = fs::read_to_string(out.join("mesh.obj"))?;
        assert!(obj.lines().filter(|line| line.starts_with("f ")).count() > 500);
        assert_eq!(open_edges(&obj), 0, "cells of {cell} pixels, a map of {map}");
    }
    Ok(())
}

/// The frame of docs/scene.md. A step makes up to two triangles, so 1.10 cycles a triangle is twice what is allowed here.
#[test]
fn run_draws_a_terrain_of_860_thousand_triangles() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/terrain_25km.toml");
    let (code, stdout, stderr) = run(&path, &["--out", folder.path().join("out").to_str().ok_or("no path")?]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let number = |line: &str, at: usize| {
        let line = stdout.lines().find(|found| found.trim_start().starts_with(line)).unwrap_or_default();
        let mut numbers = line.split([' ', ',']).filter_map(|word| word.parse::<u64>().ok());
        numbers.nth(at).unwrap_or_else(|| panic!("no `{line}` in {stdout}"))
    };
    let (triangles, cycles) = (number("triangles", 0), number("cycles", 0));
    assert!((850_000..870_000).contains(&triangles), "{stdout}");
    assert!(100 * cycles <= 55 * triangles, "{cycles} cycles for {triangles} triangles");
    let waiting = number("of them waiting", 0) + number("of them waiting", 1);
    assert!(100 * waiting <= cycles, "{waiting} of {cycles} cycles are waits");
    assert!(stdout.lines().any(|line| line.split_whitespace().eq(["mismatches", "0"])), "{stdout}");
    Ok(())
}

/// What may surprise is said before the work, in one sentence with its place and what would be right.
#[test]
fn run_warns_of_what_may_surprise() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (path, out) = (folder.path().join("scene.toml"), folder.path().join("out"));
    let sphere = scene("sphere.toml").replace("cell_px = 2.0", "cell_px = 27.0\ncull = false");
    let donut = scene("half_donut.toml").replace("cell_px = 2.0", "cell_px = 16.0");
    for (text, from, to, warnings) in [
        (&sphere, "near = 0.2", "near = 0.002", &[][..]),
        (
            &sphere,
            "near = 0.2",
            "near = 0.0005",
            &[
                "`far` is 40000 times `near`",
                "[[object]] 1: the seam of its map may open",
                "`near` of at least 0.00132",
            ],
        ),
        (
            &sphere,
            "eye = [0.4, -1.9, 1.0]\ntarget = [0.0, 0.0, 0.0]",
            "eye = [0.0, -0.1, 0.67]\ntarget = [0.0, 1.0, 0.4]",
            &[
                "of its 1152 base triangles are cut, at `near` / 16",
                "an `eye` farther away keeps them whole",
                "triangles reach to the eye or behind it, so the mesh is open there",
            ],
        ),
        (
            &donut,
            "target = [0.0, 0.0, 0.1]",
            "target = [0.0, -9.0, 1.7]",
            &["[camera] nothing of the scene is in view (6 beyond the left side, 2 beyond the right side"],
        ),
        (&donut, "fov_y_deg = 45.0", "fov_y_deg = 179.9", &["no pixel shows anything of it"]),
    ] {
        assert!(text.contains(from), "{from}");
        fs::write(&path, text.replace(from, to))?;
        let (code, stdout, stderr) = run(&path, &["--out", out.to_str().ok_or("no path")?]);
        assert_eq!(code, Some(0), "{to}: {stdout}{stderr}");
        assert_eq!(stderr.is_empty(), warnings.is_empty(), "{to}: {stderr}");
        assert!(
            stderr.lines().all(|line| line.starts_with("warning: ") && line.contains("scene.toml")),
            "{to}: {stderr}"
        );
        assert!(warnings.iter().all(|warning| stderr.contains(warning)), "{to}: {stderr}");
        let report: serde_json::Value = serde_json::from_str(&fs::read_to_string(out.join("report.json"))?)?;
        let told = report["warnings"].as_array().ok_or("no warnings")?;
        assert_eq!(told.len(), stderr.lines().count(), "{to}");
        let cut = report["assembled"]["cut"].as_u64().ok_or("no count")?;
        assert_eq!(cut > 0, to.contains("0.67"), "{to}: {cut}");
        assert!(stdout.contains(&format!(", {cut} cut, ")), "{stdout}");
    }
    Ok(())
}

/// The longest sides that the memory counts: what the map holds and what its levels hold are compared like all else.
#[test]
fn run_takes_the_longest_maps() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (path, out) = (folder.path().join("scene.toml"), folder.path().join("out"));
    for size in ["[2047, 11]", "[11, 2047]", "[2046, 1]", "[1, 1]", "[625, 625]"] {
        let text = scene("half_donut.toml").replace("cell_px = 2.0", "cell_px = 24.0").replace("half_donut", "ramp");
        fs::write(&path, text.replace("[256, 256]", size))?;
        let (code, stdout, stderr) = run(&path, &["--out", out.to_str().ok_or("no path")?]);
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{size}: {stdout}");
        assert!(stdout.contains("mismatches                 0"), "{size}: {stdout}");
    }
    Ok(())
}

/// A program that is told to stop takes everything away that it has made, and nothing else.
#[cfg(unix)]
#[test]
fn run_leaves_nothing_when_it_is_stopped() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("scene.toml");
    fs::write(
        &path,
        scene("jacksboro.toml")
            .replace("cell_px = 2.0", "cell_px = 1.0")
            .replace("{ file = \"maps/jacksboro.png\" }", "{ kind = \"peaks\", size = [600, 600] }"),
    )?;
    for (out, stays) in [("new/out", false), ("old", true)] {
        let out = folder.path().join(out);
        if stays {
            fs::create_dir(&out)?;
        }
        let mut command = process::Command::new(env!("CARGO_BIN_EXE_relief"));
        let pipes = || process::Stdio::null();
        let mut child = command.arg("run").arg(&path).arg("--out").arg(&out).stdout(pipes()).stderr(pipes()).spawn()?;
        // Once the last of its files is open, the work is about to begin.
        let id = child.id();
        let waits = (0..2_000).take_while(|_| !out.join(format!(".pipeline.gtkw.{id}")).exists());
        waits.for_each(|_| std::thread::sleep(std::time::Duration::from_millis(5)));
        assert!(process::Command::new("kill").args(["-INT", &id.to_string()]).status()?.success());
        assert_eq!(child.wait()?.code(), Some(130));
        assert_eq!(out.exists(), stays);
        assert!(!folder.path().join("new").exists());
        if stays {
            assert_eq!(fs::read_dir(&out)?.count(), 0);
        }
    }
    Ok(())
}

/// Every texel of the map, as the hardware fetches it, is that of another reader of the file.
#[test]
fn run_heights_are_those_of_the_file() -> Outcome {
    use relief_testbench::mip_fetch::{command_beat, load_beats};
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/maps/jacksboro.png");
    let (map, _) = relief_models::map::read(&path, &|_| Ok(()))?;
    let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(&path)?)).read_info()?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("no size")?];
    let info = reader.next_frame(&mut bytes)?;
    assert_eq!((info.width, info.height, info.bit_depth), (403, 344, png::BitDepth::Sixteen));
    let expected: Vec<u64> = bytes.chunks(2).map(|pair| u64::from(pair[0]) << 16 | u64::from(pair[1]) << 8).collect();

    let clamp = [mip_build::Wrap::Clamp; 2];
    let (node, max) = (mip_build::Centring::Node, mip_build::Extremum::Max);
    let pyramid = mip_build::golden(map.width, map.height, &map.samples, node, clamp, max, 1)?;
    let texels = (0..344u32).flat_map(|v| (0..403u32).map(move |u| (u << 16, v << 16)));
    let fetches =
        texels.map(|(u, v)| command_beat(&Command::Fetch { level: 0, u, v, filter: Filter::Bilinear, minima: false }));
    let beats = load_beats(&pyramid).into_iter().chain(fetches);
    let mut scoreboard = Scoreboard::new(&MipFetchBinding, &large::SET, Box::new(beats), Pattern::NONE);
    let value = scoreboard.layout().output("out_value");
    let mut heights = Vec::new();
    let valid = scoreboard.layout().out_valid;
    let outcome = scoreboard.run(Until::Exhausted, &mut |_, _, outputs| {
        heights.extend((outputs[valid] == 1).then(|| outputs[value]));
        Ok(())
    });
    outcome.map_err(|mismatch| mismatch.to_string())?;
    assert!(heights == expected, "{} heights", heights.len());
    Ok(())
}

#[test]
fn run_verilog_follows_every_cycle() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "the pipeline in Verilator")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("donut.toml");
    let text = scene("half_donut.toml").replace("cell_px = 2.0", "cell_px = 16.0").replace("[256, 256]", "[48, 40]");
    fs::write(&path, text)?;
    let out = folder.path().join("out");
    let (code, stdout, stderr) = run(&path, &["--out", out.to_str().ok_or("no path")?, "--engine", "verilator"]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let report: serde_json::Value = serde_json::from_str(&fs::read_to_string(out.join("report.json"))?)?;
    for block in report["hardware"].as_array().ok_or("no blocks")? {
        assert!(block["followed_cycles"].as_u64().is_some_and(|cycles| cycles > 500), "{block}");
    }
    Ok(())
}

/// Over the surface at less than its displacement, and with fine cells.
fn low(text: &str) -> String {
    text.replace("near = 0.3", "near = 0.002").replace("cell_px = 2.0", "cell_px = 1.0")
}

#[test]
fn run_bad_input_is_a_sentence_and_writes_nothing() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let good = scene("half_donut.toml");
    for (from, to, sentence) in [
        ("near = 0.3", "near = 0.0", "near"),
        ("far = 20.0", "far = 0.1", "far"),
        ("near = 0.3", "near = nan", "near"),
        ("up = [0.0, 0.0, 1.0]", "up = [0.0, 0.0, 1.0]\nzoom = 2", "zoom"),
        ("viewport = [640, 480]", "viewport = [0, 480]", "viewport"),
        ("map = { kind = \"half_donut\", size = [256, 256] }", "map = { file = \"none.png\" }", "none.png"),
        ("size = [256, 256]", "size = [4000, 4000]", "limit"),
        ("target = [0.0, 0.0, 0.1]", "target = [0.0, -2.6, 1.7]", "target"),
        ("displacement = [0.0, 0.3]", "displacement = [0.0, inf]", "displacement"),
        ("near = 0.3", "near = 1e-8", "bad.toml:2: [camera] `near` is 1e-8, and the scene reaches out to 2.6, which"),
        (
            "fov_y_deg = 45.0",
            "fov_y_deg = 0.01",
            "bad.toml:2: [camera] `fov_y_deg` is 0.01 over 480 rows of `viewport`",
        ),
        ("displacement = [0.0, 0.3]", "displacement = [0, 1e6]", "bad.toml:14: [[object]] 1: `displacement` reaches"),
        (
            "size = [256, 256]",
            "size = [626, 626]",
            "bad.toml:14: [[object]] 1: the map half_donut of 626 x 626 samples",
        ),
        ("size = [256, 256]", "size = [2048, 9]", "bad.toml:14: [[object]] 1: the first number of `size` is 2048; a"),
        (
            "viewport = [640, 480]",
            "viewport = [64, 48, 7]",
            "bad.toml:9: [camera] `viewport` has 3 values; 2 are expected",
        ),
        ("[[light]]", "[light]", "bad.toml:20: `light` is a table; [[light]], in double brackets, is expected"),
        // A very low eye over few base triangles: what would be small enough has been tried.
        (
            "eye = [0.0, -2.6, 1.7]",
            "eye = [0.0, -1.0, 0.32]",
            "triangles would come of this scene, beyond the limit of 33554432; a `cell_px` of ",
        ),
    ] {
        assert!(good.contains(from), "{from}");
        let path = folder.path().join("bad.toml");
        fs::write(&path, if to.contains("0.32") { low(&good).replace(from, to) } else { good.replace(from, to) })?;
        let (code, _, stderr) = run(&path, &["--out", out.to_str().ok_or("no path")?]);
        assert_eq!(code, Some(2), "{to}: {stderr}");
        assert!(stderr.starts_with("error: ") && stderr.contains(sentence), "{to}: {stderr}");
        assert!(!out.exists(), "{to}");
    }
    let (code, _, stderr) = run(Path::new("/nowhere/scene.toml"), &[]);
    assert!(code == Some(2) && stderr.contains("/nowhere/scene.toml"), "{stderr}");
    Ok(())
}
