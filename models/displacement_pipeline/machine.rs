// SPDX-License-Identifier: MIT OR Apache-2.0
//! The design as a machine: commands in, lit triangles and counts out.
//!
//! Built of the golden models of its blocks. A triangle needs the constants of a draw, number 0 among them, and a map;
//! before number 0 it counts as nothing and sends nothing.

use super::numbers::{self, View};
use super::skip::{Reach, Skip};
use super::strips;
use crate::cull::Reason;
use crate::displace::{displaced, flag};
use crate::draw::{Assembled, Draw, DropReason, Request};
pub(super) use crate::light::Light;
use crate::mip_fetch::{self, Filter, MipFetch, Placement};
use crate::remesher::{BaseTriangle, Format};
use crate::step::Vertex;
use crate::strip_unit::StripUnit;
use crate::vertex_transform::{BaseVertex, Transformed};

/// What the design is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// A constant of the draw, see [`numbers`].
    Constant {
        /// Its number; 0 is the first of a draw and clears the counters.
        number: u64,
        /// Signed, 63 bits.
        value: i64,
    },
    /// A vertex for the vertex memory.
    Record {
        /// Where it goes.
        place: usize,
        /// The vertex.
        vertex: BaseVertex,
    },
    /// Where a level of the map stands.
    Size {
        /// The level; levels come in order, and the sizes of the levels above are forgotten.
        level: usize,
        /// Its place.
        placement: Placement,
    },
    /// A sample of the map.
    Load {
        /// The level.
        level: usize,
        /// Whether it is one of the minima.
        minima: bool,
        /// Column.
        i: usize,
        /// Row.
        j: usize,
        /// The sample.
        value: u16,
    },
    /// A base triangle.
    Triangle {
        /// The places of its corners.
        places: [usize; 3],
    },
    /// Asks for a counter.
    Report {
        /// Its number, see [`counter`].
        counter: u64,
    },
}

/// What the design sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(clippy::large_enum_variant)] // Nearly all of them are triangles.
pub enum Sent {
    /// A triangle with a place.
    Triangle {
        /// Its displaced vertices, lanes of [`displaced`], in winding order.
        vertices: [Vertex; 3],
        /// Red, green, blue.
        colour: [u8; 3],
    },
    /// A counter.
    Report {
        /// Its number.
        counter: u64,
        /// Its value; `None` for one that depends on time.
        value: Option<u32>,
    },
}

/// Numbers of the counters: 32 bits, saturating; cleared by constant 0.
pub mod counter {
    /// Base triangles.
    pub const BASES: usize = 0;
    /// First of the six that count the culled, by [`Reason`](crate::cull::Reason).
    pub const CULLED: usize = 1;
    /// Of the base triangles that went on, those that were cut.
    pub const CUT: usize = 7;
    /// First of the three that count the dropped, by [`DropReason`](crate::draw::DropReason).
    pub const DROPPED: usize = 8;
    /// Pieces that went on.
    pub const PIECES: usize = 11;
    /// Steps of the remesher; two for each piece that passes it by.
    pub const STEPS: usize = 12;
    /// Vertices displaced.
    pub const VERTICES: usize = 13;
    /// Triangles of the strip unit.
    pub const STRIP_TRIANGLES: usize = 14;
    /// First of the three that count triangles without a place, by the lowest [`flag`](crate::displace::flag).
    pub const NO_PLACE: usize = 15;
    /// Triangles off the screen.
    pub const OFF_SCREEN: usize = 18;
    /// Triangles sent.
    pub const SENT: usize = 19;
    /// Vertices that were skipped, and not displaced.
    pub const SKIPPED: usize = 20;
    /// Which of the reasons to drop there were, base triangles' in bits 0 to 2 and triangles' in 3 to 5: a bit stays until the next
    /// draw.
    pub const LOST: usize = 21;
    /// How many depend on the commands alone; the others read 0.
    pub const COUNT: usize = 22;
    /// Cycles in which a base triangle was on its way.
    pub const BUSY: usize = 24;
    /// Cycles in which a piece waited for the remesher.
    pub const PIECE_WAITS: usize = 25;
    /// Cycles without a step of the remesher while a base triangle was on its way.
    pub const NO_STEP: usize = 26;
    /// Cycles in which a step waited for room.
    pub const STEP_WAITS: usize = 27;
    /// Cycles in which a step waited for its second vertex.
    pub const SECOND_VERTEX: usize = 28;
    /// Cycles in which the strip unit waited to be taken.
    pub const STRIP_WAITS: usize = 29;
    /// Cycles in which a lit triangle waited for the receiver.
    pub const RECEIVER: usize = 30;
    /// Those that depend on time.
    pub const TIMES: std::ops::RangeInclusive<usize> = BUSY..=RECEIVER;

