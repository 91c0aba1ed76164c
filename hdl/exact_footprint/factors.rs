// SPDX-License-Identifier: MIT OR Apache-2.0
//! Holds a vertex for eight cycles and gives the factors of its eight products, one after another.
//!
//! | product | a             | b   |   Latency 2 from vertex to first factors, interval 8; holds while `go` is low
//! | 0, 1    | sweep u, c    | c, u |
//! | 2, 3    | side u, c     | c, u |
//! | 4, 5    | sweep v, c    | c, v |
//! | 6, 7    | side v, c     | c, v |
//!
//! `free` tells that a vertex is taken; `last` and `c` stand for the eight cycles behind, and `ends` is high in the last of them.
//! `texel_bits` is that of the axis, beside its factors.

use crate::prelude::*;

/// Factors of lanes of `V` and differences of `W` bits.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Factors<const V: usize, const W: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub valid: Input<Bit>,
    pub u: Input<S<V>>,
    pub v: Input<S<V>>,
    /// Below 1 counts as 1.
    pub c: Input<S<V>>,
    pub sweep: Input<Lanes<3, W>>,
    pub side: Input<Lanes<3, W>>,
    pub texel_bits_u: Input<U<4>>,
    pub texel_bits_v: Input<U<4>>,
    pub levels: Input<U<5>>,
    pub free: Output<Bit>,
    pub ends: Output<Bit>,
    pub factor_a: Output<S<W>>,
    pub factor_b: Output<S<V>>,
    pub texel_bits: Output<U<4>>,
    pub nearness: Output<S<V>>,
    /// Levels less one.
    pub last: Output<U<5>>,
    /// The product that the vertex is at, the first one in the lowest bit.
    before: Register<U<8>>,
    s1_u: DataRegister<S<V>>,
    s1_v: DataRegister<S<V>>,
    s1_c: DataRegister<S<V>>,
    s1_sweep: DataRegister<Lanes<3, W>>,
    s1_side: DataRegister<Lanes<3, W>>,
    s1_texel_bits_u: DataRegister<U<4>>,
    s1_texel_bits_v: DataRegister<U<4>>,
    s1_last: DataRegister<U<5>>,
    s2_a: DataRegister<S<W>>,
    s2_b: DataRegister<S<V>>,
    s2_texel_bits: DataRegister<U<4>>,
    idle: Wire<Bit>,
    /// The product is the second one of its difference, that of the side, that of v.
    second: Wire<Bit>,
    of_side: Wire<Bit>,
    of_v: Wire<Bit>,
    sweep_lane: Wire<S<W>>,
    side_lane: Wire<S<W>>,
}

impl<const V: usize, const W: usize> Logic for Factors<V, W> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, before, s1_u, s1_v, s1_c, s1_sweep, s1_side, s1_texel_bits_u, s1_texel_bits_v, s1_last);
        dff_setup!(self, clock, s2_a, s2_b, s2_texel_bits);
        self.idle.next = !self.before.q.val().get_bits::<7>(0).any();
        self.free.next = self.idle.val();
        self.ends.next = self.before.q.val().get_bit(7);
        self.factor_a.next = self.s2_a.q.val();
        self.factor_b.next = self.s2_b.q.val();
        self.texel_bits.next = self.s2_texel_bits.q.val();
        self.nearness.next = self.s1_c.q.val();
        self.last.next = self.s1_last.q.val();

        self.second.next = (self.before.q.val() & 0xaa).any();
        self.of_side.next = (self.before.q.val() & 0xcc).any();
        self.of_v.next = (self.before.q.val() & 0xf0).any();
        self.sweep_lane.next = self.s1_sweep.q.val().get_bit(0);
        self.side_lane.next = self.s1_side.q.val().get_bit(0);
        if self.second.val() {
            self.sweep_lane.next = self.s1_sweep.q.val().get_bit(2);
            self.side_lane.next = self.s1_side.q.val().get_bit(2);
        } else if self.of_v.val() {
            self.sweep_lane.next = self.s1_sweep.q.val().get_bit(1);
            self.side_lane.next = self.s1_side.q.val().get_bit(1);
        }

        if self.go.val() {
            self.before.d.next = self.before.q.val() << 1;
            if self.idle.val() {
                self.before.d.next = bit_cast_to::<U<8>>(self.valid.val());
                self.s1_u.d.next = self.u.val();
                self.s1_v.d.next = self.v.val();
                self.s1_c.d.next = self.c.val();
                if self.c.val() < 1 {
                    self.s1_c.d.next = 1.into();
                }
                self.s1_sweep.d.next = self.sweep.val();
                self.s1_side.d.next = self.side.val();
                self.s1_texel_bits_u.d.next = self.texel_bits_u.val();
                self.s1_texel_bits_v.d.next = self.texel_bits_v.val();
                self.s1_last.d.next = self.levels.val() - 1;
            }
            self.s2_a.d.next = self.sweep_lane.val();
            if self.of_side.val() {
                self.s2_a.d.next = self.side_lane.val();
            }
            self.s2_b.d.next = self.s1_c.q.val();
            if self.second.val() {
                self.s2_b.d.next = self.s1_u.q.val();
                if self.of_v.val() {
                    self.s2_b.d.next = self.s1_v.q.val();
                }
            }
            self.s2_texel_bits.d.next = self.s1_texel_bits_u.q.val();
            if self.of_v.val() {
                self.s2_texel_bits.d.next = self.s1_texel_bits_v.q.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("footprint_factors_{V}_{W}"))
    }
}

latches! { [const V: usize, const W: usize] Factors<V, W>: before, s1_u, s1_v, s1_c, s1_sweep, s1_side, s1_texel_bits_u, s1_texel_bits_v, s1_last, s2_a, s2_b, s2_texel_bits }
