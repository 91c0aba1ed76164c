// SPDX-License-Identifier: MIT OR Apache-2.0
//! Splits a base triangle into one-voxel triangles with a sweep-line, and sends them as beats of the [step port](crate::step).
//!
//! The algorithm is that of Gumhold & Huettner 1999, sections 3.3 and 3.4, with the amendments that make it a tiling for
//! every integer triangle (named where they are used). In short: a base edge of `n` voxels along its main axis has the
//! vertices `0..=n`, which are a function of its two ends only; between them, the vertices are the integer points of the
//! remeshing plane (axes *sweep* and *side*) that lie between the edges. The sweep-line runs from column to column of the
//! plane, and the ladder between two columns is one strip.
//!
//! Vertex data runs in fixed point: `guard_bits` below the input, one bit above it, two's complement, wrapping. A result
//! is right whenever its true value fits, so nothing saturates:
//!
//! ```text
//! accumulator = vertex * 2^g + j * D        D = floor(difference * 2^g / n + 1/2)
//! vertex sent = floor(accumulator / 2^g + 1/2) mod 2^W0         W = W0 + g + 1 bits of accumulator
//! ```
//!
//! | quantity             | format               | range                                                          |
//! |----------------------|----------------------|----------------------------------------------------------------|
//! | corner coordinate    | signed, 2..=24 bits  | whole                                                          |
//! | vertex data          | signed W0            | whole                                                          |
//! | accumulator          | signed W0+g+1        | wraps; W0+g+1 <= 64                                            |
//!
//! Error, in units of the last place of the vertex data, before the output rounding (which adds at most 1/2):
//! edge vertices `n * 2^-(g+1)`, interior ones `(|i|+|j|) * 2^-(g+1)` with (i,j) the grid offset from corner A. Only the
//! rounding of the differences counts, once per addition; the additions themselves are exact.
//!
//! Example, g = 4: an edge of 3 voxels from 0 to 10 has D = floor(160/3 + 1/2) = 53, and its vertices are
//! 0, 53/16 -> 3, 106/16 -> 7, 10 (the corner is snapped, 159/16 is never sent).

mod edge;
pub mod exact;
mod place;
mod port;
mod setup;
mod strips;
mod sweep;
mod walk;

pub use edge::EdgeSetup;
pub use place::{Place, Rung};
pub use setup::{Case, Setup};

use crate::step::{MAX_COMPONENTS, Step, Vertex};
use serde::{Deserialize, Serialize};

/// The widths of a remesher.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Format {
    /// Components of a vertex, `1..=16`.
    pub components: usize,
    /// Bits of one signed component of vertex data, `W0`, at least 2.
    pub vertex_bits: u32,
    /// Fraction bits below the vertex data in the accumulators, `g`; see the error bound of the module.
    pub guard_bits: u32,
    /// Bits of one signed grid coordinate, `2..=24`.
    pub coordinate_bits: u32,
    /// Interior vertices that the column memory of the strip unit holds; 0 is a strip unit without one.
    pub column_depth: usize,
}

/// What is wrong with a [`Format`] or a [`BaseTriangle`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FormatError {
    /// The number of components is outside `1..=16`.
    #[error("the remesher format has {0} components; a vertex has at least 1 and at most {MAX_COMPONENTS}")]
    Components(usize),
    /// Vertex data too narrow to be signed.
    #[error("the remesher format has vertices of {0} bits; a signed component takes at least 2")]
    VertexBits(u32),
    /// The accumulator is wider than the model's 64-bit words.
    #[error(
        "the remesher format needs accumulators of {vertex_bits} + {guard_bits} + 1 bits; the model holds at most 64, \
         so vertex_bits + guard_bits must not exceed 63"
    )]
    AccumulatorBits {
        /// The format's `vertex_bits`.
        vertex_bits: u32,
        /// The format's `guard_bits`.
        guard_bits: u32,
    },
    /// Grid coordinates outside `2..=24` bits.
    #[error("the remesher format has grid coordinates of {0} bits; 2 to 24 are supported")]
    CoordinateBits(u32),
    /// A corner's coordinate does not fit the format.
    #[error("coordinate {axis} of corner {corner} is {value}, which does not fit the format's {bits} signed bits")]
    Coordinate {
        /// Corner, `0..3`.
        corner: usize,
        /// Axis, `0..3`.
        axis: usize,
        /// The coordinate.
        value: i32,
        /// `coordinate_bits` of the format.
        bits: u32,
    },
    /// A corner's vertex data does not fit the format, or a component beyond `components` is not zero.
    #[error("component {component} of corner {corner} is {value}, but the format gives it {bits} signed bits")]
    Data {
        /// Corner, `0..3`.
        corner: usize,
        /// Component, `0..16`.
        component: usize,
        /// The component.
        value: i64,
        /// `vertex_bits` of the format; 0 for a component that the format does not have.
        bits: u32,
    },
}

