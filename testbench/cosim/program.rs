// SPDX-License-Identifier: MIT OR Apache-2.0
//! Runs a program for a bounded time and keeps what it says.

use super::{CosimError, io_error};
use rustix::process::{Pid, Signal, kill_process_group};
use std::{
    fs::File,
    io::{Read, Seek, SeekFrom},
    os::unix::process::{CommandExt, ExitStatusExt},
    process::{Command, ExitStatus, Stdio},
    sync::{Mutex, PoisonError},
    thread,
    time::{Duration, Instant},
};

/// How many lines of a program's output an error quotes.
const QUOTED_LINES: usize = 12;

/// What a program that came to its end said.
pub struct Finished {
    /// How it ended.
    pub status: ExitStatus,
    /// What it wrote to stdout.
    pub stdout: String,
    /// What it wrote to stderr.
    pub stderr: String,
}

impl Finished {
    /// Errors first: they are what a reader looks for.
    pub(crate) fn excerpt(&self) -> String {
        excerpt(&format!("{}\n{}", self.stderr, self.stdout))
    }

    /// An error unless the program was content.
    pub(crate) fn expect_success(self, what: &str) -> Result<Self, CosimError> {
        if self.status.success() {
            return Ok(self);
        }
        let (status, excerpt) = (describe(self.status), self.excerpt());
        Err(CosimError::Failed { what: what.to_string(), status, excerpt })
    }
}

/// The process groups that run at present.
static RUNNING: Mutex<Vec<Pid>> = Mutex::new(Vec::new());

/// Stops all programs that run at present, because this one is stopped: nobody else would.
pub fn stop_all() {
    for group in RUNNING.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        let _ = kill_process_group(group, Signal::KILL);
    }
}

/// Runs to the end, or for `limit`. The program gets a process group of its own, so that the compilers which it may
/// have started are stopped with it.
///
/// # Errors
/// It cannot be started, or is not done in time. What it says itself is no error.
pub fn run(command: &mut Command, what: &str, limit: Duration) -> Result<Finished, CosimError> {
    // Files, unlike pipes, never fill up while nobody reads.
    let file = || tempfile::tempfile().map_err(io_error("making a temporary file"));
    let clone = |file: &File| file.try_clone().map_err(io_error("sharing a temporary file"));
    let (mut stdout, mut stderr) = (file()?, file()?);
    command.stdin(Stdio::null()).stdout(clone(&stdout)?).stderr(clone(&stderr)?).process_group(0);
    let mut child = command.spawn().map_err(io_error(format!("starting {what}")))?;
    let group = Pid::from_child(&child);
    let running = || RUNNING.lock().unwrap_or_else(PoisonError::into_inner);
    running().push(group);
    let (start, mut pause) = (Instant::now(), Duration::from_millis(1));
    let status = loop {
        if let Some(status) = child.try_wait().map_err(io_error(format!("waiting for {what}")))? {
            break Some(status);
        }
        if start.elapsed() >= limit {
            // It may have ended by itself just now: then there is nothing to stop.
            let _ = kill_process_group(group, Signal::KILL);
            let _ = child.wait();
            break None;
        }
        thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(20));
    };
    running().retain(|other| *other != group);
    let (stdout, stderr) = (content(&mut stdout), content(&mut stderr));
    match status {
        Some(status) => Ok(Finished { status, stdout, stderr }),
        None => {
            Err(CosimError::Timeout { what: what.to_string(), limit, excerpt: excerpt(&format!("{stderr}\n{stdout}")) })
        }
    }
}

/// All that was written to a file of our own.
pub(crate) fn content(file: &mut File) -> String {
    let mut bytes = Vec::new();
    let read = file.seek(SeekFrom::Start(0)).and_then(|_| file.read_to_end(&mut bytes));
    match read {
        Ok(_) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(cause) => format!("(its output cannot be read: {cause})"),
    }
}

/// The first lines that say something.
pub(crate) fn excerpt(text: &str) -> String {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let mut quoted: Vec<String> = lines.by_ref().take(QUOTED_LINES).map(|line| format!("  {line}")).collect();
    let left = lines.count();
    if left > 0 {
        quoted.push(format!("  ({left} more lines)"));
    }
    if quoted.is_empty() { "  (nothing)".into() } else { quoted.join("\n") }
}

/// `code 1` or `signal 14`.
pub(crate) fn describe(status: ExitStatus) -> String {
    match (status.code(), status.signal()) {
        (Some(code), _) => format!("code {code}"),
        (None, Some(signal)) => format!("signal {signal}"),
        (None, None) => "no status".into(),
    }
}
