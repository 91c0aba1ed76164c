// SPDX-License-Identifier: MIT OR Apache-2.0
//! The tables of the page.

use relief_models::silhouette::Horizon;
use relief_testbench::method::Hardware;

use super::super::advice::{self, Choice, count, figure};
use super::super::{Chapter, Figure, Kind, Point, Subject};
use super::escaped;

/// A cell, marked where it is the best.
fn cell(text: &str, is_best: bool) -> String {
    let class = if is_best { " class=\"best\"" } else { "" };
    format!("<td{class}>{}</td>", escaped(text))
}

fn table(columns: &[&str], rows: &str) -> String {
    let header = columns.iter().map(|column| {
        let class = if ["goal", "claim", "on the front of"].contains(column) { " class=\"text\"" } else { "" };
        format!("<th{class}>{column}</th>")
    });
    let header: String = header.collect();
    format!("<div class=\"scroll\">\n<table>\n<tr>{header}</tr>\n{rows}</table>\n</div>\n")
}

/// Each method's smallest mesh that keeps a bound.
pub fn comparison(subject: &Subject, choice: &Choice<'_>) -> String {
    let keeping: Vec<&Point> = choice.rows.iter().filter_map(|(row, _)| row.ok()).collect();
    let least =
        |of: &dyn Fn(&Point) -> Option<f64>| keeping.iter().filter_map(|point| of(point)).fold(f64::INFINITY, f64::min);
    let triangles = |point: &Point| Some(point.heights.triangles as f64);
    let rms = |point: &Point| point.heights.rms;
    let cycles = |point: &Point| point.hardware.as_ref().map(|hardware| hardware.cycles as f64);
    let best = [least(&triangles), least(&rms), least(&cycles)];
    let taken = choice.taken();
    let mut rows = String::new();
    for (row, name) in &choice.rows {
        let whose = |point: &Point| if point.kind == Kind::Peer { " (peer)" } else { "" };
        match row {
            Ok(point) => {
                let class =
                    if taken.is_some_and(|taken| std::ptr::eq(taken, *point)) { " class=\"taken\"" } else { "" };
                let hardware = |text: Option<u64>| text.map_or_else(|| "–".into(), count);
                let is_best = |at: usize, value: Option<f64>| value.is_some_and(|value| value == best[at]);
                rows += &format!("<tr{class}><td>{}{}</td>", escaped(name), whose(point));
                rows += &cell(&count(point.heights.triangles as u64), is_best(0, triangles(point)));
                rows += &cell(&percent(subject, point.heights.max), false);
                rows += &cell(&percent(subject, point.rms()), is_best(1, rms(point)));
                rows += &cell(&hardware(point.hardware.as_ref().map(|at| at.cycles)), is_best(2, cycles(point)));
                rows += &cell(&hardware(point.hardware.as_ref().map(|at| at.reads)), false);
                rows += &cell(&hardware(point.hardware.as_ref().map(|at| at.memory_bits)), false);
                rows += &cell(&seconds(point.preparation_seconds), false);
                rows += &cell(&seconds(point.golden_seconds), false);
                rows += &verdict(point);
            }
            Err(point) => {
                let error = percent(subject, point.heights.max);
                let sentence = format!("none of its meshes here; the least error was {error}");
                let name = format!("{}{}", escaped(name), whose(point));
                rows += &format!("<tr><td>{name}</td><td class=\"text\" colspan=\"9\">{sentence}</td>");
            }
        }
        rows += "</tr>\n";
    }
    let columns =
        ["method", "triangles", "max", "RMS", "cycles", "reads", "memory bits", "preparation", "golden", "claim"];
    let title = format!("Smallest mesh with errors up to {} % of the range", choice.percent);
    format!("<h3>{title}</h3>\n{}", table(&columns, &rows))
}

fn percent(subject: &Subject, error: f64) -> String {
    if error.is_finite() { format!("{:.3} %", subject.percent(error)) } else { "–".into() }
}

