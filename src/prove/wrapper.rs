// SPDX-License-Identifier: MIT OR Apache-2.0
//! The module `relief_proof`: a block whose inputs are anything, its promises as assertions, and a fault on request.
//!
//! The reset stands in the first cycle and never again. Labels begin with the names of their properties, so that one netlist
//! serves all of them. Signals within the block are declared as wires that flattening joins with their namesakes.

use std::collections::BTreeSet;
use std::fmt::Write;

use relief_hdl::verilog::{Direction, Emission, Module};
use relief_hdl::widths::WidthSet;

use super::Property;
use super::contract::{Contract, Exchange};

/// The name of the module.
pub const TOP: &str = "relief_proof";

/// The wrapper of a block or a part; with a fault, one that breaks this property and shows that its proof can fail.
///
/// # Errors
/// Half a sentence: the contract names a signal that the block does not have.
pub fn wrapper(
    emission: &Emission,
    set: &WidthSet,
    contract: &Contract,
    fault: Option<Property>,
) -> Result<String, String> {
    // A fault within the block needs none round it.
    let fault = fault.filter(|property| contract.faults.iter().all(|fault| fault.property != *property));
    let mut text = format!(
        "`default_nettype none\n`define DEPTH {}\n\nmodule {TOP} (input wire clock);\n    reg started = 0;\n    \
         always @(posedge clock) started <= 1;\n    wire reset = !started;\n\n",
        set.column_depth
    );
    let asks = contract.exchange.map_or("", |exchange| exchange.asks);
    for path in inner(asks).into_iter().chain(inner(contract.text)).collect::<BTreeSet<_>>() {
        let range = range(bits(emission, path).ok_or_else(|| format!("there is no signal `{path}` in it"))?);
        let _ = writeln!(text, "    (* hierconn *) wire {range}\\block.{path} ;");
    }
    if contract.part.is_some() {
        part(&mut text, emission);
    } else {
        stream(&mut text, emission, contract, fault);
    }
    text += contract.text;
    text += "endmodule\n\n`default_nettype wire\n";
    Ok(text)
}

/// The signals `\block.x ` of a text, without `block`.
fn inner(text: &str) -> BTreeSet<&str> {
    text.split(r"\block.").skip(1).filter_map(|rest| rest.split_whitespace().next()).collect()
}

/// The bits of a signal of the block, or of one of its instances.
fn bits(emission: &Emission, path: &str) -> Option<usize> {
    let mut module = emission.top_module();
    let mut names = path.split('.').peekable();
    while let Some(name) = names.next() {
        if names.peek().is_none() {
            return declared(module, name);
        }
        // `relief_sat_corners corners (`
        let instance = module.source.lines().find_map(|line| {
            let (kind, rest) = line.trim().split_once(' ')?;
            rest.strip_prefix(name)?.trim_start().starts_with('(').then_some(kind)
        })?;
        module = emission.modules.iter().find(|module| module.name == instance)?;
    }
    None
}

/// The bits of a signal as its module declares it: `reg signed [7:0] x; // ...`.
fn declared(module: &Module, name: &str) -> Option<usize> {
    module.source.lines().find_map(|line| {
        let words = line.trim();
        let kinds = ["reg", "wire", "logic", "input", "output"];
        let code = words.split("//").next()?.trim_end().trim_end_matches([';', ',']);
        (kinds.contains(&words.split_whitespace().next()?) && code.split_whitespace().last()? == name).then_some(())?;
        let high = code.split_once('[').and_then(|(_, rest)| rest.split(':').next()?.parse::<usize>().ok());
        Some(high.map_or(1, |high| high + 1))
    })
}

fn range(bits: usize) -> String {
    if bits == 1 { String::new() } else { format!("[{}:0] ", bits - 1) }
}

/// A part: its inputs are anything.
fn part(text: &mut String, emission: &Emission) {
    let mut connections = vec![];
    for port in &emission.top_module().ports {
        let (name, range) = (port.name.as_str(), range(port.bits));
        connections.push(format!(".{name}({name})"));
        let _ = match port.direction {
            _ if name == "clock" || name == "reset" => Ok(()),
            Direction::Input => writeln!(text, "    (* anyseq *) wire {range}{name};"),
            Direction::Output => writeln!(text, "    wire {range}{name};"),
        };
    }
    let _ = writeln!(text, "    {} block ({});", emission.top, connections.join(", "));
}

/// A block with its streams, what watches them, and the fault.
fn stream(text: &mut String, emission: &Emission, contract: &Contract, fault: Option<Property>) {
    let ports = &emission.top_module().ports;
    let mut add = |line: String| {
        *text += "    ";
        *text += &line;
        *text += "\n";
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
        Some(Property::Equal) => format!("assign {{{all}}} = ~now;"),
        _ => format!("assign {{{all}}} = now;"),
    });
    add(format!("always @(posedge clock) before <= {{{all}}};"));
    add("always @* if (stalled) begin".into());
    add("    held_valid: assert (out_valid);".into());
    add(format!("    held_payload: assert ({{{all}}} == before);"));
    add("end".into());
    add("always @* reached_after_stall: cover (stalled && taken);".into());
    if let Some(Exchange { asks, answers }) = contract.exchange {
        add(format!("wire ask = {asks};"));
        add(format!("wire answer = taken && ({answers});"));
        add("reg [7:0] under_way = 0, silent = 0;".into());
        add("always @(posedge clock) begin".into());
        add("    under_way <= reset ? 0 : under_way + ask - answer;".into());
        add("    silent <= reset || under_way == 0 || out_valid ? 0 : silent + 1;".into());
        add("end".into());
        add("always @* if (started) counted_none: assert (!(answer && under_way == 0));".into());
    }
}
