// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lights a triangle: ambient, diffuse and Blinn-Phong (Blinn 1977), and a colour that follows the height.
//!
//! ```text
//! colour = albedo ambient + sum over lights of light (albedo max(0, N.L) + specular max(0, N.H)^shininess)
//! H = (L + V) / |L + V|          V: towards the eye;  N towards the eye too, so both sides of a surface are lit
//! ```
//!
//! | port | format |
//! |------|--------|
//! | N, L, V | 3 x SQ1.16, unit vectors in view space |
//! | albedo, ambient, light, specular | UQ1.16, at most 1.0 (a light may have up to 4.0) |
//! | colour | 3 x 8 bits, saturating; 255 is 1.0 |
//!
//! [`shade`] chains what a displaced triangle needs: [`view`], [`Material::albedo`] and [`golden`].
//!
//! Error: at most 1/255 a light and half a unit of rounding.
//!
//! Example: one white light along N, albedo 0.5, nothing else: 128 in each channel.

use crate::face_normal::Pixel;
use crate::{power, rsqrt};
use serde::{Deserialize, Serialize};

/// A directional light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Light {
    /// Unit vector towards the light in view space, SQ1.16.
    pub direction: [i32; 3],
    /// Red, green, blue, UQ2.16, at most 4.0.
    pub colour: [u32; 3],
}

/// What the surface does to light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Material {
    /// Colours of the heights 0, 1/4, .., 1 of the map's full range, UQ1.16.
    pub ramp: [[u32; 3]; 5],
    /// Ambient light, UQ1.16.
    pub ambient: [u32; 3],
    /// Specular reflection, UQ1.16.
    pub specular: u32,
    /// Exponent of the specular reflection, `1..=255`.
    pub shininess: u32,
}

impl Material {
    /// Moss, straw, ochre, rock and snow under a cool sky.
    pub const TERRAIN: Material = Material {
        ramp: [
            [0x4800, 0x5400, 0x3400],
            [0x8600, 0x7e00, 0x5000],
            [0xae00, 0x8c00, 0x5a00],
            [0xb000, 0x8e00, 0x7200],
            [0xf600, 0xf0ff, 0xe6ff],
        ],
        ambient: [0x4000, 0x4a00, 0x5c00],
        specular: 0x0e00,
        shininess: 24,
    };

    /// One colour (red, green, blue of 0 to 1), a little darker in the depths, under the same sky.
    pub fn plain(colour: [f64; 3]) -> Material {
        // UQ0.16 with 1.0 cut to its largest value.
        let part = |share: f64| colour.map(|part| (part * share * 65536.0).clamp(0.0, 65535.0) as u32);
        Material { ramp: [0.70, 0.80, 0.90, 0.96, 1.0].map(part), ..Self::TERRAIN }
    }

    /// The colour at the mean of three heights, UQ16.8 each.
    pub fn albedo(&self, heights: [i64; 3]) -> [u32; 3] {
        // 26 bits of sum; 0xAAAB / 2^17 is a third, so 16 bits are left.
        let sum: i64 = heights.iter().map(|h| h.clamp(&0, &(65535 << 8))).sum();
        let t = ((sum * 0xaaab) >> 25) as usize;
        let (at, along) = (t >> 14, (t & 0x3fff) as i64);
        // 17 + 14 bits and sign; the mean of two colours is one.
        [0, 1, 2].map(|k| {
            let (from, to) = (i64::from(self.ramp[at][k]), i64::from(self.ramp[at + 1][k]));
            (from + (((to - from) * along) >> 14)) as u32
        })
    }
}

/// Cosine of two unit vectors, cut at 0 and 1.0: UQ1.16.
fn cosine(a: [i32; 3], b: [i32; 3]) -> u32 {
    // Three products of SQ1.16: 34 bits and sign.
    let dot: i64 = (0..3).map(|k| i64::from(a[k]) * i64::from(b[k])).sum();
    (dot >> 16).clamp(0, 1 << 16) as u32
}

/// The direction from X', Y' (SQ13.8 pixels) on the screen to the eye: 3 x SQ1.16.
pub fn view(pixel: &Pixel, position: [i64; 2]) -> [i32; 3] {
    // z = 1 in 32 fraction bits: 22 + 24 bits of product, of whose 8 + shift fraction bits at least 24 go.
    let slope = |x: i64| -((i128::from(x) * i128::from(pixel.scale)) << 32 >> (pixel.shift + 8)) as i64;
    rsqrt::normalize([slope(position[0]), slope(position[1]), -1 << 32])
}

/// The exact direction.
pub fn exact_view(pixel: &Pixel, position: [i64; 2]) -> [f64; 3] {
    let size = f64::from(pixel.scale) * (-f64::from(pixel.shift)).exp2() / 256.0;
    (-glam::DVec3::new(position[0] as f64 * size, position[1] as f64 * size, 1.0)).normalize().to_array()
}

/// The colour of a triangle with normal `n`, seen at `position` (X', Y' of a vertex), with its three heights.
pub fn shade(
    material: &Material,
    lights: &[Light],
    pixel: &Pixel,
    position: [i64; 2],
    heights: [i64; 3],
    n: [i32; 3],
) -> [u8; 3] {
    golden(material, lights, material.albedo(heights), n, view(pixel, position))
}

/// The colour of a point with normal `n`, seen from direction `v`.
pub fn golden(material: &Material, lights: &[Light], albedo: [u32; 3], n: [i32; 3], v: [i32; 3]) -> [u8; 3] {
    // 17 + 17 bits; sums of 64 bits hold any number of lights.
    let mut sum = [0, 1, 2].map(|k| (u64::from(albedo[k]) * u64::from(material.ambient[k])) >> 16);
    for light in lights {
        let diffuse = cosine(n, light.direction);
        let half = rsqrt::normalize([0, 1, 2].map(|k| i64::from(light.direction[k]) + i64::from(v[k])));
        // No highlight where the light is behind the surface.
        let shine = if diffuse > 0 { power::golden(cosine(n, half), material.shininess) } else { 0 };
        for k in 0..3 {
            let reflected =
                (u64::from(albedo[k]) * u64::from(diffuse) + u64::from(material.specular) * u64::from(shine)) >> 16;
            // 18 + 19 bits.
            sum[k] += (reflected * u64::from(light.colour[k])) >> 16;
        }
    }
    // 17 + 8 bits, round half up; saturated before, so at most 255.
    sum.map(|x| ((x.min(1 << 16) * 255 + (1 << 15)) >> 16) as u8)
}

/// The exact colour, 0 to 255, unrounded.
pub fn exact(material: &Material, lights: &[Light], albedo: [u32; 3], n: [i32; 3], v: [i32; 3]) -> [f64; 3] {
    let real = |a: [i32; 3]| glam::DVec3::from_array(a.map(|x| f64::from(x) / 65536.0));
    let one = |x: u32| f64::from(x) / 65536.0;
    let (n, v) = (real(n), real(v));
    [0, 1, 2].map(|k| {
        let mut sum = one(albedo[k]) * one(material.ambient[k]);
        for light in lights {
            let l = real(light.direction);
            let diffuse = n.dot(l).max(0.0);
            let half = (l + v).try_normalize().unwrap_or_default();
            let shine = if diffuse > 0.0 { n.dot(half).max(0.0).powi(material.shininess as i32) } else { 0.0 };
            sum += one(light.colour[k]) * (one(albedo[k]) * diffuse + one(material.specular) * shine);
        }
        sum.min(1.0) * 255.0
    })
}
