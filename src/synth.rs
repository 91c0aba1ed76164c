// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cells and clock rates of emitted blocks: Yosys counts, nextpnr places and routes (`docs/synth.md`).
//!
//! | module       | what it does                                                             |
//! |--------------|--------------------------------------------------------------------------|
//! | [`target`]   | the parts: their Yosys pass, their kinds of cells, what they hold         |
//! | [`programs`] | finds Yosys and nextpnr, and says how to install them                    |
//! | [`harness`]  | a module round a block that needs four pins                              |
//! | [`yosys`]    | from Verilog to a netlist of the part's cells, and their counts          |
//! | [`pack`]     | registers behind block RAM that belong into it                           |
//! | [`copies`]   | copies of what many cells wait for, in blocks of many lanes              |
//! | [`nextpnr`]  | places and routes, and reads the report                                  |
//! | [`path`]     | the critical path in the names of the emitted Verilog                    |
//! | [`measure`]  | all of it for one block, width set and part                              |
//! | [`cost`]     | what widths cost before anything is synthesized: `relief plan`            |
//! | [`figures`]  | `docs/figures.json` and the tables that are made of it                   |

pub mod copies;
pub mod cost;
pub mod figures;
pub mod harness;
pub mod measure;
pub mod nextpnr;
pub mod pack;
pub mod path;
pub mod programs;
pub mod target;
pub mod yosys;
