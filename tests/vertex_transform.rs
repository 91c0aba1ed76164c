// SPDX-License-Identifier: MIT OR Apache-2.0
//! The vertex transform in hardware: against its golden model, its latency and interval, the order of constants and vertices,
//! and a whole draw with culling behind it.

use glam::{DVec2, DVec3};
use relief_hdl::vertex_transform::VertexTransform;
use relief_hdl::widths::small;
use relief_models::draw::{Assembled, CameraView, Draw, DrawVertex, MapInfo};
use relief_models::remesher::{BaseTriangle, Format};
use relief_models::step::Vertex;
use relief_models::vertex_transform::Source;
use relief_testbench::binding::{Beat, Binding, unpack};
use relief_testbench::cull::CullBinding;
use relief_testbench::device::Stage;
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};
use relief_testbench::vertex_transform::{VertexTransformBinding, constants, vertex};

mod common;

#[test]
fn vertex_transform_matches_golden_under_idle_and_stall() {
    for counts in common::matches_golden_everywhere(&VertexTransformBinding, 1_500) {
        assert!(counts.checked > 300, "{counts:?}");
    }
}

/// Every field of what is sent, for each vertex of `beats`.
fn sent(beats: Vec<Beat>) -> Vec<[Vec<u64>; 6]> {
    let set = &small::SET;
    let mut scoreboard = Scoreboard::new(&VertexTransformBinding, set, Box::new(beats.into_iter()), Pattern::NONE);
    let names = ["out_data", "out_corner", "out_view", "out_outcode", "out_outside", "out_status"];
    let (places, valid) = (names.map(|name| scoreboard.layout().output(name)), scoreboard.layout().out_valid);
    let words = [5, 2, 7, 1, 1, 1];
    let mut all = Vec::new();
    scoreboard
        .run(Until::Exhausted, &mut |_, _, outputs| {
            let fields = std::array::from_fn(|k| outputs[places[k]..places[k] + words[k]].to_vec());
            all.extend((outputs[valid] == 1).then_some(fields));
            Ok(())
        })
        .unwrap();
    all
}

/// Statuses and all flags come, and zeros with a status.
#[test]
fn vertex_transform_reaches_every_status() {
    let beats = VertexTransformBinding.random(&small::SET, 8).take(4_000).collect();
    let (mut statuses, mut flags) = ([0; 4], [0; 11]);
    for [data, corner, _, outcode, outside, status] in sent(beats) {
        statuses[status[0] as usize] += 1;
        for (k, count) in flags.iter_mut().enumerate() {
            *count += (outcode[0] | outside[0] << 6) >> k & 1;
        }
        let zero = data.iter().chain(&corner).all(|word| *word == 0);
        assert_eq!(zero, status[0] != 0);
        assert_eq!(status[0] == 3, outside[0] & 1 == 1);
        // What is beyond the lanes is beyond the guard band, too.
        assert!(status[0] != 1 || outside[0] & 0b11110 != 0);
    }
    assert!(statuses.iter().chain(&flags).all(|count| *count > 100), "{statuses:?}, {flags:?}");
}

