// SPDX-License-Identifier: MIT OR Apache-2.0
//! Small draws at random, as the host makes them, one after the other.

use super::Fields;
use crate::binding::{Beat, Random, pack};
use crate::mip_build::random_sample;
use crate::remesher::format;
use glam::{DVec2, DVec3};
use relief_hdl::widths::WidthSet;
use relief_models::displacement_pipeline::{Command, commands};
use relief_models::draw::{Assembled, CameraView, Draw, DrawVertex, MapInfo};
use relief_models::light::{Light, Material};
use relief_models::mip_build::{Centring, Extremum, Pyramid, Wrap, golden, max_levels};
use relief_models::rules::ExtremumRule;
use std::collections::VecDeque;

/// Triangles of a draw, about, at most.
const MOST: u64 = 250;

/// One draw after the other: a map, or that of the draw before; a camera, a mesh of one to four base triangles, of which
/// some cross the near plane and some are off the screen; now and then a beat that does nothing; all counters.
pub(super) struct Draws {
    set: WidthSet,
    random: Random,
    queue: VecDeque<Beat>,
    /// Maxima and minima.
    map: Option<[Pyramid; 2]>,
}

type Mesh = (Vec<DrawVertex>, Vec<[u32; 3]>);

impl Draws {
    pub(super) fn new(set: &WidthSet, seed: u64) -> Self {
        Self { set: *set, random: Random::new(seed), queue: VecDeque::new(), map: None }
    }

