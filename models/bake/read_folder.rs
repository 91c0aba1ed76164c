// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a folder back. What does not fit together is refused: sizes, a map that is another one, split maps with T-vertices,
//! errors that are not saturated.

use std::fs;
use std::path::Path;

use super::flip::flip;
use super::folder::{Baked, MIPS, hash};
use super::manifest::{FORMAT, Manifest, VERSION};
use super::picture::{Kind, read as read_picture};
use super::{MOST_FRACTION_BITS, Tolerance};
use crate::bisector::{Lattice, Node, SplitMap};
use crate::map::{HeightMap, Wrap};
use crate::mesh::{InputError, Place};
use crate::mip_build::Level;

/// The largest manifest.
const MANIFEST_BYTES: u64 = 1 << 20;

impl Baked {
    /// Reads a folder that [`Baked::write`] has written.
    ///
    /// # Errors
    /// A sentence: which file, what is wrong with it, and what would be right.
    pub fn read(folder: &Path) -> Result<Baked, InputError> {
        let fail = |name: &str, message: String| {
            InputError::new(&folder.join(name).display().to_string(), Place::File, message)
        };
        let manifest = manifest(&folder.join("bake.json")).map_err(|message| fail("bake.json", message))?;
        let lattice = lattice(&manifest).map_err(|message| fail("bake.json", message))?;
        let size = [manifest.map.width, manifest.map.height];
        let vertices = [lattice.side() as usize + 1; 2];
        let picture = |name: &str, kind, size| {
            read_picture(&folder.join(name), kind, size).map_err(|message| fail(name, message))
        };
        let map = HeightMap { width: size[0], height: size[1], samples: picture("map.png", Kind::Grey(16), size)? };
        if hash(&map) != manifest.map.fnv1a {
            let message = format!("has the hash {}, and bake.json says {}", hash(&map), manifest.map.fnv1a);
            return Err(fail("map.png", message + "; the map of the same run is expected"));
        }
        let (mut split, mut heights, mut errors, mut mips, mut sums, mut normals) =
            (None, None, None, None, None, None);
        if let Some(entry) = &manifest.split {
            let mut bits = SplitMap::new(&lattice);
            for (index, bit) in picture("split.png", Kind::Grey(1), vertices)?.into_iter().enumerate() {
                bits.set(index, bit == 1);
            }
            is_closed(&lattice, &bits).map_err(|message| fail("split.png", message))?;
            split = Some(bits);
            let whole = map.samples.iter().map(|&sample| u32::from(sample) << 4);
            let in_map = if entry.fitted {
                let whole = picture("heights.png", Kind::Grey(16), size)?;
                let parts = picture("fractions.png", Kind::Grey(4), size)?;
                whole.iter().zip(parts).map(|(&whole, part)| u32::from(whole) << 4 | u32::from(part)).collect()
            } else {
                whole.collect::<Vec<u32>>()
            };
            heights = Some(flip(&in_map, size[0], entry.flipped));
        }
        if let Some(entry) = &manifest.errors {
            let read = picture("errors.png", Kind::Grey(16), vertices)?;
            if entry.fraction_bits > MOST_FRACTION_BITS {
                let message = format!("has errors with {} fraction bits; at most 8 are expected", entry.fraction_bits);
                return Err(fail("bake.json", message));
            }
            are_saturated(&lattice, &read).map_err(|message| fail("errors.png", message))?;
            errors = Some(read);
        }
        if let Some(sizes) = &manifest.mips {
            if *sizes != crate::map::levels(size, [Wrap::Clamp; 2]) {
                return Err(fail("bake.json", "has `mips` of sizes that a map of this size does not have".into()));
            }
            let level = |name: &str, number: usize| {
                let samples = picture(&format!("{name}_{number}.png"), Kind::Grey(16), sizes[number])?;
                Ok::<Level, InputError>(Level { width: sizes[number][0], height: sizes[number][1], samples })
            };
            let pyramid =
                |name: &str| (0..sizes.len()).map(|number| level(name, number)).collect::<Result<Vec<_>, _>>();
            mips = Some([pyramid(MIPS[0])?, pyramid(MIPS[1])?]);
        }
        if manifest.sums.is_some() {
            let count = (size[0] + 1) * (size[1] + 1);
            let bytes = fs::read(folder.join("sums.u64"))
                .map_err(|error| fail("sums.u64", format!("cannot be read: {error}")))?;
            if bytes.len() != 8 * count {
                let message = format!("has {} bytes; {count} sums of 8 bytes are expected", bytes.len());
                return Err(fail("sums.u64", message));
            }
            sums = Some(bytes.as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes)).collect());
        }
        if manifest.normals.is_some() {
            let words = picture("normals.png", Kind::Colour, size)?;
            normals =
                Some(words.as_chunks().0.iter().map(|normal| normal.map(|word| (word ^ 0x8000) as i16)).collect());
        }
        Ok(Baked { manifest, lattice, map, split, heights, errors, mips, sums, normals })
    }
}

