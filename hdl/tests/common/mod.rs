// SPDX-License-Identifier: MIT OR Apache-2.0
//! Runs a block in Rust, records what its ports did, and replays that in Icarus and Verilator on the emitted Verilog.

#![allow(dead_code)] // Each test uses its part of this module.

use relief_hdl::prelude::*;
use relief_hdl::verilog::{Emission, emit};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Deterministic random numbers (splitmix64).
pub struct Rng(pub u64);

impl Rng {
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.word() % n as u64) as usize
    }
    /// A word that often lies at the ends of some format: 0, 1, -1, the minimum or the maximum of `bits` bits.
    fn wide(&mut self, bits: usize) -> i128 {
        let random = (i128::from(self.word() as i64) << 64) | i128::from(self.word());
        let minimum = -1i128 << (bits - 1);
        match self.below(12) {
            0 => 0,
            1 => -1,
            2 => minimum,
            3 => !minimum,
            4 => 1,
            5 => minimum + 1,
            _ => random,
        }
    }
}

/// A type that can be drawn at random, with the ends of its range among the draws.
pub trait Random: Sized {
    fn random(rng: &mut Rng) -> Self;
}

macro_rules! random {
    ($($name:ident)*) => {$(
        impl<const N: usize> Random for $name<N> {
            fn random(rng: &mut Rng) -> Self {
                Self::from_wide(rng.wide(N))
            }
        }
    )*};
}
random!(S U WideS WideU);

impl Random for bool {
    fn random(rng: &mut Rng) -> Self {
        rng.below(2) == 1
    }
}

impl<const L: usize, const W: usize> Random for Lanes<L, W> {
    fn random(rng: &mut Rng) -> Self {
        Lanes::new(std::array::from_fn(|_| rng.wide(W) as i64))
    }
}

/// A block that can fill its own inputs.
pub trait Dut: Block {
    fn randomize(&mut self, rng: &mut Rng);
}

/// Passes over the block until nothing changes any more.
pub fn settle(block: &mut dyn Block) {
    for _ in 0..100 {
        block.update_all();
        if !block.has_changed() {
            return;
        }
    }
    panic!("the block does not settle");
}

/// Ports of the outermost scope and their bits, most significant first.
#[derive(Default)]
struct Ports {
    depth: usize,
    list: Vec<(String, bool, String)>,
}

fn bits(value: &VCDValue, descriptor: &TypeDescriptor) -> String {
    let bit = |v: &vcd::Value| if *v == vcd::Value::V1 { '1' } else { '0' };
    match (value, &descriptor.kind) {
        (VCDValue::Single(v), _) => bit(v).to_string(),
        (VCDValue::Vector(v), _) => v.iter().map(bit).collect(),
        (VCDValue::Composite(fields), TypeKind::Composite(kinds)) => {
            fields.iter().zip(kinds).rev().map(|(f, k)| bits(f, &k.kind)).collect()
        }
        (VCDValue::String(variant), TypeKind::Enum(variants)) => {
            let code = variants.iter().position(|v| v.ends_with(&format!("::{variant}"))).unwrap();
            let width = (usize::BITS - (variants.len() - 1).leading_zeros()).max(1) as usize;
            format!("{code:0width$b}")
        }
        _ => panic!("no bits of {value:?}"),
    }
}

impl Probe for Ports {
    fn visit_start_scope(&mut self, _name: &str, _node: &dyn Block) {
        self.depth += 1;
    }
    fn visit_end_scope(&mut self, _name: &str, _node: &dyn Block) {
        self.depth -= 1;
    }
    fn visit_atom(&mut self, name: &str, signal: &dyn Atom) {
        let input = match signal.kind() {
            AtomKind::InputParameter => true,
            AtomKind::OutputParameter => false,
            _ => return,
        };
        if self.depth == 1 {
            let text = bits(&signal.vcd(), &signal.descriptor());
            let clock = signal.descriptor().name == "ClockReset";
            // The first field is the clock itself, which the bench drives.
            let port =
                if clock { ("reset".into(), true, text[..1].into()) } else { (name.replace('$', "_"), input, text) };
            self.list.push(port);
        }
    }
}

/// One block and what its ports did.
pub struct Bench {
    pub emission: Emission,
    ports: Vec<(String, bool, usize)>,
    rows: Vec<(String, String)>,
    /// Rows at the start that are replayed and not compared, until everything without a reset has been written.
    pub skip: usize,
}

