// SPDX-License-Identifier: MIT OR Apache-2.0
//! Golden models (integers, bit-accurate) and exact references (f64) of Relief's blocks.
//!
//! This crate knows nothing of rust-hdl, so the reference cannot share a helper, and with it a bug, with the hardware.
//! Number formats are run-time values here: a chart can sweep a width without a recompilation.

pub mod bake;
pub mod bisector;
pub mod body;
pub mod clip;
pub mod closure;
pub mod cull;
pub mod digits;
pub mod displace;
pub mod displacement_pipeline;
pub mod draw;
pub mod exact_footprint;
pub mod face_normal;
pub mod facing;
pub mod failures;
pub mod filter_level;
pub mod filters;
pub mod fixed;
pub mod gradient_normal;
pub mod lanes;
pub mod light;
pub mod map;
pub mod measure;
pub mod mesh;
pub mod mip_build;
pub mod mip_fetch;
pub mod normals;
pub mod perspective_correct;
pub mod plan;
pub mod power;
pub mod raster;
pub mod reciprocal;
pub mod remesher;
pub mod rsqrt;
pub mod rules;
pub mod sat_average;
pub mod sat_build;
pub mod sat_fetch;
pub mod scene;
pub mod silhouette;
pub mod step;
pub mod strip_unit;
pub mod uniform;
pub mod vertex_adder;
pub mod vertex_cache;
pub mod vertex_transform;
pub mod wagging;
