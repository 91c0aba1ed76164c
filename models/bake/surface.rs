// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact errors of a triangle of the lattice: over every sample of the closed, clamped triangle.
//!
//! Where no corner is clamped, the plane's slopes are multiples of 2^-level: A of the formula is replaced by 2^level, and a
//! row of samples is a start and a step. A clamped triangle may have any slopes; it takes two divisions a row and edge.

use super::Tolerance;
use crate::bisector::{Lattice, Node};

/// An error in map units, as a fraction.
#[derive(Clone, Copy, Debug)]
pub struct Excess {
    /// Numerator, at least 0.
    pub over: i64,
    /// Denominator, at least 1.
    pub under: i64,
}

impl Excess {
    /// No error.
    pub const NONE: Excess = Excess { over: 0, under: 1 };

    /// The larger of two errors.
    #[inline]
    pub fn max(self, other: Excess) -> Excess {
        let less = i128::from(self.over) * i128::from(other.under) < i128::from(other.over) * i128::from(self.under);
        if less { other } else { self }
    }
    /// In units of 2^-`fraction` of a map unit, rounded up.
    #[inline]
    pub fn ceil(self, fraction: u32) -> i64 {
        // over < 2^45, fraction <= 8
        ((self.over << fraction) + self.under - 1) / self.under
    }
    /// Whether it keeps a bound.
    #[inline]
    pub fn is_within(self, tolerance: Tolerance) -> bool {
        // Below 2^45 times 10^4 on the left, below 2^30 times 2^29 on the right.
        self.over * i64::from(tolerance.under()) <= i64::from(tolerance.over()) * self.under
    }
    /// For people.
    pub fn to_f64(self) -> f64 {
        self.over as f64 / self.under as f64
    }
}

/// A map and its lattice.
#[derive(Clone, Copy, Debug)]
pub struct Ground<'a> {
    /// The lattice of the map's size.
    pub lattice: Lattice,
    /// Samples, row by row.
    pub samples: &'a [u16],
}

/// A plane over samples: `start` at a point, and its growth a column and a row.
struct Plane {
    at: [i32; 2],
    start: i64,
    slope: [i64; 2],
}

