// SPDX-License-Identifier: MIT OR Apache-2.0
//! Register with enable and synchronous reset.
//!
//! | port   | format | meaning |   Latency 1
//! | clock  | ClockReset | rising edge; reset wins over enable |
//! | enable | Bit | holds when low; high when the kernel never drives it |
//! | d, q   | T   | |

use crate::primitives::INLINE;
use crate::signal::{ClockReset, Input, Latch, Output};
use rust_hdl_core::prelude::*;

/// A register of any signal type. [`Register::default`] is reset to zero, [`Register::new`] to a value,
/// [`Register::data`] is never reset: for payload whose valid flag is.
#[derive(Clone, Debug)]
pub struct Register<T: Synth> {
    /// Clock and reset.
    pub clock: Input<ClockReset>,
    /// Load enable; true unless driven.
    pub enable: Input<Bit>,
    /// Next value.
    pub d: Input<T>,
    /// Present value.
    pub q: Output<T>,
    reset_value: Option<Constant<T>>,
    clock_was_high: bool,
    changed: bool,
}

impl<T: Synth> Default for Register<T> {
    fn default() -> Self {
        Self::new(T::default())
    }
}

impl<T: Synth> Register<T> {
    fn with(initial: T, reset_value: Option<Constant<T>>) -> Self {
        Self {
            clock: Input::default(),
            enable: Input::new(true),
            d: Input::new(initial),
            q: Output::new(initial),
            reset_value,
            clock_was_high: false,
            changed: false,
        }
    }
    /// A register that the reset sets to `initial`.
    pub fn new(initial: T) -> Self {
        Self::with(initial, Some(Constant::new(initial)))
    }
    /// A register without reset.
    pub fn data() -> Self {
        Self::with(T::default(), None)
    }
}

impl<T: Synth> Latch for Register<T> {
    #[inline(always)]
    fn latch(&mut self, reset: bool) -> bool {
        let next = match (&self.reset_value, reset) {
            (Some(value), true) => value.val(),
            _ if self.enable.next => self.d.next,
            _ => self.q.next,
        };
        let changed = next != self.q.next;
        self.q.next = next;
        changed
    }
}

impl<T: Synth> Logic for Register<T> {
    #[inline(always)]
    fn update(&mut self) {
        let ClockReset { clk, reset } = self.clock.next;
        self.changed = clk && !self.clock_was_high && self.latch(reset);
        self.clock_was_high = clk;
    }
    fn connect(&mut self) {
        self.q.connect();
    }
    fn hdl(&self) -> Verilog {
        let body = if self.reset_value.is_some() {
            "always @(posedge clock) begin\n    if (reset) @q <= @initial;\n    else if (@enable) @q <= @d;\nend\n"
        } else {
            "always @(posedge clock) begin\n    if (@enable) @q <= @d;\nend\n"
        };
        Verilog::Custom(format!("{INLINE}{body}"))
    }
}

impl<T: Synth> Block for Register<T> {
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
        self.d.accept("d", probe);
        self.q.accept("q", probe);
        if let Some(value) = &self.reset_value {
            value.accept("initial", probe);
        }
        probe.visit_end_scope(name, self);
    }
}
