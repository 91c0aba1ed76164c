// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the strip unit to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack};
use crate::device::Device;
use crate::remesher::{format, random_base, step_of, words_of};
use crate::stepped::Stepped;
use crate::vertex_adder::{expect_count, fit_all};
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::step::{Kind, LeftCommand, MAX_COMPONENTS, RightCommand, Step};
use relief_models::strip_unit::StripUnit;

/// The strip unit.
#[derive(Clone, Copy, Debug)]
pub struct StripUnitBinding;

struct Golden {
    set: WidthSet,
    unit: StripUnit,
}

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let out = self.unit.accept(&step_of(&self.set, beat));
        if !(out.first_valid || out.second_valid || out.last) {
            return;
        }
        let flags = [out.first_valid, out.second_valid, out.swap, out.last];
        let mut words: Beat = flags.map(u64::from).to_vec();
        for vertex in [&out.left, &out.right, &out.next_left, &out.next_right] {
            words.extend(pack(&vertex[..self.set.components], self.set.vertex_bits));
        }
        words.push(u64::from(self.unit.error()));
        expected.push(Expected::whole(words));
    }
}

/// Steps of random remeshed base triangles, and between them sequences of random commands: every command in every
/// order, recalls right behind their stores, repeated edges, and now and then a recall of nothing.
struct Steps {
    set: WidthSet,
    random: Random,
    queue: std::collections::VecDeque<Step>,
    stored: usize,
}

impl Steps {
    fn fill(&mut self) {
        if self.random.chance(50) {
            let base = random_base(&self.set, &mut self.random);
            relief_models::remesher::golden(&format(&self.set), &base, &mut |step| self.queue.push_back(*step));
            self.stored = usize::MAX;
            return;
        }
        self.stored = 0;
        let start = self.step(Kind::Start, LeftCommand::Set, RightCommand::Set);
        self.queue.push_back(start);
        // An edge vertex first: the register holds none that could be told from another after reset.
        let edge = self.step(Kind::Step, LeftCommand::Ref, RightCommand::Edge);
        self.queue.push_back(edge);
        for _ in 0..self.random.below(40) {
            let step = match self.random.below(10) {
                0 => self.step(Kind::Init, LeftCommand::Ref, RightCommand::Set),
                1 => {
                    let left = if self.random.chance(50) { LeftCommand::Set } else { LeftCommand::Edge };
                    self.step(Kind::Fan, left, RightCommand::Ref)
                }
                // Codes that the remesher never sends.
                2 => {
                    let kind = [Kind::Start, Kind::Init, Kind::Fan][self.random.below(3) as usize];
                    if kind == Kind::Start {
                        self.stored = 0;
                    }
                    let (left, right) = self.commands();
                    self.step(kind, left, right)
                }
                _ => self.random_step(),
            };
            self.queue.push_back(step);
        }
    }
    fn commands(&mut self) -> (LeftCommand, RightCommand) {
        let left = [LeftCommand::Ref, LeftCommand::Set, LeftCommand::Recall, LeftCommand::Edge];
        let right = [RightCommand::Ref, RightCommand::Set, RightCommand::Store, RightCommand::Edge];
        (left[self.random.below(4) as usize], right[self.random.below(4) as usize])
    }
    fn random_step(&mut self) -> Step {
        let (mut left, right) = self.commands();
        // Recalls of nothing set the sticky error: rarely, so that its rise is seen.
        if left == LeftCommand::Recall {
            if self.stored == 0 && self.random.below(1000) != 0 {
                left = LeftCommand::Ref;
            } else {
                self.stored = self.stored.saturating_sub(1);
            }
        }
        self.stored += usize::from(right == RightCommand::Store);
        self.step(Kind::Step, left, right)
    }
    fn step(&mut self, kind: Kind, left: LeftCommand, right: RightCommand) -> Step {
        let mut vertex = || {
            let mut vertex = [0; MAX_COMPONENTS];
            // Few values, so that different vertices often have equal data: the unit must tell them apart.
            let same = self.random.chance(30);
            for value in &mut vertex[..self.set.components] {
                *value = if same { 7 } else { self.random.signed(self.set.vertex_bits) };
            }
            vertex
        };
        let (left_vertex, right_vertex) = (vertex(), vertex());
        let (swap, last) = (self.random.chance(50), self.random.chance(10));
        Step { kind, left, right, swap, last, left_vertex, right_vertex }
    }
}

impl Iterator for Steps {
    type Item = Beat;
    fn next(&mut self) -> Option<Beat> {
        while self.queue.is_empty() {
            self.fill();
        }
        let set = self.set;
        self.queue.pop_front().map(|step| words_of(&set, &step))
    }
}

impl Binding for StripUnitBinding {
    fn name(&self) -> &'static str {
        "strip_unit"
    }
    fn summary(&self) -> &'static str {
        "decodes the step port into triangles, with the column memory"
    }
    fn latency(&self) -> &'static str {
        "2"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "0"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::StripUnit::new(set.column_depth))) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden { set: *set, unit: StripUnit::new(set.column_depth) })
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        Box::new(Steps { set: *set, random: Random::new(seed), queue: Default::default(), stored: 0 })
    }
    fn stimulus_format(&self) -> &'static str {
        "kind, left and right command (0..=3 each), swap and last (0 or 1), then the components of the left vertex and of \
         the right one, signed V bits"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        expect_count(numbers, 5 + 2 * set.components)?;
        for (at, (&number, most)) in numbers.iter().zip([3, 3, 3, 1, 1]).enumerate() {
            if !(0..=most).contains(&number) {
                return Err(format!("number {} is {number}, which does not fit 0..={most}", at + 1));
            }
        }
        fit_all(&numbers[5..], set.vertex_bits)?;
        let mut words: Beat = numbers[..5].iter().map(|&n| n as u64).collect();
        let (left, right) = numbers[5..].split_at(set.components);
        words.extend(pack(left, set.vertex_bits));
        words.extend(pack(right, set.vertex_bits));
        Ok(words)
    }
}
