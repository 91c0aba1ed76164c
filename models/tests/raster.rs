// SPDX-License-Identifier: MIT OR Apache-2.0
//! The rasteriser: exact coverage, no holes and nothing twice on shared edges, and the nearest triangle in the picture.

use proptest::prelude::*;
use relief_models::raster::{Corner, Frame, cover};

const SIZE: [u32; 2] = [24, 17];

fn corner(x: i32, y: i32) -> Corner {
    Corner { x, y, depth: 1 << 30 }
}

/// How often each pixel of a picture is covered.
fn coverage(triangles: &[[Corner; 3]], size: [u32; 2]) -> Vec<u32> {
    let mut counts = vec![0; (size[0] * size[1]) as usize];
    for triangle in triangles {
        cover(*triangle, size, |fragment| counts[(fragment.y * size[0] + fragment.x) as usize] += 1);
    }
    counts
}

/// Where a pixel's centre lies: 1 inside a triangle, 0 on its outline, -1 outside. With areas instead of edge functions.
fn side(triangle: [Corner; 3], pixel: [i64; 2], size: [u32; 2]) -> i64 {
    let centre = [0, 1].map(|axis| 256 * pixel[axis] + 128 - 128 * i64::from(size[axis]));
    let points = triangle.map(|corner| [i64::from(corner.x), i64::from(corner.y)]);
    let area =
        |a: [i64; 2], b: [i64; 2], c: [i64; 2]| a[0] * (b[1] - c[1]) + b[0] * (c[1] - a[1]) + c[0] * (a[1] - b[1]);
    let whole = area(points[0], points[1], points[2]).abs();
    let parts = [0, 1, 2].map(|k| area(points[k], points[(k + 1) % 3], centre).abs());
    match parts.iter().sum::<i64>() == whole {
        false => -1,
        true => i64::from(parts.iter().all(|part| *part > 0)),
    }
}

#[test]
fn raster_pixels_on_edges_belong_to_one_side() {
    // A square of 2 x 2 pixels whose corners are centres: top and left rims are in, bottom and right are out.
    let [a, b, c, d] = [corner(-128, -128), corner(384, -128), corner(384, 384), corner(-128, 384)];
    let square = coverage(&[[a, b, c], [a, c, d]], [4, 4]);
    let expected = [0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0];
    assert_eq!(square, expected);
    assert_eq!(coverage(&[[c, b, a], [d, a, c]], [4, 4]), expected);
    assert_eq!(coverage(&[[a, b, d], [b, c, d]], [4, 4]), expected);
    // No area, no pixels, on whichever line.
    for line in [[a, b, b], [a, a, a], [a, corner(128, -128), b], [d, corner(128, 128), b]] {
        assert!(!cover(line, [4, 4], |fragment| panic!("{fragment:?}")));
    }
    // Far beyond the picture on all sides.
    let vast = [corner(-2_000_000, -2_000_000), corner(2_000_000, -2_000_000), corner(0, 2_000_000)];
    assert_eq!(coverage(&[vast], SIZE), [1; 24 * 17]);
}

#[test]
fn raster_depth_is_linear_and_the_larger_wins() {
    let at = |x, y, depth| Corner { x: 256 * x, y: 256 * y, depth };
    // 16 depth units a pixel to the right.
    let mut depths = Vec::new();
    cover([at(-2, -1, 0), at(2, -1, 64), at(-2, 1, 0)], [4, 2], |fragment| depths.push((fragment.x, fragment.depth)));
    assert_eq!(depths, [(0, 8), (1, 24), (2, 40), (0, 8)]);
    let mut full = 0;
    cover([at(-9, -9, u32::MAX), at(9, -9, u32::MAX), at(0, 9, u32::MAX)], [1, 1], |fragment| full = fragment.depth);
    assert_eq!(full, u32::MAX);
    let all = |depth| [at(-9, -9, depth), at(9, -9, depth), at(0, 18, depth)];
    let mut frame = Frame::new(1, 1);
    assert_eq!(frame.depth, [0]);
    assert_eq!(frame.triangle(all(5), [1, 1, 1]), 1);
    assert_eq!(frame.triangle(all(5), [2, 2, 2]), 1);
    assert_eq!((frame.colour[0], frame.depth[0]), ([1, 1, 1], 5));
    frame.triangle(all(6), [3, 3, 3]);
    frame.triangle(all(4), [4, 4, 4]);
    assert_eq!((frame.colour[0], frame.depth[0]), ([3, 3, 3], 6));
}

#[test]
fn raster_lines_are_dark_on_large_triangles_and_light_on_small_ones() {
    let grey = [200, 200, 200];
    let mut large = Frame::new(40, 40);
    // A right angle whose left edge runs through the middles of column 4.
    let at = |x: i32, y: i32| corner(256 * x - 5120 + 128, 256 * y - 5120 + 128);
    large.triangle_with_edges([at(4, 4), at(36, 4), at(4, 36)], grey);
    let pixel = |frame: &Frame, x: usize, y: usize| frame.colour[40 * y + x];
    assert!(pixel(&large, 4, 15)[0] < 100, "{:?}", pixel(&large, 4, 15));
    assert_eq!(pixel(&large, 6, 15), grey);
    assert_eq!(pixel(&large, 12, 12), grey);
    let mut small = Frame::new(40, 40);
    small.triangle_with_edges([at(4, 4), at(6, 4), at(4, 6)], grey);
    let shade = pixel(&small, 4, 5)[0];
    assert!((130..190).contains(&shade), "{shade}");
    // The same pixels and depths as without lines.
    let mut plain = Frame::new(40, 40);
    plain.triangle([at(4, 4), at(36, 4), at(4, 36)], grey);
    assert_eq!(plain.depth, large.depth);
    assert_eq!(small.triangle_with_edges([at(4, 4), at(6, 4), at(5, 4)], grey), 0);
}

