// SPDX-License-Identifier: MIT OR Apache-2.0
//! Expressions with their types.
//!
//! Types flow up from the signals, and down into literals by Rust's rule that both operands of an operation have one
//! type. A type that is unknown or does not match is an error.

use super::EmitError;
use super::symbols::{Role, Symbols};
use super::types::{BIT, Type};
use super::unroll::resolve;
use rust_hdl_core::ast::{VerilogExpression as Ast, VerilogLiteral, VerilogOp, VerilogOpUnary};

/// An expression with its type.
#[derive(Clone, Debug)]
pub(super) struct Typed {
    pub ty: Type,
    pub node: Node,
}

#[derive(Clone, Debug)]
pub(super) enum Node {
    /// A symbol by its index.
    Signal(usize),
    Literal(i128),
    /// A variant by its code.
    Variant(usize),
    /// An infix operator whose operands have one type.
    Binary(&'static str, Box<Typed>, Box<Typed>),
    Shift {
        left: bool,
        value: Box<Typed>,
        amount: Index,
    },
    /// `~`, `-`, and the reductions `&`, `|`, `^`.
    Unary(&'static str, Box<Typed>),
    Cast(Box<Typed>),
    /// One bit, or one lane.
    Select(Box<Typed>, Index),
    /// As many bits as the type has, from an offset upwards.
    Slice(Box<Typed>, Index),
    /// One bit or lane replaced.
    Replace(Box<Typed>, Index, Box<Typed>),
}

/// A bit number, lane number or shift amount.
#[derive(Clone, Debug)]
pub(super) enum Index {
    Constant(usize),
    Dynamic(Box<Typed>),
}

/// The surroundings of an expression.
pub(super) struct Context<'a> {
    pub symbols: &'a Symbols,
    /// Values of the loop variables, outermost first.
    pub loops: &'a [(String, i128)],
    /// Block and statement, for messages.
    pub at: String,
}

/// Value of a literal, and whether it was a `bool`. The fields of `VerilogLiteral` are private: its text is read.
pub(super) fn literal_value(literal: &VerilogLiteral) -> Option<(i128, bool)> {
    let text = format!("{literal:x}");
    let (bits, digits) = text.split_once("'h")?;
    Some((i128::from_str_radix(digits, 16).ok()?, bits == "1"))
}

impl Context<'_> {
    fn at(&self) -> String {
        self.at.clone()
    }
    fn unsupported<T>(&self, what: &str, remedy: &str) -> Result<T, EmitError> {
        Err(EmitError::Unsupported { at: self.at(), what: what.into(), remedy: remedy.into() })
    }
    fn wrong<T>(&self, operation: &str, found: &Type, remedy: &str) -> Result<T, EmitError> {
        let (operation, found) = (format!("`{operation}`"), found.to_string());
        Err(EmitError::WrongOperand { at: self.at(), operation, found, remedy: remedy.into() })
    }
    fn mismatch<T>(&self, what: &Ast, found: &Type, expected: &Type) -> Result<T, EmitError> {
        let (found, expected) = (found.to_string(), expected.to_string());
        Err(EmitError::Mismatch { at: self.at(), what: describe(what), found, expected })
    }

    /// Value of an expression of literals and loop variables, computed as `i32` or `usize` do.
    fn constant(&self, e: &Ast) -> Option<i128> {
        let value = match e {
            Ast::Paren(e) => self.constant(e)?,
            Ast::Literal(l) => literal_value(l).filter(|(_, is_bool)| !is_bool)?.0,
            Ast::Signal(name) => self.loops.iter().rev().find(|(n, _)| n == name)?.1,
            Ast::Unary(VerilogOpUnary::Neg, e) => -self.constant(e)?,
            Ast::Unary(VerilogOpUnary::Not, e) => !self.constant(e)?,
            Ast::Binary(a, op, b) => {
                let (a, b) = (self.constant(a)?, self.constant(b)?);
                match op {
                    VerilogOp::Add => a + b,
                    VerilogOp::Sub => a - b,
                    VerilogOp::Mul => a * b,
                    VerilogOp::Shl if (0..31).contains(&b) => a << b,
                    // The others do not commute with reduction modulo 2^N, which may happen before or after them.
                    _ => return None,
                }
            }
            _ => return None,
        };
        i32::try_from(value).is_ok().then_some(value)
    }

    /// The index of the symbol called `name`, if it is one.
    fn symbol(&self, name: &str) -> Option<usize> {
        self.symbols.find(&resolve(name, self.loops)?)
    }

