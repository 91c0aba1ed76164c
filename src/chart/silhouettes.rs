// SPDX-License-Identifier: MIT OR Apache-2.0
//! The horizon of a map under every filter, at one step of the grid: figures, and a drawing like figure 19 of Gumhold and
//! Huettner (1999).

use std::sync::atomic::{AtomicU64, Ordering};

use plotters::backend::DrawingBackend;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{PathElement, Polygon, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, FontTransform, IntoFont, RGBColor, WHITE};
use rayon::prelude::*;
use relief_models::filters::Filter;
use relief_models::map::HeightMap;
use relief_models::mesh::Progress;
use relief_models::mip_build::Wrap;
use relief_models::silhouette::{Horizon, Profile, SilhouetteError, View, check, levels};

use super::csv::quoted;
use super::draw::{COLOURS, GREY, LARGE, PALE, SMALL};
use super::picture::{Drawing, Drawn};
use super::{Chapter, Subject};

/// The first line of the figures.
const SCHEMA: &str = "# relief filters 1";
/// Texels from vertex to vertex where nobody asks for others, as in the paper.
pub const STEPS: [u32; 3] = [5, 10, 20];
/// Sides of the plot: left, right, top, bottom.
const PLOT: [i32; 4] = [150, 1160, 90, 820];
/// Where the legend begins.
const LEGEND: i32 = 1190;
/// Inside of the map.
const GROUND: RGBColor = RGBColor(214, 210, 200);

/// All filters at a step.
#[derive(Clone, Debug)]
pub struct Silhouettes {
    /// Texels from vertex to vertex.
    pub step: u32,
    /// What each filter does to the horizon.
    pub rows: Vec<(Filter, Horizon)>,
    /// The horizons seen along v, of the filters for surfaces that are seen from above.
    profiles: Vec<(Filter, Profile)>,
    name: String,
    range: [f64; 2],
}

/// Measures all filters at each step. A map whose sides are less than two steps is refused.
///
/// # Errors
/// See [`SilhouetteError`].
pub fn measure(
    name: &str,
    map: &HeightMap,
    steps: &[u32],
    progress: &dyn Progress,
) -> Result<Vec<Silhouettes>, SilhouetteError> {
    let done = AtomicU64::new(0);
    progress.phase("filtering", Filter::ALL.len() as u64);
    let wrap = [Wrap::Clamp; 2];
    let most = levels(map, wrap, steps.iter().copied().max().unwrap_or(1));
    let of_filter = |filter: &Filter| {
        let pyramid = filter.pyramid(map, wrap, most)?;
        let of_step = |step: &u32| {
            let view = View::new(map, *filter, &pyramid, *step)?;
            Ok((*filter, view.horizon(), view.profile(0, *step as usize / 2)))
        };
        let found = steps.iter().map(of_step).collect::<Result<Vec<_>, SilhouetteError>>();
        progress.advance(done.fetch_add(1, Ordering::Relaxed) + 1);
        found
    };
    let by_filter = Filter::ALL.par_iter().map(of_filter).collect::<Result<Vec<_>, SilhouetteError>>()?;
    let all = steps.iter().enumerate().map(|(at, step)| {
        let found = by_filter.iter().map(|of_steps| &of_steps[at]);
        let upper = found.clone().filter(|(filter, ..)| !filter.is_lower());
        Silhouettes {
            step: *step,
            rows: found.map(|(filter, horizon, _)| (*filter, *horizon)).collect(),
            profiles: upper.map(|(filter, _, profile)| (*filter, profile.clone())).collect(),
            name: name.to_owned(),
            range: map.range().map(f64::from),
        }
    });
    Ok(all.collect())
}

/// All filters at those of [`STEPS`] that the map has room for.
///
/// # Errors
/// See [`SilhouetteError`].
pub fn of(subject: &Subject, progress: &dyn Progress) -> Result<Vec<Silhouettes>, SilhouetteError> {
    let steps: Vec<u32> = STEPS.into_iter().filter(|step| check(&subject.map, *step).is_ok()).collect();
    measure(&subject.name, &subject.map, &steps, progress)
}

/// The figures of all maps, as comma-separated values.
pub fn csv(chapters: &[Chapter]) -> String {
    let mut text =
        format!("{SCHEMA}\nscene,step,filter,level,rms_percent,mean_percent,peak_loss_percent,deepest_percent\n");
    for chapter in chapters {
        for silhouettes in &chapter.silhouettes {
            for (filter, horizon) in &silhouettes.rows {
                let Horizon { level, rms, mean, peak_loss, deepest } = horizon;
                let (name, step, filter) = (quoted(&chapter.subject.name), silhouettes.step, filter.name());
                text += &format!("{name},{step},{filter},{level},{rms},{mean},{peak_loss},{deepest}\n");
            }
        }
    }
    text
}