    /// A number of `low..high`, in 2^-16 of the way.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.random.below(1 << 16) as f64 / 65_536.0
    }

    fn vector(&mut self, reach: f64) -> DVec3 {
        DVec3::from_array([0; 3].map(|_| self.between(-reach, reach)))
    }

    /// A direction, of any length but zero.
    fn direction(&mut self) -> DVec3 {
        let direction = self.vector(1.0);
        if direction.length() < 0.1 { DVec3::Y } else { direction }
    }

    fn pyramids(&mut self) -> [Pyramid; 2] {
        let side = |random: &mut Random| 4 + random.below(13) as usize;
        let (width, height) = (side(&mut self.random), side(&mut self.random));
        let mut wrap = [Wrap::Clamp; 2];
        for (wrap, side) in wrap.iter_mut().zip([width, height]) {
            if side.is_multiple_of(2) && self.random.chance(50) {
                *wrap = Wrap::Repeat;
            }
        }
        let samples: Vec<u16> = (0..width * height).map(|_| random_sample(&mut self.random)).collect();
        let most = max_levels(width, height, Centring::Node, wrap).min(3) as u64;
        let levels = 1 + self.random.below(most) as usize;
        [Extremum::Max, Extremum::Min].map(|extremum| {
            golden(width, height, &samples, Centring::Node, wrap, extremum, levels).expect("a map that can be halved")
        })
    }

    fn camera(&mut self) -> CameraView {
        let side = |random: &mut Random| 16 + random.below(33) as u32;
        let viewport = [side(&mut self.random), side(&mut self.random)];
        CameraView {
            eye: DVec3::new(self.between(-0.5, 0.5), self.between(-3.0, -1.0), self.between(0.02, 1.5)),
            target: self.vector(0.4),
            up: DVec3::new(self.between(-0.5, 0.5), 0.1, 1.0),
            fov_y: self.between(0.4, 1.5),
            near: [0.16, 0.5, 1.6][self.random.below(3) as usize],
            far: if self.random.chance(15) { 2.0 } else { 50.0 },
            viewport,
            cell_px: [1.0, 2.0, 4.0, 8.0][self.random.below(4) as usize],
        }
    }

    fn vertex(&mut self, position: DVec3, map: &MapInfo) -> DrawVertex {
        // Ends of the axes more often than not: seams and clamped borders.
        let uv = [0, 1].map(|k| match self.random.below(6) {
            0 => 0.0,
            1 => 1.0,
            2 if map.repeat[k] => self.between(1.0, 1.99),
            _ => self.between(0.0, 1.0),
        });
        let normal = if self.random.chance(30) { DVec3::Z } else { self.direction() };
        DrawVertex { position, normal, uv: DVec2::from_array(uv) }
    }

    fn mesh(&mut self, view: &CameraView, map: &MapInfo) -> Mesh {
        let mut vertices: Vec<DrawVertex> = Vec::new();
        let forward = (view.target - view.eye).normalize();
        let place = match self.random.below(8) {
            // Off to a side, or behind the eye.
            0 => self.vector(6.0),
            1 => view.eye - 2.0 * forward,
            _ => view.target,
        };
        if self.random.chance(40) {
            // A strip of quads, their normals alike, with the texels of a map once across.
            let columns = 1 + self.random.below(2) as u32;
            let (across, along) = (self.direction(), self.direction());
            let normal = across.cross(along).try_normalize().unwrap_or(DVec3::Z);
            for j in 0..2 {
                for i in 0..=columns {
                    let (u, v) = (f64::from(i) / f64::from(columns), f64::from(j));
                    let position = place + (u - 0.5) * across + (v - 0.5) * along;
                    vertices.push(DrawVertex { position, normal, uv: DVec2::new(u, v) });
                }
            }
            let quads = (0..columns).flat_map(|i| {
                let [a, b, c, d] = [i, i + columns + 1, i + columns + 2, i + 1];
                [[a, b, c], [a, c, d]]
            });
            return (vertices, quads.collect());
        }
        let count = 1 + self.random.below(4) as u32;
        for _ in 0..count + 2 {
            let position = match self.random.below(10) {
                // Round the eye: some of it behind z0.
                0 | 1 => view.eye + self.vector(0.05) + self.between(-1.0, 1.0) * forward,
                _ => place + self.vector(0.7),
            };
            let vertex = self.vertex(position, map);
            vertices.push(vertex);
        }
        let triangles = (0..count).map(|k| match self.random.below(12) {
            // Two corners in one place.
            0 => [k, k + 1, k],
            1..5 => [k, k + 2, k + 1],
            _ => [k, k + 1, k + 2],
        });
        (vertices.clone(), triangles.collect())
    }

    fn displacement(&mut self) -> [f64; 2] {
        match self.random.below(10) {
            0 | 1 => [0.0, 0.0],
            2 => [0.0, 3.0],
            3 => [self.between(-4.0, 4.0), self.between(-4.0, 4.0)],
            4 => [0.1, 0.1],
            _ => [self.between(-0.2, 0.1), self.between(-0.1, 0.3)],
        }
    }

    fn material(&mut self) -> Material {
        if self.random.chance(30) {
            return Material::TERRAIN;
        }
        let mut part = || match self.random.below(6) {
            0 => 0,
            1 => 1 << 16,
            _ => self.random.below((1 << 16) + 1) as u32,
        };
        Material {
            ramp: [[0; 3]; 5].map(|colour| colour.map(|_: u32| part())),
            ambient: [0; 3].map(|_: u32| part()),
            specular: part(),
            shininess: [1, 24, 255][self.random.below(3) as usize],
        }
    }

    /// A draw of at most [`MOST`] triangles or so: voxels grow until it is one.
    fn draw(&mut self, map: &MapInfo) -> (Draw, [u32; 2]) {
        loop {
            let mut view = self.camera();
            let (vertices, triangles) = self.mesh(&view, map);
            let (displacement, material, cull) = (self.displacement(), self.material(), self.random.chance(70));
            while view.cell_px <= 4096.0 {
                let draw = Draw::new(&view, &vertices, &triangles, map, displacement, &format(&self.set));
                // Such as a target in line with up.
                let Ok(mut draw) = draw else { break };
                (draw.cull, draw.material) = (cull, material);
                let all: Vec<Assembled> = (0..triangles.len()).map(|index| draw.assemble(index)).collect();
                if all.iter().flat_map(Assembled::pieces).map(|piece| piece.estimate()).sum::<u64>() <= MOST {
                    return (draw, view.viewport);
                }
                view.cell_px *= 2.0;
            }
        }
    }

    fn light(&mut self, draw: &Draw) -> Light {
        let direction = self.direction();
        let mut light = draw.light(direction).expect("a direction");
        light.colour = [0; 3].map(|_: u32| match self.random.below(5) {
            0 => 0,
            1 => 1 << 18,
            _ => self.random.below(1 << 17) as u32,
        });
        light
    }

    fn push(&mut self, command: &Command) {
        let mut fields = Fields::of(command);
        let (index, value, lanes) = fields.used;
        // What a beat does not use is anything.
        if !index {
            fields.index = self.random.below(1 << super::NUMBER_BITS);
        }
        if !value {
            fields.value = self.random.signed(super::VALUE_BITS);
        }
        for lane in &mut fields.data[lanes..] {
            *lane = self.random.signed(super::LANE_BITS);
        }
        self.queue.push_back(fields.beat());
    }

    /// A beat of a kind that does nothing.
    fn nothing(&mut self) {
        let data = [0; super::LANES].map(|_| self.random.signed(super::LANE_BITS));
        let (kind, index) = (6 + self.random.below(2), self.random.below(1 << super::NUMBER_BITS));
        let value = pack(&[self.random.signed(super::VALUE_BITS)], super::VALUE_BITS)[0];
        self.queue.push_back([vec![kind, index, value], pack(&data, super::LANE_BITS)].concat());
    }

    fn fill(&mut self) {
        let kept = self.map.take().filter(|_| self.random.chance(50));
        let is_new = kept.is_none();
        let pyramids = match kept {
            Some(pyramids) => pyramids,
            None => self.pyramids(),
        };
        let pyramid = &pyramids[0];
        let map = MapInfo {
            width: pyramid.levels[0].width,
            height: pyramid.levels[0].height,
            repeat: pyramid.wrap.map(|wrap| wrap == Wrap::Repeat),
            levels: pyramid.levels.len(),
        };
        let (mut draw, viewport) = self.draw(&map);
        // With a map of one pyramid from the draw before, minima are what it has.
        let rules = [ExtremumRule::Max, ExtremumRule::Min, ExtremumRule::Vertex, ExtremumRule::Vertex];
        draw.rules.extremum = rules[self.random.below(4) as usize];
        let (light, skips) = (self.light(&draw), self.random.chance(50));
        for command in commands(&draw, &pyramids, &light, viewport, skips) {
            if is_new || !matches!(command, Command::Size { .. } | Command::Load { .. }) {
                self.push(&command);
            }
            if matches!(command, Command::Triangle { .. }) && self.random.chance(10) {
                // In the middle of a draw: a beat that does nothing, or counters.
                match self.random.below(2) {
                    0 => self.nothing(),
                    _ => self.push(&Command::Report { counter: 19 }),
                }
            }
        }
        // One of those that are always 0.
        let counter = [22, 23, 31, 127][self.random.below(4) as usize];
        self.push(&Command::Report { counter });
        self.map = Some(pyramids);
    }
}

impl Iterator for Draws {
    type Item = Beat;
    fn next(&mut self) -> Option<Beat> {
        while self.queue.is_empty() {
            self.fill();
        }
        self.queue.pop_front()
    }
}
