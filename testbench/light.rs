// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the light to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::face_normal::{pixel, triangle};
use crate::perspective_correct::fit_ranges;
use crate::stepped::Stepped;
use crate::vertex_adder::expect_count;
use relief_hdl::widths::WidthSet;
use relief_models::face_normal::{self, Pixel};
use relief_models::light::{Light, Material, shade, view};
use relief_models::rsqrt::normalize;

/// The light, the same at every width set.
#[derive(Clone, Copy, Debug)]
pub struct LightBinding;

struct Golden;

/// What a beat holds.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
    /// Normal of the triangle.
    pub normal: [i32; 3],
    /// X', Y' of its vertex 0.
    pub position: [i64; 2],
    /// Heights of its vertices.
    pub heights: [i64; 3],
    /// The size of a pixel.
    pub pixel: Pixel,
    /// The surface.
    pub material: Material,
    /// The light.
    pub light: Light,
}

impl Lit {
    /// The beat.
    pub fn beat(&self) -> Beat {
        let Self { normal, position, heights, pixel, material, light } = *self;
        let colour = |colour: [u32; 3]| pack(&colour.map(i64::from), 18);
        [
            pack(&normal.map(i64::from), 18),
            pack(&position, 22),
            pack(&heights, 25),
            vec![pixel.scale.into(), pixel.shift.into()],
            material.ramp.map(colour).concat(),
            colour(material.ambient),
            vec![material.specular.into(), material.shininess.into()],
            pack(&light.direction.map(i64::from), 18),
            pack(&light.colour.map(i64::from), 20),
        ]
        .concat()
    }

    /// What the beat holds.
    fn of(beat: &Beat) -> Self {
        let vector = |at: usize| std::array::from_fn(|k| unpack(&beat[at..], 3, 18)[k] as i32);
        let colour = |at: usize, bits| std::array::from_fn(|k| unpack(&beat[at..], 3, bits)[k] as u32);
        Self {
            normal: vector(0),
            position: std::array::from_fn(|k| unpack(&beat[1..], 2, 22)[k]),
            heights: std::array::from_fn(|k| unpack(&beat[2..], 3, 25)[k]),
            pixel: Pixel { scale: beat[4] as u32, shift: beat[5] as u32 },
            material: Material {
                ramp: std::array::from_fn(|k| colour(6 + k, 18)),
                ambient: colour(11, 18),
                specular: beat[12] as u32,
                shininess: beat[13] as u32,
            },
            light: Light { direction: vector(14), colour: colour(15, 20) },
        }
    }

    /// The colour, as `out_colour` has it.
    fn colour(&self) -> u64 {
        let Self { normal, position, heights, pixel, material, light } = self;
        let [red, green, blue] = shade(material, &[*light], pixel, *position, *heights, *normal).map(u64::from);
        red | green << 8 | blue << 16
    }
}

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        expected.push(Expected::whole(vec![Lit::of(beat).colour()]));
    }
}

/// A number up to 1.0, and its ends.
fn part(random: &mut Random) -> u32 {
    match random.below(6) {
        0 => 0,
        1 => 1 << 16,
        _ => random.below((1 << 16) + 1) as u32,
    }
}

/// A height: both ends, what lies beyond them, and any.
fn height(random: &mut Random) -> i64 {
    match random.below(8) {
        0 => 0,
        1 => 65535 << 8,
        2 => (65535 << 8) + random.below(300) as i64 - 150,
        3 => random.signed(25),
        _ => random.below(65535 << 8) as i64,
    }
}

/// A unit vector, or now and then anything that the format holds.
fn direction(random: &mut Random) -> [i32; 3] {
    if random.chance(10) {
        return [0; 3].map(|_| random.signed(18) as i32);
    }
    normalize([0; 3].map(|_| random.signed(32) >> random.below(20)))
}

/// Half of the normals are those of triangles; others lie along the light, the view, or between them, where highlights are.
fn draw(random: &mut Random) -> Lit {
    let (pixel, vertices, heights) = (pixel(random), triangle(random), [0; 3].map(|_| height(random)));
    let position = [vertices[0][0], vertices[0][1]];
    let view = view(&pixel, position);
    let towards = match random.below(16) {
        0 => view,
        1 => view.map(|x| -x),
        _ => direction(random),
    };
    let normal = match random.below(8) {
        0 => direction(random),
        1 => towards,
        2 => view,
        3 => normalize([0, 1, 2].map(|k| i64::from(view[k]) + i64::from(towards[k]))),
        _ => face_normal::golden(&pixel, vertices),
    };
    let material = Material {
        ramp: [[0; 3]; 5].map(|colour| colour.map(|_: u32| part(random))),
        ambient: [0; 3].map(|_| part(random)),
        specular: part(random),
        shininess: [1, 255, 1 + random.below(255) as u32][random.below(5).min(2) as usize],
    };
    let light = Light {
        direction: towards,
        colour: [0; 3].map(|_: u32| match random.below(5) {
            0 => 0,
            1 => 1 << 18,
            2 => random.below((1 << 18) + 1) as u32,
            _ => random.below(1 << 17) as u32,
        }),
    };
    let heights = if random.chance(25) { [heights[0]; 3] } else { heights };
    Lit { normal, position, heights, pixel, material, light }
}

impl Binding for LightBinding {
    fn name(&self) -> &'static str {
        "light"
    }
    fn summary(&self) -> &'static str {
        "lights a triangle: ambient, diffuse, Blinn-Phong"
    }
    fn latency(&self) -> &'static str {
        "146"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "1/255 and half a unit of rounding"
    }
    fn device(&self, _set: &WidthSet) -> Box<dyn Device> {
        Box::new(Stepped::new(relief_hdl::light::Light::default()))
    }
    fn model(&self, _set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden)
    }
    fn random(&self, _set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let mut random = Random::new(seed);
        Box::new(std::iter::repeat_with(move || draw(&mut random).beat()))
    }
    fn stimulus_format(&self) -> &'static str {
        "normal, X' and Y', three heights; scale and shift of a pixel; five colours, ambient, specular, shininess; direction and colour of the light"
    }
    fn parse(&self, _set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 36)?;
        let (vector, place, height) =
            (-(1 << 17)..=(1 << 17) - 1, -(1 << 21)..=(1 << 21) - 1, -(1 << 24)..=(1 << 24) - 1);
        let (scale, shift, part) = (0..=(1 << 24) - 1, 16..=48, 0..=1 << 16);
        let (shininess, light) = (1..=255, 0..=1 << 18);
        let ranges = [
            [&vector; 3].to_vec(),
            [&place; 2].to_vec(),
            [&height; 3].to_vec(),
            vec![&scale, &shift],
            [&part; 19].to_vec(),
            vec![&shininess],
            [&vector; 3].to_vec(),
            [&light; 3].to_vec(),
        ]
        .concat();
        fit_ranges(numbers, &ranges)?;
        let vector = |at: usize| std::array::from_fn(|k| numbers[at + k] as i32);
        let colour = |at: usize| std::array::from_fn(|k| numbers[at + k] as u32);
        let lit = Lit {
            normal: vector(0),
            position: [numbers[3], numbers[4]],
            heights: [numbers[5], numbers[6], numbers[7]],
            pixel: Pixel { scale: numbers[8] as u32, shift: numbers[9] as u32 },
            material: Material {
                ramp: std::array::from_fn(|k| colour(10 + 3 * k)),
                ambient: colour(25),
                specular: numbers[28] as u32,
                shininess: numbers[29] as u32,
            },
            light: Light { direction: vector(30), colour: colour(33) },
        };
        Ok(lit.beat())
    }
}
