// SPDX-License-Identifier: MIT OR Apache-2.0
//! What widths cost on an ECP5, before anything is synthesized: cells from a plane through the measured width sets, block
//! RAM from the shapes of its memories.

use glam::{DMat3, DVec3};
use relief_hdl::widths::{WIDTH_SETS, WidthSet};
use relief_models::remesher::Format;

use super::figures::Figures;

/// The part whose measured cells the planes go through.
pub const PART: &str = "ecp5-85k";

/// The blocks of a draw whose size depends on the width set.
pub const BLOCKS: [&str; 4] = ["mip_build", "remesher", "mip_fetch", "strip_unit"];

/// Look-up tables, flip-flops and block RAMs.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Cost {
    /// LUT4.
    pub lut: f64,
    /// Flip-flops.
    pub ff: f64,
    /// DP16KD.
    pub bram: f64,
}

impl Cost {
    /// What is left of it without another one.
    #[must_use]
    pub fn less(self, other: Self) -> Self {
        Self { lut: self.lut - other.lut, ff: self.ff - other.ff, bram: self.bram - other.bram }
    }
}

/// DP16KD of a memory: the widest shape that is deep enough, or 16384 x 1.
pub const fn block_rams(words: usize, bits: usize) -> usize {
    let mut width = 36;
    let mut depth = 512;
    while depth < words && depth < 16384 {
        depth *= 2;
        width = match width {
            36 => 18,
            18 => 9,
            9 => 4,
            other => other / 2,
        };
    }
    words.div_ceil(depth) * bits.div_ceil(width)
}

/// The planes: cells = a + b L W + c N of the remesher, a + b L V of the strip unit.
#[derive(Clone, Copy, Debug)]
pub struct Planes {
    remesher: [DVec3; 2],
    strip: [DVec3; 2],
}

impl Planes {
    /// By least squares through the measured rows; `None` with fewer than three of a block.
    pub fn new(figures: &Figures) -> Option<Planes> {
        let plane = |block: &str, of: fn(&WidthSet) -> DVec3| {
            let rows = figures.rows.iter().filter(|row| row.block == block && row.target == PART);
            let points: Vec<(DVec3, [f64; 2])> = rows
                .filter_map(|row| {
                    let set = WIDTH_SETS.iter().find(|set| set.name == row.set)?;
                    Some((of(set), [row.lut as f64, row.ff as f64]))
                })
                .collect();
            let normal = points.iter().fold(DMat3::ZERO, |sum, (x, _)| sum + outer(*x));
            if points.len() < 3 || normal.determinant().abs() < 1.0 {
                return None;
            }
            Some([0, 1].map(|k| normal.inverse() * points.iter().map(|(x, cells)| *x * cells[k]).sum::<DVec3>()))
        };
        Some(Planes {
            remesher: plane("remesher", |set| remesher_at(&relief_testbench::remesher::format(set)))?,
            strip: plane("strip_unit", |set| strip_at(&relief_testbench::remesher::format(set)))?,
        })
    }

    /// Remesher, strip unit, and the memories of the map.
    pub fn cost(&self, format: &Format, bank_words: usize) -> Cost {
        let cells = |k: usize| self.remesher[k].dot(remesher_at(format)) + self.strip[k].dot(strip_at(format));
        let column = block_rams(format.column_depth, format.components * format.vertex_bits as usize);
        // The fetch has four banks of 16 bits; the builder keeps maxima and minima of half as many nodes in pairs of banks,
        // and a line of each.
        let map = 4 * block_rams(bank_words, 16) + 3 * block_rams(bank_words, 16);
        Cost { lut: cells(0), ff: cells(1), bram: (column + map) as f64 }
    }
}

fn outer(x: DVec3) -> DMat3 {
    DMat3::from_cols(x * x.x, x * x.y, x * x.z)
}

fn remesher_at(format: &Format) -> DVec3 {
    let bits = format.components as f64 * f64::from(format.accumulator_bits());
    DVec3::new(1.0, bits / 100.0, f64::from(format.coordinate_bits))
}

fn strip_at(format: &Format) -> DVec3 {
    let bits = format.components as f64 * f64::from(format.vertex_bits);
    DVec3::new(1.0, bits / 100.0, (format.column_depth.max(1) as f64).log2())
}
