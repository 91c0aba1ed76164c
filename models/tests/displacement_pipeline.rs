// SPDX-License-Identifier: MIT OR Apache-2.0
//! The machine of the whole design against the chain of golden models that the harness runs.

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use relief_models::displace::displaced;
use relief_models::displacement_pipeline::{
    Command, Machine, Reach, Sent, VERTEX_PLACES, commands, counter, golden, numbers,
};
use relief_models::draw::{Assembled, CameraView, Draw, DrawVertex, DropReason, MapInfo};
use relief_models::light::Light;
use relief_models::mip_build::{self, Centring, Extremum, Pyramid, Wrap};
use relief_models::remesher::{BaseTriangle, Format};
use relief_models::rules::ExtremumRule;
use relief_models::step::Vertex;
use std::cell::Cell;

const FORMAT: Format =
    Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 14, column_depth: 4096 };
const NARROW: Format =
    Format { components: 9, vertex_bits: 24, guard_bits: 10, coordinate_bits: 11, column_depth: 512 };

const BANK_WORDS: usize = 1 << 14;
const VIEWPORT: [u32; 2] = [48, 32];

/// Longitude x latitude about the origin; columns 0 and `columns` in one place.
fn sphere(columns: u32, rows: u32) -> (Vec<DrawVertex>, Vec<[u32; 3]>) {
    grid(columns, rows, |u, v| {
        let (longitude, latitude) = (std::f64::consts::TAU * (u % 1.0), std::f64::consts::PI * v);
        let normal = match v {
            0.0 => DVec3::Z,
            1.0 => -DVec3::Z,
            _ => DVec3::new(latitude.sin() * longitude.cos(), latitude.sin() * longitude.sin(), latitude.cos()),
        };
        DrawVertex { position: 0.5 * normal, normal, uv: DVec2::new(u, v) }
    })
}

/// A ground of `width` x 4 units in the plane z = 0. What lies near the eye is large in pixels, and has to be narrow.
fn ground(width: f64, side: u32) -> (Vec<DrawVertex>, Vec<[u32; 3]>) {
    grid(side, side, |u, v| DrawVertex {
        position: DVec3::new(width * (u - 0.5), 4.0 * v - 2.0, 0.0),
        normal: DVec3::Z,
        uv: DVec2::new(u, v),
    })
}

fn grid(columns: u32, rows: u32, vertex: impl Fn(f64, f64) -> DrawVertex) -> (Vec<DrawVertex>, Vec<[u32; 3]>) {
    let at = |i, j| j * (columns + 1) + i;
    let all = (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j)));
    let vertices = all.map(|(i, j)| vertex(f64::from(i) / f64::from(columns), f64::from(j) / f64::from(rows)));
    let quads = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    let triangles = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        [[a, b, c], [a, c, d]]
    });
    (vertices.collect(), triangles.collect())
}

fn camera(eye: DVec3, target: DVec3) -> CameraView {
    CameraView {
        eye,
        target,
        up: DVec3::new(0.1, 0.2, 1.0),
        fov_y: 0.9,
        near: 0.16,
        far: 50.0,
        viewport: VIEWPORT,
        cell_px: 4.0,
    }
}

const MAP: MapInfo = MapInfo { width: 16, height: 9, repeat: [true, false], levels: 3 };

/// Maxima and minima.
fn pyramids() -> [Pyramid; 2] {
    let samples: Vec<u16> = (0..16 * 9).map(|k: u32| (k * 7919 % 65_536) as u16).collect();
    let wrap = [Wrap::Repeat, Wrap::Clamp];
    [Extremum::Max, Extremum::Min]
        .map(|extremum| mip_build::golden_with_poles(16, 9, &samples, Centring::Node, wrap, extremum, 3).unwrap())
}

fn light(draw: &Draw) -> Light {
    draw.light(DVec3::new(0.4, -0.7, 0.9)).unwrap()
}

type Lit = ([Vertex; 3], [u8; 3]);

