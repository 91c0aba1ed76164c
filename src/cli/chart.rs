// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief chart`: every method over its goals, measured, drawn and explained.

use std::fmt::Write as _;
use std::io::{stderr, stdout};
use std::path::{Path, PathBuf};

use relief_testbench::method;
use relief_testbench::output::OutputFolder;

use super::{Meter, Outcome, Result, write_all};
use crate::chart::draw::Errors;
use crate::chart::peers::{self, Peers};
use crate::chart::picture::pictures;
use crate::chart::{Chapter, Figure, Kind, collect, csv, inputs, page, silhouettes};

/// Chart every method on maps: error against triangles, hardware cycles, reads, memory and time
///
/// Each method runs at its own goals and at 1 % and 2 % of the map's range; its mesh is measured at every sample. Writes
/// index.html (start there), points.csv, and each drawing as SVG and PNG. docs/chart.md tells how to read them, and how to
/// install the peers.
#[derive(clap::Args)]
pub struct Arguments {
    /// Maps (grey PNG, 2 x 2 to 4097 x 4097 samples) and scenes (TOML), whose objects' maps are taken
    #[arg(required = true, value_name = "MAP|SCENE")]
    inputs: Vec<PathBuf>,
    /// The folder
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Goals of each method, from coarse to fine
    #[arg(long, value_name = "N", default_value = "6", value_parser = points)]
    points: usize,
    /// What computes the meshes of our methods
    #[arg(long, value_enum, default_value_t = Engine::Rust)]
    engine: Engine,
    /// Whether other programs are measured as well
    #[arg(long, value_enum, default_value_t = Wanted::Auto)]
    peers: Wanted,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Engine {
    /// The golden models: no cycles, no reads
    Golden,
    /// The hardware, simulated in Rust and compared with golden
    Rust,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Wanted {
    /// Those that are installed
    Auto,
    /// None
    None,
    /// All; one that is not installed is an error
    Require,
}

fn points(text: &str) -> std::result::Result<usize, String> {
    let count = text.parse().ok().filter(|count| (1..=16).contains(count));
    count.ok_or_else(|| "a number of goals from 1 to 16 is expected".into())
}

/// Reads, measures, draws and writes.
pub fn run(arguments: &Arguments) -> Result {
    let (subjects, warnings) = inputs::read(&arguments.inputs)?;
    let (peers, absence) = find_peers(arguments.peers)?;
    let folder = OutputFolder::open(&arguments.out)?;
    for warning in &warnings {
        write_all(stderr(), &format!("warning: {warning}\n"))?;
    }
    let engine = match arguments.engine {
        Engine::Golden => method::Engine::Golden,
        Engine::Rust => method::Engine::Rust,
    };
    let meter = Meter::new();
    let mut chapters = Vec::new();
    for subject in subjects {
        let mut chapter = collect::collect(subject, arguments.points, engine, &meter);
        if let Some(peers) = &peers {
            peers.join(&mut chapter, arguments.points, &meter);
        }
        chapter.mark_fronts();
        chapters.push(chapter);
    }
    meter.finish();
    let texts = [
        ("points.csv", csv::table(&chapters)),
        ("filters.csv", silhouettes::csv(&chapters)),
        ("index.html", page::page(&chapters, &absence)?),
    ];
    let mut files: Vec<(String, Vec<u8>)> = texts.map(|(name, text)| (name.to_owned(), text.into_bytes())).into();
    for chapter in &chapters {
        for figure in Figure::ALL {
            let name = format!("{}-{}", chapter.subject.slug, figure.name());
            files.extend(pictures(&name, &Errors(chapter, figure))?);
        }
        for silhouettes in &chapter.silhouettes {
            files.extend(pictures(&format!("{}-{}", chapter.subject.slug, silhouettes.file()), silhouettes)?);
        }
    }
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes)
            .map_err(|error| format!("{}: cannot be written: {error}", arguments.out.display()))?;
    }
    folder.commit(is_ours)?;
    write_all(stdout(), &table(&chapters, &arguments.out)?)?;
    let failures: Vec<_> = chapters.iter().flat_map(|chapter| &chapter.failures).collect();
    for failure in &failures {
        write_all(stderr(), &format!("mismatch: {failure}\n"))?;
    }
    Ok(if failures.is_empty() { Outcome::Agreed } else { Outcome::Mismatch })
}

/// The peers, and what is missing.
fn find_peers(wanted: Wanted) -> std::result::Result<(Option<Peers>, Vec<String>), String> {
    if wanted == Wanted::None {
        let asked = "was not asked to run (`--peers none`)";
        return Ok((None, peers::NAMES.iter().map(|name| format!("{name} {asked}")).collect()));
    }
    let found = match Peers::find() {
        Ok(found) => found,
        Err(sentence) if wanted == Wanted::Require => return Err(sentence),
        Err(sentence) => {
            return Ok((None, peers::NAMES.iter().map(|name| format!("{name} did not run: {sentence}")).collect()));
        }
    };
    let missing = found.missing();
    if wanted == Wanted::Require && !missing.is_empty() {
        let missing = missing.join(", ");
        return Err(format!("{missing}: not installed in {}; docs/chart.md tells how", peers::FOLDER));
    }
    Ok((Some(found), Vec::new()))
}

/// Files that an earlier chart has written.
fn is_ours(name: &str) -> bool {
    let is_drawing =
        |figure: Figure| [".svg", ".png"].iter().any(|end| name.ends_with(&format!("-{}{end}", figure.name())));
    let is_text = ["points.csv", "filters.csv", "index.html"].contains(&name);
    is_text || Figure::ALL.into_iter().any(is_drawing) || silhouettes::is_drawing(name)
}

fn table(chapters: &[Chapter], out: &Path) -> std::result::Result<String, std::fmt::Error> {
    let mut text = String::new();
    for chapter in chapters {
        let subject = &chapter.subject;
        writeln!(text, "{} ({} x {})", subject.name, subject.map.width, subject.map.height)?;
        for point in &chapter.points {
            let of = |error: f64| format!("{:.3} %", subject.percent(error));
            let cycles =
                point.hardware.as_ref().map_or_else(String::new, |hardware| format!("{} cycles", hardware.cycles));
            let whose = if point.kind == Kind::Peer { "peer " } else { "" };
            let name = format!("{whose}{}", point.method);
            let errors = format!("max {:>10} rms {:>10}", of(point.heights.max), of(point.rms()));
            let line = format!(
                "  {name:22} {:18} {:>9} triangles {errors} {:9} {cycles}",
                point.goal,
                point.heights.triangles,
                point.standing()
            );
            writeln!(text, "{}", line.trim_end())?;
        }
        for note in &chapter.notes {
            writeln!(text, "  note: {note}")?;
        }
    }
    writeln!(text, "written to {}", out.display())?;
    Ok(text)
}
