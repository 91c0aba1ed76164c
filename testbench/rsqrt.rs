// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the reciprocal root to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, unsigned_fields};
use crate::device::Device;
use crate::reciprocal::normalised;
use crate::stepped::Stepped;
use relief_hdl::rsqrt::Rsqrt;
use relief_hdl::widths::WidthSet;
use relief_models::rsqrt::golden;

/// The reciprocal root, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct RsqrtBinding;

struct Golden;

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        expected.push(Expected::whole(vec![golden(beat[0] as u32).into()]));
    }
}

impl Binding for RsqrtBinding {
    fn name(&self) -> &'static str {
        "rsqrt"
    }
    fn summary(&self) -> &'static str {
        "the reciprocal square root of a normalised number"
    }
    fn latency(&self) -> &'static str {
        "25"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "2^-29.68 of its value"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(Rsqrt::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    /// Each octave has 64 lines, so an end of one of 128 is an end or a middle here.
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || {
            let leading = 30 + random.below(2) as u32;
            vec![normalised(&mut random, leading).into()]
        }))
    }
    fn stimulus_format(&self) -> &'static str {
        "a number of 2^30..2^32, which stands for 1..4"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let beat = unsigned_fields(numbers, &[("x", 32)])?;
        if beat[0] >> 30 > 0 { Ok(beat) } else { Err(format!("number 1 (x) is {}, below 1073741824", beat[0])) }
    }
}
