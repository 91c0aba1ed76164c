// SPDX-License-Identifier: MIT OR Apache-2.0
//! The hierarchy of blocks, read once through rust-hdl's `Probe`.

use super::EmitError;
use crate::primitives::INLINE;
use rust_hdl_core::ast::Verilog;
use rust_hdl_core::atom::{Atom, AtomKind};
use rust_hdl_core::block::Block;
use rust_hdl_core::probe::Probe;
use rust_hdl_core::synth::VCDValue;
use rust_hdl_core::type_descriptor::TypeDescriptor;

/// One signal of a block.
pub(super) struct AtomInfo {
    pub name: String,
    pub kind: AtomKind,
    pub descriptor: TypeDescriptor,
    pub value: VCDValue,
}

/// One block.
pub(super) struct Scope {
    /// Field name in the parent; elements of arrays are `name$0`, `name$1`, ...
    pub name: String,
    /// Instance path, for messages.
    pub path: String,
    /// What the block says in `Logic::timing()`.
    pub module: Option<String>,
    pub hdl: Verilog,
    pub atoms: Vec<AtomInfo>,
    pub children: Vec<Scope>,
}

impl Scope {
    /// Reads the hierarchy under `top`.
    pub(super) fn read(top: &dyn Block) -> Result<Scope, EmitError> {
        let mut reader = Reader { open: vec![], done: None, interface: None };
        top.accept("top", &mut reader);
        match (reader.done, reader.interface) {
            (_, Some(at)) => Err(EmitError::Unsupported {
                at,
                what: "a rust-hdl interface".into(),
                remedy: "write its signals as separate ports".into(),
            }),
            (Some(scope), None) => Ok(scope),
            (None, None) => Err(EmitError::Unsupported {
                at: "top".into(),
                what: "a signal as the top".into(),
                remedy: "pass a block".into(),
            }),
        }
    }

    /// The text of a primitive that is pasted into its parent.
    pub(super) fn inline_text(&self) -> Option<&str> {
        match &self.hdl {
            Verilog::Custom(text) => text.strip_prefix(INLINE),
            _ => None,
        }
    }
}

struct Reader {
    open: Vec<Scope>,
    done: Option<Scope>,
    interface: Option<String>,
}

impl Probe for Reader {
    fn visit_start_scope(&mut self, name: &str, node: &dyn Block) {
        let path = self.open.last().map_or(name.into(), |p| format!("{}.{}", p.path, name.replace('$', ".")));
        let module = node.timing().into_iter().next().map(|t| t.name);
        let (atoms, children) = (vec![], vec![]);
        self.open.push(Scope { name: name.into(), path, module, hdl: node.hdl(), atoms, children });
    }
    fn visit_start_namespace(&mut self, name: &str, _node: &dyn Block) {
        let parent = self.open.last().map_or("top", |p| &p.path);
        self.interface = Some(format!("{parent}.{name}"));
    }
    fn visit_atom(&mut self, name: &str, signal: &dyn Atom) {
        if let Some(scope) = self.open.last_mut() {
            scope.atoms.push(AtomInfo {
                name: name.into(),
                kind: signal.kind(),
                descriptor: signal.descriptor(),
                value: signal.vcd(),
            });
        }
    }
    fn visit_end_scope(&mut self, _name: &str, _node: &dyn Block) {
        if let Some(scope) = self.open.pop() {
            match self.open.last_mut() {
                Some(parent) => parent.children.push(scope),
                None => self.done = Some(scope),
            }
        }
    }
}
