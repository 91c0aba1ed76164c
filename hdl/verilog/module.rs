// SPDX-License-Identifier: MIT OR Apache-2.0
//! One module: ports, constants, declarations, children and the kernel's pieces.

use super::analysis::{check as check_order, visit, without_overwritten};
use super::body::WITH_CALLS;
use super::functions::Functions;
use super::groups::{Group, is_assign, moving, split};
use super::names::flat;
use super::print::Printer;
use super::scope::Scope;
use super::stmt::{Kernel, lower};
use super::symbols::{Role, Symbols};
use super::types::Type;
use super::{Direction, EmitError, Module, PortInfo};
use rust_hdl_core::ast::Verilog;
use std::collections::{BTreeMap, BTreeSet};

/// The module of one block. `instances` are the modules of its children, where they are modules.
pub(super) fn module(scope: &Scope, name: &str, instances: &[Option<&Module>]) -> Result<Module, EmitError> {
    let block = format!("{} ({name})", scope.path);
    let mut symbols = Symbols::of(scope, &block)?;
    let refuse = |what: &str, remedy: &str| {
        Err(EmitError::Unsupported { at: block.clone(), what: what.into(), remedy: remedy.into() })
    };
    let children: Vec<String> = scope.children.iter().map(|c| c.name.clone()).collect();
    let (mut kernel, custom) = match &scope.hdl {
        Verilog::Combinatorial(statements) => (lower(&symbols, &children, statements)?, None),
        Verilog::Custom(text) if scope.children.is_empty() => (Kernel::default(), Some(code_of(text))),
        Verilog::Custom(_) => return refuse("a custom text over children", "give the block a kernel"),
        Verilog::Empty => return refuse("a block without a kernel", "put `#[hdl_gen]` above `update`"),
        Verilog::Blackbox(_) => return refuse("a black box", "write a kernel or an inlined primitive"),
        Verilog::Wrapper(_) => return refuse("a wrapper", "write a kernel or an inlined primitive"),
    };
    if custom.is_none() {
        check_order(&symbols, &kernel.body, |k| is_tied(&symbols, scope, k))?;
        kernel.body = without_overwritten(&kernel.body);
    }
    for (k, symbol) in symbols.list.iter().enumerate() {
        if matches!(symbol.role, Role::ChildClock(c) if !kernel.clocked.contains(&c)) {
            return Err(EmitError::Undriven { at: block, signal: symbols.list[k].key.replace('$', ".") });
        }
    }
    let ports = ports(&symbols);
    let groups = split(&symbols, &kernel.body);
    let mut parts = Parts { scope, symbols: &symbols, kernel: &kernel, groups: &groups, driven: BTreeSet::new() };
    parts.driven = groups.iter().flat_map(|g| g.targets.iter().copied()).collect();
    let mut printer = Printer { symbols: &symbols, functions: Functions::default(), compares_constants: false };
    let (mut logic, moving) = (String::new(), moving(&symbols, &groups));
    for group in &groups {
        let mut text = printer.group(group);
        if text.contains(WITH_CALLS) && group.targets.is_disjoint(&moving) {
            let signal = group.targets.first().map_or("", |k| &symbols.list[*k].name);
            return refuse(&format!("a choice between constants for `{signal}`"), "hold the result in a `Constant`");
        }
        if !group.targets.is_disjoint(&moving) {
            // Icarus 11 may never settle a module that has groups of both kinds.
            text = text.replacen("    always_comb begin", &format!("    {WITH_CALLS} begin"), 1);
        }
        logic += &text;
    }
    let pasted = parts.pasted();
    let functions = printer.functions.0;
    let mut source = parts.head(name, custom.is_some());
    if printer.compares_constants {
        let reason = "// A constant at the end of its range decides a comparison at this width set.";
        source += &format!("\n    /* verilator lint_off CMPCONST */ {reason}\n");
        source += &format!("    /* verilator lint_off UNSIGNED */ {reason}\n");
    }
    for section in [
        parts.constants(),
        function_section(&functions),
        parts.declarations(),
        pasted.text.clone(),
        parts.instances(instances),
        custom.clone().unwrap_or(logic),
        if custom.is_some() { String::new() } else { parts.unused(&pasted.text) },
    ] {
        if !section.is_empty() {
            source += &format!("\n{section}");
        }
    }
    for function in functions.keys() {
        symbols.names.take(&block, function, "a function of the back-end")?;
    }
    for (local, owner) in pasted.names {
        symbols.names.take(&block, &local, &owner)?;
    }
    symbols.names.take(&block, "unused", "the list of unused signals")?;
    Ok(Module { name: name.into(), source: source + "\nendmodule\n\n`default_nettype wire\n", ports })
}

