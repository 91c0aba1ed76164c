// SPDX-License-Identifier: MIT OR Apache-2.0
//! Builds pyramids of maxima or minima: level 0 is the map, and every level halves the one below.
//!
//! ```text
//! node:  level L+1 node (i, j) = max of the 3 x 3 neighbours of node (2i, 2j) of level L
//!        clamp axis: floor(w / 2) + 1 nodes, indices clamped      repeat axis: w / 2 nodes, indices modulo w
//! cell:  level L+1 cell (i, j) = max of the 2 x 2 cells (2i .. 2i+1, 2j .. 2j+1) of level L: ceil(w / 2) cells
//! ```
//! (Gumhold & Huettner 1999, section 4, whose levels are 2 x 2; a node-centred 3 x 3 maximum, read bilinearly, is never
//! below the level below it, which a cell-centred one, read bilinearly, is not.)
//!
//! | field   | format | range |
//! |---------|--------|-------|
//! | samples | UQ16.0 | whole, row by row |
//! | levels  | count  | 1 ..= 15, level 0 included |
//!
//! Example: the row 1, 5, 2, 0 with `Clamp` gives nodes max(1, 5), max(5, 2, 0), max(0) = 5, 5, 0.
//!
//! Error: 0; maxima copy. A repeat axis needs an even period at every level, so that the four texels round a point stand
//! in four different banks of the memory that reads them.

use serde::Deserialize;
use thiserror::Error;

/// Levels that a pyramid has at most: a level is a number of four bits, and so is their count.
pub const MAX_LEVELS: usize = 15;

/// Where the samples of a level stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Centring {
    /// Node i of level L stands on texel i * 2^L.
    Node,
    /// Cell i of level L covers the texels i * 2^L .. (i + 1) * 2^L.
    Cell,
}

/// What lies beyond the border of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Wrap {
    /// The border sample.
    #[default]
    Clamp,
    /// The map again; its side is the period, which has to be even, or the four banks cannot be read in one cycle.
    Repeat,
}

/// What a level keeps of the level below.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Extremum {
    /// The largest sample.
    Max,
    /// The smallest sample.
    Min,
}

impl Extremum {
    /// The more extreme of two samples.
    pub fn of(self, a: u16, b: u16) -> u16 {
        match self {
            Self::Max => a.max(b),
            Self::Min => a.min(b),
        }
    }
}

/// One level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Level {
    /// Samples in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The samples, row by row.
    pub samples: Vec<u16>,
}

impl Level {
    /// The sample in column `i` of row `j`.
    pub fn at(&self, i: usize, j: usize) -> u16 {
        self.samples[j * self.width + i]
    }
}

/// A map and its levels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pyramid {
    /// The levels; level 0 is the map.
    pub levels: Vec<Level>,
    /// Where the samples stand.
    pub centring: Centring,
    /// The borders of the axes u and v.
    pub wrap: [Wrap; 2],
}

/// Why a pyramid cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MipError {
    /// No texel.
    #[error("the map has {width} x {height} texels, and needs at least one")]
    Empty {
        /// Texels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// The samples are not the map's.
    #[error("the map has {width} x {height} texels, and there are {samples} samples")]
    Samples {
        /// Texels in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Samples.
        samples: usize,
    },
    /// A count of levels that no pyramid has.
    #[error("a pyramid has 1 to {MAX_LEVELS} levels, not {0}")]
    Levels(usize),
    /// A repeat axis whose period is odd at a level.
    #[error("along {axis} the map repeats after {period} texels at level {level}, and a period must be even")]
    OddPeriod {
        /// `u` or `v`.
        axis: char,
        /// The level.
        level: usize,
        /// Its period.
        period: usize,
    },
    /// Pole rows on an axis that has no ends.
    #[error("a map that repeats along v has no poles")]
    NoPoles,
}

/// Side of the level above one of `side` samples.
pub fn side_above(side: usize, centring: Centring, wrap: Wrap) -> usize {
    match (centring, wrap) {
        (Centring::Node, Wrap::Clamp) => side / 2 + 1,
        (Centring::Node, Wrap::Repeat) => side / 2,
        (Centring::Cell, _) => side.div_ceil(2),
    }
}

/// Levels that a map of this size can have: as many as its repeat axes allow, and no more than it takes to halve both
/// sides down to two samples (one for a side of one).
pub fn max_levels(width: usize, height: usize, centring: Centring, wrap: [Wrap; 2]) -> usize {
    let mut sides = [width, height];
    let mut levels = 0;
    while levels < MAX_LEVELS {
        if (0..2).any(|axis| wrap[axis] == Wrap::Repeat && (sides[axis] == 0 || sides[axis] % 2 == 1)) {
            break;
        }
        levels += 1;
        let above = [0, 1].map(|axis| side_above(sides[axis], centring, wrap[axis]));
        if above == sides {
            break;
        }
        sides = above;
    }
    levels
}

