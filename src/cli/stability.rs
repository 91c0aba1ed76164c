// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief stability`: every method on the maps where methods fail, and the datapath on scenes where displacement fails.

use std::io::{stderr, stdout};

use rayon::prelude::*;
use relief_models::closure::Closure;
use relief_models::draw;
use relief_models::failures::{self, FailureScene};
use relief_models::mesh::Progress;
use relief_testbench::method::{Engine, Goal, METHODS, Verdict};
use relief_testbench::stability::{FailureMap, Row, cycles, maps, rows};

use super::engine::EngineName;
use super::{Meter, Outcome, Result, write_all};

/// Tessellate the maps on which methods fail, with every method, and draw the scenes on which displacement fails
///
/// Each map is tessellated under a bound of 2 % of its range (of 1 where it has none), and with the triangles of a grid of 8 x 8 cells. A mesh that
/// is not whole, or has an error above its method's claim, is BROKEN and fails the command. Errors are in percent of the
/// map's range.
///
/// Each scene is drawn twice, with every base triangle and without those that cannot be seen. An edge that is open for no
/// reason, neither the rim of the base mesh nor a counted drop, is a crack and fails the command. Errors are in pixels,
/// against f64. A closed body is drawn by every rule for levels that the golden models have, at three sizes of voxels; one
/// that keeps a mesh closed and does not fails the command. With an engine other than golden the blocks draw them in Rust. See docs/stability.md.
#[derive(clap::Args)]
pub struct Arguments {
    /// What computes the meshes
    #[arg(long, value_enum, default_value_t = EngineName::Golden)]
    engine: EngineName,
}

/// Runs all of them, and prints a table.
pub fn run(arguments: &Arguments) -> Result {
    let engine = arguments.engine.resolve()?;
    let meter = Meter::new();
    let done = rows(METHODS, engine, &meter);
    meter.finish();
    let rows = match done {
        Ok(rows) => rows,
        Err(error) if error.is_mismatch() => {
            write_all(stderr(), &format!("mismatch: {error}\n"))?;
            return Ok(Outcome::Mismatch);
        }
        Err(error) => return Err(error.into()),
    };
    write_all(stdout(), &table(&maps(), &rows))?;
    let broken = rows.iter().filter(|row| row.is_broken()).count();
    let meshes: Vec<_> = rows.iter().filter_map(|row| row.result.as_ref().ok()).collect();
    let held = meshes.iter().filter(|made| matches!(made.verdict, Verdict::Holds { .. })).count();
    let (made, refused) = (meshes.len(), rows.len() - meshes.len());
    write_all(stdout(), &format!("\n{made} meshes, {refused} refused: {held} claims hold, {broken} broken\n"))?;
    let cracked = frames(engine)? | rules()?;
    Ok(if broken == 0 && !cracked { Outcome::Agreed } else { Outcome::Mismatch })
}

/// Draws the scenes, prints a row for each, and says whether one of them cracks or the hardware departs from golden.
fn frames(engine: Engine) -> std::result::Result<bool, Box<dyn std::error::Error>> {
    let meter = Meter::new();
    let outcomes = failures::outcomes(&meter)?;
    let hardware: Vec<Option<u64>> = match engine {
        Engine::Golden => vec![None; outcomes.len()],
        _ => {
            meter.phase("drawing in hardware", outcomes.len() as u64);
            let run = |(failure, _): &(FailureScene, _)| cycles(failure).map(Some);
            match outcomes.par_iter().map(run).collect::<std::result::Result<_, _>>() {
                Ok(cycles) => cycles,
                Err(error) => {
                    meter.finish();
                    let what = if error.is_mismatch() { "mismatch" } else { "error" };
                    write_all(stderr(), &format!("{what}: {error}\n"))?;
                    return Ok(true);
                }
            }
        }
    };
    meter.finish();
    let mut text = String::from("\n");
    for ((failure, outcome), cycles) in outcomes.iter().zip(hardware) {
        let FailureScene { name, why, does, .. } = failure;
        text += &format!("{name}: {why}\n  {does}\n");
        for (which, closure) in [("whole", &outcome.whole), ("drawn", &outcome.drawn)] {
            let draw::Counts { kept, cut, culled, dropped, .. } = closure.assembled;
            let bases = format!("{kept} base triangles, {cut} of them cut, {} culled", culled.total());
            let gone = format!("dropped {} near, {} lane, {} grid", dropped.near, dropped.lane, dropped.grid);
            let (triangles, invalid) = (closure.triangles, closure.invalid);
            let open = format!("{} rim, {} dropped, {} cracks", closure.rim, closure.dropped, closure.cracks);
            text +=
                &format!("  {which}: {bases}, {gone}; {triangles} triangles, {invalid} invalid; open edges: {open}\n");
        }
        let deviation = &outcome.deviation;
        let (max, rms, vertices) = (deviation.max, deviation.rms(), deviation.vertices);
        let ran = cycles.map_or(String::new(), |cycles| format!("; {cycles} cycles, hardware = golden"));
        text += &format!("  {vertices} vertices in the picture, error {max:.4} px at most, {rms:.4} px RMS{ran}\n");
    }
    let cracked = outcomes.iter().filter(|(_, outcome)| outcome.is_cracked()).count();
    text += &format!("\n{} scenes, {cracked} with cracks\n", outcomes.len());
    write_all(stdout(), &text)?;
    Ok(cracked > 0)
}

