// SPDX-License-Identifier: MIT OR Apache-2.0
//! What can be done to the mesh inside a window: relax, split a leaf, remove a vertex; and take it back.

use super::fabric::{Fabric, Leaf};
use super::patch::Patch;
use super::window::Window;
use crate::bisector::Node;

/// Deviations may come so near to the bound, in 1/16: rounding adds up to half of that unit to them.
const MARGIN: f32 = 0.55;
/// And this part of the bound below that is aimed at: steps that come from outside end sooner.
const AIM: f32 = 1.0 / 150.0;
/// Newton steps of a patch.
const STEPS: usize = 12;
/// Newton steps before a vertex counts as necessary.
const STEPS_TO_BE_SURE: usize = 40;
/// Vertices that may come with one that is inserted.
const CLOSURE: usize = 3;

/// Works on a window. What it has changed since [`Worker::begin`] can be undone.
pub(super) struct Worker<'f> {
    pub fabric: &'f Fabric<'f>,
    pub window: Window,
    pub patch: Patch,
    pub bits: Vec<[u32; 2]>,
    pub heights: Vec<(u32, i32)>,
    theta: f32,
    slack: f32,
    seed: u64,
    star: Vec<Leaf>,
}

impl<'f> Worker<'f> {
    pub fn new(fabric: &'f Fabric<'f>, window: Window, seed: u64) -> Worker<'f> {
        let bound = 16.0 * fabric.tolerance.over() as f32 / fabric.tolerance.under() as f32;
        let most = (bound - MARGIN).max(0.5 * bound);
        let slack = AIM * bound;
        let (patch, bits, heights, star) = (Patch::default(), Vec::new(), Vec::new(), Vec::new());
        Worker { fabric, window, patch, bits, heights, theta: most - slack, slack, seed: seed | 1, star }
    }
    /// A number below `end`.
    pub fn random(&mut self, end: usize) -> usize {
        self.seed = self.seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.seed >> 33) % end.max(1) as u64) as usize
    }
    pub fn begin(&mut self) {
        self.heights.clear();
        self.bits.clear();
    }
    pub fn undo(&mut self) {
        for &(at, height) in self.heights.iter().rev() {
            self.fabric.set_height(at, height);
        }
        for &vertex in self.bits.iter().rev() {
            self.fabric.set_split(vertex, !self.fabric.is_split(vertex));
        }
        self.begin();
    }

    /// Moves samples and those within `rings` edges of them into the bound, or as near as they come. Whether all their leaves
    /// keep it.
    pub fn settle(&mut self, samples: &[u32], rings: usize) -> bool {
        self.patch.gather(self.fabric, &self.window, samples, rings);
        let excess = self.patch.solve(self.theta, self.slack, STEPS);
        self.heights.extend(self.patch.write(self.fabric));
        excess <= self.slack && self.patch.keeps(self.fabric)
    }
    /// The leaf of the patch with the largest excess but `skipped`.
    pub fn worst(&self, skipped: usize) -> Option<Leaf> {
        self.patch.worst(self.theta + self.slack, skipped)
    }

    /// Whether both triangles of a vertex are split once, and nothing says that they have to be.
    pub fn is_removable(&self, vertex: [u32; 2]) -> bool {
        let fabric = self.fabric;
        let is_whole = |half: Node| fabric.lattice().is_dead(half) || !fabric.splits(half);
        fabric.is_split(vertex)
            && !fabric.is_needed(vertex)
            && fabric
                .live_at(vertex)
                .all(|node| node.halves().into_iter().all(is_whole) && self.window.holds(fabric, &fabric.leaf(node)))
    }
    /// The vertices of the window that can be removed.
    pub fn removable(&self) -> Vec<[u32; 2]> {
        let leaves = self.window.leaves(self.fabric);
        let mut vertices: Vec<_> = leaves.into_iter().map(|leaf| leaf.apex().map(|at| at as u32 / 2)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices.retain(|&vertex| self.is_removable(vertex));
        vertices
    }
    /// Triangles that a vertex costs.
    pub fn price(&self, vertex: [u32; 2]) -> usize {
        self.fabric.live_at(vertex).count()
    }
    /// The largest error that is left without a vertex, before anything is moved.
    pub fn cost(&self, vertex: [u32; 2]) -> f64 {
        self.fabric.live_at(vertex).map(|node| self.fabric.excess(node).to_f64()).fold(0.0, f64::max)
    }
    /// Whether no heights of the corners keep the triangles of a vertex whole.
    pub fn is_necessary(&mut self, vertex: [u32; 2]) -> bool {
        self.patch.gather_whole(self.fabric, self.fabric.live_at(vertex));
        self.patch.solve(self.theta + MARGIN, self.slack, STEPS_TO_BE_SURE) > self.slack
    }
    /// Marks a vertex as removed; the corners of its triangles.
    pub fn clear(&mut self, vertex: [u32; 2]) -> Vec<u32> {
        self.fabric.set_split(vertex, false);
        self.bits.push(vertex);
        self.fabric.live_at(vertex).flat_map(|node| self.fabric.leaf(node).at).collect()
    }
    /// Removes a vertex if the bound can be kept without it.
    pub fn remove(&mut self, vertex: [u32; 2]) -> bool {
        let (bits, heights) = (self.bits.len(), self.heights.len());
        let corners = self.clear(vertex);
        let kept = self.settle(&corners, 1) && self.fabric.live_at(vertex).all(|node| self.fabric.keeps(node));
        if !kept {
            for (at, height) in self.heights.drain(heights..) {
                self.fabric.set_height(at, height);
            }
            self.bits.truncate(bits);
            self.fabric.set_split(vertex, true);
        }
        kept
    }

    /// Splits a leaf where its surface is, and what has to be split before; the vertices.
    pub fn insert(&mut self, node: Node) -> Option<Vec<[u32; 2]>> {
        let mut inserted = Vec::new();
        self.fabric.insert(node.midpoint()?, &self.window, CLOSURE, &mut inserted)?;
        // The coarse ones first: the ends of the others may be among them.
        for &vertex in inserted.iter().rev() {
            self.bits.push(vertex);
            let fabric = self.fabric;
            let at = fabric.ground.sample_index(vertex) as u32;
            let ends = fabric.live_at(vertex).next().map(|node| fabric.leaf(node).at);
            // A clamped vertex may stand on one that is there.
            if let Some([a, b, _]) = ends.filter(|ends| !ends.contains(&at))
                && !fabric.is_shared(vertex)
            {
                let [low, high] = fabric.range(at);
                self.heights.push((at, fabric.height(at)));
                fabric.set_height(at, ((fabric.height(a) + fabric.height(b)) >> 1).clamp(low, high));
            }
        }
        Some(inserted)
    }

    /// The corners of the leaves within two edges of a triangle, as far as they are inside the window: what lies beyond may
    /// be changing.
    pub fn near(&mut self, node: Node) -> Vec<[u32; 2]> {
        let mut samples = self.fabric.leaf(node).at.to_vec();
        let mut vertices: Vec<[u32; 2]> = Vec::new();
        let mut next = 0;
        for _ in 0..2 {
            let end = samples.len();
            for &sample in &samples.clone()[next..end] {
                if !self.window.is_inside(self.fabric, sample) {
                    continue;
                }
                self.star.clear();
                self.fabric.star(sample, &mut self.star);
                for leaf in &self.star {
                    for (at, corner) in leaf.at.into_iter().zip(leaf.node.corners()) {
                        if !samples.contains(&at) {
                            samples.push(at);
                        }
                        if !vertices.contains(&corner) {
                            vertices.push(corner);
                        }
                    }
                }
            }
            next = end;
        }
        vertices
    }
}
