// SPDX-License-Identifier: MIT OR Apache-2.0
//! Error bounds of the golden reciprocal, reciprocal root and power.

use relief_models::{power, reciprocal, rsqrt};

/// Dense, with both ends of every line of a table whose index starts at bit `line`.
fn samples(from: u32, line: u32) -> impl Iterator<Item = u32> {
    let ends = (from >> line..=u32::MAX >> line).flat_map(move |i| {
        let start = i << line;
        let end = start | ((1 << line) - 1);
        (0..64).flat_map(move |k| [start + k, end - k])
    });
    ends.chain((0..).map_while(move |k: u32| from.checked_add(k.checked_mul(1009)?)))
}

#[test]
fn reciprocal_is_below_by_at_most_its_bound() {
    let (mut worst, mut checked) = (0.0f64, 0);
    for m in samples(1 << 31, 13) {
        let r = u128::from(reciprocal::golden(m));
        // Exact in integers: r m <= 2^63, and r m >= 2^63 (1 - 6e-10).
        let product = r * u128::from(m);
        assert!(product <= 1 << 63, "{m:#x} gives {r:#x}, above the true value");
        worst = worst.max(((1u128 << 63) - product) as f64 / 2f64.powi(63));
        assert!(r > 1 << 31 || m > u32::MAX - 16);
        checked += 1;
    }
    println!("reciprocal: worst relative error {worst:.3e} = 2^{:.2} of {checked}", worst.log2());
    assert!(checked > 10_000_000 && worst < 6e-10);
    assert!((reciprocal::exact(0xC000_0000) - f64::from(reciprocal::golden(0xC000_0000))).abs() < 3.0);
}

#[test]
fn reciprocal_never_rises() {
    // Every m round the ends of the seed's steps, where a fall of the seed could be made good.
    for at in (1 << 31 >> 13)..=(u32::MAX >> 13) {
        let mut before = u32::MAX;
        let first = (at << 13).max(1 << 31 | 8) - 8;
        for m in first..=first + 16 {
            let r = reciprocal::golden(m);
            assert!(r <= before, "rises at {m:#x}");
            before = r;
        }
    }
    let mut before = u32::MAX;
    for m in (0..).map_while(|k: u32| (1u32 << 31).checked_add(k.checked_mul(251)?)) {
        let r = reciprocal::golden(m);
        assert!(r <= before, "rises at {m:#x}");
        before = r;
    }
}

#[test]
fn rsqrt_is_within_its_bound() {
    let (mut worst, mut checked) = (0.0f64, 0);
    for x in samples(1 << 30, 13) {
        let y = f64::from(rsqrt::golden(x));
        worst = worst.max((y / rsqrt::exact(x) - 1.0).abs());
        checked += 1;
    }
    println!("rsqrt: worst relative error {worst:.3e} = 2^{:.2} of {checked}", worst.log2());
    assert!(checked > 10_000_000 && worst.log2() < -29.68);
}

#[test]
fn rsqrt_normalizes_within_its_angle() {
    let mut state = 7u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state as i64) >> 20
    };
    let (mut angle, mut length) = (0.0f64, 0.0f64);
    for k in 0..400_000 {
        // Common shifts down to 17 bits, ratios between the components up to everything.
        let shift = k % 27;
        let v = [random() >> shift, random() >> (shift + k / 27 % 20).min(50), random() >> shift];
        let n = rsqrt::normalize(v).map(f64::from);
        let norm = |a: [f64; 3]| a.iter().map(|x| x * x).sum::<f64>().sqrt();
        let unit = v.map(|x| x as f64 / norm(v.map(|x| x as f64)));
        if norm(v.map(|x| x as f64)) < 65536.0 {
            continue;
        }
        let cross: [f64; 3] =
            std::array::from_fn(|k| unit[(k + 1) % 3] * n[(k + 2) % 3] - unit[(k + 2) % 3] * n[(k + 1) % 3]);
        angle = angle.max(norm(cross) / norm(n));
        length = length.max((norm(n) / 65536.0 - 1.0).abs());
    }
    println!("normalize: angle {angle:.2e} rad, length {length:.2e}");
    assert!(angle < 3.3e-5 && length < 1.4e-5);
    assert_eq!(rsqrt::normalize([0; 3]), [0; 3]);
    assert_eq!(rsqrt::normalize([0, 0, -5]), [0, 0, -65536]);
    assert_eq!(rsqrt::normalize([i64::MIN, 0, 0]), [-65536, 0, 0]);
}

#[test]
fn power_is_within_its_bound() {
    let mut worst = 0.0f64;
    for n in 1..=128 {
        for x in (0..=65536).step_by(if n < 4 { 1 } else { 7 }) {
            let (got, want) = (f64::from(power::golden(x, n)), power::exact(x, n));
            worst = worst.max((got - want).abs() / 65536.0);
        }
        assert!(power::golden(65536, n).abs_diff(65536) <= 1);
    }
    println!("power: worst error {worst:.5} = {:.2} / 255", worst * 255.0);
    assert!(worst <= 0.0007);
    assert_eq!(power::golden(0x8000, 4), 0x1000);
}
