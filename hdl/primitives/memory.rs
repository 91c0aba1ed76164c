// SPDX-License-Identifier: MIT OR Apache-2.0
//! Memories with one synchronous read port: a RAM, with one write port, which synthesis infers as block RAM, and a ROM, which
//! stays in logic.
//!
//! RAM: read_data(t+1) = memory[read_address(t)] before the write of cycle t (read first); it holds while `enable` is low.
//! ROM: read_data(t+1) = contents[read_address(t)]; it holds while `enable` is low. The contents are loaded with `$readmemh`,
//! and stay in logic: a table of a few thousand bits is not worth a block RAM, of which maps need all there are.
//!
//! An address beyond the depth reads zero and writes nothing in simulation; hardware must not rely on it.

use crate::primitives::INLINE;
use crate::signal::{ClockReset, Input, Latch, Output, U};
use rust_hdl_core::prelude::*;

/// RAM of up to 2^A words of type `T`, one write and one read port.
#[derive(Clone, Debug)]
pub struct Ram<T: Synth, const A: usize> {
    /// Clock; nothing is reset.
    pub clock: Input<ClockReset>,
    /// Read enable: `read_data` holds when low; high when the kernel never drives it.
    pub enable: Input<Bit>,
    /// Writes `write_data` to `write_address` when high.
    pub write_enable: Input<Bit>,
    /// Address of the write port.
    pub write_address: Input<U<A>>,
    /// Data of the write port.
    pub write_data: Input<T>,
    /// Address of the read port.
    pub read_address: Input<U<A>>,
    /// Word addressed in the cycle before.
    pub read_data: Output<T>,
    words: Vec<T>,
    clock_was_high: bool,
    changed: bool,
}

impl<T: Synth, const A: usize> Ram<T, A> {
    /// Cycles from address to data.
    pub const LATENCY: usize = 1;
    /// A RAM of `depth` words, `1 <= depth <= 2^A`.
    pub fn new(depth: usize) -> Self {
        assert!(depth >= 1 && depth <= 1 << A, "a RAM of {depth} words needs an address of more than {A} bits");
        Self {
            clock: Input::default(),
            enable: Input::new(true),
            write_enable: Input::default(),
            write_address: Input::default(),
            write_data: Input::default(),
            read_address: Input::default(),
            read_data: Output::default(),
            words: vec![T::default(); depth],
            clock_was_high: false,
            changed: false,
        }
    }
}

impl<T: Synth, const A: usize> Default for Ram<T, A> {
    /// A RAM of 2^A words.
    fn default() -> Self {
        Self::new(1 << A)
    }
}

impl<T: Synth, const A: usize> Latch for Ram<T, A> {
    #[inline(always)]
    fn latch(&mut self, _reset: bool) -> bool {
        let mut changed = false;
        if self.enable.next {
            let word = self.words.get(self.read_address.next.index()).copied().unwrap_or_default();
            changed = word != self.read_data.next;
            self.read_data.next = word;
        }
        if self.write_enable.next
            && let Some(word) = self.words.get_mut(self.write_address.next.index())
        {
            changed |= *word != self.write_data.next;
            *word = self.write_data.next;
        }
        changed
    }
}

impl<T: Synth, const A: usize> Logic for Ram<T, A> {
    #[inline(always)]
    fn update(&mut self) {
        let clk = self.clock.next.clk;
        self.changed = clk && !self.clock_was_high && self.latch(false);
        self.clock_was_high = clk;
    }
    fn connect(&mut self) {
        self.read_data.connect();
    }
    fn hdl(&self) -> Verilog {
        let (top_bit, last) = (T::BITS - 1, self.words.len() - 1);
        let (bits, unused) = address::<A>(last, &["write_address", "read_address"]);
        Verilog::Custom(format!(
            "{INLINE}reg [{top_bit}:0] @memory [0:{last}];\n{unused}always @(posedge clock) begin\n    \
             if (@write_enable) @memory[@write_address{bits}] <= @write_data;\n    \
             if (@enable) @read_data <= @memory[@read_address{bits}];\nend\n"
        ))
    }
}

impl<T: Synth, const A: usize> Block for Ram<T, A> {
    fn connect_all(&mut self) {
        self.connect();
    }
    #[inline(always)]
    fn update_all(&mut self) {
        self.update();
    }
    #[inline(always)]
    fn has_changed(&self) -> bool {
        self.changed
    }
    fn accept(&self, name: &str, probe: &mut dyn Probe) {
        probe.visit_start_scope(name, self);
        self.clock.accept("clock", probe);
        self.enable.accept("enable", probe);
        self.write_enable.accept("write_enable", probe);
        self.write_address.accept("write_address", probe);
        self.write_data.accept("write_data", probe);
        self.read_address.accept("read_address", probe);
        self.read_data.accept("read_data", probe);
        probe.visit_end_scope(name, self);
    }
}

