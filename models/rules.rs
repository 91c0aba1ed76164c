// SPDX-License-Identifier: MIT OR Apache-2.0
//! The rules by which a vertex finds its height, those of the paper among them.
//!
//! | `footprint` | filter level of a vertex from |
//! |-------------|-------------------------------|
//! | `density`   | the density of texels there, which is vertex data ([`filter_level`]); what the hardware does |
//! | `exact`     | the difference vertices of the sweep ([`exact_footprint`], a block in no draw): those of the plane inside, that of the edge on an edge; at a corner the density |
//! | `paper`     | the same, and a corner takes the edge that the sweep meets it on, as Gumhold & Huettner 1999, section 3.4, have it |
//!
//! | `extremum` | levels that a vertex reads |
//! |------------|----------------------------|
//! | `max`      | maxima |
//! | `min`      | minima |
//! | `vertex`   | maxima where its normal faces the eye, otherwise minima ([`facing`]) |
//! | `triangle` | minima in base triangles seen from the back, as in the paper |
//!
//! A mesh stays closed if the height is a function of what all base triangles round a vertex share: the vertex, or, inside
//! of an edge, the edge. `paper` is not at corners, `triangle` is not on any edge of the outline of the base mesh: they
//! crack. `relief stability` counts it.

use crate::draw::{Draw, Request};
use crate::exact_footprint;
use crate::facing;
use crate::filter_level;
use crate::mip_build::Pyramid;
use crate::mip_fetch::{self, Filter};
use crate::perspective_correct;
use crate::remesher::{self, BaseTriangle, Format, Place, Setup};
use crate::step::Vertex;
use crate::vertex_transform::lane;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Where the filter level of a vertex comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FootprintRule {
    /// The density of texels.
    #[default]
    Density,
    /// Difference vertices, and at corners the density.
    Exact,
    /// Difference vertices, at corners too.
    Paper,
}

/// Which levels a vertex reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ExtremumRule {
    /// Maxima.
    #[default]
    Max,
    /// Minima.
    Min,
    /// Minima at vertices that face away.
    Vertex,
    /// Minima in base triangles that face away.
    Triangle,
}

/// How a vertex finds its height.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Rules {
    /// Of its level.
    pub footprint: FootprintRule,
    /// Of what the level holds.
    pub extremum: ExtremumRule,
}

impl FootprintRule {
    /// Its name in a scene file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::Exact => "exact",
            Self::Paper => "paper",
        }
    }
}

impl ExtremumRule {
    /// Its name in a scene file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Max => "max",
            Self::Min => "min",
            Self::Vertex => "vertex",
            Self::Triangle => "triangle",
        }
    }
}

impl fmt::Display for Rules {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(&format!("{}, {}", self.footprint.name(), self.extremum.name()))
    }
}

impl Rules {
    /// What a draw does unless it is told otherwise.
    pub const DEFAULT: Rules = Rules { footprint: FootprintRule::Density, extremum: ExtremumRule::Max };

    /// Whether the height is a function of what all base triangles round a vertex share, so that no mesh cracks; with
    /// difference vertices, but for a seam whose two sides round to either side of a threshold.
    pub const fn keeps_closed(self) -> bool {
        !matches!(self.footprint, FootprintRule::Paper) && !matches!(self.extremum, ExtremumRule::Triangle)
    }

    /// Whether vertices of a draw read different pyramids.
    pub const fn reads_both(self) -> bool {
        matches!(self.extremum, ExtremumRule::Vertex | ExtremumRule::Triangle)
    }

    /// What is read of the levels of a map: one pyramid stands alone where no vertex reads the other.
    pub fn reads(self, pyramids: Pyramids<'_>) -> Pyramids<'_> {
        match self.extremum {
            ExtremumRule::Max => pyramids.maxima.into(),
            ExtremumRule::Min => pyramids.minima.unwrap_or(pyramids.maxima).into(),
            ExtremumRule::Vertex | ExtremumRule::Triangle => pyramids,
        }
    }

    /// Why the hardware of a draw does not have them, as the end of a sentence about `[remesh]`; `None` for those that it has.
    pub fn refusal(self) -> Option<String> {
        let (field, value, expected) = match self {
            Self { footprint: FootprintRule::Density, extremum: ExtremumRule::Triangle } => {
                ("extremum", "triangle", "vertex")
            }
            Self { footprint: FootprintRule::Density, .. } => return None,
            Self { footprint, .. } => ("footprint", footprint.name(), "density"),
        };
        Some(format!(
            "`{field}` is \"{value}\", which no draw of the hardware has, for `relief stability` and `relief wagging`; \
             \"{expected}\" is expected"
        ))
    }
}

/// The levels of a map that a draw reads: one pyramid, or maxima and minima.
#[derive(Clone, Copy, Debug)]
pub struct Pyramids<'a> {
    /// What a vertex reads that does not ask for minima.
    pub maxima: &'a Pyramid,
    /// The least of each node's neighbours; none for draws whose rule reads but one pyramid.
    pub minima: Option<&'a Pyramid>,
}

impl<'a> Pyramids<'a> {
    /// What a vertex reads at a level. Level 0 is the map, one for both; where its pole rows have one value, that of the maxima.
    pub fn of(&self, minima: bool, level: u32) -> &'a Pyramid {
        self.minima.filter(|_| minima && level > 0).unwrap_or(self.maxima)
    }
}

