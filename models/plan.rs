// SPDX-License-Identifier: MIT OR Apache-2.0
//! The least hardware that a scene needs: each width as small as an error on the screen allows.
//!
//! ```text
//! error(widths) = largest distance, in X' or Y', of a vertex within the picture from its place in f64
//! plan          = widths with error <= bound, none of which can be one less
//! ```
//!
//! The widths are those of [`Format`], the components that vary, and the levels that are read. Coordinates have to hold
//! the scene (no base triangle is left out that wider ones keep), a column memory its longest column (no vertex is sent
//! twice), and a map that repeats has to keep its seam closed ([`Draw::seams_are_exact`]); the rest is up to the bound.
//!
//! Vertex and guard bits share the bound: of the least vertex bits and one and two more, each with its least guard bits, the
//! pair with the fewest bits in an accumulator is taken. Each width is then tried with one less, all else as planned: what breaks is [`Choice::breaks`].

use crate::displacement_pipeline::{Deviation, Measure};
use crate::draw::{Assembled, Draw, DrawError};
use crate::mesh::Progress;
use crate::mip_build::Pyramid;
use crate::mip_fetch::Placement;
use crate::remesher::{BaseTriangle, Format};
use crate::scene::{Object, Scene};
use crate::step::Vertex;
use rayon::prelude::*;
use serde::Serialize;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Widths of the hardware for a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Widths {
    /// Of remesher and strip unit.
    pub format: Format,
    /// Levels of a map, level 0 included.
    pub levels: usize,
}

/// Triangles beyond which a scene is refused.
pub const MOST_TRIANGLES: u64 = 1 << 24;

/// Wider than any scene needs: what plans are measured against. A column memory holds every column of 24-bit coordinates
/// that ends within a scene.
const WIDEST: Format =
    Format { components: 9, vertex_bits: 32, guard_bits: 24, coordinate_bits: 24, column_depth: 1 << 20 };

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// An object, counted from 0, does not fit.
    #[error("object {0}: {1}")]
    Draw(usize, #[source] DrawError),
    /// Rules that the hardware does not have.
    #[error("{0}")]
    Rules(String),
    /// Nothing can be measured.
    #[error(
        "no vertex of the scene lies within the picture, so there is no error to keep; a `target` on an object is expected"
    )]
    Nothing,
    /// More triangles than are worth forty trials.
    #[error(
        "about {triangles} triangles would come of this scene, beyond the limit of {MOST_TRIANGLES}; a greater `cell_px` is expected"
    )]
    Much {
        /// About so many.
        triangles: u64,
    },
    /// The bound is below what the datapath does with the widest formats.
    #[error(
        "an error of {bound} px cannot be kept: it is {least:.4} px with the widest formats; that much at least is expected"
    )]
    Bound {
        /// What was asked for.
        bound: f64,
        /// What is possible.
        least: f64,
    },
}

/// What came of some widths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Trial {
    /// Of all vertices.
    pub deviation: Deviation,
    /// Base triangles that the voxel grid does not reach.
    pub beyond_grid: u64,
    /// Whether all seams of maps that repeat stay closed.
    pub seams: bool,
}

/// What one less does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Breaks {
    /// The error is so many pixels.
    Error(f64),
    /// So many vertices within the picture lose their place, or gain one.
    Places(u64),
    /// So many base triangles more lie beyond the grid.
    Grid(u64),
    /// A seam may open.
    Seam,
    /// So many vertices are sent and displaced twice.
    Again(u64),
    /// The draw takes so many components.
    Components(usize),
    /// The strip unit cannot carry displaced vertices.
    Displaced,
    /// It cannot be less.
    Least,
}

/// A width of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Choice {
    /// Its name, as a person would say it.
    pub name: &'static str,
    /// Its planned value.
    pub value: usize,
    /// What one less does.
    pub breaks: Breaks,
}

