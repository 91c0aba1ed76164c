// SPDX-License-Identifier: MIT OR Apache-2.0
//! A scene through the whole datapath as one emitted design in Verilator, compared with the golden machine beat by beat.
//!
//! ```text
//! host      scene -> commands of its draws, one draw behind the other
//! hardware  displacement_pipeline, emitted -> lit triangles, counters (golden: levels of the maps, rasteriser)
//! ```
//!
//! No block runs in Rust. Without stalls the sink takes every triangle at once, so the counters of time are those of a design
//! that is not held up from behind. With stalls, at random, every stream that can wait is held up: at both ends, and
//! between the blocks by gates in the emitted text.

use super::prepare::{Prepared, PreparedObject};
use super::{corner, lights_of};
use crate::binding::{Expected, expect_offered};
use crate::check::{CheckError, emitted};
use crate::cosim::{CosimError, Link, Stalls, Stream, Streamed, Verilator};
use crate::displacement_pipeline::{
    DisplacementPipelineBinding, command_beat, expected_of, machine, report_of, triangle_of,
};
use relief_hdl::widths::WidthSet;
use relief_models::displacement_pipeline::{Command, commands, counter, no_place};
use relief_models::light::Light;
use relief_models::mesh::{InputError, Progress};
use relief_models::raster::Frame;
use relief_models::scene::{Entry, Scene};
use relief_models::step::Vertex;
use serde::Serialize;
use std::fmt;

/// Cycles without an output beat after which nothing more comes: all has left before the last counter is asked for.
const DRAIN: u64 = 4096;

/// The streams between blocks that can be held up. Inside of `vertices` and `shading` none can: a beat goes once there is a
/// place for its result.
pub const LINKS: [Link; 8] = {
    const fn link(module: &'static str, instance: &'static str, ports: [&'static str; 2]) -> Link {
        Link { module, instance, ports }
    }
    const TOP: &str = "relief_displacement_pipeline";
    const ASSEMBLY: &str = "relief_assembly";
    const OUT: [&str; 2] = ["out_valid", "out_ready"];
    [
        link(ASSEMBLY, "cull", OUT),
        link(ASSEMBLY, "clip", OUT),
        link(TOP, "assembly", ["piece_valid", "piece_ready"]),
        link(TOP, "remesher", OUT),
        link(TOP, "passer", OUT),
        link(TOP, "vertices", OUT),
        link(TOP, "strip_unit", OUT),
        link(TOP, "shading", OUT),
    ]
};

/// Why a scene was not drawn by the design.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// The design does not do what the scene asks for.
    #[error("{0}")]
    Refused(String),
    /// The scene does not fit.
    #[error(transparent)]
    Scene(#[from] InputError),
    /// The block cannot be emitted.
    #[error(transparent)]
    Emit(#[from] CheckError),
    /// The design cannot be run.
    #[error(transparent)]
    Cosim(#[from] CosimError),
    /// The design and the machine disagree.
    #[error("displacement_pipeline of Verilator differs from the golden machine: {0}")]
    Mismatch(String),
}

impl DesignError {
    /// Whether the hardware is wrong, rather than the input.
    pub const fn is_mismatch(&self) -> bool {
        matches!(self, Self::Mismatch(_))
    }
}

/// The figures of a frame.
#[derive(Clone, Debug, Default, Serialize)]
pub struct DesignReport {
    /// Version of this report's fields.
    pub version: u32,
    /// The scene's file.
    pub scene: String,
    /// `design`.
    pub engine: &'static str,
    /// Its width set.
    pub width_set: &'static str,
    /// Seconds from the reading of the scene to this report.
    pub seconds: f64,
    /// Seconds of them in the simulator, its building not among them.
    pub simulation_seconds: f64,
    /// What was printed as warnings.
    pub warnings: Vec<String>,
    /// Cycles of a hundred in which each stream was held up.
    pub stalls: u8,
    /// Which of all patterns of them.
    pub seed: u32,
    /// Beats that the design took.
    pub commands: u64,
    /// Beats that it sent, each compared with the golden machine.
    pub beats: u64,
    /// Cycles from the reset to the last of them.
    pub cycles: u64,
    /// The objects of the scene, in order.
    pub objects: Vec<DrawReport>,
    /// Triangles that were sent.
    pub triangles: u64,
    /// Pixels that they covered, hidden ones included.
    pub fragments: u64,
    /// Pixels that show surface.
    pub pixels: u64,
    /// Output beats that differed from what was expected.
    pub mismatches: u64,
}

/// What the design counts in a draw.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs)] // `counter` says it.
pub struct DrawReport {
    pub base_triangles: u32,
    pub culled: CulledReport,
    pub cut: u32,
    pub dropped: DroppedReport,
    pub pieces: u32,
    pub steps: u32,
    pub vertices: u32,
    pub skipped: u32,
    pub strip_triangles: u32,
    pub no_place: NoPlaceReport,
    pub off_screen: u32,
    pub sent: u32,
    pub lost: u32,
    pub times: TimesReport,
}

/// By [`Reason`](relief_models::cull::Reason).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs)] // The reasons say it.
pub struct CulledReport {
    pub left: u32,
    pub right: u32,
    pub top: u32,
    pub bottom: u32,
    pub near: u32,
    pub far: u32,
}

/// By [`DropReason`](relief_models::draw::DropReason).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs)] // The reasons say it.
pub struct DroppedReport {
    pub near: u32,
    pub lane: u32,
    pub grid: u32,
}

/// By [`flag`](relief_models::displace::flag), the lowest one of the three vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs)] // The flags say it.
pub struct NoPlaceReport {
    pub invalid: u32,
    pub near: u32,
    pub range: u32,
}

impl NoPlaceReport {
    /// One triangle more, if it has no place.
    pub fn count(&mut self, triangle: &[Vertex; 3]) {
        match no_place(triangle) {
            None => {}
            Some(0) => self.invalid += 1,
            Some(1) => self.near += 1,
            Some(_) => self.range += 1,
        }
    }

    /// Both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        let Self { invalid, near, range } = other;
        Self { invalid: self.invalid + invalid, near: self.near + near, range: self.range + range }
    }
}

/// `12 without a place: 10 behind the eye, 2 nearer than near / 16`, naming what there is.
impl fmt::Display for NoPlaceReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { invalid, near, range } = *self;
        write!(f, "{} without a place", invalid + near + range)?;
        let named = [(invalid, "behind the eye"), (near, "nearer than near / 16"), (range, "beyond 8192 pixels")];
        for (k, (count, what)) in named.into_iter().filter(|(count, _)| *count > 0).enumerate() {
            write!(f, "{} {count} {what}", if k == 0 { ":" } else { "," })?;
        }
        Ok(())
    }
}

