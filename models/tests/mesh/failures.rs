// SPDX-License-Identifier: MIT OR Apache-2.0
//! One broken tiling for each kind of failure, and random ones.

use proptest::prelude::*;
use relief_models::mesh::{CheckOptions, Tolerance};

use crate::tilings::{SQUARE, TETRAHEDRON, THREE_ON_AN_EDGE, Tiling, failures, tiling};

/// The square in 2 * 16 triangles of side 2 units; small enough to know every triangle.
fn square() -> Tiling {
    Tiling::regular(4, &SQUARE, 4)
}

/// The triangle of a tiling with these corners, in whole units, in whatever order they begin.
fn find(tiling: &Tiling, corners: [[i64; 2]; 3]) -> usize {
    let wanted = corners.map(|[x, y]| [x * tiling.scale, y * tiling.scale, 0]);
    tiling.triangles.iter().position(|(_, own)| wanted.iter().all(|corner| own.contains(corner))).unwrap()
}

#[test]
fn mesh_accepts_good_tilings() {
    for (bases, shared) in [(&SQUARE[..], 1), (&TETRAHEDRON[..], 6), (&THREE_ON_AN_EDGE[..], 2)] {
        for n in [1, 2, 3, 8] {
            let report = Tiling::regular(24, bases, n).check();
            assert!(report.ok, "{report}");
            assert_eq!(report.shared_base_edges, shared);
            assert_eq!(report.triangles, bases.len() as u64 * (n * n) as u64);
        }
    }
    assert_eq!(square().check().to_string(), "2 base triangles, 32 triangles, 1 shared base edge: OK\n");
    assert_eq!(square().check().boundary_edges, 16);
    assert_eq!(square().check().boundary_loops, 1);
}

#[test]
fn mesh_counts_the_rim_if_closedness_is_asked_for() {
    let closed = CheckOptions { closed: true, ..CheckOptions::default() };
    assert!(Tiling::regular(4, &TETRAHEDRON, 4).check_with(&closed).ok);
    assert_eq!(failures(&square().check_with(&closed)), [("open_edges", 16)]);
}

#[test]
fn mesh_notices_a_missing_triangle() {
    // In the middle of a base triangle: a hole.
    let mut inner = square();
    inner.triangles.remove(find(&inner, [[2, 2], [4, 2], [2, 4]]));
    let expected = [("open_edges", 3), ("broken_loops", 1), ("wrong_areas", 1), ("wrong_eulers", 1)];
    assert_eq!(failures(&inner.check()), expected);
    // On the rim: the loop runs round its third corner.
    let mut rim = square();
    rim.triangles.remove(find(&rim, [[2, 0], [4, 0], [2, 2]]));
    assert_eq!(failures(&rim.check()), [("open_edges", 2), ("off_edge_vertices", 1), ("wrong_areas", 1)]);
    // On the shared edge: the neighbour's side is open as well.
    let mut seam = square();
    seam.triangles.remove(find(&seam, [[4, 4], [6, 2], [4, 2]]));
    assert_eq!(failures(&seam.check()), [("open_edges", 3), ("off_edge_vertices", 1), ("wrong_areas", 1)]);
    // All of a base triangle: whatever the neighbour has on the shared edge is open.
    let mut half = square();
    half.triangles.retain(|(base, _)| *base == 0);
    assert_eq!(failures(&half.check()), [("open_edges", 4), ("uncovered_bases", 1)]);
}

#[test]
fn mesh_notices_a_flipped_triangle() {
    let mut inner = square();
    let index = find(&inner, [[2, 2], [4, 2], [2, 4]]);
    inner.triangles[index].1.reverse();
    let expected = [("misoriented_edges", 3), ("flipped_triangles", 1), ("wrong_areas", 1)];
    assert_eq!(failures(&inner.check()), expected);
    // The rim knows its direction from the base triangle.
    let mut rim = square();
    let index = find(&rim, [[2, 0], [4, 0], [2, 2]]);
    rim.triangles[index].1.reverse();
    let expected = [("misoriented_edges", 2), ("flipped_triangles", 1), ("broken_loops", 1), ("wrong_areas", 1)];
    assert_eq!(failures(&rim.check()), expected);
}

