// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finds Yosys and nextpnr: on the PATH, or in the project's own folder of tools.

use std::env;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

use relief_testbench::cosim::program;

/// Where `requirements-eda.txt` and `requirements-test.txt` are installed, in the current folder or one above it.
const TOOLS: [&str; 2] = [".tools/eda/bin", ".tools/test/bin"];

/// The commands that install it.
pub const INSTALL: &str =
    "python3 -m venv .tools/eda && .tools/eda/bin/pip install --only-binary :all: -r requirements-eda.txt";

/// The tools of PyPI compile themselves at their first start, for minutes on a slow machine.
const FIRST_START: Duration = Duration::from_secs(900);

/// A program that is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// What starts it.
    pub path: PathBuf,
    /// Its name and version: `Yosys 0.23`, `nextpnr-0.11.1`.
    pub version: String,
}

/// Yosys: Debian's, or for a part that is too new for it the one of the folder of tools.
///
/// # Errors
/// A sentence that says what to install.
pub fn yosys(new: bool) -> Result<Program, String> {
    let local = || local("yosys").and_then(|path| ask(path, "-V"));
    let found = if new { local() } else { ask("yosys".into(), "-V").or_else(local) };
    found.ok_or_else(|| match new {
        true => format!("this target needs a newer Yosys than Debian's: in the project's folder, run {INSTALL}"),
        false => "the program `yosys` is missing: install the Debian package yosys".into(),
    })
}

/// A nextpnr.
///
/// # Errors
/// A sentence that says what to install.
pub fn nextpnr(name: &str) -> Result<Program, String> {
    let found = ask(name.into(), "--version").or_else(|| local(name).and_then(|path| ask(path, "--version")));
    found.ok_or_else(|| format!("the program `{name}` is missing: in the project's folder, run {INSTALL}"))
}

/// The folders of tools, the nearest first.
pub fn folders() -> Vec<PathBuf> {
    let here = env::current_dir().unwrap_or_default();
    let all = here.ancestors().flat_map(|folder| TOOLS.map(|tools| folder.join(tools)));
    all.filter(|folder| folder.is_dir()).collect()
}

fn local(name: &str) -> Option<PathBuf> {
    folders().into_iter().map(|folder| folder.join(format!("yowasp-{name}"))).find(|place| place.is_file())
}

fn ask(path: PathBuf, option: &str) -> Option<Program> {
    let what = path.display().to_string();
    let answer = program::run(Command::new(&path).arg(option), &what, FIRST_START).ok()?;
    let text = answer.status.success().then(|| format!("{}\n{}", answer.stdout, answer.stderr))?;
    Some(Program { path, version: version(&text)? })
}

/// The version in what a program says of itself.
pub fn version(text: &str) -> Option<String> {
    text.lines().find_map(|line| match line.split_once("(Version ") {
        Some((_, rest)) => rest.split(')').next().map(str::to_owned),
        None => line.starts_with("Yosys ").then(|| line.split_whitespace().take(2).collect::<Vec<_>>().join(" ")),
    })
}
