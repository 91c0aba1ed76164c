// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signal types of Relief: fixed-width integers, packed vertices, and the ports that carry them.
//!
//! rust-hdl's own `Signed<N>` and `Bits<N>` are slow above 32 bits and are emitted wrongly in several places (see
//! [`crate::verilog`]). These types are plain sign- or zero-extended machine words, wrap at their width, and tell the
//! back-end their sign and lanes through [`Synth::bits`](rust_hdl_core::synth::Synth::bits).

mod cast;
mod gated;
mod integer;
mod lanes;
mod port;
mod words;

pub use cast::{BitCast, Scalar, bit_cast_to};
pub use gated::{Gated, Latch, Watched};
pub use integer::{S, U, WideS, WideU};
pub use lanes::Lanes;
pub use port::{ClockReset, Input, Output, Wire};
pub use words::Words;

/// Bit of the code returned by `Synth::bits` that says: two's complement.
pub const SIGNED_FLAG: usize = 1 << 20;
/// Where the number of lanes stands in the code returned by `Synth::bits`; zero lanes means a scalar.
pub const LANES_SHIFT: usize = 24;
/// Bits of the code returned by `Synth::bits` that hold the width (of one lane, where there are lanes).
pub const WIDTH_MASK: usize = SIGNED_FLAG - 1;

/// Values of a VCD wire of `width` bits, most significant first.
pub(crate) fn vcd_vector(value: i128, width: usize) -> rust_hdl_core::synth::VCDValue {
    let bit = |k: usize| {
        if k < 128 && (value >> k) & 1 == 1 || k >= 128 && value < 0 { vcd::Value::V1 } else { vcd::Value::V0 }
    };
    rust_hdl_core::synth::VCDValue::Vector((0..width).rev().map(bit).collect())
}
