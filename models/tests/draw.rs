// SPDX-License-Identifier: MIT OR Apache-2.0
//! Blocks of the displacement datapath against f64, and what the host refuses.

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use relief_models::cull::{self, Corner, Reason, Verdict};
use relief_models::displace::displaced;
use relief_models::draw::{Assembled, CameraView, Draw, DrawError, DrawVertex, DropReason, MapInfo};
use relief_models::face_normal::{self, Pixel};
use relief_models::filter_level;
use relief_models::light::{self, Light, Material};
use relief_models::remesher::Format;
use relief_models::rsqrt::normalize;
use relief_models::vertex_transform::{self, OutOfRange, Source, ViewVertex, lane};

const FORMAT: Format =
    Format { components: 9, vertex_bits: 32, guard_bits: 13, coordinate_bits: 14, column_depth: 4096 };

const MAP: MapInfo = MapInfo { width: 512, height: 257, repeat: [true, false], levels: 5 };

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

fn camera() -> CameraView {
    CameraView {
        eye: DVec3::ZERO,
        target: DVec3::Y,
        up: DVec3::Z,
        fov_y: 1.0,
        near: 0.16,
        far: 100.0,
        viewport: [640, 480],
        cell_px: 1.0,
    }
}

fn vertex(position: DVec3) -> DrawVertex {
    DrawVertex { position, normal: DVec3::X, uv: DVec2::ZERO }
}

/// A triangle and what it needs.
fn triangle(corners: [DVec3; 3]) -> Result<Draw, DrawError> {
    Draw::new(&camera(), &corners.map(vertex), &[[0, 1, 2]], &MAP, [0.0, 0.1], &FORMAT)
}

const CORNERS: [DVec3; 3] = [DVec3::new(-1.0, 4.0, 0.0), DVec3::new(1.0, 4.0, 0.0), DVec3::new(0.0, 5.0, 1.0)];

#[test]
fn vertex_transform_matches_f64() {
    let mut random = Random(1);
    let mut worst = [0.0f64; 9];
    let mut depth = 0.0f64;
    let mut checked = 0;
    for _ in 0..2_000 {
        let camera = CameraView {
            cell_px: random.between(1.0, 20.0),
            near: 10f64.powf(random.between(-1.0, 0.5)),
            eye: random.direction() * random.between(0.0, 5.0),
            target: 6.0 * random.direction(),
            fov_y: random.between(0.2, 1.5),
            ..camera()
        };
        let vertices: Vec<_> = (0..6)
            .map(|_| DrawVertex {
                position: random.direction() * 20f64.powf(random.unit()),
                normal: random.direction(),
                uv: DVec2::new(random.unit(), random.unit()),
            })
            .collect();
        let draw = Draw::new(&camera, &vertices, &[[0, 1, 2], [3, 4, 5]], &MAP, [0.0, 0.1], &FORMAT).unwrap();
        for (record, source) in draw.records.iter().zip(&vertices) {
            let view = vertex_transform::view(&draw.transform, record);
            let along = (camera.target - camera.eye).normalize();
            let unit = draw.z0() / draw.transform.z0 as f64;
            assert!((view.position[2] as f64 * unit - along.dot(source.position - camera.eye)).abs() < 1e-7);
            if view.position[2] < draw.transform.z0 {
                continue;
            }
            let Ok(projected) = vertex_transform::project(&draw.transform, &view) else { continue };
            let exact = vertex_transform::exact(&draw.transform, &view);
            for k in 0..9 {
                // X and Y may be far out of the viewport: in units of their error bound there.
                let scale = if k < 2 { 1.0 + exact[k].abs() * 1e-9 } else { 1.0 };
                worst[k] = worst[k].max((projected.data[k] as f64 - exact[k]).abs() / scale);
            }
            let c = projected.data[lane::C] as f64 - exact[lane::C];
            assert!((-2.2..1.0).contains(&c), "{c}");
            let pixel = 2.0 * (camera.fov_y / 2.0).tan() / 480.0;
            let z = view.position[2] as f64 / draw.transform.z0 as f64;
            let voxels = z.ln() / (1.0 + pixel * camera.cell_px).ln();
            let corner = f64::from(projected.corner[2]) + f64::from(draw.transform.grid_bias);
            depth = depth.max((corner - voxels).abs());
            for k in 0..2 {
                let cell = projected.data[k] as f64 / 262_144.0 / camera.cell_px;
                assert!((f64::from(projected.corner[k]) - cell).abs() <= 0.501);
            }
            checked += 1;
        }
    }
    println!("transform: {checked} vertices, lanes {worst:.2?} units, depth {depth:.3} voxels");
    assert!(checked > 3_000);
    assert!(worst[..2].iter().all(|e| *e <= 1.6) && worst[2] <= 2.2 && worst[3..].iter().all(|e| *e <= 3.0));
    assert!(depth <= 0.5 + 0.04);
}

