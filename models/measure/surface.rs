// SPDX-License-Identifier: MIT OR Apache-2.0
//! The distance of two surfaces, both ways, as Metro measures it (Cignoni, Rocchini, Scopigno 1998).
//!
//! Points are strewn over each surface, uniformly by area, and the distance of each from the other surface is taken:
//!
//! ```text
//! mean(A -> B) = sum d / n      rms = sqrt(sum d^2 / n)      max = greatest d, of the points and of A's vertices
//! both:  max is the greater one;  mean and squared rms are weighted by the two areas
//! ```
//!
//! Point `k` of `n` lies in the `k`-th of `n` equal parts of the area, taken triangle by triangle, at a random place. The
//! random numbers belong to the seed and to `k`, so the figures are the same on any number of cores.
//! The maximum is that of finitely many points: the true one is no less.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;
use serde::Serialize;

use super::MeasureError;
use super::nearest::Nearest;
use super::side::Side;
use crate::mesh::Progress;

/// Points of one task.
const CHUNK: usize = 1 << 12;
/// Points on a surface, at most.
const MOST_SAMPLES: f64 = 1e10;

/// How many points a surface gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// So many on each surface.
    Samples(u64),
    /// So many on a unit of area.
    PerArea(f64),
}

/// How points are strewn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// How many.
    pub amount: Amount,
    /// Which random numbers.
    pub seed: u64,
}

/// Distances of the points of one surface from the other.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OneWay {
    /// Triangles of the surface that the points lie on.
    pub triangles: usize,
    /// Its area.
    pub area: f64,
    /// Points on it.
    pub samples: u64,
    /// Points on a unit of area.
    pub density: f64,
    /// The greatest distance of a point or a vertex.
    pub max: f64,
    /// Where it is.
    pub max_at: [f64; 3],
    /// The mean distance of the points.
    pub mean: f64,
    /// The root of their mean squared distance.
    pub rms: f64,
}

/// Distances both ways together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Both {
    /// The greater of the two.
    pub max: f64,
    /// Weighted by the areas.
    pub mean: f64,
    /// From the mean square, weighted by the areas.
    pub rms: f64,
}

/// The distance of two surfaces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Surface {
    /// The seed of the points.
    pub seed: u64,
    /// From the mesh to what it is measured against.
    pub forward: OneWay,
    /// From there to the mesh.
    pub backward: OneWay,
    /// Both together.
    pub both: Both,
}

/// Measures the distance of two surfaces.
///
/// # Errors
/// A sentence: a surface has no area or unusable coordinates, or the number of points is out of range.
pub fn surface(
    mesh: Side<'_>,
    against: Side<'_>,
    sampling: Sampling,
    progress: &dyn Progress,
) -> Result<Surface, MeasureError> {
    mesh.examine()?;
    against.examine()?;
    // Different points on each surface, even if the two are one.
    let seeds = [mix(sampling.seed), mix(!sampling.seed)];
    let points = [Points::new(mesh, sampling.amount, seeds[0])?, Points::new(against, sampling.amount, seeds[1])?];
    let measure = |from: usize, to: Side<'_>, phase: &'static str| {
        let index = Nearest::new(to);
        progress.phase(phase, points[from].count + points[from].side.vertices() as u64);
        points[from].measure(&index, progress)
    };
    let forward = measure(0, against, "distances forward");
    let backward = measure(1, mesh, "distances backward");
    let weighted = |a: f64, b: f64| (a * forward.area + b * backward.area) / (forward.area + backward.area);
    let both = Both {
        max: forward.max.max(backward.max),
        mean: weighted(forward.mean, backward.mean),
        rms: weighted(forward.rms * forward.rms, backward.rms * backward.rms).sqrt(),
    };
    Ok(Surface { seed: sampling.seed, forward, backward, both })
}

/// The points of a surface.
struct Points<'a> {
    side: Side<'a>,
    /// Area of each triangle and those before it.
    areas: Vec<f64>,
    total: f64,
    count: u64,
    seed: u64,
}

/// Greatest distance and where, sum, sum of squares.
#[derive(Clone, Copy)]
struct Sums {
    max: f64,
    max_at: [f64; 3],
    sum: f64,
    squares: f64,
}

