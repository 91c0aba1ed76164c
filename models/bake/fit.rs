// SPDX-License-Identifier: MIT OR Apache-2.0
//! Split maps with fitted heights.

mod fabric;
mod grow;
mod moves;
mod patch;
mod shapes;
mod windows;

use fabric::Fabric;
pub use windows::Effort;

use super::{Ground, Tolerance};
use crate::bisector::SplitMap;

/// A split map and the heights that keep its bound.
pub struct Fitted {
    /// The split map.
    pub split: SplitMap,
    /// Heights in 1/16, one a sample.
    pub heights: Vec<u32>,
}

/// Fits.
pub fn fitted(ground: &Ground<'_>, tolerance: Tolerance, effort: Effort) -> Fitted {
    let fabric = Fabric::new(*ground, tolerance);
    let now = std::time::Instant::now();
    windows::need(&fabric);
    eprintln!("needed {} in {:?}", fabric.count(), now.elapsed());
    if std::env::var("START").is_ok() {
        let u = super::unfitted(ground, Tolerance { over: (tolerance.over as f64 * std::env::var("START").unwrap().parse::<f64>().unwrap()) as u32, ..tolerance });
        for v in 0..=ground.lattice.side() { for w in 0..=ground.lattice.side() { if u.get(ground.lattice.index([w, v])) { fabric.set_split([w, v], true); } } }
        eprintln!("started {} in {:?}", fabric.count(), now.elapsed());
    } 
    grow::grow(&fabric);
    eprintln!("grown {} in {:?}", fabric.count(), now.elapsed());
    windows::reduce(&fabric, effort);
    eprintln!("done {} in {:?}", fabric.count(), now.elapsed());
    fabric.finish()
}
