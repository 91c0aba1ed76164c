// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writes random kernels for `tests/verilog_fuzz.rs`. They must exist as source, because only the real kernel macro
//! turns source into the syntax tree that the back-end reads. Another seed: `RELIEF_FUZZ_SEED=7 cargo test`.

use std::fmt::Write as _;

const KERNELS: usize = 120;
const DEPTH: usize = 5;

/// A signal type. `WS` and `WU` are the wide integers.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Ty {
    Bit,
    S(usize),
    U(usize),
    WS(usize),
    WU(usize),
    Lanes(usize, usize),
}
use Ty::{Bit, Lanes, S, U, WS, WU};

impl Ty {
    fn text(self) -> String {
        match self {
            Bit => "bool".into(),
            S(n) => format!("S<{n}>"),
            U(n) => format!("U<{n}>"),
            WS(n) => format!("WideS<{n}>"),
            WU(n) => format!("WideU<{n}>"),
            Lanes(l, w) => format!("Lanes<{l}, {w}>"),
        }
    }
    /// Width of an integer.
    fn bits(self) -> usize {
        match self {
            Bit => 1,
            S(n) | U(n) | WS(n) | WU(n) => n,
            Lanes(..) => 0,
        }
    }
    fn integer(self) -> bool {
        !matches!(self, Bit | Lanes(..))
    }
    fn signed(self) -> bool {
        matches!(self, S(_) | WS(_))
    }
}

struct Generator {
    state: u64,
    /// Readable signals: name and type.
    signals: Vec<(String, Ty)>,
}

