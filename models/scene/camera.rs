// SPDX-License-Identifier: MIT OR Apache-2.0
//! Camera, remesher and lights: defaults and ranges.

use glam::DVec3;

use super::numbers::{counts, direction, finite, positive, vector, within};
use super::{Camera, Light, Remesh, fields};

/// Pixels of a side of the picture: 13 bits of Q13.8 on either side of its centre.
const VIEWPORT: u32 = 4096;
/// Ratio of far and near beyond which 32 bits of depth are no longer fine everywhere.
const RATIO: f64 = 1e4;
const LIGHT: [f64; 3] = [-0.4, 0.3, 0.85];

/// The camera, and a warning if there is one.
pub(super) fn resolve(camera: &fields::Camera) -> Result<(Camera, Option<String>), String> {
    resolve_values(camera).map_err(|message| format!("[camera] {message}"))
}

fn resolve_values(camera: &fields::Camera) -> Result<(Camera, Option<String>), String> {
    let (eye, target) = (vector("eye", camera.eye)?, vector("target", camera.target)?);
    let distance = (target - eye).length();
    if distance <= 1e-9 * (1.0 + eye.length()) {
        return Err(format!(
            "`eye` and `target` are both {eye}; two places are expected, to look from one to the other"
        ));
    }
    let up = vector("up", camera.up.unwrap_or([0.0, 0.0, 1.0]))?;
    let up_direction = direction("up", up.to_array())?;
    if up_direction.cross((target - eye) / distance).length() <= 1e-9 {
        return Err(format!("`up` {up} is along the view from `eye` to `target`; a direction aside of it is expected"));
    }
    let fov_y_deg = finite("fov_y_deg", camera.fov_y_deg.unwrap_or(45.0))?;
    // The ends would give pixels no size, or an infinite one.
    if !(1e-3..=179.999).contains(&fov_y_deg) {
        return Err(format!(
            "`fov_y_deg` is {fov_y_deg}; an angle between 0 and 180 degrees (0.001 to 179.999) is expected"
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
        return Err(format!("`far` is {far} and `near` {near}; a far plane behind the near one is expected"));
    }
    let whose = "the limit of the vertex format";
    let viewport = counts("viewport", camera.viewport.unwrap_or([640, 480]), [1, 1], VIEWPORT, whose)?;
    let warning = (far > RATIO * near).then(|| {
        let ratio = far / near;
        format!(
            "[camera] `far` is {ratio:.0} times `near`; beyond {RATIO} times, depth and texels lose precision far away"
        )
    });
    Ok((Camera { eye, target, up, fov_y_deg, near, far, viewport }, warning))
}

pub(super) fn resolve_remesh(remesh: &fields::Remesh) -> Result<Remesh, String> {
    let cell_px = within("cell_px", remesh.cell_px.unwrap_or(2.0), 1.0, 64.0);
    let cell_px = cell_px.map_err(|message| format!("[remesh] {message}"))?;
    Ok(Remesh { cell_px, cull: remesh.cull.unwrap_or(true) })
}

pub(super) fn resolve_lights(lights: &[fields::Light]) -> Result<Vec<Light>, String> {
    if lights.is_empty() {
        return Ok(vec![Light { direction: DVec3::from(LIGHT).normalize() }]);
    }
    let resolve = |(index, light): (usize, &fields::Light)| {
        direction("direction", light.direction)
            .map(|direction| Light { direction })
            .map_err(|message| format!("[[light]] {}: {message}", index + 1))
    };
    lights.iter().enumerate().map(resolve).collect()
}
