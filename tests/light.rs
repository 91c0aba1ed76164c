// SPDX-License-Identifier: MIT OR Apache-2.0
//! The light in hardware: against its golden model, its latency, interval and reset; and behind the face normal it is what a draw
//! shades with.

use glam::{DVec2, DVec3};
use relief_hdl::light::Light;
use relief_hdl::widths::small;
use relief_models::draw::{CameraView, Draw, DrawVertex, MapInfo};
use relief_models::remesher::Format;
use relief_models::step::{MAX_COMPONENTS, Vertex};
use relief_testbench::binding::{Beat, Binding, Random, unpack};
use relief_testbench::face_normal::{self, FaceNormalBinding};
use relief_testbench::light::{LightBinding, Lit};
use relief_testbench::scoreboard::{Pattern, Scoreboard, Until};

mod common;

#[test]
fn light_matches_golden_under_idle_and_stall() {
    let beats = 10_000;
    for counts in common::matches_golden_everywhere(&LightBinding, beats) {
        assert_eq!(counts.checked, beats);
    }
}

#[test]
fn light_latency_and_interval_are_its_constants() {
    common::is_a_straight_pipeline(&LightBinding, Light::LATENCY);
}

#[test]
fn light_reset_drops_what_is_on_its_way() {
    common::reset_empties(&LightBinding, Light::LATENCY);
}

/// What the hardware of a block makes of beats.
fn through(block: &dyn Binding, port: &'static str, words: usize, beats: Vec<Beat>) -> Vec<Beat> {
    let pattern = Pattern { idle: 10, stall: 20, seed: 4 };
    let mut scoreboard = Scoreboard::new(block, &small::SET, Box::new(beats.into_iter()), pattern);
    let [valid, place] = ["out_valid", port].map(|name| scoreboard.layout().output(name));
    let ready = scoreboard.layout().out_ready;
    let mut sent = Vec::new();
    scoreboard
        .run(Until::Exhausted, &mut |_, inputs, outputs| {
            sent.extend((outputs[valid] == 1 && inputs[ready] == 1).then(|| outputs[place..place + words].to_vec()));
            Ok(())
        })
        .unwrap();
    sent
}

/// Triangles of a draw, through both blocks.
#[test]
fn light_behind_face_normal_shades_as_a_draw() {
    let camera = CameraView {
        eye: DVec3::new(0.3, 0.2, -3.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        fov_y: 0.8,
        near: 0.5,
        far: 100.0,
        viewport: [640, 480],
        cell_px: 1.0,
    };
    let corner = |x: f64, y: f64| DrawVertex {
        position: DVec3::new(x, y, 0.0),
        normal: -DVec3::Z,
        uv: DVec2::new(x / 2.0 + 0.5, y / 2.0 + 0.5),
    };
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)];
    let map = MapInfo { width: 65, height: 65, repeat: [false; 2], levels: 5 };
    let format = Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 14, column_depth: 4096 };
    let draw = Draw::new(&camera, &corners, &[[0, 1, 2]], &map, [-0.2, 0.4], &format).unwrap();
    let light = draw.light(DVec3::new(-0.4, 0.7, -0.8)).unwrap();

    // Displaced vertices anywhere on the screen, near and far, some without area.
    let mut random = Random::new(11);
    let triangles: Vec<[Vertex; 3]> = (0..3000)
        .map(|_| {
            let (spread, centre) = (random.below(18), [random.signed(18), random.signed(18)]);
            let nearness = (1 << 26) + random.below(1 << 29) as i64;
            [0; 3].map(|_| {
                let mut vertex = [0; MAX_COMPONENTS];
                vertex[0] = centre[0] + (random.signed(18) >> spread);
                vertex[1] = centre[1] + (random.signed(18) >> spread);
                vertex[2] = nearness + (random.signed(26) >> spread);
                vertex[4] = random.below((65535 << 8) + 1) as i64;
                vertex
            })
        })
        .collect();
    let normals = triangles.iter().map(|t| face_normal::beat(&draw.pixel, t.map(|v| [v[0], v[1], v[2]]))).collect();
    let normals = through(&FaceNormalBinding, "out_normal", 1, normals);
    assert_eq!(normals.len(), triangles.len());
    let lit = triangles.iter().zip(&normals).map(|(triangle, normal)| {
        Lit {
            normal: std::array::from_fn(|k| unpack(normal, 3, 18)[k] as i32),
            position: [triangle[0][0], triangle[0][1]],
            heights: triangle.map(|vertex| vertex[4]),
            pixel: draw.pixel,
            material: draw.material,
            light,
        }
        .beat()
    });
    let colours = through(&LightBinding, "out_colour", 1, lit.collect());
    assert_eq!(colours.len(), triangles.len());
    let mut seen = std::collections::HashSet::new();
    for (triangle, colour) in triangles.into_iter().zip(&colours) {
        let [red, green, blue] = draw.shade(triangle, &[light]).map(u64::from);
        assert_eq!(colour[0], red | green << 8 | blue << 16, "{triangle:?}");
        seen.insert(colour[0]);
    }
    assert!(seen.len() > 1000, "{} colours", seen.len());
}

#[test]
fn light_refuses_what_no_draw_has() {
    let mut numbers = vec![0; 36];
    (numbers[9], numbers[29]) = (16, 1);
    let parse = |numbers: &[i64]| LightBinding.parse(&small::SET, numbers);
    assert_eq!(parse(&numbers).unwrap().len(), 16);
    numbers[33] = (1 << 18) + 1;
    assert_eq!(parse(&numbers), Err("number 34 is 262145, not in 0..=262144".to_owned()));
    numbers[29] = 0;
    assert_eq!(parse(&numbers), Err("number 30 is 0, not in 1..=255".to_owned()));
}
