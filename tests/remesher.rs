// SPDX-License-Identifier: MIT OR Apache-2.0
//! The remesher in hardware: against its golden model on every small triangle and many others, its cost, closed meshes,
//! a column memory of two places, and its reset.

use rayon::prelude::*;
use relief_hdl::signal::Lanes;
use relief_hdl::widths::{WIDTH_SETS, WidthSet, default, position};
use relief_models::mesh::{Builder, CheckOptions, check};
use relief_models::remesher::{BaseTriangle, Format, Setup, golden};
use relief_models::step::{Kind, LeftCommand, MAX_COMPONENTS, RightCommand, Step, Vertex};
use relief_models::strip_unit;
use relief_testbench::binding::{Beat, Binding, Random};
use relief_testbench::check::{Check, Verdict, check as run_check};
use relief_testbench::cosim::tools;
use relief_testbench::remesh::{Chain, Counts, Engine, GridTriangle, SCALE, base_of, remesh};
use relief_testbench::remesher::{RemesherBinding, beat_of, format, random_base};
use relief_testbench::stepped::Stepped;
use relief_testbench::strip_unit::StripUnitBinding;

mod common;

type Corners = [[i32; 3]; 3];

#[test]
fn remesher_matches_golden_under_idle_and_stall() {
    let bases = 200;
    for counts in common::matches_golden_everywhere(&RemesherBinding, bases) {
        // At least a Start and a Step for each.
        assert!(counts.checked >= 2 * bases, "{counts:?}");
    }
}

/// Random vertex data over the whole range of the format.
fn with_data(set: &WidthSet, corners: Corners, random: &mut Random) -> BaseTriangle {
    let mut data = [[0; MAX_COMPONENTS]; 3];
    for vertex in &mut data {
        vertex[..set.components].iter_mut().for_each(|value| *value = random.signed(set.vertex_bits));
    }
    BaseTriangle { corners, data }
}

/// Corners uniform in a box.
fn corners_in(random: &mut Random, extent: i32, offset: [i32; 3]) -> Corners {
    std::array::from_fn(|_| offset.map(|offset| offset + random.below(extent as u64 + 1) as i32))
}

fn lanes(vertex: &Vertex) -> Lanes<3, 32> {
    Lanes::new([vertex[0], vertex[1], vertex[2]])
}

type Device = Stepped<position::Remesher>;

fn device() -> Device {
    Stepped::new(position::Remesher::new(position::SET.column_depth))
}

fn offer(device: &mut Device, base: Option<&BaseTriangle>) {
    let block = device.block_mut();
    block.in_valid.next = base.is_some();
    if let Some(BaseTriangle { corners, data }) = base {
        let corner = |k: usize| Lanes::new(corners[k].map(i64::from));
        (block.in_p0.next, block.in_p1.next, block.in_p2.next) = (corner(0), corner(1), corner(2));
        (block.in_v0.next, block.in_v1.next, block.in_v2.next) = (lanes(&data[0]), lanes(&data[1]), lanes(&data[2]));
    }
}

/// Whether the step at the output is `step`, a vertex that is not sent left aside.
fn is_step(device: &Device, step: &Step) -> bool {
    let block = device.block();
    block.out_kind.val() == step.kind as i32
        && block.out_left.val() == step.left as i32
        && block.out_right.val() == step.right as i32
        && block.out_swap.val() == step.swap
        && block.out_last.val() == step.last
        && (!step.sends_left() || block.out_left_vertex.val() == lanes(&step.left_vertex))
        && (!step.sends_right() || block.out_right_vertex.val() == lanes(&step.right_vertex))
}

/// Sends `bases` back to back and compares every beat with the golden model; then nothing more may come. Gives the
/// number of beats.
fn compare(device: &mut Device, format: &Format, bases: &[BaseTriangle]) -> u64 {
    device.block_mut().out_ready.next = true;
    let mut accepted = 0;
    let mut beats = 0;
    for base in bases {
        let mut steps = Vec::new();
        golden(format, base, &mut |step| steps.push(*step));
        let mut steps = steps.iter();
        let mut waited = 0;
        while steps.len() > 0 {
            offer(device, bases.get(accepted));
            device.settle();
            accepted += usize::from(accepted < bases.len() && device.block().in_ready.val());
            waited += 1;
            if device.block().out_valid.val() {
                waited = 0;
                let step = steps.next().expect("a step is left");
                assert!(is_step(device, step), "beat {beats}, base triangle {base:?}: {step:?} was expected");
                beats += 1;
            }
            assert!(waited < 1000, "no beat for {waited} cycles, base triangle {base:?}");
            device.edge();
        }
    }
    assert_eq!(accepted, bases.len());
    offer(device, None);
    for _ in 0..20 {
        device.settle();
        assert!(!device.block().out_valid.val(), "a beat too many after {:?}", bases.last());
        device.edge();
    }
    beats
}

