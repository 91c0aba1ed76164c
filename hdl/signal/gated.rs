// SPDX-License-Identifier: MIT OR Apache-2.0
//! Quick stepping: latches every register of a block without evaluating a kernel, and skips the simulation of a
//! sub-block while nothing can change in it. Hardware and waveforms are the same with or without it.
//!
//! A block settles to a function of its inputs and registers. So a rising edge needs no kernel, only what the kernels
//! have left at the registers' inputs; and between edges a sub-block is evaluated again only when an input differs from
//! the one it was evaluated with, or a sub-block of its own still moves. An edge that changed no register changes none
//! the next time either, unless the block has been evaluated since: such edges are skipped, too.

use super::Input;
use rust_hdl_core::prelude::*;
use std::ops::{Deref, DerefMut};

/// Something that holds state: it can take a rising edge by itself.
pub trait Latch {
    /// Takes a rising edge, with or without reset. True when any state changed.
    fn latch(&mut self, reset: bool) -> bool;
}

/// Implements [`Latch`] for a block: generics, type, and every register, memory and sub-block that holds state.
#[macro_export]
macro_rules! latches {
    ([$($generic:tt)*] $block:ty: $($state:ident),*) => {
        impl<$($generic)*> $crate::signal::Latch for $block {
            #[inline]
            fn latch(&mut self, reset: bool) -> bool {
                let _ = reset;
                false $(| self.$state.latch(reset))*
            }
        }
    };
}

/// A block that tells its gate or its bench what moves.
pub trait Watched: Block + Latch {
    /// Whether an input but the clock differs from what the last call saw; remembers the present values.
    fn inputs_moved(&mut self) -> bool;
    /// Whether a sub-block has moved an output that this block's kernel has not read yet.
    fn inside_moves(&self) -> bool;
}

/// Implements [`Watched`] and [`Latch`]: generics, type, the inputs but the clock, the sub-blocks that are no
/// registers, and everything that holds state.
#[macro_export]
macro_rules! watched {
    ([$($generic:tt)*] $block:ty: $($input:ident),*; $($child:ident),*; $($state:ident),*) => {
        $crate::latches! { [$($generic)*] $block: $($state),* }
        impl<$($generic)*> $crate::signal::Watched for $block {
            #[inline(always)]
            fn inputs_moved(&mut self) -> bool {
                false $(| self.$input.moved())*
            }
            #[inline(always)]
            fn inside_moves(&self) -> bool {
                false $(| $crate::prelude::Block::has_changed(&self.$child))*
            }
        }
    };
}

/// A sub-block behind a gate; use it as the block itself: the gate is transparent to kernels, probes and the back-end.
#[derive(Clone, Debug)]
pub struct Gated<B: Watched> {
    /// On the heap: a design of many blocks is larger than the stack of a thread.
    block: Box<B>,
    /// The block must be evaluated again: a sub-block of it moved.
    unsettled: bool,
    /// An output moved in the last pass: the parent must be evaluated again.
    changed: bool,
    /// The last rising edge changed nothing, and the block has not been evaluated since.
    quiet: bool,
}

impl<B: Watched> Gated<B> {
    /// Puts `block` behind a gate.
    pub fn new(block: B) -> Self {
        Self { block: Box::new(block), unsettled: true, changed: true, quiet: false }
    }
    fn evaluate(&mut self) {
        self.block.update_all();
        self.changed = self.block.has_changed();
        self.unsettled = self.block.inside_moves();
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

impl<B: Watched> Latch for Gated<B> {
    fn latch(&mut self, reset: bool) -> bool {
        if self.quiet && !reset {
            return false;
        }
        let changed = self.block.latch(reset);
        // Under reset nothing may change and yet a register be about to.
        self.quiet = !changed && !reset;
        if changed {
            // What the edge changed shows at the outputs before the parent reads them.
            self.evaluate();
        }
        changed
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
        self.changed = false;
        if self.block.inputs_moved() || self.unsettled {
            self.quiet = false;
            self.evaluate();
        }
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
