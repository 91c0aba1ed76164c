// SPDX-License-Identifier: MIT OR Apache-2.0
//! Properties of the golden vertex adder.

use proptest::prelude::*;
use relief_models::step::Vertex;
use relief_models::vertex_adder::{exact, golden};

#[test]
fn vertex_adder_example_of_the_documentation() {
    let sum = golden(&[0x0010_0000; 16], &[0x0000_8000; 16], 32, 16);
    assert_eq!(sum, [0x0010_8000; 16]);
    // SQ12.19: 2.0 + 0.0625.
    let real = exact(&[2.0; 16], &[0.0625; 16]);
    assert_eq!(real[0] * f64::from(1 << 19), sum[0] as f64);
}

#[test]
fn vertex_adder_wraps_at_both_ends_of_every_width() {
    for bits in 1..=64 {
        let low = i64::MIN >> (64 - bits);
        let high = !low;
        assert_eq!(golden(&[low; 16], &[-1; 16], bits, 1)[0], high, "{bits} bits");
        assert_eq!(golden(&[high; 16], &[low; 16], bits, 1)[0], -1, "{bits} bits");
        assert_eq!(golden(&[low; 16], &[low; 16], bits, 1)[0], 0, "{bits} bits");
    }
}

/// Values of `bits` bits, the ends of the range as often as all others.
fn any_vertex(bits: u32) -> impl Strategy<Value = Vertex> {
    let low = i64::MIN >> (64 - bits);
    prop::array::uniform16(prop_oneof![Just(low), Just(!low), low..=!low])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5_000, ..ProptestConfig::default() })]

    /// Up to 52 bits, where f64 holds every sum: right if the true value fits, else off by 2^bits.
    #[test]
    fn vertex_adder_matches_exact(
        (bits, vertex, difference) in (1..=52u32).prop_flat_map(|bits| (Just(bits), any_vertex(bits), any_vertex(bits))),
        components in 0..=16usize,
    ) {
        let sum = golden(&vertex, &difference, bits, components);
        let real = exact(&vertex.map(|x| x as f64), &difference.map(|x| x as f64));
        let range = f64::from(bits as i32).exp2();
        for c in 0..components {
            let fits = (-range / 2.0..range / 2.0).contains(&real[c]);
            let expected = if fits { real[c] } else { real[c] - range.copysign(real[c]) };
            prop_assert_eq!(sum[c] as f64, expected);
        }
        prop_assert!(sum[components..].iter().all(|&x| x == 0));
    }
}
