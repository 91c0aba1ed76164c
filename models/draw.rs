// SPDX-License-Identifier: MIT OR Apache-2.0
//! The host's side of a draw: turns camera and mesh into per-draw constants and a vertex memory, and chains the blocks.
//!
//! ```text
//! host (f64)  ->  constants, records  ->  assemble (transform, cull, cut)  ->  remesher  ->  request  ->  height map
//!                                                                                               displace  ->  strip unit  ->  shade, world
//! ```
//!
//! f64 ends with [`Draw::new`]: from the records on everything is integers (the formats are in `docs/draw_formats.md`).
//! Only [`Draw::world`] goes back to f64, for files of points. No function of the platform is used, so a draw has the same
//! bits on every machine.
//!
//! **What keeps a mesh closed.** Whatever a vertex leaves with is a function of its data and of per-draw constants. Corners
//! of equal position and normal get equal lanes (but for u and v) and equal grid corners, and their texel density is that of
//! their *position*: the mean over all base triangles round it, weighted by area, `sqrt(texel area / world area)`. So the
//! copies that a wrap seam or a pole needs do not part.

use crate::clip;
use crate::cull::{self, Corner, Reason, Verdict};
use crate::digits::{rounded_up, short};
use crate::displace::{self, displaced};
use crate::face_normal::{self, Pixel};
use crate::facing;
use crate::filter_level;
use crate::lanes::Lanes;
use crate::light::{self, Light, Material};
use crate::perspective_correct::{self, Axis};
use crate::remesher::{BaseTriangle, Format};
use crate::rsqrt::normalize;
use crate::rules::{ExtremumRule, Rules};
use crate::step::Vertex;
use crate::vertex_transform::{self, BaseVertex, OutOfRange, Projected, Source, Transformed, ViewVertex, lane};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

/// Where the eye stands and what it sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraView {
    /// Position of the eye.
    pub eye: DVec3,
    /// A point in the middle of the picture.
    pub target: DVec3,
    /// A direction that points up in the picture.
    pub up: DVec3,
    /// Vertical field of view in radians.
    pub fov_y: f64,
    /// Near plane. Base triangles are cut at z0 = near / 16, so that displacement may bring surface nearer than its base.
    pub near: f64,
    /// Far plane; only culling uses it.
    pub far: f64,
    /// Columns and rows of the picture.
    pub viewport: [u32; 2],
    /// Side of a voxel in pixels.
    pub cell_px: f64,
}

/// What the host knows of the height map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapInfo {
    /// Columns of texels.
    pub width: usize,
    /// Rows of texels.
    pub height: usize,
    /// Whether u and v repeat; an axis that does not is clamped.
    pub repeat: [bool; 2],
    /// Levels of the pyramid, level 0 included.
    pub levels: usize,
}

/// A vertex of the base mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawVertex {
    /// Position in the world.
    pub position: DVec3,
    /// Direction of displacement, any length but zero.
    pub normal: DVec3,
    /// `[0, 1]` over the map: 1 is the last texel of a clamped axis, and the first one again of a repeating axis, where
    /// values below 2 are allowed.
    pub uv: DVec2,
}