/// The least hardware for a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// The bound, pixels.
    pub bound: f64,
    /// With the widest formats.
    pub widest: Trial,
    /// The widths.
    pub widths: Widths,
    /// What they give.
    pub planned: Trial,
    /// Each of them with one less.
    pub choices: Vec<Choice>,
    /// Levels of the map that has the most.
    pub all_levels: usize,
    /// Words in each bank of the map memory, for the levels that are read.
    pub bank_words: usize,
    /// The same for all levels.
    pub all_bank_words: usize,
    /// The longest side of a map.
    pub side: usize,
}

/// A scene with what does not depend on widths.
pub struct Planner<'a> {
    scene: &'a Scene,
    objects: Vec<PlannedObject<'a>>,
    progress: &'a dyn Progress,
    tried: AtomicU64,
}

struct PlannedObject<'a> {
    object: &'a Object,
    /// Maxima and minima.
    pyramids: [Pyramid; 2],
    /// Data of the base triangles with all lanes of 32 bits, or nothing for those that are gone.
    whole: Vec<Vec<[Vertex; 3]>>,
}

impl<'a> Planner<'a> {
    /// Prepares a scene.
    ///
    /// # Errors
    /// It does not fit any widths, is too much, or has [rules](crate::rules) that the hardware does not have.
    pub fn new(scene: &'a Scene, progress: &'a dyn Progress) -> Result<Self, PlanError> {
        if let Some(refusal) = scene.remesh.rules.refusal() {
            return Err(PlanError::Rules(refusal));
        }
        let mut triangles = 0;
        let prepare = |(at, object): (usize, &'a Object)| {
            let draw = scene.draw(object, &scene.view(), &WIDEST).map_err(|error| PlanError::Draw(at, error))?;
            let assembled: Vec<Assembled> = (0..draw.triangles.len()).map(|index| draw.assemble(index)).collect();
            triangles += assembled.iter().flat_map(Assembled::pieces).map(BaseTriangle::estimate).sum::<u64>();
            if triangles > MOST_TRIANGLES {
                return Err(PlanError::Much { triangles });
            }
            let pieces = |assembled: &Assembled| assembled.pieces().iter().map(|piece| piece.data).collect();
            // The reader of scenes has seen to it that a map has its levels.
            let pyramids = scene.pyramids(object).unwrap_or_else(|error| unreachable!("{error}"));
            Ok(PlannedObject { object, pyramids, whole: assembled.iter().map(pieces).collect() })
        };
        let objects = scene.objects.iter().enumerate().map(prepare).collect::<Result<_, _>>()?;
        Ok(Self { scene, objects, progress, tried: AtomicU64::new(0) })
    }

    /// What some widths give.
    ///
    /// # Errors
    /// A draw that takes more components, or other formats.
    pub fn try_widths(&self, widths: &Widths) -> Result<Trial, PlanError> {
        let mut all = Trial { deviation: Deviation::default(), beyond_grid: 0, seams: true };
        for (at, PlannedObject { object, pyramids, whole }) in self.objects.iter().enumerate() {
            let draw = self.scene.draw(object, &self.scene.view(), &widths.format);
            let mut draw = draw.map_err(|error| PlanError::Draw(at, error))?;
            draw.level.levels = draw.level.levels.min(widths.levels.min(64) as u32);
            let (format, viewport) = (&widths.format, self.scene.camera.viewport);
            let pyramids = draw.rules.reads(pyramids.into());
            let measure = Measure { draw: &draw, format, pyramids, viewport };
            let one = |index: usize| {
                let assembled = draw.assemble(index);
                let measured = assembled
                    .pieces()
                    .iter()
                    .zip(&whole[index])
                    .map(|(piece, whole): (&BaseTriangle, _)| measure.deviation(piece, whole))
                    .fold(Deviation::default(), Deviation::with);
                (measured, u64::from(is_beyond(&assembled)))
            };
            let none = || (Deviation::default(), 0);
            let sum = |a: (Deviation, u64), b: (Deviation, u64)| (a.0.with(b.0), a.1 + b.1);
            let (deviation, beyond) = (0..whole.len()).into_par_iter().map(one).reduce(none, sum);
            all.deviation = all.deviation.with(deviation);
            all.beyond_grid += beyond;
            all.seams &= !object.has_seam() || draw.seams_are_exact();
        }
        self.progress.advance(self.tried.fetch_add(1, Relaxed) + 1);
        Ok(all)
    }

