// SPDX-License-Identifier: MIT OR Apache-2.0
//! Peers: other programs that mesh height maps, from an environment of Python in the project's folder of tools.
//!
//! `peers.py` runs one of them. Whatever it does instead (it is not there, crashes, hangs, writes no mesh) is a sentence.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use relief_models::measure::{MeasureError, heights};
use relief_models::mesh::{Progress, TriangleMesh};
use relief_models::vertex_cache::{ENTRIES, misses};
use relief_testbench::method::{Goal, verdict};

use super::{Chapter, Figure, Kind, Point, Subject, collect};

mod script;

use script::{Asked, Head, PATIENCE, Script, answer, line};

/// Where the environment is, from the folder of the project.
pub const FOLDER: &str = ".tools/peers";
/// Map units that a claim in single precision may be off: 2^-7 at heights of 16 bits.
pub const ROUNDING: f64 = 0.008;
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
        let answer = Script::start(&python, b"{}\n".to_vec(), PATIENCE, line)?.next();
        let silent = || format!("{} does not tell which peers it has", python.display());
        let answer = answer.map_err(|what| format!("{}: {what}", silent()))?;
        let versions = serde_json::from_slice(&answer).map_err(|_| silent())?;
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
        let mut script = Script::start(&self.python, input, PATIENCE, move |source| answer(source, samples))?;
        for (_, goal) in goals {
            let text = collect::describe(goal);
            // Behind an answer that cannot be read nothing else can.
            match script.next()? {
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
        return bounds.map(|bound| (bound.value(), Goal::Bound(bound))).collect();
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
        Goal::Bound(bound) => Some(bound.value()),
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
