// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sum of a rectangle of a map from four sums of its summed-area table (Crow 1984).
//!
//! ```text
//! sum(x, y, a, b) = SAT[y+b][x+a] - SAT[y][x+a] - SAT[y+b][x] + SAT[y][x]  mod 2^B
//! clamp: the rectangle is cut at the border        slide: it keeps its size, at most the map's, and is moved inside
//! ```
//!
//! | field | format | range |
//! |-------|--------|-------|
//! | x, y  | signed M + 2 | corner, whole |
//! | a, b  | unsigned M | size, whole |
//! | sum   | B bits | exact whenever area * 65535 < 2^B, otherwise an error |
//! | area  | unsigned 2 M | texels really summed |
//!
//! Example: in the map (1, 2; 3, 4) the rectangle at (1, 0), 2 x 2, is clamped to the column 2, 4: sum 6, area 2; slid,
//! it is the whole map: sum 10, area 4.
//!
//! Error: 0 where it is exact.
//!
//! [`SatFetch`] is the unit with its memory: `SAT[y][x]` stands at word `(y - 1) * width + x - 1`, and row 0 and column 0
//! nowhere.

use crate::sat_build::Table;

/// What becomes of a rectangle that sticks out of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Border {
    /// It is cut, and its area shrinks.
    Clamp,
    /// It keeps its size and is moved inside.
    Slide,
}

/// A sum, the texels in it, and whether it may have wrapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Summed {
    /// Modulo 2^B.
    pub sum: u64,
    /// Texels.
    pub area: u64,
    /// area * 65535 >= 2^B: the sum is not sure to be exact.
    pub error: bool,
}

/// First and last-but-one texel of a rectangle along an axis of `side` texels.
pub fn span(corner: i64, size: u64, side: u64, border: Border) -> (u64, u64) {
    let clamp = |at: i64, most: u64| at.clamp(0, most as i64) as u64;
    match border {
        Border::Clamp => (clamp(corner, side), clamp(corner + size as i64, side)),
        Border::Slide => {
            let size = size.min(side);
            let first = clamp(corner, side - size);
            (first, first + size)
        }
    }
}

/// The sum over a rectangle of `a` x `b` texels whose corner is (`x`, `y`).
pub fn fetch(table: &Table, border: Border, (x, y): (i64, i64), (a, b): (u64, u64)) -> Summed {
    let (x0, x1) = span(x, a, table.width as u64, border);
    let (y0, y1) = span(y, b, table.height as u64, border);
    summed(table.bits, (x0, x1), (y0, y1), |x, y| table.at(x as usize, y as usize))
}

/// The difference of four entries.
fn summed(bits: u32, (x0, x1): (u64, u64), (y0, y1): (u64, u64), mut at: impl FnMut(u64, u64) -> u64) -> Summed {
    let sum = at(x1, y1).wrapping_sub(at(x1, y0)).wrapping_sub(at(x0, y1)).wrapping_add(at(x0, y0));
    let area = (x1 - x0) * (y1 - y0);
    Summed { sum: sum & ((1 << bits) - 1), area, error: (u128::from(area) * 65_535) >> bits != 0 }
}

/// What the unit is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// A map begins; its table is still to be loaded.
    Size {
        /// Texels in a row.
        width: u64,
        /// Rows.
        height: u64,
        /// What becomes of rectangles that stick out.
        border: Border,
    },
    /// Stores an entry of the table.
    Load {
        /// Column, 1 ..= width.
        x: i64,
        /// Row, 1 ..= height.
        y: i64,
        /// The sum.
        sum: u64,
    },
    /// Asks for a rectangle.
    Fetch {
        /// Its corner.
        corner: (i64, i64),
        /// Its size.
        size: (u64, u64),
    },
}

/// Golden model of the unit.
#[derive(Clone, Debug)]
pub struct SatFetch {
    bits: u32,
    words: Vec<u64>,
    size: Option<(u64, u64, Border)>,
    error: bool,
}

impl SatFetch {
    /// A unit of `words` sums of `bits` bits.
    pub fn new(words: usize, bits: u32) -> Self {
        Self { bits, words: vec![0; words], size: None, error: false }
    }

    /// Sticky: a size of nothing (forgotten), a load of no entry or beyond the memory (not stored), a fetch before a size
    /// (0), of entries beyond the memory (they count 0), or of an area whose sum may have wrapped.
    pub const fn error(&self) -> bool {
        self.error
    }

    /// Takes a command, and gives what a fetch finds.
    pub fn accept(&mut self, command: &Command) -> Option<Summed> {
        match *command {
            Command::Size { width, height, border } => {
                self.size = (width > 0 && height > 0).then_some((width, height, border));
                self.error |= self.size.is_none();
                None
            }
            Command::Load { x, y, sum } => {
                let entry = self
                    .size
                    .filter(|&(width, height, _)| (1..=width as i64).contains(&x) && (1..=height as i64).contains(&y));
                let place = entry.map(|(width, ..)| ((y - 1) as u64 * width + (x - 1) as u64) as usize);
                match place.and_then(|place| self.words.get_mut(place)) {
                    Some(word) => *word = sum,
                    None => self.error = true,
                }
                None
            }
            Command::Fetch { corner: (x, y), size: (a, b) } => {
                let Some((width, height, border)) = self.size else {
                    self.error = true;
                    return Some(Summed { sum: 0, area: 0, error: true });
                };
                let mut beyond = false;
                let at = |x: u64, y: u64| {
                    if x == 0 || y == 0 {
                        return 0;
                    }
                    let word = self.words.get(((y - 1) * width + x - 1) as usize).copied();
                    beyond |= word.is_none();
                    word.unwrap_or(0)
                };
                let mut result = summed(self.bits, span(x, a, width, border), span(y, b, height, border), at);
                result.error |= beyond;
                self.error |= result.error;
                Some(result)
            }
        }
    }
}

/// Exact reference: the texels of the rectangle, one by one, and their number.
pub fn exact(
    (width, height): (usize, usize),
    samples: &[u16],
    border: Border,
    (x, y): (i64, i64),
    (a, b): (u64, u64),
) -> (u64, u64) {
    let axis = |corner: i64, size: u64, side: usize| -> Vec<usize> {
        let (side, size) = (side as i64, size as i64);
        let moved = match border {
            Border::Clamp => corner,
            // As far left as it must, and then as far right as it must.
            Border::Slide => corner.min(side - size).max(0),
        };
        (0..side).filter(|&at| at >= moved && at < moved + size).map(|at| at as usize).collect()
    };
    let (columns, rows) = (axis(x, a, width), axis(y, b, height));
    let texels = rows.iter().flat_map(|&y| columns.iter().map(move |&x| u64::from(samples[y * width + x])));
    (texels.sum(), (columns.len() * rows.len()) as u64)
}
