// SPDX-License-Identifier: MIT OR Apache-2.0
//! The pass over triangles: area, orientation and plane of each, and the sum of areas in each base triangle.

use std::cmp::Ordering;

use rayon::prelude::*;

use super::check::{Context, has_repeated_vertex};
use super::exact::{Int, Vector, dot, sign_of_dot, sum};
use super::report::{FailureKind, Findings};

/// Triangles that one task looks at.
const CHUNK: usize = 1 << 14;

/// Part of a base triangle's sums.
struct Partial {
    base: usize,
    normals: Vector,
    /// Triangles with a vertex twice.
    repeated: u32,
}

/// What the pass knows of each base triangle.
pub(super) struct Sums {
    /// Number of triangles with a vertex twice in each base triangle that has any: (base, number).
    pub(super) repeated: Vec<(u32, u32)>,
}

pub(super) fn examine(context: &Context<'_>, findings: &mut Findings) -> Sums {
    let triangles = &context.mesh.triangles;
    let chunks = triangles.len().div_ceil(CHUNK);
    context.progress.phase("triangles", triangles.len() as u64);
    let results: Vec<(Findings, Vec<Partial>)> = (0..chunks)
        .into_par_iter()
        .map(|chunk| {
            let range = chunk * CHUNK..triangles.len().min((chunk + 1) * CHUNK);
            context.advance(range.len());
            examine_range(context, range)
        })
        .collect();
    let mut sums = Sums { repeated: Vec::new() };
    let mut total: Option<Partial> = None;
    for (found, partials) in results {
        findings.append(found);
        for partial in partials {
            match &mut total {
                Some(total) if total.base == partial.base => {
                    total.normals = self::sum(&total.normals, &partial.normals);
                    total.repeated += partial.repeated;
                }
                _ => {
                    if let Some(done) = total.replace(partial) {
                        finish(context, &done, &mut sums, findings);
                    }
                }
            }
        }
    }
    if let Some(done) = total {
        finish(context, &done, &mut sums, findings);
    }
    sums
}

/// What the triangles of one base triangle are compared with.
struct Reference {
    base: usize,
    corner: u32,
    normal: Vector,
    has_area: bool,
}

fn examine_range(context: &Context<'_>, range: std::ops::Range<usize>) -> (Findings, Vec<Partial>) {
    let (mut findings, mut partials) = (Findings::default(), Vec::<Partial>::new());
    let points = &context.mesh.points;
    let mut reference: Option<Reference> = None;
    for index in range {
        let triangle = context.mesh.triangles[index];
        let describe = |what: &str| {
            let corners = triangle.map(|vertex| points.display(vertex));
            (format!("{} {what}", corners.join(" ")), corners.to_vec())
        };
        let normal = points.normal(triangle);
        let Some(bases) = &context.mesh.bases else {
            if super::exact::is_zero(&normal) {
                findings.hit(FailureKind::DegenerateTriangles, None, || describe("has no area"));
            }
            continue;
        };
        let base = context.base_of[index] as usize;
        let reference = match &mut reference {
            Some(reference) if reference.base == base => reference,
            other => {
                let corners = bases.corners[base];
                let normal = points.normal(corners);
                partials.push(Partial { base, normals: [Int::ZERO, Int::ZERO, Int::ZERO], repeated: 0 });
                other.insert(Reference { base, corner: corners[0], normal, has_area: !context.zero_area[base] })
            }
        };
        let Some(partial) = partials.last_mut() else { continue };
        partial.repeated += u32::from(has_repeated_vertex(&triangle));
        if !reference.has_area {
            continue;
        }
        let name = Some(bases.names[base]);
        if super::exact::is_zero(&normal) {
            findings.hit(FailureKind::DegenerateTriangles, name, || describe("has no area"));
        } else {
            match sign_of_dot(&normal, &reference.normal) {
                Ordering::Greater => {}
                Ordering::Less => {
                    findings.hit(FailureKind::FlippedTriangles, name, || describe("faces away from its base triangle"));
                }
                Ordering::Equal => {
                    let what = "stands upright on its base triangle, and has no area there";
                    findings.hit(FailureKind::DegenerateTriangles, name, || describe(what));
                }
            }
            partial.normals = self::sum(&partial.normals, &normal);
        }
        for vertex in triangle {
            // |height . N| / |N| is the distance from the plane: project it, N N.height / N.N, without the division.
            let height = dot(&points.difference(reference.corner, vertex), &reference.normal);
            if !height.is_zero() && !context.steps.covers(&[height, Int::ZERO, Int::ZERO], &reference.normal) {
                findings.hit(FailureKind::OffPlaneCorners, name, || {
                    let vertex = points.display(vertex);
                    (format!("{vertex} is off the plane of its base triangle"), vec![vertex])
                });
            }
        }
    }
    (findings, partials)
}

/// Compares the areas of a base triangle with its own. With `N` the normal of the base triangle, the sum of the signed
/// areas over the area is `sum(normals) . N / N . N`.
fn finish(context: &Context<'_>, total: &Partial, sums: &mut Sums, findings: &mut Findings) {
    let Some(bases) = &context.mesh.bases else { return };
    if total.repeated > 0 {
        sums.repeated.push((total.base as u32, total.repeated));
    }
    if context.zero_area[total.base] {
        return;
    }
    let normal = context.mesh.points.normal(bases.corners[total.base]);
    let (area, expected) = (dot(&total.normals, &normal), dot(&normal, &normal));
    let difference = if area > expected { &area - &expected } else { &expected - &area };
    let tolerance = &context.options.tolerance;
    if &difference * &Int::from(tolerance.denominator()) > &expected * &Int::from(tolerance.numerator()) {
        findings.hit(FailureKind::WrongAreas, Some(bases.names[total.base]), || {
            let ratio = match (area.approximate(), expected.approximate()) {
                (Some(area), Some(expected)) => format!("{:.9} times its own", area / expected),
                _ => "another".to_owned(),
            };
            (format!("the areas of its triangles add up to {ratio} area"), Vec::new())
        });
    }
}
