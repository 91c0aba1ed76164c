// SPDX-License-Identifier: MIT OR Apache-2.0
//! What `relief chart` gathers, draws and writes: every method, and peers, over their goals on each map.
//!
//! | file | what |
//! |---|---|
//! | `inputs` | maps and scenes become [`Subject`]s |
//! | `collect`, `peers` | the [`Point`]s of a subject |
//! | `front`, `repetition`, `advice` | what follows from them |
//! | `axis`, `draw` | the drawings |
//! | `csv`, `page` | the texts |

use relief_models::map::HeightMap;
use relief_models::measure::Heights;
use relief_testbench::method::{Hardware, Verdict};

pub mod advice;
mod axis;
pub mod collect;
pub mod csv;
pub mod draw;
mod front;
pub mod inputs;
pub mod page;
pub mod peers;
mod repetition;

/// A map to be meshed, and what it is called.
#[derive(Clone, Debug)]
pub struct Subject {
    /// As people read it.
    pub name: String,
    /// As its files are called: letters, digits and dashes, and no other subject's.
    pub slug: String,
    /// The map.
    pub map: HeightMap,
    /// Bits of a sample.
    pub bits: u8,
    /// World units of a map unit, where a scene says so.
    pub world: Option<f64>,
}

impl Subject {
    /// The least and the greatest sample.
    pub fn bounds(&self) -> [u16; 2] {
        let samples = self.map.samples.iter();
        samples.fold([u16::MAX, 0], |[low, high], &sample| [low.min(sample), high.max(sample)])
    }

    /// Map units between them.
    pub fn range(&self) -> u16 {
        let [low, high] = self.bounds();
        high.saturating_sub(low)
    }

    /// An error as a share of the range, in percent. A map of one height has no range: one unit stands for it.
    pub fn percent(&self, error: f64) -> f64 {
        100.0 * error / f64::from(self.range().max(1))
    }
}

/// Whose method it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One of `relief_testbench::method::METHODS`.
    Ours,
    /// Another program.
    Peer,
}

/// One mesh: a method at a goal, measured.
#[derive(Clone, Debug)]
pub struct Point {
    /// Name of the method.
    pub method: String,
    /// Whose it is.
    pub kind: Kind,
    /// Version of what ran.
    pub version: String,
    /// What was asked for: `bound 16.8` or `triangles 4096`.
    pub goal: String,
    /// The mesh against the map.
    pub heights: Heights,
    /// The error that the method promises.
    pub claim: Option<f64>,
    /// Whether it holds.
    pub verdict: Verdict,
    /// What the hardware took.
    pub hardware: Option<Hardware>,
    /// Seconds from the map to what the memories hold.
    pub preparation_seconds: f64,
    /// Seconds from there to triangles, in software.
    pub golden_seconds: f64,
    /// Misses of a small vertex cache.
    pub cache_misses: u64,
    /// Whether it is on the front of each of [`Figure::ALL`].
    pub fronts: [bool; Figure::ALL.len()],
}

impl Point {
    /// The root of the mean squared error; infinite where no sample is covered.
    pub fn rms(&self) -> f64 {
        self.heights.rms.unwrap_or(f64::INFINITY)
    }

    /// Whether it holds, as the page tells it.
    pub fn standing(&self) -> &'static str {
        match self.verdict {
            Verdict::Broken if self.heights.uncovered > 0 => "BROKEN: gaps",
            Verdict::Broken if !self.heights.is_whole() => "BROKEN: folds",
            verdict => verdict.name(),
        }
    }

    /// Claim less error: negative where the claim is broken.
    pub fn slack(&self) -> Option<f64> {
        self.claim.map(|claim| claim - self.heights.max)
    }

    /// Whether the mesh is whole with no error above `bound`. Peers compute in floats, which is allowed for.
    pub fn keeps(&self, bound: f64) -> bool {
        let rounding = if self.kind == Kind::Ours { 1e-9 } else { peers::ROUNDING };
        self.heights.holds(bound + rounding)
    }
}

