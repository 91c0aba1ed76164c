// SPDX-License-Identifier: MIT OR Apache-2.0
//! The series of a drawing, their marks, the front and the legend.

use std::f64::consts::TAU;

use plotters::backend::DrawingBackend;
use plotters::element::{Circle, Polygon};
use plotters::style::text_anchor::HPos;
use plotters::style::{BLACK, Color, RGBColor, ShapeStyle};
use relief_testbench::method::METHODS;

use super::super::{Chapter, Figure, Kind, Point, peers};
use super::{Canvas, GREY, LEGEND, PLOT, SMALL};
use crate::chart::picture::Drawn;

const FRONT: RGBColor = RGBColor(150, 150, 150);
/// Told apart by all kinds of eyes (Okabe and Ito 2008), but for its yellow, too pale on white. Their number and that of
/// the shapes have no common divisor, so forty-two methods look different.
pub const COLOURS: [RGBColor; 7] = [
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
/// Colour and shape of a method: the same in every chart.
pub fn look(name: &str, kind: Kind) -> (RGBColor, (u32, f64)) {
    let ours = METHODS.iter().position(|method| method.name() == name);
    let peer = || METHODS.len() + peers::NAMES.iter().position(|peer| *peer == name).unwrap_or_default();
    let at = ours.filter(|_| kind == Kind::Ours).unwrap_or_else(peer);
    (COLOURS[at % COLOURS.len()], SHAPES[at % SHAPES.len()])
}

impl<B: DrawingBackend> Canvas<'_, B> {
    /// The edge of what can be had: steps from mesh to mesh, and a ring round each.
    pub fn front(&self, chapter: &Chapter, figure: Figure, place: &impl Fn(&Point) -> Option<[f64; 2]>) -> Drawn<B> {
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

    pub fn series(
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

    pub fn legend(&self, chapter: &Chapter, figure: Figure) -> Drawn<B> {
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
