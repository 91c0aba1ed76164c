// SPDX-License-Identifier: MIT OR Apache-2.0
//! What follows from the points of a map, in sentences. All of it is computed: another map, other sentences.

use relief_testbench::method::Verdict;

use super::repetition::{THRESHOLD, repetition};
use super::{Chapter, Kind, Point, Subject, collect};

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
                "It does not come back on itself when it is shifted ({measured}). Rough and smooth parts differ from place \
                 to place, so a method that puts triangles where the error is can save many."
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

/// What to take: sentences under headings.
pub fn sentences(chapter: &Chapter) -> Vec<(String, Vec<String>)> {
    let choices = choices(chapter);
    let part = |choice: &Choice<'_>| {
        let more =
            [quicker(choice), cheaper(choice), against_grid(chapter, choice), peer(choice), smoother(chapter, choice)];
        let sentences = [take(chapter, choice)].into_iter().chain(more.into_iter().flatten()).collect();
        (bound(&chapter.subject, choice), sentences)
    };
    let mut parts: Vec<_> = choices.iter().map(part).collect();
    let besides: Vec<String> = aliases(chapter).into_iter().chain(broken(chapter)).collect();
    parts.extend((!besides.is_empty()).then(|| ("Beware".to_owned(), besides)));
    parts
}

fn bound(subject: &Subject, choice: &Choice<'_>) -> String {
    let world =
        subject.world.map_or_else(String::new, |scale| format!(", {} in the scene", figure(choice.bound * scale)));
    format!("Errors up to {} % of the range ({} map units{world})", choice.percent, figure(choice.bound))
}

fn take(chapter: &Chapter, choice: &Choice<'_>) -> String {
    let subject = &chapter.subject;
    let Some(point) = choice.taken() else {
        return "No mesh of ours in this chart keeps that.".into();
    };
    let all = 2 * (subject.map.width as u64 - 1) * (subject.map.height as u64 - 1);
    let share = figure(100.0 * point.heights.triangles as f64 / all as f64);
    let cycles = point.hardware.as_ref().map_or_else(String::new, |hardware| {
        let each = hardware.cycles as f64 / point.heights.triangles as f64;
        format!(", in {} cycles ({} a triangle)", count(hardware.cycles), figure(each))
    });
    let promise = match point.claim {
        Some(_) => "It promises its bound, and every sample was found within it",
        None => "It promises nothing: that it is within the bound was found by measuring, on this map",
    };
    let triangles = count(point.heights.triangles as u64);
    format!(
        "Take {}: {triangles} triangles, {share} % of those of a mesh with all samples{cycles}. {promise}.",
        point.method
    )
}

/// A method that promises as much and is prepared ten times as fast.
fn quicker(choice: &Choice<'_>) -> Option<String> {
    let taken = choice.taken()?;
    let promising = choice.keeping().filter(|point| point.kind == Kind::Ours && point.claim.is_some());
    let quickest = promising.min_by(|a, b| a.preparation_seconds.total_cmp(&b.preparation_seconds))?;
    (10.0 * quickest.preparation_seconds < taken.preparation_seconds).then(|| {
        let times = figure(quickest.heights.triangles as f64 / taken.heights.triangles as f64);
        let [slow, quick] = [taken, quickest].map(|point| seconds(point.preparation_seconds));
        format!(
            "Preparing it took {slow} here, once a map. Where maps change often take {}: {quick}, {times} times the \
             triangles, and the same promise.",
            quickest.method
        )
    })
}

/// A time, in a unit that suits it.
pub fn seconds(seconds: f64) -> String {
    if seconds < 1.0 { format!("{} ms", figure(1e3 * seconds)) } else { format!("{} s", figure(seconds)) }
}

/// Another method that takes fewer cycles.
fn cheaper(choice: &Choice<'_>) -> Option<String> {
    let taken = choice.taken()?;
    let cycles = |point: &Point| point.hardware.as_ref().map(|hardware| hardware.cycles);
    let least = choice.keeping().filter(|point| cycles(point).is_some()).min_by_key(|point| cycles(point))?;
    let times = figure(cycles(least)? as f64 / cycles(taken)? as f64);
    (least.method != taken.method).then(|| {
        let promise = if least.claim.is_some() { "" } else { ", and promises nothing" };
        let (cycles, triangles) = (count(cycles(least).unwrap_or_default()), count(least.heights.triangles as u64));
        format!(
            "{} takes fewer cycles ({cycles}, {times} times), but sends {triangles} triangles{promise}.",
            least.method
        )
    })
}

