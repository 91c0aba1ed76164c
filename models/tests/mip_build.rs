// SPDX-License-Identifier: MIT OR Apache-2.0
//! Properties of the golden pyramids.

use proptest::prelude::*;
use relief_models::mip_build::{
    Centring, Extremum, Level, MipError, Pyramid, Wrap, exact, golden, golden_with_poles, max_levels, side_above,
};

/// A reproducible map of `count` samples: uniform ones, or few different ones with both ends of the range.
fn random_map(count: usize, seed: u64) -> Vec<u16> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as u16
    };
    let coarse = next() % 3 == 0;
    (0..count).map(|_| if coarse { [0, 1, 40_000, 65_535][usize::from(next() % 4)] } else { next() }).collect()
}

/// Every kind of border that maps of this size allow.
fn wraps(width: usize, height: usize) -> Vec<[Wrap; 2]> {
    let axis = |side: usize| if side.is_multiple_of(2) { vec![Wrap::Clamp, Wrap::Repeat] } else { vec![Wrap::Clamp] };
    axis(width).into_iter().flat_map(|u| axis(height).into_iter().map(move |v| [u, v])).collect()
}

#[test]
fn mip_build_example_of_the_documentation() {
    let build = |extremum| golden(4, 1, &[1, 5, 2, 0], Centring::Node, [Wrap::Clamp; 2], extremum, 2).unwrap();
    assert_eq!(build(Extremum::Max).levels[1], Level { width: 3, height: 1, samples: vec![5, 5, 0] });
    assert_eq!(build(Extremum::Min).levels[1].samples, [1, 0, 0]);
}

