// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a mesh is worth: its error at every sample, beside what its method claims.

use super::Tessellation;
use relief_models::map::HeightMap;
use relief_models::measure::{Heights, MeasureError, heights, heights_under};
use relief_models::mesh::Progress;
use relief_models::vertex_cache::{ENTRIES, misses};

/// Whether a mesh is what its method says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The mesh is whole, and at every sample so far below its claim, in map units.
    Holds {
        /// Claim less error.
        slack: f64,
    },
    /// The mesh is whole, and nothing is claimed.
    NoClaim,
    /// The mesh has an error above its claim, or gaps, folds or triangles without area.
    Broken,
}

impl Verdict {
    /// One or two words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Holds { .. } => "holds",
            Self::NoClaim => "no claim",
            Self::Broken => "BROKEN",
        }
    }
}

/// A mesh against its map.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Errors, and whether the mesh is whole.
    pub heights: Heights,
    /// Whether the claim holds.
    pub verdict: Verdict,
    /// Misses of a cache of [`ENTRIES`] vertices, in the order of the triangles.
    pub cache_misses: u64,
}

/// Doubles that evaluate a plane of integers are off by less than this; a claim is exact.
const ROUNDING: f64 = 1e-9;

/// Whether a mesh keeps a claim.
pub fn verdict(heights: &Heights, claim: Option<f64>) -> Verdict {
    match claim {
        _ if !heights.is_whole() => Verdict::Broken,
        None => Verdict::NoClaim,
        Some(claim) if heights.max <= claim + ROUNDING => Verdict::Holds { slack: (claim - heights.max).max(0.0) },
        Some(_) => Verdict::Broken,
    }
}

impl Tessellation {
    /// Measures the mesh at every sample of the map that it was made of.
    ///
    /// # Errors
    /// A sentence: the mesh is none over this map.
    pub fn measure(&self, map: &HeightMap, progress: &dyn Progress) -> Result<Measured, MeasureError> {
        let (heights, verdict) = match self.growing {
            None => {
                let heights = heights(&self.mesh, map, progress)?;
                let verdict = verdict(&heights, self.claim);
                (heights, verdict)
            }
            Some(growing) => {
                let (heights, slack) = heights_under(&self.mesh, map, &|sample| growing.at(sample), progress)?;
                let holds = heights.is_whole() && slack >= -ROUNDING;
                (heights, if holds { Verdict::Holds { slack: slack.max(0.0) } } else { Verdict::Broken })
            }
        };
        Ok(Measured { heights, verdict, cache_misses: misses(&self.mesh.triangles, ENTRIES) })
    }
}
