// SPDX-License-Identifier: MIT OR Apache-2.0
//! Synthesizable displacement-mapping hardware, with golden models and proofs: the façade.

pub mod prove;
pub mod synth;
