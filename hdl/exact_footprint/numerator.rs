// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numerator of a step: a difference of two products, exact, then 17 bits of it and their place.
//!
//! `N = |a' b' - a b|`, where a' and b' came the cycle before
//!
//! | port     | format     | meaning |   Latency 17 from the second factors, interval 2; holds while `go` is low
//! | a        | signed W   | D_u or D_v, then D_c; W <= 49
//! | b        | signed V   | c, then u c or v c; V <= 32
//! | mantissa | unsigned 17 | from the leading one on; lower bits are dropped; 0 if N is 0
//! | zeros, long | unsigned 6, Bit | N has 48 - zeros bits, and 32 more if it is long; 63 zeros and 0 if N is 0
//!
//! | stage           | operation                       | width |
//! | s1 .. s8        | a b, in six parts               | P = V + W bits |
//! | s9_cross        | a' b' - a b                     | signed P: two products of V + W - 2 bits |
//! | s10_size        | N                               | P - 1 bits, 80 at most |
//! | s11_long        | N >= 2^48                       | |
//! | s12_value       | N, or N / 2^32 if it is long    | 48 bits, of which 17 count in either case |
//! | s13 .. s17      | leading zeros and mantissa      | |

use crate::pipeline::{Delay, Leading, Product3x2};
use crate::prelude::*;

/// Numerator of factors of `W` and `V` bits, P = V + W <= 81.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct Numerator<const V: usize, const W: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub a: Input<S<W>>,
    pub b: Input<S<V>>,
    pub mantissa: Output<U<17>>,
    pub zeros: Output<U<6>>,
    pub long: Output<Bit>,
    s8_product: Product3x2<W, V, P>,
    s8_before: DataRegister<WideS<P>>,
    s9_cross: DataRegister<WideS<P>>,
    s10_size: DataRegister<WideU<P>>,
    s11_size: DataRegister<WideU<P>>,
    s11_long: DataRegister<Bit>,
    s12_value: DataRegister<U<48>>,
    s12_long: DataRegister<Bit>,
    s17_leading: Leading,
    s17_long: Delay<1, 5>,
    upper: Wire<WideU<P>>,
    lower: Wire<U<48>>,
}

impl<const V: usize, const W: usize, const P: usize> Numerator<V, W, P> {
    /// Cycles from the second factors to the mantissa.
    pub const LATENCY: usize = Product3x2::<W, V, P>::LATENCY + 4 + Leading::LATENCY;
}

impl<const V: usize, const W: usize, const P: usize> Logic for Numerator<V, W, P> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s8_product, s17_leading, s17_long);
        dff_setup!(self, clock, s8_before, s9_cross, s10_size, s11_size, s11_long, s12_value, s12_long);
        self.mantissa.next = self.s17_leading.mantissa.val().get_bits::<17>(15);
        self.zeros.next = self.s17_leading.zeros.val();
        self.long.next = self.s17_long.delayed.val().get_bit(0);
        self.s8_product.go.next = self.go.val();
        self.s8_product.a.next = self.a.val();
        self.s8_product.b.next = self.b.val();
        self.upper.next = self.s10_size.q.val() >> 48;
        self.lower.next = bit_cast_to::<U<48>>(self.s11_size.q.val());
        self.s17_leading.go.next = self.go.val();
        self.s17_leading.value.next = self.s12_value.q.val();
        self.s17_long.go.next = self.go.val();
        self.s17_long.value.next = bit_cast_to::<U<1>>(self.s12_long.q.val());
        if self.go.val() {
            self.s8_before.d.next = self.s8_product.p.val();
            self.s9_cross.d.next = self.s8_before.q.val() - self.s8_product.p.val();
            self.s10_size.d.next = bit_cast_to::<WideU<P>>(self.s9_cross.q.val());
            if self.s9_cross.q.val() < 0 {
                self.s10_size.d.next = bit_cast_to::<WideU<P>>(-self.s9_cross.q.val());
            }
            self.s11_size.d.next = self.s10_size.q.val();
            self.s11_long.d.next = self.upper.val().any();
            self.s12_value.d.next = self.lower.val();
            if self.s11_long.q.val() {
                self.s12_value.d.next = bit_cast_to::<U<48>>(self.s11_size.q.val() >> 32);
            }
            self.s12_long.d.next = self.s11_long.q.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("footprint_numerator_{W}x{V}_to_{P}"))
    }
}

latches! { [const V: usize, const W: usize, const P: usize] Numerator<V, W, P>: s8_product, s8_before, s9_cross, s10_size, s11_size, s11_long, s12_value, s12_long, s17_leading, s17_long }
