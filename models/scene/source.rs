// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where in a scene file something stands, and what `serde` says about it in the words of scene files.

use std::ops::Range;

use serde_path_to_error::{Path, Segment};

use super::fields;
use crate::mesh::{InputError, Place};

/// An entry of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// `[camera]`.
    Camera,
    /// `[remesh]`, which need not be there.
    Remesh,
    /// An `[[object]]`, counted from 0.
    Object(usize),
    /// A `[[light]]`, counted from 0.
    Light(usize),
}

/// The lines of a scene file's entries, for messages.
#[derive(Clone, Debug, Default)]
pub struct Source {
    name: String,
    camera: Option<u64>,
    remesh: Option<u64>,
    objects: Vec<u64>,
    lights: Vec<u64>,
}

impl Source {
    pub(super) fn new(name: &str, text: &str, scene: &fields::Scene) -> Source {
        let line = |span: Range<usize>| line(text, span.start);
        Source {
            name: name.to_owned(),
            camera: Some(line(scene.camera.span())),
            remesh: scene.remesh.as_ref().map(|remesh| line(remesh.span())),
            objects: scene.object.iter().map(|object| line(object.span())).collect(),
            lights: scene.light.iter().map(|light| line(light.span())).collect(),
        }
    }

    /// What is wrong, or surprising, with an entry.
    pub fn error(&self, entry: Entry, message: impl std::fmt::Display) -> InputError {
        let (line, title) = match entry {
            Entry::Camera => (self.camera, "[camera]".to_owned()),
            Entry::Remesh => (self.remesh, "[remesh]".to_owned()),
            Entry::Object(at) => (self.objects.get(at).copied(), format!("[[object]] {}:", at + 1)),
            Entry::Light(at) => (self.lights.get(at).copied(), format!("[[light]] {}:", at + 1)),
        };
        InputError::new(&self.name, line.map_or(Place::File, Place::Line), format!("{title} {message}"))
    }

    /// What is wrong, or surprising, with the scene as a whole.
    pub fn whole(&self, message: impl Into<String>) -> InputError {
        InputError::new(&self.name, Place::File, message)
    }
}

/// Line of a byte.
fn line(text: &str, byte: usize) -> u64 {
    let before = &text.as_bytes()[..byte.min(text.len())];
    before.iter().filter(|byte| **byte == b'\n').count() as u64 + 1
}

/// Reads the fields.
pub(super) fn fields_of(text: &str, name: &str) -> Result<fields::Scene, InputError> {
    let fail = |error: &toml::de::Error, message: String| {
        let place = error.span().map_or(Place::File, |span| Place::Line(line(text, span.start)));
        InputError::new(name, place, message.trim().replace('\n', "; "))
    };
    let parsed = toml::Deserializer::parse(text).map_err(|error| {
        // Which key, toml leaves to the place.
        let key = error.span().and_then(|span| text.get(span)).filter(|_| error.message() == "duplicate key");
        fail(&error, key.map_or(error.message().to_owned(), |key| format!("`{key}` is there twice; once is expected")))
    })?;
    serde_path_to_error::deserialize(parsed)
        .map_err(|error| fail(error.inner(), sentence(error.path(), error.inner().message())))
}

/// The message of `serde` with the field that it is about; as it is where it names one itself.
fn sentence(path: &Path, message: &str) -> String {
    // Names alone, but for what tells the entries of a list apart.
    let mut names = path.iter().filter_map(|segment| match segment {
        Segment::Map { key } if !key.starts_with('$') => Some(key.as_str()),
        _ => None,
    });
    let (first, rest) = (names.next().unwrap_or_default(), names.collect::<Vec<_>>().join("."));
    let is_list = matches!(first, "object" | "light");
    let index = match path.iter().nth(1) {
        Some(Segment::Seq { index }) => Some(index + 1),
        _ => None,
    };
    let field = if rest.is_empty() { "it".to_owned() } else { format!("`{rest}`") };
    let place = match (is_list, index) {
        (true, Some(index)) => format!("[[{first}]] {index}: "),
        _ if first.is_empty() => String::new(),
        _ => format!("[{first}] "),
    };
    let problem = |what: &str| message.strip_prefix(what).and_then(|rest| rest.split_once(", expected "));
    if let Some((got, expected)) = problem("invalid type: ") {
        if rest.is_empty() && is_list && index.is_none() {
            return format!("`{first}` is {}; [[{first}]], in double brackets, is expected", described(got));
        }
        let in_list = path.iter().any(|segment| matches!(segment, Segment::Seq { .. }));
        if rest.is_empty() && !is_list {
            let got = if in_list { "a list".to_owned() } else { described(got) };
            return format!("`{first}` is {got}; [{first}], in single brackets, is expected");
        }
        return format!("{place}{field} is {}; {} is expected", described(got), wanted(expected));
    }
    if let Some((count, expected)) = problem("invalid length ") {
        let expected = expected.strip_prefix("an array of length ").unwrap_or(expected);
        let values = if count == "1" { "value" } else { "values" };
        return format!("{place}{field} has {count} {values}; {expected} are expected");
    }
    message.to_owned()
}

fn described(got: &str) -> String {
    match got {
        "map" => "a table".to_owned(),
        "sequence" => "an array".to_owned(),
        _ => format!("the {}", got.strip_suffix(" as i128").or(got.strip_suffix(" as u128")).unwrap_or(got)),
    }
}

fn wanted(expected: &str) -> String {
    let wanted = match expected {
        "f64" => "a number",
        "i64" => "an integer",
        _ if expected.starts_with("struct ") => "a table",
        _ => expected,
    };
    match wanted.strip_prefix("an array of length ") {
        Some(length) => format!("an array of {length} values"),
        None => wanted.to_owned(),
    }
}
