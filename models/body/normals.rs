// SPDX-License-Identifier: MIT OR Apache-2.0
//! Normals for a mesh that brings none: the areas round a place decide, whatever the number of its copies.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::weld::key;

/// The normal at each place, from all triangles that touch it. An error is the place where they cancel.
pub(super) fn by_place(triangles: &[[DVec3; 3]]) -> Result<FxHashMap<[u64; 3], DVec3>, DVec3> {
    let mut sums: FxHashMap<[u64; 3], (DVec3, DVec3)> = FxHashMap::default();
    for corners in triangles {
        let [a, b, c] = *corners;
        let area = (b - a).cross(c - a);
        for place in corners {
            sums.entry(key(*place)).or_insert((*place, DVec3::ZERO)).1 += area;
        }
    }
    // Of several places that cancel, the same one is named in every run.
    let mut cancelled: Option<DVec3> = None;
    let mut normals = FxHashMap::default();
    for (key, (place, sum)) in sums {
        match sum.try_normalize() {
            Some(normal) => drop(normals.insert(key, normal)),
            None => {
                let is_first = cancelled.is_none_or(|other| place.to_array() < other.to_array());
                cancelled = if is_first { Some(place) } else { cancelled };
            }
        }
    }
    cancelled.map_or(Ok(normals), Err)
}
