// SPDX-License-Identifier: MIT OR Apache-2.0
//! Turns the beats of the [step port](crate::step) into triangles.
//!
//! The unit holds four vertices, a queue and a bit (Gumhold & Huettner 1999, section 3.4; the queue is ours):
//!
//! ```text
//! Start: swap := beat.swap; queue := []; left := LD; start := right := RD; edge stays
//! Init:  left := start;     start := right := RD
//! Fan:   right := left;     left := edge, or LD at any other command
//! Step:  L' := left | LD | pop(queue) | edge        R' := right | RD (Store: and push; Edge: and edge := RD)
//!        triangles (left, right, L') if L moved, (right, R', L') if R moved; then left := L', right := R'
//! ```
//!
//! All reads of a beat see the registers and the queue before it: `Edge` on both sides gives the left one the old edge
//! vertex. A triangle with two equal vertices is dropped; vertices are told apart by the number of their sending, which
//! moves along with each copy, not by their data.
//!
//! | port    | format                              | range |
//! |---------|-------------------------------------|-------|
//! | beat    | [`Step`]                            | whole |
//! | output  | [`StripOutput`], one a beat         | whole |
//!
//! Example: `Start` (a, b), `Step` left `Set` c, `Step` right `Set` d closes (a, b, c) and (b, d, c).
//!
//! Error: 0; the unit copies.

use crate::step::{Kind, LeftCommand, MAX_COMPONENTS, RightCommand, Step, Vertex};
use std::collections::VecDeque;

/// A vertex with the number of its sending; 0 is the reset value of the registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Held {
    vertex: Vertex,
    index: u64,
}

/// What a beat does to the strip unit's output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StripOutput {
    /// L, the left vertex before the beat.
    pub left: Vertex,
    /// R, the right vertex before the beat.
    pub right: Vertex,
    /// L', the left vertex after the beat.
    pub next_left: Vertex,
    /// R', the right vertex after the beat.
    pub next_right: Vertex,
    /// The beat closes the triangle (L, R, L').
    pub first_valid: bool,
    /// The beat closes the triangle (R, R', L').
    pub second_valid: bool,
    /// Triangles (a, b, c) are to be read as (a, c, b).
    pub swap: bool,
    /// The last beat of its base triangle.
    pub last: bool,
}

impl StripOutput {
    /// The triangles in the base triangle's winding order, none to two.
    pub fn triangles(&self) -> impl Iterator<Item = [Vertex; 3]> + use<> {
        let first = self.first_valid.then_some([self.left, self.right, self.next_left]);
        let second = self.second_valid.then_some([self.right, self.next_right, self.next_left]);
        let swap = self.swap;
        [first, second].into_iter().flatten().map(move |[a, b, c]| if swap { [a, c, b] } else { [a, b, c] })
    }
}

/// Golden model of the strip unit.
#[derive(Clone, Debug)]
pub struct StripUnit {
    left: Held,
    right: Held,
    start: Held,
    edge: Held,
    queue: VecDeque<Held>,
    depth: usize,
    swap: bool,
    sent: u64,
    error: bool,
}

impl StripUnit {
    /// A unit after reset, with a column memory of `column_depth` vertices.
    pub fn new(column_depth: usize) -> Self {
        let reset = Held { vertex: [0; MAX_COMPONENTS], index: 0 };
        Self {
            left: reset,
            right: reset,
            start: reset,
            edge: reset,
            queue: VecDeque::with_capacity(column_depth),
            depth: column_depth,
            swap: false,
            sent: 0,
            error: false,
        }
    }

    /// Sticky: a beat has recalled from an empty column memory, or stored into a full one.
    ///
    /// The recall leaves the left vertex and closes no first triangle; the store leaves the memory, and the right vertex
    /// moves all the same. Both look at the memory before the beat.
    pub const fn error(&self) -> bool {
        self.error
    }

    /// Vertices in the column memory.
    pub fn stored(&self) -> usize {
        self.queue.len()
    }

