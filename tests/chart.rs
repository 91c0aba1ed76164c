// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief chart` as a program: its table, its page and drawings, bad input, and peers that misbehave.

use std::collections::HashMap;
use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;

use relief_models::map::{HeightMap, Procedural};
use relief_testbench::method::METHODS;

type Outcome = Result<(), Box<dyn Error>>;

const FIGURES: [&str; 6] = ["max-triangles", "rms-triangles", "max-cycles", "max-reads", "max-memory", "max-seconds"];

/// Exit code, stdout and stderr of a chart in `folder`.
fn chart(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_relief"));
    let output = command.current_dir(folder).arg("chart").args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn write_map(path: &Path, map: &HeightMap) -> Outcome {
    let [width, height] = [map.width, map.height].map(|side| side as u32);
    let picture = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(width, height, map.samples.clone());
    Ok(picture.ok_or("no picture")?.save(path)?)
}

fn write_formula(path: &Path, kind: Procedural, width: usize, height: usize) -> Outcome {
    write_map(path, &HeightMap::procedural(kind, width, height))
}

/// The rows of a table, by the names of its columns.
fn rows(text: &str) -> Vec<HashMap<String, String>> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("# relief chart 1"));
    let header = fields(lines.next().unwrap());
    let row = |line: &str| {
        let fields = fields(line);
        assert_eq!(fields.len(), header.len(), "{line}");
        header.iter().cloned().zip(fields).collect()
    };
    lines.map(row).collect()
}

fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut quoted) = (vec![String::new()], false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        let field = fields.last_mut().unwrap();
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => field.extend(letters.next()),
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            _ => field.push(letter),
        }
    }
    assert!(!quoted, "{line}");
    fields
}

fn number(row: &HashMap<String, String>, column: &str) -> Option<f64> {
    let text = row.get(column).unwrap_or_else(|| panic!("no column {column}"));
    (!text.is_empty()).then(|| text.parse().unwrap_or_else(|_| panic!("{column}: {text}")))
}

