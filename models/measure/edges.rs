// SPDX-License-Identifier: MIT OR Apache-2.0
//! The edges of a mesh that covers a map: each inside has two users, who walk it in opposite directions.

use rayon::prelude::*;

/// What is wrong with edges.
#[derive(Default)]
pub(super) struct Edges {
    /// One user, and not on the rim of the map.
    pub(super) open: u64,
    /// Three users or more.
    pub(super) nonmanifold: u64,
    /// Two users in the same direction.
    pub(super) inconsistent: u64,
}

/// Looks at all edges of `triangles`, whose corners are numbers below 2^31; `on_rim` says whether an edge with these ends
/// lies along the rim.
pub(super) fn examine(triangles: &[[u32; 3]], on_rim: impl Fn(u32, u32) -> bool) -> Edges {
    let mut uses: Vec<u64> = triangles
        .par_iter()
        .flat_map_iter(|[a, b, c]| {
            [[a, b], [b, c], [c, a]].map(|[from, to]| {
                let (low, high) = (u64::from(*from.min(to)), u64::from(*from.max(to)));
                low << 33 | high << 1 | u64::from(from < to)
            })
        })
        .collect();
    uses.par_sort_unstable();
    let mut edges = Edges::default();
    for same in uses.chunk_by(|a, b| a >> 1 == b >> 1) {
        let upward = same.iter().filter(|user| **user & 1 == 1).count();
        match same.len() {
            1 if !on_rim((same[0] >> 33) as u32, (same[0] >> 1) as u32) => edges.open += 1,
            1 => {}
            2 => edges.inconsistent += u64::from(upward != 1),
            _ => edges.nonmanifold += 1,
        }
    }
    edges
}
