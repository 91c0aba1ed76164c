// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a record of the vertex memory to what the remesher, the culling and the cutter take of it.
//!
//! ```text
//! view = rotation position + translation            X = f x/z   Y = f y/z   c = z0/z
//! lanes X, Y, c, nx c, ny c, nz c, u c, v c, rho c  corner (X / cell, Y / cell, -log2(c) octave - bias)
//! ```
//!
//! | port        | format       | meaning |   Latency 130, interval 65; 2 for a constant
//! | in_kind     | unsigned 2   | 0 a constant, 1 a record, 2 or 3 a vertex in view space, to be projected
//! | in_index, in_value | unsigned 6, signed 63 | where the constant goes ([`coefficient`], 32 + [`term`]) | 0
//! | in_data     | 9 x signed 48 | position and normal SQ1.30, u, v, rho UQ0.32; or lanes of `out_view` | 1, 2, 3
//! | out_data    | 9 x signed 32 | the lanes, SQ0.31; 0 where `out_status` is not   Golden: models::vertex_transform::golden
//! | out_corner  | 3 x signed 24 | grid corner; 0 where `out_status` is not
//! | out_view    | 9 x signed 48 | position in 2^-44 of the extent, normal SQ1.30, u, v, rho
//! | out_outcode | unsigned 6   | sides of the volume of sight that it is beyond
//! | out_outside | unsigned 5   | z0, and the guard band left, right, above, below, that it is behind
//! | out_status  | unsigned 2   | 0 projected, 1 beyond the lanes, 2 beyond the grid, 3 behind z0
//!
//! Only vertices send. Constants are beats, so they keep their order with vertices: one is taken when the vertex before it
//! has left the engine. After a reset a vertex before constant 0 sends nothing, and constant 0 comes before the others. A vertex stands at the input for the 64 cycles of its first round, and is taken in the last of them.
//! Exact like its golden model for positions in view space within 48 bits, z0 from 2^16 on, focal lengths above 2^12, and
//! vertices in view space whose normal fits 33 bits and whose texel and density fit 32.
//!
//! Base vertices are rare, so one multiplier of six DSP blocks does all 57 products of a vertex, one a cycle and in the
//! order of [`Schedule`]; a reciprocal, a normaliser and a table of the logarithm stand beside it, each used once or twice.
//!
//! Example: z = 2 z0, x = 0 -> c = 0x3FFF_FFFF to within a unit (0.5), X = 0, corner z = octave.

mod log_table;
mod operands;
mod schedule;
mod sum_of_products;

pub use log_table::LogTable;
pub use operands::Operands;
pub use schedule::{READ, ROUND, Schedule};
pub use sum_of_products::SumOfProducts;

use crate::pipeline::Leading;
use crate::prelude::*;
use crate::reciprocal::Newton;

/// Constants that are factors: their `in_index`.
pub mod coefficient {
    /// Nine of the rotation, row after row, SQ1.30.
    pub const ROTATION: i64 = 0;
    /// Focal length, UQ16.16.
    pub const FOCAL: i64 = 9;
    /// 1 / cell, UQ8.24.
    pub const INVERSE_CELL: i64 = 10;
    /// Voxels an octave, UQ16.16.
    pub const OCTAVE: i64 = 11;
    /// Of the normals of left, right: x, z; of top, bottom: y, z; of near, far: z. SQ1.14; the others are zero.
    pub const SIDES: i64 = 12;
    /// Number of them.
    pub const COUNT: usize = 22;
}

/// Constants that are added, or wide: their `in_index` less 32.
pub mod term {
    /// Three of the translation.
    pub const TRANSLATION: i64 = 0;
    /// z0 in view units.
    pub const Z0: i64 = 3;
    /// Grid bias, with 10 fraction bits.
    pub const BIAS: i64 = 4;
    /// Six reaches of the volume of sight.
    pub const REACH: i64 = 5;
    /// Half of the grid's range, `2^(coordinate_bits - 1)`.
    pub const LIMIT: i64 = 11;
    /// Number of them.
    pub const COUNT: usize = 12;
}

