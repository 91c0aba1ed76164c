// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the subcommands share: the outcome, output that may be piped away, and the progress of long work.

use std::error::Error;
use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use relief_models::mesh::Progress;

pub mod bake;
pub mod blocks;
pub mod chart;
pub mod check;
pub mod check_mesh;
pub mod emit;
mod engine;
pub mod measure;
pub mod normals;
mod output;
pub mod plan;
pub mod prove;
pub mod remesh;
pub mod run;
mod select;
pub mod silhouette;
pub mod sim;
pub mod stability;
pub mod synth;
pub mod tessellate;
pub mod wagging;

/// How a subcommand ended that could do its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Everything that was compared agreed.
    Agreed,
    /// Something did not.
    Mismatch,
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> ExitCode {
        match outcome {
            Outcome::Agreed => ExitCode::SUCCESS,
            Outcome::Mismatch => ExitCode::FAILURE,
        }
    }
}

/// An outcome, or why the input is bad: a sentence that says what, where, and what would be right.
pub type Result = std::result::Result<Outcome, Box<dyn Error>>;

/// Writes all of `text` to `target` at once. A reader that has gone away is no error of ours.
pub fn write_all(mut target: impl Write, text: &str) -> io::Result<()> {
    match target.write_all(text.as_bytes()).and_then(|()| target.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// A count of an option.
pub fn count(text: &str) -> std::result::Result<u64, String> {
    text.parse().map_err(|_| format!("a whole number from 0 to {} is expected", u64::MAX))
}

/// Work that is done sooner than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(2);

/// A progress bar on a terminal, once the work has taken two seconds, and the times of its phases.
pub struct Meter {
    bar: ProgressBar,
    started: Instant,
    phases: Mutex<Phases>,
}

#[derive(Default)]
struct Phases {
    shown: bool,
    begun: Vec<(&'static str, Instant)>,
}

impl Meter {
    pub fn new() -> Meter {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{msg:22} {wide_bar} {percent:>3} % {eta:>4}") {
            bar.set_style(style);
        }
        Meter { bar, started: Instant::now(), phases: Mutex::default() }
    }

    /// Takes the bar away and tells the seconds of each phase.
    pub fn finish(&self) -> String {
        self.bar.finish_and_clear();
        let phases = self.phases.lock().unwrap_or_else(PoisonError::into_inner);
        let ends = phases.begun.iter().skip(1).map(|(_, start)| *start).chain([Instant::now()]);
        let lines = phases.begun.iter().zip(ends).map(|((name, start), end)| (*name, end.duration_since(*start)));
        lines
            .chain([("all", self.started.elapsed())])
            .map(|(name, time)| format!("{:8.3} s {name}\n", time.as_secs_f64()))
            .collect()
    }

    /// Says something in the middle of the work: the bar goes for it and comes again below.
    pub fn aside<T>(&self, say: impl FnOnce() -> T) -> T {
        self.bar.suspend(say)
    }

    fn show_if_late(&self, phases: &mut Phases) {
        if !phases.shown && self.started.elapsed() >= PATIENCE {
            phases.shown = true;
            // Draws nothing where stderr is no terminal.
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }
}

impl Progress for Meter {
    fn phase(&self, name: &'static str, total: u64) {
        let mut phases = self.phases.lock().unwrap_or_else(PoisonError::into_inner);
        phases.begun.push((name, Instant::now()));
        self.show_if_late(&mut phases);
        // Nothing advances in a phase of unknown length: the bar draws itself.
        if total == 0 {
            phases.shown = true;
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.bar.enable_steady_tick(PATIENCE);
        } else {
            self.bar.disable_steady_tick();
        }
        self.bar.set_length(total);
        self.bar.set_position(0);
        self.bar.set_message(name);
    }

    fn advance(&self, done: u64) {
        // Whoever does not get the lock leaves the showing to the one who has it.
        if let Ok(mut phases) = self.phases.try_lock() {
            self.show_if_late(&mut phases);
        }
        self.bar.set_position(done);
    }
}
