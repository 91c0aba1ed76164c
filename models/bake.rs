// SPDX-License-Identifier: MIT OR Apache-2.0
//! Prepares a map for the bisector: split maps whose bound holds, heights fitted to it, saturated errors, and more.
//!
//! ```text
//! a triangle holds:  q |w0 h0 + w1 h1 + w2 h2 - 16 z A| <= 16 p A     at every sample of the closed, clamped triangle
//! bound p / q in map units, heights h in 1/16, weights w0 + w1 + w2 = A = twice the area, sample z
//! ```
//!
//! [`unfitted()`] has the map's heights, and is the least split map that keeps the bound with them. [`fitted()`] moves
//! heights within the bound and takes about half the triangles: what no heights could do without, what relaxing leaves to
//! be split, less what can be removed again, less what a search finds. Its decisions about the bound are integers; the
//! proposals are f32 additions, multiplications and divisions, and seeded numbers, so that all machines and any number of
//! cores give the same. [`measure()`] tests a mesh without sharing any of it.
//!
//! ```
//! use relief_models::bake::{Ground, Tolerance, fitted, measure, unfitted};
//! use relief_models::bisector::Lattice;
//! use relief_models::map::{HeightMap, Procedural};
//! let map = HeightMap::procedural(Procedural::Peaks, 65, 65);
//! let ground = Ground { lattice: Lattice::of(65, 65, false).unwrap(), samples: &map.samples };
//! let bound: Tolerance = "655.35".parse()?;
//! let (split, fit) = (unfitted(&ground, bound), fitted(&ground, bound, 2, &()));
//! let plain = map.samples.iter().map(|&sample| u32::from(sample) << 4).collect::<Vec<_>>();
//! let (before, after) = (measure(&ground, &split, &plain), measure(&ground, &fit.split, &fit.heights));
//! assert!(before.maximum.is_within(bound) && after.maximum.is_within(bound) && after.triangles < before.triangles);
//! # Ok::<(), String>(())
//! ```

mod fit;
mod flip;
mod folder;
mod manifest;
mod measure;
mod normals;
mod picture;
mod read_folder;
mod saturated;
mod surface;
mod tolerance;
mod unfitted;
mod voids;

pub use fit::{Fitted, fitted};
pub use flip::{Flip, fitted_from_best_corner, flip, unflip};
pub use folder::{Baked, hash, is_ours};
pub use manifest::{ErrorsEntry, FORMAT, Manifest, MapEntry, NormalsEntry, SplitEntry, SumsEntry, VERSION};
pub use measure::{Measured, measure};
pub use normals::normals;
pub use saturated::{MOST_FRACTION_BITS, Saturated, saturated};
pub use surface::{Excess, Ground};
pub use tolerance::Tolerance;
pub use unfitted::{unfitted, unfitted_with_seams};
pub use voids::{Filled, fill};
