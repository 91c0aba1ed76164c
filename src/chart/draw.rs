// SPDX-License-Identifier: MIT OR Apache-2.0
//! One drawing: errors over costs, a series a method, with the front.

use plotters::backend::DrawingBackend;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{PathElement, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, FontTransform, IntoFont, RGBColor, WHITE};

use super::axis::{Axis, Unit};
use super::picture::{Drawing, Drawn};
use super::{Chapter, Figure, Point};

mod marks;

pub use marks::COLOURS;
use marks::look;

/// Sides of the plot: left, right, top, bottom.
const PLOT: [i32; 4] = [150, 1060, 90, 820];
/// Where the legend begins.
const LEGEND: i32 = 1100;
pub const SMALL: f64 = 25.0;
pub const LARGE: f64 = 34.0;
pub const GREY: RGBColor = RGBColor(90, 90, 90);
pub const PALE: RGBColor = RGBColor(224, 224, 224);

/// A drawing of a chapter.
pub struct Errors<'a>(pub &'a Chapter, pub Figure);

impl Drawing for Errors<'_> {
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        draw(area, self.0, self.1)
    }
}

/// What stands along the bottom.
fn cost(figure: Figure) -> (&'static str, Unit) {
    match figure {
        Figure::MaxTriangles | Figure::RmsTriangles => ("triangles", Unit::Count),
        Figure::MaxCycles => ("cycles of the hardware, from its own counter", Unit::Count),
        Figure::MaxReads => ("words read from the map memory", Unit::Count),
        Figure::MaxMemory => ("bits of the map memory", Unit::Count),
        Figure::MaxSeconds => ("seconds of software on this machine: preparation and golden model", Unit::Seconds),
    }
}

/// A drawing area with its two axes.
struct Canvas<'a, B: DrawingBackend> {
    area: &'a DrawingArea<B, Shift>,
    axes: [Axis; 2],
}

fn draw<B: DrawingBackend>(area: &DrawingArea<B, Shift>, chapter: &Chapter, figure: Figure) -> Drawn<B> {
    area.fill(&WHITE)?;
    let place = |point: &Point| figure.place(point).map(|[cost, error]| [cost, chapter.subject.percent(error)]);
    let places: Vec<_> = chapter.points.iter().filter_map(place).collect();
    let axes = [0, 1].map(|axis| Axis::over(places.iter().map(move |place| place[axis])));
    let canvas = Canvas { area, axes };
    let [left, right, top, bottom] = PLOT;
    canvas.text(
        &format!("{}: {}", chapter.subject.name, figure.title()),
        (left, top - 40),
        LARGE,
        (HPos::Left, &BLACK),
    )?;
    let what = if figure == Figure::RmsTriangles { "RMS error" } else { "greatest error" };
    canvas.upward(&format!("{what}, % of the map's range"), (34, (top + bottom) / 2))?;
    canvas.text(cost(figure).0, ((left + right) / 2, bottom + 72), SMALL, (HPos::Center, &BLACK))?;
    if places.is_empty() {
        let sentence = "Nothing to draw: no mesh has this cost.";
        canvas.text(sentence, ((left + right) / 2, (top + bottom) / 2), SMALL, (HPos::Center, &GREY))?;
    } else {
        canvas.grid(cost(figure).1)?;
        canvas.front(chapter, figure, &place)?;
        // Peers lie below ours, and what comes first in the legend on top.
        for (name, kind) in chapter.methods().into_iter().rev() {
            canvas.series(
                chapter.points.iter().filter(|point| point.method == name).filter_map(place),
                look(name, kind),
                kind,
            )?;
        }
    }
    canvas.legend(chapter, figure)?;
    let mut notes = Vec::new();
    if canvas.axes[1].floor.is_some() {
        notes.push("errors of 0 stand at the lower edge".to_owned());
    }
    let drawn = |point: &&Point| figure.place(point).is_some();
    let folded = chapter.points.iter().filter(drawn).filter(|point| !point.heights.is_whole()).count();
    if folded > 0 {
        notes.push(format!("meshes with folds: {folded}, on no front"));
    }
    let gaps = |point: &&Point| figure.cost(point).is_some() && point.heights.uncovered > 0;
    let gaps = chapter.points.iter().filter(gaps).count();
    if gaps > 0 {
        notes.push(format!("with gaps, left out: {gaps}"));
    }
    canvas.text(&notes.join("; "), (left, bottom + 116), SMALL, (HPos::Left, &GREY))?;
    area.present()
}

impl<B: DrawingBackend> Canvas<'_, B> {
    /// A text that becomes smaller rather than run out of the picture.
    fn text(&self, text: &str, at: (i32, i32), size: f64, (anchor, colour): (HPos, &RGBColor)) -> Drawn<B> {
        let letters = if at.0 > LEGEND { 560.0 } else { 2100.0 };
        let most = letters / size;
        let size = size * (most / text.chars().count().max(1) as f64).min(1.0);
        let style = ("sans-serif", size).into_font().color(colour).pos(Pos::new(anchor, VPos::Center));
        self.area.draw(&Text::new(text.to_owned(), at, style))
    }

    /// A text along the axis on the left.
    fn upward(&self, text: &str, at: (i32, i32)) -> Drawn<B> {
        let font = ("sans-serif", SMALL).into_font().transform(FontTransform::Rotate270);
        let style = font.color(&BLACK).pos(Pos::new(HPos::Center, VPos::Center));
        self.area.draw(&Text::new(text.to_owned(), at, style))
    }

    fn line(&self, points: Vec<(i32, i32)>, colour: RGBColor, width: u32) -> Drawn<B> {
        self.area.draw(&PathElement::new(points, colour.stroke_width(width)))
    }

    /// Where a cost and an error stand.
    fn pixel(&self, [cost, error]: [f64; 2]) -> (i32, i32) {
        let [left, right, top, bottom] = PLOT;
        let along = |from: i32, to: i32, share: f64| from + (f64::from(to - from) * share).round() as i32;
        (along(left, right, self.axes[0].at(cost)), along(bottom, top, self.axes[1].at(error)))
    }

    fn grid(&self, unit: Unit) -> Drawn<B> {
        let [left, right, top, bottom] = PLOT;
        for tick in self.axes[0].ticks(0.1) {
            let x = self.pixel([tick, self.axes[1].high]).0;
            self.line(vec![(x, top), (x, bottom)], PALE, 2)?;
            self.text(&Axis::label(tick, unit), (x, bottom + 28), SMALL, (HPos::Center, &BLACK))?;
        }
        for tick in self.axes[1].ticks(0.06) {
            let y = self.pixel([self.axes[0].high, tick]).1;
            self.line(vec![(left, y), (right, y)], PALE, 2)?;
            self.text(&Axis::label(tick, Unit::Percent), (left - 14, y), SMALL, (HPos::Right, &BLACK))?;
        }
        self.line(vec![(left, top), (left, bottom), (right, bottom)], GREY, 2)
    }
}
