// SPDX-License-Identifier: MIT OR Apache-2.0
//! The distance of a point from a surface, by the bounding-volume hierarchy of `parry3d-f64`.
//!
//! A leaf is a triangle of a mesh, or a square of cells of a map: a map of 4,097 samples a side has 33 million triangles,
//! but only a million leaves.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::Triangle;

use super::side::Side;

/// Cells along a side of a leaf.
const BLOCK: usize = 4;

pub(super) struct Nearest<'a> {
    side: Side<'a>,
    tree: Bvh,
}

impl<'a> Nearest<'a> {
    pub(super) fn new(side: Side<'a>) -> Nearest<'a> {
        let boxes: Vec<Aabb> = match side {
            Side::Mesh(mesh) => mesh.triangles.iter().map(|triangle| bounds(mesh.corners(*triangle))).collect(),
            Side::Map(map) => {
                let [columns, rows] = [map.width - 1, map.height - 1].map(|cells| cells.div_ceil(BLOCK));
                let block = |at: usize| {
                    let (i, j) = (at % columns * BLOCK, at / columns * BLOCK);
                    let (right, below) = ((i + BLOCK).min(map.width - 1), (j + BLOCK).min(map.height - 1));
                    let rows = (j..=below).flat_map(|row| &map.samples[row * map.width..][i..=right]);
                    let (low, high) = rows.fold((u16::MAX, 0), |(low, high), z| (low.min(*z), high.max(*z)));
                    bounds([[i as f64, j as f64, low.into()], [right as f64, below as f64, high.into()]])
                };
                (0..columns * rows).map(block).collect()
            }
        };
        Nearest { side, tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes) }
    }

    /// The distance of `point` from the nearest point of the surface.
    pub(super) fn distance(&self, point: [f64; 3]) -> f64 {
        let point = Vector::from(point);
        let to_box = |low: Vector, high: Vector| point.distance_squared(point.clamp(low, high));
        let found = self.tree.find_best(
            f64::MAX,
            |node, _| to_box(node.mins(), node.maxs()),
            |leaf, best| Some(self.leaf(leaf as usize, point, best)),
        );
        found.map_or(f64::INFINITY, |(_, square)| square.sqrt())
    }

    /// The squared distance of `point` from a leaf; more than `best` may be anything more.
    fn leaf(&self, leaf: usize, point: Vector, best: f64) -> f64 {
        match self.side {
            Side::Mesh(_) => squared(self.side.corners(leaf), point),
            Side::Map(map) => {
                let (columns, blocks) = (map.width - 1, (map.width - 1).div_ceil(BLOCK));
                let (left, top) = (leaf % blocks * BLOCK, leaf / blocks * BLOCK);
                let mut best = best;
                for j in top..(top + BLOCK).min(map.height - 1) {
                    for i in left..(left + BLOCK).min(columns) {
                        let z =
                            [map.sample(i, j), map.sample(i + 1, j), map.sample(i, j + 1), map.sample(i + 1, j + 1)];
                        let (low, high) = z.iter().fold((u16::MAX, 0), |(low, high), z| (low.min(*z), high.max(*z)));
                        let (x, y) = (i as f64, j as f64);
                        let near =
                            point.clamp(Vector::new(x, y, low.into()), Vector::new(x + 1.0, y + 1.0, high.into()));
                        if point.distance_squared(near) >= best {
                            continue;
                        }
                        let first = 2 * (j * columns + i);
                        for triangle in [first, first + 1] {
                            best = best.min(squared(self.side.corners(triangle), point));
                        }
                    }
                }
                best
            }
        }
    }
}

fn bounds<const N: usize>(points: [[f64; 3]; N]) -> Aabb {
    Aabb::from_points(points.map(Vector::from))
}

fn squared(corners: [[f64; 3]; 3], point: Vector) -> f64 {
    let [a, b, c] = corners.map(Vector::from);
    point.distance_squared(Triangle::new(a, b, c).project_local_point(point, true).point)
}
