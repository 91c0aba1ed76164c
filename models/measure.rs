// SPDX-License-Identifier: MIT OR Apache-2.0
//! How far a triangle mesh is from a height map, or from another mesh.
//!
//! | measure | of what | how |
//! |---|---|---|
//! | [`heights`] | a mesh in sample coordinates and a map | the vertical error at every sample, exactly located |
//! | [`surface`] | two meshes, or a mesh and a map | distances both ways from points strewn over each surface |
//!
//! In sample coordinates x is the column, y the row and z the value of the map: what
//! [`TriangleMesh`](crate::mesh::TriangleMesh) holds of a height field.

mod edges;
mod heights;
mod nearest;
mod side;
mod surface;

pub use heights::{BoundAt, Heights, heights, heights_under};
pub use side::Side;
pub use surface::{Amount, Both, OneWay, Sampling, Surface, surface};

/// Why something cannot be measured: a sentence that says what is wrong and what would be right.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct MeasureError(String);

impl MeasureError {
    fn new(message: impl Into<String>) -> MeasureError {
        MeasureError(message.into())
    }
}
