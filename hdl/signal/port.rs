// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ports and wires. They read what was last written, so a value runs down the hierarchy in one pass, and only outputs
//! ask for another pass: a design settles in two or three passes where stock signals need one a level.
//!
//! This is safe for clocked logic because every register sees the clock in the same pass, and latches after its
//! parent's kernel has run and before any kernel can see the new state (see [`crate::primitives::Register`]).

use super::Words;
use rust_hdl_core::prelude::*;
use rust_hdl_core::signal::get_signal_id;

/// The clock of a block together with its synchronous, active-high reset: the emitted module has the two ports
/// `clock` and `reset`.
#[derive(Clone, Copy, Default, PartialEq, Debug)]
pub struct ClockReset {
    /// Level of the clock.
    pub clk: bool,
    /// Level of the reset.
    pub reset: bool,
}

impl Synth for ClockReset {
    const BITS: usize = 2;
    fn descriptor() -> TypeDescriptor {
        let bit = |name: &str| Box::new(TypeField { fieldname: name.into(), kind: bool::descriptor() });
        TypeDescriptor { name: "ClockReset".into(), kind: TypeKind::Composite(vec![bit("clock"), bit("reset")]) }
    }
    fn vcd(self) -> VCDValue {
        VCDValue::Composite(vec![Box::new(self.clk.into()), Box::new(self.reset.into())])
    }
    fn verilog(self) -> VerilogLiteral {
        0u128.into()
    }
}

macro_rules! port {
    ($name:ident, $kind:expr, $doc:expr $(, $shown:ident)?) => {
        #[doc = $doc]
        #[derive(Clone, Debug)]
        pub struct $name<T: Synth> {
            /// The value written last; a kernel writes `.next` and reads `.val()`.
            pub next: T,
            $(pub(super) $shown: T,)?
            id: usize,
            changed: bool,
            connected: bool,
        }
        impl<T: Synth> Default for $name<T> {
            fn default() -> Self {
                Self::new(T::default())
            }
        }
        impl<T: Synth> $name<T> {
            /// A port that holds `value` until it is written.
            pub fn new(value: T) -> Self {
                Self { next: value, $($shown: value,)? id: get_signal_id(), changed: false, connected: false }
            }
            /// The value.
            #[inline(always)]
            pub fn val(&self) -> T {
                self.next
            }
        }
        impl<T: Synth> Logic for $name<T> {
            fn update(&mut self) {}
            fn connect(&mut self) {
                self.connected = true;
            }
        }
        impl<T: Synth> Atom for $name<T> {
            fn bits(&self) -> usize {
                T::BITS
            }
            fn connected(&self) -> bool {
                self.connected
            }
            fn changed(&self) -> bool {
                self.changed
            }
            fn kind(&self) -> AtomKind {
                $kind
            }
            fn descriptor(&self) -> TypeDescriptor {
                T::descriptor()
            }
            fn vcd(&self) -> VCDValue {
                self.next.vcd()
            }
            fn id(&self) -> usize {
                self.id
            }
            fn verilog(&self) -> VerilogLiteral {
                self.next.verilog()
            }
            fn constraints(&self) -> Vec<PinConstraint> {
                vec![]
            }
        }
    };
}
port!(Input, AtomKind::InputParameter, "An input port.", seen);
port!(Output, AtomKind::OutputParameter, "An output port.", shown);
port!(Wire, AtomKind::LocalSignal, "A signal inside a block: written first, read afterwards, in the same kernel.");

impl<T: Words> Input<T> {
    /// Words of 64 bits that the port takes.
    pub const fn words(&self) -> usize {
        T::WORDS
    }
    /// Writes the port from words, least significant first.
    #[inline(always)]
    pub fn set_words(&mut self, words: &[u64]) {
        self.next = T::get(words);
    }
}

impl<T: Words> Output<T> {
    /// Words of 64 bits that the port takes.
    pub const fn words(&self) -> usize {
        T::WORDS
    }
    /// Reads the port as words, least significant first.
    #[inline(always)]
    pub fn get_words(&self, words: &mut [u64]) {
        self.next.put(words);
    }
}

macro_rules! silent {
    ($name:ident) => {
        impl<T: Synth> Block for $name<T> {
            fn connect_all(&mut self) {}
            #[inline(always)]
            fn update_all(&mut self) {}
            #[inline(always)]
            fn has_changed(&self) -> bool {
                false
            }
            fn accept(&self, name: &str, probe: &mut dyn Probe) {
                probe.visit_atom(name, self);
            }
        }
    };
}
// The reader of an input or a wire runs after its writer in the same pass: no further pass is needed.
silent!(Input);
silent!(Wire);

impl<T: Synth> Block for Output<T> {
    fn connect_all(&mut self) {}
    #[inline(always)]
    fn update_all(&mut self) {
        self.changed = self.next != self.shown;
        if self.changed {
            self.shown = self.next;
        }
    }
    #[inline(always)]
    fn has_changed(&self) -> bool {
        self.changed
    }
    fn accept(&self, name: &str, probe: &mut dyn Probe) {
        probe.visit_atom(name, self);
    }
}
