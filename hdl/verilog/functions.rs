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

/// How one lane of a result is computed from the lanes of the arguments, by the number of the lane.
type LaneText<'a> = &'a dyn Fn(usize) -> String;

impl Functions {
    /// Adds a function `name` with the value `body` and gives its name.
    fn add(&mut self, name: String, result: &Type, arguments: &[(&str, &Type)], body: &str) -> String {
        if !self.0.contains_key(&name) {
            let list: Vec<String> = arguments.iter().map(|(n, ty)| format!("input {}{n}", ty.full_range())).collect();
            let text = format!(
                "    function automatic {}{name}({});\n        {name} = {body};\n    endfunction\n",
                result.full_range(),
                list.join(", ")
            );
            self.0.insert(name.clone(), text);
        }
        name
    }

    /// Integer to integer of another width.
    pub(super) fn resize(&mut self, from: &Type, to: &Type) -> String {
        let (old, new) = (from.width(), to.width());
        let body = if new < old {
            format!("x[{}:0]", new - 1)
        } else if from.is_signed() {
            format!("{{{{{}{{x[{}]}}}}, x}}", new - old, old - 1)
        } else {
            format!("{{{}'d0, x}}", new - old)
        };
        self.add(format!("{}_to_{}", from.short(), to.short()), to, &[("x", from)], &body)
    }

    /// Lanes to lanes of another width.
    pub(super) fn resize_lanes(&mut self, from: &Type, to: &Type) -> String {
        let ((lanes, old), (_, new)) = (measures(from), measures(to));
        let body = each_lane(lanes, &|i| {
            let low = i * old;
            if new < old {
                format!("x[{}:{low}]", low + new - 1)
            } else {
                format!("{{{}{{x[{}]}}}}, {}", new - old, low + old - 1, part("x", i, old))
            }
        });
        self.add(format!("{}_to_{}", from.short(), to.short()), to, &[("x", from)], &body)
    }

    /// Sum, difference or negation of lanes.
    pub(super) fn lane_by_lane(&mut self, op: &str, ty: &Type, operands: usize) -> String {
        let name = match (op, operands) {
            ("+", _) => "add",
            (_, 1) => "neg",
            _ => "sub",
        };
        let (lanes, bits) = measures(ty);
        let body = each_lane(lanes, &|i| match operands {
            1 => format!("-{}", part("x", i, bits)),
            _ => format!("{} {op} {}", part("x", i, bits), part("y", i, bits)),
        });
        self.add(format!("{}_{name}", ty.short()), ty, &[("x", ty), ("y", ty)][..operands], &body)
    }

    /// Shift of lanes.
    pub(super) fn shift_lanes(&mut self, left: bool, ty: &Type, amount: &Type) -> String {
        let (lanes, bits) = measures(ty);
        let body = each_lane(lanes, &|i| match left {
            true => format!("{} << k", part("x", i, bits)),
            false => format!("$signed({}) >>> k", part("x", i, bits)),
        });
        let name = format!("{}_{}_{}", ty.short(), if left { "shl" } else { "shr" }, amount.short());
        self.add(name, ty, &[("x", ty), ("k", amount)], &body)
    }

    /// One bit of an integer, or one lane.
    pub(super) fn select(&mut self, from: &Type, to: &Type, index: &Type) -> String {
        if matches!(from, Type::Int { .. }) {
            return self.slice(from, &BIT, index);
        }
        let (lanes, bits) = measures(from);
        let body = choice(0, lanes, index.width(), bits, index.width());
        self.add(format!("{}_lane_{}", from.short(), index.short()), to, &[("x", from), ("k", index)], &body)
    }

    /// Some bits of an integer.
    pub(super) fn slice(&mut self, from: &Type, to: &Type, index: &Type) -> String {
        let whole = unsigned(from.width());
        let body = if whole == *to { "x >> k".into() } else { format!("{}(x >> k)", self.resize(&whole, to)) };
        let name = format!("{}_bits{}_{}", from.short(), to.width(), index.short());
        self.add(name, to, &[("x", &whole), ("k", index)], &body)
    }

    /// One bit or lane replaced.
    pub(super) fn replace(&mut self, ty: &Type, new: &Type, index: &Type) -> String {
        let (whole, new) = (unsigned(ty.width()), unsigned(new.width()));
        let body = match ty {
            Type::Lanes { lanes, bits } => each_lane(*lanes, &|i| {
                let old = part("x", i, *bits);
                if i >> index.width().min(16) == 0 { format!("({}) ? v : {old}", is(i, index)) } else { old }
            }),
            _ if ty.width() == 1 => "v".into(),
            _ => {
                let zeros = ty.width() - 1;
                format!("(x & ~({}'d1 << k)) | ({{{zeros}'d0, v}} << k)", ty.width())
            }
        };
        let name = format!("{}_replace_{}", ty.short(), index.short());
        self.add(name, ty, &[("x", &whole), ("k", index), ("v", &new)], &body)
    }
}

/// Number and width of the lanes of a type that has them.
fn measures(ty: &Type) -> (usize, usize) {
    if let Type::Lanes { lanes, bits } = ty { (*lanes, *bits) } else { (1, ty.width()) }
}

/// Lane `i` of the argument `name`.
fn part(name: &str, i: usize, bits: usize) -> String {
    format!("{name}[{}:{}]", (i + 1) * bits - 1, i * bits)
}

/// The lane among those from `low` that the lowest `digits` bits of the argument `k` tell: bit by bit, which synthesis
/// makes fewer cells of than of one comparison a lane. Some lane also stands for the indexes beyond the last, which the
/// block must not use.
fn choice(low: usize, lanes: usize, digits: usize, bits: usize, width: usize) -> String {
    let Some(digit) = digits.checked_sub(1) else { return part("x", low, bits) };
    let lower = choice(low, lanes, digit, bits, width);
    if digit >= 16 || low + (1 << digit) >= lanes {
        return lower;
    }
    let bit = if width == 1 { "k".into() } else { format!("k[{digit}]") };
    format!("({bit} ? {} : {lower})", choice(low + (1 << digit), lanes, digit, bits, width))
}

/// Whether the argument `k` is `i`.
fn is(i: usize, index: &Type) -> String {
    format!("k == {}", index.literal(i as i128))
}

/// The lanes of a result, the highest first. Each is self-determined in its concatenation.
fn each_lane(lanes: usize, text: LaneText) -> String {
    let list: Vec<String> = (0..lanes).rev().map(|i| format!("\n            {}", text(i))).collect();
    format!("{{{}\n        }}", list.join(","))
}

/// The format of a constant index.
pub(super) fn index_type(k: usize) -> Type {
    unsigned(bits_for(k))
}
