// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangle meshes as the remesher leaves them: readers, and the checker that proves a tiling.
//!
//! A mesh is a set of triangles whose vertices are identified by **exact coordinates**: two computations of one vertex
//! that differ in a bit are two vertices, and show as open edges. [`read`] takes four kinds of file:
//!
//! | file | numbers | base triangles |
//! |------|---------|----------------|
//! | text ([`Format::Text`]) | integers over `scale`; decimals in `b` lines | its own `b` lines |
//! | Wavefront OBJ           | decimals, taken as they are written           | faces of a second file; groups `base_<I>` |
//! | PLY, ascii or binary    | decimals, or binary floats taken bit by bit   | the same; face property `base` |
//! | GLB, binary glTF 2.0    | binary floats taken bit by bit, then placed by the nodes | faces of a second file, if it has one |
//!
//! ```text
//! scale 4096                                    # emitted coordinates are integers over 4096
//! b 0  0 0 0  2 0 0  0 2.5 0                    # base triangle 0, corners in winding order, in whole units
//! t 0  0 0 0  8192 0 0  0 10240 0               # an emitted triangle of base triangle 0
//! ```
//!
//! A [`TriangleMesh`] is the same file in doubles, to be measured or written.
//!
//! [`check`] reports what it finds as a [`Report`]. All decisions are exact: see `mesh/exact.rs` and `mesh/points.rs`.
//!
//! ```
//! use relief_models::mesh::{Builder, CheckOptions, check};
//! let mut builder = Builder::new("square", 1);
//! builder.base(0, [[0, 0, 0], [2, 0, 0], [0, 2, 0]])?;
//! builder.triangle(0, [[0, 0, 0], [1, 0, 0], [0, 2, 0]])?;
//! builder.triangle(0, [[1, 0, 0], [2, 0, 0], [0, 2, 0]])?;
//! let report = check(&builder.finish()?, &CheckOptions::default(), &());
//! assert_eq!(report.to_string(), "1 base triangle, 2 triangles, 0 shared base edges: OK\n");
//! # Ok::<(), relief_models::mesh::InputError>(())
//! ```

use std::fmt;
use std::fs::File;
use std::io::Read;
use std::path::Path;

mod blocks;
mod build;
mod check;
mod edges;
mod exact;
pub(crate) mod fields;
mod points;
mod read_glb;
pub(crate) mod read_obj;
mod read_ply;
mod read_text;
mod report;
mod rims;
mod t_vertices;
mod triangle_mesh;
mod triangles;
mod write;

pub use build::Builder;
pub use check::{CheckOptions, Tolerance, check};
pub use report::{Failure, FailureKind, Report};
pub use triangle_mesh::TriangleMesh;
pub use write::WriteError;

pub(crate) use build::Interner;

use build::Indexed;
use points::Points;

/// A mesh, with or without the base triangles that it has to tile.
#[derive(Debug)]
pub struct Mesh {
    points: Points,
    /// Vertices of each triangle; ascending by base triangle where there are bases.
    triangles: Vec<[u32; 3]>,
    /// `None` for a mesh that is judged by itself.
    bases: Option<Bases>,
}

/// The base triangles of a mesh and which triangles are theirs.
#[derive(Debug)]
struct Bases {
    /// The number by which the file calls each base triangle.
    names: Vec<u32>,
    corners: Vec<[u32; 3]>,
    /// Triangles `first[i]..first[i + 1]` belong to base triangle `i`.
    first: Vec<u32>,
}

impl Mesh {
    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Number of base triangles, or `None` for a mesh without.
    pub fn base_triangles(&self) -> Option<usize> {
        self.bases.as_ref().map(|bases| bases.names.len())
    }
}

/// Where in a file something is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line, the first being 1.
    Line(u64),
    /// A byte offset of a binary file, the first being 0.
    Byte(u64),
}

/// Why a file cannot be read as a mesh, a map or a scene: `file:line: sentence`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}{}: {message}", Suffix(*.place))]
pub struct InputError {
    /// The file, as the caller named it.
    pub file: String,
    /// Where in the file.
    pub place: Place,
    /// What is wrong there and what would be right.
    pub message: String,
}

struct Suffix(Place);

impl fmt::Display for Suffix {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Place::File => Ok(()),
            Place::Line(line) => write!(formatter, ":{line}"),
            Place::Byte(byte) => write!(formatter, ": byte {byte}"),
        }
    }
}

