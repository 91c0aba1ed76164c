// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers under which the constants of a draw are handed over to the design.
//!
//! | number   | value, from bit 0 on | format |
//! |----------|----------------------|--------|
//! | 0..=43   | those of [`crate::vertex_transform::numbers`]; the focal length and z0 go to all that take them | |
//! | 64, 65   | axis u, v: size (14 bits), repeat, `texel_bits` at 15 (4 bits) | texels |
//! | 66       | filter level: scale (24 bits), shift (6 bits), levels at 30 (4 bits) | |
//! | 67       | displacement of height 0 | signed 32 bits |
//! | 68       | displacement of the full range | signed 26 bits |
//! | 69       | exponent of the displacement | signed 6 bits |
//! | 70       | pixel: scale (24 bits), shift (6 bits) | |
//! | 71..=75  | colours of the heights 0, 1/4, .., 1: red, green, blue, 18 bits each | UQ1.16 |
//! | 76       | ambient light, likewise | UQ1.16 |
//! | 77       | specular (17 bits), shininess (8 bits) | UQ1.16, whole |
//! | 78       | direction of the light: x, y, z, signed, 18 bits each | SQ1.16 |
//! | 79       | colour of the light: red, green, blue, 20 bits each | UQ2.16 |
//! | 80       | culls, skips, passes, minima where a vertex faces away, half of the viewport's width at 8 and height at 32 (24 bits each) | 1/256 pixel |
//! | 81       | reach of the displacement, margin at 17 (17 bits each), see [`Reach`] | 1/4 pixel |

use super::machine::Light;
use super::skip::{self, Reach};
use crate::draw::Draw;
use crate::fixed::wrap;
use crate::perspective_correct::Axis;
use crate::rules::ExtremumRule;
use crate::vertex_transform::numbers as transform;

/// Axis u; v is the next.
pub const AXES: u64 = 64;
/// Filter level.
pub const LEVEL: u64 = 66;
/// Displacement: of height 0, of the full range, exponent.
pub const DISPLACEMENT: u64 = 67;
/// The size of a pixel.
pub const PIXEL: u64 = 70;
/// First of the five colours of the ramp.
pub const RAMP: u64 = 71;
/// Ambient light.
pub const AMBIENT: u64 = 76;
/// Specular reflection.
pub const SPECULAR: u64 = 77;
/// Direction of the light; its colour is the next.
pub const LIGHT: u64 = 78;
/// Switches and viewport.
pub const VIEWPORT: u64 = 80;
/// How far displacement reaches.
pub const REACH: u64 = 81;

/// What a draw has besides its constants: what the picture wants of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct View {
    /// Triangles whose three vertices are beyond one side of the viewport are left out, and vertices that have no others
    /// are not displaced.
    pub skips: bool,
    /// Pieces go on as they are: no remesher, and height 0.
    pub passes: bool,
    /// Half of the viewport's width and height, 1/256 pixel.
    pub half: [i64; 2],
    /// How far from the viewport a vertex matters.
    pub reach: Reach,
}

/// The lowest of 63 bits, unsigned.
fn part(value: i64, from: u32, bits: u32) -> u32 {
    ((value as u64 >> from) & ((1 << bits) - 1)) as u32
}

/// Three fields of `bits` bits.
fn three(fields: [i64; 3], bits: u32) -> i64 {
    let mask = (1 << bits) - 1;
    (fields[0] & mask) | (fields[1] & mask) << bits | (fields[2] & mask) << (2 * bits)
}

fn colour(value: i64, bits: u32) -> [u32; 3] {
    [0, 1, 2].map(|k| part(value, k * bits, bits))
}

/// The constants of a draw, each with its number, in ascending order.
pub fn values(draw: &Draw, light: &Light, view: &View) -> Vec<(u64, i64)> {
    let mut out = transform::values(&draw.transform, &draw.volume);
    let axis = |axis: &Axis| i64::from(axis.size) | i64::from(axis.repeat) << 14 | i64::from(axis.texel_bits) << 15;
    let of_colour = |colour: [u32; 3]| three(colour.map(i64::from), 18);
    let (level, displacement, material) = (&draw.level, &draw.displacement, &draw.material);
    let mut others = draw.axes.each_ref().map(axis).to_vec();
    others.push(i64::from(level.scale) | i64::from(level.shift) << 24 | i64::from(level.levels) << 30);
    others.extend([displacement.minimum, displacement.range, displacement.exponent.into()]);
    others.push(i64::from(draw.pixel.scale) | i64::from(draw.pixel.shift) << 24);
    others.extend(material.ramp.map(of_colour));
    others.push(of_colour(material.ambient));
    others.push(i64::from(material.specular) | i64::from(material.shininess) << 17);
    others.push(three(light.direction.map(i64::from), 18));
    others.push(three(light.colour.map(i64::from), 20));
    let minima = draw.rules.extremum == ExtremumRule::Vertex;
    let switches =
        i64::from(draw.cull) | i64::from(view.skips) << 1 | i64::from(view.passes) << 2 | i64::from(minima) << 3;
    others.push(switches | view.half[0] << 8 | view.half[1] << 32);
    others.push(view.reach.reach | view.reach.margin << skip::BITS);
    out.extend((AXES..).zip(others));
    out
}

/// Takes the constant of a number; whether there is one.
pub fn write(draw: &mut Draw, light: &mut Light, view: &mut View, number: u64, value: i64) -> bool {
    if transform::write(&mut draw.transform, &mut draw.volume, number, value) {
        draw.displacement.focal = draw.transform.focal;
        return true;
    }
    match number {
        AXES | 65 => {
            draw.axes[(number - AXES) as usize] =
                Axis { size: part(value, 0, 14), repeat: part(value, 14, 1) == 1, texel_bits: part(value, 15, 4) };
        }
        LEVEL => {
            let level = &mut draw.level;
            (level.scale, level.shift, level.levels) = (part(value, 0, 24), part(value, 24, 6), part(value, 30, 4));
        }
        DISPLACEMENT => draw.displacement.minimum = wrap(value, 32),
        68 => draw.displacement.range = wrap(value, 26),
        69 => draw.displacement.exponent = wrap(value, 6) as i32,
        PIXEL => (draw.pixel.scale, draw.pixel.shift) = (part(value, 0, 24), part(value, 24, 6)),
        RAMP..AMBIENT => draw.material.ramp[(number - RAMP) as usize] = colour(value, 18),
        AMBIENT => draw.material.ambient = colour(value, 18),
        SPECULAR => {
            (draw.material.specular, draw.material.shininess) = (part(value, 0, 17), part(value, 17, 8));
        }
        LIGHT => light.direction = [0, 1, 2].map(|k| wrap(value >> (18 * k), 18) as i32),
        79 => light.colour = colour(value, 20),
        VIEWPORT => {
            draw.cull = part(value, 0, 1) == 1;
            draw.rules.extremum = if part(value, 3, 1) == 1 { ExtremumRule::Vertex } else { ExtremumRule::Max };
            *view = View {
                skips: part(value, 1, 1) == 1,
                passes: part(value, 2, 1) == 1,
                half: [8, 32].map(|from| part(value, from, 24).into()),
                ..*view
            };
        }
        REACH => {
            let [reach, margin] = [0, skip::BITS].map(|from| part(value, from, skip::BITS).into());
            view.reach = Reach { reach, margin };
        }
        _ => return false,
    }
    true
}
