// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the builder of summed-area tables to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, unsigned_fields};
use crate::device::Device;
use crate::mip_build::{random_sample, random_side};
use crate::stepped::Stepped;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::sat_build::SatBuild;
use std::collections::VecDeque;

/// The builder of summed-area tables.
#[derive(Clone, Copy, Debug)]
pub struct SatBuildBinding;

/// The beat of a size.
pub fn size_beat(width: usize, height: usize) -> Beat {
    vec![0, width as u64, height as u64, 0]
}

/// The beat of a texel.
pub fn texel_beat(value: u16) -> Beat {
    vec![1, 0, 0, u64::from(value)]
}

struct Golden(SatBuild);

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        if beat[0] == 0 {
            self.0.size(beat[1] as usize, beat[2] as usize);
        } else if let Some(sum) = self.0.texel(beat[3] as u16) {
            let (x, y, last) = (sum.x as u64, sum.y as u64, u64::from(sum.last));
            expected.push(Expected::whole(vec![x, y, sum.sum, last, u64::from(self.0.error())]));
        }
    }
}

/// Small maps one behind the other; from the twentieth on, a fault now and then.
struct Maps {
    set: WidthSet,
    random: Random,
    queue: VecDeque<Beat>,
    maps: usize,
}

impl Maps {
    fn push(&mut self, mut beat: Beat) {
        // What a beat does not use is anything.
        let m = (1 << self.set.side_width()) - 1;
        if beat[0] == 0 {
            beat[3] = self.random.bits() & 0xffff;
        } else {
            (beat[1], beat[2]) = (self.random.bits() & m, self.random.bits() & m);
        }
        self.queue.push_back(beat);
    }
    fn texels(&mut self, count: usize) {
        let bright = self.random.chance(20);
        for _ in 0..count {
            let value = if bright { u16::MAX } else { random_sample(&mut self.random) };
            self.push(texel_beat(value));
        }
    }
    fn fill(&mut self) {
        self.maps += 1;
        let side = 1 << self.set.side_bits;
        if self.maps > 20 && self.random.chance(5) {
            match self.random.below(5) {
                0 => self.texels(1),
                1 => self.push(size_beat(0, 3)),
                2 => self.push(size_beat(3, 0)),
                3 => self.push(size_beat(side + 1, 1)),
                _ => {
                    self.push(size_beat(3, 3));
                    self.texels(5);
                }
            }
        }
        let (width, height) = match self.random.below(40) {
            0 => (side, 1 + self.random.below(2) as usize),
            1 => (1, 100),
            _ => (random_side(&mut self.random), random_side(&mut self.random)),
        };
        self.push(size_beat(width, height));
        self.texels(width * height);
    }
}

impl Iterator for Maps {
    type Item = Beat;
    fn next(&mut self) -> Option<Beat> {
        while self.queue.is_empty() {
            self.fill();
        }
        self.queue.pop_front()
    }
}

impl Binding for SatBuildBinding {
    fn name(&self) -> &'static str {
        "sat_build"
    }
    fn summary(&self) -> &'static str {
        "builds the summed-area table of a map"
    }
    fn latency(&self) -> &'static str {
        "3"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "0 (wraps at B bits)"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::SatBuild::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden(SatBuild::new(1 << set.side_bits, set.sum_bits as u32)))
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(Maps { set: *set, random: Random::new(seed), queue: VecDeque::new(), maps: 0 })
    }
    fn stimulus_format(&self) -> &'static str {
        "kind (0 size, 1 texel), width, height and the texel's value, all of them in every line"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let m = set.side_width();
        unsigned_fields(numbers, &[("kind", 1), ("width", m), ("height", m), ("value", 16)])
    }
}
