// SPDX-License-Identifier: MIT OR Apache-2.0
//! The one cast: to another width, sign or number of lanes.

use super::{Lanes, S, U, WideS, WideU};
use rust_hdl_core::prelude::*;

/// A value that is one integer: can be read as its low 64 or 128 bits, extended by its own sign.
pub trait Scalar: Synth {
    /// The value modulo 2^64, extended by its own sign.
    fn low(self) -> i64;
    /// The value, extended by its own sign.
    fn wide(self) -> i128;
    /// The value modulo 2^BITS.
    fn from_low(value: i64) -> Self;
    /// The value modulo 2^BITS.
    fn from_wide(value: i128) -> Self;
}

macro_rules! scalar {
    ($name:ident, $word:ty) => {
        impl<const N: usize> Scalar for $name<N> {
            #[inline(always)]
            fn low(self) -> i64 {
                self.get() as i64
            }
            #[inline(always)]
            fn wide(self) -> i128 {
                self.get() as i128
            }
            #[inline(always)]
            fn from_low(value: i64) -> Self {
                Self::new(value as $word)
            }
            #[inline(always)]
            fn from_wide(value: i128) -> Self {
                Self::new(value as $word)
            }
        }
    };
}
scalar!(S, i64);
scalar!(U, i64);
scalar!(WideS, i128);
scalar!(WideU, i128);

impl Scalar for bool {
    #[inline(always)]
    fn low(self) -> i64 {
        self as i64
    }
    #[inline(always)]
    fn wide(self) -> i128 {
        self as i128
    }
    #[inline(always)]
    fn from_low(value: i64) -> Self {
        value & 1 == 1
    }
    #[inline(always)]
    fn from_wide(value: i128) -> Self {
        value & 1 == 1
    }
}

/// `Self` can be cast to `T` by [`bit_cast_to`].
pub trait BitCast<T> {
    /// The cast value.
    fn bit_cast(self) -> T;
}

impl<A: Scalar, T: Scalar> BitCast<T> for A {
    #[inline(always)]
    fn bit_cast(self) -> T {
        if T::BITS <= 64 { T::from_low(self.low()) } else { T::from_wide(self.wide()) }
    }
}

impl<const L: usize, const V: usize, const W: usize> BitCast<Lanes<L, W>> for Lanes<L, V> {
    #[inline(always)]
    fn bit_cast(self) -> Lanes<L, W> {
        Lanes::new(*self.get())
    }
}

impl<A: Scalar, const L: usize, const W: usize> BitCast<Lanes<L, W>> for A {
    #[inline(always)]
    fn bit_cast(self) -> Lanes<L, W> {
        Lanes::new([self.low(); L])
    }
}

/// Casts to type `T`, by value modulo 2^width: widening extends by the sign of the *source*, narrowing drops the upper
/// bits, and then the bits are read in the format of `T`. Lanes are cast one by one; a scalar cast to lanes is
/// broadcast to all of them.
///
/// Its name begins with `bit_cast` because the kernel macro of rust-hdl tells functions apart by their first letters.
#[inline(always)]
pub fn bit_cast_to<T>(value: impl BitCast<T>) -> T {
    value.bit_cast()
}
