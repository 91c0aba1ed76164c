// SPDX-License-Identifier: MIT OR Apache-2.0
//! A stepped block with its type hidden, and where its streams lie in the words of a cycle.

use crate::stepped::Stepped;
use relief_hdl::ports::{PortShape, Ports};
use rust_hdl_core::prelude::Block;

/// A block that is stepped by words: inputs of a cycle in, outputs of that cycle out.
pub trait Device {
    /// Input ports but clock and reset.
    fn inputs(&self) -> Vec<PortShape>;
    /// Output ports.
    fn outputs(&self) -> Vec<PortShape>;
    /// Sets the inputs, lets the block settle and samples the outputs. Call [`Device::edge`] to finish the cycle.
    fn settle(&mut self, inputs: &[u64], outputs: &mut [u64]);
    /// Rising edge.
    fn edge(&mut self);
    /// Holds the reset for so many cycles.
    fn reset(&mut self, cycles: usize);
    /// Cycles since the reset.
    fn cycle(&self) -> u64;
    /// The block, for probes and the Verilog back-end.
    fn block(&self) -> &dyn Block;
}

impl<B: Ports> Device for Stepped<B> {
    fn inputs(&self) -> Vec<PortShape> {
        Stepped::block(self).inputs()
    }
    fn outputs(&self) -> Vec<PortShape> {
        Stepped::block(self).outputs()
    }
    fn settle(&mut self, inputs: &[u64], outputs: &mut [u64]) {
        self.block_mut().write_inputs(inputs);
        Stepped::settle(self);
        Stepped::block(self).read_outputs(outputs);
    }
    fn edge(&mut self) {
        Stepped::edge(self);
    }
    fn reset(&mut self, cycles: usize) {
        Stepped::reset(self, cycles);
    }
    fn cycle(&self) -> u64 {
        Stepped::cycle(self)
    }
    fn block(&self) -> &dyn Block {
        let block: &B = Stepped::block(self);
        block
    }
}

/// Where the words of the ports lie. The input stream is `in_*`, the output stream every output but `in_ready`: fields
/// in port order, `valid` and `ready` apart.
#[derive(Clone, Debug)]
pub struct Layout {
    /// Input ports with the word each begins at.
    pub inputs: Vec<(PortShape, usize)>,
    /// Output ports with the word each begins at.
    pub outputs: Vec<(PortShape, usize)>,
    /// Words of all inputs.
    pub input_words: usize,
    /// Words of all outputs.
    pub output_words: usize,
    /// Word of `in_valid`, of `out_ready`; of `in_ready`, of `out_valid`.
    pub in_valid: usize,
    /// Word of `out_ready` among the inputs.
    pub out_ready: usize,
    /// Word of `in_ready` among the outputs.
    pub in_ready: usize,
    /// Word of `out_valid` among the outputs.
    pub out_valid: usize,
}

fn places(ports: Vec<PortShape>) -> (Vec<(PortShape, usize)>, usize) {
    let mut at = 0;
    let placed = ports.into_iter().map(|port| {
        let begins = at;
        at += port.words();
        (port, begins)
    });
    (placed.collect(), at)
}

impl Layout {
    /// The layout of a device with one input and one output stream.
    ///
    /// # Panics
    /// When one of the four handshake ports is missing: a fault of the block.
    pub fn of(device: &dyn Device) -> Self {
        let (inputs, input_words) = places(device.inputs());
        let (outputs, output_words) = places(device.outputs());
        let find = |ports: &[(PortShape, usize)], name: &str| {
            ports
                .iter()
                .find(|(port, _)| port.name == name)
                .unwrap_or_else(|| panic!("the block has no port `{name}`"))
                .1
        };
        Self {
            in_valid: find(&inputs, "in_valid"),
            out_ready: find(&inputs, "out_ready"),
            in_ready: find(&outputs, "in_ready"),
            out_valid: find(&outputs, "out_valid"),
            inputs,
            outputs,
            input_words,
            output_words,
        }
    }
    /// The word at which an output begins.
    ///
    /// # Panics
    /// When there is no such output: a fault of the caller.
    pub fn output(&self, name: &str) -> usize {
        let found = self.outputs.iter().find(|(port, _)| port.name == name);
        found.unwrap_or_else(|| panic!("the block has no output `{name}`")).1
    }
    /// Fields of the input stream and the words where they begin.
    pub fn in_fields(&self) -> impl Iterator<Item = &(PortShape, usize)> {
        self.inputs.iter().filter(|(port, _)| port.name != "in_valid" && port.name != "out_ready")
    }
    /// Fields of the output stream, status included, and the words where they begin.
    pub fn out_fields(&self) -> impl Iterator<Item = &(PortShape, usize)> {
        self.outputs.iter().filter(|(port, _)| port.name != "in_ready" && port.name != "out_valid")
    }
}

/// A block with the words of its ports in the present cycle.
pub struct Stage {
    /// The block.
    pub device: Box<dyn Device>,
    /// Where its ports lie.
    pub layout: Layout,
    /// Inputs of the present cycle.
    pub inputs: Vec<u64>,
    /// Outputs, once settled.
    pub outputs: Vec<u64>,
}

impl Stage {
    /// All inputs are zero: nothing is offered, nothing is taken.
    pub fn new(device: Box<dyn Device>) -> Self {
        let layout = Layout::of(device.as_ref());
        Self { inputs: vec![0; layout.input_words], outputs: vec![0; layout.output_words], device, layout }
    }
    /// Offers a beat of the input stream, field after field in whole words.
    pub fn offer(&mut self, beat: &[u64]) {
        let mut from = 0;
        for (port, to) in self.layout.in_fields() {
            self.inputs[*to..to + port.words()].copy_from_slice(&beat[from..from + port.words()]);
            from += port.words();
        }
        self.inputs[self.layout.in_valid] = 1;
    }
    /// Offers nothing.
    pub fn withdraw(&mut self) {
        self.inputs[self.layout.in_valid] = 0;
    }
    /// Lets the block settle.
    pub fn settle(&mut self) {
        self.device.settle(&self.inputs, &mut self.outputs);
    }
    /// Whether the offered beat is taken at the coming edge.
    pub fn accepts(&self) -> bool {
        self.inputs[self.layout.in_valid] == 1 && self.outputs[self.layout.in_ready] == 1
    }
    /// Whether a beat leaves at the coming edge.
    pub fn sends(&self) -> bool {
        self.outputs[self.layout.out_valid] == 1 && self.inputs[self.layout.out_ready] == 1
    }
    /// The fields of the output stream, one after the other.
    pub fn sent(&self) -> Vec<u64> {
        let fields = self.layout.out_fields();
        fields.flat_map(|(port, at)| &self.outputs[*at..at + port.words()]).copied().collect()
    }
}
