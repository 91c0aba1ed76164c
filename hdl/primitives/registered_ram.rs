// SPDX-License-Identifier: MIT OR Apache-2.0
//! RAM with a register behind it: one write and one read port, and two cycles from address to word.
//!
//! word(t+1) = memory[read_address(t)]; it holds while `enable` is low
//! read_data(t+1) = word(t); it holds while `output_enable` is low
//!
//! A late write goes through a register, too, which no enable holds: cycle t writes at the end of t + 1.
//!
//! A block RAM answers late in the cycle. So no multiplexer stands between it and the register: a deep memory is cut into
//! columns as narrow as the block RAM is then, and where it is deeper than one, each has its register and the choice is
//! made behind them.
//!
//! An address beyond the depth, and one that is written in the same cycle, reads zero in simulation; hardware must not rely
//! on it: what the block RAM reads then is not said, or synthesis would build it round every bit.

use crate::primitives::INLINE;
use crate::primitives::memory::address;
use crate::signal::{ClockReset, Input, Latch, Output, U};
use rust_hdl_core::prelude::*;

/// Bits of a block RAM, without those that only words of nine bits have, and so the greatest depth of one.
pub(super) const BLOCK_BITS: usize = 1 << 14;
/// Bits beyond which no part has the block RAM: what tells synthesis how to build it would be thousands of pieces.
pub(super) const LARGEST: usize = 1 << 22;
/// Up to here a block RAM is nine bits wide or more, and whatever synthesis does with words is right.
pub(super) const SHALLOW: usize = 2048;

/// RAM of up to 2^A words of type `T` with a registered output, and with a registered write where it is `LATE`: a decoder
/// of many block RAMs then ends at a register, and not at all of them.
#[derive(Clone, Debug)]
pub struct RegisteredRam<T: Synth, const A: usize, const LATE: bool = false> {
    /// Clock; nothing is reset.
    pub clock: Input<ClockReset>,
    /// Read enable: the word that is read holds when low.
    pub enable: Input<Bit>,
    /// `read_data` holds when low.
    pub output_enable: Input<Bit>,
    /// Writes `write_data` to `write_address` when high.
    pub write_enable: Input<Bit>,
    /// Address of the write port.
    pub write_address: Input<U<A>>,
    /// Data of the write port.
    pub write_data: Input<T>,
    /// Address of the read port.
    pub read_address: Input<U<A>>,
    /// Word addressed two cycles before, if both enables were high.
    pub read_data: Output<T>,
    words: Vec<T>,
    word: T,
    /// What is written next where writes are late.
    late: Option<(usize, T)>,
    clock_was_high: bool,
    changed: bool,
}

impl<T: Synth, const A: usize, const LATE: bool> RegisteredRam<T, A, LATE> {
    /// Cycles from address to data.
    pub const LATENCY: usize = 2;
    /// A RAM of `depth` words, `1 <= depth <= 2^A`.
    pub fn new(depth: usize) -> Self {
        assert!(depth >= 1 && depth <= 1 << A, "a RAM of {depth} words needs an address of more than {A} bits");
        Self {
            clock: Input::default(),
            enable: Input::new(true),
            output_enable: Input::new(true),
            write_enable: Input::default(),
            write_address: Input::default(),
            write_data: Input::default(),
            read_address: Input::default(),
            read_data: Output::default(),
            words: vec![T::default(); depth],
            word: T::default(),
            late: None,
            clock_was_high: false,
            changed: false,
        }
    }
}

impl<T: Synth, const A: usize, const LATE: bool> Default for RegisteredRam<T, A, LATE> {
    /// A RAM of 2^A words.
    fn default() -> Self {
        Self::new(1 << A)
    }
}

impl<T: Synth, const A: usize, const LATE: bool> Latch for RegisteredRam<T, A, LATE> {
    #[inline(always)]
    fn latch(&mut self, _reset: bool) -> bool {
        let mut changed = false;
        if self.output_enable.next {
            changed = self.word != self.read_data.next;
            self.read_data.next = self.word;
        }
        let asked = self.write_enable.next.then_some((self.write_address.next.index(), self.write_data.next));
        let write = if LATE { self.late } else { asked };
        if LATE {
            changed |= self.late != asked;
            self.late = asked;
        }
        if self.enable.next {
            let at = self.read_address.next.index();
            let collides = write.is_some_and(|(written, _)| written == at);
            let word = self.words.get(at).copied().filter(|_| !collides).unwrap_or_default();
            changed |= word != self.word;
            self.word = word;
        }
        if let Some((at, data)) = write
            && let Some(word) = self.words.get_mut(at)
        {
            changed |= *word != data;
            *word = data;
        }
        changed
    }
}

