// SPDX-License-Identifier: MIT OR Apache-2.0
//! The block as its streams see it: a map is loaded sample by sample, then drawn under one bound or many.

use super::{Bound, Errors, Lattice, Triangle, golden};

/// A beat of the input stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// A new map: nothing of the one before stays.
    Size {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// log2 N of the lattice.
        levels: u32,
        /// The roots share the other diagonal.
        mirrored: bool,
    },
    /// The next lattice vertex, row by row. The height counts where the vertex is in the map.
    Sample {
        /// Its error.
        error: u16,
        /// Its height, UQ16.4.
        z: u32,
    },
    /// Tessellates the map.
    Draw(Bound),
}

/// A vertex with its height: u, v, and z in UQ16.4.
pub type Vertex = [u32; 3];

/// A beat of the output stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// A triangle, and its corners with heights.
    Triangle(Triangle, [Vertex; 3]),
    /// The draw is over.
    End,
}

/// Golden model of the block for lattices of up to 2^K steps.
#[derive(Clone, Debug)]
pub struct Bisector {
    most: u32,
    lattice: Option<Lattice>,
    errors: Vec<u16>,
    heights: Vec<u32>,
    error: bool,
}

impl Bisector {
    /// A block after reset; `lattice_bits` is K.
    pub const fn new(lattice_bits: u32) -> Self {
        Self { most: lattice_bits, lattice: None, errors: Vec::new(), heights: Vec::new(), error: false }
    }
    /// Sticky: a size that cannot be, a sample without a size or after the last one, a draw before the last sample.
    pub const fn error(&self) -> bool {
        self.error
    }
    /// Takes a beat; a draw sends its triangles and an end.
    pub fn accept(&mut self, command: &Command, sink: &mut impl FnMut(Output)) {
        match *command {
            Command::Size { width, height, levels, mirrored } => {
                let sound = width >= 2 && height >= 2 && levels <= self.most && width.max(height) - 1 <= 1 << levels;
                self.lattice = sound.then_some(Lattice { width, height, levels, mirrored });
                self.errors.clear();
                self.heights.clear();
                self.error |= !sound;
            }
            Command::Sample { error, z } => match self.lattice {
                Some(lattice) if self.errors.len() < lattice.vertices() => {
                    let (row, column) = (
                        self.errors.len() / (lattice.side() as usize + 1),
                        self.errors.len() % (lattice.side() as usize + 1),
                    );
                    if column < lattice.width as usize && row < lattice.height as usize {
                        self.heights.push(z);
                    }
                    self.errors.push(error);
                }
                _ => self.error = true,
            },
            Command::Draw(bound) => {
                match self.lattice {
                    Some(lattice) if self.errors.len() == lattice.vertices() => {
                        let steering = Errors { errors: &self.errors, bound };
                        let height = |[u, v]: [u32; 2]| self.heights[v as usize * lattice.width as usize + u as usize];
                        golden(&lattice, &steering, &mut |triangle| {
                            let corners = triangle.corners.map(|at| [at[0], at[1], height(at)]);
                            sink(Output::Triangle(*triangle, corners));
                        });
                    }
                    _ => self.error = true,
                }
                sink(Output::End);
            }
        }
    }
}
