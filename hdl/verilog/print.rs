// SPDX-License-Identifier: MIT OR Apache-2.0
//! Expressions in Verilog.
//!
//! Verilog computes an operation at the widest width around it and takes it as unsigned when anything around it is.
//! Here every operand is printed so that its surroundings cannot reach it: `{a + b}` has exactly the operands' width.

use super::expr::{Index, Node, Typed};
use super::functions::{Functions, index_type, unsigned};
use super::symbols::{Role, Symbols};
use super::types::{BIT, Type};

/// Prints the expressions of one module, and collects the functions that they call.
pub(super) struct Printer<'a> {
    pub symbols: &'a Symbols,
    pub functions: Functions,
    /// Whether something was compared with a constant of the block, whose value may decide the comparison.
    pub compares_constants: bool,
}

impl Printer<'_> {
    /// An expression where its own width and nothing else rules: the right side of an assignment to a target of the
    /// same type, or a condition.
    pub(super) fn top(&mut self, e: &Typed) -> String {
        let lanes = matches!(e.ty, Type::Lanes { .. });
        match &e.node {
            Node::Binary("+" | "-", ..) | Node::Unary("-", _) | Node::Shift { .. } if lanes => self.operand(e),
            Node::Binary(op, a, b) => {
                if matches!(*op, "<" | "<=" | ">" | ">=") {
                    let constant = |k: usize| matches!(self.symbols.list[k].role, Role::Constant(_));
                    let mut found = false;
                    e.reads(&mut |k, _| found |= constant(k));
                    self.compares_constants |= found;
                }
                format!("{} {op} {}", self.operand(a), self.operand(b))
            }
            Node::Unary(op, a) => {
                let op = if *op == "~" && a.ty == BIT { "!" } else { op };
                format!("{op}{}", self.operand(a))
            }
            Node::Shift { left, value, amount } => {
                let op = match (left, e.ty.is_signed()) {
                    (true, _) => "<<",
                    (false, true) => ">>>",
                    (false, false) => ">>",
                };
                let amount = match amount {
                    Index::Constant(k) => k.to_string(),
                    Index::Dynamic(k) => self.operand(k),
                };
                format!("{} {op} {amount}", self.operand(value))
            }
            Node::Cast(value) if value.ty == e.ty => self.top(value),
            _ => self.operand(e),
        }
    }

    /// An expression that keeps its value wherever it stands.
    pub(super) fn operand(&mut self, e: &Typed) -> String {
        let lanes = matches!(e.ty, Type::Lanes { .. });
        match &e.node {
            Node::Signal(k) => self.symbols.list[*k].name.clone(),
            Node::Literal(value) => e.ty.literal(*value),
            Node::Variant(code) => match &e.ty {
                Type::Enum(e) => format!("{}_{}", e.name, e.variants[*code]),
                _ => unreachable!("a variant has its enum's type"),
            },
            Node::Binary(op @ ("+" | "-"), a, b) if lanes => {
                let function = self.functions.lane_by_lane(op, &e.ty, 2);
                format!("{function}({}, {})", self.operand(a), self.operand(b))
            }
            Node::Unary("-", a) if lanes => {
                let function = self.functions.lane_by_lane("-", &e.ty, 1);
                format!("{function}({})", self.operand(a))
            }
            Node::Shift { left, value, amount } if lanes => {
                let (amount, ty) = self.index(amount);
                let function = self.functions.shift_lanes(*left, &e.ty, &ty);
                format!("{function}({}, {amount})", self.operand(value))
            }
            Node::Binary("==" | "!=" | "<" | "<=" | ">" | ">=" | "&&" | "||", ..) | Node::Unary("&" | "|" | "^", _) => {
                format!("({})", self.top(e))
            }
            Node::Binary(..) | Node::Unary(..) | Node::Shift { .. } => {
                let text = self.top(e);
                if e.ty.is_signed() { format!("$signed({{{text}}})") } else { format!("{{{text}}}") }
            }
            Node::Cast(value) => self.cast(value, &e.ty),
            Node::Select(value, index) => self.select(value, index, &e.ty),
            Node::Slice(value, index) => self.slice(value, index, &e.ty),
            Node::Replace(value, index, part) => {
                let (index, ty) = self.index(index);
                let function = self.functions.replace(&e.ty, &part.ty, &ty);
                format!("{function}({}, {index}, {})", self.operand(value), self.operand(part))
            }
        }
    }

    /// An index as an argument, with its format.
    fn index(&mut self, index: &Index) -> (String, Type) {
        match index {
            Index::Constant(k) => {
                let ty = index_type(*k);
                (ty.literal(*k as i128), ty)
            }
            Index::Dynamic(k) => (self.with_sign(k, false), unsigned(k.ty.width())),
        }
    }

    /// A scalar, read as signed or unsigned at its own width.
    fn with_sign(&mut self, e: &Typed, signed: bool) -> String {
        let text = self.operand(e);
        match (e.ty.is_signed(), signed) {
            (true, false) => format!("$unsigned({text})"),
            (false, true) => format!("$signed({text})"),
            _ => text,
        }
    }

    fn cast(&mut self, value: &Typed, to: &Type) -> String {
        match (&value.ty, to) {
            (from, to) if from == to => self.operand(value),
            (Type::Int { .. }, Type::Int { signed, .. }) if value.ty.width() == to.width() => {
                self.with_sign(value, *signed)
            }
            (Type::Int { signed, .. }, Type::Lanes { lanes, bits }) => {
                let lane = Type::Int { signed: *signed, bits: *bits };
                format!("{{{lanes}{{{}}}}}", self.cast(value, &lane))
            }
            (from @ Type::Lanes { .. }, to) => {
                let function = self.functions.resize_lanes(from, to);
                format!("{function}({})", self.operand(value))
            }
            (from, to) => {
                let function = self.functions.resize(from, to);
                format!("{function}({})", self.operand(value))
            }
        }
    }

    /// The name of a signal whose parts Verilog can select.
    fn plain(&self, e: &Typed) -> Option<String> {
        match e.node {
            Node::Signal(k) if e.ty != BIT && !matches!(self.symbols.list[k].role, Role::Constant(_)) => {
                Some(self.symbols.list[k].name.clone())
            }
            _ => None,
        }
    }

    fn select(&mut self, value: &Typed, index: &Index, to: &Type) -> String {
        match (&value.ty, index, self.plain(value)) {
            (Type::Lanes { bits, .. }, Index::Constant(k), Some(name)) => {
                format!("$signed({name}[{}:{}])", k * bits + bits - 1, k * bits)
            }
            (Type::Int { .. }, Index::Constant(k), Some(name)) => format!("{name}[{k}]"),
            (Type::Int { bits: 1, .. }, ..) => self.with_sign(value, false),
            _ => {
                let (index, ty) = self.index(index);
                let function = self.functions.select(&value.ty, to, &ty);
                format!("{function}({}, {index})", self.operand(value))
            }
        }
    }

    fn slice(&mut self, value: &Typed, index: &Index, to: &Type) -> String {
        match (index, self.plain(value)) {
            (Index::Constant(_), _) if value.ty.width() == to.width() => self.with_sign(value, false),
            (Index::Constant(k), Some(name)) => format!("{name}[{}:{k}]", k + to.width() - 1),
            _ => {
                let (index, ty) = self.index(index);
                let function = self.functions.slice(&value.ty, to, &ty);
                format!("{function}({}, {index})", self.operand(value))
            }
        }
    }
}
