// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the remesher costs on random base triangles: beats, vertices sent, and cycles with a setup unit in front.
//!
//! `cargo run --release -p relief-models --example remesher_cost`
//!
//! Corners are uniform in a box of the given extent. A *job* is what a `Start` opens: two in a roof, else one.

use relief_models::remesher::{BaseTriangle, Format, golden};
use relief_models::step::{Kind, LeftCommand, RightCommand};

/// Base triangles per row.
const BASES: usize = 1_000;
/// Cycles to load a job into the sweep.
const LOAD: u64 = 2;

/// What one base triangle costs.
#[derive(Default, Clone, Copy)]
struct Cost {
    beats: u64,
    jobs: u64,
    triangles: u64,
    sent: u64,
    recalled: u64,
}

fn main() {
    println!(
        "extent | triangles/base | beats/2 triangles | sent/triangle, memory 4096 | 64 | 0 | recalled/triangle | jobs/base"
    );
    for extent in [4, 8, 16, 64, 128] {
        let [full, small, none] = [4096, 64, 0].map(|depth| costs(extent, depth));
        let total = |costs: &[Cost], of: fn(&Cost) -> u64| costs.iter().map(of).sum::<u64>() as f64;
        let triangles = total(&full, |c| c.triangles);
        println!(
            "{extent:6} | {:14.1} | {:17.4} | {:26.4} | {:.4} | {:.4} | {:.4} | {:.2}",
            triangles / BASES as f64,
            2.0 * total(&full, |c| c.beats) / triangles,
            total(&full, |c| c.sent) / triangles,
            total(&small, |c| c.sent) / triangles,
            total(&none, |c| c.sent) / triangles,
            total(&full, |c| c.recalled) / triangles,
            total(&full, |c| c.jobs) / BASES as f64,
        );
    }
    println!("\ncycles per two triangles, setup interval S, one finished setup waits while the next is computed");
    for extent in [4, 8, 16, 64, 128] {
        let costs = costs(extent, 4096);
        let row: Vec<_> = [0, 60, 100, 150, 200, 300].map(|s| format!("S={s}: {:.4}", cycles(&costs, s))).to_vec();
        println!("{extent:6} | {}", row.join(" | "));
    }
}

fn costs(extent: u64, column_depth: usize) -> Vec<Cost> {
    let format = Format { components: 1, vertex_bits: 32, guard_bits: 13, coordinate_bits: 16, column_depth };
    let mut state = extent;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) % (extent + 1)) as i32
    };
    (0..BASES)
        .map(|_| {
            let corners = std::array::from_fn(|_| std::array::from_fn(|_| random()));
            let mut cost = Cost::default();
            golden(&format, &BaseTriangle { corners, data: [[0; 16]; 3] }, &mut |step| {
                cost.beats += 1;
                cost.jobs += u64::from(step.kind == Kind::Start);
                cost.sent += u64::from(step.sends_left()) + u64::from(step.sends_right());
                cost.recalled += u64::from(step.left == LeftCommand::Recall);
                if step.kind == Kind::Step {
                    cost.triangles +=
                        u64::from(step.left != LeftCommand::Ref) + u64::from(step.right != RightCommand::Ref);
                }
            });
            cost
        })
        .collect()
}

/// Cycles per two triangles of base triangles back to back.
fn cycles(costs: &[Cost], interval: u64) -> f64 {
    // When the setup unit is free again, when the finished setup was taken, when the sweep is free.
    let (mut computed, mut loaded, mut swept) = (0, 0, 0);
    for cost in costs {
        let finished = computed + interval;
        // A finished setup leaves the unit once the one before it has been taken.
        computed = finished.max(loaded);
        loaded = computed.max(swept);
        swept = loaded + cost.beats + LOAD * cost.jobs;
    }
    2.0 * swept as f64 / costs.iter().map(|cost| cost.triangles).sum::<u64>() as f64
}