#[test]
fn vertex_transform_latency_and_interval_are_its_constants() {
    let (latency, interval) = (VertexTransform::LATENCY, VertexTransform::INTERVAL);
    assert_eq!(VertexTransformBinding.latency(), latency.to_string());
    assert_eq!(VertexTransformBinding.interval(), format!("{interval}, and 2 for a constant"));
    let beats = VertexTransformBinding.random(&small::SET, 1).take(2_000);
    let (all, vertices): (Vec<_>, Vec<_>) = beats.partition(|beat| beat[0] == 0);
    let mut beats = all[..34].to_vec();
    beats.extend(vertices[..40].iter().cloned());
    let mut stage = Stage::new(VertexTransformBinding.device(&small::SET));
    stage.inputs[stage.layout.out_ready] = 1;
    let (mut taken, mut came, mut stands) = (Vec::new(), Vec::new(), None);
    let mut cycle = 0;
    for (k, beat) in beats.iter().enumerate() {
        stage.offer(beat);
        if k == 34 {
            stands = Some(cycle);
        }
        loop {
            stage.settle();
            let accepts = stage.accepts();
            came.extend(stage.sends().then_some(cycle));
            taken.extend(accepts.then_some(cycle));
            stage.device.edge();
            cycle += 1;
            if accepts {
                break;
            }
        }
    }
    stage.withdraw();
    for _ in 0..2 * latency {
        stage.settle();
        came.extend(stage.sends().then_some(cycle));
        stage.device.edge();
        cycle += 1;
    }
    assert!(taken[..34].windows(2).all(|pair| pair[1] - pair[0] == 2), "{taken:?}");
    assert_eq!(came.len(), 40);
    assert_eq!(came[0] - stands.unwrap(), latency);
    assert!(came.windows(2).all(|pair| pair[1] - pair[0] == interval), "{came:?}");
}

/// Before constant 0 a vertex is taken and sends nothing; and a reset forgets that it has come.
#[test]
fn vertex_transform_begins_with_its_constants() {
    let beats: Vec<Beat> = VertexTransformBinding.random(&small::SET, 3).take(38).collect();
    let early = beats[34..].iter().chain(&beats).cloned().collect();
    assert_eq!(sent(early), sent(beats.clone()));
    let mut stage = Stage::new(VertexTransformBinding.device(&small::SET));
    stage.inputs[stage.layout.out_ready] = 1;
    let mut answers = |beats: &[Beat], resets: bool| {
        let mut count = 0;
        if resets {
            stage.device.reset(1);
        }
        for beat in beats {
            stage.offer(beat);
            for _ in 0..300 {
                stage.settle();
                count += u64::from(stage.sends());
                let accepts = stage.accepts();
                stage.device.edge();
                if accepts {
                    stage.withdraw();
                }
            }
        }
        count
    };
    let vertices = beats[34..].iter().filter(|beat| beat[0] != 0).count() as u64;
    assert_eq!(answers(&beats, false), vertices);
    assert_eq!(answers(&beats[34..], true), 0);
    assert_eq!(answers(&beats, false), vertices);
}

/// A rough sheet, some of it behind the eye, some beside the view, some far away.
fn draw(eye: DVec3) -> Draw {
    let side = 12;
    let vertex = |k: u32| {
        let [i, j] = [k % side, k / side].map(f64::from);
        let position = DVec3::new(i - 5.5, j * 1.5 - 4.0, ((i * 2.0 + j * 3.0) % 5.0) * 0.2 - 1.0);
        let normal = DVec3::new((i % 3.0) - 1.0, (j % 3.0) - 1.0, 1.5);
        DrawVertex { position, normal, uv: DVec2::new(i, j) / f64::from(side) }
    };
    let corners = |k: u32| {
        let (i, j) = (k % (side - 1), k / (side - 1));
        let at = j * side + i;
        [[at, at + 1, at + side], [at + 1, at + side + 1, at + side]]
    };
    let camera = CameraView {
        eye,
        target: DVec3::new(0.0, 8.0, -1.0),
        up: DVec3::Z,
        fov_y: 0.8,
        near: 1.5,
        far: 9.0,
        viewport: [640, 480],
        cell_px: 2.0,
    };
    let map = MapInfo { width: 512, height: 257, repeat: [true, false], levels: 5 };
    let format = Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 12, column_depth: 4096 };
    let vertices: Vec<_> = (0..side * side).map(vertex).collect();
    let triangles: Vec<_> = (0..(side - 1) * (side - 1)).flat_map(corners).collect();
    Draw::new(&camera, &vertices, &triangles, &map, [0.0, 2.0], &format).unwrap()
}

