// SPDX-License-Identifier: MIT OR Apache-2.0
//! Moves registers behind a block RAM, or a multiplier, into it.
//!
//! A DP16KD has a register at its output, and the word comes 5 ns earlier with it than without. A MULT18X18D has one for its
//! product, which then takes no wire between the two. Yosys never uses them; the tools of the vendor do. So where every bit that is
//! read goes into a register of the same clock and enable, without reset, and nowhere else, these registers go.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

/// Packs the registers of the module `top`, and gives their number.
///
/// # Errors
/// Half a sentence: it is no netlist with such a module.
pub fn output_registers(netlist: &mut Value, top: &str) -> Result<usize, String> {
    let module = netlist.pointer_mut(&format!("/modules/{top}")).ok_or_else(|| format!("it has no module `{top}`"))?;
    let ports = module["ports"].clone();
    let cells = module["cells"].as_object_mut().ok_or("it has no cells")?;
    let mut readers: BTreeMap<u64, Vec<&str>> = BTreeMap::new();
    for port in ports.as_object().into_iter().flat_map(Map::values).filter(|port| port["direction"] == "output") {
        bits(&port["bits"]).for_each(|bit| readers.entry(bit).or_default().push(""));
    }
    let names: Vec<String> = cells.keys().cloned().collect();
    for name in &names {
        let cell = &cells[name];
        for (port, connected) in cell["connections"].as_object().into_iter().flatten() {
            if cell["port_directions"][port] != "output" {
                bits(connected).for_each(|bit| readers.entry(bit).or_default().push(name));
            }
        }
    }
    let mut packed = 0;
    for name in &names {
        match cells.get(name).and_then(|cell| cell["type"].as_str()) {
            Some("DP16KD") => {
                // With words of 36 bits both halves of the output are read by the second port.
                let wide = width(&cells[name]["parameters"]["DATA_WIDTH_B"]) == 36;
                let sides: &[(&[&str], &str)] =
                    if wide { &[(&["A", "B"], "B")] } else { &[(&["A"], "A"), (&["B"], "B")] };
                for (halves, side) in sides {
                    packed += into_ram(cells, &readers, name, halves, side);
                }
            }
            Some("MULT18X18D") => packed += into_multiplier(cells, &readers, name),
            _ => {}
        }
    }
    Ok(packed)
}

/// Packs one side of a block RAM, and gives the number of registers.
fn into_ram(
    cells: &mut Map<String, Value>,
    readers: &BTreeMap<u64, Vec<&str>>,
    name: &str,
    halves: &[&str],
    side: &str,
) -> usize {
    let (connections, parameters) = (&cells[name]["connections"], &cells[name]["parameters"]);
    let clock = format!("CLK{side}");
    let straight = parameters[format!("CLK{side}MUX")] == clock.as_str();
    let held = halves.iter().any(|half| parameters[format!("REGMODE_{half}")] != "NOREG");
    let outputs: Vec<String> = halves.iter().flat_map(|half| (0..18).map(move |k| format!("DO{half}{k}"))).collect();
    let Some(registers) = registers(cells, readers, name, &outputs) else { return 0 };
    let fits = straight && !held && connections[format!("RST{side}")][0] == "0";
    if !fits || connections[&clock][0] != registers.clock {
        return 0;
    }
    let enable = registers.enable.clone();
    let packed = registers.pack(cells, name, &outputs);
    let ram = &mut cells[name];
    for half in halves {
        ram["parameters"][format!("REGMODE_{half}")] = json!("OUTREG");
        ram["connections"][format!("OCE{half}")] = json!([enable]);
    }
    packed
}

/// Packs the product of a multiplier without registers, and gives their number.
fn into_multiplier(cells: &mut Map<String, Value>, readers: &BTreeMap<u64, Vec<&str>>, name: &str) -> usize {
    let outputs: Vec<String> = (0..36).map(|k| format!("P{k}")).collect();
    let plain = cells[name]["parameters"]
        .as_object()
        .is_some_and(|parameters| !parameters.keys().any(|key| key.starts_with("REG_")));
    let Some(registers) = registers(cells, readers, name, &outputs).filter(|_| plain) else { return 0 };
    let (clock, enable) = (registers.clock.clone(), registers.enable.clone());
    let packed = registers.pack(cells, name, &outputs);
    let multiplier = &mut cells[name];
    multiplier["parameters"]["GSR"] = json!("DISABLED");
    for (kind, value) in [("CLK", clock), ("CE", enable), ("RST", json!("0"))] {
        let port = format!("{kind}0");
        multiplier["parameters"][format!("REG_OUTPUT_{kind}")] = json!(port);
        multiplier["connections"][&port] = json!([value]);
        multiplier["port_directions"][port] = json!("input");
    }
    packed
}

/// Registers behind a cell.
struct Registers {
    /// By the bit that each takes.
    names: BTreeMap<u64, String>,
    clock: Value,
    enable: Value,
}

impl Registers {
    /// Takes them away: the cell's outputs are theirs.
    fn pack(self, cells: &mut Map<String, Value>, name: &str, outputs: &[String]) -> usize {
        let count = self.names.len();
        let taken =
            |(bit, register): (u64, String)| Some((bit, cells.remove(&register)?["connections"]["Q"][0].clone()));
        let renamed: BTreeMap<u64, Value> = self.names.into_iter().filter_map(taken).collect();
        for output in outputs {
            let Some(out) = cells[name].pointer_mut(&format!("/connections/{output}/0")) else { continue };
            if let Some(register) = out.as_u64().and_then(|bit| renamed.get(&bit)) {
                *out = register.clone();
            }
        }
        count
    }
}

/// The registers behind the outputs of a cell; none if one of the bits goes anywhere else.
fn registers(
    cells: &Map<String, Value>,
    readers: &BTreeMap<u64, Vec<&str>>,
    name: &str,
    outputs: &[String],
) -> Option<Registers> {
    let mut names = BTreeMap::new();
    let mut both: Option<(Value, Value)> = None;
    for output in outputs {
        let Some(bit) = cells[name]["connections"][output][0].as_u64() else { continue };
        let [register] = readers.get(&bit).map_or(&[][..], Vec::as_slice) else {
            if readers.contains_key(&bit) {
                return None;
            }
            continue;
        };
        let cell = cells.get(*register).filter(|cell| cell["type"] == "TRELLIS_FF")?;
        let (connections, parameters) = (&cell["connections"], &cell["parameters"]);
        // Yosys puts a space behind a text that could be a number.
        let enable = match parameters["CEMUX"].as_str().map(str::trim) {
            Some("CE") => connections["CE"][0].clone(),
            Some("1") => json!("1"),
            _ => return None,
        };
        let own = (connections["CLK"][0].clone(), enable);
        let fits = connections["DI"][0] == bit
            && parameters["CLKMUX"] == "CLK"
            && connections["LSR"][0].as_u64().is_none()
            && both.as_ref().is_none_or(|both| *both == own);
        if !fits {
            return None;
        }
        both = Some(own);
        names.insert(bit, (*register).to_owned());
    }
    let (clock, enable) = both?;
    Some(Registers { names, clock, enable })
}

/// The nets of a port; constants are none.
fn bits(connected: &Value) -> impl Iterator<Item = u64> + '_ {
    connected.as_array().into_iter().flatten().filter_map(Value::as_u64)
}

/// A parameter that Yosys writes in binary.
fn width(parameter: &Value) -> u64 {
    parameter.as_str().and_then(|text| u64::from_str_radix(text.trim(), 2).ok()).unwrap_or(0)
}
