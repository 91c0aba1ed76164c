// SPDX-License-Identifier: MIT OR Apache-2.0
//! The pass over edges: who uses each, and in which direction.
//!
//! Half-edges are dropped into one bucket for each lower vertex (a counting sort), and each bucket, of about three
//! edges, is sorted by the upper vertex. A half-edge is 8 bytes: upper vertex and number; the number gives triangle,
//! direction and base triangle, and ascends with the base triangle.

use rayon::prelude::*;

use super::check::{Context, has_repeated_vertex};
use super::report::{FailureKind, Findings};

/// An edge of a base triangle (with area) that only one of its triangles uses, in that triangle's direction.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct OpenInBase {
    pub(super) base: u32,
    pub(super) from: u32,
    pub(super) to: u32,
}

/// An edge that all triangles together use more often in one direction than in the other.
#[derive(Clone, Copy)]
pub(super) struct Unbalanced {
    /// Lower and upper vertex.
    pub(super) ends: [u32; 2],
    /// Uses from the lower to the upper vertex, less those the other way.
    pub(super) net: i32,
    /// A base triangle that uses it, one without area if there is any; 0 without bases.
    pub(super) base: u32,
    /// Whether the failure has been counted within a base triangle.
    pub(super) counted: bool,
}

#[derive(Default)]
pub(super) struct Edges {
    /// By lower, then upper vertex, then base triangle.
    pub(super) open_in_base: Vec<OpenInBase>,
    /// By lower, then upper vertex.
    pub(super) unbalanced: Vec<Unbalanced>,
    /// For each edge of a base triangle that does not have two triangles: 2 less their number.
    pub(super) irregular: Vec<(u32, i32)>,
}

pub(super) fn examine(context: &Context<'_>, findings: &mut Findings) -> Edges {
    let triangles = &context.mesh.triangles;
    context.progress.phase("sorting edges", triangles.len() as u64);
    let (mut half_edges, first) = bucket(triangles, context.mesh.points.len());
    context.progress.phase("edges", half_edges.len() as u64);
    // More tasks than cores, so that a core slowed down by others does not hold up the pass.
    let tasks = 16 * rayon::current_num_threads();
    let (mut rest, mut parts, mut vertex) = (&mut half_edges[..], Vec::with_capacity(tasks), 0);
    for task in 1..=tasks {
        let target = (first[first.len() - 1] as usize * task / tasks) as u32;
        let end = first.partition_point(|start| *start < target).max(vertex);
        let end = if task == tasks { first.len() - 1 } else { end };
        let (part, others) = rest.split_at_mut((first[end] - first[vertex]) as usize);
        parts.push((vertex..end, part));
        (rest, vertex) = (others, end);
    }
    let results: Vec<(Findings, Edges)> = parts
        .into_par_iter()
        .map(|(vertices, half_edges)| {
            context.advance(half_edges.len());
            examine_vertices(context, vertices, half_edges, &first)
        })
        .collect();
    let mut edges = Edges::default();
    for (found, mut part) in results {
        findings.append(found);
        edges.open_in_base.append(&mut part.open_in_base);
        edges.unbalanced.append(&mut part.unbalanced);
        edges.irregular.append(&mut part.irregular);
    }
    edges
}

/// Half-edges by lower vertex, `upper << 32 | 3 * triangle + side`, and where each lower vertex begins. Triangles with a
/// vertex twice are left out: their sides cancel, and they are reported elsewhere.
fn bucket(triangles: &[[u32; 3]], vertices: usize) -> (Vec<u64>, Vec<u32>) {
    let proper = || triangles.iter().enumerate().filter(|(_, triangle)| !has_repeated_vertex(triangle));
    let sides = |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)];
    let mut first = vec![0u32; vertices + 1];
    for (_, triangle) in proper() {
        for (a, b) in sides(*triangle) {
            first[a.min(b) as usize + 1] += 1;
        }
    }
    for vertex in 0..vertices {
        first[vertex + 1] += first[vertex];
    }
    let (mut next, mut half_edges) = (first.clone(), vec![0u64; first[vertices] as usize]);
    for (index, triangle) in proper() {
        for (side, (a, b)) in sides(*triangle).into_iter().enumerate() {
            let place = &mut next[a.min(b) as usize];
            // Readers refuse 2^32 / 3 triangles, so the number fits into the lower half.
            half_edges[*place as usize] = u64::from(a.max(b)) << 32 | (3 * index + side) as u64;
            *place += 1;
        }
    }
    (half_edges, first)
}