/// ROM of up to 2^A words of type `T`.
#[derive(Clone, Debug)]
pub struct Rom<T: Synth, const A: usize> {
    /// Clock; nothing is reset.
    pub clock: Input<ClockReset>,
    /// Read enable: `read_data` holds when low; high when the kernel never drives it.
    pub enable: Input<Bit>,
    /// Address.
    pub read_address: Input<U<A>>,
    /// Word addressed in the cycle before.
    pub read_data: Output<T>,
    file: String,
    words: Vec<T>,
    clock_was_high: bool,
    changed: bool,
}

impl<T: Synth, const A: usize> Rom<T, A> {
    /// Cycles from address to data.
    pub const LATENCY: usize = 1;
    /// A ROM with the given words; its contents are emitted as `<name>.hex`.
    pub fn new(name: &str, words: Vec<T>) -> Self {
        let depth = words.len();
        assert!(depth >= 1 && depth <= 1 << A, "a ROM of {depth} words needs an address of more than {A} bits");
        Self {
            clock: Input::default(),
            enable: Input::new(true),
            read_address: Input::default(),
            read_data: Output::default(),
            file: format!("{name}.hex"),
            words,
            clock_was_high: false,
            changed: false,
        }
    }
}

impl<T: Synth, const A: usize> Latch for Rom<T, A> {
    #[inline(always)]
    fn latch(&mut self, _reset: bool) -> bool {
        if !self.enable.next {
            return false;
        }
        let word = self.words.get(self.read_address.next.index()).copied().unwrap_or_default();
        let changed = word != self.read_data.next;
        self.read_data.next = word;
        changed
    }
}

impl<T: Synth, const A: usize> Logic for Rom<T, A> {
    #[inline(always)]
    fn update(&mut self) {
        let clk = self.clock.next.clk;
        self.changed = clk && !self.clock_was_high && self.latch(false);
        self.clock_was_high = clk;
    }
    fn connect(&mut self) {
        self.read_data.connect();
    }
    /// The contents travel behind the text as lines `//hex <file> <word>`; the back-end writes them to the file.
    fn hdl(&self) -> Verilog {
        let (top_bit, last, file) = (T::BITS - 1, self.words.len() - 1, &self.file);
        let (bits, unused) = address::<A>(last, &["read_address"]);
        let mut text = format!(
            "{INLINE}(* rom_style = \"logic\" *)\nreg [{top_bit}:0] @memory [0:{last}];\n{unused}initial $readmemh(\"{file}\", @memory);\n\
             always @(posedge clock) if (@enable) @read_data <= @memory[@read_address{bits}];\n"
        );
        for word in &self.words {
            text += &format!("//hex {file} {}\n", hexadecimal(&word.vcd()));
        }
        Verilog::Custom(text)
    }
}

impl<T: Synth, const A: usize> Block for Rom<T, A> {
    fn connect_all(&mut self) {
        self.connect();
    }
    #[inline(always)]
    fn update_all(&mut self) {
        self.update();
    }
    #[inline(always)]
    fn has_changed(&self) -> bool {
        self.changed
    }
    fn accept(&self, name: &str, probe: &mut dyn Probe) {
        probe.visit_start_scope(name, self);
        self.clock.accept("clock", probe);
        self.enable.accept("enable", probe);
        self.read_address.accept("read_address", probe);
        self.read_data.accept("read_data", probe);
        probe.visit_end_scope(name, self);
    }
}

/// The part of an address of `A` bits that reaches the words `0 ..= last`, and a line that takes note of the other bits,
/// which a counter needs that counts up to the depth. Empty where the address is no wider than it must be.
pub(super) fn address<const A: usize>(last: usize, ports: &[&str]) -> (String, String) {
    let needed = (usize::BITS - last.leading_zeros()).max(1) as usize;
    if needed == A {
        return (String::new(), String::new());
    }
    let ports: Vec<String> = ports.iter().map(|port| format!("@{port}")).collect();
    (format!("[{}:0]", needed - 1), format!("wire @unused = &{{1'b0, {}}};\n", ports.join(", ")))
}

/// Bits of a value, most significant first. Fields of a composite stand from the least significant upwards.
pub(crate) fn bits_of(value: &VCDValue) -> Vec<bool> {
    match value {
        VCDValue::Single(v) => vec![*v == vcd::Value::V1],
        VCDValue::Vector(v) => v.iter().map(|b| *b == vcd::Value::V1).collect(),
        VCDValue::Composite(fields) => fields.iter().rev().flat_map(|f| bits_of(f)).collect(),
        VCDValue::String(_) => vec![],
    }
}

/// The bits of a value in hexadecimal, without prefix.
pub(crate) fn hexadecimal(value: &VCDValue) -> String {
    let bits = bits_of(value);
    let mut padded = vec![false; (4 - bits.len() % 4) % 4];
    padded.extend(bits);
    padded
        .chunks(4)
        .map(|c| char::from_digit(c.iter().fold(0, |a, &b| 2 * a + u32::from(b)), 16).unwrap_or('0'))
        .collect()
}
