// SPDX-License-Identifier: MIT OR Apache-2.0
//! A first-in, first-out cache of vertices, as GPUs have it behind the vertex stage: how often does an order of triangles
//! ask for a vertex that is not there?
//!
//! ```
//! use relief_models::vertex_cache::{ENTRIES, misses};
//! // A strip asks for one new vertex a triangle.
//! assert_eq!(misses(&[[0, 1, 2], [2, 1, 3], [2, 3, 4]], ENTRIES), 5);
//! // Too small a cache forgets 0 and 1.
//! assert_eq!(misses(&[[0, 1, 2], [3, 4, 5], [0, 1, 2]], 4), 9);
//! ```

use std::collections::VecDeque;

/// Entries of the cache that figures are given for.
pub const ENTRIES: usize = 16;

/// Misses of triangles in their order; the cache holds the last `entries` vertices that it missed.
pub fn misses(triangles: &[[u32; 3]], entries: usize) -> u64 {
    let mut cache = VecDeque::with_capacity(entries + 1);
    let mut misses = 0;
    for vertex in triangles.as_flattened() {
        if !cache.contains(vertex) {
            misses += 1;
            cache.push_back(*vertex);
            if cache.len() > entries {
                cache.pop_front();
            }
        }
    }
    misses
}
