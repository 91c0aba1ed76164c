// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bisector in hardware.

use relief_testbench::bisector::BisectorBinding;

mod common;

#[test]
fn bisector_matches_golden_under_idle_and_stall() {
    for counts in common::matches_golden_everywhere(&BisectorBinding, 20_000) {
        assert!(counts.checked > 1_000, "{counts:?}");
    }
}
