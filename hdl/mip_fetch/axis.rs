// SPDX-License-Identifier: MIT OR Apache-2.0
//! One axis of a fetch: two neighbours of a coordinate, sorted by parity, and the weight of the second one.
//!
//! first = floor(x), second = first + 1, both clamped to the last sample, or one period taken off
//!
//! | port      | format   |   Latency 3, interval 1; holds while `go` is low
//! | at        | UQ13.16  | the coordinate in samples of its level; `side` samples, a period where it `repeats`
//! | load      | Bit      | a sample to be loaded stands at `at`: both neighbours are that sample
//! | even, odd | unsigned M | half the index of the even and of the odd neighbour
//! | first_odd, same | Bit | the first neighbour is the odd one; the second neighbour is the first
//! | weight    | UQ1.12   | of the second neighbour, 0 ..= 1.0   Golden: models::mip_fetch (taps)   Error 0
//! | outside   | Bit      | a load outside of the level, or a fetch beyond two periods
//!
//! | stage      | what it does                            | why it cannot overflow
//! | s1_compare | index - side, index against one and two sides | 14 bits: an index has 13, and the difference is
//! only used where it is not negative
//! | s2_first   | the first neighbour; whether the second is the same, or sample 0 |
//! | s3_sort    | halves by parity                        | below 2^(M-1)
//!
//! Neighbours i and i + 1 with an even i have the same half; with an odd i the even one is a half further, or sample 0, as
//! a period is even.

use crate::prelude::*;

/// Axis of a level with sides below 2^M, M <= 13.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct MipAxis<const M: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub at: Input<U<29>>,
    pub load: Input<Bit>,
    pub nearest: Input<Bit>,
    pub side: Input<U<M>>,
    pub repeats: Input<Bit>,
    pub even: Output<U<M>>,
    pub odd: Output<U<M>>,
    pub first_odd: Output<Bit>,
    pub same: Output<Bit>,
    pub weight: Output<S<14>>,
    pub outside: Output<Bit>,
    index: Wire<U<14>>,
    period: Wire<U<14>>,
    s1_index: DataRegister<U<14>>,
    s1_turned: DataRegister<U<14>>,
    s1_last: DataRegister<U<14>>,
    s1_over: DataRegister<Bit>,
    s1_over_twice: DataRegister<Bit>,
    s1_load: DataRegister<Bit>,
    s1_repeats: DataRegister<Bit>,
    s1_fraction: DataRegister<U<12>>,
    s1_nearest: DataRegister<Bit>,
    beyond: Wire<Bit>,
    ends: Wire<Bit>,
    s2_first: DataRegister<U<14>>,
    s2_stays: DataRegister<Bit>,
    s2_turns: DataRegister<Bit>,
    s2_weight: DataRegister<S<14>>,
    s2_outside: DataRegister<Bit>,
    half: Wire<U<M>>,
    s3_even: DataRegister<U<M>>,
    s3_odd: DataRegister<U<M>>,
    s3_first_odd: DataRegister<Bit>,
    s3_same: DataRegister<Bit>,
    s3_weight: DataRegister<S<14>>,
    s3_outside: DataRegister<Bit>,
}

impl<const M: usize> Logic for MipAxis<M> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_index, s1_turned, s1_last, s1_over, s1_over_twice, s1_load, s1_repeats, s1_fraction);
        dff_setup!(self, clock, s1_nearest, s2_first, s2_stays, s2_turns, s2_weight, s2_outside);
        dff_setup!(self, clock, s3_even, s3_odd, s3_first_odd, s3_same, s3_weight, s3_outside);
        self.even.next = self.s3_even.q.val();
        self.odd.next = self.s3_odd.q.val();
        self.first_odd.next = self.s3_first_odd.q.val();
        self.same.next = self.s3_same.q.val();
        self.weight.next = self.s3_weight.q.val();
        self.outside.next = self.s3_outside.q.val();

        self.index.next = bit_cast_to::<U<14>>(self.at.val().get_bits::<13>(16));
        self.period.next = bit_cast_to::<U<14>>(self.side.val());
        // What is beyond two periods, or no sample at all, and whether the first neighbour is the last sample.
        self.beyond.next =
            self.s1_over.q.val() && (self.s1_load.q.val() || (self.s1_repeats.q.val() && self.s1_over_twice.q.val()));
        self.ends.next = self.s1_index.q.val() == self.s1_last.q.val();
        if self.s1_over.q.val() {
            self.ends.next = !self.s1_repeats.q.val() || self.s1_turned.q.val() == self.s1_last.q.val();
        }
        self.half.next = bit_cast_to::<U<M>>(self.s2_first.q.val() >> 1);
        if self.go.val() {
            // s1_compare
            self.s1_index.d.next = self.index.val();
            self.s1_turned.d.next = self.index.val() - self.period.val();
            self.s1_last.d.next = self.period.val() - 1;
            self.s1_over.d.next = self.index.val() >= self.period.val();
            self.s1_over_twice.d.next = self.index.val() >= self.period.val() << 1;
            self.s1_load.d.next = self.load.val();
            self.s1_repeats.d.next = self.repeats.val();
            self.s1_fraction.d.next = self.at.val().get_bits::<12>(4);
            self.s1_nearest.d.next = self.nearest.val();
            // s2_first
            self.s2_first.d.next = self.s1_index.q.val();
            if self.s1_over.q.val() {
                self.s2_first.d.next = self.s1_last.q.val();
                if self.s1_repeats.q.val() && !self.beyond.val() {
                    self.s2_first.d.next = self.s1_turned.q.val();
                }
            }
            self.s2_stays.d.next =
                self.s1_load.q.val() || self.beyond.val() || (self.ends.val() && !self.s1_repeats.q.val());
            self.s2_turns.d.next = self.ends.val();
            self.s2_outside.d.next = self.beyond.val();
            self.s2_weight.d.next = bit_cast_to::<S<14>>(self.s1_fraction.q.val());
            if self.s1_nearest.q.val() {
                self.s2_weight.d.next = 0.into();
                if self.s1_fraction.q.val().get_bit(11) {
                    self.s2_weight.d.next = 4096.into();
                }
            }
            // s3_sort
            self.s3_even.d.next = self.half.val();
            if self.s2_first.q.val().get_bit(0) && !self.s2_stays.q.val() {
                self.s3_even.d.next = self.half.val() + 1;
                if self.s2_turns.q.val() {
                    self.s3_even.d.next = 0.into();
                }
            }
            self.s3_odd.d.next = self.half.val();
            self.s3_first_odd.d.next = self.s2_first.q.val().get_bit(0);
            self.s3_same.d.next = self.s2_stays.q.val();
            self.s3_weight.d.next = self.s2_weight.q.val();
            self.s3_outside.d.next = self.s2_outside.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_axis")
    }
}

latches! { [const M: usize] MipAxis<M>: s1_index, s1_turned, s1_last, s1_over, s1_over_twice, s1_load, s1_repeats, s1_fraction, s1_nearest, s2_first, s2_stays, s2_turns, s2_weight, s2_outside, s3_even, s3_odd, s3_first_odd, s3_same, s3_weight, s3_outside }
