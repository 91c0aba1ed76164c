// SPDX-License-Identifier: MIT OR Apache-2.0
//! Maps from formulas, the same bits on every machine: `libm` instead of the platform's functions.
//!
//! With `u` and `v` from 0 in the first sample to 1 in the last one, `x = 2 u - 1` and `y = 1 - 2 v`:
//!
//! | name | height, 0 to 1 |
//! |---|---|
//! | half_donut | upper half of a torus, `sqrt(a^2 - (r - R)^2) / a`, `r = sqrt(x^2 + y^2)`, `R = 0.6`, `a = 0.3`; 0 beside it |
//! | peaks | three hills and two hollows, Gaussians over 3 x and 3 y |
//! | paraboloid | `1 - (x^2 + y^2) / 2` |
//! | checkerboard | 0 and 1 in 8 x 8 squares |
//! | cosine | `1/2 + cos(16 pi u') (1 - cos(6 pi v)) (1 - cos(2 pi v)) / 8`, `u' = i / width`: a period in u, constant on the first and last row |
//! | ramp | `u` |
//! | cubic | `1/2 + sqrt(27) / 8 (x - x^3 + y - y^3)`: an edge from rim to rim, and its middle, see a plane |
//! | dents | 8 x 8 round hollows in a plate, `1 - sqrt(1 - (r / 0.4)^2)` with the side of a cell as unit; 1 between them |
//! | peak | 1 in one sample of odd column and row near a third of the sides, 0 beside it |
//! | noise | 16 bits of a hash of column and row |
//! | waves | `1/2 + cos(16 pi u) / 2`: the same in every column of a grid of 8 cells |

use std::f64::consts::PI;

use serde::Deserialize;

use super::HeightMap;

/// A map that a formula makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Procedural {
    /// The upper half of a torus on a plane.
    HalfDonut,
    /// Hills and hollows.
    Peaks,
    /// A dome.
    Paraboloid,
    /// 8 x 8 squares.
    Checkerboard,
    /// Waves, periodic in u and constant at the poles of a sphere.
    Cosine,
    /// From 0 on the left to 65535 on the right.
    Ramp,
    /// A hill and a hollow in each axis that cancel at its ends and in its middle.
    Cubic,
    /// A plate with 8 x 8 round hollows.
    Dents,
    /// One sample.
    Peak,
    /// A value of its own for each sample.
    Noise,
    /// Eight periods of a cosine in u.
    Waves,
}

impl Procedural {
    /// All of them.
    pub const ALL: [Procedural; 11] = [
        Procedural::HalfDonut,
        Procedural::Peaks,
        Procedural::Paraboloid,
        Procedural::Checkerboard,
        Procedural::Cosine,
        Procedural::Ramp,
        Procedural::Cubic,
        Procedural::Dents,
        Procedural::Peak,
        Procedural::Noise,
        Procedural::Waves,
    ];

    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Procedural::HalfDonut => "half_donut",
            Procedural::Peaks => "peaks",
            Procedural::Paraboloid => "paraboloid",
            Procedural::Checkerboard => "checkerboard",
            Procedural::Cosine => "cosine",
            Procedural::Ramp => "ramp",
            Procedural::Cubic => "cubic",
            Procedural::Dents => "dents",
            Procedural::Peak => "peak",
            Procedural::Noise => "noise",
            Procedural::Waves => "waves",
        }
    }
}

impl HeightMap {
    /// The map of a formula with `width * height` samples, each axis 1 or more.
    pub fn procedural(kind: Procedural, width: usize, height: usize) -> HeightMap {
        let mut samples = Vec::with_capacity(width * height);
        for j in 0..height {
            for i in 0..width {
                let value = match kind {
                    Procedural::Checkerboard => f64::from(u8::from((i * 8 / width + j * 8 / height) % 2 == 1)),
                    Procedural::Cosine => cosine(i as f64 / width as f64, fraction(j, height)),
                    Procedural::Ramp => fraction(i, width),
                    Procedural::Dents => dents(fraction(i, width), fraction(j, height)),
                    Procedural::Peak => f64::from(u8::from([i, j] == [width, height].map(third))),
                    Procedural::Noise => f64::from(hash(i as u32, j as u32)) / 65535.0,
                    Procedural::Waves => 0.5 + libm::cos(16.0 * PI * fraction(i, width)) / 2.0,
                    _ => {
                        let (x, y) = (2.0 * fraction(i, width) - 1.0, 1.0 - 2.0 * fraction(j, height));
                        match kind {
                            Procedural::HalfDonut => half_donut(x, y),
                            Procedural::Peaks => peaks(3.0 * x, 3.0 * y),
                            Procedural::Cubic => 0.5 + 27.0f64.sqrt() / 8.0 * (x - x * x * x + y - y * y * y),
                            _ => 1.0 - (x * x + y * y) / 2.0,
                        }
                    }
                };
                samples.push((value.clamp(0.0, 1.0) * 65535.0 + 0.5) as u16);
            }
        }
        HeightMap { width, height, samples }
    }
}

/// From 0 in the first to 1 in the last of `count`; the middle if there is only one.
fn fraction(index: usize, count: usize) -> f64 {
    if count == 1 { 0.5 } else { index as f64 / (count - 1) as f64 }
}

/// An odd sample near a third of an axis, where no coarse grid has a vertex; the last one of a short axis.
fn third(count: usize) -> usize {
    ((count / 3) | 1).min(count - 1)
}

fn dents(u: f64, v: f64) -> f64 {
    let [x, y] = [u, v].map(|at| (8.0 * at).fract() - 0.5);
    1.0 - (1.0 - (x * x + y * y) / 0.16).max(0.0).sqrt()
}

/// Bits of a column and a row without a pattern: the finisher of MurmurHash3.
fn hash(i: u32, j: u32) -> u16 {
    let mut bits = i.wrapping_mul(0x9e37_79b9) ^ j.wrapping_mul(0x85eb_ca6b).rotate_left(16);
    for factor in [0x85eb_ca6b_u32, 0xc2b2_ae35] {
        bits = (bits ^ (bits >> 16)).wrapping_mul(factor);
    }
    ((bits ^ (bits >> 16)) >> 16) as u16
}

fn half_donut(x: f64, y: f64) -> f64 {
    const RING: f64 = 0.6;
    const TUBE: f64 = 0.3;
    let across = ((x * x + y * y).sqrt() - RING) / TUBE;
    (1.0 - across * across).max(0.0).sqrt()
}

fn cosine(u: f64, v: f64) -> f64 {
    let rows = (1.0 - libm::cos(6.0 * PI * v)) * (1.0 - libm::cos(2.0 * PI * v));
    0.5 + libm::cos(16.0 * PI * u) * rows / 8.0
}

/// The well-known test surface, from its least (-6.5511) to its greatest value (8.1062) on the square of side 6.
fn peaks(x: f64, y: f64) -> f64 {
    let (low, high) = (-6.5512, 8.1063);
    let hill = 3.0 * (1.0 - x) * (1.0 - x) * libm::exp(-x * x - (y + 1.0) * (y + 1.0));
    let waves = 10.0 * (x / 5.0 - x * x * x - y * y * y * y * y) * libm::exp(-x * x - y * y);
    let hollow = libm::exp(-(x + 1.0) * (x + 1.0) - y * y) / 3.0;
    (hill - waves - hollow - low) / (high - low)
}
