// SPDX-License-Identifier: MIT OR Apache-2.0
//! Peers: other programs that mesh height maps, from an environment of Python in the project's folder of tools.
//!
//! `peers.py` runs one of them. Whatever it does instead (it is not there, crashes, hangs, writes no mesh) is a sentence.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use relief_models::measure::{MeasureError, heights};
use relief_models::mesh::{Progress, TriangleMesh};
use relief_models::vertex_cache::{ENTRIES, misses};
use relief_testbench::method::{Goal, verdict};
use serde::{Deserialize, Serialize};

use super::{Chapter, Figure, Kind, Point, Subject, collect};

/// Where the environment is, from the folder of the project.
pub const FOLDER: &str = ".tools/peers";
/// The program that runs a peer.
const SCRIPT: &str = include_str!("peers.py");
/// Map units that a claim in single precision may be off: 2^-7 at heights of 16 bits.
pub const ROUNDING: f64 = 0.008;
/// A peer that is silent for so long hangs.
const PATIENCE: Duration = Duration::from_secs(300);
/// Bytes of a line of JSON.
const LINE: u64 = 1 << 16;

/// A peer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Peer {
    /// Greedy insertion into a Delaunay triangulation (Garland and Heckbert 1995).
    Delatin,
    /// Right-triangulated irregular networks (Evans, Kirkpatrick and Townsend 2001).
    Martini,
    /// Edge collapses under quadric errors (Garland and Heckbert 1997).
    Meshoptimizer,
}

/// Names of all peers, in the order of the chart.
pub const NAMES: [&str; 3] = [Peer::Delatin.name(), Peer::Martini.name(), Peer::Meshoptimizer.name()];

/// One line about a peer.
pub fn summary(name: &str) -> &'static str {
    Peer::ALL.into_iter().find(|peer| peer.name() == name).map_or("", Peer::summary)
}

impl Peer {
    const ALL: [Peer; 3] = [Peer::Delatin, Peer::Martini, Peer::Meshoptimizer];

    const fn name(self) -> &'static str {
        match self {
            Peer::Delatin => "pydelatin",
            Peer::Martini => "pymartini",
            Peer::Meshoptimizer => "meshoptimizer",
        }
    }

    const fn summary(self) -> &'static str {
        match self {
            Peer::Delatin => "greedy insertion into a Delaunay triangulation, under a bound",
            Peer::Martini => "right triangles, halved where an error is above a bound",
            Peer::Meshoptimizer => "collapses edges of the whole grid under quadric errors, down to a count",
        }
    }

    /// Why it cannot serve a map.
    fn refusal(self, subject: &Subject) -> Option<String> {
        let [width, height] = [subject.map.width, subject.map.height];
        let fits = width == height && width >= 3 && (width - 1).is_power_of_two();
        (self == Peer::Martini && !fits).then(|| {
            format!(
                "it needs squares of 2^n + 1 samples, and the map has {width} x {height}; a part would be another map"
            )
        })
    }
}

/// The environment, and what is installed in it.
#[derive(Debug)]
pub struct Peers {
    python: PathBuf,
    versions: BTreeMap<String, Option<String>>,
}

impl Peers {
    /// Looks what is there.
    ///
    /// # Errors
    /// A sentence: there is no environment, or it does not answer.
    pub fn find() -> Result<Peers, String> {
        let python = Path::new(FOLDER).join("bin/python");
        if !python.exists() {
            return Err(format!("{} is not there; docs/chart.md tells how to install the peers", python.display()));
        }
        let mut output = call(&python, b"{}\n", 1 << 20)?;
        let mut text = String::new();
        let known = output.by_ref().take(LINE).read_to_string(&mut text).ok();
        let versions = known.and_then(|_| serde_json::from_str(text.trim()).ok());
        let versions = versions.ok_or_else(|| format!("{} does not tell which peers it has", python.display()))?;
        Ok(Peers { python, versions })
    }

