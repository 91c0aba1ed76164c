// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief plan`: the least hardware that a scene needs.

use std::fmt::Write as _;
use std::io::{stderr, stdout};
use std::path::PathBuf;

use relief::synth::cost::{BLOCKS, Cost, PART, Planes};
use relief::synth::figures::Figures;
use relief_hdl::widths::{WIDTH_SETS, WidthSet};
use relief_models::draw::DrawError;
use relief_models::mesh::Progress;
use relief_models::plan::{Breaks, Plan, PlanError, Planner, Trial, Widths};
use relief_models::scene::{self, Entry, Scene};
use relief_testbench::frame::{FrameError, cycles, prepare, width_set};
use relief_testbench::pipeline::Pipeline;
use relief_testbench::remesher::format;
use serde::Serialize;

use super::{Meter, Outcome, Result, write_all};

/// Find the least widths for a scene, and the smallest width set that has them
///
/// Every width is as small as an error on the screen allows: components, bits of a component, guard bits, bits of a grid
/// coordinate, column memory, levels of the map. The scene is drawn with them by the golden models, and each vertex in the
/// picture is compared with its place in f64; then with each width one less, which shows what breaks. What a width saves
/// against `default` is estimated from the measured width sets; what a width set saves is measured. See docs/plan.md.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene (TOML)
    scene: PathBuf,
    /// The greatest error of a vertex in the picture, in pixels
    #[arg(long, value_name = "PX", default_value = "0.1", value_parser = pixels, allow_negative_numbers = true)]
    error: f64,
    /// Run the scene on the hardware of the width set, too, compared with golden beat by beat
    #[arg(long)]
    hardware: bool,
    /// Write the plan as JSON
    #[arg(long)]
    json: bool,
}

/// DP16KD of an ECP5-85k.
const BLOCK_RAMS: f64 = 208.0;

fn pixels(text: &str) -> std::result::Result<f64, String> {
    let pixels = text.parse().ok().filter(|pixels| (0.001..=64.0).contains(pixels));
    pixels.ok_or_else(|| "a number of pixels from 0.001 to 64 is expected".into())
}

#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    scene: String,
    plan: &'a Plan,
    /// What each choice saves against `default`, about, in the order of the plan's.
    saves: &'a [Cost],
    width_set: Option<SetReport>,
}

/// The smallest declared width set that has the planned widths.
#[derive(Clone, Copy, Serialize)]
struct SetReport {
    name: &'static str,
    trial: Trial,
    /// What its blocks take, measured; none where a row is missing.
    cost: Option<Cost>,
    /// The set that `run` takes by itself, and what its blocks take.
    otherwise: &'static str,
    otherwise_cost: Option<Cost>,
    /// Beats that the hardware sent, all equal to golden.
    beats: Option<u64>,
}

/// Plans, proves and prints.
pub fn run(arguments: &Arguments) -> Result {
    let scene = scene::read(&arguments.scene)?;
    let explain = |error: PlanError| match &error {
        PlanError::Draw(_, cause @ (DrawError::Focal { .. } | DrawError::Extent { .. })) => {
            scene.source.error(Entry::Camera, cause)
        }
        PlanError::Draw(at, cause) => scene.source.error(Entry::Object(*at), cause),
        PlanError::Much { .. } | PlanError::Rules(_) => scene.source.error(Entry::Remesh, &error),
        PlanError::Nothing => scene.source.error(Entry::Camera, &error),
        PlanError::Bound { .. } => scene.source.whole(error.to_string()),
    };
    let figures = Figures::of_this_version()?;
    let planes = Planes::new(&figures).ok_or("docs/figures.json has too few width sets of remesher and strip_unit")?;
    let meter = Meter::new();
    let planner = Planner::new(&scene, &meter).map_err(explain)?;
    let plan = planner.plan(arguments.error).map_err(explain)?;
    let set = smallest(&plan);
    let report = match set {
        None => None,
        Some(set) => {
            let widths = Widths { format: format(set), levels: plan.widths.levels };
            let trial = planner.try_widths(&widths).map_err(explain)?;
            let beats = match arguments.hardware.then(|| hardware(&scene, set, &plan, &meter)) {
                None => None,
                Some(Ok(beats)) => Some(beats),
                Some(Err(error)) => {
                    meter.finish();
                    if error.downcast_ref::<FrameError>().is_some_and(FrameError::is_mismatch) {
                        write_all(stderr(), &format!("mismatch: {error}\n"))?;
                        return Ok(Outcome::Mismatch);
                    }
                    return Err(error);
                }
            };
            let otherwise = width_set(&scene);
            let [cost, otherwise_cost] = [set, otherwise].map(|set| measured(&figures, set));
            Some(SetReport { name: set.name, trial, cost, otherwise: otherwise.name, otherwise_cost, beats })
        }
    };
    meter.finish();
    let saves = savings(&planes, &plan);
    if arguments.json {
        let scene = arguments.scene.display().to_string();
        let report = Report { version: 1, scene, plan: &plan, saves: &saves, width_set: report };
        write_all(stdout(), &(serde_json::to_string_pretty(&report)? + "\n"))?;
    } else {
        write_all(stdout(), &text(arguments, &plan, &saves, report.as_ref()))?;
    }
    if let Some(SetReport { trial, name, .. }) = report
        && trial.deviation.max > plan.bound
    {
        write_all(stderr(), &format!("mismatch: width set {name} gives {:.4} px\n", trial.deviation.max))?;
        return Ok(Outcome::Mismatch);
    }
    Ok(Outcome::Agreed)
}