    /// The type of an expression as its operands tell it; none for a bare literal.
    pub(super) fn natural(&self, e: &Ast) -> Result<Option<Type>, EmitError> {
        if self.constant(e).is_some() {
            return Ok(None);
        }
        Ok(match e {
            Ast::Paren(e) => self.natural(e)?,
            Ast::Literal(l) => literal_value(l).filter(|(_, is_bool)| *is_bool).map(|_| BIT),
            Ast::Signal(name) => match self.symbol(name) {
                Some(k) => Some(self.symbols.list[k].ty.clone()),
                None => self.variant(name).map(|v| v.ty),
            },
            Ast::Cast(_, code) => Some(Type::from_code(*code)),
            Ast::Unary(VerilogOpUnary::Not | VerilogOpUnary::Neg, e) => self.natural(e)?,
            Ast::Unary(..) => Some(BIT),
            Ast::Binary(a, op, b) => match op {
                VerilogOp::Shl | VerilogOp::Shr => self.natural(a)?,
                op if operator(op).1 => match self.natural(a)? {
                    None => self.natural(b)?,
                    known => known,
                },
                _ => Some(BIT),
            },
            Ast::Slice(_, bits, _) => Some(Type::Int { signed: false, bits: *bits }),
            Ast::Index(e, _) => match self.natural(e)? {
                Some(Type::Lanes { bits, .. }) => Some(Type::Int { signed: true, bits }),
                _ => Some(BIT),
            },
            Ast::IndexReplace(e, ..) => self.natural(e)?,
            Ast::Signed(_) | Ast::Unsigned(_) => None,
        })
    }

    fn variant(&self, name: &str) -> Option<Typed> {
        let (owner, variant) = name.split_once('$')?;
        let e = self.symbols.enums.get(owner)?;
        let code = e.variants.iter().position(|v| v == variant)?;
        Some(Typed { ty: Type::Enum(e.clone()), node: Node::Variant(code) })
    }

    /// An expression that must have type `ty`.
    pub(super) fn typed_as(&self, e: &Ast, ty: &Type) -> Result<Typed, EmitError> {
        if let Some(value) = self.constant(e) {
            if !ty.holds(value) {
                let (literal, expected) = (value.to_string(), ty.to_string());
                return Err(EmitError::LiteralRange { at: self.at(), literal, expected });
            }
            return Ok(Typed { ty: ty.clone(), node: Node::Literal(value) });
        }
        let typed = self.typed(e, Some(ty))?;
        if typed.ty == *ty { Ok(typed) } else { self.mismatch(e, &typed.ty, ty) }
    }

    /// An expression of any type; `hint` is the type of a literal.
    pub(super) fn typed(&self, e: &Ast, hint: Option<&Type>) -> Result<Typed, EmitError> {
        if self.constant(e).is_some() {
            return match hint {
                Some(ty) => self.typed_as(e, ty),
                None => Err(EmitError::Untyped { at: self.at(), literal: describe(e) }),
            };
        }
        match e {
            Ast::Paren(e) => self.typed(e, hint),
            Ast::Literal(l) => match literal_value(l) {
                Some((value, true)) => Ok(Typed { ty: BIT, node: Node::Literal(value) }),
                _ => self.unsupported(&format!("the literal {l:x}"), "use an `i32` literal"),
            },
            Ast::Signal(name) => self.signal(name),
            Ast::Cast(e, code) => {
                let value = self.typed(e, None)?;
                let ty = Type::from_code(*code);
                match (&value.ty, &ty) {
                    (Type::Int { .. }, Type::Int { .. } | Type::Lanes { .. }) => {}
                    (Type::Lanes { lanes: a, .. }, Type::Lanes { lanes: b, .. }) if a == b => {}
                    _ => return self.mismatch(e, &value.ty, &ty),
                }
                Ok(Typed { ty, node: Node::Cast(Box::new(value)) })
            }
            Ast::Unary(op, e) => self.unary(op, e, hint),
            Ast::Binary(a, op @ (VerilogOp::Shl | VerilogOp::Shr), k) => {
                let (value, left) = (Box::new(self.typed(a, hint)?), matches!(op, VerilogOp::Shl));
                if matches!(value.ty, Type::Enum(_) | Type::Clock) {
                    return self.wrong("<<", &value.ty, "shift integers or lanes");
                }
                let amount = match self.constant(k) {
                    Some(k) => Index::Constant(
                        usize::try_from(k)
                            .or_else(|_| self.unsupported("a negative shift amount", "shift the other way"))?,
                    ),
                    None => match self.typed(k, None)? {
                        k if matches!(k.ty, Type::Int { signed: false, bits: ..32 }) => Index::Dynamic(Box::new(k)),
                        // Verilator 5.006 takes no wider amount, and dies on some.
                        k => return self.wrong("shift by", &k.ty, "use an unsigned amount of less than 32 bits"),
                    },
                };
                Ok(Typed { ty: value.ty.clone(), node: Node::Shift { left, value, amount } })
            }
            Ast::Binary(a, op, b) => self.binary(a, op, b, hint),
            Ast::Index(e, k) => {
                let value = self.typed(e, None)?;
                let (ty, count) = match value.ty {
                    Type::Int { bits, .. } => (BIT, bits),
                    Type::Lanes { lanes, bits } => (Type::Int { signed: true, bits }, lanes),
                    _ => return self.wrong("get_bit", &value.ty, "select from integers or lanes"),
                };
                let index = self.index(k, count, 1, &value.ty)?;
                Ok(Typed { ty, node: Node::Select(Box::new(value), index) })
            }
            Ast::Slice(e, width, k) => {
                let value = self.typed(e, None)?;
                let Type::Int { bits, .. } = value.ty else {
                    return self.wrong("get_bits", &value.ty, "take bits of integers, of a lane by `get_bit` first");
                };
                let index = self.index(k, bits, *width, &value.ty)?;
                Ok(Typed { ty: Type::Int { signed: false, bits: *width }, node: Node::Slice(Box::new(value), index) })
            }
            Ast::IndexReplace(e, k, v) => {
                let value = self.typed(e, hint)?;
                let (ty, count) = match value.ty {
                    Type::Int { bits, .. } => (BIT, bits),
                    Type::Lanes { lanes, bits } => (Type::Int { signed: true, bits }, lanes),
                    _ => return self.wrong("replace_bit", &value.ty, "replace in integers or lanes"),
                };
                let index = self.index(k, count, 1, &value.ty)?;
                let part = self.typed_as(v, &ty)?;
                Ok(Typed { ty: value.ty.clone(), node: Node::Replace(Box::new(value), index, Box::new(part)) })
            }
            Ast::Signed(_) => self.unsupported("`signed_cast`", "use `bit_cast_to`"),
            Ast::Unsigned(_) => self.unsupported("`unsigned_cast`", "use `bit_cast_to`"),
        }
    }

