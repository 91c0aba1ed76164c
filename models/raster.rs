// SPDX-License-Identifier: MIT OR Apache-2.0
//! Golden rasteriser: integer triangles to pixels, depth-tested, and pictures as PNG.
//!
//! ```text
//! centre of pixel (i, j)   px = 256 i + 128 - 128 width     py = 256 j + 128 - 128 height
//! edge from a to b         E = dx (py - ay) - dy (px - ax)  dx = bx - ax, dy = by - ay
//! inside                   E > 0, or E = 0 and (dy < 0 or (dy = 0 and dx > 0)), for all three edges
//! depth                    floor((E_bc c_a + E_ca c_b + E_ab c_c) / 2 area)
//! ```
//!
//! Triangles are turned to positive area first, so both facings are drawn; those without area are dropped. An edge that
//! two triangles share gives each of its pixels to one of them, so a mesh has neither holes nor pixels drawn twice. The
//! larger depth wins, and the first of equals stays.
//!
//! | in_corner | format | range |
//! |---|---|---|
//! | x, y | SQ13.8 | pixels from the centre of the picture, x to the right, y down |
//! | depth | UQ0.32 | c' = z0 / z, larger is nearer; 0 is behind everything |
//!
//! Example, a picture of 2 x 2 pixels: the triangle (-1, -1), (1, -1), (-1, 1) touches the centres of three. Two of them lie
//! on its long edge, which goes down, `dy > 0`, so they belong to the triangle on the other side.
//!
//! ```
//! use relief_models::raster::{Corner, cover};
//! let corner = |x, y| Corner { x: 256 * x, y: 256 * y, depth: 9 };
//! let mut pixels = Vec::new();
//! cover([corner(-1, -1), corner(1, -1), corner(-1, 1)], [2, 2], |fragment| pixels.push([fragment.x, fragment.y]));
//! assert_eq!(pixels, [[0, 0]]);
//! ```

mod edges;
mod frame;

pub use frame::Frame;

/// Fraction bits of a pixel.
pub const SUBPIXEL_BITS: u32 = 8;
const HALF: i64 = 1 << (SUBPIXEL_BITS - 1);

/// A corner of a triangle on the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Corner {
    /// Pixels to the right of the picture's centre, SQ13.8. Larger pictures of the same may take up to 28 bits.
    pub x: i32,
    /// Pixels below the picture's centre, SQ13.8.
    pub y: i32,
    /// Nearness, UQ0.32.
    pub depth: u32,
}

impl Corner {
    /// The same corner on a picture that is `scale` times as large, 16 at most.
    pub fn scaled(self, scale: i32) -> Corner {
        Corner { x: self.x * scale, y: self.y * scale, ..self }
    }
}

/// A pixel that a triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fragment {
    /// Column, 0 on the left.
    pub x: u32,
    /// Row, 0 on top.
    pub y: u32,
    /// The triangle's depth there.
    pub depth: u32,
    /// The three edge functions, 256^2 times pixel areas: opposite to the first, second and third corner as oriented.
    pub edges: [i64; 3],
}

/// The corners in the order in which their area is positive, and twice that area. `None` without area.
fn orient(corners: [Corner; 3]) -> Option<([Corner; 3], i64)> {
    let [a, b, c] = corners;
    let area = edge(a, b, i64::from(c.x), i64::from(c.y));
    match area {
        0 => None,
        1.. => Some((corners, area)),
        _ => Some(([a, c, b], -area)),
    }
}

/// The edge function from `a` to `b`. Differences fit 29 bits, so the products fit 58.
fn edge(a: Corner, b: Corner, x: i64, y: i64) -> i64 {
    let (dx, dy) = (i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y));
    dx * (y - i64::from(a.y)) - dy * (x - i64::from(a.x))
}

/// Whether the pixels on the edge from `a` to `b` belong to this side of it: top and left edges.
fn owns(a: Corner, b: Corner) -> bool {
    b.y < a.y || (b.y == a.y && b.x > a.x)
}

/// Visits the pixels of a triangle on a picture of `size` pixels, row by row. Returns whether the triangle has area.
pub fn cover(corners: [Corner; 3], size: [u32; 2], mut visit: impl FnMut(Fragment)) -> bool {
    debug_assert!(corners.iter().all(|corner| corner.x.abs() < 1 << 28 && corner.y.abs() < 1 << 28));
    let Some((corners, area)) = orient(corners) else { return false };
    let [a, b, c] = corners;
    // The pixels whose centres are within the box of the corners, cut to the picture.
    let range = |values: [i32; 3], count: u32| {
        let offset = HALF * i64::from(count);
        let [low, high] =
            [values.iter().min(), values.iter().max()].map(|value| i64::from(*value.unwrap_or(&0)) + offset);
        let first = (low + HALF - 1) >> SUBPIXEL_BITS;
        let last = (high - HALF) >> SUBPIXEL_BITS;
        (first.max(0), last.min(i64::from(count) - 1))
    };
    let (columns, rows) = (range([a.x, b.x, c.x], size[0]), range([a.y, b.y, c.y], size[1]));
    let sides = [(b, c), (c, a), (a, b)].map(|(from, to)| (from, to, owns(from, to)));
    for row in rows.0..=rows.1 {
        let y = 2 * HALF * row + HALF - HALF * i64::from(size[1]);
        for column in columns.0..=columns.1 {
            let x = 2 * HALF * column + HALF - HALF * i64::from(size[0]);
            let edges = sides.map(|(from, to, _)| edge(from, to, x, y));
            if (0..3).all(|side| edges[side] > 0 || (edges[side] == 0 && sides[side].2)) {
                let sum: i128 = edges
                    .iter()
                    .zip([a, b, c])
                    .map(|(edge, corner)| i128::from(*edge) * i128::from(corner.depth))
                    .sum();
                // A mean of three depths, so it fits again.
                let depth = (sum / i128::from(area)) as u32;
                visit(Fragment { x: column as u32, y: row as u32, depth, edges });
            }
        }
    }
    true
}
