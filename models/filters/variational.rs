// SPDX-License-Identifier: MIT OR Apache-2.0
//! Levels with the least volume between them and the map (Gumhold & Huettner 1999, equation 12, which has an epsilon where the
//! sign changes; here the integral is exact).
//!
//! ```text
//! V = sum over texel triangles of the integral of |g - f|        f: the map, g: the level, both linear on triangles
//! corner residuals a, b, c:   all of one sign: |a + b + c| / 3   times the area, 1/2
//!                             a of the other one: sign(a) (2 T - (a + b + c)) / 3,   T = a^3 / ((a - b) (a - c))
//! ```
//!
//! Cells are cut along the diagonal from their first corner, texel cells and level cells alike, so g - f is linear on
//! every texel triangle. The derivative by a node's height is the sum of those by residuals, weighted with its hat function.
//!
//! Heights stay within the texels that their hat covers: at the border of the map a node outside of it would otherwise
//! leave the relief by up to 42 %.

use super::fill;
use crate::map::HeightMap;
use crate::mip_build::{Centring, Level, Wrap, side_above};

/// Rounds of weighted medians.
const ROUNDS: usize = 3;
/// Steps down the gradient.
const STEPS: usize = 150;
/// The first of them, as a share of the relief.
const FIRST_SHARE: f64 = 0.01;

/// A level over its map.
struct Dyadic<'a> {
    map: &'a HeightMap,
    wrap: [Wrap; 2],
    /// Texels from node to node.
    step: usize,
    /// Nodes on each axis.
    nodes: [usize; 2],
}

impl<'a> Dyadic<'a> {
    fn new(map: &'a HeightMap, wrap: [Wrap; 2], level: usize) -> Self {
        let above =
            |axis: usize, side: usize| (0..level).fold(side, |side, _| side_above(side, Centring::Node, wrap[axis]));
        Self { map, wrap, step: 1 << level, nodes: [above(0, map.width), above(1, map.height)] }
    }

    fn count(&self) -> usize {
        self.nodes[0] * self.nodes[1]
    }

    /// The three nodes round a texel, and their weights in units of 1 / step, which sum to `step`.
    fn weights(&self, x: usize, y: usize) -> [(usize, i64); 3] {
        let step = self.step;
        let ([i, a], [j, b]) = ([x / step, x % step], [y / step, y % step]);
        // Where the weight is 0 there may be no next node.
        let next = |axis: usize, at: usize| match self.wrap[axis] {
            Wrap::Clamp => (at + 1).min(self.nodes[axis] - 1),
            Wrap::Repeat => (at + 1) % self.nodes[axis],
        };
        let node = |i: usize, j: usize| j * self.nodes[0] + i;
        let (middle, most) = if a >= b { (node(next(0, i), j), a) } else { (node(i, next(1, j)), b) };
        let least = a.min(b);
        [
            (node(i, j), (step - most) as i64),
            (middle, (most - least) as i64),
            (node(next(0, i), next(1, j)), least as i64),
        ]
    }

    /// All texels that the hat of a node covers, and its weight there, above 0.
    fn support(&self, node: usize) -> Vec<(usize, usize, i64)> {
        let step = self.step as isize;
        let [i, j] = [node % self.nodes[0], node / self.nodes[0]].map(|at| at as isize * step);
        let sides = [self.map.width, self.map.height];
        let place = |axis: usize, at: isize| match self.wrap[axis] {
            Wrap::Clamp => (0..sides[axis] as isize).contains(&at).then_some(at as usize),
            Wrap::Repeat => Some(at.rem_euclid(sides[axis] as isize) as usize),
        };
        let mut all = Vec::new();
        for (dy, y) in (1 - step..step).filter_map(|dy| place(1, j + dy).map(|y| (dy, y))) {
            for (dx, x) in (1 - step..step).filter_map(|dx| place(0, i + dx).map(|x| (dx, x))) {
                // The hexagon of the cut cells.
                let weight = step - dx.max(dy).max(0) + dx.min(dy).min(0);
                if weight > 0 {
                    all.push((x, y, weight as i64));
                }
            }
        }
        all
    }

