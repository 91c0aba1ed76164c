// SPDX-License-Identifier: MIT OR Apache-2.0
//! Regular grids: whole cover, heights of the map, as many triangles as asked for.

use proptest::prelude::*;
use relief_models::map::{HeightMap, Procedural};
use relief_models::measure::heights;
use relief_models::uniform::{GridError, with_step, with_triangles};

fn ramp(width: usize, height: usize) -> HeightMap {
    HeightMap::procedural(Procedural::Ramp, width, height)
}

#[test]
fn uniform_counts_cells_of_a_step() {
    let map = ramp(344, 403);
    for (step, cells) in [(1, 343 * 402), (2, 172 * 201), (7, 49 * 58), (402, 1), (5000, 1)] {
        assert_eq!(with_step(&map, step).unwrap().triangles.len(), 2 * cells, "{step}");
    }
}

#[test]
fn uniform_comes_near_the_number_of_triangles() {
    // (asked for, made): a prime number of cells is no reason for slivers.
    for (asked, made) in [(2, 2), (3, 2), (30_372, 30_368), (1_000_000_000, 2 * 343 * 402), (usize::MAX, 2 * 343 * 402)]
    {
        assert_eq!(with_triangles(&ramp(344, 403), asked).unwrap().triangles.len(), made, "{asked}");
    }
}

#[test]
fn uniform_refuses_what_has_no_grid() {
    assert_eq!(with_step(&ramp(4, 4), 0), Err(GridError::Step));
    assert_eq!(with_triangles(&ramp(4, 4), 1), Err(GridError::Triangles(1)));
    for map in [ramp(1, 9), ramp(9, 1), ramp(1, 1)] {
        let error = GridError::Map { width: map.width, height: map.height };
        assert_eq!((with_step(&map, 2), with_triangles(&map, 9)), (Err(error), Err(error)));
    }
}

proptest! {
    #[test]
    fn uniform_covers_every_map(width in 2usize..80, height in 2usize..80, number in 1usize..5000, by_step: bool) {
        let map = HeightMap::procedural(Procedural::Peaks, width, height);
        let mesh = if by_step { with_step(&map, number % 90 + 1) } else { with_triangles(&map, number + 1) }.unwrap();
        let found = heights(&mesh, &map, &()).unwrap();
        prop_assert!(found.is_whole() && found.inconsistent_edges == 0 && found.several_heights == 0);
        prop_assert!(found.off_lattice == 0 && found.vertices == mesh.positions.len());
        for [x, y, z] in &mesh.positions {
            prop_assert_eq!(*z, f64::from(map.sample(*x as usize, *y as usize)));
        }
        if !by_step {
            let (made, asked) = (mesh.triangles.len(), number + 1);
            let whole = 2 * (width - 1) * (height - 1);
            prop_assert!(made <= asked);
            // Unless a short side has too few cells to choose from.
            prop_assert!(width.min(height) < 40 || 10 * made >= 7 * asked.min(whole), "{} of {}", made, asked);
        }
    }
}
