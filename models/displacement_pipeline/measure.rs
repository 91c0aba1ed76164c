// SPDX-License-Identifier: MIT OR Apache-2.0
//! The distance of displaced vertices from what f64 makes of the same corners.
//!
//! ```text
//! corners (9 lanes of 32 bits) -> narrow -> remesher -> widen -> request -> height -> displace
//!                              `-> linear in f64 -> u, v = lanes / c -> bilinear at the same level -> displaced in f64
//! ```
//!
//! The exact chain takes the corners as they stand in 32-bit lanes, so what is measured is all that the widths of the
//! remesher, the reciprocals, the weights of the fetch and the output format do. Its level is that of the exact footprint;
//! where that lies within 1 % of a threshold, either level is right.
//!
//! Unit of the distances: pixels, the greater one of those in X' and in Y'. Vertices whose exact place is outside of the
//! viewport are not measured.

use super::displaced_vertex;
use crate::displace::{self, displaced};
use crate::draw::Draw;
use crate::filter_level;
use crate::mip_fetch;
use crate::remesher::{self, BaseTriangle, Format, Setup, exact};
use crate::rules::Pyramids;
use crate::step::{MAX_COMPONENTS, Vertex};
use crate::vertex_transform::lane;
use serde::Serialize;

/// How far vertices are from their exact places, and what they took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Deviation {
    /// Vertices sent.
    pub sent: u64,
    /// Vertices with a place within the viewport, both exactly and in integers.
    pub vertices: u64,
    /// Largest distance, pixels.
    pub max: f64,
    /// Sum of the squares of the distances.
    pub squares: f64,
    /// Vertices that have a place only exactly, or only in integers.
    pub flags: u64,
    /// Vertices whose level is not that of their footprint.
    pub levels: u64,
    /// Highest level.
    pub highest: u32,
    /// Most vertices in the column memory.
    pub column: usize,
}

impl Deviation {
    /// Root mean square of the distances, pixels.
    pub fn rms(&self) -> f64 {
        if self.vertices == 0 { 0.0 } else { (self.squares / self.vertices as f64).sqrt() }
    }

    /// Of the vertices of both.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            sent: self.sent + other.sent,
            vertices: self.vertices + other.vertices,
            max: self.max.max(other.max),
            squares: self.squares + other.squares,
            flags: self.flags + other.flags,
            levels: self.levels + other.levels,
            highest: self.highest.max(other.highest),
            column: self.column.max(other.column),
        }
    }
}

/// The thresholds of the filter level are sqrt(2) 2^i; a footprint so near to one may count as either side of it.
const NEAR_A_THRESHOLD: f64 = 1.01;

/// What vertices are measured against.
#[derive(Clone, Copy, Debug)]
pub struct Measure<'a> {
    /// The draw, with the lanes of `format`.
    pub draw: &'a Draw,
    /// Widths of the remesher.
    pub format: &'a Format,
    /// All levels of the map that the draw's rules read; it may use fewer.
    pub pyramids: Pyramids<'a>,
    /// Columns and rows of the picture.
    pub viewport: [u32; 2],
}

impl Measure<'_> {
    /// Measures the vertices of one base triangle: `base` as the draw made it, `whole` the data of the same corners with
    /// all lanes of 32 bits.
    pub fn deviation(&self, base: &BaseTriangle, whole: &[Vertex; 3]) -> Deviation {
        let mut out = Deviation::default();
        let whole = BaseTriangle { corners: base.corners, data: *whole };
        let setup = Setup::new(self.format, base);
        remesher::observe(self.format, base, &mut |step, rung| {
            out.column = out.column.max(rung.stored[0]).max(rung.stored[1]);
            let sent = [
                step.sends_left().then_some((&step.left_vertex, rung.next_left)),
                step.sends_right().then_some((&step.right_vertex, rung.next_right)),
            ];
            for (vertex, place) in sent.into_iter().flatten() {
                self.vertex(vertex, &exact::vertex(&whole, &setup, place), &mut out);
            }
        });
        out
    }

    fn vertex(&self, vertex: &Vertex, lanes: &[f64; MAX_COMPONENTS], out: &mut Deviation) {
        let Self { draw, pyramids, viewport, .. } = self;
        let request = draw.request(vertex);
        out.sent += 1;
        out.highest = out.highest.max(request.level);

        let c = lanes[lane::C].max(f64::MIN_POSITIVE);
        let footprint = filter_level::exact(&draw.level, lanes[lane::DENSITY], c);
        let level = |footprint: f64| {
            // UQ16.16, saturating.
            let fixed = (footprint * 65536.0).min(f64::from(u32::MAX)) as u32;
            filter_level::thresholds(fixed).saturating_sub(1).min(pyramids.maxima.levels.len() as u32 - 1)
        };
        let (low, high) = (level(footprint / NEAR_A_THRESHOLD), level(footprint * NEAR_A_THRESHOLD));
        let right = (low..=high).contains(&request.level);
        out.levels += u64::from(!right);
        let level = if right { request.level } else { level(footprint) };
        let texel = |k: usize| {
            let axis = &draw.axes[k];
            let at = lanes[lane::U + k].max(0.0) / c * f64::from(1u32 << axis.texel_bits);
            let size = f64::from(axis.size);
            if axis.repeat { at.rem_euclid(size) } else { at.min(size - 1.0) }
        };
        let pyramid = pyramids.of(request.minima, level);
        let q = mip_fetch::exact(pyramid, level as usize, texel(0), texel(1));
        let exact = displace::exact(&draw.displacement, lanes, q);
        let moved = displaced_vertex(draw, *pyramids, vertex);
        let half = viewport.map(|side| f64::from(side) / 2.0);
        match (moved[displaced::FLAGS] == 0, exact) {
            (true, Some([x, y, _])) if x.abs() <= half[0] && y.abs() <= half[1] => {
                let off = |lane: usize, exact: f64| (moved[lane] as f64 / 256.0 - exact).abs();
                let distance = off(displaced::X, x).max(off(displaced::Y, y));
                out.vertices += 1;
                out.max = out.max.max(distance);
                out.squares += distance * distance;
            }
            // Nearer than z0: no place in the format, and dropped for that.
            (false, Some([x, y, c])) => {
                out.flags += u64::from(c < 0.999 && x.abs() <= half[0] && y.abs() <= half[1]);
            }
            (true, None) => out.flags += 1,
            _ => {}
        }
    }
}
