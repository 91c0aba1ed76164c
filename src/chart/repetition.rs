// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a map repeats itself: how far the difference of a map and its shifted self falls again after it rose.
//!
//! ```text
//! D(d)       = mean of (z(x + d) - z(x))^2 over the map,  d = 0 to half the side
//! repetition = greatest (D(a) - D(b)) / greatest D,       a < b
//! ```
//!
//! Land differs the more the farther one goes, so D rises and stays: about 0. A pattern is itself again after a period,
//! so D falls to 0 there: 1.

use rayon::prelude::*;
use relief_models::map::HeightMap;

/// From here on a map counts as a repeating pattern.
pub const THRESHOLD: f64 = 0.7;

/// What is found along one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repetition {
    /// From 0, no repetition, to 1, a pattern that comes back exactly.
    pub strength: f64,
    /// The shift with the least difference behind the rise, in samples; of any use only where the strength is high.
    pub period: usize,
}

/// Along the rows and along the columns.
pub fn repetition(map: &HeightMap) -> [Repetition; 2] {
    let rows = differences([map.width, map.height], |i, j| map.sample(i, j));
    let columns = differences([map.height, map.width], |j, i| map.sample(i, j));
    [greatest_fall(&rows), greatest_fall(&columns)]
}

/// D for each shift along the first axis. Of a large map some lines tell enough.
fn differences([length, lines]: [usize; 2], sample: impl Fn(usize, usize) -> u16 + Sync) -> Vec<f64> {
    let step = lines.div_ceil(512);
    let shifts = 0..=length / 2;
    let difference = |shift: usize| {
        let pairs = (0..lines).step_by(step).flat_map(|line| (0..length - shift).map(move |at| (at, line)));
        let sum: u64 = pairs
            .map(|(at, line)| u64::from(sample(at + shift, line).abs_diff(sample(at, line))))
            .map(|difference| difference * difference)
            .sum();
        sum as f64 / ((length - shift) * lines.div_ceil(step)) as f64
    };
    shifts.into_par_iter().map(difference).collect()
}

fn greatest_fall(differences: &[f64]) -> Repetition {
    let most = differences.iter().copied().fold(0.0, f64::max);
    let highest = differences.iter().scan(0.0, |highest, &difference| {
        *highest = f64::max(*highest, difference);
        Some(*highest)
    });
    let falls: Vec<f64> = highest.zip(differences).map(|(highest, difference)| highest - difference).collect();
    let fall = falls.iter().copied().fold(0.0, f64::max);
    // Every multiple of a period falls as far, or a little farther: the first valley that is nearly as deep.
    let begin = falls.iter().position(|other| *other >= 0.9 * fall).unwrap_or_default();
    let downhill = differences[begin..].windows(2).take_while(|pair| pair[1] < pair[0]).count();
    Repetition { strength: if most > 0.0 { fall / most } else { 0.0 }, period: begin + downhill }
}

#[cfg(test)]
mod tests {
    use super::{THRESHOLD, repetition};
    use relief_models::map::{HeightMap, Procedural, read};
    use std::path::Path;

    /// Every formula, and the land of the repository, on its side of the threshold and well away from it.
    #[test]
    fn repetition_tells_patterns_from_land() {
        use Procedural::{Checkerboard, Cosine, Dents, Waves};
        for side in [65, 257, 300] {
            for kind in Procedural::ALL {
                let map = HeightMap::procedural(kind, side, side);
                let [x, y] = repetition(&map).map(|axis| axis.strength);
                let (along_x, along_y) =
                    (matches!(kind, Checkerboard | Cosine | Dents | Waves), matches!(kind, Checkerboard | Dents));
                for (strength, repeats) in [(x, along_x), (y, along_y)] {
                    let expected = if repeats { THRESHOLD + 0.2..=1.0 } else { 0.0..=THRESHOLD - 0.2 };
                    assert!(expected.contains(&strength), "{kind:?} {side}: {x} {y}");
                }
            }
        }
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/maps/jacksboro.png");
        let (map, _) = read(&path, &|_| Ok(())).unwrap();
        assert!(repetition(&map).iter().all(|axis| axis.strength < 0.1), "{:?}", repetition(&map));
    }

    #[test]
    fn repetition_finds_the_first_period() {
        let of = |kind, width, height| repetition(&HeightMap::procedural(kind, width, height));
        assert_eq!(of(Procedural::Dents, 257, 129).map(|axis| axis.period), [32, 16]);
        assert_eq!(of(Procedural::Waves, 161, 9)[0].period, 20);
        // Two squares; and a plane, and maps with next to no shifts.
        assert_eq!(of(Procedural::Checkerboard, 64, 64).map(|axis| axis.period), [16, 16]);
        let plane = HeightMap { width: 2, height: 3, samples: vec![7; 6] };
        assert!(repetition(&plane).iter().all(|axis| axis.strength == 0.0));
    }
}
