// SPDX-License-Identifier: MIT OR Apache-2.0
//! The fields of a scene file as they stand there. `serde` refuses unknown ones by name.

use serde::Deserialize;
use toml::Spanned;

use crate::body::UvSource;
use crate::map::{Procedural, Wrap};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Scene {
    pub(super) camera: Spanned<Camera>,
    #[serde(default)]
    pub(super) remesh: Remesh,
    #[serde(default)]
    pub(super) object: Vec<Spanned<Object>>,
    #[serde(default)]
    pub(super) light: Vec<Light>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Camera {
    pub(super) eye: [f64; 3],
    #[serde(default)]
    pub(super) target: [f64; 3],
    pub(super) up: Option<[f64; 3]>,
    pub(super) fov_y_deg: Option<f64>,
    pub(super) near: Option<f64>,
    pub(super) far: Option<f64>,
    pub(super) viewport: Option<[i64; 2]>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Remesh {
    pub(super) cell_px: Option<f64>,
    pub(super) cull: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Object {
    pub(super) mesh: Mesh,
    pub(super) map: Map,
    pub(super) displacement: Option<[f64; 2]>,
    pub(super) wrap: Option<[Wrap; 2]>,
    #[serde(default)]
    pub(super) at: [f64; 3],
    pub(super) colour: Option<[f64; 3]>,
}

/// A body or a file; which of the fields belong together is decided when it is resolved.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Mesh {
    pub(super) kind: Option<Kind>,
    pub(super) cells: Option<[i64; 2]>,
    pub(super) size: Option<[f64; 2]>,
    pub(super) radius: Option<f64>,
    pub(super) height: Option<f64>,
    pub(super) file: Option<String>,
    pub(super) uv: Option<UvSource>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Grid,
    Cylinder,
    Sphere,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Map {
    pub(super) kind: Option<Procedural>,
    pub(super) size: Option<[i64; 2]>,
    pub(super) file: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Light {
    pub(super) direction: [f64; 3],
}
