// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is done to the mesh inside a window: relax, remove a vertex, and exchange vertices for fewer.

use super::fabric::{Fabric, Leaf, Window};
use super::patch::Patch;
use crate::bisector::Node;

/// Largest excess over the inner bound, in 1/16: rounding adds less than 1/2 to it, and the inner bound is 1 below.
const SLACK: f32 = 0.45;
/// Newton steps of a patch.
use super::patch::STEPS;

/// A window's worker. What it has changed since [`Worker::begin`] can be undone.
pub(super) struct Worker<'f> {
    pub fabric: &'f Fabric<'f>,
    pub window: Window,
    patch: Patch,
    theta: f32,
    seed: u64,
    heights: Vec<(u32, i32)>,
    bits: Vec<[u32; 2]>,
    star: Vec<Leaf>,
}

impl<'f> Worker<'f> {
    pub fn new(fabric: &'f Fabric<'f>, window: Window, seed: u64) -> Worker<'f> {
        let tolerance = 16.0 * fabric.tolerance.over as f32 / fabric.tolerance.under as f32;
        let theta = (tolerance - 1.0).max(0.5 * tolerance);
        Worker {
            fabric,
            window,
            patch: Patch::default(),
            theta,
            seed: seed | 1,
            heights: vec![],
            bits: vec![],
            star: vec![],
        }
    }
    /// A number below `end`.
    pub fn random(&mut self, end: usize) -> usize {
        self.seed = self.seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.seed >> 33) % end.max(1) as u64) as usize
    }
    fn begin(&mut self) {
        self.heights.clear();
        self.bits.clear();
    }
    fn undo(&mut self) {
        for &(at, height) in self.heights.iter().rev() {
            self.fabric.set_height(at, height);
        }
        for &vertex in self.bits.iter().rev() {
            self.fabric.set_split(vertex, !self.fabric.is_split(vertex));
        }
        self.begin();
    }

    /// Moves the corners of a leaf and those round them towards the bound.
    pub fn relax(&mut self, leaf: &Leaf, rings: usize) {
        self.patch.gather(self.fabric, &self.window, &leaf.at, rings);
        if !self.patch.is_empty() {
            self.patch.solve(self.theta, SLACK, *STEPS);
            self.patch.write(self.fabric);
        }
    }

    /// Whether both triangles of a vertex are split once, and nothing says that they have to be.
    pub fn is_removable(&self, vertex: [u32; 2]) -> bool {
        let fabric = self.fabric;
        fabric.is_split(vertex)
            && !fabric.is_needed(vertex)
            && fabric.live_at(vertex).all(|node| {
                let whole = |half| fabric.lattice().is_dead(half) || !fabric.splits(half);
                node.halves().into_iter().all(whole) && fabric.is_in(&fabric.leaf(node).at, &self.window)
            })
    }
    /// Triangles that a vertex costs.
    pub fn price(&self, vertex: [u32; 2]) -> usize {
        self.fabric.live_at(vertex).count()
    }
    fn corners(&self, vertex: [u32; 2]) -> Vec<u32> {
        self.fabric.live_at(vertex).flat_map(|node| self.fabric.leaf(node).at).collect()
    }

    /// The largest error that is left without a vertex, before anything is moved.
    pub fn cost(&self, vertex: [u32; 2]) -> f64 {
        self.fabric.live_at(vertex).map(|node| self.fabric.excess(node).to_f64()).fold(0.0, f64::max)
    }
    /// Whether no heights of the corners keep the triangles of a vertex whole.
    pub fn is_necessary(&mut self, vertex: [u32; 2]) -> bool {
        self.patch.gather_whole(self.fabric, self.fabric.live_at(vertex));
        self.patch.solve(self.theta + (self.theta - 0.0).min(1.0), SLACK, *STEPS * 3) > SLACK
    }

    /// Removes a vertex if the bound can be kept without it.
    pub fn remove(&mut self, vertex: [u32; 2], rings: usize) -> bool {
        STAT[15].fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        self.fabric.set_split(vertex, false);
        let seeds = self.corners(vertex);
        let kept = self.settle(&seeds, rings) && self.fabric.live_at(vertex).all(|node| self.fabric.keeps(node));
        if kept {
            self.bits.push(vertex);
            self.heights.extend(self.patch.written());
        } else {
            self.patch.restore(self.fabric);
            self.fabric.set_split(vertex, true);
        }
        kept
    }
    /// Brings the patch round `seeds` into the bound; what has been written has to be restored when that failed.
    fn settle(&mut self, seeds: &[u32], rings: usize) -> bool {
        self.patch.gather(self.fabric, &self.window, seeds, rings);
        let settled = self.patch.is_empty() || self.patch.solve(self.theta, SLACK, *STEPS) <= SLACK;
        if settled {
            self.patch.write(self.fabric);
        } else {
            self.patch.forget();
        }
        settled && self.patch.keeps(self.fabric)
    }

    /// Splits a leaf, whose surface stays. The vertices that it took.
    fn insert(&mut self, node: Node, most: usize) -> Option<Vec<[u32; 2]>> {
        let mut inserted = Vec::new();
        self.fabric.insert(node.midpoint()?, &self.window, most, &mut inserted)?;
        // From the coarse ones to the fine ones, whose ends may be among them.
        for &vertex in inserted.iter().rev() {
            self.bits.push(vertex);
            self.raise(vertex);
        }
        Some(inserted)
    }
    fn raise(&mut self, vertex: [u32; 2]) {
        let fabric = self.fabric;
        let Some(node) = fabric.live_at(vertex).next() else { return };
        let at = fabric.ground.sample_index(vertex) as u32;
        let [a, b, _] = fabric.leaf(node).at;
        // A clamped vertex may be one already.
        if at != a && at != b && !fabric.is_shared(vertex) {
            let [low, high] = fabric.range(at);
            self.heights.push((at, fabric.height(at)));
            fabric.set_height(at, ((fabric.height(a) + fabric.height(b)) >> 1).clamp(low, high));
        }
    }

    /// Leaves within an edge or two of a vertex.
    pub fn leaves_near(&mut self, vertex: [u32; 2], rings: usize) -> Vec<Leaf> {
        let mut samples = self.corners(vertex);
        samples.push(self.fabric.ground.sample_index(vertex) as u32);
        let mut next = 0;
        self.star.clear();
        for ring in 0..=rings {
            let end = samples.len();
            for index in next..end {
                let begin = self.star.len();
                self.fabric.star(samples[index], &mut self.star);
                for leaf in begin..self.star.len() {
                    for at in self.star[leaf].at {
                        if ring < rings && !samples.contains(&at) {
                            samples.push(at);
                        }
                    }
                }
            }
            next = end;
        }
        let mut leaves = self.star.clone();
        leaves.sort_unstable_by_key(|leaf| (leaf.node.v, leaf.node.u, leaf.node.direction));
        leaves.dedup_by_key(|leaf| leaf.node);
        leaves
    }

    /// Splits some leaves near a vertex to get rid of it, and of what else can be removed there; undone unless it paid. The
    /// gain, when it paid.
    pub fn exchange(&mut self, vertex: [u32; 2], rings: usize, count: usize) -> Option<usize> {
        let leaves = self.leaves_near(vertex, rings);
        self.begin();
        let mut paid = 0;
        let mut inserted: Vec<[u32; 2]> = Vec::new();
        for _ in 0..count {
            let node = leaves[self.random(leaves.len())].node;
            if !self.fabric.splits(node) && let Some(more) = self.insert(node, 3) {
                paid += more.iter().map(|&vertex| self.price(vertex)).sum::<usize>();
                inserted.extend(more);
            }
        }
        let most = 2 * count + 2;
        if paid == 0 || paid > most || !self.is_removable(vertex) || !self.remove(vertex, 1) {
            self.undo();
            return None;
        }
        let mut gained = self.price(vertex);
        let mut waiting = self.near(leaves[0].node);
        waiting.retain(|vertex| !inserted.contains(vertex));
        while !waiting.is_empty() {
            let index = self.random(waiting.len());
            let vertex = waiting.swap_remove(index);
            if self.is_removable(vertex) && self.remove(vertex, 1) {
                gained += self.price(vertex);
                for node in self.fabric.live_at(vertex) {
                    let apex = node.apex().map(|at| at as u32 / 2);
                    if !inserted.contains(&apex) && !waiting.contains(&apex) {
                        waiting.push(apex);
                    }
                }
            }
        }
        // What has been put in may have become free.
        for &vertex in &inserted {
            if self.is_removable(vertex) && self.remove(vertex, 1) {
                gained += self.price(vertex);
            }
        }
        use std::sync::atomic::Ordering::Relaxed;
        STAT[0].fetch_add(1, Relaxed);
        STAT[1 + (gained + 8).saturating_sub(paid).min(12)].fetch_add(1, Relaxed);
        let sound = gained >= paid && inserted.iter().all(|&vertex| {
            let halves = self.fabric.live_at(vertex).flat_map(Node::halves);
            halves.into_iter().all(|half| self.fabric.lattice().is_dead(half) || self.fabric.keeps(half))
        });
        if !sound {
            self.undo();
            return None;
        }
        Some(gained - paid)
    }
    /// The vertices of the leaves within two edges of a triangle.
    fn near(&mut self, node: Node) -> Vec<[u32; 2]> {
        let mut samples: Vec<u32> = self.fabric.leaf(node).at.to_vec();
        let mut vertices: Vec<[u32; 2]> = Vec::new();
        let mut next = 0;
        for _ in 0..2 {
            let end = samples.len();
            for index in next..end {
                self.star.clear();
                self.fabric.star(samples[index], &mut self.star);
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

pub static STAT: [std::sync::atomic::AtomicUsize; 16] = [const { std::sync::atomic::AtomicUsize::new(0) }; 16];
