// SPDX-License-Identifier: MIT OR Apache-2.0
//! From too few vertices to enough: relax round the leaves that fail, split the worst of those that still do.

use rayon::prelude::*;

use super::fabric::{Fabric, Window};
use super::windows::{Tiling, branches};
use crate::bake::Excess;
use crate::bisector::Node;

/// Leaves that fail are split in portions of one in so many.
const PORTION: usize = 8;
/// And at least so many.
const LEAST: usize = 30;

/// The leaves that fail, the worst ones first.
fn failing(fabric: &Fabric<'_>, roots: &[Node]) -> Vec<(Excess, Node)> {
    let below = |root: &Node| {
        let mut failing = Vec::new();
        fabric.leaves_below(*root, &mut |leaf| {
            let excess = fabric.excess(leaf);
            if !excess.is_within(fabric.tolerance) {
                failing.push((excess, leaf));
            }
        });
        failing
    };
    let mut failing: Vec<_> = roots.par_iter().flat_map_iter(below).collect();
    failing.sort_by(|a, b| b.0.to_f64().total_cmp(&a.0.to_f64()).then(a.1.u.cmp(&b.1.u)).then(a.1.v.cmp(&b.1.v)));
    failing
}

pub(super) fn grow(fabric: &Fabric<'_>) {
    let mut round = 0;
    loop {
        for _ in 0..2 {
            let roots = branches(fabric);
            let failing = failing(fabric, &roots);
            if failing.is_empty() {
                return;
            }
            let tiling = Tiling::of(fabric, round);
            round += 1;
            let parts = tiling.sort(fabric, failing.into_iter().map(|(_, leaf)| leaf));
            tiling.each(fabric, &parts, |worker, leaves| {
                for &node in leaves {
                    if !worker.fabric.keeps(node) {
                        worker.relax(&worker.fabric.leaf(node), 1);
                    }
                }
            });
        }
        let failing = failing(fabric, &branches(fabric));
        let count = (failing.len() / PORTION).max(LEAST);
        for (_, leaf) in failing.into_iter().take(count) {
            if let Some(midpoint) = leaf.midpoint() {
                let mut inserted = Vec::new();
                let _ = fabric.insert(midpoint, &Window::ALL, usize::MAX, &mut inserted);
            }
        }
    }
}