/// Vertex transform.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct VertexTransform {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_kind: Input<U<2>>,
    pub in_index: Input<U<6>>,
    pub in_value: Input<S<63>>,
    pub in_data: Input<Lanes<9, 48>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_data: Output<Lanes<9, 32>>,
    pub out_corner: Output<Lanes<3, 24>>,
    pub out_view: Output<Lanes<9, 48>>,
    pub out_outcode: Output<U<6>>,
    pub out_outside: Output<U<5>>,
    pub out_status: Output<U<2>>,
    // Control: all else moves while a round runs.
    running: Register<Bit>,
    step: Register<U<6>>,
    /// The round ends in this cycle: its last step.
    ending: Register<Bit>,
    taking: Register<Bit>,
    /// The first constant has come.
    begun: Register<Bit>,
    /// A vertex is in its first round, or has gone through it.
    newer: Register<Bit>,
    /// A vertex is in its second round.
    older: Register<Bit>,
    as_is: DataRegister<Bit>,
    schedule: Schedule,
    operands: Operands,
    sums: SumOfProducts,
    leading: Leading,
    newton: Newton,
    logarithm: LogTable,
    term: DataRegister<S<63>>,
    zeros: DataRegister<U<6>>,
    inverse: DataRegister<U<32>>,
    c: DataRegister<U<31>>,
    along: DataRegister<U<25>>,
    octaves: DataRegister<U<5>>,
    log_term: DataRegister<U<30>>,
    limit: DataRegister<S<34>>,
    mask: DataRegister<S<34>>,
    sides: DataRegister<U<11>>,
    /// A result has no place in the lanes, in the grid.
    lane_fails: DataRegister<Bit>,
    grid_fails: DataRegister<Bit>,
    shifted_corner: DataRegister<S<34>>,
    checks_corner: DataRegister<Bit>,
    sent: Register<Bit>,
    data: DataRegister<Lanes<9, 32>>,
    corner: DataRegister<Lanes<3, 24>>,
    view: DataRegister<Lanes<9, 48>>,
    flags: DataRegister<U<11>>,
    status: DataRegister<U<2>>,
    go: Wire<Bit>,
    out_free: Wire<Bit>,
    vertex: Wire<Bit>,
    constant: Wire<Bit>,
    writes: Wire<Bit>,
    mantissa: Wire<U<32>>,
    log_wide: Wire<S<63>>,
    term_now: Wire<S<63>>,
    adds_term: Wire<Bit>,
    amount: Wire<U<6>>,
    sign: Wire<Bit>,
    result: Wire<S<52>>,
    lane: Wire<S<32>>,
    coordinate: Wire<S<24>>,
    factor: Wire<S<48>>,
    ends: Wire<Bit>,
    clears: Wire<Bit>,
    limit_index: Constant<U<6>>,
    read: Constant<U<6>>,
    before_last: Constant<U<6>>,
    minus: Constant<S<63>>,
    below: Constant<S<63>>,
    no_data: Constant<Lanes<9, 32>>,
    no_corner: Constant<Lanes<3, 24>>,
}

impl Default for VertexTransform {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_kind: Input::default(),
            in_index: Input::default(),
            in_value: Input::default(),
            in_data: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_data: Output::default(),
            out_corner: Output::default(),
            out_view: Output::default(),
            out_outcode: Output::default(),
            out_outside: Output::default(),
            out_status: Output::default(),
            running: Register::default(),
            // The word of the last step stands before a round begins.
            step: Register::new(U::new(ROUND as i64 - 1)),
            ending: Register::default(),
            taking: Register::default(),
            begun: Register::default(),
            newer: Register::default(),
            older: Register::default(),
            as_is: DataRegister::default(),
            schedule: Schedule::default(),
            operands: Operands::default(),
            sums: SumOfProducts::default(),
            leading: Leading::default(),
            newton: Newton::default(),
            logarithm: LogTable::default(),
            term: DataRegister::default(),
            zeros: DataRegister::default(),
            inverse: DataRegister::default(),
            c: DataRegister::default(),
            along: DataRegister::default(),
            octaves: DataRegister::default(),
            log_term: DataRegister::default(),
            limit: DataRegister::default(),
            mask: DataRegister::default(),
            sides: DataRegister::default(),
            lane_fails: DataRegister::default(),
            grid_fails: DataRegister::default(),
            shifted_corner: DataRegister::default(),
            checks_corner: DataRegister::default(),
            sent: Register::default(),
            data: DataRegister::default(),
            corner: DataRegister::default(),
            view: DataRegister::default(),
            flags: DataRegister::default(),
            status: DataRegister::default(),
            go: Wire::default(),
            out_free: Wire::default(),
            vertex: Wire::default(),
            constant: Wire::default(),
            writes: Wire::default(),
            mantissa: Wire::default(),
            log_wide: Wire::default(),
            term_now: Wire::default(),
            adds_term: Wire::default(),
            amount: Wire::default(),
            sign: Wire::default(),
            result: Wire::default(),
            lane: Wire::default(),
            coordinate: Wire::default(),
            factor: Wire::default(),
            ends: Wire::default(),
            clears: Wire::default(),
            limit_index: Constant::new(U::new(32 + term::LIMIT)),
            read: Constant::new(U::new(READ as i64)),
            before_last: Constant::new(U::new(ROUND as i64 - 2)),
            minus: Constant::new(S::new(-(1 << 16))),
            below: Constant::new(S::new((1 << 25) - 1)),
            no_data: Constant::new(Lanes::default()),
            no_corner: Constant::new(Lanes::default()),
        }
    }
}