/// Flags of the block are signs of distances from planes: to a unit they turn where f64 says.
#[test]
fn vertex_transform_flags_turn_at_their_planes() {
    let draw = triangle(CORNERS).unwrap();
    let (constants, volume) = (&draw.transform, &draw.volume);
    let focal = f64::from(constants.focal) / 65536.0;
    let at = |position: [i64; 3]| {
        let view = ViewVertex { position, normal: [0; 3], texel: [0; 2], density: 0 };
        vertex_transform::golden(constants, volume, &Source::View(view))
    };
    let mut random = Random(3);
    for _ in 0..2_000 {
        let z = constants.z0 + (random.unit() * 2f64.powf(45.0 * random.unit())) as i64;
        let band = (8190.0 * z as f64 / focal) as i64;
        for (bits, [x, y]) in [(0b00010, [-1, 0]), (0b00100, [1, 0]), (0b01000, [0, -1]), (0b10000, [0, 1])] {
            assert_eq!(at([x * (band - 3), y * (band - 3), z]).outside, 0, "{z}");
            assert_eq!(at([x * (band + 3), y * (band + 3), z]).outside, bits, "{z}");
        }
    }
    let behind = at([0, 0, constants.z0 - 1]);
    assert_eq!((behind.outside & 1, behind.projected), (1, None));
    assert_eq!(at([0, 0, constants.z0]).projected.unwrap().unwrap().data[lane::C], i64::from(i32::MAX));
}

/// Culling comes before cuts, cuts before what does not fit, and the first corner that does not fit says why.
#[test]
fn cull_verdicts_come_in_their_order() {
    use OutOfRange::{Grid, Lane};
    let fine = Corner { outcode: 0, outside: 0, failure: None };
    let beyond = |outcode| Corner { outcode, ..fine };
    let outside = Corner { outside: 4, failure: Some(Lane), ..fine };
    let fails = |failure| Corner { failure: Some(failure), ..fine };
    assert_eq!(cull::verdict([fine; 3], true), Verdict::Kept);
    assert_eq!(cull::verdict([beyond(0b110), beyond(0b011), beyond(0b010)], true), Verdict::Culled(Reason::Right));
    assert_eq!(cull::verdict([beyond(0b110), beyond(0b011), beyond(0b010)], false), Verdict::Kept);
    assert_eq!(cull::verdict([beyond(0b110), beyond(0b011), beyond(0b100)], true), Verdict::Kept);
    assert_eq!(cull::verdict([fails(Grid), outside, fine], true), Verdict::Cut);
    assert_eq!(cull::verdict([fine, fails(Grid), fails(Lane)], true), Verdict::Dropped(Grid));
    assert_eq!(cull::verdict([fails(Lane), fails(Grid), fine], false), Verdict::Dropped(Lane));
}

