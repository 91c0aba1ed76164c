// SPDX-License-Identifier: MIT OR Apache-2.0
//! SystemVerilog of a block, or a sentence that says why there is none.
//!
//! ```
//! use relief_hdl::prelude::*;
//! use relief_hdl::verilog::emit;
//!
//! #[derive(LogicBlock, Default)]
//! struct Average {
//!     in_a: Input<S<8>>,
//!     in_b: Input<S<8>>,
//!     out_mean: Output<S<8>>,
//!     sum: Wire<S<9>>,
//! }
//! impl Logic for Average {
//!     #[hdl_gen]
//!     fn update(&mut self) {
//!         self.sum.next = bit_cast_to::<S<9>>(self.in_a.val()) + bit_cast_to::<S<9>>(self.in_b.val());
//!         self.out_mean.next = bit_cast_to::<S<8>>(self.sum.val() >> 1);
//!     }
//!     fn timing(&self) -> Vec<TimingInfo> {
//!         module_name("average")
//!     }
//! }
//! let emission = emit(&Average::default())?;
//! assert_eq!(emission.top, "relief_average");
//! assert!(emission.top_module().source.contains("assign sum = s8_to_s9(in_a) + s8_to_s9(in_b);"));
//! # Ok::<(), relief_hdl::verilog::EmitError>(())
//! ```
//!
//! # Why a back-end of our own
//! rust-hdl's printer writes a kernel's operators into Verilog as they stand. Verilog computes an operation at the
//! widest width around it and as unsigned when anything around it is; so `bit_cast(a + b)` keeps a carry that Rust drops,
//! fields compare as unsigned, and `a & b == b` groups in another way. None of this is reported. This back-end reads the
//! same syntax tree and gives every expression a type and every operand a form that its surroundings cannot change.
//!
//! # The syntax tree's traps, and how each is closed
//! - A literal has no width, a cast only a number: types flow up from the signals and down into literals
//!   ([`Synth::bits`](rust_hdl_core::synth::Synth::bits) of our types also carries sign and lanes). Unknown is an error.
//! - Context-determined width and sign: sums are printed as `{a + b}`, signed ones as `$signed({a + b})`, and changes of
//!   width, lanes and dynamic indexes as small functions; only a right side whose width is the target's goes bare.
//! - `.val()`, `.into()` and `.index()` vanish: a dynamic index must be a plain signal, since behind `.index()` Rust
//!   computes in 64 bits; and a loop variable must not be called like a signal.
//! - Match guards, the `=` of `..=`, `cfg` on statements and arguments behind the first of a function vanish, too:
//!   [`scan_kernels`] looks for them in the sources, and a test runs it over this crate.
//! - A name in a pattern may be a variant or a binding: only `Enum::Variant`, `true`, `false` and `_` are taken.
//! - Statements are ordered in Rust and concurrent in Verilog: a kernel is split into pieces ([the order is
//!   checked](EmitError::AssignedAfterRead), so that the pieces need none), and no piece feeds itself, so that no
//!   simulator sees a combinational loop where the hardware has none.
//! - Array elements of a constant loop are unrolled under the names that `Probe` gives them.
//!
//! # What a kernel may contain
//! 1. Fields: `clock: Input<ClockReset>` (this name; the only clock), [`Input`](crate::signal::Input),
//!    [`Output`](crate::signal::Output), [`Wire`](crate::signal::Wire), `Constant`, blocks and primitives, and arrays of
//!    them. No stock `Bits`, `Signed`, `Signal<InOut, _>`, interface, `link`, black box or wrapper. Names are lower-case
//!    and no keywords; `x_y` clashes with the port `y` of a child `x`.
//! 2. A name: `timing()` returns [`module_name`]; parameters that change the text belong into it.
//! 3. Every output, and every input of a child, is assigned on every path (default first, then `if` and `match`); wires
//!    are written before they are read and not afterwards; own inputs are never written. Only the `enable` of a
//!    primitive may stay undriven. A child's clock is `self.clock.val()`, unconditionally.
//! 4. Both operands of an operation have one type; widths and signs change by
//!    [`bit_cast_to`](crate::signal::bit_cast_to) only. A literal must fit its type and not decide a comparison alone.
//! 5. Indexes of `get_bit`, `get_bits` and `replace_bit` are literals, loop variables, or `signal.val().index()`;
//!    indexes of arrays are literals and loop variables. Const generics are for types and loop bounds; as values they go
//!    into a `Constant`. Inside a `for`, an argument of `bit_cast_to` cannot mention the loop variable (the macro
//!    evaluates it outside): cast into a wire before the loop.
//! 6. Shift amounts are literals or unsigned of less than 32 bits. An `if` or `match` needs something that changes: a
//!    choice between constants is made in the constructor.
//! 7. No match guards, `..=`, `#[cfg]` on statements, or `.index()` in arithmetic.
//! 8. A signal that nothing reads as a whole is listed in the module's `unused`; an index that is out of range panics in Rust and
//!    is undefined in hardware.
//!
//! # Primitives
//! A `Verilog::Custom` text that begins with [`INLINE`](crate::primitives::INLINE) is pasted into the parent, with `@`
//! before a name replaced by `<instance>_`; lines `//hex <file> <word>` become memory files. Such a primitive must not
//! pass an input on to an output within a cycle. Other custom texts are whole module bodies.

