// SPDX-License-Identifier: MIT OR Apache-2.0
//! Saturated errors: one number a vertex, from which every bound has its mesh.
//!
//! ```text
//! e(m) = max(exact errors of the triangles at m with the map's heights, e of the midpoints of their halves)
//! ```
//! rounded up to units of 2^-f map units. Whoever is a leaf under a bound has an error of at most that bound, and whoever
//! splits has parents that split (Lindstrom and Pascucci 2001).

use std::sync::atomic::{AtomicU16, AtomicU64, Ordering::Relaxed};

use rayon::prelude::*;

use super::Ground;
use crate::bisector::Node;
use crate::mesh::Progress;

/// The largest f.
pub const MOST_FRACTION_BITS: u32 = 8;

/// Errors of all lattice vertices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Saturated {
    /// One a lattice vertex, row by row, in units of 2^-`fraction_bits` map units.
    pub errors: Vec<u16>,
    /// f: the most, up to 8, with which the map's range still fits.
    pub fraction_bits: u32,
}

/// The saturated errors of a map.
pub fn saturated(ground: &Ground<'_>, progress: &dyn Progress) -> Saturated {
    let lattice = &ground.lattice;
    let (low, high) = ground.samples.iter().fold((u16::MAX, 0), |(low, high), &at| (at.min(low), at.max(high)));
    // A triangle's plane stays between the least and the largest sample, so no error exceeds the range.
    let range = u32::from(high - low);
    let fraction_bits = (0..=MOST_FRACTION_BITS).rev().find(|bits| range << bits <= 65535).unwrap_or(0);
    let errors: Vec<AtomicU16> = (0..lattice.vertices()).map(|_| AtomicU16::new(0)).collect();
    let height = |index: usize| i32::from(ground.samples[index]) << 4;
    let error = |vertex: [u32; 2]| {
        let own = |node: Node| ground.excess(node, height).ceil(fraction_bits) as u16;
        let below = |node: Node| node.halves().into_iter().filter_map(Node::midpoint);
        let below = |node: Node| below(node).map(|at| errors[lattice.index(at)].load(Relaxed)).max().unwrap_or(0);
        lattice.nodes_at(vertex).map(|node| own(node).max(below(node))).max().unwrap_or(0)
    };
    let rows: u64 = (0..lattice.levels).map(|level| 2 * (u64::from(lattice.side() >> level) + 1)).sum();
    progress.phase("errors", rows);
    let done = AtomicU64::new(0);
    for level in 0..lattice.levels {
        let step = 1 << level;
        // Midpoints of level and plumb hypotenuses first: those of the diagonals stand above them.
        for diagonal in [false, true] {
            (0..=lattice.side() >> level).into_par_iter().for_each(|j| {
                for i in 0..=lattice.side() >> level {
                    let odd = [i % 2 == 1, j % 2 == 1];
                    if (odd[0] || odd[1]) && (odd[0] && odd[1]) == diagonal {
                        let vertex = [i * step, j * step];
                        errors[lattice.index(vertex)].store(error(vertex), Relaxed);
                    }
                }
                progress.advance(done.fetch_add(1, Relaxed) + 1);
            });
        }
    }
    Saturated { errors: errors.into_iter().map(AtomicU16::into_inner).collect(), fraction_bits }
}
