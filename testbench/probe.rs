// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shows the inside of a rust-hdl block to the recorder of waveforms.
//!
//! The block is walked once to learn its signals, and once a sample to read them; so ask
//! [`VcdRecorder::wants`](relief_waves::VcdRecorder::wants) first. What a reader does not need is left out: constants,
//! the clock (the recorder draws it), the reset of inner blocks (it is the outer one), and of a register all but its
//! output, which then carries the register's name: `remesher.sweep.row_left` and not `remesher$sweep$row_left$q`.

use relief_waves::{Item, Scope, Signal, SignalTree, TreeError};
use rust_hdl_core::{
    prelude::{Atom, AtomKind, Block, Probe, TypeDescriptor, TypeField, TypeKind},
    synth::VCDValue,
};

/// The names of a register's signals; a block that has these and no others is one.
const REGISTER: [&str; 6] = ["clock", "d", "enable", "initial", "q", "reset"];

/// The signals of a block, and their values on demand.
#[derive(Clone, Debug)]
pub struct BlockProbe {
    tree: SignalTree,
    /// For every atom in the order of the walk.
    plans: Vec<Plan>,
    /// For every leaf of the plans its first word, unless it is left out.
    places: Vec<Option<usize>>,
    words: Vec<u64>,
}

/// How an atom's value becomes words.
#[derive(Clone, Debug)]
enum Plan {
    Skip,
    /// A vector, or lanes of so many bits.
    Packed {
        leaf: usize,
        lane_bits: usize,
    },
    Names {
        leaf: usize,
        names: Vec<String>,
    },
    Fields(Vec<Plan>),
}

impl BlockProbe {
    /// Learns the signals of a block, whose outermost scope gets this name.
    pub fn new(name: &str, block: &dyn Block) -> Result<Self, TreeError> {
        Self::learn(name, block, false)
    }

    /// Like [`new`](Self::new), with every signal of the registers.
    pub fn with_registers_open(name: &str, block: &dyn Block) -> Result<Self, TreeError> {
        Self::learn(name, block, true)
    }

    fn learn(name: &str, block: &dyn Block, open: bool) -> Result<Self, TreeError> {
        let mut learner = Learner { open, leaves: 0, plans: Vec::new(), stack: vec![Nest::default()] };
        block.accept(name, &mut learner);
        let Learner { plans, leaves, mut stack, .. } = learner;
        let outer = stack.pop().unwrap_or_default();
        let mut places = vec![None; leaves];
        // A block is one scope. What is none, such as an array of blocks, gets one round it.
        let root = match <[Part; 1]>::try_from(outer.parts) {
            Ok([Part::Nest(nest)]) => nest,
            Ok([part]) => Nest { name: name.to_string(), parts: vec![part] },
            Err(parts) => Nest { name: name.to_string(), parts },
        };
        let mut word = 0;
        let tree = SignalTree::new(settle(root, &mut word, &mut places))?;
        let words = vec![0; tree.words()];
        Ok(Self { tree, plans, places, words })
    }

    /// The signals.
    pub fn tree(&self) -> &SignalTree {
        &self.tree
    }

    /// Reads all signals, in the layout of the [tree](Self::tree). The block must be the one that was learnt, or its
    /// equal in structure.
    pub fn sample(&mut self, block: &dyn Block) -> &[u64] {
        self.words.fill(0);
        let mut reader = Reader { plans: self.plans.iter(), places: &self.places, words: &mut self.words };
        block.accept("", &mut reader);
        &self.words
    }
}

/// A scope in the making.
#[derive(Default)]
struct Nest {
    name: String,
    parts: Vec<Part>,
}

enum Part {
    Nest(Nest),
    Leaf { signal: Signal, leaf: usize },
}

struct Learner {
    open: bool,
    leaves: usize,
    plans: Vec<Plan>,
    stack: Vec<Nest>,
}