#[test]
fn raster_png_reads_back() {
    let mut frame = Frame::new(5, 3);
    frame.triangle([corner(-999, -999), corner(999, -999), corner(0, 0)], [9, 99, 200]);
    let picture = image::load_from_memory(&frame.png().unwrap()).unwrap().into_rgb8();
    assert_eq!((picture.width(), picture.height()), (5, 3));
    assert_eq!(picture.into_raw(), frame.colour.as_flattened());
    assert_eq!(frame.colour[2], [9, 99, 200]);
    // Lighter towards the bottom.
    let sky = Frame::new(2, 100);
    assert!(sky.colour[0][2] + 50 < sky.colour[198][2]);
}

fn small_corner() -> impl Strategy<Value = Corner> {
    // Often on centres and rims of pixels, sometimes anywhere, within and around the picture.
    let coordinate = prop_oneof![(-20i32..20).prop_map(|half| 128 * half), -4000i32..4000];
    (coordinate.clone(), coordinate, any::<u32>()).prop_map(|(x, y, depth)| Corner { x, y, depth })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn raster_covers_what_is_inside(triangle in prop::array::uniform3(small_corner())) {
        let counts = coverage(&[triangle], SIZE);
        let [low, high] = [triangle.iter().map(|c| c.depth).min(), triangle.iter().map(|c| c.depth).max()];
        let has_area = cover(triangle, SIZE, |fragment| {
            assert!(low <= Some(fragment.depth) && Some(fragment.depth) <= high);
        });
        for (index, count) in counts.iter().enumerate() {
            let pixel = [index as i64 % i64::from(SIZE[0]), index as i64 / i64::from(SIZE[0])];
            match side(triangle, pixel, SIZE) {
                1 => prop_assert_eq!(*count, 1),
                -1 => prop_assert_eq!(*count, 0),
                _ => prop_assert!(*count <= u32::from(has_area)),
            }
        }
    }

    #[test]
    fn raster_covers_every_pixel_of_a_mesh_once(
        outer in prop::array::uniform3(small_corner()),
        splits in prop::collection::vec((any::<prop::sample::Index>(), 1i32..8, 1i32..8, 0usize..6), 0..20),
    ) {
        // A triangle split inside again and again: whatever the order and the facing, what was covered once still is.
        let mut mesh = vec![outer];
        for (index, to_b, to_c, turn) in splits {
            let place = index.index(mesh.len());
            let [a, b, c] = mesh[place];
            let step = |from: i32, b: i32, c: i32| from + ((b - from) * to_b + (c - from) * to_c) / 16;
            let inner = corner(step(a.x, b.x, c.x), step(a.y, b.y, c.y));
            // Rounded towards `a`, so never outside, but perhaps on a side, where a triangle without area is left.
            let parts = [[a, b, inner], [b, c, inner], [c, a, inner]];
            let doubled = |[a, b, c]: [Corner; 3]| {
                let (a, b, c) = ([a.x, a.y].map(i64::from), [b.x, b.y].map(i64::from), [c.x, c.y].map(i64::from));
                ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
            };
            if parts.iter().map(|part| doubled(*part)).sum::<i64>() != doubled([a, b, c]) {
                continue;
            }
            mesh.swap_remove(place);
            for (k, mut part) in parts.into_iter().enumerate() {
                part.rotate_left(turn % 3);
                if (turn + k) % 2 == 1 {
                    part.swap(0, 1);
                }
                mesh.push(part);
            }
        }
        prop_assert_eq!(coverage(&mesh, SIZE), coverage(&[outer], SIZE));
    }

    #[test]
    fn raster_covers_a_jittered_grid_once(
        jitter in prop::collection::vec((-100i32..=100, -100i32..=100, any::<bool>()), 81),
        step in 64i32..400,
    ) {
        // 8 x 8 quads with straight rims on pixel borders or between; inner vertices anywhere near their places.
        let at = |i: usize, j: usize| {
            let (dx, dy, _) = jitter[9 * j + i];
            let inner = (1..8).contains(&i) && (1..8).contains(&j);
            let moved = |d: i32| if inner { d * step / 256 } else { 0 };
            corner((i as i32 - 4) * step + moved(dx), (j as i32 - 4) * step + moved(dy))
        };
        let mut mesh = Vec::new();
        for (i, j) in (0..64).map(|index| (index % 8, index / 8)) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            // Moved by less than half a step, a quad stays convex enough for one of its diagonals: the triangles around
            // every vertex keep their turn, so this is a tiling.
            mesh.extend([[a, b, c], [a, c, d]]);
        }
        let turned = |[a, b, c]: [Corner; 3]| {
            i64::from(b.x - a.x) * i64::from(c.y - a.y) - i64::from(b.y - a.y) * i64::from(c.x - a.x) > 0
        };
        prop_assume!(mesh.iter().all(|triangle| turned(*triangle)));
        let size = [16, 14];
        let counts = coverage(&mesh, size);
        let inside = |pixel: u32, count: u32| {
            let centre = 256 * pixel as i32 + 128 - 128 * count as i32;
            (-4 * step..4 * step).contains(&centre)
        };
        for (index, count) in counts.iter().enumerate() {
            let (x, y) = (index as u32 % size[0], index as u32 / size[0]);
            prop_assert_eq!(*count, u32::from(inside(x, size[0]) && inside(y, size[1])), "pixel {} {}", x, y);
        }
    }
}
