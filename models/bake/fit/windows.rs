// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parts of the map that are worked on at once, and the passes over them.
//!
//! A worker changes only triangles that lie in its window, and heights whose triangles all do. So windows never meet, and the
//! outcome does not depend on the number of cores. Each pass cuts elsewhere.

use rayon::prelude::*;

use super::fabric::{Fabric, Window};
use super::moves::Worker;
use crate::bisector::Node;

/// Passes of the search, and what they may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Passes that remove.
    pub removals: u32,
    /// Passes that exchange.
    pub rounds: u32,
}

/// Samples along the side of a window.
const SIDE: i32 = 64;

pub(super) struct Tiling {
    shift: [i32; 2],
    columns: usize,
    rows: usize,
    round: u64,
}

/// Nodes that share the map among them, for parallel walks.
pub(super) fn branches(fabric: &Fabric<'_>) -> Vec<Node> {
    let mut nodes = fabric.lattice().roots().to_vec();
    for _ in 0..6 {
        nodes = nodes
            .into_iter()
            .flat_map(|node| if fabric.splits(node) { node.halves().to_vec() } else { vec![node] })
            .collect();
    }
    nodes
}

impl Tiling {
    pub fn of(fabric: &Fabric<'_>, round: u64) -> Tiling {
        // Shifts that spread over the side.
        let shift = [round * 40 + 7, round * 24 + 29].map(|shift| (shift % SIDE as u64) as i32);
        let count = |side: u32, shift: i32| (side as i32 - 1 + shift) as usize / SIDE as usize + 1;
        let lattice = fabric.lattice();
        Tiling { shift, columns: count(lattice.width, shift[0]), rows: count(lattice.height, shift[1]), round }
    }
    fn window(&self, index: usize) -> Window {
        let at = [index % self.columns, index / self.columns];
        let count = [self.columns, self.rows];
        let low = |axis: usize| if at[axis] == 0 { i32::MIN } else { at[axis] as i32 * SIDE - self.shift[axis] };
        let high = |axis: usize| {
            if at[axis] + 1 == count[axis] { i32::MAX } else { (at[axis] as i32 + 1) * SIDE - self.shift[axis] }
        };
        Window { low: [low(0), low(1)], high: [high(0), high(1)] }
    }
    /// Leaves by the window of their apex.
    pub fn sort(&self, fabric: &Fabric<'_>, leaves: impl Iterator<Item = Node>) -> Vec<Vec<Node>> {
        let mut parts = vec![Vec::new(); self.columns * self.rows];
        for leaf in leaves {
            let at = fabric.lattice().clamp([leaf.u / 2, leaf.v / 2]);
            let [x, y] = [0, 1].map(|axis| ((at[axis] as i32 + self.shift[axis]) / SIDE) as usize);
            parts[y.min(self.rows - 1) * self.columns + x.min(self.columns - 1)].push(leaf);
        }
        parts
    }
    /// All leaves, by window.
    pub fn leaves(&self, fabric: &Fabric<'_>) -> Vec<Vec<Node>> {
        let below = |root: &Node| {
            let mut leaves = Vec::new();
            fabric.leaves_below(*root, &mut |leaf| leaves.push(leaf));
            leaves
        };
        let leaves: Vec<Node> = branches(fabric).par_iter().flat_map_iter(below).collect();
        self.sort(fabric, leaves.into_iter())
    }
    /// A worker for each window.
    pub fn each(&self, fabric: &Fabric<'_>, parts: &[Vec<Node>], work: impl Fn(&mut Worker<'_>, &[Node]) + Sync) {
        parts.par_iter().enumerate().for_each(|(index, leaves)| {
            let seed = (self.round << 32 | index as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            work(&mut Worker::new(fabric, self.window(index), seed), leaves);
        });
    }
}

/// Splits whatever no heights could keep whole.
pub(super) fn need(fabric: &Fabric<'_>) {
    let mut fresh: Vec<Node> = fabric.lattice().roots().to_vec();
    while !fresh.is_empty() {
        let needed: Vec<[u32; 2]> = fresh
            .par_iter()
            .with_min_len(64)
            .filter_map(|leaf| leaf.midpoint())
            .filter(|&midpoint| Worker::new(fabric, Window::ALL, 0).is_necessary(midpoint))
            .collect();
        let mut inserted = Vec::new();
        for midpoint in needed {
            if !fabric.is_split(midpoint) {
                let _ = fabric.insert(midpoint, &Window::ALL, usize::MAX, &mut inserted);
            }
        }
        fresh.clear();
        for vertex in inserted {
            fabric.set_needed(vertex);
            let halves = fabric.live_at(vertex).flat_map(Node::halves);
            fresh.extend(halves.filter(|&half| !fabric.lattice().is_dead(half) && !fabric.splits(half)));
        }
    }
}

/// Takes away what is not wanted, then looks for exchanges that pay.
pub(super) fn reduce(fabric: &Fabric<'_>, effort: Effort) {
    let now = std::time::Instant::now();
    for pass in 0..u64::from(effort.removals) {
        remove_pass(fabric, pass, std::env::var("R1").map_or(1, |t| t.parse().unwrap()));
        eprintln!("removal {pass}: {} in {:?}", fabric.count(), now.elapsed());
    }
    for pass in 0..u64::from(effort.rounds) {
        let tiling = Tiling::of(fabric, pass + 1000);
        tiling.each(fabric, &tiling.leaves(fabric), |worker, leaves| {
            let e = |n: &str, d: usize| std::env::var(n).map_or(d, |t| t.parse().unwrap());
            let (r2, k, c) = (e("R2", 1), e("K", 8), e("C", 1));
            let mut vertices: Vec<_> = leaves.iter().map(|leaf| leaf.apex().map(|at| at as u32 / 2)).collect();
            vertices.sort_unstable();
            vertices.dedup();
            for index in (1..vertices.len()).rev() { let other = worker.random(index + 1); vertices.swap(index, other); }
            for vertex in vertices {
                for _ in 0..k {
                    if !worker.is_removable(vertex) { break }
                    let count = 1 + worker.random(c);
                    worker.exchange(vertex, r2, count);
                }
            }
        });
        eprintln!("exchange {pass}: {} in {:?}", fabric.count(), now.elapsed());
        eprintln!("{:?}", super::moves::STAT.iter().map(|s| s.swap(0, std::sync::atomic::Ordering::Relaxed)).collect::<Vec<_>>());
    }
}

fn remove_pass(fabric: &Fabric<'_>, pass: u64, rings: usize) {
    let tiling = Tiling::of(fabric, pass);
    tiling.each(fabric, &tiling.leaves(fabric), |worker, leaves| {
        let mut vertices: Vec<_> = leaves.iter().map(|leaf| leaf.apex().map(|at| at as u32 / 2)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices.retain(|&vertex| worker.is_removable(vertex));
        let mut order: Vec<_> = vertices.into_iter().map(|vertex| (worker.cost(vertex), vertex)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, vertex) in order {
            if worker.is_removable(vertex) {
                worker.remove(vertex, rings);
            }
        }
    });
}
