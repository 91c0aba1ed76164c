// SPDX-License-Identifier: MIT OR Apache-2.0
//! A mesh as programs pass it on: positions in doubles, triangles by the numbers of their vertices.

use std::path::Path;

use super::{Format, InputError, Place, Progress, Source, indexed, open};

/// An indexed triangle mesh.
///
/// A height field stands in sample coordinates: x is the column, y the row, z the value of the map. Its heights in
/// sixteenths are exact in doubles, and in the floats of GLB as well.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Vertices.
    pub positions: Vec<[f64; 3]>,
    /// Corners of each triangle, as places in `positions`.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Reads the mesh in the file `path`, which is OBJ, PLY or GLB by its extension.
    ///
    /// # Errors
    /// A sentence with its place: the file breaks a rule of its format, holds no triangle, or is of another format.
    pub fn read(path: &Path, progress: &dyn Progress) -> Result<TriangleMesh, InputError> {
        let name = path.display().to_string();
        let format = Format::of(path);
        // Before the file is opened, which may be large or no file at all.
        if format == Format::Text {
            let message = "is neither .obj, .ply nor .glb; a mesh in one of these formats is expected";
            return Err(InputError::new(&name, Place::File, message));
        }
        let (mut file, size) = open(path, &name)?;
        TriangleMesh::read_from(Source { name: &name, format, size, bytes: &mut file }, progress)
    }

    /// Reads a mesh from bytes; what [`TriangleMesh::read`] does once the file is open. Decimals become the nearest
    /// doubles.
    ///
    /// # Errors
    /// As [`TriangleMesh::read`].
    pub fn read_from(source: Source<'_>, progress: &dyn Progress) -> Result<TriangleMesh, InputError> {
        let name = source.name;
        let mesh = indexed(source, progress)?;
        if mesh.triangles.is_empty() {
            return Err(InputError::new(name, Place::File, "holds no face; a mesh of triangles is expected"));
        }
        let radix = mesh.radix;
        let position = |vertex: [super::exact::Scaled; 3]| vertex.map(|number| number.approximate(radix));
        Ok(TriangleMesh { positions: mesh.vertices.into_iter().map(position).collect(), triangles: mesh.triangles })
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// If one of them is no vertex; meshes that were read have none such.
    pub fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|vertex| self.positions[vertex as usize])
    }
}
