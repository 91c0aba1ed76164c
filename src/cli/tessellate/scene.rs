// SPDX-License-Identifier: MIT OR Apache-2.0
//! The objects of a scene: each map tessellated, and laid over its base mesh.

use std::io::stderr;

use glam::{DVec2, DVec3};
use relief_models::bake::Tolerance;
use relief_models::body::{NoPoint, Surface};
use relief_models::map::{HeightMap, Wrap};
use relief_models::measure::{Amount, Sampling, Side, surface};
use relief_models::mesh::TriangleMesh;
use relief_models::scene::{self, Object};
use relief_models::uniform;
use relief_testbench::method::{Borders, Goal, Verdict};
use rustc_hash::FxHashMap;

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
        let [low, high] = object.displacement;
        let unit = (high - low) / 65535.0;
        let goal = match (bound, arguments.triangles) {
            (Some(bound), _) => Goal::Bound(in_map_units(bound, unit)),
            // By the number of samples.
            (None, Some(most)) => {
                Goal::Triangles(((u128::from(most) * u128::from(samples(object)) / u128::from(all)) as u64).max(2))
            }
            (None, None) => return Err("a goal is expected: --bound E, in world units, or --triangles N".into()),
        };
        let borders = Borders { wrap: object.wrap, poles: object.poles };
        let map = if object.poles { object.map.with_poles() } else { object.map.clone() };
        let tessellation = arguments.tessellate(&map, borders, goal, meter).map_err(|error| {
            match error.downcast::<relief_testbench::method::MethodError>() {
                Ok(error) if !error.is_mismatch() => {
                    refuse(format!("cannot be tessellated: {error} (in map units, of {unit} each)")).into()
                }
                Ok(error) => error as Box<dyn std::error::Error>,
                Err(error) => error,
            }
        })?;
        let map = map.unrolled(object.wrap);
        let measured = tessellation.measure(&map, meter)?;
        let laid = lay(object, &tessellation.mesh).map_err(refuse)?;
        made.text += &line(
            "object",
            &format!("{number}: {}, {} x {} samples", object.map_name, object.map.width, object.map.height),
        );
        made.text += &line("method", arguments.method());
        made.text += &table(&tessellation, &measured, unit);
        made.text += &distance(object, &map, &laid, meter).map_err(refuse)?;
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

/// A mesh in sample coordinates over the base mesh of an object, in world units; counterclockwise from outside. What meets
/// on the body is one vertex, and triangles that lose their area by it are left out: a closed body stays closed.
fn lay(object: &Object, mesh: &TriangleMesh) -> Result<TriangleMesh, String> {
    let surface = Surface::new(&object.mesh);
    let size = [object.map.width, object.map.height];
    let repeats = object.wrap.map(|wrap| wrap == Wrap::Repeat);
    let extent = [0, 1].map(|axis| (size[axis] - usize::from(!repeats[axis])) as f64);
    let point = |at: DVec2| {
        let uv = at / DVec2::from_array(extent);
        let place = format!("at u = {}, v = {}", uv.x, uv.y);
        surface.at(uv).map_err(|error| match error {
            NoPoint::Uncovered => format!("has no base triangle {place}; uv that cover all of the map are expected"),
            NoPoint::Ambiguous => format!("has several base triangles {place}; uv that use the map once are expected"),
        })
    };
    // The place of a vertex that stands for all of its copies.
    let canonical = |[x, y, z]: [f64; 3]| {
        let [mut u, v] =
            [0, 1].map(|axis| if repeats[axis] && [x, y][axis] == extent[axis] { 0.0 } else { [x, y][axis] });
        if object.poles && (v == 0.0 || v == extent[1]) {
            u = 0.0;
        }
        [u, v, z]
    };
    let [low, high] = object.displacement;
    let (mut positions, mut numbers) = (Vec::new(), FxHashMap::default());
    let mut number = |[x, y, z]: [f64; 3]| -> Result<u32, String> {
        if let Some(number) = numbers.get(&[x, y].map(f64::to_bits)) {
            return Ok(*number);
        }
        let at = point(DVec2::new(x, y))?;
        positions.push((at.position + (low + (high - low) * z / 65535.0) * at.normal).to_array());
        let number = positions.len() as u32 - 1;
        numbers.insert([x, y].map(f64::to_bits), number);
        Ok(number)
    };
    let mut triangles = Vec::with_capacity(mesh.triangles.len());
    for corners in &mesh.triangles {
        let places = corners.map(|corner| mesh.positions[corner as usize]);
        let [a, b, c] = places.map(|place| DVec3::from_array(place).truncate());
        let [first, second, third] = places.map(|place| number(canonical(place)));
        let [first, second, third] = [first?, second?, third?];
        if first == second || second == third || third == first {
            continue;
        }
        // Columns and rows count to the right and down.
        let downwards = (b - a).perp_dot(c - a) > 0.0;
        let turned = point((a + b + c) / 3.0)?.upright == downwards;
        triangles.push(if turned { [second, first, third] } else { [first, second, third] });
    }
    Ok(TriangleMesh { positions, triangles })
}

/// How far the mesh is from that of all samples, both ways.
fn distance(object: &Object, map: &HeightMap, laid: &TriangleMesh, meter: &Meter) -> Result<String, String> {
    let all = uniform::with_step(map, 1).map_err(|error| format!("has no grid: {error}"))?;
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
