// SPDX-License-Identifier: MIT OR Apache-2.0
//! The normal from the slopes of a patch: against f64, at the ends of its formats, and where it is known.

use glam::DVec3;
use relief_models::gradient_normal::{Constants, Patch, differences, exact, golden};
use relief_models::rsqrt::normalize;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 * 2f64.powi(-53)
    }
}

const FLAT: Patch = Patch {
    texels: [0; 4],
    weights: [0; 2],
    level: 0,
    normal: [0, 0, -(1 << 30)],
    gradients: [[1 << 30, 0, 0], [0, 1 << 30, 0]],
};

/// An orthogonal frame times c, the gradients up to 1.0 long, and texels that make slopes from nothing to thousands.
fn draw(random: &mut Random) -> (Constants, Patch) {
    let direction = |random: &mut Random| DVec3::from_array([0; 3].map(|_| random.between(-1.0, 1.0))).normalize();
    let n = direction(random);
    let u = direction(random).cross(n).normalize();
    let v = n.cross(u);
    // n c keeps 16 bits even where it lies along the diagonal.
    let c = random.between(15.8, 31.0).exp2() - 1.0;
    let lanes = |vector: DVec3| vector.to_array().map(|x| ((x * c).round() as i64).clamp(-(1 << 31), (1 << 31) - 1));
    let (long, short) = (1.0, random.between(-4.0, 0.0).exp2());
    let any = random.bits();
    let base = any as u16;
    let spread = 1u64 << (any >> 16 & 15);
    let texels = [0; 4].map(|_| base.saturating_add((random.bits() % spread) as u16));
    let level = (any >> 24 & 15) as u32;
    let most = f64::from(texels.map(|texel| texel.abs_diff(texels[0])).into_iter().max().unwrap().max(1));
    // The steepest slope is 2^-14 to 2^13.
    let steepness = (random.between(-14.0, 13.0) + f64::from(level)).exp2() / most;
    let steepness = steepness.min(1.9) * if any >> 20 & 1 == 0 { 1.0 } else { -1.0 };
    let patch = Patch {
        texels,
        weights: [0, 32].map(|shift| (random.bits() >> shift) as u32 & 4095),
        level,
        normal: lanes(n),
        gradients: [lanes(long * u), lanes(short * v)],
    };
    (Constants::new(steepness).unwrap(), patch)
}

#[test]
fn gradient_normal_matches_f64() {
    let mut random = Random(77);
    let (mut worst, mut checked, mut steep) = (0.0f64, 0, 0);
    for _ in 0..400_000 {
        let (constants, patch) = draw(&mut random);
        let most = constants.steepness().abs() * (-f64::from(patch.level)).exp2() / 4096.0;
        let slope = differences(patch.texels, patch.weights)
            .map(|d| d.unsigned_abs() as f64 * most)
            .into_iter()
            .fold(0.0, f64::max);
        if slope >= 16_383.0 {
            continue;
        }
        let exact = DVec3::from_array(exact(&constants, &patch).unwrap());
        let n = DVec3::from_array(golden(&constants, &patch).map(f64::from)).normalize();
        worst = worst.max(n.cross(exact).length());
        assert!(n.dot(exact) > 0.9, "{constants:?} {patch:?}");
        checked += 1;
        steep += u32::from(slope > 1.0);
    }
    println!("gradient normal: {worst:.2e} rad of {checked}, {steep} steeper than 45 degrees");
    assert!(checked > 300_000 && steep > 50_000 && worst < 5.6e-5);
}

/// The patch's own derivatives: differences of its values on both sides, which are linear along an axis.
#[test]
fn gradient_normal_differentiates_the_patch() {
    let mut random = Random(3);
    for k in 0..10_000 {
        let texels =
            [0; 4].map(|_| if k < 16 { if random.bits() & 1 == 0 { 0 } else { 65535 } } else { random.bits() as u16 });
        let weights =
            [0; 2].map(|_| if k < 16 { [0, 4095][random.bits() as usize & 1] } else { random.bits() as u32 & 4095 });
        let [t00, t10, t01, t11] = texels.map(i64::from);
        let at =
            |a: i64, b: i64| t00 * (4096 - a) * (4096 - b) + t10 * a * (4096 - b) + t01 * (4096 - a) * b + t11 * a * b;
        let [a, b] = weights.map(i64::from);
        let expected = [(at(4096, b) - at(0, b)) >> 12, (at(a, 4096) - at(a, 0)) >> 12];
        assert_eq!(differences(texels, weights), expected);
        assert!(expected.iter().all(|d| d.abs() <= 65535 << 12));
    }
}

