// SPDX-License-Identifier: MIT OR Apache-2.0
//! The golden datapath from base triangles to displaced triangles: closed meshes, seams, cuts and culling.

use glam::{DVec2, DVec3};
use relief_models::cull::Reason;
use relief_models::displace::{displaced, flag};
use relief_models::draw::{Assembled, CameraView, Counts, Draw, DrawVertex, DropReason, MapInfo, Request};
use relief_models::perspective_correct;
use relief_models::remesher::{self, BaseTriangle, Format, Place};
use relief_models::step::{Step, Vertex};
use relief_models::strip_unit::StripUnit;
use relief_models::vertex_transform::lane;
use std::collections::HashMap;

const FORMAT: Format =
    Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 14, column_depth: 4096 };

/// Uniform numbers, the same in every run.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::from_array(std::array::from_fn(|_| self.between(-1.0, 1.0)));
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

/// Longitude x latitude: one pole vertex a column, columns 0 and `columns` in one place, triangles without area kept.
fn sphere(columns: u32, rows: u32, radius: f64) -> (Vec<DrawVertex>, Vec<[u32; 3]>) {
    let mut vertices = Vec::new();
    for j in 0..=rows {
        for i in 0..=columns {
            let (turn, fall) = (f64::from(i % columns) / f64::from(columns), f64::from(j) / f64::from(rows));
            let (longitude, latitude) = (std::f64::consts::TAU * turn, std::f64::consts::PI * fall);
            let normal = match j {
                0 => DVec3::Z,
                j if j == rows => -DVec3::Z,
                _ => DVec3::new(latitude.sin() * longitude.cos(), latitude.sin() * longitude.sin(), latitude.cos()),
            };
            let uv = DVec2::new(f64::from(i) / f64::from(columns), fall);
            vertices.push(DrawVertex { position: radius * normal, normal, uv });
        }
    }
    let at = |i, j| j * (columns + 1) + i;
    let quads = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    let triangles = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        [[a, b, c], [a, c, d]]
    });
    (vertices, triangles.collect())
}

/// A node-centred maximum pyramid: u repeats, v is clamped and its rows 0 and last are poles.
struct Pyramid {
    levels: Vec<(usize, usize, Vec<u16>)>,
}

impl Pyramid {
    fn new(width: usize, height: usize, levels: usize, texel: impl Fn(usize, usize) -> u16) -> Pyramid {
        let pole = |row: &mut [u16]| row.fill(*row.iter().max().unwrap());
        let poles = |width: usize, height: usize, data: &mut [u16]| {
            pole(&mut data[..width]);
            pole(&mut data[(height - 1) * width..]);
        };
        let mut base: Vec<u16> = (0..width * height).map(|k| texel(k % width, k / width)).collect();
        poles(width, height, &mut base);
        let mut all = vec![(width, height, base)];
        while all.len() < levels {
            let (w, h, below) = all.last().unwrap();
            let (w1, h1) = (w / 2, h / 2 + 1);
            let mut data = vec![0; w1 * h1];
            for (k, out) in data.iter_mut().enumerate() {
                let (i, j) = ((k % w1 * 2) as i64, (k / w1 * 2) as i64);
                *out = (-1..=1)
                    .flat_map(|y| (-1..=1).map(move |x| (x, y)))
                    .map(|(x, y)| {
                        let row = (j + y).clamp(0, *h as i64 - 1) as usize;
                        below[row * w + (i + x).rem_euclid(*w as i64) as usize]
                    })
                    .max()
                    .unwrap();
            }
            poles(w1, h1, &mut data);
            all.push((w1, h1, data));
        }
        Pyramid { levels: all }
    }

    /// Bilinear, 12-bit weights, UQ16.8.
    fn fetch(&self, request: Request) -> u32 {
        let (w, h, data) = &self.levels[request.level as usize];
        let at = |x: u32| ((x >> (16 + request.level)) as usize, u64::from(x >> request.level >> 4 & 0xfff));
        let ((i, a), (j, b)) = (at(request.u), at(request.v));
        let tap = |i: usize, j: usize| u64::from(data[j.min(h - 1) * w + i % w]);
        let row = |j| tap(i, j) * (4096 - a) + tap(i + 1, j) * a;
        ((row(j) * (4096 - b) + row(j + 1) * b + (1 << 15)) >> 16) as u32
    }
}