/// Whether a file is such a drawing, of this run or an earlier one.
pub fn is_drawing(name: &str) -> bool {
    let step = name.rsplit_once("silhouette-").and_then(|(_, rest)| rest.split_once('.'));
    step.is_some_and(|(step, end)| step.parse::<u32>().is_ok() && ["svg", "png"].contains(&end))
}

impl Silhouettes {
    /// What a file of the drawing is called, without its end and what stands before it.
    pub fn file(&self) -> String {
        format!("silhouette-{}", self.step)
    }

    /// Over the drawing.
    pub fn title(&self) -> String {
        format!("{}: horizon of a grid of {} texels", self.name, self.step)
    }
}

impl Drawing for Silhouettes {
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        area.fill(&WHITE)?;
        let [left, right, top, bottom] = PLOT;
        let text = |text: &str, at: (i32, i32), size: f64, anchor: HPos, colour: &RGBColor| {
            let style = ("sans-serif", size).into_font().color(colour).pos(Pos::new(anchor, VPos::Center));
            area.draw(&Text::new(text.to_owned(), at, style))
        };
        text(&self.title(), (left, top - 40), LARGE, HPos::Left, &BLACK)?;
        let Some((_, ground)) = self.profiles.first() else { return area.present() };
        // The highest of all lines is within the range, as no filter leaves it.
        let lowest = self.profiles.iter().flat_map(|(_, profile)| profile.mesh.iter().chain(&profile.map));
        let lowest = lowest.copied().fold(f64::INFINITY, f64::min);
        let percent = |height: f64| 100.0 * (height - self.range[0]) / (self.range[1] - self.range[0]).max(1.0);
        let floor = (percent(lowest) / 10.0 - 0.5).floor().max(0.0) * 10.0;
        let pixel = |column: usize, height: f64| {
            let across = column as f64 / (ground.map.len() - 1).max(1) as f64;
            let up = (percent(height) - floor) / (100.0 - floor);
            let along = |from: i32, to: i32, share: f64| from + (f64::from(to - from) * share).round() as i32;
            (along(left, right, across), along(bottom, top, up))
        };
        let line =
            |heights: &[f64]| heights.iter().enumerate().map(|(at, height)| pixel(at, *height)).collect::<Vec<_>>();
        let tens = (0..=10).map(|ten| 10.0 * f64::from(ten)).filter(|ten| *ten >= floor);
        for ten in tens {
            let y = bottom + (f64::from(top - bottom) * (ten - floor) / (100.0 - floor)).round() as i32;
            area.draw(&PathElement::new(vec![(left, y), (right, y)], PALE.stroke_width(2)))?;
            text(&format!("{ten} %"), (left - 14, y), SMALL, HPos::Right, &BLACK)?;
        }
        let mut outline = line(&ground.map);
        outline.extend([(right, bottom), (left, bottom)]);
        area.draw(&Polygon::new(outline, GROUND.filled()))?;
        area.draw(&PathElement::new(vec![(left, top), (left, bottom), (right, bottom)], GREY.stroke_width(2)))?;
        let mut y = top + 14;
        area.draw(&PathElement::new(vec![(LEGEND, y), (LEGEND + 50, y)], GROUND.stroke_width(24)))?;
        text("the map", (LEGEND + 64, y), SMALL, HPos::Left, &BLACK)?;
        for ((filter, profile), colour) in self.profiles.iter().zip(COLOURS) {
            area.draw(&PathElement::new(line(&profile.mesh), colour.stroke_width(3)))?;
            y += 46;
            area.draw(&PathElement::new(vec![(LEGEND, y), (LEGEND + 50, y)], colour.stroke_width(5)))?;
            text(filter.name(), (LEGEND + 64, y), SMALL, HPos::Left, &BLACK)?;
        }
        let up = ("sans-serif", SMALL).into_font().transform(FontTransform::Rotate270).color(&BLACK);
        let up = up.pos(Pos::new(HPos::Center, VPos::Center));
        let what = "greatest height of a column, % of the range".to_owned();
        area.draw(&Text::new(what, (34, (top + bottom) / 2), up))?;
        let what = format!("columns of the map, from {} to {}", ground.first, ground.first + ground.map.len() - 1);
        text(&what, ((left + right) / 2, bottom + 40), SMALL, HPos::Center, &BLACK)?;
        area.present()
    }
}
