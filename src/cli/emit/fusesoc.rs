// SPDX-License-Identifier: MIT OR Apache-2.0
//! The description of an emitted block for FuseSoC (CAPI2): its files, a lint target and a simulation.

use relief_hdl::widths::WidthSet;
use relief_testbench::binding::Binding;

/// The text of `relief_<block>.core`: `list` is what `filelist.f` holds, and `roms` are memory contents that modules read.
pub fn core(block: &dyn Binding, set: &WidthSet, list: &str, roms: &[String], axi_stream: bool) -> String {
    let (name, version) = (block.name(), env!("CARGO_PKG_VERSION"));
    let top = format!("relief_{name}");
    let line = |file: &str| format!("      - {file}\n");
    // A simulator looks for these in the folder in which it runs.
    let data = |file: &str| format!("      - {file}: {{file_type: user, copyto: {file}}}\n");
    let modules: String = list.lines().map(line).collect();
    let roms: String = roms.iter().map(|file| data(file)).collect();
    let (mut filesets, mut rtl) = (String::new(), "rtl".to_owned());
    if axi_stream {
        filesets =
            format!("  axis:\n    files:\n{}    file_type: systemVerilogSource\n", line(&format!("{top}_axis.sv")));
        rtl += ", axis";
    }
    let bench = line(&format!("{top}_tb.sv"));
    let golden = data("in.hex") + &data("out.hex");
    format!(
        "\
CAPI=2:
# SPDX-License-Identifier: MIT OR Apache-2.0
# Written by `relief emit`, width set {set}. In the folder above:
#
#   $ fusesoc --cores-root . run --target lint relief:blocks:{name}
#   $ fusesoc --cores-root . run --target sim relief:blocks:{name}
name: relief:blocks:{name}:{version}
description: \"{summary}\"

filesets:
  rtl:
    files:
{modules}{roms}    file_type: systemVerilogSource
{filesets}  bench:
    files:
{bench}{golden}    file_type: systemVerilogSource

targets:
  default: &default
    filesets: [{rtl}]
    toplevel: {top}
  lint:
    <<: *default
    description: Verilator with all warnings
    flow: lint
    flow_options:
      tool: verilator
      verilator_options: [-Wall]
  sim:
    <<: *default
    description: Golden vectors under idle cycles and backpressure, PASS or FAIL
    filesets: [{rtl}, bench]
    toplevel: {top}_tb
    flow: sim
    flow_options:
      tool: icarus
      iverilog_options: [-g2012]
",
        set = set.name,
        summary = block.summary(),
    )
}
