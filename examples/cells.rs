// SPDX-License-Identifier: MIT OR Apache-2.0
//! The cells of every block: `cargo run --release --example cells`
//!
//! Yosys maps the emitted Verilog to an ECP5 (`synth_ecp5`). It takes minutes for the remesher. The width set is `small`
//! unless another one is named: `-- default`.

use relief_hdl::widths::WIDTH_SETS;
use relief_testbench::binding::BLOCKS;
use relief_testbench::check::emitted;
use relief_testbench::cosim::yosys_synth_ecp5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "small".into());
    let set =
        WIDTH_SETS.iter().find(|set| set.name == name).ok_or_else(|| format!("there is no width set `{name}`"))?;
    println!("| block at `{name}` | LUT4 | CCU2C | flip-flops | DP16KD | MULT18X18D |\n|---|---:|---:|---:|---:|---:|");
    for block in BLOCKS {
        let cells = yosys_synth_ecp5(&emitted(*block, set, None)?.design)?;
        println!(
            "| {} | {} | {} | {} | {} | {} |",
            block.name(),
            cells.luts,
            cells.carries,
            cells.flip_flops,
            cells.block_rams,
            cells.multipliers
        );
    }
    Ok(())
}
