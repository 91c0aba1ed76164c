// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the remesher to its golden model, and base triangles and steps to the words of its ports.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::stepped::Stepped;
use crate::vertex_adder::{expect_count, fit_all};
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::remesher::{BaseTriangle, Format, golden};
use relief_models::step::{Kind, LeftCommand, MAX_COMPONENTS, RightCommand, Step, Vertex};

/// The remesher.
#[derive(Clone, Copy, Debug)]
pub struct RemesherBinding;

/// The golden model's format of a width set.
pub fn format(set: &WidthSet) -> Format {
    Format {
        components: set.components,
        vertex_bits: set.vertex_bits as u32,
        guard_bits: set.guard_bits as u32,
        coordinate_bits: set.coordinate_bits as u32,
        column_depth: set.column_depth,
    }
}

/// The input beat of a base triangle that fits the width set.
pub fn beat_of(set: &WidthSet, base: &BaseTriangle) -> Beat {
    let corner = |c: &[i32; 3]| pack(&c.map(i64::from), set.coordinate_bits);
    let vertex = |v: &Vertex| pack(&v[..set.components], set.vertex_bits);
    base.corners.iter().map(corner).chain(base.data.iter().map(vertex)).flatten().collect()
}

/// The base triangle of an input beat.
pub fn base_of(set: &WidthSet, beat: &[u64]) -> BaseTriangle {
    let corner_words = (3 * set.coordinate_bits).div_ceil(64);
    let vertex_words = (set.components * set.vertex_bits).div_ceil(64);
    let mut base = BaseTriangle { corners: [[0; 3]; 3], data: [[0; MAX_COMPONENTS]; 3] };
    for k in 0..3 {
        let corner = unpack(&beat[k * corner_words..], 3, set.coordinate_bits);
        base.corners[k].iter_mut().zip(corner).for_each(|(to, from)| *to = from as i32);
        let data = unpack(&beat[3 * corner_words + k * vertex_words..], set.components, set.vertex_bits);
        base.data[k][..set.components].copy_from_slice(&data);
    }
    base
}

/// The words of a step in the order of the step port's fields.
pub fn words_of(set: &WidthSet, step: &Step) -> Beat {
    let mut words =
        vec![step.kind as u64, step.left as u64, step.right as u64, u64::from(step.swap), u64::from(step.last)];
    words.extend(pack(&step.left_vertex[..set.components], set.vertex_bits));
    words.extend(pack(&step.right_vertex[..set.components], set.vertex_bits));
    words
}

/// The step that the words of the step port stand for.
pub fn step_of(set: &WidthSet, words: &[u64]) -> Step {
    let vertex_words = (set.components * set.vertex_bits).div_ceil(64);
    let vertex = |at: usize| {
        let mut vertex = [0; MAX_COMPONENTS];
        vertex[..set.components].copy_from_slice(&unpack(&words[at..], set.components, set.vertex_bits));
        vertex
    };
    Step {
        kind: [Kind::Step, Kind::Start, Kind::Init, Kind::Fan][words[0] as usize & 3],
        left: [LeftCommand::Ref, LeftCommand::Set, LeftCommand::Recall, LeftCommand::Edge][words[1] as usize & 3],
        right: [RightCommand::Ref, RightCommand::Set, RightCommand::Store, RightCommand::Edge][words[2] as usize & 3],
        swap: words[3] & 1 == 1,
        last: words[4] & 1 == 1,
        left_vertex: vertex(5),
        right_vertex: vertex(5 + vertex_words),
    }
}

/// A random base triangle: mostly small, one in four degenerate or with a tie (of two corners, of all three, of two axes,
/// or mirrored in an axis), half of the axes at an end of the coordinates' range.
pub fn random_base(set: &WidthSet, random: &mut Random) -> BaseTriangle {
    let mut base = BaseTriangle { corners: [[0; 3]; 3], data: [[0; MAX_COMPONENTS]; 3] };
    let (low, high) = set.coordinates();
    let extent = [2, 4, 8, 16, 24][random.below(5) as usize];
    let offset: [i64; 3] = std::array::from_fn(|_| match random.below(4) {
        0 => i64::from(low),
        1 => i64::from(high) - extent,
        _ => random.below((i64::from(high) - i64::from(low) - extent + 1) as u64) as i64 + i64::from(low),
    });
    for corner in &mut base.corners {
        *corner = std::array::from_fn(|axis| (offset[axis] + random.below(extent as u64 + 1) as i64) as i32);
    }
    match random.below(16) {
        0 => base.corners[1] = base.corners[0],
        1 => base.corners[2] = base.corners[1],
        2 => base.corners = [base.corners[0]; 3],
        // Equal lengths along two axes, and equal areas on two planes: the lower axis wins.
        3 => {
            let [from, to] = [[0, 1], [1, 2], [2, 0]][random.below(3) as usize];
            let flip = random.below(2) == 0;
            let start = base.corners[0];
            for corner in &mut base.corners[1..] {
                let span = corner[from] - start[from];
                let target = start[to] + if flip { -span } else { span };
                corner[to] = target.clamp(low, high);
            }
        }
        _ => {}
    }
    for data in &mut base.data {
        data[..set.components].iter_mut().for_each(|value| *value = random.signed(set.vertex_bits));
    }
    base
}

struct Golden(WidthSet);

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let set = &self.0;
        golden(&format(set), &base_of(set, beat), &mut |step| {
            let vertex_words = (set.components * set.vertex_bits).div_ceil(64);
            let mut mask = vec![u64::MAX; 5];
            mask.extend(std::iter::repeat_n(if step.sends_left() { u64::MAX } else { 0 }, vertex_words));
            mask.extend(std::iter::repeat_n(if step.sends_right() { u64::MAX } else { 0 }, vertex_words));
            expected.push(Expected { words: words_of(set, step), mask });
        });
    }
}

impl Binding for RemesherBinding {
    fn name(&self) -> &'static str {
        "remesher"
    }
    fn summary(&self) -> &'static str {
        "sweeps base triangles into the steps of one-voxel triangle strips"
    }
    fn latency(&self) -> &'static str {
        "max(3 W + 31, 2 W + 3 L + 58) + 11 at most"
    }
    fn interval(&self) -> &'static str {
        "one step a cycle; max(3 W + 31, 2 W + 3 L + 58) a base triangle of few steps"
    }
    fn error(&self) -> &'static str {
        "edge n 2^-(g+1), interior (i+j) 2^-(g+1), and 1/2 of the rounding"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::Remesher::new(set.column_depth))) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden(*set))
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let (set, mut random) = (*set, Random::new(seed));
        Box::new(std::iter::repeat_with(move || beat_of(&set, &random_base(&set, &mut random))))
    }
    fn stimulus_format(&self) -> &'static str {
        "nine corner coordinates, signed N bits, then the components of the three corners, signed V bits"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 9 + 3 * set.components)?;
        fit_all(&numbers[..9], set.coordinate_bits)?;
        fit_all(&numbers[9..], set.vertex_bits)?;
        let mut base = BaseTriangle { corners: [[0; 3]; 3], data: [[0; MAX_COMPONENTS]; 3] };
        for k in 0..3 {
            base.corners[k] = std::array::from_fn(|axis| numbers[3 * k + axis] as i32);
            let data = &numbers[9 + k * set.components..][..set.components];
            base.data[k][..set.components].copy_from_slice(data);
        }
        Ok(beat_of(set, &base))
    }
}
