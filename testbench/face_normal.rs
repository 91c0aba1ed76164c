// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the face normal to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::fit_ranges;
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::face_normal::FaceNormal;
use relief_hdl::widths::WidthSet;
use relief_models::face_normal::{Pixel, golden};

/// The face normal, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct FaceNormalBinding;

struct Golden;

/// Bits of X' and Y', and of c' with a sign.
const PLACE: usize = 22;
const NEARNESS: usize = 32;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let lanes = [(0, PLACE), (2, PLACE), (4, NEARNESS)].map(|(at, bits)| unpack(&beat[at..], 3, bits));
        let pixel = Pixel { scale: beat[6] as u32, shift: beat[7] as u32 };
        let normal = golden(&pixel, std::array::from_fn(|vertex| std::array::from_fn(|axis| lanes[axis][vertex])));
        expected.push(Expected::whole(pack(&normal.map(i64::from), 18)));
    }
}

/// The beat of a triangle, (X', Y', c') three times.
pub fn beat(pixel: &Pixel, vertices: [[i64; 3]; 3]) -> Beat {
    let lanes = |axis: usize, bits| pack(&vertices.map(|vertex| vertex[axis]), bits);
    let constants = vec![pixel.scale.into(), pixel.shift.into()];
    [lanes(0, PLACE), lanes(1, PLACE), lanes(2, NEARNESS), constants].concat()
}

/// The size of a pixel: what a draw has, and what the formats hold.
pub(crate) fn pixel(random: &mut Random) -> Pixel {
    let scale = match random.below(8) {
        0 => 1 << 23,
        1 => (1 << 24) - 1,
        _ => (1 << 23) + random.below(1 << 23),
    };
    let shift = match random.below(8) {
        0 => 16,
        1 => 48,
        2 => 16 + random.below(33),
        _ => 19 + random.below(21),
    };
    Pixel { scale: scale as u32, shift: shift as u32 }
}

/// A nearness: both ends, and any of any length.
fn nearness(random: &mut Random) -> i64 {
    match random.below(16) {
        0 => 0,
        1 => i32::MAX.into(),
        _ => (random.bits() >> 33) as i64 >> random.below(31),
    }
}

/// A triangle of any size: now and then at one depth, or without area, or anything that the formats hold.
pub(crate) fn triangle(random: &mut Random) -> [[i64; 3]; 3] {
    if random.chance(15) {
        return [0; 3].map(|_| [random.signed(PLACE), random.signed(PLACE), nearness(random)]);
    }
    let (spread, slope, level) = (random.below(22), random.below(31), random.chance(15));
    let centre = [random.signed(PLACE), random.signed(PLACE), nearness(random)];
    let mut vertices = [0; 3].map(|_| {
        let place =
            |x: i64, random: &mut Random| (x + (random.signed(PLACE) >> spread)).clamp(-(1 << 21), (1 << 21) - 1);
        let c = if level { centre[2] } else { centre[2] + (random.signed(NEARNESS) >> slope) };
        [place(centre[0], random), place(centre[1], random), c.clamp(0, i32::MAX.into())]
    });
    if random.chance(6) {
        vertices[1 + random.below(2) as usize] = vertices[0];
    }
    vertices
}

impl Binding for FaceNormalBinding {
    fn name(&self) -> &'static str {
        "face_normal"
    }
    fn summary(&self) -> &'static str {
        "the normal of a displaced triangle, towards the eye"
    }
    fn latency(&self) -> &'static str {
        "82"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "3.3e-5 rad for the triangle as it is"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(FaceNormal::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || beat(&pixel(&mut random), triangle(&mut random))))
    }
    fn stimulus_format(&self) -> &'static str {
        "X', Y', c' of three vertices, signed 22 bits twice and 0..2^31; scale and shift of a pixel"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 11)?;
        let (place, c) = (-(1 << 21)..=(1 << 21) - 1, 0..=i32::MAX.into());
        let (scale, shift) = (0..=(1 << 24) - 1, 16..=48);
        fit_ranges(numbers, &[&place, &place, &c, &place, &place, &c, &place, &place, &c, &scale, &shift])?;
        let pixel = Pixel { scale: numbers[9] as u32, shift: numbers[10] as u32 };
        Ok(beat(&pixel, std::array::from_fn(|vertex| std::array::from_fn(|axis| numbers[3 * vertex + axis]))))
    }
}