/// Cycles, see [`counter`].
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs)] // `counter` says it.
pub struct TimesReport {
    pub busy: u32,
    pub piece_waits: u32,
    pub no_step: u32,
    pub step_waits: u32,
    pub second_vertex_waits: u32,
    pub strip_waits: u32,
    pub receiver_waits: u32,
}

impl DrawReport {
    /// Of the reports of a draw, in the order of [`counter::all`].
    fn of(values: &[u32]) -> Self {
        let at = |number: usize| counter::all().position(|known| known == number).map_or(0, |k| values[k]);
        let reason = |first: usize, k: usize| at(first + k);
        Self {
            base_triangles: at(counter::BASES),
            culled: {
                let [left, right, top, bottom, near, far] = std::array::from_fn(|k| reason(counter::CULLED, k));
                CulledReport { left, right, top, bottom, near, far }
            },
            cut: at(counter::CUT),
            dropped: {
                let [near, lane, grid] = std::array::from_fn(|k| reason(counter::DROPPED, k));
                DroppedReport { near, lane, grid }
            },
            pieces: at(counter::PIECES),
            steps: at(counter::STEPS),
            vertices: at(counter::VERTICES),
            skipped: at(counter::SKIPPED),
            strip_triangles: at(counter::STRIP_TRIANGLES),
            no_place: {
                let [invalid, near, range] = std::array::from_fn(|k| reason(counter::NO_PLACE, k));
                NoPlaceReport { invalid, near, range }
            },
            off_screen: at(counter::OFF_SCREEN),
            sent: at(counter::SENT),
            lost: at(counter::LOST),
            times: TimesReport {
                busy: at(counter::BUSY),
                piece_waits: at(counter::PIECE_WAITS),
                no_step: at(counter::NO_STEP),
                step_waits: at(counter::STEP_WAITS),
                second_vertex_waits: at(counter::SECOND_VERTEX),
                strip_waits: at(counter::STRIP_WAITS),
                receiver_waits: at(counter::RECEIVER),
            },
        }
    }
}

/// Refuses what the design does not do: several lights, and width sets that do not have it.
///
/// # Errors
/// A sentence that says what, and what would do it.
pub fn expect_drawable(scene: &Scene, set: &WidthSet) -> Result<(), DesignError> {
    expect_offered(&DisplacementPipelineBinding, set).map_err(DesignError::Refused)?;
    match scene.lights.len() {
        0 | 1 => Ok(()),
        lights => Err(DesignError::Refused(format!(
            "the scene has {lights} lights, and the design of --engine design has one; --engine rust takes several"
        ))),
    }
}

