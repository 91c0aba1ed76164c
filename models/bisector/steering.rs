// SPDX-License-Identifier: MIT OR Apache-2.0
//! What tells a walker whether to split: a bit at every vertex, or an error and a bound.

use super::{Lattice, Node};

/// Tells whether a triangle is split.
pub trait Steering {
    /// Whether `node` is split at `midpoint`, its own.
    fn splits(&self, lattice: &Lattice, node: Node, midpoint: [u32; 2]) -> bool;
}

/// One bit a lattice vertex, row by row: set where triangles are split.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SplitMap {
    words: Vec<u64>,
}

impl SplitMap {
    /// A map of a lattice that splits nowhere.
    pub fn new(lattice: &Lattice) -> Self {
        Self { words: vec![0; lattice.vertices().div_ceil(64)] }
    }
    /// The bit of the vertex of a number ([`Lattice::index`]).
    #[inline]
    pub fn get(&self, index: usize) -> bool {
        self.words[index / 64] >> (index % 64) & 1 == 1
    }
    /// Sets it.
    #[inline]
    pub fn set(&mut self, index: usize, splits: bool) {
        let bit = 1 << (index % 64);
        if splits {
            self.words[index / 64] |= bit;
        } else {
            self.words[index / 64] &= !bit;
        }
    }
    /// Sets a vertex, and before it those that its triangles descend from: without them there would be T-vertices.
    pub fn insert(&mut self, lattice: &Lattice, vertex: [u32; 2]) {
        self.insert_with(lattice, vertex, &mut |_| ());
    }
    /// The same, and tells of every vertex that was not set before.
    pub fn insert_with(&mut self, lattice: &Lattice, vertex: [u32; 2], inserted: &mut impl FnMut([u32; 2])) {
        let mut waiting = vec![vertex];
        while let Some(vertex) = waiting.pop() {
            let index = lattice.index(vertex);
            if !self.get(index) {
                self.set(index, true);
                inserted(vertex);
                // A triangle is there once its apex is.
                let apexes = lattice.nodes_at(vertex).map(|node| node.apex().map(|at| at as u32 / 2));
                let side = lattice.side();
                waiting.extend(apexes.filter(|apex| !apex.iter().all(|at| at.is_multiple_of(side))));
            }
        }
    }
    /// Vertices that split.
    pub fn count(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }
}

impl Steering for SplitMap {
    #[inline]
    fn splits(&self, lattice: &Lattice, _: Node, midpoint: [u32; 2]) -> bool {
        self.get(lattice.index(midpoint))
    }
}

/// A bound that grows with the distance from the eye, and stays where `slope` is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bound {
    /// At the eye, in the units of the errors.
    pub base: u16,
    /// Growth per half step of the lattice, UQ8.8.
    pub slope: u16,
    /// Where the eye stands, u and v in half steps of the lattice.
    pub eye: [u16; 2],
}

impl Bound {
    /// The same bound everywhere.
    pub const fn constant(base: u16) -> Self {
        Self { base, slope: 0, eye: [0; 2] }
    }
    /// The bound that a triangle has to keep, in the units of the errors. The roots reach everything: theirs is `base`.
    #[inline]
    pub fn at(&self, lattice: &Lattice, node: Node) -> u32 {
        if node.level == lattice.levels && !node.reversed() {
            return self.base.into();
        }
        let reach = if node.reversed() { 2 << node.level } else { 3 << node.level };
        let from_eye = |at: u32, side: u32, eye: u16| at.min(2 * (side - 1)).abs_diff(eye.into());
        let [u, v] = [from_eye(node.u, lattice.width, self.eye[0]), from_eye(node.v, lattice.height, self.eye[1])];
        u32::from(self.base) + ((u32::from(self.slope) * u.max(v).saturating_sub(reach)) >> 8)
    }
}

/// One error a lattice vertex, row by row, and the bound that it is held against.
#[derive(Clone, Copy, Debug)]
pub struct Errors<'a> {
    /// Saturated errors, or the bits 0 and 1.
    pub errors: &'a [u16],
    /// The bound.
    pub bound: Bound,
}

impl Steering for Errors<'_> {
    #[inline]
    fn splits(&self, lattice: &Lattice, node: Node, midpoint: [u32; 2]) -> bool {
        u32::from(self.errors[lattice.index(midpoint)]) > self.bound.at(lattice, node)
    }
}