/// Base triangle to displaced triangles, as the machine does it.
fn displaced_triangles(draw: &Draw, base: &BaseTriangle, mut height: impl FnMut(Request) -> u32) -> Vec<[Vertex; 3]> {
    heighten(draw, base, |v| height(draw.request(v)))
}

/// As `displaced_triangles`, with a height for each vertex.
fn heighten(draw: &Draw, base: &BaseTriangle, mut height: impl FnMut(&Vertex) -> u32) -> Vec<[Vertex; 3]> {
    base.validate(&FORMAT).unwrap();
    let mut unit = StripUnit::new(FORMAT.column_depth);
    let mut out = Vec::new();
    remesher::golden(&FORMAT, base, &mut |step| {
        let mut step: Step = *step;
        let mut displace = |v: &mut Vertex| *v = draw.displace(v, height(v));
        if step.sends_left() {
            displace(&mut step.left_vertex);
        }
        if step.sends_right() {
            displace(&mut step.right_vertex);
        }
        out.extend(unit.accept(&step).triangles());
    });
    assert!(!unit.error());
    out
}

type Point = [i64; 3];

/// Directed edges that no other triangle runs back along.
#[derive(Default)]
struct Edges(HashMap<(Point, Point), i64>);

impl Edges {
    fn add(&mut self, triangle: [Point; 3]) {
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            if a != b {
                *self.0.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
            }
        }
    }
    fn open(&self) -> impl Iterator<Item = (Point, Point)> {
        self.0.iter().filter(|(_, count)| **count != 0).map(|(edge, _)| *edge)
    }
}

fn camera(eye: DVec3, target: DVec3, cell_px: f64) -> CameraView {
    CameraView {
        eye,
        target,
        up: DVec3::new(0.1, 0.2, 1.0),
        fov_y: 45f64.to_radians(),
        near: 0.1,
        far: 50.0,
        viewport: [640, 480],
        cell_px,
    }
}

const MAP: MapInfo = MapInfo { width: 256, height: 129, repeat: [true, false], levels: 4 };

fn hills(i: usize, j: usize) -> u16 {
    // Rough enough that any vertex that is fetched elsewhere shows.
    ((i * 7919 + j * 104_729 + i * j * 31) % 65_536) as u16
}

#[test]
fn displaced_sphere_has_no_open_edge() {
    let mut random = Random(3);
    let (vertices, mut triangles) = sphere(16, 8, 0.5);
    let pyramid = Pyramid::new(MAP.width, MAP.height, MAP.levels, hills);
    let (mut total, mut levels) = (0, [0u64; 4]);
    // Small cells from farther away, or there would be millions of triangles.
    for (cell, nearest, cameras) in [(1.0, 5.0, 2), (2.0, 2.5, 3), (5.0, 0.9, 6), (20.0, 0.9, 8)] {
        for _ in 0..cameras {
            // Base triangles in any order, from any of their corners on.
            for at in 0..triangles.len() {
                triangles[at].rotate_left(random.between(0.0, 3.0) as usize);
                triangles.swap(at, random.between(0.0, at as f64 + 1.0) as usize);
            }
            let eye = random.between(nearest, 6.0) * random.direction();
            let view = camera(eye, 0.1 * random.direction(), cell);
            let mut draw = Draw::new(&view, &vertices, &triangles, &MAP, [-0.02, 0.1], &FORMAT).unwrap();
            assert!(draw.seams_are_exact());
            draw.cull = false;
            let mut edges = Edges::default();
            for index in 0..triangles.len() {
                let Assembled::Kept(piece) = draw.assemble(index) else { panic!("base triangle {index} is gone") };
                let height = |request: Request| {
                    levels[request.level as usize] += 1;
                    pyramid.fetch(request)
                };
                for triangle in displaced_triangles(&draw, &piece, height) {
                    assert!(Draw::is_drawable(&triangle));
                    edges.add(triangle.map(|v| [v[0], v[1], v[2]]));
                    total += 1;
                }
            }
            assert_eq!(edges.open().count(), 0, "cell {cell}, eye {eye}");
        }
    }
    println!("closed: {total} triangles, vertices by level {levels:?}");
    assert!(total > 100_000 && levels.iter().all(|&n| n > 0));
}

