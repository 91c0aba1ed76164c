// SPDX-License-Identifier: MIT OR Apache-2.0
//! A picture with its depths.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use super::edges::Ink;
use super::{Corner, cover};

/// Colours of the background, above and below.
const SKY: [[f64; 3]; 2] = [[26.0, 34.0, 52.0], [126.0, 143.0, 166.0]];

/// Colours and depths, row by row, the top row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue of each pixel.
    pub colour: Vec<[u8; 3]>,
    /// The depth of each pixel, UQ0.32; 0 where there is only background.
    pub depth: Vec<u32>,
}

impl Frame {
    /// The background: a sky that is lighter towards the bottom.
    pub fn new(width: u32, height: u32) -> Frame {
        let pixels = width as usize * height as usize;
        let mut colour = Vec::with_capacity(pixels);
        for row in 0..height {
            let part = (f64::from(row) + 0.5) / f64::from(height);
            for column in 0..width {
                // A lattice of thresholds instead of bands of one colour.
                let threshold = f64::from((column * 5 + row * 7 + (column ^ row) * 3) % 16) / 16.0;
                colour.push([0, 1, 2].map(|k| (SKY[0][k] + (SKY[1][k] - SKY[0][k]) * part + threshold) as u8));
            }
        }
        Frame { width, height, colour, depth: vec![0; pixels] }
    }

    /// Draws a triangle in one colour; the number of pixels that it covers, hidden ones included.
    pub fn triangle(&mut self, corners: [Corner; 3], colour: [u8; 3]) -> u64 {
        self.draw(corners, |_| colour)
    }

    /// Draws a triangle with its three edges, each half as wide as two neighbours make it. The lines are lighter on
    /// triangles of few pixels, where they would be all that is seen.
    pub fn triangle_with_edges(&mut self, corners: [Corner; 3], colour: [u8; 3]) -> u64 {
        let Some(ink) = Ink::of(corners) else { return 0 };
        self.draw(corners, |edges| ink.over(colour, edges))
    }

    fn draw(&mut self, corners: [Corner; 3], shade: impl Fn([i64; 3]) -> [u8; 3]) -> u64 {
        let mut covered = 0;
        cover(corners, [self.width, self.height], |fragment| {
            covered += 1;
            let index = fragment.y as usize * self.width as usize + fragment.x as usize;
            if fragment.depth > self.depth[index] {
                self.depth[index] = fragment.depth;
                self.colour[index] = shade(fragment.edges);
            }
        });
        covered
    }

    /// The picture as a PNG file.
    pub fn png(&self) -> std::io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        PngEncoder::new(&mut bytes)
            .write_image(self.colour.as_flattened(), self.width, self.height, ExtendedColorType::Rgb8)
            .map_err(std::io::Error::other)?;
        Ok(bytes)
    }
}
