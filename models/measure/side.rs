// SPDX-License-Identifier: MIT OR Apache-2.0
//! A surface that is measured: a mesh, or a map as the mesh of all its samples.

use super::MeasureError;
use crate::map::HeightMap;
use crate::mesh::TriangleMesh;
use crate::uniform;

/// Products of four coordinates stay within the range of a double, and those of two differences far from its end.
const MAGNITUDES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// One of the two surfaces.
#[derive(Clone, Copy, Debug)]
pub enum Side<'a> {
    /// The triangles of a mesh.
    Mesh(&'a TriangleMesh),
    /// Two triangles a cell, in sample coordinates, cut from the first sample of the cell to the last.
    Map(&'a HeightMap),
}

impl Side<'_> {
    /// Refuses what has no surface or no usable coordinates.
    pub(super) fn examine(&self) -> Result<(), MeasureError> {
        let mesh = match self {
            Side::Map(map) if map.width < 2 || map.height < 2 => {
                let size = format!("{} x {}", map.width, map.height);
                return Err(MeasureError::new(format!("a map of {size} samples is no surface; 2 x 2 are the least")));
            }
            Side::Map(_) => return Ok(()),
            Side::Mesh(mesh) => mesh,
        };
        let count = mesh.positions.len();
        if mesh.triangles.is_empty() {
            return Err(MeasureError::new("a mesh without a triangle is no surface"));
        }
        if let Some(wrong) = mesh.triangles.iter().flatten().find(|at| **at as usize >= count) {
            return Err(MeasureError::new(format!("a mesh names vertex {wrong}, but has {count}, counted from 0")));
        }
        let largest = mesh.positions.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
        // A maximum passes over what is no number.
        let largest = if mesh.positions.iter().flatten().any(|value| value.is_nan()) { f64::NAN } else { largest };
        if !MAGNITUDES.contains(&largest) {
            let message = format!("a mesh with a coordinate of {largest:e} cannot be measured; 1e-60 to 1e60 can");
            return Err(MeasureError::new(message));
        }
        Ok(())
    }

    /// Number of triangles.
    pub(super) fn triangles(&self) -> usize {
        match self {
            Side::Mesh(mesh) => mesh.triangles.len(),
            Side::Map(map) => 2 * (map.width - 1) * (map.height - 1),
        }
    }

    /// The corners of triangle `index`.
    pub(super) fn corners(&self, index: usize) -> [[f64; 3]; 3] {
        match self {
            Side::Mesh(mesh) => mesh.corners(mesh.triangles[index]),
            Side::Map(map) => {
                let (cell, columns) = (index / 2, map.width - 1);
                let (i, j) = (cell % columns, cell / columns);
                uniform::halves([i, i + 1], [j, j + 1])[index % 2].map(|at| point(map, at))
            }
        }
    }

    /// Number of vertices.
    pub(super) fn vertices(&self) -> usize {
        match self {
            Side::Mesh(mesh) => mesh.positions.len(),
            Side::Map(map) => map.samples.len(),
        }
    }

    /// Vertex `index`.
    pub(super) fn vertex(&self, index: usize) -> [f64; 3] {
        match self {
            Side::Mesh(mesh) => mesh.positions[index],
            Side::Map(map) => point(map, [index % map.width, index / map.width]),
        }
    }
}

fn point(map: &HeightMap, [i, j]: [usize; 2]) -> [f64; 3] {
    [i as f64, j as f64, f64::from(map.sample(i, j))]
}
