// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief check`: do the blocks equal their golden models, and the emitted Verilog the blocks?

use std::fmt::Write as _;
use std::io::{Write as _, stderr, stdout};
use std::path::PathBuf;
use std::time::Duration;

use quick_junit::{NonSuccessKind, Report as Junit, TestCase, TestCaseStatus, TestSuite};
use relief_testbench::check::{Check, Engine, Report, Row, Verdict, check};
use relief_testbench::output::OutputFile;

use super::{Meter, Outcome, Result, count, select, write_all};

/// Check blocks against their golden models, in rust-hdl, Verilator and Icarus
///
/// The block runs in rust-hdl and is compared with the golden model beat by beat, under idle cycles and backpressure.
/// The same cycles are replayed with the emitted Verilog and compared port by port. A vector is one accepted beat.
#[derive(clap::Args)]
pub struct Arguments {
    /// The blocks; all of them when none is named
    #[arg(value_name = "BLOCK")]
    blocks: Vec<String>,
    /// Vectors of each block
    #[arg(long, value_name = "N", default_value_t = 2000, value_parser = count, allow_negative_numbers = true)]
    vectors: u64,
    /// 1,000,000 vectors in rust-hdl and Verilator, and 10,000 of them in Icarus
    #[arg(long, conflicts_with = "vectors")]
    full: bool,
    /// Seed of beats, idle cycles and backpressure
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = count, allow_negative_numbers = true)]
    seed: u64,
    /// rust, verilator, icarus, or all that are installed
    #[arg(long, value_name = "ENGINE", default_value = "all")]
    engine: String,
    /// Width set; may be given several times
    #[arg(long, value_name = "NAME")]
    param: Vec<String>,
    /// Also write the table as a JUnit report
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Check the emitted design of this folder in the place of a fresh one; takes one block
    #[arg(long, value_name = "DIR")]
    sources: Option<PathBuf>,
    /// Tell on stderr how long each engine took
    #[arg(long)]
    timings: bool,
}

/// Vectors that Icarus replays at most; it is slow.
const ICARUS_VECTORS: u64 = 10_000;

/// Checks and reports.
pub fn run(arguments: &Arguments) -> Result {
    let blocks = select::blocks(&arguments.blocks)?;
    let names: Vec<Option<&str>> = match arguments.param.is_empty() {
        true => vec![None],
        false => arguments.param.iter().map(|name| Some(name.as_str())).collect(),
    };
    let sets = names.into_iter().map(select::width_set).collect::<std::result::Result<Vec<_>, _>>()?;
    for set in &sets {
        select::offered(&blocks, &arguments.blocks, set)?;
    }
    let engines = select::engines(&arguments.engine)?;
    if arguments.sources.is_some() && (blocks.len() != 1 || sets.len() != 1) {
        return Err("--sources names the folder of one design, so it takes one block and one --param".into());
    }
    if arguments.vectors == 0 {
        return Err("--vectors is 0, and a check of nothing would agree: give 1 or more".into());
    }
    if arguments.sources.is_some() && engines.run.iter().all(|engine| *engine == Engine::Rust) {
        return Err(
            "--sources is read by Verilator and Icarus alone: give --engine verilator or --engine icarus".into()
        );
    }
    // Opened before the work.
    let report = arguments.junit.as_deref().map(OutputFile::open).transpose()?;
    let vectors = if arguments.full { 1_000_000 } else { arguments.vectors };
    for (engine, missing) in &engines.skipped {
        write_all(stderr(), &format!("SKIPPED {engine}: install the Debian package {}\n", missing.package))?;
    }
    let head = format!(
        "{:16} {:10} {:10} {:>9} {:>11} {:>11}  verdict\n",
        "block", "width set", "engine", "vectors", "beats", "cycles"
    );
    write_all(stdout(), &head)?;
    let (mut reports, mut timings) = (Vec::new(), String::new());
    for block in &blocks {
        for set in sets.iter().filter(|set| block.offered(set)) {
            let meter = Meter::new();
            let mut plan = Check::new(*block, set);
            plan.engines.clone_from(&engines.run);
            (plan.vectors, plan.icarus_vectors, plan.seed) = (vectors, ICARUS_VECTORS, arguments.seed);
            plan.sources.clone_from(&arguments.sources);
            let report = check(&plan, &meter);
            // The bar goes before anything is said.
            meter.finish();
            let report = report.map_err(|error| format!("{}, width set {}: {error}", block.name(), set.name))?;
            let mut text: String = report.rows.iter().map(|row| line(&report, row)).collect();
            for (engine, _) in &engines.skipped {
                let (block, set) = (report.block, report.set);
                writeln!(text, "{block:16} {set:10} {engine:10} {:>9} {:>11} {:>11}  SKIPPED", "-", "-", "-")?;
            }
            if let Some(failure) = &report.failure {
                writeln!(text, "{failure}")?;
            }
            write_all(stdout(), &text)?;
            for row in &report.rows {
                writeln!(timings, "{}", timing(&report, row))?;
            }
            reports.push(report);
        }
    }
    if arguments.timings {
        write_all(stderr(), &timings)?;
    }
    if let Some(mut file) = report {
        file.write_all(junit(&reports, &engines).to_string()?.as_bytes())?;
        file.commit()?;
    }
    let agreed = reports.iter().all(|report| report.failure.is_none());
    Ok(if agreed { Outcome::Agreed } else { Outcome::Mismatch })
}

fn line(report: &Report, row: &Row) -> String {
    let Row { engine, vectors, beats, cycles, .. } = row;
    let verdict = match row.verdict {
        Verdict::Agreed => "agreed",
        Verdict::Mismatch => "MISMATCH",
        Verdict::Stopped => "stopped",
    };
    format!("{:16} {:10} {engine:10} {vectors:>9} {beats:>11} {cycles:>11}  {verdict}\n", report.block, report.set)
}

fn timing(report: &Report, row: &Row) -> String {
    let seconds = row.time.as_secs_f64();
    let rate = |count: u64| if seconds > 0.0 { count as f64 / seconds } else { 0.0 };
    format!(
        "{seconds:8.3} s {} {} {}: {:.0} vectors/s, {:.0} cycles/s",
        report.block,
        report.set,
        row.engine,
        rate(row.vectors),
        rate(row.cycles)
    )
}

/// A suite for each block and width set, and in it a case for each engine.
fn junit(reports: &[Report], engines: &select::Engines) -> Junit {
    let mut junit = Junit::new("relief check");
    for report in reports {
        let mut suite = TestSuite::new(format!("{}.{}", report.block, report.set));
        let case = |engine: Engine, status, time: Duration| {
            let mut case = TestCase::new(engine.name(), status);
            case.set_classname(format!("{}.{}", report.block, report.set)).set_time(time);
            case
        };
        for row in &report.rows {
            let status = match (&row.verdict, &report.failure) {
                (Verdict::Mismatch, Some(failure)) => {
                    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                    status.set_message(failure.mismatch.to_string()).set_description(failure.to_string());
                    status
                }
                (Verdict::Stopped, _) => TestCaseStatus::skipped(),
                _ => TestCaseStatus::success(),
            };
            let mut case = case(row.engine, status, row.time);
            let Row { vectors, beats, cycles, .. } = row;
            case.set_system_out(format!("{vectors} vectors, {beats} beats, {cycles} cycles"));
            suite.add_test_case(case);
        }
        for (engine, missing) in &engines.skipped {
            let mut status = TestCaseStatus::skipped();
            status.set_message(missing.to_string());
            suite.add_test_case(case(*engine, status, Duration::ZERO));
        }
        junit.add_test_suite(suite);
    }
    junit
}
