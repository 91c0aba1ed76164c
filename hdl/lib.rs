// SPDX-License-Identifier: MIT OR Apache-2.0
//! Synthesizable blocks in rust-hdl, their signal types, and the Verilog back-end.
