// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signed multiplier, one product a cycle, emitted as a single `*` so that synthesis picks the DSP blocks.
//!
//! p = a * b   (exact when P >= A + B, modulo 2^P otherwise)
//!
//! | port  | format      |   Latency 1, interval 1, error 0; the product holds while `enable` is low
//! | a     | signed A    |   Example: A = B = 4, P = 8:  -8 * -8 -> 64
//! | b     | signed B    |
//! | p     | signed wide P |

use crate::primitives::INLINE;
use crate::signal::{ClockReset, Input, Latch, Output, S, Scalar, WideS};
use rust_hdl_core::prelude::*;

/// Multiplier of `A` by `B` bits with a registered product of `P` bits.
#[derive(Clone, Debug)]
pub struct Multiplier<const A: usize, const B: usize, const P: usize> {
    /// Clock; the product register is not reset.
    pub clock: Input<ClockReset>,
    /// The product holds when low; high when the kernel never drives it.
    pub enable: Input<Bit>,
    /// First factor.
    pub a: Input<S<A>>,
    /// Second factor.
    pub b: Input<S<B>>,
    /// Product of the factors of the cycle before.
    pub p: Output<WideS<P>>,
    clock_was_high: bool,
    changed: bool,
}

impl<const A: usize, const B: usize, const P: usize> Default for Multiplier<A, B, P> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            enable: Input::new(true),
            a: Input::default(),
            b: Input::default(),
            p: Output::default(),
            clock_was_high: false,
            changed: false,
        }
    }
}

impl<const A: usize, const B: usize, const P: usize> Multiplier<A, B, P> {
    /// Cycles from factors to product.
    pub const LATENCY: usize = 1;
}

impl<const A: usize, const B: usize, const P: usize> Latch for Multiplier<A, B, P> {
    #[inline(always)]
    fn latch(&mut self, _reset: bool) -> bool {
        if !self.enable.next {
            return false;
        }
        let product = WideS::new(self.a.next.wide().wrapping_mul(self.b.next.wide()));
        let changed = product != self.p.next;
        self.p.next = product;
        changed
    }
}

impl<const A: usize, const B: usize, const P: usize> Logic for Multiplier<A, B, P> {
    #[inline(always)]
    fn update(&mut self) {
        let clk = self.clock.next.clk;
        self.changed = clk && !self.clock_was_high && self.latch(false);
        self.clock_was_high = clk;
    }
    fn connect(&mut self) {
        self.p.connect();
    }
    fn hdl(&self) -> Verilog {
        Verilog::Custom(format!(
            "{INLINE}/* verilator lint_off WIDTH */ // The assignment extends the signed factors; done by hand, \
             synthesis would not see the small product.\nalways @(posedge clock) if (@enable) @p <= @a * @b;\n\
             /* verilator lint_on WIDTH */\n"
        ))
    }
}

impl<const A: usize, const B: usize, const P: usize> Block for Multiplier<A, B, P> {
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
        self.a.accept("a", probe);
        self.b.accept("b", probe);
        self.p.accept("p", probe);
        probe.visit_end_scope(name, self);
    }
}
