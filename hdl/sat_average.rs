// SPDX-License-Identifier: MIT OR Apache-2.0
//! The mean of a rectangle from its sum and its area.
//!
//! `mean = floor((256 sum + floor(area / 2)) / area)`, which is 256 sum / area rounded half up
//!
//! | port     | format     | meaning |   Latency 27, interval 27
//! | in_sum   | B bits     | of `area` texels of 16 bits   Golden: models::sat_average::golden   Error 1/2 unit of UQ16.8
//! | in_area  | unsigned R | texels, at least one
//! | out_mean | UQ16.8     | 0 ..= 65535 + 255/256
//! | error    | Bit        | sticky: no texel (0), or a mean beyond the format (its largest value)
//!
//! Example: sum 10 of 4 texels: 2.5 = 0x280.

use crate::prelude::*;
use crate::primitives::Divider;

/// Mean of sums of `B` bits, B <= 54, and areas of `R` bits; `D` = R + 2 bits of a remainder.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct SatAverage<const B: usize, const R: usize, const D: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub in_ready: Output<Bit>,
    pub in_sum: Input<U<B>>,
    pub in_area: Input<U<R>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_mean: Output<U<24>>,
    pub error: Output<Bit>,
    s1_valid: Register<Bit>,
    s1_numerator: DataRegister<U<63>>,
    s1_area: DataRegister<U<R>>,
    s2_quotient: Divider<1, 24, D>,
    s2_none: DataRegister<Bit>,
    s2_beyond: DataRegister<Bit>,
    s3_valid: Register<Bit>,
    failed: Register<Bit>,
    ready: Wire<Bit>,
    beat: Wire<Bit>,
    sum: Wire<U<63>>,
    upper: Wire<U<63>>,
    quotient: Wire<S<24>>,
    most: Constant<U<24>>,
}

impl<const B: usize, const R: usize, const D: usize> Default for SatAverage<B, R, D> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_sum: Input::default(),
            in_area: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_mean: Output::default(),
            error: Output::default(),
            s1_valid: Register::default(),
            s1_numerator: DataRegister::default(),
            s1_area: DataRegister::default(),
            s2_quotient: Divider::default(),
            s2_none: DataRegister::default(),
            s2_beyond: DataRegister::default(),
            s3_valid: Register::default(),
            failed: Register::default(),
            ready: Wire::default(),
            beat: Wire::default(),
            sum: Wire::default(),
            upper: Wire::default(),
            quotient: Wire::default(),
            most: Constant::new(U::new((1 << 24) - 1)),
        }
    }
}

impl<const B: usize, const R: usize, const D: usize> SatAverage<B, R, D> {
    /// Cycles from a sum to its mean: one for the numerator, the divider's, and the one behind its last.
    pub const LATENCY: usize = Divider::<1, 24, D>::LATENCY + 2;
}

impl<const B: usize, const R: usize, const D: usize> Logic for SatAverage<B, R, D> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s2_quotient);
        dff_setup!(self, clock, s1_valid, s1_numerator, s1_area, s2_none, s2_beyond, s3_valid, failed);
        self.ready.next =
            !self.s1_valid.q.val() && !self.s2_quotient.busy.val() && (!self.s3_valid.q.val() || self.out_ready.val());
        self.in_ready.next = self.ready.val();
        self.beat.next = self.ready.val() && self.in_valid.val();
        self.out_valid.next = self.s3_valid.q.val();
        self.error.next = self.failed.q.val();

        // s1_numerator: B + 9 bits.
        self.sum.next = bit_cast_to::<U<63>>(self.in_sum.val());
        self.s1_valid.d.next = self.beat.val();
        if self.beat.val() {
            self.s1_numerator.d.next = (self.sum.val() << 8) + bit_cast_to::<U<63>>(self.in_area.val() >> 1);
            self.s1_area.d.next = self.in_area.val();
        }

        // s2_quotient: it has 24 bits exactly if what stands above the numerator's lower 24 bits is below the area.
        self.upper.next = self.s1_numerator.q.val() >> 24;
        self.s2_quotient.start.next = self.s1_valid.q.val();
        self.s2_quotient.high.next = bit_cast_to::<Lanes<1, D>>(self.upper.val());
        self.s2_quotient.low.next = bit_cast_to::<Lanes<1, 24>>(self.s1_numerator.q.val());
        self.s2_quotient.divisor.next = bit_cast_to::<S<D>>(self.s1_area.q.val());
        if self.s1_valid.q.val() {
            self.s2_none.d.next = self.s1_area.q.val() == 0;
            self.s2_beyond.d.next = self.upper.val() >= bit_cast_to::<U<63>>(self.s1_area.q.val());
        }

        // s3: the quotient stands until the next start, which waits until it is taken.
        if self.s2_quotient.done.val() {
            self.s3_valid.d.next = true;
            if self.s2_none.q.val() || self.s2_beyond.q.val() {
                self.failed.d.next = true;
            }
        } else if self.out_ready.val() {
            self.s3_valid.d.next = false;
        }
        self.quotient.next = self.s2_quotient.quotient.val().get_bit(0);
        self.out_mean.next = bit_cast_to::<U<24>>(self.quotient.val());
        if self.s2_none.q.val() {
            self.out_mean.next = 0.into();
        } else if self.s2_beyond.q.val() {
            self.out_mean.next = self.most.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sat_average")
    }
}

ports! {
    [const B: usize, const R: usize, const D: usize] SatAverage<B, R, D> {
        inputs: in_valid, in_sum, in_area, out_ready;
        outputs: in_ready, out_valid, out_mean, error;
        blocks: s2_quotient;
        state: s1_valid, s1_numerator, s1_area, s2_quotient, s2_none, s2_beyond, s3_valid, failed
    }
}
