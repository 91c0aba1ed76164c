// SPDX-License-Identifier: MIT OR Apache-2.0
//! What to take for a bound, and what else there is.

use relief_testbench::method::Verdict;

use super::super::repetition::{THRESHOLD, repetition};
use super::super::{Chapter, Kind, Point, Subject};
use super::{Choice, choices, count, figure, seconds};

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
    let saves = quickest.method != taken.method && taken.heights.triangles < quickest.heights.triangles;
    (saves && 10.0 * quickest.preparation_seconds < taken.preparation_seconds).then(|| {
        let times = figure(quickest.heights.triangles as f64 / taken.heights.triangles as f64);
        let [slow, quick] = [taken, quickest].map(|point| seconds(point.preparation_seconds));
        format!(
            "Preparing it took {slow} here, once a map. Where maps change often take {}: {quick}, {times} times the \
             triangles, and the same promise.",
            quickest.method
        )
    })
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
    Some(format!(
        "The coarsest regular grid here that keeps it has {triangles} triangles{all}, {} times as many, {what}.",
        figure(times)
    ))
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
