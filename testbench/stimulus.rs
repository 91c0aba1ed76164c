// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads input files: the beats of a stimulus, one a line, integers with blanks between them, `#` before a comment.

use crate::binding::{Beat, Binding};
use relief_hdl::widths::WidthSet;
use relief_models::mesh::{InputError, Place};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Larger files are refused: a device that never ends would fill the memory.
const LIMIT: u64 = 1 << 30;

/// The bytes of an input file.
///
/// # Errors
/// It is a folder, or cannot be read, or is larger than a gigabyte.
pub fn read_bounded(path: &Path, what: &str) -> Result<Vec<u8>, InputError> {
    let fail = |message| InputError { file: path.display().to_string(), place: Place::File, message };
    if path.is_dir() {
        return Err(fail(format!("is a folder; {what} is expected")));
    }
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LIMIT + 1).read_to_end(&mut bytes));
    read.map_err(|error| fail(format!("cannot be opened: {error}")))?;
    match bytes.len() as u64 > LIMIT {
        true => Err(fail(format!("is larger than {LIMIT} bytes; {what} is expected"))),
        false => Ok(bytes),
    }
}

/// The beats of the stimulus in `bytes`, the content of a file that errors call `name`.
///
/// # Errors
/// Which line is no beat of `block`, and what would be one.
pub fn parse_stimulus(block: &dyn Binding, set: &WidthSet, name: &str, bytes: &[u8]) -> Result<Vec<Beat>, InputError> {
    let mut beats = Vec::new();
    for (line, number) in bytes.split(|&byte| byte == b'\n').zip(1..) {
        let fail = |what: String| {
            let format = block.stimulus_format();
            let message = format!("{what}; a beat of {} at width set {} is {format}", block.name(), set.name);
            InputError { file: name.into(), place: Place::Line(number), message }
        };
        let code = line.split(|&byte| byte == b'#').next().unwrap_or_default();
        let words = code.split(|byte| byte.is_ascii_whitespace()).filter(|word| !word.is_empty());
        let numbers = words.map(|word| {
            let value = std::str::from_utf8(word).ok().and_then(|text| text.parse::<i64>().ok());
            value.ok_or_else(|| fail(format!("{} is no integer of 64 bits", quoted(word))))
        });
        let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
        if !numbers.is_empty() {
            beats.push(block.parse(set, &numbers).map_err(fail)?);
        }
    }
    Ok(beats)
}

/// A word of a file in backquotes: shortened, and without control characters.
pub(crate) fn quoted(word: &[u8]) -> String {
    let shown = String::from_utf8_lossy(&word[..word.len().min(40)]).escape_debug().to_string();
    if word.len() > 40 { format!("`{shown}...`") } else { format!("`{shown}`") }
}