/// The declared set with the fewest bits of accumulators, and the smallest map memory, that has the planned widths.
fn smallest(plan: &Plan) -> Option<&'static WidthSet> {
    let needed = &plan.widths.format;
    let suffices = |set: &&WidthSet| {
        set.components >= needed.components
            && set.vertex_bits >= needed.vertex_bits as usize
            && set.guard_bits >= needed.guard_bits as usize
            && set.coordinate_bits >= needed.coordinate_bits as usize
            && set.column_depth >= needed.column_depth
            && set.bank_words() >= plan.bank_words
            && (1 << set.side_width()) > plan.side
    };
    let size = |set: &&WidthSet| (set.components * set.accumulator_bits(), set.texel_bits, set.side_bits);
    WIDTH_SETS.iter().filter(suffices).min_by_key(size)
}

/// Runs the scene on the blocks of a width set: beats, all of which equal golden.
fn hardware(
    scene: &Scene,
    set: &'static WidthSet,
    plan: &Plan,
    meter: &Meter,
) -> std::result::Result<u64, Box<dyn std::error::Error>> {
    let mut scene = scene.clone();
    scene.remesh.levels = plan.widths.levels;
    let prepared = prepare(&scene, set)?;
    let mut pipeline = Pipeline::new(set);
    meter.phase("drawing in hardware", 0);
    cycles(&prepared, &mut pipeline)?;
    Ok(pipeline.compared().iter().sum())
}

/// What each choice alone saves against the default set.
fn savings(planes: &Planes, plan: &Plan) -> Vec<Cost> {
    let default = &WIDTH_SETS[0];
    // A memory for all levels of the scene's maps: the default one may hold less, or far more.
    let (whole, words) = (format(default), plan.all_bank_words);
    let all = planes.cost(&whole, words);
    let planned = &plan.widths.format;
    let mut changed = [whole; 6];
    changed[0].components = planned.components;
    changed[1].vertex_bits = planned.vertex_bits;
    changed[2].guard_bits = planned.guard_bits;
    changed[3].coordinate_bits = planned.coordinate_bits;
    changed[4].column_depth = planned.column_depth;
    let mut saves: Vec<Cost> = changed.iter().map(|format| all.less(planes.cost(format, words))).collect();
    saves[5] = all.less(planes.cost(&whole, plan.bank_words));
    saves
}

/// What the blocks of a scene take at a width set.
fn measured(figures: &Figures, set: &WidthSet) -> Option<Cost> {
    let mut sum = Cost { lut: 0.0, ff: 0.0, bram: 0.0 };
    for block in BLOCKS {
        // Sets of the same vertices have the same remesher and strip unit, those of the same maps the same memory.
        let vertices = ["remesher", "strip_unit"].contains(&block);
        let same = |other: &WidthSet| match vertices {
            true => other.has_vertices_of(set),
            false => (other.side_bits, other.texel_bits) == (set.side_bits, set.texel_bits),
        };
        let is_same = |name: &str| WIDTH_SETS.iter().any(|other| other.name == name && same(other));
        let row = figures.rows.iter().find(|row| row.block == block && row.target == PART && is_same(&row.set))?;
        sum = Cost { lut: sum.lut + row.lut as f64, ff: sum.ff + row.ff as f64, bram: sum.bram + row.bram as f64 };
    }
    Some(sum)
}