/// The uses of one edge by one base triangle (or by all triangles).
#[derive(Default)]
struct Uses {
    forward: u32,
    backward: u32,
}

fn examine_vertices(
    context: &Context<'_>,
    vertices: std::ops::Range<usize>,
    mut half_edges: &mut [u64],
    first: &[u32],
) -> (Findings, Edges) {
    let (mut findings, mut edges) = (Findings::default(), Edges::default());
    let mut thirds = Vec::new();
    let triangles = &context.mesh.triangles;
    for lower in vertices {
        let (bucket, others) = std::mem::take(&mut half_edges).split_at_mut((first[lower + 1] - first[lower]) as usize);
        half_edges = others;
        bucket.sort_unstable();
        for edge in bucket.chunk_by(|a, b| a >> 32 == b >> 32) {
            let ends = [lower as u32, (edge[0] >> 32) as u32];
            let base_of = |half_edge: &u64| context.base_of.get((*half_edge as u32 / 3) as usize).copied().unwrap_or(0);
            let mut unbalanced = Unbalanced { ends, net: 0, base: base_of(&edge[0]), counted: false };
            for part in edge.chunk_by(|a, b| base_of(a) == base_of(b)) {
                let mut uses = Uses::default();
                for half_edge in part {
                    let number = *half_edge as u32;
                    let from = triangles[(number / 3) as usize][(number % 3) as usize];
                    *(if from == ends[0] { &mut uses.forward } else { &mut uses.backward }) += 1;
                }
                let base = base_of(&part[0]);
                unbalanced.net += uses.forward as i32 - uses.backward as i32;
                if context.zero_area.get(base as usize).copied().unwrap_or(false) {
                    unbalanced.base = base;
                    continue;
                }
                if uses.forward + uses.backward != 2 {
                    edges.irregular.push((base, 2 - (uses.forward + uses.backward) as i32));
                }
                unbalanced.counted |= examine_uses(context, ends, base, &uses, &mut findings);
                if uses.forward + uses.backward == 1 && context.mesh.bases.is_some() {
                    let [from, to] = if uses.forward == 1 { ends } else { [ends[1], ends[0]] };
                    edges.open_in_base.push(OpenInBase { base, from, to });
                }
                if part.len() > 1 {
                    duplicates(context, ends, part, base, &mut thirds, &mut findings);
                }
            }
            // Without bases an edge of three triangles is no open edge, whatever its balance.
            if unbalanced.net != 0 && (context.mesh.bases.is_some() || edge.len() == 1) {
                edges.unbalanced.push(unbalanced);
            }
        }
    }
    (findings, edges)
}

/// Counts what is wrong with an edge by itself; whether anything is.
fn examine_uses(context: &Context<'_>, ends: [u32; 2], base: u32, uses: &Uses, findings: &mut Findings) -> bool {
    let number = uses.forward + uses.backward;
    let (kind, what) = match (number, uses.forward) {
        (0..=1, _) | (2, 1) => return false,
        (2, _) => (FailureKind::MisorientedEdges, "is walked along in the same direction by two triangles".to_owned()),
        _ => (FailureKind::NonmanifoldEdges, format!("is used by {number} triangles")),
    };
    findings.hit(kind, context.name(base), || context.describe_edge(ends, &what));
    true
}

/// Counts triangles on the same three vertices. Each is looked at from its lowest edge, where the third vertex is above.
fn duplicates(
    context: &Context<'_>,
    ends: [u32; 2],
    half_edges: &[u64],
    base: u32,
    thirds: &mut Vec<u32>,
    findings: &mut Findings,
) {
    thirds.clear();
    thirds.extend(half_edges.iter().filter_map(|half_edge| {
        let number = *half_edge as u32;
        let third = context.mesh.triangles[(number / 3) as usize][((number + 2) % 3) as usize];
        // (n + 2) mod 3 is the side before: 3 t + s keeps s modulo 3.
        (third > ends[1]).then_some(third)
    }));
    thirds.sort_unstable();
    for pair in thirds.windows(2).filter(|pair| pair[0] == pair[1]) {
        findings.hit(FailureKind::DuplicateTriangles, context.name(base), || {
            let corners = [ends[0], ends[1], pair[0]].map(|vertex| context.mesh.points.display(vertex));
            (format!("{} has been there before", corners.join(" ")), corners.to_vec())
        });
    }
}