#[test]
fn mesh_notices_a_moved_vertex() {
    // One triangle's copy of an inner vertex: a sliver opens between it and its neighbours.
    let mut inner = square();
    let index = find(&inner, [[2, 2], [4, 2], [2, 4]]);
    inner.triangles[index].1[0][0] += 1;
    let report = inner.check();
    assert_eq!(report.count(relief_models::mesh::FailureKind::OpenEdges), 4, "{report}");
    // All copies of a shared vertex in one base triangle, along the edge: both are tilings, and do not fit. Each has its
    // vertex inside an edge of the other.
    let mut seam = square();
    for (base, corners) in &mut seam.triangles {
        for corner in corners.iter_mut().filter(|corner| *base == 0 && **corner == [16, 16, 0]) {
            *corner = [17, 15, 0];
        }
    }
    assert_eq!(failures(&seam.check()), [("open_edges", 4), ("t_vertices", 2), ("seam_mismatches", 1)]);
    // All copies of an inner vertex, so that it still is a tiling, but of something that leaves the plane.
    let mut plane = square();
    for corner in plane.triangles.iter_mut().flat_map(|(_, corners)| corners).filter(|corner| **corner == [8, 8, 0]) {
        corner[2] += 1;
    }
    assert_eq!(failures(&plane.check()), [("off_plane_corners", 6)]);
    let loose = CheckOptions { tolerance: "0.25".parse().unwrap(), ..CheckOptions::default() };
    assert_eq!(failures(&plane.check_with(&loose)), []);
    let tight = CheckOptions { tolerance: "2499/10000".parse().unwrap(), ..CheckOptions::default() };
    assert_eq!(failures(&plane.check_with(&tight)), [("off_plane_corners", 6)]);
    // All copies of a corner in a base triangle: its loop misses the corner.
    let mut corner = square();
    for point in corner.triangles.iter_mut().flat_map(|(_, corners)| corners).filter(|point| **point == [0, 0, 0]) {
        *point = [1, 1, 0];
    }
    let report = corner.check();
    assert_eq!(report.count(relief_models::mesh::FailureKind::BrokenLoops), 1, "{report}");
}

#[test]
fn mesh_notices_a_t_vertex() {
    let mut inner = square();
    let index = find(&inner, [[2, 2], [4, 2], [2, 4]]);
    inner.split_side(index, 0);
    let expected = [("open_edges", 3), ("t_vertices", 1), ("broken_loops", 1), ("wrong_eulers", 1)];
    assert_eq!(failures(&inner.check()), expected);
    // On the shared edge both base triangles are tilings, and do not fit.
    let mut seam = square();
    let index = find(&seam, [[4, 4], [6, 2], [4, 2]]);
    let corners = seam.triangles[index].1;
    let side = (0..3).find(|side| {
        corners[*side][0] + corners[*side][1] == 32 && {
            let next = corners[(side + 1) % 3];
            next[0] + next[1] == 32
        }
    });
    seam.split_side(index, side.unwrap());
    assert_eq!(failures(&seam.check()), [("open_edges", 3), ("t_vertices", 1), ("seam_mismatches", 1)]);
    // The same beside an edge that three base triangles share.
    let mut three = Tiling::plain(4, &THREE_ON_AN_EDGE);
    three.split_side(2, 0);
    let report = three.check();
    assert_eq!(report.count(relief_models::mesh::FailureKind::TVertices), 1, "{report}");
}

#[test]
fn mesh_notices_a_duplicate_triangle() {
    let mut inner = square();
    inner.triangles.push(inner.triangles[find(&inner, [[2, 2], [4, 2], [2, 4]])]);
    let expected = [("nonmanifold_edges", 3), ("duplicate_triangles", 1), ("wrong_areas", 1), ("wrong_eulers", 1)];
    assert_eq!(failures(&inner.check()), expected);
}

