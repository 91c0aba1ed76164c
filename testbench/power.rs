// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the power to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random};
use crate::device::Device;
use crate::perspective_correct::fit_ranges;
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::power::Power;
use relief_hdl::widths::WidthSet;
use relief_models::power::golden;

/// The power, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct PowerBinding;

struct Golden;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        expected.push(Expected::whole(vec![golden(beat[0] as u32, beat[1] as u32).into()]));
    }
}

/// A number: both ends, what is near them, powers of two, and any.
fn number(random: &mut Random) -> u64 {
    match random.below(8) {
        0 => 0,
        1 => 1 << 16,
        2 => (1 << 16) - random.below(300),
        3 => random.below(300),
        4 => 1 << random.below(17),
        _ => random.below((1 << 16) + 1),
    }
}

impl Binding for PowerBinding {
    fn name(&self) -> &'static str {
        "power"
    }
    fn summary(&self) -> &'static str {
        "a number up to one to a power, by logarithm"
    }
    fn latency(&self) -> &'static str {
        "29"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "0.0007 for exponents up to 128"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(Power::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || {
            let n = match random.below(4) {
                0 => 1 + random.below(3),
                1 => 255 - random.below(3),
                _ => 1 + random.below(255),
            };
            vec![number(&mut random), n]
        }))
    }
    fn stimulus_format(&self) -> &'static str {
        "a number of 0..=65536, which stands for 0..=1; the exponent, 1..=255"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 2)?;
        fit_ranges(numbers, &[&(0..=1 << 16), &(1..=255)])?;
        Ok(vec![numbers[0] as u64, numbers[1] as u64])
    }
}
