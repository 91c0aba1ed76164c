// SPDX-License-Identifier: MIT OR Apache-2.0
//! Why a design was not emitted. Every message names the block, the statement or signal, and what would be right.

use thiserror::Error;

/// A design that the back-end refuses; nothing is emitted then.
///
/// `at` is always the instance path of the block, with the statement where there is one.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EmitError {
    /// A block that becomes a module does not say how it is called.
    #[error("{at}: the block has no module name; return `module_name(\"...\")` from its `timing()`")]
    Unnamed {
        /// Where.
        at: String,
    },
    /// A name that Verilog cannot carry.
    #[error("{at}: the name `{name}` {reason}; choose another")]
    BadName {
        /// Where.
        at: String,
        /// The name.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
    /// Two things in one module would get one name.
    #[error("{at}: `{first}` and `{second}` would both be called `{name}`; rename one of them")]
    NameClash {
        /// Where.
        at: String,
        /// The Verilog name.
        name: String,
        /// Who has it.
        first: String,
        /// Who would get it too.
        second: String,
    },
    /// Two blocks with one module name differ.
    #[error(
        "`{first}` and `{second}` are both called `{name}` but their Verilog differs; put the parameter that \
         differs into the module name"
    )]
    ModuleClash {
        /// The module.
        name: String,
        /// Path of the instance that was emitted.
        first: String,
        /// Path of the instance that differs.
        second: String,
    },
    /// Two memories with one file name differ.
    #[error("{at}: another memory already has the file `{file}` with other contents; rename one of them")]
    MemoryClash {
        /// Where.
        at: String,
        /// The file.
        file: String,
    },
    /// A construct that has no translation here.
    #[error("{at}: {what} is not supported; {remedy}")]
    Unsupported {
        /// Where.
        at: String,
        /// The construct.
        what: String,
        /// What to write in its place.
        remedy: String,
    },
    /// A name in a kernel that is no signal, constant, variant or loop variable.
    #[error(
        "{at}: `{name}` is no signal of the block nor a port of its children; a const generic or `const` must be \
         held in a `Constant` field, an array be indexed by a literal or a loop variable, and a grandchild be \
         reached through ports"
    )]
    UnknownSignal {
        /// Where.
        at: String,
        /// The name as the kernel macro wrote it.
        name: String,
    },
    /// Two types that must be equal are not.
    #[error("{at}: {what} is {found} where {expected} is needed; cast it with `bit_cast_to`")]
    Mismatch {
        /// Where.
        at: String,
        /// The expression.
        what: String,
        /// Its type.
        found: String,
        /// The type it should have.
        expected: String,
    },
    /// An operation that its operand's type does not have.
    #[error("{at}: {operation} is not defined on {found}; {remedy}")]
    WrongOperand {
        /// Where.
        at: String,
        /// The operation.
        operation: String,
        /// The operand's type.
        found: String,
        /// What to write in its place.
        remedy: String,
    },
    /// A literal whose type nothing tells.
    #[error("{at}: nothing tells the width of the literal {literal}; hold it in a `Constant`")]
    Untyped {
        /// Where.
        at: String,
        /// The literal.
        literal: String,
    },
    /// A literal outside its type.
    #[error("{at}: the literal {literal} does not fit {expected}; widen the signal or correct the literal")]
    LiteralRange {
        /// Where.
        at: String,
        /// The literal.
        literal: String,
        /// The type that it must fit.
        expected: String,
    },
    /// A comparison with a literal that is always true or always false.
    #[error("{at}: comparing {found} with the literal {literal} always gives the same answer; remove the comparison")]
    ConstantComparison {
        /// Where.
        at: String,
        /// The literal.
        literal: String,
        /// The type of the other side.
        found: String,
    },
    /// A constant index or bit range outside its operand.
    #[error("{at}: {what} lies outside {found}; correct the index")]
    IndexRange {
        /// Where.
        at: String,
        /// The index or range.
        what: String,
        /// The operand's type.
        found: String,
    },
    /// A signal is read before the kernel has written it.
    #[error("{at}: `{signal}` is read before it is assigned on every path; assign it above its first use")]
    ReadBeforeAssigned {
        /// Where.
        at: String,
        /// The signal.
        signal: String,
    },
    /// A signal is written again after it was read.
    #[error("{at}: `{signal}` is assigned again after it was read; use a second wire for the second value")]
    AssignedAfterRead {
        /// Where.
        at: String,
        /// The signal.
        signal: String,
    },
    /// A signal keeps its value on some path.
    #[error(
        "{at}: `{signal}` is not assigned on every path and would become a latch; give it a default above the `if` or `match`"
    )]
    Latch {
        /// Where.
        at: String,
        /// The signal.
        signal: String,
    },
    /// A signal that the kernel must write, and does not.
    #[error("{at}: `{signal}` is never driven; assign `.next` in the kernel")]
    Undriven {
        /// Where.
        at: String,
        /// The signal.
        signal: String,
    },
    /// A kernel writes what it must not.
    #[error(
        "{at}: the kernel writes `{signal}`, which is {what}; only outputs, wires and inputs of children can be written"
    )]
    WrongTarget {
        /// Where.
        at: String,
        /// The signal.
        signal: String,
        /// What it is.
        what: String,
    },
    /// A clock that is not the block's own, or is used as data.
    #[error("{at}: {what}; the only use of a clock is `self.<child>.clock.next = self.clock.val()`, unconditionally")]
    Clock {
        /// Where.
        at: String,
        /// What is wrong.
        what: String,
    },
    /// A file could not be written.
    #[error("cannot write `{path}`: {source}")]
    Write {
        /// The file.
        path: std::path::PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
}
