// SPDX-License-Identifier: MIT OR Apache-2.0
//! The search: takes some vertices away, and splits the leaves that fail until the bound is kept again.
//!
//! Kept when it takes no more triangles than before: among equals the mesh wanders, and now and then one is smaller.

use super::worker::Worker;
use crate::bisector::Node;

/// Vertices that are taken away at once, at most.
const MOST: usize = 4;

impl Worker<'_> {
    /// Rebuilds round a vertex that can be removed, moving vertices within `rings` edges.
    pub fn rebuild(&mut self, vertex: [u32; 2], rings: usize) {
        self.begin();
        if !self.try_rebuild(vertex, rings) {
            self.undo();
        }
    }

    fn try_rebuild(&mut self, vertex: [u32; 2], rings: usize) -> bool {
        let Some((mut samples, gained)) = self.take_away(vertex) else { return false };
        let mut paid = 0;
        let mut inserted: Vec<[u32; 2]> = Vec::new();
        while !self.settle(&samples, rings) {
            // Mostly the worst leaf, so that it does not end where it began.
            let skipped = (self.random(3) + self.random(2)).saturating_sub(1);
            let Some(leaf) = self.worst(skipped) else { return false };
            if paid == gained {
                return false;
            }
            let Some(more) = self.insert(leaf.node) else { return false };
            paid += more.iter().map(|&vertex| self.price(vertex)).sum::<usize>();
            if paid > gained {
                return false;
            }
            samples.extend(more.iter().map(|&vertex| self.fabric.ground.sample_index(vertex) as u32));
            inserted.extend(more);
        }
        // The first ones may have become dispensable.
        for vertex in inserted {
            if self.is_removable(vertex) {
                self.remove(vertex);
            }
        }
        self.is_sound()
    }

    /// Takes a vertex away, and some that are removable near it; the corners round them, and their triangles.
    fn take_away(&mut self, vertex: [u32; 2]) -> Option<(Vec<u32>, usize)> {
        let mut near = self.near(self.fabric.live_at(vertex).next()?);
        near.push(vertex);
        let most = 1 + self.random(MOST);
        let (mut samples, mut gained) = (Vec::new(), 0);
        while !near.is_empty() && self.bits.len() < most {
            let index = if self.bits.is_empty() { near.len() - 1 } else { self.random(near.len()) };
            let vertex = near.swap_remove(index);
            if self.is_removable(vertex) {
                samples.extend(self.clear(vertex));
                gained += self.price(vertex);
                for node in self.fabric.live_at(vertex) {
                    near.push(node.apex().map(|at| at as u32 / 2));
                }
            }
        }
        Some((samples, gained))
    }

    /// Whether the leaves at all vertices that came or went keep the bound.
    fn is_sound(&self) -> bool {
        let fabric = self.fabric;
        let keeps = |node: Node| fabric.lattice().is_dead(node) || fabric.splits(node) || fabric.keeps(node);
        self.bits
            .iter()
            .flat_map(|&vertex| fabric.live_at(vertex))
            .all(|node| if fabric.splits(node) { node.halves().into_iter().all(keeps) } else { fabric.keeps(node) })
    }
}
