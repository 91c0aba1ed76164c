// SPDX-License-Identifier: MIT OR Apache-2.0
//! Filter level of a vertex from the difference vertices of its sweep (Gumhold & Huettner 1999, section 3.4).
//!
//! ```text
//! |du(D)| = |D_u c - (u c) D_c| / c^2     F = max over u, v of |du(D_sweep)| + |du(D_side)|     level as in filter_level
//! ```
//!
//! | port          | format       | meaning |   Latency 52, interval 8
//! | in_u, in_v    | signed V     | lanes u c, v c
//! | in_c          | signed V     | lane c; below 1 unit counts as 1 unit
//! | in_sweep, in_side | 3 x signed W | u, v, c of both differences, with g more bits; an edge has one, and 0
//! | in_texel_bits_u, in_texel_bits_v | unsigned 4 | lanes count in units of 2^texel_bits texels
//! | in_levels     | unsigned 5   | levels of the map, at least 1
//! | out_level     | unsigned 4   | below `levels`   Golden: models::filter_level::level
//! | out_footprint | UQ16.16      | F, saturates   Golden: models::exact_footprint::golden
//!
//! Eight products, D_u c and (u c) D_c of two axes and two differences, go through one multiplier, one a cycle; all else is a
//! straight pipeline, in which something comes every other cycle. What is of the vertex stands for eight cycles.
//!
//! | stage           | operation                                  | width |
//! | s1 .. s8        | the input, [`Factors`]                     | |
//! | s2, s3          | factors of the first product, of the second | W, V |
//! | s4 .. s20       | N, its mantissa and place, [`Numerator`]   | 17 bits |
//! | s2 .. s27       | 1 / c^2, [`InverseSquare`]                 | 17 bits |
//! | s21_size        | zeros + g - 32 long - texel_bits           | -47 ..= 79 |
//! | s28 .. s34      | \|du\| of the first difference, [`Texels`] | UQ16.16, saturates; the others come 2, 4, 6 cycles later |
//! | s37, s38_along  | \|du(D_sweep)\| + \|du(D_side)\|           | saturates at 32 bits |
//! | s43_footprint   | F, when that of v has come, too            | UQ16.16 |
//! | s44 .. s51      | its level, [`Level`]                       | 0 ..= 15 |
//!
//! Example: c = 1/2, D_sweep = 2^-11 along u, D_side = 0, texel_bits_u = 11: F = 2.0 less a unit of 2^-15, k = 1, level 0.

mod factors;
mod inverse_square;
mod numerator;
mod texels;

pub use factors::Factors;
pub use inverse_square::InverseSquare;
pub use numerator::Numerator;
pub use texels::Texels;

use crate::filter_level::Level;
use crate::pipeline::{Delay, Flow, LongDelay};
use crate::prelude::*;

/// Exact footprint of lanes of `V` bits and differences of `W` bits, 17 < V <= 32, 34 < W <= 49; P = V + W.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct ExactFootprint<const V: usize, const W: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_u: Input<S<V>>,
    pub in_v: Input<S<V>>,
    pub in_c: Input<S<V>>,
    pub in_sweep: Input<Lanes<3, W>>,
    pub in_side: Input<Lanes<3, W>>,
    pub in_texel_bits_u: Input<U<4>>,
    pub in_texel_bits_v: Input<U<4>>,
    pub in_levels: Input<U<5>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_level: Output<U<4>>,
    pub out_footprint: Output<U<32>>,
    /// The first eight stages; the flow counts those behind them.
    s2_factors: Factors<V, W>,
    s20_numerator: Numerator<V, W, P>,
    s27_square: InverseSquare,
    s20_texel_bits: Delay<4, 17>,
    s21_size: DataRegister<S<8>>,
    s27_mantissa: Delay<17, 7>,
    s28_size: Delay<8, 7>,
    s34_texels: Texels,
    s35_texels: DataRegister<U<32>>,
    s36_texels: DataRegister<U<32>>,
    s37_sum: DataRegister<U<33>>,
    s38_along: DataRegister<U<32>>,
    s42_along: Delay<32, 4>,
    s43_footprint: DataRegister<U<32>>,
    s50_last: LongDelay<5, 14, 14, 14>,
    s51_level: Level,
    s51_footprint: Delay<32, 8>,
    flow: Flow<43, 36>,
    go: Wire<Bit>,
    upper_size: Wire<S<8>>,
    guard_bits: Constant<S<8>>,
    most: Constant<U<32>>,
}

