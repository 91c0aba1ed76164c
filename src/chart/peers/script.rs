// SPDX-License-Identifier: MIT OR Apache-2.0
//! The script that runs a peer: how it is asked, and how its answers are read.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use relief_models::mesh::TriangleMesh;
use serde::{Deserialize, Serialize};

/// The program that runs a peer.
const SCRIPT: &str = include_str!("peers.py");
/// A peer that is silent for so long hangs.
pub const PATIENCE: Duration = Duration::from_secs(300);
/// How long a peer that has said its last may take to go.
const FAREWELL: Duration = Duration::from_secs(2);
/// Bytes of a line of JSON.
const LINE: u64 = 1 << 16;
/// Bytes of complaints that are read.
const COMPLAINTS: u64 = 1 << 24;

/// What a peer is asked.
#[derive(Serialize)]
pub struct Asked {
    pub peer: &'static str,
    pub width: usize,
    pub height: usize,
    pub goals: Vec<f64>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Answer {
    Mesh(Head),
    Failed { error: String },
}

/// What stands before a mesh.
#[derive(Deserialize)]
pub struct Head {
    pub preparation: f64,
    pub seconds: f64,
    pub vertices: usize,
    pub triangles: usize,
}

/// A mesh, or what the peer says went wrong.
pub type Answered = Result<(Head, TriangleMesh), String>;

/// Reads the answer to one goal: a mesh, or what the peer says went wrong.
///
/// # Errors
/// A sentence: this is no answer.
pub fn answer(source: &mut impl BufRead, samples: usize) -> Result<Answered, String> {
    let wrong = || "it wrote something that is no mesh of the map".to_owned();
    let line = line(source)?;
    let head = match serde_json::from_slice(&line).map_err(|_| wrong())? {
        Answer::Mesh(head) => head,
        Answer::Failed { error } => return Ok(Err(error)),
    };
    let is_time = |seconds: f64| seconds.is_finite() && seconds >= 0.0;
    let fits = head.vertices <= 2 * samples && head.triangles <= 4 * samples;
    if !fits || !is_time(head.preparation) || !is_time(head.seconds) {
        return Err(wrong());
    }
    let mut bytes = vec![0; 24 * head.vertices];
    source.read_exact(&mut bytes).map_err(|_| wrong())?;
    let number = |bytes: &[u8; 8]| f64::from_le_bytes(*bytes);
    let numbers: Vec<f64> = bytes.as_chunks().0.iter().map(number).collect();
    let mut bytes = vec![0; 12 * head.triangles];
    source.read_exact(&mut bytes).map_err(|_| wrong())?;
    let corners: Vec<u32> = bytes.as_chunks().0.iter().map(|bytes: &[u8; 4]| u32::from_le_bytes(*bytes)).collect();
    let mesh = TriangleMesh { positions: numbers.as_chunks().0.to_vec(), triangles: corners.as_chunks().0.to_vec() };
    Ok(Ok((head, mesh)))
}

/// Reads a line.
///
/// # Errors
/// A sentence: there is none.
pub fn line(source: &mut impl BufRead) -> Result<Vec<u8>, String> {
    let mut line = Vec::new();
    let read = source.take(LINE).read_until(b'\n', &mut line);
    match read {
        Ok(1..) => Ok(line),
        _ => Err("it ended before its last mesh".into()),
    }
}

/// A running script. Its answers are read as they come; when nobody reads any more, whoever writes on is ended by that.
#[derive(Debug)]
pub struct Script<T> {
    child: Child,
    answers: Receiver<Result<T, String>>,
    complaints: Receiver<Vec<u8>>,
    patience: Duration,
    /// The output stays open as long as this is there, so that no script fails because of us.
    _listens: Sender<()>,
}

impl<T: Send + 'static> Script<T> {
    /// Starts the script with an input. `read` takes one answer after the other, until it fails.
    ///
    /// # Errors
    /// A sentence: it cannot be started.
    pub fn start(
        python: &Path,
        input: Vec<u8>,
        patience: Duration,
        read: impl Fn(&mut BufReader<ChildStdout>) -> Result<T, String> + Send + 'static,
    ) -> Result<Script<T>, String> {
        let fail = |error: io::Error| format!("{} cannot be run: {error}", python.display());
        let mut command = Command::new(python);
        // -I: nothing of the user's settings, nor of the folder, gets in.
        command.args(["-I", "-c", SCRIPT]).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().map_err(fail)?;
        if let Some(mut target) = child.stdin.take() {
            // One that does not listen is known by its answers.
            thread::spawn(move || target.write_all(&input));
        }
        // One answer waits while another is judged; meshes are large.
        let (answer, answers) = sync_channel(1);
        let (listens, ended) = channel();
        if let Some(source) = child.stdout.take() {
            let mut source = BufReader::new(source);
            thread::spawn(move || {
                loop {
                    let found = read(&mut source);
                    let is_last = found.is_err();
                    if answer.send(found).is_err() || is_last {
                        break;
                    }
                }
                let _ = ended.recv();
            });
        }
        let (complaint, complaints) = channel();
        if let Some(source) = child.stderr.take() {
            thread::spawn(move || {
                let mut bytes = Vec::new();
                let _ = source.take(COMPLAINTS).read_to_end(&mut bytes);
                complaint.send(bytes)
            });
        }
        Ok(Script { child, answers, complaints, patience, _listens: listens })
    }

