// SPDX-License-Identifier: MIT OR Apache-2.0
//! The vertex adder in hardware: against its golden model, its latency, its interval and its reset.

use relief_hdl::signal::Lanes;
use relief_hdl::widths::{self, WIDTH_SETS};
use relief_hdl::with_width_set;
use relief_testbench::binding::Binding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use relief_testbench::stepped::Stepped;
use relief_testbench::vertex_adder::VertexAdderBinding;

mod common;

#[test]
fn vertex_adder_matches_golden_under_idle_and_stall() {
    let beats = 20_000;
    for counts in common::matches_golden_everywhere(&VertexAdderBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn vertex_adder_latency_is_its_constant() {
    for set in WIDTH_SETS {
        let (measured, latency) = with_width_set!(set.name, W => {
            let mut adder = Stepped::new(W::VertexAdder::default());
            adder.block_mut().out_ready.next = true;
            adder.block_mut().in_valid.next = true;
            let mut cycles = 0;
            loop {
                adder.settle();
                if adder.block().out_valid.val() {
                    break (cycles, W::VertexAdder::LATENCY);
                }
                adder.edge();
                adder.block_mut().in_valid.next = false;
                cycles += 1;
                assert!(cycles < 10, "no sum");
            }
        })
        .unwrap();
        assert_eq!(measured, latency, "{}", set.name);
        assert_eq!(VertexAdderBinding.latency(), latency.to_string());
    }
}

#[test]
fn vertex_adder_takes_a_beat_every_cycle() {
    let beats = 1_000;
    for set in WIDTH_SETS {
        let source = VertexAdderBinding.random(set, 1);
        let mut scoreboard = Scoreboard::new(&VertexAdderBinding, set, source, Pattern::NONE);
        let counts = scoreboard.run(Until::Accepted(beats), &mut |_, _, _| Ok(())).unwrap();
        assert_eq!(counts.cycles, beats + widths::default::VertexAdder::LATENCY as u64, "{}", set.name);
    }
}

/// A sum that waits when the reset comes is gone after it, and the next one is right.
#[test]
fn vertex_adder_reset_drops_the_sum() {
    let mut adder = Stepped::new(widths::default::VertexAdder::default());
    let cycle = |adder: &mut Stepped<widths::default::VertexAdder>, valid, value| {
        adder.block_mut().in_valid.next = valid;
        adder.block_mut().in_vertex.next = Lanes::new([value; 9]);
        adder.block_mut().in_difference.next = Lanes::new([1; 9]);
        adder.settle();
        let sum = adder.block().out_valid.val().then(|| adder.block().out_vertex.val());
        adder.edge();
        sum
    };
    assert_eq!(cycle(&mut adder, true, 5), None);
    assert_eq!(cycle(&mut adder, false, 0), Some(Lanes::new([6; 9])), "not taken");
    adder.reset(1);
    assert_eq!(cycle(&mut adder, true, -7), None);
    assert_eq!(cycle(&mut adder, false, 0), Some(Lanes::new([-6; 9])));
}
