// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the whole design to its golden machine.

mod draws;

use crate::binding::{Beat, Binding, Expected, Model, pack, unpack};
use crate::device::Device;
use crate::perspective_correct::fit_ranges;
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use crate::{remesher, vertex_transform};
use relief_hdl::widths::{self, WidthSet};
use relief_models::displace::displaced;
use relief_models::displacement_pipeline::{Command, Machine, Sent, VERTEX_PLACES, numbers};
use relief_models::mip_build::Wrap;
use relief_models::mip_fetch::Placement;
use relief_models::step::{MAX_COMPONENTS, Vertex};
use relief_models::vertex_transform::{BaseVertex, lane};
use std::ops::RangeInclusive;

/// The whole datapath of a draw as one design.
#[derive(Clone, Copy, Debug)]
pub struct DisplacementPipelineBinding;

/// Lanes of a beat, and the bits of each.
const LANES: usize = lane::COUNT;
const LANE_BITS: usize = 48;
/// Bits of a constant.
const VALUE_BITS: usize = 63;
/// Bits of a counter's number.
const NUMBER_BITS: usize = 7;

/// Fields of a beat before they are packed.
struct Fields {
    kind: u64,
    index: u64,
    value: i64,
    data: [i64; LANES],
    /// Whether index and value mean something, and how many lanes do, from the first on.
    used: (bool, bool, usize),
}

impl Fields {
    fn of(command: &Command) -> Self {
        let fields = |kind, index, value, data: &[i64], used| {
            let mut lanes = [0; LANES];
            lanes[..data.len()].copy_from_slice(data);
            Self { kind, index, value, data: lanes, used }
        };
        match *command {
            Command::Constant { number, value } => fields(0, number, value, &[], (true, true, 0)),
            Command::Record { place, vertex } => {
                let BaseVertex { position, normal, texel, density } = vertex;
                let [p, n] = [position, normal].map(|v| v.map(i64::from));
                let [u, v] = texel.map(i64::from);
                let data = [p[0], p[1], p[2], n[0], n[1], n[2], u, v, density.into()];
                fields(1, 0, place as i64, &data, (false, true, LANES))
            }
            Command::Size { level, placement } => {
                let Placement { width, height, base, minima_base, pitch, wrap } = placement;
                let [u, v] = wrap.map(|wrap| usize::from(wrap == Wrap::Repeat));
                let data = [level, width, height, base, pitch, u, v, minima_base].map(|number| number as i64);
                fields(2, 0, 0, &data, (false, false, data.len()))
            }
            Command::Load { level, minima, i, j, value } => {
                let data = [level as i64, i as i64, j as i64, value.into(), minima.into()];
                fields(3, 0, 0, &data, (false, false, data.len()))
            }
            Command::Triangle { places } => {
                let data = places.map(|place| place as i64);
                fields(4, 0, 0, &data, (false, false, data.len()))
            }
            Command::Report { counter } => fields(5, counter, 0, &[], (true, false, 0)),
        }
    }

    fn beat(&self) -> Beat {
        let value = pack(&[self.value], VALUE_BITS)[0];
        [vec![self.kind, self.index, value], pack(&self.data, LANE_BITS)].concat()
    }
}

/// The beat of a command.
pub fn command_beat(command: &Command) -> Beat {
    Fields::of(command).beat()
}

