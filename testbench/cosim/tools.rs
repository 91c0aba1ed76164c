// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finds the programs that the tests drive, and says what to install where one is missing.

use super::program;
use std::{
    collections::BTreeMap,
    io::Write,
    process::Command,
    sync::{Mutex, PoisonError},
    time::Duration,
};
use thiserror::Error;

/// A program that is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tool {
    /// The name by which it is started.
    pub name: String,
    /// The first line of what it says about its version.
    pub version: String,
}

/// A program that is not there.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("the program `{name}` is missing: install the Debian package {package}")]
pub struct Missing {
    /// The name by which it would be started.
    pub name: String,
    /// The Debian package that has it.
    pub package: String,
}

/// Program, Debian package, and the option that makes it say its version.
const KNOWN: [(&str, &str, &str); 7] = [
    ("verilator", "verilator", "--version"),
    ("g++", "g++", "--version"),
    ("make", "make", "--version"),
    ("iverilog", "iverilog", "-V"),
    ("vvp", "iverilog", "-V"),
    ("yosys", "yosys", "-V"),
    ("z3", "z3", "--version"),
];

/// Asking takes up to 50 ms, and every test asks.
static FOUND: Mutex<BTreeMap<String, Tool>> = Mutex::new(BTreeMap::new());

/// The program of this name.
pub fn find(name: &str) -> Result<Tool, Missing> {
    let mut found = FOUND.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(tool) = found.get(name) {
        return Ok(tool.clone());
    }
    let (_, package, option) = *KNOWN.iter().find(|known| known.0 == name).unwrap_or(&(name, name, "--version"));
    let missing = || Missing { name: name.to_string(), package: package.to_string() };
    // Icarus says its version and then leaves with an error, so the code tells nothing.
    let answer = program::run(Command::new(name).arg(option), name, Duration::from_secs(30)).map_err(|_| missing())?;
    let version = answer.stdout.lines().chain(answer.stderr.lines()).find(|line| !line.trim().is_empty());
    let tool = Tool { name: name.to_string(), version: version.unwrap_or("unknown").trim().to_string() };
    found.insert(name.to_string(), tool.clone());
    Ok(tool)
}

/// The program for a test, or none where the test shall pass by. A missing program is an error where `CI` is set, so
/// that nothing is left out there unseen; elsewhere it prints `SKIPPED` with what to install.
pub fn require(name: &str, what: &str) -> Result<Option<Tool>, Missing> {
    match find(name) {
        Ok(tool) => Ok(Some(tool)),
        Err(missing) if is_ci(std::env::var("CI").ok().as_deref()) => Err(missing),
        Err(missing) => {
            // Not `eprintln!`: the test harness would keep it to itself, as the test passes.
            let line = format!("SKIPPED {what}: install the Debian package {}\n", missing.package);
            let _ = std::io::stderr().write_all(line.as_bytes());
            Ok(None)
        }
    }
}

/// Like [`require`] for several programs: whether all of them are there.
pub fn require_all(names: &[&str], what: &str) -> Result<bool, Missing> {
    names.iter().try_fold(true, |all, name| Ok(require(name, what)?.is_some() && all))
}

fn is_ci(value: Option<&str>) -> bool {
    !matches!(value, None | Some("" | "0" | "false"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tools_missing_program_names_its_package() {
        let missing = find("relief-no-such-program").expect_err("no such program");
        let text = "the program `relief-no-such-program` is missing: \
                    install the Debian package relief-no-such-program";
        assert_eq!(missing.to_string(), text);
    }

    #[test]
    fn tools_ci_is_what_says_so() {
        assert!(is_ci(Some("true")) && is_ci(Some("1")));
        assert!(!is_ci(None) && !is_ci(Some("")) && !is_ci(Some("false")));
    }
}