    /// The next answer.
    ///
    /// # Errors
    /// A sentence: the script failed, hangs, or wrote no answer. There will be no other one.
    pub fn next(&mut self) -> Result<T, String> {
        match self.answers.recv_timeout(self.patience) {
            Ok(Ok(answer)) => Ok(answer),
            Ok(Err(sentence)) => Err(self.failure().unwrap_or(sentence)),
            Err(RecvTimeoutError::Timeout) => Err(format!("it said nothing for {} s", self.patience.as_secs())),
            Err(RecvTimeoutError::Disconnected) => Err("it has ended".into()),
        }
    }

    /// How it failed, if it did.
    fn failure(&mut self) -> Option<String> {
        let begun = Instant::now();
        while begun.elapsed() < FAREWELL {
            match self.child.try_wait() {
                Ok(None) => thread::sleep(Duration::from_millis(5)),
                Ok(Some(status)) if !status.success() => {
                    let complaints = self.complaints.recv_timeout(FAREWELL).unwrap_or_default();
                    return Some(format!("it failed ({status}){}", last_line(&complaints)));
                }
                _ => return None,
            }
        }
        None
    }
}

impl<T> Drop for Script<T> {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The end of what a program complains of: Python tells the error last.
fn last_line(complaints: &[u8]) -> String {
    let text = String::from_utf8_lossy(complaints);
    let last = text.lines().map(str::trim).rfind(|line| !line.is_empty());
    last.map_or_else(String::new, |line| format!(": {}", line.chars().take(200).collect::<String>()))
}

#[cfg(all(test, unix))]
mod tests {
    use super::{Script, line};
    use std::fs;
    use std::os::unix::fs::PermissionsExt as _;
    use std::path::Path;
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    fn script(folder: &Path, text: &str) -> Script<Vec<u8>> {
        let path = folder.join("python");
        fs::write(&path, format!("#!/bin/sh\ncd {}\n{text}\n", folder.display())).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
        Script::start(&path, vec![7; 1 << 20], Duration::from_secs(2), line).unwrap()
    }

    #[test]
    fn script_that_hangs_is_given_up() {
        let folder = tempfile::tempdir().unwrap();
        for text in ["exec sleep 60", "sleep 60", "echo answer; sleep 60"] {
            let begun = Instant::now();
            let mut script = script(folder.path(), text);
            let answer = text.starts_with("echo").then(|| script.next().unwrap());
            assert!(answer.is_none_or(|answer| answer == b"answer\n"));
            assert_eq!(script.next(), Err("it said nothing for 2 s".into()), "{text}");
            drop(script);
            assert!(begun.elapsed() < Duration::from_secs(20), "{text}");
        }
    }

    /// A child of the script that writes without end goes with it, and does not fill anything.
    #[test]
    fn script_leaves_nobody_who_writes() {
        let folder = tempfile::tempdir().unwrap();
        let mut script = script(folder.path(), "cat /dev/zero & echo $! > id; wait");
        assert!(script.next().is_ok_and(|line| line.len() == 1 << 16));
        drop(script);
        let id = fs::read_to_string(folder.path().join("id")).unwrap();
        let id = id.trim();
        let lives = || Command::new("kill").args(["-0", id]).stderr(Stdio::null()).status();
        let begun = Instant::now();
        while lives().unwrap().success() {
            assert!(begun.elapsed() < Duration::from_secs(20), "it goes on writing");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}
