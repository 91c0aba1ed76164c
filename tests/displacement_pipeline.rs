// SPDX-License-Identifier: MIT OR Apache-2.0
//! The whole datapath as one design: against the golden machine, and a scene through it.

mod common;

use relief_hdl::widths::{large, small, terrain};
use relief_testbench::binding::{Binding, Expected, expect_offered, offered_sets};
use relief_testbench::check::emitted;
use relief_testbench::cosim::{Link, Stalls, Stream, Verilator, tools};
use relief_testbench::displacement_pipeline::{DisplacementPipelineBinding, command_beat};
use relief_testbench::frame::{LINKS, commands_of, prepare};
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use std::fs;
use std::path::Path;
use std::process::Command;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Exit code, stdout and stderr of `relief run`.
fn run(scene: &Path, out: &Path, options: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
    let output = command.arg("run").arg(scene).arg("--out").arg(out).args(options).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// A scene of the folder, with changes.
fn scene(folder: &Path, name: &str, changes: &[(&str, &str)]) -> std::path::PathBuf {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut text = fs::read_to_string(scenes.join(name)).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "{name}: no `{from}`");
        text = text.replace(from, to);
    }
    let path = folder.join(name);
    fs::write(&path, text.replace("maps/", &format!("{}/maps/", scenes.display()))).unwrap();
    path
}

#[test]
fn displacement_pipeline_is_offered_where_there_are_nine_components() {
    let names: Vec<&str> = offered_sets(&DisplacementPipelineBinding).iter().map(|set| set.name).collect();
    assert_eq!(names, ["default", "large", "small"]);
    let refused = "displacement_pipeline is not offered at terrain; the width sets default, large and small have it";
    assert_eq!(expect_offered(&DisplacementPipelineBinding, &terrain::SET), Err(refused.to_owned()));
}

#[test]
fn displacement_pipeline_run_refuses_what_the_design_does_not_do() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let path = scene(folder.path(), "sphere.toml", &[("cell_px = 2.0", "cell_px = 27.0")]);
    let (code, _, stderr) = run(&path, &out, &["--engine", "design", "--param", "terrain"]);
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("is not offered at terrain; the width sets default, large and small have it"), "{stderr}");
    let lit = fs::read_to_string(&path)?
        + "\n[[light]]\ndirection = [0, 0, 1]\n\n[[light]]\ndirection = [1, 0, 0]\n\n[[light]]\ndirection = [0, 1, 0]\n";
    fs::write(&path, lit)?;
    let (code, _, stderr) = run(&path, &out, &["--engine", "design"]);
    assert_eq!(code, Some(2), "{stderr}");
    assert!(
        stderr.contains(" lights, and the design of --engine design has one; --engine rust takes several"),
        "{stderr}"
    );
    assert!(!out.exists());
    Ok(())
}

#[test]
fn displacement_pipeline_matches_golden_under_idle_cycles_and_backpressure() {
    let block = &DisplacementPipelineBinding;
    let beats = 1000;
    let counts = common::matches_golden_everywhere(block, beats);
    assert!(counts.iter().all(|counts| counts.checked > 100), "{}", block.name());
}

/// The width set that has room for every scene, so that the design is compiled once for all.
const EVERY_SCENE: &str = "large";

/// A design is compiled once for both tests that hold it up.
const STALLS: Stalls = Stalls { percent: 35, seed: 1 };

