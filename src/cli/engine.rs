// SPDX-License-Identifier: MIT OR Apache-2.0
//! What computes a mesh: the option that several subcommands have.

use relief_testbench::check;
use relief_testbench::method::Engine;

/// What computes the meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum EngineName {
    /// The golden models
    Golden,
    /// The blocks, simulated in Rust, each beat compared with golden
    Rust,
    /// Their Verilog in Verilator, compared with Rust cycle by cycle
    Verilator,
}

impl EngineName {
    /// The engine, if its programs are there.
    pub fn resolve(self) -> Result<Engine, Box<dyn std::error::Error>> {
        match (self, check::Engine::Verilator.missing()) {
            (EngineName::Verilator, Some(missing)) => Err(missing.into()),
            (EngineName::Verilator, None) => Ok(Engine::Verilator),
            (EngineName::Rust, _) => Ok(Engine::Rust),
            (EngineName::Golden, _) => Ok(Engine::Golden),
        }
    }
}
