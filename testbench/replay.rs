// SPDX-License-Identifier: MIT OR Apache-2.0
//! A block's emitted module in Verilator, behind the block in Rust.
//!
//! What a block is given in a cycle depends on what its neighbours said in the one before, and a question to Verilator
//! each cycle would take fifty times its work. So the blocks in Rust play first and note their cycles; Verilator runs
//! these in batches, and its outputs have to be those of Rust in every cycle.

use crate::cosim::{CosimError, Cycles, Design, Difference, Port, Response, Session, Verilator, first_difference};
use crate::device::Stage;
use relief_hdl::verilog::{EmitError, emit};
use std::path::Path;

/// Cycles of reset before the first one that is noted.
const RESET: usize = 2;

/// Cycles that are worth a batch: some megabytes.
const BATCH: usize = 16_384;

/// Why a module does not follow its block.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {
    /// The block cannot be emitted.
    #[error(transparent)]
    Emit(#[from] EmitError),
    /// The emitted module cannot be run.
    #[error(transparent)]
    Cosim(#[from] CosimError),
    /// Verilog and Rust disagree.
    #[error(
        "{block} of Verilator differs from that of Rust: in cycle {cycle} `{port}` is {got}, and {expected} was expected"
    )]
    Differs {
        /// The module.
        block: String,
        /// The cycle, counted from power-up, two cycles of reset included.
        cycle: u64,
        /// The output.
        port: String,
        /// What Rust says, in hexadecimal.
        expected: String,
        /// What Verilator says.
        got: String,
    },
}

/// A module that runs, and the cycles that it has to run next.
pub struct Replay {
    session: Session,
    stimulus: Cycles,
    expected: Cycles,
    /// Word of `out_valid` among the outputs.
    out_valid: usize,
    /// Cycles of the batches before.
    done: u64,
}

impl Replay {
    /// Emits the block of each stage into a folder of its own below `folder`, and builds the modules side by side.
    ///
    /// # Errors
    /// That a block cannot be emitted or built.
    pub fn build(stages: &[&Stage], folder: &Path) -> Result<Vec<Self>, ReplayError> {
        let designs = stages.iter().map(|stage| design(stage, folder)).collect::<Result<Vec<_>, _>>()?;
        // Compilers at work at once.
        std::thread::scope(|scope| {
            let builds: Vec<_> = designs.iter().map(|design| scope.spawn(|| Self::of(design))).collect();
            let joined = builds.into_iter().map(|build| build.join().unwrap_or_else(|p| std::panic::resume_unwind(p)));
            Ok(joined.collect::<Result<Vec<_>, CosimError>>()?)
        })
    }

    fn of(design: &Design) -> Result<Self, CosimError> {
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
    pub fn note(&mut self, stage: &Stage) {
        self.stimulus.push_with(|words| words[1..].copy_from_slice(&stage.inputs));
        self.expected.push(&stage.outputs);
    }

    /// Name of the module.
    pub fn block(&self) -> &str {
        &self.session.design().top
    }

    /// Cycles compared so far.
    pub fn followed(&self) -> u64 {
        self.done - RESET as u64
    }

    /// Whether enough cycles are noted to be run.
    pub fn is_full(&self) -> bool {
        self.stimulus.len() >= BATCH
    }

    /// Runs the noted cycles and returns their outputs, which are those of Rust.
    ///
    /// # Errors
    /// That they are not, or that the simulator fails.
    pub fn run(&mut self) -> Result<Cycles, ReplayError> {
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
            return Err(ReplayError::Differs { block, cycle, port, expected, got });
        }
        self.done += self.stimulus.len() as u64;
        self.stimulus = Cycles::new(self.stimulus.width());
        self.expected = Cycles::new(self.expected.width());
        Ok(response.values)
    }
}

/// Emits a block into a folder of its own. The ports lie as in the block's layout, behind the reset.
fn design(stage: &Stage, folder: &Path) -> Result<Design, ReplayError> {
    let (device, layout) = (stage.device.as_ref(), &stage.layout);
    let emission = emit(device.block())?;
    let folder = folder.join(&emission.top);
    emission.write(&folder)?;
    let inputs = layout.inputs.iter().map(|(port, _)| Port::input(port.name, port.bits));
    let outputs = layout.outputs.iter().map(|(port, _)| Port::output(port.name, port.bits));
    let ports = [Port::input("reset", 1)].into_iter().chain(inputs).chain(outputs).collect();
    Ok(Design::from_folder(&folder, emission.top.as_str(), ports)?)
}