impl Learner {
    fn leave(&mut self) {
        let Some(mut nest) = self.stack.pop() else { return };
        let Some(outer) = self.stack.last_mut() else { return };
        if nest.parts.is_empty() {
            return;
        }
        if !self.open && is_register(&nest) {
            let output = nest.parts.iter_mut().find_map(|part| match part {
                Part::Leaf { signal, leaf } if signal.name == "q" => Some((signal, *leaf)),
                // A register of lanes of mixed kinds: its fields stay, under its name.
                Part::Nest(fields) if fields.name == "q" => {
                    fields.name.clone_from(&nest.name);
                    outer.parts.push(Part::Nest(std::mem::take(fields)));
                    None
                }
                _ => None,
            });
            if let Some((signal, leaf)) = output {
                outer.parts.push(Part::Leaf { signal: Signal { name: nest.name, ..signal.clone() }, leaf });
            }
            return;
        }
        outer.parts.push(Part::Nest(nest));
    }

    fn leaf(&mut self, signal: Signal, into: &mut Vec<Part>) -> usize {
        into.push(Part::Leaf { signal, leaf: self.leaves });
        self.leaves += 1;
        self.leaves - 1
    }

    fn plan(&mut self, name: &str, descriptor: &TypeDescriptor, into: &mut Vec<Part>) -> Plan {
        match &descriptor.kind {
            TypeKind::Bits(bits) => {
                Plan::Packed { leaf: self.leaf(Signal::unsigned(name, *bits), into), lane_bits: *bits }
            }
            TypeKind::Signed(bits) => {
                Plan::Packed { leaf: self.leaf(Signal::signed(name, *bits), into), lane_bits: *bits }
            }
            TypeKind::Enum(names) => {
                let names: Vec<String> = names.iter().map(|name| variant(name).to_string()).collect();
                let signal = Signal::names(name, names.iter().cloned());
                Plan::Names { leaf: self.leaf(signal, into), names }
            }
            TypeKind::Composite(fields) => {
                if let Some(lane_bits) = lane_bits(descriptor) {
                    let signal = Signal::lanes(name, fields.len(), lane_bits);
                    return Plan::Packed { leaf: self.leaf(signal, into), lane_bits };
                }
                let mut parts = Vec::new();
                let plans = fields
                    .iter()
                    .map(|field| self.plan(&readable(&field.fieldname), &field.kind, &mut parts))
                    .collect();
                into.push(Part::Nest(Nest { name: name.to_string(), parts }));
                Plan::Fields(plans)
            }
        }
    }
}

impl Probe for Learner {
    fn visit_start_scope(&mut self, name: &str, _node: &dyn Block) {
        self.stack.push(Nest { name: readable(name), parts: Vec::new() });
    }

    fn visit_start_namespace(&mut self, name: &str, node: &dyn Block) {
        self.visit_start_scope(name, node);
    }

    fn visit_end_scope(&mut self, _name: &str, _node: &dyn Block) {
        self.leave();
    }

    fn visit_end_namespace(&mut self, _name: &str, _node: &dyn Block) {
        self.leave();
    }

    fn visit_atom(&mut self, name: &str, atom: &dyn Atom) {
        let (descriptor, mut parts) = (atom.descriptor(), Vec::new());
        let plan = match clock_fields(&descriptor) {
            _ if atom.kind() == AtomKind::Constant => Plan::Skip,
            // Depth 1 is outside the outermost block, depth 2 within it.
            Some(fields) if self.stack.len() <= 2 => Plan::Fields(
                fields
                    .into_iter()
                    .map(|field| match field {
                        Some((name, kind)) => self.plan(&name, &kind, &mut parts),
                        None => Plan::Skip,
                    })
                    .collect(),
            ),
            Some(_) => Plan::Skip,
            None => self.plan(&readable(name), &descriptor, &mut parts),
        };
        self.plans.push(plan);
        if let Some(nest) = self.stack.last_mut() {
            nest.parts.append(&mut parts);
        }
    }
}

/// For a clock what travels with it, such as a reset, and nothing for the clock itself.
fn clock_fields(descriptor: &TypeDescriptor) -> Option<Vec<Option<(String, TypeDescriptor)>>> {
    match &descriptor.kind {
        TypeKind::Bits(1) if descriptor.name == "clock" => Some(Vec::new()),
        TypeKind::Composite(fields) if fields.iter().any(|field| field.fieldname == "clock") => {
            let other = |name: &str| name != "clock";
            let fields = fields.iter().map(|field| (field.fieldname.clone(), field.kind.clone()));
            Some(fields.map(|field| other(&field.0).then_some(field)).collect())
        }
        _ => None,
    }
}

