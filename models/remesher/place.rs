// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where the vertices of a beat lie, and who is told.

use crate::step::{Kind, LeftCommand, RightCommand, Step};
use serde::{Deserialize, Serialize};

/// Where a vertex lies on its base triangle; equal places are the same vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Place {
    /// Corner `0..3`.
    Corner(u8),
    /// Vertex of the inside of an edge.
    Edge {
        /// Edge: e0 = P0P1, e1 = P1P2, e2 = P2P0.
        edge: u8,
        /// Number from the edge's low end, `1..n`.
        index: u32,
    },
    /// Vertex of the grid of the remeshing plane, strictly between the edges.
    Interior {
        /// Grid coordinate on the (unmirrored) sweep axis, in voxels.
        sweep: i32,
        /// Grid coordinate on the (unmirrored) side axis, in voxels.
        side: i32,
    },
}

/// The ladder's state at a beat, as the sweep sees it, without decoding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rung {
    /// Left vertex before the beat; in a `Start`, `Init` or `Fan` equal to `next_left`.
    pub left: Place,
    /// Right vertex before the beat; in a `Start`, `Init` or `Fan` equal to `next_right`.
    pub right: Place,
    /// Left vertex after the beat.
    pub next_left: Place,
    /// Right vertex after the beat.
    pub next_right: Place,
    /// First vertex of the upper edge not yet consumed, before the beat.
    pub edge: Place,
    /// Its row, in the mirrored plane.
    pub edge_row: i32,
    /// Sub-triangle, 0 or 1 (the half beyond C's column).
    pub sub: u8,
    /// Strip within the sub-triangle, from 0.
    pub strip: u32,
    /// Vertices in the column memory for the left side and for the right one, after the beat.
    pub stored: [usize; 2],
}

impl Rung {
    /// The triangles of `step` in the base triangle's winding order, those with two equal vertices left out.
    pub fn triangles(&self, step: &Step) -> impl Iterator<Item = [Place; 3]> + use<> {
        let moves = step.kind == Kind::Step;
        let first = (moves && step.left != LeftCommand::Ref).then_some([self.left, self.right, self.next_left]);
        let second =
            (moves && step.right != RightCommand::Ref).then_some([self.right, self.next_right, self.next_left]);
        let swap = step.swap;
        [first, second]
            .into_iter()
            .flatten()
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .map(move |[a, b, c]| if swap { [a, c, b] } else { [a, b, c] })
    }
}

/// Receives the beats of a sweep.
pub(super) trait Observer {
    /// Whether the sweep must keep the [`Rung`].
    const WATCHES: bool;
    fn beat(&mut self, step: &Step, rung: &Rung);
}

/// Only the beats.
pub(super) struct Beats<'a>(pub &'a mut dyn FnMut(&Step));

impl Observer for Beats<'_> {
    const WATCHES: bool = false;
    #[inline(always)]
    fn beat(&mut self, step: &Step, _: &Rung) {
        (self.0)(step);
    }
}

/// The beats with their rungs.
pub(super) struct Watched<'a>(pub &'a mut dyn FnMut(&Step, &Rung));

impl Observer for Watched<'_> {
    const WATCHES: bool = true;
    fn beat(&mut self, step: &Step, rung: &Rung) {
        (self.0)(step, rung);
    }
}
