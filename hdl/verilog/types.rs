// SPDX-License-Identifier: MIT OR Apache-2.0
//! The types of signals and expressions, as the emitted Verilog sees them.

use crate::signal::{LANES_SHIFT, SIGNED_FLAG, WIDTH_MASK};
use rust_hdl_core::synth::VCDValue;
use rust_hdl_core::type_descriptor::{TypeDescriptor, TypeKind};
use std::fmt;

/// An enum of states.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct EnumType {
    /// Name without its path.
    pub name: String,
    /// Variants in the order of their codes, without the enum's name.
    pub variants: Vec<String>,
}

/// Type of a signal or expression. `bool` and `U<1>` are one type here, as are `S<N>` and `WideS<N>`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Type {
    /// An integer.
    Int {
        /// Two's complement.
        signed: bool,
        /// Width.
        bits: usize,
    },
    /// A packed vertex of signed lanes.
    Lanes {
        /// Number of lanes.
        lanes: usize,
        /// Width of a lane.
        bits: usize,
    },
    /// A state.
    Enum(EnumType),
    /// Clock and reset.
    Clock,
}

/// One bit.
pub(super) const BIT: Type = Type::Int { signed: false, bits: 1 };

impl Type {
    /// The type of an atom, or what is wrong with it.
    pub(super) fn of(descriptor: &TypeDescriptor) -> Result<Type, String> {
        let name = &descriptor.name;
        let stock = ["Bits::<", "Signed::<", "clock"].iter().any(|s| name.starts_with(s));
        match &descriptor.kind {
            _ if stock => Err(format!("rust-hdl's own type `{name}`")),
            TypeKind::Bits(bits) if *bits > 0 => Ok(Type::Int { signed: false, bits: *bits }),
            TypeKind::Signed(bits) if *bits > 0 => Ok(Type::Int { signed: true, bits: *bits }),
            TypeKind::Enum(variants) => {
                let variants = variants.iter().map(|v| v.rsplit("::").next().unwrap_or(v).into()).collect();
                Ok(Type::Enum(EnumType { name: name.clone(), variants }))
            }
            TypeKind::Composite(_) if name == "ClockReset" => Ok(Type::Clock),
            TypeKind::Composite(fields) => {
                let width = |k: usize| match fields[k].kind.kind {
                    TypeKind::Signed(bits) if fields[k].fieldname == k.to_string() => Some(bits),
                    _ => None,
                };
                match (0..fields.len()).map(width).reduce(|a, b| if a == b { a } else { None }) {
                    Some(Some(bits)) => Ok(Type::Lanes { lanes: fields.len(), bits }),
                    _ => Err(format!("the composite type `{name}`")),
                }
            }
            _ => Err(format!("the empty type `{name}`")),
        }
    }

    /// The type behind the code that `Synth::bits` returns (see [`crate::signal::SIGNED_FLAG`]).
    pub(super) fn from_code(code: usize) -> Type {
        let (bits, lanes) = (code & WIDTH_MASK, code >> LANES_SHIFT);
        if lanes > 0 { Type::Lanes { lanes, bits } } else { Type::Int { signed: code & SIGNED_FLAG != 0, bits } }
    }

    /// Total width.
    pub(super) fn width(&self) -> usize {
        match self {
            Type::Int { bits, .. } => *bits,
            Type::Lanes { lanes, bits } => lanes * bits,
            Type::Enum(e) => bits_for(e.variants.len() - 1),
            Type::Clock => 2,
        }
    }

    /// Whether a vector of this type is declared `signed`.
    pub(super) fn is_signed(&self) -> bool {
        matches!(self, Type::Int { signed: true, .. })
    }

    /// `signed [7:0] `, or nothing for one bit.
    pub(super) fn range(&self) -> String {
        if *self == BIT { String::new() } else { self.full_range() }
    }

    /// `signed [7:0] `, and `[0:0] ` for one bit, so that its bits can always be selected.
    pub(super) fn full_range(&self) -> String {
        format!("{}[{}:0] ", if self.is_signed() { "signed " } else { "" }, self.width() - 1)
    }

