// SPDX-License-Identifier: MIT OR Apache-2.0
//! Silhouettes that tremble: measured against a fine mesh, larger with larger voxels, none for a camera at rest.

use glam::DVec3;
use relief_models::remesher::Format;
use relief_models::rules::ExtremumRule;
use relief_models::scene::{Scene, parse};
use relief_models::wagging::{Path, Wagging, measure};

const FORMAT: Format =
    Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 14, column_depth: 4096 };

fn grazing() -> Scene {
    let text = "[camera]\neye = [0, -2.2, 0.55]\ntarget = [0, 0, 0.2]\nnear = 0.2\nfar = 40\nviewport = [160, 120]\n[remesh]\n\
                cell_px = 2\n[[object]]\nmesh = { kind = \"grid\", cells = [6, 6], size = [2, 2] }\nmap = { file = \
                \"maps/jacksboro.png\" }\ndisplacement = [0, 0.35]\n";
    parse(text, "scene", &std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")).unwrap()
}

#[test]
fn wagging_grows_with_voxels_and_rests_with_the_camera() {
    let scene = grazing();
    let moving = Path { frames: 6, step: DVec3::new(0.01, 0.0, 0.0) };
    let cells = [2.0, 5.0, 10.0];
    let found = measure(&scene, &moving, &cells, &FORMAT, &()).unwrap();
    println!("{found:#?}");
    assert_eq!(found.len(), 6);
    let of = |cell: f64, filtered: bool| -> Wagging {
        *found.iter().find(|row| (row.cell_px, row.filtered) == (cell, filtered)).unwrap()
    };
    for filtered in [false, true] {
        let rows = cells.map(|cell| of(cell, filtered));
        assert!(rows.is_sorted_by(|a, b| a.error < b.error && a.wagging < b.wagging), "{rows:?}");
        assert!(rows.iter().all(|row| row.wagging > 0.0 && row.jump >= row.wagging), "{rows:?}");
    }
    // Samples lose peaks (Y grows downwards), maxima keep them.
    assert!(of(10.0, false).mean > of(10.0, true).mean);
    let resting = measure(&scene, &Path { step: DVec3::ZERO, ..moving }, &cells[..1], &FORMAT, &()).unwrap();
    assert!(resting.iter().all(|row| row.wagging == 0.0 && row.jump == 0.0 && row.error > 0.0), "{resting:?}");
    // Minima lie lower than maxima, and what is not filtered knows no rule.
    let mut lower = scene.clone();
    lower.remesh.rules.extremum = ExtremumRule::Min;
    let [maxima, minima] = [&scene, &lower].map(|scene| measure(scene, &moving, &[10.0], &FORMAT, &()).unwrap());
    assert!(minima[0] == maxima[0] && minima[1].mean > maxima[1].mean, "{minima:?} {maxima:?}");
    // The reference itself has no error.
    let same = measure(&scene, &moving, &[2.0, 4.0], &FORMAT, &()).unwrap();
    assert_eq!(of(2.0, false), same[0]);
}
