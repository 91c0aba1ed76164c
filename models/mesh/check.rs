// SPDX-License-Identifier: MIT OR Apache-2.0
//! The checker: its options, the passes in their order, and the report.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::exact::{self, Distance, Scaled};
use super::points::Points;
use super::report::{FailureKind, Findings, Report};
use super::{Bases, Mesh, Progress, edges, rims, t_vertices, triangles};

/// How far a vertex may be from where its base triangle wants it: a length in the object's unit, and the same number as
/// a fraction of an area. A fraction of integers, so that comparing with it is exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tolerance {
    numerator: u64,
    denominator: u64,
}

impl Tolerance {
    /// `numerator / denominator`; `None` if the denominator is 0.
    pub const fn new(numerator: u64, denominator: u64) -> Option<Tolerance> {
        if denominator == 0 { None } else { Some(Tolerance { numerator, denominator }) }
    }

    pub(super) const fn numerator(&self) -> u64 {
        self.numerator
    }

    pub(super) const fn denominator(&self) -> u64 {
        self.denominator
    }
}

impl std::str::FromStr for Tolerance {
    type Err = String;

    /// A fraction such as `1/64`, or a decimal such as `0.001`.
    fn from_str(text: &str) -> Result<Tolerance, String> {
        let wrong =
            || format!("`{text}` is not a tolerance; a fraction such as 1/64 or a decimal such as 0.001 is expected");
        let (numerator, denominator) = match text.split_once('/') {
            Some((numerator, denominator)) => (numerator.parse().ok(), denominator.parse().ok()),
            None => {
                let number = Scaled::from_decimal(text.as_bytes()).map_err(|_| wrong())?;
                let power = 10u64.checked_pow(number.exponent.unsigned_abs().into());
                let mantissa = u64::try_from(number.mantissa).ok();
                if number.exponent >= 0 {
                    (mantissa.zip(power).and_then(|(mantissa, power)| mantissa.checked_mul(power)), Some(1))
                } else {
                    (mantissa, power)
                }
            }
        };
        numerator.zip(denominator).and_then(|(a, b)| Tolerance::new(a, b)).ok_or_else(wrong)
    }
}

/// What [`check`] is asked for.
#[derive(Clone, Copy, Debug)]
pub struct CheckOptions {
    /// Allowance for rim vertices, planes and areas; 1/64 unless told.
    pub tolerance: Tolerance,
    /// Whether every open edge is a failure. Without it a mesh without base triangles may be open, and one with base
    /// triangles has the rim of its base mesh.
    pub closed: bool,
}

impl Default for CheckOptions {
    fn default() -> CheckOptions {
        CheckOptions { tolerance: Tolerance { numerator: 1, denominator: 64 }, closed: false }
    }
}

/// What every pass needs.
pub(super) struct Context<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) options: &'a CheckOptions,
    pub(super) progress: &'a dyn Progress,
    done: AtomicU64,
    /// The tolerance in lattice steps.
    pub(super) steps: Distance,
    /// The base triangle of each triangle; empty without bases.
    pub(super) base_of: Vec<u32>,
    /// Which base triangles have no area.
    pub(super) zero_area: Vec<bool>,
    /// Distinct vertices that the triangles of each base triangle use.
    pub(super) vertices_of_base: Vec<u32>,
}

impl Context<'_> {
    /// Reports progress of the current phase from any task.
    pub(super) fn advance(&self, steps: usize) {
        let done = self.done.fetch_add(steps as u64, Ordering::Relaxed) + steps as u64;
        self.progress.advance(done);
    }

    /// The file's number of a base triangle.
    pub(super) fn name(&self, base: u32) -> Option<u32> {
        self.mesh.bases.as_ref().map(|bases| bases.names[base as usize])
    }

    pub(super) fn describe_edge(&self, ends: [u32; 2], what: &str) -> (String, Vec<String>) {
        let ends = ends.map(|vertex| self.mesh.points.display(vertex));
        (format!("{} - {} {what}", ends[0], ends[1]), ends.to_vec())
    }
}

