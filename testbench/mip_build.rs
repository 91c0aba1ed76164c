// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the pyramid builder to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, unsigned_fields};
use crate::device::Device;
use crate::stepped::Stepped;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::mip_build::{BuildSize, Centring, MAX_LEVELS, MipBuild, Wrap, max_levels};
use std::collections::VecDeque;

/// The pyramid builder.
#[derive(Clone, Copy, Debug)]
pub struct MipBuildBinding;

/// The beat of a size.
pub fn size_beat(size: &BuildSize) -> Beat {
    let BuildSize { width, height, wrap, centring, levels, poles } = *size;
    let [repeat_u, repeat_v] = wrap.map(|wrap| u64::from(wrap == Wrap::Repeat));
    let cell = u64::from(centring == Centring::Cell);
    vec![0, width as u64, height as u64, repeat_u, repeat_v, cell, u64::from(poles), levels as u64, 0]
}

/// The beat of a texel.
pub fn texel_beat(value: u16) -> Beat {
    vec![1, 0, 0, 0, 0, 0, 0, 0, u64::from(value)]
}

/// `Repeat` where a flag is set.
pub(crate) fn wrap_of(flag: u64) -> Wrap {
    if flag == 1 { Wrap::Repeat } else { Wrap::Clamp }
}

struct Golden(MipBuild);

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let &[kind, width, height, repeat_u, repeat_v, cell, poles, levels, value] = &beat[..] else { return };
        if kind == 0 {
            let centring = if cell == 1 { Centring::Cell } else { Centring::Node };
            let [width, height, levels] = [width, height, levels].map(|number| number as usize);
            let (wrap, poles) = ([repeat_u, repeat_v].map(wrap_of), poles == 1);
            self.0.size(BuildSize { width, height, wrap, centring, levels, poles });
            return;
        }
        for node in self.0.texel(value as u16) {
            let place = [node.level, node.i, node.j].map(|number| number as u64);
            let values = [u64::from(node.max), u64::from(node.min), u64::from(node.last), u64::from(self.0.error())];
            expected.push(Expected::whole([&place[..], &values].concat()));
        }
    }
}

/// A sample: an end of the range as often as not.
pub(crate) fn random_sample(random: &mut Random) -> u16 {
    match random.below(8) {
        0 => 0,
        1 => u16::MAX,
        2 => 1,
        _ => random.bits() as u16,
    }
}

/// A side: one, an odd one, an even one, one with many factors of two; now and then 60 or so.
pub(crate) fn random_side(random: &mut Random) -> usize {
    match random.below(8) {
        0 => 1,
        1 => 2,
        2 => 8,
        3 => 16,
        4 => 3 + 2 * random.below(5) as usize,
        5 if random.chance(20) => 50 + random.below(20) as usize,
        _ => 1 + random.below(12) as usize,
    }
}

/// Borders that a map of this size allows.
pub(crate) fn random_wrap(random: &mut Random, width: usize, height: usize) -> [Wrap; 2] {
    [width, height].map(|side| if side.is_multiple_of(2) && random.chance(50) { Wrap::Repeat } else { Wrap::Clamp })
}

/// Small maps one behind the other; from the twentieth on, a fault now and then.
struct Maps {
    set: WidthSet,
    random: Random,
    queue: VecDeque<Beat>,
    maps: usize,
}

impl Maps {
    fn push(&mut self, mut beat: Beat, counts: &[usize]) {
        // What a beat does not use is anything.
        let bits = bits(&self.set);
        for (at, field) in beat.iter_mut().enumerate().skip(1).filter(|(at, _)| !counts.contains(at)) {
            *field = self.random.bits() & ((1 << bits[at].1) - 1);
        }
        self.queue.push_back(beat);
    }
    fn size(&mut self, size: &BuildSize) {
        self.push(size_beat(size), &[1, 2, 3, 4, 5, 6, 7]);
    }
    fn texels(&mut self, count: usize) {
        for _ in 0..count {
            let value = random_sample(&mut self.random);
            self.push(texel_beat(value), &[8]);
        }
    }
    fn fault(&mut self) {
        let most = 1 << self.set.side_bits;
        let (wrap, centring) = ([Wrap::Clamp; 2], Centring::Node);
        let clamp = BuildSize { width: 3, height: 3, wrap, centring, levels: 3, poles: false };
        let odd = |side: usize, wrap| BuildSize { width: side, height: 6, wrap, ..clamp };
        match self.random.below(9) {
            0 => self.texels(1),
            1 => {
                // A map that stops short of its end.
                self.size(&clamp);
                let some = 1 + self.random.below(8) as usize;
                self.texels(some);
            }
            2 => self.size(&BuildSize { width: 0, ..clamp }),
            3 => self.size(&BuildSize { height: 0, ..clamp }),
            4 => self.size(&BuildSize { levels: 0, ..clamp }),
            5 => self.size(&BuildSize { width: most, height: most, ..clamp }),
            6 => self.size(&odd(3, [Wrap::Repeat, Wrap::Clamp])),
            7 => self.size(&BuildSize { wrap: [Wrap::Clamp, Wrap::Repeat], levels: 1, poles: true, ..odd(4, wrap) }),
            _ => self.size(&odd(12, [Wrap::Clamp, Wrap::Repeat])),
        }
    }
    fn fill(&mut self) {
        self.maps += 1;
        if self.maps > 20 && self.random.chance(5) {
            self.fault();
        }
        let random = &mut self.random;
        let mut side = || match self.maps {
            // Tiny ones first, so that a short run sees nodes, too.
            0..=5 => 1 + random.below(3) as usize,
            _ => random_side(random),
        };
        let (width, height) = (side(), side());
        let wrap = random_wrap(random, width, height);
        let centring = if random.chance(30) { Centring::Cell } else { Centring::Node };
        // Without a repeat axis there can be more levels than change anything.
        let most = if wrap == [Wrap::Clamp; 2] { MAX_LEVELS } else { max_levels(width, height, centring, wrap) };
        let range = if random.chance(10) { 15 } else { 5 };
        let levels = (1 + random.below(range) as usize).min(most);
        let poles = wrap[1] == Wrap::Clamp && random.chance(40);
        self.size(&BuildSize { width, height, wrap, centring, levels, poles });
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

/// The input fields and their bits.
fn bits(set: &WidthSet) -> [(&'static str, usize); 9] {
    let m = set.side_width();
    let flag = |name| (name, 1);
    let [repeat_u, repeat_v, cell, poles] = ["repeat_u", "repeat_v", "cell", "poles"].map(flag);
    [("kind", 1), ("width", m), ("height", m), repeat_u, repeat_v, cell, poles, ("levels", 4), ("value", 16)]
}

impl Binding for MipBuildBinding {
    fn name(&self) -> &'static str {
        "mip_build"
    }
    fn summary(&self) -> &'static str {
        "builds the maxima and minima of every filter level of a map"
    }
    fn latency(&self) -> &'static str {
        "15"
    }
    fn interval(&self) -> &'static str {
        "1 (a map of N texels takes about 4/3 N)"
    }
    fn error(&self) -> &'static str {
        "0"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::MipBuild::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden(MipBuild::new(set.bank_words())))
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(Maps { set: *set, random: Random::new(seed), queue: VecDeque::new(), maps: 0 })
    }
    fn stimulus_format(&self) -> &'static str {
        "kind (0 size, 1 texel), width, height, repeat_u, repeat_v, cell, poles (0 or 1 each), levels and the texel's \
         value, all of them in every line"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        unsigned_fields(numbers, &bits(set))
    }
}
