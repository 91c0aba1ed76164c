// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a vertex faces away from the eye, by its own normal: which of the two pyramids it reads.
//!
//! ```text
//! S = nx c (X >> 14) + ny c (Y >> 14) + nz c (f >> 12)        away <=> S >= 0
//! ```
//!
//! (X, Y, f) is the line of sight in pixels, so S has the sign of n . p. All three have 4 fraction bits, and the common factor c is
//! positive. The paper asks the base triangle (Gumhold & Huettner 1999, section 4: minima where it is viewed from the
//! back side), and two base triangles of an edge may answer differently; a vertex has one answer wherever it is used.
//!
//! | value      | format  | range |
//! |------------|---------|-------|
//! | X, Y       | SQ0.31  | of 8192 pixels from the viewport's centre; 18 bits are read |
//! | nx c .. nz c | SQ0.31 | any |
//! | f          | UQ16.16 | focal length in pixels; 20 bits are read |
//! | S          | integer | 54 bits; 0, as of a normal without length, counts as away |
//!
//! Error: the line of sight is that of a point at most 1/16 pixel to the left and above, under a focal length at most 1/16
//! pixel shorter.
//!
//! Example: straight ahead (X = Y = 0), a normal towards the eye has nz < 0: S < 0, not away.

use crate::step::Vertex;
use crate::vertex_transform::lane;

/// Whether S >= 0: `normal` is nx c, ny c, nz c and `across` X, Y, all SQ0.31; `focal` is UQ16.16.
pub fn golden(normal: [i64; 3], across: [i64; 2], focal: u32) -> bool {
    let sight = [across[0] >> 14, across[1] >> 14, i64::from(focal >> 12)];
    // 32 by 18, 18 and 21 bits: 50, 50 and 53, of which the sum has 54.
    normal.into_iter().zip(sight).map(|(along, towards)| along * towards).sum::<i64>() >= 0
}

/// Of a vertex with all lanes of 32 bits.
pub fn of_vertex(vertex: &Vertex, focal: u32) -> bool {
    let normal = std::array::from_fn(|k| vertex[lane::NORMAL + k]);
    golden(normal, [vertex[lane::X], vertex[lane::Y]], focal)
}

/// The exact cosine between the normal and the line of sight, for a normal with a length: at least 0 is away.
pub fn exact(normal: [i64; 3], across: [i64; 2], focal: u32) -> f64 {
    let pixels = |lane: i64| lane as f64 / 262_144.0;
    let normal = glam::DVec3::from(normal.map(|value| value as f64));
    let sight = glam::DVec3::new(pixels(across[0]), pixels(across[1]), f64::from(focal) / 65536.0);
    normal.dot(sight) / (normal.length() * sight.length())
}
