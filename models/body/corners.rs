// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads the statements `v`, `vt`, `vn` and `f` of an OBJ file as triangles of indices.

use glam::{DVec2, DVec3, dvec2, dvec3};

use crate::mesh::fields::{Fields, parse_integer, quoted};
use crate::mesh::read_obj::is_skipped;
use crate::mesh::{InputError, Place};

/// A magnitude beyond which squares and products of coordinates are no use any more.
const FAR_AWAY: f64 = 1e9;
/// Base triangles that a file may hold.
const TRIANGLES: usize = 1 << 20;

/// A corner of a face: its vertex, and its texture vertex and normal if it names them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) texture: Option<u32>,
    pub(super) normal: Option<u32>,
}

/// What the file says.
#[derive(Default)]
pub(super) struct Statements {
    pub(super) positions: Vec<DVec3>,
    textures: Vec<DVec2>,
    normals: Vec<DVec3>,
    pub(super) triangles: Vec<[Corner; 3]>,
}

impl Statements {
    /// Place on the map; OBJ counts its second number from the bottom.
    pub(super) fn uv(&self, corner: Corner) -> Option<DVec2> {
        let texture = self.textures[corner.texture? as usize];
        Some(dvec2(texture.x, 1.0 - texture.y))
    }

    /// Normal of length 1.
    pub(super) fn normal(&self, corner: Corner) -> Option<DVec3> {
        Some(self.normals[corner.normal? as usize])
    }
}

pub(super) fn parse(bytes: &[u8], name: &str) -> Result<Statements, InputError> {
    let mut all = Statements::default();
    for (index, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        statement(line, &mut all).map_err(|message| InputError::new(name, Place::Line(index as u64 + 1), message))?;
    }
    Ok(all)
}

fn statement(line: &[u8], all: &mut Statements) -> Result<(), String> {
    if line.trim_ascii_end().last() == Some(&b'\\') {
        return Err("continues on the next line (`\\`), which is not supported; join the lines".into());
    }
    let mut fields = Fields::new(line);
    match fields.next() {
        None => {}
        Some(word) if word[0] == b'#' => {}
        Some(b"v") => all.positions.push(vector(&mut fields, "a coordinate")?),
        Some(b"vt") => {
            let what = "a texture coordinate";
            all.textures.push(dvec2(number(&mut fields, what)?, number(&mut fields, what)?));
        }
        Some(b"vn") => {
            let normal = vector(&mut fields, "a component of a normal")?;
            let unit = normal.try_normalize();
            all.normals.push(unit.ok_or("is a normal without length; one that points outward is expected")?);
        }
        Some(b"f") => face(&mut fields, all)?,
        Some(b"g" | b"o") => {}
        Some(word) if is_skipped(word) => {}
        Some(word) => {
            let what = "is no OBJ statement; `v`, `vt`, `vn`, `f` or the like is expected";
            return Err(format!("{} {what}", quoted(word)));
        }
    }
    Ok(())
}

fn vector(fields: &mut Fields<'_>, what: &str) -> Result<DVec3, String> {
    Ok(dvec3(number(fields, what)?, number(fields, what)?, number(fields, what)?))
}

fn number(fields: &mut Fields<'_>, what: &str) -> Result<f64, String> {
    let word = fields.expect(what)?;
    let value = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f64>().ok());
    match value {
        Some(value) if value.abs() <= FAR_AWAY => Ok(value),
        Some(_) => Err(fields.wrong(word, &format!("is not a finite number up to 1e9; {what} is expected"))),
        None => Err(fields.wrong(word, &format!("is no number; {what} is expected"))),
    }
}

/// Adds the fan of a face about its first corner.
fn face(fields: &mut Fields<'_>, all: &mut Statements) -> Result<(), String> {
    let mut corners: Vec<Corner> = Vec::with_capacity(4);
    while let Some(word) = fields.next() {
        if word[0] == b'#' {
            break;
        }
        let mut parts = word.split(|byte| *byte == b'/');
        let mut index = |what: &str, count: usize| match parts.next() {
            None | Some(b"") => Ok(None),
            Some(part) => resolve(part, count).map(Some).ok_or_else(|| {
                let sentence = format!("names no {what}; {count} have been defined, counted from 1 (or -1 backwards)");
                fields.wrong(word, &sentence)
            }),
        };
        let position = index("vertex", all.positions.len())?;
        let texture = index("texture vertex", all.textures.len())?;
        let normal = index("normal", all.normals.len())?;
        let Some(position) = position.filter(|_| parts.next().is_none()) else {
            return Err(fields.wrong(word, "is not a vertex number, with or without /texture/normal"));
        };
        corners.push(Corner { position, texture, normal });
    }
    if corners.len() < 3 {
        return Err(format!("a face of {} corners is no polygon; at least 3 are expected", corners.len()));
    }
    if all.triangles.len() + corners.len() - 2 > TRIANGLES {
        return Err(format!("is beyond the limit of {TRIANGLES} base triangles; a base mesh is a coarse one"));
    }
    all.triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
    Ok(())
}

/// The index behind an OBJ number, which counts from 1, or backwards from -1.
fn resolve(part: &[u8], count: usize) -> Option<u32> {
    let value = parse_integer(part)?;
    let distance = usize::try_from(value.unsigned_abs()).ok().filter(|distance| (1..=count).contains(distance))?;
    u32::try_from(if value > 0 { distance - 1 } else { count - distance }).ok()
}
