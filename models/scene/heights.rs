// SPDX-License-Identifier: MIT OR Apache-2.0
//! The map of an object, and whether it fits into the memory.

use std::path::Path;

use super::fields;
use super::numbers::counts;
use super::object::Error;
use crate::map::{self, HeightMap, MEMORY_WORDS, Wrap};

/// The map, and the name that the scene gives it.
pub(super) fn resolve(
    map: &fields::Map,
    folder: &Path,
    warnings: &mut Vec<String>,
) -> Result<(HeightMap, String), Error> {
    match (&map.file, map.kind) {
        (Some(file), None) => {
            if map.size.is_some() {
                return Err("`size` is no field of a map file, which has its own".to_owned().into());
            }
            let path = folder.join(file);
            let (map, warning) = map::read(&path, MEMORY_WORDS).map_err(Error::File)?;
            warnings.extend(warning.map(|warning| format!("{}: {warning}", path.display())));
            Ok((map, file.clone()))
        }
        (None, Some(kind)) => {
            let limit = MEMORY_WORDS as u32;
            let whose = "the words of the map memory";
            let [width, height] = counts("size", map.size.unwrap_or([256, 256]), [1, 1], limit, whose)?;
            if u64::from(width) * u64::from(height) > MEMORY_WORDS {
                return Err(too_large(kind.name(), [width as usize, height as usize], None).into());
            }
            Ok((HeightMap::procedural(kind, width as usize, height as usize), kind.name().to_owned()))
        }
        _ => {
            let kinds = map::Procedural::ALL.map(|kind| format!("\"{}\"", kind.name())).join(", ");
            Err(format!("`map` has either a `file` (a grey PNG) or a `kind` ({kinds})").into())
        }
    }
}

fn too_large(name: &str, [width, height]: [usize; 2], words: Option<u64>) -> String {
    let words = words.map_or(String::new(), |words| format!(" takes {words} words with its levels and"));
    let limit = format!("the limit of {MEMORY_WORDS} words of the map memory");
    format!("the map {name} of {width} x {height} samples{words} is beyond {limit}; a smaller one is expected")
}

/// Refuses a map that the memory cannot hold, or not read four texels of at once.
pub(super) fn check(map: &HeightMap, wrap: [Wrap; 2], name: &str) -> Result<(), String> {
    let size = [map.width, map.height];
    for axis in 0..2 {
        if wrap[axis] == Wrap::Repeat && size[axis] % 2 == 1 {
            let (axis, size) = (["u", "v"][axis], size[axis]);
            let what = format!("the map {name} repeats in {axis} with a period of {size} samples, which is odd");
            return Err(format!("{what}; an even number, or better a power of two, is expected"));
        }
    }
    let words = map::words(size, wrap);
    if words > MEMORY_WORDS { Err(too_large(name, size, Some(words))) } else { Ok(()) }
}