#[test]
fn chart_writes_table_page_and_drawings() -> Outcome {
    let folder = tempfile::tempdir()?;
    write_formula(&folder.path().join("a <b> & \"c\", d.png"), Procedural::Peaks, 40, 33)?;
    write_formula(&folder.path().join("dents.png"), Procedural::Dents, 65, 65)?;
    fs::create_dir(folder.path().join("out"))?;
    fs::write(folder.path().join("out/gone-max-cycles.svg"), "old")?;
    fs::write(folder.path().join("out/mine.txt"), "kept")?;
    let inputs = ["a <b> & \"c\", d.png", "dents.png", "--out", "out", "--points", "4", "--peers", "none"];
    let (code, stdout, stderr) = chart(folder.path(), &inputs);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    let out = folder.path().join("out");
    let mut names: Vec<_> = fs::read_dir(&out)?.map(|at| at.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    let drawings = ["a-b-c-d", "dents"].into_iter().flat_map(|slug| FIGURES.map(|figure| format!("{slug}-{figure}")));
    let drawings: Vec<String> = drawings.collect();
    // As far as the maps have room for such a grid.
    let horizons = ["a-b-c-d-silhouette-5", "a-b-c-d-silhouette-10"].into_iter();
    let horizons = horizons.chain(["dents-silhouette-5", "dents-silhouette-10", "dents-silhouette-20"]);
    let mut expected: Vec<String> = ["filters.csv", "index.html", "mine.txt", "points.csv"].map(String::from).into();
    let all = drawings.iter().cloned().chain(horizons.map(String::from));
    expected.extend(all.flat_map(|name| [format!("{name}.png"), format!("{name}.svg")]));
    expected.sort();
    assert_eq!(names, expected);
    for name in &drawings {
        let picture = image::open(out.join(format!("{name}.png")))?.to_rgb8();
        assert_eq!(picture.dimensions(), (1440, 960));
        // White, and marks in at least two of the colours.
        let is = |colour: [u8; 3]| picture.pixels().filter(|pixel| pixel.0 == colour).count();
        assert!(is([255; 3]) > 700_000 && is([0, 114, 178]) > 500, "{name}");
        let svg = fs::read_to_string(out.join(format!("{name}.svg")))?;
        assert!(svg.contains("Pareto front") && svg.contains("bisector-interpolated"), "{name}");
        assert!(svg.trim_end().ends_with("</svg>") && !svg.contains("a <b>"), "{name}");
    }
    check_rows(&rows(&fs::read_to_string(out.join("points.csv"))?))?;
    let horizons = fs::read_to_string(out.join("filters.csv"))?;
    assert_eq!(horizons.lines().next(), Some("# relief filters 1"));
    assert_eq!(horizons.lines().count(), 2 + 5 * 8, "{horizons}");
    let page = fs::read_to_string(out.join("index.html"))?;
    for method in METHODS {
        assert!(page.contains(&format!("<td>{}</td>", method.name())), "{}", method.name());
    }
    for peer in ["pydelatin", "pymartini", "meshoptimizer"] {
        assert!(page.contains(&format!("{peer} was not asked to run")), "{peer}");
    }
    assert!(page.contains("a &lt;b&gt; &amp; &quot;c&quot;, d: terrain, or a single shape</h2>"));
    assert!(page.contains("dents: a repeating pattern</h2>") && page.contains("every 8 samples along x"));
    assert!(page.contains("<li>Take ") && !page.contains("NaN") && !page.contains("a <b>"));
    // Nothing that a page would have to ask the network for.
    let links: Vec<&str> = page.split(['"', '\'']).filter(|text| text.starts_with("http")).collect();
    assert!(links.iter().all(|link| *link == "http://www.w3.org/2000/svg"), "{links:?}");
    Ok(())
}

fn check_rows(rows: &[HashMap<String, String>]) -> Outcome {
    for scene in ["a <b> & \"c\", d", "dents"] {
        let rows: Vec<_> = rows.iter().filter(|row| row["scene"] == scene).collect();
        for method in METHODS {
            let of: Vec<_> = rows.iter().filter(|row| row["method"] == method.name()).collect();
            assert!(of.len() >= 4, "{scene}: {}", method.name());
            for row in of {
                assert_eq!(number(row, "cycles").is_some(), method.has_hardware(), "{row:?}");
                assert_eq!(number(row, "reads").is_some_and(|reads| reads > 0.0), method.has_hardware(), "{row:?}");
                let each = number(row, "cycles").map(|cycles| cycles / number(row, "triangles").unwrap());
                assert_eq!(number(row, "cycles_per_triangle"), each);
                assert_eq!(number(row, "whole"), Some(1.0));
                let slack = number(row, "claim").map(|claim| claim - number(row, "max_error").unwrap());
                assert!(number(row, "slack") == slack && slack.is_none_or(|slack| slack >= 0.0), "{row:?}");
                assert_eq!(row["verdict"], if slack.is_some() { "holds" } else { "no claim" });
                assert!(number(row, "rms_error") <= number(row, "max_error"), "{row:?}");
                let share = 100.0 * number(row, "max_error").unwrap() / number(row, "range").unwrap();
                assert!((number(row, "max_percent").unwrap() - share).abs() < 1e-9, "{row:?}");
            }
        }
        let seconds = |row: &HashMap<String, String>| Some(number(row, "preparation_s")? + number(row, "golden_s")?);
        let column = |name: &'static str| move |row: &HashMap<String, String>| number(row, name);
        type Cost<'a> = Box<dyn Fn(&HashMap<String, String>) -> Option<f64> + 'a>;
        let fronts: [(&str, &str, Cost<'_>); 6] = [
            ("pareto_max_triangles", "max_error", Box::new(column("triangles"))),
            ("pareto_rms_triangles", "rms_error", Box::new(column("triangles"))),
            ("pareto_max_cycles", "max_error", Box::new(column("cycles"))),
            ("pareto_max_reads", "max_error", Box::new(column("reads"))),
            ("pareto_max_memory", "max_error", Box::new(column("memory_bits"))),
            ("pareto_max_seconds", "max_error", Box::new(seconds)),
        ];
        for (flag, error, cost) in fronts {
            let mut marked = 0;
            for row in &rows {
                let place = |row: &HashMap<String, String>| Some((cost(row)?, number(row, error)?));
                let beaten = |(x, y): (f64, f64)| {
                    rows.iter().filter_map(|row| place(row)).any(|(u, v)| u <= x && v <= y && (u < x || v < y))
                };
                let expected = place(row).is_some_and(|place| !beaten(place));
                assert_eq!(row[flag], if expected { "1" } else { "0" }, "{flag}: {row:?}");
                marked += usize::from(expected);
            }
            assert!((1..rows.len()).contains(&marked), "{flag}: {marked}");
        }
    }
    Ok(())
}

/// Maps without a range, without a cell to spare, and with few bits; a scene, and the golden engine.
#[test]
fn chart_takes_any_map_and_scenes() -> Outcome {
    let folder = tempfile::tempdir()?;
    write_map(&folder.path().join("plane.png"), &HeightMap { width: 5, height: 4, samples: vec![9; 20] })?;
    write_map(&folder.path().join("least.png"), &HeightMap { width: 2, height: 2, samples: vec![0, 1, 0, 3] })?;
    image::GrayImage::from_fn(9, 2, |x, y| image::Luma([(x * 9 + y * 4) as u8])).save(folder.path().join("few.png"))?;
    let scene = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/dents.toml"))?;
    let object = &scene[scene.find("[[object]]").ok_or("no object")?..scene.find("[[light]]").ok_or("no light")?];
    let second = object.replace("[257, 257]", "[20, 17]").replace("0.1]", "0.0]");
    fs::write(folder.path().join("two.toml"), scene.replace("[257, 257]", "[33, 33]") + &second)?;
    let inputs = ["plane.png", "least.png", "few.png", "two.toml", "plane.png", "--out", "new/out", "--points", "2"];
    for engine in ["golden", "rust"] {
        let all: Vec<&str> = inputs.iter().copied().chain(["--engine", engine]).collect();
        let (code, stdout, stderr) = chart(folder.path(), &all);
        assert_eq!(code, Some(0), "{stdout}{stderr}");
        assert!(stderr.starts_with("warning: few.png: has 8 bits") && stderr.lines().count() == 1, "{stderr}");
        let rows = rows(&fs::read_to_string(folder.path().join("new/out/points.csv"))?);
        for (scene, world) in
            [("plane", None), ("least", None), ("few", None), ("two, object 1", Some(0.1)), ("two, object 2", None)]
        {
            let of: Vec<_> = rows.iter().filter(|row| row["scene"] == scene).collect();
            assert!(METHODS.iter().all(|method| of.iter().any(|row| row["method"] == method.name())), "{scene}");
            for row in of {
                let scaled = world.map(|world| number(row, "max_error").unwrap() * world / 65535.0);
                let found = number(row, "max_world");
                assert_eq!(found.is_some(), scaled.is_some(), "{row:?}");
                assert!(found.zip(scaled).is_none_or(|(a, b)| (a - b).abs() < 1e-12), "{row:?}");
            }
        }
        assert_eq!(rows.iter().any(|row| !row["cycles"].is_empty()), engine == "rust");
        assert!(folder.path().join("new/out/plane-2-max-cycles.svg").is_file());
    }
    let page = fs::read_to_string(folder.path().join("new/out/index.html"))?;
    assert!(page.contains("plane: a plane</h2>") && page.contains(".tools/peers/bin/python is not there"));
    Ok(())
}

#[test]
fn chart_refuses_bad_input_and_leaves_nothing() -> Outcome {
    let folder = tempfile::tempdir()?;
    write_formula(&folder.path().join("map.png"), Procedural::Ramp, 9, 9)?;
    write_formula(&folder.path().join("thin.png"), Procedural::Ramp, 9, 1)?;
    fs::write(folder.path().join("text.png"), "no picture")?;
    fs::write(folder.path().join("text.toml"), "no scene")?;
    fs::write(folder.path().join("text.txt"), "nothing")?;
    fs::write(folder.path().join("file"), "kept")?;
    let before = fs::read_dir(folder.path())?.count();
    for (arguments, sentence) in [
        (&["none.png", "--out", "out"][..], "none.png: cannot be opened"),
        (&["map.png", "text.png", "--out", "out"], "text.png: is no PNG"),
        (&["text.toml", "--out", "out"], "text.toml"),
        (&["text.txt", "--out", "out"], "a map (.png, grey) or a scene (.toml) is expected"),
        (&["thin.png", "--out", "out"], "thin.png: is a map of 9 x 1 samples and has to have 2 x 2"),
        (&["map.png", "--out", "file"], "file: is a file; a folder is expected"),
        (&["map.png", "--out", "file/out"], "file"),
        (&["map.png", "--out", "out", "--points", "0"], "a number of goals from 1 to 16 is expected"),
        (&["map.png", "--out", "out", "--points", "x"], "a number of goals from 1 to 16 is expected"),
        (&["map.png", "--out", "out", "--peers", "require"], "docs/chart.md tells how to install the peers"),
        (&["map.png"], "--out"),
        (&["--out", "out"], "MAP|SCENE"),
    ] {
        let (code, stdout, stderr) = chart(folder.path(), arguments);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{arguments:?}: {stderr}");
        assert!(stderr.contains(sentence) && !stderr.contains("panicked"), "{arguments:?}: {stderr}");
        assert_eq!(fs::read_dir(folder.path())?.count(), before, "{arguments:?}");
    }
    assert_eq!(fs::read_to_string(folder.path().join("file"))?, "kept");
    Ok(())
}

/// An environment whose Python is a shell script: what it answers is a note, whatever it is, and never a crash.
#[cfg(unix)]
#[test]
fn chart_survives_peers_that_misbehave() -> Outcome {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir()?;
    write_formula(&folder.path().join("map.png"), Procedural::Peaks, 17, 17)?;
    let python = folder.path().join(".tools/peers/bin/python");
    fs::create_dir_all(python.parent().ok_or("no folder")?)?;
    let versions = r#"printf '{"pydelatin":"1.2 <3>","pymartini":"7","meshoptimizer":null}\n'; exit"#;
    let ask = format!("read line; case \"$line\" in '{{}}') {versions};; esac; cat > /dev/null");
    let head = r#"{"preparation":0,"seconds":0.5,"#;
    let no_mesh = "it wrote something that is no mesh of the map";
    for (answer, sentence) in [
        ("echo garbage".to_owned(), no_mesh),
        ("head -c 3000 /dev/zero".to_owned(), no_mesh),
        (format!("echo '{head}\"vertices\":3,\"triangles\":1}}'; echo short"), no_mesh),
        (format!("echo '{head}\"vertices\":99999999999,\"triangles\":1}}'"), no_mesh),
        (format!("echo '{head}\"vertices\":0,\"triangles\":0}}'"), "has no triangle"),
        ("echo '{\"preparation\":-1,\"seconds\":1,\"vertices\":0,\"triangles\":0}'".to_owned(), no_mesh),
        ("echo '{\"error\":\"<no> luck\"}'".to_owned(), "&lt;no&gt; luck"),
        ("true".to_owned(), "it ended before its last mesh"),
        ("echo Oops >&2; exit 3".to_owned(), "it failed (exit status: 3): Oops"),
        ("kill -9 $$".to_owned(), "it failed (signal: 9"),
        ("cat /dev/zero".to_owned(), no_mesh),
    ] {
        fs::write(&python, format!("#!/bin/sh\n{ask}\n{answer}\n"))?;
        fs::set_permissions(&python, fs::Permissions::from_mode(0o755))?;
        let (code, stdout, stderr) =
            chart(folder.path(), &["map.png", "--out", "out", "--points", "1", "--engine", "golden"]);
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{answer}: {stdout}");
        let page = fs::read_to_string(folder.path().join("out/index.html"))?;
        assert!(page.contains(sentence), "{answer}: {stdout}");
        assert!(page.contains("meshoptimizer: it is not installed"), "{answer}");
        assert!(
            rows(&fs::read_to_string(folder.path().join("out/points.csv"))?).iter().all(|row| row["kind"] == "ours")
        );
    }
    let (code, _, stderr) = chart(folder.path(), &["map.png", "--out", "no", "--peers", "require"]);
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("meshoptimizer: not installed in .tools/peers"), "{stderr}");
    fs::write(&python, "#!/bin/sh\necho garbage\n")?;
    for (wanted, expected) in [("auto", 0), ("require", 2)] {
        let (code, _, stderr) = chart(folder.path(), &["map.png", "--out", "out", "--points", "1", "--peers", wanted]);
        assert_eq!(code, Some(expected), "{stderr}");
        let page = fs::read_to_string(folder.path().join("out/index.html"))?;
        assert!(
            page.contains("does not tell which peers it has") && (stderr.is_empty() == (expected == 0)),
            "{stderr}"
        );
    }
    // Two triangles over the whole map, as numbers of a peer: measured like ours, and its claim with them.
    let corner = |x: f64, y: f64| [x, y, 0.0].into_iter().flat_map(f64::to_le_bytes).collect::<Vec<_>>();
    let mut mesh = [corner(0.0, 0.0), corner(16.0, 0.0), corner(16.0, 16.0), corner(0.0, 16.0)].concat();
    mesh.extend([0u32, 1, 2, 0, 2, 3].into_iter().flat_map(u32::to_le_bytes));
    fs::write(folder.path().join("mesh"), mesh)?;
    let one = format!("echo '{head}\"vertices\":4,\"triangles\":2}}'; cat mesh");
    fs::write(&python, format!("#!/bin/sh\n{ask}\n{one}; {one}; {one}\n"))?;
    let (code, stdout, stderr) = chart(folder.path(), &["map.png", "--out", "out", "--points", "1"]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""), "{stdout}");
    write_formula(&folder.path().join("oblong.png"), Procedural::Peaks, 17, 12)?;
    let (code, notes, _) = chart(folder.path(), &["oblong.png", "--out", "other", "--points", "1"]);
    assert_eq!(code, Some(0), "{notes}");
    assert!(notes.contains("note: pymartini: it needs squares of 2^n + 1 samples, and the map has 17 x 12"), "{notes}");
    let rows = rows(&fs::read_to_string(folder.path().join("out/points.csv"))?);
    let peers: Vec<_> = rows.iter().filter(|row| row["kind"] == "peer").collect();
    assert_eq!(peers.len(), 6, "{stdout}");
    let most = HeightMap::procedural(Procedural::Peaks, 17, 17).samples.into_iter().max().ok_or("no map")?;
    for row in peers {
        assert_eq!((row["max_error"].clone(), row["golden_s"].as_str()), (most.to_string(), "0.5"));
        assert_eq!(row["verdict"], "BROKEN");
    }
    Ok(())
}
