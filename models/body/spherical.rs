// SPDX-License-Identifier: MIT OR Apache-2.0
//! Longitude and colatitude round the centroid, for a mesh that brings no texture coordinates.
//!
//! Triangles are cut by the plane y = 0 through the centroid, so that each part lies in one half: the longitude is
//! `0..1/2` in the upper one (y > 0) and `1/2..1` in the lower, and its ends run along edges. Where such a cut meets the
//! axis there is a pole. All of these decisions belong to places and to edges, and cut points are computed from an
//! edge's ends in one order, so that both users of an edge get the same bits.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, dvec2};
use rustc_hash::FxHashSet;

use super::weld::{Welder, key};
use super::{BaseMesh, BaseMeshVertex};

/// Part of the body's radius by which a place may miss the plane or the axis, and count as lying on it.
const NEAR: f64 = 1e-9;

/// A corner, and where it lies: the signs of y and, in the plane y = 0, of x. Both zero is a pole.
#[derive(Clone, Copy)]
struct Corner {
    position: DVec3,
    normal: DVec3,
    y: i8,
    x: i8,
}

impl Corner {
    fn is_pole(&self) -> bool {
        self.y == 0 && self.x == 0
    }
}

struct Sphere {
    centre: DVec3,
    near: f64,
}

/// Gives a mesh longitudes and colatitudes. The error is a sentence about the mesh.
pub(super) fn wrap(triangles: &[[(DVec3, DVec3); 3]]) -> Result<BaseMesh, String> {
    let sphere = Sphere::round(triangles);
    let mut welder = Welder::default();
    for triangle in triangles {
        let [a, b, c] = *triangle;
        let corners = [sphere.locate(a)?, sphere.locate(b)?, sphere.locate(c)?];
        let mut outline = Vec::with_capacity(5);
        for side in 0..3 {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            outline.push(from);
            if from.y * to.y < 0 {
                outline.push(sphere.cut_plane(from, to)?);
            }
        }
        for half in [1, -1] {
            sphere.emit_half(&outline, half, &mut welder)?;
        }
    }
    Ok(welder.mesh)
}

fn sign(value: f64, near: f64) -> i8 {
    i8::from(value > near) - i8::from(value < -near)
}

impl Sphere {
    /// Round the mean of all places; each counts once.
    fn round(triangles: &[[(DVec3, DVec3); 3]]) -> Sphere {
        let mut known = FxHashSet::default();
        let places: Vec<DVec3> =
            triangles.iter().flatten().map(|(place, _)| *place).filter(|place| known.insert(key(*place))).collect();
        let centre = places.iter().sum::<DVec3>() / places.len() as f64;
        let radius = places.iter().fold(0.0, |most: f64, place| most.max((*place - centre).length()));
        Sphere { centre, near: NEAR * radius }
    }

    fn locate(&self, (position, normal): (DVec3, DVec3)) -> Result<Corner, String> {
        let y = sign(position.y - self.centre.y, self.near);
        self.in_plane_if(y, position, normal)
    }

    fn in_plane_if(&self, y: i8, position: DVec3, normal: DVec3) -> Result<Corner, String> {
        let from_centre = position - self.centre;
        let corner = Corner { position, normal, y, x: if y == 0 { sign(from_centre.x, self.near) } else { 0 } };
        if corner.is_pole() && from_centre.z.abs() <= self.near {
            let what = "goes through its own centroid, which has neither longitude nor latitude";
            return Err(format!("{what}: {position}; spherical `uv` is for bodies round their centroid"));
        }
        Ok(corner)
    }