/// The pyramid of a map.
///
/// # Errors
/// See [`MipError`].
pub fn golden(
    width: usize,
    height: usize,
    samples: &[u16],
    centring: Centring,
    wrap: [Wrap; 2],
    extremum: Extremum,
    levels: usize,
) -> Result<Pyramid, MipError> {
    build(Map { width, height, samples }, centring, wrap, extremum, levels, false)
}

/// The pyramid of a map whose first and last rows are poles: at every level, level 0 included, each of them is replaced
/// by its own extremum, so that a pole has one height however it is approached.
///
/// # Errors
/// See [`MipError`].
pub fn golden_with_poles(
    width: usize,
    height: usize,
    samples: &[u16],
    centring: Centring,
    wrap: [Wrap; 2],
    extremum: Extremum,
    levels: usize,
) -> Result<Pyramid, MipError> {
    build(Map { width, height, samples }, centring, wrap, extremum, levels, true)
}

#[derive(Clone, Copy)]
struct Map<'a> {
    width: usize,
    height: usize,
    samples: &'a [u16],
}

fn build(
    map: Map<'_>,
    centring: Centring,
    wrap: [Wrap; 2],
    extremum: Extremum,
    levels: usize,
    poles: bool,
) -> Result<Pyramid, MipError> {
    let Map { width, height, samples } = map;
    if width == 0 || height == 0 {
        return Err(MipError::Empty { width, height });
    }
    if samples.len() != width * height {
        return Err(MipError::Samples { width, height, samples: samples.len() });
    }
    if !(1..=MAX_LEVELS).contains(&levels) {
        return Err(MipError::Levels(levels));
    }
    if poles && wrap[1] == Wrap::Repeat {
        return Err(MipError::NoPoles);
    }
    let mut below = Level { width, height, samples: samples.to_vec() };
    let mut built = Vec::with_capacity(levels);
    for level in 0..levels {
        for (axis, period, name) in [(0, below.width, 'u'), (1, below.height, 'v')] {
            if wrap[axis] == Wrap::Repeat && period % 2 == 1 {
                return Err(MipError::OddPeriod { axis: name, level, period });
            }
        }
        if poles {
            replace_poles(&mut below, height - 1, level, centring, extremum);
        }
        let next = above(&below, centring, wrap, extremum);
        built.push(std::mem::replace(&mut below, next));
    }
    Ok(Pyramid { levels: built, centring, wrap })
}

/// The level above `below`.
fn above(below: &Level, centring: Centring, wrap: [Wrap; 2], extremum: Extremum) -> Level {
    let width = side_above(below.width, centring, wrap[0]);
    let height = side_above(below.height, centring, wrap[1]);
    let mut samples = Vec::with_capacity(width * height);
    for j in 0..height {
        let rows = neighbours(j, below.height, centring, wrap[1]);
        for i in 0..width {
            let columns = neighbours(i, below.width, centring, wrap[0]);
            let all = rows.iter().flat_map(|&y| columns.iter().map(move |&x| below.at(x, y)));
            samples.push(all.reduce(|a, b| extremum.of(a, b)).unwrap_or(0));
        }
    }
    Level { width, height, samples }
}

/// The samples below sample `i` along an axis of `side` samples; one may come twice.
fn neighbours(i: usize, side: usize, centring: Centring, wrap: Wrap) -> [usize; 3] {
    let indices = match centring {
        Centring::Node => [2 * i as isize - 1, 2 * i as isize, 2 * i as isize + 1],
        Centring::Cell => [2 * i as isize, 2 * i as isize, 2 * i as isize + 1],
    };
    indices.map(|index| match wrap {
        Wrap::Clamp => index.clamp(0, side as isize - 1) as usize,
        Wrap::Repeat => index.rem_euclid(side as isize) as usize,
    })
}

/// Gives each pole one value: the extremum of the rows that a point on it reads. The last row of the map may lie between
/// two rows of nodes; then both are the pole's.
fn replace_poles(level: &mut Level, last: usize, number: usize, centring: Centring, extremum: Extremum) {
    let lower = level.height - 1;
    let bottom = match centring {
        Centring::Node => (last >> number).min(lower)..=last.div_ceil(1 << number).min(lower),
        Centring::Cell => lower..=lower,
    };
    for rows in [0..=0, bottom] {
        let rows = &mut level.samples[rows.start() * level.width..(rows.end() + 1) * level.width];
        let pole = rows.iter().copied().reduce(|a, b| extremum.of(a, b)).unwrap_or(0);
        rows.fill(pole);
    }
}

