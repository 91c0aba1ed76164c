// SPDX-License-Identifier: MIT OR Apache-2.0
//! Displacement in hardware: against its golden model, its flags, latency, interval and reset.

use relief_hdl::displace::Displace;
use relief_hdl::widths::small;
use relief_testbench::binding::{Binding, unpack};
use relief_testbench::device::Stage;
use relief_testbench::displace::DisplaceBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

#[test]
fn displace_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&DisplaceBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn displace_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&DisplaceBinding, Displace::LATENCY);
}

#[test]
fn displace_reset_drops_what_is_on_its_way() {
    common::reset_empties(&DisplaceBinding, Displace::LATENCY);
}

/// Every flag comes, and a vertex with one has no position.
#[test]
fn displace_flags_come_without_a_position() {
    let beats = DisplaceBinding.random(&small::SET, 8).take(20_000);
    let mut scoreboard = Scoreboard::new(&DisplaceBinding, &small::SET, Box::new(beats), Pattern::NONE);
    let [valid, vertex] = ["out_valid", "out_vertex"].map(|name| scoreboard.layout().output(name));
    let mut counts = [0; 5];
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            if outputs[valid] == 1 {
                let lanes = unpack(&outputs[vertex..vertex + 3], 5, 32);
                let flags = lanes[3] as usize;
                counts[flags] += 1;
                assert!(flags == 0 || lanes[..3] == [0; 3], "{lanes:?}");
                assert!(flags != 0 || lanes[2] > 0, "{lanes:?}");
            }
            Ok(())
        })
        .unwrap();
    assert!([0, 1, 2, 4].iter().all(|flag| counts[*flag] > 200) && counts[3] == 0, "{counts:?}");
}

/// Without displacement a vertex stays where it is: X' is X rounded to 1/256 pixel, c' at most two units below c.
#[test]
fn displace_by_nothing_moves_nothing() {
    let places = [(0, 1 << 30), (5 << 18, 12_345), (-(7 << 18) - 500, 77_777), (700, 1 << 20)];
    for (x, c) in places {
        let mut stage = Stage::new(DisplaceBinding.device(&small::SET));
        let numbers = [x, -x, c, c / 2, c / 3, -c / 2, 1234, 0, 0, 3, 500 << 16];
        stage.offer(&DisplaceBinding.parse(&small::SET, &numbers).unwrap());
        for _ in 0..Displace::LATENCY {
            stage.settle();
            stage.device.edge();
            stage.withdraw();
        }
        stage.settle();
        let lanes = unpack(&stage.sent(), 5, 32);
        let rounded = |x: i64| (x + (1 << 9)) >> 10;
        assert_eq!(lanes[..2], [rounded(x), rounded(-x)]);
        assert!((c - 2..=c).contains(&lanes[2]) && lanes[3..] == [0, 1234], "{lanes:?} of {c}");
    }
}

#[test]
fn displace_refuses_what_no_draw_has() {
    let parse = |numbers: &[i64]| DisplaceBinding.parse(&small::SET, numbers);
    let beat = parse(&[1, -1, 3, 4, 5, 6, 7, -8, -9, -30, 11]).unwrap();
    assert_eq!(beat[..2], [0xffff_ffff_0000_0001, 0x4_0000_0003]);
    assert_eq!(beat[2..], [0x6_0000_0005, 7, 0xffff_fff8, 0x3ff_fff7, 0x22, 11]);
    assert_eq!(parse(&[0, 0, 1, 0, 0, 0, 0, 0, 0, 16, 1]), Err("number 10 is 16, not in -30..=15".to_owned()));
}
