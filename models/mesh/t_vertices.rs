// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finds vertices that lie strictly inside an open edge.
//!
//! Where a vertex lies inside an edge of a neighbour, the neighbour's edge is open and so are the edges from the vertex
//! along it. So only ends of open edges are candidates, and the cost depends on the seams, not on the mesh. They are
//! searched with a k-d tree of boxes in doubles, widened by more than the rounding; what is found is decided exactly.

use rayon::prelude::*;

use super::points::Points;

/// Vertices of a leaf.
const LEAF: usize = 8;

/// A cache line: the search waits for memory more than it computes.
struct Node {
    low: [f64; 3],
    high: [f64; 3],
    /// The candidates below the node, from one to before the other.
    range: [u32; 2],
    /// The two halves; zeros in a leaf, as the root is nobody's half.
    halves: [u32; 2],
}

struct Tree {
    candidates: Vec<(u32, [f64; 3])>,
    nodes: Vec<Node>,
}

/// Each vertex of `edges` that lies strictly inside one of them, once, with that edge.
pub(super) fn find(points: &Points, edges: &[[u32; 2]]) -> Vec<(u32, [u32; 2])> {
    let mut ends: Vec<u32> = edges.iter().flatten().copied().collect();
    ends.par_sort_unstable();
    ends.dedup();
    let candidates: Vec<_> = ends.into_iter().map(|vertex| (vertex, points.approximate(vertex))).collect();
    let largest = candidates.iter().flat_map(|(_, place)| place).fold(0.0, |most: f64, value| most.max(value.abs()));
    // Coordinates are right to a few 2^-53 of themselves; the products of the slab test stay within a few more.
    let margin = largest * f64::powi(2.0, -44);
    let mut tree = Tree { candidates, nodes: Vec::new() };
    if !tree.candidates.is_empty() {
        // Fewer than 2^32 vertices, so fewer than 2^32 candidates and nodes.
        tree.build(0..tree.candidates.len());
    }
    // Neighbours in the tree are searched one after the other: they need the same nodes.
    let mut place = vec![0u32; points.len()];
    for (index, (vertex, _)) in tree.candidates.iter().enumerate() {
        place[*vertex as usize] = index as u32;
    }
    let mut edges = edges.to_vec();
    edges.par_sort_unstable_by_key(|edge| place[edge[0] as usize]);
    drop(place);
    let mut found: Vec<(u32, [u32; 2])> = edges
        .par_iter()
        .flat_map_iter(|edge| tree.inside(points, *edge, margin).into_iter().map(|vertex| (vertex, *edge)))
        .collect();
    found.par_sort_unstable();
    found.dedup_by_key(|(vertex, _)| *vertex);
    found
}

impl Tree {
    /// Builds the node of a range and those below it; its index. The depth is the logarithm of the number of candidates.
    fn build(&mut self, range: std::ops::Range<usize>) -> u32 {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (_, place) in &self.candidates[range.clone()] {
            for axis in 0..3 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
        }
        let index = self.nodes.len();
        self.nodes.push(Node { low, high, range: [range.start as u32, range.end as u32], halves: [0; 2] });
        if range.len() > LEAF {
            let extent = |axis: &usize| high[*axis] - low[*axis];
            let axis = (0..3).max_by(|a, b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
            let middle = range.len() / 2;
            self.candidates[range.clone()].select_nth_unstable_by(middle, |a, b| a.1[axis].total_cmp(&b.1[axis]));
            let middle = range.start + middle;
            self.nodes[index].halves = [self.build(range.start..middle), self.build(middle..range.end)];
        }
        index as u32
    }

    fn inside(&self, points: &Points, edge: [u32; 2], margin: f64) -> Vec<u32> {
        let (a, b) = (points.approximate(edge[0]), points.approximate(edge[1]));
        let is_near = |place: &[f64; 3]| {
            (0..3).all(|axis| {
                place[axis] >= a[axis].min(b[axis]) - margin && place[axis] <= a[axis].max(b[axis]) + margin
            })
        };
        let (mut found, mut stack) = (Vec::new(), Vec::from([0]));
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !touches(node, a, b, margin) {
                continue;
            }
            if node.halves != [0; 2] {
                stack.extend(node.halves);
                continue;
            }
            let candidates = self.candidates[node.range[0] as usize..node.range[1] as usize].iter();
            let near = candidates.filter(|(_, place)| is_near(place)).map(|(vertex, _)| *vertex);
            found.extend(near.filter(|vertex| points.is_strictly_inside(*vertex, edge)));
        }
        found
    }
}

/// Whether the segment touches the box of the node, or comes within the margin.
fn touches(node: &Node, a: [f64; 3], b: [f64; 3], margin: f64) -> bool {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for axis in 0..3 {
        let (low, high) = (node.low[axis] - margin, node.high[axis] + margin);
        let length = b[axis] - a[axis];
        if length.abs() <= margin {
            // As good as parallel to the slab: an end within it is all that can be asked.
            if a[axis].max(b[axis]) < low || a[axis].min(b[axis]) > high {
                return false;
            }
            continue;
        }
        let (first, second) = ((low - a[axis]) / length, (high - a[axis]) / length);
        enter = enter.max(first.min(second));
        leave = leave.min(first.max(second));
    }
    // A few roundings of the quotients.
    enter <= leave + 1e-9
}
