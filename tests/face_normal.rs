// SPDX-License-Identifier: MIT OR Apache-2.0
//! The face normal in hardware: against its golden model, its latency, interval and reset; and the shortening of long vectors.

use relief_hdl::face_normal::FaceNormal;
use relief_hdl::prelude::{Block, Latch};
use relief_hdl::rsqrt::{Shorten, UnitVector};
use relief_hdl::signal::{S, WideS};
use relief_hdl::widths::small;
use relief_models::face_normal::Pixel;
use relief_models::rsqrt::normalize_wide;
use relief_testbench::binding::{Binding, Random, unpack};
use relief_testbench::face_normal::{FaceNormalBinding, beat};
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use std::collections::VecDeque;

mod common;

#[test]
fn face_normal_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&FaceNormalBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn face_normal_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&FaceNormalBinding, FaceNormal::LATENCY);
}

#[test]
fn face_normal_reset_drops_what_is_on_its_way() {
    common::reset_empties(&FaceNormalBinding, FaceNormal::LATENCY);
}

/// Triangles at one depth face the eye, either way round; a point does, too, and the largest triangles fit.
#[test]
fn face_normal_of_what_is_known() {
    let pixel = Pixel { scale: 0xff_ffff, shift: 16 };
    let level = |x, y| [x, y, 1 << 20];
    let (low, high, near) = (-(1 << 21), (1 << 21) - 1, i32::MAX.into());
    let triangles = [
        [level(0, 0), level(0, 99), level(99, 0)],
        [level(0, 0), level(99, 0), level(0, 99)],
        [level(7, 7); 3],
        [[low, low, 0], [high, low, near], [low, high, near]],
        [[high, high, near], [low, high, 0], [high, low, near]],
        [[low, low, near], [low, high, near], [high, low, 0]],
    ];
    let beats = triangles.map(|triangle| beat(&pixel, triangle)).into_iter();
    let mut scoreboard = Scoreboard::new(&FaceNormalBinding, &small::SET, Box::new(beats), Pattern::NONE);
    let [valid, normal] = ["out_valid", "out_normal"].map(|name| scoreboard.layout().output(name));
    let mut normals = Vec::new();
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            normals.extend((outputs[valid] == 1).then(|| unpack(&outputs[normal..], 3, 18)));
            Ok(())
        })
        .unwrap();
    assert_eq!(normals.len(), 6);
    assert!(normals[..3].iter().all(|normal| *normal == [0, 0, -65536]), "{normals:?}");
}

/// Vectors of every length, ends of the formats and powers of two among them; the parts stand now and then.
#[test]
fn face_normal_shortens_as_golden() {
    let mut random = Random::new(9);
    let (mut first, mut second) = (Shorten::default(), UnitVector::default());
    first.connect_all();
    second.connect_all();
    first.clock.next.reset = true;
    second.clock.next.reset = true;
    first.update_all();
    second.update_all();
    first.latch(true);
    second.latch(true);
    first.clock.next.reset = false;
    second.clock.next.reset = false;
    let (mut under_way, mut checked) = (VecDeque::new(), 0);
    while checked < 50_000 {
        let (short, long) = (random.below(54), random.below(92));
        let component = |random: &mut Random| (random.signed(54) >> short).max(1 - (1 << 53));
        let (x, y) = (component(&mut random), component(&mut random));
        let any = (i128::from(random.bits() as i64) << 28 | i128::from(random.bits() >> 36)) >> long;
        let power = -(1i128 << random.below(91));
        let z = [0, power, power + 1, -power - 1, any.max(1 - (1 << 91))][random.below(12).min(4) as usize];
        let (x, y) = if random.chance(15) { (0, 0) } else { (x, y) };
        let (flip, goes) = (random.chance(50), !random.chance(20));
        first.go.next = goes;
        first.along_x.next = S::new(x);
        first.along_y.next = S::new(y);
        first.along_z.next = WideS::new(z);
        first.flip.next = flip;
        // Outputs of parts within parts settle from pass to pass.
        for _ in 0..4 {
            first.update_all();
        }
        second.go.next = goes;
        second.components.next = first.shortened.val();
        for _ in 0..4 {
            second.update_all();
        }
        if goes {
            let sign = if flip { -1 } else { 1 };
            under_way.push_back([i128::from(x) << 16, i128::from(y) << 16, z].map(|v| sign * v));
            if under_way.len() > Shorten::LATENCY + UnitVector::LATENCY {
                let vector = under_way.pop_front().unwrap();
                let unit = normalize_wide(vector);
                let expected = if unit == [0; 3] { [0, 0, -65536] } else { unit };
                assert_eq!(*second.unit.val().get(), expected.map(i64::from), "{vector:?}");
                checked += 1;
            }
        }
        first.latch(false);
        second.latch(false);
    }
}

#[test]
fn face_normal_refuses_what_no_draw_has() {
    let parse = |numbers: &[i64]| FaceNormalBinding.parse(&small::SET, numbers);
    let good = [1, 2, 3, -4, -5, 6, 7, 8, 9, 1 << 23, 30];
    let pixel = Pixel { scale: 1 << 23, shift: 30 };
    assert_eq!(parse(&good), Ok(beat(&pixel, [[1, 2, 3], [-4, -5, 6], [7, 8, 9]])));
    assert_eq!(parse(&[0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 16]), Err("number 3 is -1, not in 0..=2147483647".to_owned()));
    assert_eq!(parse(&[0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 8]), Err("number 11 is 8, not in 16..=48".to_owned()));
}