/// What the machine sends for a draw: triangles and counters.
fn machine(draw: &Draw, format: &Format, skips: bool) -> (Vec<Lit>, Vec<(u64, Option<u32>)>) {
    let mut machine = Machine::new(format, VERTEX_PLACES, BANK_WORDS);
    run(&mut machine, &commands(draw, &pyramids(), &light(draw), VIEWPORT, skips))
}

fn run(machine: &mut Machine, commands: &[Command]) -> (Vec<Lit>, Vec<(u64, Option<u32>)>) {
    let (mut triangles, mut reports) = (Vec::new(), Vec::new());
    for command in commands {
        machine.accept(command, &mut |sent| match sent {
            Sent::Triangle { vertices, colour } => triangles.push((vertices, colour)),
            Sent::Report { counter, value } => reports.push((counter, value)),
        });
    }
    assert!(!machine.error());
    (triangles, reports)
}

/// What the harness makes of the same draw, and how many of its triangles have no place and are off the screen.
fn chain(draw: &Draw, format: &Format, skips: bool) -> (Vec<Lit>, [u64; 2]) {
    let (pyramids, light) = (pyramids(), light(draw));
    let (mut out, mut left_out) = (Vec::new(), [0; 2]);
    let half = VIEWPORT.map(|side| i64::from(side) * 128);
    let mut take = |triangle: [Vertex; 3]| {
        let on = |lane: usize| {
            let at = triangle.map(|vertex| vertex[lane]);
            *at.iter().max().unwrap() >= -half[lane] && *at.iter().min().unwrap() <= half[lane]
        };
        match () {
            () if !Draw::is_drawable(&triangle) => left_out[0] += 1,
            () if skips && !(on(0) && on(1)) => left_out[1] += 1,
            () => out.push((triangle, draw.shade(triangle, &[light]))),
        }
    };
    for index in 0..draw.triangles.len() {
        for piece in draw.assemble(index).pieces() {
            if draw.is_flat() {
                take(piece.data.map(|vertex| draw.displace(&vertex, 0)));
            } else {
                golden(draw, format, &pyramids, piece, &mut take);
            }
        }
    }
    (out, left_out)
}

/// Compares the two, with and without skipping, and returns the counters without it.
fn compare(draw: &Draw, format: &Format) -> Vec<u64> {
    let mut first = None;
    for skips in [false, true] {
        let (triangles, reports) = machine(draw, format, skips);
        let (expected, left_out) = chain(draw, format, skips);
        assert!(triangles.len() == expected.len() && triangles == expected);
        assert!(reports.iter().map(|(number, _)| *number as usize).eq(counter::all()));
        assert!(reports.iter().all(|(number, value)| value.is_none() == counter::TIMES.contains(&(*number as usize))));
        let counts: Vec<u64> = reports.iter().filter_map(|(_, value)| value.map(u64::from)).collect();
        let sum = |from: usize, count: usize| counts[from..from + count].iter().sum::<u64>();
        assert_eq!(counts[counter::BASES], draw.triangles.len() as u64);
        let (mut kept, mut of_pieces) = (0, 0);
        let mut by_reason = [0; 20];
        for index in 0..draw.triangles.len() {
            let assembled = draw.assemble(index);
            of_pieces += assembled.pieces().len() as u64;
            match assembled {
                Assembled::Culled(reason) => by_reason[counter::CULLED + reason as usize] += 1,
                Assembled::Dropped(reason) => by_reason[counter::DROPPED + reason as usize] += 1,
                Assembled::Kept(_) => kept += 1,
                Assembled::Cut(_) => (kept, by_reason[counter::CUT]) = (kept + 1, by_reason[counter::CUT] + 1),
            }
        }
        assert_eq!(counts[1..11], by_reason[1..11]);
        assert_eq!(counts[counter::BASES], sum(counter::CULLED, 6) + sum(counter::DROPPED, 3) + kept);
        assert_eq!(counts[counter::PIECES], of_pieces);
        // A vertex that is skipped is off the screen, and may have had no place.
        let skipped = counts[counter::SKIPPED] > 0;
        let of_counts = [sum(counter::NO_PLACE, 3), counts[counter::OFF_SCREEN]];
        assert_eq!(of_counts.iter().sum::<u64>(), left_out.iter().sum::<u64>());
        assert!(of_counts[0] <= left_out[0] && (skipped || of_counts[0] == left_out[0]) && (skips || !skipped));
        assert_eq!(counts[counter::SENT], triangles.len() as u64);
        let dropped = [8, 9, 10, 15, 16, 17].into_iter().enumerate();
        assert_eq!(
            counts[counter::LOST],
            dropped.map(|(bit, number)| u64::from(counts[number] > 0) << bit).sum::<u64>()
        );
        assert_eq!(counts[counter::STRIP_TRIANGLES], sum(counter::NO_PLACE, 5));
        if draw.is_flat() {
            assert_eq!([counter::STEPS, counter::VERTICES].map(|k| counts[k]), [2 * of_pieces, 3 * of_pieces]);
        }
        first.get_or_insert(counts);
    }
    first.unwrap()
}

