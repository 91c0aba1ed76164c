// SPDX-License-Identifier: MIT OR Apache-2.0
//! What remeshing costs in hardware: the remesher with the strip unit behind it, base triangles back to back.
//!
//! `cargo run --release --example remesher_cycles`
//!
//! Corners are uniform in a box of the given extent, vertices have the nine components of the width set `default`. A
//! cycle without a beat of the step port is one in which the sweep waits for the set-up of the next base triangle.

use rayon::prelude::*;
use relief_hdl::widths::default;
use relief_models::remesher::BaseTriangle;
use relief_models::step::MAX_COMPONENTS;
use relief_testbench::binding::Random;
use relief_testbench::remesh::{Chain, Counts};
use relief_testbench::remesher::beat_of;

/// Extent of the box, in voxels, and base triangles.
const ROWS: [(u64, usize); 5] = [(4, 1_000), (8, 1_000), (16, 1_000), (64, 1_000), (128, 1_000)];

fn main() {
    let rows: Vec<_> = ROWS.into_par_iter().with_max_len(1).map(|(extent, bases)| measure(extent, bases)).collect();
    println!(
        "| px | base triangles | triangles | cycles | cycles per two triangles | vertices sent per triangle | cycles without a beat | share |"
    );
    println!("|---:|---:|---:|---:|---:|---:|---:|---:|");
    let mut failed = false;
    for ((extent, bases), row) in ROWS.into_iter().zip(rows) {
        match row {
            Err(error) => {
                eprintln!("error: {extent} px: {error}");
                failed = true;
            }
            Ok(counts) => println!(
                "| {extent} | {bases} | {} | {} | {:.2} | {:.3} | {} | {:.1} % |",
                counts.triangles,
                counts.cycles,
                counts.cycles_per_two_triangles(),
                counts.sent_per_triangle(),
                counts.silent(),
                100.0 * counts.silent() as f64 / counts.cycles as f64,
            ),
        }
    }
    if failed {
        std::process::exit(1);
    }
}

fn measure(extent: u64, bases: usize) -> Result<Counts, String> {
    let set = default::SET;
    let mut random = Random::new(extent);
    let bases = std::iter::repeat_with(|| {
        let corners = std::array::from_fn(|_| std::array::from_fn(|_| random.below(extent + 1) as i32));
        let mut data = [[0; MAX_COMPONENTS]; 3];
        for vertex in &mut data {
            vertex[..set.components].iter_mut().for_each(|value| *value = random.signed(set.vertex_bits));
        }
        beat_of(&set, &BaseTriangle { corners, data })
    })
    .take(bases);
    Chain::new(&set).run(bases, &mut |_| Ok(())).map_err(|error| error.to_string())
}
