// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where a subcommand writes a long text: stdout, or a file that appears whole or not at all.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use relief_testbench::output::OutputFile;

/// Bytes gathered before they are written.
const BUFFER: usize = 1 << 18;

/// Buffered output.
pub struct Output {
    writer: BufWriter<Box<dyn Write>>,
    file: Option<OutputFile>,
}

impl Output {
    /// Output to `path`, or to stdout.
    pub fn open(path: Option<&Path>) -> Result<Output, String> {
        let file = path.map(OutputFile::open).transpose()?;
        let target: Box<dyn Write> = match &file {
            Some(file) => Box::new(file.writer().map_err(|error| format!("the output cannot be opened: {error}"))?),
            None => Box::new(io::stdout()),
        };
        Ok(Output { writer: BufWriter::with_capacity(BUFFER, target), file })
    }

    /// Writes what is left and gives the file its name.
    pub fn commit(mut self) -> io::Result<()> {
        self.writer.flush()?;
        self.file.map_or(Ok(()), |file| file.commit().map_err(io::Error::other))
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
