// SPDX-License-Identifier: MIT OR Apache-2.0
//! The signal types against arithmetic on `i128`: every operator wraps modulo 2^N, at every kind of width.

use proptest::prelude::*;
use relief_hdl::prelude::*;
use relief_hdl::signal::Words;

/// `value` modulo 2^bits as two's complement, by arithmetic alone.
fn signed(value: i128, bits: u32) -> i128 {
    let modulus = 1i128 << bits;
    let rest = value.rem_euclid(modulus);
    if rest >= modulus / 2 { rest - modulus } else { rest }
}

/// Extreme and random values of 64 bits, of which a type takes the low ones.
fn word() -> impl Strategy<Value = i64> {
    prop_oneof![Just(0), Just(-1), Just(1), Just(i64::MIN), Just(i64::MAX), any::<i64>(), -8i64..8]
}

macro_rules! signed_at {
    ($name:ident, $n:literal) => {
        proptest! {
            #[test]
            fn $name(a in word(), b in word(), k in 0i32..70) {
                const N: u32 = $n;
                let (x, y) = (S::<$n>::new(a), S::<$n>::new(b));
                let (p, q) = (signed(a.into(), N), signed(b.into(), N));
                prop_assert_eq!(i128::from(x.get()), p);
                prop_assert_eq!(i128::from((x + y).get()), signed(p + q, N));
                prop_assert_eq!(i128::from((x - y).get()), signed(p - q, N));
                prop_assert_eq!(i128::from((x * y).get()), signed(p.wrapping_mul(q), N));
                prop_assert_eq!(i128::from((-x).get()), signed(-p, N));
                prop_assert_eq!(i128::from((!x).get()), signed(-p - 1, N));
                prop_assert_eq!(i128::from((x & y).get()), p & q);
                prop_assert_eq!(i128::from((x | y).get()), p | q);
                prop_assert_eq!(i128::from((x ^ y).get()), p ^ q);
                prop_assert_eq!(i128::from((x >> k).get()), p >> k.min(100));
                let shifted = if k >= N as i32 { 0 } else { signed(p << k, N) };
                prop_assert_eq!(i128::from((x << k).get()), shifted);
                prop_assert_eq!(x < y, p < q);
                prop_assert_eq!(x.any(), p != 0);
                prop_assert_eq!(x.all(), p == -1);
                prop_assert_eq!(x.xor(), (p & ((1 << N) - 1)).count_ones() % 2 == 1);
                for bit in 0..$n {
                    prop_assert_eq!(x.get_bit(bit), (p >> bit) & 1 == 1);
                    let replaced = (p & !(1 << bit)) | ((q & 1) << bit);
                    prop_assert_eq!(i128::from(x.replace_bit(bit, y.get_bit(0)).get()), signed(replaced, N));
                }
                // Casts: widening keeps the value, narrowing drops the upper bits.
                prop_assert_eq!(bit_cast_to::<WideS<100>>(x).get(), p);
                prop_assert_eq!(bit_cast_to::<WideU<100>>(x).get(), p.rem_euclid(1 << 100));
                prop_assert_eq!(i128::from(bit_cast_to::<S<7>>(x).get()), signed(p, 7));
                prop_assert_eq!(i128::from(bit_cast_to::<U<7>>(x).get()), p.rem_euclid(128));
                prop_assert_eq!(bit_cast_to::<bool>(x), p & 1 == 1);
                let mut words = [u64::MAX; 2];
                x.put(&mut words);
                prop_assert_eq!(i128::from(words[0]), p.rem_euclid(1 << N));
                prop_assert_eq!(<S<$n> as Words>::get(&words), x);
            }
        }
    };
}
signed_at!(signed_1_bit, 1);
signed_at!(signed_2_bits, 2);
signed_at!(signed_17_bits, 17);
signed_at!(signed_31_bits, 31);
signed_at!(signed_46_bits, 46);
signed_at!(signed_63_bits, 63);

