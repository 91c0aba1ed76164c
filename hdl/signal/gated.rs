// SPDX-License-Identifier: MIT OR Apache-2.0
//! Skips the simulation of a sub-block while nothing can change in it. Hardware and waveforms are the same with or
//! without it: a gate is transparent to kernels, probes and the Verilog back-end.
//!
//! A block settles to a function of its inputs and registers, so between clock edges it is evaluated again only when
//! an input differs from the one it was evaluated with, or an output or register of its own still moves. A rising edge
//! that changed no register changes none the next time either, unless an input moved: such edges are skipped, too.

use super::{ClockReset, Input};
use rust_hdl_core::prelude::*;
use std::ops::{Deref, DerefMut};

/// A block that tells its gate whether an input has moved.
pub trait Watched: Block {
    /// The clock as its parent drives it.
    fn clock(&self) -> ClockReset;
    /// Sets the clock.
    fn set_clock(&mut self, clock: ClockReset);
    /// Whether an input but the clock differs from what the last call saw; remembers the present values.
    fn inputs_moved(&mut self) -> bool;
    /// Whether a sub-block has moved an output that this block's kernel has not read yet.
    fn inside_moves(&self) -> bool;
}

/// Implements [`Watched`]: generics, type, the inputs but the clock, and the sub-blocks that are no registers.
#[macro_export]
macro_rules! watched {
    ([$($generic:tt)*] $block:ty: $($input:ident),*; $($child:ident),*) => {
        impl<$($generic)*> $crate::signal::Watched for $block {
            #[inline(always)]
            fn clock(&self) -> $crate::signal::ClockReset {
                self.clock.next
            }
            #[inline(always)]
            fn set_clock(&mut self, clock: $crate::signal::ClockReset) {
                self.clock.next = clock;
            }
            #[inline(always)]
            fn inside_moves(&self) -> bool {
                false $(| $crate::prelude::Block::has_changed(&self.$child))*
            }
            #[inline(always)]
            fn inputs_moved(&mut self) -> bool {
                false $(| self.$input.moved())*
            }
        }
    };
}

/// A sub-block behind a gate; use it as the block itself.
#[derive(Clone, Debug)]
pub struct Gated<B: Watched> {
    block: B,
    clock: ClockReset,
    /// The block must be evaluated again: a sub-block of it moved.
    unsettled: bool,
    /// An output moved in the last pass: the parent must be evaluated again.
    changed: bool,
    /// The last rising edge changed nothing, and no input has moved since.
    quiet: bool,
}

impl<B: Watched> Gated<B> {
    /// Puts `block` behind a gate.
    pub fn new(block: B) -> Self {
        Self { block, clock: ClockReset::default(), unsettled: true, changed: true, quiet: false }
    }
}

impl<B: Watched + Default> Default for Gated<B> {
    fn default() -> Self {
        Self::new(B::default())
    }
}

impl<B: Watched> Deref for Gated<B> {
    type Target = B;
    #[inline(always)]
    fn deref(&self) -> &B {
        &self.block
    }
}

impl<B: Watched> DerefMut for Gated<B> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut B {
        &mut self.block
    }
}

impl<B: Watched> Logic for Gated<B> {
    fn update(&mut self) {}
}

impl<B: Watched> Block for Gated<B> {
    fn connect_all(&mut self) {
        self.block.connect_all();
    }
    #[inline]
    fn update_all(&mut self) {
        let clock = self.block.clock();
        let moved = self.block.inputs_moved() || clock.reset != self.clock.reset;
        let rising = clock.clk && !self.clock.clk;
        self.quiet &= !moved;
        self.changed = false;
        if rising && (moved || self.unsettled || !self.quiet) {
            self.block.update_all();
            self.quiet = !self.block.has_changed();
            // What the edge changed shows at the outputs at once; the parent lowers the clock in its next pass.
            self.block.set_clock(ClockReset { clk: false, ..clock });
        }
        if (rising && !self.quiet) || (!rising && (moved || self.unsettled)) {
            self.block.update_all();
            self.changed = self.block.has_changed();
            self.unsettled = self.block.inside_moves();
        }
        self.clock = clock;
    }
    #[inline(always)]
    fn has_changed(&self) -> bool {
        self.changed
    }
    fn accept(&self, name: &str, probe: &mut dyn Probe) {
        self.block.accept(name, probe);
    }
}

impl<T: Synth> Input<T> {
    /// Whether the value differs from what the last call saw.
    #[inline(always)]
    pub fn moved(&mut self) -> bool {
        let moved = self.next != self.seen;
        if moved {
            self.seen = self.next;
        }
        moved
    }
}
