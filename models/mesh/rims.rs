// SPDX-License-Identifier: MIT OR Apache-2.0
//! The rim of each base triangle, and what base triangles that share an edge make of it.
//!
//! The open edges of a base triangle's triangles have to be one loop through its corners in order, along its edges.
//! With positive orientation and V - E + F = 1 that proves a tiling. The rims of base triangles that share a base edge
//! have to hold the same vertices, bit by bit.
//!
//! Over all triangles an edge may be used more often in one direction only where the base mesh has its own rim: a base
//! edge with `m` more base triangles running one way than the other asks for a net use of `m` along it. So an edge that
//! three base triangles share is right as it is. Base triangles without area have no loop that could be checked: their
//! vertices coincide in space. The group of such triangles is allowed an imbalance along its base edges if it touches
//! the rim of the base mesh, and none if it does not.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::check::Context;
use super::edges::{Edges, OpenInBase, Unbalanced};
use super::exact::{Int, cross, dot};
use super::report::{FailureKind, Findings};

/// What a base triangle makes of one of its edges.
enum Rim {
    /// All vertices from the edge's first corner to its second.
    Complete(Vec<u32>),
    /// The open edges along it, where they do not make up a whole.
    Partial(Vec<[u32; 2]>),
    /// A base triangle without area.
    ZeroArea,
}

/// The use of a base edge by a base triangle.
struct BaseEdge {
    /// Its corners, the lower vertex number first.
    corners: [u32; 2],
    base: u32,
    /// Whether the base triangle runs from the lower to the upper corner.
    forward: bool,
    /// From the lower to the upper corner, if complete.
    rim: Rim,
}

/// What the rims leave to be checked and reported.
pub(super) struct Rims {
    pub(super) shared: u64,
    /// Open edges that may have a T-vertex inside.
    pub(super) suspects: Vec<[u32; 2]>,
    /// Vertices that one of two base triangles has on their shared edge, with that edge's corners.
    pub(super) t_vertices: Vec<(u32, [u32; 2])>,
}

pub(super) fn examine(
    context: &Context<'_>,
    mut edges: Edges,
    repeated: &[(u32, u32)],
    findings: &mut Findings,
) -> Rims {
    let Some(bases) = &context.mesh.bases else {
        return Rims { shared: 0, suspects: Vec::new(), t_vertices: Vec::new() };
    };
    context.progress.phase("base triangles", bases.names.len() as u64);
    euler(context, &edges, repeated, findings);
    let open = &mut edges.open_in_base;
    open.par_sort_unstable();
    let chunks: Vec<std::ops::Range<usize>> = ranges(bases.names.len());
    let results: Vec<(Findings, Vec<BaseEdge>, Vec<[u32; 2]>)> = chunks
        .into_par_iter()
        .map(|range| {
            let (mut findings, mut rims, mut suspects) = (Findings::default(), Vec::new(), Vec::new());
            context.advance(range.len());
            let mut rest = &open[open.partition_point(|edge| (edge.base as usize) < range.start)..];
            for base in range {
                let (own, others) = rest.split_at(rest.iter().take_while(|edge| edge.base as usize == base).count());
                rest = others;
                examine_base(context, base, own, &mut rims, &mut suspects, &mut findings);
            }
            (findings, rims, suspects)
        })
        .collect();
    let (mut rims, mut suspects) = (Vec::new(), Vec::new());
    for (found, mut part, mut more) in results {
        findings.append(found);
        rims.append(&mut part);
        suspects.append(&mut more);
    }
    rims.par_sort_by_key(|rim| (rim.corners, rim.base));
    let mut seams = Seams::new(bases.names.len());
    for group in rims.chunk_by(|a, b| a.corners == b.corners) {
        seams.examine(context, group, findings);
    }
    seams.allow_beside_zero_area(&rims);
    seams.account(context, &edges.unbalanced, &mut suspects, findings);
    Rims { shared: seams.shared, suspects, t_vertices: seams.t_vertices }
}