fn text(arguments: &Arguments, plan: &Plan, saves: &[Cost], set: Option<&SetReport>) -> String {
    let mut text = String::new();
    let default = &WIDTH_SETS[0];
    let error = |trial: &Trial| format!("{:.4} px at most, {:.4} px RMS", trial.deviation.max, trial.deviation.rms());
    let _ = writeln!(text, "vertices in the picture    {}", plan.planned.deviation.vertices);
    let _ = writeln!(text, "bound                      {} px", plan.bound);
    let _ = writeln!(text, "error of the widest        {}", error(&plan.widest));
    let _ = writeln!(text, "error as planned           {}\n", error(&plan.planned));
    let _ = writeln!(text, "{:26} {:>8} {:>8}  {:38} saves about", "width", "wide", "planned", "one less");
    let defaults = [
        default.components,
        default.vertex_bits,
        default.guard_bits,
        default.coordinate_bits,
        default.column_depth,
        plan.all_levels,
    ];
    for ((choice, was), saved) in plan.choices.iter().zip(defaults).zip(saves) {
        let breaks = match choice.breaks {
            Breaks::Error(px) => format!("{px:.4} px"),
            Breaks::Places(count) => format!("vertices without a place: {count}"),
            Breaks::Grid(count) => format!("base triangles beyond the grid: {count}"),
            Breaks::Seam => "a seam may open".into(),
            Breaks::Again(count) => format!("vertices sent again: {count}"),
            Breaks::Components(least) => format!("the draw takes {least}"),
            Breaks::Displaced => "no room for displaced vertices".into(),
            Breaks::Least => "cannot be less".into(),
        };
        let Cost { lut, ff, bram } = *saved;
        let mut parts = Vec::new();
        for (amount, unit) in [(lut, "LUT"), (ff, "FF"), (bram, "DP16KD")] {
            if amount.abs() >= 0.5 {
                parts.push(format!("{amount:.0} {unit}"));
            }
        }
        let saved = if parts.is_empty() { "-".to_owned() } else { parts.join(", ") };
        let _ = writeln!(text, "{:26} {was:>8} {:>8}  {breaks:38} {saved}", choice.name, choice.value);
    }
    let (all, left) = (plan.all_bank_words, plan.bank_words);
    let _ = writeln!(text, "{:26} {all:>8} {left:>8}", "map words in each bank");
    match set {
        None => text += "\nwidth set                  none of the list has these widths; add one to hdl/widths.rs\n",
        Some(set) => {
            let _ = writeln!(text, "\nwidth set                  {}: {}", set.name, error(&set.trial));
            if let (Some(cost), Some(all)) = (set.cost, set.otherwise_cost) {
                let share = |part: f64, whole: f64| format!("{part:.0} of {whole:.0}");
                let [lut, ff, bram] = [share(cost.lut, all.lut), share(cost.ff, all.ff), share(cost.bram, all.bram)];
                let heading = format!("its cells, of {}'s", set.otherwise);
                let _ = writeln!(text, "{heading:26} {lut} LUT, {ff} FF, {bram} DP16KD");
                let _ =
                    writeln!(text, "                           ({}: the blocks that depend on it)", BLOCKS.join(", "));
                if cost.bram > BLOCK_RAMS {
                    let _ = writeln!(
                        text,
                        "                           more block RAM than the {BLOCK_RAMS} of an ECP5-85k"
                    );
                }
            }
            if let Some(beats) = set.beats {
                let _ = writeln!(text, "on its hardware            {beats} beats equal golden");
            }
            let (scene, levels) = (arguments.scene.display().to_string(), plan.widths.levels);
            let scene = if scene.contains(char::is_whitespace) { format!("'{scene}'") } else { scene };
            let _ =
                writeln!(text, "to run it                  relief run {scene} --param {} --levels {levels}", set.name);
        }
    }
    text
}
