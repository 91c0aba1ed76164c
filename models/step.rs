// SPDX-License-Identifier: MIT OR Apache-2.0
//! The step port: what the remesher sends and the strip unit decodes, one [`Step`] a beat.
//!
//! A strip is the ladder between a left column of vertices and the next, right one. A step advances the ladder by one
//! rung: it may move the left vertex, the right vertex, or both, and closes one triangle for each that moved.
//!
//! The strip unit holds four vertices: `left` and `right` (the top rung), `start` (the right end of the strip's first
//! rung) and `edge` (the first vertex of the upper edge that is not yet consumed); and the *column memory*, a queue of
//! the interior vertices of the right column, which are the interior vertices of the next strip's left column in the
//! same order. (Gumhold & Huettner 1999, section 3.4, has the four registers; the column memory is ours.)
//!
//! | kind  | effect before the triangles                                                | triangles closed |
//! |-------|----------------------------------------------------------------------------|------------------|
//! | Start | `swap` loaded, column memory emptied; left = LD; start = right = RD         | none |
//! | Init  | left = start; start = right = RD                                            | none |
//! | Fan   | right = left; left = edge (left command Edge) or LD (any other)           | none |
//! | Step  | L' = by the left command, R' = by the right command                         | (L,R,L') if L moved, (R,R',L') if R moved |
//!
//! LD and RD are the vertices sent with the beat. `Start` always sends both, `Init` the right one. A triangle with two
//! equal vertices is dropped; with `swap` a triangle (a,b,c) leaves as (a,c,b).

use serde::{Deserialize, Serialize};

/// The most components a vertex can carry in the golden models.
pub const MAX_COMPONENTS: usize = 16;

/// Vertex data, one signed integer a component; components that the format does not use are zero.
pub type Vertex = [i64; MAX_COMPONENTS];

/// What a beat of the step port does. The numbers are the encoding of the hardware port (2 bits).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u8)]
pub enum Kind {
    /// Advances the ladder by one rung.
    Step = 0,
    /// First rung of a sub-triangle that starts at a corner.
    Start = 1,
    /// First rung of a strip that follows another.
    Init = 2,
    /// Turns the last strip into a fan about the last vertex of the left column.
    Fan = 3,
}

/// Where the next left vertex comes from. The numbers are the encoding of the hardware port (2 bits).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u8)]
pub enum LeftCommand {
    /// The left vertex stays.
    Ref = 0,
    /// `setref left`: the vertex sent with the beat.
    Set = 1,
    /// `recall`: the next vertex of the column memory, already displaced and lit.
    Recall = 2,
    /// `ref edge`: the edge register.
    Edge = 3,
}

/// Where the next right vertex comes from. The numbers are the encoding of the hardware port (2 bits).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u8)]
pub enum RightCommand {
    /// The right vertex stays.
    Ref = 0,
    /// `setref right`: the vertex sent with the beat.
    Set = 1,
    /// `setref right`, and the vertex is appended to the column memory.
    Store = 2,
    /// `setref edge`: the vertex sent with the beat goes to the edge register and to the right one.
    Edge = 3,
}

/// One beat of the step port.
///
/// `left_vertex` means something only where [`Step::sends_left`] holds, `right_vertex` only where
/// [`Step::sends_right`] holds; golden models put zero there otherwise, hardware may put anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Step {
    /// What the beat does.
    pub kind: Kind,
    /// Source of the left vertex; `Set` in a `Start`, `Ref` in an `Init`, `Set` or `Edge` in a `Fan`.
    pub left: LeftCommand,
    /// Source of the right vertex; `Set` in a `Start` and an `Init`, `Ref` in a `Fan`.
    pub right: RightCommand,
    /// Winding of the triangles to come; read in a `Start` only, equal to it in the beats after.
    pub swap: bool,
    /// The last beat of its base triangle.
    pub last: bool,
    /// Vertex data for the left side.
    pub left_vertex: Vertex,
    /// Vertex data for the right side.
    pub right_vertex: Vertex,
}

impl Step {
    /// Whether `left_vertex` carries a vertex.
    pub const fn sends_left(&self) -> bool {
        matches!(self.left, LeftCommand::Set)
    }
    /// Whether `right_vertex` carries a vertex.
    pub const fn sends_right(&self) -> bool {
        !matches!(self.right, RightCommand::Ref)
    }
}
