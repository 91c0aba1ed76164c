// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief blocks`: which blocks there are.

use std::fmt::Write;
use std::io::stdout;

use relief_hdl::widths::{WIDTH_SETS, WidthSet};
use relief_testbench::binding::{BLOCKS, Binding, offered_sets};
use serde::Serialize;

use super::{Outcome, Result, write_all};

/// List the blocks with latency, interval, width sets and error bound
#[derive(clap::Args)]
pub struct Arguments {
    /// Write JSON
    #[arg(long)]
    json: bool,
}

/// A block as JSON holds it.
#[derive(Serialize)]
struct Block {
    name: &'static str,
    module: String,
    summary: &'static str,
    latency: &'static str,
    interval: &'static str,
    error: &'static str,
    stimulus: &'static str,
    width_sets: Vec<Set>,
}

/// A width set as JSON holds it.
#[derive(Serialize)]
struct Set {
    name: &'static str,
    summary: &'static str,
    components: usize,
    vertex_bits: usize,
    guard_bits: usize,
    accumulator_bits: usize,
    coordinate_bits: usize,
    column_depth: usize,
    side_bits: usize,
    texel_bits: usize,
    table_bits: usize,
    sum_bits: usize,
    lattice_bits: usize,
    error_bits: usize,
}

/// Lists.
pub fn run(arguments: &Arguments) -> Result {
    if arguments.json {
        let blocks: Vec<Block> = BLOCKS.iter().map(|block| json(*block)).collect();
        write_all(stdout(), &format!("{}\n", serde_json::to_string_pretty(&blocks)?))?;
        return Ok(Outcome::Agreed);
    }
    let mut text = String::new();
    for block in BLOCKS {
        writeln!(text, "{}: {}", block.name(), block.summary())?;
        writeln!(text, "    latency   {}", block.latency())?;
        writeln!(text, "    interval  {}", block.interval())?;
        writeln!(text, "    error     {}", block.error())?;
        writeln!(text, "    stimulus  {}", block.stimulus_format())?;
        let sets = offered_sets(*block);
        if sets.len() < WIDTH_SETS.len() {
            let names: Vec<&str> = sets.iter().map(|set| set.name).collect();
            writeln!(text, "    width sets  {}", names.join(", "))?;
        }
    }
    writeln!(text, "width sets (of every block that names no others; W is the bits of an accumulator)")?;
    for set in WIDTH_SETS {
        let WidthSet { name, summary, components, vertex_bits, guard_bits, coordinate_bits, column_depth, .. } = set;
        let bits = set.accumulator_bits();
        let (side, texels, table, sum) = (1 << set.side_bits, 1 << set.texel_bits, set.table_words(), set.sum_bits);
        let lattice = (1 << set.lattice_bits) + 1;
        writeln!(
            text,
            "    {name:9} L {components:<2}  V {vertex_bits}  g {guard_bits}  W {bits}  N {coordinate_bits}  column \
             {column_depth:<4}  maps to {side:<4}  in {texels:<7} texels  {table:<7} \
             sums of {sum}  lattice {lattice:<4}  {summary}"
        )?;
    }
    write_all(stdout(), &text)?;
    Ok(Outcome::Agreed)
}

fn json(block: &dyn Binding) -> Block {
    let set = |set: &WidthSet| Set {
        name: set.name,
        summary: set.summary,
        components: set.components,
        vertex_bits: set.vertex_bits,
        guard_bits: set.guard_bits,
        accumulator_bits: set.accumulator_bits(),
        coordinate_bits: set.coordinate_bits,
        column_depth: set.column_depth,
        side_bits: set.side_bits,
        texel_bits: set.texel_bits,
        table_bits: set.table_bits,
        sum_bits: set.sum_bits,
        lattice_bits: set.lattice_bits,
        error_bits: set.error_bits,
    };
    Block {
        name: block.name(),
        module: format!("relief_{}", block.name()),
        summary: block.summary(),
        latency: block.latency(),
        interval: block.interval(),
        error: block.error(),
        stimulus: block.stimulus_format(),
        width_sets: offered_sets(block).into_iter().map(set).collect(),
    }
}
