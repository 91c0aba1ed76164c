// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds facing to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::{fit_ranges, nearness};
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::facing::Facing;
use relief_hdl::widths::WidthSet;
use relief_models::facing::golden;

/// Facing, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct FacingBinding;

struct Golden;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let normal = unpack(beat, 3, 32);
        let across = [2, 3].map(|k| unpack(&beat[k..=k], 1, 32)[0]);
        let away = golden([normal[0], normal[1], normal[2]], across, beat[4] as u32);
        expected.push(Expected::whole(vec![away.into()]));
    }
}

/// The input beat of the normal's lanes, X and Y, and the focal length.
pub(crate) fn beat(normal: [i64; 3], across: [i64; 2], focal: u32) -> Beat {
    let word = |lane: i64| pack(&[lane], 32)[0];
    [pack(&normal, 32), vec![word(across[0]), word(across[1]), focal.into()]].concat()
}

/// Half of the normals are at right angles to the line of sight, as far as integers go: there the sign hangs on a unit.
fn draw(random: &mut Random) -> Beat {
    let c = nearness(random).max(1);
    let focal = random.bits() as u32 >> random.below(20);
    let across = [0; 2].map(|_| random.signed(32) >> random.below(8));
    let mut normal = [0; 3].map(|_| ((i128::from(random.signed(32)) * i128::from(c)) >> 31) as i64);
    if random.chance(10) {
        normal[random.below(3) as usize] = [0, i64::from(i32::MIN)][random.below(2) as usize];
    }
    let towards = i64::from(focal >> 12);
    if random.chance(50) && towards > 0 {
        let sum: i64 = (0..2).map(|k| normal[k] * (across[k] >> 14)).sum();
        let level = -sum.div_euclid(towards) + random.below(3) as i64 - 1;
        normal[2] = level.clamp(i32::MIN.into(), i32::MAX.into());
    }
    beat(normal, across, focal)
}

impl Binding for FacingBinding {
    fn name(&self) -> &'static str {
        "facing"
    }
    fn summary(&self) -> &'static str {
        "whether a vertex faces away, by its own normal: minima or maxima"
    }
    fn latency(&self) -> &'static str {
        "12"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "sight off by 1/16 pixel"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(Facing::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || draw(&mut random)))
    }
    fn stimulus_format(&self) -> &'static str {
        "lanes nx c, ny c, nz c, X, Y, signed 32 bits; focal length, unsigned 32 bits"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 6)?;
        let lane = i64::from(i32::MIN)..=i32::MAX.into();
        fit_ranges(numbers, &[&lane, &lane, &lane, &lane, &lane, &(0..=u32::MAX.into())])?;
        Ok(beat([numbers[0], numbers[1], numbers[2]], [numbers[3], numbers[4]], numbers[5] as u32))
    }
}