/// Why a draw cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The sentences say it.
pub enum DrawError {
    #[error("{0} is not a finite number")]
    NotFinite(String),
    #[error("near is {near} and far is {far}; 0 < near < far is needed")]
    Planes { near: f64, far: f64 },
    #[error("the camera's eye is its target; it has no direction to look in")]
    NoDirection,
    #[error("the camera's up is zero or along its line of sight; it must lead out of it")]
    NoUp,
    #[error("the field of view is {0} radians; it must lie between 0 and pi")]
    FieldOfView(f64),
    #[error("the viewport is {0} x {1} pixels; 1 to 8192 are supported on each side")]
    Viewport(u32, u32),
    #[error(
        "`fov_y_deg` is {degrees} over {rows} rows of `viewport`, a focal length of {focal} pixels, and 0.0626 to 65535 are \
         supported; an angle from {low} to {high} degrees is expected"
    )]
    Focal { degrees: String, rows: u32, focal: String, low: String, high: String },
    #[error("cell_px is {0}; 1/64 to 4096 pixels are supported")]
    Cell(f64),
    #[error("the map is {0} x {1} texels; 1 to 8192 are supported on each side")]
    MapSize(usize, usize),
    #[error("the map has {0} levels; 1 to 14 are supported")]
    Levels(usize),
    #[error(
        "the map repeats along {axis} with a period of {period} texels, which {levels} levels cannot halve evenly; \
             make it a multiple of {multiple}, or take fewer levels"
    )]
    Period { axis: char, period: usize, levels: usize, multiple: usize },
    #[error("{axis} of vertex {vertex} is {value}; {range} is supported on this axis")]
    Uv { vertex: usize, axis: char, value: f64, range: &'static str },
    #[error("vertex {0} has a normal of length zero; there is no direction to displace it in")]
    NoNormal(usize),
    #[error("triangle {triangle} uses vertex {vertex}, but there are only {vertices}")]
    Index { triangle: usize, vertex: u32, vertices: usize },
    #[error(
        "`displacement` reaches {largest}, which is {ratio} times `near` / 16, and at most 32768 times is supported; at \
         most {most}, or a `near` of at least {least}, is expected"
    )]
    Displacement { largest: String, ratio: String, most: String, least: String },
    #[error(
        "`near` is {near}, and the scene reaches out to {extent}, which is more than 2^28 times `near` / 16 and so beyond \
         what positions resolve; a `near` of at least {least} is expected"
    )]
    Extent { near: String, extent: String, least: String },
    #[error(
        "the remesher format has vertices of {components} components of {bits} bits, and this draw takes {least} of at \
         most 32 bits, and 102 bits in all: position and texel coordinates{varying}; another format is expected"
    )]
    Format { components: usize, bits: u32, least: usize, varying: &'static str },
    #[error(transparent)]
    Remesher(#[from] crate::remesher::FormatError),
}

/// Why a base triangle is left out although it may be visible.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u8)]
pub enum DropReason {
    /// Nothing of it lies beyond z0.
    Near = 0,
    /// A corner's X or Y does not fit its lane.
    Lane = 1,
    /// A grid coordinate does not fit the remesher's format.
    Grid = 2,
}

/// What becomes of a base triangle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Assembled {
    /// Invisible, with all its displacement.
    Culled(Reason),
    /// Left out; the picture has a hole there.
    Dropped(DropReason),
    /// For the remesher: the triangle.
    Kept(Box<BaseTriangle>),
    /// For the remesher: what the constant planes have left of it, as a fan. It has a rim there.
    Cut(Vec<BaseTriangle>),
}

impl Assembled {
    /// What goes to the remesher.
    pub fn pieces(&self) -> &[BaseTriangle] {
        match self {
            Self::Kept(triangle) => std::slice::from_ref(&**triangle),
            Self::Cut(pieces) => pieces,
            Self::Culled(_) | Self::Dropped(_) => &[],
        }
    }
}

/// How many base triangles went which way. The counts only grow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Base triangles that went to the remesher, whole or cut.
    pub kept: u64,
    /// Those of them that z0 or the guard band has cut.
    pub cut: u64,
    /// Pieces that they made.
    pub pieces: u64,
    /// Culled.
    pub culled: Culled,
    /// Dropped.
    pub dropped: Dropped,
}

/// Culled base triangles, by [`Reason`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs)] // The reasons say it.
pub struct Culled {
    pub left: u64,
    pub right: u64,
    pub top: u64,
    pub bottom: u64,
    pub near: u64,
    pub far: u64,
}

impl Culled {
    /// All of them, with their reasons.
    pub fn named(&self) -> [(&'static str, u64); 6] {
        let Self { left, right, top, bottom, near, far } = *self;
        [("left", left), ("right", right), ("top", top), ("bottom", bottom), ("near", near), ("far", far)]
    }
    /// How many.
    pub fn total(&self) -> u64 {
        self.named().iter().map(|(_, count)| count).sum()
    }
}

/// Dropped base triangles, by [`DropReason`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Dropped {
    /// All of it is nearer than z0 or beyond the guard band.
    pub near: u64,
    /// X or Y does not fit its lane.
    pub lane: u64,
    /// A grid coordinate does not fit.
    pub grid: u64,
}

impl Dropped {
    /// How many.
    pub const fn total(&self) -> u64 {
        self.near + self.lane + self.grid
    }
}

impl Counts {
    /// Adds those of another draw.
    pub const fn add(&mut self, other: &Self) {
        self.kept += other.kept;
        self.cut += other.cut;
        self.pieces += other.pieces;
        self.culled.left += other.culled.left;
        self.culled.right += other.culled.right;
        self.culled.top += other.culled.top;
        self.culled.bottom += other.culled.bottom;
        self.culled.near += other.culled.near;
        self.culled.far += other.culled.far;
        self.dropped.near += other.dropped.near;
        self.dropped.lane += other.dropped.lane;
        self.dropped.grid += other.dropped.grid;
    }

