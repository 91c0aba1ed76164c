// SPDX-License-Identifier: MIT OR Apache-2.0
//! The mesh while it is fitted: a bit a lattice vertex, a height a sample, and the leaves round a sample.
//!
//! Everything is an atomic, so that windows that share no leaf can be worked on at once; nobody waits for anybody.

use std::sync::atomic::{AtomicI32, AtomicU8, Ordering::Relaxed};

use super::Fitted;
use super::shapes::Shapes;
use crate::bake::{Excess, Ground, Tolerance};
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
    pub rims: [Vec<u32>; 2],
}

/// A triangle with the numbers of the samples at its corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    pub node: Node,
    pub at: [u32; 3],
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
        let (sample, p, q) = (
            i64::from(self.ground.samples[at as usize]),
            i64::from(self.tolerance.over()),
            i64::from(self.tolerance.under()),
        );
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
    #[inline]
    pub fn excess(&self, node: Node) -> Excess {
        self.ground.excess(node, |index| self.height(index as u32))
    }
    #[inline]
    pub fn keeps(&self, node: Node) -> bool {
        self.excess(node).is_within(self.tolerance)
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
    /// Starts again from a split map and the heights of the map.
    pub fn reset(&mut self, split: &SplitMap) {
        for (index, flag) in self.flags.iter_mut().enumerate() {
            *flag.get_mut() = if split.get(index) { SPLIT } else { 0 };
        }
        for (height, &sample) in self.heights.iter_mut().zip(self.ground.samples) {
            *height.get_mut() = i32::from(sample) << 4;
        }
    }
    /// The split map and the heights; those where no vertex stands are the map's.
    pub fn finish(self) -> Fitted {
        let split = self.split_map();
        let mut heights: Vec<u32> = self.ground.samples.iter().map(|&sample| u32::from(sample) << 4).collect();
        golden(self.lattice(), &split, &mut |triangle| {
            for corner in triangle.corners {
                let index = self.ground.sample_index(corner);
                heights[index] = self.height(index as u32) as u32;
            }
        });
        Fitted { split, heights }
    }
}
