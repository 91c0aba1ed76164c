// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds perspective correction to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::perspective_correct::PerspectiveCorrect;
use relief_hdl::widths::WidthSet;
use relief_models::perspective_correct::{Axis, golden, inverse};

/// Perspective correction, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct PerspectiveCorrectBinding;

struct Golden;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let lane = |k: usize| unpack(&beat[k..=k], 1, 32)[0];
        let axis =
            |k: usize| Axis { size: beat[3 + k] as u32, repeat: beat[5 + k] == 1, texel_bits: beat[7 + k] as u32 };
        let inverse = inverse(lane(2));
        let texel = |k: usize| u64::from(golden(lane(k), inverse, &axis(k)));
        expected.push(Expected::whole(vec![texel(0), texel(1)]));
    }
}

/// A lane c: any length, and what lies round powers of two; below 1, too.
pub(crate) fn nearness(random: &mut Random) -> i64 {
    let bits = random.below(31);
    match random.below(16) {
        0 => 1,
        1 => (1 << 31) - 1,
        2 => random.signed(32).min(0),
        3 => 1 << bits,
        4 => (1 << bits) - 1,
        _ => (1 << bits) + random.below(1 << bits) as i64,
    }
}

/// The fields of one axis, and a lane: a fraction of c, and now and then a few units round a texel at which something
/// changes (the ends, one period, two), or anything.
fn axis(random: &mut Random, c: i64) -> (i64, Axis) {
    let size = match random.below(6) {
        0 => 1,
        1 => 8192,
        2 => 1 << random.below(14),
        _ => 1 + random.below(8192) as u32,
    };
    let fits = (32 - size.leading_zeros()).clamp(1, 15);
    let texel_bits = if random.chance(70) { fits } else { 1 + random.below(15) as u32 };
    let texel = match random.below(6) {
        0 => 0,
        1 => i64::from(size) - 1,
        2 => i64::from(size),
        3 => 2 * i64::from(size),
        4 => 3 * i64::from(size),
        _ => random.below(u64::from(size)) as i64,
    };
    // In sixteenths of the snap, round its two ends.
    let offset = [0, -16, 16][random.below(3) as usize] + random.below(5) as i64 - 2;
    let near = ((i128::from(texel) * 1024 + i128::from(offset)) * i128::from(c.max(1))) >> (10 + texel_bits);
    let lane = match random.below(8) {
        0 => random.signed(32),
        1 => c,
        2 | 3 => random.below(c.max(1) as u64) as i64,
        _ => near.clamp(-1, (1 << 31) - 1) as i64,
    };
    (lane, Axis { size, repeat: random.chance(50), texel_bits })
}

impl Binding for PerspectiveCorrectBinding {
    fn name(&self) -> &'static str {
        "perspective_correct"
    }
    fn summary(&self) -> &'static str {
        "texel coordinates of a vertex: the division by c, and the snap that closes seams"
    }
    fn latency(&self) -> &'static str {
        "41"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "2^-17 texel and 2^-30.7 of the coordinate, before the snap of 2^-6 texel"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(PerspectiveCorrect::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || {
            let c = nearness(&mut random);
            let ((u, axis_u), (v, axis_v)) = (axis(&mut random, c), axis(&mut random, c));
            beat([u, v, c], &axis_u, &axis_v)
        }))
    }
    fn stimulus_format(&self) -> &'static str {
        "lanes u c, v c and c, signed 32 bits; width, height; repeat_u, repeat_v; texel_bits of u and v"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 9)?;
        let (lane, size, bit, bits) = (i64::from(i32::MIN)..=i32::MAX.into(), 1..=8192, 0..=1, 1..=15);
        let ranges = [&lane, &lane, &lane, &size, &size, &bit, &bit, &bits, &bits];
        fit_ranges(numbers, &ranges)?;
        let axis = |k: usize| Axis {
            size: numbers[3 + k] as u32,
            repeat: numbers[5 + k] == 1,
            texel_bits: numbers[7 + k] as u32,
        };
        Ok(beat([numbers[0], numbers[1], numbers[2]], &axis(0), &axis(1)))
    }
}

/// The input beat of lanes u c, v c and c.
pub(crate) fn beat(lanes: [i64; 3], u: &Axis, v: &Axis) -> Beat {
    let lanes = lanes.map(|lane| pack(&[lane], 32)[0]);
    let axes = [u.size, v.size, u.repeat.into(), v.repeat.into(), u.texel_bits, v.texel_bits];
    lanes.into_iter().chain(axes.map(u64::from)).collect()
}

/// Refuses a number that is not in its range.
pub(crate) fn fit_ranges(numbers: &[i64], ranges: &[&std::ops::RangeInclusive<i64>]) -> Result<(), String> {
    match numbers.iter().zip(ranges).position(|(number, range)| !range.contains(number)) {
        None => Ok(()),
        Some(at) => {
            let range = ranges[at];
            Err(format!("number {} is {}, not in {}..={}", at + 1, numbers[at], range.start(), range.end()))
        }
    }
}
