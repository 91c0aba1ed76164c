// SPDX-License-Identifier: MIT OR Apache-2.0
//! One drawing: errors over costs, a series a method, with the front. SVG and PNG show the same.

use std::error::Error;
use std::f64::consts::TAU;
use std::io::Cursor;
use std::sync::OnceLock;

use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, PathElement, Polygon, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, FontStyle, FontTransform, IntoFont, RGBColor, ShapeStyle, WHITE, register_font};
use relief_testbench::method::METHODS;

use super::axis::{Axis, Unit};
use super::{Chapter, Figure, Kind, Point, peers};

/// Pixels of a drawing.
const SIZE: (u32, u32) = (1440, 960);
/// Sides of the plot: left, right, top, bottom.
const PLOT: [i32; 4] = [150, 1060, 90, 820];
/// Where the legend begins.
const LEGEND: i32 = 1100;
const SMALL: f64 = 25.0;
const LARGE: f64 = 34.0;
const GREY: RGBColor = RGBColor(90, 90, 90);
const PALE: RGBColor = RGBColor(224, 224, 224);
const FRONT: RGBColor = RGBColor(150, 150, 150);
/// Told apart by all kinds of eyes (Okabe and Ito 2008), but for its yellow, too pale on white. Their number and that of
/// the shapes have no common divisor, so forty-two methods look different.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(0, 0, 0),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];
/// Corners of the marks, 0 for a circle, and how far they are turned.
const SHAPES: [(u32, f64); 6] = [(0, 0.0), (4, 0.125), (3, 0.0), (4, 0.0), (3, 0.5), (5, 0.0)];
const FONT: &[u8] = include_bytes!("font/relief-sans.ttf");

type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// The drawing as SVG.
///
/// # Errors
/// The drawing fails.
pub fn svg(chapter: &Chapter, figure: Figure) -> Result<String, Box<dyn Error>> {
    load_font()?;
    let mut text = String::new();
    draw(&SVGBackend::with_string(&mut text, SIZE).into_drawing_area(), chapter, figure)?;
    Ok(text)
}

