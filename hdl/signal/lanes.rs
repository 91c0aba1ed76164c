// SPDX-License-Identifier: MIT OR Apache-2.0
//! A packed vertex: L signed components of W bits each, one signal.

use rust_hdl_core::prelude::*;
use std::ops::{Add, BitAnd, BitOr, BitXor, Neg, Not, Shl, Shr, Sub};

use super::{LANES_SHIFT, S, SIGNED_FLAG, U};

/// `L` lanes of `W`-bit two's complement, `1 <= W <= 63`; lane 0 stands in the least significant bits.
///
/// Operators work lane by lane and wrap modulo 2^W. `get_bit(k)` reads lane `k` and `replace_bit(k, v)` writes it: the
/// kernel macro knows these method names only.
#[derive(Clone, Copy, Eq)]
pub struct Lanes<const L: usize, const W: usize>([i64; L]);

impl<const L: usize, const W: usize> Lanes<L, W> {
    /// Packs `L` values, each modulo 2^W.
    #[inline(always)]
    pub fn new(values: [i64; L]) -> Self {
        Self(values.map(|v| S::<W>::new(v).get()))
    }
    /// The lanes, sign-extended.
    #[inline(always)]
    pub const fn get(&self) -> &[i64; L] {
        &self.0
    }
    /// Lane `k`.
    #[inline(always)]
    pub fn get_bit(self, k: usize) -> S<W> {
        S::new(self.0[k])
    }
    /// The lanes with lane `k` replaced.
    #[inline(always)]
    pub fn replace_bit(mut self, k: usize, value: S<W>) -> Self {
        self.0[k] = value.get();
        self
    }
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(i64, i64) -> i64) -> Self {
        Self(std::array::from_fn(|k| S::<W>::new(f(self.0[k], other.0[k])).get()))
    }
}

impl<const L: usize, const W: usize> PartialEq for Lanes<L, W> {
    /// Without an early exit, so that it compiles to a few vector instructions instead of a call.
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).fold(0, |difference, (a, b)| difference | (a ^ b)) == 0
    }
}

impl<const L: usize, const W: usize> Default for Lanes<L, W> {
    fn default() -> Self {
        Self([0; L])
    }
}

impl<const L: usize, const W: usize> std::fmt::Debug for Lanes<L, W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.0).finish()
    }
}

impl<const L: usize, const W: usize> Synth for Lanes<L, W> {
    const BITS: usize = L * W;
    fn descriptor() -> TypeDescriptor {
        let lane = |k: usize| Box::new(TypeField { fieldname: format!("{k}"), kind: S::<W>::descriptor() });
        TypeDescriptor { name: format!("Lanes<{L}, {W}>"), kind: TypeKind::Composite((0..L).map(lane).collect()) }
    }
    fn vcd(self) -> VCDValue {
        VCDValue::Composite(self.0.iter().map(|&v| Box::new(S::<W>::new(v).vcd())).collect())
    }
    /// Zero: a literal of more than 128 bits cannot be built; the back-end reads constants through [`Synth::vcd`].
    fn verilog(self) -> VerilogLiteral {
        0u128.into()
    }
    fn bits(self) -> usize {
        W | SIGNED_FLAG | (L << LANES_SHIFT)
    }
}

macro_rules! lane_operator {
    ($trait:ident, $method:ident, $f:expr) => {
        impl<const L: usize, const W: usize> $trait for Lanes<L, W> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, $f)
            }
        }
    };
}
lane_operator!(Add, add, i64::wrapping_add);
lane_operator!(Sub, sub, i64::wrapping_sub);
lane_operator!(BitAnd, bitand, |a, b| a & b);
lane_operator!(BitOr, bitor, |a, b| a | b);
lane_operator!(BitXor, bitxor, |a, b| a ^ b);

impl<const L: usize, const W: usize> Not for Lanes<L, W> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        self.zip(self, |a, _| !a)
    }
}
impl<const L: usize, const W: usize> Neg for Lanes<L, W> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.zip(self, |a, _| a.wrapping_neg())
    }
}
impl<const L: usize, const W: usize> Shl<i32> for Lanes<L, W> {
    type Output = Self;
    #[inline(always)]
    fn shl(self, k: i32) -> Self {
        self.zip(self, |a, _| (S::<W>::new(a) << k).get())
    }
}
impl<const L: usize, const W: usize> Shr<i32> for Lanes<L, W> {
    type Output = Self;
    #[inline(always)]
    fn shr(self, k: i32) -> Self {
        self.zip(self, |a, _| (S::<W>::new(a) >> k).get())
    }
}
impl<const L: usize, const W: usize, const K: usize> Shl<U<K>> for Lanes<L, W> {
    type Output = Self;
    #[inline(always)]
    fn shl(self, k: U<K>) -> Self {
        self << k.get().min(1000) as i32
    }
}
impl<const L: usize, const W: usize, const K: usize> Shr<U<K>> for Lanes<L, W> {
    type Output = Self;
    #[inline(always)]
    fn shr(self, k: U<K>) -> Self {
        self >> k.get().min(1000) as i32
    }
}
