// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parts of the map that are worked on at once.
//!
//! A worker changes only triangles that lie in its window, and heights whose triangles all do. So no worker ever sees what
//! another one does, and the outcome does not depend on the number of cores. Each pass cuts elsewhere.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use rayon::prelude::*;

use super::fabric::{Fabric, Leaf};
use super::worker::Worker;
use crate::bisector::Node;
use crate::mesh::Progress;

/// Samples along the side of a window.
const SIDE: i32 = 64;

/// A part of the map, borders included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    low: [i32; 2],
    high: [i32; 2],
}

impl Window {
    /// The whole map.
    pub const ALL: Window = Window { low: [i32::MIN; 2], high: [i32::MAX; 2] };

    /// Whether a sample is inside, and not on the border.
    #[inline]
    pub fn is_inside(&self, fabric: &Fabric<'_>, at: u32) -> bool {
        let place = fabric.place(at).map(|at| at as i32);
        (0..2).all(|axis| self.low[axis] < place[axis] && place[axis] < self.high[axis])
    }
    /// Whether a triangle lies in it.
    #[inline]
    pub fn holds(&self, fabric: &Fabric<'_>, leaf: &Leaf) -> bool {
        leaf.at.iter().all(|&at| {
            let place = fabric.place(at).map(|at| at as i32);
            (0..2).all(|axis| self.low[axis] <= place[axis] && place[axis] <= self.high[axis])
        })
    }
    /// Whether the box round a triangle meets the inside.
    fn meets(&self, fabric: &Fabric<'_>, node: Node) -> bool {
        let corners = node.corners().map(|corner| fabric.lattice().clamp(corner).map(|at| at as i32));
        (0..2).all(|axis| {
            let [a, b, c] = corners.map(|corner| corner[axis]);
            a.max(b).max(c) > self.low[axis] && a.min(b).min(c) < self.high[axis]
        })
    }
    /// The leaves that lie in it.
    pub fn leaves(&self, fabric: &Fabric<'_>) -> Vec<Node> {
        let (mut leaves, mut waiting) = (Vec::new(), fabric.lattice().roots().to_vec());
        while let Some(node) = waiting.pop() {
            // A triangle that another window changes does not meet this one.
            if fabric.lattice().is_dead(node) || !self.meets(fabric, node) {
                continue;
            }
            if fabric.splits(node) {
                waiting.extend(node.halves());
            } else if self.holds(fabric, &fabric.leaf(node)) {
                leaves.push(node);
            }
        }
        leaves
    }
}

/// Windows that cover the map; every round has other ones.
pub(super) struct Tiling {
    shift: [i32; 2],
    counts: [usize; 2],
    round: u64,
}

impl Tiling {
    pub fn of(fabric: &Fabric<'_>, round: u64) -> Tiling {
        let shift = [round * 40 + 7, round * 24 + 29].map(|shift| (shift % SIDE as u64) as i32);
        let sides = [fabric.lattice().width, fabric.lattice().height];
        let counts = [0, 1].map(|axis| (sides[axis] as i32 - 1 + shift[axis]) as usize / SIDE as usize + 1);
        Tiling { shift, counts, round }
    }
    fn window(&self, index: usize) -> Window {
        let at = [index % self.counts[0], index / self.counts[0]];
        let cut = |axis: usize, at: usize| at as i32 * SIDE - self.shift[axis];
        // The windows at a rim go beyond it: its vertices are as free as others.
        let low = [0, 1].map(|axis| if at[axis] == 0 { i32::MIN } else { cut(axis, at[axis]) });
        let last = |axis: usize| at[axis] + 1 == self.counts[axis];
        let high = [0, 1].map(|axis| if last(axis) { i32::MAX } else { cut(axis, at[axis] + 1) });
        Window { low, high }
    }
    /// Number of windows.
    pub fn count(&self) -> usize {
        self.counts[0] * self.counts[1]
    }
    /// Lets a worker work on each window, and counts what is done.
    pub fn each(
        &self,
        fabric: &Fabric<'_>,
        progress: &dyn Progress,
        done: &AtomicU64,
        work: impl Fn(&mut Worker<'_>) + Sync,
    ) {
        (0..self.count()).into_par_iter().for_each(|index| {
            let seed = (self.round << 32 | index as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            work(&mut Worker::new(fabric, self.window(index), seed));
            progress.advance(done.fetch_add(1, Relaxed) + 1);
        });
    }
}
