// SPDX-License-Identifier: MIT OR Apache-2.0
//! Measures of meshes: known errors, brute force in other arithmetic, and what has no measure.

use num_bigint::BigInt;
use proptest::prelude::*;
use relief_models::map::{HeightMap, Procedural};
use relief_models::measure::{Amount, Heights, Sampling, Side, Surface, heights, surface};
use relief_models::mesh::TriangleMesh;
use relief_models::uniform;

fn map(width: usize, height: usize, value: impl Fn(usize, usize) -> u16) -> HeightMap {
    let samples = (0..width * height).map(|at| value(at % width, at / width)).collect();
    HeightMap { width, height, samples }
}

fn measured(mesh: &TriangleMesh, map: &HeightMap) -> Heights {
    heights(mesh, map, &()).unwrap()
}

fn refusal(mesh: &TriangleMesh, map: &HeightMap) -> String {
    heights(mesh, map, &()).unwrap_err().to_string()
}

fn distances(mesh: &TriangleMesh, against: Side<'_>, samples: u64) -> Surface {
    let sampling = Sampling { amount: Amount::Samples(samples), seed: 7 };
    surface(Side::Mesh(mesh), against, sampling, &()).unwrap()
}

#[test]
fn measure_finds_no_error_in_the_grid_of_all_samples() {
    for kind in Procedural::ALL {
        let map = HeightMap::procedural(kind, 67, 130);
        let mesh = uniform::with_step(&map, 1).unwrap();
        let found = measured(&mesh, &map);
        assert_eq!((found.max, found.max_at, found.mean, found.rms), (0.0, None, Some(0.0), Some(0.0)), "{kind:?}");
        assert!(found.holds(0.0) && found.several_heights == 0 && found.inconsistent_edges == 0, "{found:?}");
        assert!(distances(&mesh, Side::Map(&map), 2000).both.max < 1e-9, "{kind:?}");
    }
}

#[test]
fn measure_knows_the_error_of_a_parabola() {
    // Between the vertices 0 and s, x^2 is below its chord by x (s - x), at most s^2 / 4.
    let map = map(33, 9, |i, _| (i * i) as u16);
    for step in [2, 4, 8, 16] {
        let found = measured(&uniform::with_step(&map, step).unwrap(), &map);
        assert_eq!(found.max, (step * step) as f64 / 4.0);
        assert_eq!(found.max_at, Some([step / 2, 0]));
        let mean = (0..33).map(|i| ((i % step) * (step - i % step)) as f64).sum::<f64>() / 33.0;
        assert!((found.mean.unwrap() - mean).abs() < 1e-12);
        // The columns 0 and 32, of half a weight, have no error; 8 rows of cells.
        assert!((found.volume_absolute - 8.0 * 33.0 * mean).abs() < 1e-9);
        assert_eq!(found.volume_absolute, found.volume_signed);
    }
}

#[test]
fn measure_counts_what_breaks_a_cover() {
    let map = map(9, 9, |_, _| 100);
    let whole = uniform::with_step(&map, 2).unwrap();
    let mut holed = whole.clone();
    holed.triangles.remove(10);
    let found = measured(&holed, &map);
    // A triangle of 2 x 2 samples has one inside its hypotenuse, which its neighbour holds too.
    assert_eq!((found.open_edges, found.uncovered), (3, 0));
    assert!(found.max == 0.0 && !found.holds(1.0));
    let mut holed = uniform::with_step(&map, 4).unwrap();
    holed.triangles.remove(2);
    // Half a cell of 4 x 4 in the upper right corner: three samples inside, seven on the rim.
    assert_eq!(measured(&holed, &map).uncovered, 3 + 7);
    // Twice the same triangle: its edges have three users.
    let mut doubled = whole.clone();
    doubled.triangles.push(doubled.triangles[10]);
    assert_eq!((measured(&doubled, &map).nonmanifold_edges, measured(&doubled, &map).several_heights), (3, 0));
    // A triangle that is turned over walks its edges as its neighbours do.
    let mut turned = whole.clone();
    turned.triangles[10].swap(0, 1);
    let found = measured(&turned, &map);
    assert_eq!((found.folded, found.inconsistent_edges, found.max), (1, 3, 0.0));
    assert!(!found.holds(1.0));
    // All of them turned over is a cover seen from below.
    let mut below = whole.clone();
    below.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    assert!(measured(&below, &map).holds(0.0));
    // An own copy of each vertex is the same mesh; a lifted copy is a crack.
    let own = |mesh: &TriangleMesh| TriangleMesh {
        positions: mesh.triangles.iter().flatten().map(|at| mesh.positions[*at as usize]).collect(),
        triangles: (0..mesh.triangles.len() as u32).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect(),
    };
    assert_eq!(measured(&own(&whole), &map), measured(&whole, &map));
    let mut cracked = own(&whole);
    cracked.positions[31][2] += 5.0;
    let found = measured(&cracked, &map);
    assert_eq!((found.max, found.uncovered), (5.0, 0));
    assert!(found.several_heights > 0 && found.open_edges == 4, "{found:?}");
    let mut flat = whole.clone();
    flat.triangles.push([0, 1, 2]);
    assert_eq!(measured(&flat, &map).degenerate, 1);
}

