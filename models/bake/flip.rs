// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which corner of the map the lattice begins at.
//!
//! The lattice's vertices fall elsewhere when the map is flipped first, and the fitted mesh is somewhat larger or
//! smaller. (The other diagonal between the roots alone changes nothing once the centre is split: the same four triangles.)

use super::{Ground, Tolerance, fit::Fitted, fitted};
use crate::bisector::{SplitMap, golden};
use crate::map::HeightMap;
use crate::mesh::Progress;

/// Whether columns, and whether rows, are counted from the other end.
pub type Flip = [bool; 2];

/// Samples of a map in the order of a flipped one; the same again puts them back.
pub fn flip<T: Copy>(samples: &[T], width: usize, flip: Flip) -> Vec<T> {
    let rows: Vec<&[T]> = samples.chunks(width).collect();
    let row = |row: &&[T]| -> Vec<T> { if flip[0] { row.iter().rev().copied().collect() } else { row.to_vec() } };
    if flip[1] { rows.iter().rev().flat_map(row).collect() } else { rows.iter().flat_map(row).collect() }
}

/// Where a corner of a flipped map's mesh stands in the map. One flip alone turns the triangles over.
pub fn unflip(at: [u32; 2], size: [usize; 2], flip: Flip) -> [u32; 2] {
    [0, 1].map(|axis| if flip[axis] { size[axis] as u32 - 1 - at[axis] } else { at[axis] })
}

/// Rounds of search up to which all of it is done from one corner of the map only.
const QUICK: u32 = 1;

/// The fitted split map from the corner that promises most after the removals, or from the first corner if there is next to
/// no search; heights are in the order of the flipped map.
pub fn fitted_from_best_corner(
    map: &HeightMap,
    ground: &Ground<'_>,
    tolerance: Tolerance,
    effort: u32,
    progress: &dyn Progress,
) -> (Flip, Fitted) {
    let fit = |flipped: Flip, effort: u32| {
        let samples = flip(&map.samples, map.width, flipped);
        fitted(&Ground { lattice: ground.lattice, samples: &samples }, tolerance, effort, progress)
    };
    if effort <= QUICK {
        return ([false; 2], fit([false; 2], effort));
    }
    let triangles = |split: &SplitMap| golden(&ground.lattice, split, &mut |_| ()).triangles;
    let corners = [[false, false], [true, false], [false, true], [true, true]];
    let best = corners.into_iter().min_by_key(|&flipped| triangles(&fit(flipped, 0).split)).unwrap_or_default();
    (best, fit(best, effort))
}
