// SPDX-License-Identifier: MIT OR Apache-2.0
//! Copies registers, and look-up tables, that many cells wait for.
//!
//! A wire takes as long as it is: a control of a thousand cells reaches the last of them after most of a cycle. The tools of the
//! vendors give such a register copies, each for the readers near it; Yosys and nextpnr do not. So it is done here, between the two.
//!
//! Which readers will be near each other is not known before placement, but the lanes of a vertex are: a cell's place is the
//! relative position of its bit in the vector of lanes it belongs to, or the mean of the cells that it serves. Readers are
//! ordered by place and cut into groups of `READERS`. A copy is one more reader of what the register takes, so this
//! goes on until nothing changes: what goes through two registers becomes a tree.

use std::collections::{BTreeMap, HashMap, HashSet};

use serde_json::{Map, Value, json};

use super::target::Target;

/// The blocks whose controls get copies: those of more lanes than a wire crosses in half a cycle. The others reach their clock without.
const BLOCKS: &[&str] = &["remesher"];

/// How nextpnr places a block with copies: time weighs more than the length of wires.
pub const PLACER: &[&str] = &["--placer-heap-timingweight", "30"];

/// Whether a block, on a part of these cells, gets copies.
pub fn wanted(block: &str, target: &Target) -> bool {
    BLOCKS.contains(&block) && target.pass.starts_with("synth_ecp5")
}

/// Readers that a register keeps.
const READERS: usize = 24;
/// Fewer are divided, too, where they are spread over more than this part of all lanes.
const SPREAD: f64 = 0.35;
/// But not fewer than this.
const FEW: usize = 6;
/// A vector of lanes has as many bits at least.
const LANES: usize = 70;
/// Nets of more cells say nothing about where these belong.
const LOCAL: usize = 8;
/// Rounds until nothing changes.
const ROUNDS: usize = 8;

/// A port of a cell: cell, port, bit of the port.
type Pin = (usize, String, usize);

struct Cell {
    name: String,
    kind: String,
    outputs: Vec<u64>,
    /// The net of each bit of each input.
    inputs: BTreeMap<(String, usize), u64>,
    place: Option<f64>,
    /// The place follows from a name.
    fixed: bool,
    /// The cell that this is a copy of, itself where it is none.
    original: usize,
}

struct Graph {
    cells: Vec<Cell>,
    readers: HashMap<u64, Vec<Pin>>,
    driver: HashMap<u64, usize>,
    /// Nets that leave the block.
    open: HashSet<u64>,
    next_net: u64,
}

/// Ports that say nothing about where a cell belongs.
const CONTROLS: &[&str] = &["CLK", "CE", "LSR", "WCK", "WRE", "WAD", "RAD"];
const CLOCKS: &[&str] = &["CLK", "WCK"];

/// Makes the copies in the module `top` among the cells whose name begins with `inside`, and gives their number.
///
/// # Errors
/// Half a sentence: it is no netlist with such a module.
pub fn of_what_many_read(netlist: &mut Value, top: &str, inside: &str) -> Result<usize, String> {
    let module = netlist.pointer_mut(&format!("/modules/{top}")).ok_or_else(|| format!("it has no module `{top}`"))?;
    let mut graph = Graph::read(module, inside)?;
    let from = graph.cells.len();
    graph.find_places();
    for _ in 0..ROUNDS {
        if graph.divide() == 0 {
            break;
        }
    }
    let made = graph.cells.len() - from;
    graph.write(module)?;
    Ok(made)
}

