// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drawings as files: SVG and PNG show the same.

use std::error::Error;
use std::io::Cursor;
use std::sync::OnceLock;

use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::style::{FontStyle, register_font};

/// Pixels of a drawing.
pub const SIZE: (u32, u32) = (1440, 960);
const FONT: &[u8] = include_bytes!("font/relief-sans.ttf");

/// What a drawing step gives.
pub type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// A name and what stands in the file.
pub type Named = (String, Vec<u8>);

/// What can be drawn.
pub trait Drawing {
    /// Draws on a white area of [`SIZE`].
    ///
    /// # Errors
    /// The backend fails.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B>;
}

/// The drawing as SVG.
///
/// # Errors
/// The drawing fails.
pub fn svg(drawing: &impl Drawing) -> Result<String, Box<dyn Error>> {
    load_font()?;
    let mut text = String::new();
    drawing.draw(&SVGBackend::with_string(&mut text, SIZE).into_drawing_area())?;
    Ok(text)
}

/// The drawing as PNG.
fn png(drawing: &impl Drawing) -> Result<Vec<u8>, Box<dyn Error>> {
    load_font()?;
    let mut pixels = vec![0; 3 * (SIZE.0 * SIZE.1) as usize];
    drawing.draw(&BitMapBackend::with_buffer(&mut pixels, SIZE).into_drawing_area())?;
    let mut file = Cursor::new(Vec::new());
    let mut encoder = png::Encoder::new(&mut file, SIZE.0, SIZE.1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(file.into_inner())
}

/// The drawing as files of both kinds, with their names.
///
/// # Errors
/// The drawing fails.
pub fn pictures(name: &str, drawing: &impl Drawing) -> Result<[Named; 2], Box<dyn Error>> {
    Ok([(format!("{name}.svg"), svg(drawing)?.into_bytes()), (format!("{name}.png"), png(drawing)?)])
}

/// The font comes with the program, so that no machine draws another picture.
fn load_font() -> Result<(), String> {
    static LOADED: OnceLock<bool> = OnceLock::new();
    let load = || register_font("sans-serif", FontStyle::Normal, FONT).is_ok();
    if *LOADED.get_or_init(load) { Ok(()) } else { Err("the font of the drawings cannot be read".into()) }
}
