// SPDX-License-Identifier: MIT OR Apache-2.0
//! How near the normals that a surface is shaded with are to those of the land it stands for.
//!
//! | shading | a normal of | heights from |
//! |---|---|---|
//! | `face-point` | a triangle, [`face_normal`](crate::face_normal) | the map |
//! | `face-max` | a triangle | the maxima of [`mip_build`](crate::mip_build), what the pipeline reads |
//! | `gradient-average` | a vertex, [`gradient_normal`] | means of 2 x 2 |
//! | `gradient-max` | a vertex | the maxima |
//!
//! Vertices stand `step` texels apart over a flat base, and read the level for that step. What is shaded has a footprint,
//! a square of `step` texels round the middle of the triangle or round the vertex. Its own normal is the mean over the
//! footprint of the unit normals of the land, which is the map cut into triangles at every texel. The angle between both is
//! measured for a vertex in every texel, at four places within it, and for the two triangles to the right of it and below: at
//! Gauss's points, so that the mean is that over all places.
//!
//! The gradients are those of the golden model, bit for bit; the faces are in f64, as their golden model needs a camera.
//!
//! Example: a plane has no error, whatever the step.

use crate::filters::Filter;
use crate::gradient_normal::{self, Constants, Patch};
use crate::map::HeightMap;
use crate::mip_build::{MipError, Pyramid};
use crate::mip_fetch::FRACTION_BITS;
use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;
use thiserror::Error;

/// What normals are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The table above says it.
pub enum Shading {
    FacePoint,
    FaceMax,
    GradientAverage,
    GradientMax,
}

impl Shading {
    /// All of them.
    pub const ALL: [Shading; 4] =
        [Shading::FacePoint, Shading::FaceMax, Shading::GradientAverage, Shading::GradientMax];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Shading::FacePoint => "face-point",
            Shading::FaceMax => "face-max",
            Shading::GradientAverage => "gradient-average",
            Shading::GradientMax => "gradient-max",
        }
    }

    /// The filter of its heights.
    pub const fn filter(self) -> Filter {
        match self {
            Shading::FacePoint => Filter::Point,
            Shading::GradientAverage => Filter::Average,
            Shading::FaceMax | Shading::GradientMax => Filter::NodeMax,
        }
    }

    const fn is_of_faces(self) -> bool {
        matches!(self, Shading::FacePoint | Shading::FaceMax)
    }
}

/// How far the normals are off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Angles {
    /// The level that is read.
    pub level: usize,
    /// The root of the mean squared angle, degrees.
    pub rms: f64,
    /// The greatest angle.
    pub most: f64,
}

/// Why there is nothing to measure.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NormalsError {
    /// No cell has its footprint in the map.
    #[error("the map has {width} x {height} samples, and a grid of {step} texels needs at least {} on each side", needed(*step))]
    Small {
        /// Samples in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Texels from vertex to vertex.
        step: u32,
    },
    /// Vertices on one another.
    #[error("a grid of 0 texels has no cells; at least 1 is expected")]
    NoStep,
    /// Beyond the numbers of the hardware.
    #[error("a range of heights of {relief} over texels of {texel} is too steep; at most {most:.1} is expected")]
    Steep {
        /// World units of the whole range of heights.
        relief: f64,
        /// World units of the shorter side of a texel.
        texel: f64,
        /// The greatest range.
        most: f64,
    },
    /// There are no levels.
    #[error(transparent)]
    Levels(#[from] MipError),
}

const fn needed(step: u32) -> u64 {
    3 * step as u64 + 3
}

/// Vertices of a measurement, about; of larger maps not every texel has one.
const TEXELS: f64 = 524_288.0;
/// n c and the longest gradient: c of 1/2 leaves room for what rounds up.
const LANE: f64 = 1_073_741_824.0;

