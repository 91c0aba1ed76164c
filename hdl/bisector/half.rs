// SPDX-License-Identifier: MIT OR Apache-2.0
//! One half of a triangle. Combinational.
//!
//! d' = d + turn, level' = level - 1 when d is even, m' = m - 2^level' dir(d'); address = (v << K) + v + u of the
//! lattice vertex
//!
//! | port       | format         |   Golden: models::bisector (Node::halves, Lattice::is_dead)   Error 0
//! | u, v       | unsigned H     | midpoint in half steps; the half's is in the lattice, too
//! | level, direction | unsigned 4, 3 | level at least 1   Example: (4, 4), level 2, direction 7, turn 5: (4, 0), 2, 4
//! | turn       | unsigned 3     | 5 for the half at a, 3 for the half at b
//! | rim_u, rim_v | unsigned H   | last column and row of the map, in half steps
//! | address    | unsigned A     | of the half's midpoint
//! | dead       | Bit            | the half has no area in the map

use crate::prelude::*;

/// Half for lattices of up to 2^K steps, H = K + 2, A = 2 K + 1.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorHalf<const H: usize, const A: usize> {
    pub u: Input<U<H>>,
    pub v: Input<U<H>>,
    pub level: Input<U<4>>,
    pub direction: Input<U<3>>,
    pub turn: Input<U<3>>,
    pub rim_u: Input<U<H>>,
    pub rim_v: Input<U<H>>,
    pub half_u: Output<U<H>>,
    pub half_v: Output<U<H>>,
    pub half_level: Output<U<4>>,
    pub half_direction: Output<U<3>>,
    pub address: Output<U<A>>,
    pub dead: Output<Bit>,
    pitch: Constant<U<4>>,
    to: Wire<U<3>>,
    low: Wire<U<4>>,
    one: Wire<U<H>>,
    step: Wire<U<H>>,
    to_u: Wire<U<H>>,
    to_v: Wire<U<H>>,
    limit_u: Wire<U<H>>,
    limit_v: Wire<U<H>>,
    column: Wire<U<A>>,
    row: Wire<U<A>>,
}

impl<const H: usize, const A: usize> Default for BisectorHalf<H, A> {
    fn default() -> Self {
        Self {
            u: Input::default(),
            v: Input::default(),
            level: Input::default(),
            direction: Input::default(),
            turn: Input::default(),
            rim_u: Input::default(),
            rim_v: Input::default(),
            half_u: Output::default(),
            half_v: Output::default(),
            half_level: Output::default(),
            half_direction: Output::default(),
            address: Output::default(),
            dead: Output::default(),
            pitch: Constant::new(U::new(H as i64 - 2)),
            to: Wire::default(),
            low: Wire::default(),
            one: Wire::default(),
            step: Wire::default(),
            to_u: Wire::default(),
            to_v: Wire::default(),
            limit_u: Wire::default(),
            limit_v: Wire::default(),
            column: Wire::default(),
            row: Wire::default(),
        }
    }
}

impl<const H: usize, const A: usize> Logic for BisectorHalf<H, A> {
    #[hdl_gen]
    fn update(&mut self) {
        self.to.next = self.direction.val() + self.turn.val();
        self.low.next = self.level.val();
        if !self.direction.val().get_bit(0) {
            self.low.next = self.level.val() - 1;
        }
        self.one.next = 1.into();
        self.step.next = self.one.val() << self.low.val();
        // Against the half's direction. The midpoint stays in the lattice, 0 ..= 2^(K + 1).
        self.to_u.next = self.u.val();
        if self.to.val() == 7 || self.to.val() <= 1 {
            self.to_u.next = self.u.val() - self.step.val();
        } else if self.to.val() >= 3 && self.to.val() <= 5 {
            self.to_u.next = self.u.val() + self.step.val();
        }
        self.to_v.next = self.v.val();
        if self.to.val() >= 1 && self.to.val() <= 3 {
            self.to_v.next = self.v.val() - self.step.val();
        } else if self.to.val() >= 5 {
            self.to_v.next = self.v.val() + self.step.val();
        }
        // The lowest corner is a step below the midpoint, but on an axis that the triangle lies at one side of. Rim and
        // step are at most 2^(K + 1) and 2^K, so their sum fits H = K + 2 bits.
        self.limit_u.next = self.rim_u.val();
        if self.to.val() != 0 {
            self.limit_u.next = self.rim_u.val() + self.step.val();
        }
        self.limit_v.next = self.rim_v.val();
        if self.to.val() != 2 {
            self.limit_v.next = self.rim_v.val() + self.step.val();
        }
        self.dead.next = self.to_u.val() >= self.limit_u.val() || self.to_v.val() >= self.limit_v.val();
        // A row has 2^K + 1 vertices. The last address is (2^K + 1)^2 - 1 < 2^A.
        self.column.next = bit_cast_to::<U<A>>(self.to_u.val() >> 1);
        self.row.next = bit_cast_to::<U<A>>(self.to_v.val() >> 1);
        self.address.next = (self.row.val() << self.pitch.val()) + self.row.val() + self.column.val();
        self.half_u.next = self.to_u.val();
        self.half_v.next = self.to_v.val();
        self.half_level.next = self.low.val();
        self.half_direction.next = self.to.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("bisector_half")
    }
}

latches! { [const H: usize, const A: usize] BisectorHalf<H, A>: }