/// The drawing as PNG.
///
/// # Errors
/// The drawing fails.
pub fn png(chapter: &Chapter, figure: Figure) -> Result<Vec<u8>, Box<dyn Error>> {
    load_font()?;
    let mut pixels = vec![0; 3 * (SIZE.0 * SIZE.1) as usize];
    draw(&BitMapBackend::with_buffer(&mut pixels, SIZE).into_drawing_area(), chapter, figure)?;
    let mut file = Cursor::new(Vec::new());
    let mut encoder = png::Encoder::new(&mut file, SIZE.0, SIZE.1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(file.into_inner())
}

/// The font comes with the program, so that no machine draws another picture.
fn load_font() -> Result<(), String> {
    static LOADED: OnceLock<bool> = OnceLock::new();
    let load = || register_font("sans-serif", FontStyle::Normal, FONT).is_ok();
    if *LOADED.get_or_init(load) { Ok(()) } else { Err("the font of the drawings cannot be read".into()) }
}

/// Colour and shape of a method: the same in every chart.
fn look(name: &str, kind: Kind) -> (RGBColor, (u32, f64)) {
    let ours = METHODS.iter().position(|method| method.name() == name);
    let peer = || METHODS.len() + peers::NAMES.iter().position(|peer| *peer == name).unwrap_or_default();
    let at = ours.filter(|_| kind == Kind::Ours).unwrap_or_else(peer);
    (COLOURS[at % COLOURS.len()], SHAPES[at % SHAPES.len()])
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

    /// The edge of what can be had: steps from mesh to mesh, and a ring round each.
    fn front(&self, chapter: &Chapter, figure: Figure, place: &impl Fn(&Point) -> Option<[f64; 2]>) -> Drawn<B> {
        let at = Figure::ALL.iter().position(|known| *known == figure).unwrap_or_default();
        let mut best: Vec<_> = chapter.points.iter().filter(|point| point.fronts[at]).filter_map(place).collect();
        best.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let pixels: Vec<_> = best.into_iter().map(|place| self.pixel(place)).collect();
        let mut steps = Vec::new();
        for &(x, y) in &pixels {
            let height = steps.last().map_or(PLOT[2], |&(_, y)| y);
            steps.extend([(x, height), (x, y)]);
        }
        steps.extend(steps.last().map(|&(_, y)| (PLOT[1], y)));
        self.line(steps, FRONT, 5)?;
        pixels.into_iter().try_for_each(|at| self.ring(at))
    }

    fn ring(&self, at: (i32, i32)) -> Drawn<B> {
        self.area.draw(&Circle::new(at, 24, GREY.stroke_width(3)))
    }

    fn series(
        &self,
        places: impl Iterator<Item = [f64; 2]>,
        (colour, shape): (RGBColor, (u32, f64)),
        kind: Kind,
    ) -> Drawn<B> {
        let pixels: Vec<_> = places.map(|place| self.pixel(place)).collect();
        match kind {
            Kind::Ours => self.line(pixels.clone(), colour, 4)?,
            Kind::Peer => dashes(&pixels).into_iter().try_for_each(|dash| self.line(dash.to_vec(), colour, 4))?,
        }
        pixels.into_iter().try_for_each(|at| self.mark(at, colour, shape, kind))
    }

    /// Full for ours, hollow and larger for peers: where both stand at one place, both are seen.
    fn mark(&self, at: (i32, i32), colour: RGBColor, (corners, turn): (u32, f64), kind: Kind) -> Drawn<B> {
        let (radius, width) = if kind == Kind::Ours { (10, 4) } else { (14, 4) };
        let full = ShapeStyle { color: colour.to_rgba(), filled: true, stroke_width: 0 };
        if corners == 0 {
            if kind == Kind::Ours {
                self.area.draw(&Circle::new(at, radius, full))?;
            }
            return self.area.draw(&Circle::new(at, radius, colour.stroke_width(width)));
        }
        // As large as a circle, by the eye.
        let radius = f64::from(radius) * if corners == 3 { 1.4 } else { 1.3 };
        let corner = |number: u32| {
            let angle = TAU * (f64::from(number % corners) / f64::from(corners) + turn);
            (at.0 + (radius * angle.sin()).round() as i32, at.1 - (radius * angle.cos()).round() as i32)
        };
        let around: Vec<_> = (0..=corners).map(corner).collect();
        if kind == Kind::Ours {
            self.area.draw(&Polygon::new(around[..corners as usize].to_vec(), full))?;
        }
        self.line(around, colour, width)
    }

    fn legend(&self, chapter: &Chapter, figure: Figure) -> Drawn<B> {
        let mut y = PLOT[2] + 14;
        for (name, kind) in chapter.methods() {
            let mut points = chapter.points.iter().filter(|point| point.method == name);
            if !points.any(|point| figure.place(point).is_some()) {
                continue;
            }
            let (colour, shape) = look(name, kind);
            match kind {
                Kind::Ours => self.line(vec![(LEGEND, y), (LEGEND + 60, y)], colour, 4)?,
                Kind::Peer => {
                    let dashes = dashes(&[(LEGEND, y), (LEGEND + 60, y)]);
                    dashes.into_iter().try_for_each(|dash| self.line(dash.to_vec(), colour, 4))?;
                }
            }
            self.mark((LEGEND + 30, y), colour, shape, kind)?;
            self.text(name, (LEGEND + 74, y), SMALL, (HPos::Left, &BLACK))?;
            y += 46;
        }
        y += 10;
        self.line(vec![(LEGEND, y), (LEGEND + 60, y)], FRONT, 5)?;
        self.ring((LEGEND + 30, y))?;
        self.text("Pareto front: nothing", (LEGEND + 74, y), SMALL, (HPos::Left, &BLACK))?;
        self.text("is better in both", (LEGEND + 74, y + 32), SMALL, (HPos::Left, &BLACK))?;
        let is_peer = |point: &&Point| point.kind == Kind::Peer && figure.place(point).is_some();
        if chapter.points.iter().any(|point| is_peer(&point)) {
            self.text("full: ours; hollow: peers", (LEGEND, y + 82), SMALL, (HPos::Left, &GREY))?;
        }
        Ok(())
    }
}

/// Dashes along a line.
fn dashes(points: &[(i32, i32)]) -> Vec<[(i32, i32); 2]> {
    const PERIOD: f64 = 20.0;
    const DASH: f64 = 12.0;
    let mut dashes = Vec::new();
    // Where in its period the line is.
    let mut phase = 0.0;
    for pair in points.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|(x, y)| [f64::from(x), f64::from(y)]);
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let at = |along: f64| {
            let share = (along / length).clamp(0.0, 1.0);
            let [x, y] = [0, 1].map(|axis| (from[axis] + share * (to[axis] - from[axis])).round() as i32);
            (x, y)
        };
        let mut begin = -phase;
        while begin < length {
            if begin + DASH > 0.0 && length > 0.0 {
                dashes.push([at(begin), at(begin + DASH)]);
            }
            begin += PERIOD;
        }
        phase = (phase + length) % PERIOD;
    }
    dashes
}
