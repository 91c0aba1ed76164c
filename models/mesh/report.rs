// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the checker found, for people and for machines.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

/// Failures of each kind that are described; the others are counted.
const DESCRIBED: usize = 3;

/// A way for a mesh to be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FailureKind {
    /// An edge used by one triangle only that is not on the rim of the base mesh (or any, if closedness is asked for).
    OpenEdges,
    /// An edge used by more than two triangles, of one base triangle if there are base triangles.
    NonmanifoldEdges,
    /// An edge that two triangles walk along in the same direction.
    MisorientedEdges,
    /// A vertex strictly inside an open edge, or on a shared base edge of one base triangle only.
    TVertices,
    /// A triangle whose normal points against that of its base triangle.
    FlippedTriangles,
    /// A triangle without area.
    DegenerateTriangles,
    /// A triangle with the same three vertices as another (of the same base triangle), in whatever winding.
    DuplicateTriangles,
    /// A corner of a triangle farther than the tolerance from the plane of its base triangle.
    OffPlaneCorners,
    /// A base triangle (with area) that has no triangle.
    UncoveredBases,
    /// A base triangle whose open edges are not one loop through its three corners in order.
    BrokenLoops,
    /// A rim vertex farther than the tolerance from its base edge, or not farther along it than the one before.
    OffEdgeVertices,
    /// A base triangle whose triangles' areas do not add up to its own.
    WrongAreas,
    /// A base triangle with V - E + F other than 1.
    WrongEulers,
    /// A base triangle whose vertices on a shared base edge are not those of its neighbour.
    SeamMismatches,
}

impl FailureKind {
    /// Every kind, in the order of reports.
    pub const ALL: [FailureKind; 14] = [
        FailureKind::OpenEdges,
        FailureKind::NonmanifoldEdges,
        FailureKind::MisorientedEdges,
        FailureKind::TVertices,
        FailureKind::FlippedTriangles,
        FailureKind::DegenerateTriangles,
        FailureKind::DuplicateTriangles,
        FailureKind::OffPlaneCorners,
        FailureKind::UncoveredBases,
        FailureKind::BrokenLoops,
        FailureKind::OffEdgeVertices,
        FailureKind::WrongAreas,
        FailureKind::WrongEulers,
        FailureKind::SeamMismatches,
    ];

    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            FailureKind::OpenEdges => "open_edges",
            FailureKind::NonmanifoldEdges => "nonmanifold_edges",
            FailureKind::MisorientedEdges => "misoriented_edges",
            FailureKind::TVertices => "t_vertices",
            FailureKind::FlippedTriangles => "flipped_triangles",
            FailureKind::DegenerateTriangles => "degenerate_triangles",
            FailureKind::DuplicateTriangles => "duplicate_triangles",
            FailureKind::OffPlaneCorners => "off_plane_corners",
            FailureKind::UncoveredBases => "uncovered_bases",
            FailureKind::BrokenLoops => "broken_loops",
            FailureKind::OffEdgeVertices => "off_edge_vertices",
            FailureKind::WrongAreas => "wrong_areas",
            FailureKind::WrongEulers => "wrong_eulers",
            FailureKind::SeamMismatches => "seam_mismatches",
        }
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// In which way.
    pub kind: FailureKind,
    /// The base triangle it belongs to, by the file's number.
    pub base: Option<u32>,
    /// What is wrong, as a sentence with coordinates.
    pub message: String,
    /// The vertices that it is about, in the digits of the file.
    pub vertices: Vec<String>,
}

/// What the checker found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Report {
    /// Whether nothing is wrong.
    pub ok: bool,
    /// Base triangles; `None` for a mesh that is judged by itself.
    pub base_triangles: Option<u64>,
    /// Base triangles without area, to which the checks of the whole mesh apply only.
    pub zero_area_base_triangles: u64,
    /// Triangles.
    pub triangles: u64,
    /// Distinct vertices that triangles use.
    pub vertices: u64,
    /// Pairs of base triangles (with area) that share a base edge; an edge of three counts twice.
    pub shared_base_edges: u64,
    /// Edges that triangles use more often one way than the other, rightly (rim) or wrongly.
    pub boundary_edges: u64,
    /// Loops that these form.
    pub boundary_loops: u64,
    /// Number of failures of each kind, all kinds listed.
    pub counts: BTreeMap<&'static str, u64>,
    /// The first three failures of each kind.
    pub failures: Vec<Failure>,
}

impl Report {
    /// Number of failures of one kind.
    pub fn count(&self, kind: FailureKind) -> u64 {
        self.counts.get(kind.name()).copied().unwrap_or(0)
    }
}

fn counted(number: u64, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

/// The failures that are described, a line each, and the line that sums up.
impl fmt::Display for Report {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for failure in &self.failures {
            write!(formatter, "FAIL {}", failure.kind.name())?;
            if let Some(base) = failure.base {
                write!(formatter, " base {base}")?;
            }
            writeln!(formatter, ": {}", failure.message)?;
        }
        let triangles = counted(self.triangles, "triangle");
        match self.base_triangles {
            Some(bases) => {
                let (bases, shared) =
                    (counted(bases, "base triangle"), counted(self.shared_base_edges, "shared base edge"));
                write!(formatter, "{bases}, {triangles}, {shared}: ")?;
            }
            None => {
                write!(
                    formatter,
                    "{triangles}, {}, ",
                    counted(self.vertices, "vertex").replace("vertexs", "vertices")
                )?;
                match self.boundary_edges {
                    0 => write!(formatter, "no open edge: ")?,
                    edges => {
                        let loops = counted(self.boundary_loops, "boundary loop");
                        write!(formatter, "{} in {loops}: ", counted(edges, "open edge"))?;
                    }
                }
            }
        }
        if self.ok {
            return writeln!(formatter, "OK");
        }
        write!(formatter, "BAD")?;
        for kind in FailureKind::ALL {
            if self.count(kind) > 0 {
                write!(formatter, " {}:{}", kind.name(), self.count(kind))?;
            }
        }
        writeln!(formatter)
    }
}

/// Failures found by one part of a pass, in order.
#[derive(Default)]
pub(super) struct Findings {
    counts: [u64; FailureKind::ALL.len()],
    first: [Vec<Failure>; FailureKind::ALL.len()],
}

impl Findings {
    /// Counts a failure; `describe` is asked for the first few only.
    pub(super) fn hit(
        &mut self,
        kind: FailureKind,
        base: Option<u32>,
        describe: impl FnOnce() -> (String, Vec<String>),
    ) {
        self.counts[kind as usize] += 1;
        let first = &mut self.first[kind as usize];
        if first.len() < DESCRIBED {
            let (message, vertices) = describe();
            first.push(Failure { kind, base, message, vertices });
        }
    }

    /// Adds failures that come after these.
    pub(super) fn append(&mut self, later: Findings) {
        for (count, more) in self.counts.iter_mut().zip(later.counts) {
            *count += more;
        }
        for (first, more) in self.first.iter_mut().zip(later.first) {
            first.extend(more);
            first.truncate(DESCRIBED);
        }
    }

    /// Number of each kind, and the described ones in the order of [`FailureKind::ALL`].
    pub(super) fn into_parts(self) -> (BTreeMap<&'static str, u64>, Vec<Failure>) {
        let counts = FailureKind::ALL.map(|kind| (kind.name(), self.counts[kind as usize]));
        (counts.into_iter().collect(), self.first.into_iter().flatten().collect())
    }
}