mod analysis;
mod body;
mod error;
mod expr;
mod functions;
mod groups;
mod guards;
mod module;
mod names;
mod print;
mod scope;
mod stmt;
mod symbols;
mod types;
mod unroll;

pub use error::EmitError;
pub use guards::{GuardFinding, scan_kernels, scan_match_guards};

use rust_hdl_core::ast::Verilog;
use rust_hdl_core::block::Block;
use rust_hdl_core::timing::TimingInfo;
use scope::Scope;
use std::collections::HashMap;
use std::path::Path;

/// Direction of a port.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Direction {
    /// Driven from outside.
    Input,
    /// Driven by the module.
    Output,
}

/// One port of an emitted module.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PortInfo {
    /// Name, which is the block's field name (of element `k` of an array, `<field>_<k>`).
    pub name: String,
    /// Total width.
    pub bits: usize,
    /// Direction.
    pub direction: Direction,
    /// Whether the integer, or each lane, is in two's complement.
    pub signed: bool,
    /// Number of lanes, each of `bits / lanes` bits, lane 0 lowest; zero for a scalar.
    pub lanes: usize,
}

/// One emitted module.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Module {
    /// Module name, `relief_<block>`.
    pub name: String,
    /// Whole text of the file `<name>.sv`.
    pub source: String,
    /// Ports in the order of the port list: `clock` and `reset` where there are any, then the fields.
    pub ports: Vec<PortInfo>,
}

/// A block and everything below it in Verilog.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Emission {
    /// Modules, each once, children before their parents.
    pub modules: Vec<Module>,
    /// Files that the memories read with `$readmemh`: name and contents.
    pub memories: Vec<(String, String)>,
    /// Name of the top module.
    pub top: String,
}

impl Emission {
    /// Writes `<module>.sv` for every module, the memory files, and `filelist.f` that names the modules in order. The
    /// directory is created; every file appears whole or not at all.
    pub fn write(&self, directory: impl AsRef<Path>) -> Result<(), EmitError> {
        let directory = directory.as_ref();
        let fail = |path: &Path| {
            let path = path.to_path_buf();
            move |source| EmitError::Write { path, source }
        };
        std::fs::create_dir_all(directory).map_err(fail(directory))?;
        let mut files: Vec<(String, &str)> = self.memories.iter().map(|(n, t)| (n.clone(), t.as_str())).collect();
        files.extend(self.modules.iter().map(|m| (format!("{}.sv", m.name), m.source.as_str())));
        let list: String = self.modules.iter().map(|m| format!("{}.sv\n", m.name)).collect();
        files.push(("filelist.f".into(), &list));
        for (name, text) in files {
            let path = directory.join(&name);
            let temporary = directory.join(format!(".{name}.{}", std::process::id()));
            std::fs::write(&temporary, text).map_err(fail(&temporary))?;
            std::fs::rename(&temporary, &path).map_err(fail(&path))?;
        }
        Ok(())
    }