#[test]
fn gradient_normal_of_what_is_known() {
    let one = Constants::new(1.0).unwrap();
    assert_eq!(one, Constants { scale: 1 << 16, shift: 16 });
    let of = |texels| golden(&one, &Patch { texels, ..FLAT });
    let half = 46341;
    assert_eq!(of([7; 4]), [0, 0, -65536]);
    assert_eq!(of([0, 1, 0, 1]), [-half, 0, -half]);
    assert_eq!(of([1, 1, 0, 0]), [0, half, -half]);
    // The largest jump saturates at a slope of 16384: half a minute of arc from the tangent plane.
    assert_eq!(of([0, 65535, 0, 65535]), [-65536, 0, -4]);
    // The same slope four levels higher takes 16 times the difference.
    assert_eq!(golden(&one, &Patch { texels: [0, 16, 0, 16], level: 4, ..FLAT }), [-half, 0, -half]);
    // A map that goes down where its values go up.
    let minus = Constants::new(-1.0).unwrap();
    assert_eq!(golden(&minus, &Patch { texels: [0, 1, 0, 1], ..FLAT }), [half, 0, -half]);
    // No displacement: the normal of the base, whatever the texels; without one the direction to the eye.
    let none = Constants::new(0.0).unwrap();
    let tilted = [12_345_678, -87_654_321, 1 << 22];
    let texels = [0, 65535, 3, 9];
    assert_eq!(golden(&none, &Patch { texels, normal: tilted, ..FLAT }), normalize(tilted));
    assert_eq!(golden(&none, &Patch { texels, normal: [0; 3], ..FLAT }), [0, 0, -65536]);
}

/// A positive factor of all lanes changes nothing but rounding, and a patch that is turned over in u and v turns with it.
#[test]
fn gradient_normal_does_not_depend_on_c() {
    let mut random = Random(5);
    let mut worst = 0.0f64;
    for _ in 0..20_000 {
        let (constants, patch) = draw(&mut random);
        let of = |shift: u32| {
            let lanes = |lanes: [i64; 3]| lanes.map(|lane| (lane >> 12) << shift);
            let moved = Patch { normal: lanes(patch.normal), gradients: patch.gradients.map(lanes), ..patch };
            DVec3::from_array(golden(&constants, &moved).map(f64::from)).normalize()
        };
        if patch.normal.iter().all(|lane| lane.unsigned_abs() < 1 << 28) {
            continue;
        }
        worst = worst.max(of(0).cross(of(12)).length());
    }
    println!("gradient normal: {worst:.2e} rad between c and 2^-12 c");
    assert!(worst > 0.0 && worst < 1.2e-4);
}

/// The ends of every format: nothing wraps, and the result has length 1.
#[test]
fn gradient_normal_at_the_ends_of_its_formats() {
    let mut random = Random(11);
    let mut pick = |values: &[i64]| values[(random.bits() % values.len() as u64) as usize];
    let lanes = [i32::MIN.into(), i32::MAX.into(), 0, -1, 1];
    for _ in 0..50_000 {
        let constants = Constants {
            scale: pick(&[-(1 << 17), (1 << 17) - 1, 0, 1 << 16, -1]) as i32,
            shift: pick(&[16, 48, 29]) as u32,
        };
        let patch = Patch {
            texels: [0; 4].map(|_| pick(&[0, 65535, 1]) as u16),
            weights: [0; 2].map(|_| pick(&[0, 4095, 2048]) as u32),
            level: pick(&[0, 15, 3]) as u32,
            normal: [0; 3].map(|_| pick(&lanes)),
            gradients: [[0; 3]; 2].map(|gradient| gradient.map(|_| pick(&lanes))),
        };
        let n = golden(&constants, &patch).map(f64::from);
        let length = DVec3::from_array(n).length() / 65536.0;
        assert!((length - 1.0).abs() < 2e-5, "{constants:?} {patch:?}: {n:?}");
    }
}

#[test]
fn gradient_normal_constants_are_the_nearest() {
    let mut random = Random(1);
    for _ in 0..10_000 {
        let steepness = random.between(-32.0, 0.99).exp2();
        let constants = Constants::new(-steepness).unwrap();
        assert!(
            (1 << 16..1 << 17).contains(&-constants.scale) && (16..=48).contains(&constants.shift),
            "{constants:?}"
        );
        assert!((constants.steepness() / -steepness - 1.0).abs() <= 2f64.powi(-17), "{steepness}");
    }
    // One that rounds up to a power of two.
    assert_eq!(Constants::new(1.0 - 1e-9), Some(Constants { scale: 1 << 16, shift: 16 }));
    assert_eq!(Constants::new(2f64.powi(-40)), Some(Constants { scale: 1 << 8, shift: 48 }));
    assert_eq!([2.0, -2.0, f64::NAN, f64::INFINITY].map(Constants::new), [None; 4]);
}