/// Records through the transform and triangles through culling: what the host assembles.
#[test]
fn vertex_transform_and_cull_assemble_a_draw() {
    let mut counts = [0; 4];
    for eye in [DVec3::new(0.2, -1.0, -0.8), DVec3::new(0.2, 0.3, -0.6)] {
        let draw = draw(eye);
        let mut beats = constants(&draw.transform, &draw.volume);
        beats.extend(draw.records.iter().map(|record| vertex(&Source::Record(*record))));
        let corners = sent(beats);
        assert_eq!(corners.len(), draw.records.len());
        let judged = |triangle: &[u32; 3]| -> Beat {
            let of = |field: usize| triangle.map(|v| corners[v as usize][field][0]);
            [&of(3)[..], &of(4), &of(5), &[1]].concat()
        };
        let beats: Vec<Beat> = draw.triangles.iter().map(judged).collect();
        let mut scoreboard = Scoreboard::new(&CullBinding, &small::SET, Box::new(beats.into_iter()), Pattern::NONE);
        let places = ["out_valid", "out_verdict", "out_reason"].map(|name| scoreboard.layout().output(name));
        let mut verdicts = Vec::new();
        scoreboard
            .run(Until::Exhausted, &mut |_, _, outputs| {
                let [valid, verdict, reason] = places.map(|place| outputs[place]);
                verdicts.extend((valid == 1).then_some([verdict, reason]));
                Ok(())
            })
            .unwrap();
        assert_eq!(verdicts.len(), draw.triangles.len());
        for (index, [verdict, reason]) in verdicts.into_iter().enumerate() {
            counts[verdict as usize] += 1;
            let triangle = draw.triangles[index].map(|v| &corners[v as usize]);
            match draw.assemble(index) {
                Assembled::Kept(base) => {
                    let data = triangle.map(|fields| {
                        let mut data = Vertex::default();
                        data[..9].copy_from_slice(&unpack(&fields[0], 9, 32));
                        data
                    });
                    let corner = triangle.map(|fields| {
                        let corner = unpack(&fields[1], 3, 24);
                        std::array::from_fn(|k| corner[k] as i32)
                    });
                    assert_eq!((verdict, *base), (0, BaseTriangle { corners: corner, data }), "{index}");
                }
                Assembled::Culled(why) => assert_eq!([verdict, reason], [1, why as u64], "{index}"),
                Assembled::Cut(_) => assert_eq!(verdict, 2, "{index}"),
                Assembled::Dropped(why) => {
                    let near = why == relief_models::draw::DropReason::Near;
                    assert!(verdict == 2 || !near && [verdict, reason] == [3, why as u64], "{index}: {why:?}");
                }
            }
        }
    }
    assert!(counts[0] > 100 && counts[1] > 100 && counts[2] + counts[3] > 40, "{counts:?}");
}

#[test]
fn vertex_transform_refuses_what_no_draw_has() {
    let parse = |numbers: &[i64]| VertexTransformBinding.parse(&small::SET, numbers);
    assert_eq!(parse(&[0, 32, -1]).unwrap()[..3], [0, 32, (1 << 63) - 1]);
    assert_eq!(parse(&[0, 22, 0]), Err("number 2 is 22, and constants are 0..=21 and 32..=43".to_owned()));
    assert_eq!(parse(&[0, 9, 4096]), Err("number 3 is 4096, not in 4097..=4294967295".to_owned()));
    assert_eq!(parse(&[0, 43, 6]), Err("number 3 is 6, and half of the grid's range is a power of two".to_owned()));
    assert_eq!(parse(&[3, 0]), Err("the line has 2 numbers, and 10 make a beat".to_owned()));
    let lanes = |kind, x| [kind, x, 0, 0, 0, 0, 0, 0, 0, 0];
    assert!(parse(&lanes(1, -(1 << 30))).is_ok() && parse(&lanes(2, -(1 << 46))).is_ok());
    assert_eq!(parse(&lanes(1, 1 << 31)), Err("number 2 is 2147483648, not in -1073741824..=1073741824".to_owned()));
}