/// The command of a beat; none of kinds 6 and 7, which are taken and do nothing.
pub fn command_of(beat: &[u64]) -> Option<Command> {
    let data = unpack(&beat[3..], LANES, LANE_BITS);
    let value = unpack(&beat[2..3], 1, VALUE_BITS)[0];
    let number = |k: usize| data[k] as usize;
    let place = |number: i64| number as usize % VERTEX_PLACES;
    Some(match beat[0] {
        0 => Command::Constant { number: beat[1], value },
        1 => {
            let three = |k: usize| [data[k] as i32, data[k + 1] as i32, data[k + 2] as i32];
            let vertex = BaseVertex {
                position: three(0),
                normal: three(3),
                texel: [data[6] as u32, data[7] as u32],
                density: data[8] as u32,
            };
            Command::Record { place: place(value), vertex }
        }
        2 => {
            let wrap = [5, 6].map(|k| if data[k] & 1 == 1 { Wrap::Repeat } else { Wrap::Clamp });
            let (width, height, base, pitch, minima_base) = (number(1), number(2), number(3), number(4), number(7));
            let placement = Placement { width, height, base, minima_base, pitch, wrap };
            Command::Size { level: number(0), placement }
        }
        3 => {
            let minima = data[4] != 0;
            Command::Load { level: number(0), minima, i: number(1), j: number(2), value: data[3] as u16 }
        }
        4 => Command::Triangle { places: [0, 1, 2].map(|k| place(data[k])) },
        5 => Command::Report { counter: beat[1] },
        _ => return None,
    })
}

/// Words of an output beat, and where its fields begin.
const OUT_WORDS: usize = 12;
const OUT_X: usize = 2;
const OUT_Y: usize = 4;
const OUT_C: usize = 6;
const OUT_HEIGHT: usize = 8;
const OUT_COLOUR: usize = 10;
const OUT_ERROR: usize = 11;

/// The output beat of what the machine sends.
pub fn expected_of(sent: &Sent, error: bool) -> Expected {
    let mut words = vec![0; OUT_WORDS];
    let mut mask = vec![u64::MAX; OUT_WORDS];
    match sent {
        Sent::Triangle { vertices, colour } => {
            let lanes = |lane: usize| vertices.each_ref().map(|vertex| vertex[lane]);
            let fields = [
                (OUT_X, displaced::X, 22),
                (OUT_Y, displaced::Y, 22),
                (OUT_C, displaced::C, 32),
                (OUT_HEIGHT, displaced::HEIGHT, 25),
            ];
            for (at, lane, bits) in fields {
                words[at..at + 2].copy_from_slice(&pack(&lanes(lane), bits));
            }
            let [red, green, blue] = colour.map(u64::from);
            words[OUT_COLOUR] = red | green << 8 | blue << 16;
        }
        Sent::Report { value, .. } => {
            words[0] = 1;
            words[1] = value.unwrap_or(0).into();
            if value.is_none() {
                mask[1] = 0;
            }
        }
    }
    words[OUT_ERROR] = error.into();
    Expected { words, mask }
}

/// The number of a report, if the output beat is one.
pub fn report_of(words: &[u64]) -> Option<u32> {
    (words[0] == 1).then_some(words[1] as u32)
}

/// Vertices (lanes of [`displaced`]) and colour of an output beat that is a triangle.
pub fn triangle_of(words: &[u64]) -> ([Vertex; 3], [u8; 3]) {
    let lanes = |at: usize, bits: usize| unpack(&words[at..], 3, bits);
    let [x, y, c, height] = [lanes(OUT_X, 22), lanes(OUT_Y, 22), lanes(OUT_C, 32), lanes(OUT_HEIGHT, 25)];
    let vertices = std::array::from_fn(|k| {
        let mut vertex = [0; MAX_COMPONENTS];
        let places = [displaced::X, displaced::Y, displaced::C, displaced::HEIGHT];
        for (lane, values) in places.into_iter().zip([&x, &y, &c, &height]) {
            vertex[lane] = values[k];
        }
        vertex
    });
    (vertices, [0, 8, 16].map(|shift| (words[OUT_COLOUR] >> shift) as u8))
}

/// The machine of a width set.
pub fn machine(set: &WidthSet) -> Machine {
    Machine::new(&remesher::format(set), VERTEX_PLACES, set.bank_words())
}

struct Golden(Machine);

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let Some(command) = command_of(beat) else { return };
        let mut all = Vec::new();
        self.0.accept(&command, &mut |sent| all.push(sent));
        expected.extend(all.iter().map(|sent| expected_of(sent, self.0.error())));
    }
}

