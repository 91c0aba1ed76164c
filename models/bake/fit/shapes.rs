// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where the samples of a triangle lie, and the weights of its corners there: a table for each shape of the lattice.

use crate::bake::surface::each_row;
use crate::bisector::{Lattice, Node};

/// Rows of a table are a multiple of this.
pub(super) const LANES: usize = 4;
/// Triangles of a higher level are sampled at every second, fourth, ... column and row. The exact test sees all samples.
const FINEST: u32 = 5;

/// The samples of a shape but for its corners.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape {
    /// Offsets from the sample at the midpoint.
    pub offsets: Vec<i32>,
    /// Weights of a, b and c.
    pub weights: [Vec<f32>; 3],
    /// Rows, without those that fill the last lanes.
    pub rows: usize,
}

impl Shape {
    fn push(&mut self, offset: i32, weights: [f32; 3]) {
        self.offsets.push(offset);
        for (column, weight) in self.weights.iter_mut().zip(weights) {
            column.push(weight);
        }
    }
    /// Fills the last lanes with rows that weigh nothing.
    fn fill(&mut self) {
        self.rows = self.offsets.len();
        while !self.offsets.len().is_multiple_of(LANES) {
            self.push(0, [0.0; 3]);
        }
    }
    /// The shape of a triangle with these corners, about an origin, at every `stride`-th sample.
    pub fn of(corners: [[u32; 2]; 3], origin: [u32; 2], width: u32, stride: i64) -> Shape {
        let mut shape = Shape::default();
        let offset = |x: i64, y: i64| ((y - i64::from(origin[1])) * i64::from(width) + x - i64::from(origin[0])) as i32;
        let aligned = |at: i64, origin: u32| (at - i64::from(origin)).rem_euclid(stride) == 0;
        each_row(corners, |y, first, last, mut weights, steps| {
            let area = weights.iter().sum::<i64>();
            for x in first..=last {
                if !weights.contains(&area) && aligned(x, origin[0]) && aligned(y, origin[1]) {
                    shape.push(offset(x, y), weights.map(|weight| weight as f32 / area as f32));
                }
                for (weight, step) in weights.iter_mut().zip(steps) {
                    *weight += step;
                }
            }
        });
        shape.fill();
        shape
    }
}

/// The tables of all shapes.
pub(super) struct Shapes {
    shapes: Vec<Shape>,
}

impl Shapes {
    pub fn new(lattice: &Lattice) -> Shapes {
        let shapes = (0..=FINEST).flat_map(|level| (0..8).map(move |direction| (level, direction)));
        let shape = |(level, direction): (u32, u8)| {
            if level == 0 {
                return Shape::default();
            }
            let origin = 4 << FINEST;
            let node = Node { u: 2 * origin, v: 2 * origin, level, direction };
            Shape::of(node.corners(), [origin, origin], lattice.width, 1)
        };
        Shapes { shapes: shapes.map(shape).collect() }
    }
    /// The table of a triangle without clamped corners, and what its offsets are multiplied by.
    #[inline]
    pub fn at(&self, node: Node) -> (&Shape, i32) {
        let level = node.level.min(FINEST);
        (&self.shapes[(level * 8 + u32::from(node.direction)) as usize], 1 << (node.level - level))
    }
    /// The stride for a clamped triangle.
    pub fn stride(node: Node) -> i64 {
        1 << node.level.saturating_sub(FINEST)
    }
}
