// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writes a [`TriangleMesh`]: OBJ in the shortest decimals, PLY in binary doubles, GLB in floats.
//!
//! OBJ and PLY give every coordinate back bit by bit. GLB knows nothing but floats of 24 bits: heights in sixteenths
//! to 65,535 are exact there, other numbers are rounded to the nearest float. No axes are turned: z is z.

use std::collections::BTreeMap;
use std::io::{self, Write};

use gltf::json::validation::{Checked, USize64};
use gltf::json::{self, Index, Value, accessor, buffer};

use super::{Format, TriangleMesh};

/// Why a mesh cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The system refuses.
    #[error("cannot be written: {0}")]
    Output(#[from] io::Error),
    /// The mesh is none that the format can hold.
    #[error("the mesh {0}")]
    Mesh(String),
}

impl TriangleMesh {
    /// Writes the mesh as OBJ, binary PLY or GLB. Nothing is written of a mesh that is refused.
    ///
    /// # Errors
    /// A sentence: no triangle, a triangle without its vertex, a coordinate that the format cannot hold, the text format
    /// (which is one of integers), or the system.
    pub fn write(&self, format: Format, target: &mut dyn Write) -> Result<(), WriteError> {
        self.examine(format).map_err(WriteError::Mesh)?;
        match format {
            Format::Obj => self.write_obj(target)?,
            Format::Ply => self.write_ply(target)?,
            Format::Glb => self.write_glb(target)?,
            Format::Text => return Err(WriteError::Mesh("has to go into .obj, .ply or .glb".into())),
        }
        Ok(())
    }

    fn examine(&self, format: Format) -> Result<(), String> {
        if self.triangles.is_empty() {
            return Err("has no triangle; one at least is expected".into());
        }
        if self.positions.len() >= u32::MAX as usize || self.triangles.len() >= u32::MAX as usize / 3 {
            return Err("has 2^32 vertices or 2^32 / 3 triangles or more, which is not supported".into());
        }
        if let Some(wrong) = self.triangles.iter().flatten().find(|at| **at as usize >= self.positions.len()) {
            return Err(format!("names vertex {wrong}, but has {}, counted from 0", self.positions.len()));
        }
        // What OBJ is read back to, and what a float holds.
        let most = if format == Format::Glb { f64::from(f32::MAX) } else { 1e280 };
        let beyond =
            |(_, position): &(usize, &[f64; 3])| position.iter().any(|value| !(..=most).contains(&value.abs()));
        if let Some((at, position)) = self.positions.iter().enumerate().find(beyond) {
            return Err(format!("has vertex {at} (counted from 0) at {position:?}; numbers to {most:e} are expected"));
        }
        Ok(())
    }

    fn write_obj(&self, target: &mut dyn Write) -> io::Result<()> {
        for [x, y, z] in &self.positions {
            writeln!(target, "v {} {} {}", Decimal(*x), Decimal(*y), Decimal(*z))?;
        }
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|vertex| u64::from(vertex) + 1);
            writeln!(target, "f {a} {b} {c}")?;
        }
        Ok(())
    }

    fn write_ply(&self, target: &mut dyn Write) -> io::Result<()> {
        let (vertices, faces) = (self.positions.len(), self.triangles.len());
        write!(
            target,
            "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\n\
             property double z\nelement face {faces}\nproperty list uchar uint vertex_indices\nend_header\n"
        )?;
        for value in self.positions.iter().flatten() {
            target.write_all(&value.to_le_bytes())?;
        }
        for triangle in &self.triangles {
            target.write_all(&[3])?;
            for vertex in triangle {
                target.write_all(&vertex.to_le_bytes())?;
            }
        }
        Ok(())
    }

    fn write_glb(&self, target: &mut dyn Write) -> Result<(), WriteError> {
        let (vertex_bytes, index_bytes) = (12 * self.positions.len(), 12 * self.triangles.len());
        let total = vertex_bytes as u64 + index_bytes as u64;
        // 4096 bytes are more than what stands before them.
        if total + 4096 > u64::from(u32::MAX) {
            return Err(WriteError::Mesh(format!("takes {total} bytes in GLB, which holds 2^32; take .ply")));
        }
        let mut bytes = Vec::with_capacity(total as usize);
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for position in &self.positions {
            for (axis, value) in position.iter().enumerate() {
                let value = *value as f32;
                low[axis] = low[axis].min(value);
                high[axis] = high[axis].max(value);
                bytes.extend(value.to_le_bytes());
            }
        }
        for vertex in self.triangles.iter().flatten() {
            bytes.extend(vertex.to_le_bytes());
        }
        let root = describe(self, [low, high], [vertex_bytes, index_bytes]);
        let text = json::serialize::to_vec(&root).map_err(|error| WriteError::Output(io::Error::other(error)))?;
        let header = gltf::binary::Header { magic: *b"glTF", version: 2, length: 0 };
        let glb = gltf::binary::Glb { header, json: text.into(), bin: Some(bytes.into()) };
        glb.to_writer(target).map_err(|error| match error {
            gltf::Error::Io(error) => WriteError::Output(error),
            other => WriteError::Output(io::Error::other(other)),
        })
    }
}

