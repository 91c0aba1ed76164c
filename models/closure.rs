// SPDX-License-Identifier: MIT OR Apache-2.0
//! Open edges of a displaced draw, and why each of them is open.
//!
//! Every displaced triangle runs round its three edges; an edge that is not run back by a neighbour is open. It may be so
//! for three reasons that are counted: it lies on the *rim* of the base mesh, it borders what was *dropped* or culled
//! (a base triangle, the far side of a cutting plane, a triangle with a vertex that has no place), or neither, and then it is a
//! *crack*. A datapath without fault has no crack, whatever the camera.
//!
//! What a cutting plane has left is a polygon: its edges on a plane are a rim of what was cut, the others are pieces of base
//! edges, and the diagonals of its fan lie inside. Edges are compared by displaced integers (X', Y', c'), so a crack of 1/256 pixel counts. Base edges are the same if
//! position and normal of their ends are: where normals differ at one place, the base mesh itself is torn there.

use crate::clip;
use crate::displace::displaced;
use crate::draw::{Assembled, Counts, Draw};
use crate::remesher::{Format, Place, observe};
use crate::rules::{Pyramids, Ruled};
use crate::step::Vertex;
use crate::vertex_transform::{ViewVertex, distance, view};
use rustc_hash::FxHashMap;
use serde::Serialize;

/// Edges of a displaced draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Closure {
    /// What became of the base triangles.
    pub assembled: Counts,
    /// Triangles with a place.
    pub triangles: u64,
    /// Triangles without one: a vertex behind the eye, nearer than z0, or beyond the format.
    pub invalid: u64,
    /// Open edges on the rim of the base mesh.
    pub rim: u64,
    /// Open edges that border what was dropped, cut or culled.
    pub dropped: u64,
    /// All other open edges.
    pub cracks: u64,
}

impl Closure {
    /// Of the edges of both; objects share none.
    #[must_use]
    pub fn with(self, other: &Self) -> Self {
        let mut assembled = self.assembled;
        assembled.add(&other.assembled);
        Self {
            assembled,
            triangles: self.triangles + other.triangles,
            invalid: self.invalid + other.invalid,
            rim: self.rim + other.rim,
            dropped: self.dropped + other.dropped,
            cracks: self.cracks + other.cracks,
        }
    }
}

type Point = [i32; 3];
/// Position and normal of a record.
type End = [[i32; 3]; 2];

/// What an edge is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Owner {
    Interior,
    /// The base edge with these ends, the lower one first.
    Base(End, End),
    /// Of a plane that has cut.
    Cut,
}

#[derive(Default)]
struct Edge {
    /// How often it is run one way more than the other.
    net: i32,
    /// Whether a triangle without a place has it.
    borders_invalid: bool,
    owner: Option<Owner>,
}

