// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files that appear whole or not at all.
//!
//! A file is written beside its place and renamed at the end. What a link leads to is replaced, and not the link; what is
//! no file (a pipe, a terminal, `/dev/null`) cannot be replaced and is written as it is.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Files that have no name yet, for [`remove_unfinished`].
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// An open file that gets its name in [`OutputFile::commit`]; without that nothing of it stays.
#[derive(Debug)]
pub struct OutputFile {
    file: File,
    path: PathBuf,
    /// The file beside its place, and its place.
    pending: Option<(PathBuf, PathBuf)>,
}

impl OutputFile {
    /// Opens the place of `path`.
    ///
    /// # Errors
    /// A sentence: the place is a folder, or the system refuses.
    pub fn open(path: &Path) -> Result<Self, String> {
        let fail = |error: io::Error| format!("{}: cannot be written: {error}", path.display());
        let place = match fs::canonicalize(path) {
            Ok(place) if place.is_dir() => return Err(format!("{}: is a folder; a file is expected", path.display())),
            Ok(place) if !place.is_file() => {
                let file = File::options().write(true).open(&place).map_err(fail)?;
                return Ok(Self { file, path: path.into(), pending: None });
            }
            Ok(place) => place,
            Err(_) => path.to_path_buf(),
        };
        let is_name = !path.to_string_lossy().ends_with('/');
        let Some(name) = place.file_name().filter(|_| is_name) else {
            return Err(format!("{}: is not the name of a file", path.display()));
        };
        let mut beside = OsString::from(".");
        beside.push(name);
        beside.push(format!(".{}", std::process::id()));
        let beside = place.with_file_name(beside);
        let file = File::create(&beside).map_err(fail)?;
        unfinished().push(beside.clone());
        Ok(Self { file, path: path.into(), pending: Some((beside, place)) })
    }

    /// Opens, writes and commits.
    ///
    /// # Errors
    /// As [`OutputFile::open`] and [`OutputFile::commit`].
    pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), String> {
        let mut output = Self::open(path)?;
        output.file.write_all(bytes).map_err(|error| format!("{}: cannot be written: {error}", path.display()))?;
        output.commit()
    }

    /// Another handle on the file, for whoever writes it.
    ///
    /// # Errors
    /// The system's.
    pub fn writer(&self) -> io::Result<File> {
        self.file.try_clone()
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// A sentence: the system refuses.
    pub fn commit(mut self) -> Result<(), String> {
        let Some((beside, place)) = &self.pending else { return Ok(()) };
        fs::rename(beside, place).map_err(|error| format!("{}: cannot be written: {error}", self.path.display()))?;
        unfinished().retain(|path| path != beside);
        self.pending = None;
        Ok(())
    }
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for OutputFile {
    fn drop(&mut self) {
        if let Some((beside, _)) = &self.pending {
            let _ = fs::remove_file(beside);
            unfinished().retain(|path| path != beside);
        }
    }
}

fn unfinished() -> std::sync::MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every file and folder that has no name yet, and the folders that were made for them: for a program that is
/// told to stop.
pub fn remove_unfinished() {
    for path in unfinished().drain(..) {
        let _ = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
    }
    remove_empty(&mut made());
}

/// Folders that were made for outputs, outer ones first.
static MADE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn made() -> std::sync::MutexGuard<'static, Vec<PathBuf>> {
    MADE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes those that are empty, inner ones first.
fn remove_empty(folders: &mut Vec<PathBuf>) {
    for folder in folders.drain(..).rev() {
        let _ = fs::remove_dir(folder);
    }
}

/// A folder made for outputs. Those made for nothing, it and the ones above it, go again with this value.
#[derive(Debug)]
pub struct MadeFolder(());

impl MadeFolder {
    /// Makes `path` and what is missing above it.
    ///
    /// # Errors
    /// A sentence: something else is there, or the system refuses.
    pub fn open(path: &Path) -> Result<Self, String> {
        let missing: Vec<&Path> =
            path.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists()).collect();
        if let Some(file) = path.ancestors().find(|path| path.exists()).filter(|path| !path.is_dir()) {
            return Err(format!("{}: is a file; a folder is expected", file.display()));
        }
        made().extend(missing.into_iter().rev().map(Path::to_path_buf));
        let opened = Self(());
        let fail = |error| format!("{}: the folder cannot be made: {error}", path.display());
        fs::create_dir_all(path).map_err(fail)?;
        Ok(opened)
    }
}

impl Drop for MadeFolder {
    fn drop(&mut self) {
        remove_empty(&mut made());
    }
}

/// A folder that is filled beside its place.
#[derive(Debug)]
pub struct OutputFolder {
    beside: PathBuf,
    place: PathBuf,
}

impl OutputFolder {
    /// Makes an empty folder beside `place`.
    ///
    /// # Errors
    /// A sentence: the place is a file, or the system refuses.
    pub fn open(place: &Path) -> Result<Self, String> {
        if place.exists() && !place.is_dir() {
            return Err(format!("{}: is a file; a folder is expected", place.display()));
        }
        let mut name = OsString::from(".");
        name.push(place.file_name().unwrap_or_default());
        name.push(format!(".{}", std::process::id()));
        let beside = place.with_file_name(name);
        fs::create_dir_all(&beside)
            .map_err(|error| format!("{}: the folder cannot be made: {error}", beside.display()))?;
        unfinished().push(beside.clone());
        Ok(Self { beside, place: place.into() })
    }
    /// Where its files are written now.
    pub fn path(&self) -> &Path {
        &self.beside
    }
    /// Names of the files, once they are written.
    ///
    /// # Errors
    /// A sentence: the folder cannot be read, or a folder stands where a file has to go.
    pub fn files(&self) -> Result<Vec<OsString>, String> {
        let fail = |error: io::Error| format!("{}: cannot be read: {error}", self.beside.display());
        let mut names = Vec::new();
        for entry in fs::read_dir(&self.beside).map_err(fail)? {
            let name = entry.map_err(fail)?.file_name();
            let target = self.place.join(&name);
            if target.is_dir() {
                return Err(format!("{}: is a folder; a file has to go there", target.display()));
            }
            names.push(name);
        }
        names.sort();
        Ok(names)
    }
    /// Moves the files to their place. Files of the place that `stale` tells are removed; what else is there stays.
    ///
    /// # Errors
    /// A sentence: the system refuses.
    pub fn commit(self, stale: impl Fn(&str) -> bool) -> Result<(), String> {
        let fail = |path: &Path| {
            let path = path.display().to_string();
            move |error: io::Error| format!("{path}: cannot be written: {error}")
        };
        let names = self.files()?;
        fs::create_dir_all(&self.place).map_err(fail(&self.place))?;
        for name in &names {
            let target = self.place.join(name);
            fs::rename(self.beside.join(name), &target).map_err(fail(&target))?;
        }
        for entry in fs::read_dir(&self.place).map_err(fail(&self.place))?.flatten() {
            let name = entry.file_name();
            if !names.contains(&name) && stale(&name.to_string_lossy()) && entry.path().is_file() {
                fs::remove_file(entry.path()).map_err(fail(&entry.path()))?;
            }
        }
        Ok(())
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.beside);
        unfinished().retain(|path| path != &self.beside);
    }
}
