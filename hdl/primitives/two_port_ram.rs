// SPDX-License-Identifier: MIT OR Apache-2.0
//! RAM with two ports and registers behind them: one reads or writes, the other one reads; two cycles from address to word.
//!
//! word(t+1) = memory[address(t)]; it holds while `enable` is low; the other port likewise
//! read_data(t+1) = word(t); it holds while `output_enable` is low
//!
//! A block RAM has two addresses. With a read port at each, and the write at the first one's, it does what two copies with a
//! write and a read port would do.
//!
//! A word that is written in the same cycle reads zero in simulation; hardware must not rely on it: what the block RAM
//! reads then is not said.

use crate::primitives::INLINE;
use crate::primitives::registered_ram::{BLOCK_BITS, LARGEST, SHALLOW, column};
use crate::signal::{ClockReset, Input, Latch, Output, U};
use rust_hdl_core::prelude::*;

/// RAM of 2^A words of type `T`.
#[derive(Clone, Debug)]
pub struct TwoPortRam<T: Synth, const A: usize> {
    /// Clock; nothing is reset.
    pub clock: Input<ClockReset>,
    /// Read enable of both ports: the words that are read hold when low.
    pub enable: Input<Bit>,
    /// The outputs hold when low.
    pub output_enable: Input<Bit>,
    /// Writes `write_data` to `address` when high.
    pub write_enable: Input<Bit>,
    /// Address of the first port, which writes and reads.
    pub address: Input<U<A>>,
    /// Data of the write.
    pub write_data: Input<T>,
    /// Address of the second port, which reads.
    pub second_address: Input<U<A>>,
    /// Word of the first port, addressed two cycles before, if both enables were high.
    pub read_data: Output<T>,
    /// Word of the second port.
    pub second_data: Output<T>,
    words: Vec<T>,
    word: [T; 2],
    clock_was_high: bool,
    changed: bool,
}

impl<T: Synth, const A: usize> TwoPortRam<T, A> {
    /// Cycles from address to data.
    pub const LATENCY: usize = 2;
}

impl<T: Synth, const A: usize> Default for TwoPortRam<T, A> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            enable: Input::new(true),
            output_enable: Input::new(true),
            write_enable: Input::default(),
            address: Input::default(),
            write_data: Input::default(),
            second_address: Input::default(),
            read_data: Output::default(),
            second_data: Output::default(),
            words: vec![T::default(); 1 << A],
            word: [T::default(); 2],
            clock_was_high: false,
            changed: false,
        }
    }
}

impl<T: Synth, const A: usize> Latch for TwoPortRam<T, A> {
    #[inline(always)]
    fn latch(&mut self, _reset: bool) -> bool {
        let mut changed = false;
        if self.output_enable.next {
            changed = [self.read_data.next, self.second_data.next] != self.word;
            [self.read_data.next, self.second_data.next] = self.word;
        }
        let at = self.address.next.index();
        let written = self.write_enable.next.then_some(at);
        if self.enable.next {
            let word = [at, self.second_address.next.index()].map(|at| {
                let collides = written == Some(at);
                self.words.get(at).copied().filter(|_| !collides).unwrap_or_default()
            });
            changed |= word != self.word;
            self.word = word;
        }
        if let Some(word) = written.and_then(|at| self.words.get_mut(at)) {
            changed |= *word != self.write_data.next;
            *word = self.write_data.next;
        }
        changed
    }
}

impl<T: Synth, const A: usize> Logic for TwoPortRam<T, A> {
    #[inline(always)]
    fn update(&mut self) {
        let clk = self.clock.next.clk;
        self.changed = clk && !self.clock_was_high && self.latch(false);
        self.clock_was_high = clk;
    }
    fn connect(&mut self) {
        self.read_data.connect();
        self.second_data.connect();
    }
    fn hdl(&self) -> Verilog {
        let (bits, depth) = (T::BITS, self.words.len());
        // Banks of one block RAM's depth, columns of its width; every bank's word is held, and which of them was meant.
        let whole = depth <= SHALLOW || depth * bits > LARGEST;
        let banks = if whole { 1 } else { depth.div_ceil(BLOCK_BITS) };
        let rows = if whole { depth } else { depth.min(BLOCK_BITS) };
        let width = if whole { bits } else { column(bits, rows) };
        let row = rows.trailing_zeros() as usize;
        let (chosen, place) = match banks {
            1 => (String::new(), String::new()),
            _ => (format!(" && @address[{}:{row}] == @b", A - 1), format!("[{}:0]", row - 1)),
        };
        let all = banks * bits - 1;
        let mut text = format!(
            "{INLINE}reg [{all}:0] @word, @second_word;\ngenvar @b, @k;\n\
             generate for (@b = 0; @b < {banks}; @b = @b + 1) begin : @bank\n    \
             for (@k = 0; @k < {bits}; @k = @k + {width}) begin : column\n        \
             (* no_rw_check *) reg [{}:0] memory [0:{}];\n        always @(posedge clock) begin\n            \
             if (@write_enable{chosen}) memory[@address{place}] <= @write_data[@k +: {width}];\n            \
             if (@enable) @word[@b * {bits} + @k +: {width}] <= memory[@address{place}];\n            \
             if (@enable) @second_word[@b * {bits} + @k +: {width}] <= memory[@second_address{place}];\n        \
             end\n    end\nend endgenerate\n",
            width - 1,
            rows - 1,
        );
        for (data, word, address) in
            [("read_data", "word", "address"), ("second_data", "second_word", "second_address")]
        {
            text += &match banks {
                1 => format!("always @(posedge clock) if (@output_enable) @{data} <= @{word};\n"),
                _ => format!(
                    "reg [{all}:0] @{word}_held;\nreg [{wide}:0] @{word}_choice, @{word}_choice_held;\n\
                     always @(posedge clock) begin\n    if (@enable) @{word}_choice <= @{address}[{top}:{row}];\n    \
                     if (@output_enable) begin\n        @{word}_held <= @{word};\n        \
                     @{word}_choice_held <= @{word}_choice;\n    end\nend\n\
                     wire [{last_bit}:0] @{word}_chosen;\n\
                     generate for (@k = 0; @k < {bits}; @k = @k + 1) begin : @{word}_bit\n    \
                     wire [{banks_less_one}:0] lane;\n    for (@b = 0; @b < {banks}; @b = @b + 1) begin : from\n        \
                     assign lane[@b] = @{word}_held[@b * {bits} + @k];\n    end\n    \
                     assign @{word}_chosen[@k] = lane[@{word}_choice_held];\nend endgenerate\n\
                     always @* @{data} = @{word}_chosen;\n",
                    wide = A - 1 - row,
                    top = A - 1,
                    last_bit = bits - 1,
                    banks_less_one = banks - 1,
                ),
            };
        }
        Verilog::Custom(text)
    }
}

impl<T: Synth, const A: usize> Block for TwoPortRam<T, A> {
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
        self.output_enable.accept("output_enable", probe);
        self.write_enable.accept("write_enable", probe);
        self.address.accept("address", probe);
        self.write_data.accept("write_data", probe);
        self.second_address.accept("second_address", probe);
        self.read_data.accept("read_data", probe);
        self.second_data.accept("second_data", probe);
        probe.visit_end_scope(name, self);
    }
}