/// Open edges of the sphere under a map of `map` where `height` makes the height of a vertex; z/z0 is about 14,000.
fn open_edges(cell_px: f64, map: &MapInfo, height: impl Fn(&Draw, &Pyramid, &Vertex) -> u32) -> usize {
    let (vertices, triangles) = sphere(16, 8, 0.5);
    let pyramid = Pyramid::new(map.width, map.height, map.levels, hills);
    let view = CameraView { near: 0.003, ..camera(DVec3::new(0.3, -1.4, -2.2), DVec3::ZERO, cell_px) };
    let mut draw = Draw::new(&view, &vertices, &triangles, map, [-0.02, 0.1], &FORMAT).unwrap();
    assert!(draw.seams_are_exact());
    draw.cull = false;
    let mut edges = Edges::default();
    for index in 0..triangles.len() {
        let Assembled::Kept(piece) = draw.assemble(index) else { panic!("base triangle {index} is gone") };
        for triangle in heighten(&draw, &piece, |v| height(&draw, &pyramid, v)) {
            edges.add(triangle.map(|v| [v[0], v[1], v[2]]));
        }
    }
    edges.open().count()
}

#[test]
fn sphere_opens_without_the_snap_and_off_the_nodes() {
    let plain = |draw: &Draw, pyramid: &Pyramid, v: &Vertex| pyramid.fetch(draw.request(v));
    assert_eq!(open_edges(4.0, &MAP, plain), 0);
    // Counterexample to plain division: the seam column asks for u = period - something.
    let without_snap = open_edges(4.0, &MAP, |draw, pyramid, v| {
        let inverse = perspective_correct::inverse(v[lane::C]);
        let [u, v_row] = [0, 1].map(|k| {
            let axis = draw.axes[k];
            let texel = perspective_correct::divide(v[lane::U + k], inverse, axis.texel_bits);
            let period = i64::from(axis.size) << 16;
            if axis.repeat { texel % period } else { texel.min(period - (1 << 16)) }
        });
        pyramid.fetch(Request { u: u as u32, v: v_row as u32, ..draw.request(v) })
    });
    // Counterexample to poles on any map: with 130 rows the last row, 129, lies between nodes of level 1, and the row
    // before, which is not constant, takes part. Pole rows need height - 1 to be a multiple of 2^(levels - 1).
    let off_the_nodes = open_edges(20.0, &MapInfo { height: 130, ..MAP }, plain);
    println!("open edges: {without_snap} without the snap, {off_the_nodes} with 130 rows");
    assert!(without_snap > 0 && off_the_nodes > 0);
}

/// The vertices along edge 0 of a base triangle, by their number from the low end.
fn along_edge_0(base: &BaseTriangle) -> HashMap<Place, Vertex> {
    let mut sent = HashMap::new();
    remesher::observe(&FORMAT, base, &mut |step, rung| {
        if step.sends_left() {
            sent.insert(rung.next_left, step.left_vertex);
        }
        if step.sends_right() {
            sent.insert(rung.next_right, step.right_vertex);
        }
    });
    sent.retain(|place, _| matches!(place, Place::Corner(0 | 1) | Place::Edge { edge: 0, .. }));
    sent
}