/// Refuses a constant whose value is not within its format.
fn fit_constant(number: i64, value: i64) -> Result<(), String> {
    let whole = |range: &RangeInclusive<i64>| fit_ranges(&[0, number, value], &[&(0..=0), &(0..=81), range]);
    // Name, first bit, range; the fields fill the value from bit 0 on.
    let fields: &[(&str, u32, u32, RangeInclusive<i64>)] = match number as u64 {
        0..64 => match vertex_transform::range(number) {
            Some(range) => {
                whole(&range)?;
                let odd = number == 43 && !(value as u64).is_power_of_two();
                let what = || format!("number 3 is {value}, and half of the grid's range is a power of two");
                return if odd { Err(what()) } else { Ok(()) };
            }
            None => return Err(format!("number 2 is {number}, and constants are 0..=21, 32..=43 and 64..=81")),
        },
        numbers::AXES | 65 => &[("size", 0, 14, 1..=8192), ("repeat", 14, 1, 0..=1), ("texel_bits", 15, 4, 1..=15)],
        numbers::LEVEL => &[("scale", 0, 24, 0..=0xff_ffff), ("shift", 24, 6, 0..=63), ("levels", 30, 4, 1..=15)],
        numbers::DISPLACEMENT => return whole(&(-(1 << 30)..=1 << 30)),
        68 => return whole(&(-(1 << 24)..=1 << 24)),
        69 => return whole(&(-30..=15)),
        numbers::PIXEL => &[("scale", 0, 24, 0..=0xff_ffff), ("shift", 24, 6, 16..=48)],
        numbers::RAMP..numbers::SPECULAR => {
            &[("red", 0, 18, 0..=1 << 16), ("green", 18, 18, 0..=1 << 16), ("blue", 36, 18, 0..=1 << 16)]
        }
        numbers::SPECULAR => &[("specular", 0, 17, 0..=1 << 16), ("shininess", 17, 8, 1..=255)],
        numbers::LIGHT => return whole(&(0..=(1 << 54) - 1)),
        79 => &[("red", 0, 20, 0..=1 << 18), ("green", 20, 20, 0..=1 << 18), ("blue", 40, 20, 0..=1 << 18)],
        numbers::VIEWPORT => &[
            ("switches", 0, 8, 0..=15),
            ("half of the width", 8, 24, 0..=0xff_ffff),
            ("half of the height", 32, 24, 0..=0xff_ffff),
        ],
        numbers::REACH => &[("reach", 0, 17, 0..=0x1_ffff), ("margin", 17, 17, 0..=0x1_ffff)],
        _ => return Err(format!("number 2 is {number}, and constants are 0..=21, 32..=43 and 64..=81")),
    };
    let bits = fields.iter().map(|(_, at, bits, _)| at + bits).max().unwrap_or(0);
    whole(&(0..=(1 << bits) - 1))?;
    for (name, at, bits, range) in fields {
        let field = value >> at & ((1 << bits) - 1);
        if !range.contains(&field) {
            let (low, high) = (range.start(), range.end());
            return Err(format!("number 3 has {field} for {name}, bits {at} on, not in {low}..={high}"));
        }
    }
    Ok(())
}