impl Graph {
    fn read(module: &Value, inside: &str) -> Result<Graph, String> {
        let all = module["cells"].as_object().ok_or("it has no cells")?;
        let ports = module["ports"].as_object().into_iter().flat_map(Map::values);
        let mut graph = Graph {
            cells: vec![],
            readers: HashMap::new(),
            driver: HashMap::new(),
            open: ports.flat_map(|port| bits(&port["bits"])).collect(),
            next_net: 1,
        };
        for (name, cell) in all {
            let mut own = Cell {
                name: name.clone(),
                kind: cell["type"].as_str().unwrap_or_default().into(),
                outputs: vec![],
                inputs: BTreeMap::new(),
                place: None,
                fixed: false,
                original: graph.cells.len(),
            };
            let within = name.starts_with(inside);
            for (port, connected) in cell["connections"].as_object().into_iter().flatten() {
                let nets = connected.as_array().map_or(&[][..], Vec::as_slice);
                for (k, net) in nets.iter().enumerate().filter_map(|(k, net)| Some((k, net.as_u64()?))) {
                    graph.next_net = graph.next_net.max(net + 1);
                    if !within {
                        graph.open.insert(net);
                    } else if cell["port_directions"][port] == "output" {
                        own.outputs.push(net);
                        graph.driver.insert(net, graph.cells.len());
                    } else {
                        own.inputs.insert((port.clone(), k), net);
                        graph.readers.entry(net).or_default().push((graph.cells.len(), port.clone(), k));
                    }
                }
            }
            if within {
                graph.cells.push(own);
            }
        }
        let mut places: HashMap<u64, Vec<f64>> = HashMap::new();
        for (name, net) in module["netnames"].as_object().into_iter().flatten() {
            let nets = net["bits"].as_array().map_or(&[][..], Vec::as_slice);
            if !name.starts_with(inside) || nets.len() < LANES || net["hide_name"] == 1 {
                continue;
            }
            for (k, net) in nets.iter().enumerate().filter_map(|(k, net)| Some((k, net.as_u64()?))) {
                places.entry(net).or_default().push((k as f64 + 0.5) / nets.len() as f64);
            }
        }
        for cell in graph.cells.iter_mut().filter(|cell| ["TRELLIS_FF", "TRELLIS_DPR16X4"].contains(&&*cell.kind)) {
            cell.place = mean(cell.outputs.iter().filter_map(|net| places.get(net)).flatten().copied());
            cell.fixed = cell.place.is_some();
        }
        Ok(graph)
    }

    /// A cell belongs to those that it serves, or to those that serve it.
    fn find_places(&mut self) {
        for _ in 0..6 {
            let found: Vec<Option<f64>> = self
                .cells
                .iter()
                .map(|cell| {
                    if cell.fixed {
                        return cell.place;
                    }
                    let near = |net: &&u64| self.readers.get(net).is_none_or(|readers| readers.len() <= LOCAL);
                    let served = cell.outputs.iter().filter(near).filter_map(|net| self.readers.get(net)).flatten();
                    mean(served.filter_map(|(reader, ..)| self.cells[*reader].place)).or_else(|| {
                        let data = cell.inputs.iter().filter(|((port, _), _)| !CONTROLS.contains(&port.as_str()));
                        let from = data.map(|(_, net)| net).filter(near).filter_map(|net| self.driver.get(net));
                        mean(from.filter_map(|driver| self.cells[*driver].place)).or(cell.place)
                    })
                })
                .collect();
            for (cell, place) in self.cells.iter_mut().zip(found) {
                cell.place = place;
            }
        }
    }

    /// Divides what has too many readers, and gives the number of such nets.
    fn divide(&mut self) -> usize {
        let mut work: Vec<(usize, u64)> = self.driver.iter().map(|(net, driver)| (*driver, *net)).collect();
        work.retain(|(driver, net)| {
            let kind = self.cells[*driver].kind.as_str();
            (kind == "TRELLIS_FF" || kind == "LUT4") && !self.open.contains(net)
        });
        let count = |net: &u64| self.readers.get(net).map_or(0, Vec::len);
        work.sort_by_key(|(driver, net)| (usize::MAX - count(net), *driver));
        work.into_iter().filter(|(driver, net)| self.divide_one(*driver, *net)).count()
    }

