// SPDX-License-Identifier: MIT OR Apache-2.0
//! Adds a difference vertex to a vertex, component by component, all components in one cycle.
//!
//! `out[i] = vertex[i] + difference[i]  (mod 2^W)`: wraps, and is right whenever the true value fits
//!
//! | port          | format       | range |   Latency 1, interval 1
//! | in_vertex     | L x signed W | whole |   Golden: models::vertex_adder::golden
//! | in_difference | L x signed W | whole |   Error: 0
//! | out_vertex    | L x signed W | whole |
//!
//! Example, SQ12.19 (W = 32): 0x0010_0000 + 0x0000_8000 -> 0x0010_8000   (2.0 + 0.0625)
//! (Gumhold & Huettner 1999, section 3.4: the remesher's walkers are such additions.)

use crate::prelude::*;

/// Vertex adder of `L` components of `W` bits.
#[derive(Clone, Debug, Default, LogicBlock)]
pub struct VertexAdder<const L: usize, const W: usize> {
    /// Clock and reset.
    pub clock: Input<ClockReset>,
    /// A vertex and a difference stand at the input.
    pub in_valid: Input<Bit>,
    /// They are taken at this edge.
    pub in_ready: Output<Bit>,
    /// Vertex.
    pub in_vertex: Input<Lanes<L, W>>,
    /// Difference vertex.
    pub in_difference: Input<Lanes<L, W>>,
    /// A sum stands at the output.
    pub out_valid: Output<Bit>,
    /// It is taken at this edge.
    pub out_ready: Input<Bit>,
    /// Sum.
    pub out_vertex: Output<Lanes<L, W>>,
    full: Register<Bit>,
    sum: DataRegister<Lanes<L, W>>,
    go: Wire<Bit>,
}

impl<const L: usize, const W: usize> VertexAdder<L, W> {
    /// Cycles from operands to sum.
    pub const LATENCY: usize = 1;
}

impl<const L: usize, const W: usize> Logic for VertexAdder<L, W> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, full, sum);
        // s1_sum: the register is free, or freed at this edge.
        self.go.next = !self.full.q.val() || self.out_ready.val();
        self.in_ready.next = self.go.val();
        self.out_valid.next = self.full.q.val();
        self.out_vertex.next = self.sum.q.val();
        self.full.enable.next = self.go.val();
        self.full.d.next = self.in_valid.val();
        self.sum.enable.next = self.go.val() && self.in_valid.val();
        self.sum.d.next = self.in_vertex.val() + self.in_difference.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("vertex_adder")
    }
}

ports! {
    [const L: usize, const W: usize] VertexAdder<L, W> {
        inputs: in_valid, in_vertex, in_difference, out_ready;
        outputs: in_ready, out_valid, out_vertex;
        blocks:;
        state: full, sum
    }
}
