// SPDX-License-Identifier: MIT OR Apache-2.0
//! PNG files of the folder: grey of 1, 4 or 16 bits, and 16 bits times three.

use std::fs::File;
use std::io::{self, BufReader, BufWriter};
use std::path::Path;

use png::{BitDepth, ColorType, Compression, Decoder, Encoder, Limits, Transformations};

/// How samples lie in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Grey of 1, 4 or 16 bits.
    Grey(u8),
    /// Three times 16 bits.
    Colour,
}

impl Kind {
    fn bits(self) -> usize {
        match self {
            Kind::Grey(bits) => usize::from(bits),
            Kind::Colour => 48,
        }
    }
    fn depth(self) -> BitDepth {
        match self {
            Kind::Grey(1) => BitDepth::One,
            Kind::Grey(4) => BitDepth::Four,
            _ => BitDepth::Sixteen,
        }
    }
    fn colour(self) -> ColorType {
        if self == Kind::Colour { ColorType::Rgb } else { ColorType::Grayscale }
    }
    fn name(self) -> String {
        match self {
            Kind::Grey(bits) => format!("{bits}-bit grey"),
            Kind::Colour => "three times 16 bits".into(),
        }
    }
    /// Words of a sample in memory.
    fn words(self) -> usize {
        if self == Kind::Colour { 3 } else { 1 }
    }
}

/// Writes a picture row by row; `sample(n)` is word n, three a sample in colour.
pub(super) fn write(path: &Path, kind: Kind, size: [usize; 2], sample: impl Fn(usize) -> u16) -> io::Result<()> {
    let mut encoder = Encoder::new(BufWriter::new(File::create(path)?), size[0] as u32, size[1] as u32);
    encoder.set_color(kind.colour());
    encoder.set_depth(kind.depth());
    encoder.set_compression(Compression::Fast);
    let mut writer = encoder.write_header()?;
    let mut stream = writer.stream_writer()?;
    let mut row = vec![0u8; (size[0] * kind.bits()).div_ceil(8)];
    let words = size[0] * kind.words();
    for y in 0..size[1] {
        row.fill(0);
        for x in 0..words {
            let value = sample(y * words + x);
            match kind {
                Kind::Grey(bits @ (1 | 4)) => {
                    let at = x * usize::from(bits);
                    row[at / 8] |= (value as u8) << (8 - usize::from(bits) - at % 8);
                }
                _ => row[2 * x..2 * x + 2].copy_from_slice(&value.to_be_bytes()),
            }
        }
        io::Write::write_all(&mut stream, &row)?;
    }
    stream.finish()?;
    Ok(writer.finish()?)
}

/// Reads a picture that has to be of this kind and size. The error is a sentence about the file.
pub(super) fn read(path: &Path, kind: Kind, size: [usize; 2]) -> Result<Vec<u16>, String> {
    let file = File::open(path).map_err(|error| format!("cannot be opened: {error}"))?;
    let wrong = |error: png::DecodingError| format!("cannot be decoded: {error}; a whole PNG is expected");
    let row_bytes = (size[0] * kind.bits()).div_ceil(8);
    let limits = Limits { bytes: (16 << 20) + row_bytes * size[1] };
    let mut decoder = Decoder::new_with_limits(BufReader::new(file), limits);
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(wrong)?;
    let info = reader.info();
    let found = [info.width as usize, info.height as usize];
    if found != size || info.bit_depth != kind.depth() || info.color_type != kind.colour() || info.interlaced {
        return Err(format!(
            "is a picture of {} x {} samples, {:?} of {} bits; {} x {} of {}, not interlaced, is expected from bake.json",
            found[0],
            found[1],
            info.color_type,
            info.bit_depth as u8,
            size[0],
            size[1],
            kind.name()
        ));
    }
    let mut samples = Vec::with_capacity(size[0] * size[1] * kind.words());
    while let Some(row) = reader.next_row().map_err(wrong)? {
        let row = row.data();
        match kind {
            Kind::Grey(bits @ (1 | 4)) => samples.extend((0..size[0]).map(|x| {
                let at = x * usize::from(bits);
                u16::from(row[at / 8] >> (8 - usize::from(bits) - at % 8)) & ((1 << bits) - 1)
            })),
            _ => samples.extend(row.as_chunks().0.iter().map(|pair| u16::from_be_bytes(*pair))),
        }
    }
    if samples.len() != size[0] * size[1] * kind.words() {
        return Err("ends too soon; a whole PNG is expected".into());
    }
    Ok(samples)
}