/// Ranges of base triangles that a task looks at.
fn ranges(bases: usize) -> Vec<std::ops::Range<usize>> {
    const CHUNK: usize = 1 << 10;
    (0..bases.div_ceil(CHUNK)).map(|chunk| chunk * CHUNK..bases.min((chunk + 1) * CHUNK)).collect()
}

/// V - E + F = 1 for each base triangle with area. `E` follows from the half-edges: three a triangle, two an edge, and
/// what differs from that. Triangles with a vertex twice count for nothing.
fn euler(context: &Context<'_>, edges: &Edges, repeated: &[(u32, u32)], findings: &mut Findings) {
    let Some(bases) = &context.mesh.bases else { return };
    let mut faces: Vec<i64> = bases.first.windows(2).map(|pair| i64::from(pair[1] - pair[0])).collect();
    for (base, number) in repeated {
        faces[*base as usize] -= i64::from(*number);
    }
    let mut twice_edges: Vec<i64> = faces.iter().map(|faces| 3 * faces).collect();
    for (base, difference) in &edges.irregular {
        twice_edges[*base as usize] += i64::from(*difference);
    }
    for (base, (twice, faces)) in twice_edges.into_iter().zip(faces).enumerate() {
        let value = i64::from(context.vertices_of_base[base]) - twice / 2 + faces;
        if value != 1 && faces > 0 && !context.zero_area[base] {
            findings.hit(FailureKind::WrongEulers, Some(bases.names[base]), || {
                (format!("V - E + F is {value}; 1 is expected of a disc without holes"), Vec::new())
            });
        }
    }
}

fn examine_base(
    context: &Context<'_>,
    base: usize,
    open: &[OpenInBase],
    rims: &mut Vec<BaseEdge>,
    suspects: &mut Vec<[u32; 2]>,
    findings: &mut Findings,
) {
    let Some(bases) = &context.mesh.bases else { return };
    let (corners, name) = (bases.corners[base], Some(bases.names[base]));
    let side = |index: usize| [corners[index], corners[(index + 1) % 3]];
    let found = if context.zero_area[base] {
        [Rim::ZeroArea, Rim::ZeroArea, Rim::ZeroArea]
    } else if bases.first[base] == bases.first[base + 1] {
        findings.hit(FailureKind::UncoveredBases, name, || {
            let corners = corners.map(|corner| context.mesh.points.display(corner));
            (format!("{} has no triangle", corners.join(" ")), corners.to_vec())
        });
        [0; 3].map(|_| Rim::Partial(Vec::new()))
    } else {
        match walk(context, corners, open) {
            Ok(sequences) => {
                let mut index = 0;
                sequences.map(|vertices| {
                    index += 1;
                    along(context, side(index - 1), vertices, name, suspects, findings)
                })
            }
            Err((why, vertices)) => {
                findings.hit(FailureKind::BrokenLoops, name, || {
                    (why, vertices.into_iter().map(|vertex| context.mesh.points.display(vertex)).collect())
                });
                suspects.extend(open.iter().map(|edge| [edge.from, edge.to]));
                [0, 1, 2].map(|index| gather(context, side(index), open))
            }
        }
    };
    for (index, rim) in found.into_iter().enumerate() {
        let [from, to] = side(index);
        if from == to {
            continue;
        }
        let forward = from < to;
        let rim = match rim {
            Rim::Complete(mut vertices) if !forward => {
                vertices.reverse();
                Rim::Complete(vertices)
            }
            rim => rim,
        };
        rims.push(BaseEdge { corners: [from.min(to), from.max(to)], base: base as u32, forward, rim });
    }
}

/// A sentence, and the vertices it is about.
type Complaint = (String, Vec<u32>);

