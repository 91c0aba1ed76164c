// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws a few signals over a window of cycles as an SVG picture.
//!
//! The picture shows what each edge samples: a value fills its cycle, and the edge at the right border takes it. Where
//! a stream moves a beat, `valid` and `ready` both high, its rows are tinted; where it stalls, they are shaded.

use crate::read::{Value, Waves};
use std::{fmt::Write, ops::Range};
use svg::{
    Document,
    node::element::{Group, Line, Path, Rectangle, Style, Text, Title},
};
use thiserror::Error;

/// How a value is written into its bus.
#[derive(Clone, Debug, PartialEq)]
pub enum Label {
    /// Hexadecimal.
    Hex,
    /// Unsigned decimal.
    Decimal,
    /// Decimal in two's complement.
    Signed,
    /// A signed fixed-point number with so many bits behind the point.
    Fixed(u32),
    /// One of these names; the value is the index.
    Names(Vec<String>),
    /// A text as it is, a vector in binary.
    Plain,
}

impl Label {
    fn text(&self, value: &Value) -> String {
        let Value::Bits { bits, words, .. } = value else { return value.to_string() };
        if !value.is_known() {
            return "x".into();
        }
        let text = match self {
            Label::Hex => {
                let digits: String = words.iter().rev().map(|word| format!("{word:016x}")).collect();
                let digits = &digits[digits.len() - bits.div_ceil(4).clamp(1, digits.len())..];
                Some(digits.to_string())
            }
            Label::Decimal => value.unsigned().map(|value| value.to_string()),
            Label::Signed => value.signed().map(|value| value.to_string()),
            // Five places are what a cell of the picture has room for.
            Label::Fixed(places) => value.signed().map(|value| {
                let text = format!("{:.5}", value as f64 / 2f64.powi(*places as i32));
                text.trim_end_matches('0').trim_end_matches('.').to_string()
            }),
            Label::Names(names) => value.unsigned().map(|index| match names.get(index as usize) {
                Some(name) => name.clone(),
                None => format!("?{index}"),
            }),
            Label::Plain => Some(value.to_string()),
        };
        text.unwrap_or_else(|| value.to_string())
    }
}

/// A pair of signals that moves beats.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream {
    /// The name of the valid signal.
    pub valid: String,
    /// The name of the ready signal.
    pub ready: String,
}

/// One row of the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Row {
    /// The clock.
    Clock,
    /// A heading: the rows below belong together.
    Heading(String),
    /// A flag, drawn as a line.
    Bit {
        /// The name of the signal.
        signal: String,
        /// The stream whose beats tint it: an index into [`Drawing::streams`].
        stream: Option<usize>,
    },
    /// A number or a text, drawn as cells.
    Bus {
        /// The name of the signal.
        signal: String,
        /// How its values are written.
        label: Label,
        /// The stream whose beats tint it: an index into [`Drawing::streams`].
        stream: Option<usize>,
    },
}

/// What to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// The heading, and the title that a screen reader speaks.
    pub title: String,
    /// The cycles, as the file numbers them.
    pub window: Range<u64>,
    /// From top to bottom.
    pub rows: Vec<Row>,
    /// What tints the rows.
    pub streams: Vec<Stream>,
    /// The width of a cycle in pixels; 48 holds six digits.
    pub cycle_width: u32,
}

impl Drawing {
    /// A picture of this window with the clock alone.
    pub fn new(title: impl Into<String>, window: Range<u64>) -> Self {
        Self { title: title.into(), window, rows: vec![Row::Clock], streams: Vec::new(), cycle_width: 48 }
    }

    /// With a heading.
    pub fn heading(mut self, text: impl Into<String>) -> Self {
        self.rows.push(Row::Heading(text.into()));
        self
    }

    /// With a flag.
    pub fn bit(mut self, signal: impl Into<String>) -> Self {
        self.rows.push(Row::Bit { signal: signal.into(), stream: None });
        self
    }

    /// With a number or a text.
    pub fn bus(mut self, signal: impl Into<String>, label: Label) -> Self {
        self.rows.push(Row::Bus { signal: signal.into(), label, stream: None });
        self
    }

