// SPDX-License-Identifier: MIT OR Apache-2.0
//! The factors of a product: from the beat, from the small memory of the vertex, and from the constants of the draw.
//!
//! | port       | format     | meaning |   Latency 2 from the schedule's word; holds while `go` is low
//! | writes     | Bit        | a constant is written: index bit 5 tells a term from a coefficient |
//! | stores     | Bit        | a result goes into the small memory |
//! | a, b       | signed 52, 33 | factors |
//! | term_read  | signed 63  | the term addressed a cycle before |

use super::{Schedule, coefficient, term};
use crate::prelude::*;

/// Operands.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Operands {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub writes: Input<Bit>,
    pub index: Input<U<6>>,
    pub value: Input<S<63>>,
    pub vertex: Input<Lanes<9, 48>>,
    /// The vertex is in view space.
    pub as_is: Input<Bit>,
    pub a_source: Input<U<2>>,
    pub a_address: Input<U<4>>,
    pub term: Input<U<4>>,
    pub b_source: Input<U<3>>,
    pub coefficient: Input<U<5>>,
    pub rotates: Input<Bit>,
    pub literal: Input<S<33>>,
    pub along: Input<U<25>>,
    pub inverse: Input<U<32>>,
    pub c: Input<U<31>>,
    pub fall: Input<S<20>>,
    pub stores: Input<Bit>,
    pub store_address: Input<U<4>>,
    pub result: Input<S<52>>,
    pub a: Output<S<52>>,
    pub b: Output<S<33>>,
    pub term_read: Output<S<63>>,
    coefficients: Ram<S<33>, 5>,
    terms: Ram<S<63>, 4>,
    work: Ram<S<52>, 4>,
    s2_lane: DataRegister<S<48>>,
    s2_a_source: DataRegister<U<2>>,
    s2_b_source: DataRegister<U<3>>,
    s2_literal: DataRegister<S<33>>,
    s3_a: DataRegister<S<52>>,
    s3_b: DataRegister<S<33>>,
    lane_01: Wire<S<48>>,
    lane_3: Wire<S<33>>,
    lane_23: Wire<S<48>>,
    lane_03: Wire<S<48>>,
    lane_45: Wire<S<33>>,
    lane_67: Wire<S<33>>,
    lane_47: Wire<S<33>>,
    lane_8: Wire<S<33>>,
    lane: Wire<S<48>>,
}

impl Default for Operands {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            writes: Input::default(),
            index: Input::default(),
            value: Input::default(),
            vertex: Input::default(),
            as_is: Input::default(),
            a_source: Input::default(),
            a_address: Input::default(),
            term: Input::default(),
            b_source: Input::default(),
            coefficient: Input::default(),
            rotates: Input::default(),
            literal: Input::default(),
            along: Input::default(),
            inverse: Input::default(),
            c: Input::default(),
            fall: Input::default(),
            stores: Input::default(),
            store_address: Input::default(),
            result: Input::default(),
            a: Output::default(),
            b: Output::default(),
            term_read: Output::default(),
            coefficients: Ram::new(coefficient::COUNT),
            terms: Ram::new(term::COUNT),
            work: Ram::new(Schedule::WORK),
            s2_lane: DataRegister::default(),
            s2_a_source: DataRegister::default(),
            s2_b_source: DataRegister::default(),
            s2_literal: DataRegister::default(),
            s3_a: DataRegister::default(),
            s3_b: DataRegister::default(),
            lane_01: Wire::default(),
            lane_3: Wire::default(),
            lane_23: Wire::default(),
            lane_03: Wire::default(),
            lane_45: Wire::default(),
            lane_67: Wire::default(),
            lane_47: Wire::default(),
            lane_8: Wire::default(),
            lane: Wire::default(),
        }
    }
}

impl Operands {
    /// Cycles from the schedule's word to the factors.
    pub const LATENCY: usize = 2;
}

