// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drivers, scoreboards and co-simulation that bind the blocks to their golden models.
//!
//! | module | what it does |
//! |---|---|
//! | [`binding`] | what a block brings: device, golden model, stimulus; the list of all blocks |
//! | [`stepped`], [`device`] | a block under a clock that is stepped by hand; the same with its type hidden |
//! | [`scoreboard`] | idle cycles, backpressure, comparison beat by beat |
//! | [`check`] | block against golden model, and every engine against the block, with replay and waveform |
//! | [`stimulus`] | beats from a file |
//! | [`cosim`] | the emitted Verilog in Verilator and Icarus, lint and synthesis |
//! | [`output`] | files and folders that appear whole or not at all |
//! | [`frame`] | a scene to pictures, a mesh and a report |
//! | [`method`] | ways from a height map to a mesh, and what their meshes are worth |
//! | [`pipeline`] | a draw through remesher, height fetch and strip unit, compared as it runs |
//! | [`probe`] | the signals inside a block, for the recorder of waveforms |
//! | [`replay`] | a block's Verilog in Verilator, run behind the block in batches |
//! | [`remesh`] | whole grids through the golden models, the blocks, or their Verilog |
//! | [`stability`] | the maps on which methods fail |
//! | `<block>` | the binding of that block |

pub mod binding;
pub mod bisector;
pub mod check;
pub mod clip;
pub mod cosim;
pub mod cull;
pub mod device;
pub mod displace;
pub mod displacement_pipeline;
pub mod exact_footprint;
pub mod face_normal;
pub mod facing;
pub mod filter_level;
pub mod frame;
pub mod gradient_normal;
pub mod light;
pub mod method;
pub mod mip_build;
pub mod mip_fetch;
pub mod output;
pub mod perspective_correct;
pub mod pipeline;
pub mod power;
pub mod probe;
pub mod reciprocal;
pub mod remesh;
pub mod remesher;
pub mod replay;
pub mod rsqrt;
pub mod sat_average;
pub mod sat_build;
pub mod sat_fetch;
pub mod sat_fetch_parallel;
pub mod scoreboard;
pub mod stability;
pub mod stepped;
pub mod stimulus;
pub mod strip_unit;
pub mod vertex_adder;
pub mod vertex_transform;