    /// With the stream `<name>_valid`, `<name>_ready` and its payload, given as `<field>` and label: the contract's
    /// names, so that `stream("in", [("vertex", Label::Hex)])` shows `in_valid`, `in_ready` and `in_vertex`.
    pub fn stream<'a>(mut self, name: &str, payload: impl IntoIterator<Item = (&'a str, Label)>) -> Self {
        let stream = Some(self.streams.len());
        let [valid, ready] = ["valid", "ready"].map(|wire| format!("{name}_{wire}"));
        self.streams.push(Stream { valid: valid.clone(), ready: ready.clone() });
        self.rows.extend([valid, ready].map(|signal| Row::Bit { signal, stream }));
        let bus = |(field, label)| Row::Bus { signal: format!("{name}_{field}"), label, stream };
        self.rows.extend(payload.into_iter().map(bus));
        self
    }
}

/// Why nothing can be drawn.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum DrawError {
    /// Not in the file, or the name is that of several.
    #[error("the waveform has no signal `{0}`, or several that end so")]
    Signal(String),
    /// A row names a stream that the drawing does not have.
    #[error("the row of `{signal}` names stream {stream}, and the drawing has {streams}")]
    Stream {
        /// The row.
        signal: String,
        /// The index.
        stream: usize,
        /// How many there are.
        streams: usize,
    },
    /// Not in the file.
    #[error("cycles {}..{} are to be drawn, and the waveform holds {}..{}", .asked.start, .asked.end, .held.start, .held.end)]
    Window {
        /// The window.
        asked: Range<u64>,
        /// What there is.
        held: Range<u64>,
    },
}

const ROW: f64 = 30.0;
const WAVE: f64 = 20.0;
const SLANT: f64 = 4.0;
const MARGIN: f64 = 12.0;
const HEAD: f64 = 50.0;
/// The average width of a letter of the text, by which room is measured.
const LETTER: f64 = 7.3;

const STYLE: &str = "\
text{font-family:'DejaVu Sans Mono','Liberation Mono',Menlo,Consolas,monospace;font-size:12px;fill:#1b1f24}\
.title{font-size:14px;font-weight:bold}.heading{font-weight:bold;fill:#3d4f63}.cycle{fill:#6b7785;font-size:10px}\
.value{font-size:11px;text-anchor:middle}.name{text-anchor:end}\
.wave{fill:none;stroke:#1b1f24;stroke-width:1.4;stroke-linejoin:round}.clock{stroke:#6b7785}\
.grid{stroke:#d5dae0;stroke-width:1}.beat{fill:#bfe5c5}.stall{fill:#fbe3b5}.unknown{fill:#f3b6b6}";