    /// Those that are not installed.
    pub fn missing(&self) -> Vec<&'static str> {
        NAMES.into_iter().filter(|name| self.version(name).is_none()).collect()
    }

    /// The version of a peer that is installed.
    pub fn version(&self, name: &str) -> Option<&str> {
        self.versions.get(name).and_then(Option::as_deref)
    }

    /// Adds the points of all peers to a chapter that has ours.
    pub fn join(&self, chapter: &mut Chapter, count: usize, progress: &dyn Progress) {
        for peer in Peer::ALL {
            progress.phase(peer.name(), 0);
            if let Err(sentence) = self.run(peer, chapter, count, progress) {
                chapter.notes.push(format!("{}: {sentence}", peer.name()));
            }
        }
    }

    fn run(&self, peer: Peer, chapter: &mut Chapter, count: usize, progress: &dyn Progress) -> Result<(), String> {
        let samples = chapter.subject.map.samples.len();
        let version = self.version(peer.name()).ok_or("it is not installed")?.to_owned();
        let goals = goals(peer, chapter, count);
        let subject = &chapter.subject;
        if let Some(refusal) = peer.refusal(subject) {
            return Err(refusal);
        }
        let asked = Asked {
            peer: peer.name(),
            width: subject.map.width,
            height: subject.map.height,
            goals: goals.iter().map(|&(number, _)| number).collect(),
        };
        let mut input = serde_json::to_vec(&asked).map_err(|error| error.to_string())?;
        input.push(b'\n');
        input.extend(subject.map.samples.iter().flat_map(|sample| sample.to_le_bytes()));
        // A mesh has two triangles a sample and a vertex: 24 + 24 bytes. Twice that is no mesh of the map.
        let most = 96 * samples as u64 + LINE;
        let mut output = call(&self.python, &input, most.saturating_mul(goals.len() as u64))?;
        for (_, goal) in goals {
            let text = collect::describe(goal);
            // Behind an answer that cannot be read nothing else can.
            match answer(&mut output, samples)? {
                Ok((head, mesh)) => match point(peer, &chapter.subject, goal, &version, head, &mesh, progress) {
                    Ok(point) => chapter.points.push(point),
                    Err(error) => chapter.notes.push(format!("{} at {text}: {error}", peer.name())),
                },
                Err(error) => chapter.notes.push(format!("{} at {text}: {error}", peer.name())),
            }
        }
        Ok(())
    }
}

/// What a peer is asked for, as a number and as a goal.
fn goals(peer: Peer, chapter: &Chapter, count: usize) -> Vec<(f64, Goal)> {
    if peer != Peer::Meshoptimizer {
        let bounds = collect::bounds(&chapter.subject, count).into_iter();
        return bounds.map(|bound| (f64::from(bound.over()) / f64::from(bound.under()), Goal::Bound(bound))).collect();
    }
    // It has no bound on the height: as many triangles as Delaunay took, or else our own first method.
    let of = |name: &str| chapter.points.iter().filter(|point| point.method == name).collect::<Vec<_>>();
    let delatin = of(Peer::Delatin.name());
    let first = chapter.points.first().map_or("", |point| &point.method);
    let models = if delatin.is_empty() { of(first) } else { delatin };
    let mut counts: Vec<u64> = models.iter().map(|point| point.heights.triangles as u64).collect();
    counts.sort_unstable();
    counts.dedup();
    counts.into_iter().map(|count| (count as f64, Goal::Triangles(count))).collect()
}