    /// Counts one base triangle.
    pub fn count(&mut self, assembled: &Assembled) {
        match assembled {
            Assembled::Culled(reason) => {
                *match reason {
                    Reason::Left => &mut self.culled.left,
                    Reason::Right => &mut self.culled.right,
                    Reason::Top => &mut self.culled.top,
                    Reason::Bottom => &mut self.culled.bottom,
                    Reason::Near => &mut self.culled.near,
                    Reason::Far => &mut self.culled.far,
                } += 1;
            }
            Assembled::Dropped(reason) => {
                *match reason {
                    DropReason::Near => &mut self.dropped.near,
                    DropReason::Lane => &mut self.dropped.lane,
                    DropReason::Grid => &mut self.dropped.grid,
                } += 1;
            }
            Assembled::Kept(_) => {
                self.kept += 1;
                self.pieces += 1;
            }
            Assembled::Cut(pieces) => {
                self.kept += 1;
                self.cut += 1;
                self.pieces += pieces.len() as u64;
            }
        }
    }
}

/// What a vertex asks of the height map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Request {
    /// Filter level.
    pub level: u32,
    /// Texel column of level 0, UQ13.16.
    pub u: u32,
    /// Texel row of level 0, UQ13.16.
    pub v: u32,
    /// Whether the level is that of the minima.
    pub minima: bool,
}

/// A draw: constants, vertex memory and triangles, all integers.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Whether [`assemble`](Self::assemble) culls; `true` unless changed.
    pub cull: bool,
    /// Constants of the vertex transform.
    pub transform: vertex_transform::Constants,
    /// Constants of the culling.
    pub volume: cull::Constants,
    /// Constants of the filter level.
    pub level: filter_level::Constants,
    /// How a vertex finds its height. [`request`](Self::request) knows only those that the hardware has.
    pub rules: Rules,
    /// The map's axes u and v.
    pub axes: [Axis; 2],
    /// Constants of the displacement.
    pub displacement: displace::Constants,
    /// What of a vertex goes through the remesher.
    pub lanes: Lanes,
    /// The size of a pixel at distance 1.
    pub pixel: Pixel,
    /// What the surface looks like; [`Material::TERRAIN`] unless changed.
    pub material: Material,
    /// The vertex memory.
    pub records: Vec<BaseVertex>,
    /// Corners of the base triangles.
    pub triangles: Vec<[u32; 3]>,
    seams_are_exact: bool,
    exact_seams_near: f64,
    eye: DVec3,
    z0: f64,
}

/// The shortest focal length, pixels: above 1/16, at which a pixel of the transform is no longer exact.
const LEAST_FOCAL: f64 = 0.0626;

/// `value / 2^exponent` as integer, round half up.
fn quantise(value: f64, exponent: i32) -> i64 {
    // Saturates; callers have checked the range.
    (value * power_of_two(-exponent) + 0.5).floor() as i64
}

/// 2^exponent, exact, for `|exponent| < 1000`.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent.clamp(-1000, 1000)) as u64) << 52)
}

/// The smallest e with `value <= 2^e`, for finite `value > 0`.
fn exponent_above(value: f64) -> i32 {
    let (mut e, mut power) = (-1000, power_of_two(-1000));
    while power < value && e < 1000 {
        (e, power) = (e + 1, 2.0 * power);
    }
    e
}

/// `value` as a mantissa of 24 bits with the leading one set, and s: `mantissa 2^-s`.
fn mantissa(value: f64) -> (u32, i32) {
    // One above the floor of the logarithm, or the logarithm: the mantissa lies in (2^23, 2^24].
    let shift = 24 - exponent_above(value);
    match quantise(value, -shift) as u32 {
        0x100_0000 => (0x80_0000, shift - 1),
        m => (m, shift),
    }
}

fn finite(what: impl Fn() -> String, values: &[f64]) -> Result<(), DrawError> {
    if values.iter().all(|v| v.is_finite()) { Ok(()) } else { Err(DrawError::NotFinite(what())) }
}

