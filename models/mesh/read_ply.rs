// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads vertices and faces of a PLY file: ascii, binary little endian and binary big endian.
//!
//! A reader of our own. `ply-rs-bw` 4 is the best kept PLY crate, but it rounds ascii numbers to the declared float
//! before they can be compared, and keeps neither line nor byte offset once the payload is parsed. Ascii numbers are
//! taken as the decimals they are, binary ones as the exact value of their bits.
//!
//! Needed are an element `vertex` with scalar properties `x`, `y`, `z`, and an element `face` with the list property
//! `vertex_indices` (or `vertex_index`). A scalar face property `base` is the number of the face's base triangle.
//! Everything else is skipped. Faces with more than three corners are cut into a fan about their first corner.

use std::io::Read;

use super::build::{Indexed, Run};
use super::exact::{Radix, Scaled};
use super::fields::{Fields, quoted};
use super::{InputError, Place, Progress, Source};

/// A header that is longer than this is none.
const LONGEST_HEADER_LINE: usize = 1 << 16;
const BUFFER_BYTES: usize = 1 << 20;
/// Steps between two reports of progress.
const REPORT_EVERY: u64 = 1 << 16;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Ascii,
    Little,
    Big,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of(word: &[u8]) -> Option<Scalar> {
        Some(match word {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }

    fn is_float(self) -> bool {
        matches!(self, Scalar::F32 | Scalar::F64)
    }
}

/// What a property is to us.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    Axis(usize),
    Corners,
    Base,
    Skipped,
}

#[derive(Debug)]
struct Property {
    name: String,
    /// The type of the length, for a list.
    length: Option<Scalar>,
    scalar: Scalar,
    role: Role,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Vertex,
    Face,
    Other,
}

#[derive(Debug)]
struct Element {
    kind: Kind,
    name: String,
    count: u64,
    properties: Vec<Property>,
}

/// The bytes of the file, with the place reached.
struct Input<'a> {
    name: &'a str,
    bytes: &'a mut dyn Read,
    buffer: Vec<u8>,
    /// `buffer[from..]` has not been used.
    from: usize,
    at_end: bool,
    /// Bytes used.
    offset: u64,
    /// Lines used.
    line: u64,
    /// Whether places are lines; bytes otherwise.
    by_line: bool,
}

impl<'a> Input<'a> {
    fn place(&self) -> Place {
        if self.by_line { Place::Line(self.line) } else { Place::Byte(self.offset) }
    }

    fn error(&self, message: impl Into<String>) -> InputError {
        InputError::new(self.name, self.place(), message)
    }

    /// Reads more bytes behind the unused ones; false at the end of the file.
    fn refill(&mut self) -> Result<bool, InputError> {
        if self.at_end {
            return Ok(false);
        }
        self.buffer.drain(..self.from);
        self.from = 0;
        let read = (&mut *self.bytes).take(BUFFER_BYTES as u64).read_to_end(&mut self.buffer);
        let read = read.map_err(|error| self.error(format!("cannot be read: {error}")))?;
        self.at_end = read < BUFFER_BYTES;
        Ok(read > 0)
    }

    /// The next `N` bytes.
    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], InputError> {
        loop {
            if let Some(bytes) = self.buffer[self.from..].first_chunk::<N>() {
                self.from += N;
                self.offset += N as u64;
                return Ok(*bytes);
            }
            if !self.refill()? {
                return Err(self.error("the file ends here, in the middle of its elements; it is cut off"));
            }
        }
    }

    /// The range of the next line in the buffer, without what ends it; `None` at the end of the file.
    fn next_line(&mut self, longest: usize) -> Result<Option<std::ops::Range<usize>>, InputError> {
        let mut searched = 0;
        loop {
            let unused = &self.buffer[self.from..];
            let (length, used) = match memchr::memchr(b'\n', &unused[searched..]) {
                Some(end) => (searched + end, searched + end + 1),
                None if unused.len() > longest => return Err(self.error("the line is too long for a PLY header")),
                None => {
                    searched = unused.len();
                    if self.refill()? {
                        continue;
                    }
                    if searched == 0 {
                        return Ok(None);
                    }
                    (searched, searched)
                }
            };
            let start = self.from;
            self.from += used;
            self.offset += used as u64;
            self.line += 1;
            return Ok(Some(start..start + length));
        }
    }
}

