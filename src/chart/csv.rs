// SPDX-License-Identifier: MIT OR Apache-2.0
//! The points as a table of comma-separated values; `docs/chart.md` tells each column.

use super::{Chapter, Figure, Kind, Point, Subject};

/// The first line: whoever reads the table can tell what its columns mean.
pub const SCHEMA: &str = "# relief chart 1";

/// Columns before the flags of the fronts.
const COLUMNS: [&str; 30] = [
    "scene",
    "width",
    "height",
    "range",
    "method",
    "kind",
    "version",
    "goal",
    "triangles",
    "vertices",
    "max_error",
    "mean_error",
    "rms_error",
    "max_percent",
    "rms_percent",
    "max_world",
    "rms_world",
    "claim",
    "verdict",
    "slack",
    "whole",
    "cycles",
    "cycles_per_triangle",
    "reads",
    "memory_bits",
    "preparation_s",
    "golden_s",
    "cache_misses_per_triangle",
    "uncovered",
    "folded",
];

/// The whole table.
pub fn table(chapters: &[Chapter]) -> String {
    let header = COLUMNS.iter().map(|column| (*column).to_owned());
    let fronts = Figure::ALL.iter().map(|figure| format!("pareto_{}", figure.name().replace('-', "_")));
    let mut lines = vec![SCHEMA.to_owned(), header.chain(fronts).collect::<Vec<_>>().join(",")];
    for chapter in chapters {
        lines.extend(chapter.points.iter().map(|point| row(&chapter.subject, point)));
    }
    lines.join("\n") + "\n"
}

fn row(subject: &Subject, point: &Point) -> String {
    let heights = &point.heights;
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
    let count = |value: Option<u64>| value.map_or_else(String::new, |value| value.to_string());
    let hardware = point.hardware.as_ref();
    let triangles = heights.triangles as f64;
    let world = |error: f64| subject.world.map(|scale| error * scale);
    let fields = [
        quoted(&subject.name),
        subject.map.width.to_string(),
        subject.map.height.to_string(),
        subject.range().to_string(),
        quoted(&point.method),
        (if point.kind == Kind::Ours { "ours" } else { "peer" }).into(),
        quoted(&point.version),
        quoted(&point.goal),
        heights.triangles.to_string(),
        heights.vertices.to_string(),
        heights.max.to_string(),
        number(heights.mean),
        number(heights.rms),
        subject.percent(heights.max).to_string(),
        number(heights.rms.map(|rms| subject.percent(rms))),
        number(world(heights.max)),
        number(heights.rms.and_then(world)),
        number(point.claim),
        point.verdict.name().into(),
        number(point.slack()),
        u8::from(heights.is_whole()).to_string(),
        count(hardware.map(|hardware| hardware.cycles)),
        number(hardware.map(|hardware| hardware.cycles as f64 / triangles)),
        count(hardware.map(|hardware| hardware.reads)),
        count(hardware.map(|hardware| hardware.memory_bits)),
        point.preparation_seconds.to_string(),
        point.golden_seconds.to_string(),
        (point.cache_misses as f64 / triangles).to_string(),
        heights.uncovered.to_string(),
        heights.folded.to_string(),
    ];
    let fronts = point.fronts.iter().map(|is_best| u8::from(*is_best).to_string());
    fields.into_iter().chain(fronts).collect::<Vec<_>>().join(",")
}

/// A field that may hold anything: RFC 4180.
pub fn quoted(text: &str) -> String {
    let plain = !text.contains([',', '"', '\n', '\r']);
    if plain { text.into() } else { format!("\"{}\"", text.replace('"', "\"\"")) }
}
