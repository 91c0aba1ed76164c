// SPDX-License-Identifier: MIT OR Apache-2.0
//! What follows from the points of a map, in sentences. All of it is computed: another map, other sentences.

use relief_testbench::method::Verdict;

use super::repetition::{THRESHOLD, repetition};
use super::{Chapter, Kind, Point, Subject, collect};

mod sentences;

pub use sentences::sentences;

/// The mesh with the fewest triangles of each method that keeps a bound.
pub struct Choice<'a> {
    /// The bound, in percent of the range.
    pub percent: u32,
    /// The bound, in map units.
    pub bound: f64,
    /// Method by method: the mesh, or else that with the least error.
    pub rows: Vec<(Result<&'a Point, &'a Point>, &'a str)>,
}

impl<'a> Choice<'a> {
    fn new(chapter: &'a Chapter, percent: u32) -> Choice<'a> {
        let bound = f64::from(percent) * f64::from(chapter.subject.range()) / 100.0;
        let best = |(name, _): (&'a str, Kind)| {
            let of = || chapter.points.iter().filter(|point| point.method == name && point.heights.is_whole());
            let least = of().min_by(|a, b| a.heights.max.total_cmp(&b.heights.max));
            let keeping = of().filter(|point| point.keeps(bound)).min_by_key(|point| point.heights.triangles);
            least.map(|least| (keeping.ok_or(least), name))
        };
        Choice { percent, bound, rows: chapter.methods().into_iter().filter_map(best).collect() }
    }

    fn keeping(&self) -> impl Iterator<Item = &'a Point> {
        self.rows.iter().filter_map(|(row, _)| row.ok())
    }

    /// The mesh to take: of ours, in hardware if any ran, with a promise if any gives one, that with the fewest triangles.
    pub fn taken(&self) -> Option<&'a Point> {
        let ours = || self.keeping().filter(|point| point.kind == Kind::Ours && point.verdict != Verdict::Broken);
        let key = |point: &&Point| (point.hardware.is_none(), point.claim.is_none(), point.heights.triangles);
        ours().min_by_key(key)
    }
}

/// What is compared: all methods at each tolerance.
pub fn choices(chapter: &Chapter) -> Vec<Choice<'_>> {
    collect::TOLERANCES.iter().rev().map(|&percent| Choice::new(chapter, percent)).collect()
}

/// A count with thin groups of three digits.
pub fn count(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Three significant digits.
pub fn figure(value: f64) -> String {
    let digits = (2 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 9) as usize;
    if value == 0.0 { "0".into() } else { format!("{value:.digits$}") }
}

/// What kind of map it is, and how that was found.
pub fn kind(subject: &Subject) -> (&'static str, String) {
    let found = repetition(&subject.map);
    let [x, y] = found.map(|axis| format!("{:.2}", axis.strength));
    let measured = format!("repetition {x} along x, {y} along y; from {THRESHOLD} on a map counts as a pattern");
    let periods: Vec<String> = found
        .iter()
        .zip(["x", "y"])
        .filter(|(axis, _)| axis.strength >= THRESHOLD)
        .map(|(axis, name)| format!("every {} samples along {name}", axis.period))
        .collect();
    if subject.range() == 0 {
        return ("a plane", "All its samples are the same.".into());
    }
    match periods.is_empty() {
        true => (
            "terrain, or a single shape",
            format!(
                "It does not come back on itself when it is shifted ({measured}). Where rough and smooth parts differ from \
                 place to place, a method that puts triangles where the error is saves many; the table tells how many."
            ),
        ),
        false => (
            "a repeating pattern",
            format!(
                "It comes back {} ({measured}). What a method does to one repetition it does to all of them: a lattice that \
                 fits the period serves all, and one that does not errs in all.",
                periods.join(", and ")
            ),
        ),
    }
}

/// What to take, in a line.
pub fn headline(chapter: &Chapter) -> String {
    let (kind, _) = kind(&chapter.subject);
    let choices = choices(chapter);
    let taken = choices.iter().filter_map(|choice| {
        let point = choice.taken()?;
        let cycles = point.hardware.as_ref().map_or_else(String::new, |at| format!(", {} cycles", count(at.cycles)));
        let triangles = count(point.heights.triangles as u64);
        Some(format!("for errors up to {} % {} ({triangles} triangles{cycles})", choice.percent, point.method))
    });
    let taken: Vec<_> = taken.collect();
    if taken.is_empty() { kind.into() } else { format!("{kind}. Take {}.", taken.join(", ")) }
}

/// A time, in a unit that suits it.
pub fn seconds(seconds: f64) -> String {
    if seconds < 1.0 { format!("{} ms", figure(1e3 * seconds)) } else { format!("{} s", figure(seconds)) }
}