impl Draw {
    /// Prepares a draw. `displacement` is in world units for the map values 0 and 65535.
    pub fn new(
        camera: &CameraView,
        vertices: &[DrawVertex],
        triangles: &[[u32; 3]],
        map: &MapInfo,
        displacement: [f64; 2],
        format: &Format,
    ) -> Result<Draw, DrawError> {
        validate(camera, vertices, triangles, map, displacement, format)?;
        let [columns, rows] = camera.viewport.map(f64::from);
        let tangent = libm::tan(camera.fov_y / 2.0);
        let (pixel, focal) = (2.0 * tangent / rows, rows / (2.0 * tangent));
        if !(LEAST_FOCAL..=65535.0).contains(&focal) {
            let degrees = |focal: f64| (2.0 * libm::atan(rows / (2.0 * focal))).to_degrees();
            return Err(DrawError::Focal {
                degrees: short(camera.fov_y.to_degrees()),
                rows: camera.viewport[1],
                focal: short(focal),
                low: short((degrees(65535.0) * 1e3).ceil() / 1e3),
                high: short((degrees(LEAST_FOCAL) * 1e3).floor() / 1e3),
            });
        }
        // Rows right, down, forward.
        let forward = (camera.target - camera.eye).try_normalize().ok_or(DrawError::NoDirection)?;
        let up = camera.up.try_normalize().ok_or(DrawError::NoUp)?;
        let right = forward.cross(up);
        if right.length() < 1e-6 {
            return Err(DrawError::NoUp);
        }
        let right = right.normalize();
        let rotation = [right, forward.cross(right), forward];
        let rotation = rotation.map(|row| row.to_array().map(|x| quantise(x, -30) as i32));

        // Positions and eye within 2^extent.
        let largest = vertices.iter().map(|v| v.position).chain([camera.eye]).map(|p| p.abs().max_element());
        let largest = largest.fold(camera.near, f64::max);
        let extent = exponent_above(largest);
        let place = |p: DVec3| p.to_array().map(|x| quantise(x, extent - 30) as i32);
        let eye = place(camera.eye);
        let translation = rotation.map(|row| -(0..3).map(|i| i64::from(row[i]) * i64::from(eye[i])).sum::<i64>());
        let unit = extent - 44;
        let z0 = quantise(camera.near / 16.0, unit);
        if z0 < 1 << 16 {
            let (near, extent) = (short(camera.near), short(largest));
            return Err(DrawError::Extent { near, extent, least: short(rounded_up(power_of_two(unit + 20))) });
        }
        // From here on z0 is what the integers say.
        let near = z0 as f64 * power_of_two(unit);
        let mut transform = vertex_transform::Constants {
            rotation,
            translation,
            z0,
            focal: quantise(focal, -16) as u32,
            inverse_cell: quantise(1.0 / camera.cell_px, -24) as u32,
            // log2(1 + s cell) by log1p: s cell may be far below 1.
            octave: quantise(std::f64::consts::LN_2 / libm::log1p(pixel * camera.cell_px), -16)
                .clamp(1, u32::MAX.into()) as u32,
            grid_bias: 0,
            coordinate_bits: format.coordinate_bits,
        };

        let axes = axes(vertices, map);
        let texel = |v: &DrawVertex| {
            std::array::from_fn(|k| {
                // Below 2^texel_bits by the choice of texel_bits.
                quantise(texels(v.uv[k], &axes[k]), axes[k].texel_bits as i32 - 32).clamp(0, u32::MAX.into()) as u32
            })
        };
        let mut records: Vec<BaseVertex> = vertices
            .iter()
            .map(|v| BaseVertex {
                position: place(v.position),
                normal: v.normal.normalize().to_array().map(|x| quantise(x, -30) as i32),
                texel: texel(v),
                density: 0,
            })
            .collect();
        let densities = densities(vertices, triangles, &records, &axes);
        let densest = densities.iter().copied().fold(0.0, f64::max);
        let mut level = filter_level::Constants { scale: 0, shift: 0, levels: map.levels as u32 };
        if densest > 0.0 {
            let unit = exponent_above(densest) - 10;
            for (record, density) in records.iter_mut().zip(&densities) {
                // 2^10 units of 2^unit are the most; 1.0 saturates.
                record.density = quantise(*density, unit + 10 - 32).clamp(0, u32::MAX.into()) as u32;
            }
            let step = near * pixel * camera.cell_px * power_of_two(unit);
            let (scale, shift) = mantissa(step);
            // Footprints beyond the formats: level 0 everywhere, or the last level wherever there is density.
            (level.scale, level.shift) = match shift {
                64.. => (0, 0),
                0..64 => (scale, shift as u32),
                _ => (0xff_ffff, 0),
            };
        }

        let reach = displacement[0].abs().max(displacement[1].abs());
        let exponent = if reach > 0.0 { exponent_above(reach / near).max(-30) } else { -30 };
        if exponent > 15 {
            let (largest, ratio, most) = (short(reach), short((reach / near).round()), short(near * 32768.0));
            return Err(DrawError::Displacement {
                largest,
                ratio,
                most,
                least: short(rounded_up(reach / 2048.0 * 1.0001)),
            });
        }
        let height = |d: f64| quantise(d / near, exponent - 30);
        let displacement = displace::Constants {
            minimum: height(displacement[0]),
            range: quantise((displacement[1] - displacement[0]) / near * 256.0 / 65535.0, exponent - 30),
            exponent,
            focal: transform.focal,
        };

        let views: Vec<ViewVertex> = records.iter().map(|record| vertex_transform::view(&transform, record)).collect();
        let volume = volume(camera, [columns / 2.0 / focal, rows / 2.0 / focal], reach, near, unit, &views);
        // The deepest vertex decides where the grid begins, and how exact seams are; but what is near stays in the grid.
        let depths = || views.iter().map(|view| view.position[2].max(z0));
        let (nearest, deepest) = (depths().min().unwrap_or(z0), depths().max().unwrap_or(z0));
        let c = |z: i64| ((i128::from(z0) << 31) / i128::from(z)).min(i32::MAX.into()) as i64;
        let (nearest, c) = (vertex_transform::depth(&transform, c(nearest)), c(deepest));
        let last = (1i64 << (format.coordinate_bits - 1)) - 1;
        // Below 32 octaves of 2^16 voxels.
        transform.grid_bias =
            (vertex_transform::depth(&transform, (c - 3).max(1)) - last).clamp(0, (nearest - 1 + last).max(0)) as i32;
        let lanes = lanes(format, &views)?;
        let texel_bits = axes[0].texel_bits.max(axes[1].texel_bits);
        let gone = 32 - lanes.bits;
        let seams_are_exact = (1i64 << texel_bits) << 7 <= c >> gone;
        // A thousandth for the rounding of z0.
        let exact_seams_near = deepest as f64 * power_of_two(unit + (texel_bits + gone) as i32 - 20) * 1.001;
        let (scale, shift) = mantissa(pixel);
        Ok(Draw {
            cull: true,
            transform,
            volume,
            level,
            rules: Rules::DEFAULT,
            axes,
            displacement,
            lanes,
            // The pixel is 1 / focal wide, at most 16 and at least 2^-16: exponents 19..=39.
            pixel: Pixel { scale, shift: shift.clamp(16, 48) as u32 },
            material: Material::TERRAIN,
            records,
            triangles: triangles.to_vec(),
            seams_are_exact,
            exact_seams_near,
            eye: DVec3::from_array(eye.map(|x| f64::from(x) * power_of_two(extent - 30))),
            z0: near,
        })
    }

