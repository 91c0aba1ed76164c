// SPDX-License-Identifier: MIT OR Apache-2.0
//! Synthesizable blocks of Relief in rust-hdl, their signal types, and the Verilog back-end.
//!
//! This crate never sees the golden models: what it computes is checked against them from outside, in the test bench.

pub mod bisector;
pub mod clip;
pub mod cull;
pub mod displace;
pub mod displacement_pipeline;
pub mod exact_footprint;
pub mod face_normal;
pub mod facing;
pub mod filter_level;
pub mod gradient_normal;
pub mod light;
pub mod mip_build;
pub mod mip_fetch;
pub mod perspective_correct;
pub mod pipeline;
pub mod ports;
pub mod power;
pub mod primitives;
pub mod reciprocal;
pub mod remesher;
pub mod rsqrt;
pub mod sat_average;
pub mod sat_build;
pub mod sat_fetch;
pub mod sat_fetch_parallel;
pub mod signal;
pub mod strip_unit;
pub mod verilog;
pub mod vertex_adder;
pub mod vertex_transform;
pub mod widths;

/// Everything a block's source file needs: the rust-hdl kernel macros and Relief's own signals and primitives.
pub mod prelude {
    pub use crate::primitives::{DataRegister, Multiplier, Ram, Register, RegisteredRam, Rom, TwoPortRam};
    pub use crate::signal::{
        ClockReset, Gated, Input, Lanes, Latch, Output, S, Scalar, U, WideS, WideU, Wire, bit_cast_to,
    };
    pub use crate::verilog::module_name;
    pub use crate::{latches, ports, watched};
    pub use rust_hdl_core::prelude::{
        Atom, AtomKind, Bit, Bits, Block, Constant, Logic, LogicBlock, LogicState, Probe, Synth, TimingInfo, ToBits,
        TypeDescriptor, TypeField, TypeKind, VCDValue, Verilog, VerilogLiteral, ast, bit_cast, block, clock, clog2,
        hdl_gen, logic, probe, synth, type_descriptor,
    };
    pub use rust_hdl_widgets::dff_setup;
}
