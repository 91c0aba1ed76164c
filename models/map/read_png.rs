// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a grey PNG. Everything that can be refused by its header is refused before anything is decoded.

use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::Path;

use image::codecs::png::PngDecoder;
use image::{ColorType, ImageDecoder, Limits};

use super::HeightMap;
use crate::mesh::{InputError, Place};

const SIGNATURE: &[u8; 8] = b"\x89PNG\r\n\x1a\n";
/// What the decoder may hold besides the picture: profiles and texts are no use here.
const DECODER_BYTES: u64 = 16 << 20;

/// A map, and a warning if it was one of 8 bits or fewer.
type Read8Or16 = (HeightMap, Option<String>);

/// Reads the map in the file `path` if it has at most `limit` samples. The string is a warning to print.
pub fn read(path: &Path, limit: u64) -> Result<Read8Or16, InputError> {
    let most = |size| within_memory(size, limit);
    open(path, |file| decode(file, limit, most).map(|(map, bits)| (map, steps(bits))))
}

/// Reads the map in the file `path` with its own values (0 to 255 where it has 8 bits) if both sides are 2 to `side`
/// samples long. The number is that of the bits of a sample.
pub fn read_values(path: &Path, side: u32) -> Result<(HeightMap, u8), InputError> {
    let most = |[width, height]: [u32; 2]| {
        let sound = (2..=side).contains(&width) && (2..=side).contains(&height);
        let message = || format!("is a map of {width} x {height} samples; 2 x 2 to {side} x {side} is expected");
        if sound { Ok(()) } else { Err(message()) }
    };
    let (mut map, bits) = open(path, |file| decode(file, u64::from(side) * u64::from(side), most))?;
    if bits < 16 {
        // Scaled to 16 bits without a rest.
        let step = 65535 / ((1u16 << bits) - 1);
        map.samples.iter_mut().for_each(|sample| *sample /= step);
    }
    Ok((map, bits))
}

fn open<T>(path: &Path, decode: impl Fn(BufReader<File>) -> Result<T, String>) -> Result<T, InputError> {
    let name = path.display().to_string();
    let fail = |error: std::io::Error| InputError::new(&name, Place::File, format!("cannot be opened: {error}"));
    let file = File::open(path).map_err(fail)?;
    if file.metadata().map_err(fail)?.is_dir() {
        return Err(InputError::new(&name, Place::File, "is a folder; a PNG file is expected"));
    }
    decode(BufReader::new(file)).map_err(|message| InputError::new(&name, Place::File, message))
}

/// Reads a map from the bytes of a PNG, which errors call `name`; what [`read`] does once the file is open.
pub fn read_from(bytes: &[u8], name: &str, limit: u64) -> Result<Read8Or16, InputError> {
    let decoded = decode(Cursor::new(bytes), limit, |size| within_memory(size, limit));
    decoded.map(|(map, bits)| (map, steps(bits))).map_err(|message| InputError::new(name, Place::File, message))
}

fn within_memory([width, height]: [u32; 2], limit: u64) -> Result<(), String> {
    let samples = u64::from(width) * u64::from(height);
    let what = "beyond the limit of the map memory";
    let message = || format!("is a map of {width} x {height} = {samples} samples, {what}, {limit} words");
    if samples > limit { Err(message()) } else { Ok(()) }
}

/// The warning of a map of few bits.
fn steps(bits: u8) -> Option<String> {
    (bits < 16).then(|| {
        let (values, step) = (1u32 << bits, 65535 / ((1u32 << bits) - 1));
        format!("has {bits} bits a sample, so {values} heights with steps of {step} in 65535; 16-bit grey is smooth")
    })
}

/// The map and the bits of its samples, if `fits` agrees with its width and height; at most `limit` samples.
fn decode(
    mut source: impl BufRead + Seek,
    limit: u64,
    fits: impl Fn([u32; 2]) -> Result<(), String>,
) -> Result<(HeightMap, u8), String> {
    let bits = examine_header(&mut source, fits)?;
    source.seek(SeekFrom::Start(0)).map_err(|error| format!("cannot be read: {error}"))?;
    let wrong = |error: image::ImageError| format!("cannot be decoded: {error}; a whole PNG is expected");
    let mut limits = Limits::default();
    limits.max_alloc = Some(DECODER_BYTES + 2 * limit);
    let decoder = PngDecoder::with_limits(source, limits).map_err(wrong)?;
    let ((width, height), colour) = (decoder.dimensions(), decoder.color_type());
    if !matches!(colour, ColorType::L8 | ColorType::L16) {
        // A grey that is transparent has an alpha after decoding.
        return Err("is partly transparent; a grey PNG without transparency is expected".into());
    }
    // The header kept this within the limit.
    let mut bytes = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut bytes).map_err(wrong)?;
    let samples = match colour {
        ColorType::L16 => bytes.as_chunks().0.iter().map(|pair| u16::from_ne_bytes(*pair)).collect(),
        _ => bytes.iter().map(|byte| u16::from(*byte) * 257).collect(),
    };
    Ok((HeightMap { width: width as usize, height: height as usize, samples }, bits))
}

/// Refuses what is no grey PNG of a fitting size; the bits of a sample.
fn examine_header(source: &mut impl Read, fits: impl Fn([u32; 2]) -> Result<(), String>) -> Result<u8, String> {
    let mut head = Vec::with_capacity(29);
    source.take(29).read_to_end(&mut head).map_err(|error| format!("cannot be read: {error}"))?;
    if !head.starts_with(&SIGNATURE[..SIGNATURE.len().min(head.len())]) || head.is_empty() {
        return Err("is no PNG (its first bytes say so); a 16-bit grey PNG is expected".into());
    }
    let Some(header) = head.get(8..26).filter(|header| &header[..8] == b"\0\0\0\x0DIHDR") else {
        return Err("ends or breaks in its header; a whole 16-bit grey PNG is expected".into());
    };
    let number = |at: usize| u32::from_be_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]]);
    let (width, height, bits, kind) = (number(8), number(12), header[16], header[17]);
    if width == 0 || height == 0 {
        return Err(format!("is a map of {width} x {height} samples; at least 1 x 1 is expected"));
    }
    let what = match kind {
        0 => None,
        4 => Some("is grey with an alpha channel"),
        2 | 3 | 6 => Some("is a colour picture"),
        _ => Some("has a colour type that PNG does not know"),
    };
    if let Some(what) = what {
        return Err(format!("{what}; a height map is 16-bit grey without alpha"));
    }
    fits([width, height])?;
    Ok(bits)
}
