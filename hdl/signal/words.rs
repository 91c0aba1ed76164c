// SPDX-License-Identifier: MIT OR Apache-2.0
//! Port values as little-endian 64-bit words, the form in which test benches and simulators exchange them.

use super::{Lanes, S, Scalar, U, WideS, WideU};
use rust_hdl_core::prelude::*;

/// A signal type that can be laid out in `WORDS` words of 64 bits, least significant first, upper bits zero.
pub trait Words: Synth {
    /// Words that the value takes.
    const WORDS: usize = Self::BITS.div_ceil(64);
    /// Writes the value to `words[..WORDS]`.
    fn put(self, words: &mut [u64]);
    /// Reads a value from `words[..WORDS]`; bits beyond the width are ignored.
    fn get(words: &[u64]) -> Self;
}

macro_rules! words {
    ($([$($generic:tt)*] $name:ty),*) => {$(
        impl<$($generic)*> Words for $name {
            #[inline(always)]
            fn put(self, words: &mut [u64]) {
                if Self::BITS <= 64 {
                    words[0] = self.low() as u64 & (u64::MAX >> (64 - Self::BITS));
                } else {
                    let value = self.wide() as u128 & (u128::MAX >> (128 - Self::BITS));
                    words[0] = value as u64;
                    words[1] = (value >> 64) as u64;
                }
            }
            #[inline(always)]
            fn get(words: &[u64]) -> Self {
                if Self::BITS <= 64 {
                    Self::from_low(words[0] as i64)
                } else {
                    Self::from_wide((u128::from(words[0]) | u128::from(words[1]) << 64) as i128)
                }
            }
        }
    )*};
}
words!([const N: usize] S<N>, [const N: usize] U<N>, [const N: usize] WideS<N>, [const N: usize] WideU<N>, [] bool);

impl<const L: usize, const W: usize> Words for Lanes<L, W> {
    #[inline(always)]
    fn put(self, words: &mut [u64]) {
        words[..Self::WORDS].fill(0);
        for (k, &lane) in self.get().iter().enumerate() {
            let (value, word, shift) = (lane as u64 & (u64::MAX >> (64 - W)), k * W / 64, k * W % 64);
            words[word] |= value << shift;
            if shift + W > 64 {
                words[word + 1] |= value >> (64 - shift);
            }
        }
    }
    #[inline(always)]
    fn get(words: &[u64]) -> Self {
        let mut lanes = [0; L];
        for (k, lane) in lanes.iter_mut().enumerate() {
            let (word, shift) = (k * W / 64, k * W % 64);
            let mut value = words[word] >> shift;
            if shift + W > 64 {
                value |= words[word + 1] << (64 - shift);
            }
            *lane = value as i64;
        }
        Lanes::new(lanes)
    }
}