pub(super) fn read(source: Source<'_>, progress: &dyn Progress) -> Result<Indexed, InputError> {
    let Source { name, size, bytes, .. } = source;
    progress.phase("reading", size);
    let mut input =
        Input { name, bytes, buffer: Vec::new(), from: 0, at_end: false, offset: 0, line: 0, by_line: true };
    let (encoding, elements) = header(&mut input)?;
    let radix = if encoding == Encoding::Ascii { Radix::Ten } else { Radix::Two };
    input.by_line = encoding == Encoding::Ascii;
    let vertices = elements.iter().find(|element| element.kind == Kind::Vertex).map_or(0, |element| element.count);
    let mut record = Record { base: None, vertex: [Scaled::default(); 3], corners: Vec::new() };
    let mut indexed = Indexed::new(radix);
    for element in &elements {
        for index in 0..element.count {
            if index % REPORT_EVERY == 0 {
                progress.advance(input.offset);
            }
            let place = match encoding {
                Encoding::Ascii => {
                    ascii_record(&mut input, element, &mut record, index)?;
                    input.place()
                }
                _ => {
                    let place = input.place();
                    binary_record(&mut input, element, encoding, &mut record, index)?;
                    place
                }
            };
            let fail = |message: String| {
                InputError::new(name, place, format!("{} {index} (counted from 0) {message}", element.name))
            };
            indexed.has_room(record.corners.len()).map_err(fail)?;
            match element.kind {
                Kind::Vertex => indexed.vertices.push(record.vertex),
                Kind::Face => {
                    let corners = &record.corners;
                    if corners.len() < 3 {
                        return Err(fail(format!("has {} corners; at least 3 are expected", corners.len())));
                    }
                    if let Some(corner) = corners.iter().find(|corner| u64::from(**corner) >= vertices) {
                        return Err(fail(format!("names vertex {corner}, but there are {vertices}, counted from 0")));
                    }
                    if indexed.runs.last().is_none_or(|run| run.base != record.base) {
                        indexed.runs.push(Run { first: indexed.triangles.len(), base: record.base, place });
                    }
                    indexed.triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
                }
                Kind::Other => {}
            }
        }
    }
    // Bytes behind the last element are nobody's; exporters leave newlines there.
    progress.advance(input.offset);
    Ok(indexed)
}

fn header(input: &mut Input<'_>) -> Result<(Encoding, Vec<Element>), InputError> {
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let Some(range) = input.next_line(LONGEST_HEADER_LINE)? else {
            return Err(input.error("the file ends within the header; a line `end_header` is expected"));
        };
        let line = &input.buffer[range];
        if input.line == 1 {
            if line.trim_ascii_end() != b"ply" {
                return Err(input.error(format!("{} is not `ply`, the first line of every PLY file", quoted(line))));
            }
            continue;
        }
        match header_line(line, &mut encoding, &mut elements) {
            Err(message) => return Err(input.error(message)),
            Ok(false) => {}
            Ok(true) => break,
        }
    }
    let Some(encoding) = encoding else {
        return Err(
            input.error("the header has no line `format ascii 1.0` (or binary_little_endian, binary_big_endian)")
        );
    };
    for (kind, name, roles) in [
        (Kind::Vertex, "vertex", &[Role::Axis(0), Role::Axis(1), Role::Axis(2)][..]),
        (Kind::Face, "face", &[Role::Corners][..]),
    ] {
        let mut found = elements.iter().filter(|element| element.kind == kind);
        let (Some(element), None) = (found.next(), found.next()) else {
            return Err(input.error(format!("the header has to have one `element {name}`")));
        };
        for role in roles {
            if element.properties.iter().filter(|property| property.role == *role).count() != 1 {
                let what = match role {
                    Role::Axis(axis) => format!("a number `{}`", ["x", "y", "z"][*axis]),
                    _ => "a list `vertex_indices` of integers".to_owned(),
                };
                return Err(input.error(format!("element {name} has to have one property that is {what}")));
            }
        }
    }
    if let Some(element) = elements.iter().find(|element| element.properties.is_empty()) {
        return Err(input.error(format!("element {} has no property; at least one is expected", element.name)));
    }
    Ok((encoding, elements))
}

