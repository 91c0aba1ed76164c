// SPDX-License-Identifier: MIT OR Apache-2.0
//! The slowest path between two registers, in the names of the emitted Verilog.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A path from register to register.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CriticalPath {
    /// The signal that starts it: a register, or what a memory or multiplier sends.
    pub from: String,
    /// The register, memory or multiplier at its end.
    pub to: String,
    /// The signals between them that have a name, in their order.
    pub through: Vec<String>,
    /// Time in cells, clock to output and set-up among it, in ns.
    pub logic_ns: f64,
    /// Time in wires, ns.
    pub wires_ns: f64,
    /// Cells between start and end; a carry chain is one.
    pub cells: usize,
}

impl fmt::Display for CriticalPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { from, to, through, logic_ns, wires_ns, cells } = self;
        write!(
            f,
            "{from} -> {to}: {logic_ns:.1} ns in {cells} cell{}, {wires_ns:.1} ns in wires",
            if *cells == 1 { "" } else { "s" }
        )?;
        if !through.is_empty() {
            write!(f, "; through {}", through.join(", "))?;
        }
        Ok(())
    }
}

/// Kinds of cells as Yosys puts them into the names it makes, `<signal>_<kind>_<port>`.
const KINDS: &[&str] = &[
    "LUT", "CCU2C", "PFUMX", "L6MUX21", "TRELLIS", "MULT", "DP16KD", "PDPW16KD", "SB_", "ALU", "MUX2_LUT", "DFF",
    "SDPB", "DPB", "DPX9B", "SPX9", "RAM16", "RDATA", "DOA", "DOB", "DO_", "IBUF", "OBUF", "INV", "GND", "VCC",
];

/// The signal behind the name of a net or cell, without the instance of the harness and without bits; none where Yosys
/// made the name of nothing.
pub fn signal(raw: &str) -> Option<String> {
    let name = raw.strip_prefix("block.").unwrap_or(raw);
    // The variable of an inlined function: its name is all that the source has.
    let name = name.split_once("$func$").map_or(name, |(function, _)| function);
    let kind = name.match_indices('_').find(|(at, _)| KINDS.iter().any(|kind| name[at + 1..].starts_with(kind)));
    let name = kind.map_or(name, |(at, _)| &name[..at]);
    let mut name = name.split(['$', '[']).next().unwrap_or("").trim_end_matches(['.', '_']);
    // A memory is cut into cells `<memory>.<column>.<row>`.
    while let Some((memory, _)) = name.rsplit_once('.').filter(|(_, tail)| tail.bytes().all(|c| c.is_ascii_digit())) {
        name = memory;
    }
    (!name.is_empty()).then(|| name.to_owned())
}
