// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fills the samples that say nothing.
//!
//! In rounds: every void sample with a known one above, below, left or right becomes the mean of those (rounded half up),
//! all of a round at once. So a void is filled from its rim inwards, whatever the order of the samples.

use crate::map::HeightMap;

/// What was filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filled {
    /// Samples.
    pub samples: usize,
    /// Rounds: the depth of the deepest void.
    pub rounds: usize,
}

/// Fills the samples of the value `void`; `None` when there is no other one.
pub fn fill(map: &mut HeightMap, void: u16) -> Option<Filled> {
    let [width, height] = [map.width, map.height];
    let mut known: Vec<bool> = map.samples.iter().map(|&sample| sample != void).collect();
    let samples = known.iter().filter(|known| !**known).count();
    if samples == known.len() {
        return None;
    }
    let around = |index: usize| {
        let [x, y] = [index % width, index / width];
        let sides = [(x > 0, -1), (x + 1 < width, 1), (y > 0, -(width as isize)), (y + 1 < height, width as isize)];
        sides.into_iter().filter(|(inside, _)| *inside).map(move |(_, step)| index.wrapping_add_signed(step))
    };
    let mut front: Vec<usize> = (0..known.len()).filter(|&at| !known[at] && around(at).any(|at| known[at])).collect();
    let mut rounds = 0;
    while !front.is_empty() {
        rounds += 1;
        let mean = |&index: &usize| {
            let (sum, count) = around(index)
                .filter(|&at| known[at])
                .fold((0, 0), |(sum, count), at| (sum + u32::from(map.samples[at]), count + 1));
            ((2 * sum + count) / (2 * count)) as u16
        };
        let values: Vec<u16> = front.iter().map(mean).collect();
        for (&index, value) in front.iter().zip(values) {
            map.samples[index] = value;
            known[index] = true;
        }
        let mut next: Vec<usize> = front.iter().flat_map(|&at| around(at)).filter(|&at| !known[at]).collect();
        next.sort_unstable();
        next.dedup();
        front = next;
    }
    Some(Filled { samples, rounds })
}