#[test]
fn seams_and_poles_ask_for_equal_texels() {
    let mut random = Random(11);
    let (mut compared, mut without_snap, mut pole_without_snap, mut deepest) = (0, 0, 0, 0.0f64);
    for k in 0..600 {
        // u = 1024 takes 11 bits in front of the point: z/z0 up to 8192 there, see `seams_are_exact`.
        let (size, depth) = [(64, 4.0), (512, 4.0), (1000, 4.0), (1024, 3.9)][k % 4];
        let map = MapInfo { width: size, height: size / 2 + 1, repeat: [true, false], levels: 4 };
        let near = 0.016;
        // z0 = 0.001: one end near it, the other one up to 10^4 times as far.
        let end = |random: &mut Random| {
            let z = 0.001 * 10f64.powf(random.between(0.1, depth));
            DVec3::new(z * random.between(-0.6, 0.6), z, z * random.between(-0.4, 0.4))
        };
        let (a, b) = (end(&mut random), end(&mut random));
        deepest = deepest.max(a.y.max(b.y) / 0.001);
        let side =
            |random: &mut Random| 0.5 * (a + b) * random.between(0.5, 1.0) + 0.1 * random.direction() * a.y.min(b.y);
        let vertex = |position, u, v| DrawVertex { position, normal: DVec3::Z, uv: DVec2::new(u, v) };
        let (va, vb) = if k % 3 == 0 { (1.0, 1.0) } else { (random.unit(), random.unit()) };
        let vertices = [
            vertex(a, 0.0, va),
            vertex(b, 0.0, vb),
            vertex(side(&mut random), 0.1, 0.5),
            vertex(a, 1.0, va),
            vertex(b, 1.0, vb),
            vertex(side(&mut random), 0.9, 0.5),
        ];
        let view = CameraView {
            near,
            target: DVec3::Y,
            cell_px: random.between(2.0, 12.0),
            ..camera(DVec3::ZERO, DVec3::Y, 1.0)
        };
        let triangles = [[0, 1, 2], [4, 3, 5]];
        let mut draw = Draw::new(&view, &vertices, &triangles, &map, [0.0, 0.0], &FORMAT).unwrap();
        assert!(draw.seams_are_exact());
        draw.cull = false;
        let [left, right] = [0, 1].map(|index| match draw.assemble(index) {
            Assembled::Kept(piece) => along_edge_0(&piece),
            other => panic!("{other:?}"),
        });
        assert_eq!(left.len(), right.len());
        for (place, vertex) in &left {
            // The triangles run along the edge in opposite directions.
            let back = match place {
                Place::Corner(corner) => Place::Corner(1 - corner),
                place => *place,
            };
            let other = &right[&back];
            assert_eq!(vertex[..6], other[..6]);
            assert_eq!((vertex[lane::U], vertex[lane::V]), (0, other[lane::V]));
            assert_eq!(draw.request(vertex), draw.request(other), "z/z0 up to {deepest}");
            let inverse = perspective_correct::inverse(other[lane::C]);
            let raw = |k: usize| perspective_correct::divide(other[lane::U + k], inverse, draw.axes[k].texel_bits);
            without_snap += u64::from(raw(0) % (i64::from(draw.axes[0].size) << 16) != 0);
            if va == 1.0 && vb == 1.0 {
                let pole = (draw.axes[1].size - 1) << 16;
                assert_eq!(draw.request(vertex).v, pole);
                pole_without_snap += u64::from(raw(1) != i64::from(pole));
            }
            compared += 1;
        }
    }
    println!(
        "seams: {compared} vertices to z/z0 {deepest:.0}; without the snap {without_snap} differ, {pole_without_snap} at poles"
    );
    // The counterexample to plain division: it is why the snap is there.
    assert!(compared > 10_000 && deepest > 9_000.0 && without_snap > 100 && pole_without_snap > 10);
}

#[test]
fn snap_at_its_borders() {
    use perspective_correct::{Axis, SNAP, snap};
    let repeat = Axis { size: 64, repeat: true, texel_bits: 7 };
    let clamp = Axis { size: 64, repeat: false, texel_bits: 6 };
    let (period, last) = (64 << 16, 63 << 16);
    for (u, want) in [
        (0, 0),
        (SNAP, 0),
        (SNAP + 1, SNAP + 1),
        (period - SNAP - 1, period - SNAP - 1),
        (period - SNAP, 0),
        (period, 0),
        (period + SNAP, 0),
        (period + SNAP + 1, SNAP + 1),
        (2 * period - SNAP - 1, period - SNAP - 1),
        (2 * period - SNAP, 0),
        (2 * period, 0),
        (2 * period + SNAP, 0),
    ] {
        assert_eq!(i64::from(snap(u, &repeat)), want, "{u}");
    }
    for (u, want) in [
        (0, 0),
        (SNAP, 0),
        (SNAP + 1, SNAP + 1),
        (last - SNAP - 1, last - SNAP - 1),
        (last - SNAP, last),
        (last + 9, last),
    ] {
        assert_eq!(i64::from(snap(u, &clamp)), want, "{u}");
    }
    for repeat in [false, true] {
        for u in [0, 5, 1 << 16, 1 << 17] {
            assert_eq!(snap(u, &Axis { size: 1, repeat, texel_bits: 1 }), 0);
        }
    }
}

