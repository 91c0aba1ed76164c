// SPDX-License-Identifier: MIT OR Apache-2.0
//! Clipping in hardware: against its golden model, polygons of every size, edges from both sides, and its cycles.

use relief_hdl::clip::Clip;
use relief_hdl::widths::small;
use relief_testbench::binding::{Beat, Binding, pack, unpack};
use relief_testbench::clip::ClipBinding;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

#[test]
fn clip_matches_golden_under_idle_and_stall() {
    for counts in common::matches_golden_everywhere(&ClipBinding, 300) {
        assert!(counts.checked > 100, "{counts:?}");
    }
}

/// The polygons that come of triangles, and the cycles that all of them take.
fn polygons(beats: Vec<Beat>) -> (Vec<Vec<Vec<i64>>>, u64) {
    let mut scoreboard = Scoreboard::new(&ClipBinding, &small::SET, Box::new(beats.into_iter()), Pattern::NONE);
    let places = ["out_view", "out_kept", "out_last"].map(|name| scoreboard.layout().output(name));
    let valid = scoreboard.layout().out_valid;
    let (mut all, mut polygon) = (Vec::new(), Vec::new());
    let counts = scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            if outputs[valid] == 1 {
                if outputs[places[1]] == 1 {
                    polygon.push(unpack(&outputs[places[0]..places[0] + 7], 9, 48));
                }
                if outputs[places[2]] == 1 {
                    all.push(std::mem::take(&mut polygon));
                }
            }
            Ok(())
        })
        .unwrap();
    (all, counts.cycles)
}

#[test]
fn clip_makes_polygons_of_every_size() {
    let beats = ClipBinding.random(&small::SET, 4).take(3_000).collect();
    let mut counts = [0; 9];
    for polygon in polygons(beats).0 {
        counts[polygon.len()] += 1;
    }
    assert!(counts[0] > 50 && counts[3..6].iter().all(|count| *count > 50) && counts[6] + counts[7] > 10, "{counts:?}");
}

fn triangle(corners: [[i64; 3]; 3]) -> Vec<Beat> {
    let beat = |[x, y, z]: [i64; 3]| [pack(&[x, y, z, 5, -5, 0, 7, 0, z], 48), vec![1 << 20, 1 << 24]].concat();
    corners.map(beat).to_vec()
}

/// What the example of the documentation says; what no plane cuts is itself; what all are behind is nothing.
#[test]
fn clip_example_of_the_documentation() {
    let z0 = 1 << 20;
    let [a, b, c] = [[0, 0, z0 - 1], [100, 0, z0 + 3], [100, 50, z0 + 3]];
    let (cut, _) = polygons(triangle([a, b, c]));
    let positions: Vec<_> = cut[0].iter().map(|vertex| vertex[..3].to_vec()).collect();
    assert_eq!(positions, [[25, 0, z0], [100, 0, z0 + 3], [100, 50, z0 + 3], [25, 13, z0]].map(Vec::from));
    // The edge comes from its other end, too: neighbours meet.
    let (other, _) = polygons(triangle([b, a, [0, -9, z0 + 3]]));
    assert!(other[0].contains(&cut[0][0]), "{other:?}");
    let whole = [[0, 0, z0], b, c];
    let (kept, cycles) = polygons(triangle(whole));
    assert_eq!(kept[0].iter().map(|vertex| vertex[..3].to_vec()).collect::<Vec<_>>(), whole.map(Vec::from));
    assert_eq!(cycles, (Clip::LATENCY + 2 * Clip::INTERVAL + 1) as u64);
    assert!(ClipBinding.latency().starts_with(&format!("{} uncut", Clip::LATENCY)));
    let (gone, _) = polygons(triangle([a, [100, 0, z0 - 3], [100, 50, z0 - 9]]));
    assert_eq!(gone, [Vec::<Vec<i64>>::new()]);
}

#[test]
fn clip_refuses_what_no_vertex_is() {
    let parse = |numbers: &[i64]| ClipBinding.parse(&small::SET, numbers);
    assert!(parse(&[-(1 << 46), 0, 0, -(1 << 32), 0, 0, 0, 0, 0, 1 << 16, 1]).is_ok());
    let refused = "number 10 is 65535, not in 65536..=70368744177663".to_owned();
    assert_eq!(parse(&[0, 0, 0, 0, 0, 0, 0, 0, 0, 65535, 1]), Err(refused));
}
