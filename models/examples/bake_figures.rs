// SPDX-License-Identifier: MIT OR Apache-2.0
//! The figures of docs/bake.md: triangles and seconds of the preparation of a map.
//!
//! `cargo run --release -p relief-models --example bake_figures [-- MAP BOUND [ROUNDS...]]`

use std::time::Instant;

use relief_models::bake::{Ground, Tolerance, fitted, fitted_from_best_corner, flip, measure, saturated, unfitted};
use relief_models::bisector::{Lattice, MAX_SIDE};
use relief_models::map::read_values;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let name = arguments.first().map_or("scenes/maps/jacksboro.png", String::as_str);
    let bound: Tolerance = arguments.get(1).map_or("1310.7", String::as_str).parse()?;
    let mut rounds = arguments.iter().skip(2).map(|text| text.parse()).collect::<Result<Vec<u32>, _>>()?;
    if rounds.is_empty() {
        rounds = vec![0, 1, 8, 48];
    }
    let (map, _) = read_values(name.as_ref(), MAX_SIDE)?;
    let lattice = Lattice::of(map.width as u32, map.height as u32, false).ok_or("the map is no map")?;
    let ground = Ground { lattice, samples: &map.samples };
    println!("{name}, {} x {}, bound {bound}, {} threads", map.width, map.height, rayon::current_num_threads());
    println!("| heights | triangles | largest error | s |\n|---|---:|---:|---:|");
    let begun = Instant::now();
    let split = unfitted(&ground, bound);
    let seconds = begun.elapsed().as_secs_f64();
    let plain: Vec<u32> = map.samples.iter().map(|&sample| u32::from(sample) << 4).collect();
    let measured = measure(&ground, &split, &plain);
    println!("| the map's | {} | {:.4} | {seconds:.3} |", measured.triangles, measured.maximum.to_f64());
    for effort in rounds {
        let begun = Instant::now();
        let (flipped, fit) = if effort > 1 {
            fitted_from_best_corner(&map, &ground, bound, effort, &())
        } else {
            ([false; 2], fitted(&ground, bound, effort, &()))
        };
        let seconds = begun.elapsed().as_secs_f64();
        let samples = flip(&map.samples, map.width, flipped);
        let measured = measure(&Ground { samples: &samples, ..ground }, &fit.split, &fit.heights);
        let (triangles, maximum) = (measured.triangles, measured.maximum.to_f64());
        println!("| fitted, {effort} rounds | {triangles} | {maximum:.4} | {seconds:.1} |");
    }
    let begun = Instant::now();
    let errors = saturated(&ground, &());
    println!("errors in units of 2^-{} in {:.3} s", errors.fraction_bits, begun.elapsed().as_secs_f64());
    Ok(())
}