    /// Part of a function's name: `s8`, `u8`, `lanes9x46`.
    pub(super) fn short(&self) -> String {
        match self {
            Type::Int { signed, bits } => format!("{}{bits}", if *signed { 's' } else { 'u' }),
            Type::Lanes { lanes, bits } => format!("lanes{lanes}x{bits}"),
            Type::Enum(e) => e.name.to_lowercase(),
            Type::Clock => "clock".into(),
        }
    }

    /// Whether the integer type holds `value`.
    pub(super) fn holds(&self, value: i128) -> bool {
        match *self {
            Type::Int { signed: true, bits } => value >> (bits - 1) == 0 || value >> (bits - 1) == -1,
            Type::Int { signed: false, bits } => value >= 0 && value >> bits.min(127) == 0,
            _ => false,
        }
    }

    /// A constant of this type in Verilog, from the value's VCD form.
    pub(super) fn constant(&self, value: &VCDValue) -> Option<String> {
        if let (Type::Enum(e), VCDValue::String(variant)) = (self, value) {
            let code = e.variants.iter().position(|v| v == variant)?;
            return Some(format!("{}'d{code}", self.width()));
        }
        let bits = bits_of(value)?;
        if bits.len() != self.width() {
            return None;
        }
        let small = bits.len() <= 127 && matches!(self, Type::Int { .. });
        if small {
            let start = if self.is_signed() && bits[0] { -1 } else { 0 };
            return Some(self.literal(bits.iter().fold(start, |a, &b| (a << 1) | i128::from(b))));
        }
        Some(format!("{}'h{}", bits.len(), hexadecimal(&bits)))
    }

    /// A literal of this integer type; at its own width it has the right value, so it is never printed in a wider
    /// context.
    pub(super) fn literal(&self, value: i128) -> String {
        let (width, sign) = (self.width(), if self.is_signed() { "s" } else { "" });
        let magnitude = value.unsigned_abs();
        match (*self == BIT, value < 0) {
            (true, _) => format!("1'b{value}"),
            (false, false) if magnitude < 1 << 40 => format!("{width}'{sign}d{magnitude}"),
            (false, true) if magnitude < 1 << 40 => format!("(-{width}'{sign}d{magnitude})"),
            _ => {
                let bits: Vec<bool> = (0..width).rev().map(|k| (value >> k) & 1 == 1).collect();
                format!("{width}'{sign}h{}", hexadecimal(&bits))
            }
        }
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Type::Int { signed: false, bits: 1 } => write!(f, "bit"),
            Type::Int { signed, bits } => write!(f, "{} {bits}", if *signed { "signed" } else { "unsigned" }),
            Type::Lanes { lanes, bits } => write!(f, "{lanes} x signed {bits}"),
            Type::Enum(e) => write!(f, "{}: {}", e.name, e.variants.join(" ")),
            Type::Clock => write!(f, "ClockReset"),
        }
    }
}

/// Bits that hold the number `largest`; at least one.
pub(super) fn bits_for(largest: usize) -> usize {
    (usize::BITS - largest.leading_zeros()).max(1) as usize
}

/// Bits of a value, most significant first; the fields of a composite stand from the least significant upwards.
fn bits_of(value: &VCDValue) -> Option<Vec<bool>> {
    match value {
        VCDValue::Single(v) => Some(vec![*v == vcd::Value::V1]),
        VCDValue::Vector(v) => Some(v.iter().map(|b| *b == vcd::Value::V1).collect()),
        VCDValue::Composite(fields) => {
            let parts: Option<Vec<Vec<bool>>> = fields.iter().rev().map(|f| bits_of(f)).collect();
            Some(parts?.concat())
        }
        VCDValue::String(_) => None,
    }
}

fn hexadecimal(bits: &[bool]) -> String {
    let digit = |c: &[bool]| char::from_digit(c.iter().fold(0, |a, &b| 2 * a + u32::from(b)), 16).unwrap_or('0');
    let mut digits: Vec<char> = bits.rchunks(4).map(digit).collect();
    digits.reverse();
    digits.into_iter().collect()
}