impl Logic for Operands {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, coefficients, terms, work);
        dff_setup!(self, clock, s2_lane, s2_a_source, s2_b_source, s2_literal, s3_a, s3_b);
        self.a.next = self.s3_a.q.val();
        self.b.next = self.s3_b.q.val();
        self.term_read.next = self.terms.read_data.val();

        self.coefficients.enable.next = self.go.val();
        self.coefficients.read_address.next = self.coefficient.val();
        self.coefficients.write_enable.next = self.writes.val() && !self.index.val().get_bit(5);
        self.coefficients.write_address.next = self.index.val().get_bits::<5>(0);
        self.coefficients.write_data.next = bit_cast_to::<S<33>>(self.value.val());
        self.terms.enable.next = self.go.val();
        self.terms.read_address.next = self.term.val();
        self.terms.write_enable.next = self.writes.val() && self.index.val().get_bit(5);
        self.terms.write_address.next = self.index.val().get_bits::<4>(0);
        self.terms.write_data.next = self.value.val();
        self.work.enable.next = self.go.val();
        self.work.read_address.next = self.a_address.val();
        self.work.write_enable.next = self.go.val() && self.stores.val();
        self.work.write_address.next = self.store_address.val();
        self.work.write_data.next = self.result.val();

        // Three lanes of 48 bits and six of 33.
        self.lane_3.next = bit_cast_to::<S<33>>(self.vertex.val().get_bit(3));
        self.lane_8.next = bit_cast_to::<S<33>>(self.vertex.val().get_bit(8));
        self.lane_01.next = self.vertex.val().get_bit(0);
        self.lane_23.next = self.vertex.val().get_bit(2);
        self.lane_45.next = bit_cast_to::<S<33>>(self.vertex.val().get_bit(4));
        self.lane_67.next = bit_cast_to::<S<33>>(self.vertex.val().get_bit(6));
        if self.a_address.val().get_bit(0) {
            self.lane_01.next = self.vertex.val().get_bit(1);
            self.lane_23.next = bit_cast_to::<S<48>>(self.lane_3.val());
            self.lane_45.next = bit_cast_to::<S<33>>(self.vertex.val().get_bit(5));
            self.lane_67.next = bit_cast_to::<S<33>>(self.vertex.val().get_bit(7));
        }
        self.lane_03.next = self.lane_01.val();
        self.lane_47.next = self.lane_45.val();
        if self.a_address.val().get_bit(1) {
            self.lane_03.next = self.lane_23.val();
            self.lane_47.next = self.lane_67.val();
        }
        self.lane.next = self.lane_03.val();
        if self.a_address.val().get_bit(3) {
            self.lane.next = bit_cast_to::<S<48>>(self.lane_8.val());
        } else if self.a_address.val().get_bit(2) {
            self.lane.next = bit_cast_to::<S<48>>(self.lane_47.val());
        }
        if self.go.val() {
            self.s2_lane.d.next = self.lane.val();
            self.s2_a_source.d.next = self.a_source.val();
            self.s2_b_source.d.next = self.b_source.val();
            if self.rotates.val() && self.as_is.val() {
                self.s2_b_source.d.next = 0.into();
            }
            self.s2_literal.d.next = self.literal.val();
            self.s3_a.d.next = bit_cast_to::<S<52>>(self.s2_lane.q.val());
            if self.s2_a_source.q.val() == 1 {
                self.s3_a.d.next = self.work.read_data.val();
            } else if self.s2_a_source.q.val() == 2 {
                self.s3_a.d.next = bit_cast_to::<S<52>>(self.terms.read_data.val());
            } else if self.s2_a_source.q.val() == 3 {
                self.s3_a.d.next = bit_cast_to::<S<52>>(self.along.val());
            }
            self.s3_b.d.next = self.s2_literal.q.val();
            if self.s2_b_source.q.val() == 1 {
                self.s3_b.d.next = self.coefficients.read_data.val();
            } else if self.s2_b_source.q.val() == 2 {
                self.s3_b.d.next = bit_cast_to::<S<33>>(self.inverse.val());
            } else if self.s2_b_source.q.val() == 3 {
                self.s3_b.d.next = bit_cast_to::<S<33>>(self.c.val());
            } else if self.s2_b_source.q.val() == 4 {
                self.s3_b.d.next = bit_cast_to::<S<33>>(self.fall.val());
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("transform_operands")
    }
}

latches! { [] Operands: coefficients, terms, work, s2_lane, s2_a_source, s2_b_source, s2_literal, s3_a, s3_b }
