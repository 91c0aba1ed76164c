// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads the text format of `scale`, `b` and `t` lines.
//!
//! Blocks of the file are parsed side by side. A block gives its vertices numbers of its own first: neighbouring
//! triangles share most of theirs, so the one table of the whole mesh is asked for a sixth of the corners only.

use rustc_hash::FxHashMap;

use super::blocks::{BlockParser, Start, lines, parse_blocks};
use super::build::{Builder, Interner};
use super::exact::Scaled;
use super::fields::{Fields, quoted};
use super::points::NARROW_LIMIT;
use super::{InputError, Mesh, Place, Progress, Source};

struct TextParser;

/// A `b` line.
struct BaseLine {
    name: u32,
    corners: [[Scaled; 3]; 3],
    line: u64,
}

/// A block with vertices and base triangles numbered by itself. Lines are those of the file.
#[derive(Default)]
struct TextBlock {
    scales: Vec<(u64, u64)>,
    bases: Vec<BaseLine>,
    vertices: Vec<[i64; 3]>,
    /// Names of the base triangles that `t` lines of the block name, each with the first of these lines.
    names: Vec<(u32, u64)>,
    triangles: Vec<[u32; 3]>,
    base_of: Vec<u32>,
}

pub(super) fn read(source: Source<'_>, progress: &dyn Progress) -> Result<Mesh, InputError> {
    let name = source.name;
    let mut builder = Builder::new(name, 1);
    let mut scale: Option<(u64, u64)> = None;
    parse_blocks(source, &TextParser, progress, |block| {
        for (value, line) in block.scales {
            if let Some((given, before)) = scale.filter(|(given, _)| *given != value) {
                let message =
                    format!("scale {value} contradicts scale {given} of line {before}; one scale is expected");
                return Err(InputError::new(name, Place::Line(line), message));
            }
            scale = Some((value, line));
        }
        for base in block.bases {
            builder.scaled_base(base.name, base.corners, Place::Line(base.line))?;
        }
        let mut bases = Vec::with_capacity(block.names.len());
        for (base, line) in block.names {
            bases.push(builder.number(base, Place::Line(line))?);
        }
        let mut vertices = Vec::with_capacity(block.vertices.len());
        for vertex in block.vertices {
            vertices.push(builder.vertex(vertex)?);
        }
        for (triangle, base) in block.triangles.iter().zip(&block.base_of) {
            builder.push(bases[*base as usize], triangle.map(|vertex| vertices[vertex as usize]))?;
        }
        Ok(())
    })?;
    builder.set_scale(scale.map_or(1, |(value, _)| value));
    builder.finish()
}

impl BlockParser for TextParser {
    type Parsed = TextBlock;

    fn count(&self, _block: &[u8]) -> u64 {
        0
    }

    fn parse(&self, bytes: &[u8], start: Start) -> Result<TextBlock, (u64, String)> {
        let mut block = TextBlock::default();
        let mut vertices = Interner::new();
        let mut numbers: FxHashMap<u32, u32> = FxHashMap::default();
        // Triangles of one base mostly follow one another.
        let mut last = None;
        for (index, line) in lines(bytes) {
            let number = start.lines + index + 1;
            let at = |message: String| (index, message);
            let mut fields = Fields::new(line);
            match fields.next() {
                None => continue,
                Some(word) if word[0] == b'#' => continue,
                Some(b"t") => {
                    let base = base_name(&mut fields).map_err(at)?;
                    let mut triangle = [0; 3];
                    for vertex in &mut triangle {
                        let mut corner = [0; 3];
                        for value in &mut corner {
                            *value = coordinate(&mut fields).map_err(at)?;
                        }
                        // A block of 2^32 vertices would be 24 GB.
                        *vertex = vertices.intern(corner).ok_or_else(|| at("has too many vertices".into()))?;
                    }
                    let local = match last {
                        Some((name, local)) if name == base => local,
                        _ => *numbers.entry(base).or_insert_with(|| {
                            block.names.push((base, number));
                            block.names.len() as u32 - 1
                        }),
                    };
                    last = Some((base, local));
                    block.triangles.push(triangle);
                    block.base_of.push(local);
                }
                Some(b"b") => {
                    let name = base_name(&mut fields).map_err(at)?;
                    let mut corners = [[Scaled::default(); 3]; 3];
                    for value in corners.iter_mut().flatten() {
                        *value = fields.decimal("a coordinate").map_err(at)?;
                    }
                    block.bases.push(BaseLine { name, corners, line: number });
                }
                Some(b"scale") => {
                    let value = fields.integer("an integer").map_err(at)?;
                    if !(1..NARROW_LIMIT).contains(&value) {
                        return Err(at(format!(
                            "scale {value} is out of range; an integer from 1 to 2^61 is expected"
                        )));
                    }
                    block.scales.push((value as u64, number));
                }
                Some(word) => {
                    let message =
                        format!("a line cannot begin with {}; `scale`, `b`, `t` or `#` is expected", quoted(word));
                    return Err(at(message));
                }
            }
            // A comment may follow.
            if let Some(word) = fields.next().filter(|word| word[0] != b'#') {
                return Err(at(fields.wrong(word, "is one too many; the line should end here")));
            }
        }
        block.vertices = vertices.keys;
        Ok(block)
    }
}

fn base_name(fields: &mut Fields<'_>) -> Result<u32, String> {
    const WHAT: &str = "the number of a base triangle (0 to 4294967295)";
    let value = fields.integer(WHAT)?;
    u32::try_from(value).map_err(|_| format!("field 2 `{value}` is not {WHAT}"))
}

#[inline]
fn coordinate(fields: &mut Fields<'_>) -> Result<i64, String> {
    let value = fields.integer("an integer coordinate (over the scale)")?;
    if value.unsigned_abs() < NARROW_LIMIT as u64 {
        return Ok(value);
    }
    Err(format!("coordinate {value} is out of range; its magnitude has to be less than 2^61"))
}
