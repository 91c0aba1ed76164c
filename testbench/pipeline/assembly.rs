// SPDX-License-Identifier: MIT OR Apache-2.0
//! Base triangles of a draw: vertices are transformed in the order of their first use, each once, triangles are judged,
//! and those across a constant plane are cut, and the vertices of what is left are projected.

use super::{BLOCKS, CLIP, CULL, Pipeline, PipelineError, TRANSFORM};
use crate::binding::Beat;
use crate::clip;
use crate::cull::corners_beat;
use crate::scoreboard::PATIENCE;
use crate::vertex_transform::{constants, transformed, vertex};
use relief_models::cull::{Corner, Reason};
use relief_models::draw::{Assembled, Draw, DropReason};
use relief_models::vertex_transform::{Source, Transformed, ViewVertex};
use std::collections::VecDeque;

/// Whose vertex the transform sends next.
enum Owner {
    Vertex(usize),
    /// A vertex of what is left of the base triangle.
    Piece(usize),
}

/// A base triangle on its way.
#[derive(Default)]
struct Part {
    assembled: Option<Assembled>,
    /// What the planes have left of it, and the projections of that.
    polygon: Vec<ViewVertex>,
    pieces: Vec<Transformed>,
}

impl Pipeline {
    /// Transforms, culls and cuts the base triangles of a draw.
    ///
    /// # Errors
    /// A block is at fault.
    pub fn assemble(&mut self, draw: &Draw) -> Result<Vec<Assembled>, PipelineError> {
        let mut beats: VecDeque<(Beat, Option<Owner>)> =
            constants(&draw.transform, &draw.volume).into_iter().map(|beat| (beat, None)).collect();
        let mut known: Vec<Option<Transformed>> = vec![None; draw.records.len()];
        let mut asked = vec![false; draw.records.len()];
        for index in draw.triangles.iter().flatten().map(|index| *index as usize) {
            if !std::mem::replace(&mut asked[index], true) {
                beats.push_back((vertex(&Source::Record(draw.records[index])), Some(Owner::Vertex(index))));
            }
        }
        let mut parts: Vec<Part> = draw.triangles.iter().map(|_| Part::default()).collect();
        let (mut owners, mut judged, mut offered, mut open) = (VecDeque::new(), 0, 0, parts.len());
        let (mut corners_to_cut, mut cutting) = (VecDeque::new(), VecDeque::new());
        let mut silent = 0;
        while open > 0 {
            if !self.units[TRANSFORM].offers()
                && let Some((beat, owner)) = beats.pop_front()
            {
                self.units[TRANSFORM].offer(&beat);
                owners.extend(owner);
            }
            if !self.units[CULL].offers()
                && let Some(triangle) = draw.triangles.get(offered)
                && let [Some(a), Some(b), Some(c)] = triangle.map(|index| known[index as usize].as_ref())
            {
                self.units[CULL].offer(&corners_beat([a, b, c].map(Corner::from), draw.cull));
                offered += 1;
            }
            if !self.units[CLIP].offers()
                && let Some(beat) = corners_to_cut.pop_front()
            {
                self.units[CLIP].offer(&beat);
            }
            let units = &mut self.units[TRANSFORM..=CLIP];
            let mut moves = false;
            let mut sent = [None, None, None];
            for (unit, sent) in units.iter_mut().zip(&mut sent) {
                unit.settle();
                moves |= unit.stage.accepts() || unit.stage.sends();
                unit.finish(sent)?;
            }
            let [vertex_words, verdict, piece] = sent;
            if let Some(words) = vertex_words {
                let vertex = transformed(&words);
                match owners.pop_front().ok_or(PipelineError::Sticky(BLOCKS[TRANSFORM]))? {
                    Owner::Vertex(index) => known[index] = Some(vertex),
                    Owner::Piece(index) => {
                        let part = &mut parts[index];
                        part.pieces.push(vertex);
                        if part.pieces.len() == part.polygon.len() {
                            part.assembled = Some(draw.cut_pieces(&part.pieces));
                            open -= 1;
                        }
                    }
                }
            }
            if let Some(words) = verdict {
                let (index, part) = (judged, &mut parts[judged]);
                judged += 1;
                let corners = draw.triangles[index].map(|vertex| known[vertex as usize]);
                let corners = corners.map(|vertex| vertex.unwrap_or_else(|| unreachable!("it was judged")));
                match words[0] {
                    0 => part.assembled = Some(draw.kept(&corners)),
                    1 => part.assembled = Some(Assembled::Culled(Reason::ALL[words[1] as usize])),
                    2 => {
                        corners_to_cut.extend(corners.map(|corner| clip::corner(&draw.transform, &corner.view)));
                        cutting.push_back(index);
                    }
                    _ if words[1] == 1 => part.assembled = Some(Assembled::Dropped(DropReason::Lane)),
                    _ => part.assembled = Some(Assembled::Dropped(DropReason::Grid)),
                }
                open -= usize::from(part.assembled.is_some());
            }
            if let Some(words) = piece {
                let index = *cutting.front().ok_or(PipelineError::Sticky(BLOCKS[CLIP]))?;
                let (view, last) = clip::vertex(&words);
                let part = &mut parts[index];
                part.polygon.extend(view);
                if last {
                    cutting.pop_front();
                    if part.polygon.is_empty() {
                        part.assembled = Some(Assembled::Dropped(DropReason::Near));
                        open -= 1;
                    }
                    // Ahead of the vertices that nobody waits for yet.
                    for view in part.polygon.iter().rev() {
                        beats.push_front((vertex(&Source::View(*view)), Some(Owner::Piece(index))));
                    }
                }
            }
            for unit in [TRANSFORM, CULL, CLIP] {
                self.note(unit)?;
                self.units[unit].edge();
            }
            self.counts.assembly_cycles += 1;
            silent = if moves { 0 } else { silent + 1 };
            if silent > PATIENCE {
                return Err(PipelineError::Hangs(self.counts.assembly_cycles));
            }
        }
        Ok(parts.into_iter().filter_map(|part| part.assembled).collect())
    }
}
