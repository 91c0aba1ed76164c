// SPDX-License-Identifier: MIT OR Apache-2.0
//! Open edges of a displaced draw, and why each of them is open.
//!
//! Every displaced triangle runs round its three edges; an edge that is not run back by a neighbour is open. It may be so
//! for three reasons that are counted: it lies on the *rim* of the base mesh, it borders what was *dropped* or culled
//! (a base triangle, the far side of a cutting plane, a triangle with a vertex that has no place), or neither, and then it is a
//! *crack*. A datapath without fault has no crack, whatever the camera.
//!
//! Edges are compared by displaced integers (X', Y', c'), so a crack of 1/256 pixel counts. Base edges are the same if
//! position and normal of their ends are: where normals differ at one place, the base mesh itself is torn there.

use crate::displace::displaced;
use crate::draw::{Assembled, Counts, Draw};
use crate::mip_build::Pyramid;
use crate::mip_fetch::{Filter, fetch};
use crate::remesher::{Format, Place, observe};
use crate::step::Vertex;
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
    /// Of the rim that a plane has cut.
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

/// The edges of a draw, made for `format`.
pub fn closure(draw: &Draw, format: &Format, pyramid: &Pyramid) -> Closure {
    let mut out = Closure::default();
    let mut edges: FxHashMap<[Point; 2], Edge> = FxHashMap::default();
    let mut base_edges: FxHashMap<(End, End), (i32, bool)> = FxHashMap::default();
    for (index, corners) in draw.triangles.iter().enumerate() {
        let assembled = draw.assemble(index);
        out.assembled.count(&assembled);
        let ends = corners.map(|v| &draw.records[v as usize]).map(|record| [record.position, record.normal]);
        let base_edge = |k: usize| {
            let (a, b) = (ends[k], ends[(k + 1) % 3]);
            ((a.min(b), a.max(b)), if a < b { 1 } else { -1 })
        };
        let is_whole = matches!(assembled, Assembled::Kept(_));
        for k in 0..3 {
            let ((a, b), way) = base_edge(k);
            // Both ways along one edge, a triangle without area neither opens nor closes it.
            if a != b {
                let entry = base_edges.entry((a, b)).or_insert((0, true));
                *entry = (entry.0 + way, entry.1 && is_whole);
            }
        }
        for piece in assembled.pieces() {
            let mut known: FxHashMap<Place, Vertex> = FxHashMap::default();
            observe(format, piece, &mut |step, rung| {
                let mut send = |place, vertex: &Vertex| {
                    let request = draw.request(vertex);
                    let q = fetch(pyramid, request.level as usize, request.u, request.v, Filter::Bilinear);
                    known.insert(place, draw.displace(vertex, q));
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
                        let owner = match common_edge(places[k], places[next]) {
                            None => Owner::Interior,
                            Some(_) if !is_whole => Owner::Cut,
                            Some(k) => {
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
            // Its triangle is not drawn, its neighbour is.
            out.dropped += u64::from(edge.borders_invalid);
            continue;
        }
        match edge.owner {
            Some(Owner::Cut) => out.dropped += 1,
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

/// The base edge that both places lie on.
fn common_edge(a: Place, b: Place) -> Option<usize> {
    let on = |place: Place, k: usize| match place {
        Place::Corner(corner) => usize::from(corner) == k || usize::from(corner) == (k + 1) % 3,
        Place::Edge { edge, .. } => usize::from(edge) == k,
        Place::Interior { .. } => false,
    };
    (0..3).find(|&k| on(a, k) && on(b, k))
}
