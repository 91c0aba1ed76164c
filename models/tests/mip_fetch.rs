// SPDX-License-Identifier: MIT OR Apache-2.0
//! Properties of the golden fetch from pyramids.

use proptest::prelude::*;
use relief_models::map::read;
use relief_models::mip_build::{Centring, Extremum, Pyramid, Wrap, golden, max_levels};
use relief_models::mip_fetch::{Command, Filter, MipFetch, Placement, exact, fetch, fetch_checked};
use relief_models::rules::Pyramids;

fn random_map(count: usize, seed: u64) -> Vec<u16> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as u16
    };
    let coarse = next() % 3 == 0;
    (0..count).map(|_| if coarse { [0, 1, 40_000, 65_535][usize::from(next() % 4)] } else { next() }).collect()
}

fn wraps(width: usize, height: usize) -> Vec<[Wrap; 2]> {
    let axis = |side: usize| if side.is_multiple_of(2) { vec![Wrap::Clamp, Wrap::Repeat] } else { vec![Wrap::Clamp] };
    axis(width).into_iter().flat_map(|u| axis(height).into_iter().map(move |v| [u, v])).collect()
}

fn pyramid(width: usize, height: usize, map: &[u16], wrap: [Wrap; 2], extremum: Extremum) -> Pyramid {
    let levels = max_levels(width, height, Centring::Node, wrap);
    golden(width, height, map, Centring::Node, wrap, extremum, levels).unwrap()
}

#[test]
fn mip_fetch_example_of_the_documentation() {
    let row = pyramid(2, 1, &[100, 200], [Wrap::Clamp; 2], Extremum::Max);
    assert_eq!(fetch(&row, 0, 1 << 14, 0, Filter::Bilinear), 0x7d00);
    assert_eq!(fetch(&row, 0, (1 << 15) - 1, 0, Filter::Nearest), 100 << 8);
    assert_eq!(fetch(&row, 0, 1 << 15, 0, Filter::Nearest), 200 << 8);
    // Beyond the last level is the last level.
    assert_eq!(fetch(&row, 15, 0, 0, Filter::Nearest), 100 << 8);
}

/// The lemma: read bilinearly, a level of node maxima is nowhere below level 0, one of minima nowhere above, and each
/// level bounds the one below it; at every point with 12 fraction bits at the upper level (here an eighth of a texel).
#[test]
fn mip_fetch_node_levels_bound_the_map_everywhere() {
    let mut points = 0;
    for (width, height) in (1..=9u32).flat_map(|w| (1..=9).map(move |h| (w, h))) {
        let map = random_map((width * height) as usize, u64::from(100 * width + height));
        for wrap in wraps(width as usize, height as usize) {
            let build = |extremum| pyramid(width as usize, height as usize, &map, wrap, extremum);
            let (most, least) = (build(Extremum::Max), build(Extremum::Min));
            // Up to the last texel, and on a repeat axis once round.
            let end = |side: u32, wrap| if wrap == Wrap::Repeat { 8 * side } else { 8 * side - 7 };
            let (end_u, end_v) = (end(width, wrap[0]), end(height, wrap[1]));
            for (u, v) in (0..end_u).flat_map(|u| (0..end_v).map(move |v| (u << 13, v << 13))) {
                let at = |p: &Pyramid, level| fetch(p, level, u, v, Filter::Bilinear);
                let middle = at(&most, 0);
                for level in 1..most.levels.len() {
                    let (high, low) = (at(&most, level), at(&least, level));
                    let place = format!("{width} x {height} {wrap:?} level {level} ({u:#x}, {v:#x})");
                    assert!(low <= middle && middle <= high, "{place}: {low} {middle} {high}");
                    assert!(at(&most, level - 1) <= high && low <= at(&least, level - 1), "{place}");
                    points += 1;
                }
            }
        }
    }
    assert!(points > 300_000, "{points}");
}