fn draw(view: &CameraView, mesh: &(Vec<DrawVertex>, Vec<[u32; 3]>), displacement: [f64; 2], format: &Format) -> Draw {
    Draw::new(view, &mesh.0, &mesh.1, &MAP, displacement, format).unwrap()
}

#[test]
fn machine_cuts_and_culls_as_the_chain_does() {
    // Over the ground, low: some of it behind the eye.
    let view = camera(DVec3::new(0.01, -0.9, 0.03), DVec3::new(0.01, 1.0, 0.02));
    for format in [FORMAT, NARROW] {
        for side in [1, 4] {
            let mut draw = draw(&view, &ground(0.1, side), [-0.002, 0.005], &format);
            let counts = compare(&draw, &format);
            println!("ground of {side}: {counts:?}");
            assert!(counts[counter::CUT] > 0 && counts[counter::SENT] > 100);
            assert!(counts[counter::PIECES] > counts[counter::CUT]);
            assert!(side == 1 || counts[counter::CULLED..][..6].iter().any(|count| *count > 0));
            draw.cull = false;
            let counts = compare(&draw, &format);
            assert!(counts[counter::CULLED..][..6].iter().all(|count| *count == 0));
            assert!(side == 1 || counts[counter::DROPPED + DropReason::Near as usize] > 0);
        }
    }
}

#[test]
fn machine_leaves_out_triangles_without_a_place() {
    // Displaced as far as the eye and beyond.
    let view = camera(DVec3::new(0.0, -0.7, 0.5), DVec3::new(0.0, 0.4, 0.0));
    let draw = draw(&view, &ground(1.0, 2), [-0.2, 0.9], &FORMAT);
    let counts = compare(&draw, &FORMAT);
    println!("without a place: {:?}", &counts[counter::STRIP_TRIANGLES..]);
    assert!(counts[counter::NO_PLACE..][..3].iter().sum::<u64>() > 0);
    let (triangles, _) = machine(&draw, &FORMAT, true);
    assert!(triangles.iter().all(|(vertices, _)| vertices.iter().all(|vertex| vertex[displaced::FLAGS] == 0)));
}

#[test]
fn machine_takes_a_body_in_groups() {
    let body = sphere(32, 24);
    assert!(body.0.len() > VERTEX_PLACES);
    let view = camera(DVec3::new(0.7, -1.1, 0.4), DVec3::ZERO);
    let draw = draw(&view, &body, [-0.02, 0.1], &FORMAT);
    let counts = compare(&draw, &FORMAT);
    assert_eq!(counts[counter::BASES], body.1.len() as u64);
    // Every place fits, constant 0 comes once, and no triangle names a vertex that has not come.
    let all = commands(&draw, &pyramids(), &light(&draw), VIEWPORT, false);
    let first = all.iter().filter(|command| matches!(command, Command::Constant { number: 0, .. }));
    assert_eq!(first.count(), 1);
    let (mut filled, mut records) = ([false; VERTEX_PLACES], 0);
    for command in &all {
        match command {
            Command::Record { place, .. } => (filled[*place], records) = (true, records + 1),
            Command::Triangle { places } => assert!(places.iter().all(|place| filled[*place])),
            _ => {}
        }
    }
    assert!(records > body.0.len(), "the border of two groups is sent twice");
}

