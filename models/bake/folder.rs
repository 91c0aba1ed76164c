// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writes what has been prepared into a folder. `docs/bake.md` tells the format of each file.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::flip::flip;
use super::manifest::Manifest;
use super::picture::{Kind, write as write_picture};
use crate::bisector::{Lattice, SplitMap};
use crate::map::HeightMap;
use crate::mip_build::Level;

/// What a folder holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Baked {
    /// The manifest.
    pub manifest: Manifest,
    /// The lattice of the map.
    pub lattice: Lattice,
    /// The map, voids filled.
    pub map: HeightMap,
    /// The split map.
    pub split: Option<SplitMap>,
    /// The heights of the split map, UQ16.4, one a sample: the fitted ones, or the map's. In the order of the lattice, which
    /// is that of the map once it is flipped as the manifest says.
    pub heights: Option<Vec<u32>>,
    /// Saturated errors, one a lattice vertex.
    pub errors: Option<Vec<u16>>,
    /// The levels of maxima, and of minima.
    pub mips: Option<[Vec<Level>; 2]>,
    /// The summed-area table, rows of width + 1 sums.
    pub sums: Option<Vec<u64>>,
    /// Normals.
    pub normals: Option<Vec<[i16; 3]>>,
}

/// Names of the pyramids' files.
pub(super) const MIPS: [&str; 2] = ["max", "min"];

/// Whether a file of this name is one that a folder may hold, so that it goes when a new folder has none.
pub fn is_ours(name: &str) -> bool {
    let fixed = ["map.png", "split.png", "heights.png", "fractions.png", "errors.png", "sums.u64", "normals.png"];
    let level = |name: &str| MIPS.iter().any(|mip| name.strip_prefix(mip).is_some_and(|rest| rest.starts_with('_')));
    fixed.contains(&name) || name == "bake.json" || (level(name) && name.ends_with(".png"))
}

/// FNV-1a over width and height (32 bits each) and the samples (16 bits each), all little-endian: 64 bits.
pub fn hash(map: &HeightMap) -> String {
    let sizes = [map.width, map.height].into_iter().flat_map(|side| (side as u32).to_le_bytes());
    let samples = map.samples.iter().flat_map(|sample| sample.to_le_bytes());
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
    format!("{:016x}", sizes.chain(samples).fold(0xcbf2_9ce4_8422_2325, mix))
}

impl Baked {
    /// Writes the files into a folder that is there.
    ///
    /// # Errors
    /// The system's.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let size = [self.map.width, self.map.height];
        let lattice = [self.lattice.side() as usize + 1; 2];
        let grey = |name: &str, size, sample: &dyn Fn(usize) -> u16| {
            write_picture(&folder.join(name), Kind::Grey(16), size, sample)
        };
        grey("map.png", size, &|at| self.map.samples[at])?;
        if let Some(split) = &self.split {
            write_picture(&folder.join("split.png"), Kind::Grey(1), lattice, |at| split.get(at).into())?;
        }
        if let (Some(heights), Some(entry)) = (&self.heights, self.manifest.split.as_ref().filter(|split| split.fitted))
        {
            let heights = flip(heights, self.map.width, entry.flipped);
            grey("heights.png", size, &|at| (heights[at] >> 4) as u16)?;
            write_picture(&folder.join("fractions.png"), Kind::Grey(4), size, |at| (heights[at] & 15) as u16)?;
        }
        if let Some(errors) = &self.errors {
            grey("errors.png", lattice, &|at| errors[at])?;
        }
        for (name, levels) in MIPS.iter().zip(self.mips.iter().flatten()) {
            for (number, level) in levels.iter().enumerate() {
                grey(&format!("{name}_{number}.png"), [level.width, level.height], &|at| level.samples[at])?;
            }
        }
        if let Some(sums) = &self.sums {
            let mut file = BufWriter::new(File::create(folder.join("sums.u64"))?);
            for sum in sums {
                file.write_all(&sum.to_le_bytes())?;
            }
            file.flush()?;
        }
        if let Some(normals) = &self.normals {
            let word = |at: usize| (normals[at / 3][at % 3] as u16) ^ 0x8000;
            write_picture(&folder.join("normals.png"), Kind::Colour, size, word)?;
        }
        fs::write(folder.join("bake.json"), serde_json::to_string_pretty(&self.manifest)? + "\n")
    }
}