impl<const V: usize, const W: usize, const P: usize> Default for ExactFootprint<V, W, P> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_u: Input::default(),
            in_v: Input::default(),
            in_c: Input::default(),
            in_sweep: Input::default(),
            in_side: Input::default(),
            in_texel_bits_u: Input::default(),
            in_texel_bits_v: Input::default(),
            in_levels: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_level: Output::default(),
            out_footprint: Output::default(),
            s2_factors: Factors::default(),
            s20_numerator: Numerator::default(),
            s27_square: InverseSquare::default(),
            s20_texel_bits: Delay::default(),
            s21_size: DataRegister::default(),
            s27_mantissa: Delay::default(),
            s28_size: Delay::default(),
            s34_texels: Texels::default(),
            s35_texels: DataRegister::default(),
            s36_texels: DataRegister::default(),
            s37_sum: DataRegister::default(),
            s38_along: DataRegister::default(),
            s42_along: Delay::default(),
            s43_footprint: DataRegister::default(),
            s50_last: LongDelay::default(),
            s51_level: Level::default(),
            s51_footprint: Delay::default(),
            flow: Flow::default(),
            go: Wire::default(),
            upper_size: Wire::default(),
            guard_bits: Constant::new(S::new((W - V - 1) as i64)),
            most: Constant::new(U::MAX),
        }
    }
}

impl<const V: usize, const W: usize, const P: usize> ExactFootprint<V, W, P> {
    /// Cycles between two vertices: its products.
    pub const INTERVAL: usize = 8;
    /// Cycles from vertex to level: those of its products, of the flow, and the one behind its last.
    pub const LATENCY: usize = Self::INTERVAL + 43 + 1;
}