    /// Whether the snap of [`perspective_correct`] is wide enough for the deepest vertex: `2^texel_bits z/z0 <= 2^24`, and
    /// a bit less for each bit that the lanes lack of 32.
    ///
    /// Beyond it the two sides of a wrap seam may part by a rounding, far away.
    pub const fn seams_are_exact(&self) -> bool {
        self.seams_are_exact
    }

    /// The near plane from which on [`seams_are_exact`](Self::seams_are_exact), all else being equal.
    pub const fn exact_seams_near(&self) -> f64 {
        self.exact_seams_near
    }

    /// z0 in world units, as the integers have it.
    pub const fn z0(&self) -> f64 {
        self.z0
    }

    /// The constants alone, before any of them has come; the machine of a design writes them one by one.
    pub(crate) fn blank(format: &Format) -> Draw {
        let (transform, volume) = vertex_transform::numbers::RESET;
        let axis = Axis { size: 1, repeat: false, texel_bits: 1 };
        Draw {
            cull: false,
            transform,
            volume,
            level: filter_level::Constants { scale: 0, shift: 0, levels: 1 },
            rules: Rules::DEFAULT,
            axes: [axis; 2],
            displacement: displace::Constants { minimum: 0, range: 0, exponent: 0, focal: transform.focal },
            lanes: Lanes { bits: format.vertex_bits, ..Lanes::WHOLE },
            pixel: Pixel { scale: 0, shift: 16 },
            material: Material { ramp: [[0; 3]; 5], ambient: [0; 3], specular: 0, shininess: 1 },
            records: Vec::new(),
            triangles: Vec::new(),
            seams_are_exact: true,
            exact_seams_near: 0.0,
            eye: DVec3::ZERO,
            z0: 1.0,
        }
    }

    /// Whether it displaces nothing, whatever the map says.
    pub const fn is_flat(&self) -> bool {
        self.displacement.minimum == 0 && self.displacement.range == 0
    }

    /// Transforms, culls and cuts base triangle `index`.
    pub fn assemble(&self, index: usize) -> Assembled {
        self.assemble_corners(&self.triangles[index].map(|vertex| self.transformed(self.records[vertex as usize])))
    }

