// SPDX-License-Identifier: MIT OR Apache-2.0
//! A block of the pipeline with its golden model beside it.

use super::PipelineError;
use crate::binding::{Beat, Binding, Expected, Model};
use crate::device::Stage;
use crate::scoreboard::{Mismatch, hexadecimal};
use relief_hdl::widths::WidthSet;
use std::collections::VecDeque;

/// A block and what its golden model expects it to send.
pub(super) struct Unit {
    pub(super) name: &'static str,
    pub(super) stage: Stage,
    model: Box<dyn Model>,
    expected: VecDeque<Expected>,
    scratch: Vec<Expected>,
    offered: Option<Beat>,
    /// Beats compared.
    pub(super) compared: u64,
}

impl Unit {
    pub(super) fn new(binding: &'static dyn Binding, set: &WidthSet) -> Self {
        let mut stage = Stage::new(binding.device(set));
        stage.inputs[stage.layout.out_ready] = 1;
        Self {
            name: binding.name(),
            stage,
            model: binding.model(set),
            expected: VecDeque::new(),
            scratch: Vec::new(),
            offered: None,
            compared: 0,
        }
    }
    /// Whether a beat waits at the input.
    pub(super) fn offers(&self) -> bool {
        self.offered.is_some()
    }
    pub(super) fn offer(&mut self, beat: &Beat) {
        self.stage.offer(beat);
        self.offered = Some(beat.clone());
    }
    /// Whether a beat that stands at the output is taken in this cycle.
    pub(super) fn take(&mut self, ready: bool) {
        self.stage.inputs[self.stage.layout.out_ready] = u64::from(ready);
    }
    pub(super) fn settle(&mut self) {
        self.stage.settle();
    }
    /// Once settled: compares the beat that leaves, and hands the one that comes to the golden model. The inputs of the
    /// next cycle are not touched before the edge but for `in_valid`.
    pub(super) fn finish(&mut self, sent: &mut Option<Beat>) -> Result<(), PipelineError> {
        if self.stage.sends() {
            *sent = Some(self.compare()?);
        }
        if self.stage.accepts()
            && let Some(beat) = self.offered.take()
        {
            self.model.accept(&beat, &mut self.scratch);
            self.expected.extend(self.scratch.drain(..));
        }
        Ok(())
    }
    /// To be called behind the edge: an accepted beat is offered no longer.
    pub(super) fn edge(&mut self) {
        if self.offered.is_none() {
            self.stage.withdraw();
        }
        self.stage.device.edge();
    }
    fn compare(&mut self) -> Result<Beat, PipelineError> {
        let words = self.stage.sent();
        let fail = |port: &str, expected: String, got: String| {
            let (beat, cycle) = (self.compared, self.stage.device.cycle());
            let mismatch = Mismatch { beat, cycle, port: port.into(), expected, got };
            PipelineError::Mismatch { block: self.name, mismatch }
        };
        let Some(expected) = self.expected.front() else {
            return Err(fail("out_valid", "no beat".into(), "a beat too many".into()));
        };
        let mut at = 0;
        for (port, _) in self.stage.layout.out_fields() {
            let range = at..at + port.words();
            let (want, got, mask) = (&expected.words[range.clone()], &words[range.clone()], &expected.mask[range]);
            if want.iter().zip(got).zip(mask).any(|((want, got), mask)| (want ^ got) & mask != 0) {
                return Err(fail(port.name, hexadecimal(want), hexadecimal(got)));
            }
            at += port.words();
        }
        self.expected.pop_front();
        self.compared += 1;
        Ok(words)
    }
    /// The sticky error is down, and everything that was expected has come.
    pub(super) fn no_error(&self) -> Result<(), PipelineError> {
        let error = self.stage.layout.outputs.iter().find(|(port, _)| port.name == "error");
        match error.is_some_and(|(_, at)| self.stage.outputs[*at] == 1) {
            true => Err(PipelineError::Sticky(self.name)),
            false => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::binding::find;
    use relief_hdl::widths::WIDTH_SETS;

    /// A golden model with a bit wrong in one beat.
    struct Lying {
        model: Box<dyn Model>,
        beats: u64,
    }

    impl Model for Lying {
        fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
            let first = expected.len();
            self.model.accept(beat, expected);
            for beat in &mut expected[first..] {
                beat.words[0] ^= u64::from(self.beats == 2) << 4;
                self.beats += 1;
            }
        }
    }

    /// The first difference ends the run, with block, beat, cycle, port and both values.
    #[test]
    fn unit_names_block_beat_port_and_both_values() {
        let set = &WIDTH_SETS[0];
        let binding = find("vertex_adder").unwrap();
        let mut unit = Unit::new(binding, set);
        unit.model = Box::new(Lying { model: binding.model(set), beats: 0 });
        let mut beats = binding.random(set, 1);
        let mut outcome = Ok(());
        for _ in 0..20 {
            if !unit.offers() {
                unit.offer(&beats.next().unwrap());
            }
            unit.settle();
            outcome = unit.finish(&mut None);
            if outcome.is_err() {
                break;
            }
            unit.edge();
        }
        let error = outcome.unwrap_err();
        let PipelineError::Mismatch { block: "vertex_adder", mismatch } = &error else { panic!("{error}") };
        assert_eq!((mismatch.beat, unit.compared), (2, 2));
        assert_ne!(mismatch.expected, mismatch.got);
        let Mismatch { cycle, port, expected, got, .. } = mismatch;
        let sentence = format!("beat 2, cycle {cycle}, port {port}: expected {expected}, got {got}");
        assert_eq!(error.to_string(), format!("vertex_adder differs from its golden model: {sentence}"));
        assert!(error.is_mismatch() && got.starts_with("0x"), "{error}");
    }
}
