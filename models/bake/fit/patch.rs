// SPDX-License-Identifier: MIT OR Apache-2.0
//! A few vertices with all their leaves, and the heights that bring those into the bound.
//!
//! With r the deviation at a sample and e = r - clamp(r, -theta, theta), Newton steps on sum e^2 over the heights of the
//! vertices. The sum is convex and piecewise quadratic: a few steps end at its minimum, which is 0 where the bound can be kept.

use super::fabric::{Fabric, Leaf, Window};
use super::shapes::{LANES, Shape, Shapes};
use crate::bisector::Node;

/// Not moved.
const FIXED: u16 = u16::MAX;

#[derive(Clone, Copy)]
struct Part {
    leaf: Leaf,
    vars: [u16; 3],
    rows: [usize; 2],
}

/// Room for a patch, used again and again.
#[derive(Default)]
pub(super) struct Patch {
    candidates: Vec<u32>,
    indices: Vec<u16>,
    vars: Vec<u32>,
    star: Vec<Leaf>,
    starts: Vec<usize>,
    parts: Vec<Part>,
    deviations: Vec<f32>,
    weights: [Vec<f32>; 3],
    offsets: Vec<f32>,
    moves: Vec<f32>,
    matrix: Vec<f32>,
    gradient: Vec<f32>,
    gradient_step: Vec<f32>,
    old: Vec<i32>,
}

impl Patch {
    /// Takes the samples `seeds`, those within `rings` edges, and all their leaves, as far as they lie in the window.
    pub fn gather(&mut self, fabric: &Fabric<'_>, window: &Window, seeds: &[u32], rings: usize) {
        self.candidates.clear();
        self.indices.clear();
        self.vars.clear();
        self.star.clear();
        self.starts.clear();
        for &seed in seeds {
            if !self.candidates.contains(&seed) {
                self.candidates.push(seed);
            }
        }
        let mut next = 0;
        for ring in 0..=rings {
            for index in next..self.candidates.len() {
                let begin = self.star.len();
                let at = self.candidates[index];
                let mut free = fabric.is_inside(at, window);
                if free {
                    fabric.star(at, &mut self.star);
                    free = self.star[begin..].iter().all(|leaf| fabric.is_in(&leaf.at, window));
                }
                if !free {
                    self.star.truncate(begin);
                    self.indices.push(FIXED);
                    continue;
                }
                self.indices.push(self.vars.len() as u16);
                self.vars.push(at);
                self.starts.push(begin);
                if ring < rings {
                    for leaf in begin..self.star.len() {
                        for at in self.star[leaf].at {
                            if !self.candidates.contains(&at) {
                                self.candidates.push(at);
                            }
                        }
                    }
                }
            }
            next = self.indices.len();
        }
        self.starts.push(self.star.len());
        self.gather_rows(fabric);
    }

    /// Takes these triangles and their corners, and nothing else.
    pub fn gather_whole(&mut self, fabric: &Fabric<'_>, nodes: impl Iterator<Item = Node>) {
        self.candidates.clear();
        self.indices.clear();
        self.star.clear();
        self.star.extend(nodes.map(|node| fabric.leaf(node)));
        for at in self.star.iter().flat_map(|leaf| leaf.at) {
            if !self.candidates.contains(&at) {
                self.indices.push(self.candidates.len() as u16);
                self.candidates.push(at);
            }
        }
        self.vars.clone_from(&self.candidates);
        self.starts.clear();
        self.starts.resize(self.vars.len() + 1, self.star.len());
        self.starts[0] = 0;
        self.gather_rows(fabric);
    }

    fn gather_rows(&mut self, fabric: &Fabric<'_>) {
        self.parts.clear();
        self.deviations.clear();
        for column in &mut self.weights {
            column.clear();
        }
        for var in 0..self.vars.len() {
            for at in self.starts[var]..self.starts[var + 1] {
                let leaf = self.star[at];
                let vars = leaf.at.map(|at| match self.candidates.iter().position(|&other| other == at) {
                    Some(index) => *self.indices.get(index).unwrap_or(&FIXED),
                    None => FIXED,
                });
                // Each leaf once, with the first of its vertices.
                if vars.iter().all(|&other| usize::from(other) >= var) {
                    self.push(fabric, leaf, vars);
                }
            }
        }
        self.offsets.clear();
        self.offsets.extend(self.vars.iter().map(|&at| {
            (fabric.height(at) - (i32::from(fabric.ground.samples[at as usize]) << 4)) as f32
        }));
        self.moves.clear();
        self.moves.resize(self.vars.len(), 0.0);
    }

