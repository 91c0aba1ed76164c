// SPDX-License-Identifier: MIT OR Apache-2.0
//! Statements in Verilog.

use super::groups::Group;
use super::print::Printer;
use super::stmt::{Arm, Stmt};
use super::types::Type;

/// How a group with function calls begins.
pub(super) const WITH_CALLS: &str = "always @(*)";

impl Printer<'_> {
    /// One group.
    pub(super) fn group(&mut self, group: &Group) -> String {
        match group.body.as_slice() {
            [Stmt::Assign { target, value }] => {
                format!("    assign {} = {};\n", self.symbols.list[*target].name, self.top(value))
            }
            body => {
                let mut text = String::new();
                self.statements(body, 2, &mut text);
                // Icarus 11 makes an `always_comb` wait for the arguments inside the functions that it calls, and so
                // for itself. `always @(*)` does not; it needs something that changes, which the caller has checked.
                let calls = self.functions.0.keys().any(|f| text.contains(&format!("{f}(")));
                format!("    {} begin\n{text}    end\n", if calls { WITH_CALLS } else { "always_comb" })
            }
        }
    }

    fn statements(&mut self, body: &[Stmt], depth: usize, out: &mut String) {
        let pad = "    ".repeat(depth);
        for statement in body {
            match statement {
                Stmt::Assign { target, value } => {
                    *out += &format!("{pad}{} = {};\n", self.symbols.list[*target].name, self.top(value));
                }
                Stmt::If { .. } => {
                    *out += &pad;
                    self.conditional(statement, depth, out);
                }
                Stmt::Match { test, arms } => {
                    *out += &format!("{pad}case ({})\n", self.top(test));
                    for (k, arm) in arms.iter().enumerate() {
                        // A match is complete: its last arm is the rest, also of codes that no variant has.
                        let last = k + 1 == arms.len();
                        self.arm(arm, last, &test.ty, depth + 1, out);
                    }
                    *out += &format!("{pad}endcase\n");
                }
            }
        }
    }

    fn conditional(&mut self, statement: &Stmt, depth: usize, out: &mut String) {
        let Stmt::If { test, then, otherwise } = statement else { return };
        let pad = "    ".repeat(depth);
        *out += &format!("if ({}) begin\n", self.top(test));
        self.statements(then, depth + 1, out);
        *out += &format!("{pad}end");
        match otherwise.as_slice() {
            [] => *out += "\n",
            [chained @ Stmt::If { .. }] => {
                *out += " else ";
                self.conditional(chained, depth, out);
            }
            other => {
                *out += " else begin\n";
                self.statements(other, depth + 1, out);
                *out += &format!("{pad}end\n");
            }
        }
    }

    fn arm(&mut self, arm: &Arm, last: bool, ty: &Type, depth: usize, out: &mut String) {
        let pad = "    ".repeat(depth);
        let label = match (arm.label.filter(|_| !last), ty) {
            (None, _) => "default".into(),
            (Some(code), Type::Enum(e)) => format!("{}_{}", e.name, e.variants[code]),
            (Some(code), _) => format!("1'b{code}"),
        };
        if arm.body.is_empty() {
            *out += &format!("{pad}{label}: ;\n");
            return;
        }
        *out += &format!("{pad}{label}: begin\n");
        self.statements(&arm.body, depth + 1, out);
        *out += &format!("{pad}end\n");
    }
}
