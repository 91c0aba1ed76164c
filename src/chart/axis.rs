// SPDX-License-Identifier: MIT OR Apache-2.0
//! Logarithmic axes: where they begin and end, their ticks, and what stands at them.

/// How numbers are written at ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Counts: 500, 20k, 3M.
    Count,
    /// Percent: 0.02 %.
    Percent,
    /// Times: 20 ms.
    Seconds,
}

/// A logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Where it begins; more than 0.
    pub low: f64,
    /// Where it ends; more than `low`.
    pub high: f64,
    /// What stands for values that have no logarithm.
    pub floor: Option<f64>,
}

/// The finest that is told apart from 0 beside the other values.
const FLOOR: f64 = 1e-9;

impl Axis {
    /// Holds all values with some space around. Those that are 0, or too small to matter, stand at the lower end.
    pub fn over(values: impl Iterator<Item = f64> + Clone) -> Axis {
        let most = values.clone().filter(|value| value.is_finite()).fold(0.0, f64::max);
        let least = most * FLOOR;
        let is_tiny = |value: &f64| *value <= least;
        let lowest = values.clone().filter(|value| value.is_finite() && !is_tiny(value)).fold(f64::INFINITY, f64::min);
        let has_floor = values.clone().any(|value| is_tiny(&value));
        let (low, high) = if lowest.is_finite() { (lowest, most) } else { (1.0, 1.0) };
        // A third of a decade below everything else.
        let (low, floor) = if has_floor { (low / 2.0, Some(low / 2.0)) } else { (low, None) };
        let space = (high / low).powf(0.06).max(1.06);
        Axis { low: low / space, high: high * space, floor }
    }

    /// Where a value stands, from 0 at the beginning to 1 at the end.
    pub fn at(&self, value: f64) -> f64 {
        let value = self.floor.map_or(value, |floor| value.max(floor));
        ((value / self.low).ln() / (self.high / self.low).ln()).clamp(0.0, 1.0)
    }

    /// Round numbers, at least `gap` of the axis apart: steps of one size where the axis is short, else 1, 2 and 5 of each
    /// decade, decades, or every so many of them.
    pub fn ticks(&self, gap: f64) -> Vec<f64> {
        let decades = self.low.log10().floor() as i32..=self.high.log10().ceil() as i32;
        let of_decades = |steps: &[f64], every: i32| -> Vec<f64> {
            let decades = decades.clone().filter(|decade| decade.rem_euclid(every) == 0);
            decades.flat_map(|decade| steps.iter().map(move |step| step * 10f64.powi(decade))).collect()
        };
        let even = |step: f64| -> Vec<f64> {
            let (first, last) = ((self.low / step).ceil() as i64, (self.high / step).floor() as i64);
            (first..=last.min(first + 100)).map(|at| at as f64 * step).collect()
        };
        let is_short = self.high / self.low < 12.0;
        let scale = 10f64.powi((self.high - self.low).log10().floor() as i32 - 1);
        let steps = [1.0, 2.0, 4.0, 5.0, 10.0, 20.0, 40.0, 50.0].map(|step| step * scale);
        let short = steps.into_iter().filter(|_| is_short).map(even);
        let long = [of_decades(&[1.0, 2.0, 5.0], 1), of_decades(&[1.0, 3.0], 1), of_decades(&[1.0], 1)];
        let longest = (2..40).map(|every| of_decades(&[1.0], every));
        let inside = |ticks: Vec<f64>| -> Vec<f64> {
            ticks.into_iter().filter(|tick| (self.low..=self.high).contains(tick)).collect()
        };
        let apart = |ticks: &[f64]| ticks.windows(2).all(|pair| self.at(pair[1]) - self.at(pair[0]) >= gap);
        let mut all = short.chain(long).chain(longest).map(inside).filter(|ticks| ticks.len() >= 2);
        all.find(|ticks| apart(ticks)).unwrap_or_else(|| {
            // No set is even enough: of the finest what has space.
            let mut sparse: Vec<f64> = Vec::new();
            for tick in inside(even(scale)) {
                if sparse.last().is_none_or(|last| self.at(tick) - self.at(*last) >= gap) {
                    sparse.push(tick);
                }
            }
            sparse
        })
    }