#[test]
fn measure_rounds_vertices_to_the_lattice_and_tells() {
    let map = map(5, 5, |i, j| (i + j) as u16);
    let mut mesh = uniform::with_step(&map, 2).unwrap();
    let lattice = f64::powi(2.0, -16);
    mesh.positions[4][0] += lattice;
    assert_eq!(measured(&mesh, &map).off_lattice, 0);
    mesh.positions[4][0] += 0.4 * lattice;
    assert_eq!((measured(&mesh, &map).off_lattice, measured(&mesh, &map).uncovered), (1, 0));
}

#[test]
fn measure_refuses_what_covers_no_map() {
    let four = map(4, 3, |_, _| 0);
    let good = uniform::with_step(&four, 1).unwrap();
    let with = |at: usize, position| {
        let mut mesh = good.clone();
        mesh.positions[at] = position;
        refusal(&mesh, &four)
    };
    let outside = "is outside the map; x, the column, from 0 to 3 and y, the row, from 0 to 2 are expected";
    assert_eq!(with(5, [3.5, 1.0, 0.0]), format!("vertex 5 (counted from 0) at (3.5, 1, 0) {outside}"));
    assert!(with(0, [0.0, -1e300, 0.0]).ends_with(outside));
    assert!(with(1, [f64::NAN, 0.0, 0.0]).ends_with(outside));
    assert!(with(1, [1.0, 0.0, f64::NAN]).ends_with("at (1, 0, NaN) has no height; a finite number is expected"));
    let mut wrong = good.clone();
    wrong.triangles[0][2] = 12;
    assert_eq!(refusal(&wrong, &four), "the mesh names vertex 12, but has 12, counted from 0");
    assert!(refusal(&TriangleMesh::default(), &four).starts_with("the mesh has no triangle"));
    let line = map(4, 1, |_, _| 0);
    assert!(refusal(&good, &line).starts_with("a map of 4 x 1 samples is no surface"));
    let sampling = Sampling { amount: Amount::Samples(10), seed: 1 };
    let measure = |a: &TriangleMesh, sampling| surface(Side::Mesh(a), Side::Map(&four), sampling, &()).unwrap_err();
    assert!(measure(&TriangleMesh::default(), sampling).to_string().starts_with("a mesh without a triangle"));
    assert!(measure(&wrong, sampling).to_string().contains("names vertex 12"));
    wrong.triangles[0][2] = 2;
    wrong.positions[3][1] = f64::NAN;
    assert!(measure(&wrong, sampling).to_string().contains("NaN"));
    let flat = TriangleMesh { positions: vec![[1.0; 3], [2.0; 3], [3.0; 3]], triangles: vec![[0, 1, 2]] };
    assert!(measure(&flat, sampling).to_string().starts_with("a surface has no area"));
    for amount in [Amount::Samples(0), Amount::PerArea(0.0), Amount::PerArea(1e300)] {
        assert!(measure(&good, Sampling { amount, seed: 1 }).to_string().contains("1 to 1"), "{amount:?}");
    }
}