/// The lemma on a real map, at every texel and between: node levels read bilinearly, and the largest of the four taps of
/// cell levels, are nowhere below it.
#[test]
fn mip_fetch_levels_bound_a_real_map() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/maps/jacksboro.png");
    let (map, _) = read(file.as_ref(), &|_| Ok(())).unwrap();
    let (width, height) = (map.width, map.height);
    let nodes = pyramid(width, height, &map.samples, [Wrap::Clamp; 2], Extremum::Max);
    let levels = nodes.levels.len();
    let cells = golden(width, height, &map.samples, Centring::Cell, [Wrap::Clamp; 2], Extremum::Max, levels).unwrap();
    assert!(levels >= 8, "{levels}");
    let mut points = 0;
    // Half a texel on each axis: exact at every level up to 11.
    let (end_u, end_v) = (2 * width as u32 - 1, 2 * height as u32 - 1);
    for (u, v) in (0..end_u).flat_map(|u| (0..end_v).map(move |v| (u << 15, v << 15))) {
        let mut below = fetch(&nodes, 0, u, v, Filter::Bilinear);
        for level in 1..levels {
            let node = fetch(&nodes, level, u, v, Filter::Bilinear);
            assert!(below <= node, "level {level} ({u:#x}, {v:#x}): {below} {node}");
            below = node;
        }
        let middle = fetch(&nodes, 0, u, v, Filter::Bilinear);
        for (level, samples) in cells.levels.iter().enumerate().skip(1) {
            // The four cells round the point: centres lie half a cell beyond their first texel.
            let taps = |at: u32, side: usize| {
                let first = (i64::from(at >> 15) - (1 << level) + 1) >> (level + 1);
                [first, first + 1].map(|index| index.clamp(0, side as i64 - 1) as usize)
            };
            let (columns, rows) = (taps(u, samples.width), taps(v, samples.height));
            let most = rows.iter().flat_map(|&j| columns.map(|i| samples.at(i, j))).max().unwrap_or(0);
            assert!(middle <= u32::from(most) << 8, "cells of level {level} ({u:#x}, {v:#x}): {middle} {most}");
            points += 1;
        }
    }
    assert!(points > 3_000_000, "{points}");
}

/// With the same points, a level of 2 x 2 maxima read bilinearly does fall below the map: why nodes are centred.
#[test]
fn mip_fetch_of_cells_would_not_bound_the_map() {
    let map = [0, 0, 0, 9, 0, 0, 0, 0];
    let cells = golden(8, 1, &map, Centring::Cell, [Wrap::Clamp; 2], Extremum::Max, 2).unwrap();
    // Cell 1 holds texels 2 and 3; texel 3 lies a quarter of the way to cell 2.
    let between = fetch(&cells, 1, (2 << 16) + (1 << 15), 0, Filter::Bilinear);
    assert!(between < 9 << 8, "{between}");
}

#[test]
fn mip_fetch_equals_the_texel_on_every_node() {
    for (width, height) in [(1, 1), (1, 7), (6, 1), (8, 5), (5, 8), (12, 12)] {
        let map = random_map(width * height, 5);
        for wrap in wraps(width, height) {
            let pyramid = pyramid(width, height, &map, wrap, Extremum::Max);
            for (level, samples) in pyramid.levels.iter().enumerate() {
                for (i, j) in (0..samples.width).flat_map(|i| (0..samples.height).map(move |j| (i, j))) {
                    let [u, v] = [i, j].map(|index| (index << (16 + level)) as u32);
                    for filter in [Filter::Nearest, Filter::Bilinear] {
                        assert_eq!(fetch(&pyramid, level, u, v, filter), u32::from(samples.at(i, j)) << 8);
                    }
                }
            }
        }
    }
}

#[test]
fn mip_fetch_beyond_the_map() {
    let map = random_map(8 * 4, 9);
    let wrapped = pyramid(8, 4, &map, [Wrap::Repeat, Wrap::Clamp], Extremum::Max);
    for level in 0..3 {
        for u in (0..8 << 16).step_by(997) {
            let [first, second] =
                [u, u + (8 << 16)].map(|u| fetch_checked(&wrapped, level, u, 77_777, Filter::Bilinear));
            assert_eq!(first, second);
            assert!(!first.error);
        }
        let last = wrapped.levels[level].width - 1;
        for u in [16 << 16, (1 << 29) - 1] {
            let beyond = fetch_checked(&wrapped, level, u, (1 << 29) - 1, Filter::Bilinear);
            let corner = wrapped.levels[level].at(last, wrapped.levels[level].height - 1);
            assert_eq!((beyond.value, beyond.error), (u32::from(corner) << 8, true));
        }
    }
}

