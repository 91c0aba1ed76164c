// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaves round a sample, and vertices that come with what they need.

use super::fabric::{Fabric, Leaf};
use super::window::Window;
use crate::bisector::Node;

impl Fabric<'_> {
    /// Appends the leaves that have a sample as corner.
    pub fn star(&self, at: u32, leaves: &mut Vec<Leaf>) {
        let [x, y] = self.place(at);
        let on_rim = [x + 1 == self.lattice().width, y + 1 == self.lattice().height];
        let (xs, ys) = ([x], [y]);
        let us = if on_rim[0] { &self.rims[0][..] } else { &xs };
        let vs = if on_rim[1] { &self.rims[1][..] } else { &ys };
        for &v in vs {
            for &u in us {
                self.star_of_vertex([u, v], leaves);
            }
        }
    }
    /// Whether another lattice vertex on the same sample is a corner of a triangle.
    pub fn is_shared(&self, vertex: [u32; 2]) -> bool {
        let on_rim = vertex[0] + 1 >= self.lattice().width || vertex[1] + 1 >= self.lattice().height;
        let at = self.ground.sample_index(vertex) as u32;
        let mut leaves = Vec::new();
        if on_rim {
            self.star(at, &mut leaves);
        }
        leaves.iter().any(|leaf| {
            let corners = leaf.node.corners();
            (0..3).any(|corner| leaf.at[corner] == at && corners[corner] != vertex)
        })
    }
    fn star_of_vertex(&self, vertex: [u32; 2], leaves: &mut Vec<Leaf>) {
        let side = self.lattice().side();
        if vertex.iter().all(|at| at.is_multiple_of(side)) {
            for root in self.lattice().roots() {
                if let Some(corner) = root.corners().iter().position(|&corner| corner == vertex) {
                    self.descend(root, corner, leaves);
                }
            }
        } else if self.is_split(vertex) {
            for half in self.lattice().nodes_at(vertex).flat_map(Node::halves) {
                self.descend(half, 2, leaves);
            }
        }
    }
    /// The leaves of a triangle at one of its corners.
    fn descend(&self, mut node: Node, mut corner: usize, leaves: &mut Vec<Leaf>) {
        loop {
            if self.lattice().is_dead(node) {
                return;
            }
            if !self.splits(node) {
                leaves.push(self.leaf(node));
                return;
            }
            let [at_a, at_b] = node.halves();
            // The half at a is (c, a, m), the half at b is (b, c, m).
            match corner {
                0 => (node, corner) = (at_a, 1),
                1 => (node, corner) = (at_b, 0),
                _ => {
                    self.descend(at_a, 0, leaves);
                    (node, corner) = (at_b, 1);
                }
            }
        }
    }

    /// Splits at a vertex, and before that where its triangles descend from; appends what was not split before. `None`, and
    /// nothing is done, when a triangle that is split does not lie in the window, or more than `most` vertices are needed.
    pub fn insert(&self, vertex: [u32; 2], window: &Window, most: usize, inserted: &mut Vec<[u32; 2]>) -> Option<()> {
        let begin = inserted.len();
        inserted.push(vertex);
        let mut next = begin;
        let mut sound = true;
        while sound && next < inserted.len() {
            let vertex = inserted[next];
            next += 1;
            sound = inserted.len() - begin <= most;
            for node in self.live_at(vertex) {
                sound &= window.holds(self, &self.leaf(node));
                let apex = node.apex().map(|at| at as u32 / 2);
                let corner = apex.iter().all(|at| at.is_multiple_of(self.lattice().side()));
                if !corner && !self.is_split(apex) && !inserted[begin..].contains(&apex) {
                    inserted.push(apex);
                }
            }
        }
        if !sound {
            inserted.truncate(begin);
            return None;
        }
        for &vertex in &inserted[begin..] {
            self.set_split(vertex, true);
        }
        Some(())
    }
}