/// The functions; some take parts of their arguments, which is what they are for.
fn function_section(functions: &BTreeMap<String, String>) -> String {
    let text = functions.values().cloned().collect::<Vec<_>>().join("\n");
    let off = "/* verilator lint_off UNUSEDSIGNAL */ // A function may take a part of its argument and leave the rest.";
    let on = "/* verilator lint_on UNUSEDSIGNAL */";
    if text.is_empty() { text } else { format!("    {off}\n{text}    {on}\n") }
}

/// A primitive's `enable` that the kernel never drives is high.
fn is_tied(symbols: &Symbols, scope: &Scope, k: usize) -> bool {
    let symbol = &symbols.list[k];
    matches!(symbol.role, Role::ChildInput(c)
        if scope.children[c].inline_text().is_some() && symbol.key.ends_with("$enable"))
}

/// A text without its lines of memory contents, indented.
fn code_of(text: &str) -> String {
    let lines = text.lines().filter(|l| !l.starts_with("//hex ") && !l.is_empty());
    lines.map(|l| format!("    {l}\n")).collect()
}

fn ports(symbols: &Symbols) -> Vec<PortInfo> {
    let mut ports = vec![];
    for symbol in &symbols.list {
        match &symbol.role {
            Role::Clock => {
                for (k, name) in ["clock", "reset"].into_iter().enumerate() {
                    let (name, direction) = (name.into(), Direction::Input);
                    ports.insert(k, PortInfo { name, bits: 1, direction, signed: false, lanes: 0 });
                }
            }
            Role::Port(direction) => {
                let lanes = if let Type::Lanes { lanes, .. } = symbol.ty { lanes } else { 0 };
                ports.push(PortInfo {
                    name: symbol.name.clone(),
                    bits: symbol.ty.width(),
                    direction: *direction,
                    signed: symbol.ty.is_signed() || lanes > 0,
                    lanes,
                });
            }
            _ => {}
        }
    }
    ports
}

/// Texts of the inlined primitives, and the further names that they declare.
struct Pasted {
    text: String,
    names: Vec<(String, String)>,
}

struct Parts<'a> {
    scope: &'a Scope,
    symbols: &'a Symbols,
    kernel: &'a Kernel,
    groups: &'a [Group],
    driven: BTreeSet<usize>,
}