/// Exact reference: sample (i, j) of a level straight from the map, as the extremum of the texels that it covers.
///
/// A node covers the texels less than 2^L away from it, a cell its own 2^L x 2^L, both within the map or around it.
pub fn exact(
    (width, height): (usize, usize),
    samples: &[u16],
    centring: Centring,
    wrap: [Wrap; 2],
    extremum: Extremum,
    level: usize,
    (i, j): (usize, usize),
) -> u16 {
    let covers = |index: usize, side: usize, wrap: Wrap| -> Vec<usize> {
        let step = 1isize << level;
        let first = index as isize * step;
        let range = match centring {
            Centring::Node => first - step + 1..first + step,
            Centring::Cell => first..first + step,
        };
        match wrap {
            Wrap::Clamp => (0..side).filter(|&x| range.contains(&(x as isize))).collect(),
            Wrap::Repeat => range.map(|x| x.rem_euclid(side as isize) as usize).collect(),
        }
    };
    let (columns, rows) = (covers(i, width, wrap[0]), covers(j, height, wrap[1]));
    let all = rows.iter().flat_map(|&y| columns.iter().map(move |&x| samples[y * width + x]));
    all.reduce(|a, b| extremum.of(a, b)).unwrap_or(0)
}

/// A map's size and what is to be built of it, as the builder in hardware takes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildSize {
    /// Texels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The borders of the axes u and v.
    pub wrap: [Wrap; 2],
    /// Where the samples stand.
    pub centring: Centring,
    /// Levels, the map included.
    pub levels: usize,
    /// Whether the first and the last row are poles; not where the map repeats along v.
    pub poles: bool,
}

/// A node that the builder sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Node {
    /// Level, 1 and up; 0 for a pole row of the map.
    pub level: usize,
    /// Column.
    pub i: usize,
    /// Row.
    pub j: usize,
    /// Maximum.
    pub max: u16,
    /// Minimum.
    pub min: u16,
    /// The last node of the last level.
    pub last: bool,
}

/// Golden model of the builder: collects a map and sends the nodes of its levels, with poles the pole rows of the map
/// before them.
#[derive(Clone, Debug)]
pub struct MipBuild {
    nodes: usize,
    map: Option<(BuildSize, Vec<u16>)>,
    error: bool,
}

impl MipBuild {
    /// A builder whose memory holds `nodes` nodes of level 1.
    pub const fn new(nodes: usize) -> Self {
        Self { nodes, map: None, error: false }
    }

    /// Sticky: a size that cannot be used, a size before the map was complete, a texel without a size.
    pub const fn error(&self) -> bool {
        self.error
    }

    /// Takes a size.
    pub fn size(&mut self, size: BuildSize) {
        self.error |= self.map.is_some();
        let BuildSize { width, height, wrap, centring, levels, poles } = size;
        let fits =
            levels < 2 || side_above(width, centring, wrap[0]) * side_above(height, centring, wrap[1]) <= self.nodes;
        // The periods of every level, of a map of zeros along each axis.
        let even = (0..levels).all(|level| {
            [(width, wrap[0]), (height, wrap[1])]
                .iter()
                .all(|(side, wrap)| *wrap == Wrap::Clamp || side >> level & 1 == 0)
        });
        let sound = width > 0 && height > 0 && (1..=MAX_LEVELS).contains(&levels) && even && fits;
        let sound = sound && !(poles && wrap[1] == Wrap::Repeat);
        self.error |= !sound;
        self.map = sound.then(|| (size, Vec::new()));
    }

    /// Takes a texel; the last one of a map gives the nodes of all levels.
    pub fn texel(&mut self, value: u16) -> Vec<Node> {
        let Some((size, mut texels)) = self.map.take() else {
            self.error = true;
            return Vec::new();
        };
        texels.push(value);
        if texels.len() < size.width * size.height {
            self.map = Some((size, texels));
            return Vec::new();
        }
        let BuildSize { width, height, wrap, centring, levels, poles } = size;
        let map = Map { width, height, samples: &texels };
        let build = |extremum| build(map, centring, wrap, extremum, levels, poles);
        let (Ok(most), Ok(least)) = (build(Extremum::Max), build(Extremum::Min)) else {
            // A size that was taken has a pyramid.
            unreachable!("{size:?}");
        };
        let mut nodes = Vec::new();
        for (level, (most, least)) in most.levels.iter().zip(&least.levels).enumerate() {
            let is_sent = |j: &usize| level > 0 || poles && (*j == 0 || j + 1 == height);
            for (i, j) in (0..most.height).filter(is_sent).flat_map(|j| (0..most.width).map(move |i| (i, j))) {
                nodes.push(Node { level, i, j, max: most.at(i, j), min: least.at(i, j), last: false });
            }
        }
        if let Some(node) = nodes.last_mut() {
            node.last = true;
        }
        nodes
    }
}
