// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the vertex transform to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::fit_ranges;
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::vertex_transform::VertexTransform;
use relief_hdl::widths::WidthSet;
use relief_models::cull;
use relief_models::step::MAX_COMPONENTS;
use relief_models::vertex_transform::numbers::{self, NORMALS, values};
use relief_models::vertex_transform::{
    BaseVertex, Constants, OutOfRange, Projected, Source, Transformed, ViewVertex, golden, lane,
};
use std::ops::RangeInclusive;

/// The vertex transform, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct VertexTransformBinding;

/// The values that a constant may have.
pub(crate) fn range(index: i64) -> Option<RangeInclusive<i64>> {
    Some(match index {
        0..9 => -(1 << 30)..=1 << 30,
        9 => 4097..=u32::MAX.into(),
        10 | 11 => 0..=u32::MAX.into(),
        12..22 => -(1 << 14)..=1 << 14,
        32..35 => 1 - (1 << 61)..=(1 << 61) - 1,
        35 => 1 << 16..=(1 << 46) - 1,
        36 => i64::from(i32::MIN) << 10..=i64::from(i32::MAX) << 10,
        37..43 => -(1 << 61)..=1 << 61,
        43 => 1..=1 << 23,
        _ => return None,
    })
}

/// The beats that hand a draw's constants over.
pub fn constants(constants: &Constants, volume: &cull::Constants) -> Vec<Beat> {
    values(constants, volume).into_iter().map(|(index, value)| constant(index, value)).collect()
}

/// The beat of a vertex.
pub fn vertex(source: &Source) -> Beat {
    let (kind, lanes) = match source {
        Source::Record(vertex) => {
            let lanes = [vertex.position.map(i64::from), vertex.normal.map(i64::from)].concat();
            (1, [&lanes[..], &vertex.texel.map(i64::from), &[vertex.density.into()]].concat())
        }
        Source::View(vertex) => (2, lanes(vertex)),
    };
    [vec![kind, 0, 0], pack(&lanes, 48)].concat()
}

/// What a beat of the block says of a vertex.
pub(crate) fn transformed(words: &[u64]) -> Transformed {
    let view = unpack(&words[7..], lane::COUNT, 48);
    let three = |k: usize| [view[k], view[k + 1], view[k + 2]];
    let mut data = [0; MAX_COMPONENTS];
    data[..lane::COUNT].copy_from_slice(&unpack(words, lane::COUNT, 32));
    let corner = unpack(&words[5..], 3, 24);
    Transformed {
        view: ViewVertex { position: three(0), normal: three(3), texel: [view[6], view[7]], density: view[8] },
        outcode: words[14] as u8,
        outside: words[15] as u8,
        projected: match words[16] {
            0 => Some(Ok(Projected { data, corner: [0, 1, 2].map(|k| corner[k] as i32) })),
            1 => Some(Err(OutOfRange::Lane)),
            2 => Some(Err(OutOfRange::Grid)),
            _ => None,
        },
    }
}

fn lanes(vertex: &ViewVertex) -> Vec<i64> {
    [&vertex.position[..], &vertex.normal, &vertex.texel, &[vertex.density]].concat()
}

fn constant(index: u64, value: i64) -> Beat {
    [vec![0, index, value as u64 & (u64::MAX >> 1)], vec![0; 7]].concat()
}

struct Golden {
    /// The first constant has come.
    begun: bool,
    constants: Constants,
    volume: cull::Constants,
}

impl Default for Golden {
    fn default() -> Self {
        let (constants, volume) = numbers::RESET;
        Self { begun: false, constants, volume }
    }
}