/// Compares in parallel, each part in a device of its own.
fn compare_all(bases: &[BaseTriangle]) -> u64 {
    let format = format(&position::SET);
    let parts = bases.par_chunks(bases.len().div_ceil(16));
    parts.map(|part| compare(&mut device(), &format, part)).sum()
}

/// One of each class of translates in the box 0..=3: the smallest coordinate of each axis is 0.
#[test]
fn remesher_matches_golden_on_every_triangle_of_a_small_box() {
    let triples: Vec<[i32; 3]> =
        (0..64).map(|code| [code / 16, code / 4 % 4, code % 4]).filter(|triple| triple.contains(&0)).collect();
    let n = triples.len();
    let bases: Vec<_> = (0..n * n * n)
        .map(|code| {
            let [x, y, z] = [code / n / n, code / n % n, code % n].map(|k| triples[k]);
            with_data(&position::SET, std::array::from_fn(|k| [x[k], y[k], z[k]]), &mut Random::new(code as u64))
        })
        .collect();
    assert_eq!(bases.len(), 50_653);
    let beats = compare_all(&bases);
    assert!(beats > 4 * 50_653, "{beats} beats");
}

#[test]
fn remesher_matches_golden_on_random_triangles() {
    let bases: Vec<_> = (1..=2_000)
        .map(|seed| {
            let mut random = Random::new(seed);
            let extent = 1 + random.below(64) as i32;
            let offset = std::array::from_fn(|_| random.below(4_096) as i32);
            let corners = corners_in(&mut random, extent, offset);
            with_data(&position::SET, corners, &mut random)
        })
        .collect();
    let beats = compare_all(&bases);
    assert!(beats > 100 * 2_000, "{beats} beats");
}

/// Slivers across the whole coordinate range, in all directions: long edges, few triangles.
#[test]
fn remesher_matches_golden_across_the_whole_range() {
    let (low, high) = position::SET.coordinates();
    let slivers = [
        [[low, 0, 0], [high, 3, 1], [100, 2, 5]],
        [[low, low, low], [high, high, high], [high, high, high - 2]],
        [[low, high, low], [high, low, high], [0, 0, 0]],
        [[0, 0, 0], [4_095, 1, 2], [4_095, 1, 3]],
        [[high; 3], [low; 3], [low; 3]],
    ];
    let orders = [[0, 1, 2], [1, 2, 0], [2, 1, 0]];
    let bases: Vec<_> = slivers
        .iter()
        .flat_map(|corners| orders.map(|order| order.map(|k: usize| corners[k])))
        .zip(0..)
        .map(|(corners, seed)| with_data(&position::SET, corners, &mut Random::new(seed)))
        .collect();
    let beats = compare_all(&bases);
    assert!(beats > 15 * 4_095, "{beats} beats");
}

/// A triangle of extent 4,095 in the golden models alone: the column memory is large enough, and there are two triangles
/// a voxel but for those along the edges.
#[test]
fn remesher_golden_takes_a_large_base() {
    let set = position::SET;
    let base = with_data(&set, [[0, 7, 300], [4_095, 0, 9], [1_900, 4_095, 4_001]], &mut Random::new(1));
    let setup = Setup::new(&format(&set), &base);
    let mut unit = strip_unit::StripUnit::new(set.column_depth);
    let (mut beats, mut triangles) = (0, 0);
    golden(&format(&set), &base, &mut |step| {
        beats += 1;
        triangles += unit.accept(step).triangles().count() as u64;
    });
    assert!(!unit.error());
    let segments: u64 = setup.edges.iter().map(|edge| u64::from(edge.segments)).sum();
    assert!(triangles.abs_diff(setup.double_area.unsigned_abs()) <= 2 * segments, "{triangles} triangles");
    assert!(triangles > 10_000_000 && beats < triangles * 51 / 100, "{triangles} triangles in {beats} beats");
}

/// Cost of 1,000 random base triangles back to back, set-up included, at nine components.
fn cost(extent: i32) -> Counts {
    let set = default::SET;
    let mut random = Random::new(extent as u64);
    let bases = std::iter::repeat_with(|| {
        let corners = corners_in(&mut random, extent, [0; 3]);
        beat_of(&set, &with_data(&set, corners, &mut random))
    });
    let counts = Chain::new(&set).run(bases.take(1_000), &mut |_| Ok(())).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(counts.bases, 1_000);
    counts
}