proptest! {
    #[test]
    fn unsigned_wraps(a in word(), b in word(), k in 0i32..70) {
        let (x, y) = (U::<13>::new(a), U::<13>::new(b));
        let (p, q) = (a.rem_euclid(8192), b.rem_euclid(8192));
        prop_assert_eq!((x + y).get(), (p + q) % 8192);
        prop_assert_eq!((x - y).get(), (p - q).rem_euclid(8192));
        prop_assert_eq!((x * y).get(), p * q % 8192);
        prop_assert_eq!((x >> k).get(), p >> k.min(60));
        prop_assert_eq!((!x).get(), 8191 - p);
        prop_assert_eq!(x < y, p < q);
        prop_assert_eq!(U::<63>::new(a).get(), a & i64::MAX);
    }

    #[test]
    fn wide_wraps_at_80_bits(a in any::<i128>(), b in any::<i128>(), k in 0i32..130) {
        let (x, y) = (WideS::<80>::new(a), WideS::<80>::new(b));
        let (p, q) = (signed(a >> 20, 80), signed(b >> 20, 80));
        let (x20, y20) = (WideS::<80>::new(a >> 20), WideS::<80>::new(b >> 20));
        prop_assert_eq!((x20 + y20).get(), signed(p + q, 80));
        prop_assert_eq!((x20 - y20).get(), signed(p - q, 80));
        prop_assert_eq!((x20 >> k).get(), p >> k.min(127));
        prop_assert_eq!((-x20).get(), signed(-p, 80));
        prop_assert_eq!(x < y, x.get() < y.get());
        prop_assert_eq!(i128::from(bit_cast_to::<S<46>>(x20).get()), signed(p, 46));
        let mut words = [0; 2];
        x20.put(&mut words);
        prop_assert_eq!(<WideS<80> as Words>::get(&words), x20);
    }

    #[test]
    fn lanes_of_13_times_46_bits_are_13_integers(a in prop::array::uniform13(word()), b in prop::array::uniform13(word()), k in 0usize..13) {
        let (x, y) = (Lanes::<13, 46>::new(a), Lanes::<13, 46>::new(b));
        let each = |f: &dyn Fn(S<46>, S<46>) -> S<46>| -> [i64; 13] { std::array::from_fn(|i| f(S::new(a[i]), S::new(b[i])).get()) };
        prop_assert_eq!(*(x + y).get(), each(&|p, q| p + q));
        prop_assert_eq!(*(x - y).get(), each(&|p, q| p - q));
        prop_assert_eq!(*(x & y).get(), each(&|p, q| p & q));
        prop_assert_eq!(*(x | y).get(), each(&|p, q| p | q));
        prop_assert_eq!(*(x ^ y).get(), each(&|p, q| p ^ q));
        prop_assert_eq!(*(-x).get(), each(&|p, _| -p));
        prop_assert_eq!(*(!x).get(), each(&|p, _| !p));
        prop_assert_eq!(*(x >> 13).get(), each(&|p, _| p >> 13));
        prop_assert_eq!(*(x << 13).get(), each(&|p, _| p << 13));
        prop_assert_eq!(x == y, x.get() == y.get());
        prop_assert_eq!(x.get_bit(k), S::new(a[k]));
        let mut replaced = *x.get();
        replaced[k] = S::<46>::new(b[k]).get();
        prop_assert_eq!(*x.replace_bit(k, S::new(b[k])).get(), replaced);
        prop_assert_eq!(*bit_cast_to::<Lanes<13, 32>>(x).get(), std::array::from_fn(|i| S::<32>::new(a[i]).get()));
        prop_assert_eq!(*bit_cast_to::<Lanes<13, 50>>(x).get(), *x.get());
        prop_assert_eq!(*bit_cast_to::<Lanes<13, 46>>(S::<7>::new(a[0])).get(), [S::<7>::new(a[0]).get(); 13]);
        let mut words = [u64::MAX; 10];
        x.put(&mut words);
        prop_assert_eq!(words[9] >> (13 * 46 - 9 * 64), 0);
        prop_assert_eq!(<Lanes<13, 46> as Words>::get(&words), x);
    }
}