impl Binding for DisplacementPipelineBinding {
    fn name(&self) -> &'static str {
        "displacement_pipeline"
    }
    fn summary(&self) -> &'static str {
        "takes base triangles through transform, cut, remesher, displacement and light, as one design"
    }
    fn latency(&self) -> &'static str {
        "that of its blocks in a row"
    }
    fn interval(&self) -> &'static str {
        "one step of the remesher a cycle, where nothing waits"
    }
    fn error(&self) -> &'static str {
        "that of its blocks"
    }
    fn offered(&self, set: &WidthSet) -> bool {
        // All nine lanes go through the remesher, and no others.
        set.components == LANES
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        let depth = set.column_depth;
        // The sets that it is offered at, and no other types.
        match set.name {
            "default" => Box::new(Stepped::new(widths::default::DisplacementPipeline::new(depth))),
            "large" => Box::new(Stepped::new(widths::large::DisplacementPipeline::new(depth))),
            "small" => Box::new(Stepped::new(widths::small::DisplacementPipeline::new(depth))),
            name => unreachable!("displacement_pipeline is not offered at {name}"),
        }
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden(machine(set)))
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(draws::Draws::new(set, seed))
    }
    fn stimulus_format(&self) -> &'static str {
        "0, number and value of a constant; 1, place and nine lanes of a record; 2, level, width, height, base, pitch, \
         repeat_u, repeat_v, minima_base; 3, level, i, j, value, minima; 4, three places; or 5 and the number of a counter"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let kind = *numbers.first().ok_or("the line is empty")?;
        let wanted = match kind {
            0 => 3,
            1 => 2 + LANES,
            2 => 9,
            3 => 6,
            4 => 4,
            5 => 2,
            _ => return Err(format!("number 1 (kind) is {kind}, not in 0..=5")),
        };
        expect_count(numbers, wanted)?;
        let (side, word) = (0..=(1 << set.side_width()) - 1, 0..=(1 << (set.texel_bits - 2)) - 1);
        let (level, sample, flag, place) = (0..=15, 0..=65_535, 0..=1, 0..=VERTEX_PLACES as i64 - 1);
        let (one, unsigned, counter) = (-(1 << 30)..=1 << 30, 0..=u32::MAX.into(), 0..=(1 << NUMBER_BITS) - 1);
        let any = i64::MIN..=i64::MAX;
        let (l, f, p, n, u) = (&level, &flag, &place, &one, &unsigned);
        let ranges: &[&RangeInclusive<i64>] = match kind {
            0 => &[],
            1 => &[&any, p, n, n, n, n, n, n, u, u, u],
            2 => &[&any, l, &side, &side, &word, &side, f, f, &word],
            3 => &[&any, l, &side, &side, &sample, f],
            4 => &[&any, p, p, p],
            _ => &[&any, &counter],
        };
        fit_ranges(numbers, ranges)?;
        let mut fields = Fields { kind: kind as u64, index: 0, value: 0, data: [0; LANES], used: (true, true, LANES) };
        let data = match kind {
            0 => {
                fit_constant(numbers[1], numbers[2])?;
                (fields.index, fields.value) = (numbers[1] as u64, numbers[2]);
                &[]
            }
            1 => {
                fields.value = numbers[1];
                &numbers[2..]
            }
            5 => {
                fields.index = numbers[1] as u64;
                &[]
            }
            _ => &numbers[1..],
        };
        fields.data[..data.len()].copy_from_slice(data);
        Ok(fields.beat())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use relief_hdl::widths::{WIDTH_SETS, small};
    use relief_models::displacement_pipeline::counter;

    #[test]
    fn commands_come_back_from_their_beats() {
        let wrap = [Wrap::Clamp, Wrap::Repeat];
        let placement = Placement { width: 5, height: 4, base: 77, minima_base: 1077, pitch: 3, wrap };
        let vertex = BaseVertex {
            position: [i32::MIN, i32::MAX, -1],
            normal: [1 << 30, -(1 << 30), 0],
            texel: [u32::MAX, 1],
            density: u32::MAX,
        };
        let commands = [
            Command::Constant { number: 32, value: -(1 << 61) },
            Command::Constant { number: 80, value: 0xff_ffff << 32 | 15 },
            Command::Record { place: 511, vertex },
            Command::Size { level: 14, placement },
            Command::Load { level: 3, minima: true, i: 2, j: 1, value: u16::MAX },
            Command::Triangle { places: [511, 0, 1] },
            Command::Report { counter: 127 },
        ];
        for command in commands {
            assert_eq!(command_of(&command_beat(&command)), Some(command));
        }
        assert_eq!(command_of(&[6, 0, 0, 0, 0, 0, 0, 0, 0, 0]), None);
    }

    #[test]
    fn triangles_come_back_from_their_beats() {
        let mut vertices = [[0; MAX_COMPONENTS]; 3];
        for (k, vertex) in vertices.iter_mut().enumerate() {
            vertex[displaced::X] = -(1 << 21) + k as i64;
            vertex[displaced::Y] = (1 << 21) - 1 - k as i64;
            vertex[displaced::C] = i64::from(i32::MAX) - k as i64;
            vertex[displaced::HEIGHT] = (65_535 << 8) - k as i64;
        }
        let colour = [255, 1, 128];
        let expected = expected_of(&Sent::Triangle { vertices, colour }, false);
        assert_eq!((triangle_of(&expected.words), report_of(&expected.words)), ((vertices, colour), None));
        let report = expected_of(&Sent::Report { counter: 3, value: Some(u32::MAX) }, false);
        assert_eq!(report_of(&report.words), Some(u32::MAX));
        assert_eq!(expected_of(&Sent::Report { counter: 24, value: None }, false).mask[1], 0);
    }

    #[test]
    fn random_draws_fill_every_kind_and_every_counter() {
        for set in WIDTH_SETS.iter().filter(|set| DisplacementPipelineBinding.offered(set)) {
            let mut machine = machine(set);
            let (mut kinds, mut counts, mut triangles, mut beats) = ([0u64; 8], [0u64; counter::COUNT], 0, 0);
            for beat in DisplacementPipelineBinding.random(set, 7).take(60_000) {
                beats += 1;
                kinds[beat[0] as usize] += 1;
                let Some(command) = command_of(&beat) else { continue };
                machine.accept(&command, &mut |sent| match sent {
                    Sent::Triangle { .. } => triangles += 1,
                    Sent::Report { counter, value } => {
                        if let Some(count) = counts.get_mut(counter as usize) {
                            *count += u64::from(value.unwrap_or(0));
                        }
                    }
                });
                assert!(!machine.error());
            }
            println!("{}: {beats} beats, kinds {kinds:?}, {triangles} triangles, {counts:?}", set.name);
            assert!(kinds.iter().all(|count| *count > 0), "{kinds:?}");
            // A far plane that culls, and a lane out of range, are rare; the others come.
            let rare = [6, 9, 10, 16, 17];
            assert!((0..counter::COUNT).all(|k| counts[k] > 0 || rare.contains(&k)), "{counts:?}");
        }
    }

    #[test]
    fn lines_are_read_and_refused() {
        let parse = |numbers: &[i64]| DisplacementPipelineBinding.parse(&small::SET, numbers);
        let constant = |number, value| parse(&[0, number, value]);
        assert_eq!(constant(0, 5), Ok(command_beat(&Command::Constant { number: 0, value: 5 })));
        assert_eq!(parse(&[4, 0, 1, 511]), Ok(command_beat(&Command::Triangle { places: [0, 1, 511] })));
        assert_eq!(parse(&[5, 30]), Ok(command_beat(&Command::Report { counter: 30 })));
        assert!(constant(64, 16 | 1 << 14 | 4 << 15).is_ok() && constant(78, (1 << 54) - 1).is_ok());
        let refusals = [
            (parse(&[6]), "number 1 (kind) is 6, not in 0..=5"),
            (parse(&[4, 0, 1]), "the line has 3 numbers, and 4 make a beat"),
            (parse(&[4, 0, 1, 512]), "number 4 is 512, not in 0..=511"),
            (parse(&[5, 128]), "number 2 is 128, not in 0..=127"),
            (constant(22, 1), "number 2 is 22, and constants are 0..=21, 32..=43 and 64..=81"),
            (constant(82, 1), "number 2 is 82, and constants are 0..=21, 32..=43 and 64..=81"),
            (constant(-1, 1), "number 2 is -1, and constants are 0..=21, 32..=43 and 64..=81"),
            (constant(43, 3), "number 3 is 3, and half of the grid's range is a power of two"),
            (constant(64, 16), "number 3 has 0 for texel_bits, bits 15 on, not in 1..=15"),
            (constant(77, 1 << 16), "number 3 has 0 for shininess, bits 17 on, not in 1..=255"),
            (constant(69, 16), "number 3 is 16, not in -30..=15"),
        ];
        for (result, expected) in refusals {
            assert_eq!(result, Err(expected.to_owned()));
        }
    }
}
