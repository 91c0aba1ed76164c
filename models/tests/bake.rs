// SPDX-License-Identifier: MIT OR Apache-2.0
//! Preparation of maps: every bound holds, on maps made to break it, and what is written comes back or is refused.

use proptest::prelude::*;
use relief_models::bake::{
    self, Baked, Ground, Manifest, Tolerance, fitted, measure, normals, saturated, unfitted, unfitted_with_seams,
};
use relief_models::bisector::{Bound, Errors, Lattice, Node, SplitMap, golden};
use relief_models::map::{HeightMap, Procedural, Wrap, levels};
use relief_models::mip_build::{self, Centring, Extremum};
use relief_models::sat_build;
use std::collections::BTreeSet;
use std::path::Path;

fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

fn map_of(width: usize, height: usize, mut sample: impl FnMut(usize, usize) -> u16) -> HeightMap {
    let samples = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| sample(x, y)).collect();
    HeightMap { width, height, samples }
}

/// Maps on which methods fail, by name.
fn failure_maps() -> Vec<(String, HeightMap)> {
    let mut maps = Vec::new();
    for (width, height) in [(2, 2), (3, 2), (2, 9), (3, 41), (17, 17), (31, 23), (33, 20), (48, 37)] {
        let mut state = (width * 100 + height) as u64;
        let mut add = |name: &str, map| maps.push((format!("{name} {width} x {height}"), map));
        add("constant", map_of(width, height, |_, _| 1234));
        add("least", map_of(width, height, |_, _| 0));
        add("greatest", map_of(width, height, |_, _| u16::MAX));
        add("ramp", map_of(width, height, |x, y| (700 * x + 300 * y) as u16));
        add("checkerboard", map_of(width, height, |x, y| if (x + y) % 2 == 0 { 0 } else { u16::MAX }));
        add("peak", map_of(width, height, |x, y| if (x, y) == (width / 2, height / 3) { u16::MAX } else { 100 }));
        add("noise", map_of(width, height, |_, _| random(&mut state) as u16));
        add("hills", HeightMap::procedural(Procedural::Peaks, width, height));
        add("dome", HeightMap::procedural(Procedural::Paraboloid, width, height));
        add("waves", HeightMap::procedural(Procedural::Cosine, width, height));
    }
    maps
}

fn ground(map: &HeightMap, mirrored: bool) -> Ground<'_> {
    let lattice = Lattice::of(map.width as u32, map.height as u32, mirrored).unwrap();
    Ground { lattice, samples: &map.samples }
}

fn plain(map: &HeightMap) -> Vec<u32> {
    map.samples.iter().map(|&sample| u32::from(sample) << 4).collect()
}

fn bounds() -> [Tolerance; 5] {
    ["0", "1/3", "16.8", "900", "65535"].map(|text| text.parse().unwrap())
}

#[test]
fn bake_bounds_hold_on_failure_maps() {
    for (name, map) in failure_maps() {
        for (bound, mirrored) in bounds().into_iter().flat_map(|bound| [(bound, false), (bound, true)]) {
            let ground = ground(&map, mirrored);
            let split = unfitted(&ground, bound);
            let before = measure(&ground, &split, &plain(&map));
            let fit = fitted(&ground, bound, 1, &());
            let after = measure(&ground, &fit.split, &fit.heights);
            for (what, measured) in [("unfitted", &before), ("fitted", &after)] {
                let maximum = measured.maximum;
                assert!(maximum.is_within(bound), "{name}, {bound}, {what}: {maximum:?}");
                assert_eq!(measured.missing, 0, "{name}, {bound}, {what}");
            }
            assert!(after.triangles <= before.triangles, "{name}, {bound}: {} {}", before.triangles, after.triangles);
            // Heights stay in their format and within the bound of their sample.
            for (&height, &sample) in fit.heights.iter().zip(&map.samples) {
                let distance = u64::from(height.abs_diff(u32::from(sample) << 4));
                assert!(height <= 0xF_FFFF && distance * u64::from(bound.under()) <= 16 * u64::from(bound.over()));
            }
        }
    }
}

