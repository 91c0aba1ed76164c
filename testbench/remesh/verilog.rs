// SPDX-License-Identifier: MIT OR Apache-2.0
//! The emitted modules in Verilator, behind the blocks in Rust; the triangles are taken from Verilator's outputs.

use super::chain::{Chain, Counts};
use super::{Decoder, GridTriangle, Metered, RemeshError, SET, input_of};
use crate::cosim::CosimError;
use crate::replay::Replay;

/// The chain, its two modules, and the folder that their sources are in.
pub(super) struct Followed {
    chain: Chain,
    modules: Vec<Replay>,
    _folder: tempfile::TempDir,
}

impl Followed {
    /// Emits both blocks and builds them.
    pub(super) fn build() -> Result<Self, RemeshError> {
        let folder =
            tempfile::tempdir().map_err(|cause| CosimError::Io { what: "making a temporary folder".into(), cause })?;
        let chain = Chain::new(&SET);
        let modules = Replay::build(&chain.stages(), folder.path())?;
        Ok(Self { chain, modules, _folder: folder })
    }

    pub(super) fn run(&mut self, grid: &[GridTriangle], sink: &mut Metered<'_, '_>) -> Result<Counts, RemeshError> {
        let mut decoder = Decoder::new(grid, self.chain.decoder());
        let modules = &mut self.modules;
        let mut flush = |modules: &mut [Replay]| -> Result<(), RemeshError> {
            for module in modules {
                let outputs = module.run()?;
                // The strip unit is the last one.
                if module.block() == "relief_strip_unit" {
                    outputs.iter().try_for_each(|outputs| decoder.accept(outputs, sink))?;
                }
            }
            Ok(())
        };
        let counts = self.chain.run(grid.iter().map(input_of), &mut |chain| {
            modules.iter_mut().zip(chain.stages()).for_each(|(module, stage)| module.note(stage));
            if modules.iter().any(Replay::is_full) {
                flush(modules)?;
            }
            Ok(())
        })?;
        flush(modules)?;
        Ok(counts)
    }
}