/// The picture as SVG text. The same waveform and drawing give the same text, byte by byte.
pub fn draw(waves: &Waves, drawing: &Drawing) -> Result<String, DrawError> {
    let held = waves.cycles();
    let window = drawing.window.clone();
    if window.is_empty() || window.start < held.start || window.end > held.end {
        return Err(DrawError::Window { asked: window, held });
    }
    let cycles: Vec<u64> = window.clone().collect();
    let cell = f64::from(drawing.cycle_width.max(16));
    let names = drawing.rows.iter().map(|row| match row {
        Row::Clock => "clock".len(),
        Row::Heading(_) => 0,
        Row::Bit { signal, .. } | Row::Bus { signal, .. } => signal.chars().count(),
    });
    let left = MARGIN + names.max().unwrap_or(0) as f64 * LETTER + 10.0;
    let right = left + cell * cycles.len() as f64;
    let bottom = HEAD + ROW * drawing.rows.len() as f64;
    let key = "green: a beat moves · amber: valid waits for ready · red: unknown";
    let key_room = if drawing.streams.is_empty() { 0.0 } else { 22.0 };
    let title_room = MARGIN + drawing.title.chars().count() as f64 * LETTER * 1.2;
    let key_width = if key_room > 0.0 { left + key.chars().count() as f64 * LETTER * 0.85 } else { 0.0 };
    let (width, height) = (right.max(title_room).max(key_width) + MARGIN, bottom + MARGIN + key_room);

    let mut document = Document::new()
        .set("viewBox", (0, 0, width.ceil() as u32, height.ceil() as u32))
        .set("width", width.ceil() as u32)
        .set("height", height.ceil() as u32)
        .set("role", "img")
        .set("aria-label", drawing.title.as_str())
        .add(Style::new(STYLE))
        .add(rectangle(0.0, 0.0, width.ceil(), height.ceil()).set("fill", "#ffffff"))
        .add(text(&drawing.title, MARGIN, 20.0, "title"));

    // Tints lie under the grid, and the grid under the waves.
    let mut waves_above = Group::new();
    let mut tints = Group::new();
    for (index, row) in drawing.rows.iter().enumerate() {
        let top = HEAD + ROW * index as f64 + (ROW - WAVE) / 2.0;
        let base = top + WAVE / 2.0 + 4.0;
        let (signal, stream) = match row {
            Row::Clock => {
                waves_above = waves_above
                    .add(text("clock", left - 8.0, base, "name"))
                    .add(wave(clock_path(cycles.len(), left, top, cell), "wave clock"));
                continue;
            }
            Row::Heading(heading) => {
                waves_above = waves_above.add(text(heading, MARGIN, base, "heading"));
                continue;
            }
            Row::Bit { signal, stream } | Row::Bus { signal, stream, .. } => (signal, stream),
        };
        let values = samples(waves, signal, &cycles)?;
        if let Some(stream) = *stream {
            let streams = drawing.streams.len();
            let missing = || DrawError::Stream { signal: signal.clone(), stream, streams };
            let Stream { valid, ready } = drawing.streams.get(stream).ok_or_else(missing)?;
            let valid = samples(waves, valid, &cycles)?;
            let ready = samples(waves, ready, &cycles)?;
            for (cycle, (valid, ready)) in valid.iter().zip(&ready).enumerate() {
                if !valid.is_some_and(Value::is_high) {
                    continue;
                }
                let class = if ready.is_some_and(Value::is_high) { "beat" } else { "stall" };
                let x = left + cell * cycle as f64;
                tints = tints.add(rectangle(x, top - (ROW - WAVE) / 2.0, cell, ROW).set("class", class));
            }
        }
        for run in runs(&values) {
            if !run.value.is_some_and(Value::is_known) {
                let x = left + cell * run.cycles.start as f64;
                let unknown = rectangle(x, top, cell * run.cycles.len() as f64, WAVE).set("class", "unknown");
                tints = tints.add(unknown);
            }
        }
        waves_above = waves_above.add(text(signal, left - 8.0, base, "name"));
        match row {
            Row::Bus { label, .. } => {
                waves_above = waves_above.add(wave(bus_path(&values, left, top, cell), "wave"));
                for run in runs(&values) {
                    let room = cell * run.cycles.len() as f64 - 2.0 * SLANT;
                    let full = run.value.map_or_else(|| "x".into(), |value| label.text(value));
                    let x = left + cell * (run.cycles.start + run.cycles.end) as f64 / 2.0;
                    let mut shown = text(&shorten(&full, room), x, base, "value");
                    if !full.is_empty() {
                        // What has no room is still to be read, by pointing at it.
                        shown = shown.add(Title::new(full));
                    }
                    waves_above = waves_above.add(shown);
                }
            }
            _ => waves_above = waves_above.add(wave(bit_path(&values, left, top, cell), "wave")),
        }
    }

    let mut grid = Group::new();
    for (index, cycle) in cycles.iter().enumerate() {
        let x = left + cell * index as f64;
        grid = grid.add(line(x, HEAD - 8.0, bottom));
        // Numbers that would run into each other are left out.
        let every = (cycle.to_string().len() as f64 * 7.0 / cell).ceil().max(1.0) as usize;
        if index % every == 0 {
            grid = grid.add(text(&cycle.to_string(), x + 3.0, HEAD - 4.0, "cycle"));
        }
    }
    document = document.add(tints).add(grid.add(line(right, HEAD - 8.0, bottom))).add(waves_above);
    if key_room > 0.0 {
        document = document.add(text(key, left, bottom + 20.0, "cycle"));
    }
    Ok(format!("{document}\n"))
}