/// The JSON of a file with one mesh, whose positions and indices stand one behind the other.
fn describe(mesh: &TriangleMesh, [low, high]: [[f32; 3]; 2], bytes: [usize; 2]) -> json::Root {
    let mut root = json::Root::default();
    root.asset.generator = Some("relief".into());
    let size = |bytes: usize| USize64(bytes as u64);
    let buffer = root.push(json::Buffer {
        byte_length: size(bytes[0] + bytes[1]),
        uri: None,
        extensions: None,
        extras: Default::default(),
    });
    let mut view = |offset: usize, length: usize, target| {
        root.push(buffer::View {
            buffer,
            byte_length: size(length),
            byte_offset: Some(size(offset)),
            byte_stride: None,
            target: Some(Checked::Valid(target)),
            extensions: None,
            extras: Default::default(),
        })
    };
    let views =
        [view(0, bytes[0], buffer::Target::ArrayBuffer), view(bytes[0], bytes[1], buffer::Target::ElementArrayBuffer)];
    let bounds = |corner: [f32; 3]| Some(Value::from(corner.map(f64::from).to_vec()));
    let accessor = |view, count: usize, component, kind| json::Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: size(count),
        component_type: Checked::Valid(accessor::GenericComponentType(component)),
        type_: Checked::Valid(kind),
        min: None,
        max: None,
        normalized: false,
        sparse: None,
        extensions: None,
        extras: Default::default(),
    };
    let positions = accessor(views[0], mesh.positions.len(), accessor::ComponentType::F32, accessor::Type::Vec3);
    let positions: Index<json::Accessor> =
        root.push(json::Accessor { min: bounds(low), max: bounds(high), ..positions });
    let count = 3 * mesh.triangles.len();
    let indices = root.push(accessor(views[1], count, accessor::ComponentType::U32, accessor::Type::Scalar));
    let primitive = json::mesh::Primitive {
        attributes: BTreeMap::from([(Checked::Valid(json::mesh::Semantic::Positions), positions)]),
        indices: Some(indices),
        material: None,
        mode: Checked::Valid(json::mesh::Mode::Triangles),
        targets: None,
        extensions: None,
        extras: Default::default(),
    };
    let primitives = vec![primitive];
    let mesh = root.push(json::Mesh { primitives, weights: None, extensions: None, extras: Default::default() });
    let node = root.push(json::Node { mesh: Some(mesh), ..Default::default() });
    root.scene = Some(root.push(json::Scene { nodes: vec![node], extensions: None, extras: Default::default() }));
    root
}

/// The shortest decimal that is nearest to no other double.
struct Decimal(f64);

impl std::fmt::Display for Decimal {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Decimal(value) = *self;
        let magnitude = value.abs();
        if value == 0.0 || (1e-5..1e17).contains(&magnitude) {
            write!(formatter, "{value}")
        } else {
            write!(formatter, "{value:e}")
        }
    }
}
