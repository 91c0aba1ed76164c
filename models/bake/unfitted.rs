// SPDX-License-Identifier: MIT OR Apache-2.0
//! The split map of a bound with the map's own heights.
//!
//! The set is the least one that is closed and whose leaves all hold, so it does not matter in which order vertices come.
//! A round tests the leaves that the round before has made; leaves that held and did not change are not tested again.

use rayon::prelude::*;

use super::{Ground, Tolerance};
use crate::bisector::{Node, SplitMap};

/// The split map that keeps the bound with heights of the map.
pub fn unfitted(ground: &Ground<'_>, tolerance: Tolerance) -> SplitMap {
    unfitted_with_seams(ground, tolerance, [false; 2])
}

/// The same for a map whose rims meet, in u and in v where `seams` says so: both have vertices at the same places, so the
/// seam is closed when their samples are equal.
pub fn unfitted_with_seams(ground: &Ground<'_>, tolerance: Tolerance, seams: [bool; 2]) -> SplitMap {
    let lattice = &ground.lattice;
    let last = [lattice.width - 1, lattice.height - 1];
    // The vertex at the other side of a seam; what lies beyond the rim is drawn on it.
    let across = |vertex: [u32; 2], axis: usize| {
        let mut other = vertex;
        other[axis] = if vertex[axis] == 0 { last[axis] } else { 0 };
        (seams[axis] && (vertex[axis] == 0 || vertex[axis] >= last[axis])).then_some(other)
    };
    let mut split = SplitMap::new(lattice);
    let fails = |node: Node| {
        let midpoint = node.midpoint()?;
        let height = |index: usize| i32::from(ground.samples[index]) << 4;
        (!ground.excess(node, height).is_within(tolerance)).then_some(midpoint)
    };
    let mut failing: Vec<[u32; 2]> = lattice.roots().into_iter().filter_map(fails).collect();
    while !failing.is_empty() {
        let mut inserted = Vec::new();
        while let Some(vertex) = failing.pop() {
            let first = inserted.len();
            split.insert_with(lattice, vertex, &mut |vertex| inserted.push(vertex));
            let fresh = inserted[first..].iter();
            failing.extend(fresh.flat_map(|&vertex| [0, 1].into_iter().filter_map(move |axis| across(vertex, axis))));
        }
        let fresh = |&vertex: &[u32; 2]| {
            let halves = lattice.nodes_at(vertex).flat_map(Node::halves);
            let is_leaf = |midpoint: [u32; 2]| !split.get(lattice.index(midpoint));
            halves.filter(move |half| !lattice.is_dead(*half) && half.midpoint().is_some_and(is_leaf)).filter_map(fails)
        };
        failing = inserted.par_iter().with_min_len(64).flat_map_iter(fresh).collect();
    }
    split
}