/// Checks a mesh, against its base triangles if it has any, and otherwise by itself.
///
/// With base triangles: every base triangle (with area) is tiled by its triangles, all of them the right way up; base
/// triangles that share an edge have the same vertices on it; no edge is open but on the rim of the base mesh. Without:
/// no edge has more than two triangles or two in the same direction, no vertex lies inside an open edge, no triangle is
/// degenerate or there twice; open edges are counted, and are failures if [`CheckOptions::closed`] says so.
pub fn check(mesh: &Mesh, options: &CheckOptions, progress: &dyn Progress) -> Report {
    let bases = mesh.bases.as_ref();
    let zero_area: Vec<bool> = bases.map_or_else(Vec::new, |bases| {
        bases.corners.par_iter().map(|corners| exact::is_zero(&mesh.points.normal(*corners))).collect()
    });
    let (vertices, vertices_of_base) = count_vertices(mesh);
    let mut context = Context {
        mesh,
        options,
        progress,
        done: AtomicU64::new(0),
        steps: mesh.points.in_steps(options.tolerance.numerator, options.tolerance.denominator),
        base_of: bases.map_or_else(Vec::new, base_of),
        zero_area,
        vertices_of_base,
    };
    let mut findings = Findings::default();
    let sums = triangles::examine(&context, &mut findings);
    context.done = AtomicU64::new(0);
    let edges = edges::examine(&context, &mut findings);
    let boundary: Vec<[u32; 2]> = edges
        .unbalanced
        .iter()
        .flat_map(|edge| {
            let [lower, upper] = edge.ends;
            let directed = if edge.net > 0 { [lower, upper] } else { [upper, lower] };
            std::iter::repeat_n(directed, edge.net.unsigned_abs() as usize)
        })
        .collect();
    context.done = AtomicU64::new(0);
    let (mut t_vertices, suspects, shared) = match bases {
        Some(_) => {
            let rims = rims::examine(&context, edges, &sums.repeated, &mut findings);
            (rims.t_vertices, rims.suspects, rims.shared)
        }
        None => {
            if options.closed {
                for edge in &edges.unbalanced {
                    let describe = || context.describe_edge(edge.ends, "is used by one triangle only");
                    findings.hit(FailureKind::OpenEdges, None, describe);
                }
            }
            (Vec::new(), boundary.clone(), 0)
        }
    };
    progress.phase("T-vertices", suspects.len() as u64);
    t_vertices.extend(t_vertices::find(&mesh.points, &suspects));
    t_vertices.sort_by_key(|(vertex, _)| *vertex);
    t_vertices.dedup_by_key(|(vertex, _)| *vertex);
    for (vertex, edge) in t_vertices {
        findings.hit(FailureKind::TVertices, None, || describe_t_vertex(&mesh.points, vertex, edge));
    }
    let (counts, failures) = findings.into_parts();
    Report {
        ok: counts.values().all(|count| *count == 0),
        base_triangles: bases.map(|bases| bases.names.len() as u64),
        zero_area_base_triangles: context.zero_area.iter().filter(|zero| **zero).count() as u64,
        triangles: mesh.triangles.len() as u64,
        vertices,
        shared_base_edges: shared,
        boundary_edges: boundary.len() as u64,
        boundary_loops: loops(boundary),
        counts,
        failures,
    }
}

fn describe_t_vertex(points: &Points, vertex: u32, edge: [u32; 2]) -> (String, Vec<String>) {
    let [vertex, from, to] = [vertex, edge[0], edge[1]].map(|vertex| points.display(vertex));
    (format!("{vertex} lies inside the edge {from} - {to}"), vec![vertex, from, to])
}

fn base_of(bases: &Bases) -> Vec<u32> {
    let mut base_of = Vec::with_capacity(bases.first.last().copied().unwrap_or(0) as usize);
    for (base, end) in bases.first.iter().skip(1).enumerate() {
        base_of.resize(*end as usize, base as u32);
    }
    base_of
}

/// Whether a triangle is one in name only.
#[inline]
pub(super) fn has_repeated_vertex([a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}

/// The number of vertices that triangles use, and that of each base triangle.
fn count_vertices(mesh: &Mesh) -> (u64, Vec<u32>) {
    const NEVER: u32 = u32::MAX;
    let mut last_user = vec![NEVER; mesh.points.len()];
    let (whole, mut total) = ([0, mesh.triangles.len() as u32], 0);
    let ranges: &[u32] = mesh.bases.as_ref().map_or(&whole, |bases| &bases.first);
    let mut counts = Vec::with_capacity(ranges.len());
    for (base, range) in ranges.windows(2).enumerate() {
        let mut count = 0;
        let triangles = &mesh.triangles[range[0] as usize..range[1] as usize];
        for vertex in triangles.iter().filter(|triangle| !has_repeated_vertex(triangle)).flatten() {
            let last = &mut last_user[*vertex as usize];
            total += u64::from(*last == NEVER);
            count += u32::from(*last != base as u32);
            *last = base as u32;
        }
        counts.push(count);
    }
    (total, counts)
}

/// Number of closed walks that directed edges fall into, going on as long as there is an edge to go on by.
fn loops(mut edges: Vec<[u32; 2]>) -> u64 {
    edges.par_sort_unstable();
    let first_from = |vertex: u32| edges.partition_point(|edge| edge[0] < vertex);
    // Edges that have been walked along, counted at the first edge of each vertex.
    let mut walked = vec![0usize; edges.len()];
    let mut number = 0;
    for start in 0..edges.len() {
        let first = first_from(edges[start][0]);
        if start - first < walked[first] {
            continue;
        }
        number += 1;
        let mut vertex = edges[start][0];
        loop {
            let first = first_from(vertex);
            let Some(edge) = walked.get(first).and_then(|done| edges.get(first + done)) else { break };
            if edge[0] != vertex {
                break;
            }
            walked[first] += 1;
            vertex = edge[1];
        }
    }
    number
}