/// Takes in one line of the header; true at its end.
fn header_line(line: &[u8], encoding: &mut Option<Encoding>, elements: &mut Vec<Element>) -> Result<bool, String> {
    let mut fields = Fields::new(line);
    match fields.next() {
        None | Some(b"comment" | b"obj_info") => return Ok(false),
        Some(b"end_header") => return Ok(true),
        Some(b"format") => {
            let word = fields.expect("an encoding")?;
            let found = match word {
                b"ascii" => Encoding::Ascii,
                b"binary_little_endian" => Encoding::Little,
                b"binary_big_endian" => Encoding::Big,
                _ => return Err(fields.wrong(word, "is not ascii, binary_little_endian or binary_big_endian")),
            };
            if encoding.replace(found).is_some() {
                return Err("a second `format` line; one is expected".into());
            }
        }
        Some(b"element") => {
            let word = fields.expect("a name")?;
            let kind = match word {
                b"vertex" => Kind::Vertex,
                b"face" => Kind::Face,
                _ => Kind::Other,
            };
            let name = String::from_utf8_lossy(word).into_owned();
            let count = fields.integer("the number of elements")?;
            let count = u64::try_from(count).map_err(|_| format!("field 3 `{count}` is negative"))?;
            elements.push(Element { kind, name, count, properties: Vec::new() });
        }
        Some(b"property") => {
            let Some(element) = elements.last_mut() else {
                return Err("a property before the first element; `element vertex N` is expected".into());
            };
            element.properties.push(property(&mut fields, element.kind)?);
        }
        Some(word) => {
            let message =
                format!("{} is no PLY header line; `element`, `property` or the like is expected", quoted(word));
            return Err(message);
        }
    }
    Ok(false)
}

fn property(fields: &mut Fields<'_>, kind: Kind) -> Result<Property, String> {
    let scalar = |fields: &mut Fields<'_>| {
        let word = fields.expect("a type")?;
        Scalar::of(word)
            .ok_or_else(|| fields.wrong(word, "is no PLY type; `float`, `int`, `uchar` or the like is expected"))
    };
    let mut ahead = Fields::new(fields.rest());
    let mut length = None;
    if ahead.next() == Some(b"list") {
        fields.next();
        let found = scalar(fields)?;
        if found.is_float() {
            return Err("the length of a list is given as a float; an integer type is expected".into());
        }
        length = Some(found);
    }
    let scalar = scalar(fields)?;
    let name = fields.expect("a name")?;
    let role = match (kind, name, length.is_some()) {
        (Kind::Vertex, b"x", false) => Role::Axis(0),
        (Kind::Vertex, b"y", false) => Role::Axis(1),
        (Kind::Vertex, b"z", false) => Role::Axis(2),
        (Kind::Face, b"vertex_indices" | b"vertex_index", true) if !scalar.is_float() => Role::Corners,
        (Kind::Face, b"base", false) if !scalar.is_float() => Role::Base,
        _ => Role::Skipped,
    };
    Ok(Property { name: String::from_utf8_lossy(name).into_owned(), length, scalar, role })
}

/// What an element says that matters.
struct Record {
    vertex: [Scaled; 3],
    corners: Vec<u32>,
    base: Option<u32>,
}

impl Record {
    fn keep_integer(&mut self, role: Role, value: i64) -> Result<(), String> {
        let number = || u32::try_from(value).map_err(|_| format!("{value} is not an integer from 0 to 4294967295"));
        match role {
            Role::Corners => self.corners.push(number()?),
            Role::Base => self.base = Some(number()?),
            Role::Axis(axis) => self.vertex[axis] = Scaled::from_integer(value, Radix::Two),
            Role::Skipped => {}
        }
        Ok(())
    }
}

