// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads the triangles of a binary glTF file: of the default scene, or the first one, placed by its nodes.
//!
//! The crate `gltf` takes the file apart and checks every reference in it; what is read here is the binary chunk alone.
//! Needed are positions in floats. Materials, skins and morph targets are skipped, points and lines too.

use std::io::Read;

use glam::{DMat4, DVec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::Mode;
use gltf::{Accessor, Gltf, Primitive, Semantic};

use super::build::{Indexed, Run};
use super::exact::{Radix, Scaled};
use super::{InputError, Place, Progress, Source};

/// A GLB tells its length in 32 bits.
const MOST_BYTES: u64 = u32::MAX as u64;
/// A file whose nodes repeat its meshes more often than this many times its bytes is meant to fill the memory.
const MOST_REPEATED: usize = 16;

pub(super) fn read(source: Source<'_>, progress: &dyn Progress) -> Result<Indexed, InputError> {
    let Source { name, size, bytes, .. } = source;
    progress.phase("reading", size);
    let fail = |message: String| InputError::new(name, Place::File, message);
    let mut all = Vec::new();
    bytes.take(MOST_BYTES + 1).read_to_end(&mut all).map_err(|error| fail(format!("cannot be read: {error}")))?;
    progress.advance(all.len() as u64);
    examine_header(&all).map_err(fail)?;
    let broken = |error: gltf::Error| fail(format!("is no whole glTF 2.0 file: {error}"));
    // The crate's validation looks for limits in the accessors of positions before it knows that they are there.
    let loose = Gltf::from_slice_without_validation(&all).map_err(broken)?;
    let root = loose.as_json();
    let attributes = root.meshes.iter().flat_map(|mesh| &mesh.primitives).flat_map(|part| part.attributes.values());
    if let Some(missing) = attributes.map(|index| index.value()).find(|index| *index >= root.accessors.len()) {
        let count = root.accessors.len();
        return Err(fail(format!(
            "is no whole glTF 2.0 file: it names accessor {missing}, counted from 0, of {count}"
        )));
    }
    let gltf = Gltf::from_slice(&all).map_err(broken)?;
    let mut reader = Reader {
        bytes: gltf.blob.as_deref().unwrap_or_default(),
        budget: all.len().saturating_mul(MOST_REPEATED),
        indexed: Indexed::new(Radix::Two),
    };
    let Some(scene) = gltf.default_scene().or_else(|| gltf.scenes().next()) else {
        return Err(fail("holds no scene; one with a mesh is expected".into()));
    };
    let mut visited = vec![false; gltf.nodes().len()];
    let mut stack: Vec<_> = scene.nodes().map(|node| (node, DMat4::IDENTITY)).collect();
    stack.reverse();
    while let Some((node, above)) = stack.pop() {
        if std::mem::replace(&mut visited[node.index()], true) {
            return Err(fail(format!("node {} stands at two places; nodes have to form trees", node.index())));
        }
        let own = node.transform().matrix().map(|column| column.map(f64::from));
        let place = above * DMat4::from_cols_array_2d(&own);
        for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
            let (mesh, part) = (node.mesh().map_or(0, |mesh| mesh.index()), primitive.index());
            reader
                .primitive(&primitive, &place)
                .map_err(|why| fail(format!("mesh {mesh}, primitive {part}: {why}")))?;
        }
        let below = stack.len();
        stack.extend(node.children().map(|child| (child, place)));
        stack[below..].reverse();
    }
    Ok(reader.indexed)
}

/// The twelve bytes at the head: the crate takes their length for granted.
fn examine_header(bytes: &[u8]) -> Result<(), String> {
    if bytes.len() as u64 > MOST_BYTES {
        return Err(format!("is beyond the limit of {MOST_BYTES} bytes"));
    }
    let head = bytes.first_chunk::<12>().filter(|head| head.starts_with(b"glTF"));
    let Some(head) = head else {
        return Err("is no binary glTF file (its first bytes say so); .glb is expected".into());
    };
    let length = u32::from_le_bytes([head[8], head[9], head[10], head[11]]);
    if length < 12 || u64::from(length) > bytes.len() as u64 {
        return Err(format!("says that it has {length} bytes, and has {}; it is cut off or broken", bytes.len()));
    }
    Ok(())
}

struct Reader<'a> {
    /// The binary chunk.
    bytes: &'a [u8],
    /// Vertices and corners that may still come.
    budget: usize,
    indexed: Indexed,
}