/// The commands of the draws of a scene, one draw behind the other.
///
/// # Errors
/// A map has no levels.
pub fn commands_of(prepared: &Prepared<'_>) -> Result<Vec<Command>, InputError> {
    let scene = prepared.scene;
    let mut all = Vec::new();
    for (at, PreparedObject { object, draw, .. }) in prepared.objects.iter().enumerate() {
        let pyramids =
            scene.pyramids(object).map_err(|cause| scene.source.error(Entry::Object(at), cause.to_string()))?;
        // A scene without a light has one that is dark.
        let dark = Light { direction: [0; 3], colour: [0; 3] };
        let light = lights_of(scene, draw).first().copied().unwrap_or(dark);
        all.extend(commands(draw, &pyramids, &light, scene.camera.viewport, true));
    }
    Ok(all)
}

/// Takes a scene through the emitted design.
///
/// # Errors
/// The scene is not for it, or it is at fault.
pub fn render_by_design(
    prepared: &Prepared<'_>,
    set: &'static WidthSet,
    stalls: Stalls,
    progress: &dyn Progress,
) -> Result<(Frame, DesignReport), DesignError> {
    let scene = prepared.scene;
    expect_drawable(scene, set)?;
    let commands = commands_of(prepared)?;
    progress.phase("building", 0);
    let mut emitted = emitted(&DisplacementPipelineBinding, set, None)?;
    if stalls.percent > 0 {
        emitted.design.stall(&LINKS, stalls)?;
    }
    let stream = Stream::build(&emitted.design, &Verilator::new())?;
    progress.phase("drawing", 0);
    let beats: Vec<_> = commands.iter().map(command_beat).collect();
    let rows = stream.rows(beats.iter().map(Vec::as_slice));
    let begun = std::time::Instant::now();
    // Side by side: neither waits for the other.
    let (streamed, simulated, expected) = std::thread::scope(|scope| {
        let simulation = scope.spawn(|| (stream.run(&rows, DRAIN, stalls), begun.elapsed()));
        let expected = expected(set, &commands);
        let (streamed, simulated) = simulation.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        (streamed, simulated, expected)
    });
    let streamed = streamed?;
    compare(&streamed, &expected)?;
    let [width, height] = scene.camera.viewport;
    let mut frame = Frame::new(width, height);
    let mut report = DesignReport {
        version: 2,
        engine: "design",
        width_set: set.name,
        simulation_seconds: simulated.as_secs_f64(),
        stalls: stalls.percent,
        seed: stalls.seed,
        commands: commands.len() as u64,
        beats: streamed.beats.len() as u64,
        cycles: streamed.cycles,
        ..DesignReport::default()
    };
    let mut reports = Vec::new();
    for (_, words) in streamed.iter() {
        if let Some(value) = report_of(words) {
            reports.push(value);
            continue;
        }
        let (vertices, colour) = triangle_of(words);
        report.triangles += 1;
        report.fragments += frame.triangle(vertices.map(corner), colour);
    }
    report.objects = reports.chunks(counter::all().count()).map(DrawReport::of).collect();
    report.pixels = frame.depth.iter().filter(|depth| **depth > 0).count() as u64;
    Ok((frame, report))
}

/// What the golden machine sends.
fn expected(set: &WidthSet, commands: &[Command]) -> Vec<Expected> {
    let (mut machine, mut expected, mut sent) = (machine(set), Vec::new(), Vec::new());
    for command in commands {
        machine.accept(command, &mut |beat| sent.push(beat));
        let error = machine.error();
        expected.extend(sent.drain(..).map(|beat| expected_of(&beat, error)));
    }
    expected
}

/// Compares the beats of the design with those of the machine.
fn compare(streamed: &Streamed, expected: &[Expected]) -> Result<(), DesignError> {
    for (k, ((cycle, words), Expected { words: wanted, mask })) in streamed.iter().zip(expected).enumerate() {
        let differs = words.iter().zip(wanted).zip(mask).position(|((got, want), mask)| (got ^ want) & mask != 0);
        if let Some(at) = differs {
            let (got, want) = (words[at], wanted[at]);
            let what = format!("word {at} of beat {k}, in cycle {cycle}, is {got:#x}, and {want:#x} was expected");
            return Err(DesignError::Mismatch(what));
        }
    }
    let (got, wanted) = (streamed.beats.len(), expected.len());
    if got == wanted { Ok(()) } else { Err(DesignError::Mismatch(format!("{got} beats came of {wanted}"))) }
}
