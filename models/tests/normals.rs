// SPDX-License-Identifier: MIT OR Apache-2.0
//! Normals of faces and of gradients beside those of the land.

use relief_models::map::{HeightMap, Wrap, read_values};
use relief_models::normals::{Angles, Land, NormalsError, Shading};
use relief_models::silhouette::levels;
use std::path::Path;

const WRAP: [Wrap; 2] = [Wrap::Clamp; 2];

fn angles(land: &Land<'_>, map: &HeightMap, shading: Shading, step: u32) -> Angles {
    let pyramid = shading.filter().pyramid(map, WRAP, levels(map, WRAP, step)).unwrap();
    land.angles(shading, &pyramid, step).unwrap()
}

/// Jacksboro in its true size: faces are better at a texel; from two texels on, gradients of means are better than all, and those
/// of maxima are no better than the faces of the same maxima.
#[test]
fn normals_of_a_terrain_in_its_true_size() {
    let map = read_values(Path::new("../scenes/maps/jacksboro.png"), 4097).unwrap().0;
    let land = Land::new(&map, [29.9, 31.9], 0.84).unwrap();
    for step in [1, 2, 4, 8, 16] {
        let [point, max, average, gradient] = Shading::ALL.map(|shading| angles(&land, &map, shading, step).rms);
        println!("{step:2}: {point:.2} {max:.2} {average:.2} {gradient:.2}");
        assert!([point, max, average, gradient].iter().all(|rms| (2.0..8.0).contains(rms)), "{step}");
        if step == 1 {
            // One level, and so one surface.
            assert!(point == max && average == gradient && max < 0.9 * average);
        } else {
            assert!(average < max && max <= point, "{step}");
        }
        assert!(step == 1 || gradient > 0.98 * max, "{step}");
    }
}

/// A plane, which every filter but the maxima keeps, and these keep all but the height of: no angle but that of rounding.
#[test]
fn normals_of_a_plane_are_its_own() {
    let (width, height) = (90, 80);
    let samples = (0..width * height).map(|at| (320 * (at % width) + 256 * (at / width)) as u16).collect();
    let map = HeightMap { width, height, samples };
    // 320 units a texel of 2 and 256 a texel of 1, in either of two sizes, uphill and down.
    for (scale, relief) in [(1.0, 65535.0 / 256.0), (1e-3, -65.535 / 256.0)] {
        let land = Land::new(&map, [2.0 * scale * 89.0, scale * 79.0], relief).unwrap();
        for shading in Shading::ALL {
            for step in [1, 2, 5, 10] {
                let found = angles(&land, &map, shading, step);
                // The golden model keeps to 5.6e-5 rad; a mean of samples is rounded.
                let most = if shading == Shading::GradientAverage { 0.05 } else { 0.004 };
                assert!(found.most < most && found.rms <= found.most, "{shading:?} {step}: {found:?}");
            }
        }
    }
}

#[test]
fn normals_refuse_what_has_no_room_or_is_too_steep() {
    let map = HeightMap { width: 50, height: 90, samples: vec![7; 4500] };
    let pyramid = Shading::FacePoint.filter().pyramid(&map, WRAP, 1).unwrap();
    let land = Land::new(&map, [49.0, 89.0], 1.0).unwrap();
    assert_eq!(land.angles(Shading::FacePoint, &pyramid, 15).map(|angles| angles.rms), Ok(0.0));
    let refused = |step| land.angles(Shading::FacePoint, &pyramid, step).unwrap_err();
    assert_eq!(refused(0), NormalsError::NoStep);
    assert_eq!(
        refused(16).to_string(),
        "the map has 50 x 90 samples, and a grid of 16 texels needs at least 51 on each side"
    );
    let steep = Land::new(&map, [49.0, 89.0], 2e5).unwrap_err().to_string();
    assert_eq!(steep, "a range of heights of 200000 over texels of 1 is too steep; at most 62258.2 is expected");
    assert!(Land::new(&map, [49.0, 89.0], 62258.0).is_ok());
}

/// Not every texel of a large map has a vertex, and the figures are those of a part of it.
#[test]
fn normals_of_a_large_map_are_those_of_a_part() {
    let (width, height) = (1600, 1500);
    let wave = |at: usize| 3000.0 * ((at % width) as f64 / 9.0).sin() + 2000.0 * ((at / width) as f64 / 13.0).sin();
    let samples = (0..width * height).map(|at| (20_000.0 + wave(at)) as u16).collect();
    let map = HeightMap { width, height, samples };
    let part =
        HeightMap { width: 400, height: 400, samples: (0..160_000).map(|at| map.sample(at % 400, at / 400)).collect() };
    let size = |map: &HeightMap| [(map.width - 1) as f64, (map.height - 1) as f64];
    for shading in Shading::ALL {
        let [whole, part] =
            [&map, &part].map(|map| angles(&Land::new(map, size(map), 100.0).unwrap(), map, shading, 4).rms);
        assert!((whole / part - 1.0).abs() < 0.05, "{shading:?}: {whole} {part}");
    }
}
