// SPDX-License-Identifier: MIT OR Apache-2.0
//! The emitted modules in Verilator.
//!
//! What a block is given in a cycle depends on what it said in the one before, and a question to Verilator each cycle
//! would take fifty times its work. So the blocks in Rust play first and note the inputs; Verilator runs these in
//! batches; and its outputs, from which the triangles are taken, have to be those of Rust in every cycle.

use super::chain::{Chain, Counts};
use super::{Decoder, GridTriangle, Metered, RemeshError, SET, input_of};
use crate::cosim::{CosimError, Cycles, Design, Difference, Port, Response, Session, Verilator, first_difference};
use crate::device::{Device, Layout};
use relief_hdl::verilog::emit;
use std::path::Path;

/// Cycles of reset before the first one that is noted.
const RESET: usize = 2;

/// Cycles that are noted before Verilator runs them: some megabytes.
const BATCH: usize = 16_384;

/// Both modules, built, with the folder that their sources are in.
pub(super) struct Replay {
    chain: Chain,
    modules: [Module; 2],
    _folder: tempfile::TempDir,
}

impl Replay {
    /// Emits both blocks and builds them.
    pub(super) fn build() -> Result<Self, RemeshError> {
        let folder =
            tempfile::tempdir().map_err(|cause| CosimError::Io { what: "making a temporary folder".into(), cause })?;
        let chain = Chain::new(&SET);
        let [remesher, strip] = chain.blocks().map(|(device, layout)| design(device, layout, folder.path()));
        let (remesher, strip) = (remesher?, strip?);
        // Two compilers at once.
        let (remesher, strip) = std::thread::scope(|scope| {
            let other = scope.spawn(|| Module::build(&strip));
            (Module::build(&remesher), other.join())
        });
        let strip = strip.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        Ok(Self { chain, modules: [remesher?, strip?], _folder: folder })
    }

    pub(super) fn run(&mut self, grid: &[GridTriangle], sink: &mut Metered<'_, '_>) -> Result<Counts, RemeshError> {
        let ports = self.chain.decoder();
        let mut decoder = Decoder::new(grid, ports);
        let [remesher, strip] = &mut self.modules;
        let mut flush = |remesher: &mut Module, strip: &mut Module| -> Result<(), RemeshError> {
            remesher.replay()?;
            for outputs in strip.replay()?.iter() {
                decoder.accept(outputs, sink)?;
            }
            Ok(())
        };
        let counts = self.chain.run(grid.iter().map(input_of), &mut |chain| {
            let [first, second] = chain.words();
            remesher.note(first);
            strip.note(second);
            if remesher.stimulus.len() < BATCH {
                return Ok(());
            }
            flush(remesher, strip)
        })?;
        flush(remesher, strip)?;
        Ok(counts)
    }
}

/// Emits a block into a folder of its own. The ports lie as in the block's layout, behind the reset.
fn design(device: &dyn Device, layout: &Layout, folder: &Path) -> Result<Design, RemeshError> {
    let emission = emit(device.block())?;
    let folder = folder.join(&emission.top);
    emission.write(&folder)?;
    let inputs = layout.inputs.iter().map(|(port, _)| Port::input(port.name, port.bits));
    let outputs = layout.outputs.iter().map(|(port, _)| Port::output(port.name, port.bits));
    let ports = [Port::input("reset", 1)].into_iter().chain(inputs).chain(outputs).collect();
    Ok(Design::from_folder(&folder, emission.top.as_str(), ports)?)
}

/// A module that runs, and the cycles that it has to run next.
struct Module {
    session: Session,
    stimulus: Cycles,
    expected: Cycles,
    /// Word of `out_valid` among the outputs.
    out_valid: usize,
    /// Cycles of the batches before.
    done: u64,
}

impl Module {
    fn build(design: &Design) -> Result<Self, CosimError> {
        let mut session = Verilator::new().build(design)?.start()?;
        let mut reset = Cycles::new(design.input_words());
        (0..RESET).for_each(|_| reset.push_with(|words| words[0] = 1));
        session.run(&reset)?;
        Ok(Self {
            session,
            stimulus: Cycles::new(design.input_words()),
            expected: Cycles::new(design.output_words()),
            out_valid: design.output("out_valid")?.word,
            done: RESET as u64,
        })
    }

    /// Notes the inputs and the outputs of a cycle in Rust.
    fn note(&mut self, (inputs, outputs): (&[u64], &[u64])) {
        self.stimulus.push_with(|words| words[1..].copy_from_slice(inputs));
        self.expected.push(outputs);
    }

    /// Runs the noted cycles and returns their outputs, which are those of Rust.
    fn replay(&mut self) -> Result<Cycles, RemeshError> {
        let values = self.session.run(&self.stimulus)?;
        let response = Response { values, unknown: None };
        // The payload of a stream matters while it is valid.
        let matters = |cycle: usize, port: &Port| {
            !port.name.starts_with("out_")
                || port.name == "out_valid"
                || self.expected.cycle(cycle)[self.out_valid] == 1
        };
        let design = self.session.design();
        if let Some(difference) = first_difference(design, &self.expected, &response, matters) {
            let Difference { cycle, port, expected, got } = difference;
            let (block, cycle) = (design.top.clone(), self.done + cycle as u64);
            return Err(RemeshError::Differs { block, cycle, port, expected, got });
        }
        self.done += self.stimulus.len() as u64;
        self.stimulus = Cycles::new(self.stimulus.width());
        self.expected = Cycles::new(self.expected.width());
        Ok(response.values)
    }
}