    /// A record, transformed.
    pub fn transformed(&self, record: BaseVertex) -> Transformed {
        vertex_transform::golden(&self.transform, &self.volume, &Source::Record(record))
    }

    /// Culls and cuts the base triangle of three corners.
    pub fn assemble_corners(&self, corners: &[Transformed; 3]) -> Assembled {
        match cull::verdict(corners.each_ref().map(Corner::from), self.cull) {
            Verdict::Culled(reason) => Assembled::Culled(reason),
            Verdict::Dropped(reason) => dropped(reason),
            Verdict::Cut => self.assemble_pieces(corners.each_ref().map(|corner| corner.view)),
            Verdict::Kept => self.kept(corners),
        }
    }

    /// A base triangle whose corners all have a place.
    pub fn kept(&self, corners: &[Transformed; 3]) -> Assembled {
        let [Some(Ok(a)), Some(Ok(b)), Some(Ok(c))] = corners.each_ref().map(|corner| corner.projected) else {
            unreachable!("a corner of a kept base triangle is projected")
        };
        Assembled::Kept(Box::new(self.base_triangle([&a, &b, &c])))
    }

    /// What the constant planes leave of a base triangle.
    fn assemble_pieces(&self, corners: [ViewVertex; 3]) -> Assembled {
        let polygon = clip::golden(&self.transform, corners);
        if polygon.len() < 3 {
            return Assembled::Dropped(DropReason::Near);
        }
        let transformed = |view| vertex_transform::golden(&self.transform, &self.volume, &Source::View(view));
        self.cut_pieces(&polygon.into_iter().map(transformed).collect::<Vec<_>>())
    }

    /// The fan of a polygon of at least three vertices, all of them in front of z0.
    pub fn cut_pieces(&self, polygon: &[Transformed]) -> Assembled {
        let projected: Result<Vec<Projected>, OutOfRange> =
            polygon.iter().map(|v| v.projected.unwrap_or(Err(OutOfRange::Grid))).collect();
        match projected {
            Err(reason) => dropped(reason),
            Ok(p) => Assembled::Cut((1..p.len() - 1).map(|k| self.base_triangle([&p[0], &p[k], &p[k + 1]])).collect()),
        }
    }

    fn base_triangle(&self, corners: [&Projected; 3]) -> BaseTriangle {
        BaseTriangle { corners: corners.map(|v| v.corner), data: corners.map(|v| self.lanes.narrow(&v.data)) }
    }

    /// Where in the height map a vertex of the remesher looks.
    pub fn request(&self, vertex: &Vertex) -> Request {
        let vertex = self.lanes.widen(vertex);
        let inverse = perspective_correct::inverse(vertex[lane::C]);
        Request {
            level: filter_level::golden(&self.level, vertex[lane::DENSITY], inverse),
            u: perspective_correct::golden(vertex[lane::U], inverse, &self.axes[0]),
            v: perspective_correct::golden(vertex[lane::V], inverse, &self.axes[1]),
            minima: self.rules.extremum == ExtremumRule::Vertex && facing::of_vertex(&vertex, self.displacement.focal),
        }
    }

    /// The vertex displaced by a height, UQ16.8: lanes of [`displaced`], what the strip unit carries.
    pub fn displace(&self, vertex: &Vertex, height_uq16_8: u32) -> Vertex {
        displace::golden(&self.displacement, &self.lanes.widen(vertex), height_uq16_8)
    }

    /// Whether all vertices of a displaced triangle have a position.
    pub fn is_drawable(triangle: &[Vertex; 3]) -> bool {
        triangle.iter().all(|v| v[displaced::FLAGS] == 0)
    }

    /// A white-gold light from `direction` (towards the light, in the world); `None` for the zero vector.
    pub fn light(&self, direction: DVec3) -> Option<Light> {
        let direction = direction.try_normalize()?;
        let view = self.transform.rotation.map(|row| {
            let row = DVec3::from_array(row.map(|x| f64::from(x) * power_of_two(-30)));
            quantise(row.dot(direction), -30)
        });
        Some(Light { direction: normalize(view), colour: [0x1_1000, 0x1_0000, 0xd800] })
    }

    /// Colour of a displaced triangle by its face.
    pub fn shade(&self, triangle: [Vertex; 3], lights: &[Light]) -> [u8; 3] {
        let normal = face_normal::golden(&self.pixel, triangle.map(|v| [v[0], v[1], v[2]]));
        let position = [triangle[0][displaced::X], triangle[0][displaced::Y]];
        let heights = triangle.map(|v| v[displaced::HEIGHT]);
        light::shade(&self.material, lights, &self.pixel, position, heights, normal)
    }