impl Generator {
    fn below(&mut self, n: usize) -> usize {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.state ^ (self.state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
    fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
    fn ty(&mut self) -> Ty {
        let small = [1, 2, 3, 5, 8, 9, 16, 17, 24, 31, 32, 33, 46, 62, 63];
        let wide = [1, 8, 40, 63, 64, 65, 90, 126, 127];
        match self.below(12) {
            0 => Bit,
            1..=3 => S(self.pick(&small)),
            4..=5 => U(self.pick(&small)),
            6..=7 => WS(self.pick(&wide)),
            8 => WU(self.pick(&wide)),
            _ => Lanes(self.pick(&[1, 2, 3, 4, 9]), self.pick(&[1, 4, 12, 31, 32, 33, 46, 63])),
        }
    }
    fn signal(&mut self, wanted: impl Fn(Ty) -> bool) -> Option<(String, Ty)> {
        let found: Vec<usize> = (0..self.signals.len()).filter(|&k| wanted(self.signals[k].1)).collect();
        if found.is_empty() {
            return None;
        }
        let k = self.pick(&found);
        Some((format!("self.{}.val()", self.signals[k].0), self.signals[k].1))
    }
    /// A literal that an `i32` and the type hold, not at an end of the type.
    fn literal(&mut self, ty: Ty) -> Option<i64> {
        let limit = 1i64 << (ty.bits() - usize::from(ty.signed())).min(31);
        let value = (self.below(1 << 40) as i64) % limit;
        let value = if ty.signed() && self.below(2) == 0 { -value } else { value };
        (value != limit - 1 && value < i64::from(i32::MAX) && (ty.signed() || value > 0)).then_some(value)
    }
    /// A number below `count`: a constant, or a signal that cannot exceed it.
    fn index(&mut self, count: usize) -> String {
        let fits = |t: Ty| matches!(t, U(n) if n < 10 && 1 << n <= count);
        match self.signal(fits) {
            Some((name, _)) if self.below(2) == 0 => format!("{name}.index()"),
            _ => self.below(count).to_string(),
        }
    }
    /// A leaf of the type: a signal, or a cast of one.
    fn leaf(&mut self, ty: Ty) -> String {
        if let (Some((name, _)), true) = (self.signal(|t| t == ty), self.below(4) != 0) {
            return name;
        }
        self.cast(ty, 0)
    }
    fn cast(&mut self, ty: Ty, depth: usize) -> String {
        let from = match (ty, self.below(3)) {
            (Lanes(l, _), 0) => match self.signal(|t| matches!(t, Lanes(k, _) if k == l)) {
                Some((_, from)) => from,
                None => S(8),
            },
            (_, 1) => self.signal(|t| !matches!(t, Lanes(..))).map_or(S(8), |s| s.1),
            _ => S(self.pick(&[4, 8, 33])),
        };
        let inner = if depth > 0 {
            self.expression(from, depth - 1)
        } else {
            match self.signal(|t| if from.bits() > 0 { t.bits() > 0 } else { t == from }) {
                Some((name, _)) => name,
                None => unreachable!("every kernel has a scalar input"),
            }
        };
        format!("bit_cast_to::<{}>({inner})", ty.text())
    }
    fn expression(&mut self, ty: Ty, depth: usize) -> String {
        if depth == 0 {
            return self.leaf(ty);
        }
        let d = depth - 1;
        let text = match ty {
            Bit => return self.bit(depth),
            Lanes(l, w) => match self.below(10) {
                0..=3 => {
                    let (a, b) = (self.expression(ty, d), self.expression(ty, d));
                    format!("{a} {} {b}", self.pick(&["+", "-", "&", "|", "^"]))
                }
                4 => format!("!{}", self.expression(ty, d)),
                5 => format!("-{}", self.expression(ty, d)),
                6 => self.shift(ty, d),
                7 => {
                    let (a, v) = (self.expression(ty, d), self.expression(S(w), d));
                    return format!("({a}).replace_bit({}, {v})", self.index(l));
                }
                8 => return self.cast(ty, depth),
                _ => return self.leaf(ty),
            },
            _ => match self.below(14) {
                0..=4 => {
                    let a = self.expression(ty, d);
                    let b = match self.literal(ty) {
                        Some(value) if self.below(4) == 0 => value.to_string(),
                        _ => self.expression(ty, d),
                    };
                    format!("{a} {} {b}", self.pick(&["+", "-", "*", "&", "|", "^"]))
                }
                5 => format!("!{}", self.expression(ty, d)),
                6 => format!("-{}", self.expression(ty, d)),
                7 => self.shift(ty, d),
                8 => {
                    let (a, v) = (self.expression(ty, d), self.bit(d));
                    return format!("({a}).replace_bit({}, {v})", self.index(ty.bits()));
                }
                9 | 10 if matches!(ty, U(_)) => {
                    let wide = self.signal(|t| t.integer() && t.bits() >= ty.bits());
                    let from = wide.map_or(WU(ty.bits()), |s| s.1);
                    let value = self.expression(from, d);
                    let index = self.index(from.bits() - ty.bits() + 1);
                    return format!("({value}).get_bits::<{}>({index})", ty.bits());
                }
                9 | 10 if matches!(ty, S(_)) => match self.signal(|t| matches!(t, Lanes(_, w) if S(w) == ty)) {
                    Some((_, from @ Lanes(l, _))) => {
                        let value = self.expression(from, d);
                        return format!("({value}).get_bit({})", self.index(l));
                    }
                    _ => return self.cast(ty, depth),
                },
                9..=12 => return self.cast(ty, depth),
                _ => return self.leaf(ty),
            },
        };
        format!("({text})")
    }
    fn shift(&mut self, ty: Ty, d: usize) -> String {
        let value = self.expression(ty, d);
        let amount = match self.below(3) {
            0 => match self.signal(|t| matches!(t, U(..32))) {
                Some((name, _)) => name,
                None => "1".into(),
            },
            1 => self.expression(U(3), d),
            _ => self.below(70).to_string(),
        };
        format!("{value} {} {amount}", self.pick(&["<<", ">>"]))
    }
    fn bit(&mut self, depth: usize) -> String {
        if depth == 0 {
            return self.leaf(Bit);
        }
        let d = depth - 1;
        let text = match self.below(10) {
            0..=2 => {
                let ty = self.signal(|t| t.integer()).map_or(S(8), |s| s.1);
                let a = self.expression(ty, d);
                let b = match self.literal(ty) {
                    Some(value) if ty.bits() > 1 && self.below(3) == 0 => value.to_string(),
                    _ => self.expression(ty, d),
                };
                format!("{a} {} {b}", self.pick(&["<", "<=", ">", ">=", "==", "!="]))
            }
            3 => {
                let ty = self.signal(|t| matches!(t, Lanes(..))).map_or(Bit, |s| s.1);
                let (a, b) = (self.expression(ty, d), self.expression(ty, d));
                format!("{a} {} {b}", self.pick(&["==", "!="]))
            }
            4 | 5 => {
                let (a, b) = (self.bit(d), self.bit(d));
                format!("{a} {} {b}", self.pick(&["&&", "||", "&", "|", "^", "==", "!=", "<"]))
            }
            6 => format!("!{}", self.bit(d)),
            7 => {
                let ty = self.signal(|t| t.integer()).map_or(S(8), |s| s.1);
                let value = self.expression(ty, d);
                return format!("({value}).{}()", self.pick(&["any", "all", "xor"]));
            }
            8 => {
                let ty = self.signal(|t| t.integer()).map_or(S(8), |s| s.1);
                let value = self.expression(ty, d);
                return format!("({value}).get_bit({})", self.index(ty.bits()));
            }
            _ => {
                let name = self.signal(|_| true).map_or(String::new(), |s| s.0);
                if self.below(2) == 0 {
                    "self.in_state.val() == FuzzState::B".into()
                } else {
                    format!("{name} == {name}")
                }
            }
        };
        format!("({text})")
    }
    /// Statements that drive a signal on every path.
    fn drive(&mut self, name: &str, ty: Ty) -> String {
        let value = |g: &mut Self, d: usize| match g.literal(if ty.integer() { ty } else { S(2) }) {
            Some(v) if ty.integer() && g.below(8) == 0 => format!("self.{name}.next = ({v}).into();"),
            _ => format!("self.{name}.next = {};", g.expression(ty, d)),
        };
        match self.below(5) {
            0 => {
                let (a, b) = (value(self, 3), value(self, 3));
                format!("if self.in_0.val() ^ {} {{ {a} }} else {{ {b} }}", self.bit(3))
            }
            1 => {
                let (a, b, c) = (value(self, 2), value(self, 3), value(self, 2));
                let (p, q) = (self.bit(2), self.bit(3));
                format!("{a}\n        if self.in_0.val() != {p} {{ {b} }} else if {q} {{ {c} }}")
            }
            2 => {
                let (a, b, c) = (value(self, 3), value(self, 3), value(self, 3));
                let rest = self.pick(&["_", "FuzzState::C"]);
                format!(
                    "match self.in_state.val() {{\n            FuzzState::B => {{ {a} }}\n            \
                     FuzzState::A => {{ {b} }}\n            {rest} => {{ {c} }}\n        }}"
                )
            }
            _ => value(self, DEPTH),
        }
    }
    fn kernel(&mut self, k: usize, out: &mut String) {
        let mut fields: Vec<(String, &str, Ty)> = vec![];
        self.signals.clear();
        let fixed = [Bit, S(8), U(3), U(2)];
        for i in 0..9 {
            let ty = if i < fixed.len() { fixed[i] } else { self.ty() };
            fields.push((format!("in_{i}"), "Input", ty));
        }
        for i in 0..2 {
            fields.push((format!("constant_{i}"), "Constant", self.ty()));
        }
        self.signals.extend(fields.iter().map(|(n, _, t)| (n.clone(), *t)));
        let mut body = String::new();
        for i in 0..7 {
            let (kind, name) = if i < 3 { ("Wire", format!("wire_{i}")) } else { ("Output", format!("out_{i}")) };
            let ty = self.ty();
            writeln!(body, "        {}", self.drive(&name, ty)).unwrap();
            self.signals.push((name.clone(), ty));
            fields.push((name, kind, ty));
        }
        let declared: String = fields.iter().map(|(n, kind, t)| format!("    {n}: {kind}<{}>,\n", t.text())).collect();
        let built: String = fields
            .iter()
            .map(|(n, kind, _)| match *kind {
                "Constant" => format!("            {n}: Constant::new(Random::random(&mut rng)),\n"),
                _ => format!("            {n}: Default::default(),\n"),
            })
            .collect();
        let drawn: String = fields
            .iter()
            .filter(|f| f.1 == "Input")
            .map(|(n, ..)| format!("        self.{n}.next = Random::random(rng);\n"))
            .collect();
        writeln!(
            out,
            "#[derive(LogicBlock)]\nstruct Fuzz{k} {{\n    in_state: Input<FuzzState>,\n{declared}}}\n\
             impl Default for Fuzz{k} {{\n    fn default() -> Self {{\n        let mut rng = Rng({k});\n        Self {{\n            \
             in_state: Default::default(),\n{built}        }}\n    }}\n}}\n\
             impl Logic for Fuzz{k} {{\n    #[hdl_gen]\n    fn update(&mut self) {{\n{body}    }}\n    \
             fn timing(&self) -> Vec<TimingInfo> {{\n        module_name(\"fuzz_{k}\")\n    }}\n}}\n\
             impl Dut for Fuzz{k} {{\n    fn randomize(&mut self, rng: &mut Rng) {{\n        \
             self.in_state.next = Random::random(rng);\n{drawn}    }}\n}}\n"
        )
        .unwrap();
    }
}

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=RELIEF_FUZZ_SEED");
    let seed = std::env::var("RELIEF_FUZZ_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
    let mut generator = Generator { state: seed, signals: vec![] };
    let mut out = String::new();
    for k in 0..KERNELS {
        generator.kernel(k, &mut out);
    }
    let list: String = (0..KERNELS).map(|k| format!("        Box::new(Fuzz{k}::default()),\n")).collect();
    writeln!(out, "const SEED: u64 = {seed};\nfn kernels() -> Vec<Box<dyn Dut>> {{\n    vec![\n{list}    ]\n}}")
        .unwrap();
    let folder = std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    std::fs::write(std::path::Path::new(&folder).join("fuzz_kernels.rs"), out).expect("OUT_DIR can be written");
}
