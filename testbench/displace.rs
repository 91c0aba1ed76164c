// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds displacement to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::{fit_ranges, nearness};
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::displace::Displace;
use relief_hdl::widths::WidthSet;
use relief_models::displace::{Constants, golden};
use relief_models::step::MAX_COMPONENTS;

/// Displacement, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct DisplaceBinding;

struct Golden;

/// Lanes that come, and lanes that leave.
pub(crate) const TAKEN: usize = 6;
pub(crate) const SENT: usize = 5;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let mut vertex = [0; MAX_COMPONENTS];
        vertex[..TAKEN].copy_from_slice(&unpack(beat, TAKEN, 32));
        let signed = |k: usize, bits: usize| unpack(&beat[k..=k], 1, bits)[0];
        let constants = Constants {
            minimum: signed(4, 32),
            range: signed(5, 26),
            exponent: signed(6, 6) as i32,
            focal: beat[7] as u32,
        };
        let displaced = golden(&constants, &vertex, beat[3] as u32);
        expected.push(Expected::whole(pack(&displaced[..SENT], 32)));
    }
}

/// The input beat of the first lanes of a vertex, and its height.
pub(crate) fn beat(vertex: [i64; TAKEN], q: u64, constants: &Constants) -> Beat {
    let Constants { minimum, range, exponent, focal } = *constants;
    let word = |number, bits| pack(&[number], bits)[0];
    let rest = [q, word(minimum, 32), word(range, 26), word(exponent.into(), 6), focal.into()];
    [pack(&vertex, 32), rest.to_vec()].concat()
}

/// A height: its ends, what lies beyond the largest, and any.
fn height(random: &mut Random) -> u64 {
    match random.below(8) {
        0 => 0,
        1 => 65535 << 8,
        2 => (1 << 24) - 1 - random.below(300),
        _ => random.below(1 << 24),
    }
}

/// A vertex of a frame, as a draw has it: most are seen.
fn seen(random: &mut Random) -> Beat {
    let c = nearness(random);
    let limit = |random: &mut Random| random.signed(32) >> random.below(4);
    let mut normal = [0; 3].map(|_| ((i128::from(random.signed(32)) * i128::from(c.max(1))) >> 31) as i64);
    if random.chance(20) {
        normal[random.below(3) as usize] = 0;
    }
    let ends = [0; 2].map(|_| random.signed(31) >> random.below(8));
    let constants = Constants {
        minimum: ends[0],
        range: (ends[1] - ends[0]) / 256,
        exponent: -(random.below(12) as i32),
        focal: (200 + random.below(4000) as u32) << 16 | random.bits() as u32 & 0xffff,
    };
    let [x, y, z] = normal;
    beat([limit(random), limit(random), c, x, y, z], height(random), &constants)
}

/// A vertex whose den is within some units of a limit: 2^-8, below which it lies behind the eye, or c, at which it leaves
/// as near as z0. The normal points along the axis, the displacement is made to fit.
fn at_a_limit(random: &mut Random) -> Beat {
    let c = (1 << 30) + random.below(1 << 30) as i64;
    let toward = if random.chance(50) { -1 } else { 1 };
    let den = if random.chance(50) { 1 << 20 } else { c >> 3 };
    // d c >> 31 is den - 1 in 28 fraction bits, along a normal of 1.0.
    let wanted = i128::from(den + random.below(9) as i64 - 4 - (1 << 28)) * i128::from(toward);
    let constants = Constants {
        minimum: ((wanted << 31) / i128::from(c)) as i64,
        range: 0,
        exponent: 2,
        focal: random.bits() as u32,
    };
    let lanes = [random.signed(32), random.signed(32), c, 0, 0, toward * c];
    beat(lanes, height(random), &constants)
}

/// A vertex far off the axis, whose pixel is within some units of the edge of its format.
fn at_the_edge(random: &mut Random) -> Beat {
    let constants = Constants { minimum: 0, range: 0, exponent: 0, focal: random.bits() as u32 };
    let mut edge = || {
        let edge = if random.chance(50) { i64::from(i32::MAX) } else { i64::from(i32::MIN) };
        if random.chance(50) { edge - (edge >> 31 | 1) * random.below(1500) as i64 } else { random.signed(32) }
    };
    let (x, y) = (edge(), edge());
    beat([x, y, nearness(random), 0, 0, 1 << 20], height(random), &constants)
}

/// Anything that the formats hold.
fn any(random: &mut Random) -> Beat {
    let constants = Constants {
        minimum: random.signed(31),
        range: random.signed(25),
        exponent: (random.signed(6) as i32).clamp(-30, 15),
        focal: random.bits() as u32,
    };
    let vertex = [0; TAKEN].map(|_| random.signed(32) >> random.below(32));
    beat(vertex, height(random), &constants)
}

impl Binding for DisplaceBinding {
    fn name(&self) -> &'static str {
        "displace"
    }
    fn summary(&self) -> &'static str {
        "displaces a vertex along its normal, in projective form"
    }
    fn latency(&self) -> &'static str {
        "89"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "0.016 pixels at 640 x 480"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(Displace::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || match random.below(8) {
            0 => any(&mut random),
            1 | 2 => at_a_limit(&mut random),
            3 => at_the_edge(&mut random),
            _ => seen(&mut random),
        }))
    }
    fn stimulus_format(&self) -> &'static str {
        "lanes X, Y, c, nx c, ny c, nz c, signed 32 bits; q, minimum, range, exponent, focal"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 11)?;
        let (lane, minimum, range) =
            (i64::from(i32::MIN)..=i32::MAX.into(), -(1 << 30)..=1 << 30, -(1 << 24)..=1 << 24);
        let (height, exponent, focal) = (0..=(1 << 24) - 1, -30..=15, 0..=u32::MAX.into());
        let ranges = [&lane, &lane, &lane, &lane, &lane, &lane, &height, &minimum, &range, &exponent, &focal];
        fit_ranges(numbers, &ranges)?;
        let constants = Constants {
            minimum: numbers[7],
            range: numbers[8],
            exponent: numbers[9] as i32,
            focal: numbers[10] as u32,
        };
        let vertex = std::array::from_fn(|k| numbers[k]);
        Ok(beat(vertex, numbers[6] as u64, &constants))
    }
}
