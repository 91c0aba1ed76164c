// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bisector's golden model: against the recursion that defines it, and what holds of every tessellation.

use glam::DVec2;
use proptest::prelude::*;
use relief_models::bisector::{
    Bound, Counts, Errors, Lattice, Node, SplitMap, Steering, Triangle, WALKERS, exact, golden,
};
use std::collections::{HashMap, HashSet};

fn tessellate<S: Steering>(lattice: &Lattice, steering: &S) -> (Vec<Triangle>, Counts) {
    let mut triangles = Vec::new();
    let counts = golden(lattice, steering, &mut |triangle| triangles.push(*triangle));
    (triangles, counts)
}

/// Sets a share of the vertices, and what they need.
fn random_split(lattice: &Lattice, percent: u32, seed: u64) -> SplitMap {
    let mut split = SplitMap::new(lattice);
    let mut state = seed | 1;
    for v in 0..=lattice.side() {
        for u in 0..=lattice.side() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            if (state >> 33) % 100 < u64::from(percent) {
                split.insert(lattice, [u, v]);
            }
        }
    }
    split
}

fn double_area([a, b, c]: [[u32; 2]; 3]) -> i64 {
    let [a, b, c] = [a, b, c].map(|at| at.map(i64::from));
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Areas, edges and strips.
fn check(lattice: &Lattice, triangles: &[Triangle], counts: &Counts) {
    let name = format!("{lattice:?}");
    let mut edges: HashMap<[[u32; 2]; 2], i32> = HashMap::new();
    let (mut area, mut held) = (0, [None; WALKERS]);
    for triangle in triangles {
        let [left, right, new] = triangle.corners;
        let own = double_area(triangle.corners);
        assert!(own > 0, "{name}: {triangle:?} turns the wrong way");
        area += own;
        for [from, to] in [[left, right], [right, new], [new, left]] {
            *edges.entry([from, to]).or_default() += 1;
            *edges.entry([to, from]).or_default() -= 1;
        }
        let rung = &mut held[usize::from(triangle.walker)];
        assert!(triangle.start || *rung == Some([left, right]), "{name}: {triangle:?} does not follow {rung:?}");
        *rung = Some(match triangle.side {
            relief_models::bisector::Side::Left => [new, right],
            relief_models::bisector::Side::Right => [left, new],
        });
    }
    let [width, height] = [lattice.width, lattice.height];
    assert_eq!(area, 2 * i64::from(width - 1) * i64::from(height - 1), "{name}");
    // Only the rim is open, and every piece of it once.
    for ([from, to], count) in edges {
        assert!(count.abs() <= 1, "{name}");
        let rim =
            (0..2).any(|axis| from[axis] == to[axis] && (from[axis] == 0 || from[axis] == [width, height][axis] - 1));
        assert!(count == 0 || rim, "{name}: {from:?} to {to:?} is open");
    }
    assert_eq!(counts.triangles, triangles.len() as u64);
    assert!(counts.deepest <= 2 * lattice.levels as usize + 1, "{name}: {counts:?}");
    assert!(counts.strips >= 1);
}

fn set_of(corners: impl Iterator<Item = [[u32; 2]; 3]>) -> HashSet<Vec<[u32; 2]>> {
    let sorted = corners.map(|mut corners| {
        corners.sort_unstable();
        corners.to_vec()
    });
    sorted.collect()
}

#[test]
fn bisector_lattice_finds_the_triangles_of_a_midpoint() {
    for (levels, mirrored) in (0..=5).flat_map(|levels| [(levels, false), (levels, true)]) {
        let side = (1 << levels) + 1;
        let lattice = Lattice::of(side, side, mirrored).unwrap();
        assert_eq!(lattice.levels, levels);
        let mut at: HashMap<[u32; 2], HashSet<Node>> = HashMap::new();
        let mut waiting = lattice.roots().to_vec();
        while let Some(node) = waiting.pop() {
            let Some(midpoint) = node.midpoint() else { continue };
            let [a, b, c] = node.corners();
            assert_eq!([0, 1].map(|axis| (a[axis] + b[axis]) / 2), midpoint);
            let halves = node.halves();
            assert_eq!(halves[0].corners(), [c, a, midpoint]);
            assert_eq!(halves[1].corners(), [b, c, midpoint]);
            at.entry(midpoint).or_default().insert(node);
            waiting.extend(halves);
        }
        for vertex in (0..side).flat_map(|v| (0..side).map(move |u| [u, v])) {
            let found: HashSet<Node> = lattice.nodes_at(vertex).collect();
            assert_eq!(found, at.remove(&vertex).unwrap_or_default(), "{lattice:?} {vertex:?}");
        }
    }
}

#[test]
fn bisector_covers_every_small_map_at_every_density() {
    for (width, height) in (2..=18).flat_map(|width| (2..=18).map(move |height| (width, height))) {
        for (percent, mirrored) in [(0, false), (0, true), (7, false), (7, true), (40, false), (100, true)] {
            let lattice = Lattice::of(width, height, mirrored).unwrap();
            let split = random_split(&lattice, percent, u64::from(width * 100 + height));
            let (triangles, counts) = tessellate(&lattice, &split);
            check(&lattice, &triangles, &counts);
            if percent == 100 {
                assert_eq!(counts.triangles, u64::from(2 * (width - 1) * (height - 1)));
            }
        }
    }
}

#[test]
fn bisector_covers_long_and_large_maps() {
    for (width, height) in [(3, 4097), (4097, 2), (1201, 331), (513, 512)] {
        let lattice = Lattice::of(width, height, false).unwrap();
        let split = random_split(&lattice, if width * height > 100_000 { 1 } else { 20 }, 7);
        let (triangles, counts) = tessellate(&lattice, &split);
        check(&lattice, &triangles, &counts);
    }
}

#[test]
fn bisector_takes_two_turns_a_triangle_at_most_on_a_full_square() {
    let lattice = Lattice::of(257, 257, false).unwrap();
    let (triangles, counts) = tessellate(&lattice, &random_split(&lattice, 10, 3));
    // A walker without work lets pass a turn or two until it has some again.
    assert!(counts.turns <= 2 * triangles.len() as u64 + 4 * counts.thefts + 64, "{counts:?}");
    assert!(counts.thefts >= 6 && counts.thefts < counts.triangles / 100, "{counts:?}");
    assert_eq!(counts.visits, 2 * counts.triangles - 2);
}

/// Everything lies below one root, in one place or on one line: without thefts one walker would take eight turns a visit.
#[test]
fn bisector_shares_lopsided_maps() {
    let lattice = Lattice::of(257, 257, false).unwrap();
    let corner = |at: u32| [at % 40, at % 40 + 1 + (at / 40) % 30];
    let line = |at: u32| [at % 256, at % 256 + 1];
    let spot = |at: u32| [60 + at % 30, 180 + (at / 30) % 30];
    for (name, place) in [("corner", &corner as &dyn Fn(u32) -> [u32; 2]), ("line", &line), ("spot", &spot)] {
        let mut split = SplitMap::new(&lattice);
        (0..1_200).for_each(|at| split.insert(&lattice, place(at)));
        let (triangles, counts) = tessellate(&lattice, &split);
        check(&lattice, &triangles, &counts);
        let rate = counts.turns as f64 / counts.triangles as f64;
        assert!(rate < 2.1, "{name}: {rate} turns a triangle, {counts:?}");
        for walker in 0..WALKERS {
            let share = triangles.iter().filter(|triangle| usize::from(triangle.walker) == walker).count();
            assert!(
                share * 2 * WALKERS > triangles.len(),
                "{name}: walker {walker} has {share} of {}",
                triangles.len()
            );
        }
    }
}

#[test]
fn bisector_refuses_maps_that_are_none() {
    for (width, height) in [(0, 5), (1, 5), (5, 1), (4098, 5), (5, 4098), (u32::MAX, u32::MAX)] {
        assert_eq!(Lattice::of(width, height, false), None);
    }
}

/// Random errors, saturated: a vertex has at least the errors of those that need it.
fn saturated(lattice: &Lattice, seed: u64) -> Vec<u16> {
    let mut errors = vec![0u16; lattice.vertices()];
    let mut state = seed | 1;
    let mut order: Vec<[u32; 2]> =
        (0..=lattice.side()).flat_map(|v| (0..=lattice.side()).map(move |u| [u, v])).collect();
    // Those below first: nodes of a lower level, and of one level those with level or plumb hypotenuse.
    order.sort_by_key(|&vertex| lattice.nodes_at(vertex).next().map(|node| (node.level, !node.reversed())));
    for vertex in order {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mut error = ((state >> 40) % 1000) as u16;
        for node in lattice.nodes_at(vertex) {
            for half in node.halves().into_iter().filter_map(Node::midpoint) {
                error = error.max(errors[lattice.index(half)]);
            }
        }
        errors[lattice.index(vertex)] = error;
    }
    errors
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn bisector_golden_is_the_exact_set(width in 2u32..70, height in 2u32..70, percent in 0u32..30, mirrored: bool, seed: u64) {
        let lattice = Lattice::of(width, height, mirrored).unwrap();
        let split = random_split(&lattice, percent, seed);
        let (triangles, counts) = tessellate(&lattice, &split);
        check(&lattice, &triangles, &counts);
        let whole = |at: DVec2| [at.x as u32, at.y as u32];
        let reference = exact(&lattice, &|m, _| split.get(lattice.index(whole(m))));
        prop_assert_eq!(reference.len(), triangles.len());
        let reference = set_of(reference.into_iter().map(|corners| corners.map(whole)));
        prop_assert_eq!(set_of(triangles.iter().map(|triangle| triangle.corners)), reference);
    }

    #[test]
    fn bisector_bounds_nest_and_keep_the_mesh_closed(
        width in 2u32..40, height in 2u32..40, seed: u64, base in 0u16..900, slope in 0u16..4000, eye in [0u16..80, 0u16..80],
    ) {
        let lattice = Lattice::of(width, height, false).unwrap();
        let errors = saturated(&lattice, seed);
        let coarse = Errors { errors: &errors, bound: Bound { base, slope, eye } };
        let (triangles, counts) = tessellate(&lattice, &coarse);
        check(&lattice, &triangles, &counts);
        let vertices = |triangles: &[Triangle]| -> HashSet<[u32; 2]> {
            triangles.iter().flat_map(|triangle| triangle.corners).collect()
        };
        let few = vertices(&triangles);
        for bound in [Bound { base: base / 2, slope, eye }, Bound { base, slope: slope / 2, eye }, Bound::constant(0)] {
            let (finer, _) = tessellate(&lattice, &Errors { errors: &errors, bound });
            prop_assert!(vertices(&finer).is_superset(&few));
        }
        // No bound below a triangle is under its own.
        let mut waiting = lattice.roots().to_vec();
        while let Some(node) = waiting.pop() {
            if node.midpoint().is_none() { continue }
            for half in node.halves() {
                prop_assert!(coarse.bound.at(&lattice, half) >= coarse.bound.at(&lattice, node));
                waiting.push(half);
            }
        }
    }
}