/// A drawing: an error over a cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// Greatest error, triangles.
    MaxTriangles,
    /// Root of the mean squared error, triangles.
    RmsTriangles,
    /// Greatest error, cycles.
    MaxCycles,
    /// Greatest error, words read.
    MaxReads,
    /// Greatest error, bits of memory.
    MaxMemory,
    /// Greatest error, seconds of software.
    MaxSeconds,
}

impl Figure {
    /// All of them.
    pub const ALL: [Figure; 6] = [
        Figure::MaxTriangles,
        Figure::RmsTriangles,
        Figure::MaxCycles,
        Figure::MaxReads,
        Figure::MaxMemory,
        Figure::MaxSeconds,
    ];

    /// As files and columns name it.
    pub const fn name(self) -> &'static str {
        match self {
            Figure::MaxTriangles => "max-triangles",
            Figure::RmsTriangles => "rms-triangles",
            Figure::MaxCycles => "max-cycles",
            Figure::MaxReads => "max-reads",
            Figure::MaxMemory => "max-memory",
            Figure::MaxSeconds => "max-seconds",
        }
    }

    /// As people read it.
    pub const fn title(self) -> &'static str {
        match self {
            Figure::MaxTriangles => "Greatest error over triangles",
            Figure::RmsTriangles => "RMS error over triangles",
            Figure::MaxCycles => "Greatest error over hardware cycles",
            Figure::MaxReads => "Greatest error over reads of the map memory",
            Figure::MaxMemory => "Greatest error over bits of the map memory",
            Figure::MaxSeconds => "Greatest error over seconds of software",
        }
    }

    /// Cost of a point; none where it has no such cost.
    pub fn cost(self, point: &Point) -> Option<f64> {
        let hardware = |what: fn(&Hardware) -> u64| point.hardware.as_ref().map(|hardware| what(hardware) as f64);
        match self {
            Figure::MaxTriangles | Figure::RmsTriangles => Some(point.heights.triangles as f64),
            Figure::MaxCycles => hardware(|hardware| hardware.cycles),
            Figure::MaxReads => hardware(|hardware| hardware.reads),
            Figure::MaxMemory => hardware(|hardware| hardware.memory_bits),
            Figure::MaxSeconds => Some(point.preparation_seconds + point.golden_seconds),
        }
    }

    /// Cost and error of a point, in map units; none where it has no such cost, or does not cover the map.
    pub fn place(self, point: &Point) -> Option<[f64; 2]> {
        let error = if self == Figure::RmsTriangles { point.rms() } else { point.heights.max };
        let covers = point.heights.uncovered == 0 && error.is_finite();
        self.cost(point).filter(|_| covers).map(|cost| [cost, error])
    }
}

/// A subject with all that was measured.
#[derive(Debug)]
pub struct Chapter {
    /// The map.
    pub subject: Subject,
    /// The meshes, method by method.
    pub points: Vec<Point>,
    /// Sentences: what did not run, and why.
    pub notes: Vec<String>,
    /// Whether a method of ours broke its claim, or its hardware differs.
    pub failures: Vec<String>,
}

impl Chapter {
    /// Finds the fronts, once all points are there.
    pub fn mark_fronts(&mut self) {
        for (at, figure) in Figure::ALL.into_iter().enumerate() {
            // A mesh with folds is no height field: it is drawn, but beats nobody.
            let place = |point: &Point| figure.place(point).filter(|_| point.heights.is_whole());
            let places: Vec<_> = self.points.iter().map(place).collect();
            for (point, is_best) in self.points.iter_mut().zip(front::front(&places)) {
                point.fronts[at] = is_best;
            }
        }
    }

    /// Names of the methods with points, in the order of the points.
    pub fn methods(&self) -> Vec<(&str, Kind)> {
        let mut names: Vec<(&str, Kind)> = Vec::new();
        for point in &self.points {
            if !names.iter().any(|(name, _)| *name == point.method) {
                names.push((&point.method, point.kind));
            }
        }
        names
    }
}