    fn signal(&self, name: &str) -> Result<Typed, EmitError> {
        if let Some(k) = self.symbol(name) {
            let s = &self.symbols.list[k];
            if s.ty == Type::Clock || matches!(s.role, Role::ChildConstant(..)) {
                return Err(EmitError::Clock { at: self.at(), what: format!("`{name}` is used as data") });
            }
            return Ok(Typed { ty: s.ty.clone(), node: Node::Signal(k) });
        }
        self.variant(name).ok_or_else(|| EmitError::UnknownSignal { at: self.at(), name: name.replace('$', ".") })
    }

    fn unary(&self, op: &VerilogOpUnary, e: &Ast, hint: Option<&Type>) -> Result<Typed, EmitError> {
        let reduction = match op {
            VerilogOpUnary::All => Some("&"),
            VerilogOpUnary::Any => Some("|"),
            VerilogOpUnary::Xor => Some("^"),
            VerilogOpUnary::Not | VerilogOpUnary::Neg => None,
        };
        let value = Box::new(self.typed(e, if reduction.is_some() { None } else { hint })?);
        match (&value.ty, reduction) {
            (Type::Int { .. }, Some(op)) => Ok(Typed { ty: BIT, node: Node::Unary(op, value) }),
            (Type::Int { .. } | Type::Lanes { .. }, None) => {
                let op = if matches!(op, VerilogOpUnary::Not) { "~" } else { "-" };
                Ok(Typed { ty: value.ty.clone(), node: Node::Unary(op, value) })
            }
            (ty, _) => self.wrong(&format!("{op:?}").to_lowercase(), ty, "use integers"),
        }
    }