/// Follows the open edges from the first corner round to it; the vertices from corner to corner, ends included.
fn walk(context: &Context<'_>, corners: [u32; 3], open: &[OpenInBase]) -> Result<[Vec<u32>; 3], Complaint> {
    let display = |vertex: u32| context.mesh.points.display(vertex);
    if let Some(pair) = open.windows(2).find(|pair| pair[0].from == pair[1].from) {
        let vertex = pair[0].from;
        return Err((format!("two open edges start at {}; one is expected", display(vertex)), vec![vertex]));
    }
    let next = |vertex: u32| open.binary_search_by_key(&vertex, |edge| edge.from).ok().map(|index| open[index].to);
    let mut sequences: [Vec<u32>; 3] = Default::default();
    let (mut side, mut vertex) = (0, corners[0]);
    sequences[0].push(vertex);
    for _ in 0..open.len() {
        let Some(following) = next(vertex) else {
            let message = format!("no open edge goes on from {}, where the rim should", display(vertex));
            return Err((message, vec![vertex]));
        };
        vertex = following;
        sequences[side].push(vertex);
        if vertex == corners[(side + 1) % 3] {
            side += 1;
            if side == 3 {
                break;
            }
            sequences[side].push(vertex);
        }
    }
    if side < 3 {
        let corner = corners[(side + 1) % 3];
        let message = format!("the open edges do not lead round to corner {}", display(corner));
        return Err((message, vec![corner]));
    }
    let used: usize = sequences.iter().map(|vertices| vertices.len() - 1).sum();
    if used != open.len() {
        let message = format!("{} open edges are not part of the loop round the corners", open.len() - used);
        return Err((message, corners.to_vec()));
    }
    Ok(sequences)
}

/// Whether the vertex is as near to the base edge as the tolerance asks, and how far along it.
fn position(context: &Context<'_>, [from, to]: [u32; 2], vertex: u32) -> (bool, Int) {
    let points = &context.mesh.points;
    let (edge, offset) = (points.difference(from, to), points.difference(from, vertex));
    (context.steps.covers(&cross(&offset, &edge), &edge), dot(&offset, &edge))
}

/// Checks that a sequence of vertices runs along its base edge.
fn along(
    context: &Context<'_>,
    ends: [u32; 2],
    vertices: Vec<u32>,
    name: Option<u32>,
    suspects: &mut Vec<[u32; 2]>,
    findings: &mut Findings,
) -> Rim {
    let places: Vec<(bool, Int)> = vertices.iter().map(|vertex| position(context, ends, *vertex)).collect();
    let (mut complete, mut parts) = (true, Vec::new());
    for (index, pair) in places.windows(2).enumerate() {
        let ((near_before, before), (near, place)) = (&pair[0], &pair[1]);
        let (vertex, advances) = (vertices[index + 1], place > before);
        if *near && *near_before && advances {
            parts.push([vertices[index], vertex]);
            continue;
        }
        complete = false;
        // A vertex beside the edge is told once, as the end of the step that leads to it.
        if !near || (*near_before && !advances) {
            let what =
                if *near { "is not farther along its base edge than the one before" } else { "is off its base edge" };
            findings.hit(FailureKind::OffEdgeVertices, name, || {
                let text = context.mesh.points.display(vertex);
                (format!("{text} {what}"), vec![text])
            });
        }
    }
    if complete {
        return Rim::Complete(vertices);
    }
    suspects.extend(vertices.windows(2).map(|pair| [pair[0], pair[1]]));
    Rim::Partial(parts)
}

/// The open edges along a base edge of a base triangle whose loop is broken, so that only what is wrong is reported.
fn gather(context: &Context<'_>, ends: [u32; 2], open: &[OpenInBase]) -> Rim {
    let mut parts: Vec<(Int, Int, [u32; 2])> = Vec::new();
    for edge in open {
        let (near_from, start) = position(context, ends, edge.from);
        if !near_from {
            continue;
        }
        let (near_to, end) = position(context, ends, edge.to);
        if near_to && start != end {
            parts.push((start, end, [edge.from, edge.to]));
        }
    }
    parts.sort();
    // Collinear neighbours of this edge lie on its line and beyond its ends.
    let edge = context.mesh.points.difference(ends[0], ends[1]);
    let length = dot(&edge, &edge);
    parts.retain(|(start, end, _)| [start, end].iter().all(|place| **place >= Int::ZERO && **place <= length));
    let chained = parts.windows(2).all(|pair| pair[0].2[1] == pair[1].2[0]);
    match (parts.first(), parts.last()) {
        (Some(first), Some(last)) if chained && first.2[0] == ends[0] && last.2[1] == ends[1] => {
            Rim::Complete(parts.iter().map(|part| part.2[0]).chain([ends[1]]).collect())
        }
        _ => Rim::Partial(parts.into_iter().map(|part| part.2).collect()),
    }
}

