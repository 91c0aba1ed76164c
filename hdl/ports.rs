// SPDX-License-Identifier: MIT OR Apache-2.0
//! The ports of a block as words: what a test bench needs to drive any block without knowing its type.

use crate::signal::{ClockReset, Input, Watched};

/// Name and width of one port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortShape {
    /// Field name, which is the port's name in the emitted module.
    pub name: &'static str,
    /// Width.
    pub bits: usize,
}

impl PortShape {
    /// 64-bit words that the port takes.
    pub const fn words(&self) -> usize {
        self.bits.div_ceil(64)
    }
}

/// A block whose ports can be written and read as words, port after port, each padded to whole words.
pub trait Ports: Watched {
    /// Clock and reset of the block.
    fn clock_mut(&mut self) -> &mut Input<ClockReset>;
    /// Input ports but the clock, in the order of the fields.
    fn inputs(&self) -> Vec<PortShape>;
    /// Output ports, in the order of the fields.
    fn outputs(&self) -> Vec<PortShape>;
    /// Writes all inputs.
    fn write_inputs(&mut self, words: &[u64]);
    /// Reads all outputs.
    fn read_outputs(&self, words: &mut [u64]);
}

/// Implements [`Ports`] and [`Watched`] for a block: its generics, its type, its inputs and outputs in the order of the
/// fields, the sub-blocks that are no registers, and everything that holds state.
#[macro_export]
macro_rules! ports {
    ([$($generic:tt)*] $block:ty { inputs: $($input:ident),*; outputs: $($output:ident),*; blocks: $($child:ident),*; state: $($state:ident),* }) => {
        $crate::watched! { [$($generic)*] $block: $($input),*; $($child),*; $($state),* }
        impl<$($generic)*> $crate::ports::Ports for $block {
            fn clock_mut(&mut self) -> &mut $crate::signal::Input<$crate::signal::ClockReset> {
                &mut self.clock
            }
            fn inputs(&self) -> Vec<$crate::ports::PortShape> {
                vec![$($crate::ports::PortShape { name: stringify!($input), bits: self.$input.bits() }),*]
            }
            fn outputs(&self) -> Vec<$crate::ports::PortShape> {
                vec![$($crate::ports::PortShape { name: stringify!($output), bits: self.$output.bits() }),*]
            }
            #[allow(unused_assignments)]
            fn write_inputs(&mut self, words: &[u64]) {
                let mut at = 0;
                $(
                    self.$input.set_words(&words[at..]);
                    at += self.$input.words();
                )*
            }
            #[allow(unused_assignments)]
            fn read_outputs(&self, words: &mut [u64]) {
                let mut at = 0;
                $(
                    self.$output.get_words(&mut words[at..]);
                    at += self.$output.words();
                )*
            }
        }
    };
}
