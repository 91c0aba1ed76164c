// SPDX-License-Identifier: MIT OR Apache-2.0
//! The drawings: which error over which cost.

use relief_testbench::method::Hardware;

use super::Point;

/// A drawing: an error over a cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// Greatest error, triangles.
    MaxTriangles,
    /// Root of the mean squared error, triangles.
    RmsTriangles,
    /// Greatest error, cycles.
    MaxCycles,
    /// Greatest error, words read.
    MaxReads,
    /// Greatest error, bits of memory.
    MaxMemory,
    /// Greatest error, seconds of software.
    MaxSeconds,
}

impl Figure {
    /// All of them.
    pub const ALL: [Figure; 6] = [
        Figure::MaxTriangles,
        Figure::RmsTriangles,
        Figure::MaxCycles,
        Figure::MaxReads,
        Figure::MaxMemory,
        Figure::MaxSeconds,
    ];

    /// As files and columns name it.
    pub const fn name(self) -> &'static str {
        match self {
            Figure::MaxTriangles => "max-triangles",
            Figure::RmsTriangles => "rms-triangles",
            Figure::MaxCycles => "max-cycles",
            Figure::MaxReads => "max-reads",
            Figure::MaxMemory => "max-memory",
            Figure::MaxSeconds => "max-seconds",
        }
    }

    /// As people read it.
    pub const fn title(self) -> &'static str {
        match self {
            Figure::MaxTriangles => "Greatest error over triangles",
            Figure::RmsTriangles => "RMS error over triangles",
            Figure::MaxCycles => "Greatest error over hardware cycles",
            Figure::MaxReads => "Greatest error over reads of the map memory",
            Figure::MaxMemory => "Greatest error over bits of the map memory",
            Figure::MaxSeconds => "Greatest error over seconds of software",
        }
    }

    /// Cost of a point; none where it has no such cost.
    pub fn cost(self, point: &Point) -> Option<f64> {
        let hardware = |what: fn(&Hardware) -> u64| point.hardware.as_ref().map(|hardware| what(hardware) as f64);
        match self {
            Figure::MaxTriangles | Figure::RmsTriangles => Some(point.heights.triangles as f64),
            Figure::MaxCycles => hardware(|hardware| hardware.cycles),
            Figure::MaxReads => hardware(|hardware| hardware.reads),
            Figure::MaxMemory => hardware(|hardware| hardware.memory_bits),
            Figure::MaxSeconds => Some(point.preparation_seconds + point.golden_seconds),
        }
    }

    /// Cost and error of a point, in map units; none where it has no such cost, or does not cover the map.
    pub fn place(self, point: &Point) -> Option<[f64; 2]> {
        let error = if self == Figure::RmsTriangles { point.rms() } else { point.heights.max };
        let covers = point.heights.uncovered == 0 && error.is_finite();
        self.cost(point).filter(|_| covers).map(|cost| [cost, error])
    }
}