impl Parts<'_> {
    /// `wire` for what an `assign` or an instance drives, `logic` for what an `always_comb` drives.
    fn net(&self, k: usize) -> &'static str {
        let group = self.groups.iter().find(|g| g.targets.contains(&k));
        if group.is_some_and(|g| !is_assign(g)) { "logic" } else { "wire " }
    }

    fn head(&self, name: &str, custom: bool) -> String {
        let mut lines: Vec<(String, String)> = vec![];
        for (k, symbol) in self.symbols.list.iter().enumerate() {
            let (declaration, comment) = match symbol.role {
                Role::Clock => {
                    lines.insert(0, ("input  wire  clock".into(), "rising edge".into()));
                    lines.insert(1, ("input  wire  reset".into(), "synchronous, active high".into()));
                    continue;
                }
                Role::Port(Direction::Input) => (format!("input  wire  {}", symbol.ty.range()), &symbol.ty),
                Role::Port(Direction::Output) => {
                    let net = if custom { "logic" } else { self.net(k) };
                    (format!("output {net} {}", symbol.ty.range()), &symbol.ty)
                }
                _ => continue,
            };
            lines.push((declaration + &symbol.name, comment.to_string()));
        }
        let mut out = format!(
            "// SPDX-License-Identifier: MIT OR Apache-2.0\n// Emitted by relief-hdl; edit the block's Rust source instead.\n\
             `default_nettype none\n\nmodule {name} (\n"
        );
        let (count, width) = (lines.len(), lines.iter().map(|l| l.0.len()).max().unwrap_or(0) + 1);
        for (k, (text, comment)) in lines.into_iter().enumerate() {
            let text = text + if k + 1 < count { "," } else { "" };
            out += &format!("    {text:width$} // {comment}\n");
        }
        out + ");\n"
    }

    fn constants(&self) -> String {
        let mut out = String::new();
        for e in self.symbols.enums.values() {
            let ty = Type::Enum(e.clone());
            let reason = "// The whole encoding stands here, for the reader of waveforms.";
            out += &format!("    /* verilator lint_off UNUSEDPARAM */ {reason}\n");
            for (code, variant) in e.variants.iter().enumerate() {
                let width = ty.width();
                out += &format!("    localparam {}{}_{variant} = {width}'d{code};\n", ty.full_range(), e.name);
            }
            out += "    /* verilator lint_on UNUSEDPARAM */\n";
        }
        let mut read = BTreeSet::new();
        visit(&self.kernel.body, &mut |_| {}, &mut |k, _| _ = read.insert(k));
        for (k, symbol) in self.symbols.list.iter().enumerate() {
            if let (Role::Constant(value), true) | (Role::ChildConstant(_, value), _) =
                (&symbol.role, read.contains(&k))
            {
                out += &format!("    localparam {}{} = {value}; // {}\n", symbol.ty.range(), symbol.name, symbol.ty);
            }
        }
        out
    }

    fn declarations(&self) -> String {
        let mut out = String::new();
        for (k, symbol) in self.symbols.list.iter().enumerate() {
            let net = match symbol.role {
                Role::Wire | Role::ChildInput(_) if self.driven.contains(&k) => self.net(k),
                Role::ChildOutput(c) if self.scope.children[c].inline_text().is_some() => "reg  ",
                Role::ChildOutput(_) => "wire ",
                _ => continue,
            };
            out += &format!("    {net} {}{}; // {}\n", symbol.ty.range(), symbol.name, symbol.ty);
        }
        out
    }

    fn pasted(&self) -> Pasted {
        let mut pasted = Pasted { text: String::new(), names: vec![] };
        for child in &self.scope.children {
            let Some(text) = child.inline_text() else { continue };
            let prefix = format!("{}_", flat(&child.name));
            let mut text = code_of(text);
            let enable = self.symbols.find(&format!("{}$enable", child.name));
            if enable.is_some_and(|k| !self.driven.contains(&k)) {
                text = text.replace("if (@enable) ", "").replace("@enable", "1'b1");
            }
            let own = format!("{}$", child.name);
            let known = |name: &String| self.symbols.list.iter().any(|s| s.name == *name && s.key.starts_with(&own));
            let mut locals = BTreeSet::new();
            for (k, piece) in text.split('@').enumerate() {
                let word = piece.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next().unwrap_or("");
                // `@(` is Verilog's own.
                pasted.text += if k == 0 {
                    ""
                } else if word.is_empty() {
                    "@"
                } else {
                    &prefix
                };
                pasted.text += piece;
                locals.extend(Some(format!("{prefix}{word}")).filter(|n| k > 0 && !word.is_empty() && !known(n)));
            }
            pasted.names.extend(locals.into_iter().map(|n| (n, format!("a part of {}", child.name))));
        }
        pasted
    }

    fn instances(&self, modules: &[Option<&Module>]) -> String {
        let mut out = String::new();
        for (child, module) in self.scope.children.iter().zip(modules) {
            let Some(module) = module else { continue };
            let prefix = flat(&child.name);
            let pin = |port: &PortInfo| match port.name.as_str() {
                name @ ("clock" | "reset") => format!("        .{name}({name})"),
                name => format!("        .{name}({prefix}_{name})"),
            };
            let pins: Vec<String> = module.ports.iter().map(pin).collect();
            out += &format!("    {} {prefix} (\n{}\n    );\n", module.name, pins.join(",\n"));
        }
        out
    }

    /// Signals that nothing reads as a whole, gathered in one place under a name that linters know.
    fn unused(&self, pasted: &str) -> String {
        let mut whole = BTreeSet::new();
        visit(&self.kernel.body, &mut |_| {}, &mut |k, all| {
            if all {
                whole.insert(k);
            }
        });
        let mut list: Vec<String> = vec![];
        for (k, symbol) in self.symbols.list.iter().enumerate() {
            let driven = match symbol.role {
                Role::Port(Direction::Input) | Role::ChildOutput(_) => true,
                Role::Wire => self.driven.contains(&k),
                Role::Clock => {
                    let clocked = |c: &usize| self.scope.children[*c].inline_text().is_none();
                    let instance = self.kernel.clocked.iter().any(clocked);
                    list.extend(
                        ["clock", "reset"].map(String::from).into_iter().filter(|n| !instance && !has_word(pasted, n)),
                    );
                    false
                }
                _ => false,
            };
            if driven && !whole.contains(&k) {
                list.push(symbol.name.clone());
            }
        }
        let more = |list: &[String]| list.join(", ");
        if list.is_empty() { String::new() } else { format!("    wire unused = &{{1'b0, {}}};\n", more(&list)) }
    }
}

fn has_word(text: &str, word: &str) -> bool {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|w| w == word)
}
