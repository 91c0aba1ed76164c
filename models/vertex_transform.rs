// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a record of the vertex memory to what the remesher takes: projective position, data lanes and grid corner.
//!
//! ```text
//! view = rotation position + translation            eye at 0, x right, y down, z forward
//! X = f x/z   Y = f y/z   c = z0/z                  pixels from the viewport's centre; c in (0, 1]
//! lanes X, Y, c, nx c, ny c, nz c, u c, v c, rho c
//! corner (X / cell, Y / cell, -log2(c) octave)      octave = 1 / log2(1 + s cell), s = 1/f
//! ```
//!
//! The world position is never formed again: positions, and whatever is linear over the surface, are linear in X, Y and c
//! (so Gumhold & Huettner 1999, section 2.2; z/w is the same everywhere and is left away). Everything here is a function
//! of the record and of per-draw constants, so vertices of equal position and normal leave with equal bits.
//!
//! | lane     | format | unit |
//! |----------|--------|------|
//! | X, Y     | SQ0.31 | 8192 pixels: a pixel is 2^18 |
//! | c        | SQ0.31 | z0/z, at least 1 unit; 1.0 is not representable: z = z0 gives 2^31 - 1 |
//! | n c      | SQ0.31 | unit normal in view space times c; +-1.0 saturates to +-(2^31 - 1) |
//! | u c, v c | SQ0.31 | 2^texel_bits texels |
//! | rho c    | SQ0.31 | 1024 density units, see [`filter_level`](crate::filter_level) |
//!
//! Errors: c at most 2.2 units below the true value (the reciprocal's 1.2 and the floor) and 1 above it (z enters the
//! reciprocal with 32 bits), X and Y 2^-29.7 of their value and a unit; a corner lies within 1/2 + 0.03 voxels of the true one at 1080 rows and cell 1
//! (chords of 64 lines: 1 / (8 64^2 ln(1 + s cell)) voxels).
//!
//! Example: z = 2 z0, x = 0 -> c = 0x3FFF_FFFF to within a unit (0.5), X = 0, corner z = octave.

pub mod numbers;

use crate::step::{MAX_COMPONENTS, Vertex};
use crate::{cull, power, reciprocal};
use serde::{Deserialize, Serialize};

/// Lanes of the vertex data, in order.
pub mod lane {
    /// Pixels right of the viewport's centre.
    pub const X: usize = 0;
    /// Pixels below the viewport's centre.
    pub const Y: usize = 1;
    /// z0/z.
    pub const C: usize = 2;
    /// First of the three lanes of the normal times c.
    pub const NORMAL: usize = 3;
    /// Texel coordinate u times c.
    pub const U: usize = 6;
    /// Texel coordinate v times c.
    pub const V: usize = 7;
    /// Texel density times c.
    pub const DENSITY: usize = 8;
    /// Number of lanes.
    pub const COUNT: usize = 9;
}

/// A base vertex as it stands in the vertex memory: 9 words of 32 bits, all from the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct BaseVertex {
    /// World position, SQ1.30 of the draw's extent ([`Constants`] holds no scale: only ratios of lengths matter).
    pub position: [i32; 3],
    /// Unit normal in the world, SQ1.30, 1.0 representable.
    pub normal: [i32; 3],
    /// Texel coordinates of level 0 over `2^texel_bits`, UQ0.32.
    pub texel: [u32; 2],
    /// Texel density, UQ0.32 of 1024 density units; equal for vertices of equal position.
    pub density: u32,
}

/// Per-draw constants of the transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Constants {
    /// Rows right, down, forward of the view, SQ1.30.
    pub rotation: [[i32; 3]; 3],
    /// Minus the rotated eye, in units of 2^-60 of the draw's extent; below 2^61 in magnitude.
    pub translation: [i64; 3],
    /// z0 in view units, 2^-44 of the draw's extent; at least 2^16.
    pub z0: i64,
    /// Focal length in pixels, UQ16.16.
    pub focal: u32,
    /// 1 / cell, UQ8.24.
    pub inverse_cell: u32,
    /// Voxels an octave of z, UQ16.16.
    pub octave: u32,
    /// Taken from the z of every grid corner; 0 unless the scene is deeper than the grid's positive half.
    pub grid_bias: i32,
    /// Bits of a signed grid coordinate.
    pub coordinate_bits: u32,
}