#[test]
fn bake_flips_are_their_own_inverse_and_keep_the_bound() {
    let map = HeightMap::procedural(Procedural::Peaks, 90, 61);
    let ground = ground(&map, false);
    for flip in [[false, true], [true, false], [true, true]] {
        let there = bake::flip(&map.samples, map.width, flip);
        assert!(there != map.samples && bake::flip(&there, map.width, flip) == map.samples);
        let at = bake::unflip([3, 7], [90, 61], flip);
        assert_eq!(there[7 * 90 + 3], map.sample(at[0] as usize, at[1] as usize));
    }
    let bound: Tolerance = "400".parse().unwrap();
    let (flip, fit) = bake::fitted_from_best_corner(&map, &ground, bound, 1, &());
    let flipped = bake::flip(&map.samples, map.width, flip);
    let measured = measure(&Ground { samples: &flipped, ..ground }, &fit.split, &fit.heights);
    assert!(measured.maximum.is_within(bound) && measured.missing == 0);
    let first = fitted(&ground, bound, 0, &());
    assert!(measured.triangles <= measure(&ground, &first.split, &first.heights).triangles);
}

#[test]
fn bake_planes_take_two_triangles_and_noise_takes_all() {
    let bound: Tolerance = "1/2".parse().unwrap();
    for (name, map) in failure_maps() {
        let ground = ground(&map, false);
        let triangles = measure(&ground, &unfitted(&ground, bound), &plain(&map)).triangles;
        let square = map.width == 17 && map.height == 17;
        if name.starts_with("constant") || (name.starts_with("ramp") && square) {
            let fewest = measure(&ground, &SplitMap::new(&ground.lattice), &plain(&map)).triangles;
            assert_eq!(triangles, fewest, "{name}");
        }
        if name.starts_with("checkerboard") && square {
            assert_eq!(triangles, 2 * 16 * 16, "{name}");
        }
    }
}

#[test]
fn bake_fits_are_the_same_at_any_number_of_cores_and_larger_efforts_never_grow() {
    // Hills with noise: vertices everywhere, also along the borders of the windows.
    let mut state = 5;
    let mut map = HeightMap::procedural(Procedural::Peaks, 210, 157);
    map.samples.iter_mut().for_each(|sample| *sample = *sample / 2 + (random(&mut state) % 900) as u16);
    let ground = ground(&map, false);
    let bound: Tolerance = "600".parse().unwrap();
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let [one, three] = [1, 3].map(|threads| pool(threads).install(|| fitted(&ground, bound, 10, &())));
    assert!(one == three);
    let counts: Vec<u64> = (0..5)
        .map(|effort| {
            let fit = fitted(&ground, bound, effort, &());
            measure(&ground, &fit.split, &fit.heights).triangles
        })
        .collect();
    assert!(counts.is_sorted_by(|more, fewer| more >= fewer), "{counts:?}");
    let before = measure(&ground, &unfitted(&ground, bound), &plain(&map)).triangles;
    assert!(counts[4] * 10 <= before * 7, "{before} {counts:?}");
}

/// The least closed set by the definition: walk, insert the failing leaves in a random order, until none fails.
fn by_definition(ground: &Ground<'_>, bound: Tolerance, seed: u64) -> SplitMap {
    let lattice = &ground.lattice;
    let mut split = SplitMap::new(lattice);
    let mut state = seed;
    loop {
        let (mut failing, mut waiting) = (Vec::new(), lattice.roots().to_vec());
        while let Some(node) = waiting.pop() {
            let Some(midpoint) = node.midpoint() else { continue };
            if split.get(lattice.index(midpoint)) {
                waiting.extend(node.halves());
            } else if !ground.excess(node, |index| i32::from(ground.samples[index]) << 4).is_within(bound) {
                failing.push(midpoint);
            }
        }
        if failing.is_empty() {
            return split;
        }
        // A few at a time, at random.
        for _ in 0..failing.len().div_ceil(3) {
            split.insert(lattice, failing[random(&mut state) as usize % failing.len()]);
        }
    }
}

