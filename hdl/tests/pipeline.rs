// SPDX-License-Identifier: MIT OR Apache-2.0
//! The parts of straight pipelines against integers of the machine: products, shift, leading zeros and delay, under a `go`
//! that falls now and then.

use relief_hdl::pipeline::{
    Delay, FarDelay, Leading, LongDelay, LongVectorDelay, Product2x1, Product2x2, Product3x1, Product3x2, ShiftRight,
};
use relief_hdl::prelude::*;
use std::collections::VecDeque;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// A signed value of `bits` bits, one in four at an end of a digit of 17 bits or of the format.
    fn signed(&mut self, bits: u32) -> i64 {
        let any = self.bits() as i64;
        let near = (any & 3) - 2;
        let value = match self.bits() % 16 {
            0 => i64::MIN >> (64 - bits),
            1 => i64::MAX >> (64 - bits),
            2 => (1 << 17) + near,
            3 => (1i64 << 34) + near,
            _ => any >> (any as u64 % u64::from(bits)),
        };
        (value << (64 - bits)) >> (64 - bits)
    }
}

/// Steps `$block` with values of `$draw` at the ports, and compares `$got` with `$want` of the values `LATENCY` moves ago.
macro_rules! compare {
    ($block:expr, $latency:expr, $draw:expr, $put:expr, $want:expr, $got:expr) => {{
        let (mut block, mut random, mut under_way, mut checked) = ($block, Random(3), VecDeque::new(), 0);
        block.connect_all();
        block.clock.next.reset = true;
        block.update_all();
        block.latch(true);
        block.clock.next.reset = false;
        while checked < 20_000 {
            let values = $draw(&mut random);
            block.go.next = random.bits() % 8 != 0;
            $put(&mut block, values);
            for _ in 0..4 {
                block.update_all();
            }
            if block.go.next {
                under_way.push_back(values);
                if under_way.len() > $latency {
                    let values = under_way.pop_front().unwrap();
                    assert_eq!($got(&block), $want(values), "{values:x?}");
                    checked += 1;
                }
            }
            block.latch(false);
        }
    }};
}

macro_rules! product {
    ($name:ident, $block:ty, $a:literal, $b:literal) => {
        #[test]
        fn $name() {
            compare!(
                <$block>::default(),
                <$block>::LATENCY,
                |random: &mut Random| (random.signed($a), random.signed($b)),
                |block: &mut $block, (a, b)| {
                    block.a.next = S::new(a);
                    block.b.next = S::new(b);
                },
                |(a, b)| i128::from(a) * i128::from(b),
                |block: &$block| block.p.val().get()
            );
        }
    };
}
product!(product_of_two_digits_and_one, Product2x1<35, 53>, 35, 18);
product!(product_of_two_and_two_digits, Product2x2<35, 35, 70>, 35, 35);
product!(product_of_two_and_two_short_digits, Product2x2<25, 19, 44>, 25, 19);
product!(product_of_three_digits_and_one, Product3x1<52, 70>, 52, 18);
product!(product_of_three_and_two_digits, Product3x2<52, 35, 87>, 52, 35);
product!(product_of_three_and_two_short_digits, Product3x2<39, 25, 64>, 39, 25);

#[test]
fn shift_right_is_arithmetic() {
    compare!(
        ShiftRight::<63>::default(),
        ShiftRight::<63>::LATENCY,
        |random: &mut Random| (random.signed(63), random.bits() % 64),
        |block: &mut ShiftRight<63>, (value, amount)| {
            block.value.next = WideS::new(i128::from(value));
            block.amount.next = U::new(amount as i64);
        },
        |(value, amount): (i64, u64)| i128::from(value >> amount),
        |block: &ShiftRight<63>| block.shifted.val().get()
    );
}

#[test]
fn leading_finds_every_length() {
    compare!(
        Leading::default(),
        Leading::LATENCY,
        |random: &mut Random| (random.bits() | 1 << 63) >> (16 + random.bits() % 48),
        |block: &mut Leading, value| block.value.next = U::new(value as i64),
        |value: u64| ((value << value.leading_zeros()) >> 32, value.leading_zeros() - 16),
        |block: &Leading| (block.mantissa.val().get() as u64, block.zeros.val().get() as u32)
    );
}

#[test]
fn delay_is_as_long_as_it_says() {
    macro_rules! delay {
        ($delay:ty, $n:literal) => {
            compare!(
                <$delay>::default(),
                $n,
                |random: &mut Random| random.bits() >> 24,
                |block: &mut $delay, value| block.value.next = U::new(value as i64),
                |value: u64| value,
                |block: &$delay| block.delayed.val().get() as u64
            );
        };
    }
    delay!(Delay<40, 5>, 5);
    delay!(Delay<40, 4>, 4);
    delay!(Delay<40, 17>, 17);
    delay!(LongDelay<40, 4, 5, 17>, 26);
    delay!(FarDelay<40, 4, 17>, 49);
    compare!(
        LongVectorDelay::<18, 4, 5, 17>::default(),
        26,
        |random: &mut Random| [0; 3].map(|_| random.signed(18)),
        |block: &mut LongVectorDelay<18, 4, 5, 17>, value| block.value.next = Lanes::new(value),
        |value: [i64; 3]| value,
        |block: &LongVectorDelay<18, 4, 5, 17>| *block.delayed.val().get()
    );
}
