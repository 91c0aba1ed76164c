// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cuts a window of cycles out of a waveform file.
//!
//! The result holds exactly the cycles asked for: it opens with the values as they stand after the edge before the
//! window, goes through every change within, glitches included, and closes with the edge that ends the last cycle.

use crate::read::{Loaded, ReadError};
use std::{
    collections::BTreeMap,
    fs::File,
    io::{self, BufWriter, Write},
    ops::Range,
    path::{Path, PathBuf},
};
use thiserror::Error;
use vcd::{IdCode, ReferenceIndex, SimulationCommand, TimescaleUnit, Value, VarType, Writer};
use wellen::{SignalEncoding, SignalRef, SignalValueRef};

/// Why a waveform cannot be cut.
#[derive(Debug, Error)]
pub enum TrimError {
    /// The source cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The result cannot be written.
    #[error("`{path}` cannot be written: {cause}")]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// Nothing of the window is in the file.
    #[error("cycles {}..{} were asked for, and the file holds {}..{}", .asked.start, .asked.end, .held.start, .held.end)]
    Empty {
        /// The window.
        asked: Range<u64>,
        /// What the file holds.
        held: Range<u64>,
    },
}

/// A scope on its way into the new file.
#[derive(Default)]
struct Node {
    scopes: Vec<(String, Node)>,
    vars: Vec<(String, SignalRef)>,
}

/// Writes the cycles of `window` that `input` (VCD or FST) holds to the VCD file `output`, and returns which they are.
pub fn trim(input: impl AsRef<Path>, output: impl AsRef<Path>, window: Range<u64>) -> Result<Range<u64>, TrimError> {
    let loaded = Loaded::open(input.as_ref(), "clock")?;
    let edges = loaded.rising_edges();
    let times = loaded.waveform.time_table();
    let edge_times: Vec<u64> = edges.iter().map(|&edge| times[edge as usize]).collect();
    let first = loaded.first_cycle(&edge_times);
    let held = first..first + edges.len() as u64;
    let cut = window.start.max(held.start)..window.end.min(held.end);
    if cut.is_empty() {
        return Err(TrimError::Empty { asked: window, held });
    }
    // The window opens at the edge before its first cycle, or with the file.
    let from = (cut.start - first).checked_sub(1).map_or(0, |edge| edges[edge as usize]);
    let to = edges[(cut.end - 1 - first) as usize];

    let path = output.as_ref();
    let write = |cause| TrimError::Write { path: path.to_path_buf(), cause };
    let file = File::create(path).map_err(write)?;
    copy(&loaded, from..to, BufWriter::new(file)).map_err(write)?;
    Ok(cut)
}

/// `span` runs over indices into the table of times; of its end only the clock is written.
fn copy(loaded: &Loaded, span: Range<u32>, file: impl Write) -> io::Result<()> {
    let mut root = Node::default();
    for (name, signal) in &loaded.signals {
        let (mut node, mut rest) = (&mut root, name.as_str());
        while let Some((scope, inner)) = rest.split_once('.') {
            let index = node.scopes.iter().position(|(name, _)| name == scope).unwrap_or_else(|| {
                node.scopes.push((scope.to_string(), Node::default()));
                node.scopes.len() - 1
            });
            (node, rest) = (&mut node.scopes[index].1, inner);
        }
        node.vars.push((rest.to_string(), *signal));
    }

    let mut out = Writer::new(file);
    out.version("relief-waves, trimmed")?;
    let (factor, unit) = timescale(loaded);
    out.timescale(factor, unit)?;
    let mut ids = BTreeMap::new();
    declare(&mut out, &root, loaded, &mut ids)?;
    out.enddefinitions()?;

    // Every change of the window by time; what stands at its start comes first.
    let mut changes: BTreeMap<u32, Vec<(IdCode, SignalValueRef<'_>)>> = BTreeMap::new();
    for (signal, id) in &ids {
        let Some(trace) = loaded.waveform.get_signal(*signal) else { continue };
        let is_clock = *signal == loaded.clock_signal;
        let mut standing = None;
        for (index, value) in trace.iter_changes() {
            if index <= span.start {
                standing = Some(value);
            } else if index < span.end || (is_clock && index == span.end) {
                changes.entry(index).or_default().push((*id, value));
            } else {
                break;
            }
        }
        if let Some(value) = standing {
            changes.entry(span.start).or_default().push((*id, value));
        }
    }
    for (index, values) in changes {
        out.timestamp(loaded.waveform.time_table()[index as usize])?;
        if index == span.start {
            out.begin(SimulationCommand::Dumpvars)?;
        }
        for (id, value) in values {
            change(&mut out, id, value)?;
        }
        if index == span.start {
            out.end()?;
        }
    }
    out.flush()
}

fn declare<W: Write>(
    out: &mut Writer<W>,
    node: &Node,
    loaded: &Loaded,
    ids: &mut BTreeMap<SignalRef, IdCode>,
) -> io::Result<()> {
    for (name, signal) in &node.vars {
        let hierarchy = loaded.waveform.hierarchy();
        let (kind, bits) = match hierarchy.get_signal_tpe(*signal) {
            Some(SignalEncoding::Real) => (VarType::Real, 64),
            Some(SignalEncoding::BitVector(bits)) => (VarType::Wire, bits),
            _ => (VarType::String, 1),
        };
        let index = match bits {
            _ if kind != VarType::Wire => None,
            // As the recorder does, and for the same reason.
            1 => name.ends_with(']').then_some(ReferenceIndex::BitSelect(0)),
            bits => Some(ReferenceIndex::Range(bits as i32 - 1, 0)),
        };
        // Two names of one signal share its code, as in the source.
        match ids.get(signal) {
            Some(id) => out.var_def(kind, bits, *id, name, index)?,
            None => {
                let id = out.add_var(kind, bits, name, index)?;
                ids.insert(*signal, id);
            }
        }
    }
    for (name, scope) in &node.scopes {
        out.add_module(name)?;
        declare(out, scope, loaded, ids)?;
        out.upscope()?;
    }
    Ok(())
}

fn change<W: Write>(out: &mut Writer<W>, id: IdCode, value: SignalValueRef<'_>) -> io::Result<()> {
    match value {
        SignalValueRef::Event => out.change_scalar(id, true),
        SignalValueRef::String(text) => out.change_string(id, text),
        SignalValueRef::Real(real) => out.change_real(id, real),
        SignalValueRef::BitVec(vector) => {
            let mut bits = vector.iter_msb_to_lsb().map(|bit| match bit.as_ascii() {
                '0' => Value::V0,
                '1' => Value::V1,
                'z' => Value::Z,
                _ => Value::X,
            });
            match vector.width() {
                1 => bits.next().map_or(Ok(()), |bit| out.change_scalar(id, bit)),
                _ => out.change_vector(id, bits),
            }
        }
    }
}

fn timescale(loaded: &Loaded) -> (u32, TimescaleUnit) {
    let Some(scale) = loaded.waveform.hierarchy().timescale() else { return (1, TimescaleUnit::NS) };
    let unit = match scale.unit {
        wellen::TimescaleUnit::FemtoSeconds => TimescaleUnit::FS,
        wellen::TimescaleUnit::PicoSeconds => TimescaleUnit::PS,
        wellen::TimescaleUnit::MicroSeconds => TimescaleUnit::US,
        wellen::TimescaleUnit::MilliSeconds => TimescaleUnit::MS,
        wellen::TimescaleUnit::Seconds => TimescaleUnit::S,
        _ => TimescaleUnit::NS,
    };
    (scale.factor, unit)
}