#[derive(Serialize)]
struct Asked {
    peer: &'static str,
    width: usize,
    height: usize,
    goals: Vec<f64>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Answer {
    Mesh(Head),
    Failed { error: String },
}

#[derive(Deserialize)]
struct Head {
    preparation: f64,
    seconds: f64,
    vertices: usize,
    triangles: usize,
}

/// Reads the answer to one goal: a mesh, or what the peer says went wrong.
///
/// # Errors
/// A sentence: this is no answer.
fn answer(source: &mut impl BufRead, samples: usize) -> Result<Result<(Head, TriangleMesh), String>, String> {
    let wrong = || "it wrote something that is no mesh of the map".to_owned();
    let mut line = Vec::new();
    source.take(LINE).read_until(b'\n', &mut line).map_err(|_| wrong())?;
    if line.is_empty() {
        return Err("it ended before its last mesh".into());
    }
    let head = match serde_json::from_slice(&line).map_err(|_| wrong())? {
        Answer::Mesh(head) => head,
        Answer::Failed { error } => return Ok(Err(error)),
    };
    let is_time = |seconds: f64| seconds.is_finite() && seconds >= 0.0;
    let fits = head.vertices <= 2 * samples && head.triangles <= 4 * samples;
    if !fits || !is_time(head.preparation) || !is_time(head.seconds) {
        return Err(wrong());
    }
    let mut bytes = vec![0; 24 * head.vertices];
    source.read_exact(&mut bytes).map_err(|_| wrong())?;
    let number = |bytes: &[u8; 8]| f64::from_le_bytes(*bytes);
    let numbers: Vec<f64> = bytes.as_chunks().0.iter().map(number).collect();
    let mut bytes = vec![0; 12 * head.triangles];
    source.read_exact(&mut bytes).map_err(|_| wrong())?;
    let corners: Vec<u32> = bytes.as_chunks().0.iter().map(|bytes: &[u8; 4]| u32::from_le_bytes(*bytes)).collect();
    let mesh = TriangleMesh { positions: numbers.as_chunks().0.to_vec(), triangles: corners.as_chunks().0.to_vec() };
    Ok(Ok((head, mesh)))
}

fn point(
    peer: Peer,
    subject: &Subject,
    goal: Goal,
    version: &str,
    head: Head,
    mesh: &TriangleMesh,
    progress: &dyn Progress,
) -> Result<Point, MeasureError> {
    let heights = heights(mesh, &subject.map, progress)?;
    let claim = match goal {
        Goal::Bound(bound) => Some(f64::from(bound.over()) / f64::from(bound.under())),
        Goal::Triangles(_) => None,
    };
    Ok(Point {
        method: peer.name().into(),
        kind: Kind::Peer,
        version: version.into(),
        goal: collect::describe(goal),
        verdict: verdict(&heights, claim.map(|claim| claim + ROUNDING)),
        heights,
        claim,
        hardware: None,
        preparation_seconds: head.preparation,
        golden_seconds: head.seconds,
        cache_misses: misses(&mesh.triangles, ENTRIES),
        fronts: [false; Figure::ALL.len()],
    })
}

/// Runs the script with `input`, and gives what it writes, `most` bytes at the most. Files instead of pipes: nobody has to
/// read while somebody writes, and a child of the child cannot keep us waiting.
///
/// # Errors
/// A sentence: it cannot be run, hangs, or fails.
fn call(python: &Path, input: &[u8], most: u64) -> Result<BufReader<File>, String> {
    let fail = |error: std::io::Error| format!("{} cannot be run: {error}", python.display());
    let file = || tempfile::tempfile().map_err(fail);
    let (mut source, mut sink, mut complaints) = (file()?, file()?, file()?);
    source.write_all(input).and_then(|()| source.rewind()).map_err(fail)?;
    let mut command = Command::new(python);
    // -I: nothing of the user's settings, nor of the folder, gets in.
    command.args(["-I", "-c", SCRIPT]).stdin(source);
    command.stdout(sink.try_clone().map_err(fail)?).stderr(complaints.try_clone().map_err(fail)?);
    let mut child = command.spawn().map_err(fail)?;
    let begun = Instant::now();
    let written = |file: &File| file.metadata().map_or(0, |data| data.len());
    let status = loop {
        if let Some(status) = child.try_wait().map_err(fail)? {
            break status;
        }
        let too_long = begun.elapsed() > PATIENCE;
        if too_long || written(&sink) > most || written(&complaints) > most {
            let _ = child.kill();
            let _ = child.wait();
            let seconds = PATIENCE.as_secs();
            let what =
                if too_long { format!("it had no end after {seconds} s") } else { "it wrote without end".into() };
            return Err(what);
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    if !status.success() {
        return Err(format!("it failed ({status}){}", last_line(&mut complaints)));
    }
    sink.rewind().map_err(fail)?;
    Ok(BufReader::new(sink))
}

/// The end of what a program complains of: Python tells the error last.
fn last_line(complaints: &mut File) -> String {
    let mut bytes = Vec::new();
    let length = complaints.metadata().map_or(0, |data| data.len());
    let _ = complaints.seek(SeekFrom::Start(length.saturating_sub(2000)));
    let _ = complaints.take(2000).read_to_end(&mut bytes);
    let text = String::from_utf8_lossy(&bytes);
    let last = text.lines().map(str::trim).rfind(|line| !line.is_empty());
    last.map_or_else(String::new, |line| format!(": {}", line.chars().take(200).collect::<String>()))
}