/// What the regular grid would cost.
fn against_grid(chapter: &Chapter, choice: &Choice<'_>) -> Option<String> {
    let taken = choice.taken()?;
    let grid = choice.keeping().find(|point| point.method == "uniform").filter(|_| taken.method != "uniform")?;
    let times = grid.heights.triangles as f64 / taken.heights.triangles as f64;
    let triangles = count(grid.heights.triangles as u64);
    let all = grid.heights.max == 0.0 && grid.heights.vertices == chapter.subject.map.samples.len();
    let all = if all { " (every sample)" } else { "" };
    let what = if times >= 1.5 {
        "so it pays to put triangles where the map needs them"
    } else if times >= 1.0 {
        "so it pays little to put triangles where the map needs them"
    } else {
        "fewer: it happens to suit this map"
    };
    Some(format!("A regular grid needs {triangles} triangles for that{all}, {} times as many, {what}.", figure(times)))
}

/// The best of the peers.
fn peer(choice: &Choice<'_>) -> Option<String> {
    let taken = choice.taken()?;
    let peers = choice.keeping().filter(|point| point.kind == Kind::Peer);
    let best = peers.min_by_key(|point| point.heights.triangles)?;
    let times = figure(best.heights.triangles as f64 / taken.heights.triangles as f64);
    let triangles = count(best.heights.triangles as u64);
    Some(format!("The best peer, in software, is {} with {triangles} triangles, {times} times ours.", best.method))
}

/// Who has the least mean error with as many triangles.
fn smoother(chapter: &Chapter, choice: &Choice<'_>) -> Option<String> {
    let taken = choice.taken()?;
    let small = |point: &&Point| {
        // Methods that take a goal as a count come near it, not below it.
        point.heights.is_whole() && point.heights.triangles as f64 <= 1.02 * taken.heights.triangles as f64
    };
    let best = chapter.points.iter().filter(small).min_by(|a, b| a.rms().total_cmp(&b.rms()))?;
    let [least, own] = [best, taken].map(|point| figure(chapter.subject.percent(point.rms())));
    let greatest = figure(chapter.subject.percent(best.heights.max));
    Some(if best.method == taken.method {
        format!("No mesh with so few triangles has a lower RMS error than its {least} % of the range.")
    } else {
        format!(
            "Where the RMS error matters more than the greatest one: {} has {least} % of the range with no more triangles \
             (greatest error {greatest} %), {} {own} %.",
            best.method, taken.method
        )
    })
}

/// Methods whose error grows with more triangles: they step over what the map holds.
fn aliases(chapter: &Chapter) -> Option<String> {
    let mut worst: Option<(f64, &Point, &Point)> = None;
    for (name, _) in chapter.methods() {
        let mut points: Vec<_> = chapter
            .points
            .iter()
            .filter(|point| point.method == name && point.claim.is_none() && point.heights.is_whole())
            .collect();
        points.sort_by_key(|point| point.heights.triangles);
        for pair in points.windows(2) {
            let grown = pair[1].heights.max - pair[0].heights.max;
            if pair[1].heights.triangles > pair[0].heights.triangles && worst.is_none_or(|(most, ..)| grown > most) {
                worst = Some((grown, pair[0], pair[1]));
            }
        }
    }
    let (grown, few, many) = worst?;
    let of = |point: &Point| {
        let error = figure(chapter.subject.percent(point.heights.max));
        format!("{error} % with {} triangles", count(point.heights.triangles as u64))
    };
    let found = repetition(&chapter.subject.map).into_iter().find(|axis| axis.strength >= THRESHOLD);
    let what = found.map_or_else(|| "the map".into(), |axis| format!("the period of {} samples", axis.period));
    (chapter.subject.percent(grown) >= 1.0).then(|| {
        format!(
            "More triangles are not always better where a method does not look at the map: {} has a greatest error of {}, \
             but of {}. How the grid meets {what} decides.",
            few.method,
            of(few),
            of(many)
        )
    })
}

/// Claims that do not hold, and meshes that are no height fields.
fn broken(chapter: &Chapter) -> Vec<String> {
    let mut sentences = Vec::new();
    for (name, _) in chapter.methods() {
        let of = || chapter.points.iter().filter(|point| point.method == name && point.verdict == Verdict::Broken);
        let times = |point: &Point| point.claim.filter(|claim| *claim > 0.0).map(|claim| point.heights.max / claim);
        let above: Vec<f64> = of().filter(|point| point.heights.is_whole()).filter_map(times).collect();
        if !above.is_empty() {
            let most = figure(above.iter().copied().fold(0.0, f64::max));
            let number = above.len();
            sentences.push(format!(
                "{name} breaks its claim at {number} of its goals: errors up to {most} times the bound."
            ));
        }
        let (gaps, folds): (Vec<_>, Vec<_>) =
            of().filter(|point| !point.heights.is_whole()).partition(|point| point.heights.uncovered > 0);
        for (meshes, what) in [(gaps, "gaps"), (folds, "folds, seen from above")] {
            if !meshes.is_empty() {
                let number = match meshes.len() {
                    1 => "a mesh".into(),
                    number => format!("{number} meshes"),
                };
                sentences.push(format!("{name} made {number} with {what}: no height field."));
            }
        }
    }
    sentences
}