/// A map in the world, with the sums of its normals.
#[derive(Clone, Debug)]
pub struct Land<'a> {
    map: &'a HeightMap,
    /// World units of a texel along u and v, and of a unit of height.
    texel: [f64; 2],
    unit: f64,
    /// Sums of the normals of all texels above and to the left, each the mean of two triangles.
    sums: Vec<DVec3>,
    constants: Constants,
    gradients: [[i64; 3]; 2],
}

impl<'a> Land<'a> {
    /// A map of at least 2 x 2 samples, laid out over `size` world units, positive, and `relief` high for 65535.
    ///
    /// # Errors
    /// [`NormalsError::Steep`].
    pub fn new(map: &'a HeightMap, size: [f64; 2], relief: f64) -> Result<Self, NormalsError> {
        let HeightMap { width, height, .. } = *map;
        let texel = [size[0] / (width - 1) as f64, size[1] / (height - 1) as f64];
        let unit = relief / 65535.0;
        // The unit of the gradients: a power of two, so that the longer one is between 1/2 and 1.
        let shorter = texel[0].min(texel[1]);
        let whole = (-shorter.log2()).floor().exp2() * 2.0;
        let steep = NormalsError::Steep { relief: relief.abs(), texel: shorter, most: 1.9 * 65535.0 / whole };
        let constants = Constants::new(unit * whole).ok_or(steep)?;
        let lane = |axis: usize| (LANE / texel[axis] / whole).round() as i64;
        let gradients = [[lane(0), 0, 0], [0, lane(1), 0]];
        let mut land = Self { map, texel, unit, sums: vec![DVec3::ZERO; width * height], constants, gradients };
        land.add_up();
        Ok(land)
    }

    fn add_up(&mut self) {
        let HeightMap { width, height, .. } = *self.map;
        let z = |i: usize, j: usize| f64::from(self.map.sample(i, j));
        let rows: Vec<Vec<DVec3>> = (0..height - 1)
            .into_par_iter()
            .map(|j| {
                let texel = |i: usize| {
                    let corners = [z(i, j), z(i + 1, j), z(i, j + 1), z(i + 1, j + 1)];
                    self.faces(corners, 1.0).into_iter().sum::<DVec3>() / 2.0
                };
                (0..width - 1).map(texel).collect()
            })
            .collect();
        for (j, row) in rows.iter().enumerate() {
            let mut sum = DVec3::ZERO;
            for (i, normal) in row.iter().enumerate() {
                sum += *normal;
                self.sums[(j + 1) * width + i + 1] = self.sums[j * width + i + 1] + sum;
            }
        }
    }

    /// The normal of slopes in units of height over texels.
    fn normal(&self, u: f64, v: f64) -> DVec3 {
        DVec3::new(-u * self.unit / self.texel[0], -v * self.unit / self.texel[1], 1.0).normalize()
    }

    /// The normals of the two triangles of a cell, cut along the diagonal from its first corner.
    fn faces(&self, [t00, t10, t01, t11]: [f64; 4], step: f64) -> [DVec3; 2] {
        [self.normal((t10 - t00) / step, (t11 - t10) / step), self.normal((t11 - t01) / step, (t01 - t00) / step)]
    }