fn seconds(seconds: f64) -> String {
    if seconds == 0.0 { "–".into() } else { advice::seconds(seconds) }
}

fn verdict(point: &Point) -> String {
    let name = point.standing();
    let class = if name.starts_with("BROKEN") { "broken" } else { "text" };
    format!("<td class=\"{class}\">{name}</td>")
}

/// Every point of a chapter.
pub fn all_points(chapter: &Chapter) -> String {
    let subject = &chapter.subject;
    let mut rows = String::new();
    for point in &chapter.points {
        let hardware = |of: fn(&Hardware) -> u64| {
            cell(&point.hardware.as_ref().map_or_else(|| "–".into(), |hardware| count(of(hardware))), false)
        };
        let on: Vec<&str> = Figure::ALL
            .into_iter()
            .zip(point.fronts)
            .filter(|(_, is_best)| *is_best)
            .map(|(at, _)| at.name())
            .collect();
        let whose = if point.kind == Kind::Peer { " (peer)" } else { "" };
        rows +=
            &format!("<tr><td>{}{whose}</td><td class=\"text\">{}</td>", escaped(&point.method), escaped(&point.goal));
        rows += &cell(&count(point.heights.triangles as u64), false);
        rows += &cell(&count(point.heights.vertices as u64), false);
        rows += &cell(&figure(point.heights.max), false);
        rows += &cell(&percent(subject, point.heights.max), false);
        rows += &cell(&percent(subject, point.rms()), false);
        rows += &verdict(point);
        rows += &cell(&point.slack().map_or_else(|| "–".into(), figure), false);
        rows += &hardware(|hardware| hardware.cycles);
        rows += &hardware(|hardware| hardware.reads);
        rows += &cell(&seconds(point.preparation_seconds), false);
        rows += &cell(&seconds(point.golden_seconds), false);
        rows += &cell(&figure(point.cache_misses as f64 / point.heights.triangles as f64), false);
        rows += &format!("<td class=\"text\">{}</td></tr>\n", on.join(", "));
    }
    let columns = [
        "method",
        "goal",
        "triangles",
        "vertices",
        "max, map units",
        "max",
        "RMS",
        "claim",
        "slack",
        "cycles",
        "reads",
        "preparation",
        "golden",
        "cache misses a triangle",
        "on the front of",
    ];
    table(&columns, &rows)
}

/// What every filter does to the horizon, a row a step and filter; the least RMS error and peak loss of a step are marked, from
/// above and from below.
pub fn filters(chapter: &Chapter) -> String {
    let mut rows = String::new();
    for silhouettes in &chapter.silhouettes {
        // Those that are judged from above, and those from below.
        let least = |is_lower: bool, of: fn(&Horizon) -> f64| {
            let alike = silhouettes.rows.iter().filter(|(filter, _)| filter.is_lower() == is_lower);
            alike.map(|(_, horizon)| of(horizon)).fold(f64::INFINITY, f64::min)
        };
        for (filter, horizon) in &silhouettes.rows {
            let best = [|horizon: &Horizon| horizon.rms, |horizon: &Horizon| horizon.peak_loss]
                .map(|of| least(filter.is_lower(), of));
            let share = |value: f64| format!("{value:.2} %");
            rows += &format!("<tr><td>{}</td><td>{}</td>", filter.name(), silhouettes.step);
            rows += &cell(&horizon.level.to_string(), false);
            rows += &cell(&share(horizon.rms), horizon.rms == best[0]);
            rows += &cell(&share(horizon.mean), false);
            rows += &cell(&share(horizon.peak_loss), horizon.peak_loss == best[1]);
            rows += &cell(&share(horizon.deepest), false);
            rows += "</tr>\n";
        }
    }
    table(&["filter", "step, texels", "level", "RMS", "mean", "peak loss", "deepest"], &rows)
}
