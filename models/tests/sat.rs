// SPDX-License-Identifier: MIT OR Apache-2.0
//! Properties of the golden summed-area table, its fetch and its average.

use proptest::prelude::*;
use relief_models::sat_average;
use relief_models::sat_build::{SatBuild, Sum, golden};
use relief_models::sat_fetch::{Border, Command, SatFetch, Summed, exact, fetch};

const BORDERS: [Border; 2] = [Border::Clamp, Border::Slide];

/// A reproducible generator of `0..bound`.
fn random(seed: u64) -> impl FnMut(u64) -> u64 {
    let mut state = seed ^ 0x9e37_79b9_7f4a_7c15;
    move |bound| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % bound
    }
}

#[test]
fn sat_build_example_of_the_documentation() {
    let table = golden(2, 2, &[1, 2, 3, 4], 32);
    assert_eq!([table.at(1, 1), table.at(2, 1), table.at(1, 2), table.at(2, 2), table.at(0, 2)], [1, 3, 4, 10, 0]);
    let at = |border| fetch(&table, border, (1, 0), (2, 2));
    assert_eq!(at(Border::Clamp), Summed { sum: 6, area: 2, error: false });
    assert_eq!(at(Border::Slide), Summed { sum: 10, area: 4, error: false });
    assert_eq!(sat_average::golden(10, 4), (0x280, false));
}

/// Every rectangle that touches the map or lies round it, of every map up to 6 x 6, at a width that wraps often.
#[test]
fn sat_fetch_error_is_zero_for_every_rectangle_of_small_maps() {
    let (mut next, mut compared) = (random(5), 0);
    for (width, height) in (1..=6usize).flat_map(|w| (1..=6usize).map(move |h| (w, h))) {
        let map: Vec<u16> =
            (0..width * height).map(|_| [0, 65_535, 40_001, next(65_536)][next(4) as usize] as u16).collect();
        let tables = [17, 20, 32].map(|bits| golden(width, height, &map, bits));
        for (x, y) in (-2..=7).flat_map(|x| (-2..=7).map(move |y| (x, y))) {
            for (a, b) in (0..=8).flat_map(|a| (0..=8).map(move |b| (a, b))) {
                for border in BORDERS {
                    let (sum, area) = exact((width, height), &map, border, (x, y), (a, b));
                    for table in &tables {
                        let got = fetch(table, border, (x, y), (a, b));
                        let place = format!("{width} x {height} {border:?} ({x}, {y}) {a} x {b}, {} bits", table.bits);
                        assert_eq!(got.area, area, "{place}");
                        assert_eq!(got.sum, sum & ((1 << table.bits) - 1), "{place}");
                        assert_eq!(got.error, area * 65_535 >= 1 << table.bits, "{place}");
                        assert!(got.error || got.sum == sum, "{place}");
                        compared += 1;
                    }
                }
            }
        }
    }
    assert_eq!(compared, 36 * 100 * 81 * 2 * 3);
}

/// A million random rectangles of a large map, against prefix sums of each column that never wrap.
#[test]
fn sat_fetch_error_is_zero_for_a_million_rectangles_of_a_large_map() {
    let (width, height) = (640usize, 403usize);
    let mut next = random(11);
    let map: Vec<u16> = (0..width * height).map(|_| next(65_536) as u16).collect();
    let table = golden(width, height, &map, 34);
    let mut columns = vec![vec![0u64; height + 1]; width];
    for (x, column) in columns.iter_mut().enumerate() {
        for y in 0..height {
            column[y + 1] = column[y] + u64::from(map[y * width + x]);
        }
    }
    assert!(columns.iter().map(|column| column[height]).sum::<u64>() > 0);
    for _ in 0..1_000_000 {
        let (x0, y0) = (next(width as u64) as usize, next(height as u64) as usize);
        // Mostly narrow ones, so that the reference does not take minutes.
        let wide = if next(50) == 0 { width } else { 40 };
        let a = 1 + next((width - x0).min(wide) as u64) as usize;
        let b = 1 + next((height - y0) as u64) as usize;
        let want: u64 = columns[x0..x0 + a].iter().map(|column| column[y0 + b] - column[y0]).sum();
        let got = fetch(&table, Border::Clamp, (x0 as i64, y0 as i64), (a as u64, b as u64));
        assert_eq!((got.area, got.error), ((a * b) as u64, (a * b) as u64 * 65_535 >= 1 << 34));
        assert!(got.error || got.sum == want, "({x0}, {y0}) {a} x {b}");
    }
}