    /// The point of an edge whose distance from a plane is zero; `distance` is that of a place.
    fn cut(&self, a: Corner, b: Corner, distance: impl Fn(DVec3) -> f64) -> Result<(DVec3, DVec3), String> {
        let (a, b) = if a.position.to_array() <= b.position.to_array() { (a, b) } else { (b, a) };
        let (from, to) = (distance(a.position - self.centre), distance(b.position - self.centre));
        let part = from / (from - to);
        let normal = a.normal.lerp(b.normal, part).try_normalize().ok_or_else(|| {
            format!("has opposed normals at {} and {}; the edge between them has none", a.position, b.position)
        })?;
        Ok((a.position + (b.position - a.position) * part, normal))
    }

    fn cut_plane(&self, a: Corner, b: Corner) -> Result<Corner, String> {
        let (position, normal) = self.cut(a, b, |from_centre| from_centre.y)?;
        self.in_plane_if(0, position, normal)
    }

    fn cut_axis(&self, a: Corner, b: Corner) -> Result<Corner, String> {
        let (position, normal) = self.cut(a, b, |from_centre| from_centre.x)?;
        let pole = Corner { position, normal, y: 0, x: 0 };
        if (position.z - self.centre.z).abs() <= self.near {
            return self.in_plane_if(0, DVec3 { x: self.centre.x, ..position }, normal);
        }
        Ok(pole)
    }

    /// Emits the part of a convex outline that lies in one half.
    fn emit_half(&self, outline: &[Corner], half: i8, welder: &mut Welder) -> Result<(), String> {
        // An outline within the plane belongs to the upper half.
        let is_flat = outline.iter().all(|corner| corner.y == 0);
        if !(outline.iter().any(|corner| corner.y == half) || is_flat && half > 0) {
            return Ok(());
        }
        let kept: Vec<Corner> = outline.iter().filter(|corner| corner.y != -half).copied().collect();
        let mut part = Vec::with_capacity(kept.len() + 1);
        for (index, corner) in kept.iter().enumerate() {
            let next = kept[(index + 1) % kept.len()];
            part.push(*corner);
            if corner.y == 0 && next.y == 0 && corner.x * next.x < 0 {
                part.push(self.cut_axis(*corner, next)?);
            }
        }
        let poles = part.iter().filter(|corner| corner.is_pole()).count();
        if poles > 1 {
            let what = "has a triangle along the axis through its centroid, where there is no longitude";
            return Err(format!("{what}: at {}; spherical `uv` is for bodies round that axis", part[0].position));
        }
        // A fan about the pole, so that it is a corner of every triangle with an edge on it.
        if let Some(pole) = part.iter().position(Corner::is_pole) {
            part.rotate_left(pole);
        }
        for pair in part[1..].windows(2) {
            let (apex, a, b) = (part[0], pair[0], pair[1]);
            let (vertex_a, vertex_b) = (self.vertex(a, half), self.vertex(b, half));
            let mut apex_vertex = self.vertex(apex, half);
            if !apex.is_pole() {
                welder.triangle([apex_vertex, vertex_a, vertex_b]);
                continue;
            }
            apex_vertex.uv.x = vertex_b.uv.x;
            let pole_b = apex_vertex;
            apex_vertex.uv.x = vertex_a.uv.x;
            welder.triangle([vertex_a, vertex_b, pole_b]);
            welder.triangle([vertex_a, pole_b, apex_vertex]);
        }
        Ok(())
    }

    /// The vertex at a corner, as its half sees it. A pole's longitude is up to its neighbours.
    fn vertex(&self, corner: Corner, half: i8) -> BaseMeshVertex {
        let Corner { position, normal, y, x } = corner;
        let d = position - self.centre;
        let u = match (y, x) {
            (0, 1) => f64::from(u8::from(half < 0)),
            (0, _) => 0.5,
            (1, _) => libm::atan2(d.y, d.x) / TAU,
            _ => 1.0 + libm::atan2(d.y, d.x) / TAU,
        };
        let v = if corner.is_pole() {
            f64::from(u8::from(d.z < 0.0))
        } else {
            libm::atan2(libm::hypot(d.x, d.y), d.z) / PI
        };
        BaseMeshVertex { position, normal, uv: dvec2(u, v) }
    }
}