impl InputError {
    pub(crate) fn new(file: &str, place: Place, message: impl Into<String>) -> InputError {
        InputError { file: file.to_owned(), place, message: message.into() }
    }
}

/// Kind of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// The text format of `scale`, `b` and `t` lines.
    Text,
    /// Wavefront OBJ.
    Obj,
    /// PLY, ascii or binary.
    Ply,
    /// Binary glTF 2.0.
    Glb,
}

impl Format {
    /// The format that a file's extension stands for: `.obj`, `.ply`, `.glb`, and text for everything else.
    pub fn of(path: &Path) -> Format {
        match path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("obj") => Format::Obj,
            Some("ply") => Format::Ply,
            Some("glb") => Format::Glb,
            _ => Format::Text,
        }
    }
}

/// Hears how far a long operation has come. `()` does not listen.
pub trait Progress: Sync {
    /// A phase begins; it ends with `done == total` steps (bytes, triangles or the like), or with the next phase.
    fn phase(&self, name: &'static str, total: u64);
    /// The current phase has done so many steps since it began.
    fn advance(&self, done: u64);
}

impl Progress for () {
    fn phase(&self, _name: &'static str, _total: u64) {}
    fn advance(&self, _done: u64) {}
}

/// Bytes to read a mesh from, with the name that errors call them.
pub struct Source<'a> {
    /// Name for error messages.
    pub name: &'a str,
    /// How to read the bytes.
    pub format: Format,
    /// Their number, for progress; 0 if it is not known.
    pub size: u64,
    /// The bytes.
    pub bytes: &'a mut dyn Read,
}

/// Reads the mesh in the file `path`, with the base triangles in the file `base` for OBJ, PLY and GLB.
pub fn read(path: &Path, base: Option<&Path>, progress: &dyn Progress) -> Result<Mesh, InputError> {
    let names = (path.display().to_string(), base.map(|base| base.display().to_string()).unwrap_or_default());
    let (mut file, size) = open(path, &names.0)?;
    let mesh = Source { name: &names.0, format: Format::of(path), size, bytes: &mut file };
    match base {
        None => read_from(mesh, None, progress),
        Some(base) => {
            let (mut file, size) = open(base, &names.1)?;
            let base = Source { name: &names.1, format: Format::of(base), size, bytes: &mut file };
            read_from(mesh, Some(base), progress)
        }
    }
}

fn open(path: &Path, name: &str) -> Result<(File, u64), InputError> {
    let fail = |error: std::io::Error| InputError::new(name, Place::File, format!("cannot be opened: {error}"));
    let file = File::open(path).map_err(fail)?;
    let metadata = file.metadata().map_err(fail)?;
    if metadata.is_dir() {
        return Err(InputError::new(name, Place::File, "is a folder; a mesh file is expected"));
    }
    Ok((file, metadata.len()))
}

/// Reads a mesh from bytes; what [`read`] does once the files are open.
pub fn read_from(mesh: Source<'_>, base: Option<Source<'_>>, progress: &dyn Progress) -> Result<Mesh, InputError> {
    if mesh.format == Format::Text {
        return match base {
            None => read_text::read(mesh, progress),
            Some(base) => {
                let message = format!("carries its own base triangles (`b` lines); leave {} away", base.name);
                Err(InputError::new(mesh.name, Place::File, message))
            }
        };
    }
    let (mesh_name, base_name) = (mesh.name, base.as_ref().map_or("", |base| base.name));
    let indexed = |source: Source<'_>| {
        if source.format == Format::Text {
            let message = "holds base triangles for an OBJ, PLY or GLB mesh, and has to be .obj, .ply or .glb too";
            return Err(InputError::new(source.name, Place::File, message));
        }
        indexed(source, progress)
    };
    // The base is the smaller file: its mistakes are told before the large one is read.
    let base: Option<Indexed> = base.map(indexed).transpose()?;
    build::assemble(indexed(mesh)?, mesh_name, base, base_name, progress)
}

/// Vertices and triangles of a file that is no text.
fn indexed(source: Source<'_>, progress: &dyn Progress) -> Result<Indexed, InputError> {
    match source.format {
        Format::Obj => read_obj::read(source, progress),
        Format::Ply => read_ply::read(source, progress),
        Format::Glb => read_glb::read(source, progress),
        Format::Text => {
            let message = "is neither .obj, .ply nor .glb; a mesh in one of these formats is expected";
            Err(InputError::new(source.name, Place::File, message))
        }
    }
}
