// SPDX-License-Identifier: MIT OR Apache-2.0
//! A base mesh from an OBJ file.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use serde::Deserialize;

use super::corners::{Corner, Statements, parse};
use super::weld::{Welder, key};
use super::{BaseMesh, BaseMeshVertex, normals, spherical};
use crate::mesh::{InputError, Place};

/// Bytes of a file; a base mesh at the limit of its triangles takes half of it.
const FILE_BYTES: u64 = 256 << 20;

/// Where `u` and `v` come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum UvSource {
    /// From the texture vertices (`vt`) of the file.
    #[default]
    File,
    /// Longitude and colatitude round the centroid of the vertices.
    Spherical,
}

/// Reads the base mesh in the file `path`; with it come warnings to print.
pub fn read_obj(path: &Path, uv: UvSource) -> Result<(BaseMesh, Vec<String>), InputError> {
    let name = path.display().to_string();
    let fail = |message: String| InputError::new(&name, Place::File, message);
    let open = |error: std::io::Error| fail(format!("cannot be opened: {error}"));
    let file = File::open(path).map_err(open)?;
    if file.metadata().map_err(open)?.is_dir() {
        return Err(fail("is a folder; an OBJ file is expected".into()));
    }
    let mut bytes = Vec::new();
    file.take(FILE_BYTES + 1).read_to_end(&mut bytes).map_err(|error| fail(format!("cannot be read: {error}")))?;
    if bytes.len() as u64 > FILE_BYTES {
        return Err(fail(format!("is beyond the limit of {FILE_BYTES} bytes; a base mesh is a coarse one")));
    }
    read_obj_from(&bytes, &name, uv)
}

/// Reads a base mesh from the bytes of an OBJ file, which errors call `name`; what [`read_obj`] does once it has them.
pub fn read_obj_from(bytes: &[u8], name: &str, uv: UvSource) -> Result<(BaseMesh, Vec<String>), InputError> {
    let fail = |message: String| InputError::new(name, Place::File, message);
    let statements = parse(bytes, name)?;
    if statements.triangles.is_empty() {
        return Err(fail("has no face (`f`); a base mesh needs one at least".into()));
    }
    let mut warnings = Vec::new();
    let corners = place_and_normal(&statements, &mut warnings).map_err(fail)?;
    let mesh = match uv {
        UvSource::Spherical => spherical::wrap(&corners).map_err(fail)?,
        UvSource::File => {
            let mut welder = Welder::default();
            for (triangle, corners) in statements.triangles.iter().zip(&corners) {
                let [a, b, c] = *triangle;
                let (Some(a), Some(b), Some(c)) = (statements.uv(a), statements.uv(b), statements.uv(c)) else {
                    let what = "has a face without texture vertices (`vt`), so nothing says where the map lies";
                    return Err(fail(format!(
                        "{what}; `uv = \"spherical\"` in the scene asks for longitude and latitude"
                    )));
                };
                let mut uvs = [a, b, c].into_iter();
                let vertex = |(position, normal)| uvs.next().map(|uv| BaseMeshVertex { position, normal, uv });
                if let [Some(a), Some(b), Some(c)] = corners.map(vertex) {
                    welder.triangle([a, b, c]);
                }
            }
            welder.mesh
        }
    };
    Ok((mesh, warnings))
}

/// Position and normal of every corner: the file's normals if all corners have one, else those of the surface.
fn place_and_normal(statements: &Statements, warnings: &mut Vec<String>) -> Result<Vec<[(DVec3, DVec3); 3]>, String> {
    let place = |corner: Corner| statements.positions[corner.position as usize];
    let all = || statements.triangles.iter().flatten();
    let given = all().filter(|corner| corner.normal.is_some()).count();
    if given == all().count() {
        let mut first = FxHashMap::default();
        let mut creases = FxHashSet::default();
        let corners = statements.triangles.iter().map(|triangle| {
            triangle.map(|corner| {
                let (place, normal) = (place(corner), statements.normal(corner).unwrap_or(DVec3::Z));
                if *first.entry(key(place)).or_insert(normal) != normal {
                    creases.insert(key(place));
                }
                (place, normal)
            })
        });
        let corners = corners.collect();
        if !creases.is_empty() {
            let what = "more than one normal (`vn`), and the displaced surface tears there";
            warnings.push(format!("{} places have {what}; without `vn` they get one each", creases.len()));
        }
        return Ok(corners);
    }
    if given > 0 {
        warnings.push("some corners have no normal (`vn`), so all normals are computed from the surface".into());
    }
    let places: Vec<[DVec3; 3]> = statements.triangles.iter().map(|triangle| triangle.map(place)).collect();
    let normals = normals::by_place(&places).map_err(|place| {
        let what = "no normal: the triangles round it have no area, or cancel";
        format!("{place} has {what}; give normals (`vn`), or take the doubled faces away")
    })?;
    Ok(places.into_iter().map(|corners| corners.map(|place| (place, normals[&key(place)]))).collect())
}