impl Reader<'_> {
    fn primitive(&mut self, primitive: &Primitive<'_>, place: &DMat4) -> Result<(), String> {
        match primitive.mode() {
            Mode::Triangles => {}
            Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => return Ok(()),
            Mode::TriangleStrip | Mode::TriangleFan => {
                return Err("is a strip or a fan; separate triangles are expected".into());
            }
        }
        let positions = primitive.get(&Semantic::Positions).ok_or("has no positions")?;
        if (positions.data_type(), positions.dimensions()) != (DataType::F32, Dimensions::Vec3) {
            return Err("has positions that are not three floats each".into());
        }
        let count = positions.count();
        let corners = primitive.indices().map_or(count, |indices| indices.count());
        if !corners.is_multiple_of(3) {
            return Err(format!("has {corners} corners; a multiple of three is expected"));
        }
        let needed = count.saturating_add(corners);
        self.budget =
            self.budget.checked_sub(needed).ok_or("is one too many: the file repeats its meshes endlessly")?;
        let first = self.indexed.vertices.len();
        if first.saturating_add(count) >= u32::MAX as usize {
            return Err("is one mesh too many; 2^32 vertices are the limit".into());
        }
        self.indexed.has_room(corners / 3)?;
        let positions = elements(self.bytes, &positions)?;
        for index in 0..count {
            let [x, y, z] = [0, 4, 8].map(|at| f64::from(f32::from_le_bytes(positions.bytes(index, at))));
            let placed = place.transform_point3(DVec3::new(x, y, z)).to_array();
            let mut vertex = [Scaled::default(); 3];
            for (number, value) in vertex.iter_mut().zip(placed) {
                *number = Scaled::from_double(value)
                    .ok_or_else(|| format!("vertex {index} (counted from 0) is not at a finite place"))?;
            }
            self.indexed.vertices.push(vertex);
        }
        let numbers = match primitive.indices() {
            None => (0..count as u32).collect(),
            Some(indices) => self.indices(&indices)?,
        };
        if let Some(wrong) = numbers.iter().find(|number| **number as usize >= count) {
            return Err(format!("names vertex {wrong}, but there are {count}, counted from 0"));
        }
        let number = |at: u32| first as u32 + at;
        self.indexed.runs.push(Run { first: self.indexed.triangles.len(), base: None, place: Place::File });
        self.indexed.triangles.extend(numbers.as_chunks::<3>().0.iter().map(|corners| corners.map(number)));
        Ok(())
    }

    fn indices(&self, accessor: &Accessor<'_>) -> Result<Vec<u32>, String> {
        if accessor.dimensions() != Dimensions::Scalar {
            return Err("has indices that are no single numbers".into());
        }
        let kind = accessor.data_type();
        if !matches!(kind, DataType::U8 | DataType::U16 | DataType::U32) {
            return Err("has indices that are no whole numbers without sign".into());
        }
        let elements = elements(self.bytes, accessor)?;
        let index = |at: usize| match kind {
            DataType::U8 => u8::from_le_bytes(elements.bytes(at, 0)).into(),
            DataType::U16 => u16::from_le_bytes(elements.bytes(at, 0)).into(),
            _ => u32::from_le_bytes(elements.bytes(at, 0)),
        };
        Ok((0..accessor.count()).map(index).collect())
    }
}

struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
}

impl Elements<'_> {
    /// Bytes of an element from `at` on; [`elements`] has seen to it that they are there.
    fn bytes<const N: usize>(&self, index: usize, at: usize) -> [u8; N] {
        let start = index * self.stride + at;
        self.bytes[start..].first_chunk().copied().unwrap_or([0; N])
    }
}

/// The bytes of an accessor, all of them within the binary chunk.
fn elements<'a>(blob: &'a [u8], accessor: &Accessor<'_>) -> Result<Elements<'a>, String> {
    let view = accessor.view().filter(|_| accessor.sparse().is_none());
    let view = view.ok_or("has sparse data, which is not supported")?;
    if !matches!(view.buffer().source(), gltf::buffer::Source::Bin) {
        return Err("has its data in another file; all of it is expected in the .glb".into());
    }
    let stride = view.stride().unwrap_or(accessor.size());
    let outside = || "reaches beyond the binary chunk of the file".to_owned();
    let end = view.offset().checked_add(view.length());
    let view = end.and_then(|end| blob.get(view.offset()..end)).ok_or_else(outside)?;
    let bytes = view.get(accessor.offset()..).ok_or_else(outside)?;
    let needed = match accessor.count().checked_sub(1) {
        None => Some(0),
        Some(last) => last.checked_mul(stride).and_then(|bytes| bytes.checked_add(accessor.size())),
    };
    if needed.is_none_or(|needed| needed > bytes.len()) {
        return Err(outside());
    }
    Ok(Elements { bytes, stride })
}