    /// Finds the plan for a bound in pixels.
    ///
    /// # Errors
    /// The bound cannot be kept, or there is nothing to measure.
    pub fn plan(&self, bound: f64) -> Result<Plan, PlanError> {
        // About as many trials as this takes.
        self.progress.phase("trying widths", 40);
        let levels = self.objects.iter().map(|object| object.pyramids[0].levels.len()).max().unwrap_or(1);
        let widest = Widths { format: WIDEST, levels };
        let at_widest = self.try_widths(&widest)?;
        if at_widest.deviation.vertices == 0 {
            return Err(PlanError::Nothing);
        }
        let least = at_widest.deviation.max;
        if least > bound {
            return Err(PlanError::Bound { bound, least });
        }
        let keeps = |widths: &Widths| {
            self.try_widths(widths).is_ok_and(|trial| self.breaks(&at_widest, &trial, bound).is_none())
        };
        let format = |change: &dyn Fn(&mut Format), from: &Widths| {
            let mut widths = *from;
            change(&mut widths.format);
            widths
        };
        // Lanes that are constants times c stay behind.
        let mut widths = widest;
        let fewer = (1..9).map(|components| format(&|format| format.components = components, &widths));
        widths = fewer.into_iter().find(|widths| self.draws(widths)).unwrap_or(widths);
        // The grid, which is independent of the data.
        widths.format.coordinate_bits = (2..24).find(|bits| self.beyond(*bits) == at_widest.beyond_grid).unwrap_or(24);
        // The column memory, which changes nothing but how often a vertex is sent. It takes a vertex before it gives one.
        let deepest = at_widest.deviation.column;
        let depth = |column_depth| format(&|format| format.column_depth = column_depth, &widths);
        widths = depth(least_of(0, 2 * deepest, |column_depth| {
            self.try_widths(&depth(column_depth)).is_ok_and(|trial| trial.deviation.sent == at_widest.deviation.sent)
        }));
        widths.levels = least_of(1, levels, |levels| keeps(&Widths { levels, ..widths }));
        // Vertex bits with guard bits to spare, then guard bits for these and for a few more vertex bits.
        let with = |vertex_bits: u32, guard_bits: u32| {
            format(&|format| (format.vertex_bits, format.guard_bits) = (vertex_bits, guard_bits), &widths)
        };
        let vertex_bits = least_of(8, 32, |bits| keeps(&with(bits as u32, 24))) as u32;
        let guard = |vertex_bits: u32| least_of(0, 24, |bits| keeps(&with(vertex_bits, bits as u32))) as u32;
        let pairs = (vertex_bits..=32).take(3).map(|bits| (bits, guard(bits)));
        let pair = pairs.min_by_key(|(vertex, guard)| (vertex + guard, *vertex)).unwrap_or((32, 24));
        widths = with(pair.0, pair.1);
        // Halving takes it for granted that errors grow with what is left out; they nearly do.
        let mut planned = self.try_widths(&widths)?;
        while planned.deviation.max > bound && widths.format.vertex_bits < 32 {
            widths.format.vertex_bits += 1;
            planned = self.try_widths(&widths)?;
        }
        Ok(Plan {
            bound,
            widest: at_widest,
            widths,
            planned,
            choices: self.one_less(&at_widest, &widths, &planned, bound),
            all_levels: levels,
            bank_words: self.bank_words(widths.levels),
            all_bank_words: self.bank_words(levels),
            side: self
                .objects
                .iter()
                .map(|object| object.object.map.width.max(object.object.map.height))
                .max()
                .unwrap_or(1),
        })
    }

