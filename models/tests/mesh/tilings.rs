// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tilings to check and to break: regular and random subdivisions of small base meshes.

use proptest::prelude::*;
use relief_models::mesh::{Builder, CheckOptions, FailureKind, Report, check};

/// A lattice point, over [`SCALE`] units.
pub type Point = [i64; 3];
/// Random subdivisions halve edges up to 20 times, two bits at most each time.
pub const SCALE: i64 = 1 << 24;

#[derive(Clone, Debug)]
pub struct Tiling {
    pub scale: i64,
    /// In whole units.
    pub bases: Vec<[Point; 3]>,
    /// Over the scale, with the base triangle.
    pub triangles: Vec<(usize, [Point; 3])>,
}

impl Tiling {
    /// One triangle in each base triangle.
    pub fn plain(scale: i64, bases: &[[Point; 3]]) -> Tiling {
        let lattice = |corners: &[Point; 3]| corners.map(|corner| corner.map(|value| value * scale));
        let triangles = bases.iter().enumerate().map(|(base, corners)| (base, lattice(corners))).collect();
        Tiling { scale, bases: bases.to_vec(), triangles }
    }

    /// Every base triangle in `n * n` similar ones. Lattice points if `n` divides the scale.
    pub fn regular(scale: i64, bases: &[[Point; 3]], n: i64) -> Tiling {
        let mut tiling = Tiling { scale, bases: bases.to_vec(), triangles: Vec::new() };
        for (base, [a, b, c]) in bases.iter().enumerate() {
            let at = |i: i64, j: i64| [0, 1, 2].map(|k| (a[k] * (n - i - j) + b[k] * i + c[k] * j) * scale / n);
            for i in 0..n {
                for j in 0..n - i {
                    tiling.triangles.push((base, [at(i, j), at(i + 1, j), at(i, j + 1)]));
                    if i + j < n - 1 {
                        tiling.triangles.push((base, [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
                    }
                }
            }
        }
        tiling
    }

    /// Splits the edge between two corners of a triangle, in every triangle that has it.
    pub fn split_edge(&mut self, triangle: usize, side: usize) {
        let corners = self.triangles[triangle].1;
        let ends = [corners[side], corners[(side + 1) % 3]];
        for index in 0..self.triangles.len() {
            let own = self.triangles[index].1;
            if let Some(side) = (0..3).find(|side| {
                let edge = [own[*side], own[(side + 1) % 3]];
                edge == ends || edge == [ends[1], ends[0]]
            }) {
                self.split_side(index, side);
            }
        }
    }

    /// Splits one triangle at the middle of a side, and leaves its neighbour alone.
    pub fn split_side(&mut self, index: usize, side: usize) {
        let (base, corners) = self.triangles[index];
        let [a, b, c] = [0, 1, 2].map(|step| corners[(side + step) % 3]);
        let middle = [0, 1, 2].map(|k| (a[k] + b[k]) / 2);
        self.triangles[index] = (base, [a, middle, c]);
        self.triangles.push((base, [middle, b, c]));
    }

    /// Splits one triangle in three at a point inside.
    pub fn split_inside(&mut self, index: usize) {
        let (base, [a, b, c]) = self.triangles[index];
        let inside = [0, 1, 2].map(|k| (a[k] + b[k] + 2 * c[k]) / 4);
        self.triangles[index] = (base, [a, b, inside]);
        self.triangles.push((base, [b, c, inside]));
        self.triangles.push((base, [c, a, inside]));
    }

    /// Whether another triangle has this side, the other way round or not.
    pub fn is_shared(&self, index: usize, side: usize) -> bool {
        let corners = self.triangles[index].1;
        let [a, b] = [corners[side], corners[(side + 1) % 3]];
        let uses = self.triangles.iter().filter(|(_, own)| own.contains(&a) && own.contains(&b)).count();
        uses > 1
    }

    pub fn check(&self) -> Report {
        self.check_with(&CheckOptions::default())
    }

    pub fn check_with(&self, options: &CheckOptions) -> Report {
        let mut builder = Builder::new("tiling", self.scale as u64);
        for (base, corners) in self.bases.iter().enumerate() {
            builder.base(base as u32, *corners).unwrap();
        }
        for (base, corners) in &self.triangles {
            builder.triangle(*base as u32, *corners).unwrap();
        }
        check(&builder.finish().unwrap(), options, &())
    }
}

/// Two base triangles that make a square.
pub const SQUARE: [[Point; 3]; 2] = [[[0, 0, 0], [8, 0, 0], [0, 8, 0]], [[8, 0, 0], [8, 8, 0], [0, 8, 0]]];
/// A closed base mesh.
pub const TETRAHEDRON: [[Point; 3]; 4] = [
    [[0, 0, 0], [0, 9, 1], [7, 0, 2]],
    [[0, 0, 0], [7, 0, 2], [1, 2, 8]],
    [[7, 0, 2], [0, 9, 1], [1, 2, 8]],
    [[0, 9, 1], [0, 0, 0], [1, 2, 8]],
];
/// Three base triangles on one edge, two of them running along it in the same direction.
pub const THREE_ON_AN_EDGE: [[Point; 3]; 3] =
    [[[0, 0, 0], [8, 0, 0], [0, 8, 0]], [[8, 0, 0], [0, 0, 0], [0, -8, 0]], [[0, 0, 0], [8, 0, 0], [0, 0, 8]]];

/// The failures of a report by name, those that there are.
pub fn failures(report: &Report) -> Vec<(&'static str, u64)> {
    FailureKind::ALL.iter().map(|kind| (kind.name(), report.count(*kind))).filter(|(_, count)| *count > 0).collect()
}

/// A random subdivision of one of the base meshes.
pub fn tiling() -> impl Strategy<Value = Tiling> {
    let bases = prop_oneof![
        Just(SQUARE.to_vec()),
        Just(TETRAHEDRON.to_vec()),
        Just(THREE_ON_AN_EDGE.to_vec()),
        // A base triangle with integer corners anywhere, unless they are collinear.
        prop::array::uniform3(prop::array::uniform3(-50i64..50)).prop_map(|corners| vec![corners]),
    ];
    let splits = prop::collection::vec((any::<prop::sample::Index>(), 0usize..4), 0..11);
    (bases, splits).prop_filter_map("collinear corners", |(bases, splits)| {
        if bases.iter().any(|[a, b, c]| {
            let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
            (0..3).all(|k| u[k] * v[(k + 1) % 3] == u[(k + 1) % 3] * v[k])
        }) {
            return None;
        }
        let mut tiling = Tiling::plain(SCALE, &bases);
        for (index, what) in splits {
            let triangle = index.index(tiling.triangles.len());
            match what {
                3 => tiling.split_inside(triangle),
                side => tiling.split_edge(triangle, side),
            }
        }
        Some(tiling)
    })
}
