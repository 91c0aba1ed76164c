// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles on their way to a colour: face normal and light, one triangle a cycle.

use super::unit::Unit;
use super::{COUNT, FACE, LIGHT};
use crate::binding::{Beat, unpack};
use crate::face_normal;
use crate::light::Lit;
use relief_models::displace::displaced;
use relief_models::draw::Draw;
use relief_models::light::Light;
use relief_models::step::Vertex;
use std::collections::VecDeque;

/// A triangle that has left the strip unit.
struct Waiting {
    base: usize,
    triangle: [Vertex; 3],
    /// Once it is known.
    colour: Option<[u8; 3]>,
}

/// Triangles in the order in which they came, with what is known of them.
pub(super) struct Shading<'a> {
    draw: &'a Draw,
    lights: &'a [Light],
    waiting: VecDeque<Waiting>,
    /// Numbers of the triangles whose normal is wanted next, and of those that are on their way to one and to a colour.
    wanted: VecDeque<u64>,
    facing: VecDeque<u64>,
    normals: VecDeque<(u64, [i32; 3])>,
    lighting: VecDeque<u64>,
    /// Triangles that have gone.
    gone: u64,
}

impl<'a> Shading<'a> {
    pub(super) fn new(draw: &'a Draw, lights: &'a [Light]) -> Self {
        let (waiting, wanted, facing) = (VecDeque::new(), VecDeque::new(), VecDeque::new());
        Self { draw, lights, waiting, wanted, facing, normals: VecDeque::new(), lighting: VecDeque::new(), gone: 0 }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Takes a triangle of a base triangle.
    pub(super) fn take(&mut self, base: usize, triangle: [Vertex; 3]) {
        let number = self.gone + self.waiting.len() as u64;
        let colour = match self.lights {
            _ if !Draw::is_drawable(&triangle) => Some([0; 3]),
            [_] => None,
            several => Some(self.draw.shade(triangle, several)),
        };
        if colour.is_none() {
            self.wanted.push_back(number);
        }
        self.waiting.push_back(Waiting { base, triangle, colour });
    }

    fn at(&mut self, number: u64) -> &mut Waiting {
        &mut self.waiting[(number - self.gone) as usize]
    }

    /// Offers what the blocks can take.
    pub(super) fn offer(&mut self, units: &mut [Unit; COUNT]) {
        if !units[FACE].offers()
            && let Some(number) = self.wanted.pop_front()
        {
            let vertices = self.at(number).triangle.map(|vertex| [vertex[0], vertex[1], vertex[2]]);
            units[FACE].offer(&face_normal::beat(&self.draw.pixel, vertices));
            self.facing.push_back(number);
        }
        if !units[LIGHT].offers()
            && let Some((number, normal)) = self.normals.pop_front()
        {
            let [a, b, c] = self.at(number).triangle;
            let (pixel, material, light) = (self.draw.pixel, self.draw.material, self.lights[0]);
            let position = [a[displaced::X], a[displaced::Y]];
            let heights = [a, b, c].map(|vertex| vertex[displaced::HEIGHT]);
            units[LIGHT].offer(&Lit { normal, position, heights, pixel, material, light }.beat());
            self.lighting.push_back(number);
        }
    }

    /// Takes what the blocks have sent, and hands on what is lit, in order.
    pub(super) fn answer(
        &mut self,
        face: Option<Beat>,
        light: Option<Beat>,
        sink: &mut dyn FnMut(usize, [Vertex; 3], [u8; 3]),
    ) {
        if let (Some(words), Some(number)) = (face, self.facing.front().copied()) {
            self.facing.pop_front();
            let normal = unpack(&words, 3, 18);
            self.normals.push_back((number, std::array::from_fn(|k| normal[k] as i32)));
        }
        if let (Some(words), Some(number)) = (light, self.lighting.front().copied()) {
            self.lighting.pop_front();
            let colour = words[0];
            self.at(number).colour = Some([colour, colour >> 8, colour >> 16].map(|channel| channel as u8));
        }
        while let Some(Waiting { base, triangle, colour: Some(colour) }) =
            self.waiting.pop_front_if(|front| front.colour.is_some())
        {
            self.gone += 1;
            sink(base, triangle, colour);
        }
    }
}
