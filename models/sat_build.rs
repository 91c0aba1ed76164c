// SPDX-License-Identifier: MIT OR Apache-2.0
//! Builds the summed-area table of a map (Crow 1984).
//!
//! `SAT[y][x] = sum of map[0 .. y][0 .. x] mod 2^B`, x = 0 ..= W, y = 0 ..= H; row 0 and column 0 are zero
//!
//! | field | format | range |
//! |-------|--------|-------|
//! | texel | UQ16.0 | whole |
//! | sum   | B bits, 16 ..= 63 | wraps |
//!
//! Example: the map (1, 2; 3, 4) has the table (1, 3; 4, 10), without its zeros.
//!
//! Error: 0 modulo 2^B. A rectangle's sum is a difference of four, so it is right whenever the true sum is below 2^B,
//! however often the table has wrapped.

/// A summed-area table, with its row and its column of zeros.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Texels in a row of the map.
    pub width: usize,
    /// Rows of the map.
    pub height: usize,
    /// Bits of a sum, B.
    pub bits: u32,
    sums: Vec<u64>,
}

impl Table {
    /// `SAT[y][x]`.
    pub fn at(&self, x: usize, y: usize) -> u64 {
        self.sums[y * (self.width + 1) + x]
    }
}

/// The table of a map, sums modulo 2^`bits`.
///
/// # Panics
/// When there are not `width * height` samples.
pub fn golden(width: usize, height: usize, samples: &[u16], bits: u32) -> Table {
    assert_eq!(samples.len(), width * height, "samples of a map of {width} x {height}");
    let mask = (1 << bits) - 1;
    let mut sums = vec![0; (width + 1) * (height + 1)];
    for y in 1..=height {
        let mut row = 0u64;
        for x in 1..=width {
            row = row.wrapping_add(u64::from(samples[(y - 1) * width + x - 1]));
            sums[y * (width + 1) + x] = row.wrapping_add(sums[(y - 1) * (width + 1) + x]) & mask;
        }
    }
    Table { width, height, bits, sums }
}

/// A sum that the builder sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sum {
    /// Column, 1 ..= width.
    pub x: usize,
    /// Row, 1 ..= height.
    pub y: usize,
    /// The sum.
    pub sum: u64,
    /// The last one of the map.
    pub last: bool,
}

/// Golden model of the builder.
#[derive(Clone, Debug)]
pub struct SatBuild {
    side: usize,
    bits: u32,
    size: Option<(usize, usize)>,
    texels: Vec<u16>,
    error: bool,
}

impl SatBuild {
    /// A builder for maps of up to `side` texels in a row and sums of `bits` bits.
    pub const fn new(side: usize, bits: u32) -> Self {
        Self { side, bits, size: None, texels: Vec::new(), error: false }
    }

    /// Sticky: a size of nothing or with longer rows than the line buffer, a size before the map was complete, a texel
    /// without a size.
    pub const fn error(&self) -> bool {
        self.error
    }

    /// Takes a size.
    pub fn size(&mut self, width: usize, height: usize) {
        let sound = width > 0 && height > 0 && width <= self.side;
        self.error |= self.size.is_some() || !sound;
        self.size = sound.then_some((width, height));
        self.texels.clear();
    }

    /// Takes a texel and gives its sum.
    pub fn texel(&mut self, value: u16) -> Option<Sum> {
        let Some((width, height)) = self.size else {
            self.error = true;
            return None;
        };
        self.texels.push(value);
        let (x, y) = ((self.texels.len() - 1) % width + 1, self.texels.len().div_ceil(width));
        // By the definition: all texels up to here, but those to the right of it.
        let all = self.texels.chunks(width).flat_map(|row| row.iter().take(x));
        let sum = all.fold(0u64, |sum, &texel| sum.wrapping_add(u64::from(texel))) & ((1 << self.bits) - 1);
        let last = self.texels.len() == width * height;
        if last {
            self.size = None;
        }
        Some(Sum { x, y, sum, last })
    }
}