/// By maxima, by minima, and by minima where a vertex faces away: three bodies, where voxels are larger than texels.
#[test]
fn machine_reads_maxima_or_minima() {
    let view = CameraView { cell_px: 40.0, ..camera(DVec3::new(0.7, -1.1, 0.4), DVec3::ZERO) };
    let mut draw = draw(&view, &sphere(8, 6), [-0.02, 0.1], &FORMAT);
    let bodies = [ExtremumRule::Max, ExtremumRule::Min, ExtremumRule::Vertex].map(|extremum| {
        draw.rules.extremum = extremum;
        for cull in [false, true] {
            draw.cull = cull;
            compare(&draw, &FORMAT);
        }
        draw.cull = false;
        machine(&draw, &FORMAT, false).0
    });
    assert!(bodies[0] != bodies[1] && bodies[1] != bodies[2] && bodies[0] != bodies[2]);
}

#[test]
fn machine_passes_what_is_not_displaced() {
    let view = camera(DVec3::new(0.1, -1.0, 0.3), DVec3::new(0.3, 1.0, 0.0));
    let draw = draw(&view, &ground(1.0, 1), [0.0, 0.0], &FORMAT);
    assert!(draw.is_flat());
    let counts = compare(&draw, &FORMAT);
    assert_eq!(counts[counter::STRIP_TRIANGLES], counts[counter::PIECES]);
    assert!(counts[counter::CUT] > 0 && counts[counter::SENT] > 0);
}

#[test]
fn machine_counts_by_draw_and_keeps_the_map() {
    let view = camera(DVec3::new(0.1, -1.0, 0.4), DVec3::new(0.3, 1.0, 0.0));
    let draw = draw(&view, &ground(1.0, 2), [-0.02, 0.05], &FORMAT);
    let mut machine = Machine::new(&FORMAT, VERTEX_PLACES, BANK_WORDS);
    let all = commands(&draw, &pyramids(), &light(&draw), VIEWPORT, false);
    let first = run(&mut machine, &all);
    // Without the map again.
    let rest: Vec<Command> =
        all.iter().filter(|c| !matches!(c, Command::Size { .. } | Command::Load { .. })).copied().collect();
    assert_eq!(run(&mut machine, &rest), first);
    // Nothing else is counted: 22, 23 and those above 30 read 0.
    for counter in (22..24).chain(31..128) {
        let (_, reports) = run(&mut machine, &[Command::Report { counter }]);
        assert_eq!(reports, [(counter, Some(0))]);
    }
}

/// The commands of a draw that skips, with another reach and margin.
fn with_reach(draw: &Draw, viewport: [u32; 2], change: impl Fn(i64) -> i64) -> Vec<Command> {
    let mut all = commands(draw, &pyramids(), &light(draw), viewport, true);
    for command in &mut all {
        if let Command::Constant { number: numbers::REACH, value } = command {
            *value = change(*value);
        }
    }
    all
}

