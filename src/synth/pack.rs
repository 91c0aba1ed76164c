// SPDX-License-Identifier: MIT OR Apache-2.0
//! Moves registers behind a block RAM into it.
//!
//! A DP16KD has a register at its output, and the word comes 5 ns earlier with it than without. Yosys never uses it; the
//! tools of the vendor do. So where every bit that is read goes into a register of the same clock and enable, without
//! reset, and nowhere else, these registers go.

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
    let rams: Vec<&String> = names.iter().filter(|name| cells[*name]["type"] == "DP16KD").collect();
    for name in rams {
        // With words of 36 bits both halves of the output are read by the second port.
        let wide = width(&cells[name]["parameters"]["DATA_WIDTH_B"]) == 36;
        let sides: &[(&[&str], &str)] = if wide { &[(&["A", "B"], "B")] } else { &[(&["A"], "A"), (&["B"], "B")] };
        for (halves, clock) in sides {
            let Some((registers, enable)) = registers(cells, &readers, name, halves, clock) else { continue };
            packed += registers.len();
            let renamed: BTreeMap<u64, Value> = registers
                .iter()
                .map(|(bit, register)| (*bit, cells[register]["connections"]["Q"][0].clone()))
                .collect();
            for register in registers.values() {
                cells.remove(register);
            }
            let ram = &mut cells[name];
            for half in *halves {
                ram["parameters"][format!("REGMODE_{half}")] = json!("OUTREG");
                ram["connections"][format!("OCE{half}")] = json!([enable]);
                for k in 0..18 {
                    let Some(out) = ram.pointer_mut(&format!("/connections/DO{half}{k}/0")) else { continue };
                    if let Some(register) = out.as_u64().and_then(|bit| renamed.get(&bit)) {
                        *out = register.clone();
                    }
                }
            }
        }
    }
    Ok(packed)
}

/// The registers behind one side of a block RAM, by the bit that each takes, and their enable; none if one of the bits
/// goes anywhere else.
fn registers(
    cells: &Map<String, Value>,
    readers: &BTreeMap<u64, Vec<&str>>,
    ram: &str,
    halves: &[&str],
    side: &str,
) -> Option<(BTreeMap<u64, String>, Value)> {
    let ram = &cells[ram];
    let clock = format!("CLK{side}");
    let straight = ram["parameters"][format!("CLK{side}MUX")] == clock.as_str();
    let held = halves.iter().any(|half| ram["parameters"][format!("REGMODE_{half}")] != "NOREG");
    if !straight || held || ram["connections"][format!("RST{side}")][0] != "0" {
        return None;
    }
    let mut found = BTreeMap::new();
    let mut enable = None;
    for bit in halves.iter().flat_map(|half| (0..18).map(move |k| format!("DO{half}{k}"))) {
        let Some(bit) = ram["connections"][bit][0].as_u64() else { continue };
        let [register] = readers.get(&bit).map_or(&[][..], Vec::as_slice) else {
            if readers.contains_key(&bit) {
                return None;
            }
            continue;
        };
        let cell = cells.get(*register).filter(|cell| cell["type"] == "TRELLIS_FF")?;
        let (connections, parameters) = (&cell["connections"], &cell["parameters"]);
        // Yosys puts a space behind a text that could be a number.
        let own = match parameters["CEMUX"].as_str().map(str::trim) {
            Some("CE") => connections["CE"][0].clone(),
            Some("1") => json!("1"),
            _ => return None,
        };
        let fits = connections["DI"][0] == bit
            && connections["CLK"][0] == ram["connections"][&clock][0]
            && parameters["CLKMUX"] == "CLK"
            && connections["LSR"][0].as_u64().is_none()
            && enable.as_ref().is_none_or(|enable| *enable == own);
        if !fits {
            return None;
        }
        enable = Some(own);
        found.insert(bit, (*register).to_owned());
    }
    Some((found, enable?))
}

/// The nets of a port; constants are none.
fn bits(connected: &Value) -> impl Iterator<Item = u64> + '_ {
    connected.as_array().into_iter().flatten().filter_map(Value::as_u64)
}

/// A parameter that Yosys writes in binary.
fn width(parameter: &Value) -> u64 {
    parameter.as_str().and_then(|text| u64::from_str_radix(text.trim(), 2).ok()).unwrap_or(0)
}
