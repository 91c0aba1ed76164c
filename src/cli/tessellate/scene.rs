// SPDX-License-Identifier: MIT OR Apache-2.0
//! The objects of a scene: each map tessellated, and laid over its base mesh.

use std::io::stderr;

use glam::{DVec2, DVec3};
use relief_models::bake::Tolerance;
use relief_models::body::{BaseMesh, NoPoint, Surface};
use relief_models::map::Wrap;
use relief_models::measure::{Amount, Sampling, Side, surface};
use relief_models::mesh::TriangleMesh;
use relief_models::scene::{self, Object};
use relief_models::uniform;
use relief_testbench::method::{Goal, Verdict};

use super::{Arguments, Made, Worked, line, name_of, table};
use crate::cli::{Meter, write_all};

/// Points from which the distance to the surface of all samples is measured.
const SAMPLES: u64 = 200_000;

pub(super) fn make(arguments: &Arguments, meter: &Meter) -> Worked<Made> {
    let name = name_of(&arguments.input);
    if arguments.slope.is_some() {
        return Err("--slope and --eye are for maps; in a scene each map would need an eye of its own".into());
    }
    let scene = scene::read(&arguments.input)?;
    for warning in &scene.warnings {
        write_all(stderr(), &format!("warning: {warning}\n"))?;
    }
    let bound = arguments.bound.as_deref().map(world).transpose()?;
    let samples = |object: &Object| object.map.samples.len() as u64;
    let all: u64 = scene.objects.iter().map(samples).sum();
    let mut made = Made { mesh: TriangleMesh::default(), text: String::new(), broken: false };
    for (object, number) in scene.objects.iter().zip(1..) {
        let refuse = |message: String| format!("{name}: object {number} {message}");
        if object.wrap.contains(&Wrap::Repeat) {
            let what = "repeats its map; maps that clamp are expected (`relief run` draws repeating ones)";
            return Err(refuse(what.into()).into());
        }
        let [low, high] = object.displacement;
        let unit = (high - low) / 65535.0;
        let goal = match (bound, arguments.triangles) {
            (Some(bound), _) => Goal::Bound(in_map_units(bound, unit)),
            // By the number of samples.
            (None, Some(most)) => {
                Goal::Triangles((u128::from(most) * u128::from(samples(object)) / u128::from(all)) as u64)
            }
            (None, None) => return Err("a goal is expected: --bound E, in world units, or --triangles N".into()),
        };
        let tessellation =
            arguments.tessellate(&object.map, goal, meter).map_err(|error| match error
                .downcast::<relief_testbench::method::MethodError>(
            ) {
                Ok(error) if !error.is_mismatch() => refuse(format!("cannot be tessellated: {error}")).into(),
                Ok(error) => error as Box<dyn std::error::Error>,
                Err(error) => error,
            })?;
        let measured = tessellation.measure(&object.map, meter)?;
        let laid = lay(object, &tessellation.mesh).map_err(refuse)?;
        made.text += &line(
            "object",
            &format!("{number}: {}, {} x {} samples", object.map_name, object.map.width, object.map.height),
        );
        made.text += &line("method", &arguments.method);
        made.text += &table(&tessellation, &measured, unit);
        made.text += &distance(object, &laid, meter).map_err(refuse)?;
        made.broken |= measured.verdict == Verdict::Broken;
        let first = made.mesh.positions.len() as u32;
        made.mesh.positions.extend(laid.positions);
        made.mesh.triangles.extend(laid.triangles.into_iter().map(|corners| corners.map(|corner| first + corner)));
    }
    Ok(made)
}

/// A bound in world units.
fn world(text: &str) -> Worked<f64> {
    let bound = text.parse().ok().filter(|bound: &f64| bound.is_finite() && *bound >= 0.0);
    bound.ok_or_else(|| format!("`{text}` is no bound; world units from 0 on are expected in a scene").into())
}

/// The largest bound in map units, in ten-thousandths, that is not above one in world units.
fn in_map_units(bound: f64, unit: f64) -> Tolerance {
    let most = 65535.0 * 10_000.0;
    // A map that displaces nothing keeps every bound.
    let units = if unit == 0.0 { most } else { (bound / unit * 10_000.0).floor().min(most) };
    Tolerance::new(units as u32, 10_000).unwrap_or_else(|| unreachable!("it is from 0 to 65535"))
}

/// A mesh in sample coordinates over the base mesh of an object, in world units; counterclockwise from outside.
fn lay(object: &Object, mesh: &TriangleMesh) -> Result<TriangleMesh, String> {
    let base: &BaseMesh = &object.mesh;
    let surface = Surface::new(base);
    let last = DVec2::new((object.map.width - 1) as f64, (object.map.height - 1) as f64);
    let [low, high] = object.displacement;
    let point = |at: DVec2| {
        let uv = at / last;
        surface.at(uv).map_err(|error| match error {
            NoPoint::Uncovered => {
                format!("has no base triangle at u = {}, v = {}; uv that cover all of the map are expected", uv.x, uv.y)
            }
            NoPoint::Ambiguous => format!(
                "has several base triangles at u = {}, v = {}; uv that use the map once are expected",
                uv.x, uv.y
            ),
        })
    };
    let place = |[x, y, z]: &[f64; 3]| {
        let at = point(DVec2::new(*x, *y))?;
        Ok((at.position + (low + (high - low) * z / 65535.0) * at.normal).to_array())
    };
    let positions = mesh.positions.iter().map(place).collect::<Result<Vec<[f64; 3]>, String>>()?;
    let turn = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| DVec3::from_array(mesh.positions[corner as usize]).truncate());
        let downwards = (b - a).perp_dot(c - a) > 0.0;
        let [first, second, third] = *corners;
        // Columns and rows count to the right and down.
        Ok(if point((a + b + c) / 3.0)?.upright == downwards { [second, first, third] } else { *corners })
    };
    let triangles = mesh.triangles.iter().map(turn).collect::<Result<Vec<[u32; 3]>, String>>()?;
    Ok(TriangleMesh { positions, triangles })
}

/// How far the mesh is from that of all samples, both ways.
fn distance(object: &Object, laid: &TriangleMesh, meter: &Meter) -> Result<String, String> {
    let all = uniform::with_step(&object.map, 1).map_err(|error| format!("has no grid: {error}"))?;
    let all = lay(object, &all)?;
    let sampling = Sampling { amount: Amount::Samples(SAMPLES), seed: 1 };
    let found = surface(Side::Mesh(laid), Side::Mesh(&all), sampling, meter).map_err(|error| error.to_string())?;
    let text = format!(
        "max {}, rms {} ({SAMPLES} points each way)",
        super::figure(found.both.max),
        super::figure(found.both.rms)
    );
    Ok(line("distance to all samples", &text))
}
