// SPDX-License-Identifier: MIT OR Apache-2.0
//! Runs an emitted design in Verilator and Icarus, checks it with their linters, and counts its cells with Yosys.
//!
//! | module        | what it does                                                                    |
//! |---------------|---------------------------------------------------------------------------------|
//! | [`design`]    | the sources, the ports and where each port lies in the words of a cycle         |
//! | [`cycles`]    | the words of many cycles, and what differs between two of them                  |
//! | [`verilator`] | a compiled simulator behind a pipe: batches, or a cycle at a time               |
//! | [`stream`]    | the same beside its driver: beats in, beats out                                        |
//! | [`icarus`]    | an interpreted simulator that knows unknown bits: batches                       |
//! | [`lint`]      | what Verilator and Icarus say of the sources                                    |
//! | [`synthesis`] | the cells that Yosys maps the design to                                         |
//! | [`program`]   | runs a program for a bounded time                                               |
//! | [`tools`]     | which of the programs there are, and what to install                            |
//!
//! # Sampling
//! For every cycle both simulators do the same: they set the inputs while the clock is low, let the design settle,
//! sample the outputs, and then raise the clock. So the outputs of a cycle are those just before its rising edge, and
//! a combinational path shows the inputs of the same cycle.
//!
//! # Words
//! Every port takes `bits.div_ceil(64)` words, the least significant first, in the order of [`Design::ports`]; inputs
//! and outputs are counted apart. A design without inputs still takes one word a cycle, which says that there is one.

pub mod cycles;
pub mod design;
pub mod gates;
pub mod icarus;
pub mod lint;
pub mod program;
pub mod stream;
pub mod synthesis;
pub mod tools;
pub mod verilator;

pub use cycles::{Cycles, Difference, Response, first_difference};
pub use design::{Design, Direction, Port, Slot};
pub use gates::{Link, Stalls};
pub use icarus::{Icarus, IcarusModel};
pub use lint::{LintMessage, Severity, Waiver, iverilog_accepts, verilator_lint};
pub use stream::{Stream, Streamed};
pub use synthesis::{CellReport, count_cells, yosys_synth_ecp5};
pub use verilator::{Dump, PowerUp, Session, Verilator, VerilatorModel};

use std::{io, path::PathBuf, time::Duration};
use thiserror::Error;

/// A built design that answers stimulus with response.
pub trait Simulator {
    /// The program, as messages name it.
    fn name(&self) -> &'static str;

    /// The design that was built.
    fn design(&self) -> &Design;

    /// Runs the whole stimulus from power-up and returns one response a cycle.
    fn run(&self, stimulus: &Cycles) -> Result<Response, CosimError>;
}

/// Why a design could not be run or checked.
#[derive(Debug, Error)]
pub enum CosimError {
    /// A program is not installed.
    #[error(transparent)]
    Missing(#[from] tools::Missing),
    /// The description of the design contradicts itself.
    #[error("the design `{top}` cannot be built: {reason}")]
    Design {
        /// The top module.
        top: String,
        /// What is wrong, as half a sentence.
        reason: String,
    },
    /// There is no such port.
    #[error("the design `{top}` has no {direction} `{port}`")]
    Port {
        /// The top module.
        top: String,
        /// The direction asked for.
        direction: Direction,
        /// The name.
        port: String,
    },
    /// The stimulus was made for other ports.
    #[error("the design `{top}` takes {expected} words a cycle, and the stimulus has {got}")]
    Width {
        /// The top module.
        top: String,
        /// What the inputs take.
        expected: usize,
        /// What came.
        got: usize,
    },
    /// A program ran and said no.
    #[error("{what} failed with {status}; it said:\n{excerpt}")]
    Failed {
        /// What was run, and for what.
        what: String,
        /// The code or the signal.
        status: String,
        /// The first lines of its output.
        excerpt: String,
    },
    /// A program did not come to an end.
    #[error("{what} was stopped after {} s; it had said:\n{excerpt}", .limit.as_secs())]
    Timeout {
        /// What was run, and for what.
        what: String,
        /// How long it had.
        limit: Duration,
        /// The first lines of its output.
        excerpt: String,
    },
    /// A simulator ended in the middle.
    #[error("the simulator of `{top}` ended after {cycles} cycles with {status}; it said:\n{excerpt}")]
    Ended {
        /// The top module.
        top: String,
        /// How many responses had come.
        cycles: u64,
        /// The code or the signal.
        status: String,
        /// The first lines of its output.
        excerpt: String,
    },
    /// A program answered in a way that is not understood.
    #[error("the answer of {what} is not understood: {reason}")]
    Answer {
        /// What was run, and for what.
        what: String,
        /// What is odd about it.
        reason: String,
    },
    /// The system refused something.
    #[error("{what} failed: {cause}")]
    Io {
        /// What was tried.
        what: String,
        /// Why it failed.
        cause: io::Error,
    },
}

/// Turns an error of the system into a sentence.
fn io_error(what: impl Into<String>) -> impl FnOnce(io::Error) -> CosimError {
    let what = what.into();
    move |cause| CosimError::Io { what, cause }
}

/// Where built simulators are kept: `RELIEF_CACHE`, or `relief-cosim` in the target folder of the workspace.
pub fn default_cache() -> PathBuf {
    if let Some(folder) = std::env::var_os("RELIEF_CACHE").filter(|folder| !folder.is_empty()) {
        return folder.into();
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let workspace = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    match target {
        Some(target) if target.is_absolute() => target.join("relief-cosim"),
        _ if workspace.is_dir() => workspace.join("target").join("relief-cosim"),
        // The sources this was built from are gone.
        _ => std::env::temp_dir().join("relief-cosim"),
    }
}
