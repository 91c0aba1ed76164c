// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scene files: a camera, bodies with height maps, and lights, as TOML; `docs/scene.md` lists every field.
//!
//! ```text
//! [camera]
//! eye = [0.0, -3.2, 1.6]
//! [[object]]
//! mesh = { kind = "grid", cells = [8, 8], size = [2.0, 1.7] }
//! map = { file = "maps/jacksboro.png" }        # relative to the scene file
//! displacement = [0.0, 0.35]                   # world units for the samples 0 and 65535
//! ```
//!
//! [`read`] resolves all files and checks every value, so that nothing is left that could go wrong later for the scene's
//! sake: a scene is an error of one sentence, or it can be drawn.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use glam::DVec3;

use crate::body::BaseMesh;
use crate::map::{HeightMap, Wrap};
use crate::mesh::{InputError, Place};
use crate::rules::Rules;

mod base;
mod camera;
mod draws;
mod fields;
mod heights;
mod numbers;
mod object;
mod source;

pub use source::{Entry, Source};

/// Bytes of a scene file.
const FILE_BYTES: u64 = 1 << 20;
/// Objects and lights of a scene.
const ITEMS: usize = 64;

/// A scene whose values are all in range and whose files have all been read.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Where from, and where to.
    pub camera: Camera,
    /// How finely.
    pub remesh: Remesh,
    /// What is seen; at least one.
    pub objects: Vec<Object>,
    /// What shines on it; at least one.
    pub lights: Vec<Light>,
    /// Sentences for the user about what is not wrong but may surprise.
    pub warnings: Vec<String>,
    /// Where it all stands, for further messages.
    pub source: Source,
}

/// A pinhole camera. `x` of the picture goes to the right, `y` down, `z` away from the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole.
    pub eye: DVec3,
    /// What the middle of the picture shows; not the eye.
    pub target: DVec3,
    /// What is up in the picture; not along the view.
    pub up: DVec3,
    /// Angle between the upper and the lower rim, in degrees; between 0 and 180.
    pub fov_y_deg: f64,
    /// Distance of the near plane; more than 0.
    pub near: f64,
    /// Distance of the far plane; more than `near`.
    pub far: f64,
    /// Width and height of the picture in pixels, each 1 to 4096.
    pub viewport: [u32; 2],
}

/// Settings of the remesher.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remesh {
    /// Side of a grid cell in pixels, 1 to 64.
    pub cell_px: f64,
    /// Whether base triangles that cannot be seen are left out.
    pub cull: bool,
    /// Levels that a map has at most, level 0 included; a scene file leaves them all.
    pub levels: usize,
    /// How a vertex finds its height.
    pub rules: Rules,
}

/// A base mesh with the map that displaces it.
#[derive(Clone, Debug)]
pub struct Object {
    /// Base triangles; `u` and `v` within two periods, from 0, and within one on a clamp axis.
    pub mesh: BaseMesh,
    /// The map.
    pub map: HeightMap,
    /// File or formula of the map, as the scene calls it.
    pub map_name: String,
    /// Displacement along the normal for the samples 0 and 65535, in world units; the first is not the greater.
    pub displacement: [f64; 2],
    /// What is beyond the rim of the map in u and in v. A repeat axis has an even period.
    pub wrap: [Wrap; 2],
    /// Whether `v = 0` and `v = 1` are poles: a row of the map each, but one point of the body.
    pub poles: bool,
    /// Red, green and blue of its surface, 0 to 1; none for the colours of terrain, by height.
    pub colour: Option<[f64; 3]>,
}

/// Light from far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Towards the light, of length 1.
    pub direction: DVec3,
}

/// Reads the scene in the file `path` and the files that it names.
pub fn read(path: &Path) -> Result<Scene, InputError> {
    let name = path.display().to_string();
    let fail = |message: String| InputError::new(&name, Place::File, message);
    let open = |error: std::io::Error| fail(format!("cannot be opened: {error}"));
    let file = File::open(path).map_err(open)?;
    if file.metadata().map_err(open)?.is_dir() {
        return Err(fail("is a folder; a scene file (TOML) is expected".into()));
    }
    let mut bytes = Vec::new();
    file.take(FILE_BYTES + 1).read_to_end(&mut bytes).map_err(|error| fail(format!("cannot be read: {error}")))?;
    if bytes.len() as u64 > FILE_BYTES {
        return Err(fail(format!("is beyond the limit of {FILE_BYTES} bytes; a scene file (TOML) is expected")));
    }
    let text =
        String::from_utf8(bytes).map_err(|_| fail("is no text (UTF-8); a scene file (TOML) is expected".into()))?;
    parse(&text, &name, path.parent().unwrap_or(Path::new("")))
}

/// Reads a scene from its text. Errors call it `name`; the files that it names are relative to `folder`.
pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Scene, InputError> {
    let scene = source::fields_of(text, name)?;
    let source = Source::new(name, text, &scene);
    for (what, count) in [("object", scene.object.len()), ("light", scene.light.len())] {
        if count > ITEMS {
            return Err(source.whole(format!("has {count} [[{what}]] entries, beyond the limit of {ITEMS}")));
        }
    }
    if scene.object.is_empty() {
        return Err(source.whole("has no [[object]]; at least one, with `mesh` and `map`, is expected"));
    }
    let mut warnings = Vec::new();
    // What can be told without opening another file comes first.
    let (camera, warning) =
        camera::resolve(scene.camera.get_ref()).map_err(|message| source.error(Entry::Camera, message))?;
    warnings.extend(warning.map(|warning| source.error(Entry::Camera, warning).to_string()));
    let settings = scene.remesh.as_ref().map(|remesh| remesh.get_ref());
    let remesh = camera::resolve_remesh(settings).map_err(|message| source.error(Entry::Remesh, message))?;
    let lights =
        camera::resolve_lights(&scene.light).map_err(|(at, message)| source.error(Entry::Light(at), message))?;
    let mut objects = Vec::with_capacity(scene.object.len());
    for (index, object) in scene.object.iter().enumerate() {
        let object =
            object::resolve(object.get_ref(), folder, camera.eye, &mut warnings).map_err(|error| match error {
                object::Error::Value(message) => source.error(Entry::Object(index), message),
                object::Error::File(error) => error,
            })?;
        objects.push(object);
    }
    Ok(Scene { camera, remesh, objects, lights, warnings, source })
}
