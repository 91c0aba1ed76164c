// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the reciprocal to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, unsigned_fields};
use crate::device::Device;
use crate::stepped::Stepped;
use relief_hdl::reciprocal::Reciprocal;
use relief_hdl::widths::WidthSet;
use relief_models::reciprocal::golden;

/// The reciprocal, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct ReciprocalBinding;

struct Golden;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        expected.push(Expected::whole(vec![golden(beat[0] as u32).into()]));
    }
}

/// A number of [1, 2) in `bits` bits whose leading one is at `leading`: half of them within a few units of the ends of a
/// line of 128 or of one of the steps along it.
pub(crate) fn normalised(random: &mut Random, leading: u32) -> u32 {
    let any = random.bits() as u32 & ((1 << leading) - 1);
    let (line, step) = ((1 << (leading - 7)) - 1, (1 << (leading - 18)) - 1);
    1 << leading
        | match random.below(10) {
            0 => any & !line,
            1 => any | line,
            2 => any & !step,
            3 => any | step,
            4 => random.below(4) as u32,
            5 => (1 << leading) - 1 - random.below(4) as u32,
            _ => any,
        }
}

impl Binding for ReciprocalBinding {
    fn name(&self) -> &'static str {
        "reciprocal"
    }
    fn summary(&self) -> &'static str {
        "the reciprocal of a normalised number"
    }
    fn latency(&self) -> &'static str {
        "18"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "2^-30.7 of its value, never above"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(Reciprocal::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || vec![normalised(&mut random, 31).into()]))
    }
    fn stimulus_format(&self) -> &'static str {
        "a number of 2^31..2^32, which stands for 1..2"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let beat = unsigned_fields(numbers, &[("m", 32)])?;
        if beat[0] >> 31 == 1 { Ok(beat) } else { Err(format!("number 1 (m) is {}, below 2147483648", beat[0])) }
    }
}