    /// What is not kept by a trial, if anything.
    fn breaks(&self, widest: &Trial, trial: &Trial, bound: f64) -> Option<Breaks> {
        let (all, measured) = (&trial.deviation, &widest.deviation);
        if trial.beyond_grid > widest.beyond_grid {
            Some(Breaks::Grid(trial.beyond_grid - widest.beyond_grid))
        } else if widest.seams && !trial.seams {
            Some(Breaks::Seam)
        } else if all.max > bound {
            Some(Breaks::Error(all.max))
        } else if all.flags > measured.flags {
            Some(Breaks::Places(all.flags - measured.flags))
        } else {
            None
        }
    }

    /// Tries each width with one less.
    fn one_less(&self, widest: &Trial, widths: &Widths, planned: &Trial, bound: f64) -> Vec<Choice> {
        let changed = |change: fn(&mut Widths)| {
            let mut less = *widths;
            change(&mut less);
            match self.try_widths(&less) {
                Err(PlanError::Draw(_, DrawError::Format { least, .. })) if least > less.format.components => {
                    Breaks::Components(least)
                }
                Err(PlanError::Draw(_, DrawError::Format { .. })) => Breaks::Displaced,
                // Below the formats' own limits.
                Err(_) => Breaks::Least,
                Ok(trial) => self.breaks(widest, &trial, bound).unwrap_or_else(|| {
                    let again = trial.deviation.sent - planned.deviation.sent.min(trial.deviation.sent);
                    if again > 0 { Breaks::Again(again) } else { Breaks::Least }
                }),
            }
        };
        let Widths { format, levels } = *widths;
        let choice = |name, value: usize, least: usize, change: fn(&mut Widths)| {
            let breaks = if value <= least { Breaks::Least } else { changed(change) };
            Choice { name, value, breaks }
        };
        vec![
            choice("components", format.components, 1, |widths| widths.format.components -= 1),
            choice("bits of a component", format.vertex_bits as usize, 2, |widths| widths.format.vertex_bits -= 1),
            choice("guard bits", format.guard_bits as usize, 0, |widths| widths.format.guard_bits -= 1),
            choice("bits of a grid coordinate", format.coordinate_bits as usize, 2, |widths| {
                widths.format.coordinate_bits -= 1;
            }),
            choice("column memory", format.column_depth, 0, |widths| widths.format.column_depth -= 1),
            choice("levels", levels, 1, |widths| widths.levels -= 1),
        ]
    }

    /// Whether every object takes these widths.
    fn draws(&self, widths: &Widths) -> bool {
        let view = self.scene.view();
        self.objects.iter().all(|object| self.scene.draw(object.object, &view, &widths.format).is_ok())
    }

    /// Base triangles beyond a grid of so many bits.
    fn beyond(&self, coordinate_bits: u32) -> u64 {
        let view = self.scene.view();
        let count = |object: &PlannedObject<'_>| {
            let draw = self.scene.draw(object.object, &view, &Format { coordinate_bits, ..WIDEST });
            // Formats that no draw takes hold nothing.
            draw.map_or(u64::MAX / 64, |draw: Draw| {
                (0..draw.triangles.len()).filter(|index| is_beyond(&draw.assemble(*index))).count() as u64
            })
        };
        self.objects.iter().map(count).sum()
    }

    /// Words in each bank for the lowest levels of the largest map.
    fn bank_words(&self, levels: usize) -> usize {
        let words = |object: &PlannedObject<'_>| {
            let pyramids = self.scene.remesh.rules.reads((&object.pyramids).into());
            let words = |level: &Placement| level.words() << usize::from(level.has_minima());
            pyramids.layout().iter().take(levels).map(words).sum()
        };
        self.objects.iter().map(words).max().unwrap_or(0)
    }
}

/// Whether a base triangle is left out for the grid's sake.
fn is_beyond(assembled: &Assembled) -> bool {
    matches!(assembled, Assembled::Dropped(reason) if *reason != crate::draw::DropReason::Near)
}

/// The least value in a range for which something holds, given that it holds for the last one and, once it holds, for all
/// above: by halving.
fn least_of(first: usize, last: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (first, last);
    while low < high {
        let middle = low.midpoint(high);
        if holds(middle) { high = middle } else { low = middle + 1 }
    }
    low
}
