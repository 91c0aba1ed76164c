// SPDX-License-Identifier: MIT OR Apache-2.0
//! Newton's method on a patch.
//!
//! With r the deviation at a sample and e = r - clamp(r, -theta, theta), it minimises sum e^2 over the heights of the
//! vertices: convex, piecewise quadratic, and 0 where the bound can be kept. A step that leads to a larger sum is halved;
//! without that some patches go round in circles and count as hopeless.

use super::patch::{FIXED, Patch};
use super::shapes::LANES;

/// Keeps the matrix regular where samples say nothing about a vertex.
const DAMPING: f32 = 1e-3;
/// After three steps, one that leaves more of the sum than this is the last.
const LEAST_GAIN: f32 = 0.99;

impl Patch {
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
                self.shift(-0.5);
                self.step.iter_mut().for_each(|step| *step *= 0.5);
                continue;
            }
            if step >= 3 && sum > LEAST_GAIN * last {
                return worst;
            }
            last = sum;
            self.find_step();
            self.shift(1.0);
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

    /// Solves (H + mu I) d = -g by Cholesky's method.
    fn find_step(&mut self) {
        let count = self.vars.len();
        let (matrix, gradient) = (&mut self.matrix, &mut self.gradient);
        for i in 0..count {
            let (above, rest) = matrix.split_at_mut(i * count);
            let row = &mut rest[..count];
            for j in 0..i {
                let other = &above[j * count..j * count + count];
                let dot = dot(&row[..j], &other[..j]);
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
        self.step.clone_from(gradient);
    }
    /// Moves by a share of the step.
    fn shift(&mut self, share: f32) {
        for (at, step) in self.moves.iter_mut().zip(&self.step) {
            *at += share * step;
        }
        for part in &self.parts {
            let steps = part.vars.map(|var| if var == FIXED { 0.0 } else { share * self.step[usize::from(var)] });
            let [begin, end] = part.rows;
            let [a, b, c] = [0, 1, 2].map(|i| &self.weights[i][begin..end]);
            for (row, deviation) in self.deviations[begin..end].iter_mut().enumerate() {
                *deviation += a[row] * steps[0] + b[row] * steps[1] + c[row] * steps[2];
            }
        }
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
