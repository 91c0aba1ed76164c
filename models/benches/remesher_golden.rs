// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles a second of the golden remesher, 9 components, random base triangles of 16, 64 and 128 voxels.

use divan::{Bencher, counter::ItemsCount};
use relief_models::remesher::{BaseTriangle, Format, golden};
use relief_models::step::{Kind, LeftCommand, RightCommand};

fn main() {
    divan::main();
}

const FORMAT: Format =
    Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 16, column_depth: 4096 };

/// Random base triangles, the same ones in every run (a linear congruential generator, Knuth's MMIX constants).
fn bases(pixels: i32) -> Vec<BaseTriangle> {
    let mut state = 1u64;
    let mut random = move |range: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 32) % range
    };
    let mut base = || BaseTriangle {
        corners: std::array::from_fn(|_| std::array::from_fn(|_| random(pixels as u64 + 1) as i32)),
        data: std::array::from_fn(|_| {
            std::array::from_fn(|c| if c < FORMAT.components { i64::from(random(1 << 32) as u32 as i32) } else { 0 })
        }),
    };
    (0..200).map(|_| base()).collect()
}

/// Remeshes all of `bases`; the result is the number of triangles closed.
fn remesh(bases: &[BaseTriangle]) -> usize {
    let mut triangles = 0;
    for base in bases {
        golden(&FORMAT, base, &mut |step| {
            if step.kind == Kind::Step {
                triangles += usize::from(step.left != LeftCommand::Ref) + usize::from(step.right != RightCommand::Ref);
            }
            divan::black_box(step);
        });
    }
    triangles
}

#[divan::bench(args = [16, 64, 128])]
fn triangles(bencher: Bencher, pixels: i32) {
    let bases = bases(pixels);
    bencher.counter(ItemsCount::new(remesh(&bases))).bench(|| remesh(divan::black_box(&bases)));
}
