// SPDX-License-Identifier: MIT OR Apache-2.0
//! The waveform of the blocks that draw, side by side in one file.

use super::unit::Unit;
use super::{DRAW, Pipeline};
use crate::output::OutputFile;
use crate::probe::BlockProbe;
use relief_waves::record::RecordError;
use relief_waves::{Group, Item, Scope, SignalTree, VcdRecorder, gtkw};
use std::error::Error;
use std::fs::File;
use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Records a window of cycles, with a save file for GTKWave beside it.
pub struct PipelineRecording {
    probes: Vec<BlockProbe>,
    recorder: VcdRecorder<File>,
    words: Vec<u64>,
    path: PathBuf,
    wave: OutputFile,
    save: OutputFile,
}

impl PipelineRecording {
    /// Records the cycles of `window`, counted from the first base triangle, in the file `path`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn new(pipeline: &Pipeline, path: &Path, window: Range<u64>) -> Result<Self, Box<dyn Error>> {
        let probes = pipeline.units[DRAW]
            .iter()
            .map(|unit| BlockProbe::new(unit.name, unit.stage.device.block()))
            .collect::<Result<Vec<_>, _>>()?;
        let items = probes.iter().map(|probe| Item::Scope(probe.tree().root().clone())).collect();
        let tree = SignalTree::new(Scope { name: "relief".into(), items })?;
        let (wave, save) = (OutputFile::open(path)?, OutputFile::open(&path.with_extension("gtkw"))?);
        let recorder = VcdRecorder::new(wave.writer()?, tree, window);
        Ok(Self { probes, recorder, words: Vec::new(), path: path.into(), wave, save })
    }

    pub(super) fn sample(&mut self, units: &[Unit], cycle: u64) -> Result<(), RecordError> {
        if !self.recorder.wants(cycle) {
            return Ok(());
        }
        self.words.clear();
        for (probe, unit) in self.probes.iter_mut().zip(units) {
            self.words.extend_from_slice(probe.sample(unit.stage.device.block()));
        }
        self.recorder.sample(cycle, &self.words)
    }

    /// Closes the files. Without a cycle there are none.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn finish(self) -> Result<Option<Range<u64>>, Box<dyn Error>> {
        let Self { recorder, path, wave, mut save, .. } = self;
        let tree = recorder.tree().clone();
        let Some(held) = recorder.finish()? else { return Ok(None) };
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        save.write_all(gtkw(&tree, &Group::of_scopes(&tree), &name)?.as_bytes())?;
        wave.commit()?;
        save.commit()?;
        Ok(Some(held))
    }
}
