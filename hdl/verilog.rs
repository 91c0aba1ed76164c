// SPDX-License-Identifier: MIT OR Apache-2.0
//! Verilog of a block.

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
pub use guards::{GuardFinding, scan_match_guards};

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