impl<T: Synth, const A: usize, const LATE: bool> Logic for RegisteredRam<T, A, LATE> {
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
        let (bits, depth) = (T::BITS, self.words.len());
        let last = depth - 1;
        let (part, unused) = address::<A>(last, &["write_address", "read_address"]);
        // Banks of one block RAM's depth, columns of its width.
        let whole = depth <= SHALLOW || depth * bits > LARGEST;
        let banks = if whole { 1 } else { depth.div_ceil(BLOCK_BITS) };
        let deepest = if whole { depth } else { depth.min(BLOCK_BITS) };
        let width = if whole { bits } else { column(bits, deepest) };
        let row = BLOCK_BITS.trailing_zeros() as usize;
        let top = (usize::BITS - last.leading_zeros()).max(1) as usize - 1;
        let chosen = |port: &str, bank: &str| match banks {
            1 => String::new(),
            _ => format!(" && @{port}[{top}:{row}] == {bank}"),
        };
        let place = if banks == 1 { part } else { format!("[{}:0]", row - 1) };
        let (all, banks_less_one, rows) = (banks * bits - 1, banks - 1, deepest - 1);
        let mut text = format!("{INLINE}{unused}reg [{all}:0] @word;\n");
        let (mut enable, mut from) = (
            format!("@write_enable{}", chosen("write_address", "@b")),
            [format!("@write_address{place}"), "@write_data".into()],
        );
        let mut late = String::new();
        if LATE {
            text += &format!(
                "reg [{banks_less_one}:0] @late;\nreg [{}:0] @late_address;\nreg [{}:0] @late_data;\n\
                 always @(posedge clock) begin\n    @late_address <= @write_address{place};\n    \
                 @late_data <= @write_data;\nend\n",
                (usize::BITS - rows.leading_zeros()).max(1) - 1,
                bits - 1,
            );
            late = format!("    always @(posedge clock) @late[@b] <= {enable};\n");
            (enable, from) = ("@late[@b]".into(), ["@late_address".into(), "@late_data".into()]);
        }
        text += &format!(
            "genvar @b, @k;\ngenerate for (@b = 0; @b < {banks}; @b = @b + 1) begin : @bank\n{late}    \
             for (@k = 0; @k < {bits}; @k = @k + {width}) begin : column\n        \
             (* no_rw_check *) reg [{}:0] memory [0:{rows}];\n        always @(posedge clock) begin\n            \
             if ({enable}) memory[{}] <= {}[@k +: {width}];\n            \
             if (@enable) @word[@b * {bits} + @k +: {width}] <= memory[@read_address{place}];\n        \
             end\n    end\nend endgenerate\n",
            width - 1,
            from[0],
            from[1],
        );
        if banks == 1 {
            text += "always @(posedge clock) if (@output_enable) @read_data <= @word;\n";
        } else {
            // Every bank's word is held, and which of them was meant.
            let wide = top - row;
            text += &format!(
                "reg [{all}:0] @held;\nreg [{wide}:0] @choice, @choice_held;\nalways @(posedge clock) begin\n    \
                 if (@enable) @choice <= @read_address[{top}:{row}];\n    \
                 if (@output_enable) begin\n        @held <= @word;\n        @choice_held <= @choice;\n    end\nend\n\
                 wire [{last_bit}:0] @chosen;\ngenerate for (@k = 0; @k < {bits}; @k = @k + 1) begin : @bit\n    \
                 wire [{banks_less_one}:0] lane;\n    for (@b = 0; @b < {banks}; @b = @b + 1) begin : from\n        \
                 assign lane[@b] = @held[@b * {bits} + @k];\n    end\n    \
                 assign @chosen[@k] = lane[@choice_held];\nend endgenerate\n\
                 always @* @read_data = @chosen;\n",
                last_bit = bits - 1,
            );
        }
        Verilog::Custom(text)
    }
}

/// Width of the columns of a memory of `depth` words: the greatest one that divides the word, and of which a block RAM
/// holds all words.
pub(super) fn column(bits: usize, depth: usize) -> usize {
    let most = BLOCK_BITS / depth.next_power_of_two();
    (1..=most).rev().find(|width| bits.is_multiple_of(*width)).unwrap_or(1)
}

impl<T: Synth, const A: usize, const LATE: bool> Block for RegisteredRam<T, A, LATE> {
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
        self.write_address.accept("write_address", probe);
        self.write_data.accept("write_data", probe);
        self.read_address.accept("read_address", probe);
        self.read_data.accept("read_data", probe);
        probe.visit_end_scope(name, self);
    }
}