impl Format {
    /// Bits of an accumulator, `W = W0 + g + 1`: the extra bit is for the difference of two vertices.
    pub const fn accumulator_bits(&self) -> u32 {
        self.vertex_bits.saturating_add(self.guard_bits).saturating_add(1)
    }

    /// Checks the widths against the ranges that their fields name.
    ///
    /// # Errors
    /// The first field outside its range.
    pub const fn validate(&self) -> Result<(), FormatError> {
        if self.components == 0 || self.components > MAX_COMPONENTS {
            return Err(FormatError::Components(self.components));
        }
        if self.vertex_bits < 2 {
            return Err(FormatError::VertexBits(self.vertex_bits));
        }
        if self.accumulator_bits() > 64 {
            return Err(FormatError::AccumulatorBits { vertex_bits: self.vertex_bits, guard_bits: self.guard_bits });
        }
        if self.coordinate_bits < 2 || self.coordinate_bits > 24 {
            return Err(FormatError::CoordinateBits(self.coordinate_bits));
        }
        Ok(())
    }
}

/// A base triangle: three corners on the voxel grid, in winding order, with their vertex data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BaseTriangle {
    /// Grid coordinates (x, y, z) of the corners, in voxels.
    pub corners: [[i32; 3]; 3],
    /// Vertex data of the corners, `vertex_bits` signed bits a component.
    pub data: [Vertex; 3],
}

impl BaseTriangle {
    /// Checks that every coordinate and component fits `format`, and `format` itself.
    ///
    /// # Errors
    /// The first width or value out of range.
    pub fn validate(&self, format: &Format) -> Result<(), FormatError> {
        format.validate()?;
        for corner in 0..3 {
            for axis in 0..3 {
                let (value, bits) = (self.corners[corner][axis], format.coordinate_bits);
                if crate::fixed::wrap(value.into(), bits) != i64::from(value) {
                    return Err(FormatError::Coordinate { corner, axis, value, bits });
                }
            }
            for component in 0..MAX_COMPONENTS {
                let value = self.data[corner][component];
                let used = component < format.components;
                if if used { crate::fixed::wrap(value, format.vertex_bits) != value } else { value != 0 } {
                    let bits = if used { format.vertex_bits } else { 0 };
                    return Err(FormatError::Data { corner, component, value, bits });
                }
            }
        }
        Ok(())
    }

    /// About how many triangles it becomes: twice its area in the remeshing plane, and half of its rim in voxels, for the
    /// triangles at the rim are no halves of voxels.
    pub fn estimate(&self) -> u64 {
        let [a, b, c] = self.corners.map(|corner| corner.map(i64::from));
        let side = |from: [i64; 3], to: [i64; 3]| [0, 1, 2].map(|axis| to[axis] - from[axis]);
        let (ab, ac, bc) = (side(a, b), side(a, c), side(b, c));
        let twice = [(0, 1), (1, 2), (2, 0)].map(|(u, v)| (ab[u] * ac[v] - ab[v] * ac[u]).unsigned_abs());
        let rim = [ab, ac, bc].map(|side| side.map(i64::unsigned_abs).into_iter().max().unwrap_or(0));
        twice.into_iter().max().unwrap_or(0) + rim.iter().sum::<u64>() / 2
    }
}

/// Sends the beats of `base` to `sink`, in order; the hardware sends the same ones, bit for bit.
///
/// Takes whatever [`BaseTriangle::validate`] accepts, at any shape: coincident and collinear corners are stitched too.
pub fn golden(format: &Format, base: &BaseTriangle, sink: &mut impl FnMut(&Step)) {
    sweep::run(format, base, &Setup::new(format, base), &mut place::Beats(sink));
}

/// As [`golden`], and tells with each beat where its vertices lie on the base triangle.
///
/// [`Rung::triangles`] gives the triangles of the sweep without the strip unit's decoding.
pub fn observe(format: &Format, base: &BaseTriangle, sink: &mut impl FnMut(&Step, &Rung)) {
    sweep::run(format, base, &Setup::new(format, base), &mut place::Watched(sink));
}
