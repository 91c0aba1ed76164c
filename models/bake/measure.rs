// SPDX-License-Identifier: MIT OR Apache-2.0
//! Measures a mesh against its map: every sample against every triangle that holds it, in exact integers, by a test of
//! each sample in the box round each triangle. It shares nothing with the preparation but the walk.

use rayon::prelude::*;

use super::{Excess, Ground};
use crate::bisector::{Steering, golden};

/// What a mesh is like.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// Triangles.
    pub triangles: u64,
    /// The largest error at a sample.
    pub maximum: Excess,
    /// Twice the area of all triangles, less that of the map: 0 for a tiling. None of them is turned over or empty.
    pub missing: i64,
}

/// Triangles that are measured at a time.
const PORTION: usize = 1 << 16;

/// Measures the mesh of a steering with heights in 1/16, one a sample.
pub fn measure<S: Steering>(ground: &Ground<'_>, steering: &S, heights: &[u32]) -> Measured {
    let lattice = &ground.lattice;
    let width = lattice.width as usize;
    let one = |corners: &[[u32; 2]; 3]| -> (i64, Excess) {
        let at = |[x, y]: [u32; 2]| y as usize * width + x as usize;
        let [h0, h1, h2] = corners.map(|corner| i64::from(heights[at(corner)]));
        let [[x0, y0], [x1, y1], [x2, y2]] = corners.map(|corner| corner.map(i64::from));
        let cross = |ax: i64, ay: i64, bx: i64, by: i64| ax * by - ay * bx;
        let area = cross(x1 - x0, y1 - y0, x2 - x0, y2 - y0);
        let mut over = 0;
        for y in y0.min(y1).min(y2)..=y0.max(y1).max(y2) {
            for x in x0.min(x1).min(x2)..=x0.max(x1).max(x2) {
                let w1 = cross(x - x0, y - y0, x2 - x0, y2 - y0);
                let w2 = cross(x1 - x0, y1 - y0, x - x0, y - y0);
                let w0 = area - w1 - w2;
                if w0 >= 0 && w1 >= 0 && w2 >= 0 {
                    let sample = i64::from(ground.samples[y as usize * width + x as usize]);
                    over = over.max((w0 * h0 + w1 * h1 + w2 * h2 - 16 * area * sample).abs());
                }
            }
        }
        // A triangle turned over counts as missing twice.
        (area, if area > 0 { Excess { over, under: 16 * area } } else { Excess { over: i64::MAX >> 16, under: 1 } })
    };
    let mut measured = Measured { triangles: 0, maximum: Excess::NONE, missing: 0 };
    let mut portion: Vec<[[u32; 2]; 3]> = Vec::with_capacity(PORTION);
    let mut take = |portion: &mut Vec<[[u32; 2]; 3]>| {
        let whole = || (0, Excess::NONE);
        let (area, maximum) = portion.par_iter().map(one).reduce(whole, |a, b| (a.0 + b.0, a.1.max(b.1)));
        measured.triangles += portion.len() as u64;
        measured.missing -= area;
        measured.maximum = measured.maximum.max(maximum);
        portion.clear();
    };
    golden(lattice, steering, &mut |triangle| {
        portion.push(triangle.corners);
        if portion.len() == PORTION {
            take(&mut portion);
        }
    });
    take(&mut portion);
    measured.missing += 2 * i64::from(lattice.width - 1) * i64::from(lattice.height - 1);
    measured
}