#[test]
fn mesh_notices_a_degenerate_triangle() {
    // A needle in a slit: the slit's long side is split on one side only, and a triangle without area fills it.
    let mut needle = square();
    let index = find(&needle, [[2, 2], [4, 2], [2, 4]]);
    let corners = needle.triangles[index].1;
    needle.split_side(index, 0);
    let middle = needle.triangles[index].1[1];
    needle.triangles.push((0, [corners[1], middle, corners[0]]));
    assert_eq!(failures(&needle.check()), [("degenerate_triangles", 1)]);
    // A triangle with a vertex twice.
    let mut repeated = square();
    let (base, corners) = repeated.triangles[index];
    repeated.triangles.push((base, [corners[0], corners[0], corners[1]]));
    let found = failures(&repeated.check());
    assert!(found.contains(&("degenerate_triangles", 1)), "{found:?}");
}

#[test]
fn mesh_notices_a_rim_that_runs_back() {
    // The rim goes to 5, back to 3 and on, along its own edge all the time.
    let mut tiling = Tiling::plain(1, &SQUARE[..1]);
    let [a, b, c] = [[0, 0, 0], [8, 0, 0], [0, 8, 0]];
    tiling.triangles = vec![(0, [a, [5, 0, 0], c]), (0, [[5, 0, 0], [3, 0, 0], c]), (0, [[3, 0, 0], b, c])];
    assert_eq!(
        failures(&tiling.check()),
        [("open_edges", 1), ("t_vertices", 2), ("flipped_triangles", 1), ("off_edge_vertices", 1)]
    );
}

#[test]
fn mesh_leaves_base_triangles_without_area_to_the_whole() {
    // A base triangle whose third corner lies on the shared diagonal, split there; its other two edges are the seam.
    let sliver = [[8, 0, 0], [0, 8, 0], [4, 4, 0]];
    let far = [[[8, 0, 0], [8, 8, 0], [4, 4, 0]], [[8, 8, 0], [0, 8, 0], [4, 4, 0]]];
    let bases = [SQUARE[0], [sliver[1], sliver[0], sliver[2]], far[0], far[1]];
    // The near side has one segment on the diagonal, the far side two: the sliver's triangle stitches them.
    let stitched = Tiling::plain(2, &bases);
    let report = stitched.check();
    assert!(report.ok, "{report}");
    assert_eq!(report.zero_area_base_triangles, 1);
    // Without it there is a slit, and a vertex in its middle.
    let mut slit = stitched.clone();
    slit.triangles.retain(|(base, _)| *base != 1);
    assert_eq!(failures(&slit.check()), [("open_edges", 3), ("t_vertices", 1)]);
    // The sliver at the rim may be there or not.
    for count in [2, 1] {
        let mut rim = Tiling::plain(2, &bases[..2]);
        rim.triangles.truncate(count);
        let report = rim.check();
        assert!(report.ok, "{report}");
    }
    // A base triangle in a point has nothing to be tiled with.
    let mut bases = SQUARE.to_vec();
    bases.push([[8, 8, 0]; 3]);
    let mut point = Tiling::plain(2, &bases);
    assert!(point.check().ok);
    point.triangles.pop();
    assert!(point.check().ok);
}

#[test]
fn mesh_ignores_what_unrelated_base_triangles_do_to_each_other() {
    // Base triangles that overlap, touch and lie on one another are tiled each by itself.
    let mut bases = SQUARE.to_vec();
    bases.extend([SQUARE[0], [[0, 0, 0], [4, 0, 0], [0, 0, 9]], [[2, 0, 0], [6, 0, 0], [2, 3, 0]]]);
    let report = Tiling::regular(12, &bases, 4).check();
    assert!(report.ok, "{report}");
}

