// SPDX-License-Identifier: MIT OR Apache-2.0
//! Filters of height maps: means, extrema, and levels of least volume.

use proptest::prelude::*;
use relief_models::filters::{Filter, variational};
use relief_models::map::{HeightMap, read_values};
use relief_models::mip_build::{Centring, Level, Wrap, max_levels};
use std::path::Path;

/// A small map whose repeat axes have even periods, with the levels that it can have.
fn small_map() -> impl Strategy<Value = (HeightMap, [Wrap; 2], usize)> {
    let side = |wrap: Wrap| match wrap {
        Wrap::Clamp => (1usize..14).boxed(),
        Wrap::Repeat => (1usize..4).prop_map(|eighths| 4 * eighths).boxed(),
    };
    let wrap = || prop_oneof![Just(Wrap::Clamp), Just(Wrap::Repeat)];
    (wrap(), wrap())
        .prop_flat_map(move |(u, v)| (Just([u, v]), side(u), side(v)))
        .prop_flat_map(|(wrap, width, height)| {
            let height_of = prop_oneof![Just(0u16), Just(65535), 0..400u16, any::<u16>()];
            (Just(wrap), Just(width), Just(height), prop::collection::vec(height_of, width * height))
        })
        .prop_map(|(wrap, width, height, samples)| {
            let levels = max_levels(width, height, Centring::Node, wrap).min(4);
            (HeightMap { width, height, samples }, wrap, levels)
        })
}

proptest! {
    #[test]
    fn filters_keep_their_order((map, wrap, levels) in small_map()) {
        let pyramid = |filter: Filter| filter.pyramid(&map, wrap, levels);
        let levels_of = |filter: Filter| pyramid(filter).unwrap().levels;
        if let (Ok(least), Ok(mean), Ok(most)) = (pyramid(Filter::CellMin), pyramid(Filter::Average), pyramid(Filter::CellMax)) {
            for level in 0..levels {
                for ((least, mean), most) in least.levels[level].samples.iter().zip(&mean.levels[level].samples).zip(&most.levels[level].samples) {
                    prop_assert!(least <= mean && mean <= most);
                }
            }
        }
        let [least, most] = [Filter::NodeMin, Filter::NodeMax].map(levels_of);
        for filter in [Filter::Median, Filter::Variational] {
            for (level, between) in levels_of(filter).iter().enumerate() {
                prop_assert_eq!((between.width, between.height), (least[level].width, least[level].height));
                for (at, height) in between.samples.iter().enumerate() {
                    let sound = least[level].samples[at] <= *height && *height <= most[level].samples[at];
                    prop_assert!(sound, "{filter:?} level {level}, sample {at}");
                }
            }
        }
    }

    #[test]
    fn filters_descend_below_the_means((map, wrap, levels) in small_map()) {
        for level in 1..levels {
            let volume = |level_of: &Level| {
                let heights: Vec<f64> = level_of.samples.iter().map(|height| f64::from(*height)).collect();
                variational::volume(&map, wrap, level, &heights).0
            };
            let least = volume(&variational::descend(&map, wrap, level));
            prop_assert!(least <= volume(&variational::start(&map, wrap, level)));
            prop_assert!(least <= volume(&variational::median(&map, wrap, level)));
        }
    }

    /// The derivative is the slope of the volume, by central differences.
    #[test]
    fn filters_volume_has_its_derivative((map, wrap, levels) in small_map(), seed in any::<u32>()) {
        let level = levels.saturating_sub(1).clamp(1, 2);
        if level >= levels { return Ok(()); }
        let start = variational::start(&map, wrap, level);
        // Off the samples, where the volume has corners.
        let mut heights: Vec<f64> = start.samples.iter().enumerate().map(|(at, height)| {
            f64::from(*height) + 37.0 * ((at as f64 + f64::from(seed % 1000)) * 1.618).fract() + 0.123
        }).collect();
        let (_, derivative) = variational::volume(&map, wrap, level, &heights);
        for at in 0..heights.len() {
            let mut moved = |by: f64| {
                heights[at] += by;
                let volume = variational::volume(&map, wrap, level, &heights).0;
                heights[at] -= by;
                volume
            };
            let slope = (moved(1e-3) - moved(-1e-3)) / 2e-3;
            prop_assert!((slope - derivative[at]).abs() <= 1e-3 * (1.0 + slope.abs()), "node {at}: {slope} {}", derivative[at]);
        }
    }

    /// The integral in closed form is that of a fine subdivision.
    #[test]
    fn filters_absolute_is_the_integral(corners in prop::array::uniform3(-100.0..100.0f64)) {
        const PARTS: usize = 300;
        let [a, b, c] = corners;
        let (mut sum, mut count) = (0.0, 0);
        for i in 0..PARTS {
            for j in 0..PARTS - i {
                for (third, is_there) in [(1.0 / 3.0, true), (2.0 / 3.0, i + j + 1 < PARTS)] {
                    if is_there {
                        let [s, t] = [i, j].map(|at| (at as f64 + third) / PARTS as f64);
                        sum += (a + s * (b - a) + t * (c - a)).abs();
                        count += 1;
                    }
                }
            }
        }
        let mean = sum / f64::from(count);
        prop_assert!((variational::absolute(corners).0 - mean).abs() < 0.01, "{mean}");
    }
}

