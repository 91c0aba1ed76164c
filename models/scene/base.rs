// SPDX-License-Identifier: MIT OR Apache-2.0
//! The body of an object: a shape or a file, and what it asks of the map.

use std::path::Path;

use super::fields::{self, Kind};
use super::numbers::{counts, positive};
use super::object::Error;
use crate::body::{BaseMesh, UvSource, read_obj};
use crate::map::Wrap;

/// Cells of a body along an axis.
const CELLS: u32 = 512;

/// What a body asks of the wraps: `None` leaves it to the scene.
pub(super) struct Body {
    pub(super) mesh: BaseMesh,
    pub(super) name: &'static str,
    pub(super) wrap: [Option<Wrap>; 2],
    pub(super) poles: bool,
    /// Whether it has an inside where a camera sees nothing.
    pub(super) has_inside: bool,
}

pub(super) fn resolve(mesh: &fields::Mesh, folder: &Path, warnings: &mut Vec<String>) -> Result<Body, Error> {
    let has = [
        ("cells", mesh.cells.is_some()),
        ("size", mesh.size.is_some()),
        ("radius", mesh.radius.is_some()),
        ("height", mesh.height.is_some()),
        ("uv", mesh.uv.is_some()),
    ];
    let only =
        |name: &str, wanted: &[&str]| match has.iter().find(|(field, is_there)| *is_there && !wanted.contains(field)) {
            Some((field, _)) => Err(format!("`{field}` is no field of the mesh {name}; it has {}", wanted.join(", "))),
            None => Ok(()),
        };
    let whose = "the limit of a body's cells along an axis";
    let cells = |low: [u32; 2], default: [i64; 2]| {
        counts("cells", mesh.cells.map_or(default, |cells| cells.0), low, CELLS, whose)
    };
    let radius = || positive("radius", mesh.radius.unwrap_or(0.5));
    let (file, kind) = match (&mesh.file, mesh.kind) {
        (Some(file), None) => (Some(file), Kind::Grid),
        (None, Some(kind)) => (None, kind),
        _ => {
            return Err("`mesh` has either a `kind` (\"grid\", \"cylinder\", \"sphere\") or a `file`"
                .to_owned()
                .into());
        }
    };
    if let Some(file) = file {
        only("file", &["uv"])?;
        let uv = mesh.uv.unwrap_or_default();
        let path = folder.join(file);
        let (mesh, mut notes) = read_obj(&path, uv).map_err(Error::File)?;
        warnings.extend(notes.drain(..).map(|note| format!("{}: {note}", path.display())));
        let poles = uv == UvSource::Spherical;
        let wrap = if poles { [Some(Wrap::Repeat), Some(Wrap::Clamp)] } else { [None; 2] };
        let has_inside = mesh.is_closed();
        return Ok(Body { mesh, name: "body with spherical uv", wrap, poles, has_inside });
    }
    Ok(match kind {
        Kind::Grid => {
            only("grid", &["cells", "size"])?;
            let [x, y] = mesh.size.map_or([1.0, 1.0], |size| size.0);
            let size = [positive("size", x)?, positive("size", y)?];
            let mesh = BaseMesh::grid(cells([1, 1], [8, 8])?, size);
            Body { mesh, name: "grid", wrap: [None; 2], poles: false, has_inside: false }
        }
        Kind::Cylinder => {
            only("cylinder", &["cells", "radius", "height"])?;
            let height = positive("height", mesh.height.unwrap_or(1.0))?;
            let mesh = BaseMesh::cylinder(cells([3, 1], [16, 2])?, radius()?, height);
            Body { mesh, name: "cylinder", wrap: [Some(Wrap::Repeat), None], poles: false, has_inside: true }
        }
        Kind::Sphere => {
            only("sphere", &["cells", "radius"])?;
            let mesh = BaseMesh::sphere(cells([3, 2], [16, 8])?, radius()?);
            Body { mesh, name: "sphere", wrap: [Some(Wrap::Repeat), Some(Wrap::Clamp)], poles: true, has_inside: true }
        }
    })
}
