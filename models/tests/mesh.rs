// SPDX-License-Identifier: MIT OR Apache-2.0
//! The mesh checker: good tilings pass, every way of breaking one raises its own counters, readers survive anything.

#[path = "mesh/tilings.rs"]
mod tilings;
#[path = "mesh/writers.rs"]
mod writers;

#[path = "mesh/failures.rs"]
mod failures;
#[path = "mesh/large.rs"]
mod large;
#[path = "mesh/readers.rs"]
mod readers;