impl Bench {
    pub fn new(block: &dyn Block) -> Self {
        let emission = emit(block).unwrap_or_else(|e| panic!("{e}"));
        let mut ports = Ports::default();
        block.accept("top", &mut ports);
        let ports = ports.list.into_iter().map(|(name, input, bits)| (name, input, bits.len())).collect();
        Self { emission, ports, rows: vec![], skip: 0 }
    }

    /// Settles the block and records one row.
    pub fn record(&mut self, block: &mut dyn Block) {
        settle(block);
        let mut ports = Ports::default();
        block.accept("top", &mut ports);
        let side = |input| ports.list.iter().filter(|p| p.1 == input).map(|p| p.2.as_str()).collect();
        self.rows.push((side(true), side(false)));
    }

    fn width(&self, input: bool) -> usize {
        self.ports.iter().filter(|p| p.1 == input).map(|p| p.2).sum()
    }

    /// The self-checking module `bench_<k>`.
    fn text(&self, k: usize) -> String {
        let mut pins = String::new();
        let clocked = self.emission.top_module().ports.iter().any(|p| p.name == "clock");
        if clocked {
            pins += ".clock(clk), ";
        }
        let mut left = [self.width(false), self.width(true)];
        for (name, input, bits) in &self.ports {
            let left = &mut left[usize::from(*input)];
            *left -= bits;
            let vector = if *input { "in" } else { "out" };
            write!(pins, ".{name}({vector}[{left} +: {bits}]), ").unwrap();
        }
        let (i, o, n) = (self.width(true), self.width(false), self.rows.len());
        let (dut, pins, skip) = (&self.emission.top, pins.trim_end_matches(", "), self.skip);
        format!(
            "module bench_{k}(input wire clk);
    reg [{i}-1:0] stimulus [0:{n}-1];
    reg [{o}-1:0] expected [0:{n}-1];
    integer row = 0;
    integer errors = 0;
    initial begin
        $readmemh(\"bench_{k}_in.hex\", stimulus);
        $readmemh(\"bench_{k}_out.hex\", expected);
    end
    wire [{i}-1:0] in = stimulus[row];
    wire [{o}-1:0] out;
    {dut} dut({pins});
    always @(posedge clk) if (row < {n}) begin
        if (row >= {skip} && out !== expected[row]) begin
            errors <= errors + 1;
            if (errors < 3) $display(\"MISMATCH {k} %0d %b\", row, out);
        end
        if (row == {n} - 1) $display(\"DONE {k} %0d\", errors);
        row <= row + 1;
    end
endmodule
"
        )
    }

    /// What row `row` shows, port by port, where the outputs were `got`.
    fn explain(&self, row: usize, got: &str) -> String {
        let (mut out, mut i, mut o) = (String::new(), 0, 0);
        for (name, input, bits) in &self.ports {
            if *input {
                let value = &self.rows[row].0[i..i + bits];
                writeln!(out, "    {name} = {value}").unwrap();
                i += bits;
            } else {
                let (found, right) = (&got[o..o + bits], &self.rows[row].1[o..o + bits]);
                let mark = if found == right { "" } else { "   <-- differs" };
                writeln!(out, "    {name}: Rust {right}, Verilog {found}{mark}").unwrap();
                o += bits;
            }
        }
        out
    }
}

fn hexadecimal(bits: &str) -> String {
    let mut padded = "0".repeat((4 - bits.len() % 4) % 4) + bits;
    padded.push('0');
    let digit = |k: usize| u8::from_str_radix(&padded[4 * k..4 * k + 4], 2).unwrap();
    (0..padded.len() / 4).map(|k| format!("{:x}", digit(k))).collect()
}

/// Whether a tool is there. Without it a person's run skips, and a run with `CI=true` fails.
pub fn tool(name: &str, package: &str) -> bool {
    let found = std::env::var_os("PATH")
        .is_some_and(|path| std::env::split_paths(&path).any(|folder| folder.join(name).is_file()));
    if !found {
        assert!(
            std::env::var("CI").as_deref() != Ok("true"),
            "{name} is missing: install the Debian package {package}"
        );
        println!("SKIPPED {name}: install the Debian package {package}");
    }
    found
}

/// Runs a command in a folder; gives both outputs, and fails with them when the command fails.
pub fn run(folder: &Path, command: &str, arguments: &[&str]) -> String {
    let output = Command::new(command).args(arguments).current_dir(folder).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command} {arguments:?} in {}:\n{text}", folder.display());
    text
}

/// An empty folder for one test.
pub fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// Replays all benches in both simulators and fails on the first mismatch. Gives the number of rows compared.
pub fn replay(name: &str, benches: &[Bench]) -> usize {
    let folder = folder(name);
    let mut text = String::new();
    let mut list = vec![];
    for (k, bench) in benches.iter().enumerate() {
        assert!(!bench.rows.is_empty(), "bench {k} has no rows");
        bench.emission.write(&folder).unwrap();
        let files = bench.emission.modules.iter().map(|m| format!("{}.sv", m.name));
        list.extend(files.filter(|f| !list.contains(f)).collect::<Vec<_>>());
        let side = |f: fn(&(String, String)) -> &String| -> String {
            bench.rows.iter().map(|row| hexadecimal(f(row)) + "\n").collect()
        };
        std::fs::write(folder.join(format!("bench_{k}_in.hex")), side(|r| &r.0)).unwrap();
        std::fs::write(folder.join(format!("bench_{k}_out.hex")), side(|r| &r.1)).unwrap();
        text += &bench.text(k);
    }
    let instances: String = (0..benches.len()).map(|k| format!("    bench_{k} b{k}(clk);\n")).collect();
    let rows = benches.iter().map(|b| b.rows.len()).max().unwrap_or(0);
    text += &format!("module benches(input wire clk);\n{instances}endmodule\n");
    std::fs::write(folder.join("benches.sv"), text).unwrap();
    std::fs::write(folder.join("filelist.f"), list.join("\n") + "\n").unwrap();
    if tool("iverilog", "iverilog") {
        let clock = format!(
            "module icarus;\n    reg clk = 0;\n    benches all(clk);\n    initial begin\n        \
             repeat ({}) #5 clk = ~clk;\n        $finish;\n    end\nendmodule\n",
            2 * (rows + 2)
        );
        std::fs::write(folder.join("icarus.sv"), clock).unwrap();
        let arguments = ["-g2012", "-s", "icarus", "-o", "icarus.vvp", "-f", "filelist.f", "benches.sv", "icarus.sv"];
        run(&folder, "iverilog", &arguments);
        judge("Icarus", benches, &run(&folder, "vvp", &["-n", "icarus.vvp"]));
    }
    if tool("verilator", "verilator") {
        let main = format!(
            "#include \"Vbenches.h\"\nint main() {{\n    Vbenches top;\n    for (int k = 0; k < {}; ++k) {{\n        \
             top.clk = k & 1;\n        top.eval();\n    }}\n    top.final();\n    return 0;\n}}\n",
            2 * (rows + 2)
        );
        std::fs::write(folder.join("main.cpp"), main).unwrap();
        // The benches compare at 32 bits and drop carries; the emitted modules have a lint of their own.
        let arguments = [
            "--cc",
            "--exe",
            "--build",
            "-j",
            "2",
            "-Wno-fatal",
            "-Wno-lint",
            "-O1",
            "--x-assign",
            "0",
            "--output-split",
            "5000",
            "--Mdir",
            "obj",
            "--top-module",
            "benches",
            "-CFLAGS",
            // Verilator 5.006 multiplies signed words in C++, where overflow is undefined.
            "-fwrapv",
            "-MAKEFLAGS",
            "OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O1",
            "-f",
            "filelist.f",
            "benches.sv",
            "main.cpp",
        ];
        run(&folder, "verilator", &arguments);
        judge("Verilator", benches, &run(&folder, "./obj/Vbenches", &[]));
    }
    benches.iter().map(|b| b.rows.len() - b.skip).sum()
}

fn judge(simulator: &str, benches: &[Bench], output: &str) {
    let mut done = 0;
    for line in output.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            ["MISMATCH", bench, row, got] => {
                let (k, row): (usize, usize) = (bench.parse().unwrap(), row.parse().unwrap());
                let bench = &benches[k];
                panic!(
                    "{simulator}: {} row {row}:\n{}\n{}",
                    bench.emission.top,
                    bench.explain(row, got),
                    bench.emission.top_module().source
                );
            }
            ["DONE", _, "0"] => done += 1,
            _ => {}
        }
    }
    assert_eq!(done, benches.len(), "{simulator} did not finish every bench:\n{output}");
}

/// Lints the emitted modules as strictly as Verilator can, with some options more; any warning fails.
pub fn lint(name: &str, emission: &Emission, except: &[&str]) {
    if tool("verilator", "verilator") {
        let folder = folder(name);
        emission.write(&folder).unwrap();
        let arguments = [&["--lint-only", "-Wall", "-f", "filelist.f", "--top-module", &emission.top], except].concat();
        let text = run(&folder, "verilator", &arguments);
        assert!(!text.contains('%'), "{text}");
    }
}
