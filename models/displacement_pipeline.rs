// SPDX-License-Identifier: MIT OR Apache-2.0
//! The whole datapath: from base triangles to displaced triangles that are lit.
//!
//! ```text
//! records, corners -> transform, cull, cut -> pieces -> remesher -> displaced vertices -> strip unit -> light
//! ```
//!
//! | item | what it is |
//! |------|------------|
//! | [`golden`] | a piece to displaced triangles, on a map that is known |
//! | [`Command`], [`Machine`] | the same and all that stands before and behind it, as the design takes and sends it |
//! | [`commands`] | what a draw is as commands |
//! | [`Measure`], [`Deviation`] | the distance of displaced vertices from f64 |

mod commands;
mod machine;
mod measure;
pub mod numbers;
mod skip;

pub use commands::{VERTEX_PLACES, commands};
pub use machine::{Command, Machine, Sent, counter, no_place};
pub use measure::{Deviation, Measure};
pub use skip::{Reach, Skip};

use crate::draw::{Draw, Request};
use crate::mip_fetch::{self, Filter};
use crate::remesher::{self, BaseTriangle, Format};
use crate::rules::{Pyramids, Ruled};
use crate::step::{Step, Vertex};
use crate::strip_unit::{StripOutput, StripUnit};

/// Sends the displaced triangles of a base triangle to `sink`, in winding order; the hardware sends the same ones.
///
/// `base` is a piece of [`Draw::assemble`], made for `format`. A draw whose [rules](crate::rules) the hardware does not have
/// goes another way, and may need two pyramids.
pub fn golden<'a>(
    draw: &Draw,
    format: &Format,
    pyramids: impl Into<Pyramids<'a>>,
    base: &BaseTriangle,
    sink: &mut impl FnMut([Vertex; 3]),
) {
    let pyramids = pyramids.into();
    if draw.rules.refusal().is_some() {
        return Ruled::new(draw, format, base).triangles(pyramids, sink);
    }
    let pyramids = draw.rules.reads(pyramids);
    let mut unit = StripUnit::new(format.column_depth);
    strips(draw, format, base, None, &mut unit, &mut |request| fetch(pyramids, request), &mut |_, out| {
        out.triangles().for_each(&mut *sink);
    });
    debug_assert!(!unit.error(), "the remesher never asks for what the strip unit has not");
}

/// The steps of a piece with displaced vertices, and what the strip unit makes of them; `height` answers requests, in the
/// order of the vertices, but for those that `skip` skips.
fn strips(
    draw: &Draw,
    format: &Format,
    base: &BaseTriangle,
    skip: Option<Skip>,
    unit: &mut StripUnit,
    height: &mut impl FnMut(&Request) -> u32,
    sink: &mut impl FnMut(&Step, &StripOutput),
) {
    let mut displaced = |vertex: &Vertex| {
        let skipped = skip.and_then(|skip| skip.displaced(draw, vertex));
        skipped.unwrap_or_else(|| draw.displace(vertex, height(&draw.request(vertex))))
    };
    remesher::golden(format, base, &mut |step| {
        let mut step: Step = *step;
        if step.sends_left() {
            step.left_vertex = displaced(&step.left_vertex);
        }
        if step.sends_right() {
            step.right_vertex = displaced(&step.right_vertex);
        }
        let out = unit.accept(&step);
        sink(&step, &out);
    });
}

/// A vertex of the remesher, displaced by its height as the hardware does it.
pub(crate) fn displaced_vertex(draw: &Draw, pyramids: Pyramids<'_>, vertex: &Vertex) -> Vertex {
    draw.displace(vertex, fetch(draw.rules.reads(pyramids), &draw.request(vertex)))
}

/// The height that a vertex asks for, UQ16.8.
fn fetch(pyramids: Pyramids<'_>, request: &Request) -> u32 {
    mip_fetch::fetch(
        pyramids.of(request.minima, request.level),
        request.level as usize,
        request.u,
        request.v,
        Filter::Bilinear,
    )
}
