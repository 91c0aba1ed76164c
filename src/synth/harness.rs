// SPDX-License-Identifier: MIT OR Apache-2.0
//! A module round a block, for parts with fewer pins than the block has ports.
//!
//! Its pins are `clock`, `reset`, `serial_in` and `serial_out`. The inputs of the block are the bits of a shift register
//! that `serial_in` fills. Each output is captured in a register `<port>_captured`, and these are added without carries
//! to a second shift register, whose end is `serial_out`. So every path of the block starts and ends at a register, as it
//! does between blocks; nothing can be optimised away; and what the harness adds of its own is one look-up table between
//! two registers.

use std::fmt::Write;

use relief_hdl::verilog::{Direction, Module, PortInfo};

/// The name of the harness of a block.
pub fn name(block: &Module) -> String {
    format!("{}_harness", block.name)
}

/// The text of the harness of a block.
///
/// # Errors
/// A sentence: the block has fewer than two bits of inputs or outputs, or a port with the name of something else.
pub fn text(block: &Module) -> Result<String, String> {
    let of = |direction| -> Vec<&PortInfo> {
        let ports = block.ports.iter().filter(|port| port.direction == direction);
        ports.filter(|port| !["clock", "reset"].contains(&port.name.as_str())).collect()
    };
    let (inputs, outputs) = (of(Direction::Input), of(Direction::Output));
    let bits = |ports: &[&PortInfo]| ports.iter().map(|port| port.bits).sum::<usize>();
    let (ins, outs) = (bits(&inputs), bits(&outputs));
    if ins < 2 || outs < 2 {
        return Err(format!("{}: a harness takes at least two bits of inputs and of outputs", block.name));
    }
    let own = ["serial_in", "serial_out", "chain", "captured", "reset_q", "block"];
    if let Some(port) = block.ports.iter().find(|port| own.contains(&port.name.as_str())) {
        return Err(format!("{}: the harness has something called `{}` of its own", block.name, port.name));
    }
    // The first port lowest, as in the vectors of `relief emit`.
    let list = |ports: &[&PortInfo], end: &str| {
        ports.iter().rev().map(|port| format!("{}{end}", port.name)).collect::<Vec<_>>().join(", ")
    };
    // Shifted by one bit: the highest one goes.
    let (last, others) = inputs.split_last().ok_or("no inputs")?;
    let (end, kept) = match last.bits {
        1 => (last.name.clone(), String::new()),
        bits => (format!("{}[{}]", last.name, bits - 1), format!("{}[{}:0], ", last.name, bits - 2)),
    };
    let shifted = format!("{kept}{}", others.iter().rev().map(|port| format!("{}, ", port.name)).collect::<String>());
    let (mut declare, mut connect) = (String::new(), String::from(".clock(clock),\n        .reset(reset_q)"));
    let range = |bits: usize| if bits == 1 { String::new() } else { format!("[{}:0] ", bits - 1) };
    for port in &inputs {
        let _ = writeln!(declare, "    reg  {}{};", range(port.bits), port.name);
    }
    for port in &outputs {
        let (range, name) = (range(port.bits), &port.name);
        let _ = writeln!(declare, "    wire {range}{name};\n    reg  {range}{name}_captured;");
    }
    for port in inputs.iter().chain(&outputs) {
        let _ = write!(connect, ",\n        .{0}({0})", port.name);
    }
    Ok(format!(
        "// SPDX-License-Identifier: MIT OR Apache-2.0
// A shift register round {block} that leaves it four pins. Written by `relief synth`.
`default_nettype none

module {harness} (
    input  wire clock,
    input  wire reset,
    input  wire serial_in,
    output reg  serial_out
);

{declare}    reg  reset_q;
    reg  [{chain}:0] chain;
    wire [{chain}:0] captured;

    assign captured = {{{captured_names}}};

    always @(posedge clock) begin
        reset_q <= reset;
        {{{in_names}}} <= {{{shifted}serial_in}};
        {{{captured_names}}} <= {{{out_names}}};
        chain <= {{chain[{out_below}:0], {end}}} ^ captured;
        serial_out <= chain[{chain}];
    end

    {block} block (
        {connect}
    );

endmodule

`default_nettype wire
",
        block = block.name,
        harness = name(block),
        chain = outs - 1,
        out_below = outs - 2,
        in_names = list(&inputs, ""),
        out_names = list(&outputs, ""),
        captured_names = list(&outputs, "_captured"),
    ))
}