/// All base edges together.
struct Seams {
    shared: u64,
    t_vertices: Vec<(u32, [u32; 2])>,
    /// Net uses that the base mesh asks for: lower and upper vertex, uses from the lower to the upper.
    expected: Vec<([u32; 2], i32)>,
    /// Edges whose balance is not to be judged.
    allowed: Vec<[u32; 2]>,
    /// Groups of base triangles without area that hang together: the parent of each base triangle.
    parents: Vec<u32>,
    /// Base triangles without area that have an edge on the rim of the base mesh.
    at_rim: Vec<u32>,
    /// Roots of the groups that touch the rim of the base mesh.
    groups_at_rim: FxHashMap<u32, ()>,
}

impl Seams {
    fn new(bases: usize) -> Seams {
        Seams {
            shared: 0,
            t_vertices: Vec::new(),
            expected: Vec::new(),
            allowed: Vec::new(),
            parents: (0..bases as u32).collect(),
            at_rim: Vec::new(),
            groups_at_rim: FxHashMap::default(),
        }
    }

    fn root(&mut self, mut base: u32) -> u32 {
        while self.parents[base as usize] != base {
            let above = self.parents[self.parents[base as usize] as usize];
            self.parents[base as usize] = above;
            base = above;
        }
        base
    }

    /// Looks at all uses of one base edge.
    fn examine(&mut self, context: &Context<'_>, group: &[BaseEdge], findings: &mut Findings) {
        let net: i32 = group.iter().map(|edge| if edge.forward { 1 } else { -1 }).sum();
        let zero_area = || group.iter().filter(|edge| matches!(edge.rim, Rim::ZeroArea)).map(|edge| edge.base);
        self.shared += (group.len() - zero_area().count()).saturating_sub(1) as u64;
        if let Some(first) = zero_area().next() {
            for other in zero_area() {
                let (a, b) = (self.root(first), self.root(other));
                self.parents[a as usize] = b;
            }
            if net != 0 {
                self.at_rim.push(first);
            }
        }
        let mut complete = group.iter().filter_map(|edge| match &edge.rim {
            Rim::Complete(vertices) => Some((edge.base, vertices)),
            _ => None,
        });
        let first = complete.next();
        if let Some((base, vertices)) = first {
            for (other, others) in complete {
                if vertices != others {
                    self.mismatch(context, [base, other], [vertices, others], group[0].corners, findings);
                }
            }
        }
        if net == 0 {
            return;
        }
        match first {
            Some((_, vertices)) => {
                self.expected.extend(vertices.windows(2).map(|pair| directed([pair[0], pair[1]], net)));
            }
            None => {
                for edge in group {
                    if let Rim::Partial(parts) = &edge.rim {
                        self.expected.extend(parts.iter().map(|part| directed(*part, 1)));
                    }
                }
            }
        }
    }

    /// Reports two different rims along one base edge, and the vertices that only one of them has where the other runs
    /// on in one step.
    fn mismatch(
        &mut self,
        context: &Context<'_>,
        bases: [u32; 2],
        rims: [&[u32]; 2],
        corners: [u32; 2],
        findings: &mut Findings,
    ) {
        let names = bases.map(|base| context.name(base).unwrap_or(0));
        let other = names[1];
        findings.hit(FailureKind::SeamMismatches, Some(names[0]), || {
            let at = rims[0].iter().zip(rims[1]).find(|(a, b)| a != b).map_or(corners, |(a, b)| [*a, *b]);
            let shown = at.map(|vertex| context.mesh.points.display(vertex));
            let message = format!(
                "goes on with {} where base {other}, which shares the edge, goes on with {}",
                shown[0], shown[1]
            );
            (message, shown.to_vec())
        });
        // Both rims run from corner to corner; cut them at the vertices they have in common.
        let place: FxHashMap<u32, usize> = rims[1].iter().enumerate().map(|(index, vertex)| (*vertex, index)).collect();
        let (mut before, mut before_other) = (0, 0);
        for (index, vertex) in rims[0].iter().enumerate().skip(1) {
            let Some(other) = place.get(vertex).copied().filter(|other| *other > before_other) else { continue };
            let (own, others) = (&rims[0][before + 1..index], &rims[1][before_other + 1..other]);
            if own.is_empty() || others.is_empty() {
                self.t_vertices.extend(own.iter().chain(others).map(|vertex| (*vertex, corners)));
            }
            (before, before_other) = (index, other);
        }
    }

