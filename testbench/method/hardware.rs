// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bisector on a map, stepped in Rust, with its Verilog behind it on request; every beat is compared with golden.

use super::{Engine, Hardware, Memories, MethodError};
use crate::binding::{Beat, Binding};
use crate::bisector::{BisectorBinding, command_beat, corners_of, load_beats};
use crate::device::{Layout, Stage};
use crate::replay::Replay;
use crate::scoreboard::PATIENCE;
use relief_hdl::widths::{WIDTH_SETS, WidthSet};
use relief_models::bisector::{Command, Counts, Lattice, Side, Triangle, Vertex};
use relief_models::mesh::Progress;

/// Words of an output beat: side, start and walker, and the end of the draw.
const FLAGS: std::ops::Range<usize> = 3..6;
const WALKER: usize = 5;
const END: usize = 6;
const CYCLES: usize = 7;

/// The narrowest width set whose lattice holds a map, and whose words hold its errors.
pub(super) fn width_set(lattice: &Lattice, error_bits: usize) -> Result<&'static WidthSet, MethodError> {
    let fits = |set: &&WidthSet| set.lattice_bits >= lattice.levels as usize && set.error_bits >= error_bits;
    WIDTH_SETS.iter().filter(fits).min_by_key(|set| (set.lattice_bits, set.error_bits)).ok_or_else(|| {
        let most = WIDTH_SETS.iter().map(|set| set.lattice_bits).max().unwrap_or_default();
        MethodError::Unfit(format!("no width set holds the map; {0} x {0} samples are the most", (1 << most) + 1))
    })
}

/// What golden sends.
struct Expected {
    triangles: Vec<(Triangle, [Vertex; 3])>,
    counts: Counts,
}

/// Draws a map and hands its triangles to `sink`, each with its walker, from the engine's own outputs.
///
/// # Errors
/// The hardware does not send what golden does, or the emitted module does not follow it.
pub(super) fn draw(
    memories: &Memories,
    engine: Engine,
    progress: &dyn Progress,
    sink: &mut dyn FnMut(usize, [Vertex; 3]),
) -> Result<Hardware, MethodError> {
    let lattice = &memories.lattice;
    let error_bits = memories.error_bits();
    let set = width_set(lattice, error_bits)?;
    let mut expected = Expected { triangles: Vec::new(), counts: Counts::default() };
    expected.counts = memories.golden(&mut |triangle| {
        expected.triangles.push((*triangle, triangle.corners.map(|at| memories.vertex(at))));
    });
    let mut stage = Stage::new(BisectorBinding.device(set));
    stage.inputs[stage.layout.out_ready] = 1;
    let folder = tempfile::tempdir();
    let mut module = match engine {
        Engine::Verilator => {
            progress.phase("building", 0);
            let folder =
                folder.as_ref().map_err(|error| MethodError::Unfit(format!("no folder to build in: {error}")))?;
            Replay::build(&[&stage], folder.path())?.pop()
        }
        _ => None,
    };
    let total = lattice.vertices() as u64 + expected.counts.turns;
    progress.phase("simulating", total);
    let draw = command_beat(&Command::Draw(memories.bound()));
    let mut beats = load_beats(lattice, |at| memories.error(at), |at| memories.heights[at]).chain([draw]);
    let mut offered = beats.next();
    let mut decoder = Decoder { layout: stage.layout.clone(), sent: 0, cycles: None };
    let (mut silent, mut ended) = (0, false);
    while !ended {
        if silent > PATIENCE {
            return Err(MethodError::Differs(format!("the bisector hangs in cycle {}", stage.device.cycle())));
        }
        silent += 1;
        match &offered {
            Some(beat) => stage.offer(beat),
            None => stage.withdraw(),
        }
        stage.settle();
        if stage.accepts() {
            offered = beats.next();
            silent = 0;
        }
        if stage.sends() {
            silent = 0;
            ended = decoder.compare(&stage.outputs, &expected)?;
            if module.is_none()
                && let Some((triangle, corners)) = expected.triangles.get(decoder.sent - 1).filter(|_| !ended)
            {
                sink(triangle.walker.into(), *corners);
            }
        }
        if let Some(module) = &mut module {
            module.note(&stage);
            if module.is_full() || ended {
                let outputs = module.run()?;
                let triangles = outputs.iter().filter_map(|outputs| decoder.triangle(outputs));
                triangles.for_each(|(walker, corners)| sink(walker, corners));
            }
        }
        stage.device.edge();
        if stage.device.cycle().is_multiple_of(4096) {
            progress.advance(stage.device.cycle().min(total));
        }
    }
    let (width, height) = (u64::from(lattice.width), u64::from(lattice.height));
    Ok(Hardware {
        cycles: decoder.cycles.unwrap_or_default(),
        // An error a visit, a height for each new vertex and the two that a strip begins with.
        reads: expected.counts.visits + expected.counts.triangles + 2 * expected.counts.strips,
        memory_bits: (error_bits * lattice.vertices()) as u64 + 20 * width * height,
    })
}

/// Reads output beats.
struct Decoder {
    layout: Layout,
    sent: usize,
    cycles: Option<u64>,
}

impl Decoder {
    fn words(&self, outputs: &[u64]) -> Beat {
        self.layout.out_fields().flat_map(|(port, at)| &outputs[*at..at + port.words()]).copied().collect()
    }
    /// The walker and the triangle of a cycle, if one stands at the output.
    fn triangle(&self, outputs: &[u64]) -> Option<(usize, [Vertex; 3])> {
        let valid = outputs[self.layout.out_valid] == 1;
        let words = valid.then(|| self.words(outputs)).filter(|words| words[END] == 0)?;
        Some((words[WALKER] as usize, corners_of(&words)))
    }
    /// Whether the draw is over.
    fn compare(&mut self, outputs: &[u64], expected: &Expected) -> Result<bool, MethodError> {
        let words = self.words(outputs);
        let (got, flags) = (corners_of(&words), &words[FLAGS]);
        let differs = |what: String| Err(MethodError::Differs(format!("the bisector, beat {}: {what}", self.sent)));
        let ends = words[END] == 1;
        match expected.triangles.get(self.sent) {
            None if ends => {}
            Some((triangle, corners)) if !ends => {
                let side = u64::from(triangle.side == Side::Right);
                if got != *corners || *flags != [side, triangle.start.into(), triangle.walker.into()] {
                    return differs(format!("{triangle:?} with {corners:?} was expected, and {got:?}, {flags:?} came"));
                }
            }
            Some((triangle, _)) => return differs(format!("{triangle:?} was expected, and the end came")),
            None => return differs(format!("the end was expected, and {got:?} came")),
        }
        self.sent += 1;
        if ends {
            self.cycles = Some(words[CYCLES]);
        }
        Ok(ends)
    }
}