/// Counts the open edges of a closed body by each rule, prints a row for each, and says whether a rule that keeps a mesh
/// closed has not.
fn rules() -> std::result::Result<bool, Box<dyn std::error::Error>> {
    let meter = Meter::new();
    let rows = failures::rule_rows(&meter)?;
    meter.finish();
    let mut text = String::from(
        "\na closed body by rule (footprint, extremum); open edges, corners that base triangles dispute, level steps at base edges\n",
    );
    text += "  cell rule               triangles    rim dropped cracks  corners  steps %\n";
    for row in &rows {
        let failures::RuleRow { rules, cell_px, closure, corners, disputed, links, stepped } = row;
        let corners = format!("{disputed}/{corners}");
        let share = || format!("{:.1}", 100.0 * *stepped as f64 / *links as f64);
        let steps = if *links == 0 { "-".to_owned() } else { share() };
        let Closure { triangles, rim, dropped, cracks, .. } = closure;
        text += &format!(
            "  {cell_px:>4} {rules:18} {triangles:>9} {rim:>6} {dropped:>7} {cracks:>6} {corners:>8} {steps:>8}\n"
        );
    }
    let broken = rows.iter().filter(|row| row.is_broken()).count();
    text += &format!("{} rows, {broken} with cracks where the rule forbids them\n", rows.len());
    write_all(stdout(), &text)?;
    Ok(broken > 0)
}

fn table(maps: &[FailureMap], rows: &[Row]) -> String {
    let mut text = String::new();
    for FailureMap { name, why, map } in maps {
        let [low, high] = map.range();
        text += &format!("{name}, {} x {}: {why}\n", map.width, map.height);
        let heads = ["method", "goal", "triangles", "max %", "rms %", "claim %", "slack %", "cycles"];
        text += &cells(&heads.map(str::to_owned), "verdict");
        // A map of one height has no range; its errors are shares of one step.
        let share = |error: f64| format!("{:.4}", 100.0 * error / f64::from(high.saturating_sub(low)).max(1.0));
        for Row { method, goal, result, .. } in rows.iter().filter(|row| row.map == *name) {
            let goal = match goal {
                Goal::Bound(_) => "bound".to_owned(),
                Goal::Triangles(most) => format!("{most} triangles"),
            };
            let dash = || "-".to_owned();
            text += &match result {
                Err(refusal) => {
                    cells(&[(*method).to_owned(), goal, dash(), dash(), dash(), dash(), dash(), dash()], refusal)
                }
                Ok(made) => {
                    let slack = if let Verdict::Holds { slack } = made.verdict { share(slack) } else { dash() };
                    let cycles = made.hardware.map_or_else(dash, |hardware| hardware.cycles.to_string());
                    let claim = made.claim.map_or_else(dash, share);
                    let (max, rms) = (share(made.max), share(made.rms));
                    let row = [(*method).to_owned(), goal, made.triangles.to_string(), max, rms, claim, slack, cycles];
                    cells(&row, made.verdict.name())
                }
            };
        }
        text += "\n";
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

fn cells([method, goal, figures @ ..]: &[String; 8], verdict: &str) -> String {
    let [triangles, max, rms, claim, slack, cycles] = figures;
    format!("  {method:21} {goal:13} {triangles:>9} {max:>9} {rms:>8} {claim:>9} {slack:>9} {cycles:>7}  {verdict}\n")
}
