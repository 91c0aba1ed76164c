// SPDX-License-Identifier: MIT OR Apache-2.0
//! `docs/figures.json`, and the tables of the documents that are made of it.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use relief_hdl::widths::WIDTH_SETS;
use relief_testbench::binding::BLOCKS;
use relief_testbench::output::OutputFile;
use serde::{Deserialize, Serialize};

use super::measure::Row;
use super::target::{TARGETS, Target};

/// The file of all rows.
pub const FIGURES: &str = "docs/figures.json";

/// The documents with a table, and whether it has every part or only the one of the README.
const DOCUMENTS: [(&str, bool); 2] = [("README.md", false), ("docs/synth.md", true)];

/// What stands round a table.
const MARKS: [&str; 2] = ["<!-- figures -->\n", "<!-- end of figures -->"];

/// The part of the README's table.
const MAIN: &str = "ecp5-85k";

/// What the file holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Of the format.
    pub version: u32,
    /// A row for each block, width set and part.
    pub rows: Vec<Row>,
}

impl Figures {
    /// Those that this program was built with.
    ///
    /// # Errors
    /// A sentence: the file was damaged then.
    pub fn of_this_version() -> Result<Figures, String> {
        let text = include_str!("../../docs/figures.json");
        serde_json::from_str(text).map_err(|error| format!("{FIGURES}: is no file of figures: {error}"))
    }

    /// Reads the file of a project; no rows where there is none yet.
    ///
    /// # Errors
    /// A sentence: it cannot be read, or is no such file.
    pub fn read(project: &Path) -> Result<Figures, String> {
        let path = project.join(FIGURES);
        if !path.exists() {
            return Ok(Figures { version: 1, rows: vec![] });
        }
        let text = fs::read_to_string(&path).map_err(|error| format!("{}: cannot be read: {error}", path.display()))?;
        serde_json::from_str(&text).map_err(|error| format!("{}: is no file of figures: {error}", path.display()))
    }

    /// Takes rows in the place of those for the same block, width set and part, and keeps the order of blocks, sets and
    /// parts, so that the same figures are the same bytes. Rows of what there is no more go.
    pub fn merge(&mut self, rows: Vec<Row>) {
        for row in rows {
            self.rows.retain(|old| (&old.block, &old.set, &old.target) != (&row.block, &row.set, &row.target));
            self.rows.push(row);
        }
        let place = |row: &Row| {
            let block = BLOCKS.iter().position(|block| block.name() == row.block)?;
            let set = WIDTH_SETS.iter().position(|set| set.name == row.set)?;
            Some((block, set, TARGETS.iter().position(|target| target.name == row.target)?))
        };
        self.rows.retain(|row| place(row).is_some());
        self.rows.sort_by_key(|row| place(row));
    }

    /// Writes the file and the tables of the documents. Nothing is written unless all of it can be made.
    ///
    /// # Errors
    /// A sentence: a document is missing or has no marks, or the system refuses.
    pub fn write(&self, project: &Path) -> Result<(), String> {
        let mut files = vec![(project.join(FIGURES), self.json()?)];
        for (name, every) in DOCUMENTS {
            let path = project.join(name);
            let text = fs::read_to_string(&path).map_err(|error| {
                format!("{}: cannot be read: {error}; --figures works in the project's own folder", path.display())
            })?;
            let table = self.tables(every);
            files.push((
                path.clone(),
                between_marks(&text, &table).map_err(|why| format!("{}: {why}", path.display()))?,
            ));
        }
        files.iter().try_for_each(|(path, text)| OutputFile::replace(path, text.as_bytes()))
    }

    fn json(&self) -> Result<String, String> {
        let text = serde_json::to_string_pretty(self).map_err(|error| error.to_string())?;
        Ok(format!("{text}\n"))
    }

    /// A table for each part, or for the README's alone.
    pub fn tables(&self, every: bool) -> String {
        let measured = |target: &&Target| self.rows.iter().any(|row| row.target == target.name);
        let targets = TARGETS.iter().filter(|target| every || target.name == MAIN).filter(measured);
        targets.map(|target| self.table(target, every)).collect::<Vec<_>>().join("\n")
    }

    fn table(&self, target: &Target, paths: bool) -> String {
        let rows: Vec<&Row> = self.rows.iter().filter(|row| row.target == target.name).collect();
        let [bram, dsp] = target.units;
        let mut tools: Vec<&str> = rows.iter().flat_map(|row| &row.tools).map(String::as_str).collect();
        tools.sort_unstable();
        tools.dedup();
        let mut text = format!("`{}`: {} ({}).\n\n", target.name, target.part, tools.join(", "));
        let limit = if paths { " critical path |" } else { "" };
        let _ = writeln!(text, "| block | width set | LUT | FF | {bram} | {dsp} | Fmax, MHz | Mbeats/s |{limit}");
        let _ = writeln!(text, "|---|---|---:|---:|---:|---:|---:|---:|{}", if paths { "---|" } else { "" });
        for row in rows {
            let number = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.1}"));
            let clock = match &row.no_clock {
                Some(reason) if !paths => reason.split(':').next().unwrap_or_default().into(),
                _ => number(row.fmax_mhz),
            };
            let _ = write!(
                text,
                "| {} | `{}` | {} | {} | {} | {} | {clock} | {} |",
                row.block,
                row.set,
                row.lut,
                row.ff,
                row.bram,
                row.dsp,
                number(row.mbeats_per_s)
            );
            if paths {
                let _ = write!(text, " {} |", row.limit().replace('|', "\\|"));
            }
            text.push('\n');
        }
        text
    }
}

impl Row {
    /// What limits the clock, or why there is none; empty where none was asked for.
    pub fn limit(&self) -> String {
        match (&self.no_clock, &self.critical_path) {
            (Some(reason), _) => reason.clone(),
            (None, Some(path)) => path.to_string(),
            (None, None) => String::new(),
        }
    }
}

/// The text with `table` between its marks.
///
/// # Errors
/// Half a sentence: there are no marks.
pub fn between_marks(text: &str, table: &str) -> Result<String, String> {
    let [begin, end] = MARKS;
    let found = text.split_once(begin).and_then(|(head, rest)| Some((head, rest.split_once(end)?.1)));
    let (head, tail) = found.ok_or_else(|| format!("has no lines `{}` and `{end}` for the table", begin.trim()))?;
    Ok(format!("{head}{begin}{table}{end}{tail}"))
}