fn maps() -> impl Strategy<Value = HeightMap> {
    (2usize..40, 2usize..40, any::<u64>(), 0u32..16).prop_map(|(width, height, seed, rough)| {
        let mut state = seed;
        let slopes = [random(&mut state) % 900, random(&mut state) % 900];
        map_of(width, height, |x, y| {
            let smooth = slopes[0] * x as u64 + slopes[1] * y as u64;
            (smooth + ((random(&mut state) & 0xFFFF) >> rough)) as u16
        })
    })
}

fn tolerances() -> impl Strategy<Value = Tolerance> {
    (0u32..3000, 1u32..7).prop_map(|(over, under)| Tolerance::new(over, under).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, ..ProptestConfig::default() })]

    #[test]
    fn bake_exact_errors_are_those_of_the_definition(map in maps(), mirrored: bool, seed: u64) {
        let ground = ground(&map, mirrored);
        let mut state = seed;
        let heights: Vec<u32> = map.samples.iter().map(|_| random(&mut state) as u32 & 0xF_FFFF).collect();
        let mut split = SplitMap::new(&ground.lattice);
        for _ in 0..random(&mut state) % 60 {
            let side = u64::from(ground.lattice.side()) + 1;
            split.insert(&ground.lattice, [0, 1].map(|_| (random(&mut state) % side) as u32));
        }
        let mut walked = bake::Excess::NONE;
        let mut waiting = ground.lattice.roots().to_vec();
        while let Some(node) = waiting.pop() {
            match node.midpoint() {
                Some(midpoint) if split.get(ground.lattice.index(midpoint)) => waiting.extend(node.halves()),
                _ => walked = walked.max(ground.excess(node, |index| heights[index] as i32)),
            }
        }
        let measured = measure(&ground, &split, &heights).maximum;
        let [a, b] = [walked, measured].map(|excess| (i128::from(excess.over), i128::from(excess.under)));
        prop_assert_eq!(a.0 * b.1, b.0 * a.1);
    }

    #[test]
    fn bake_seams_have_equal_rims(map in maps(), seams: [bool; 2], bound in tolerances()) {
        let map = map.unrolled(seams.map(|seam| if seam { Wrap::Repeat } else { Wrap::Clamp }));
        let ground = ground(&map, false);
        let split = unfitted_with_seams(&ground, bound, seams);
        let measured = measure(&ground, &split, &plain(&map));
        prop_assert!(measured.maximum.is_within(bound) && measured.missing == 0);
        // Places of vertices along each of the four rims.
        let last = [map.width as u32 - 1, map.height as u32 - 1];
        let mut rims = [[BTreeSet::new(), BTreeSet::new()], [BTreeSet::new(), BTreeSet::new()]];
        golden(&ground.lattice, &split, &mut |triangle| {
            for at in triangle.corners {
                for axis in 0..2 {
                    for (side, rim) in [0, last[axis]].into_iter().enumerate() {
                        if at[axis] == rim {
                            rims[axis][side].insert(at[1 - axis]);
                        }
                    }
                }
            }
        });
        for axis in 0..2 {
            prop_assert!(!seams[axis] || rims[axis][0] == rims[axis][1], "{rims:?}");
        }
        // No more than the seams ask for.
        prop_assert!(seams[0] || seams[1] || split == unfitted(&ground, bound));
    }

    #[test]
    fn bake_unfitted_is_unique(map in maps(), mirrored: bool, bound in tolerances(), seed: u64) {
        let ground = ground(&map, mirrored);
        prop_assert!(unfitted(&ground, bound) == by_definition(&ground, bound, seed));
    }

    #[test]
    fn bake_fitted_keeps_random_bounds(map in maps(), mirrored: bool, bound in tolerances()) {
        let ground = ground(&map, mirrored);
        let fit = fitted(&ground, bound, 2, &());
        let after = measure(&ground, &fit.split, &fit.heights);
        prop_assert!(after.maximum.is_within(bound) && after.missing == 0);
        prop_assert!(after.triangles <= measure(&ground, &unfitted(&ground, bound), &plain(&map)).triangles);
        // Splitting wherever the whole lattice needs it adds nothing to the mesh.
        let mut closed = SplitMap::new(&ground.lattice);
        for vertex in (0..=ground.lattice.side()).flat_map(|v| (0..=ground.lattice.side()).map(move |u| [u, v])) {
            if fit.split.get(ground.lattice.index(vertex)) {
                closed.insert(&ground.lattice, vertex);
            }
        }
        prop_assert_eq!(measure(&ground, &closed, &fit.heights).triangles, after.triangles);
    }

    #[test]
    fn bake_saturated_errors_keep_every_bound(
        map in maps(), mirrored: bool, base in 0u16..20000, slope in 0u16..4000, eye in [0u16..80, 0u16..80],
    ) {
        let ground = ground(&map, mirrored);
        let saturated = saturated(&ground, &());
        let lattice = &ground.lattice;
        let bound = Bound { base, slope, eye };
        let steering = Errors { errors: &saturated.errors, bound };
        prop_assert_eq!(measure(&ground, &steering, &plain(&map)).missing, 0);
        let unit = 1i64 << saturated.fraction_bits;
        let mut waiting = lattice.roots().to_vec();
        while let Some(node) = waiting.pop() {
            let error = node.midpoint().map(|midpoint| u32::from(saturated.errors[lattice.index(midpoint)]));
            if error.is_some_and(|error| error > bound.at(lattice, node)) {
                for half in node.halves().into_iter().filter_map(Node::midpoint) {
                    prop_assert!(u32::from(saturated.errors[lattice.index(half)]) <= error.unwrap());
                }
                waiting.extend(node.halves());
            } else {
                let excess = ground.excess(node, |index| i32::from(map.samples[index]) << 4);
                let most = i64::from(bound.at(lattice, node));
                prop_assert!(excess.over * unit <= most * excess.under, "{:?} {:?}", node, excess);
            }
        }
        // Rounding up costs less than a unit: some triangle has that error.
        let largest = i64::from(*saturated.errors.iter().max().unwrap());
        let range = map.samples.iter().max().unwrap() - map.samples.iter().min().unwrap();
        prop_assert!(largest <= i64::from(range) * unit);
    }

    #[test]
    fn bake_tolerances_come_back(over in 0u32..100_000, under in 1u32..9999) {
        let bound = Tolerance::new(over.min(65535 * under), under).unwrap();
        prop_assert_eq!(bound.to_string().parse::<Tolerance>().unwrap(), bound);
    }
}

