// SPDX-License-Identifier: MIT OR Apache-2.0
//! `relief emit`: the Verilog of a block, with golden vectors and a test bench that need no Rust.

use std::fmt::Write;
use std::fs;
use std::io::stdout;
use std::path::{Path, PathBuf};

use relief_hdl::widths::WidthSet;
use relief_models::mesh::Progress;
use relief_testbench::binding::{Binding, Expected};
use relief_testbench::check::emission;
use relief_testbench::device::Layout;
use relief_testbench::output::OutputFolder;
use relief_testbench::scoreboard::PATIENCE;

use super::{Meter, Outcome, Result, count, select, write_all};

mod axi_stream;
mod fusesoc;

/// Write blocks as SystemVerilog, with golden vectors and a self-checking test bench
///
/// Each block gets a folder: its modules, `filelist.f`, the memories, `in.hex` and `out.hex`, `relief_<block>_tb.sv`, whose
/// head says how to run it with Icarus and Verilator, and `relief_<block>.core` for FuseSoC. The same command writes the
/// same bytes.
#[derive(clap::Args)]
pub struct Arguments {
    /// The blocks; all of them when none is named
    #[arg(value_name = "BLOCK")]
    blocks: Vec<String>,
    /// The folder in which the folders of the blocks are made
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Width set
    #[arg(long, value_name = "NAME")]
    param: Option<String>,
    /// Golden vectors of each block
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = vectors, allow_negative_numbers = true)]
    vectors: u64,
    /// Seed of the golden vectors
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = count, allow_negative_numbers = true)]
    seed: u64,
    /// Also write `relief_<block>_axis.sv`, the block under the port names of AXI4-Stream, and `filelist_axis.f`
    #[arg(long)]
    axi_stream: bool,
}

/// Emits.
pub fn run(arguments: &Arguments) -> Result {
    let blocks = select::blocks(&arguments.blocks)?;
    let set = select::width_set(arguments.param.as_deref())?;
    let blocks = select::offered(&blocks, &arguments.blocks, set)?;
    fs::create_dir_all(&arguments.out)
        .map_err(|error| format!("{}: the folder cannot be made: {error}", arguments.out.display()))?;
    let meter = Meter::new();
    meter.phase("emitting", blocks.len() as u64);
    // Every folder is filled before the first one gets its name.
    let (mut folders, mut text) = (Vec::new(), String::new());
    for (block, done) in blocks.into_iter().zip(1..) {
        let place = arguments.out.join(block.name());
        let folder = OutputFolder::open(&place)?;
        let vectors = Vectors::new(block, set, arguments.vectors, arguments.seed);
        let emission = emission(block, set)?;
        emission.write(folder.path())?;
        let top = &emission.top;
        let list = fs::read_to_string(folder.path().join("filelist.f"))?;
        let mut files = vec![
            ("in.hex".to_owned(), vectors.input_text()),
            ("out.hex".to_owned(), vectors.output_text()),
            (format!("{top}_tb.sv"), bench_text(set, top, &vectors, arguments)),
            (format!("{top}.core"), fusesoc::core(block, set, &list, &roms(folder.path())?, arguments.axi_stream)),
        ];
        if arguments.axi_stream {
            let wrapper = axi_stream::wrapper(top, &vectors.in_fields, &vectors.out_fields);
            files.push((format!("{top}_axis.sv"), wrapper));
            files.push(("filelist_axis.f".to_owned(), format!("{list}{top}_axis.sv\n")));
        }
        for (name, text) in &files {
            let path = folder.path().join(name);
            fs::write(&path, text).map_err(|error| format!("{}: cannot be written: {error}", path.display()))?;
        }
        folder.files()?;
        folders.push(folder);
        let (modules, beats) = (emission.modules.len(), vectors.outputs.len());
        writeln!(
            text,
            "{}: {modules} modules, {} vectors, {beats} golden beats, width set {}",
            place.display(),
            vectors.inputs.len(),
            set.name
        )?;
        meter.advance(done);
    }
    meter.finish();
    // Modules of another width set would stand beside those of this one.
    let stale = |name: &str| {
        name == "filelist_axis.f" || name.starts_with("relief_") && (name.ends_with(".sv") || name.ends_with(".hex"))
    };
    folders.into_iter().try_for_each(|folder| folder.commit(stale))?;
    write_all(stdout(), &text)?;
    Ok(Outcome::Agreed)
}

/// The contents of the memories that a block reads only.
fn roms(folder: &Path) -> std::io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if name.ends_with(".hex") {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}

fn vectors(text: &str) -> std::result::Result<u64, String> {
    let most = 100_000;
    let number = text.parse().ok().filter(|number| (1..=most).contains(number));
    number.ok_or_else(|| format!("a whole number from 1 to {most} is expected"))
}

