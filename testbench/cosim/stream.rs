// SPDX-License-Identifier: MIT OR Apache-2.0
//! A design with one input and one output stream, compiled by Verilator together with its driver.
//!
//! Through the [pipe of cycles](super::verilator) a driver that waits for `in_ready` asks once a cycle. Where all that is
//! played is known beforehand, the driver can stand beside the design instead: beats go in, beats come out, and only these
//! travel. The cycles are those of the same driver on this side.

use super::verilator::{Verilator, receive_all, send};
use super::{CosimError, Cycles, Design, Direction, Stalls, io_error, program};
use std::io::Read;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::thread;

const DRIVER: &str = include_str!("stream.cpp");

/// Cycles without a handshake after which a design hangs: more than the steps of a base triangle of which nothing is seen.
const PATIENCE: u64 = 1 << 22;

/// A design that was compiled with its driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream {
    design: Design,
    executable: PathBuf,
    /// Words of the input stream's fields, one after the other, among those of a cycle.
    inputs: Vec<usize>,
    /// The same of the output stream.
    outputs: Vec<usize>,
}

/// Words of all ports of a direction but these.
fn fields(design: &Design, direction: Direction, others: [&str; 3]) -> Vec<usize> {
    let slots = design.slots(direction).filter(|(port, _)| !others.contains(&port.name.as_str()));
    slots.flat_map(|(port, slot)| slot.word..slot.word + port.words()).collect()
}

/// What a design has sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Streamed {
    /// A row for each output beat: the cycle it left in, counted from the reset, and its fields in port order.
    pub beats: Cycles,
    /// Cycles from the reset to the end, the cycles of waiting for more not among them.
    pub cycles: u64,
}

impl Streamed {
    /// The output beats: cycles, and fields.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u64, &[u64])> {
        self.beats.iter().map(|row| (row[0], &row[1..]))
    }
}

impl Stream {
    /// Builds a design with the ports `reset`, `in_valid`, `in_ready`, `out_valid` and `out_ready`, or finds it built.
    ///
    /// # Errors
    /// One of the ports is missing, or it cannot be built.
    pub fn build(design: &Design, verilator: &Verilator) -> Result<Self, CosimError> {
        let input = |name: &str| design.input(name).map(|slot| slot.word.to_string());
        let output = |name: &str| design.output(name).map(|slot| slot.word.to_string());
        let driver = DRIVER
            .replace("@RESET@", &input("reset")?)
            .replace("@IN_VALID@", &input("in_valid")?)
            .replace("@OUT_READY@", &input("out_ready")?)
            .replace("@IN_READY@", &output("in_ready")?)
            .replace("@OUT_VALID@", &output("out_valid")?);
        let (executable, _) = verilator.built(design, &driver)?;
        let inputs = fields(design, Direction::Input, ["reset", "in_valid", "out_ready"]);
        let outputs = fields(design, Direction::Output, ["in_ready", "out_valid", ""]);
        Ok(Self { design: design.clone(), executable, inputs, outputs })
    }

