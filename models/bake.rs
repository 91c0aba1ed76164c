// SPDX-License-Identifier: MIT OR Apache-2.0
//! Prepares a map for the bisector: split maps whose bound holds, heights fitted to it, saturated errors.

mod fit;
mod surface;
mod unfitted;

pub use surface::{Excess, Ground};
pub use unfitted::unfitted;
pub use fit::{Fitted, fitted};

use crate::bisector::{Lattice, SplitMap, golden};

/// A bound on the error, in map units: a fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tolerance {
    /// Numerator.
    pub over: u32,
    /// Denominator, 1 to 10,000.
    pub under: u32,
}

/// Triangles of a split map.
pub fn triangles(lattice: &Lattice, split: &SplitMap) -> u64 {
    golden(lattice, split, &mut |_| ()).triangles
}