#[test]
fn mesh_describes_three_failures_of_each_kind() {
    let mut tiling = square();
    tiling.triangles.retain(|(base, _)| *base == 0);
    let report = tiling.check();
    assert_eq!(report.failures.len(), 4);
    assert_eq!(
        report.to_string(),
        "FAIL open_edges base 0: (8 24 0)/4 - (0 32 0)/4 is open\n\
         FAIL open_edges base 0: (8 24 0)/4 - (16 16 0)/4 is open\n\
         FAIL open_edges base 0: (16 16 0)/4 - (24 8 0)/4 is open\n\
         FAIL uncovered_bases base 1: (32 0 0)/4 (32 32 0)/4 (0 32 0)/4 has no triangle\n\
         2 base triangles, 16 triangles, 1 shared base edge: BAD open_edges:4 uncovered_bases:1\n"
    );
    let json: serde_json::Value = serde_json::from_str(&serde_json::to_string(&report).unwrap()).unwrap();
    assert_eq!(json["counts"]["open_edges"], 4);
    assert_eq!(json["counts"].as_object().unwrap().len(), 14);
    assert_eq!(json["failures"][3]["kind"], "uncovered_bases");
    assert_eq!(json["failures"][3]["vertices"][0], "(32 0 0)/4");
}

#[test]
fn mesh_tolerance_is_a_fraction() {
    let tolerance = |text: &str| text.parse::<Tolerance>().ok();
    assert_eq!(tolerance("1/64"), Tolerance::new(1, 64));
    assert_eq!(tolerance("0.25"), Tolerance::new(25, 100));
    assert_eq!(tolerance("20"), Tolerance::new(20, 1));
    assert_eq!(tolerance("0"), Tolerance::new(0, 1));
    for wrong in ["", "1/0", "-1", "1/-2", "a", "1e-30", "1/2/3", "NaN"] {
        assert_eq!(tolerance(wrong), None, "{wrong}");
    }
    assert_eq!(Tolerance::new(1, 0), None);
}

/// One thing done to one triangle.
#[derive(Clone, Copy, Debug)]
enum Mutation {
    Drop,
    Flip,
    Move { corner: usize, axis: usize, by: i64 },
    TVertex { side: usize },
    Duplicate,
}

fn mutation() -> impl Strategy<Value = Mutation> {
    prop_oneof![
        Just(Mutation::Drop),
        Just(Mutation::Flip),
        (0usize..3, 0usize..3, prop::sample::select(vec![-1, 1])).prop_map(|(corner, axis, by)| Mutation::Move {
            corner,
            axis,
            by
        }),
        (0usize..3).prop_map(|side| Mutation::TVertex { side }),
        Just(Mutation::Duplicate),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn mesh_accepts_random_tilings(tiling in tiling()) {
        let report = tiling.check();
        prop_assert!(report.ok, "{}", report);
        // Exactly: no allowance is needed.
        let exact = CheckOptions { tolerance: Tolerance::new(0, 1).unwrap(), closed: false };
        let report = tiling.check_with(&exact);
        prop_assert!(report.ok, "{}", report);
    }

    #[test]
    fn mesh_notices_every_mutation(
        tiling in tiling(),
        index in any::<prop::sample::Index>(),
        mutation in mutation(),
    ) {
        let mut broken = tiling.clone();
        let index = index.index(tiling.triangles.len());
        match mutation {
            Mutation::Drop => { broken.triangles.remove(index); }
            Mutation::Flip => broken.triangles[index].1.reverse(),
            Mutation::Move { corner, axis, by } => broken.triangles[index].1[corner][axis] += by,
            Mutation::TVertex { side } => {
                // A vertex more on the rim of the base mesh is none the neighbours could object to.
                prop_assume!(tiling.is_shared(index, side));
                broken.split_side(index, side);
            }
            Mutation::Duplicate => broken.triangles.push(broken.triangles[index]),
        }
        let report = broken.check();
        prop_assert!(!report.ok, "{mutation:?} of {:?} passed", tiling.triangles[index]);
        let expected = match mutation {
            Mutation::Drop => &["open_edges", "uncovered_bases"][..],
            Mutation::Flip => &["flipped_triangles"],
            Mutation::Move { .. } => &["open_edges", "broken_loops"],
            Mutation::TVertex { .. } => &["t_vertices"],
            Mutation::Duplicate => &["duplicate_triangles"],
        };
        let found = failures(&report);
        prop_assert!(found.iter().any(|(name, _)| expected.contains(name)), "{mutation:?}: {found:?}");
    }
}