#[test]
fn filters_of_the_example() {
    let map = HeightMap { width: 4, height: 1, samples: vec![1, 5, 2, 0] };
    let level = |filter: Filter| filter.pyramid(&map, [Wrap::Clamp; 2], 2).unwrap().levels[1].samples.clone();
    assert_eq!(level(Filter::Average), [3, 1]);
    assert_eq!(level(Filter::CellMax), [5, 2]);
    assert_eq!(level(Filter::NodeMax), [5, 5, 0]);
    assert_eq!(level(Filter::CellMin), [1, 0]);
}

/// Cells are read half a cell later: a ramp stays what it is, whatever the level, away from the borders.
#[test]
fn filters_read_cells_in_their_middle() {
    let map = HeightMap { width: 64, height: 64, samples: (0..64 * 64).map(|at| 1000 * (at % 64) as u16).collect() };
    let pyramid = Filter::Average.pyramid(&map, [Wrap::Clamp; 2], 4).unwrap();
    for level in 0..4 {
        for u in 10..50 {
            assert_eq!(Filter::Average.at(&pyramid, level, [u << 16, 20 << 16]), 256_000 * u, "level {level}");
        }
    }
}

#[test]
fn filters_take_the_level_of_a_step() {
    let levels = |filter: Filter| [1, 2, 5, 10, 20].map(|step| filter.level(step));
    assert_eq!(levels(Filter::Point), [0; 5]);
    assert_eq!(levels(Filter::Average), [0, 1, 2, 3, 4]);
    assert_eq!(levels(Filter::NodeMax), [0, 0, 1, 2, 3]);
}

/// Equation 12 keeps about 70 % of the volume of the means, as the paper says.
#[test]
fn filters_variational_keeps_70_percent_of_the_volume() {
    let (map, _) = read_values(Path::new("../scenes/maps/jacksboro.png"), 4096).unwrap();
    let wrap = [Wrap::Clamp; 2];
    for level in 1..4 {
        let volume = |level_of: Level| {
            let heights: Vec<f64> = level_of.samples.iter().map(|height| f64::from(*height)).collect();
            variational::volume(&map, wrap, level, &heights).0
        };
        let start = volume(variational::start(&map, wrap, level));
        let [median, least] =
            [variational::median, variational::descend].map(|way| volume(way(&map, wrap, level)) / start);
        println!("level {level}: median {median:.3}, variational {least:.3} of the volume of the means");
        assert!(least <= median && median < 0.85 && least < 0.8, "level {level}: {median} {least}");
    }
}