/// The same levels for all vertices.
impl<'a> From<&'a Pyramid> for Pyramids<'a> {
    fn from(pyramid: &'a Pyramid) -> Self {
        Self { maxima: pyramid, minima: None }
    }
}

/// Greatest and least levels.
impl<'a> From<&'a [Pyramid; 2]> for Pyramids<'a> {
    fn from([maxima, minima]: &'a [Pyramid; 2]) -> Self {
        Self { maxima, minima: Some(minima) }
    }
}

/// A piece of a base triangle with what the rules of its draw take of it.
#[derive(Clone, Debug)]
pub struct Ruled<'a> {
    draw: &'a Draw,
    format: &'a Format,
    base: &'a BaseTriangle,
    /// None where the level takes no difference vertex.
    setup: Option<Box<Setup>>,
    is_back: bool,
}

impl<'a> Ruled<'a> {
    /// Of a piece of [`Draw::assemble`], made for `format`.
    pub fn new(draw: &'a Draw, format: &'a Format, base: &'a BaseTriangle) -> Self {
        let setup = (draw.rules.footprint != FootprintRule::Density).then(|| Box::new(Setup::new(format, base)));
        Self { draw, format, base, setup, is_back: is_back(base) }
    }

    /// What a vertex at `place` asks of the height map.
    pub fn request(&self, vertex: &Vertex, place: Place) -> Request {
        let request = self.draw.request(vertex);
        let levels = self.draw.level.levels;
        let level = self.footprint(vertex, place).map(|footprint| filter_level::level(footprint, levels));
        Request { level: level.unwrap_or(request.level), ..request }
    }

    /// The footprint from difference vertices, UQ16.16; none where the density counts.
    pub fn footprint(&self, vertex: &Vertex, place: Place) -> Option<u32> {
        let setup = self.setup.as_ref()?;
        let Draw { lanes, axes, .. } = self.draw;
        let wide = lanes.widen(vertex);
        let inverse = perspective_correct::inverse(wide[lane::C]);
        let guard_bits = self.format.guard_bits;
        let of = |differences: &[&Vertex]| {
            let mut wide_differences = [[0; crate::step::MAX_COMPONENTS]; 2];
            for (to, from) in wide_differences.iter_mut().zip(differences) {
                *to = lanes.widen_difference(from);
            }
            exact_footprint::golden(&wide, &wide_differences[..differences.len()], guard_bits, axes, inverse)
        };
        match self.edge(setup, place) {
            _ if matches!(place, Place::Interior { .. }) => {
                Some(of(&[&setup.sweep_difference, &setup.side_difference]))
            }
            Some(edge) => Some(of(&[&setup.edges[edge].difference])),
            None => None,
        }
    }

    /// The edge whose difference vertex counts at a place.
    fn edge(&self, setup: &Setup, place: Place) -> Option<usize> {
        match place {
            Place::Edge { edge, .. } => Some(edge.into()),
            // The primary edge begins and ends the sweep; its third corner comes on the edge from A.
            Place::Corner(corner) if self.draw.rules.footprint == FootprintRule::Paper => {
                let [a, _, c] = setup.roles;
                let upper = if (a + 1) % 3 == c { a } else { c };
                Some(if usize::from(corner) == c { upper } else { setup.primary })
            }
            Place::Corner(_) | Place::Interior { .. } => None,
        }
    }

    /// Whether a vertex reads minima.
    pub fn reads_minima(&self, vertex: &Vertex) -> bool {
        match self.draw.rules.extremum {
            ExtremumRule::Max => false,
            ExtremumRule::Min => true,
            ExtremumRule::Vertex => facing::of_vertex(&self.draw.lanes.widen(vertex), self.draw.displacement.focal),
            ExtremumRule::Triangle => self.is_back,
        }
    }

    /// The vertex at `place`, displaced by its height.
    pub fn displaced(&self, pyramids: Pyramids<'_>, vertex: &Vertex, place: Place) -> Vertex {
        let Request { level, u, v, .. } = self.request(vertex, place);
        let pyramid = self.draw.rules.reads(pyramids).of(self.reads_minima(vertex), level);
        self.draw.displace(vertex, mip_fetch::fetch(pyramid, level as usize, u, v, Filter::Bilinear))
    }

    /// Sends the displaced triangles to `sink` in the order of the strip unit.
    pub fn triangles(&self, pyramids: Pyramids<'_>, sink: &mut impl FnMut([Vertex; 3])) {
        let mut known: FxHashMap<Place, Vertex> = FxHashMap::default();
        remesher::observe(self.format, self.base, &mut |step, rung| {
            if step.sends_left() {
                known.insert(rung.next_left, self.displaced(pyramids, &step.left_vertex, rung.next_left));
            }
            if step.sends_right() {
                known.insert(rung.next_right, self.displaced(pyramids, &step.right_vertex, rung.next_right));
            }
            for places in rung.triangles(step) {
                sink(places.map(|place| known[&place]));
            }
        });
    }
}

/// Whether a base triangle is seen from the back: counterclockwise from the front, and y goes down.
fn is_back(base: &BaseTriangle) -> bool {
    let [a, b, c] = base.data.map(|data| [i128::from(data[lane::X]), i128::from(data[lane::Y])]);
    let span = |to: [i128; 2], axis: usize| to[axis] - a[axis];
    span(b, 0) * span(c, 1) - span(b, 1) * span(c, 0) > 0
}