    /// The weighted mean of each node's texels, and the least and the greatest of them.
    fn start(&self) -> Vec<(i64, [i64; 2])> {
        let of_node = |node| {
            let (mut sum, mut weights, mut range) = (0, 0, [i64::MAX, i64::MIN]);
            for (x, y, weight) in self.support(node) {
                let texel = i64::from(self.map.sample(x, y));
                sum += weight * texel;
                weights += weight;
                range = [range[0].min(texel), range[1].max(texel)];
            }
            // Each covers a texel: the last node stands less than a step behind the last one.
            ((2 * sum + weights).div_euclid(2 * weights), range)
        };
        (0..self.count()).map(of_node).collect()
    }

    /// Volume, and its derivative by each node's height.
    fn volume(&self, heights: &[f64]) -> (f64, Vec<f64>) {
        let HeightMap { width, height, .. } = *self.map;
        let scale = 1.0 / self.step as f64;
        let mut residuals = Vec::with_capacity(width * height);
        for y in 0..height {
            for x in 0..width {
                let level: f64 = self.weights(x, y).iter().map(|&(node, weight)| heights[node] * weight as f64).sum();
                residuals.push(level * scale - f64::from(self.map.sample(x, y)));
            }
        }
        let cells = |axis: usize, side: usize| side - usize::from(self.wrap[axis] == Wrap::Clamp);
        let mut volume = 0.0;
        let mut by_texel = vec![0.0; residuals.len()];
        for y in 0..cells(1, height) {
            let rows = [y, (y + 1) % height].map(|row| row * width);
            for x in 0..cells(0, width) {
                let columns = [x, (x + 1) % width];
                let [first, right, below, last] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| rows[j] + columns[i]);
                for corners in [[first, right, last], [first, below, last]] {
                    let (mean, by_corner) = absolute(corners.map(|at| residuals[at]));
                    volume += mean / 2.0;
                    for (at, derivative) in corners.into_iter().zip(by_corner) {
                        by_texel[at] += derivative / 2.0;
                    }
                }
            }
        }
        let mut by_node = vec![0.0; heights.len()];
        for (at, derivative) in by_texel.into_iter().enumerate() {
            for (node, weight) in self.weights(at % width, at / width) {
                by_node[node] += derivative * weight as f64 * scale;
            }
        }
        (volume, by_node)
    }

    /// The weighted median of what each texel of a node would have it be.
    fn median(&self, heights: &[i64], node: usize) -> i64 {
        let mut wishes: Vec<(i64, i64)> = Vec::new();
        for (x, y, weight) in self.support(node) {
            let level: i64 = self.weights(x, y).iter().map(|&(node, weight)| heights[node] * weight).sum();
            let residual = level - self.step as i64 * i64::from(self.map.sample(x, y));
            wishes.push((heights[node] - (2 * residual + weight).div_euclid(2 * weight), weight));
        }
        wishes.sort_unstable();
        let half = wishes.iter().map(|(_, weight)| weight).sum::<i64>();
        let mut sum = 0;
        let middle = wishes.iter().find(|(_, weight)| {
            sum += 2 * weight;
            sum >= half
        });
        middle.map_or(heights[node], |(wish, _)| *wish)
    }

    /// Rounds of medians, from the means and within the ranges that [`Dyadic::start`] gives.
    fn medians(&self, means: &[i64], ranges: &[[i64; 2]]) -> Vec<i64> {
        let mut heights = means.to_vec();
        for node in (0..ROUNDS).flat_map(|_| 0..ranges.len()) {
            let [low, high] = ranges[node];
            heights[node] = self.median(&heights, node).clamp(low, high);
        }
        heights
    }

    fn level(&self, heights: &[i64]) -> Level {
        let [width, height] = self.nodes;
        fill(width, height, |i, j| heights[j * width + i].clamp(0, 65535) as u16)
    }
}

