// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads vertices, faces and groups of a Wavefront OBJ file.
//!
//! A reader of our own, because exactness and the place of a mistake are the point here: `tobj` 4 hands out `f32` or
//! `f64`, so a decimal is rounded before it can be compared, and its `LoadError` carries neither line nor field. It also
//! parses on one core. Faces with more than three corners are cut into a fan about their first corner. Of the other
//! statements, those that OBJ defines are skipped; anything else is refused, so that no binary file passes for empty.

use super::blocks::{BlockParser, Start, lines, parse_blocks};
use super::build::{Indexed, Run};
use super::exact::{Radix, Scaled};
use super::fields::{Fields, parse_integer, quoted};
use super::{InputError, Place, Progress, Source};

/// Statements of the OBJ specification (and common extensions) that say nothing about triangles.
const SKIPPED: &[&[u8]] = &[
    b"vt",
    b"vn",
    b"vp",
    b"s",
    b"l",
    b"p",
    b"usemtl",
    b"mtllib",
    b"usemap",
    b"maplib",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"mg",
    b"shadow_obj",
    b"trace_obj",
    b"cstype",
    b"deg",
    b"bmat",
    b"step",
    b"curv",
    b"curv2",
    b"surf",
    b"parm",
    b"trim",
    b"hole",
    b"scrv",
    b"sp",
    b"end",
    b"con",
    b"ctech",
    b"stech",
    b"call",
    b"csh",
];

/// Whether a word begins a statement that says nothing about triangles.
pub(crate) fn is_skipped(word: &[u8]) -> bool {
    SKIPPED.contains(&word)
}

struct ObjParser;

struct ObjBlock {
    indexed: Indexed,
    /// Whether the first run goes on with the group of the block before.
    inherits: bool,
}

pub(super) fn read(source: Source<'_>, progress: &dyn Progress) -> Result<Indexed, InputError> {
    let name = source.name;
    let mut all = Indexed::new(Radix::Ten);
    let mut group = None;
    parse_blocks(source, &ObjParser, progress, |ObjBlock { mut indexed, inherits }| {
        all.vertices.append(&mut indexed.vertices);
        let offset = all.triangles.len();
        all.triangles.append(&mut indexed.triangles);
        all.has_room(0).map_err(|message| InputError::new(name, Place::File, message))?;
        for (index, mut run) in indexed.runs.into_iter().enumerate() {
            if index == 0 && inherits {
                run.base = group;
            }
            group = run.base;
            run.first += offset;
            all.runs.push(run);
        }
        Ok(())
    })?;
    Ok(all)
}

impl BlockParser for ObjParser {
    type Parsed = ObjBlock;

    /// Vertices, which faces of later blocks count from.
    fn count(&self, block: &[u8]) -> u64 {
        lines(block).filter(|(_, line)| Fields::new(line).next() == Some(b"v")).count() as u64
    }

    fn parse(&self, bytes: &[u8], start: Start) -> Result<ObjBlock, (u64, String)> {
        let mut block = ObjBlock { indexed: Indexed::new(Radix::Ten), inherits: true };
        let ObjBlock { indexed, inherits } = &mut block;
        for (index, line) in lines(bytes) {
            let place = Place::Line(start.lines + index + 1);
            let at = |message: String| (index, message);
            if line.trim_ascii_end().last() == Some(&b'\\') {
                return Err(at("continues on the next line (`\\`), which is not supported; join the lines".into()));
            }
            let mut fields = Fields::new(line);
            match fields.next() {
                None => {}
                Some(word) if word[0] == b'#' => {}
                Some(b"v") => {
                    let mut vertex = [Scaled::default(); 3];
                    for value in &mut vertex {
                        *value = fields.decimal("a coordinate").map_err(at)?;
                    }
                    // A weight or a colour may follow.
                    indexed.vertices.push(vertex);
                }
                Some(b"f") => {
                    match indexed.runs.last_mut() {
                        // Whose the face is depends on the block before: the merger knows.
                        None => indexed.runs.push(Run { first: 0, base: None, place }),
                        // A group without a base number is reported where its first face stands.
                        Some(run) if run.base.is_none() && run.first == indexed.triangles.len() => run.place = place,
                        Some(_) => {}
                    }
                    face(&mut fields, start.counted + indexed.vertices.len() as u64, &mut indexed.triangles)
                        .map_err(at)?;
                }
                Some(b"g" | b"o") => {
                    let base = fields.next().and_then(base_of_group).transpose().map_err(at)?;
                    if indexed.runs.is_empty() {
                        *inherits = false;
                    }
                    indexed.runs.push(Run { first: indexed.triangles.len(), base, place });
                }
                Some(word) if is_skipped(word) => {}
                Some(word) => {
                    let message =
                        format!("{} is no OBJ statement; `v`, `f`, `g` or the like is expected", quoted(word));
                    return Err(at(message));
                }
            }
        }
        Ok(block)
    }
}

/// The number in `base_<I>`; other names stand for no base triangle.
fn base_of_group(name: &[u8]) -> Option<Result<u32, String>> {
    let digits = name.strip_prefix(b"base_")?;
    let number = parse_integer(digits).and_then(|value| u32::try_from(value).ok());
    Some(number.ok_or_else(|| format!("group {} does not end in the number of a base triangle", quoted(name))))
}

/// Adds the fan of an `f` line; `vertices` have been defined before it.
fn face(fields: &mut Fields<'_>, vertices: u64, triangles: &mut Vec<[u32; 3]>) -> Result<(), String> {
    let (mut first, mut last) = (0, 0);
    let mut corners = 0u64;
    while let Some(word) = fields.next() {
        if word[0] == b'#' {
            break;
        }
        // v, v/vt, v/vt/vn or v//vn: only the position counts.
        let position = word.split(|byte| *byte == b'/').next().unwrap_or(word);
        let corner = match parse_integer(position) {
            Some(value) if value > 0 && value as u64 <= vertices => value as u64 - 1,
            Some(value) if value < 0 && value.unsigned_abs() <= vertices => vertices - value.unsigned_abs(),
            Some(_) => {
                let what = format!("names no vertex; {vertices} have been defined, counted from 1 (or -1 backwards)");
                return Err(fields.wrong(word, &what));
            }
            None => return Err(fields.wrong(word, "is not a vertex number, with or without /texture/normal")),
        };
        // 2^32 vertices are refused when blocks are merged, before the truncated number is used.
        let corner = corner as u32;
        match corners {
            0 => first = corner,
            1 => {}
            _ => triangles.push([first, last, corner]),
        }
        last = corner;
        corners += 1;
    }
    if corners < 3 {
        return Err(format!("a face of {corners} corners is no polygon; at least 3 are expected"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn group_numbers() {
        assert_eq!(base_of_group(b"base_12"), Some(Ok(12)));
        assert_eq!(base_of_group(b"lid"), None);
        assert!(matches!(base_of_group(b"base_x"), Some(Err(_))));
    }
}
