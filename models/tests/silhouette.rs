// SPDX-License-Identifier: MIT OR Apache-2.0
//! Horizons of height maps under filters.

use relief_models::filters::Filter;
use relief_models::map::{HeightMap, read_values};
use relief_models::mip_build::Wrap;
use relief_models::silhouette::{Horizon, SilhouetteError, View, levels};
use std::path::Path;

const WRAP: [Wrap; 2] = [Wrap::Clamp; 2];

fn horizon(map: &HeightMap, filter: Filter, step: u32) -> Horizon {
    let pyramid = filter.pyramid(map, WRAP, levels(map, WRAP, step)).unwrap();
    View::new(map, filter, &pyramid, step).unwrap().horizon()
}

fn jacksboro() -> HeightMap {
    read_values(Path::new("../scenes/maps/jacksboro.png"), 4096).unwrap().0
}

/// The default filter, on a terrain: no worse than 1.5, 2.5 and 4.4 % of the relief, and no other keeps more of the peaks.
#[test]
fn silhouette_of_the_default_filter_is_the_best_on_terrain() {
    let map = jacksboro();
    for (step, most) in [(5, 1.5), (10, 2.5), (20, 4.4)] {
        let default = horizon(&map, Filter::NodeMax, step);
        assert!(default.rms <= most, "{step}: {default:?}");
        for filter in [Filter::Point, Filter::Average, Filter::Median, Filter::Variational] {
            let other = horizon(&map, filter, step);
            assert!(other.rms > default.rms && other.peak_loss > default.peak_loss, "{step} {filter:?}: {other:?}");
        }
        // The paper's levels, of 2 x 2 texels, are as good in the mean, and lose more of the peaks.
        let paper = horizon(&map, Filter::CellMax, step);
        assert!(paper.peak_loss > default.peak_loss, "{step}: {paper:?}");
    }
}

/// What is lost from below is what is lost of the map turned over.
#[test]
fn silhouette_from_below_is_that_of_the_map_turned_over() {
    let map = jacksboro();
    let turned = HeightMap { samples: map.samples.iter().map(|sample| 65535 - sample).collect(), ..map.clone() };
    for (lower, upper) in [(Filter::NodeMin, Filter::NodeMax), (Filter::CellMin, Filter::CellMax)] {
        let [a, b] = [horizon(&map, lower, 7), horizon(&turned, upper, 7)];
        for (a, b) in [(a.rms, b.rms), (a.mean, b.mean), (a.peak_loss, b.peak_loss), (a.deepest, b.deepest)] {
            // Halves round up both ways.
            assert!((a - b).abs() < 1e-5, "{lower:?}: {a} {b}");
        }
    }
}

#[test]
fn silhouette_of_what_is_flat_or_whole_has_no_error() {
    let flat = HeightMap { width: 50, height: 41, samples: vec![7; 50 * 41] };
    for filter in Filter::ALL {
        for step in [1, 2, 5, 20] {
            let found = horizon(&flat, filter, step);
            assert_eq!([found.rms, found.mean, found.peak_loss, found.deepest], [0.0; 4], "{filter:?} {step}");
        }
    }
    // At a step of one texel every filter reads the map.
    let map = jacksboro();
    for filter in Filter::ALL {
        let found = horizon(&map, filter, 1);
        assert_eq!((found.level, found.rms), (0, 0.0), "{filter:?}");
    }
}

/// A ridge of one texel, 31, between the vertices at 24 and 34: points lose it, means keep little. Of maxima at nodes 28, 32
/// and 36 the first two hold it, and the vertex at 34 is read halfway to the third.
#[test]
fn silhouette_of_a_ridge_between_vertices() {
    let samples = (0..64 * 64).map(|at| if at % 64 == 31 { 60_000 } else { 0 }).collect();
    let map = HeightMap { width: 64, height: 64, samples };
    let pyramid = |filter: Filter| filter.pyramid(&map, WRAP, levels(&map, WRAP, 10)).unwrap();
    let highest = |filter: Filter| {
        let pyramid = pyramid(filter);
        let profile = View::new(&map, filter, &pyramid, 10).unwrap().profile(0, 4);
        assert_eq!((profile.first, profile.map.len()), (4, 50));
        assert_eq!(profile.map[27], 60_000.0);
        profile.mesh.iter().copied().fold(0.0, f64::max)
    };
    assert_eq!(highest(Filter::Point), 0.0);
    assert_eq!(highest(Filter::NodeMax), 30_000.0);
    let average = highest(Filter::Average);
    assert!((1_000.0..15_000.0).contains(&average), "{average}");
}

#[test]
fn silhouette_refuses_grids_without_cells() {
    let map = HeightMap { width: 39, height: 100, samples: vec![0; 3900] };
    let pyramid = Filter::Point.pyramid(&map, WRAP, 1).unwrap();
    let refused = |step| View::new(&map, Filter::Point, &pyramid, step).unwrap_err();
    assert_eq!(refused(0), SilhouetteError::NoStep);
    assert_eq!(
        refused(20).to_string(),
        "the map has 39 x 100 samples, and a grid of 20 texels needs at least 40 on each side"
    );
    assert!(View::new(&map, Filter::Point, &pyramid, 19).is_ok());
}
