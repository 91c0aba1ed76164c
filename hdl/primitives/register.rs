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

/// A register of any signal type. [`Register::default`] is reset to zero, [`Register::new`] to a value; a
/// [`DataRegister`] is never reset.
#[derive(Clone, Debug)]
pub struct Register<T: Synth, const RESET: bool = true> {
    /// Clock and reset.
    pub clock: Input<ClockReset>,
    /// Load enable; true unless driven.
    pub enable: Input<Bit>,
    /// Next value.
    pub d: Input<T>,
    /// Present value.
    pub q: Output<T>,
    reset_value: Constant<T>,
    clock_was_high: bool,
    changed: bool,
}

/// A register without reset, for payload whose valid flag is reset.
pub type DataRegister<T> = Register<T, false>;

impl<T: Synth, const RESET: bool> Default for Register<T, RESET> {
    fn default() -> Self {
        Self::with(T::default())
    }
}

impl<T: Synth, const RESET: bool> Register<T, RESET> {
    fn with(initial: T) -> Self {
        Self {
            clock: Input::default(),
            enable: Input::new(true),
            d: Input::new(initial),
            q: Output::new(initial),
            reset_value: Constant::new(initial),
            clock_was_high: false,
            changed: false,
        }
    }
}

impl<T: Synth> Register<T> {
    /// A register that the reset sets to `initial`.
    pub fn new(initial: T) -> Self {
        Self::with(initial)
    }
}

impl<T: Synth, const RESET: bool> Latch for Register<T, RESET> {
    #[inline(always)]
    fn latch(&mut self, reset: bool) -> bool {
        let next = if RESET && reset {
            self.reset_value.val()
        } else if self.enable.next {
            self.d.next
        } else {
            self.q.next
        };
        let changed = next != self.q.next;
        self.q.next = next;
        changed
    }
}

impl<T: Synth, const RESET: bool> Logic for Register<T, RESET> {
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
        let body = if RESET {
            "always @(posedge clock) begin\n    if (reset) @q <= @initial;\n    else if (@enable) @q <= @d;\nend\n"
        } else {
            "always @(posedge clock) begin\n    if (@enable) @q <= @d;\nend\n"
        };
        Verilog::Custom(format!("{INLINE}{body}"))
    }
}

impl<T: Synth, const RESET: bool> Block for Register<T, RESET> {
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
        if RESET {
            self.reset_value.accept("initial", probe);
        }
        probe.visit_end_scope(name, self);
    }
}