/// A vertex in view space, before the division by z; what base triangles are cut on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ViewVertex {
    /// Right, down, forward, in units of 2^-44 of the draw's extent, below 2^46 in magnitude.
    pub position: [i64; 3],
    /// Normal in view space, SQ1.30; shorter than 1 on a cut edge.
    pub normal: [i64; 3],
    /// As in the record.
    pub texel: [i64; 2],
    /// As in the record.
    pub density: i64,
}

/// A transformed vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Projected {
    /// The lanes of [`lane`].
    pub data: Vertex,
    /// Grid corner, voxels.
    pub corner: [i32; 3],
}

/// Why a vertex in front of z0 has no place in the formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutOfRange {
    /// |X| or |Y| of 8192 pixels or more.
    Lane,
    /// A grid coordinate beyond the remesher's.
    Grid,
}

/// A beat of the block: a record of the vertex memory, or a vertex that a cut has made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// To be rotated first.
    Record(BaseVertex),
    /// In view space already.
    View(ViewVertex),
}

/// All that the block tells of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transformed {
    /// The vertex in view space, for the cutter.
    pub view: ViewVertex,
    /// Sides of the volume of sight that it is beyond, see [`cull`].
    pub outcode: u8,
    /// Constant planes that it is behind, one bit each, see [`distance`].
    pub outside: u8,
    /// The projection; none behind z0.
    pub projected: Option<Result<Projected, OutOfRange>>,
}

/// Corners of a cut base triangle lie within so many pixels of the viewport's centre.
pub const GUARD: i64 = 8190;

/// Transforms a vertex: whatever is a function of it alone.
pub fn golden(constants: &Constants, volume: &cull::Constants, source: &Source) -> Transformed {
    let view = match source {
        Source::Record(vertex) => view(constants, vertex),
        Source::View(vertex) => *vertex,
    };
    let outside = outside(constants, view.position);
    let projected = (outside & 1 == 0).then(|| project(constants, &view));
    Transformed { view, outcode: cull::outcode(volume, view.position), outside, projected }
}

/// Signed distance from a constant plane: 0 is z0, 1 to 4 the guard band left, right, above, below.
pub fn distance(constants: &Constants, plane: usize, position: [i64; 3]) -> i64 {
    let [x, y, z] = position;
    // 46 + 32 bits of product leave 62; 13 + 46 bits are 59.
    let shifted = |x: i64| ((i128::from(x) * i128::from(constants.focal)) >> 16) as i64;
    match plane {
        0 => z - constants.z0,
        1 => GUARD * z + shifted(x),
        2 => GUARD * z - shifted(x),
        3 => GUARD * z + shifted(y),
        _ => GUARD * z - shifted(y),
    }
}

/// The constant planes that `position` is behind, one bit each.
pub fn outside(constants: &Constants, position: [i64; 3]) -> u8 {
    (0..5).fold(0, |bits, plane| bits | u8::from(distance(constants, plane, position) < 0) << plane)
}

/// Rotation and translation.
pub fn view(constants: &Constants, vertex: &BaseVertex) -> ViewVertex {
    let rotate = |k: usize, v: [i32; 3]| -> i64 {
        // Rows have length 1 and |v_i| <= 2^30: each product is at most 2^60, the sum at most sqrt(3) 2^60.
        (0..3).map(|i| i64::from(constants.rotation[k][i]) * i64::from(v[i])).sum()
    };
    ViewVertex {
        // |sum| < sqrt(3) 2^60 + 2^61 < 2^62; 16 of 62 bits go, round half up.
        position: std::array::from_fn(|k| (rotate(k, vertex.position) + constants.translation[k] + (1 << 15)) >> 16),
        // Products of SQ1.30 have 60 fraction bits.
        normal: std::array::from_fn(|k| (rotate(k, vertex.normal) + (1 << 29)) >> 30),
        texel: vertex.texel.map(i64::from),
        density: vertex.density.into(),
    }
}