    /// World position of a displaced vertex: a function of X', Y' and c' only, so equal integers give equal points.
    pub fn world(&self, vertex: &Vertex) -> DVec3 {
        let z = self.z0 * 2_147_483_648.0 / vertex[displaced::C] as f64;
        let pixel = f64::from(self.pixel.scale) * power_of_two(-(self.pixel.shift as i32)) / 256.0;
        let view = [vertex[displaced::X] as f64 * pixel * z, vertex[displaced::Y] as f64 * pixel * z, z];
        let mut world = self.eye;
        for (row, along) in self.transform.rotation.iter().zip(view) {
            world += along * DVec3::from_array(row.map(|x| f64::from(x) * power_of_two(-30)));
        }
        world
    }
}

/// The lanes that a remesher takes of the vertices: all, or those that are not the same everywhere.
fn lanes(format: &Format, views: &[ViewVertex]) -> Result<Lanes, DrawError> {
    let normal = views.first().map(|v| v.normal).filter(|n| views.iter().all(|v| v.normal == *n));
    let density = views.first().map(|v| v.density).filter(|d| views.iter().all(|v| v.density == *d));
    let (components, bits) = (format.components, format.vertex_bits);
    let whole = Lanes { bits, normal: None, density: None };
    // The fewer constants the better, where there is room.
    let choices = [(None, None), (None, density), (normal, None), (normal, density)];
    let mut choices = choices.map(|(normal, density)| Lanes { normal, density, ..whole }).into_iter();
    // The strip unit has the same components, and carries displaced vertices in them.
    let carries = components as u32 * bits >= displaced::BITS;
    choices.find(|lanes| bits <= 32 && carries && lanes.components() <= components).ok_or(DrawError::Format {
        components,
        bits,
        least: Lanes { normal, density, ..whole }.components(),
        varying: match (normal, density) {
            (None, None) => ", normal, and density of texels",
            (None, _) => ", and normal",
            (_, None) => ", and density of texels",
            _ => "",
        },
    })
}

fn dropped(reason: OutOfRange) -> Assembled {
    Assembled::Dropped(match reason {
        OutOfRange::Lane => DropReason::Lane,
        OutOfRange::Grid => DropReason::Grid,
    })
}

/// Texel coordinate of `uv` on an axis.
fn texels(uv: f64, axis: &Axis) -> f64 {
    uv * f64::from(if axis.repeat { axis.size } else { axis.size - 1 })
}

/// The axes with the smallest unit that holds every texel coordinate.
fn axes(vertices: &[DrawVertex], map: &MapInfo) -> [Axis; 2] {
    std::array::from_fn(|k| {
        let size = if k == 0 { map.width } else { map.height } as u32;
        let mut axis = Axis { size, repeat: map.repeat[k], texel_bits: 1 };
        let most = vertices.iter().map(|v| texels(v.uv[k], &axis)).fold(0.0, f64::max);
        while most + 0.5 >= f64::from(1u32 << axis.texel_bits) {
            axis.texel_bits += 1;
        }
        axis
    })
}

/// Texels a world unit at each vertex: `sqrt(texel area / world area)` of the base triangles round its position.
///
/// Positions are the same if their records are. A position without any area gets the mean of the mesh.
fn densities(vertices: &[DrawVertex], triangles: &[[u32; 3]], records: &[BaseVertex], axes: &[Axis; 2]) -> Vec<f64> {
    let mut round: FxHashMap<[i32; 3], [f64; 2]> = FxHashMap::default();
    let mut mesh = [0.0; 2];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| &vertices[v as usize]);
        let texel = |v: &DrawVertex| DVec2::new(texels(v.uv.x, &axes[0]), texels(v.uv.y, &axes[1]));
        let world = (b.position - a.position).cross(c.position - a.position).length();
        let map = (texel(b) - texel(a)).perp_dot(texel(c) - texel(a)).abs();
        // Triangles without area only sew copies together.
        if world <= 0.0 {
            continue;
        }
        let mut positions = triangle.map(|v| records[v as usize].position);
        positions.sort_unstable();
        for (k, position) in positions.iter().enumerate() {
            if k == 0 || positions[k - 1] != *position {
                let sum = round.entry(*position).or_default();
                (sum[0], sum[1]) = (sum[0] + map, sum[1] + world);
            }
        }
        mesh = [mesh[0] + map, mesh[1] + world];
    }
    let density = |[map, world]: [f64; 2]| if world > 0.0 { (map / world).sqrt() } else { 0.0 };
    records.iter().map(|record| density(*round.get(&record.position).unwrap_or(&mesh))).collect()
}

