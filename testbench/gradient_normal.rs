// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the gradient normal to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::fit_ranges;
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::gradient_normal::GradientNormal;
use relief_hdl::widths::WidthSet;
use relief_models::gradient_normal::{Constants, Patch, golden};

/// The gradient normal, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct GradientNormalBinding;

struct Golden;

/// Bits of a lane and of the scale.
const LANE: usize = 32;
const SCALE: usize = 18;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let lanes = |at: usize| std::array::from_fn(|k| unpack(&beat[at..], 3, LANE)[k]);
        let patch = Patch {
            texels: [0, 1, 2, 3].map(|at| beat[at] as u16),
            weights: [4, 5].map(|at| beat[at] as u32),
            level: beat[6] as u32,
            normal: lanes(7),
            gradients: [lanes(9), lanes(11)],
        };
        let constants = Constants { scale: unpack(&beat[13..], 1, SCALE)[0] as i32, shift: beat[14] as u32 };
        expected.push(Expected::whole(pack(&golden(&constants, &patch).map(i64::from), 18)));
    }
}

/// The beat of a patch.
pub fn beat(constants: &Constants, patch: &Patch) -> Beat {
    let lanes = |lanes: &[i64; 3]| pack(lanes, LANE);
    let words = patch.texels.map(u64::from).to_vec();
    let [u, v] = &patch.gradients;
    let constants = vec![pack(&[constants.scale.into()], SCALE)[0], constants.shift.into()];
    [
        words,
        patch.weights.map(u64::from).to_vec(),
        vec![patch.level.into()],
        lanes(&patch.normal),
        lanes(u),
        lanes(v),
        constants,
    ]
    .concat()
}

/// The constants of a draw: what one has, and what the formats hold.
fn draw(random: &mut Random) -> Constants {
    let scale = match random.below(8) {
        0 => random.signed(SCALE),
        1 => 0,
        _ => ((1 << 16) + random.below(1 << 16) as i64) * [1, -1][random.below(2) as usize],
    };
    let shift = match random.below(8) {
        0 => 16,
        1 => 48,
        _ => 16 + random.below(33),
    };
    Constants { scale: scale as i32, shift: shift as u32 }
}

/// A patch of any steepness: now and then level, or one with lanes of nothing, or anything that the formats hold.
fn patch(random: &mut Random) -> Patch {
    let (base, spread) = (random.bits() as u16, 1 << random.below(17));
    let level = random.chance(6);
    let texel = |random: &mut Random| match random.below(16) {
        _ if level => base,
        0 => 0,
        1 => u16::MAX,
        _ => base.saturating_add(random.below(spread) as u16),
    };
    let weight = |random: &mut Random| match random.below(8) {
        0 => 0,
        1 => 4095,
        _ => random.below(4096) as u32,
    };
    // All lanes of a vertex are times c.
    let c = random.below(32);
    let lanes = |random: &mut Random| {
        let any = random.chance(10);
        [0; 3].map(|_| random.signed(LANE) >> if any { random.below(32) } else { c })
    };
    Patch {
        texels: [0; 4].map(|_| texel(random)),
        weights: [0; 2].map(|_| weight(random)),
        level: random.below(16) as u32,
        normal: if random.chance(3) { [0; 3] } else { lanes(random) },
        gradients: [0; 2].map(|_| lanes(random)),
    }
}

impl Binding for GradientNormalBinding {
    fn name(&self) -> &'static str {
        "gradient_normal"
    }
    fn summary(&self) -> &'static str {
        "the normal of a displaced vertex, from the slopes between four texels"
    }
    fn latency(&self) -> &'static str {
        "73"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "5.6e-5 rad for the lanes as they are"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(GradientNormal::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || beat(&draw(&mut random), &patch(&mut random))))
    }
    fn stimulus_format(&self) -> &'static str {
        "t00, t10, t01, t11, 16 bits; weights a, b, 12 bits; level; n c, grad u c, grad v c, signed 32 bits three times each; scale and shift"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 18)?;
        let (texel, weight, level) = (0..=65535, 0..=4095, 0..=15);
        let (lane, scale, shift) = (i32::MIN.into()..=i32::MAX.into(), -(1 << 17)..=(1 << 17) - 1, 16..=48);
        let head = [&texel, &texel, &texel, &texel, &weight, &weight, &level];
        fit_ranges(numbers, &[&head[..], &[&lane; 9], &[&scale, &shift]].concat())?;
        let lanes = |at: usize| std::array::from_fn(|k| numbers[at + k]);
        let patch = Patch {
            texels: [0, 1, 2, 3].map(|at| numbers[at] as u16),
            weights: [4, 5].map(|at| numbers[at] as u32),
            level: numbers[6] as u32,
            normal: lanes(7),
            gradients: [lanes(10), lanes(13)],
        };
        Ok(beat(&Constants { scale: numbers[16] as i32, shift: numbers[17] as u32 }, &patch))
    }
}
