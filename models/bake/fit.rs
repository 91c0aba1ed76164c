// SPDX-License-Identifier: MIT OR Apache-2.0
//! Split maps with fitted heights.

use std::sync::atomic::AtomicU64;

mod fabric;
mod grow;
mod newton;
mod patch;
mod rebuild;
mod shapes;
mod star;
mod window;
mod worker;

use fabric::Fabric;
use window::Tiling;

use super::{Ground, Tolerance, unfitted};
use crate::bisector::{SplitMap, golden};
use crate::mesh::Progress;

/// A split map and the heights that keep its bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fitted {
    /// The split map.
    pub split: SplitMap,
    /// Heights, UQ16.4, one a sample; where no vertex stands, the map's.
    pub heights: Vec<u32>,
}

/// Passes that remove vertices.
const REMOVALS: u64 = 8;
/// Times that a rebuilding round tries each vertex.
const TRIALS: usize = 8;
/// Rounds that move the vertices within one edge; those behind them move them within two.
const NARROW: u64 = 8;

/// The fitted split map of a bound after `effort` rounds of search. It never has more triangles than the unfitted one.
pub fn fitted(ground: &Ground<'_>, tolerance: Tolerance, effort: u32, progress: &dyn Progress) -> Fitted {
    let mut fabric = Fabric::new(*ground, tolerance);
    grow::need(&fabric, progress);
    grow::grow(&fabric, progress);
    let plain = unfitted(ground, tolerance);
    let count = |split: &SplitMap| golden(&ground.lattice, split, &mut |_| ()).triangles;
    if count(&plain) < count(&fabric.split_map()) {
        fabric.reset(&plain);
    }
    let tilings: Vec<Tiling> = (0..REMOVALS + u64::from(effort)).map(|round| Tiling::of(&fabric, round)).collect();
    let (removals, rebuildings) = tilings.split_at(REMOVALS as usize);
    let windows = |tilings: &[Tiling]| tilings.iter().map(|tiling| tiling.count() as u64).sum::<u64>();
    let done = AtomicU64::new(0);
    progress.phase("removing", windows(removals));
    for tiling in removals {
        tiling.each(&fabric, progress, &done, |worker| {
            let removable = worker.removable();
            let mut order: Vec<_> = removable.into_iter().map(|vertex| (worker.cost(vertex), vertex)).collect();
            order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for (_, vertex) in order {
                worker.begin();
                if worker.is_removable(vertex) {
                    worker.remove(vertex);
                }
            }
        });
    }
    let done = AtomicU64::new(0);
    progress.phase("rebuilding", windows(rebuildings));
    for (round, tiling) in rebuildings.iter().enumerate() {
        let rings = if (round as u64) < NARROW { 1 } else { 2 };
        tiling.each(&fabric, progress, &done, |worker| {
            let mut removable = worker.removable();
            for last in (1..removable.len()).rev() {
                let other = worker.random(last + 1);
                removable.swap(last, other);
            }
            for vertex in removable {
                for _ in 0..TRIALS {
                    if worker.is_removable(vertex) {
                        worker.rebuild(vertex, rings);
                    }
                }
            }
        });
    }
    fabric.finish()
}
