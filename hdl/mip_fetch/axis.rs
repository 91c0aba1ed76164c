// SPDX-License-Identifier: MIT OR Apache-2.0
//! One axis of a fetch: two neighbours of a coordinate, sorted by parity, and the weight of the second one.
//!
//! first = floor(x), second = first + 1, both clamped to the last sample, or one period taken off
//!
//! | port      | format   |   Latency 1, interval 1; holds while `go` is low
//! | at        | UQ13.16  | the coordinate in samples of its level; `side` samples, a period where it `repeats`
//! | load, load_at | Bit, unsigned M | a sample to be loaded instead; both neighbours are that sample
//! | even, odd | unsigned M | half the index of the even and of the odd neighbour
//! | first_odd, same | Bit | the first neighbour is the odd one; the second neighbour is the first
//! | weight    | UQ1.12   | of the second neighbour, 0 ..= 1.0   Golden: models::mip_fetch (taps)   Error 0
//! | outside   | Bit      | a load outside of the level, or a fetch beyond two periods

use crate::prelude::*;

/// Axis of a level with sides below 2^M, M <= 13.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct MipAxis<const M: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub at: Input<U<29>>,
    pub load: Input<Bit>,
    pub load_at: Input<U<M>>,
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
    last: Wire<U<14>>,
    turned: Wire<U<14>>,
    beyond: Wire<Bit>,
    first: Wire<U<14>>,
    second: Wire<U<14>>,
    fraction: Wire<U<12>>,
    even_held: DataRegister<U<M>>,
    odd_held: DataRegister<U<M>>,
    first_odd_held: DataRegister<Bit>,
    same_held: DataRegister<Bit>,
    weight_held: DataRegister<S<14>>,
    outside_held: DataRegister<Bit>,
}

impl<const M: usize> Logic for MipAxis<M> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, even_held, odd_held, first_odd_held, same_held, weight_held, outside_held);
        self.even.next = self.even_held.q.val();
        self.odd.next = self.odd_held.q.val();
        self.first_odd.next = self.first_odd_held.q.val();
        self.same.next = self.same_held.q.val();
        self.weight.next = self.weight_held.q.val();
        self.outside.next = self.outside_held.q.val();

        // 14 bits: the index has 13, and its difference to a period of 13 bits is only used where it is not negative.
        self.index.next = bit_cast_to::<U<14>>(self.at.val().get_bits::<13>(16));
        if self.load.val() {
            self.index.next = bit_cast_to::<U<14>>(self.load_at.val());
        }
        self.period.next = bit_cast_to::<U<14>>(self.side.val());
        self.last.next = self.period.val() - 1;
        self.turned.next = self.index.val() - self.period.val();
        self.beyond.next = self.index.val() >= self.period.val()
            && (self.load.val() || (self.repeats.val() && self.turned.val() >= self.period.val()));
        self.first.next = self.index.val();
        if self.index.val() >= self.period.val() {
            self.first.next = self.last.val();
            if self.repeats.val() && !self.beyond.val() {
                self.first.next = self.turned.val();
            }
        }
        self.second.next = self.first.val() + 1;
        if self.load.val() || self.beyond.val() {
            self.second.next = self.first.val();
        } else if self.first.val() == self.last.val() {
            self.second.next = self.last.val();
            if self.repeats.val() {
                self.second.next = 0.into();
            }
        }
        self.fraction.next = self.at.val().get_bits::<12>(4);

        self.even_held.enable.next = self.go.val();
        self.odd_held.enable.next = self.go.val();
        self.first_odd_held.enable.next = self.go.val();
        self.same_held.enable.next = self.go.val();
        self.weight_held.enable.next = self.go.val();
        self.outside_held.enable.next = self.go.val();
        // Indices are below 2^M, and halves of them all the more.
        self.even_held.d.next = bit_cast_to::<U<M>>(self.first.val() >> 1);
        self.odd_held.d.next = bit_cast_to::<U<M>>(self.second.val() >> 1);
        if self.first.val().get_bit(0) {
            self.even_held.d.next = bit_cast_to::<U<M>>(self.second.val() >> 1);
            self.odd_held.d.next = bit_cast_to::<U<M>>(self.first.val() >> 1);
        }
        self.first_odd_held.d.next = self.first.val().get_bit(0);
        self.same_held.d.next = self.second.val() == self.first.val();
        self.weight_held.d.next = bit_cast_to::<S<14>>(self.fraction.val());
        if self.nearest.val() {
            self.weight_held.d.next = 0.into();
            if self.fraction.val().get_bit(11) {
                self.weight_held.d.next = 4096.into();
            }
        }
        self.outside_held.d.next = self.beyond.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_axis")
    }
}

latches! { [const M: usize] MipAxis<M>: even_held, odd_held, first_odd_held, same_held, weight_held, outside_held }