    fn divide_one(&mut self, driver: usize, net: u64) -> bool {
        let Some(readers) = self.readers.get(&net) else { return false };
        let (mut placed, mut others): (Vec<Pin>, Vec<Pin>) = readers
            .iter()
            .cloned()
            .partition(|(reader, port, _)| self.cells[*reader].place.is_some() && !CLOCKS.contains(&port.as_str()));
        if others.len() > READERS && placed.len() <= READERS / 2 {
            // No lanes: those of a name belong together.
            placed.append(&mut others);
        }
        if placed.len() < FEW {
            return false;
        }
        let place = |pin: &Pin| self.cells[pin.0].place.unwrap_or(0.5);
        placed.sort_by(|a, b| {
            let name = |pin: &Pin| &self.cells[self.cells[pin.0].original].name;
            place(a).total_cmp(&place(b)).then_with(|| name(a).cmp(name(b))).then_with(|| a.cmp(b))
        });
        let n = placed.len();
        let spread = place(&placed[n * 9 / 10]) - place(&placed[n / 10]);
        let many = match self.cells[driver].kind.as_str() {
            "LUT4" => n >= 2 * READERS,
            _ => n > READERS || spread > SPREAD,
        };
        if !many {
            return false;
        }
        let groups = match n > READERS {
            true => n.div_ceil(READERS).max(2),
            false => ((spread * 5.0).round() as usize).min(n / 3).max(2),
        };
        let places: Vec<Option<f64>> = (0..groups)
            .map(|g| {
                mean(placed[g * n / groups..(g + 1) * n / groups].iter().filter_map(|pin| self.cells[pin.0].place))
            })
            .collect();
        for (g, group_place) in places.into_iter().enumerate() {
            let group = placed[g * n / groups..(g + 1) * n / groups].to_vec();
            if g == groups / 2 {
                // The middle one is left to the register itself.
                self.readers.insert(net, group.into_iter().chain(others.iter().cloned()).collect());
                self.cells[driver].place = group_place.or(self.cells[driver].place);
                continue;
            }
            self.copy(driver, group, group_place);
        }
        true
    }

    fn copy(&mut self, driver: usize, group: Vec<Pin>, place: Option<f64>) {
        let (copy, new) = (self.cells.len(), self.next_net);
        self.next_net += 1;
        for (reader, port, k) in &group {
            self.cells[*reader].inputs.insert((port.clone(), *k), new);
        }
        let of = &self.cells[driver];
        let (kind, inputs, original) = (of.kind.clone(), of.inputs.clone(), of.original);
        let name = format!("{}$copy{copy}", self.cells[original].name);
        // It reads what its original reads.
        for ((port, k), net) in &inputs {
            self.readers.entry(*net).or_default().push((copy, port.clone(), *k));
        }
        self.cells.push(Cell { name, kind, outputs: vec![new], inputs, place, fixed: true, original });
        self.driver.insert(new, copy);
        self.readers.insert(new, group);
    }

    fn write(&self, module: &mut Value) -> Result<(), String> {
        let cells = module["cells"].as_object_mut().ok_or("it has no cells")?;
        let mut nets = Map::new();
        for (k, cell) in self.cells.iter().enumerate().filter(|(k, cell)| cell.original != *k) {
            let mut copy = cells.get(&self.cells[cell.original].name).ok_or("a cell is gone")?.clone();
            let ways = copy["port_directions"].as_object().into_iter().flatten();
            let output = ways.into_iter().find(|(_, way)| *way == "output").map(|(port, _)| port.clone());
            copy["connections"][output.ok_or_else(|| format!("cell {k} has no output"))?] = json!(cell.outputs);
            cells.insert(cell.name.clone(), copy);
            nets.insert(
                format!("{}$net", cell.name),
                json!({ "hide_name": 1, "bits": cell.outputs, "attributes": {} }),
            );
        }
        for cell in &self.cells {
            for ((port, k), net) in &cell.inputs {
                cells[&cell.name]["connections"][port][*k] = json!(net);
            }
        }
        module["netnames"].as_object_mut().ok_or("it has no nets")?.append(&mut nets);
        Ok(())
    }
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, n) = values.fold((0.0, 0), |(sum, n), value| (sum + value, n + 1));
    (n > 0).then(|| sum / f64::from(n))
}

/// The nets of a port; constants are none.
fn bits(connected: &Value) -> impl Iterator<Item = u64> + '_ {
    connected.as_array().into_iter().flatten().filter_map(Value::as_u64)
}