impl Ground<'_> {
    /// The number of the sample at a lattice vertex.
    #[inline]
    pub fn sample_index(&self, vertex: [u32; 2]) -> usize {
        let [x, y] = self.lattice.clamp(vertex);
        y as usize * self.lattice.width as usize + x as usize
    }
    /// Whether a corner lies outside the map.
    #[inline]
    pub fn is_clamped(&self, corners: &[[u32; 2]; 3]) -> bool {
        corners.iter().any(|&[u, v]| u >= self.lattice.width || v >= self.lattice.height)
    }
    /// The largest error of a triangle, `height` giving the heights of its corners by the numbers of their samples.
    #[inline]
    pub fn excess(&self, node: Node, height: impl Fn(usize) -> i32) -> Excess {
        let corners = node.corners();
        let heights = corners.map(|corner| i64::from(height(self.sample_index(corner))));
        if self.is_clamped(&corners) {
            return self.clamped_excess(corners.map(|corner| self.lattice.clamp(corner)), heights);
        }
        let level = node.level;
        let corners = corners.map(|corner| corner.map(|at| at as i32));
        let over = if node.reversed() {
            self.axis_excess(level, corners, heights)
        } else {
            self.diagonal_excess(level, corners, heights)
        };
        Excess { over, under: 16 << level }
    }

    /// Legs along the axes, 2^level long.
    #[inline]
    fn diagonal_excess(&self, level: u32, [a, b, c]: [[i32; 2]; 3], [ha, hb, hc]: [i64; 3]) -> i64 {
        let ((beside, h_beside), (above, h_above)) = if a[1] == c[1] { ((a, ha), (b, hb)) } else { ((b, hb), (a, ha)) };
        let way = [(beside[0] - c[0]).signum(), (above[1] - c[1]).signum()];
        let slope = [(h_beside - hc) * i64::from(way[0]), (h_above - hc) * i64::from(way[1])];
        let plane = Plane { at: c, start: hc << level, slope };
        let side = 1 << level;
        let mut worst = 0;
        for j in 0..=side {
            let left = if way[0] > 0 { c[0] } else { c[0] - (side - j) };
            worst = worst.max(self.row(level, &plane, c[1] + way[1] * j, left, side - j));
        }
        worst
    }

    /// The hypotenuse along an axis, 2^level long.
    #[inline]
    fn axis_excess(&self, level: u32, [a, b, c]: [[i32; 2]; 3], [ha, hb, hc]: [i64; 3]) -> i64 {
        let middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
        let half = 1i32 << (level - 1);
        let along = hb - ha;
        let across = 2 * hc - ha - hb;
        let start = (ha + hb) << (level - 1);
        let mut worst = 0;
        if a[0] == b[0] {
            let way = (c[0] - middle[0]).signum();
            let slope = [across * i64::from(way), along * i64::from((b[1] - a[1]).signum())];
            let plane = Plane { at: middle, start, slope };
            for j in -half..=half {
                let length = half - j.abs();
                let left = if way > 0 { middle[0] } else { middle[0] - length };
                worst = worst.max(self.row(level, &plane, middle[1] + j, left, length));
            }
        } else {
            let way = (c[1] - middle[1]).signum();
            let slope = [along * i64::from((b[0] - a[0]).signum()), across * i64::from(way)];
            let plane = Plane { at: middle, start, slope };
            for j in 0..=half {
                let left = middle[0] - (half - j);
                worst = worst.max(self.row(level, &plane, middle[1] + way * j, left, 2 * (half - j)));
            }
        }
        worst
    }

    /// The largest deviation over `length + 1` samples, times 16 * 2^level.
    #[inline]
    fn row(&self, level: u32, plane: &Plane, y: i32, left: i32, length: i32) -> i64 {
        let first = y as usize * self.lattice.width as usize + left as usize;
        let samples = &self.samples[first..=first + length as usize];
        let [dx, dy] = [i64::from(left - plane.at[0]), i64::from(y - plane.at[1])];
        let mut value = plane.start + dx * plane.slope[0] + dy * plane.slope[1];
        if level > 10 {
            let mut worst = 0;
            for &sample in samples {
                worst = worst.max((value - (i64::from(sample) << (4 + level))).abs());
                value += plane.slope[0];
            }
            return worst;
        }
        // Values are between 0 and 2^20 2^level <= 2^30: their differences fit in 32 bits.
        let (mut value, slope) = (value as i32, plane.slope[0] as i32);
        let mut worst = 0i32;
        for &sample in samples {
            worst = worst.max((value - (i32::from(sample) << (4 + level))).abs());
            value = value.wrapping_add(slope);
        }
        i64::from(worst)
    }

    /// Any triangle.
    fn clamped_excess(&self, corners: [[u32; 2]; 3], heights: [i64; 3]) -> Excess {
        let mut worst = 0;
        let area = each_row(corners, |y, first, last, weights, steps| {
            let area = weights.iter().sum::<i64>();
            let mut value: i64 = (0..3).map(|i| weights[i] * heights[i]).sum();
            let step: i64 = (0..3).map(|i| steps[i] * heights[i]).sum();
            for x in first..=last {
                let sample = self.samples[y as usize * self.lattice.width as usize + x as usize];
                worst = worst.max((value - 16 * area * i64::from(sample)).abs());
                value += step;
            }
        });
        if area == 0 { Excess::NONE } else { Excess { over: worst, under: 16 * area } }
    }
}

/// The rows of a closed triangle that turns from u to v: y, first and last x, the weights of the corners at the first one
/// and their growth. They add up to twice the area, which is returned; a triangle without area has no rows.
pub(super) fn each_row(corners: [[u32; 2]; 3], mut row: impl FnMut(i64, i64, i64, [i64; 3], [i64; 3])) -> i64 {
    let [a, b, c] = corners.map(|corner| corner.map(i64::from));
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if area == 0 {
        return 0;
    }
    let edges = [(b, c), (c, a), (a, b)];
    let steps = edges.map(|(from, to)| from[1] - to[1]);
    let [low, high] = [a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1])];
    for y in low..=high {
        let (mut first, mut last) = (a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0]));
        let origin = first;
        let at_origin =
            edges.map(|(from, to)| (to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (origin - from[0]));
        for (&weight, step) in at_origin.iter().zip(steps) {
            // weight + (x - origin) step >= 0
            if step > 0 {
                first = first.max(origin - weight.div_euclid(step));
            } else if step < 0 {
                last = last.min(origin + weight.div_euclid(-step));
            } else if weight < 0 {
                last = first - 1;
            }
        }
        if first <= last {
            let weights: [i64; 3] = std::array::from_fn(|i| at_origin[i] + (first - origin) * steps[i]);
            row(y, first, last, weights, steps);
        }
    }
    area
}
