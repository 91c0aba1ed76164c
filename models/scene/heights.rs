// SPDX-License-Identifier: MIT OR Apache-2.0
//! The map of an object, if the memory can hold it.

use std::path::Path;

use super::fields;
use super::numbers::counts;
use super::object::Error;
use crate::map::{self, HeightMap, Limit, Wrap};

/// The map, and the name that the scene gives it. Its size is checked before there are any samples.
pub(super) fn resolve(
    map: &fields::Map,
    wrap: [Wrap; 2],
    folder: &Path,
    warnings: &mut Vec<String>,
) -> Result<(HeightMap, String), Error> {
    let check = |size: [usize; 2]| Limit::LARGEST.check(size, wrap, usize::MAX, false);
    match (&map.file, map.kind) {
        (Some(file), None) => {
            if map.size.is_some() {
                return Err("`size` is no field of a map file, which has its own".to_owned().into());
            }
            let path = folder.join(file);
            let (map, warning) = map::read(&path, &check).map_err(Error::File)?;
            warnings.extend(warning.map(|warning| format!("{}: {warning}", path.display())));
            Ok((map, file.clone()))
        }
        (None, Some(kind)) => {
            let whose = "the limit of a map's side";
            let size = map.size.map_or([256, 256], |size| size.0);
            let [width, height] = counts("size", size, [1, 1], Limit::LARGEST.side as u32, whose)?;
            let (name, [width, height]) = (kind.name(), [width, height].map(|side| side as usize));
            check([width, height])
                .map_err(|problem| format!("the map {name} of {width} x {height} samples {problem}"))?;
            Ok((HeightMap::procedural(kind, width, height), name.to_owned()))
        }
        _ => {
            let kinds = map::Procedural::ALL.map(|kind| format!("\"{}\"", kind.name())).join(", ");
            Err(format!("`map` has either a `file` (a grey PNG) or a `kind` ({kinds})").into())
        }
    }
}
