// SPDX-License-Identifier: MIT OR Apache-2.0
//! What Verilator and Icarus have to say of a design, message by message.

use super::{CosimError, Design, program, tools};
use std::{fmt, process::Command, time::Duration};

const LIMIT: Duration = Duration::from_secs(300);

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Severity {
    /// The design was understood.
    Warning,
    /// It was not.
    Error,
}

/// One message of a tool.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LintMessage {
    /// How bad it is.
    pub severity: Severity,
    /// The rule, such as `WIDTH`; empty where the tool names none.
    pub rule: String,
    /// The name of the file, without its folder; empty where it is about no file.
    pub file: String,
    /// The line, counted from 1; 0 where there is none.
    pub line: usize,
    /// What it says.
    pub text: String,
}

impl fmt::Display for LintMessage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, "{}:{}: {severity}", self.file, self.line)?;
        if !self.rule.is_empty() {
            write!(f, " {}", self.rule)?;
        }
        write!(f, ": {}", self.text)
    }
}

/// A warning that is known and accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Waiver<'a> {
    /// The rule.
    pub rule: &'a str,
    /// The file's name, or none for all files.
    pub file: Option<&'a str>,
    /// Why it is accepted: for whoever reads the waiver.
    pub because: &'a str,
}

impl Waiver<'_> {
    fn covers(&self, message: &LintMessage) -> bool {
        // An error is never waived: there would be no design.
        message.severity == Severity::Warning
            && self.rule == message.rule
            && self.file.is_none_or(|file| file == message.file)
    }
}

/// Runs `verilator --lint-only -Wall` and returns every message that no waiver covers.
pub fn verilator_lint(design: &Design, waivers: &[Waiver<'_>]) -> Result<Vec<LintMessage>, CosimError> {
    design.check()?;
    tools::find("verilator")?;
    let what = format!("checking `{}` with Verilator", design.top);
    let mut lint = Command::new("verilator");
    lint.args(["--lint-only", "-Wall", "--no-timing", "--top-module", &design.top]).args(design.absolute_sources()?);
    let finished = program::run(lint.current_dir(design.folder()?), &what, LIMIT)?;
    let mut messages: Vec<LintMessage> = finished.stderr.lines().filter_map(verilator_message).collect();
    if messages.is_empty() {
        finished.expect_success(&what)?;
    }
    messages.retain(|message| !waivers.iter().any(|waiver| waiver.covers(message)));
    Ok(messages)
}

/// Reads the design with `iverilog -g2012 -Wall`: its warnings where it accepts the design, and an error where not.
pub fn iverilog_accepts(design: &Design) -> Result<Vec<LintMessage>, CosimError> {
    design.check()?;
    tools::find("iverilog")?;
    let what = format!("reading `{}` with Icarus", design.top);
    let mut read = Command::new("iverilog");
    // A time scale belongs to the test bench, so its absence is nothing to warn of.
    read.args(["-g2012", "-Wall", "-Wno-timescale", "-t", "null", "-s", &design.top]).args(design.absolute_sources()?);
    let finished = program::run(read.current_dir(design.folder()?), &what, LIMIT)?.expect_success(&what)?;
    Ok(finished.stderr.lines().filter_map(icarus_message).collect())
}

/// `%Warning-RULE: file:line:column: text`, `%Error: file:line:column: text` or `%Error: text`; the lines that follow,
/// with the source and advice, begin with a blank.
fn verilator_message(line: &str) -> Option<LintMessage> {
    let rest = line.strip_prefix('%')?;
    let (head, body) = rest.split_once(": ")?;
    let (severity, rule) = head.split_once('-').unwrap_or((head, ""));
    let severity = match severity {
        "Warning" => Severity::Warning,
        "Error" => Severity::Error,
        _ => return None,
    };
    // It counts the others.
    if body.trim_start().starts_with("Exiting due to") {
        return None;
    }
    let (file, line, text) = located(body.trim_start());
    let text = match text.split_once(": ") {
        // The column is of no use without the source beside it.
        Some((column, text)) if column.parse::<usize>().is_ok() => text,
        _ => text,
    };
    Some(LintMessage { severity, rule: rule.to_string(), file, line, text: text.trim().to_string() })
}

/// `file:line: warning: text`.
fn icarus_message(line: &str) -> Option<LintMessage> {
    let (file, number, text) = located(line);
    let (severity, text) = match text.split_once(": ")? {
        ("warning", text) => (Severity::Warning, text),
        ("error", text) => (Severity::Error, text),
        _ => return None,
    };
    Some(LintMessage { severity, rule: String::new(), file, line: number, text: text.trim().to_string() })
}

/// Cuts `file:line:` off, where it is there.
fn located(text: &str) -> (String, usize, &str) {
    let place = text.match_indices(':').find_map(|(colon, _)| {
        let (number, rest) = text[colon + 1..].split_once(':')?;
        Some((&text[..colon], number.parse::<usize>().ok()?, rest.trim_start()))
    });
    match place {
        Some((path, line, rest)) => (path.rsplit('/').next().unwrap_or(path).to_string(), line, rest),
        None => (String::new(), 0, text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lint_messages_are_taken_apart() {
        let message = verilator_message("%Warning-WIDTH: /a b/relief_x.sv:12:7: Operator ADD expects 8 bits: 9 given");
        let message = message.expect("a message");
        assert_eq!(message.to_string(), "relief_x.sv:12: warning WIDTH: Operator ADD expects 8 bits: 9 given");
        let message = verilator_message("%Error: relief_x.sv:3:1: syntax error").expect("a message");
        assert_eq!((message.severity, message.line, message.text.as_str()), (Severity::Error, 3, "syntax error"));
        let message = verilator_message("%Error: Cannot find file containing module: 'none'").expect("a message");
        assert_eq!((message.line, message.text.as_str()), (0, "Cannot find file containing module: 'none'"));
        assert_eq!(verilator_message("%Error: Exiting due to 1 warning(s)"), None);
        assert_eq!(verilator_message("        : ... In instance top"), None);
        let message = icarus_message("relief_x.sv:7: warning: implicit definition of wire 'a'.").expect("a message");
        assert_eq!(message.to_string(), "relief_x.sv:7: warning: implicit definition of wire 'a'.");
    }
}
