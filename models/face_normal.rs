// SPDX-License-Identifier: MIT OR Apache-2.0
//! Normal of a displaced triangle in view space, towards the viewer, without a division.
//!
//! The plane through the points `q_i = (x_i, y_i, 1) / c_i` has the normal that solves `N . (x_i, y_i, 1) = c_i`; Cramer's
//! rule gives it but for the determinant A, twice the triangle's area on the screen:
//!
//! ```text
//! Nx = dc1 dy2 - dc2 dy1    Ny = dx1 dc2 - dx2 dc1    A = dx1 dy2 - dx2 dy1    Nz = A c0 - Nx x0 - Ny y0
//! ```
//!
//! with differences to vertex 0. It is the direction of `(q1 - q0) x (q2 - q0)`, for three reciprocals less, and exact up to
//! the normalisation. A is the sign of `N . q`: A > 0 points away from the eye, so N is negated.
//!
//! | port   | format | unit |
//! |--------|--------|------|
//! | X', Y', c' | SQ13.8, SQ13.8, UQ0.31 | pixels, 1 |
//! | normal | 3 x SQ1.16 | unit vector; (0, 0, -1) for three equal points |
//!
//! Error: that of [`normalize`](crate::rsqrt::normalize), 3.3e-5 rad; what the rounding of X', Y' and c' did to the triangle
//! is not in it.
//!
//! Example: c' equal at all three vertices (a plane at one depth): N = (0, 0, -1).

use crate::rsqrt::normalize_wide;
use serde::{Deserialize, Serialize};

/// The size of a pixel at distance 1, `scale 2^-shift`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pixel {
    /// Mantissa, 24 bits with the leading one set.
    pub scale: u32,
    /// Exponent, `16..=48`.
    pub shift: u32,
}

/// The normal of the triangle with the vertices (X', Y', c').
pub fn golden(pixel: &Pixel, [a, b, c]: [[i64; 3]; 3]) -> [i32; 3] {
    // 22 bits and sign in X and Y, 31 bits and sign in c.
    let d = |v: [i64; 3]| [0, 1, 2].map(|k| v[k] - a[k]);
    let ([x1, y1, c1], [x2, y2, c2]) = (d(b), d(c));
    // Twice the area of a triangle, which is at most that of the box round it: 31 + 22 bits and sign, twice; 22 + 22 bits.
    let (nx, ny, area) = (c1 * y2 - c2 * y1, x1 * c2 - x2 * c1, x1 * y2 - x2 * y1);
    // The determinant of three rows (x, y, c), at most 4 2^21 2^21 2^31: 75 bits and sign. No term has more.
    let nz =
        i128::from(area) * i128::from(a[2]) - i128::from(nx) * i128::from(a[0]) - i128::from(ny) * i128::from(a[1]);
    // x and y count pixels (2^-8), and the pixel's size carries them to view space: N is (nx, ny, 2^-8 pixel nz).
    // 16 further bits keep the small triangles; 75 + 24 bits of product, of which at least 8 go.
    let (wide_x, wide_y) = (i128::from(nx) << 16, i128::from(ny) << 16);
    let shift = 8 + pixel.shift;
    let wide_z = (nz * i128::from(pixel.scale)) >> (shift - 16);
    let sign = if area > 0 { -1 } else { 1 };
    let n = normalize_wide([wide_x, wide_y, wide_z].map(|v| sign * v));
    if n == [0; 3] { [0, 0, -1 << 16] } else { n }
}

/// The exact normal from f64 cross products, towards the viewer; `None` without area.
///
/// Starts at the nearest vertex: far ones are too large to leave anything of it in a difference.
pub fn exact(pixel: &Pixel, mut vertices: [[i64; 3]; 3]) -> Option<[f64; 3]> {
    let nearest = (0..3).max_by_key(|&k| vertices[k][2]).unwrap_or(0);
    vertices.rotate_left(nearest);
    let s = f64::from(pixel.scale) * (-f64::from(pixel.shift)).exp2() / 256.0;
    let [a, b, c] = vertices.map(|v| {
        let c = v[2] as f64 / 2_147_483_648.0;
        glam::DVec3::new(v[0] as f64 * s / c, v[1] as f64 * s / c, 1.0 / c)
    });
    let n = (b - a).cross(c - a).try_normalize()?;
    Some(if n.dot(a) > 0.0 { -n } else { n }.to_array())
}