#[test]
fn vertex_transform_example_of_the_documentation() {
    let draw = triangle(CORNERS).unwrap();
    let z0 = draw.transform.z0;
    let at = |z: i64| ViewVertex { position: [0, 0, z], normal: [0; 3], texel: [0; 2], density: 0 };
    let near = vertex_transform::project(&draw.transform, &at(z0)).unwrap();
    let twice = vertex_transform::project(&draw.transform, &at(2 * z0)).unwrap();
    assert!(near.data[lane::C] >= i64::from(i32::MAX) - 2 && near.corner == [0, 0, 0]);
    assert!((0x3fff_fffe..=0x4000_0000).contains(&twice.data[lane::C]));
    assert_eq!(i64::from(twice.corner[2]), (i64::from(draw.transform.octave) + (1 << 15)) >> 16);
}

#[test]
fn log_grid_never_falls_with_distance() {
    let draw = triangle(CORNERS).unwrap();
    // Every c near powers of two and near the ends of the chords, where pieces meet.
    for bits in 6..31 {
        for line in 0..=64i64 {
            let middle = ((64 + line) << bits) >> 6;
            let depths = (middle - 40..=middle + 40).map(|c| vertex_transform::depth(&draw.transform, c.max(1)));
            let depths: Vec<_> = depths.collect();
            assert!(depths.windows(2).all(|d| d[0] >= d[1]), "{bits} {line}");
        }
    }
}

#[test]
fn copies_of_a_vertex_are_equal_but_for_texels() {
    let mut vertices: Vec<_> = CORNERS.map(vertex).to_vec();
    // The same edge with other texels, and neighbours of other densities.
    for (k, uv) in [(0, DVec2::new(0.7, 0.3)), (1, DVec2::new(0.1, 0.9))] {
        vertices.push(DrawVertex { uv, ..vertices[k] });
    }
    vertices.push(DrawVertex { uv: DVec2::new(0.9, 0.9), ..vertex(DVec3::new(0.0, 4.5, -1.0)) });
    vertices[2].uv = DVec2::new(0.2, 0.1);
    let draw = Draw::new(&camera(), &vertices, &[[0, 1, 2], [4, 3, 5]], &MAP, [0.0, 0.1], &FORMAT).unwrap();
    let [Assembled::Kept(a), Assembled::Kept(b)] = [draw.assemble(0), draw.assemble(1)] else { panic!() };
    for (k, l) in [(0, 1), (1, 0)] {
        let (one, other) = (a.data[k], b.data[l]);
        assert_eq!(a.corners[k], b.corners[l]);
        assert_eq!(one[..lane::U], other[..lane::U]);
        assert_eq!(one[lane::DENSITY], other[lane::DENSITY]);
        assert_ne!(one[lane::U], other[lane::U]);
        assert!(one[lane::DENSITY] > 0);
    }
}

#[test]
fn filter_level_thresholds_are_exact() {
    // k thresholds are at or below F, decided in integers: F^2 >= 2 (2^16 2^i)^2, to the 24 bits of the mantissa.
    for i in 0..15u32 {
        let below = ((2f64.sqrt() * f64::from(1u32 << (16 + i))).floor()) as u32;
        assert!(u64::from(below).pow(2) < 2 << (32 + 2 * i) && u64::from(below + 1).pow(2) > 2 << (32 + 2 * i));
        let step = if i < 8 { 1 } else { 1 << (i - 7) };
        assert_eq!(filter_level::thresholds(below - step), i, "{i}");
        assert_eq!(filter_level::thresholds(below + step), i + 1, "{i}");
        if i < 8 {
            assert_eq!(filter_level::thresholds(below), i);
        }
    }
    assert_eq!([0, 1, 65_535, 65_536].map(filter_level::thresholds), [0; 4]);
    assert_eq!(filter_level::thresholds(u32::MAX), 16);
}