/// A camera close to the sphere, inside it or out.
fn close_camera(random: &mut Random) -> CameraView {
    let eye = random.between(0.3, 0.9) * random.direction();
    camera(eye, eye + random.direction(), 64.0)
}

#[test]
fn cut_triangles_stay_closed_but_for_the_planes() {
    let mut random = Random(5);
    let (vertices, triangles) = sphere(12, 6, 0.5);
    let (mut whole, mut cuts, mut rim) = (0, 0, 0);
    for _ in 0..200 {
        let view = CameraView { near: 1.0, ..close_camera(&mut random) };
        let mut draw = Draw::new(&view, &vertices, &triangles, &MAP, [0.0, 0.01], &FORMAT).unwrap();
        draw.cull = false;
        let (mut edges, mut counts) = (Edges::default(), Counts::default());
        for index in 0..triangles.len() {
            let assembled = draw.assemble(index);
            counts.count(&assembled);
            match assembled {
                Assembled::Kept(_) | Assembled::Cut(_) => {
                    for piece in assembled.pieces() {
                        piece.validate(&FORMAT).unwrap();
                        edges.add(piece.data.map(|v| [v[0], v[1], v[2]]));
                    }
                }
                other => assert_eq!(other, Assembled::Dropped(DropReason::Near)),
            }
        }
        assert_eq!(counts.kept + counts.dropped.near, triangles.len() as u64);
        assert!(counts.cut > 0 || counts.pieces == counts.kept);
        whole += counts.kept - counts.cut;
        cuts += counts.pieces - counts.kept;
        for (a, b) in edges.open() {
            let guard = 8189 << 18;
            let on = |p: Point| [p[2] >= i64::from(i32::MAX) - 1, p[0].abs() > guard, p[1].abs() > guard];
            let common = (0..3).any(|k| on(a)[k] && on(b)[k]);
            assert!(common, "open edge {a:?} {b:?} inside");
            rim += 1;
        }
    }
    println!("cut: {cuts} further pieces, {rim} rim segments");
    assert!(cuts > 100 && rim > 100 && whole > 100);
}

#[test]
fn cull_never_takes_what_is_visible() {
    let mut random = Random(17);
    let (vertices, triangles) = sphere(12, 6, 0.5);
    let pyramid = Pyramid::new(MAP.width, MAP.height, MAP.levels, hills);
    let (mut counts, mut checked) = (Counts::default(), 0);
    for _ in 0..60 {
        let reach = [random.between(-0.2, 0.0), random.between(0.0, 0.2)];
        let view = CameraView { far: random.between(0.5, 2.0), ..close_camera(&mut random) };
        let draw = Draw::new(&view, &vertices, &triangles, &MAP, reach, &FORMAT).unwrap();
        let mut all = draw.clone();
        all.cull = false;
        for index in 0..triangles.len() {
            let assembled = draw.assemble(index);
            counts.count(&assembled);
            let Assembled::Culled(reason) = assembled else { continue };
            let all_of_it = all.assemble(index);
            for triangle in
                all_of_it.pieces().iter().flat_map(|piece| displaced_triangles(&all, piece, |r| pyramid.fetch(r)))
            {
                for v in triangle.iter().filter(|v| v[displaced::FLAGS] == 0) {
                    let [x, y] = [v[0], v[1]].map(|x| x as f64 / 256.0);
                    let z = draw.z0() * 2_147_483_648.0 / v[2] as f64;
                    let outside = match reason {
                        Reason::Left => x < -319.9,
                        Reason::Right => x > 319.9,
                        Reason::Top => y < -239.9,
                        Reason::Bottom => y > 239.9,
                        Reason::Near => z < draw.z0(),
                        Reason::Far => z > 0.999 * view.far,
                    };
                    assert!(outside, "{reason:?} culls a vertex at {x}, {y}, {z}");
                    checked += 1;
                }
            }
        }
    }
    println!("cull: {counts:?}, {checked} vertices checked");
    assert!(checked > 100_000 && counts.kept > 100);
    assert!(counts.culled.named().iter().all(|(name, n)| *n > 10 || *name == "near"));
}

