// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds clipping to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::fit_ranges;
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::clip::Clip;
use relief_hdl::widths::WidthSet;
use relief_models::clip::golden;
use relief_models::vertex_transform::{Constants, ViewVertex};

/// Clipping, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct ClipBinding;

#[derive(Default)]
struct Golden {
    corners: Vec<ViewVertex>,
}

fn lanes(vertex: &ViewVertex) -> Vec<i64> {
    [&vertex.position[..], &vertex.normal, &vertex.texel, &[vertex.density]].concat()
}

/// The beat of a corner.
pub(crate) fn corner(constants: &Constants, vertex: &ViewVertex) -> Beat {
    [pack(&lanes(vertex), 48), vec![constants.z0 as u64, constants.focal.into()]].concat()
}

/// What a beat of the block says: a vertex, if anything is left, and whether it is the last one.
pub(crate) fn vertex(words: &[u64]) -> (Option<ViewVertex>, bool) {
    let view = unpack(words, 9, 48);
    let three = |k: usize| [view[k], view[k + 1], view[k + 2]];
    let vertex = ViewVertex { position: three(0), normal: three(3), texel: [view[6], view[7]], density: view[8] };
    ((words[7] == 1).then_some(vertex), words[8] == 1)
}

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let lanes_in = unpack(beat, 9, 48);
        let three = |k: usize| [lanes_in[k], lanes_in[k + 1], lanes_in[k + 2]];
        self.corners.push(ViewVertex {
            position: three(0),
            normal: three(3),
            texel: [lanes_in[6], lanes_in[7]],
            density: lanes_in[8],
        });
        let Ok(corners) = <[ViewVertex; 3]>::try_from(self.corners.as_slice()) else { return };
        self.corners.clear();
        let constants = Constants {
            rotation: [[0; 3]; 3],
            translation: [0; 3],
            z0: beat[7] as i64,
            focal: beat[8] as u32,
            inverse_cell: 0,
            octave: 0,
            grid_bias: 0,
            coordinate_bits: 1,
        };
        let polygon = golden(&constants, corners);
        if polygon.len() < 3 {
            expected.push(Expected::whole([vec![0; 7], vec![0, 1]].concat()));
            return;
        }
        for (k, vertex) in polygon.iter().enumerate() {
            let last = u64::from(k + 1 == polygon.len());
            expected.push(Expected::whole([pack(&lanes(vertex), 48), vec![1, last]].concat()));
        }
    }
}

/// Triangles about the planes: most of them are cut by one or two, some by many, some by none, some are away.
struct Triangles {
    random: Random,
    waiting: Vec<Beat>,
}

impl Triangles {
    fn begin(&mut self) {
        let random = &mut self.random;
        let z0 = (1 << 16) + (random.below(1 << 44) as i64 >> random.below(44));
        let focal = 4097 + (random.below((1 << 32) - 4097) >> random.below(20)) as i64;
        // In units of the distance from a plane: what is large for all corners is cut by none.
        let (wild, thin) = (random.chance(10), random.chance(10));
        let unit = [1, 1 << 10, 1 << 30, 1 << 44][random.below(4) as usize];
        let mut first = None;
        for _ in 0..3 {
            let z = match random.below(8) {
                0 => random.signed(47),
                1 => z0 + random.below(3) as i64 - 1,
                2 | 3 => z0 - (random.below(1 << 44) as i64 >> random.below(44)),
                _ => z0 + (random.below(1 << 45) as i64 >> random.below(45)),
            };
            let band = (i128::from(z) * (8190 << 16) / i128::from(focal)).clamp(-(1 << 45), 1 << 45) as i64;
            let mut across = || match random.below(8) {
                _ if wild => random.signed(47),
                0 => band + random.below(5) as i64 - 2,
                1 => -band + random.below(5) as i64 - 2,
                2 | 3 => 2 * ((i128::from(band) * i128::from(random.signed(20))) >> 19) as i64,
                _ => ((i128::from(band) * i128::from(random.signed(20))) >> 19) as i64,
            };
            let mut position = [across(), across(), z].map(|k: i64| k.clamp(-(1 << 46), (1 << 46) - 1));
            // Corners within units of each other.
            let base = *first.get_or_insert(position);
            if thin {
                position = base.map(|k| (k + random.below(unit) as i64).clamp(-(1 << 46), (1 << 46) - 1));
            }
            let mut rest: Vec<i64> = (0..3).map(|_| random.signed(32)).collect();
            rest.extend((0..3).map(|_| i64::from((random.signed(33) >> 1) as u32)));
            let lanes = [&position[..], &rest].concat();
            self.waiting.push([pack(&lanes, 48), vec![z0 as u64, focal as u64]].concat());
        }
    }
}

impl Iterator for Triangles {
    type Item = Beat;
    fn next(&mut self) -> Option<Beat> {
        if self.waiting.is_empty() {
            self.begin();
        }
        self.waiting.pop()
    }
}

impl Binding for ClipBinding {
    fn name(&self) -> &'static str {
        "clip"
    }
    fn summary(&self) -> &'static str {
        "cuts a base triangle at z0 and at the guard band"
    }
    fn latency(&self) -> &'static str {
        "1118 uncut, 1389 more a point"
    }
    fn interval(&self) -> &'static str {
        "29 a vertex, and the latency"
    }
    fn error(&self) -> &'static str {
        "1/2 unit a plane"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(Clip::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden::default())
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(Triangles { random: Random::new(seed), waiting: Vec::new() })
    }
    fn stimulus_format(&self) -> &'static str {
        "nine lanes of a vertex in view space; z0 and focal length"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 11)?;
        let (p, n) = (-(1 << 46)..=(1 << 46) - 1, -(1 << 32)..=(1 << 32) - 1);
        let (u, z0) = (0..=u32::MAX.into(), 1 << 16..=(1 << 46) - 1);
        fit_ranges(numbers, &[&p, &p, &p, &n, &n, &n, &u, &u, &u, &z0, &u])?;
        Ok([pack(&numbers[..9], 48), vec![numbers[9] as u64, numbers[10] as u64]].concat())
    }
}
