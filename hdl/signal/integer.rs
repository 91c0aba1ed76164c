// SPDX-License-Identifier: MIT OR Apache-2.0
//! Integers of a fixed width that wrap: `S`/`U` up to 63 bits in one machine word, `WideS`/`WideU` up to 127 in two.

use rust_hdl_core::prelude::*;
use std::ops::{Add, BitAnd, BitOr, BitXor, Mul, Neg, Not, Shl, Shr, Sub};

use super::{SIGNED_FLAG, vcd_vector};

macro_rules! integer {
    ($name:ident, $word:ty, $limit:expr, $signed:expr, $doc:expr) => {
        #[doc = $doc]
        ///
        /// Arithmetic wraps modulo 2^N, as the emitted hardware does. Operands of one operation have the same type;
        /// a change of width or sign is written out with [`bit_cast_to`](super::bit_cast_to). Integer literals
        /// (`i32`) may stand on the right.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Hash)]
        pub struct $name<const N: usize>($word);

        impl<const N: usize> $name<N> {
            const SHIFT: u32 = {
                assert!(N >= 1 && N <= $limit, "width out of range for this integer type");
                <$word>::BITS - N as u32
            };
            /// Smallest value of the format.
            pub const MIN: Self = Self::new(if $signed { <$word>::MIN >> Self::SHIFT } else { 0 });
            /// Largest value of the format.
            pub const MAX: Self =
                Self::new(if $signed { <$word>::MAX >> Self::SHIFT } else { ((1 as $word) << (N - 1)) - 1 + ((1 as $word) << (N - 1)) });

            /// The value modulo 2^N.
            #[inline(always)]
            pub const fn new(value: $word) -> Self {
                if $signed {
                    Self((value << Self::SHIFT) >> Self::SHIFT)
                } else {
                    Self(value & (((1 as $word) << (N - 1)) - 1 + ((1 as $word) << (N - 1))))
                }
            }
            /// The value as a machine word.
            #[inline(always)]
            pub const fn get(self) -> $word {
                self.0
            }
            /// Bit `index`, 0 being the least significant.
            #[inline(always)]
            pub fn get_bit(self, index: usize) -> bool {
                assert!(index < N, "bit {index} of a {N}-bit value");
                (self.0 >> index) & 1 == 1
            }
            /// Bits `offset .. offset + M`, unsigned.
            #[inline(always)]
            pub fn get_bits<const M: usize>(self, offset: usize) -> U<M> {
                assert!(offset + M <= N, "bits {offset}+{M} of a {N}-bit value");
                U::new((self.0 >> offset) as i64)
            }
            /// The value with bit `index` replaced.
            #[inline(always)]
            pub fn replace_bit(self, index: usize, bit: bool) -> Self {
                assert!(index < N, "bit {index} of a {N}-bit value");
                let mask = (1 as $word) << index;
                Self::new(if bit { self.0 | mask } else { self.0 & !mask })
            }
            /// Whether any bit is set.
            #[inline(always)]
            pub fn any(self) -> bool {
                self.0 != 0
            }
            /// Whether all N bits are set.
            #[inline(always)]
            pub fn all(self) -> bool {
                Self::new(!self.0) == Self(0)
            }
            /// Parity of the N bits.
            #[inline(always)]
            pub fn xor(self) -> bool {
                (self.0 << Self::SHIFT).count_ones() % 2 == 1
            }
            /// The value as an index (negative values give a huge one, which no array holds).
            #[inline(always)]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl<const N: usize> std::fmt::Debug for $name<N> {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, "{}", self.0)
            }
        }

        impl<const N: usize> From<i32> for $name<N> {
            #[inline(always)]
            fn from(value: i32) -> Self {
                Self::new(value as $word)
            }
        }

        impl<const N: usize> Synth for $name<N> {
            const BITS: usize = N;
            fn descriptor() -> TypeDescriptor {
                let kind = if $signed { TypeKind::Signed(N) } else { TypeKind::Bits(N) };
                TypeDescriptor { name: format!("{}<{N}>", stringify!($name)), kind }
            }
            fn vcd(self) -> VCDValue {
                vcd_vector(self.0 as i128, N)
            }
            fn verilog(self) -> VerilogLiteral {
                (self.0 as u128 & (u128::MAX >> (128 - N))).into()
            }
            fn bits(self) -> usize {
                if $signed { N | SIGNED_FLAG } else { N }
            }
        }

        integer!(@binary $name, $word, Add, add, wrapping_add);
        integer!(@binary $name, $word, Sub, sub, wrapping_sub);
        integer!(@binary $name, $word, Mul, mul, wrapping_mul);
        integer!(@binary $name, $word, BitAnd, bitand, bitand);
        integer!(@binary $name, $word, BitOr, bitor, bitor);
        integer!(@binary $name, $word, BitXor, bitxor, bitxor);

        impl<const N: usize> Not for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self::new(!self.0)
            }
        }
        impl<const N: usize> Neg for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self::new((0 as $word).wrapping_sub(self.0))
            }
        }
        impl<const N: usize> Shl<i32> for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn shl(self, k: i32) -> Self {
                if k as usize >= N { Self(0) } else { Self::new(self.0 << k) }
            }
        }
        impl<const N: usize> Shr<i32> for $name<N> {
            type Output = Self;
            /// Arithmetic for signed formats, logical for unsigned ones.
            #[inline(always)]
            fn shr(self, k: i32) -> Self {
                Self::new(self.0 >> (k as u32).min(<$word>::BITS - 1))
            }
        }
        impl<const N: usize, const K: usize> Shl<U<K>> for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn shl(self, k: U<K>) -> Self {
                self << k.get().min(1000) as i32
            }
        }
        impl<const N: usize, const K: usize> Shr<U<K>> for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn shr(self, k: U<K>) -> Self {
                self >> k.get().min(1000) as i32
            }
        }
        impl<const N: usize> PartialEq<i32> for $name<N> {
            #[inline(always)]
            fn eq(&self, other: &i32) -> bool {
                self.0 == Self::from(*other).0
            }
        }
        impl<const N: usize> PartialOrd<i32> for $name<N> {
            #[inline(always)]
            fn partial_cmp(&self, other: &i32) -> Option<std::cmp::Ordering> {
                self.0.partial_cmp(&Self::from(*other).0)
            }
        }
    };
    (@binary $name:ident, $word:ty, $trait:ident, $method:ident, $call:ident) => {
        impl<const N: usize> $trait for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self::new(self.0.$call(other.0))
            }
        }
        impl<const N: usize> $trait<i32> for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: i32) -> Self {
                Self::new(self.0.$call(Self::from(other).0))
            }
        }
    };
}

integer!(S, i64, 63, true, "Signed integer of N bits, two's complement, `1 <= N <= 63`.");
integer!(U, i64, 63, false, "Unsigned integer of N bits, `1 <= N <= 63`.");
integer!(
    WideS,
    i128,
    127,
    true,
    "Signed integer of N bits, two's complement, `1 <= N <= 127`: for what does not fit [`S`]."
);
integer!(WideU, i128, 127, false, "Unsigned integer of N bits, `1 <= N <= 127`: for what does not fit [`U`].");