fn manifest(path: &Path) -> Result<Manifest, String> {
    let length = fs::metadata(path)
        .map_err(|error| format!("cannot be opened: {error}; a folder that `relief bake` has written is expected"))?;
    if length.len() > MANIFEST_BYTES {
        return Err(format!("has {} bytes; a manifest of some hundred is expected", length.len()));
    }
    let text = fs::read_to_string(path).map_err(|error| format!("cannot be read: {error}"))?;
    let value: serde_json::Value = serde_json::from_str(&text).map_err(|error| format!("is no JSON: {error}"))?;
    if value["format"] != FORMAT || value["version"] != VERSION {
        let [format, version] = [&value["format"], &value["version"]];
        return Err(format!("is of format {format}, version {version}; \"{FORMAT}\", version {VERSION}, is expected"));
    }
    serde_json::from_value(value).map_err(|error| format!("is not as version {VERSION} has it: {error}"))
}

fn lattice(manifest: &Manifest) -> Result<Lattice, String> {
    let [width, height] = [manifest.map.width, manifest.map.height].map(|side| u32::try_from(side).unwrap_or(0));
    let lattice = Lattice::of(width, height, manifest.mirrored)
        .ok_or_else(|| format!("has a map of {width} x {height} samples; 2 x 2 to 4097 x 4097 is expected"))?;
    if lattice.levels != manifest.levels {
        return Err(format!("has {} levels; {} are expected for this map", manifest.levels, lattice.levels));
    }
    if let Some(entry) = &manifest.split {
        entry.bound.parse::<Tolerance>()?;
    }
    Ok(lattice)
}

/// Refuses a split map in which a triangle with area is split that is not there.
fn is_closed(lattice: &Lattice, split: &SplitMap) -> Result<(), String> {
    let side = lattice.side();
    for vertex in (0..=side).flat_map(|v| (0..=side).map(move |u| [u, v])) {
        if !split.get(lattice.index(vertex)) {
            continue;
        }
        for node in lattice.nodes_at(vertex).filter(|&node| !lattice.is_dead(node)) {
            let apex = node.apex().map(|at| at as u32 / 2);
            let corner = apex.iter().all(|at| at.is_multiple_of(side));
            if !corner && !split.get(lattice.index(apex)) {
                return Err(format!(
                    "splits at ({}, {}) and not at ({}, {}), from which that triangle comes; a closed split map is expected",
                    vertex[0], vertex[1], apex[0], apex[1]
                ));
            }
        }
    }
    Ok(())
}

fn are_saturated(lattice: &Lattice, errors: &[u16]) -> Result<(), String> {
    let side = lattice.side();
    for vertex in (0..=side).flat_map(|v| (0..=side).map(move |u| [u, v])) {
        let own = errors[lattice.index(vertex)];
        for below in lattice.nodes_at(vertex).flat_map(Node::halves).filter_map(Node::midpoint) {
            if errors[lattice.index(below)] > own {
                return Err(format!(
                    "has the error {own} at ({}, {}) and more at ({}, {}) below it; saturated errors are expected",
                    vertex[0], vertex[1], below[0], below[1]
                ));
            }
        }
    }
    Ok(())
}