#[test]
fn mip_build_matches_exact_at_all_small_sizes() {
    let mut compared = 0;
    for (width, height) in (1..=12).flat_map(|w| (1..=12).map(move |h| (w, h))) {
        let map = random_map(width * height, (100 * width + height) as u64);
        for centring in [Centring::Node, Centring::Cell] {
            for wrap in wraps(width, height) {
                let levels = max_levels(width, height, centring, wrap).min(5);
                for extremum in [Extremum::Max, Extremum::Min] {
                    let pyramid = golden(width, height, &map, centring, wrap, extremum, levels).unwrap();
                    for (level, samples) in pyramid.levels.iter().enumerate() {
                        for at in (0..samples.height).flat_map(|j| (0..samples.width).map(move |i| (i, j))) {
                            let want = exact((width, height), &map, centring, wrap, extremum, level, at);
                            let got = samples.at(at.0, at.1);
                            assert_eq!(got, want, "{width} x {height} {centring:?} {wrap:?} level {level} {at:?}");
                            compared += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(compared > 30_000, "{compared}");
}

#[test]
fn mip_build_refuses_what_has_no_pyramid() {
    let build = |w, h, n: usize, wrap, levels| {
        golden(w, h, &vec![0; n], Centring::Node, wrap, Extremum::Max, levels).err().map(|error| error.to_string())
    };
    let clamp = [Wrap::Clamp; 2];
    let says =
        |error: Option<String>, part: &str| assert!(error.as_ref().is_some_and(|e| e.contains(part)), "{error:?}");
    says(build(0, 3, 0, clamp, 1), "the map has 0 x 3 texels");
    says(build(2, 3, 5, clamp, 1), "there are 5 samples");
    says(build(2, 3, 6, clamp, 0), "1 to 15 levels, not 0");
    says(build(2, 3, 6, clamp, 16), "1 to 15 levels, not 16");
    says(build(12, 3, 36, [Wrap::Repeat, Wrap::Clamp], 3), "along u the map repeats after 3 texels at level 2");
    says(build(12, 3, 36, [Wrap::Clamp, Wrap::Repeat], 1), "along v the map repeats after 3 texels at level 0");
    assert_eq!(build(12, 3, 36, [Wrap::Repeat, Wrap::Clamp], 2), None);
    assert_eq!(build(2, 3, 6, clamp, 15), None);
    let poles = golden_with_poles(2, 2, &[0; 4], Centring::Node, [Wrap::Repeat; 2], Extremum::Max, 1);
    assert_eq!(poles.err(), Some(MipError::NoPoles));
    assert_eq!(max_levels(512, 257, Centring::Node, [Wrap::Repeat, Wrap::Clamp]), 9);
    assert_eq!(max_levels(1, 1, Centring::Cell, [Wrap::Clamp; 2]), 1);
    assert_eq!(side_above(7, Centring::Cell, Wrap::Clamp), 4);
}

#[test]
fn mip_build_poles_are_one_value_at_every_level() {
    for (width, height) in (1..=9).flat_map(|w| (1..=9).map(move |h| (2 * w, h))) {
        let map = random_map(width * height, (100 * width + height) as u64);
        let wrap = [Wrap::Repeat, Wrap::Clamp];
        let levels = max_levels(width, height, Centring::Node, wrap);
        let built = golden_with_poles(width, height, &map, Centring::Node, wrap, Extremum::Max, levels).unwrap();
        for (level, samples) in built.levels.iter().enumerate() {
            for row in [0, samples.height - 1] {
                let pole = samples.at(0, row);
                assert!((0..samples.width).all(|i| samples.at(i, row) == pole), "{width} x {height} level {level}");
            }
            let below = &built.levels[level.saturating_sub(1)];
            assert!(samples.at(0, 0) >= below.at(0, 0));
        }
        // Rows that touch no pole are the map's.
        let inner = built.levels[0].samples.iter().zip(&map).skip(width);
        let inner = inner.take((width * height).saturating_sub(2 * width));
        assert!(inner.clone().all(|(a, b)| a == b) && inner.count() == width * height.saturating_sub(2));
    }
}

/// What the builder in hardware rests on: with poles, every level is the one without, its pole rows replaced by their
/// extremum. The golden model replaces level by level, and builds on what it has replaced.
#[test]
fn mip_build_poles_only_replace_what_is_sent() {
    let mut replaced = 0;
    for (width, height) in (1..=8).flat_map(|w| (1..=40).map(move |h| (w, h))) {
        let map = random_map(width * height, (100 * width + height) as u64);
        let all = wraps(width, height).into_iter().filter(|wrap| wrap[1] == Wrap::Clamp);
        for (wrap, centring) in all.flat_map(|wrap| [Centring::Node, Centring::Cell].map(|centring| (wrap, centring))) {
            let levels = max_levels(width, height, centring, wrap);
            for extremum in [Extremum::Max, Extremum::Min] {
                let mut plain = golden(width, height, &map, centring, wrap, extremum, levels).unwrap();
                let poles = golden_with_poles(width, height, &map, centring, wrap, extremum, levels).unwrap();
                for (number, level) in plain.levels.iter_mut().enumerate() {
                    let first = (height - 1) >> number;
                    // Where the lower pole begins with row 0, it is all of both.
                    for rows in [0..first.min(1), first..level.height].into_iter().filter(|rows| !rows.is_empty()) {
                        let samples = &mut level.samples[rows.start * level.width..rows.end * level.width];
                        let pole = samples.iter().copied().reduce(|a, b| extremum.of(a, b)).unwrap();
                        samples.fill(pole);
                        replaced += samples.len();
                    }
                }
                assert!(plain == poles, "{width} x {height} {centring:?} {wrap:?}");
            }
        }
    }
    assert!(replaced > 40_000, "{replaced}");
}

/// Texel columns or rows `side` of level 0 that the two cells round point `u` (in 2^-`fraction` texels) of a level cover.
fn cell_taps(u: i64, fraction: u32, level: usize, side: usize) -> [usize; 2] {
    // Cell i of level L is centred on texel 2^L i + (2^L - 1) / 2.
    let half_steps = 2 * u - (((1i64 << level) - 1) << fraction);
    let first = half_steps >> (level as u32 + fraction + 1);
    [first, first + 1].map(|i| i.clamp(0, side as i64 - 1) as usize)
}

/// The greatest and the least of the four cells round every point bound the bilinear map there.
#[test]
fn mip_build_cell_taps_bound_the_map() {
    let mut points = 0;
    for (width, height) in (1..=9).flat_map(|w| (1..=9).map(move |h| (w, h))) {
        let map = random_map(width * height, (7 + 100 * width + height) as u64);
        let clamp = [Wrap::Clamp; 2];
        let build = |extremum| golden(width, height, &map, Centring::Cell, clamp, extremum, 5).unwrap();
        let [most, least]: [Pyramid; 2] = [build(Extremum::Max), build(Extremum::Min)];
        let texel = |x: i64, y: i64| {
            i64::from(map[y.min(height as i64 - 1) as usize * width + x.min(width as i64 - 1) as usize])
        };
        for level in 1..5 {
            let (cells_w, cells_h) = (most.levels[level].width, most.levels[level].height);
            // Quarter texels.
            for (u, v) in (0..4 * width as i64 - 3).flat_map(|u| (0..4 * height as i64 - 3).map(move |v| (u, v))) {
                let (x, y, a, b) = (u >> 2, v >> 2, u & 3, v & 3);
                let value = (texel(x, y) * (4 - a) + texel(x + 1, y) * a) * (4 - b)
                    + (texel(x, y + 1) * (4 - a) + texel(x + 1, y + 1) * a) * b;
                let (columns, rows) = (cell_taps(u, 2, level, cells_w), cell_taps(v, 2, level, cells_h));
                let taps = |p: &Pyramid| {
                    let all = rows.iter().flat_map(|&j| columns.iter().map(move |&i| (i, j)));
                    all.map(|(i, j)| 16 * i64::from(p.levels[level].at(i, j))).collect::<Vec<_>>()
                };
                let (high, low) = (taps(&most).into_iter().max().unwrap(), taps(&least).into_iter().min().unwrap());
                assert!(low <= value && value <= high, "{width} x {height} level {level} ({u}/4, {v}/4)");
                points += 1;
            }
        }
    }
    assert!(points > 90_000, "{points}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, ..ProptestConfig::default() })]

    /// Maxima of the map are minima of its complement.
    #[test]
    fn mip_build_minimum_is_the_maximum_turned_round(w in 1usize..20, h in 1usize..20, seed: u64, cell: bool) {
        let map = random_map(w * h, seed);
        let turned: Vec<u16> = map.iter().map(|s| !s).collect();
        let centring = if cell { Centring::Cell } else { Centring::Node };
        let clamp = [Wrap::Clamp; 2];
        let most = golden(w, h, &map, centring, clamp, Extremum::Max, 4).unwrap();
        let least = golden(w, h, &turned, centring, clamp, Extremum::Min, 4).unwrap();
        for (a, b) in most.levels.iter().zip(&least.levels) {
            prop_assert!(a.samples.iter().zip(&b.samples).all(|(a, b)| *a == !b));
        }
    }
}
