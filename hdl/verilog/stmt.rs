// SPDX-License-Identifier: MIT OR Apache-2.0
//! Statements of a kernel: loops unrolled, macros expanded, names resolved, types checked, clocks taken out.

use super::EmitError;
use super::expr::{Context, Index, Node, Typed, literal_value};
use super::symbols::{Role, Symbols};
use super::types::{BIT, Type};
use super::unroll::resolve;
use rust_hdl_core::ast::{
    VerilogBlockOrConditional, VerilogConditional, VerilogExpression as Ast, VerilogLoop, VerilogMatch,
    VerilogStatement,
};

/// A statement.
#[derive(Clone, Debug)]
pub(super) enum Stmt {
    Assign {
        target: usize,
        value: Typed,
    },
    If {
        test: Typed,
        then: Vec<Stmt>,
        otherwise: Vec<Stmt>,
    },
    /// Complete: the labels are all variants, or the last arm has none.
    Match {
        test: Typed,
        arms: Vec<Arm>,
    },
}

/// An arm of a `match`: the code that it is for, or none for `_`.
#[derive(Clone, Debug)]
pub(super) struct Arm {
    pub label: Option<usize>,
    pub body: Vec<Stmt>,
}

/// A kernel, and the children that it clocks.
#[derive(Default)]
pub(super) struct Kernel {
    pub body: Vec<Stmt>,
    pub clocked: Vec<usize>,
}

/// Lowers the statements of a block.
pub(super) fn lower(symbols: &Symbols, children: &[String], block: &[VerilogStatement]) -> Result<Kernel, EmitError> {
    let mut lowering = Lowering { symbols, children, loops: vec![], clocked: vec![] };
    let body = lowering.block(block, true)?;
    Ok(Kernel { body, clocked: lowering.clocked })
}

struct Lowering<'a> {
    symbols: &'a Symbols,
    children: &'a [String],
    loops: Vec<(String, i128)>,
    clocked: Vec<usize>,
}