/// Random draws through the emitted design, every stream between its blocks held up at random.
#[test]
fn displacement_pipeline_sends_the_same_when_its_streams_are_held_up() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "the design held up")? {
        return Ok(());
    }
    let (block, set) = (&DisplacementPipelineBinding, &small::SET);
    let mut emitted = emitted(block, set, None)?;
    emitted.design.stall(&LINKS, STALLS)?;
    let unknown = Link { module: "relief_assembly", instance: "clip", ports: ["out_valid", "out_wait"] };
    let refused = emitted.design.stall(&[unknown], STALLS).map_err(|error| error.to_string());
    assert!(refused.is_err_and(|error| error.contains("has no place in the text of its module")));
    let stream = Stream::build(&emitted.design, &Verilator::new())?;
    let beats: Vec<_> = block.random(set, 9).take(60_000).collect();
    let (mut model, mut expected) = (block.model(set), Vec::new());
    beats.iter().for_each(|beat| model.accept(beat, &mut expected));
    let rows = stream.rows(beats.iter().map(Vec::as_slice));
    for seed in [1, 2] {
        let streamed = stream.run(&rows, 4096, Stalls { seed, ..STALLS })?;
        assert!(expected.len() > 5_000 && streamed.beats.len() == expected.len(), "{}", expected.len());
        for (k, ((_, words), Expected { words: wanted, mask })) in streamed.iter().zip(&expected).enumerate() {
            assert!(words.iter().zip(wanted).zip(mask).all(|((got, want), mask)| (got ^ want) & mask == 0), "{k}");
        }
    }
    // The gates close: with both ends open the emitted design takes longer than the one in Rust, which has none.
    let first = 3_000;
    let rows = stream.rows(beats[..first].iter().map(Vec::as_slice));
    let gated = stream.run(&rows, 4096, Stalls::default())?.cycles;
    let mut board = Scoreboard::new(block, set, Box::new(beats.into_iter().take(first)), Pattern::NONE);
    let free = board.run(Until::Exhausted, &mut |_, _, _| Ok(())).map_err(|mismatch| mismatch.to_string())?.cycles;
    println!("{gated} cycles behind gates, {free} without");
    assert!(gated > free + 100, "{gated} cycles behind gates, {free} without");
    Ok(())
}

#[test]
fn displacement_pipeline_run_draws_the_picture_of_the_blocks() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "a scene through the design")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let percent = STALLS.percent.to_string();
    for (name, changes, options) in [
        (
            "jacksboro.toml",
            &[("cell_px = 2.0", "cell_px = 8.0"), ("[640, 480]", "[160, 120]")],
            &["--param", EVERY_SCENE][..],
        ),
        // Two pyramids, and every stream held up.
        (
            "sphere.toml",
            &[("cell_px = 2.0", "cell_px = 9.0\nextremum = \"vertex\""), ("[256, 129]", "[96, 60]")],
            &["--param", "small", "--stalls", percent.as_str()],
        ),
    ] {
        let path = scene(folder.path(), name, changes);
        let stalls = options.contains(&"--stalls");
        let [blocks, design] = ["rust", "design"].map(|engine| {
            let out = folder.path().join(engine);
            let (code, stdout, stderr) = run(&path, &out, &[&["--engine", engine], options].concat());
            assert_eq!((code, stderr.as_str()), (Some(0), ""), "{name} {engine}: {stdout}");
            assert_eq!(stdout.contains("% of the cycles of each stream"), stalls, "{name} {engine}");
            out
        });
        if stalls {
            // What leaves does not know of it.
            let free = folder.path().join("free");
            let (code, ..) = run(&path, &free, &options[..2]);
            assert_eq!((code, fs::read(free.join("frame.png"))?), (Some(0), fs::read(blocks.join("frame.png"))?));
            assert_eq!(fs::read(free.join("mesh.obj"))?, fs::read(blocks.join("mesh.obj"))?);
        }
        assert_eq!(fs::read(blocks.join("frame.png"))?, fs::read(design.join("frame.png"))?, "{name}");
        let report = |out: &Path| -> Result<serde_json::Value, Box<dyn std::error::Error>> {
            Ok(serde_json::from_str(&fs::read_to_string(out.join("report.json"))?)?)
        };
        let (blocks, design) = (report(&blocks)?, report(&design)?);
        assert_eq!((&design["engine"], &design["mismatches"]), (&"design".into(), &0.into()));
        let object = &design["objects"][0];
        assert_eq!(object["base_triangles"], blocks["base_triangles"], "{name}");
        for what in ["culled", "cut", "dropped", "pieces"] {
            let of_blocks = if what == "pieces" { &blocks["assembled"]["pieces"] } else { &blocks["assembled"][what] };
            assert_eq!(&object[what], of_blocks, "{name}: {what}");
        }
        assert_eq!(object["strip_triangles"], blocks["pipeline"]["triangles"], "{name}");
        let count = |what: &str| object[what].as_u64().unwrap_or(0);
        assert_eq!(blocks["pipeline"]["vertices"], count("vertices") + count("skipped"), "{name}");
        assert_eq!((&design["pixels"], &object["sent"]), (&blocks["pixels"], &design["triangles"]), "{name}");
        assert!(object["times"]["busy"].as_u64().is_some_and(|busy| busy > 300), "{design}");
    }
    Ok(())
}

