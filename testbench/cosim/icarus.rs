// SPDX-License-Identifier: MIT OR Apache-2.0
//! A design interpreted by Icarus Verilog: slow, some 10,000 cycles/s, but it knows bits that nobody has set.
//!
//! A generated test bench reads the inputs of each cycle from a file in hexadecimal and writes the outputs to another
//! in binary, so that an `x` or `z` is kept bit by bit.

use super::{CosimError, Cycles, Design, Direction, Response, Simulator, io_error, program, tools};
use std::{fmt::Write, fs, process::Command, time::Duration};
use tempfile::TempDir;

/// How designs are built.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Icarus {
    limit: Duration,
}

impl Default for Icarus {
    fn default() -> Self {
        Self { limit: Duration::from_secs(600) }
    }
}

impl Icarus {
    /// Ten minutes for a build and for a run.
    pub fn new() -> Self {
        Self::default()
    }

    /// How long a build and a run may take.
    pub fn limit(mut self, limit: Duration) -> Self {
        self.limit = limit;
        self
    }

    /// Builds the design. That takes a fraction of a second, so nothing is kept for later.
    pub fn build(&self, design: &Design) -> Result<IcarusModel, CosimError> {
        design.check()?;
        tools::find("iverilog")?;
        tools::find("vvp")?;
        let folder = tempfile::tempdir().map_err(io_error("making a temporary folder"))?;
        let bench = folder.path().join("bench.v");
        fs::write(&bench, test_bench(design)).map_err(io_error("writing the test bench"))?;
        let what = format!("building `{}` with Icarus", design.top);
        let mut build = Command::new("iverilog");
        build.args(["-g2012", "-s", BENCH, "-o"]).arg(folder.path().join("bench.vvp")).arg(&bench);
        build.args(design.absolute_sources()?).current_dir(design.folder()?);
        program::run(&mut build, &what, self.limit)?.expect_success(&what)?;
        Ok(IcarusModel { design: design.clone(), folder, limit: self.limit })
    }
}

const BENCH: &str = "relief_cosim_bench";

/// The test bench for the ports of a design. Its own names cannot meet those of the ports, which it prefixes.
fn test_bench(design: &Design) -> String {
    let (mut declare, mut connect, mut drive, mut formats, mut sampled) =
        (String::new(), Vec::new(), String::new(), Vec::new(), String::new());
    if let Some(clock) = &design.clock {
        connect.push(format!(".{clock}(clock)"));
    }
    for (port, slot) in design.slots(Direction::Input) {
        let (name, bits, from) = (&port.name, port.bits, slot.word * 64);
        let _ = writeln!(declare, "  reg [{}:0] in__{name} = 0;", bits - 1);
        let _ = writeln!(drive, "      in__{name} = frame[{from} +: {bits}];");
        connect.push(format!(".{name}(in__{name})"));
    }
    for (port, _) in design.slots(Direction::Output) {
        let (name, bits) = (&port.name, port.bits);
        let _ = writeln!(declare, "  wire [{}:0] out__{name};", bits - 1);
        formats.push("%b");
        let _ = write!(sampled, ", out__{name}");
        connect.push(format!(".{name}(out__{name})"));
    }
    let (top, frame, connect, formats) =
        (&design.top, design.input_words() * 64 - 1, connect.join(", "), formats.join(" "));
    format!(
        "\
`timescale 1ns/1ns
module {BENCH};
  reg clock = 0;
  reg [{frame}:0] frame = 0;
  reg [16383:0] path;
  integer stimulus, response, cycles, cycle, got;
{declare}
  {top} dut ({connect});

  initial begin
    got = $value$plusargs(\"stimulus=%s\", path);
    stimulus = $fopen(path, \"r\");
    got = $value$plusargs(\"response=%s\", path);
    response = $fopen(path, \"w\");
    got = $value$plusargs(\"cycles=%d\", cycles);
    for (cycle = 0; cycle < cycles; cycle = cycle + 1) begin
      got = $fscanf(stimulus, \"%h\", frame);
      clock = 0;
{drive}      #5;
      $fwrite(response, \"{formats}\\n\"{sampled});
      clock = 1;
      #5;
    end
    $fclose(response);
    $finish(0);
  end
endmodule
"
    )
}

/// A design that Icarus has compiled.
#[derive(Debug)]
pub struct IcarusModel {
    design: Design,
    folder: TempDir,
    limit: Duration,
}

impl Simulator for IcarusModel {
    fn name(&self) -> &'static str {
        "icarus"
    }

    fn design(&self) -> &Design {
        &self.design
    }

    fn run(&self, stimulus: &Cycles) -> Result<Response, CosimError> {
        self.design.check_width(stimulus.width())?;
        // A folder for each run, as several may go on at once.
        let folder = tempfile::tempdir_in(&self.folder).map_err(io_error("making a temporary folder"))?;
        let (input, output) = (folder.path().join("stimulus.hex"), folder.path().join("response.bin"));
        let mut text = String::with_capacity(stimulus.words().len() * 16 + stimulus.len());
        for cycle in stimulus.iter() {
            cycle.iter().rev().try_for_each(|word| write!(text, "{word:016x}")).ok();
            text.push('\n');
        }
        fs::write(&input, text).map_err(io_error("writing the stimulus"))?;
        let what = format!("running `{}` in Icarus", self.design.top);
        let mut run = Command::new("vvp");
        // `-n`: a `$stop` ends the run instead of waiting for somebody to type.
        run.arg("-n").arg(self.folder.path().join("bench.vvp"));
        run.arg(format!("+stimulus={}", input.display())).arg(format!("+response={}", output.display()));
        run.arg(format!("+cycles={}", stimulus.len())).current_dir(self.design.folder()?);
        let finished = program::run(&mut run, &what, self.limit)?.expect_success(&what)?;
        let answer = fs::read_to_string(&output).map_err(io_error("reading the response"))?;
        let response = parse(&self.design, &answer).map_err(|reason| CosimError::Answer { what, reason })?;
        if response.values.len() != stimulus.len() {
            return Err(CosimError::Ended {
                top: self.design.top.clone(),
                cycles: response.values.len() as u64,
                status: program::describe(finished.status),
                excerpt: finished.excerpt(),
            });
        }
        Ok(response)
    }
}

/// Lines of vectors, one a cycle, the ports apart by blanks and the highest bit first.
fn parse(design: &Design, text: &str) -> Result<Response, String> {
    let slots: Vec<_> = design.slots(Direction::Output).collect();
    let mut values = Cycles::new(design.output_words());
    let mut unknown = Cycles::new(design.output_words());
    let mut masks = vec![0; design.output_words()];
    for (number, line) in text.lines().enumerate() {
        let mut vectors = line.split_ascii_whitespace();
        let mut odd = None;
        masks.fill(0);
        values.push_with(|words| {
            for (port, slot) in &slots {
                let vector = vectors.next().unwrap_or("");
                if vector.len() != port.bits {
                    odd = Some(format!("line {} has {} bits for `{}`", number + 1, vector.len(), port.name));
                    return;
                }
                for (bit, letter) in vector.bytes().rev().enumerate() {
                    let (word, at) = (slot.word + bit / 64, bit % 64);
                    match letter {
                        b'0' => (),
                        b'1' => words[word] |= 1 << at,
                        _ => masks[word] |= 1 << at,
                    }
                }
            }
        });
        unknown.push(&masks);
        if let Some(odd) = odd {
            return Err(odd);
        }
    }
    Ok(Response { values, unknown: Some(unknown) })
}