    /// The counters that say anything, in order.
    pub fn all() -> impl Iterator<Item = usize> {
        (0..COUNT).chain(TIMES)
    }
}

/// Golden model of the design.
#[derive(Clone, Debug)]
pub struct Machine {
    format: Format,
    /// Constants.
    draw: Draw,
    /// The vertex memory: records, transformed as they came.
    vertices: Vec<Transformed>,
    light: Light,
    view: View,
    map: MipFetch,
    unit: StripUnit,
    counters: [u64; counter::COUNT],
    begun: bool,
}

impl Machine {
    /// The design after reset, with `places` vertices and four banks of `bank_words` samples.
    ///
    /// `format` has at least nine components.
    pub fn new(format: &Format, places: usize, bank_words: usize) -> Self {
        let draw = Draw::blank(format);
        let nothing = BaseVertex { position: [0; 3], normal: [0; 3], texel: [0; 2], density: 0 };
        Self {
            format: *format,
            vertices: vec![draw.transformed(nothing); places],
            draw,
            light: Light { direction: [0; 3], colour: [0; 3] },
            view: View { skips: false, passes: false, half: [0; 2], reach: Reach::NONE },
            map: MipFetch::new(bank_words),
            unit: StripUnit::new(format.column_depth),
            counters: [0; counter::COUNT],
            begun: false,
        }
    }

    /// Sticky: the map memory's error, or the strip unit's. No draw raises it.
    pub const fn error(&self) -> bool {
        self.map.error() || self.unit.error()
    }

    /// Takes one command; `sink` gets what it makes the design send, in order.
    pub fn accept(&mut self, command: &Command, sink: &mut impl FnMut(Sent)) {
        match *command {
            Command::Constant { number, value } => {
                if number == 0 {
                    self.begun = true;
                    self.counters = [0; counter::COUNT];
                }
                numbers::write(&mut self.draw, &mut self.light, &mut self.view, number, value);
            }
            Command::Record { place, vertex } if self.begun => {
                let places = self.vertices.len();
                self.vertices[place % places] = self.draw.transformed(vertex);
            }
            Command::Record { .. } => {}
            Command::Size { level, placement } => {
                self.map.accept(&mip_fetch::Command::Size { level, placement });
            }
            Command::Load { level, minima, i, j, value } => {
                self.map.accept(&mip_fetch::Command::Load { level, minima, i, j, value });
            }
            Command::Triangle { places } if self.begun => self.triangle(places, sink),
            Command::Triangle { .. } => {}
            Command::Report { counter } => {
                let at = counter as usize;
                self.counters[counter::LOST] = self.lost();
                let value = match self.counters.get(at) {
                    Some(count) => Some(u32::try_from(*count).unwrap_or(u32::MAX)),
                    None if counter::TIMES.contains(&at) => None,
                    None => Some(0),
                };
                sink(Sent::Report { counter, value });
            }
        }
    }

    /// A bit for each reason of [`counter::DROPPED`] and of [`counter::NO_PLACE`].
    fn lost(&self) -> u64 {
        let of = |first: usize| self.counters[first..first + 3].iter().map(|count| u64::from(*count > 0));
        of(counter::DROPPED).chain(of(counter::NO_PLACE)).enumerate().map(|(bit, set)| set << bit).sum()
    }

