// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief synth`: what do blocks take of a part, and how fast are they there?

use std::fmt::Write;
use std::io::{stderr, stdout};
use std::path::Path;

use relief::synth::figures::Figures;
use relief::synth::measure::{Bench, Row, Tools};
use relief::synth::target::{self, TARGETS, Target};
use relief_models::mesh::Progress;

use super::{Meter, Outcome, Result, select, write_all};

/// Count the cells of blocks on a part, and measure their clock
///
/// Yosys maps the emitted Verilog. With --pnr, nextpnr places and routes it inside a shift register that leaves it four
/// pins, and the highest clock, the critical path and the beats a second are printed. See docs/synth.md.
#[derive(clap::Args)]
pub struct Arguments {
    /// The blocks; all of them when none is named
    #[arg(value_name = "BLOCK")]
    blocks: Vec<String>,
    /// ecp5-85k, ecp5-25k, ice40-up5k, ice40-hx8k, xc7 or gowin; may be given several times [default: ecp5-85k]
    #[arg(long, value_name = "TARGET")]
    target: Vec<String>,
    /// Width set; may be given several times [default: default]
    #[arg(long, value_name = "NAME")]
    param: Vec<String>,
    /// Place and route
    #[arg(long)]
    pnr: bool,
    /// Seeds of place and route; the median is what counts
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = seeds, allow_negative_numbers = true)]
    seeds: u64,
    /// Write JSON
    #[arg(long)]
    json: bool,
    /// Put the rows into docs/figures.json and the tables of README.md and docs/synth.md. Without --target these are all
    /// targets, placed and routed where that can be had; without --param the sets default and small
    #[arg(long)]
    figures: bool,
}

fn seeds(text: &str) -> std::result::Result<u64, String> {
    let number = text.parse().ok().filter(|number| (1..=99).contains(number));
    number.ok_or_else(|| "a whole number from 1 to 99 is expected".into())
}

/// Synthesizes and reports.
pub fn run(arguments: &Arguments) -> Result {
    let blocks = select::blocks(&arguments.blocks)?;
    let named = |given: &[String], none: &[&str], figures: &[&str]| -> Vec<String> {
        let names = if arguments.figures { figures } else { none };
        if given.is_empty() { names.iter().map(|name| (*name).to_owned()).collect() } else { given.to_vec() }
    };
    let all: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
    let targets = named(&arguments.target, &["ecp5-85k"], &all);
    let targets = targets.iter().map(|name| target::find(name)).collect::<std::result::Result<Vec<_>, _>>()?;
    let sets = named(&arguments.param, &["default"], &["default", "small"]);
    let sets = sets.iter().map(|name| select::width_set(Some(name))).collect::<std::result::Result<Vec<_>, _>>()?;
    for set in &sets {
        select::offered(&blocks, &arguments.blocks, set)?;
    }
    // The programs are looked for before the work.
    let routed =
        |target: &Target| arguments.pnr || arguments.figures && arguments.target.is_empty() && target.route.is_ok();
    let tools = targets.iter().map(|target| Tools::find(target, routed(target)));
    let tools = tools.collect::<std::result::Result<Vec<_>, _>>()?;
    let project = Path::new("");
    let mut figures = if arguments.figures { Some(Figures::read(project)?) } else { None };
    if let Some(figures) = &figures {
        // What cannot be written later is refused now; the same figures are the same bytes.
        figures.write(project)?;
    }
    let pairs: usize = sets.iter().map(|set| blocks.iter().filter(|block| block.offered(set)).count()).sum();
    let meter = Meter::new();
    meter.phase("synthesizing", (pairs * targets.len()) as u64);
    let (mut rows, mut done): (Vec<Row>, _) = (Vec::new(), 0);
    if !arguments.json {
        write_all(stdout(), &head())?;
    }
    for block in blocks {
        for set in sets.iter().filter(|set| block.offered(set)) {
            let bench = Bench::new(block, set)?;
            for (target, tools) in targets.iter().zip(&tools) {
                let row = bench.measure(target, tools, arguments.seeds);
                let row = row.map_err(|error| format!("{}, width set {}: {error}", block.name(), set.name))?;
                done += 1;
                meter.advance(done);
                if !arguments.json {
                    meter.aside(|| write_all(stdout(), &line(&row)))?;
                }
                // Hours may follow, and what is known by now shall last.
                if let Some(figures) = &mut figures {
                    figures.merge(vec![row.clone()]);
                    figures.write(project)?;
                }
                rows.push(row);
            }
        }
    }
    meter.finish();
    if arguments.json {
        write_all(stdout(), &format!("{}\n", serde_json::to_string_pretty(&rows)?))?;
    }
    write_all(stderr(), &advice(&rows)?)?;
    Ok(Outcome::Agreed)
}

fn head() -> String {
    format!(
        "{:18} {:9} {:10} {:>7} {:>7} {:>6} {:>5} {:>10} {:>9}\n",
        "block", "width set", "target", "LUT", "FF", "BRAM", "DSP", "Fmax, MHz", "Mbeats/s"
    )
}

/// A row, and below it what limits it.
fn line(row: &Row) -> String {
    let number = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.1}"));
    let (fmax, rate) = (number(row.fmax_mhz), number(row.mbeats_per_s));
    let Row { block, set, target, lut, ff, bram, dsp, .. } = row;
    let limit =
        Some(row.limit()).filter(|limit| !limit.is_empty()).map_or(String::new(), |text| format!("    {text}\n"));
    format!("{block:18} {set:9} {target:10} {lut:>7} {ff:>7} {bram:>6} {dsp:>5} {fmax:>10} {rate:>9}\n{limit}")
}

/// What is below its goal, and what to try where a block does not fit.
fn advice(rows: &[Row]) -> std::result::Result<String, std::fmt::Error> {
    let mut text = String::new();
    for row in rows {
        let goal = TARGETS.iter().find(|target| target.name == row.target).and_then(|target| target.goal_mhz);
        if let (Some(goal), Some(fmax)) = (goal, row.fmax_mhz)
            && fmax < goal
        {
            writeln!(text, "{} at {}: {fmax:.1} MHz on {}, and {goal} are asked for", row.block, row.set, row.target)?;
        }
        let others = || rows.iter().filter(|other| other.block == row.block && other.target == row.target);
        match (&row.no_clock, row.set.as_str()) {
            (None, _) => {}
            (Some(_), "small") => writeln!(text, "{} has no clock on {} even at small", row.block, row.target)?,
            (Some(_), _) if others().any(|other| other.set == "small") => {}
            (Some(_), set) => {
                writeln!(text, "{} at {set} has no clock on {}: try --param small", row.block, row.target)?
            }
        }
    }
    Ok(text)
}