/// Triangles of any shape, partly off the screen, their corners displaced any way: what is sent does not depend on skipping, but
/// does on how far a vertex has to be off the screen.
#[test]
fn machine_skips_only_what_is_off_the_screen() {
    let place = || [-1.5..1.5f64, -1.5..1.5, -0.8..0.8].prop_map(DVec3::from_array);
    let normal = || [-1.0..1.0f64, -1.0..1.0, 0.1..1.0].prop_map(DVec3::from_array);
    let corners = [(place(), normal()), (place(), normal()), (place(), normal()), (place(), normal())];
    let cells = prop::sample::select(vec![1.0, 2.0, 4.0, 8.0, 20.0]);
    let view = (-1.4..-0.5f64, 16u32..128, 16u32..128, cells, 0.4..1.6f64);
    // Where displacement does next to nothing, the margin of the columns decides.
    let displacement = ([-0.3..0.0f64, 0.0..0.4], prop::sample::select(vec![1.0, 0.01, 0.0001]));
    let format = prop::sample::select(vec![FORMAT, NARROW]);
    let (skipped, sent) = (Cell::new(0), Cell::new(0));
    // Draws that are another picture without margin, and without reach.
    let wrong = [Cell::new(0), Cell::new(0)];
    let config = ProptestConfig { cases: 400, ..ProptestConfig::default() };
    proptest!(config, |(corners in corners, (eye, width, height, cell_px, fov_y) in view, (heights, scale) in displacement, format in format)| {
        let displacement = heights.map(|height| height * scale);
        let uv = [DVec2::new(0.0, 0.0), DVec2::new(1.0, 0.3), DVec2::new(0.4, 1.0), DVec2::new(1.0, 1.0)];
        let vertex = |k: usize| DrawVertex { position: corners[k].0, normal: corners[k].1, uv: uv[k] };
        let viewport = [width, height];
        let view = CameraView { fov_y, viewport, cell_px, ..camera(DVec3::new(0.1, eye, 0.2), DVec3::new(0.0, 0.0, 0.1)) };
        let made = Draw::new(&view, &[0, 1, 2, 3].map(vertex), &[[0, 1, 2], [2, 1, 3]], &MAP, displacement, &format);
        prop_assume!(made.is_ok());
        let mut draw = made.unwrap();
        draw.cull = false;
        let amount = |index| draw.assemble(index).pieces().iter().map(BaseTriangle::estimate).sum::<u64>();
        prop_assume!(amount(0) + amount(1) < 200_000);
        let mut machine = Machine::new(&format, VERTEX_PLACES, BANK_WORDS);
        let mut with = |change: fn(i64) -> i64| run(&mut machine, &with_reach(&draw, viewport, change));
        let (kept, all) = (with(|value| value), with(|_| (1 << 34) - 1));
        let count = |run: &(Vec<Lit>, Vec<(u64, Option<u32>)>), number: usize| run.1[number].1.unwrap();
        prop_assert!(kept.0 == all.0);
        prop_assert_eq!(count(&all, counter::SKIPPED), 0);
        let vertices = count(&kept, counter::VERTICES) + count(&kept, counter::SKIPPED);
        prop_assert_eq!(vertices, count(&all, counter::VERTICES));
        skipped.set(skipped.get() + count(&kept, counter::SKIPPED));
        sent.set(sent.get() + vertices);
        let others = [with(|value| value % (1 << 17)), with(|value| value >> 17 << 17)];
        for (wrong, other) in wrong.iter().zip(others) {
            wrong.set(wrong.get() + u64::from(other.0 != all.0));
        }
    });
    println!(
        "{} of {} vertices skipped; wrong without margin, and without reach: {wrong:?}",
        skipped.get(),
        sent.get()
    );
    assert!(skipped.get() > sent.get() / 20 && wrong.iter().all(|wrong| wrong.get() > 0));
}

/// Displacement that reaches farther than the format of a reach says, and cells that do: nothing is skipped.
#[test]
fn machine_skips_nothing_where_displacement_reaches_far() {
    let view = camera(DVec3::new(0.1, -1.0, 0.4), DVec3::new(0.3, 1.0, 0.0));
    let half = VIEWPORT.map(|side| i64::from(side) << 7);
    let near = draw(&view, &ground(1.0, 2), [-0.02, 0.05], &FORMAT);
    assert!(Reach::new(&near, half) != Reach::NONE);
    let far = draw(&view, &ground(1.0, 2), [-20.0, 50.0], &FORMAT);
    assert_eq!(Reach::new(&far, half), Reach::NONE);
    let coarse = CameraView { cell_px: 4096.0, ..view };
    assert!(Reach::new(&draw(&coarse, &ground(1.0, 2), [-0.02, 0.05], &FORMAT), half).margin == 49_152);
}