/// The four texels round any point stand in four banks, or where two of them are one sample, in one place; no two
/// samples of a pyramid share a place.
#[test]
fn mip_fetch_taps_have_no_bank_conflict() {
    for (width, height) in (1..=19).flat_map(|w| (1..=19).map(move |h| (w, h))) {
        for wrap in wraps(width, height) {
            let pyramid = pyramid(width, height, &vec![0; width * height], wrap, Extremum::Max);
            let mut taken = std::collections::HashSet::new();
            for (place, level) in pyramid.layout().iter().zip(&pyramid.levels) {
                assert!(place.is_sound());
                let next = |i: usize, side: usize, wrap| match wrap {
                    Wrap::Clamp => (i + 1).min(side - 1),
                    Wrap::Repeat => (i + 1) % side,
                };
                for (i, j) in (0..level.width).flat_map(|i| (0..level.height).map(move |j| (i, j))) {
                    assert!(taken.insert(place.place(i, j)) && place.place(i, j).1 < pyramid.bank_words());
                    let (i1, j1) = (next(i, level.width, wrap[0]), next(j, level.height, wrap[1]));
                    let taps = [(i, j), (i1, j), (i, j1), (i1, j1)];
                    for (a, b) in taps.iter().flat_map(|a| taps.iter().map(move |b| (a, b))) {
                        let [place_a, place_b] = [a, b].map(|&(i, j)| place.place(i, j));
                        assert!(a == b || place_a.0 != place_b.0, "{width} x {height} {wrap:?}: {a:?} {b:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn mip_fetch_a_pyramid_of_403_x_344_fits_the_large_memory() {
    let pyramid = golden(403, 344, &vec![0; 403 * 344], Centring::Node, [Wrap::Clamp; 2], Extremum::Max, 10).unwrap();
    let samples: usize = pyramid.levels.iter().map(|level| level.samples.len()).sum();
    assert!((185_000..190_000).contains(&samples), "{samples}");
    assert!(pyramid.bank_words() as u64 <= relief_models::map::Limit::LARGEST.bank_words, "{}", pyramid.bank_words());
}

/// The memory, loaded from a layout, gives what the pyramid gives.
#[test]
fn mip_fetch_memory_equals_the_pyramid_and_says_what_it_refuses() {
    let map = random_map(12 * 7, 3);
    let both =
        [Extremum::Max, Extremum::Min].map(|extremum| pyramid(12, 7, &map, [Wrap::Repeat, Wrap::Clamp], extremum));
    let pyramids = Pyramids::from(&both);
    let pyramid = &both[0];
    let bank_words = pyramids.bank_words();
    let layout = pyramids.layout();
    assert!(!layout[0].has_minima() && layout[1..].iter().all(Placement::has_minima));
    assert_eq!(bank_words, pyramid.bank_words() + layout[1..].iter().map(Placement::words).sum::<usize>());
    let fill = |memory: &mut MipFetch| {
        pyramids.commands(0).for_each(|command| assert_eq!(memory.accept(&command), None));
    };
    let mut memory = MipFetch::new(bank_words);
    fill(&mut memory);
    let mut apart = 0;
    for k in 0..20_000u32 {
        let (level, u, v) = ((k % 5) as usize, k.wrapping_mul(0x9e37) % (24 << 16), k.wrapping_mul(0x85eb) % (9 << 16));
        for filter in [Filter::Nearest, Filter::Bilinear] {
            let [greatest, least] = [false, true].map(|minima| {
                let got = memory.accept(&Command::Fetch { level, u, v, filter, minima });
                assert_eq!(got, Some(fetch(&both[usize::from(minima)], level, u, v, filter)));
                got
            });
            assert!(least <= greatest);
            apart += u32::from(least < greatest);
        }
    }
    assert!(apart > 5_000, "{apart}");
    // Where there is one pyramid, minima are what it has.
    let mut alone = MipFetch::new(bank_words);
    Pyramids::from(pyramid).commands(0).for_each(|command| assert_eq!(alone.accept(&command), None));
    let of = |minima| Command::Fetch { level: 1, u: 1 << 17, v: 1 << 17, filter: Filter::Bilinear, minima };
    assert_eq!(alone.accept(&of(true)), alone.accept(&of(false)));
    assert!(!memory.error());
    let sound = pyramid.layout()[0];
    let size = |level, placement| Command::Size { level, placement };
    let bilinear = |u| Command::Fetch { level: 0, u, v: 0, filter: Filter::Bilinear, minima: false };
    let load = |level, minima, i, j| Command::Load { level, minima, i, j, value: 1 };
    let wrong: [(&str, Command); 9] = [
        ("a size of nothing", size(0, Placement { width: 0, ..sound })),
        ("an odd period", size(0, Placement { width: 11, ..sound })),
        ("rows that overlap", size(0, Placement { pitch: 5, ..sound })),
        ("a level left out", size(4, sound)),
        ("a column outside", load(0, false, 12, 0)),
        ("a row outside", load(1, true, 0, 4)),
        ("a level that is not there", load(2, true, 0, 0)),
        ("two periods", bilinear(24 << 16)),
        ("a fetch after a refused size", bilinear(0)),
    ];
    for (what, command) in wrong {
        let mut memory = MipFetch::new(bank_words);
        if !what.starts_with("a fetch") {
            fill(&mut memory);
        }
        assert!(!memory.error(), "{what}");
        memory.accept(&command);
        assert!(memory.error(), "{what}");
    }
    let mut short = MipFetch::new(bank_words - 1);
    fill(&mut short);
    assert!(short.error());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2_000, ..ProptestConfig::default() })]

    /// At points with 12 fraction bits at their level the error is that of one rounding; elsewhere two weights are also
    /// short by less than 2^-12.
    #[test]
    fn mip_fetch_error_bound(w in 1usize..12, h in 1usize..12, seed: u64, level in 0usize..5, u: u32, v: u32) {
        let map = random_map(w * h, seed);
        for wrap in wraps(w, h) {
            let pyramid = pyramid(w, h, &map, wrap, Extremum::Max);
            let level = level.min(pyramid.levels.len() - 1);
            let [u, v] = [(u, w, wrap[0]), (v, h, wrap[1])].map(|(x, side, wrap)| match wrap {
                Wrap::Repeat => ((x % (2 * side as u32)) << 16) | (x >> 16),
                Wrap::Clamp => x >> 3,
            });
            let real = |u: u32, v: u32| exact(&pyramid, level, f64::from(u) / 65_536.0, f64::from(v) / 65_536.0);
            let [on_u, on_v] = [u, v].map(|x| (x >> (4 + level)) << (4 + level));
            let on = f64::from(fetch(&pyramid, level, on_u, on_v, Filter::Bilinear)) / 256.0;
            prop_assert!((on - real(on_u, on_v)).abs() <= 1.0 / 512.0 + 1e-6);
            let off = f64::from(fetch(&pyramid, level, u, v, Filter::Bilinear)) / 256.0;
            prop_assert_eq!(on, off);
            prop_assert!((off - real(u, v)).abs() <= 1.0 / 512.0 + 2.0 * 65_535.0 / 4096.0);
        }
    }

    /// A texel that grows lowers no value.
    #[test]
    fn mip_fetch_is_monotone(seed: u64, at in 0usize..20, by in 1u16.., u in 0u32..5 << 16, v in 0u32..4 << 16) {
        let map = random_map(20, seed);
        let mut more = map.clone();
        more[at] = more[at].saturating_add(by);
        let [low, high] = [map, more].map(|map| pyramid(5, 4, &map, [Wrap::Clamp; 2], Extremum::Max));
        for level in 0..low.levels.len() {
            for filter in [Filter::Nearest, Filter::Bilinear] {
                prop_assert!(fetch(&low, level, u, v, filter) <= fetch(&high, level, u, v, filter));
            }
        }
    }
}