#[test]
fn filter_level_footprint_matches_f64() {
    let mut random = Random(9);
    let (mut worst, mut levels) = (0.0f64, [0; 5]);
    for _ in 0..3_000 {
        let camera = CameraView { cell_px: random.between(0.5, 20.0), ..camera() };
        let size = 10f64.powf(random.between(-1.0, 0.5));
        let z = 10f64.powf(random.between(0.0, 1.5));
        let corner =
            |x, y| DrawVertex { position: DVec3::new(size * x, z, size * y), normal: DVec3::Y, uv: DVec2::new(x, y) };
        let vertices = [corner(0.0, 0.0), corner(0.5, 0.0), corner(0.0, 0.5)];
        let draw = Draw::new(&camera, &vertices, &[[0, 1, 2]], &MAP, [0.0, 0.1], &FORMAT).unwrap();
        let Assembled::Kept(piece) = draw.assemble(0) else { panic!() };
        let v = &piece.data[0];
        let inverse = relief_models::perspective_correct::inverse(v[lane::C]);
        let f = f64::from(filter_level::footprint(&draw.level, v[lane::DENSITY], inverse)) / 65536.0;
        let pixel = 2.0 * (camera.fov_y / 2.0).tan() / 480.0;
        let exact = (512.0f64 * 256.0).sqrt() / size * z * pixel * camera.cell_px;
        worst = worst.max((f - exact).abs() / exact.max(0.25));
        levels[draw.request(v).level as usize] += 1;
        assert_eq!(draw.request(v).level, filter_level::thresholds((f * 65536.0) as u32).saturating_sub(1).min(4));
    }
    println!("footprint: {worst:.2e} of F, levels {levels:?}");
    assert!(worst < 2e-4 && levels.iter().all(|&n| n > 20));
}

#[test]
fn world_is_where_displacement_leads() {
    let mut random = Random(31);
    let mut worst = 0.0f64;
    for _ in 0..500 {
        let eye = random.direction() * 3.0;
        let camera = CameraView { eye, target: random.direction() * 0.3, up: random.direction(), ..camera() };
        let normal = random.direction();
        let vertices = [0; 3].map(|_| DrawVertex { normal, ..vertex(random.direction() * 0.5) });
        let draw = Draw::new(&camera, &vertices, &[[0, 1, 2]], &MAP, [-0.1, 0.3], &FORMAT).unwrap();
        let Assembled::Kept(piece) = draw.assemble(0) else { continue };
        let h = random.unit();
        let moved = draw.displace(&piece.data[0], (h * 65535.0 * 256.0) as u32);
        let want = vertices[0].position + (0.4 * h - 0.1) * normal;
        assert_eq!(moved[displaced::FLAGS], 0);
        worst = worst.max((draw.world(&moved) - want).length());
    }
    println!("world: {worst:.2e} at distance 3");
    // 1/512 pixel sideways and c' along the line of sight.
    assert!(worst < 1e-4);
}