    /// What stands at a value.
    pub fn label(value: f64, unit: Unit) -> String {
        let scaled = |value: f64, ends: &[(f64, &str)]| {
            let (size, end) = ends.iter().copied().find(|(size, _)| value >= *size * (1.0 - 1e-9)).unwrap_or((1.0, ""));
            format!("{}{end}", short(value / size))
        };
        match unit {
            Unit::Count => scaled(value, &[(1e9, "G"), (1e6, "M"), (1e3, "k")]),
            Unit::Percent => format!("{} %", short(value)),
            Unit::Seconds => scaled(value, &[(1.0, " s"), (1e-3, " ms"), (1e-6, " µs"), (1e-9, " ns")]),
        }
    }
}

/// Four significant digits at the most.
fn short(value: f64) -> String {
    let digits = (3 - value.abs().max(1e-12).log10().floor() as i32).clamp(0, 12) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Unit};

    #[test]
    fn axis_has_round_ticks_that_stay_apart() {
        let spans = [1.0001, 1.01, 1.2, 2.0, 3.0, 7.0, 11.9, 12.1, 50.0, 1e3, 1e5, 1e8];
        for low in [1e-9, 3.3e-4, 0.07, 1.0, 2.01, 999.0, 4.7e6] {
            for span in spans {
                for gap in [0.05, 0.12, 0.2] {
                    let axis = Axis::over([low, low * span].into_iter());
                    assert!(axis.low < low && axis.high > low * span);
                    let ticks = axis.ticks(gap);
                    assert!(ticks.len() >= 2, "{low} {span} {gap}: {ticks:?}");
                    assert!(ticks.windows(2).all(|pair| axis.at(pair[1]) - axis.at(pair[0]) >= gap));
                    assert!(ticks.iter().all(|tick| (0.0..=1.0).contains(&axis.at(*tick))));
                    let labels: Vec<_> = ticks.iter().map(|tick| Axis::label(*tick, Unit::Count)).collect();
                    assert!(labels.windows(2).all(|pair| pair[0] != pair[1]), "{labels:?}");
                }
            }
        }
    }

    #[test]
    fn axis_takes_nothing_zeros_and_one_value() {
        for values in
            [vec![], vec![0.0], vec![0.0, 0.0], vec![5.0], vec![0.0, 5.0], vec![1e-300, 5.0], vec![f64::INFINITY]]
        {
            let axis = Axis::over(values.iter().copied());
            assert!(axis.low > 0.0 && axis.high > axis.low && axis.high.is_finite(), "{values:?} {axis:?}");
            assert_eq!(axis.floor.is_some(), values.iter().any(|value| *value < 1e-200), "{values:?} {axis:?}");
            assert!(values.iter().all(|value| (0.0..=1.0).contains(&axis.at(*value))), "{values:?}");
            assert!(axis.ticks(0.1).len() >= 2, "{values:?} {axis:?}");
        }
        let axis = Axis::over([0.0, 5.0].into_iter());
        assert!(axis.at(0.0) < axis.at(5.0) && axis.at(0.0) > 0.0);
    }

    #[test]
    fn axis_labels_are_short() {
        let label = Axis::label;
        assert_eq!(
            ["500", "20k", "1M", "2.5M"],
            [500.0, 2e4, 1e6, 2.5e6].map(|value| label(value, Unit::Count)).each_ref().map(String::as_str)
        );
        assert_eq!((label(0.02, Unit::Percent), label(100.0, Unit::Percent)), ("0.02 %".into(), "100 %".into()));
        assert_eq!(
            (label(0.02, Unit::Seconds), label(3.0, Unit::Seconds), label(1e-6, Unit::Seconds)),
            ("20 ms".into(), "3 s".into(), "1 µs".into())
        );
    }
}
