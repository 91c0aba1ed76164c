// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which lanes of a vertex go through the remesher, and with how many bits.
//!
//! ```text
//! narrow:  lane = floor(lane 2^(bits - 32) + 1/2), at most the largest        c at least 1 unit
//! widen:   lane 2^(32 - bits); a constant normal n and density rho come back as floor(n c + 1/2), floor(rho c + 1/2)
//! ```
//!
//! A draw whose vertices all have one normal (a flat base mesh) or one density need not interpolate them: these lanes are
//! their constant times c. What stays moves up, in the order of [`lane`].
//!
//! | bits | unit of X and Y | of c, n c, u c, v c, rho c |
//! |------|-----------------|----------------------------|
//! | 32   | 2^-18 pixels    | 2^-31 |
//! | 24   | 2^-10 pixels    | 2^-23 |
//!
//! Error: half a unit of the narrow lane, and none at 32 bits. Whatever comes of a vertex is a function of its lanes, so
//! equal vertices stay equal and a mesh stays closed.
//!
//! Example, 24 bits: X = 0x0012_3456 -> 0x1234 -> 0x0012_3400.

use crate::step::{MAX_COMPONENTS, Vertex};
use crate::vertex_transform::lane;
use serde::{Deserialize, Serialize};

/// What goes through the remesher.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lanes {
    /// Bits of a lane, `2..=32`.
    pub bits: u32,
    /// The normal of all vertices, in view space, SQ1.30, where its lanes stay behind.
    pub normal: Option<[i64; 3]>,
    /// The density of all vertices, UQ0.32, where its lane stays behind.
    pub density: Option<i64>,
}

impl Lanes {
    /// All nine lanes as they are.
    pub const WHOLE: Lanes = Lanes { bits: 32, normal: None, density: None };

    /// Lanes that go through the remesher.
    pub const fn components(&self) -> usize {
        lane::COUNT - if self.normal.is_some() { 3 } else { 0 } - if self.density.is_some() { 1 } else { 0 }
    }

    /// The lanes that go, in their order.
    fn travelling(&self) -> impl Iterator<Item = usize> + use<> {
        let (normal, density) = (self.normal.is_none(), self.density.is_none());
        (0..lane::COUNT).filter(move |&k| match k {
            lane::NORMAL..lane::U => normal,
            lane::DENSITY => density,
            _ => true,
        })
    }

    /// What the remesher takes of a vertex of nine lanes of 32 bits.
    pub fn narrow(&self, vertex: &Vertex) -> Vertex {
        let gone = 32 - self.bits;
        let most = (1i64 << (self.bits - 1)) - 1;
        let mut out = [0; MAX_COMPONENTS];
        for (to, from) in self.travelling().enumerate() {
            // One bit more than the lane before the shift; what rounds up to 2^(bits - 1) saturates.
            let rounded = if gone == 0 { vertex[from] } else { (vertex[from] + (1 << (gone - 1))) >> gone };
            out[to] = if from == lane::C { rounded.clamp(1, most) } else { rounded.min(most) };
        }
        out
    }

    /// The nine lanes of a difference of vertices, each as many bits wider as it is of a vertex; those that stayed behind are 0.
    pub fn widen_difference(&self, difference: &Vertex) -> Vertex {
        let mut out = [0; MAX_COMPONENTS];
        for (from, to) in self.travelling().enumerate() {
            out[to] = difference[from] << (32 - self.bits);
        }
        out
    }

    /// The nine lanes of 32 bits of a vertex that the remesher sent.
    pub fn widen(&self, vertex: &Vertex) -> Vertex {
        let mut out = self.widen_difference(vertex);
        let c = out[lane::C];
        if let Some(normal) = self.normal {
            // As `vertex_transform::project` makes them of a vertex: SQ1.30 times UQ0.31; 1.0 saturates.
            for (k, n) in normal.into_iter().enumerate() {
                let most = i64::from(i32::MAX);
                out[lane::NORMAL + k] = ((n * c + (1 << 29)) >> 30).clamp(-most, most);
            }
        }
        if let Some(density) = self.density {
            // 32 + 31 bits.
            out[lane::DENSITY] = (density * c + (1 << 31)) >> 32;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vertices() -> impl Strategy<Value = Vertex> {
        let lane = prop_oneof![any::<i32>(), Just(i32::MIN), Just(i32::MAX), Just(0)];
        (proptest::array::uniform9(lane), 1..=i32::MAX).prop_map(|(lanes, c)| {
            let mut vertex = [0; MAX_COMPONENTS];
            lanes.iter().zip(&mut vertex).for_each(|(from, to)| *to = i64::from(*from));
            vertex[lane::C] = c.into();
            vertex
        })
    }

    proptest! {
        #[test]
        fn lanes_lose_half_a_unit_at_most(vertex in vertices(), bits in 2u32..=32) {
            let lanes = Lanes { bits, ..Lanes::WHOLE };
            let back = lanes.widen(&lanes.narrow(&vertex));
            let unit = 1i64 << (32 - bits);
            for k in 0..lane::COUNT {
                // The largest value of the narrow lane is a unit below 1.0; c is a unit at least.
                let off = (back[k] - vertex[k]).abs();
                let end = vertex[k] > i64::from(i32::MAX) - unit || k == lane::C && vertex[k] < unit;
                prop_assert!(off <= if end { unit } else { unit / 2 }, "lane {}: {} -> {}", k, vertex[k], back[k]);
            }
            if bits == 32 {
                prop_assert_eq!(back, vertex);
            }
        }

        #[test]
        fn lanes_bring_constants_back(vertex in vertices(), normal in proptest::array::uniform3(-1i64 << 30..=1 << 30), density in 0i64..=u32::MAX.into()) {
            let c = vertex[lane::C];
            let mut whole = vertex;
            for k in 0..3 {
                whole[lane::NORMAL + k] = ((normal[k] * c + (1 << 29)) >> 30).clamp(-i64::from(i32::MAX), i32::MAX.into());
            }
            whole[lane::DENSITY] = (density * c + (1 << 31)) >> 32;
            for lanes in [
                Lanes { normal: Some(normal), ..Lanes::WHOLE },
                Lanes { density: Some(density), ..Lanes::WHOLE },
                Lanes { bits: 32, normal: Some(normal), density: Some(density) },
            ] {
                let narrow = lanes.narrow(&whole);
                prop_assert!(narrow[lanes.components()..].iter().all(|lane| *lane == 0));
                prop_assert_eq!(lanes.widen(&narrow), whole);
            }
        }
    }
}
