// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a grid: lines `b I x y z x y z x y z`, the integer corners of base triangle `I` in winding order.
//!
//! `#` starts a comment, and empty lines are passed over.

use super::SET;
use crate::stimulus::{quoted, read_bounded};
use relief_models::mesh::{InputError, Place};
use std::collections::HashMap;
use std::path::Path;

/// A base triangle of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridTriangle {
    /// The number by which the file calls it.
    pub number: u32,
    /// Grid coordinates (x, y, z) of the corners, in winding order.
    pub corners: [[i32; 3]; 3],
}

/// Reads the grid in the file `path`.
///
/// # Errors
/// Where in the file something is wrong, and what would be right.
pub fn read_grid(path: &Path) -> Result<Vec<GridTriangle>, InputError> {
    let bytes = read_bounded(path, "a grid file")?;
    parse_grid(&path.display().to_string(), &bytes)
}

/// Reads a grid from the bytes of a file that errors call `name`.
///
/// # Errors
/// As [`read_grid`].
pub fn parse_grid(name: &str, bytes: &[u8]) -> Result<Vec<GridTriangle>, InputError> {
    let mut grid = Vec::new();
    let mut lines: HashMap<u32, u64> = HashMap::new();
    for (line, number) in bytes.split(|&byte| byte == b'\n').zip(1..) {
        let at = |message: String| InputError { file: name.into(), place: Place::Line(number), message };
        let Some(triangle) = parse_line(line).map_err(at)? else { continue };
        if let Some(before) = lines.insert(triangle.number, number) {
            let base = triangle.number;
            return Err(at(format!(
                "base triangle {base} is that of line {before} already; a number of its own is expected"
            )));
        }
        grid.push(triangle);
    }
    if grid.is_empty() {
        let message = "holds no base triangle; lines `b I x y z x y z x y z` are expected".into();
        return Err(InputError { file: name.into(), place: Place::File, message });
    }
    Ok(grid)
}

/// The base triangle of a line; none where the line is empty or a comment.
fn parse_line(line: &[u8]) -> Result<Option<GridTriangle>, String> {
    // A comment runs from a word that begins with `#` to the end of the line.
    let mut words = line
        .split(|byte| byte.is_ascii_whitespace() || *byte == 0x0b)
        .filter(|word| !word.is_empty())
        .take_while(|word| word[0] != b'#')
        .zip(1..);
    match words.next() {
        None => return Ok(None),
        Some((b"b", _)) => {}
        Some((word, _)) => return Err(format!("a line cannot begin with {}; `b` or `#` is expected", quoted(word))),
    }
    let mut integer = |field: usize, what: &str, low: i64, high: i64| {
        let expected = format!("{what} from {low} to {high}");
        let (word, _) = words.next().ok_or_else(|| format!("field {field} is missing; {expected} is expected"))?;
        let value = std::str::from_utf8(word).ok().and_then(|text| text.parse::<i64>().ok());
        value
            .filter(|value| (low..=high).contains(value))
            .ok_or_else(|| format!("field {field} {} is not {expected}", quoted(word)))
    };
    let number = integer(2, "the number of a base triangle", 0, u32::MAX.into())? as u32;
    let (low, high) = SET.coordinates();
    let mut corners = [[0; 3]; 3];
    for (coordinate, field) in corners.as_flattened_mut().iter_mut().zip(3..) {
        *coordinate = integer(field, "an integer grid coordinate", low.into(), high.into())? as i32;
    }
    match words.next() {
        None => Ok(Some(GridTriangle { number, corners })),
        Some((word, field)) => {
            Err(format!("field {field} {} is one too many; the line should end after nine coordinates", quoted(word)))
        }
    }
}