    /// The direction of the mean normal of a square of `side` texels round a place.
    fn mean(&self, [u, v]: [f64; 2], side: f64) -> DVec3 {
        let width = self.map.width;
        // A texel's normals count as spread evenly.
        let sum = |u: f64, v: f64| {
            let (i, j) = (u as usize, v as usize);
            let at = |i: usize, j: usize| self.sums[j.min(self.map.height - 1) * width + i.min(width - 1)];
            let upper = at(i, j).lerp(at(i + 1, j), u - i as f64);
            upper.lerp(at(i, j + 1).lerp(at(i + 1, j + 1), u - i as f64), v - j as f64)
        };
        let ([left, right], [top, bottom]) = ([u - side / 2.0, u + side / 2.0], [v - side / 2.0, v + side / 2.0]);
        (sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top)).normalize()
    }

    /// Whether a map has room for a grid of `step` texels.
    ///
    /// # Errors
    /// It has not, or there is no step.
    pub fn check(map: &HeightMap, step: u32) -> Result<(), NormalsError> {
        let HeightMap { width, height, .. } = *map;
        match step {
            0 => Err(NormalsError::NoStep),
            _ if (width.min(height) as u64) < needed(step) => Err(NormalsError::Small { width, height, step }),
            _ => Ok(()),
        }
    }

    /// How far the normals of a shading are off, of vertices `step` texels apart. The pyramid is that of the shading's
    /// filter, and has the level for `step` texels, or the last that there is is taken.
    ///
    /// # Errors
    /// [`NormalsError::Small`], [`NormalsError::NoStep`].
    pub fn angles(&self, shading: Shading, pyramid: &Pyramid, step: u32) -> Result<Angles, NormalsError> {
        Self::check(self.map, step)?;
        let HeightMap { width, height, .. } = *self.map;
        let level = shading.filter().level(step).min(pyramid.levels.len() - 1);
        let whole = step as usize;
        // An odd stride, which meets all places on every level.
        let stride = 2 * (((width * height) as f64 / TEXELS).sqrt() / 2.0) as usize + 1;
        // 1/2 -+ 1/sqrt(12).
        let gauss = [13_849, 51_687];
        let row = |j: usize| {
            let (mut squares, mut count, mut most) = (0.0, 0u64, 0.0f64);
            for i in (whole..width - 2 * whole - 1).step_by(stride) {
                for place in gauss.into_iter().flat_map(|u| gauss.map(|v| [u, v])) {
                    let at = [((i as u32) << FRACTION_BITS) + place[0], ((j as u32) << FRACTION_BITS) + place[1]];
                    for (normal, middle) in self.normals(shading, pyramid, level, at, step) {
                        let mean = self.mean(middle, f64::from(step));
                        let angle = normal.cross(mean).length().atan2(normal.dot(mean)).to_degrees();
                        (squares, count, most) = (squares + angle * angle, count + 1, most.max(angle));
                    }
                }
            }
            (squares, count, most)
        };
        let rows: Vec<usize> = (whole..height - 2 * whole - 1).step_by(stride).collect();
        // Rows are added in their order: the same sum every time.
        let rows: Vec<_> = rows.into_par_iter().map(row).collect();
        let (squares, count, most) =
            rows.into_iter().fold((0.0, 0, 0.0f64), |a, b| (a.0 + b.0, a.1 + b.1, a.2.max(b.2)));
        Ok(Angles { level, rms: f64::sqrt(squares / count as f64), most })
    }

    /// What is shaded at a vertex, and the middle of each in texels.
    fn normals(
        &self,
        shading: Shading,
        pyramid: &Pyramid,
        level: usize,
        at: [u32; 2],
        step: u32,
    ) -> Vec<(DVec3, [f64; 2])> {
        let filter = shading.filter();
        let [u, v] = at.map(|x| f64::from(x) / 65536.0);
        if !shading.is_of_faces() {
            let (texels, weights) = filter.patch(pyramid, level, at);
            let normal = [0, 0, LANE as i64];
            let patch = Patch { texels, weights, level: level as u32, normal, gradients: self.gradients };
            let unit = gradient_normal::golden(&self.constants, &patch);
            return vec![(DVec3::from_array(unit.map(f64::from)).normalize(), [u, v])];
        }
        let over = step << FRACTION_BITS;
        let corners = [[0, 0], [over, 0], [0, over], [over, over]];
        let heights =
            corners.map(|corner| f64::from(filter.at(pyramid, level, [at[0] + corner[0], at[1] + corner[1]])) / 256.0);
        let step = f64::from(step);
        let [third, two] = [step / 3.0, 2.0 * step / 3.0];
        let [upper, lower] = self.faces(heights, step);
        vec![(upper, [u + two, v + third]), (lower, [u + third, v + two])]
    }
}