    /// Beats of the input stream, their fields in port order, as [`run`](Self::run) takes them.
    pub fn rows<'a>(&self, beats: impl Iterator<Item = &'a [u64]>) -> Cycles {
        let mut rows = Cycles::new(self.design.input_words());
        for beat in beats {
            rows.push_with(|row| self.inputs.iter().zip(beat).for_each(|(at, word)| row[*at] = *word));
        }
        rows
    }

    /// The design.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// Plays beats, a row of input words for each, from the reset on until nothing has come for `drain` cycles behind the
    /// last one, which is more than a stall takes. `reset`, `in_valid` and `out_ready` in them do not matter.
    ///
    /// # Errors
    /// A beat is not taken, or the simulator fails.
    pub fn run(&self, beats: &Cycles, drain: u64, stalls: Stalls) -> Result<Streamed, CosimError> {
        self.design.check_width(beats.width())?;
        let top = &self.design.top;
        let messages = tempfile::tempfile().map_err(io_error("making a temporary file"))?;
        let copy = messages.try_clone().map_err(io_error("sharing a temporary file"))?;
        let mut command = Command::new(&self.executable);
        let Stalls { percent, seed } = stalls;
        let limits = [PATIENCE, drain, percent.into(), seed.into()];
        command.args(limits.map(|limit| limit.to_string())).current_dir(self.design.folder()?);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(copy);
        let mut child = command.spawn().map_err(io_error(format!("starting the simulator of `{top}`")))?;
        let (Some(mut stdin), Some(mut stdout)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(CosimError::Answer { what: top.clone(), reason: "it has no pipes".into() });
        };
        // Both pipes would be full one day, and both processes wait: so one thread writes while this one reads.
        let received = thread::scope(|scope| {
            // A design that gives up reads no more; what it says is told below.
            scope.spawn(move || {
                let _ = send(&mut stdin, beats.words());
            });
            receive_all(&mut stdout as &mut dyn Read)
        });
        let waiting = || io_error(format!("waiting for the simulator of `{top}`"));
        let words = received.map_err(waiting())?;
        let status = child.wait().map_err(waiting())?;
        let width = 1 + self.design.output_words();
        let last = words.len().checked_sub(width).filter(|_| words.len().is_multiple_of(width));
        let last = last.filter(|at| words[*at] == u64::MAX);
        let cycles = last.map_or(0, |at| words[at + 1]);
        match (status.success(), last) {
            (true, Some(at)) => {
                let mut beats = Cycles::new(1 + self.outputs.len());
                for row in words[..at].chunks_exact(width) {
                    beats.push_with(|beat| {
                        beat[0] = row[0];
                        beat[1..].iter_mut().zip(&self.outputs).for_each(|(to, at)| *to = row[1 + at]);
                    });
                }
                Ok(Streamed { beats, cycles: cycles.saturating_sub(drain) })
            }
            _ => {
                let excerpt = program::excerpt(&program::content(&mut { messages }));
                Err(CosimError::Ended { top: top.clone(), cycles, status: program::describe(status), excerpt })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::binding::{Binding, Expected};
    use crate::check::emitted;
    use crate::cosim::tools;
    use crate::scoreboard::{Pattern, Scoreboard, Until};
    use crate::strip_unit::StripUnitBinding;
    use crate::vertex_transform::VertexTransformBinding;
    use relief_hdl::widths::small;

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    /// One block that sends nothing for most beats, and one that takes 65 cycles for a beat: the same beats in the same
    /// cycles as the block in Rust, and none lost.
    #[test]
    fn stream_sends_what_the_block_sends_and_takes_its_cycles() -> Outcome {
        if !tools::require_all(&["verilator", "g++"], "streams through Verilator")? {
            return Ok(());
        }
        for (block, count) in [(&StripUnitBinding as &dyn Binding, 20_000), (&VertexTransformBinding, 500)] {
            let set = &small::SET;
            // Holds the sources.
            let emitted = emitted(block, set, None)?;
            let stream = Stream::build(&emitted.design, &Verilator::new())?;
            let beats: Vec<_> = block.random(set, 5).take(count).collect();
            let streamed = stream.run(&stream.rows(beats.iter().map(Vec::as_slice)), 300, Stalls::default())?;
            let (mut model, mut expected) = (block.model(set), Vec::new());
            beats.iter().for_each(|beat| model.accept(beat, &mut expected));
            assert!(expected.len() > count / 4 && streamed.beats.len() == expected.len(), "{}", block.name());
            for ((_, words), Expected { words: wanted, mask }) in streamed.iter().zip(&expected) {
                assert!(words.iter().zip(wanted).zip(mask).all(|((got, want), mask)| (got ^ want) & mask == 0));
            }
            let mut board = Scoreboard::new(block, set, Box::new(beats.into_iter()), Pattern::NONE);
            let mut sent = Vec::new();
            let layout = board.layout().clone();
            let played = board.run(Until::Exhausted, &mut |device, _, outputs| {
                if outputs[layout.out_valid] == 1 {
                    sent.push(device.cycle());
                }
                Ok(())
            });
            played.map_err(|mismatch| mismatch.to_string())?;
            assert!(streamed.iter().map(|(cycle, _)| cycle).eq(sent), "{}: other cycles", block.name());
            // Held up, it sends the same later.
            let rows = stream.rows(block.random(set, 5).take(count).collect::<Vec<_>>().iter().map(Vec::as_slice));
            let held = stream.run(&rows, 300, Stalls { percent: 40, seed: 3 })?;
            assert!(held.iter().map(|(_, words)| words).eq(streamed.iter().map(|(_, words)| words)));
            assert!(held.cycles > streamed.cycles, "{}: {} cycles", block.name(), held.cycles);
        }
        Ok(())
    }
}