/// The volume of sight, extended by `reach` and by what rounding could take away.
fn volume(
    camera: &CameraView,
    tangent: [f64; 2],
    reach: f64,
    near: f64,
    unit: i32,
    views: &[ViewVertex],
) -> cull::Constants {
    let [horizontal, vertical] = tangent.map(|t| DVec2::new(1.0, t).normalize());
    let normal = [
        DVec3::new(horizontal.x, 0.0, horizontal.y),
        DVec3::new(-horizontal.x, 0.0, horizontal.y),
        DVec3::new(0.0, vertical.x, vertical.y),
        DVec3::new(0.0, -vertical.x, vertical.y),
        DVec3::Z,
        -DVec3::Z,
    ];
    // Two components of a normal, each off by at most 2^-15, over the farthest vertex; the unit vectors of the datapath
    // are too long by at most 2^-16.
    let far = views.iter().flat_map(|v| v.position).map(|x| x.unsigned_abs()).max().unwrap_or(0) as f64;
    let margin = far * power_of_two(-14) + 2.0;
    let reach = reach * (1.0 + power_of_two(-14)) * power_of_two(-unit) + margin;
    let (near, beyond) = (near * power_of_two(-unit), camera.far * power_of_two(-unit));
    let reach = [reach, reach, reach, reach, reach - near, reach + beyond];
    cull::Constants {
        normal: normal.map(|n| n.to_array().map(|x| quantise(x, -14) as i32)),
        // Saturates for far planes at the end of the world: beyond every position.
        reach: reach.map(|r| ((r * 16384.0).ceil() as i64).clamp(-(1 << 61), 1 << 61)),
    }
}

fn validate(
    camera: &CameraView,
    vertices: &[DrawVertex],
    triangles: &[[u32; 3]],
    map: &MapInfo,
    displacement: [f64; 2],
    format: &Format,
) -> Result<(), DrawError> {
    format.validate()?;
    let CameraView { eye, target, up, fov_y, near, far, viewport, cell_px } = *camera;
    for (name, value) in [("the camera's eye", eye), ("the camera's target", target), ("the camera's up", up)] {
        finite(|| format!("a coordinate of {name}"), &value.to_array())?;
    }
    finite(|| "the field of view".into(), &[fov_y])?;
    finite(|| "near or far".into(), &[near, far])?;
    finite(|| "the displacement".into(), &displacement)?;
    if !(near > 0.0 && far > near) {
        return Err(DrawError::Planes { near, far });
    }
    if !(fov_y > 0.0 && fov_y < std::f64::consts::PI) {
        return Err(DrawError::FieldOfView(fov_y));
    }
    if viewport.iter().any(|side| !(1..=8192).contains(side)) {
        return Err(DrawError::Viewport(viewport[0], viewport[1]));
    }
    if !(0.015625..=4096.0).contains(&cell_px) {
        return Err(DrawError::Cell(cell_px));
    }
    if [map.width, map.height].iter().any(|side| !(1..=8192).contains(side)) {
        return Err(DrawError::MapSize(map.width, map.height));
    }
    if !(1..=14).contains(&map.levels) {
        return Err(DrawError::Levels(map.levels));
    }
    let multiple = 1 << (map.levels - 1);
    for (axis, period, repeat) in [('u', map.width, map.repeat[0]), ('v', map.height, map.repeat[1])] {
        if repeat && period % multiple != 0 {
            return Err(DrawError::Period { axis, period, levels: map.levels, multiple });
        }
    }
    for (index, vertex) in vertices.iter().enumerate() {
        finite(|| format!("a coordinate of vertex {index}"), &vertex.position.to_array())?;
        finite(|| format!("a component of the normal of vertex {index}"), &vertex.normal.to_array())?;
        for (k, axis) in ['u', 'v'].into_iter().enumerate() {
            let value = vertex.uv[k];
            finite(|| format!("{axis} of vertex {index}"), &[value])?;
            let (fits, range) = if map.repeat[k] {
                ((0.0..2.0).contains(&value), "0 to below 2")
            } else {
                ((0.0..=1.0).contains(&value), "0 to 1")
            };
            if !fits {
                return Err(DrawError::Uv { vertex: index, axis, value, range });
            }
        }
        if vertex.normal.try_normalize().is_none() {
            return Err(DrawError::NoNormal(index));
        }
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(DrawError::Index { triangle, vertex, vertices: vertices.len() });
        }
    }
    Ok(())
}
