// SPDX-License-Identifier: MIT OR Apache-2.0
//! The module `relief_proof`: a block whose inputs are anything, its promises as assertions, and a fault on request.
//!
//! The reset stands in the first cycle and never again. Labels begin with the name of the property, so that one netlist
//! serves all of them.

use super::Property;
use super::contract::{Contract, Exchange};
use relief_hdl::verilog::{Direction, Emission};
use std::fmt::Write;

/// The name of the module.
pub const TOP: &str = "relief_proof";

/// The wrapper of a block; with a fault, one that breaks this property and shows that its proof can fail.
pub fn wrapper(emission: &Emission, contract: &Contract, fault: Option<Property>) -> String {
    let ports = &emission.top_module().ports;
    let range = |bits: usize| if bits == 1 { String::new() } else { format!("[{}:0] ", bits - 1) };
    let mut text = format!(
        "`default_nettype none\n\nmodule {TOP} (input wire clock);\n    reg started = 0;\n    always @(posedge clock) started <= 1;\n    \
         wire reset = !started;\n\n"
    );
    let mut add = |line: String| {
        text += "    ";
        text += &line;
        text += "\n";
    };
    let mut connections = vec![".clock(clock)".to_owned(), ".reset(reset)".to_owned()];
    let mut payload: Vec<(&str, usize)> = Vec::new();
    for port in ports.iter().filter(|port| port.name != "clock" && port.name != "reset") {
        let (name, bits) = (port.name.as_str(), port.bits);
        match port.direction {
            Direction::Input => add(format!("(* anyseq *) wire {}{name};", range(bits))),
            Direction::Output => add(format!("wire {}{name};", range(bits))),
        }
        let inner = match name {
            "in_valid" | "out_valid" => format!("block_{name}"),
            _ if port.direction == Direction::Output && name != "in_ready" => {
                payload.push((name, bits));
                add(format!("wire {}block_{name};", range(bits)));
                format!("block_{name}")
            }
            _ => name.to_owned(),
        };
        connections.push(format!(".{name}({inner})"));
    }
    add("wire block_in_valid, block_out_valid;".into());
    add(format!("{} block ({});", emission.top, connections.join(", ")));
    // What the monitors see, or what a fault makes of it.
    add("reg stalled = 0, gone = 0, again = 0;".into());
    add("wire asked = in_valid && in_ready;".into());
    add("wire taken = out_valid && out_ready;".into());
    add("always @(posedge clock) begin".into());
    add("    stalled <= !reset && out_valid && !out_ready;".into());
    add("    again <= !reset && taken && !again;".into());
    add("    gone <= !reset && (gone || asked);".into());
    add("end".into());
    // The first beat never arrives.
    let lost = if fault == Some(Property::Answered) { " && gone" } else { "" };
    add(format!("assign block_in_valid = in_valid{lost};"));
    add(format!(
        "assign out_valid = {};",
        match fault {
            Some(Property::Held) => "block_out_valid && !stalled",
            Some(Property::Free) => "block_out_valid && out_ready",
            Some(Property::Counted) => "block_out_valid || again",
            Some(Property::Reached) => "block_out_valid && !stalled && reset",
            _ => "block_out_valid",
        }
    ));
    let bits: usize = payload.iter().map(|(_, bits)| bits).sum();
    let all = payload.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let inner = payload.iter().map(|(name, _)| format!("block_{name}")).collect::<Vec<_>>().join(", ");
    add(format!("reg [{}:0] before;", bits - 1));
    add(format!("wire [{}:0] now = {{{inner}}};", bits - 1));
    add(match fault {
        // The last beat once more.
        Some(Property::Counted) => format!("assign {{{all}}} = again ? before : now;"),
        Some(Property::Equal) => format!("assign {{{all}}} = now ^ {{{{{bits}{{1'b0}}}}, 1'b1}};"),
        _ => format!("assign {{{all}}} = now;"),
    });
    add(format!("always @(posedge clock) before <= {{{all}}};"));
    add("always @* if (stalled) begin".into());
    add("    held_valid: assert (out_valid);".into());
    add(format!("    held_payload: assert ({{{all}}} == before);"));
    add("end".into());
    add("always @* reached_after_stall: cover (stalled && taken);".into());
    if let Some(Exchange { asks, answers, under_way, silence, .. }) = contract.exchange {
        add(format!("wire ask = asked && ({asks});"));
        add(format!("wire answer = taken && ({answers});"));
        add("reg [7:0] under_way = 0, silent = 0;".into());
        add("always @(posedge clock) begin".into());
        add("    under_way <= reset ? 0 : under_way + ask - answer;".into());
        add("    silent <= reset || under_way == 0 || out_valid ? 0 : silent + 1;".into());
        add("end".into());
        add("always @* if (started) begin".into());
        add("    counted_none: assert (!(answer && under_way == 0));".into());
        add(format!("    counted_most: assert (under_way <= {under_way});"));
        if let Some(silence) = silence {
            add(format!("    answered_in_time: assert (silent <= {silence});"));
        }
        add("end".into());
    }
    if let Some(formula) = contract.formula {
        text += formula.text;
    }
    let _ = write!(text, "endmodule\n\n`default_nettype wire\n");
    text
}
