// SPDX-License-Identifier: MIT OR Apache-2.0
//! A draw as commands of the design.
//!
//! ```text
//! sizes and samples of the map -> constants, number 0 first -> records, triangles -> .. -> reports
//! ```
//!
//! A vertex memory has fewer places than a large draw has vertices. So triangles go in groups whose vertices fit, each
//! behind its records, in the order of the draw; what a group needs again is sent again.

use super::machine::{Command, Light, counter};
use super::numbers::{View, values};
use super::skip::Reach;
use crate::draw::Draw;
use crate::mip_fetch;
use crate::rules::Pyramids;
use rustc_hash::FxHashMap;

/// Places of the design's vertex memory.
pub const VERTEX_PLACES: usize = 512;

/// The commands of a draw, from the map to the reports of all counters. `viewport` is in pixels; with `skips`, triangles
/// beyond its sides are left out.
///
/// A draw that displaces nothing ([`Draw::is_flat`]) passes the remesher by.
///
/// `pyramids` are those that the draw's [rules](Draw::rules) read.
pub fn commands<'a>(
    draw: &Draw,
    pyramids: impl Into<Pyramids<'a>>,
    light: &Light,
    viewport: [u32; 2],
    skips: bool,
) -> Vec<Command> {
    // Half a pixel is 128 / 256 of one.
    let half = viewport.map(|side| i64::from(side) << 7);
    let view = View { skips, passes: draw.is_flat(), half, reach: Reach::new(draw, half) };
    let map = draw.rules.reads(pyramids.into());
    let mut out: Vec<Command> = map.commands(0).filter_map(Command::of_map).collect();
    out.extend(values(draw, light, &view).into_iter().map(|(number, value)| Command::Constant { number, value }));
    let mut group = Group::default();
    for corners in &draw.triangles {
        if !group.fits(corners) {
            group.close(draw, &mut out);
        }
        group.take(corners);
    }
    group.close(draw, &mut out);
    out.extend(counter::all().map(|counter| Command::Report { counter: counter as u64 }));
    out
}

impl Command {
    /// A size or a sample for the map's memory; a fetch is nobody's command.
    const fn of_map(command: mip_fetch::Command) -> Option<Self> {
        match command {
            mip_fetch::Command::Size { level, placement } => Some(Self::Size { level, placement }),
            mip_fetch::Command::Load { level, minima, i, j, value } => Some(Self::Load { level, minima, i, j, value }),
            mip_fetch::Command::Fetch { .. } => None,
        }
    }
}

/// Triangles whose vertices fit the vertex memory.
#[derive(Default)]
struct Group {
    /// The places of vertices.
    places: FxHashMap<u32, usize>,
    /// The vertices, by place.
    vertices: Vec<u32>,
    triangles: Vec<[usize; 3]>,
}

impl Group {
    fn fits(&self, corners: &[u32; 3]) -> bool {
        let new = corners.iter().filter(|vertex| !self.places.contains_key(vertex)).count();
        self.vertices.len() + new <= VERTEX_PLACES
    }

    fn take(&mut self, corners: &[u32; 3]) {
        let Self { places, vertices, triangles } = self;
        triangles.push(corners.map(|vertex| {
            *places.entry(vertex).or_insert_with(|| {
                vertices.push(vertex);
                vertices.len() - 1
            })
        }));
    }

    fn close(&mut self, draw: &Draw, out: &mut Vec<Command>) {
        let records = self.vertices.iter().enumerate();
        out.extend(records.map(|(place, vertex)| Command::Record { place, vertex: draw.records[*vertex as usize] }));
        out.extend(self.triangles.iter().map(|places| Command::Triangle { places: *places }));
        *self = Self::default();
    }
}
