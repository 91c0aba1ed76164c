// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the mean of a rectangle to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, unsigned_fields};
use crate::device::Device;
use crate::stepped::Stepped;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::sat_average::golden;

/// The mean of a rectangle.
#[derive(Clone, Copy, Debug)]
pub struct SatAverageBinding;

struct Golden {
    error: bool,
}

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let (mean, error) = golden(beat[0], beat[1]);
        self.error |= error;
        expected.push(Expected::whole(vec![u64::from(mean), u64::from(self.error)]));
    }
}

/// Sums and areas; from the twentieth beat on, a fault now and then.
struct Sums {
    set: WidthSet,
    random: Random,
    beats: usize,
}

impl Iterator for Sums {
    type Item = Beat;
    fn next(&mut self) -> Option<Beat> {
        self.beats += 1;
        let (set, random) = (&self.set, &mut self.random);
        // The largest sum of 16-bit texels of this area fits B bits.
        let most = (1u64 << set.area_bits().min(set.sum_bits - 16)) - 1;
        let area = match random.below(8) {
            0 => 1,
            1 => most,
            2 => 1 << random.below(u64::from(most.ilog2()) + 1),
            3 => 512.min(most),
            4 => 1 + random.below(most),
            _ => 1 + random.below(most.min(500)),
        };
        let sum = match random.below(6) {
            0 => 0,
            1 => area * 65_535,
            // Halves of the last place, where the area has them.
            2 => area.div_ceil(512) * (1 + 2 * random.below(1000)).min(65_535),
            3 => random.below(area + 1),
            _ => random.below(area * 65_535 + 1),
        };
        if self.beats > 20 && random.chance(10) {
            let whole = (1u64 << set.sum_bits) - 1;
            return Some(match random.below(5) {
                0 => vec![sum, 0],
                1 => vec![whole, (1 << set.area_bits()) - 1],
                2 => vec![whole, 1],
                // As far as the mean fits, rounded up beyond it, and at last beyond it by itself.
                3 => vec![(area << 16) - 1, area],
                _ => vec![(area << 16).min(whole), area],
            });
        }
        Some(vec![sum, area])
    }
}

impl Binding for SatAverageBinding {
    fn name(&self) -> &'static str {
        "sat_average"
    }
    fn summary(&self) -> &'static str {
        "the mean of a rectangle from its sum and its area"
    }
    fn latency(&self) -> &'static str {
        "27"
    }
    fn interval(&self) -> &'static str {
        "27"
    }
    fn error(&self) -> &'static str {
        "1/2 unit of UQ16.8"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::SatAverage::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden { error: false })
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(Sums { set: *set, random: Random::new(seed), beats: 0 })
    }
    fn stimulus_format(&self) -> &'static str {
        "a sum and its area"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        unsigned_fields(numbers, &[("sum", set.sum_bits), ("area", set.area_bits())])
    }
}
