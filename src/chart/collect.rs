// SPDX-License-Identifier: MIT OR Apache-2.0
//! Runs every method at its goals on a map, and measures the meshes.

use relief_models::bake::Tolerance;
use relief_models::mesh::Progress;
use relief_testbench::method::{Engine, Goal, METHODS, Method, MethodError, Verdict};

use super::{Chapter, Figure, Kind, Point, Subject, silhouettes};

/// Shares of the range that every method is asked for besides its own goals, in percent: what the page compares.
pub const TOLERANCES: [u32; 2] = [1, 2];

/// The chapter of a map, with the points of our methods.
pub fn collect(subject: Subject, count: usize, engine: Engine, progress: &dyn Progress) -> Chapter {
    let (silhouettes, notes) = match silhouettes::of(&subject, progress) {
        Ok(silhouettes) => (silhouettes, Vec::new()),
        Err(error) => (Vec::new(), vec![format!("horizons under filters: {error}")]),
    };
    let mut chapter = Chapter { subject, points: Vec::new(), silhouettes, notes, failures: Vec::new() };
    for method in METHODS {
        let begun = chapter.points.len();
        for goal in goals(*method, &chapter.subject, count) {
            let text = describe(goal);
            match point(*method, goal, &chapter.subject, engine, progress) {
                Ok(point) => {
                    if point.verdict == Verdict::Broken {
                        let error = format!("max {}, claim {:?}", point.heights.max, point.claim);
                        chapter.failures.push(format!("{} at {text}: {} ({error})", method.name(), point.standing()));
                    }
                    chapter.points.push(point);
                }
                Err(error) => {
                    let sentence = format!("{} at {text}: {error}", method.name());
                    let list = if error.is_mismatch() { &mut chapter.failures } else { &mut chapter.notes };
                    list.push(sentence);
                }
            }
        }
        chapter.points[begun..].sort_by_key(|point| point.heights.triangles);
    }
    chapter
}

/// The goals of a method, and the tolerances that all are compared at; each once.
fn goals(method: &dyn Method, subject: &Subject, count: usize) -> Vec<Goal> {
    let mut goals = method.goals(&subject.map, count);
    goals.extend(tolerances(subject).map(Goal::Bound));
    let mut once: Vec<Goal> = Vec::new();
    goals.into_iter().for_each(|goal| {
        if !once.contains(&goal) {
            once.push(goal);
        }
    });
    once
}

fn tolerances(subject: &Subject) -> impl Iterator<Item = Tolerance> {
    let range = u32::from(subject.range());
    TOLERANCES.into_iter().filter_map(move |percent| Tolerance::new(percent * range, 100))
}

/// The bounds that any method is asked for, from coarse to fine: the goals of the peers.
pub fn bounds(subject: &Subject, count: usize) -> Vec<Tolerance> {
    let value = |bound: &Tolerance| bound.value();
    let mut bounds: Vec<Tolerance> = Vec::new();
    for goal in METHODS.iter().flat_map(|method| goals(*method, subject, count)) {
        if let Goal::Bound(bound) = goal
            && !bounds.contains(&bound)
        {
            bounds.push(bound);
        }
    }
    bounds.sort_by(|a, b| value(b).total_cmp(&value(a)));
    bounds
}

/// What is asked for, in words.
pub fn describe(goal: Goal) -> String {
    match goal {
        Goal::Bound(bound) => format!("bound {}", bound.value()),
        Goal::Triangles(most) => format!("triangles {most}"),
    }
}

fn point(
    method: &dyn Method,
    goal: Goal,
    subject: &Subject,
    engine: Engine,
    progress: &dyn Progress,
) -> Result<Point, MethodError> {
    let engine = if method.has_hardware() { engine } else { Engine::Golden };
    let made = method.tessellate(&subject.map, goal, engine, progress)?;
    let measured = made.measure(&subject.map, progress)?;
    Ok(Point {
        method: method.name().into(),
        kind: Kind::Ours,
        version: env!("CARGO_PKG_VERSION").into(),
        goal: describe(goal),
        heights: measured.heights,
        claim: made.claim,
        verdict: measured.verdict,
        hardware: made.hardware,
        preparation_seconds: made.preparation_seconds,
        golden_seconds: made.golden_seconds,
        cache_misses: measured.cache_misses,
        fronts: [false; Figure::ALL.len()],
    })
}