    /// The top module.
    pub fn top_module(&self) -> &Module {
        self.modules.last().expect("an emission has its top")
    }
}

/// What a block returns from `Logic::timing()` to be emitted as the module `relief_<name>`. Parameters that change the
/// Verilog belong into the name: `module_name(format!("strip_unit_{W}"))`.
pub fn module_name(name: impl Into<String>) -> Vec<TimingInfo> {
    vec![TimingInfo { name: name.into(), clock: String::new(), inputs: vec![], outputs: vec![] }]
}

/// The Verilog of `top`, which must be fully connected in its kernels; its own inputs need no driver.
pub fn emit(top: &dyn Block) -> Result<Emission, EmitError> {
    let scope = Scope::read(top)?;
    let mut emitter = Emitter::default();
    let top = emitter.block(&scope)?;
    Ok(Emission { modules: emitter.modules, memories: emitter.memories, top })
}

#[derive(Default)]
struct Emitter {
    modules: Vec<Module>,
    /// Index of each module, and the instance path it was emitted for.
    known: HashMap<String, (usize, String)>,
    memories: Vec<(String, String)>,
}

impl Emitter {
    /// Emits a block that is a module, children first, and gives the module's name.
    fn block(&mut self, scope: &Scope) -> Result<String, EmitError> {
        let at = scope.path.clone();
        let Some(name) = &scope.module else { return Err(EmitError::Unnamed { at }) };
        let name = format!("relief_{name}");
        names::check(&at, &name)?;
        self.collect_memories(scope)?;
        let mut children = vec![];
        for child in &scope.children {
            children.push(match child.inline_text() {
                Some(_) => {
                    self.collect_memories(child)?;
                    None
                }
                None => Some(self.block(child)?),
            });
        }
        let find = |name: &Option<String>| name.as_ref().map(|n| &self.modules[self.known[n].0]);
        let instances: Vec<Option<&Module>> = children.iter().map(find).collect();
        let module = module::module(scope, &name, &instances)?;
        match self.known.get(&name) {
            Some((k, _)) if self.modules[*k].source == module.source => {}
            Some((_, first)) => {
                return Err(EmitError::ModuleClash { name, first: first.clone(), second: at });
            }
            None => {
                self.known.insert(name.clone(), (self.modules.len(), at));
                self.modules.push(module);
            }
        }
        Ok(name)
    }

    /// Takes the lines `//hex <file> <word>` of a custom text.
    fn collect_memories(&mut self, scope: &Scope) -> Result<(), EmitError> {
        let Verilog::Custom(text) = &scope.hdl else { return Ok(()) };
        let mut files: Vec<(String, String)> = vec![];
        for line in text.lines().filter_map(|l| l.strip_prefix("//hex ")) {
            let (file, word) = line.split_once(' ').unwrap_or((line, ""));
            match files.iter_mut().find(|(name, _)| name == file) {
                Some((_, contents)) => *contents += &format!("{word}\n"),
                None => files.push((file.into(), format!("{word}\n"))),
            }
        }
        for (file, contents) in files {
            match self.memories.iter().find(|(name, _)| *name == file) {
                Some((_, known)) if *known != contents => {
                    return Err(EmitError::MemoryClash { at: scope.path.clone(), file });
                }
                Some(_) => {}
                None => self.memories.push((file, contents)),
            }
        }
        Ok(())
    }
}
