// SPDX-License-Identifier: MIT OR Apache-2.0
//! From too few vertices to enough: what no heights could do without, then, again and again, relaxing round the leaves that
//! fail and splitting the worst of them.

use std::sync::atomic::AtomicU64;

use rayon::prelude::*;

use super::fabric::Fabric;
use super::window::{Tiling, Window};
use super::worker::Worker;
use crate::bake::Excess;
use crate::bisector::Node;
use crate::mesh::Progress;

/// One in so many of the leaves that fail is split.
const PORTION: usize = 6;
/// And at least so many.
const LEAST: usize = 30;

/// Splits whatever no heights could keep whole.
pub(super) fn need(fabric: &Fabric<'_>, progress: &dyn Progress) {
    progress.phase("necessary vertices", u64::from(2 * fabric.lattice().levels));
    let mut inserted: Vec<[u32; 2]> = Vec::new();
    let mut candidates: Vec<[u32; 2]> = fabric.lattice().roots().into_iter().filter_map(Node::midpoint).collect();
    for round in 1.. {
        let worker = || Worker::new(fabric, Window::ALL, 0);
        let necessary = |worker: &mut Worker<'_>, vertex: [u32; 2]| worker.is_necessary(vertex).then_some(vertex);
        // The leaves that came with the last vertices; the list would be larger than all of the mesh.
        let leaves = |&vertex: &[u32; 2]| {
            let halves = fabric.live_at(vertex).flat_map(Node::halves);
            let fresh = halves.filter(|&half| !fabric.lattice().is_dead(half) && !fabric.splits(half));
            fresh.filter_map(Node::midpoint)
        };
        let found = inserted.par_iter().with_min_len(64).flat_map_iter(leaves).chain(candidates.par_drain(..));
        let needed: Vec<[u32; 2]> = found.map_init(worker, necessary).flatten().collect();
        inserted.clear();
        for midpoint in needed {
            if !fabric.is_split(midpoint) {
                // Never refused: all of the map, and as many as it takes.
                let _ = fabric.insert(midpoint, &Window::ALL, usize::MAX, &mut inserted);
            }
        }
        if inserted.is_empty() {
            return;
        }
        for &vertex in &inserted {
            fabric.set_needed(vertex);
        }
        progress.advance(round);
    }
}

/// The leaves that fail.
fn failing(fabric: &Fabric<'_>) -> Vec<(Excess, Node)> {
    let mut branches = fabric.lattice().roots().to_vec();
    for _ in 0..10 {
        let parts = |node: Node| if fabric.splits(node) { node.halves().to_vec() } else { vec![node] };
        branches = branches.into_iter().flat_map(parts).collect();
    }
    let below = |branch: &Node| {
        let (mut failing, mut waiting) = (Vec::new(), vec![*branch]);
        while let Some(node) = waiting.pop() {
            if fabric.lattice().is_dead(node) {
                continue;
            }
            if fabric.splits(node) {
                waiting.extend(node.halves());
                continue;
            }
            let excess = fabric.excess(node);
            if !excess.is_within(fabric.tolerance) {
                failing.push((excess, node));
            }
        }
        failing
    };
    branches.par_iter().flat_map_iter(below).collect()
}

/// Splits until every leaf keeps the bound.
pub(super) fn grow(fabric: &Fabric<'_>, progress: &dyn Progress) {
    progress.phase("growing", 0);
    for round in 0.. {
        let tiling = Tiling::of(fabric, round);
        tiling.each(fabric, &(), &AtomicU64::new(0), |worker| {
            for node in worker.window.leaves(fabric) {
                if !fabric.keeps(node) {
                    worker.begin();
                    worker.settle(&fabric.leaf(node).at, 1);
                }
            }
        });
        if round % 2 == 0 {
            continue;
        }
        let mut failing = failing(fabric);
        if failing.is_empty() {
            return;
        }
        // The worst ones first; among equals an order that is always the same.
        failing.sort_by(|a, b| b.0.to_f64().total_cmp(&a.0.to_f64()).then((a.1.v, a.1.u).cmp(&(b.1.v, b.1.u))));
        for (_, leaf) in failing.iter().take((failing.len() / PORTION).max(LEAST)) {
            if let Some(midpoint) = leaf.midpoint().filter(|&midpoint| !fabric.is_split(midpoint)) {
                let _ = fabric.insert(midpoint, &Window::ALL, usize::MAX, &mut Vec::new());
            }
        }
    }
}