/// Small pictures, whole, through the design in Rust: one with all that a terrain needs, one with a closed body and minima.
#[test]
fn displacement_pipeline_draws_small_pictures_in_rust() -> Outcome {
    let folder = tempfile::tempdir()?;
    let viewport = ("[640, 480]", "[96, 72]");
    for (name, set, changes) in [
        ("jacksboro_close.toml", &large::SET, vec![("cell_px = 2.0", "cell_px = 4.0"), viewport]),
        (
            "sphere.toml",
            &small::SET,
            vec![("cell_px = 2.0", "cell_px = 5.0\nextremum = \"vertex\""), ("[256, 129]", "[96, 60]"), viewport],
        ),
    ] {
        let block = &DisplacementPipelineBinding;
        let scene = relief_models::scene::read(&scene(folder.path(), name, &changes))?;
        let prepared = prepare(&scene, set)?;
        let beats: Vec<_> = commands_of(&prepared)?.iter().map(command_beat).collect();
        let mut board = Scoreboard::new(block, set, Box::new(beats.into_iter()), Pattern::NONE);
        let counts = board.run(Until::Exhausted, &mut |_, _, _| Ok(())).map_err(|mismatch| mismatch.to_string())?;
        println!("{name}: {} beats in {} cycles", counts.checked, counts.cycles);
        assert!(counts.checked > 500, "{name}: {} beats", counts.checked);
    }
    Ok(())
}

/// Every scene of the folder, whole, beat for beat as the golden machine sends it.
#[test]
fn displacement_pipeline_draws_every_scene() -> Outcome {
    if !tools::require_all(&["verilator", "g++"], "every scene through the design")? {
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut drawn = 0;
    for entry in fs::read_dir(scenes)? {
        let path = entry?.path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let (code, stdout, stderr) = run(&path, folder.path(), &["--engine", "design", "--param", EVERY_SCENE]);
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{}: {stdout}", path.display());
        let report: serde_json::Value = serde_json::from_str(&fs::read_to_string(folder.path().join("report.json"))?)?;
        assert_eq!((&report["engine"], &report["mismatches"]), (&"design".into(), &0.into()), "{}", path.display());
        assert!(report["triangles"].as_u64().is_some_and(|triangles| triangles > 1_000), "{}", path.display());
        if path.ends_with("terrain_25km.toml") {
            // What is left out takes less than a cycle: about 860,000 triangles, a quarter of them off the screen.
            let object = &report["objects"][0];
            let number = |value: &serde_json::Value| value.as_u64().unwrap() as f64;
            assert!(number(&object["times"]["busy"]) < 0.9 * number(&object["strip_triangles"]), "{object}");
            // Those of pieces that are swept across the screen are not displaced.
            assert!(number(&object["skipped"]) > 20_000.0, "{object}");
            assert!(report["simulation_seconds"].as_f64().is_some_and(|seconds| seconds < 60.0), "{report}");
        }
        drawn += 1;
    }
    assert!(drawn >= 8, "{drawn} scenes");
    Ok(())
}
