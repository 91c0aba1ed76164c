// SPDX-License-Identifier: MIT OR Apache-2.0
//! Golden models (integers, bit-accurate) and exact references (f64) of Relief's blocks.
//!
//! This crate knows nothing of rust-hdl, so the reference cannot share a helper, and with it a bug, with the hardware.
//! Number formats are run-time values here: a chart can sweep a width without a recompilation.

pub mod fixed;
pub mod mesh;
pub mod mip_build;
pub mod mip_fetch;
pub mod remesher;
pub mod sat_average;
pub mod sat_build;
pub mod sat_fetch;
pub mod step;
pub mod strip_unit;
pub mod vertex_adder;
