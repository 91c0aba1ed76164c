// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the names in a kernel mean: the block's own signals and constants, its children's ports, and enum variants.

use super::names::{Names, check, flat};
use super::scope::{AtomInfo, Scope};
use super::types::{EnumType, Type};
use super::{Direction, EmitError};
use rust_hdl_core::atom::AtomKind;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// What a symbol is to the block whose kernel names it. Children are given by their index.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Role {
    Port(Direction),
    Wire,
    /// A constant and its value in Verilog.
    Constant(String),
    ChildInput(usize),
    ChildOutput(usize),
    /// A constant of an inlined child, such as a register's reset value.
    ChildConstant(usize, String),
    Clock,
    ChildClock(usize),
}

impl Role {
    /// Whether the kernel may write it.
    pub(super) fn writable(&self) -> bool {
        matches!(self, Role::Port(Direction::Output) | Role::Wire | Role::ChildInput(_))
    }
    /// In words.
    pub(super) fn describe(&self) -> &'static str {
        match self {
            Role::Port(Direction::Input) => "an input of the block",
            Role::Port(Direction::Output) => "an output of the block",
            Role::Wire => "a wire",
            Role::Constant(_) | Role::ChildConstant(..) => "a constant",
            Role::ChildInput(_) => "an input of a child",
            Role::ChildOutput(_) => "an output of a child",
            Role::Clock => "the clock",
            Role::ChildClock(_) => "the clock of a child",
        }
    }
}

/// A signal or constant.
pub(super) struct Symbol {
    /// As the kernel macro writes it: `port` or `child$port`.
    pub key: String,
    /// In Verilog.
    pub name: String,
    pub ty: Type,
    pub role: Role,
}

/// All symbols of one block.
pub(super) struct Symbols {
    /// Instance path and module, for messages.
    pub block: String,
    pub list: Vec<Symbol>,
    pub enums: BTreeMap<String, EnumType>,
    pub names: Names,
    /// Children whose outputs come from registers: the inlined primitives.
    pub registered: BTreeSet<usize>,
    by_key: HashMap<String, usize>,
}

impl Symbols {
    /// Reads the symbols of `scope`, whose messages begin with `block`.
    pub(super) fn of(scope: &Scope, block: &str) -> Result<Symbols, EmitError> {
        let mut symbols = Symbols {
            block: block.into(),
            list: vec![],
            enums: BTreeMap::new(),
            names: Names::default(),
            registered: BTreeSet::new(),
            by_key: HashMap::new(),
        };
        for atom in &scope.atoms {
            symbols.add(atom, None)?;
        }
        for (k, child) in scope.children.iter().enumerate() {
            for atom in &child.atoms {
                symbols.add(atom, Some((k, child)))?;
            }
            if child.inline_text().is_some() {
                symbols.registered.insert(k);
            } else {
                let name = flat(&child.name);
                check(block, &name)?;
                symbols.names.take(block, &name, &format!("instance {name}"))?;
            }
        }
        Ok(symbols)
    }

    /// The symbol with this key.
    pub(super) fn find(&self, key: &str) -> Option<usize> {
        self.by_key.get(key).copied()
    }

    fn add(&mut self, atom: &AtomInfo, child: Option<(usize, &Scope)>) -> Result<(), EmitError> {
        let key = child.map_or(atom.name.clone(), |(_, c)| format!("{}${}", c.name, atom.name));
        let name = flat(&key);
        let refuse = |what: String, remedy: &str| EmitError::Unsupported {
            at: format!("{}, `{name}`", self.block),
            what,
            remedy: remedy.into(),
        };
        let hidden = child.is_some_and(|(_, c)| {
            atom.kind == AtomKind::LocalSignal || atom.kind == AtomKind::Constant && c.inline_text().is_none()
        });
        if hidden {
            return Ok(());
        }
        let ty = Type::of(&atom.descriptor).map_err(|what| refuse(what, "use the types of `signal`"))?;
        let constant = || {
            let remedy = "hold an integer, packed vertex or state";
            ty.constant(&atom.value).ok_or_else(|| refuse("this constant".into(), remedy))
        };
        let role = match (atom.kind, child.map(|(k, _)| k)) {
            (AtomKind::InputParameter, None) if ty == Type::Clock => Role::Clock,
            (AtomKind::InputParameter, Some(k)) if ty == Type::Clock => Role::ChildClock(k),
            _ if ty == Type::Clock => {
                return Err(refuse("a clock that is no input".into(), "hand the clock on directly"));
            }
            (AtomKind::InputParameter, None) => Role::Port(Direction::Input),
            (AtomKind::OutputParameter, None) => Role::Port(Direction::Output),
            (AtomKind::LocalSignal, None) => Role::Wire,
            (AtomKind::Constant, None) => Role::Constant(constant()?),
            (AtomKind::InputParameter, Some(k)) => Role::ChildInput(k),
            (AtomKind::OutputParameter, Some(k)) => Role::ChildOutput(k),
            (AtomKind::Constant, Some(k)) => Role::ChildConstant(k, constant()?),
            (kind, _) => return Err(refuse(format!("a signal of kind {kind:?}"), "use `Input`, `Output` or `Wire`")),
        };
        if ty == Type::Clock && atom.name != "clock" {
            return Err(refuse("a clock under another name".into(), "call it `clock`; a block has one clock"));
        }
        if let Type::Enum(e) = &ty {
            let known = self.enums.entry(e.name.clone()).or_insert_with(|| e.clone());
            if known != e {
                return Err(refuse(format!("a second enum called `{}`", e.name), "rename one of the enums"));
            }
        }
        let block = self.block.clone();
        check(&block, &name)?;
        match role {
            Role::Clock => {
                self.names.take(&block, "clock", "clock")?;
                self.names.take(&block, "reset", "the reset that comes with `clock`")?;
            }
            Role::ChildClock(_) => {}
            _ => self.names.take(&block, &name, &key.replace('$', "."))?,
        }
        self.by_key.insert(key.clone(), self.list.len());
        self.list.push(Symbol { key, name, ty, role });
        Ok(())
    }
}