#[test]
fn remesher_costs_little_more_than_a_cycle_for_two_triangles() {
    let counts = cost(64);
    assert!(counts.triangles > 500_000, "{counts:?}");
    assert!(counts.cycles_per_two_triangles() <= 1.30, "{} at 64 px", counts.cycles_per_two_triangles());
    assert!(counts.sent_per_triangle() <= 0.60, "{} at 64 px", counts.sent_per_triangle());
    let counts = cost(128);
    assert!(counts.triangles > 2_000_000, "{counts:?}");
    assert!(counts.cycles_per_two_triangles() <= 1.15, "{} at 128 px", counts.cycles_per_two_triangles());
}

/// Octahedra of random corners, each face rotated by 0, 1 and 2 against its neighbours, both ways round, through the
/// blocks: closed, and exact tilings of their faces. Vertices are identified by all their bits.
#[test]
fn remesher_closed_meshes_stay_closed() {
    const FACES: [[usize; 3]; 8] =
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let triangles: u64 = (0..24)
        .into_par_iter()
        .map(|seed| {
            let mut random = Random::new(seed);
            // A distorted octahedron: opposite corners on opposite sides, so that no face crosses another.
            let corners: [[i32; 3]; 6] = std::array::from_fn(|k| {
                let far = 12 + random.below(20) as i32;
                let mut corner = std::array::from_fn(|_| random.below(9) as i32 - 4);
                corner[k / 2] = if k % 2 == 0 { far } else { -far };
                corner
            });
            let grid: Vec<GridTriangle> = FACES
                .into_iter()
                .zip(0..)
                .map(|(mut face, number)| {
                    face.rotate_left(((seed + u64::from(number) * (seed / 3)) % 3) as usize);
                    if seed % 2 == 1 {
                        face.swap(1, 2);
                    }
                    GridTriangle { number, corners: face.map(|k| corners[k]) }
                })
                .collect();
            let mut mesh = Builder::new("octahedron", SCALE as u64);
            for base in &grid {
                mesh.base(base.number, base.corners.map(|corner| corner.map(i64::from))).unwrap();
            }
            let counts = remesh(Engine::Rust, &grid, &(), &mut |base, triangle| {
                mesh.triangle(base, *triangle).map_err(std::io::Error::other)
            })
            .unwrap_or_else(|error| panic!("seed {seed}: {error}"));
            let report = check(&mesh.finish().unwrap(), &CheckOptions { closed: true, ..CheckOptions::default() }, &());
            assert!(report.ok, "seed {seed}: {report}");
            assert_eq!((report.base_triangles, report.shared_base_edges), (Some(8), 12), "seed {seed}");
            assert_eq!(report.boundary_edges, 0, "seed {seed}");
            assert_eq!(report.triangles, counts.triangles);
            counts.triangles
        })
        .sum();
    assert!(triangles > 24 * 8 * 100, "{triangles} triangles");
}

/// With a column memory of two places most vertices are sent twice, and the triangles are the same.
#[test]
fn remesher_column_memory_of_two_changes_no_triangle() {
    let tiny = WidthSet { column_depth: 2, ..position::SET };
    let without = Format { column_depth: 0, ..format(&position::SET) };
    for seed in 1..=4 {
        let mut random = Random::new(seed);
        let bases: Vec<_> = (0..60).map(|_| random_base(&tiny, &mut random)).collect();
        let mut steps = Vec::new();
        bases.iter().for_each(|base| golden(&without, base, &mut |step| steps.push(*step)));
        let mut expected =
            strip_unit::golden(0, &steps).map(|triangle| triangle.map(|vertex| [vertex[0], vertex[1], vertex[2]]));
        let mut chain = Chain::new(&tiny);
        let ports = chain.decoder();
        let mut recalls = 0;
        let counts = chain
            .run(bases.iter().map(|base| beat_of(&tiny, base)), &mut |chain| {
                recalls += u64::from(chain.step().is_some_and(|[_, left, _]| left == LeftCommand::Recall as u64));
                for triangle in ports.triangles(chain.strip_outputs()) {
                    assert_eq!(Some(triangle), expected.next(), "seed {seed}");
                }
                Ok(())
            })
            .unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        assert_eq!(expected.next(), None, "seed {seed}");
        assert!(recalls > 0 && counts.triangles > 1_000, "seed {seed}: {recalls} recalls, {counts:?}");
    }
}