impl Golden {
    fn write(&mut self, index: u64, value: i64) {
        self.begun |= index == 0;
        numbers::write(&mut self.constants, &mut self.volume, index, value);
    }
}

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let lanes_in = unpack(&beat[3..], lane::COUNT, 48);
        let three = |k: usize| [lanes_in[k], lanes_in[k + 1], lanes_in[k + 2]];
        let (position, normal, texel, density) = (three(0), three(3), [lanes_in[6], lanes_in[7]], lanes_in[8]);
        let source = match beat[0] {
            0 => return self.write(beat[1], unpack(&beat[2..3], 1, 63)[0]),
            1 => Source::Record(BaseVertex {
                position: position.map(|k| k as i32),
                normal: normal.map(|k| k as i32),
                texel: texel.map(|k| k as u32),
                density: density as u32,
            }),
            _ => Source::View(ViewVertex { position, normal, texel, density }),
        };
        if !self.begun {
            return;
        }
        let vertex = golden(&self.constants, &self.volume, &source);
        let (mut data, mut corner) = ([0; lane::COUNT], [0; 3]);
        let status = match vertex.projected {
            Some(Ok(projected)) => {
                data.copy_from_slice(&projected.data[..lane::COUNT]);
                corner = projected.corner.map(i64::from);
                0
            }
            Some(Err(OutOfRange::Lane)) => 1,
            Some(Err(OutOfRange::Grid)) => 2,
            None => 3,
        };
        let flags = vec![vertex.outcode.into(), vertex.outside.into(), status];
        let words = [pack(&data, 32), pack(&corner, 24), pack(&lanes(&vertex.view), 48), flags].concat();
        expected.push(Expected::whole(words));
    }
}