    fn binary(&self, a: &Ast, op: &VerilogOp, b: &Ast, hint: Option<&Type>) -> Result<Typed, EmitError> {
        let (text, arithmetic) = operator(op);
        let logical = matches!(op, VerilogOp::LogicalAnd | VerilogOp::LogicalOr);
        let ty = match (self.natural(a)?, self.natural(b)?) {
            _ if logical => BIT,
            (Some(ty), _) | (None, Some(ty)) => ty,
            (None, None) => match hint {
                Some(ty) if arithmetic => ty.clone(),
                _ => self.typed(a, None)?.ty,
            },
        };
        let equality = matches!(op, VerilogOp::Eq | VerilogOp::Ne);
        let bitwise = matches!(op, VerilogOp::BitAnd | VerilogOp::BitOr | VerilogOp::BitXor);
        let defined = match ty {
            Type::Int { .. } => true,
            Type::Lanes { .. } => equality || bitwise || matches!(op, VerilogOp::Add | VerilogOp::Sub),
            Type::Enum(_) => equality,
            Type::Clock => false,
        };
        if !defined {
            return self.wrong(text, &ty, "use integers, or select a lane first");
        }
        if let (false, false, Some(value)) = (arithmetic, equality || logical, self.constant(b)) {
            // Nothing lies beyond the ends of a format; simulators and synthesis tools warn of such comparisons.
            let beyond = match op {
                VerilogOp::Lt | VerilogOp::Ge => !ty.holds(value - 1),
                _ => !ty.holds(value + 1),
            };
            if ty.holds(value) && beyond {
                let (literal, found) = (value.to_string(), ty.to_string());
                return Err(EmitError::ConstantComparison { at: self.at(), literal, found });
            }
        }
        let (a, b) = (Box::new(self.typed_as(a, &ty)?), Box::new(self.typed_as(b, &ty)?));
        if let (VerilogOp::Lt | VerilogOp::Ge, Type::Int { signed: true, bits }, Node::Literal(0)) = (op, &ty, &b.node)
        {
            // The sign: synthesis makes a whole subtraction of a comparison.
            let sign = Typed { ty: BIT, node: Node::Select(a, Index::Constant(bits - 1)) };
            return Ok(if matches!(op, VerilogOp::Lt) {
                sign
            } else {
                Typed { ty: BIT, node: Node::Unary("~", Box::new(sign)) }
            });
        }
        Ok(Typed { ty: if arithmetic { ty } else { BIT }, node: Node::Binary(text, a, b) })
    }

    /// A bit or lane number, of which `count` exist and `width` are taken. A dynamic one must be a plain signal, because
    /// `.index()` is gone from the syntax tree, and with it the place where Rust changes to 64-bit arithmetic.
    fn index(&self, e: &Ast, count: usize, width: usize, ty: &Type) -> Result<Index, EmitError> {
        if let Some(k) = self.constant(e) {
            return match usize::try_from(k) {
                Ok(k) if k + width <= count => Ok(Index::Constant(k)),
                _ => {
                    let what = if width == 1 { format!("index {k}") } else { format!("range {k} + {width}") };
                    Err(EmitError::IndexRange { at: self.at(), what, found: ty.to_string() })
                }
            };
        }
        let k = self.typed(e, None)?;
        match (&k.node, &k.ty) {
            (Node::Signal(_), Type::Int { bits, .. }) if *bits < 32 => Ok(Index::Dynamic(Box::new(k))),
            (Node::Signal(_), ty) => self.wrong("index by", ty, "use an integer just wide enough for the index"),
            _ => self.unsupported("arithmetic in an index", "compute the index in a `Wire` first"),
        }
    }
}

/// Text of an infix operator, and whether its result has the type of its operands (otherwise it is a bit).
fn operator(op: &VerilogOp) -> (&'static str, bool) {
    match op {
        VerilogOp::Add => ("+", true),
        VerilogOp::Sub => ("-", true),
        VerilogOp::Mul => ("*", true),
        VerilogOp::BitXor => ("^", true),
        VerilogOp::BitAnd => ("&", true),
        VerilogOp::BitOr => ("|", true),
        VerilogOp::Shl => ("<<", true),
        VerilogOp::Shr => (">>", true),
        VerilogOp::LogicalAnd => ("&&", false),
        VerilogOp::LogicalOr => ("||", false),
        VerilogOp::Eq => ("==", false),
        VerilogOp::Ne => ("!=", false),
        VerilogOp::Lt => ("<", false),
        VerilogOp::Le => ("<=", false),
        VerilogOp::Gt => (">", false),
        VerilogOp::Ge => (">=", false),
    }
}

/// An expression in a message, near enough to the source for a person to find it.
pub(super) fn describe(e: &Ast) -> String {
    match e {
        Ast::Signal(name) => format!("`{}`", name.replace('$', ".")),
        Ast::Literal(l) => literal_value(l).map_or(format!("{l:x}"), |(v, _)| v.to_string()),
        Ast::Paren(e) => describe(e),
        Ast::Binary(a, op, b) => format!("{} {} {}", describe(a), operator(op).0, describe(b)),
        Ast::Unary(VerilogOpUnary::Neg, e) => format!("-{}", describe(e)),
        Ast::Unary(VerilogOpUnary::Not, e) => format!("!{}", describe(e)),
        Ast::Unary(_, e) | Ast::Signed(e) | Ast::Unsigned(e) | Ast::Cast(e, _) => {
            format!("an operation on {}", describe(e))
        }
        Ast::Index(e, _) => format!("a bit or lane of {}", describe(e)),
        Ast::Slice(e, ..) => format!("bits of {}", describe(e)),
        Ast::IndexReplace(e, ..) => format!("{} with one part replaced", describe(e)),
    }
}