impl<'a> Points<'a> {
    fn new(side: Side<'a>, amount: Amount, seed: u64) -> Result<Points<'a>, MeasureError> {
        let mut total = 0.0;
        let add = |index: usize| {
            total += area(side.corners(index));
            total
        };
        let areas: Vec<f64> = (0..side.triangles()).map(add).collect();
        if total <= 0.0 {
            return Err(MeasureError::new("a surface has no area: all of its triangles are degenerate"));
        }
        let count = match amount {
            Amount::Samples(count) => count as f64,
            Amount::PerArea(density) => (density * total).ceil(),
        };
        if !(1.0..=MOST_SAMPLES).contains(&count) {
            let message =
                format!("{count} points on a surface of area {total} are asked for; 1 to {MOST_SAMPLES} can be");
            return Err(MeasureError::new(message));
        }
        Ok(Points { side, areas, total, count: count as u64, seed })
    }

    /// Point `index` of all.
    fn point(&self, index: u64) -> [f64; 3] {
        let random = |which: u64| unit(mix(self.seed.wrapping_add(mix(3 * index + which))));
        let place = (index as f64 + random(0)) / self.count as f64 * self.total;
        // Rounding may lead to the very end, and a triangle without area ends where it begins.
        let triangle = self.areas.partition_point(|end| *end <= place).min(self.areas.len() - 1);
        let [a, b, c] = self.side.corners(triangle);
        let (mut u, mut v) = (random(1), random(2));
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        [0, 1, 2].map(|axis| a[axis] + u * (b[axis] - a[axis]) + v * (c[axis] - a[axis]))
    }

    fn measure(&self, other: &Nearest<'_>, progress: &dyn Progress) -> OneWay {
        let done = AtomicU64::new(0);
        let advance = |count: u64| progress.advance(done.fetch_add(count, Ordering::Relaxed) + count);
        let inside = self.sums(self.count, other, &advance, |index| Some(self.point(index)));
        let used = self.used_vertices();
        let corners = self.sums(self.side.vertices() as u64, other, &advance, |index| {
            let index = index as usize;
            used.as_ref().is_none_or(|used| used[index]).then(|| self.side.vertex(index))
        });
        let most = if corners.max > inside.max { corners } else { inside };
        OneWay {
            triangles: self.areas.len(),
            area: self.total,
            samples: self.count,
            density: self.count as f64 / self.total,
            max: most.max,
            max_at: most.max_at,
            mean: inside.sum / self.count as f64,
            rms: (inside.squares / self.count as f64).sqrt(),
        }
    }

    /// Which vertices have a triangle; `None` if all have.
    fn used_vertices(&self) -> Option<Vec<bool>> {
        let Side::Mesh(mesh) = self.side else { return None };
        let mut used = vec![false; mesh.positions.len()];
        mesh.triangles.iter().flatten().for_each(|vertex| used[*vertex as usize] = true);
        Some(used)
    }

    /// Sums over `count` points, in an order that does not depend on the cores.
    fn sums(
        &self,
        count: u64,
        other: &Nearest<'_>,
        advance: &(impl Fn(u64) + Sync),
        point: impl Fn(u64) -> Option<[f64; 3]> + Sync,
    ) -> Sums {
        let none = Sums { max: -1.0, max_at: [0.0; 3], sum: 0.0, squares: 0.0 };
        let chunk = |chunk: u64| {
            let first = chunk * CHUNK as u64;
            let end = count.min(first + CHUNK as u64);
            let sums = (first..end).filter_map(&point).fold(none, |sums, point| {
                let distance = other.distance(point);
                let one = Sums { max: distance, max_at: point, sum: distance, squares: distance * distance };
                sums.and(one)
            });
            advance(end - first);
            sums
        };
        let parts: Vec<Sums> = (0..count.div_ceil(CHUNK as u64)).into_par_iter().map(chunk).collect();
        parts.into_iter().fold(none, Sums::and)
    }
}

impl Sums {
    fn and(self, next: Sums) -> Sums {
        let most = if next.max > self.max { next } else { self };
        Sums { sum: self.sum + next.sum, squares: self.squares + next.squares, ..most }
    }
}

fn area([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(glam::DVec3::from);
    (b - a).cross(c - a).length() / 2.0
}

/// From 0 to less than 1, from the upper 53 bits.
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 * f64::powi(2.0, -53)
}

/// The output function of SplitMix64 (Steele, Lea, Flood 2014): every input bit reaches every output bit.
fn mix(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