fn ascii_record(input: &mut Input<'_>, element: &Element, record: &mut Record, index: u64) -> Result<(), InputError> {
    record.corners.clear();
    let range = loop {
        match input.next_line(usize::MAX)? {
            None => {
                let message = format!("the file ends before {} {index} of {}", element.name, element.count);
                return Err(input.error(message));
            }
            Some(range) if input.buffer[range.clone()].trim_ascii().is_empty() => {}
            Some(range) => break range,
        }
    };
    let mut fields = Fields::new(&input.buffer[range]);
    let mut parse = || -> Result<(), String> {
        for property in &element.properties {
            let count = if property.length.is_some() { fields.integer("the length of a list")? } else { 1 };
            // A negative length is no length; a long one runs out of fields.
            if count < 0 {
                return Err(format!("property {}: a list of {count} entries is impossible", property.name));
            }
            for _ in 0..count {
                match property.role {
                    Role::Axis(axis) => record.vertex[axis] = fields.decimal("a coordinate")?,
                    Role::Skipped => {
                        fields.expect("a value")?;
                    }
                    role => {
                        let value = fields.integer("an integer")?;
                        record
                            .keep_integer(role, value)
                            .map_err(|message| format!("property {}: {message}", property.name))?;
                    }
                }
            }
        }
        match fields.next() {
            None => Ok(()),
            Some(word) => Err(fields.wrong(word, "is one too many; the line should end here")),
        }
    };
    parse().map_err(|message| input.error(message))
}

fn binary_record(
    input: &mut Input<'_>,
    element: &Element,
    encoding: Encoding,
    record: &mut Record,
    index: u64,
) -> Result<(), InputError> {
    record.corners.clear();
    for property in &element.properties {
        let wrong = |input: &Input<'_>, message: String| {
            let text = format!("{} {index} (counted from 0), property {}: {message}", element.name, property.name);
            input.error(text)
        };
        let count = match property.length {
            None => 1,
            Some(scalar) => match integer(input, scalar, encoding)? {
                count if count < 0 => {
                    return Err(wrong(input, format!("a list of {count} entries is impossible")));
                }
                count => count,
            },
        };
        for _ in 0..count {
            match property.scalar {
                Scalar::F32 | Scalar::F64 => {
                    let value = float(input, property.scalar, encoding)?;
                    if let Role::Axis(axis) = property.role {
                        record.vertex[axis] = Scaled::from_double(value)
                            .ok_or_else(|| wrong(input, format!("{value} is not a finite number")))?;
                    }
                }
                scalar => {
                    let value = integer(input, scalar, encoding)?;
                    record.keep_integer(property.role, value).map_err(|message| wrong(input, message))?;
                }
            }
        }
    }
    Ok(())
}

/// The next bytes as a number, in the byte order of the file.
macro_rules! number {
    ($input:ident, $encoding:ident, $type:ty) => {{
        let bytes = $input.take()?;
        if $encoding == Encoding::Big { <$type>::from_be_bytes(bytes) } else { <$type>::from_le_bytes(bytes) }
    }};
}

#[inline]
fn integer(input: &mut Input<'_>, scalar: Scalar, encoding: Encoding) -> Result<i64, InputError> {
    Ok(match scalar {
        Scalar::I8 => number!(input, encoding, i8).into(),
        Scalar::U8 => number!(input, encoding, u8).into(),
        Scalar::I16 => number!(input, encoding, i16).into(),
        Scalar::U16 => number!(input, encoding, u16).into(),
        Scalar::I32 => number!(input, encoding, i32).into(),
        Scalar::U32 => number!(input, encoding, u32).into(),
        // Callers ask for integers of integer properties only; skip the bytes nevertheless.
        Scalar::F32 | Scalar::F64 => float(input, scalar, encoding)? as i64,
    })
}

#[inline]
fn float(input: &mut Input<'_>, scalar: Scalar, encoding: Encoding) -> Result<f64, InputError> {
    Ok(match scalar {
        Scalar::F64 => number!(input, encoding, f64),
        // Every f32 is an f64.
        _ => number!(input, encoding, f32).into(),
    })
}