/// The emitted modules with a column memory of two places, which every column of more rows overflows: at the width sets'
/// own depths only base triangles of millions of triangles do that.
#[test]
fn remesher_verilog_sends_again_what_the_column_memory_does_not_hold() -> Result<(), Box<dyn std::error::Error>> {
    if !tools::require_all(&["verilator", "g++", "iverilog"], "the check of a small column memory")? {
        return Ok(());
    }
    let tiny = WidthSet { column_depth: 2, ..position::SET };
    let vectors = 300;
    for binding in [&RemesherBinding as &dyn Binding, &StripUnitBinding] {
        let report = run_check(&Check { vectors, icarus_vectors: vectors, ..Check::new(binding, &tiny) }, &())?;
        assert_eq!(report.failure, None, "{}", binding.name());
        assert_eq!(report.rows.len(), 3);
        assert!(report.rows.iter().all(|row| row.vectors == vectors && row.verdict == Verdict::Agreed), "{report:?}");
    }
    Ok(())
}

/// Whenever the reset comes, in set-up or sweep, stalled or not, the next base triangles come out right.
#[test]
fn remesher_reset_in_the_middle_of_a_stream() {
    let set = position::SET;
    let cycles: Vec<usize> = (0..500).step_by(3).collect();
    let beats: u64 = cycles
        .into_par_iter()
        .map(|cycles| {
            let mut random = Random::new(cycles as u64);
            let mut device = device();
            let mut before = with_data(&set, corners_in(&mut random, 20, [-10; 3]), &mut random);
            for _ in 0..cycles {
                device.block_mut().out_ready.next = random.chance(70);
                offer(&mut device, Some(&before));
                device.settle();
                if device.block().in_ready.val() {
                    before = with_data(&set, corners_in(&mut random, 20, [-10; 3]), &mut random);
                }
                device.edge();
            }
            device.reset(1 + cycles % 2);
            let bases: Vec<_> =
                (0..3).map(|_| with_data(&set, corners_in(&mut random, 6, [5; 3]), &mut random)).collect();
            compare(&mut device, &format(&set), &bases)
        })
        .sum();
    assert!(beats > 167 * 6, "{beats} beats");
}

/// The formulas that the binding gives for latency and interval are reached, and not exceeded, at every width set: by
/// random base triangles one at a time, and by small ones back to back.
#[test]
fn remesher_latency_and_interval_are_as_documented() {
    assert_eq!(RemesherBinding.latency(), "max(3 W + 31, 2 W + 3 L + 58) + 11 at most");
    assert!(RemesherBinding.interval().contains("max(3 W + 31, 2 W + 3 L + 58) a base triangle"));
    WIDTH_SETS.par_iter().for_each(|set| {
        let (w, l) = (set.accumulator_bits(), set.components);
        let mut random = Random::new(1);
        let mut latency = 0;
        for _ in 0..100 {
            let base = random_base(set, &mut random);
            let (mut first, mut cycle) = (None, 0);
            let run = Chain::new(set).run([beat_of(set, &base)].into_iter(), &mut |chain| {
                first = first.or(chain.step().map(|_| cycle));
                cycle += 1;
                Ok(())
            });
            assert_eq!(run.unwrap().bases, 1);
            latency = latency.max(first.expect("a first beat"));
        }
        let most = (3 * w + 31).max(2 * w + 3 * l + 58);
        // The eleventh cycle is that of a roof over its first corner, which the random ones need not have.
        assert!((most + 10..=most + 11).contains(&latency), "{}: {latency}", set.name);

        let small = (0..300).map(|_| {
            let corners = corners_in(&mut random, 2, [0; 3]);
            beat_of(set, &with_data(set, corners, &mut random))
        });
        let small: Vec<Beat> = small.collect();
        let (mut interval, mut before, mut cycle) = (0, None, 0);
        let run = Chain::new(set).run(small.into_iter(), &mut |chain| {
            if chain.accepts() {
                interval = interval.max(cycle - before.unwrap_or(cycle));
                before = Some(cycle);
            }
            cycle += 1;
            Ok(())
        });
        assert_eq!(run.unwrap().bases, 300);
        assert_eq!(interval, most, "{}", set.name);
    });
}

/// What the golden model calls a `Start` sends two vertices, and a base triangle of one grid point is two beats.
#[test]
fn remesher_point_is_two_beats() {
    let base = base_of(&GridTriangle { number: 0, corners: [[-8192, 8191, 0]; 3] });
    let mut steps = Vec::new();
    golden(&format(&position::SET), &base, &mut |step| steps.push((step.kind, step.left, step.right, step.last)));
    let expected = [
        (Kind::Start, LeftCommand::Set, RightCommand::Set, false),
        (Kind::Step, LeftCommand::Set, RightCommand::Ref, true),
    ];
    assert_eq!(steps, expected);
    assert_eq!(compare(&mut device(), &format(&position::SET), &[base]), 2);
}