impl<const V: usize, const W: usize, const P: usize> Logic for ExactFootprint<V, W, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s2_factors, s20_numerator, s27_square, s20_texel_bits, s27_mantissa, s28_size, s34_texels);
        clock!(self, clock, s42_along, s50_last, s51_level, s51_footprint, flow);
        dff_setup!(self, clock, s21_size, s35_texels, s36_texels, s37_sum, s38_along, s43_footprint);
        self.go.next = self.flow.go.val();
        self.in_ready.next = self.go.val() && self.s2_factors.free.val();
        self.flow.in_valid.next = self.s2_factors.ends.val();

        // s1 .. s8
        self.s2_factors.go.next = self.go.val();
        self.s2_factors.valid.next = self.in_valid.val();
        self.s2_factors.u.next = self.in_u.val();
        self.s2_factors.v.next = self.in_v.val();
        self.s2_factors.c.next = self.in_c.val();
        self.s2_factors.sweep.next = self.in_sweep.val();
        self.s2_factors.side.next = self.in_side.val();
        self.s2_factors.texel_bits_u.next = self.in_texel_bits_u.val();
        self.s2_factors.texel_bits_v.next = self.in_texel_bits_v.val();
        self.s2_factors.levels.next = self.in_levels.val();

        // s4 .. s20, and s2 .. s27
        self.s20_numerator.go.next = self.go.val();
        self.s20_numerator.a.next = self.s2_factors.factor_a.val();
        self.s20_numerator.b.next = self.s2_factors.factor_b.val();
        self.s27_square.go.next = self.go.val();
        self.s27_square.c.next = bit_cast_to::<S<32>>(self.s2_factors.nearness.val());

        // s21 .. s34
        self.s20_texel_bits.go.next = self.go.val();
        self.s20_texel_bits.value.next = self.s2_factors.texel_bits.val();
        self.upper_size.next = bit_cast_to::<S<8>>(self.s20_texel_bits.delayed.val())
            + (bit_cast_to::<S<8>>(self.s20_numerator.long.val()) << 5);
        self.s27_mantissa.go.next = self.go.val();
        self.s27_mantissa.value.next = self.s20_numerator.mantissa.val();
        self.s28_size.go.next = self.go.val();
        self.s28_size.value.next = bit_cast_to::<U<8>>(self.s21_size.q.val());
        self.s34_texels.go.next = self.go.val();
        self.s34_texels.mantissa.next = self.s27_mantissa.delayed.val();
        self.s34_texels.square.next = self.s27_square.square.val();
        self.s34_texels.size.next = bit_cast_to::<S<8>>(self.s28_size.delayed.val());
        self.s34_texels.exponent.next = self.s27_square.exponent.val();

        // s35 .. s51
        self.s42_along.go.next = self.go.val();
        self.s42_along.value.next = self.s38_along.q.val();
        self.s50_last.go.next = self.go.val();
        self.s50_last.value.next = self.s2_factors.last.val();
        self.s51_level.go.next = self.go.val();
        self.s51_level.footprint.next = self.s43_footprint.q.val();
        self.s51_level.last.next = self.s50_last.delayed.val();
        self.s51_footprint.go.next = self.go.val();
        self.s51_footprint.value.next = self.s43_footprint.q.val();

        if self.go.val() {
            self.s21_size.d.next =
                bit_cast_to::<S<8>>(self.s20_numerator.zeros.val()) + self.guard_bits.val() - self.upper_size.val();
            self.s35_texels.d.next = self.s34_texels.texels.val();
            self.s36_texels.d.next = self.s35_texels.q.val();
            self.s37_sum.d.next =
                bit_cast_to::<U<33>>(self.s36_texels.q.val()) + bit_cast_to::<U<33>>(self.s34_texels.texels.val());
            self.s38_along.d.next = bit_cast_to::<U<32>>(self.s37_sum.q.val());
            if self.s37_sum.q.val().get_bit(32) {
                self.s38_along.d.next = self.most.val();
            }
            self.s43_footprint.d.next = self.s38_along.q.val();
            if self.s42_along.delayed.val() > self.s38_along.q.val() {
                self.s43_footprint.d.next = self.s42_along.delayed.val();
            }
        }

        self.flow.value.next = bit_cast_to::<WideU<36>>(self.s51_level.level.val())
            | (bit_cast_to::<WideU<36>>(self.s51_footprint.delayed.val()) << 4);
        self.flow.out_ready.next = self.out_ready.val();
        self.out_valid.next = self.flow.out_valid.val();
        self.out_level.next = self.flow.out_value.val().get_bits::<4>(0);
        self.out_footprint.next = self.flow.out_value.val().get_bits::<32>(4);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("exact_footprint")
    }
}

ports! {
    [const V: usize, const W: usize, const P: usize] ExactFootprint<V, W, P> {
        inputs: in_valid, in_u, in_v, in_c, in_sweep, in_side, in_texel_bits_u, in_texel_bits_v, in_levels, out_ready;
        outputs: in_ready, out_valid, out_level, out_footprint;
        blocks: s2_factors, s20_numerator, s27_square, s20_texel_bits, s27_mantissa, s28_size, s34_texels, s42_along, s50_last, s51_level, s51_footprint, flow;
        state: s2_factors, s20_numerator, s27_square, s20_texel_bits, s21_size, s27_mantissa, s28_size, s34_texels, s35_texels, s36_texels, s37_sum, s38_along, s42_along, s43_footprint, s50_last, s51_level, s51_footprint, flow
    }
}