/// Beats as the bits of one vector: the fields in port order, the first one lowest.
struct Vectors {
    inputs: Vec<Vec<u64>>,
    outputs: Vec<Expected>,
    in_fields: Vec<(&'static str, usize)>,
    out_fields: Vec<(&'static str, usize)>,
}

impl Vectors {
    fn new(block: &dyn Binding, set: &WidthSet, count: u64, seed: u64) -> Self {
        let layout = Layout::of(block.device(set).as_ref());
        let inputs: Vec<Vec<u64>> = block.random(set, seed).take(count as usize).collect();
        let (mut model, mut outputs) = (block.model(set), Vec::new());
        inputs.iter().for_each(|beat| model.accept(beat, &mut outputs));
        Self {
            inputs,
            outputs,
            in_fields: layout.in_fields().map(|(port, _)| (port.name, port.bits)).collect(),
            out_fields: layout.out_fields().map(|(port, _)| (port.name, port.bits)).collect(),
        }
    }

    fn input_text(&self) -> String {
        let lines = self.inputs.iter().map(|beat| format!("{}\n", hex(beat, &self.in_fields)));
        lines.collect()
    }

    /// `mask_value`: ones of the mask are the bits that count.
    fn output_text(&self) -> String {
        let line = |beat: &Expected| {
            let kept: Vec<u64> = beat.words.iter().zip(&beat.mask).map(|(word, mask)| word & mask).collect();
            format!("{}_{}\n", hex(&beat.mask, &self.out_fields), hex(&kept, &self.out_fields))
        };
        self.outputs.iter().map(line).collect()
    }
}

fn width(fields: &[(&str, usize)]) -> usize {
    fields.iter().map(|(_, bits)| bits).sum()
}

/// Fields, each from whole words, side by side in hexadecimal; the first field lowest.
fn hex(words: &[u64], fields: &[(&str, usize)]) -> String {
    let mut nibbles = vec![0u8; width(fields).div_ceil(4)];
    let (mut to, mut word) = (0, 0);
    for (_, bits) in fields {
        for bit in 0..*bits {
            let value = words[word + bit / 64] >> (bit % 64) & 1;
            nibbles[to / 4] |= (value as u8) << (to % 4);
            to += 1;
        }
        word += bits.div_ceil(64);
    }
    nibbles.iter().rev().map(|nibble| char::from_digit(u32::from(*nibble), 16).unwrap_or('0')).collect()
}

const BENCH: &str = r#"// SPDX-License-Identifier: MIT OR Apache-2.0
// Plays in.hex into @TOP@ and compares what comes with out.hex, under random idle cycles and backpressure.
// Written by `relief emit` (width set @SET@, seed @SEED@); needs no Rust. In this folder:
//
//   $ iverilog -g2012 -o tb.vvp -f filelist.f @TOP@_tb.sv && vvp -n tb.vvp
//   $ verilator --binary --timing -Wno-fatal --top-module @TOP@_tb -f filelist.f @TOP@_tb.sv && obj_dir/V@TOP@_tb
//
// Options of both runs: +idle=P +stall=P (percent of cycles), +seed=N (of both). Ends with PASS or FAIL and the counts;
// after FAIL the exit code is not 0.
//
// in.hex:  a beat a line, the fields side by side, the first one lowest: @IN_LIST@
// out.hex: mask_value, the same way; ones of the mask are the bits that count: @OUT_LIST@
`timescale 1ns/1ns
module @TOP@_tb;
  localparam IN_BEATS = @IN_BEATS@;
  localparam OUT_BEATS = @OUT_BEATS@;
  localparam IN_BITS = @IN_BITS@;
  localparam OUT_BITS = @OUT_BITS@;
  localparam OUT_DIGITS = @OUT_DIGITS@; // bits of a whole number of digits
  localparam PATIENCE = @PATIENCE@; // cycles without a handshake after which the block hangs
  localparam DRAIN = 100; // cycles after the last beat in which no other may come

  reg clock = 0;
  reg reset = 1;
  reg in_valid = 0;
  reg out_ready = 0;
  wire in_ready;
  wire out_valid;
  reg [IN_BITS-1:0] in_beat = {IN_BITS{1'bx}};
  wire [OUT_BITS-1:0] out_beat;
  reg [IN_BITS-1:0] in_beats [0:IN_BEATS-1];
  reg [2*OUT_DIGITS-1:0] out_beats [0:(OUT_BEATS > 0 ? OUT_BEATS - 1 : 0)];
  reg [2*OUT_DIGITS-1:0] line;
  reg [OUT_BITS-1:0] mask;
  reg [OUT_BITS-1:0] value;
  reg [31:0] seed;
  reg [31:0] drawn;
  reg taken;
  integer idle, stall, accepted, checked, cycles, silent, drain, failed;

@DUT@

  initial begin
    $readmemh("in.hex", in_beats);
    $readmemh("out.hex", out_beats);
    if (!$value$plusargs("idle=%d", idle)) idle = 30;
    if (!$value$plusargs("stall=%d", stall)) stall = 40;
    if (!$value$plusargs("seed=%d", seed)) seed = @SEED32@;
    drawn = $urandom(seed);
    accepted = 0;
    checked = 0;
    cycles = 0;
    silent = 0;
    drain = 0;
    failed = 0;
    // One cycle is enough, from whatever the registers hold: unknown bits, in Icarus.
    #5 clock = 1;
    #5 clock = 0;
    reset = 0;
    // Inputs change while the clock is low; outputs are sampled just before it rises.
    while (failed == 0 && drain < DRAIN) begin
      drawn = $urandom;
      // A beat once offered stays until it is taken.
      if (!in_valid && accepted < IN_BEATS && drawn % 100 >= idle) begin
        in_valid = 1;
        in_beat = in_beats[accepted];
      end
      drawn = $urandom;
      out_ready = drawn % 100 >= stall;
      #5;
      cycles = cycles + 1;
      silent = silent + 1;
      if (out_valid === 1'b1) begin
        silent = 0;
        if (checked >= OUT_BEATS) begin
          failed = 1;
          $display("beat %0d, cycle %0d: a beat too many", checked, cycles - 1);
        end else begin
          line = out_beats[checked];
          mask = line[OUT_DIGITS +: OUT_BITS];
          value = line[0 +: OUT_BITS];
          // So is an unknown bit, even one that does not count.
          if ((out_beat & mask) !== value || ^out_beat === 1'bx) begin
            failed = 1;
            $display("beat %0d, cycle %0d:\n  expected %h\n  got      %h\n  mask     %h", checked, cycles - 1, value,
                     out_beat, mask);
          end
        end
      end else if (out_valid !== 1'b0) begin
        failed = 1;
        $display("cycle %0d: out_valid is unknown", cycles - 1);
      end
      // It may follow from the payload, which means nothing before there is a beat.
      if (in_valid && in_ready !== 1'b0 && in_ready !== 1'b1) begin
        failed = 1;
        $display("cycle %0d: in_ready is unknown", cycles - 1);
      end
      if (out_valid && out_ready) checked = checked + 1;
      if (accepted == IN_BEATS && checked == OUT_BEATS) drain = drain + 1;
      else if (silent > PATIENCE) begin
        failed = 1;
        $display("cycle %0d: no handshake for %0d cycles", cycles - 1, PATIENCE);
      end
      taken = in_valid && in_ready === 1'b1;
      clock = 1;
      #5;
      clock = 0;
      if (taken) begin
        silent = 0;
        accepted = accepted + 1;
        in_valid = 0;
        // Whoever looks at it now is found out.
        in_beat = {IN_BITS{1'bx}};
      end
    end
    if (failed == 0) begin
      $display("PASS: %0d of %0d beats in, %0d of %0d beats out, %0d cycles", accepted, IN_BEATS, checked, OUT_BEATS,
               cycles);
      $finish;
    end else begin
      $display("FAIL: %0d of %0d beats in, %0d of %0d beats out, %0d cycles", accepted, IN_BEATS, checked, OUT_BEATS,
               cycles);
      $fatal(1);
    end
  end
endmodule
"#;

/// The test bench in plain Verilog but for `$urandom` and `$fatal`.
fn bench_text(set: &WidthSet, top: &str, vectors: &Vectors, arguments: &Arguments) -> String {
    let seed = arguments.seed;
    let list = |fields: &[(&str, usize)]| {
        fields.iter().map(|(name, bits)| format!("{name}:{bits}")).collect::<Vec<_>>().join(" ")
    };
    let mut connect = String::from("    .clock(clock),\n    .reset(reset)");
    for name in ["in_valid", "in_ready", "out_valid", "out_ready"] {
        let _ = write!(connect, ",\n    .{name}({name})");
    }
    for (fields, wire) in [(&vectors.in_fields, "in_beat"), (&vectors.out_fields, "out_beat")] {
        let mut from = 0;
        for (name, bits) in fields {
            let _ = write!(connect, ",\n    .{name}({wire}[{from} +: {bits}])");
            from += bits;
        }
    }
    let mut dut = format!("  {top} dut (\n{connect}\n  );");
    if arguments.axi_stream {
        let axis = axi_stream::instance(top, &vectors.in_fields, &vectors.out_fields);
        dut = format!(
            "`ifdef RELIEF_AXIS // the block behind {top}_axis.sv, with filelist_axis.f\n{axis}\n`else\n{dut}\n`endif"
        );
    }
    let out_bits = width(&vectors.out_fields);
    [
        ("TOP", top.to_string()),
        ("SET", set.name.to_string()),
        ("SEED32", (seed & 0x7fff_ffff).to_string()),
        ("SEED", seed.to_string()),
        ("IN_LIST", list(&vectors.in_fields)),
        ("OUT_LIST", list(&vectors.out_fields)),
        ("IN_BEATS", vectors.inputs.len().to_string()),
        ("OUT_BEATS", vectors.outputs.len().to_string()),
        ("IN_BITS", width(&vectors.in_fields).to_string()),
        ("OUT_BITS", out_bits.to_string()),
        ("OUT_DIGITS", (out_bits.div_ceil(4) * 4).to_string()),
        ("PATIENCE", PATIENCE.to_string()),
        ("DUT", dut),
    ]
    .into_iter()
    .fold(BENCH.to_string(), |text, (name, value)| text.replace(&format!("@{name}@"), &value))
}