#[test]
fn displace_matches_f64() {
    let mut random = Random(23);
    let (vertices, triangles) = sphere(16, 8, 0.5);
    let pyramid = Pyramid::new(MAP.width, MAP.height, MAP.levels, hills);
    let (mut pixels, mut depth, mut square, mut count, mut flat) = (0.0f64, 0.0f64, 0.0, 0.0, 0.0f64);
    for _ in 0..12 {
        let eye = random.between(0.75, 6.0) * random.direction();
        let view = camera(eye, 0.3 * random.direction(), 6.0);
        let draw = Draw::new(&view, &vertices, &triangles, &MAP, [-0.05, 0.2], &FORMAT).unwrap();
        let level = Draw::new(&view, &vertices, &triangles, &MAP, [0.0, 0.0], &FORMAT).unwrap();
        for index in 0..triangles.len() {
            let assembled = draw.assemble(index);
            let pieces = assembled.pieces();
            let mut check = |v: &Vertex| {
                if v[lane::X].abs() > 320 << 18 || v[lane::Y].abs() > 240 << 18 {
                    return;
                }
                let q = pyramid.fetch(draw.request(v));
                let got = draw.displace(v, q);
                if got[displaced::FLAGS] == 0 && got[0].abs() < 320 << 8 && got[1].abs() < 240 << 8 {
                    let want = relief_models::displace::exact(
                        &draw.displacement,
                        &v.map(|lane| lane as f64),
                        f64::from(q) / 256.0,
                    )
                    .unwrap();
                    for k in 0..2 {
                        let error = (got[k] as f64 / 256.0 - want[k]).abs();
                        (pixels, square, count) = (pixels.max(error), square + error * error, count + 1.0);
                    }
                    depth = depth.max((got[2] as f64 / 2_147_483_648.0 / want[2] - 1.0).abs());
                }
                let plain = level.displace(v, q);
                assert_eq!(plain[displaced::FLAGS], 0);
                for k in 0..2 {
                    flat = flat.max((plain[k] as f64 / 256.0 - v[k] as f64 / 262_144.0).abs());
                }
                assert!((0..=2).contains(&(v[lane::C] - plain[2])), "{} {}", v[lane::C], plain[2]);
            };
            for piece in pieces {
                remesher::golden(&FORMAT, piece, &mut |step| {
                    if step.sends_left() {
                        check(&step.left_vertex);
                    }
                    if step.sends_right() {
                        check(&step.right_vertex);
                    }
                });
            }
        }
    }
    let rms = (square / count).sqrt();
    println!("displace: {count} coordinates, max {pixels:.4} px, rms {rms:.4} px, c' {depth:.2e}; flat {flat:.5} px");
    assert!(count > 50_000.0 && pixels <= 0.016 && depth <= 5e-5);
    assert!(flat <= 1.0 / 256.0);
}

#[test]
fn vertices_beyond_the_eye_are_flagged() {
    let vertex = |position| DrawVertex { position, normal: -DVec3::Y, uv: DVec2::ZERO };
    let vertices = [DVec3::new(-1.0, 4.0, -1.0), DVec3::new(1.0, 4.0, -1.0), DVec3::new(0.0, 4.0, 1.0)].map(vertex);
    let view = CameraView { near: 1.0, ..camera(DVec3::ZERO, DVec3::Y, 8.0) };
    let draw = Draw::new(&view, &vertices, &[[0, 1, 2]], &MAP, [0.0, 8.0], &FORMAT).unwrap();
    let Assembled::Kept(piece) = draw.assemble(0) else { panic!() };
    let flags = |d: f64| draw.displace(&piece.data[0], (d / 8.0 * 65535.0 * 256.0) as u32)[displaced::FLAGS];
    // z0 = 1/16.
    assert_eq!(
        [0.0, 3.9, 3.95, 3.99, 4.0, 8.0].map(flags),
        [0, 0, flag::NEAR, flag::INVALID, flag::INVALID, flag::INVALID]
    );
    let side = Draw::new(
        &view,
        &vertices.map(|v| DrawVertex { normal: DVec3::X, ..v }),
        &[[0, 1, 2]],
        &MAP,
        [0.0, 80.0],
        &FORMAT,
    )
    .unwrap();
    let Assembled::Kept(piece) = side.assemble(0) else { panic!() };
    assert_eq!(side.displace(&piece.data[0], 65535 << 8)[displaced::FLAGS], flag::RANGE);
}
