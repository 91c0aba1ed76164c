// SPDX-License-Identifier: MIT OR Apache-2.0
//! Adds a difference vertex to a vertex, component by component.
//!
//! `out[i] = vertex[i] + difference[i]  (mod 2^W)`: wraps, and is right whenever the true value fits
//!
//! | port       | format                      | range |
//! |------------|-----------------------------|-------|
//! | vertex     | components x signed W       | whole |
//! | difference | components x signed W       | whole |
//! | out        | components x signed W       | whole |
//!
//! Error: 0 where the true value fits W bits, else a multiple of 2^W.
//!
//! Example, SQ12.19 (W = 32): 0x0010_0000 + 0x0000_8000 -> 0x0010_8000   (2.0 + 0.0625)

use crate::fixed::wrap;
use crate::step::{MAX_COMPONENTS, Vertex};

/// The sum at `bits` bits, `1..=64`, of the first `components` components; the others are zero.
///
/// Reads only the low `bits` bits of its arguments. The 64-bit sum cannot lose any of them.
pub fn golden(vertex: &Vertex, difference: &Vertex, bits: u32, components: usize) -> Vertex {
    let mut sum = [0; MAX_COMPONENTS];
    for ((sum, v), d) in sum.iter_mut().zip(vertex).zip(difference).take(components) {
        *sum = wrap(v.wrapping_add(*d), bits);
    }
    sum
}

/// The exact sum of real-valued vertices (units as the arguments'), unbounded.
pub fn exact(vertex: &[f64; MAX_COMPONENTS], difference: &[f64; MAX_COMPONENTS]) -> [f64; MAX_COMPONENTS] {
    std::array::from_fn(|c| vertex[c] + difference[c])
}
