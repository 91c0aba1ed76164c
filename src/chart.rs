// SPDX-License-Identifier: MIT OR Apache-2.0
//! What `relief chart` gathers, draws and writes: every method, and peers, over their goals on each map.
//!
//! | file | what |
//! |---|---|
//! | `inputs` | maps and scenes become [`Subject`]s |
//! | `collect`, `peers` | the [`Point`]s of a subject |
//! | `front`, `repetition`, `advice` | what follows from them |
//! | `figure`, `axis`, `draw`, `picture` | the drawings |
//! | `silhouettes` | horizons under filters |
//! | `csv`, `page` | the texts |

use relief_models::map::HeightMap;
use relief_models::measure::Heights;
use relief_testbench::method::{Hardware, Verdict};

pub mod advice;
mod axis;
pub mod collect;
pub mod csv;
pub mod draw;
mod figure;
mod front;
pub mod inputs;
pub mod page;
pub mod peers;
pub mod picture;
mod repetition;
pub mod silhouettes;

pub use figure::Figure;
use silhouettes::Silhouettes;

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

/// A subject with all that was measured.
#[derive(Debug)]
pub struct Chapter {
    /// The map.
    pub subject: Subject,
    /// The meshes, method by method.
    pub points: Vec<Point>,
    /// The horizon under every filter, at the steps of the grid that the map has room for.
    pub silhouettes: Vec<Silhouettes>,
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