impl VertexTransform {
    /// Cycles from a vertex at the input of an idle engine to what is sent: two rounds, each behind a cycle that begins it.
    pub const LATENCY: usize = 2 * Self::INTERVAL;
    /// Cycles between two vertices.
    pub const INTERVAL: usize = ROUND + 1;
}

impl Logic for VertexTransform {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, schedule, operands, sums, leading, newton, logarithm);
        dff_setup!(
            self, clock, running, step, ending, taking, begun, newer, older, as_is, term, zeros, inverse, c, along,
            octaves
        );
        dff_setup!(self, clock, log_term, limit, mask, sides, lane_fails, grid_fails, shifted_corner, checks_corner);
        dff_setup!(self, clock, sent, data, corner, view, flags, status);
        self.in_ready.next = self.taking.q.val();
        self.out_valid.next = self.sent.q.val();
        self.out_data.next = self.data.q.val();
        self.out_corner.next = self.corner.q.val();
        self.out_view.next = self.view.q.val();
        self.out_outcode.next = self.flags.q.val().get_bits::<6>(0);
        self.out_outside.next = self.flags.q.val().get_bits::<5>(6);
        self.out_status.next = self.status.q.val();

        // A round begins with a vertex at the input, or one that has gone through its first round, once the output is free.
        self.go.next = self.running.q.val();
        self.schedule.step.next = self.step.q.val();
        self.ending.d.next = self.go.val() && self.step.q.val() == self.before_last.val();
        self.ends.next = self.ending.q.val();
        self.out_free.next = !self.sent.q.val() || self.out_ready.val();
        self.vertex.next = self.in_valid.val() && self.in_kind.val().any();
        self.constant.next = self.in_valid.val() && !self.in_kind.val().any();
        self.writes.next = self.taking.q.val() && self.constant.val();
        self.clears.next =
            self.ends.val() && (self.flags.q.val().get_bit(6) || self.lane_fails.q.val() || self.grid_fails.q.val());
        if self.out_ready.val() {
            self.sent.d.next = false;
        }
        self.taking.d.next = false;
        if self.go.val() {
            self.taking.d.next = self.step.q.val() == self.read.val() && self.newer.q.val();
            if self.ends.val() {
                self.running.d.next = false;
                self.sent.d.next = self.older.q.val();
                self.newer.d.next = self.newer.q.val() && self.vertex.val() && self.begun.q.val();
            } else {
                self.step.d.next = self.step.q.val() + 1;
            }
        } else if self.out_free.val() && (self.vertex.val() || self.newer.q.val()) {
            self.running.d.next = true;
            self.step.d.next = 0.into();
            self.newer.d.next = self.vertex.val();
            self.older.d.next = self.newer.q.val();
            self.as_is.d.next = self.in_kind.val().get_bit(1);
        } else {
            self.taking.d.next = self.constant.val() && !self.newer.q.val() && !self.taking.q.val();
        }
        if self.writes.val() && !self.in_index.val().any() {
            self.begun.d.next = true;
        }
        if self.writes.val() && self.in_index.val() == self.limit_index.val() {
            self.limit.d.next = bit_cast_to::<S<34>>(self.in_value.val());
        }
        self.mask.d.next = -(self.limit.q.val() << 1);

        // Factors
        self.operands.go.next = self.go.val();
        self.operands.writes.next = self.writes.val();
        self.operands.index.next = self.in_index.val();
        self.operands.value.next = self.in_value.val();
        self.operands.vertex.next = self.in_data.val();
        self.operands.as_is.next = self.as_is.q.val();
        self.operands.a_source.next = self.schedule.a_source.val();
        self.operands.a_address.next = self.schedule.a_address.val();
        self.operands.term.next = self.schedule.term.val();
        self.operands.b_source.next = self.schedule.b_source.val();
        self.operands.coefficient.next = self.schedule.coefficient.val();
        self.operands.rotates.next = self.schedule.rotates.val();
        self.operands.literal.next = self.schedule.literal.val();
        self.operands.along.next = self.along.q.val();
        self.operands.inverse.next = self.inverse.q.val();
        self.operands.c.next = self.c.q.val();
        self.operands.fall.next = self.logarithm.fall.val();
        self.operands.stores.next = self.schedule.stores.val();
        self.operands.store_address.next = self.schedule.store_address.val();
        self.operands.result.next = self.sums.result.val();

        // Sums
        self.adds_term.next =
            self.schedule.from.val().get_bit(0) || (self.schedule.from.val().get_bit(1) && !self.as_is.q.val());
        self.log_wide.next = (bit_cast_to::<S<63>>(self.log_term.q.val()) << 25) | self.below.val();
        self.term_now.next = 0.into();
        if self.adds_term.val() {
            self.term_now.next = self.operands.term_read.val();
        } else if self.schedule.from.val().get_bit(2) {
            self.term_now.next = self.log_wide.val();
        } else if self.schedule.from.val().get_bit(3) {
            self.term_now.next = self.minus.val();
        }
        self.amount.next = self.schedule.amount.val();
        if self.schedule.relative.val() {
            self.amount.next = self.schedule.amount.val() - self.zeros.q.val();
        }
        self.sums.go.next = self.go.val();
        self.sums.a.next = self.operands.a.val();
        self.sums.b.next = self.operands.b.val();
        self.sums.term.next = self.term.q.val();
        self.sums.begins.next = self.schedule.begins.val();
        self.sums.amount.next = self.amount.val();
        self.sums.rounds.next = self.schedule.rounds.val();
        self.sums.clamps.next = self.schedule.clamps.val();
        self.sign.next = self.sums.negative.val() ^ self.schedule.inverted.val();
        self.result.next = self.sums.result.val();
        self.lane.next = bit_cast_to::<S<32>>(self.result.val());
        self.coordinate.next = bit_cast_to::<S<24>>(self.result.val());
        self.factor.next = bit_cast_to::<S<48>>(self.operands.a.val());

        // Reciprocal and logarithm: every result goes in, and those that are meant are kept.
        self.leading.go.next = self.go.val();
        self.leading.value.next = bit_cast_to::<U<48>>(self.result.val());
        self.mantissa.next = self.leading.mantissa.val();
        self.newton.go.next = self.go.val();
        self.newton.m.next = self.mantissa.val();
        self.logarithm.go.next = self.go.val();
        self.logarithm.index.next = self.mantissa.val().get_bits::<6>(25);

        if self.go.val() {
            self.term.d.next = self.term_now.val();
            self.along.d.next = self.mantissa.val().get_bits::<25>(0);
            // 32 less the length of c, 16 to 47 leading zeros of 48.
            self.octaves.d.next = bit_cast_to::<U<5>>(self.leading.zeros.val() - 16);
            if self.schedule.keeps_zeros.val() {
                self.zeros.d.next = self.leading.zeros.val();
            }
            if self.schedule.keeps_inverse.val() {
                self.inverse.d.next = self.newton.reciprocal.val();
            }
            if self.schedule.keeps_c.val() {
                self.c.d.next = bit_cast_to::<U<31>>(self.result.val());
            }
            if self.schedule.keeps_logarithm.val() {
                self.log_term.d.next = (bit_cast_to::<U<30>>(self.octaves.q.val()) << 24)
                    - bit_cast_to::<U<30>>(self.logarithm.start.val());
            }
            if self.schedule.side.val() {
                self.sides.d.next = (self.sides.q.val() >> 1) | (bit_cast_to::<U<11>>(self.sign.val()) << 10);
            }
            if (self.schedule.checks_slope.val() && self.sums.long.val())
                || (self.schedule.checks_lane.val() && self.sums.wide.val())
            {
                self.lane_fails.d.next = true;
            }
            // -limit <= k < limit where no bit of k + limit is as high as 2 limit.
            self.shifted_corner.d.next = bit_cast_to::<S<34>>(self.result.val()) + self.limit.q.val();
            self.checks_corner.d.next = self.schedule.corner.val().any();
            if self.checks_corner.q.val() && (self.shifted_corner.q.val() & self.mask.q.val()).any() {
                self.grid_fails.d.next = true;
            }
        } else {
            self.lane_fails.d.next = false;
            self.grid_fails.d.next = false;
        }

        // What is sent
        if self.go.val() {
            if self.schedule.view.val() == 1 {
                self.view.d.next = self.view.q.val().replace_bit(0, self.factor.val());
            } else if self.schedule.view.val() == 2 {
                self.view.d.next = self.view.q.val().replace_bit(1, self.factor.val());
            } else if self.schedule.view.val() == 3 {
                self.view.d.next = self.view.q.val().replace_bit(2, self.factor.val());
            } else if self.schedule.view.val() == 4 {
                self.view.d.next = self.view.q.val().replace_bit(3, self.factor.val());
            } else if self.schedule.view.val() == 5 {
                self.view.d.next = self.view.q.val().replace_bit(4, self.factor.val());
            } else if self.schedule.view.val() == 6 {
                self.view.d.next = self.view.q.val().replace_bit(5, self.factor.val());
            } else if self.schedule.view.val() == 7 {
                self.view.d.next = self.view.q.val().replace_bit(6, self.factor.val());
            } else if self.schedule.view.val() == 8 {
                self.view.d.next = self.view.q.val().replace_bit(7, self.factor.val());
            } else if self.schedule.view.val() == 9 {
                self.view.d.next = self.view.q.val().replace_bit(8, self.factor.val());
            }
            if self.schedule.data.val() == 1 {
                self.data.d.next = self.data.q.val().replace_bit(0, self.lane.val());
            } else if self.schedule.data.val() == 2 {
                self.data.d.next = self.data.q.val().replace_bit(1, self.lane.val());
            } else if self.schedule.data.val() == 4 {
                self.data.d.next = self.data.q.val().replace_bit(3, self.lane.val());
            } else if self.schedule.data.val() == 5 {
                self.data.d.next = self.data.q.val().replace_bit(4, self.lane.val());
            } else if self.schedule.data.val() == 6 {
                self.data.d.next = self.data.q.val().replace_bit(5, self.lane.val());
            } else if self.schedule.data.val() == 7 {
                self.data.d.next = self.data.q.val().replace_bit(6, self.lane.val());
            } else if self.schedule.data.val() == 8 {
                self.data.d.next = self.data.q.val().replace_bit(7, self.lane.val());
            } else if self.schedule.data.val() == 9 {
                self.data.d.next = self.data.q.val().replace_bit(8, self.lane.val());
            } else if self.schedule.copies.val() {
                self.data.d.next = self.data.q.val().replace_bit(2, bit_cast_to::<S<32>>(self.c.q.val()));
            }
            if self.schedule.corner.val() == 1 {
                self.corner.d.next = self.corner.q.val().replace_bit(0, self.coordinate.val());
            } else if self.schedule.corner.val() == 2 {
                self.corner.d.next = self.corner.q.val().replace_bit(1, self.coordinate.val());
            } else if self.schedule.corner.val() == 3 {
                self.corner.d.next = self.corner.q.val().replace_bit(2, self.coordinate.val());
            }
            if self.schedule.copies.val() {
                self.flags.d.next = self.sides.q.val();
            }
        }
        if self.ends.val() {
            self.status.d.next = 0.into();
            if self.flags.q.val().get_bit(6) {
                self.status.d.next = 3.into();
            } else if self.lane_fails.q.val() {
                self.status.d.next = 1.into();
            } else if self.grid_fails.q.val() {
                self.status.d.next = 2.into();
            }
        }
        if self.clears.val() {
            self.data.d.next = self.no_data.val();
            self.corner.d.next = self.no_corner.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("vertex_transform")
    }
}

ports! {
    [] VertexTransform {
        inputs: in_valid, in_kind, in_index, in_value, in_data, out_ready;
        outputs: in_ready, out_valid, out_data, out_corner, out_view, out_outcode, out_outside, out_status;
        blocks: schedule, operands, sums, leading, newton, logarithm;
        state: running, step, ending, taking, begun, newer, older, as_is, schedule, operands, sums, leading, newton, logarithm, term, zeros, inverse, c, along, octaves, log_term, limit, mask, sides, lane_fails, grid_fails, shifted_corner, checks_corner, sent, data, corner, view, flags, status
    }
}
