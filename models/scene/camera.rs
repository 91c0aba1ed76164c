// SPDX-License-Identifier: MIT OR Apache-2.0
//! Camera, remesher and lights: defaults and ranges.

use glam::DVec3;
use toml::Spanned;

use super::numbers::{counts, direction, finite, positive, short_vector, vector, within};
use super::{Camera, Light, Remesh, fields};
use crate::digits::short;
use crate::rules::Rules;

/// Pixels of a side of the picture: 13 bits of Q13.8 on either side of its centre.
const VIEWPORT: u32 = 4096;
/// Ratio of far and near beyond which 32 bits of depth are no longer fine everywhere.
const RATIO: f64 = 1e4;
const LIGHT: [f64; 3] = [-0.4, 0.3, 0.85];

/// The camera, and a warning if there is one.
pub(super) fn resolve(camera: &fields::Camera) -> Result<(Camera, Option<String>), String> {
    let (eye, target) =
        (vector("eye", camera.eye.0)?, vector("target", camera.target.map_or([0.0; 3], |target| target.0))?);
    let distance = (target - eye).length();
    if distance <= 1e-9 * (1.0 + eye.length()) {
        return Err(format!(
            "`eye` and `target` are both {}; two places are expected, to look from one to the other",
            short_vector(eye)
        ));
    }
    let up = vector("up", camera.up.map_or([0.0, 0.0, 1.0], |up| up.0))?;
    let up_direction = direction("up", up.to_array())?;
    if up_direction.cross((target - eye) / distance).length() <= 1e-9 {
        let up = short_vector(up);
        return Err(format!("`up` {up} is along the view from `eye` to `target`; a direction aside of it is expected"));
    }
    let fov_y_deg = finite("fov_y_deg", camera.fov_y_deg.unwrap_or(45.0))?;
    // The ends would give pixels no size, or an infinite one.
    if !(1e-3..=179.999).contains(&fov_y_deg) {
        return Err(format!(
            "`fov_y_deg` is {}; an angle between 0 and 180 degrees (0.001 to 179.999) is expected",
            short(fov_y_deg)
        ));
    }
    let (near, far) = match (camera.near, camera.far) {
        (Some(near), Some(far)) => (near, far),
        (Some(near), None) => (near, (20.0 * distance).max(100.0 * near)),
        (None, Some(far)) => ((0.1 * distance).min(0.01 * far), far),
        (None, None) => (0.1 * distance, 20.0 * distance),
    };
    let (near, far) = (positive("near", near)?, finite("far", far)?);
    if far <= near {
        let (far, near) = (short(far), short(near));
        return Err(format!("`far` is {far} and `near` {near}; a far plane behind the near one is expected"));
    }
    let whose = "the limit of the vertex format";
    let viewport =
        counts("viewport", camera.viewport.map_or([640, 480], |viewport| viewport.0), [1, 1], VIEWPORT, whose)?;
    let warning = (far > RATIO * near).then(|| {
        let ratio = short((far / near).round());
        format!("`far` is {ratio} times `near`; beyond {RATIO} times, depth and texels lose precision far away")
    });
    Ok((Camera { eye, target, up, fov_y_deg, near, far, viewport }, warning))
}

pub(super) fn resolve_remesh(remesh: Option<&fields::Remesh>) -> Result<Remesh, String> {
    let cell_px = within("cell_px", remesh.and_then(|remesh| remesh.cell_px).unwrap_or(2.0), 1.0, 64.0);
    let rules = Rules {
        footprint: remesh.and_then(|remesh| remesh.footprint).unwrap_or_default(),
        extremum: remesh.and_then(|remesh| remesh.extremum).unwrap_or_default(),
    };
    let cull = remesh.and_then(|remesh| remesh.cull).unwrap_or(true);
    Ok(Remesh { cell_px: cell_px?, cull, levels: usize::MAX, rules })
}

pub(super) fn resolve_lights(lights: &[Spanned<fields::Light>]) -> Result<Vec<Light>, (usize, String)> {
    if lights.is_empty() {
        return Ok(vec![Light { direction: DVec3::from(LIGHT).normalize() }]);
    }
    let resolve = |(index, light): (usize, &Spanned<fields::Light>)| {
        let direction = direction("direction", light.get_ref().direction.0);
        direction.map(|direction| Light { direction }).map_err(|message| (index, message))
    };
    lights.iter().enumerate().map(resolve).collect()
}