/// Projection of a vertex with z >= z0.
pub fn project(constants: &Constants, vertex: &ViewVertex) -> Result<Projected, OutOfRange> {
    let [x, y, z] = vertex.position;
    debug_assert!(z >= constants.z0, "a vertex behind z0 must be cut first");
    const ONE: i64 = i32::MAX as i64;
    let (s1_mantissa_uq1_31, bits) = reciprocal::normalise(z);
    // 1/z = r 2^-(31 + bits)
    let s2_inverse_uq0_32 = i128::from(reciprocal::golden(s1_mantissa_uq1_31));
    // z0 <= z < 2^bits and r < 2^32, so 78 bits of product leave 32, and saturate to 31.
    let s3_c = ((i128::from(constants.z0) * s2_inverse_uq0_32) >> bits).min(ONE.into()) as i64;
    // x/z with 34 fraction bits: 46 + 32 bits of product; then 16 of the focal length: 34 + 16 - 18 = 32 go.
    let pixels = |x: i64| -> Result<i64, OutOfRange> {
        let s3_slope = (i128::from(x) * s2_inverse_uq0_32) >> (bits as i32 - 3).max(0);
        let s4_pixels = (s3_slope * i128::from(constants.focal) + (1 << 31)) >> 32;
        // Only what fits the lane goes on.
        i32::try_from(s4_pixels).map(i64::from).map_err(|_| OutOfRange::Lane)
    };
    let (s4_x, s4_y) = (pixels(x)?, pixels(y)?);
    // SQ1.30 times UQ0.31: 61 bits and sign; the unit normal's rounding could reach 1.0, which saturates.
    let s4_normal = vertex.normal.map(|n| ((n * s3_c + (1 << 29)) >> 30).clamp(-ONE, ONE));
    // 32 + 31 bits of product fit 63; below c, so below 2^31.
    let scaled = |value: i64| (value * s3_c + (1 << 31)) >> 32;
    let mut data: Vertex = [0; MAX_COMPONENTS];
    data[lane::X] = s4_x;
    data[lane::Y] = s4_y;
    data[lane::C] = s3_c;
    data[lane::NORMAL..lane::NORMAL + 3].copy_from_slice(&s4_normal);
    data[lane::U] = scaled(vertex.texel[0]);
    data[lane::V] = scaled(vertex.texel[1]);
    data[lane::DENSITY] = scaled(vertex.density);
    // 32 + 32 bits; 18 + 24 fraction bits go, round half up.
    let cell = |lane: i64| (i128::from(lane) * i128::from(constants.inverse_cell) + (1 << 41)) >> 42;
    let corner = [cell(s4_x), cell(s4_y), i128::from(depth(constants, s3_c))];
    let limit = 1i128 << (constants.coordinate_bits - 1);
    if corner.iter().any(|k| !(-limit..limit).contains(k)) {
        return Err(OutOfRange::Grid);
    }
    // Within coordinate_bits <= 24 bits.
    Ok(Projected { data, corner: corner.map(|k| k as i32) })
}

/// Logarithmic grid coordinate of `c` (a lane, >= 1), in voxels, before any range check.
pub fn depth(constants: &Constants, c: i64) -> i64 {
    let (mantissa, bits) = reciprocal::normalise(c);
    // -log2 of c 2^-31 in UQ5.24; c < 2^31 keeps it positive.
    let s1_logarithm = (i64::from(32 - bits) << 24) - i64::from(power::log2_mantissa(mantissa));
    // 29 + 32 bits of product; 24 + 16 fraction bits go, round half up.
    ((s1_logarithm * i64::from(constants.octave) + (1 << 39)) >> 40) - i64::from(constants.grid_bias)
}

/// The exact lanes of a vertex in view space, in units of the last place.
pub fn exact(constants: &Constants, vertex: &ViewVertex) -> [f64; lane::COUNT] {
    let [x, y, z] = vertex.position.map(|k| k as f64);
    let (c, focal) = (constants.z0 as f64 / z, f64::from(constants.focal) / 65536.0);
    let unit = 2_147_483_648.0;
    let [nx, ny, nz] = vertex.normal.map(|n| 2.0 * n as f64 * c);
    let [u, v] = vertex.texel.map(|t| 0.5 * t as f64 * c);
    [focal * x / z * 262_144.0, focal * y / z * 262_144.0, c * unit, nx, ny, nz, u, v, 0.5 * vertex.density as f64 * c]
}
