// SPDX-License-Identifier: MIT OR Apache-2.0
//! `bake.json`: what a folder holds.

use serde::{Deserialize, Serialize};

/// The word that says what kind of JSON this is.
pub const FORMAT: &str = "relief bake";
/// The version of the folder's format.
pub const VERSION: u32 = 1;

/// The manifest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// [`FORMAT`].
    pub format: String,
    /// [`VERSION`].
    pub version: u32,
    /// The map.
    pub map: MapEntry,
    /// log2 of the lattice's side.
    pub levels: u32,
    /// Whether the roots share the other diagonal.
    pub mirrored: bool,
    /// The split map, if there is one.
    pub split: Option<SplitEntry>,
    /// The saturated errors, if there are any.
    pub errors: Option<ErrorsEntry>,
    /// Sizes of the levels of the pyramids, if there are any.
    pub mips: Option<Vec<[usize; 2]>>,
    /// The summed-area table, if there is one.
    pub sums: Option<SumsEntry>,
    /// The normals, if there are any.
    pub normals: Option<NormalsEntry>,
}

/// The map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapEntry {
    /// Name of the file that it was read from, without folders.
    pub name: String,
    /// Samples in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Bits of a sample in that file.
    pub bits: u8,
    /// FNV-1a of the samples, 64 bits in hexadecimal.
    pub fnv1a: String,
    /// What said that a sample is void.
    pub void: Option<u16>,
    /// Samples that were void and have been filled.
    pub filled: usize,
}

/// The split map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplitEntry {
    /// The bound in map units: an integer, or a fraction.
    pub bound: String,
    /// Whether the heights are fitted; if not, they are the map's.
    pub fitted: bool,
    /// Whether the lattice counts columns, and rows, from the other end of the map.
    pub flipped: [bool; 2],
    /// Rounds of search.
    pub effort: Option<u32>,
    /// Triangles.
    pub triangles: u64,
    /// Numerator and denominator of the largest error, measured over all samples.
    pub maximum: [i64; 2],
    /// The same, for people.
    pub maximum_decimal: f64,
}

/// The saturated errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ErrorsEntry {
    /// An error is a multiple of 2^-`fraction_bits` map units.
    pub fraction_bits: u32,
    /// The largest one, in these units.
    pub largest: u16,
}

/// The summed-area table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SumsEntry {
    /// Bits of a sum, which wraps.
    pub bits: u32,
}

/// The normals.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NormalsEntry {
    /// Map units between two samples.
    pub spacing: f64,
}