    /// Allows imbalance along the edges of base triangles without area that hang together up to the rim of the base mesh.
    fn allow_beside_zero_area(&mut self, rims: &[BaseEdge]) {
        for base in std::mem::take(&mut self.at_rim) {
            let root = self.root(base);
            self.groups_at_rim.insert(root, ());
        }
        if self.groups_at_rim.is_empty() {
            return;
        }
        for group in rims.chunk_by(|a, b| a.corners == b.corners) {
            let beside = group.iter().any(|edge| {
                let root = self.root(edge.base);
                matches!(edge.rim, Rim::ZeroArea) && self.groups_at_rim.contains_key(&root)
            });
            if !beside {
                continue;
            }
            for edge in group {
                match &edge.rim {
                    Rim::Complete(vertices) => {
                        self.allowed.extend(vertices.windows(2).map(|pair| directed([pair[0], pair[1]], 1).0));
                    }
                    Rim::Partial(parts) => self.allowed.extend(parts.iter().map(|part| directed(*part, 1).0)),
                    Rim::ZeroArea => {}
                }
            }
        }
    }

    /// Compares the balance of every edge with what the base mesh asks for.
    fn account(
        &mut self,
        context: &Context<'_>,
        unbalanced: &[Unbalanced],
        suspects: &mut Vec<[u32; 2]>,
        findings: &mut Findings,
    ) {
        if context.options.closed {
            self.expected.clear();
            self.allowed.clear();
            self.groups_at_rim.clear();
        }
        self.expected.par_sort_unstable();
        self.allowed.par_sort_unstable();
        let mut expected = self
            .expected
            .chunk_by(|a, b| a.0 == b.0)
            .map(|part| (part[0].0, part.iter().map(|(_, net)| net).sum::<i32>()))
            .collect::<Vec<_>>()
            .into_iter()
            .peekable();
        let mut judge = |seams: &mut Seams, ends: [u32; 2], base: Option<u32>, net: i32, expected: i32| {
            let beside = base.is_some_and(|base| {
                let root = seams.root(base);
                context.zero_area[base as usize] && seams.groups_at_rim.contains_key(&root)
            });
            if net == expected || beside || seams.allowed.binary_search(&ends).is_ok() {
                return;
            }
            let name = base.and_then(|base| context.name(base));
            if (net - expected) % 2 == 0 {
                findings.hit(FailureKind::MisorientedEdges, name, || {
                    context.describe_edge(ends, "is walked along in the same direction by two triangles")
                });
                return;
            }
            let what = if net == 0 { "is used from both sides, but the base mesh has its rim here" } else { "is open" };
            findings.hit(FailureKind::OpenEdges, name, || context.describe_edge(ends, what));
            suspects.push(ends);
        };
        // Both lists ascend.
        for edge in unbalanced {
            while let Some((ends, net)) = expected.next_if(|(ends, _)| *ends < edge.ends) {
                judge(self, ends, None, 0, net);
            }
            let net = expected.next_if(|(ends, _)| *ends == edge.ends).map_or(0, |(_, net)| net);
            if !edge.counted {
                judge(self, edge.ends, Some(edge.base), edge.net, net);
            }
        }
        for (ends, net) in expected {
            judge(self, ends, None, 0, net);
        }
    }
}

/// An edge by its lower and upper vertex, with `net` uses from `from` to `to`.
fn directed([from, to]: [u32; 2], net: i32) -> ([u32; 2], i32) {
    if from < to { ([from, to], net) } else { ([to, from], -net) }
}