/// The edges of a draw, made for `format`, by its [rules](crate::rules).
pub fn closure<'a>(draw: &Draw, format: &Format, pyramids: impl Into<Pyramids<'a>>) -> Closure {
    let pyramids = pyramids.into();
    let mut out = Closure::default();
    let mut edges: FxHashMap<[Point; 2], Edge> = FxHashMap::default();
    // How often a base edge is run one way more than the other, and whether all its base triangles are there.
    let mut base_edges: FxHashMap<(End, End), (i32, bool)> = FxHashMap::default();
    for (index, corners) in draw.triangles.iter().enumerate() {
        let assembled = draw.assemble(index);
        out.assembled.count(&assembled);
        let ends = corners.map(|v| &draw.records[v as usize]).map(|record| [record.position, record.normal]);
        let base_edge = |k: usize| {
            let (a, b) = (ends[k], ends[(k + 1) % 3]);
            ((a.min(b), a.max(b)), if a < b { 1 } else { -1 })
        };
        let is_there = !assembled.pieces().is_empty();
        let sides = sides(draw, index, &assembled);
        for k in 0..3 {
            let ((a, b), way) = base_edge(k);
            // Both ways along one edge, a triangle without area neither opens nor closes it.
            if a != b {
                let entry = base_edges.entry((a, b)).or_insert((0, true));
                *entry = (entry.0 + way, entry.1 && is_there);
            }
        }
        for (piece, sides) in assembled.pieces().iter().zip(&sides) {
            let ruled = Ruled::new(draw, format, piece);
            let mut known: FxHashMap<Place, Vertex> = FxHashMap::default();
            observe(format, piece, &mut |step, rung| {
                let mut send = |place, vertex: &Vertex| {
                    known.insert(place, ruled.displaced(pyramids, vertex, place));
                };
                if step.sends_left() {
                    send(rung.next_left, &step.left_vertex);
                }
                if step.sends_right() {
                    send(rung.next_right, &step.right_vertex);
                }
                for places in rung.triangles(step) {
                    let vertices = places.map(|place| known[&place]);
                    let is_drawable = Draw::is_drawable(&vertices);
                    out.triangles += u64::from(is_drawable);
                    out.invalid += u64::from(!is_drawable);
                    for k in 0..3 {
                        let next = (k + 1) % 3;
                        let (a, b) = (&vertices[k], &vertices[next]);
                        if a[displaced::FLAGS] != 0 || b[displaced::FLAGS] != 0 {
                            continue;
                        }
                        let [a, b] = [a, b].map(|v| [0, 1, 2].map(|lane| v[lane] as i32));
                        if a == b {
                            continue;
                        }
                        let edge = edges.entry([a.min(b), a.max(b)]).or_default();
                        edge.net += if a < b { 1 } else { -1 };
                        edge.borders_invalid |= !is_drawable;
                        let owner = match common_edge(places[k], places[next]).map(|side| sides[side]) {
                            None | Some(Side::Inside) => Owner::Interior,
                            Some(Side::Plane) => Owner::Cut,
                            Some(Side::Base(k)) => {
                                let ((a, b), _) = base_edge(k);
                                Owner::Base(a, b)
                            }
                        };
                        edge.owner = edge.owner.max(Some(owner));
                    }
                }
            });
        }
    }
    for edge in edges.values() {
        if edge.net == 0 {
            // One of its triangles is not drawn, or both.
            out.dropped += u64::from(edge.borders_invalid);
            continue;
        }
        match edge.owner {
            Some(Owner::Cut) => out.dropped += 1,
            // Copies of one corner that have parted.
            Some(Owner::Base(a, b)) if a == b => out.cracks += 1,
            Some(Owner::Base(a, b)) => match base_edges.get(&(a, b)) {
                Some((0, true)) => out.cracks += 1,
                Some((_, false)) => out.dropped += 1,
                _ => out.rim += 1,
            },
            _ => out.cracks += 1,
        }
    }
    out
}

/// What a side of a piece is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// A diagonal of the fan.
    Inside,
    /// On a plane that cuts.
    Plane,
    /// Of the base edge of that number.
    Base(usize),
}

/// What the sides of each piece of a base triangle are of.
fn sides(draw: &Draw, index: usize, assembled: &Assembled) -> Vec<[Side; 3]> {
    let Assembled::Cut(pieces) = assembled else { return vec![[Side::Base(0), Side::Base(1), Side::Base(2)]] };
    let corners = draw.triangles[index].map(|v| view(&draw.transform, &draw.records[v as usize]));
    // The polygon with what the edge behind each vertex is of, plane by plane as `clip` makes it.
    let mut polygon: Vec<(ViewVertex, Side)> = (0..3).map(|k| (corners[k], Side::Base(k))).collect();
    for plane in 0..clip::PLANES {
        let at: Vec<i64> = polygon.iter().map(|(v, _)| distance(&draw.transform, plane, v.position)).collect();
        let mut left = Vec::new();
        for (k, (vertex, side)) in polygon.iter().enumerate() {
            let next = (k + 1) % polygon.len();
            if at[k] >= 0 {
                left.push((*vertex, if at[k] == 0 && at[next] < 0 { Side::Plane } else { *side }));
            }
            if at[k] < 0 && at[next] > 0 || at[k] > 0 && at[next] < 0 {
                let point = clip::cut(vertex, &polygon[next].0, at[k], at[next]);
                left.push((point, if at[k] < 0 { *side } else { Side::Plane }));
            }
        }
        polygon = left;
    }
    let last = pieces.len() + 1;
    let side = |k: usize| polygon.get(k).map_or(Side::Plane, |(_, side)| *side);
    let first = |k: usize| if k == 1 { side(0) } else { Side::Inside };
    (1..last).map(|k| [first(k), side(k), if k + 1 == last { side(last) } else { Side::Inside }]).collect()
}

/// The base edge that both places lie on.
fn common_edge(a: Place, b: Place) -> Option<usize> {
    let on = |place: Place, k: usize| match place {
        Place::Corner(corner) => usize::from(corner) == k || usize::from(corner) == (k + 1) % 3,
        Place::Edge { edge, .. } => usize::from(edge) == k,
        Place::Interior { .. } => false,
    };
    (0..3).find(|&k| on(a, k) && on(b, k))
}
