// SPDX-License-Identifier: MIT OR Apache-2.0
//! Splits a kernel into pieces that do not wait for each other.
//!
//! One big `always_comb` would read what it also feeds through a child, which simulators take for a combinational loop.
//! Statements that share a target stay together, and so do targets that share an `if` or `match`; where a piece would
//! feed itself, it is taken apart once more, target by target.

use super::Direction;
use super::analysis::{project, visit};
use super::stmt::Stmt;
use super::symbols::{Role, Symbols};
use std::collections::BTreeSet;

/// Statements that are emitted as one `assign` or `always_comb`.
pub(super) struct Group {
    pub targets: BTreeSet<usize>,
    pub body: Vec<Stmt>,
}

/// The groups in the order of their first statement.
pub(super) fn split(symbols: &Symbols, body: &[Stmt]) -> Vec<Group> {
    let mut parts: Vec<BTreeSet<usize>> = vec![];
    for statement in body {
        let mut targets = BTreeSet::new();
        visit(std::slice::from_ref(statement), &mut |k| _ = targets.insert(k), &mut |_, _| {});
        match parts.iter().position(|p| !p.is_disjoint(&targets)) {
            None => parts.push(targets),
            Some(first) => {
                // Everything that the statement touches becomes one part, in the place of the first.
                let (mut merged, mut others) = (targets, vec![]);
                for (k, part) in std::mem::take(&mut parts).into_iter().enumerate() {
                    let joined = k >= first && !part.is_disjoint(&merged);
                    if joined {
                        merged.extend(part);
                    } else {
                        others.push(part);
                    }
                }
                others.insert(first, merged);
                parts = others;
            }
        }
    }
    parts.retain(|p| !p.is_empty());
    let looping = on_a_loop(symbols, body, &parts);
    let mut groups = vec![];
    for (part, looping) in parts.into_iter().zip(looping) {
        let pieces = if looping { part.into_iter().map(|k| BTreeSet::from([k])).collect() } else { vec![part] };
        groups.extend(
            pieces.into_iter().map(|targets| Group { body: project(body, &|k| targets.contains(&k)), targets }),
        );
    }
    groups
}

/// Signals that can change: nothing ever starts an `always @(*)` that reads only others.
pub(super) fn moving(symbols: &Symbols, groups: &[Group]) -> BTreeSet<usize> {
    let source = |k: &usize| matches!(symbols.list[*k].role, Role::Port(Direction::Input) | Role::ChildOutput(_));
    let mut moving: BTreeSet<usize> = (0..symbols.list.len()).filter(source).collect();
    // Groups may stand in another order than the statements that write and read a wire.
    for _ in 0..groups.len() {
        for group in groups {
            let mut moves = false;
            visit(&group.body, &mut |_| {}, &mut |k, _| moves |= moving.contains(&k));
            if moves {
                moving.extend(&group.targets);
            }
        }
    }
    moving
}

/// Whether a group is one unconditional assignment, and so becomes an `assign`.
pub(super) fn is_assign(group: &Group) -> bool {
    matches!(group.body.as_slice(), [Stmt::Assign { .. }])
}

/// For each part, whether it feeds itself, through other parts or through children.
fn on_a_loop(symbols: &Symbols, body: &[Stmt], parts: &[BTreeSet<usize>]) -> Vec<bool> {
    let reads: Vec<BTreeSet<usize>> = parts
        .iter()
        .map(|part| {
            let mut reads = BTreeSet::new();
            visit(&project(body, &|k| part.contains(&k)), &mut |_| {}, &mut |k, _| _ = reads.insert(k));
            reads
        })
        .collect();
    // A child may pass any input on to any output; the primitives never do.
    let children = |set: &BTreeSet<usize>, output: bool| -> BTreeSet<usize> {
        let child = |k: &usize| match symbols.list[*k].role {
            Role::ChildInput(c) if !output => Some(c),
            Role::ChildOutput(c) if output => Some(c),
            _ => None,
        };
        set.iter().filter_map(child).filter(|c| !symbols.registered.contains(c)).collect()
    };
    let feeds = |a: usize, b: usize| {
        !parts[a].is_disjoint(&reads[b]) || !children(&parts[a], false).is_disjoint(&children(&reads[b], true))
    };
    let next: Vec<Vec<usize>> = (0..parts.len()).map(|a| (0..parts.len()).filter(|&b| feeds(a, b)).collect()).collect();
    let loops = |start: usize| {
        let (mut seen, mut open) = (BTreeSet::new(), next[start].clone());
        while let Some(k) = open.pop() {
            if seen.insert(k) {
                open.extend(&next[k]);
            }
        }
        seen.contains(&start)
    };
    (0..parts.len()).map(loops).collect()
}
