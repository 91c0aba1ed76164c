// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binds the vertex adder to its golden model.

use crate::binding::{Beat, Binding, Expected, Model, Random, pack, unpack};
use crate::device::Device;
use crate::stepped::Stepped;
use relief_hdl::widths::WidthSet;
use relief_hdl::with_width_set;
use relief_models::step::MAX_COMPONENTS;
use relief_models::vertex_adder::golden;

/// The vertex adder.
#[derive(Clone, Copy, Debug)]
pub struct VertexAdderBinding;

struct Golden(WidthSet);

impl Model for Golden {
    fn accept(&mut self, beat: &Beat, expected: &mut Vec<Expected>) {
        let (components, bits) = (self.0.components, self.0.accumulator_bits());
        let (vertex, difference) = beat.split_at(beat.len() / 2);
        let widen = |words: &[u64]| {
            let mut vertex = [0; MAX_COMPONENTS];
            vertex[..components].copy_from_slice(&unpack(words, components, bits));
            vertex
        };
        let sum = golden(&widen(vertex), &widen(difference), bits as u32, components);
        expected.push(Expected::whole(pack(&sum[..components], bits)));
    }
}

impl Binding for VertexAdderBinding {
    fn name(&self) -> &'static str {
        "vertex_adder"
    }
    fn summary(&self) -> &'static str {
        "adds a difference vertex to a vertex, all components in one cycle"
    }
    fn latency(&self) -> &'static str {
        "1"
    }
    fn interval(&self) -> &'static str {
        "1"
    }
    fn error(&self) -> &'static str {
        "0 (wraps at W bits)"
    }
    fn device(&self, set: &WidthSet) -> Box<dyn Device> {
        with_width_set!(set.name, W => Box::new(Stepped::new(W::VertexAdder::default())) as Box<dyn Device>)
            .expect("a width set of the list")
    }
    fn model(&self, set: &WidthSet) -> Box<dyn Model> {
        Box::new(Golden(*set))
    }
    fn random(&self, set: &WidthSet, seed: u64) -> Box<dyn Iterator<Item = Beat>> {
        let (components, bits, mut random) = (set.components, set.accumulator_bits(), Random::new(seed));
        Box::new(std::iter::repeat_with(move || {
            let mut vertex = || pack(&(0..components).map(|_| random.signed(bits)).collect::<Vec<_>>(), bits);
            [vertex(), vertex()].concat()
        }))
    }
    fn stimulus_format(&self) -> &'static str {
        "the components of the vertex, then those of the difference, signed W bits"
    }
    fn parse(&self, set: &WidthSet, numbers: &[i64]) -> Result<Beat, String> {
        let (components, bits) = (set.components, set.accumulator_bits());
        expect_count(numbers, 2 * components)?;
        fit_all(numbers, bits)?;
        let (vertex, difference) = numbers.split_at(components);
        Ok([pack(vertex, bits), pack(difference, bits)].concat())
    }
}

/// Refuses a line with more or fewer numbers than `wanted`.
pub(crate) fn expect_count(numbers: &[i64], wanted: usize) -> Result<(), String> {
    if numbers.len() == wanted {
        return Ok(());
    }
    Err(format!("the line has {} numbers, and {wanted} make a beat", numbers.len()))
}

/// Refuses a number that does not fit `bits` bits of two's complement.
pub(crate) fn fit_all(numbers: &[i64], bits: usize) -> Result<(), String> {
    let (low, high) = (i64::MIN >> (64 - bits), i64::MAX >> (64 - bits));
    match numbers.iter().position(|n| !(low..=high).contains(n)) {
        None => Ok(()),
        Some(at) => Err(format!("number {} is {}, which does not fit {low}..={high}", at + 1, numbers[at])),
    }
}
