// SPDX-License-Identifier: MIT OR Apache-2.0
//! The mesh while it is fitted: a bit a lattice vertex, a height a sample, and the leaves round a sample.
//!
//! Everything is an atomic, so that windows that share no leaf can be worked on at once; nobody waits for anybody.

use std::sync::atomic::{AtomicI32, AtomicU8, Ordering::Relaxed};

use super::Fitted;
use super::shapes::Shapes;
use crate::bake::{Ground, Tolerance};
use crate::bisector::{Lattice, Node, SplitMap, golden};

const SPLIT: u8 = 1;
const NEEDED: u8 = 2;
/// 65535.9375 in 1/16.
const HIGHEST: i64 = 0xF_FFFF;

pub(super) struct Fabric<'a> {
    pub ground: Ground<'a>,
    pub tolerance: Tolerance,
    pub shapes: Shapes,
    flags: Vec<AtomicU8>,
    heights: Vec<AtomicI32>,
    /// Lattice coordinates that stand on the last column, and on the last row, and can be corners of live triangles.
    rims: [Vec<u32>; 2],
}

/// A triangle with the numbers of the samples at its corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    pub node: Node,
    pub at: [u32; 3],
}

/// A part of the map, borders included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub low: [i32; 2],
    pub high: [i32; 2],
}

impl Window {
    pub const ALL: Window = Window { low: [i32::MIN; 2], high: [i32::MAX; 2] };
    /// Whether a place is inside, and not on the border.
    #[inline]
    fn is_inside(&self, at: [i32; 2]) -> bool {
        (0..2).all(|axis| self.low[axis] < at[axis] && at[axis] < self.high[axis])
    }
    #[inline]
    fn holds(&self, at: [i32; 2]) -> bool {
        (0..2).all(|axis| self.low[axis] <= at[axis] && at[axis] <= self.high[axis])
    }
}

impl<'a> Fabric<'a> {
    pub fn new(ground: Ground<'a>, tolerance: Tolerance) -> Fabric<'a> {
        let lattice = &ground.lattice;
        let rim = |side: u32| {
            let last = side - 1;
            let both = (0..=lattice.levels).flat_map(|level| {
                let up = last.next_multiple_of(1 << level);
                [up, up + (1 << level)]
            });
            let mut rim: Vec<u32> = both.filter(|&at| at <= lattice.side()).collect();
            rim.sort_unstable();
            rim.dedup();
            rim
        };
        Fabric {
            ground,
            tolerance,
            shapes: Shapes::new(lattice),
            flags: (0..lattice.vertices()).map(|_| AtomicU8::new(0)).collect(),
            heights: ground.samples.iter().map(|&sample| AtomicI32::new(i32::from(sample) << 4)).collect(),
            rims: [rim(lattice.width), rim(lattice.height)],
        }
    }
    pub fn lattice(&self) -> &Lattice {
        &self.ground.lattice
    }
    /// Column and row of a sample.
    #[inline]
    pub fn place(&self, at: u32) -> [u32; 2] {
        [at % self.lattice().width, at / self.lattice().width]
    }
    #[inline]
    pub fn height(&self, at: u32) -> i32 {
        self.heights[at as usize].load(Relaxed)
    }
    #[inline]
    pub fn set_height(&self, at: u32, height: i32) {
        self.heights[at as usize].store(height, Relaxed);
    }
    /// The heights that a vertex may have.
    #[inline]
    pub fn range(&self, at: u32) -> [i32; 2] {
        let (sample, p, q) =
            (i64::from(self.ground.samples[at as usize]), i64::from(self.tolerance.over), i64::from(self.tolerance.under));
        let low = -((16 * (p - sample * q)).div_euclid(q));
        let high = (16 * (p + sample * q)).div_euclid(q);
        [low.max(0) as i32, high.min(HIGHEST) as i32]
    }
    #[inline]
    fn flag(&self, vertex: [u32; 2]) -> &AtomicU8 {
        &self.flags[self.lattice().index(vertex)]
    }
    #[inline]
    pub fn is_split(&self, vertex: [u32; 2]) -> bool {
        self.flag(vertex).load(Relaxed) & SPLIT != 0
    }
    #[inline]
    pub fn is_needed(&self, vertex: [u32; 2]) -> bool {
        self.flag(vertex).load(Relaxed) & NEEDED != 0
    }
    pub fn set_split(&self, vertex: [u32; 2], split: bool) {
        let flag = self.flag(vertex);
        let old = flag.load(Relaxed);
        flag.store(if split { old | SPLIT } else { old & !SPLIT }, Relaxed);
    }
    pub fn set_needed(&self, vertex: [u32; 2]) {
        self.flag(vertex).fetch_or(NEEDED, Relaxed);
    }
    #[inline]
    pub fn splits(&self, node: Node) -> bool {
        node.midpoint().is_some_and(|midpoint| self.is_split(midpoint))
    }
    #[inline]
    pub fn leaf(&self, node: Node) -> Leaf {
        Leaf { node, at: node.corners().map(|corner| self.ground.sample_index(corner) as u32) }
    }
    /// The triangles with area at a midpoint.
    #[inline]
    pub fn live_at(&self, vertex: [u32; 2]) -> impl Iterator<Item = Node> + use<'_, 'a> {
        self.lattice().nodes_at(vertex).filter(|&node| !self.lattice().is_dead(node))
    }
    /// Whether a triangle lies in a window.
    #[inline]
    pub fn is_in(&self, at: &[u32; 3], window: &Window) -> bool {
        at.iter().all(|&at| window.holds(self.place(at).map(|at| at as i32)))
    }
    /// Whether a sample is inside a window and not on its border.
    #[inline]
    pub fn is_inside(&self, at: u32, window: &Window) -> bool {
        window.is_inside(self.place(at).map(|at| at as i32))
    }
    #[inline]
    pub fn excess(&self, node: Node) -> crate::bake::Excess {
        self.ground.excess(node, |index| self.height(index as u32))
    }
    #[inline]
    pub fn keeps(&self, node: Node) -> bool {
        self.excess(node).is_within(self.tolerance)
    }

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
                sound &= self.is_in(&self.leaf(node).at, window);
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

    /// The split map as it stands.
    pub fn split_map(&self) -> SplitMap {
        let mut split = SplitMap::new(self.lattice());
        for (index, flag) in self.flags.iter().enumerate() {
            if flag.load(Relaxed) & SPLIT != 0 {
                split.set(index, true);
            }
        }
        split
    }
    pub fn count(&self) -> u64 {
        golden(self.lattice(), &self.split_map(), &mut |_| ()).triangles
    }
    pub fn finish(self) -> Fitted {
        let split = self.split_map();
        Fitted { split, heights: self.heights.into_iter().map(|height| height.into_inner() as u32).collect() }
    }
    /// The leaves in parts of the lattice, for parallel work.
    pub fn leaves_below(&self, root: Node, each: &mut impl FnMut(Node)) {
        let mut waiting = vec![root];
        while let Some(node) = waiting.pop() {
            if self.lattice().is_dead(node) {
            } else if self.splits(node) {
                waiting.extend(node.halves());
            } else {
                each(node);
            }
        }
    }
}