#[test]
fn face_normal_matches_f64() {
    let mut random = Random(41);
    let draw = triangle(CORNERS).unwrap();
    let (mut worst, mut checked) = (0.0f64, 0);
    for k in 0..200_000 {
        // From two units of the last place to the whole lane.
        let spread = 2f64.powf(f64::from(k % 20) + 1.0);
        let centre = [random.between(-8e4, 8e4), random.between(-6e4, 6e4)];
        let c = 2f64.powf(random.between(18.0, 30.0));
        let triangle: [[i64; 3]; 3] = std::array::from_fn(|_| {
            let mut xy =
                centre.map(|x| ((x + spread * random.between(-1.0, 1.0)) as i64).clamp(-(1 << 21), (1 << 21) - 1));
            if k == 0 {
                xy = [-(1 << 21); 2];
            }
            [xy[0], xy[1], ((c * (1.0 + spread * 1e-6 * random.between(-1.0, 1.0))) as i64).clamp(1, i32::MAX.into())]
        });
        let Some(exact) = face_normal::exact(&draw.pixel, triangle) else { continue };
        // f64 cancels where the triangle is seen edge on, or is a point.
        let area = {
            let [a, b, c] = triangle;
            (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        };
        if area == 0 {
            continue;
        }
        let n = DVec3::from_array(face_normal::golden(&draw.pixel, triangle).map(f64::from)).normalize();
        worst = worst.max(n.cross(DVec3::from_array(exact)).length());
        assert!(n.dot(DVec3::from_array(exact)) > 0.9, "{triangle:?}");
        checked += 1;
    }
    println!("face normal: {worst:.2e} rad of {checked}");
    assert!(checked > 150_000 && worst < 4e-5);
    let level = |x, y| [x, y, 1 << 20];
    assert_eq!(face_normal::golden(&draw.pixel, [level(0, 0), level(0, 99), level(99, 0)]), [0, 0, -65536]);
    assert_eq!(face_normal::golden(&draw.pixel, [level(0, 0), level(99, 0), level(0, 99)]), [0, 0, -65536]);
    assert_eq!(face_normal::golden(&draw.pixel, [level(7, 7); 3]), [0, 0, -65536]);
    let ends = [[-(1 << 21), -(1 << 21), 1], [(1 << 21) - 1, -(1 << 21), i32::MAX.into()], [0, (1 << 21) - 1, 1]];
    assert_ne!(face_normal::golden(&Pixel { scale: 0xff_ffff, shift: 16 }, ends), [0; 3]);
}

#[test]
fn light_matches_f64() {
    let mut random = Random(43);
    let mut unit = || normalize(random.direction().to_array().map(|x| (x * 1e9) as i64));
    let mut worst = 0.0f64;
    for k in 0..100_000u32 {
        let lights = [unit(), unit()].map(|direction| Light { direction, colour: [0x1_0000, 0x8000, 0x1_4000] });
        let material = Material { shininess: k % 128 + 1, specular: 0x4000, ..Material::TERRAIN };
        let albedo = material.albedo([(k as i64 * 997) % (65535 << 8), 0, 65535 << 8]);
        assert!(albedo.iter().all(|a| *a <= 1 << 16));
        let (n, v) = (unit(), unit());
        let got = light::golden(&material, &lights, albedo, n, v);
        let want = light::exact(&material, &lights, albedo, n, v);
        for c in 0..3 {
            worst = worst.max((f64::from(got[c]) - want[c]).abs());
        }
    }
    println!("light: {worst:.3} / 255");
    assert!(worst < 0.7);
    let white = Light { direction: [0, 0, -65536], colour: [0x1_0000; 3] };
    let bare = Material { ramp: [[0x8000; 3]; 5], ambient: [0; 3], specular: 0, shininess: 1 };
    assert_eq!(light::golden(&bare, &[white], bare.albedo([0; 3]), white.direction, white.direction), [128; 3]);
    assert_eq!(light::golden(&bare, &[white; 9], [0x1_0000; 3], white.direction, white.direction), [255; 3]);
}

#[test]
fn draw_refuses_with_a_sentence() {
    let vertices = CORNERS.map(vertex);
    let make = |camera: &CameraView, vertices: &[DrawVertex], map: &MapInfo, reach: [f64; 2], format: &Format| {
        Draw::new(camera, vertices, &[[0, 1, 2]], map, reach, format).map(|_| ()).map_err(|error| error.to_string())
    };
    let cameras = |change: fn(&mut CameraView)| {
        let mut camera = camera();
        change(&mut camera);
        make(&camera, &vertices, &MAP, [0.0, 0.1], &FORMAT)
    };
    let maps = |map: MapInfo| make(&camera(), &vertices, &map, [0.0, 0.1], &FORMAT);
    let corner = |change: fn(&mut DrawVertex)| {
        let mut vertices = vertices;
        change(&mut vertices[1]);
        make(&camera(), &vertices, &MAP, [0.0, 0.1], &FORMAT)
    };
    let cases = [
        (cameras(|c| c.eye.x = f64::NAN), "eye is not a finite number"),
        (cameras(|c| c.near = 0.0), "0 < near < far"),
        (cameras(|c| c.near = -1.0), "0 < near < far"),
        (cameras(|c| c.far = c.near), "0 < near < far"),
        (cameras(|c| c.target = c.eye), "no direction"),
        (cameras(|c| c.up = DVec3::ZERO), "up is zero"),
        (cameras(|c| c.up = -3.0 * DVec3::Y), "up is zero or along"),
        (cameras(|c| c.fov_y = 3.2), "field of view"),
        (cameras(|c| c.fov_y = 1e-4), "focal length"),
        (cameras(|c| c.viewport = [640, 0]), "viewport"),
        (cameras(|c| c.cell_px = 0.0), "cell_px"),
        (cameras(|c| c.near = 1e-9), "2^28"),
        (maps(MapInfo { width: 0, ..MAP }), "0 x 257 texels"),
        (maps(MapInfo { levels: 0, ..MAP }), "0 levels"),
        (maps(MapInfo { width: 500, ..MAP }), "multiple of 16"),
        (corner(|v| v.uv.x = 2.0), "u of vertex 1 is 2; 0 to below 2"),
        (corner(|v| v.uv.y = 1.01), "v of vertex 1 is 1.01; 0 to 1"),
        (corner(|v| v.normal = DVec3::ZERO), "vertex 1 has a normal of length zero"),
        (corner(|v| v.position.z = f64::INFINITY), "vertex 1 is not a finite number"),
        (make(&camera(), &vertices[..2], &MAP, [0.0, 0.1], &FORMAT), "uses vertex 2, but there are only 2"),
        (make(&camera(), &vertices, &MAP, [0.0, 1000.0], &FORMAT), "32768 times"),
        (make(&camera(), &vertices, &MAP, [f64::NAN, 0.1], &FORMAT), "displacement is not a finite number"),
        (
            make(&camera(), &vertices, &MAP, [0.0, 0.1], &Format { components: 4, ..FORMAT }),
            "takes 5 of at most 32 bits",
        ),
        (make(&camera(), &vertices, &MAP, [0.0, 0.1], &Format { vertex_bits: 33, ..FORMAT }), "components of 33 bits"),
        (make(&camera(), &vertices, &MAP, [0.0, 0.1], &Format { coordinate_bits: 25, ..FORMAT }), "25 bits"),
    ];
    for (result, sentence) in cases {
        let error = result.expect_err(sentence);
        assert!(error.contains(sentence), "{error}");
    }
    assert_eq!(maps(MapInfo { width: 1, height: 1, repeat: [false; 2], levels: 1 }), Ok(()));
}

#[test]
fn draw_drops_what_the_grid_cannot_hold() {
    // Voxels of 1/2 pixel: corners beyond 4096 pixels have no grid coordinate in 14 bits.
    let corners = [DVec3::new(-1.0, 0.1, 0.0), DVec3::new(1.0, 4.0, 0.0), DVec3::new(0.0, 5.0, 1.0)];
    let camera = CameraView { cell_px: 0.5, ..camera() };
    let draw = Draw::new(&camera, &corners.map(vertex), &[[0, 1, 2]], &MAP, [0.0, 0.1], &FORMAT).unwrap();
    assert_eq!(draw.assemble(0), Assembled::Dropped(DropReason::Grid));
    // A deep scene of fine voxels reaches below 0 before it runs out.
    let camera = CameraView { viewport: [2048, 2048], fov_y: 0.8, ..camera };
    let deep = [DVec3::new(-0.5, 2.0, 0.0), DVec3::new(1.0, 10.0, 0.0), DVec3::new(0.0, 30.0, 1.0)];
    let draw = Draw::new(&camera, &deep.map(vertex), &[[0, 1, 2]], &MAP, [0.0, 0.1], &FORMAT).unwrap();
    assert!(draw.transform.grid_bias > 0);
    let Assembled::Kept(piece) = draw.assemble(0) else { panic!("{:?} {:?}", draw.assemble(0), draw.transform) };
    piece.validate(&FORMAT).unwrap();
    assert!(piece.corners[2][2] >= 8190, "{:?}", piece.corners);
}

/// The host warns with this near plane: it has to be one that closes the seams, and not much more than that.
#[test]
fn exact_seams_begin_at_the_near_plane_that_is_told() {
    let seams = |near: f64, camera: &CameraView| {
        let camera = CameraView { near, ..*camera };
        let vertices = CORNERS.map(|corner| DrawVertex { uv: DVec2::ONE, ..vertex(corner) });
        let draw = Draw::new(&camera, &vertices, &[[0, 1, 2]], &MAP, [0.0, 0.01], &FORMAT).unwrap();
        (draw.seams_are_exact(), draw.exact_seams_near())
    };
    let (mut random, mut checked) = (Random(91), 0);
    for _ in 0..200 {
        let camera = CameraView { eye: random.direction() * random.between(0.0, 3.0), ..camera() };
        let (exact, near) = seams(1e-4, &camera);
        assert_eq!(exact, near < 1e-4, "{near}");
        // Not where everything is behind the eye.
        if !exact {
            assert!(seams(near, &camera).0 && !seams(0.995 * near, &camera).0, "{camera:?} {near}");
            checked += 1;
        }
    }
    assert!(checked > 50, "{checked}");
}

/// Any number, often of a size that hurts.
fn anything() -> impl Strategy<Value = f64> {
    prop_oneof![-2.0..2.0f64, -1e-9..1e-9f64, -1e9..1e9f64, Just(0.0), any::<f64>()]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3_000, ..ProptestConfig::default() })]

    /// No panic and no overflow (debug builds check) whatever comes; what is kept fits the formats.
    #[test]
    fn draw_survives_anything(
        numbers in prop::collection::vec(anything(), 24),
        uv in prop::array::uniform6(0.0..1.0f64),
        near in prop_oneof![1e-6..10.0f64, anything()],
        cell_px in prop_oneof![0.1..50.0f64, anything()],
        sizes in (1..9000usize, 1..9000usize, any::<bool>(), any::<bool>(), 1..15usize),
        height in 0..1u32 << 24,
    ) {
        let at = |k: usize| DVec3::new(numbers[k], numbers[k + 1], numbers[k + 2]);
        let camera = CameraView { eye: at(0), target: at(3), near, far: near * 100.0, cell_px, ..camera() };
        let vertices: [DrawVertex; 3] = std::array::from_fn(|k| DrawVertex {
            position: at(6 + 3 * k),
            normal: at(15),
            uv: DVec2::new(uv[2 * k], uv[2 * k + 1]),
        });
        let (width, rows, repeat_u, repeat_v, levels) = sizes;
        let map = MapInfo { width, height: rows, repeat: [repeat_u, repeat_v], levels };
        let reach = [numbers[18], numbers[19]];
        if let Ok(mut draw) = Draw::new(&camera, &vertices, &[[0, 1, 2]], &map, reach, &FORMAT) {
            for cull in [true, false] {
                draw.cull = cull;
                for piece in draw.assemble(0).pieces() {
                    piece.validate(&FORMAT).unwrap();
                    let lights = [draw.light(DVec3::Z).unwrap()];
                    for v in piece.data {
                        let request = draw.request(&v);
                        prop_assert!((request.u >> 16) < 8192 && (request.v >> 16) < 8192);
                        prop_assert!((request.u >> 16) < width as u32 && (request.v >> 16) < rows as u32);
                        prop_assert!(request.level < levels as u32);
                    }
                    let moved = piece.data.map(|v| draw.displace(&v, height));
                    prop_assert!(moved.iter().flatten().all(|x| i32::try_from(*x).is_ok()));
                    draw.shade(moved, &lights);
                }
            }
        }
    }
}
