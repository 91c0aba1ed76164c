// SPDX-License-Identifier: MIT OR Apache-2.0
//! The small functions at the head of a module. A call is self-determined: its arguments are taken at the width of the
//! formals and its result has its own width, so nothing around it can change its value.

use super::types::{BIT, Type, bits_for};
use std::collections::BTreeMap;

/// The functions that one module uses, by name.
#[derive(Default)]
pub(super) struct Functions(pub BTreeMap<String, String>);

/// An unsigned format of `bits` bits.
pub(super) fn unsigned(bits: usize) -> Type {
    Type::Int { signed: false, bits }
}

/// Statement that takes the lane of number `k` out of `x` into `y`, for one lane `i` at a time.
const LOOP: &str = "for (i = 0; i < LANES; i = i + 1)";

impl Functions {
    /// Adds a function and gives its name. `WIDTH`, `BITS` and `LANES` in the body stand for the measures of `of`, `f`
    /// for the function's own name.
    fn add(&mut self, name: String, result: &Type, arguments: &[(&str, &Type)], of: &Type, body: &str) -> String {
        if !self.0.contains_key(&name) {
            let list: Vec<String> = arguments.iter().map(|(n, ty)| format!("input {}{n}", ty.full_range())).collect();
            let (lanes, bits) = match of {
                Type::Lanes { lanes, bits } => (*lanes, *bits),
                ty => (1, ty.width()),
            };
            let body = body
                .replace("FOR", LOOP)
                .replace("LANES", &lanes.to_string())
                .replace("BITS", &bits.to_string())
                .replace("LAST", &(of.width() - 1).to_string())
                .replace("RESULT", &name);
            let mut text = format!("    function automatic {}{name}({});\n", result.full_range(), list.join(", "));
            for line in body.lines() {
                text += &format!("        {}\n", line.trim());
            }
            self.0.insert(name.clone(), text + "    endfunction\n");
        }
        name
    }

    /// Integer to integer of another width.
    pub(super) fn resize(&mut self, from: &Type, to: &Type) -> String {
        let (old, new) = (from.width(), to.width());
        let body = if new < old {
            format!("RESULT = x[{}:0];", new - 1)
        } else if from.is_signed() {
            format!("RESULT = {{{{{}{{x[LAST]}}}}, x}};", new - old)
        } else {
            format!("RESULT = {{{}'d0, x}};", new - old)
        };
        self.add(format!("{}_to_{}", from.short(), to.short()), to, &[("x", from)], from, &body)
    }

    /// Lanes to lanes of another width.
    pub(super) fn resize_lanes(&mut self, from: &Type, to: &Type) -> String {
        let (Type::Lanes { bits: old, .. }, Type::Lanes { bits: new, .. }) = (from, to) else {
            return String::new();
        };
        let lane = if new < old {
            format!("x[i * {old} +: {new}]")
        } else {
            format!("{{{{{}{{x[i * {old} + {}]}}}}, x[i * {old} +: {old}]}}", new - old, old - 1)
        };
        let body = format!("integer i;\nFOR RESULT[i * {new} +: {new}] = {lane};");
        self.add(format!("{}_to_{}", from.short(), to.short()), to, &[("x", from)], from, &body)
    }

    /// Sum, difference or negation of lanes.
    pub(super) fn lane_by_lane(&mut self, op: &str, ty: &Type, operands: usize) -> String {
        let (name, right) = match (op, operands) {
            ("+", _) => ("add", "x[i * BITS +: BITS] + y[i * BITS +: BITS]"),
            (_, 1) => ("neg", "-x[i * BITS +: BITS]"),
            _ => ("sub", "x[i * BITS +: BITS] - y[i * BITS +: BITS]"),
        };
        let body = format!("integer i;\nFOR RESULT[i * BITS +: BITS] = {right};");
        self.add(format!("{}_{name}", ty.short()), ty, &[("x", ty), ("y", ty)][..operands], ty, &body)
    }

    /// Shift of lanes.
    pub(super) fn shift_lanes(&mut self, left: bool, ty: &Type, amount: &Type) -> String {
        let (name, right) = match left {
            true => ("shl", "x[i * BITS +: BITS] << k"),
            false => ("shr", "$signed(x[i * BITS +: BITS]) >>> k"),
        };
        let body = format!("integer i;\nFOR RESULT[i * BITS +: BITS] = {right};");
        self.add(format!("{}_{name}_{}", ty.short(), amount.short()), ty, &[("x", ty), ("k", amount)], ty, &body)
    }

    /// One bit of an integer, or one lane.
    pub(super) fn select(&mut self, from: &Type, to: &Type, index: &Type) -> String {
        if matches!(from, Type::Int { .. }) {
            return self.slice(from, &BIT, index);
        }
        let pad = number(index);
        let body =
            format!("integer i;\nRESULT = {}'d0;\nFOR\nif ({pad} == i) RESULT = x[i * BITS +: BITS];", to.width());
        let name = format!("{}_lane_{}", from.short(), index.short());
        self.add(name, to, &[("x", from), ("k", index)], from, &body)
    }

    /// Some bits of an integer.
    pub(super) fn slice(&mut self, from: &Type, to: &Type, index: &Type) -> String {
        let body = format!("reg [LAST:0] y;\ny = x >> k;\nRESULT = y[{}:0];", to.width() - 1);
        let name = format!("{}_bits{}_{}", from.short(), to.width(), index.short());
        self.add(name, to, &[("x", &unsigned(from.width())), ("k", index)], from, &body)
    }

    /// One bit or lane replaced.
    pub(super) fn replace(&mut self, ty: &Type, part: &Type, index: &Type) -> String {
        let (whole, pad) = (unsigned(ty.width()), number(index));
        let (formal, body) = match ty {
            Type::Lanes { .. } => {
                (ty, format!("integer i;\nFOR\nRESULT[i * BITS +: BITS] = ({pad} == i) ? v : x[i * BITS +: BITS];"))
            }
            _ => {
                (&whole, format!("integer i;\nfor (i = 0; i <= LAST; i = i + 1)\nRESULT[i] = ({pad} == i) ? v : x[i];"))
            }
        };
        let name = format!("{}_replace_{}", ty.short(), index.short());
        self.add(name, ty, &[("x", formal), ("k", index), ("v", &unsigned(part.width()))], ty, &body)
    }
}

/// The index `k` as a number that can be compared with an `integer`.
fn number(index: &Type) -> String {
    format!("{{{}'d0, k}}", 32 - index.width())
}

/// The format of a constant index.
pub(super) fn index_type(k: usize) -> Type {
    unsigned(bits_for(k))
}