/// The mean of |.| over a triangle with these values at its corners, linear between them, and its derivative by each.
pub fn absolute(corners: [f64; 3]) -> (f64, [f64; 3]) {
    let sum: f64 = corners.iter().sum();
    let (positive, negative) =
        [1.0, -1.0].map(|sign| corners.iter().filter(|corner| **corner * sign > 0.0).count()).into();
    if positive == 0 || negative == 0 {
        let sign = f64::from(u8::from(positive > 0)) - f64::from(u8::from(negative > 0));
        return (sum.abs() / 3.0, [sign / 3.0; 3]);
    }
    // The one whose sign nobody shares.
    let sign = if positive == 1 { 1.0 } else { -1.0 };
    let odd = (0..3).find(|at| corners[*at] * sign > 0.0).unwrap_or_default();
    let [second, third] = [(odd + 1) % 3, (odd + 2) % 3];
    let (a, b, c) = (corners[odd], corners[second], corners[third]);
    let t = a * (a / (a - b)) * (a / (a - c));
    let mut derivative = [0.0; 3];
    derivative[odd] = sign * (2.0 * (t / a) * (3.0 - a / (a - b) - a / (a - c)) - 1.0) / 3.0;
    derivative[second] = sign * (2.0 * t / (a - b) - 1.0) / 3.0;
    derivative[third] = sign * (2.0 * t / (a - c) - 1.0) / 3.0;
    (sign * (2.0 * t - sum) / 3.0, derivative)
}

/// The volume between a map and heights of the nodes of a level, and its derivative by each height.
pub fn volume(map: &HeightMap, wrap: [Wrap; 2], level: usize, heights: &[f64]) -> (f64, Vec<f64>) {
    Dyadic::new(map, wrap, level).volume(heights)
}

/// The weighted means that both ways begin with.
pub fn start(map: &HeightMap, wrap: [Wrap; 2], level: usize) -> Level {
    let dyadic = Dyadic::new(map, wrap, level);
    let heights: Vec<i64> = dyadic.start().into_iter().map(|(height, _)| height).collect();
    dyadic.level(&heights)
}

/// A level by three rounds of weighted medians, in integers: each node in turn becomes the median of what its texels ask for,
/// which is the best that it alone can do where weights are those of the texels' own points.
pub fn median(map: &HeightMap, wrap: [Wrap; 2], level: usize) -> Level {
    let dyadic = Dyadic::new(map, wrap, level);
    let (means, ranges): (Vec<i64>, Vec<[i64; 2]>) = dyadic.start().into_iter().unzip();
    dyadic.level(&dyadic.medians(&means, &ranges))
}

/// A level by 150 steps down the gradient, from the medians on, or from the means where these are better. A step is a share of
/// the relief and no fixed height; it grows while the volume falls, and is halved and taken back where it does not. The
/// result is no worse than what it began with.
pub fn descend(map: &HeightMap, wrap: [Wrap; 2], level: usize) -> Level {
    let dyadic = Dyadic::new(map, wrap, level);
    let real = |heights: &[i64]| heights.iter().map(|height| *height as f64).collect::<Vec<f64>>();
    let (means, ranges): (Vec<i64>, Vec<[i64; 2]>) = dyadic.start().into_iter().unzip();
    let medians = dyadic.medians(&means, &ranges);
    let volume_of = |heights: &[i64]| dyadic.volume(&real(heights)).0;
    let begin = if volume_of(&medians) < volume_of(&means) { medians } else { means };
    let areas: Vec<f64> = (0..dyadic.count())
        .map(|node| dyadic.support(node).iter().map(|(_, _, weight)| *weight as f64).sum::<f64>() / dyadic.step as f64)
        .collect();
    let [low, high] = map.range().map(f64::from);
    let mut heights = real(&begin);
    let (mut least, mut slope) = dyadic.volume(&heights);
    let mut share = FIRST_SHARE;
    for _ in 0..STEPS {
        let step = |node: usize| {
            let [low_here, high_here] = ranges[node].map(|height| height as f64);
            (heights[node] - share * (high - low) * slope[node] / areas[node]).clamp(low_here, high_here)
        };
        let next: Vec<f64> = (0..heights.len()).map(step).collect();
        let (volume, next_slope) = dyadic.volume(&next);
        if volume < least {
            (heights, least, slope) = (next, volume, next_slope);
            share *= 1.2;
        } else {
            share *= 0.5;
        }
    }
    let rounded: Vec<i64> = heights.iter().map(|height| height.round() as i64).collect();
    dyadic.level(if volume_of(&rounded) <= volume_of(&begin) { &rounded } else { &begin })
}