#[test]
fn measure_knows_the_distance_of_parallel_planes() {
    let square = |side: f64, z: f64| TriangleMesh {
        positions: vec![[0.0, 0.0, z], [side, 0.0, z], [side, side, z], [0.0, side, z]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    let found = distances(&square(1.0, 0.0), Side::Mesh(&square(1.0, 0.25)), 1000);
    for side in [&found.forward, &found.backward] {
        assert_eq!((side.max, side.samples, side.area, side.density), (0.25, 1000, 1.0, 1000.0));
        assert!((side.mean - 0.25).abs() < 1e-12 && (side.rms - 0.25).abs() < 1e-12);
    }
    // A square of side 2 reaches beyond one of side 1: by (1, 1) in its corner. One way there is no distance at all.
    let found = distances(&square(1.0, 0.0), Side::Mesh(&square(2.0, 0.0)), 200_000);
    assert!(found.forward.max < 1e-15 && found.forward.mean < 1e-15);
    assert_eq!((found.backward.max, found.backward.max_at), (2f64.sqrt(), [2.0, 2.0, 0.0]));
    // Two strips at a mean distance of 1/2, and the mean distance of the unit square from its corner.
    let corner = (2f64.sqrt() + (1.0 + 2f64.sqrt()).ln()) / 3.0;
    let mean = (0.5 + 0.5 + corner) / 4.0;
    assert!((found.backward.mean - mean).abs() < 2e-3 * mean, "{} {mean}", found.backward.mean);
    // Squares: 1/3 in each strip, 2/3 in the corner.
    assert!((found.backward.rms - (1f64 / 3.0).sqrt()).abs() < 2e-3, "{}", found.backward.rms);
    assert!((found.both.mean - found.backward.mean * 4.0 / 5.0).abs() < 1e-12);
    assert!((found.both.rms.powi(2) - found.backward.rms.powi(2) * 4.0 / 5.0).abs() < 1e-12);
}

#[test]
fn measure_takes_a_map_for_the_mesh_of_all_its_samples() {
    let map = HeightMap { samples: noise(23, 14 * 9).iter().map(|value| value % 20).collect(), width: 14, height: 9 };
    let all = uniform::with_step(&map, 1).unwrap();
    let coarse = uniform::with_step(&map, 3).unwrap();
    let (one, other) = (distances(&coarse, Side::Map(&map), 5000), distances(&coarse, Side::Mesh(&all), 5000));
    assert_eq!(one.backward, other.backward);
    assert!((one.forward.mean - other.forward.mean).abs() < 1e-12 && one.forward.mean > 0.1);
    // The seed tells the points, and the points the figures.
    let again = distances(&coarse, Side::Map(&map), 5000);
    assert_eq!(one, again);
    let sampling = Sampling { amount: Amount::Samples(5000), seed: 8 };
    assert_ne!(surface(Side::Mesh(&coarse), Side::Map(&map), sampling, &()).unwrap().forward.mean, one.forward.mean);
}

/// Numbers without a pattern.
fn noise(seed: u64, count: usize) -> Vec<u16> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 48) as u16
    };
    (0..count).map(|_| next()).collect()
}

/// A map of up to 9 x 9 samples and a soup of triangles over it, in sixteenths of samples and of heights.
fn soups() -> impl Strategy<Value = (HeightMap, Vec<[[i64; 3]; 3]>)> {
    (2usize..10, 2usize..10).prop_flat_map(|(width, height)| {
        let samples = proptest::collection::vec(0u16..200, width * height);
        let corner = (0..=16 * (width as i64 - 1), 0..=16 * (height as i64 - 1), -800i64..4000);
        let corner = corner.prop_map(|(x, y, z)| [x, y, z]);
        let corners = proptest::array::uniform3(corner);
        (
            samples.prop_map(move |samples| HeightMap { width, height, samples }),
            proptest::collection::vec(corners, 1..12),
        )
    })
}

fn soup_mesh(soup: &[[[i64; 3]; 3]]) -> TriangleMesh {
    TriangleMesh {
        positions: soup.iter().flatten().map(|corner| corner.map(|value| value as f64 / 16.0)).collect(),
        triangles: (0..soup.len() as u32).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect(),
    }
}