/// The width of a lane, when the fields are numbered from 0 and are signed numbers of one width.
fn lane_bits(descriptor: &TypeDescriptor) -> Option<usize> {
    let TypeKind::Composite(fields) = &descriptor.kind else { return None };
    let TypeKind::Signed(bits) = fields.first()?.kind.kind else { return None };
    let is_lane = |(index, field): (usize, &TypeField)| {
        let number = field.fieldname.trim_start_matches(|c: char| !c.is_ascii_digit()).trim_end_matches(']');
        number == index.to_string() && matches!(field.kind.kind, TypeKind::Signed(width) if width == bits)
    };
    fields.iter().map(Box::as_ref).enumerate().all(is_lane).then_some(bits)
}

fn is_register(nest: &Nest) -> bool {
    let names: Vec<&str> = nest
        .parts
        .iter()
        .map(|part| match part {
            Part::Nest(nest) => nest.name.as_str(),
            Part::Leaf { signal, .. } => signal.name.as_str(),
        })
        .collect();
    names.iter().all(|name| REGISTER.contains(name)) && names.contains(&"d") && names.contains(&"q")
}

/// rust-hdl says `State::Idle` in some places and `Idle` in others.
fn variant(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}

/// rust-hdl numbers the elements of an array as `name$0`.
fn readable(name: &str) -> String {
    let mut parts = name.split('$');
    let first = parts.next().unwrap_or("").to_string();
    parts.fold(first, |name, part| match part.parse::<usize>() {
        Ok(index) => format!("{name}[{index}]"),
        Err(_) => format!("{name}_{part}"),
    })
}

/// Turns the nest into a scope and notes where each leaf has come to lie.
fn settle(nest: Nest, word: &mut usize, places: &mut [Option<usize>]) -> Scope {
    let items = nest.parts.into_iter().map(|part| match part {
        Part::Nest(inner) => Item::Scope(settle(inner, word, places)),
        Part::Leaf { signal, leaf } => {
            places[leaf] = Some(*word);
            *word += signal.words();
            Item::Signal(signal)
        }
    });
    Scope { items: items.collect(), name: nest.name }
}

struct Reader<'a> {
    plans: std::slice::Iter<'a, Plan>,
    places: &'a [Option<usize>],
    words: &'a mut [u64],
}

impl Reader<'_> {
    fn read(&mut self, plan: &Plan, value: &VCDValue) {
        match plan {
            Plan::Skip => (),
            Plan::Fields(plans) => {
                if let VCDValue::Composite(values) = value {
                    plans.iter().zip(values).for_each(|(plan, value)| self.read(plan, value));
                }
            }
            Plan::Names { leaf, names } => {
                if let (Some(word), VCDValue::String(text)) = (self.places[*leaf], value) {
                    // A name that is not listed shows as an index without a name.
                    let index = names.iter().position(|name| name == variant(text)).unwrap_or(names.len());
                    self.words[word] = index as u64;
                }
            }
            Plan::Packed { leaf, lane_bits } => {
                let Some(word) = self.places[*leaf] else { return };
                match value {
                    VCDValue::Composite(lanes) => {
                        let lanes = lanes.iter().enumerate();
                        lanes.for_each(|(lane, value)| put(&mut self.words[word..], lane * lane_bits, value));
                    }
                    value => put(&mut self.words[word..], 0, value),
                }
            }
        }
    }
}

impl Probe for Reader<'_> {
    fn visit_atom(&mut self, _name: &str, atom: &dyn Atom) {
        match self.plans.next() {
            None | Some(Plan::Skip) => (),
            Some(plan) => self.read(plan, &atom.vcd()),
        }
    }
}

/// Sets the ones of a vector, highest bit first; anything but a one, such as an open line, stays zero.
fn put(words: &mut [u64], from: usize, value: &VCDValue) {
    // The bits are of a type that only rust-hdl's own dependency names.
    let VCDValue::Single(one) = VCDValue::from(true) else { return };
    let mut set = |bit: usize| words[bit / 64] |= 1 << (bit % 64);
    match value {
        VCDValue::Single(bit) if *bit == one => set(from),
        VCDValue::Vector(bits) => {
            let ones = bits.iter().rev().enumerate().filter(|(_, bit)| **bit == one);
            ones.for_each(|(index, _)| set(from + index));
        }
        _ => (),
    }
}