#[test]
fn bake_tolerances_are_fractions() {
    for (text, over, under) in [("16.8", 84, 5), ("20", 20, 1), ("50/3", 50, 3), ("0.0001", 1, 10_000), ("0", 0, 1)] {
        let bound: Tolerance = text.parse().unwrap();
        assert_eq!((bound.over(), bound.under()), (over, under), "{text}");
    }
    for text in ["", "-1", "1e3", "65535.5", "1/0", "1/20001", "3.00001", ".5", "5.", "+5", "1/2/3", "99999999999"] {
        let error = text.parse::<Tolerance>().unwrap_err();
        assert!(error.contains("is no bound; a number of map units from 0 to 65535"), "{text}: {error}");
    }
}

#[test]
fn bake_fills_voids_from_their_rim() {
    let mut map = map_of(5, 3, |x, y| if (1..4).contains(&x) && y < 3 { 9 } else { (10 * x) as u16 });
    let filled = bake::fill(&mut map, 9).unwrap();
    assert_eq!((filled.samples, filled.rounds), (9, 2));
    assert_eq!(map.samples[..5], [0, 0, 20, 40, 40]);
    let mut none = map.clone();
    assert_eq!(bake::fill(&mut none, 9), Some(bake::Filled { samples: 0, rounds: 0 }));
    assert_eq!(none, map);
    let mut all = map_of(4, 4, |_, _| 7);
    assert_eq!(bake::fill(&mut all, 7), None);
}

