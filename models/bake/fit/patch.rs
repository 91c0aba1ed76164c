// SPDX-License-Identifier: MIT OR Apache-2.0
//! A few vertices with all their leaves: the deviations at the samples, and how they follow the heights.

use super::fabric::{Fabric, Leaf};
use super::shapes::{Shape, Shapes};
use super::window::Window;
use crate::bisector::Node;

/// Not moved.
pub(super) const FIXED: u16 = u16::MAX;

#[derive(Clone, Copy)]
pub(super) struct Part {
    pub leaf: Leaf,
    /// Which vertices its corners are.
    pub vars: [u16; 3],
    /// Its samples, but for the corners.
    pub rows: [usize; 2],
}

/// Room for a patch, used again and again.
#[derive(Default)]
pub(super) struct Patch {
    candidates: Vec<u32>,
    indices: Vec<u16>,
    pub vars: Vec<u32>,
    star: Vec<Leaf>,
    starts: Vec<usize>,
    pub parts: Vec<Part>,
    pub deviations: Vec<f32>,
    pub weights: [Vec<f32>; 3],
    pub offsets: Vec<f32>,
    pub moves: Vec<f32>,
    pub matrix: Vec<f32>,
    pub gradient: Vec<f32>,
    pub step: Vec<f32>,
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
                let mut free = window.is_inside(fabric, at);
                if free {
                    fabric.star(at, &mut self.star);
                    free = self.star[begin..].iter().all(|leaf| window.holds(fabric, leaf));
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
        self.offsets.extend(
            self.vars
                .iter()
                .map(|&at| (fabric.height(at) - (i32::from(fabric.ground.samples[at as usize]) << 4)) as f32),
        );
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

    /// The leaf with the largest excess but `skipped`, or the last one that has any.
    pub fn worst(&self, theta: f32, skipped: usize) -> Option<Leaf> {
        let high = |part: &Part| {
            self.deviations[part.rows[0]..part.rows[1]].iter().fold(0.0f32, |high, deviation| high.max(deviation.abs()))
        };
        let mut over: Vec<_> = self.parts.iter().map(|part| (high(part), part.leaf)).collect();
        over.retain(|(high, _)| *high > theta);
        over.sort_by(|a, b| b.0.total_cmp(&a.0));
        over.get(skipped).or(over.last()).map(|(_, leaf)| *leaf)
    }

    /// Gives the vertices their heights, rounded and clamped; those that they had.
    pub fn write(&self, fabric: &Fabric<'_>) -> impl Iterator<Item = (u32, i32)> + '_ {
        let old: Vec<(u32, i32)> = self.vars.iter().map(|&at| (at, fabric.height(at))).collect();
        for (&(at, height), step) in old.iter().zip(&self.moves) {
            let [low, high] = fabric.range(at);
            let rounded = (height as f32 + step + 0.5).floor() as i32;
            fabric.set_height(at, rounded.clamp(low, high));
        }
        old.into_iter()
    }
    /// Whether all leaves keep the bound, exactly.
    pub fn keeps(&self, fabric: &Fabric<'_>) -> bool {
        self.parts.iter().all(|part| fabric.keeps(part.leaf.node))
    }
}
