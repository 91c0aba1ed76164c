// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a kernel's order of statements must guarantee, so that its pieces can be emitted without an order.

use super::EmitError;
use super::expr::Typed;
use super::stmt::{Arm, Stmt};
use super::symbols::{Role, Symbols};
use std::collections::BTreeSet;

/// Signals by their state at one point of the kernel.
#[derive(Clone, Default)]
struct Flow {
    /// Written on every path to here.
    assigned: BTreeSet<usize>,
    /// Read on some path to here.
    read: BTreeSet<usize>,
    /// Written on some path to here.
    touched: BTreeSet<usize>,
}

impl Flow {
    /// The state behind a branching.
    fn join(branches: Vec<Flow>) -> Flow {
        branches
            .into_iter()
            .reduce(|a, b| Flow {
                assigned: &a.assigned & &b.assigned,
                read: &a.read | &b.read,
                touched: &a.touched | &b.touched,
            })
            .unwrap_or_default()
    }
}

/// Checks that every signal that the kernel must write is written on every path, before it is read and not afterwards.
pub(super) fn check(symbols: &Symbols, body: &[Stmt], tied: impl Fn(usize) -> bool) -> Result<(), EmitError> {
    let mut flow = Flow::default();
    run(symbols, body, &mut flow)?;
    for (k, symbol) in symbols.list.iter().enumerate() {
        let (at, signal) = (symbols.block.clone(), symbol.key.replace('$', "."));
        match (flow.assigned.contains(&k), flow.touched.contains(&k)) {
            (true, _) => {}
            (false, true) => return Err(EmitError::Latch { at, signal }),
            (false, false) if symbol.role.writable() && symbol.role != Role::Wire && !tied(k) => {
                return Err(EmitError::Undriven { at, signal });
            }
            _ => {}
        }
    }
    Ok(())
}

fn read(symbols: &Symbols, e: &Typed, flow: &mut Flow) -> Result<(), EmitError> {
    let mut early = None;
    e.reads(&mut |k, _| {
        if symbols.list[k].role.writable() && !flow.assigned.contains(&k) {
            early.get_or_insert(k);
        }
        flow.read.insert(k);
    });
    match early {
        None => Ok(()),
        Some(k) => Err(EmitError::ReadBeforeAssigned {
            at: symbols.block.clone(),
            signal: symbols.list[k].key.replace('$', "."),
        }),
    }
}

fn run(symbols: &Symbols, body: &[Stmt], flow: &mut Flow) -> Result<(), EmitError> {
    for statement in body {
        match statement {
            Stmt::Assign { target, value } => {
                read(symbols, value, flow)?;
                if flow.read.contains(target) {
                    let signal = symbols.list[*target].key.replace('$', ".");
                    return Err(EmitError::AssignedAfterRead { at: symbols.block.clone(), signal });
                }
                flow.assigned.insert(*target);
                flow.touched.insert(*target);
            }
            Stmt::If { test, then, otherwise } => {
                read(symbols, test, flow)?;
                let mut other = flow.clone();
                run(symbols, then, flow)?;
                run(symbols, otherwise, &mut other)?;
                *flow = Flow::join(vec![std::mem::take(flow), other]);
            }
            Stmt::Match { test, arms } => {
                read(symbols, test, flow)?;
                let mut ends = vec![];
                for arm in arms {
                    let mut branch = flow.clone();
                    run(symbols, &arm.body, &mut branch)?;
                    ends.push(branch);
                }
                *flow = Flow::join(ends);
            }
        }
    }
    Ok(())
}

/// Calls `write` with every target and `read` with every signal read in the statements, and whether as a whole.
pub(super) fn visit(body: &[Stmt], write: &mut dyn FnMut(usize), read: &mut dyn FnMut(usize, bool)) {
    for statement in body {
        match statement {
            Stmt::Assign { target, value } => {
                write(*target);
                value.reads(read);
            }
            Stmt::If { test, then, otherwise } => {
                test.reads(read);
                visit(then, write, read);
                visit(otherwise, write, read);
            }
            Stmt::Match { test, arms } => {
                test.reads(read);
                for arm in arms {
                    visit(&arm.body, write, read);
                }
            }
        }
    }
}

/// The statements as far as they assign one of the targets that `keep` selects.
pub(super) fn project(body: &[Stmt], keep: &dyn Fn(usize) -> bool) -> Vec<Stmt> {
    let mut out = vec![];
    for statement in body {
        match statement {
            Stmt::Assign { target, .. } if keep(*target) => out.push(statement.clone()),
            Stmt::Assign { .. } => {}
            Stmt::If { test, then, otherwise } => {
                let (then, otherwise) = (project(then, keep), project(otherwise, keep));
                if !then.is_empty() || !otherwise.is_empty() {
                    out.push(Stmt::If { test: test.clone(), then, otherwise });
                }
            }
            Stmt::Match { test, arms } => {
                let arms: Vec<Arm> =
                    arms.iter().map(|arm| Arm { label: arm.label, body: project(&arm.body, keep) }).collect();
                if arms.iter().any(|a| !a.body.is_empty()) {
                    out.push(Stmt::Match { test: test.clone(), arms });
                }
            }
        }
    }
    out
}

/// The statements of a kernel without those whose result a later unconditional assignment replaces, such as the
/// defaults of `dff_setup!`. Nothing has read them: [`check`] has seen to that.
pub(super) fn without_overwritten(body: &[Stmt]) -> Vec<Stmt> {
    let mut overwritten = BTreeSet::new();
    let mut out = vec![];
    for statement in body.iter().rev() {
        out.extend(project(std::slice::from_ref(statement), &|k| !overwritten.contains(&k)));
        if let Stmt::Assign { target, .. } = statement {
            overwritten.insert(*target);
        }
    }
    out.reverse();
    out
}