fn samples<'w>(waves: &'w Waves, signal: &str, cycles: &[u64]) -> Result<Vec<Option<&'w Value>>, DrawError> {
    let trace = waves.trace(signal).ok_or_else(|| DrawError::Signal(signal.to_string()))?;
    let first = waves.cycles().start;
    Ok(cycles.iter().map(|cycle| trace.at_edge((cycle - first) as usize)).collect())
}

/// A value and the cycles through which it stands.
struct Run<'w> {
    value: Option<&'w Value>,
    cycles: Range<usize>,
}

fn runs<'w>(values: &[Option<&'w Value>]) -> Vec<Run<'w>> {
    let mut runs: Vec<Run<'w>> = Vec::new();
    for (cycle, value) in values.iter().enumerate() {
        match runs.last_mut() {
            Some(run) if run.value == *value => run.cycles.end = cycle + 1,
            _ => runs.push(Run { value: *value, cycles: cycle..cycle + 1 }),
        }
    }
    runs
}

fn clock_path(cycles: usize, left: f64, top: f64, cell: f64) -> String {
    let mut path = format!("M{left:.1},{:.1}", top + WAVE);
    for cycle in 0..cycles {
        let x = left + cell * cycle as f64;
        let (middle, end) = (x + cell / 2.0, x + cell);
        let _ = write!(path, "V{top:.1}H{middle:.1}V{:.1}H{end:.1}", top + WAVE);
    }
    let _ = write!(path, "V{top:.1}");
    path
}

fn bit_path(values: &[Option<&Value>], left: f64, top: f64, cell: f64) -> String {
    let mut path = String::new();
    for run in runs(values) {
        let y = match run.value {
            Some(value) if !value.is_known() => top + WAVE / 2.0,
            Some(value) if value.is_high() => top,
            Some(_) => top + WAVE,
            None => top + WAVE / 2.0,
        };
        let (start, end) = (left + cell * run.cycles.start as f64, left + cell * run.cycles.end as f64);
        let _ = match path.is_empty() {
            true => write!(path, "M{start:.1},{y:.1}H{end:.1}"),
            false => write!(path, "L{:.1},{y:.1}H{end:.1}", start + SLANT),
        };
    }
    path
}

/// One outline a value, pointed where the value changes.
fn bus_path(values: &[Option<&Value>], left: f64, top: f64, cell: f64) -> String {
    let (middle, bottom) = (top + WAVE / 2.0, top + WAVE);
    runs(values).iter().fold(String::new(), |mut path, run| {
        let (start, end) = (left + cell * run.cycles.start as f64, left + cell * run.cycles.end as f64);
        let (inner_start, inner_end) = (start + SLANT, end - SLANT);
        let _ = write!(
            path,
            "M{start:.1},{middle:.1}L{inner_start:.1},{top:.1}H{inner_end:.1}L{end:.1},{middle:.1}\
             L{inner_end:.1},{bottom:.1}H{inner_start:.1}Z"
        );
        path
    })
}

fn shorten(text: &str, room: f64) -> String {
    // The letters of a value are smaller than those of a name.
    let letters = (room / (LETTER * 0.92)).floor().max(0.0) as usize;
    if text.chars().count() <= letters {
        return text.to_string();
    }
    match letters {
        0 => String::new(),
        1 => "…".into(),
        _ => text.chars().take(letters - 1).chain(['…']).collect(),
    }
}

fn text(content: &str, x: f64, y: f64, class: &str) -> Text {
    Text::new(content).set("x", round(x)).set("y", round(y)).set("class", class)
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Rectangle {
    Rectangle::new().set("x", round(x)).set("y", round(y)).set("width", round(width)).set("height", round(height))
}

fn wave(path: String, class: &str) -> Path {
    Path::new().set("class", class).set("d", path)
}

fn line(x: f64, top: f64, bottom: f64) -> Line {
    Line::new()
        .set("class", "grid")
        .set("x1", round(x))
        .set("x2", round(x))
        .set("y1", round(top))
        .set("y2", round(bottom))
}

/// A tenth of a pixel is enough, and keeps the text short.
fn round(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}
