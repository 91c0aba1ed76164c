// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the filter level to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::{fit_ranges, nearness};
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::filter_level::FilterLevel;
use relief_hdl::widths::WidthSet;
use relief_models::filter_level::{Constants, footprint, golden};
use relief_models::perspective_correct::inverse;

/// The filter level, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct FilterLevelBinding;

struct Golden;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let lane = |k: usize| unpack(&beat[k..=k], 1, 32)[0];
        let constants = Constants { scale: beat[2] as u32, shift: beat[3] as u32, levels: beat[4] as u32 };
        let inverse = inverse(lane(1));
        let level = golden(&constants, lane(0), inverse);
        expected.push(Expected::whole(vec![level.into(), footprint(&constants, lane(0), inverse).into()]));
    }
}

/// Half of the footprints lie within a few units of a threshold: the scale is what takes them there, rounded.
fn draw(random: &mut Random) -> Beat {
    let c = nearness(random);
    let lane = match random.below(8) {
        0 => random.signed(32),
        1 => c.max(1),
        _ => random.below(c.max(1) as u64 + 1) as i64 >> random.below(12),
    };
    let any = |random: &mut Random| (1 << 23) + random.below(1 << 23) as u32;
    let mut constants = Constants {
        scale: [0, 1 << 23, (1 << 24) - 1, any(random)][(random.below(32) as usize).min(3)],
        shift: random.below(64) as u32,
        levels: 1 + random.below(16) as u32,
    };
    // rho / c with 16 fraction bits, from f64: near is enough.
    let (rho, c_real) = (lane.max(0) as f64 / c.max(1) as f64 * 1024.0, c.max(1) as f64 / 2f64.powi(31));
    let over_c = rho / c_real * 65536.0;
    if random.chance(70) && over_c > 0.0 {
        let threshold = 65536.0 * std::f64::consts::SQRT_2 * 2f64.powi(random.below(17) as i32 - 1);
        let scale = threshold / over_c;
        let shift = (23.0 - scale.log2().floor()).clamp(0.0, 63.0) as i32;
        let scale = (scale * 2f64.powi(shift)).round() as i64 + random.below(5) as i64 - 2;
        constants.shift = shift as u32;
        constants.scale = scale.clamp(1 << 23, (1 << 24) - 1) as u32;
    }
    beat(lane, c, &constants)
}

/// The input beat of lanes rho c and c.
pub(crate) fn beat(lane: i64, c: i64, constants: &Constants) -> Beat {
    let Constants { scale, shift, levels } = *constants;
    let word = |lane| pack(&[lane], 32)[0];
    vec![word(lane), word(c), scale.into(), shift.into(), levels.into()]
}

impl Binding for FilterLevelBinding {
    fn name(&self) -> &'static str {
        "filter_level"
    }
    fn summary(&self) -> &'static str {
        "filter level and footprint of a vertex from the density of texels there"
    }
    fn latency(&self) -> &'static str {
        "65"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "footprint 2^-16 (1/A + 1/B + 1/F) of its value, one for each floor; the level exact for it"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(FilterLevel::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || draw(&mut random)))
    }
    fn stimulus_format(&self) -> &'static str {
        "lanes rho c and c, signed 32 bits; scale, shift, levels"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 5)?;
        let lane = i64::from(i32::MIN)..=i32::MAX.into();
        fit_ranges(numbers, &[&lane, &lane, &(0..=(1 << 24) - 1), &(0..=63), &(1..=31)])?;
        let constants = Constants { scale: numbers[2] as u32, shift: numbers[3] as u32, levels: numbers[4] as u32 };
        Ok(beat(numbers[0], numbers[1], &constants))
    }
}
