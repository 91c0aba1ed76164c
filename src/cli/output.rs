// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where a subcommand writes: stdout, or a file that appears whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Bytes gathered before they are written.
const BUFFER: usize = 1 << 18;

/// Buffered output. A file is written beside its place, and gets its name in [`Output::commit`]; without that nothing of
/// it stays.
pub struct Output {
    writer: BufWriter<Box<dyn Write>>,
    /// The file beside its place, and its place.
    pending: Option<(PathBuf, PathBuf)>,
}

impl Output {
    /// Output to `path`, or to stdout.
    pub fn open(path: Option<&Path>) -> Result<Output, String> {
        let Some(path) = path else { return Ok(Output::new(Box::new(io::stdout()), None)) };
        let fail = |error: io::Error| format!("{}: cannot be written: {error}", path.display());
        // What a link leads to is replaced, and not the link. What is no file (a pipe, a terminal, /dev/null) cannot be
        // replaced at all.
        let place = match fs::canonicalize(path) {
            Ok(place) if place.is_dir() => return Err(format!("{}: is a folder; a file is expected", path.display())),
            Ok(place) if !place.is_file() => {
                return Ok(Output::new(Box::new(File::options().write(true).open(&place).map_err(fail)?), None));
            }
            Ok(place) => place,
            Err(_) => path.to_path_buf(),
        };
        let Some(name) = place.file_name() else {
            return Err(format!("{}: is not the name of a file", path.display()));
        };
        let mut beside = std::ffi::OsString::from(".");
        beside.push(name);
        beside.push(format!(".{}", std::process::id()));
        let beside = place.with_file_name(beside);
        let file = File::create(&beside).map_err(fail)?;
        Ok(Output::new(Box::new(file), Some((beside, place))))
    }

    fn new(target: Box<dyn Write>, pending: Option<(PathBuf, PathBuf)>) -> Output {
        Output { writer: BufWriter::with_capacity(BUFFER, target), pending }
    }

    /// Writes what is left and gives the file its name.
    pub fn commit(mut self) -> io::Result<()> {
        self.writer.flush()?;
        if let Some((beside, place)) = self.pending.as_ref() {
            fs::rename(beside, place)?;
            self.pending = None;
        }
        Ok(())
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        if let Some((beside, _)) = &self.pending {
            let _ = fs::remove_file(beside);
        }
    }
}