#[test]
fn bake_normals_are_unit_and_round_half_up() {
    let map = map_of(4, 3, |x, _| x as u16);
    let found = normals(&map, 1.0);
    assert_eq!(found[5], [-11585, 0, 11585]);
    // Half the slope at the first column.
    assert_eq!(found[4], [-7327, 0, 14654]);
    let rough = HeightMap::procedural(Procedural::Checkerboard, 19, 17);
    for [x, y, z] in normals(&rough, 30.0) {
        let length = [x, y, z].map(f64::from).map(|c| c * c).iter().sum::<f64>().sqrt();
        assert!((length - 16384.0).abs() < 0.9 && z > 0);
    }
}

/// Everything of a map, in a folder.
fn baked(map: HeightMap) -> Baked {
    let ground = ground(&map, false);
    let bound: Tolerance = "700".parse().unwrap();
    let fit = fitted(&ground, bound, 1, &());
    let measured = measure(&ground, &fit.split, &fit.heights);
    let saturated = saturated(&ground, &());
    let (size, wrap) = ([map.width, map.height], [Wrap::Clamp; 2]);
    let sizes = levels(size, wrap);
    let pyramid = |extremum| {
        mip_build::golden(size[0], size[1], &map.samples, Centring::Node, wrap, extremum, sizes.len()).unwrap().levels
    };
    let table = sat_build::golden(size[0], size[1], &map.samples, 41);
    let sums = (0..=size[1]).flat_map(|y| (0..=size[0]).map(move |x| [x, y])).map(|[x, y]| table.at(x, y)).collect();
    let manifest = Manifest {
        format: bake::FORMAT.into(),
        version: bake::VERSION,
        map: bake::MapEntry {
            name: "hills.png".into(),
            width: size[0],
            height: size[1],
            bits: 16,
            fnv1a: bake::hash(&map),
            void: Some(3),
            filled: 2,
        },
        levels: ground.lattice.levels,
        mirrored: false,
        split: Some(bake::SplitEntry {
            bound: bound.to_string(),
            fitted: true,
            flipped: [true, false],
            effort: Some(1),
            triangles: measured.triangles,
            maximum: [measured.maximum.over, measured.maximum.under],
            maximum_decimal: measured.maximum.to_f64(),
        }),
        errors: Some(bake::ErrorsEntry { fraction_bits: saturated.fraction_bits, largest: 1 }),
        mips: Some(sizes.clone()),
        sums: Some(bake::SumsEntry { bits: 41 }),
        normals: Some(bake::NormalsEntry { spacing: 2.5 }),
    };
    Baked {
        manifest,
        lattice: ground.lattice,
        split: Some(fit.split),
        heights: Some(fit.heights),
        errors: Some(saturated.errors),
        mips: Some([pyramid(Extremum::Max), pyramid(Extremum::Min)]),
        sums: Some(sums),
        normals: Some(normals(&map, 2.5)),
        map,
    }
}

#[test]
fn bake_folders_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let baked = baked(HeightMap::procedural(Procedural::Peaks, 45, 29));
    baked.write(folder.path()).unwrap();
    assert!(Baked::read(folder.path()).unwrap() == baked);
    for entry in std::fs::read_dir(folder.path()).unwrap() {
        assert!(bake::is_ours(entry.unwrap().file_name().to_str().unwrap()));
    }
    assert!(!bake::is_ours("notes.txt") && !bake::is_ours("maxima.png"));
    // The mesh is what the manifest says.
    let read = Baked::read(folder.path()).unwrap();
    let counts = golden(&read.lattice, &read.split.unwrap(), &mut |_| ());
    assert_eq!(counts.triangles, read.manifest.split.unwrap().triangles);
}