    fn triangle(&mut self, places: [usize; 3], sink: &mut impl FnMut(Sent)) {
        let memory = self.vertices.len();
        let assembled = self.draw.assemble_corners(&places.map(|place| self.vertices[place % memory]));
        self.counters[counter::BASES] += 1;
        match &assembled {
            Assembled::Culled(reason) => self.counters[culled(*reason)] += 1,
            Assembled::Dropped(reason) => self.counters[dropped(*reason)] += 1,
            Assembled::Kept(_) => {}
            Assembled::Cut(_) => self.counters[counter::CUT] += 1,
        }
        for piece in assembled.pieces() {
            self.counters[counter::PIECES] += 1;
            if self.view.passes { self.pass(piece, sink) } else { self.remesh(piece, sink) }
        }
    }

    /// A piece as it is.
    fn pass(&mut self, piece: &BaseTriangle, sink: &mut impl FnMut(Sent)) {
        self.counters[counter::STEPS] += 2;
        self.counters[counter::VERTICES] += 3;
        let vertices = piece.data.each_ref().map(|vertex| self.draw.displace(vertex, 0));
        self.finish(vertices, sink);
    }

    fn remesh(&mut self, piece: &BaseTriangle, sink: &mut impl FnMut(Sent)) {
        let Self { format, draw, view, map, unit, counters, .. } = self;
        let (mut sent, mut displaced) = (0, 0);
        let mut height = |request: &Request| {
            let &Request { level, u, v, minima } = request;
            displaced += 1;
            let fetch = mip_fetch::Command::Fetch { level: level as usize, u, v, filter: Filter::Bilinear, minima };
            map.accept(&fetch).unwrap_or(0)
        };
        let mut triangles = Vec::new();
        let skip = Skip::of(draw, view, piece);
        strips(draw, format, piece, skip, unit, &mut height, &mut |step, out| {
            counters[counter::STEPS] += 1;
            sent += u64::from(step.sends_left()) + u64::from(step.sends_right());
            triangles.extend(out.triangles());
        });
        counters[counter::VERTICES] += displaced;
        counters[counter::SKIPPED] += sent - displaced;
        for triangle in triangles {
            self.finish(triangle, sink);
        }
    }

    /// A triangle of the strip unit: left out, or lit and sent.
    fn finish(&mut self, vertices: [Vertex; 3], sink: &mut impl FnMut(Sent)) {
        self.counters[counter::STRIP_TRIANGLES] += 1;
        if let Some(reason) = no_place(&vertices) {
            self.counters[counter::NO_PLACE + reason] += 1;
        } else if self.view.skips && self.view.misses(&vertices) {
            self.counters[counter::OFF_SCREEN] += 1;
        } else {
            self.counters[counter::SENT] += 1;
            let colour = self.draw.shade(vertices, &[self.light]);
            sink(Sent::Triangle { vertices, colour });
        }
    }
}

/// The counter of a reason.
const fn culled(reason: Reason) -> usize {
    counter::CULLED + reason as usize
}

/// The counter of a reason.
const fn dropped(reason: DropReason) -> usize {
    counter::DROPPED + reason as usize
}

/// Why a triangle has no place: the number of the lowest flag of its vertices.
pub fn no_place(vertices: &[Vertex; 3]) -> Option<usize> {
    let flags = vertices.iter().fold(0, |all, vertex| all | vertex[displaced::FLAGS]);
    [flag::INVALID, flag::NEAR, flag::RANGE].iter().position(|flag| flags & flag != 0)
}

impl View {
    /// Whether all vertices of a triangle are beyond one side of the viewport, so that it covers no pixel.
    pub fn misses(&self, vertices: &[Vertex; 3]) -> bool {
        let beyond = |lane: usize, half: i64| {
            vertices.iter().all(|vertex| vertex[lane] < -half) || vertices.iter().all(|vertex| vertex[lane] > half)
        };
        beyond(displaced::X, self.half[0]) || beyond(displaced::Y, self.half[1])
    }
}