    /// Takes one beat.
    pub fn accept(&mut self, step: &Step) -> StripOutput {
        let mut send = |vertex: Vertex, sends: bool| {
            self.sent += u64::from(sends);
            Held { vertex, index: self.sent }
        };
        // The numbers of a beat's vertices: left first.
        let fan_sends = step.kind == Kind::Fan && step.left != LeftCommand::Edge;
        let sent_left = send(step.left_vertex, step.sends_left() || step.kind == Kind::Start || fan_sends);
        let sent_right = send(step.right_vertex, step.sends_right() || matches!(step.kind, Kind::Start | Kind::Init));
        let (left, right) = (self.left, self.right);
        let (mut left_moved, mut right_moved) = (false, false);
        match step.kind {
            Kind::Start => {
                self.swap = step.swap;
                self.queue.clear();
                (self.left, self.right, self.start) = (sent_left, sent_right, sent_right);
            }
            Kind::Init => (self.left, self.right, self.start) = (self.start, sent_right, sent_right),
            Kind::Fan => {
                self.right = self.left;
                self.left = if step.left == LeftCommand::Edge { self.edge } else { sent_left };
            }
            Kind::Step => {
                let full = self.queue.len() >= self.depth;
                left_moved = step.left != LeftCommand::Ref;
                right_moved = step.right != RightCommand::Ref;
                match step.left {
                    LeftCommand::Ref => {}
                    LeftCommand::Set => self.left = sent_left,
                    LeftCommand::Edge => self.left = self.edge,
                    LeftCommand::Recall => match self.queue.pop_front() {
                        Some(vertex) => self.left = vertex,
                        None => (left_moved, self.error) = (false, true),
                    },
                }
                match step.right {
                    RightCommand::Ref => {}
                    RightCommand::Set => self.right = sent_right,
                    RightCommand::Store => {
                        self.right = sent_right;
                        if full { self.error = true } else { self.queue.push_back(sent_right) }
                    }
                    RightCommand::Edge => (self.right, self.edge) = (sent_right, sent_right),
                }
            }
        }
        let whole = |a: Held, b: Held, c: Held| a.index != b.index && b.index != c.index && c.index != a.index;
        StripOutput {
            left: left.vertex,
            right: right.vertex,
            next_left: self.left.vertex,
            next_right: self.right.vertex,
            first_valid: left_moved && whole(left, right, self.left),
            second_valid: right_moved && whole(right, self.right, self.left),
            swap: self.swap,
            last: step.last,
        }
    }
}

/// Decodes `steps` with a column memory of `column_depth` vertices into triangles in winding order.
pub fn golden<'a>(column_depth: usize, steps: impl IntoIterator<Item = &'a Step>) -> impl Iterator<Item = [Vertex; 3]> {
    let mut unit = StripUnit::new(column_depth);
    steps.into_iter().flat_map(move |step| unit.accept(step).triangles())
}

/// Exact reference: the triangles of `steps` as numbers of vertices sent, counted from 0, a beat's left one first.
///
/// Written from the definition of a strip rather than from the registers: every rung is kept, nothing is overwritten,
/// and the column memory has no bound. `steps` must be what a remesher sends; a recall that nothing was stored for, or
/// an edge vertex that was never sent, gives `None`.
pub fn exact(steps: &[Step]) -> Option<Vec<[usize; 3]>> {
    let mut triangles = Vec::new();
    let mut sent = 0;
    let mut number = |sends: bool| {
        sent += usize::from(sends);
        sent.wrapping_sub(1)
    };
    let mut swap = false;
    // Rungs (left, right) of all strips, the right ends of first rungs, all edge vertices, the stored and how many of
    // them have been recalled.
    let mut rungs: Vec<(usize, usize)> = Vec::new();
    let (mut starts, mut edges, mut stored, mut recalled) = (Vec::new(), Vec::new(), Vec::new(), 0);
    for step in steps {
        let old_edge = edges.last().copied();
        let sent_left = number(step.sends_left());
        let sent_right = number(step.sends_right());
        match step.kind {
            Kind::Start => {
                swap = step.swap;
                recalled = stored.len();
                starts.push(sent_right);
                rungs.push((sent_left, sent_right));
            }
            Kind::Init => {
                rungs.push((*starts.last()?, sent_right));
                starts.push(sent_right);
            }
            Kind::Fan => {
                let left = if step.sends_left() { sent_left } else { old_edge? };
                rungs.push((left, rungs.last()?.0));
            }
            Kind::Step => {
                let &(left, right) = rungs.last()?;
                let next_left = match step.left {
                    LeftCommand::Ref => left,
                    LeftCommand::Set => sent_left,
                    LeftCommand::Edge => old_edge?,
                    LeftCommand::Recall => {
                        recalled += 1;
                        *stored.get(recalled - 1)?
                    }
                };
                let next_right = if step.sends_right() { sent_right } else { right };
                match step.right {
                    RightCommand::Store => stored.push(sent_right),
                    RightCommand::Edge => edges.push(sent_right),
                    RightCommand::Ref | RightCommand::Set => {}
                }
                rungs.push((next_left, next_right));
                let moved = [
                    (next_left != left, [left, right, next_left]),
                    (next_right != right, [right, next_right, next_left]),
                ];
                for (_, [a, b, c]) in
                    moved.into_iter().filter(|(moved, [a, b, c])| *moved && a != b && b != c && c != a)
                {
                    triangles.push(if swap { [a, c, b] } else { [a, b, c] });
                }
            }
        }
    }
    Some(triangles)
}