/// The heights of a triangle at a sample, as numerator and denominator, if it holds the sample.
fn exact_height(corners: &[[i64; 3]; 3], [i, j]: [usize; 2]) -> Option<(BigInt, BigInt)> {
    let [x, y] = [i, j].map(|at| 16 * at as i64);
    let cross = |a: [i64; 3], b: [i64; 3]| (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
    let weights = [0, 1, 2].map(|at| cross(corners[(at + 1) % 3], corners[(at + 2) % 3]));
    let area: i64 = weights.iter().sum();
    let holds = area != 0 && weights.iter().all(|weight| weight.signum() * area.signum() >= 0);
    holds.then(|| {
        let height: BigInt =
            weights.iter().zip(corners).map(|(weight, corner)| BigInt::from(*weight) * corner[2]).sum();
        (height, BigInt::from(area) * 16)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn measure_agrees_with_rational_brute_force((map, soup) in soups()) {
        let found = measured(&soup_mesh(&soup), &map);
        let (mut uncovered, mut several, mut max, mut sum, mut squares, mut covered) = (0, 0, 0f64, 0.0, 0.0, 0u64);
        for at in 0..map.samples.len() {
            let place = [at % map.width, at / map.width];
            let held: Vec<_> = soup.iter().filter_map(|corners| exact_height(corners, place)).collect();
            let error = |(height, area): &(BigInt, BigInt)| {
                let difference: BigInt = height - area * BigInt::from(map.samples[at]);
                difference.to_string().parse::<f64>().unwrap() / area.to_string().parse::<f64>().unwrap()
            };
            let Some(first) = held.first() else { uncovered += 1; continue };
            several += u64::from(held.iter().any(|one| &one.0 * &first.1 != &first.0 * &one.1));
            max = held.iter().map(|one| error(one).abs()).fold(max, f64::max);
            covered += 1;
            sum += error(first).abs();
            squares += error(first).powi(2);
        }
        prop_assert_eq!((found.uncovered, found.several_heights), (uncovered, several));
        prop_assert!((found.max - max).abs() <= 1e-9, "{} {}", found.max, max);
        if covered > 0 {
            prop_assert!((found.mean.unwrap() - sum / covered as f64).abs() <= 1e-9);
            prop_assert!((found.rms.unwrap() - (squares / covered as f64).sqrt()).abs() <= 1e-9);
        } else {
            prop_assert_eq!((found.mean, found.rms), (None, None));
        }
    }

    #[test]
    fn measure_does_not_depend_on_the_order_of_triangles((map, soup) in soups()) {
        let mut mesh = soup_mesh(&soup);
        let one = measured(&mesh, &map);
        mesh.triangles.reverse();
        let other = measured(&mesh, &map);
        prop_assert_eq!((one.max, one.uncovered, one.open_edges), (other.max, other.uncovered, other.open_edges));
        prop_assert_eq!((one.several_heights, one.folded), (other.several_heights, other.folded));
    }

    #[test]
    fn measure_agrees_with_brute_force_on_distances((_, one) in soups(), (_, other) in soups()) {
        let (a, b) = (soup_mesh(&one), soup_mesh(&other));
        let sampling = Sampling { amount: Amount::Samples(64), seed: 3 };
        let Ok(found) = surface(Side::Mesh(&a), Side::Mesh(&b), sampling, &()) else { return Ok(()) };
        for (side, other) in [(&found.forward, &b), (&found.backward, &a)] {
            let nearest = other.triangles.iter().map(|corners| brute(other.corners(*corners), side.max_at));
            let expected = nearest.fold(f64::INFINITY, f64::min);
            prop_assert!((side.max - expected).abs() <= 1e-7 * (1.0 + expected), "{} {}", side.max, expected);
            prop_assert!(side.mean <= side.rms * (1.0 + 1e-12) && side.rms <= side.max);
        }
        // No vertex is farther than the maximum.
        for vertex in &a.positions {
            let nearest = b.triangles.iter().map(|corners| brute(b.corners(*corners), *vertex)).fold(f64::INFINITY, f64::min);
            prop_assert!(nearest <= found.forward.max + 1e-7 * (1.0 + nearest));
        }
    }
}

/// The distance of a point from a triangle, as the least over its sides and, if the foot lies within, its plane.
fn brute(corners: [[f64; 3]; 3], point: [f64; 3]) -> f64 {
    let [a, b, c] = corners.map(glam::DVec3::from);
    let point = glam::DVec3::from(point);
    let side = |a: glam::DVec3, b: glam::DVec3| {
        let along = b - a;
        let share = if along == glam::DVec3::ZERO { 0.0 } else { (point - a).dot(along) / along.length_squared() };
        point.distance(a + along * share.clamp(0.0, 1.0))
    };
    let mut least = side(a, b).min(side(b, c)).min(side(c, a));
    if let Some(normal) = (b - a).cross(c - a).try_normalize() {
        let inside = |a: glam::DVec3, b: glam::DVec3| normal.dot((b - a).cross(point - a)) >= 0.0;
        if inside(a, b) && inside(b, c) && inside(c, a) {
            least = least.min((point - a).dot(normal).abs());
        }
    }
    least
}