impl Lowering<'_> {
    fn context(&self, statement: String) -> Context<'_> {
        Context { symbols: self.symbols, loops: &self.loops, at: format!("{}, {statement}", self.symbols.block) }
    }

    fn unsupported<T>(&self, what: &str, remedy: &str) -> Result<T, EmitError> {
        Err(EmitError::Unsupported { at: self.symbols.block.clone(), what: what.into(), remedy: remedy.into() })
    }

    /// `top` tells that the statements are executed unconditionally.
    fn block(&mut self, block: &[VerilogStatement], top: bool) -> Result<Vec<Stmt>, EmitError> {
        let mut out = vec![];
        for statement in block {
            match statement {
                VerilogStatement::Assignment(target, value) => out.extend(self.assign(target, value, top)?),
                VerilogStatement::If(c) => out.push(self.conditional(c)?),
                VerilogStatement::Match(m) => out.push(self.matching(m)?),
                VerilogStatement::Loop(l) => self.unroll(l, top, &mut out)?,
                VerilogStatement::Macro(block) => out.extend(self.block(block, top)?),
                VerilogStatement::Comment(_) => {}
                VerilogStatement::Link(_) => {
                    return self.unsupported("`link` or `join`", "assign the ports one by one");
                }
                VerilogStatement::SliceAssignment { .. } => {
                    return self.unsupported("writing a part of a signal", "use `replace_bit` and assign the whole");
                }
            }
        }
        Ok(out)
    }

    fn unroll(&mut self, l: &VerilogLoop, top: bool, out: &mut Vec<Stmt>) -> Result<(), EmitError> {
        let (Some((from, false)), Some((to, false))) = (literal_value(&l.from), literal_value(&l.to)) else {
            return self.unsupported("a loop bound below zero", "count from zero");
        };
        let owner = |key: &str| key == l.index || key.starts_with(&format!("{}$", l.index));
        let taken = self.symbols.list.iter().any(|s| owner(&s.key)) || self.children.iter().any(|c| owner(c));
        if taken || self.loops.iter().any(|(n, _)| *n == l.index) {
            // `self.i.val()` and `i` look the same in the syntax tree.
            let what = format!("a loop variable `{}` with the name of a signal or outer loop variable", l.index);
            return self.unsupported(&what, "rename the loop variable");
        }
        for value in from..to {
            self.loops.push((l.index.clone(), value));
            let body = self.block(&l.block, top);
            self.loops.pop();
            out.extend(body?);
        }
        Ok(())
    }

    fn assign(&mut self, target: &Ast, value: &Ast, top: bool) -> Result<Option<Stmt>, EmitError> {
        let Ast::Signal(raw) = target else {
            return self.unsupported("assigning to an expression", "assign `.next` of a signal");
        };
        let shown = raw.replace('$', ".");
        let Some(name) = raw.strip_suffix("$next") else {
            return self.unsupported(&format!("assigning to `{shown}`"), "assign `.next` of a signal");
        };
        let context = self.context(format!("assignment to `{}`", name.replace('$', ".")));
        let found = resolve(name, &self.loops).and_then(|key| self.symbols.find(&key));
        let Some(index) = found else {
            return Err(EmitError::UnknownSignal { at: context.at, name: name.replace('$', ".") });
        };
        let symbol = &self.symbols.list[index];
        if let Role::ChildClock(child) = symbol.role {
            let own = matches!(value, Ast::Signal(v) if self.symbols.find(v)
                .is_some_and(|k| self.symbols.list[k].role == Role::Clock));
            if !own || !top {
                let what = if own { "a clock is gated" } else { "a child's clock is not the block's own" };
                return Err(EmitError::Clock { at: context.at, what: what.into() });
            }
            self.clocked.push(child);
            return Ok(None);
        }
        if !symbol.role.writable() {
            let what = symbol.role.describe().into();
            return Err(EmitError::WrongTarget { at: context.at, signal: symbol.key.replace('$', "."), what });
        }
        Ok(Some(Stmt::Assign { target: index, value: context.typed_as(value, &symbol.ty)? }))
    }

    fn conditional(&mut self, c: &VerilogConditional) -> Result<Stmt, EmitError> {
        let test = self.context("condition of an `if`".into()).typed_as(&c.test, &BIT)?;
        let then = self.block(&c.then, false)?;
        let otherwise = match &c.otherwise {
            VerilogBlockOrConditional::Block(block) => self.block(block, false)?,
            VerilogBlockOrConditional::Conditional(statement) => {
                self.block(std::slice::from_ref(&**statement), false)?
            }
            VerilogBlockOrConditional::None => vec![],
        };
        Ok(Stmt::If { test, then, otherwise })
    }

    fn matching(&mut self, m: &VerilogMatch) -> Result<Stmt, EmitError> {
        let context = self.context("`match`".into());
        let at = context.at.clone();
        let test = context.typed(&m.test, None)?;
        let labels: Vec<String> = match &test.ty {
            Type::Enum(e) => e.variants.iter().map(|v| format!("{}${v}", e.name)).collect(),
            ty if *ty == BIT => vec!["false".into(), "true".into()],
            ty => {
                let (operation, remedy) = ("`match`".into(), "match on an enum or a bit".into());
                return Err(EmitError::WrongOperand { at, operation, found: ty.to_string(), remedy });
            }
        };
        let mut arms: Vec<Arm> = vec![];
        for case in &m.cases {
            let label = labels.iter().position(|l| *l == case.condition);
            let refuse = |what: &str, remedy: &str| {
                let what = format!("the arm `{}` {what}", case.condition.replace('$', "::"));
                Err(EmitError::Unsupported { at: at.clone(), what, remedy: remedy.into() })
            };
            if label.is_none() && case.condition != "default" {
                // A plain name is a binding that matches everything, or a constant: the syntax tree cannot tell.
                return refuse("which is no variant", "write `Enum::Variant` or `_`");
            }
            if label.is_some() && arms.iter().any(|a| a.label == label) {
                return refuse("which stands twice", "remove one of them");
            }
            let body = self.block(&case.block, false)?;
            arms.push(Arm { label, body });
            if label.is_none() {
                break; // Rust never reaches an arm behind `_`.
            }
        }
        if arms.last().is_none_or(|a| a.label.is_some()) && arms.len() < labels.len() {
            let what = "a `match` without some variants".into();
            return Err(EmitError::Unsupported { at, what, remedy: "add the arms or `_`".into() });
        }
        Ok(Stmt::Match { test, arms })
    }
}

impl Typed {
    /// Calls `f` with every signal in the expression, and whether it is read as a whole.
    pub(super) fn reads(&self, f: &mut dyn FnMut(usize, bool)) {
        let index = |index: &Index, f: &mut dyn FnMut(usize, bool)| {
            if let Index::Dynamic(k) = index {
                k.reads(f);
            }
        };
        match &self.node {
            Node::Signal(k) => f(*k, true),
            Node::Literal(_) | Node::Variant(_) => {}
            Node::Unary(_, value) | Node::Cast(value) => value.reads(f),
            Node::Binary(_, a, b) => {
                a.reads(f);
                b.reads(f);
            }
            Node::Shift { value, amount, .. } => {
                value.reads(f);
                index(amount, f);
            }
            Node::Select(value, k) | Node::Slice(value, k) => {
                value.reads(&mut |signal, whole| f(signal, whole && !matches!(value.node, Node::Signal(_))));
                index(k, f);
            }
            Node::Replace(value, k, part) => {
                value.reads(f);
                index(k, f);
                part.reads(f);
            }
        }
    }
}