#[test]
fn sat_build_model_sends_the_table_and_says_what_it_refuses() {
    let map = [9, 65_535, 3, 65_535, 65_535, 7];
    for bits in [16, 17, 40] {
        let table = golden(3, 2, &map, bits);
        let mut builder = SatBuild::new(4, bits);
        builder.size(3, 2);
        for (k, &texel) in map.iter().enumerate() {
            let (x, y) = (k % 3 + 1, k / 3 + 1);
            assert_eq!(builder.texel(texel), Some(Sum { x, y, sum: table.at(x, y), last: k == 5 }));
        }
        assert!(!builder.error());
        assert_eq!(builder.texel(1), None);
        assert!(builder.error());
    }
    for (width, height) in [(0, 1), (1, 0), (5, 1)] {
        let mut builder = SatBuild::new(4, 32);
        builder.size(width, height);
        assert!(builder.error());
    }
    let mut twice = SatBuild::new(4, 32);
    twice.size(4, 9);
    assert!(!twice.error());
    twice.size(2, 2);
    assert!(twice.error());
}

/// The unit behind the builder: the sums of the table, word by word, then every rectangle and everything it refuses.
#[test]
fn sat_fetch_model_reads_its_memory_and_says_what_it_refuses() {
    let (map, bits) = ([9, 65_535, 3, 65_535, 65_535, 7], 17);
    let table = golden(3, 2, &map, bits);
    let load = |unit: &mut SatFetch, border| {
        assert_eq!(unit.accept(&Command::Size { width: 3, height: 2, border }), None);
        for (x, y) in (1..=2).flat_map(|y| (1..=3).map(move |x| (x, y))) {
            let sum = table.at(x as usize, y as usize);
            assert_eq!(unit.accept(&Command::Load { x, y, sum }), None);
        }
    };
    for border in BORDERS {
        let mut unit = SatFetch::new(6, bits);
        load(&mut unit, border);
        assert!(!unit.error());
        let mut error = false;
        for corner in (-2..=4).flat_map(|x| (-2..=3).map(move |y| (x, y))) {
            for size in (0..=4).flat_map(|a| (0..=3).map(move |b| (a, b))) {
                let want = fetch(&table, border, corner, size);
                assert_eq!(unit.accept(&Command::Fetch { corner, size }), Some(want), "{corner:?} {size:?}");
                error |= want.error;
                assert_eq!(unit.error(), error, "{corner:?} {size:?}");
            }
        }
    }
    let whole = Command::Fetch { corner: (0, 0), size: (1, 1) };
    let border = Border::Clamp;
    for fault in [
        Command::Size { width: 0, height: 2, border },
        Command::Size { width: 3, height: 0, border },
        Command::Load { x: 0, y: 1, sum: 1 },
        Command::Load { x: 4, y: 1, sum: 1 },
        Command::Load { x: 1, y: 0, sum: 1 },
        Command::Load { x: 1, y: 3, sum: 1 },
        Command::Load { x: -1, y: 2, sum: 1 },
    ] {
        let mut unit = SatFetch::new(6, bits);
        load(&mut unit, border);
        assert_eq!(unit.accept(&fault), None);
        assert!(unit.error(), "{fault:?}");
        let gone = matches!(fault, Command::Size { .. });
        let want = if gone { Summed { sum: 0, area: 0, error: true } } else { fetch(&table, border, (0, 0), (1, 1)) };
        assert_eq!(unit.accept(&whole), Some(want), "{fault:?}");
    }
    // A memory that ends within the last row: its entry counts 0.
    let mut unit = SatFetch::new(5, bits);
    load(&mut unit, border);
    assert!(unit.error());
    let lost = unit.accept(&Command::Fetch { corner: (2, 1), size: (1, 1) });
    let sum = table.at(2, 1).wrapping_sub(table.at(2, 2) + table.at(3, 1)) & ((1 << bits) - 1);
    assert_eq!(lost, Some(Summed { sum, area: 1, error: true }));
}

#[test]
fn sat_average_is_the_rounded_mean() {
    assert_eq!(sat_average::golden(5, 0), (0, true));
    assert_eq!(sat_average::golden(65_535, 1), (65_535 << 8, false));
    assert_eq!(sat_average::golden(65_536, 1), (sat_average::MOST, true));
    assert_eq!(sat_average::golden(u64::MAX, 1), (sat_average::MOST, true));
    // A half goes up: 1/512 is half a unit.
    assert_eq!(sat_average::golden(1, 512), (1, false));
    assert_eq!(sat_average::golden(1, 513), (0, false));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5_000, ..ProptestConfig::default() })]

    #[test]
    fn sat_average_error_bound(area in 1u64..1 << 24, mean in 0.0f64..65_535.0) {
        let sum = (mean * area as f64) as u64;
        let (value, error) = sat_average::golden(sum, area);
        prop_assert!(!error);
        prop_assert!((f64::from(value) - 256.0 * sum as f64 / area as f64).abs() <= 0.5 + 1e-6);
    }
}
