// SPDX-License-Identifier: MIT OR Apache-2.0
//! The tests of the converter that `tests/run --junit` uses: cargo runs none that stand in examples.

#[path = "../examples/junit.rs"]
#[allow(dead_code, reason = "only the conversion is tested")]
mod junit;