    fn push(&mut self, fabric: &Fabric<'_>, leaf: Leaf, vars: [u16; 3]) {
        let corners = leaf.node.corners();
        let begin = self.deviations.len();
        if fabric.ground.is_clamped(&corners) {
            let clamped = corners.map(|corner| fabric.lattice().clamp(corner));
            let shape = Shape::of(clamped, clamped[2], fabric.lattice().width, Shapes::stride(leaf.node));
            self.push_rows(fabric, &leaf, &shape, leaf.at[2] as i32, 1);
        } else if let Some(midpoint) = leaf.node.midpoint() {
            let (shape, stride) = fabric.shapes.at(leaf.node);
            let origin = fabric.ground.sample_index(midpoint) as i32;
            self.push_rows(fabric, &leaf, shape, origin, stride);
        }
        self.parts.push(Part { leaf, vars, rows: [begin, self.deviations.len()] });
    }

    fn push_rows(&mut self, fabric: &Fabric<'_>, leaf: &Leaf, shape: &Shape, origin: i32, stride: i32) {
        let [a, b, c] = leaf.at.map(|at| fabric.height(at));
        // About a height of its own, so that 24 bits are enough.
        let middle = c;
        let [a, b, c] = [a, b, c].map(|height| (height - middle) as f32);
        let [wa, wb, wc] = &shape.weights;
        for row in 0..shape.offsets.len() {
            let sample = i32::from(fabric.ground.samples[(origin + shape.offsets[row] * stride) as usize]) << 4;
            let deviation = wa[row] * a + wb[row] * b + wc[row] * c - (sample - middle) as f32;
            self.deviations.push(if row < shape.rows { deviation } else { 0.0 });
        }
        for (column, weights) in self.weights.iter_mut().zip(&shape.weights) {
            column.extend_from_slice(weights);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.vars.is_empty()
    }

    /// Newton steps until no deviation exceeds `theta` by more than `slack`, or nothing is gained any more: the largest
    /// excess.
    pub fn solve(&mut self, theta: f32, slack: f32, most: usize) -> f32 {
        let mut last = f32::INFINITY;
        for step in 0.. {
            let (sum, worst) = self.assemble(theta);
            if worst <= slack || step == most {
                return worst;
            }
            if sum > last {
                // Too far: half of the way back.
                for step in &mut self.gradient_step {
                    *step *= -0.5;
                }
                self.shift();
                for step in &mut self.gradient_step {
                    *step *= -1.0;
                }
                continue;
            }
            if step >= 3 && sum > *RATIO * last { return worst; }
            last = sum;
            self.step();
            self.gradient_step.clone_from(&self.gradient);
            self.shift();
        }
        0.0
    }

    /// Hessian and gradient of half the sum; the sum and the largest excess.
    fn assemble(&mut self, theta: f32) -> (f32, f32) {
        let count = self.vars.len();
        self.matrix.clear();
        self.matrix.resize(count * count, 0.0);
        self.gradient.clear();
        self.gradient.resize(count, 0.0);
        let (mut sum, mut worst) = (0.0f32, 0.0f32);
        for var in 0..count {
            let deviation = self.offsets[var] + self.moves[var];
            let excess = deviation - deviation.clamp(-theta, theta);
            if excess != 0.0 {
                sum += excess * excess;
                worst = worst.max(excess.abs());
                self.gradient[var] += excess;
                self.matrix[var * count + var] += 1.0;
            }
        }
        for part in &self.parts {
            let [begin, end] = part.rows;
            let mut sums = [[0.0f32; LANES]; 10];
            let mut high = [0.0f32; LANES];
            let mut active = false;
            let rows = self.deviations[begin..end].as_chunks::<LANES>().0;
            let columns = [0, 1, 2].map(|i| self.weights[i][begin..end].as_chunks::<LANES>().0);
            for (row, deviations) in rows.iter().enumerate() {
                let excess = deviations.map(|deviation| deviation - deviation.clamp(-theta, theta));
                if excess == [0.0; LANES] {
                    continue;
                }
                active = true;
                let [a, b, c] = [columns[0][row], columns[1][row], columns[2][row]];
                for lane in 0..LANES {
                    let e = excess[lane];
                    let on = if e != 0.0 { 1.0 } else { 0.0 };
                    let (a, b, c) = (a[lane], b[lane], c[lane]);
                    high[lane] = high[lane].max(e.abs());
                    sums[0][lane] += a * e;
                    sums[1][lane] += b * e;
                    sums[2][lane] += c * e;
                    sums[3][lane] += on * a * a;
                    sums[4][lane] += on * a * b;
                    sums[5][lane] += on * a * c;
                    sums[6][lane] += on * b * b;
                    sums[7][lane] += on * b * c;
                    sums[8][lane] += on * c * c;
                    sums[9][lane] += e * e;
                }
            }
            if !active {
                continue;
            }
            let sums = sums.map(|lanes| lanes.iter().sum::<f32>());
            worst = high.into_iter().fold(worst, f32::max);
            sum += sums[9];
            let squares = [[3, 4, 5], [4, 6, 7], [5, 7, 8]];
            for i in 0..3 {
                if part.vars[i] == FIXED {
                    continue;
                }
                let row = usize::from(part.vars[i]);
                self.gradient[row] += sums[i];
                for j in 0..3 {
                    if part.vars[j] != FIXED {
                        self.matrix[row * count + usize::from(part.vars[j])] += sums[squares[i][j]];
                    }
                }
            }
        }
        (sum, worst)
    }

    /// Solves (H + mu I) d = -g by Cholesky's method, and moves.
    fn step(&mut self) {
        const DAMPING: f32 = 1e-3;
        let count = self.vars.len();
        let (matrix, gradient) = (&mut self.matrix, &mut self.gradient);
        for i in 0..count {
            let (above, rest) = matrix.split_at_mut(i * count);
            let row = &mut rest[..count];
            for j in 0..i {
                let other = &above[j * count..j * count + count];
                let dot: f32 = dot(&row[..j], &other[..j]);
                row[j] = (row[j] - dot) * other[j];
            }
            let square = dot(&row[..i], &row[..i]);
            // The reciprocal of the diagonal.
            row[i] = 1.0 / (row[i] + DAMPING - square).max(DAMPING * 0.1).sqrt();
            gradient[i] = (-gradient[i] - dot(&row[..i], &gradient[..i])) * row[i];
        }
        for i in (0..count).rev() {
            let mut value = gradient[i];
            for j in i + 1..count {
                value -= matrix[j * count + i] * gradient[j];
            }
            gradient[i] = value * matrix[i * count + i];
        }
    }
    fn shift(&mut self) {
        let gradient = &self.gradient_step;
        for (at, step) in self.moves.iter_mut().zip(gradient.iter()) {
            *at += step;
        }
        for part in &self.parts {
            let steps = part.vars.map(|var| if var == FIXED { 0.0 } else { gradient[usize::from(var)] });
            let [begin, end] = part.rows;
            let [a, b, c] = [0, 1, 2].map(|i| &self.weights[i][begin..end]);
            for (row, deviation) in self.deviations[begin..end].iter_mut().enumerate() {
                *deviation += a[row] * steps[0] + b[row] * steps[1] + c[row] * steps[2];
            }
        }
    }

    /// The leaf with the largest excess, among those with a midpoint.
    pub fn worst(&self, theta: f32) -> Option<Leaf> {
        let high = |part: &Part| {
            self.deviations[part.rows[0]..part.rows[1]].iter().fold(theta, |high, deviation| high.max(deviation.abs()))
        };
        let parts = self.parts.iter().filter(|part| part.rows[0] < part.rows[1]);
        let worst = parts.map(|part| (high(part), part.leaf)).max_by(|a, b| a.0.total_cmp(&b.0))?;
        (worst.0 > theta).then_some(worst.1)
    }

    /// Gives the vertices their heights, rounded and clamped.
    pub fn write(&mut self, fabric: &Fabric<'_>) {
        self.old.clear();
        for (&at, step) in self.vars.iter().zip(&self.moves) {
            let height = fabric.height(at);
            self.old.push(height);
            let [low, high] = fabric.range(at);
            let rounded = (height as f32 + step + 0.5).floor() as i32;
            fabric.set_height(at, rounded.clamp(low, high));
        }
    }
    /// Nothing has been written.
    pub fn forget(&mut self) {
        self.old.clear();
    }
    /// Takes the last [`Patch::write`] back.
    pub fn restore(&self, fabric: &Fabric<'_>) {
        for (&at, &old) in self.vars.iter().zip(&self.old) {
            fabric.set_height(at, old);
        }
    }
    /// The vertices and their heights before the last [`Patch::write`].
    pub fn written(&self) -> impl Iterator<Item = (u32, i32)> + '_ {
        self.vars.iter().copied().zip(self.old.iter().copied())
    }
    /// Whether all leaves keep the bound, exactly.
    pub fn keeps(&self, fabric: &Fabric<'_>) -> bool {
        self.parts.iter().all(|part| fabric.keeps(part.leaf.node))
    }
}

/// The scalar product, in lanes.
#[inline]
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let (a_lanes, a_rest) = a.as_chunks::<LANES>();
    let (b_lanes, b_rest) = b.as_chunks::<LANES>();
    let mut sums = [0.0f32; LANES];
    for (a, b) in a_lanes.iter().zip(b_lanes) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum::<f32>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f32>()
}
static RATIO: std::sync::LazyLock<f32> = std::sync::LazyLock::new(|| std::env::var("RATIO").map_or(0.9, |t| t.parse().unwrap()));
pub static STEPS: std::sync::LazyLock<usize> = std::sync::LazyLock::new(|| std::env::var("STEPS").map_or(12, |t| t.parse().unwrap()));
