// SPDX-License-Identifier: MIT OR Apache-2.0
//! Objects: the body, its map, and whether the one fits the other.

use std::path::Path;

use glam::DVec3;

use super::numbers::{finite, short_vector, vector, within};
use super::{Object, base, fields, heights};
use crate::body::BaseMesh;
use crate::digits::short;
use crate::map::Wrap;
use crate::mesh::InputError;

/// A value of the scene that is wrong, or a file that it names.
pub(super) enum Error {
    Value(String),
    File(InputError),
}

impl From<String> for Error {
    fn from(message: String) -> Error {
        Error::Value(message)
    }
}

pub(super) fn resolve(
    object: &fields::Object,
    folder: &Path,
    eye: DVec3,
    warnings: &mut Vec<String>,
) -> Result<Object, Error> {
    let [low, high] = object.displacement.map_or([0.0, 0.1], |range| range.0);
    let displacement = [finite("displacement", low)?, finite("displacement", high)?];
    if low > high {
        let what = "has its greater value first";
        let [low, high] = [low, high].map(short);
        return Err(
            format!("`displacement` [{low}, {high}] {what}; [{high}, {low}] or an inverted map is expected").into()
        );
    }
    let at = vector("at", object.at.map_or([0.0; 3], |at| at.0))?;
    let colour = object.colour.map(|colour| colour.0);
    for part in colour.into_iter().flatten() {
        within("colour", part, 0.0, 1.0)?;
    }
    let mut body = base::resolve(&object.mesh, folder, warnings)?;
    let default = body.wrap.map(Option::unwrap_or_default);
    let wrap = object.wrap.map_or(default, |wrap| wrap.0);
    for axis in 0..2 {
        if let Some(expected) = body.wrap[axis].filter(|expected| *expected != wrap[axis]) {
            let (axis, why) = [("u", "meets itself in u"), ("v", "has poles at the ends of v")][axis];
            let expected = if expected == Wrap::Repeat { "repeat" } else { "clamp" };
            return Err(format!(
                "`wrap` in {axis} does not fit a {}, which {why}; \"{expected}\" is expected",
                body.name
            )
            .into());
        }
    }
    fit_uv(&mut body.mesh, wrap)?;
    for vertex in &mut body.mesh.vertices {
        vertex.position += at;
    }
    // A tube hides a camera where it is around more than half of it.
    if body.has_inside && body.mesh.winding_number(eye, high) > 0.5 {
        let what = format!("the camera's `eye` {} is inside, as far as the displacement reaches", short_vector(eye));
        return Err(format!("{what}; a place outside is expected").into());
    }
    let (map, map_name) = heights::resolve(&object.map, wrap, folder, warnings)?;
    Ok(Object { mesh: body.mesh, map, map_name, displacement, wrap, poles: body.poles, colour })
}

/// Moves `u` and `v` by whole periods to begin in the first one, and refuses what is then beyond the map.
fn fit_uv(mesh: &mut BaseMesh, wrap: [Wrap; 2]) -> Result<(), String> {
    for axis in 0..2 {
        let name = ["u", "v"][axis];
        let values = || mesh.vertices.iter().map(|vertex| vertex.uv[axis]);
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        if wrap[axis] == Wrap::Clamp {
            if low < 0.0 || high > 1.0 {
                let [low, high] = [low, high].map(short);
                let what = format!("its {name} goes from {low} to {high}, but the map ends at 0 and 1 where it clamps");
                return Err(format!("{what}; `wrap` \"repeat\" in {name} goes on"));
            }
            continue;
        }
        let first = low.floor();
        if high - first > 2.0 {
            let [low, high] = [low, high].map(short);
            let what = format!("its {name} goes from {low} to {high}, beyond the limit of two periods");
            return Err(format!("{what}; a map that holds the repetitions is expected"));
        }
        if first != 0.0 {
            for vertex in &mut mesh.vertices {
                vertex.uv[axis] -= first;
            }
        }
    }
    Ok(())
}
