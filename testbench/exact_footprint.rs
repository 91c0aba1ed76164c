// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the exact footprint to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::{fit_ranges, nearness};
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::exact_footprint::golden;
use relief_models::filter_level::level;
use relief_models::perspective_correct::{Axis, inverse};
use relief_models::step::{MAX_COMPONENTS, Vertex};
use relief_models::vertex_transform::lane;

/// The exact footprint.
#[derive(Clone, Copy, Debug)]
pub struct ExactFootprintBinding;

/// What a beat says of a vertex: u, v, c of the lanes and of both differences, `texel_bits` of u and v, levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// u c, v c, c.
    pub lanes: [i64; 3],
    /// Of the sweep, and of the side.
    pub differences: [[i64; 3]; 2],
    /// Of u and of v.
    pub texel_bits: [u32; 2],
    /// Of the map.
    pub levels: u32,
}

struct Golden(WidthSet);

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let (bits, wide) = (self.0.vertex_bits, self.0.accumulator_bits());
        let words = (3 * wide).div_ceil(64);
        let axes = 3 + 2 * words;
        let difference = |at: usize| of(std::array::from_fn(|k| unpack(&beat[at..], 3, wide)[k]));
        let lanes = [0, 1, 2].map(|at| unpack(&beat[at..], 1, bits)[0]);
        let differences = [difference(3), difference(3 + words)];
        let axis = |k: usize| Axis { size: 1, repeat: false, texel_bits: beat[axes + k] as u32 };
        let guard_bits = self.0.guard_bits as u32;
        let footprint = golden(&of(lanes), &differences, guard_bits, &[axis(0), axis(1)], inverse(lanes[2]));
        let level = level(footprint, beat[axes + 2] as u32);
        expected.push(Expected::whole(vec![level.into(), footprint.into()]));
    }
}

/// A vertex with these lanes u, v, c.
fn of([u, v, c]: [i64; 3]) -> Vertex {
    let mut vertex = [0; MAX_COMPONENTS];
    (vertex[lane::U], vertex[lane::U + 1], vertex[lane::C]) = (u, v, c);
    vertex
}

impl Step {
    /// The beat of a vertex at a width set.
    pub fn beat(&self, set: &WidthSet) -> Beat {
        let lanes = self.lanes.map(|lane| pack(&[lane], set.vertex_bits)[0]).to_vec();
        let [sweep, side] = self.differences.map(|difference| pack(&difference, set.accumulator_bits()));
        let [u, v] = self.texel_bits.map(u64::from);
        [lanes, sweep, side, vec![u, v, self.levels.into()]].concat()
    }

    /// Anything that the formats hold, and steps of 2^-3 to 2^18 texels, on edges as inside.
    fn any(random: &mut Random, set: &WidthSet) -> Self {
        let (bits, wide) = (set.vertex_bits, set.accumulator_bits());
        let c = nearness(random) >> (32 - bits);
        let texel = |random: &mut Random| match random.below(8) {
            0 => random.signed(bits),
            1 => c,
            _ => random.below(c.max(1) as u64 + 1) as i64,
        };
        let lanes = [texel(random), texel(random), c];
        let texel_bits = [0; 2].map(|_| 1 + random.below(15) as u32);
        let unit = 2f64.powi(set.guard_bits as i32);
        let most = 2f64.powi(wide as i32 - 1);
        let fit = |x: f64| (x * unit).clamp(-most, most - 1.0).round() as i64;
        let difference = |random: &mut Random| {
            if random.chance(15) {
                return [0; 3].map(|_| random.signed(wide) >> random.below(wide as u64));
            }
            let c = c.max(1) as f64;
            let step = c * random.signed(32) as f64 * 2f64.powi(-33);
            let along = |random: &mut Random, k: usize| {
                // A threshold of F, or any place between two of them.
                let mantissa = if random.chance(30) {
                    std::f64::consts::SQRT_2
                } else {
                    1.0 + random.signed(20).abs() as f64 / 2f64.powi(19)
                };
                let texels = mantissa * 2f64.powi(random.below(21) as i32 - 3 - texel_bits[k] as i32);
                let turn = if random.chance(50) { 1.0 } else { -1.0 };
                fit(lanes[k] as f64 / c * step + turn * texels * c)
            };
            [along(random, 0), along(random, 1), fit(step)]
        };
        let mut differences = [difference(random), difference(random)];
        match random.below(8) {
            0..3 => differences[1] = [0; 3],
            3 => differences[0] = [0; 3],
            _ => {}
        }
        Self { lanes, differences, texel_bits, levels: 1 + random.below(16) as u32 }
    }
}

impl Binding for ExactFootprintBinding {
    fn name(&self) -> &'static str {
        "exact_footprint"
    }
    fn summary(&self) -> &'static str {
        "filter level and footprint of a vertex from the difference vertices of its sweep"
    }
    fn latency(&self) -> &'static str {
        "52"
    }
    fn interval(&self) -> &'static str {
        "8"
    }
    fn error(&self) -> &'static str {
        "footprint 2^-14 of it and 2^-15 texels, never above; the level exact for it"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::ExactFootprint::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden(*set))
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let (set, mut random) = (*set, Random::new(seed));
        Box::new(std::iter::repeat_with(move || Step::any(&mut random, &set).beat(&set)))
    }
    fn stimulus_format(&self) -> &'static str {
        "lanes u c, v c and c, signed V bits; differences u, v, c of the sweep, then of the side, signed W bits; texel_bits of u and v; levels"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 12)?;
        let signed = |bits: usize| i64::MIN >> (64 - bits)..=i64::MAX >> (64 - bits);
        let (lane, wide) = (signed(set.vertex_bits), signed(set.accumulator_bits()));
        let (bits, levels) = (1..=15, 1..=31);
        fit_ranges(numbers, &[&[&lane; 3][..], &[&wide; 6], &[&bits, &bits, &levels]].concat())?;
        let three = |at: usize| [numbers[at], numbers[at + 1], numbers[at + 2]];
        let texel_bits = [9, 10].map(|at| numbers[at] as u32);
        let differences = [three(3), three(6)];
        Ok(Step { lanes: three(0), differences, texel_bits, levels: numbers[11] as u32 }.beat(set))
    }
}
