// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drivers, scoreboards and co-simulation that bind the blocks to their golden models.
pub mod cosim;
pub mod stepped;