/// A rotation by a quaternion; some about an axis by right angles, whose components are 1.0 and 0.
fn rotation(random: &mut Random) -> [[i32; 3]; 3] {
    const ONE: i32 = 1 << 30;
    match random.below(8) {
        0 => return [[ONE, 0, 0], [0, -ONE, 0], [0, 0, -ONE]],
        1 => return [[0, 0, ONE], [ONE, 0, 0], [0, ONE, 0]],
        _ => {}
    }
    let mut component = || random.signed(24) as f64 + 0.5;
    let [w, x, y, z] = [component(), component(), component(), component()];
    let scale = f64::from(ONE) / (w * w + x * x + y * y + z * z);
    [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    .map(|row| row.map(|k| (k * scale) as i32))
}

/// One draw after another: all constants, then vertices, and here and there one constant alone.
struct Draws {
    random: Random,
    waiting: Vec<Beat>,
}

impl Draws {
    fn constants(&mut self) -> (Constants, cull::Constants) {
        let random = &mut self.random;
        // Most views look at what is in front of them.
        let mut translation: [i64; 3] = std::array::from_fn(|_| random.signed(62) >> random.below(30));
        translation[2] = (translation[2] >> random.below(8)).abs();
        let constants = Constants {
            rotation: rotation(random),
            translation,
            z0: (1 << 16) + (random.below(1 << 44) as i64 >> random.below(44)),
            focal: 4097 + (random.below((1 << 32) - 4097) >> random.below(20)) as u32,
            inverse_cell: (random.signed(33).max(0) >> random.below(12)) as u32,
            octave: (random.signed(33).max(0) >> random.below(12)) as u32,
            grid_bias: (random.signed(32) >> random.below(31)) as i32,
            coordinate_bits: 10 + random.below(15) as u32,
        };
        let mut normal = [[0; 3]; 6];
        for [side, axis] in NORMALS {
            normal[side][axis] = match random.below(16) {
                0 => 1 << 14,
                1 => -(1 << 14),
                _ => random.signed(15) as i32,
            };
        }
        let reach = std::array::from_fn(|_| random.signed(62) >> random.below(20));
        (constants, cull::Constants { normal, reach })
    }

    fn begin(&mut self) {
        let (constants, volume) = self.constants();
        self.waiting.extend(self::constants(&constants, &volume));
        for _ in 0..4 + self.random.below(20) {
            let source = self.source(&constants);
            self.waiting.push(vertex(&source));
            if self.random.chance(10) {
                // But for what the vertices were chosen for: 1 / cell, octave, normals, bias, reaches, limit.
                let (other, volume) = self.constants();
                let at = [10, 11, 13, 18, 26, 29, 33][self.random.below(7) as usize];
                let (index, value) = values(&other, &volume)[at];
                self.waiting.push(constant(index, value));
            }
        }
        self.waiting.reverse();
    }

    fn source(&mut self, constants: &Constants) -> Source {
        let random = &mut self.random;
        let bits = if random.chance(10) { 32 } else { 31 };
        let normal: [i64; 3] = std::array::from_fn(|_| random.signed(bits));
        let texel: [u32; 3] = std::array::from_fn(|_| (random.signed(33) >> 1) as u32);
        if random.chance(50) {
            let shift = random.below(24);
            return Source::Record(BaseVertex {
                position: std::array::from_fn(|_| (random.signed(bits) >> shift) as i32),
                normal: normal.map(|k| k as i32),
                texel: [texel[0], texel[1]],
                density: texel[2],
            });
        }
        // In view space: anything, or at z0 and the guard band to the unit.
        let most = (1 << 46) - 1;
        let z = match random.below(8) {
            0 => random.signed(47),
            1..4 => constants.z0 + random.below(3) as i64 - 1,
            _ => (constants.z0 + (random.below(1 << 46) as i64 >> random.below(46))).min(most),
        };
        let band = (i128::from(z) * (8190 << 16) / i128::from(constants.focal))
            .clamp(3 - i128::from(most), i128::from(most) - 3) as i64;
        let across: [i64; 2] = std::array::from_fn(|_| match random.below(4) {
            0 => random.signed(47),
            1 => [-band, band][random.below(2) as usize] + random.below(5) as i64 - 2,
            _ => ((i128::from(band) * i128::from(random.signed(20))) >> 19) as i64,
        });
        Source::View(ViewVertex {
            position: [across[0], across[1], z],
            normal,
            texel: [texel[0].into(), texel[1].into()],
            density: texel[2].into(),
        })
    }
}

impl Iterator for Draws {
    type Item = Beat;
    fn next(&mut self) -> Option<Beat> {
        if self.waiting.is_empty() {
            self.begin();
        }
        self.waiting.pop()
    }
}

impl Binding for VertexTransformBinding {
    fn name(&self) -> &'static str {
        "vertex_transform"
    }
    fn summary(&self) -> &'static str {
        "transforms a base vertex: projection, grid corner, flags of the planes it is behind"
    }
    fn latency(&self) -> &'static str {
        "130"
    }
    fn interval(&self) -> &'static str {
        "65, and 2 for a constant"
    }
    fn error(&self) -> &'static str {
        "c 2.2 units, X and Y 2^-29.7 of them and a unit, corner 0.53 voxels"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(VertexTransform::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden::default())
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(Draws { random: Random::new(seed), waiting: Vec::new() })
    }
    fn stimulus_format(&self) -> &'static str {
        "0, index and value of a constant; or 1 (a record) or 2 (in view space) and nine lanes, signed"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let one = -(1 << 30)..=1 << 30;
        let (unsigned, view) = (0..=u32::MAX.into(), -(1 << 46)..=(1 << 46) - 1);
        let kind = *numbers.first().ok_or("the line is empty")?;
        if kind == 0 {
            expect_count(numbers, 3)?;
            let Some(values) = range(numbers[1]) else {
                return Err(format!("number 2 is {}, and constants are 0..=21 and 32..=43", numbers[1]));
            };
            fit_ranges(numbers, &[&(0..=0), &(0..=43), &values])?;
            if numbers[1] == 43 && !(numbers[2] as u64).is_power_of_two() {
                return Err(format!("number 3 is {}, and half of the grid's range is a power of two", numbers[2]));
            }
            return Ok(constant(numbers[1] as u64, numbers[2]));
        }
        expect_count(numbers, 1 + lane::COUNT)?;
        let position = if kind == 1 { &one } else { &view };
        let [p, n, u] = [position, &one, &unsigned];
        fit_ranges(numbers, &[&(1..=2), p, p, p, n, n, n, u, u, u])?;
        Ok([vec![kind as u64, 0, 0], pack(&numbers[1..], 48)].concat())
    }
}
