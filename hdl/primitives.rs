// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaves that a kernel cannot express: registers, memories and the multiplier. Each is simulated by hand-written
//! Rust and emitted as hand-written Verilog, inlined into the module that uses it.
//!
//! In an inlined text `@` stands for the instance's name, `clock` and `reset` for the module's own.

mod divider;
mod memory;
mod multiplier;
mod register;
mod registered_ram;
mod two_port_ram;

pub use divider::Divider;
pub use memory::{Ram, Rom};
pub use multiplier::Multiplier;
pub use register::{DataRegister, Register};
pub use registered_ram::RegisteredRam;
pub use two_port_ram::TwoPortRam;

/// First line of the text of a [`Verilog::Custom`](rust_hdl_core::ast::Verilog) that is pasted into its parent.
pub const INLINE: &str = "//inline\n";