#[test]
fn bake_folders_that_do_not_fit_are_refused() {
    let original = baked(HeightMap::procedural(Procedural::Peaks, 45, 29));
    let refusal = |change: &dyn Fn(&mut Baked, &Path)| {
        let folder = tempfile::tempdir().unwrap();
        let mut baked = original.clone();
        // Before it is written, then after.
        change(&mut baked, Path::new(""));
        baked.write(folder.path()).unwrap();
        change(&mut baked, folder.path());
        Baked::read(folder.path()).unwrap_err().to_string()
    };
    let text = |from: &'static str, to: &'static str| {
        move |_: &mut Baked, folder: &Path| {
            let path = folder.join("bake.json");
            if folder != Path::new("") {
                let old = std::fs::read_to_string(&path).unwrap();
                assert!(old.contains(from), "{old}");
                std::fs::write(path, old.replace(from, to)).unwrap();
            }
        }
    };
    let file = |name: &'static str, bytes: Option<&'static [u8]>| {
        move |_: &mut Baked, folder: &Path| {
            let path = folder.join(name);
            match bytes {
                _ if folder == Path::new("") => (),
                Some(bytes) => std::fs::write(path, bytes).unwrap(),
                None => std::fs::remove_file(path).unwrap(),
            }
        }
    };
    type Change = Box<dyn Fn(&mut Baked, &Path)>;
    let cases: Vec<(Change, &str)> = vec![
        (Box::new(text("\"version\": 1", "\"version\": 2")), "version 2; \"relief bake\", version 1, is expected"),
        (Box::new(text("relief bake", "relief cake")), "is of format \"relief cake\""),
        (Box::new(text("\"levels\": 6", "\"levels\": 7")), "has 7 levels; 6 are expected"),
        (
            Box::new(text("\"width\": 45", "\"width\": 1")),
            "has a map of 1 x 29 samples; 2 x 2 to 4097 x 4097 is expected",
        ),
        (Box::new(text("\"width\": 45", "\"width\": 46")), "map.png: is a picture of 45 x 29 samples"),
        (Box::new(text("\"bound\": \"700\"", "\"bound\": \"soon\"")), "`soon` is no bound"),
        (Box::new(text("\"mirrored\"", "\"mirror\"")), "is not as version 1 has it: unknown field `mirror`"),
        (Box::new(file("bake.json", None)), "a folder that `relief bake` has written is expected"),
        (Box::new(file("bake.json", Some(b"{"))), "bake.json: is no JSON"),
        (Box::new(file("split.png", None)), "split.png: cannot be opened"),
        (Box::new(file("errors.png", Some(b"\x89PNG"))), "errors.png: cannot be decoded"),
        (Box::new(file("sums.u64", Some(b"123"))), "sums.u64: has 3 bytes; 1380 sums of 8 bytes are expected"),
        (Box::new(|baked, _| baked.map.samples[7] ^= 1), "and bake.json says"),
        (
            Box::new(|baked, _| {
                let lattice = baked.lattice;
                baked.split = Some(SplitMap::new(&lattice));
                baked.split.as_mut().unwrap().set(lattice.index([3, 4]), true);
            }),
            "a closed split map is expected",
        ),
        (
            Box::new(|baked, _| {
                let index = baked.lattice.index([3, 4]);
                baked.errors.as_mut().unwrap()[index] = u16::MAX;
            }),
            "saturated errors are expected",
        ),
    ];
    for (change, sentence) in cases {
        let error = refusal(&*change);
        assert!(error.contains(sentence), "{error}\n does not say: {sentence}");
    }
}
