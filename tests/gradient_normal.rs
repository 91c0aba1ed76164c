// SPDX-License-Identifier: MIT OR Apache-2.0
//! The gradient normal in hardware: against its golden model, its latency, interval and reset, and where it is known.

use relief_hdl::gradient_normal::GradientNormal;
use relief_hdl::widths::small;
use relief_models::gradient_normal::{Constants, Patch};
use relief_models::rsqrt::normalize;
use relief_testbench::binding::{Beat, Binding, unpack};
use relief_testbench::gradient_normal::{GradientNormalBinding, beat};
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

const ONE: Constants = Constants { scale: 1 << 16, shift: 16 };

const FLAT: Patch = Patch {
    texels: [9; 4],
    weights: [1000, 3000],
    level: 0,
    normal: [0, 0, -(1 << 30)],
    gradients: [[1 << 30, 0, 0], [0, 1 << 30, 0]],
};

fn normals(beats: Vec<Beat>) -> Vec<[i32; 3]> {
    let beats = Box::new(beats.into_iter());
    let mut scoreboard = Scoreboard::new(&GradientNormalBinding, &small::SET, beats, Pattern::NONE);
    let [valid, normal] = ["out_valid", "out_normal"].map(|name| scoreboard.layout().output(name));
    let mut normals = Vec::new();
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            let lanes = || unpack(&outputs[normal..], 3, 18);
            normals.extend((outputs[valid] == 1).then(|| std::array::from_fn(|k| lanes()[k] as i32)));
            Ok(())
        })
        .unwrap();
    normals
}

#[test]
fn gradient_normal_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&GradientNormalBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn gradient_normal_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&GradientNormalBinding, GradientNormal::LATENCY);
}

#[test]
fn gradient_normal_reset_drops_what_is_on_its_way() {
    common::reset_empties(&GradientNormalBinding, GradientNormal::LATENCY);
}

/// Level patches leave the normal; a slope of 1 leans it by 45 degrees; without any direction it is the eye's.
#[test]
fn gradient_normal_of_what_is_known() {
    let tilted = [1 << 20, -(1 << 29), 12_345];
    let half = 46341;
    let known = [
        (ONE, FLAT, [0, 0, -65536]),
        (ONE, Patch { normal: tilted, ..FLAT }, normalize(tilted)),
        (Constants { scale: 0, ..ONE }, Patch { texels: [1, 2, 3, 65535], normal: tilted, ..FLAT }, normalize(tilted)),
        (ONE, Patch { texels: [0, 1, 0, 1], ..FLAT }, [-half, 0, -half]),
        (ONE, Patch { texels: [0, 0, 8, 8], level: 3, ..FLAT }, [0, -half, -half]),
        (Constants { scale: -(1 << 16), ..ONE }, Patch { texels: [0, 1, 0, 1], ..FLAT }, [half, 0, -half]),
        // Saturated either way: four units of 2^-16 from the tangent.
        (ONE, Patch { texels: [0, 65535, 0, 65535], ..FLAT }, [-65536, 0, -4]),
        (ONE, Patch { texels: [65535, 0, 65535, 0], ..FLAT }, [65536, 0, -4]),
        (ONE, Patch { normal: [0; 3], ..FLAT }, [0, 0, -65536]),
    ];
    let beats = known.iter().map(|(constants, patch, _)| beat(constants, patch)).collect();
    assert_eq!(normals(beats), known.map(|(.., normal)| normal));
}

/// The slope is the one between the texels where the weights say: at the ends of both rows and columns, and between.
#[test]
fn gradient_normal_interpolates_its_slopes() {
    let texels = [0, 1 << 12, 0, 3 << 12];
    let flat = Constants { scale: 1 << 16, shift: 28 };
    let of = |weights| beat(&flat, &Patch { texels, weights, ..FLAT });
    let found = normals([[0, 0], [0, 2048], [2048, 0], [4095, 4095]].map(of).to_vec());
    let tangents = found.iter().map(|n| [0, 1].map(|k| f64::from(n[k]) / f64::from(n[2])));
    for (tangent, expected) in tangents.zip([[1.0, 0.0], [2.0, 0.0], [1.0, 1.0], [3.0, 2.0]]) {
        assert!((0..2).all(|k| (tangent[k] - expected[k]).abs() < 2e-3), "{tangent:?} {expected:?}");
    }
}

/// Every level of steepness comes, saturated slopes and normals without direction among them.
#[test]
fn gradient_normal_is_tested_at_every_steepness() {
    let found = normals(GradientNormalBinding.random(&small::SET, 4).take(5_000).collect());
    let count = |test: &dyn Fn(&[i32; 3]) -> bool| found.iter().filter(|n| test(n)).count();
    assert_eq!(found.len(), 5_000);
    assert!(count(&|n| *n == [0, 0, -65536]) > 20);
    assert!(count(&|n| n.iter().filter(|lane| lane.abs() > 10_000).count() == 3) > 200);
}

#[test]
fn gradient_normal_refuses_what_no_draw_has() {
    let parse = |numbers: &[i64]| GradientNormalBinding.parse(&small::SET, numbers);
    let good = [1, 2, 3, 4, 5, 6, 7, -8, 9, 10, 11, 12, -13, 14, 15, 16, -17, 18];
    let patch = Patch {
        texels: [1, 2, 3, 4],
        weights: [5, 6],
        level: 7,
        normal: [-8, 9, 10],
        gradients: [[11, 12, -13], [14, 15, 16]],
    };
    assert_eq!(parse(&good), Ok(beat(&Constants { scale: -17, shift: 18 }, &patch)));
    let with = |at: usize, number: i64| {
        let mut numbers = good;
        numbers[at] = number;
        parse(&numbers).unwrap_err()
    };
    assert_eq!(with(0, 65536), "number 1 is 65536, not in 0..=65535");
    assert_eq!(with(5, -1), "number 6 is -1, not in 0..=4095");
    assert_eq!(with(16, 1 << 17), "number 17 is 131072, not in -131072..=131071");
    assert_eq!(with(17, 15), "number 18 is 15, not in 16..=48");
}
